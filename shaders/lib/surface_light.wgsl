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

// Light of a ramp at four coordinates, channel by channel.
struct RampLight {
    red: vec4<f32>,
    green: vec4<f32>,
    blue: vec4<f32>,
}

// One light for four coordinates.
fn same_ramp_light(light: vec3<f32>) -> RampLight {
    return RampLight(vec4<f32>(light.r), vec4<f32>(light.g), vec4<f32>(light.b));
}

// `ramp_light` for four coordinates: the ramp is looked at once.
fn ramp_lights(part: u32, x: vec4<f32>) -> RampLight {
    var light: RampLight;
    if has_tone_row(part) {
        let row = parts[part].tone_row;
        let a = row_light(row, x.x);
        let b = row_light(row, x.y);
        let c = row_light(row, x.z);
        let d = row_light(row, x.w);
        return RampLight(vec4<f32>(a.r, b.r, c.r, d.r), vec4<f32>(a.g, b.g, c.g, d.g), vec4<f32>(a.b, b.b, c.b, d.b));
    }
    let half = parts[part].softness * 0.5;
    let first = parts[part].ramp[0];
    light.red = vec4<f32>(first.r);
    light.green = vec4<f32>(first.g);
    light.blue = vec4<f32>(first.b);
    for (var i = 1u; i < 8u; i++) {
        let stop = parts[part].ramp[i];
        if stop.a > 1.5 { break; }
        let share = smooth_steps(stop.a - half, stop.a + half, x);
        light.red += (stop.r - light.red) * share;
        light.green += (stop.g - light.green) * share;
        light.blue += (stop.b - light.blue) * share;
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
