//! A line model on an engine.

use super::film::HeldLines;
use super::finder::{Finder, OnDevice, OnProcessor};
use super::model::LineModel;
use super::options::LineOptions;
use super::why::{Pointed, Probe, Spot, Watch, WidthStep, nobody};
use crate::error::RenderError;
use crate::frame::Frame;
use crate::model::Model;
use crate::motion_lines;
use crate::movement::Movement;
use crate::options::Picture;
use npr_core::camera::Camera;
use npr_core::interrupt::Interrupt;
use npr_gpu::engine::{Engine, PassTime};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_vector::stroke::{Drawing, Stroke};
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Draws the scene without lines, as a camera sees it, in a style and the size of a line drawing.
pub(crate) type DrawBehind<'a> =
    dyn Fn(&Model, &Camera, &Style, &LineOptions) -> Result<Frame, RenderError> + 'a;

/// What lies behind lines.
pub(crate) struct Behind<'a> {
    /// The scene, in the pose of the lines.
    pub model: Cow<'a, Model>,
    pub draw: Box<DrawBehind<'a>>,
}

/// A line model on an engine: a device finds the lines that it has passes for, the processor all others.
///
/// A device decides which faces are turned to the eye, marks contours along edges and links them; or draws surfaces
/// and lines into a picture, links the sides of its pixels, ranks and filters their loops and cuts them to strips.
/// The shape stays in its memory from view to view. Exact visibility, smooth contours, features and strokes are the
/// processor's.
///
/// Every engine gives the drawing of [`LineModel::draw`] bit for bit, but for
/// [`LineSource::Potrace`](super::LineSource): there a device draws the depths that hide lines, and smooths, within
/// rounding; and colours that mind a backdrop may differ as far as pictures do.
pub struct LineRenderer<'a> {
    pub(crate) engine: &'a dyn Engine,
    /// The model as it was given.
    pub(crate) given: &'a LineModel,
    /// The model in another pose, once there is one.
    posed: Option<Box<LineModel>>,
    /// What lies behind lines, where their colours follow it.
    pub(crate) behind: Option<Behind<'a>>,
    /// The passes of a device, or the plain functions for an engine that runs these in their place.
    finder: Box<dyn Finder + 'a>,
    /// The frame before, where strokes hold to it.
    held: Option<HeldLines>,
    /// Where everything was before, where lines follow motion.
    movement: Option<Arc<Movement>>,
}

impl<'a> LineRenderer<'a> {
    /// Takes a model; its shape is handed to a device with the first view that needs it.
    pub fn new(engine: &'a dyn Engine, model: &'a LineModel) -> Self {
        let shape = model.shape();
        Self {
            engine,
            given: model,
            posed: None,
            behind: None,
            finder: match engine.runs_twins() {
                true => Box::new(OnProcessor),
                false => Box::new(OnDevice::new(engine, shape)),
            },
            held: None,
            movement: None,
        }
    }

    /// Another one of the same model, as it was given, on the same engine.
    pub(crate) fn another(&self) -> Self {
        Self::new(self.engine, self.given)
    }

    /// The model that is drawn.
    pub(crate) fn model(&self) -> &LineModel {
        self.posed.as_deref().unwrap_or(self.given)
    }

    /// Draws frames of a film from now on, as [`LineModel::draw_held`] does: strokes hold to those of the frame before.
    /// The next frame is the first.
    pub fn hold_strokes(&mut self) {
        self.held = Some(HeldLines::default());
    }

    /// Where everything was before the pose that is drawn: drawings have what `[motion]` draws of that from now on.
    /// Lines lag behind by `motion.smear`; speed lines and after-images are strokes of kind
    /// [`Kind::Marked`](npr_vector::stroke::Kind) on objects "speed lines" and "after-images".
    /// [`Renderer::set_movement`](crate::Renderer::set_movement) draws the same ones.
    pub fn set_movement(&mut self, movement: Option<Arc<Movement>>) {
        self.movement = movement;
    }

    /// Finds the lines that a camera sees, for those of the next frame to hold to, and gives none.
    ///
    /// # Errors
    ///
    /// Those of [`Self::draw`].
    pub fn pass(
        &mut self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
    ) -> Result<(), RenderError> {
        let options = LineOptions {
            fill: false,
            ..*options
        };
        self.draw(camera, style, &options).map(drop)
    }

    /// Draws the pose of a scene from now on, as [`LineModel::set_pose`] takes it; the model that was given stays as
    /// it is. With the first pose the model is copied, with every further one a device is handed positions, and the
    /// rest only where it differs.
    ///
    /// # Errors
    ///
    /// Those of [`LineModel::set_pose`], and of [`Model::set_pose`] for what lies behind.
    pub fn set_pose(&mut self, scene: &Scene) -> Result<(), RenderError> {
        let posed = self
            .posed
            .get_or_insert_with(|| Box::new(self.given.to_pose()));
        posed.set_pose(scene)?;
        self.finder.follow();
        match &mut self.behind {
            Some(behind) => behind.model.to_mut().set_pose(scene),
            None => Ok(()),
        }
    }

