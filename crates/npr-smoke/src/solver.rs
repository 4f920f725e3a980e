//! A small solver for smoke, so that nobody needs a file to draw some.
//!
//! Incompressible flow on a staggered grid [Fedkiw et al. 2001]: sources and buoyancy push, vorticity confinement
//! gives back the curls that a coarse grid swallows, pressure makes the flow free of divergence, and everything is
//! carried along it with MacCormack steps [Selle et al. 2008]. The floor is solid; smoke leaves through the sides and
//! the top.

use glam::{DAffine3, DMat3, DVec3, Vec3};
use npr_core::budget::{Budget, OverBudget};

use crate::lattice::{Lattice, greatest, sum};
use crate::{Birthplace, MAX_SIDE, Volume, VolumeError};
use advect::{Outside, Paths, advect};
use flow::{Field, Flow};
use pressure::Pressure;

mod advect;
mod flow;
mod forces;
mod pressure;
mod source;

pub use source::Source;

/// Fewest cells that one side of the grid may have.
pub const MIN_SIDE: u32 = 4;

/// Memory that the solver takes per cell, in bytes, the volumes it gives included.
pub const BYTES_PER_CELL: usize = 192;

/// Cells that smoke may move in one step of the solver; faster frames are cut into steps.
const CELLS_PER_STEP: f32 = 3.0;

/// Most steps per frame; what would be faster still is slowed down.
const MAX_STEPS: u32 = 8;

/// Why there is no smoke.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SmokeError {
    /// A side of the grid is too short or too long.
    #[error("a grid of {} cells has a side outside {MIN_SIDE}..{MAX_SIDE}", size.map(|side| side.to_string()).join("x"))]
    BadSize {
        /// Cells along x, y and z as asked for.
        size: [u32; 3],
    },
    /// The grid does not fit.
    #[error(transparent)]
    OverBudget(#[from] OverBudget),
}

/// What smokes, and how.
///
/// Lengths are in *box lengths*, the longest side of the grid, so that a finer grid shows the same motion in more
/// detail. Numbers that are not finite fall back on the source's own; all are kept within the ranges stated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmokeSettings {
    /// What smokes.
    pub source: Source,
    /// Cells along x, y and z; z is up. [`MIN_SIDE`] to [`MAX_SIDE`] each. The paper's 15 x 15 x 20 by default.
    pub size: [u32; 3],
    /// Seconds per frame, 0.001 to 1.
    pub frame_seconds: f32,
    /// How hot the source is, 0 to 10. 0.3 a cigarette, 1 a chimney, 3 a volcano.
    pub heat: f32,
    /// Upward acceleration of smoke of temperature 1, in box lengths per second squared, 0 to 50.
    pub buoyancy: f32,
    /// Downward acceleration of smoke of density 1, 0 to 50.
    pub weight: f32,
    /// How much vorticity confinement curls the smoke, 0 to 2. 0 calm, 0.3 rolling, 1 wild.
    pub curl: f32,
    /// Share of the density that vanishes per second, 0 to 10.
    pub fading: f32,
    /// Share of the temperature that vanishes per second, 0 to 10.
    pub cooling: f32,
    /// Wind that the air starts with and that goes on outside, in box lengths per second, at most 4.
    pub wind: Vec3,
    /// Other seeds give other smoke of the same kind.
    pub seed: u32,
}

impl SmokeSettings {
    /// Settings under which a source looks like itself.
    pub fn of(source: Source) -> Self {
        source.settings()
    }

    /// Where the source gives off its smoke in the world of the volumes; anywhere for a cloud, which is there from
    /// the start.
    pub fn birthplace(&self) -> Birthplace {
        source::emitter(self).map_or(Birthplace::Anywhere, |(place, radius)| {
            let index = place * box_cells(self.size) - 0.5;
            let world = index_to_world(self.size).transform_point3(index.as_dvec3());
            Birthplace::Emitter {
                center: world.as_vec3(),
                radius,
            }
        })
    }

