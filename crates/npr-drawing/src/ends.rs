//! Ends and other places of strokes, and where lines meet them.

use crate::fit::distance2_to_segment;
use foldhash::fast::FixedState;
use kurbo::Point;
use npr_vector::mesh_lines::run::distance;
use npr_vector::stroke::{Stroke, StrokePoint};
use rayon::prelude::*;
use std::collections::HashMap;

/// Least distance, in pixels, at which an end meets a line, however thin this is.
const TOUCH_PX: f64 = 1.0;

/// Greatest distance, in pixels, at which an end meets a line, however wide this is.
const FARTHEST_TOUCH_PX: f64 = 64.0;

/// Distance, in pixels, from the border of the picture within which an end is cut off by it.
const BORDER_PX: f64 = 1.0;

/// A place of a stroke.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    /// The stroke.
    pub stroke: u32,
    /// Number of the place on it; of ends 0 for its start, 1 for its end.
    pub number: u32,
    /// Pixels along the stroke from its start.
    pub way: f64,
    /// Where it lies in the picture.
    pub position: [f64; 2],
}

/// A place where a visible line meets one of a stroke.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Meeting {
    /// The stroke whose place it is.
    pub stroke: usize,
    /// Number of that place; of ends 0 for its start, 1 for its end.
    pub place: usize,
    /// The stroke that meets it; its own where this comes back.
    pub with: usize,
    /// Pixels along that stroke from its start.
    pub way: f64,
    /// Their distance, in pixels.
    pub distance: f64,
}

/// All meetings of ends with visible lines, in an order that does not depend on the number of threads; `lengths` are
/// those of the strokes.
///
/// A line meets ends within half its width, `reach` times. A stroke's own far side counts as another line. One line may
/// meet an end in more than one of its pieces.
pub(crate) fn meetings<'a>(
    strokes: &'a [Stroke],
    lengths: &'a [f64],
    reach: f64,
) -> impl ParallelIterator<Item = Meeting> + 'a {
    meetings_at(ends_of(strokes, lengths), strokes, (reach, 0.0))
}

/// The same of any places of open strokes in place of ends; a line meets those, too, that lie within `least_px`.
pub(crate) fn meetings_at<'a>(
    places: impl Iterator<Item = Place>,
    strokes: &'a [Stroke],
    (reach, least_px): (f64, f64),
) -> impl ParallelIterator<Item = Meeting> + 'a {
    let places = Cells::new(CELL_PX, places.map(|place| (place.position, place)));
    let visible = strokes.par_iter().enumerate();
    let visible = visible.filter(|(_, stroke)| stroke.is_visible());
    visible.flat_map_iter(move |(number, stroke)| {
        let mut along = 0.0;
        let mut found = Vec::new();
        for (a, b) in pieces(stroke) {
            let next = along + distance(a.position, b.position);
            let touch = (reach * touch_of(a.width.max(b.width))).max(least_px);
            places.near(a.position, b.position, touch, |place| {
                let is_own = place.stroke as usize == number
                    && !stroke.closed
                    && place.arc_from(along, next) < 4.0 * touch;
                let corners = [place.position, a.position, b.position];
                let [at, a, b] = corners.map(|[x, y]| Point::new(x, y));
                let distance2 = distance2_to_segment(at, a, b);
                if !is_own && distance2 <= touch * touch {
                    let piece = b - a;
                    let share = (at - a).dot(piece) / piece.hypot2().max(f64::MIN_POSITIVE);
                    found.push(Meeting {
                        stroke: place.stroke as usize,
                        place: place.number as usize,
                        with: number,
                        way: along + (next - along) * share.clamp(0.0, 1.0),
                        distance: distance2.sqrt(),
                    });
                }
            });
            along = next;
        }
        found
    })
}

/// Whether the border of a picture of `size` pixels cuts a line off at a place.
pub(crate) fn is_cut_off(position: [f64; 2], size: [u32; 2]) -> bool {
    let is_at_side =
        |i: usize| position[i] <= BORDER_PX || position[i] >= f64::from(size[i]) - BORDER_PX;
    is_at_side(0) || is_at_side(1)
}

/// How far from its middle a line meets ends, in pixels.
fn touch_of(width: f64) -> f64 {
    (0.5 * width).clamp(TOUCH_PX, FARTHEST_TOUCH_PX)
}

/// The straight pieces of a stroke.
fn pieces(stroke: &Stroke) -> impl Iterator<Item = (&StrokePoint, &StrokePoint)> {
    let points = &stroke.points;
    let closing =
        (stroke.closed && points.len() > 1).then(|| (&points[points.len() - 1], &points[0]));
    let open = points.windows(2).map(|pair| (&pair[0], &pair[1]));
    open.chain(closing)
}

impl Place {
    /// The way along its own stroke to a piece of it.
    fn arc_from(&self, from: f64, to: f64) -> f64 {
        (from - self.way).max(self.way - to)
    }
}

/// The ends of visible open strokes.
fn ends_of<'a>(strokes: &'a [Stroke], lengths: &'a [f64]) -> impl Iterator<Item = Place> + 'a {
    let all = (0..).zip(strokes).zip(lengths);
    let open = all.filter(|((_, stroke), _)| !stroke.closed && stroke.is_visible());
    open.flat_map(|((number, stroke), length)| {
        let ends = [
            (stroke.points.first(), 0.0),
            (stroke.points.last(), *length),
        ];
        (0..).zip(ends).filter_map(move |(side, (point, way))| {
            Some(Place {
                stroke: number,
                number: side,
                way,
                position: point?.position,
            })
        })
    })
}

/// Width of a cell, in pixels.
const CELL_PX: f64 = 16.0;

/// Things that lie at places, by square cells of the picture.
pub(crate) struct Cells<T> {
    side: f64,
    cells: HashMap<[i32; 2], Vec<T>, FixedState>,
}

impl<T> Cells<T> {
    /// Things with their places, in cells `side` pixels wide.
    pub fn new(side: f64, things: impl Iterator<Item = ([f64; 2], T)>) -> Self {
        let mut cells: HashMap<[i32; 2], Vec<T>, FixedState> = HashMap::default();
        for (position, thing) in things {
            let cell = cell_of(position, side);
            cells.entry(cell).or_default().push(thing);
        }
        Self { side, cells }
    }

    /// Calls `visit` with all things within `reach` of a straight piece, and with some around; none of pieces that are
    /// not finite.
    pub fn near(&self, a: [f64; 2], b: [f64; 2], reach: f64, mut visit: impl FnMut(&T)) {
        // Walk along the piece, a cell's width a step.
        let length = distance(a, b);
        if length.is_nan() || length > LONGEST_PX {
            return;
        }
        let steps = (length / self.side).ceil().max(1.0) as usize;
        let at = |step: usize| {
            let share = step as f64 / steps as f64;
            [0, 1].map(|i| a[i] + (b[i] - a[i]) * share)
        };
        for step in 0..steps {
            // Visit the cells that it comes near in this step.
            let (from, to) = (at(step), at(step + 1));
            let low = cell_of([0, 1].map(|i| from[i].min(to[i]) - reach), self.side);
            let high = cell_of([0, 1].map(|i| from[i].max(to[i]) + reach), self.side);
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    let there = self.cells.get(&[x, y]);
                    there.into_iter().flatten().for_each(&mut visit);
                }
            }
        }
    }
}

/// Longest piece of a line, in pixels, that is looked at.
const LONGEST_PX: f64 = 1e6;

fn cell_of(position: [f64; 2], side: f64) -> [i32; 2] {
    position.map(|v| (v / side).floor() as i32)
}
