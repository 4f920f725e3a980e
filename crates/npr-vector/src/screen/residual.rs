//! Lines that run along no mesh edge: the twins of `line.find_residual`, `line.smooth_stamps`, `line.claim_pixels` and
//! `line.stamp_residual`.
//!
//! Where shapes meet or interpenetrate, the mask shows a line and no edge lies there. Such pixels become discs, as wide
//! as the surface says, and a row of discs is a line. They are few: every step works on a list of what the step before
//! found, and nothing else.

use crate::screen::sweep::line_coverage;
use npr_core::color;
use npr_core::geometry::{GPixel, NONE, Part, Stamp};
use npr_core::line_color::{LineTint, LineTints};
use npr_core::line_kind::Kind;
use npr_core::list::{self, Listed};
use npr_core::outline::{MASK_OWNER, MASK_SIDE, Outline};
use npr_core::window::Window;
use rayon::prelude::*;

/// Half side of the box in which ink is counted, in mask pixels.
const LINE_BOX_PX: f32 = 2.0;

/// Inked pixels in that box that make a line; fewer are fragments of an edge that crosses here.
const LINE_INK_COUNT: u32 = 5;

/// Share of a line's own coverage from which a pixel counts as inked by it; less is the frayed end of a ribbon.
const LINE_INK_SHARE: f32 = 0.7;

/// What is left of that share for the thinnest lines.
const THIN_INK_SHARE: f32 = 0.4;

/// Half side of the box, in mask pixels, in which a line within one surface must go on.
const RUN_BOX_PX: u32 = 5;

/// Owned pixels in that box that make a line; fewer are the tip of a corner, or the grain of a scan.
const RUN_COUNT: u32 = 8;

/// The criteria that separate a surface from others, not from itself.
const BETWEEN: u32 = Outline::OBJECT_ID | Outline::MATERIAL_ID | Outline::PIECE;

/// The input of [`find`].
#[derive(Debug, Clone, Copy)]
pub struct Search<'a> {
    /// The pixel grid of the ribbons.
    pub window: &'a Window,
    /// The pixel grid of the mask.
    pub mask_window: &'a Window,
    /// Parts.
    pub parts: &'a [Part],
    /// The G-buffer under the mask.
    pub gbuffer: &'a [GPixel],
    /// The mask.
    pub mask: &'a [u32],
    /// The ribbons drawn, coverage in alpha.
    pub ribbons: &'a [u32],
}

/// A stamp for every mask pixel in `owners` that has no ribbon near it, centred on the border between the pixels that
/// differ.
///
/// `owners` lists the pixels that own lines. Each of them gets its element of `stamps`, of half width 0 where it needs
/// none; all other elements stay as they were. `found` becomes the list of those with a stamp. O(owners), parallel over
/// rows.
pub fn find(on: &Search<'_>, owners: &[u32], stamps: &mut [Stamp], found: &mut [u32]) {
    let width = on.mask_window.size[0] as usize;
    let owners = Listed::of(owners);
    let rows = stamps.par_chunks_mut(width).enumerate();
    let rows: Vec<Vec<u32>> = rows
        .map(|(y, row)| {
            let mut found = Vec::new();
            for (x, element) in owners.row(y, width) {
                let stamp = on.stamp_at(x as u32, y as u32);
                found.extend(stamp.map(|_| element));
                row[x] = stamp.unwrap_or_default();
            }
            found
        })
        .collect();
    list::fill(found, &rows);
}

