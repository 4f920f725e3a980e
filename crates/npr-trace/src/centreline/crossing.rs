//! Junctions that thinning tore apart made one again.
//!
//! Where lines cross at an angle their ink is one for a while: the network has two forks there and a bridge between
//! them, and where pixels close the sharp corners of a crossing, small loops beside it. Forks that happen to be near
//! each other look alike, so the arms decide: they must be those of straight lines that cross.

use super::link::line;
use super::network::Network;
use super::stroke::ROUGHNESS;
use glam::DVec2;
use npr_core::geometry::NONE;

/// How far apart, in sums of their half widths, the forks of a crossing may lie: lines that cross by 30 degrees are
/// torn apart by 1.4, by 15 degrees by 3.3.
const TORN: f64 = 3.5;

/// What is added to [`TORN`], in pixels: lines of single pixels that cross by 20 degrees touch that long.
const SHARED_PX: f64 = 10.0;

/// How many times as long as its forks may be apart a bridge is at most: it may wind.
const WINDING: f64 = 1.5;

/// How far apart, as a share of the lesser half width, junctions are one in any case: the disc of ink around one
/// holds the other.
const OVERLAP: f64 = 1.0;

/// Half the width, in pixels, from which that holds: of thinner lines pixels show nothing between forks.
const WIDE_PX: f64 = 1.2;

/// Cosine of the most that a line may turn across a crossing: 40 degrees.
const STRAIGHT: f64 = 0.766;

/// How far beside the drawn line the pixels of an arm lie at most, in pixels: ink lies up to half a pixel beside it,
/// and pixels half a pixel beside the middle of ink that is an even number of pixels wide.
const ASIDE_PX: f64 = 1.0;

/// The same where the pixels are all the ink there is. Two arms of one line are a pixel aside together, then; those of
/// two lines with two pixels of white between them, which are three pixels apart, at least two.
const BARE_ASIDE_PX: f64 = 0.5;

/// Most junctions that a crossing may have been torn into, with the loops beside it.
const MOST_FORKS: usize = 12;

/// Pixels of an arm that say where it leads, at least and at most; in between three widths.
const ARM_PIXELS: [f64; 2] = [10.0, 24.0];

/// Fewest pixels of an arm that lead anywhere.
const LEAST_ARM: f64 = 5.0;

/// Times that all junctions are looked at: what was joined may be part of a crossing with what is beside it.
const ROUNDS: usize = 2;

/// Junctions that may be one.
struct Cluster {
    nodes: Vec<u32>,
    /// Distance of the two farthest.
    extent: f64,
}

/// What leads away from a cluster.
struct Arm {
    /// A place on its middle line, and the way it leads.
    line: [DVec2; 2],
    radius: f64,
    /// The middles of its pixels, from the junction on.
    places: Vec<DVec2>,
    /// How far beside the drawn line they lie at most.
    aside: f64,
}

impl Network {
    /// Makes one of junctions that thinning tore apart: those within the same disc of ink, and those of a crossing.
    ///
    /// Forks make a crossing where four arms or six lead away from them that are, in pairs, the two ends of straight
    /// lines, each of which has ends of every other line on both of its sides. Arms must be seen for as long as they
    /// are not between the forks: lines that run together for a while and part again are two forks. O(junctions), the
    /// nearest first.
    pub fn join_junctions(&mut self) {
        self.join_overlapping();
        for _ in 0..ROUNDS {
            // Find forks that are one crossing, the smallest first.
            let mut found: Vec<Cluster> = (0..self.nodes.len() as u32)
                .filter_map(|seed| self.crossing(seed))
                .collect();
            found.sort_by(|a, b| {
                let by_extent = a.extent.total_cmp(&b.extent);
                by_extent.then_with(|| a.nodes.cmp(&b.nodes))
            });

            // Join those of which no fork has changed in this round.
            let mut is_changed = vec![false; self.nodes.len()];
            for cluster in &found {
                if cluster.nodes.iter().any(|node| is_changed[*node as usize]) {
                    continue;
                }
                for node in &cluster.nodes {
                    is_changed[*node as usize] = true;
                }
                let bridges = self.bridges(&cluster.nodes);
                self.join(&cluster.nodes, &bridges);
            }
            if found.is_empty() {
                return;
            }
        }
    }

