//! A frame as data: resources, and the passes that fill them in order.

use crate::pass::{Access, Format, Pass, RUN, WORKGROUP_SIZE, Work};
use bytemuck::NoUninit;
use npr_core::layout::GpuLayout;
use npr_shaders::Features;
use npr_vector::rank::scan::BLOCK;
use npr_vector::rank::work::{Arguments, MAX_GROUPS};
use std::ops::Range;

/// A buffer or image of a graph.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ResourceId(pub(crate) u32);

impl ResourceId {
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }

    /// A layer of an image, counted from 0.
    pub fn layer(self, layer: u32) -> ImageLayer {
        ImageLayer { image: self, layer }
    }
}

/// A layer of an image, which a pass draws into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImageLayer {
    /// The image.
    pub image: ResourceId,
    /// Which of its layers, counted from 0.
    pub layer: u32,
}

/// The first layer, which most images have alone.
impl From<ResourceId> for ImageLayer {
    fn from(image: ResourceId) -> Self {
        image.layer(0)
    }
}

/// The kind of a resource.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// One struct for uniform slots, of this many bytes.
    Uniform {
        /// Bytes.
        size: usize,
    },
    /// An array.
    Buffer {
        /// Bytes of an element.
        stride: usize,
        /// Number of elements.
        count: usize,
    },
    /// A picture, or several of one size.
    Image {
        /// What a texel holds.
        format: Format,
        /// Width and height.
        size: [u32; 2],
        /// Number of pictures, at least 1; the words of one lie behind those of the other.
        layers: u32,
    },
}

/// A resource and its label.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Resource {
    /// For messages and debuggers.
    pub name: &'static str,
    /// What it is.
    pub kind: Kind,
}

impl Resource {
    /// Number of 4-byte words it takes.
    pub fn word_count(&self) -> usize {
        match self.kind {
            Kind::Uniform { size } => size.div_ceil(4),
            Kind::Buffer { stride, count } => (stride * count).div_ceil(4),
            Kind::Image { size, layers, .. } => area(size) * layers as usize,
        }
    }
}

/// Where the engine finds the amount of work of a node: one of the [`Arguments`] of a buffer that earlier passes fill.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WorkSize {
    /// A buffer of [`Arguments`].
    pub arguments: ResourceId,
    /// Index of the arguments.
    pub index: usize,
}

/// A pass with the resources that it binds.
#[derive(Debug, Clone)]
pub struct Node {
    /// The pass that runs.
    pub pass: &'static Pass,
    /// Resources of its slots in order, then of its targets.
    pub bound: Vec<ResourceId>,
    /// The layer of each target that is drawn into.
    pub layers: Vec<u32>,
    /// Whether the targets are cleared to zero before drawing.
    pub clears: bool,
    /// Where its size is found; without one, it works on all elements of the counted slot.
    pub size: Option<WorkSize>,
}

impl Node {
    /// What it draws into; nothing for compute passes.
    pub fn targets(&self) -> impl Iterator<Item = ImageLayer> + '_ {
        let images = &self.bound[self.pass.slots.len()..];
        let layers = images.iter().zip(&self.layers);
        layers.map(|(image, layer)| image.layer(*layer))
    }

    /// The indices of its vertices, where it draws with them.
    pub fn indices(&self) -> Option<ResourceId> {
        let mut bound = self.pass.slots.iter().zip(&self.bound);
        let found = bound.find(|(slot, _)| slot.access == Access::Indices);
        found.map(|(_, id)| *id)
    }
}

/// Resources and nodes, in the order in which the nodes run.
///
/// Building a graph that does not fit its passes is a bug in the program and panics with the pass's name.
#[derive(Debug, Clone)]
pub struct Graph {
    features: Features,
    resources: Vec<Resource>,
    nodes: Vec<Node>,
    constants: Vec<(ResourceId, Vec<u32>)>,
}

impl Default for Graph {
    fn default() -> Self {
        Self::new()
    }
}

impl Graph {
    /// A graph without resources, whose passes can do everything that is asked of them.
    pub fn new() -> Self {
        Self::with(Features::ALL)
    }

    /// A graph without resources, for what needs no other features than these. A device leaves out of its passes, and
    /// of what they bind, all that the features do not need; the processor does everything that it is asked for.
    pub fn with(features: Features) -> Self {
        Self {
            features,
            resources: Vec::new(),
            nodes: Vec::new(),
            constants: Vec::new(),
        }
    }

    /// What its passes must be able to do.
    pub fn features(&self) -> Features {
        self.features
    }

