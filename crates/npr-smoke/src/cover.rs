//! Places for spheres: few that cover much, or any at random.

use glam::Vec3;
use npr_core::math::mix_bits;
use rayon::prelude::*;

use crate::Distances;
use crate::lattice::Lattice;
use crate::random::{below, signed3};

/// A place for a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seat {
    /// Centre in index space.
    pub place: Vec3,
    /// Radius in voxels: the smoke's distance at the centre.
    pub radius: f32,
}

/// Up to `count` seats that cover the dense voxels with few spheres.
///
/// Greedy: the voxel with the greatest distance that no seat covers yet gets the next seat; the seed decides among
/// equals. It stops when all is covered. Seats lie up to 0.3 voxels off their voxel's centre, so that no grid shows.
///
/// O(voxels + seats + voxels inside the seats' spheres), and sorting as many voxels of equal distance as are looked at.
pub fn cover(distances: &Distances, count: usize, seed: u32) -> Vec<Seat> {
    fill_gaps(distances, &mut Claims::new(distances), count, 1.0, seed)
}

/// `count` seats in dense voxels picked at random, as in [Hoshino 2004, 3.1]; none where nothing is dense.
pub fn scatter(distances: &Distances, count: usize, seed: u32) -> Vec<Seat> {
    let dense: Vec<[u32; 3]> = distances.dense().map(|(voxel, _)| voxel).collect();
    if dense.is_empty() {
        return Vec::new();
    }
    let seat = |number: u32| {
        let voxel = dense[below(dense.len(), seed, number, 0)];
        seat_in(distances, voxel, 0.5 * signed3(seed, number, 1))
    };
    let count = u32::try_from(count).unwrap_or(u32::MAX);
    (0..count).into_par_iter().map(seat).collect()
}

/// A seat near the centre of a voxel.
fn seat_in(distances: &Distances, voxel: [u32; 3], away: Vec3) -> Seat {
    let centre = Vec3::from_array(voxel.map(|side| side as f32));
    let place = centre + away;
    Seat {
        place,
        radius: reach(distances, place),
    }
}

/// Radius, in voxels, of a sphere at a place of index space in the smoke.
///
/// Off voxel centres the blended distance vanishes in thin sheets; a sphere never has less than three quarters of a
/// voxel.
pub(crate) fn reach(distances: &Distances, place: Vec3) -> f32 {
    distances.near(place).max(0.75)
}

/// Adds up to `count` seats where no claim is yet; each claims a ball of `scale` times its radius.
pub(crate) fn fill_gaps(
    distances: &Distances,
    claims: &mut Claims,
    count: usize,
    scale: f32,
    seed: u32,
) -> Vec<Seat> {
    let mut seats = Vec::new();

    // Take the deepest places first: the largest spheres cover most.
    for mut level in free_by_distance(distances, claims).into_iter().rev() {
        if seats.len() >= count {
            break;
        }

        // Shuffle places of equal depth, so that no direction is preferred.
        let lattice = claims.lattice;
        let number = |voxel: &[u32; 3]| lattice.index(voxel.map(|side| side as usize)) as u32;
        level.par_sort_unstable_by_key(|voxel| (mix_bits(seed ^ mix_bits(number(voxel))), *voxel));

        // Seat a sphere in every place that no earlier one claims.
        for voxel in level {
            if seats.len() >= count {
                break;
            }
            if claims.at(voxel) != Claim::Free {
                continue;
            }
            let away = 0.3 * signed3(seed, number(&voxel), 0);
            let seat = seat_in(distances, voxel, away);
            claims.claim(seat.place, seat.radius * scale);
            seats.push(seat);
        }
    }
    seats
}

/// Dense voxels without a claim, by their distance.
fn free_by_distance(distances: &Distances, claims: &Claims) -> Vec<Vec<[u32; 3]>> {
    let free = distances
        .dense()
        .filter(|(voxel, _)| claims.at(*voxel) == Claim::Free);
    let free: Vec<([u32; 3], u16)> = free.collect();
    let deepest = free.iter().map(|&(_, distance)| distance).max();
    let mut levels = vec![Vec::new(); deepest.map_or(0, |deepest| usize::from(deepest) + 1)];
    for (voxel, distance) in free {
        levels[usize::from(distance)].push(voxel);
    }
    levels
}

