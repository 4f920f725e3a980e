//! After-images: outlines of where things were, behind them.
//!
//! What moves is drawn on a grid as it stood at a moment before, and the border of all of it is traced. An outline is
//! hidden by what moves, by later after-images, and by what stands before it.

use super::seen::Seen;
use super::sort::MotionStrokes;
use crate::movement::Movement;
use glam::{DVec2, Vec2};
use npr_stylesheet::Style;
use npr_trace::{Bitmap, TraceOptions, flattened, trace};
use npr_vector::stroke::StrokePoint;

/// Name of the object whose strokes they are.
const OBJECT: &str = "after-images";

/// Cells within which an outline beside what hides it is hidden, too: lines that nearly touch would clot.
const CLEARANCE_CELLS: i32 = 5;

/// Shortest piece of an outline that is drawn, as a share of the picture's height.
const SHORTEST_SHARE: f32 = 0.03;

/// Share of a piece that thins out at either end.
const TAPER_SHARE: f32 = 0.25;

/// Width of the latest outline, as a share of that of lines.
const WIDTH_SHARE: f32 = 0.8;

/// The after-images in a picture of `size` pixels, the oldest first: one sort of strokes for each.
pub(super) fn find(
    seen: &Seen<'_>,
    movement: &Movement,
    style: &Style,
    (size, dpi): ([u32; 2], f32),
) -> Vec<MotionStrokes> {
    // Trace them from the latest on, each hidden by those before it.
    let motion = &style.motion;
    let cells = seen.size[0] as usize * seen.size[1] as usize;
    let mut covered: Vec<bool> = (0..cells).map(|cell| seen.is_mover(cell)).collect();
    let height_px = size[1] as f32;
    let base_px = style
        .line
        .scaled(style.line.width.base)
        .to_px(height_px, dpi, seen.world_px);
    let mut sorts = Vec::new();
    for number in 1..=motion.ghosts {
        let depths = seen.movers_at(&movement.places_before(motion.ghost_s(number)));
        let left = 1.0 - number as f32 / (motion.ghosts + 1) as f32;
        let ghost = Ghost {
            seen,
            depths: &depths,
            covered: &covered,
            height_px,
            width_px: WIDTH_SHARE * base_px * (0.4 + 0.6 * left),
            color: {
                let color = motion.color;
                let alpha = (f32::from(color.a) * (0.25 + 0.75 * left) + 0.5) as u8;
                [color.r, color.g, color.b, alpha]
            },
        };
        let first = u64::from(number) << 40;
        sorts.push(MotionStrokes {
            names: [OBJECT.to_owned(), number.to_string()],
            strokes: (first..).zip(ghost.drawn()).collect(),
        });
        for (covered, depth) in covered.iter_mut().zip(&depths) {
            *covered |= *depth > 0.0;
        }
    }
    sorts.reverse();
    sorts
}

/// One after-image.
struct Ghost<'a> {
    seen: &'a Seen<'a>,
    /// Reversed depths of what moves, where it was; 0 where none of it was.
    depths: &'a [f32],
    /// Cells that hide it.
    covered: &'a [bool],
    height_px: f32,
    width_px: f32,
    color: [u8; 4],
}

