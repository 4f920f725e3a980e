// vector.mark_sides: the sides of every pixel, a bit for each direction, and how many there are.
//
// Source  Selinger 2003, path decomposition; Jiang et al. 2022
// Twin    npr_vector::pixel_strokes::side::mark_sides
//
//# use lib/grid
//# use lib/ink

override WG: u32 = 64u;

@group(0) @binding(0) var ink: texture_2d<u32>;
@group(0) @binding(1) var<storage, read_write> masks: array<u32>;
@group(0) @binding(2) var<storage, read_write> counts: array<u32>;

// One invocation per pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&masks) { return; }

    let at = vec2<i32>(pixel_of(element, textureDimensions(ink)));
    var mask = 0u;
    if ink_at(ink, at) {
        for (var direction = 0u; direction < 4u; direction++) {
            let is_side = !ink_at(ink, at + outward(direction));
            mask |= select(0u, 1u, is_side) << direction;
        }
    }
    masks[element] = mask;
    counts[element] = countOneBits(mask);
}
