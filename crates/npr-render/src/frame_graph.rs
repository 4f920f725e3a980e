//! The graph of a frame: what its features share, and the passes that every frame has.

use npr_core::geometry::{ChartCorners, Influence, Part, PosedVertex, Triangle, Vertex};
use npr_core::outline::Outline;
use npr_core::window::{View, Window};
use npr_gpu::curves::work::{IndirectArguments, add_work};
use npr_gpu::engine::{EngineError, Session};
use npr_gpu::graph::{Graph, ResourceId, WorkSize};
use npr_gpu::pass::{Features, Format, Pass};
use npr_gpu::passes::{line, mesh, raster, shade};
use npr_mesh::pose::Matrix;
use npr_style::compose::{Compose, TriangleConstants};
use npr_style::even_tones::tiles_of;
use npr_style::lighting::Lights;

/// Numbers of elements that decide the sizes of buffers.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Counts {
    pub vertices: usize,
    pub joints: usize,
    pub triangles: usize,
    pub edges: usize,
    /// Triangles with a stroke chart.
    pub charts: usize,
    pub parts: usize,
    pub texel_words: usize,
}

/// Pixel grids of a tile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grids {
    pub output: [u32; 2],
    pub mask: [u32; 2],
    /// Colour samples per pixel along each axis.
    pub samples: u32,
}

impl Grids {
    /// The grid of colour samples.
    pub fn color(&self) -> [u32; 2] {
        self.output.map(|side| side * self.samples)
    }

    /// Pixels of the output.
    pub fn output_pixels(&self) -> usize {
        pixel_count(self.output)
    }

    /// Pixels of the mask.
    pub fn mask_pixels(&self) -> usize {
        pixel_count(self.mask)
    }
}

/// Pixels of a picture.
pub(crate) fn pixel_count([width, height]: [u32; 2]) -> usize {
    width as usize * height as usize
}

/// The size of a picture where it is needed, else that of a placeholder, a single texel.
pub(crate) fn size_if(is_needed: bool, size: [u32; 2]) -> [u32; 2] {
    if is_needed { size } else { [1, 1] }
}

/// Fills a resource.
pub(crate) fn write<T: bytemuck::NoUninit>(
    session: &mut dyn Session,
    id: ResourceId,
    elements: &[T],
) -> Result<(), EngineError> {
    session.write(id, bytemuck::cast_slice(elements))
}

/// A frame's graph and the resources that its features share.
#[derive(Debug, Clone)]
pub(crate) struct FrameGraph {
    pub graph: Graph,
    pub view: ResourceId,
    pub output_window: ResourceId,
    pub color_window: ResourceId,
    pub outline: ResourceId,
    pub compose: ResourceId,
    pub lights: ResourceId,
    pub vertices: ResourceId,
    pub influences: ResourceId,
    pub palette: ResourceId,
    pub triangles: ResourceId,
    pub charts: ResourceId,
    pub parts: ResourceId,
    pub texels: ResourceId,
    /// The picture: first ink beside the ribbons, where a method has any, which is stamps of lines that no mesh edge
    /// explains, the mask itself, or rims; then all of it.
    pub frame: ResourceId,
    /// Vertices in the view.
    pub posed: ResourceId,
    /// What is known of the triangles in the view.
    pub known: ResourceId,
    /// Pixels that are not filled at once: their number, then they.
    pub list: ResourceId,
    /// Triangle numbers and depths of colour samples.
    pub ids: ResourceId,
    pub depths: ResourceId,
    /// Size of the picture.
    output: [u32; 2],
}

/// What the last pass lays over surfaces; of a single texel where a style asks for none.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layers {
    pub beam_ids: ResourceId,
    pub ribbons: ResourceId,
    /// What the lights see, a layer each.
    pub shadows: ResourceId,
    /// Colours and depths of the smoke, and what the lights see of it, a layer each.
    pub smoke: [ResourceId; 3],
    /// The rules of background contrast.
    pub rules: ResourceId,
}

impl FrameGraph {
    /// The resources that stay for the whole frame, and the pass that poses vertices; no pass does more than
    /// `features`.
    pub fn new(counts: &Counts, grids: &Grids, features: Features) -> Self {
        // Add the resources that stay for the whole frame.
        let mut graph = Graph::with(features);
        let mut frame = Self {
            view: graph.uniform::<View>("view"),
            output_window: graph.uniform::<Window>("output window"),
            color_window: graph.uniform::<Window>("color window"),
            outline: graph.uniform::<Outline>("outline"),
            compose: graph.uniform::<Compose>("compose"),
            lights: graph.uniform::<Lights>("lights"),
            vertices: graph.buffer::<Vertex>("vertices", counts.vertices),
            influences: graph.buffer::<Influence>("influences", counts.vertices),
            palette: graph.buffer::<Matrix>("palette", counts.joints),
            triangles: graph.buffer::<Triangle>("triangles", counts.triangles),
            charts: graph.image(
                "charts",
                Format::U32,
                ChartCorners::image_size(counts.charts),
            ),
            parts: graph.buffer::<Part>("parts", counts.parts),
            texels: graph.buffer::<u32>("texels", counts.texel_words),
            frame: graph.buffer::<u32>("frame", grids.output_pixels()),
            posed: graph.buffer::<PosedVertex>("posed", counts.vertices),
            known: graph.buffer::<TriangleConstants>("known", counts.triangles),
            list: graph.buffer::<u32>("listed pixels", grids.output_pixels() + 1),
            ids: graph.image("ids", Format::U32, grids.color()),
            depths: graph.image("depths", Format::Depth, grids.color()),
            output: grids.output,
            graph,
        };

        // Pose the vertices.
        let bound = [
            frame.view,
            frame.outline,
            frame.vertices,
            frame.influences,
            frame.palette,
            frame.parts,
            frame.posed,
        ];
        frame.graph.compute(&mesh::POSE_VERTICES, &bound);
        frame
    }

