// Corners of triangles, and the colour of surfaces without light. Twins: npr_style::tone, npr_style::compose::Layers.
// The shader declares `view`, `compose`, `posed`, `vertices`, `triangles`, `parts` and `texels`.

//# use lib/surface
//# use lib/window
//# use lib/sampling
//# use lib/compose

struct Corners {
    clip: array<vec4<f32>, 3>,
    normals: array<vec3<f32>, 3>,
    world: array<vec3<f32>, 3>,
    // 1 where the front is seen, -1 where the back is.
    side: f32,
}

fn corners_of(triangle: Triangle) -> Corners {
    let a = posed[triangle.corners.x];
    let b = posed[triangle.corners.y];
    let c = posed[triangle.corners.z];
    var corners: Corners;
    corners.clip = array<vec4<f32>, 3>(a.clip, b.clip, c.clip);
    corners.normals = array<vec3<f32>, 3>(a.normal, b.normal, c.normal);
    corners.world = array<vec3<f32>, 3>(a.world, b.world, c.world);
    corners.side = select(-1.0, 1.0, faces_eye(corners.clip));
    return corners;
}

fn normal_of(corners: Corners, weights: vec3<f32>) -> vec3<f32> {
    return unit_or_z(blend3(weights, corners.normals[0], corners.normals[1], corners.normals[2])) * corners.side;
}

fn world_of(corners: Corners, weights: vec3<f32>) -> vec3<f32> {
    return blend3(weights, corners.world[0], corners.world[1], corners.world[2]);
}

// Depth of a triangle's plane at a position of the frame.
fn depth_of(id: u32, frame_px: vec2<f32>) -> f32 {
    let corners = triangles[(id & ID_MASK) - 1u].corners;
    let a = posed[corners.x];
    let b = posed[corners.y];
    let c = posed[corners.z];
    let weights = weights_at(array<vec4<f32>, 3>(a.clip, b.clip, c.clip), ndc_at(view, frame_px));
    return blend(weights, a.depth, b.depth, c.depth);
}

// A place of the triangle lifted onto the tangent planes of its corners [Hanika 2021].
fn lifted(corners: Corners, weights: vec3<f32>) -> vec3<f32> {
    let world = world_of(corners, weights);
    var lifts: array<vec3<f32>, 3>;
    for (var i = 0u; i < 3u; i++) {
        let normal = corners.normals[i] * corners.side;
        let below = min(dot(world - corners.world[i], normal), 0.0);
        lifts[i] = normal * -below;
    }
    return world + blend3(weights, lifts[0], lifts[1], lifts[2]);
}

fn uv_at(triangle: Triangle, weights: vec3<f32>) -> vec2<f32> {
    let at = triangle.corners;
    return vertices[at.x].uv * weights.x + vertices[at.y].uv * weights.y + vertices[at.z].uv * weights.z;
}

// Vertex colours of a triangle where its corners have these weights, linear light.
fn tint(triangle: Triangle, weights: vec3<f32>) -> vec3<f32> {
    let at = triangle.corners;
    return blend3(
        weights,
        linear_texel(vertices[at.x].color).rgb,
        linear_texel(vertices[at.y].color).rgb,
        linear_texel(vertices[at.z].color).rgb,
    );
}

// Size of a pixel in coordinates of a texture, given those at the pixel, to its right and below.
fn footprint(uv: vec2<f32>, right: vec2<f32>, down: vec2<f32>) -> f32 {
    let dx = right - uv;
    let dy = down - uv;
    return sqrt(max(dx.x * dx.x + dx.y * dx.y, dy.x * dy.x + dy.y * dy.y));
}

// A colour with the saturation of the style.
fn strengthened(color: vec3<f32>) -> vec3<f32> {
    if compose.saturation == 1.0 { return color; }
    let luma = dot(color, LUMA);
    return max(vec3<f32>(luma) + (color - luma) * compose.saturation, vec3<f32>(0.0));
}
