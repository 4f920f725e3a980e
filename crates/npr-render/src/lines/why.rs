//! Why a line of a drawing is there, and as wide and coloured as it is.
//!
//! Lines are found once more, by the same functions, and watched on the way: nothing of a style is computed beside the
//! renderer.

mod facts;

use super::model::LineModel;
use super::options::LineOptions;
use crate::error::RenderError;
use facts::Facts;
use glam::DVec3;
use npr_core::camera::Camera;
use npr_core::geometry::NONE;
use npr_stylesheet::Style;
use npr_vector::project::Projector;
use npr_vector::stroke::{Drawing, Kind, Stroke, StrokePoint};
use npr_vector::surface_location::SurfaceLocation;
use std::cell::RefCell;

/// How far from a spot strokes are watched beyond its reach, in pixels: a hand moves them by about as much.
const WATCH_PX: f64 = 24.0;

/// Width in pixels under which a line shows no ink that could be pointed at.
const THINNEST_PX: f64 = 0.05;

/// A step on the way to the width of strokes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WidthStep {
    /// What the style's source and the light make of the base width.
    Source,
    /// The factor of the part.
    Part,
    /// How fast a clip moves it.
    Motion,
    /// Pressure along strokes, and over depth.
    Pressure,
    /// Room between lines that lie side by side.
    Room,
    /// Ends that thin out.
    Taper,
}

/// Sees the strokes of a drawing after every step.
pub(crate) type Watch<'a> = &'a dyn Fn(WidthStep, &[Stroke]);

/// Watches nothing.
pub(super) fn nobody(_: WidthStep, _: &[Stroke]) {}

/// A place of a picture that somebody points at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// In pixels from the top left corner, y down.
    pub place: [f64; 2],
    /// How far from there the ink of a line may end that is meant, in pixels.
    pub reach_px: f64,
}

/// What is told of a line: a name, a sentence, and the key of the style that it comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fact {
    /// What it is about, one word or two.
    pub name: String,
    /// What is so.
    pub text: String,
    /// The key that decides it, that of a rule as `rule.2.line.color`; `None` where no key does.
    pub key: Option<String>,
}

/// What would remove a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Removal {
    /// `line.kinds` without its kind: all lines of this kind go, no others do.
    Kind(Kind),
    /// A rule with `line.on = false` for its part, as no key chooses lines that somebody asked for by hand.
    Part,
}

/// Why a line is there.
#[derive(Debug, Clone, PartialEq)]
pub struct LineReason {
    /// What the line is on the shape.
    pub kind: Kind,
    /// The part that it lies on.
    pub part: PointedPart,
    /// Number of surfaces in front of it; 0 where it is seen.
    pub occluders: u32,
    /// Its way through the picture, in pixels.
    pub points: Vec<[f64; 2]>,
    /// Whether its last point runs on to the first.
    pub closed: bool,
    /// Its width where it is nearest to the spot, in pixels.
    pub width_px: f64,
    /// Its colour there, sRGB bytes and alpha.
    pub color: [u8; 4],
    /// How far its ink ends from the spot, in pixels; 0 within it.
    pub away_px: f64,
    /// Kind, origin, visibility, width with its factors, and colour, to be read from the first to the last.
    pub facts: Vec<Fact>,
    /// What would remove it.
    pub removal: Removal,
}

/// The part of a scene that a picture shows at a spot.
#[derive(Debug, Clone, PartialEq)]
pub struct PointedPart {
    /// Name of its object.
    pub object: String,
    /// Name of its material; empty where it has none.
    pub material: String,
    /// Where the spot lies on it, in the world of the pose that is drawn.
    pub world: [f32; 3],
    /// Where that is in the first pose, in which `line.guides` are given.
    pub at_rest: [f32; 3],
}

/// What a picture shows at a spot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pointed {
    /// The line whose ink is nearest within reach.
    pub line: Option<LineReason>,
    /// The surface.
    pub part: Option<PointedPart>,
}

