//! Volumes from files against the files' own values, voxel by voxel.

use super::*;
use crate::Mended;
use glam::{DAffine3, Vec3};
use npr_vdb::testing::{Sample, SampleGrid, npy_file};
use npr_vdb::{Fault, Transform, ValueType};
use proptest::prelude::*;

fn grid(name: &str, kind: ValueType, voxels: &[([i32; 3], [f32; 3])]) -> SampleGrid {
    let mut grid = SampleGrid::new(name, kind);
    let stored = voxels.iter().map(|(index, value)| (*index, (*value, true)));
    grid.voxels.extend(stored);
    grid
}

/// A grid of one thick voxel.
fn speck(name: &str) -> SampleGrid {
    grid(name, ValueType::Float, &[([0; 3], [1.0, 0.0, 0.0])])
}

fn read(grids: Vec<SampleGrid>, options: &VolumeOptions) -> Result<Volume, VolumeFault> {
    let file = VolumeFile::read(&Sample::new(grids).bytes(), options)?;
    file.volume(&file.extent())
}

fn usual(grids: Vec<SampleGrid>) -> Result<Volume, VolumeFault> {
    read(grids, &VolumeOptions::default())
}

/// Places of voxels, some negative and some in other leaves.
fn places() -> impl Strategy<Value = Vec<([i32; 3], f32)>> {
    let place = (prop::array::uniform3(-9i32..12), 0.25f32..4.0);
    prop::collection::vec(place, 1..12)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]
    #[test]
    fn every_voxel_lies_where_the_file_puts_it(
        places in places(), scale in 0.1f64..3.0, shift in prop::array::uniform3(-5.0f64..5.0), z_up: bool,
    ) {
        let voxels: Vec<_> = places.iter().map(|(index, value)| (*index, [*value, 0.0, 0.0])).collect();
        let mut density = grid("density", ValueType::Float, &voxels);
        let axes = [[scale, 0.0, 0.0], [0.0, scale, 0.0], [0.0, 0.0, scale]];
        density.transform = Transform::new(axes, shift).unwrap();
        let sample = density.clone();
        let up = if z_up { UpAxis::Z } else { UpAxis::Y };
        let volume = read(vec![density], &VolumeOptions { up, ..VolumeOptions::default() }).unwrap();
        for (index, _) in &places {
            let [x, y, z] = sample.transform.point(index.map(f64::from)).map(|part| part as f32);
            let world = if z_up { Vec3::new(x, z, -y) } else { Vec3::new(x, y, z) };
            let found = volume.density_at(volume.index_from_world(world));
            prop_assert!((found - sample.find(*index).0[0]).abs() < 1e-3, "{found} at {index:?}");
        }
        let expected: f32 = sample.voxels.values().map(|(value, _)| value[0]).sum();
        let sum: f32 = volume.density().iter().sum();
        prop_assert!((sum - expected).abs() < 1e-3 * expected);
    }

    #[test]
    fn a_box_holds_what_both_of_its_parts_hold(
        lows in prop::array::uniform2(prop::array::uniform3(-100i32..100)),
        sizes in prop::array::uniform2(prop::array::uniform3(0usize..50)),
    ) {
        let extent = |at: usize| Extent { low: lows[at], size: sizes[at], world_from_index: DAffine3::IDENTITY };
        let parts = [extent(0), extent(1)];
        let all = parts[0].union(&parts[1]).unwrap();
        let ends = |extent: &Extent, axis: usize| {
            (i64::from(extent.low[axis]), i64::from(extent.low[axis]) + extent.size[axis] as i64)
        };
        for axis in 0..3 {
            let full: Vec<_> = parts.iter().filter(|part| !part.is_empty()).map(|part| ends(part, axis)).collect();
            if let Some(low) = full.iter().map(|end| end.0).min() {
                let high = full.iter().map(|end| end.1).max().unwrap();
                prop_assert_eq!(ends(&all, axis), (low, high));
            }
        }
    }

    #[test]
    fn broken_files_end_in_a_fault(cut in 0usize..3000, at in 0usize..3000, byte: u8) {
        let mut bytes = Sample::new(vec![speck("density"), speck("heat")]).bytes();
        bytes.truncate(bytes.len().saturating_sub(cut));
        if let Some(broken) = bytes.get_mut(at) {
            *broken = byte;
        }
        let options = VolumeOptions { memory_limit: 1 << 20, ..VolumeOptions::default() };
        if let Ok(file) = VolumeFile::read(&bytes, &options) {
            let _ = file.volume(&file.extent());
        }
    }
}

#[test]
fn grids_are_found_by_usual_names_whatever_the_case() {
    let vectors = grid("Vel", ValueType::Vec3s, &[([0; 3], [1.0, 2.0, 3.0])]);
    let volume = usual(vec![
        speck("other"),
        speck("Density"),
        vectors,
        speck("HEAT"),
    ])
    .unwrap();
    assert_eq!(volume.velocity().unwrap(), [Vec3::new(1.0, 2.0, 3.0)]);
    assert_eq!(volume.temperature().unwrap(), [1.0]);
}

#[test]
fn three_grids_of_components_are_one_of_velocities() {
    let part =
        |name: &str, value: f32| grid(name, ValueType::Float, &[([0; 3], [value, 0.0, 0.0])]);
    let grids = vec![
        part("vel.z", 3.0),
        part("vel.x", 1.0),
        part("vel.y", 2.0),
        speck("density"),
    ];
    let volume = usual(grids.clone()).unwrap();
    assert_eq!(volume.velocity().unwrap(), [Vec3::new(1.0, 2.0, 3.0)]);
    let velocity = ["vel.y", "vel.x", "vel.z"].map(str::to_owned).to_vec();
    let options = VolumeOptions {
        velocity,
        ..VolumeOptions::default()
    };
    let volume = read(grids, &options).unwrap();
    assert_eq!(volume.velocity().unwrap(), [Vec3::new(2.0, 1.0, 3.0)]);
}

