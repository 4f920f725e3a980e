// The view of a frame, and pixel grids over it. Twin: npr_core::window.

struct View {
    clip_from_world: mat4x4<f32>,
    eye_world: vec3<f32>,
    perspective: f32,
    forward_world: vec3<f32>,
    view_height: f32,
    frame_px: vec2<f32>,
    near: f32,
    unused: f32,
}

struct Window {
    ndc_scale: vec2<f32>,
    ndc_offset: vec2<f32>,
    size: vec2<u32>,
    frame_step: vec2<f32>,
    frame_origin: vec2<f32>,
    unused: vec2<u32>,
}

fn height_at(view: View, depth: f32) -> f32 {
    return select(view.view_height, view.view_height * depth, view.perspective > 0.5);
}

fn world_per_pixel(view: View, depth: f32) -> f32 {
    return height_at(view, depth) / view.frame_px.y;
}

// 1 at the near plane, falling with depth to 0; a half in a parallel view.
fn nearness_of(view: View, depth: f32) -> f32 {
    return select(0.5, view.near / max(depth, view.near), view.perspective > 0.5);
}

// The reversed depth of a view depth: 1 on the near plane, less behind it.
fn reversed_of(view: View, depth: f32) -> f32 {
    if view.perspective > 0.5 { return view.near / depth; }
    let row = vec3<f32>(view.clip_from_world[0].z, view.clip_from_world[1].z, view.clip_from_world[2].z);
    return 1.0 + dot(row, view.forward_world) * (depth - view.near);
}

// A reversed depth moved towards the eye by a share of the view depth, at most half of it; in parallel view, by world
// units.
fn brought_nearer(view: View, reversed: f32, room: f32) -> f32 {
    if view.perspective > 0.5 { return reversed / (1.0 - min(room, 0.5)); }
    return reversed + reversed_of(view, view.near - room) - 1.0;
}

fn plane_coordinate(view: View, depth: f32) -> f32 {
    return select(depth, 1.0 / depth, view.perspective > 0.5);
}

// The depth of a plane coordinate; FAR_DEPTH if the plane has passed the horizon.
fn depth_of_coordinate(view: View, coordinate: f32) -> f32 {
    if view.perspective < 0.5 { return coordinate; }
    return select(1e30, 1.0 / coordinate, coordinate > 1e-30);
}

// Depth change over one pixel of a grid, in sizes of that pixel: the tangent of the angle to the picture.
fn slope_of(view: View, window: Window, depth: f32, plane_step: vec2<f32>) -> f32 {
    let step = sqrt(plane_step.x * plane_step.x + plane_step.y * plane_step.y);
    let pixel = view.view_height * window.frame_step.y / view.frame_px.y;
    return select(step, step * depth, view.perspective > 0.5) / pixel;
}

fn to_eye(view: View, world: vec3<f32>) -> vec3<f32> {
    if view.perspective < 0.5 { return -view.forward_world; }
    let d = view.eye_world - world;
    let length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    return d / max(length, 1e-30);
}

fn ndc_at(view: View, frame_px: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(
        2.0 * frame_px.x / view.frame_px.x - 1.0,
        1.0 - 2.0 * frame_px.y / view.frame_px.y,
    );
}

// A pixel to the right and one down, in normalised device coordinates.
fn pixel_ndc(view: View) -> vec2<f32> {
    return vec2<f32>(2.0 / view.frame_px.x, -2.0 / view.frame_px.y);
}

fn clip_here(window: Window, clip: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(
        clip.x * window.ndc_scale.x + clip.w * window.ndc_offset.x,
        clip.y * window.ndc_scale.y + clip.w * window.ndc_offset.y,
        clip.z,
        clip.w,
    );
}

// Normalised device coordinates of the centre of a grid pixel, in the grid's own view.
fn ndc_of(window: Window, pixel: vec2<u32>) -> vec2<f32> {
    let at = (vec2<f32>(pixel) + 0.5) / vec2<f32>(window.size);
    return vec2<f32>(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y);
}

fn frame_at(window: Window, pixel: vec2<u32>) -> vec2<f32> {
    return window.frame_origin + (vec2<f32>(pixel) + 0.5) * window.frame_step;
}

fn pixel_at(window: Window, frame_px: vec2<f32>) -> vec2<u32> {
    let at = floor((frame_px - window.frame_origin) / window.frame_step);
    return vec2<u32>(clamp(at, vec2<f32>(0.0), vec2<f32>(window.size) - 1.0));
}
