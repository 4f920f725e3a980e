//! What ink and hatching at one point must hold to.

use super::*;
use crate::backdrop::Rules;
use crate::compose::Compose;
use crate::hatch::{Hatch, levels};
use crate::lighting::Lights;
use npr_core::math;
use npr_core::texture::TextureStore;
use npr_core::window::{View, Window};
use proptest::prelude::*;

#[test]
fn the_shade_ramp_is_black_grey_white() {
    let levels = [0.0, 0.25, 0.5, 0.75, 1.0].map(|x| shade_level(x, 0.25, 0.75));
    assert_eq!(levels, [0.0, 0.0, 0.5, 1.0, 1.0]);
    assert_eq!(shade_level(0.4, 0.5, 0.5), 0.0);
    assert_eq!(shade_level(0.5, 0.5, 0.5), 1.0);
}

fn part(flags: u32) -> Part {
    Part {
        flags,
        dark_at: 0.2,
        light_at: 0.7,
        threshold: 0.5,
        ..Part::default()
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]
    #[test]
    fn a_range_that_is_decided_is_so_for_every_hatch(
        low in 0f32..1.0, width in 0f32..0.5, at in 0f32..1.0, s in 0f32..1.0, bits in 1u32..4,
    ) {
        let part = part(bits * Part::INK);
        let range = [low, low + width];
        let s = if part.flags & Part::HATCH != 0 { s } else { NO_HATCH };
        if let Some(ink) = ink_over(&part, range) {
            let value = tone_value(s, level_of(&part, low + width * at));
            prop_assert_eq!(ink == 1.0, value < part.threshold);
        }
    }

    /// Rough paper takes less ink than smooth one, in valleys; no triangle of a grained hatch is ink all over.
    #[test]
    fn the_grain_of_paper_takes_ink_in_valleys(
        ink in 0f32..=1.0, x in 0f32..900.0, y in 0f32..900.0, grain in 0f32..2.0, low in 0f32..1.0,
    ) {
        let rough = |hatch_grain: f32| Part { hatch_grain, spots_per_px: 0.4, ..part(Part::HATCH) };
        let [smooth, some, more] = [0.0, grain, grain + 0.3].map(|grain| on_paper(&rough(grain), ink, [x, y]));
        prop_assert!(smooth == ink && (0.0..=ink).contains(&some) && more <= some);
        if paper_height([x, y], 0.4) == 1.0 {
            prop_assert_eq!(more, ink, "hills take all");
        }
        prop_assert!(ink_over(&rough(grain + 0.1), [low, low]) != Some(1.0));
    }

    /// The oracle is the ink that the hatch would give, at its steepest.
    #[test]
    fn a_level_that_decides_leaves_nothing_to_the_hatch(
        l in 0f32..1.0, s in 0f32..1.0, gain in 0.1f32..3.0, spacing in 2f32..40.0, slope in 0f32..1.0,
    ) {
        let part = Part { hatch_gain: gain, spacing_px: spacing, ..part(Part::HATCH) };
        if let Some(ink) = ink_of_level(&part, l) {
            let gradient = edge_gradient(slope * 2.0 / spacing, spacing);
            let want = ink_coverage(tone_value(sharpen(s, gain), l), gradient, part.threshold);
            prop_assert!((ink - want).abs() < 1e-3, "{} for {}", ink, want);
        }
    }

    #[test]
    fn a_second_layer_left_out_would_have_inked_nothing(
        l in 0f32..1.0, s in 0f32..1.0, start in 0f32..1.0, gain in 0.1f32..3.0, spacing in 2f32..40.0,
    ) {
        let part = Part { hatch_gain: gain, spacing_px: spacing, second_from: start, ..part(Part::HATCH) };
        if !second_may_ink(&part, l) {
            let [second, steeper] = second_of_two(s, start);
            let gradient = gain * steeper * 2.0 / spacing;
            let want = ink_coverage(tone_value(sharpen(second, gain), l), gradient, part.threshold);
            prop_assert!(want < 1e-3, "{}", want);
        }
    }

    #[test]
    fn strokes_give_way_to_edges_within_their_spacing(s in 0f32..=1.0, per_px in 0f32..2.0, spacing in 2f32..20.0) {
        let hatching = Hatching { s, slope: [0.3, 0.1], hairline: 0.2 };
        let change = per_px * spacing;
        let after = toned_hatch(hatching, abruptness(per_px, spacing));
        prop_assert!((after.s - NO_HATCH).abs() <= (s - NO_HATCH).abs() + 1e-6);
        prop_assert!(change > ABRUPT || after.s == s);
        prop_assert!(change < 2.001 * ABRUPT || after.s == NO_HATCH);
    }

    #[test]
    fn chart_distortion_only_fills_the_dark(s in 0f32..=1.0, l in 0f32..=1.0, chart_distortion in 0f32..=1.0) {
        let before = Hatching { s, slope: [0.3, 0.1], hairline: 0.2 };
        let after = untied(before, chart_distortion);
        prop_assert!(after.s <= s);
        // Where enough is white, nothing changes sides.
        let is_inked = |s: f32| tone_value(s, l) < 0.5;
        prop_assert!(l < 0.251 + 0.5 * DISTORTION_FILL || is_inked(after.s) == is_inked(s));
        let tied = untied(before, 1.0);
        prop_assert!(l > 0.249 + 0.5 * DISTORTION_FILL || tone_value(tied.s, l) < 0.5);
    }

    #[test]
    fn hatch_without_ink_leaves_paper(x in 0f32..1.0) {
        prop_assert!(tone_value(1.0, level_of(&part(Part::HATCH), x)) > 0.5);
    }
}

