//! Lines on images: the twin of `line.detect`.

use npr_core::geometry::{GPixel, NONE, Part};
use npr_core::line_kind::KindSet;
use npr_core::list;
use npr_core::math;
use npr_core::outline::{MASK_KINDS, MASK_OWNER, MASK_SIDE, Outline, PIECE_COS};
use npr_core::surface::dot;
use npr_core::window::{View, Window};
use rayon::prelude::*;

/// Depth change per pixel, in pixels, from which a surface is grazing: 63 degrees.
pub(crate) const GRAZING_SLOPE: f32 = 2.0;

/// The ways to the neighbours of a pixel: left, right, above, below.
const STEPS: [[f32; 2]; 4] = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];

/// The input of detection.
#[derive(Debug, Clone, Copy)]
pub struct Detection<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The pixel grid of the mask.
    pub window: &'a Window,
    /// Thresholds.
    pub outline: &'a Outline,
    /// Parts: those without lines are not separated from each other.
    pub parts: &'a [Part],
}

/// Distance of packed normals up to which they surely turn by less than the outline's normal threshold.
///
/// On the octahedron a step is at most sqrt(2) times as long as the sum of its packed coordinates, and seen from the
/// middle, at least 1 / sqrt(3) away, it spans at most 2.45 radians per unit. Most pixels are settled by this alone.
fn quiet_distance(outline: &Outline) -> u32 {
    (math::acos(outline.normal_cos.clamp(-1.0, 1.0)) / 2.5 * 32767.0) as u32
}

/// Sum of the differences of two packed normals' coordinates.
fn packed_distance(a: u32, b: u32) -> u32 {
    let part = |shift: u32| {
        u32::from((((a << shift) as i32 >> 16) as i16).abs_diff(((b << shift) as i32 >> 16) as i16))
    };
    part(16) + part(0)
}

/// Marks every pixel that differs from one of its four neighbours [Okuya et al. 2016, section 3.2].
///
/// Each G-buffer has its own threshold and the mask is their union. Low bits say which buffers found a pixel,
/// [`MASK_OWNER`] whether its surface is the one in front, the bits from [`MASK_SIDE`] on which sides the line runs.
///
/// Differs: the paper compares depths directly, which lights up planes seen at a grazing angle; with
/// [`Outline::PLANE_DEPTH`] a depth is compared with the neighbour's tangent plane.
///
/// Normals also differ between the pixels of a surface that turns away steeply; such pixels are marked but own no line,
/// and where creases are not drawn, neither does any other turn of the surface. Depths differ there as well: of two
/// pixels on both sides of a convex bend each lies behind the tangent plane of the other, and that owns no line either.
///
/// `owners` becomes the list of the pixels that own a line. O(pixels), parallel over rows.
pub fn detect(with: &Detection<'_>, gbuffer: &[GPixel], mask: &mut [u32], owners: &mut [u32]) {
    let width = with.window.size[0] as usize;
    let detector = Detector::new(with);
    let rows = mask.par_chunks_mut(width).enumerate();
    let rows = rows.map(|(y, row)| {
        row.fill(0);
        let line = |y: usize| &gbuffer[y * width..(y + 1) * width];
        detector.mark_along(line(y), row);
        if y > 0 {
            detector.mark_across(line(y), line(y - 1), -1.0, row);
        }
        if (y + 1) * width < gbuffer.len() {
            detector.mark_across(line(y), line(y + 1), 1.0, row);
        }
        let elements = ((y * width) as u32..).zip(row);
        let owning = elements.filter(|(_, marks)| **marks & MASK_OWNER != 0);
        owning.map(|(element, _)| element).collect()
    });
    let rows: Vec<Vec<u32>> = rows.collect();
    list::fill(owners, &rows);
}

/// A detection with what is computed once for all pixels.
pub(crate) struct Detector<'a> {
    with: &'a Detection<'a>,
    /// Distance of packed normals up to which they surely turn by less than the threshold.
    quiet_distance: u32,
}

impl<'a> Detector<'a> {
    pub fn new(with: &'a Detection<'a>) -> Self {
        Self {
            quiet_distance: quiet_distance(with.outline),
            with,
        }
    }

    /// The buffers that separate a pixel from its neighbour to the right (`side` 1) or below (3); 0 if neither has
    /// lines.
    pub fn kinds(&self, first: &GPixel, second: &GPixel, side: u32) -> u32 {
        let kinds = self.separations(first, second, STEPS[side as usize]);
        if self.has_lines(first) || self.has_lines(second) {
            kinds
        } else {
            0
        }
    }

    /// The mask bits of two pixels for the buffers that separate them, as [`Self::kinds`] finds them; jumps in depth
    /// always count, even where the surface may bend between the pixels.
    pub fn marks(&self, first: &GPixel, second: &GPixel, kinds: u32, side: u32) -> [u32; 2] {
        [
            self.mark(first, second, kinds, side),
            self.mark(second, first, kinds, side - 1),
        ]
    }

