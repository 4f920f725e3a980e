//! Tells lines of dark paint from spots, corners of areas, and chequers.

use std::collections::VecDeque;

/// Least ratio of a line's length to its width.
const SLENDERNESS: f32 = 4.0;

/// Least length of a line in widths of the widest usual line: cells of a chequer look as slender as lines where their
/// surface turns away.
const LEAST_LENGTH: f32 = 3.0;

/// Share of a patch's greatest depth up to which its ink is cut as a neck: cells of a chequer are joined by less at
/// their corners.
const NECK: f32 = 0.5;

/// Depth under which a patch has no necks: a pixel more or less in the width of a fine line is none.
const NECKLESS: f32 = 3.0;

/// Most of the paint around a line that ink may cover, as a share: a chequer covers half of it, two lines side by side
/// a little less.
const CROWD: f32 = 0.42;

/// Dark (or light) paint of a picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Paint<'a> {
    /// Pixels that may be parts of lines.
    pub ink: &'a [bool],
    /// Pixels of ink that are thin.
    pub thin: &'a [bool],
    /// Pixels that show paint at all.
    pub ground: &'a [bool],
    /// Pixels whose surface does not turn away from the eye.
    pub facing: &'a [bool],
    /// Pixels of a row.
    pub width: usize,
    /// Greatest width of usual lines, in pixels.
    pub usual_width: usize,
    /// Distance up to which the paint around a line is counted, in pixels.
    pub around: usize,
}

/// Which pixels of ink are parts of lines: pieces at least [`SLENDERNESS`] times as long as wide, once the ink is cut
/// at its necks.
///
/// Most of a connected patch has to be thin, to lie on surfaces that face the eye, and to have more bare paint around
/// it than ink. O(pixels).
pub(super) fn slender(paint: &Paint<'_>) -> Vec<bool> {
    let Paint {
        ink, thin, width, ..
    } = *paint;
    let inked = |pixel: usize| u32::from(ink[pixel]);
    let whole = Patches::of(ink.len(), width, &inked);
    let depth = depths(&whole.of_pixel, width);
    let deepest = whole.greatest(&depth);

    // Cut at the necks: what lies no deeper than a neck, and not beside what does.
    let neck = |patch: u32| match deepest[patch as usize] {
        thin if thin < NECKLESS => 0.0,
        thick => NECK * thick,
    };
    let is_core = |pixel: usize| {
        let patch = whole.of_pixel[pixel];
        patch != 0 && depth[pixel] > neck(patch)
    };
    let away = distances(&whole.of_pixel, width, &is_core);
    let kind = |pixel: usize| match whole.of_pixel[pixel] {
        0 => 0,
        patch => 2 * patch + u32::from(away[pixel] <= neck(patch)),
    };
    let pieces = Patches::of(ink.len(), width, &kind);

    // Count what of every patch is slender, and what is thin.
    let widest = pieces.greatest(&depth);
    let least_length = LEAST_LENGTH * paint.usual_width as f32;
    let is_line = |piece: usize| {
        let across = (2.0 * widest[piece] - 1.0).max(1.0);
        let length = pieces.areas[piece] as f32 / across;
        length >= SLENDERNESS * across && length >= least_length
    };
    let lies_open = open(paint);
    let mut counts = vec![[0usize; 4]; whole.areas.len()];
    for pixel in 0..ink.len() {
        let [slender, thin_count, open, facing] = &mut counts[whole.of_pixel[pixel] as usize];
        *slender += usize::from(is_line(pieces.of_pixel[pixel] as usize));
        *thin_count += usize::from(thin[pixel]);
        *open += usize::from(lies_open[pixel]);
        *facing += usize::from(paint.facing[pixel]);
    }
    let is_kept = |patch: usize| {
        let least = counts[patch].into_iter().min().unwrap_or(0);
        patch != 0 && 2 * least >= whole.areas[patch]
    };
    let of_pixel = whole.of_pixel.iter();
    of_pixel.map(|patch| is_kept(*patch as usize)).collect()
}

