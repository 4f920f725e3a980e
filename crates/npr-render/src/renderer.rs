//! A model, a style and a frame size on an engine, ready to draw.

use crate::bending::Moved;
use crate::error::RenderError;
use crate::features::blending::Blending;
use crate::features::lettering::Lettering;
use crate::features::speed_lines::SpeedLines;
use crate::features::stroke_places::{StrokePlaces, stroke_places};
use crate::features::strokes::{self, FoundStrokes, StrokeReport};
use crate::frame::Frame;
use crate::frame_graph::pixel_count;
use crate::frame_renderer::{Aimed, FramePlan, FrameRenderer};
use crate::layer_pixel::LayerPixel;
use crate::lines::{LineRenderer, Pointed, Spot};
use crate::look::StyledModel;
use crate::model::Model;
use crate::motion_lines::find_motion_lines;
use crate::movement::Movement;
use crate::options::{RendererOptions, check_size};
use crate::part_info::PartInfo;
use crate::smoke::Smoke;
use crate::stage::{LineStage, StagePixel};
use crate::surfaces::Surfaces;
use crate::tiles::Tiles;
use npr_core::budget::Budget;
use npr_core::camera::Camera;
use npr_drawing::artwork::{ArtworkOptions, Mark, arrange};
use npr_drawing::drawing::paint_over;
use npr_gpu::cost::PassCost;
use npr_gpu::engine::{Engine, IN_FLIGHT};
use npr_scene::Scene;
use npr_stylesheet::{SceneHint, Style};
use npr_vector::stroke::Drawing;
use std::borrow::Cow;
use std::sync::Arc;

/// The style that frames without a line model are drawn in, with what they tell where it is another one.
pub(crate) fn without_lines(style: &Style) -> (Cow<'_, Style>, Option<String>) {
    let notice = "lines of method strokes are drawn by method shape, for want of a line model";
    match style.with_shapes_for_strokes() {
        Some(shapes) => (Cow::Owned(shapes), Some(notice.to_owned())),
        None => (Cow::Borrowed(style), None),
    }
}

/// A model, a style and a frame size on an engine: draws a picture for any camera.
pub struct Renderer<'a> {
    engine: &'a dyn Engine,
    /// The model, as it was given until it takes another pose.
    model: Cow<'a, Model>,
    /// What the passes of a frame draw.
    frames: FrameRenderer,
    /// Gives the lines of parts whose method is `strokes` or `potrace`.
    lines: Option<LineRenderer<'a>>,
    speed_lines: Option<SpeedLines>,
    /// The look that shows through, and how much of it.
    blended: Option<(Box<Renderer<'a>>, Blending)>,
    lettering: Lettering,
    /// Where everything was before, where lines follow motion.
    movement: Option<Arc<Movement>>,
    /// Called after every tile with the numbers of tiles done and of all.
    tell: Option<&'a dyn Fn(usize, usize)>,
}

/// A frame that is being drawn, and what finishing it needs: the renderer may be told of the next one meanwhile.
pub(crate) struct Begun {
    aimed: Aimed,
    camera: Camera,
    /// How its strokes were found.
    strokes: StrokeReport,
    /// What every pixel shows of strokes, where layers have that.
    stroke_places: StrokePlaces,
    /// The same frame in the other look of a blend.
    other: Option<Box<Begun>>,
}

/// A renderer that is planned and checked, and not yet prepared: nothing of it has asked the engine for anything.
struct RendererPlan<'a> {
    model: &'a Model,
    frames: FramePlan,
    speed_lines: Option<SpeedLines>,
    blended: Option<(Box<RendererPlan<'a>>, Blending)>,
    lettering: Lettering,
    /// Bytes planned for the renderer and the looks that it blends.
    planned_bytes: u64,
}

