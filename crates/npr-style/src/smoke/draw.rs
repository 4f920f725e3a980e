//! Spheres to pixels: the twins of `smoke.project_spheres` and `raster.draw_spheres`.

use npr_core::geometry::FAR_DEPTH;
use npr_core::smoke::{Sphere, SphereView, ViewSphere};
use npr_core::window::Window;
use rayon::prelude::*;
use std::ops::RangeInclusive;

/// Rows of a tile.
const TILE_ROWS: usize = 16;

/// Columns of a tile.
const TILE_COLUMNS: usize = 64;

/// Greatest distance of a ball from the axis, in columns, for its spans to be computed: farther off, rounding is too
/// coarse for columns.
const SPAN_REACH: f32 = 1e5;

/// Projects every sphere for a lens. O(spheres).
pub fn project_spheres(lens: &SphereView, spheres: &[Sphere], balls: &mut [ViewSphere]) {
    for (sphere, ball) in spheres.iter().zip(balls) {
        *ball = lens.project(sphere);
    }
}

/// Fills `ids` with the number of the nearest ball plus one at every pixel, 0 where there is none, and `depths` with
/// its reversed depth.
///
/// Both are row-major, of the window's size; every texel is written. Of equal depths the earlier ball wins. Tiles take
/// the balls from front to back, and their rows skip balls behind all that is drawn, so of a dense plume little more
/// than its skin is computed. O(balls log balls + what is not hidden).
pub fn draw_spheres(
    lens: &SphereView,
    window: &Window,
    balls: &[ViewSphere],
    ids: &mut [u32],
    depths: &mut [u32],
) {
    // Sort the balls into bands of rows, each from front to back.
    let width = window.size[0] as usize;
    if width == 0 {
        return;
    }
    let bands = sorted_into_bands(lens, window, balls);

    // Draw every tile of a band, and write what it shows.
    let rows = TILE_ROWS * width;
    ids.par_chunks_mut(rows)
        .zip(depths.par_chunks_mut(rows))
        .zip(&bands)
        .enumerate()
        .for_each(|(band, ((ids, depths), members))| {
            let mut tile = Tile::new(lens, window, band * TILE_ROWS, ids.len() / width);
            for left in (0..width).step_by(TILE_COLUMNS) {
                if tile.fill(left, balls, members) {
                    tile.store(ids, depths);
                } else {
                    tile.wipe(ids);
                    tile.wipe(depths);
                }
            }
        });
}

/// A ball in a window: its number, its nearest depth, and the pixels around its image.
#[derive(Clone, Copy)]
struct Member {
    ball: u32,
    front: f32,
    left: u32,
    right: u32,
    top: u32,
    bottom: u32,
}

impl Member {
    /// `None` where the ball lies beside the window.
    fn new(lens: &SphereView, window: &Window, ball: &ViewSphere, number: u32) -> Option<Self> {
        let [left, top, right, bottom] = ball.bounds;
        if left > right || top > bottom {
            return None;
        }
        // Add one pixel on each side: rounding must not cut off pixels whose ray meets the ball.
        let reach = |low: f32, high: f32, i: usize| {
            let at = |px: f32| (px - window.frame_origin[i]) / window.frame_step[i];
            let (low, high) = (at(low).floor() - 1.0, at(high).ceil() + 1.0);
            let last = window.size[i] as f32 - 1.0;
            (high >= 0.0 && low <= last).then(|| (low.max(0.0) as u32, high.min(last) as u32))
        };
        let (left, right) = reach(left, right, 0)?;
        let (top, bottom) = reach(top, bottom, 1)?;
        let depth = ball.center[2];
        let front = if lens.discs > 0.5 {
            depth
        } else {
            depth - ball.radius
        };
        Some(Self {
            ball: number,
            front,
            left,
            right,
            top,
            bottom,
        })
    }
}

/// The balls that touch each band of rows, from front to back.
fn sorted_into_bands(lens: &SphereView, window: &Window, balls: &[ViewSphere]) -> Vec<Vec<Member>> {
    let numbered = (0u32..).zip(balls);
    let mut members: Vec<Member> = numbered
        .filter_map(|(number, ball)| Member::new(lens, window, ball, number))
        .collect();
    members.sort_unstable_by(|a, b| a.front.total_cmp(&b.front).then(a.ball.cmp(&b.ball)));
    let count = (window.size[1] as usize).div_ceil(TILE_ROWS);
    let mut bands = vec![Vec::new(); count];
    for member in members {
        let (top, bottom) = (
            member.top as usize / TILE_ROWS,
            member.bottom as usize / TILE_ROWS,
        );
        for band in &mut bands[top..=bottom] {
            band.push(member);
        }
    }
    bands
}