/// Whether ink covers no more than [`CROWD`] of the paint in the square around every pixel.
fn open(paint: &Paint<'_>) -> Vec<bool> {
    let [ink, ground] = [paint.ink, paint.ground].map(|of| sums(of, paint.width));
    let (width, height) = (paint.width, paint.ink.len() / paint.width);
    let is_open = |pixel: usize| {
        let (x, y) = (pixel % width, pixel / width);
        let [left, top] = [x, y].map(|v| v.saturating_sub(paint.around));
        let (right, bottom) = (
            (x + paint.around + 1).min(width),
            (y + paint.around + 1).min(height),
        );
        let count = |sums: &[u32]| {
            let at = |x: usize, y: usize| sums[y * (width + 1) + x];
            at(right, bottom) + at(left, top) - at(left, bottom) - at(right, top)
        };
        count(&ink) as f32 <= CROWD * count(&ground) as f32
    };
    (0..paint.ink.len()).map(is_open).collect()
}

/// Number of set pixels above and to the left of every corner of pixels.
fn sums(set: &[bool], width: usize) -> Vec<u32> {
    let mut sums = vec![0; (width + 1) * (set.len() / width + 1)];
    for (pixel, is_set) in set.iter().enumerate() {
        let at = (pixel / width + 1) * (width + 1) + pixel % width + 1;
        let above = at - width - 1;
        sums[at] = u32::from(*is_set) + sums[at - 1] + sums[above] - sums[above - 1];
    }
    sums
}

/// Connected patches of pixels of one kind, joined by their sides and numbered from 1; 0 is no patch.
struct Patches {
    of_pixel: Vec<u32>,
    /// Number of pixels of every patch.
    areas: Vec<usize>,
}

impl Patches {
    /// The patches of pixels of the same kind other than 0.
    fn of(count: usize, width: usize, kind: &dyn Fn(usize) -> u32) -> Self {
        let kinds: Vec<u32> = (0..count).map(kind).collect();
        let (mut of_pixel, mut areas) = (vec![0; count], vec![0]);
        let mut reached = VecDeque::new();
        for first in 0..count {
            if kinds[first] == 0 || of_pixel[first] != 0 {
                continue;
            }

            // Begin a patch at a pixel that belongs to none.
            let patch = areas.len() as u32;
            areas.push(0);
            of_pixel[first] = patch;
            reached.push_back(first);

            // Let it grow over neighbours of the same kind.
            while let Some(pixel) = reached.pop_front() {
                areas[patch as usize] += 1;
                for other in beside(pixel, width, count) {
                    if kinds[other] == kinds[first] && of_pixel[other] == 0 {
                        of_pixel[other] = patch;
                        reached.push_back(other);
                    }
                }
            }
        }
        Self { of_pixel, areas }
    }

    /// The greatest value of every patch.
    fn greatest(&self, values: &[f32]) -> Vec<f32> {
        let mut greatest = vec![0.0f32; self.areas.len()];
        for (patch, value) in self.of_pixel.iter().zip(values) {
            let best = &mut greatest[*patch as usize];
            *best = best.max(*value);
        }
        greatest
    }
}

/// The pixels that share a side with one.
fn beside(pixel: usize, width: usize, count: usize) -> impl Iterator<Item = usize> {
    let x = pixel % width;
    let left = (x > 0).then(|| pixel - 1);
    let right = (x + 1 < width).then(|| pixel + 1);
    let below = Some(pixel + width).filter(|other| *other < count);
    [left, right, pixel.checked_sub(width), below]
        .into_iter()
        .flatten()
}

/// Depth of every pixel in its patch: 1 at its rim.
fn depths(patches: &[u32], width: usize) -> Vec<f32> {
    let count = patches.len();
    let is_rim = |pixel: usize| {
        let same = beside(pixel, width, count).filter(|other| patches[*other] == patches[pixel]);
        same.count() < 4
    };
    let depth = distances(patches, width, &is_rim);
    let of_pixel = patches.iter().zip(depth);
    of_pixel
        .map(|(patch, away)| if *patch == 0 { 0.0 } else { away + 1.0 })
        .collect()
}

