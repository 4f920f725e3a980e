//! A scene prepared for frames in a style.

use crate::error::RenderError;
use crate::lines::{LineModel, LineModelOptions, LineRenderer};
use crate::model::Model;
use crate::options::RendererOptions;
use crate::renderer::Renderer;
use npr_core::line_source::LineSource;
use npr_gpu::engine::Engine;
use npr_scene::Scene;
use npr_stylesheet::Style;
use std::path::Path;

/// A scene prepared for frames: its surfaces, and its lines where a style draws strokes.
///
/// ```
/// # use npr_gpu::processor::Processor;
/// # use npr_render::{RendererOptions, Subject};
/// # let (scene, style) = (npr_scene::Scene::default(), npr_stylesheet::Style::default());
/// let subject = Subject::new(&scene, &style)?;
/// let mut renderer = subject.renderer(&Processor, &style, &RendererOptions::new([64, 36]))?;
/// let frame = renderer.draw(&subject.model.framing(16.0 / 9.0, 0.7))?;
/// # assert!(frame.notices.is_empty());
/// # Ok::<(), npr_render::RenderError>(())
/// ```
#[derive(Debug)]
pub struct Subject {
    /// Its surfaces.
    pub model: Model,
    /// Its lines, which strokes are made of.
    pub lines: Option<LineModel>,
}

impl Subject {
    /// Prepares a scene for a style.
    ///
    /// # Errors
    ///
    /// As [`Model::new`] and [`LineModel::for_style`].
    pub fn new(scene: &Scene, style: &Style) -> Result<Self, RenderError> {
        let model = Model::new(scene)?;
        let lines = Self::lines(scene, style, &LineModelOptions::default(), None)?;
        Ok(Self { model, lines })
    }

    /// The lines of a scene, where a style draws strokes; `folder` is that of [`LineModel::for_style`].
    ///
    /// There are none where the memory limit is too low for them, and frames draw them by `shape` then. For a style
    /// with lines of method `potrace`, which nothing stands in for, that is an error.
    ///
    /// # Errors
    ///
    /// As [`LineModel::for_style`].
    pub fn lines(
        scene: &Scene,
        style: &Style,
        options: &LineModelOptions,
        folder: Option<&Path>,
    ) -> Result<Option<LineModel>, RenderError> {
        if !style.has_curves() {
            return Ok(None);
        }
        match LineModel::for_style(scene, style, options, folder) {
            Err(RenderError::Memory(_)) if !style.curve_sources().any(LineSource::is_of_pixels) => {
                Ok(None)
            }
            lines => lines.map(Some),
        }
    }

    /// Whether a subject that was prepared for the style `of` is the one that another style would get, of a scene that
    /// neither cuts up ([`apply_id_maps`](crate::apply_id_maps)).
    pub fn serves(&self, of: &Style, other: &Style) -> bool {
        of.has_curves() == other.has_curves()
            && (!other.has_curves() || LineModel::is_alike_for(&self.model.parts, of, other))
    }

    /// Moves surfaces and lines into the pose of a scene: the one that they were made of.
    ///
    /// # Errors
    ///
    /// As [`Model::set_pose`] and [`LineModel::set_pose`].
    pub fn set_pose(&mut self, scene: &Scene) -> Result<(), RenderError> {
        self.model.set_pose(scene)?;
        match &mut self.lines {
            Some(lines) => lines.set_pose(scene),
            None => Ok(()),
        }
    }

    /// A renderer of the scene, in a style and on an engine, which also finds its lines.
    ///
    /// # Errors
    ///
    /// As [`Renderer::new`].
    pub fn renderer<'a>(
        &'a self,
        engine: &'a dyn Engine,
        style: &Style,
        options: &RendererOptions,
    ) -> Result<Renderer<'a>, RenderError> {
        let Some(lines) = &self.lines else {
            return Renderer::new(engine, &self.model, style, options);
        };
        let of_scene = (&self.model, LineRenderer::new(engine, lines));
        Renderer::with_lines(engine, of_scene, style, options)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_stylesheet::Stated;

    #[test]
    fn a_subject_serves_styles_that_need_no_other_lines() {
        let style = |overrides: &[&str]| {
            let mut stated = Stated::preset("toon").expect("a preset");
            let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
            stated.set_all(&overrides).expect("they fit");
            stated.into_style()
        };
        let toon = style(&[]);
        let subject = Subject::new(&Scene::default(), &toon).expect("nothing");
        for (change, serves) in [
            ("line.width.base=5", true),
            ("shade.saturation=0.2", true),
            ("line.paint.source=surface", false),
            ("line.method=shape", false),
        ] {
            assert_eq!(subject.serves(&toon, &style(&[change])), serves, "{change}");
        }
    }
}
