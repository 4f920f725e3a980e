// mesh.project_shadow: posed vertices as a light with shadows sees them.
//
// Twin    npr_mesh::project::project
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface

@group(0) @binding(0) var<uniform> light_from_world: mat4x4<f32>;
@group(0) @binding(1) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(2) var<storage, read_write> projected: array<vec4<f32>>;

// One invocation per vertex.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&posed) { return; }

    projected[element] = apply_point(light_from_world, posed[element].world);
}
