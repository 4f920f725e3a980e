//! Lines that go on behind something: their parts are of one line, and lie where they are on it.

use npr_core::camera::{Camera, Projection};
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_mesh::testing::{self, Random, add_to, shape_of};
use npr_vector::mesh_lines::draw::{LineSettings, LineSource, Prepared, strokes};
use npr_vector::project::Projector;
use npr_vector::stroke::Stroke;
use proptest::prelude::*;
use std::collections::BTreeMap;

const SIZE: [u32; 2] = [800, 300];

/// Corners of a beam that lies along the x axis, and of posts before it that are higher.
const BEAM: [[f32; 3]; 2] = [[-4.0, -0.2, -0.2], [4.0, 0.2, 0.2]];

fn draw(shape: &HalfEdgeMesh, camera: &Camera, method: LineSource) -> Vec<Stroke> {
    let settings = LineSettings {
        size: SIZE,
        kinds: KindSet::BITS,
        method,
        smooth: true,
        hidden: false,
        split: Some(0.9),
        memory_limit: u64::MAX,
    };
    let prepared = Prepared::new(shape, 0.77, true);
    let projector = Projector::new(camera, SIZE, ([-5.0; 3], [5.0; 3]));
    strokes(shape, &prepared, &projector, &settings, &|_| 2.0)
}

fn boxes(all: &[[[f32; 3]; 2]]) -> HalfEdgeMesh {
    let mut shape = HalfEdgeMesh {
        surfaces: (0..all.len() as u32)
            .map(|object| Surface {
                object,
                ..Surface::default()
            })
            .collect(),
        ..HalfEdgeMesh::default()
    };
    for (object, corners) in (0..).zip(all) {
        let place = |p: [f32; 3]| std::array::from_fn(|i| corners[usize::from(p[i] > 0.0)][i]);
        add_to(
            &mut shape,
            &testing::mapped(&testing::cube(), place),
            |_| object,
        );
    }
    shape
}

/// The parts of each line, in their order along it.
fn lines_of(strokes: &[Stroke]) -> Vec<Vec<&Stroke>> {
    let mut lines: BTreeMap<u64, Vec<&Stroke>> = BTreeMap::new();
    for stroke in strokes {
        if let Some(part) = stroke.part {
            lines.entry(part.line).or_default().push(stroke);
        }
    }
    let start = |stroke: &Stroke| stroke.part.map_or(0.0, |part| part.ends_px[0]);
    let sorted = lines.into_values().map(|mut parts| {
        parts.sort_by(|a, b| start(a).total_cmp(&start(b)));
        parts
    });
    sorted.collect()
}

/// The pixels from the end of each part of a line to the start of the next: along the line, by the texture coordinate,
/// and across the picture.
fn hidden_ways(line: &[&Stroke]) -> Vec<[f64; 3]> {
    let between = |pair: &[&Stroke]| {
        let (last, first) = (pair[0].points[pair[0].points.len() - 1], pair[1].points[0]);
        let [before, after] = [0, 1].map(|i| pair[i].part.expect("a part"));
        let across = [0, 1].map(|i| first.position[i] - last.position[i]);
        [
            after.ends_px[0] - before.ends_px[1],
            first.u - last.u,
            across[0].hypot(across[1]),
        ]
    };
    line.windows(2).map(between).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn edges_of_a_beam_go_on_behind_posts(seed: u64, count in 1_usize..5, x in -0.5..0.5_f32, y in 2.0..4.0_f32) {
        // Set posts before the beam, with room between them.
        let mut random = Random::new(seed);
        let room = 6.0 / count as f32;
        let posts = (0..count).map(|post| {
            let left = -3.0 + room * (post as f32 + 0.1 + 0.3 * random.unit());
            let width = room * (0.1 + 0.3 * random.unit());
            [[left, -2.0, 0.8], [left + width, 1.6, 0.8 + 0.2 * random.unit()]]
        });
        let all: Vec<[[f32; 3]; 2]> = posts.chain([BEAM]).collect();
        let camera = Camera {
            eye: [x, y, 9.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 0.4 },
        };
        let found = draw(&boxes(&all), &camera, LineSource::Edges);

        // Every post hides a piece of three straight edges, and each comes out as it went in.
        let ways: Vec<[f64; 3]> = lines_of(&found).iter().flat_map(|line| hidden_ways(line)).collect();
        prop_assert_eq!(ways.len(), 3 * count);
        for [along, u, across] in ways {
            prop_assert!((along - across).abs() < 0.01 && (u - across).abs() < 0.01, "{} {} {}", along, u, across);
        }

        // What is seen of each lies on the line, as long as it is drawn.
        for stroke in found.iter().filter(|stroke| stroke.part.is_some()) {
            let [start, end] = stroke.part.expect("a part").ends_px;
            prop_assert!((end - start - stroke.length()).abs() < 1e-6);
            prop_assert_eq!(stroke.points[0].u, start);
        }
    }

    #[test]
    fn lines_that_turn_back_where_nobody_sees_are_two(ring in 20_u32..60, eye in prop::array::uniform3(-1.0..1.0_f32)) {
        prop_assume!(eye.iter().map(|v| v * v).sum::<f32>() > 0.1);
        let length = eye.iter().map(|v| v * v).sum::<f32>().sqrt();
        let camera = Camera {
            eye: eye.map(|v| v * 8.0 / length),
            target: [0.0; 3],
            up: [0.1, 1.0, 0.2],
            projection: Projection::Perspective { fov_y: 0.4 },
        };
        let torus = testing::torus(ring, ring / 2, 1.2, 0.5);
        for method in [LineSource::Edges, LineSource::Surface] {
            for line in lines_of(&draw(&shape_of(&torus), &camera, method)) {
                for [along, _, across] in hidden_ways(&line) {
                    prop_assert!(along <= 2.0 * across + 1.0, "{} behind {}", along, across);
                }
            }
        }
    }
}

#[test]
fn without_anything_before_it_a_line_has_no_parts() {
    let camera = Camera {
        eye: [0.0, 1.0, 9.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.4 },
    };
    let found = draw(&boxes(&[BEAM]), &camera, LineSource::Edges);
    assert!(!found.is_empty() && found.iter().all(|stroke| stroke.part.is_none()));
}
