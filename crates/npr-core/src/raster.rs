//! Triangles to pixels: which triangle each pixel of a grid shows.
//!
//! The fill rule is that of the graphics interfaces: corners are snapped to 1/256 of a pixel, a pixel belongs to a
//! triangle when its centre lies inside, and a centre exactly on an edge belongs to it when that edge is a
//! top or a left one [Pineda 1988]. Depth is reversed (greater is nearer); of equal depths the earlier triangle wins.
//! Rows are filled in bands, in parallel, each in triangle order, so the result does not depend on the threads.

use crate::geometry::{NONE, Part, Triangle};
use crate::window::Window;
use rayon::prelude::*;

/// Sub-pixel steps per pixel.
const SUBPIXELS: i64 = 256;

/// Rows filled by one task.
const BAND_ROWS: usize = 32;

/// Triangles set up by one task.
const SETUP_TRIANGLES: usize = 2048;

/// Pixels beyond the grid up to which corners need no clipping: their products fit 64 bits with room to spare.
const GUARD_PX: f32 = 65536.0;

/// Which sides of triangles are filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sides {
    /// Both sides of double-sided parts, fronts of the others; no beams.
    AsParts,
    /// The same of beams alone.
    Beams,
    /// Both sides of all parts but beams: what throws shadows.
    Both,
    /// Backs of parts with a hull.
    Backs,
}

/// What to fill.
pub struct Fill<'a, C, K> {
    /// The pixel grid.
    pub window: &'a Window,
    /// The triangles, in the order that decides between equal depths.
    pub triangles: &'a [Triangle],
    /// The parts they belong to.
    pub parts: &'a [Part],
    /// Which sides are filled.
    pub sides: Sides,
    /// Added to the number of each triangle that is stored.
    pub id_bits: u32,
    /// Clip position of a vertex, for the whole frame.
    pub clip_of: C,
    /// Whether a triangle covers a pixel where it passes; asked only of cut-out parts.
    pub keep: K,
}

