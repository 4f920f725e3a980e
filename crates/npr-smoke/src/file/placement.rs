//! Where the grids and arrays of files stand in the world, and their values there.

use super::{Extent, UpAxis, VolumeFault};
use glam::{DAffine3, DVec3};
use npr_vdb::{Grid, Transform, Voxel};

/// A transform of a file as a matrix.
pub(super) fn affine(transform: &Transform) -> DAffine3 {
    let [x, y, z, origin] = transform.columns().map(DVec3::from_array);
    DAffine3::from_cols(x, y, z, origin)
}

/// Where an array stands: on the floor, centred over the origin, its longest side 1 unit, as the built-in smoke does.
pub(super) fn array_placement(size: [usize; 3], up: UpAxis) -> DAffine3 {
    let voxel = 1.0 / size.iter().copied().max().unwrap_or(0).max(1) as f64;
    let size = DVec3::from_array(size.map(|side| side as f64));
    let middle = (size - 1.0) / 2.0;
    let floor = match up {
        UpAxis::Y => DVec3::new(middle.x, -0.5, middle.z),
        UpAxis::Z => DVec3::new(middle.x, middle.y, -0.5),
    };
    up.turn() * DAffine3::from_scale(DVec3::splat(voxel)) * DAffine3::from_translation(-floor)
}

/// Values of a grid at the voxels of a box, z fastest; of a grid that lies elsewhere, those of the nearest voxels.
pub(super) fn lookup<V: Voxel>(
    grid: &Grid<V>,
    extent: &Extent,
    up: UpAxis,
) -> Result<Vec<V>, VolumeFault> {
    let own = up.turn() * affine(grid.index_to_world());
    if own == extent.world_from_index {
        return Ok(grid.dense(extent.low, extent.size)?);
    }
    let own_from_index = own.inverse() * extent.world_from_index;
    let places = indices(extent).map(|index| {
        let place = own_from_index.transform_point3(DVec3::from_array(index.map(f64::from)));
        // A float beyond the range becomes the nearest integer.
        grid.value(place.round().to_array().map(|part| part as i32))
    });
    Ok(places.collect())
}

/// Indices of a box, z fastest.
fn indices(extent: &Extent) -> impl Iterator<Item = [i32; 3]> + '_ {
    let along = |axis: usize| {
        let low = extent.low[axis];
        (0..extent.size[axis]).map(move |step| low.saturating_add(step as i32))
    };
    along(0).flat_map(move |x| along(1).flat_map(move |y| along(2).map(move |z| [x, y, z])))
}