/// Who holds a voxel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Claim {
    /// No sphere.
    Free,
    /// A sphere, near its rim.
    Rim,
    /// A sphere, near its centre: another centre would be of no use here.
    Core,
}

/// Share of a sphere's radius within which a voxel belongs to its core.
const CORE: f32 = 0.5;

/// Bits of a claimed voxel.
const RIM_BIT: u8 = 1;
const CORE_BIT: u8 = 2;

/// Which voxels lie inside spheres that are placed already.
pub(crate) struct Claims {
    lattice: Lattice,
    bits: Vec<u8>,
}

impl Claims {
    /// No claims.
    pub fn new(distances: &Distances) -> Self {
        let lattice = Lattice {
            size: distances.size().map(|side| side as usize),
        };
        Self {
            bits: vec![0; lattice.len()],
            lattice,
        }
    }

    /// Who holds a voxel of the grid.
    pub fn at(&self, voxel: [u32; 3]) -> Claim {
        match self.bits[self.lattice.index(voxel.map(|side| side as usize))] {
            0 => Claim::Free,
            RIM_BIT => Claim::Rim,
            _ => Claim::Core,
        }
    }

    /// Who holds the voxel round a place of index space; nobody outside the grid.
    pub fn near(&self, index: Vec3) -> Claim {
        self.lattice
            .nearest(index)
            .map_or(Claim::Free, |voxel| self.at(voxel.map(|side| side as u32)))
    }

    /// Claims the voxels whose centres lie inside a ball of index space.
    pub fn claim(&mut self, place: Vec3, radius: f32) {
        self.mark(place, radius, RIM_BIT);
        self.mark(place, radius * CORE, CORE_BIT);
    }

    fn mark(&mut self, place: Vec3, radius: f32, bit: u8) {
        // Walk the planes that the ball cuts.
        let Some(planes) = span(place.z, radius, self.lattice.size[2]) else {
            return;
        };
        for z in planes {
            // Walk the lines that it cuts in the plane.
            let left = radius * radius - (z as f32 - place.z) * (z as f32 - place.z);
            let Some(lines) = span(place.y, left.max(0.0).sqrt(), self.lattice.size[1]) else {
                continue;
            };
            for y in lines {
                // Mark the voxels that it holds on the line.
                let left = left - (y as f32 - place.y) * (y as f32 - place.y);
                let Some(row) = span(place.x, left.max(0.0).sqrt(), self.lattice.size[0]) else {
                    continue;
                };
                let start = self.lattice.index([0, y, z]);
                for bits in &mut self.bits[start + row.start()..=start + row.end()] {
                    *bits |= bit;
                }
            }
        }
    }
}

