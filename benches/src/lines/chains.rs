//! Joining candidates into lines, and cutting those where they go out of sight.

use std::collections::BTreeMap;

use glam::DVec3;
use npr_vector::stroke::Kind;

use super::candidates::{Candidate, Seen};
use super::ink::distance;
use super::layers::Layer;
use super::reference::{Sample, Sight};
use super::soup::{Soup, SoupEdge};

/// Where more than two lines meet, a pair goes on as one when it turns by less than this cosine tells: 45 degrees.
const GOES_ON: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A line that is lost for no longer than this, in pixels, goes on.
const JOINED_PX: f64 = 3.0;

/// No candidate.
const NONE: u32 = u32::MAX;

/// A visible run of one line, from where it appears to where it is lost.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// What it is, and what it lies on.
    pub layer: Layer,
    /// It runs on from its end to its start.
    pub closed: bool,
    /// In pixels.
    pub points: Vec<[f64; 2]>,
    /// In pixels.
    pub length: f64,
}

/// Candidates in the order of a walk, each with whether it is walked from head to tail.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chain {
    pub(crate) links: Vec<(u32, bool)>,
    pub(crate) closed: bool,
}

/// Joins candidates: contours around the faces that face the eye, all others where they meet at a vertex.
pub(crate) fn chain(
    soup: &Soup,
    edges: &[SoupEdge],
    seen: &Seen,
    lines: &[Candidate],
) -> Vec<Chain> {
    let successors = contour_successors(soup, edges, seen, lines);
    let mut joints = Joints::new(lines.len());
    for (line, next) in successors.iter().enumerate() {
        if *next != NONE {
            joints.join((line as u32, false), (*next, true));
        }
    }
    join_at_vertices(soup, lines, &mut joints);
    joints.chains()
}

/// Of every contour of a loop, the one after it.
///
/// From the head of a contour the walk turns through the fan of front faces until the next edge with a back face
/// behind it.
fn contour_successors(
    soup: &Soup,
    edges: &[SoupEdge],
    seen: &Seen,
    lines: &[Candidate],
) -> Vec<u32> {
    let count = 3 * soup.faces.len();
    let mut twins = vec![NONE; count];
    for edge in edges {
        if let [a, b] = edge.sides[..]
            && soup.wound_alike([a, b])
        {
            twins[a as usize] = b;
            twins[b as usize] = a;
        }
    }
    let mut line_of = vec![NONE; count];
    for (number, line) in lines.iter().enumerate() {
        if let Some(half_edge) = line.half_edge {
            line_of[half_edge as usize] = number as u32;
        }
    }
    let successor = |line: &Candidate| {
        let mut turning = following(line.half_edge?);
        // A fan has no more faces than there are.
        for _ in 0..count {
            if line_of[turning as usize] != NONE {
                return Some(line_of[turning as usize]);
            }
            let twin = twins[turning as usize];
            if twin == NONE || !seen.is_front(twin) {
                return None;
            }
            turning = following(twin);
        }
        None
    };
    lines
        .iter()
        .map(|line| successor(line).unwrap_or(NONE))
        .collect()
}

/// The half-edge that follows in the same face.
fn following(half_edge: u32) -> u32 {
    half_edge - half_edge % 3 + (half_edge + 1) % 3
}

/// Joins candidates outside of contour loops: at every vertex those of one kind, two as they are, of more the
/// straightest pairs.
fn join_at_vertices(soup: &Soup, lines: &[Candidate], joints: &mut Joints) {
    // Gather the ends of lines by kind and vertex.
    let mut meetings: BTreeMap<(Kind, u32), Vec<(u32, bool)>> = BTreeMap::new();
    for (number, line) in lines
        .iter()
        .enumerate()
        .filter(|(_, line)| line.half_edge.is_none())
    {
        for (end, at_tail) in [(line.ends[0], true), (line.ends[1], false)] {
            meetings
                .entry((line.kind, end))
                .or_default()
                .push((number as u32, at_tail));
        }
    }

    // Join the only two, or the straightest pairs.
    for ((_, vertex), ends) in meetings {
        if let [a, b] = ends[..] {
            joints.join(a, b);
            continue;
        }
        let direction = |(line, at_tail): (u32, bool)| {
            let other = lines[line as usize].ends[usize::from(at_tail)];
            (soup.positions[other as usize] - soup.positions[vertex as usize]).normalize_or_zero()
        };
        let directions: Vec<DVec3> = ends.iter().copied().map(direction).collect();
        joints.join_straightest(&ends, |a, b| -directions[a].dot(directions[b]));
    }
}

