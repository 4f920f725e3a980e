// How much of the sky a place sees. Twin: npr_style::sky.
// The shader declares `lights`, `posed`, `triangles` and `texels`.

const SKY_HEADER_WORDS: u32 = 12u;
// How far a place is moved along its normal before it is looked up, in texels.
const LIFT_TEXELS: f32 = 1.5;

// A distance outwards, -1..1 in radii, as the texels of pictures hold it; 0 is kept for nothing.
fn sky_height(outwards: f32) -> f32 {
    return (outwards + 1.0) * 0.5 * 65534.0 + 1.0;
}

// Three words of the texture store as numbers.
fn floats(at: u32) -> vec3<f32> {
    return vec3<f32>(bitcast<f32>(texels[at]), bitcast<f32>(texels[at + 1u]), bitcast<f32>(texels[at + 2u]));
}

// How much of the sky a place of a triangle sees.
fn openness(corners: Corners, weights: vec3<f32>) -> Openness {
    var open: Openness;
    open.above = 1.0;
    open.below = 1.0;
    if lights.sky_views == 0u { return open; }
    let normal = normal_of(corners, weights);
    let lift = LIFT_TEXELS * 2.0 / f32(lights.sky_side);
    let place = (lifted(corners, weights) - lights.sky_center) / lights.sky_radius + normal * lift;
    var whole = vec2<f32>(0.0);
    var seen = vec2<f32>(0.0);
    for (var i = 0u; i < lights.sky_views; i++) {
        let header = lights.sky_maps + i * SKY_HEADER_WORDS;
        let outwards = floats(header + 8u);
        let facing = dot(normal, outwards);
        if facing <= 0.0 { continue; }
        let at = vec2<f32>(dot(place, floats(header)), dot(place, floats(header + 4u)));
        let here = facing * sky_seen(i, at, sky_height(dot(place, outwards)));
        if texels[header + 11u] == 0u {
            whole.x += facing;
            seen.x += here;
        } else {
            whole.y += facing;
            seen.y += here;
        }
    }
    if whole.x > 0.0 { open.above = seen.x / whole.x; }
    if whole.y > 0.0 { open.below = seen.y / whole.y; }
    return open;
}

// 1 where the scene reaches no farther outwards than a height at a texel of the pictures, else 0.
fn texel_seen(texel: u32, height: f32) -> f32 {
    let first = lights.sky_maps + lights.sky_views * SKY_HEADER_WORDS;
    let reach = (texels[first + texel / 2u] >> (16u * (texel % 2u))) & 0xffffu;
    return select(1.0, 0.0, f32(reach) > height);
}

// How far a place at a height sees the sky on one of the pictures, 0..1.
fn sky_seen(picture: u32, at: vec2<f32>, height: f32) -> f32 {
    let side = f32(lights.sky_side);
    let x = (at.x + 1.0) * 0.5 * side - 0.5;
    let y = (1.0 - at.y) * 0.5 * side - 0.5;
    if !(x >= 0.0 && x < side - 1.0 && y >= 0.0 && y < side - 1.0) { return 1.0; }
    let left_top = (picture * lights.sky_side + u32(y)) * lights.sky_side + u32(x);
    let across = x - floor(x);
    let down = y - floor(y);
    let upper = texel_seen(left_top, height) * (1.0 - across) + texel_seen(left_top + 1u, height) * across;
    let left_low = left_top + lights.sky_side;
    let lower = texel_seen(left_low, height) * (1.0 - across) + texel_seen(left_low + 1u, height) * across;
    return upper * (1.0 - down) + lower * down;
}