    /// Marks the pixels of a row for their neighbours in the row; each pair is compared once for both of its pixels.
    fn mark_along(&self, line: &[GPixel], row: &mut [u32]) {
        for x in 1..line.len() {
            let kinds = self.kinds(&line[x - 1], &line[x], 1);
            if kinds != 0 {
                row[x - 1] |= self.mark_unless_bent(&line[x - 1], &line[x], kinds, 1);
                row[x] |= self.mark_unless_bent(&line[x], &line[x - 1], kinds, 0);
            }
        }
    }

    /// Marks the pixels of a row for their neighbours above (`along` -1) or below (1).
    fn mark_across(&self, line: &[GPixel], next: &[GPixel], along: f32, row: &mut [u32]) {
        let side = if along < 0.0 { 2 } else { 3 };
        for ((here, there), out) in line.iter().zip(next).zip(row) {
            let kinds = self.separations(here, there, [0.0, along]);
            if kinds != 0 && (self.has_lines(here) || self.has_lines(there)) {
                *out |= self.mark_unless_bent(here, there, kinds, side);
            }
        }
    }

    /// The mask bits of `here`, which owns no line for a jump in depth where the surface may bend between both.
    fn mark_unless_bent(&self, here: &GPixel, there: &GPixel, kinds: u32, side: u32) -> u32 {
        let mut owning = kinds;
        if kinds & Outline::DEPTH != 0 && self.may_bend(here, there, side) {
            owning &= !Outline::DEPTH;
        }
        match owning {
            0 => kinds,
            _ => kinds | self.mark(here, there, owning, side),
        }
    }

    /// The mask bits of `here`, whose neighbour `there` lies on `side`: left, right, above, below.
    fn mark(&self, here: &GPixel, there: &GPixel, kinds: u32, side: u32) -> u32 {
        if kinds == Outline::NORMAL && self.is_no_crease(here, there) {
            return kinds;
        }
        // Of two equally near surfaces, the right or lower pixel owns the line.
        let first_side = side & 1 == 0;
        if here.depth < there.depth || (here.depth == there.depth && first_side) {
            return kinds | MASK_OWNER | (MASK_SIDE << side);
        }
        kinds
    }

    /// Whether neighbours that differ in nothing but their normals have no crease between them.
    fn is_no_crease(&self, here: &GPixel, there: &GPixel) -> bool {
        self.with.outline.kinds & KindSet::CREASE == 0
            || self.is_grazing(here)
            || self.is_grazing(there)
    }

    /// Which buffers separate two neighbours.
    fn separations(&self, here: &GPixel, there: &GPixel, step: [f32; 2]) -> u32 {
        let outline = self.with.outline;
        if here.part == NONE && there.part == NONE {
            return 0;
        }

        // Compare what the pixels show.
        let mut found = self.differing_ids(here.part, there.part);

        // Against the background everything differs.
        if here.part == NONE || there.part == NONE {
            return (found | Outline::DEPTH | Outline::NORMAL) & outline.detects;
        }
        if self.jumps(here, there, step) {
            found |= Outline::DEPTH;
        }

        // Compare normals, unless they are all but equal.
        let quiet = here.part == there.part
            && packed_distance(here.normal, there.normal) < self.quiet_distance;
        if !quiet {
            let turn = dot(
                math::unpack_unit(here.normal),
                math::unpack_unit(there.normal),
            );
            if turn < outline.normal_cos {
                found |= Outline::NORMAL;
            }
            let component = |pixel: &GPixel| self.with.parts[pixel.part as usize].component;
            let meets = found & (Outline::OBJECT_ID | Outline::MATERIAL_ID) == 0
                && here.part != there.part
                && component(here) != component(there);
            if meets && turn < PIECE_COS {
                found |= Outline::PIECE;
            }
        }
        found & outline.detects & MASK_KINDS
    }

    /// Which of object and material two parts differ in; [`NONE`] is the part of the background, which has neither.
    fn differing_ids(&self, here: u32, there: u32) -> u32 {
        if here == there {
            return 0;
        }
        let ids = |part: u32| match self.with.parts.get(part as usize) {
            Some(part) => [part.object, part.material],
            None => [NONE; 2],
        };
        let ([object, material], [other_object, other_material]) = (ids(here), ids(there));
        let mut found = 0;
        if object != other_object {
            found |= Outline::OBJECT_ID;
        }
        if material != other_material {
            found |= Outline::MATERIAL_ID;
        }
        found
    }

    /// Whether depth jumps between two neighbours, by the threshold's share of the frame's height.
    fn jumps(&self, here: &GPixel, there: &GPixel, step: [f32; 2]) -> bool {
        let least = self.with.outline.depth_threshold
            * self.with.view.height_at(here.depth.min(there.depth));
        if (here.depth - there.depth).abs() <= least {
            return false;
        }
        let back = step.map(|v| -v);
        self.with.outline.detects & Outline::PLANE_DEPTH == 0
            || (self.plane_gap(here, there, step) > least
                && self.plane_gap(there, here, back) > least)
    }

