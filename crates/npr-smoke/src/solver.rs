//! A small solver for smoke, so that nobody needs a file to draw some.
//!
//! Incompressible flow on a staggered grid [Fedkiw et al. 2001]: sources and buoyancy push, vorticity confinement
//! gives back the curls that a coarse grid swallows, pressure makes the flow free of divergence, and everything is
//! carried along it with MacCormack steps [Selle et al. 2008]. The floor is solid; smoke leaves through the sides and
//! the top.

use glam::Vec3;
use npr_core::budget::{Budget, OverBudget};

use crate::lattice::{Lattice, greatest, sum};
use crate::{MAX_SIDE, Volume, VolumeError};
use advect::{Outside, Paths, advect};
use flow::{Field, Flow};
use pressure::Pressure;
use space::{box_cells, index_to_world};

mod advect;
mod emission;
mod flow;
mod forces;
mod pressure;
mod settings;
mod source;
mod space;

pub use settings::SmokeSettings;
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
    #[error(
        "a grid of {} cells has a side outside {MIN_SIDE}..{MAX_SIDE}",
        size.map(|side| side.to_string()).join("x")
    )]
    BadSize {
        /// Cells along x, y and z as asked for.
        size: [u32; 3],
    },
    /// The grid does not fit.
    #[error(transparent)]
    OverBudget(#[from] OverBudget),
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
        // Refuse a grid that is too small, too large, or beyond the budget.
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

        // Start with the wind, and with the first cloud where there is one.
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
        emission::start(&settings, &mut smoke.density);
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
            .max(emission::speed(&self.settings, self.seconds));
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
        let wanted = emission::expansion(&self.settings, self.projected);
        greatest(self.cells.len(), |at| {
            let cell = self.cells.point(at);
            (self.flow.divergence(cell) - wanted(cell)).abs()
        })
    }

    /// One step: sources, forces, pressure, then everything moves along the flow.
    fn advance(&mut self, seconds: f32) {
        // Give off new smoke.
        let settings = self.settings;
        emission::emit(
            &settings,
            self.seconds,
            &mut self.density,
            &mut self.temperature,
            &mut self.flow,
        );

        // Carry the air along itself, then push it by heat, curls and drag.
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

        // Make the flow free of divergence.
        let wanted = emission::expansion(&settings, self.seconds);
        self.projected = self.seconds;
        self.pressure.project(&mut self.flow, wanted);

        // Carry the smoke along.
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

#[cfg(test)]
mod tests;
