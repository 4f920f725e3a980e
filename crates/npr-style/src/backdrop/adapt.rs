//! A line's colour before a background: the twin of `lib/backdrop`.

use super::oklab::{light_of_oklab, oklab_of_light};
use super::published;
use super::rule::Rule;
use super::stretch::Lean;
use crate::compose::LUMA;
use npr_core::color::{linear_from_srgb, pack_rgba8, srgb_from_linear, unpack_rgba8};
use npr_core::math::{self, mix, smoothstep};
use npr_core::surface::dot;

/// How much contrast is given up for the smaller step, and half the band in which a line turns from darker to brighter.
///
/// A line that is lighter than a dark background and darker than a light one must pass through the background's own
/// lightness somewhere between, if it is to change without a jump. Smaller makes that stretch of outline shorter, and
/// the change steeper.
pub(super) const TURN: f32 = 0.006;

/// Largest difference of two steps that still counts as about the same, in lightness.
const EVEN_STEP: f32 = 0.018;

/// What a lack of contrast is worth in a vote, as a multiple of a step in lightness: a line must read.
const LACK_WORTH: f32 = 50.0;

/// Vote of a rule that knows one direction alone; the other stays where it reads already.
const FORCED: f32 = 0.05;

/// Share of the target by which a line must be moved to take all of its hue from the rim.
const HUE_AT: f32 = 0.5;

/// Rounds in which chroma is fitted into the gamut, and lightness to a luminance.
const FIT_ROUNDS: u32 = 14;

/// How far a channel may lie outside 0..1 and still count as in gamut, as a share of a grey of that lightness.
const GAMUT_ROOM: f32 = 1e-3;

/// Largest ratio of luminances, of white and black [WCAG 2].
const WCAG_LARGEST: f32 = 21.0;

/// A line's colour where its surface ends before `behind`; all colours sRGB-encoded, 0..1.
///
/// `rim` is the colour of the surface beside the line. By contrast: a line that reads by the rule's target stays as it is.
/// Any other moves in lightness until it does, and takes its hue from the rim as it moves; chroma gives way where sRGB has
/// no such colour. Where neither direction reaches the target, it goes as far as it can. Continuous in all three colours.
/// Its contrast never falls, but for backgrounds from which it turns from darker to brighter: a band of about 1 % of lightness.
///
/// By likeness: the published method, see [`published::color`]. Channels outside 0..1 are clamped, and those that are no
/// number count as 0. About 40 cube roots and 200 products.
pub fn adapt(line: [f32; 3], rim: [f32; 3], behind: [f32; 3], rule: &Rule) -> [f32; 3] {
    let [line, rim, behind] = [line, rim, behind].map(|color| color.map(sane));
    let rule = &rule.sane();
    if rule.method == Rule::BY_LIKENESS {
        return published::color(line, rim, behind, rule);
    }
    let light = |color: [f32; 3]| color.map(linear_from_srgb);
    let before = light(line);
    if rule.method == Rule::OFF {
        return line;
    }
    let ground = Ground::of_light(light(behind), rule);
    let adapted = adapted_light(before, light(rim), &ground, rule);
    match adapted == before {
        true => line,
        false => adapted.map(srgb_from_linear),
    }
}

/// Finite and within 0..1.
pub(super) fn sane(channel: f32) -> f32 {
    if channel.is_nan() {
        return 0.0;
    }
    channel.clamp(0.0, 1.0)
}

/// How well a colour reads before another, both sRGB-encoded: in the measure of the rule's target.
pub fn contrast(line: [f32; 3], behind: [f32; 3], rule: &Rule) -> f32 {
    let light = [line, behind].map(|color| color.map(|channel| linear_from_srgb(sane(channel))));
    if rule.measure == Rule::WCAG {
        let [a, b] = light.map(|light| dot(LUMA, light) + 0.05);
        return a.max(b) / a.min(b);
    }
    let [a, b] = light.map(|light| oklab_of_light(light)[0]);
    (a - b).abs()
}

/// What lies behind a line, on the scale of the rule's measure: 0 black, 1 white.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground {
    /// The darkest that it must read before.
    pub low: f32,
    /// The brightest.
    pub high: f32,
    /// How much of the brighter of both ways is taken, 0..1; by itself where it is `None`.
    pub brighter: Option<f32>,
}

