//! Tips of brushes: how they take to paper, and their images by formulas.

use super::image::{BrushImage, Texel};
use npr_core::math::{mix, smoothstep};
use npr_core::random::{hash, unit};
use rayon::prelude::*;

/// What strokes are drawn with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema)
)]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "serde", schemars(rename = "BrushTip"))]
pub enum Tip {
    /// A pen: one even ink.
    #[default]
    Pen,
    /// A comic nib: even ink with slightly scratched edges.
    GPen,
    /// A brush full of ink, whose hairs part where it is lifted.
    Brush,
    /// A brush with little ink: streaks of paper show all along.
    DryBrush,
    /// A felt pen: thin ink, stronger at its edges.
    Marker,
    /// A pencil on the grain of paper.
    Pencil,
    /// Charcoal: dark, broad and crumbling.
    Charcoal,
    /// Chalk: bright grains on a rough board.
    Chalk,
    /// An airbrush: no edge at all.
    Airbrush,
    /// Some fine lines beside each other, as of a quick hand.
    Sketch,
}

/// How a tip takes to paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Manner {
    /// How deep its nap is, as a share of full pressure.
    pub dry: f32,
    /// How deep the grain of the paper is for it, as a share of full pressure.
    pub grain: f32,
    /// Pressure, as a share of the full one, over which ink grows from none to all.
    pub soft: f32,
}

impl Tip {
    /// All tips.
    pub const ALL: [Self; 10] = [
        Self::Pen,
        Self::GPen,
        Self::Brush,
        Self::DryBrush,
        Self::Marker,
        Self::Pencil,
        Self::Charcoal,
        Self::Chalk,
        Self::Airbrush,
        Self::Sketch,
    ];

    /// How it takes to paper.
    pub fn manner(self) -> Manner {
        let [dry, grain, soft] = match self {
            Self::Pen | Self::Marker => [0.0, 0.0, 0.1],
            Self::GPen => [0.0, 0.15, 0.1],
            Self::Brush => [1.0, 0.1, 0.12],
            Self::DryBrush => [1.35, 0.3, 0.15],
            Self::Pencil => [0.4, 0.75, 0.8],
            Self::Charcoal => [0.8, 0.6, 0.45],
            Self::Chalk => [0.5, 1.0, 0.2],
            Self::Airbrush => [0.0, 0.0, 1.0],
            Self::Sketch => [0.2, 0.5, 0.6],
        };
        Manner { dry, grain, soft }
    }

    /// Its image; `None` for a pen, whose ink is even. The same one every time.
    pub fn image(self) -> Option<BrushImage> {
        image(self)
    }
}

/// Texels along and across.
const SIZE: [u32; 2] = [1024, 64];

/// How many widths an image is long.
const LENGTH: u32 = SIZE[0] / SIZE[1];

/// A place of an image: 0..1 along it, and -1 at its left edge to 1 at its right.
#[derive(Clone, Copy)]
struct Place {
    along: f32,
    across: f32,
}

/// A share at every place of an image.
type Shares = fn(Place) -> f32;

/// The image of a tip.
fn image(tip: Tip) -> Option<BrushImage> {
    let (nap, ink): (Shares, Shares) = match tip {
        Tip::Pen => return None,
        Tip::GPen => (even, |place| edge(place, 1, 6 * LENGTH, 0.07)),
        Tip::Brush => (hairs, |place| edge(place, 2, 2 * LENGTH, 0.1)),
        Tip::DryBrush => (dry_hairs, |place| edge(place, 3, 3 * LENGTH, 0.16)),
        Tip::Marker => (even, felt),
        Tip::Pencil => (lead, rounded),
        Tip::Charcoal => (crumbs, |place| edge(place, 6, 10 * LENGTH, 0.3)),
        Tip::Chalk => (grains, |place| edge(place, 7, 14 * LENGTH, 0.2)),
        Tip::Airbrush => (even, cloud),
        Tip::Sketch => (lead, strands),
    };

    // Make heights ranks, so that the share of ink at a pressure is known.
    let place = |x: u32, y: u32| Place {
        along: (x as f32 + 0.5) / SIZE[0] as f32,
        across: (y as f32 + 0.5) / SIZE[1] as f32 * 2.0 - 1.0,
    };
    let heights: Vec<f32> = (0..SIZE[0] * SIZE[1])
        .into_par_iter()
        .map(|i| nap(place(i % SIZE[0], i / SIZE[0])))
        .collect();
    let ranks = ranks(&heights);
    Some(BrushImage::of(SIZE, |x, y| -> Texel {
        let share = ink(place(x, y)).clamp(0.0, 1.0);
        [
            ranks[(y * SIZE[0] + x) as usize],
            (share * 255.0 + 0.5) as u8,
        ]
    }))
}

