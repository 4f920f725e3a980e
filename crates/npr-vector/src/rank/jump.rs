//! Ranking by pointer jumping: every node asks the node it points at where that one points.
//!
//! In each round the reach of every node doubles, so a chain of n nodes takes log2(n) rounds, whatever its shape.
//!
//! Every step works on the first `extent[0]` elements: nodes for [`wyllie`](super::wyllie()), splitters for
//! [`ruling_set`](super::ruling_set). Elements after these keep their values; elements that a list has no room for are
//! left out.

use super::Link;
use bytemuck::{Pod, Zeroable};
use npr_core::geometry::NONE;
use npr_core::gpu_layout;
use rayon::prelude::*;

/// How far back an element sees, and which of the nodes that it sees may become the head.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Reach {
    /// The element after the last that is seen, going back; itself at the start of an open chain.
    pub far: u32,
    /// The node with the least `(hash, index)` of those seen.
    pub least: u32,
    /// That node's [`Link::precedence`].
    pub hash: u32,
}
gpu_layout!(Reach { far, least, hash });

impl Reach {
    fn precedes(&self, other: &Reach) -> bool {
        (self.hash, self.least) < (other.hash, other.least)
    }
}

/// A jump back along a chain.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Hop {
    /// Where it leads; from the first element to itself.
    pub far: u32,
    /// Number of links that it passes.
    pub dist: u32,
}
gpu_layout!(Hop { far, dist });

/// Which element a node counts from; elements are ranked by pointer jumping.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Walk {
    /// The element: the node itself for [`wyllie`](super::wyllie()), or the slot of a splitter; [`NONE`] where none was
    /// found.
    pub slot: u32,
    /// Links from there to the node.
    pub steps: u32,
}
gpu_layout!(Walk { slot, steps });

/// Rounds after which chains of up to `node_count` nodes are ranked: log2, rounded up.
pub fn rounds_for(node_count: usize) -> u32 {
    node_count.max(1).next_power_of_two().trailing_zeros()
}

/// What pointer jumping leaves for the steps after it.
#[derive(Debug, Clone, Default)]
pub(super) struct Jumped {
    /// The reaches before the first round.
    pub(super) first: Vec<Reach>,
    /// The reaches after the last.
    pub(super) settled: Vec<Reach>,
    /// The jump from each element to the first of its chain.
    pub(super) hops: Vec<Hop>,
}

/// Breaks loops, then ranks, with the same number of rounds for each.
pub(super) fn jump_all(
    extent: &[u32; 1],
    first: Vec<Reach>,
    hops: Vec<Hop>,
    rounds: u32,
) -> Jumped {
    let rounds = rounds.min(u32::BITS);

    // Find the head of every chain.
    let mut settled = first.clone();
    let mut other_reach = first.clone();
    for _ in 0..rounds {
        break_loops(extent, &settled, &mut other_reach);
        std::mem::swap(&mut settled, &mut other_reach);
    }

    // Cut loops before their heads.
    let mut other_hops = hops.clone();
    cut_loops(extent, &first, &settled, &hops, &mut other_hops);

    // Count the links back to the head.
    let (mut hops, mut other_hops) = (other_hops, hops);
    for _ in 0..rounds {
        rank_jump(extent, &hops, &mut other_hops);
        std::mem::swap(&mut hops, &mut other_hops);
    }
    Jumped {
        first,
        settled,
        hops,
    }
}

/// Every node looks at its predecessor: the twin of `vector.start_nodes`.
pub fn start_nodes(links: &[Link], hops: &mut [Hop], reach: &mut [Reach], walks: &mut [Walk]) {
    let outputs = hops.par_iter_mut().zip(reach).zip(walks);
    (0..links.len() as u32)
        .into_par_iter()
        .zip(outputs)
        .for_each(|(element, ((hop, reach), walk))| {
            let link = links[element as usize];
            let is_start = link.prev == NONE;
            hop.far = if is_start { element } else { link.prev };
            hop.dist = u32::from(!is_start);
            reach.far = hop.far;
            reach.least = element;
            reach.hash = link.precedence();
            walk.slot = element;
            walk.steps = 0;
        });
}

/// One round of finding the head of every chain: the twin of `vector.break_loops`.
pub fn break_loops(extent: &[u32], reach_in: &[Reach], reach_out: &mut [Reach]) {
    let count = (extent[0] as usize).min(reach_out.len());
    reach_out[..count]
        .par_iter_mut()
        .enumerate()
        .for_each(|(element, out)| {
            let here = reach_in[element];
            let there = reach_in[here.far as usize];
            let nearer = if there.precedes(&here) { there } else { here };
            out.far = there.far;
            out.least = nearer.least;
            out.hash = nearer.hash;
        });
}

/// Makes an element the first of its chain where its own first reach holds the chain's head: the twin of
/// `vector.cut_loops`.
///
/// `first` are the reaches before the first round, `settled` after the last.
pub fn cut_loops(
    extent: &[u32],
    first: &[Reach],
    settled: &[Reach],
    hops_in: &[Hop],
    hops_out: &mut [Hop],
) {
    let count = (extent[0] as usize).min(hops_out.len());
    hops_out[..count]
        .par_iter_mut()
        .enumerate()
        .for_each(|(element, out)| {
            let is_first = first[element].least == settled[element].least;
            let hop = hops_in[element];
            out.far = if is_first { element as u32 } else { hop.far };
            out.dist = if is_first { 0 } else { hop.dist };
        });
}

/// One round of ranking: doubles how far each element sees [Wyllie 1979]; the twin of `vector.rank_jump`.
pub fn rank_jump(extent: &[u32], hops_in: &[Hop], hops_out: &mut [Hop]) {
    let count = (extent[0] as usize).min(hops_out.len());
    hops_out[..count]
        .par_iter_mut()
        .enumerate()
        .for_each(|(element, out)| {
            let here = hops_in[element];
            let there = hops_in[here.far as usize];
            out.far = there.far;
            out.dist = here.dist.wrapping_add(there.dist);
        });
}
