//! Outlines coloured by rim and background as published [Tsuji 2014], on two pictures.
//!
//! ```
//! use npr_style::backdrop::{Criteria, Rule, published};
//!
//! // A dark red square on nothing, and the same before a dark wall.
//! let red = [0.3, 0.05, 0.05, 1.0];
//! let is_inside = |i: usize| (2..6).contains(&(i % 8)) && (2..6).contains(&(i / 8));
//! let alone: Vec<[f32; 4]> = (0..64).map(|i| if is_inside(i) { red } else { [0.0; 4] }).collect();
//! let wall = [0.2, 0.05, 0.05, 1.0];
//! let composed: Vec<[f32; 4]> = (0..64).map(|i| if is_inside(i) { red } else { wall }).collect();
//!
//! let rule = Criteria { rgb: Some(0.3), ..Criteria::default() }.rule(2.0, Rule::BRIGHTER);
//! let lines = published::outline([8, 8], &alone, &composed, [0.0; 3], &rule).unwrap();
//! assert_eq!(lines.iter().flatten().count(), 20);
//! assert_eq!(lines[1 * 8 + 3], Some([0.6, 0.1, 0.1]));
//! ```

use super::rule::Rule;
use rayon::prelude::*;

/// The largest differences at which colours count as alike, one for each criterion; `None` leaves a criterion out.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Criteria {
    /// Difference of any channel of RGB, 0..1.
    pub rgb: Option<f32>,
    /// Difference of V = max(R, G, B), 0..1 (equation 2.1).
    pub value: Option<f32>,
    /// Difference of S = (max - min) / max, 0..1 (equation 2.2).
    pub saturation: Option<f32>,
    /// Difference of hue in degrees, 0..180; greys have no hue and differ from nothing.
    pub hue_deg: Option<f32>,
}

impl Criteria {
    /// The published rule with these criteria, factor I (`intensity`, at least 1) and direction.
    pub fn rule(&self, intensity: f32, direction: u32) -> Rule {
        let hue = self.hue_deg.map(|degrees| degrees / 360.0);
        let used = [self.rgb, self.value, self.saturation, hue];
        Rule {
            thresholds: used.map(|threshold| threshold.map_or(-1.0, |most| most.max(0.0))),
            method: Rule::BY_LIKENESS,
            direction,
            intensity: intensity.max(1.0),
            ..Rule::CONTRAST
        }
    }
}

/// The outline of the figure in `alone`, one pixel wide and outside of it: a colour for every pixel on it.
///
/// `alone` is the character, alpha 0 everywhere else; `composed` is the character before its background; both
/// sRGB-encoded, 0..1, row by row. A pixel whose alpha is the same in both shows the character (section 2.2). One
/// that does not, and has such a pixel among its eight neighbours, lies on the outline; [`color()`] says how it is
/// drawn, from the mean of those neighbours and its own colour. `default` is the colour of lines that need no change,
/// black as published.
///
/// `None` where the pictures are not of `size`. O(pixels), parallel over rows.
///
/// Differs: pixels of alpha 0 never show the character, or a picture without background would be all character; a
/// difference of alpha up to 1/512 counts as none. Where `composed` shows nothing at all, lines keep `default`.
pub fn outline(
    size: [u32; 2],
    alone: &[[f32; 4]],
    composed: &[[f32; 4]],
    default: [f32; 3],
    rule: &Rule,
) -> Option<Vec<Option<[f32; 3]>>> {
    // Turn down pictures of another size.
    let [width, height] = size.map(|side| side as usize);
    let count = width.checked_mul(height)?;
    if alone.len() != count || composed.len() != count {
        return None;
    }

    // Tell the pixels of the character by what both pictures show there.
    let is_character = |i: usize| {
        let [a, b] = [alone[i][3], composed[i][3]].map(sane);
        a > 0.0 && (a - b).abs() <= 1.0 / 512.0
    };

    // Colour every other pixel that touches the character.
    let mut outline = vec![None; count];
    outline
        .par_chunks_mut(width.max(1))
        .enumerate()
        .for_each(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                let here = y * width + x;
                if is_character(here) {
                    continue;
                }
                let around = neighbours(size, x, y).filter(|i| is_character(*i));
                let is_before_nothing = sane(composed[here][3]) == 0.0;
                *pixel = mean(around.map(|i| rgb(alone[i]))).map(|rim| match is_before_nothing {
                    true => default,
                    false => color(default, rim, rgb(composed[here]), rule),
                });
            }
        });
    Some(outline)
}