/// Which end of a candidate goes on in which end of another.
pub(crate) struct Joints {
    /// Of tail and head of every candidate: the candidate that follows there, and whether with its tail.
    next: Vec<[Option<(u32, bool)>; 2]>,
}

impl Joints {
    pub(crate) fn new(count: usize) -> Self {
        Self {
            next: vec![[None; 2]; count],
        }
    }

    /// Joins two ends, each a candidate and whether its tail is meant.
    fn join(&mut self, a: (u32, bool), b: (u32, bool)) {
        *self.end(a) = Some(b);
        *self.end(b) = Some(a);
    }

    /// Joins the ends that meet in one place in pairs, the straightest first, as far as they go on as one.
    ///
    /// `straight` is the cosine of how far a line through two of them turns, by their places in the list.
    pub(crate) fn join_straightest(
        &mut self,
        ends: &[(u32, bool)],
        straight: impl Fn(usize, usize) -> f64,
    ) {
        let mut pairs = Vec::new();
        for a in 0..ends.len() {
            for b in a + 1..ends.len() {
                let cosine = straight(a, b);
                if cosine > GOES_ON {
                    pairs.push((cosine, ends[a], ends[b]));
                }
            }
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (_, a, b) in pairs {
            self.join_if_free(a, b);
        }
    }

    /// Joins two ends unless one of them goes on already.
    pub(crate) fn join_if_free(&mut self, a: (u32, bool), b: (u32, bool)) {
        if self.end(a).is_none() && self.end(b).is_none() {
            self.join(a, b);
        }
    }

    fn end(&mut self, (line, at_tail): (u32, bool)) -> &mut Option<(u32, bool)> {
        &mut self.next[line as usize][usize::from(!at_tail)]
    }

    /// Walks from every free end, then around what is left.
    pub(crate) fn chains(self) -> Vec<Chain> {
        let mut walked = vec![false; self.next.len()];
        let mut chains = Vec::new();
        for open in [true, false] {
            for line in 0..self.next.len() as u32 {
                let [at_tail, at_head] = self.next[line as usize];
                let starts = !open || at_tail.is_none() || at_head.is_none();
                if !walked[line as usize] && starts {
                    let backwards = open && at_tail.is_some();
                    let links = self.walk((line, backwards), &mut walked);
                    chains.push(Chain {
                        links,
                        closed: !open,
                    });
                }
            }
        }
        chains
    }

    fn walk(&self, start: (u32, bool), walked: &mut [bool]) -> Vec<(u32, bool)> {
        let mut links = Vec::new();
        let mut here = Some(start);
        while let Some((line, backwards)) = here {
            if std::mem::replace(&mut walked[line as usize], true) {
                break;
            }
            links.push((line, backwards));
            let leaving = self.next[line as usize][usize::from(!backwards)];
            here = leaving.map(|(next, at_tail)| (next, !at_tail));
        }
        links
    }
}

/// The visible runs of every chain, in order; runs of pieces that only may be drawn are left out.
pub(crate) fn runs(
    chains: &[Chain],
    lines: &[Candidate],
    samples: &[Vec<Sample>],
) -> Vec<Vec<Run>> {
    chains
        .iter()
        .map(|chain| {
            // Walk along the chain in its direction.
            let walk = chain
                .links
                .iter()
                .flat_map(|(line, backwards)| walked(&samples[*line as usize], *backwards));

            // Cut it where it is hidden.
            let first = &lines[chain.links[0].0 as usize];
            let layer = Layer {
                kind: first.kind,
                object: first.object,
            };
            cut(layer, chain.closed, walk.collect())
        })
        .collect()
}

/// The pieces of a candidate in the order of a walk.
fn walked(samples: &[Sample], backwards: bool) -> Vec<Sample> {
    if !backwards {
        return samples.to_vec();
    }
    let turned = |sample: &Sample| Sample {
        ends: [sample.ends[1], sample.ends[0]],
        ..*sample
    };
    samples.iter().rev().map(turned).collect()
}

/// Cuts a walk where it is hidden.
pub(crate) fn cut(layer: Layer, closed: bool, mut walk: Vec<Sample>) -> Vec<Run> {
    let hidden = |sample: &Sample| sample.sight == Sight::Hidden;
    let gap = walk.iter().position(hidden);
    // A loop is cut at its first gap, so that the piece over its seam stays whole.
    if closed {
        walk.rotate_left(gap.unwrap_or(0));
    }
    walk.split(hidden)
        .filter(|run| run.iter().any(|sample| sample.sight == Sight::Visible))
        .map(|run| Run {
            layer,
            closed: closed && gap.is_none(),
            points: path(run),
            length: run.iter().map(|sample| sample.length).sum(),
        })
        .collect()
}

/// Ends of pieces in order, each once.
fn path(run: &[Sample]) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = run.iter().flat_map(|sample| sample.ends).collect();
    points.dedup();
    points
}

