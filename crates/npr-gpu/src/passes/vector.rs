//! Passes that link points to lines and rank them.
//!
//! [`crate::curves`] lines them up. Passes with an `extent` work on as many elements as its first element holds, since
//! their number is found on the device; elements after them keep their values. [`SIZE_WORK`] makes the sizes of passes
//! that work on no more workgroups than hold a list.

use crate::pass::{Agreement, Pass, Work, read, uniform, write};
use npr_vector::mesh_lines::contour::steps::{self, HalfEdge, Marked, Viewer};
use npr_vector::mesh_lines::graph::CurveNode;
use npr_vector::rank::jump::Walk;
use npr_vector::rank::jump::{self, Hop, Reach};
use npr_vector::rank::place::{self, ListPosition, Standing};
use npr_vector::rank::work::{Arguments, WorkRule, size_work};
use npr_vector::rank::{Link, scan, splitter};

/// Which faces are turned to the eye.
pub const FACE_EYE: Pass = Pass {
    name: "vector.face_eye",
    shader: npr_shaders::VECTOR_FACE_EYE,
    slots: &[
        uniform::<Viewer>("viewer"),
        read::<f32>("positions"),
        read::<u32>("corners"),
        read::<u32>("judges"),
        write::<u32>("front"),
    ],
    work: Work::PerElement { of: "judges" },
    agreement: Agreement::Exact,
    twin: |b| steps::face_eye(&b.one(0), b.read(1), b.read(2), b.read(3), b.write(4)),
};

/// Marks the half-edges of front faces that have no front face across.
pub const MARK_CONTOURS: Pass = Pass {
    name: "vector.mark_contours",
    shader: npr_shaders::VECTOR_MARK_CONTOURS,
    slots: &[
        read::<u32>("front"),
        read::<HalfEdge>("half_edges"),
        write::<u32>("flags"),
    ],
    work: Work::PerElement { of: "half_edges" },
    agreement: Agreement::Exact,
    twin: |b| steps::mark_contours(b.read(0), b.read(1), b.write(2)),
};

/// Marked half-edges become nodes of closed lines.
pub const LINK_CONTOURS: Pass = Pass {
    name: "vector.link_contours",
    shader: npr_shaders::VECTOR_LINK_CONTOURS,
    slots: &[
        uniform::<Viewer>("viewer"),
        read::<u32>("extent"),
        read::<u32>("contours"),
        read::<u32>("slots"),
        read::<u32>("flags"),
        read::<HalfEdge>("half_edges"),
        read::<f32>("positions"),
        write::<CurveNode>("nodes"),
    ],
    work: Work::PerElement { of: "contours" },
    agreement: Agreement::Exact,
    twin: |b| {
        let viewer = b.one(0);
        let on = Marked {
            viewer: &viewer,
            extent: b.read(1),
            contours: b.read(2),
            slots: b.read(3),
            flags: b.read(4),
            half_edges: b.read(5),
            positions: b.read(6),
        };
        steps::link_contours(&on, b.write(7));
    },
};

/// Links of nodes, in the form that ranking reads.
pub const LIST_NODES: Pass = Pass {
    name: "vector.list_nodes",
    shader: npr_shaders::VECTOR_LIST_NODES,
    slots: &[
        read::<u32>("extent"),
        read::<CurveNode>("nodes"),
        write::<Link>("links"),
    ],
    work: Work::PerElement { of: "nodes" },
    agreement: Agreement::Exact,
    twin: |b| steps::list_nodes(b.read(0), b.read(1), b.write(2)),
};

/// The sizes of all passes that follow the length of a list.
pub const SIZE_WORK: Pass = Pass {
    name: "vector.size_work",
    shader: npr_shaders::VECTOR_SIZE_WORK,
    slots: &[
        uniform::<WorkRule>("rule"),
        read::<u32>("extent"),
        write::<Arguments>("arguments"),
    ],
    work: Work::PerElement { of: "arguments" },
    agreement: Agreement::Exact,
    twin: |b| size_work(&b.one(0), b.read(1), b.write(2)),
};

/// Sums within blocks of 512 values.
pub const SCAN_BLOCKS: Pass = Pass {
    name: "vector.scan_blocks",
    shader: npr_shaders::VECTOR_SCAN_BLOCKS,
    slots: &[
        read::<u32>("values"),
        write::<u32>("prefixes"),
        write::<u32>("sums"),
    ],
    work: Work::PerRun { of: "values" },
    agreement: Agreement::Exact,
    twin: |b| scan::scan_blocks(b.read(0), b.write(1), b.write(2)),
};

