//! What every place of an outline looks like beside its rim and before what lies behind it.
//!
//! A *place* is a pixel outside a character with a pixel of the character among its eight neighbours. Its line is
//! looked for among the pixels around it that show nothing of the character; what the line covers only partly is
//! divided out. All of it comes from finished pictures, so that methods of any kind can be held against each other.

use npr_core::color::linear_from_srgb;
use npr_render::Frame;
use palette::{IntoColor, LinSrgb, Oklab};

/// Lightness, in OKLab, that a line must differ by from what lies behind it.
pub const CONTRAST: f32 = 0.3;

/// What rounding to bytes may take from that.
const ROUNDING: f32 = 0.01;

/// Distance in OKLab from which two colours of a line are no longer the same.
pub const FLIP: f32 = 0.1;

/// Distance up to which rims, and what lies behind, count as the same.
const SAME: f32 = 0.05;

/// How far from a place its line is looked for, in pixels.
const LINE_REACH: i32 = 2;

/// How far, in pixels, an outline may move between two frames and still be compared.
const MOVE_REACH: i32 = 4;

/// Coverage from which a pixel's line has a colour.
const COVERED: f32 = 0.5;

/// Four pictures of the same moment.
#[derive(Debug, Clone, Copy)]
pub struct Pictures<'a> {
    /// Without lines, before the background.
    pub bare: &'a Frame,
    /// With lines, before the background.
    pub drawn: &'a Frame,
    /// Without lines, transparent behind.
    pub alone: &'a Frame,
    /// With lines, transparent behind.
    pub lined: &'a Frame,
}

/// A place of an outline.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// Its pixel.
    pub px: [i32; 2],
    /// Mean colour of the character beside it.
    pub rim: Oklab,
    /// Mean colour of what lies behind.
    pub behind: Oklab,
    /// By how much the line's lightness differs from what lies behind: the median over the pixels around, for the
    /// mean of a dark and a light wall is a wall that is not there. 0 without a line.
    pub contrast: f32,
    /// Colour of the line, where there is any.
    pub line: Option<Oklab>,
}

/// What the places of one picture come to.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Verdict {
    /// Places that have a line.
    pub lined: usize,
    /// Those whose line is too near in lightness to what lies behind.
    pub below: usize,
    /// Sum of distances in OKLab between line and rim.
    pub distance: f64,
}

impl Verdict {
    /// Of some places.
    pub fn of(places: &[Place]) -> Self {
        let mut verdict = Self::default();
        for place in places {
            let Some(line) = place.line else { continue };
            verdict.lined += 1;
            verdict.below += usize::from(place.contrast < CONTRAST - ROUNDING);
            verdict.distance += f64::from(distance(line, place.rim));
        }
        verdict
    }

    /// Both together.
    pub fn and(self, other: Self) -> Self {
        Self {
            lined: self.lined + other.lined,
            below: self.below + other.below,
            distance: self.distance + other.distance,
        }
    }

    /// Share of lined places below the contrast.
    pub fn share_below(&self) -> f64 {
        self.below as f64 / self.lined.max(1) as f64
    }

    /// Mean distance between line and rim.
    pub fn mean_distance(&self) -> f64 {
        self.distance / self.lined.max(1) as f64
    }
}

/// The places of an outline. O(pixels).
pub fn places(pictures: &Pictures<'_>) -> Vec<Place> {
    let [width, height] = pictures.alone.size.map(|side| side as i32);
    let is_inside = |px: [i32; 2]| Pixel::of(pictures.alone, px).is_some_and(|p| p.alpha >= 0.5);
    let mut places = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let px = [x, y];
            if !is_inside(px) && around(px, 1).any(is_inside) {
                places.extend(place(pictures, px));
            }
        }
    }
    places
}

