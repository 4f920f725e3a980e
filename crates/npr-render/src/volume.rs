//! Smoke from files: which grids of a file it is made of, and the volume they give.

mod choice;

pub use choice::Choice;

use choice::shown;
use glam::{DAffine3, DMat3, DVec3, Vec3};
use npr_core::budget::{Budget, OverBudget};
use npr_core::camera::bounds_of;
use npr_smoke::{MAX_SIDE, Mended, Volume, VolumeError};
use npr_vdb::{Bounds, Fault, Grid, GridClass, Limits, Transform, npy};

/// Most voxels of a volume.
pub const MAX_VOXELS: usize = 1 << 30;

/// What of a file becomes smoke.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct VolumeOptions {
    /// The grid of densities; by default one of a usual name, or the only one that can be.
    pub density: Option<String>,
    /// The grid of velocities, or three of their components; by default those of a usual name.
    pub velocity: Vec<String>,
    /// The grid of temperatures; by default one of a usual name.
    pub heat: Option<String>,
    /// Which axis of the file points up; it becomes the world's y.
    pub up: UpAxis,
    /// Most bytes that one volume may take.
    pub memory_limit: u64,
}

impl Default for VolumeOptions {
    fn default() -> Self {
        Self {
            density: None,
            velocity: Vec::new(),
            heat: None,
            up: UpAxis::Y,
            memory_limit: 4 << 30,
        }
    }
}

/// Which axis of a file points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum UpAxis {
    /// As in this world and in Houdini.
    #[default]
    Y,
    /// As in Blender; x stays x, y becomes -z.
    Z,
}

/// Why a file gives no smoke. Messages leave out the file's own name, which the caller puts before them.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VolumeFault {
    /// The first bytes are those of no format that is read.
    #[error("this is neither an OpenVDB file nor an .npy array")]
    Unknown,
    /// Reading failed.
    #[error(transparent)]
    Read(#[from] Fault),
    /// No grid has a name that tells it, and none is the only one that could be.
    #[error("no grid is called density; name one of {names}")]
    NoDensity {
        /// Those that hold numbers, quoted, the first few.
        names: String,
    },
    /// No grid can be a density at all.
    #[error("no grid holds densities: {found}")]
    NothingDrawn {
        /// What there is instead.
        found: String,
    },
    /// A grid of distances was to be densities.
    #[error("grid '{grid}' is a level set: it holds distances to a surface, no densities")]
    LevelSet {
        /// Its name.
        grid: String,
    },
    /// An array of vectors was to be densities.
    #[error("the array holds vectors, not densities")]
    Vectors,
    /// Neither one nor three grids of velocities were named.
    #[error("{count} grids are named for velocities, not one or three")]
    Components {
        /// How many.
        count: usize,
    },
    /// There are too many voxels.
    #[error(
        "a box of {}x{}x{} voxels exceeds the limit of {} voxels and {} a side",
        size[0], size[1], size[2], MAX_VOXELS, MAX_SIDE
    )]
    TooLarge {
        /// Voxels along each axis of the file.
        size: [usize; 3],
    },
    /// There is too little memory for them.
    #[error(transparent)]
    Memory(#[from] OverBudget),
    /// They make no volume.
    #[error(transparent)]
    Volume(#[from] VolumeError),
}

impl VolumeFault {
    /// Whether a limit stands against it, rather than the file.
    pub fn is_limit(&self) -> bool {
        matches!(
            self,
            Self::TooLarge { .. }
                | Self::Memory(_)
                | Self::Volume(VolumeError::TooLarge { .. })
                | Self::Read(Fault::Memory { .. } | Fault::OutOfMemory { .. })
        )
    }

    /// Whether a memory limit stands against it, which may be raised.
    pub fn is_memory(&self) -> bool {
        self.is_limit() && !matches!(self, Self::TooLarge { .. } | Self::Volume(_))
    }
}

/// Whether bytes begin as those of a volume do.
pub fn is_volume(bytes: &[u8]) -> bool {
    is_vdb(bytes) || is_npy(bytes)
}

fn is_vdb(bytes: &[u8]) -> bool {
    bytes.starts_with(b" BDV")
}

fn is_npy(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x93NUMPY")
}

/// A box of voxels in a file, and where it lies: what the volumes of a series must share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The lowest index along each axis of the file.
    pub low: [i32; 3],
    /// Voxels along each axis of the file.
    pub size: [usize; 3],
    /// World from the file's indices, up made y.
    pub world_from_index: DAffine3,
}

