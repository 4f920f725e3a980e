//! Volumes and thread pools for tests.

use glam::{DAffine3, Vec3};

use crate::Volume;

/// A soft ball of density 1 in the middle and 0 at the border.
pub fn blob(size: [u32; 3], index_to_world: DAffine3) -> Volume {
    let middle = Vec3::from_array(size.map(|side| (side as f32 - 1.0) / 2.0));
    let mut density = Vec::new();
    for z in 0..size[2] {
        for y in 0..size[1] {
            for x in 0..size[0] {
                let away = (Vec3::new(x as f32, y as f32, z as f32) - middle) / (middle + 0.5);
                density.push((1.2 - away.length()).clamp(0.0, 1.0));
            }
        }
    }
    Volume::new(size, density, index_to_world).expect("one density per voxel")
}

/// What `work` gives in a pool of so many threads.
pub fn in_pool<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().expect("threads can be started").install(work)
}
