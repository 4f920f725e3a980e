//! Spheres that follow the smoke from frame to frame without popping.

use std::cmp::Reverse;

use glam::Vec3;
use rayon::prelude::*;

use crate::cover::{Claim, Claims, Seat, fill_gaps, reach, scatter};
use crate::{Distances, Sphere, Volume};

/// Where new spheres are placed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Placement {
    /// Where much smoke is not covered yet, the deepest first.
    #[default]
    Cover,
    /// In any dense voxel, as in [Hoshino 2004, 3.1].
    Random,
}

/// How spheres follow the smoke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrackSettings {
    /// Most spheres at a time. 30 a simple cloud, 2000 a busy eruption. [`Placement::Cover`] takes fewer where fewer
    /// cover all.
    pub count: u32,
    /// Density up to which a voxel is thin.
    pub threshold: f32,
    /// Seconds from one frame to the next.
    pub frame_seconds: f32,
    /// Radius as a multiple of the smoke's distance. 1 keeps within the smoke, 1.4 makes fat, overlapping puffs.
    pub scale: f32,
    /// Greatest change of a radius per frame, as a share of the radius it goes to or comes from. 0.05 swells slowly, 0.15
    /// is lively, 1 follows at once, as in the paper.
    pub ease: f32,
    /// Where new spheres are placed.
    pub placement: Placement,
    /// Other seeds give other, equally likely spheres.
    pub seed: u32,
}

impl Default for TrackSettings {
    fn default() -> Self {
        Self {
            count: 200,
            threshold: 0.1,
            frame_seconds: 1.0 / 24.0,
            scale: 1.2,
            ease: 0.12,
            placement: Placement::Cover,
            seed: 0,
        }
    }
}

/// A sphere and where it is going.
#[derive(Debug, Clone, PartialEq)]
struct Puff {
    /// Place in the world.
    place: Vec3,
    velocity: Vec3,
    /// Radius now, and the one it goes to, in world units.
    radius: f32,
    target: f32,
    id: u32,
    age: u32,
    temperature: f32,
    /// It shrinks and does not come back.
    fading: bool,
}

/// Spheres over a series of volumes.
///
/// Each moves with the smoke, swells or shrinks towards the radius that the smoke allows at its place, and keeps its id. Where
/// it leaves the smoke, or drifts into the middle of a larger one, it shrinks until it is gone; smoke that none covers gets
/// new ones, which grow from nothing.
///
/// Differs: the paper sets every radius anew in each frame, and moves dying particles elsewhere at once. There both show as
/// pops; here no radius jumps, and nor does a place.
/// Differs: smoke that stands still keeps its spheres; the paper's particles die without motion.
#[derive(Debug, Clone)]
pub struct Track {
    settings: TrackSettings,
    puffs: Vec<Puff>,
    next_id: u32,
}

impl Track {
    /// Spheres for the first volume of a series, at full size.
    ///
    /// O(voxels + volume of all spheres in voxels).
    pub fn new(volume: &Volume, settings: TrackSettings) -> Self {
        let mut track = Self {
            settings: sane(settings),
            puffs: Vec::new(),
            next_id: 0,
        };
        track.follow(volume);
        for puff in &mut track.puffs {
            puff.radius = puff.target;
        }
        track
    }

    /// Goes on to the next volume of the series, which may have another grid.
    ///
    /// O(voxels + spheres + volume of all spheres in voxels). The distances are measured in parallel, spheres move in
    /// parallel; claims are made one by one, in the order of sizes.
    pub fn step(&mut self, next: &Volume) {
        let seconds = self.settings.frame_seconds;
        for puff in &mut self.puffs {
            puff.place += puff.velocity * seconds;
            puff.age = puff.age.saturating_add(1);
        }
        self.follow(next);
        let smallest = 0.02 * next.voxel_width();
        let ease = self.settings.ease;
        for puff in &mut self.puffs {
            puff.radius = eased(puff.radius, puff.target, ease, next.voxel_width());
        }
        self.puffs.retain(|puff| {
            let gone = puff.fading && puff.radius <= smallest;
            !gone && puff.place.is_finite()
        });
    }

