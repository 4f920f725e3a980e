use super::*;
use crate::testing::in_pool;
use proptest::prelude::*;

fn smoke(settings: SmokeSettings, frames: usize) -> Smoke {
    let mut smoke = Smoke::new(settings).unwrap();
    (0..frames).for_each(|_| smoke.step());
    smoke
}

#[test]
fn every_source_smokes_and_reaches_upward() {
    for source in Source::ALL {
        assert_eq!(Source::of_name(source.name()), Some(source));
        let settings = SmokeSettings::of(source);
        let early = smoke(settings, 2).volume();
        let late = smoke(settings, 36).volume();
        assert!(early.dense_count(0.3) > 20, "{source:?} has hardly begun");
        assert!(late.dense_count(0.05) > 100, "{source:?} is gone");
        let height = |volume: &Volume| {
            let mut layers = volume
                .density()
                .chunks(volume.density().len() / volume.size()[2] as usize);
            layers
                .rposition(|layer| layer.iter().any(|&d| d > 0.1))
                .unwrap()
        };
        if source != Source::Cloud {
            assert!(
                height(&late) >= height(&early) + 5,
                "{source:?} does not rise"
            );
        }
    }
    assert_eq!(Source::of_name("bonfire"), None);
}

/// What makes a fair-weather cloud of the same solver: it is there before the first frame, keeps its flat base at its
/// height and its heaps above it, drifts with the wind, and is wider than tall. A plume does none of that.
#[test]
fn a_cloud_keeps_its_flat_base_and_drifts() {
    let settings = SmokeSettings::of(Source::Cloud);
    let (first, last) = (smoke(settings, 0).volume(), smoke(settings, 72).volume());
    let (before, after) = (Heap::of(&first), Heap::of(&last));
    for heap in [&before, &after] {
        assert!(
            heap.base_spread < 1.2 && heap.top_spread > 1.5 * heap.base_spread,
            "{heap:?}"
        );
        assert!(heap.wide > 1.5 * heap.tall, "{heap:?}");
    }
    assert!(
        (after.base - before.base).abs() < 1.0,
        "{before:?} to {after:?}"
    );
    assert!(
        after.middle > before.middle + 0.5,
        "it drifts: {before:?} to {after:?}"
    );
    let plume = SmokeSettings::of(Source::Plume);
    assert_eq!(
        smoke(plume, 0).volume().dense_count(0.1),
        0,
        "a plume is not there from the start"
    );
    let plume = Heap::of(&smoke(plume, 48).volume());
    assert!(plume.wide < plume.tall, "{plume:?}");
}

/// What columns of dense voxels are like, in voxels.
#[derive(Debug)]
struct Heap {
    /// Mean height of the lowest dense voxel of a column, and how far columns lie off it.
    base: f32,
    base_spread: f32,
    /// How far the highest ones lie off their mean.
    top_spread: f32,
    wide: f32,
    tall: f32,
    /// Where its middle lies along x.
    middle: f32,
}

impl Heap {
    fn of(volume: &Volume) -> Self {
        let [width, depth, height] = volume.size();
        let is_dense = |x, y, z| volume.density()[(x + width * (y + depth * z)) as usize] > 0.1;
        let column = |x, y| {
            let mut dense = (0..height).filter(|z| is_dense(x, y, *z));
            let low = dense.next()?;
            Some([
                x as f32,
                low as f32,
                dense.next_back().unwrap_or(low) as f32,
            ])
        };
        let places = (0..depth).flat_map(|y| (0..width).map(move |x| (x, y)));
        let columns: Vec<[f32; 3]> = places.filter_map(|(x, y)| column(x, y)).collect();
        // Thin columns are rims, where base and top meet.
        let thick: Vec<[f32; 3]> = columns
            .iter()
            .copied()
            .filter(|[_, low, high]| high - low >= 2.0)
            .collect();
        let mean = |i: usize| thick.iter().map(|c| c[i]).sum::<f32>() / thick.len() as f32;
        let spread = |i: usize| {
            let squares = thick.iter().map(|c| (c[i] - mean(i)) * (c[i] - mean(i)));
            (squares.sum::<f32>() / thick.len() as f32).sqrt()
        };
        let reach = |i: usize| {
            let (low, high) = columns.iter().fold((f32::MAX, f32::MIN), |(low, high), c| {
                (low.min(c[i]), high.max(c[i]))
            });
            (low, high)
        };
        Self {
            base: mean(1),
            base_spread: spread(1),
            top_spread: spread(2),
            wide: reach(0).1 - reach(0).0 + 1.0,
            tall: reach(2).1 - reach(1).0 + 1.0,
            middle: mean(0),
        }
    }
}

#[test]
fn flow_is_free_of_divergence_after_every_frame() {
    for source in Source::ALL {
        let mut smoke = Smoke::new(SmokeSettings::of(source)).unwrap();
        for _ in 0..48 {
            smoke.step();
            // What pressure had to undo is at most of the order of the fastest speed per cell.
            let bound = 1e-3 * (1.0 + smoke.flow.fastest());
            assert!(smoke.greatest_divergence() < bound, "{source:?}");
        }
    }
}

