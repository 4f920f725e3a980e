//! Turns borders and ink into runs.

use super::border::Borders;
use super::chain::{Chain, Label, chains, cuts, middle_of, place_of};
use super::ink::LineInk;
use super::picture::{ImageScene, SurfacePicture};
use crate::mesh_lines::draw::{LineSettings, StrokeLook, calmed, strokes_of};
use crate::mesh_lines::run::{Run, RunPoint, base_id, number};
use crate::project::{Lens, Projector};
use crate::rank::hash_key;
use crate::stroke::{Kind, Stroke};
use crate::surface_location::{SurfaceLocation, share_along};
use glam::{DVec2, DVec3};
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_trace::centreline::{CentrelineOptions, centrelines, smooth_border};
use npr_trace::{Bitmap, BitmapError};
use rayon::prelude::*;

/// Angle, in radians, from which a bend between straight sides is a corner.
const CORNER: f64 = 0.7;

/// Number of borders under which a closed line is left out: it goes around a few pixels that come and go.
const LEAST_RING: usize = 12;

/// A point of a line, and its label.
#[derive(Debug, Clone, Copy)]
struct Found {
    point: RunPoint,
    /// The bit of its kind, and its surface.
    label: Label,
}

/// The input that runs are made from.
pub type On<'a> = (&'a ImageScene<'a>, &'a Projector, &'a SurfacePicture);

/// The strokes of runs found in a picture, with the widths and colours of `look`: joined, cut at corners and smoothed
/// as those of meshes are, as far as the settings ask for it.
pub fn strokes_from(
    runs: Vec<Run>,
    (shape, lens): (&HalfEdgeMesh, Lens),
    settings: &LineSettings,
    look: &StrokeLook<'_>,
) -> Vec<Stroke> {
    strokes_of(calmed(runs, settings, lens, None), &|run, point| {
        look.paint(shape, run, point)
    })
}

impl LineInk {
    /// The lines of the ink as runs of the shape: each line once, along its middle, cut where its kind or surface
    /// changes.
    ///
    /// Places, depths and identities are those of the pixels that own the ink: the identity hangs on the mesh edge
    /// with the least hash of those nearest to the line. O(pixels + length of lines), in parallel.
    ///
    /// # Errors
    ///
    /// [`BitmapError`] for pictures beyond its limit.
    pub fn runs(&self, (scene, projector, picture): On<'_>) -> Result<Vec<Run>, BitmapError> {
        // Follow the ink along its middle.
        let mut bitmap = Bitmap::new(self.size[0], self.size[1])?;
        for y in 0..self.size[1] {
            for x in (0..self.size[0]).filter(|x| self.is_ink(*x, y)) {
                bitmap.set(x, y, true);
            }
        }
        let lines = centrelines(&bitmap, &CentrelineOptions::default());

        // Put the points of each stroke on the surface of the ink near them.
        let maker = Maker {
            paint: 1 + u64::from(self.is_light),
            scene,
            projector,
            picture,
        };
        let runs = lines.strokes.par_iter().flat_map_iter(|stroke| {
            let found = stroke.points.iter().filter_map(|point| {
                let owner = self.owner_near(point.place)?;
                maker.found(point.place, owner, self.kinds[owner as usize])
            });
            maker.runs(found.collect(), stroke.closed)
        });
        let mut runs: Vec<Run> = runs.collect();
        number(&mut runs);
        Ok(runs)
    }
}

impl Borders {
    /// The lines of the borders as runs of the shape: each line once, cut where its kind or surface changes.
    ///
    /// Where lines meet, those on one surface continue each other: an outline runs past what it hides. Places, depths
    /// and identities are those of the pixels that own the borders, as for [`LineInk::runs`]. O(borders log borders),
    /// in parallel.
    pub fn runs(&self, (scene, projector, picture): On<'_>) -> Vec<Run> {
        let maker = Maker {
            paint: 0,
            scene,
            projector,
            picture,
        };

        // Link borders to chains, without rings so short that they are dots.
        let surface_of = |pixel: u32| picture.pixels[pixel as usize].part;
        let chains = chains(self, surface_of);
        let is_dot = |chain: &Chain| chain.closed && chain.borders.len() < LEAST_RING;
        let lines = chains.par_iter().filter(|chain| !is_dot(chain));

        // Make a run of each chain that keeps enough points.
        let runs = lines.filter_map(|chain| {
            let found = self.along(chain, &maker);
            let is_enough = found.len() >= if chain.closed { 3 } else { 2 };
            let points = found.into_iter().map(|found| found.point).collect();
            is_enough
                .then(|| maker.run(points, chain.label, chain.closed))
                .flatten()
        });
        let mut runs: Vec<Run> = runs.collect();
        number(&mut runs);
        runs
    }

