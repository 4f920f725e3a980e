//! The grain of paper: hills that dry media touch first.

use crate::math::mix_bits;
use crate::random::unit;

/// Number that the hash of the grain starts from.
const SEED: u32 = 0x6772_6169;

/// Share of the coarse hills in the height of paper; the rest is hills half as wide.
const COARSE: f32 = 0.65;

/// How much heights are spread: sums of even ones gather about the middle.
const SPREAD: f32 = 1.6;

/// Height of the paper at a place of the picture, 0 in a valley to 1 on a hill.
///
/// `px` is in pixels; there are about `spots_per_px` hills to a pixel. The paper lies still in the picture, whatever is
/// drawn on it: tiles of a picture share it. Twin of `lib/grain.wgsl`.
pub fn paper_height(px: [f32; 2], spots_per_px: f32) -> f32 {
    let coarse = hills(px.map(|v| v * spots_per_px), 0);
    let fine = hills(px.map(|v| v * spots_per_px * 2.0), 1);
    let height = coarse * COARSE + fine * (1.0 - COARSE);
    ((height - 0.5) * SPREAD + 0.5).clamp(0.0, 1.0)
}

/// Smooth heights of 0..1, one at every whole place.
fn hills([x, y]: [f32; 2], octave: u32) -> f32 {
    let (column, row) = (x.floor(), y.floor());
    let [s, t] = [x - column, y - row].map(|v| v * v * (3.0 - 2.0 * v));
    let [column, row] = [column, row].map(|v| v as i32 as u32);
    let in_row = |row: u32| {
        let line = mix_bits(mix_bits(SEED.wrapping_add(octave)).wrapping_add(row));
        let hill = |column: u32| unit(mix_bits(line.wrapping_add(column)));
        let left = hill(column);
        left + (hill(column.wrapping_add(1)) - left) * s
    };
    let top = in_row(row);
    top + (in_row(row.wrapping_add(1)) - top) * t
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn all_heights_are_about_as_frequent() {
        let mut counts = [0; 5];
        for i in 0..40_000 {
            let px = [(i % 200) as f32 * 0.7, (i / 200) as f32 * 0.7];
            counts[((paper_height(px, 0.4) * 5.0) as usize).min(4)] += 1;
        }
        assert!(
            counts.iter().all(|n| (4_000..13_000).contains(n)),
            "{counts:?}"
        );
    }

    proptest! {
        #[test]
        fn heights_have_no_steps(x in -3e3f32..3e3, y in -3e3f32..3e3, spots in 0.01f32..1.0) {
            let at = |dx: f32| paper_height([x + dx, y], spots);
            prop_assert!((0.0..=1.0).contains(&at(0.0)));
            // The steepest of both octaves, spread.
            let most = SPREAD * (COARSE * 1.5 + (1.0 - COARSE) * 3.0) * spots * 0.02 + 2e-3;
            prop_assert!((at(0.02) - at(0.0)).abs() < most);
        }

        #[test]
        fn any_place_has_a_height(x: f32, y: f32, spots: f32) {
            let height = paper_height([x, y], spots);
            prop_assert!(height.is_nan() || (0.0..=1.0).contains(&height));
        }
    }
}
