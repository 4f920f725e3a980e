//! Rims of small pictures against slow oracles.

mod samples;
mod stretch;

use super::*;
use npr_core::color::{pack_rgba8, unpack_rgba8};
use npr_core::geometry::{Part, Triangle};
use npr_core::window::Window;
use proptest::prelude::*;

/// A picture whose pixel shows nothing (0) or one of three parts: two of the first subject, one of the second.
#[derive(Debug, Clone)]
struct Picture {
    size: [u32; 2],
    shown: Vec<u32>,
    bare: Vec<u32>,
    depths: [f32; 4],
}

const PART_SUBJECTS: [PartSubject; 3] = [
    PartSubject {
        subject: 1,
        rule: 1,
    },
    PartSubject {
        subject: 1,
        rule: 0,
    },
    PartSubject {
        subject: 2,
        rule: 1,
    },
];

fn picture() -> impl Strategy<Value = Picture> {
    (1u32..40, 1u32..24).prop_flat_map(|(width, height)| {
        let count = (width * height) as usize;
        let texel = (prop_oneof![4 => Just(0u32), 1 => 1u32..4], any::<u32>());
        let depths = [0.2f32..0.4, 0.2f32..0.4, 0.5f32..0.9];
        (prop::collection::vec(texel, count), depths).prop_map(move |(texels, depths)| Picture {
            size: [width, height],
            shown: texels.iter().map(|texel| texel.0).collect(),
            bare: texels.iter().map(|texel| texel.1 | 0xff00_0000).collect(),
            depths: [0.0, depths[0], depths[0], depths[2]],
        })
    })
}

fn rules() -> Rules {
    let mut rules = Rules {
        samples: 1,
        smooth_px: 3.0,
        whole_px: 1.0,
        reach_px: 4,
        ..Rules::default()
    };
    rules.rules[1] = Rule::CONTRAST;
    rules
}

impl Picture {
    fn window(&self) -> Window {
        let px = self.size.map(|side| side as f32);
        Window::over(px, [0.0; 2], px, self.size)
    }

    fn subject(&self, i: usize) -> u32 {
        match self.shown[i] {
            0 => 0,
            part => PART_SUBJECTS[part as usize - 1].subject,
        }
    }

    fn rims(&self, rules: &Rules) -> Vec<Rim> {
        let window = self.window();
        let triangles = [0, 1, 2].map(|part| Triangle {
            part,
            ..Triangle::default()
        });
        let depths: Vec<u32> = self
            .shown
            .iter()
            .map(|part| self.depths[*part as usize].to_bits())
            .collect();
        let scenery = Scenery {
            window: &window,
            rules,
            ids: &self.shown,
            triangles: &triangles,
            part_subjects: &PART_SUBJECTS,
        };
        let rows = self.size[1].div_ceil(TILE);
        let mut busy = vec![0; (tiles_across(self.size) * rows) as usize];
        flag_tiles(&scenery, &mut busy);
        let search = Search {
            scenery,
            depths: &depths,
            busy: &busy,
            bare: &self.bare,
            parts: &[Part::default(); 3],
            drawn_ids: &self.shown,
            ribbons: &[],
            overlay: &[],
        };
        let mut rims = vec![Rim::default(); self.shown.len()];
        find_rims(&search, &mut rims);
        rims
    }

