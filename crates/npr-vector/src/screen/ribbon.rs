//! Edges as ribbons of varying width: the twin of `line.draw_ribbons`.

use super::sweep::{Ribbon, draw_bands, line_key};
use npr_core::color;
use npr_core::geometry::{Edge, EdgeRole, FAR_DEPTH, GPixel, NONE, Part, PosedVertex};
use npr_core::line_color::{LineTint, LineTints, kind_of_edge};
use npr_core::line_kind::KindSet;
use npr_core::outline::{MASK_KINDS, Outline};
use npr_core::window::{View, Window};
use rayon::prelude::*;

/// Depth by which an edge may lie behind the surface around it and still show, in mask pixels on a surface that faces
/// the eye; more where it slopes.
///
/// A mask pixel's centre lies off the edge, on a surface that bends. Smaller breaks lines on grazing faces; larger lets
/// hidden lines through thin parts.
const DEPTH_TOLERANCE_PX: f32 = 1.0;

/// Factor on the tolerance of depth within which an edge may belong to a rim that bends away behind its pixel.
const RIM_FACTOR: f32 = 16.0;

/// Length along an edge over which the mask must continue, in mask pixels; a line that only crosses is thinner.
const LINE_REACH_PX: f32 = 2.5;

/// The input of [`draw`].
#[derive(Debug, Clone, Copy)]
pub struct Drawing<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The pixel grid that is drawn into.
    pub window: &'a Window,
    /// The pixel grid of the mask.
    pub mask_window: &'a Window,
    /// Settings.
    pub outline: &'a Outline,
    /// Posed vertices.
    pub posed: &'a [PosedVertex],
    /// Parts.
    pub parts: &'a [Part],
    /// The G-buffer under the mask.
    pub gbuffer: &'a [GPixel],
    /// The mask.
    pub mask: &'a [u32],
    /// What is decided about the colours of lines, on the mask's grid; may be shorter where no part asks for it.
    pub tints: &'a [LineTint],
}

/// Draws the edges that have a kind, as sRGB bytes with coverage in alpha, where the mask shows them
/// [Okuya et al. 2016, section 3.3].
///
/// `keys` (reversed depth bits) keep the best [`line_key`] of each pixel; of equal ones the first edge wins.
/// O(edges + covered pixels), parallel over bands of rows, each in edge order.
///
/// Differs: unique edges instead of three a triangle; round joins and depth tests, unless published behaviour is
/// asked for.
pub fn draw(
    with: &Drawing<'_>,
    edges: &[Edge],
    roles: &[EdgeRole],
    layer: &mut [u32],
    keys: &mut [u32],
) {
    // Project the edges that have a kind.
    let spines: Vec<Spine> = edges
        .par_iter()
        .zip(roles)
        .with_min_len(4096)
        .filter_map(|(edge, role)| with.spine(edge, role))
        .collect();

    // Draw them in their order, band by band.
    draw_bands(
        &spines,
        with.window,
        layer,
        keys,
        &|spine, px, texel, best| {
            with.ink(spine, px, texel, best);
        },
    );
}

/// An edge ready to draw.
struct Spine {
    ribbon: Ribbon,
    /// Unit vector from one end to the other, in frame pixels.
    direction: [f32; 2],
    /// [`View::plane_coordinate`] of both ends.
    coordinates: [f32; 2],
    part: u32,
    kind: u32,
}

impl AsRef<Ribbon> for Spine {
    fn as_ref(&self) -> &Ribbon {
        &self.ribbon
    }
}

