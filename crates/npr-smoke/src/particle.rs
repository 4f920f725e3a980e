//! Particles that the smoke carries along [Hoshino 2004, 3.1].

use glam::Vec3;
use rayon::prelude::*;

use crate::Volume;
use crate::random::{below, signed3};

/// Where particles are born.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Birthplace {
    /// In any dense voxel.
    Anywhere,
    /// In dense voxels whose centre lies in a ball; in any dense voxel while the ball holds none.
    Emitter {
        /// Centre of the ball in the world.
        center: Vec3,
        /// Its radius in world units.
        radius: f32,
    },
}

/// How particles live.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParticleSettings {
    /// How many there are, always. Few make simple shapes, as drawn by hand; many make details.
    pub count: u32,
    /// Density from which on a voxel is dense: particles are born there, and die where the density falls below.
    pub threshold: f32,
    /// Seconds from one frame to the next.
    pub frame_seconds: f32,
    /// Speed, in world units per second, up to which a particle counts as still and dies. 0, as in the paper, is
    /// reached exactly only where no motion was recorded.
    pub still: f32,
    /// Where they are born.
    pub birthplace: Birthplace,
    /// Other seeds give other, equally likely particles.
    pub seed: u32,
}

impl Default for ParticleSettings {
    fn default() -> Self {
        Self {
            count: 200,
            threshold: 0.1,
            frame_seconds: 1.0 / 24.0,
            still: 0.0,
            birthplace: Birthplace::Anywhere,
            seed: 0,
        }
    }
}

/// A point that the smoke carries along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Particle {
    /// Where it is in the world.
    pub place: Vec3,
    /// How fast it goes, in world units per second.
    pub velocity: Vec3,
    /// The same as long as it lives; no two living particles share one.
    pub id: u32,
    /// Frames since birth.
    pub age: u32,
    /// How many lived in its slot before it.
    pub life: u32,
    /// Not alive while no voxel is dense: it waits to be born.
    pub alive: bool,
}

/// A constant number of particles that move, die and are born anew, frame by frame.
///
/// The life of each is its own: it depends on the seed, on its slot and on the volumes, never on other particles or
/// on the number of threads. Randomness comes from a counter-based hash.
#[derive(Debug, Clone, PartialEq)]
pub struct Particles {
    settings: ParticleSettings,
    list: Vec<Particle>,
}

impl Particles {
    /// Particles at random places in the dense voxels of the first frame.
    ///
    /// O(voxels + particles), in parallel.
    pub fn new(volume: &Volume, settings: ParticleSettings) -> Self {
        let homes = Homes::new(volume, &settings);
        let birth = |slot: u32| homes.birth(volume, &settings, slot, 0);
        let list = (0..settings.count).into_par_iter().map(birth);
        Self {
            list: list.collect(),
            settings,
        }
    }

    /// How they live.
    pub fn settings(&self) -> &ParticleSettings {
        &self.settings
    }

    /// The particles, by slot.
    pub fn list(&self) -> &[Particle] {
        &self.list
    }

    /// Moves every particle by its velocity for one frame; then it takes the velocity that `next` has there.
    ///
    /// Where that velocity is zero, or the density is below the threshold, it dies, and another is born in its slot.
    /// O(voxels + particles), in parallel.
    pub fn step(&mut self, next: &Volume) {
        let settings = &self.settings;
        let homes = Homes::new(next, settings);
        self.list
            .par_iter_mut()
            .enumerate()
            .for_each(|(slot, particle)| {
                // Move the particle and take the velocity of its new place.
                particle.place += particle.velocity * settings.frame_seconds;
                let index = next.index_from_world(particle.place);
                particle.velocity = next.velocity_at(index);

                // Let it grow older, or die and be born again elsewhere.
                let moves = particle.velocity.length() > settings.still;
                let dense =
                    next.density_at(index) >= settings.threshold && next.lattice().holds(index);
                if particle.alive && moves && dense {
                    particle.age += 1;
                } else {
                    *particle =
                        homes.birth(next, settings, slot as u32, particle.life.wrapping_add(1));
                }
            });
    }
}

/// The voxels in which particles may be born.
struct Homes {
    voxels: Vec<u32>,
}

impl Homes {
    /// Dense voxels at the birthplace, in grid order.
    fn new(volume: &Volume, settings: &ParticleSettings) -> Self {
        let lattice = volume.lattice();
        let is_dense = |at: &u32| volume.density()[*at as usize] >= settings.threshold;
        let count = u32::try_from(volume.density().len()).unwrap_or(u32::MAX);
        let dense: Vec<u32> = (0..count).into_par_iter().filter(is_dense).collect();
        let Birthplace::Emitter { center, radius } = settings.birthplace else {
            return Self { voxels: dense };
        };
        let is_near = |at: &u32| {
            let [x, y, z] = lattice.point(*at as usize).map(|side| side as f32);
            volume.world_from_index(Vec3::new(x, y, z)).distance(center) <= radius
        };
        let near: Vec<u32> = dense.par_iter().copied().filter(is_near).collect();
        Self {
            voxels: if near.is_empty() { dense } else { near },
        }
    }

