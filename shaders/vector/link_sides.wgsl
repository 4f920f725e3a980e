// vector.link_sides: links every side of ink to the sides before and after it.
//
// Two pixels ahead decide: pixels of ink that touch at a corner count as joined.
//
// Source  Selinger 2003, path decomposition; Jiang et al. 2022
// Twin    npr_vector::pixel_strokes::side::link_sides
//
//# use lib/grid
//# use lib/list
//# use lib/ink
//# use lib/pixel

@group(0) @binding(0) var<storage, read> extent: array<u32>;
@group(0) @binding(1) var ink: texture_2d<u32>;
@group(0) @binding(2) var nearest: texture_depth_2d;
@group(0) @binding(3) var<storage, read> segments: array<Segment>;
@group(0) @binding(4) var<storage, read> masks: array<u32>;
@group(0) @binding(5) var<storage, read> starts: array<u32>;
@group(0) @binding(6) var<storage, read_write> sides: array<Side>;
@group(0) @binding(7) var<storage, read_write> links: array<Link>;

//# use lib/holder

// The place of the set bit of a mask before which `rank` others are set.
fn nth_bit(mask: u32, rank: u32) -> u32 {
    var left = mask;
    for (var round = 0u; round < rank; round++) { left &= left - 1u; }
    return countTrailingZeros(left);
}

fn index_of(at: vec2<i32>, direction: u32) -> u32 {
    let pixel = u32(at.y) * textureDimensions(ink).x + u32(at.x);
    let word = pixel / PIXELS_A_WORD;
    let before = masks[word] & ((1u << (4u * (pixel % PIXELS_A_WORD) + direction)) - 1u);
    return starts[word] + countOneBits(before);
}

// The side that follows where one ends (turn 3); with a sign of -1 and turn 1, the side that ends where it starts.
fn neighbour(at: vec2<i32>, direction: u32, sign: i32, turn: u32) -> u32 {
    let along = ahead_of(direction) * sign;
    let beside = at + along + outward(direction);
    if ink_at(ink, beside) { return index_of(beside, (direction + turn) & 3u); }
    if ink_at(ink, at + along) { return index_of(at + along, direction); }
    return index_of(at, (direction + 4u - turn) & 3u);
}

// The bits of two 16-bit numbers interleaved, those of the first lowest.
fn spread(number: u32) -> u32 {
    var v = number & 0xffffu;
    v = (v | (v << 8u)) & 0x00ff00ffu;
    v = (v | (v << 4u)) & 0x0f0f0f0fu;
    v = (v | (v << 2u)) & 0x33333333u;
    return (v | (v << 1u)) & 0x55555555u;
}

// The number from which mix_bits makes this one.
fn unmix_bits(number: u32) -> u32 {
    var x = number;
    x = (x ^ (x >> 16u)) * 0x43021123u;
    x = (x ^ (x >> 15u) ^ (x >> 30u)) * 0x1d69e2a5u;
    return x ^ (x >> 16u);
}

// One invocation per side.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&sides) { return; }

    sides[element] = Side();
    links[element].next = element;
    links[element].prev = element;
    links[element].key = 0u;
    if element >= extent[0] { return; }
    let word = holder_of(element, arrayLength(&starts));
    let bit = nth_bit(masks[word], element - starts[word]);
    let pixel = PIXELS_A_WORD * word + bit / 4u;
    let direction = bit & 3u;
    let at = pixel_of(pixel, textureDimensions(ink));
    let number = textureLoad(ink, at, 0).r - 1u;
    let segment = segments[number];
    sides[element].code = 4u * pixel + direction;
    sides[element].segment = number;
    sides[element].nearest = bitcast<u32>(textureLoad(nearest, at, 0));
    sides[element].extent.x = segment.end.x - segment.start.x;
    sides[element].extent.y = segment.end.y - segment.start.y;
    links[element].next = neighbour(vec2<i32>(at), direction, 1, 3u);
    links[element].prev = neighbour(vec2<i32>(at), direction, -1, 1u);
    let code = spread(2u * at.x + (direction >> 1u)) | (spread(2u * at.y + (direction & 1u)) << 1u);
    links[element].key = unmix_bits(~code);
}
