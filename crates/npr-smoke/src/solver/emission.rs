//! What a source gives off: density and heat, frame by frame.

use glam::Vec3;
use npr_core::math::smoothstep;

use super::flow::{Field, Flow};
use super::space::{box_cells, index_to_world};
use super::{SmokeSettings, Source};
use crate::Birthplace;
use crate::random::{noise, signed3, unit};

/// What a place is given in a step.
#[derive(Debug, Clone, Copy, Default)]
struct Gift {
    /// Density and temperature that the place has at least.
    density: f32,
    temperature: f32,
    /// Upward speed that it has at least, in box lengths per second.
    lift: f32,
}

/// Seconds from one puff of the plume to the next.
const BEAT_SECONDS: f64 = 0.55;

/// How long the puff and the explosion last, in seconds.
const PUFF_SECONDS: f64 = 0.35;
const BLAST_SECONDS: f64 = 0.25;

/// Expansion of an explosion of heat 1, per second.
const BLAST_EXPANSION: f32 = 7.0;

impl SmokeSettings {
    /// Where the source gives off its smoke in the world of the volumes; anywhere for a cloud, which is there from
    /// the start.
    pub fn birthplace(&self) -> Birthplace {
        emitter(self).map_or(Birthplace::Anywhere, |(place, radius)| {
            let index = place * box_cells(self.size) - 0.5;
            let world = index_to_world(self.size).transform_point3(index.as_dvec3());
            Birthplace::Emitter {
                center: world.as_vec3(),
                radius,
            }
        })
    }
}

/// Fills the first cloud, before the first frame; other sources start in clear air.
pub(super) fn start(settings: &SmokeSettings, density: &mut Field) {
    if settings.source != Source::Cloud {
        return;
    }
    let emission = Emission::new(settings, 0.0);
    let cells = density.lattice;
    cells.fill(&mut density.values, |cell| {
        emission.cloud(emission.place(cell))
    });
}

/// A ball, in box lengths, that holds nearly all that a source gives off; none of a source that fills a wide space.
fn emitter(settings: &SmokeSettings) -> Option<(Vec3, f32)> {
    let emission = Emission::new(settings, 0.0);
    match settings.source {
        Source::Plume => Some((emission.above(0.5 * emission.radius), 1.3 * emission.radius)),
        Source::Puff => Some((emission.above(0.7 * emission.radius), 1.3 * emission.radius)),
        Source::Explosion => Some((emission.blast_center(), 1.1 * emission.radius)),
        Source::Cloud => None,
    }
}

/// Gives every cell what the source has for it at a time.
pub(super) fn emit(
    settings: &SmokeSettings,
    seconds: f64,
    density: &mut Field,
    temperature: &mut Field,
    flow: &mut Flow,
) {
    let emission = Emission::new(settings, seconds);
    let cells = flow.cells;
    let gifts = cells.map(|cell| emission.gift(settings.source, emission.place(cell)));
    for (at, gift) in gifts.iter().enumerate() {
        density.values[at] = density.values[at].max(gift.density);
        temperature.values[at] = temperature.values[at].max(gift.temperature * settings.heat);
    }
    let plane = cells.size[0] * cells.size[1];
    for (at, gift) in gifts.iter().enumerate().filter(|(_, gift)| gift.lift > 0.0) {
        // The face above the cell: the floor itself stays closed.
        let speed = &mut flow.faces[2].values[at + plane];
        *speed = speed.max(gift.lift * emission.scale);
    }
}

/// Speed, in cells per second, that a source blows with at a time, before the flow shows it.
pub(super) fn speed(settings: &SmokeSettings, seconds: f64) -> f32 {
    let emission = Emission::new(settings, seconds);
    let box_speed = match settings.source {
        Source::Plume => 0.5,
        Source::Puff => 0.6,
        Source::Cloud => 0.0,
        // At the surface of a ball that expands evenly.
        Source::Explosion => 0.45 + blast_strength(settings, seconds) * emission.radius / 3.0,
    };
    box_speed * emission.scale
}

/// Expansion inside the blast, per second.
fn blast_strength(settings: &SmokeSettings, seconds: f64) -> f32 {
    let blasts = settings.source == Source::Explosion && seconds < BLAST_SECONDS;
    if blasts {
        BLAST_EXPANSION * settings.heat
    } else {
        0.0
    }
}

/// How much the content of cells expands per second at a time.
pub(super) fn expansion(
    settings: &SmokeSettings,
    seconds: f64,
) -> impl Fn([usize; 3]) -> f32 + Sync + use<> {
    let emission = Emission::new(settings, seconds);
    let strength = blast_strength(settings, seconds);
    move |cell| {
        if strength == 0.0 {
            return 0.0;
        }
        let place = emission.place(cell);
        let away = (place - emission.blast_center()).length();
        strength * smoothstep(emission.radius, 0.6 * emission.radius, away).min(1.0)
    }
}

/// Where and when a source is asked. Places are in box lengths, the corner of the grid at 0.
#[derive(Debug, Clone, Copy)]
struct Emission {
    seconds: f64,
    seed: u32,
    /// Cells in one box length.
    scale: f32,
    /// Middle of the floor, and the box's far corner.
    middle: Vec3,
    far: Vec3,
    /// Radius of what burns.
    radius: f32,
}

