//! Outlines that adapt to the background: where a dark sleeve meets a dark wall, its line lifts just enough to read.
//!
//! Two ways. [`published`] is the method of [Tsuji 2014] on two pictures, to compare with. [`adapt`] is ours: it
//! moves a line's lightness, keeps everything continuous, works on black rims, and leaves alone what already reads.
//!
//! ```
//! use npr_style::backdrop::{Rule, adapt};
//!
//! let rule = Rule { goal: 0.3, ..Rule::CONTRAST };
//! let (line, sleeve) = ([0.0; 3], [0.1, 0.1, 0.3]);
//!
//! // On white a black line reads; before a dark wall it becomes a lighter blue of the sleeve.
//! assert_eq!(adapt(line, sleeve, [1.0; 3], &rule), line);
//! let lifted = adapt(line, sleeve, [0.1; 3], &rule);
//! assert!(lifted[2] > lifted[0] && lifted[0] > 0.1);
//! ```

mod adapt;
mod contrast_cache;
mod gather;
mod occupied;
mod oklab;
pub mod published;
mod rims;
mod room;
mod rule;
mod spread;
mod stretch;

pub use adapt::{Ground, adapt, adapted_light, contrast};
pub use contrast_cache::ContrastCache;
pub use gather::{TileRims, gather_tiles};
pub use oklab::{light_of_oklab, oklab_of_light};
pub use published::Criteria;
pub use rims::{
    PartSubject, Rim, Scenery, Search, TILE, draw_rims, find_rims, flag_tiles, tiles_across,
};
pub use rule::{RULES_MAX, Rule, Rules};
pub use spread::{SMOOTH_MOST, UNLIKE_COLORS, smooth_rims, spread_rims, spread_rows};
pub use stretch::{BIAS_REACH_MOST, ContrastBias, blend_biases, bound_tiles, vote_bias};

#[cfg(test)]
mod tests;
