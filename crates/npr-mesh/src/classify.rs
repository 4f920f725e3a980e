//! Which edges may become lines: the twin of `mesh.classify_edges`.

use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::{Edge, EdgeRole, NONE, Part, PosedVertex, Triangle};
use npr_core::line_kind::KindSet;
use npr_core::outline::Outline;
use npr_core::surface::faces_eye;
use rayon::prelude::*;

/// What edges are classified on.
#[derive(Debug, Clone, Copy)]
pub struct PosedMesh<'a> {
    /// Posed vertices.
    pub posed: &'a [PosedVertex],
    /// Triangles.
    pub triangles: &'a [Triangle],
    /// Parts.
    pub parts: &'a [Part],
}

/// The kinds of every edge, limited to those the outline draws, and its part.
///
/// A contour has one face turned to the eye and one turned away [Marshall 2001]. Edges of parts without lines are of no
/// kind. O(edges), parallel.
pub fn classify(outline: &Outline, mesh: &PosedMesh<'_>, edges: &[Edge], roles: &mut [EdgeRole]) {
    roles
        .par_iter_mut()
        .zip(edges)
        .with_min_len(4096)
        .for_each(|(role, edge)| {
            role.part = mesh.triangles[edge.faces[0] as usize].part;
            let flags = mesh.parts[role.part as usize].flags;
            role.kinds = if flags & Part::LINES != 0 {
                kinds_of(outline, mesh, edge, flags) & outline.kinds
            } else {
                0
            };
        });
}

impl PosedMesh<'_> {
    fn face_is_front(&self, face: u32) -> bool {
        faces_eye(
            self.triangles[face as usize]
                .corners
                .map(|v| self.posed[v as usize].clip),
        )
    }
}

/// All kinds that an edge of a part with these flags is of.
fn kinds_of(outline: &Outline, mesh: &PosedMesh<'_>, edge: &Edge, flags: u32) -> u32 {
    let bit = |kind: u32, when: bool| if when { kind } else { 0 };
    let front = mesh.face_is_front(edge.faces[0]);
    let both_sides = flags & Part::DOUBLE_SIDED != 0;

    // Take an edge of one face for a boundary where it can be seen.
    if edge.faces[1] == NONE {
        return bit(
            KindSet::BOUNDARY | bit(EdgeFlags::FACING.0, front),
            front || both_sides,
        );
    }

    // Turn an inside-out neighbour back, so that it makes no false contour.
    let mut second = mesh.face_is_front(edge.faces[1]);
    let published = bit(EdgeFlags::FACING.0, front || second);
    if edge.traits.contains(EdgeFlags::FLIPPED) {
        second = !second;
    }

    // Give every kind that fits: a contour parts a face turned to the eye from one turned away.
    let seen = front || second || both_sides;
    bit(KindSet::CONTOUR, front != second)
        | bit(
            KindSet::CREASE,
            seen && edge.dihedral_cos < outline.crease_cos,
        )
        | bit(
            KindSet::MATERIAL,
            seen && edge.traits.contains(EdgeFlags::MATERIAL),
        )
        | published
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles sharing the edge from (0, 0) to (0, 1), seen from +z; the second folds by `fold`.
    fn kinds(second_tip: [f32; 2], traits: EdgeFlags, dihedral_cos: f32) -> u32 {
        let at = |x: f32, y: f32| PosedVertex {
            clip: [x, y, 0.5, 1.0],
            ..PosedVertex::default()
        };
        let posed = [
            at(0.0, 0.0),
            at(0.0, 1.0),
            at(-1.0, 0.5),
            at(second_tip[0], second_tip[1]),
        ];
        let triangles = [
            Triangle {
                corners: [0, 1, 2],
                part: 0,
            },
            Triangle {
                corners: [1, 0, 3],
                part: 0,
            },
        ];
        let parts = [Part {
            flags: Part::LINES,
            ..Part::default()
        }];
        let outline = Outline {
            kinds: !0,
            crease_cos: 0.7,
            ..Outline::default()
        };
        let edge = Edge {
            ends: [0, 1],
            faces: [0, 1],
            dihedral_cos,
            traits,
        };
        let mut roles = [EdgeRole::default()];
        let mesh = PosedMesh {
            posed: &posed,
            triangles: &triangles,
            parts: &parts,
        };
        classify(&outline, &mesh, &[edge], &mut roles);
        roles[0].kinds
    }

    #[test]
    fn a_flat_pair_is_no_line() {
        assert_eq!(kinds([1.0, 0.5], EdgeFlags::NONE, 1.0), EdgeFlags::FACING.0);
    }

    #[test]
    fn a_folded_pair_is_a_contour() {
        assert_eq!(
            kinds([-0.5, 0.5], EdgeFlags::NONE, 1.0),
            KindSet::CONTOUR | EdgeFlags::FACING.0
        );
    }

    #[test]
    fn creases_and_materials_are_told_apart() {
        assert_eq!(
            kinds([1.0, 0.5], EdgeFlags::NONE, 0.5),
            KindSet::CREASE | EdgeFlags::FACING.0
        );
        assert_eq!(
            kinds([1.0, 0.5], EdgeFlags::MATERIAL, 1.0),
            KindSet::MATERIAL | EdgeFlags::FACING.0
        );
    }

    #[test]
    fn an_inside_out_neighbour_is_turned_back() {
        assert_eq!(
            kinds([-0.5, 0.5], EdgeFlags::FLIPPED, 1.0) & KindSet::CONTOUR,
            0
        );
    }
}
