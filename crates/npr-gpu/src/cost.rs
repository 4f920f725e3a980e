//! What the passes of a graph ask of a device: launches, invocations, bytes and barriers, counted and not timed.
//!
//! The counts come from the declarations, the sizes of what is bound, and what the run before left in memory: the
//! sizes of indirect launches, the lengths of lists, the texels that are drawn. Bytes follow a model, because no
//! declaration says which elements an invocation reads:
//!
//! - Caches are perfect within a pass, and keep nothing from one pass to the next: an element costs its bytes once a
//!   pass, however many invocations read it. A uniform is one element.
//! - A slot *in step* with the work has a whole multiple of the elements that the pass counts. It costs the share of
//!   its bytes that the work is of the room, also where an invocation ends before it reads its own.
//! - A slot of a draw *in step* with the texels has as many elements as a target. It costs one element a drawn texel.
//! - Every other slot that is read costs all of its bytes, which is the most that it can cost:
//!   [`Cost::whole_bytes`] tells how much of the sum that is. One that is written costs all of its bytes too.
//! - What a pass writes in part costs all of its bytes once, because it is emptied before.
//! - A list that is appended to costs what is in it, and so does one that is worked through; to any other pass it tells
//!   its length alone.
//! - A target that is cleared is written once; a drawn texel reads its depth and writes all targets. Texels that are
//!   drawn over are not seen, so they do not count.
//!
//! Slots that the features of the graph leave out cost nothing.

use crate::engine::{EngineError, Readings, Session};
use crate::graph::{Graph, ImageLayer, Node, ResourceId, WorkSize, emptied, lists, writes};
use crate::pass::{Access, Format, Pass, Slot, WORKGROUP_SIZE, Work};
use npr_shaders::Features;
use npr_vector::rank::work::Arguments;
use std::collections::BTreeSet;
use std::ops::AddAssign;

/// Bytes of a texel of any format.
const TEXEL_BYTES: u64 = 4;

/// The name under which copies of results are counted.
const COPY: &str = "copy";

/// WGSL's calls at which the invocations of a workgroup wait for each other.
const WAITS: [&str; 4] = [
    "workgroupBarrier()",
    "storageBarrier()",
    "textureBarrier()",
    "workgroupUniformLoad(",
];

/// What a pass asks of a device.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Cost {
    /// Dispatches and draws: one, or none where the pass has nothing to do.
    pub launches: u64,
    /// Workgroups of a dispatch.
    pub workgroups: u64,
    /// Invocations: of all workgroups, idle ones of the last included, or of the vertices and drawn texels of a draw.
    pub invocations: u64,
    /// Bytes read.
    pub read_bytes: u64,
    /// Bytes written.
    pub written_bytes: u64,
    /// Of the bytes read, those of slots that count whole because nothing says how much of them is read.
    pub whole_bytes: u64,
    /// Barriers before it: it uses what was written since the last barrier, or writes what was used.
    pub barriers: u64,
    /// Places of its shader at which a workgroup waits for itself.
    pub workgroup_barriers: u64,
}

impl Cost {
    /// Bytes read and written.
    pub fn bytes(&self) -> u64 {
        self.read_bytes + self.written_bytes
    }
}

impl AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.launches += other.launches;
        self.workgroups += other.workgroups;
        self.invocations += other.invocations;
        self.read_bytes += other.read_bytes;
        self.written_bytes += other.written_bytes;
        self.whole_bytes += other.whole_bytes;
        self.barriers += other.barriers;
        self.workgroup_barriers += other.workgroup_barriers;
    }
}

/// A pass and what it asks of a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PassCost {
    /// Name of the pass.
    pub name: &'static str,
    /// What it asks for.
    pub cost: Cost,
}

/// What the nodes of a graph asked of a device in the last run of its session, in running order.
///
/// A list that several nodes append to, and arguments that several nodes write, count as the last of them left them.
/// Reads these, and a target of every draw, from the session.
///
/// # Errors
///
/// As [`Session::read_all`].
pub fn pass_costs(graph: &Graph, session: &mut dyn Session) -> Result<Vec<PassCost>, EngineError> {
    let ids: BTreeSet<ResourceId> = graph.nodes().iter().flat_map(told_by).collect();
    let ids: Vec<ResourceId> = ids.into_iter().collect();
    let run = Run {
        graph,
        read: session.read_all(&ids)?,
        lists: graph.nodes().iter().flat_map(lists).collect(),
    };
    let mut order = Order::default();
    let costs = graph.nodes().iter().map(|node| PassCost {
        name: node.pass.name,
        cost: match graph.acts(node) {
            true => Cost {
                barriers: order.barriers_before(node),
                ..run.cost(node)
            },
            false => Cost::default(),
        },
    });
    Ok(costs.collect())
}

