//! The net of thinned lines: followed, tidied, and joined into strokes.

use std::collections::BTreeMap;

use glam::DVec2;
use npr_vector::stroke::Kind;

use super::chains::{Chain, Joints};
use super::drawn::DrawnStroke;
use super::ink::Curve;
use super::layers::Layer;
use super::pen::{PEN_PX, Paper};

/// Shorter strokes are specks, shorter spurs and bridges artefacts of thinning, in pixels: under three widths of the
/// pen.
pub(crate) const SHORTEST_PX: f64 = 8.0;

/// Distance along a line over which its direction at a meeting is taken, in pixels. It starts a pen's width away, for
/// thinning bends lines within that.
const DIRECTION_PX: f64 = 4.0 * PEN_PX;

/// Where a line ends and no other begins.
const FREE: u32 = u32::MAX;

/// A line between two meetings.
#[derive(Debug, Clone, PartialEq)]
struct Arc {
    points: Vec<[f64; 2]>,
    length: f64,
    /// The meetings at its first and last point.
    ends: [u32; 2],
    closed: bool,
}

impl Arc {
    fn new(points: Vec<[f64; 2]>, ends: [u32; 2], closed: bool) -> Self {
        let path = Curve {
            kind: Kind::Contour,
            closed,
            points,
        };
        Self {
            length: path.length(),
            points: path.points,
            ends,
            closed,
        }
    }

    fn turned(mut self) -> Self {
        self.points.reverse();
        self.ends.reverse();
        self
    }

    /// The points from one end on.
    fn points_from(&self, at_tail: bool) -> Vec<[f64; 2]> {
        let mut points = self.points.clone();
        if !at_tail {
            points.reverse();
        }
        points
    }

    /// Unit vector away from one end.
    fn direction(&self, at_tail: bool) -> DVec2 {
        let count = self.points.len();
        let walk = |i: usize| DVec2::from(self.points[if at_tail { i } else { count - 1 - i }]);
        let at = |px: f64| {
            let mut passed = 0.0;
            let step = |i: &usize| {
                passed += walk(*i).distance(walk(i - 1));
                passed >= px
            };
            walk((1..count).find(step).unwrap_or(count - 1))
        };
        // A line too short to leave the blot of the meeting is taken whole.
        let from = if self.length > 2.0 * PEN_PX {
            at(PEN_PX)
        } else {
            walk(0)
        };
        (at(DIRECTION_PX) - from).normalize_or_zero()
    }
}

/// All lines on the paper.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Net {
    arcs: Vec<Arc>,
}

impl Net {
    /// Follows thinned lines from meeting to meeting.
    pub(crate) fn read(paper: &Paper) -> Self {
        let mut reader = Reader::new(paper);
        let meetings: Vec<(usize, u32)> = reader.meetings.iter().map(|(p, m)| (*p, *m)).collect();
        for (pixel, _) in meetings {
            for near in paper.black_around(pixel).collect::<Vec<_>>() {
                reader.follow(&[pixel, near]);
            }
        }
        let black = paper.black_pixels();
        let is_end = |pixel: &&usize| paper.black_around(**pixel).count() <= 1;
        for pixel in black.iter().filter(is_end).chain(&black) {
            reader.follow(&[*pixel]);
        }
        Self { arcs: reader.arcs }
    }

    /// Which ends of which arcs meet, by meeting: number of the arc, and whether its tail is there.
    fn meetings(&self) -> BTreeMap<u32, Vec<(u32, bool)>> {
        let mut found: BTreeMap<u32, Vec<(u32, bool)>> = BTreeMap::new();
        for (number, arc) in (0..).zip(&self.arcs) {
            for (end, at_tail) in arc.ends.into_iter().zip([true, false]) {
                if end != FREE {
                    found.entry(end).or_default().push((number, at_tail));
                }
            }
        }
        found
    }

