//! Passes that find the visible parts of lines in a frame, and ink them.

use super::sums::{Compacted, add_compact};
use super::work::ListWork;
use crate::graph::{Graph, ResourceId};
use crate::passes::stroke;
use npr_vector::ink_point::InkPoint;

/// Samples of lines, and the frame that they lie in.
#[derive(Debug, Clone, Copy)]
pub struct SampledFrame {
    /// [`View`](npr_core::window::View).
    pub view: ResourceId,
    /// [`Window`](npr_core::window::Window) of the grid of `ids`.
    pub window: ResourceId,
    /// Number of the triangle at every pixel.
    pub ids: ResourceId,
    /// [`PosedVertex`](npr_core::geometry::PosedVertex)es.
    pub posed: ResourceId,
    /// [`Triangle`](npr_core::geometry::Triangle)s.
    pub triangles: ResourceId,
    /// [`SpineSample`](npr_vector::sampled::SpineSample)s, an even number.
    pub samples: ResourceId,
    /// [`SampledLine`](npr_vector::sampled::SampledLine)s; the last, without width, fills the buffer of samples.
    pub lines: ResourceId,
    /// [`PartWidths`](npr_vector::sampled::PartWidths), of which every line names one.
    pub widths: ResourceId,
}

/// Appends passes that find which parts of lines are visible; gives a buffer of
/// [`InkPoint`]s, one for every two samples.
///
/// The result is that of [`inked`](npr_vector::sampled::inked) of
/// [`visible_samples`](npr_vector::sampled::visible_samples) of [`see_samples`](npr_vector::sampled::see_samples).
/// Takes 13 passes up to 262144 samples, and 56 bytes for each besides itself.
pub fn add_sampling(graph: &mut Graph, on: &SampledFrame) -> ResourceId {
    // Look at every sample from the eye.
    let count = graph.element_count(on.samples);
    let gaps = graph.buffer::<f32>("gaps before samples", count);
    let seen = [
        on.view,
        on.window,
        on.ids,
        on.posed,
        on.triangles,
        on.samples,
        gaps,
    ];
    graph.compute(&stroke::SEE_SAMPLES, &seen);

    // Weigh what is seen, and find the samples whose verdict is clear.
    let verdicts = graph.buffer::<u32>("verdicts", count);
    let clear = graph.buffer::<u32>("clear samples", count);
    let weighed = [on.widths, on.samples, on.lines, gaps, verdicts, clear];
    graph.compute(&stroke::WEIGH_SAMPLES, &weighed);

    // Let every other sample show what the last clear one before it shows.
    let Compacted { list, slots, .. } = add_compact(graph, clear, count, &ListWork::WHOLE);
    let visible = graph.buffer::<u32>("visible samples", count);
    let filtered = [verdicts, clear, slots, list, visible];
    graph.compute(&stroke::FILTER_VISIBILITY, &filtered);

    // Find where parts begin, and ink those that are seen.
    let starts = graph.buffer::<u32>("starts of parts", count);
    graph.compute(&stroke::PART_SAMPLES, &[on.samples, visible, starts]);
    let Compacted { list, slots, .. } = add_compact(graph, starts, count, &ListWork::WHOLE);
    let points = graph.buffer::<InkPoint>("points of samples", count / 2);
    let inked = [
        on.view, on.widths, on.lines, on.samples, gaps, visible, slots, list, points,
    ];
    graph.compute(&stroke::INK_SAMPLES, &inked);
    points
}
