//! Motion between two moments of smoke: estimated from densities, and used to blend between frames.

use glam::Vec3;

use crate::lattice::{Lattice, greatest};
use crate::{Volume, VolumeError};

/// How much smoothness weighs against following the densities, in units of density per voxel squared.
///
/// Smaller follows every flicker of the smoke, larger makes it one stiff lump.
const SMOOTHNESS: f32 = 0.05;

/// Times the linearised motion is corrected on each level.
const WARPS: usize = 4;

/// Sweeps per correction. Motion spreads a voxel per sweep, and coarser levels have spread it before.
const SWEEPS: usize = 24;

/// Sides from which on a level is halved no more.
const COARSEST: usize = 6;

/// Velocity of the smoke of `before`, in world units per second, estimated from where its densities are `seconds`
/// later.
///
/// For volumes that bring none. Optical flow in three dimensions: the smoothest motion that carries one density into
/// the other [Horn & Schunck 1981], from coarse grids to fine, each level warped by the motion found so far. Where
/// there is no smoke nearby the motion is that of the nearest smoke, faded by smoothing. One density cannot tell
/// motion along its level sets: flow inside even smoke is a guess.
///
/// O(voxels), about 110 sweeps over the grid, 60 bytes a voxel; the same bits for any number of threads.
///
/// # Errors
///
/// [`VolumeError::DifferentGrids`] unless both volumes lie on one grid.
pub fn estimate_velocity(
    before: &Volume,
    after: &Volume,
    seconds: f32,
) -> Result<Vec<Vec3>, VolumeError> {
    before.check_same_grid(after)?;

    // Scale densities to 1 at their peak; without smoke nothing moves.
    let count = before.density().len();
    let peak = |volume: &Volume| greatest(count, |at| volume.density()[at]);
    let unit = 1.0 / peak(before).max(peak(after));
    if count == 0 || !unit.is_finite() || seconds.is_nan() || seconds <= 0.0 {
        return Ok(vec![Vec3::ZERO; count]);
    }
    let scaled = |volume: &Volume| Level {
        lattice: volume.lattice(),
        values: volume.density().iter().map(|d| d * unit).collect(),
    };

    // Find the motion in voxels, and turn it into velocities in the world.
    let voxels_moved = flow(&scaled(before), &scaled(after));
    let to_world = before.index_to_world().matrix3.as_mat3() * (1.0 / seconds);
    let velocity = |v: &Vec3| {
        let velocity = to_world * *v;
        if velocity.is_finite() {
            velocity
        } else {
            Vec3::ZERO
        }
    };
    Ok(voxels_moved.iter().map(velocity).collect())
}

/// The smoke at a share `t` of the way, 0 to 1, from `before` to `after`, which is `seconds` later.
///
/// Each of both is carried to that moment along its own velocities, then they are blended; without velocities they are
/// blended where they are, and fast smoke shows twice: [estimate](estimate_velocity) them first. At 0 and 1 the
/// densities are exactly those given. Velocity and temperature are there if both volumes have them. O(voxels).
///
/// # Errors
///
/// [`VolumeError::DifferentGrids`] unless both volumes lie on one grid.
pub fn between(
    before: &Volume,
    after: &Volume,
    t: f32,
    seconds: f32,
) -> Result<Volume, VolumeError> {
    before.check_same_grid(after)?;
    let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
    let lattice = before.lattice();
    let to_index = before.index_from_world_motion();
    let sources = |at: [usize; 3]| {
        let place = Vec3::from_array(at.map(|side| side as f32));
        let moved = |volume: &Volume, seconds: f32| {
            let away = to_index * volume.velocity_at(place) * seconds;
            // Smoke that comes from nowhere stays where it is.
            place + if away.is_finite() { away } else { Vec3::ZERO }
        };
        (
            moved(before, -t * seconds),
            moved(after, (1.0 - t) * seconds),
        )
    };
    let blend = |of: fn(&Volume, Vec3) -> f32| {
        lattice.map(|at| {
            let (from_before, from_after) = sources(at);
            npr_core::math::mix(of(before, from_before), of(after, from_after), t)
        })
    };
    let mut volume = Volume::new(
        before.size(),
        blend(Volume::density_at),
        before.index_to_world(),
    )?;
    if before.temperature().is_some() && after.temperature().is_some() {
        volume = volume.with_temperature(blend(Volume::temperature_at))?;
    }
    if before.velocity().is_some() && after.velocity().is_some() {
        volume = volume.with_velocity(lattice.map(|at| {
            let (from_before, from_after) = sources(at);
            before.velocity_at(from_before) * (1.0 - t) + after.velocity_at(from_after) * t
        }))?;
    }
    Ok(volume)
}

