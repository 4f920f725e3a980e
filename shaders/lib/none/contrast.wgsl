// Lines that keep their colour whatever lies behind them.

fn contrasted(line: vec3<f32>, frame_px: vec2<f32>) -> vec3<f32> {
    return line;
}