/// A figure before a background with its outline, where what lies around it is transparent: all sRGB-encoded with
/// straight alpha.
///
/// The figure is the publication's first picture, the figure before its background the second; [`outline()`] compares
/// the two. `line` is the colour of lines that need no change; its alpha is the opacity of all. Also returns the number
/// of pixels on the outline.
///
/// `None` where the pictures are not of `size`. O(pixels).
///
/// Differs: a pixel that the figure covers in part is compared by the background's colour. The blend of both is always
/// like the figure and would brighten the edge of every soft figure.
pub fn draw(
    size: [u32; 2],
    figure: &[[f32; 4]],
    background: &[[f32; 4]],
    line: [f32; 4],
    rule: &Rule,
) -> Option<(Vec<[f32; 4]>, usize)> {
    if figure.len() != background.len() {
        return None;
    }
    let pairs = || figure.par_iter().zip(background);
    let mut drawn: Vec<[f32; 4]> = pairs().map(|(own, below)| laid(*own, *below)).collect();
    // Where the figure does not cover all, what lies behind it.
    let behind = |((own, below), both): ((&[f32; 4], &[f32; 4]), &[f32; 4])| match own[3] >= 1.0 {
        true => *own,
        false => [below[0], below[1], below[2], both[3]],
    };
    let compared: Vec<[f32; 4]> = pairs().zip(&drawn).map(behind).collect();
    let [r, g, b, opacity] = line;
    let lines = outline(size, figure, &compared, [r, g, b], rule)?;
    let mut count = 0;
    for (pixel, line) in drawn.iter_mut().zip(&lines) {
        if let Some([r, g, b]) = line {
            *pixel = laid([*r, *g, *b, opacity], *pixel);
            count += 1;
        }
    }
    Some((drawn, count))
}

/// One colour laid over another, straight alpha.
fn laid(top: [f32; 4], below: [f32; 4]) -> [f32; 4] {
    let left = below[3] * (1.0 - top[3]);
    let alpha = top[3] + left;
    let mix = |i: usize| (top[i] * top[3] + below[i] * left) / alpha.max(1e-6);
    [mix(0), mix(1), mix(2), alpha]
}

/// The colour of a line between a rim and what lies behind, all sRGB-encoded: equations of section 2.4.
///
/// If the two are alike, it is the rim's colour times I, clamped to 1, or divided by I; else `line`. Colours are alike
/// if they differ by no more than the threshold in every criterion in use; without any, none are.
///
/// Differs: with [`Rule::AUTO`], brighter before backgrounds of V up to one half, and darker before brighter ones.
pub fn color(line: [f32; 3], rim: [f32; 3], behind: [f32; 3], rule: &Rule) -> [f32; 3] {
    if !are_alike(rim, behind, &rule.thresholds) {
        return line;
    }
    let is_brighter = match rule.direction {
        Rule::BRIGHTER => true,
        Rule::DARKER => false,
        _ => value(behind) <= 0.5,
    };
    let factor = match is_brighter {
        true => rule.intensity,
        false => 1.0 / rule.intensity.max(1.0),
    };
    rim.map(|channel| (channel * factor).min(1.0))
}

