//! Smooth noise along a closed line.

use npr_core::random::{hash, signed, unit};

/// Smooth noise of -1..1 with period 1 in `x`, through `cells` random heights per period.
///
/// A uniform cubic B-spline: its bends change smoothly, as a hand's do, which steps blended by
/// a smooth step do not. Most values lie within 0.4 of 0.
pub fn closed_noise(seed: u32, stream: u32, cells: u32, x: f32) -> f32 {
    let cells = cells.max(1);
    let place = (x - x.floor()) * cells as f32;
    let cell = place.floor();
    let t = place - cell;
    let height = |offset: u32| signed(hash(seed, stream, (cell as u32 + offset) % cells));
    let s = 1.0 - t;
    let near = |t: f32| (3.0 * t - 6.0) * t * t + 4.0;
    (height(0) * s * s * s + height(1) * near(t) + height(2) * near(s) + height(3) * t * t * t)
        / 6.0
}

/// [`closed_noise`] with a real number of cells: the two powers of two around it, blended.
///
/// As `cells` grows finer noise takes over from coarser without a jump.
pub fn scaled_noise(seed: u32, stream: u32, cells: f32, x: f32) -> f32 {
    let mut coarse = 1;
    while coarse < 1 << 16 && (2 * coarse) as f32 <= cells {
        coarse *= 2;
    }
    let blend = (cells / coarse as f32 - 1.0).clamp(0.0, 1.0);
    let octave = |cells: u32| closed_noise(seed, hash(stream, cells, 0), cells, x);
    octave(coarse) * (1.0 - blend) + octave(2 * coarse) * blend
}

/// The `k`-th number of van der Corput's sequence in base 2, 0..1.
///
/// Any first few of them are spread evenly, so a list in this order thins out evenly from its end.
pub fn bit_reversed(k: u32) -> f32 {
    unit(k.reverse_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_first_numbers_halve_what_is_left() {
        let first: Vec<f32> = (0..5).map(bit_reversed).collect();
        assert_eq!(first, [0.0, 0.5, 0.25, 0.75, 0.125]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn noise_is_closed_bounded_and_smooth(seed: u32, stream: u32, cells in 0u32..100, x in -2.0f32..2.0) {
            let at = |x| closed_noise(seed, stream, cells, x);
            prop_assert!(at(x).abs() <= 1.0);
            prop_assert!((at(x) - at(x + 1.0)).abs() < 1e-3);
            prop_assert!((at(x) - at(x + 1e-4)).abs() < 2.5e-4 * cells.max(1) as f32 + 1e-5);
        }

        #[test]
        fn growing_noise_never_jumps(seed: u32, cells in 0.0f32..64.0, x in 0.0f32..1.0) {
            let at = |cells| scaled_noise(seed, 1, cells, x);
            prop_assert!((at(cells) - at(cells + 1e-3)).abs() < 5e-3);
        }
    }
}
