//! One moment of smoke on a grid: density, and where known velocity and temperature.

use glam::{DAffine3, DVec3, Mat3, Vec3};
use rayon::prelude::*;

use crate::lattice::Lattice;

/// Voxels that one side of a volume may have.
pub const MAX_SIDE: u32 = 32_767;

/// Why arrays do not make a volume.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VolumeError {
    /// A side is longer than [`MAX_SIDE`].
    #[error("a volume of {} voxels has a side of more than {MAX_SIDE}", size.map(|side| side.to_string()).join("x"))]
    TooLarge {
        /// Voxels along x, y and z as given.
        size: [u32; 3],
    },
    /// A list does not have one value per voxel.
    #[error("{what} has {found} values, but a volume of {size:?} voxels needs {expected}")]
    WrongCount {
        /// Which list: `density`, `velocity` or `temperature`.
        what: &'static str,
        /// Voxels along x, y and z.
        size: [u32; 3],
        /// How many values there are.
        found: usize,
        /// How many there must be.
        expected: usize,
    },
    /// The transform is not finite, or squeezes the volume flat.
    #[error("the volume's transform is flat or not finite")]
    BadTransform,
    /// Two volumes of one series differ in size or place.
    #[error("volumes of {first:?} and {second:?} voxels do not share one grid")]
    DifferentGrids {
        /// Size of the first volume.
        first: [u32; 3],
        /// Size of the second one, which may be equal where the transforms differ.
        second: [u32; 3],
    },
}

/// How many values were not usable and became 0, for a notice.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Mended {
    /// Densities that were NaN, infinite or negative.
    pub density: usize,
    /// Velocities with a component that was NaN or infinite.
    pub velocity: usize,
    /// Temperatures that were NaN or infinite.
    pub temperature: usize,
}

impl Mended {
    /// What became 0, for the user; none where every value was usable.
    pub fn notice(&self) -> Option<String> {
        let parts = [
            (self.density, "densities that are negative or no numbers"),
            (self.velocity, "velocities that are no numbers"),
            (self.temperature, "temperatures that are no numbers"),
        ];
        let reported = parts.iter().filter(|(count, _)| *count > 0);
        let reported: Vec<String> = reported
            .map(|(count, what)| format!("{count} {what}"))
            .collect();
        (!reported.is_empty()).then(|| format!("{} count as 0", reported.join(", ")))
    }
}

/// Smoke at one moment: a grid of voxels with a density each [Hoshino 2004, 3.1].
///
/// Lists hold x fastest, then y, then z. In *index space* the centre of voxel `(x, y, z)` lies at exactly `(x, y, z)`,
/// and its cube reaches half a unit to every side. Values between centres are trilinear; outside all cubes there is no
/// smoke and no motion. Densities above 1 stay as they are. A volume may be empty, with a side of 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
    size: [u32; 3],
    density: Vec<f32>,
    velocity: Option<Vec<Vec3>>,
    temperature: Option<Vec<f32>>,
    index_to_world: DAffine3,
    world_to_index: DAffine3,
    mended: Mended,
}

impl Volume {
    /// A volume of densities, without velocity and temperature.
    ///
    /// Densities that are NaN, infinite or negative become 0 and are counted in [`mended`](Self::mended). O(voxels).
    ///
    /// # Errors
    ///
    /// [`VolumeError`] for a list of the wrong length, a side over [`MAX_SIDE`], or a transform without an inverse.
    pub fn new(
        size: [u32; 3],
        mut density: Vec<f32>,
        index_to_world: DAffine3,
    ) -> Result<Self, VolumeError> {
        // Refuse lists that do not fit, and transforms that squeeze the volume flat.
        check_size(size)?;
        check_count("density", size, density.len())?;
        let world_to_index = inverse(index_to_world).ok_or(VolumeError::BadTransform)?;

        // Put no smoke where a density is no number.
        let mended = Mended {
            density: mend(&mut density, |d| d.is_finite() && *d >= 0.0),
            ..Mended::default()
        };
        Ok(Self {
            size,
            density,
            velocity: None,
            temperature: None,
            index_to_world,
            world_to_index,
            mended,
        })
    }

    /// The same volume with a velocity per voxel, in world units per second and along the world's axes.
    ///
    /// Velocities with a component that is not finite become 0 and are counted.
    ///
    /// # Errors
    ///
    /// [`VolumeError::WrongCount`] unless there is one velocity per voxel.
    pub fn with_velocity(mut self, mut velocity: Vec<Vec3>) -> Result<Self, VolumeError> {
        check_count("velocity", self.size, velocity.len())?;
        self.mended.velocity = mend(&mut velocity, |v| v.is_finite());
        self.velocity = Some(velocity);
        Ok(self)
    }

