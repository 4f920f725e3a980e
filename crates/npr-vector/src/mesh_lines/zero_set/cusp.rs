//! Which pieces of a contour their own surface hides.

use super::normals::towards;
use super::signs::Signs;
use super::trace::Traced;
use crate::mesh_lines::graph::CurveNode;
use glam::DVec3;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use rayon::prelude::*;

/// Most pieces of a run that may be noise.
const NOISE_PIECES: usize = 2;

/// How one piece of line turns.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Turn {
    hidden: bool,
    /// Whether the piece runs along a mesh edge: the sign of its dihedral angle is exact, and never taken for noise.
    exact: bool,
    /// Length of the piece in the world.
    length: f64,
    /// Longest side of the face that it crosses.
    reach: f64,
}

/// Sets [`EdgeFlags::CONCAVE`] on pieces that their own surface hides, and [`EdgeFlags::CUSP`] where that changes.
///
/// In a face, the surface curves away from the eye where n.v grows along the view vector towards the eye [Hertzmann &
/// Zorin 2000, section 4.2; DeCarlo et al. 2003]: the gradient of n.v is constant there. A step between two faces is
/// hidden where its dihedral angle is concave.
///
/// A run of one or two pieces of the other sign is taken for noise, and turned, if it is shorter than both
/// neighbouring runs and than the mean of the longest sides of the faces it crosses.
pub(super) fn mark_cusps(signs: &Signs<'_>, traced: &mut Traced) {
    // Tell on which side of a cusp every piece lies.
    let mut hidden = vec![false; traced.along.len()];
    let turns: Vec<Turn> = (0..hidden.len())
        .into_par_iter()
        .with_min_len(64)
        .map(|node| signs.turn(traced, node))
        .collect();

    // Silence turns that only rounding makes.
    for chain in traced.graph.chains() {
        let mut of_chain: Vec<Turn> = chain.iter().map(|node| turns[*node as usize]).collect();
        silence(&mut of_chain, traced.graph.is_loop(&chain));
        for (node, turn) in chain.iter().zip(of_chain) {
            hidden[*node as usize] = turn.hidden;
        }
    }

    // Mark concave pieces, and cusps where they meet others.
    let nodes = &mut traced.graph.nodes;
    for index in 0..nodes.len() {
        let CurveNode { next, prev, .. } = nodes[index];
        if next != NONE && hidden[index] {
            nodes[index].flags |= EdgeFlags::CONCAVE.0;
        }
        if next != NONE && prev != NONE && hidden[index] != hidden[prev as usize] {
            nodes[index].flags |= EdgeFlags::CUSP.0;
        }
    }
}

/// A run of neighbouring pieces with the same sign.
#[derive(Debug, Clone, Copy)]
struct Run {
    from: usize,
    count: usize,
    length: f64,
    may_be_noise: bool,
}

/// Flips the sign of runs that are noise to that of their neighbours.
fn silence(turns: &mut [Turn], closed: bool) {
    // Begin a closed line where the sign changes, so that no run wraps around its end.
    let last = turns.len() - 1;
    let change = (0..last).find(|i| turns[*i].hidden != turns[*i + 1].hidden);
    let turn_by = match change {
        None => return,
        Some(change) if closed => change + 1,
        _ => 0,
    };
    turns.rotate_left(turn_by);
    let runs = runs(turns);
    for index in 0..runs.len() {
        // Open lines have no run before the first or after the last.
        let ends = !closed && (index == 0 || index + 1 == runs.len());
        let before = runs[(index + runs.len() - 1) % runs.len()].length;
        let after = runs[(index + 1) % runs.len()].length;
        let run = runs[index];
        if run.may_be_noise && !ends && run.length < before.min(after) {
            for turn in &mut turns[run.from..run.from + run.count] {
                turn.hidden = !turn.hidden;
            }
        }
    }
    turns.rotate_right(turn_by);
}

fn runs(turns: &[Turn]) -> Vec<Run> {
    let mut from = 0;
    let run = |pieces: &[Turn]| {
        let count = pieces.len();
        let length = pieces.iter().map(|piece| piece.length).sum();
        let reach: f64 = pieces.iter().map(|piece| piece.reach).sum();
        let noisy = count <= NOISE_PIECES && length < reach / count as f64;
        from += count;
        Run {
            from: from - count,
            count,
            length,
            may_be_noise: noisy && !pieces.iter().any(|piece| piece.exact),
        }
    };
    turns
        .chunk_by(|a, b| a.hidden == b.hidden)
        .map(run)
        .collect()
}

impl Signs<'_> {
    /// How the piece that starts at a node turns.
    fn turn(&self, traced: &Traced, node: usize) -> Turn {
        // Measure the piece and the face that it crosses.
        let CurveNode { face, next, .. } = traced.graph.nodes[node];
        let along = traced.along[node];
        let position_of = |node: u32| DVec3::from_array(traced.graph.position(self.shape, node));
        let corners = self.shape.faces[face as usize].map(|v| self.shape.point(v));
        let sides = [0, 1, 2].map(|i| corners[(i + 1) % 3] - corners[i]);
        let ends = match next {
            NONE => [DVec3::ZERO; 2],
            next => [node as u32, next].map(position_of),
        };

        // Tell on which side of a cusp it lies: along an edge by its dihedral angle, in a face by the gradient of n.v.
        let hidden = if next == NONE {
            false
        } else if along {
            self.rises_beyond(face, traced.graph.nodes[node].edge, corners)
        } else {
            let view = towards(self.eye, 0.5 * (ends[0] + ends[1]));
            self.gradient(face, sides).dot(view) <= 0.0
        };
        Turn {
            hidden,
            exact: along,
            length: ends[0].distance(ends[1]),
            reach: sides.map(DVec3::length).into_iter().fold(0.0, f64::max),
        }
    }

    /// Direction in which n.v grows fastest in a face, times a positive factor.
    fn gradient(&self, face: u32, sides: [DVec3; 3]) -> DVec3 {
        let normal = sides[0].cross(sides[1]);
        let towards_corner = |i: usize| normal.cross(sides[(i + 1) % 3]);
        (0..3)
            .map(|i| self.value(3 * face + i as u32) * towards_corner(i))
            .sum()
    }

    /// Whether the face on the other side of an edge leaves the plane of this one towards its front.
    fn rises_beyond(&self, face: u32, edge: u32, corners: [DVec3; 3]) -> bool {
        let on_edge = |side: &u32| self.shape.edge_of[*side as usize] == edge;
        let side = (3 * face..3 * face + 3).find(on_edge);
        let twin = side.map_or(NONE, |side| self.shape.twins[side as usize]);
        if twin == NONE {
            return false;
        }
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let tip = self.shape.point(self.shape.opposite(twin));
        normal.dot(tip - corners[0]) > 0.0
    }
}
