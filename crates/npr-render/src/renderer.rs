//! A model, a style and a frame size on an engine, ready to draw.

use crate::backdrop::{Backdrop, Sides};
use crate::blending::Blending;
use crate::blueprint::{Blueprint, Counts, Grids, Method};
use crate::error::RenderError;
use crate::frame::Frame;
use crate::lettering::Lettering;
use crate::light::{self, ChosenLights};
use crate::line_colors::{is_any_painted, is_any_width_lit};
use crate::lines::{LineMethod, LineOptions, LineRenderer};
use crate::look::{self, StyledModel};
use crate::model::Model;
use crate::placement::Bounds;
use crate::smoke::{self, Measure, Needs, Smoke};
use crate::speed_lines::SpeedLines;
use crate::surfaces::surface_depths;
use crate::tiles::{TILE_PIXELS, Tiles};
use bytemuck::{NoUninit, cast_slice};
use glam::Vec3;
use npr_core::budget::Budget;
use npr_core::camera::Camera;
use npr_core::smoke::{Sphere, SphereView};
use npr_core::window::{View, Window};
use npr_drawing::artwork::ArtworkOptions;
use npr_drawing::drawing::paint_drawing_over;
use npr_drawing::lettering::Font;
use npr_gpu::engine::{Engine, EngineError, Session};
use npr_gpu::graph::ResourceId;
use npr_scene::Image;
use npr_style::backdrop::{Rules, TILE};
use npr_style::compose::Compose;
use npr_style::lighting::LightSource;
use npr_style::shadow::SHADOW_SIDE;
use npr_stylesheet::Style;
use std::collections::BTreeMap;

/// Most pixels of a frame along a side.
const FRAME_SIDE: u32 = 32_768;

/// Frame pixels around a tile beyond the reach of its lines: detection looks at neighbours.
const TILE_ROOM: u32 = 8;

/// A picture that a style names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// sRGB bytes with straight alpha, row by row from the top.
    pub rgba: Vec<u8>,
}

impl From<Image> for Picture {
    fn from(image: Image) -> Self {
        Self {
            size: [image.width, image.height],
            rgba: image.rgba,
        }
    }
}

/// What a stage needs beside model and style.
#[derive(Debug, Clone, PartialEq)]
pub struct RendererOptions {
    /// Width and height of the frame in pixels.
    pub size: [u32; 2],
    /// Pixels per inch, for lengths in millimetres.
    pub dpi: f32,
    /// The picture behind the scene, where the style names one.
    pub background_image: Option<Picture>,
    /// The picture that line widths are read from, where the style names one.
    pub width_image: Option<Picture>,
    /// The pictures that [`Style::named_pictures`] lists, by the names that the style gives them.
    pub pictures: BTreeMap<String, Picture>,
    /// Fonts of the style's words, by the names that the style gives them.
    pub fonts: BTreeMap<String, Font>,
    /// Smoke beside the model; [`Renderer::set_smoke`] changes it from frame to frame.
    pub smoke: Option<Smoke>,
    /// Most bytes that may be planned.
    pub memory_limit: u64,
    /// Most pixels drawn at once, 4 million by default and at most; a larger frame is drawn in tiles. Fewer need less
    /// memory and more time. Tiles keep at least 64 pixels a side.
    pub tile_pixels: u32,
    /// Whether the frame is taken by [`Renderer::draw_bands`] where that can be: only a band of it is planned then.
    pub in_bands: bool,
}

impl RendererOptions {
    /// Options for a frame of `size` pixels: 96 pixels per inch, no pictures, fonts or smoke, 4 GiB.
    pub fn new(size: [u32; 2]) -> Self {
        Self {
            size,
            dpi: 96.0,
            background_image: None,
            width_image: None,
            pictures: BTreeMap::new(),
            fonts: BTreeMap::new(),
            smoke: None,
            memory_limit: 4 << 30,
            tile_pixels: TILE_PIXELS,
            in_bands: false,
        }
    }
}

