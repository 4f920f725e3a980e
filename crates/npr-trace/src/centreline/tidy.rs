//! A network without what thinning adds to lines: spurs, and hooks at ends.

use super::network::{Branch, Network, Node};
use glam::DVec2;
use npr_core::geometry::NONE;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// How fast, per pixel, a line may swell from its end on: along the bisector of a square end's corner it swells by
/// 0.71.
const SWELL: f64 = 0.5;

impl Network {
    /// The middle of a node.
    pub fn middle(&self, node: u32) -> DVec2 {
        let pixels = &self.nodes[node as usize].pixels;
        let sum: DVec2 = pixels.iter().map(|pixel| self.place(*pixel)).sum();
        sum / pixels.len().max(1) as f64
    }

    /// Half the width of the ink at a node, where it is widest.
    pub fn radius(&self, node: u32) -> f64 {
        let pixels = self.nodes[node as usize].pixels.iter();
        let radii = pixels.map(|pixel| self.radii[*pixel as usize]);
        radii.fold(0.0, f64::max)
    }

    /// How many branches end at a node.
    pub fn degree(&self, node: u32) -> usize {
        self.nodes[node as usize].branches.len()
    }

    /// Takes away branches that stick out of the disc around their junction by less than `spur` of its width, the
    /// shortest first, and what hooks into the corners of square ends.
    ///
    /// A junction of which two branches are left becomes part of one branch. O(n log n) in branches.
    pub fn cut_spurs(&mut self, spur: f64) {
        let key = |reach: f64, branch: u32| Reverse((reach.max(0.0).to_bits(), branch));
        let mut queue: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
        for branch in 0..self.branches.len() as u32 {
            queue.extend(self.spur(branch, spur).map(|reach| key(reach, branch)));
        }
        while let Some(Reverse((reach, branch))) = queue.pop() {
            // What was joined since may no longer be a spur, or be another one.
            if self
                .spur(branch, spur)
                .map(|reach| reach.max(0.0).to_bits())
                != Some(reach)
            {
                continue;
            }
            let [a, b] = self.branches[branch as usize].ends;
            self.remove(branch);
            for node in [a, b] {
                if let Some(joined) = self.dissolve(node) {
                    queue.extend(self.spur(joined, spur).map(|reach| key(reach, joined)));
                }
            }
        }
        for branch in 0..self.branches.len() as u32 {
            self.unhook(branch);
        }
    }

    /// How far a branch sticks out of the disc around its junction, if it is a spur.
    fn spur(&self, branch: u32, spur: f64) -> Option<f64> {
        let Branch { ends, pixels } = &self.branches[branch as usize];
        let (first, last) = (*pixels.first()?, *pixels.last()?);
        if ends.contains(&NONE) {
            return None;
        }
        let [a, b] = ends.map(|node| self.degree(node));
        let (junction, root, tip) = match (a, b) {
            (1, 3..) => (ends[1], last, first),
            (3.., 1) => (ends[0], first, last),
            _ => return None,
        };
        let disc = self.radius(junction);
        let length = self.place(root).distance(self.place(tip));
        let reach = length + self.radii[tip as usize] - disc;
        // Of lines one and two pixels wide, nothing is rough.
        (reach < spur * (2.0 * disc - 1.0)).then_some(reach)
    }

    pub(super) fn remove(&mut self, branch: u32) {
        for node in self.branches[branch as usize].ends {
            if node != NONE {
                self.nodes[node as usize].branches.retain(|b| *b != branch);
            }
        }
        self.branches[branch as usize] = Branch {
            ends: [NONE; 2],
            pixels: Vec::new(),
        };
    }

