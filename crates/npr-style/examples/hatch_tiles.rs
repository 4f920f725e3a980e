//! Draws every hatch: light grows from left to right, distance from top to bottom, three octaves in all.
//!
//! `cargo run -p npr-style --example hatch_tiles -- FOLDER` writes two pictures per pattern: thirteen strips,
//! each at one distance, and a floor that runs away without a step.

use npr_core::math;
use npr_style::hatch::{Pattern::*, *};

const SIZE: [u32; 2] = [1200, 1040];
const STRIP: u32 = 80;
const OCTAVES_PER_PX: f32 = 3.0 / SIZE[1] as f32;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    for pattern in [Parallel, Cross, Stipple, Dots, Pencil, Brush] {
        let hatch = Hatch {
            pattern,
            ..Hatch::default()
        };
        let tile = levels(&hatch, 512)?;
        let draw = |place: fn(f32, f32) -> [f32; 3]| {
            image::GrayImage::from_fn(SIZE[0], SIZE[1], |x, y| {
                let light = 0.2 + 0.6 * x as f32 / SIZE[0] as f32;
                let ink = ink(&hatch, &tile, place(x as f32, y as f32), light);
                image::Luma([(255.0 * (1.0 - ink)) as u8])
            })
        };
        let name = format!("{folder}/{}", format!("{pattern:?}").to_lowercase());
        draw(strip).save(format!("{name}.png"))?;
        draw(floor).save(format!("{name}-floor.png"))?;
    }
    Ok(())
}

/// Place on the hatch, in pixels of the nearest distance, and octaves away from it.
fn strip(x: f32, y: f32) -> [f32; 3] {
    let octaves = 0.25 * (y / STRIP as f32).floor();
    let scale = math::powf(2.0, octaves);
    [x * scale, y % STRIP as f32 * scale, octaves]
}

/// The same, where distance grows from row to row; along v by the sum of what the rows above cover.
fn floor(x: f32, y: f32) -> [f32; 3] {
    let scale = math::powf(2.0, y * OCTAVES_PER_PX);
    let v = scale / (OCTAVES_PER_PX * std::f32::consts::LN_2);
    [(x - SIZE[0] as f32 / 2.0) * scale, v, y * OCTAVES_PER_PX]
}

/// Ink of a pixel, 0..1, with strokes as far apart on screen as texels of the tile's first drawing.
fn ink(hatch: &Hatch, tile: &HatchTile, [x, y, octaves]: [f32; 3], light: f32) -> f32 {
    let (level, f) = level_at(octaves, tile.levels.len() as u32);
    let (texels, side) = (&tile.levels[level as usize], tile.side >> level);
    let [u, v] = [x, y].map(|px| px / tile.side as f32);
    let layer = |place| sample(texels, side, place, f);
    let mut s = layer([u, v]);
    let slope = math::powf(2.0, f) * s.gradient[0].hypot(s.gradient[1]);
    if hatch.pattern.layer_count() == 2 {
        let second = layer([v + 0.5, u + 0.5]).luminance;
        s.luminance = cross_luminance(s.luminance, second, second_layer_start(hatch.cross_at));
    }
    let gradient = edge_gradient(slope, tile.spacing_texels);
    ink_coverage(tone_value(s.luminance, light), gradient, 0.5)
}
