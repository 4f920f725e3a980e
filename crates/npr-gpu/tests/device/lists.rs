//! What every slot of the passes over shapes and lists holds: contours, and chains of all lengths, as the twins find
//! them.

use crate::pixels::is_over_pixels;
use crate::shapes::{eyes, shape_of};
use npr_core::math::mix_bits;
use npr_gpu::pass::Pass;
use npr_vector::mesh_lines::contour::steps::{
    HalfEdge, Marked, Viewer, face_eye, half_edges, judges, link_contours, mark_contours,
};
use npr_vector::mesh_lines::graph::CurveNode;
use npr_vector::rank::jump::Walk;
use npr_vector::rank::jump::{Hop, Reach, break_loops, cut_loops, rank_jump, start_nodes};
use npr_vector::rank::place::{ListPosition, Standing};
use npr_vector::rank::place::{measure_chains, scatter_ranks, turn_ranks};
use npr_vector::rank::scan::{BLOCK, compact, exclusive_scan, scan_blocks};
use npr_vector::rank::splitter::{find_splitters, start_splitters, walk_to_splitter};
use npr_vector::rank::work::WorkRule;
use npr_vector::rank::{Link, link, rounds_for};
use std::collections::BTreeMap;

/// What lists are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Chains {
    /// Loops and open chains of 1 to 300 nodes.
    Mixed,
    /// Loops of one node, all of them splitters.
    Single,
}

/// What jumps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Jumping {
    Nodes,
    Splitters,
}

/// Slots that read content of another name.
const RENAMED: [(&str, &str, &str); 11] = [
    ("vector.list_nodes", "extent", "mark_count"),
    ("vector.link_contours", "extent", "mark_count"),
    ("vector.link_contours", "slots", "mark_slots"),
    ("vector.link_contours", "flags", "marks"),
    ("vector.scan_blocks", "values", "keys"),
    ("vector.scan_add", "prefixes_in", "prefixes"),
    ("vector.break_loops", "reach_in", "reach"),
    ("vector.cut_loops", "hops_in", "first_hops"),
    ("vector.rank_jump", "hops_in", "cut"),
    ("vector.rank_splitters", "hops_in", "first_hops"),
    ("vector.scatter_ranks", "hops", "settled_hops"),
];

/// Whether the inputs of a pass are lists, not a frame.
pub fn is_over_lists(pass: &Pass) -> bool {
    pass.name.starts_with("vector.") && !is_over_pixels(pass)
}

/// The contents of all slots, for lists of a number of nodes.
pub struct Lists {
    contents: BTreeMap<&'static str, Vec<u32>>,
    node_count: usize,
}

impl Lists {
    pub fn new(chains: Chains, jumping: Jumping, node_count: usize) -> Self {
        let mut lists = Self {
            contents: BTreeMap::new(),
            node_count,
        };
        let links = links(chains, node_count);
        let elements = lists.give_elements(&links, jumping);
        lists.give_jumps(&links, &elements);
        lists.give_sums(&links);
        lists.give_contours();
        lists
    }

    /// What a slot reads.
    ///
    /// # Panics
    ///
    /// Where there is no input for it: a new pass brings its inputs along.
    pub fn content(&self, pass: &Pass, slot: &'static str) -> &[u32] {
        let name = renamed(pass, slot);
        let content = self.contents.get(name);
        content.unwrap_or_else(|| panic!("no input for slot '{slot}' of pass {}", pass.name))
    }

    /// Number of elements that a slot has room for.
    pub fn output_count(&self, pass: &Pass, slot: &str) -> usize {
        match (pass.name, slot) {
            (_, "sums") => self.node_count.div_ceil(BLOCK),
            (_, "arguments") => work_rule(self.node_count).argument_count(),
            ("vector.mark_contours" | "vector.link_contours" | "vector.list_nodes", _) => {
                3 * self.node_count
            }
            _ => self.node_count,
        }
    }

