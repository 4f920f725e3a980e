//! Ranking by a ruling set: a few nodes are ranked by pointer jumping, all others count from them.
//!
//! Pointer jumping touches every node in every round. Here about every seventeenth node becomes a splitter; only
//! those jump.

use super::jump::{Hop, Reach, Walk, break_loops, cut_loops, jump_all, rank_jump, rounds_for};
use super::place;
use super::scan::{compact, exclusive_scan};
use super::{Link, RankError, Ranked, link};
use npr_core::geometry::NONE;
use npr_core::math::mix_bits;
use rayon::prelude::*;

/// Links that a node looks along, each way, before it calls itself a splitter.
///
/// Splitters are farther apart than this, so there are at most a ninth as many as nodes, and one to every short loop.
pub const WINDOW: u32 = 8;

/// Most links that a node walks back to a splitter.
///
/// Among a million nodes in random order the longest walk is near 80. Only an order made for the purpose is worse,
/// and is reported: walks without a limit could stop a graphics device.
pub const WALK_LIMIT: u32 = 512;

/// Rounds after which chains of up to `node_count` nodes have ranked their splitters.
pub fn splitter_rounds_for(node_count: usize) -> u32 {
    // The start of an open chain is a splitter however near the next is.
    rounds_for(node_count / (WINDOW as usize + 1) + 2)
}

/// Ranks lists by ranking splitters [Helman & JáJá 1999; Rehman et al. 2009].
///
/// Input and result are those of [`walk`](super::walk()). `rounds` bounds the rounds of pointer jumping among
/// splitters; by default as many as chains of all nodes would take.
///
/// O(n) work but for the splitters' O(n/17 log n), in O(log n) steps.
///
/// Differs: the papers take splitters at regular places of memory, or at random; here those with the least hash in
/// a window, so no two are neighbours and short loops get one too. The hash is of the node's index, not
/// of its key: keys may be equal or in order along a list, and walks would become long.
///
/// # Errors
///
/// [`RankError`] where `next` does not describe lists, the rounds were too few, or more than [`WALK_LIMIT`] nodes in
/// a row hold no splitter.
pub fn ruling_set(next: &[u32], keys: &[u32], rounds: Option<u32>) -> Result<Ranked, RankError> {
    let links = link(next, keys)?;
    let rounds = rounds.unwrap_or_else(|| splitter_rounds_for(links.len()));
    let mut flags = vec![0; links.len()];
    find_splitters(&links, &mut flags);
    let (slots, count) = exclusive_scan(&flags);
    let mut walks = vec![Walk::default(); links.len()];
    walk_to_splitter(&links, &flags, &slots, &mut walks);

    let mut splitters = vec![0; count as usize];
    compact(&flags, &slots, &mut splitters);
    let mut first = vec![Reach::default(); splitters.len()];
    let mut hops = vec![Hop::default(); splitters.len()];
    start_splitters(&[count], &links, &splitters, &walks, &mut hops, &mut first);
    let jumped = jump_all(&[count], first, hops, rounds);
    place::finish(&links, &walks, &jumped, rounds)
}

/// Marks the nodes whose hash is the least among [`WINDOW`] nodes each way, and the starts of open chains: the twin of
/// `vector.find_splitters`.
pub fn find_splitters(links: &[Link], flags: &mut [u32]) {
    flags
        .par_iter_mut()
        .enumerate()
        .for_each(|(element, flag)| {
            *flag = u32::from(is_splitter(links, element as u32));
        });
}

fn is_splitter(links: &[Link], element: u32) -> bool {
    // Take the starts of open chains.
    if links[element as usize].prev == NONE {
        return true;
    }

    // Take nodes whose hash is the least within the window.
    let own = mix_bits(element);
    let (mut ahead, mut behind) = (element, element);
    for _ in 0..WINDOW {
        if ahead != NONE {
            ahead = links[ahead as usize].next;
        }
        if behind != NONE {
            behind = links[behind as usize].prev;
        }
        if ahead != NONE && mix_bits(ahead) < own {
            return false;
        }
        if behind != NONE && mix_bits(behind) < own {
            return false;
        }
    }
    true
}

