//! Spheres that follow the smoke from frame to frame without popping.

use std::borrow::Cow;
use std::cmp::Reverse;

use glam::Vec3;
use rayon::prelude::*;

use crate::cover::{Claim, Claims, fill_gaps, reach, scatter};
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
    /// Voxels along the longest side in which the shape of the smoke is seen; finer grids are
    /// [coarsened](Volume::coarsened). 20 a few bold puffs, 40 a drawing, 200 every wisp.
    pub detail: u32,
    /// Seconds from one frame to the next.
    pub frame_seconds: f32,
    /// Radius as a multiple of the smoke's distance. 1 keeps within the smoke, 1.4 makes fat, overlapping puffs.
    pub scale: f32,
    /// Greatest change of a radius per frame, as a share of the radius it goes to or comes from. 0.05 swells slowly,
    /// 0.15 is lively, 1 follows at once, as in the paper.
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
            detail: 40,
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
    /// It shrinks and does not come back: its slot is needed elsewhere.
    evicted: bool,
}

/// Spheres over a series of volumes.
///
/// Each moves with the smoke, swells or shrinks towards the radius that the smoke allows at its place, and keeps its
/// id. Where it leaves the smoke, or drifts into the middle of a larger one, it shrinks until it is gone; smoke that
/// none covers gets new ones, which grow from nothing. When there are as many as may be, the smallest give way to
/// larger ones.
///
/// Differs: the paper sets every radius anew in each frame, and moves dying particles elsewhere at once. There both
/// show as pops; here no radius jumps, and nor does a place. Differs: smoke that stands still keeps its spheres; the
/// paper's particles die without motion.
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

        // Add spheres until no more find room.
        for _ in 0..SETTLING {
            let (known, count) = (track.next_id, track.puffs.len());
            track.follow(volume);
            track
                .puffs
                .retain(|puff| puff.target > 0.0 && !puff.evicted);
            if (known, count) == (track.next_id, track.puffs.len()) {
                break;
            }
        }

        // Show them at full size at once: there is no frame to grow from.
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
        let voxel_width = self.follow(next);
        let (ease, smallest) = (self.settings.ease, 0.02 * voxel_width);
        for puff in &mut self.puffs {
            puff.radius = eased(puff.radius, puff.target, ease, voxel_width);
        }
        self.puffs.retain(|puff| {
            let gone = puff.target == 0.0 && puff.radius <= smallest;
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

    /// Takes velocity, temperature and target from a volume; decides who fades and who is born. Gives the width of a
    /// voxel of the shape.
    fn follow(&mut self, volume: &Volume) -> f32 {
        // Let every sphere follow the smoke, and shrink where it is gone.
        let shape = &*shape(volume, self.settings.detail);
        let distances = Distances::new(shape, self.settings.threshold);
        let width = shape.voxel_width() * self.settings.scale;
        self.puffs.par_iter_mut().for_each(|puff| {
            let index = volume.index_from_world(puff.place);
            puff.velocity = finite(volume.velocity_at(index));
            puff.temperature = volume.temperature_at(index);
            let place = shape.index_from_world(puff.place);
            let stays = !puff.evicted && distances.is_dense(place);
            puff.target = if stays {
                radius(reach(&distances, place), width)
            } else {
                0.0
            };
        });

        // Find places for new spheres where nothing covers the smoke.
        let room = (self.settings.count as usize).saturating_sub(self.puffs.len());
        let mut seats = match self.settings.placement {
            Placement::Random => scatter(&distances, room, self.settings.seed ^ self.next_id),
            Placement::Cover => {
                let mut claims = self.claim_places(shape, &distances);
                let wanted = room + self.settings.count as usize / EVICTED_AT_ONCE;
                fill_gaps(
                    &distances,
                    &mut claims,
                    wanted,
                    self.settings.scale,
                    self.settings.seed,
                )
            }
        };

        // Evict the smallest spheres where much larger ones find no room.
        let waiting = seats.split_off(room.min(seats.len()));
        self.evict(waiting.iter().map(|seat| radius(seat.radius, width)));

        // Let spheres be born in the places found.
        for seat in seats {
            let puff = self.born(
                volume,
                shape.world_from_index(seat.place),
                radius(seat.radius, width),
            );
            self.puffs.push(puff);
        }
        shape.voxel_width()
    }

    /// Claims what the spheres will cover, the largest first; one whose centre lies in another's core fades while it
    /// does.
    fn claim_places(&mut self, shape: &Volume, distances: &Distances) -> Claims {
        let mut claims = Claims::new(distances);
        for at in self.by_size(|target| Reverse(target.to_bits())) {
            let puff = &mut self.puffs[at];
            let place = shape.index_from_world(puff.place);
            if claims.near(place) == Claim::Core {
                puff.target = 0.0;
            } else {
                claims.claim(place, puff.target / shape.voxel_width());
            }
        }
        claims
    }

    /// Lets the smallest spheres go, one for each that waits and would be much larger.
    fn evict(&mut self, waiting: impl Iterator<Item = f32>) {
        for (at, target) in self.by_size(f32::to_bits).into_iter().zip(waiting) {
            let puff = &mut self.puffs[at];
            puff.evicted |= target > EVICTING_SIZE * puff.target;
        }
    }

    /// The spheres that do not shrink away, in the order of a key made from their target; ids decide among equals.
    ///
    /// Targets are never negative, so their bits sort as they do.
    fn by_size<K: Ord>(&self, key: impl Fn(f32) -> K) -> Vec<usize> {
        let stays = |at: &usize| self.puffs[*at].target > 0.0;
        let mut order: Vec<usize> = (0..self.puffs.len()).filter(stays).collect();
        order.sort_unstable_by_key(|&at| (key(self.puffs[at].target), self.puffs[at].id));
        order
    }

    /// A sphere that starts to grow at a place of the world.
    fn born(&mut self, volume: &Volume, place: Vec3, target: f32) -> Puff {
        let id = self.next_id;
        self.next_id = self.next_id.wrapping_add(1);
        let index = volume.index_from_world(place);
        Puff {
            place,
            velocity: finite(volume.velocity_at(index)),
            radius: 0.0,
            target,
            id,
            age: 0,
            temperature: volume.temperature_at(index),
            evicted: false,
        }
    }
}

/// Most rounds in which the first spheres find their places: later ones may crowd out earlier ones.
const SETTLING: usize = 8;

/// One in so many spheres may be asked to give way in one frame.
const EVICTED_AT_ONCE: usize = 16;

/// How much larger a sphere must be for a smaller one to give way.
///
/// The least spheres differ by less, so that they never take turns.
const EVICTING_SIZE: f32 = 2.0;

/// The volume, or a coarser one, with at most `detail` voxels along its longest side.
fn shape(volume: &Volume, detail: u32) -> Cow<'_, Volume> {
    let longest = volume.size().into_iter().max().unwrap_or(0);
    match longest.div_ceil(detail.max(1)) {
        0 | 1 => Cow::Borrowed(volume),
        block => Cow::Owned(volume.coarsened(block)),
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
