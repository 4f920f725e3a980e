//! Draws a source as two-tone spheres: `cargo run -p npr-smoke --example look -- plume 30x30x60 1,24,48,96 out`.

use glam::{DVec3, Vec3};
use image::{Rgb, RgbImage};
use npr_smoke::{Smoke, SmokeSettings, Source, Sphere, Track, TrackSettings};

/// Pixels along a side of the picture.
const SIDE: u32 = 512;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let word = |at: usize, default: &str| words.get(at).cloned().unwrap_or(default.to_owned());
    let source = Source::of_name(&word(0, "plume")).ok_or("no such source")?;
    let numbers = |text: String| {
        text.split(['x', ','])
            .map(str::parse)
            .collect::<Result<Vec<u32>, _>>()
    };
    let size = numbers(word(1, "15x15x20"))?;
    let size = size.try_into().map_err(|_| "a size has three sides")?;
    let frames = numbers(word(2, "1,24,48,96"))?;
    let mut smoke = Smoke::new(SmokeSettings {
        size,
        ..SmokeSettings::of(source)
    })?;
    let count = word(4, "200").parse()?;
    let settings = TrackSettings {
        count,
        ..Default::default()
    };
    smoke.step();
    let mut track = Track::new(&smoke.volume(), settings);
    for frame in 1..=frames.iter().copied().max().unwrap_or(0) {
        if frames.contains(&frame) {
            println!("frame {frame}: {} spheres", track.spheres().len());
            draw(&track.spheres()).save(format!("{}_{frame:04}.png", word(3, "smoke")))?;
        }
        smoke.step();
        track.step(&smoke.volume());
    }
    Ok(())
}

/// The spheres from the front: lit from the upper left, cut into two tones, with lines where the depth jumps.
fn draw(spheres: &[Sphere]) -> RgbImage {
    let towards_light = DVec3::new(-0.5, 0.8, 0.6).normalize().as_vec3();
    let surface = |x: u32, y: u32| {
        let at = |pixel: u32| (pixel as f32 + 0.5) / SIDE as f32;
        let ray = Vec3::new(at(x) - 0.5, 1.0 - at(y), 0.0);
        let hit = |sphere: &Sphere| {
            let away = (ray - sphere.center) * Vec3::new(1.0, 1.0, 0.0);
            let depth = (sphere.radius * sphere.radius - away.length_squared())
                .max(0.0)
                .sqrt();
            (depth > 0.0).then(|| {
                (
                    sphere.center.z + depth,
                    (away + Vec3::Z * depth).dot(towards_light) / sphere.radius,
                )
            })
        };
        spheres
            .iter()
            .filter_map(hit)
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((-1.0, 2.0))
    };
    let seen: Vec<(f32, f32)> = (0..SIDE * SIDE)
        .map(|at| surface(at % SIDE, at / SIDE))
        .collect();
    RgbImage::from_fn(SIDE, SIDE, |x, y| {
        let depth = |x: u32, y: u32| seen[(x.min(SIDE - 1) + SIDE * y.min(SIDE - 1)) as usize].0;
        let jump = (depth(x + 1, y + 1) - depth(x, y))
            .abs()
            .max((depth(x + 1, y) - depth(x, y + 1)).abs());
        match seen[(x + SIDE * y) as usize].1 {
            _ if jump > 0.04 => Rgb([30, 30, 40]),
            2.0 => Rgb([255, 255, 255]),
            light if light > 0.25 => Rgb([235, 235, 225]),
            _ => Rgb([170, 170, 185]),
        }
    })
}
