//! The ways from the eye to a piece of line.

use crate::mesh_lines::bvh::{Barrier, Sight, hidden_range};
use crate::mesh_lines::visibility::{Circumstances, Piece, Seen};

/// The ways from the eye to a piece.
pub(super) struct Sights<'a> {
    pub(super) seen: &'a Seen<'a>,
    pub(super) piece: &'a Piece,
    /// The ways to its two ends.
    pub(super) ways: [Sight; 2],
    /// Faces that the piece lies in, ascending.
    pub(super) own_faces: Vec<u32>,
}

impl<'a> Sights<'a> {
    pub(super) fn new(seen: &'a Seen<'a>, piece: &'a Piece, circumstances: &Circumstances) -> Self {
        let mut own_faces = circumstances.own_faces.clone();
        own_faces.sort_unstable();
        Self {
            seen,
            piece,
            ways: piece.world.map(|end| seen.sight(end, circumstances)),
            own_faces,
        }
    }

    /// The part of the piece's image that a face hides.
    pub(super) fn hidden_by(&self, face: u32) -> Option<[f64; 2]> {
        self.hidden_behind(face, None)
    }

    /// The same with the face's barrier for the one eye, if it is known.
    pub(super) fn hidden_behind(&self, face: u32, barrier: Option<&Barrier>) -> Option<[f64; 2]> {
        if self.own_faces.binary_search(&face).is_ok() {
            return None;
        }
        let range = match barrier {
            Some(barrier) => barrier.hidden_range(barrier, &self.ways),
            None => hidden_range(self.seen.shape, face, &self.ways),
        }?;
        Some(range.map(|share| self.seen.projector.image_share(share, self.piece.depth)))
    }
}
