//! Devices that stop working, and shaders that do not compile.

use crate::sample_passes::DOUBLE;
use crate::shared;
use npr_gpu::engine::{Engine, EngineError};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Pass;
use npr_shaders::Shader;

fn doubling() -> (Graph, ResourceId) {
    let mut graph = Graph::new();
    let (from, to) = (
        graph.buffer::<u32>("numbers", 100),
        graph.buffer::<u32>("doubled", 100),
    );
    graph.compute(&DOUBLE, &[from, to]);
    (graph, to)
}

#[test]
fn after_a_loss_every_call_says_so() {
    let Some(device) = shared::open() else { return };
    let (graph, doubled) = doubling();
    let mut session = device.prepare(graph.clone()).unwrap();
    device.destroy();
    assert!(matches!(session.run(), Err(EngineError::Lost { .. })));
    assert!(matches!(
        session.write(doubled, &[1]),
        Err(EngineError::Lost { .. })
    ));
    assert!(matches!(
        session.read(doubled),
        Err(EngineError::Lost { .. })
    ));
    assert!(matches!(
        device.prepare(graph),
        Err(EngineError::Lost { .. })
    ));
}

#[test]
fn a_result_is_not_read_from_a_lost_device() {
    let Some(device) = shared::open() else { return };
    let (graph, doubled) = doubling();
    let mut session = device.prepare(graph).unwrap();
    session.run().unwrap();
    device.destroy();
    assert!(matches!(
        session.read(doubled),
        Err(EngineError::Lost { .. })
    ));
}

#[test]
fn a_device_opened_anew_works_after_a_loss() {
    let Some(lost) = shared::open() else { return };
    lost.destroy();
    let Some(device) = shared::open() else { return };
    let (graph, doubled) = doubling();
    let mut session = device.prepare(graph).unwrap();
    session.run().unwrap();
    assert_eq!(session.read(doubled).unwrap()[99], 99);
}

#[test]
fn a_shader_that_does_not_compile_is_named() {
    const BROKEN: Pass = Pass {
        name: "test.broken",
        shader: Shader {
            path: "test",
            text: "fn main() { nonsense",
        },
        ..DOUBLE
    };
    let Some(device) = shared::device() else {
        return;
    };
    let mut graph = Graph::new();
    let (from, to) = (
        graph.buffer::<u32>("numbers", 1),
        graph.buffer::<u32>("doubled", 1),
    );
    graph.compute(&BROKEN, &[from, to]);
    let refused = device.prepare(graph).err();
    assert!(
        matches!(refused, Some(EngineError::Failed { ref place, .. }) if place == "test.broken"),
        "{refused:?}"
    );
}