/// The cost of copying a result to where the processor reads it: a barrier, and its bytes read and written once.
pub fn copy_cost(graph: &Graph, id: ResourceId) -> PassCost {
    let bytes = bytes_of(graph, id);
    PassCost {
        name: COPY,
        cost: Cost {
            read_bytes: bytes,
            written_bytes: bytes,
            barriers: 1,
            ..Cost::default()
        },
    }
}

/// The resources that tell, after a run, how much a node did.
fn told_by(node: &Node) -> Vec<ResourceId> {
    let mut told: Vec<ResourceId> = lists(node).collect();
    told.extend(node.size.map(|size| size.arguments));
    match node.pass.work {
        Work::PerElement { .. } | Work::PerRun { .. } => {}
        Work::PerListed { .. } => told.push(node.bound[node.pass.counted_slot()]),
        Work::Draw { .. } => told.extend(node.targets().next().map(|target| target.image)),
    }
    told
}

fn bytes_of(graph: &Graph, id: ResourceId) -> u64 {
    graph.resource(id).word_count() as u64 * 4
}

/// A graph, and what a run of it left in the resources that tell how much was done.
struct Run<'a> {
    graph: &'a Graph,
    read: Readings,
    /// What passes append to.
    lists: BTreeSet<ResourceId>,
}

/// How much a node did, and how much it had room for.
#[derive(Debug, Clone, Copy)]
struct Extent {
    items: u64,
    room: u64,
    /// Drawn texels of a target, and all of them; none for dispatches.
    drawn: u64,
    texels: u64,
}