    /// Takes away lines that leave a meeting and stop soon, the shortest first; what is left of two goes on as one.
    pub(crate) fn cut_spurs(&mut self) {
        let is_spur = |arc: &Arc| {
            arc.length < SHORTEST_PX && arc.ends.contains(&FREE) && arc.ends != [FREE; 2]
        };
        loop {
            let spurs = self.arcs.iter().enumerate().filter(|(_, arc)| is_spur(arc));
            let Some((shortest, _)) = spurs.min_by(|a, b| a.1.length.total_cmp(&b.1.length)) else {
                return;
            };
            let ends = self.arcs.swap_remove(shortest).ends;
            self.go_on(if ends[0] == FREE { ends[1] } else { ends[0] });
        }
    }

    /// Where only two ends are left of a meeting, there is none.
    fn go_on(&mut self, meeting: u32) {
        let ends = self.meetings().remove(&meeting).unwrap_or_default();
        let ends: Vec<(usize, bool)> = ends
            .into_iter()
            .map(|(arc, at)| (arc as usize, at))
            .collect();
        match ends[..] {
            [(a, _), (b, _)] if a == b => {
                let arc = self.arcs.swap_remove(a);
                self.arcs.push(Arc::new(arc.points, [FREE; 2], true));
            }
            [(a, a_at_tail), (b, b_at_tail)] => {
                // The later one first: what takes its place is neither of the two.
                let second = self.arcs.swap_remove(b);
                let first = self.arcs.swap_remove(a);
                let first = if a_at_tail { first.turned() } else { first };
                let second = if b_at_tail { second } else { second.turned() };
                let points = first.points.into_iter().chain(second.points).collect();
                self.arcs
                    .push(Arc::new(points, [first.ends[0], second.ends[1]], false));
            }
            [(a, at_tail)] => self.arcs[a].ends[usize::from(!at_tail)] = FREE,
            _ => {}
        }
    }

    /// Makes one meeting of those that a short bridge joins: crossing lines run together for a moment.
    pub(crate) fn contract_bridges(&mut self) {
        let is_bridge = |arc: &Arc| arc.length < SHORTEST_PX && !arc.ends.contains(&FREE);
        while let Some(bridge) = self.arcs.iter().position(is_bridge) {
            let [kept, lost] = self.arcs.swap_remove(bridge).ends;
            for end in self.arcs.iter_mut().flat_map(|arc| &mut arc.ends) {
                *end = if *end == lost { kept } else { *end };
            }
            self.go_on(kept);
        }
    }

    /// Joins lines through meetings; specks are left out.
    ///
    /// First the straightest of one layer, then around corners the only two of a layer, then the straightest of those
    /// left. `layers_of` tells the layers in which a line leaves a meeting, by its points from there on.
    pub(crate) fn strokes(
        &self,
        layers_of: &dyn Fn(&[[f64; 2]]) -> Vec<Layer>,
    ) -> Vec<DrawnStroke> {
        let mut joints = Joints::new(self.arcs.len());
        for ends in self.meetings().into_values() {
            // Look at the directions and layers in which lines leave the meeting.
            let arc_of = |(arc, at_tail): &(u32, bool)| (&self.arcs[*arc as usize], *at_tail);
            let direction = |end: &(u32, bool)| {
                let (arc, at_tail) = arc_of(end);
                arc.direction(at_tail)
            };
            let directions: Vec<DVec2> = ends.iter().map(direction).collect();
            let straight = |a: usize, b: usize| -directions[a].dot(directions[b]);
            let layers = ends.iter().map(|end| {
                let (arc, at_tail) = arc_of(end);
                layers_of(&arc.points_from(at_tail))
            });
            let layers: Vec<Vec<Layer>> = layers.collect();
            let is_shared = |a: usize, b: usize| layers[a].iter().any(|l| layers[b].contains(l));

            // Join the straightest of one layer, then the only two, then the rest.
            joints.join_straightest(&ends, |a, b| {
                if is_shared(a, b) {
                    straight(a, b)
                } else {
                    -1.0
                }
            });
            for [a, b] in only_two(&layers) {
                joints.join_if_free(ends[a], ends[b]);
            }
            joints.join_straightest(&ends, straight);
        }

        // Leave out strokes too short to be seen as lines.
        let strokes = joints.chains().into_iter().map(|chain| self.stroke(&chain));
        strokes
            .filter(|stroke| stroke.length >= SHORTEST_PX)
            .collect()
    }