/// Whether two colours differ by no more than every threshold that is not negative; false if all are negative.
pub fn are_alike(a: [f32; 3], b: [f32; 3], thresholds: &[f32; 4]) -> bool {
    let step = |i: usize| (a[i] - b[i]).abs();
    let differences = [
        step(0).max(step(1)).max(step(2)),
        (value(a) - value(b)).abs(),
        (saturation(a) - saturation(b)).abs(),
        hue_difference(a, b),
    ];
    let mut any = false;
    for i in 0..4 {
        if thresholds[i] >= 0.0 {
            any = true;
            if differences[i] > thresholds[i] {
                return false;
            }
        }
    }
    any
}

/// V = max(R, G, B) (equation 2.1).
pub fn value([r, g, b]: [f32; 3]) -> f32 {
    r.max(g).max(b)
}

/// S = (max - min) / max (equation 2.2); 0 for black.
pub fn saturation([r, g, b]: [f32; 3]) -> f32 {
    let most = r.max(g).max(b);
    if most <= 0.0 {
        return 0.0;
    }
    (most - r.min(g).min(b)) / most
}

/// Hue of HSV in turns, 0..1 from red over green; -1 for greys.
pub fn hue([r, g, b]: [f32; 3]) -> f32 {
    let most = r.max(g).max(b);
    let span = most - r.min(g).min(b);
    if span <= 1e-6 {
        return -1.0;
    }
    let sixths = if most == r {
        (g - b) / span
    } else if most == g {
        (b - r) / span + 2.0
    } else {
        (r - g) / span + 4.0
    };
    if sixths < 0.0 {
        return (sixths + 6.0) / 6.0;
    }
    sixths / 6.0
}

/// The shorter way between two hues, 0..0.5 turns; 0 where one has none.
fn hue_difference(a: [f32; 3], b: [f32; 3]) -> f32 {
    let (a, b) = (hue(a), hue(b));
    if a < 0.0 || b < 0.0 {
        return 0.0;
    }
    let way = (a - b).abs();
    way.min(1.0 - way)
}

/// The pixels of a picture that touch the pixel at `x`, `y`.
fn neighbours(size: [u32; 2], x: usize, y: usize) -> impl Iterator<Item = usize> {
    let [width, height] = size.map(|side| side as usize);
    let rows = y.saturating_sub(1)..(y + 2).min(height);
    let columns = x.saturating_sub(1)..(x + 2).min(width);
    rows.flat_map(move |row| columns.clone().map(move |column| (column, row)))
        .filter(move |at| *at != (x, y))
        .map(move |(column, row)| row * width + column)
}

/// A channel clamped to 0..1; NaN counts as 0.
pub(super) fn sane(channel: f32) -> f32 {
    if channel.is_nan() {
        return 0.0;
    }
    channel.clamp(0.0, 1.0)
}

fn rgb([r, g, b, _]: [f32; 4]) -> [f32; 3] {
    [r, g, b].map(sane)
}