impl Emission {
    fn new(settings: &SmokeSettings, seconds: f64) -> Self {
        let scale = box_cells(settings.size);
        let far = Vec3::from_array(settings.size.map(|side| side as f32)) / scale;
        // A blast needs room to swell.
        let share = if settings.source == Source::Explosion {
            0.13
        } else {
            0.17
        };
        Self {
            seconds,
            seed: settings.seed,
            scale,
            middle: Vec3::new(far.x / 2.0, far.y / 2.0, 0.0),
            far,
            // Never less than 1.5 cells: below that a coarse grid sees nothing.
            radius: (share * far.x.min(far.y)).max(1.5 / scale),
        }
    }

    /// A cell's centre.
    fn place(&self, [x, y, z]: [usize; 3]) -> Vec3 {
        Vec3::new(x as f32 + 0.5, y as f32 + 0.5, z as f32 + 0.5) / self.scale
    }

    /// What the source gives to a place at a time.
    fn gift(&self, source: Source, place: Vec3) -> Gift {
        match source {
            Source::Plume => self.chimney(place),
            Source::Puff if self.seconds < PUFF_SECONDS => self.puff(place),
            Source::Explosion if self.seconds < BLAST_SECONDS => self.blast(place),
            Source::Cloud => self.updraught(place),
            Source::Puff | Source::Explosion => Gift::default(),
        }
    }

    /// The place so far above the middle of the floor.
    fn above(&self, height: f32) -> Vec3 {
        self.middle + Vec3::Z * height
    }

    /// 1 inside a lumpy ball, 0 outside; `rise` moves the lumps upward, in radii.
    fn lumpy_ball(&self, place: Vec3, center: Vec3, radius: f32, rise: f32) -> f32 {
        let offset = (place - center) / radius;
        let lump = noise(self.seed, 1.7 * offset - Vec3::Z * rise);
        let reach = 0.7 + 0.6 * lump;
        1.0 - smoothstep(0.75 * reach, reach, offset.length())
    }

    /// Puffs of different size and heat, a little beside the middle, with a pause after each.
    fn chimney(&self, place: Vec3) -> Gift {
        let beats = self.seconds / BEAT_SECONDS;
        let beat = beats.floor();
        let phase = (beats - beat) as f32;
        let number = beat as u32;
        let strength = 0.75 + 0.5 * unit(self.seed, number, 0);
        let breath = 1.0 - smoothstep(0.55, 0.85, phase);
        let aside = 0.45 * self.radius * signed3(self.seed, number, 1);
        let center = self.above(0.5 * self.radius) + Vec3::new(aside.x, aside.y, 0.0);
        let radius = self.radius * strength * (0.55 + 0.45 * breath);
        let inside = self.lumpy_ball(place, center, radius, 3.0 * beats as f32);
        Gift {
            density: inside,
            temperature: inside * strength * (0.35 + 0.65 * breath),
            lift: 0.35 * inside * breath * strength,
        }
    }

    /// A single strong breath.
    fn puff(&self, place: Vec3) -> Gift {
        let inside = self.lumpy_ball(place, self.above(0.7 * self.radius), 1.2 * self.radius, 0.0);
        Gift {
            density: inside,
            temperature: inside,
            lift: 0.6 * inside,
        }
    }

    /// Where it explodes.
    fn blast_center(&self) -> Vec3 {
        self.above(1.8 * self.radius)
    }

    /// Fire.
    fn blast(&self, place: Vec3) -> Gift {
        let inside = self.lumpy_ball(place, self.blast_center(), self.radius, 0.0);
        let lump = noise(self.seed ^ 1, 2.5 * place / self.radius);
        Gift {
            density: inside,
            temperature: inside * (0.6 + 0.8 * lump),
            lift: 0.45 * inside,
        }
    }

    /// Lumps over a flat base, the largest in the middle.
    fn cloud(&self, place: Vec3) -> f32 {
        let base = 0.3 * self.far.z;
        let lump = |number: u32| {
            let at = (number as f32 + 0.5) / 7.0;
            let shift = signed3(self.seed, number, 2);
            let size = (0.55 + 0.45 * (1.0 - (2.0 * at - 1.0).abs())) * 0.34 * self.far.z;
            let x = self.far.x * (0.2 + 0.6 * at);
            let y = self.far.y * (0.5 + 0.12 * shift.y);
            let center = Vec3::new(x, y, base + 0.35 * size * (1.0 + shift.z));
            self.lumpy_ball(place, center, size, number as f32 * 5.0)
        };
        let over_base = smoothstep(base - 0.1 * self.far.z, base, place.z);
        let most = (0..7).map(lump).fold(0.0, f32::max);
        most * over_base
    }

    /// Warm air that keeps a cloud boiling, at places that change, and new cloud where it started.
    fn updraught(&self, place: Vec3) -> Gift {
        let here = self.cloud(place);
        let drift = Vec3::new(0.0, 0.0, 0.7 * self.seconds as f32);
        let warm = noise(self.seed ^ 2, 7.0 * place - drift);
        Gift {
            density: 0.6 * here,
            temperature: here * smoothstep(0.5, 0.8, warm),
            lift: 0.0,
        }
    }
}
