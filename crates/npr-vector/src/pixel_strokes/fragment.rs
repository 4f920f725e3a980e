//! Segments to pixels: the twins of `vector.emit_fragments`, `vector.test_fragments` and `vector.draw_nearest`.

use super::segment::{PixelView, Segment, reciprocal};
use bytemuck::{Pod, Zeroable};
use npr_core::geometry::NONE;
use npr_core::gpu_layout;
use rayon::prelude::*;

/// Pixels whose ink shares a word: a bit each, that of the first lowest.
pub const BITS_A_WORD: usize = 32;

/// A step of a segment along its longer axis.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Fragment {
    /// Pixel of the picture, row by row from the top.
    pub pixel: u32,
    /// Reversed depth.
    pub z: f32,
    /// Its segment; direction, kind and mesh edge are the segment's.
    pub segment: u32,
}
gpu_layout!(Fragment { pixel, z, segment });

/// The last element of ascending `starts` that is not above `value`: the element whose range holds that place. 0 if
/// there is none.
///
/// O(log n).
pub fn holder_of(starts: &[u32], value: u32) -> u32 {
    let (mut low, mut high) = (0, starts.len() as u32);
    while low + 1 < high {
        let middle = low + (high - low) / 2;
        if starts[middle as usize] <= value {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Places every fragment: the second pass of parallel line drawing [Jiang et al. 2022, Bresenham in two passes].
///
/// `starts` is the scan of the counts of fragments of the first `segment_count[0]` segments, and `extent[0]` their
/// sum. Positions lie on centres of the fine grid along the longer axis; reversed depth is linear. A fragment beyond
/// the sum has [`NONE`] for its pixel.
pub fn emit_fragments(
    view: &PixelView,
    extent: &[u32],
    segment_count: &[u32],
    starts: &[u32],
    segments: &[Segment],
    fragments: &mut [Fragment],
) {
    let starts = &starts[..starts.len().min(segment_count[0] as usize)];
    let outputs = fragments.par_iter_mut().with_min_len(1024).enumerate();
    outputs.for_each(|(element, fragment)| {
        let element = element as u32;
        fragment.pixel = NONE;
        if element < extent[0] {
            let number = holder_of(starts, element);
            let step = element - starts[number as usize];
            *fragment = fragment_of(view, &segments[number as usize], step);
            fragment.segment = number;
        }
    });
}

/// Fragment `step` of a segment.
fn fragment_of(view: &PixelView, segment: &Segment, step: u32) -> Fragment {
    let [dx, dy] = segment.extent();
    let is_x_major = dx.abs() >= dy.abs();
    let (start, length) = if is_x_major {
        (segment.start[0], dx)
    } else {
        (segment.start[1], dy)
    };
    let sign = if length < 0.0 { -1.0 } else { 1.0 };
    let center = start.floor() + sign * step as f32 + 0.5;
    // A segment of no length is its first point.
    let share = if length == 0.0 {
        0.0
    } else {
        ((center - start) * reciprocal(length)).clamp(0.0, 1.0)
    };
    let x = segment.start[0] + dx * share;
    let y = segment.start[1] + dy * share;
    let place = if is_x_major { [center, y] } else { [x, center] };
    let r = reciprocal(view.fine);
    let [column, row] = [0, 1].map(|axis| {
        let step = place[axis].max(0.0).floor() + 0.5;
        ((step * r).floor() as u32).min(view.size[axis].saturating_sub(1))
    });
    Fragment {
        pixel: row * view.size[0] + column,
        z: segment.start_z + (segment.end_z - segment.start_z) * share,
        segment: 0,
    }
}

/// Whether each fragment shows, and which pixels these ink: the soft test against the depths of the pixels around it.
///
/// `scene` holds the reversed depths of all surfaces, 0 where there is nothing, and those of occluders before them; a
/// second list of another length counts as none. A pixel shows a fragment that lies at most the view's tolerance behind
/// it; at least `least_visible` of the nine pixels around must show it. `ink` holds zeros, or what showed before: a bit
/// for each pixel, [`BITS_A_WORD`] a word.
pub fn test_fragments(
    view: &PixelView,
    scene: [&[f32]; 2],
    fragments: &[Fragment],
    shown: &mut [u32],
    ink: &mut [u32],
) {
    // Test the fragments.
    let outputs = shown.par_iter_mut().with_min_len(1024).zip(fragments);
    outputs.for_each(|(shown, fragment)| {
        *shown = 0;
        if fragment.pixel != NONE {
            let count = showing_pixels(view, scene, fragment);
            *shown = u32::from(count >= view.least_visible);
        }
    });

    // Ink the pixels of those that show.
    for (fragment, _) in fragments
        .iter()
        .zip(shown)
        .filter(|(_, shown)| **shown != 0)
    {
        let pixel = fragment.pixel as usize;
        ink[pixel / BITS_A_WORD] |= 1 << (pixel % BITS_A_WORD);
    }
}

/// How many of the nine pixels around a fragment show it.
fn showing_pixels(
    view: &PixelView,
    [surfaces, occluder_depths]: [&[f32]; 2],
    fragment: &Fragment,
) -> u32 {
    // Take the depth of the fragment, and whether there are occluders.
    let [width, height] = view.size;
    let is_occluded = occluder_depths.len() == surfaces.len();
    let (column, row) = (fragment.pixel % width, fragment.pixel / width);
    let depth = view.depth_of(fragment.z);

    // Count the pixels that nothing before the fragment fills.
    let mut count = 0;
    for y in row.max(1) - 1..(row + 2).min(height) {
        for x in column.max(1) - 1..(column + 2).min(width) {
            let at = (y * width + x) as usize;
            let z = if is_occluded {
                surfaces[at].max(occluder_depths[at])
            } else {
                surfaces[at]
            };
            let is_free = z <= 0.0 || depth <= view.depth_of(z) + view.tolerance;
            count += u32::from(is_free);
        }
    }
    count
}

/// The hard test: the nearest fragment of every pixel, as the number of its segment plus one.
///
/// `owners` and `nearest`, its reversed depth as bits, hold zeros, or what was drawn before. Of fragments at one depth
/// the first wins, which is the edge that comes first in the mesh, so the result does not depend on timing.
/// O(fragments).
///
/// Differs: the publication's fragments race for a lock, so the order of its pixels changes from run to run.
pub fn draw_nearest(
    fragments: &[Fragment],
    shown: &[u32],
    owners: &mut [u32],
    nearest: &mut [u32],
) {
    for (fragment, shown) in fragments.iter().zip(shown) {
        let pixel = fragment.pixel as usize;
        if *shown == 0 || pixel >= owners.len() {
            continue;
        }
        // Bits of numbers that are not negative sort as the numbers do.
        let z = fragment.z.max(LEAST_Z).to_bits();
        if z > nearest[pixel] {
            (owners[pixel], nearest[pixel]) = (fragment.segment + 1, z);
        }
    }
}

/// Stands for reversed depth 0, which is infinitely far: a fragment there is still nearer than nothing.
pub const LEAST_Z: f32 = 1e-30;
