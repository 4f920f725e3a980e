//! Passes that number elements by sums.

use super::work::ListWork;
use crate::graph::{Graph, ResourceId};
use crate::passes::vector;
use npr_vector::rank::scan::BLOCK;

/// The resources that [`add_scan`] adds to a graph.
#[derive(Debug, Clone, Copy)]
pub struct Scan {
    /// The sum of all values before each.
    pub prefixes: ResourceId,
    /// The sum of all values: one element.
    pub total: ResourceId,
}

/// Appends passes that sum up a buffer of `u32`, as far as the work reaches.
///
/// One pass up to 512 values, two more for every 512 times as many. Sums wrap.
pub fn add_scan(graph: &mut Graph, values: ResourceId, work: &ListWork) -> Scan {
    add_scan_of_level(graph, values, work, 0)
}

fn add_scan_of_level(graph: &mut Graph, values: ResourceId, work: &ListWork, level: u32) -> Scan {
    let count = graph.element_count(values);
    let [prefixes, total] = add_blocks(graph, values, work, level);
    if count <= BLOCK {
        return Scan { prefixes, total };
    }
    let offsets = add_scan_of_level(graph, total, work, level + 1);
    let whole = graph.buffer::<u32>("prefixes", count);
    let bound = [prefixes, offsets.prefixes, whole];
    graph.compute_sized(&vector::SCAN_ADD, &bound, work.level(level));
    Scan {
        prefixes: whole,
        total: offsets.total,
    }
}

/// Appends sums within blocks, and of blocks.
fn add_blocks(
    graph: &mut Graph,
    values: ResourceId,
    work: &ListWork,
    level: u32,
) -> [ResourceId; 2] {
    let count = graph.element_count(values);
    let prefixes = graph.buffer::<u32>("prefixes within blocks", count);
    let sums = graph.buffer::<u32>("sums of blocks", count.div_ceil(BLOCK).max(1));
    let bound = [values, prefixes, sums];
    graph.compute_sized(&vector::SCAN_BLOCKS, &bound, work.level(level));
    [prefixes, sums]
}

/// Appends passes that sum up a buffer of `u32`, as far as the work reaches, into one element, which is given back. The
/// sum wraps.
pub fn add_sum(graph: &mut Graph, values: ResourceId, work: &ListWork) -> ResourceId {
    let mut sums = values;
    for level in 0.. {
        let count = graph.element_count(sums);
        [_, sums] = add_blocks(graph, sums, work, level);
        if count <= BLOCK {
            break;
        }
    }
    sums
}

/// The indices of marked elements, in order.
#[derive(Debug, Clone, Copy)]
pub struct Compacted {
    /// The indices.
    pub list: ResourceId,
    /// Number of marked elements: one element.
    pub count: ResourceId,
    /// Where each marked element is in the list.
    pub slots: ResourceId,
}

/// Appends passes that list the indices of marked elements in order; `flags` are 0 or 1, and are read as far as the
/// work reaches.
///
/// `capacity` is the room in the list. If more elements are marked, the count tells, and later ones are left out.
pub fn add_compact(
    graph: &mut Graph,
    flags: ResourceId,
    capacity: usize,
    work: &ListWork,
) -> Compacted {
    let Scan { prefixes, total } = add_scan(graph, flags, work);
    let list = graph.buffer::<u32>("marked elements", capacity);
    graph.compute_sized(&vector::COMPACT, &[flags, prefixes, list], work.elements());
    Compacted {
        list,
        count: total,
        slots: prefixes,
    }
}