/// Sums within blocks become sums over all.
pub const SCAN_ADD: Pass = Pass {
    name: "vector.scan_add",
    shader: npr_shaders::VECTOR_SCAN_ADD,
    slots: &[
        read::<u32>("prefixes_in"),
        read::<u32>("offsets"),
        write::<u32>("prefixes_out"),
    ],
    work: Work::PerRun { of: "prefixes_in" },
    agreement: Agreement::Exact,
    twin: |b| scan::scan_add(b.read(0), b.read(1), b.write(2)),
};

/// Indices of marked elements in a row.
pub const COMPACT: Pass = Pass {
    name: "vector.compact",
    shader: npr_shaders::VECTOR_COMPACT,
    slots: &[
        read::<u32>("flags"),
        read::<u32>("slots"),
        write::<u32>("list"),
    ],
    work: Work::PerElement { of: "flags" },
    agreement: Agreement::Exact,
    twin: |b| scan::compact(b.read(0), b.read(1), b.write(2)),
};

/// Every node of a list finds its predecessor.
pub const START_NODES: Pass = Pass {
    name: "vector.start_nodes",
    shader: npr_shaders::VECTOR_START_NODES,
    slots: &[
        read::<Link>("links"),
        write::<Hop>("hops"),
        write::<Reach>("reach"),
        write::<Walk>("walks"),
    ],
    work: Work::PerElement { of: "links" },
    agreement: Agreement::Exact,
    twin: |b| jump::start_nodes(b.read(0), b.write(1), b.write(2), b.write(3)),
};

/// One round of finding heads: doubles how far each element sees.
pub const BREAK_LOOPS: Pass = Pass {
    name: "vector.break_loops",
    shader: npr_shaders::VECTOR_BREAK_LOOPS,
    slots: &[
        read::<u32>("extent"),
        read::<Reach>("reach_in"),
        write::<Reach>("reach_out"),
    ],
    work: Work::PerElement { of: "reach_in" },
    agreement: Agreement::Exact,
    twin: |b| jump::break_loops(b.read(0), b.read(1), b.write(2)),
};

/// Elements whose first reach holds their chain's head become the first of their chains.
pub const CUT_LOOPS: Pass = Pass {
    name: "vector.cut_loops",
    shader: npr_shaders::VECTOR_CUT_LOOPS,
    slots: &[
        read::<u32>("extent"),
        read::<Reach>("first"),
        read::<Reach>("settled"),
        read::<Hop>("hops_in"),
        write::<Hop>("hops_out"),
    ],
    work: Work::PerElement { of: "hops_in" },
    agreement: Agreement::Exact,
    twin: |b| jump::cut_loops(b.read(0), b.read(1), b.read(2), b.read(3), b.write(4)),
};

/// One round of list ranking: doubles how far each element sees.
pub const RANK_JUMP: Pass = Pass {
    name: "vector.rank_jump",
    shader: npr_shaders::VECTOR_RANK_JUMP,
    slots: &[
        read::<u32>("extent"),
        read::<Hop>("hops_in"),
        write::<Hop>("hops_out"),
    ],
    work: Work::PerElement { of: "hops_in" },
    agreement: Agreement::Exact,
    twin: |b| jump::rank_jump(b.read(0), b.read(1), b.write(2)),
};

/// Marks the nodes that others count from.
pub const FIND_SPLITTERS: Pass = Pass {
    name: "vector.find_splitters",
    shader: npr_shaders::VECTOR_FIND_SPLITTERS,
    slots: &[read::<Link>("links"), write::<u32>("flags")],
    work: Work::PerElement { of: "links" },
    agreement: Agreement::Exact,
    twin: |b| splitter::find_splitters(b.read(0), b.write(1)),
};

/// Every node counts back to its splitter.
pub const WALK_TO_SPLITTER: Pass = Pass {
    name: "vector.walk_to_splitter",
    shader: npr_shaders::VECTOR_WALK_TO_SPLITTER,
    slots: &[
        read::<Link>("links"),
        read::<u32>("flags"),
        read::<u32>("slots"),
        write::<Walk>("walks"),
    ],
    work: Work::PerElement { of: "links" },
    agreement: Agreement::Exact,
    twin: |b| splitter::walk_to_splitter(b.read(0), b.read(1), b.read(2), b.write(3)),
};