    /// Joins junctions of wide lines whose discs of ink hold each other's middle.
    fn join_overlapping(&mut self) {
        let mut bridges: Vec<(u64, u32)> = (0..self.branches.len() as u32)
            .filter_map(|branch| Some((self.overlap(branch)?.to_bits(), branch)))
            .collect();
        bridges.sort_unstable();
        for (_, branch) in bridges {
            // What was joined since may have moved its middle away.
            if self.overlap(branch).is_some() {
                let mut ends = self.branches[branch as usize].ends;
                ends.sort_unstable();
                let bridges = self.between(&ends, |branch| self.is_within(branch, &ends));
                self.join(&ends, &bridges);
                // In one disc of ink they are one place.
                self.nodes[ends[0] as usize].joints.clear();
            }
        }
    }

    /// The length of a branch between two junctions in one disc of ink.
    fn overlap(&self, branch: u32) -> Option<f64> {
        let [a, b] = self.branches[branch as usize].ends;
        if a == b || !self.is_fork(a) || !self.is_fork(b) {
            return None;
        }
        let least = self.radius(a).min(self.radius(b));
        let apart = self.middle(a).distance(self.middle(b));
        (least >= WIDE_PX && apart <= OVERLAP * least).then_some(apart)
    }

    fn is_fork(&self, node: u32) -> bool {
        node != NONE && self.degree(node) > 2
    }

    /// The fewest junctions around one that make a crossing with it.
    fn crossing(&self, seed: u32) -> Option<Cluster> {
        if !self.is_fork(seed) {
            return None;
        }
        let mut cluster = Cluster {
            nodes: vec![seed],
            extent: 0.0,
        };
        while cluster.nodes.len() < MOST_FORKS {
            let (next, extent) = self.nearest_beside(&cluster)?;
            cluster.nodes.push(next);
            cluster.extent = extent;
            if self.is_crossing(&cluster) {
                cluster.nodes.sort_unstable();
                return Some(cluster);
            }
        }
        None
    }

    /// The junction nearest to the first of a cluster that a short branch joins to it, and the extent with it.
    fn nearest_beside(&self, cluster: &Cluster) -> Option<(u32, f64)> {
        let seed = self.middle(cluster.nodes[0]);
        let mut best: Option<(f64, u32, f64)> = None;
        for node in &cluster.nodes {
            for branch in &self.nodes[*node as usize].branches {
                // Look at forks one branch away from the cluster.
                let [a, b] = self.branches[*branch as usize].ends;
                let other = if a == *node { b } else { a };
                if cluster.nodes.contains(&other) || !self.is_fork(other) {
                    continue;
                }
                let Some(extent) = self.extent_with(cluster, *branch, other) else {
                    continue;
                };

                // Keep the one nearest to the first.
                let apart = self.middle(other).distance(seed);
                if best.is_none_or(|(least, known, _)| (apart, other) < (least, known)) {
                    best = Some((apart, other, extent));
                }
            }
        }
        best.map(|(_, node, extent)| (node, extent))
    }

    /// The extent of a cluster with one more junction; none where a crossing cannot be as wide.
    fn extent_with(&self, cluster: &Cluster, branch: u32, node: u32) -> Option<f64> {
        let (middle, radius) = (self.middle(node), self.radius(node));
        let widest = cluster.nodes.iter().map(|other| self.radius(*other));
        let limit = TORN * (radius + widest.fold(0.0, f64::max)) + SHARED_PX;
        let away = cluster
            .nodes
            .iter()
            .map(|other| self.middle(*other).distance(middle));
        let extent = away.fold(cluster.extent, f64::max);
        let length = self.branches[branch as usize].pixels.len() as f64;
        (extent <= limit && length <= WINDING * limit).then_some(extent)
    }