/// Cosine of the turn, 10 degrees, from which two views are not of one movement but a cut.
const CUT_COS: f32 = 0.985;

/// The same for the eye's way, as a multiple of the model's radius.
const CUT_RADII: f32 = 0.5;

/// A model, a style and a frame size on an engine: draws a picture for any camera.
pub struct Renderer<'a> {
    model: &'a Model,
    style: Style,
    options: RendererOptions,
    tiles: Tiles,
    grids: Grids,
    method: Method,
    styled: StyledModel,
    backdrop: Backdrop,
    lights: ChosenLights,
    /// The lights of the smoke, and whether they are those of the scene.
    smoke_lights: (ChosenLights, bool),
    lettering: Lettering,
    /// Gives the lines of parts whose method is `curves` or `potrace`.
    lines: Option<LineRenderer<'a>>,
    speed_lines: Option<SpeedLines<'a>>,
    blending: Option<Blending<'a>>,
    /// Memory of all that it is made of.
    planned_bytes: u64,
    plan: Blueprint,
    session: Box<dyn Session>,
    /// How the frame before was seen.
    before: Option<View>,
    /// Hears how many tiles of a frame are done, of how many.
    tell: Option<&'a dyn Fn(usize, usize)>,
}

impl<'a> Renderer<'a> {
    /// Plans the frame, checks that it fits, and uploads what does not change with the camera.
    ///
    /// # Errors
    ///
    /// [`RenderError`] for a frame without pixels or beyond 32768 a side, a plan beyond the memory limit, words that
    /// cannot be set, pictures that are missing or unfit, or a failing engine.
    pub fn new(
        engine: &dyn Engine,
        model: &'a Model,
        style: &Style,
        options: &RendererOptions,
    ) -> Result<Self, RenderError> {
        check_size(options.size)?;
        let mut styled = StyledModel::new(model, style, options)?;
        let lettering = Lettering::new(style, &options.fonts)?;
        styled.inked.notices.extend_from_slice(lettering.notices());
        let lights = ChosenLights::new(style, model, &options.pictures);
        styled.inked.notices.extend(lights.notice());
        let base_px = look::base_px(
            style,
            options.size[1],
            options.dpi,
            options.size[1] as f32 / model.radius(),
        );
        let mut reach = look::largest_half_width(style, &styled.parts, base_px);
        let mut measure = Measure {
            height_px: options.size[1] as f32,
            dpi: options.dpi,
            size: options.size,
            samples: if style.antialias.samples > 1 { 2 } else { 1 },
        };
        let backdrop = Backdrop::new(&model.parts, style, styled.parts.len());
        styled.inked.notices.extend(backdrop.notice.clone());
        if model.has_lines() && !style.has_curves() {
            let notice =
                "lines of the file are left out: only line.method curves and potrace draw them";
            styled.inked.notices.push(notice.to_owned());
        }
        let mut method = match model.triangles.is_empty() {
            true => Method::NONE,
            false => Method::of(style),
        };
        method.contrast = backdrop.is_on;
        if method.rim || method.contrast {
            let px = [
                measure.height_px,
                options.dpi,
                options.size[1] as f32 / model.radius(),
            ];
            let rules = backdrop.rules(style, method, reach, px, measure.samples);
            reach = reach.max(rules.room_px() as f32);
        }
        if options.smoke.is_some() {
            reach = reach.max(measure.reach_px(&style.smoke));
        }
        let margin = reach.min(1e4) as u32 + TILE_ROOM;
        let tiles = Tiles::new(options.size, margin, options.tile_pixels);
        let scale = style.detect.scale;
        let grids = Grids {
            output: tiles.size(),
            mask: tiles
                .size()
                .map(|side| ((side as f32 / scale).round() as u32).max(1)),
            samples: measure.samples,
        };
        measure.size = grids.output;
        let smoke_lights = lights.of_smoke(style, model);
        let counts = Counts {
            vertices: styled.vertices.len(),
            joints: model.palette.len(),
            triangles: model.triangles.len(),
            edges: model.edge_count(),
            charts: styled.inked.charts.len(),
            parts: styled.parts.len(),
            texel_words: styled.textures.words().len(),
            beams: styled.beam_count(),
            shadows: lights.shadow_count(),
            smoke: options.smoke.as_ref().map(|smoke| Needs {
                spheres: smoke.spheres.len(),
                cells: measure.cell_count(&style.smoke),
                lights: smoke_lights.0.smoke_shadow_count(),
                side: style.smoke.shadow_px,
                takes_shadows: smoke_lights.1,
                size: grids.output,
            }),
        };
        method.paints = is_any_painted(&styled.parts);
        method.light_widths = is_any_width_lit(&styled.parts);
        if method.contrast {
            method.layers |= Compose::BACKDROP;
        }
        if counts.beams > 0 {
            method.layers |= Compose::BEAMS;
        }
        if counts.smoke.is_some() {
            method.layers |= Compose::SMOKE;
        }
        if styled.smoke_part.is_some() {
            method.layers |= Compose::SMOKE_PEN;
        }
        let plan = Blueprint::new(&counts, &grids, method);
        let mut budget = Budget::new(options.memory_limit);
        let rows = match options.in_bands && draws_bands(style, &tiles) {
            true => tiles.kept[1].min(options.size[1]),
            false => options.size[1],
        };
        budget.take("the picture", options.size[0] as usize * rows as usize, 4)?;
        budget.take(
            "the plan of the frame",
            plan.graph.planned_bytes() as usize,
            1,
        )?;
        if !lettering.is_empty() {
            let pixels = options.size[0] as usize * options.size[1] as usize;
            budget.take("the words over the picture", pixels, 4)?;
            if lettering.may_be_hidden() {
                // A sheet of its own, and four samples of numbers and depths.
                budget.take("what hides words", pixels, 4 + 4 * 12)?;
            }
        }
        let mut planned_bytes = budget.used_bytes();
        let speed_lines = SpeedLines::new(engine, model, style, options, planned_bytes)?;
        planned_bytes += speed_lines.as_ref().map_or(0, SpeedLines::planned_bytes);
        let blending = Blending::new(engine, model, style, options, planned_bytes)?;
        planned_bytes += blending.as_ref().map_or(0, Blending::planned_bytes);
        let session = engine.prepare(plan.graph.clone())?;
        let (style, options) = (style.clone(), options.clone());
        let mut renderer = Self {
            model,
            style,
            options,
            tiles,
            grids,
            method,
            styled,
            backdrop,
            lights,
            smoke_lights,
            lettering,
            lines: None,
            speed_lines,
            blending,
            planned_bytes,
            plan,
            session,
            before: None,
            tell: None,
        };
        renderer.upload()?;
        Ok(renderer)
    }