impl Run<'_> {
    /// What a node asked for, barriers before it left out.
    fn cost(&self, node: &Node) -> Cost {
        // Count the launch.
        let extent = self.extent(node);
        let arguments = self.arguments(node);
        let mut cost = Cost {
            launches: 1,
            workgroup_barriers: waits(node.pass, self.graph.features()),
            ..Cost::default()
        };
        match node.pass.work {
            Work::PerElement { .. } | Work::PerRun { .. } | Work::PerListed { .. } => {
                let [x, y] = match arguments {
                    Some(Arguments { x, y, .. }) => [x, y],
                    None => self.graph.room_groups(node).unwrap_or([u32::MAX; 2]),
                };
                cost.workgroups = u64::from(x) * u64::from(y);
                cost.invocations = cost.workgroups * u64::from(WORKGROUP_SIZE);
            }
            Work::Draw { vertices, .. } => {
                cost.invocations = extent.items * u64::from(vertices) + extent.drawn;
            }
        }

        // Count the bytes.
        for (index, slot) in node.pass.slots.iter().enumerate() {
            if slot.is_read_for(self.graph.features()) {
                self.add_slot(&mut cost, node, (index, slot), extent);
            }
        }
        for format in node.pass.targets() {
            let cleared = if node.clears { extent.texels } else { 0 };
            cost.written_bytes += (cleared + extent.drawn) * TEXEL_BYTES;
            if *format == Format::Depth {
                cost.read_bytes += extent.drawn * TEXEL_BYTES;
            }
        }
        cost
    }

    /// Adds the bytes of one slot.
    fn add_slot(&self, cost: &mut Cost, node: &Node, (index, slot): (usize, &Slot), work: Extent) {
        // Take the share of it that the work reaches.
        let id = node.bound[index];
        let whole = bytes_of(self.graph, id);
        let count = self.graph.element_count(id) as u64;
        let is_counted = index == node.pass.counted_slot();
        let (bytes, is_known) = if slot.access == Access::Append {
            (self.list_bytes(id), true)
        } else if slot.access == Access::Scatter {
            (whole, true)
        } else if is_counted && matches!(node.pass.work, Work::PerListed { .. }) {
            ((1 + work.items) * 4, true)
        } else if !is_counted && slot.access == Access::Read && self.lists.contains(&id) {
            (4, true)
        } else if !is_counted && work.texels > 0 && count == work.texels {
            (share(whole, work.drawn, work.texels), true)
        } else if count > 0 && count.is_multiple_of(work.room) {
            (share(whole, work.items, work.room), true)
        } else {
            (whole, slot.access == Access::Uniform)
        };
        let is_emptied = matches!(slot.access, Access::Append | Access::Scatter);
        if work.items == 0 && !is_emptied {
            return;
        }

        // Count it as read, written or both.
        if matches!(
            slot.access,
            Access::Uniform
                | Access::Read
                | Access::Indices
                | Access::Update
                | Access::Texture(_)
                | Access::Layered(_)
        ) {
            cost.read_bytes += bytes;
            cost.whole_bytes += if is_known { 0 } else { bytes };
        }
        if slot.access.writes() {
            cost.written_bytes += bytes;
        }
    }

    /// The work that a node did.
    fn extent(&self, node: &Node) -> Extent {
        let room = self.graph.work_count(node);
        let sized = match self.arguments(node) {
            Some(arguments) => self.graph.sized_work_count(node, &arguments),
            None => room,
        };
        let items = match node.pass.work {
            Work::PerListed { .. } => {
                let list = node.bound[node.pass.counted_slot()];
                sized.min(self.length(list))
            }
            _ => sized,
        };
        let texels = node.targets().next().map(|target| self.texels(target));
        let texels = texels.unwrap_or_default();
        Extent {
            items: items as u64,
            room: room as u64,
            drawn: texels.iter().filter(|texel| **texel != 0).count() as u64,
            texels: texels.len() as u64,
        }
    }

    /// The size of a node that takes it from a buffer.
    fn arguments(&self, node: &Node) -> Option<Arguments> {
        let WorkSize { arguments, index } = node.size?;
        let made: &[Arguments] = bytemuck::cast_slice(self.read.words(arguments));
        Some(made[index])
    }

    /// The number of elements of a list; lists count on beyond their room.
    fn length(&self, list: ResourceId) -> usize {
        let words = self.read.words(list);
        let length = words.first().map_or(0, |count| *count as usize);
        length.min(words.len().saturating_sub(1))
    }

    /// Bytes of a list: its length, then its elements.
    fn list_bytes(&self, list: ResourceId) -> u64 {
        (1 + self.length(list) as u64) * 4
    }

    /// The texels of a target; those that are not 0 were drawn.
    fn texels(&self, target: ImageLayer) -> &[u32] {
        &self.read.words(target.image)[self.graph.words_of(target)]
    }
}

/// `part` of `all` parts of some bytes, rounded up.
fn share(bytes: u64, part: u64, all: u64) -> u64 {
    (bytes * part).div_ceil(all)
}

/// Places in the text of a pass at which a workgroup waits for itself.
fn waits(pass: &Pass, features: Features) -> u64 {
    let text = npr_shaders::link(&pass.shader, features);
    WAITS
        .iter()
        .map(|call| text.matches(call).count() as u64)
        .sum()
}

/// What was used since the last barrier.
#[derive(Debug, Default)]
struct Order {
    written: BTreeSet<ResourceId>,
    used: BTreeSet<ResourceId>,
}

impl Order {
    /// The barriers that a node needs before it: one for what is emptied for it, and one where it uses what
    /// was written since the last barrier, or writes what was used.
    fn barriers_before(&mut self, node: &Node) -> u64 {
        let emptied: BTreeSet<ResourceId> = emptied(node).map(|(id, _)| id).collect();
        let written: BTreeSet<ResourceId> = writes(node).collect();
        let used = node.bound.iter().copied();
        let used: BTreeSet<ResourceId> = used.chain(node.size.map(|size| size.arguments)).collect();

        // Empty that, then run: two accesses, and each may have to wait.
        let mut barriers = 0;
        if !emptied.is_empty() {
            barriers += self.access(&emptied, &emptied);
        }
        barriers + self.access(&used, &written)
    }

    /// Whether an access has to wait, 0 or 1; what it touches is remembered.
    fn access(&mut self, used: &BTreeSet<ResourceId>, written: &BTreeSet<ResourceId>) -> u64 {
        let waits = !self.written.is_disjoint(used) || !self.used.is_disjoint(written);
        if waits {
            *self = Self::default();
        }
        self.written.extend(written);
        self.used.extend(used);
        u64::from(waits)
    }
}

#[cfg(test)]
mod tests;