impl<'a> RendererPlan<'a> {
    /// Plans a frame and all that goes over it, and checks that the whole fits into memory; `stroked` are the parts of
    /// the line model, where there is one.
    fn new(
        model: &'a Model,
        style: &Style,
        options: &RendererOptions,
        stroked: Option<&[PartInfo]>,
    ) -> Result<Self, RenderError> {
        // Resolve the style and its words.
        check_size(options.size)?;
        let (style, notice) = match stroked.is_some() {
            true => (Cow::Borrowed(style), None),
            false => without_lines(style),
        };
        let style = &*style;
        let mut styled = StyledModel::new(model, style, options, stroked.unwrap_or_default())?;
        styled.inked.notices.extend(notice);
        let lettering = Lettering::new(style, &options.fonts)?;
        let notices = &mut styled.inked.notices;
        notices.extend_from_slice(lettering.notices());

        // Plan the frame.
        let mut frames = FramePlan::new(model, style, options, styled);
        let mut budget = Budget::new(options.memory_limit);
        let rows = match options.in_bands && draws_bands(&frames) {
            true => frames.tiles().kept[1].min(options.size[1]),
            false => options.size[1],
        };
        frames.take_memory(&mut budget, rows)?;

        // Plan what goes over the picture.
        let pixels = pixel_count(options.size);
        if !lettering.is_empty() {
            budget.take("the words over the picture", pixels, 4)?;
            if lettering.may_be_hidden() {
                // A sheet of its own, and four samples of numbers and depths.
                budget.take("what hides words", pixels, 4 + 4 * 12)?;
            }
        }
        let speed_lines = SpeedLines::needs(model, style, options, &mut budget)?;

        // Plan the other look of a blend, in the memory that is left.
        let mut planned_bytes = budget.used_bytes();
        let mut blended = None;
        if let Some(blending) = Blending::needs(style, options)? {
            let left = RendererOptions {
                memory_limit: options.memory_limit - planned_bytes,
                layers: false,
                ..options.clone()
            };
            let other = Self::new(model, &style.blended_with()?, &left, stroked)?;
            planned_bytes += other.planned_bytes;
            blended = Some((Box::new(other), blending));
        }
        let beside = planned_bytes - frames.graph().planned_bytes();
        frames.graph_limit = options.memory_limit - beside;
        Ok(Self {
            model,
            frames,
            speed_lines,
            blended,
            lettering,
            planned_bytes,
        })
    }

    /// Prepares all of it on an engine; both looks of a blend have the strokes of one line model.
    fn prepare(
        self,
        engine: &'a dyn Engine,
        lines: Option<LineRenderer<'a>>,
    ) -> Result<Renderer<'a>, RenderError> {
        let blended = match self.blended {
            Some((other, blending)) => {
                let of_other = lines.as_ref().map(LineRenderer::another);
                Some((Box::new(other.prepare(engine, of_other)?), blending))
            }
            None => None,
        };
        Ok(Renderer {
            engine,
            model: Cow::Borrowed(self.model),
            frames: self.frames.prepare(self.model, engine)?,
            lines,
            speed_lines: self.speed_lines,
            blended,
            lettering: self.lettering,
            movement: None,
            tell: None,
        })
    }
}

impl<'a> Renderer<'a> {
    /// Plans the frame, checks that it fits, and uploads what does not change with the camera.
    ///
    /// Without a line model there are no strokes: lines of method `strokes` are drawn by method `shape`, those of
    /// `potrace` are left out, and [`Frame::notices`] tells. [`Renderer::with_lines`] draws them.
    ///
    /// # Errors
    ///
    /// [`RenderError`] for a frame without pixels or beyond 32768 a side, a plan beyond the memory limit, words that
    /// cannot be set, pictures that are missing or unfit, or a failing engine. All that can be known before is checked
    /// before the engine is asked for memory.
    pub fn new(
        engine: &'a dyn Engine,
        model: &'a Model,
        style: &Style,
        options: &RendererOptions,
    ) -> Result<Self, RenderError> {
        RendererPlan::new(model, style, options, None)?.prepare(engine, None)
    }

    /// The same, with strokes from a line model of the scene, found on an engine that may be another one.
    ///
    /// ```
    /// # use npr_gpu::processor::Processor;
    /// # use npr_render::{LineModel, LineModelOptions, LineRenderer, Model, Renderer, RendererOptions};
    /// # let scene = npr_scene::Scene::default();
    /// # let style = npr_stylesheet::Style::default();
    /// let model = Model::new(&scene)?;
    /// let lines = LineModel::for_style(&scene, &style, &LineModelOptions::default(), None)?;
    /// let lines = LineRenderer::new(&Processor, &lines);
    /// let options = RendererOptions::new([64, 36]);
    /// let mut renderer = Renderer::with_lines(&Processor, (&model, lines), &style, &options)?;
    /// renderer.draw(&model.framing(16.0 / 9.0, 0.7))?;
    /// # Ok::<(), npr_render::RenderError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Renderer::new`].
    pub fn with_lines(
        engine: &'a dyn Engine,
        (model, lines): (&'a Model, LineRenderer<'a>),
        style: &Style,
        options: &RendererOptions,
    ) -> Result<Self, RenderError> {
        let plan = RendererPlan::new(model, style, options, Some(lines.model().parts()))?;
        plan.prepare(engine, Some(lines))
    }

