//! What a camera sees of a line model, before visibility.

use super::colors::StrokeColors;
use super::recent::{RecentViews, ViewKey};
use super::texture_map::TextureMap;
use crate::error::RenderError;
use crate::placement::Bounds;
use npr_core::camera::Camera;
use npr_core::interrupt::Interrupt;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_vector::mesh_lines::JointsInView;
use npr_vector::mesh_lines::contour::EdgeContours;
use npr_vector::mesh_lines::draw::{
    LineSettings, Prepared, StrokeLook, ViewStrokes, runs_with, spines,
};
use npr_vector::mesh_lines::puff::SmokeLines;
use npr_vector::project::Projector;
use std::sync::Arc;

/// A camera, and what it sees before visibility.
pub(super) struct LineView<'a> {
    pub shape: &'a HalfEdgeMesh,
    /// Where textures lie, for lines that take their colour from there.
    pub map: Option<&'a TextureMap>,
    /// Most bytes that a drawing may take.
    pub memory_limit: u64,
    pub camera: &'a Camera,
    pub projector: &'a Projector,
    pub contours: &'a EdgeContours,
    pub bounds: Bounds,
    pub smoke: Option<&'a SmokeLines<'a>>,
    /// Colours of strokes along themselves, where the style has any.
    pub colors: Option<&'a StrokeColors<'a>>,
    /// Whether colours vary along strokes because they follow a backdrop.
    pub changes: bool,
    /// Whether it is left open what is seen of lines.
    pub is_open: bool,
    /// Ends the work where it is raised.
    pub interrupt: &'a Interrupt,
    /// The lines of views before.
    pub recent: &'a RecentViews,
}

impl LineView<'_> {
    /// The strokes of lines on the mesh, and of smoke; joints hold to those of the frame before, if there is one.
    pub fn of_mesh(
        &self,
        prepared: &Arc<Prepared>,
        settings: &LineSettings,
        look: &StrokeLook<'_>,
        held: Option<JointsInView<'_>>,
    ) -> Result<ViewStrokes, RenderError> {
        if self.is_open {
            let (shape, contours) = (self.shape, self.contours);
            let found = spines(shape, prepared, self.projector, settings, contours, look);
            return Ok(found?);
        }
        let find = |held: Option<JointsInView<'_>>| {
            runs_with(
                self.shape,
                prepared,
                self.projector,
                settings,
                self.contours,
                (self.smoke, held),
                self.interrupt,
            )
        };

        // What smoke hides, and what holds to the frame before, is found anew every time.
        let found = if self.smoke.is_some() || held.is_some() {
            find(held)?
        } else {
            let key = ViewKey {
                projector: *self.projector,
                settings: settings.clone(),
                prepared: Arc::clone(prepared),
            };
            self.recent.runs(key, || find(None))?
        };
        Ok(found.strokes(self.shape, self.projector, look))
    }
}

/// Notices of lines that a drawing leaves out because nobody could read them, a sentence each.
pub(super) fn notices_of_view(prepared: Option<&Prepared>, left_out: usize) -> Vec<String> {
    let mut notices = Vec::new();
    if prepared.is_some_and(|prepared| prepared.crossings.overflow) {
        let text = "so many faces cut each other that lines of intersection are left out";
        notices.push(text.to_owned());
    }
    if left_out > 0 {
        notices.push(format!(
            "lines lie closer than ink can show: {left_out} pieces of them are left out"
        ));
    }
    notices
}