    /// Adds a buffer of `count` elements.
    pub fn buffer<T: GpuLayout>(&mut self, name: &'static str, count: usize) -> ResourceId {
        self.add(
            name,
            Kind::Buffer {
                stride: size_of::<T>(),
                count,
            },
        )
    }

    /// Adds a uniform.
    pub fn uniform<T: GpuLayout>(&mut self, name: &'static str) -> ResourceId {
        self.add(
            name,
            Kind::Uniform {
                size: size_of::<T>(),
            },
        )
    }

    /// Adds a uniform that holds `value` from the start; no host needs to write it.
    pub fn constant<T: GpuLayout>(&mut self, name: &'static str, value: T) -> ResourceId {
        let id = self.uniform::<T>(name);
        self.hold(id, &[value])
    }

    /// Adds a buffer that holds `values` from the start; no host needs to write it.
    pub fn constants<T: GpuLayout>(&mut self, name: &'static str, values: &[T]) -> ResourceId {
        let id = self.buffer::<T>(name, values.len());
        self.hold(id, values)
    }

    /// Makes room in a buffer for `count` elements; whether it had less.
    ///
    /// # Panics
    ///
    /// Where the resource is no buffer.
    pub fn grow(&mut self, id: ResourceId, count: usize) -> bool {
        let Resource { name, kind } = &mut self.resources[id.index()];
        let Kind::Buffer { count: room, .. } = kind else {
            panic!("'{name}' is no buffer and cannot grow");
        };
        let grows = *room < count;
        *room = count.max(*room);
        grows
    }

    fn hold<T: NoUninit>(&mut self, id: ResourceId, values: &[T]) -> ResourceId {
        self.constants
            .push((id, bytemuck::cast_slice(values).to_vec()));
        id
    }

    /// Adds an image of one layer.
    pub fn image(&mut self, name: &'static str, format: Format, size: [u32; 2]) -> ResourceId {
        self.layered_image(name, format, size, 1)
    }

    /// Adds an image of some layers of one size.
    ///
    /// # Panics
    ///
    /// When it has no layers.
    pub fn layered_image(
        &mut self,
        name: &'static str,
        format: Format,
        size: [u32; 2],
        layers: u32,
    ) -> ResourceId {
        assert!(layers > 0, "image '{name}' has no layers");
        self.add(
            name,
            Kind::Image {
                format,
                size,
                layers,
            },
        )
    }

    /// Adds a resource of any kind, for programs that build graphs from declarations.
    pub fn add(&mut self, name: &'static str, kind: Kind) -> ResourceId {
        self.resources.push(Resource { name, kind });
        ResourceId(self.resources.len() as u32 - 1)
    }

    /// Appends a compute pass.
    ///
    /// # Panics
    ///
    /// When `bound` does not fit the pass's slots.
    pub fn compute(&mut self, pass: &'static Pass, bound: &[ResourceId]) {
        self.compute_sized(pass, bound, None);
    }

    /// Appends a compute pass of as many workgroups as `size` holds when it runs, but no more than there is room for.
    ///
    /// # Panics
    ///
    /// When `bound` does not fit the pass's slots, or `size` is no element of a buffer of [`Arguments`] or is in one
    /// that the pass writes.
    pub fn compute_sized(
        &mut self,
        pass: &'static Pass,
        bound: &[ResourceId],
        size: Option<WorkSize>,
    ) {
        self.push(Node {
            pass,
            bound: bound.to_vec(),
            layers: Vec::new(),
            clears: false,
            size,
        });
    }

    /// Appends a draw pass into `targets`, images or layers of them, which are first cleared to zero if `clears`.
    ///
    /// # Panics
    ///
    /// When `bound` or `targets` do not fit the pass.
    pub fn draw<T: Into<ImageLayer> + Copy>(
        &mut self,
        pass: &'static Pass,
        bound: &[ResourceId],
        targets: &[T],
        clears: bool,
    ) {
        self.draw_sized(pass, (bound, targets), clears, None);
    }

    /// Appends a draw pass of as many vertices as `size` holds when it runs.
    ///
    /// # Panics
    ///
    /// As [`Graph::draw`] and [`Graph::compute_sized`].
    pub fn draw_sized<T: Into<ImageLayer> + Copy>(
        &mut self,
        pass: &'static Pass,
        (bound, targets): (&[ResourceId], &[T]),
        clears: bool,
        size: Option<WorkSize>,
    ) {
        let targets = targets.iter().map(|target| (*target).into());
        let targets: Vec<ImageLayer> = targets.collect();
        let images = targets.iter().map(|target| target.image);
        self.push(Node {
            pass,
            bound: bound.iter().copied().chain(images).collect(),
            layers: targets.iter().map(|target| target.layer).collect(),
            clears,
            size,
        });
    }

