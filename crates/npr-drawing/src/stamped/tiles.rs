//! The image of a ribbon, cut into tiles that follow the stroke.

use super::{Form, Print};
use crate::color_runs::point_between;
use crate::ink::Laid;
use npr_core::math::{atan2_f64, tan_f64};
use npr_vector::ink_point::InkPoint;
use npr_vector::mesh_lines::run::distance;
use npr_vector::stroke::StrokePoint;
use std::f64::consts::TAU;

/// Least length of a tile, in pixels.
const SHORTEST_PX: f64 = 4.0;

/// Shorter rests of tiles are left out, in pixels.
const REST_PX: f64 = 0.05;

/// Most different tiles of one image; longer images have each several times, side by side.
const PIECES_MAX: f64 = 64.0;

/// Turn of a stroke, in radians, from which no tile lies across it.
const CORNER: f64 = 0.35;

/// Half width, in pixels, under which an end is not rounded.
const ROUNDED_PX: f32 = 0.5;

/// Length of a tile of a stroke of some width, in pixels: about as long as wide, so that it hardly bends.
fn length_px(width: f64) -> f64 {
    width.max(SHORTEST_PX)
}

/// Most tiles on a length, beside one for each of its points.
pub(super) fn most_over(length: f64, width: f64) -> f64 {
    // Whole tiles make up an image; they may be half as long as wanted.
    2.0 * length / length_px(width) + 8.0
}

/// How tiles make up an image.
#[derive(Debug, Clone, Copy)]
struct Cut {
    /// Tiles of an image; where one holds several images, its share of a tile.
    count: f64,
    /// Tiles that show the same piece.
    alike: f64,
}

impl Cut {
    fn new(laid: &Laid) -> Self {
        let images_px = length_px(2.0 * laid.full) * laid.per_px;
        if images_px >= 1.0 {
            return Self {
                count: 1.0 / images_px.floor(),
                alike: 1.0,
            };
        }
        let wanted = (1.0 / images_px).ceil();
        let alike = (wanted / PIECES_MAX).ceil();
        Self {
            count: (wanted / alike).ceil() * alike,
            alike,
        }
    }

    /// What of the image lies on the tile at a place of the image.
    fn piece(&self, u: f64) -> [f64; 2] {
        let pieces = self.count / self.alike;
        let number = (u * pieces).floor().rem_euclid(pieces.max(1.0));
        [number, number + 1.0].map(|at| at / pieces)
    }
}

/// The tiles of a part of a stroke, and round ends where it is open; `inked` gives what a point has beside its place.
pub(super) fn along(
    points: &[StrokePoint],
    is_closed: bool,
    laid: &Laid,
    inked: &dyn Fn(&StrokePoint) -> InkPoint,
) -> Vec<Print> {
    // Know the way to every point.
    let back = points.first().copied().filter(|_| is_closed);
    let ends: Vec<&StrokePoint> = points.iter().chain(&back).collect();
    let mut ways = vec![0.0];
    for pair in ends.windows(2) {
        ways.push(ways[ways.len() - 1] + distance(pair[0].position, pair[1].position));
    }
    let length = ways[ways.len() - 1];
    if ends.len() < 2 || !(length.is_finite() && length > 0.0 && laid.per_px > 0.0) {
        return Vec::new();
    }

    // Cut it where tiles of the image meet, and at corners.
    let cut = Cut::new(laid);
    let start = laid.start + ends[0].u * laid.per_px;
    let start = if start.abs() < 1e6 { start } else { 0.0 };
    let u_at = |way: f64| start + way * laid.per_px;
    let step = 1.0 / (cut.count * laid.per_px);
    let begun = (start * cut.count).rem_euclid(1.0);
    let way_of = |number: u32| (f64::from(number) - begun) * step;
    let mut cuts: Vec<f64> = (1..).map(way_of).take_while(|way| *way < length).collect();
    for (i, three) in ends.windows(3).enumerate() {
        let turn = turn_between(heading(three[0], three[1]), heading(three[1], three[2]));
        if turn.abs() > CORNER {
            cuts.push(ways[i + 1]);
        }
    }
    cuts.extend([0.0, length]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|next, kept| *next - *kept < REST_PX);

    // Find where each tile begins, its middle, and where it ends.
    let mut piece = 0;
    let mut at = |way: f64| {
        while piece + 2 < ends.len() && ways[piece + 1] < way {
            piece += 1;
        }
        let span = ways[piece + 1] - ways[piece];
        let share = if span > 0.0 {
            (way - ways[piece]) / span
        } else {
            0.0
        };
        point_between(ends[piece], ends[piece + 1], share.clamp(0.0, 1.0))
    };
    let spans: Vec<Span> = cuts
        .windows(2)
        .map(|pair| {
            let [from, middle, to] = [pair[0], 0.5 * (pair[0] + pair[1]), pair[1]].map(&mut at);
            Span {
                heading: heading(&from, &to),
                places: [from.position, to.position],
                inked: inked(&middle),
                u: cut.piece(u_at(0.5 * (pair[0] + pair[1]))),
            }
        })
        .collect();

    // Let tiles overlap where the stroke bends, so that no wedge stays open, and round what is an end.
    let count = spans.len();
    let mut prints = Vec::with_capacity(count + 2);
    for (i, span) in spans.iter().enumerate() {
        let before = match i {
            0 => is_closed.then_some(count - 1),
            _ => Some(i - 1),
        };
        let behind = match i + 1 {
            next if next < count => Some(next),
            _ => is_closed.then_some(0),
        };
        let longer = [before, behind].map(|other| other.map_or(0.0, |i| span.overlap(&spans[i])));
        prints.push(span.tile(longer));
        let free = [before, behind].map(|other| other.is_none());
        prints.extend(span.caps(free));
    }
    prints
}

