//! Says what is in each OpenVDB file named on the command line.
//!
//! `cargo run --example list -- smoke.vdb`

use npr_vdb::{Fault, File, Limits, Values, read};

fn main() -> std::io::Result<()> {
    for name in std::env::args().skip(1) {
        let bytes = std::fs::read(&name)?;
        match read(&bytes, &Limits::default()) {
            Ok(file) => list(&name, &file),
            Err(fault) => println!("{name}: {fault}"),
        }
    }
    Ok(())
}

fn list(name: &str, file: &File) {
    println!("{name}: format {}", file.version());
    for (place, info) in file.grids().iter().enumerate() {
        let half = if info.is_half { " as half floats" } else { "" };
        println!("  '{}' {}{half}, {:?}", info.name, info.values, info.class);
        match contents(file, place, &info.values) {
            Ok(contents) => println!("    {contents}"),
            Err(fault) => println!("    {fault}"),
        }
    }
}

/// How many voxels are active, and where.
fn contents(file: &File, place: usize, values: &Values) -> Result<String, Fault> {
    let is_vector = matches!(values, Values::Known(known) if known.is_vector());
    let (count, bounds, transform) = if is_vector {
        let grid = file.vector_at(place)?;
        (
            grid.active_voxel_count(),
            grid.active_bounds(),
            *grid.index_to_world(),
        )
    } else {
        let grid = file.scalar_at(place)?;
        (
            grid.active_voxel_count(),
            grid.active_bounds(),
            *grid.index_to_world(),
        )
    };
    let box_ = bounds.map_or(String::new(), |bounds| {
        format!(" from {:?} to {:?}", bounds.low, bounds.high)
    });
    Ok(format!(
        "{count} active voxels{box_}, voxel size {:?}",
        transform.voxel_size()
    ))
}
