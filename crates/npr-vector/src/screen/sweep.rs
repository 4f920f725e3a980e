//! Lines with width over pixels: what a segment covers, which of several lines a pixel keeps, and drawing many of them
//! on all threads.

use npr_core::window::Window;
use rayon::prelude::*;

/// Rows drawn by one task.
const BAND_ROWS: usize = 32;

/// A line segment with a half width at either end, in frame pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ribbon {
    /// One end of the spine.
    pub a: [f32; 2],
    /// The other end.
    pub b: [f32; 2],
    /// Half width at `a`.
    pub half_a: f32,
    /// Half width at `b`.
    pub half_b: f32,
}

/// Share of a pixel covered by a straight line of half width `half_width` at `distance` from its centre, in pixels.
///
/// Exact for a box filter along the line's normal, so thin lines fade instead of breaking up.
pub fn line_coverage(distance: f32, half_width: f32) -> f32 {
    let covered = half_width.min(distance + 0.5) - (-half_width).max(distance - 0.5);
    covered.clamp(0.0, 1.0)
}

/// Share of a pixel that lies on the inner side of a straight edge; the pixel's centre lies `inside` within it, along
/// the edge's unit normal, in pixels.
///
/// Exact: the pixel is a square, seen by the edge as a trapezoid.
pub fn half_plane_coverage(inside: f32, normal: [f32; 2]) -> f32 {
    let [x, y] = normal.map(f32::abs);
    let (long, short) = (x.max(y), x.min(y));
    let (foot, top) = (0.5 * (long + short), 0.5 * (long - short));
    let depth = inside.abs();
    let beyond = if depth >= foot {
        0.0
    } else if depth > top {
        (foot - depth) * (foot - depth) / (2.0 * long * short)
    } else {
        0.5 - depth / long
    };
    if inside > 0.0 { 1.0 - beyond } else { beyond }
}

/// Share of a pixel covered by a straight strip of half width `half_width`, in pixels; its middle lies `distance` from
/// the pixel's centre, along a unit normal.
///
/// Exact, so that a hair line is as dark in every column that it runs through, at any slope.
pub fn strip_coverage(distance: f32, half_width: f32, normal: [f32; 2]) -> f32 {
    let far = half_plane_coverage(half_width + distance, normal);
    let near = half_plane_coverage(half_width - distance, normal);
    (far + near - 1.0).clamp(0.0, 1.0)
}

impl Ribbon {
    /// Coverage of the pixel centred at `p`, and the nearest point of the spine, 0 at `a` and 1 at `b`.
    ///
    /// Round ends overlap the next ribbon's, so that thick bends have no notches; `square` ones stop at the end
    /// points, as published.
    pub fn at(&self, p: [f32; 2], square: bool) -> (f32, f32) {
        let ab = [self.b[0] - self.a[0], self.b[1] - self.a[1]];
        let ap = [p[0] - self.a[0], p[1] - self.a[1]];
        let square_length = ab[0] * ab[0] + ab[1] * ab[1];
        let along = if square_length > 1e-12 {
            (ap[0] * ab[0] + ap[1] * ab[1]) / square_length
        } else {
            0.0
        };
        let t = along.clamp(0.0, 1.0);
        let off = [ap[0] - ab[0] * t, ap[1] - ab[1] * t];
        let distance = (off[0] * off[0] + off[1] * off[1]).sqrt();
        let half_width = self.half_a + (self.half_b - self.half_a) * t;
        if square && t != along {
            return (0.0, t);
        }
        (line_coverage(distance, half_width), t)
    }

    /// Coverage of the pixel centred at `p` by all discs along the spine, whose radius grows evenly from one end to the
    /// other, and where the disc lies that covers it, 0 at `a` and 1 at `b`.
    ///
    /// Exact where the outline is straight; also where a taper is as steep as it is long.
    pub fn swept(&self, p: [f32; 2]) -> (f32, f32) {
        let ab = [self.b[0] - self.a[0], self.b[1] - self.a[1]];
        let ap = [p[0] - self.a[0], p[1] - self.a[1]];
        let length = (ab[0] * ab[0] + ab[1] * ab[1]).sqrt();
        let shrink = self.half_a - self.half_b;

        // The disc that reaches farthest towards a point lies back from its foot, towards the thick end.
        let mut t = if shrink >= 0.0 { 0.0 } else { 1.0 };
        if length > shrink.abs() && length > 1e-6 {
            let along = (ap[0] * ab[0] + ap[1] * ab[1]) / length;
            let beside = (ap[1] * ab[0] - ap[0] * ab[1]).abs() / length;
            let lean = shrink / (length * length - shrink * shrink).sqrt();
            t = ((along - beside * lean) / length).clamp(0.0, 1.0);
        }
        let off = [ap[0] - ab[0] * t, ap[1] - ab[1] * t];
        let distance = (off[0] * off[0] + off[1] * off[1]).sqrt();
        let normal = if distance > 1e-3 {
            off.map(|v| v / distance)
        } else if length > 1e-6 {
            [-ab[1] / length, ab[0] / length]
        } else {
            [1.0, 0.0]
        };
        (
            strip_coverage(distance, self.half_a - shrink * t, normal),
            t,
        )
    }
}

