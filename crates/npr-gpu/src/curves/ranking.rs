//! Passes that rank lists.

use super::CurvesError;
use super::sums::{Compacted, add_compact, add_scan, add_sum};
use super::work::{IndirectArguments, ListWork, add_work};
use crate::engine::{Engine, Readings};
use crate::graph::{Graph, ResourceId};
use crate::passes::vector;
use npr_vector::rank::jump::Walk;
use npr_vector::rank::jump::{Hop, Reach};
use npr_vector::rank::place::{ListPosition, Standing};
use npr_vector::rank::{Link, RankError, Ranked, link, rounds_for, splitter_rounds_for};

/// How lists are ranked; the result is the same.
///
/// `rounds` bounds the rounds of pointer jumping; by default as many as chains of all nodes would take. More than 32
/// change nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scheme {
    /// Every node jumps: [`npr_vector::rank::wyllie`].
    Wyllie {
        /// Rounds of each of loop breaking and ranking.
        rounds: Option<u32>,
    },
    /// About every seventeenth node jumps: [`npr_vector::rank::ruling_set`].
    RulingSet {
        /// Rounds of each of loop breaking and ranking.
        rounds: Option<u32>,
    },
}

impl Scheme {
    /// Every node jumps, as often as it may take.
    pub const WYLLIE: Self = Self::Wyllie { rounds: None };
    /// Splitters jump, as often as it may take.
    pub const RULING_SET: Self = Self::RulingSet { rounds: None };

    /// Number of rounds for a number of nodes.
    fn rounds(self, node_count: usize) -> u32 {
        let (asked, enough) = match self {
            Self::Wyllie { rounds } => (rounds, rounds_for(node_count)),
            Self::RulingSet { rounds } => (rounds, splitter_rounds_for(node_count)),
        };
        asked.unwrap_or(enough).min(u32::BITS)
    }

    /// The indirect arguments of a list with room for a number of nodes: rounds, if all of them jump.
    pub(super) fn indirect(self, room: usize) -> IndirectArguments {
        let rounds = match self {
            Self::Wyllie { .. } => self.rounds(room),
            Self::RulingSet { .. } => 0,
        };
        IndirectArguments {
            rounds,
            ..IndirectArguments::default()
        }
    }
}

/// Nodes up to which all rounds among splitters run in one pass.
///
/// There are then some 500 splitters: one workgroup ranks them while the device would be busy starting a pass per
/// round.
const ONE_PASS_NODES: usize = 8192;

/// The resources that [`add_ranking`] adds to a graph.
#[derive(Debug, Clone, Copy)]
pub struct RankedLists {
    /// Most rounds of pointer jumping.
    pub round_count: u32,
    /// Number of nodes whose place is unknown: one element. The rows hold only where it is 0.
    pub unsettled: ResourceId,
    /// The result.
    pub rows: Rows,
}

impl RankedLists {
    /// What [`ranked`] reads.
    pub(super) fn results(&self) -> [ResourceId; 6] {
        let rows = &self.rows;
        [
            self.unsettled,
            rows.standings,
            rows.order,
            rows.starts,
            rows.chains.count,
            rows.chains.list,
        ]
    }
}

/// The ranked nodes of lists.
#[derive(Debug, Clone, Copy)]
pub struct Rows {
    /// [`Standing`] of every node.
    pub standings: ResourceId,
    /// All nodes, chain after chain.
    pub order: ResourceId,
    /// Where chains start in `order`, at their heads; other entries hold sums.
    pub starts: ResourceId,
    /// Heads in order, and the number of chains.
    pub chains: Compacted,
}

/// The elements that jump, and the element that each node counts from.
struct Elements {
    work: ListWork,
    extent: ResourceId,
    first: ResourceId,
    hops: ResourceId,
    walks: ResourceId,
}

