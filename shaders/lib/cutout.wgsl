// Holes in cut-out parts. Twin: npr_core::cutout.
// The shader declares `vertices`, `triangles`, `parts` and `texels`.

//# use lib/sampling

// Whether a triangle of a cut-out part is transparent where its corners have these weights.
fn is_hole_at(triangle: u32, weights: vec3<f32>) -> bool {
    let part = parts[triangles[triangle].part];
    if (part.flags & PART_CUTOUT) == 0u { return false; }
    let corners = triangles[triangle].corners;
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
