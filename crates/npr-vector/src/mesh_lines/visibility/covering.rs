//! Which parts of a line the faces of a view hide, without looking at outlines.

mod boxes;
mod cells;

use super::{Circumstances, Piece, Seen};
use crate::mesh_lines::bvh::{Barrier, Sight, hidden_range};
use boxes::FaceBoxes;
use cells::FaceCells;
pub(crate) use cells::Tried;
use std::sync::OnceLock;

/// Parts of a line found before they are joined.
const BATCH: usize = 64;

/// Faces or cells that a thread takes at once at least.
const SHARE: usize = 256;

/// Where the faces of a shape lie in the picture, for one view; made when first asked for.
#[derive(Debug, Default)]
pub struct FaceImages {
    /// By node of the tree: for lines of which all that is before them counts.
    boxes: OnceLock<FaceBoxes>,
    /// By cell of the picture: for lines that are hidden or not.
    cells: OnceLock<FaceCells>,
}

impl FaceImages {
    /// Bytes of a face's share.
    pub(crate) const BYTES_PER_FACE: usize = FaceBoxes::BYTES_PER_FACE + FaceCells::BYTES_PER_FACE;

    /// The parts of a piece that faces hide or that need no looking at, in shares of its image: ascending, apart
    /// from each other.
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

    /// The part that each face hides, in no order; none where there are more than `most`.
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

    /// Makes what many pieces that are hidden or not will ask for, with all threads.
    ///
    /// Not to be called where others may be asking already.
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

/// The ways from the eye to a piece.
struct Sights<'a> {
    seen: &'a Seen<'a>,
    piece: &'a Piece,
    /// To its ends.
    ways: [Sight; 2],
    /// Faces that the piece lies in, ascending.
    own_faces: Vec<u32>,
}

impl<'a> Sights<'a> {
    fn new(seen: &'a Seen<'a>, piece: &'a Piece, circumstances: &Circumstances) -> Self {
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
    fn hidden_by(&self, face: u32) -> Option<[f64; 2]> {
        self.hidden_behind(face, None)
    }

    /// The same, where the face's barrier for the one eye that there is may be known.
    fn hidden_behind(&self, face: u32, barrier: Option<&Barrier>) -> Option<[f64; 2]> {
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

/// Parts of a line, joined where they meet.
#[derive(Debug, Default)]
struct Cover {
    /// Ascending, apart from each other.
    joined: Vec<[f64; 2]>,
    /// Found since they were joined last.
    found: Vec<[f64; 2]>,
    /// Gaps shorter than this need no looking at: nobody would see them.
    unseen: f64,
}

impl Cover {
    /// Takes a part in. O(log n) on the whole.
    fn add(&mut self, part: Option<[f64; 2]>) {
        self.found.extend(part);
        // The longer the list, the rarer it is gone through.
        if self.found.len() >= BATCH.max(self.joined.len()) || part.is_some_and(is_long) {
            self.join();
        }
    }

    fn join(&mut self) {
        let mut parts = std::mem::take(&mut self.joined);
        parts.append(&mut self.found);
        parts.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        for part in parts {
            match self.joined.last_mut() {
                Some(last) if part[0] <= last[1] => last[1] = last[1].max(part[1]),
                _ => self.joined.push(part),
            }
        }
    }

    /// Whether a part lies in what was joined, but for gaps too short to see.
    fn holds(&self, [from, to]: [f64; 2]) -> bool {
        let first = self.joined.partition_point(|part| part[1] <= from);
        let mut reached = from;
        for [start, end] in &self.joined[first..] {
            if *start - reached > self.unseen || to - reached <= self.unseen {
                break;
            }
            reached = *end;
        }
        to - reached <= self.unseen
    }
}

/// Worth joining at once: what it covers need not be looked at again.
fn is_long([from, to]: [f64; 2]) -> bool {
    to - from > 1.0 / 16.0
}