    /// The lines that a camera sees; see [`LineModel::draw`].
    ///
    /// # Errors
    ///
    /// Those of [`LineModel::draw`], and [`RenderError::Engine`] where the device fails or has no room for the shape:
    /// beyond 2.7 million triangles none has; those of [`Renderer::new`](crate::Renderer::new) for a picture behind.
    pub fn draw(
        &mut self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
    ) -> Result<Drawing, RenderError> {
        let behind = self.picture_behind(camera, style, options)?;
        self.finder.start_view();
        let model = self.posed.as_deref().unwrap_or(self.given);
        let find = self.finder.as_mut();
        let seen = (camera, behind.as_ref());
        let before = (self.held.as_mut(), self.movement.as_deref());
        let mut drawing = model.draw_with(seen, style, options, find, before, &nobody)?;
        if let Some(movement) = &self.movement {
            let of_page = (options.size, options.dpi);
            let lines = motion_lines::find_motion_lines(movement, (camera, style), of_page);
            motion_lines::lay_over(&mut drawing, lines);
        }
        Ok(drawing)
    }

    fn picture_behind(
        &self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
    ) -> Result<Option<Frame>, RenderError> {
        match &self.behind {
            Some(Behind { model, draw }) if style.contrasts_with_background() => {
                draw(model, camera, style, options).map(Some)
            }
            _ => Ok(None),
        }
    }

    /// What a drawing shows at a spot, with the reasons of the line there. Lines are found as [`Self::draw`] finds them
    /// and takes about as long, and are watched on the way; of a film it is a frame that holds to no other.
    ///
    /// # Errors
    ///
    /// Those of [`Self::draw`].
    pub fn point_at(
        &mut self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
        spot: Spot,
    ) -> Result<Pointed, RenderError> {
        let behind = self.picture_behind(camera, style, options)?;
        self.finder.start_view();
        let model = self.posed.as_deref().unwrap_or(self.given);
        let probe = Probe::new(spot);
        let drawing = model.draw_with(
            (camera, behind.as_ref()),
            style,
            options,
            self.finder.as_mut(),
            (None, self.movement.as_deref()),
            &|step, strokes| probe.see(step, strokes),
        )?;
        model.pointed((camera, style, options), &drawing, &probe)
    }

    /// As [`Self::point_at`], of the lines of [`Self::draw_curves`].
    pub(crate) fn point_at_curves(
        &mut self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
        pictures: &BTreeMap<String, Picture>,
        spot: Spot,
    ) -> Result<Pointed, RenderError> {
        let probe = Probe::new(spot);
        let see = |step: WidthStep, strokes: &[Stroke]| probe.see(step, strokes);
        let drawing = self.watched_curves(camera, style, options, pictures, &see)?;
        self.model()
            .pointed((camera, style, options), &drawing, &probe)
    }

    /// The lines of [`Self::draw_curves`] as they are found, before the style changes anything about their ways.
    pub(crate) fn found_curves(
        &mut self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
        pictures: &BTreeMap<String, Picture>,
    ) -> Result<Drawing, RenderError> {
        let found = RefCell::new(Vec::new());
        let see = |step: WidthStep, strokes: &[Stroke]| {
            if step == WidthStep::Part {
                found.replace(strokes.to_vec());
            }
        };
        let drawing = self.watched_curves(camera, style, options, pictures, &see)?;
        Ok(Drawing {
            strokes: found.into_inner(),
            ..drawing
        })
    }

    /// The lines of [`Self::draw_curves`] of a frame that holds to no other, watched on the way.
    fn watched_curves(
        &mut self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
        pictures: &BTreeMap<String, Picture>,
        watch: Watch<'_>,
    ) -> Result<Drawing, RenderError> {
        self.finder.start_view();
        let model = self.posed.as_deref().unwrap_or(self.given);
        let find: &mut dyn Finder = self.finder.as_mut();
        let seen = (find, (None, self.movement.as_deref()));
        let on_the_way = (watch, &Interrupt::NEVER);
        model.draw_curves(camera, style, (options, false), pictures, seen, on_the_way)
    }

    /// The lines of the parts whose style asks for curves that are found as `options` says; smoke hides none of them.
    /// Where it `is_open` what is seen of them, all are there. A flag that is raised ends the work between two steps.
    pub(crate) fn draw_curves(
        &mut self,
        camera: &Camera,
        style: &Style,
        (options, is_open): (&LineOptions, bool),
        (pictures, interrupt): (&BTreeMap<String, Picture>, &Interrupt),
    ) -> Result<Drawing, RenderError> {
        self.finder.start_view();
        let model = self.posed.as_deref().unwrap_or(self.given);
        let find: &mut dyn Finder = self.finder.as_mut();
        let before = (self.held.as_mut(), self.movement.as_deref());
        let of_method = (options, is_open);
        let on_the_way = (&nobody as Watch<'_>, interrupt);
        model.draw_curves(
            camera,
            style,
            of_method,
            pictures,
            (find, before),
            on_the_way,
        )
    }

    /// How long each pass of the last view took; none on the processor.
    pub fn times(&self) -> &[PassTime] {
        self.finder.times()
    }
}