const SIDE: usize = 160;

/// Ink of strokes at an angle whose tone runs from black to white, from left to right or from top to bottom.
fn ramp_of_strokes(angle: f32, spacing_px: f32, is_down: bool) -> Vec<f32> {
    let hatch = Hatch {
        length: 60.0,
        ..Hatch::default()
    };
    let tile = levels(&hatch, 256).unwrap();
    let words: Vec<Vec<u32>> = tile
        .levels
        .iter()
        .map(|level| bytemuck::cast_slice(level).to_vec())
        .collect();
    let mut store = TextureStore::new();
    let part = Part {
        flags: Part::INK | Part::HATCH,
        threshold: 0.5,
        light_at: 1.0,
        hatch: store
            .add_tile(tile.side, tile.spacing_texels, &words)
            .unwrap(),
        hatch_gain: 1.0,
        spacing_px,
        turn: [math::cos(angle), math::sin(angle)],
        ..Part::default()
    };
    let size = [SIDE as f32; 2];
    let window = Window::over(size, [0.0; 2], size, [SIDE as u32; 2]);
    let (view, lights, rules, compose) = (
        View::default(),
        Lights::default(),
        Rules::default(),
        Compose::default(),
    );
    let layers = Layers {
        texels: store.words(),
        ..Layers::empty(&view, &window, &compose, &lights, &rules)
    };
    let scale = tile.spacing_texels / (tile.side as f32 * spacing_px);
    let per_px = 0.6 / SIDE as f32;
    let change = if is_down {
        [0.0, per_px]
    } else {
        [per_px, 0.0]
    };
    let ink_at = |i: usize| {
        let at = [(i % SIDE) as f32 + 0.5, (i / SIDE) as f32 + 0.5];
        layers.ink_on_sheet(
            &part,
            at,
            scale,
            0.2 + per_px * at[usize::from(is_down)],
            change,
        )
    };
    (0..SIDE * SIDE).map(ink_at).collect()
}

/// Pieces of up to `most` pixels that are in, joined by sides and corners, away from the picture's border.
fn specks(is_in: impl Fn(usize) -> bool, most: usize) -> usize {
    let mut seen = vec![false; SIDE * SIDE];
    let mut specks = 0;
    for start in 0..SIDE * SIDE {
        let mut open = vec![start];
        let (mut size, mut is_inside) = (0, true);
        while let Some(i) = open.pop() {
            if std::mem::replace(&mut seen[i], true) || !is_in(i) {
                continue;
            }
            size += 1;
            let [x, y] = [i % SIDE, i / SIDE];
            is_inside &= (1..SIDE - 1).contains(&x) && (1..SIDE - 1).contains(&y);
            for v in y.saturating_sub(1)..(y + 2).min(SIDE) {
                open.extend((x.saturating_sub(1)..(x + 2).min(SIDE)).map(|u| v * SIDE + u));
            }
        }
        specks += usize::from(is_inside && (1..=most).contains(&size));
    }
    specks
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Strokes end in hairlines and so does the paper between them, whatever angle they have to the pixels; a
    /// hairline that only covers pixels through whose middle it runs would be a row of dots, 35 to 140 of them.
    #[test]
    fn hairlines_are_no_rows_of_dots(first in 0f32..0.2, spacing_px in 8f32..12.0) {
        let mut dots = [0, 0];
        for i in 0..8 {
            let ink = ramp_of_strokes(first + 0.19 * i as f32, spacing_px, i % 2 == 0);
            dots[0] += specks(|i| ink[i] > 0.2, 8);
            dots[1] += specks(|i| ink[i] < 0.8, 8);
        }
        prop_assert!(dots[0] + dots[1] <= 20, "dots of ink and of paper: {:?}", dots);
    }
}
