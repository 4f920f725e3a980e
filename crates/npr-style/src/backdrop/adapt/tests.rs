//! One line, one background: properties against the crate `palette`.

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

/// How far on the rule's scale a line may move at most where line, rim and background change from one to other colours.
///
/// Both candidates follow line and ground one to one at most. The share of the brighter one is a smooth step over twice
/// the turn, at most 1.5 times as steep as a straight line. What it is a step of follows a ground by both lacks of
/// contrast, and a line by one, where it may stay. Where the direction is free the bias adds the turn for every even
/// step by which one way grows longer, and the difference of both ways follows line and ground two to one. Candidates
/// lie no farther apart than line and target do. A rim does not move a line.
fn most_moved(from: [[f32; 3]; 3], to: [[f32; 3]; 3], rule: &Rule) -> f64 {
    let target = f64::from(target_of(rule));
    let turn = f64::from(TURN).min(0.5 * target);
    let step = |which: usize| (place(from[which], rule) - place(to[which], rule)).abs();
    let (line, ground) = (place(to[0], rule), place(to[2], rule));
    let bias = match rule.direction {
        Rule::AUTO => 2.0 * turn / f64::from(EVEN_STEP).min(target),
        _ => 0.0,
    };
    let steepest = 1.5 / (2.0 * turn);
    // Places near 1 are whole multiples of 2^-24; eight of them for what lies between colour and place.
    let rounding = 8.0 * f64::from(f32::EPSILON / 2.0);
    let changed = (1.0 + bias) * (step(0) + rounding) + (2.0 + bias) * step(2);
    let apart = line.max(ground + target).min(1.0) - line.min(ground - target).max(0.0);
    step(0) + step(2) + apart * (steepest * changed).min(1.0)
}

/// Fails where a change moves a line on the rule's scale by more than it may.
///
/// The room is that of the gamut: a channel that far outside of it is clamped, and cube roots make a third of it, for
/// each of both colours.
fn moves_no_more_than_it_may(from: [[f32; 3]; 3], to: [[f32; 3]; 3], rule: &Rule) {
    let [before, after] = [from, to].map(|[line, rim, behind]| adapt(line, rim, behind, rule));
    let moved = (place(before, rule) - place(after, rule)).abs();
    let most = most_moved(from, to, rule) + f64::from(GAMUT_ROOM);
    assert!(moved <= most, "{moved} of {most}: {before:?} to {after:?}");
}

/// Line, rim and background with another channel.
fn with(mut colors: [[f32; 3]; 3], which: usize, channel: usize, value: f32) -> [[f32; 3]; 3] {
    colors[which][channel] = value;
    colors
}

/// From how much on a change between neighbouring numbers is a jump, in OKLab.
///
/// Rounding alone makes 0.003. Places of WCAG near its target are whole multiples of 2^-24. One more is a luminance of
/// 1e-8 beside black, and blue of that luminance lies 0.003 from black.
const JUMP: f64 = 0.005;

/// What a change of a channel does in its steepest place, in OKLab: between two numbers that have none between them.
///
/// Halves the change, each time to the half that does more.
fn largest_jump(colors: [[f32; 3]; 3], which: usize, channel: usize, to: f32, rule: &Rule) -> f64 {
    let at = |value: f32| {
        let [line, rim, behind] = with(colors, which, channel, value);
        lab(adapt(line, rim, behind, rule))
    };
    let effect = |from: f32, to: f32| {
        let (from, to) = (at(from), at(to));
        (from.l - to.l).hypot(from.a - to.a).hypot(from.b - to.b)
    };
    let (mut from, mut to) = (colors[which][channel], to);
    loop {
        let middle = 0.5 * (from + to);
        let left = effect(from, to);
        if middle == from || middle == to || left < JUMP {
            return left;
        }
        if effect(from, middle) > effect(middle, to) {
            to = middle;
        } else {
            from = middle;
        }
    }
}

/// A step of 1/1300 of red is a fortieth of lightness beside black: a line that may only grow brighter turns within it.
#[test]
fn a_black_line_that_reads_just_so_turns_where_it_grows_brighter() {
    let rule = Rule {
        goal: 0.378_593_65,
        direction: Rule::BRIGHTER,
        ..Rule::CONTRAST
    };
    let behind = [0.0, 0.317_694_6, 0.0];
    let from = [[0.0; 3], [0.0; 3], behind];
    let to = with(from, 0, 0, 0.000_747_170_1);
    let [black, red] = [from, to].map(|colors| place(colors[0], &rule));
    assert!(red - black > 2.0 * f64::from(TURN), "{black} to {red}");
    let [stays, turned] = [from, to].map(|[line, rim, _]| adapt(line, rim, behind, &rule));
    let gap = place(behind, &rule);
    assert!(place(stays, &rule) < 0.2 * gap && place(turned, &rule) > 1.9 * gap);
    moves_no_more_than_it_may(from, to, &rule);
    assert!(largest_jump(from, 0, 0, to[0][0], &rule) < JUMP);
}

