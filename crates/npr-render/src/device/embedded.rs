//! A drawing inside the frames of another wgpu program.

use crate::error::RenderError;
use crate::features::strokes::FoundStrokes;
use crate::frame_renderer::{FramePlan, FrameRenderer};
use crate::look::StyledModel;
use crate::model::Model;
use crate::options::{RendererOptions, check_size};
use crate::placement::Bounds;
use crate::renderer::without_lines;
use crate::smoke::Smoke;
use glam::{DMat4, Mat4, Vec3};
use npr_core::budget::Budget;
use npr_core::camera::{Camera, box_corners};
use npr_core::line_source::LineSource;
use npr_core::window::View;
use npr_gpu::device::{Device, DeviceSession, Inlay, Target, TargetFormat, wgpu};
use npr_gpu::graph::ResourceId;
use npr_scene::Scene;
use npr_stylesheet::{Background, Style};

/// How far apart, in pixels, camera and matrix of a host may show a corner of the scene.
const AGREEMENT_PX: f32 = 0.5;

/// The view of a host program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HostView {
    /// The eye, for lines, shading and the size of things.
    pub camera: Camera,
    /// The matrix that the host draws with, from the world to clip space, by columns: x to the right and y up,
    /// depths 0..1 in either direction. It has to show the scene where the camera does.
    pub clip_from_world: [[f32; 4]; 4],
}

/// A drawing inside the frames of another wgpu program.
///
/// It lives as long as the host wants to draw, on the host's device. [`Self::record`] adds the passes of a frame to an
/// encoder of the host, and lays the picture into a view of the host: over what is there, hidden by what is nearer,
/// and hiding what is drawn later behind it. Nothing is submitted, waited for or read back. The background of the style
/// is left out: the host's picture is the background.
///
/// A frame needs no processor between its passes. Styles that do are refused: lines of method `potrace`,
/// speed lines, a blend of two looks, words; and frames of more than 4 million pixels, which are drawn in
/// tiles.
pub struct EmbeddedRenderer {
    device: Device,
    model: Model,
    frames: FrameRenderer<DeviceSession>,
    inlay: Inlay,
    format: TargetFormat,
}

impl EmbeddedRenderer {
    /// Plans the drawing of a model in a style, compiles its passes, and uploads what does not change from frame to
    /// frame.
    ///
    /// [`RendererOptions::size`] is the size of the host's picture in pixels, `format` that of its views. Takes as
    /// long as shaders take to compile, tenths of a second to seconds; [`Device`] keeps them for the next one.
    ///
    /// # Errors
    ///
    /// [`RenderError`] as by [`Renderer::new`](crate::Renderer::new), [`RenderError::NotRecorded`] for styles and sizes
    /// that cannot be recorded, and [`RenderError::Engine`] for formats that the device cannot draw into.
    pub fn new(
        device: &Device,
        model: Model,
        style: &Style,
        options: &RendererOptions,
        format: TargetFormat,
    ) -> Result<Self, RenderError> {
        let (plan, picture) = plan(&model, style, options)?;
        let session = device.session(plan.graph().clone())?;
        let inlay = Inlay::new(device, &session, picture, format)?;
        Ok(Self {
            frames: FrameRenderer::new(plan, &model, session)?,
            device: device.clone(),
            model,
            inlay,
            format,
        })
    }

    /// Draws in another style from now on. Memory and passes stay where it needs the same; passes that no style before
    /// needed are compiled.
    ///
    /// # Errors
    ///
    /// As [`Self::new`]; the style before goes on then, unless the device is lost.
    pub fn set_style(&mut self, style: &Style) -> Result<(), RenderError> {
        let planned = plan(&self.model, style, &self.frames.plan.options)?;
        self.follow(planned, None)
    }

    /// Draws frames of another size from now on, with new memory; no pass is compiled.
    ///
    /// # Errors
    ///
    /// As [`Self::set_style`].
    pub fn set_size(&mut self, size: [u32; 2]) -> Result<(), RenderError> {
        let FramePlan { style, options, .. } = &self.frames.plan;
        let options = RendererOptions {
            size,
            ..options.clone()
        };
        let planned = plan(&self.model, style, &options)?;
        self.follow(planned, None)
    }

    /// Draws another model from now on. Memory stays where it has as many vertices, triangles, edges and parts.
    ///
    /// # Errors
    ///
    /// As [`Self::set_style`].
    pub fn set_model(&mut self, model: Model) -> Result<(), RenderError> {
        let FramePlan { style, options, .. } = &self.frames.plan;
        let planned = plan(&model, style, options)?;
        self.follow(planned, Some(model))
    }

    /// Draws the model in the pose of a scene from now on, as [`Model::set_pose`] takes it: matrices are uploaded,
    /// lights that move with the scene, folds that changed, and vertices where morphs move them.
    ///
    /// What the style lays on the surface itself stays as it was: strokes go with their surface, and what the sky does
    /// not reach is that of the pose in which the style was set.
    ///
    /// # Errors
    ///
    /// [`RenderError::OtherScene`] as by [`Model::set_pose`], or a failing device.
    pub fn set_pose(&mut self, scene: &Scene) -> Result<(), RenderError> {
        let moved = self.model.pose(scene)?;
        match self.frames.pose(&self.model, moved)? {
            true => Ok(()),
            // Other lights need other passes.
            false => {
                let FramePlan { style, options, .. } = &self.frames.plan;
                let planned = plan(&self.model, style, options)?;
                self.follow(planned, None)
            }
        }
    }

    /// Draws other smoke from now on.
    ///
    /// # Errors
    ///
    /// As [`Renderer::set_smoke`](crate::Renderer::set_smoke).
    pub fn set_smoke(&mut self, smoke: &Smoke) -> Result<(), RenderError> {
        self.frames.set_smoke(smoke)
    }

