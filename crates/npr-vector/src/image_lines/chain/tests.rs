//! Borders of made-up pictures, linked.

use super::*;
use npr_core::line_kind::KindSet;
use npr_core::math::mix_bits;
use proptest::prelude::*;

/// The borders of a picture of surfaces, of which the one with the lesser number is in front.
fn borders_of(size: [u32; 2], surface: &dyn Fn(u32) -> u32) -> Borders {
    let [width, height] = size;
    let mut all = Vec::new();
    for pixel in 0..width * height {
        let left = (pixel % width > 0).then(|| (2 * pixel, pixel - 1));
        let above = pixel.checked_sub(width).map(|other| (2 * pixel + 1, other));
        for (side, other) in [left, above].into_iter().flatten() {
            let (here, there) = (surface(pixel), surface(other));
            if here != there {
                all.push(Border {
                    side,
                    owner: if here < there { pixel } else { other },
                    kind: KindSet::CONTOUR,
                });
            }
        }
    }
    Borders { size, all }
}

#[test]
fn an_outline_runs_past_what_it_hides() {
    // A disc before a wall in two halves.
    let surface = |pixel: u32| {
        let [x, y] = [pixel % 40, pixel / 40].map(|at| f64::from(at) - 19.5);
        match x.hypot(y) < 9.0 {
            true => 0,
            false => 1 + u32::from(x > 0.0),
        }
    };
    let borders = borders_of([40, 40], &surface);
    let found = chains(&borders, surface);
    let rings: Vec<&Chain> = found.iter().filter(|chain| chain.closed).collect();
    assert_eq!((found.len(), rings.len()), (3, 1));
    assert_eq!(rings[0].label[1], 0);
    for line in found.iter().filter(|chain| !chain.closed) {
        assert_eq!(line.label[1], 1);
        // One end at the picture's edge, one at the disc.
        assert_eq!(line.free.iter().filter(|free| **free).count(), 1);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn chains_are_ways_that_take_every_border_once(
        width in 1u32..14, height in 1u32..14, surfaces in 1u32..6, seed: u32,
    ) {
        let surface = |pixel: u32| mix_bits(seed ^ mix_bits(pixel)) % surfaces;
        let borders = borders_of([width, height], &surface);
        let grid = Grid { borders: &borders };
        let found = chains(&borders, surface);
        let mut taken: Vec<u32> = found.iter().flat_map(|chain| chain.borders.iter().copied()).collect();
        taken.sort_unstable();
        prop_assert!(taken.into_iter().eq(0..borders.all.len() as u32));
        for chain in &found {
            // Walk it from corner to corner.
            let mut corner = chain.ends[0];
            for border in &chain.borders {
                let [a, b] = grid.ends(*border);
                prop_assert!(corner == a || corner == b);
                corner = if corner == a { b } else { a };
            }
            prop_assert_eq!(corner, chain.ends[1]);
            prop_assert!(!chain.closed || corner == chain.ends[0]);
            for end in [0, 1] {
                let alone = !chain.closed && grid.around(chain.ends[end]).count() == 1;
                prop_assert_eq!(chain.free[end], alone);
            }
        }
    }

    /// Where all is one surface before another, lines end nowhere but at the picture's edge and where four borders
    /// meet.
    #[test]
    fn lines_of_one_label_end_at_meetings_only(width in 2u32..14, height in 2u32..14, seed: u32) {
        let surface = |pixel: u32| mix_bits(seed ^ mix_bits(pixel)) % 2;
        let borders = borders_of([width, height], &surface);
        let grid = Grid { borders: &borders };
        for chain in chains(&borders, surface) {
            let counts = chain.ends.map(|end| grid.around(end).count());
            prop_assert!(chain.closed || counts.iter().all(|count| *count == 1 || *count == 4));
        }
    }
}
