//! Branches linked to strokes: through junctions they go on straight.

use super::network::Network;
use glam::{DMat2, DVec2};
use npr_core::geometry::NONE;

/// Pixels from which the direction of a branch is taken, at least and at most; in between three widths.
const DIRECTION_PIXELS: [f64; 2] = [6.0, 24.0];

/// Cosine of the most by which the few pixels of a bridge lead astray: 45 degrees, of one that steps a pixel aside.
const ASTRAY: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A point on the way of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WayPoint {
    /// Pixels.
    pub place: DVec2,
    /// Half the width of the ink, where it was measured: not within junctions.
    pub radius: Option<f64>,
}

/// A stroke before it is smoothed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Way {
    /// Middles of pixels, and places across junctions; about a pixel apart.
    pub points: Vec<WayPoint>,
    /// The last point runs on to the first.
    pub closed: bool,
    /// Whether it ends in nothing there, rather than on another stroke.
    pub free: [bool; 2],
}

/// Strokes, and the places at which they meet.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ways {
    /// Every branch is part of one.
    pub ways: Vec<Way>,
    /// Places where three branches or more met.
    pub junctions: Vec<DVec2>,
}

/// The end of a branch at a node.
#[derive(Debug, Clone, Copy)]
struct Arm {
    /// Pixels of the branch that lie within the junction.
    skip: usize,
    /// A place on its middle line, and where that leads, away from the junction.
    line: [DVec2; 2],
    /// Whether fewer pixels than [`DIRECTION_PIXELS`] say so.
    is_short: bool,
    /// Of junctions made one, which it starts at, and the middle of that.
    fork: usize,
    middle: DVec2,
    /// The arm that it runs on to.
    partner: u32,
}

/// Number of an arm: of a branch, and at which of its ends.
fn arm_of(branch: u32, end: usize) -> u32 {
    2 * branch + end as u32
}

/// Links the branches of a network to strokes.
///
/// At every junction, the two arms that turn least are linked, then of the others those, as long as they turn by less
/// than `turn` radians. Arms without a partner end where the lines of all arms meet. At a node with two arms both are
/// one stroke.
pub fn link(network: &Network, turn: f64) -> Ways {
    let mut linker = Linker {
        network,
        arms: Vec::with_capacity(2 * network.branches.len()),
        places: vec![DVec2::ZERO; network.nodes.len()],
    };

    // Take both ends of every branch as arms.
    for branch in 0..network.branches.len() as u32 {
        for end in 0..2 {
            linker.arms.push(linker.arm(branch, end));
        }
    }
    linker.direct_bridges();

    // Pair the arms at every node that go on straightest.
    let mut junctions = Vec::new();
    for (node, place) in (0..).zip(0..network.nodes.len()) {
        if network.degree(node) >= 2 {
            linker.places[place] = linker.meeting(node);
            linker.pair(node, turn);
        }
        if network.degree(node) >= 3 {
            junctions.push(linker.places[place]);
        }
    }

    // Follow pairs from arm to arm.
    let ways = linker.ways();
    Ways { ways, junctions }
}

struct Linker<'a> {
    network: &'a Network,
    arms: Vec<Arm>,
    /// Where the arms of each junction meet.
    places: Vec<DVec2>,
}

