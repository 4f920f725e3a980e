//! What needs a graphics device, in one program so that all tests share the device and its compiled passes.
//!
//! Software devices will do. Without any, the tests say so and pass, unless `NPR_REQUIRE_GPU=1` is set.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod agreement;
mod cliffs;
mod contours;
mod costs;
mod curves;
mod detection;
mod draws;
mod flight;
mod frame;
mod host;
mod lists;
mod memory;
mod pixels;
mod sample_passes;
mod sampled;
mod scene;
mod shapes;
mod trouble;
mod twins;
mod work;

use npr_gpu::device::testing as shared;
