//! Lines as curves over a finished frame: those of parts whose method is `curves` or `potrace`.

use super::background_contrast::Sides;
use crate::error::RenderError;
use crate::frame::Frame;
use crate::lines::{LineOptions, LineRenderer};
use crate::options::RendererOptions;
use crate::smoke::Smoke;
use npr_core::camera::Camera;
use npr_drawing::artwork::ArtworkOptions;
use npr_drawing::drawing::paint_drawing_over;
use npr_style::backdrop::Rules;
use npr_stylesheet::Style;

/// Draws lines as curves over a frame that shows what a camera sees of a model and of smoke; without a line model the
/// frame gets a notice instead.
///
/// `contrasted` holds what lies on both sides of outlines, where the colours of lines follow it.
pub(crate) fn finish(
    lines: Option<&mut LineRenderer<'_>>,
    (camera, smoke): (&Camera, Option<&Smoke>),
    (style, options): (&Style, &RendererOptions),
    contrasted: Option<&(Sides, Rules)>,
    frame: &mut Frame,
) -> Result<(), RenderError> {
    if !style.has_curves() {
        return Ok(());
    }
    let Some(lines) = lines else {
        let notice = "lines as curves are left out: no line model was given";
        frame.notices.push(notice.to_owned());
        return Ok(());
    };
    let of_style = LineOptions {
        dpi: options.dpi,
        ..LineOptions::of_style(style, frame.size)
    };
    let beside = (smoke, &options.pictures);
    for method in style.curve_sources() {
        // Find the strokes of the parts that have this method.
        let of_method = LineOptions { method, ..of_style };
        let drawing = lines.draw_curves(camera, style, &of_method, beside)?;
        frame.times.extend_from_slice(lines.times());
        frame.notices.extend_from_slice(&drawing.notices);

        // Ink them, in colours that stand out from what lies behind where the style asks for it.
        let artwork = ArtworkOptions::default();
        let Some((sides, rules)) = contrasted else {
            paint_drawing_over(&drawing, &artwork, &mut frame.rgba);
            continue;
        };
        let mut ink = vec![0; frame.rgba.len()];
        paint_drawing_over(&drawing, &artwork, &mut ink);
        sides.lay(&ink, rules, &mut frame.rgba);
    }
    Ok(())
}
