// Holes in cut-out parts. Twin: npr_core::cutout::is_hole.
// The shader declares `posed`, `vertices`, `triangles`, `parts` and `texels`.

// Whether a triangle of a cut-out part is transparent at a point of the picture.
fn is_hole(triangle: u32, ndc: vec2<f32>) -> bool {
    let part = parts[triangles[triangle].part];
    if (part.flags & PART_CUTOUT) == 0u { return false; }
    let corners = triangles[triangle].corners;
    let clip = array<vec4<f32>, 3>(posed[corners.x].clip, posed[corners.y].clip, posed[corners.z].clip);
    let weights = weights_at(clip, ndc);
    var alpha = part.base_color.a;
    alpha *= blend(
        weights,
        f32(vertices[corners.x].color >> 24u),
        f32(vertices[corners.y].color >> 24u),
        f32(vertices[corners.z].color >> 24u),
    ) / 255.0;
    if part.texture != NONE {
        let uv = vertices[corners.x].uv * weights.x + vertices[corners.y].uv * weights.y
            + vertices[corners.z].uv * weights.z;
        alpha *= sample_texture(part.texture, uv, 0.0).a;
    }
    return alpha < part.alpha_cutoff;
}
