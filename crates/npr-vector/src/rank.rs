//! Linked lists to arrays: which line every node belongs to, and its place along that line.
//!
//! Producers of lines leave nodes that only know their successor. Drawing a line needs its nodes in a row: where it
//! starts, how long it is, which node comes when. [`walk()`] follows the links one by one and is what to use on a
//! processor. [`wyllie`] and [`ruling_set`] give the same by steps in which all nodes work at once, as a graphics
//! device does; their steps are the twins of the passes `vector.*` and are in [`jump`], [`splitter`], [`place`] and
//! [`scan`]; [`work`] says how much work they have.
//!
//! A closed loop has no end of its own, so a head is chosen by a key that stays with a place on the mesh:
//! the same drawing a frame later starts its loops at the same places.
//!
//! ```
//! use npr_core::geometry::NONE;
//! // An open line 2 -> 0 -> 3 and a loop of one node.
//! let ranked = npr_vector::rank::walk(&[3, 1, 0, NONE], &[0; 4])?;
//! assert_eq!(ranked.order, [1, 2, 0, 3]);
//! assert_eq!(ranked.starts, [0, 1, 4]);
//! # Ok::<(), npr_vector::rank::RankError>(())
//! ```

pub mod jump;
pub mod place;
pub mod scan;
pub mod splitter;
#[cfg(test)]
mod tests;
mod walk;
pub mod work;
mod wyllie;

pub use jump::rounds_for;
pub use splitter::{ruling_set, splitter_rounds_for};
pub use walk::walk;
pub use wyllie::wyllie;

use crate::mesh_lines::graph::CurveGraph;
use bytemuck::{Pod, Zeroable};
use npr_core::geometry::NONE;
use npr_core::gpu_layout;
use npr_core::math::mix_bits;

/// Lists in the order of their nodes.
///
/// Everything is decided by `next` and the keys alone: all ways of ranking give equal values.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Ranked {
    /// The first node of every node's chain: the start of an open chain, or the node of a loop whose
    /// `(hash_key(key), index)` is least.
    pub head: Vec<u32>,
    /// Number of links from the head to every node.
    pub rank: Vec<u32>,
    /// Number of nodes in every node's chain.
    pub length: Vec<u32>,
    /// All nodes: chains by the index of their head, nodes of a chain by rank.
    pub order: Vec<u32>,
    /// Where each chain starts in `order`; one more than there are chains, so the last is the number of nodes.
    pub starts: Vec<u32>,
}

impl Ranked {
    /// The nodes of every chain, each from its head on.
    pub fn chains(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        self.starts
            .windows(2)
            .map(|pair| &self.order[pair[0] as usize..pair[1] as usize])
    }

    /// Asserts what the type promises, for lists linked by `next`.
    ///
    /// # Panics
    ///
    /// When a promise is broken, naming it.
    pub fn sanity_check(&self, next: &[u32]) {
        // Check that the chains hold every node once, each from its head.
        assert_eq!(self.order.len(), next.len(), "every node once");
        let mut heads = Vec::new();
        for chain in self.chains() {
            heads.push(chain[0]);
            for (rank, node) in (0..).zip(chain) {
                let at = *node as usize;
                assert_eq!(self.head[at], chain[0], "head of node {node}");
                assert_eq!(self.rank[at], rank, "rank of node {node}");
                assert_eq!(
                    self.length[at] as usize,
                    chain.len(),
                    "length at node {node}"
                );
                let following = chain.get(rank as usize + 1);
                let ends = following.is_none() && next[at] == NONE;
                let goes_on = next[at] == *following.unwrap_or(&chain[0]);
                assert!(ends || goes_on, "successor of node {node}");
            }
        }
        assert!(heads.is_sorted(), "chains by the index of their head");
    }
}

