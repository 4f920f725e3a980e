//! The contents of a volume file.

use super::words::{decimals_for, list, point};
use crate::fault::Fault;
use crate::message::{name, plain, quoted};
use crate::volume::of_volume;
use npr_smoke::file::{Choice, VolumeFault, VolumeFile, VolumeOptions};
use npr_vdb::{File, Grid, GridClass, GridInfo, Limits, Voxel, npy};
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;

/// The contents of a volume file: its grids, what becomes smoke and what is ignored.
#[derive(Debug, Clone, Serialize)]
pub struct VolumeInventory {
    /// The file as the user named it.
    file: String,
    format: String,
    bytes: u64,
    grids: Vec<GridEntry>,
    /// Bounding box, in world space, of the voxels that become smoke; `None` where there are none.
    bounds: Option<super::Bounds>,
    /// Size, in voxels, of the dense box that smoke is made of.
    size: Option<[usize; 3]>,
    /// What is ignored, and why.
    ignored: Vec<String>,
}

/// One grid.
#[derive(Debug, Clone, Serialize)]
struct GridEntry {
    name: String,
    kind: String,
    half_floats: bool,
    class: &'static str,
    /// The role of the grid in drawing smoke; `None` where it is not drawn.
    used_as: Option<&'static str>,
    /// Size, in voxels, of the box around the active voxels.
    size: Option<[usize; 3]>,
    active_voxel_count: Option<u64>,
    /// Side lengths of a voxel, in world units.
    voxel_size: Option<[f64; 3]>,
    /// Matrix from index space to world space, column by column.
    transform: Option<[[f64; 3]; 4]>,
    /// Least and greatest active value; of vectors, of their lengths.
    range: Option<[f32; 2]>,
    /// Number of active values that are infinite or NaN.
    unusable_value_count: usize,
}

impl VolumeInventory {
    /// The inventory of a volume from the file that the user named `file`.
    pub fn new(file: &str, bytes: &[u8], options: &VolumeOptions) -> Result<Self, Fault> {
        // List what is in the file, whether it is drawn or not.
        let faulty = |fault| of_volume(&quoted(Path::new(file)), fault);
        let mut inventory = Self {
            file: file.to_owned(),
            format: String::new(),
            bytes: bytes.len() as u64,
            grids: Vec::new(),
            bounds: None,
            size: None,
            ignored: Vec::new(),
        };
        let limits = Limits {
            memory_bytes: options.memory_limit,
        };
        let listed = match bytes.starts_with(b"\x93") {
            true => inventory.list_array(bytes, &limits),
            false => inventory.list_grids(bytes, &limits, options),
        };
        listed.map_err(faulty)?;

        // Measure what becomes smoke, or say why nothing does.
        match VolumeFile::read(bytes, options) {
            Ok(volume) => inventory.measure(&volume),
            Err(fault) => inventory.ignored.push(format!("nothing is drawn: {fault}")),
        }
        Ok(inventory)
    }

    fn list_array(&mut self, bytes: &[u8], limits: &Limits) -> Result<(), VolumeFault> {
        // Measure the values: only numbers can be densities.
        self.format = "NumPy array".to_owned();
        let array = npy::read(bytes, limits)?;
        let mut values = Range::default();
        let (kind, used_as) = match &array.values {
            npy::Values::Scalars(numbers) => {
                numbers.iter().for_each(|number| values.add(*number));
                ("numbers", Some("density"))
            }
            npy::Values::Vectors(vectors) => {
                vectors
                    .iter()
                    .for_each(|vector| values.add(length(*vector)));
                ("vectors", None)
            }
        };

        // List the array as the one grid of the file.
        self.grids.push(GridEntry {
            name: String::new(),
            kind: kind.to_owned(),
            used_as,
            size: Some(array.size),
            range: values.range,
            unusable_value_count: values.unusable,
            ..GridEntry::unread("")
        });
        Ok(())
    }

    fn list_grids(
        &mut self,
        bytes: &[u8],
        limits: &Limits,
        options: &VolumeOptions,
    ) -> Result<(), VolumeFault> {
        // List every grid with what it is used as.
        let file = npr_vdb::read(bytes, limits).map_err(|fault| match fault {
            npr_vdb::Fault::NotVdb => VolumeFault::Unknown,
            fault => fault.into(),
        })?;
        self.format = format!("OpenVDB {}", file.version());
        let choice = Choice::of(file.grids(), options).ok();
        for (place, info) in file.grids().iter().enumerate() {
            let used_as = choice.as_ref().and_then(|choice| choice.use_of(place));
            self.grids.push(GridEntry {
                used_as,
                ..GridEntry::of(&file, place, info)?
            });
        }

        // Say which grids are not drawn.
        let unused = self.grids.iter().filter(|grid| grid.used_as.is_none());
        let unused = unused.map(|grid| format!("grid '{}' is not drawn", name(&grid.name)));
        self.ignored.extend(unused);
        Ok(())
    }

    fn measure(&mut self, volume: &VolumeFile) {
        self.ignored.extend_from_slice(volume.notices());
        let extent = volume.extent();
        self.size = Some(extent.size);
        self.bounds = extent.bounds().map(|(min, max)| super::Bounds { min, max });
    }