    /// The same volume with a temperature per voxel, in the units of its source.
    ///
    /// Temperatures that are not finite become 0 and are counted.
    ///
    /// # Errors
    ///
    /// [`VolumeError::WrongCount`] unless there is one temperature per voxel.
    pub fn with_temperature(mut self, mut temperature: Vec<f32>) -> Result<Self, VolumeError> {
        check_count("temperature", self.size, temperature.len())?;
        self.mended.temperature = mend(&mut temperature, |t| t.is_finite());
        self.temperature = Some(temperature);
        Ok(self)
    }

    /// Voxels along x, y and z.
    pub fn size(&self) -> [u32; 3] {
        self.size
    }

    /// Densities, x fastest.
    pub fn density(&self) -> &[f32] {
        &self.density
    }

    /// Velocities in world units per second, x fastest.
    pub fn velocity(&self) -> Option<&[Vec3]> {
        self.velocity.as_deref()
    }

    /// Temperatures, x fastest.
    pub fn temperature(&self) -> Option<&[f32]> {
        self.temperature.as_deref()
    }

    /// World from index space.
    pub fn index_to_world(&self) -> DAffine3 {
        self.index_to_world
    }

    /// How many values became 0 because they were not usable.
    pub fn mended(&self) -> Mended {
        self.mended
    }

    /// Whether there is no voxel at all.
    pub fn is_empty(&self) -> bool {
        self.density.is_empty()
    }

    /// The greatest density; 0 without any smoke.
    pub fn peak(&self) -> f32 {
        self.density
            .iter()
            .fold(0.0, |most, density| most.max(*density))
    }

    /// The greatest temperature; 0 where none is known or above 0.
    pub fn hottest(&self) -> f32 {
        let heats = self.temperature().unwrap_or_default();
        heats.iter().fold(0.0, |most, heat| most.max(*heat))
    }

    /// Number of voxels whose density is greater than `threshold`.
    pub fn dense_count(&self, threshold: f32) -> usize {
        let dense = self.density.par_iter().filter(|&&d| d > threshold);
        dense.count()
    }

    /// A place of index space in the world.
    pub fn world_from_index(&self, index: Vec3) -> Vec3 {
        self.index_to_world
            .transform_point3(index.as_dvec3())
            .as_vec3()
    }

    /// A place of the world in index space.
    pub fn index_from_world(&self, world: Vec3) -> Vec3 {
        self.world_to_index
            .transform_point3(world.as_dvec3())
            .as_vec3()
    }

    /// Turns motions in the world into motions in voxels.
    pub(crate) fn index_from_world_motion(&self) -> Mat3 {
        self.world_to_index.matrix3.as_mat3()
    }

    /// Radius in the world of the greatest ball inside one voxel's cube, doubled: the side of a cubic voxel.
    pub fn voxel_width(&self) -> f32 {
        let rows = self.world_to_index.matrix3.transpose();
        let widest = rows.x_axis.length().max(rows.y_axis.length());
        let width = 1.0 / widest.max(rows.z_axis.length());
        width.min(f64::from(f32::MAX)) as f32
    }

    /// Density at a place of index space.
    pub fn density_at(&self, index: Vec3) -> f32 {
        self.sample(&self.density, index)
    }

    /// Velocity at a place of index space, in world units per second; 0 where none is known.
    pub fn velocity_at(&self, index: Vec3) -> Vec3 {
        self.velocity()
            .map_or(Vec3::ZERO, |values| self.sample(values, index))
    }

    /// Temperature at a place of index space; 0 where none is known.
    pub fn temperature_at(&self, index: Vec3) -> f32 {
        self.temperature()
            .map_or(0.0, |values| self.sample(values, index))
    }