    /// Smooth points along a chain: one for every border, and the ends of an open chain.
    fn along(&self, chain: &Chain, maker: &Maker<'_>) -> Vec<Found> {
        // Take the middles of the sides, and the corners at which an open chain ends.
        let borders = chain
            .borders
            .iter()
            .map(|border| self.all[*border as usize]);
        let mut along: Vec<(DVec2, u32)> = borders
            .map(|border| (middle_of(self.size, border.side), border.owner))
            .collect();
        if let ([first, ..], [.., last], false) = (&along[..], &along[..], chain.closed) {
            let [start, end] = [(chain.ends[0], first.1), (chain.ends[1], last.1)]
                .map(|(corner, owner)| (place_of(self.size, corner), owner));
            along.insert(0, start);
            along.push(end);
        }

        // Smooth the stairs of the pixels.
        let places: Vec<DVec2> = along.iter().map(|(place, _)| *place).collect();
        let pinned = chain.free.map(|free| !free);
        let smooth = smooth_border(&places, chain.closed, pinned, CORNER);

        // Put the points on the surface that owns the border.
        let found = smooth
            .into_iter()
            .zip(along)
            .filter_map(|(place, (_, owner))| maker.found(place.to_array(), owner, chain.label[0]));
        let mut found: Vec<Found> = found.collect();
        found.dedup_by(|a, b| a.point.place == b.point.place);
        found
    }
}

struct Maker<'a> {
    /// Added to the identities of painted lines, so that they differ from those of marked edges.
    paint: u64,
    scene: &'a ImageScene<'a>,
    projector: &'a Projector,
    picture: &'a SurfacePicture,
}

impl Maker<'_> {
    /// The runs of a line, cut where its label changes.
    fn runs(&self, mut found: Vec<Found>, is_closed: bool) -> Vec<Run> {
        found.dedup_by(|a, b| a.point.place == b.point.place);
        let labels = |found: &[Found]| found.iter().map(|found| found.label).collect::<Vec<_>>();
        let mut parts = cuts(&labels(&found));
        let is_whole = parts.len() == 1;
        if is_closed && !is_whole {
            // Around the seam a part goes on.
            let start = parts.first().map_or(0, |part| part.1);
            found.rotate_left(start);
            parts = cuts(&labels(&found));
        }
        let count = found.len();
        let runs = parts.into_iter().filter_map(|(from, to, label)| {
            let closed = is_closed && is_whole;
            // A part runs on to the first point of the next.
            let reach = if to < count || (is_closed && !is_whole) {
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

    fn run(&self, points: Vec<RunPoint>, [kind, surface]: Label, closed: bool) -> Option<Run> {
        let kind = Kind::first_of(kind)?;
        let shape = self.scene.shape;
        let edges = points
            .iter()
            .map(|point| (hash_key(point.edge), point.edge));
        let (_, edge) = edges.min()?;
        // Painted lines are told apart from marked edges by the numbers after the last kind.
        let of_paint = u64::from(kind == Kind::Marked) * self.paint;
        Some(Run {
            id: base_id(edge, kind) + of_paint,
            kind,
            surface,
            object: shape.surfaces[surface as usize].object,
            occluders: 0,
            closed,
            cut: [false; 2],
            beyond: [None; 2],
            part: None,
            weight: 1.0,
            points,
        })
    }

    /// The edge of a face that is nearest to a place: at a contour mostly one whose other face is turned away.
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

    /// A point of a run at a place of the picture, on the surface of a pixel; `None` if that shows nothing.
    fn found(&self, place: [f64; 2], owner: u32, kind: u32) -> Option<Found> {
        let face = *self.picture.faces.get(owner as usize)?;
        let pixel = self.picture.pixels[owner as usize];
        let surface = *self.scene.shape.face_surfaces.get(face as usize)?;
        let depth = f64::from(pixel.depth);
        let world = self.projector.unproject(place, depth);
        let edge = self.edge_beside(face, world);
        world.is_finite().then_some(Found {
            point: RunPoint {
                place,
                depth,
                world,
                edge,
                t: 0.5,
                location: SurfaceLocation { edge, face },
                leaps: false,
            },
            label: [kind, surface],
        })
    }
}
