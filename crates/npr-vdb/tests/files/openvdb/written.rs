//! Files that OpenVDB wrote give what was put into them.

use npr_vdb::{
    Bounds, Fault, File, Grid, GridClass, Limits, MetaValue, ValueType, Values, Voxel, read,
};

use super::unpacked;

fn with_file<T>(name: &str, use_it: impl FnOnce(&File) -> T) -> T {
    let bytes = unpacked(name);
    let file = read(&bytes, &Limits::default()).unwrap_or_else(|fault| panic!("{name}: {fault}"));
    use_it(&file)
}

/// The value that `volumes.cpp` puts into voxels: eighths from 1/8 to 4.
fn ramp([x, y, z]: [i32; 3]) -> f32 {
    (x * 7 + y * 3 + z * 5).rem_euclid(32) as f32 / 8.0 + 0.125
}

fn vector(index: [i32; 3]) -> [f32; 3] {
    let eighths = ramp(index) * 8.0;
    [eighths, -eighths, index[0] as f32]
}

/// The box that `volumes.cpp` fills.
const FILLED: Bounds = Bounds {
    low: [-4, 0, 3],
    high: [11, 9, 7],
};

fn is_filled(index: [i32; 3]) -> bool {
    (0..3).all(|axis| (FILLED.low[axis]..=FILLED.high[axis]).contains(&index[axis]))
}

fn indices(low: [i32; 3], size: [i32; 3]) -> impl Iterator<Item = [i32; 3]> {
    let [x, y, z] = low;
    let xs = x..x + size[0];
    xs.flat_map(move |x| {
        (y..y + size[1]).flat_map(move |y| (z..z + size[2]).map(move |z| [x, y, z]))
    })
}

/// Compares all voxels in and around the filled box, one by one and as a dense copy.
fn assert_filled<V: Voxel>(grid: &Grid<V>, wanted: impl Fn([i32; 3]) -> V) {
    let (low, size) = ([-9, -3, -2], [28, 20, 14]);
    let dense = grid
        .dense(low, size.map(|side| side as usize))
        .expect("it fits");
    for (index, dense) in indices(low, size).zip(dense) {
        let value = if is_filled(index) {
            wanted(index)
        } else {
            grid.background()
        };
        assert_eq!(grid.value(index), value, "{index:?}");
        assert_eq!(dense, value, "{index:?}");
        assert_eq!(grid.is_active(index), is_filled(index), "{index:?}");
    }
}

#[test]
fn tiles_of_each_size_hold_their_value() {
    for (name, is_half) in [("tiles_blosc", false), ("tiles_half_masks", true)] {
        with_file(name, |file| {
            let info = &file.grids()[0];
            assert_eq!((file.version(), file.grids().len()), (224, 1));
            assert_eq!(
                (info.name.as_str(), info.class),
                ("density", GridClass::FogVolume)
            );
            assert_eq!(
                (&info.values, info.is_half),
                (&Values::Known(ValueType::Float), is_half)
            );
            let grid = file.scalar("density").expect("a sound grid");
            assert_filled(&grid, ramp);
            let corners = [
                ([64; 3], 8, 2.5, true),
                ([0, 0, 64], 8, 9.0, false),
                ([128, 0, 0], 128, 3.5, true),
                ([-8192, 4096, 0], 4096, 7.0, true),
                ([4096, 0, 0], 4096, -1.0, false),
            ];
            for (low, side, value, is_active) in corners {
                let high = low.map(|part| part + side - 1);
                for index in [low, high] {
                    assert_eq!(
                        (grid.value(index), grid.is_active(index)),
                        (value, is_active),
                        "{index:?}"
                    );
                }
                assert_ne!(grid.value(low.map(|part| part - 1)), value);
                assert_ne!(grid.value(high.map(|part| part + 1)), value);
                let dense = grid.dense([high[0] - 1, high[1], high[2]], [3, 1, 1]);
                assert_eq!(dense, Ok(vec![value, value, 0.0]));
            }
            assert_eq!(grid.tiles().len(), 5);
        });
    }
}

#[test]
fn bounds_and_counts_are_those_that_openvdb_states() {
    for name in ["tiles_blosc", "kinds_masks", "numbers_masks"] {
        with_file(name, |file| {
            for (place, info) in file.grids().iter().enumerate() {
                let grid = file.scalar_at(place).expect("a sound grid");
                assert_eq!(
                    grid.active_bounds(),
                    info.stated_bounds,
                    "{name} {}",
                    info.name
                );
                assert_eq!(
                    Some(grid.active_voxel_count()),
                    info.stated_voxel_count,
                    "{name} {}",
                    info.name
                );
            }
        });
    }
}

#[test]
fn each_way_to_leave_out_inactive_values_gives_them_back() {
    let inactive = [
        [3.0; 3],
        [-3.0; 3],
        [5.0; 3],
        [3.0, -3.0, 3.0],
        [3.0, 5.0, 3.0],
        [5.0, 6.0, 5.0],
        [5.0, 6.0, 7.0],
    ];
    for name in ["kinds_masks", "kinds_plain", "kinds_half_blosc"] {
        with_file(name, |file| {
            assert_eq!(file.grids()[0].class, GridClass::LevelSet);
            let grid = file.scalar("kinds").expect("a sound grid");
            assert_eq!((grid.background(), grid.leaves().len()), (3.0, 7));
            for (kind, leaf) in grid.leaves().enumerate() {
                for (place, &value) in leaf.values.iter().enumerate() {
                    let number = place / 37;
                    let is_active = place % 37 == 0 && number <= kind;
                    let wanted = if is_active {
                        0.5 * number as f32 - 1.0
                    } else {
                        inactive[kind][place % 3]
                    };
                    assert_eq!(value, wanted, "{name} {kind} {place}");
                    assert_eq!(leaf.active[place / 8] >> (place % 8) & 1 == 1, is_active);
                }
            }
        });
    }
}