    /// The same with every number finite and in its range.
    fn sane(self) -> Self {
        let own = self.source.settings();
        let within = |value: f32, own: f32, least: f32, most: f32| {
            if value.is_finite() {
                value.clamp(least, most)
            } else {
                own
            }
        };
        let wind = if self.wind.is_finite() {
            self.wind
        } else {
            own.wind
        };
        Self {
            frame_seconds: within(self.frame_seconds, own.frame_seconds, 1e-3, 1.0),
            heat: within(self.heat, own.heat, 0.0, 10.0),
            buoyancy: within(self.buoyancy, own.buoyancy, 0.0, 50.0),
            weight: within(self.weight, own.weight, 0.0, 50.0),
            curl: within(self.curl, own.curl, 0.0, 2.0),
            fading: within(self.fading, own.fading, 0.0, 10.0),
            cooling: within(self.cooling, own.cooling, 0.0, 10.0),
            wind: wind.clamp(Vec3::splat(-4.0), Vec3::splat(4.0)),
            ..self
        }
    }
}

/// Smoke that goes on frame by frame.
///
/// A frame costs O(cells), some 100 sweeps over the grid. The same settings give the same bits on every platform and
/// for any number of threads.
///
/// ```
/// use npr_smoke::{Smoke, SmokeSettings, Source};
///
/// let mut smoke = Smoke::new(SmokeSettings::of(Source::Plume))?;
/// smoke.step();
/// assert!(smoke.volume().dense_count(0.5) > 0);
/// # Ok::<(), npr_smoke::SmokeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Smoke {
    settings: SmokeSettings,
    cells: Lattice,
    flow: Flow,
    density: Field,
    temperature: Field,
    pressure: Pressure,
    seconds: f64,
    /// When pressure last made the flow give off what the source wants.
    projected: f64,
}

impl Smoke {
    /// Clear air, or the first cloud, before the first frame.
    ///
    /// # Errors
    ///
    /// [`SmokeError::BadSize`] for sides out of range.
    pub fn new(settings: SmokeSettings) -> Result<Self, SmokeError> {
        Self::within(&mut Budget::new(u64::MAX), settings)
    }

    /// [`new`](Self::new), if the memory for it is left in a budget: [`BYTES_PER_CELL`] per cell are taken.
    ///
    /// # Errors
    ///
    /// [`SmokeError::BadSize`] for sides out of range, [`SmokeError::OverBudget`] for grids that do not fit.
    pub fn within(budget: &mut Budget, settings: SmokeSettings) -> Result<Self, SmokeError> {
        let size = settings.size;
        if size
            .iter()
            .any(|side| !(MIN_SIDE..=MAX_SIDE).contains(side))
        {
            return Err(SmokeError::BadSize { size });
        }
        let settings = settings.sane();
        let cells = Lattice {
            size: size.map(|side| side as usize),
        };
        budget.take("the smoke's grid", cells.len(), BYTES_PER_CELL)?;
        let scale = box_cells(size);
        let mut smoke = Self {
            settings,
            cells,
            flow: Flow::uniform(cells, settings.wind * scale),
            density: Field::new(cells, Vec3::ZERO),
            temperature: Field::new(cells, Vec3::ZERO),
            pressure: Pressure::new(cells),
            seconds: 0.0,
            projected: 0.0,
        };
        source::start(&settings, &mut smoke.density);
        Ok(smoke)
    }

    /// The settings, every number in its range.
    pub fn settings(&self) -> &SmokeSettings {
        &self.settings
    }

    /// Goes on by one frame.
    pub fn step(&mut self) {
        let seconds = self.settings.frame_seconds;
        let fastest = self
            .flow
            .fastest()
            .max(source::speed(&self.settings, self.seconds));
        let wanted = (fastest * seconds / CELLS_PER_STEP).ceil();
        // A float beyond the range becomes the nearest integer.
        let steps = (wanted as u32).clamp(1, MAX_STEPS);
        for _ in 0..steps {
            self.advance(seconds / steps as f32);
        }
    }