    /// Whether the arms of a cluster are those of straight lines that cross.
    fn is_crossing(&self, cluster: &Cluster) -> bool {
        let Some(arms) = self.arms_of(cluster) else {
            return false;
        };
        let Some(pairs) = straight_pairs(&arms) else {
            return false;
        };
        let lines: Vec<[DVec2; 2]> = pairs
            .iter()
            .map(|pair| pair.map(|arm| arms[arm].line[0]))
            .collect();
        (0..lines.len()).all(|i| lines[..i].iter().all(|other| do_cross(&lines[i], other)))
    }

    /// The arms of a cluster; none unless they are four or six and each is as long as the cluster.
    fn arms_of(&self, cluster: &Cluster) -> Option<Vec<Arm>> {
        let bridges = self.bridges(&cluster.nodes);
        let mut arms = Vec::new();
        for node in &cluster.nodes {
            let branches = &self.nodes[*node as usize].branches;
            for (k, branch) in branches.iter().enumerate() {
                if bridges.contains(branch) {
                    continue;
                }
                if arms.len() == 6 {
                    return None;
                }
                // A loop at the node is listed there once for each of its ends.
                let end = match self.branches[*branch as usize].ends {
                    [a, b] if a == b => usize::from(branches[..k].contains(branch)),
                    [a, _] => usize::from(a != *node),
                };
                arms.push(self.arm_from(*branch, end, cluster.extent)?);
            }
        }
        matches!(arms.len(), 4 | 6).then_some(arms)
    }

    /// The branches between some junctions that are short enough to be torn out of a crossing: a longer one is a loop
    /// of the line.
    fn bridges(&self, nodes: &[u32]) -> Vec<u32> {
        let radii = nodes.iter().map(|node| self.radius(*node));
        let longest = WINDING * (2.0 * TORN * radii.fold(0.0, f64::max) + SHARED_PX);
        self.between(nodes, |branch| {
            self.branches[branch as usize].pixels.len() as f64 <= longest
        })
    }

    /// The branches with both ends in some junctions of which `which` holds, each once.
    fn between(&self, nodes: &[u32], which: impl Fn(u32) -> bool) -> Vec<u32> {
        let mut between: Vec<u32> = nodes
            .iter()
            .flat_map(|node| &self.nodes[*node as usize].branches)
            .copied()
            .filter(|branch| {
                let ends = self.branches[*branch as usize].ends;
                ends.iter().all(|end| nodes.contains(end)) && which(*branch)
            })
            .collect();
        between.sort_unstable();
        between.dedup();
        between
    }

    /// Whether a branch stays within the discs of ink around some junctions: there is no white beside it to go around.
    fn is_within(&self, branch: u32, nodes: &[u32]) -> bool {
        let discs: Vec<(DVec2, f64)> = nodes
            .iter()
            .map(|node| (self.middle(*node), self.radius(*node)))
            .collect();
        let is_in = |place: DVec2| {
            discs
                .iter()
                .any(|(middle, radius)| middle.distance(place) <= *radius)
        };
        let pixels = &self.branches[branch as usize].pixels;
        pixels.iter().all(|pixel| is_in(self.place(*pixel)))
    }

    /// Where a branch leads from one of its ends, beyond the junction's ink; none where it is shorter than `extent`.
    fn arm_from(&self, branch: u32, end: usize, extent: f64) -> Option<Arm> {
        let there = &self.branches[branch as usize];
        let node = there.ends[end];
        let radius = self.radius(node);
        let count = there.pixels.len();
        let skip = (radius.ceil() as usize).min(count - 1);
        if ((count - 1 - skip) as f64) < extent.max(LEAST_ARM) {
            return None;
        }
        let [least, most] = ARM_PIXELS;
        let last = (skip + (6.0 * radius).clamp(least, most) as usize).min(count - 1);
        let is_first = end == 0;
        let pixel = |k: usize| there.pixels[if is_first { k } else { count - 1 - k }];
        let places: Vec<DVec2> = (skip..=last).map(|k| self.place(pixel(k))).collect();
        let is_bare = (skip..=last).all(|k| self.bare[pixel(k) as usize]);
        // Near the junction its ink is wider; of thin lines some pixels lie at the side and say less.
        let far = skip + (last - skip) / 2;
        let radii = (far..=last).map(|k| self.radii[pixel(k) as usize]);
        Some(Arm {
            line: line(&places, self.middle(node)),
            radius: radii.fold(0.0, f64::max),
            aside: if is_bare { BARE_ASIDE_PX } else { ASIDE_PX },
            places,
        })
    }

