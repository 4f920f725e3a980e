//! Random numbers by counter: the same for the same question, whoever asks first.

use glam::Vec3;
use npr_core::math::{mix, mix_bits, smoothstep};
use npr_core::random;

/// A number of 0..1, 1 left out, for a question put as three numbers.
pub(crate) fn unit(seed: u32, subject: u32, question: u32) -> f32 {
    random::unit(random::hash(seed, subject, question))
}

/// Three numbers of -1..1, 1 left out.
pub(crate) fn signed3(seed: u32, subject: u32, question: u32) -> Vec3 {
    let at =
        |axis: u32| 2.0 * unit(seed, subject, question.wrapping_mul(3).wrapping_add(axis)) - 1.0;
    Vec3::new(at(0), at(1), at(2))
}

/// One of `0..count`; 0 of none.
pub(crate) fn below(count: usize, seed: u32, subject: u32, question: u32) -> usize {
    let pick = f64::from(unit(seed, subject, question))
        + f64::from(unit(seed, !subject, question)) / 16_777_216.0;
    ((pick * count as f64) as usize).min(count.saturating_sub(1))
}

/// Smooth noise of 0..1 over space, with one random height per unit cube's corner.
pub(crate) fn noise(seed: u32, place: Vec3) -> f32 {
    let cell = place.floor();
    let t = (place - cell).map(|t| smoothstep(0.0, 1.0, t));
    let at = cell.to_array().map(|side| side as i32);
    let height = |x: i32, y: i32, z: i32| {
        let row = mix_bits(at[1].wrapping_add(y) as u32 ^ mix_bits(at[2].wrapping_add(z) as u32));
        unit(seed, at[0].wrapping_add(x) as u32, row)
    };
    let along_x = |y, z| mix(height(0, y, z), height(1, y, z), t.x);
    let along_y = |z| mix(along_x(0, z), along_x(1, z), t.y);
    mix(along_y(0), along_y(1), t.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fill_their_range_evenly() {
        let mut bins = [0u32; 8];
        for subject in 0..8000 {
            bins[below(8, 3, subject, 1)] += 1;
        }
        assert!(
            bins.iter().all(|&bin| (850..1150).contains(&bin)),
            "{bins:?}"
        );
        assert_eq!(below(0, 1, 2, 3), 0);
    }

    #[test]
    fn noise_is_smooth_and_within_its_range() {
        for step in 0..2000 {
            let place = Vec3::new(step as f32 * 0.01 - 9.0, 0.3, -4.7);
            let (here, there) = (noise(1, place), noise(1, place + Vec3::X * 1e-3));
            assert!((0.0..=1.0).contains(&here) && (here - there).abs() < 4e-3);
        }
    }
}
