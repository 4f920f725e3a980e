//! The images of stamps: what frames ink of them, texel by texel.

use super::overlap::Overlaps;
use super::{Form, Key, Print, StampImage, Steps, StrokeBrushes};
use npr_core::math::mix_bits;
use npr_vector::brush::Brushes;
use npr_vector::ink_point::InkPoint;

/// Texels a pixel.
const FINENESS: f32 = 2.0;

/// Fewest and most texels across an image, and along it.
const SIDES: [[u32; 2]; 2] = [[4, 96], [2, 256]];

/// Places of the paper that an image without a place of its own is the mean of.
const PAPERS: u32 = 12;

/// Distance between the papers of different images, in pixels.
const PAPER_STEP: [f32; 2] = [37.7, 91.3];

/// Ink from which a place counts as full.
pub(super) const FULL: f32 = 0.999;

/// Texels along and across what an image shows.
fn texels(key: &Key, steps: &Steps) -> [u32; 2] {
    let across = 2.0 * key.half_px(steps) * FINENESS;
    let widths = match key.form {
        Form::Cap => 0.5,
        Form::Stamp | Form::Tile => key.widths(),
    };
    let [rows, columns] = SIDES;
    let across = (across.ceil() as u32).clamp(rows[0], rows[1]);
    let along = (widths * across as f32).round() as u32;
    [along.clamp(columns[0], columns[1]), across]
}

/// Texels beside what an image shows, along and across: an empty rim, and before it, of tiles, what overlaps the next.
fn margins(form: Form) -> [u32; 2] {
    match form {
        Form::Tile => [2, 1],
        Form::Stamp | Form::Cap => [1, 1],
    }
}

/// The corners of a stamp's image, from the upper left one on, in pixels.
pub(super) fn corners(print: &Print, key: &Key, steps: &Steps) -> [[f64; 2]; 4] {
    // Know which way it lies.
    let [a, b] = print.ends.map(|end| end.px.map(f64::from));
    let along = [0, 1].map(|i| b[i] - a[i]);
    let length = f64::hypot(along[0], along[1]);
    let forward = match length > 0.0 {
        true => along.map(|v| v / length),
        false => [1.0, 0.0],
    };
    let mut half = f64::from(print.ends[0].half_width);
    if print.ends[0].flags & InkPoint::MIRRORED != 0 {
        half = -half;
    }
    let beside = [-forward[1] * half, forward[0] * half];

    // Take in the margins.
    let [columns, rows] = texels(key, steps).map(f64::from);
    let [before, above] = margins(key.form).map(f64::from);
    let place = |u: f64, v: f64| {
        let u = (u - before) / columns;
        let v = 2.0 * (v - above) / rows - 1.0;
        [0, 1].map(|i| a[i] + along[i] * u + beside[i] * v)
    };
    let (right, below) = (columns + 2.0 * before, rows + 2.0 * above);
    [
        place(0.0, 0.0),
        place(right, 0.0),
        place(right, below),
        place(0.0, below),
    ]
}

/// A stamp that lies level, as an image shows it: with the left end at a place of the paper.
pub(super) fn level(
    key: &Key,
    brushes: &StrokeBrushes,
    steps: &Steps,
    start: [f32; 2],
) -> [InkPoint; 2] {
    let half = key.half_px(steps);
    let lay = brushes.lays[key.surface as usize];
    let stamp = match (key.form, lay.images) {
        (Form::Cap, _) => 0,
        (Form::Stamp, crate::ink::Images::Stamps(stamps)) if stamps.is_round => {
            InkPoint::STAMP | InkPoint::ROUND
        }
        (Form::Stamp | Form::Tile, _) => InkPoint::STAMP,
    };
    let length = 2.0 * half * key.widths();
    let [from, share] = key.place.map(|v| v as f32 / super::PLACES);
    let end = |way: f32| InkPoint {
        px: [start[0] + length * way, start[1]],
        half_width: half,
        nearness: 0.0,
        color: 0,
        flags: lay.brush << InkPoint::BRUSH_SHIFT | stamp,
        u: from + share * way,
        pressure: key.pressure(steps),
    };
    [end(0.0), end(1.0)]
}