    fn stroke(&self, chain: &Chain) -> DrawnStroke {
        let arcs = || {
            chain
                .links
                .iter()
                .map(|(number, backwards)| (&self.arcs[*number as usize], *backwards))
        };
        let points = arcs().flat_map(|(arc, backwards)| {
            let count = arc.points.len();
            (0..count).map(move |i| arc.points[if backwards { count - 1 - i } else { i }])
        });
        // A line that nothing meets is a chain of itself, whose ends the joints do not know.
        let alone = matches!(chain.links[..], [(number, _)] if self.arcs[number as usize].ends == [FREE; 2]);
        DrawnStroke {
            closed: if alone {
                arcs().any(|(arc, _)| arc.closed)
            } else {
                chain.closed
            },
            points: points.collect(),
            length: arcs().map(|(arc, _)| arc.length).sum(),
        }
    }
}

/// Pairs of ends that are the only two of a layer in their meeting; the least layer first.
fn only_two(layers: &[Vec<Layer>]) -> Vec<[usize; 2]> {
    let mut all: Vec<Layer> = layers.concat();
    all.sort_unstable();
    all.dedup();
    let ends_of = |layer: Layer| -> Vec<usize> {
        (0..layers.len())
            .filter(|end| layers[*end].contains(&layer))
            .collect()
    };
    all.into_iter()
        .filter_map(|layer| ends_of(layer).try_into().ok())
        .collect()
}

/// Follows thinned lines.
struct Reader<'a> {
    paper: &'a Paper,
    /// The meeting that a pixel of three or more neighbours is part of.
    meetings: BTreeMap<usize, u32>,
    /// Pixels of lines that have been followed.
    followed: Vec<bool>,
    arcs: Vec<Arc>,
}

impl<'a> Reader<'a> {
    fn new(paper: &'a Paper) -> Self {
        let crowded = |pixel: &usize| paper.black_around(*pixel).count() > 2;
        let black = paper.black_pixels();
        let mut meetings: BTreeMap<usize, u32> = BTreeMap::new();
        for (number, start) in (0..).zip(black.iter().copied().filter(crowded)) {
            // Pixels that touch are one meeting.
            let mut open = vec![start];
            while let Some(pixel) = open.pop() {
                if crowded(&pixel) && !meetings.contains_key(&pixel) {
                    meetings.insert(pixel, number);
                    open.extend(paper.black_around(pixel));
                }
            }
        }
        Self {
            paper,
            meetings,
            followed: vec![false; black.last().map_or(0, |last| last + 1)],
            arcs: Vec::new(),
        }
    }

    /// Follows a line on from its first pixels; nothing where it has been followed before, or lies within a meeting.
    fn follow(&mut self, start: &[usize]) {
        let mut path = start.to_vec();
        let mut here = path[path.len() - 1];
        if self.followed[here] || self.meetings.contains_key(&here) {
            return;
        }
        let from = self.meetings.get(&path[0]).copied();
        let to = loop {
            self.followed[here] = true;
            let before = path.len().checked_sub(2).map(|i| path[i]);
            let fresh = |near: &usize| Some(*near) != before && !self.followed[*near];
            // Lines step to a side rather than to a corner, so that they cut none.
            let Some(next) = self.paper.black_around(here).find(fresh) else {
                break None;
            };
            path.push(next);
            if let Some(meeting) = self.meetings.get(&next) {
                break Some(*meeting);
            }
            here = next;
        };
        let round = path.len() > 2 && self.paper.black_around(path[0]).any(|near| near == here);
        let closed = from.is_none() && to.is_none() && round;
        let points = path.iter().map(|pixel| self.paper.place(*pixel)).collect();
        let ends = [from, to].map(|meeting| meeting.unwrap_or(FREE));
        self.arcs.push(Arc::new(points, ends, closed));
    }
}
