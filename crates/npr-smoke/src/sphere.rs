//! The spheres that stand for smoke, and how much of it they cover.

use std::ops::RangeInclusive;

use glam::Vec3;
use rayon::prelude::*;

use crate::lattice::Lattice;
use crate::{Distances, Particle, Volume};

/// One ball of smoke, ready to be drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Centre in the world.
    pub center: Vec3,
    /// Radius in world units, greater than 0.
    pub radius: f32,
    /// The same from frame to frame as long as the sphere lives; no two living spheres share one.
    pub id: u32,
    /// Frames since birth.
    pub age: u32,
    /// Temperature of the smoke at the centre, in the units of the volume; 0 where none is known.
    pub temperature: f32,
}

/// A sphere round every living particle, as large as the smoke allows [Hoshino 2004, 3.1].
///
/// The radius is [half the side](Distances::half_side) of the growing box round the particle. Order is that of the
/// particles. O(particles x squares of their boxes' half sides in voxels), in parallel.
pub fn around_particles(
    particles: &[Particle],
    volume: &Volume,
    distances: &Distances,
) -> Vec<Sphere> {
    let width = volume.voxel_width();
    let around = |particle: &Particle| {
        let index = volume.index_from_world(particle.place);
        let radius = distances.half_side(index) * width;
        let is_seen = particle.alive && radius > 0.0 && radius.is_finite();
        is_seen.then(|| Sphere {
            center: particle.place,
            radius,
            id: particle.id,
            age: particle.age,
            temperature: volume.temperature_at(index),
        })
    };
    particles.par_iter().filter_map(around).collect()
}

/// Share of the dense voxels whose centre lies inside a sphere, 0 to 1; 1 where nothing is dense.
///
/// O(voxels + volume of all spheres in voxels). Spheres that are not finite cover nothing.
pub fn covered_share(spheres: &[Sphere], volume: &Volume, distances: &Distances) -> f32 {
    let dense = distances.dense_count();
    if dense == 0 {
        return 1.0;
    }

    // Sort the spheres by the planes that they may touch.
    let lattice = volume.lattice();
    let [_, height, depth] = lattice.size;
    let planes = touches_by_plane(spheres, volume, depth);

    // Count the dense voxels inside spheres, plane by plane.
    let covered_in = |(z, touches): (usize, &Vec<Touch>)| {
        let mut inside = vec![false; lattice.size[0] * height];
        for touch in touches {
            mark_plane(touch, volume, lattice, z, &mut inside);
        }
        let is_dense = |at: usize| {
            let [x, y, _] = lattice.point(at);
            distances.at([x as u32, y as u32, z as u32]) > 0
        };
        (0..inside.len())
            .filter(|&at| inside[at] && is_dense(at))
            .count()
    };
    let covered: usize = planes.par_iter().enumerate().map(covered_in).sum();
    (covered as f64 / dense as f64) as f32
}

/// A sphere that may touch a plane of equal z, and the voxels that it may reach there.
#[derive(Clone)]
struct Touch {
    sphere: Sphere,
    along_x: RangeInclusive<usize>,
    along_y: RangeInclusive<usize>,
}

/// For each plane of equal z the spheres that may touch it.
fn touches_by_plane(spheres: &[Sphere], volume: &Volume, depth: usize) -> Vec<Vec<Touch>> {
    let mut planes = vec![Vec::new(); depth];
    for &sphere in spheres {
        if let Some([along_x, along_y, along_z]) = index_bounds(&sphere, volume) {
            let touch = Touch {
                sphere,
                along_x,
                along_y,
            };
            for plane in &mut planes[along_z] {
                plane.push(touch.clone());
            }
        }
    }
    planes
}