/// Share of ink at a place of a stamp that lies level from a start, on the mean of several papers.
pub(super) fn mean_ink(brushes: Brushes<'_>, ends: &[InkPoint; 2], px: [f32; 2]) -> f32 {
    let brush = (ends[0].flags >> InkPoint::BRUSH_SHIFT) as usize;
    let has_grain = brushes
        .all
        .get(brush)
        .is_some_and(|brush| brush.grain > 0.0);
    let papers = if has_grain { PAPERS } else { 1 };
    let on = |paper: u32| {
        let by = PAPER_STEP.map(|step| step * paper as f32);
        let moved = |[x, y]: [f32; 2]| [x + by[0], y + by[1]];
        let ends = ends.map(|end| InkPoint {
            px: moved(end.px),
            ..end
        });
        brushes.ink_alone(&ends, moved(px))
    };
    (0..papers).map(on).sum::<f32>() / papers as f32
}

/// The image that a key stands for.
pub(super) fn image(
    key: &Key,
    brushes: &StrokeBrushes,
    overlaps: &Overlaps,
    steps: &Steps,
) -> StampImage {
    // Lay the stamp on paper of its own, tiles one behind the other.
    let all = brushes.brushes();
    let half = key.half_px(steps);
    let length = match key.form {
        Form::Cap => half,
        Form::Stamp | Form::Tile => 2.0 * half * key.widths(),
    };
    let number = key.place[0] as f32 / key.place[1].max(1) as f32;
    let start = [length * number, PAPER_STEP[1] * key.surface as f32];
    let ends = level(key, brushes, steps, start);

    // Ink every texel as frames would.
    let inside = texels(key, steps);
    let margin = margins(key.form);
    let size = [0, 1].map(|i| inside[i] + 2 * margin[i]);
    let ink = |x: u32, y: u32| {
        let along = (x as f32 + 0.5 - margin[0] as f32) / inside[0] as f32;
        let across = (y as f32 + 0.5 - margin[1] as f32) / inside[1] as f32 * 2.0 - 1.0;
        let is_rim = x == 0 || y == 0 || x + 1 == size[0] || y + 1 == size[1];
        if is_rim {
            return 0.0;
        }
        match key.form {
            Form::Stamp => {
                let px = [start[0] + length * along, start[1] + half * across];
                taken(mean_ink(all, &ends, px), overlaps.share(key))
            }
            Form::Tile => {
                // A stamp ends at its sides; what overlaps the next tile shows its own last texels.
                let px = [
                    start[0] + length * along.clamp(0.001, 0.999),
                    start[1] + half * across,
                ];
                let ramp = [x, size[0] - 1 - x].map(|from_end| match from_end {
                    1 => 0.25,
                    2 => 0.75,
                    _ => 1.0,
                });
                taken(all.ink_alone(&ends, px), ramp[0] * ramp[1])
            }
            Form::Cap => {
                let far = half * (along * along + across * across).sqrt();
                let covered = (half - far) * FINENESS + 0.5;
                let px = [ends[1].px[0] + length * along, start[1] + half * across];
                all.ink_alone(&ends, px) * covered.clamp(0.0, 1.0)
            }
        }
    };
    let texel = |number: u32| {
        let (x, y) = (number % size[0], number / size[0]);
        let chance = mix_bits(number ^ mix_bits(key.place[0] as u32 ^ key.half as u32));
        byte(ink(x, y), chance)
    };
    StampImage {
        size,
        color: key.color,
        alpha: (0..size[0] * size[1]).map(texel).collect(),
    }
}

/// The ink that a stamp takes of a place, so that several over each other, whose shares make 1, leave as much.
pub(super) fn taken(ink: f32, share: f32) -> f32 {
    match ink {
        ink if ink >= FULL => 1.0,
        ink if share == 1.0 => ink,
        ink => 1.0 - npr_core::math::powf(1.0 - ink, share),
    }
}

/// A share as a byte, rounded up or down by chance so that the mean of many is theirs.
fn byte(share: f32, chance: u32) -> u8 {
    let value = share.clamp(0.0, 1.0) * 255.0;
    (value + chance as f32 / 4_294_967_296.0).min(255.0) as u8
}