/// The runs of one chain joined across gaps of up to 3 pixels, without those that stay shorter than that.
///
/// Contours of fine meshes zigzag in and out of sight within a pixel; nobody draws each tooth as a stroke of its own.
pub fn joined(runs: &[Run]) -> Vec<Run> {
    let near = |a: &Run, b: &Run| match (a.points.last(), b.points.first()) {
        (Some(end), Some(start)) => distance(*end, *start) <= JOINED_PX,
        _ => false,
    };
    let mut found: Vec<Run> = Vec::new();
    for run in runs {
        match found.last_mut() {
            Some(last) if near(last, run) => extend(last, run),
            _ => found.push(run.clone()),
        }
    }
    // A chain that came round: its last run goes on in its first.
    if let [first, .., last] = &mut found[..]
        && near(last, first)
    {
        extend(last, first);
        found.swap_remove(0);
    }
    found.retain(|run| run.length >= JOINED_PX);
    found
}

fn extend(run: &mut Run, by: &Run) {
    run.points.extend(&by.points);
    run.length += by.length;
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const CONTOUR: Layer = Layer {
        kind: Kind::Contour,
        object: 0,
    };

    proptest! {
        #[test]
        fn runs_hold_every_visible_piece_once(closed: bool, sights in prop::collection::vec(0..3u8, 1..40)) {
            let walk: Vec<Sample> = sights.iter().enumerate().map(|(i, sight)| Sample {
                at: [i as f64 + 0.5, 0.0],
                ends: [[i as f64, 0.0], [i as f64 + 1.0, 0.0]],
                length: 1.0,
                sight: [Sight::Visible, Sight::Either, Sight::Hidden][usize::from(*sight)],
            }).collect();
            let found = cut(CONTOUR, closed, walk);
            let mut xs: Vec<usize> = found
                .iter()
                .flat_map(|run| run.points.windows(2).filter(|pair| pair[0][0] < pair[1][0]))
                .map(|pair| pair[0][0] as usize)
                .collect();
            xs.sort_unstable();
            let count = xs.len();
            xs.dedup();
            prop_assert_eq!(count, xs.len());
            prop_assert!(xs.iter().all(|x| sights[*x] != 2));
            prop_assert!((0..sights.len()).all(|i| sights[i] != 0 || xs.binary_search(&i).is_ok()));
            // Starts of runs: visible pieces whose forerunner is not.
            let last = sights.last().copied().filter(|_| closed);
            let before = |i: usize| if i > 0 { Some(sights[i - 1]) } else { last };
            let starts = (0..sights.len()).filter(|i| sights[*i] != 2 && before(*i).is_none_or(|s| s == 2)).count();
            prop_assert!(found.len() <= starts.max(1));
        }
    }

    #[test]
    fn short_gaps_are_joined_and_short_rests_left_out() {
        let run = |from: f64, to: f64| Run {
            layer: CONTOUR,
            closed: false,
            points: vec![[from, 0.0], [to, 0.0]],
            length: to - from,
        };
        let found = joined(&[
            run(0.0, 5.0),
            run(7.0, 9.0),
            run(20.0, 22.0),
            run(40.0, 50.0),
        ]);
        let spans: Vec<(f64, usize)> = found.iter().map(|r| (r.length, r.points.len())).collect();
        assert_eq!(spans, [(7.0, 4), (10.0, 2)]);
        let around = joined(&[run(0.0, 10.0), run(20.0, 30.0), run(-9.0, -1.0)]);
        assert_eq!(
            around.iter().map(|r| r.length).collect::<Vec<_>>(),
            [18.0, 10.0]
        );
    }
}