/// Every splitter finds the one before it.
pub const START_SPLITTERS: Pass = Pass {
    name: "vector.start_splitters",
    shader: npr_shaders::VECTOR_START_SPLITTERS,
    slots: &[
        read::<u32>("extent"),
        read::<Link>("links"),
        read::<u32>("splitters"),
        read::<Walk>("walks"),
        write::<Hop>("hops"),
        write::<Reach>("reach"),
    ],
    work: Work::PerElement { of: "splitters" },
    agreement: Agreement::Exact,
    twin: |b| {
        let (hops, reach) = (b.write(4), b.write(5));
        splitter::start_splitters(b.read(0), b.read(1), b.read(2), b.read(3), hops, reach);
    },
};

/// All rounds at once, for short lists: one workgroup, since one element is counted.
pub const RANK_SPLITTERS: Pass = Pass {
    name: "vector.rank_splitters",
    shader: npr_shaders::VECTOR_RANK_SPLITTERS,
    slots: &[
        uniform::<u32>("rounds"),
        read::<u32>("extent"),
        read::<Reach>("first"),
        read::<Hop>("hops_in"),
        write::<Reach>("settled"),
        write::<Reach>("reach_scratch"),
        write::<Hop>("hops"),
        write::<Hop>("hops_scratch"),
    ],
    work: Work::PerElement { of: "extent" },
    agreement: Agreement::Exact,
    twin: |b| {
        let into = splitter::Workspace {
            settled: b.write(4),
            reach_scratch: b.write(5),
            hops: b.write(6),
            hops_scratch: b.write(7),
        };
        splitter::rank_splitters(b.one(0), b.read(1), b.read(2), b.read(3), into);
    },
};

/// Nodes get what is known of the elements that they count from, and whether that is settled.
pub const SCATTER_RANKS: Pass = Pass {
    name: "vector.scatter_ranks",
    shader: npr_shaders::VECTOR_SCATTER_RANKS,
    slots: &[
        read::<Walk>("walks"),
        read::<Reach>("first"),
        read::<Reach>("settled"),
        read::<Hop>("hops"),
        write::<ListPosition>("places"),
        write::<u32>("unsettled"),
    ],
    work: Work::PerElement { of: "walks" },
    agreement: Agreement::Exact,
    twin: |b| {
        let (places, unsettled) = (b.write(4), b.write(5));
        place::scatter_ranks(
            b.read(0),
            b.read(1),
            b.read(2),
            b.read(3),
            places,
            unsettled,
        );
    },
};

/// Heads get the lengths of their chains.
pub const MEASURE_CHAINS: Pass = Pass {
    name: "vector.measure_chains",
    shader: npr_shaders::VECTOR_MEASURE_CHAINS,
    slots: &[
        read::<Link>("links"),
        read::<ListPosition>("places"),
        write::<u32>("lengths"),
    ],
    work: Work::PerElement { of: "places" },
    agreement: Agreement::Exact,
    twin: |b| place::measure_chains(b.read(0), b.read(1), b.write(2)),
};

/// Ranks from the head, lengths of chains, marks of heads.
pub const TURN_RANKS: Pass = Pass {
    name: "vector.turn_ranks",
    shader: npr_shaders::VECTOR_TURN_RANKS,
    slots: &[
        read::<ListPosition>("places"),
        read::<u32>("lengths"),
        write::<Standing>("standings"),
        write::<u32>("sizes"),
        write::<u32>("heads"),
    ],
    work: Work::PerElement { of: "places" },
    agreement: Agreement::Exact,
    twin: |b| place::turn_ranks(b.read(0), b.read(1), b.write(2), b.write(3), b.write(4)),
};

/// The nodes of all chains in a row.
pub const ORDER_NODES: Pass = Pass {
    name: "vector.order_nodes",
    shader: npr_shaders::VECTOR_ORDER_NODES,
    slots: &[
        read::<Standing>("standings"),
        read::<u32>("starts"),
        write::<u32>("order"),
    ],
    work: Work::PerElement { of: "standings" },
    agreement: Agreement::Exact,
    twin: |b| place::order_nodes(b.read(0), b.read(1), b.write(2)),
};