    /// The same renderer, which calls `tell` after each tile with how many are done, of how many; never for a single
    /// tile.
    pub fn with_progress(mut self, tell: &'a dyn Fn(usize, usize)) -> Self {
        self.tell = Some(tell);
        self
    }

    /// Draws other smoke from now on, in both looks of a blend: at most as many spheres as the smoke has that the
    /// renderer was made with.
    ///
    /// # Errors
    ///
    /// [`RenderError::TooMany`] for more spheres, or for any where there was no smoke; or a failing engine.
    pub fn set_smoke(&mut self, smoke: &Smoke) -> Result<(), RenderError> {
        self.frames.set_smoke(smoke)?;
        match &mut self.blended {
            Some((other, _)) => other.set_smoke(smoke),
            None => Ok(()),
        }
    }

    /// Draws the pose of a scene from now on, in both looks of a blend: the scene that model and lines were made of, as
    /// [`Model::set_pose`] and [`LineModel::set_pose`](crate::LineModel::set_pose) take it. Those that were given stay
    /// as they are.
    ///
    /// With the first pose the model is copied. Nothing of its topology is made anew, and the engine is handed what
    /// moved alone: matrices, folds that changed, vertices where morphs changed, lights. What the style lays on the
    /// surface stays as it was: charts of hatching, id maps, ambient shade, and widths by control points.
    ///
    /// # Errors
    ///
    /// Those of [`Model::set_pose`] and [`LineModel::set_pose`](crate::LineModel::set_pose), or a failing engine.
    pub fn set_pose(&mut self, scene: &Scene) -> Result<(), RenderError> {
        // Move the model and its lines.
        self.forget_begun();
        let moved = self.model.to_mut().pose(scene)?;
        if let Some(lines) = &mut self.lines {
            lines.set_pose(scene)?;
        }
        if let Some(speed_lines) = &mut self.speed_lines {
            speed_lines.follow(&self.model);
        }

        // Hand over what moved; other lights need other passes.
        if !self.frames.pose(&self.model, moved)? {
            self.plan_anew()?;
        }
        match &mut self.blended {
            Some((other, _)) => other.set_pose(scene),
            None => Ok(()),
        }
    }

    /// Where everything was before the pose that is drawn: frames have what `[motion]` draws of that from now on, in
    /// both looks of a blend: the strokes that [`LineRenderer::set_movement`](crate::LineRenderer::set_movement) adds
    /// to drawings, the same on any engine.
    pub fn set_movement(&mut self, movement: Option<Arc<Movement>>) {
        if let Some(lines) = &mut self.lines {
            lines.set_movement(movement.clone());
        }
        if let Some((other, _)) = &mut self.blended {
            other.set_movement(movement.clone());
        }
        self.movement = movement;
    }

    /// Draws frames of a film from now on: strokes hold to those of the frame before, in both looks of a blend, as
    /// [`LineModel::draw_held`](crate::LineModel::draw_held) says. The next frame is the first.
    pub fn hold_strokes(&mut self) {
        if let Some(lines) = &mut self.lines {
            lines.hold_strokes();
        }
        if let Some((other, _)) = &mut self.blended {
            other.hold_strokes();
        }
    }

    /// Whether frames have strokes, which can hold to those of the frame before.
    pub fn has_strokes(&self) -> bool {
        let of_other = (self.blended.as_ref()).is_some_and(|(other, _)| other.has_strokes());
        of_other || self.lines.is_some() && self.frames.plan.style.has_curves()
    }

    /// Finds the strokes that a camera sees, for those of the next frame to hold to, and draws nothing: what comes
    /// before a part of a film.
    ///
    /// # Errors
    ///
    /// Those of [`Self::draw`] that have to do with lines.
    pub fn pass(&mut self, camera: &Camera) -> Result<(), RenderError> {
        self.find_strokes(camera)?;
        match &mut self.blended {
            Some((other, _)) => other.pass(camera),
            None => Ok(()),
        }
    }