impl Extent {
    /// The smallest box that holds both; none unless both are of one grid. Nothing is added by an empty one.
    pub fn union(&self, other: &Self) -> Option<Self> {
        if self.is_empty() || other.is_empty() {
            return Some(if self.is_empty() { *other } else { *self });
        }
        if self.world_from_index != other.world_from_index {
            return None;
        }
        let end =
            |extent: &Self, axis: usize| i64::from(extent.low[axis]) + extent.size[axis] as i64;
        let low: [i32; 3] = std::array::from_fn(|axis| self.low[axis].min(other.low[axis]));
        let size = |axis: usize| end(self, axis).max(end(other, axis)) - i64::from(low[axis]);
        Some(Self {
            low,
            size: std::array::from_fn(|axis| size(axis).max(0) as usize),
            ..*self
        })
    }

    /// Lowest and highest corner of its voxels in the world; none where there are none.
    pub fn bounds(&self) -> Option<([f32; 3], [f32; 3])> {
        let corner = |i: usize| {
            let index = |axis: usize| {
                let end = if i >> axis & 1 == 0 {
                    0.0
                } else {
                    self.size[axis] as f64
                };
                f64::from(self.low[axis]) + end - 0.5
            };
            let index = DVec3::from_array(std::array::from_fn(index));
            self.world_from_index.transform_point3(index).as_vec3()
        };
        (!self.is_empty()).then(|| bounds_of((0..8).map(corner)))
    }

    /// Whether there is no voxel in it.
    pub fn is_empty(&self) -> bool {
        self.size.contains(&0)
    }

    /// Number of voxels, if it may be drawn.
    fn checked_count(&self) -> Result<usize, VolumeFault> {
        let size = self.size;
        let count = size
            .iter()
            .try_fold(1usize, |count, side| count.checked_mul(*side));
        let fits = size.iter().all(|&side| side <= MAX_SIDE as usize);
        count
            .filter(|&count| fits && count <= MAX_VOXELS)
            .ok_or(VolumeFault::TooLarge { size })
    }

    /// Sizes and places as [`Volume`] has them: its x runs fastest, a file's z does, so axes change their names.
    fn turned(&self) -> ([u32; 3], DAffine3) {
        let [x, y, z] = self.size.map(|side| side as u32);
        let low = DVec3::from_array(self.low.map(f64::from));
        let m = self.world_from_index.matrix3;
        let axes = DMat3::from_cols(m.z_axis, m.y_axis, m.x_axis);
        let origin = self.world_from_index.transform_point3(low);
        ([z, y, x], DAffine3::from_mat3_translation(axes, origin))
    }
}

/// An opened file with the grids that smoke is made of.
#[derive(Debug, Clone)]
pub struct VolumeFile {
    density: Density,
    velocity: Velocity,
    heat: Option<Grid<f32>>,
    up: UpAxis,
    memory_limit: u64,
    notices: Vec<String>,
}

#[derive(Debug, Clone)]
enum Density {
    Sparse(Box<Grid<f32>>),
    /// Voxels along each axis, and their values.
    Dense([usize; 3], Vec<f32>),
}

#[derive(Debug, Clone)]
enum Velocity {
    Unknown,
    Vectors(Box<Grid<[f32; 3]>>),
    Components(Box<[Grid<f32>; 3]>),
}