    fn around(&self, i: usize) -> Vec<usize> {
        let [width, height] = self.size.map(|side| side as i64);
        let (x, y) = (i as i64 % width, i as i64 / width);
        let near = (-1..2).flat_map(|dy| (-1..2).map(move |dx| (x + dx, y + dy)));
        near.filter(|(x, y)| *x >= 0 && *y >= 0 && *x < width && *y < height)
            .map(|(x, y)| (y * width + x) as usize)
            .collect()
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// Subject 2 lies before subject 1: wherever any of it is near it owns the border.
    #[test]
    fn rims_lie_where_subjects_meet_and_hold_the_means_of_both_sides(picture in picture()) {
        let rims = picture.rims(&rules());
        for (i, rim) in rims.iter().enumerate() {
            let around = picture.around(i);
            let owner = around.iter().map(|i| picture.subject(*i)).max().unwrap_or(0);
            let (own, other): (Vec<usize>, Vec<usize>) = around.iter().partition(|i| picture.subject(**i) == owner);
            if owner == 0 || other.is_empty() {
                prop_assert_eq!(*rim, Rim::default());
                continue;
            }
            let outside = if picture.subject(i) == owner { 0 } else { Rim::OUTSIDE };
            prop_assert_eq!(rim.subject, owner | outside);
            let mean = |side: &[usize], channel: usize| {
                side.iter().map(|i| unpack_rgba8(picture.bare[*i])[channel]).sum::<f32>() / side.len() as f32
            };
            let (rim_color, behind) = (unpack_rgba8(rim.rim), unpack_rgba8(rim.behind));
            for channel in 0..3 {
                prop_assert!((rim_color[channel] - mean(&own, channel)).abs() < 0.003);
                prop_assert!((behind[channel] - mean(&other, channel)).abs() < 0.003);
            }
            let contrast_cache = own.iter().filter(|i| picture.shown[**i] != 2).count() as f32 / own.len() as f32;
            prop_assert!((rim_color[3] - contrast_cache).abs() < 0.003);
        }
    }

    #[test]
    fn every_pixel_gets_the_nearest_rim_within_reach(picture in picture()) {
        // The published method carries what lies behind as it is.
        let (mut rules, window) = (rules(), picture.window());
        rules.rules[1].method = Rule::BY_LIKENESS;
        let rims = picture.rims(&rules);
        let count = rims.len();
        let (mut columns, mut fronts, mut backs) = (vec![0; count], vec![0; count], vec![0; count]);
        spread_rows(&window, &rules, &rims, &mut columns);
        let rows = picture.size[1].div_ceil(TILE);
        let biases = vec![ContrastBias::default(); (tiles_across(picture.size) * rows) as usize];
        spread_rims(&window, &rules, &rims, &columns, &biases, &mut fronts, &mut backs);
        let width = picture.size[0];
        let place = |i: usize| [i as u32 % width, i as u32 / width];
        for i in 0..count {
            let square = |j: usize| {
                let ([ax, ay], [bx, by]) = (place(i), place(j));
                ax.abs_diff(bx).pow(2) + ay.abs_diff(by).pow(2)
            };
            let nearest = (0..count).filter(|j| rims[*j].subject != 0).map(square).min();
            match nearest.filter(|square| *square <= 16) {
                None => prop_assert_eq!((fronts[i], backs[i]), (0, 0)),
                Some(square_here) => {
                    let is_it = |j: usize| rims[j].subject != 0 && rims[j].behind == backs[i];
                    let found = (0..count).any(|j| is_it(j) && square(j) == square_here);
                    prop_assert!(found);
                }
            }
        }
    }

    #[test]
    fn smoothing_stays_between_its_rims_and_keeps_what_is_even(picture in picture(), color: u32, behind: u32) {
        let (rules, window) = (rules(), picture.window());
        let mut rims = picture.rims(&rules);
        let mut smoothed = rims.clone();
        smooth_rims(&window, &rules, &rims, &mut smoothed);
        for (rim, out) in rims.iter().zip(&smoothed) {
            prop_assert_eq!((rim.subject, rim.part), (out.subject, out.part));
        }
        for rim in rims.iter_mut().filter(|rim| rim.subject != 0) {
            (rim.rim, rim.behind) = (color | 0xff00_0000, behind & 0x00ff_ffff | 1 << 24);
        }
        smooth_rims(&window, &rules, &rims, &mut smoothed);
        let near = |a: u32, b: u32| a.to_le_bytes().iter().zip(b.to_le_bytes()).all(|(a, b)| a.abs_diff(b) < 2);
        prop_assert!(rims.iter().zip(&smoothed).all(|(a, b)| near(a.rim, b.rim) && near(a.behind, b.behind)));
    }

    /// Where nothing lies behind, no rule counts.
    #[test]
    fn nothing_behind_counts_for_nothing(mut picture in picture()) {
        for i in 0..picture.shown.len() {
            if picture.shown[i] == 0 {
                picture.bare[i] = 0;
            } else {
                picture.shown[i] = 1;
            }
        }
        prop_assert!(picture.rims(&rules()).iter().all(|rim| rim.rim >> 24 == 0));
    }
}

#[test]
fn a_subject_over_everything_or_nowhere_has_no_rim() {
    for part in [0, 1] {
        let picture = Picture {
            size: [33, 20],
            shown: vec![part; 660],
            bare: vec![u32::MAX; 660],
            depths: [0.0, 0.3, 0.3, 0.3],
        };
        assert!(
            picture
                .rims(&rules())
                .iter()
                .all(|rim| *rim == Rim::default())
        );
    }
}

/// In frames the published method sees what it sees on two pictures: the pixel's own colour, and its neighbours' mean.
#[test]
fn published_rims_are_those_of_the_publication() {
    let size = [12u32, 12];
    let is_inside = |i: u32| (3..9).contains(&(i % 12)) && (3..9).contains(&(i / 12));
    let color = |i: u32| match is_inside(i) {
        true => [0.2 + 0.02 * (i % 12) as f32, 0.3, 0.1, 1.0],
        false => [0.1, 0.2, 0.05 + 0.02 * (i / 12) as f32, 1.0],
    };
    let criteria = Criteria {
        rgb: Some(0.3),
        ..Criteria::default()
    };
    let mut rules = rules();
    rules.rules[1] = criteria.rule(1.5, Rule::BRIGHTER);
    let bytes: Vec<u32> = (0..144).map(|i| pack_rgba8(color(i))).collect();
    let picture = Picture {
        size,
        shown: (0..144).map(|i| u32::from(is_inside(i))).collect(),
        bare: bytes.clone(),
        depths: [0.0, 0.3, 0.3, 0.3],
    };
    let composed: Vec<[f32; 4]> = bytes.iter().map(|texel| unpack_rgba8(*texel)).collect();
    let alone: Vec<[f32; 4]> = (0..144)
        .map(|i| {
            if is_inside(i) {
                composed[i as usize]
            } else {
                [0.0; 4]
            }
        })
        .collect();
    let want = published::outline(size, &alone, &composed, [0.0; 3], &rules.rules[1]).unwrap();
    for (rim, want) in picture.rims(&rules).iter().zip(want) {
        assert_eq!(rim.subject & Rim::OUTSIDE != 0, want.is_some());
        let Some(want) = want else { continue };
        let sides = [rim.rim, rim.behind]
            .map(unpack_rgba8)
            .map(|[r, g, b, _]| [r, g, b]);
        let got = published::color([0.0; 3], sides[0], sides[1], &rules.rules[1]);
        assert!((0..3).all(|i| (got[i] - want[i]).abs() < 0.005));
    }
}