    /// Whether the surface may bend between a pixel and its neighbour on a side, convex as a body is: each lies behind
    /// the tangent plane of the other, so both planes cross between them. Never where depths are compared directly.
    ///
    /// Where one surface hides another, the nearer pixel lies before the plane of the farther one, unless that rises
    /// towards the eye by more than the jump within a pixel: then nothing tells the two cases apart.
    fn may_bend(&self, here: &GPixel, there: &GPixel, side: u32) -> bool {
        let [step, back] = [side, side ^ 1].map(|side| STEPS[side as usize]);
        self.with.outline.detects & Outline::PLANE_DEPTH != 0
            && there.depth > self.plane_depth(here, step)
            && here.depth > self.plane_depth(there, back)
    }

    /// How far `there` lies from the tangent plane of `here`, one pixel along `step`, in depth.
    fn plane_gap(&self, here: &GPixel, there: &GPixel, step: [f32; 2]) -> f32 {
        (self.plane_depth(here, step) - there.depth).abs()
    }

    /// Depth of the tangent plane of a pixel, one pixel along `step`.
    fn plane_depth(&self, pixel: &GPixel, step: [f32; 2]) -> f32 {
        let change = pixel.plane_step[0] * step[0] + pixel.plane_step[1] * step[1];
        let coordinate = self.with.view.plane_coordinate(pixel.depth) + change;
        self.with.view.depth_of_coordinate(coordinate)
    }

    /// Whether a surface turns away so far that its normals change from pixel to pixel without any crease.
    fn is_grazing(&self, pixel: &GPixel) -> bool {
        self.with
            .view
            .slope_of(self.with.window, pixel.depth, pixel.plane_step)
            > GRAZING_SLOPE
    }

    fn has_lines(&self, pixel: &GPixel) -> bool {
        pixel.part != NONE && self.with.parts[pixel.part as usize].flags & Part::LINES != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The marks of two pixels, one unit apart along an axis, whose planes have these slopes and cross at a share of
    /// the way from the first to the second; normals tell nothing.
    fn marks_of(slopes: [f32; 2], share: f32, axis: usize) -> [u32; 2] {
        let pixel = |slope: f32, at: f32| {
            let mut plane_step = [0.0; 2];
            plane_step[axis] = slope;
            GPixel {
                plane_step,
                depth: 1000.0 + slope * (at - share),
                part: 0,
                ..GPixel::EMPTY
            }
        };
        let mut size = [1; 2];
        size[axis] = 2;
        let size_px = size.map(|side| side as f32);
        let outline = Outline {
            depth_threshold: 1.0,
            normal_cos: -2.0,
            detects: Outline::DEPTH | Outline::PLANE_DEPTH,
            ..Outline::default()
        };
        let detection = Detection {
            view: &View {
                view_height: 1.0,
                frame_px: size_px,
                ..View::default()
            },
            window: &Window::over(size_px, [0.0; 2], size_px, size),
            outline: &outline,
            parts: &[Part {
                flags: Part::LINES,
                ..Part::default()
            }],
        };
        let mut marks = [0; 2];
        let pixels = [pixel(slopes[0], 0.0), pixel(slopes[1], 1.0)];
        detect(&detection, &pixels, &mut marks, &mut []);
        marks
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// Of a body depth is the largest of its planes' depths, so the steeper one comes second. Its bend is marked
        /// where depths jump, but no line is drawn for it; in a valley, where nothing tells a jump from a bend, one is.
        #[test]
        fn a_bend_at_the_rim_of_a_body_owns_no_line(
            first in -60_f32..60.0, turn in 0.01_f32..60.0, share in 0.05_f32..0.95, axis in 0_usize..2,
        ) {
            let bend = marks_of([first, first + turn], share, axis);
            let valley = marks_of([first + turn, first], share, axis);
            prop_assert!(bend.iter().all(|mark| mark & MASK_OWNER == 0), "{:?}", bend);
            let owners = valley.iter().filter(|mark| **mark & MASK_OWNER != 0).count();
            prop_assert_eq!(owners, usize::from(valley != [0; 2]));
            // Both planes lie this far from the other's pixel.
            let gap = turn * share.min(1.0 - share);
            let is_deep = |slopes: [f32; 2]| (slopes[0] * share + slopes[1] * (1.0 - share)).abs() > 1.01;
            prop_assert!(gap < 1.01 || !is_deep([first, first + turn]) || bend == [Outline::DEPTH; 2]);
            prop_assert!(gap < 1.01 || !is_deep([first + turn, first]) || owners == 1);
        }

        #[test]
        fn quiet_normals_never_turn_past_the_threshold(
            n in prop::array::uniform3(-1f32..1.0), d in prop::array::uniform3(-0.4f32..0.4), degrees in 1f32..90.0,
        ) {
            prop_assume!(dot(n, n) > 0.05);
            let there = std::array::from_fn(|i| n[i] + d[i]);
            prop_assume!(dot(there, there) > 0.01);
            let outline = Outline { normal_cos: math::cos(degrees.to_radians()), ..Outline::default() };
            let (a, b) = (math::pack_unit(n), math::pack_unit(there));
            let turn = dot(math::unpack_unit(a), math::unpack_unit(b));
            prop_assert!(packed_distance(a, b) >= quiet_distance(&outline) || turn >= outline.normal_cos);
        }
    }
}