/// Distance of every pixel from the nearest source within its own patch, in steps of 1 along and across and diagonal
/// ones of 4/3 [Borgefors 1986].
fn distances(patches: &[u32], width: usize, is_source: &dyn Fn(usize) -> bool) -> Vec<f32> {
    let count = patches.len();

    // Start at the sources.
    let start = |pixel: usize| if is_source(pixel) { 0.0 } else { f32::INFINITY };
    let mut away: Vec<f32> = (0..count).map(start).collect();

    // Lower a pixel to the shortest way by way of the neighbours that were visited already.
    let mut lower = |pixel: usize, forward: bool| {
        let (x, y) = (pixel % width, pixel / width);
        let steps: [(isize, isize, f32); 4] = [
            (-1, 0, 1.0),
            (-1, -1, 4.0 / 3.0),
            (0, -1, 1.0),
            (1, -1, 4.0 / 3.0),
        ];
        for (dx, dy, length) in steps {
            let (dx, dy) = if forward { (dx, dy) } else { (-dx, -dy) };
            let Some((x, y)) = x.checked_add_signed(dx).zip(y.checked_add_signed(dy)) else {
                continue;
            };
            let other = y * width + x;
            if x < width && other < count && patches[other] == patches[pixel] {
                away[pixel] = away[pixel].min(away[other] + length);
            }
        }
    };

    // Sweep forth and back, which reaches everything.
    (0..count).for_each(|pixel| lower(pixel, true));
    (0..count).rev().for_each(|pixel| lower(pixel, false));
    away
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: usize = 64;

    fn kept_of(ink: &[bool], thin: &[bool]) -> Vec<bool> {
        slender(&Paint {
            ink,
            thin,
            ground: &[true; SIDE * SIDE],
            facing: &[true; SIDE * SIDE],
            width: SIDE,
            usual_width: 8,
            around: 12,
        })
    }

    /// What is kept of a picture, all of it thin.
    fn kept(is_ink: impl Fn(usize, usize) -> bool) -> usize {
        let ink: Vec<bool> = (0..SIDE * SIDE)
            .map(|i| is_ink(i % SIDE, i / SIDE))
            .collect();
        let kept = kept_of(&ink, &ink);
        assert!(kept.iter().zip(&ink).all(|(kept, ink)| *ink || !kept));
        kept.iter().filter(|kept| **kept).count()
    }

    #[test]
    fn bars_rings_and_crosses_are_lines() {
        assert_eq!(kept(|x, y| y == 30 && (10..40).contains(&x)), 30);
        assert_eq!(
            kept(|x, y| (20..26).contains(&y) && (5..60).contains(&x)),
            330
        );
        let is_bar = |v: usize| (30..35).contains(&v);
        assert_eq!(kept(|x, y| is_bar(x) || is_bar(y)), 2 * 5 * 64 - 25);
        let ring = |x: usize, y: usize| {
            let away = (x as f32 - 32.0).hypot(y as f32 - 32.0);
            (18.0..24.0).contains(&away)
        };
        let area = (0..SIDE * SIDE)
            .filter(|i| ring(i % SIDE, i / SIDE))
            .count();
        assert_eq!(kept(ring), area);
    }

    #[test]
    fn specks_discs_and_stubs_are_none() {
        assert_eq!(kept(|x, y| (x, y) == (5, 5)), 0);
        assert_eq!(kept(|x, y| y == 5 && (3..12).contains(&x)), 0);
        assert_eq!(
            kept(|x, y| (10..18).contains(&x) && (10..18).contains(&y)),
            0
        );
        assert_eq!(
            kept(|x, y| (x as f32 - 30.0).hypot(y as f32 - 30.0) < 6.0),
            0
        );
        assert_eq!(kept(|_, _| false), 0);
    }

    /// Its cells touch at their corners, and a pixel more joins them there.
    #[test]
    fn a_chequer_is_none_however_its_cells_are_joined() {
        for cell in [5, 8, 13] {
            let is_dark = move |x: usize, y: usize| (x / cell + y / cell) % 2 == 1;
            assert_eq!(kept(is_dark), 0, "{cell}");
            let is_joined = move |x: usize, y: usize| {
                let near = |v: usize| v.is_multiple_of(cell) && v > 0;
                is_dark(x, y) || near(x) && near(y)
            };
            assert_eq!(kept(is_joined), 0, "{cell} joined");
        }
    }

    #[test]
    fn a_line_with_a_knot_is_one() {
        let knot = |x: usize, y: usize| (28..36).contains(&x) && (20..28).contains(&y);
        assert_eq!(
            kept(|x, y| knot(x, y) || (23..26).contains(&y)),
            3 * 64 + 64 - 24
        );
    }

    #[test]
    fn what_is_wide_for_the_most_part_is_none() {
        let ink: Vec<bool> = (0..SIDE * SIDE)
            .map(|i| (20..30).contains(&(i / SIDE)))
            .collect();
        let thin: Vec<bool> = (0..SIDE * SIDE).map(|i| ink[i] && i % SIDE < 20).collect();
        assert!(kept_of(&ink, &thin).iter().all(|kept| !kept));
        assert_eq!(kept_of(&ink, &ink), ink);
    }
}
