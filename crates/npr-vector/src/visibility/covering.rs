//! The faces of a view in boxes of the picture: which parts of a line they hide, without looking at outlines.

use super::{Circumstances, Piece, Seen};
use crate::bvh::{FaceTree, Sight, bounds, hidden_range};
use crate::project::Projector;
use glam::{DVec2, DVec3};
use npr_core::geometry::NONE;
use npr_core::shape::Shape;

/// How far boxes are grown for rounding, in pixels and as a share of a depth.
const ROOM: f64 = 1e-6;

/// Parts of a line found before they are joined.
const BATCH: usize = 64;

/// Side of the cells in which the nearest face is known that fills them, in pixels.
const CELL_PX: f64 = 16.0;

/// Where the faces below each node of a [`FaceTree`] lie in the picture, for one view.
#[derive(Debug)]
pub struct FaceImages {
    /// By node of the tree.
    boxes: Vec<ImageBox>,
    /// The nearest face that fills a cell of the picture, row by row, or [`NONE`]: what most likely hides a line
    /// there.
    fillers: Vec<u32>,
    columns: usize,
}

/// An octagon in the picture, and the depth before which nothing of it lies.
#[derive(Debug, Clone, Copy)]
struct ImageBox {
    /// To the right, down, and along both diagonals ([`along_axes`]).
    low: [f64; 4],
    high: [f64; 4],
    near: f64,
}

/// Where a place lies along the axes of an octagon: thin faces across the picture leave less room than in boxes.
fn along_axes([x, y]: [f64; 2]) -> [f64; 4] {
    [x, y, x + y, x - y]
}

impl ImageBox {
    /// Holds nothing.
    const EMPTY: Self = Self {
        low: [f64::INFINITY; 4],
        high: [f64::NEG_INFINITY; 4],
        near: f64::INFINITY,
    };

    /// The box of a face; all of the picture where the face reaches before the near plane.
    fn of(shape: &Shape, face: u32, projector: &Projector) -> Self {
        let corners = shape.faces[face as usize].map(|v| shape.point(v));
        let depths = corners.map(|corner| projector.depth(corner));
        let near = depths.into_iter().fold(f64::INFINITY, f64::min);
        let mut found = Self {
            near: near - near.abs() * ROOM,
            ..Self::EMPTY
        };
        let in_front = !projector.is_perspective() || near >= projector.near();
        for corner in corners {
            for (axis, place) in along_axes(projector.project(corner))
                .into_iter()
                .enumerate()
            {
                let known = in_front && place.is_finite();
                let room = ROOM * (1.0 + place.abs());
                let [low, high] = match known {
                    true => [place - room, place + room],
                    false => [f64::NEG_INFINITY, f64::INFINITY],
                };
                found.low[axis] = found.low[axis].min(low);
                found.high[axis] = found.high[axis].max(high);
            }
        }
        found
    }

    fn join(&mut self, other: &Self) {
        for axis in 0..4 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
        self.near = self.near.min(other.near);
    }

    /// The part of a line's image that lies in the box; none where none does.
    fn part_of(&self, [a, b]: &[[f64; 4]; 2]) -> Option<[f64; 2]> {
        let mut part: [f64; 2] = [0.0, 1.0];
        for axis in 0..4 {
            let along = b[axis] - a[axis];
            let [low, high] = [self.low[axis] - a[axis], self.high[axis] - a[axis]];
            if along == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let [enter, leave] = [low / along, high / along];
            part[0] = part[0].max(enter.min(leave));
            part[1] = part[1].min(enter.max(leave));
            if part[0] > part[1] {
                return None;
            }
        }
        Some(part)
    }
}

impl FaceImages {
    /// Bytes of a face's share.
    pub(crate) const BYTES_PER_FACE: usize = 2 * size_of::<ImageBox>();

