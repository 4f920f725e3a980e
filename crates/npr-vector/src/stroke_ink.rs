//! Ink of strokes in the pixels of a frame: the twin of `stroke.draw_strokes`.

use crate::brush::{BrushedPiece, Brushes};
use crate::ink_point::InkPoint;
use crate::screen::sweep::{Ribbon, draw_bands, line_key};
use npr_core::color::{pack_rgba8, unpack_rgba8};
use npr_core::window::Window;
use rayon::prelude::*;

/// A piece of a stroke between two points.
struct Piece {
    ribbon: Ribbon,
    brushed: BrushedPiece,
}

impl AsRef<Ribbon> for Piece {
    fn as_ref(&self) -> &Ribbon {
        &self.ribbon
    }
}

/// Draws strokes as discs swept from each point to the next, as sRGB bytes with coverage in alpha.
///
/// Joins and ends are round, without a notch at any width and bend; where a stroke is thinner than a pixel it is
/// fainter. Between points, width and colour change evenly. `keys` (reversed depth bits) keep the best [`line_key`] of
/// each pixel; of equal ones the first piece wins. A brush with an image leaves ink out: then the pieces of a stroke
/// share its pixels by the nearest, so that the image runs along the stroke without seams. O(points + covered pixels),
/// parallel over bands of rows, each in the order of the points.
pub fn draw(
    window: &Window,
    (points, brushes): (&[InkPoint], Brushes<'_>),
    layer: &mut [u32],
    keys: &mut [u32],
) {
    let starts = (0..points.len().saturating_sub(1)).into_par_iter();
    let starts = starts.with_min_len(4096);
    let pieces: Vec<Piece> = starts
        .filter(|start| points[*start].goes_on())
        .map(|start| Piece::new(points, start))
        .collect();
    let ink = |piece: &Piece, px: [f32; 2], texel: &mut u32, best: &mut u32| {
        piece.ink(brushes, px, texel, best);
    };
    draw_bands(&pieces, window, layer, keys, &ink);
}

impl Piece {
    fn new(points: &[InkPoint], start: usize) -> Self {
        let brushed = BrushedPiece::new(points, start);
        let [a, b] = brushed.ends;
        Self {
            ribbon: Ribbon {
                a: a.px,
                b: b.px,
                half_a: a.half_width,
                half_b: b.half_width,
            },
            brushed,
        }
    }

    /// Inks one pixel where the piece covers it better than the line that is there.
    fn ink(&self, brushes: Brushes<'_>, px: [f32; 2], texel: &mut u32, best: &mut u32) {
        let [a, b] = self.brushed.ends;
        let (mut coverage, t) = self.ribbon.swept(px);
        if coverage * 255.0 < 0.5 {
            return;
        }
        let nearness = a.nearness + (b.nearness - a.nearness) * t;
        let mut key = line_key(coverage, nearness).to_bits();
        if key <= *best {
            return;
        }

        // What the brush leaves out can only make it less.
        if let Some(brush) = brushes.of(a.flags >> InkPoint::BRUSH_SHIFT) {
            coverage *= brushes.ink(brush, &self.brushed, px);
            key = line_key(coverage, nearness).to_bits();
            if coverage * 255.0 < 0.5 || key <= *best {
                return;
            }
        }
        let [from, to] = [a, b].map(|end| unpack_rgba8(end.color));
        let [red, green, blue, alpha] = [0, 1, 2, 3].map(|i| from[i] + (to[i] - from[i]) * t);
        *texel = pack_rgba8([red, green, blue, alpha * coverage]);
        *best = key;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::math;
    use proptest::prelude::*;

    const SIDE: u32 = 48;

    fn window() -> Window {
        let side = SIDE as f32;
        Window::over([side; 2], [0.0; 2], [side; 2], [SIDE; 2])
    }

    fn drawn(points: &[InkPoint]) -> Vec<[f32; 4]> {
        let [mut layer, mut keys] = [0, 1].map(|_| vec![0; (SIDE * SIDE) as usize]);
        draw(&window(), (points, Brushes::SOLID), &mut layer, &mut keys);
        layer.into_iter().map(unpack_rgba8).collect()
    }

    /// A stroke of black ink through places with half widths.
    fn stroke(places: &[[f32; 3]]) -> Vec<InkPoint> {
        let last = places.len() - 1;
        let points = places.iter().enumerate();
        points
            .map(|(i, [x, y, half_width])| InkPoint {
                px: [*x, *y],
                half_width: *half_width,
                nearness: 0.5,
                color: 0xff00_0000,
                flags: u32::from(i < last) * (InkPoint::GOES_ON | InkPoint::JOINED),
                u: 0.0,
                pressure: 1.0,
            })
            .collect()
    }

    fn place() -> impl Strategy<Value = [f32; 3]> {
        (4f32..44.0, 4f32..44.0, 0f32..6.0).prop_map(|(x, y, half)| [x, y, half])
    }

    proptest! {
        /// Drawing pixel by pixel and piece by piece, without bands and boxes, gives the same.
        #[test]
        fn no_pixel_is_missed(places in prop::collection::vec(place(), 2..9)) {
            let points = stroke(&places);
            let drawn = drawn(&points);
            for (slot, texel) in drawn.iter().enumerate() {
                let (column, row) = (slot as u32 % SIDE, slot as u32 / SIDE);
                let px = window().frame_at(column, row);
                let pieces = (0..points.len() - 1).map(|start| Piece::new(&points, start));
                let most = pieces.map(|piece| piece.ribbon.swept(px).0).fold(0.0, f32::max);
                prop_assert!((texel[3] - most).abs() < 1.5 / 255.0, "{:?}: {:?} {}", px, texel, most);
            }
        }

        /// A stroke drawn backwards is the same stroke.
        #[test]
        fn direction_does_not_matter(places in prop::collection::vec(place(), 2..9)) {
            let there = drawn(&stroke(&places));
            let back = drawn(&stroke(&places.iter().rev().copied().collect::<Vec<_>>()));
            let differ = there.iter().zip(&back).filter(|(a, b)| (a[3] - b[3]).abs() > 1.5 / 255.0);
            prop_assert_eq!(differ.count(), 0);
        }

        /// Of two strokes that cross, the nearer shows, whichever is drawn first.
        #[test]
        fn the_nearer_stroke_shows(order: bool, angle in 0f32..3.1) {
            let [x, y] = [math::cos(angle), math::sin(angle)];
            let line = |near: f32, color: u32, [x, y]: [f32; 2]| {
                let ends = [-1.0, 1.0].map(|way| [24.0 + 14.0 * x * way, 24.0 + 14.0 * y * way, 3.0]);
                let points = stroke(&ends).into_iter();
                points.map(move |point| InkPoint { nearness: near, color, ..point })
            };
            let near: Vec<_> = line(0.8, 0xff00_00ff, [x, y]).collect();
            let far: Vec<_> = line(0.2, 0xffff_0000, [-y, x]).collect();
            let both = if order { [near, far] } else { [far, near] }.concat();
            let middle = drawn(&both)[(24 * SIDE + 24) as usize];
            prop_assert_eq!(middle, [1.0, 0.0, 0.0, 1.0]);
        }
    }

    #[test]
    fn a_hairline_is_faint_and_whole() {
        for half in [0.02, 0.05, 0.15, 0.3] {
            let drawn = drawn(&stroke(&[[5.0, 9.0, half], [43.0, 31.0, half]]));
            let columns = 8..40;
            for column in columns {
                let sum: f32 = (0..SIDE)
                    .map(|row| drawn[(row * SIDE + column) as usize][3])
                    .sum();
                // A column cuts the line askew: by the inverse cosine of its slope, longer than it is wide.
                let want = 2.0 * half * (1.0 + (22.0f32 / 38.0).powi(2)).sqrt();
                // Each of the pixels of a column is rounded to a byte.
                assert!(
                    (sum - want).abs() < 0.02 * want + 1.5 / 255.0,
                    "{half} {column}: {sum} for {want}"
                );
            }
        }
    }

    #[test]
    fn strokes_end_where_they_end() {
        let mut points = stroke(&[
            [10.0, 10.0, 2.0],
            [20.0, 10.0, 2.0],
            [30.0, 40.0, 2.0],
            [40.0, 40.0, 2.0],
        ]);
        points[1].flags = 0;
        let drawn = drawn(&points);
        let at = |x: u32, y: u32| drawn[(y * SIDE + x) as usize][3];
        assert_eq!([at(15, 10), at(35, 40)], [1.0; 2]);
        assert_eq!(at(25, 25), 0.0, "nothing joins them");
    }

    #[test]
    fn no_points_and_one_point_draw_nothing() {
        assert!(drawn(&[]).iter().all(|texel| texel[3] == 0.0));
        assert!(
            drawn(&stroke(&[[9.0, 9.0, 3.0]]))
                .iter()
                .all(|texel| texel[3] == 0.0)
        );
    }
}
