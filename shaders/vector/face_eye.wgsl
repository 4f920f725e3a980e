// vector.face_eye: whether each face is turned to the eye.
//
// Whether a face is front is decided on its judge, another face if it has no area itself. Signs come from sums,
// differences and products that are rounded one by one, so both engines decide alike.
//
// Source  Jiang et al. 2022, contour extraction
// Twin    npr_vector::mesh_lines::contour::steps::face_eye
//
//# use lib/grid
//# use lib/curve

@group(0) @binding(0) var<uniform> viewer: Viewer;
@group(0) @binding(1) var<storage, read> positions: array<f32>;
@group(0) @binding(2) var<storage, read> corners: array<u32>;
@group(0) @binding(3) var<storage, read> judges: array<u32>;
@group(0) @binding(4) var<storage, read_write> front: array<u32>;

fn corner(index: u32) -> vec3<f32> {
    let at = 3u * corners[index];
    return vec3<f32>(positions[at], positions[at + 1u], positions[at + 2u]);
}

// One invocation per face.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&judges) { return; }

    let judge = judges[element];
    var is_front = false;
    if judge != NONE {
        let first = 3u * judge;
        is_front = height_over(viewer, corner(first), corner(first + 1u), corner(first + 2u)) > 0.0;
    }
    front[element] = select(0u, 1u, is_front);
}