/// Fills `ids` with the number of the nearest triangle plus one at every pixel, and `depths` with its reversed depth.
///
/// Both are row-major and of the window's size; they are kept where no triangle is nearer, so that several fills can
/// follow one another. O(triangles + covered pixels).
pub fn fill_triangles<C, K>(fill: &Fill<'_, C, K>, ids: &mut [u32], depths: &mut [u32])
where
    C: Fn(u32) -> [f32; 4] + Sync,
    K: Fn(u32, u32, u32) -> bool + Sync,
{
    let width = fill.window.size[0] as usize;
    if width == 0 || fill.triangles.is_empty() {
        return;
    }

    // Project triangles in batches, and note which bands of rows each one touches.
    let band_count = (fill.window.size[1] as usize).div_ceil(BAND_ROWS);
    let batches: Vec<Batch> = fill
        .triangles
        .par_chunks(SETUP_TRIANGLES)
        .enumerate()
        .map(|(i, _)| Batch::set_up(fill, i * SETUP_TRIANGLES, band_count))
        .collect();

    // Fill the bands beside each other, every band in the order of triangles.
    let rows = BAND_ROWS * width;
    ids.par_chunks_mut(rows)
        .zip(depths.par_chunks_mut(rows))
        .enumerate()
        .for_each(|(band, (ids, depths))| {
            let mut rows = Rows {
                first: (band * BAND_ROWS) as i64,
                width,
                ids,
                depths,
            };
            for batch in &batches {
                for &slot in &batch.bands[band] {
                    rows.fill(&batch.screen[slot as usize], &fill.keep);
                }
            }
        });
}

/// Triangles set up together, and which of them touch each band.
struct Batch {
    screen: Vec<ScreenTriangle>,
    bands: Vec<Vec<u32>>,
}

impl Batch {
    fn set_up<C, K>(fill: &Fill<'_, C, K>, first: usize, band_count: usize) -> Self
    where
        C: Fn(u32) -> [f32; 4] + Sync,
    {
        let last = (first + SETUP_TRIANGLES).min(fill.triangles.len());
        let mut batch = Self {
            screen: Vec::new(),
            bands: vec![Vec::new(); band_count],
        };
        for index in first..last {
            let triangle = fill.triangles[index];
            let flags = fill.parts[triangle.part as usize].flags;

            // Take the triangles that this fill is for.
            let wanted = match fill.sides {
                Sides::AsParts | Sides::Both => flags & Part::BEAM == 0,
                Sides::Beams => flags & Part::BEAM != 0,
                Sides::Backs => flags & (Part::BEAM | Part::HULL) == Part::HULL,
            };
            if !wanted {
                continue;
            }

            // Clip what passes the near plane, and drop the side that is turned away.
            let clip = triangle
                .corners
                .map(|v| fill.window.clip_here((fill.clip_of)(v)));
            let cull = match fill.sides {
                Sides::Both => Cull::Nothing,
                Sides::Backs => Cull::Fronts,
                _ if flags & Part::DOUBLE_SIDED != 0 => Cull::Nothing,
                _ => Cull::Backs,
            };
            let id = (index as u32 + 1) | fill.id_bits;
            let cutout = flags & Part::CUTOUT != 0;
            for piece in fan(&clipped(clip, fill.window.size)) {
                if let Some(screen) = ScreenTriangle::new(piece, fill.window.size, cull, id, cutout)
                {
                    batch.add(screen);
                }
            }
        }
        batch
    }

    fn add(&mut self, screen: ScreenTriangle) {
        let slot = self.screen.len() as u32;
        for band in screen.top as usize / BAND_ROWS..=screen.bottom as usize / BAND_ROWS {
            self.bands[band].push(slot);
        }
        self.screen.push(screen);
    }
}

/// Which facing is not drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Cull {
    Nothing,
    Backs,
    Fronts,
}

/// Distance of a clip position from a plane, positive inside.
type Distance<'a> = &'a dyn Fn(&[f32; 4]) -> f32;

/// The part of a triangle in front of the near plane and within the guard band, as a convex polygon.
fn clipped(clip: [[f32; 4]; 3], size: [u32; 2]) -> Vec<[f32; 4]> {
    let guard = size.map(|n| 1.0 + 2.0 * GUARD_PX / n as f32);
    let inside = |v: &[f32; 4]| {
        v[3] - v[2] >= 0.0
            && v[3] > 0.0
            && v[0].abs() <= guard[0] * v[3]
            && v[1].abs() <= guard[1] * v[3]
    };
    let mut polygon = clip.to_vec();
    if clip.iter().all(inside) {
        return polygon;
    }
    // Distances to the planes: near (reversed depth 1), left, right, bottom, top, and far (depth 0).
    let planes: [Distance<'_>; 6] = [
        &|v| v[3] - v[2],
        &|v| guard[0] * v[3] + v[0],
        &|v| guard[0] * v[3] - v[0],
        &|v| guard[1] * v[3] + v[1],
        &|v| guard[1] * v[3] - v[1],
        &|v| v[2],
    ];
    for distance in planes {
        polygon = clip_polygon(&polygon, distance);
    }
    polygon.retain(|v| v[3] > 0.0);
    polygon
}

/// Sutherland and Hodgman's clip against one plane.
fn clip_polygon(polygon: &[[f32; 4]], distance: Distance<'_>) -> Vec<[f32; 4]> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, here) in polygon.iter().enumerate() {
        let next = &polygon[(i + 1) % polygon.len()];
        let (a, b) = (distance(here), distance(next));
        if a >= 0.0 {
            kept.push(*here);
        }
        if (a >= 0.0) != (b >= 0.0) {
            let t = a / (a - b);
            kept.push(std::array::from_fn(|k| here[k] + (next[k] - here[k]) * t));
        }
    }
    kept
}

/// A convex polygon as triangles around its first corner.
fn fan(polygon: &[[f32; 4]]) -> impl Iterator<Item = [[f32; 4]; 3]> + '_ {
    (2..polygon.len()).map(|i| [polygon[0], polygon[i - 1], polygon[i]])
}

/// A triangle on the sub-pixel grid, counter-clockwise with y down turned so that its inside is positive.
struct ScreenTriangle {
    x: [i64; 3],
    y: [i64; 3],
    /// Depth at pixel centre (0, 0), and its change per pixel.
    depth: [f64; 3],
    left: i64,
    right: i64,
    top: i64,
    bottom: i64,
    id: u32,
    cutout: bool,
}

