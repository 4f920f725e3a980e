//! The visible strokes of a drawing as points that the pass `stroke.draw_strokes` inks into a frame.

use crate::clip::clip_stroke;
use npr_vector::stroke::{Drawing, Stroke, StrokePoint};
use npr_vector::stroke_ink::InkPoint;
use rayon::prelude::*;

/// Greatest half width of ink, in pixels: wider lines cover any frame.
const WIDEST: f64 = 1e5;

/// The visible strokes of a drawing, as [`draw`](npr_vector::stroke_ink::draw) takes them, cut to the picture.
///
/// `nearness` of a depth is 1 at the near plane and falls to 0 behind it. Strokes are worked on in parallel; the result
/// does not depend on the number of threads. O(points).
pub fn ink_points(drawing: &Drawing, nearness: &(dyn Fn(f64) -> f32 + Sync)) -> Vec<InkPoint> {
    let strokes = drawing.strokes.par_iter().with_min_len(64);
    let of_stroke = |stroke: &Stroke| {
        // Cut it to the picture.
        let half = |point: &StrokePoint| (0.5 * point.width).clamp(0.0, WIDEST);
        let widest = stroke.points.iter().map(half).fold(0.0, f64::max);
        let parts = match stroke.is_visible() && widest > 0.0 {
            true => clip_stroke(stroke, drawing.size.map(f64::from), widest + 1.0),
            false => Vec::new(),
        };

        // Give every point its width and colour; a closed one comes back to its first.
        let surface = drawing.surfaces.get(stroke.surface as usize);
        let own = surface.map_or([0, 0, 0, 255], |surface| surface.line_color);
        parts.into_iter().flat_map(move |(points, is_closed)| {
            let back = points.first().copied().filter(|_| is_closed);
            let count = points.len() + usize::from(back.is_some());
            let all = points.into_iter().chain(back).enumerate();
            all.map(move |(i, point)| InkPoint {
                px: point.position.map(|at| at as f32),
                // No number is no width.
                half_width: half(&point).max(0.0) as f32,
                nearness: nearness(point.depth),
                color: u32::from_le_bytes(point.color.unwrap_or(own)),
                goes_on: u32::from(i + 1 < count),
            })
        })
    };
    strokes.flat_map_iter(of_stroke).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_vector::stroke::StrokeSurface;
    use proptest::prelude::*;

    fn drawing(points: &[[f64; 3]], closed: bool) -> Drawing {
        let points = points.iter().map(|[x, y, width]| StrokePoint {
            position: [*x, *y],
            width: *width,
            depth: 2.0,
            ..StrokePoint::default()
        });
        let stroke = Stroke {
            id: 0,
            kind: npr_vector::stroke::Kind::Contour,
            occluders: 0,
            surface: 0,
            closed,
            points: points.collect(),
        };
        Drawing {
            size: [64, 48],
            surfaces: vec![StrokeSurface {
                line_color: [1, 2, 3, 255],
                ..StrokeSurface::default()
            }],
            strokes: vec![stroke],
            ..Drawing::default()
        }
    }

    fn inked(drawing: &Drawing) -> Vec<InkPoint> {
        ink_points(drawing, &|depth| 1.0 / depth as f32)
    }

    #[test]
    fn a_stroke_keeps_its_places_widths_and_colors() {
        let mut open = drawing(&[[1.0, 2.0, 3.0], [9.0, 8.0, 5.0]], false);
        open.strokes[0].points[1].color = Some([9, 8, 7, 6]);
        let ends = [
            InkPoint {
                px: [1.0, 2.0],
                half_width: 1.5,
                nearness: 0.5,
                color: 0xff03_0201,
                goes_on: 1,
            },
            InkPoint {
                px: [9.0, 8.0],
                half_width: 2.5,
                nearness: 0.5,
                color: 0x0607_0809,
                goes_on: 0,
            },
        ];
        assert_eq!(inked(&open), ends);
    }

    #[test]
    fn a_closed_stroke_comes_back() {
        let points = [[1.0, 2.0, 3.0], [9.0, 8.0, 5.0], [4.0, 30.0, 5.0]];
        let inked = inked(&drawing(&points, true));
        assert_eq!(inked.len(), 4);
        assert_eq!((inked[3].px, inked[3].goes_on), (inked[0].px, 0));
        assert!(inked[..3].iter().all(|point| point.goes_on == 1));
    }

    #[test]
    fn what_is_hidden_or_has_no_width_is_left_out() {
        let line = [[1.0, 2.0, 3.0], [9.0, 8.0, 5.0]];
        let mut hidden = drawing(&line, false);
        hidden.strokes[0].occluders = 1;
        assert!(inked(&hidden).is_empty());
        let thin = line.map(|[x, y, _]| [x, y, 0.0]);
        assert!(inked(&drawing(&thin, false)).is_empty());
    }

    proptest! {
        /// Whatever strokes hold, shaders get numbers near the picture.
        #[test]
        fn any_numbers_give_points_near_the_picture(
            points in prop::collection::vec([any::<f64>(), any::<f64>(), any::<f64>()], 0..12), closed: bool,
        ) {
            for point in inked(&drawing(&points, closed)) {
                prop_assert!(point.px.iter().all(|at| at.abs() < 2.1e5), "{:?}", point);
                prop_assert!((0.0..=1e5).contains(&point.half_width), "{:?}", point);
            }
        }
    }
}