impl Ground {
    /// One colour in linear light.
    pub fn of_light(behind: [f32; 3], rule: &Rule) -> Self {
        let place = place_of_light(behind, rule);
        Self {
            low: place,
            high: place,
            brighter: None,
        }
    }

    pub(super) fn of_lean(lean: &Lean) -> Self {
        Self {
            low: lean.low,
            high: lean.high,
            brighter: Some(0.5 + 0.5 * lean.lean),
        }
    }

    /// As a texel with the number of a rule.
    pub(super) fn packed(&self, rule: u32) -> u32 {
        let share = self.brighter.unwrap_or(0.5);
        pack_rgba8([self.low, self.high, share, 0.0]) | rule << 24
    }

    /// Of such a texel.
    pub fn unpacked(texel: u32) -> Self {
        let [low, high, share, _] = unpack_rgba8(texel);
        Self {
            low,
            high,
            brighter: Some(share),
        }
    }
}

/// [`adapt`] by contrast in linear light of 0..1, as passes do it.
pub fn adapted_light(line: [f32; 3], rim: [f32; 3], ground: &Ground, rule: &Rule) -> [f32; 3] {
    let line = started(line, rim, rule);
    let own = oklab_of_light(line);
    let target = target_of(rule);
    let from = place_of(line, own[0], rule);
    let to = moved(from, ground, target, rule.direction);
    let step = (to - from).abs();
    if step == 0.0 {
        return line;
    }
    let edge = oklab_of_light(rim);
    let share = smoothstep(0.0, target * HUE_AT, step);
    at_place(to, own, edge, share, rule)
}

/// The published method in linear light of 0..1, as passes do it.
pub fn published_light(line: [f32; 3], rim: [f32; 3], behind: [f32; 3], rule: &Rule) -> [f32; 3] {
    if rule.method == Rule::OFF {
        return line;
    }
    let [line, rim, behind] = [line, rim, behind].map(|light| light.map(srgb_from_linear));
    published::color(line, rim, behind, rule).map(linear_from_srgb)
}

/// The colour that a line starts from: its own, or a share of the rim's.
pub(super) fn started(line: [f32; 3], rim: [f32; 3], rule: &Rule) -> [f32; 3] {
    if rule.rim_factor > 0.0 {
        return rim.map(|channel| channel * rule.rim_factor);
    }
    line
}

/// Where a colour lies on the scale of the rule's measure, 0 black to 1 white.
fn place_of(light: [f32; 3], lightness: f32, rule: &Rule) -> f32 {
    if rule.measure == Rule::WCAG {
        return math::ln(dot(LUMA, light) * 20.0 + 1.0) / math::ln(WCAG_LARGEST);
    }
    lightness
}

/// The same of a colour alone.
pub(super) fn place_of_light(light: [f32; 3], rule: &Rule) -> f32 {
    place_of(light, oklab_of_light(light)[0], rule)
}

/// The luminance at a place on the scale of WCAG.
fn luminance_at(place: f32) -> f32 {
    (math::exp(place * math::ln(WCAG_LARGEST)) - 1.0) / 20.0
}

/// The rule's target as a distance on that scale.
fn target_of(rule: &Rule) -> f32 {
    if rule.measure == Rule::WCAG {
        return math::ln(rule.goal.clamp(1.0, WCAG_LARGEST)) / math::ln(WCAG_LARGEST);
    }
    rule.goal.clamp(0.0, 1.0)
}

/// Where a line at `line` moves before a ground, on a scale of 0 to 1.
///
/// Two candidates, darker and brighter, each no farther from the line than the target asks. Where the ground does not say which one is
/// taken, the one that falls shorter of the target loses; about equal, the longer step loses; between, they are blended.
fn moved(line: f32, ground: &Ground, target: f32, direction: u32) -> f32 {
    let both = Candidates::of(line, [ground.low, ground.high], target, direction);
    let share = ground.brighter.unwrap_or_else(|| {
        let turn = TURN.min(0.5 * target);
        let bias = match direction {
            Rule::BRIGHTER => -turn,
            Rule::DARKER => turn,
            _ => turn * (both.longer(line) / EVEN_STEP.min(target).max(1e-6)).clamp(-1.0, 1.0),
        };
        let [lack_darker, lack_brighter] = both.lacks;
        smoothstep(-turn, turn, lack_darker - lack_brighter + bias)
    });
    mix(both.darker, both.brighter, share)
}

