//! What a whole tile must hold to: tone, size on screen, continuity, symmetry.

use super::tile::{SIDE_MIN, sides};
use super::*;
use proptest::prelude::*;

const PATTERNS: [Pattern; 6] = [
    Pattern::Parallel,
    Pattern::Cross,
    Pattern::Stipple,
    Pattern::Dots,
    Pattern::Pencil,
    Pattern::Brush,
];

fn tile(pattern: Pattern, side: u32) -> HatchTile {
    let hatch = Hatch {
        pattern,
        ..Hatch::default()
    };
    levels(&hatch, side).unwrap()
}

/// S all over a tile, on a grid that no level's texels lie on.
fn luminances(tile: &HatchTile, level: u32, f: f32) -> Vec<f32> {
    let at = |i: u32| [(i % 301) as f32 / 301.0, (i / 301) as f32 / 301.0];
    let (texels, side) = (&tile.levels[level as usize], tile.side >> level);
    (0..301 * 301)
        .map(|i| sample(texels, side, at(i), f).luminance)
        .collect()
}

/// Part of the samples that light `l` inks.
fn ink_share(luminances: &[f32], l: f32) -> f32 {
    let inked = luminances
        .iter()
        .filter(|&&s| tone_value(s, l) < 0.5)
        .count();
    inked as f32 / luminances.len() as f32
}

/// Asserts that ink falls off linearly with light, up to `most`.
fn assert_linear(luminances: &[f32], most: f32, what: &str) {
    for l in (1..20).map(|i| 0.05 * i as f32) {
        let want = (1.5 - 2.0 * l).clamp(0.0, 1.0);
        let got = ink_share(luminances, l);
        assert!(
            (got - want).abs() < most,
            "{what}: {got}, not {want} at {l}"
        );
    }
}

#[test]
fn ink_is_linear_in_light_at_any_distance() {
    for pattern in PATTERNS {
        let tile = tile(pattern, 512);
        for level in 0..3 {
            for (f, most) in [
                (0.0, 0.06),
                (0.25, 0.06),
                (0.5, 0.06),
                (0.75, 0.06),
                (0.15, 0.08),
                (0.4, 0.08),
                (0.6, 0.08),
                (0.9, 0.08),
            ] {
                let what = format!("{pattern:?} {level} {f}");
                assert_linear(&luminances(&tile, level, f), most, &what);
            }
        }
    }
}

#[test]
fn crossed_layers_keep_the_tone() {
    let tile = tile(Pattern::Cross, 512);
    for start in [0.2, 0.5, 0.8] {
        let first = |i: u32| [(i % 301) as f32 / 301.0, (i / 301) as f32 / 301.0];
        let both = |i: u32| {
            let [u, v] = first(i);
            let layer = |place| sample(&tile.levels[0], 512, place, 0.3).luminance;
            cross_luminance(layer([u, v]), layer([v + 0.5, u + 0.5]), start)
        };
        let luminances: Vec<f32> = (0..301 * 301).map(both).collect();
        assert_linear(&luminances, 0.08, &format!("from {start}"));
    }
}

#[test]
fn the_end_of_a_level_is_the_start_of_the_next() {
    for pattern in PATTERNS {
        let tile = tile(pattern, 256);
        for level in 0..3 {
            let (end, start) = (
                luminances(&tile, level, 1.0),
                luminances(&tile, level + 1, 0.0),
            );
            for l in [0.3, 0.4, 0.5, 0.6, 0.7] {
                let ink = |s: f32| ink_coverage(tone_value(s, l), 0.25, 0.5);
                let differ = end
                    .iter()
                    .zip(&start)
                    .map(|(a, b)| (ink(*a) - ink(*b)).abs());
                let mean = differ.sum::<f32>() / end.len() as f32;
                // The finer level shows grain and tips that the coarser one's texels average.
                let most = if pattern == Pattern::Pencil {
                    0.12
                } else {
                    0.05
                };
                assert!(mean < most, "{pattern:?} {level}: {mean} at {l}");
            }
        }
    }
}

