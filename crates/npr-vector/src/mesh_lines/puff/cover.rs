//! Which arcs of a circle are left free.

use std::f64::consts::{PI, TAU};

/// Least length of a free arc, in radians: shorter ones come from rounding.
const LEAST: f64 = 1e-7;

/// Number of arcs that are collected before they are put in order.
const WAITING: usize = 64;

/// Arcs of a circle that are covered.
#[derive(Debug, Default)]
pub(super) struct Cover {
    /// From and to, within one turn; the first `merged` ascend and are apart.
    spans: Vec<[f64; 2]>,
    merged: usize,
    is_full: bool,
}

/// An arc that nothing covers, from an angle to a greater one, up to a turn more.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    pub from: f64,
    pub to: f64,
    /// The whole circle.
    pub is_closed: bool,
}

impl Cover {
    /// Covers an arc given by its middle, in one turn, and half of its length.
    pub fn add(&mut self, [middle, half]: [f64; 2]) {
        if half >= PI {
            self.is_full = true;
            return;
        }
        let (from, to) = (middle - half, middle + half);
        if from < 0.0 {
            self.spans.extend([[from + TAU, TAU], [0.0, to]]);
        } else if to > TAU {
            self.spans.extend([[from, TAU], [0.0, to - TAU]]);
        } else {
            self.spans.push([from, to]);
        }
        if self.spans.len() > 2 * self.merged + WAITING {
            self.merge();
        }
    }

    /// Whether surely nothing is free; that may also turn out only at the end.
    pub fn is_full(&self) -> bool {
        self.is_full
    }

    fn merge(&mut self) {
        self.spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut merged: Vec<[f64; 2]> = Vec::new();
        for [from, to] in self.spans.drain(..) {
            match merged.last_mut() {
                Some(last) if from <= last[1] + LEAST => last[1] = last[1].max(to),
                _ => merged.push([from, to]),
            }
        }
        self.spans = merged;
        self.merged = self.spans.len();
        let is_whole = |span: &[f64; 2]| span[0] <= LEAST && span[1] >= TAU - LEAST;
        self.is_full |= self.spans.first().is_some_and(is_whole);
    }

    /// The arcs left free, ascending; one across the end of the turn comes last.
    pub fn free(mut self) -> Vec<Arc> {
        self.merge();
        if self.is_full {
            return Vec::new();
        }
        let arc = |from: f64, to: f64| Arc {
            from,
            to,
            is_closed: false,
        };

        // With nothing covered the whole circle is free.
        let (Some(first), Some(last)) = (self.spans.first(), self.spans.last()) else {
            return vec![Arc {
                is_closed: true,
                ..arc(0.0, TAU)
            }];
        };

        // Give the gaps between covered arcs, the one over the start included.
        let between = self
            .spans
            .windows(2)
            .map(|pair| arc(pair[0][1], pair[1][0]));
        let around = arc(last[1], first[0] + TAU);
        let arcs = between.chain([around]);
        arcs.filter(|arc| arc.to - arc.from > LEAST).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// An angle is free where no arc holds it.
        #[test]
        fn free_is_what_no_arc_covers(
            arcs in prop::collection::vec((0.0..TAU, 0.0..3.5f64), 0..90),
            angles in prop::collection::vec(0.0..TAU, 40), narrow in 0.01..1.0f64,
        ) {
            let mut cover = Cover::default();
            let arcs: Vec<[f64; 2]> = arcs.into_iter().map(|(middle, half)| [middle, half * narrow]).collect();
            arcs.iter().for_each(|arc| cover.add(*arc));
            let free = cover.free();
            for angle in angles {
                let apart = |middle: f64| {
                    let d = (angle - middle).rem_euclid(TAU);
                    d.min(TAU - d)
                };
                let edge = arcs.iter().map(|[middle, half]| (apart(*middle) - half).abs()).fold(1.0, f64::min);
                let covered = arcs.iter().any(|[middle, half]| apart(*middle) < *half);
                let found = free.iter().any(|arc| {
                    [angle, angle + TAU].iter().any(|a| arc.from < *a && *a < arc.to)
                });
                prop_assert!(found != covered || edge < 1e-6);
            }
        }
    }

    #[test]
    fn nothing_leaves_the_circle_and_all_leaves_nothing() {
        assert!(Cover::default().free()[0].is_closed);
        let mut halves = Cover::default();
        halves.add([0.0, PI / 2.0]);
        halves.add([PI, PI / 2.0]);
        assert_eq!(halves.free(), []);
    }
}