/// What a tile covers of a stroke.
struct Span {
    /// Direction, in radians.
    heading: f64,
    places: [[f64; 2]; 2],
    /// What the stroke has in its middle.
    inked: InkPoint,
    /// The piece of the image.
    u: [f64; 2],
}

impl Span {
    /// How far this tile has to run on to leave no wedge open beside another that it meets.
    fn overlap(&self, other: &Self) -> f64 {
        let half = f64::from(self.inked.half_width);
        let bend = turn_between(self.heading, other.heading).abs();
        half * tan_f64(0.5 * bend.min(HALF_BEND)).min(1.0)
    }

    /// The tile, longer before its start and behind its end.
    fn tile(&self, longer: [f64; 2]) -> Print {
        let [a, b] = self.places;
        let length = distance(a, b).max(1e-6);
        let forward = [0, 1].map(|i| (b[i] - a[i]) / length);
        let moved = |from: [f64; 2], by: f64| [0, 1].map(|i| (from[i] + forward[i] * by) as f32);
        self.print(Form::Tile, [moved(a, -longer[0]), moved(b, longer[1])])
    }

    /// Round ends at its start and at its end, where those are free.
    fn caps(&self, free: [bool; 2]) -> impl Iterator<Item = Print> {
        let is_wide = self.inked.half_width >= ROUNDED_PX;
        let [a, b] = self.places.map(|place| place.map(|at| at as f32));
        let half = self.inked.half_width;
        let length = distance(self.places[0], self.places[1]).max(1e-6);
        let forward = [0, 1].map(|i| ((self.places[1][i] - self.places[0][i]) / length) as f32);
        let beyond = |from: [f32; 2], way: f32| [0, 1].map(|i| from[i] + forward[i] * half * way);
        let caps = [
            (free[0] && is_wide).then(|| self.print(Form::Cap, [a, beyond(a, -1.0)])),
            (free[1] && is_wide).then(|| self.print(Form::Cap, [b, beyond(b, 1.0)])),
        ];
        caps.into_iter().flatten()
    }

    fn print(&self, form: Form, places: [[f32; 2]; 2]) -> Print {
        let end = |i: usize| InkPoint {
            px: places[i],
            u: self.u[i] as f32,
            ..self.inked
        };
        Print {
            form,
            ends: [end(0), end(1)],
        }
    }
}

/// Turn, in radians, beyond which overlaps grow no further.
const HALF_BEND: f64 = 1.5;

/// The direction from one point to another, in radians.
fn heading(a: &StrokePoint, b: &StrokePoint) -> f64 {
    let [x, y] = [0, 1].map(|i| b.position[i] - a.position[i]);
    atan2_f64(y, x)
}

/// The turn from one direction to another, -pi to pi.
fn turn_between(from: f64, to: f64) -> f64 {
    let turn = to - from;
    turn - (turn / TAU).round() * TAU
}
