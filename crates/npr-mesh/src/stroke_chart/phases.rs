//! How far along the strokes, and across them, each node lies: one angle each, a full turn per tile.
//!
//! Between neighbours the directions predict how many tiles lie between them. Predictions around a loop need not
//! add up to whole tiles; angles that agree with all of them as well as possible spread the rest evenly, and where
//! it exceeds one tile, a stroke ends [Knöppel et al. 2015].

use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::direction_field::complex::Complex;
use crate::direction_field::hierarchy::{Level, View};
use crate::direction_field::nodes::Nodes;
use crate::direction_field::turned;

/// A node with its stroke direction in one of its two senses; positions count in tiles.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Site {
    pub(crate) position: Vec3,
    pub(crate) normal: Vec3,
    pub(crate) direction: Vec3,
}

impl Site {
    pub(crate) fn of(nodes: &Nodes, directions: &[Vec3], node: usize) -> Self {
        Self {
            position: Vec3::from_array(nodes.positions[node]),
            normal: nodes.normals[node],
            direction: directions[node],
        }
    }

    pub(crate) fn reversed_if(self, reversed: bool) -> Self {
        Self {
            direction: if reversed {
                -self.direction
            } else {
                self.direction
            },
            ..self
        }
    }

    /// Whether the directions of two neighbours point opposite ways.
    pub(crate) fn opposes(&self, other: &Self) -> bool {
        self.direction
            .dot(turned(other.direction, other.normal, self.normal))
            < 0.0
    }

    /// Tiles across and along the strokes on the way to `other`, whose direction points the same way.
    pub(crate) fn tiles_to(&self, other: &Self) -> Vec2 {
        let step = other.position - self.position;
        let facing = self.normal + other.normal;
        let lift = facing.dot(step) / step.length_squared().max(f32::MIN_POSITIVE);
        let between = (facing - step * lift).try_normalize();
        let between = between.unwrap_or(self.normal);
        0.5 * (self.tiles_of(step, between) + other.tiles_of(step, between))
    }

    /// What the site's own directions make of a step, once they have been turned into the plane with the normal
    /// `plane` that holds it. On a ruled surface, such as a cylinder, this is exact.
    fn tiles_of(&self, step: Vec3, plane: Vec3) -> Vec2 {
        let along = turned(self.direction, self.normal, plane);
        Vec2::new(along.cross(plane).dot(step), along.dot(step))
    }
}

/// Where each node lies between whole tiles, across and along the strokes, -0.5..=0.5.
///
/// O(rounds * nodes).
pub(crate) fn phases(nodes: &Nodes, directions: &[Vec3], rounds: u32) -> Vec<Vec2> {
    let pulls = vec![[Complex::default(); 2]; nodes.count()];
    let site = |node| Site::of(nodes, directions, node);
    let level = Level::new(nodes, pulls, |node, other| view(&site(node), site(other)));
    let angles = level.solve(rounds);
    angles
        .par_iter()
        .map(|angles| Vec2::from_array(angles.map(Complex::turns)))
        .collect()
}

/// How the angles of the node `there` look from `here`.
fn view(here: &Site, there: Site) -> View<2> {
    let flips = here.opposes(&there);
    let tiles = there.reversed_if(flips).tiles_to(here);
    View {
        flips,
        turns: tiles.to_array().map(Complex::of_turns),
    }
}