/// What a place looks like; `None` where everything around is half the character's.
fn place(pictures: &Pictures<'_>, px: [i32; 2]) -> Option<Place> {
    // Take the colour of the rim from the character's own pixels.
    let alone = |at| Pixel::of(pictures.alone, at);
    let of_rim = around(px, 2).filter_map(alone).filter(|p| p.alpha == 1.0);
    let is_free = |at: &[i32; 2]| alone(*at).is_some_and(|p| p.alpha == 0.0);
    let free = || around(px, LINE_REACH).filter(is_free);
    let rim = mean(of_rim.map(|p| p.light))?;

    // Take what lies behind from pixels that the character leaves free.
    let behind = mean(
        free()
            .filter_map(|at| Pixel::of(pictures.bare, at))
            .map(|p| p.light),
    )?;

    // Take the line's colour where it covers most, the background taken out.
    let covered = |at: [i32; 2]| Pixel::of(pictures.lined, at).map_or(0.0, |p| p.alpha);
    let most = free().max_by(|a, b| covered(*a).total_cmp(&covered(*b)));
    let line = most.filter(|at| covered(*at) >= COVERED).and_then(|at| {
        let (drawn, bare) = (
            Pixel::of(pictures.drawn, at)?,
            Pixel::of(pictures.bare, at)?,
        );
        let share = covered(at);
        Some(std::array::from_fn(|i| {
            ((drawn.light[i] - (1.0 - share) * bare.light[i]) / share).clamp(0.0, 1.0)
        }))
    });
    let line = line.map(lab);
    let against = |line: Oklab| {
        let grounds = free().filter_map(|at| Pixel::of(pictures.bare, at));
        median(grounds.map(|ground| (lab(ground.light).l - line.l).abs()))
    };
    Some(Place {
        px,
        rim: lab(rim),
        behind: lab(behind),
        contrast: line.map_or(0.0, against),
        line,
    })
}

/// How many lined places flip between two frames: the outline goes on beside them, along the same rim and before the
/// same background, but nowhere there in its colour. Also how many were compared. O(places).
pub fn flips(before: &[Place], after: &[Place], size: [u32; 2]) -> [usize; 2] {
    // Lay out the places of the later frame.
    let width = size[0] as i32;
    let mut at = vec![None; size[0] as usize * size[1] as usize];
    for place in after {
        at[(place.px[1] * width + place.px[0]) as usize] = Some(place);
    }
    let is_in = |px: &[i32; 2]| px[0] >= 0 && px[1] >= 0 && px[0] < width && px[1] < size[1] as i32;
    let (mut flipped, mut compared) = (0, 0);
    for place in before {
        let Some(line) = place.line else { continue };

        // Find places beside it along the same rim and before the same background.
        let near = around(place.px, MOVE_REACH).filter(is_in);
        let near = near.filter_map(|px| at[(px[1] * width + px[0]) as usize]);
        let alike = near.filter(|other| {
            distance(other.rim, place.rim) < SAME && distance(other.behind, place.behind) < SAME
        });
        let changes: Vec<f32> = alike
            .filter_map(|other| Some(distance(other.line?, line)))
            .collect();

        // Count a flip where none of them has its colour.
        if changes.is_empty() {
            continue;
        }
        compared += 1;
        flipped += usize::from(changes.iter().all(|change| *change > FLIP));
    }
    [flipped, compared]
}

/// A pixel in linear light.
struct Pixel {
    light: [f32; 3],
    alpha: f32,
}

impl Pixel {
    /// Of a frame; none outside of it.
    fn of(frame: &Frame, [x, y]: [i32; 2]) -> Option<Self> {
        let [width, height] = frame.size.map(|side| side as i32);
        if x < 0 || y < 0 || x >= width || y >= height {
            return None;
        }
        let start = (y * width + x) as usize * 4;
        let rgba: [u8; 4] = frame.rgba[start..start + 4].try_into().ok()?;
        let [r, g, b, a] = rgba.map(|byte| f32::from(byte) / 255.0);
        Some(Self {
            light: [r, g, b].map(linear_from_srgb),
            alpha: a,
        })
    }
}

/// The pixels within `reach` of one, itself included, on squares.
fn around([x, y]: [i32; 2], reach: i32) -> impl Iterator<Item = [i32; 2]> {
    (-reach..=reach).flat_map(move |dy| (-reach..=reach).map(move |dx| [x + dx, y + dy]))
}

fn mean(colors: impl Iterator<Item = [f32; 3]>) -> Option<[f32; 3]> {
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for color in colors {
        sum = std::array::from_fn(|i| sum[i] + color[i]);
        count += 1.0;
    }
    (count > 0.0).then(|| sum.map(|v| v / count))
}

