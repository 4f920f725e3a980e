//! Bitmaps to smooth closed curves, by the method of Potrace [Selinger 2003].
//!
//! Each stage is a function usable alone: [`decompose()`] finds the closed paths along pixel edges, [`nest()`] which
//! lies in which, [`optimal_polygon`] the polygon with the fewest sides near a path (by way of [`straight_lengths`]),
//! [`adjust_corners`] moves its corners to where the sides meet best, [`bends`] tells corners from arcs, [`curve()`]
//! makes segments of them, and [`join_arcs`] joins arcs to fewer. [`trace`] does it all, on all threads, and
//! [`write_tracing`] makes files of it. Pictures of few colours become a stack of bitmaps by [`layers`], and files by
//! [`trace_colors_to_file`]. Drawn lines become single strokes along their middle by [`centreline`].
//!
//! Written from the paper. What it leaves open is decided by mathematics, or so that results equal those of the
//! program Potrace, run and measured as a whole; each such place says so.
//!
//! ```
//! use npr_trace::{Bitmap, TraceOptions, trace};
//!
//! // A square of ink with a hole.
//! let mut bitmap = Bitmap::new(12, 12)?;
//! for (x, y) in (0..100).map(|i| (1 + i % 10, 1 + i / 10)) {
//!     bitmap.set(x, y, !((4..8).contains(&x) && (4..8).contains(&y)));
//! }
//! let tracing = trace(&bitmap, &TraceOptions::default());
//! let [shape, hole] = &tracing.paths[..] else { panic!("two paths") };
//! assert!(shape.is_ink && shape.parent.is_none() && shape.area == 100);
//! assert!(!hole.is_ink && hole.parent == Some(0) && hole.area == 16);
//! assert_eq!(shape.segments.len(), 4);
//! # Ok::<(), npr_trace::BitmapError>(())
//! ```

mod adjust;
mod batches;
mod bitmap;
pub mod centreline;
mod color_file;
mod colors;
mod curve;
mod decompose;
mod edges;
mod file;
mod flat;
mod format;
mod huge_buffer;
mod join;
mod nest;
mod paths;
mod pdf;
mod pen;
mod polygon;
mod straight;
mod strip;
pub mod svg_path;
#[cfg(test)]
mod tests;
mod turn;
mod work_queue;

pub use adjust::adjust_corners;
pub use bitmap::{Bitmap, BitmapError, SIDE_LIMIT};
pub use color_file::trace_colors_to_file;
pub use colors::{ColorLayer, IndexPicture, IndexPictureError, Layers, layers, stacking_order};
pub use curve::{Bend, Segment, bends, curve};
pub use decompose::{Decomposition, Loops, PixelLoop, STEPS, decompose};
pub use file::{trace_to_file, write_tracing};
pub use flat::{FLATNESS_PX, flattened};
pub use format::TraceFormat;
pub use join::join_arcs;
pub use nest::nest;
pub use polygon::optimal_polygon;
pub use straight::straight_lengths;
pub use turn::TurnPolicy;

use batches::Batches;
use glam::DVec2;
use pen::Pen;
use std::borrow::Borrow;
use std::sync::{Arc, mpsc};
use work_queue::WorkQueue;

/// How a bitmap is traced; names and defaults are those of the program Potrace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceOptions {
    /// Paths with up to so many pixels inside are left out.
    pub turd_size: u64,
    /// Which way paths turn at ambiguous corners.
    pub turn_policy: TurnPolicy,
    /// From which sharpness on a bend is a corner, see [`bends`]: 0 makes polygons, more than 4/3 rounds all.
    pub alpha_max: f64,
    /// How far, in pixels, an arc may lie from those it joins; see [`join_arcs`]. None joins none.
    pub join_tolerance: Option<f64>,
}

impl Default for TraceOptions {
    fn default() -> Self {
        Self {
            turd_size: 2,
            turn_policy: TurnPolicy::default(),
            alpha_max: 1.0,
            join_tolerance: Some(0.2),
        }
    }
}

/// What was found in a bitmap.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tracing {
    /// Width and height of the bitmap, in pixels.
    pub size: [u32; 2],
    /// Outlines of shapes and holes by the places of their uppermost, then leftmost corners: each after those around
    /// it.
    pub paths: Vec<TracedPath>,
}

/// The outline of a shape or of a hole.
#[derive(Debug, Clone, PartialEq)]
pub struct TracedPath {
    /// Whether it goes around ink; else around a hole.
    pub is_ink: bool,
    /// Pixels inside, those of holes and of shapes within them included.
    pub area: u64,
    /// Number of the innermost path around it: a hole for ink, if any, and ink for a hole.
    pub parent: Option<u32>,
    /// The closed curve, with ink on its left; pixels, y down. The first segment starts where the last one ends.
    pub segments: Vec<Segment>,
}

