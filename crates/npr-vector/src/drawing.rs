//! Drawings as pictures: the shapes that files hold, rasterised with antialiased edges.

use crate::artwork::{Artwork, ArtworkOptions, DASH, Mark, Paint, REGION_SEAM_PX, arrange};
use crate::stroke::Drawing;
use kurbo::PathEl;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Path, PathBuilder, Pixmap, StrokeDash, Transform,
};

/// The drawing as pixels: rows from the top, sRGB bytes with straight alpha.
///
/// The picture has the drawing's size: a page in the options is left aside. Pixels are empty, without a background, where
/// nothing is drawn; there are none if a side is 0 or the picture is too large for memory to be counted.
pub fn rasterise(drawing: &Drawing, options: &ArtworkOptions) -> Vec<u8> {
    let options = ArtworkOptions {
        page: None,
        ..options.clone()
    };
    paint(&arrange(drawing, &options), drawing.size)
}

fn paint(artwork: &Artwork, size: [u32; 2]) -> Vec<u8> {
    let Some(mut pixels) = Pixmap::new(size[0], size[1]) else {
        return Vec::new();
    };
    if let Some(color) = artwork.background {
        pixels.fill(color_of(color));
    }
    let marks = artwork
        .layers
        .iter()
        .flat_map(|layer| &layer.groups)
        .flat_map(|group| &group.marks);
    for mark in marks {
        paint_mark(mark, &mut pixels);
    }
    pixels
        .pixels()
        .iter()
        .flat_map(|pixel| {
            let color = pixel.demultiply();
            [color.red(), color.green(), color.blue(), color.alpha()]
        })
        .collect()
}

fn color_of([r, g, b, a]: [u8; 4]) -> Color {
    Color::from_rgba8(r, g, b, a)
}

fn paint_mark(mark: &Mark, pixels: &mut Pixmap) {
    let Some(path) = path_of(mark) else {
        return;
    };
    let mut paint = tiny_skia::Paint {
        anti_alias: true,
        ..tiny_skia::Paint::default()
    };
    paint.set_color(color_of(mark.color));
    let mut fill = |rule| pixels.fill_path(&path, &paint, rule, Transform::identity(), None);
    let width = match mark.paint {
        Paint::Ink => return fill(FillRule::Winding),
        Paint::Region => {
            fill(FillRule::EvenOdd);
            if mark.color[3] < 255 {
                return;
            }
            REGION_SEAM_PX
        }
        Paint::Line(width) | Paint::Dashes(width) => width,
    };
    let dash = matches!(mark.paint, Paint::Dashes(_))
        .then(|| StrokeDash::new(DASH.map(|share| (share * width) as f32).to_vec(), 0.0))
        .flatten();
    let stroke = tiny_skia::Stroke {
        width: width as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        dash,
        ..tiny_skia::Stroke::default()
    };
    pixels.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
}

fn path_of(mark: &Mark) -> Option<Path> {
    let mut builder = PathBuilder::new();
    let [x, y] = [|p: &kurbo::Point| p.x as f32, |p: &kurbo::Point| p.y as f32];
    for element in mark.path.elements() {
        match element {
            PathEl::MoveTo(p) => builder.move_to(x(p), y(p)),
            PathEl::LineTo(p) => builder.line_to(x(p), y(p)),
            PathEl::QuadTo(a, p) => builder.quad_to(x(a), y(a), x(p), y(p)),
            PathEl::CurveTo(a, b, p) => builder.cubic_to(x(a), y(a), x(b), y(b), x(p), y(p)),
            PathEl::ClosePath => builder.close(),
        }
    }
    builder.finish()
}
