//! Contours along mesh edges, linked into closed loops by front-wedge rotation.
//!
//! A half-edge belongs to the set when its face is turned to the eye and the face across is not, or is missing.
//! Its successor is found by turning round its head through faces that are turned to the eye. Every
//! wedge of such faces has one way in and one way out, so the successor map is a permutation: all lines are
//! closed, on closed, open and non-manifold meshes alike. Pieces that are no contour only hold the loops together.

pub mod steps;

use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use glam::Vec4;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;
use std::ops::{Add, Mul, Sub};

/// Faces that a thread takes at once.
const CHUNK: usize = 4096;

/// The eye of a view, as decisions about facing read it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eye {
    /// Position with 1, or the direction towards the eye with 0; in the world.
    pub position: [f32; 4],
    /// A power of two that brings the shape's coordinates near 1, so that products neither vanish nor overflow.
    pub scale: f32,
}

impl Eye {
    /// An eye for a shape whose coordinates and distance from the eye do not exceed `extent`.
    pub fn new(position: [f64; 4], extent: f32) -> Self {
        let magnitude = extent.clamp(1e-30, 1e30);
        let exponent = (magnitude.to_bits() >> 23) as i32 - 127;
        Self {
            position: position.map(|v| v as f32),
            scale: f32::from_bits(((127 - exponent) as u32) << 23),
        }
    }

    /// Twice the area of the face times the scaled distance of the eye from its plane: positive where the face is
    /// turned to the eye.
    ///
    /// Sums, differences and products only, so that both engines decide alike.
    pub fn height_over(&self, corners: [[f32; 3]; 3]) -> f32 {
        self.heights_over(corners, |v| v)
    }

    /// [`Eye::height_over`] of one face or of several side by side; `all` gives a number to each.
    fn heights_over<T: Lanes>(&self, [a, b, c]: [[T; 3]; 3], all: impl Fn(f32) -> T) -> T {
        let scale = all(self.scale);
        let difference = |to: [T; 3]| std::array::from_fn(|i| (to[i] - a[i]) * scale);
        // From a corner to the eye, or the direction towards the eye in parallel view, which has no length to scale.
        let [x, y, z, w] = self.position;
        let scale = all(if w == 0.0 { 1.0 } else { self.scale });
        let toward = [x, y, z].map(&all);
        let toward = std::array::from_fn(|i| (toward[i] - a[i] * all(w)) * scale);
        dot(cross(difference(b), difference(c)), toward)
    }

    fn scaled_difference(&self, to: [f32; 3], from: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|i| (to[i] - from[i]) * self.scale)
    }
}

/// A number, or several side by side.
trait Lanes: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {}

impl Lanes for f32 {}
impl Lanes for Vec4 {}

/// Room for the nodes of a view's contours by the number of faces: a power of two that hardly a view exceeds.
///
/// Contours grow with a power of the number of faces: its root on smooth surfaces, whose contours are curves however
/// finely they are cut up, and about 0.8 over models of all sorts, for finer ones have finer detail [McGuire 2004].
/// Twice that law, rounded up, holds every view of the sample models (`tests/tests/contour_growth.rs`); small meshes
/// have room for every half-edge.
pub fn usual_room(face_count: usize) -> usize {
    const LEAST: usize = 1024;
    let law = 2.0 * npr_core::math::powf(face_count as f32, 0.8);
    let room = (law as usize).next_power_of_two().max(LEAST);
    room.min(3 * face_count)
}

/// Which faces are turned to the eye of a view, and the contours that follow from it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EdgeContours {
    /// Whether each face is turned to the eye: 1 or 0.
    pub front: Vec<u8>,
    /// The loops between front and back faces, with seams.
    pub graph: CurveGraph,
}

impl EdgeContours {
    /// [`facing`] and [`contours`] together.
    pub fn new(shape: &HalfEdgeMesh, eye: &Eye) -> Self {
        let front = facing(shape, eye);
        let graph = contours(shape, &front, eye);
        Self { front, graph }
    }
}

/// Whether each face is turned to the eye: 1 or 0.
///
/// Faces without area take over the orientation of their stand-in. O(faces), on all threads.
pub fn facing(shape: &HalfEdgeMesh, eye: &Eye) -> Vec<u8> {
    let mut front = vec![0; shape.faces.len()];
    (front
        .par_chunks_mut(CHUNK)
        .zip(shape.faces.par_chunks(CHUNK)))
    .for_each(|(front, faces)| {
        // Four faces at a time, and the rest one by one.
        let (fours, rest) = faces.as_chunks::<4>();
        let (front_fours, front_rest) = front.as_chunks_mut::<4>();
        for (front, faces) in front_fours.iter_mut().zip(fours) {
            let at = |face: usize, corner: usize| &shape.positions[faces[face][corner] as usize];
            let corner = |corner: usize| {
                let [a, b, c, d] = [at(0, corner), at(1, corner), at(2, corner), at(3, corner)];
                let lanes = |axis: usize| Vec4::new(a[axis], b[axis], c[axis], d[axis]);
                [lanes(0), lanes(1), lanes(2)]
            };
            let lanes = [corner(0), corner(1), corner(2)];
            let heights = eye.heights_over(lanes, Vec4::splat);
            *front = heights.to_array().map(|height| u8::from(height > 0.0));
        }
        for (front, corners) in front_rest.iter_mut().zip(rest) {
            let corners = corners.map(|v| shape.positions[v as usize]);
            *front = u8::from(eye.height_over(corners) > 0.0);
        }
    });
    for [face, stand_in] in &shape.degenerate_faces {
        front[*face as usize] = match *stand_in {
            NONE => 0,
            other => front[other as usize],
        };
    }
    front
}