impl ScreenTriangle {
    /// Snaps a clipped triangle to the grid; `None` where it is culled, empty or beside the grid.
    fn new(clip: [[f32; 4]; 3], size: [u32; 2], cull: Cull, id: u32, cutout: bool) -> Option<Self> {
        let mut x = clip.map(|v| snapped((v[0] / v[3] + 1.0) * 0.5 * size[0] as f32));
        let mut y = clip.map(|v| snapped((1.0 - v[1] / v[3]) * 0.5 * size[1] as f32));
        let mut z = clip.map(|v| v[2] / v[3]);
        let area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
        // With y down, a front (counter-clockwise with y up) has a negative area.
        if area == 0 || (area > 0 && cull == Cull::Backs) || (area < 0 && cull == Cull::Fronts) {
            return None;
        }
        if area < 0 {
            (x, y, z) = ([x[0], x[2], x[1]], [y[0], y[2], y[1]], [z[0], z[2], z[1]]);
        }
        let reach = |v: [i64; 3], last: u32| {
            let (low, high) = (v[0].min(v[1]).min(v[2]), v[0].max(v[1]).max(v[2]));
            (
                (first_center(low)).max(0),
                last_center(high).min(i64::from(last) - 1),
            )
        };
        let (left, right) = reach(x, size[0]);
        let (top, bottom) = reach(y, size[1]);
        if left > right || top > bottom {
            return None;
        }
        let depth = depth_plane(x, y, z, area.abs());
        Some(Self {
            x,
            y,
            depth,
            left,
            right,
            top,
            bottom,
            id,
            cutout,
        })
    }

    /// The pixels of a row whose centres lie inside, as first and last column; empty where first > last.
    fn span(&self, row: i64) -> (i64, i64) {
        let (mut first, mut last) = (self.left, self.right);
        let center_y = row * SUBPIXELS + SUBPIXELS / 2;
        for i in 0..3 {
            let j = (i + 1) % 3;
            let (dx, dy) = (self.x[j] - self.x[i], self.y[j] - self.y[i]);
            // Inside is where dx * (cy - y) - dy * (cx - x) > 0, or = 0 on a top or left edge.
            let owns_its_points = dy < 0 || (dy == 0 && dx > 0);
            let at_zero = dx * (center_y - self.y[i]) + dy * self.x[i] - dy * (SUBPIXELS / 2);
            let at_zero = at_zero - i64::from(!owns_its_points);
            // Need at_zero - dy * SUBPIXELS * column >= 0.
            let step = dy * SUBPIXELS;
            if step < 0 {
                first = first.max(
                    (-at_zero).div_euclid(-step) + i64::from((-at_zero).rem_euclid(-step) != 0),
                );
            } else if step > 0 {
                last = last.min(at_zero.div_euclid(step));
            } else if at_zero < 0 {
                return (1, 0);
            }
        }
        (first, last)
    }
}

/// The nearest sub-pixel position, halves to even as hardware does.
fn snapped(px: f32) -> i64 {
    (px * SUBPIXELS as f32).round_ties_even() as i64
}

/// First pixel whose centre is at or after a sub-pixel position.
fn first_center(position: i64) -> i64 {
    (position - SUBPIXELS / 2).div_euclid(SUBPIXELS)
        + i64::from((position - SUBPIXELS / 2).rem_euclid(SUBPIXELS) != 0)
}

/// Last pixel whose centre is at or before a sub-pixel position.
fn last_center(position: i64) -> i64 {
    (position - SUBPIXELS / 2).div_euclid(SUBPIXELS)
}

/// The plane of depth over the picture: value at the centre of pixel (0, 0), change per column, change per row.
fn depth_plane(x: [i64; 3], y: [i64; 3], z: [f32; 3], area: i64) -> [f64; 3] {
    let area = area as f64;
    let (x1, y1) = ((x[1] - x[0]) as f64, (y[1] - y[0]) as f64);
    let (x2, y2) = ((x[2] - x[0]) as f64, (y[2] - y[0]) as f64);
    let (z1, z2) = (
        f64::from(z[1]) - f64::from(z[0]),
        f64::from(z[2]) - f64::from(z[0]),
    );
    let per_x = (z1 * y2 - z2 * y1) / area;
    let per_y = (z2 * x1 - z1 * x2) / area;
    let half = (SUBPIXELS / 2) as f64;
    let at_zero = f64::from(z[0]) + per_x * (half - x[0] as f64) + per_y * (half - y[0] as f64);
    [at_zero, per_x * SUBPIXELS as f64, per_y * SUBPIXELS as f64]
}

/// A band of rows being filled.
struct Rows<'a> {
    first: i64,
    width: usize,
    ids: &'a mut [u32],
    depths: &'a mut [u32],
}

