//! Stretches of outline, whose lines move together: the twins of `backdrop.gather_tiles`, `backdrop.bound_tiles`, `backdrop.lean_tiles` and
//! `backdrop.blend_leans`.
//!
//! Where line and background are nearly alike, grain alone would decide at every pixel whether a line turns brighter or darker, and the
//! line would repeat every brick behind it. Here it reads before all that lies behind a stretch, by an envelope that changes slowly along
//! the outline, and the stretch votes which way to move.

use super::adapt::{place_of_light, preference, started};
use super::rims::{Rim, TILE, tiles_across};
use super::rule::{Rule, Rules};
use bytemuck::{Pod, Zeroable};
use npr_core::color::{largest_difference, linear_from_srgb, pack_rgba8, unpack_rgba8};
use npr_core::geometry::Part;
use npr_core::gpu_layout;
use npr_core::math;
use npr_core::window::Window;
use rayon::prelude::*;

/// Most tiles in each direction whose votes a tile counts.
pub const LEAN_MOST: u32 = 24;

/// Tiles in each direction over which an envelope reaches.
const ENVELOPE_TILES: u32 = 4;

/// Tiles around a tile for which its envelope holds whole: colours are blended between tiles.
const WHOLE_TILES: f32 = 1.0;

/// How much an envelope falls from tile to tile, on a scale of 0 black to 1 white: less than the eye follows.
const SLOPE: f32 = 0.08;

/// Difference of backgrounds from which they are two walls, and not one with a pattern.
const UNLIKE: f32 = 0.42;

/// How fast another wall stops to count, as a multiple of how much more it differs.
const UNLIKE_SLOPE: f32 = 4.0;

/// How much of the scale bounds may change in the time in which a line fades from darker to brighter.
const FADE_BOUNDS: f32 = 0.4;

/// Tiles in each direction over which what is decided is blended.
const BLEND_TILES: u32 = 6;

/// Tiles around one that bear on its colour beside those that vote.
pub(super) const STRETCH_TILES: u32 = ENVELOPE_TILES + BLEND_TILES;

/// Difference of a channel from which rims are of two paints, and not of one with a texture.
const UNLIKE_RIMS: f32 = 0.5;

/// Mean of votes from which a stretch is decided.
const DECIDED: f32 = 0.01;

/// Whose rims lie in a tile, and what their lines start from and stand before; places from 0 black to 1 white in the rule's measure.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct TileRims {
    /// Mean of what lines start from.
    pub line: f32,
    /// Mean of what lies behind.
    pub behind: f32,
    /// The darkest that lies behind.
    pub low: f32,
    /// The brightest.
    pub high: f32,
    /// How many rims there are.
    pub count: f32,
    /// Whose they are, see [`Rim::WHOSE`]: those of the first rim in the tile; 0 where there is none.
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

/// What lines of a tile read before, and which way they move.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Lean {
    /// The darkest that lies behind the stretch.
    pub low: f32,
    /// The brightest.
    pub high: f32,
    /// From -1, darker, to 1, brighter.
    pub lean: f32,
    /// Whose lines they are, as in [`TileRims::whose`].
    pub whose: u32,
    /// Colour of the rims, sRGB-encoded.
    pub rim: [f32; 3],
    /// Keeps rows of 16 bytes.
    pub unused: u32,
}
gpu_layout!(Lean {
    low,
    high,
    lean,
    whose,
    rim,
    unused
});

impl Lean {
    /// A value of each of both, made one.
    fn with(&self, other: &Self, made: impl Fn(f32, f32) -> f32) -> Self {
        Self {
            low: made(self.low, other.low),
            high: made(self.high, other.high),
            lean: made(self.lean, other.lean),
            rim: std::array::from_fn(|i| made(self.rim[i], other.rim[i])),
            ..*self
        }
    }
}

/// Leans with weights, on their way to a mean.
#[derive(Debug, Clone, Copy, Default)]
struct Mean {
    sum: Lean,
    weight: f32,
}

impl Mean {
    fn add(&mut self, lean: &Lean, weight: f32) {
        self.sum = self.sum.with(lean, |sum, value| sum + value * weight);
        self.weight += weight;
    }

    /// The mean, of some lines; `None` of none.
    fn of(&self, whose: u32) -> Option<Lean> {
        let mean = self.sum.with(&self.sum, |sum, _| sum / self.weight);
        (self.weight > 0.0).then_some(Lean { whose, ..mean })
    }
}