/// The part of a band that is being drawn.
struct Tile<'a> {
    lens: &'a SphereView,
    window: &'a Window,
    top: usize,
    rows: usize,
    left: usize,
    columns: usize,
    /// Distance between the rays of neighbouring columns.
    column_step: f32,
    /// Ray of every column, to the right; that of every row, up, follows.
    across: [f32; TILE_COLUMNS],
    up: [f32; TILE_ROWS],
    /// One over the squared length of every ray, for rays that meet at the eye.
    scales: [f32; TILE_ROWS * TILE_COLUMNS],
    /// The farthest depth in every row.
    farthest: [f32; TILE_ROWS],
    /// View depths, and ball numbers plus one, row by row, [`TILE_COLUMNS`] wide.
    depths: [f32; TILE_ROWS * TILE_COLUMNS],
    ids: [u32; TILE_ROWS * TILE_COLUMNS],
}

impl<'a> Tile<'a> {
    fn new(lens: &'a SphereView, window: &'a Window, top: usize, rows: usize) -> Self {
        Self {
            lens,
            window,
            top,
            rows,
            left: 0,
            columns: 0,
            column_step: 2.0 * lens.half[0] / lens.frame_px[0] * window.frame_step[0],
            across: [0.0; TILE_COLUMNS],
            up: [0.0; TILE_ROWS],
            scales: [1.0; TILE_ROWS * TILE_COLUMNS],
            farthest: [f32::MIN; TILE_ROWS],
            depths: [FAR_DEPTH; TILE_ROWS * TILE_COLUMNS],
            ids: [0; TILE_ROWS * TILE_COLUMNS],
        }
    }

    /// Draws the balls over the columns from `left` on; returns whether there were any.
    fn fill(&mut self, left: usize, balls: &[ViewSphere], members: &[Member]) -> bool {
        self.left = left;
        self.columns = TILE_COLUMNS.min(self.window.size[0] as usize - left);
        let last = (left + self.columns - 1) as u32;
        let touches = |member: &&Member| member.right >= left as u32 && member.left <= last;
        let mut members = members.iter().filter(touches).peekable();
        if members.peek().is_none() {
            return false;
        }
        self.clear();
        for member in members {
            if self.farthest.iter().all(|depth| member.front > *depth) {
                break;
            }
            self.draw(member, &balls[member.ball as usize]);
        }
        true
    }

    /// Empties the tile. Texels beyond the picture count as nearest, so that they do not raise the farthest depth of a
    /// row.
    fn clear(&mut self) {
        // Empty the texels of the tile.
        self.ids.fill(0);
        self.depths.fill(f32::MIN);
        for row in self.depths.chunks_mut(TILE_COLUMNS).take(self.rows) {
            row[..self.columns].fill(FAR_DEPTH);
        }

        // Find the rays of its columns and rows.
        for (column, across) in self.across[..self.columns].iter_mut().enumerate() {
            let at = self.window.frame_at((self.left + column) as u32, 0);
            *across = self.lens.ray(at)[0];
        }
        self.farthest.fill(f32::MIN);
        for row in 0..self.rows {
            let at = self.window.frame_at(0, (self.top + row) as u32);
            let up = self.lens.ray(at)[1];
            (self.up[row], self.farthest[row]) = (up, FAR_DEPTH);
            if self.lens.perspective > 0.5 {
                let scales = &mut self.scales[row * TILE_COLUMNS..][..TILE_COLUMNS];
                for (scale, across) in scales.iter_mut().zip(&self.across) {
                    *scale = 1.0 / (across * across + up * up + 1.0);
                }
            }
        }
    }

    fn draw(&mut self, member: &Member, ball: &ViewSphere) {
        let first = (member.left as usize).max(self.left) - self.left;
        let last = (member.right as usize).min(self.left + self.columns - 1) - self.left;
        let top = (member.top as usize).max(self.top) - self.top;
        let bottom = (member.bottom as usize).min(self.top + self.rows - 1) - self.top;
        for row in top..=bottom {
            let Some((front, columns)) = self.span(ball, row, first..=last) else {
                continue;
            };
            if member.front.max(front) > self.farthest[row] {
                continue;
            }
            self.draw_row(row, columns, member.ball + 1, ball);
            let start = row * TILE_COLUMNS;
            self.farthest[row] = farthest(&self.depths[start..start + TILE_COLUMNS]);
        }
    }

