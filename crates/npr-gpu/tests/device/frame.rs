//! What every slot of every pass holds in a frame: the scene, and what the twins make of it.

use crate::scene::{
    FRAME_PX, Look, PART_WIDTHS, SHADOW_SIDE, SHADOWS, Scene, bare_compose, compose, lights,
    outline, part_subjects, rules, sampled_lines, shadow_of, smoke_look, spheres, strokes, view,
};
use npr_core::geometry::{ChartCorners, EdgeRole, GPixel, Stamp};
use npr_core::smoke::SphereView;
use npr_core::window::Window;
use npr_gpu::curves::sums::add_compact;
use npr_gpu::curves::work::ListWork;
use npr_gpu::engine::Engine;
use npr_gpu::graph::{Graph, ImageLayer, Kind, ResourceId};
use npr_gpu::pass::{Access, Format, Pass, Slot};
use npr_gpu::passes::{backdrop, line, mesh, raster, shade, smoke, stroke};
use npr_gpu::processor::Processor;
use npr_style::backdrop::{ContrastBias, TILE, TileRims};
use npr_style::compose::TriangleConstants;
use npr_style::even_tones::tiles_of;
use npr_vector::ink_point::InkPoint;
use npr_vector::sampled::PartWidths;
use std::collections::BTreeMap;

/// Slots that bind a resource of another name: two passes work on the grid of the mask only and call it the window.
const RENAMED: [(&str, &str, &str); 28] = [
    ("stroke.see_samples", "window", "sample_window"),
    ("stroke.ink_samples", "points", "sampled_points"),
    ("shade.compose_frame", "triangles", "known"),
    ("shade.compose_frame", "surfaces", "triangles"),
    ("shade.find_tones", "triangles", "known"),
    ("shade.find_tones", "surfaces", "triangles"),
    ("backdrop.flag_tiles", "window", "tile_window"),
    ("backdrop.flag_tiles", "output_window", "window"),
    ("backdrop.flag_tiles", "ids", "bare_ids"),
    ("backdrop.find_rims", "ids", "bare_ids"),
    ("backdrop.find_rims", "depths", "bare_depth"),
    ("backdrop.find_rims", "drawn_ids", "ids"),
    ("backdrop.draw_rims", "overlay", "rim_lines"),
    ("backdrop.gather_tiles", "rims", "smoothed_rims"),
    ("backdrop.vote_bias", "before", "kept_biases"),
    ("backdrop.blend_biases", "kept", "kept_biases"),
    ("backdrop.blend_biases", "blended", "blended_biases"),
    ("backdrop.spread_rows", "rims", "smoothed_rims"),
    ("backdrop.spread_rims", "rims", "smoothed_rims"),
    ("backdrop.spread_rims", "biases", "blended_biases"),
    ("raster.draw_shadow", "window", "shadow_window"),
    ("line.resolve_gbuffer", "window", "mask_window"),
    ("line.resolve_gbuffer", "ids", "mask_ids"),
    ("line.detect", "window", "mask_window"),
    ("line.color_mask", "window", "mask_window"),
    ("line.color_mask", "ids", "mask_ids"),
    ("backdrop.smooth_rims", "smoothed", "smoothed_rims"),
    ("line.stamp_residual", "stamped", "overlay"),
];

/// Slots that passes update, and a resource that holds what they held before.
const UPDATED: [(&str, &str, &str); 5] = [
    ("line.find_residual", "stamps", "no_stamps"),
    ("line.smooth_stamps", "smoothed", "no_stamps"),
    ("line.stamp_residual", "stamped", "claims"),
    ("shade.fill_frame", "frame", "overlay"),
    ("shade.compose_frame", "frame", "overlay"),
];

