//! Stretches of outline on small grids of tiles.

use super::rules as rim_rules;
use crate::backdrop::adapt::{place_of_light, preference};
use crate::backdrop::stretch::bias_between;
use crate::backdrop::*;
use npr_core::color::{linear_from_srgb, pack_rgba8, unpack_rgba8};
use npr_core::geometry::Part;
use npr_core::window::Window;
use proptest::prelude::*;

/// Tiles, and the frame that they lie in.
#[derive(Debug, Clone)]
struct Tiles {
    size: [u32; 2],
    gathered: Vec<TileRims>,
}

fn rules() -> Rules {
    Rules {
        bias_px: 16.0,
        hold: 1.0,
        fade: 0.1,
        ..rim_rules()
    }
}

fn window(size: [u32; 2]) -> Window {
    let px = size.map(|side| side as f32);
    Window::over(px, [0.0; 2], px, size)
}

/// A tile of one of two subjects, or of none.
fn tile() -> impl Strategy<Value = TileRims> {
    let places = (0f32..=1.0, 0f32..=1.0, 0f32..0.2, any::<u32>());
    (0u32..3, places, 1u32..9).prop_map(|(whose, (line, behind, spread, rim), count)| {
        if whose == 0 {
            return TileRims {
                low: 1.0,
                ..TileRims::default()
            };
        }
        TileRims {
            line,
            behind,
            low: (behind - spread).max(0.0),
            high: (behind + spread).min(1.0),
            count: count as f32,
            whose,
            rule: 1,
            rim,
        }
    })
}

fn tiles() -> impl Strategy<Value = Tiles> {
    (1u32..60, 1u32..60).prop_flat_map(|size| {
        let size = [size.0, size.1];
        let count = (tiles_across(size) * size[1].div_ceil(TILE)) as usize;
        prop::collection::vec(tile(), count).prop_map(move |gathered| Tiles { size, gathered })
    })
}

impl Tiles {
    fn bounds(&self, rules: &Rules) -> Vec<ContrastBias> {
        let mut bounds = vec![ContrastBias::default(); self.gathered.len()];
        bound_tiles(&window(self.size), rules, &self.gathered, &mut bounds);
        bounds
    }

    fn biases(&self, rules: &Rules, before: &[ContrastBias]) -> Vec<ContrastBias> {
        let mut biases = vec![ContrastBias::default(); self.gathered.len()];
        let bounds = self.bounds(rules);
        vote_bias(
            &window(self.size),
            rules,
            &self.gathered,
            &bounds,
            before,
            &mut biases,
        );
        biases
    }

    fn blended(&self, rules: &Rules, biases: &[ContrastBias]) -> Vec<ContrastBias> {
        let mut kept = vec![ContrastBias::default(); biases.len()];
        let mut blended = kept.clone();
        blend_biases(&window(self.size), rules, biases, &mut kept, &mut blended);
        assert_eq!(kept, biases);
        blended
    }

    fn none_before(&self) -> Vec<ContrastBias> {
        vec![ContrastBias::default(); self.gathered.len()]
    }