fn mean(colors: impl Iterator<Item = [f32; 3]>) -> Option<[f32; 3]> {
    let mut count = 0.0;
    let mut sum = [0.0; 3];
    for color in colors {
        count += 1.0;
        sum = std::array::from_fn(|i| sum[i] + color[i]);
    }
    (count > 0.0).then(|| sum.map(|channel| channel / count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A picture of up to 12 x 9 with a character of any shape, and what lies behind.
    fn pictures() -> impl Strategy<Value = ([u32; 2], Vec<[f32; 4]>, Vec<[f32; 4]>)> {
        (1u32..12, 1u32..9).prop_flat_map(|(width, height)| {
            let count = (width * height) as usize;
            let rgb = prop::array::uniform3(prop_oneof![0f32..1.0, Just(f32::NAN), Just(7.0)]);
            let pixel = (
                rgb.clone(),
                rgb,
                prop::bool::ANY,
                prop_oneof![Just(1f32), Just(0.5)],
            );
            prop::collection::vec(pixel, count).prop_map(move |pixels| {
                let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
                let alone = pixels.iter().map(|(own, _, shown, alpha)| match shown {
                    true => [own[0], own[1], own[2], *alpha],
                    false => [0.0; 4],
                });
                let composed = pixels
                    .iter()
                    .map(|(own, behind, shown, _)| opaque(if *shown { *own } else { *behind }));
                ([width, height], alone.collect(), composed.collect())
            })
        })
    }

    /// The publication's sentences, one pixel at a time.
    fn oracle(
        size: [u32; 2],
        alone: &[[f32; 4]],
        composed: &[[f32; 4]],
        at: [i64; 2],
        rule: &Rule,
    ) -> Option<[f32; 3]> {
        let [width, height] = size.map(i64::from);
        let index = |x: i64, y: i64| (y * width + x) as usize;
        let shows_character = |x: i64, y: i64| alone[index(x, y)][3] == composed[index(x, y)][3];
        let finite = |v: f32| if v.is_nan() { 0.0 } else { v.clamp(0.0, 1.0) };
        let [x, y] = at;
        if shows_character(x, y) {
            return None;
        }
        let mut found = Vec::new();
        for (dx, dy) in [
            (-1, -1),
            (0, -1),
            (1, -1),
            (-1, 0),
            (1, 0),
            (-1, 1),
            (0, 1),
            (1, 1),
        ] {
            let (x, y) = (x + dx, y + dy);
            if x >= 0 && y >= 0 && x < width && y < height && shows_character(x, y) {
                found.push(alone[index(x, y)].map(finite));
            }
        }
        if found.is_empty() {
            return None;
        }
        let sum = |i: usize| found.iter().map(|color| color[i]).sum::<f32>();
        let rim = [sum(0), sum(1), sum(2)].map(|sum| sum / found.len() as f32);
        let here = composed[index(x, y)].map(finite);
        let far = (0..3).any(|i| (rim[i] - here[i]).abs() > rule.thresholds[0]);
        Some(match far {
            true => [0.0; 3],
            false => rim.map(|channel| (channel * rule.intensity).min(1.0)),
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1500))]

        #[test]
        fn it_follows_the_publication_word_by_word(
            (size, alone, composed) in pictures(), threshold in 0f32..1.0, intensity in 1f32..4.0,
        ) {
            let rule = Criteria { rgb: Some(threshold), ..Criteria::default() }.rule(intensity, Rule::BRIGHTER);
            let lines = outline(size, &alone, &composed, [0.0; 3], &rule).unwrap();
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let want = oracle(size, &alone, &composed, [i64::from(x), i64::from(y)], &rule);
                    let got = lines[(y * size[0] + x) as usize];
                    match (want, got) {
                        (Some(want), Some(got)) => prop_assert!((0..3).all(|i| (want[i] - got[i]).abs() < 1e-5)),
                        (want, got) => prop_assert_eq!(want, got),
                    }
                }
            }
        }

        /// Straight from section 2.4: the sum over all neighbours, times I or over I, over their number.
        #[test]
        fn brighter_multiplies_the_sum_of_the_rim_and_darker_divides_it(
            around in prop::collection::vec(prop::array::uniform3(0f32..0.3), 8),
            is_figure in prop::collection::vec(prop::bool::ANY, 8), intensity in 1f32..3.0, brighter: bool,
        ) {
            let mut alone = vec![[0.0; 4]; 9];
            let (mut sum, mut count) = ([0.0; 3], 0.0);
            for i in (0..8).filter(|i| is_figure[*i]) {
                let [r, g, b] = around[i];
                alone[if i < 4 { i } else { i + 1 }] = [r, g, b, 1.0];
                sum = [sum[0] + r, sum[1] + g, sum[2] + b];
                count += 1.0;
            }
            let shown = |own: &[f32; 4]| if own[3] > 0.0 { *own } else { [0.2, 0.1, 0.1, 1.0] };
            let composed: Vec<[f32; 4]> = alone.iter().map(shown).collect();
            let direction = if brighter { Rule::BRIGHTER } else { Rule::DARKER };
            let rule = Criteria { rgb: Some(1.0), ..Criteria::default() }.rule(intensity, direction);
            let middle = outline([3, 3], &alone, &composed, [0.0; 3], &rule).unwrap()[4];
            if count == 0.0 {
                prop_assert_eq!(middle, None);
                return Ok(());
            }
            let [r, g, b] = middle.unwrap();
            for (got, sum) in [r, g, b].into_iter().zip(sum) {
                let want = if brighter { sum * intensity / count } else { sum / intensity / count };
                prop_assert!((got - want.min(1.0)).abs() < 1e-5, "{got}, not {want}");
            }
        }

        #[test]
        fn one_factor_for_all_channels_keeps_their_ratios(
            rim in prop::array::uniform3(0.01f32..0.24), intensity in 1f32..4.0, up: bool,
        ) {
            let direction = if up { Rule::BRIGHTER } else { Rule::DARKER };
            let rule = Criteria { rgb: Some(1.0), ..Criteria::default() }.rule(intensity, direction);
            let drawn = color([0.0; 3], rim, rim, &rule);
            for i in 0..2 {
                prop_assert!((drawn[i] / drawn[i + 1] - rim[i] / rim[i + 1]).abs() < 1e-3 * rim[i] / rim[i + 1]);
            }
        }

        #[test]
        fn hue_turns_with_the_channels(color in prop::array::uniform3(0f32..1.0)) {
            let [r, g, b] = color;
            prop_assume!(hue(color) >= 0.0);
            let turned = hue([b, r, g]);
            let way = (turned - hue(color) - 1.0 / 3.0).rem_euclid(1.0);
            prop_assert!(way.min(1.0 - way) < 1e-4);
        }
    }

    /// Two neighbours, (0.2, 0.4, 0.1) and (0.4, 0.2, 0.3): their mean is (0.3, 0.3, 0.2).
    #[test]
    fn the_colors_of_a_line_by_hand() {
        let alone = [[0.2, 0.4, 0.1, 1.0], [0.0; 4], [0.4, 0.2, 0.3, 1.0]];
        let composed = [alone[0], [0.25, 0.3, 0.2, 1.0], alone[2]];
        let middle = |rgb: f32, intensity: f32, direction: u32| {
            let criteria = Criteria {
                rgb: Some(rgb),
                ..Criteria::default()
            };
            let rule = criteria.rule(intensity, direction);
            let lines = outline([3, 1], &alone, &composed, [0.9, 0.0, 0.1], &rule).unwrap();
            assert_eq!((lines[0], lines[2]), (None, None));
            lines[1].unwrap().map(|channel| (channel * 1000.0).round())
        };
        assert_eq!(middle(0.1, 2.0, Rule::BRIGHTER), [600.0, 600.0, 400.0]);
        assert_eq!(middle(0.1, 4.0, Rule::BRIGHTER), [1000.0, 1000.0, 800.0]);
        assert_eq!(middle(0.1, 2.0, Rule::DARKER), [150.0, 150.0, 100.0]);
        assert_eq!(middle(0.1, 5.0, Rule::DARKER), [60.0, 60.0, 40.0]);
        // The background's V is 0.3: dark, so brighter by itself.
        assert_eq!(middle(0.1, 2.0, Rule::AUTO), [600.0, 600.0, 400.0]);
        // Red differs by 0.05: at the threshold it changes, above it does not.
        assert_eq!(middle(0.0500001, 2.0, Rule::DARKER), [150.0, 150.0, 100.0]);
        assert_eq!(middle(0.049, 2.0, Rule::DARKER), [900.0, 0.0, 100.0]);
    }

    /// Columns: figure, a pixel half covered by it, background, background; the background is black.
    #[test]
    fn what_is_half_covered_is_compared_by_what_lies_behind() {
        let grey = |alpha: f32| [0.4, 0.4, 0.4, alpha];
        let figure = [grey(1.0), grey(0.5), [0.0; 4], [0.0; 4]];
        let black = [[0.0, 0.0, 0.0, 1.0]; 4];
        let of = |threshold: f32, line: [f32; 4]| {
            let criteria = Criteria {
                rgb: Some(threshold),
                ..Criteria::default()
            };
            let rule = criteria.rule(2.0, Rule::BRIGHTER);
            draw([4, 1], &figure, &black, line, &rule).unwrap()
        };
        let red = [1.0, 0.0, 0.0, 1.0];
        // 0.4 from the background, 0.2 from the blend.
        let (drawn, count) = of(0.3, red);
        assert_eq!((drawn[1], count), (red, 1));
        assert_eq!(of(0.5, red).0[1], [0.8, 0.8, 0.8, 1.0]);
        assert_eq!([drawn[0], drawn[2]], [grey(1.0), black[0]]);
        // Half a line over the blend of 0.2.
        assert_eq!(of(0.3, [1.0, 0.0, 0.0, 0.5]).0[1], [0.6, 0.1, 0.1, 1.0]);
    }

    #[test]
    fn before_nothing_a_line_keeps_its_color() {
        let figure = [[0.1, 0.1, 0.1, 1.0], [0.0; 4], [0.0; 4]];
        let rule = Criteria {
            rgb: Some(1.0),
            ..Criteria::default()
        };
        let rule = rule.rule(3.0, Rule::BRIGHTER);
        let line = [0.0, 0.0, 1.0, 1.0];
        let (drawn, count) = draw([3, 1], &figure, &[[0.0; 4]; 3], line, &rule).unwrap();
        assert_eq!((drawn, count), (vec![figure[0], line, [0.0; 4]], 1));
        assert_eq!(draw([3, 1], &figure, &[[0.0; 4]; 2], line, &rule), None);
    }

    #[test]
    fn every_criterion_in_use_must_hold() {
        let (rim, behind) = ([0.4, 0.2, 0.2], [0.4, 0.3, 0.2]);
        let near =
            |criteria: Criteria| are_alike(rim, behind, &criteria.rule(2.0, Rule::AUTO).thresholds);
        assert!(!near(Criteria::default()));
        assert!(near(Criteria {
            value: Some(0.0),
            ..Criteria::default()
        }));
        assert!(near(Criteria {
            value: Some(0.0),
            rgb: Some(0.11),
            saturation: Some(0.01),
            hue_deg: Some(31.0)
        }));
        assert!(!near(Criteria {
            value: Some(0.0),
            hue_deg: Some(29.0),
            ..Criteria::default()
        }));
    }

    #[test]
    fn greys_have_no_hue_and_black_no_saturation() {
        assert_eq!((hue([0.5; 3]), saturation([0.0; 3])), (-1.0, 0.0));
        assert_eq!(hue([1.0, 0.0, 0.0]), 0.0);
        assert!((hue([0.0, 1.0, 0.0]) - 1.0 / 3.0).abs() < 1e-6);
    }

    #[test]
    fn pictures_of_other_sizes_are_turned_down_and_empty_ones_have_no_outline() {
        let rule = Rule::default();
        assert_eq!(
            outline([2, 2], &[[0.0; 4]; 4], &[[0.0; 4]; 3], [0.0; 3], &rule),
            None
        );
        assert_eq!(outline([0, 5], &[], &[], [0.0; 3], &rule), Some(Vec::new()));
        let all = [[0.5, 0.5, 0.5, 1.0]; 4];
        assert_eq!(
            outline([2, 2], &all, &all, [0.0; 3], &rule),
            Some(vec![None; 4])
        );
    }
}