impl Rows<'_> {
    fn fill(&mut self, triangle: &ScreenTriangle, keep: &impl Fn(u32, u32, u32) -> bool) {
        let row_count = (self.ids.len() / self.width) as i64;
        let top = triangle.top.max(self.first);
        let bottom = triangle.bottom.min(self.first + row_count - 1);
        for row in top..=bottom {
            let (left, right) = triangle.span(row);
            if left > right {
                continue;
            }
            let start = (row - self.first) as usize * self.width;
            let range = start + left as usize..=start + right as usize;
            let depth = (triangle.depth[0]
                + triangle.depth[2] * row as f64
                + triangle.depth[1] * left as f64) as f32;
            let step = triangle.depth[1] as f32;
            let pixels = self.ids[range.clone()]
                .iter_mut()
                .zip(&mut self.depths[range]);
            for (i, (id, nearest)) in pixels.enumerate() {
                // Reversed depth is positive, so its bits compare like the number itself.
                let z = (depth + step * i as f32).max(0.0).to_bits();
                if z > *nearest
                    && (!triangle.cutout || keep(triangle.id, left as u32 + i as u32, row as u32))
                {
                    *nearest = z;
                    *id = triangle.id;
                }
            }
        }
    }
}

/// The triangle that an id of [`fill_triangles`] names, or [`NONE`] where nothing was drawn.
pub fn triangle_of(id: u32) -> u32 {
    if id & ID_MASK == 0 {
        NONE
    } else {
        (id & ID_MASK) - 1
    }
}

/// Marks pixels filled by a hull.
pub const HULL_BIT: u32 = 1 << 31;

