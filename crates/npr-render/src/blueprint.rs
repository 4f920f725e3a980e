//! The graph of a frame: which passes a style needs, over which resources.

use crate::smoke::{Needs, SmokePlan};
use npr_core::geometry::{
    ChartCorners, Edge, GPixel, Influence, Part, PosedVertex, Stamp, Triangle, Vertex,
};
use npr_core::line_color::LineTint;
use npr_core::outline::Outline;
use npr_core::window::{View, Window};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Format;
use npr_gpu::passes::{backdrop, line, mesh, raster, shade};
use npr_mesh::pose::Matrix;
use npr_style::backdrop::{ContrastBias, PartSubject, Rim, Rules, TILE, TileRims};
use npr_style::compose::Compose;
use npr_style::lighting::Lights;
use npr_style::shadow::{SHADOW_SIDE, SHADOWS_MAX};
use npr_stylesheet::{LineMethod, Style};
use npr_vector::screen::residual::tile_count;

/// Numbers of elements that decide buffer sizes.
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
    /// Parts that are beams of light.
    pub beams: usize,
    /// Lights that throw shadows.
    pub shadows: usize,
    /// What smoke needs, where there is any.
    pub smoke: Option<Needs>,
}

/// Pixel grids of a tile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grids {
    pub output: [u32; 2],
    pub mask: [u32; 2],
    /// Colour samples per pixel along each axis.
    pub samples: u32,
}

/// What a line method is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Method {
    /// Lines are detected on the G-buffer.
    pub mask: bool,
    /// Edges are drawn as ribbons.
    pub ribbons: bool,
    /// What no ribbon explains is stamped.
    pub residual: bool,
    /// The mask itself is drawn.
    pub filter: bool,
    /// A hull is drawn behind.
    pub hull: bool,
    /// The colour of lines is decided at their place.
    pub paints: bool,
    /// Light changes the width of lines.
    pub light_widths: bool,
    /// Pixels around subjects are drawn.
    pub rim: bool,
    /// Borders between subjects are found: some lines mind what lies behind them.
    pub contrast: bool,
    /// Layers that the last pass lays over the surfaces.
    pub layers: u32,
}

impl Method {
    /// No lines at all.
    pub const NONE: Self = Self {
        mask: false,
        ribbons: false,
        residual: false,
        filter: false,
        hull: false,
        paints: false,
        light_widths: false,
        rim: false,
        contrast: false,
        layers: 0,
    };

    /// What a style's own method and those of its rules need together.
    pub fn of(style: &Style) -> Self {
        let rules = style.rule.iter().filter_map(|rule| rule.line.method);
        let own = Self::of_one(style.line.method, style);
        rules.fold(own, |all, method| all.and(Self::of_one(method, style)))
    }

    fn and(self, other: Self) -> Self {
        Self {
            mask: self.mask || other.mask,
            ribbons: self.ribbons || other.ribbons,
            residual: self.residual || other.residual && !self.filter && !self.rim,
            filter: self.filter || other.filter,
            hull: self.hull || other.hull,
            paints: self.paints || other.paints,
            light_widths: self.light_widths || other.light_widths,
            rim: self.rim || other.rim,
            contrast: self.contrast || other.contrast,
            layers: self.layers | other.layers,
        }
    }

    fn of_one(method: LineMethod, style: &Style) -> Self {
        let none = Self::NONE;
        let masked = Self { mask: true, ..none };
        let filter = Self {
            filter: true,
            layers: Compose::OVERLAY,
            ..masked
        };
        match method {
            LineMethod::Off | LineMethod::Angle | LineMethod::Curves | LineMethod::Potrace => none,
            LineMethod::Shape => {
                let residual = style.line.kinds.intersection;
                let stamps = if residual { Compose::OVERLAY } else { 0 };
                Self {
                    ribbons: true,
                    residual,
                    layers: Compose::RIBBONS | stamps,
                    ..masked
                }
            }
            LineMethod::Okuya | LineMethod::Edges => Self {
                ribbons: true,
                layers: Compose::RIBBONS,
                ..masked
            },
            LineMethod::Filter => filter,
            LineMethod::Hull => Self { hull: true, ..none },
            LineMethod::Rim => Self {
                rim: true,
                layers: Compose::OVERLAY,
                ..none
            },
            LineMethod::FilterHull => Self {
                hull: true,
                ..filter
            },
        }
    }
}