/// Gathers the rims of every tile of [`TILE`] pixels a side. O(pixels), parallel over rows of tiles.
pub fn gather_tiles(
    window: &Window,
    rules: &Rules,
    parts: &[Part],
    rims: &[Rim],
    gathered: &mut [TileRims],
) {
    for_tiles(window, gathered, |tile| {
        gathered_at(window.size, rules, parts, rims, tile)
    });
}

/// Makes something of every tile.
fn for_tiles<T: Send>(window: &Window, tiles: &mut [T], made: impl Fn([u32; 2]) -> T + Sync) {
    let across = tiles_across(window.size) as usize;
    tiles
        .par_chunks_mut(across)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, tile) in row.iter_mut().enumerate() {
                *tile = made([x as u32, y as u32]);
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
    let all = summed(size, rules, parts, rims, tile, [0.0, 1.0]);
    if all.high - all.low <= UNLIKE {
        return all;
    }
    // Where two walls meet, the tile is of the one that more of its rims stand before.
    let middle = 0.5 * (all.low + all.high);
    let dark = summed(size, rules, parts, rims, tile, [0.0, middle]);
    let bright = summed(size, rules, parts, rims, tile, [middle, 1.0]);
    if dark.count >= bright.count {
        dark
    } else {
        bright
    }
}

/// The rims of a tile that stand before a ground between two places.
fn summed(
    size: [u32; 2],
    rules: &Rules,
    parts: &[Part],
    rims: &[Rim],
    tile: [u32; 2],
    within: [f32; 2],
) -> TileRims {
    let mut sum = TileRims {
        low: 1.0,
        ..TileRims::default()
    };
    let mut color = [0.0; 3];
    for y in tile[1] * TILE..((tile[1] + 1) * TILE).min(size[1]) {
        for x in tile[0] * TILE..((tile[0] + 1) * TILE).min(size[0]) {
            let rim = &rims[(y * size[0] + x) as usize];
            let (whose, rule) = (rim.subject & Rim::WHOSE, rim.behind >> 24);
            if whose == 0 || rules.rules[rule as usize].method != Rule::BY_CONTRAST {
                continue;
            }
            if sum.whose == 0 {
                (sum.whose, sum.rule) = (whose, rule);
            }
            if sum.whose != whose || sum.rule != rule {
                continue;
            }
            let [line, behind] = places_of(rim, &rules.rules[rule as usize], parts);
            if behind < within[0] || behind > within[1] {
                continue;
            }
            sum.line += line;
            sum.behind += behind;
            sum.low = sum.low.min(behind);
            sum.high = sum.high.max(behind);
            let [r, g, b, _] = unpack_rgba8(rim.rim);
            color = [color[0] + r, color[1] + g, color[2] + b];
            sum.count += 1.0;
        }
    }
    let count = sum.count.max(1.0);
    let [r, g, b] = color.map(|channel| channel / count);
    TileRims {
        rim: pack_rgba8([r, g, b, 0.0]),
        line: sum.line / count,
        behind: sum.behind / count,
        ..sum
    }
}

/// Where the line that a rim's part is expected to have, and what lies behind it, lie on the scale of the rule.
fn places_of(rim: &Rim, rule: &Rule, parts: &[Part]) -> [f32; 2] {
    let light = |texel: u32| {
        let [r, g, b, _] = unpack_rgba8(texel);
        [r, g, b].map(linear_from_srgb)
    };
    let part = &parts[rim.part as usize];
    let edge = light(rim.rim);
    let own = if part.line_flags & Part::LINE_SURFACE != 0 {
        edge.map(|channel| (channel * part.line_factor).clamp(0.0, 1.0))
    } else {
        let [r, g, b, _] = part.line_color;
        [r, g, b].map(linear_from_srgb)
    };
    [started(own, edge, rule), light(rim.behind)].map(|light| place_of_light(light, rule))
}

/// Gives every tile the bounds of what its lines stand before, and its own vote as the lean.
///
/// Bounds are envelopes over 4 tiles each way, which fall with the distance: a line that follows them changes slowly.
/// Another wall, by 0.42 darker or brighter, does not count. O(tiles with rims * 81), parallel over rows of tiles.
pub fn bound_tiles(window: &Window, rules: &Rules, gathered: &[TileRims], bounds: &mut [Lean]) {
    let across = tiles_across(window.size);
    for_tiles(window, bounds, |tile| {
        bound_at(rules, gathered, across, tile)
    });
}

