//! Passes that find the visible samples of lines on a frame's G-buffer.

use super::sums::{Compacted, add_compact};
use super::work::ListWork;
use crate::graph::{Graph, ResourceId};
use crate::passes::vector;

/// Samples of lines, and the frame that they lie in.
#[derive(Debug, Clone, Copy)]
pub struct SampledFrame {
    /// [`View`](npr_core::window::View).
    pub view: ResourceId,
    /// [`Window`](npr_core::window::Window) of the G-buffer.
    pub window: ResourceId,
    /// [`GPixel`](npr_core::geometry::GPixel)s.
    pub gbuffer: ResourceId,
    /// [`SpineSample`](npr_vector::mesh_lines::sample::SpineSample)s.
    pub samples: ResourceId,
    /// Where each line starts among the samples; one more than there are lines.
    pub line_starts: ResourceId,
    /// Number of samples on either side over which shares are averaged, a uniform.
    pub radius: ResourceId,
}

/// Appends passes that find whether every sample is visible; gives a buffer of `u32`, 1 or 0.
///
/// The result is that of [`visible_samples`](npr_vector::mesh_lines::sample::visible_samples) of
/// [`sample_visibility`](npr_vector::mesh_lines::sample::sample_visibility). Takes seven passes up to 4096 samples, and
/// 28 bytes for each besides itself.
pub fn add_sampling(graph: &mut Graph, on: &SampledFrame) -> ResourceId {
    // Look at every sample from the eye.
    let count = graph.element_count(on.samples);
    let shares = graph.buffer::<f32>("visible shares", count);
    let looked_at = [on.view, on.window, on.gbuffer, on.samples, shares];
    graph.compute(&vector::SAMPLE_VISIBILITY, &looked_at);

    // Weigh what is seen, and find the samples whose verdict is clear.
    let verdicts = graph.buffer::<u32>("verdicts", count);
    let clear = graph.buffer::<u32>("clear samples", count);
    let weighed = [
        on.radius,
        on.samples,
        on.line_starts,
        shares,
        verdicts,
        clear,
    ];
    graph.compute(&vector::WEIGH_SAMPLES, &weighed);

    // Let every other sample show what the last clear one before it shows.
    let Compacted { list, slots, .. } = add_compact(graph, clear, count, &ListWork::WHOLE);
    let visible = graph.buffer::<u32>("visible samples", count);
    let filtered = [verdicts, clear, slots, list, visible];
    graph.compute(&vector::FILTER_VISIBILITY, &filtered);
    visible
}