/// Keeps the strokes around a spot, step by step.
pub(super) struct Probe {
    pub spot: Spot,
    steps: RefCell<Vec<(WidthStep, Vec<Stroke>)>>,
}

/// A place on a stroke: its number, the piece, and where on that between 0 and 1.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OnStroke {
    stroke: usize,
    piece: usize,
    share: f64,
    away_px: f64,
}

impl Probe {
    pub fn new(spot: Spot) -> Self {
        Self {
            spot,
            steps: RefCell::default(),
        }
    }

    /// Keeps the strokes that pass near the spot.
    pub fn see(&self, step: WidthStep, strokes: &[Stroke]) {
        let reach = self.spot.reach_px + WATCH_PX;
        let is_near = |stroke: &&Stroke| {
            let near = nearest(stroke, &|point| apart(point.position, self.spot.place));
            near.is_some_and(|(.., away)| away <= reach)
        };
        let kept = strokes.iter().filter(is_near).cloned().collect();
        self.steps.borrow_mut().push((step, kept));
    }

    /// Width in pixels after each step, at a point of a stroke of the drawing; steps that had no such line are left
    /// out. Copies of a hand have the widths of their line.
    fn widths(&self, stroke: &Stroke, point: &StrokePoint) -> Vec<(WidthStep, f64)> {
        let there = DVec3::from(point.world.map(f64::from));
        let away = |other: &StrokePoint| DVec3::from(other.world.map(f64::from)) - there;
        let width_in = |strokes: &Vec<Stroke>| {
            let same = strokes.iter().filter(|other| {
                (other.kind, other.surface, other.occluders)
                    == (stroke.kind, stroke.surface, stroke.occluders)
            });
            let near = same.filter_map(|other| {
                let (piece, share, away) = nearest(other, &away)?;
                Some((away, between(other, piece, share).width))
            });
            near.min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|(_, width)| width)
        };
        let steps = self.steps.borrow();
        let widths = steps
            .iter()
            .filter_map(|(step, strokes)| Some((*step, width_in(strokes)?)));
        widths.collect()
    }

    /// The line whose ink is nearest within reach; of several under the spot the one whose middle is.
    fn pick(&self, drawing: &Drawing) -> Option<OnStroke> {
        let near = drawing
            .strokes
            .iter()
            .enumerate()
            .filter_map(|(i, stroke)| {
                let (piece, share, from_middle) =
                    nearest(stroke, &|point| apart(point.position, self.spot.place))?;
                let width = between(stroke, piece, share).width;
                let away_px = (from_middle - 0.5 * width).max(0.0);
                let on_stroke = OnStroke {
                    stroke: i,
                    piece,
                    share,
                    away_px,
                };
                let is_meant = away_px <= self.spot.reach_px && width > THINNEST_PX;
                is_meant.then_some((on_stroke, from_middle))
            });
        let order = |(a, from_a): &(OnStroke, f64), (b, from_b): &(OnStroke, f64)| {
            a.away_px
                .total_cmp(&b.away_px)
                .then(from_a.total_cmp(from_b))
        };
        near.min_by(order).map(|(on_stroke, _)| on_stroke)
    }
}

/// The way from one place of the picture to another, as a vector.
fn apart(from: [f64; 2], to: [f64; 2]) -> DVec3 {
    DVec3::new(from[0] - to[0], from[1] - to[1], 0.0)
}

/// Where a stroke comes nearest to something that `away` gives the way to from each point: the piece, where on it
/// between 0 and 1, and how far away.
fn nearest(stroke: &Stroke, away: &dyn Fn(&StrokePoint) -> DVec3) -> Option<(usize, f64, f64)> {
    let points = &stroke.points;
    let count = points.len() - usize::from(!stroke.closed && !points.is_empty());
    let pieces = (0..count).map(|piece| {
        let [from, to] = [piece, (piece + 1) % points.len()].map(|i| away(&points[i]));
        let along = to - from;
        let share = -from.dot(along) / along.length_squared().max(1e-30);
        let share = share.clamp(0.0, 1.0);
        (piece, share, from.lerp(to, share).length())
    });
    pieces.min_by(|a, b| a.2.total_cmp(&b.2))
}