    fn push(&mut self, node: Node) {
        // Check that every slot is bound.
        let (pass, slots) = (node.pass, node.pass.slots);
        let targets = pass.targets();
        assert_eq!(
            node.bound.len(),
            slots.len() + targets.len(),
            "pass {} binds another number",
            pass.name
        );

        // Check that every slot binds a resource of its own kind.
        for (slot, id) in slots.iter().zip(&node.bound) {
            let fits = match (self.resource(*id).kind, slot.access) {
                (Kind::Uniform { size }, Access::Uniform) => size == slot.element.size,
                (
                    Kind::Buffer { stride, .. },
                    Access::Read
                    | Access::Indices
                    | Access::Write
                    | Access::Update
                    | Access::Scatter
                    | Access::Append,
                ) => stride == slot.element.size,
                (Kind::Image { format, layers, .. }, Access::Texture(wanted)) => {
                    format == wanted && layers == 1
                }
                (Kind::Image { format, .. }, Access::Layered(wanted)) => format == wanted,
                _ => false,
            };
            assert!(
                fits,
                "pass {}: slot '{}' cannot bind '{}'",
                pass.name,
                slot.name,
                self.resource(*id).name
            );
        }

        // Check that the pass can draw into its targets.
        for (format, ImageLayer { image, layer }) in targets.iter().zip(node.targets()) {
            let fits = matches!(self.resource(image).kind, Kind::Image { format: have, layers, .. }
                if have == *format && layer < layers);
            assert!(
                fits,
                "pass {} cannot draw into layer {layer} of '{}'",
                pass.name,
                self.resource(image).name
            );
        }

        // Check that its size is there, and that it does not write it.
        if let Some(WorkSize { arguments, index }) = node.size {
            let fits = matches!(self.resource(arguments).kind, Kind::Buffer { stride, count }
                if stride == size_of::<Arguments>() && index < count);
            assert!(
                fits && node.indices().is_none() && writes(&node).all(|id| id != arguments),
                "pass {} cannot take its size from '{}'",
                pass.name,
                self.resource(arguments).name
            );
        }

        // Check that nothing is both written and used otherwise.
        for id in writes(&node) {
            let uses = node.bound.iter().filter(|other| **other == id).count();
            assert_eq!(
                uses,
                1,
                "pass {} both writes and uses '{}'",
                pass.name,
                self.resource(id).name
            );
        }
        self.nodes.push(node);
    }

    /// Whether another graph has the same resources and runs the same passes over them, so that a session of one serves
    /// the other. O(resources + nodes).
    pub fn is_same_as(&self, other: &Self) -> bool {
        let are_alike = |(a, b): (&Node, &Node)| {
            a.pass.name == b.pass.name
                && (&a.bound, &a.layers) == (&b.bound, &b.layers)
                && (a.clears, a.size) == (b.clears, b.size)
        };
        self.features == other.features
            && self.resources == other.resources
            && self.constants == other.constants
            && self.nodes.len() == other.nodes.len()
            && self.nodes.iter().zip(&other.nodes).all(are_alike)
    }

    /// The same graph with passes that can do everything, for comparisons.
    #[must_use]
    pub fn with_all_features(self) -> Self {
        let features = Features::ALL;
        Self { features, ..self }
    }

    /// The same graph with every pass over the whole room, for comparisons.
    #[must_use]
    pub fn without_sizes(mut self) -> Self {
        for node in &mut self.nodes {
            node.size = None;
        }
        self
    }

    /// Panics where a resource does not take `count` words from word `first` on.
    pub(crate) fn assert_takes(&self, id: ResourceId, first: usize, count: usize) {
        let resource = self.resource(id);
        let is_image = matches!(resource.kind, Kind::Image { .. });
        assert!(
            first.saturating_add(count) <= resource.word_count() && !(is_image && first > 0),
            "'{}' has no room for {count} words from word {first} on",
            resource.name,
        );
    }

    /// A resource by its id.
    pub fn resource(&self, id: ResourceId) -> &Resource {
        &self.resources[id.index()]
    }

    /// All resources; ids are indices into this list.
    pub fn resources(&self) -> &[Resource] {
        &self.resources
    }

    /// Resources that hold words from the start, with these words.
    pub(crate) fn held(&self) -> impl Iterator<Item = (ResourceId, &[u32])> {
        self.constants.iter().map(|(id, words)| (*id, &words[..]))
    }