/// Traces a bitmap.
///
/// Paths are found one after the other in one thread, while the others already turn found ones to curves; the same
/// for any number of threads. Time grows with the paths' length. No path where there is no ink.
pub fn trace(bitmap: &Bitmap, options: &TraceOptions) -> Tracing {
    // Find the loops, and turn them into curves meanwhile.
    let size = [bitmap.width(), bitmap.height()];
    let (Found { loops, parents }, curves) =
        found(bitmap, options, usize::MAX, |outliner, batch| {
            let curves = batch.iter().map(|pixels| {
                let mut segments = Vec::new();
                outliner.outline(&pixels, &mut segments);
                segments
            });
            curves.collect::<Vec<_>>()
        });

    // Join every loop with its parent and its curves.
    let curves = curves.into_iter().flat_map(|(_, curves)| curves);
    let parents = parents.into_iter();
    let parents = parents.map(|parent| (parent != nest::NONE).then_some(parent));
    let paths = loops.iter().zip(parents).zip(curves);
    let paths = paths.map(|((pixels, parent), segments)| TracedPath {
        is_ink: pixels.is_ink,
        area: pixels.area,
        parent,
        segments,
    });
    Tracing {
        size,
        paths: paths.collect(),
    }
}

/// The loops of a bitmap.
struct Found {
    loops: Batches,
    /// For each the innermost around it, or [`nest::NONE`].
    parents: Vec<u32>,
}

/// The loops of a bitmap, and what `each` makes of the first of them while others are still looked for: of as many
/// batches as have no more than `early_steps` steps, with the number of each one's first loop.
fn found<T: Send>(
    bitmap: impl Borrow<Bitmap> + Send,
    options: &TraceOptions,
    early_steps: usize,
    each: impl Fn(&mut Outliner, &Loops) -> T + Sync,
) -> (Found, Vec<(usize, T)>) {
    let (sender, receiver) = mpsc::channel();
    let work_queue = WorkQueue::new(rayon::current_num_threads() - 1);
    let outliner = || {
        // Its memory goes from batch to batch.
        let mut outliner = Outliner::new(options);
        let (sender, each) = (&sender, &each);
        move |(first, batch): (usize, Arc<Loops>)| {
            // The receiver lives until all is sent.
            let _ = sender.send((first, each(&mut outliner, &batch)));
        }
    };
    let found = rayon::scope(|scope| {
        let call_worker = || {
            if work_queue.enter() {
                scope.spawn(|_| work_queue.work(outliner()));
            }
        };
        call_worker();
        let mut loops = Batches::default();
        let seen: &Bitmap = bitmap.borrow();
        let size = [seen.width(), seen.height()];
        let mut decomposition = Decomposition::new(seen, options.turn_policy, options.turd_size);
        for batch in decomposition.by_ref() {
            let first = loops.len();
            let batch = loops.push(batch);
            if loops.step_count() <= early_steps {
                work_queue.put((first, batch));
                call_worker();
            }
        }
        work_queue.close();
        // The other threads are at work still, while its memory is given back.
        let words = decomposition.into_words();
        drop(bitmap);
        let parents = nest::parents(size, loops.iter(), words);
        work_queue.finish(outliner());
        Found { loops, parents }
    });
    drop(sender);
    let mut made: Vec<(usize, T)> = receiver.into_iter().collect();
    made.sort_unstable_by_key(|(first, _)| *first);
    (found, made)
}

/// Steps of loops after which memory is not kept for the next one.
const LONG_STEPS: usize = 1 << 18;

/// Makes curves of loops, with its memory kept from one to the next.
struct Outliner {
    options: TraceOptions,
    search: polygon::Search,
    corners: Vec<DVec2>,
    joiner: join::Joiner,
}

impl Outliner {
    fn new(options: &TraceOptions) -> Self {
        Self {
            options: *options,
            search: polygon::Search::default(),
            corners: Vec::new(),
            joiner: join::Joiner::default(),
        }
    }

    /// Draws the curve of a loop.
    fn outline(&mut self, pixels: &PixelLoop<'_>, pen: &mut impl Pen) {
        self.search.run(pixels.steps);
        let is_long = pixels.steps.len() > LONG_STEPS;
        if is_long {
            self.search.keep_polygon();
        }
        adjust::adjust_into(pixels, &self.search.polygon, &mut self.corners);
        if is_long {
            self.search = polygon::Search::default();
        }
        if !pixels.is_ink {
            // So that ink lies on the left of every curve.
            self.corners.reverse();
        }
        self.draw(pen);
        if is_long {
            self.corners = Vec::new();
        }
    }

    fn draw(&mut self, pen: &mut impl Pen) {
        let corners = &self.corners;
        let [Some(first), Some(last)] = [corners.first(), corners.last()] else {
            return;
        };
        let bend = |index| curve::bend_at(corners, index, self.options.alpha_max);
        match self.options.join_tolerance {
            Some(tolerance) if corners.len() > 2 => {
                pen.begin(first.midpoint(corners[1]));
                let draw = |segment| pen.draw(segment);
                self.joiner.run(corners.len(), bend, tolerance, draw);
            }
            _ => {
                pen.begin(last.midpoint(*first));
                curve::draw_curve(corners.len(), bend, |segment| pen.draw(segment));
            }
        }
        pen.end();
    }
}