/// Chroma jumped by 15 % at the tip of blue, where the gamut overhangs.
#[test]
fn a_blue_line_changes_its_hue_without_a_jump() {
    let blue = [0.0, 0.0, 1.0];
    let rule = Rule {
        goal: 0.254_684_33,
        ..Rule::CONTRAST
    };
    let colors = [blue, [0.0, 1.0, 1.0], blue];
    let rest = largest_jump(colors, 0, 0, 0.000_765_546_1, &rule);
    assert!(rest < JUMP, "{rest}");
}

/// There the contrast of WCAG changed by 1.6 % of its scale, by a thousandth of the rim's blue.
#[test]
fn a_rim_of_nearly_blue_does_not_move_a_line() {
    let rule = Rule {
        measure: Rule::WCAG,
        goal: 3.269_405_1,
        direction: Rule::DARKER,
        ..Rule::CONTRAST
    };
    let line = [0.857_625_9, 0.486_593_48, 0.495_719_8];
    let from = [
        line,
        [0.0, 0.001_399_564_8, 1.0],
        [0.494_495_1, 0.703_143_5, 0.148_111_7],
    ];
    moves_no_more_than_it_may(from, with(from, 1, 2, 0.999_088_3), &rule);
}

/// Where chroma gave way the luminance of a blue line jumped past the target, and it fell short by a hundredth.
#[test]
fn a_blue_line_before_red_reaches_the_target() {
    let rule = Rule {
        measure: Rule::WCAG,
        goal: 3.6662312,
        direction: Rule::AUTO,
        ..Rule::CONTRAST
    };
    let behind = [1.0, 0.06502449, 0.0];
    let adapted = adapt([0.013381943, 0.0, 1.0], [0.0, 0.0, 1.0], behind, &rule);
    let after = contrast_on_scale(adapted, behind, &rule).abs();
    assert!(after >= f64::from(target_of(&rule)) - 1e-4, "{after}");
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
        let contrast = contrast_on_scale(line, behind, &rule);
        let forced = |side: u32, sign: f64| rule.direction == side && contrast * sign < 0.0;
        prop_assume!(target > 0.01 || !(forced(Rule::BRIGHTER, 1.0) || forced(Rule::DARKER, -1.0)));
        prop_assert_eq!(adapt(line, rim, behind, &rule), line);
    }

    /// Up to half the scale one of both directions has room enough.
    #[test]
    fn the_target_is_reached_but_where_a_line_turns(
        line in color(), rim in color(), behind in color(), rule in rule(),
    ) {
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

    /// A thousandth more of any channel; near black that may be several hundredths of the rule's scale.
    #[test]
    fn small_changes_have_small_effects(
        line in color(), rim in color(), behind in color(), rule in rule(),
        which in 0usize..3, channel in 0usize..3, step in -1f32..1.0,
    ) {
        let from = [line, rim, behind];
        let other = from[which][channel] + step * 1e-3;
        moves_no_more_than_it_may(from, with(from, which, channel, other.clamp(0.0, 1.0)), &rule);
    }

    /// Steps are larger than above, so that more of them hold a jump where there is one.
    #[test]
    fn no_change_makes_a_color_jump(
        line in color(), rim in color(), behind in color(), rule in rule(),
        which in 0usize..3, channel in 0usize..3, step in -1f32..1.0,
    ) {
        // Hue turns over half the target: over less than this by more than rounding of places allows.
        let least = if rule.measure == Rule::WCAG { 1.05 } else { 0.01 };
        let rule = Rule { goal: rule.goal.max(least), ..rule };
        let from = [line, rim, behind];
        let other = (from[which][channel] + step * 0.02).clamp(0.0, 1.0);
        let rest = largest_jump(from, which, channel, other, &rule);
        prop_assert!(rest < JUMP, "{rest}");
    }

    #[test]
    fn any_numbers_give_a_color(
        line in prop::array::uniform3(prop::num::f32::ANY), rim in prop::array::uniform3(prop::num::f32::ANY),
        behind in prop::array::uniform3(prop::num::f32::ANY),
        target in prop::num::f32::ANY, intensity in prop::num::f32::ANY,
        method in 0u32..4, direction in 0u32..4, measure in 0u32..3,
        thresholds in prop::array::uniform4(prop::num::f32::ANY),
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
