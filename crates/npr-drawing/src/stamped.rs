//! Strokes drawn with brushes, as images that files set down one after the other.
//!
//! Frames find the ink of a brush in every pixel; files hold the same in images, each made once. A stroke of stamps
//! has one image a stamp, where frames have them; the image of a ribbon is cut into [`tiles`] that follow the stroke.
//! Images are told apart by a [`Key`] of few steps, so that thousands of stamps share dozens of images, and baked by
//! the function that draws frames.
//!
//! Where stamps overlap, frames show the one with most ink and files lay one over the other, which would be darker.
//! So every stamp takes a share of the ink, by [`Overlap`].

mod bake;
mod overlap;
mod tiles;

use crate::clip::clip_stroke;
use crate::ink::{BrushLay, Images, Laid, keep_apart, widest};
use npr_vector::brush::{Brush, Brushes};
use npr_vector::ink_point::InkPoint;
use npr_vector::stroke::{Drawing, Stroke, StrokePoint, length_of};
use overlap::Overlaps;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Most stamps that a file may hold.
pub const STAMPS_LIMIT: u64 = 1_000_000;

/// The brushes of a drawing's strokes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StrokeBrushes {
    /// The brushes, a pen first.
    pub all: Vec<Brush>,
    /// The words that hold their images.
    pub texels: Vec<u32>,
    /// How that of every surface lies on strokes; a pen draws those of surfaces behind them.
    pub lays: Vec<BrushLay>,
}

impl StrokeBrushes {
    /// How the image of its brush lies on a stroke; `None` for a pen.
    fn lay_of(&self, stroke: &Stroke) -> Option<BrushLay> {
        let lay = self.lays.get(stroke.surface as usize).copied();
        lay.filter(|lay| lay.brush > 0)
    }

    fn brushes(&self) -> Brushes<'_> {
        Brushes {
            all: &self.all,
            texels: &self.texels,
        }
    }
}

/// An image of one colour that stamps show, with an empty rim one texel wide.
#[derive(Debug, Clone, PartialEq)]
pub struct StampImage {
    /// Texels per row, and rows.
    pub size: [u32; 2],
    /// sRGB.
    pub color: [u8; 3],
    /// How much ink there is at every texel, row by row.
    pub alpha: Vec<u8>,
}

impl StampImage {
    /// Its pixels: sRGB bytes with straight alpha.
    pub fn rgba(&self) -> Vec<u8> {
        let [r, g, b] = self.color;
        self.alpha.iter().flat_map(|a| [r, g, b, *a]).collect()
    }
}

/// A place where an image is set down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stamp {
    /// The corners of the image, from the upper left one on as its rows go, in pixels.
    pub corners: [[f64; 2]; 4],
    /// Number of its image.
    pub image: u32,
    /// sRGB and alpha.
    pub color: [u8; 4],
}

/// The stamps of all strokes, and their images.
#[derive(Debug, Default)]
pub(crate) struct Stamped {
    pub images: Vec<StampImage>,
    /// Those of every stroke of the drawing; `None` where a pen draws it.
    pub of_strokes: Vec<Option<Vec<Stamp>>>,
}

impl Stamped {
    /// Those of the stroke with this number in the drawing; `None` where a pen draws it.
    pub fn of(&self, stroke: usize) -> Option<&[Stamp]> {
        self.of_strokes.get(stroke)?.as_deref()
    }
}

/// What a stamp shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Form {
    /// A stamp of a stroke of stamps.
    Stamp,
    /// A piece of a ribbon.
    Tile,
    /// The round end of a ribbon.
    Cap,
}

/// A stamp before its image is known.
#[derive(Debug, Clone, Copy)]
struct Print {
    form: Form,
    /// Both ends, with their places in the brush's image.
    ends: [InkPoint; 2],
}

/// A part of a stroke within the picture, and whether it is closed.
type Part = (Vec<StrokePoint>, bool);

/// The parts of the visible strokes that brushes draw.
fn parts_of(drawing: &Drawing, brushes: &StrokeBrushes) -> Vec<Option<Vec<Part>>> {
    let of_stroke = |stroke: &Stroke| {
        brushes
            .lay_of(stroke)
            .filter(|_| stroke.is_visible())
            .map(|_| {
                let widest = widest(stroke);
                match widest > 0.0 {
                    true => clip_stroke(stroke, drawing.size.map(f64::from), widest + 1.0),
                    false => Vec::new(),
                }
            })
    };
    drawing.strokes.par_iter().map(of_stroke).collect()
}