    /// The inventory as lines for people.
    pub fn text(&self) -> String {
        // Tell what is in the file.
        let mut text = format!(
            "{}: {}, {} bytes\n",
            plain(&self.file),
            self.format,
            self.bytes
        );
        list(&mut text, "grid", self.grids.iter().map(GridEntry::text));

        // Tell what becomes smoke, then what is ignored.
        if let Some(super::Bounds { min, max }) = &self.bounds {
            let decimals = decimals_for(*min, *max);
            let (min, max) = (point(*min, decimals), point(*max, decimals));
            let _ = writeln!(text, "bounds {min} to {max}");
        }
        if let Some([x, y, z]) = self.size {
            let _ = writeln!(text, "draws smoke from {x}x{y}x{z} voxels");
        }
        list(
            &mut text,
            "note:",
            self.ignored.iter().map(|note| plain(note)),
        );
        text
    }
}

impl GridEntry {
    /// A grid of which only the type is known.
    fn unread(kind: &str) -> Self {
        Self {
            name: String::new(),
            kind: kind.to_owned(),
            half_floats: false,
            class: "",
            used_as: None,
            size: None,
            active_voxel_count: None,
            voxel_size: None,
            transform: None,
            range: None,
            unusable_value_count: 0,
        }
    }

    /// Describes a grid, and measures its values where their type is supported.
    fn of(file: &File<'_>, place: usize, info: &GridInfo) -> Result<Self, VolumeFault> {
        // Tell what the file states.
        let transform = info.transform.as_ref().ok();
        let entry = Self {
            name: info.name.clone(),
            half_floats: info.is_half,
            class: class_name(info.class),
            voxel_size: transform.map(npr_vdb::Transform::voxel_size),
            transform: transform.map(npr_vdb::Transform::columns),
            ..Self::unread(&info.values.to_string())
        };

        // Measure the values where they can be read.
        let is_read = info.transform.is_ok();
        match &info.values {
            npr_vdb::Values::Known(kind) if is_read && kind.is_vector() => {
                Ok(entry.measured(&file.vector_at(place)?, length))
            }
            npr_vdb::Values::Known(_) if is_read => {
                Ok(entry.measured(&file.scalar_at(place)?, |value| value))
            }
            _ => Ok(entry),
        }
    }

    fn measured<V: Voxel>(self, grid: &Grid<V>, size_of: impl Fn(V) -> f32) -> Self {
        let mut values = Range::default();
        let tiles = grid.tiles().iter().filter(|tile| tile.is_active);
        tiles.for_each(|tile| values.add(size_of(tile.value)));
        for leaf in grid.leaves() {
            for (at, value) in leaf.values.iter().enumerate() {
                if leaf.active[at >> 3] >> (at & 7) & 1 == 1 {
                    values.add(size_of(*value));
                }
            }
        }
        Self {
            size: grid.active_bounds().map(|bounds| bounds.size()),
            active_voxel_count: Some(grid.active_voxel_count()),
            range: values.range,
            unusable_value_count: values.unusable,
            ..self
        }
    }

    fn text(&self) -> String {
        // Tell what the grid is called and what it holds.
        let mut text = format!("'{}' {}", name(&self.name), name(&self.kind));
        if self.half_floats {
            text.push_str(" stored in half");
        }
        if !self.class.is_empty() {
            let _ = write!(text, ", {}", self.class);
        }

        // Tell how large it is.
        if let Some([x, y, z]) = self.size {
            let _ = write!(text, ", {x}x{y}x{z} voxels");
        }
        if let Some([x, y, z]) = self.voxel_size {
            let is_cube = (x - y).abs().max((x - z).abs()) < 1e-6 * x;
            let sides = if is_cube {
                format!("{x:.4}")
            } else {
                format!("{x:.4}x{y:.4}x{z:.4}")
            };
            let _ = write!(text, " of {sides}");
        }

        // Tell what its values are, and what becomes of them.
        if let Some(count) = self.active_voxel_count {
            let _ = write!(text, ", {count} active");
        }
        if let Some([least, most]) = self.range {
            let _ = write!(text, ", values {least} to {most}");
        }
        if self.unusable_value_count > 0 {
            let _ = write!(text, ", {} no numbers", self.unusable_value_count);
        }
        if let Some(used_as) = self.used_as {
            let _ = write!(text, ": {used_as}");
        }
        text
    }
}

fn class_name(class: GridClass) -> &'static str {
    match class {
        GridClass::Unset => "",
        GridClass::LevelSet => "level set",
        GridClass::FogVolume => "fog volume",
        GridClass::Staggered => "staggered",
    }
}

fn length(vector: [f32; 3]) -> f32 {
    vector.iter().map(|part| part * part).sum::<f32>().sqrt()
}

/// The least and greatest of some numbers, and how many were not finite.
#[derive(Debug, Clone, Copy, Default)]
struct Range {
    range: Option<[f32; 2]>,
    unusable: usize,
}

impl Range {
    fn add(&mut self, value: f32) {
        if !value.is_finite() {
            self.unusable += 1;
            return;
        }
        let [least, most] = self.range.unwrap_or([value; 2]);
        self.range = Some([least.min(value), most.max(value)]);
    }
}