    /// The same, with the lines of parts whose `line.method` is `curves` or `potrace` from a line model of the scene,
    /// on an engine that may be another one.
    ///
    /// Without one they have no lines, and [`Frame::notices`] tells.
    pub fn with_lines(mut self, lines: LineRenderer<'a>) -> Self {
        self.lines = Some(lines);
        self
    }

    /// The same, with somebody told after each tile how many are done, of how many; not of a frame in one piece.
    pub fn with_progress(mut self, tell: &'a dyn Fn(usize, usize)) -> Self {
        self.tell = Some(tell);
        self
    }

    /// Draws the lines of parts whose method is `curves` or `potrace` over a frame.
    fn draw_curves(
        &mut self,
        camera: &Camera,
        contrasted: Option<&(Sides, Rules)>,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        if !self.style.has_curves() {
            return Ok(());
        }
        let Some(lines) = &mut self.lines else {
            let notice = "lines as curves are left out: no line model was given";
            frame.notices.push(notice.to_owned());
            return Ok(());
        };
        let options = LineOptions {
            dpi: self.options.dpi,
            ..LineOptions::of_style(&self.style, frame.size)
        };
        let beside = (self.options.smoke.as_ref(), &self.options.pictures);
        for (of_parts, method) in [
            (npr_stylesheet::LineMethod::Curves, LineMethod::Edges),
            (npr_stylesheet::LineMethod::Potrace, LineMethod::Potrace),
        ] {
            if !self.style.has_method(of_parts) {
                continue;
            }
            let options = LineOptions { method, ..options };
            let of_style = (&self.style, of_parts);
            let drawing = lines.draw_curves(camera, of_style, &options, beside)?;
            frame.times.extend_from_slice(lines.times());
            frame.notices.extend_from_slice(&drawing.notices);
            let options = ArtworkOptions::default();
            let Some((sides, rules)) = contrasted else {
                paint_drawing_over(&drawing, &options, &mut frame.rgba);
                continue;
            };
            let mut lines = vec![0; frame.rgba.len()];
            paint_drawing_over(&drawing, &options, &mut lines);
            sides.lay(&lines, rules, &mut frame.rgba);
        }
        Ok(())
    }