#[test]
fn vectors_of_every_precision_are_read() {
    with_file("vectors_blosc", |file| {
        let [half, ..] = file.grids() else {
            panic!("no grids")
        };
        assert_eq!((half.class, half.is_half), (GridClass::Staggered, true));
        for (name, background) in [
            ("half", [0.0; 3]),
            ("single", [1.0, 2.0, 3.0]),
            ("double", [0.0; 3]),
            ("int", [0.0; 3]),
        ] {
            let grid = file.vector(name).expect("a sound grid");
            assert_eq!(grid.background(), background);
            assert_filled(&grid, vector);
        }
        let fault = file.scalar("half").expect_err("they are vectors");
        assert_eq!(fault.to_string(), "grid 'half' holds vec3s, not numbers");
    });
}

#[test]
fn numbers_of_every_type_are_read() {
    with_file("numbers_masks", |file| {
        assert_eq!(file.grids().len(), 5);
        let eighths = |index| (ramp(index) * 8.0).trunc();
        for name in ["double", "double half"] {
            assert_filled(&file.scalar(name).expect("a sound grid"), ramp);
        }
        for name in ["int32", "int64"] {
            assert_filled(&file.scalar(name).expect("a sound grid"), eighths);
        }
        let flags = file.scalar("bool").expect("a sound grid");
        assert_filled(&flags, |index| eighths(index) % 2.0);
        assert_eq!(
            (flags.value([255, 127, 127]), flags.value([256, 0, 0])),
            (1.0, 0.0)
        );
        let fault = file.vector("bool").expect_err("they are numbers");
        assert_eq!(fault.to_string(), "grid 'bool' holds bool, not vectors");
    });
}

#[test]
fn every_linear_map_leads_to_the_world_and_others_are_named() {
    with_file("maps_blosc", |file| {
        let places = [
            ("affine", [-1.0, 8.0, 19.0]),
            ("unitary", [-2.0, 1.0, 3.0]),
            ("moved", [2.0, 4.0, 6.0]),
            ("scaled", [2.0, 6.0, 12.0]),
            ("even", [2.0, 4.0, 6.0]),
            ("even moved", [3.0, 6.0, 9.0]),
        ];
        for (name, wanted) in places {
            let grid = file
                .scalar(name)
                .unwrap_or_else(|fault| panic!("{name}: {fault}"));
            assert_eq!(grid.value([1, 2, 3]), 4.0);
            let place = grid.index_to_world().point([1.0, 2.0, 3.0]);
            let near = place
                .iter()
                .zip(wanted)
                .all(|(part, wanted)| (part - wanted).abs() < 1e-12);
            assert!(near, "{name}: {place:?}");
        }
        let fault = file.scalar("frustum").expect_err("no linear map");
        assert_eq!(
            fault.to_string(),
            "grid 'frustum' has transform NonlinearFrustumMap, which is not read"
        );
        let fault = file.scalar("mask").expect_err("no values");
        assert_eq!(
            fault.to_string(),
            "grid 'mask' has type Tree_mask_5_4_3, which is not read"
        );
        let fault = file.scalar("smoke").expect_err("no such grid");
        assert!(
            fault
                .to_string()
                .starts_with("there is no grid 'smoke', only 'affine', 'mask', "),
            "{fault}"
        );
    });
}

#[test]
fn a_shared_tree_is_read_with_the_transform_of_its_own_grid() {
    with_file("instances_blosc", |file| {
        let names: Vec<_> = file.grids().iter().map(|info| info.name.as_str()).collect();
        assert_eq!(names, ["same"; 3]);
        let grids = [0, 1, 2].map(|place| file.scalar_at(place).expect("a sound grid"));
        assert_filled(&grids[0], ramp);
        assert_filled(&grids[1], ramp);
        assert_eq!(
            grids
                .each_ref()
                .map(|grid| grid.index_to_world().voxel_size()[0]),
            [1.0, 2.0, 1.0]
        );
        assert_eq!(
            (grids[2].background(), grids[2].active_bounds()),
            (1.0, None)
        );
        assert!(matches!(file.scalar_at(3), Err(Fault::NoGrid { .. })));
    });
}

#[test]
fn a_stream_is_read_without_offsets() {
    with_file("stream_masks", |file| {
        assert_eq!(file.metadata().text("creator"), Some("npr-vdb"));
        let when = MetaValue::Reals(vec![1.0, 2.0, 3.0, 4.0]);
        assert_eq!(file.metadata().get("when"), Some(&when));
        assert_eq!(file.grids().len(), 3);
        assert_filled(&file.scalar_at(0).expect("a sound grid"), ramp);
        assert_filled(&file.scalar_at(1).expect("a sound grid"), ramp);
        assert_filled(&file.vector("velocity").expect("a sound grid"), vector);
    });
}

#[test]
fn nothing_is_no_fault() {
    with_file("no_grids", |file| assert!(file.grids().is_empty()));
    with_file("empty_blosc", |file| {
        let grid = file.scalar("").expect("a sound grid");
        assert_eq!((grid.active_bounds(), grid.active_voxel_count()), (None, 0));
        assert_eq!(grid.dense([5; 3], [2; 3]), Ok(vec![0.0; 8]));
        assert_eq!(
            grid.dense([5; 3], [0, usize::MAX, usize::MAX]),
            Ok(Vec::new())
        );
    });
}