    /// Nearest depth of a ball in a row, and the columns that meet it there, with one more on each side for rounding;
    /// `None` if it misses the row. Only for parallel rays: else all of `columns`.
    fn span(
        &self,
        ball: &ViewSphere,
        row: usize,
        columns: RangeInclusive<usize>,
    ) -> Option<(f32, RangeInclusive<usize>)> {
        let (step, start) = (self.column_step, self.across[0]);
        let reach = (start.abs() + ball.center[0].abs() + ball.radius) / step;
        let is_exact = reach < SPAN_REACH;
        if self.lens.perspective > 0.5 || self.lens.discs > 0.5 || !is_exact {
            return Some((f32::MIN, columns));
        }
        // Compute as `depth_parallel` does, so that rounding never makes a texel nearer or wider than its row.
        let beside = ball.center[1] - self.up[row];
        let left = ball.radius * ball.radius - beside * beside;
        if left <= 0.0 {
            return None;
        }
        let half = left.sqrt();
        let column = |x: f32| (x - start) / step;
        let first = column(ball.center[0] - half).floor() - 1.0;
        let last = column(ball.center[0] + half).ceil() + 1.0;
        // Casts turn a float below the range into 0, and one beyond it into the greatest number.
        let first = (first as usize).max(*columns.start());
        let last = (last as usize).min(*columns.end());
        (first <= last).then_some((ball.center[2] - half, first..=last))
    }

    /// Draws a ball over some columns of a row.
    fn draw_row(&mut self, row: usize, columns: RangeInclusive<usize>, id: u32, ball: &ViewSphere) {
        // Take the texels of the row that the ball may cover.
        let (lens, up) = (*self.lens, self.up[row]);
        let here = |list: &RangeInclusive<usize>| {
            row * TILE_COLUMNS + list.start()..=row * TILE_COLUMNS + list.end()
        };
        let texels = self.depths[here(&columns)]
            .iter_mut()
            .zip(&mut self.ids[here(&columns)])
            .zip(&self.across[columns.clone()]);

        // Keep the ball where it is the nearest, by the depth of its kind of view.
        if lens.discs > 0.5 {
            for ((nearest, holder), across) in texels {
                keep(lens.depth_of(ball, [*across, up]), id, nearest, holder);
            }
        } else if lens.perspective > 0.5 {
            let scales = &self.scales[here(&columns)];
            for (((nearest, holder), across), scale) in texels.zip(scales) {
                let depth = depth_meeting(&lens, ball, [*across, up], *scale);
                keep(depth, id, nearest, holder);
            }
        } else {
            for ((nearest, holder), across) in texels {
                let depth = depth_parallel(&lens, ball, [*across, up]);
                keep(depth, id, nearest, holder);
            }
        }
    }

    /// Zeroes the tile in its band. Memory that holds zeros already is only read, which takes half the time.
    fn wipe(&self, texels: &mut [u32]) {
        let width = self.window.size[0] as usize;
        for row in texels.chunks_mut(width) {
            let row = &mut row[self.left..self.left + self.columns];
            if row.iter().fold(0, |all, texel| all | texel) != 0 {
                row.fill(0);
            }
        }
    }

    /// Writes the tile to its band, depths reversed.
    fn store(&self, ids: &mut [u32], depths: &mut [u32]) {
        let width = self.window.size[0] as usize;
        for row in 0..self.rows {
            let (from, to) = (row * TILE_COLUMNS, row * width + self.left);
            for column in 0..self.columns {
                let id = self.ids[from + column];
                let depth = self.lens.reversed(self.depths[from + column]).min(1.0);
                let shows = (id != 0) & (depth > 0.0);
                ids[to + column] = if shows { id } else { 0 };
                depths[to + column] = if shows { depth.to_bits() } else { 0 };
            }
        }
    }
}

/// [`SphereView::depth_of_sphere`] for rays that meet at the eye, bit for bit, given one over the ray's squared length.
#[inline]
fn depth_meeting(lens: &SphereView, ball: &ViewSphere, [x, y]: [f32; 2], scale: f32) -> f32 {
    let offset = ball.center;
    let middle = (offset[0] * x + offset[1] * y + offset[2]) * scale;
    let beside = [
        offset[0] - middle * x,
        offset[1] - middle * y,
        offset[2] - middle,
    ];
    let left = ball.radius * ball.radius
        - (beside[0] * beside[0] + beside[1] * beside[1] + beside[2] * beside[2]);
    let depth = middle - (left.max(0.0) * scale).sqrt();
    if (left > 0.0) & (depth >= lens.near) {
        depth
    } else {
        FAR_DEPTH
    }
}

/// [`SphereView::depth_of_sphere`] for parallel rays, bit for bit, without the terms that are 0 there.
#[inline]
fn depth_parallel(lens: &SphereView, ball: &ViewSphere, ray: [f32; 2]) -> f32 {
    let beside = [ball.center[0] - ray[0], ball.center[1] - ray[1]];
    let left = ball.radius * ball.radius - (beside[0] * beside[0] + beside[1] * beside[1]);
    let depth = ball.center[2] - left.max(0.0).sqrt();
    if (left > 0.0) & (depth >= lens.near) {
        depth
    } else {
        FAR_DEPTH
    }
}

