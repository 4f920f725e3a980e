//! What a file says of its grids before any is read.

use crate::bounds::Bounds;
use crate::metadata::{MetaValue, Metadata};
use crate::transform::Transform;
use crate::voxel::ValueType;

/// What a file says of one of its grids.
#[derive(Debug, Clone, PartialEq)]
pub struct GridInfo {
    /// Its name. Several grids may have one name, and it may be empty.
    pub name: String,
    /// What its voxels hold.
    pub values: Values,
    /// Whether real numbers are stored as half floats.
    pub is_half: bool,
    /// What its values mean.
    pub class: GridClass,
    /// Where it lies; the name of the transform's type where that is not linear and so not read.
    pub transform: Result<Transform, String>,
    /// The box of active voxels as the file states it. [`Grid::active_bounds`](crate::Grid::active_bounds) knows it.
    pub stated_bounds: Option<Bounds>,
    /// How many voxels are active as the file states it.
    pub stated_voxel_count: Option<u64>,
    /// Everything else the file says of it.
    pub metadata: Metadata,
}

/// What the voxels of a grid hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Values {
    /// Values that are read, in a tree of the usual layout.
    Known(ValueType),
    /// Anything else: the type of the tree as the file names it.
    Other(String),
}

/// What the values of a grid mean.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum GridClass {
    /// Not stated, or "unknown": files of smoke often leave it out.
    #[default]
    Unset,
    /// Distances to a surface, negative inside: no density.
    LevelSet,
    /// Densities.
    FogVolume,
    /// Velocities on faces between voxels.
    Staggered,
}

const HALF_SUFFIX: &str = "_HalfFloat";

impl Values {
    /// What a tree of this type holds, and whether its type says that it is stored as half floats.
    pub(crate) fn of_tree(type_name: &str) -> (Self, bool) {
        let full_name = type_name.strip_suffix(HALF_SUFFIX);
        let name = full_name.unwrap_or(type_name);
        let value = name
            .strip_prefix("Tree_")
            .and_then(|name| name.strip_suffix("_5_4_3"));
        let values = match value.and_then(ValueType::of_name) {
            Some(known) => Self::Known(known),
            None => Self::Other(name.to_owned()),
        };
        (values, full_name.is_some())
    }
}

impl std::fmt::Display for Values {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Known(known) => known.fmt(f),
            Self::Other(name) => f.write_str(&crate::shown::shown(name)),
        }
    }
}

impl GridClass {
    fn of_metadata(metadata: &Metadata) -> Self {
        match metadata.text("class") {
            Some("level set") => Self::LevelSet,
            Some("fog volume") => Self::FogVolume,
            Some("staggered") => Self::Staggered,
            _ => Self::Unset,
        }
    }
}

impl GridInfo {
    pub(crate) fn new(
        name: String,
        type_name: &str,
        transform: Result<Transform, String>,
        metadata: Metadata,
    ) -> Self {
        // Trust the metadata before the type's name.
        let (values, type_says_half) = Values::of_tree(type_name);
        let is_half = match metadata.get("is_saved_as_half_float") {
            Some(&MetaValue::Flag(is_half)) => is_half,
            _ => type_says_half,
        };
        let count = match metadata.get("file_voxel_count") {
            Some(&MetaValue::Integer(count)) => u64::try_from(count).ok(),
            _ => None,
        };
        Self {
            name,
            values,
            is_half,
            class: GridClass::of_metadata(&metadata),
            transform,
            stated_bounds: stated_bounds(&metadata),
            stated_voxel_count: count,
            metadata,
        }
    }
}

/// Nothing where it is not stated or empty: empty grids state a box from highest to lowest.
fn stated_bounds(metadata: &Metadata) -> Option<Bounds> {
    let corner = |name: &str| match metadata.get(name)? {
        MetaValue::Integers(corner) => <[i32; 3]>::try_from(corner.as_slice()).ok(),
        _ => None,
    };
    let bounds = Bounds {
        low: corner("file_bbox_min")?,
        high: corner("file_bbox_max")?,
    };
    let is_some = bounds
        .low
        .iter()
        .zip(bounds.high)
        .all(|(&low, high)| low <= high);
    is_some.then_some(bounds)
}
