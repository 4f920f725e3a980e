//! Rims of figures of known shape at several samples a pixel: what a pixel shows in part is no side of a border.

use super::super::*;
use npr_core::color::{pack_rgba8, unpack_rgba8};
use npr_core::geometry::{Part, Triangle};
use npr_core::window::Window;
use proptest::prelude::*;

const SIZE: [u32; 2] = [36, 28];

/// A disc before a dark wall on the left and a bright one on the right.
#[derive(Debug, Clone, Copy)]
struct Disc {
    center: [f32; 2],
    radius: f32,
    /// Where the bright wall begins: a column of pixels.
    split: u32,
    /// Samples a pixel, along each axis.
    samples: u32,
}

const FIGURE: f32 = 0.4;
const WALLS: [f32; 2] = [0.0, 1.0];

fn disc() -> impl Strategy<Value = Disc> {
    let center = [10f32..26.0, 10f32..18.0];
    let samples = prop::sample::select(vec![1u32, 2, 4]);
    (center, 4f32..9.0, 4u32..32, samples).prop_map(|(center, radius, split, samples)| Disc {
        center,
        radius,
        split,
        samples,
    })
}

impl Disc {
    fn shows(&self, place: [f32; 2]) -> bool {
        let [x, y] = [0, 1].map(|i| place[i] - self.center[i]);
        x * x + y * y < self.radius * self.radius
    }

    /// Samples of a pixel that show the disc.
    fn covered(&self, x: u32, y: u32) -> u32 {
        let place = |at: u32, i: u32| at as f32 + (i as f32 + 0.5) / self.samples as f32;
        let each = (0..self.samples).flat_map(|i| (0..self.samples).map(move |j| [i, j]));
        let shown = each.filter(|[i, j]| self.shows([place(x, *i), place(y, *j)]));
        shown.count() as u32
    }

    fn all(&self) -> u32 {
        self.samples * self.samples
    }

    fn wall(&self, x: u32) -> f32 {
        WALLS[usize::from(x >= self.split)]
    }

    /// What the disc, the wall and the samples come to at a pixel.
    fn blend(&self, x: u32, y: u32) -> f32 {
        let share = self.covered(x, y) as f32 / self.all() as f32;
        FIGURE * share + self.wall(x) * (1.0 - share)
    }

    /// The pixels around one, itself included.
    fn around(x: u32, y: u32) -> impl Iterator<Item = (u32, u32)> {
        let end = |at: u32, most: u32| (at + 2).min(most);
        (y.saturating_sub(1)..end(y, SIZE[1]))
            .flat_map(move |y| (x.saturating_sub(1)..end(x, SIZE[0])).map(move |x| (x, y)))
    }

    fn rims(&self, rule: Rule) -> Vec<Rim> {
        let side = SIZE.map(|side| side * self.samples);
        let px = SIZE.map(|side| side as f32);
        let window = Window::over(px, [0.0; 2], px, SIZE);
        let mut rules = Rules {
            samples: self.samples,
            ..Rules::default()
        };
        rules.rules[1] = rule;
        let place = |at: u32| (at as f32 + 0.5) / self.samples as f32;
        let ids: Vec<u32> = (0..side[0] * side[1])
            .map(|i| u32::from(self.shows([place(i % side[0]), place(i / side[0])])))
            .collect();
        let depths: Vec<u32> = ids.iter().map(|id| (*id as f32 * 0.5).to_bits()).collect();
        let grey = |v: f32| pack_rgba8([v, v, v, 1.0]);
        let bare: Vec<u32> = (0..SIZE[0] * SIZE[1])
            .map(|i| grey(self.blend(i % SIZE[0], i / SIZE[0])))
            .collect();
        let scenery = Scenery {
            window: &window,
            rules: &rules,
            ids: &ids,
            triangles: &[Triangle::default()],
            part_subjects: &[PartSubject {
                subject: 1,
                rule: 1,
            }],
        };
        let mut busy = vec![0; (tiles_across(SIZE) * SIZE[1].div_ceil(TILE)) as usize];
        flag_tiles(&scenery, &mut busy);
        let search = Search {
            scenery,
            depths: &depths,
            busy: &busy,
            bare: &bare,
            parts: &[Part::default()],
            drawn_ids: &ids,
            ribbons: &[],
            overlay: &[],
        };
        let mut rims = vec![Rim::default(); bare.len()];
        find_rims(&search, &mut rims);
        rims
    }
}

fn published(threshold: f32) -> Rule {
    let criteria = Criteria {
        rgb: Some(threshold),
        ..Criteria::default()
    };
    criteria.rule(2.0, Rule::BRIGHTER)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// The oracle knows the disc and the walls, and never blends them.
    #[test]
    fn sides_are_whole_at_any_number_of_samples(disc in disc(), threshold in 0f32..1.0, by_contrast: bool) {
        let rule = if by_contrast { Rule::CONTRAST } else { published(threshold) };
        let rims = disc.rims(rule);
        for (i, rim) in rims.iter().enumerate() {
            let (x, y) = (i as u32 % SIZE[0], i as u32 / SIZE[0]);
            let here = disc.covered(x, y);
            let figure = Disc::around(x, y).filter(|(x, y)| disc.covered(*x, *y) == disc.all()).count();
            let free = Disc::around(x, y).filter(|(x, y)| disc.covered(*x, *y) == 0);
            let free: Vec<f32> = free.map(|(x, _)| disc.wall(x)).collect();
            if figure == 0 || free.is_empty() {
                prop_assert_eq!(*rim, Rim::default(), "at {}, {}", x, y);
                continue;
            }
            let outside = if here == disc.all() { 0 } else { Rim::OUTSIDE };
            prop_assert_eq!(rim.subject, 1 | outside);
            let mean = free.iter().sum::<f32>() / free.len() as f32;
            let behind = if here == 0 && !by_contrast { disc.wall(x) } else { mean };
            prop_assert!((unpack_rgba8(rim.rim)[0] - FIGURE).abs() < 0.003);
            prop_assert!((unpack_rgba8(rim.behind)[0] - behind).abs() < 0.003, "at {}, {}", x, y);
        }
    }

    /// A straight or gently bent border has no holes: every pixel outside of the disc that touches it whole has a rim.
    #[test]
    fn outlines_have_no_holes(disc in disc()) {
        let rims = disc.rims(published(0.25));
        for (i, rim) in rims.iter().enumerate() {
            let (x, y) = (i as u32 % SIZE[0], i as u32 / SIZE[0]);
            let touches = Disc::around(x, y).any(|(x, y)| disc.covered(x, y) == disc.all());
            let is_outline = disc.covered(x, y) < disc.all() && touches;
            prop_assert_eq!(rim.subject & Rim::OUTSIDE != 0, is_outline, "at {}, {}", x, y);
        }
    }
}

/// The figure is far from both walls, and half-way blends are near it: not one pixel may change.
#[test]
fn no_line_changes_where_neither_wall_is_alike() {
    for samples in [1, 2, 4] {
        let disc = Disc {
            center: [17.3, 13.6],
            radius: 8.4,
            split: 17,
            samples,
        };
        let rule = published(0.3);
        for rim in disc.rims(rule) {
            let [own, _, _, _] = unpack_rgba8(rim.rim);
            let [behind, _, _, _] = unpack_rgba8(rim.behind);
            let is_mixed_wall = behind > 0.01 && behind < 0.99;
            if rim.subject != 0 && !is_mixed_wall {
                let drawn = published::color([0.0; 3], [own; 3], [behind; 3], &rule);
                assert_eq!(drawn, [0.0; 3], "{samples} samples");
            }
        }
    }
}