/// The greatest of some depths, computed in lanes.
fn farthest(depths: &[f32]) -> f32 {
    let mut lanes = [f32::MIN; 8];
    for depths in depths.chunks_exact(8) {
        for (lane, depth) in lanes.iter_mut().zip(depths) {
            *lane = if *depth > *lane { *depth } else { *lane };
        }
    }
    lanes.into_iter().fold(f32::MIN, f32::max)
}

/// Keeps the nearer of two balls at a texel, and of two equally near ones the earlier.
#[inline]
fn keep(depth: f32, id: u32, nearest: &mut f32, holder: &mut u32) {
    let wins = (depth < *nearest) | ((depth == *nearest) & (id < *holder));
    *nearest = if wins { depth } else { *nearest };
    *holder = if wins { id } else { *holder };
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::camera::{Camera, Projection};
    use proptest::prelude::*;

    const SIZE: [u32; 2] = [150, 37];

    fn lens(parallel: bool) -> SphereView {
        let projection = match parallel {
            true => Projection::Parallel { height: 3.0 },
            false => Projection::Perspective { fov_y: 0.8 },
        };
        let camera = Camera {
            eye: [1.0, 2.0, 6.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection,
        };
        SphereView::of_view(&camera.view([300, 200], ([-2.5; 3], [2.5; 3])))
    }

    fn balls_of(lens: &SphereView, spheres: &[([f32; 3], f32)]) -> Vec<ViewSphere> {
        let of = |(center, radius): &([f32; 3], f32)| lens.project(&Sphere::new(*center, *radius));
        spheres.iter().map(of).collect()
    }

    fn draw(lens: &SphereView, window: &Window, balls: &[ViewSphere]) -> (Vec<u32>, Vec<u32>) {
        let count = (window.size[0] * window.size[1]) as usize;
        let (mut ids, mut depths) = (vec![7; count], vec![7; count]);
        draw_spheres(lens, window, balls, &mut ids, &mut depths);
        (ids, depths)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Every pixel asked of every ball.
        #[test]
        fn tiles_give_what_every_ray_sees(
            parallel: bool, discs: bool, origin in prop::array::uniform2(-20f32..150.0), step in 0.3f32..2.0,
            spheres in prop::collection::vec((prop::array::uniform3(-2f32..2.0), 0f32..1.2), 0..12),
        ) {
            let mut lens = lens(parallel);
            lens.discs = f32::from(discs);
            let extent = SIZE.map(|side| side as f32 * step);
            let window = Window::over([300.0, 200.0], origin, extent, SIZE);
            let balls = balls_of(&lens, &spheres);
            let (ids, depths) = draw(&lens, &window, &balls);
            for y in 0..SIZE[1] {
                for x in 0..SIZE[0] {
                    let px = window.frame_at(x, y);
                    if !(0.0..=300.0).contains(&px[0]) || !(0.0..=200.0).contains(&px[1]) {
                        // Nothing is promised beyond the frame.
                        continue;
                    }
                    let ray = lens.ray(px);
                    let (mut best, mut nearest) = (0, FAR_DEPTH);
                    for (i, ball) in balls.iter().enumerate() {
                        let depth = lens.depth_of(ball, ray);
                        if depth < nearest {
                            (best, nearest) = (i as u32 + 1, depth);
                        }
                    }
                    if best != 0 && lens.reversed(nearest) <= 0.0 {
                        // Beyond the far plane of a parallel view.
                        best = 0;
                    }
                    let at = (y * SIZE[0] + x) as usize;
                    prop_assert_eq!(ids[at], best);
                    let depth = if best == 0 { 0.0 } else { lens.reversed(nearest).min(1.0) };
                    prop_assert_eq!(depths[at], depth.to_bits());
                }
            }
        }
    }

    #[test]
    fn of_twins_the_first_shows_and_empty_windows_are_left_alone() {
        let lens = lens(false);
        let twins = balls_of(&lens, &[([0.0; 3], 1.0), ([0.0; 3], 1.0)]);
        let window = Window::over([300.0, 200.0], [0.0; 2], [300.0, 200.0], SIZE);
        let (ids, _) = draw(&lens, &window, &twins);
        assert!(ids.contains(&1) && !ids.contains(&2));
        let empty = Window::over([300.0, 200.0], [0.0; 2], [1.0; 2], [0, 0]);
        assert!(draw(&lens, &empty, &twins).0.is_empty());
    }
}
