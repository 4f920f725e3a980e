//! Which remembered sample a place of a stroke is, and what all places of a stroke say together.

use super::remembered::{Known, Place, REACH_PX, sampled};
use crate::mesh_lines::run::distance;
use crate::stroke::Stroke;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Least cosine between the directions of both, whichever way they run.
const LEAST_COS: f64 = 0.7;

/// How much nearer a sample of another kind has to be, of one that was hidden where this is seen, and of one that was
/// not there in the frame before, for each frame; in pixels.
const OTHER_KIND_PX: f64 = 0.4;
const OTHER_SIGHT_PX: f64 = 1.5;
const OLDER_PX: f64 = 0.5;

/// Least number of places that are worth a thread of their own.
pub(super) const LEAST_SHARED: usize = 256;

/// A place of a stroke that was there before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vote {
    /// Number of the remembered sample, and its line.
    pub sample: u32,
    pub line: u32,
    /// Texture coordinate of the remembered line here, in pixels.
    pub u: f64,
    /// Whether that line runs the same way.
    pub is_along: bool,
    /// Whether its texture runs the way of the stroke.
    pub is_texture_along: bool,
}

/// What the places of a stroke say together.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Tally {
    pub sample_count: usize,
    pub vote_count: usize,
    /// Whether most of them ran the other way.
    pub is_reversed: bool,
    /// Lines that they were on, those with most of them first, with their counts.
    pub lines: Vec<(usize, u32)>,
    /// The places of the stroke as it was found, and the vote of each.
    pub votes: PlacesAndVotes,
}

/// Places along a stroke, and the vote of each; none where nothing was there.
pub(super) type PlacesAndVotes = (Vec<Place>, Vec<Option<Vote>>);

impl Tally {
    /// The line that most of the stroke was part of.
    pub fn main_line(&self) -> Option<u32> {
        self.lines.first().map(|(_, line)| *line)
    }

    /// How many samples were on the lines of each identity.
    pub fn counts(&self, id_of: impl Fn(usize) -> u64) -> BTreeMap<u64, usize> {
        let mut counts: BTreeMap<u64, usize> = BTreeMap::new();
        for (count, line) in &self.lines {
            *counts.entry(id_of(*line as usize)).or_default() += count;
        }
        counts
    }
}

/// Places along a stroke, and the vote of each.
pub(super) fn votes_of(known: &Known, stroke: &Stroke) -> PlacesAndVotes {
    let places = sampled(stroke);
    let is_hidden = !stroke.is_visible();
    let vote = |place: &Place| {
        // Take the sample that fits best; of two as good, the one with the lower number.
        let mut best: Option<(f64, u32, Vote)> = None;
        for (sample, seen) in known.around(place.position) {
            let cos = seen.along[0] * place.along[0] + seen.along[1] * place.along[1];
            let away = distance(seen.position, place.position);
            if cos.abs() < LEAST_COS || away > REACH_PX {
                continue;
            }
            let line = known.line(seen.line);
            let cost = away
                + OTHER_KIND_PX * f64::from(u8::from(line.kind != stroke.kind))
                + OTHER_SIGHT_PX * f64::from(u8::from(line.is_hidden != is_hidden))
                + OLDER_PX * f64::from(line.age);
            if best.is_none_or(|(least, other, _)| (cost, sample) < (least, other)) {
                let step = [0, 1].map(|i| place.position[i] - seen.position[i]);
                let ahead = step[0] * seen.along[0] + step[1] * seen.along[1];
                let vote = Vote {
                    sample,
                    line: seen.line,
                    u: seen.u + if seen.is_along { ahead } else { -ahead },
                    is_along: cos > 0.0,
                    is_texture_along: (cos > 0.0) == seen.is_along,
                };
                best = Some((cost, sample, vote));
            }
        }
        best.map(|(_, _, vote)| vote)
    };
    let shared = places.par_iter().with_min_len(LEAST_SHARED);
    let votes = shared.map(vote).collect();
    (places, votes)
}

/// What a stroke was, before it is turned as it was.
pub(super) fn tally(known: &Known, stroke: &Stroke) -> Tally {
    let (places, votes) = votes_of(known, stroke);
    let mut lines: BTreeMap<u32, usize> = BTreeMap::new();
    let (mut vote_count, mut along_count) = (0, 0);
    for vote in votes.iter().flatten() {
        *lines.entry(vote.line).or_default() += 1;
        vote_count += 1;
        along_count += usize::from(vote.is_along);
    }
    let mut lines: Vec<(usize, u32)> = lines
        .into_iter()
        .map(|(line, count)| (count, line))
        .collect();
    lines.sort_by_key(|(count, line)| (std::cmp::Reverse(*count), *line));
    Tally {
        sample_count: places.len(),
        vote_count,
        is_reversed: 2 * along_count < vote_count,
        lines,
        votes: (places, votes),
    }
}