    /// All nodes in running order.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The number of elements of a resource; texels of all layers of an image.
    pub fn element_count(&self, id: ResourceId) -> usize {
        match self.resource(id).kind {
            Kind::Uniform { .. } => 1,
            Kind::Buffer { count, .. } => count,
            Kind::Image { .. } => self.resource(id).word_count(),
        }
    }

    /// Where the words of a layer lie among those of its image.
    pub(crate) fn words_of(&self, ImageLayer { image, layer }: ImageLayer) -> Range<usize> {
        let count = match self.resource(image).kind {
            Kind::Image { size, .. } => area(size),
            _ => 0,
        };
        let start = layer as usize * count;
        start..start + count
    }

    /// The number of work items that a node has room for: elements, or texels where an image is counted.
    pub fn work_count(&self, node: &Node) -> usize {
        let count = self.element_count(node.bound[node.pass.counted_slot()]);
        match node.pass.work {
            Work::PerListed { .. } => count.saturating_sub(1),
            _ => count,
        }
    }

    /// Workgroups of a dispatch over all that its node has room for, in x and y; `None` if there are more than a
    /// dispatch can have.
    pub(crate) fn room_groups(&self, node: &Node) -> Option<[u32; 2]> {
        let count = self.work_count(node);
        groups_for(match node.pass.work {
            Work::PerRun { .. } => count.div_ceil(RUN),
            _ => count,
        })
    }

    /// The number of work items of a node whose size is these arguments: no more than it has room for.
    pub(crate) fn sized_work_count(&self, node: &Node, arguments: &Arguments) -> usize {
        let (x, y) = (u64::from(arguments.x), u64::from(arguments.y));
        let count = match node.pass.work {
            Work::PerElement { .. } | Work::PerListed { .. } => x * y * u64::from(WORKGROUP_SIZE),
            Work::PerRun { .. } => x * y * BLOCK as u64,
            Work::Draw { vertices, .. } => x / u64::from(vertices.max(1)),
        };
        let room = self.work_count(node);
        usize::try_from(count).map_or(room, |count| room.min(count))
    }

    /// Whether running a node changes anything: clearing does, even when nothing is drawn.
    pub(crate) fn acts(&self, node: &Node) -> bool {
        node.clears || self.work_count(node) > 0
    }

    /// Bytes of all resources together.
    pub fn planned_bytes(&self) -> u64 {
        self.resources
            .iter()
            .map(|resource| resource.word_count() as u64 * 4)
            .sum()
    }
}

/// Texels of a picture of this width and height.
pub(crate) fn area([width, height]: [u32; 2]) -> usize {
    width as usize * height as usize
}

/// Workgroups in x and y for a number of invocations, 0 in x for none, in rows of equal width; `None` if there are more
/// than a dispatch can have.
fn groups_for(invocation_count: usize) -> Option<[u32; 2]> {
    let count = u32::try_from(invocation_count).ok()?;
    if count == 0 {
        return Some([0, 1]);
    }
    let groups = count.div_ceil(WORKGROUP_SIZE);
    let rows = groups.div_ceil(MAX_GROUPS);
    Some([groups.div_ceil(rows), rows])
}

/// The lists that a node appends to.
pub(crate) fn lists(node: &Node) -> impl Iterator<Item = ResourceId> + '_ {
    emptied(node).filter_map(|(id, count)| count.map(|_| id))
}

/// What is 0 when a node begins: buffers, and how many of their first words, where not all.
pub(crate) fn emptied(node: &Node) -> impl Iterator<Item = (ResourceId, Option<usize>)> + '_ {
    let slots = node.pass.slots.iter().zip(&node.bound);
    slots.filter_map(|(slot, id)| match slot.access {
        Access::Append => Some((*id, Some(1))),
        Access::Scatter => Some((*id, None)),
        _ => None,
    })
}

/// The resources that a node writes.
pub(crate) fn writes(node: &Node) -> impl Iterator<Item = ResourceId> + '_ {
    let slots = node.pass.slots;
    node.bound
        .iter()
        .enumerate()
        .filter(move |(i, _)| slots.get(*i).is_none_or(|slot| slot.access.writes()))
        .map(|(_, id)| *id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_turn_into_rows_when_one_row_is_full() {
        let row = (MAX_GROUPS * WORKGROUP_SIZE) as usize;
        assert_eq!(groups_for(0), Some([0, 1]));
        assert_eq!(groups_for(1), Some([1, 1]));
        assert_eq!(groups_for(65), Some([2, 1]));
        assert_eq!(groups_for(row), Some([65535, 1]));
        assert_eq!(groups_for(row + 1), Some([32768, 2]));
        assert_eq!(groups_for(usize::MAX), None);
    }
}
