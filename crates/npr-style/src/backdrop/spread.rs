//! What rims say, blended along the outline and carried to the pixels of its line: the twins of `backdrop.smooth_rims`,
//! `backdrop.spread_rows` and `backdrop.spread_rims`.

use super::adapt::Ground;
use super::rims::Rim;
use super::rule::{Rule, Rules};
use super::stretch::{Lean, lean_between};
use npr_core::color::{largest_difference, pack_rgba8, unpack_rgba8};
use npr_core::math;
use npr_core::window::Window;
use rayon::prelude::*;

/// Longest length over which rims are blended, in pixels.
pub const SMOOTH_MOST: u32 = 24;

/// Difference of a channel from which what two places see is not blended any more.
pub const UNLIKE_COLORS: f32 = 0.2;

/// Blends every rim with those of the same subject around it, by a Gaussian that ends at [`Rules::smooth_px`].
///
/// Colours then change over a few pixels of outline, and do not flicker from frame to frame. Rims weigh less the more their colours
/// differ: the mean of a dark and a light wall is a wall that is not there [Tomasi and Manduchi 1998]. The rule is the pixel's own; where
/// rims of another count for less, so does this one. Rims of the published method stay as they are. O(rims * length squared),
/// parallel over rows.
pub fn smooth_rims(window: &Window, rules: &Rules, rims: &[Rim], smoothed: &mut [Rim]) {
    let width = window.size[0] as usize;
    smoothed
        .par_chunks_mut(width)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, out) in row.iter_mut().enumerate() {
                let rim = rims[y * width + x];
                *out = rim;
                let method = rules.rules[(rim.behind >> 24) as usize].method;
                if rim.subject != 0 && method != Rule::BY_LIKENESS && rules.smooth_px > 0.0 {
                    *out = smoothed_rim(window.size, rules, rims, [x as u32, y as u32]);
                }
            }
        });
}

fn smoothed_rim(size: [u32; 2], rules: &Rules, rims: &[Rim], [x, y]: [u32; 2]) -> Rim {
    let here = rims[(y * size[0] + x) as usize];
    let reach = (rules.smooth_px as u32).min(SMOOTH_MOST);
    let low = [x.saturating_sub(reach), y.saturating_sub(reach)];
    let high = [(x + reach).min(size[0] - 1), (y + reach).min(size[1] - 1)];
    let falloff = -2.0 / (rules.smooth_px * rules.smooth_px);
    let (mut total, mut counted) = (0.0, 0.0);
    let (mut front, mut back) = ([0.0; 3], [0.0; 3]);
    let mut rule = here.behind & 0xff00_0000;
    for row in low[1]..=high[1] {
        for column in low[0]..=high[0] {
            let rim = rims[(row * size[0] + column) as usize];
            if rim.subject & Rim::WHOSE != here.subject & Rim::WHOSE {
                continue;
            }
            let off = [column as f32 - x as f32, row as f32 - y as f32];
            let near = math::exp((off[0] * off[0] + off[1] * off[1]) * falloff);
            let (own, beyond) = (unpack_rgba8(rim.rim), unpack_rgba8(rim.behind));
            let near = near * likeness(&here, &rim);
            let weight = near * own[3];
            total += near;
            counted += weight;
            for i in 0..3 {
                front[i] += own[i] * weight;
                back[i] += beyond[i] * weight;
            }
            if rule == 0 {
                rule = rim.behind & 0xff00_0000;
            }
        }
    }
    if counted <= 0.0 {
        return here;
    }
    let [front, back] = [front, back].map(|sum| sum.map(|channel| channel / counted));
    Rim {
        rim: pack_rgba8([front[0], front[1], front[2], counted / total]),
        behind: pack_rgba8([back[0], back[1], back[2], 0.0]) | rule,
        ..here
    }
}

/// 1 for rims before the same colour, down to 0 where any channel differs by [`UNLIKE_COLORS`].
fn likeness(a: &Rim, b: &Rim) -> f32 {
    let [a, b] = [a, b].map(|rim| {
        let [r, g, b, _] = unpack_rgba8(rim.behind);
        [r, g, b]
    });
    let left = (1.0 - largest_difference(a, b) / UNLIKE_COLORS).max(0.0);
    left * left
}