    /// The densities on a grid of `block * block * block` voxels each, in the same place of the world.
    ///
    /// A density is the mean over the voxels that there are in its block: holes and wisps thinner than a block
    /// vanish, and what is made from it is simpler. O(voxels), in parallel. Blocks of 0 count as 1.
    pub fn coarsened(&self, block: u32) -> Self {
        // Lay a coarse grid over the fine one.
        let block = block.clamp(1, MAX_SIDE);
        let fine = self.lattice();
        let size = self.size.map(|side| side.div_ceil(block));
        let coarse = Lattice {
            size: size.map(|side| side as usize),
        };

        // Take the mean density of each block.
        let density = coarse.map(|at| {
            let along = |axis: usize| {
                let start = at[axis] * block as usize;
                start..(start + block as usize).min(fine.size[axis])
            };
            let (mut sum, mut count) = (0.0, 0);
            for z in along(2) {
                for y in along(1) {
                    let row = &self.density[fine.index([0, y, z])..][along(0)];
                    sum += row.iter().sum::<f32>();
                    count += row.len();
                }
            }
            sum / count as f32
        });

        // Keep the smoke where it is in the world.
        let scale = DAffine3::from_scale(DVec3::splat(f64::from(block)));
        let shift = DAffine3::from_translation(DVec3::splat((f64::from(block) - 1.0) / 2.0));
        let index_to_world = self.index_to_world * shift * scale;
        Self {
            size,
            density,
            velocity: None,
            temperature: None,
            index_to_world,
            world_to_index: index_to_world.inverse(),
            mended: Mended::default(),
        }
    }

    /// The grid of the voxels.
    pub(crate) fn lattice(&self) -> Lattice {
        Lattice {
            size: self.size.map(|side| side as usize),
        }
    }

    /// Whether both lie on one grid, voxel on voxel.
    pub(crate) fn check_same_grid(&self, other: &Self) -> Result<(), VolumeError> {
        if self.size == other.size && self.index_to_world == other.index_to_world {
            return Ok(());
        }
        Err(VolumeError::DifferentGrids {
            first: self.size,
            second: other.size,
        })
    }

    /// Trilinear blend of `values`, nothing outside the voxels' cubes.
    fn sample<T>(&self, values: &[T], index: Vec3) -> T
    where
        T: Copy
            + Default
            + std::ops::Add<Output = T>
            + std::ops::Sub<Output = T>
            + std::ops::Mul<f32, Output = T>,
    {
        let lattice = self.lattice();
        if values.is_empty() || !lattice.holds(index) {
            return T::default();
        }
        lattice.cell(index).blend(|at| values[at])
    }
}

/// Refuses sides that are too long.
fn check_size(size: [u32; 3]) -> Result<(), VolumeError> {
    if size.iter().any(|&side| side > MAX_SIDE) {
        return Err(VolumeError::TooLarge { size });
    }
    Ok(())
}

/// Refuses a list that does not have a value per voxel.
fn check_count(what: &'static str, size: [u32; 3], found: usize) -> Result<(), VolumeError> {
    // Three sides of 15 bits fit easily.
    let expected = size.iter().map(|&side| side as usize).product();
    if found != expected {
        return Err(VolumeError::WrongCount {
            what,
            size,
            found,
            expected,
        });
    }
    Ok(())
}

/// Sets values that are not `usable` to 0 and counts them.
fn mend<T: Default + Send + Sync>(values: &mut [T], usable: impl Fn(&T) -> bool + Sync) -> usize {
    let unusable = values.par_iter_mut().filter(|value| !usable(value));
    unusable.map(|value| *value = T::default()).count()
}