impl Ghost<'_> {
    /// The pieces of its outline that are seen.
    fn drawn(&self) -> Vec<Vec<StrokePoint>> {
        let [width, height] = self.seen.size;
        let Ok(mut bitmap) = Bitmap::new(width, height) else {
            return Vec::new();
        };
        for (cell, depth) in (0u32..).zip(self.depths) {
            bitmap.set(cell % width, cell / width, *depth > 0.0);
        }
        let tracing = trace(&bitmap, &TraceOptions::default());
        let rings = tracing.paths.iter().filter(|path| path.is_ink);
        let pieces = rings.flat_map(|path| self.pieces(&flattened(&path.segments)));
        pieces.map(|piece| self.stroke(&piece)).collect()
    }

    /// The runs of a ring that are seen, in pixels of the picture with their depths along the view axis.
    fn pieces(&self, ring: &[DVec2]) -> Vec<Vec<(Vec2, f32)>> {
        // Set places a cell or two apart on it.
        let step_px = self.seen.step_px();
        let mut places: Vec<Vec2> = Vec::new();
        for pair in ring.windows(2) {
            let count = ((pair[1] - pair[0]).length() / 2.0).ceil().max(1.0) as usize;
            let between = (0..count).map(|i| pair[0].lerp(pair[1], i as f64 / count as f64));
            places.extend(between.map(|place| place.as_vec2() * step_px));
        }

        // Keep what is seen, from a place that is not, if there is one.
        let depths: Vec<Option<f32>> = places.iter().map(|place| self.depth_at(*place)).collect();
        let first = depths.iter().position(Option::is_none).unwrap_or(0);
        let mut pieces: Vec<Vec<(Vec2, f32)>> = vec![Vec::new()];
        for i in 0..places.len() {
            let i = (first + i) % places.len();
            match (depths[i], pieces.last_mut()) {
                (Some(depth), Some(piece)) => piece.push((places[i], depth)),
                _ => pieces.push(Vec::new()),
            }
        }
        let length = |piece: &[(Vec2, f32)]| -> f32 {
            let pairs = piece.windows(2);
            pairs.map(|pair| pair[0].0.distance(pair[1].0)).sum()
        };
        pieces.retain(|piece| piece.len() > 2 && length(piece) > SHORTEST_SHARE * self.height_px);
        pieces
    }

    /// The reversed depth of the outline at a place; none where it is hidden, or at the border of the picture.
    fn depth_at(&self, place: Vec2) -> Option<f32> {
        let [width, height] = self.seen.size.map(|side| side as i32);
        let cell = self.seen.cell(place)? as i32;
        let [x, y] = [cell % width, cell / width];
        if x < 1 || y < 1 || x + 1 >= width || y + 1 >= height {
            return None;
        }
        let at = |dx: i32, dy: i32| {
            let [x, y] = [(x + dx).clamp(0, width - 1), (y + dy).clamp(0, height - 1)];
            (y * width + x) as usize
        };

        // Take the depth of what was beside it.
        let beside = [-1, 0, 1].map(|dy| [-1, 0, 1].map(|dx| self.depths[at(dx, dy)]));
        let depth = beside.into_iter().flatten().fold(0.0, f32::max);
        let reach = CLEARANCE_CELLS;
        let around = [-reach, 0, reach].map(|dy| [-reach, 0, reach].map(|dx| at(dx, dy)));
        let mut around = around.into_iter().flatten();
        let is_covered = around.any(|cell| self.covered[cell]);
        (depth > 0.0 && !is_covered && !self.seen.is_hidden(cell as usize, depth)).then_some(depth)
    }

    /// A piece as a stroke that thins out at its ends.
    fn stroke(&self, piece: &[(Vec2, f32)]) -> Vec<StrokePoint> {
        let mut along = vec![0.0];
        for pair in piece.windows(2) {
            along.push(along[along.len() - 1] + pair[0].0.distance(pair[1].0));
        }
        let whole = along[along.len() - 1];
        let taper = TAPER_SHARE * whole;
        let points = piece.iter().zip(&along);
        points
            .map(|((place, reversed), along)| {
                let thin = (along.min(whole - along) / taper).clamp(0.0, 1.0);
                let world = self.seen.world_at(*place, *reversed);
                StrokePoint {
                    position: place.to_array().map(f64::from),
                    depth: f64::from(self.seen.depth(world)),
                    width: f64::from(self.width_px * thin),
                    u: f64::from(*along),
                    world: world.to_array(),
                    color: Some(self.color),
                    ..StrokePoint::default()
                }
            })
            .collect()
    }
}
