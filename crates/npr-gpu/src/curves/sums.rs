//! Passes that number elements by sums.

use crate::graph::{Graph, ResourceId};
use crate::passes::vector;
use npr_vector::rank::scan::BLOCK;

/// What [`add_scan`] leaves in a graph.
#[derive(Debug, Clone, Copy)]
pub struct Scan {
    /// The sum of all values before each.
    pub prefixes: ResourceId,
    /// The sum of all values: one element.
    pub total: ResourceId,
}

/// Appends passes that sum up a buffer of `u32`.
///
/// Three passes up to 4096 values, two more for every 64 times as many. Sums wrap.
pub fn add_scan(graph: &mut Graph, values: ResourceId) -> Scan {
    let count = graph.element_count(values);
    let prefixes = graph.buffer::<u32>("prefixes within blocks", count);
    let total = graph.buffer::<u32>("sums of blocks", count.div_ceil(BLOCK).max(1));
    graph.compute(&vector::SCAN_BLOCKS, &[values, prefixes, total]);
    if count <= BLOCK {
        return Scan { prefixes, total };
    }
    let offsets = add_scan(graph, total);
    let whole = graph.buffer::<u32>("prefixes", count);
    graph.compute(&vector::SCAN_ADD, &[prefixes, offsets.prefixes, whole]);
    Scan {
        prefixes: whole,
        total: offsets.total,
    }
}

/// Appends passes that sum up a buffer of `u32` into one element, which it gives. The sum wraps.
pub fn add_sum(graph: &mut Graph, values: ResourceId) -> ResourceId {
    let mut sums = values;
    loop {
        let count = graph.element_count(sums);
        let prefixes = graph.buffer::<u32>("prefixes within blocks", count);
        let above = graph.buffer::<u32>("sums of blocks", count.div_ceil(BLOCK).max(1));
        graph.compute(&vector::SCAN_BLOCKS, &[sums, prefixes, above]);
        if count <= BLOCK {
            return above;
        }
        sums = above;
    }
}

/// The indices of marked elements, in order.
#[derive(Debug, Clone, Copy)]
pub struct Compacted {
    /// The indices.
    pub list: ResourceId,
    /// How many elements are marked: one element.
    pub count: ResourceId,
    /// Where each marked element is in the list.
    pub slots: ResourceId,
}

/// Appends passes that put the indices of marked elements in a row; `flags` are 0 or 1.
///
/// `capacity` is the room in the list. Where more elements are marked the count says so, and the rest is left out.
pub fn add_compact(graph: &mut Graph, flags: ResourceId, capacity: usize) -> Compacted {
    let Scan { prefixes, total } = add_scan(graph, flags);
    let list = graph.buffer::<u32>("marked elements", capacity);
    graph.compute(&vector::COMPACT, &[flags, prefixes, list]);
    Compacted {
        list,
        count: total,
        slots: prefixes,
    }
}