/// The bits of an id that number the triangle.
pub const ID_MASK: u32 = HULL_BIT - 1;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SIZE: [u32; 2] = [64, 48];

    fn window() -> Window {
        Window::over([64.0, 48.0], [0.0; 2], [64.0, 48.0], SIZE)
    }

    fn two_sided() -> Part {
        Part {
            flags: Part::DOUBLE_SIDED,
            ..Part::default()
        }
    }

    fn draw(corners: &[[f32; 4]], sides: Sides, part: Part) -> (Vec<u32>, Vec<u32>) {
        let count = corners.len() as u32 / 3;
        let triangles: Vec<Triangle> = (0..count)
            .map(|i| Triangle {
                corners: [3 * i, 3 * i + 1, 3 * i + 2],
                part: 0,
            })
            .collect();
        let (mut ids, mut depths) = (vec![0; 64 * 48], vec![0; 64 * 48]);
        let fill = Fill {
            window: &window(),
            triangles: &triangles,
            parts: &[part],
            sides,
            id_bits: 0,
            clip_of: |v| corners[v as usize],
            keep: |_, _, _| true,
        };
        fill_triangles(&fill, &mut ids, &mut depths);
        (ids, depths)
    }

    /// Clip position of a pixel position at depth `z`.
    fn at(x: f32, y: f32, z: f32) -> [f32; 4] {
        [x / 32.0 - 1.0, 1.0 - y / 24.0, z, 1.0]
    }

    /// Every pixel tested on its own, in 128-bit integers.
    fn covered_by_oracle(px: [[f32; 2]; 3]) -> Vec<bool> {
        let mut v: Vec<[i128; 2]> = px
            .iter()
            .map(|p| p.map(|c| i128::from(snapped(c))))
            .collect();
        let area =
            (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[1][1] - v[0][1]) * (v[2][0] - v[0][0]);
        if area < 0 {
            v.swap(1, 2);
        }
        let inside = |x: i128, y: i128| {
            area != 0
                && (0..3).all(|i| {
                    let (a, b) = (v[i], v[(i + 1) % 3]);
                    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
                    let side = dx * (y - a[1]) - dy * (x - a[0]);
                    side > 0 || (side == 0 && (dy < 0 || (dy == 0 && dx > 0)))
                })
        };
        (0..48)
            .flat_map(|y| (0..64).map(move |x| (x, y)))
            .map(|(x, y)| inside(x * 256 + 128, y * 256 + 128))
            .collect()
    }

    fn point() -> impl Strategy<Value = [f32; 2]> {
        ((-20i32..340), (-20i32..260)).prop_map(|(x, y)| [x as f32 * 0.25, y as f32 * 0.25])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]
        #[test]
        fn pixels_are_those_whose_centres_lie_inside(a in point(), b in point(), c in point()) {
            let corners = [a, b, c].map(|p| at(p[0], p[1], 0.5));
            let (ids, _) = draw(&corners, Sides::AsParts, two_sided());
            let px = corners.map(|v| [(v[0] / v[3] + 1.0) * 32.0, (1.0 - v[1] / v[3]) * 24.0]);
            let oracle = covered_by_oracle(px);
            for (i, id) in ids.iter().enumerate() {
                prop_assert_eq!(*id != 0, oracle[i], "pixel {} {}", i % 64, i / 64);
            }
        }

        #[test]
        fn two_triangles_of_a_quad_share_no_pixel_and_leave_none(
            a in point(), b in point(), c in point(), d in point(),
        ) {
            let (p, q, r, s) = (at(a[0], a[1], 0.5), at(b[0], b[1], 0.5), at(c[0], c[1], 0.5), at(d[0], d[1], 0.5));
            let side = |u: [f32; 2], v: [f32; 2], w: [f32; 2]| {
                (v[0] - u[0]) * (w[1] - u[1]) - (v[1] - u[1]) * (w[0] - u[0])
            };
            prop_assume!(side(a, b, c) * side(a, b, d) < 0.0);
            let (one, _) = draw(&[p, q, r], Sides::AsParts, two_sided());
            let (two, _) = draw(&[p, q, s], Sides::AsParts, two_sided());
            for i in 0..one.len() {
                prop_assert!(one[i] == 0 || two[i] == 0, "pixel {} {} is covered twice", i % 64, i / 64);
            }
        }

        #[test]
        fn the_nearer_triangle_wins_whatever_the_order(
            z in prop::array::uniform2(0.05f32..0.95), a in point(), b in point(), c in point(),
        ) {
            prop_assume!((z[0] - z[1]).abs() > 1e-3);
            let first: Vec<_> = [a, b, c].iter().map(|p| at(p[0], p[1], z[0])).collect();
            let second: Vec<_> = [a, b, c].iter().map(|p| at(p[0], p[1], z[1])).collect();
            let (ids, _) = draw(&[first, second].concat(), Sides::AsParts, two_sided());
            let want = if z[0] > z[1] { 1 } else { 2 };
            prop_assert!(ids.iter().all(|id| *id == 0 || *id == want));
        }

        #[test]
        fn nothing_outside_the_view_panics(v in prop::array::uniform12(-1e30f32..1e30)) {
            let corners = [[v[0], v[1], v[2], v[3]], [v[4], v[5], v[6], v[7]], [v[8], v[9], v[10], v[11]]];
            draw(&corners, Sides::AsParts, two_sided());
        }
    }

    #[test]
    fn a_triangle_through_the_near_plane_keeps_its_visible_part() {
        let corners = [
            [-4.0, -1.0, 0.5, 1.0],
            [4.0, -1.0, 0.5, 1.0],
            [0.0, 9.0, 0.5, -3.0],
        ];
        let (ids, _) = draw(&corners, Sides::AsParts, two_sided());
        assert_eq!(ids[47 * 64 + 32], 1);
        assert!(ids.iter().filter(|id| **id != 0).count() > 1000);
    }

    #[test]
    fn one_sided_parts_hide_their_backs_and_hulls_show_only_them() {
        let front = [at(10.0, 40.0, 0.5), at(50.0, 40.0, 0.5), at(30.0, 5.0, 0.5)];
        let back = [front[0], front[2], front[1]];
        let seen = |corners: &[[f32; 4]], sides| {
            let part = Part {
                flags: Part::HULL,
                ..Part::default()
            };
            draw(corners, sides, part).0.iter().any(|id| *id != 0)
        };
        assert!(seen(&front, Sides::AsParts) && !seen(&back, Sides::AsParts));
        assert!(!seen(&front, Sides::Backs) && seen(&back, Sides::Backs));
    }

    #[test]
    fn the_result_does_not_depend_on_the_threads() {
        let corners: Vec<[f32; 4]> = (0..9000u32)
            .map(|i| {
                let hash = i.wrapping_mul(2_654_435_761);
                at(
                    (hash % 640) as f32 * 0.1,
                    (hash / 640 % 480) as f32 * 0.1,
                    (hash / 7919 % 97) as f32 * 0.01,
                )
            })
            .collect();
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| draw(&corners, Sides::AsParts, two_sided()))
        };
        assert_eq!(with(1), with(4));
    }
}
