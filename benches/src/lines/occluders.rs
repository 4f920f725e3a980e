//! Which triangles lie before a point: a tree of boxes, plain and in double precision.

use glam::DVec3;

/// Triangles in a leaf, at most.
const LEAF_SIZE: usize = 4;

/// Room around boxes, as a share of the scene, so that rounding never loses a flat one.
const ROOM: f64 = 1e-12;

/// Triangles that may hide a point.
#[derive(Debug, Clone)]
pub struct Occluders<'a> {
    positions: &'a [DVec3],
    faces: &'a [[u32; 3]],
    nodes: Vec<Node>,
    /// Faces in the order of the leaves.
    order: Vec<u32>,
}

/// A box, and either two boxes in it or a run of triangles.
#[derive(Debug, Clone, Copy)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// The second child (the first follows its parent), or the first triangle of a leaf in `order`.
    start: u32,
    /// Triangles of a leaf; 0 marks a box of boxes.
    count: u32,
}

impl<'a> Occluders<'a> {
    /// A tree over the faces, split at the median of the longest side. O(n log n).
    pub fn new(positions: &'a [DVec3], faces: &'a [[u32; 3]]) -> Self {
        let mut occluders = Self {
            positions,
            faces,
            nodes: Vec::new(),
            order: (0..faces.len() as u32).collect(),
        };
        if !faces.is_empty() {
            occluders.split(0, faces.len());
        }
        let scene = occluders.nodes.first();
        let room = scene.map_or(0.0, |root| ROOM * (root.high - root.low).max_element());
        for node in &mut occluders.nodes {
            node.low -= room;
            node.high += room;
        }
        occluders
    }

    fn corners(&self, face: u32) -> [DVec3; 3] {
        self.faces[face as usize].map(|vertex| self.positions[vertex as usize])
    }

    /// Builds the box of `order[from..to]` and everything below it, and gives its number.
    fn split(&mut self, from: usize, to: usize) -> u32 {
        // Bound the faces by a box.
        let corners = self.order[from..to].iter().flat_map(|f| self.corners(*f));
        let (low, high) = corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
            (low.min(p), high.max(p))
        });
        let number = self.nodes.len();
        self.nodes.push(Node {
            low,
            high,
            start: from as u32,
            count: (to - from) as u32,
        });

        // Halve them along its longest axis.
        if to - from > LEAF_SIZE {
            let axis = (high - low).max_position();
            let middle = (to - from) / 2;
            let (positions, faces) = (self.positions, self.faces);
            let along = |face: &u32| -> f64 {
                let corners = faces[*face as usize];
                corners.iter().map(|v| positions[*v as usize][axis]).sum()
            };
            self.order[from..to]
                .select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)));
            self.split(from, from + middle);
            let second = self.split(from + middle, to);
            self.nodes[number].start = second;
            self.nodes[number].count = 0;
        }
        number as u32
    }

    /// Where the segment from `origin` to `point` first meets a face, as a share of its length; 1 where it meets none.
    ///
    /// Faces on both vertices of `edge` are left out: a line does not hide behind what it bounds. The search ends at
    /// the first face before the share `enough`.
    pub fn first_hit(&self, origin: DVec3, point: DVec3, edge: [u32; 2], enough: f64) -> f64 {
        // Start at the root of the tree.
        let direction = point - origin;
        let inverse = direction.recip();
        let mut nearest = 1.0;
        let mut open = if self.nodes.is_empty() {
            vec![]
        } else {
            vec![0u32]
        };
        while let Some(number) = open.pop() {
            // Open only boxes that the ray meets.
            let node = &self.nodes[number as usize];
            if !node.meets(origin, inverse) {
                continue;
            }
            if node.count == 0 {
                open.extend([number + 1, node.start]);
                continue;
            }

            // Test the faces of a leaf, but not those that the line bounds.
            for face in &self.order[node.start as usize..][..node.count as usize] {
                let vertices = self.faces[*face as usize];
                if edge.iter().all(|end| vertices.contains(end)) {
                    continue;
                }
                if let Some(share) = hit(origin, direction, self.corners(*face)) {
                    nearest = share.min(nearest);
                }
            }
            if nearest < enough {
                break;
            }
        }
        nearest
    }
}

impl Node {
    /// Whether the segment, given by its start and the inverse of its extent, goes through the box.
    fn meets(&self, origin: DVec3, inverse: DVec3) -> bool {
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        for axis in 0..3 {
            let to_low = (self.low[axis] - origin[axis]) * inverse[axis];
            let to_high = (self.high[axis] - origin[axis]) * inverse[axis];
            // `max` and `min` pass over the NaN of a segment that runs in a side of the box.
            enter = enter.max(to_low.min(to_high));
            leave = leave.min(to_low.max(to_high));
        }
        enter <= leave
    }
}

/// Where a segment meets a triangle, as a share of its length within 0..1 [Möller and Trumbore 1997].
fn hit(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (along_b, along_c) = (b - a, c - a);
    let across = direction.cross(along_c);
    let volume = along_b.dot(across);
    if volume.abs() < 1e-300 {
        return None;
    }
    let from_a = origin - a;
    let u = from_a.dot(across) / volume;
    let turned = from_a.cross(along_b);
    let v = direction.dot(turned) / volume;
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    let share = along_c.dot(turned) / volume;
    (inside && share > 0.0 && share < 1.0).then_some(share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::collection::vec;
    use proptest::prelude::*;

    fn points() -> impl Strategy<Value = DVec3> {
        (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn the_tree_loses_nothing(
            positions in vec(points(), 3..60), picks in vec(any::<[u16; 3]>(), 0..120), a in points(), b in points(),
        ) {
            let count = positions.len() as u32;
            let faces: Vec<[u32; 3]> = picks.iter().map(|p| p.map(|v| u32::from(v) % count)).collect();
            let edge = faces.first().map_or([0, 1], |f| [f[0], f[1]]);
            let kept = faces.iter().filter(|f| !edge.iter().all(|end| f.contains(end)));
            let shares = kept.filter_map(|f| hit(a, b - a, f.map(|v| positions[v as usize])));
            let expected = shares.fold(1.0, f64::min);
            let tree = Occluders::new(&positions, &faces);
            prop_assert_eq!(tree.first_hit(a, b, edge, 0.0), expected);
        }
    }

    #[test]
    fn a_wall_hides_what_lies_behind_it() {
        let wall = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]].map(|[x, y]| DVec3::new(x, y, 0.5));
        let occluders = Occluders::new(&wall, &[[0, 1, 2]]);
        let share = |z: f64| {
            occluders.first_hit(
                DVec3::new(0.0, 0.0, 2.0),
                DVec3::new(0.0, 0.0, z),
                [7, 8],
                0.0,
            )
        };
        assert_eq!(share(-1.0), 0.5);
        assert_eq!(share(1.0), 1.0);
    }

    #[test]
    fn nothing_hides_behind_nothing() {
        assert_eq!(
            Occluders::new(&[], &[]).first_hit(DVec3::ZERO, DVec3::ONE, [0, 1], 0.0),
            1.0
        );
    }
}