/// Voxels that a sphere may reach, along each axis.
fn index_bounds(sphere: &Sphere, volume: &Volume) -> Option<[RangeInclusive<usize>; 3]> {
    let Sphere { center, radius, .. } = *sphere;
    if !center.is_finite() || !radius.is_finite() || radius <= 0.0 {
        return None;
    }
    // An ellipsoid's reach along an axis of index space is the length of that row of the transform.
    let rows = volume.index_to_world().matrix3.inverse().transpose();
    let reach = Vec3::new(
        rows.x_axis.length() as f32,
        rows.y_axis.length() as f32,
        rows.z_axis.length() as f32,
    ) * radius;
    let middle = volume.index_from_world(center);
    let last = Vec3::from_array(volume.size().map(|side| side as f32 - 1.0));
    let (low, high) = (middle - reach, middle + reach);
    let touches = high.cmpge(Vec3::ZERO).all() && low.cmple(last).all();
    let low = low.max(Vec3::ZERO).min(last).floor();
    let high = high.max(Vec3::ZERO).min(last).ceil();
    touches.then(|| [0, 1, 2].map(|axis| low[axis] as usize..=high[axis] as usize))
}

/// Marks the voxels of one plane whose centres lie inside a sphere.
fn mark_plane(touch: &Touch, volume: &Volume, lattice: Lattice, z: usize, inside: &mut [bool]) {
    let Sphere { center, radius, .. } = touch.sphere;
    for y in touch.along_y.clone() {
        for x in touch.along_x.clone() {
            let centre = volume.world_from_index(Vec3::new(x as f32, y as f32, z as f32));
            if centre.distance_squared(center) <= radius * radius {
                inside[lattice.index([x, y, 0])] = true;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{blob, in_pool};
    use glam::{DAffine3, DQuat, DVec3};
    use proptest::prelude::*;

    fn sphere(center: Vec3, radius: f32) -> Sphere {
        Sphere {
            center,
            radius,
            id: 0,
            age: 0,
            temperature: 0.0,
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn the_covered_share_is_what_counting_every_voxel_says(
            places in prop::collection::vec((prop::array::uniform3(-3.0f32..9.0), 0.0f32..4.0), 0..6),
            turn in 0.0f64..1.0, stretch in 0.5f64..2.0,
        ) {
            let transform = DAffine3::from_scale_rotation_translation(
                DVec3::new(1.0, stretch, 1.0), DQuat::from_rotation_y(turn), DVec3::new(0.5, 0.0, -1.0));
            let volume = blob([7, 6, 5], transform);
            let distances = Distances::new(&volume, 0.5);
            let spheres: Vec<_> = places.iter().map(|&(c, r)| sphere(Vec3::from(c), r)).collect();
            let mut covered = 0;
            for at in 0..volume.density().len() {
                let [x, y, z] = volume.lattice().point(at).map(|side| side as f32);
                let centre = volume.world_from_index(Vec3::new(x, y, z));
                let inside = spheres.iter().any(|s| centre.distance_squared(s.center) <= s.radius * s.radius);
                covered += usize::from(volume.density()[at] > 0.5 && inside && spheres.iter().any(|s| s.radius > 0.0));
            }
            let expected = covered as f32 / volume.dense_count(0.5) as f32;
            prop_assert!((covered_share(&spheres, &volume, &distances) - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn spheres_without_a_place_cover_nothing() {
        let volume = blob([6, 6, 6], DAffine3::IDENTITY);
        let distances = Distances::new(&volume, 0.5);
        let odd = [
            sphere(Vec3::NAN, 1.0),
            sphere(Vec3::ZERO, f32::INFINITY),
            sphere(Vec3::ONE, -1.0),
            sphere(Vec3::splat(f32::MAX), 1.0),
        ];
        assert_eq!(covered_share(&odd, &volume, &distances), 0.0);
        assert_eq!(covered_share(&[], &volume, &distances), 0.0);
        let everything = [sphere(Vec3::splat(3.0), 1e9)];
        let share = in_pool(2, || covered_share(&everything, &volume, &distances));
        assert_eq!(share, 1.0);
    }
}
