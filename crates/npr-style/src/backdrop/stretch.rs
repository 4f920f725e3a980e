//! Stretches of outline, whose lines move together: the twins of `backdrop.bound_tiles`, `backdrop.vote_bias` and
//! `backdrop.blend_biases`.
//!
//! Where line and background are nearly alike, grain alone would decide at every pixel whether a line turns brighter or
//! darker, and the line would repeat every brick behind it. Here a line reads before all that lies behind its stretch:
//! the bounds of that change slowly along the outline, and the stretch votes on the direction.

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

/// Tiles in each direction that an envelope takes in.
const ENVELOPE_TILES: u32 = 4;

/// Tiles around a tile up to which its bounds hold in full, since colours are blended between tiles.
const WHOLE_TILES: f32 = 1.0;

/// How far an envelope falls from tile to tile, on a scale of 0 black to 1 white: less than the eye follows.
const SLOPE: f32 = 0.08;

/// How fast the bounds of another wall lose weight, as a multiple of how much more it differs.
const UNLIKE_SLOPE: f32 = 4.0;

/// How far bounds may move, on that scale, in the time in which a line fades from darker to brighter.
const FADE_BOUNDS: f32 = 0.4;

/// Tiles in each direction over which decisions are blended.
const BLEND_TILES: u32 = 6;

/// Tiles around one that affect its colour, apart from those that vote.
pub(super) const STRETCH_TILES: u32 = ENVELOPE_TILES + BLEND_TILES;

/// Difference of a channel from which rims count as two paints, not as one with a texture.
const UNLIKE_RIMS: f32 = 0.5;

/// Magnitude of the mean vote from which a stretch is decided.
const DECIDED: f32 = 0.01;

/// The grounds that the lines of a tile must read before, and the direction in which they move.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct ContrastBias {
    /// The darkest place that lies behind the stretch.
    pub low: f32,
    /// The brightest place that lies behind it.
    pub high: f32,
    /// Direction, from -1 darker to 1 brighter.
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
    /// The ground behind the lines of the stretch, with the share of the brighter candidate.
    pub(super) fn ground(&self) -> Ground {
        Ground {
            low: self.low,
            high: self.high,
            brighter: Some(0.5 + 0.5 * self.bias),
        }
    }

    /// Combines each number of this bias with that of another one.
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

/// Weighted sums of biases, from which a mean is made.
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

    /// The mean bias; `None` if nothing was added.
    fn of(&self, whose: u32) -> Option<ContrastBias> {
        let mean = self.sum.with(&self.sum, |sum, _| sum / self.weight);
        (self.weight > 0.0).then_some(ContrastBias { whose, ..mean })
    }
}

/// Gives every tile the bounds of what lies behind its lines, and its own vote as the bias.
///
/// Bounds are envelopes over 4 tiles each way, which fall with the distance, so a line that follows them changes
/// slowly. Another wall, 0.42 darker or brighter, does not count. O(tiles with rims * 81), parallel over rows of tiles.
pub fn bound_tiles(
    window: &Window,
    rules: &Rules,
    gathered: &[TileRims],
    bounds: &mut [ContrastBias],
) {
    let tiles = Tiles::of(window, gathered, |tile| tile.whose);
    tiles.make(bounds, |tile| bound_at(rules, &tiles, tile));
}

/// A grid of tiles, of which only those with rims are visited.
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

    /// The tiles with rims up to `reach` tiles around one, itself included, row by row: index, content, and squared
    /// distance in tiles.
    fn around(&self, tile: [u32; 2], reach: u32) -> impl Iterator<Item = (usize, &'a T, u32)> {
        let near = self.occupied.around(tile, reach);
        near.map(|near| (self.number(near.place), self.at(near.place), near.square))
    }

    /// Computes a value for every tile with rims; all others become empty.
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

    // Vote for the direction in which the lines of this tile should move.
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

/// Decides the direction of every tile by the votes around it and its decision in the previous frame.
///
/// Votes are weighted by a Gaussian that ends at [`Rules::bias_px`]; tiles of other subjects do not count, those before
/// other walls count less. The previous decision weighs [`Rules::hold`] times a full vote, so a stretch that could go
/// either way stays as it was; a line that must change fades, by [`Rules::fade`] of the way a frame. O(tiles with rims
/// * reach squared), parallel over rows of tiles.
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

/// The votes of a frame, and the decisions of the previous one.
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
        // Count the votes of the same lines nearby.
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

        // Add the decision of the previous frame.
        let (hold, fade) = (self.rules.hold, self.rules.fade);
        let decided = |held: f32| ((vote + hold * held) / DECIDED).clamp(-1.0, 1.0);
        let bound = self.bounds[self.gathered.number(tile)];
        let was = self.held(&bound, tile);
        let decided = ContrastBias {
            bias: decided(was.map_or(0.0, |was| was.bias)),
            ..bound
        };

        // Fade towards the new decision if lines must change.
        match was {
            Some(was) if fade < 1.0 => ContrastBias {
                bias: nearer(was.bias, decided.bias, 2.0 * fade),
                ..decided.with(&was, |to, from| nearer(from, to, FADE_BOUNDS * fade))
            },
            _ => decided,
        }
    }

    /// The previous decision for the same lines before the same wall: that of the tile itself, or else the mean of the
    /// tiles that touch it, since an outline moves between frames.
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

/// A value moved towards another one by at most a step.
fn nearer(from: f32, to: f32, step: f32) -> f32 {
    from + (to - from).clamp(-step, step)
}

/// Keeps the biases for the next frame, and blends them along the outline for this one.
///
/// Where a stretch that turns brighter meets one that turns darker, the line passes from one to the other over a length
/// that the eye takes for shading. Weights are a Gaussian that ends at 6 tiles; bounds stay as they are, and tiles
/// before another wall or of another paint count less. O(tiles with rims * 169), parallel over rows of tiles.
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
    // Sum the biases and colours of the same lines nearby; other walls and other paints count less.
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

    // Keep the bounds, and take the mean of the rest.
    ContrastBias {
        bias: bias / total,
        rim: rim.map(|channel| channel / coloring),
        ..*here
    }
}

/// The bias at a pixel's rim, blended between the four tiles around it that hold the same subject; `None` if none does.
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
