// vector.mark_sides: the sides of every eight pixels, a bit for each direction of each, and how many there are.
//
// Source  Selinger 2003, path decomposition; Jiang et al. 2022
// Twin    npr_vector::pixel_strokes::side::mark_sides
//
//# use lib/grid
//# use lib/ink
//# use lib/pixel

@group(0) @binding(0) var<uniform> view: PixelView;
@group(0) @binding(1) var<storage, read> ink: array<u32>;
@group(0) @binding(2) var<storage, read_write> masks: array<u32>;
@group(0) @binding(3) var<storage, read_write> counts: array<u32>;

// A word of ink; there is none before the picture and after it.
fn word_at(index: i32) -> u32 {
    if index < 0 || u32(index) >= arrayLength(&ink) { return 0u; }
    return ink[index];
}

// The ink of the pixels from a number in rows on, that of the first lowest: eight bits at least.
fn ink_from(pixel: i32) -> u32 {
    let word = pixel >> 5u;
    let shift = u32(pixel) % BITS_A_WORD;
    return (word_at(word) >> shift) | select(0u, word_at(word + 1) << (BITS_A_WORD - shift), shift != 0u);
}

// One invocation per word: shifts of a row of ink are neighbours.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&masks) { return; }

    masks[element] = 0u;
    counts[element] = 0u;
    let first = element * PIXELS_A_WORD;
    let here = ink[first / BITS_A_WORD] >> (first % BITS_A_WORD) & 0xffu;
    if here == 0u { return; }

    let width = view.size.x;
    let up = ink_from(i32(first) - i32(width));
    let right = ink_from(i32(first) + 1);
    let down = ink_from(i32(first + width));
    let left = ink_from(i32(first) - 1);
    var mask = 0u;
    for (var place = 0u; place < PIXELS_A_WORD; place++) {
        let column = (first + place) % width;
        let beside = vec4<u32>(up, right, down, left) >> vec4<u32>(place) & vec4<u32>(1u);
        let is_inside = vec4<bool>(true, column + 1u < width, true, column > 0u);
        let sides = dot(select(vec4<u32>(1u), 1u - beside, is_inside), vec4<u32>(1u, 2u, 4u, 8u));
        mask |= (sides * (here >> place & 1u)) << (4u * place);
    }
    masks[element] = mask;
    counts[element] = countOneBits(mask);
}
