//! A real export: texture and normal seams split three quarters of its vertices.

use std::path::Path;

use npr_mesh::edges::{sanity_check, unique_edges};
use npr_mesh::{EdgeFlags, Mesh, curvature, smooth_normals, weld};

/// The mesh of `suzanne.glb` from the shared models, if they are there.
fn suzanne() -> Option<Mesh> {
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets/models");
    let Ok(file) = std::fs::read(models.join("suzanne.glb")) else {
        eprintln!("skipped: no shared models");
        return None;
    };
    let json_size = u32::from_le_bytes(bytes(&file, 12)) as usize;
    let (json, binary) = (&file[20..20 + json_size], &file[28 + json_size..]);
    let json = serde_json::from_slice(json).expect("the model's JSON parses");

    let coordinate = |start: usize| f32::from_le_bytes(bytes(binary, start));
    let positions = rows(&json, 1, 12).map(|row| [row, row + 4, row + 8].map(coordinate));
    let indices: Vec<u32> = rows(&json, 0, 2)
        .map(|row| u32::from(u16::from_le_bytes(bytes(binary, row))))
        .collect();
    let triangles = indices.as_chunks().0.to_vec();
    Some(Mesh::new(positions.collect(), triangles).expect("the model is sound"))
}

/// Where each element of an accessor starts in the binary part; `size` is that of one element.
fn rows(
    json: &serde_json::Value,
    accessor: usize,
    size: usize,
) -> impl Iterator<Item = usize> + use<> {
    let number = |value: &serde_json::Value, default| match value.as_u64() {
        Some(number) => number as usize,
        None => default,
    };
    let accessor = &json["accessors"][accessor];
    let view = &json["bufferViews"][number(&accessor["bufferView"], 0)];
    let start = number(&view["byteOffset"], 0) + number(&accessor["byteOffset"], 0);
    let stride = number(&view["byteStride"], size);
    (0..number(&accessor["count"], 0)).map(move |row| start + row * stride)
}

fn bytes<const N: usize>(file: &[u8], start: usize) -> [u8; N] {
    std::array::from_fn(|i| file[start + i])
}

#[test]
fn seams_weld_away() {
    let Some(mesh) = suzanne() else { return };
    assert_eq!(mesh.positions().len(), 11_808);
    assert_eq!(weld(mesh.positions(), 0.0).count(), 2_012);
    assert_eq!(weld(mesh.positions(), 1e-6).count(), 2_012);
}

#[test]
fn only_true_borders_are_left() {
    let Some(mesh) = suzanne() else { return };
    let welded = weld(mesh.positions(), 0.0);
    let edges = unique_edges(mesh.positions(), mesh.triangles(), &welded, &[]);
    sanity_check(&edges, mesh.triangles(), &welded);
    let with = |flag| {
        edges
            .iter()
            .filter(|edge| edge.flags.contains(flag))
            .count()
    };
    // Counted by a separate script: the rims of the eye sockets.
    assert_eq!(with(EdgeFlags::BOUNDARY), 84);
    assert_eq!(with(EdgeFlags::NON_MANIFOLD), 0);
    assert_eq!(with(EdgeFlags::FLIPPED), 0);
    assert_eq!(edges.len(), 5_946);
}

#[test]
fn curvature_of_a_real_mesh_is_finite() {
    let Some(mesh) = suzanne() else { return };
    let welded = weld(mesh.positions(), 0.0);
    let normals = smooth_normals(mesh.positions(), mesh.triangles(), &welded);
    let bends = curvature(mesh.positions(), mesh.triangles(), &welded, &normals);
    assert!(
        bends
            .iter()
            .all(|bend| bend.max.is_finite() && bend.min.is_finite())
    );
    let convex = bends.iter().filter(|bend| bend.mean() > 0.0).count();
    assert!(
        convex > bends.len() / 2,
        "a head is mostly convex, but only {convex} vertices are"
    );
}
