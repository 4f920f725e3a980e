//! How much of its ink a stamp takes where others lie over it.
//!
//! In frames, of stamps that overlap the one with most ink shows. In files they lie over each other, and n of one share
//! of ink a leave 1 - (1 - a)^n. With 1 - (1 - a)^w in place of a they leave as much as frames where w = 1 / n; for
//! stamps that fall off, turn and scatter, straight rows of them tell which w leaves as much ink in all.

use super::bake::{FULL, level, mean_ink};
use super::{Form, Key, Steps, StrokeBrushes};
use crate::ink::Images;
use crate::stamps::Stamps;
use npr_core::math::{cos_f64, exp, ln, sin_f64};
use npr_vector::ink_point::InkPoint;
use npr_vector::stroke::StrokePoint;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Places that a row is looked at.
const PLACES: u32 = 1024;

/// Directions, in radians, of the rows of stamps that do not turn with the stroke; others have the first alone.
const DIRECTIONS: [f64; 4] = [0.0, 0.25 * PI, 0.5 * PI, 0.75 * PI];

/// Distances between stamps that those places lie along.
const PERIODS: f64 = 48.0;

/// Halvings that find a share.
const ROUNDS: u32 = 24;

/// What decides how stamps overlap: surface, pressure, half width.
type Row = (u32, u32, i32);

/// The shares of ink that stamps take.
pub(super) struct Overlaps(BTreeMap<Row, f32>);

fn row_of(key: &Key) -> Row {
    (key.surface, key.pressure, key.half)
}

impl Overlaps {
    /// Those of all stamps among some keys, in parallel.
    pub fn of(keys: &[Key], brushes: &StrokeBrushes, steps: &Steps) -> Self {
        let rows = keys.iter().filter(|key| key.form == Form::Stamp);
        let rows: BTreeMap<Row, &Key> = rows.map(|key| (row_of(key), key)).collect();
        let rows: Vec<(Row, &Key)> = rows.into_iter().collect();
        let shares = rows.par_iter().map(|(row, key)| {
            let lay = brushes.lays[key.surface as usize];
            let share = match lay.images {
                Images::Stamps(stamps) => share_in_row(key, &stamps, brushes, steps),
                Images::Once | Images::ByLength(_) => 1.0,
            };
            (*row, share)
        });
        Self(shares.collect::<Vec<_>>().into_iter().collect())
    }

    /// The share of a stamp.
    pub fn share(&self, key: &Key) -> f32 {
        self.0.get(&row_of(key)).copied().unwrap_or(1.0)
    }
}

/// The share with which straight rows of stamps laid over each other have as much ink as in frames.
fn share_in_row(key: &Key, stamps: &Stamps, brushes: &StrokeBrushes, steps: &Steps) -> f32 {
    // Look at rows: what frames show, and what is left bare under all stamps together.
    let like = level(key, brushes, steps, [0.0; 2])[0];
    let directions = if stamps.rakes { 1 } else { DIRECTIONS.len() };
    let rows = DIRECTIONS[..directions].iter();
    let seen: Vec<[f32; 2]> = rows
        .flat_map(|direction| seen_in_row(*direction, &like, stamps, brushes))
        .collect();

    // Find the share by halves.
    let wanted: f32 = seen.iter().map(|[most, _]| most).sum();
    let left = |share: f32| -> f32 {
        let ink = seen.iter().map(|[_, bare]| match *bare {
            0.0 => 0.0,
            bare => 1.0 - exp(share * bare),
        });
        ink.sum()
    };
    let (mut low, mut high) = (0.0_f32, 2.0_f32);
    for _ in 0..ROUNDS {
        let middle = 0.5 * (low + high);
        if left(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The most ink of any stamp, and the logarithm of what all of them leave bare, at places all over a straight row.
fn seen_in_row(
    direction: f64,
    like: &InkPoint,
    stamps: &Stamps,
    brushes: &StrokeBrushes,
) -> Vec<[f32; 2]> {
    // Set a row, longer than what is looked at by a stamp on either side.
    let half = f64::from(like.half_width);
    let width = 2.0 * half / stamps.size.max(1e-3);
    let spacing = stamps.spacing_over(1.0);
    let side = half * (1.0 + stamps.jitter) * stamps.length.hypot(1.0) + width * stamps.scatter;
    let (looked, before) = (PERIODS * spacing, side + spacing);
    let (sin, cos) = (sin_f64(direction), cos_f64(direction));
    let turned = |[x, y]: [f64; 2]| [x * cos - y * sin, x * sin + y * cos];
    let inked = |point: &StrokePoint| InkPoint {
        px: point.position.map(|at| at as f32),
        half_width: (0.5 * width) as f32,
        ..*like
    };
    let at = |x: f64| StrokePoint {
        position: turned([x, 0.0]),
        u: x,
        width,
        ..StrokePoint::default()
    };
    let row = stamps.along(&[at(0.0), at(looked + 2.0 * before)], false, 0, &inked);

    // Look at places all over it.
    let all = brushes.brushes();
    let place = |number: u32| {
        // The plastic number spreads places evenly over two sides.
        let [s, t] = [0.754_877_67, 0.569_840_3].map(|step| (f64::from(number) * step).fract());
        turned([before + looked * s, side * (2.0 * t - 1.0)]).map(|v| v as f32)
    };
    let seen = |px: [f32; 2]| {
        let (mut most, mut bare) = (0.0_f32, 0.0_f32);
        for ends in row.as_chunks().0.iter().filter(|ends| covers(ends, px)) {
            most = most.max(all.ink_alone(ends, px));
            let ink = mean_ink(all, ends, px);
            bare += match ink >= FULL {
                true => f32::NEG_INFINITY,
                false => ln(1.0 - ink),
            };
        }
        [most, bare]
    };
    (0..PLACES).map(|number| seen(place(number))).collect()
}

/// Whether a place lies on a stamp.
fn covers([a, b]: &[InkPoint; 2], px: [f32; 2]) -> bool {
    let along = [0, 1].map(|i| b.px[i] - a.px[i]);
    let from = [0, 1].map(|i| px[i] - 0.5 * (a.px[i] + b.px[i]));
    let length = f32::hypot(along[0], along[1]).max(1e-6);
    let ahead = (from[0] * along[0] + from[1] * along[1]) / length;
    let beside = (from[1] * along[0] - from[0] * along[1]) / length;
    ahead.abs() <= 0.5 * length && beside.abs() <= a.half_width
}