    /// What the frame of a camera shows at a spot, with the reasons of the stroke there; nothing where lines are no
    /// strokes ([`Self::has_strokes`]). It takes as long as strokes take to be found. Of a blend it is the first look.
    ///
    /// # Errors
    ///
    /// Those of [`Self::draw`] that have to do with lines.
    pub fn point_at(&mut self, camera: &Camera, spot: Spot) -> Result<Pointed, RenderError> {
        let FramePlan { style, options, .. } = &self.frames.plan;
        match &mut self.lines {
            Some(lines) => strokes::point_at(lines, camera, (style, options), spot),
            None => Ok(Pointed::default()),
        }
    }

    /// Strokes at a stage on the way to those of a frame, in its pixels, with the widths that its style gives them
    /// there; none where lines are no strokes ([`Self::has_strokes`]). Each method that the style asks for gives its
    /// own drawing. It takes as long as strokes take to be found. Of a blend it is the first look.
    ///
    /// # Errors
    ///
    /// Those of [`Self::draw`] that have to do with lines.
    pub fn lines_at(
        &mut self,
        camera: &Camera,
        stage: LineStage,
    ) -> Result<Vec<Drawing>, RenderError> {
        let FramePlan { style, options, .. } = &self.frames.plan;
        match &mut self.lines {
            Some(lines) => strokes::at_stage(lines, camera, (style, options), stage),
            None => Ok(Vec::new()),
        }
    }

    /// Draws the pictures of toon materials where they are after some seconds, in the looks of a blend that use the
    /// scene's hints; see [`Model::flow_textures`]. The model that was given stays as it is.
    ///
    /// # Errors
    ///
    /// A failing engine.
    pub fn flow_textures(&mut self, seconds: f32) -> Result<(), RenderError> {
        let hints = &self.frames.plan.style.use_scene_hints;
        if hints.uses(SceneHint::Shade) && self.model.has_flow() {
            self.forget_begun();
            self.model.to_mut().flow_textures(seconds);
            let moved = Moved {
                vertices: true,
                ..Moved::default()
            };
            if !self.frames.pose(&self.model, moved)? {
                self.plan_anew()?;
            }
        }
        match &mut self.blended {
            Some((other, _)) => other.flow_textures(seconds),
            None => Ok(()),
        }
    }

    /// Plans and prepares the frame for the model as it stands.
    fn plan_anew(&mut self) -> Result<(), RenderError> {
        let FramePlan {
            style,
            options,
            graph_limit,
            ..
        } = &self.frames.plan;
        let stroked = self.lines.as_ref().map(|lines| lines.model().parts());
        let mut styled =
            StyledModel::new(&self.model, style, options, stroked.unwrap_or_default())?;
        styled.inked.notices.clear();
        let mut plan = FramePlan::new(&self.model, style, options, styled);
        plan.graph_limit = *graph_limit;
        plan.set_notices(self.notices().to_vec());
        self.frames = plan.prepare(&self.model, self.engine)?;
        Ok(())
    }

    /// What is drawn in another way than the style asks, for the user.
    pub fn notices(&self) -> &[String] {
        &self.frames.plan.styled().inked.notices
    }

    /// Whether the frame is drawn in tiles, without layers, and nothing goes over it as a whole, so that
    /// [`Self::draw_bands`] draws it.
    pub fn draws_bands(&self) -> bool {
        draws_bands(&self.frames.plan)
    }

    /// Draws the model as a camera sees it, one row of tiles after the other, and hands each to `take` as a frame as
    /// wide as the whole; the same pixels as [`Self::draw`], without ever holding them all. Ends early where `take`
    /// returns false.
    ///
    /// What comes back has times and notices, and no pixels.
    ///
    /// # Errors
    ///
    /// As [`Self::draw`]; what was handed out before is then part of no picture.
    ///
    /// # Panics
    ///
    /// Where [`Self::draws_bands`] returns false.
    pub fn draw_bands(
        &mut self,
        camera: &Camera,
        take: &mut dyn FnMut(&Frame) -> bool,
    ) -> Result<Frame, RenderError> {
        assert!(
            self.draws_bands(),
            "the frame needs all of its pixels at once"
        );
        self.forget_begun();
        let drawn = self.draw_rows(camera, take);
        self.or_anew(drawn)
    }

