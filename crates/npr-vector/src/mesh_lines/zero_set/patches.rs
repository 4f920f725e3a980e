//! Patches of faces on which interpolated normals and planes disagree about the front.

use super::signs::Signs;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;

/// Length in pixels of a patch's visible outline, off every smooth line, from which the patch is chosen.
pub(super) const LEAST_PX: f64 = 2.0;

/// Patches of faces connected across sides on which normals and planes disagree, found when they are asked for.
pub(super) struct Patches<'a> {
    signs: &'a Signs<'a>,
    front: &'a [u8],
    /// Patch of every face; [`NONE`] where not yet known.
    of_face: Vec<u32>,
    chosen: Vec<bool>,
}

impl<'a> Patches<'a> {
    pub fn new(signs: &'a Signs<'a>, front: &'a [u8]) -> Self {
        Self {
            signs,
            front,
            of_face: vec![NONE; front.len()],
            chosen: Vec::new(),
        }
    }

    pub fn is_chosen(&self, face: u32) -> bool {
        let patch = self.of_face[face as usize];
        patch != NONE && self.chosen[patch as usize]
    }

    /// Chooses the patches that miss enough; returns false if all of them were chosen before.
    pub fn choose(&mut self, missed: &[(u32, f64)]) -> bool {
        let mut lengths: Vec<f64> = Vec::new();
        for (face, length) in missed {
            let patch = self.patch_of(*face) as usize;
            lengths.resize(self.chosen.len(), 0.0);
            lengths[patch] += length;
        }
        let mut any = false;
        for (chosen, length) in self.chosen.iter_mut().zip(lengths) {
            let new = !*chosen && length >= LEAST_PX;
            *chosen |= new;
            any |= new;
        }
        any
    }

    fn patch_of(&mut self, face: u32) -> u32 {
        if self.of_face[face as usize] == NONE {
            // Begin a patch at a face that has none.
            let patch = self.chosen.len() as u32;
            self.chosen.push(false);
            self.of_face[face as usize] = patch;
            let mut open = vec![face];

            // Let it grow across sides on whose signs both faces disagree.
            while let Some(face) = open.pop() {
                for side in 3 * face..3 * face + 3 {
                    let twin = self.signs.shape.twins[side as usize];
                    let reaches = twin != NONE
                        && self.of_face[twin as usize / 3] == NONE
                        && self.disagree_on(side)
                        && self.disagree_on(twin);
                    if reaches {
                        self.of_face[twin as usize / 3] = patch;
                        open.push(twin / 3);
                    }
                }
            }
        }
        self.of_face[face as usize]
    }

    /// Whether normals and plane disagree on a part of a face's side.
    fn disagree_on(&self, side: u32) -> bool {
        let front = self.front[side as usize / 3] != 0;
        [side, HalfEdgeMesh::following(side)]
            .into_iter()
            .any(|corner| self.signs.front(corner) != front)
    }
}
