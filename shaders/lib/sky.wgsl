// How much of the sky a place sees. Twin: npr_style::sky.
// The shader declares `view`, `lights`, `posed`, `triangles` and `texels`.

const SKY_HEADER_WORDS: u32 = 12u;
// Distance, in texels, that a place is moved along its normal before the look-up.
const LIFT_TEXELS: f32 = 1.5;

// A distance outwards, -1..1 in radii, in the units of the pictures' texels; 0 is kept for empty ones.
fn sky_height(outwards: f32) -> f32 {
    return (outwards + 1.0) * 0.5 * 65534.0 + 1.0;
}

// Three words of the texture store from `at` on, as floats.
fn floats(at: u32) -> vec3<f32> {
    return vec3<f32>(bitcast<f32>(texels[at]), bitcast<f32>(texels[at + 1u]), bitcast<f32>(texels[at + 2u]));
}

// How much of the sky a place of the frame sees, above and below, and how that changes over a pixel.
struct SkyPoint {
    here: vec2<f32>,
    right: vec2<f32>,
    down: vec2<f32>,
}

// How much of the sky is seen `offset` pixels to the right and down.
fn open_at(open: SkyPoint, offset: vec2<f32>) -> Openness {
    let moved = clamp(open.here + (open.right * offset.x + open.down * offset.y), vec2<f32>(0.0), vec2<f32>(1.0));
    return Openness(moved.x, moved.y);
}

// How much of the sky a triangle sees at a place of the frame.
fn openness(corners: Corners, px: vec2<f32>) -> SkyPoint {
    var open: SkyPoint;
    open.here = vec2<f32>(1.0);
    if lights.sky_views == 0u { return open; }
    let around = weights_around(corners.clip, ndc_at(view, px), pixel_ndc(view));
    let normal = normal_of(corners, around[0]);
    let world = world_of(corners, around[0]);
    let radius = lights.sky_radius;
    let lift = LIFT_TEXELS * 2.0 / f32(lights.sky_side);
    let place = (lifted(corners, around[0]) - lights.sky_center) / radius + normal * lift;
    let right = (world_of(corners, around[1]) - world) / radius;
    let down = (world_of(corners, around[2]) - world) / radius;
    let half_side = 0.5 * f32(lights.sky_side);
    var whole = vec2<f32>(0.0);
    open.here = vec2<f32>(0.0);
    for (var i = 0u; i < lights.sky_views; i++) {
        let header = lights.sky_maps + i * SKY_HEADER_WORDS;
        let outwards = floats(header + 8u);
        let facing = dot(normal, outwards);
        if facing <= 0.0 { continue; }
        let part = select(vec2<f32>(facing, 0.0), vec2<f32>(0.0, facing), texels[header + 11u] != 0u);
        let axis_x = floats(header);
        let axis_y = floats(header + 4u);
        let height = sky_height(dot(place, outwards));
        let seen = sky_seen(i, vec2<f32>(dot(place, axis_x), dot(place, axis_y)), height);
        whole += part;
        open.here += part * seen.x;
        open.right += part * (half_side * (seen.y * dot(right, axis_x) - seen.z * dot(right, axis_y)));
        open.down += part * (half_side * (seen.y * dot(down, axis_x) - seen.z * dot(down, axis_y)));
    }
    let any = whole > vec2<f32>(0.0);
    let scale = 1.0 / select(vec2<f32>(1.0), whole, any);
    open.here = select(vec2<f32>(1.0), open.here * scale, any);
    open.right *= scale;
    open.down *= scale;
    return open;
}

// Whether a place at a height sees the sky on one of the pictures, 0..1, and the change of that over a texel to the
// right and down.
fn sky_seen(picture: u32, at: vec2<f32>, height: f32) -> vec3<f32> {
    let side = f32(lights.sky_side);
    let x = (at.x + 1.0) * 0.5 * side - 0.5;
    let y = (1.0 - at.y) * 0.5 * side - 0.5;
    if !(x >= 0.0 && x < side - 1.0 && y >= 0.0 && y < side - 1.0) { return vec3<f32>(1.0, 0.0, 0.0); }
    let left_top = (picture * lights.sky_side + u32(y)) * lights.sky_side + u32(x);
    let left_low = left_top + lights.sky_side;
    let a = texel_seen(left_top, height);
    let b = texel_seen(left_top + 1u, height);
    let c = texel_seen(left_low, height);
    let d = texel_seen(left_low + 1u, height);
    let across = x - floor(x);
    let down = y - floor(y);
    let upper = a + (b - a) * across;
    let lower = c + (d - c) * across;
    let by_x = (b - a) * (1.0 - down) + (d - c) * down;
    return vec3<f32>(upper + (lower - upper) * down, by_x, lower - upper);
}

// 1 where the scene reaches no farther outwards than a height at a texel of the pictures, else 0.
fn texel_seen(texel: u32, height: f32) -> f32 {
    let first = lights.sky_maps + lights.sky_views * SKY_HEADER_WORDS;
    let reach = (texels[first + texel / 2u] >> (16u * (texel % 2u))) & 0xffffu;
    return select(1.0, 0.0, f32(reach) > height);
}
