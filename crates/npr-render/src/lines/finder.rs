//! What finds the lines of a view, before they become strokes.

use crate::error::RenderError;
use npr_gpu::curves::{Hiders, ResidentPixels, ResidentShape};
use npr_gpu::engine::{Engine, PassTime};
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_vector::mesh_lines::contour::{EdgeContours, Eye};
use npr_vector::pixel_strokes::stroke::Loops;
use npr_vector::pixel_strokes::{PixelScene, PublishedPath, Traced, scene_depths, trace};

/// Finds the lines of a shape, the same one in every view, in whatever pose. `meanwhile` is what the processor can do
/// while a device finds them, and is called once; where there is no device it is left to whoever needs it.
pub(crate) trait Finder {
    /// Contours along mesh edges.
    fn contours(
        &mut self,
        shape: &HalfEdgeMesh,
        eye: &Eye,
        meanwhile: &dyn Fn(),
    ) -> Result<EdgeContours, RenderError>;

    /// All lines, found on a picture of them. `occluder_depths` are the reversed depths of what stands before the
    /// shape's own surfaces, where there is any.
    fn pixels(
        &mut self,
        on: &PixelScene<'_>,
        path: &PublishedPath,
        occluder_depths: Option<&[f32]>,
        meanwhile: &dyn Fn(),
    ) -> Result<(Traced, Loops), RenderError>;

    /// Finds lines of another pose of the shape from the next view on.
    fn follow(&mut self) {}

    /// Forgets the times of the last view.
    fn start_view(&mut self) {}

    /// How long passes took since the view was started; none where no passes run.
    fn times(&self) -> &[PassTime] {
        &[]
    }
}

/// Finds lines by the plain functions, on the processor.
pub(crate) struct OnProcessor;

impl Finder for OnProcessor {
    fn contours(
        &mut self,
        shape: &HalfEdgeMesh,
        eye: &Eye,
        _: &dyn Fn(),
    ) -> Result<EdgeContours, RenderError> {
        Ok(EdgeContours::new(shape, eye))
    }

    fn pixels(
        &mut self,
        on: &PixelScene<'_>,
        path: &PublishedPath,
        occluder_depths: Option<&[f32]>,
        _: &dyn Fn(),
    ) -> Result<(Traced, Loops), RenderError> {
        let mut depths = scene_depths(on.shape, on.view);
        for (depth, occluder_depths) in depths.iter_mut().zip(occluder_depths.unwrap_or_default()) {
            *depth = depth.max(*occluder_depths);
        }
        let traced = trace(on, path, &depths)?;
        let loops = Loops::new(&traced, path);
        Ok((traced, loops))
    }
}

/// Finds lines by passes on a device, which keeps the shape from view to view.
pub(crate) struct OnDevice<'a> {
    engine: &'a dyn Engine,
    /// The shape in the pose that it was given in.
    shape: &'a HalfEdgeMesh,
    /// Whether contours, and pixels, are still to be told of another pose.
    is_behind: [bool; 2],
    contours: Option<ResidentShape<'a>>,
    pixels: Option<ResidentPixels<'a>>,
    times: Vec<PassTime>,
}

impl<'a> OnDevice<'a> {
    /// Hands nothing to the device before something is drawn.
    pub(crate) fn new(engine: &'a dyn Engine, shape: &'a HalfEdgeMesh) -> Self {
        Self {
            engine,
            shape,
            is_behind: [false; 2],
            contours: None,
            pixels: None,
            times: Vec::new(),
        }
    }
}

impl Finder for OnDevice<'_> {
    fn contours(
        &mut self,
        shape: &HalfEdgeMesh,
        eye: &Eye,
        meanwhile: &dyn Fn(),
    ) -> Result<EdgeContours, RenderError> {
        // A scene without surfaces, smoke alone, asks nothing of the device.
        if shape.faces.is_empty() {
            return OnProcessor.contours(shape, eye, meanwhile);
        }
        let resident = match self.contours.take() {
            Some(resident) => resident,
            None => ResidentShape::new(self.engine, self.shape)?,
        };
        let resident = self.contours.insert(resident);
        if std::mem::take(&mut self.is_behind[0]) {
            resident.set_pose(shape)?;
        }
        let found = resident.contours_while(eye, meanwhile)?;
        self.times.extend_from_slice(resident.times());
        Ok(found)
    }

    fn pixels(
        &mut self,
        on: &PixelScene<'_>,
        path: &PublishedPath,
        occluder_depths: Option<&[f32]>,
        meanwhile: &dyn Fn(),
    ) -> Result<(Traced, Loops), RenderError> {
        let make = || ResidentPixels::new(self.engine, self.shape);
        let resident = self.pixels.get_or_insert_with(make);
        if std::mem::take(&mut self.is_behind[1]) {
            resident.set_pose(on.shape)?;
        }
        let hiders = occluder_depths.map_or(Hiders::Surfaces, Hiders::Veiled);
        let found = resident.draw_while(on, path, hiders, meanwhile)?;
        self.times.extend_from_slice(resident.times());
        Ok(found)
    }

    fn follow(&mut self) {
        self.is_behind = [true; 2];
    }

    fn start_view(&mut self) {
        self.times.clear();
    }

    fn times(&self) -> &[PassTime] {
        &self.times
    }
}