/// Which way a line at `line` had better move before grounds from the first to the second: from -1, darker, to 1, brighter.
///
/// The difference in what both candidates cost: how far the line moves and, much more, by how much it falls short of the target.
pub(super) fn preference(line: f32, grounds: [f32; 2], rule: &Rule) -> f32 {
    let both = Candidates::of(line, grounds, target_of(rule), rule.direction);
    let [lack_darker, lack_brighter] = both.lacks;
    let forced = match rule.direction {
        Rule::BRIGHTER => -FORCED,
        Rule::DARKER => FORCED,
        _ => 0.0,
    };
    let cost = both.longer(line) + LACK_WORTH * (lack_darker - lack_brighter) + forced;
    cost.clamp(-1.0, 1.0)
}

/// Where a line may move.
struct Candidates {
    darker: f32,
    brighter: f32,
    /// By how much each falls short of the target.
    lacks: [f32; 2],
}

impl Candidates {
    fn of(line: f32, [low, high]: [f32; 2], target: f32, direction: u32) -> Self {
        let mut darker = line.min(low - target).max(0.0);
        let mut brighter = line.max(high + target).min(1.0);
        // In a forced direction the other candidate is to stay on that side as it is.
        if direction == Rule::BRIGHTER {
            darker = line.min(low);
        }
        if direction == Rule::DARKER {
            brighter = line.max(high);
        }
        let lacks = [
            (target - (low - darker)).max(0.0),
            (target - (brighter - high)).max(0.0),
        ];
        Self {
            darker,
            brighter,
            lacks,
        }
    }

    /// By how much the step to the darker one is longer.
    fn longer(&self, line: f32) -> f32 {
        (line - self.darker) - (self.brighter - line)
    }
}

/// The colour of a lightness: chroma between those of the line and its rim, as far as sRGB has it.
fn at_lightness(lightness: f32, own: [f32; 3], edge: [f32; 3], share: f32) -> [f32; 3] {
    // A shade of the rim's paint: chroma grows and falls with lightness.
    let paler = ((lightness + 0.1) / (edge[0] + 0.1)).clamp(0.5, 2.0);
    let a = mix(own[1], edge[1] * paler, share);
    let b = mix(own[2], edge[2] * paler, share);
    let room = GAMUT_ROOM * lightness * lightness * lightness;
    let whole = light_of_oklab([lightness, a, b]);
    if is_in_gamut(whole, room) {
        return whole.map(|light| light.clamp(0.0, 1.0));
    }
    let (mut fits, mut spills) = (0.0, 1.0);
    for _ in 0..FIT_ROUNDS {
        let middle = 0.5 * (fits + spills);
        if is_in_gamut(light_of_oklab([lightness, a * middle, b * middle]), room) {
            fits = middle;
        } else {
            spills = middle;
        }
    }
    light_of_oklab([lightness, a * fits, b * fits]).map(|light| light.clamp(0.0, 1.0))
}

/// The same for a place on the scale of the rule's measure: of WCAG the lightness at which the fitted colour has that luminance.
fn at_place(place: f32, own: [f32; 3], edge: [f32; 3], share: f32, rule: &Rule) -> [f32; 3] {
    let by_luminance = rule.measure == Rule::WCAG;
    let luminance = luminance_at(place);
    let rounds = if by_luminance { FIT_ROUNDS } else { 0 };
    let (mut low, mut high) = (0.0, 1.0);
    let mut light = [0.0; 3];
    for _ in 0..=rounds {
        let lightness = if by_luminance {
            0.5 * (low + high)
        } else {
            place
        };
        light = at_lightness(lightness, own, edge, share);
        if dot(LUMA, light) < luminance {
            low = lightness;
        } else {
            high = lightness;
        }
    }
    light
}

