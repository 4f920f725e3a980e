//! Finds the parts of a line that the faces of a view hide, without outlines.

mod boxes;
mod cells;
mod cover;
mod sights;

use super::{Circumstances, Piece, Seen};
use boxes::FaceBoxes;
use cells::FaceCells;
pub(crate) use cells::Tried;
use cover::Cover;
use sights::Sights;
use std::sync::OnceLock;

/// Fewest faces or cells that a thread takes at once.
const SHARE: usize = 256;

/// Where the faces of a shape lie in the picture, for one view; made when first asked for.
#[derive(Debug, Default)]
pub struct FaceImages {
    /// By node of the tree: for lines of which all faces in front are counted.
    boxes: OnceLock<FaceBoxes>,
    /// By cell of the picture: for lines that are only hidden or not.
    cells: OnceLock<FaceCells>,
}

impl FaceImages {
    /// Bytes for each face.
    pub(crate) const BYTES_PER_FACE: usize = FaceBoxes::BYTES_PER_FACE + FaceCells::BYTES_PER_FACE;

    /// The parts of a piece, in shares of its image, that faces hide or that need no test: ascending, apart from each
    /// other.
    pub(super) fn hidden_parts(
        &self,
        seen: &Seen<'_>,
        piece: &Piece,
        circumstances: &Circumstances,
        known: &[[f64; 2]],
        tried: &mut Tried,
    ) -> Vec<[f64; 2]> {
        let sights = Sights::new(seen, piece, circumstances);
        let mut cover = Cover {
            joined: known.to_vec(),
            found: Vec::new(),
            // Gaps at the end of one cell and at the start of the next are one.
            unseen: 0.5 * super::least_crowded(piece),
        };
        if circumstances.touch > 0.0 {
            // What fills a cell before such a piece may be too near to hide it.
            let parts = self.boxes(seen).parts_by_face(&sights, usize::MAX);
            cover.found.extend(parts.into_iter().flatten());
        } else {
            // One thread alone: others may wait for it, and it must not wait for them.
            self.cells(seen, usize::MAX)
                .cover(&sights, &mut cover, tried);
        }
        cover.join();
        cover.joined
    }

    /// The part that each face hides, in no order; `None` if there are more than `most`.
    pub(super) fn parts_by_face(
        &self,
        seen: &Seen<'_>,
        piece: &Piece,
        circumstances: &Circumstances,
        most: usize,
    ) -> Option<Vec<[f64; 2]>> {
        let sights = Sights::new(seen, piece, circumstances);
        self.boxes(seen).parts_by_face(&sights, most)
    }

    /// Makes on all threads what pieces that are only hidden or not will need.
    ///
    /// No other thread may be asking for it already.
    pub(super) fn prepare(&self, seen: &Seen<'_>) {
        self.cells(seen, SHARE);
    }

    fn cells(&self, seen: &Seen<'_>, least: usize) -> &FaceCells {
        let cells = || FaceCells::new(seen.shape, seen.projector, seen.size, least);
        self.cells.get_or_init(cells)
    }

    fn boxes(&self, seen: &Seen<'_>) -> &FaceBoxes {
        let boxes = || FaceBoxes::new(seen.shape, seen.tree, seen.projector);
        self.boxes.get_or_init(boxes)
    }
}