impl Search<'_> {
    fn stamp_at(&self, x: u32, y: u32) -> Option<Stamp> {
        // Take pixels of a surface with lines.
        let element = (y * self.mask_window.size[0] + x) as usize;
        let (found, pixel) = (self.mask[element], &self.gbuffer[element]);
        if pixel.part == NONE || self.parts[pixel.part as usize].flags & Part::LINES == 0 {
            return None;
        }
        if found & BETWEEN == 0 && !self.runs_on([x, y], pixel) {
            return None;
        }

        // Stamp the line where no ribbon inked it.
        let (middle, toward) = (self.mask_window.frame_at(x, y), toward_line(found));
        let center: [f32; 2] =
            std::array::from_fn(|i| middle[i] + toward[i] * self.mask_window.frame_step[i]);
        (!self.is_inked_at(center, pixel.half_width)).then_some(Stamp {
            center,
            half_width: pixel.half_width,
            part: pixel.part,
        })
    }

    /// Whether a surface is separated from itself along a line through a mask pixel, not only at a few pixels.
    ///
    /// Four faces that meet in a blunt corner differ across it though none of its edges is a crease, and so do the
    /// dents of a scan: lines so short would be dots. Where the surface ends at another it is not separated from
    /// itself: a dot beside an outline is no part of a line.
    fn runs_on(&self, at: [u32; 2], pixel: &GPixel) -> bool {
        let size = self.mask_window.size;
        let low = at.map(|v| v.saturating_sub(RUN_BOX_PX));
        let high: [u32; 2] = std::array::from_fn(|i| (at[i] + RUN_BOX_PX).min(size[i] - 1));
        let mut count = 0;
        for y in low[1]..=high[1] {
            for x in low[0]..=high[0] {
                let element = (y * size[0] + x) as usize;
                let is_within = self.mask[element] & (MASK_OWNER | BETWEEN) == MASK_OWNER;
                count += u32::from(is_within && self.is_one_skin(&self.gbuffer[element], pixel));
            }
        }
        count >= RUN_COUNT
    }

    /// Whether two pixels show one connected surface in one material, whatever ids it has.
    fn is_one_skin(&self, a: &GPixel, b: &GPixel) -> bool {
        let skin = |pixel: &GPixel| {
            let part = self.parts.get(pixel.part as usize)?;
            Some([part.object, part.material, part.component])
        };
        a.part != NONE && skin(a) == skin(b)
    }

    /// Whether a ribbon runs through a point of the frame: ink enough under it, and enough around to be a line.
    ///
    /// `half_width` is that of the line which would be stamped here; thin lines ink less.
    fn is_inked_at(&self, px: [f32; 2], half_width: f32) -> bool {
        let under = self.ink_within(px, 0.5);
        // A line through a box fills as much of it as its width does of the box's side.
        let side = (under.texels as f32).sqrt();
        let filled = (2.0 * half_width / side).min(1.0);
        let full = 255.0 * under.texels as f32 * filled;
        // Borders of a coarse mask's pixels lie off the line, which then meets only a part of the box.
        let step = self.mask_window.frame_step;
        // A thin line may pass beside the middle of the box; a gap in a thick one must not.
        let share = LINE_INK_SHARE * filled.max(THIN_INK_SHARE) / (step[0] * step[1]).max(1.0);
        let is_covered = under.alpha as f32 >= share * full && under.alpha > 0;
        is_covered && self.ink_within(px, LINE_BOX_PX).inked >= LINE_INK_COUNT
    }

    /// Ink of the output within `reach` mask pixels of a point of the frame, along both axes.
    fn ink_within(&self, px: [f32; 2], reach: f32) -> Ink {
        let reach = self.mask_window.frame_step.map(|step| reach * step);
        let low = self.window.pixel_at([px[0] - reach[0], px[1] - reach[1]]);
        let high = self.window.pixel_at([px[0] + reach[0], px[1] + reach[1]]);
        let mut ink = Ink::default();
        for y in low[1]..=high[1] {
            let row = (y * self.window.size[0]) as usize;
            for texel in &self.ribbons[row + low[0] as usize..=row + high[0] as usize] {
                let alpha = texel >> 24;
                ink.texels += 1;
                ink.alpha += alpha;
                ink.inked += u32::from(alpha > 0);
            }
        }
        ink
    }
}

/// Ink found in a box of the output.
#[derive(Debug, Clone, Copy, Default)]
struct Ink {
    /// Texels looked at.
    texels: u32,
    /// Texels with any ink.
    inked: u32,
    /// Sum of their coverage, in steps of 1 / 255.
    alpha: u32,
}

/// From a pixel's centre to the line, in pixels: half the sum of the sides it runs along.
fn toward_line(found: u32) -> [f32; 2] {
    let side = |i: u32| {
        if found & (MASK_SIDE << i) != 0 {
            0.5
        } else {
            0.0
        }
    };
    [side(1) - side(0), side(3) - side(2)]
}