fn is_in_gamut(light: [f32; 3], room: f32) -> bool {
    let inside = |channel: f32| channel >= -room && channel <= 1.0 + room;
    inside(light[0]) && inside(light[1]) && inside(light[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use palette::{FromColor, Oklab, Srgb};
    use proptest::prelude::*;

    fn color() -> impl Strategy<Value = [f32; 3]> {
        prop_oneof![
            prop::array::uniform3(0f32..=1.0),
            (0f32..=1.0).prop_map(|grey| [grey; 3]),
            prop::array::uniform3(prop_oneof![Just(0.0), Just(1.0), 0f32..0.1]),
        ]
    }

    fn rule() -> impl Strategy<Value = Rule> {
        let measure = prop_oneof![
            (0f32..0.5).prop_map(|target| (Rule::LIGHTNESS, target)),
            (1f32..4.5).prop_map(|target| (Rule::WCAG, target)),
        ];
        (measure, 0u32..3).prop_map(|((measure, target), direction)| Rule {
            measure,
            goal: target,
            direction,
            ..Rule::CONTRAST
        })
    }

    fn lab([r, g, b]: [f32; 3]) -> Oklab<f64> {
        let color = Srgb::new(f64::from(r), f64::from(g), f64::from(b));
        Oklab::from_color(color.into_linear())
    }

    /// Contrast on the rule's scale of 0..1, by the crate `palette`.
    fn contrast_on_scale(line: [f32; 3], behind: [f32; 3], rule: &Rule) -> f64 {
        place(line, rule) - place(behind, rule)
    }

    fn place(color: [f32; 3], rule: &Rule) -> f64 {
        if rule.measure == Rule::LIGHTNESS {
            return lab(color).l;
        }
        let [r, g, b] = color.map(f64::from);
        let light = Srgb::new(r, g, b).into_linear();
        let y = 0.2126 * light.red + 0.7152 * light.green + 0.0722 * light.blue;
        ((y + 0.05) / 0.05).ln() / 21f64.ln()
    }

    /// Whether a line turns here: the two candidates, chosen as simply as can be, are about equally good.
    fn turns(line: [f32; 3], behind: [f32; 3], rule: &Rule) -> bool {
        let (line, ground) = (place(line, rule), place(behind, rule));
        let target = f64::from(target_of(rule));
        let stays = rule.direction == Rule::BRIGHTER && line < ground
            || rule.direction == Rule::DARKER && line > ground;
        let reached_below = if stays && line < ground {
            ground - line
        } else {
            target.min(ground)
        };
        let reached_above = if stays && line > ground {
            line - ground
        } else {
            target.min(1.0 - ground)
        };
        let free = rule.direction == Rule::AUTO;
        let below = (rule.direction != Rule::BRIGHTER || stays)
            .then_some(reached_below.max(if line < ground { ground - line } else { 0.0 }));
        let above = (rule.direction != Rule::DARKER || stays)
            .then_some(reached_above.max(if line > ground { line - ground } else { 0.0 }));
        let (Some(below), Some(above)) = (below, above) else {
            return (1.0 - ground).min(ground) < 0.05;
        };
        let even = (below.min(target) - above.min(target)).abs() < 0.02;
        even && (!free
            || below.min(target) < target - 1e-6
            || above.min(target) < target - 1e-6
            || (line - ground).abs() < 0.05)
    }

    proptest! {
        #![proptest_config(ProptestConfig { max_global_rejects: 40_000, ..ProptestConfig::with_cases(4000) })]

        #[test]
        fn contrast_never_falls_but_where_a_line_turns(line in color(), rim in color(), behind in color(), rule in rule()) {
            let adapted = adapt(line, rim, behind, &rule);
            let [before, after] = [line, adapted].map(|color| contrast_on_scale(color, behind, &rule).abs());
            prop_assume!(!turns(line, behind, &rule));
            let target = f64::from(target_of(&rule));
            prop_assert!(after >= before.min(target) - 3e-3, "{before} became {after} of {target}: {adapted:?}");
        }

        #[test]
        fn what_reads_stays_to_the_bit(line in color(), rim in color(), behind in color(), rule in rule()) {
            let target = f64::from(target_of(&rule));
            prop_assume!(contrast_on_scale(line, behind, &rule).abs() > target + 1e-4);
            let forced = |side: u32, sign: f64| rule.direction == side && contrast_on_scale(line, behind, &rule) * sign < 0.0;
            prop_assume!(target > 0.01 || !(forced(Rule::BRIGHTER, 1.0) || forced(Rule::DARKER, -1.0)));
            prop_assert_eq!(adapt(line, rim, behind, &rule), line);
        }

        /// Up to half the scale one of both directions has room enough.
        #[test]
        fn the_target_is_reached_but_where_a_line_turns(line in color(), rim in color(), behind in color(), rule in rule()) {
            let rule = Rule { direction: Rule::AUTO, ..rule };
            let target = f64::from(target_of(&rule));
            prop_assume!(target < 0.45 && !turns(line, behind, &rule));
            let after = contrast_on_scale(adapt(line, rim, behind, &rule), behind, &rule).abs();
            prop_assert!(after >= target - 3e-3, "{after} of {target}");
        }

        #[test]
        fn all_stays_in_gamut(line in color(), rim in color(), behind in color(), rule in rule()) {
            let adapted = adapt(line, rim, behind, &rule);
            prop_assert!(adapted.iter().all(|channel| (0.0..=1.0).contains(channel)), "{adapted:?}");
        }

        /// A line that moved far has the rim's hue; one that moved less has one between.
        #[test]
        fn hue_is_the_rims(line in color(), rim in color(), behind in color(), rule in rule()) {
            let adapted = adapt(line, rim, behind, &rule);
            let moved = (place(adapted, &rule) - place(line, &rule)).abs();
            prop_assume!(moved > f64::from(target_of(&rule)) * f64::from(HUE_AT) + 1e-3);
            let (rim, adapted) = (lab(rim), lab(adapted));
            let chroma = |color: &Oklab<f64>| color.a.hypot(color.b);
            prop_assume!(chroma(&rim) > 0.02 && chroma(&adapted) > 0.02);
            let turn = (rim.a * adapted.b - rim.b * adapted.a).atan2(rim.a * adapted.a + rim.b * adapted.b);
            prop_assert!(turn.to_degrees().abs() < 2.0, "{} degrees", turn.to_degrees());
        }

        #[test]
        fn a_grey_line_of_a_black_rim_stays_grey(grey in 0f32..0.4, behind in color(), rule in rule()) {
            let adapted = lab(adapt([grey; 3], [0.0; 3], behind, &rule));
            prop_assert!(adapted.a.hypot(adapted.b) < 2e-3);
        }

        /// A step of 1/255 of any input moves the line by what the width of the turn allows: no jump.
        #[test]
        fn small_changes_have_small_effects(
            line in color(), rim in color(), behind in color(), rule in rule(),
            which in 0usize..3, channel in 0usize..3, step in -1f32..1.0,
        ) {
            let rule = Rule { goal: if rule.measure == Rule::WCAG { rule.goal.max(1.5) } else { rule.goal.max(0.1) }, ..rule };
            let step = step * 1e-3;
            let mut other = [line, rim, behind];
            other[which][channel] = (other[which][channel] + step).clamp(0.0, 1.0);
            let [a, b] = [[line, rim, behind], other].map(|[line, rim, behind]| adapt(line, rim, behind, &rule));
            let change = (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f32::max);
            prop_assert!(change < 0.25, "{change} from a step of {step}");
        }

        #[test]
        fn any_numbers_give_a_color(
            line in prop::array::uniform3(prop::num::f32::ANY), rim in prop::array::uniform3(prop::num::f32::ANY),
            behind in prop::array::uniform3(prop::num::f32::ANY), target in prop::num::f32::ANY, intensity in prop::num::f32::ANY,
            method in 0u32..4, direction in 0u32..4, measure in 0u32..3, thresholds in prop::array::uniform4(prop::num::f32::ANY),
        ) {
            let rule = Rule { thresholds, method, direction, measure, goal: target, intensity, ..Rule::CONTRAST };
            let adapted = adapt(line, rim, behind, &rule);
            prop_assert!(adapted.iter().all(|channel| (0.0..=1.0).contains(channel)), "{adapted:?}");
        }
    }

    #[test]
    fn a_black_line_lifts_before_black_and_stays_before_white() {
        let rule = Rule::CONTRAST;
        let lifted = adapt([0.0; 3], [0.0; 3], [0.0; 3], &rule);
        assert!((contrast(lifted, [0.0; 3], &rule) - 0.3).abs() < 1e-3);
        assert_eq!(adapt([0.0; 3], [0.0; 3], [1.0; 3], &rule), [0.0; 3]);
    }

    #[test]
    fn directions_can_be_forced() {
        let grey = [0.5; 3];
        let lightness = |direction: u32| {
            let rule = Rule {
                direction,
                ..Rule::CONTRAST
            };
            oklab_of_light(adapt(grey, grey, grey, &rule).map(linear_from_srgb))[0]
        };
        let own = oklab_of_light(grey.map(linear_from_srgb))[0];
        assert!((lightness(Rule::BRIGHTER) - own - 0.3).abs() < 1e-3);
        assert!((own - lightness(Rule::DARKER) - 0.3).abs() < 1e-3);
    }
}