/// The key that decides between lines at a pixel: more coverage first, then nearness.
pub fn line_key(coverage: f32, nearness: f32) -> f32 {
    ((coverage * 255.0 + 0.5).floor() + nearness.min(0.999)) / 256.0
}

/// Inks a pixel for an item: its place in the frame, its texel and its key.
type InkPixel<'a, T> = dyn Fn(&T, [f32; 2], &mut u32, &mut u32) + Sync + 'a;

/// Draws items, each with a ribbon, into pixels of a window: `ink` is called for every pixel that the ribbon may cover.
///
/// O(items + covered pixels), parallel over bands of rows, each in the order of the items.
pub(crate) fn draw_bands<T: AsRef<Ribbon> + Sync>(
    items: &[T],
    window: &Window,
    layer: &mut [u32],
    keys: &mut [u32],
    ink: &InkPixel<'_, T>,
) {
    let width = window.size[0] as usize;
    let height = window.size[1] as usize;

    // Sort the items into bands of rows, in their order.
    let mut bands = vec![Vec::new(); height.div_ceil(BAND_ROWS)];
    for (i, item) in items.iter().enumerate() {
        if let Some((top, bottom)) = item.as_ref().rows(window) {
            for band in &mut bands[top / BAND_ROWS..=bottom / BAND_ROWS] {
                band.push(i as u32);
            }
        }
    }

    // Draw each band on a thread of its own.
    let rows = BAND_ROWS * width;
    let targets = layer.par_chunks_mut(rows).zip(keys.par_chunks_mut(rows));
    targets
        .zip(bands)
        .enumerate()
        .for_each(|(band, ((layer, keys), members))| {
            let first_row = band * BAND_ROWS;
            for item in members.iter().map(|member| &items[*member as usize]) {
                item.as_ref()
                    .each_pixel(window, (first_row, layer.len() / width), |px, slot| {
                        ink(item, px, &mut layer[slot], &mut keys[slot]);
                    });
            }
        });
}

impl Ribbon {
    /// How far from the spine the centres of pixels lie that ink may touch: a pixel's corner is 0.71 from its centre.
    fn reach(&self) -> f32 {
        self.half_a.max(self.half_b) + 0.75
    }

    /// The rows of the window that may hold ink.
    fn rows(&self, window: &Window) -> Option<(usize, usize)> {
        let (low, high) = (self.a[1].min(self.b[1]), self.a[1].max(self.b[1]));
        let (top, bottom) = centers_between(low - self.reach(), high + self.reach(), window, 1)?;
        Some((top as usize, bottom as usize))
    }

    /// The columns of the window that may hold ink in the row whose centre lies at `y`.
    fn columns(&self, y: f32, window: &Window) -> Option<(u32, u32)> {
        let Ribbon { a, b, .. } = self;
        let (reach, rise) = (self.reach(), b[1] - a[1]);
        let at = |t: f32| a[0] + (b[0] - a[0]) * t.clamp(0.0, 1.0);
        let (x0, x1) = if rise.abs() > 1e-3 {
            (at((y - reach - a[1]) / rise), at((y + reach - a[1]) / rise))
        } else {
            (a[0], b[0])
        };
        centers_between(x0.min(x1) - reach, x0.max(x1) + reach, window, 0)
    }

    /// Calls `ink` for every pixel that may hold ink in a band of rows, the first and their number, with its place in
    /// the frame and its place in the band.
    fn each_pixel(
        &self,
        window: &Window,
        (first_row, row_count): (usize, usize),
        mut ink: impl FnMut([f32; 2], usize),
    ) {
        let Some((top, bottom)) = self.rows(window) else {
            return;
        };
        let width = window.size[0] as usize;
        for row in top.max(first_row)..=bottom.min(first_row + row_count - 1) {
            let y = window.frame_at(0, row as u32)[1];
            let Some((left, right)) = self.columns(y, window) else {
                continue;
            };
            let start = (row - first_row) * width;
            for column in left..=right {
                ink(window.frame_at(column, row as u32), start + column as usize);
            }
        }
    }
}