    /// The smoke as it is now, one voxel per cell, y up in the world.
    ///
    /// The box stands on the world's floor, centred over its origin, its longest side 1 unit long.
    pub fn volume(&self) -> Volume {
        let to_world = index_to_world(self.settings.size);
        let turn = to_world.matrix3.as_mat3();
        let velocity = self.cells.map(|at| turn * self.flow.at_centre(at));
        Volume::new(self.settings.size, self.density.values.clone(), to_world)
            .and_then(|volume| volume.with_velocity(velocity))
            .and_then(|volume| volume.with_temperature(self.temperature.values.clone()))
            .unwrap_or_else(|fault: VolumeError| unreachable!("one value per cell: {fault}"))
    }

    /// Greatest divergence of the flow that no source asks for, per second.
    pub fn greatest_divergence(&self) -> f32 {
        let wanted = source::expansion(&self.settings, self.projected);
        greatest(self.cells.len(), |at| {
            let cell = self.cells.point(at);
            (self.flow.divergence(cell) - wanted(cell)).abs()
        })
    }

    /// One step: sources, forces, pressure, then everything moves along the flow.
    fn advance(&mut self, seconds: f32) {
        let settings = self.settings;
        source::emit(
            &settings,
            self.seconds,
            &mut self.density,
            &mut self.temperature,
            &mut self.flow,
        );
        self.flow = advect_flow(&self.flow, seconds);
        let scale = box_cells(settings.size);
        forces::lift(
            &mut self.flow,
            &self.density,
            &self.temperature,
            &settings,
            scale * seconds,
        );
        forces::confine(&mut self.flow, settings.curl, seconds);
        forces::brake(&mut self.flow, settings.source.drag(), seconds);
        self.flow
            .limit(CELLS_PER_STEP * MAX_STEPS as f32 / settings.frame_seconds);
        let wanted = source::expansion(&settings, self.seconds);
        self.projected = self.seconds;
        self.pressure.project(&mut self.flow, wanted);
        self.carry(seconds);
        self.seconds += f64::from(seconds);
    }

    /// Carries density and temperature along, lets them fade, and never makes smoke out of nothing.
    fn carry(&mut self, seconds: f32) {
        let before = total(&self.density);
        let paths = Paths::new(&self.density, &self.flow, seconds);
        self.density = paths.carry(&self.density, Outside::Nothing);
        self.temperature = paths.carry(&self.temperature, Outside::Nothing);
        let after = total(&self.density);
        let surplus = if after > before {
            (before / after) as f32
        } else {
            1.0
        };
        let left = |share: f32| npr_core::math::exp(-share * seconds);
        self.density.scale(surplus * left(self.settings.fading));
        self.temperature.scale(left(self.settings.cooling));
    }
}

/// The flow carried along itself.
fn advect_flow(flow: &Flow, seconds: f32) -> Flow {
    let along = |axis: usize| advect(&flow.faces[axis], flow, seconds, Outside::Same);
    let mut carried = Flow {
        cells: flow.cells,
        faces: [along(0), along(1), along(2)],
    };
    carried.close_floor();
    carried
}

/// Sum over all cells.
fn total(field: &Field) -> f64 {
    sum(field.values.len(), |at| f64::from(field.values[at]))
}

/// Cells in one box length.
fn box_cells(size: [u32; 3]) -> f32 {
    size[0].max(size[1]).max(size[2]) as f32
}

/// The world from cells: z becomes y, so that smoke rises as figures stand.
fn index_to_world(size: [u32; 3]) -> DAffine3 {
    let cell = 1.0 / f64::from(box_cells(size));
    let [width, depth, _] = size.map(f64::from);
    let axes = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y) * cell;
    let origin = DVec3::new(0.5 - width / 2.0, 0.5, depth / 2.0 - 0.5) * cell;
    DAffine3::from_mat3_translation(axes, origin)
}

#[cfg(test)]
mod tests;