impl Linker<'_> {
    fn arm(&self, branch: u32, end: usize) -> Arm {
        let network = self.network;
        let there = &network.branches[branch as usize];
        let node = there.ends[end];
        let mut arm = Arm {
            skip: 0,
            line: [DVec2::ZERO, DVec2::X],
            is_short: false,
            fork: 0,
            middle: DVec2::ZERO,
            partner: NONE,
        };
        if node == NONE || network.degree(node) < 2 || there.pixels.is_empty() {
            return arm;
        }
        let count = there.pixels.len();
        let at = |k: usize| {
            let index = if end == 0 { k } else { count - 1 - k };
            network.place(there.pixels[index])
        };
        let discs = network.discs(node);
        arm.fork = network.fork_at(node, at(0));
        arm.middle = discs[arm.fork].0;
        let is_beyond = |place: DVec2| {
            discs
                .iter()
                .all(|(middle, reach)| place.distance(*middle) > *reach)
        };
        // A branch between two junctions leaves the other half to its other end.
        let is_between = network.degree(there.ends[1 - end]) > 1;
        let most = if is_between {
            (count - 1) / 2
        } else {
            count - 1
        };
        arm.skip = (0..most).find(|k| is_beyond(at(*k))).unwrap_or(most);
        let [least, longest] = DIRECTION_PIXELS;
        let wanted = (6.0 * network.radius(node)).clamp(least, longest) as usize;
        let last = (arm.skip + wanted).min(count - 1);
        let places: Vec<DVec2> = (arm.skip..=last).map(at).collect();
        arm.line = line(&places, arm.middle);
        arm.is_short = places.len() <= least as usize;
        arm
    }

    /// Gives bridges that are too short to say where they lead the direction of the straightest line over them.
    fn direct_bridges(&mut self) {
        let over: Vec<Option<DVec2>> = (0..self.network.branches.len() as u32)
            .map(|branch| self.straight_over(branch))
            .collect();
        for (branch, along) in over.into_iter().enumerate() {
            let ends = along
                .into_iter()
                .flat_map(|along| [along, -along].into_iter().enumerate());
            for (end, along) in ends {
                let arm = &mut self.arms[2 * branch + end];
                if arm.is_short {
                    arm.line[1] = along;
                }
            }
        }
    }

    /// Where the straightest line over a bridge leads, from an arm at its start to one at its end; none where its
    /// pixels say enough.
    fn straight_over(&self, bridge: u32) -> Option<DVec2> {
        // Only short bridges between forks need a direction.
        let arms = [0, 1].map(|end| arm_of(bridge, end));
        let there = &self.network.branches[bridge as usize];
        let [from, to] = there.ends;
        let is_fork = |node: u32| node != NONE && self.network.degree(node) > 2;
        let is_short = arms.iter().any(|arm| self.arms[*arm as usize].is_short);
        if !is_short || from == to || !is_fork(from) || !is_fork(to) {
            return None;
        }

        // Measure the bridge's own.
        let ends = [there.pixels.first()?, there.pixels.last()?];
        let [first, last] = ends.map(|pixel| self.network.place(*pixel));
        let own = (last - first).try_normalize()?;

        // Find the straightest way over it that runs about along it.
        let mut best: Option<(f64, DVec2)> = None;
        let (before, after) = (self.arms_at(from), self.arms_at(to));
        for a in before.into_iter().filter(|arm| *arm != arms[0]) {
            for b in after.iter().filter(|arm| **arm != arms[1]) {
                let [a, b] = [a, *b].map(|arm| self.arms[arm as usize].line);
                let Some(along) = (b[0] - a[0]).try_normalize() else {
                    continue;
                };
                let cosine = (-along.dot(a[1])).min(along.dot(b[1]));
                let is_over = along.dot(own) >= ASTRAY;
                if is_over && cosine > best.map_or(0.0, |(most, _)| most) {
                    best = Some((cosine, along));
                }
            }
        }
        best.map(|(_, along)| along)
    }

    /// Where the lines of a junction's arms meet, in the least squares' sense; not far from its middle.
    fn meeting(&self, node: u32) -> DVec2 {
        /// Holds the place where the lines leave it open.
        const PULL: f64 = 0.05;
        let middle = self.network.middle(node);
        let mut matrix = DMat2::from_diagonal(DVec2::splat(PULL));
        let mut right = middle * PULL;
        for arm in self.arms_at(node) {
            let [at, along] = self.arms[arm as usize].line;
            let across = along.perp();
            let product = DMat2::from_cols(across * across.x, across * across.y);
            matrix += product;
            right += product * at;
        }
        let meeting = matrix.inverse() * right;
        middle + (meeting - middle).clamp_length_max((0.5 * self.network.reach(node)).max(1.0))
    }

    fn arms_at(&self, node: u32) -> Vec<u32> {
        let mut branches = self.network.nodes[node as usize].branches.clone();
        branches.sort_unstable();
        branches.dedup();
        let ends = branches
            .into_iter()
            .flat_map(|branch| [0, 1].map(|end| (branch, end)));
        let here =
            ends.filter(|(branch, end)| self.network.branches[*branch as usize].ends[*end] == node);
        here.map(|(branch, end)| arm_of(branch, end)).collect()
    }

    fn pair(&mut self, node: u32, turn: f64) {
        let arms = self.arms_at(node);
        let limit = if arms.len() == 2 {
            f64::INFINITY
        } else {
            -f64::from(npr_core::math::cos(turn as f32))
        };
        let mut pairs = Vec::new();
        for (i, a) in arms.iter().enumerate() {
            for b in &arms[i + 1..] {
                let [from, to] = [a, b].map(|arm| self.arms[*arm as usize].line[1]);
                // -1 where one goes straight on as the other.
                let cosine = from.dot(to);
                if cosine < limit && self.lead_to_each_other(*a, *b, limit) {
                    pairs.push((cosine, *a, *b));
                }
            }
        }
        pairs.sort_by(|x, y| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2))));
        for (_, a, b) in pairs {
            let [a, b] = [a as usize, b as usize];
            if self.arms[a].partner == NONE && self.arms[b].partner == NONE {
                self.arms[a].partner = b as u32;
                self.arms[b].partner = a as u32;
            }
        }
    }

    /// Whether an arm leads to where another one starts, by `limit` as arms turn; always where they start at one fork.
    fn lead_to_each_other(&self, a: u32, b: u32, limit: f64) -> bool {
        let [a, b] = [a, b].map(|arm| &self.arms[arm as usize]);
        if a.fork == b.fork {
            return true;
        }
        let along = (b.line[0] - a.line[0]).normalize_or_zero();
        a.line[1].dot(along) < limit && -b.line[1].dot(along) < limit
    }

    fn ways(&self) -> Vec<Way> {
        let count = self.network.branches.len();
        let mut used = vec![false; count];
        let mut ways = Vec::new();
        // Open strokes first, from ends without a partner; what is left is closed.
        for is_closed in [false, true] {
            for branch in 0..count {
                for end in 0..2 {
                    let is_start = is_closed || self.arms[2 * branch + end].partner == NONE;
                    let is_loose = self.network.branches[branch].ends[end] == NONE;
                    let is_left = !used[branch] && !self.network.branches[branch].pixels.is_empty();
                    if is_left && is_start && (is_closed || !is_loose) {
                        ways.push(self.way(branch as u32, end, &mut used));
                    }
                }
            }
        }
        ways.extend(self.network.dots.iter().map(|pixel| Way {
            points: vec![self.way_point(*pixel)],
            closed: false,
            free: [true; 2],
        }));
        ways
    }

    fn way_point(&self, pixel: u32) -> WayPoint {
        WayPoint {
            place: self.network.place(pixel),
            radius: Some(self.network.radii[pixel as usize]),
        }
    }

    /// The stroke that starts at an end of a branch.
    fn way(&self, branch: u32, end: usize, used: &mut [bool]) -> Way {
        // Begin at the node of an open end.
        let start = arm_of(branch, end);
        let mut points = Vec::from_iter(self.stop(start));
        let mut free = [points.is_empty(), true];
        let mut arm = start;
        loop {
            // Append the branch.
            used[arm as usize / 2] = true;
            self.push_branch(arm, &mut points);
            let far = arm ^ 1;
            let partner = self.arms[far as usize].partner;

            // End at a node, or close the way where it comes back.
            if partner == NONE || partner == start {
                let next = if partner == start {
                    points.first().copied()
                } else {
                    self.stop(far)
                };
                if let (Some(last), Some(next)) = (points.last().copied(), next) {
                    points.extend(steps(last.place, next.place));
                    points.extend((partner == NONE).then_some(next));
                    free[1] = false;
                }
                let is_loose = self.network.branches[far as usize / 2].ends == [NONE; 2];
                return Way {
                    points,
                    closed: is_loose || partner == start,
                    free,
                };
            }
            arm = partner;
        }
    }

    /// The place at which a stroke begins or ends on others; none where it does in nothing.
    fn stop(&self, arm: u32) -> Option<WayPoint> {
        let node = self.network.branches[arm as usize / 2].ends[arm as usize % 2];
        let is_junction = node != NONE && self.network.degree(node) > 1;
        is_junction.then(|| {
            let is_one = self.network.nodes[node as usize].joints.is_empty();
            WayPoint {
                // Between junctions made one there may be no ink.
                place: if is_one {
                    self.places[node as usize]
                } else {
                    self.arms[arm as usize].middle
                },
                radius: None,
            }
        })
    }

    /// Adds the pixels of a branch from one arm on, but for those in junctions, and steps to it from what is there.
    fn push_branch(&self, arm: u32, points: &mut Vec<WayPoint>) {
        let branch = arm as usize / 2;
        let pixels = &self.network.branches[branch].pixels;
        let [from, to] = [0, 1].map(|end| self.arms[2 * branch + end].skip);
        let kept = &pixels[from..pixels.len() - to];
        let mut kept: Vec<WayPoint> = kept.iter().map(|pixel| self.way_point(*pixel)).collect();
        if arm % 2 == 1 {
            kept.reverse();
        }
        if let (Some(last), Some(first)) = (points.last(), kept.first()) {
            points.extend(steps(last.place, first.place));
        }
        points.extend(kept);
    }
}

/// Places between two others, about a pixel apart.
fn steps(from: DVec2, to: DVec2) -> Vec<WayPoint> {
    let count = from.distance(to).round().max(1.0);
    (1..count as u32)
        .map(|k| WayPoint {
            place: from.lerp(to, f64::from(k) / count),
            radius: None,
        })
        .collect()
}

/// The line along places, led away from another one.
pub fn line(places: &[DVec2], from: DVec2) -> [DVec2; 2] {
    let mean = |places: &[DVec2]| places.iter().sum::<DVec2>() / places.len().max(1) as f64;
    let half = places.len().div_ceil(2);
    let [near, far] = [mean(&places[..half]), mean(&places[places.len() - half..])];
    let middle = mean(places);
    let along = if places.len() > 1 {
        far - near
    } else {
        middle - from
    };
    [middle, along.try_normalize().unwrap_or(DVec2::X)]
}