impl VolumeFile {
    /// Finds and reads the grids of a file that smoke is made of: of OpenVDB or of an `.npy` array, by the content.
    ///
    /// O(voxels that are stored), and as much memory; refused before it is taken where it exceeds the limit.
    ///
    /// # Errors
    ///
    /// [`VolumeFault`] for files that are no volumes, grids that are not there or cannot be read, and limits.
    pub fn read(bytes: &[u8], options: &VolumeOptions) -> Result<Self, VolumeFault> {
        let limits = Limits {
            memory_bytes: options.memory_limit,
        };
        if is_npy(bytes) {
            return Self::read_npy(bytes, &limits, options);
        }
        // Whatever is no array is told from an OpenVDB file by its reader.
        if !is_vdb(bytes) {
            return Err(VolumeFault::Unknown);
        }
        let file = npr_vdb::read(bytes, &limits)?;
        let choice = Choice::of(file.grids(), options)?;
        let (velocity, heat) = (choice.read_velocity(&file)?, choice.read_heat(&file)?);
        let notice = choice.guess.then(|| {
            let name = shown(&file.grids()[choice.density].name);
            format!("grid '{name}' is taken for the densities")
        });
        Ok(Self {
            density: Density::Sparse(Box::new(file.scalar_at(choice.density)?)),
            velocity,
            heat,
            up: options.up,
            memory_limit: options.memory_limit,
            notices: notice.into_iter().collect(),
        })
    }

    fn read_npy(
        bytes: &[u8],
        limits: &Limits,
        options: &VolumeOptions,
    ) -> Result<Self, VolumeFault> {
        let array = npy::read(bytes, limits)?;
        let npy::Values::Scalars(values) = array.values else {
            return Err(VolumeFault::Vectors);
        };
        Ok(Self {
            density: Density::Dense(array.size, values),
            velocity: Velocity::Unknown,
            heat: None,
            up: options.up,
            memory_limit: options.memory_limit,
            notices: Vec::new(),
        })
    }

    /// What was guessed, for the user.
    pub fn notices(&self) -> &[String] {
        &self.notices
    }

    /// The box of voxels that are active in the grid of densities.
    pub fn extent(&self) -> Extent {
        match &self.density {
            Density::Sparse(grid) => {
                let bounds = grid.active_bounds();
                Extent {
                    low: bounds.map_or([0; 3], |bounds| bounds.low),
                    size: bounds.map_or([0; 3], |bounds: Bounds| bounds.size()),
                    world_from_index: self.up.turn() * affine(grid.index_to_world()),
                }
            }
            Density::Dense(size, _) => Extent {
                low: [0; 3],
                size: *size,
                world_from_index: array_placement(*size, self.up),
            },
        }
    }

    /// The smoke in a box of voxels, such as the [`extent`](Self::extent), dense.
    ///
    /// What a file holds beyond the box is left out; what it does not hold is empty. Velocities of other grids than the
    /// density's are looked up by place. O(voxels of the box).
    ///
    /// # Errors
    ///
    /// [`VolumeFault`] where the box exceeds a limit.
    pub fn volume(&self, extent: &Extent) -> Result<Volume, VolumeFault> {
        let count = extent.checked_count()?;
        let mut budget = Budget::new(self.memory_limit);
        budget.take("the volume", count, self.bytes_per_voxel())?;
        let (size, place) = extent.turned();
        let mut volume = Volume::new(size, self.densities(extent)?, place)?;
        if let Some(velocity) = self.velocities(extent)? {
            volume = volume.with_velocity(velocity)?;
        }
        if let Some(heat) = &self.heat {
            volume = volume.with_temperature(lookup(heat, extent, self.up)?)?;
        }
        Ok(volume)
    }

    /// Bytes that a voxel of a dense volume takes while it is made and while spheres are fitted to it.
    fn bytes_per_voxel(&self) -> usize {
        let velocity = match &self.velocity {
            Velocity::Unknown => 0,
            Velocity::Vectors(_) => 24,
            Velocity::Components(_) => 28,
        };
        let heat = if self.heat.is_some() { 4 } else { 0 };
        8 + velocity + heat
    }

    fn densities(&self, extent: &Extent) -> Result<Vec<f32>, VolumeFault> {
        match &self.density {
            Density::Sparse(grid) => Ok(grid.dense(extent.low, extent.size)?),
            Density::Dense(size, values) if *size == extent.size => Ok(values.clone()),
            Density::Dense(..) => Err(VolumeError::DifferentGrids {
                first: extent.size.map(|side| side as u32),
                second: self.extent().size.map(|side| side as u32),
            }
            .into()),
        }
    }

