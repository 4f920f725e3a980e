//! Meshes that bend with a pose, by a skin or by morphs: what is kept of them, so that their folds and vertices follow
//! without anything being welded or joined anew.

use crate::instance::{self, HARD_EDGE, Kept, folds};
use crate::joined::Joined;
use npr_core::geometry::{Edge, Triangle, Vertex};
use npr_core::math;
use npr_scene::{Node, Part, Scene};

/// A mesh at a node whose shape a pose may change.
#[derive(Debug, Clone)]
pub(crate) struct Bending {
    /// The node.
    pub node: u32,
    /// Where its vertices, triangles and edges begin in the model.
    pub first: [usize; 3],
    /// Its welded vertices and edges, as it was prepared.
    pub kept: Kept,
    /// Whether two corners of every triangle are swapped.
    pub mirrored: bool,
}

/// What of a model changed with its pose, besides its matrices.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Moved {
    pub vertices: bool,
    pub edges: bool,
}

/// The lists of a model that follow a pose.
pub(crate) struct Lists<'a> {
    pub vertices: &'a mut [Vertex],
    pub triangles: &'a [Triangle],
    pub edges: &'a mut [Edge],
    pub normals_cos: &'a mut [f32],
}

/// The parts of a node's mesh that have surfaces.
pub(crate) fn surfaces_of(mesh: &npr_scene::Mesh) -> Vec<&Part> {
    let is_surface = |part: &&Part| !part.triangles.is_empty();
    mesh.parts.iter().filter(is_surface).collect()
}

impl Bending {
    /// Whether morphs move its vertices.
    pub fn has_morphs(&self, scene: &Scene) -> bool {
        let node = scene.nodes.get(self.node as usize);
        let mesh = node.and_then(|node| scene.meshes.get(node.mesh? as usize));
        mesh.is_some_and(|mesh| mesh.parts.iter().any(|part| part.unmorphed.is_some()))
    }

    /// Lets the folds of the mesh follow, and its vertices where morphs move them. O(vertices + edges).
    pub fn follow(&self, scene: &Scene, lists: &mut Lists<'_>) -> Moved {
        let Some(node) = scene.nodes.get(self.node as usize) else {
            return Moved::default();
        };
        let Some(mesh) = node.mesh.and_then(|mesh| scene.meshes.get(mesh as usize)) else {
            return Moved::default();
        };
        let parts = surfaces_of(mesh);
        let joined = Joined::new(&parts);
        let is_morphed = parts.iter().any(|part| part.unmorphed.is_some());
        Moved {
            vertices: is_morphed && self.follow_morphs(&joined, lists),
            edges: self.follow_folds(scene, (node, &parts), &joined, lists),
        }
    }

    /// Measures the folds in the world. Returns whether any changed.
    fn follow_folds(
        &self,
        scene: &Scene,
        of: (&Node, &[&Part]),
        joined: &Joined,
        lists: &mut Lists<'_>,
    ) -> bool {
        let Kept { weld, edges } = &self.kept;
        let folds = folds(scene, of, joined, weld, edges);
        let range = self.first[2]..self.first[2] + edges.len();
        let mut is_changed = false;
        let faces = lists.edges[range.clone()].iter_mut().zip(folds.faces);
        for (edge, cos) in faces {
            is_changed |= edge.dihedral_cos != cos;
            edge.dihedral_cos = cos;
        }
        let normals = &mut lists.normals_cos[range];
        is_changed |= *normals != folds.normals[..];
        normals.copy_from_slice(&folds.normals);
        is_changed
    }

    /// Takes over positions and normals. Returns whether any changed.
    ///
    /// Where the file has no normals, hard edges stay those of the shape that was prepared.
    fn follow_morphs(&self, joined: &Joined, lists: &mut Lists<'_>) -> bool {
        // Find the normals of all corners.
        let Kept { weld, edges } = &self.kept;
        let smooth = npr_mesh::smooth_normals(&joined.positions, &joined.triangles, weld);
        let corner_normals = (!joined.has_normals).then(|| {
            let (positions, triangles) = (&joined.positions, &joined.triangles);
            npr_mesh::crease_normals(positions, triangles, weld, edges, HARD_EDGE)
        });

        // Move the vertices that triangles use, each with the first corner that it is.
        let [first_vertex, first_triangle, _] = self.first;
        let stored = &lists.triangles[first_triangle..][..joined.triangles.len()];
        let mut is_changed = false;
        let mut is_done = vec![false; lists.vertices.len() - first_vertex];
        for (triangle, (stored, source)) in stored.iter().zip(&joined.triangles).enumerate() {
            for corner in 0..3 {
                let [v, from] = match (self.mirrored, corner) {
                    (true, 1) => [stored.corners[2], source[1]],
                    (true, 2) => [stored.corners[1], source[2]],
                    _ => [stored.corners[corner], source[corner]],
                };
                if std::mem::replace(&mut is_done[v as usize - first_vertex], true) {
                    continue;
                }
                let from = from as usize;
                let normal = match &corner_normals {
                    Some(normals) => normals[triangle][corner],
                    None => instance::stored_normal(joined, from),
                };
                let welded = weld.of_vertex[from] as usize;
                let vertex = &mut lists.vertices[v as usize];
                let moved = Vertex {
                    position: joined.positions[from],
                    normal,
                    weld_normal: math::pack_unit(smooth[welded]),
                    ..*vertex
                };
                is_changed |= moved != *vertex;
                *vertex = moved;
            }
        }
        is_changed
    }
}

#[cfg(test)]
mod tests {
    use crate::model::Model;
    use npr_core::crease::CreaseFrom;
    use npr_scene::testing::limb;

    fn folds(model: &Model, from: CreaseFrom) -> Vec<f32> {
        let edges = model.edges_by(from);
        edges.iter().map(|edge| edge.dihedral_cos).collect()
    }

    fn places(model: &Model) -> Vec<[f32; 3]> {
        let vertices = model.vertices.iter();
        vertices.map(|vertex| vertex.position).collect()
    }

    #[test]
    fn folds_and_vertices_are_those_of_a_model_made_for_the_pose() {
        for has_normals in [false, true] {
            let rest = limb(has_normals);
            let mut model = Model::new(&rest).expect("a model");
            for (clip, time) in [(0, 0.5), (1, 0.7), (0, 1.0)] {
                // Go on to another pose, and make a model of it.
                let mut scene = rest.clone();
                let pose = rest.pose_at(&rest.clips[clip], time);
                scene.set_pose(&pose).expect("in range");
                let before = folds(&model, CreaseFrom::Faces);
                let moved = model.pose(&scene).expect("the same scene");
                assert!(moved.edges && folds(&model, CreaseFrom::Faces) != before);

                // Without normals a model made anew has hard edges of its own, and with them other vertices.
                let fresh = Model::new(&scene).expect("a model");
                for from in [CreaseFrom::Faces, CreaseFrom::Normals] {
                    assert_eq!(folds(&model, from), folds(&fresh, from), "{clip} {time}");
                }
                if has_normals {
                    assert_eq!(places(&model), places(&fresh), "{clip} {time}");
                }
            }
        }
    }
}
