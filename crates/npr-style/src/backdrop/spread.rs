//! Rims blended along the outline and carried to the pixels of its line: the twins of `backdrop.smooth_rims`,
//! `backdrop.spread_rows` and `backdrop.spread_rims`.

use super::occupied::{Gaussian, Occupied};
use super::rims::Rim;
use super::rule::{Rule, Rules};
use super::stretch::{ContrastBias, bias_between};
use npr_core::color::{largest_difference, pack_rgba8, unpack_rgba8};
use npr_core::math;
use npr_core::window::Window;
use rayon::prelude::*;

/// Greatest length over which rims are blended, in pixels.
pub const SMOOTH_MOST: u32 = 24;

/// Difference of a channel from which the colours of two rims are not blended any more.
pub const UNLIKE_COLORS: f32 = 0.2;

/// Mask of the rule's number in a texel of what lies behind.
const RULE: u32 = 0xff00_0000;

/// Blends every rim with those of the same subject around it, by a Gaussian that ends at [`Rules::smooth_px`].
///
/// Colours then change over a few pixels of outline, and do not flicker from frame to frame. Rims weigh less the more
/// their colours differ: the mean of a dark and a light wall is a wall that is not there [Tomasi and Manduchi 1998]. A
/// pixel keeps its own rule, whose weight is blended with those of the rims around. Rims of the published method stay
/// as they are. O(rims * length squared), parallel over rows.
pub fn smooth_rims(window: &Window, rules: &Rules, rims: &[Rim], smoothed: &mut [Rim]) {
    // Keep rims as they are where nothing is smoothed.
    smoothed.copy_from_slice(rims);
    if rules.smooth_px <= 0.0 {
        return;
    }

    // Blend every rim with those within the length.
    let width = window.size[0] as usize;
    let reach = (rules.smooth_px as u32).min(SMOOTH_MOST);
    let falloff = -2.0 / (rules.smooth_px * rules.smooth_px);
    let occupied = Occupied::of(rims, width, |rim| rim.subject != 0);
    let smoothing = Smoothing {
        rules,
        rims,
        width,
        reach,
        nearness: Gaussian::new(falloff, reach),
        known: occupied.each(|[x, y]| Known::of(&rims[y as usize * width + x as usize])),
        occupied,
    };
    let occupied = &smoothing.occupied;
    occupied.make(smoothed, width, |place| smoothing.rim_at(place));
}

/// Rims that are blended with each other.
struct Smoothing<'a> {
    rules: &'a Rules,
    rims: &'a [Rim],
    width: usize,
    reach: u32,
    nearness: Gaussian,
    occupied: Occupied,
    /// The values of each occupied place, in order.
    known: Vec<Known>,
}

/// The values of a rim that are blended.
struct Known {
    whose: u32,
    rule: u32,
    /// The colour of the rim with its weight in alpha, and the colour behind it.
    own: [f32; 4],
    beyond: [f32; 3],
}

impl Known {
    fn of(rim: &Rim) -> Self {
        let [r, g, b, _] = unpack_rgba8(rim.behind);
        Self {
            whose: rim.subject & Rim::WHOSE,
            rule: rim.behind & RULE,
            own: unpack_rgba8(rim.rim),
            beyond: [r, g, b],
        }
    }

    /// Likeness of what lies behind two rims: 1 for the same colour, 0 if any channel differs by [`UNLIKE_COLORS`].
    fn likeness(&self, other: &Self) -> f32 {
        let left = (1.0 - largest_difference(self.beyond, other.beyond) / UNLIKE_COLORS).max(0.0);
        left * left
    }
}

impl Smoothing<'_> {
    fn rim_at(&self, [x, y]: [u32; 2]) -> Rim {
        // Leave rims of the published method as they are.
        let rim = &self.rims[y as usize * self.width + x as usize];
        let here = Known::of(rim);
        let mut rule = here.rule;
        if self.rules.rules[(rule >> 24) as usize].method == Rule::BY_LIKENESS {
            return *rim;
        }

        // Sum both colours over the rims of the same subject, weighted by nearness and likeness.
        let (mut total, mut counted) = (0.0, 0.0);
        let (mut front, mut back) = ([0.0; 3], [0.0; 3]);
        for near in self.occupied.around([x, y], self.reach) {
            let there = &self.known[near.ordinal];
            if there.whose != here.whose {
                continue;
            }
            let nearness = self.nearness.at(near.square) * here.likeness(there);
            let weight = nearness * there.own[3];
            total += nearness;
            counted += weight;
            for i in 0..3 {
                front[i] += there.own[i] * weight;
                back[i] += there.beyond[i] * weight;
            }
            if rule == 0 {
                rule = there.rule;
            }
        }

        // Turn the sums into means; the weight of the rule is the mean of theirs.
        if counted <= 0.0 {
            return *rim;
        }
        let [front, back] = [front, back].map(|sum| sum.map(|channel| channel / counted));
        Rim {
            rim: pack_rgba8([front[0], front[1], front[2], counted / total]),
            behind: pack_rgba8([back[0], back[1], back[2], 0.0]) | rule,
            ..*rim
        }
    }
}

/// Finds for every pixel the column, counted from 1, of the nearest rim in its row within [`Rules::reach_px`]; 0 if
/// there is none.
///
/// Of two equally near ones, the left. O(pixels), parallel over rows.
pub fn spread_rows(window: &Window, rules: &Rules, rims: &[Rim], columns: &mut [u32]) {
    let width = window.size[0] as usize;
    columns
        .par_chunks_mut(width)
        .zip(rims.par_chunks(width))
        .for_each(|(columns, rims)| spread_row(rims, rules.reach_px as usize, columns));
}