/// How far along a line stamps are averaged, in mask pixels.
const SMOOTHING_REACH: u32 = 3;

/// The stamps of a mask.
#[derive(Debug, Clone, Copy)]
pub struct Stamps<'a> {
    /// The pixel grid of the mask.
    pub mask_window: &'a Window,
    /// The mask.
    pub mask: &'a [u32],
    /// A stamp for each of its pixels, which means something where the mask owns a line and the half width is not 0.
    pub stamps: &'a [Stamp],
}

/// Moves the stamps in `found` across their lines to the middle of the stamps of their parts around them, so that the
/// steps of the pixel grid do not show; all other elements stay as they were.
///
/// O(49 per stamp), parallel over rows.
pub fn smooth(on: &Stamps<'_>, found: &[u32], smoothed: &mut [Stamp]) {
    let width = on.mask_window.size[0] as usize;
    let found = Listed::of(found);
    let rows = smoothed.par_chunks_mut(width).enumerate();
    rows.for_each(|(y, row)| {
        for (x, element) in found.row(y, width) {
            let mut stamp = on.stamps[element as usize];
            let by = move_across(&on.cloud_around([x as u32, y as u32], &stamp));
            stamp.center = [stamp.center[0] + by[0], stamp.center[1] + by[1]];
            row[x] = stamp;
        }
    });
}

/// The stamps around one of them: their number, and sums of their places relative to it.
#[derive(Debug, Clone, Copy, Default)]
struct Cloud {
    count: f32,
    sum: [f32; 2],
    /// Sums of xx, xy and yy.
    squares: [f32; 3],
}

impl Stamps<'_> {
    /// The stamps of the same part around a stamp.
    fn cloud_around(&self, at: [u32; 2], middle: &Stamp) -> Cloud {
        // Enclose the mask pixels within reach.
        let size = self.mask_window.size;
        let low = at.map(|v| v.saturating_sub(SMOOTHING_REACH));
        let high: [u32; 2] = std::array::from_fn(|i| (at[i] + SMOOTHING_REACH).min(size[i] - 1));

        // Sum up the stamps of the same part.
        let mut cloud = Cloud::default();
        for y in low[1]..=high[1] {
            for x in low[0]..=high[0] {
                let element = (y * size[0] + x) as usize;
                if self.mask[element] & MASK_OWNER == 0 {
                    continue;
                }
                let stamp = &self.stamps[element];
                if stamp.half_width > 0.0 && stamp.part == middle.part {
                    let [x, y] = [
                        stamp.center[0] - middle.center[0],
                        stamp.center[1] - middle.center[1],
                    ];
                    cloud.count += 1.0;
                    cloud.sum = [cloud.sum[0] + x, cloud.sum[1] + y];
                    let [xx, xy, yy] = cloud.squares;
                    cloud.squares = [xx + x * x, xy + x * y, yy + y * y];
                }
            }
        }
        cloud
    }
}

/// The vector to the middle of a cloud, without its part along the line that the cloud forms.
///
/// Moved along the line, its ends would draw back from the ribbon that continues it. A symmetric matrix with
/// eigenvalues p and q, v the eigenvector of p, is `(p + q) / 2 + (p - q) / 2 * (2 v v' - 1)`, which gives v v' without
/// any angle; round clouds have no direction, and there the part along the line fades out.
fn move_across(cloud: &Cloud) -> [f32; 2] {
    let [x, y] = cloud.sum.map(|sum| sum / cloud.count);
    let [xx, xy, yy] = cloud.squares.map(|sum| sum / cloud.count);
    let (a, b, c) = (xx - x * x, xy - x * y, yy - y * y);
    let spread = a + c;
    if spread < 1e-6 {
        return [x, y];
    }
    let half_gap = 0.5 * (a - c);
    let extent = (half_gap * half_gap + b * b).sqrt();
    let along_x = ((extent + half_gap) * x + b * y) / spread;
    let along_y = (b * x + (extent - half_gap) * y) / spread;
    [x - along_x, y - along_y]
}

