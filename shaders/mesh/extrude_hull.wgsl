// mesh.extrude_hull: vertices pushed outwards by the line width.
//
// Drawn with only its backs showing, this hull leaves a rim around the shape. It
// grows along normals averaged over welded positions, so it has no cracks at hard edges.
//
// Source  the inverted hull of Matsuo et al. 2013, the method compared with in Okuya et al. 2016
// Twin    npr_mesh::hull::extrude
//
//# use lib/grid
//# use lib/geometry
//# use lib/unit
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(2) var<storage, read> influences: array<Influence>;
@group(0) @binding(3) var<storage, read> palette: array<mat4x4<f32>>;
@group(0) @binding(4) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(5) var<storage, read_write> hull: array<vec4<f32>>;

//# use lib/pose

// One invocation per vertex.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&vertices) { return; }

    let m = blended_matrix(influences[element]);
    let normal = apply_normal(m, unpack_unit(vertices[element].weld_normal));
    let vertex = posed[element];
    let width = 2.0 * vertex.half_width * world_per_pixel(view, max(vertex.depth, view.near));
    hull[element] = apply_point(view.clip_from_world, vertex.world + normal * width);
}