    /// A new particle somewhere in a voxel picked at random; one that waits where there is no voxel.
    fn birth(
        &self,
        volume: &Volume,
        settings: &ParticleSettings,
        slot: u32,
        life: u32,
    ) -> Particle {
        // Pick a place within one of the voxels where particles may be born.
        let id = life.wrapping_mul(settings.count).wrapping_add(slot);
        let pick = below(self.voxels.len(), settings.seed, slot, life.wrapping_mul(2));
        let voxel = self.voxels.get(pick);
        let index = voxel.map_or(Vec3::ZERO, |&at| {
            let [x, y, z] = volume.lattice().point(at as usize).map(|side| side as f32);
            let away = 0.499 * signed3(settings.seed, slot, life.wrapping_mul(2).wrapping_add(1));
            Vec3::new(x, y, z) + away
        });

        // Start there with the velocity of the smoke.
        Particle {
            place: volume.world_from_index(index),
            velocity: volume.velocity_at(index),
            id,
            age: 0,
            life,
            alive: voxel.is_some(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{blob, in_pool};
    use glam::{DAffine3, DVec3};
    use proptest::prelude::*;

    fn windy(size: [u32; 3], velocity: Vec3) -> Volume {
        let volume = blob(size, DAffine3::from_scale(DVec3::splat(0.5)));
        let count = volume.density().len();
        volume.with_velocity(vec![velocity; count]).unwrap()
    }

    #[test]
    fn a_particle_moves_one_frame_along_its_velocity_then_takes_the_next_frames() {
        let (first, second) = (windy([9, 9, 9], Vec3::X), windy([9, 9, 9], Vec3::Y));
        let settings = ParticleSettings {
            count: 50,
            threshold: 0.2,
            ..Default::default()
        };
        let mut particles = Particles::new(&first, settings);
        let before = particles.list().to_vec();
        particles.step(&second);
        let mut moved = 0;
        for (before, after) in before.iter().zip(particles.list()) {
            assert_eq!(after.velocity, Vec3::Y);
            if after.life == 0 {
                assert_eq!(after.place, before.place + Vec3::X / 24.0);
                assert_eq!((after.age, after.id), (1, before.id));
                moved += 1;
            }
        }
        assert!(moved > 25);
    }

    #[test]
    fn still_particles_die_and_the_count_stays() {
        let still = windy([9, 9, 9], Vec3::ZERO);
        let mut particles = Particles::new(&still, ParticleSettings::default());
        for frame in 1..5 {
            particles.step(&still);
            assert_eq!(particles.list().len(), 200);
            assert!(
                particles
                    .list()
                    .iter()
                    .all(|p| p.alive && p.life == frame && p.age == 0)
            );
        }
    }

    #[test]
    fn particles_are_born_at_the_emitter_while_it_smokes() {
        let volume = windy([12, 12, 12], Vec3::X);
        let center = volume.world_from_index(Vec3::splat(5.5));
        let at = |birthplace| {
            let settings = ParticleSettings {
                birthplace,
                threshold: 0.3,
                ..Default::default()
            };
            Particles::new(&volume, settings)
        };
        let near = at(Birthplace::Emitter {
            center,
            radius: 1.0,
        });
        assert!(
            near.list()
                .iter()
                .all(|p| p.place.distance(center) < 1.0 + 0.5)
        );
        let far = at(Birthplace::Emitter {
            center: Vec3::splat(99.0),
            radius: 1.0,
        });
        assert_eq!(far.list(), at(Birthplace::Anywhere).list());
    }

    #[test]
    fn particles_wait_while_nothing_is_dense() {
        let smoke = windy([6, 6, 6], Vec3::X);
        let nothing = Volume::new([0, 0, 0], vec![], DAffine3::IDENTITY).unwrap();
        let mut particles = Particles::new(&nothing, ParticleSettings::default());
        assert!(particles.list().iter().all(|p| !p.alive));
        particles.step(&smoke);
        assert!(particles.list().iter().all(|p| p.alive));
        particles.step(&nothing);
        assert!(particles.list().iter().all(|p| !p.alive));
    }

    #[test]
    fn lives_do_not_depend_on_the_threads() {
        let volume = windy([40, 40, 40], Vec3::new(3.0, 1.0, 0.0));
        let run = |threads| {
            in_pool(threads, || {
                let mut particles = Particles::new(&volume, ParticleSettings::default());
                (0..20).for_each(|_| particles.step(&volume));
                particles
            })
        };
        assert_eq!(run(1), run(2));
        assert_eq!(run(1), run(8));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn the_living_are_in_dense_places_and_have_ids_of_their_own(
            seed: u32, count in 0u32..40, threshold in 0.01f32..1.0,
            velocity in prop::array::uniform3(-20.0f32..20.0),
        ) {
            let volume = windy([5, 6, 7], Vec3::from(velocity));
            let settings = ParticleSettings { count, threshold, seed, ..Default::default() };
            let mut particles = Particles::new(&volume, settings);
            for _ in 0..3 {
                particles.step(&volume);
                let living: Vec<_> = particles.list().iter().filter(|p| p.alive).collect();
                for particle in &living {
                    // A newborn lies in a dense voxel, an older one where the blended density is high enough.
                    let index = volume.index_from_world(particle.place);
                    let voxel = volume.density_at(index.round());
                    prop_assert!(voxel.max(volume.density_at(index)) >= threshold * 0.999);
                }
                let mut ids: Vec<_> = living.iter().map(|p| p.id).collect();
                ids.sort_unstable();
                ids.dedup();
                prop_assert_eq!(ids.len(), living.len());
            }
        }

        #[test]
        fn odd_settings_and_speeds_do_no_harm(
            threshold in prop::num::f32::ANY, frame_seconds in prop::num::f32::ANY,
            still in prop::num::f32::ANY, speed in prop::num::f32::ANY, radius in prop::num::f32::ANY,
        ) {
            let volume = windy([4, 4, 4], Vec3::new(speed, 1.0, 0.0));
            let birthplace = Birthplace::Emitter { center: Vec3::splat(speed), radius };
            let settings = ParticleSettings { count: 9, threshold, frame_seconds, still, birthplace, seed: 1 };
            let mut particles = Particles::new(&volume, settings);
            for _ in 0..3 {
                particles.step(&volume);
            }
            prop_assert_eq!(particles.list().len(), 9);
        }
    }
}
