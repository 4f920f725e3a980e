// Outlines of spheres, found from the spheres' silhouettes. Twin: npr_style::smoke::line.
// The shader declares `window`, `lens`, `look`, `smoke_ids`, `balls` and `pixels`.

// Distance beyond a silhouette at which the picture is looked at, in pixels.
const BEYOND_PX: f32 = 1.25;
// Multiples of the least jump at which a line is as wide as lines inside the smoke get, and as the outer line.
const INNER_JUMP: f32 = 4.0;
const OUTER_JUMP: f32 = 16.0;
// Greatest width of a puff's line, in radii of the puff.
const THICKEST: f32 = 0.2;
// Length over which lines run out along the silhouette, in line widths, and looks beyond it on each side over that
// length.
const TAPER: f32 = 3.0;
const LOOKS: u32 = 8u;

// A point of a sphere's silhouette.
struct Silhouette {
    px: vec2<f32>,
    outward: vec2<f32>,
    depth: f32,
}

// The silhouette of a ball in a direction.
struct Disc {
    first: vec3<f32>,
    second: vec3<f32>,
    middle: vec3<f32>,
    across: f32,
    middle_px: vec2<f32>,
}

fn disc_of(ball: ViewSphere, ray: vec2<f32>) -> Disc {
    var disc: Disc;
    var axis = vec3<f32>(0.0, 0.0, 1.0);
    var towards: vec3<f32>;
    if lens.perspective > 0.5 && lens.discs < 0.5 {
        let square = dot(ball.center, ball.center);
        let distance = sqrt(square);
        axis = ball.center / distance;
        towards = vec3<f32>(ray, 1.0);
        // Rays from the eye touch the sphere in a circle a little nearer and narrower than its own.
        let shrunk = max(1.0 - ball.radius * ball.radius / square, 0.0);
        disc.middle = axis * (distance * shrunk);
        disc.across = ball.radius * sqrt(shrunk);
    } else {
        let place = place_on(lens, ray, ball.center.z);
        towards = vec3<f32>(place.xy - ball.center.xy, 0.0);
        disc.middle = ball.center;
        disc.across = ball.radius;
    }
    disc.first = unit_or_z(towards - axis * dot(towards, axis));
    disc.second = cross(axis, disc.first);
    disc.middle_px = frame_of(lens, ball.center);
    return disc;
}

// The point of the silhouette at an angle from the ray, given by its sine and cosine.
fn silhouette_of(disc: Disc, sine: f32, cosine: f32) -> Silhouette {
    let place = disc.middle + (disc.first * cosine + disc.second * sine) * disc.across;
    var silhouette: Silhouette;
    silhouette.px = frame_of(lens, place);
    let out = silhouette.px - disc.middle_px;
    silhouette.outward = out / max(sqrt(out.x * out.x + out.y * out.y), 1e-12);
    silhouette.depth = place.z;
    return silhouette;
}

fn distance_px(a: vec2<f32>, b: vec2<f32>) -> f32 {
    let d = a - b;
    return sqrt(d.x * d.x + d.y * d.y);
}

// How much of a pixel a line covers that reaches inwards from the silhouette by `width`, where the pixel's middle lies
// `away` from it.
fn line_coverage(width: f32, away: f32) -> f32 {
    return clamp(width - away + 0.5, 0.0, 1.0) * min(width, 1.0);
}

// Width of a line at a jump in depth, in radii, as a part of the whole.
fn line_part_at(jump: f32) -> f32 {
    let start = look.line_from;
    let inner = smooth_step(start, start * INNER_JUMP, jump);
    let outer = smooth_step(start * INNER_JUMP, start * OUTER_JUMP, jump);
    if jump <= 0.0 { return 0.0; }
    return look.line_inner * inner + (1.0 - look.line_inner) * outer;
}

// Width of the outer line of a puff.
fn whole_line_width(outward: vec2<f32>, radius_px: f32) -> f32 {
    let facing = outward.x * look.towards_light.x - outward.y * look.towards_light.y;
    return min(look.line_px, THICKEST * radius_px) * (1.0 - look.swell * facing);
}

// Width of a sphere's outline at a point of its silhouette, as a part of the whole, by the picture beyond; 0 if that
// point is hidden.
fn part_beyond(ball: ViewSphere, silhouette: Silhouette) -> f32 {
    let beyond = silhouette.px + silhouette.outward * BEYOND_PX * window.frame_step;
    let pixel = pixel_at(window, beyond);
    let depth = pixels[pixel.y * window.size.x + pixel.x].depth;
    return line_part_at((depth - silhouette.depth) / ball.radius);
}

// Whether a ray certainly passes farther than `reach_px` inside the silhouette of a ball.
fn is_far_inside(ball: ViewSphere, ray: vec2<f32>, reach_px: f32) -> bool {
    let room = lens_pixel_at(lens, ball.center.z + ball.radius) * reach_px;
    let start = place_on(lens, ray, 0.0);
    let towards = place_on(lens, ray, 1.0) - start;
    let offset = ball.center - start;
    let middle = dot(offset, towards) / dot(towards, towards);
    let beside = offset - towards * middle;
    let inner = max(ball.radius - room, 0.0);
    return dot(beside, beside) < inner * inner;
}

// How much the outline of sphere `id` covers of a position of the frame within its image, 0..1.
fn line_at(id: u32, frame_px: vec2<f32>) -> f32 {
    let ball = balls[id - 1u];
    let widest = look.line_px * (1.0 + look.swell);
    let ray = ray_at(lens, frame_px);
    if is_far_inside(ball, ray, widest + 0.5) { return 0.0; }
    let disc = disc_of(ball, ray);
    let silhouette = silhouette_of(disc, 0.0, 1.0);
    let away = max(dot(silhouette.px - frame_px, silhouette.outward), 0.0);
    let radius_px = distance_px(silhouette.px, disc.middle_px);
    let whole = whole_line_width(silhouette.outward, radius_px);
    var part = part_beyond(ball, silhouette);
    // Let lines nearby run out to here.
    let step = TAPER * look.line_px / (f32(LOOKS + 1u) * max(radius_px, 1.0));
    for (var k = 1u; k <= LOOKS; k++) {
        let left = 1.0 - f32(k) / f32(LOOKS + 1u);
        // Usual case: even the widest line adds nothing from here on.
        if left <= part || whole * left + 0.5 <= away { break; }
        let sine = min(f32(k) * step, 0.7);
        let cosine = sqrt(1.0 - sine * sine);
        part = max(part, left * part_beyond(ball, silhouette_of(disc, -sine, cosine)));
        part = max(part, left * part_beyond(ball, silhouette_of(disc, sine, cosine)));
    }
    return line_coverage(whole * part, away);
}

// Depth of a pixel for the published line: 0 at the front of the smoke, 1 at its back and behind it.
fn published_depth(pixel: vec2<i32>) -> f32 {
    let depth = pixels[texel_near(pixel, vec2<i32>(0))].depth;
    if depth >= FAR_DEPTH { return 1.0; }
    return clamp((depth - look.depth_start) / look.depth_size, 0.0, 1.0);
}

// The published line: 1 where depths of diagonal neighbours differ.
fn published_line(pixel: vec2<i32>) -> f32 {
    let a = published_depth(pixel + vec2<i32>(-1, 1)) - published_depth(pixel + vec2<i32>(1, -1));
    let b = published_depth(pixel + vec2<i32>(-1, -1)) - published_depth(pixel + vec2<i32>(1, 1));
    return clamp(look.line_weight * (a * a + b * b), 0.0, 1.0);
}