    fn give<T: bytemuck::NoUninit>(&mut self, name: &'static str, elements: &[T]) {
        self.contents
            .insert(name, bytemuck::cast_slice(elements).to_vec());
    }

    fn made<T: Default + Clone>(&self) -> Vec<T> {
        vec![T::default(); self.node_count]
    }

    /// What jumps, and how nodes hang on it.
    fn give_elements(&mut self, links: &[Link], jumping: Jumping) -> Elements {
        let (mut flags, mut splitters) = (self.made(), self.made());
        find_splitters(links, &mut flags);
        let (slots, count) = exclusive_scan(&flags);
        compact(&flags, &slots, &mut splitters);
        let mut walks = self.made::<Walk>();
        walk_to_splitter(links, &flags, &slots, &mut walks);
        self.give("flags", &flags);
        self.give("slots", &slots);
        self.give("splitters", &splitters);
        self.give("links", links);
        self.give("walks", &walks);

        let (mut hops, mut first) = (self.made::<Hop>(), self.made::<Reach>());
        start_splitters(&[count], links, &splitters, &walks, &mut hops, &mut first);
        let mut extent = [count];
        if jumping == Jumping::Nodes {
            extent = [links.len() as u32];
            start_nodes(links, &mut hops, &mut first, &mut walks);
            if !links.is_empty() {
                // A list of all nodes: each counts from itself.
                self.give("splitters", &(0..extent[0]).collect::<Vec<_>>());
                self.give("walks", &walks);
            }
        }
        self.give("extent", &extent);
        self.give("rounds", &[rounds_for(self.node_count)]);
        self.give("rule", &[work_rule(self.node_count)]);
        self.give("first_hops", &hops);
        self.give("first", &first);
        Elements {
            extent,
            first,
            hops,
            walks,
        }
    }

    /// What pointer jumping makes of that, early and at the end.
    fn give_jumps(&mut self, links: &[Link], elements: &Elements) {
        let Elements {
            extent,
            first,
            hops,
            walks,
        } = elements;
        let mut reach = first.clone();
        for round in 0..rounds_for(self.node_count) {
            let from = reach.clone();
            break_loops(extent, &from, &mut reach);
            if round == 0 {
                self.give("reach", &reach);
            }
        }
        if rounds_for(self.node_count) == 0 {
            self.give("reach", &reach);
        }
        self.give("settled", &reach);
        let mut jumped = hops.clone();
        cut_loops(extent, first, &reach, hops, &mut jumped);
        self.give("cut", &jumped);
        for _ in 0..rounds_for(self.node_count) {
            let from = jumped.clone();
            rank_jump(extent, &from, &mut jumped);
        }
        self.give("settled_hops", &jumped);

        let (mut places, mut unsettled) = (self.made::<ListPosition>(), self.made::<u32>());
        scatter_ranks(walks, first, &reach, &jumped, &mut places, &mut unsettled);
        assert!(unsettled.iter().all(|flag| *flag == 0), "lists are ranked");
        self.give("places", &places);
        let mut lengths = self.made();
        measure_chains(links, &places, &mut lengths);
        self.give("lengths", &lengths);
        let mut standings = self.made::<Standing>();
        let (mut sizes, mut heads) = (self.made(), self.made());
        turn_ranks(&places, &lengths, &mut standings, &mut sizes, &mut heads);
        self.give("standings", &standings);
        self.give("starts", &exclusive_scan(&sizes).0);
    }

    /// Sums of numbers that wrap.
    fn give_sums(&mut self, links: &[Link]) {
        let keys: Vec<u32> = links.iter().map(|link| link.key).collect();
        let mut prefixes = self.made();
        let mut sums = vec![0; self.node_count.div_ceil(BLOCK)];
        scan_blocks(&keys, &mut prefixes, &mut sums);
        self.give("keys", &keys);
        self.give("prefixes", &prefixes);
        self.give("offsets", &exclusive_scan(&sums).0);
    }