/// The tiles up to `reach` around one, itself included, row by row: their numbers, and the squares of how many tiles they are away.
fn around(
    across: u32,
    tile_count: usize,
    [x, y]: [u32; 2],
    reach: u32,
) -> impl Iterator<Item = (usize, f32)> {
    let down = tile_count as u32 / across;
    let columns = x.saturating_sub(reach)..=(x + reach).min(across - 1);
    (y.saturating_sub(reach)..=(y + reach).min(down - 1)).flat_map(move |row| {
        columns.clone().map(move |column| {
            let off = [column as f32 - x as f32, row as f32 - y as f32];
            let square = off[0] * off[0] + off[1] * off[1];
            ((row * across + column) as usize, square)
        })
    })
}

fn bound_at(rules: &Rules, gathered: &[TileRims], across: u32, [x, y]: [u32; 2]) -> Lean {
    let here = gathered[(y * across + x) as usize];
    if here.whose == 0 {
        return Lean::default();
    }
    let (mut low, mut high) = (here.low, here.high);
    let reach = if rules.lean_px > 0.0 {
        ENVELOPE_TILES
    } else {
        0
    };
    for (index, square) in around(across, gathered.len(), [x, y], reach) {
        let there = gathered[index];
        if there.whose == here.whose {
            let loss = (square.sqrt() - WHOLE_TILES).max(0.0) * SLOPE;
            let unlike = ((there.behind - here.behind).abs() - UNLIKE).max(0.0) * UNLIKE_SLOPE;
            low = low.min(there.low + loss + unlike);
            high = high.max(there.high - loss - unlike);
        }
    }
    let rule = &rules.rules[here.rule as usize];
    let [r, g, b, _] = unpack_rgba8(here.rim);
    Lean {
        low,
        high,
        lean: preference(here.line, [low, high], rule),
        whose: here.whose,
        rim: [r, g, b],
        unused: 0,
    }
}

/// Decides for every tile, by the votes around it and what was decided there in the frame before.
///
/// A Gaussian that ends at [`Rules::lean_px`]; tiles of other subjects do not count, those before other walls less. What was
/// decided before counts as [`Rules::hold`] votes of each, so that a stretch that could go either way stays as it was; and where a line must
/// change, it fades, by [`Rules::fade`] of the way a frame. O(tiles with rims * reach squared), parallel over rows of tiles.
pub fn lean_tiles(
    window: &Window,
    rules: &Rules,
    gathered: &[TileRims],
    bounds: &[Lean],
    before: &[Lean],
    leans: &mut [Lean],
) {
    let across = tiles_across(window.size);
    for_tiles(window, leans, |tile| {
        lean_at(rules, gathered, bounds, before, across, tile)
    });
}

fn lean_at(
    rules: &Rules,
    gathered: &[TileRims],
    bounds: &[Lean],
    before: &[Lean],
    across: u32,
    [x, y]: [u32; 2],
) -> Lean {
    let at = (y * across + x) as usize;
    let here = gathered[at];
    if here.whose == 0 {
        return Lean::default();
    }
    let tiles = rules.lean_px / TILE as f32;
    let reach = (tiles.max(0.0).ceil() as u32).min(LEAN_MOST);
    let falloff = -2.0 / (tiles * tiles).max(1.0);
    let (mut sum, mut count) = (0.0, 0.0);
    for (index, square) in around(across, gathered.len(), [x, y], reach) {
        let there = gathered[index];
        if there.whose == here.whose {
            let near = math::exp(square * falloff);
            let alike = 1.0 - (there.behind - here.behind).abs() / (2.0 * UNLIKE);
            let weight = near * alike.max(0.0) * there.count;
            sum += bounds[index].lean * weight;
            count += weight;
        }
    }
    let vote = sum / count.max(1e-6);
    let decided = |held: f32| ((vote + rules.hold * held) / DECIDED).clamp(-1.0, 1.0);
    let bound = bounds[at];
    let was = held(before, &bound, across, [x, y]);
    let decided = Lean {
        lean: decided(was.map_or(0.0, |was| was.lean)),
        ..bound
    };
    match was {
        Some(was) if rules.fade < 1.0 => Lean {
            lean: nearer(was.lean, decided.lean, 2.0 * rules.fade),
            ..decided.with(&was, |to, from| nearer(from, to, FADE_BOUNDS * rules.fade))
        },
        _ => decided,
    }
}