    fn velocities(&self, extent: &Extent) -> Result<Option<Vec<Vec3>>, VolumeFault> {
        let turn = self.up.turn().matrix3.as_mat3();
        let vectors: Vec<[f32; 3]> = match &self.velocity {
            Velocity::Unknown => return Ok(None),
            Velocity::Vectors(grid) if grid.info().class == GridClass::Staggered => {
                centred(grid, extent, self.up)?
            }
            Velocity::Vectors(grid) => lookup(grid, extent, self.up)?,
            Velocity::Components(grids) => {
                let [x, y, z] = grids.each_ref().map(|grid| lookup(grid, extent, self.up));
                let (x, y, z) = (x?, y?, z?);
                let rows = x.into_iter().zip(y).zip(z);
                rows.map(|((x, y), z)| [x, y, z]).collect()
            }
        };
        Ok(Some(
            vectors.into_iter().map(|v| turn * Vec3::from(v)).collect(),
        ))
    }
}

/// What became 0 in a volume because it was not usable, for the user; none where all was.
pub fn mended_notice(mended: Mended) -> Option<String> {
    let parts = [
        (mended.density, "densities that are negative or no numbers"),
        (mended.velocity, "velocities that are no numbers"),
        (mended.temperature, "temperatures that are no numbers"),
    ];
    let reported = parts.iter().filter(|(count, _)| *count > 0);
    let reported: Vec<String> = reported
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    (!reported.is_empty()).then(|| format!("{} count as 0", reported.join(", ")))
}

impl UpAxis {
    /// This world from a file's.
    fn turn(self) -> DAffine3 {
        match self {
            Self::Y => DAffine3::IDENTITY,
            Self::Z => DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y)),
        }
    }
}

fn affine(transform: &Transform) -> DAffine3 {
    let [x, y, z, origin] = transform.columns().map(DVec3::from_array);
    DAffine3::from_cols(x, y, z, origin)
}

/// Where an array stands: on the floor, centred over the origin, its longest side 1 unit, as the built-in smoke does.
fn array_placement(size: [usize; 3], up: UpAxis) -> DAffine3 {
    let voxel = 1.0 / size.iter().copied().max().unwrap_or(0).max(1) as f64;
    let size = DVec3::from_array(size.map(|side| side as f64));
    let middle = (size - 1.0) / 2.0;
    let floor = match up {
        UpAxis::Y => DVec3::new(middle.x, -0.5, middle.z),
        UpAxis::Z => DVec3::new(middle.x, middle.y, -0.5),
    };
    up.turn() * DAffine3::from_scale(DVec3::splat(voxel)) * DAffine3::from_translation(-floor)
}

/// Values of a grid at the voxels of a box, z fastest; of a grid that lies elsewhere, those of the nearest voxels.
fn lookup<V: npr_vdb::Voxel>(
    grid: &Grid<V>,
    extent: &Extent,
    up: UpAxis,
) -> Result<Vec<V>, VolumeFault> {
    let own = up.turn() * affine(grid.index_to_world());
    if own == extent.world_from_index {
        return Ok(grid.dense(extent.low, extent.size)?);
    }
    let own_from_index = own.inverse() * extent.world_from_index;
    let places = indices(extent).map(|index| {
        let place = own_from_index.transform_point3(DVec3::from_array(index.map(f64::from)));
        // A float beyond the range becomes the nearest integer.
        grid.value(place.round().to_array().map(|part| part as i32))
    });
    Ok(places.collect())
}

/// Velocities in the middle of voxels from those on their faces.
fn centred(
    grid: &Grid<[f32; 3]>,
    extent: &Extent,
    up: UpAxis,
) -> Result<Vec<[f32; 3]>, VolumeFault> {
    let mut vectors = lookup(grid, extent, up)?;
    for axis in 0..3 {
        let mut next = *extent;
        next.low[axis] = next.low[axis].saturating_add(1);
        let ahead = lookup(grid, &next, up)?;
        for (vector, ahead) in vectors.iter_mut().zip(ahead) {
            vector[axis] = 0.5 * (vector[axis] + ahead[axis]);
        }
    }
    Ok(vectors)
}

/// Indices of a box, z fastest.
fn indices(extent: &Extent) -> impl Iterator<Item = [i32; 3]> + '_ {
    let along = |axis: usize| {
        let low = extent.low[axis];
        (0..extent.size[axis]).map(move |step| low.saturating_add(step as i32))
    };
    along(0).flat_map(move |x| along(1).flat_map(move |y| along(2).map(move |z| [x, y, z])))
}

#[cfg(test)]
mod tests;