    /// Hands over what does not change with the camera.
    fn upload(&mut self) -> Result<(), EngineError> {
        let (plan, model, styled) = (&self.plan, self.model, &self.styled);
        let session = self.session.as_mut();
        write(session, plan.vertices, &styled.vertices)?;
        write(session, plan.influences, &model.influences)?;
        write(session, plan.palette, &model.palette)?;
        write(session, plan.triangles, &model.triangles)?;
        let edges = model.edges_by(look::creases(&self.style).from);
        write(session, plan.edges, &edges)?;
        write(session, plan.charts, &styled.inked.charts)?;
        write(session, plan.parts, &styled.parts)?;
        let shadow_px = [SHADOW_SIDE as f32; 2];
        let window = Window::over(shadow_px, [0.0; 2], shadow_px, [SHADOW_SIDE; 2]);
        write(session, plan.shadow_window, &[window])?;
        write(session, plan.texels, styled.textures.words())?;
        if let Some(contrast_cache) = &plan.backdrop {
            write(
                session,
                contrast_cache.part_subjects,
                &self.backdrop.part_subjects,
            )?;
        }
        self.upload_smoke()
    }

    /// Hands over the spheres of the smoke.
    fn upload_smoke(&mut self) -> Result<(), EngineError> {
        let (Some(plan), Some(smoke)) = (&self.plan.smoke, &self.options.smoke) else {
            return Ok(());
        };
        let mut spheres = smoke.styled(&self.style.smoke);
        let planned = self.plan.graph.element_count(plan.spheres);
        spheres.resize(planned, Sphere::default());
        let side = self.style.smoke.shadow_px;
        let side_px = [side as f32; 2];
        let window = Window::over(side_px, [0.0; 2], side_px, [side; 2]);
        write(self.session.as_mut(), plan.light_window, &[window])?;
        write(self.session.as_mut(), plan.spheres, &spheres)
    }

    /// Draws other smoke from now on, of at most as many spheres as the smoke that the stage was made with.
    ///
    /// # Errors
    ///
    /// [`RenderError::TooMany`] for more spheres, or for any where there was no smoke; or a failing engine.
    pub fn set_smoke(&mut self, smoke: &Smoke) -> Result<(), RenderError> {
        let plan = self.plan.smoke.as_ref();
        let limit = plan.map_or(0, |plan| self.plan.graph.element_count(plan.spheres));
        smoke::check_count(smoke.spheres.len(), limit)?;
        self.options.smoke = Some(smoke.clone());
        Ok(self.upload_smoke()?)
    }

    /// The box of all that is drawn.
    fn bounds(&self) -> Bounds {
        let model = self.model.bounds();
        let Some(smoke) = self.options.smoke.as_ref().map(Smoke::extent) else {
            return model;
        };
        if self.model.is_empty() {
            return smoke;
        }
        smoke::around(model, smoke)
    }

