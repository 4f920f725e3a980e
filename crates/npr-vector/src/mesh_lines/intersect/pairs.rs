//! Pairs of faces that may cut each other: boxes overlap, and neither lies wholly beside the other's plane.

use crate::mesh_lines::bvh::{FaceTree, box_of};
use npr_core::budget::OverBudget;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;
use obvhs::aabb::Aabb;
use rayon::prelude::*;

/// Most faces searched for together.
///
/// Larger groups walk the tree less often and compare more boxes.
const GROUP: u32 = 16;

/// Most pairs that one group may find: 2048 for each of its faces.
const GROUP_LIMIT: usize = 2048 * GROUP as usize;

/// Most pairs of faces with overlapping boxes that are compared, beside [`LOOKS_PER_FACE`] a face: a second of work.
const LOOKS: usize = 1 << 23;

/// Most pairs of faces with overlapping boxes that are compared, for every face.
const LOOKS_PER_FACE: usize = 256;

/// Groups that are searched before the number of pairs is checked again.
const ROUND: usize = 64;

/// A node of the tree, all nodes in the order of a walk: first the node, then what is below it.
#[derive(Debug, Clone, Copy)]
struct Node {
    min: [f32; 3],
    /// The node after all that lies below this one.
    skip: u32,
    max: [f32; 3],
    /// The face of a leaf, or [`NONE`].
    face: u32,
}

/// Pairs that need an exact decision, and whether the search stopped early.
pub(super) struct Pairs {
    /// The lower face first; in an order that depends on the tree alone.
    pub(super) pairs: Vec<[u32; 2]>,
    /// Number of pairs that were compared.
    looks: usize,
    pub(super) overflow: bool,
}

/// Finds pairs until there are `limit` of them; `take` reserves memory for so many more.
pub(super) fn find(
    shape: &HalfEdgeMesh,
    tree: &FaceTree,
    limit: usize,
    take: &mut dyn FnMut(usize) -> Result<(), OverBudget>,
) -> Result<Pairs, OverBudget> {
    // Split the tree into groups of nodes.
    let nodes = walk_order(shape, tree);
    let groups = groups(&nodes);
    let mut found = Pairs {
        pairs: Vec::new(),
        looks: 0,
        overflow: false,
    };
    for round in groups.chunks(ROUND) {
        // Stop where pairs or looks exceed what a drawing can use.
        let looks_most = LOOKS + LOOKS_PER_FACE * shape.faces.len();
        if found.pairs.len() >= limit || found.looks >= looks_most {
            found.overflow = true;
            break;
        }

        // Find the pairs of a round of groups, then pay for them.
        let per_group: Vec<Pairs> = round
            .par_iter()
            .map_init(Candidates::default, |candidates, group| {
                candidates.gather(&nodes, *group);
                candidates.pairs(shape)
            })
            .collect();
        for group in per_group {
            found.overflow |= group.overflow;
            found.looks += group.looks;
            take(group.pairs.len())?;
            found.pairs.extend(group.pairs);
        }
    }
    Ok(found)
}

/// Lays the nodes out so that a walk without a stack reads them front to back.
fn walk_order(shape: &HalfEdgeMesh, tree: &FaceTree) -> Vec<Node> {
    let from = &tree.bvh.nodes;
    let mut nodes: Vec<Node> = Vec::with_capacity(2 * shape.faces.len());
    // A second visit, marked by its place in `nodes`, closes an inner node.
    let mut stack: Vec<(u32, u32)> = Vec::new();
    if !from.is_empty() {
        stack.push((0, NONE));
    }
    while let Some((index, opened)) = stack.pop() {
        if opened != NONE {
            nodes[opened as usize].skip = nodes.len() as u32;
            continue;
        }
        let node = &from[index as usize];
        let place = nodes.len() as u32;
        let laid_out = |bounds: &Aabb, place: u32, face: u32| Node {
            min: bounds.min.to_array(),
            skip: place + 1,
            max: bounds.max.to_array(),
            face,
        };
        if node.is_leaf() {
            for face in FaceTree::faces_of(node) {
                let corners = shape.faces[face as usize].map(|v| shape.positions[v as usize]);
                nodes.push(laid_out(&box_of(corners), nodes.len() as u32, face));
            }
        } else {
            nodes.push(laid_out(node.aabb(), place, NONE));
            stack.push((index, place));
            stack.push((node.first_index + 1, NONE));
            stack.push((node.first_index, NONE));
        }
    }
    nodes
}

