//! What the benchmarks of whole frames share with `measure`, the program that writes their tables.
//!
//! Subjects ([`subject`]) are meshes of an exact number of triangles ([`solid`]) or models from outside; [`timing`]
//! takes medians, [`cost`] fits how time grows with triangles and pixels, [`card`] predicts it, [`memory`] and
//! [`machine`] ask the system, and [`device`](mod@device) opens a graphics device where there is one.
//!
//! ```
//! let cost = npr_benches::cost::Cost::fit(&[
//!     npr_benches::cost::Sample { triangles: 1e3, pixels: 1e6, ms: 11.0 },
//!     npr_benches::cost::Sample { triangles: 1e5, pixels: 1e6, ms: 20.0 },
//!     npr_benches::cost::Sample { triangles: 1e3, pixels: 2e6, ms: 21.0 },
//!     npr_benches::cost::Sample { triangles: 1e5, pixels: 2e6, ms: 30.0 },
//! ]);
//! assert!(cost.is_some_and(|cost| cost.r_squared > 0.999));
//! ```

pub mod card;
pub mod comic;
pub mod cost;
pub mod dashes;
#[cfg(feature = "wgpu")]
pub mod device;
#[cfg(not(feature = "wgpu"))]
#[path = "no_device.rs"]
pub mod device;
pub mod ledger;
pub mod lines;
pub mod machine;
pub mod memory;
pub mod motion;
pub mod orbit;
pub mod outline_color;
pub mod sheet;
pub mod smoke;
pub mod solid;
pub mod subject;
pub mod table;
pub mod timing;
pub mod tones;