/// Grid points within `reach` of `middle`, of `0..count`; nothing where there is none, or for NaN.
fn span(middle: f32, reach: f32, count: usize) -> Option<std::ops::RangeInclusive<usize>> {
    let low = (middle - reach).ceil().max(0.0);
    let high = (middle + reach).floor().min(count as f32 - 1.0);
    (low <= high && reach >= 0.0).then_some(low as usize..=high as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{blob, in_pool};
    use crate::{Sphere, Volume, covered_share};
    use glam::DAffine3;
    use proptest::prelude::*;

    fn spheres(seats: &[Seat], volume: &Volume) -> Vec<Sphere> {
        let sphere = |seat: &Seat| Sphere {
            center: volume.world_from_index(seat.place),
            radius: seat.radius,
            id: 0,
            age: 0,
            temperature: 0.0,
        };
        seats.iter().map(sphere).collect()
    }

    /// Three lumps of different size, joined.
    fn lumps() -> Volume {
        let density = (0..40 * 30 * 24).map(|at| {
            let place = Vec3::new((at % 40) as f32, (at / 40 % 30) as f32, (at / 1200) as f32);
            let lumps = [(10.0, 12.0, 9.0), (24.0, 16.0, 6.0), (32.0, 12.0, 4.0)];
            let inside = lumps
                .iter()
                .any(|&(x, y, r)| place.distance(Vec3::new(x, y, 12.0)) < r);
            f32::from(u8::from(inside))
        });
        Volume::new([40, 30, 24], density.collect(), DAffine3::IDENTITY).unwrap()
    }

    #[test]
    fn few_chosen_seats_cover_more_than_as_many_at_random() {
        let volume = lumps();
        let distances = Distances::new(&volume, 0.5);
        for count in [10, 30, 100, 300] {
            let share =
                |seats: Vec<Seat>| covered_share(&spheres(&seats, &volume), &volume, &distances);
            let chosen = share(cover(&distances, count, 1));
            let random = (0..5).map(|seed| share(scatter(&distances, count, seed)));
            let random = random.fold(0.0, f32::max);
            assert!(
                chosen > random + 0.01,
                "{count} seats: {chosen} against {random}"
            );
        }
        let all = cover(&distances, usize::MAX, 1);
        assert!(all.len() < distances.dense_count() / 4, "{}", all.len());
        assert!(covered_share(&spheres(&all, &volume), &volume, &distances) > 0.999);
    }

    #[test]
    fn seats_do_not_depend_on_the_threads() {
        let distances = Distances::new(&blob([60, 50, 40], DAffine3::IDENTITY), 0.3);
        let of = |threads| {
            in_pool(threads, || {
                (cover(&distances, 900, 3), scatter(&distances, 900, 3))
            })
        };
        assert_eq!(of(1), of(2));
        assert_eq!(of(1), of(8));
    }

    #[test]
    fn another_seed_seats_spheres_elsewhere_in_their_voxels() {
        // The deepest voxel is the only one of its depth, so that every seed takes it first.
        let cube = Volume::new([5; 3], vec![1.0; 125], DAffine3::IDENTITY).unwrap();
        let distances = Distances::new(&cube, 0.5);
        let places = [1, 1, 2].map(|seed| cover(&distances, 1, seed)[0].place);
        assert_eq!(places[0], places[1]);
        assert_ne!(places[0], places[2]);
        assert_eq!(places.map(|place| place.round()), [Vec3::splat(2.0); 3]);
    }

    #[test]
    fn nothing_to_cover_needs_no_seats() {
        let nothing = Volume::new([0, 0, 0], vec![], DAffine3::IDENTITY).unwrap();
        let distances = Distances::new(&nothing, 0.0);
        assert!(cover(&distances, 9, 0).is_empty() && scatter(&distances, 9, 0).is_empty());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn a_ball_claims_the_voxels_whose_centres_it_holds(
            place in prop::array::uniform3(-3.0f32..9.0), radius in -1.0f32..6.0,
        ) {
            let volume = blob([6, 5, 7], DAffine3::IDENTITY);
            let mut claims = Claims::new(&Distances::new(&volume, 0.5));
            let place = Vec3::from(place);
            claims.claim(place, radius);
            for at in 0..claims.lattice.len() {
                let voxel = claims.lattice.point(at);
                let away = Vec3::from_array(voxel.map(|side| side as f32)).distance(place);
                // Rounding decides for centres that lie on the ball's surface.
                prop_assume!((away - radius).abs() > 1e-4 && (away - CORE * radius).abs() > 1e-4);
                let expected = match away {
                    away if away < CORE * radius => Claim::Core,
                    away if away < radius => Claim::Rim,
                    _ => Claim::Free,
                };
                prop_assert_eq!(claims.at(voxel.map(|side| side as u32)), expected);
            }
        }

        #[test]
        fn every_seat_is_in_the_smoke_and_none_in_the_ball_of_another(seed: u32, count in 0usize..60) {
            let distances = Distances::new(&lumps(), 0.5);
            let seats = cover(&distances, count, seed);
            prop_assert!(seats.len() <= count);
            for (number, seat) in seats.iter().enumerate() {
                prop_assert!(distances.is_dense(seat.place) && seat.radius >= 0.75);
                for other in &seats[..number] {
                    // Seats lie 0.3 voxels off along each axis at most.
                    prop_assert!(seat.place.distance(other.place) > other.radius - 0.53);
                }
            }
        }

        #[test]
        fn odd_balls_claim_without_harm(
            place in prop::array::uniform3(prop::num::f32::ANY), radius in prop::num::f32::ANY,
        ) {
            let mut claims = Claims::new(&Distances::new(&blob([4, 4, 4], DAffine3::IDENTITY), 0.5));
            claims.claim(Vec3::from(place), radius);
            claims.near(Vec3::from(place));
        }
    }
}