/// The topmost nodes with at most [`GROUP`] leaves: together they hold every leaf once.
fn groups(nodes: &[Node]) -> Vec<u32> {
    let mut groups = Vec::new();
    let mut index = 0;
    while let Some(node) = nodes.get(index as usize) {
        if node.skip - index < 2 * GROUP {
            groups.push(index);
            index = node.skip;
        } else {
            index += 1;
        }
    }
    groups
}

fn overlap(a: &Node, b: &Node) -> bool {
    (0..3).all(|i| a.min[i] <= b.max[i] && b.min[i] <= a.max[i])
}

/// Whether all faces of two nodes lie in one plane across an axis, where they share no line.
fn lie_in_one_plane(a: &Node, b: &Node) -> bool {
    (0..3).any(|i| [a.max[i], b.min[i], b.max[i]] == [a.min[i]; 3])
}

/// Leaves of a group, and those behind them in the walk whose boxes meet the group's.
#[derive(Default)]
struct Candidates {
    leaves: Vec<Node>,
    /// Number of leaves that belong to the group.
    own: usize,
    near: Vec<u32>,
}

impl Candidates {
    /// Gathers the leaves of a group, and only later ones of others: every pair is found from its first face.
    fn gather(&mut self, nodes: &[Node], group: u32) {
        self.leaves.clear();
        let around = &nodes[group as usize];
        let inside = &nodes[group as usize..around.skip as usize];
        self.leaves
            .extend(inside.iter().filter(|node| node.face != NONE));
        self.own = self.leaves.len();
        let mut index = around.skip;
        while let Some(node) = nodes.get(index as usize) {
            if !overlap(node, around) || lie_in_one_plane(node, around) {
                index = node.skip;
                continue;
            }
            if node.face != NONE {
                self.leaves.push(*node);
            }
            index += 1;
        }
    }

    fn pairs(&mut self, shape: &HalfEdgeMesh) -> Pairs {
        let mut found = Pairs {
            pairs: Vec::new(),
            looks: 0,
            overflow: false,
        };
        for place in 0..self.own {
            let leaf = self.leaves[place];
            self.meet(&leaf, place + 1);
            if self.near.is_empty() {
                continue;
            }
            let subject = Subject::of(shape, leaf.face);
            // Faces in one plane across an axis are told apart at once.
            found.looks += if subject.level.is_some() {
                0
            } else {
                self.near.len()
            };
            let faces = self.near.iter();
            let faces = faces.filter(|other| subject.may_cut(shape, **other));
            let pairs = faces.map(|other| [leaf.face.min(*other), leaf.face.max(*other)]);
            found.pairs.extend(pairs);
            if found.pairs.len() > GROUP_LIMIT {
                found.overflow = true;
                break;
            }
        }
        found
    }

    /// Sets `near` to the faces, from a place in the list on, whose boxes meet a leaf's.
    fn meet(&mut self, leaf: &Node, from: usize) {
        let others = &self.leaves[from..];
        self.near.resize(others.len(), 0);
        let mut count = 0;
        // Without a branch: most boxes here are as likely to overlap as not.
        for other in others {
            self.near[count] = other.face;
            count += usize::from(
                (leaf.min[0] <= other.max[0])
                    & (other.min[0] <= leaf.max[0])
                    & (leaf.min[1] <= other.max[1])
                    & (other.min[1] <= leaf.max[1])
                    & (leaf.min[2] <= other.max[2])
                    & (other.min[2] <= leaf.max[2]),
            );
        }
        self.near.truncate(count);
    }
}

/// Rounding error of a projection or distance, as a fraction of the sum of its absolute products.
///
/// Above the bound of the distance from a plane in [Shewchuk 1997, orient3d]: 7.8e-16.
const ROUNDING: f64 = 2e-15;

/// The corners of a face in double precision.
struct Corners {
    vertices: [u32; 3],
    points: [[f64; 3]; 3],
}

impl Corners {
    #[inline]
    fn of(shape: &HalfEdgeMesh, face: u32) -> Self {
        let vertices = shape.faces[face as usize];
        let points = vertices.map(|v| shape.positions[v as usize].map(f64::from));
        Self { vertices, points }
    }

    /// Where the corners lie along an axis, from an origin, each with a bound on its rounding.
    #[inline]
    fn projections(&self, axis: [f64; 3], origin: [f64; 3]) -> [[f64; 2]; 3] {
        self.points.map(|point| {
            let (mut place, mut bound) = (0.0, 0.0);
            for i in 0..3 {
                let product = axis[i] * (point[i] - origin[i]);
                place += product;
                bound += product.abs();
            }
            [place, bound * ROUNDING]
        })
    }
}

/// Which corner of the first face and which of the second are the same vertex.
type Shared = Option<[usize; 2]>;

/// A face's plane, with what bounds its rounding.
struct Plane {
    origin: [f64; 3],
    normal: [f64; 3],
    /// The normal with all its terms made positive.
    bound: [f64; 3],
}