    /// Hands over how a camera sees the smoke.
    fn upload_smoke_view(&mut self, camera: &Camera, view: &View) -> Result<(), EngineError> {
        let (Some(plan), Some(smoke)) = (&self.plan.smoke, &self.options.smoke) else {
            return Ok(());
        };
        let lens = smoke::lens_of(view, &self.style.smoke);
        let chosen = &self.smoke_lights.0;
        let extent = Some(smoke.extent());
        let lights = chosen.of_frame(&self.style, self.bounds(), extent, camera, view);
        let measure = Measure {
            height_px: self.options.size[1] as f32,
            dpi: self.options.dpi,
            size: self.grids.output,
            samples: self.grids.samples,
        };
        let surface_maps = match self.smoke_lights.1 {
            true => self.lights.shadow_count() as u32,
            false => 0,
        };
        let look = measure.look(&self.style, &lens, smoke.bounds(), &lights, surface_maps);
        let session = self.session.as_mut();
        write(session, plan.lens, &[lens])?;
        write(session, plan.look, &[look])?;
        write(session, plan.lights, &[lights])?;
        for (id, matrix) in plan.light_lenses.iter().zip(&lights.shadows) {
            let light = SphereView::of_light(matrix, self.style.smoke.shadow_px);
            write(session, *id, &[light])?;
        }
        Ok(())
    }

    /// Bytes that were planned, for what is drawn beside it.
    pub(crate) fn planned_bytes(&self) -> u64 {
        self.planned_bytes
    }

    /// What is drawn in another way than the style asks, for the user.
    pub fn notices(&self) -> &[String] {
        &self.styled.inked.notices
    }

    /// Whether a frame goes on from the one before: not the first, nor after a cut. Tiles of a frame share their
    /// buffers, so they never do.
    fn follows(&self, view: &View) -> bool {
        let Some(before) = &self.before else {
            return false;
        };
        let turned = Vec3::from(view.forward_world).dot(Vec3::from(before.forward_world));
        let moved = Vec3::from(view.eye_world).distance(Vec3::from(before.eye_world));
        self.tiles.kept == self.tiles.frame
            && turned > CUT_COS
            && moved < CUT_RADII * self.model.radius()
    }

    /// Whether the frame is drawn in tiles and nothing goes over it as a whole, so that [`Self::draw_bands`] draws it.
    pub fn draws_bands(&self) -> bool {
        draws_bands(&self.style, &self.tiles)
    }

    /// Draws the model as a camera sees it, one row of tiles after the other, and hands each to `take` as a frame as
    /// wide as the whole; the same pixels as [`Self::draw`], without ever holding them all. Ends early where `take`
    /// says no.
    ///
    /// What comes back has times and notices, and no pixels.
    ///
    /// # Errors
    ///
    /// As [`Self::draw`]; what was handed out before is then part of no picture.
    ///
    /// # Panics
    ///
    /// Where [`Self::draws_bands`] says no.
    pub fn draw_bands(
        &mut self,
        camera: &Camera,
        take: &mut dyn FnMut(&Frame) -> bool,
    ) -> Result<Frame, RenderError> {
        assert!(
            self.draws_bands(),
            "the frame needs all of its pixels at once"
        );
        let (view, _) = self.aim(camera)?;
        let [width, height] = self.options.size;
        let mut reported = Frame::new([width, 0]);
        reported.notices.extend_from_slice(self.notices());
        for top in (0..height).step_by(self.tiles.kept[1] as usize) {
            let rows = self.tiles.kept[1].min(height - top);
            let mut band = Frame::new([width, rows]);
            for origin in self.tiles.origins().filter(|origin| origin[1] == top) {
                self.draw_tile(&view, origin, top, &mut band, None)?;
            }
            reported.add_times(&band.times);
            if !take(&band) {
                break;
            }
        }
        Ok(reported)
    }