    /// Makes one of several junctions, in the place of the first, without `bridges` between them; what else runs from
    /// one to another is a loop from then on.
    fn join(&mut self, nodes: &[u32], bridges: &[u32]) {
        // Take out the bridges between the forks.
        for branch in bridges {
            self.remove(*branch);
        }

        // Move the branches and pixels of the others to the first.
        let first = nodes[0];
        for node in &nodes[1..] {
            let other = std::mem::take(&mut self.nodes[*node as usize]);
            for moved in &other.branches {
                for end in &mut self.branches[*moved as usize].ends {
                    if *end == *node {
                        *end = first;
                    }
                }
            }
            let into = &mut self.nodes[first as usize];
            into.branches.extend(other.branches);
            let before = into.pixels.len();
            let begins = [0].into_iter().chain(other.joints);
            into.joints.extend(begins.map(|at| before + at));
            into.pixels.extend(other.pixels);
        }
    }
}

/// The arms in pairs, each of one straight line, those that turn least first; none where any has no partner.
fn straight_pairs(arms: &[Arm]) -> Option<Vec<[usize; 2]>> {
    let mut turns: Vec<(f64, [usize; 2])> = Vec::new();
    for (i, a) in arms.iter().enumerate() {
        for (j, b) in arms.iter().enumerate().skip(i + 1) {
            turns.extend(turn_between(a, b).map(|cosine| (cosine, [i, j])));
        }
    }
    turns.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    let mut pairs: Vec<[usize; 2]> = Vec::new();
    for (_, [i, j]) in turns {
        let is_taken = |arm: &usize| pairs.iter().flatten().any(|taken| taken == arm);
        if !is_taken(&i) && !is_taken(&j) {
            pairs.push([i, j]);
        }
    }
    (2 * pairs.len() == arms.len()).then_some(pairs)
}

/// -1 where one arm goes straight on as the other; none where they are not one line.
fn turn_between(a: &Arm, b: &Arm) -> Option<f64> {
    let cosine = a.line[1].dot(b.line[1]);
    if cosine > -STRAIGHT {
        return None;
    }
    // A bent line leaves and comes back at the same angle to its chord.
    let along = (b.line[1] - a.line[1]).try_normalize()?;
    let wider = 2.0 * (a.radius + b.radius - 1.0);
    let limit = a.aside + b.aside + ROUGHNESS * wider;
    are_parallel(&a.places, &b.places, along, limit).then_some(cosine)
}

/// Whether the ways from every place of an arm to that of another one as far on are parallel, but for `limit` to the
/// side.
///
/// Those between the arms of one line are, straight or bent alike on both sides. Where one arm is beside the other's
/// line, the nearer two places are the more aslant is the way between them. O(places), exact.
fn are_parallel(one: &[DVec2], other: &[DVec2], along: DVec2, limit: f64) -> bool {
    let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
    for (a, b) in one.iter().zip(other) {
        let [ahead, aside] = [(*b - *a).dot(along), along.perp_dot(*b - *a)];
        if ahead <= 0.0 {
            return false;
        }
        least = f64::max(least, (aside - limit) / ahead);
        most = f64::min(most, (aside + limit) / ahead);
    }
    least <= most + 1e-9
}

/// Whether two lines, each given by places on its two arms, cross.
fn do_cross(one: &[DVec2; 2], other: &[DVec2; 2]) -> bool {
    let are_apart = |line: &[DVec2; 2], places: &[DVec2; 2]| {
        let [a, b] = places.map(|place| (line[1] - line[0]).perp_dot(place - line[0]));
        a * b < 0.0
    };
    are_apart(one, other) && are_apart(other, one)
}
