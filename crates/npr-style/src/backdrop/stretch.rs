//! Stretches of outline, whose lines move together: the twins of `backdrop.bound_tiles`, `backdrop.vote_bias` and
//! `backdrop.blend_biases`.
//!
//! Where line and background are nearly alike, grain alone would decide at every pixel whether a line turns brighter
//! or darker, and the line would repeat every brick behind it. Here it reads before all that lies behind a stretch,
//! by an envelope that changes slowly along the outline, and the stretch votes which way to move.

use super::adapt::{Ground, preference};
use super::gather::{TileRims, UNLIKE};
use super::occupied::{Gaussian, Occupied};
use super::rims::{TILE, tiles_across};
use super::rule::Rules;
use bytemuck::{Pod, Zeroable};
use npr_core::color::{largest_difference, unpack_rgba8};
use npr_core::gpu_layout;
use npr_core::window::Window;

/// Most tiles in each direction whose votes a tile counts.
pub const BIAS_REACH_MOST: u32 = 24;

/// Tiles in each direction over which an envelope reaches.
const ENVELOPE_TILES: u32 = 4;

/// Tiles around a tile for which its envelope holds whole: colours are blended between tiles.
const WHOLE_TILES: f32 = 1.0;

/// How much an envelope falls from tile to tile, on a scale of 0 black to 1 white: less than the eye follows.
const SLOPE: f32 = 0.08;

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

/// The range of grounds that the lines of a tile must read before, and which way they move.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct ContrastBias {
    /// The darkest that lies behind the stretch.
    pub low: f32,
    /// The brightest.
    pub high: f32,
    /// From -1, darker, to 1, brighter.
    pub bias: f32,
    /// The subject that the lines belong to, as in [`TileRims::whose`].
    pub whose: u32,
    /// Colour of the rims, sRGB-encoded.
    pub rim: [f32; 3],
    /// Keeps rows of 16 bytes.
    pub unused: u32,
}
gpu_layout!(ContrastBias {
    low,
    high,
    bias,
    whose,
    rim,
    unused
});

impl ContrastBias {
    /// What lines of the stretch stand before, and how much of the brighter way they take.
    pub(super) fn ground(&self) -> Ground {
        Ground {
            low: self.low,
            high: self.high,
            brighter: Some(0.5 + 0.5 * self.bias),
        }
    }

    /// Combines every number of this bias with the same number of another one.
    fn with(&self, other: &Self, made: impl Fn(f32, f32) -> f32) -> Self {
        Self {
            low: made(self.low, other.low),
            high: made(self.high, other.high),
            bias: made(self.bias, other.bias),
            rim: std::array::from_fn(|i| made(self.rim[i], other.rim[i])),
            ..*self
        }
    }
}

/// Biases with weights, on their way to a mean.
#[derive(Debug, Clone, Copy, Default)]
struct Mean {
    sum: ContrastBias,
    weight: f32,
}

impl Mean {
    fn add(&mut self, bias: &ContrastBias, weight: f32) {
        self.sum = self.sum.with(bias, |sum, value| sum + value * weight);
        self.weight += weight;
    }

    /// The mean, of some lines; `None` of none.
    fn of(&self, whose: u32) -> Option<ContrastBias> {
        let mean = self.sum.with(&self.sum, |sum, _| sum / self.weight);
        (self.weight > 0.0).then_some(ContrastBias { whose, ..mean })
    }
}

/// Gives every tile the bounds of what its lines stand before, and its own vote as the bias.
///
/// Bounds are envelopes over 4 tiles each way, which fall with the distance: a line that follows them changes slowly.
/// Another wall, by 0.42 darker or brighter, does not count. O(tiles with rims * 81), parallel over rows of tiles.
pub fn bound_tiles(
    window: &Window,
    rules: &Rules,
    gathered: &[TileRims],
    bounds: &mut [ContrastBias],
) {
    let tiles = Tiles::of(window, gathered, |tile| tile.whose);
    tiles.make(bounds, |tile| bound_at(rules, &tiles, tile));
}

/// Tiles of which only those are looked at that hold rims.
struct Tiles<'a, T> {
    tiles: &'a [T],
    across: usize,
    occupied: Occupied,
}

impl<'a, T: Sync> Tiles<'a, T> {
    fn of(window: &Window, tiles: &'a [T], whose: impl Fn(&T) -> u32 + Sync) -> Self {
        let across = tiles_across(window.size) as usize;
        Self {
            tiles,
            across,
            occupied: Occupied::of(tiles, across, |tile| whose(tile) != 0),
        }
    }

    fn number(&self, [x, y]: [u32; 2]) -> usize {
        y as usize * self.across + x as usize
    }