/// Every node counts its links back to the nearest splitter, 0 from a splitter: the twin of `vector.walk_to_splitter`.
pub fn walk_to_splitter(links: &[Link], flags: &[u32], slots: &[u32], walks: &mut [Walk]) {
    walks
        .par_iter_mut()
        .enumerate()
        .for_each(|(element, walk)| {
            let mut at = element as u32;
            let mut steps = 0;
            while flags[at as usize] == 0 && steps < WALK_LIMIT {
                at = links[at as usize].prev;
                steps += 1;
            }
            let found = flags[at as usize] != 0;
            walk.slot = if found { slots[at as usize] } else { NONE };
            walk.steps = steps;
        });
}

/// Every splitter finds the one before it: the twin of `vector.start_splitters`.
///
/// On the way back it finds the least of the nodes in between, since any of them may be the head of the chain.
pub fn start_splitters(
    extent: &[u32],
    links: &[Link],
    splitters: &[u32],
    walks: &[Walk],
    hops: &mut [Hop],
    reach: &mut [Reach],
) {
    let count = extent[0] as usize;
    hops[..count]
        .par_iter_mut()
        .zip(&mut reach[..count])
        .enumerate()
        .for_each(|(slot, (hop, reach))| {
            let node = splitters[slot];
            let link = links[node as usize];
            reach.least = node;
            reach.hash = link.precedence();
            hop.far = slot as u32;
            hop.dist = 0;
            if link.prev != NONE {
                let before = walks[link.prev as usize];
                // A walk that was too long is reported by the node that walked it.
                if before.slot != NONE {
                    hop.far = before.slot;
                    hop.dist = before.steps + 1;
                }
            }
            let mut at = node;
            for _ in 1..hop.dist.max(1) {
                at = links[at as usize].prev;
                let hash = links[at as usize].precedence();
                if hash < reach.hash || (hash == reach.hash && at < reach.least) {
                    reach.least = at;
                    reach.hash = hash;
                }
            }
            reach.far = hop.far;
        });
}

/// The memory of [`rank_splitters`]; scratch has the size of what it serves.
#[derive(Debug)]
pub struct Workspace<'a> {
    /// Receives the reaches after the last round.
    pub settled: &'a mut [Reach],
    /// Written between rounds.
    pub reach_scratch: &'a mut [Reach],
    /// Receives the hops after the last round.
    pub hops: &'a mut [Hop],
    /// Written between rounds.
    pub hops_scratch: &'a mut [Hop],
}

/// All rounds of pointer jumping at once, for lists so short that one workgroup does better than many passes: the
/// twin of `vector.rank_splitters`.
///
/// `first` and `hops_in` are those of [`start_splitters`]. The result is that of [`break_loops`], [`cut_loops`] and
/// [`rank_jump`].
pub fn rank_splitters(
    rounds: u32,
    extent: &[u32],
    first: &[Reach],
    hops_in: &[Hop],
    into: Workspace<'_>,
) {
    let elements = ..extent[0] as usize;
    // More rounds would change nothing.
    let rounds = rounds.min(rounds_for(extent[0] as usize));
    let Workspace {
        settled,
        reach_scratch,
        hops,
        hops_scratch,
    } = into;
    settled[elements].copy_from_slice(&first[elements]);
    for _ in 0..rounds {
        break_loops(extent, settled, reach_scratch);
        settled[elements].copy_from_slice(&reach_scratch[elements]);
    }
    cut_loops(extent, first, settled, hops_in, hops);
    for _ in 0..rounds {
        rank_jump(extent, hops, hops_scratch);
        hops[elements].copy_from_slice(&hops_scratch[elements]);
    }
}