/// The point of a stroke between the ends of a piece; what is no number is that of the nearer end.
fn between(stroke: &Stroke, piece: usize, share: f64) -> StrokePoint {
    let points = &stroke.points;
    let [from, to] = [piece, (piece + 1) % points.len()].map(|i| &points[i]);
    let mix = |a: f64, b: f64| a + (b - a) * share;
    let nearer = if share < 0.5 { from } else { to };
    StrokePoint {
        position: [0, 1].map(|i| mix(from.position[i], to.position[i])),
        depth: mix(from.depth, to.depth),
        width: mix(from.width, to.width),
        u: mix(from.u, to.u),
        world: [0, 1, 2].map(|i| mix(from.world[i].into(), to.world[i].into()) as f32),
        location: from.location,
        color: nearer.color,
    }
}

impl LineModel {
    /// What a drawing of the model shows at the spot of a probe that watched it.
    pub(super) fn pointed(
        &self,
        (camera, style, options): (&Camera, &Style, &LineOptions),
        drawing: &Drawing,
        probe: &Probe,
    ) -> Result<Pointed, RenderError> {
        let projector = Projector::new(camera, options.size, self.bounds);
        let part = self.part_at(&projector, options, probe.spot.place)?;
        let Some(found) = probe.pick(drawing) else {
            return Ok(Pointed { line: None, part });
        };

        // Gather what is known of the line.
        let stroke = &drawing.strokes[found.stroke];
        let point = between(stroke, found.piece, found.share);
        let surface = drawing.surfaces.get(stroke.surface as usize);
        let world = point.world;
        let of_line = PointedPart {
            object: surface.map_or_else(String::new, |surface| surface.object.clone()),
            material: surface.map_or_else(String::new, |surface| surface.material.clone()),
            world,
            at_rest: world,
        };
        let plain = surface.map_or([0, 0, 0, 255], |surface| surface.line_color);
        let facts = Facts {
            model: self,
            projector: &projector,
            style,
            options,
            stroke,
            point: &point,
            color: point.color.unwrap_or(plain),
            widths: probe.widths(stroke, &point),
        };
        let line = LineReason {
            kind: stroke.kind,
            occluders: stroke.occluders,
            points: stroke.points.iter().map(|point| point.position).collect(),
            closed: stroke.closed,
            width_px: point.width,
            color: facts.color,
            away_px: found.away_px,
            facts: facts.all(&of_line)?,
            removal: match stroke.kind {
                Kind::Marked => Removal::Part,
                kind => Removal::Kind(kind),
            },
            part: of_line,
        };
        Ok(Pointed {
            line: Some(line),
            part,
        })
    }

    /// The surface that shows at a place of the picture.
    fn part_at(
        &self,
        projector: &Projector,
        options: &LineOptions,
        place: [f64; 2],
    ) -> Result<Option<PointedPart>, RenderError> {
        let prepared = self.prepared(options)?;
        let Some((face, depth)) = prepared.tree.face_at(&self.shape, projector, place) else {
            return Ok(None);
        };

        // Find the same place of the face in the first pose.
        let world = projector.unproject(place, depth);
        let location = SurfaceLocation { edge: NONE, face };
        let (corners, shares) = location.place(&self.shape, world);
        let first = self.first_positions.as_ref();
        let first = first.unwrap_or(&self.shape.positions);
        let at_rest = corners
            .iter()
            .zip(shares)
            .map(|(corner, share)| share * DVec3::from(first[*corner as usize].map(f64::from)));
        let at_rest: DVec3 = at_rest.sum();
        let info = &self.parts[self.shape.face_surfaces[face as usize] as usize];
        Ok(Some(PointedPart {
            object: info.object_name.clone(),
            material: info.material_name.clone(),
            world: world.as_vec3().to_array(),
            at_rest: at_rest.as_vec3().to_array(),
        }))
    }
}