    /// The spheres of this frame: those that cover something, by id.
    pub fn spheres(&self) -> Vec<Sphere> {
        let shown = self.puffs.iter().filter(|puff| puff.radius > 0.0);
        let sphere = |puff: &Puff| Sphere {
            center: puff.place,
            radius: puff.radius,
            id: puff.id,
            age: puff.age,
            temperature: puff.temperature,
        };
        shown.map(sphere).collect()
    }

    /// Takes velocity, temperature and target from a volume; decides who fades and who is born.
    fn follow(&mut self, volume: &Volume) {
        let distances = Distances::new(volume, self.settings.threshold);
        let width = volume.voxel_width() * self.settings.scale;
        self.puffs.par_iter_mut().for_each(|puff| {
            let index = volume.index_from_world(puff.place);
            puff.velocity = finite(volume.velocity_at(index));
            puff.temperature = volume.temperature_at(index);
            puff.fading |= !distances.is_dense(index);
            puff.target = if puff.fading {
                0.0
            } else {
                radius(reach(&distances, index), width)
            };
        });
        let room = (self.settings.count as usize).saturating_sub(self.puffs.len());
        let seats = match self.settings.placement {
            Placement::Random => scatter(&distances, room, self.settings.seed ^ self.next_id),
            Placement::Cover => {
                let mut claims = self.claim_places(volume, &distances);
                let seed = self.settings.seed;
                fill_gaps(&distances, &mut claims, room, self.settings.scale, seed)
            }
        };
        self.puffs.reserve(seats.len());
        for seat in seats {
            let puff = self.born(volume, seat);
            self.puffs.push(puff);
        }
    }

    /// Claims what the spheres will cover, the largest first; one whose centre lies in another's core fades.
    fn claim_places(&mut self, volume: &Volume, distances: &Distances) -> Claims {
        let mut claims = Claims::new(distances);
        let mut order: Vec<usize> = (0..self.puffs.len()).collect();
        // Targets are never negative, so their bits sort as they do.
        order.sort_unstable_by_key(|&at| {
            let puff = &self.puffs[at];
            (Reverse(puff.target.to_bits()), puff.id)
        });
        for at in order {
            let puff = &mut self.puffs[at];
            let index = volume.index_from_world(puff.place);
            if puff.fading {
                continue;
            }
            if claims.near(index) == Claim::Core {
                puff.fading = true;
                puff.target = 0.0;
            } else {
                claims.claim(index, puff.target / volume.voxel_width());
            }
        }
        claims
    }

    /// A sphere that starts to grow in a seat.
    fn born(&mut self, volume: &Volume, seat: Seat) -> Puff {
        let id = self.next_id;
        self.next_id = self.next_id.wrapping_add(1);
        Puff {
            place: volume.world_from_index(seat.place),
            velocity: finite(volume.velocity_at(seat.place)),
            radius: 0.0,
            target: radius(seat.radius, volume.voxel_width() * self.settings.scale),
            id,
            age: 0,
            temperature: volume.temperature_at(seat.place),
            fading: false,
        }
    }
}

/// Settings with every number in the range that it makes sense in.
fn sane(settings: TrackSettings) -> TrackSettings {
    let within = |value: f32, least: f32, most: f32, default: f32| {
        if value.is_finite() {
            value.clamp(least, most)
        } else {
            default
        }
    };
    let default = TrackSettings::default();
    TrackSettings {
        frame_seconds: within(settings.frame_seconds, 0.0, 1e3, default.frame_seconds),
        scale: within(settings.scale, 0.0, 16.0, default.scale),
        ease: within(settings.ease, 1e-3, 1.0, default.ease),
        ..settings
    }
}

/// Voxels of a width as a radius, never so large that its square overflows.
fn radius(voxels: f32, width: f32) -> f32 {
    (voxels * width).min(1e18)
}

/// A velocity that can be added up: blends of huge ones may overflow.
fn finite(velocity: Vec3) -> Vec3 {
    if velocity.is_finite() {
        velocity
    } else {
        Vec3::ZERO
    }
}

/// A radius a step nearer to its target, by at most `ease` times the larger of both, or of a voxel's width.
fn eased(radius: f32, target: f32, ease: f32, voxel_width: f32) -> f32 {
    let most = ease * radius.max(target).max(voxel_width);
    target.clamp(radius - most, radius + most).max(0.0)
}

#[cfg(test)]
mod tests;