/// One level of a pyramid of densities.
struct Level {
    lattice: Lattice,
    values: Vec<f32>,
}

impl Level {
    /// The blended value at a place, which is moved onto the grid.
    fn at(&self, place: Vec3) -> f32 {
        self.lattice.cell(place).blend(|at| self.values[at])
    }

    /// Half as many voxels along each axis, each the mean of eight.
    fn halved(&self) -> Self {
        let lattice = Lattice {
            size: self.lattice.size.map(|side| side.div_ceil(2)),
        };
        let mean = |at: [usize; 3]| self.at(Vec3::from_array(at.map(|v| 2.0 * v as f32 + 0.5)));
        Self {
            values: lattice.map(mean),
            lattice,
        }
    }

    /// Central differences, one-sided at the border.
    fn gradient(&self, at: [usize; 3]) -> Vec3 {
        let middle = self.lattice.index(at);
        let strides = self.lattice.strides();
        Vec3::from_array(std::array::from_fn(|axis| {
            let high = usize::from(at[axis] + 1 < self.lattice.size[axis]);
            let low = usize::from(at[axis] > 0);
            let rise = self.values[middle + high * strides[axis]]
                - self.values[middle - low * strides[axis]];
            rise / (high + low).max(1) as f32
        }))
    }
}

/// Motion in voxels that carries `before` to `after`.
fn flow(before: &Level, after: &Level) -> Vec<Vec3> {
    let lattice = before.lattice;
    let start = if lattice.size.iter().all(|&side| side <= COARSEST) {
        vec![Vec3::ZERO; lattice.len()]
    } else {
        let (small_before, small_after) = (before.halved(), after.halved());
        let coarse = flow(&small_before, &small_after);
        lattice.map(|at| {
            let place = Vec3::from_array(at.map(|v| (v as f32 - 0.5) / 2.0));
            2.0 * small_before.lattice.cell(place).blend(|at| coarse[at])
        })
    };
    (0..WARPS).fold(start, |motion, _| correct(before, after, motion))
}

/// A better motion: linearises the change round `start`, then spreads it by sweeps of Jacobi.
fn correct(before: &Level, after: &Level, start: Vec<Vec3>) -> Vec<Vec3> {
    // Carry the later densities back along the motion found so far.
    let lattice = before.lattice;
    let place = |at: [usize; 3]| Vec3::from_array(at.map(|v| v as f32));
    let warped = Level {
        lattice,
        values: lattice.map(|at| after.at(place(at) + start[lattice.index(at)])),
    };

    // Spread the motion that explains what still differs.
    let slopes = lattice.map(|at| 0.5 * (before.gradient(at) + warped.gradient(at)));
    let mut motion = start.clone();
    let mut next = start.clone();
    for _ in 0..SWEEPS {
        lattice.fill(&mut next, |at| {
            let index = lattice.index(at);
            let (mean, slope) = (mean_of_neighbours(lattice, &motion, at), slopes[index]);
            let change = warped.values[index] - before.values[index];
            let excess = change + slope.dot(mean - start[index]);
            mean - slope * (excess / (SMOOTHNESS + slope.length_squared()))
        });
        std::mem::swap(&mut motion, &mut next);
    }
    motion
}

