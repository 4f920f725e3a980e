//! Whether a triangle seen beside a sample hides it: the twin of `stroke.see_samples`.

use super::SpineSample;
use npr_core::geometry::{PosedVertex, Triangle};
use npr_core::raster::{HULL_BIT, ID_MASK};
use npr_core::surface::{blend, weights_around};
use npr_core::window::{View, Window};
use rayon::prelude::*;

/// Difference of plane coordinates, as a share of them, that rounding explains.
const DEPTH_ROUNDING: f32 = 1.0 / 32768.0;

/// Number of pixels by which a place may be off, for rounding: on a steep slope that is depth.
const PLACE_ROUNDING: f32 = 0.02;

/// Least weight of a corner where a triangle still covers a place, for rounding.
const LEAST_WEIGHT: f32 = -1e-5;

/// Pixels of depth, and of slope, by which all triangles around lie in front of what they hide without covering it.
const CLEARLY_PX: f32 = 0.5;

/// Steepest slope that counts there, in depth per pixel of a pixel's size.
const STEEPEST: f32 = 8.0;

/// Least distance from what hides a sample, in sizes of a pixel: 0 says that nothing does.
const LEAST_GAP: f32 = 1e-6;

/// The picture that samples are tested on.
#[derive(Debug, Clone, Copy)]
pub struct Scenery<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The pixel grid of `ids`.
    pub window: &'a Window,
    /// Number of the triangle at every pixel, from 1; 0 for none.
    pub ids: &'a [u32],
    /// Posed vertices.
    pub posed: &'a [PosedVertex],
    /// Triangles.
    pub triangles: &'a [Triangle],
}

/// Writes for every sample how far in front of it lies what hides it, in sizes of a pixel; 0 where nothing does.
///
/// The triangles of the nine pixels around are tested where the spine runs, not where the pixels' middles are: one
/// that covers the sample decides exactly. Where triangles are so small that none of the nine covers it, it is hidden
/// if all of them lie clearly in front. A triangle that the line lies in is neither before nor behind it. O(samples),
/// parallel.
pub fn see_samples(on: &Scenery<'_>, samples: &[SpineSample], gaps: &mut [f32]) {
    let pairs = gaps.par_iter_mut().zip(samples).with_min_len(1024);
    pairs.for_each(|(gap, sample)| {
        *gap = on.gap_before(sample).map_or(0.0, |gap| gap.max(LEAST_GAP));
    });
}

/// The triangle of an id; none for a hull or nothing.
fn triangle_of(id: u32) -> Option<u32> {
    if id & HULL_BIT != 0 {
        return None;
    }
    (id & ID_MASK).checked_sub(1)
}

/// A triangle at a place of the picture.
struct Met {
    /// Whether it covers the place.
    covers: bool,
    depth: f32,
    /// By how much it lies in front, in plane coordinates.
    before: f32,
    /// Change of its plane coordinate over a pixel of the grid.
    slope: f32,
}

impl Scenery<'_> {
    /// How far in front of a sample lies the nearest that hides it, in sizes of a pixel.
    fn gap_before(&self, sample: &SpineSample) -> Option<f32> {
        let [width, height] = self.window.size;
        if sample.half_width <= 0.0 || width * height == 0 {
            return None;
        }
        let [x, y] = self.window.pixel_at(sample.spine_px);
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);

        // Of the triangles that cover the sample take the nearest in front of it.
        let pixels = || {
            rows.clone()
                .flat_map(|py| columns.clone().map(move |px| [px, py]))
        };
        let id_at = |[px, py]: [u32; 2]| self.ids[(py * width + px) as usize];
        let (mut is_covered, mut hider, mut last) = (false, f32::INFINITY, 0);
        for id in pixels().map(id_at) {
            // Neighbours mostly show the same one.
            if id == last {
                continue;
            }
            last = id;
            let Some(triangle) = triangle_of(id) else {
                continue;
            };
            let met = self.met(triangle, sample, sample.spine_px);
            if met.covers {
                is_covered = true;
                if met.before > self.rounding(sample) + PLACE_ROUNDING * met.slope {
                    hider = hider.min(met.depth);
                }
            }
        }

        // Where none covers it, see whether all around lie clearly in front.
        if !is_covered {
            for pixel in pixels() {
                let triangle = triangle_of(id_at(pixel))?;
                let met = self.met(triangle, sample, self.window.frame_at(pixel[0], pixel[1]));
                let size = self.pixel_coordinate(met.depth);
                let clearly = CLEARLY_PX * met.slope.min(STEEPEST * size).max(size);
                // What is no number lies before nothing.
                if met.before <= clearly || met.before.is_nan() {
                    return None;
                }
                hider = hider.min(met.depth);
            }
        }
        let gap = (sample.depth - hider) / self.view.pixel_before_eye(hider);
        (hider < f32::INFINITY).then_some(gap)
    }

    /// A triangle at a place of the frame, as seen from a sample.
    fn met(&self, triangle: u32, sample: &SpineSample, at_px: [f32; 2]) -> Met {
        let corners = self.triangles[triangle as usize].corners;
        let corners = corners.map(|corner| &self.posed[corner as usize]);
        let step = [0, 1].map(|i| self.view.pixel_ndc()[i] * self.window.frame_step[i]);
        let ndc = self.view.ndc_at(at_px);
        let weights = weights_around(corners.map(|corner| corner.clip), ndc, step);
        let depths = corners.map(|corner| corner.depth);
        let [here, right, down] =
            weights.map(|weights| self.view.plane_coordinate(blend(weights, depths)));
        let [over, under] = [right - here, down - here];
        let own = self.view.plane_coordinate(sample.depth);
        Met {
            covers: weights[0].iter().all(|weight| *weight >= LEAST_WEIGHT),
            depth: blend(weights[0], depths),
            before: if self.view.perspective > 0.5 {
                here - own
            } else {
                own - here
            },
            slope: (over * over + under * under).sqrt(),
        }
    }

    /// Rounding of a sample's plane coordinate.
    fn rounding(&self, sample: &SpineSample) -> f32 {
        self.view.plane_coordinate(sample.depth).abs() * DEPTH_ROUNDING
    }

    /// The size of a grid pixel at a depth, as a difference of plane coordinates.
    fn pixel_coordinate(&self, depth: f32) -> f32 {
        let pixel = self.view.pixel_at(depth) * self.window.frame_step[1];
        if self.view.perspective > 0.5 {
            pixel / (depth * depth)
        } else {
            pixel
        }
    }
}

#[cfg(test)]
mod tests;
