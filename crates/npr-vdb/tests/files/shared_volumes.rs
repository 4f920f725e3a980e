//! Real volumes read as the arrays beside them say, and broken ones are refused.

use std::path::{Path, PathBuf};

use npr_vdb::{Bounds, GridClass, Limits, npy, read};

fn folder(name: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/assets")
        .join(name);
    if !folder.is_dir() {
        eprintln!("skipped: the shared {name} are not beside this checkout");
        return None;
    }
    Some(folder)
}

fn bytes(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).unwrap_or_else(|fault| panic!("{name}: {fault}"))
}

#[test]
fn densities_equal_their_arrays_voxel_by_voxel() {
    let Some(folder) = folder("volumes") else {
        return;
    };
    let cases = [
        (
            "smoke_blender.vdb",
            "smoke_blender_density.npy",
            [1, 1, 11],
            71_983,
        ),
        (
            "plume_seq/plume_0008.vdb",
            "plume_0008_density.npy",
            [14, 2, 13],
            30_984,
        ),
    ];
    for (volume, array, low, active_count) in cases {
        let file = bytes(&folder, volume);
        let grid = read(&file, &Limits::default()).and_then(|file| file.scalar("density"));
        let grid = grid.unwrap_or_else(|fault| panic!("{volume}: {fault}"));
        let array = npy::read(&bytes(&folder, array), &Limits::default()).expect("a sound array");
        let npy::Values::Scalars(wanted) = array.values else {
            panic!("no numbers")
        };
        let bounds = grid.active_bounds().expect("smoke");
        assert_eq!((bounds.low, bounds.size()), (low, array.size), "{volume}");
        assert_eq!(grid.active_voxel_count(), active_count);
        let dense = grid.dense(low, array.size).expect("it fits");
        assert!(dense == wanted, "{volume}");
        let [_, y_side, z_side] = array.size;
        for (place, &value) in wanted.iter().enumerate() {
            let steps = [
                place / z_side / y_side,
                place / z_side % y_side,
                place % z_side,
            ];
            let index = std::array::from_fn(|axis| low[axis] + steps[axis] as i32);
            assert_eq!(grid.value(index), value, "{volume} {index:?}");
        }
    }
}

#[test]
fn every_volume_is_as_its_list_says() {
    let Some(folder) = folder("volumes") else {
        return;
    };
    let cases = [
        (
            "smoke_tall_houdini.vdb",
            "density",
            1_049_275,
            GridClass::FogVolume,
        ),
        (
            "smoke_blender_empty_frame.vdb",
            "density",
            0,
            GridClass::Unset,
        ),
        ("density_and_heat.vdb", "density", 6_124, GridClass::Unset),
        ("density_and_heat.vdb", "heat", 5_224, GridClass::Unset),
        (
            "sphere_levelset_houdini.vdb",
            "ls_sphere",
            270_638,
            GridClass::LevelSet,
        ),
        (
            "plume_seq/plume_0001.vdb",
            "density",
            11_378,
            GridClass::FogVolume,
        ),
    ];
    for (name, grid, active_count, class) in cases {
        let file = bytes(&folder, name);
        let grid = read(&file, &Limits::default()).and_then(|file| file.scalar(grid));
        let grid = grid.unwrap_or_else(|fault| panic!("{name}: {fault}"));
        assert_eq!(
            (grid.active_voxel_count(), grid.info().class),
            (active_count, class),
            "{name}"
        );
        assert_eq!(grid.active_bounds(), grid.info().stated_bounds, "{name}");
    }
}

#[test]
fn values_above_one_and_vectors_are_kept() {
    let Some(folder) = folder("volumes") else {
        return;
    };
    let file = bytes(&folder, "smoke_tall_houdini.vdb");
    let file = read(&file, &Limits::default()).expect("a sound file");
    let density = file.scalar("density").expect("a sound grid");
    let bounds = Bounds {
        low: [1, 2, 1],
        high: [111, 223, 112],
    };
    assert_eq!(
        (file.version(), density.active_bounds()),
        (222, Some(bounds))
    );
    let values = density.leaves().flat_map(|leaf| leaf.values);
    let most = values.fold(0.0, |most: f32, &value| most.max(value));
    assert!((most - 5.71).abs() < 0.01, "{most}");

    let file = bytes(&folder, "plume_seq/plume_0008.vdb");
    let velocity = read(&file, &Limits::default()).and_then(|file| file.vector("vel"));
    let velocity = velocity.expect("a sound grid");
    assert!(
        velocity
            .leaves()
            .all(|leaf| leaf.values.iter().flatten().all(|part| part.is_finite()))
    );
    assert!(velocity.active_voxel_count() > 10_000);
}

#[test]
fn points_are_named_as_what_they_are() {
    let Some(folder) = folder("volumes") else {
        return;
    };
    let file = bytes(&folder, "points_unsupported_type.vdb");
    let file = read(&file, &Limits::default()).expect("a sound file");
    let fault = file.scalar("points").expect_err("no numbers");
    assert_eq!(
        fault.to_string(),
        "grid 'points' has type Tree_ptdataidx32_5_4_3, which is not read"
    );
}

#[test]
fn broken_files_say_why() {
    let Some(folder) = folder("malformed") else {
        return;
    };
    let cases = [
        ("volume_bad_magic.vdb", "this is no OpenVDB file"),
        ("volume_text.vdb", "this is no OpenVDB file"),
        ("volume_zero_bytes.vdb", "this is no OpenVDB file"),
        (
            "volume_header_only.vdb",
            "metadata goes on beyond byte 60, where the data ends",
        ),
        (
            "volume_truncated_half.vdb",
            "a grid goes on beyond byte 37357, where the data ends",
        ),
    ];
    for (name, wanted) in cases {
        let file = bytes(&folder.join("made"), name);
        let fault = read(&file, &Limits::default()).map(|_| ()).expect_err(name);
        assert_eq!(fault.to_string(), wanted, "{name}");
    }
}

#[test]
fn whatever_a_real_file_is_cut_to_is_refused() {
    let Some(folder) = folder("volumes") else {
        return;
    };
    let file = bytes(&folder, "density_and_heat.vdb");
    for length in (0..file.len()).step_by(97) {
        assert!(
            read(&file[..length], &Limits::default()).is_err(),
            "{length}"
        );
    }
}
