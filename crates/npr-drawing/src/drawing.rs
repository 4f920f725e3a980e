//! Drawings as pictures: the shapes that files hold, rasterised with antialiased edges.

use crate::artwork::{
    Artwork, ArtworkOptions, DASH, Mark, Paint, REGION_SEAM_PX, StampImage, arrange,
};
use kurbo::PathEl;
use npr_vector::stroke::Drawing;
use tiny_skia::{
    Color, ColorU8, FillRule, FilterQuality, LineCap, LineJoin, Path, PathBuilder, Pixmap,
    PixmapPaint, PremultipliedColorU8, StrokeDash, Transform,
};

/// The drawing as pixels: rows from the top, sRGB bytes with straight alpha.
///
/// The picture has the drawing's size; a page in the options is ignored. Without a background, pixels are empty where
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

    // Paint marks from the lowest to the topmost.
    let marks = artwork
        .layers
        .iter()
        .flat_map(|layer| &layer.groups)
        .flat_map(|group| &group.marks);
    let images: Vec<Option<Pixmap>> = artwork.images.iter().map(pixels_of_image).collect();
    for mark in marks {
        match mark.paint {
            Paint::Image(number) => {
                let image = images.get(number as usize);
                paint_image(mark, image.and_then(Option::as_ref), &mut pixels);
            }
            _ => paint_mark(mark, &mut pixels, Transform::identity()),
        }
    }

    // Divide colours by their alpha again.
    pixels
        .pixels()
        .iter()
        .flat_map(|pixel| {
            let color = pixel.demultiply();
            [color.red(), color.green(), color.blue(), color.alpha()]
        })
        .collect()
}

/// Paints marks over a picture of `size` pixels: rows from the top, sRGB bytes with straight alpha.
///
/// Edges are blended in sRGB, as in [`rasterise`] and in viewers of SVG. Pixels that no mark reaches keep their bytes.
/// O(pixels of the marks' box) time and memory. Nothing is done where `rgba` is shorter than the picture.
pub fn paint_over(marks: &[Mark], rgba: &mut [u8], size: [u32; 2]) {
    let width = size[0] as usize;
    if width
        .checked_mul(size[1] as usize)
        .is_none_or(|count| rgba.len() / 4 < count)
    {
        return;
    }

    // Paint the marks on a sheet of their own, as small as can be.
    let Some((corner, extent)) = pixels_of(marks, size) else {
        return;
    };
    let Some(mut pixels) = Pixmap::new(extent[0], extent[1]) else {
        return;
    };
    let place = Transform::from_translate(-(corner[0] as f32), -(corner[1] as f32));
    for mark in marks {
        paint_mark(mark, &mut pixels, place);
    }

    // Lay the sheet over the picture.
    for (row, line) in pixels.pixels().chunks(extent[0] as usize).enumerate() {
        let start = (corner[1] as usize + row) * width + corner[0] as usize;
        let under = rgba[4 * start..].chunks_exact_mut(4);
        for (under, over) in under.zip(line) {
            blend(under, *over);
        }
    }
}

/// The box of pixels that marks reach in a picture, as its upper left corner and its size.
fn pixels_of(marks: &[Mark], size: [u32; 2]) -> Option<([u32; 2], [u32; 2])> {
    // Enclose the marks with the width of their lines.
    let boxes = marks
        .iter()
        .filter(|mark| !mark.path.is_empty())
        .map(|mark| {
            let half = match mark.paint {
                Paint::Ink | Paint::Image(_) => 0.0,
                Paint::Region => REGION_SEAM_PX,
                Paint::Line(width) | Paint::Dashes(width) => 0.5 * width,
            };
            mark.path.control_box().inflate(half + 1.0, half + 1.0)
        });
    let reach = boxes.reduce(|a, b| a.union(b))?;

    // Cut that to whole pixels of the picture.
    let bound = |low: f64, high: f64, side: u32| {
        let [low, high] = [low.floor(), high.ceil()].map(|v| v.clamp(0.0, f64::from(side)) as u32);
        (low < high).then_some((low, high - low))
    };
    let (x, width) = bound(reach.x0, reach.x1, size[0])?;
    let (y, height) = bound(reach.y0, reach.y1, size[1])?;
    Some(([x, y], [width, height]))
}

/// Lays a pixel over one with straight alpha.
fn blend(under: &mut [u8], over: PremultipliedColorU8) {
    match over.alpha() {
        0 => return,
        255 => return under.copy_from_slice(&[over.red(), over.green(), over.blue(), 255]),
        _ => {}
    }
    let rest = f32::from(under[3]) / 255.0 * (1.0 - f32::from(over.alpha()) / 255.0);
    let alpha = f32::from(over.alpha()) / 255.0 + rest;
    for (under, over) in under
        .iter_mut()
        .zip([over.red(), over.green(), over.blue()])
    {
        *under = ((f32::from(over) + f32::from(*under) * rest) / alpha)
            .round()
            .min(255.0) as u8;
    }
    under[3] = (alpha * 255.0).round() as u8;
}