#[test]
fn carrying_makes_no_smoke_and_no_extremes() {
    let settings = SmokeSettings {
        fading: 0.0,
        ..SmokeSettings::of(Source::Puff)
    };
    let mut smoke = smoke(settings, 12);
    for _ in 0..40 {
        let (mass, most) = (
            total(&smoke.density),
            smoke.density.values.iter().copied().fold(0.0, f32::max),
        );
        smoke.step();
        assert!(total(&smoke.density) <= mass * (1.0 + 1e-6));
        assert!(
            smoke
                .density
                .values
                .iter()
                .all(|&d| (0.0..=most * 1.000_001).contains(&d))
        );
    }
    assert!(total(&smoke.density) > 1.0);
}

#[test]
fn smoke_does_not_depend_on_the_threads() {
    let settings = SmokeSettings {
        size: [40, 30, 36],
        ..SmokeSettings::of(Source::Explosion)
    };
    let run = |threads| in_pool(threads, || smoke(settings, 5).volume());
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(8));
}

#[test]
fn seeds_change_the_smoke_and_nothing_else_does() {
    let of = |seed| {
        smoke(
            SmokeSettings {
                seed,
                ..SmokeSettings::of(Source::Plume)
            },
            12,
        )
        .volume()
    };
    assert_eq!(of(1), of(1));
    assert_ne!(of(1), of(2));
}

#[test]
fn the_box_stands_on_the_floor() {
    let volume = smoke(SmokeSettings::of(Source::Plume), 1).volume();
    let corner = volume.world_from_index(Vec3::splat(-0.5));
    let far = volume.world_from_index(Vec3::new(14.5, 14.5, 19.5));
    assert!(corner.distance(Vec3::new(-0.375, 0.0, 0.375)) < 1e-6);
    assert!(far.distance(Vec3::new(0.375, 1.0, -0.375)) < 1e-6);
    let rising = volume
        .velocity()
        .unwrap()
        .iter()
        .map(|v| v.y)
        .fold(0.0, f32::max);
    assert!(rising > 0.1, "smoke rises along the world's y");
}

#[test]
fn grids_that_do_not_fit_are_refused() {
    let sized = |size| SmokeSettings {
        size,
        ..SmokeSettings::of(Source::Plume)
    };
    assert!(matches!(
        Smoke::new(sized([3, 9, 9])),
        Err(SmokeError::BadSize { .. })
    ));
    let told = Smoke::new(sized([0, 5, 9])).map_err(|error| error.to_string());
    assert_eq!(
        told.err().as_deref(),
        Some("a grid of 0x5x9 cells has a side outside 4..32767")
    );
    assert!(matches!(
        Smoke::new(sized([9, 9, MAX_SIDE + 1])),
        Err(SmokeError::BadSize { .. })
    ));
    let mut budget = Budget::new(1 << 30);
    let refused = Smoke::within(&mut budget, sized([4000; 3]));
    assert!(matches!(refused, Err(SmokeError::OverBudget(_))));
    assert!(Smoke::within(&mut budget, sized([4; 3])).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn odd_settings_give_finite_smoke(
        numbers in prop::array::uniform7(prop::num::f32::ANY), wind in prop::array::uniform3(prop::num::f32::ANY),
        size in prop::array::uniform3(4u32..8), pick in 0usize..4, seed: u32,
    ) {
        let [frame_seconds, heat, buoyancy, weight, curl, fading, cooling] = numbers;
        let settings = SmokeSettings {
            source: Source::ALL[pick], size, frame_seconds, heat, buoyancy, weight, curl, fading, cooling,
            wind: Vec3::from(wind), seed,
        };
        let volume = smoke(settings, 3).volume();
        prop_assert_eq!(volume.mended(), crate::Mended::default());
        prop_assert!(volume.density().iter().all(|&d| (0.0..=1.001).contains(&d)));
    }
}

#[test]
fn an_explosion_stays_in_its_box() {
    for seed in [0, 5] {
        let settings = SmokeSettings {
            seed,
            ..SmokeSettings::of(Source::Explosion)
        };
        let mut smoke = smoke(settings, 0);
        let [side, ..] = smoke.cells.size;
        for frame in 1..=96 {
            smoke.step();
            let is_dense = |at: &usize| smoke.density.values[*at] > 0.1;
            let dense = (0..smoke.cells.len()).filter(is_dense);
            let dense: Vec<_> = dense.map(|at| smoke.cells.point(at)).collect();
            assert!(dense.len() > 50, "seed {seed} frame {frame}: it is gone");
            let is_inside = |[x, y, z]: &[usize; 3]| {
                let is_within = |at: &usize| (1..side - 1).contains(at);
                is_within(x) && is_within(y) && *z < side - 2
            };
            assert!(dense.iter().all(is_inside), "seed {seed} frame {frame}");
        }
    }
}
