//! Films against the same smoke followed by hand.

use super::*;
use crate::{Smoke, SmokeSettings, Source, Sphere, TrackSettings};
use proptest::prelude::*;

/// Frames of the plume on a small grid, without velocities where they are to be estimated.
fn volumes(count: usize, is_moving: bool) -> Vec<Volume> {
    let size = [8, 8, 10];
    let settings = SmokeSettings {
        size,
        ..SmokeSettings::of(Source::Plume)
    };
    let mut simulation = Simulation::new(Smoke::new(settings).unwrap());
    let frame = |number: usize| {
        let volume = simulation.read(number as u32 + 1);
        let place = volume.index_to_world();
        match is_moving {
            true => volume,
            false => Volume::new(size, volume.density().to_vec(), place).unwrap(),
        }
    };
    (0..count).map(frame).collect()
}

fn settings() -> PuffSettings {
    PuffSettings::Cover(TrackSettings {
        count: 20,
        ..TrackSettings::default()
    })
}

/// The spheres of every picture, and the numbers of the frames in the order in which they were read.
fn played(volumes: &[Volume], moments: Moments) -> (Vec<Vec<Sphere>>, Vec<u32>) {
    let (mut pictures, mut reads, mut told) = (Vec::new(), Vec::new(), 0);
    let read = |frame: u32| {
        reads.push(frame);
        Ok::<_, VolumeError>(volumes[frame as usize - 1].clone())
    };
    let mut film = Film::new(read, volumes.len() as u32, 24.0, moments);
    film.play(
        settings(),
        &mut |done, of| {
            assert_eq!((done, of), (told, moments.count()));
            told += 1;
        },
        &mut |puffs| pictures.push(puffs.spheres()),
    )
    .unwrap();
    assert_eq!(told, moments.count());
    (pictures, reads)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_frame_looks_the_same_alone_and_in_a_film(
        first in 1u32..5, more in 0u32..4, step in 1u32..3, is_moving: bool,
    ) {
        let last = first + more;
        let volumes = volumes(last as usize, is_moving);
        let (pictures, reads) = played(&volumes, Moments::new(first, last, f64::from(step), 1));
        prop_assert_eq!(pictures.len() as u32, more / step + 1);
        prop_assert!(reads.is_sorted_by(|a, b| a < b), "each frame is read once: {:?}", reads);
        for (frame, picture) in (first..).step_by(step as usize).zip(&pictures) {
            let alone = played(&volumes, Moments::new(frame, frame, 1.0, 1)).0;
            prop_assert_eq!(&alone[..], std::slice::from_ref(picture));
        }
    }

    #[test]
    fn moments_between_frames_change_no_count_and_read_no_frame_twice(
        last in 1u32..5, parts in 1u32..4, is_moving: bool,
    ) {
        let volumes = volumes(last as usize, is_moving);
        let (pictures, reads) = played(&volumes, Moments::new(1, last, 1.0 / f64::from(parts), 1));
        prop_assert_eq!(pictures.len() as u32, (last - 1) * parts + 1);
        prop_assert_eq!(reads, (1..=last).collect::<Vec<_>>());
    }
}

#[test]
fn a_film_is_its_volumes_followed_one_by_one() {
    let volumes = volumes(6, true);
    let (pictures, _) = played(&volumes, Moments::new(1, 6, 1.0, 1));
    let mut puffs = Puffs::new(&volumes[0], settings());
    assert_eq!(pictures[0], puffs.spheres());
    for (volume, picture) in volumes[1..].iter().zip(&pictures[1..]) {
        puffs.step(volume);
        assert_eq!(*picture, puffs.spheres());
    }
}

#[test]
fn what_reading_ends_with_ends_the_film() {
    let read = |_: u32| Err::<Volume, _>(VolumeError::BadTransform);
    let mut film = Film::new(read, 3, 24.0, Moments::new(1, 3, 1.0, 1));
    let ended = film.play(settings(), &mut |_, _| {}, &mut |_| {
        panic!("nothing is shown")
    });
    assert_eq!(ended, Err(VolumeError::BadTransform));
}