fn color_of([r, g, b, a]: [u8; 4]) -> Color {
    Color::from_rgba8(r, g, b, a)
}

fn paint_mark(mark: &Mark, pixels: &mut Pixmap, place: Transform) {
    let Some(path) = path_of(mark) else {
        return;
    };

    // Fill what has an inside.
    let mut paint = tiny_skia::Paint {
        anti_alias: true,
        ..tiny_skia::Paint::default()
    };
    paint.set_color(color_of(mark.color));
    let mut fill = |rule| pixels.fill_path(&path, &paint, rule, place, None);
    let width = match mark.paint {
        Paint::Ink => return fill(FillRule::Winding),
        // Artwork alone has images.
        Paint::Image(_) => return,
        Paint::Region => {
            fill(FillRule::EvenOdd);
            if mark.color[3] < 255 {
                return;
            }
            REGION_SEAM_PX
        }
        Paint::Line(width) | Paint::Dashes(width) => width,
    };

    // Draw lines, and the seam around regions.
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
    pixels.stroke_path(&path, &paint, &stroke, place, None);
}

/// The image of a brush as pixels; `None` where it has none.
fn pixels_of_image(image: &StampImage) -> Option<Pixmap> {
    let mut pixels = Pixmap::new(image.size[0], image.size[1])?;
    let [r, g, b] = image.color;
    for (pixel, alpha) in pixels.pixels_mut().iter_mut().zip(&image.alpha) {
        *pixel = ColorU8::from_rgba(r, g, b, *alpha).premultiply();
    }
    Some(pixels)
}

/// Lays an image where a mark lies.
fn paint_image(mark: &Mark, image: Option<&Pixmap>, pixels: &mut Pixmap) {
    let (Some(image), Some(place)) = (image, mark.image_place()) else {
        return;
    };
    let [a, b, c, d, e, f] = place.as_coeffs().map(|v| v as f32);
    let [width, height] = [image.width(), image.height()].map(|side| side as f32);
    let place = Transform::from_row(a / width, b / width, c / height, d / height, e, f);
    let paint = PixmapPaint {
        opacity: f32::from(mark.color[3]) / 255.0,
        quality: FilterQuality::Bilinear,
        ..PixmapPaint::default()
    };
    pixels.draw_pixmap(0, 0, image.as_ref(), &paint, place, None);
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

#[cfg(test)]
mod tests {
    use super::*;
    use kurbo::{BezPath, Rect, Shape};

    fn square(side: Rect, color: [u8; 4], paint: Paint) -> Mark {
        let path: BezPath = side.to_path(0.1);
        Mark {
            stroke: None,
            path,
            paint,
            color,
        }
    }

    #[test]
    fn painting_over_leaves_all_else() {
        let size = [8, 6];
        let before: Vec<u8> = (0..8 * 6 * 4).map(|i| (i * 7 % 251) as u8).collect();
        let mut after = before.clone();
        let mark = square(Rect::new(2.0, 1.0, 5.0, 9.0), [10, 20, 30, 255], Paint::Ink);
        paint_over(&[mark], &mut after, size);
        for (i, (now, then)) in after.chunks(4).zip(before.chunks(4)).enumerate() {
            let (x, y) = (i % 8, i / 8);
            let inside = (2..5).contains(&x) && y >= 1;
            let expected = if inside { &[10, 20, 30, 255] } else { then };
            assert_eq!(now, expected, "{x} {y}");
        }
    }

    #[test]
    fn half_covered_pixels_blend_by_straight_alpha() {
        let half = || square(Rect::new(0.0, 0.0, 1.0, 1.0), [200, 0, 0, 128], Paint::Ink);
        let mut pixel = [0, 0, 100, 255];
        paint_over(&[half()], &mut pixel, [1, 1]);
        assert!(
            pixel[0].abs_diff(100) <= 1 && pixel[2].abs_diff(50) <= 1 && pixel[3] == 255,
            "{pixel:?}"
        );
        let mut empty = [0; 4];
        paint_over(&[half()], &mut empty, [1, 1]);
        assert!(empty[0].abs_diff(200) <= 1 && empty[3] == 128, "{empty:?}");
    }

    #[test]
    fn marks_far_away_or_without_room_change_nothing() {
        let mut pixels = [7; 16];
        let far = square(Rect::new(1e12, 0.0, 2e12, 1.0), [0, 0, 0, 255], Paint::Ink);
        paint_over(std::slice::from_ref(&far), &mut pixels, [2, 2]);
        paint_over(&[], &mut pixels, [2, 2]);
        paint_over(
            &[square(
                Rect::new(0.0, 0.0, 2.0, 2.0),
                [0, 0, 0, 255],
                Paint::Ink,
            )],
            &mut pixels,
            [3, 2],
        );
        paint_over(&[far], &mut [], [0, 5]);
        assert_eq!(pixels, [7; 16]);
    }
}