/// The contour loops of a view; nodes are half-edges in ascending order, each at its tail.
///
/// Source: Hertzmann and Zorin's mesh contours; linking as in section 5.1-A of the method's description.
/// O(faces + contour · valence).
pub fn contours(shape: &HalfEdgeMesh, front: &[u8], eye: &Eye) -> CurveGraph {
    // Gather the half-edges at which the front faces end.
    let (twins, _) = shape.twins.as_chunks::<3>();
    let half_edges: Vec<u32> = (front.par_chunks(CHUNK).zip(twins.par_chunks(CHUNK)))
        .enumerate()
        .flat_map_iter(|(chunk, (facing, twins))| {
            let mut found = Vec::new();
            let faces = facing.iter().zip(twins).zip(chunk * CHUNK..);
            for ((_, twins), face) in faces.filter(|((is_front, _), _)| **is_front != 0) {
                for (side, twin) in (3 * face as u32..).zip(twins) {
                    if ends_front(front, *twin) {
                        found.push(side);
                    }
                }
            }
            found
        })
        .collect();

    // Link each to the one that follows it around the front.
    let mut nodes: Vec<CurveNode> = half_edges
        .par_iter()
        .with_min_len(512)
        .map(|half_edge| {
            let next = successor(shape, front, *half_edge);
            node_of(shape, eye, *half_edge, index_of(&half_edges, next))
        })
        .collect();

    // Link back.
    for index in 0..nodes.len() {
        let next = nodes[index].next as usize;
        nodes[next].prev = index as u32;
    }
    CurveGraph { nodes }
}

/// Whether the face across a half-edge of a front face is missing or not front.
fn leaves_front(shape: &HalfEdgeMesh, front: &[u8], half_edge: u32) -> bool {
    ends_front(front, shape.twins[half_edge as usize])
}

/// Whether the face of a half-edge is not front, or missing where it is [`NONE`].
fn ends_front(front: &[u8], half_edge: u32) -> bool {
    // There are fewer faces than a third of that number.
    front
        .get(half_edge as usize / 3)
        .is_none_or(|front| *front == 0)
}

/// The half-edge of the set that starts where this one ends, around the same wedge of front faces.
fn successor(shape: &HalfEdgeMesh, front: &[u8], half_edge: u32) -> u32 {
    let mut next = HalfEdgeMesh::following(half_edge);
    while !leaves_front(shape, front, next) {
        next = HalfEdgeMesh::following(shape.twins[next as usize]);
    }
    next
}

fn index_of(half_edges: &[u32], half_edge: u32) -> u32 {
    // The successor is in the set, since the walk stops nowhere else.
    half_edges.partition_point(|other| *other < half_edge) as u32
}

fn node_of(shape: &HalfEdgeMesh, eye: &Eye, half_edge: u32, next: u32) -> CurveNode {
    let edge = shape.edge_of[half_edge as usize];
    CurveNode {
        edge,
        t: if shape.runs_up(half_edge) { 0.0 } else { 1.0 },
        next,
        prev: NONE,
        flags: flags_of(shape, eye, half_edge, edge),
        face: half_edge / 3,
    }
}

/// The flags of a node: contour on an edge of two faces that are wound alike; on other edges, which are drawn as
/// features, seam.
fn flags_of(shape: &HalfEdgeMesh, eye: &Eye, half_edge: u32, edge: u32) -> u32 {
    let twin = shape.twins[half_edge as usize];
    let odd = EdgeFlags::BOUNDARY | EdgeFlags::NON_MANIFOLD | EdgeFlags::FLIPPED;
    if twin == NONE || shape.edge_traits[edge as usize].intersects(odd) {
        return EdgeFlags::SEAM.0;
    }
    if is_concave(shape, eye, half_edge, twin) {
        KindSet::CONTOUR | EdgeFlags::CONCAVE.0
    } else {
        KindSet::CONTOUR
    }
}

/// Whether the face across rises over the plane of the half-edge's face.
fn is_concave(shape: &HalfEdgeMesh, eye: &Eye, half_edge: u32, twin: u32) -> bool {
    let point = |v: u32| shape.positions[v as usize];
    let [tail, head] = shape.ends_of_half_edge(half_edge).map(point);
    let (own, across) = (
        point(shape.opposite(half_edge)),
        point(shape.opposite(twin)),
    );
    let from_tail = |p| eye.scaled_difference(p, tail);
    dot(cross(from_tail(head), from_tail(own)), from_tail(across)) > 0.0
}

fn cross<T: Lanes>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot<T: Lanes>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
