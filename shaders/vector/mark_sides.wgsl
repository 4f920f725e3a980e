// vector.mark_sides: the sides of every eight pixels, a bit for each direction of each, and how many there are.
//
// Source  Selinger 2003, path decomposition; Jiang et al. 2022
// Twin    npr_vector::pixel_strokes::side::mark_sides
//
//# use lib/grid
//# use lib/ink

@group(0) @binding(0) var ink: texture_2d<u32>;
@group(0) @binding(1) var<storage, read_write> masks: array<u32>;
@group(0) @binding(2) var<storage, read_write> counts: array<u32>;

// Whether a pixel has ink, by its number in rows; pixels before the first row and after the last have none.
fn is_inked(pixel: i32, size: vec2<i32>) -> bool {
    if pixel < 0 || pixel >= size.x * size.y { return false; }
    return textureLoad(ink, vec2<i32>(pixel % size.x, pixel / size.x), 0).r != 0u;
}

// One invocation per word: rows of ink are bits, and shifts of them are neighbours.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&masks) { return; }

    let size = vec2<i32>(textureDimensions(ink));
    let first = i32(element * PIXELS_A_WORD);
    var mask = 0u;
    var is_before = is_inked(first - 1, size);
    var is_here = is_inked(first, size);
    for (var place = 0u; place < PIXELS_A_WORD; place++) {
        let pixel = first + i32(place);
        let column = pixel % size.x;
        let is_after = is_inked(pixel + 1, size);
        let up = select(1u, 0u, is_inked(pixel - size.x, size));
        let right = select(2u, 0u, is_after && column + 1 < size.x);
        let down = select(4u, 0u, is_inked(pixel + size.x, size));
        let left = select(8u, 0u, is_before && column > 0);
        if is_here { mask |= (up | right | down | left) << (4u * place); }
        is_before = is_here;
        is_here = is_after;
    }
    masks[element] = mask;
    counts[element] = countOneBits(mask);
}
