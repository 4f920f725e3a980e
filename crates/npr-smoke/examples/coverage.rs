//! Share of the plume that spheres cover, chosen and random places side by side:
//! `cargo run -p npr-smoke --example coverage -- 15x15x20 48`.

use npr_smoke::cover::{Seat, cover, scatter};
use npr_smoke::{Distances, Smoke, SmokeSettings, Source, Sphere, Volume, covered_share};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let size = words.next().unwrap_or("15x15x20".to_owned());
    let size: Vec<u32> = size.split('x').map(str::parse).collect::<Result<_, _>>()?;
    let size = size.try_into().map_err(|_| "a size has three sides")?;
    let frames: u32 = words.next().map_or(Ok(48), |word| word.parse())?;
    let mut smoke = Smoke::new(SmokeSettings {
        size,
        ..SmokeSettings::of(Source::Plume)
    })?;
    (0..frames).for_each(|_| smoke.step());
    let volume = smoke.volume();
    let distances = Distances::new(&volume, 0.1);
    println!(
        "{} dense voxels\nspheres  chosen  random",
        distances.dense_count()
    );
    for count in [10, 20, 50, 100, 200, 500, 1000] {
        let share =
            |seats: Vec<Seat>| covered_share(&spheres(&seats, &volume), &volume, &distances);
        let chosen = cover(&distances, count, 1);
        let used = chosen.len();
        let random = share(scatter(&distances, used, 1));
        println!("{used:7}  {:6.3}  {random:6.3}", share(chosen));
    }
    Ok(())
}

/// Spheres in the seats, as large as the smoke allows.
fn spheres(seats: &[Seat], volume: &Volume) -> Vec<Sphere> {
    let sphere = |seat: &Seat| Sphere {
        center: volume.world_from_index(seat.place),
        radius: seat.radius * volume.voxel_width(),
        id: 0,
        age: 0,
        temperature: 0.0,
    };
    seats.iter().map(sphere).collect()
}
