//! Lines drawn into a picture: the whole path on both engines, and each of its passes on the same input.

use crate::agreement::{Meaning, disagreement};
use crate::sample_passes::LAY_DEPTHS;
use crate::shared;
use npr_core::camera::{Camera, Projection};
use npr_core::line_kind::KindSet;
use npr_gpu::curves::pixels::{Hiding, PixelRoom, add_pixel_contours, add_strips};
use npr_gpu::curves::{Hiders, ResidentPixels, Scheme, trace_on};
use npr_gpu::engine::{Engine, Session};
use npr_gpu::graph::{Graph, Kind, ResourceId, WorkSize};
use npr_gpu::pass::{Format, Pass};
use npr_gpu::passes::ALL;
use npr_gpu::processor::Processor;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::{cube, shape_of, torus, uv_sphere};
use npr_vector::mesh_lines::draw::eye_of;
use npr_vector::pixel_strokes::edge::drawn_edges;
use npr_vector::pixel_strokes::stroke::Loops;
use npr_vector::pixel_strokes::{PixelScene, PublishedPath, scene_depths, trace};
use npr_vector::project::Projector;

const SIZE: [u32; 2] = [160, 120];

/// The passes that are tested here.
const OWN: [&str; 18] = [
    "vector.mark_edges",
    "vector.project_edges",
    "vector.draw_surfaces",
    "vector.emit_fragments",
    "vector.test_fragments",
    "vector.draw_nearest",
    "vector.mark_sides",
    "vector.link_sides",
    "vector.gather_sides",
    "vector.drop_specks",
    "vector.smooth_loops",
    "vector.fit_tangents",
    "vector.cull_sides",
    "vector.vote_sides",
    "vector.start_strips",
    "vector.rank_strips",
    "vector.measure_strips",
    "vector.drop_short",
];

/// Whether a pass is tested here.
pub fn is_over_pixels(pass: &Pass) -> bool {
    OWN.contains(&pass.name)
}

fn scenes() -> Vec<(HalfEdgeMesh, Projection)> {
    let perspective = Projection::Perspective { fov_y: 0.7 };
    vec![
        (shape_of(&uv_sphere(24, 12)), perspective),
        (shape_of(&torus(30, 14, 1.0, 0.4)), perspective),
        (
            shape_of(&torus(30, 14, 1.0, 0.4)),
            Projection::Parallel { height: 3.0 },
        ),
        (shape_of(&cube()), perspective),
    ]
}

