//! The faces of a view in boxes of the picture: which of them may lie before a line.

use super::sights::Sights;
use crate::mesh_lines::bvh::{FaceTree, bounds};
use crate::project::Projector;
use glam::DVec3;
use npr_mesh::half_edge::HalfEdgeMesh;
use std::ops::Range;

/// By how much boxes are grown for rounding, in pixels and as a share of a depth.
const ROOM: f64 = 1e-6;

/// Where the faces below each node of a [`FaceTree`] lie in the picture.
#[derive(Debug)]
pub(super) struct FaceBoxes {
    /// By node of the tree.
    boxes: Vec<ImageBox>,
}

/// An octagon in the picture, and the least depth of its content.
#[derive(Debug, Clone, Copy)]
struct ImageBox {
    /// Least values along four axes: to the right, down, and along both diagonals ([`along_axes`]).
    low: [f64; 4],
    high: [f64; 4],
    near: f64,
}

/// Coordinates of a place along the axes of an octagon, which encloses thin slanted faces more closely than a box.
fn along_axes([x, y]: [f64; 2]) -> [f64; 4] {
    [x, y, x + y, x - y]
}

impl ImageBox {
    /// A box that holds nothing.
    const EMPTY: Self = Self {
        low: [f64::INFINITY; 4],
        high: [f64::NEG_INFINITY; 4],
        near: f64::INFINITY,
    };

    /// The box of a face; it holds all of the picture if the face reaches before the near plane.
    fn of(shape: &HalfEdgeMesh, face: u32, projector: &Projector) -> Self {
        // Find the depth before which nothing of the face lies.
        let corners = shape.faces[face as usize].map(|v| shape.point(v));
        let depths = corners.map(|corner| projector.depth(corner));
        let near = depths.into_iter().fold(f64::INFINITY, f64::min);
        let mut found = Self {
            near: near - near.abs() * ROOM,
            ..Self::EMPTY
        };

        // Enclose its image, with room for rounding.
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

    /// Whether a part of a line's image lies in the box.
    fn meets(&self, [a, b]: &[[f64; 4]; 2]) -> bool {
        let mut part: [f64; 2] = [0.0, 1.0];
        for axis in 0..4 {
            let along = b[axis] - a[axis];
            let [low, high] = [self.low[axis] - a[axis], self.high[axis] - a[axis]];
            if along == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return false;
                }
                continue;
            }
            let [enter, leave] = [low / along, high / along];
            part[0] = part[0].max(enter.min(leave));
            part[1] = part[1].min(enter.max(leave));
            if part[0] > part[1] {
                return false;
            }
        }
        true
    }
}

impl FaceBoxes {
    /// Bytes for each face.
    pub(super) const BYTES_PER_FACE: usize = 2 * size_of::<ImageBox>();

    /// Finds the boxes of all nodes. O(faces).
    pub(super) fn new(shape: &HalfEdgeMesh, tree: &FaceTree, projector: &Projector) -> Self {
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
                for face in FaceTree::faces_of(node) {
                    found.join(&ImageBox::of(shape, face, projector));
                }
            } else {
                found.join(&boxes[node.first_index as usize]);
                found.join(&boxes[node.first_index as usize + 1]);
            }
            boxes[index as usize] = found;
        }
        Self { boxes }
    }

    /// The part that each face hides, in no order; `None` if there are more than `most`.
    pub(super) fn parts_by_face(&self, sights: &Sights<'_>, most: usize) -> Option<Vec<[f64; 2]>> {
        let search = Search::new(self, sights);
        let mut parts = Vec::new();
        let mut stack: Vec<u32> = search.may_hide(0).then_some(0).into_iter().collect();
        while let Some(index) = stack.pop() {
            let faces = search.open(index, &mut stack);
            parts.extend(faces.filter_map(|face| sights.hidden_by(face)));
            if parts.len() > most {
                return None;
            }
        }
        Some(parts)
    }
}

/// A walk over the faces that may hide a piece.
struct Search<'a> {
    boxes: &'a [ImageBox],
    tree: &'a FaceTree,
    ends: [[f64; 4]; 2],
    reach: Reach,
    /// Depth of the farther end.
    farthest: f64,
}

impl<'a> Search<'a> {
    fn new(images: &'a FaceBoxes, sights: &Sights<'a>) -> Self {
        let Sights { piece, ways, .. } = sights;
        Self {
            boxes: &images.boxes,
            tree: sights.seen.tree,
            ends: piece.place.map(along_axes),
            reach: Reach::of(&ways.map(|way| [way.eye, way.point].map(DVec3::from))),
            farthest: piece.depth[0].max(piece.depth[1]),
        }
    }

    /// Whether the piece may lie behind a face below a node.
    fn may_hide(&self, index: u32) -> bool {
        let image = self.boxes.get(index as usize);
        let meets = |image: &ImageBox| image.near < self.farthest && image.meets(&self.ends);
        image.is_some_and(meets) && self.reach.meets(self.tree, index)
    }

    /// The faces of a leaf; for another node none, and its children are put on the stack.
    fn open(&self, index: u32, stack: &mut Vec<u32>) -> Range<u32> {
        let node = &self.tree.bvh.nodes[index as usize];
        if node.is_leaf() {
            return FaceTree::faces_of(node);
        }
        let children = [node.first_index, node.first_index + 1];
        stack.extend(children.into_iter().filter(|child| self.may_hide(*child)));
        0..0
    }
}

/// The box in the world around all ways from the eye to a line, without their last bit: faces outside of it, or that
/// only touch the line, hide nothing of it.
struct Reach {
    low: DVec3,
    high: DVec3,
}

impl Reach {
    fn of(ways: &[[DVec3; 2]; 2]) -> Self {
        let ends =
            ways.map(|[eye, point]| eye + (point - eye) * (1.0 - crate::mesh_lines::bvh::NEARER));
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