impl Plane {
    #[inline]
    fn of(corners: &Corners) -> Self {
        let [a, b, c] = corners.points;
        let u: [f64; 3] = std::array::from_fn(|i| b[i] - a[i]);
        let v: [f64; 3] = std::array::from_fn(|i| c[i] - a[i]);
        let (mut normal, mut bound) = ([0.0; 3], [0.0; 3]);
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let (first, second) = (u[j] * v[k], u[k] * v[j]);
            normal[i] = first - second;
            bound[i] = first.abs() + second.abs();
        }
        Self {
            origin: a,
            normal,
            bound,
        }
    }

    /// 1 in front, -1 behind, 0 where rounding leaves it open.
    #[inline]
    fn sign(&self, point: [f64; 3]) -> i32 {
        let offset: [f64; 3] = std::array::from_fn(|i| point[i] - self.origin[i]);
        let along = |v: [f64; 3], d: [f64; 3]| v[0] * d[0] + v[1] * d[1] + v[2] * d[2];
        let distance = along(self.normal, offset);
        let bound = along(self.bound, offset.map(f64::abs)) * ROUNDING;
        i32::from(distance > bound) - i32::from(distance < -bound)
    }

    /// Whether all corners of the other face, except a shared one, surely lie on one side.
    #[inline]
    fn clears(&self, other: &Corners, shared: Option<usize>) -> bool {
        let mut sum = 0;
        let mut count = 0;
        for (corner, point) in other.points.into_iter().enumerate() {
            if Some(corner) != shared {
                sum += self.sign(point);
                count += 1;
            }
        }
        sum.abs() == count
    }
}

/// A face that others are compared with.
struct Subject {
    corners: Corners,
    plane: Plane,
    /// The axis that the face lies across, and its place on it.
    level: Option<(usize, f32)>,
}

impl Subject {
    fn of(shape: &HalfEdgeMesh, face: u32) -> Self {
        let corners = Corners::of(shape, face);
        let plane = Plane::of(&corners);
        let [a, b, c] = corners.vertices.map(|v| shape.positions[v as usize]);
        let axis = (0..3).find(|axis| a[*axis] == b[*axis] && b[*axis] == c[*axis]);
        Self {
            corners,
            plane,
            level: axis.map(|axis| (axis, a[axis])),
        }
    }

    /// Whether two faces may share a piece. Faces that share an edge meet there alone, those beside each other only at
    /// a shared corner.
    fn may_cut(&self, shape: &HalfEdgeMesh, face: u32) -> bool {
        let vertices = shape.faces[face as usize];
        // Faces in one plane across an axis: the commonest flat surfaces, and the dearest to decide exactly.
        if let Some((axis, level)) = self.level {
            let is_level = |v: u32| shape.positions[v as usize][axis] == level;
            if vertices.into_iter().all(is_level) {
                return false;
            }
        }
        let mut shared: Shared = None;
        for (i, vertex) in self.corners.vertices.iter().enumerate() {
            if let Some(j) = vertices.iter().position(|v| v == vertex) {
                if shared.is_some() {
                    return false;
                }
                shared = Some([i, j]);
            }
        }
        let other = Corners::of(shape, face);
        !are_apart(&self.corners, &other, shared)
            && !self.plane.clears(&other, shared.map(|s| s[1]))
            && !Plane::of(&other).clears(&self.corners, shared.map(|s| s[0]))
    }
}

/// Whether a plane across the way between the faces surely separates them, except for a shared corner.
///
/// It settles most faces around one vertex, also in flat regions, where their own planes decide nothing.
#[inline]
fn are_apart(a: &Corners, b: &Corners, shared: Shared) -> bool {
    // Lay both triangles along the line between their middles.
    let axis: [f64; 3] = std::array::from_fn(|i| {
        (a.points[0][i] + a.points[1][i] + a.points[2][i])
            - (b.points[0][i] + b.points[1][i] + b.points[2][i])
    });

    // Measure from the corner that they share, or from any.
    let origin = a.points[shared.map_or(0, |s| s[0])];
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (corner, [place, bound]) in a.projections(axis, origin).into_iter().enumerate() {
        if shared.is_none_or(|s| s[0] != corner) {
            low = low.min(place - bound);
        }
    }
    for (corner, [place, bound]) in b.projections(axis, origin).into_iter().enumerate() {
        if shared.is_none_or(|s| s[1] != corner) {
            high = high.max(place + bound);
        }
    }

    // They are apart where one ends before the other begins.
    match shared {
        Some(_) => low > 0.0 && high < 0.0,
        None => low > high,
    }
}
