//! What every other crate of the drawing machine stands on.
//!
//! Deterministic math ([`math`]), numbers that look random ([`random`]), the grain of paper ([`grain`]), colour
//! encoding ([`color`]), cameras ([`camera`]), the structs that passes read and write on both engines ([`geometry`],
//! [`window`]), the surface point under a pixel ([`surface`]), packed textures ([`texture`]), and a triangle rasteriser
//! with a stated fill rule ([`raster`]); spheres of smoke ([`smoke`]); the kinds of line ([`line_kind`]), how they are
//! found ([`line_source`]) and the flags of mesh edges ([`edge_flags`]); constants that styles and lines share
//! ([`published_path`]); the door to decoders of others ([`decoding`]); a flag
//! that ends work ([`interrupt`]). Nothing here knows about files, styles or
//! graphics devices.
//!
//! ```
//! use npr_core::camera::Camera;
//!
//! let camera = Camera::framing([-1.0; 3], [1.0; 3]);
//! assert!(camera.eye[1] > 0.0, "a default view looks down on its subject");
//! ```

pub mod budget;
pub mod camera;
pub mod color;
pub mod crease;
pub mod cutout;
pub mod decoding;
pub mod edge_flags;
pub mod geometry;
pub mod grain;
pub mod interrupt;
pub mod layout;
pub mod light_view;
pub mod line_color;
pub mod line_kind;
pub mod line_source;
pub mod list;
pub mod math;
pub mod number;
pub mod outline;
pub mod published_path;
pub mod random;
pub mod raster;
pub mod smoke;
pub mod standard_view;
pub mod surface;
pub mod texture;
pub mod window;

// The macro names its crate by absolute path, so that it works inside this crate too.
extern crate self as npr_core;