/// A value moved towards another by no more than a step.
fn nearer(from: f32, to: f32, step: f32) -> f32 {
    from + (to - from).clamp(-step, step)
}

/// What was decided before for the same lines before the same wall: in the tile itself, or else the mean of those that touch it, for an outline
/// moves between frames.
fn held(before: &[Lean], here: &Lean, across: u32, [x, y]: [u32; 2]) -> Option<Lean> {
    let is_same = |lean: &Lean| {
        let off = (lean.low + lean.high) - (here.low + here.high);
        lean.whose == here.whose && off.abs() < 2.0 * UNLIKE
    };
    let own = before[(y * across + x) as usize];
    if is_same(&own) {
        return Some(own);
    }
    let mut mean = Mean::default();
    for (index, _) in around(across, before.len(), [x, y], 1) {
        if is_same(&before[index]) {
            mean.add(&before[index], 1.0);
        }
    }
    mean.of(here.whose)
}

/// Keeps leans for the next frame, and blends them along the outline for this one.
///
/// Where a stretch that turns brighter meets one that turns darker, the line passes from one to the other over a length that the eye takes
/// for shading. A Gaussian that ends at 6 tiles; bounds stay as they are, and tiles before another wall or of other paint count less.
/// O(tiles with rims * 169), parallel over rows of tiles.
pub fn blend_leans(
    window: &Window,
    rules: &Rules,
    leans: &[Lean],
    kept: &mut [Lean],
    blended: &mut [Lean],
) {
    kept.copy_from_slice(leans);
    let across = tiles_across(window.size);
    for_tiles(window, blended, |tile| {
        blended_at(rules, leans, across, tile)
    });
}

fn blended_at(rules: &Rules, leans: &[Lean], across: u32, [x, y]: [u32; 2]) -> Lean {
    let here = leans[(y * across + x) as usize];
    if here.whose == 0 || rules.lean_px <= 0.0 {
        return here;
    }
    let falloff = -2.0 / (BLEND_TILES * BLEND_TILES) as f32;
    let (mut lean, mut leaning) = (0.0, 0.0);
    let (mut rim, mut coloring) = ([0.0; 3], 0.0);
    for (index, square) in around(across, leans.len(), [x, y], BLEND_TILES) {
        let there = &leans[index];
        if there.whose == here.whose {
            let near = math::exp(square * falloff);
            let wall = 0.5 * ((there.low + there.high) - (here.low + here.high));
            let paint =
                near * (1.0 - largest_difference(here.rim, there.rim) / UNLIKE_RIMS).max(0.0);
            let weight = paint * (1.0 - wall.abs() / UNLIKE).max(0.0);
            lean += there.lean * weight;
            leaning += weight;
            rim = std::array::from_fn(|i| rim[i] + there.rim[i] * paint);
            coloring += paint;
        }
    }
    Lean {
        lean: lean / leaning,
        rim: rim.map(|channel| channel / coloring),
        ..here
    }
}

/// The lean of a pixel's rim, between the four tiles around: those of the same subject alone; `None` where there is none of it.
pub(super) fn lean_between(
    leans: &[Lean],
    size: [u32; 2],
    whose: u32,
    pixel: [u32; 2],
) -> Option<Lean> {
    let across = tiles_across(size);
    let down = leans.len() as u32 / across;
    let place = pixel.map(|at| (at as f32 + 0.5) / TILE as f32 - 0.5);
    let mut mean = Mean::default();
    for i in 0..4 {
        let column = place[0].floor() + (i & 1) as f32;
        let row = place[1].floor() + (i >> 1) as f32;
        if column < 0.0 || row < 0.0 || column >= across as f32 || row >= down as f32 {
            continue;
        }
        let lean = leans[row as usize * across as usize + column as usize];
        if lean.whose == whose {
            let near = (1.0 - (place[0] - column).abs()) * (1.0 - (place[1] - row).abs());
            mean.add(&lean, near + 1e-4);
        }
    }
    mean.of(whose)
}
