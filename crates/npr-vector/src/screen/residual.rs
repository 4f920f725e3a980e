//! Lines that run along no mesh edge: the twins of `line.find_residual`, `line.smooth_stamps`,
//! `line.flag_tiles` and `line.stamp_residual`.
//!
//! Where shapes meet or interpenetrate, the mask shows a line and no edge lies there. Such pixels become discs, as wide
//! as the surface says, and a row of discs is a line.

use crate::screen::ribbon::line_coverage;
use npr_core::color;
use npr_core::geometry::{GPixel, NONE, Part, Stamp};
use npr_core::line_color::{LineTint, LineTints};
use npr_core::line_kind::Kind;
use npr_core::outline::{MASK_OWNER, MASK_SIDE, Outline};
use npr_core::window::Window;
use rayon::prelude::*;

/// Side of the square tiles in which stamps are looked for, in mask pixels.
pub const TILE: u32 = 16;

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

/// A stamp for every mask pixel that owns a line and has no ribbon near it, centred on the border between the pixels
/// that differ.
///
/// O(mask pixels), parallel over rows.
pub fn find(on: &Search<'_>, stamps: &mut [Stamp]) {
    let width = on.mask_window.size[0] as usize;
    stamps
        .par_chunks_mut(width)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, stamp) in row.iter_mut().enumerate() {
                *stamp = on.stamp_at(x as u32, y as u32).unwrap_or_default();
            }
        });
}

