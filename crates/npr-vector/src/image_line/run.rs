//! From ink to runs.

use super::ink::LineInk;
use super::picture::{ImageScene, SurfacePicture};
use crate::centreline::{CentreStroke, CentrelineOptions, centrelines};
use crate::draw::{LineSettings, StrokeLook, calmed, strokes_of};
use crate::project::Projector;
use crate::rank::hash_key;
use crate::run::{Run, RunPoint, base_id, number};
use crate::seat::{Seat, share_along};
use crate::stroke::{Kind, Stroke};
use crate::trace::{Bitmap, BitmapError};
use glam::DVec3;
use rayon::prelude::*;

/// Parts of a line with fewer points than this take on the kind and surface of what is beside them: pixels at corners show either.
const LEAST_PART: usize = 6;

/// A point of a line, and what it was found on.
#[derive(Debug, Clone, Copy)]
struct Found {
    point: RunPoint,
    /// A bit of kinds, and the surface.
    label: [u32; 2],
}

impl LineInk {
    /// The strokes of the ink, as `look` has them along themselves: its runs joined, cut at corners and smoothed as those of meshes are, as
    /// far as the settings ask for it.
    ///
    /// # Errors
    ///
    /// As [`LineInk::runs`].
    pub fn strokes(
        &self,
        (scene, projector, picture): (&ImageScene<'_>, &Projector, &SurfacePicture),
        settings: &LineSettings,
        look: &StrokeLook<'_>,
    ) -> Result<Vec<Stroke>, BitmapError> {
        let runs = calmed(self.runs(scene, projector, picture)?, settings);
        Ok(strokes_of(runs, &|run, point| {
            look.paint(scene.shape, run, point)
        }))
    }

    /// The lines of the ink as runs of the shape: each line once, along its middle, cut where its kind or surface changes.
    ///
    /// Places, depths and identities are those of the pixels that own the ink: the identity hangs on the mesh edge with the least hash of
    /// those nearest to the line. O(pixels + length of lines), in parallel.
    ///
    /// # Errors
    ///
    /// [`BitmapError`] for pictures beyond its limit.
    pub fn runs(
        &self,
        scene: &ImageScene<'_>,
        projector: &Projector,
        picture: &SurfacePicture,
    ) -> Result<Vec<Run>, BitmapError> {
        let mut bitmap = Bitmap::new(self.size[0], self.size[1])?;
        for y in 0..self.size[1] {
            for x in (0..self.size[0]).filter(|x| self.is_ink(*x, y)) {
                bitmap.set(x, y, true);
            }
        }
        let found = centrelines(&bitmap, &CentrelineOptions::default());
        let maker = Maker {
            ink: self,
            scene,
            projector,
            picture,
        };
        let mut runs: Vec<Run> = found
            .strokes
            .par_iter()
            .flat_map_iter(|stroke| maker.runs(stroke))
            .collect();
        number(&mut runs);
        Ok(runs)
    }
}

struct Maker<'a> {
    ink: &'a LineInk,
    scene: &'a ImageScene<'a>,
    projector: &'a Projector,
    picture: &'a SurfacePicture,
}

impl Maker<'_> {
    fn runs(&self, stroke: &CentreStroke) -> Vec<Run> {
        let places = stroke.points.iter().map(|point| point.place);
        let mut found: Vec<Found> = places.filter_map(|place| self.found(place)).collect();
        found.dedup_by(|a, b| a.point.place == b.point.place);
        let mut parts = parts(&found);
        let is_whole = parts.len() == 1;
        if stroke.closed && !is_whole {
            // Around the seam a part goes on.
            let start = parts.first().map_or(0, |part| part.1);
            found.rotate_left(start);
            parts = self::parts(&found);
        }
        let count = found.len();
        let runs = parts.into_iter().filter_map(|(from, to, label)| {
            let closed = stroke.closed && is_whole;
            // A part runs on to the first point of the next.
            let reach = if to < count || (stroke.closed && !is_whole) {
                to + 1
            } else {
                to
            };
            let points: Vec<RunPoint> = (from..reach).map(|k| found[k % count].point).collect();
            let is_enough = points.len() >= if closed { 3 } else { 2 };
            is_enough.then(|| self.run(points, label, closed)).flatten()
        });
        runs.collect()
    }

    fn run(&self, points: Vec<RunPoint>, [kind, surface]: [u32; 2], closed: bool) -> Option<Run> {
        let kind = Kind::ALL.into_iter().find(|known| known.bit() == kind)?;
        let shape = self.scene.shape;
        let edges = points
            .iter()
            .map(|point| (hash_key(point.edge), point.edge));
        let (_, edge) = edges.min()?;
        // Painted lines are told apart from marked edges by the number after the last kind.
        let of_paint = u64::from(kind == Kind::Marked);
        Some(Run {
            id: base_id(edge, kind) + of_paint,
            kind,
            surface,
            object: shape.surfaces[surface as usize].object,
            occluders: 0,
            closed,
            cut: [false; 2],
            weight: 1.0,
            points,
        })
    }

    /// The edge of a face that is nearest to a place: of contours mostly one whose other face is turned away.
    fn edge_beside(&self, face: u32, world: DVec3) -> u32 {
        let shape = self.scene.shape;
        let distance = |edge: &u32| {
            let [a, b] = shape.ends(*edge).map(|vertex| shape.point(vertex));
            world.distance_squared(a.lerp(b, share_along([a, b], world)))
        };
        let edges = [0, 1, 2].map(|k| shape.edge_of[3 * face as usize + k]);
        let nearest = edges
            .into_iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.unwrap_or(edges[0])
    }

    /// A point of a run at a place of the picture; none where no line is near.
    fn found(&self, place: [f64; 2]) -> Option<Found> {
        let owner = self.ink.owner_near(place)? as usize;
        let face = *self.picture.faces.get(owner)?;
        let pixel = self.picture.pixels[owner];
        let surface = *self.scene.shape.face_surfaces.get(face as usize)?;
        let depth = f64::from(pixel.depth);
        let world = self.projector.unproject(place, depth);
        let edge = self.edge_beside(face, world);
        world.is_finite().then(|| Found {
            point: RunPoint {
                place,
                depth,
                world,
                edge,
                t: 0.5,
                seat: Seat { edge, face },
            },
            label: [self.ink.kinds[owner], surface],
        })
    }
}

/// Stretches of equal labels, as first, end and label; short ones belong to what is before them, or else after.
fn parts(found: &[Found]) -> Vec<(usize, usize, [u32; 2])> {
    let mut parts: Vec<(usize, usize, [u32; 2])> = Vec::new();
    for stretch in found.chunk_by(|a, b| a.label == b.label) {
        let own = stretch[0].label;
        let from = parts.last().map_or(0, |part| part.1);
        let to = from + stretch.len();
        match parts.last_mut() {
            Some((first, last, label)) if *last - *first < LEAST_PART => {
                (*last, *label) = (to, own);
            }
            Some((_, last, label)) if stretch.len() < LEAST_PART || *label == own => {
                *last = to;
            }
            _ => parts.push((from, to, own)),
        }
    }
    parts
}