impl Drawing<'_> {
    /// An edge in frame pixels; `None` if it has no kind or lies behind the eye.
    fn spine(&self, edge: &Edge, role: &EdgeRole) -> Option<Spine> {
        // Leave out edges without a kind, and those behind the near plane.
        let [first, second] = edge.ends.map(|v| &self.posed[v as usize]);
        if role.kinds == 0 || first.depth.max(second.depth) <= self.view.near {
            return None;
        }

        // Cut it at the near plane.
        let (a, half_a, depth_a) = self.end_of(first, second);
        let (b, half_b, depth_b) = self.end_of(second, first);
        let ribbon = Ribbon {
            a,
            b,
            half_a,
            half_b,
        };

        // Let it run along its own direction.
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = (along[0] * along[0] + along[1] * along[1]).sqrt().max(1e-6);
        Some(Spine {
            ribbon,
            direction: [along[0] / length, along[1] / length],
            coordinates: [depth_a, depth_b].map(|depth| self.view.plane_coordinate(depth)),
            part: role.part,
            kind: role.kinds,
        })
    }

    /// An end point in frame pixels; behind the near plane it moves along the edge to that plane.
    fn end_of(&self, here: &PosedVertex, other: &PosedVertex) -> ([f32; 2], f32, f32) {
        let near = self.view.near;
        let t = if here.depth < near {
            (near - here.depth) / (other.depth - here.depth)
        } else {
            0.0
        };
        let toward = |a: f32, b: f32| a + (b - a) * t;
        let clip: [f32; 4] = std::array::from_fn(|i| toward(here.clip[i], other.clip[i]));
        let px = [
            (clip[0] / clip[3] + 1.0) * 0.5 * self.view.frame_px[0],
            (1.0 - clip[1] / clip[3]) * 0.5 * self.view.frame_px[1],
        ];
        (
            px,
            toward(here.half_width, other.half_width),
            toward(here.depth, other.depth),
        )
    }

    /// Inks one pixel where the ribbon shows and covers it better than the line that is there.
    fn ink(&self, spine: &Spine, px: [f32; 2], texel: &mut u32, best: &mut u32) {
        let ribbon = &spine.ribbon;
        let (coverage, t) = ribbon.at(px, self.outline.flags & Outline::PUBLISHED != 0);
        if coverage * 255.0 < 0.5 {
            return;
        }
        // Find the reference coordinate and its depth.
        let along = [ribbon.b[0] - ribbon.a[0], ribbon.b[1] - ribbon.a[1]];
        let reference = [ribbon.a[0] + along[0] * t, ribbon.a[1] + along[1] * t];
        let [from_a, to_b] = spine.coordinates;
        let depth = self.view.plane_coordinate(from_a + (to_b - from_a) * t);

        // Skip the costly look-ups where a better line is there already.
        let key = line_key(coverage, self.view.nearness(depth)).to_bits();
        if key <= *best {
            return;
        }
        let part = &self.parts[spine.part as usize];
        if self.shows_at(reference, depth, spine.direction, spine.kind)
            && !self.is_covered(px, reference, depth, part.object)
        {
            let tints = LineTints {
                mask_window: self.mask_window,
                tints: self.tints,
            };
            let kind = kind_of_edge(spine.kind);
            let [r, g, b, a] = tints.color_at(self.parts, spine.part, kind, reference);
            *texel = color::pack_rgba8([r, g, b, a * coverage]);
            *best = key;
        }
    }

    /// Whether the edge shows at a point of its spine.
    fn shows_at(&self, px: [f32; 2], depth: f32, along: [f32; 2], kind: u32) -> bool {
        if self.is_hidden(px, depth) {
            return false;
        }
        if self.outline.flags & Outline::UNMASKED != 0 {
            return true;
        }
        if self.outline.flags & Outline::PUBLISHED != 0 {
            return self.mask_at(px);
        }
        if !self.mask_near(px) {
            return false;
        }
        // The mask must run along the edge, not merely meet another line there.
        let step = self.mask_window.frame_step;
        let ahead = [
            along[0] * step[0] * LINE_REACH_PX,
            along[1] * step[1] * LINE_REACH_PX,
        ];
        let (ahead, behind) = (
            [px[0] + ahead[0], px[1] + ahead[1]],
            [px[0] - ahead[0], px[1] - ahead[1]],
        );
        if kind & (KindSet::CONTOUR | KindSet::BOUNDARY) != 0 {
            return self.mask_near(ahead) || self.mask_near(behind);
        }
        self.mask_at(ahead) || self.mask_at(behind)
    }

    /// Whether the surface at the reference coordinate hides the edge.
    fn is_hidden(&self, px: [f32; 2], depth: f32) -> bool {
        let pixel = self.mask_window.pixel_at(px);
        let Some((seen, plane)) = self.plane_at(pixel, px) else {
            return false;
        };
        let slope = self
            .view
            .slope_of(self.mask_window, seen.depth, seen.plane_step);
        let tolerance = self.tolerance(depth) * (1.0 + slope);
        depth > plane.max(seen.depth) + tolerance
            && !self.is_rim(pixel, depth, tolerance * RIM_FACTOR)
    }

    /// The surface that a mask pixel shows, and the depth of its tangent plane at a point of the frame.
    fn plane_at(&self, pixel: [u32; 2], px: [f32; 2]) -> Option<(&GPixel, f32)> {
        let seen = &self.gbuffer[(pixel[1] * self.mask_window.size[0] + pixel[0]) as usize];
        if seen.part == NONE {
            return None;
        }
        let center = self.mask_window.frame_at(pixel[0], pixel[1]);
        let off: [f32; 2] =
            std::array::from_fn(|i| (px[i] - center[i]) / self.mask_window.frame_step[i]);
        let change = seen.plane_step[0] * off[0] + seen.plane_step[1] * off[1];
        let coordinate = self.view.plane_coordinate(seen.depth) + change;
        Some((seen, self.view.depth_of_coordinate(coordinate)))
    }

    /// Whether a depth belongs to the front one of two surfaces that 3x3 pixels show: a rim that bends away faster than
    /// the tangent plane of its pixel.
    fn is_rim(&self, center: [u32; 2], depth: f32, room: f32) -> bool {
        let size = self.mask_window.size;
        let (mut nearest, mut farthest) = (FAR_DEPTH, 0.0f32);
        for y in center[1].saturating_sub(1)..=(center[1] + 1).min(size[1] - 1) {
            for x in center[0].saturating_sub(1)..=(center[0] + 1).min(size[0] - 1) {
                let seen = self.gbuffer[(y * size[0] + x) as usize].depth;
                (nearest, farthest) = (nearest.min(seen), farthest.max(seen));
            }
        }
        depth - nearest < room && depth - nearest < farthest - depth
    }

    /// Whether any of the 3x3 mask pixels around a point is set.
    fn mask_near(&self, px: [f32; 2]) -> bool {
        let center = self.mask_window.pixel_at(px);
        let size = self.mask_window.size;
        (center[1].saturating_sub(1)..=(center[1] + 1).min(size[1] - 1)).any(|y| {
            let left = (y * size[0] + center[0].saturating_sub(1)) as usize;
            let right = (y * size[0] + (center[0] + 1).min(size[0] - 1)) as usize;
            self.mask[left..=right]
                .iter()
                .any(|found| found & MASK_KINDS != 0)
        })
    }

    /// Whether another object stands in front of a thick line's pixel.
    ///
    /// The object's tangent plane is followed to the reference coordinate: the floor that a thing stands on is nearer
    /// to the eye below the line, but does not cover it.
    fn is_covered(&self, px: [f32; 2], reference: [f32; 2], depth: f32, object: u32) -> bool {
        let Some((seen, plane)) = self.plane_at(self.mask_window.pixel_at(px), reference) else {
            return false;
        };
        self.parts[seen.part as usize].object != object
            && seen.depth.max(plane) < depth - self.tolerance(depth)
    }

    fn tolerance(&self, depth: f32) -> f32 {
        DEPTH_TOLERANCE_PX * self.view.pixel_at(depth) * self.mask_window.frame_step[1]
    }

    fn mask_at(&self, px: [f32; 2]) -> bool {
        self.mask[self.mask_element(px)] & MASK_KINDS != 0
    }

    fn mask_element(&self, px: [f32; 2]) -> usize {
        let pixel = self.mask_window.pixel_at(px);
        (pixel[1] * self.mask_window.size[0] + pixel[0]) as usize
    }
}
