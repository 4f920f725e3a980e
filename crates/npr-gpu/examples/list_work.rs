//! How long a view's contours take in rows where passes follow their number, and where they cover the room.
//!
//! `cargo run --release -p npr-gpu --example list_work`: a ball in the room that models have at first and in one four
//! times as large. Both ways take turns on the best device, software ones included; the least time of seven counts.

use npr_gpu::curves::Scheme;
use npr_gpu::curves::contours::add_contours;
use npr_gpu::device::{AdapterChoice, Device};
use npr_gpu::engine::{Engine, EngineError};
use npr_gpu::graph::Graph;
use npr_mesh::testing::{shape_of, uv_sphere};
use npr_vector::mesh_lines::contour::steps::Viewer;
use npr_vector::mesh_lines::contour::{Eye, usual_room};
use std::time::{Duration, Instant};

fn main() -> Result<(), EngineError> {
    let device = Device::open(AdapterChoice::Any)?;
    println!("{}", device.describe());
    let shape = shape_of(&uv_sphere(400, 200));
    let eye = Eye::new([3.0, 2.0, 4.0, 1.0], 2.0);
    let room = usual_room(shape.faces.len());
    println!("scheme, room, contours, ms sized, ms whole room, ratio");
    for scheme in [Scheme::WYLLIE, Scheme::RULING_SET] {
        for room in [room, 4 * room] {
            let mut graph = Graph::new();
            let counts = [shape.positions.len(), shape.faces.len()];
            let made = add_contours(&mut graph, counts[0], counts[1], room, Some(scheme));
            let plain = graph.clone().without_sizes();
            let mut sessions = Vec::new();
            for graph in [graph, plain] {
                let mut session = device.prepare(graph)?;
                let viewer = [Viewer::from(&eye)];
                session.write(made.viewer, bytemuck::cast_slice(&viewer))?;
                made.write_shape(session.as_mut(), &shape)?;
                sessions.push(session);
            }
            let mut least = [Duration::MAX; 2];
            for _ in 0..7 {
                for (session, least) in sessions.iter_mut().zip(&mut least) {
                    let start = Instant::now();
                    session.run()?;
                    *least = start.elapsed().min(*least);
                }
            }
            let count = sessions[0].read(made.node_count)?[0];
            let [sized, whole] = least.map(|time| time.as_secs_f64() * 1e3);
            let ratio = whole / sized;
            println!("{scheme:?}, {room}, {count}, {sized:.2}, {whole:.2}, {ratio:.2}");
        }
    }
    Ok(())
}