/// A frame's graph and the resources that the host fills or reads.
#[derive(Debug, Clone)]
pub(crate) struct Blueprint {
    pub graph: Graph,
    pub view: ResourceId,
    pub output_window: ResourceId,
    pub color_window: ResourceId,
    pub mask_window: ResourceId,
    pub outline: ResourceId,
    pub compose: ResourceId,
    /// Where borders between subjects are found, if anywhere.
    pub backdrop: Option<BackdropPlan>,
    pub rules: ResourceId,
    pub fronts: ResourceId,
    pub backs: ResourceId,
    pub lights: ResourceId,
    /// The grid of every shadow image, and the views of the lights that throw shadows.
    pub shadow_window: ResourceId,
    pub light_views: Vec<ResourceId>,
    pub vertices: ResourceId,
    pub influences: ResourceId,
    pub palette: ResourceId,
    pub triangles: ResourceId,
    pub edges: ResourceId,
    pub charts: ResourceId,
    pub parts: ResourceId,
    pub texels: ResourceId,
    pub frame: ResourceId,
    /// Smoke, where there is any.
    pub smoke: Option<SmokePlan>,
    posed: ResourceId,
    ids: ResourceId,
    beam_ids: ResourceId,
    depths: ResourceId,
    mask: ResourceId,
    tints: ResourceId,
    ribbons: ResourceId,
    overlay: ResourceId,
    shadows: [ResourceId; SHADOWS_MAX],
    /// Depths of the same, kept apart only where they fall on smoke.
    shadow_depths: [ResourceId; SHADOWS_MAX],
}

/// What the host fills where borders between subjects are found.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BackdropPlan {
    /// The grid of tiles over the output.
    pub tile_window: ResourceId,
    /// Settings of the picture without lines.
    pub bare_compose: ResourceId,
    pub part_subjects: ResourceId,
    /// Which way lines moved in the frame before.
    pub kept_biases: ResourceId,
}

impl Blueprint {
    pub fn new(counts: &Counts, grids: &Grids, method: Method) -> Self {
        let mut plan = Self::inputs(counts, grids, method);
        plan.pose();
        if method.light_widths {
            plan.light_widths(counts.vertices);
        }
        plan.draw_shadows(counts);
        plan.draw_ids(plan.color_window, plan.ids, plan.depths);
        if method.mask {
            plan.find_lines(grids, method);
        }
        if method.hull {
            plan.draw_hull(counts.vertices);
        }
        if counts.beams > 0 {
            plan.draw_beams(grids);
        }
        if let Some(needs) = &counts.smoke {
            let (window, surfaces) = (plan.output_window, plan.shadow_depths);
            plan.smoke = Some(SmokePlan::new(&mut plan.graph, needs, window, surfaces));
        }
        if method.rim || method.contrast {
            plan.find_rims(counts, grids, method);
        }
        plan.compose_frame(
            plan.compose,
            plan.ids,
            [plan.fronts, plan.backs],
            plan.frame,
        );
        plan
    }

