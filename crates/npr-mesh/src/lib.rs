//! What a line drawing needs to know about a triangle mesh before the first frame.
//!
//! Files store a vertex once per texture seam; lines need the surface. So positions are welded first
//! ([`weld()`]), then the shared edges are listed with the two faces beside each ([`unique_edges`]),
//! and normals ([`normals`]) and curvature ([`curvature`](mod@curvature)) are gathered over the welded vertices.
//! Lines that are linked into curves start from a [`shape`]: half-edges, unique edges and their traits in one
//! call.
//!
//! ```
//! use npr_mesh::{Mesh, unique_edges, weld};
//!
//! let tetrahedron = Mesh::new(
//!     vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
//!     vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
//! )?;
//! let (positions, triangles) = (tetrahedron.positions(), tetrahedron.triangles());
//!
//! let welded = weld(positions, 0.0);
//! let edges = unique_edges(positions, triangles, &welded, &[]);
//! assert_eq!(edges.len(), 6);
//!
//! // Every edge of a tetrahedron is sharper than 40 degrees.
//! let crease_cos = npr_core::math::cos(40.0_f32.to_radians());
//! assert!(edges.iter().all(|edge| edge.dihedral_cos < crease_cos));
//! # Ok::<(), npr_mesh::MeshError>(())
//! ```
//!
//! Everything is a pure function over slices: the same input gives the same bits, whatever the number
//! of threads. Positions are `f32`; sums and products run in `f64`, where no finite `f32` mesh can
//! overflow or lose a non-zero area.
//!
//! Sources are cited by key, such as [Rusinkiewicz 2004]; `REFERENCES.md` of the project lists them.

mod buckets;
pub mod calm;
pub mod card;
mod card_lines;
pub mod classify;

mod cluster;
pub mod components;
pub mod content_hash;
pub mod crease;
pub mod curvature;
mod degenerate_faces;
pub mod direction_field;
pub mod edges;
pub mod half_edge;
mod half_edge_groups;
pub mod hull;
mod isolated;
pub mod mesh;
pub mod normals;
pub mod pose;
pub mod project;
pub mod shape;
pub mod smoothing;
pub mod stroke_chart;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
mod triangle;
pub mod union_find;
pub mod vertex_fans;
mod wedges;
pub mod weld;

pub use components::components;
pub use curvature::{Curvature, curvature};
pub use edges::{Edge, NO_FACE, unique_edges};
pub use mesh::{Mesh, MeshError};
pub use normals::{crease_normals, face_normals, smooth_normals};
pub use npr_core::edge_flags::EdgeFlags;
pub use smoothing::smooth_curvature;
pub use weld::{Weld, weld};
