//! Bends of surfaces, which a folder may keep between runs.

use crate::kept::{Cache, input_of};
use npr_mesh::curvature::bend::{Bend, WeldedMesh};

/// The bend of every welded vertex of a mesh, as [`WeldedMesh::bends`] gives it, kept where there is a folder for it.
pub(crate) fn bends(cache: &Cache, mesh: &WeldedMesh<'_>, normals: &[[f32; 3]]) -> Vec<Bend> {
    let input = || {
        let mut hash = input_of("bends");
        hash.positions(mesh.positions);
        hash.numbers(mesh.triangles.as_flattened());
        hash.numbers(&mesh.weld.of_vertex);
        mesh.edges.iter().for_each(|edge| hash.numbers(&edge.ends));
        hash.positions(normals);
        hash.numbers(&[mesh.scale.to_bits()]);
        hash
    };
    let is_sound =
        |bends: &[Bend]| bends.len() == mesh.weld.count() && bends.iter().all(Bend::is_finite);
    cache.rows(input, is_sound, || mesh.bends(normals))
}