/// The rank of every number among all, 0..255; equal ones share the highest.
fn ranks(numbers: &[f32]) -> Vec<u8> {
    let mut sorted = numbers.to_vec();
    sorted.par_sort_by(f32::total_cmp);
    let rank = |number: &f32| {
        let below = sorted.partition_point(|other| other <= number);
        (below * 255 / sorted.len()) as u8
    };
    numbers.iter().map(rank).collect()
}

/// Smooth noise of 0..1 with `cells` along the image, which closes, and across it.
fn noise(place: Place, stream: u32, [along, across]: [u32; 2]) -> f32 {
    let x = place.along * along as f32;
    let y = (place.across * 0.5 + 0.5) * across as f32;
    let (column, row) = (x.floor(), y.floor());
    let [s, t] = [x - column, y - row].map(|v| smoothstep(0.0, 1.0, v));
    let at = |dx: u32, dy: u32| {
        let cell = (column as u32 + dx) % along;
        unit(hash(stream, cell, row as u32 + dy))
    };
    let top = mix(at(0, 0), at(1, 0), s);
    let bottom = mix(at(0, 1), at(1, 1), s);
    mix(top, bottom, t)
}

/// Noise of round spots, `cells` of them across, with finer ones in it.
fn spots(place: Place, stream: u32, cells: u32) -> f32 {
    let octave = |i: u32| {
        let across = cells << i;
        noise(place, stream + i, [across * LENGTH, across])
    };
    octave(0) * 0.6 + octave(1) * 0.4
}

/// A nap that is high everywhere.
fn even(_: Place) -> f32 {
    1.0
}

/// Full ink up to edges that waver by `depth` of half the width, in `cells` waves.
fn edge(place: Place, stream: u32, cells: u32, depth: f32) -> f32 {
    let side = u32::from(place.across > 0.0);
    let wave = |i: u32| {
        let line = Place {
            across: -1.0,
            ..place
        };
        noise(line, 10 * stream + 2 * i + side, [cells << (2 * i), 1])
    };
    let reach = 1.0 - depth * (wave(0) * 0.65 + wave(1) * 0.35);
    1.0 - smoothstep(reach - 0.06, reach, place.across.abs())
}

/// Long streaks of hairs.
fn hairs(place: Place) -> f32 {
    let fine = noise(place, 200, [LENGTH / 4, 40]);
    let coarse = noise(place, 201, [LENGTH / 8, 12]);
    let broken = noise(place, 202, [3 * LENGTH, 24]);
    fine * 0.5 + coarse * 0.35 + broken * 0.15 - 0.25 * place.across.abs()
}

/// Streaks that dry out here and there.
fn dry_hairs(place: Place) -> f32 {
    let fine = noise(place, 300, [LENGTH / 2, 44]);
    let coarse = noise(place, 301, [LENGTH / 4, 11]);
    let patch = noise(place, 302, [LENGTH / 2, 3]);
    let broken = noise(place, 303, [8 * LENGTH, 44]);
    fine * 0.45 + coarse * 0.25 + patch * 0.15 + broken * 0.15 - 0.2 * place.across.abs()
}

/// Thin ink of a felt tip, which gathers at the edges.
fn felt(place: Place) -> f32 {
    let rim = smoothstep(0.72, 0.95, place.across.abs());
    let flow = noise(place, 400, [LENGTH / 2, 6]);
    (0.74 + 0.08 * flow + 0.16 * rim) * edge(place, 4, 2 * LENGTH, 0.04)
}

/// The fine grain of a pencil's lead.
fn lead(place: Place) -> f32 {
    spots(place, 500, 20) - 0.12 * place.across * place.across
}

