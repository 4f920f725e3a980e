//! Ranking by following the links.

use super::{Link, RankError, Ranked, link};
use npr_core::geometry::NONE;

/// Ranks lists by walking along them: what every other way must equal, and the fastest on a processor.
///
/// `next[i]` is the node after `i`, [`NONE`] after the last; lists may be interleaved in any order. `keys[i]` stays
/// with node `i` from frame to frame and may repeat.
///
/// O(n), in one thread.
///
/// # Errors
///
/// [`RankError`] where `next` does not describe lists.
pub fn walk(next: &[u32], keys: &[u32]) -> Result<Ranked, RankError> {
    // Elect the heads.
    let links = link(next, keys)?;
    let heads = elect_heads(&links);
    let mut ranked = Ranked {
        head: vec![0; links.len()],
        rank: vec![0; links.len()],
        length: vec![0; links.len()],
        order: Vec::with_capacity(links.len()),
        starts: Vec::with_capacity(heads.len() + 1),
    };
    for head in heads {
        // Follow each chain, and count.
        let start = ranked.order.len();
        ranked.starts.push(start as u32);
        ranked.order.extend(chain_from(&links, head));
        let chain = &ranked.order[start..];
        for (rank, node) in (0..).zip(chain) {
            ranked.head[*node as usize] = head;
            ranked.rank[*node as usize] = rank;
            ranked.length[*node as usize] = chain.len() as u32;
        }
    }
    ranked.starts.push(links.len() as u32);
    Ok(ranked)
}

/// The heads of all chains by index.
fn elect_heads(links: &[Link]) -> Vec<u32> {
    let mut is_seen = vec![false; links.len()];
    let mut heads = Vec::new();
    let starts = (0..links.len() as u32).filter(|node| links[*node as usize].prev == NONE);
    // Open chains first: what is left then are loops, which can be entered anywhere.
    for from in starts.chain(0..links.len() as u32) {
        if is_seen[from as usize] {
            continue;
        }
        let precedence = |node: &u32| (links[*node as usize].precedence(), *node);
        let chain = chain_from(links, from).inspect(|node| is_seen[*node as usize] = true);
        heads.extend(chain.min_by_key(precedence));
    }
    heads.sort_unstable();
    heads
}

/// A node and those that follow it, once each.
fn chain_from(links: &[Link], from: u32) -> impl Iterator<Item = u32> + '_ {
    std::iter::successors(Some(from), move |node| {
        let next = links[*node as usize].next;
        (next != NONE && next != from).then_some(next)
    })
}
