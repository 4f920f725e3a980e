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

    /// A thousandth more of any channel, and on the rule's scale, moves the line by what the width of the turn allows:
    /// no jump. Near black a thousandth of a channel may be several hundredths of lightness.
    #[test]
    fn small_changes_have_small_effects(
        line in color(), rim in color(), behind in color(), rule in rule(),
        which in 0usize..3, channel in 0usize..3, step in -1f32..1.0,
    ) {
        let rule = Rule { goal: if rule.measure == Rule::WCAG { rule.goal.max(1.5) } else { rule.goal.max(0.1) }, ..rule };
        let step = step * 1e-3;
        let mut other = [line, rim, behind];
        other[which][channel] = (other[which][channel] + step).clamp(0.0, 1.0);
        let on_scale = |i: usize| (place([line, rim, behind][i], &rule) - place(other[i], &rule)).abs();
        prop_assume!(on_scale(0).max(on_scale(2)) <= 1e-3);
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
