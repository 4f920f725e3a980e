//! Every step against a slow oracle, and the whole path on shapes whose outline is known.

mod edges;
mod loops;
mod pixels;
mod whole;