/// For every pixel the column of the nearest rim in its row, counted from 1, within [`Rules::reach_px`]; 0 where there is none.
///
/// Of two as near, the left one. O(pixels * reach), parallel over rows.
pub fn spread_rows(window: &Window, rules: &Rules, rims: &[Rim], columns: &mut [u32]) {
    let width = window.size[0] as usize;
    columns
        .par_chunks_mut(width)
        .zip(rims.par_chunks(width))
        .for_each(|(columns, rims)| {
            for (x, column) in columns.iter_mut().enumerate() {
                *column = nearest_column(rims, x as u32, rules.reach_px);
            }
        });
}

fn nearest_column(rims: &[Rim], x: u32, reach: u32) -> u32 {
    let width = rims.len() as u32;
    for off in 0..=reach {
        if x >= off && rims[(x - off) as usize].subject != 0 {
            return x - off + 1;
        }
        if x + off < width && rims[(x + off) as usize].subject != 0 {
            return x + off + 1;
        }
    }
    0
}

/// Carries the nearest rim to every pixel: its colours, and how much it counts there, as two pictures of the output's size.
///
/// `fronts` holds the rim's colour with its weight in alpha, `backs` what lies behind: for the published method its colour, for ours a
/// [`Ground`]; with the number of the rule. Weights fall
/// from [`Rules::whole_px`] to [`Rules::reach_px`], where lines that merely end at an outline begin. Of rims as near, the upper
/// one. O(pixels * reach), parallel over rows.
pub fn spread_rims(
    window: &Window,
    rules: &Rules,
    rims: &[Rim],
    columns: &[u32],
    leans: &[Lean],
    fronts: &mut [u32],
    backs: &mut [u32],
) {
    let width = window.size[0] as usize;
    fronts
        .par_chunks_mut(width)
        .zip(backs.par_chunks_mut(width))
        .enumerate()
        .for_each(|(y, (fronts, backs))| {
            for (x, (front, back)) in fronts.iter_mut().zip(backs).enumerate() {
                let place = [x as u32, y as u32];
                (*front, *back) = spread_at(window.size, rules, rims, columns, leans, place);
            }
        });
}

fn spread_at(
    size: [u32; 2],
    rules: &Rules,
    rims: &[Rim],
    columns: &[u32],
    leans: &[Lean],
    [x, y]: [u32; 2],
) -> (u32, u32) {
    let low = y.saturating_sub(rules.reach_px);
    let high = (y + rules.reach_px).min(size[1] - 1);
    let (mut nearest, mut found) = (rules.reach_px * rules.reach_px + 1, 0);
    for row in low..=high {
        let column = columns[(row * size[0] + x) as usize];
        if column == 0 {
            continue;
        }
        let (dx, dy) = (x.abs_diff(column - 1), y.abs_diff(row));
        let square = dx * dx + dy * dy;
        if square < nearest {
            (nearest, found) = (square, row * size[0] + column);
        }
    }
    if found == 0 {
        return (0, 0);
    }
    let rim = rims[(found - 1) as usize];
    let [r, g, b, weight] = unpack_rgba8(rim.rim);
    let distance = (nearest as f32).sqrt();
    let kept = 1.0 - math::smoothstep(rules.whole_px, rules.reach_px as f32, distance);
    let (column, row) = ((found - 1) % size[0], (found - 1) / size[0]);
    let whose = rim.subject & Rim::WHOSE;
    let rule = rim.behind >> 24;
    let front = |[r, g, b]: [f32; 3]| pack_rgba8([r, g, b, weight * kept]);
    let ruling = &rules.rules[rule as usize];
    if ruling.method != Rule::BY_CONTRAST {
        return (front([r, g, b]), rim.behind);
    }
    let Some(lean) = lean_between(leans, size, whose, [column, row]) else {
        return (front([r, g, b]), 0);
    };
    let edge = match ruling.rim_factor > 0.0 {
        true => lean.rim,
        false => [r, g, b],
    };
    (front(edge), Ground::of_lean(&lean).packed(rule))
}