    fn at(&self, tile: [u32; 2]) -> &'a T {
        &self.tiles[self.number(tile)]
    }

    /// Those up to `reach` tiles around one, itself included, row by row: their numbers, what they hold, and the
    /// squares of how many tiles they are away.
    fn around(&self, tile: [u32; 2], reach: u32) -> impl Iterator<Item = (usize, &'a T, u32)> {
        let near = self.occupied.around(tile, reach);
        near.map(|near| (self.number(near.place), self.at(near.place), near.square))
    }

    /// Makes something of every tile that holds rims; all others become empty.
    fn make<U: Default + Clone + Send>(&self, made: &mut [U], of: impl Fn([u32; 2]) -> U + Sync) {
        made.fill(U::default());
        self.occupied.make(made, self.across, of);
    }
}

fn bound_at(rules: &Rules, gathered: &Tiles<'_, TileRims>, tile: [u32; 2]) -> ContrastBias {
    // Widen the bounds to those of the same lines nearby; distance and unlike walls count against them.
    let here = gathered.at(tile);
    let (mut low, mut high) = (here.low, here.high);
    let reach = if rules.bias_px > 0.0 {
        ENVELOPE_TILES
    } else {
        0
    };
    for (_, there, square) in gathered.around(tile, reach) {
        if there.whose == here.whose {
            let loss = ((square as f32).sqrt() - WHOLE_TILES).max(0.0) * SLOPE;
            let unlike = ((there.behind - here.behind).abs() - UNLIKE).max(0.0) * UNLIKE_SLOPE;
            low = low.min(there.low + loss + unlike);
            high = high.max(there.high - loss - unlike);
        }
    }

    // Vote for the way that the lines of this tile had better move.
    let rule = &rules.rules[here.rule as usize];
    let [r, g, b, _] = unpack_rgba8(here.rim);
    ContrastBias {
        low,
        high,
        bias: preference(here.line, [low, high], rule),
        whose: here.whose,
        rim: [r, g, b],
        unused: 0,
    }
}

/// Decides for every tile, by the votes around it and what was decided there in the frame before.
///
/// A Gaussian that ends at [`Rules::bias_px`]; tiles of other subjects do not count, those before other walls less.
/// What was decided before counts as [`Rules::hold`] votes of each, so that a stretch that could go either way stays
/// as it was; and where a line must change, it fades, by [`Rules::fade`] of the way a frame. O(tiles with rims *
/// reach squared), parallel over rows of tiles.
pub fn vote_bias(
    window: &Window,
    rules: &Rules,
    gathered: &[TileRims],
    bounds: &[ContrastBias],
    before: &[ContrastBias],
    biases: &mut [ContrastBias],
) {
    let tiles = rules.bias_px / TILE as f32;
    let reach = (tiles.max(0.0).ceil() as u32).min(BIAS_REACH_MOST);
    let voting = Voting {
        rules,
        bounds,
        reach,
        nearness: Gaussian::new(-2.0 / (tiles * tiles).max(1.0), reach),
        gathered: Tiles::of(window, gathered, |tile| tile.whose),
        before: Tiles::of(window, before, |bias| bias.whose),
    };
    voting.gathered.make(biases, |tile| voting.bias_at(tile));
}

/// The votes of a frame, and what was decided in the frame before.
struct Voting<'a> {
    rules: &'a Rules,
    bounds: &'a [ContrastBias],
    reach: u32,
    nearness: Gaussian,
    gathered: Tiles<'a, TileRims>,
    before: Tiles<'a, ContrastBias>,
}

impl Voting<'_> {
    fn bias_at(&self, tile: [u32; 2]) -> ContrastBias {
        // Count the votes of the same lines around.
        let here = self.gathered.at(tile);
        let (mut sum, mut count) = (0.0, 0.0);
        for (number, there, square) in self.gathered.around(tile, self.reach) {
            if there.whose == here.whose {
                let alike = 1.0 - (there.behind - here.behind).abs() / (2.0 * UNLIKE);
                let weight = self.nearness.at(square) * alike.max(0.0) * there.count;
                sum += self.bounds[number].bias * weight;
                count += weight;
            }
        }
        let vote = sum / count.max(1e-6);

        // Add what was decided in the frame before.
        let (hold, fade) = (self.rules.hold, self.rules.fade);
        let decided = |held: f32| ((vote + hold * held) / DECIDED).clamp(-1.0, 1.0);
        let bound = self.bounds[self.gathered.number(tile)];
        let was = self.held(&bound, tile);
        let decided = ContrastBias {
            bias: decided(was.map_or(0.0, |was| was.bias)),
            ..bound
        };

        // Fade towards what is decided, where lines must change.
        match was {
            Some(was) if fade < 1.0 => ContrastBias {
                bias: nearer(was.bias, decided.bias, 2.0 * fade),
                ..decided.with(&was, |to, from| nearer(from, to, FADE_BOUNDS * fade))
            },
            _ => decided,
        }
    }

    /// What was decided before for the same lines before the same wall: in the tile itself, or else the mean of those
    /// that touch it, for an outline moves between frames.
    fn held(&self, here: &ContrastBias, tile: [u32; 2]) -> Option<ContrastBias> {
        let is_same = |bias: &ContrastBias| {
            let off = (bias.low + bias.high) - (here.low + here.high);
            bias.whose == here.whose && off.abs() < 2.0 * UNLIKE
        };
        let own = self.before.at(tile);
        if is_same(own) {
            return Some(*own);
        }
        let mut mean = Mean::default();
        for (_, bias, _) in self.before.around(tile, 1) {
            if is_same(bias) {
                mean.add(bias, 1.0);
            }
        }
        mean.of(here.whose)
    }
}