    /// Contours of a shape with as many faces as there are nodes.
    fn give_contours(&mut self) {
        let sphere = npr_mesh::testing::uv_sphere(128, 80);
        let faces = &sphere.triangles()[..self.node_count.min(sphere.triangles().len())];
        let shape = shape_of(sphere.positions(), faces);
        let viewer = Viewer::from(&eyes(1.0)[0]);
        let (sides, judges): (Vec<HalfEdge>, _) = (half_edges(&shape), judges(&shape));
        let positions = shape.positions.as_flattened();
        let (mut front, mut marks) = (vec![0; judges.len()], vec![0; sides.len()]);
        let corners = shape.faces.as_flattened();
        face_eye(&viewer, positions, corners, &judges, &mut front);
        mark_contours(&front, &sides, &mut marks);
        let (slots, count) = exclusive_scan(&marks);
        let mut contours = vec![0; sides.len()];
        compact(&marks, &slots, &mut contours);
        let mut nodes = vec![CurveNode::default(); sides.len()];
        let on = Marked {
            viewer: &viewer,
            extent: &[count],
            contours: &contours,
            slots: &slots,
            flags: &marks,
            half_edges: &sides,
            positions,
        };
        link_contours(&on, &mut nodes);
        self.give("nodes", &nodes);
        self.give("viewer", &[viewer]);
        self.give("positions", positions);
        self.give("corners", corners);
        self.give("half_edges", &sides);
        self.give("judges", &judges);
        self.give("front", &front);
        self.give("marks", &marks);
        self.give("mark_slots", &slots);
        self.give("mark_count", &[count]);
        self.give("contours", &contours);
    }
}

struct Elements {
    extent: [u32; 1],
    first: Vec<Reach>,
    hops: Vec<Hop>,
    walks: Vec<Walk>,
}

fn renamed(pass: &Pass, slot: &'static str) -> &'static str {
    let found = RENAMED
        .iter()
        .find(|(name, other, _)| (*name, *other) == (pass.name, slot));
    found.map_or(slot, |(_, _, content)| *content)
}

/// Sizes of all kinds, for a list that its room may be too small for.
fn work_rule(node_count: usize) -> WorkRule {
    WorkRule {
        round_count: rounds_for(node_count),
        vertices: 3,
        ..WorkRule::of_room(node_count - node_count / 3)
    }
}

/// Nodes strewn over memory, linked to chains.
fn links(chains: Chains, node_count: usize) -> Vec<Link> {
    let (next, keys) = lists(chains, node_count, 1);
    link(&next, &keys).unwrap()
}

/// Successors and keys of strewn lists; every third chain is open.
pub fn lists(chains: Chains, node_count: usize, seed: u32) -> (Vec<u32>, Vec<u32>) {
    let mut nodes: Vec<u32> = (0..node_count as u32).collect();
    nodes.sort_unstable_by_key(|node| mix_bits(node ^ mix_bits(!seed)));
    let mut next = vec![npr_core::geometry::NONE; node_count];
    let (mut rest, mut number) = (&nodes[..], 0);
    while !rest.is_empty() {
        let length = match chains {
            Chains::Mixed => {
                1 + mix_bits(number + seed) as usize % [3, 20, 300][number as usize % 3]
            }
            Chains::Single => 1,
        };
        let (chain, others) = rest.split_at(length.min(rest.len()));
        for pair in chain.windows(2) {
            next[pair[0] as usize] = pair[1];
        }
        if chains == Chains::Single || mix_bits(number).is_multiple_of(3) {
            next[chain[chain.len() - 1] as usize] = chain[0];
        }
        (rest, number) = (others, number + 1);
    }
    let keys = (0..node_count as u32).map(|node| mix_bits(node ^ seed) >> 5);
    (next, keys.collect())
}