/// Calls `test` with a scene and its depths.
fn with_scene(
    shape: &HalfEdgeMesh,
    projection: Projection,
    mut test: impl FnMut(&PixelScene<'_>, &[f32]),
) {
    let camera = Camera {
        eye: [2.0, 1.7, 3.1],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection,
    };
    let bounds = ([-1.5; 3], [1.5; 3]);
    let view = camera.view(SIZE, bounds);
    let projector = Projector::new(&camera, SIZE, bounds);
    let scene = PixelScene {
        shape,
        view: &view,
        eye: &eye_of(shape, &projector),
        kinds: KindSet::BITS,
        creases: 0.766.into(),
        is_drawn: &[],
    };
    test(&scene, &scene_depths(shape, &view));
}

#[test]
fn pictures_and_rows_are_those_of_the_processor() {
    let path = PublishedPath::default();
    for (shape, projection) in scenes() {
        with_scene(&shape, projection, |scene, depths| {
            let expected = trace(scene, &path, depths).unwrap();
            assert!(expected.sides.len() > 100);
            assert!(trace_on(&Processor, scene, &path, depths).unwrap() == expected);
            if let Some(device) = shared::device() {
                assert!(trace_on(device, scene, &path, depths).unwrap() == expected);
            }
        });
    }
}

/// A shape that stays on an engine gives every view what it gives the first, and the processor's strips within
/// rounding.
#[test]
fn views_leave_nothing_behind() {
    let path = PublishedPath::default();
    let shape = shape_of(&torus(30, 14, 1.0, 0.4));
    let parallel = |height| Projection::Parallel { height };
    let device = shared::device().map(|device| device as &dyn Engine);
    for engine in [Some(&Processor as &dyn Engine), device]
        .into_iter()
        .flatten()
    {
        let mut resident = ResidentPixels::new(engine, &shape);
        for projection in [
            parallel(3.0),
            parallel(9.0),
            Projection::Perspective { fov_y: 0.4 },
        ] {
            with_scene(&shape, projection, |scene, depths| {
                for hiders in [Hiders::Surfaces, Hiders::Given(depths)] {
                    let (traced, loops) = resident.draw(scene, &path, hiders).unwrap();
                    let (fresh, fresh_loops) = ResidentPixels::new(engine, &shape)
                        .draw(scene, &path, hiders)
                        .unwrap();
                    assert!(traced == fresh && traced.sides.len() > 100);
                    let strips: Vec<_> = loops.strips().collect();
                    assert!(strips == fresh_loops.strips().collect::<Vec<_>>());
                    let expected: Vec<_> = Loops::new(&traced, &path).strips().collect();
                    assert!(!expected.is_empty() && strips == expected);
                }
            });
        }
    }
}

#[test]
fn every_pass_agrees_with_its_twin() {
    let Some(device) = shared::device() else {
        return;
    };
    let path = PublishedPath::default();
    for (shape, projection) in scenes() {
        with_scene(&shape, projection, |scene, depths| {
            let mut graph = Graph::new();
            let room = PixelRoom {
                segments: 300,
                fragments: 4000,
                sides: 4001,
            };
            let picture = (SIZE, Hiding::Veiled);
            let contours =
                add_pixel_contours(&mut graph, scene.shape, picture, room, Scheme::WYLLIE);
            let strips = add_strips(&mut graph, &contours, &path);
            let mut session = Processor.prepare(graph.clone()).unwrap();
            let edges = drawn_edges(scene.shape, scene.creases, scene.is_drawn);
            contours
                .write_shape(session.as_mut(), scene.shape, &edges)
                .unwrap();
            // A smoke layer that hides a strip of the picture.
            let occluder_depths: Vec<f32> = (0..)
                .zip(depths)
                .map(|(i, z)| if i % SIZE[0] < 40 { 2.0 * z } else { 0.0 })
                .collect();
            contours
                .write_view(session.as_mut(), scene, &path, &occluder_depths)
                .unwrap();
            strips.write(session.as_mut(), &path).unwrap();
            session.run().unwrap();
            let surfaces = bytemuck::cast_slice(depths);
            check_nodes(&graph, (session.as_mut(), surfaces), device);
        });
    }
    assert!(ALL.iter().filter(|pass| is_over_pixels(pass)).count() == OWN.len());
}

/// The resource to write so that another has these words: itself, or what is drawn into an image of depths.
fn input_of(graph: &mut Graph, id: ResourceId) -> ResourceId {
    let Kind::Image {
        format: Format::Depth,
        size,
        ..
    } = graph.resource(id).kind
    else {
        return id;
    };
    let width = graph.constants("width", &[size[0]]);
    let depths = graph.buffer::<u32>("depths", (size[0] * size[1]) as usize);
    graph.draw(&LAY_DEPTHS, &[width, depths], &[id], true);
    depths
}

/// Runs every node of a graph by itself on both engines, on what the whole graph left in `session`; depths of fragments
/// lie there where those of `surfaces` were.
fn check_nodes(
    graph: &Graph,
    (session, surfaces): (&mut dyn Session, &[u32]),
    device: &dyn Engine,
) {
    for node in graph
        .nodes()
        .iter()
        .filter(|node| is_over_pixels(node.pass))
    {
        let mut alone = Graph::new();
        let (mut bound, mut inputs, mut outputs) = (Vec::new(), Vec::new(), Vec::new());
        for (index, id) in node.bound.iter().enumerate() {
            let resource = graph.resource(*id);
            let own = alone.add(resource.name, resource.kind);
            bound.push(own);
            match node.pass.slots.get(index) {
                Some(slot) if slot.access.writes() => {
                    outputs.push((own, Meaning::Elements(slot.element)));
                }
                Some(slot) => {
                    let words = match slot.name {
                        "surfaces" => surfaces.to_vec(),
                        _ => session.read(*id).unwrap(),
                    };
                    inputs.push((input_of(&mut alone, own), words));
                }
                None => {
                    if let Kind::Image { format, .. } = resource.kind {
                        outputs.push((own, Meaning::Texels(format)));
                    }
                }
            }
        }
        let size = node.size.map(|WorkSize { arguments, index }| {
            let resource = graph.resource(arguments);
            let own = alone.add(resource.name, resource.kind);
            inputs.push((own, session.read(arguments).unwrap()));
            WorkSize {
                arguments: own,
                index,
            }
        });
        let (slots, targets) = bound.split_at(node.pass.slots.len());
        if targets.is_empty() {
            alone.compute_sized(node.pass, slots, size);
        } else {
            alone.draw_sized(node.pass, (slots, targets), true, size);
        }
        let run = |engine: &dyn Engine| -> Vec<Vec<u32>> {
            let mut session = engine.prepare(alone.clone()).unwrap();
            for (id, words) in &inputs {
                session.write(*id, words).unwrap();
            }
            session.run().unwrap();
            let read = |(id, _): &(ResourceId, Meaning)| session.read(*id).unwrap();
            outputs.iter().map(read).collect()
        };
        let (expected, found) = (run(&Processor), run(device));
        for ((expected, found), (_, meaning)) in expected.iter().zip(&found).zip(&outputs) {
            let wrong = disagreement(node.pass, *meaning, expected, found);
            assert!(
                wrong.is_none(),
                "{}: {}",
                node.pass.name,
                wrong.unwrap_or_default()
            );
        }
    }
}