    /// The work of [`Self::draw_bands`].
    fn draw_rows(
        &mut self,
        camera: &Camera,
        take: &mut dyn FnMut(&Frame) -> bool,
    ) -> Result<Frame, RenderError> {
        let (found, strokes) = self.find_strokes(camera)?;
        let mut aimed = self.frames.begin(&self.model, camera, &found)?;
        let [width, height] = self.frames.plan.options.size;
        let tiles = *self.frames.plan.tiles();
        let mut reported = Frame::new([width, 0]);
        reported.notices.extend_from_slice(self.notices());
        for top in (0..height).step_by(tiles.kept[1] as usize) {
            // Draw the tiles of a row into a band, and hand it on.
            let rows = tiles.kept[1].min(height - top);
            let mut band = Frame::new([width, rows]);
            for origin in tiles.origins().filter(|origin| origin[1] == top) {
                let (aimed, at) = ((&*self.model, &mut aimed), (origin, top));
                self.frames.take_tile(aimed, at, &mut band)?;
                self.tell_of(&tiles, origin);
            }
            reported.add_times(&band.times);
            if !take(&band) {
                break;
            }
        }
        strokes.tell(&mut reported);
        Ok(reported)
    }

    /// Draws the model as a camera sees it.
    ///
    /// # Errors
    ///
    /// [`RenderError::Engine`] where the device fails or the frame is [interrupted](RendererOptions::interrupt);
    /// nothing half drawn is returned, and the next frame is drawn as if it were the first.
    pub fn draw(&mut self, camera: &Camera) -> Result<Frame, RenderError> {
        self.forget_begun();
        let begun = self.begin(camera)?;
        self.finish(begun)
    }

    /// How many frames may be begun and not finished: tiles of two frames would share memory.
    pub(crate) fn most_begun(&self) -> usize {
        match self.frames.plan.tiles().count() {
            1 => IN_FLIGHT,
            _ => 1,
        }
    }

    /// Forgets frames that were begun, and that nobody will finish.
    pub(crate) fn forget_begun(&mut self) {
        self.frames.forget_begun();
        if let Some((other, _)) = &mut self.blended {
            other.forget_begun();
        }
    }

    /// Lets the next frame go on from none where one has failed: half a frame is none to go on from.
    fn or_anew<T>(&mut self, drawn: Result<T, RenderError>) -> Result<T, RenderError> {
        if drawn.is_err() {
            self.forget_before();
        }
        drawn
    }

    /// Draws the next frame as if it were the first.
    fn forget_before(&mut self) {
        self.frames.before = None;
        if let Some((other, _)) = &mut self.blended {
            other.forget_before();
        }
    }

    /// Starts to draw the model, and the other look of a blend, as a camera sees it.
    pub(crate) fn begin(&mut self, camera: &Camera) -> Result<Begun, RenderError> {
        let begun = self.start(camera);
        self.or_anew(begun)
    }

    /// The work of [`Self::begin`].
    fn start(&mut self, camera: &Camera) -> Result<Begun, RenderError> {
        let (found, strokes) = self.find_strokes(camera)?;
        let aimed = self.frames.begin(&self.model, camera, &found)?;
        let other = match &mut self.blended {
            Some((other, _)) => Some(Box::new(other.begin(camera)?)),
            None => None,
        };
        let options = &self.frames.plan.options;
        let stroke_places = match options.layers && !found.seen.is_empty() {
            true => {
                let base_px = self.frames.stroke_base_px(&aimed.view, camera, &self.model);
                let inked = (self.frames.plan.styled(), base_px);
                stroke_places(found.seen, &aimed.view, inked, options.size)
            }
            false => StrokePlaces::default(),
        };
        Ok(Begun {
            aimed,
            camera: *camera,
            strokes,
            stroke_places,
            other,
        })
    }

    /// Takes the frame that was begun first of those that are not finished, and draws what goes over it as a whole.
    pub(crate) fn finish(&mut self, begun: Begun) -> Result<Frame, RenderError> {
        let drawn = self.take(begun);
        self.or_anew(drawn)
    }

