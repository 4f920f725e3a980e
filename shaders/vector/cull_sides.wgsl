// vector.cull_sides: keeps the sides at which a loop runs in the direction of the contour.
//
// Source  Jiang et al. 2022, orientation culling
// Twin    npr_vector::pixel_strokes::strip::cull_sides
//
//# use lib/grid
//# use lib/looped

@group(0) @binding(0) var<uniform> rule: CullRule;
@group(0) @binding(1) var<storage, read> tangents: array<Planar>;
@group(0) @binding(2) var<storage, read> directions: array<Planar>;
@group(0) @binding(3) var<storage, read> kept_in: array<u32>;
@group(0) @binding(4) var<storage, read_write> kept_out: array<u32>;

// One invocation per side.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&kept_in) { return; }

    let tangent = tangents[element];
    let direction = directions[element];
    let cosine = tangent.x * direction.x + tangent.y * direction.y;
    kept_out[element] = select(0u, 1u, kept_in[element] != 0u && cosine > rule.least_cos);
}