    /// Draws the model as a camera sees it.
    ///
    /// # Errors
    ///
    /// [`RenderError::Engine`] where the device fails; nothing half drawn is returned.
    pub fn draw(&mut self, camera: &Camera) -> Result<Frame, RenderError> {
        let (view, rules) = self.aim(camera)?;
        let mut frame = Frame::new(self.options.size);
        frame.notices.extend_from_slice(self.notices());
        let curves = self.lines.is_some() && self.style.has_curves();
        let mut sides = (self.method.contrast && curves).then(|| Sides::new(self.options.size));
        for origin in self.tiles.origins() {
            self.draw_tile(&view, origin, 0, &mut frame, sides.as_mut())?;
        }
        let contrasted = sides.map(|sides| (sides, rules));
        self.finish(camera, &view, contrasted.as_ref(), &mut frame)?;
        Ok(frame)
    }

    /// Hands over how a camera sees the scene.
    fn aim(&mut self, camera: &Camera) -> Result<(View, Rules), RenderError> {
        let bounds = self.bounds();
        let view = camera.view(self.options.size, bounds);
        let world_px = look::nearest_world_px(&view, camera, self.model);
        let base_px = look::base_px(
            &self.style,
            self.options.size[1],
            self.options.dpi,
            world_px,
        );
        let half = look::largest_half_width(&self.style, &self.styled.parts, base_px);
        let outline = look::outline(
            &self.style,
            self.model.radius(),
            self.options.size[1],
            self.options.dpi,
            half.ceil().min(64.0) as u32 + 1,
        );
        let mut compose = look::compose(
            &self.style,
            camera,
            self.model,
            self.styled.background_texture,
        );
        compose.flags = self.method.layers;
        if let (Some(part), Some(smoke)) = (self.styled.smoke_part, &self.options.smoke) {
            smoke::hang_sheet(&mut compose, part, smoke, &self.style.smoke, &view);
        }
        if self.plan.smoke.is_some() && self.smoke_lights.1 && self.style.smoke.casts {
            compose.smoke_shadow_side = self.style.smoke.shadow_px;
        }
        let rules = self.backdrop.rules(
            &self.style,
            self.method,
            half,
            [self.options.size[1] as f32, self.options.dpi, world_px],
            self.grids.samples,
        );
        let rules = match self.follows(&view) {
            true => rules,
            false => rules.of_first_frame(),
        };
        self.before = Some(view);
        let session = self.session.as_mut();
        write(session, self.plan.rules, &[rules])?;
        if let Some(contrast_cache) = &self.plan.backdrop {
            let lines = Compose::RIBBONS | Compose::OVERLAY | Compose::BACKDROP;
            let bare = Compose {
                flags: compose.flags & !lines | Compose::BARE,
                ..compose
            };
            write(session, contrast_cache.bare_compose, &[bare])?;
        }
        write(session, self.plan.view, &[view])?;
        write(session, self.plan.outline, &[outline])?;
        write(session, self.plan.compose, &[compose])?;
        let mut lights = self
            .lights
            .of_frame(&self.style, bounds, None, camera, &view);
        if let Some(sky) = &self.styled.sky {
            sky.apply_to(&mut lights);
        }
        write(session, self.plan.lights, &[lights])?;
        for (id, matrix) in self.plan.light_views.iter().zip(&lights.shadows) {
            write(session, *id, &[*matrix])?;
        }
        self.turn_strokes(&light::strongest(&lights), camera)?;
        self.upload_smoke_view(camera, &view)?;
        Ok((view, rules))
    }

    /// Turns the strokes that follow the light to the strongest one.
    fn turn_strokes(&mut self, light: &LightSource, camera: &Camera) -> Result<(), EngineError> {
        let [parts_turned, charts_turned] = self.styled.inked.follow_light(
            self.model,
            &self.style,
            light,
            camera,
            &mut self.styled.parts,
        );
        let session = self.session.as_mut();
        if parts_turned {
            write(session, self.plan.parts, &self.styled.parts)?;
        }
        if charts_turned {
            write(session, self.plan.charts, &self.styled.inked.charts)?;
        }
        Ok(())
    }

