use super::*;
use crate::testing::{blob, in_pool};
use crate::{Smoke, SmokeSettings, Source, covered_share};
use glam::{DAffine3, DVec3};
use proptest::prelude::*;

/// Frames of the built-in plume, as small as the paper's.
fn plume(frames: usize) -> Vec<Volume> {
    let mut smoke = Smoke::new(SmokeSettings::of(Source::Plume)).unwrap();
    let frame = |_| {
        smoke.step();
        smoke.volume()
    };
    (0..frames).map(frame).collect()
}

/// Fails where a sphere jumps between two frames: in size beyond `ease`, or in place beyond its speed.
fn check_no_pop(before: &Track, after: &Track, ease: f32, reach: f32, voxel_width: f32) {
    let find = |track: &Track, id: u32| track.puffs.iter().find(|puff| puff.id == id).cloned();
    for puff in before.puffs.iter().chain(&after.puffs) {
        let (was, is) = (find(before, puff.id), find(after, puff.id));
        let radius = |puff: &Option<Puff>| puff.as_ref().map_or(0.0, |puff| puff.radius);
        let target = is.as_ref().map_or(0.0, |puff| puff.target);
        let most = ease * radius(&was).max(target).max(voxel_width);
        // What is gone was this small.
        let gone = if is.is_none() {
            0.02 * voxel_width
        } else {
            0.0
        };
        let jump = (radius(&is) - radius(&was)).abs();
        assert!(jump <= most * 1.001 + gone, "{puff:?} jumps by {jump}");
        if let (Some(was), Some(is)) = (was, is) {
            assert!(is.place.distance(was.place) <= reach * 1.001);
        }
    }
}

#[test]
fn no_sphere_of_the_plume_pops() {
    let frames = plume(72);
    for placement in [Placement::Cover, Placement::Random] {
        let settings = TrackSettings {
            count: 80,
            placement,
            ..Default::default()
        };
        let mut track = Track::new(&frames[0], settings);
        for pair in frames.windows(2) {
            let before = track.clone();
            track.step(&pair[1]);
            assert!(track.puffs.len() <= 80);
            let speeds = pair[0].velocity().unwrap().iter().map(|v| v.length());
            let reach = speeds.fold(0.0, f32::max) / 24.0;
            check_no_pop(&before, &track, settings.ease, reach, pair[1].voxel_width());
        }
        assert!(track.spheres().len() > 20);
    }
}

#[test]
fn with_ease_of_one_radii_follow_at_once_as_in_the_paper() {
    let frames = plume(30);
    let settings = TrackSettings {
        ease: 1.0,
        scale: 1.0,
        ..Default::default()
    };
    let mut track = Track::new(&frames[0], settings);
    for frame in &frames[1..] {
        track.step(frame);
        let distances = Distances::new(frame, settings.threshold);
        for sphere in track.spheres() {
            let index = frame.index_from_world(sphere.center);
            let expected = reach(&distances, index) * frame.voxel_width();
            assert!((sphere.radius - expected).abs() < 1e-5);
        }
    }
}

#[test]
fn chosen_places_cover_more_of_the_plume_than_random_ones() {
    let frames = plume(72);
    let shares = [Placement::Cover, Placement::Random].map(|placement| {
        let settings = TrackSettings {
            count: 40,
            placement,
            ..Default::default()
        };
        let mut track = Track::new(&frames[0], settings);
        let mut sum = 0.0;
        for frame in &frames[1..] {
            track.step(frame);
            let distances = Distances::new(frame, settings.threshold);
            sum += covered_share(&track.spheres(), frame, &distances);
        }
        sum / 71.0
    });
    assert!(
        shares[0] > 0.45 && shares[0] > shares[1] + 0.08,
        "{shares:?}"
    );
}

#[test]
fn smoke_that_stands_still_keeps_its_spheres() {
    let cloud = blob([20, 20, 20], DAffine3::from_scale(DVec3::splat(0.1)));
    let mut track = Track::new(&cloud, TrackSettings::default());
    let ids = |track: &Track| track.spheres().iter().map(|s| s.id).collect::<Vec<_>>();
    let first = track.spheres();
    for _ in 0..10 {
        track.step(&cloud);
    }
    assert!(!first.is_empty());
    assert_eq!(ids(&track), first.iter().map(|s| s.id).collect::<Vec<_>>());
    for (was, is) in first.iter().zip(track.spheres()) {
        assert_eq!(
            (was.center, was.radius, was.age + 10),
            (is.center, is.radius, is.age)
        );
    }
}

