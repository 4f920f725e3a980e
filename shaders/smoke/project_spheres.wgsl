// smoke.project_spheres: every sphere as an eye or a light sees it.
//
// Not drawn: spheres without size, with NaN, behind the eye, or around the eye.
//
// Twin    npr_style::smoke::draw::project_spheres
//
//# use lib/grid
//# use lib/geometry
//# use lib/sphere

@group(0) @binding(0) var<uniform> lens: SphereView;
@group(0) @binding(1) var<storage, read> spheres: array<Sphere>;
@group(0) @binding(2) var<storage, read_write> balls: array<ViewSphere>;

// Greatest distance from the eye at which a sphere is drawn.
const REACH: f32 = 1e15;
// A normalised coordinate beyond any frame.
const BEYOND: f32 = 4.0;

// Lowest and highest normalised coordinate along an axis: where planes through the eye touch the ball.
fn reach(across: f32, along: f32, radius: f32, half: f32) -> vec2<f32> {
    if lens.perspective < 0.5 { return vec2<f32>((across - radius) / half, (across + radius) / half); }
    if along <= radius * 1.0001 { return vec2<f32>(-BEYOND, BEYOND); }
    let reach = sqrt(max(across * across + along * along - radius * radius, 0.0));
    let over = 1.0 / ((along * along - radius * radius) * half);
    return vec2<f32>((across * along - radius * reach) * over, (across * along + radius * reach) * over);
}

fn px(v: f32, length: f32) -> f32 {
    return clamp(v * 0.5 * length, -1.0, length + 1.0);
}

fn project(sphere: Sphere) -> ViewSphere {
    var ball: ViewSphere;
    ball.bounds = vec4<f32>(1.0, 1.0, 0.0, 0.0);
    let offset = sphere.center - lens.eye_world;
    let center = vec3<f32>(
        dot(offset, lens.right_world),
        dot(offset, lens.up_world),
        dot(offset, lens.forward_world),
    );
    let radius = sphere.radius;
    let square = dot(center, center);
    let is_sound = radius > 0.0 && radius < REACH && square < REACH * REACH;
    let around_eye = lens.perspective > 0.5 && square <= radius * radius;
    if !is_sound || around_eye || center.z + radius <= lens.near { return ball; }
    let x = reach(center.x, center.z, radius, lens.half.x);
    let y = reach(center.y, center.z, radius, lens.half.y);
    ball.center = center;
    ball.radius = radius;
    ball.bounds = vec4<f32>(
        px(x.x + 1.0, lens.frame_px.x),
        px(1.0 - y.y, lens.frame_px.y),
        px(x.y + 1.0, lens.frame_px.x),
        px(1.0 - y.x, lens.frame_px.y),
    );
    return ball;
}

// One invocation per sphere.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&spheres) { return; }
    balls[element] = project(spheres[element]);
}