/// Mean period and width, in pixels, of the strokes along rows of a screen at `octaves`.
fn strokes_px(tile: &HatchTile, octaves: f32) -> [f32; 2] {
    let (level, f) = level_at(octaves, tile.levels.len() as u32);
    let (texels, side) = (&tile.levels[level as usize], tile.side >> level);
    let texels_per_px = npr_core::math::powf(2.0, octaves);
    let px = tile.side as f32 / texels_per_px;
    let (mut runs, mut ink) = (0, 0);
    let (rows, steps) = (64, 4096);
    for row in 0..rows {
        let inked = |i: u32| {
            let place = [i as f32 / steps as f32, (row as f32 + 0.5) / rows as f32];
            tone_value(sample(texels, side, place, f).luminance, 0.5) < 0.5
        };
        runs += (0..steps).filter(|&i| inked(i) && !inked(i + 1)).count();
        ink += (0..steps).filter(|&i| inked(i)).count();
    }
    let runs = runs as f32;
    [
        px * rows as f32 / runs,
        px * ink as f32 / steps as f32 / runs,
    ]
}

#[test]
fn strokes_keep_their_period_and_width_over_four_octaves() {
    let tile = tile(Pattern::Parallel, 1024);
    let all: Vec<[f32; 2]> = (0..=16)
        .map(|i| strokes_px(&tile, 0.25 * i as f32))
        .collect();
    for i in 0..2 {
        let mean = all.iter().map(|m| m[i]).sum::<f32>() / all.len() as f32;
        assert!(
            all.iter().all(|m| (m[i] / mean - 1.0).abs() < 0.15),
            "{mean}: {all:?}"
        );
    }
}

#[test]
fn levels_end_where_two_strokes_are_left() {
    let tile = tile(Pattern::Dots, 128);
    let counts: Vec<usize> = tile.levels.iter().map(Vec::len).collect();
    assert_eq!(counts, [128 * 128, 64 * 64, 32 * 32, 16 * 16]);
    assert_eq!(sides(SIDE_MIN).collect::<Vec<_>>(), [SIDE_MIN]);
}

#[test]
fn other_sides_are_refused() {
    for side in [0, 1, 8, 24, 2048, u32::MAX] {
        assert_eq!(
            levels(&Hatch::default(), side),
            Err(HatchError::Side { side })
        );
    }
}

#[test]
fn threads_do_not_matter_and_seeds_do() {
    let pool = |threads| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap()
    };
    for pattern in PATTERNS {
        let one = pool(1).install(|| tile(pattern, 128));
        assert_eq!(one, pool(5).install(|| tile(pattern, 128)));
        let other = Hatch {
            pattern,
            seed: 1,
            ..Hatch::default()
        };
        let other = levels(&other, 128).unwrap();
        assert_eq!(one == other, pattern == Pattern::Dots, "{pattern:?}");
    }
}

fn any_hatch() -> impl Strategy<Value = Hatch> {
    let number = prop_oneof![
        8 => -1.0f32..2.0,
        2 => 0.0f32..300.0,
        1 => prop::sample::select(vec![f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX]),
    ];
    let numbers = [number.clone(), number.clone(), number.clone(), number];
    (0usize..6, numbers, any::<u32>()).prop_map(|(i, [length, wobble, taper, variation], seed)| {
        Hatch {
            pattern: PATTERNS[i],
            length,
            wobble,
            taper,
            variation,
            seed,
            ..Hatch::default()
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_setting_gives_a_tile_that_a_half_turn_keeps(hatch in any_hatch(), power in 4u32..7) {
        let tile = levels(&hatch, 1 << power).unwrap();
        for level in &tile.levels {
            prop_assert!(level.iter().eq(level.iter().rev()));
            prop_assert!(level.iter().flatten().all(|&channel| channel != 0 && channel != 255));
        }
    }
}
