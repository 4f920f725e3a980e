//! The spheres of a series of volumes, by either method: ours or the published one.

use crate::sphere::around_particles;
use crate::{Distances, ParticleSettings, Particles, Sphere, Track, TrackSettings, Volume};

/// Which spheres stand for smoke, and how they follow it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PuffSettings {
    /// Few spheres that never pop.
    Cover(TrackSettings),
    /// A constant number of particles that are born and die, each with the radius of its growing box [Hoshino 2004,
    /// 3.1].
    Published(ParticleSettings),
}

impl PuffSettings {
    /// Most spheres of a frame.
    pub fn count(&self) -> u32 {
        match self {
            Self::Cover(settings) => settings.count,
            Self::Published(settings) => settings.count,
        }
    }
}

/// Spheres that follow smoke from frame to frame.
#[derive(Debug, Clone)]
pub enum Puffs {
    /// Few spheres that never pop.
    Cover(Track),
    /// Particles as published.
    Published(Swarm),
}

impl Puffs {
    /// Spheres for the first volume of a series. Costs what [`Track::new`] or [`Particles::new`] does.
    pub fn new(volume: &Volume, settings: PuffSettings) -> Self {
        match settings {
            PuffSettings::Cover(settings) => Self::Cover(Track::new(volume, settings)),
            PuffSettings::Published(settings) => Self::Published(Swarm::new(volume, settings)),
        }
    }

    /// Goes on to the next volume of the series. Costs what [`Track::step`] or [`Particles::step`] does.
    pub fn step(&mut self, next: &Volume) {
        match self {
            Self::Cover(track) => track.step(next),
            Self::Published(swarm) => swarm.step(next),
        }
    }

    /// The spheres of this frame.
    pub fn spheres(&self) -> Vec<Sphere> {
        match self {
            Self::Cover(track) => track.spheres(),
            Self::Published(swarm) => swarm.spheres.clone(),
        }
    }
}

/// Published particles with their spheres of this frame.
#[derive(Debug, Clone)]
pub struct Swarm {
    particles: Particles,
    spheres: Vec<Sphere>,
}

impl Swarm {
    fn new(volume: &Volume, settings: ParticleSettings) -> Self {
        let mut swarm = Self {
            particles: Particles::new(volume, settings),
            spheres: Vec::new(),
        };
        swarm.fit(volume);
        swarm
    }

    fn step(&mut self, next: &Volume) {
        self.particles.step(next);
        self.fit(next);
    }

    /// Gives every particle the sphere that the volume allows.
    fn fit(&mut self, volume: &Volume) {
        let distances = Distances::new(volume, self.particles.settings().threshold);
        self.spheres = around_particles(self.particles.list(), volume, &distances);
    }

    /// The particles that the spheres stand round.
    pub fn particles(&self) -> &Particles {
        &self.particles
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::in_pool;
    use crate::{Birthplace, Smoke, SmokeSettings, Source};
    use glam::Vec3;

    /// Frames of a built-in source on a small grid.
    fn frames(source: Source, count: usize) -> (Vec<Volume>, SmokeSettings) {
        let settings = SmokeSettings {
            size: [15, 15, 20],
            ..SmokeSettings::of(source)
        };
        let mut smoke = Smoke::new(settings).unwrap();
        let frame = |_| {
            smoke.step();
            smoke.volume()
        };
        ((0..count).map(frame).collect(), settings)
    }

    fn published(settings: SmokeSettings) -> PuffSettings {
        PuffSettings::Published(ParticleSettings {
            count: 120,
            birthplace: settings.birthplace(),
            ..ParticleSettings::default()
        })
    }

    /// What the paper says of a film, word by word: as many particles in every frame, each new one at the emitter,
    /// each older one where its velocity led it, and every radius that of its own box.
    #[test]
    fn published_particles_live_and_die_in_a_film_of_the_plume() {
        let (frames, settings) = frames(Source::Plume, 60);
        let Birthplace::Emitter { center, radius } = settings.birthplace() else {
            panic!("the plume has an emitter");
        };
        let mut puffs = Puffs::new(&frames[0], published(settings));
        let (mut born, mut jumps) = (0, 0);
        let mut before: Vec<Sphere> = puffs.spheres();
        for frame in &frames[1..] {
            puffs.step(frame);
            let Puffs::Published(swarm) = &puffs else {
                panic!("they were asked for");
            };
            assert_eq!(swarm.particles().list().len(), 120);
            let distances = Distances::new(frame, 0.1);
            for sphere in puffs.spheres() {
                let index = frame.index_from_world(sphere.center);
                let box_half = distances.half_side(index) * frame.voxel_width();
                assert_eq!(sphere.radius, box_half);
                let known = before.iter().find(|was| was.id == sphere.id);
                born += usize::from(sphere.age == 0);
                assert!(
                    sphere.age > 0 || sphere.center.distance(center) < radius + frame.voxel_width()
                );
                // Nothing eases a radius: it changes by more in a frame than ours ever would.
                jumps +=
                    usize::from(known.is_some_and(|was| {
                        (was.radius - sphere.radius).abs() > 0.2 * sphere.radius
                    }));
            }
            before = puffs.spheres();
        }
        assert!(born > 20 && jumps > 50, "{born} births, {jumps} jumps");
    }

    #[test]
    fn either_method_is_the_one_asked_for() {
        let (frames, settings) = frames(Source::Puff, 12);
        let of = |settings| {
            let mut puffs = Puffs::new(&frames[0], settings);
            frames[1..].iter().for_each(|frame| puffs.step(frame));
            puffs.spheres()
        };
        let mut track = Track::new(&frames[0], TrackSettings::default());
        frames[1..].iter().for_each(|frame| track.step(frame));
        assert_eq!(
            of(PuffSettings::Cover(TrackSettings::default())),
            track.spheres()
        );
        assert_ne!(of(published(settings)), track.spheres());
        assert_eq!(
            in_pool(1, || of(published(settings))),
            in_pool(3, || of(published(settings)))
        );
    }

    #[test]
    fn emitters_lie_where_smoke_begins() {
        for source in Source::ALL {
            let (frames, settings) = frames(source, 2);
            let Birthplace::Emitter { center, radius } = settings.birthplace() else {
                assert_eq!(source, Source::Cloud);
                continue;
            };
            // Nearly all of the first smoke lies in the ball.
            let volume = &frames[0];
            let (mut inside, mut all) = (0.0, 0.0);
            for at in 0..volume.density().len() {
                let index = Vec3::from_array(volume.lattice().point(at).map(|side| side as f32));
                let density = volume.density()[at];
                all += density;
                if volume.world_from_index(index).distance(center) < radius {
                    inside += density;
                }
            }
            assert!(inside > 0.8 * all, "{source:?}: {inside} of {all}");
        }
    }
}