#[test]
fn spheres_fade_out_where_the_smoke_ends() {
    let cloud = blob([12, 12, 12], DAffine3::IDENTITY);
    let nothing = Volume::new([0, 0, 0], vec![], DAffine3::IDENTITY).unwrap();
    let mut track = Track::new(&cloud, TrackSettings::default());
    let mut before = track.spheres();
    for _ in 0..200 {
        track.step(&nothing);
        let after = track.spheres();
        assert!(
            after
                .iter()
                .zip(&before)
                .all(|(is, was)| is.radius < was.radius || is.id != was.id)
        );
        before = after;
    }
    assert!(before.is_empty());
}

#[test]
fn spheres_stay_in_place_when_the_next_grid_lies_elsewhere() {
    let near = blob([12, 12, 12], DAffine3::IDENTITY);
    // The same smoke on a grid with a margin of three thin voxels.
    let wide = near_with_margin(&near, 3);
    let mut track = Track::new(&near, TrackSettings::default());
    let first = track.spheres();
    track.step(&wide);
    let second = track.spheres();
    for was in &first {
        assert!(
            second
                .iter()
                .any(|is| is.id == was.id && is.center == was.center)
        );
    }
}

fn near_with_margin(volume: &Volume, margin: u32) -> Volume {
    let size = volume.size().map(|side| side + 2 * margin);
    let lattice = crate::lattice::Lattice {
        size: size.map(|side| side as usize),
    };
    let away = margin as f32;
    let density =
        lattice.map(|at| volume.density_at(Vec3::from_array(at.map(|v| v as f32 - away))));
    let shift = DAffine3::from_translation(DVec3::splat(-f64::from(away)));
    Volume::new(size, density, shift).unwrap()
}

#[test]
fn spheres_do_not_depend_on_the_threads() {
    let frames = plume(24);
    let run = |threads| {
        in_pool(threads, || {
            let mut track = Track::new(&frames[0], TrackSettings::default());
            frames.iter().for_each(|frame| track.step(frame));
            track.spheres()
        })
    };
    assert_eq!(run(1), run(2));
    assert_eq!(run(1), run(8));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn a_radius_goes_to_its_target_in_steps(
        radius in 0.0f32..50.0, target in 0.0f32..50.0, ease in 0.01f32..1.0, width in 0.01f32..2.0,
    ) {
        let mut now = radius;
        for _ in 0..4000 {
            let next = eased(now, target, ease, width);
            prop_assert!((next - now).abs() <= ease * now.max(target).max(width) * 1.0001);
            prop_assert!((next - target).abs() <= (now - target).abs());
            now = next;
        }
        prop_assert_eq!(now, target);
    }

    #[test]
    fn odd_settings_and_volumes_do_no_harm(
        numbers in prop::array::uniform4(prop::num::f32::ANY), count in 0u32..30, seed: u32,
        scale in prop_oneof![Just(1e-30f64), Just(1.0), Just(1e30)], random: bool,
    ) {
        let volume = blob([5, 4, 6], DAffine3::from_scale(DVec3::splat(scale)));
        let speed = Vec3::new(numbers[0], numbers[1], 1.0);
        let volume = volume.with_velocity(vec![speed; 120]).unwrap();
        let placement = if random { Placement::Random } else { Placement::Cover };
        let settings = TrackSettings {
            count, threshold: numbers[2], detail: seed % 9, frame_seconds: numbers[3], scale: numbers[0],
            ease: numbers[1], placement, seed,
        };
        let mut track = Track::new(&volume, settings);
        for _ in 0..4 {
            track.step(&volume);
            for sphere in track.spheres() {
                prop_assert!(sphere.center.is_finite() && sphere.radius.is_finite() && sphere.radius > 0.0);
            }
        }
    }
}