    /// Finds them for a picture of a size. O(faces + cells that they fill).
    pub fn new(shape: &Shape, tree: &FaceTree, projector: &Projector, size: [u32; 2]) -> Self {
        let nodes = &tree.bvh.nodes;
        let mut boxes = vec![ImageBox::EMPTY; nodes.len()];
        // Parents before children, then back.
        let mut order: Vec<u32> = Vec::with_capacity(nodes.len());
        let mut stack: Vec<u32> = (!nodes.is_empty()).then_some(0).into_iter().collect();
        while let Some(index) = stack.pop() {
            order.push(index);
            let node = &nodes[index as usize];
            if !node.is_leaf() {
                stack.extend([node.first_index, node.first_index + 1]);
            }
        }
        for index in order.into_iter().rev() {
            let node = &nodes[index as usize];
            let mut found = ImageBox::EMPTY;
            if node.is_leaf() {
                for face in tree.faces_of(node) {
                    found.join(&ImageBox::of(shape, *face, projector));
                }
            } else {
                found.join(&boxes[node.first_index as usize]);
                found.join(&boxes[node.first_index as usize + 1]);
            }
            boxes[index as usize] = found;
        }
        let [columns, rows] = size.map(|side| (f64::from(side) / CELL_PX) as usize + 1);
        let mut fillers = vec![(f64::INFINITY, NONE); columns * rows];
        for face in 0..shape.faces.len() as u32 {
            fill_cells(shape, face, projector, [columns, rows], &mut fillers);
        }
        Self {
            boxes,
            fillers: fillers.into_iter().map(|(_, face)| face).collect(),
            columns,
        }
    }

    /// Tries the faces that fill the cells along a piece: a line behind many is done with after few.
    fn try_fillers(&self, piece: &Piece, mut hide: impl FnMut(u32)) {
        let count = (piece.length() / CELL_PX).ceil().clamp(1.0, 4096.0);
        let mut last = NONE;
        for step in 0..count as u32 {
            let place = piece.place_at((f64::from(step) + 0.5) / count);
            let [column, row] = place.map(|v| (v / CELL_PX).max(0.0) as usize);
            let cell = (column < self.columns).then_some(row * self.columns + column);
            let face = cell.and_then(|cell| self.fillers.get(cell)).copied();
            if let Some(face) = face.filter(|face| *face != NONE && *face != last) {
                hide(face);
                last = face;
            }
        }
    }

    /// The parts of a piece that faces hide or that need no looking at, in shares of its image: ascending, apart
    /// from each other.
    ///
    /// Boxes near the eye come first, and those over parts that are hidden already are passed by: a line behind many
    /// faces is done with when the first few have covered it.
    pub(super) fn hidden_parts(
        &self,
        seen: &Seen<'_>,
        piece: &Piece,
        circumstances: &Circumstances,
        known: &[[f64; 2]],
    ) -> Vec<[f64; 2]> {
        let search = Search::new(self, seen, piece, circumstances);
        let mut cover = Cover {
            joined: known.to_vec(),
            found: Vec::new(),
        };
        self.try_fillers(piece, |face| cover.add(search.hidden_by(face)));
        cover.join();
        let mut stack: Vec<(u32, [f64; 2])> = search.enter(0).into_iter().collect();
        while let Some((index, part)) = stack.pop() {
            if !cover.holds(part) {
                let faces = search.open(index, &mut stack);
                faces
                    .iter()
                    .for_each(|face| cover.add(search.hidden_by(*face)));
            }
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
        let search = Search::new(self, seen, piece, circumstances);
        let mut parts = Vec::new();
        let mut stack: Vec<(u32, [f64; 2])> = search.enter(0).into_iter().collect();
        while let Some((index, _)) = stack.pop() {
            let faces = search.open(index, &mut stack);
            parts.extend(faces.iter().filter_map(|face| search.hidden_by(*face)));
            if parts.len() > most {
                return None;
            }
        }
        Some(parts)
    }
}

/// A walk over the faces that may hide a piece.
struct Search<'a> {
    images: &'a FaceImages,
    seen: &'a Seen<'a>,
    piece: &'a Piece,
    ends: [[f64; 4]; 2],
    sights: [Sight; 2],
    reach: Reach,
    /// Depth of the end that lies farther.
    farthest: f64,
    /// Faces that the piece lies in, ascending.
    own_faces: Vec<u32>,
}

impl<'a> Search<'a> {
    fn new(
        images: &'a FaceImages,
        seen: &'a Seen<'a>,
        piece: &'a Piece,
        circumstances: &Circumstances,
    ) -> Self {
        let sights = piece.world.map(|end| seen.sight(end, circumstances));
        let mut own_faces = circumstances.own_faces.clone();
        own_faces.sort_unstable();
        Self {
            images,
            seen,
            piece,
            ends: piece.place.map(along_axes),
            reach: Reach::of(&sights.map(|sight| [sight.eye, sight.point].map(DVec3::from))),
            sights,
            farthest: piece.depth[0].max(piece.depth[1]),
            own_faces,
        }
    }

    /// A node with the part of the piece that may lie behind what is below it; none where nothing does.
    fn enter(&self, index: u32) -> Option<(u32, [f64; 2])> {
        let image = self.images.boxes.get(index as usize)?;
        let part = (image.near < self.farthest).then(|| image.part_of(&self.ends))??;
        self.reach
            .meets(self.seen.tree, index)
            .then_some((index, part))
    }

