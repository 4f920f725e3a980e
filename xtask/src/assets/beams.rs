//! Every use of light that comics have a shape for [Suzuki 2004, section 3.5]: laser, muzzle flash, explosion, hit
//! flash, trail.

use glam::{Mat3, Vec3};
use npr_core::math;

use super::pen::Path;
use super::prism::slab;
use super::scene::{Scene, View};
use super::shape::{Paint, Shape};
use super::tube::{stations, tube};
use super::turned::ball;

/// Two drones that fight over a table: one fires, the other is hit and burns.
pub fn beams() -> Scene {
    let view = View {
        eye: Vec3::new(6.0, 19.0, 66.0),
        target: Vec3::new(0.0, 10.0, 0.0),
        fov: 32.0f32.to_radians(),
        aspect: 16.0 / 9.0,
    };
    let mut scene = Scene::new(view, Vec3::new(0.5, -0.9, -0.75));
    let hull = scene.material("Hull", 0x9fb3c8);
    let dark = scene.material("Dark", 0x3c4654);
    let red = scene.material("Red", 0xc2483a);
    let laser = scene.material("BeamLaser", 0xff5050);
    let flash = scene.material("BeamFlash", 0xffe070);
    let fire = scene.material("BeamFire", 0xff9030);
    let trail = scene.material("BeamTrail", 0x70c8ff);

    scene.stand(
        "Table",
        slab(150.0, 3.0, 70.0, 1.0, dark),
        [0.0, -3.0, -10.0],
        0.0,
    );
    scene.stand("Hunter", drone(hull, dark), [-17.0, 11.0, 0.0], 0.0);
    scene.stand("Prey", drone(red, dark), [17.0, 9.0, -4.0], 150.0);
    scene.stand(
        "Crate",
        slab(7.0, 7.0, 7.0, 0.6, hull),
        [3.0, 0.0, -9.0],
        25.0,
    );

    let aim = Vec3::new(34.0, -2.0, -4.0).normalize();
    let turn = Mat3::from_cols(aim, Vec3::Z.cross(aim).normalize(), Vec3::Z);
    scene.add("Laser", capsule(13.2, 0.55, laser), [0.0, 10.0, -2.0], turn);
    // Flashes turn to whoever looks.
    let facing = Mat3::from_rotation_y(-std::f32::consts::FRAC_PI_2);
    scene.add(
        "MuzzleFlash",
        star(7, 2.6, 0.45, flash),
        [-11.2, 10.6, 1.5],
        facing,
    );
    scene.add(
        "HitFlash",
        star(9, 4.2, 0.3, flash),
        [13.4, 9.2, 0.5],
        facing,
    );
    scene.stand("Explosion", burst(5.4, fire), [20.5, 13.5, -7.0], 0.0);
    scene.stand("Trail", wake(trail), [-21.0, 10.5, 0.0], 180.0);
    scene
}

/// A ball with a nozzle and a fin.
fn drone(shell: Paint, dark: Paint) -> Shape {
    let barrel = capsule(2.2, 0.8, dark).placed(Mat3::IDENTITY, Vec3::new(3.6, -0.2, 0.0));
    let fin = ball(2.2, 14, dark).warp(|p| Vec3::new(p.x - 1.5, p.y * 0.9 + 2.6, p.z * 0.16));
    ball(3.4, 26, shell).join(barrel).join(fin)
}

/// A ball drawn out along x to a length of twice `half`.
fn capsule(half: f32, radius: f32, paint: Paint) -> Shape {
    let straight = half - radius;
    ball(radius, 14, paint)
        .warp(|p| Vec3::new(p.x + straight * p.x.clamp(-0.05, 0.05) * 20.0, p.y, p.z))
}

/// A star around the x axis with so many points, the deeper the smaller `waist`.
fn star(points: u32, radius: f32, waist: f32, paint: Paint) -> Shape {
    ball(1.0, 32, paint).warp(|p| {
        let angle = math::atan2(p.z, p.y);
        let wave = 0.5 + 0.5 * math::cos(angle * points as f32);
        let reach = waist + (1.0 - waist) * wave * wave;
        let across = (p.y * p.y + p.z * p.z).sqrt();
        let out = radius * reach * across;
        Vec3::new(
            p.x * radius * 0.35,
            out * math::cos(angle),
            out * math::sin(angle),
        )
    })
}

/// A ball of billows.
fn burst(radius: f32, paint: Paint) -> Shape {
    ball(1.0, 40, paint).warp(|p| {
        let billow = |v: f32, k: f32| math::sin(v * k).abs();
        let lumps = billow(p.x + 0.3, 4.1) + billow(p.y - 0.2, 4.7) + billow(p.z + 0.1, 4.3);
        p * (radius * (0.72 + 0.17 * lumps))
    })
}

/// What a flying thing leaves behind: a tube that thins out along a bent path.
fn wake(paint: Paint) -> Shape {
    let path = Path::start(0.0, 0.0).curve([[9.0, 0.0], [16.0, 3.0], [24.0, 8.0]], 28);
    tube(&stations(&path, |t| [1.5 * (1.0 - t) + 0.05; 2]), 24, paint)
}