/// Mean over the six neighbours, those outside the grid replaced by the voxel itself.
fn mean_of_neighbours(lattice: Lattice, values: &[Vec3], at: [usize; 3]) -> Vec3 {
    let middle = lattice.index(at);
    let strides = lattice.strides();
    let pair = |axis: usize| {
        let high = usize::from(at[axis] + 1 < lattice.size[axis]);
        let low = usize::from(at[axis] > 0);
        values[middle + high * strides[axis]] + values[middle - low * strides[axis]]
    };
    (pair(0) + pair(1) + pair(2)) * (1.0 / 6.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{blob, in_pool};
    use glam::{DAffine3, DVec3};
    use proptest::prelude::*;

    fn lump(middle: Vec3, transform: DAffine3) -> Volume {
        let lattice = Lattice::new(20, 18, 22);
        let density = lattice.map(|at| {
            // Its radius keeps it within the lattice wherever it moves: one that is cut off seems to go farther.
            let away = (Vec3::from_array(at.map(|v| v as f32)) - middle).length() / 5.5;
            (1.0 - away * away).max(0.0)
        });
        Volume::new([20, 18, 22], density, transform).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn a_lump_that_moves_is_seen_to_move(shift in prop::array::uniform3(-3.0f32..3.0)) {
            let shift = Vec3::from(shift);
            let transform = DAffine3::from_scale(DVec3::splat(0.5));
            let middle = Vec3::new(9.5, 8.5, 10.5);
            let (before, after) = (lump(middle, transform), lump(middle + shift, transform));
            let velocity = estimate_velocity(&before, &after, 0.1).unwrap();
            let dense = before.density().iter().zip(&velocity).filter(|(d, _)| **d > 0.3);
            let (count, sum) = dense.fold((0.0, Vec3::ZERO), |(n, sum), (_, v)| (n + 1.0, sum + *v));
            // Half a unit per voxel, a tenth of a second.
            let expected = shift * 5.0;
            // Six hundredths of the way, and no less than a tenth of a voxel.
            let most = (0.06 * shift.length()).max(0.1) * 5.0;
            prop_assert!((sum / count).distance(expected) < most, "{} for {}", sum / count, expected);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn any_two_volumes_have_a_finite_motion_and_blend(
            size in prop::array::uniform3(0u32..5), seed: u32, t in prop::num::f32::ANY, seconds in prop::num::f32::ANY,
        ) {
            let count = size.iter().product::<u32>();
            let noisy = |stream: u32| {
                let density = (0..count).map(|at| crate::random::unit(seed, at, stream) * 10.0).collect();
                Volume::new(size, density, DAffine3::IDENTITY).unwrap()
            };
            let (before, after) = (noisy(0), noisy(1));
            let velocity = estimate_velocity(&before, &after, seconds).unwrap();
            prop_assert!(velocity.iter().all(|v| v.is_finite()));
            let moving = before.with_velocity(velocity).unwrap();
            let blend = between(&moving, &after, t, seconds).unwrap();
            prop_assert_eq!(blend.mended().density, 0);
        }
    }

    #[test]
    fn the_middle_of_a_motion_shows_one_lump_half_way() {
        let shift = Vec3::new(6.0, 0.0, 0.0);
        let middle = Vec3::new(6.5, 8.5, 10.5);
        let with_motion = |middle| {
            let volume = lump(middle, DAffine3::IDENTITY);
            let count = volume.density().len();
            volume.with_velocity(vec![shift; count]).unwrap()
        };
        let (before, after) = (with_motion(middle), with_motion(middle + shift));
        let half = between(&before, &after, 0.5, 1.0).unwrap();
        let expected = lump(middle + shift / 2.0, DAffine3::IDENTITY);
        for (found, expected) in half.density().iter().zip(expected.density()) {
            assert!((found - expected).abs() < 1e-4);
        }
        assert_eq!(
            between(&before, &after, 0.0, 1.0).unwrap().density(),
            before.density()
        );
        assert_eq!(
            between(&before, &after, 1.0, 1.0).unwrap().density(),
            after.density()
        );
    }

    #[test]
    fn volumes_on_different_grids_do_not_mix() {
        let (small, large) = (
            blob([4, 4, 4], DAffine3::IDENTITY),
            blob([4, 4, 5], DAffine3::IDENTITY),
        );
        assert!(estimate_velocity(&small, &large, 1.0).is_err());
        let shifted = blob([4, 4, 4], DAffine3::from_translation(DVec3::X));
        assert!(between(&small, &shifted, 0.5, 1.0).is_err());
    }

    #[test]
    fn motion_does_not_depend_on_the_threads() {
        let (before, after) = (
            lump(Vec3::splat(8.0), DAffine3::IDENTITY),
            lump(Vec3::splat(9.0), DAffine3::IDENTITY),
        );
        let of = |threads| in_pool(threads, || estimate_velocity(&before, &after, 1.0));
        assert_eq!(of(1), of(8));
    }
}