    /// Makes one branch of the two at a node; gives its number.
    fn dissolve(&mut self, node: u32) -> Option<u32> {
        let [a, b] = self.nodes[node as usize].branches[..] else {
            return None;
        };
        self.nodes[node as usize].branches.clear();

        // A branch that returns to the node becomes a loose ring.
        if a == b {
            let branch = &mut self.branches[a as usize];
            branch.ends = [NONE; 2];
            if branch.pixels.len() > 1 && branch.pixels.first() == branch.pixels.last() {
                branch.pixels.pop();
            }
            return None;
        }

        // Else turn both so that one leads to the node and the other away.
        let mut first = std::mem::take(&mut self.branches[a as usize]);
        let mut second = std::mem::take(&mut self.branches[b as usize]);
        self.branches[b as usize].ends = [NONE; 2];
        if first.ends[0] == node {
            first.turn();
        }
        if second.ends[1] == node {
            second.turn();
        }

        // Append the other, and tell its far node.
        let shared = first.pixels.last() == second.pixels.first();
        first.pixels.extend(&second.pixels[usize::from(shared)..]);
        let far = second.ends[1];
        first.ends[1] = far;
        for branch in &mut self.nodes[far as usize].branches {
            if *branch == b {
                *branch = a;
            }
        }
        self.branches[a as usize] = first;
        Some(a)
    }

    /// Takes free ends back to where the ink is widest, as long as it swells quickly towards there.
    fn unhook(&mut self, branch: u32) {
        for end in 0..2 {
            let Branch { ends, pixels } = &self.branches[branch as usize];
            let node = ends[end];
            if node == NONE || self.degree(node) != 1 || pixels.len() < 2 {
                continue;
            }
            let at = |k: usize| pixels[if end == 0 { k } else { pixels.len() - 1 - k }];
            let (mut best, mut length) = ((self.radii[at(0) as usize], 0), 0.0);
            for k in 1..pixels.len() {
                length += self.place(at(k)).distance(self.place(at(k - 1)));
                let gain = self.radii[at(k) as usize] - SWELL * length;
                if gain > best.0 {
                    best = (gain, k);
                }
                // Nothing further away can gain as much.
                if length > 4.0 * (best.0 + 1.0) {
                    break;
                }
            }
            let tip = at(best.1);
            let pixels = &mut self.branches[branch as usize].pixels;
            if end == 0 {
                pixels.drain(..best.1);
            } else {
                pixels.truncate(pixels.len() - best.1);
            }
            let node = &mut self.nodes[node as usize];
            (node.pixels, node.joints) = (vec![tip], Vec::new());
        }
    }

    /// How far from a junction's middle lines still run into each other.
    pub fn reach(&self, node: u32) -> f64 {
        self.disc(&self.nodes[node as usize].pixels).1
    }

    /// Where lines still run into each other: middles and radii of a disc for each of the junctions that one was made
    /// of.
    pub(super) fn discs(&self, node: u32) -> Vec<(DVec2, f64)> {
        self.forks(node).map(|pixels| self.disc(pixels)).collect()
    }

    /// Which of the junctions that one was made of has the pixel nearest to a place.
    pub(super) fn fork_at(&self, node: u32, place: DVec2) -> usize {
        let away = |pixel: &u32| self.place(*pixel).distance_squared(place);
        let nearest = |pixels: &[u32]| pixels.iter().map(away).fold(f64::INFINITY, f64::min);
        let forks = self.forks(node).map(nearest).enumerate();
        let first = forks.min_by(|a, b| a.1.total_cmp(&b.1));
        first.map_or(0, |(fork, _)| fork)
    }

    /// The pixels of each of the junctions that one was made of.
    fn forks(&self, node: u32) -> impl Iterator<Item = &[u32]> {
        let Node { pixels, joints, .. } = &self.nodes[node as usize];
        let begins = [0].into_iter().chain(joints.iter().copied());
        let ends = joints.iter().copied().chain([pixels.len()]);
        begins.zip(ends).map(|(from, to)| &pixels[from..to])
    }

    /// The middle of pixels, and how far from it the ink around them reaches.
    fn disc(&self, pixels: &[u32]) -> (DVec2, f64) {
        let places = || pixels.iter().map(|pixel| self.place(*pixel));
        let middle = places().sum::<DVec2>() / pixels.len().max(1) as f64;
        let spread = places()
            .map(|place| place.distance(middle))
            .fold(0.0, f64::max);
        let radii = pixels.iter().map(|pixel| self.radii[*pixel as usize]);
        (middle, spread + radii.fold(0.0, f64::max))
    }
}

impl Branch {
    /// The same branch from its other end.
    pub fn turn(&mut self) {
        self.ends.reverse();
        self.pixels.reverse();
    }
}
