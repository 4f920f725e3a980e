//! Ranking with every node jumping: no node walks first.

use super::jump::{Hop, Reach, Walk, jump_all, rounds_for, start_nodes};
use super::place;
use super::{RankError, Ranked, link};

/// Ranks lists by breaking loops and then ranking, both by pointer jumping [Wyllie 1979; Jiang et al. 2022].
///
/// Input and result are those of [`walk`](super::walk()). `rounds` bounds the rounds of each of the two; by default
/// as many as chains of all nodes would take. Fewer are enough where no chain is longer than `2^rounds`; more than 32
/// change nothing.
///
/// O(n log n) work in O(log n) steps; two buffers alternate.
///
/// Differs: the publication breaks loops at the greatest key, which is a place in the picture, so loops start elsewhere
/// whenever the picture moves; here the least hash of a key that belongs to the mesh. It counts links to the
/// head along successors and subtracts; here nodes look back, so what they count is their rank.
///
/// # Errors
///
/// [`RankError`] where `next` does not describe lists, or the rounds were too few.
pub fn wyllie(next: &[u32], keys: &[u32], rounds: Option<u32>) -> Result<Ranked, RankError> {
    let links = link(next, keys)?;
    let rounds = rounds.unwrap_or_else(|| rounds_for(links.len()));
    let extent = [links.len() as u32];
    let mut first = vec![Reach::default(); links.len()];
    let mut hops = vec![Hop::default(); links.len()];
    let mut walks = vec![Walk::default(); links.len()];
    start_nodes(&links, &mut hops, &mut first, &mut walks);
    let jumped = jump_all(&extent, first, hops, rounds);
    place::finish(&links, &walks, &jumped, rounds)
}
