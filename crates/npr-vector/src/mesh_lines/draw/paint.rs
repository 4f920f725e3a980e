//! Turns runs into strokes, with colours and widths along them.

use super::even_paint::{even_out, limit_slopes};
use crate::mesh_lines::merge::continued_ends;
use crate::mesh_lines::run::{Run, RunPoint, distance};
use crate::mesh_lines::smooth::between;
use crate::project::Lens;
use crate::stroke::{Kind, Stroke, StrokePoint};
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// How a point of a stroke is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointPaint {
    /// Colour, sRGB bytes and alpha; `None` for the colour of the surface.
    pub color: Option<[u8; 4]>,
    /// Factor on the width.
    pub width: f64,
}

/// Gives the paint at a point of a stroke, by its kind and surface.
pub type PaintAt<'a> = &'a (dyn Fn(Kind, u32, &RunPoint) -> PointPaint + Sync);

/// Widths and colours along strokes.
#[derive(Clone, Copy)]
pub struct StrokeLook<'a> {
    /// Whole line width in pixels at a vertex of the shape.
    pub width_at: &'a (dyn Fn(u32) -> f32 + Sync),
    /// Colours and factors on widths, where they change from place to place. Long pieces get more points then.
    pub paint_at: Option<PaintAt<'a>>,
    /// Whether that hangs on normals, which jump from face to face, so that paint is evened out along strokes.
    pub is_lit: bool,
    /// Whether widths follow how the surface bends, so that they are kept from jumping along strokes.
    pub follows_bends: bool,
}

impl StrokeLook<'_> {
    /// Colour and whole width in pixels at a point of a run.
    pub(crate) fn paint(&self, shape: &HalfEdgeMesh, run: &Run, point: &RunPoint) -> PointPaint {
        let (vertices, shares) = point.location.place(shape, point.world);
        let width: f64 = (0..3)
            .filter(|i| shares[*i] > 0.0)
            .map(|i| f64::from((self.width_at)(vertices[i])) * shares[i])
            .sum();
        let width = width * run.weight;
        let paint = self
            .paint_at
            .map_or(PLAIN, |paint_at| paint_at(run.kind, run.surface, point));
        PointPaint {
            width: width * paint.width,
            ..paint
        }
    }
}

/// Pieces longer than this, in pixels, are broken up where colours change from place to place.
const PAINT_STEP_PX: f64 = 6.0;
/// The paint that changes nothing.
const PLAIN: PointPaint = PointPaint {
    color: None,
    width: 1.0,
};

/// Runs with no piece longer than `step_px`.
pub(super) fn broken_up(runs: Vec<Run>, step_px: f64, lens: Lens) -> Vec<Run> {
    let broken = |run: Run| {
        let back = run.points.first().copied().filter(|_| run.closed);
        let next = run.points.iter().skip(1).copied().chain(back);
        let mut points = Vec::with_capacity(run.points.len());
        for (from, to) in run.points.iter().zip(next) {
            points.push(*from);
            let count = (distance(from.place, to.place) / step_px).ceil();
            let steps = 1..count.clamp(1.0, 1e4) as u32;
            points.extend(steps.map(|i| between(from, &to, f64::from(i) / count, lens)));
        }
        if !run.closed {
            points.extend(run.points.last());
        }
        Run { points, ..run }
    };
    runs.into_par_iter().with_min_len(16).map(broken).collect()
}

/// Runs as strokes, painted; where colours change from place to place in more points.
pub(super) fn painted(
    mut runs: Vec<Run>,
    shape: &HalfEdgeMesh,
    look: &StrokeLook<'_>,
    lens: Lens,
) -> Vec<Stroke> {
    if look.paint_at.is_some() {
        runs = broken_up(runs, PAINT_STEP_PX, lens);
    }
    let is_of_card: Vec<bool> = runs.iter().map(|run| is_of_card(shape, run)).collect();
    let mates = look.follows_bends.then(|| continued_ends(&runs));
    let mut strokes = strokes_of(runs, &|run: &Run, point: &RunPoint| {
        look.paint(shape, run, point)
    });
    if let Some(mates) = &mates {
        limit_slopes(&mut strokes, mates, |index| !is_of_card[index]);
    }
    let mut is_of_card = is_of_card.into_iter();
    strokes.retain(|stroke| !(is_of_card.next() == Some(true) && is_blot(stroke)));
    if look.is_lit {
        strokes.par_iter_mut().for_each(even_out);
    }
    strokes
}

/// Whether a run is part of a card's line.
fn is_of_card(shape: &HalfEdgeMesh, run: &Run) -> bool {
    let polyline = run
        .points
        .first()
        .and_then(|point| shape.polyline_of(point.edge));
    polyline.is_some_and(|polyline| shape.cards.polylines().contains(&polyline))
}

/// Whether a stroke is wider than long: of a blade so little shows that it is no line.
fn is_blot(stroke: &Stroke) -> bool {
    let widest = stroke
        .points
        .iter()
        .map(|point| point.width)
        .fold(0.0, f64::max);
    stroke.length() < widest
}

/// Runs as strokes, in their order; `paint_at` gives colour and whole width in pixels at a point of a run.
pub(crate) fn strokes_of(
    runs: Vec<Run>,
    paint_at: &(dyn Fn(&Run, &RunPoint) -> PointPaint + Sync),
) -> Vec<Stroke> {
    let runs = runs.into_par_iter().with_min_len(16);
    runs.map(|run| stroke_of(&run, paint_at)).collect()
}

fn stroke_of(run: &Run, paint_at: &(dyn Fn(&Run, &RunPoint) -> PointPaint + Sync)) -> Stroke {
    // Measure the length in the picture, and paint point by point.
    let mut u = run.part.map_or(0.0, |part| part.ends_px[0]);
    let mut last = run.points.first().map(|point| point.place);
    let points = run.points.iter().enumerate().map(|(index, point)| {
        u += last.map_or(0.0, |last| distance(last, point.place));
        last = Some(point.place);
        let location = run.location_at(index);
        let paint = paint_at(run, &RunPoint { location, ..*point });
        StrokePoint {
            position: point.place,
            depth: point.depth,
            width: paint.width,
            u,
            world: point.world.as_vec3().to_array(),
            location,
            color: paint.color,
        }
    });

    // Take over what the run is.
    Stroke {
        id: run.id,
        kind: run.kind,
        occluders: run.occluders,
        surface: run.surface,
        closed: run.closed,
        part: run.part,
        points: points.collect(),
    }
}