/// Number of stamps that a drawing takes, or a little more: known before there is memory for them. O(points).
pub fn stamp_count(drawing: &Drawing, brushes: &StrokeBrushes) -> u64 {
    count(drawing, brushes, &parts_of(drawing, brushes))
}

fn count(drawing: &Drawing, brushes: &StrokeBrushes, parts: &[Option<Vec<Part>>]) -> u64 {
    let of_stroke = |(stroke, parts): (&Stroke, &Option<Vec<Part>>)| {
        let (Some(lay), Some(parts)) = (brushes.lay_of(stroke), parts) else {
            return 0;
        };
        let of_part = |(points, is_closed): &Part| {
            let length = length_of(points, *is_closed);
            let stamps = match lay.images {
                Images::Stamps(stamps) => length / stamps.spacing_over(length) + 1.0,
                Images::Once | Images::ByLength(_) => {
                    tiles::most_over(length, 2.0 * widest(stroke)) + points.len() as f64
                }
            };
            if stamps.is_finite() {
                stamps.ceil() as u64
            } else {
                0
            }
        };
        parts.iter().map(of_part).sum()
    };
    let strokes = drawing.strokes.iter().zip(parts);
    strokes.map(of_stroke).sum()
}

/// The stamps of a drawing; none of any stroke where they are more than [`STAMPS_LIMIT`].
///
/// Strokes and images are worked on in parallel; the result does not depend on the number of threads. O(points +
/// stamps + texels of images).
pub(crate) fn stamp(
    drawing: &Drawing,
    brushes: &StrokeBrushes,
    own_color: &(dyn Fn(&Stroke) -> [u8; 4] + Sync),
) -> Stamped {
    // Set stamps along the strokes.
    let parts = parts_of(drawing, brushes);
    if count(drawing, brushes, &parts) > STAMPS_LIMIT {
        return Stamped::default();
    }
    let strokes = drawing.strokes.par_iter().zip(parts);
    let prints: Vec<Option<Vec<Print>>> = strokes
        .map(|(stroke, parts)| {
            let (lay, parts) = (brushes.lay_of(stroke)?, parts?);
            Some(prints_of(stroke, lay, own_color(stroke), parts))
        })
        .collect();

    // Tell their images apart, as finely as leaves few of them. Strokes with a stamp have a surface.
    let first_like = |lay: &BrushLay| brushes.lays.iter().position(|other| other == lay);
    let alike: Vec<u32> = brushes
        .lays
        .iter()
        .map(|lay| first_like(lay).unwrap_or(0) as u32)
        .collect();
    let all = || drawing.strokes.iter().zip(&prints);
    let keys_by = |steps: &Steps| {
        let mut keys = BTreeMap::new();
        for (stroke, prints) in all() {
            for print in prints.iter().flatten() {
                let surface = alike[stroke.surface as usize];
                keys.insert(Key::of(print, surface, steps), 0u32);
                if keys.len() > IMAGES_MAX && steps != STEPS.last().unwrap_or(&STEPS[0]) {
                    return None;
                }
            }
        }
        Some((*steps, keys))
    };
    let Some((steps, mut keys)) = STEPS.iter().find_map(keys_by) else {
        return Stamped::default();
    };
    for (number, slot) in keys.values_mut().enumerate() {
        *slot = number as u32;
    }

    // Make each image, and give every stamp its own.
    let made: Vec<Key> = keys.keys().copied().collect();
    let overlaps = Overlaps::of(&made, brushes, &steps);
    let images = made
        .par_iter()
        .map(|key| bake::image(key, brushes, &overlaps, &steps))
        .collect();
    let of_strokes = drawing.strokes.par_iter().zip(&prints);
    let of_strokes = of_strokes.map(|(stroke, prints)| {
        let placed = |print: &Print| {
            let key = Key::of(print, alike[stroke.surface as usize], &steps);
            Stamp {
                corners: bake::corners(print, &key, &steps),
                image: keys[&key],
                color: print.ends[0].color.to_le_bytes(),
            }
        };
        Some(prints.as_ref()?.iter().map(placed).collect())
    });
    Stamped {
        images,
        of_strokes: of_strokes.collect(),
    }
}

