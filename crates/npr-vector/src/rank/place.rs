//! From ranked elements to nodes in a row.

use super::jump::{Hop, Jumped, Reach, Walk};
use super::scan::{compact, exclusive_scan};
use super::{Link, RankError, Ranked};
use bytemuck::{Pod, Zeroable};
use npr_core::geometry::NONE;
use npr_core::gpu_layout;
use rayon::prelude::*;

/// Where a node is, counted from where its loop was cut.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct ListPosition {
    /// Head of its chain; [`NONE`] where that is unknown.
    pub head: u32,
    /// Links from the cut, which may lie before the head.
    pub offset: u32,
}
gpu_layout!(ListPosition { head, offset });

/// Where a node is, counted from its head.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Standing {
    /// Head of its chain.
    pub head: u32,
    /// Links from the head.
    pub rank: u32,
    /// Nodes in the chain.
    pub length: u32,
}
gpu_layout!(Standing { head, rank, length });

impl Ranked {
    /// The lists as a device leaves them, once they are checked to be settled.
    ///
    /// `chains` are the heads by index; `starts` has an entry for every node, of which only those of heads are used.
    pub fn from_standings(
        standings: &[Standing],
        order: Vec<u32>,
        starts: &[u32],
        chains: &[u32],
    ) -> Self {
        let field = |of: fn(&Standing) -> u32| standings.iter().map(of).collect();
        let ends = chains.iter().map(|head| starts[*head as usize]);
        Self {
            head: field(|standing| standing.head),
            rank: field(|standing| standing.rank),
            length: field(|standing| standing.length),
            starts: ends.chain([standings.len() as u32]).collect(),
            order,
        }
    }
}

/// The steps after pointer jumping.
pub(super) fn finish(
    links: &[Link],
    walks: &[Walk],
    jumped: &Jumped,
    rounds: u32,
) -> Result<Ranked, RankError> {
    let node_count = links.len();
    let mut places = vec![ListPosition::default(); node_count];
    let mut unsettled = vec![0; node_count];
    let Jumped {
        first,
        settled,
        hops,
    } = jumped;

    // Pass ranks on to all nodes, and refuse them where rounds were too few.
    scatter_ranks(walks, first, settled, hops, &mut places, &mut unsettled);
    let (_, count) = exclusive_scan(&unsettled);
    if count != 0 {
        let count = count as usize;
        return Err(RankError::Unsettled { count, rounds });
    }

    // Count from the heads.
    let mut lengths = vec![0; node_count];
    measure_chains(links, &places, &mut lengths);
    let mut standings = vec![Standing::default(); node_count];
    let (mut sizes, mut heads) = (vec![0; node_count], vec![0; node_count]);
    turn_ranks(&places, &lengths, &mut standings, &mut sizes, &mut heads);

    // Put chains one behind the other.
    let (starts, _) = exclusive_scan(&sizes);
    let mut order = vec![0; node_count];
    order_nodes(&standings, &starts, &mut order);

    // List the heads.
    let (slots, count) = exclusive_scan(&heads);
    let mut chains = vec![0; count as usize];
    compact(&heads, &slots, &mut chains);
    Ok(Ranked::from_standings(&standings, order, &starts, &chains))
}

/// Gives nodes what is known of the elements that they count from: the twin of `vector.scatter_ranks`.
///
/// A node is unsettled, 1 instead of 0, where its element disagrees with the one before about the head of their chain,
/// where that element's hop does not lead to the first of the chain, or where it counts from no element. If no node of
/// a chain is unsettled, all that is known of the chain is right.
pub fn scatter_ranks(
    walks: &[Walk],
    first: &[Reach],
    settled: &[Reach],
    hops: &[Hop],
    places: &mut [ListPosition],
    unsettled: &mut [u32],
) {
    let outputs = places.par_iter_mut().zip(unsettled);
    walks
        .par_iter()
        .zip(outputs)
        .for_each(|(walk, (place, unsettled))| {
            // Nothing is known until the element says it.
            place.head = NONE;
            place.offset = 0;
            *unsettled = 1;
            if walk.slot == NONE {
                return;
            }

            // Ask the element that the node hangs on.
            let slot = walk.slot as usize;
            let (head, hop) = (settled[slot].least, hops[slot]);
            let is_common = settled[first[slot].far as usize].least == head;
            let is_first = hops[hop.far as usize].far == hop.far;
            place.head = head;
            place.offset = hop.dist.wrapping_add(walk.steps);
            *unsettled = u32::from(!(is_common && is_first));
        });
}

/// Writes the length of every chain at its head, from the last node before a cut: the twin of `vector.measure_chains`.
///
/// Only heads get a length; all other entries keep their values.
pub fn measure_chains(links: &[Link], places: &[ListPosition], lengths: &mut [u32]) {
    for (link, place) in links.iter().zip(places) {
        let is_last = link.next == NONE || places[link.next as usize].offset == 0;
        if is_last && (place.head as usize) < lengths.len() {
            lengths[place.head as usize] = place.offset.wrapping_add(1);
        }
    }
}

/// Counts from the head instead of the cut: the twin of `vector.turn_ranks`.
///
/// `sizes` are the lengths of chains at their heads and 0 elsewhere; `heads` are 1 there.
pub fn turn_ranks(
    places: &[ListPosition],
    lengths: &[u32],
    standings: &mut [Standing],
    sizes: &mut [u32],
    heads: &mut [u32],
) {
    let outputs = standings.par_iter_mut().zip(sizes).zip(heads);
    outputs
        .enumerate()
        .for_each(|(element, ((standing, size), is_head))| {
            // Move the start from the cut to the head, around the loop.
            let place = places[element];
            let head = (place.head as usize).min(places.len() - 1);
            let (length, from) = (lengths[head], places[head].offset);
            let wraps = place.offset < from;
            standing.head = place.head;
            standing.rank =
                place
                    .offset
                    .wrapping_sub(from)
                    .wrapping_add(if wraps { length } else { 0 });
            standing.length = length;

            // Let heads alone tell the length.
            *is_head = u32::from(place.head as usize == element);
            *size = if *is_head != 0 { length } else { 0 };
        });
}

/// Puts every node at its place in `order`: the twin of `vector.order_nodes`.
///
/// `starts` is the scan of the sizes of chains.
pub fn order_nodes(standings: &[Standing], starts: &[u32], order: &mut [u32]) {
    for (element, standing) in (0..).zip(standings) {
        let head = (standing.head as usize).min(starts.len() - 1);
        let at = starts[head].wrapping_add(standing.rank) as usize;
        if at < order.len() {
            order[at] = element;
        }
    }
}