/// Ink that thins out towards both edges.
fn rounded(place: Place) -> f32 {
    0.92 - 0.75 * smoothstep(0.3, 1.0, place.across.abs())
}

/// Crumbs of charcoal.
fn crumbs(place: Place) -> f32 {
    let across = place.across.abs();
    spots(place, 600, 7) * 0.7 + noise(place, 604, [2 * LENGTH, 3]) * 0.3 - 0.3 * across * across
}

/// Grains of chalk.
fn grains(place: Place) -> f32 {
    spots(place, 700, 16) - 0.15 * place.across * place.across
}

/// A soft cloud of colour.
fn cloud(place: Place) -> f32 {
    let fall = 1.0 - place.across * place.across;
    fall * fall * fall
}

/// A few fine lines that wander beside each other.
fn strands(place: Place) -> f32 {
    const STRANDS: u32 = 4;
    let strand = |i: u32| {
        let line = Place {
            across: -1.0,
            ..place
        };
        let slow = noise(line, 900 + i, [LENGTH / 2, 1]) - 0.5;
        let press = noise(line, 920 + i, [LENGTH, 1]);
        let middle = (i as f32 + 0.5) / STRANDS as f32 * 1.7 - 0.85 + slow * 0.9;
        let half = 0.1 + 0.12 * press;
        let off = (place.across - middle.clamp(-0.85, 0.85)).abs();
        (1.0 - smoothstep(half * 0.4, half, off)) * (0.65 + 0.35 * press)
    };
    (0..STRANDS).map(strand).fold(0.0, f32::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn images() -> impl Iterator<Item = (Tip, BrushImage)> {
        Tip::ALL
            .into_iter()
            .filter_map(|tip| Some((tip, tip.image()?)))
    }

    #[test]
    fn every_tip_but_the_pen_has_an_image_and_no_two_the_same() {
        let images: Vec<_> = images().collect();
        assert_eq!(images.len(), Tip::ALL.len() - 1);
        for (i, (tip, image)) in images.iter().enumerate() {
            for (other, same) in &images[..i] {
                assert!(image != same, "{tip:?} and {other:?}");
            }
        }
    }

    /// Of a nap that has heights, a tenth of the image lies between each tenth of them.
    #[test]
    fn heights_are_ranks() {
        for (tip, image) in images().filter(|(tip, _)| tip.manner().dry > 0.0) {
            let mut counts = [0usize; 10];
            for i in 0..SIZE[0] * SIZE[1] {
                let [nap, _] = image.texel(i % SIZE[0], i / SIZE[0]);
                counts[(nap as usize * 10 / 256).min(9)] += 1;
            }
            let tenth = (SIZE[0] * SIZE[1]) as usize / 10;
            assert!(
                counts.iter().all(|n| n.abs_diff(tenth) < tenth / 10),
                "{tip:?} {counts:?}"
            );
        }
    }

    /// The end of an image is like its start: no seam shows where it repeats.
    #[test]
    fn images_repeat_without_a_seam() {
        for (tip, image) in images() {
            let step = |a: u32, b: u32| -> f32 {
                let rows = 0..SIZE[1];
                let off = |y: u32| -> f32 {
                    let [from, to] = [a, b].map(|x| image.texel(x % SIZE[0], y).map(f32::from));
                    (from[0] - to[0]).abs() + (from[1] - to[1]).abs()
                };
                rows.map(off).sum::<f32>() / SIZE[1] as f32
            };
            let usual: f32 = (0..SIZE[0] - 1).map(|x| step(x, x + 1)).fold(0.0, f32::max);
            assert!(step(SIZE[0] - 1, SIZE[0]) <= usual, "{tip:?}");
        }
    }

    /// No ink is cut off at the edges of an image, where strokes end.
    #[test]
    fn what_is_soft_ends_softly() {
        let airbrush = Tip::Airbrush.image().unwrap();
        assert!((0..SIZE[0]).all(|x| airbrush.texel(x, 0)[1] <= 2));
        assert!((0..SIZE[0]).all(|x| airbrush.texel(x, SIZE[1] / 2)[1] >= 250));
    }
}
