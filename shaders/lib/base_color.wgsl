// The colour of a surface without light. Twin: npr_style::compose::Layers.

//# use lib/surface_color

// Surface colour without light.
fn base_color(triangle: Triangle, corners: Corners, frame_px: vec2<f32>) -> vec3<f32> {
    var color = parts[triangle.part].base_color.rgb;
    if (parts[triangle.part].flags & PART_PLAIN) != 0u { return color; }
    let weights = weights_at(corners.clip, ndc_at(view, frame_px));
    color *= tint(triangle, weights);
    let texture = parts[triangle.part].texture;
    if texture != NONE {
        let right = weights_at(corners.clip, ndc_at(view, frame_px + vec2<f32>(1.0, 0.0)));
        let down = weights_at(corners.clip, ndc_at(view, frame_px + vec2<f32>(0.0, 1.0)));
        let uv = uv_at(triangle, weights);
        color *= sample_texture(texture, uv, footprint(uv, uv_at(triangle, right), uv_at(triangle, down))).rgb;
    }
    return color;
}
