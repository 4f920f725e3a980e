//! Smoke among lines: spheres, the lines that they hide, and the outline that they are drawn with.
//!
//! The outline of a sphere is a circle in space, and another sphere covers one arc of it, known in closed form. What no
//! sphere covers is what a pen draws: there lies nothing behind the silhouette, or smoke far enough behind it [Hoshino
//! 2004, 3.5]. Nothing is sampled, so arcs end exactly where images of spheres cross.

mod cover;
mod grid;
mod outline;
mod silhouette;
mod sphere;
#[cfg(test)]
mod tests;

pub use outline::{SilhouettePoint, SmokeLines};

use crate::mesh_lines::visibility::{Occluders, Piece};
use crate::project::Projector;
use glam::DVec3;
use grid::PuffGrid;
use npr_core::smoke::Sphere;
use sphere::Puff;
use std::collections::BTreeSet;

/// How much nearer than a point a puff must be to hide it, as a share of its radius: lines on a sphere must not break
/// into dashes.
const NEARER: f64 = 1e-6;

/// The spheres of smoke in a view, sorted into a grid over the picture.
///
/// Left out are spheres that pictures do not show either: without size, with numbers that are none, behind the eye;
/// and those that the near plane cuts, as around the eye. Of equal spheres the first counts.
#[derive(Debug, Clone)]
pub struct Puffs {
    projector: Projector,
    /// Those that touch the picture and a margin, from front to back.
    puffs: Vec<Puff>,
    grid: PuffGrid,
}

impl Puffs {
    /// Sorts spheres for a view on a picture of `size` pixels. O(n log n).
    pub fn new(projector: &Projector, size: [u32; 2], spheres: &[Sphere]) -> Self {
        let mut known = BTreeSet::new();
        let mut is_first = |sphere: &Sphere| {
            let [x, y, z] = sphere.center;
            // -0 equals 0, and adding 0 makes it so.
            known.insert([x, y, z, sphere.radius].map(|v| (v + 0.0).to_bits()))
        };
        let mut puffs: Vec<Puff> = (0..)
            .zip(spheres)
            .filter(|(_, sphere)| is_first(sphere))
            .filter_map(|(number, sphere)| Puff::new(projector, number, sphere))
            .filter(|puff| grid::touches(size, puff))
            .collect();
        puffs.sort_by(|a, b| {
            let fronts = a.front().total_cmp(&b.front());
            fronts.then(a.number.cmp(&b.number))
        });
        Self {
            projector: *projector,
            grid: PuffGrid::new(size, &puffs),
            puffs,
        }
    }

    /// Whether no sphere is in sight.
    pub fn is_empty(&self) -> bool {
        self.puffs.is_empty()
    }

    /// View depth of the smoke at a place in the picture, in pixels; `None` where there is none.
    pub fn depth_at(&self, place: [f64; 2]) -> Option<f64> {
        let is_perspective = self.projector.is_perspective();
        let start = self.projector.near().max(1e-300);
        let point = self
            .projector
            .from_eye(self.projector.unproject(place, start));
        let entries = self.around(place).filter_map(|puff| {
            let entry = puff.entry(is_perspective, point)?;
            let stretch = if is_perspective {
                point.z / point.length()
            } else {
                1.0
            };
            Some(point.z + entry * stretch)
        });
        entries.reduce(f64::min)
    }

    /// The puffs whose image may hold a place.
    fn around(&self, place: [f64; 2]) -> impl Iterator<Item = &Puff> {
        let cell = self.grid.cell_at(place).iter();
        cell.map(|index| &self.puffs[*index as usize])
    }
}

impl Occluders for Puffs {
    /// Shares of a piece's image at which a puff may begin or end hiding it, in no order.
    ///
    /// Where the image of the piece crosses the silhouette of a puff, and where the piece goes through the sphere.
    /// O(puffs around it).
    fn cuts(&self, piece: &Piece) -> Vec<f64> {
        // Enclose the image of the piece.
        let ends = piece.world.map(|world| self.projector.from_eye(world));
        let [a, b] = piece.place;
        let corners = [
            a[0].min(b[0]),
            a[1].min(b[1]),
            a[0].max(b[0]),
            a[1].max(b[1]),
        ];

        // Cut it at every sphere whose image it may touch.
        let mut cuts = Vec::new();
        self.grid.visit(corners, |index| {
            let puff = &self.puffs[index as usize];
            let beside = |axis: usize| {
                puff.bounds[axis] > corners[axis + 2] || puff.bounds[axis + 2] < corners[axis]
            };
            if !beside(0) && !beside(1) {
                cuts.extend(puff.meetings(self.projector.is_perspective(), ends));
            }
            true
        });

        // Turn shares in space into shares of the image.
        let in_image = |t: f64| self.projector.image_share(t, piece.depth);
        cuts.retain(|t| (0.0..=1.0).contains(t));
        cuts.iter_mut().for_each(|t| *t = in_image(*t));
        cuts
    }

    /// Whether a puff stands before a point of the world. About O(puffs in the image of the point).
    fn hide(&self, world: DVec3) -> bool {
        let point = self.projector.from_eye(world);
        self.around(self.projector.project_from_eye(point))
            .any(|puff| {
                let entry = puff.entry(self.projector.is_perspective(), point);
                entry.is_some_and(|entry| entry < -NEARER * puff.radius)
            })
    }
}