    /// Adds what is drawn over a whole frame: curves, speed lines, the other look, words.
    fn finish(
        &mut self,
        camera: &Camera,
        view: &View,
        contrasted: Option<&(Sides, Rules)>,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        self.draw_curves(camera, contrasted, frame)?;
        if let Some(speed_lines) = &mut self.speed_lines {
            speed_lines.apply(camera, view, frame)?;
        }
        if let Some(blending) = &mut self.blending {
            blending.apply(camera, frame)?;
        }
        let (model, parts) = (self.model, &self.styled.parts);
        self.lettering.paint(view, self.options.dpi, frame, |size| {
            surface_depths(model, parts, view, size)
        });
        Ok(())
    }

    /// Draws the tile whose kept part starts at `origin` into a frame that begins `top` rows below the whole one.
    fn draw_tile(
        &mut self,
        view: &View,
        origin: [u32; 2],
        top: u32,
        frame: &mut Frame,
        sides: Option<&mut Sides>,
    ) -> Result<(), EngineError> {
        let size = self.tiles.size();
        let corner = self.tiles.corner_px(origin);
        let extent = size.map(|side| side as f32);
        let over = |grid: [u32; 2]| Window::over(view.frame_px, corner, extent, grid);
        let session = self.session.as_mut();
        write(session, self.plan.output_window, &[over(size)])?;
        write(
            session,
            self.plan.color_window,
            &[over(size.map(|side| side * self.grids.samples))],
        )?;
        write(session, self.plan.mask_window, &[over(self.grids.mask)])?;
        if let Some(contrast_cache) = &self.plan.backdrop {
            let tiles = size.map(|side| side.div_ceil(TILE));
            let covered = tiles.map(|count| (count * TILE) as f32);
            let window = Window::over(view.frame_px, corner, covered, tiles);
            write(session, contrast_cache.tile_window, &[window])?;
        }
        let times = session.run()?;
        let tile = session.read(self.plan.frame)?;
        frame.paste(
            &tile,
            size[0],
            [self.tiles.margin; 2],
            [origin[0], origin[1] - top],
            self.tiles.kept,
        );
        frame.add_times(&times);
        let [done, of] = self.tiles.progress(origin);
        if let Some(tell) = self.tell.filter(|_| of > 1) {
            tell(done, of);
        }
        if let Some(sides) = sides {
            let margin = [self.tiles.margin; 2];
            let kept = self.tiles.kept;
            for (id, picture) in [
                (self.plan.fronts, &mut sides.fronts),
                (self.plan.backs, &mut sides.backs),
            ] {
                let texels = session.read(id)?;
                picture.paste(&texels, size[0], margin, origin, kept);
            }
        }
        Ok(())
    }
}

/// Whether a frame in such tiles is done with its last tile: curves, speed lines, a second look and words go over it
/// as a whole.
fn draws_bands(style: &Style, tiles: &Tiles) -> bool {
    let goes_over = style.has_curves()
        || !style.trails().is_empty()
        || style.blend.shows()
        || !style.lettering.is_empty();
    tiles.kept != tiles.frame && !goes_over
}

pub(crate) fn check_size([width, height]: [u32; 2]) -> Result<(), RenderError> {
    if width == 0 || height == 0 {
        return Err(RenderError::EmptyFrame { width, height });
    }
    if width.max(height) > FRAME_SIDE {
        return Err(RenderError::FrameTooLarge {
            width,
            height,
            limit: FRAME_SIDE,
        });
    }
    Ok(())
}

fn write<T: NoUninit>(
    session: &mut dyn Session,
    id: ResourceId,
    elements: &[T],
) -> Result<(), EngineError> {
    session.write(id, cast_slice(elements))
}
