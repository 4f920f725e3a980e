// Spheres of smoke, and the lens that sees them. Twin: npr_core::smoke.

struct Sphere {
    center: vec3<f32>,
    radius: f32,
    heat: f32,
    unused: f32,
    unused_b: vec2<f32>,
}

struct ViewSphere {
    center: vec3<f32>,
    radius: f32,
    bounds: vec4<f32>,
}

struct SmokePixel {
    tone: f32,
    depth: f32,
    place: f32,
    unused: f32,
}

struct SphereView {
    eye_world: vec3<f32>,
    perspective: f32,
    right_world: vec3<f32>,
    near: f32,
    up_world: vec3<f32>,
    depth_start: f32,
    forward_world: vec3<f32>,
    depth_step: f32,
    half: vec2<f32>,
    frame_px: vec2<f32>,
    discs: f32,
    unused: f32,
    unused_b: vec2<f32>,
}

// Ray through a frame position, to the right and up: per unit of depth in perspective, else in world units.
fn ray_at(lens: SphereView, frame_px: vec2<f32>) -> vec2<f32> {
    let x = 2.0 * frame_px.x / lens.frame_px.x - 1.0;
    let y = 1.0 - 2.0 * frame_px.y / lens.frame_px.y;
    return vec2<f32>(x * lens.half.x, y * lens.half.y);
}

// The frame position of a place seen from the eye.
fn frame_of(lens: SphereView, place: vec3<f32>) -> vec2<f32> {
    let depth = select(1.0, place.z, lens.perspective > 0.5);
    return vec2<f32>(
        (place.x / (depth * lens.half.x) + 1.0) * 0.5 * lens.frame_px.x,
        (1.0 - place.y / (depth * lens.half.y)) * 0.5 * lens.frame_px.y,
    );
}

// The place at a depth of a ray, from the eye.
fn place_on(lens: SphereView, ray: vec2<f32>, depth: f32) -> vec3<f32> {
    let spread = select(1.0, depth, lens.perspective > 0.5);
    return vec3<f32>(ray * spread, depth);
}

fn direction_in_world(lens: SphereView, v: vec3<f32>) -> vec3<f32> {
    return lens.right_world * v.x + lens.up_world * v.y + lens.forward_world * v.z;
}

// View depth at which a ray first meets a ball; FAR_DEPTH if it misses the ball or starts inside.
fn depth_of_ball(lens: SphereView, ball: ViewSphere, ray: vec2<f32>) -> f32 {
    if lens.discs > 0.5 { return depth_of_disc(lens, ball, ray); }
    let meeting = lens.perspective;
    let x = ray.x * meeting;
    let y = ray.y * meeting;
    let parallel = 1.0 - meeting;
    let offset = vec3<f32>(ball.center.xy - ray * parallel, ball.center.z);
    let scale = 1.0 / (x * x + y * y + 1.0);
    let middle = (offset.x * x + offset.y * y + offset.z) * scale;
    let beside = vec3<f32>(offset.x - middle * x, offset.y - middle * y, offset.z - middle);
    let left = ball.radius * ball.radius - (beside.x * beside.x + beside.y * beside.y + beside.z * beside.z);
    let depth = middle - sqrt(max(left, 0.0) * scale);
    return select(FAR_DEPTH, depth, left > 0.0 && depth >= lens.near);
}

fn depth_of_disc(lens: SphereView, ball: ViewSphere, ray: vec2<f32>) -> f32 {
    let at = place_on(lens, ray, ball.center.z).xy - ball.center.xy;
    let is_inside = at.x * at.x + at.y * at.y < ball.radius * ball.radius;
    return select(FAR_DEPTH, ball.center.z, is_inside && ball.center.z >= lens.near);
}

// Size of a frame pixel in world units at a view depth.
fn lens_pixel_at(lens: SphereView, depth: f32) -> f32 {
    return 2.0 * lens.half.y * select(1.0, depth, lens.perspective > 0.5) / lens.frame_px.y;
}

// Reversed depth at a view depth.
fn reversed_depth(lens: SphereView, depth: f32) -> f32 {
    return (lens.depth_start + lens.depth_step * depth) / select(1.0, depth, lens.perspective > 0.5);
}
