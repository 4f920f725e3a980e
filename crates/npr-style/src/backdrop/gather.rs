//! The rims of a tile and what lies behind them, summed up: the twin of `backdrop.gather_tiles`.

use super::adapt::{place_of_light, started};
use super::rims::{Rim, TILE, tiles_across};
use super::rule::{Rule, Rules};
use bytemuck::{Pod, Zeroable};
use npr_core::color::{linear_from_byte, linear_from_srgb, pack_rgba8, unpack_rgba8};
use npr_core::geometry::Part;
use npr_core::gpu_layout;
use npr_core::window::Window;
use rayon::prelude::*;

/// Difference of two backgrounds from which they count as two walls, not as one with a pattern.
pub(super) const UNLIKE: f32 = 0.42;

/// The rims of one subject and rule in a tile: where their lines start and what lies behind; places from 0 black to 1
/// white in the rule's measure.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct TileRims {
    /// Mean place that the lines start from.
    pub line: f32,
    /// Mean place of what lies behind.
    pub behind: f32,
    /// The darkest place that lies behind.
    pub low: f32,
    /// The brightest place that lies behind.
    pub high: f32,
    /// How many rims there are.
    pub count: f32,
    /// The subject and the bit for lines within, see [`Rim::WHOSE`], of the first rim in the tile; 0 if there is none.
    pub whose: u32,
    /// The number of their rule.
    pub rule: u32,
    /// Mean colour of the rims, sRGB bytes.
    pub rim: u32,
}
gpu_layout!(TileRims {
    line,
    behind,
    low,
    high,
    count,
    whose,
    rule,
    rim
});

/// Gathers the rims of every tile of [`TILE`] pixels a side. O(pixels), parallel over rows of tiles.
pub fn gather_tiles(
    window: &Window,
    rules: &Rules,
    parts: &[Part],
    rims: &[Rim],
    gathered: &mut [TileRims],
) {
    let across = tiles_across(window.size) as usize;
    gathered
        .par_chunks_mut(across)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, tile) in row.iter_mut().enumerate() {
                *tile = gathered_at(window.size, rules, parts, rims, [x as u32, y as u32]);
            }
        });
}

fn gathered_at(
    size: [u32; 2],
    rules: &Rules,
    parts: &[Part],
    rims: &[Rim],
    tile: [u32; 2],
) -> TileRims {
    let found = Found::in_tile(size, rules, parts, rims, tile);
    let all = found.summed([0.0, 1.0]);
    if all.high - all.low <= UNLIKE {
        return all;
    }
    // If a tile holds two walls, keep the rims before the one that more of them lie before.
    let middle = 0.5 * (all.low + all.high);
    let (dark, bright) = (found.summed([0.0, middle]), found.summed([middle, 1.0]));
    if dark.count >= bright.count {
        dark
    } else {
        bright
    }
}

/// The rims of a tile that are of the same subject and rule as the first.
#[derive(Default)]
struct Found {
    whose: u32,
    rule: u32,
    /// For each of the first `count` rims: where its line starts, what lies behind, and its colour.
    rims: [([f32; 2], u32); (TILE * TILE) as usize],
    count: usize,
}

impl Found {
    fn in_tile(
        size: [u32; 2],
        rules: &Rules,
        parts: &[Part],
        rims: &[Rim],
        tile: [u32; 2],
    ) -> Self {
        // Go through the rims of the tile that follow a rule by contrast.
        let mut found = Self::default();
        for y in tile[1] * TILE..((tile[1] + 1) * TILE).min(size[1]) {
            for x in tile[0] * TILE..((tile[0] + 1) * TILE).min(size[0]) {
                let rim = &rims[(y * size[0] + x) as usize];
                let (whose, number) = (rim.subject & Rim::WHOSE, rim.behind >> 24);
                if whose == 0 {
                    continue;
                }
                let rule = &rules.rules[number as usize];
                if rule.method != Rule::BY_CONTRAST {
                    continue;
                }

                // Keep those of the subject and the rule of the first.
                if found.whose == 0 {
                    (found.whose, found.rule) = (whose, number);
                }
                if found.whose == whose && found.rule == number {
                    found.rims[found.count] = (places_of(rim, rule, parts), rim.rim);
                    found.count += 1;
                }
            }
        }
        found
    }

    /// Sums up the rims before grounds between two places on the scale.
    fn summed(&self, within: [f32; 2]) -> TileRims {
        // Add up the rims that stand before a ground in the range.
        let mut sum = TileRims {
            low: 1.0,
            whose: self.whose,
            rule: self.rule,
            ..TileRims::default()
        };
        let mut color = [0.0; 3];
        for ([line, behind], rim) in &self.rims[..self.count] {
            if *behind < within[0] || *behind > within[1] {
                continue;
            }
            sum.line += line;
            sum.behind += behind;
            sum.low = sum.low.min(*behind);
            sum.high = sum.high.max(*behind);
            let [r, g, b, _] = unpack_rgba8(*rim);
            color = [color[0] + r, color[1] + g, color[2] + b];
            sum.count += 1.0;
        }

        // Turn the sums into means; the darkest and the brightest ground stay.
        let count = sum.count.max(1.0);
        let [r, g, b] = color.map(|channel| channel / count);
        TileRims {
            rim: pack_rgba8([r, g, b, 0.0]),
            line: sum.line / count,
            behind: sum.behind / count,
            ..sum
        }
    }
}

/// Places, on the rule's scale, of the line that a rim's part is expected to have and of what lies behind it.
fn places_of(rim: &Rim, rule: &Rule, parts: &[Part]) -> [f32; 2] {
    let part = &parts[rim.part as usize];
    let edge = light_of(rim.rim);
    let own = || {
        if part.line_flags & Part::LINE_SURFACE != 0 {
            return edge.map(|channel| (channel * part.line_factor).clamp(0.0, 1.0));
        }
        let [r, g, b, _] = part.line_color;
        [r, g, b].map(linear_from_srgb)
    };
    [started(own, edge, rule), light_of(rim.behind)].map(|light| place_of_light(light, rule))
}

/// Linear light of sRGB bytes.
fn light_of(texel: u32) -> [f32; 3] {
    let [r, g, b, _] = texel.to_le_bytes();
    [r, g, b].map(linear_from_byte)
}