/// The resource that a slot of a pass binds.
fn resource_of(pass: &Pass, slot: &'static str) -> &'static str {
    let renamed = RENAMED
        .iter()
        .find(|(name, other, _)| (*name, *other) == (pass.name, slot));
    renamed.map_or(slot, |(_, _, resource)| *resource)
}

/// What a resource holds, and its size and layers where it is an image.
#[derive(Debug, Clone)]
pub struct Content {
    pub words: Vec<u32>,
    pub size: [u32; 2],
    pub layers: u32,
}

/// The contents of a frame by slot name.
pub struct Frame {
    contents: BTreeMap<&'static str, Content>,
}

impl Frame {
    /// The names of what passes make.
    pub const MADE: [&str; 64] = [
        "gaps",
        "verdicts",
        "clear",
        "clear_slots",
        "clear_list",
        "visible",
        "part_starts",
        "part_slots",
        "part_firsts",
        "sampled_points",
        "list",
        "posed",
        "lit",
        "projected",
        "shadows",
        "roles",
        "hull",
        "ids",
        "beam_ids",
        "balls",
        "smoke_ids",
        "smoke_lights",
        "pixels",
        "gathered",
        "blurred",
        "cells",
        "tones",
        "smoke_colors",
        "smoke_depths",
        "depth",
        "mask_ids",
        "gbuffer",
        "mask",
        "tints",
        "ribbons",
        "keys",
        "inked",
        "ink_keys",
        "stamps",
        "owners",
        "found",
        "smoothed",
        "claims",
        "covered",
        "overlay",
        "known",
        "tone_map",
        "tone_flags",
        "evened",
        "busy",
        "bare",
        "rims",
        "smoothed_rims",
        "tile_rims",
        "bounds",
        "kept_biases",
        "biases",
        "blended_biases",
        "rim_lines",
        "columns",
        "fronts",
        "backs",
        "frame",
        "picture_depths",
    ];

    /// A frame of the test scene with an output and a mask of these sizes, every pass run by its twin.
    pub fn new(look: Look, size: [u32; 2], mask_size: [u32; 2]) -> Self {
        Self::run_on(&Processor, look, size, mask_size)
    }

    /// The same on any engine.
    pub fn run_on(engine: &dyn Engine, look: Look, size: [u32; 2], mask_size: [u32; 2]) -> Self {
        let mut builder = Builder::default();
        builder.give_scene(look, size, mask_size);
        builder.line_up_passes(look, size, mask_size);
        builder.run(engine)
    }

    /// What a slot that a pass updates holds before it.
    pub fn before(&self, pass: &Pass, slot: &Slot) -> Option<Vec<u32>> {
        let is_updated = slot.access == Access::Update;
        let found = UPDATED
            .iter()
            .find(|(name, updated, _)| (*name, *updated) == (pass.name, slot.name));
        assert_eq!(found.is_some(), is_updated, "{}: {}", pass.name, slot.name);
        found.map(|(_, _, resource)| self.named(resource).words.clone())
    }

    /// What a slot of a pass binds.
    ///
    /// # Panics
    ///
    /// Where the frame has no input for it: a new pass brings its inputs along.
    pub fn content(&self, pass: &Pass, slot: &'static str) -> &Content {
        let name = resource_of(pass, slot);
        self.contents
            .get(name)
            .unwrap_or_else(|| panic!("no input for slot '{slot}' of pass {}", pass.name))
    }

    /// What the resource of a name holds.
    pub fn named(&self, name: &str) -> &Content {
        &self.contents[name]
    }

    /// Size of the image that a draw pass draws into.
    pub fn target_size(&self, pass: &Pass) -> [u32; 2] {
        let words = &self.content(pass, "window").words;
        let window: Window = bytemuck::pod_read_unaligned(bytemuck::cast_slice(words));
        match pass.name == shade::FLAG_TONES.name {
            true => tiles_of(window.size),
            false => window.size,
        }
    }
}

#[derive(Default)]
struct Builder {
    graph: Graph,
    ids: BTreeMap<&'static str, ResourceId>,
    given: Vec<(ResourceId, Vec<u32>)>,
}

impl Builder {
    fn give_scene(&mut self, look: Look, size: [u32; 2], mask_size: [u32; 2]) {
        let scene = Scene::new();
        let frame_px = FRAME_PX.map(|side| side as f32);
        let over_frame = |size| Window::over(frame_px, [0.0; 2], frame_px, size);
        self.give_uniform("view", &[view(look)]);
        self.give_uniform("outline", &[outline(look)]);
        self.give_uniform("compose", &[compose(look, &scene)]);
        self.give_uniform("bare_compose", &[bare_compose(look, &scene)]);
        self.give_uniform("rules", &[rules(look)]);
        self.give_buffer("part_subjects", &part_subjects());
        self.give_uniform("lights", &[lights(look)]);
        let light_view = lights(look).shadows[shadow_of(look) as usize];
        self.give_uniform("light_from_world", &[light_view]);
        let shadow_px = [SHADOW_SIDE as f32; 2];
        let shadow_window = Window::over(shadow_px, [0.0; 2], shadow_px, [SHADOW_SIDE; 2]);
        self.give_uniform("shadow_window", &[shadow_window]);
        self.give_uniform("window", &[over_frame(size)]);
        self.give_uniform("mask_window", &[over_frame(mask_size)]);
        let samples = compose(look, &scene).samples;
        self.give_uniform(
            "sample_window",
            &[over_frame(size.map(|side| side * samples))],
        );
        self.give_buffer("vertices", &scene.vertices);
        self.give_buffer("influences", &scene.influences);
        self.give_buffer("palette", &scene.palette);
        self.give_buffer("parts", &scene.parts);
        self.give_buffer("triangles", &scene.triangles);
        self.give_buffer("edges", &scene.edges);
        let charts = Kind::Image {
            format: Format::U32,
            size: ChartCorners::image_size(scene.charts.len()),
            layers: 1,
        };
        self.give("charts", charts, bytemuck::cast_slice(&scene.charts));
        self.give_buffer("texels", &scene.texels);
        self.give_buffer("brushes", &scene.brushes);
        self.make_buffer("posed", 48, scene.vertices.len());
        self.make_buffer("lit", 48, scene.vertices.len());
        self.make_buffer("projected", 16, scene.vertices.len());
        self.make_layers("shadows", Format::U32, [SHADOW_SIDE; 2], SHADOWS);
        self.make_layers("surface_depths", Format::Depth, [SHADOW_SIDE; 2], SHADOWS);
        self.give_smoke(look, size);
        self.make_buffer("tone_map", 4, area(size));
        self.make_image("evened", Format::U32, size);
        self.make_image("tone_flags", Format::U32, tiles_of(size));
        self.make_buffer("hull", 16, scene.vertices.len());
        self.make_buffer("roles", size_of::<EdgeRole>(), scene.edges.len());
        self.make_image("ids", Format::U32, size.map(|side| side * samples));
        self.make_image("beam_ids", Format::U32, size.map(|side| side * samples));
        self.make_image("depth", Format::Depth, size.map(|side| side * samples));
        self.make_image("beam_depth", Format::Depth, size.map(|side| side * samples));
    }

    fn give_smoke(&mut self, look: Look, size: [u32; 2]) {
        let smoke = smoke_look(look, size);
        let spheres = spheres();
        self.give_uniform("lens", &[SphereView::of_view(&view(look))]);
        let light_view = lights(look).shadows[shadow_of(look) as usize];
        let light = SphereView::of_light(&light_view, SHADOW_SIDE);
        self.give_uniform("light_lens", &[light]);
        self.give_uniform("look", &[smoke]);
        self.give_buffer("spheres", &spheres);
        self.make_buffer("balls", 32, spheres.len());
        self.make_buffer("light_balls", 32, spheres.len());
        self.make_image("smoke_ids", Format::U32, size);
        self.make_image("smoke_id_depths", Format::Depth, size);
        self.make_layers("smoke_lights", Format::U32, [SHADOW_SIDE; 2], SHADOWS);
        self.make_layers("smoke_shadows", Format::Depth, [SHADOW_SIDE; 2], SHADOWS);
        self.make_buffer("pixels", 16, area(size));
        for name in ["gathered", "blurred", "cells"] {
            self.make_buffer(name, 8, smoke.cell_count());
        }
        self.make_buffer("tones", 4, area(size));
        self.make_image("smoke_colors", Format::Rgba8, size);
        self.make_image("smoke_depths", Format::U32, size);
    }

    fn line_up_smoke(&mut self, look: Look) {
        let id = |name: &str| self.ids[name];
        let from_light = [id("light_lens"), id("spheres"), id("light_balls")];
        let light_bound = [id("shadow_window"), id("light_lens"), id("light_balls")];
        let light_targets = self.light_layers(look, ["smoke_lights", "smoke_shadows"]);
        self.graph.compute(&smoke::PROJECT_SPHERES, &from_light);
        self.graph
            .draw(&smoke::DRAW_SPHERES, &light_bound, &light_targets, true);
        self.compute(&smoke::PROJECT_SPHERES);
        let targets = ["smoke_ids", "smoke_id_depths"];
        self.draw(&smoke::DRAW_SPHERES, "window", targets, true);
        self.compute(&smoke::SHADE_SPHERES);
        self.compute(&smoke::GATHER_TONES);
        self.compute(&smoke::BLUR_ROWS);
        self.compute(&smoke::BLUR_COLUMNS);
        self.compute(&smoke::SMOOTH_TONES);
        let targets = ["smoke_colors", "smoke_depths"];
        self.draw(&smoke::RESOLVE_PICTURE, "window", targets, true);
    }

    /// What is seen of lines, and the ink of it.
    fn see_lines(&mut self) {
        // Hand over the lines.
        let (lines, samples) = sampled_lines();
        self.give_uniform("widths", &[PartWidths::of(&PART_WIDTHS)]);
        self.give_buffer("lines", &lines);
        self.give_buffer("samples", &samples);
        for name in ["gaps", "verdicts", "clear", "visible", "part_starts"] {
            self.make_buffer(name, 4, samples.len());
        }
        self.make_buffer("sampled_points", size_of::<InkPoint>(), samples.len() / 2);

        // Look at them, and list what lists are made of.
        self.compute(&stroke::SEE_SAMPLES);
        self.compute(&stroke::WEIGH_SAMPLES);
        self.list("clear", ["clear_slots", "clear_list"]);
        self.compute(&stroke::FILTER_VISIBILITY);
        self.compute(&stroke::PART_SAMPLES);
        self.list("part_starts", ["part_slots", "part_firsts"]);
        self.compute(&stroke::INK_SAMPLES);
    }

    /// Lists marked elements, by the names of their slots and of the list.
    fn list(&mut self, flags: &'static str, names: [&'static str; 2]) {
        let count = self.graph.element_count(self.ids[flags]);
        let whole = &ListWork::WHOLE;
        let listed = add_compact(&mut self.graph, self.ids[flags], count, whole);
        self.ids.insert(names[0], listed.slots);
        self.ids.insert(names[1], listed.list);
    }

    fn line_up_passes(&mut self, look: Look, size: [u32; 2], mask_size: [u32; 2]) {
        let (pixels, mask_pixels) = (area(size), area(mask_size));
        self.make_image("mask_ids", Format::U32, mask_size);
        self.make_image("mask_depth", Format::Depth, mask_size);
        self.make_buffer("gbuffer", size_of::<GPixel>(), mask_pixels);
        self.make_buffer("mask", 4, mask_pixels);
        self.make_buffer("tints", 12, mask_pixels);
        self.make_image("ribbons", Format::Rgba8, size);
        self.make_image("keys", Format::Depth, size);
        self.make_image("inked", Format::Rgba8, size);
        self.make_image("ink_keys", Format::Depth, size);
        self.give_buffer("points", &strokes());
        self.make_buffer("stamps", 16, mask_pixels);
        self.make_buffer("smoothed", 16, mask_pixels);
        self.give_buffer("no_stamps", &vec![Stamp::default(); mask_pixels]);
        self.make_buffer("owners", 4, mask_pixels + 1);
        self.make_buffer("found", 4, mask_pixels + 1);
        self.make_buffer("claims", 4, pixels);
        self.make_buffer("covered", 4, pixels + 1);
        self.make_buffer("overlay", 4, pixels);
        self.make_buffer("frame", 4, pixels);
        self.make_buffer("picture_depths", 4, pixels);
        let triangles = &self.graph.resource(self.ids["triangles"]).kind;
        let Kind::Buffer { count, .. } = *triangles else {
            panic!("triangles are a buffer");
        };
        self.make_buffer("list", 4, pixels + 1);
        self.make_buffer("known", size_of::<TriangleConstants>(), count);
        self.make_backdrop(look, size);

        self.compute(&mesh::POSE_VERTICES);
        self.compute(&line::LIGHT_WIDTHS);
        self.compute(&mesh::PROJECT_SHADOW);
        let shadow = self.light_layers(look, ["shadows", "surface_depths"]);
        let bound = self.bound(&raster::DRAW_SHADOW, "shadow_window");
        self.graph.draw(&raster::DRAW_SHADOW, &bound, &shadow, true);
        self.line_up_smoke(look);
        self.compute(&mesh::CLASSIFY_EDGES);
        self.compute(&mesh::EXTRUDE_HULL);
        self.draw(&raster::DRAW_IDS, "sample_window", ["ids", "depth"], true);
        let targets = ["beam_ids", "beam_depth"];
        self.draw(&raster::DRAW_BEAMS, "sample_window", targets, true);
        self.draw(
            &raster::DRAW_IDS,
            "sample_window",
            ["bare_ids", "bare_depth"],
            true,
        );
        if look == Look::Ours {
            self.draw(&raster::DRAW_HULL, "sample_window", ["ids", "depth"], false);
        }
        self.draw(
            &raster::DRAW_IDS,
            "mask_window",
            ["mask_ids", "mask_depth"],
            true,
        );
        self.compute(&line::RESOLVE_GBUFFER);
        self.compute(&line::DETECT);
        self.compute(&line::COLOR_MASK);
        self.draw(&line::DRAW_RIBBONS, "window", ["ribbons", "keys"], true);
        let targets = ["inked", "ink_keys"];
        self.draw(&stroke::DRAW_STROKES, "window", targets, true);
        self.see_lines();
        self.compute(&line::FIND_RESIDUAL);
        self.compute(&line::SMOOTH_STAMPS);
        self.compute(&line::CLAIM_PIXELS);
        // The last pass finds in the picture what is kept here for others.
        for into in ["overlay", "frame"] {
            match look {
                Look::Ours => {
                    self.compute_into(&line::CLAIM_PIXELS, "claims", into);
                    self.compute_into(&line::STAMP_RESIDUAL, "stamped", into);
                }
                Look::Published => self.compute_into(&line::DRAW_MASK, "overlay", into),
            }
        }
        self.compute(&shade::KNOW_TRIANGLES);
        self.compute(&shade::FIND_TONES);
        let flag = self.bound(&shade::FLAG_TONES, "window");
        let flags = [self.ids["tone_flags"]];
        self.graph.draw(&shade::FLAG_TONES, &flag, &flags, true);
        let even = self.bound(&shade::EVEN_TONES, "window");
        let evened = [self.ids["evened"]];
        self.graph.draw(&shade::EVEN_TONES, &even, &evened, true);
        self.line_up_backdrop();
        self.compute(&shade::FILL_FRAME);
        self.compute(&shade::COMPOSE_FRAME);
        self.compute(&shade::FIND_DEPTHS);
    }

    fn make_backdrop(&mut self, look: Look, size: [u32; 2]) {
        let samples = size.map(|side| side * rules(look).samples);
        let tiles = size.map(|side| side.div_ceil(TILE));
        let frame_px = FRAME_PX.map(|side| side as f32);
        let extent = tiles.map(|side| (side * TILE) as f32);
        let window = Window::over(frame_px, [0.0; 2], extent, tiles);
        self.give_uniform("tile_window", &[window]);
        self.make_image("bare_ids", Format::U32, samples);
        self.make_image("bare_depth", Format::Depth, samples);
        self.make_image("busy", Format::Rgba8, tiles);
        self.make_image("fronts", Format::Rgba8, size);
        self.make_image("backs", Format::Rgba8, size);
        self.make_buffer("bare", 4, area(size));
        self.make_buffer("rims", 16, area(size));
        self.make_buffer("smoothed_rims", 16, area(size));
        self.make_buffer("columns", 4, area(size));
        self.make_buffer("rim_lines", 4, area(size));
        self.make_buffer("tile_rims", size_of::<TileRims>(), area(tiles));
        for biases in ["bounds", "kept_biases", "biases", "blended_biases"] {
            self.make_buffer(biases, size_of::<ContrastBias>(), area(tiles));
        }
    }

    fn line_up_backdrop(&mut self) {
        let id = |name: &str| self.ids[name];
        let flag = self.bound(&backdrop::FLAG_TILES, "tile_window");
        self.graph
            .draw(&backdrop::FLAG_TILES, &flag, &[id("busy")], true);
        for pass in [&shade::FILL_FRAME, &shade::COMPOSE_FRAME] {
            let bare = pass.slots.iter().map(|slot| {
                id(match resource_of(pass, slot.name) {
                    "compose" => "bare_compose",
                    "ids" => "bare_ids",
                    "fronts" | "backs" => "busy",
                    "frame" => "bare",
                    name => name,
                })
            });
            let bare: Vec<_> = bare.collect();
            self.graph.compute(pass, &bare);
        }
        self.compute(&backdrop::FIND_RIMS);
        self.compute(&backdrop::DRAW_RIMS);
        self.compute(&backdrop::SMOOTH_RIMS);
        self.compute(&backdrop::GATHER_TILES);
        self.compute(&backdrop::BOUND_TILES);
        self.compute(&backdrop::VOTE_BIAS);
        self.compute(&backdrop::BLEND_BIASES);
        self.compute(&backdrop::SPREAD_ROWS);
        let targets = ["fronts", "backs"];
        self.draw(&backdrop::SPREAD_RIMS, "window", targets, true);
    }

    fn give_uniform<T: bytemuck::Pod>(&mut self, name: &'static str, value: &[T; 1]) {
        self.give(
            name,
            Kind::Uniform {
                size: size_of::<T>(),
            },
            bytemuck::cast_slice(value),
        );
    }

    fn give_buffer<T: bytemuck::Pod>(&mut self, name: &'static str, elements: &[T]) {
        let kind = Kind::Buffer {
            stride: size_of::<T>(),
            count: elements.len(),
        };
        self.give(name, kind, bytemuck::cast_slice(elements));
    }

    fn give(&mut self, name: &'static str, kind: Kind, words: &[u32]) {
        let id = self.graph.add(name, kind);
        self.ids.insert(name, id);
        self.given.push((id, words.to_vec()));
    }

    fn make_buffer(&mut self, name: &'static str, stride: usize, count: usize) {
        let id = self.graph.add(name, Kind::Buffer { stride, count });
        self.ids.insert(name, id);
    }

    fn make_image(&mut self, name: &'static str, format: Format, size: [u32; 2]) {
        self.make_layers(name, format, size, 1);
    }

    fn make_layers(&mut self, name: &'static str, format: Format, size: [u32; 2], count: u32) {
        let id = self.graph.layered_image(name, format, size, count);
        self.ids.insert(name, id);
    }

    /// The layers of two images that the light with shadows of a look draws into.
    fn light_layers(&self, look: Look, names: [&str; 2]) -> [ImageLayer; 2] {
        names.map(|name| self.ids[name].layer(shadow_of(look)))
    }

    /// What the slots of a pass bind; its window may be any of the grids.
    fn bound(&self, pass: &Pass, window: &'static str) -> Vec<ResourceId> {
        let name_of = |slot| {
            if slot == "window" {
                window
            } else {
                resource_of(pass, slot)
            }
        };
        pass.slots
            .iter()
            .map(|slot| self.ids[name_of(slot.name)])
            .collect()
    }

    fn compute(&mut self, pass: &'static Pass) {
        let bound = self.bound(pass, resource_of(pass, "window"));
        self.graph.compute(pass, &bound);
    }

    /// Runs a pass, one slot of which binds another resource.
    fn compute_into(&mut self, pass: &'static Pass, slot: &str, into: &'static str) {
        let mut bound = self.bound(pass, resource_of(pass, "window"));
        let at = pass.slots.iter().position(|other| other.name == slot);
        bound[at.unwrap()] = self.ids[into];
        self.graph.compute(pass, &bound);
    }

    fn draw(
        &mut self,
        pass: &'static Pass,
        window: &'static str,
        targets: [&str; 2],
        clears: bool,
    ) {
        let (bound, targets) = (self.bound(pass, window), targets.map(|name| self.ids[name]));
        self.graph.draw(pass, &bound, &targets, clears);
    }

    fn run(self, engine: &dyn Engine) -> Frame {
        let mut session = engine.prepare(self.graph.clone()).unwrap();
        for (id, words) in &self.given {
            session.write(*id, words).unwrap();
        }
        session.run().unwrap();
        let contents = self.ids.into_iter().map(|(name, id)| {
            let words = session.read(id).unwrap();
            let (size, layers) = match self.graph.resource(id).kind {
                Kind::Image { size, layers, .. } => (size, layers),
                _ => ([0; 2], 0),
            };
            let content = Content {
                words,
                size,
                layers,
            };
            (name, content)
        });
        Frame {
            contents: contents.collect(),
        }
    }
}

fn area(size: [u32; 2]) -> usize {
    size[0] as usize * size[1] as usize
}

/// The size of output and mask with which the counted slot of a pass has `count` elements, if they decide it.
pub fn grids_for(pass: &Pass, count: u32) -> [[u32; 2]; 2] {
    let count = count.max(1);
    match pass.slots[pass.counted_slot()].name {
        "tile_rims" | "bounds" | "biases" | "blended" => [[TILE * count, 3], [count, 1]],
        _ => [[count, 1], [count, 1]],
    }
}

/// Whether a pass reads its counted slot, so that the grids do not decide how many elements there are.
pub fn counts_input(pass: &Pass) -> bool {
    let counted = pass.slots[pass.counted_slot()];
    counted.access == Access::Read || ["gathered", "blurred", "cells"].contains(&counted.name)
}