fn median(values: impl Iterator<Item = f32>) -> f32 {
    let mut values: Vec<f32> = values.collect();
    values.sort_by(f32::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}

fn lab([r, g, b]: [f32; 3]) -> Oklab {
    LinSrgb::new(r, g, b).into_color()
}

fn distance(a: Oklab, b: Oklab) -> f32 {
    let [l, green, blue] = [a.l - b.l, a.a - b.a, a.b - b.b];
    (l * l + green * green + blue * blue).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture 16 by 8 of columns: each a colour and alpha.
    fn columns(of: impl Fn(u32) -> [u8; 4]) -> Frame {
        let mut rgba = Vec::new();
        for _ in 0..8 {
            (0..16).for_each(|x| rgba.extend(of(x)));
        }
        Frame {
            size: [16, 8],
            rgba,
            ..Frame::default()
        }
    }

    /// A green character up to column 7, a line of a colour on columns 8 and 9, before another colour.
    fn judged(line: [u8; 3], behind: [u8; 3]) -> Vec<Place> {
        let green = [0, 160, 0, 255];
        let opaque = |[r, g, b]: [u8; 3]| [r, g, b, 255];
        let pick = |line: [u8; 4], behind: [u8; 4]| {
            columns(move |x| match x {
                0..8 => green,
                8..10 => line,
                _ => behind,
            })
        };
        let (line, behind) = (opaque(line), opaque(behind));
        places(&Pictures {
            bare: &pick(behind, behind),
            drawn: &pick(line, behind),
            alone: &pick([0; 4], [0; 4]),
            lined: &pick(line, [0; 4]),
        })
    }

    #[test]
    fn a_black_line_is_lost_on_black_and_reads_on_white() {
        let [on_black, on_white] = [[0; 3], [255; 3]].map(|behind| judged([0; 3], behind));
        assert_eq!(on_black.len(), 8);
        assert_eq!(Verdict::of(&on_black).share_below(), 1.0);
        assert_eq!(Verdict::of(&on_white).share_below(), 0.0);
    }

    #[test]
    fn a_line_in_the_rims_color_has_no_distance() {
        let verdict = Verdict::of(&judged([0, 160, 0], [0; 3]));
        assert!(verdict.lined == 8 && verdict.mean_distance() < 1e-3);
        assert!(Verdict::of(&judged([255, 0, 0], [0; 3])).mean_distance() > 0.3);
    }

    #[test]
    fn half_covered_lines_are_divided_out() {
        let half = columns(|x| {
            if x < 8 {
                [9, 9, 9, 255]
            } else {
                [200, 0, 0, 153]
            }
        });
        let alone = columns(|x| if x < 8 { [9, 9, 9, 255] } else { [0; 4] });
        let white = columns(|x| if x < 8 { [9, 9, 9, 255] } else { [255; 4] });
        let mixed = columns(|x| {
            let over = |line: u8| {
                let [line, white] = [line, 255].map(|v| linear_from_srgb(f32::from(v) / 255.0));
                let mixed = npr_core::color::srgb_from_linear(0.6 * line + 0.4 * white);
                (mixed * 255.0 + 0.5) as u8
            };
            if x < 8 {
                [9, 9, 9, 255]
            } else {
                [over(200), over(0), over(0), 255]
            }
        });
        let found = places(&Pictures {
            bare: &white,
            drawn: &mixed,
            alone: &alone,
            lined: &half,
        });
        let want = lab([200.0, 0.0, 0.0].map(|v| linear_from_srgb(v / 255.0)));
        assert!(distance(found[3].line.unwrap(), want) < 0.02);
    }

    #[test]
    fn flips_are_changes_of_the_line_alone() {
        let [black, red, on_white] = [
            ([0; 3], [0; 3]),
            ([255, 0, 0], [0; 3]),
            ([255, 0, 0], [255; 3]),
        ]
        .map(|(l, b)| judged(l, b));
        assert_eq!(flips(&black, &black, [16, 8]), [0, 8]);
        assert_eq!(flips(&black, &red, [16, 8]), [8, 8]);
        assert_eq!(flips(&black, &on_white, [16, 8]), [0, 0]);
    }
}
