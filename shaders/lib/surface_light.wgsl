// Light on a surface. Twin: npr_style::tone. The shader declares `lights`, `parts` and `texels`.

//# use lib/lighting
//# use lib/tone_row

// Light of a ramp at coordinate `x`: each step takes over where its coordinate begins.
fn ramp_light(part: u32, x: f32) -> vec3<f32> {
    if has_tone_row(part) { return row_light(parts[part].tone_row, x); }
    let half = parts[part].softness * 0.5;
    var light = parts[part].ramp[0].rgb;
    for (var i = 1u; i < 8u; i++) {
        let stop = parts[part].ramp[i];
        if stop.a > 1.5 { break; }
        light += (stop.rgb - light) * smooth_step(stop.a - half, stop.a + half, x);
    }
    return light;
}

// Light on a surface at `world` with the normal `normal`, in the shadow of the lights in `dark`, that sees `open` of
// the sky.
fn light_of(part: u32, world: vec3<f32>, normal: vec3<f32>, dark: u32, open: Openness) -> vec3<f32> {
    if (parts[part].flags & PART_UNLIT) != 0u { return vec3<f32>(1.0); }
    let lit = coordinate_under(world, normal, dark, open);
    return ramp_light(part, lit.x) * lit.color;
}