/// Ranks the nodes of a curve graph; their mesh edges are the keys.
///
/// # Errors
///
/// [`RankError`] where the links of the graph are no lists.
pub fn rank_curves(graph: &CurveGraph) -> Result<Ranked, RankError> {
    let (next, keys): (Vec<u32>, Vec<u32>) = graph
        .nodes
        .iter()
        .map(|node| (node.next, node.edge))
        .unzip();
    walk(&next, &keys)
}

/// Why lists were not ranked.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RankError {
    /// Every node needs a key.
    #[error("there are {node_count} nodes, but {key_count} keys")]
    KeyCount {
        /// Number of successors given.
        node_count: usize,
        /// Number of keys given.
        key_count: usize,
    },
    /// Node numbers do not fit 32 bits.
    #[error("{node_count} nodes are more than lists can hold")]
    TooManyNodes {
        /// Number of successors given.
        node_count: usize,
    },
    /// A link leads nowhere.
    #[error("node {node} is followed by node {next}, but there are only {node_count}")]
    MissingNode {
        /// The node.
        node: u32,
        /// Its successor as read.
        next: u32,
        /// Number of nodes.
        node_count: usize,
    },
    /// Two lists run into each other.
    #[error("nodes {first} and {second} are both followed by node {next}")]
    SharedNode {
        /// The node that was read first.
        first: u32,
        /// The other one.
        second: u32,
        /// Their successor.
        next: u32,
    },
    /// The rounds or steps allowed were too few.
    #[error("{count} nodes were not ranked within {rounds} rounds")]
    Unsettled {
        /// Nodes whose place is not known; at least one of every chain that failed.
        count: usize,
        /// Rounds of pointer jumping that were allowed.
        rounds: u32,
    },
}

/// A node of a list, linked both ways.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Link {
    /// Successor, or [`NONE`] at the end of an open chain.
    pub next: u32,
    /// Predecessor, or [`NONE`] at the start of an open chain.
    pub prev: u32,
    /// Stays with the node from frame to frame.
    pub key: u32,
}
gpu_layout!(Link { next, prev, key });

impl Link {
    /// The order in which nodes of a chain may be its head, with ties broken by their index: the least is the head.
    ///
    /// 0 at the start of an open chain, and only there.
    pub fn precedence(&self) -> u32 {
        if self.prev == NONE {
            0
        } else {
            hash_key(self.key)
        }
    }
}

/// Spreads a key over the numbers from 1, so that neighbouring keys do not elect neighbouring heads.
///
/// It is [`mix_bits`], except that 0 is left for the starts of open chains: the key that would give 0 gives 1.
pub fn hash_key(key: u32) -> u32 {
    mix_bits(key).max(1)
}

/// Adds predecessors and keys to successors, and checks that they form lists.
///
/// A node without successor has [`NONE`]; one that follows itself is a loop of one. O(n).
///
/// # Errors
///
/// [`RankError`] for a successor that does not exist, or that follows two nodes.
pub fn link(next: &[u32], keys: &[u32]) -> Result<Vec<Link>, RankError> {
    // Refuse what cannot be lists.
    let node_count = next.len();
    if keys.len() != node_count {
        let key_count = keys.len();
        return Err(RankError::KeyCount {
            node_count,
            key_count,
        });
    }
    if u32::try_from(node_count).is_err() {
        return Err(RankError::TooManyNodes { node_count });
    }

    // Point back along every link; two that lead to one node are no list.
    let mut links: Vec<_> = next
        .iter()
        .zip(keys)
        .map(|(next, key)| Link {
            next: *next,
            prev: NONE,
            key: *key,
        })
        .collect();
    for (node, next) in (0..).zip(next) {
        let next = *next;
        if next == NONE {
            continue;
        }
        let Some(follower) = links.get_mut(next as usize) else {
            return Err(RankError::MissingNode {
                node,
                next,
                node_count,
            });
        };
        if follower.prev != NONE {
            let (first, second) = (follower.prev, node);
            return Err(RankError::SharedNode {
                first,
                second,
                next,
            });
        }
        follower.prev = node;
    }
    Ok(links)
}