    /// The work of [`Self::finish`].
    fn take(&mut self, mut begun: Begun) -> Result<Frame, RenderError> {
        // Take the tiles.
        let RendererOptions {
            size,
            layers,
            stages,
            ..
        } = self.frames.plan.options;
        let mut frame = Frame::new(size);
        if layers {
            frame.layers = vec![LayerPixel::EMPTY; pixel_count(size)];
        }
        if layers && stages {
            frame.stages = vec![StagePixel::default(); pixel_count(size)];
        }
        frame.notices.extend_from_slice(self.notices());
        let tiles = *self.frames.plan.tiles();
        for origin in tiles.origins() {
            let (aimed, at) = ((&*self.model, &mut begun.aimed), (origin, 0));
            self.frames.take_tile(aimed, at, &mut frame)?;
            self.tell_of(&tiles, origin);
        }
        let StrokePlaces { places, kinds } = &begun.stroke_places;
        for (pixel, place) in frame.layers.iter_mut().zip(places) {
            if pixel.line[3] > 0.0 {
                (pixel.stroke, pixel.stroke_depth, pixel.uv) =
                    (place.number, place.depth, place.uv);
            }
        }
        for (pixel, layers) in frame.stages.iter_mut().zip(&frame.layers) {
            let index = layers.stroke.checked_sub(1);
            pixel.kind = index.and_then(|index| kinds.get(index as usize).copied());
        }
        begun.strokes.tell(&mut frame);

        // Draw the rest over them.
        self.draw_over(begun, &mut frame)?;
        Ok(frame)
    }

    /// What the passes of [`Frame::times`] asked of a device in the frame drawn last, counted by [`npr_gpu::cost`], and
    /// what the copy of the picture to the processor asks. Of a frame in tiles, what its last tile asked for.
    ///
    /// A second look that shows through and the finding of strokes have graphs of their own and do not count.
    ///
    /// # Errors
    ///
    /// [`RenderError::Engine`] where the device fails.
    pub fn pass_costs(&mut self) -> Result<Vec<PassCost>, RenderError> {
        self.forget_begun();
        Ok(self.frames.pass_costs()?)
    }

    /// Tells that the tile at `origin` is done, where there are several.
    fn tell_of(&self, tiles: &Tiles, origin: [u32; 2]) {
        let [done, of] = tiles.progress(origin);
        if let Some(tell) = self.tell.filter(|_| of > 1) {
            tell(done, of);
        }
    }

    /// Finds the strokes that a camera sees, and tells how.
    fn find_strokes(
        &mut self,
        camera: &Camera,
    ) -> Result<(FoundStrokes, StrokeReport), RenderError> {
        let plan = &self.frames.plan;
        let leaves_open = plan.leaves_strokes_open();
        let asked = (&plan.style, &plan.options);
        strokes::find(self.lines.as_mut(), camera, asked, leaves_open)
    }

    /// Adds what is drawn over a whole frame: speed lines, the other look, words.
    fn draw_over(&mut self, begun: Begun, frame: &mut Frame) -> Result<(), RenderError> {
        // Draw speed lines, and let the other look show through.
        let view = &begun.aimed.view;
        let frames = &self.frames;
        if let Some(speed_lines) = &self.speed_lines {
            speed_lines.finish(&self.model, view, frame);
        }
        if let Some(movement) = &self.movement {
            let FramePlan { style, options, .. } = &frames.plan;
            let of_page = (options.stroke_size(), options.stroke_dpi());
            let lines = find_motion_lines(movement, (&begun.camera, style), of_page);
            lay_strokes_over(lines.scaled(options.stroke_scale()), frame);
        }
        if let (Some((other, blending)), Some(begun)) = (&mut self.blended, begun.other) {
            blending.finish(&other.finish(*begun)?, frame);
        }

        // Set the words over everything.
        let depths_on =
            |size| Surfaces::new(&self.model, &frames.plan.styled().parts, view, size).depths;
        self.lettering
            .finish(view, frames.plan.options.dpi, frame, depths_on);
        Ok(())
    }
}

/// Paints the strokes of a drawing over a frame, as files have them.
fn lay_strokes_over(drawing: Drawing, frame: &mut Frame) {
    let artwork = arrange(&drawing, &ArtworkOptions::default());
    let groups = artwork.layers.into_iter().flat_map(|layer| layer.groups);
    let marks: Vec<Mark> = groups.flat_map(|group| group.marks).collect();
    paint_over(&marks, &mut frame.rgba, frame.size);
}

/// Whether a frame can be drawn in bands: layers are made of all of it, and speed lines, a second look and words go
/// over it as a whole.
fn draws_bands(plan: &FramePlan) -> bool {
    let (style, tiles) = (&plan.style, plan.tiles());
    let has_trails = !style.trails().is_empty() || style.has_motion_lines();
    let goes_over = has_trails || style.blend.shows() || !style.lettering.is_empty();
    tiles.kept != tiles.frame && !goes_over && !plan.options.layers
}