/// Appends passes that rank a buffer of [`Link`], which must be lists as far as the work reaches. If `work` follows a
/// list's length and all nodes jump, its rounds must be those of the [scheme](Scheme) for the buffer's room.
///
/// Up to 4096 nodes take 21 passes by splitters and up to 39 by Wyllie's ranking; a million take 70 and 65. About 170
/// bytes for each node. A pass counts the splitters, and their number sizes the passes over them; rounds that change
/// nothing are empty.
pub fn add_ranking(
    graph: &mut Graph,
    links: ResourceId,
    work: &ListWork,
    scheme: Scheme,
) -> RankedLists {
    // Choose the nodes that jump: all of them, or splitters alone.
    let count = graph.element_count(links);
    let round_count = scheme.rounds(count);
    let is_short = matches!(scheme, Scheme::RulingSet { .. }) && count <= ONE_PASS_NODES;
    let elements = match scheme {
        Scheme::Wyllie { .. } => add_nodes(graph, links, work),
        Scheme::RulingSet { .. } => add_splitters(graph, links, work, is_short, round_count),
    };

    // Rank those, in one pass where they are few.
    let (settled, hops) = if is_short {
        add_short_ranking(graph, &elements, round_count)
    } else {
        let settled = add_breaking(graph, &elements, round_count);
        let hops = add_jumping(graph, &elements, settled, round_count);
        (settled, hops)
    };

    // Give every other node its place behind them.
    let places = graph.buffer::<ListPosition>("places", count);
    let unsettled = graph.buffer::<u32>("unsettled nodes", count);
    let Elements { first, walks, .. } = elements;
    graph.compute_sized(
        &vector::SCATTER_RANKS,
        &[walks, first, settled, hops, places, unsettled],
        work.elements(),
    );

    // Count what the rounds did not settle, and put the rest in rows.
    let unsettled = add_sum(graph, unsettled, work);
    let rows = add_rows(graph, links, places, work);
    RankedLists {
        round_count,
        unsettled,
        rows,
    }
}

/// Puts nodes in order by their known places.
fn add_rows(graph: &mut Graph, links: ResourceId, places: ResourceId, work: &ListWork) -> Rows {
    // Measure the lists, and turn ranks to count from their heads.
    let all = work.elements();
    let count = graph.element_count(links);
    let lengths = graph.buffer::<u32>("lengths", count);
    graph.compute_sized(&vector::MEASURE_CHAINS, &[links, places, lengths], all);
    let standings = graph.buffer::<Standing>("standings", count);
    let sizes = graph.buffer::<u32>("sizes of chains", count);
    let heads = graph.buffer::<u32>("heads", count);
    graph.compute_sized(
        &vector::TURN_RANKS,
        &[places, lengths, standings, sizes, heads],
        all,
    );

    // Put nodes behind each other, list by list.
    let starts = add_scan(graph, sizes, work).prefixes;
    let order = graph.buffer::<u32>("nodes in order", count);
    graph.compute_sized(&vector::ORDER_NODES, &[standings, starts, order], all);
    Rows {
        standings,
        order,
        starts,
        chains: add_compact(graph, heads, count, work),
    }
}

/// Makes elements of all nodes.
fn add_nodes(graph: &mut Graph, links: ResourceId, work: &ListWork) -> Elements {
    let count = graph.element_count(links);
    // Behind a list's end lie loops of one node, up to the last workgroup's: these jump too.
    let extent = graph.constants("node count", &[count as u32]);
    let hops = graph.buffer::<Hop>("first hops", count);
    let first = graph.buffer::<Reach>("first reach", count);
    let walks = graph.buffer::<Walk>("walks", count);
    let bound = [links, hops, first, walks];
    graph.compute_sized(&vector::START_NODES, &bound, work.elements());
    Elements {
        work: *work,
        extent,
        first,
        hops,
        walks,
    }
}

/// Makes elements of the splitters, which all nodes count from.
fn add_splitters(
    graph: &mut Graph,
    links: ResourceId,
    work: &ListWork,
    is_short: bool,
    rounds: u32,
) -> Elements {
    let all = work.elements();
    let count = graph.element_count(links);
    let flags = graph.buffer::<u32>("splitter flags", count);
    graph.compute_sized(&vector::FIND_SPLITTERS, &[links, flags], all);
    let splitters = add_compact(graph, flags, count, work);
    let walks = graph.buffer::<Walk>("walks", count);
    graph.compute_sized(
        &vector::WALK_TO_SPLITTER,
        &[links, flags, splitters.slots, walks],
        all,
    );
    // One pass over a few hundred splitters is not worth another that sizes it.
    let among = if is_short {
        *work
    } else {
        let indirect = IndirectArguments {
            rounds,
            ..IndirectArguments::default()
        };
        add_work(graph, splitters.count, count, indirect)
    };
    let hops = graph.buffer::<Hop>("first hops", count);
    let first = graph.buffer::<Reach>("first reach", count);
    graph.compute_sized(
        &vector::START_SPLITTERS,
        &[splitters.count, links, splitters.list, walks, hops, first],
        among.elements(),
    );
    Elements {
        work: among,
        extent: splitters.count,
        first,
        hops,
        walks,
    }
}

