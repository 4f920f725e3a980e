//! Loops cut to strokes: the twins of `vector.cull_sides`, `vector.vote_sides`, `vector.start_strips`,
//! `vector.rank_strips`, `vector.measure_strips` and `vector.drop_short`.
//!
//! A strip is a run of kept sides along a loop, which may pass the place where the loop's list starts. A loop that is
//! kept whole is one closed strip.

use super::looped::Spot;
use super::planar::Planar;
use crate::rank::scan::{compact, exclusive_scan};
use bytemuck::{Pod, Zeroable};
use npr_core::geometry::NONE;
use npr_core::gpu_layout;
use npr_core::published_path::PublishedPath;
use rayon::prelude::*;

/// Which sides make strokes.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct CullRule {
    /// Cosine of the angle between a loop and the contour that it goes round, above which a side is kept.
    pub least_cos: f32,
    /// Number of sides on either side that vote.
    pub vote_radius: u32,
    /// Number of votes by which a side has to win.
    pub vote_margin: u32,
    /// Most sides of a strip that is dropped.
    pub short: u32,
}
gpu_layout!(CullRule {
    least_cos,
    vote_radius,
    vote_margin,
    short
});

impl CullRule {
    /// The rule of a path.
    pub fn of(path: &PublishedPath) -> Self {
        Self {
            least_cos: path.least_cos,
            vote_radius: path.vote_radius,
            vote_margin: path.vote_margin,
            short: path.short,
        }
    }
}

/// Keeps the sides at which a loop runs in the direction of the contour, if they were kept before.
///
/// A line one pixel wide has a loop around it, there and back; this keeps one of the two ways.
pub fn cull_sides(
    rule: &CullRule,
    tangents: &[Planar],
    directions: &[Planar],
    kept_in: &[u32],
    kept_out: &mut [u32],
) {
    let inputs = tangents.par_iter().zip(directions).zip(kept_in);
    let elements = kept_out.par_iter_mut().with_min_len(1024).zip(inputs);
    elements.for_each(|(kept, ((tangent, direction), was))| {
        *kept = u32::from(*was != 0 && tangent.dot(*direction) > rule.least_cos);
    });
}

/// Lets the sides around each vote on it: it is kept where kept ones win by the rule's margin.
pub fn vote_sides(rule: &CullRule, spots: &[Spot], kept_in: &[u32], kept_out: &mut [u32]) {
    let outputs = kept_out.par_iter_mut().with_min_len(256).enumerate();
    outputs.for_each(|(element, kept)| {
        let spot = spots[element];
        let mut at = spot.back(element as u32, rule.vote_radius);
        let voters = 2 * rule.vote_radius + 1;
        let mut votes = 0;
        for _ in 0..voters {
            votes += u32::from(kept_in[at as usize] != 0);
            at = spot.after(at);
        }
        *kept = u32::from(2 * votes >= voters + rule.vote_margin);
    });
}

/// Marks the first side of every strip with 1, others with 0; closed strips get their first side from [`rank_strips`].
pub fn start_strips(spots: &[Spot], kept: &[u32], flags: &mut [u32]) {
    let outputs = flags.par_iter_mut().with_min_len(1024).enumerate();
    outputs.for_each(|(element, flag)| {
        let before = spots[element].before(element as u32);
        *flag = u32::from(kept[element] != 0 && kept[before as usize] == 0);
    });
}

/// The place of a side in its strip.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct StripSpot {
    /// First side of the strip; [`NONE`] for a side in no strip.
    pub start: u32,
    /// Sides before it.
    pub rank: u32,
}
gpu_layout!(StripSpot { start, rank });

/// Ranks the sides of all strips: a segmented scan on circular lists.
///
/// `slots` is the scan of the `flags` of first sides, and `firsts` lists these. A side belongs to the last strip that
/// starts before it in its loop; if none does, to the last strip of the loop, which runs on past the start of the
/// loop's list; and if the loop has no first side, all of it is one strip.
pub fn rank_strips(
    spots: &[Spot],
    kept: &[u32],
    flags: &[u32],
    slots: &[u32],
    firsts: &[u32],
    strips: &mut [StripSpot],
) {
    // Find where the last strip up to a side starts.
    let last_start = |element: u32| {
        let started = slots[element as usize] + flags[element as usize];
        if started == 0 {
            NONE
        } else {
            firsts[started as usize - 1]
        }
    };
    let outputs = strips.par_iter_mut().with_min_len(1024).enumerate();
    outputs.for_each(|(element, strip)| {
        let spot = spots[element];
        let element = element as u32;
        strip.start = NONE;
        strip.rank = 0;
        if kept[element as usize] != 0 {
            // Go back around the loop where none has started in it yet.
            let is_in_loop = |start: u32| start != NONE && start >= spot.start;
            let mut start = last_start(element);
            if !is_in_loop(start) {
                start = last_start(spot.start + spot.length - 1);
            }
            if !is_in_loop(start) {
                start = spot.start;
            }

            // Count from there.
            strip.start = start;
            strip.rank = if element >= start {
                element - start
            } else {
                element + spot.length - start
            };
        }
    });
}

/// Writes the number of sides of every strip at its first side; other entries keep their values.
pub fn measure_strips(spots: &[Spot], kept: &[u32], strips: &[StripSpot], lengths: &mut [u32]) {
    for (element, strip) in (0..).zip(strips) {
        if strip.start == NONE {
            continue;
        }
        let spot = spots[element as usize];
        let after = spot.after(element);
        // Around a loop that is one strip, the first comes after the last.
        if kept[after as usize] == 0 || after == strip.start {
            lengths[strip.start as usize] = strip.rank + 1;
        }
    }
}

/// Drops the sides of strips that are too short to be strokes.
pub fn drop_short(rule: &CullRule, strips: &[StripSpot], lengths: &[u32], kept: &mut [u32]) {
    let outputs = kept.par_iter_mut().with_min_len(1024).zip(strips);
    outputs.for_each(|(kept, strip)| {
        *kept = u32::from(strip.start != NONE && lengths[strip.start as usize] > rule.short);
    });
}

/// All strips of loops.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Strips {
    /// The place of each side in its strip.
    pub spots: Vec<StripSpot>,
    /// Number of sides of the strip that starts at each side; 0 elsewhere.
    pub lengths: Vec<u32>,
}

/// Cuts loops into the strips of kept sides. O(sides).
pub fn strips(spots: &[Spot], kept: &[u32]) -> Strips {
    let mut flags = vec![0; spots.len()];
    start_strips(spots, kept, &mut flags);
    let (slots, count) = exclusive_scan(&flags);
    let mut firsts = vec![0; count as usize];
    compact(&flags, &slots, &mut firsts);
    let mut found = Strips {
        spots: vec![StripSpot::default(); spots.len()],
        lengths: vec![0; spots.len()],
    };
    rank_strips(spots, kept, &flags, &slots, &firsts, &mut found.spots);
    measure_strips(spots, kept, &found.spots, &mut found.lengths);
    found
}
