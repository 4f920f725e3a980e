//! One look of a model, drawn by the passes of an engine: a picture for any camera, tile by tile.

use crate::beam_light::beam_lights;
use crate::bending::Moved;
use crate::error::RenderError;
use crate::features::background_contrast::{BackgroundContrast, ContrastPasses};
use crate::features::beams;
use crate::features::compositing::{self, CompositingPasses, Seen};
use crate::features::hull;
use crate::features::line_features::LineFeatures;
use crate::features::screen_lines::ScreenLines;
use crate::features::shadows::Shadows;
use crate::features::smoke::{Measure, SmokeMoment, SmokePasses, hang_sheet};
use crate::features::strokes::{self, FoundStrokes, StrokePasses};
use crate::frame::Frame;
use crate::frame_graph::{Counts, FrameGraph, Grids, Layers, write};
use crate::light::{self, ChosenLights};
use crate::line_colors::{is_any_painted, is_any_width_lit};
use crate::lines::Expression;
use crate::look::{self, StyledModel};
use crate::model::Model;
use crate::options::RendererOptions;
use crate::placement::{self, Bounds};
use crate::smoke::Smoke;
use crate::tiles::{MASK_TILE_PIXELS, TILE_PIXELS, Tiles};
use glam::Vec3;
use npr_core::budget::Budget;
use npr_core::camera::Camera;
use npr_core::geometry::{NONE, Part, PosedVertex, Vertex};
use npr_core::window::{View, Window};
use npr_gpu::cost::{PassCost, copy_cost, pass_costs};
use npr_gpu::engine::{Engine, EngineError, IN_FLIGHT, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Features;
use npr_style::compose::Compose;
use npr_style::even_tones::far_px;
use npr_style::lighting::LightSource;
use npr_stylesheet::Style;
use npr_vector::screen::residual::LARGEST_PX;

/// Frame pixels around a tile beyond the reach of its lines: detection looks at neighbours.
const TILE_ROOM: u32 = 8;

/// Cosine of the turn, 10 degrees, from which two views are not of one movement but a cut.
const CUT_COS: f32 = 0.985;

/// Distance between two eyes, in radii of the model, from which two views are a cut.
const CUT_RADII: f32 = 0.5;

/// What a look takes of a frame, before its graph is planned.
pub(crate) struct Needs {
    styled: StyledModel,
    contrast: BackgroundContrast,
    pub lights: ChosenLights,
    /// The lights of the smoke, and whether they are those of the scene.
    smoke_lights: (ChosenLights, bool),
    features: LineFeatures,
    measure: Measure,
    tiles: Tiles,
    pub grids: Grids,
    beams: bool,
    /// Number of samples that there is room for where passes find what is seen of strokes; else 0.
    sample_room: usize,
    /// Whether layers for compositing are made.
    layers: bool,
    /// Whether they come with stages.
    stages: bool,
}

/// A frame that is planned: nothing of it has asked an engine for anything.
pub(crate) struct FramePlan {
    pub style: Style,
    pub options: RendererOptions,
    pub needs: Needs,
    pub passes: Passes,
    /// Most bytes that the graph may grow to.
    pub graph_limit: u64,
}

/// The graph of a look: what its features share, and what each takes of it.
pub(crate) struct Passes {
    pub frame: FrameGraph,
    lines: ScreenLines,
    strokes: Option<StrokePasses>,
    shadows: Shadows,
    pub smoke: Option<SmokePasses>,
    contrast: ContrastPasses,
    compositing: Option<CompositingPasses>,
}

/// Depths of beams, where there are any, and of smoke.
pub(crate) type LayerDepths = (Option<ResourceId>, ResourceId);

/// A look and a frame size on an engine: draws tiles of a model with the passes of a frame.
pub(crate) struct FrameRenderer<S = Box<dyn Session>> {
    pub plan: FramePlan,
    pub session: S,
    /// The view of the frame before.
    pub before: Option<View>,
}

/// A frame that the passes are aimed at, and how many of its tiles they have started to draw.
pub(crate) struct Aimed {
    pub view: View,
    submitted: u32,
    /// Vertices in the view, once its first tile was taken, where layers are made of them.
    posed: Vec<PosedVertex>,
}

impl Needs {
    /// The lights of a style and a model as it is posed.
    pub fn relit(model: &Model, style: &Style, options: &RendererOptions) -> ChosenLights {
        let of_beams = beam_lights(style, model);
        ChosenLights::new(style, &model.lights, of_beams, &options.pictures)
    }

    /// Asks every feature what it takes of a frame.
    fn new(
        model: &Model,
        style: &Style,
        options: &RendererOptions,
        mut styled: StyledModel,
    ) -> Self {
        // Choose the lights, and which outlines follow the background.
        let lights = Self::relit(model, style, options);
        styled.inked.notices.extend(lights.notice());
        let contrast = BackgroundContrast::needs(&model.parts, style, styled.parts.len());
        styled.inked.notices.extend(contrast.notice.clone());
        if model.has_lines() && !style.has_curves() {
            let notice =
                "lines of the file are left out: only line.method strokes and potrace draw them";
            styled.inked.notices.push(notice.to_owned());
        }
        let mut features = match (model.triangles.is_empty(), model.has_lines()) {
            (false, _) => LineFeatures::needs(style),
            (true, true) => LineFeatures::needs(style).without_surfaces(),
            (true, false) => LineFeatures::NONE,
        };
        features.contrast = contrast.is_on;
        if options.layers {
            let told = compositing::notices(style, features, !model.triangles.is_empty());
            styled.inked.notices.extend(told);
        }

        // Cut the frame into tiles, with as much room around each as lines and smoke reach.
        let height_px = options.size[1] as f32;
        let world_px = height_px / model.radius();
        let mut measure = Measure {
            height_px,
            dpi: options.dpi,
            size: options.size,
            samples: if style.antialias.samples > 1 { 2 } else { 1 },
        };
        let base_px = look::base_px(style, options.size[1], options.dpi, world_px);
        let mut reach = look::largest_half_width(style, &styled.parts, base_px);
        if features.rim || features.contrast {
            let px = [height_px, options.dpi, world_px];
            let rules = contrast.rules(style, features, reach, px, measure.samples);
            reach = reach.max(rules.room_px() as f32);
        }
        let tones = styled
            .parts
            .iter()
            .map(|part| far_px(part.tone_reach_px) as f32);
        reach = tones.fold(reach, f32::max);
        if options.smoke.is_some() {
            reach = reach.max(measure.reach_px(&style.smoke));
        }
        let margin = reach.min(1e4) as u32 + TILE_ROOM;
        let most = if features.mask {
            MASK_TILE_PIXELS
        } else {
            TILE_PIXELS
        };
        let tiles = Tiles::new(options.size, margin, options.tile_pixels.min(most));
        let coarse = |side: u32| ((side as f32 / style.detect.scale).round() as u32).max(1);
        let grids = Grids {
            output: tiles.size(),
            mask: tiles.size().map(coarse),
            samples: measure.samples,
        };
        measure.size = grids.output;

        // Settle how it is found what is seen of strokes.
        let is_tiled = tiles.kept != tiles.frame;
        let mut notices = Vec::new();
        let drawn = (style, &styled.brushes, &styled.manners);
        let sample_room = strokes::sample_room(drawn, options, is_tiled, &mut notices);
        styled.inked.notices.extend(notices);

        // Decide which layers the last pass lays over surfaces.
        let beams = beams::needs(&styled.parts);
        features.paints = is_any_painted(&styled.parts);
        features.light_widths = is_any_width_lit(&styled.parts);
        let layer = |bit: u32, when: bool| if when { bit } else { 0 };
        features.layers |= layer(Compose::BACKDROP, features.contrast)
            | layer(Compose::BEAMS, beams)
            | layer(Compose::SMOKE, options.smoke.is_some())
            | layer(Compose::SMOKE_PEN, styled.smoke_part.is_some());
        Self {
            smoke_lights: lights.of_smoke(style),
            styled,
            contrast,
            lights,
            features,
            measure,
            tiles,
            grids,
            beams,
            sample_room,
            layers: options.layers,
            stages: options.stages,
        }
    }
}

impl Needs {
    /// What the passes of the frame must be able to do: what any of its parts, lights and layers asks for.
    fn pass_features(&self) -> Features {
        // Look what the parts ask for.
        let (parts, styled) = (&self.styled.parts, &self.styled);
        let any = |bits: u32| parts.iter().any(|part| part.flags & bits != 0);
        let has_picture = |part: &Part| {
            let of_lines = part.line_flags & Part::LINE_TEXTURE != 0;
            part.texture != NONE || of_lines && part.line_texture != NONE
        };
        let shows_pictures = styled.background_texture != NONE || parts.iter().any(has_picture);

        let has_toons = any(Part::TOON | Part::TOON_LINE);
        let is_textured = parts.iter().any(|part| part.texture != NONE);
        let is_colored = is_textured || !styled.vertices.iter().all(Vertex::is_white);
        let is_shaped = |part: &Part| {
            let [_, _, split_u, split_v] = part.highlight_turn;
            part.highlight_shape != [0.0; 4] || split_u != 0.0 || split_v != 0.0
        };

        // Look what the lights and the smoke ask for.
        let layers = |bit: u32| self.features.layers & bit != 0;
        let has_smoke = layers(Compose::SMOKE);
        let casts = self.lights.shadow_count() > 0;
        let (smoke_lights, are_same) = &self.smoke_lights;
        let is_one_sun = self.lights.is_one_sun() && (!has_smoke || smoke_lights.is_one_sun());

        // Put them together.
        let all = [
            Features::CUTOUTS.when(any(Part::CUTOUT)),
            Features::TEXTURES.when(shows_pictures || has_toons),
            Features::COLORS.when(is_colored),
            Features::TONE_ROWS.when(any(Part::TONE_ROW)),
            Features::EVEN_TONES.when(parts.iter().any(|part| part.tone_reach_px > 0.0)),
            Features::TOON.when(has_toons),
            Features::LIGHTS.when(!is_one_sun),
            Features::SHADOWS.when(casts),
            Features::SKY.when(styled.sky.is_some()),
            Features::INK.when(any(Part::INK | Part::HATCH)),
            Features::PAINT.when(any(Part::PAINTED)),
            Features::GLOSS.when(any(Part::HIGHLIGHTS)),
            Features::SHAPED_GLOSS.when(parts.iter().any(is_shaped)),
            Features::BACK_LIGHT.when(any(Part::BACK_LIGHT)),
            Features::STREAKS.when(any(Part::STREAK)),
            Features::SECOND_LAYER.when(any(Part::TWO_LAYERS)),
            Features::HULLS.when(self.features.hull),
            Features::ANGLES.when(any(Part::ANGLE)),
            Features::RIBBONS.when(layers(Compose::RIBBONS)),
            Features::OVERLAY.when(layers(Compose::OVERLAY)),
            Features::BEAMS.when(layers(Compose::BEAMS)),
            Features::BACKDROP.when(self.features.rim || self.features.contrast),
            Features::TINTS.when(self.features.paints),
            Features::SMOKE.when(has_smoke),
            Features::SMOKE_PEN.when(layers(Compose::SMOKE_PEN)),
            Features::GRAIN.when(parts.iter().any(|part| part.hatch_grain > 0.0)),
            Features::BRUSHES.when(!styled.brushes.all.is_empty()),
            Features::SMOKE_SHADOWS.when(has_smoke && casts && *are_same),
        ];
        all.into_iter().fold(Features::NONE, Features::or)
    }
}

impl Passes {
    /// Adds the passes of every feature that a look needs, in the order in which they build on each other.
    fn new(
        model: &Model,
        style: &Style,
        smoke: Option<&Smoke>,
        needs: &Needs,
    ) -> (Self, LayerDepths) {
        let (styled, grids, features) = (&needs.styled, &needs.grids, needs.features);
        let counts = Counts {
            vertices: styled.vertices.len(),
            joints: model.palette.len(),
            triangles: model.triangles.len(),
            edges: model.edge_count(),
            charts: styled.inked.charts.len(),
            parts: styled.parts.len(),
            texel_words: styled.textures.words().len(),
        };
        let mut frame = FrameGraph::new(&counts, grids, needs.pass_features());
        if features.light_widths {
            frame.light_widths(counts.vertices);
        }

        // Draw surfaces as the lights and the eye see them, then lines and beams.
        let (chosen, are_same) = &needs.smoke_lights;
        let shadow_count = needs.lights.shadow_count();
        let fall_on_smoke = smoke.is_some() && *are_same;
        let shadows = Shadows::plan(&mut frame, shadow_count, counts.vertices, fall_on_smoke);
        frame.draw_ids(frame.color_window, frame.ids, frame.depths);
        let lines = ScreenLines::plan(&mut frame, grids, counts.edges, features);
        let targets = [lines.ribbons, lines.keys];
        let strokes = features.strokes.then(|| {
            StrokePasses::plan(
                &mut frame,
                targets,
                (styled.brushes.all.len(), needs.sample_room),
                !features.ribbons,
            )
        });
        if features.hull {
            hull::plan(&mut frame, counts.vertices);
        }
        let (beam_ids, beam_depths) = beams::plan(&mut frame, grids, needs.beams);

        // Draw the smoke.
        let smoke = smoke.map(|smoke| {
            let lit = (needs.measure, chosen.clone());
            let sized = (&style.smoke, smoke.spheres.len());
            let surface_maps = if *are_same { shadow_count as u32 } else { 0 };
            let surfaces = (shadows.depths, surface_maps);
            let window = frame.output_window;
            SmokePasses::plan(&mut frame.graph, lit, sized, window, surfaces)
        });

        // Find what lies on both sides of outlines, and compose the picture.
        frame.know_triangles();
        let contrast = ContrastPasses::inputs(&mut frame, grids, counts.parts, features);
        let layers = Layers {
            beam_ids,
            ribbons: lines.ribbons,
            shadows: shadows.pictures,
            smoke: SmokePasses::composed(smoke.as_ref(), &mut frame.graph),
            rules: contrast.rules,
        };
        let sides = contrast.plan(&mut frame, grids, features, &layers);
        frame.compose_frame(frame.compose, frame.ids, &layers, sides, frame.frame);
        let mask = (needs.stages && features.mask).then_some(lines.mask);
        let compositing = needs
            .layers
            .then(|| CompositingPasses::plan(&mut frame, grids, features, (&layers, mask), sides));
        let passes = Self {
            frame,
            lines,
            strokes,
            shadows,
            smoke,
            contrast,
            compositing,
        };
        (passes, (beam_depths, layers.smoke[1]))
    }
}

impl FramePlan {
    /// Plans a frame of a model in a style that was resolved for it.
    pub fn new(
        model: &Model,
        style: &Style,
        options: &RendererOptions,
        styled: StyledModel,
    ) -> Self {
        Self::with_layers(model, style, options, styled).0
    }

    /// The same with the depths of what lies over surfaces.
    pub fn with_layers(
        model: &Model,
        style: &Style,
        options: &RendererOptions,
        styled: StyledModel,
    ) -> (Self, LayerDepths) {
        let needs = Needs::new(model, style, options, styled);
        let (passes, depths) = Passes::new(model, style, options.smoke.as_ref(), &needs);
        let plan = Self {
            style: style.clone(),
            options: options.clone(),
            needs,
            passes,
            graph_limit: options.memory_limit,
        };
        (plan, depths)
    }

    /// How the frame is cut into tiles.
    pub fn tiles(&self) -> &Tiles {
        &self.needs.tiles
    }

    /// The style, resolved for the model.
    pub fn styled(&self) -> &StyledModel {
        &self.needs.styled
    }

    /// Tells of these things instead of what was found for the plan.
    pub fn set_notices(&mut self, notices: Vec<String>) {
        self.needs.styled.inked.notices = notices;
    }

    /// Takes its memory from `budget`: that of the graph, and of as many rows of the picture as are held at once.
    pub fn take_memory(&self, budget: &mut Budget, rows: u32) -> Result<(), RenderError> {
        let width = self.options.size[0] as usize;
        budget.take("the picture", width * rows as usize, 4)?;
        let planned = self.passes.frame.graph.planned_bytes() as usize;
        budget.take("the plan of the frame", planned, 1)?;
        match &self.passes.compositing {
            Some(passes) => {
                let sized = (self.options.size, self.options.stages);
                passes.take_memory((budget, self.graph()), sized)
            }
            None => Ok(()),
        }
    }

    /// Prepares the passes on an engine, and uploads what does not change with the camera.
    pub fn prepare(self, model: &Model, engine: &dyn Engine) -> Result<FrameRenderer, RenderError> {
        let mut session = engine.prepare(self.graph().clone())?;
        session.heed(&self.options.interrupt);
        FrameRenderer::new(self, model, session)
    }

    /// Whether passes find what is seen of strokes.
    pub fn leaves_strokes_open(&self) -> bool {
        self.needs.sample_room > 0
    }

    /// The graph of the frame.
    pub fn graph(&self) -> &Graph {
        &self.passes.frame.graph
    }
}

impl<S: Session> FrameRenderer<S> {
    /// Draws by a plan with a session of its graph, to which it hands over what does not change with the camera.
    pub fn new(plan: FramePlan, model: &Model, session: S) -> Result<Self, RenderError> {
        let mut renderer = Self {
            plan,
            session,
            before: None,
        };
        renderer.upload(model)?;
        Ok(renderer)
    }

    /// Hands over what does not change with the camera.
    pub fn upload(&mut self, model: &Model) -> Result<(), EngineError> {
        let FramePlan {
            style,
            needs,
            passes,
            ..
        } = &self.plan;
        let (frame, styled) = (&passes.frame, &needs.styled);
        let session = &mut self.session;
        write(session, frame.vertices, &styled.vertices)?;
        write(session, frame.influences, &model.influences)?;
        write(session, frame.palette, &model.palette)?;
        write(session, frame.triangles, &model.triangles)?;
        write(session, frame.charts, &styled.inked.charts)?;
        write(session, frame.parts, &styled.parts)?;
        session.write_shared(frame.texels, styled.textures.shared_words())?;
        let edges = model.edges_by(look::creases(style).from);
        passes.lines.upload(session, &edges)?;
        if let Some(passes) = &passes.strokes {
            passes.upload(session, &styled.brushes)?;
        }
        passes.shadows.upload(session)?;
        passes.contrast.upload(session, &needs.contrast)?;
        self.upload_smoke()
    }

    /// Takes over the pose of the model, of which `moved` says what changed; false where other lights need another
    /// plan.
    ///
    /// Matrices are handed over, and vertices and edges where they changed.
    pub fn pose(&mut self, model: &Model, moved: Moved) -> Result<bool, EngineError> {
        // Relight the scene.
        let FramePlan {
            style,
            options,
            needs,
            passes,
            ..
        } = &mut self.plan;
        let lights = Needs::relit(model, style, options);
        let of_smoke = lights.of_smoke(style);
        let are_alike = lights.is_one_sun() == needs.lights.is_one_sun()
            && lights.shadow_count() == needs.lights.shadow_count()
            && of_smoke.1 == needs.smoke_lights.1
            && of_smoke.0.is_one_sun() == needs.smoke_lights.0.is_one_sun()
            && of_smoke.0.smoke_shadow_count() == needs.smoke_lights.0.smoke_shadow_count();
        if !are_alike {
            return Ok(false);
        }
        if let Some(passes) = &mut passes.smoke {
            passes.relight(of_smoke.0.clone());
        }
        needs.lights = lights;
        needs.smoke_lights = of_smoke;

        // Hand over what moved.
        let session = &mut self.session;
        write(session, passes.frame.palette, &model.palette)?;
        if moved.vertices {
            let changes = needs.styled.follow(model);
            changes.write(session, passes.frame.vertices, &needs.styled.vertices)?;
        }
        if moved.edges {
            let edges = model.edges_by(look::creases(style).from);
            passes.lines.upload(session, &edges)?;
        }
        Ok(true)
    }

    fn upload_smoke(&mut self) -> Result<(), EngineError> {
        let FramePlan { style, options, .. } = &self.plan;
        match (&self.plan.passes.smoke, &options.smoke) {
            (Some(passes), Some(smoke)) => passes.upload(&mut self.session, smoke, &style.smoke),
            _ => Ok(()),
        }
    }

    /// Draws other smoke from now on.
    ///
    /// # Errors
    ///
    /// [`RenderError::TooMany`] for more spheres than at first; or a failing engine.
    pub fn set_smoke(&mut self, smoke: &Smoke) -> Result<(), RenderError> {
        SmokePasses::check(self.plan.passes.smoke.as_ref(), smoke)?;
        self.plan.options.smoke = Some(smoke.clone());
        Ok(self.upload_smoke()?)
    }

    /// The box of all that is drawn.
    fn bounds(&self, model: &Model) -> Bounds {
        let Some(smoke) = self.plan.options.smoke.as_ref().map(Smoke::extent) else {
            return model.bounds();
        };
        if model.is_empty() {
            return smoke;
        }
        placement::around(model.bounds(), smoke)
    }

    /// Whether a frame goes on from the one before: not the first, nor after a cut, nor where each stands alone. Tiles
    /// of a frame share their buffers, so they never do.
    fn follows(&self, view: &View, model: &Model) -> bool {
        let Some(before) = self.before.as_ref().filter(|_| !self.plan.options.alone) else {
            return false;
        };
        let turned = Vec3::from(view.forward_world).dot(Vec3::from(before.forward_world));
        let moved = Vec3::from(view.eye_world).distance(Vec3::from(before.eye_world));
        let tiles = self.plan.tiles();
        tiles.kept == tiles.frame && turned > CUT_COS && moved < CUT_RADII * model.radius()
    }

    /// Base width of strokes in a view, in pixels, which images of brushes are as wide as.
    pub fn stroke_base_px(&self, view: &View, camera: &Camera, model: &Model) -> f32 {
        let FramePlan { style, options, .. } = &self.plan;
        let enlarged = options.stroke_scale() as f32;
        let world_px = look::nearest_world_px(view, camera, model) / enlarged;
        let (size, dpi) = (options.stroke_size(), options.stroke_dpi());
        look::base_px(style, size[1], dpi, world_px) * enlarged
    }

    /// Hands over how a camera sees the scene, and the strokes that were found in this view.
    pub fn aim(
        &mut self,
        model: &Model,
        camera: &Camera,
        strokes: &FoundStrokes,
    ) -> Result<View, RenderError> {
        let bounds = self.bounds(model);
        let FramePlan {
            style,
            options,
            needs,
            passes,
            ..
        } = &self.plan;
        let (size, dpi) = (options.size, options.dpi);
        let view = camera.view(size, bounds);

        // Settle the widths of lines and the rules of their colours in this view.
        let world_px = look::nearest_world_px(&view, camera, model);
        let base_px = look::base_px(style, size[1], dpi, world_px);
        let stroke_base_px = self.stroke_base_px(&view, camera, model);
        let (stroke_size, stroke_dpi) = (options.stroke_size(), options.stroke_dpi());
        let enlarged = options.stroke_scale() as f32;
        let half = look::largest_half_width(style, &needs.styled.parts, base_px);
        let reach_px = half.ceil().min(LARGEST_PX) as u32 + 1;
        let outline = look::outline(style, model.radius(), size[1], dpi, reach_px);
        let px = [size[1] as f32, dpi, world_px];
        let samples = needs.grids.samples;
        let rules = needs
            .contrast
            .rules(style, needs.features, half, px, samples);
        let rules = match self.follows(&view, model) {
            true => rules,
            false => rules.of_first_frame(),
        };

        // Settle how the last pass composes the picture.
        let background = needs.styled.background_texture;
        let mut compose = look::compose(style, camera, model, background);
        compose.flags = needs.features.layers;
        if let (Some(part), Some(smoke)) = (needs.styled.smoke_part, &options.smoke) {
            hang_sheet(&mut compose, part, smoke, &style.smoke, &view);
        }
        let smoke_passes = passes.smoke.as_ref();
        if smoke_passes.is_some_and(|passes| passes.shades_surfaces(&style.smoke)) {
            compose.smoke_shadow_side = style.smoke.shadow_px;
        }

        // Settle the lights.
        let mut lights = needs.lights.of_frame(style, bounds, None, camera, &view);
        if let Some(sky) = &needs.styled.sky {
            sky.apply_to(&mut lights);
        }

        // Hand all of it over.
        let (session, frame) = (&mut self.session, &passes.frame);
        write(session, frame.view, &[view])?;
        write(session, frame.outline, &[outline])?;
        write(session, frame.compose, &[compose])?;
        write(session, frame.lights, &[lights])?;
        passes.contrast.upload_view(session, rules, &compose)?;
        if let Some(compositing) = &passes.compositing {
            compositing.upload_view(session, &compose)?;
        }
        passes.shadows.upload_view(session, &lights)?;
        if let (Some(passes), Some(smoke)) = (smoke_passes, &options.smoke) {
            let moment = SmokeMoment {
                smoke,
                style,
                camera,
                view: &view,
                bounds,
            };
            passes.upload_view(session, &moment)?;
        }
        self.turn_strokes(model, &light::strongest(&lights), camera)?;
        let FramePlan {
            style,
            passes,
            needs,
            graph_limit,
            ..
        } = &mut self.plan;
        if let Some(inked) = &passes.strokes {
            let manners = &needs.styled.manners;
            let height = stroke_size[1] as f32;
            let px = [height, stroke_dpi, height / model.radius()];
            let widths = Expression::part_widths(style, manners, (px, enlarged));
            let (graph, seen) = (&mut passes.frame.graph, (&view, strokes, &widths[..]));
            let brushes = (&needs.styled.brushes, manners, stroke_base_px);
            inked.upload_view(&mut self.session, graph, seen, brushes, *graph_limit)?;
        }
        self.before = Some(view);
        Ok(view)
    }

    /// Turns the strokes that follow the light to the strongest one.
    fn turn_strokes(
        &mut self,
        model: &Model,
        light: &LightSource,
        camera: &Camera,
    ) -> Result<(), EngineError> {
        let FramePlan {
            style,
            needs,
            passes,
            ..
        } = &mut self.plan;
        let StyledModel { inked, parts, .. } = &mut needs.styled;
        let [parts_turned, charts_turned] = inked.follow_light(model, style, light, camera, parts);
        let (session, frame) = (&mut self.session, &passes.frame);
        if parts_turned {
            write(session, frame.parts, parts)?;
        }
        if charts_turned {
            write(session, frame.charts, &inked.charts)?;
        }
        Ok(())
    }

    /// Hands over the grids over the tile whose kept part starts at `origin`.
    pub fn aim_tile(&mut self, view: &View, origin: [u32; 2]) -> Result<(), EngineError> {
        let FramePlan { needs, passes, .. } = &self.plan;
        let size = needs.tiles.size();
        let corner = needs.tiles.corner_px(origin);
        let extent = size.map(|side| side as f32);
        let over = |grid: [u32; 2]| Window::over(view.frame_px, corner, extent, grid);
        let (session, frame) = (&mut self.session, &passes.frame);
        write(session, frame.output_window, &[over(size)])?;
        write(session, frame.color_window, &[over(needs.grids.color())])?;
        passes.lines.upload_tile(session, over(needs.grids.mask))?;
        passes.contrast.upload_tile(session, view, corner, size)
    }

    /// Hands over how a camera sees the scene, and the strokes found in this view, and starts to draw as many tiles as
    /// the engine takes at once.
    ///
    /// A frame of several tiles is taken, all of it, before another is begun.
    pub fn begin(
        &mut self,
        model: &Model,
        camera: &Camera,
        strokes: &FoundStrokes,
    ) -> Result<Aimed, RenderError> {
        let view = self.aim(model, camera, strokes)?;
        let mut aimed = Aimed {
            view,
            submitted: 0,
            posed: Vec::new(),
        };
        self.submit_tiles(&mut aimed)?;
        Ok(aimed)
    }

    /// Starts to draw tiles of a frame, as many as the engine takes at once.
    fn submit_tiles(&mut self, aimed: &mut Aimed) -> Result<(), EngineError> {
        while self.session.in_flight() < IN_FLIGHT && aimed.submitted < self.plan.tiles().count() {
            let origin = self.plan.tiles().origin(aimed.submitted);
            self.aim_tile(&aimed.view, origin)?;
            let passes = &self.plan.passes;
            let mut read = vec![passes.frame.frame];
            if let Some(compositing) = &passes.compositing {
                read.extend(compositing.reads(aimed.submitted == 0));
            }
            self.plan.options.interrupt.check()?;
            self.session.submit(&read)?;
            aimed.submitted += 1;
        }
        Ok(())
    }

    /// Takes the next tile of a frame of the model that was begun, whose kept part starts at `origin`, into a frame
    /// that begins `top` rows below the whole one. The tiles after it are being drawn meanwhile.
    pub fn take_tile(
        &mut self,
        (model, aimed): (&Model, &mut Aimed),
        (origin, top): ([u32; 2], u32),
        frame: &mut Frame,
    ) -> Result<(), EngineError> {
        // Wait for the tile, and start another: the device draws while the caller works.
        let (times, mut read) = self.session.collect()?;
        self.submit_tiles(aimed)?;
        frame.add_times(&times);

        // Take the part of the picture that is kept.
        let (passes, tiles) = (&self.plan.passes, self.plan.tiles());
        let (size, margin, kept) = (tiles.size(), [tiles.margin; 2], tiles.kept);
        let at = [origin[0], origin[1] - top];
        let shown = read.take(passes.frame.frame);
        frame.paste(&shown, size[0], margin, at, kept);

        // Make layers of the rest.
        if let Some(compositing) = &passes.compositing {
            if origin == [0, 0] {
                aimed.posed = compositing.take_posed(model, &mut read);
            }
            let seen = Seen {
                model,
                view: &aimed.view,
                posed: &aimed.posed,
            };
            compositing.paste(seen, (&shown, &mut read), (tiles, origin), frame);
        }
        Ok(())
    }

    /// Takes nothing of frames that were begun.
    pub fn forget_begun(&mut self) {
        while self.session.in_flight() > 0 {
            // Failed or not, a run is collected.
            let _ = self.session.collect();
        }
    }

    /// What the passes of the tile drawn last asked of a device, and the copy of its picture.
    pub fn pass_costs(&mut self) -> Result<Vec<PassCost>, EngineError> {
        let frame = &self.plan.passes.frame;
        let mut costs = pass_costs(&frame.graph, &mut self.session)?;
        costs.push(copy_cost(&frame.graph, frame.frame));
        Ok(costs)
    }
}