/// A value moved towards another by no more than a step.
fn nearer(from: f32, to: f32, step: f32) -> f32 {
    from + (to - from).clamp(-step, step)
}

/// Keeps biases for the next frame, and blends them along the outline for this one.
///
/// Where a stretch that turns brighter meets one that turns darker, the line passes from one to the other over a
/// length that the eye takes for shading. A Gaussian that ends at 6 tiles; bounds stay as they are, and tiles before
/// another wall or of other paint count less. O(tiles with rims * 169), parallel over rows of tiles.
pub fn blend_biases(
    window: &Window,
    rules: &Rules,
    biases: &[ContrastBias],
    kept: &mut [ContrastBias],
    blended: &mut [ContrastBias],
) {
    kept.copy_from_slice(biases);
    if rules.bias_px <= 0.0 {
        blended.copy_from_slice(biases);
        return;
    }
    let tiles = Tiles::of(window, biases, |bias| bias.whose);
    let falloff = -2.0 / (BLEND_TILES * BLEND_TILES) as f32;
    let nearness = Gaussian::new(falloff, BLEND_TILES);
    tiles.make(blended, |tile| blended_at(&tiles, &nearness, tile));
}

fn blended_at(
    biases: &Tiles<'_, ContrastBias>,
    nearness: &Gaussian,
    tile: [u32; 2],
) -> ContrastBias {
    // Sum the biases and the colours of the same lines around, less before other walls and of other paint.
    let here = biases.at(tile);
    let (mut bias, mut total) = (0.0, 0.0);
    let (mut rim, mut coloring) = ([0.0; 3], 0.0);
    for (_, there, square) in biases.around(tile, BLEND_TILES) {
        if there.whose == here.whose {
            let near = nearness.at(square);
            let wall = 0.5 * ((there.low + there.high) - (here.low + here.high));
            let paint =
                near * (1.0 - largest_difference(here.rim, there.rim) / UNLIKE_RIMS).max(0.0);
            let weight = paint * (1.0 - wall.abs() / UNLIKE).max(0.0);
            bias += there.bias * weight;
            total += weight;
            rim = std::array::from_fn(|i| rim[i] + there.rim[i] * paint);
            coloring += paint;
        }
    }

    // Keep the bounds, and make means of the rest.
    ContrastBias {
        bias: bias / total,
        rim: rim.map(|channel| channel / coloring),
        ..*here
    }
}

/// The bias of a pixel's rim, between the four tiles around: those of the same subject alone; `None` where there is
/// none of it.
pub(super) fn bias_between(
    biases: &[ContrastBias],
    size: [u32; 2],
    whose: u32,
    pixel: [u32; 2],
) -> Option<ContrastBias> {
    // Find the place of the pixel between the middles of tiles.
    let across = tiles_across(size);
    let down = biases.len() as u32 / across;
    let place = pixel.map(|at| (at as f32 + 0.5) / TILE as f32 - 0.5);

    // Blend the four tiles around it, as far as they hold the same lines.
    let mut mean = Mean::default();
    for i in 0..4 {
        let column = place[0].floor() + (i & 1) as f32;
        let row = place[1].floor() + (i >> 1) as f32;
        if column < 0.0 || row < 0.0 || column >= across as f32 || row >= down as f32 {
            continue;
        }
        let bias = biases[row as usize * across as usize + column as usize];
        if bias.whose == whose {
            let near = (1.0 - (place[0] - column).abs()) * (1.0 - (place[1] - row).abs());
            mean.add(&bias, near + 1e-4);
        }
    }
    mean.of(whose)
}