    /// Tiles around one, with how far they lie in each direction.
    fn around(&self, i: usize, reach: u32) -> impl Iterator<Item = (usize, [f32; 2])> {
        let across = tiles_across(self.size);
        let (x, y) = (i as u32 % across, i as u32 / across);
        (0..self.gathered.len()).filter_map(move |j| {
            let at = [j as u32 % across, j as u32 / across];
            let near = at[0].abs_diff(x) <= reach && at[1].abs_diff(y) <= reach;
            near.then(|| (j, [at[0] as f32 - x as f32, at[1] as f32 - y as f32]))
        })
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Every line reads before what lies behind its own tile, and bounds fall no faster than the eye follows.
    #[test]
    fn bounds_hold_their_own_tile_and_fall_slowly(tiles in tiles()) {
        let bounds = tiles.bounds(&rules());
        for (i, (bound, here)) in bounds.iter().zip(&tiles.gathered).enumerate() {
            prop_assert_eq!(bound.whose, here.whose);
            if here.whose == 0 {
                continue;
            }
            prop_assert!(bound.low <= here.low && bound.high >= here.high);
            for (j, off) in tiles.around(i, 4) {
                let there = tiles.gathered[j];
                if there.whose != here.whose || (there.behind - here.behind).abs() > 0.42 {
                    continue;
                }
                let far = (off[0] * off[0] + off[1] * off[1]).sqrt();
                prop_assert!(bound.high >= there.high - 0.08 * far - 1e-6);
                prop_assert!(bound.low <= there.low + 0.08 * far + 1e-6);
            }
        }
    }

    /// Subjects decide for themselves: what another one is like changes nothing.
    #[test]
    fn subjects_do_not_mind_each_other(tiles in tiles(), other in tile()) {
        let rules = rules();
        let mut changed = tiles.clone();
        for there in changed.gathered.iter_mut().filter(|there| there.whose == 2) {
            *there = TileRims { whose: 2, rule: 1, ..other };
        }
        let of_first = |tiles: &Tiles| {
            let biases = tiles.biases(&rules, &tiles.none_before());
            let blended = tiles.blended(&rules, &biases);
            blended.into_iter().filter(|bias| bias.whose == 1).collect::<Vec<_>>()
        };
        prop_assert_eq!(of_first(&tiles), of_first(&changed));
    }

    /// Where all say the same, all go that way at once; the vote is that of a line by itself.
    #[test]
    fn one_mind_leans_one_way(size in (1u32..60, 1u32..60), line in 0f32..=1.0, behind in 0f32..=1.0) {
        let rules = rules().of_first_frame();
        let here = TileRims { line, behind, low: behind, high: behind, count: 3.0, whose: 5, rule: 1, rim: u32::MAX };
        let size = [size.0, size.1];
        let count = (tiles_across(size) * size[1].div_ceil(TILE)) as usize;
        let tiles = Tiles { size, gathered: vec![here; count] };
        let vote = preference(line, [behind; 2], &rules.rules[1]);
        prop_assume!(vote.abs() > 0.02);
        let biases = tiles.biases(&rules, &tiles.none_before());
        for bias in tiles.blended(&rules, &biases) {
            prop_assert!((bias.bias - vote.signum()).abs() < 1e-5, "{} for {vote}", bias.bias);
            prop_assert!((bias.low - behind).abs() < 1e-6 && (bias.high - behind).abs() < 1e-6);
        }
    }

    /// From frame to frame nothing changes faster than the fade allows, whatever happens to the scene.
    #[test]
    fn lines_fade_and_do_not_jump(tiles in tiles(), again in tile()) {
        let rules = rules();
        let before = tiles.biases(&rules.of_first_frame(), &tiles.none_before());
        let mut moved = tiles.clone();
        for there in moved.gathered.iter_mut().filter(|there| there.whose != 0 && again.whose != 0) {
            *there = TileRims { whose: there.whose, behind: there.behind, low: there.low, high: there.high, ..again };
        }
        for (was, bias) in before.iter().zip(moved.biases(&rules, &before)) {
            prop_assert_eq!(was.whose, bias.whose);
            prop_assert!((was.bias - bias.bias).abs() <= 0.2 + 1e-5);
            prop_assert!((was.low - bias.low).abs() <= 0.04 + 1e-5 && (was.high - bias.high).abs() <= 0.04 + 1e-5);
        }
    }

    /// A still scene settles: the next frame is the same when fades have ended, and stays so.
    #[test]
    fn still_scenes_stay_still(tiles in tiles()) {
        let rules = rules();
        let mut biases = tiles.biases(&rules.of_first_frame(), &tiles.none_before());
        for _ in 0..25 {
            biases = tiles.biases(&rules, &biases);
        }
        let after = tiles.biases(&rules, &biases);
        for (a, b) in biases.iter().zip(&after) {
            prop_assert!((a.bias - b.bias).abs() < 1e-5 && a.low == b.low && a.high == b.high);
        }
    }

    /// Another scene is forgotten: once fades have ended, lines are as if it were the first frame.
    ///
    /// What was held may lie 1 off in a bound or a rim, and 2 in a bias. Steps are 0.04 and 0.2, so 25 are enough, and
    /// one more where neighbours held it. The last step adds what is missing, which rounds: the tolerance is the last
    /// place of 1.
    #[test]
    fn lines_arrive_at_what_a_first_frame_decides(
        tiles in tiles(),
        others in prop::collection::vec(tile(), 225),
    ) {
        let rules = Rules { hold: 0.0, ..rules() };
        let gathered = others[..tiles.gathered.len()].to_vec();
        let another = Tiles { gathered, ..tiles.clone() };
        let mut biases = another.biases(&rules.of_first_frame(), &tiles.none_before());
        for _ in 0..30 {
            biases = tiles.biases(&rules, &biases);
        }
        let first = tiles.biases(&rules.of_first_frame(), &tiles.none_before());
        for (bias, want) in biases.iter().zip(&first) {
            prop_assert_eq!(bias.whose, want.whose);
            let [got, want] = [bias, want].map(|bias| {
                let [r, g, b] = bias.rim;
                [bias.low, bias.high, bias.bias, r, g, b]
            });
            let off = (0..6).map(|i| (got[i] - want[i]).abs()).fold(0.0, f32::max);
            prop_assert!(off <= f32::EPSILON, "{got:?}, not {want:?}");
        }
    }

    /// Blending invents nothing: it stays within what the tiles of the subject around say, and leaves bounds alone.
    #[test]
    fn blends_lie_between_what_was_decided(tiles in tiles()) {
        let rules = rules();
        let biases = tiles.biases(&rules.of_first_frame(), &tiles.none_before());
        for (i, (blend, bias)) in tiles.blended(&rules, &biases).iter().zip(&biases).enumerate() {
            prop_assert_eq!((blend.low, blend.high, blend.whose), (bias.low, bias.high, bias.whose));
            if bias.whose == 0 {
                continue;
            }
            let own = || tiles.around(i, 6).filter(|(j, _)| biases[*j].whose == bias.whose);
            let least = own().map(|(j, _)| biases[j].bias).fold(f32::MAX, f32::min);
            let most = own().map(|(j, _)| biases[j].bias).fold(f32::MIN, f32::max);
            prop_assert!(blend.bias >= least - 1e-5 && blend.bias <= most + 1e-5);
        }
    }

    /// A tile holds the mean and the extremes of the rims of its first subject, of one wall.
    #[test]
    fn tiles_gather_their_rims(
        size in (1u32..14, 1u32..14),
        texels in prop::collection::vec((0u32..3, any::<u32>(), 0u8..70), 196),
    ) {
        let size = [size.0, size.1];
        let parts = [Part { line_color: [0.2, 0.1, 0.0, 1.0], ..Part::default() }];
        let rims: Vec<Rim> = texels.iter().take((size[0] * size[1]) as usize).map(|(subject, rim, grey)| Rim {
            rim: *rim,
            behind: u32::from_le_bytes([*grey, *grey, *grey, 1]),
            subject: *subject,
            part: 0,
        }).collect();
        let rules = rules();
        let count = (tiles_across(size) * size[1].div_ceil(TILE)) as usize;
        let mut gathered = vec![TileRims::default(); count];
        gather_tiles(&window(size), &rules, &parts, &rims, &mut gathered);
        for (i, tile) in gathered.iter().enumerate() {
            let across = tiles_across(size);
            let at = [i as u32 % across * TILE, i as u32 / across * TILE];
            let inside = |j: &usize| {
                let px = [*j as u32 % size[0], *j as u32 / size[0]];
                (0..2).all(|k| px[k] >= at[k] && px[k] < at[k] + TILE)
            };
            let near = (0..rims.len()).filter(inside).map(|j| &rims[j]);
            let held: Vec<&Rim> = near.filter(|rim| rim.subject != 0).collect();
            let Some(first) = held.first() else {
                prop_assert_eq!(tile.whose, 0);
                continue;
            };
            let own = || held.iter().filter(|rim| rim.subject == first.subject);
            let place = |rim: &Rim| {
                let [r, g, b, _] = unpack_rgba8(rim.behind);
                place_of_light([r, g, b].map(linear_from_srgb), &rules.rules[1])
            };
            prop_assert_eq!((tile.whose, tile.count), (first.subject, own().count() as f32));
            let places = || own().map(|r| place(r));
            let [low, high] = [places().fold(1.0, f32::min), places().fold(0.0, f32::max)];
            prop_assert_eq!((tile.low, tile.high), (low, high));
            let mean = own().map(|rim| place(rim)).sum::<f32>() / tile.count;
            prop_assert!((tile.behind - mean).abs() < 1e-5);
        }
    }
}

/// Half of the outline stands before one wall, half before another: each half turns by itself, and reads.
#[test]
fn two_walls_are_two_stretches() {
    let rules = Rules {
        bias_px: 40.0,
        ..rules().of_first_frame()
    };
    let size = [160, 4];
    let at = |behind: f32| TileRims {
        line: 0.45,
        behind,
        low: behind,
        high: behind,
        count: 4.0,
        whose: 1,
        rule: 1,
        rim: pack_rgba8([0.4, 0.3, 0.2, 1.0]),
    };
    let gathered = (0..40)
        .map(|i| at(if i < 20 { 0.1 } else { 0.9 }))
        .collect();
    let tiles = Tiles { size, gathered };
    let biases = tiles.biases(&rules, &tiles.none_before());
    for (i, bias) in tiles.blended(&rules, &biases).iter().enumerate() {
        let want = if i < 20 { 0.1 } else { 0.9 };
        assert_eq!((bias.low, bias.high), (want, want));
        assert_eq!(bias.bias, if i < 20 { 1.0 } else { -1.0 });
    }
}

/// A wall with a pattern is one wall: the line keeps one lightness along all of it, and reads before the brightest.
#[test]
fn a_pattern_is_one_wall() {
    let rules = Rules {
        bias_px: 40.0,
        ..rules().of_first_frame()
    };
    let gathered: Vec<TileRims> = (0..40)
        .map(|i| {
            let behind = if i % 4 == 0 { 0.45 } else { 0.3 };
            TileRims {
                line: 0.5,
                behind,
                low: behind,
                high: behind,
                count: 4.0,
                whose: 1,
                rule: 1,
                rim: u32::MAX,
            }
        })
        .collect();
    let tiles = Tiles {
        size: [160, 4],
        gathered,
    };
    let biases = tiles.biases(&rules, &tiles.none_before());
    let blended = tiles.blended(&rules, &biases);
    let grounds = blended.iter().map(|bias| Ground {
        low: bias.low,
        high: bias.high,
        brighter: Some(0.5 + 0.5 * bias.bias),
    });
    let lines: Vec<f32> = grounds
        .map(|ground| {
            let grey = [linear_from_srgb(0.36); 3];
            oklab_of_light(adapted_light(grey, grey, &ground, &rules.rules[1]))[0]
        })
        .collect();
    for (i, line) in lines.iter().enumerate() {
        assert!(
            (line - tiles.gathered[i].behind).abs() > 0.29,
            "{i}: {line}"
        );
    }
    let steps = lines.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    assert!(steps.fold(0.0, f32::max) < 0.1);
}

#[test]
fn pixels_take_the_lean_of_their_own_subject() {
    let bias = |whose: u32, bias: f32| ContrastBias {
        bias,
        whose,
        ..ContrastBias::default()
    };
    let biases = [bias(1, 1.0), bias(2, -1.0)];
    let size = [8, 4];
    for x in 0..8 {
        assert_eq!(
            bias_between(&biases, size, 1, [x, 2]).map(|l| l.bias),
            (x < 6).then_some(1.0)
        );
        assert_eq!(
            bias_between(&biases, size, 2, [x, 2]).map(|l| l.bias),
            (x > 1).then_some(-1.0)
        );
        assert_eq!(bias_between(&biases, size, 3, [x, 2]), None);
    }
}