/// Runs all rounds in one pass; gives the reaches and the hops after the last.
fn add_short_ranking(
    graph: &mut Graph,
    elements: &Elements,
    rounds: u32,
) -> (ResourceId, ResourceId) {
    // Take two buffers of each kind, which rounds swap.
    let rounds = graph.constant("rounds", rounds);
    let count = graph.element_count(elements.first);
    let [settled, reach_scratch] = [0; 2].map(|_| graph.buffer::<Reach>("reach", count));
    let [hops, hops_scratch] = [0; 2].map(|_| graph.buffer::<Hop>("hops", count));
    let &Elements { extent, first, .. } = elements;

    // Run every round within one workgroup.
    graph.compute(
        &vector::RANK_SPLITTERS,
        &[
            rounds,
            extent,
            first,
            elements.hops,
            settled,
            reach_scratch,
            hops,
            hops_scratch,
        ],
    );
    (settled, hops)
}

/// Appends rounds of finding heads; gives the reaches after the last.
fn add_breaking(graph: &mut Graph, elements: &Elements, rounds: u32) -> ResourceId {
    let count = graph.element_count(elements.first);
    let pair = [0; 2].map(|_| graph.buffer::<Reach>("reach", count));
    let mut settled = elements.first;
    for round in 0..rounds {
        let to = pair[round as usize % 2];
        let bound = [elements.extent, settled, to];
        graph.compute_sized(&vector::BREAK_LOOPS, &bound, elements.work.round(round));
        settled = to;
    }
    settled
}

/// Cuts loops and appends rounds of ranking; gives the hops after the last.
fn add_jumping(
    graph: &mut Graph,
    elements: &Elements,
    settled: ResourceId,
    rounds: u32,
) -> ResourceId {
    // Cut loops, so that every list has an end.
    let count = graph.element_count(elements.hops);
    let &Elements {
        work,
        extent,
        first,
        hops,
        ..
    } = elements;
    let pair = [0; 2].map(|_| graph.buffer::<Hop>("hops", count));
    let bound = [extent, first, settled, hops, pair[0]];
    graph.compute_sized(&vector::CUT_LOOPS, &bound, work.elements());

    // Double how far each element sees, round by round.
    for round in 0..rounds {
        let at = round as usize;
        let (from, to) = (pair[at % 2], pair[(at + 1) % 2]);
        graph.compute_sized(&vector::RANK_JUMP, &[extent, from, to], work.round(round));
    }
    pair[rounds as usize % 2]
}

/// Ranks lists on an engine, with the result of [`npr_vector::rank::walk`].
///
/// # Errors
///
/// [`CurvesError::Rank`] where `next` does not describe lists or the rounds of the scheme are too few;
/// [`CurvesError::Engine`] where the engine fails.
pub fn rank_on(
    engine: &dyn Engine,
    next: &[u32],
    keys: &[u32],
    scheme: Scheme,
) -> Result<Ranked, CurvesError> {
    let links = link(next, keys)?;
    let mut graph = Graph::new();
    let bound = graph.buffer::<Link>("links", links.len());
    let lists = add_ranking(&mut graph, bound, &ListWork::WHOLE, scheme);
    let mut session = engine.prepare(graph)?;
    session.write(bound, bytemuck::cast_slice(&links))?;
    let (_, mut read) = session.run_reading(&lists.results())?;
    ranked(&mut read, &lists, links.len())
}

/// The ranking of the first nodes; all nodes after them must be loops of their own.
pub(super) fn ranked(
    read: &mut Readings,
    lists: &RankedLists,
    node_count: usize,
) -> Result<Ranked, CurvesError> {
    // Refuse lists that the rounds did not settle.
    let count = read.take_count(lists.unsettled);
    if count != 0 {
        let rounds = lists.round_count;
        return Err(RankError::Unsettled { count, rounds }.into());
    }

    // Read the rows of the nodes that there are.
    let rows = &lists.rows;
    let standings: Vec<Standing> = read.take_first(rows.standings, node_count);
    let order = read.take_first(rows.order, node_count);

    // Read where chains start, without those of nodes that are room alone.
    let starts = read.take(rows.starts);
    let chain_count = read.take_count(rows.chains.count);
    let mut chains: Vec<u32> = read.take_first(rows.chains.list, chain_count);
    chains.truncate(chains.partition_point(|head| (*head as usize) < node_count));
    Ok(Ranked::from_standings(&standings, order, &starts, &chains))
}
