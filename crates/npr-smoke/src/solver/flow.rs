//! Values on a grid, and the velocities on the faces between its cells.

use glam::Vec3;

use crate::lattice::{Lattice, greatest};

/// Values at the points of a grid that may be shifted against the cells' centres.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    pub lattice: Lattice,
    /// Place of the first point, in cells.
    pub origin: Vec3,
    pub values: Vec<f32>,
}

impl Field {
    /// Zero everywhere.
    pub fn new(lattice: Lattice, origin: Vec3) -> Self {
        Self {
            lattice,
            origin,
            values: vec![0.0; lattice.len()],
        }
    }

    /// Place of a point, in cells.
    pub fn place(&self, [x, y, z]: [usize; 3]) -> Vec3 {
        self.origin + Vec3::new(x as f32, y as f32, z as f32)
    }

    /// Blended value at a place; outside the grid that of the nearest place in it.
    #[inline]
    pub fn at(&self, place: Vec3) -> f32 {
        let cell = self.lattice.cell(place - self.origin);
        cell.blend(|at| self.values[at])
    }

    /// Value at a point.
    pub fn value(&self, point: [usize; 3]) -> f32 {
        self.values[self.lattice.index(point)]
    }

    /// Multiplies every value.
    pub fn scale(&mut self, factor: f32) {
        self.values.iter_mut().for_each(|value| *value *= factor);
    }
}

/// Velocities in cells per second, each component on the middles of the faces that it goes through.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Flow {
    pub cells: Lattice,
    /// Components through the faces across x, y and z; one face more than cells along the axis.
    pub faces: [Field; 3],
}

impl Flow {
    /// The same velocity everywhere, but nothing through the floor.
    pub fn uniform(cells: Lattice, velocity: Vec3) -> Self {
        let across = |axis: usize| {
            let mut size = cells.size;
            size[axis] += 1;
            let mut origin = Vec3::ZERO;
            origin[axis] = -0.5;
            let mut field = Field::new(Lattice { size }, origin);
            field.values.fill(velocity[axis]);
            field
        };
        let mut flow = Self {
            cells,
            faces: [across(0), across(1), across(2)],
        };
        flow.close_floor();
        flow
    }

    /// Velocity at a place, in cells.
    pub fn at(&self, place: Vec3) -> Vec3 {
        let [x, y, z] = &self.faces;
        Vec3::new(x.at(place), y.at(place), z.at(place))
    }

    /// Velocity at a cell's centre.
    pub fn at_centre(&self, cell: [usize; 3]) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|axis| {
            let (low, high) = self.through(cell, axis);
            0.5 * (low + high)
        }))
    }

    /// What a cell gives off per second, as a share of its volume.
    pub fn divergence(&self, cell: [usize; 3]) -> f32 {
        let out = |axis: usize| {
            let (low, high) = self.through(cell, axis);
            high - low
        };
        out(0) + out(1) + out(2)
    }

    /// Velocity through a cell's lower and upper face across an axis.
    fn through(&self, cell: [usize; 3], axis: usize) -> (f32, f32) {
        let mut next = cell;
        next[axis] += 1;
        (self.faces[axis].value(cell), self.faces[axis].value(next))
    }

    /// Stops what goes through the floor.
    pub fn close_floor(&mut self) {
        let [width, height, _] = self.cells.size;
        self.faces[2].values[..width * height].fill(0.0);
    }

    /// The greatest component.
    pub fn fastest(&self) -> f32 {
        let fastest = |field: &Field| greatest(field.values.len(), |at| field.values[at].abs());
        self.faces.iter().map(fastest).fold(0.0, f32::max)
    }

    /// Cuts every component to `most`, and what is no number to 0.
    pub fn limit(&mut self, most: f32) {
        for value in self.faces.iter_mut().flat_map(|field| &mut field.values) {
            *value = if value.is_nan() {
                0.0
            } else {
                value.clamp(-most, most)
            };
        }
    }
}
