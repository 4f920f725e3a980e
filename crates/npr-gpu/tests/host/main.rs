//! What needs no graphics device: declarations of passes, and graphs on the processor.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod declarations;
mod processor;