    /// The faces of a leaf; of another node none, but its children are put on the stack, the nearer on top.
    fn open(&self, index: u32, stack: &mut Vec<(u32, [f64; 2])>) -> &'a [u32] {
        let node = &self.seen.tree.bvh.nodes[index as usize];
        if node.is_leaf() {
            return self.seen.tree.faces_of(node);
        }
        let near = |index: u32| self.images.boxes[index as usize].near;
        let (one, other) = (node.first_index, node.first_index + 1);
        let order = if near(one) <= near(other) {
            [other, one]
        } else {
            [one, other]
        };
        stack.extend(order.into_iter().filter_map(|child| self.enter(child)));
        &[]
    }

    /// The part of the piece's image that a face hides.
    fn hidden_by(&self, face: u32) -> Option<[f64; 2]> {
        if self.own_faces.binary_search(&face).is_ok() {
            return None;
        }
        let range = hidden_range(self.seen.shape, face, &self.sights)?;
        Some(range.map(|share| self.seen.projector.image_share(share, self.piece.depth)))
    }
}

/// Notes a face in the cells that its image fills, where no nearer one does.
fn fill_cells(
    shape: &Shape,
    face: u32,
    projector: &Projector,
    [columns, rows]: [usize; 2],
    fillers: &mut [(f64, u32)],
) {
    let corners = shape.faces[face as usize].map(|v| shape.point(v));
    let depths = corners.map(|corner| projector.depth(corner));
    if projector.is_perspective() && depths.iter().any(|depth| *depth < projector.near()) {
        return;
    }
    let [a, b, c] = corners.map(|corner| DVec2::from(projector.project(corner)) / CELL_PX);
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let area = (b - a).perp_dot(c - a);
    if !(area != 0.0 && low.is_finite() && high.is_finite()) {
        return;
    }
    let first = low.ceil().max(DVec2::ZERO);
    let last = high.floor().min(DVec2::new(columns as f64, rows as f64));
    // Of each side's distance the least corner of a cell counts.
    let sides = [[b, c], [c, a], [a, b]].map(|[from, to]| {
        let along = (to - from) / area;
        (from, along, (-along.y).min(0.0) + along.x.min(0.0))
    });
    for row in first.y as usize..(last.y.max(0.0) as usize) {
        for column in first.x as usize..(last.x.max(0.0) as usize) {
            let place = DVec2::new(column as f64, row as f64);
            let shares = sides.map(|(from, along, _)| along.perp_dot(place - from));
            if (0..3).any(|i| shares[i] + sides[i].2 < 0.0) {
                continue;
            }
            let depth: f64 = (0..3).map(|i| shares[i] * depths[i]).sum();
            let filler = &mut fillers[row * columns + column];
            if depth < filler.0 {
                *filler = (depth, face);
            }
        }
    }
}

/// The box in the world around all ways from the eye to a line, without their last bit: what lies beside it, or only
/// touches the line, hides nothing of it.
struct Reach {
    low: DVec3,
    high: DVec3,
}

impl Reach {
    fn of(ways: &[[DVec3; 2]; 2]) -> Self {
        let ends = ways.map(|[eye, point]| eye + (point - eye) * (1.0 - crate::bvh::NEARER));
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let eyes = ways.map(|[eye, _]| eye);
        Self {
            low: low.min(eyes[0]).min(eyes[1]),
            high: high.max(eyes[0]).max(eyes[1]),
        }
    }

    fn meets(&self, tree: &FaceTree, index: u32) -> bool {
        let [low, high] = bounds(tree.bvh.nodes[index as usize].aabb());
        let (low, high) = (low.truncate().as_dvec3(), high.truncate().as_dvec3());
        low.cmple(self.high).all() && high.cmpge(self.low).all()
    }
}

/// Parts of a line, joined where they meet.
#[derive(Debug, Default)]
struct Cover {
    /// Ascending, apart from each other.
    joined: Vec<[f64; 2]>,
    /// Found since they were joined last.
    found: Vec<[f64; 2]>,
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

    /// Whether a part lies in what was joined.
    fn holds(&self, [from, to]: [f64; 2]) -> bool {
        let after = self.joined.partition_point(|part| part[0] <= from);
        after > 0 && to <= self.joined[after - 1][1]
    }
}

/// Worth joining at once: what it covers need not be looked at again.
fn is_long([from, to]: [f64; 2]) -> bool {
    to - from > 1.0 / 16.0
}
