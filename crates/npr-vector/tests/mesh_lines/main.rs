//! Lines of meshes: what must hold on every mesh, from every eye.

mod creases_going_on;
mod crowds;
mod line_parts;
mod lines;
mod polylines;
mod rounded_edges;
mod surface_locations;