/// First and last pixel of the window along an axis whose centres lie between two frame positions.
fn centers_between(low: f32, high: f32, window: &Window, axis: usize) -> Option<(u32, u32)> {
    let to_window = |px: f32| (px - window.frame_origin[axis]) / window.frame_step[axis] - 0.5;
    let last = window.size[axis] as f32 - 1.0;
    let (first, end) = (
        to_window(low).ceil().max(0.0),
        to_window(high).floor().min(last),
    );
    (first <= end).then_some((first as u32, end as u32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = [f32; 2]> {
        prop::array::uniform2(2f32..30.0)
    }

    proptest! {
        #[test]
        fn coverage_is_the_overlap_of_two_intervals(distance in 0f32..5.0, half in 0f32..4.0) {
            let n = 4000;
            let inside = (0..n).filter(|i| {
                let at = distance - 0.5 + (*i as f32 + 0.5) / n as f32;
                at.abs() <= half
            });
            let want = inside.count() as f32 / n as f32;
            prop_assert!((line_coverage(distance, half) - want).abs() < 1e-3);
        }

        #[test]
        fn turning_a_ribbon_round_changes_nothing(
            a in point(), b in point(), half_a in 0.1f32..4.0, half_b in 0.1f32..4.0, p in point(),
        ) {
            let there = Ribbon { a, b, half_a, half_b }.at(p, false);
            let back = Ribbon { a: b, b: a, half_a: half_b, half_b: half_a }.at(p, false);
            prop_assert!((there.0 - back.0).abs() < 1e-3);
        }

        #[test]
        fn a_bend_has_no_notch(a in point(), b in point(), c in point(), half in 1f32..4.0, angle in 0f32..6.3) {
            // Around the joint, everything within the half width is inked by one of the two ribbons.
            let one = Ribbon { a, b, half_a: half, half_b: half };
            let two = Ribbon { a: b, b: c, half_a: half, half_b: half };
            let r = half - 0.5;
            let p = [b[0] + npr_core::math::cos(angle) * r, b[1] + npr_core::math::sin(angle) * r];
            prop_assert!(one.at(p, false).0.max(two.at(p, false).0) > 0.99);
        }

        #[test]
        fn a_sweep_covers_what_its_discs_cover(
            a in point(), b in point(), half_a in 0f32..9.0, half_b in 0f32..9.0, p in point(),
        ) {
            let ribbon = Ribbon { a, b, half_a, half_b };
            let n = 20_000;
            // Of all discs, the one whose rim reaches farthest beyond the pixel, or stays behind it least.
            let (outside, half, off) = (0..=n).map(|i| {
                let t = i as f32 / n as f32;
                let center = [0, 1].map(|i| a[i] + (b[i] - a[i]) * t);
                let half = half_a + (half_b - half_a) * t;
                let off = [p[0] - center[0], p[1] - center[1]];
                ((off[0] * off[0] + off[1] * off[1]).sqrt() - half, half, off)
            }).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
            let distance = outside + half;
            prop_assume!(distance > 0.05);
            let want = strip_coverage(distance, half, off.map(|v| v / distance));
            let (coverage, t) = ribbon.swept(p);
            prop_assert!((0.0..=1.0).contains(&t));
            prop_assert!((coverage - want).abs() < 5e-3, "{} {}", coverage, want);
        }

        #[test]
        fn coverage_of_a_strip_is_the_share_of_points_in_it(
            distance in 0f32..3.0, half in 0f32..3.0, angle in 0f32..6.3,
        ) {
            let normal = [npr_core::math::cos(angle), npr_core::math::sin(angle)];
            let n = 300;
            let at = |i: i32| (i as f32 + 0.5) / n as f32 - 0.5;
            let inside = (0..n * n).filter(|i| {
                let [x, y] = [at(i % n), at(i / n)];
                (x * normal[0] + y * normal[1] + distance).abs() <= half
            });
            let want = inside.count() as f32 / (n * n) as f32;
            let coverage = strip_coverage(distance, half, normal);
            prop_assert!((coverage - want).abs() < 0.01, "{} {}", coverage, want);
        }

        #[test]
        fn the_key_orders_by_coverage_then_nearness(
            a in 0f32..1.0, b in 0f32..1.0, near in 0f32..1.0, far in 0f32..1.0,
        ) {
            prop_assume!((a - b).abs() > 1.0 / 250.0);
            prop_assert_eq!(line_key(a, near) > line_key(b, far), a > b);
            prop_assert!(line_key(a, near.max(far)) >= line_key(a, near.min(far)));
        }
    }
}