/// Rows of the output that are claimed together.
const BAND: usize = 16;

/// Claims every pixel of the output for the stamp that covers it most, and of equal ones the first; `covered` becomes
/// the list of the claimed pixels.
///
/// `smoothed` has an element for each pixel of the mask, and `found` lists those with a stamp. `claims` has an element
/// for each pixel of the output, 0 before: the element of its stamp plus 1. O(stamps * their area), parallel over bands
/// of rows.
pub fn claim(
    window: &Window,
    found: &[u32],
    smoothed: &[Stamp],
    claims: &mut [u32],
    covered: &mut [u32],
) {
    let width = window.size[0] as usize;
    let found = Listed::of(found);
    let bands = claims.par_chunks_mut(width * BAND).enumerate();
    let bands: Vec<Vec<u32>> = bands
        .map(|(band, claims)| {
            let claimer = Claimer {
                window,
                smoothed,
                first_row: (band * BAND) as u32,
            };
            claimer.claim(found.all(), claims)
        })
        .collect();
    list::fill(covered, &bands);
}

/// Claims pixels of a band of rows.
struct Claimer<'a> {
    window: &'a Window,
    smoothed: &'a [Stamp],
    first_row: u32,
}

impl Claimer<'_> {
    /// Claims pixels for stamps in ascending order; gives the claimed ones.
    fn claim(&self, stamps: &[u32], claims: &mut [u32]) -> Vec<u32> {
        let width = self.window.size[0];
        let last_row = self.first_row + claims.len() as u32 / width - 1;
        let mut covered = Vec::new();
        for element in stamps {
            // Look at the pixels of the band that the stamp may reach.
            let stamp = &self.smoothed[*element as usize];
            let (low, high) = reached(self.window, stamp);
            for y in low[1].max(self.first_row)..=high[1].min(last_row) {
                for x in low[0]..=high[0] {
                    // Of equal stamps, the one that came before keeps the pixel.
                    let px = self.window.frame_at(x, y);
                    let own = coverage(stamp, px);
                    let claim = &mut claims[((y - self.first_row) * width + x) as usize];
                    let held = match *claim {
                        0 => 0.0,
                        other => coverage(&self.smoothed[other as usize - 1], px),
                    };
                    if own > held {
                        if *claim == 0 {
                            covered.push(y * width + x);
                        }
                        *claim = element + 1;
                    }
                }
            }
        }
        covered.sort_unstable();
        covered
    }
}

/// How far ink reaches at most from the middle of a line, in frame pixels, where it is looked for around pixels or
/// drawn in discs.
pub const LARGEST_PX: f32 = 64.0;

/// The box of output pixels that a stamp may ink.
fn reached(window: &Window, stamp: &Stamp) -> ([u32; 2], [u32; 2]) {
    let reach = stamp.half_width.min(LARGEST_PX) + 1.0;
    let [x, y] = stamp.center;
    (
        window.pixel_at([x - reach, y - reach]),
        window.pixel_at([x + reach, y + reach]),
    )
}

/// The share of the pixel around a point of the frame that a stamp covers.
fn coverage(stamp: &Stamp, px: [f32; 2]) -> f32 {
    let off = [px[0] - stamp.center[0], px[1] - stamp.center[1]];
    line_coverage((off[0] * off[0] + off[1] * off[1]).sqrt(), stamp.half_width)
}

/// The input of [`stamp`].
#[derive(Debug, Clone, Copy)]
pub struct Inking<'a> {
    /// The pixel grid of the output.
    pub window: &'a Window,
    /// The pixel grid of the mask.
    pub mask_window: &'a Window,
    /// Parts.
    pub parts: &'a [Part],
    /// Stamps at their last places, an element for each pixel of the mask.
    pub smoothed: &'a [Stamp],
    /// What is decided about the colours of lines, on the mask's grid; may be shorter where no part asks for it.
    pub tints: &'a [LineTint],
}

