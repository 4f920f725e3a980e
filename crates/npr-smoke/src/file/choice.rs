//! Which grids of a file are densities, velocities and temperatures.

use super::{VolumeFault, VolumeOptions};
use npr_vdb::{Fault, GridClass, GridInfo, Values};

/// Names under which grids are found where none is asked for, the first that is there; case does not matter.
const DENSITY_NAMES: [&str; 3] = ["density", "smoke", "fog"];
const VELOCITY_NAMES: [&str; 4] = ["velocity", "vel", "v", "motion"];
const HEAT_NAMES: [&str; 6] = ["temperature", "heat", "temp", "flame", "flames", "fire"];

/// How components follow the name of a vector that is stored as three grids.
const COMPONENT_MARKS: [[&str; 3]; 4] = [
    [".x", ".y", ".z"],
    ["_x", "_y", "_z"],
    ["x", "y", "z"],
    ["_0", "_1", "_2"],
];

/// Which grids of a file are which, by their places in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Choice {
    /// The grid of densities.
    pub density: usize,
    /// One grid of velocities, three of their components, or none.
    pub velocity: Vec<usize>,
    /// The grid of temperatures.
    pub heat: Option<usize>,
    /// Whether nothing but being the only one speaks for the grid of densities.
    pub guess: bool,
}

impl Choice {
    /// The grids that options ask for, or else those of usual names.
    ///
    /// # Errors
    ///
    /// [`VolumeFault`] where there is no such grid, or it cannot be what it is to be.
    pub fn of(grids: &[GridInfo], options: &VolumeOptions) -> Result<Self, VolumeFault> {
        // Find the densities, which must not be distances to a surface.
        let (density, guess) = match &options.density {
            Some(name) => (named(grids, name)?, false),
            None => density_of(grids)?,
        };
        if grids[density].class == GridClass::LevelSet {
            let grid = shown(&grids[density].name);
            return Err(VolumeFault::LevelSet { grid });
        }

        // Find the velocities: one grid of vectors or three of components.
        let velocity = match options.velocity.len() {
            0 => velocity_of(grids),
            1 | 3 => {
                let names = options.velocity.iter();
                names
                    .map(|name| named(grids, name))
                    .collect::<Result<_, _>>()?
            }
            count => return Err(VolumeFault::Components { count }),
        };

        // Find the temperatures, unless they are the densities.
        let heat = match &options.heat {
            Some(name) => Some(named(grids, name)?),
            None => called(grids, &HEAT_NAMES, is_number),
        };
        Ok(Self {
            density,
            velocity,
            heat: heat.filter(|heat| *heat != density),
            guess,
        })
    }

    /// What a grid is used as, by its place in the file.
    pub fn use_of(&self, place: usize) -> Option<&'static str> {
        if place == self.density {
            Some("density")
        } else if self.velocity.contains(&place) {
            Some("velocity")
        } else {
            (self.heat == Some(place)).then_some("temperature")
        }
    }
}

fn is_number(info: &GridInfo) -> bool {
    matches!(&info.values, Values::Known(kind) if !kind.is_vector()) && info.transform.is_ok()
}

fn is_vector(info: &GridInfo) -> bool {
    matches!(&info.values, Values::Known(kind) if kind.is_vector()) && info.transform.is_ok()
}

/// The first grid of a name, exactly as asked for.
fn named(grids: &[GridInfo], name: &str) -> Result<usize, VolumeFault> {
    let place = grids.iter().position(|info| info.name == name);
    place.ok_or_else(|| {
        let fault = Fault::NoGrid {
            name: name.to_owned(),
            names: grids.iter().map(|info| info.name.clone()).collect(),
        };
        fault.into()
    })
}

/// The first grid that is called by the first of `names` that any is called by.
fn called(grids: &[GridInfo], names: &[&str], fits: fn(&GridInfo) -> bool) -> Option<usize> {
    let find = |name: &&str| {
        let is_it = |info: &GridInfo| fits(info) && info.name.eq_ignore_ascii_case(name);
        grids.iter().position(is_it)
    };
    names.iter().find_map(find)
}

/// The grid of densities, and whether only its being alone speaks for it.
fn density_of(grids: &[GridInfo]) -> Result<(usize, bool), VolumeFault> {
    if let Some(place) = called(grids, &DENSITY_NAMES, is_number) {
        return Ok((place, false));
    }
    let could_be = |info: &GridInfo| is_number(info) && info.class != GridClass::LevelSet;
    let numbers: Vec<usize> = (0..grids.len())
        .filter(|&at| could_be(&grids[at]))
        .collect();
    match numbers[..] {
        [only] => Ok((only, true)),
        [] => Err(nothing_drawn(grids)),
        _ => {
            let names = numbers.iter().take(5);
            let names = names.map(|&at| format!("'{}'", shown(&grids[at].name)));
            let names = names.collect::<Vec<_>>().join(", ");
            Err(VolumeFault::NoDensity { names })
        }
    }
}

/// Why none of the grids can be drawn, by the first of them.
fn nothing_drawn(grids: &[GridInfo]) -> VolumeFault {
    let Some(first) = grids.first() else {
        let found = "the file is empty".to_owned();
        return VolumeFault::NothingDrawn { found };
    };
    let grid = shown(&first.name);
    if let Some(level) = grids.iter().find(|info| info.class == GridClass::LevelSet) {
        let grid = shown(&level.name);
        return VolumeFault::LevelSet { grid };
    }
    let found = match &first.transform {
        Err(map) => format!(
            "grid '{grid}' has transform {}, which is not read",
            shown(map)
        ),
        Ok(_) => format!("grid '{grid}' has type {}", first.values),
    };
    VolumeFault::NothingDrawn { found }
}

/// One grid of velocities, or three of their components, or none.
fn velocity_of(grids: &[GridInfo]) -> Vec<usize> {
    if let Some(place) = called(grids, &VELOCITY_NAMES, is_vector) {
        return vec![place];
    }
    let all = VELOCITY_NAMES
        .iter()
        .flat_map(|name| COMPONENT_MARKS.map(|marks| marks.map(|mark| format!("{name}{mark}"))));
    let find = |names: [String; 3]| -> Option<Vec<usize>> {
        let places = names.iter().map(|name| called(grids, &[name], is_number));
        places.collect()
    };
    all.into_iter().find_map(find).unwrap_or_default()
}

/// A name from a file, fit for a line of text.
pub(super) fn shown(name: &str) -> String {
    let escaped = name.chars().take(40).flat_map(char::escape_debug);
    escaped.collect()
}
