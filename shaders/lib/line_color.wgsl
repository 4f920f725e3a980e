// Where the colour of a line comes from. Twin: npr_style::line_color. The shader declares `view`, `compose`,
// `lights`, `parts` and `texels`.

//# use lib/texture
//# use lib/compose
//# use lib/color
//# use lib/line_tint
//# use lib/lighting

// Colours of a row.
const HUES: f32 = 256.0;

// A straight-alpha colour laid over another one, both in linear light.
fn laid(top: vec4<f32>, below: vec4<f32>) -> vec4<f32> {
    if top.a <= 0.0 { return below; }
    let left = below.a * (1.0 - top.a);
    let alpha = top.a + left;
    return vec4<f32>((top.rgb * top.a + below.rgb * left) / alpha, alpha);
}

// The colour of a row at a share of its length, linear light, straight alpha.
fn hue_at(row: u32, share: f32) -> vec4<f32> {
    let place = clamp(share, 0.0, 1.0) * (HUES - 1.0);
    let below = min(u32(place), u32(HUES) - 2u);
    let first = row + HEADER_WORDS + below;
    let low = linear_texel(texels[first]);
    return low + (linear_texel(texels[first + 1u]) - low) * (place - f32(below));
}

// How far along a part's row over depth a place lies, 0..1.
fn depth_share(part: u32, world: vec3<f32>) -> f32 {
    let from_middle = (parts[part].line_flags & LINE_FROM_MIDDLE) != 0u;
    let origin = select(view.eye_world, compose.center_world, from_middle);
    let depth = dot(world - origin, view.forward_world);
    return clamp((depth - parts[part].line_depth.x) * parts[part].line_depth.y, 0.0, 1.0);
}

// Decides the tint of a part's lines at a place in the world, over a surface's colour `own` in linear light.
fn decide(part: u32, own: vec3<f32>, world: vec3<f32>, normal: vec3<f32>) -> Tint {
    let flags = parts[part].line_flags;
    var tint_layer = vec4<f32>(0.0);
    var opacity = 1.0;
    if (flags & (LINE_LIGHT | LINE_OPACITY)) != 0u {
        let x = coordinate_at(world, normal, 0u).x;
        if (flags & LINE_LIGHT) != 0u { tint_layer = laid(hue_at(parts[part].line_light_row, x), tint_layer); }
        let ends = parts[part].line_opacity;
        opacity = ends.x + (ends.y - ends.x) * x;
    }
    if (flags & LINE_RIM) != 0u {
        let back = parts[part].back_color;
        let facing = ramp_coordinate(dot(normal, in_world(compose, parts[part].back_direction)));
        let rim = smooth_step(parts[part].back.x, parts[part].back.y, facing) * back.a * parts[part].line_rim;
        tint_layer = laid(vec4<f32>(back.rgb, clamp(rim, 0.0, 1.0)), tint_layer);
    }
    if (flags & LINE_DEPTH) != 0u {
        tint_layer = laid(hue_at(parts[part].line_depth_row, depth_share(part, world)), tint_layer);
    }
    if (flags & LINE_TINT) != 0u {
        let tint = unpack_rgba8(parts[part].line_tint);
        tint_layer = laid(vec4<f32>(linear_rgb(tint.rgb), tint.a), tint_layer);
    }
    var tint: Tint;
    tint.is_known = true;
    tint.own = vec4<f32>(srgb_of(own), opacity);
    tint.tint_layer = vec4<f32>(srgb_of(tint_layer.rgb), tint_layer.a);
    return tint;
}