    /// What is drawn in another way than the style asks, for the user.
    pub fn notices(&self) -> &[String] {
        &self.frames.plan.styled().inked.notices
    }

    /// The model that is drawn.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Records a frame into an encoder of the host, and its drawing into views of the host, which are of the format
    /// given at first. What the views hold must be recorded before, or submitted.
    ///
    /// A pixel is as deep as the nearest surface in it; ink beside a surface is as deep as that surface. Drawn after
    /// the host's opaque things, edges are smooth against all of them. Uploads take effect before the commands of the
    /// next submission, so a renderer is recorded once a submission.
    ///
    /// # Errors
    ///
    /// [`RenderError::OtherView`] where camera and matrix do not show the scene in the same place, and
    /// [`RenderError::Engine`] where the device is lost; nothing is recorded then.
    pub fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        seen: &HostView,
        target: Target<'_>,
    ) -> Result<(), RenderError> {
        // Hand over how the host sees the scene.
        let size = self.frames.plan.options.size;
        let view = self
            .frames
            .aim(&self.model, &seen.camera, &FoundStrokes::default())?;
        check_view(&view, &seen.clip_from_world, self.model.bounds())?;
        self.frames.aim_tile(&view, [0; 2])?;
        let host_from_frame = host_from_frame(&view, &seen.clip_from_world);
        self.inlay
            .aim(&self.device, size, host_from_frame, self.format)?;

        // Record the passes, and the drawing of what they make.
        self.frames.session.record(encoder)?;
        self.inlay.record(encoder, target);
        Ok(())
    }

    /// Draws by another plan from now on, in the same memory where that has the same graph.
    fn follow(
        &mut self,
        (plan, picture): (FramePlan, [ResourceId; 2]),
        model: Option<Model>,
    ) -> Result<(), RenderError> {
        // Make what is new, before anything changes.
        if !self.frames.session.graph().is_same_as(plan.graph()) {
            let session = self.device.session(plan.graph().clone())?;
            self.inlay = Inlay::new(&self.device, &session, picture, self.format)?;
            self.frames.session = session;
        }

        // Go on with it.
        if let Some(model) = model {
            self.model = model;
        }
        Ok(self.frames.follow(plan, &self.model)?)
    }
}

/// Plans a frame with depths and without a background, checks that it fits and can be recorded, and gives the resources
/// of its picture and depths.
fn plan(
    model: &Model,
    style: &Style,
    options: &RendererOptions,
) -> Result<(FramePlan, [ResourceId; 2]), RenderError> {
    check_size(options.size)?;
    check_recorded(style)?;
    let options = &RendererOptions {
        layers: false,
        ..options.clone()
    };
    let (style, notice) = without_lines(style);
    let style = Style {
        background: Background::Transparent,
        ..style.into_owned()
    };
    let mut styled = StyledModel::new(model, &style, options, &[])?;
    styled.inked.notices.extend(notice);
    let (plan, picture) = FramePlan::with_depths(model, &style, options, styled);
    if plan.tiles().kept != options.size {
        let [width, height] = options.size;
        let what = format!("a frame of {width}x{height} pixels, which takes several tiles,");
        return Err(RenderError::NotRecorded { what });
    }
    plan.take_memory(&mut Budget::new(options.memory_limit), 0)?;
    Ok((plan, picture))
}

/// Refuses styles that need the processor between the passes of a frame or after them.
fn check_recorded(style: &Style) -> Result<(), RenderError> {
    let reasons = [
        (
            style.curve_sources().any(LineSource::is_of_pixels),
            "line.method 'potrace', which counts lines on the processor,",
        ),
        (
            !style.trails().is_empty(),
            "motion.trail, which goes over the finished picture,",
        ),
        (
            style.has_motion_lines(),
            "motion.follow or motion.ghosts, which go over the finished picture,",
        ),
        (
            style.blend.shows(),
            "blend, which mixes two finished pictures,",
        ),
        (
            !style.lettering.is_empty(),
            "lettering, which goes over the finished picture,",
        ),
    ];
    match reasons.into_iter().find(|(applies, _)| *applies) {
        Some((_, what)) => Err(RenderError::NotRecorded {
            what: what.to_owned(),
        }),
        None => Ok(()),
    }
}

/// Clip coordinates of the host from normalised device coordinates of the frame.
fn host_from_frame(view: &View, clip_from_world: &[[f32; 4]; 4]) -> [[f32; 4]; 4] {
    let frame = Mat4::from_cols_array_2d(&view.clip_from_world).as_dmat4();
    let host: DMat4 = Mat4::from_cols_array_2d(clip_from_world).as_dmat4();
    (host * frame.inverse()).as_mat4().to_cols_array_2d()
}

/// Fails where a matrix shows a corner of a box elsewhere than the view does; corners behind either eye are left out.
fn check_view(
    view: &View,
    clip_from_world: &[[f32; 4]; 4],
    bounds: Bounds,
) -> Result<(), RenderError> {
    let matrices = [&view.clip_from_world, clip_from_world].map(Mat4::from_cols_array_2d);
    let [width, height] = view.frame_px;
    let corners = box_corners(bounds).into_iter().map(Vec3::from);
    let apart = corners.filter_map(|corner| {
        let [a, b] = matrices.map(|matrix| matrix * corner.extend(1.0));
        if a.w <= view.near || b.w <= 0.0 {
            return None;
        }
        let apart = (a / a.w - b / b.w) * 0.5;
        Some((apart.x * width).abs().max((apart.y * height).abs()))
    });
    let px = apart.fold(0.0, f32::max);
    match px > AGREEMENT_PX {
        true => Err(RenderError::OtherView { px }),
        false => Ok(()),
    }
}