fn spread_row(rims: &[Rim], reach: usize, columns: &mut [u32]) {
    columns.fill(0);
    // Pixels before this one have their rim, or none within reach.
    let mut done = 0;
    let mut last: Option<usize> = None;
    let held = |(x, rim): (usize, &Rim)| (rim.subject != 0).then_some(x);
    for x in rims.iter().enumerate().filter_map(held) {
        if let Some(left) = last {
            let end = ((left + x) / 2 + 1).min(left + reach + 1);
            columns[done..end].fill(left as u32 + 1);
            done = end;
        }
        done = done.max(x.saturating_sub(reach));
        last = Some(x);
    }
    if let Some(left) = last {
        let end = (left + reach + 1).min(columns.len());
        columns[done..end].fill(left as u32 + 1);
    }
}

/// Carries the nearest rim to every pixel: its colours, and its weight there, as two pictures of the output's size.
///
/// `fronts` holds the rim's colour with its weight in alpha. `backs` holds the number of the rule and what lies behind:
/// a colour for the published method, a [`Ground`](super::Ground) for ours. Weights fall from [`Rules::whole_px`] to
/// [`Rules::reach_px`], where lines begin that merely end at an outline. Of equally near rims, the upper one. O(pixels
/// * reach), parallel over rows.
pub fn spread_rims(
    window: &Window,
    rules: &Rules,
    rims: &[Rim],
    columns: &[u32],
    biases: &[ContrastBias],
    fronts: &mut [u32],
    backs: &mut [u32],
) {
    let width = window.size[0] as usize;
    let carrying = Carrying {
        size: window.size,
        rules,
        rims,
        columns,
        biases,
    };
    let runs = Runs::of(columns, width);
    fronts
        .par_chunks_mut(width)
        .zip(backs.par_chunks_mut(width))
        .enumerate()
        .for_each(|(y, (fronts, backs))| {
            fronts.fill(0);
            backs.fill(0);
            // Pixels beside each other mostly have the same rim.
            let mut last = (0, [0.0; 4], 0);
            for x in runs.near(y, rules.reach_px as usize) {
                let (front, back) = (&mut fronts[x], &mut backs[x]);
                let (found, square) = carrying.nearest([x as u32, y as u32]);
                if found == 0 {
                    continue;
                }
                if found != last.0 {
                    let (color, behind) = carrying.sides(found);
                    last = (found, color, behind);
                }
                let (_, [r, g, b, weight], behind) = last;
                let distance = (square as f32).sqrt();
                let reach = rules.reach_px as f32;
                let kept = 1.0 - math::smoothstep(rules.whole_px, reach, distance);
                (*front, *back) = (pack_rgba8([r, g, b, weight * kept]), behind);
            }
        });
}

/// Pixels of a row that are checked together for any rim.
const RUN: usize = 32;

/// The runs of a picture's rows that hold rims.
struct Runs {
    width: usize,
    rows: Vec<Vec<bool>>,
}

impl Runs {
    fn of(columns: &[u32], width: usize) -> Self {
        let any = |run: &[u32]| run.iter().fold(0, |all, column| all | column) != 0;
        let rows = columns.par_chunks(width);
        Self {
            width,
            rows: rows.map(|row| row.chunks(RUN).map(any).collect()).collect(),
        }
    }

    /// The pixels of row `y` in all runs that hold a rim in some row up to `reach` away.
    fn near(&self, y: usize, reach: usize) -> impl Iterator<Item = usize> {
        let rows = &self.rows[y.saturating_sub(reach)..(y + reach + 1).min(self.rows.len())];
        let runs = 0..self.width.div_ceil(RUN);
        let near = runs.filter(move |run| rows.iter().any(|row| row[*run]));
        near.flat_map(|run| run * RUN..((run + 1) * RUN).min(self.width))
    }
}

/// The rims of a frame, on their way to the pixels around them.
struct Carrying<'a> {
    size: [u32; 2],
    rules: &'a Rules,
    rims: &'a [Rim],
    columns: &'a [u32],
    biases: &'a [ContrastBias],
}

impl Carrying<'_> {
    /// The number of the rim nearest to a pixel, counted from 1, and its squared distance; 0 if there is none.
    fn nearest(&self, [x, y]: [u32; 2]) -> (u32, u32) {
        let reach = self.rules.reach_px;
        let low = y.saturating_sub(reach);
        let high = (y + reach).min(self.size[1] - 1);
        let (mut nearest, mut found) = (reach * reach + 1, 0);
        for row in low..=high {
            let column = self.columns[(row * self.size[0] + x) as usize];
            if column == 0 {
                continue;
            }
            let (dx, dy) = (x.abs_diff(column - 1), y.abs_diff(row));
            let square = dx * dx + dy * dy;
            if square < nearest {
                (nearest, found) = (square, row * self.size[0] + column);
            }
        }
        (found, nearest)
    }

    /// The colour of a rim with its weight, and the texel of what lies behind it.
    fn sides(&self, number: u32) -> ([f32; 4], u32) {
        let rim = &self.rims[(number - 1) as usize];
        let color = unpack_rgba8(rim.rim);
        let rule = rim.behind >> 24;
        let ruling = &self.rules.rules[rule as usize];
        if ruling.method != Rule::BY_CONTRAST {
            return (color, rim.behind);
        }
        let pixel = [(number - 1) % self.size[0], (number - 1) / self.size[0]];
        let Some(bias) = bias_between(self.biases, self.size, rim.subject & Rim::WHOSE, pixel)
        else {
            return (color, 0);
        };
        let [r, g, b] = match ruling.rim_factor > 0.0 {
            true => bias.rim,
            false => [color[0], color[1], color[2]],
        };
        ([r, g, b, color[3]], bias.ground().packed(rule))
    }
}