impl Search<'_> {
    fn stamp_at(&self, x: u32, y: u32) -> Option<Stamp> {
        // Take pixels that own a line of a surface with lines.
        let element = (y * self.mask_window.size[0] + x) as usize;
        let (found, pixel) = (self.mask[element], &self.gbuffer[element]);
        if found & MASK_OWNER == 0 || pixel.part == NONE {
            return None;
        }
        if self.parts[pixel.part as usize].flags & Part::LINES == 0 {
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
        let component = |pixel: &GPixel| self.parts[pixel.part as usize].component;
        a.part != NONE
            && a.object == b.object
            && a.material == b.material
            && component(a) == component(b)
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

/// Moves every stamp across its line to the middle of the stamps of its part around it, so that the steps of the pixel
/// grid do not show.
///
/// O(mask pixels + 49 per stamp), parallel over rows.
pub fn smooth(mask_window: &Window, stamps: &[Stamp], smoothed: &mut [Stamp]) {
    let size = mask_window.size;
    let width = size[0] as usize;
    smoothed
        .par_chunks_mut(width)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, out) in row.iter_mut().enumerate() {
                let stamp = stamps[y * width + x];
                *out = stamp;
                if stamp.half_width > 0.0 {
                    let by = move_across(&cloud_around(size, stamps, [x as u32, y as u32], &stamp));
                    out.center = [stamp.center[0] + by[0], stamp.center[1] + by[1]];
                }
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

/// The stamps of the same part around a stamp.
fn cloud_around(size: [u32; 2], stamps: &[Stamp], at: [u32; 2], middle: &Stamp) -> Cloud {
    // Enclose the mask pixels within reach.
    let low = at.map(|v| v.saturating_sub(SMOOTHING_REACH));
    let high: [u32; 2] = std::array::from_fn(|i| (at[i] + SMOOTHING_REACH).min(size[i] - 1));

    // Sum up the stamps of the same part.
    let mut cloud = Cloud::default();
    for y in low[1]..=high[1] {
        for x in low[0]..=high[0] {
            let stamp = &stamps[(y * size[0] + x) as usize];
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

/// Tiles across a mask.
fn tiles_across(mask_window: &Window) -> u32 {
    mask_window.size[0].div_ceil(TILE)
}

/// Number of tiles over a mask of this size.
pub fn tile_count(size: [u32; 2]) -> usize {
    size[0].div_ceil(TILE) as usize * size[1].div_ceil(TILE) as usize
}

/// 1 for every tile that holds a stamp, else 0. O(mask pixels), parallel over tiles.
pub fn flag_tiles(mask_window: &Window, stamps: &[Stamp], tiles: &mut [u32]) {
    let (across, size) = (tiles_across(mask_window), mask_window.size);
    tiles
        .par_iter_mut()
        .enumerate()
        .for_each(|(element, tile)| {
            let left = element as u32 % across * TILE;
            let top = element as u32 / across * TILE;
            let right = (left + TILE).min(size[0]);
            let found = (top..(top + TILE).min(size[1])).any(|y| {
                let row = &stamps[(y * size[0] + left) as usize..(y * size[0] + right) as usize];
                row.iter().any(|stamp| stamp.half_width > 0.0)
            });
            *tile = u32::from(found);
        });
}

/// The input of [`stamp`].
#[derive(Debug, Clone, Copy)]
pub struct Inking<'a> {
    /// The pixel grid of the output.
    pub window: &'a Window,
    /// The pixel grid of the mask.
    pub mask_window: &'a Window,
    /// Settings.
    pub outline: &'a Outline,
    /// Parts.
    pub parts: &'a [Part],
    /// Stamps, one per mask pixel.
    pub stamps: &'a [Stamp],
    /// 1 for every tile that holds a stamp.
    pub tiles: &'a [u32],
    /// What is decided about the colours of lines, on the mask's grid; may be shorter where no part asks for it.
    pub tints: &'a [LineTint],
}

/// Inks the output around every stamp, as sRGB bytes with coverage in alpha; 0 where there is none.
///
/// The stamp that covers a pixel most wins, and of equal ones the first. O(pixels near stamps * reach squared),
/// parallel.
pub fn stamp(with: &Inking<'_>, stamped: &mut [u32]) {
    let width = with.window.size[0] as usize;
    stamped
        .par_chunks_mut(width)
        .enumerate()
        .for_each(|(y, row)| {
            row.fill(0);
            for (run, texels) in row.chunks_mut(TILE as usize).enumerate() {
                let left = run as u32 * TILE;
                if with.run_has_stamps(left, left + texels.len() as u32 - 1, y as u32) {
                    for (x, texel) in (left..).zip(texels) {
                        *texel = with.texel(with.window.frame_at(x, y as u32));
                    }
                }
            }
        });
}

impl Inking<'_> {
    /// Whether any stamp may reach the pixels from `left` to `right` of a row of the output.
    fn run_has_stamps(&self, left: u32, right: u32, y: u32) -> bool {
        let (low, _) = self.reachable(self.window.frame_at(left, y));
        let (_, high) = self.reachable(self.window.frame_at(right, y));
        self.any_stamp(low, high)
    }

    /// The box of mask pixels whose stamps may reach a point of the frame.
    fn reachable(&self, px: [f32; 2]) -> ([u32; 2], [u32; 2]) {
        // Smoothing moves stamps from their pixels.
        let room = 1.0 + SMOOTHING_REACH as f32;
        let reach = self
            .mask_window
            .frame_step
            .map(|step| self.outline.reach_px as f32 + room * step);
        (
            self.mask_window
                .pixel_at([px[0] - reach[0], px[1] - reach[1]]),
            self.mask_window
                .pixel_at([px[0] + reach[0], px[1] + reach[1]]),
        )
    }

    fn texel(&self, px: [f32; 2]) -> u32 {
        // Look only where stamps may reach.
        let (low, high) = self.reachable(px);
        if !self.any_stamp(low, high) {
            return 0;
        }

        // Let the stamp that covers most ink the place.
        let (mut best, mut part, mut center) = (0.0, NONE, [0.0; 2]);
        for y in low[1]..=high[1] {
            let row = (y * self.mask_window.size[0]) as usize;
            for stamp in &self.stamps[row + low[0] as usize..=row + high[0] as usize] {
                if stamp.half_width > 0.0 {
                    let off = [px[0] - stamp.center[0], px[1] - stamp.center[1]];
                    let distance = (off[0] * off[0] + off[1] * off[1]).sqrt();
                    let coverage = line_coverage(distance, stamp.half_width);
                    if coverage > best {
                        (best, part, center) = (coverage, stamp.part, stamp.center);
                    }
                }
            }
        }
        if part == NONE {
            return 0;
        }

        // Tint it as the lines of its surface.
        let tints = LineTints {
            mask_window: self.mask_window,
            tints: self.tints,
        };
        let [r, g, b, a] = tints.color_at(self.parts, part, Kind::Intersection, center);
        color::pack_rgba8([r, g, b, a * best])
    }

    /// Whether any tile that meets the box of mask pixels holds a stamp.
    fn any_stamp(&self, low: [u32; 2], high: [u32; 2]) -> bool {
        let across = tiles_across(self.mask_window);
        (low[1] / TILE..=high[1] / TILE).any(|y| {
            (low[0] / TILE..=high[0] / TILE).any(|x| self.tiles[(y * across + x) as usize] != 0)
        })
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

    fn inked(stamps: &[Stamp]) -> Vec<u32> {
        let window = window();
        let mut tiles = vec![0; tile_count(SIZE)];
        flag_tiles(&window, stamps, &mut tiles);
        let outline = Outline {
            reach_px: 4,
            ..Outline::default()
        };
        let parts = [Part {
            line_color: [0.0, 0.0, 0.0, 1.0],
            ..Part::default()
        }];
        let inking = Inking {
            window: &window,
            mask_window: &window,
            outline: &outline,
            parts: &parts,
            stamps,
            tiles: &tiles,
            tints: &[],
        };
        let mut stamped = vec![0; 40 * 24];
        stamp(&inking, &mut stamped);
        stamped
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
        smooth(&window(), &stamps, &mut smoothed);
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
        find(&search, &mut stamps);
        let is_found = |i: &usize| stamps[*i].half_width > 0.0;
        (0..stamps.len()).filter(is_found).collect()
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
