//! Passes with a shader and a twin each, and the two engines that run them.
//!
//! A [`pass::Pass`] declares what it binds; a [`graph::Graph`] lines passes up into a frame; an [`engine::Engine`]
//! runs the graph: [`processor::Processor`] by the twins, on any machine, or a graphics device by the shaders. All
//! passes are listed in [`passes`].
//!
//! ```
//! use npr_gpu::engine::Engine;
//! use npr_gpu::graph::Graph;
//! use npr_gpu::passes::line::FLAG_TILES;
//! use npr_core::geometry::Stamp;
//! use npr_core::window::Window;
//!
//! let mut graph = Graph::new();
//! let window = graph.uniform::<Window>("mask window");
//! let stamps = graph.buffer::<Stamp>("stamps", 64);
//! let tiles = graph.buffer::<u32>("tiles", 1);
//! graph.compute(&FLAG_TILES, &[window, stamps, tiles]);
//!
//! let mut session = npr_gpu::processor::Processor.prepare(graph)?;
//! let grid = Window::over([8.0, 8.0], [0.0; 2], [8.0, 8.0], [8, 8]);
//! session.write(window, bytemuck::cast_slice(&[grid]))?;
//! session.run()?;
//! assert_eq!(session.read(tiles)?, [0], "no stamp was set");
//! # Ok::<(), npr_gpu::engine::EngineError>(())
//! ```

pub mod cost;
pub mod curves;
#[cfg(feature = "wgpu")]
pub mod device;
pub mod engine;
pub mod graph;
pub mod pass;
pub mod passes;
pub mod processor;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