fn prints_of(stroke: &Stroke, lay: BrushLay, own: [u8; 4], parts: Vec<Part>) -> Vec<Print> {
    let laid = Laid::new(stroke, lay, widest(stroke));
    let inked = |point: &StrokePoint| laid.inked(point, own);
    let of_part = |(mut points, is_closed): Part| {
        keep_apart(&mut points);
        match lay.images {
            Images::Stamps(stamps) => {
                let pairs = stamps.along(&points, is_closed, stroke.line(), &inked);
                let prints = pairs.as_chunks().0.iter().map(|ends| Print {
                    form: Form::Stamp,
                    ends: *ends,
                });
                prints.collect()
            }
            Images::Once | Images::ByLength(_) => tiles::along(&points, is_closed, &laid, &inked),
        }
    };
    parts.into_iter().flat_map(of_part).collect()
}

/// Most images of a file before their steps become coarser.
const IMAGES_MAX: usize = 384;

/// How finely images are told apart.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Steps {
    /// Steps of pressure, from none to all.
    pressure: f32,
    /// Sizes an octave.
    size: f32,
    /// Different places in the brush's image.
    places: f32,
    /// Bits a channel of colour.
    color_bits: u32,
}

/// From the finest to the coarsest.
const STEPS: [Steps; 6] = {
    const fn steps(pressure: f32, size: f32, places: f32, color_bits: u32) -> Steps {
        Steps {
            pressure,
            size,
            places,
            color_bits,
        }
    }
    [
        steps(8.0, 2.0, 64.0, 8),
        steps(8.0, 2.0, 16.0, 7),
        steps(6.0, 1.0, 8.0, 6),
        steps(4.0, 1.0, 4.0, 5),
        steps(3.0, 1.0, 2.0, 4),
        steps(1.0, 1.0, 1.0, 2),
    ]
};

/// What an image shows, in steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    form: Form,
    /// A surface with this brush, laid this way.
    surface: u32,
    /// Share of full pressure.
    pressure: u32,
    /// Logarithm of the half width.
    half: i32,
    /// Logarithm of the length in widths, in halves.
    length: i32,
    /// Where in the brush's image it begins, and its share of that, in 1/4096.
    place: [i32; 2],
    color: [u8; 3],
}

/// Parts of the brush's image that places are counted in.
const PLACES: f32 = 4096.0;

impl Key {
    /// What a stamp of a stroke on a surface shows.
    fn of(print: &Print, surface: u32, steps: &Steps) -> Self {
        let [a, b] = &print.ends;
        let length = f32::hypot(b.px[0] - a.px[0], b.px[1] - a.px[1]);
        let half = a.half_width.max(LEAST_HALF_PX);
        let in_steps = |v: f32, count: f32| (v * count).round().clamp(1.0, count) as u32;
        let share = b.u - a.u;
        let places = steps.places.min((1.0 / share.abs().max(1e-3)).max(1.0));
        let from = ((a.u - a.u.floor()) * places + 0.5).floor() % places / places;
        let kept = 8 - steps.color_bits;
        let [red, green, blue, _] = a.color.to_le_bytes();
        Self {
            form: print.form,
            surface,
            pressure: in_steps(a.pressure, steps.pressure),
            half: (npr_core::math::log2(half) * steps.size).round() as i32,
            length: match print.form {
                Form::Cap => 0,
                Form::Tile | Form::Stamp => {
                    (2.0 * npr_core::math::log2((0.5 * length / half).max(0.01))).round() as i32
                }
            },
            place: [from, share].map(|v| (v * PLACES).round() as i32),
            color: [red, green, blue].map(|v| match kept {
                0 => v,
                _ => {
                    let top = (1u32 << steps.color_bits) - 1;
                    let step = (u32::from(v) * top + 127) / 255;
                    (step * 255 / top) as u8
                }
            }),
        }
    }

    fn pressure(&self, steps: &Steps) -> f32 {
        (self.pressure as f32 / steps.pressure).min(1.0)
    }

    /// Half the width of the stamp, in pixels.
    fn half_px(&self, steps: &Steps) -> f32 {
        npr_core::math::exp2(self.half as f32 / steps.size)
    }

    /// Its length, in widths.
    fn widths(&self) -> f32 {
        npr_core::math::exp2(self.length as f32 / 2.0)
    }
}

/// Least half width of a stamp, in pixels.
const LEAST_HALF_PX: f32 = 0.05;
