// Lines that keep their colour whatever lies behind them.

fn is_left_out(pixel: vec2<u32>) -> bool {
    return false;
}

fn contrasted(line: vec3<f32>, frame_px: vec2<f32>) -> vec3<f32> {
    return line;
}
