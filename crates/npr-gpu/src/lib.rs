//! Passes with a shader and a twin each, and the two engines that run them.
//!
//! A [`pass::Pass`] declares what it binds; a [`graph::Graph`] lines passes up into a frame; an [`engine::Engine`]
//! runs the graph: [`processor::Processor`] by the twins, on any machine, or a graphics device by the shaders. All
//! passes are listed in [`passes`].
//!
//! ```
//! use npr_gpu::engine::Engine;
//! use npr_gpu::graph::Graph;
//! use npr_gpu::passes::vector::SCAN_BLOCKS;
//!
//! let mut graph = Graph::new();
//! let values = graph.buffer::<u32>("values", 4);
//! let prefixes = graph.buffer::<u32>("prefixes", 4);
//! let sums = graph.buffer::<u32>("sums", 1);
//! graph.compute(&SCAN_BLOCKS, &[values, prefixes, sums]);
//!
//! let mut session = npr_gpu::processor::Processor.prepare(graph)?;
//! session.write(values, &[3, 0, 2, 5])?;
//! session.run()?;
//! assert_eq!(session.read(prefixes)?, [0, 3, 3, 5]);
//! assert_eq!(session.read(sums)?, [10]);
//! # Ok::<(), npr_gpu::engine::EngineError>(())
//! ```

pub mod changes;
pub mod cost;
pub mod curves;
#[cfg(feature = "wgpu")]
pub mod device;
pub mod engine;
mod flight;
pub mod graph;
pub mod pass;
pub mod passes;
pub mod processor;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