    /// The resources that stay for the whole frame. Layers that a method lacks are of a single texel.
    fn inputs(counts: &Counts, grids: &Grids, method: Method) -> Self {
        let mut graph = Graph::new();
        let pixel_count = |size: [u32; 2]| size[0] as usize * size[1] as usize;
        let only = |needed: bool, size: [u32; 2]| if needed { size } else { [1, 1] };
        let color = grids.output.map(|side| side * grids.samples);
        let shadow = |i| only(i < counts.shadows, [SHADOW_SIDE; 2]);
        let first = graph.image("shadow depths", Format::Depth, shadow(0));
        let takes_shadows = counts.smoke.is_some_and(|needs| needs.takes_shadows);
        let mut shadow_depths = [first; SHADOWS_MAX];
        if takes_shadows {
            for (i, depths) in (1..).zip(&mut shadow_depths[1..]) {
                *depths = graph.image("shadow depths", Format::Depth, shadow(i));
            }
        }
        let overlay = method.residual || method.filter || method.rim;
        let overlay = pixel_count(only(overlay, grids.output));
        let sides = only(method.rim || method.contrast, grids.output);
        Self {
            view: graph.uniform::<View>("view"),
            output_window: graph.uniform::<Window>("output window"),
            color_window: graph.uniform::<Window>("color window"),
            mask_window: graph.uniform::<Window>("mask window"),
            outline: graph.uniform::<Outline>("outline"),
            compose: graph.uniform::<Compose>("compose"),
            backdrop: None,
            rules: graph.uniform::<Rules>("rules"),
            fronts: graph.image("fronts", Format::Rgba8, sides),
            backs: graph.image("backs", Format::Rgba8, sides),
            lights: graph.uniform::<Lights>("lights"),
            shadow_window: graph.uniform::<Window>("shadow window"),
            light_views: (0..counts.shadows)
                .map(|_| graph.uniform::<Matrix>("light view"))
                .collect(),
            shadows: std::array::from_fn(|i| graph.image("shadow", Format::U32, shadow(i))),
            shadow_depths,
            vertices: graph.buffer::<Vertex>("vertices", counts.vertices),
            influences: graph.buffer::<Influence>("influences", counts.vertices),
            palette: graph.buffer::<Matrix>("palette", counts.joints),
            triangles: graph.buffer::<Triangle>("triangles", counts.triangles),
            edges: graph.buffer::<Edge>("edges", counts.edges),
            charts: graph.buffer::<ChartCorners>("charts", counts.charts),
            parts: graph.buffer::<Part>("parts", counts.parts),
            texels: graph.buffer::<u32>("texels", counts.texel_words),
            frame: graph.buffer::<u32>("frame", pixel_count(grids.output)),
            smoke: None,
            posed: graph.buffer::<PosedVertex>("posed", counts.vertices),
            ids: graph.image("ids", Format::U32, color),
            beam_ids: graph.image("beam ids", Format::U32, only(counts.beams > 0, color)),
            depths: graph.image("depths", Format::Depth, color),
            mask: graph.buffer::<u32>("mask", pixel_count(only(method.mask, grids.mask))),
            tints: graph.buffer::<LineTint>(
                "line tints",
                pixel_count(only(method.mask && method.paints, grids.mask)),
            ),
            ribbons: graph.image("ribbons", Format::Rgba8, only(method.ribbons, grids.output)),
            overlay: graph.buffer::<u32>("overlay", overlay),
            graph,
        }
    }

    fn pose(&mut self) {
        let bound = [
            self.view,
            self.outline,
            self.vertices,
            self.influences,
            self.palette,
            self.parts,
            self.posed,
        ];
        self.graph.compute(&mesh::POSE_VERTICES, &bound);
    }

    /// Widths by light, for all that follows.
    fn light_widths(&mut self, vertex_count: usize) {
        let lit = self.graph.buffer::<PosedVertex>("lit", vertex_count);
        let bound = [self.lights, self.parts, self.vertices, self.posed, lit];
        self.graph.compute(&line::LIGHT_WIDTHS, &bound);
        self.posed = lit;
    }

    /// What every light with shadows sees; one list of vertices serves them all in turn.
    fn draw_shadows(&mut self, counts: &Counts) {
        if counts.shadows == 0 {
            return;
        }
        let projected = self.graph.buffer::<[f32; 4]>("projected", counts.vertices);
        let targets = self.shadows.into_iter().zip(self.shadow_depths);
        for (view, (shadow, depths)) in self.light_views.iter().zip(targets) {
            let project = [*view, self.posed, projected];
            self.graph.compute(&mesh::PROJECT_SHADOW, &project);
            let bound = [
                self.shadow_window,
                projected,
                self.vertices,
                self.triangles,
                self.parts,
                self.texels,
            ];
            self.graph
                .draw(&raster::DRAW_SHADOW, &bound, &[shadow, depths], true);
        }
    }