/// Inks the `covered` pixels of the output, which hold their claims before, as sRGB bytes with coverage in alpha.
///
/// O(covered pixels), parallel over rows.
pub fn stamp(with: &Inking<'_>, covered: &[u32], stamped: &mut [u32]) {
    let width = with.window.size[0] as usize;
    let covered = Listed::of(covered);
    let rows = stamped.par_chunks_mut(width).enumerate();
    rows.for_each(|(y, row)| {
        for (x, _) in covered.row(y, width) {
            row[x] = with.texel(with.window.frame_at(x as u32, y as u32), row[x]);
        }
    });
}

impl Inking<'_> {
    /// The ink of a pixel that a stamp claims.
    fn texel(&self, px: [f32; 2], claim: u32) -> u32 {
        let stamp = &self.smoothed[claim as usize - 1];
        let tints = LineTints {
            mask_window: self.mask_window,
            tints: self.tints,
        };
        let kind = Kind::Intersection;
        let [r, g, b, a] = tints.color_at(self.parts, stamp.part, kind, stamp.center);
        color::pack_rgba8([r, g, b, a * coverage(stamp, px)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SIZE: [u32; 2] = [40, 24];

    fn window() -> Window {
        Window::over([40.0, 24.0], [0.0; 2], [40.0, 24.0], SIZE)
    }

    /// The list of the pixels that fulfil a condition.
    fn listed<T>(of: &[T], is_so: impl Fn(&T) -> bool) -> Vec<u32> {
        let mut listed = vec![0; of.len() + 1];
        let elements = (0..).zip(of).filter(|(_, one)| is_so(one));
        list::fill(&mut listed, &[elements.map(|(i, _)| i).collect()]);
        listed
    }

    fn stamped(stamps: &[Stamp]) -> Vec<u32> {
        listed(stamps, |stamp| stamp.half_width > 0.0)
    }

    fn inked(stamps: &[Stamp]) -> Vec<u32> {
        let window = window();
        let (mut inked, mut covered) = (vec![0; 40 * 24], vec![0; 40 * 24 + 1]);
        claim(&window, &stamped(stamps), stamps, &mut inked, &mut covered);
        let parts = [Part {
            line_color: [0.0, 0.0, 0.0, 1.0],
            ..Part::default()
        }];
        let inking = Inking {
            window: &window,
            mask_window: &window,
            parts: &parts,
            smoothed: stamps,
            tints: &[],
        };
        stamp(&inking, &covered, &mut inked);
        inked
    }

    /// Stamps at pixel centres, smoothed.
    fn smoothed(at: &[[u32; 2]]) -> Vec<[f32; 2]> {
        let mut stamps = vec![Stamp::default(); 40 * 24];
        for [x, y] in at {
            let center = [*x as f32 + 0.5, *y as f32 + 0.5];
            stamps[(y * 40 + x) as usize] = Stamp {
                center,
                half_width: 1.0,
                part: 0,
            };
        }
        let mut smoothed = stamps.clone();
        let on = Stamps {
            mask_window: &window(),
            mask: &[MASK_OWNER; 40 * 24],
            stamps: &stamps,
        };
        smooth(&on, &stamped(&stamps), &mut smoothed);
        let of = |[x, y]: &[u32; 2]| smoothed[(y * 40 + x) as usize].center;
        at.iter().map(of).collect()
    }

    /// How many stamps are found where a mask owns a line of `kinds` at some pixels, and nothing is inked.
    fn found(kinds: u32, at: &[[u32; 2]]) -> usize {
        found_in(&mask_of(kinds, at)).len()
    }

    /// A mask that owns a line of `kinds` at some pixels.
    fn mask_of(kinds: u32, at: &[[u32; 2]]) -> Vec<u32> {
        let mut mask = vec![0; 40 * 24];
        for [x, y] in at {
            mask[(y * 40 + x) as usize] = kinds | MASK_OWNER | MASK_SIDE;
        }
        mask
    }

    /// The pixels of a mask that get stamps where nothing is inked.
    fn found_in(mask: &[u32]) -> Vec<usize> {
        let parts = [Part {
            flags: Part::LINES,
            ..Part::default()
        }];
        let surface = GPixel {
            part: 0,
            half_width: 2.0,
            ..GPixel::EMPTY
        };
        let window = window();
        let search = Search {
            window: &window,
            mask_window: &window,
            parts: &parts,
            gbuffer: &[surface; 40 * 24],
            mask,
            ribbons: &[0; 40 * 24],
        };
        let mut stamps = vec![Stamp::default(); 40 * 24];
        let mut found = vec![0; 40 * 24 + 1];
        let owners = listed(mask, |marks| marks & MASK_OWNER != 0);
        find(&search, &owners, &mut stamps, &mut found);
        assert_eq!(found, stamped(&stamps));
        let found = Listed::of(&found);
        found
            .all()
            .iter()
            .map(|element| *element as usize)
            .collect()
    }

    #[test]
    fn a_dot_beside_an_outline_is_no_part_of_it() {
        let outline: Vec<[u32; 2]> = (5..30).map(|x| [x, 10]).collect();
        let dots = [[10, 11], [11, 11], [20, 11]];
        let mut mask = mask_of(Outline::OBJECT_ID | Outline::DEPTH, &outline);
        for (pixel, dot) in mask.iter_mut().zip(mask_of(Outline::DEPTH, &dots)) {
            *pixel |= dot;
        }
        let of_outline: Vec<usize> = (405..430).collect();
        assert_eq!(found_in(&mask), of_outline);
    }

    #[test]
    fn a_surface_has_no_dots_on_it() {
        let line: Vec<[u32; 2]> = (5..30).map(|x| [x, 10]).collect();
        let dot = [[5, 10], [6, 10], [5, 11]];
        for kinds in [Outline::NORMAL, Outline::DEPTH] {
            assert_eq!(found(kinds, &dot), 0);
            // Both ends fade out over two pixels.
            assert_eq!(found(kinds, &line), line.len() - 4);
        }
        // What parts it from others may be as short as it likes.
        for kinds in [Outline::OBJECT_ID, Outline::PIECE | Outline::NORMAL] {
            assert_eq!(found(kinds, &dot), 3);
        }
        // Corners of the mask are no dots for want of room.
        assert_eq!(found(Outline::NORMAL, &[[0, 0], [1, 0], [39, 23]]), 0);
    }

    #[test]
    fn the_ends_of_a_line_stay() {
        let line: Vec<[u32; 2]> = (5..25).map(|x| [x, 10]).collect();
        for (center, [x, y]) in smoothed(&line).iter().zip(&line) {
            assert!((center[0] - *x as f32 - 0.5).abs() < 1e-4);
            assert!((center[1] - *y as f32 - 0.5).abs() < 1e-4);
        }
    }

    #[test]
    fn steps_of_the_grid_are_evened_out() {
        let stairs: Vec<[u32; 2]> = (4..34).map(|x| [x, 4 + x / 2]).collect();
        let off = |[x, y]: &[f32; 2]| (y - 4.0 - x / 2.0).abs();
        let centers = smoothed(&stairs);
        assert!(
            centers.iter().all(|center| off(center) < 0.2),
            "{centers:?}"
        );
    }

    proptest! {
        #[test]
        fn every_stamp_inks_its_disc_and_nothing_else(
            at in prop::collection::vec((0u32..40, 0u32..24), 0..6), half in 0.6f32..3.0,
        ) {
            let mut stamps = vec![Stamp::default(); 40 * 24];
            for (x, y) in &at {
                let center = [*x as f32 + 0.5, *y as f32 + 0.5];
                stamps[(y * 40 + x) as usize] = Stamp { center, half_width: half, part: 0 };
            }
            for (i, texel) in inked(&stamps).iter().enumerate() {
                let (x, y) = (i as u32 % 40, i as u32 / 40);
                let nearest = at.iter().map(|(sx, sy)| {
                    let (dx, dy) = (x as f32 - *sx as f32, y as f32 - *sy as f32);
                    (dx * dx + dy * dy).sqrt()
                }).fold(f32::MAX, f32::min);
                let alpha = texel >> 24;
                prop_assert!(nearest > half - 0.5 || alpha == 255);
                prop_assert!(nearest < half + 0.5 || alpha == 0);
            }
        }
    }
}