#[test]
fn velocities_turn_with_their_file() {
    let vectors = grid("v", ValueType::Vec3s, &[([0; 3], [1.0, 2.0, 3.0])]);
    let options = VolumeOptions {
        up: UpAxis::Z,
        ..VolumeOptions::default()
    };
    let volume = read(vec![speck("density"), vectors], &options).unwrap();
    assert_eq!(volume.velocity().unwrap(), [Vec3::new(1.0, 3.0, -2.0)]);
}

#[test]
fn grids_of_another_size_are_looked_up_by_place() {
    let mut heat = grid("heat", ValueType::Float, &[([1, 0, 0], [5.0, 0.0, 0.0])]);
    let axes = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
    heat.transform = Transform::new(axes, [0.0; 3]).unwrap();
    let thick = |x: i32| ([x, 0, 0], [1.0, 0.0, 0.0]);
    let density = grid(
        "density",
        ValueType::Float,
        &[thick(0), thick(1), thick(2), thick(4)],
    );
    let volume = usual(vec![density, heat]).unwrap();
    let heat_at = |x: f32| volume.temperature_at(volume.index_from_world(Vec3::new(x, 0.0, 0.0)));
    assert_eq!([heat_at(0.0), heat_at(2.0), heat_at(4.0)], [0.0, 5.0, 0.0]);
}

#[test]
fn the_only_grid_that_can_be_is_taken_and_told() {
    let bytes = Sample::new(vec![speck("soot")]).bytes();
    let file = VolumeFile::read(&bytes, &VolumeOptions::default()).unwrap();
    assert_eq!(file.notices(), ["grid 'soot' is taken for the densities"]);
    let fault = usual(vec![speck("soot"), speck("ash")]).unwrap_err();
    assert_eq!(
        fault.to_string(),
        "no grid is called density; name one of 'soot', 'ash'"
    );
    let options = VolumeOptions {
        density: Some("ash".to_owned()),
        ..VolumeOptions::default()
    };
    assert!(read(vec![speck("soot"), speck("ash")], &options).is_ok());
    let options = VolumeOptions {
        density: Some("dust".to_owned()),
        ..VolumeOptions::default()
    };
    assert!(matches!(
        read(vec![speck("soot")], &options),
        Err(VolumeFault::Read(Fault::NoGrid { .. }))
    ));
}

#[test]
fn boxes_beyond_the_limits_are_refused_before_they_are_made() {
    let far = |end: i32| {
        let ends = [([0; 3], [1.0, 0.0, 0.0]), ([end; 3], [1.0, 0.0, 0.0])];
        vec![grid("density", ValueType::Float, &ends)]
    };
    for end in [4000, 1_000_000_000] {
        let fault = usual(far(end)).unwrap_err();
        assert!(matches!(fault, VolumeFault::TooLarge { .. }), "{fault}");
        assert!(fault.is_limit() && !fault.is_memory());
    }
    let options = VolumeOptions {
        memory_limit: 1 << 20,
        ..VolumeOptions::default()
    };
    let fault = read(far(200), &options).unwrap_err();
    assert!(fault.is_limit() && fault.is_memory(), "{fault}");
}

#[test]
fn what_is_no_number_becomes_nothing_and_is_told() {
    let hostile = [f32::NAN, f32::INFINITY, -1.0, 2.0];
    let voxels: Vec<_> = (0..4)
        .map(|x| ([x, 0, 0], [hostile[x as usize], 0.0, 0.0]))
        .collect();
    let volume = usual(vec![grid("density", ValueType::Float, &voxels)]).unwrap();
    assert_eq!(volume.density(), [0.0, 0.0, 0.0, 2.0]);
    let notice = volume.mended().notice().unwrap();
    assert_eq!(
        notice,
        "3 densities that are negative or no numbers count as 0"
    );
    assert_eq!(Mended::default().notice(), None);
}

fn array(shape: &str, values: &[f32]) -> Vec<u8> {
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}");
    let bytes: Vec<u8> = values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    npy_file(&header, &bytes)
}

#[test]
fn an_array_stands_on_the_floor() {
    let bytes = array("(1, 4, 2)", &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    let file = VolumeFile::read(&bytes, &VolumeOptions::default()).unwrap();
    let (low, high) = file.extent().bounds().unwrap();
    assert_eq!((low, high), ([-0.125, 0.0, -0.25], [0.125, 1.0, 0.25]));
    let volume = file.volume(&file.extent()).unwrap();
    let at = |y: f32, z: f32| volume.density_at(volume.index_from_world(Vec3::new(0.0, y, z)));
    assert_eq!(
        [at(0.125, -0.125), at(0.125, 0.125), at(0.875, 0.125)],
        [0.0, 1.0, 7.0]
    );
}

#[test]
fn arrays_that_hold_no_densities_are_refused() {
    let fault = VolumeFile::read(&array("(1, 1, 1, 3)", &[0.0; 3]), &VolumeOptions::default());
    assert_eq!(fault.unwrap_err(), VolumeFault::Vectors);
    assert!(VolumeFile::read(b"a text", &VolumeOptions::default()).is_err());
    assert!(VolumeFile::read(b"", &VolumeOptions::default()).is_err());
    let empty = VolumeFile::read(&array("(0, 3, 3)", &[]), &VolumeOptions::default()).unwrap();
    assert!(empty.volume(&empty.extent()).unwrap().is_empty());
}
