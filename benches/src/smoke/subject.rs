//! Smoke to measure with: the built-in plume, volumes from files, and cameras that see all of it.

use std::error::Error;
use std::path::Path;

use glam::{DAffine3, DVec3, Vec3};
use npr_core::camera::{Camera, DEFAULT_FOV_DEG};
use npr_render::{Following, Smoke};
use npr_smoke::{Puffs, SmokeSettings, Source, Sphere, Volume};
use npr_stylesheet::Style;
use npr_vdb::{Limits, read};

use crate::orbit::turned;

/// The built-in plume on a grid.
pub fn plume(size: [u32; 3]) -> SmokeSettings {
    SmokeSettings {
        size,
        ..SmokeSettings::of(Source::Plume)
    }
}

/// The volume of the grid `density` of an OpenVDB file, cut to what is active.
///
/// # Errors
///
/// Whatever reading says; a grid in which nothing is active.
pub fn volume_of(path: &Path) -> Result<Volume, Box<dyn Error>> {
    // Read the densities of the box in which any are active.
    let bytes = std::fs::read(path)?;
    let grid = read(&bytes, &Limits::default())?.scalar("density")?;
    let bounds = grid.active_bounds().ok_or("nothing is active")?;
    let size = bounds.size();
    let dense = grid.dense(bounds.low, size)?;

    // Put them in the order of volumes.
    let [width, height, depth] = size;
    let mut density = Vec::with_capacity(dense.len());
    for z in 0..depth {
        for y in 0..height {
            density.extend((0..width).map(|x| dense[(x * height + y) * depth + z]));
        }
    }

    // Place the box in the world.
    let [x, y, z, origin] = grid.index_to_world().columns().map(DVec3::from);
    let low = DVec3::from(bounds.low.map(f64::from));
    let to_world = DAffine3::from_cols(x, y, z, origin);
    let to_world = to_world * DAffine3::from_translation(low);
    Ok(Volume::new(
        size.map(|side| side as u32),
        density,
        to_world,
    )?)
}

/// Spheres as they are drawn, in the space of their volume.
pub fn drawn(spheres: &[Sphere], volume: &Volume) -> Smoke {
    let puff = |sphere: &Sphere| npr_render::Sphere {
        heat: sphere.temperature,
        ..npr_render::Sphere::new(sphere.center.to_array(), sphere.radius)
    };
    Smoke {
        spheres: spheres.iter().map(puff).collect(),
        space: Some(space_of(volume)),
    }
}

/// Lowest and highest corner of a volume in the world.
pub fn space_of(volume: &Volume) -> ([f32; 3], [f32; 3]) {
    let size = volume.size();
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for corner in 0..8 {
        let index = Vec3::from_array(std::array::from_fn(|axis| {
            let far = (corner >> axis) & 1 == 1;
            if far { size[axis] as f32 - 0.5 } else { -0.5 }
        }));
        let world = volume.world_from_index(index);
        (low, high) = (low.min(world), high.max(world));
    }
    (low.to_array(), high.to_array())
}

/// A camera before a space, turned about the upright axis through its middle by some degrees.
pub fn camera(space: ([f32; 3], [f32; 3]), size: [u32; 2], degrees: f32) -> Camera {
    let aspect = size[0] as f32 / size[1] as f32;
    let fov_y = DEFAULT_FOV_DEG.to_radians();
    let camera = Camera::framing_for(space.0, space.1, aspect, fov_y);
    let middle = (Vec3::from(space.0) + Vec3::from(space.1)) * 0.5;
    turned(camera, middle, degrees)
}

/// The built-in plume of 30 x 30 x 60 cells from its 24th frame on, followed by the spheres of a style from its first.
pub struct Film {
    /// The smoke.
    pub smoke: npr_smoke::Smoke,
    /// The spheres that follow it.
    pub puffs: Puffs,
}

impl Film {
    /// The film of a style, in its 24th frame.
    ///
    /// # Errors
    ///
    /// Where the smoke cannot be made.
    pub fn new(style: &Style) -> Result<Self, npr_smoke::SmokeError> {
        let settings = plume([30, 30, 60]);
        let mut smoke = npr_smoke::Smoke::new(settings)?;
        smoke.step();
        let following = Following {
            birthplace: settings.birthplace(),
            ..Following::default()
        };
        let puffs = Puffs::new(&smoke.volume(), following.settings(&style.smoke));
        let mut film = Self { smoke, puffs };
        (1..24).for_each(|_| drop(film.step()));
        Ok(film)
    }

    /// Goes on by a frame.
    pub fn step(&mut self) -> Volume {
        self.smoke.step();
        let volume = self.smoke.volume();
        self.puffs.step(&volume);
        volume
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_volume_fills_its_space_and_the_camera_sees_it() {
        let volume = npr_smoke::Smoke::new(plume([15, 15, 20])).unwrap().volume();
        let space = space_of(&volume);
        let around = ([-0.375, 0.0, -0.375], [0.375, 1.0, 0.375]);
        for i in 0..3 {
            assert!((space.0[i] - around.0[i]).abs() < 1e-5, "{space:?}");
            assert!((space.1[i] - around.1[i]).abs() < 1e-5, "{space:?}");
        }
        let [front, side] = [0.0, 90.0].map(|degrees| camera(space, [64, 64], degrees));
        let distance = |camera: &Camera| Vec3::from(camera.eye).distance(Vec3::from(camera.target));
        assert!((distance(&front) - distance(&side)).abs() < 1e-4);
    }
}
