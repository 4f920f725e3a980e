// The colour that a surface gives its lines at a pixel. Twin: npr_style::line_color. The shader declares what
// lib/surface_color and lib/line_color ask for.

//# use lib/geometry
//# use lib/surface_color
//# use lib/line_color

// Weights of a triangle's corners at a point of the frame; on a hull, beside its triangle, those of its nearest point.
fn line_weights(corners: Corners, px: vec2<f32>, is_hull: bool) -> vec3<f32> {
    let weights = weights_at(corners.clip, ndc_at(view, px));
    if !is_hull { return weights; }
    // Beside a face seen edge-on, weights are far too large or NaN.
    let held = select(vec3<f32>(0.0), min(weights, vec3<f32>(1e3)), weights > vec3<f32>(0.0));
    let sum = held.x + held.y + held.z;
    if !(sum > 0.0) { return vec3<f32>(1.0, 0.0, 0.0); }
    return held / sum;
}

// Colour of the surface for its lines, linear light; black if the part does not ask for it.
fn line_own(triangle: Triangle, corners: Corners, px: vec2<f32>, step_px: vec2<f32>, is_hull: bool) -> vec3<f32> {
    let part = triangle.part;
    let flags = parts[part].line_flags;
    if (flags & LINE_SOURCES) == 0u { return vec3<f32>(0.0); }
    let weights = line_weights(corners, px, is_hull);
    let shows_surface = (flags & LINE_SURFACE) != 0u;
    let is_plain = (parts[part].flags & PART_PLAIN) != 0u;
    var start = NONE;
    if shows_surface && !is_plain { start = parts[part].texture; }
    if (flags & LINE_TEXTURE) != 0u { start = parts[part].line_texture; }
    var color = vec3<f32>(1.0);
    if start != NONE {
        let right = line_weights(corners, px + vec2<f32>(step_px.x, 0.0), is_hull);
        let down = line_weights(corners, px + vec2<f32>(0.0, step_px.y), is_hull);
        let uv = uv_at(triangle, weights);
        color = sample_texture(start, uv, footprint(uv, uv_at(triangle, right), uv_at(triangle, down))).rgb;
    }
    if (flags & LINE_TEXTURE) == 0u && !(shows_surface && is_plain) { color *= tint(triangle, weights); }
    if shows_surface { color = strengthened(color * parts[part].base_color.rgb); }
    return color * parts[part].line_factor;
}

// The tint of lines on a triangle at a point of the frame.
fn line_tint(triangle: Triangle, corners: Corners, px: vec2<f32>, step_px: vec2<f32>, is_hull: bool) -> Tint {
    let weights = line_weights(corners, px, is_hull);
    // Hulls show the backs of faces, but their outline is at the front.
    let normal = normal_of(corners, weights) * select(1.0, corners.side, is_hull);
    let own = line_own(triangle, corners, px, step_px, is_hull);
    return decide(triangle.part, own, world_of(corners, weights), normal);
}
