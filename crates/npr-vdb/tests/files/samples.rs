//! Generated files of every version, type and packing give what was put into them.

use npr_vdb::testing::{Packing, Sample, SampleGrid, SampleValue};
use npr_vdb::{Fault, Grid, Limits, Transform, ValueType, Voxel, read};
use proptest::prelude::*;

/// Values that every type can hold: small whole numbers, or zero and one.
fn value(kind: ValueType) -> BoxedStrategy<SampleValue> {
    match kind {
        ValueType::Bool => (0..2i32).prop_map(|bit| [bit as f32, 0.0, 0.0]).boxed(),
        _ => prop::array::uniform3(-4..4i32)
            .prop_map(|parts| parts.map(|part| part as f32))
            .boxed(),
    }
}

/// A corner near which voxels are put: the middle, across borders of nodes, and both ends of the index space.
fn corner() -> impl Strategy<Value = [i32; 3]> {
    let part = prop_oneof![
        Just(0),
        Just(-5),
        Just(124),
        Just(4090),
        Just(i32::MIN),
        Just(i32::MAX - 12)
    ];
    prop::array::uniform3(part)
}

fn grid() -> impl Strategy<Value = SampleGrid> {
    (0..ValueType::ALL.len(), any::<bool>()).prop_flat_map(|(kind, is_half)| {
        let kind = ValueType::ALL[kind];
        let voxel = (prop::array::uniform3(0..12i32), value(kind), any::<bool>());
        let voxels = (corner(), prop::collection::vec(voxel, 0..40));
        let tile = (
            prop::array::uniform3(-3..3i32),
            0..3usize,
            value(kind),
            any::<bool>(),
        );
        (
            value(kind),
            prop::collection::vec(voxels, 0..3),
            prop::collection::vec(tile, 0..4),
        )
            .prop_map(move |(background, clusters, tiles)| {
                let mut grid = SampleGrid::new("grid", kind);
                grid.is_half = is_half;
                grid.background = background;
                for (corner, voxels) in clusters {
                    for (offset, value, is_active) in voxels {
                        let index = std::array::from_fn(|axis| corner[axis] + offset[axis]);
                        grid.voxels.insert(index, (value, is_active));
                    }
                }
                tiles
                    .into_iter()
                    .for_each(|(step, size, value, is_active)| {
                        put_tile(&mut grid, step, [8, 128, 4096][size], value, is_active);
                    });
                grid
            })
    })
}

/// Adds a tile unless it shares voxels with what is there.
fn put_tile(grid: &mut SampleGrid, step: [i32; 3], side: i32, value: SampleValue, is_active: bool) {
    // A few thousand voxels off, so that most tiles stay clear of voxels.
    let origin = step.map(|part| part * side + if side < 4096 { 1024 } else { 4096 * 4 });
    let meets = |other: [i32; 3], other_side: i32| {
        let side = side.max(other_side);
        (0..3).all(|axis| origin[axis] & -side == other[axis] & -side)
    };
    let is_free = !grid.tiles.iter().any(|tile| meets(tile.0, tile.1))
        && !grid.voxels.keys().any(|&index| meets(index, 8));
    if is_free {
        grid.tiles.push((origin, side, value, is_active));
    }
}

fn packing() -> impl Strategy<Value = (u32, Packing, bool)> {
    let packing = prop_oneof![
        Just(Packing::Plain),
        Just(Packing::Zip),
        Just(Packing::Blosc)
    ];
    (220..=224u32, packing, any::<bool>()).prop_map(|(version, packing, leaves_out)| {
        match (version, packing) {
            (..222, Packing::Blosc) => (version, Packing::Zip, false),
            (..222, _) => (version, packing, false),
            _ => (version, packing, leaves_out),
        }
    })
}

/// Every index at which something may go wrong: all voxels, their neighbours, corners of tiles.
fn probes(grid: &SampleGrid) -> Vec<[i32; 3]> {
    let voxels = grid
        .voxels
        .keys()
        .flat_map(|&[x, y, z]| [[x, y, z], [x, y, z ^ 1], [x ^ 8, y, z], [x, y ^ 16, z ^ 8]]);
    let tiles = grid.tiles.iter().flat_map(|&(origin, side, ..)| {
        let high = origin.map(|part| part + side - 1);
        [
            origin,
            high,
            origin.map(|part| part - 1),
            high.map(|part| part.wrapping_add(1)),
        ]
    });
    voxels
        .chain(tiles)
        .chain([[0; 3], [i32::MIN; 3], [i32::MAX; 3]])
        .collect()
}

