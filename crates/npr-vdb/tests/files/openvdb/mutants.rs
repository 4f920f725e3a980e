//! Damaged files never panic, and take no more memory than they are allowed.

use npr_vdb::testing::{Packing, Sample, SampleGrid};
use npr_vdb::{File, Grid, Limits, ValueType, Values, Voxel, read};
use proptest::prelude::*;

use super::unpacked;

/// What happens to a few bytes of a file.
#[derive(Debug, Clone)]
enum Damage {
    Set(usize, u8),
    Flip(usize, u8),
    /// Four bytes: a count, a length or half an offset.
    Forge(usize, u32),
    Cut(usize),
    Repeat(usize, usize),
}

fn damage() -> impl Strategy<Value = Damage> {
    let forged = prop_oneof![
        Just(u32::MAX),
        Just(0),
        Just(1 << 31),
        Just(1 << 20),
        any::<u32>(),
        0..5000u32
    ];
    prop_oneof![
        3 => (any::<usize>(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        3 => (any::<usize>(), 0u8..8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        3 => (any::<usize>(), forged).prop_map(|(at, number)| Damage::Forge(at, number)),
        1 => any::<usize>().prop_map(Damage::Cut),
        1 => (any::<usize>(), 1usize..40).prop_map(|(at, count)| Damage::Repeat(at, count)),
    ]
}

/// Places where damage tells: where bytes differ from those before, so not within the long runs of zeros that masks
/// are.
fn telling_places(file: &[u8]) -> Vec<usize> {
    let telling = |&at: &usize| at == 0 || file[at] != 0 || file[at - 1] != 0 || at % 61 == 0;
    (0..file.len()).filter(telling).collect()
}

fn damaged(file: &[u8], places: &[usize], damages: &[Damage]) -> Vec<u8> {
    let mut file = file.to_vec();
    for damage in damages {
        let place = |at: usize| places[at % places.len()].min(file.len().saturating_sub(1));
        match *damage {
            _ if file.is_empty() => {}
            Damage::Set(at, byte) => {
                let at = place(at);
                file[at] = byte;
            }
            Damage::Flip(at, bit) => {
                let at = place(at);
                file[at] ^= 1 << bit;
            }
            Damage::Forge(at, number) => {
                let at = place(at);
                let bytes = file[at..].iter_mut().zip(number.to_le_bytes());
                bytes.for_each(|(byte, new)| *byte = new);
            }
            Damage::Cut(at) => {
                let length = place(at);
                file.truncate(length);
            }
            Damage::Repeat(at, count) => {
                let start = place(at);
                let piece = file[start..file.len().min(start + count)].to_vec();
                file.splice(start..start, piece);
            }
        }
    }
    file
}

/// Reads everything; what is read is sound, whatever its values are.
fn survives(file: &[u8]) {
    let limits = Limits {
        memory_bytes: 8 << 20,
    };
    let Ok(file) = read(file, &limits) else {
        return;
    };
    for (place, info) in file.grids().iter().enumerate() {
        match &info.values {
            Values::Known(kind) if kind.is_vector() => vector_is_sound(&file, place),
            _ => scalar_is_sound(&file, place),
        }
    }
}

fn scalar_is_sound(file: &File, place: usize) {
    if let Ok(grid) = file.scalar_at(place) {
        is_sound(&grid);
    }
}

fn vector_is_sound(file: &File, place: usize) {
    if let Ok(grid) = file.vector_at(place) {
        is_sound(&grid);
    }
}

fn is_sound<V: Voxel>(grid: &Grid<V>) {
    grid.sanity_check();
    if let Some(bounds) = grid.active_bounds() {
        let _ = grid.dense(bounds.low, bounds.size());
    }
}

/// A few voxels whose inactive neighbours are left out in every way there is, and a tile.
fn small(kind: ValueType) -> SampleGrid {
    let mut grid = SampleGrid::new("grid", kind);
    grid.background = [1.0, 0.0, 1.0];
    for place in 0..40 {
        let value = (place % 7) as f32 - 1.0;
        grid.voxels.insert(
            [place * 3 % 20, place % 4, place % 9],
            ([value.abs(); 3], place % 3 > 0),
        );
    }
    grid.tiles.push(([64, 0, 0], 8, [1.0; 3], true));
    grid
}

fn sample(version: u32, packing: Packing, kinds: &[ValueType]) -> Vec<u8> {
    let mut sample = Sample::new(kinds.iter().map(|&kind| small(kind)).collect());
    (sample.version, sample.packing) = (version, packing);
    sample.leaves_out_inactive = version >= 222;
    sample.bytes()
}

macro_rules! mutants {
    ($($name:ident: $file:expr;)*) => {
        $(
            #[test]
            fn $name() {
                let file: Vec<u8> = $file;
                survives(&file);
                let places = telling_places(&file);
                let config = ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() };
                proptest!(config, |(damages in prop::collection::vec(damage(), 1..4))| {
                    survives(&damaged(&file, &places, &damages));
                });
            }
        )*
    };
}

mutants! {
    floats_of_the_oldest_version: sample(220, Packing::Zip, &[ValueType::Float]);
    floats_in_zip: sample(222, Packing::Zip, &[ValueType::Float]);
    floats_in_blosc: sample(224, Packing::Blosc, &[ValueType::Float, ValueType::Bool]);
    vectors_in_zip: sample(224, Packing::Zip, &[ValueType::Vec3s]);
    openvdb_tiles: unpacked("tiles_blosc");
    openvdb_half_tiles: unpacked("tiles_half_masks");
    openvdb_kinds: unpacked("kinds_half_blosc");
    openvdb_instances: unpacked("instances_blosc");
    openvdb_stream: unpacked("stream_masks");
    openvdb_numbers: unpacked("numbers_masks");
    openvdb_vectors: unpacked("vectors_blosc");
    openvdb_maps: unpacked("maps_blosc");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_behind_the_mark(bytes in prop::collection::vec(any::<u8>(), 0..300), version in 218u8..226) {
        let mut file = b" BDV\0\0\0\0".to_vec();
        file.extend([version, 0, 0, 0]);
        file.extend(bytes);
        survives(&file);
    }
}