    fn draw_ids(&mut self, window: ResourceId, ids: ResourceId, depths: ResourceId) {
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

    /// Detection on the mask's grid, then drawing on the output's [Okuya et al. 2016, figure 9].
    fn find_lines(&mut self, grids: &Grids, method: Method) {
        let ids = self.mask_ids(grids);
        let mask_pixels = grids.mask[0] as usize * grids.mask[1] as usize;
        let gbuffer = self.graph.buffer::<GPixel>("gbuffer", mask_pixels);
        let resolve = [
            self.view,
            self.mask_window,
            ids,
            self.posed,
            self.triangles,
            self.parts,
            gbuffer,
        ];
        self.graph.compute(&line::RESOLVE_GBUFFER, &resolve);
        let detect = [
            self.view,
            self.mask_window,
            self.outline,
            self.parts,
            gbuffer,
            self.mask,
        ];
        self.graph.compute(&line::DETECT, &detect);
        if method.paints {
            self.color_mask(ids);
        }
        if method.ribbons {
            self.draw_ribbons(grids, gbuffer);
        }
        if method.residual {
            self.stamp_residual(grids, gbuffer);
        }
        if method.filter {
            let (output, mask) = (self.output_window, self.mask_window);
            let bound = [
                output,
                mask,
                self.compose,
                self.parts,
                self.mask,
                self.tints,
                self.overlay,
            ];
            self.graph.compute(&line::DRAW_MASK, &bound);
        }
    }

    /// What lines have their colours from, where they run.
    fn color_mask(&mut self, ids: ResourceId) {
        let bound = [
            self.view,
            self.mask_window,
            self.compose,
            self.lights,
            ids,
            self.posed,
            self.vertices,
            self.triangles,
            self.parts,
            self.texels,
            self.mask,
            self.tints,
        ];
        self.graph.compute(&line::COLOR_MASK, &bound);
    }

    /// Triangle numbers on the mask's grid; the colour samples serve where both grids are the same.
    fn mask_ids(&mut self, grids: &Grids) -> ResourceId {
        if grids.samples == 1 && grids.mask == grids.output {
            return self.ids;
        }
        let ids = self.graph.image("mask ids", Format::U32, grids.mask);
        let depths = self.graph.image("mask depths", Format::Depth, grids.mask);
        self.draw_ids(self.mask_window, ids, depths);
        ids
    }

    fn draw_ribbons(&mut self, grids: &Grids, gbuffer: ResourceId) {
        let edge_count = self.graph.element_count(self.edges);
        let kinds = self.graph.buffer::<u32>("kinds", edge_count);
        let classify = [
            self.outline,
            self.posed,
            self.triangles,
            self.parts,
            self.edges,
            kinds,
        ];
        self.graph.compute(&mesh::CLASSIFY_EDGES, &classify);
        let keys = self.graph.image("ribbon keys", Format::Depth, grids.output);
        let ribbons = [
            self.view,
            self.output_window,
            self.mask_window,
            self.outline,
            self.posed,
            self.triangles,
            self.parts,
            self.edges,
            kinds,
            gbuffer,
            self.mask,
            self.tints,
        ];
        self.graph
            .draw(&line::DRAW_RIBBONS, &ribbons, &[self.ribbons, keys], true);
    }

    fn stamp_residual(&mut self, grids: &Grids, gbuffer: ResourceId) {
        let mask_pixels = grids.mask[0] as usize * grids.mask[1] as usize;
        let stamps = self.graph.buffer::<Stamp>("stamps", mask_pixels);
        let smoothed = self.graph.buffer::<Stamp>("smoothed stamps", mask_pixels);
        let tiles = self.graph.buffer::<u32>("tiles", tile_count(grids.mask));
        let (output, mask) = (self.output_window, self.mask_window);
        let find = [
            output,
            mask,
            self.parts,
            gbuffer,
            self.mask,
            self.ribbons,
            stamps,
        ];
        self.graph.compute(&line::FIND_RESIDUAL, &find);
        self.graph
            .compute(&line::SMOOTH_STAMPS, &[mask, stamps, smoothed]);
        self.graph
            .compute(&line::FLAG_TILES, &[mask, stamps, tiles]);
        let stamp = [
            output,
            mask,
            self.outline,
            self.parts,
            smoothed,
            tiles,
            self.tints,
            self.overlay,
        ];
        self.graph.compute(&line::STAMP_RESIDUAL, &stamp);
    }

    fn draw_hull(&mut self, vertex_count: usize) {
        let hull = self.graph.buffer::<[f32; 4]>("hull", vertex_count);
        let extrude = [
            self.view,
            self.vertices,
            self.influences,
            self.palette,
            self.posed,
            hull,
        ];
        self.graph.compute(&mesh::EXTRUDE_HULL, &extrude);
        let bound = [
            self.view,
            self.color_window,
            hull,
            self.vertices,
            self.triangles,
            self.parts,
            self.texels,
        ];
        self.graph
            .draw(&raster::DRAW_HULL, &bound, &[self.ids, self.depths], false);
    }

    fn draw_beams(&mut self, grids: &Grids) {
        let color = grids.output.map(|side| side * grids.samples);
        let depths = self.graph.image("beam depths", Format::Depth, color);
        let bound = [self.color_window, self.posed, self.triangles, self.parts];
        self.graph
            .draw(&raster::DRAW_BEAMS, &bound, &[self.beam_ids, depths], true);
    }

    /// The picture without lines near borders between subjects, the colours of both sides, and where they reach.
    fn find_rims(&mut self, counts: &Counts, grids: &Grids, method: Method) {
        let pixels = grids.output[0] as usize * grids.output[1] as usize;
        let tiles = grids.output.map(|side| side.div_ceil(TILE));
        let tile_count = tiles[0] as usize * tiles[1] as usize;
        let plan = BackdropPlan {
            tile_window: self.graph.uniform::<Window>("tile window"),
            bare_compose: self.graph.uniform::<Compose>("bare compose"),
            part_subjects: self
                .graph
                .buffer::<PartSubject>("part_subjects", counts.parts),
            kept_biases: self.graph.buffer::<ContrastBias>("kept biases", tile_count),
        };
        let [ids, depths] = self.bare_ids(grids, method);
        let busy = self.graph.image("busy", Format::Rgba8, tiles);
        let bare = self.graph.buffer::<u32>("bare", pixels);
        let rims = self.graph.buffer::<Rim>("rims", pixels);
        let smoothed = self.graph.buffer::<Rim>("smoothed rims", pixels);
        let columns = self.graph.buffer::<u32>("columns", pixels);
        let gathered = self.graph.buffer::<TileRims>("gathered", tile_count);
        let bounds = self.graph.buffer::<ContrastBias>("bounds", tile_count);
        let biases = self.graph.buffer::<ContrastBias>("biases", tile_count);
        let blended = self
            .graph
            .buffer::<ContrastBias>("blended biases", tile_count);
        let (window, rules) = (self.output_window, self.rules);
        let flag = [
            plan.tile_window,
            window,
            rules,
            ids,
            self.triangles,
            plan.part_subjects,
        ];
        self.graph.draw(&backdrop::FLAG_TILES, &flag, &[busy], true);
        self.compose_frame(plan.bare_compose, ids, [busy; 2], bare);
        let find = [
            window,
            rules,
            ids,
            depths,
            self.ids,
            busy,
            self.ribbons,
            self.triangles,
            self.parts,
            plan.part_subjects,
            bare,
            self.overlay,
            rims,
        ];
        self.graph.compute(&backdrop::FIND_RIMS, &find);
        if method.rim {
            let draw = [self.parts, rims, self.overlay];
            self.graph.compute(&backdrop::DRAW_RIMS, &draw);
        }
        self.graph
            .compute(&backdrop::SMOOTH_RIMS, &[window, rules, rims, smoothed]);
        let gather = [window, rules, self.parts, smoothed, gathered];
        self.graph.compute(&backdrop::GATHER_TILES, &gather);
        self.graph
            .compute(&backdrop::BOUND_TILES, &[window, rules, gathered, bounds]);
        let bias = [window, rules, gathered, bounds, plan.kept_biases, biases];
        self.graph.compute(&backdrop::VOTE_BIAS, &bias);
        let blend = [window, rules, biases, plan.kept_biases, blended];
        self.graph.compute(&backdrop::BLEND_BIASES, &blend);
        self.graph
            .compute(&backdrop::SPREAD_ROWS, &[window, rules, smoothed, columns]);
        let (spread, sides) = (
            [window, rules, smoothed, columns, blended],
            [self.fronts, self.backs],
        );
        self.graph
            .draw(&backdrop::SPREAD_RIMS, &spread, &sides, true);
        self.backdrop = Some(plan);
    }

    /// Triangle numbers and depths without hulls.
    fn bare_ids(&mut self, grids: &Grids, method: Method) -> [ResourceId; 2] {
        if !method.hull {
            return [self.ids, self.depths];
        }
        let color = grids.output.map(|side| side * grids.samples);
        let ids = self.graph.image("bare ids", Format::U32, color);
        let depths = self.graph.image("bare depths", Format::Depth, color);
        self.draw_ids(self.color_window, ids, depths);
        [ids, depths]
    }

    /// The last pass, by some settings over some triangle numbers.
    fn compose_frame(
        &mut self,
        compose: ResourceId,
        ids: ResourceId,
        sides: [ResourceId; 2],
        frame: ResourceId,
    ) {
        let bound = [
            self.view,
            self.output_window,
            compose,
            self.lights,
            ids,
            self.beam_ids,
            self.ribbons,
            self.posed,
            self.vertices,
            self.triangles,
            self.parts,
            self.texels,
            self.charts,
            self.overlay,
            frame,
        ];
        let smoke = SmokePlan::composed(self.smoke.as_ref(), &mut self.graph);
        let bound = [&bound[..], &self.shadows, &smoke, &[self.rules], &sides].concat();
        self.graph.compute(&shade::COMPOSE_FRAME, &bound);
    }
}