    /// Adds the pass by which light changes the widths of lines; what follows reads its vertices.
    pub fn light_widths(&mut self, vertex_count: usize) {
        let lit = self.graph.buffer::<PosedVertex>("lit", vertex_count);
        let bound = [self.lights, self.parts, self.vertices, self.posed, lit];
        self.graph.compute(&line::LIGHT_WIDTHS, &bound);
        self.posed = lit;
    }

    /// Adds the pass that finds what is the same all over each triangle.
    pub fn know_triangles(&mut self) {
        let bound = [
            self.view,
            self.compose,
            self.lights,
            self.posed,
            self.vertices,
            self.triangles,
            self.parts,
            self.texels,
            self.known,
        ];
        self.graph.compute(&shade::KNOW_TRIANGLES, &bound);
    }

    /// Draws which triangle each pixel of a grid shows, and how deep.
    pub fn draw_ids(&mut self, window: ResourceId, ids: ResourceId, depths: ResourceId) {
        let bound = [
            self.view,
            window,
            self.posed,
            self.vertices,
            self.triangles,
            self.parts,
            self.texels,
        ];
        self.graph
            .draw(&raster::DRAW_IDS, &bound, &[ids, depths], true);
    }

    /// Triangle numbers and depths of colour samples without hulls, drawn again where the frame has any.
    pub fn ids_without_hulls(&mut self, grids: &Grids, has_hulls: bool) -> [ResourceId; 2] {
        if !has_hulls {
            return [self.ids, self.depths];
        }
        let ids = self.graph.image("bare ids", Format::U32, grids.color());
        let depths = self
            .graph
            .image("bare depths", Format::Depth, grids.color());
        self.draw_ids(self.color_window, ids, depths);
        [ids, depths]
    }

    /// Adds the pass that composes a picture: the colours of the triangles in `ids` with the layers over them, by the
    /// settings in `compose`. `sides` are the pictures of both sides of lines, for those whose colour follows what lies
    /// behind.
    pub fn compose_frame(
        &mut self,
        compose: ResourceId,
        ids: ResourceId,
        layers: &Layers,
        sides: [ResourceId; 2],
        frame: ResourceId,
    ) {
        // Even the tones, where a style asks for it.
        let evened = self.even_tones(compose, ids, layers);

        // Fill the pixels of one known colour, and list the others.
        let fill = [
            self.output_window,
            compose,
            ids,
            layers.beam_ids,
            layers.ribbons,
            layers.smoke[1],
            sides[0],
            self.known,
            frame,
            self.list,
            self.parts,
            evened,
        ];
        self.graph.compute(&shade::FILL_FRAME, &fill);

        // Compose those.
        let bound = [
            self.view,
            self.output_window,
            compose,
            self.lights,
            ids,
            layers.beam_ids,
            layers.ribbons,
            self.posed,
            self.vertices,
            self.known,
            self.parts,
            self.texels,
            self.charts,
            self.list,
            frame,
            layers.shadows,
        ];
        let bound = [
            &bound[..],
            &layers.smoke,
            &[layers.rules],
            &sides,
            &[evened, self.triangles],
        ];
        let bound = bound.concat();
        self.compute_listed(&shade::COMPOSE_FRAME, &bound, self.list);
    }

    /// Adds the passes that even the tones of the triangles in `ids`; gives what they make, a single texel where no
    /// part asks for it.
    fn even_tones(&mut self, compose: ResourceId, ids: ResourceId, layers: &Layers) -> ResourceId {
        // Make room for it.
        let evens = self.graph.features().meets(Features::EVEN_TONES);
        let size = size_if(evens, self.output);
        let evened = self.graph.image("evened tones", Format::U32, size);
        if !evens {
            return evened;
        }
        let tone_map = self.graph.buffer::<u32>("tone map", pixel_count(size));
        let tiles = tiles_of(self.output);
        let tone_flags = self.graph.image("tone flags", Format::U32, tiles);

        // Find the tone of every pixel, then the tiles with several, then the medians.
        let bound = [
            self.view,
            self.output_window,
            compose,
            self.lights,
            ids,
            self.posed,
            self.vertices,
            self.known,
            self.parts,
            self.texels,
            layers.shadows,
            layers.smoke[2],
            tone_map,
            self.triangles,
        ];
        self.graph.compute(&shade::FIND_TONES, &bound);
        let (window, parts) = (self.output_window, self.parts);
        let bound = [window, parts, tone_map];
        self.graph
            .draw(&shade::FLAG_TONES, &bound, &[tone_flags], true);
        let bound = [window, parts, tone_map, tone_flags];
        self.graph.draw(&shade::EVEN_TONES, &bound, &[evened], true);
        evened
    }

    /// Appends a pass over the elements of a list; gives its size, for further passes over them.
    pub fn compute_listed(
        &mut self,
        pass: &'static Pass,
        bound: &[ResourceId],
        list: ResourceId,
    ) -> Option<WorkSize> {
        let room = self.graph.element_count(list) - 1;
        let work = add_work(&mut self.graph, list, room, IndirectArguments::default());
        self.graph.compute_sized(pass, bound, work.elements());
        work.elements()
    }
}
