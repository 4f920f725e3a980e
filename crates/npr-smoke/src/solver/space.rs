//! Where the cells of the solver lie in the world.

use glam::{DAffine3, DMat3, DVec3};

/// Cells in one box length.
pub(super) fn box_cells(size: [u32; 3]) -> f32 {
    size[0].max(size[1]).max(size[2]) as f32
}

/// The world from cells: z becomes y, so that smoke rises as figures stand.
pub(super) fn index_to_world(size: [u32; 3]) -> DAffine3 {
    let cell = 1.0 / f64::from(box_cells(size));
    let [width, depth, _] = size.map(f64::from);
    let axes = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y) * cell;
    let origin = DVec3::new(0.5 - width / 2.0, 0.5, depth / 2.0 - 0.5) * cell;
    DAffine3::from_mat3_translation(axes, origin)
}