/// The inverse of a transform that has one.
fn inverse(transform: DAffine3) -> Option<DAffine3> {
    let determinant = transform.matrix3.determinant();
    if !transform.is_finite() || determinant == 0.0 || !determinant.is_finite() {
        return None;
    }
    let inverse = transform.inverse();
    inverse.is_finite().then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn volume(density: Vec<f32>) -> Volume {
        Volume::new([2, 2, 2], density, DAffine3::IDENTITY).unwrap()
    }

    #[test]
    fn unusable_values_become_nothing_and_are_counted() {
        let (nan, inf) = (f32::NAN, f32::INFINITY);
        let mended = volume(vec![nan, inf, -1.0, 3.5, 0.5, 0.0, -0.0, 1.0]);
        assert_eq!(mended.mended().density, 3);
        assert_eq!(mended.density()[3], 3.5, "values above 1 are kept");
        assert_eq!(&mended.density()[..3], &[0.0; 3]);
        let speeds = mended
            .with_velocity(vec![Vec3::new(0.0, nan, 1.0); 8])
            .unwrap();
        assert_eq!(speeds.mended().velocity, 8);
        let hot = speeds
            .with_temperature(vec![inf, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, -7.0])
            .unwrap();
        assert_eq!(hot.mended().temperature, 1);
        assert_eq!(hot.temperature_at(Vec3::ONE), -7.0);
    }

    #[test]
    fn lists_of_the_wrong_length_are_refused() {
        let short = Volume::new([2, 2, 2], vec![0.0; 7], DAffine3::IDENTITY);
        assert_eq!(
            short.unwrap_err().to_string(),
            "density has 7 values, but a volume of [2, 2, 2] voxels needs 8"
        );
        assert!(volume(vec![0.0; 8]).with_velocity(vec![]).is_err());
        assert!(volume(vec![0.0; 8]).with_temperature(vec![0.0; 9]).is_err());
        let long = Volume::new([MAX_SIDE + 1, 0, 0], vec![], DAffine3::IDENTITY);
        assert!(matches!(long, Err(VolumeError::TooLarge { .. })));
    }

    #[test]
    fn transforms_without_an_inverse_are_refused() {
        for scale in [0.0, f64::NAN, f64::INFINITY, 1e-320] {
            let flat = DAffine3::from_scale(DVec3::new(1.0, scale, 1.0));
            assert_eq!(
                Volume::new([1, 1, 1], vec![1.0], flat),
                Err(VolumeError::BadTransform)
            );
        }
    }

    #[test]
    fn an_empty_volume_is_empty_everywhere() {
        let empty = Volume::new([0, 5, 5], vec![], DAffine3::IDENTITY).unwrap();
        assert!(empty.is_empty());
        assert_eq!(empty.density_at(Vec3::ZERO), 0.0);
        assert_eq!(empty.velocity_at(Vec3::ZERO), Vec3::ZERO);
        assert_eq!(empty.dense_count(0.0), 0);
    }

    #[test]
    fn smoke_ends_half_a_voxel_beyond_the_last_centre() {
        let full = volume(vec![1.0; 8]);
        assert_eq!(full.density_at(Vec3::new(-0.5, 1.5, 0.0)), 1.0);
        assert_eq!(full.density_at(Vec3::new(-0.51, 0.0, 0.0)), 0.0);
        assert_eq!(full.density_at(Vec3::NAN), 0.0);
    }

    #[test]
    fn a_coarse_volume_lies_where_the_fine_one_does() {
        let fine = crate::testing::blob([7, 6, 9], DAffine3::from_scale(DVec3::splat(0.5)));
        let coarse = fine.coarsened(3);
        assert_eq!(coarse.size(), [3, 2, 3]);
        assert_eq!(coarse.voxel_width(), 1.5);
        let corner = coarse.world_from_index(Vec3::splat(-0.5));
        assert!(corner.distance(fine.world_from_index(Vec3::splat(-0.5))) < 1e-6);
        // The last block along x holds one voxel only.
        let voxels = (0..9).map(|at| 6 + 7 * (at % 3 + 6 * (at / 3)));
        let mean = voxels.map(|at| fine.density()[at]).sum::<f32>() / 9.0;
        assert!((coarse.density()[2] - mean).abs() < 1e-6);
        assert_eq!(fine.coarsened(0).density(), fine.density());
        assert_eq!(fine.coarsened(u32::MAX).size(), [1, 1, 1]);
    }

    #[test]
    fn a_voxel_is_as_wide_as_its_narrowest_side() {
        let placed = DAffine3::from_scale_rotation_translation(
            DVec3::new(0.5, 2.0, 3.0),
            glam::DQuat::from_rotation_x(0.7),
            DVec3::splat(9.0),
        );
        let volume = Volume::new([1, 1, 1], vec![1.0], placed).unwrap();
        assert!((volume.voxel_width() - 0.5).abs() < 1e-6);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn world_and_index_space_lead_back_to_each_other(
            scale in 0.01f64..100.0, turn in -3.0f64..3.0, shift in -50.0f64..50.0,
            place in prop::array::uniform3(0.0f32..20.0),
        ) {
            let transform = DAffine3::from_scale_rotation_translation(
                DVec3::splat(scale), glam::DQuat::from_rotation_z(turn), DVec3::splat(shift));
            let volume = Volume::new([1, 1, 1], vec![0.0], transform).unwrap();
            let place = Vec3::from(place);
            let back = volume.index_from_world(volume.world_from_index(place));
            prop_assert!(back.distance(place) < 1e-2 * (1.0 + (shift / scale).abs() as f32 * 1e-4));
        }

        #[test]
        fn samples_stay_between_the_least_and_the_greatest_value(
            values in prop::collection::vec(0.0f32..9.0, 8),
            place in prop::array::uniform3(-0.5f32..1.5),
        ) {
            let (least, greatest) = values.iter().fold((9.0f32, 0.0f32), |(a, b), &v| (a.min(v), b.max(v)));
            let sample = volume(values.clone()).density_at(Vec3::from(place));
            prop_assert!(sample >= least - 1e-5 && sample <= greatest + 1e-5);
        }
    }
}