fn assert_same<V: Voxel>(read: &Grid<V>, sample: &SampleGrid, of: impl Fn(SampleValue) -> V) {
    assert_eq!(read.background(), of(sample.background));
    for index in probes(sample) {
        let (value, is_active) = sample.find(index);
        assert_eq!(
            (read.value(index), read.is_active(index)),
            (of(value), is_active),
            "{index:?}"
        );
        let low = index.map(|part| part.saturating_sub(2));
        let dense = read.dense(low, [5, 3, 4]).expect("it fits");
        for (place, &dense) in dense.iter().enumerate() {
            let offset = [place / 12, place / 4 % 3, place % 4];
            let wide: [i64; 3] =
                std::array::from_fn(|axis| i64::from(low[axis]) + offset[axis] as i64);
            // Beyond the last index there is nothing but background.
            let index = wide.map(|part| i32::try_from(part).ok());
            let wanted = match index {
                [Some(x), Some(y), Some(z)] => sample.find([x, y, z]).0,
                _ => sample.background,
            };
            assert_eq!(dense, of(wanted), "{wide:?}");
        }
    }
    assert_bounds(read, sample);
}

fn assert_bounds<V: Voxel>(read: &Grid<V>, sample: &SampleGrid) {
    let voxels = sample
        .voxels
        .iter()
        .filter(|(_, voxel)| voxel.1)
        .map(|(&index, _)| (index, 1));
    let tiles = sample
        .tiles
        .iter()
        .filter(|tile| tile.3)
        .map(|tile| (tile.0, tile.1));
    let active: Vec<_> = voxels.chain(tiles).collect();
    let bounds = read.active_bounds();
    assert_eq!(bounds.is_none(), active.is_empty());
    if let Some(bounds) = bounds {
        for axis in 0..3 {
            assert_eq!(
                Some(bounds.low[axis]),
                active.iter().map(|cube| cube.0[axis]).min()
            );
            assert_eq!(
                Some(bounds.high[axis]),
                active.iter().map(|cube| cube.0[axis] + (cube.1 - 1)).max()
            );
        }
    }
    let count: u64 = active.iter().map(|cube| (cube.1 as u64).pow(3)).sum();
    assert_eq!(read.active_voxel_count(), count);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, max_shrink_iters: 200, ..ProptestConfig::default() })]

    #[test]
    fn what_was_written_is_read(
        (version, packing, leaves_out_inactive) in packing(), is_stream: bool,
        grids in prop::collection::vec(grid(), 1..3),
    ) {
        let sample = Sample { version, packing, leaves_out_inactive, is_stream, grids };
        let bytes = sample.bytes();
        let file = read(&bytes, &Limits::default()).unwrap();
        for (place, grid) in sample.grids.iter().enumerate() {
            if grid.kind.is_vector() {
                assert_same(&file.vector_at(place).unwrap(), grid, |value| value);
            } else {
                assert_same(&file.scalar_at(place).unwrap(), grid, |value| value[0]);
            }
        }
    }
}

#[test]
fn values_that_are_no_numbers_are_handed_on() {
    let mut grid = SampleGrid::new("grid", ValueType::Float);
    grid.background = [f32::NAN; 3];
    grid.voxels
        .insert([1, 2, 3], ([f32::INFINITY, 0.0, 0.0], true));
    let bytes = Sample::new(vec![grid]).bytes();
    let file = read(&bytes, &Limits::default()).unwrap();
    let grid = file.scalar("grid").unwrap();
    assert_eq!(grid.value([1, 2, 3]), f32::INFINITY);
    assert!(grid.value([0; 3]).is_nan());
    // Although NaN differs from itself, no tile is kept for it.
    assert!(grid.tiles().is_empty());
}

#[test]
fn memory_beyond_the_limit_is_refused_before_it_is_taken() {
    let bytes = Sample::puff().bytes();
    let fault = |memory_bytes| {
        read(&bytes, &Limits { memory_bytes })
            .unwrap()
            .scalar("density")
            .map(|_| ())
    };
    assert!(matches!(
        fault(1000),
        Err(Fault::Memory { limit: 1000, .. })
    ));
    assert!(matches!(
        fault(60_000),
        Err(Fault::Memory { what: "values", .. })
    ));
    assert_eq!(fault(1 << 20), Ok(()));
    let file = read(&bytes, &Limits::default()).unwrap();
    let dense = file.scalar("density").unwrap().dense([0; 3], [4000; 3]);
    assert!(
        matches!(
            dense,
            Err(Fault::Memory {
                what: "a dense grid",
                ..
            })
        ),
        "{dense:?}"
    );
    let endless = file
        .scalar("density")
        .unwrap()
        .dense([0; 3], [usize::MAX; 3]);
    assert!(matches!(
        endless,
        Err(Fault::Memory {
            bytes: u64::MAX,
            ..
        })
    ));
}

#[test]
fn a_transform_moves_voxels_into_the_world() {
    let mut grid = SampleGrid::new("grid", ValueType::Float);
    let axes = [[0.0, 2.0, 0.0], [-3.0, 0.0, 0.0], [0.0, 0.0, 4.0]];
    grid.transform = Transform::new(axes, [5.0, 6.0, 7.0]).unwrap();
    let bytes = Sample::new(vec![grid.clone()]).bytes();
    let file = read(&bytes, &Limits::default()).unwrap();
    assert_eq!(file.grids()[0].transform, Ok(grid.transform));
}
