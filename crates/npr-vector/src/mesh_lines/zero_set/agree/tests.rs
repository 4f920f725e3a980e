use super::*;
use crate::mesh_lines::contour::{Eye, contours, facing};
use crate::mesh_lines::zero_set::patches::LEAST_PX;
use crate::mesh_lines::zero_set::tests::shaken;
use npr_core::camera::{Camera, Projection};
use npr_core::edge_flags::EdgeFlags;
use npr_core::line_kind::KindSet;
use npr_mesh::Mesh;
use npr_mesh::testing::{cube, cylinder, icosphere, shape_of, torus};
use proptest::prelude::*;

const SIZE: [u32; 2] = [640, 480];

fn camera(eye: [f32; 3], parallel: bool) -> Projector {
    let camera = Camera {
        eye,
        target: [0.0; 3],
        up: [0.0, 1.0, 0.1],
        projection: match parallel {
            true => Projection::Parallel { height: 4.0 },
            false => Projection::Perspective { fov_y: 0.8 },
        },
    };
    Projector::new(&camera, SIZE, ([-2.0; 3], [2.0; 3]))
}

/// All convex contours, as if nothing were in front of any.
fn all_seen(
    shape: &HalfEdgeMesh,
    front: &[u8],
    eye: &Eye,
    projector: &Projector,
) -> Vec<SeenContour> {
    let graph = contours(shape, front, eye);
    let whole = [Span {
        from: 0.0,
        to: 1.0,
        occluders: 0,
    }];
    let of_node = |index: usize| {
        let node = &graph.nodes[index];
        let convex = node.flags & (KindSet::CONTOUR | EdgeFlags::CONCAVE.0) == KindSet::CONTOUR;
        let piece = piece_of(shape, &graph, index, projector).filter(|_| convex)?;
        SeenContour::of_piece(projector, node, &piece, &whole).next()
    };
    (0..graph.nodes.len()).filter_map(of_node).collect()
}

fn piece_of(
    shape: &HalfEdgeMesh,
    graph: &CurveGraph,
    index: usize,
    projector: &Projector,
) -> Option<Piece> {
    let next = graph.nodes[index].next;
    let [a, b] = [index as u32, if next == NONE { index as u32 } else { next }];
    let [a, b] = [a, b].map(|n| DVec3::from(graph.position(shape, n)));
    Piece::new(projector, SIZE, a, b)
}

fn any_mesh() -> impl Strategy<Value = Mesh> {
    (0u32..4, 0u32..3, 0.0f32..0.25, any::<u64>()).prop_map(|(kind, size, noise, seed)| {
        let mesh = match kind {
            0 => icosphere(size),
            1 => torus(6 + 5 * size, 5 + 3 * size, 1.0, 0.4),
            2 => cylinder(5 + 6 * size, 1 + size),
            _ => cube(),
        };
        shaken(&mesh, noise, seed)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn no_visible_contour_is_missed(
        mesh in any_mesh(), [x, y, z] in proptest::array::uniform3(-3.0f32..3.0),
        parallel: bool, crease in -1.0f32..1.0, tolerance in 1.0f64..3.0,
    ) {
        prop_assume!(x * x + y * y + z * z > 4.0);
        let (shape, projector) = (shape_of(&mesh), camera([x, y, z], parallel));
        let eye = Eye::new(projector.eye(), 4.0);
        let front = facing(&shape, &eye);
        let seen = all_seen(&shape, &front, &eye, &projector);
        let normals = CornerNormals::new(&shape, crease);
        let outline = PolygonOutline::new((&shape, &normals), (&projector, SIZE), &front, &seen, tolerance);
        let flat = outline.flat_faces();
        let graph = zero_set(&shape, &normals, projector.eye(), &flat);
        let drawn: Vec<Piece> = (0..graph.nodes.len())
            .filter(|i| !EdgeFlags::CONCAVE.is_in(graph.nodes[*i].flags) && graph.nodes[*i].next != NONE)
            .filter_map(|i| piece_of(&shape, &graph, i, &projector)).collect();
        let (mut missed, mut all) = (0.0, 0.0);
        for contour in &seen {
            let count = sample_count(contour.length());
            for i in 0..count {
                let share = (i as f64 + 0.5) / count as f64;
                let p = [0, 1].map(|k| contour.places[0][k] + (contour.places[1][k] - contour.places[0][k]) * share);
                let near = drawn.iter().any(|piece| slow_distance(piece.place, p) <= tolerance + 1e-6);
                all += contour.length() / count as f64;
                missed += if near { 0.0 } else { contour.length() / count as f64 };
            }
        }
        // Patches too short to be worth it may be left, each under LEAST_PX.
        prop_assert!(missed <= 0.03 * all + 3.0 * LEAST_PX, "{missed} of {all} pixels");
    }
}

fn slow_distance([a, b]: [[f64; 2]; 2], p: [f64; 2]) -> f64 {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy).max(1e-300);
    let t = t.clamp(0.0, 1.0);
    ((p[0] - a[0] - dx * t).powi(2) + (p[1] - a[1] - dy * t).powi(2)).sqrt()
}

#[test]
fn a_fine_ball_stays_smooth_and_a_coarse_one_turns_into_its_outline() {
    let projector = camera([0.3, 0.5, 4.0], false);
    let eye = Eye::new(projector.eye(), 4.0);
    let lines = |level: u32| {
        let shape = shape_of(&icosphere(level));
        let front = facing(&shape, &eye);
        let seen = all_seen(&shape, &front, &eye, &projector);
        let normals = CornerNormals::new(&shape, -1.0);
        let outline =
            PolygonOutline::new((&shape, &normals), (&projector, SIZE), &front, &seen, 1.5);
        let flat = outline.flat_faces();
        let graph = zero_set(&shape, &normals, projector.eye(), &flat);
        let pieces: Vec<_> = (0..graph.nodes.len())
            .map(|i| piece_of(&shape, &graph, i, &projector))
            .collect();
        let spans = outline.spans(&graph, &pieces);
        assert!(
            spans.iter().flatten().all(|span| span.occluders == 0),
            "a ball hides none of its outline"
        );
        flat.faces().len()
    };
    assert_eq!(lines(5), 0);
    assert!(lines(0) > 5);
}

#[test]
fn hidden_contours_hide_the_smooth_line_beside_them() {
    let projector = camera([0.3, 0.5, 4.0], false);
    let shape = shape_of(&icosphere(4));
    let eye = Eye::new(projector.eye(), 4.0);
    let front = facing(&shape, &eye);
    let mut seen = all_seen(&shape, &front, &eye, &projector);
    for contour in &mut seen {
        contour.occluders = if contour.places[0][0] < 320.0 { 2 } else { 0 };
    }
    let normals = CornerNormals::new(&shape, -1.0);
    let outline = PolygonOutline::new((&shape, &normals), (&projector, SIZE), &front, &seen, 2.0);
    let graph = zero_set(&shape, &normals, projector.eye(), &outline.flat_faces());
    let pieces: Vec<_> = (0..graph.nodes.len())
        .map(|i| piece_of(&shape, &graph, i, &projector))
        .collect();
    for (piece, spans) in pieces.iter().zip(outline.spans(&graph, &pieces)) {
        let piece = piece.as_ref().unwrap();
        for span in spans {
            let x = piece.place_at(0.5 * (span.from + span.to))[0];
            let expected = if x < 320.0 { 2 } else { 0 };
            assert!(
                (x - 320.0).abs() < 25.0 || span.occluders == expected,
                "{} at {x}",
                span.occluders
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn settled_runs_are_long_or_at_an_end(
        mut hidden in proptest::collection::vec(any::<bool>(), 0..60), least in 0.0f64..6.0,
    ) {
        let ends = [hidden.first().copied(), hidden.last().copied()];
        let lengths = vec![1.0; hidden.len()];
        settle_runs(&mut hidden, &lengths, least);
        prop_assert_eq!(ends, [hidden.first().copied(), hidden.last().copied()]);
        let runs: Vec<&[bool]> = hidden.chunk_by(|a, b| a == b).collect();
        for run in runs.iter().take(runs.len().saturating_sub(1)).skip(1) {
            // A gap may outlive a speck beside it, but no speck is left.
            prop_assert!(run[0] || run.len() as f64 >= least);
        }
    }

    /// What sights decided stays; the rest is settled as if they had decided nothing.
    #[test]
    fn settling_leaves_what_is_known(
        pieces in prop::collection::vec((any::<bool>(), 0.2_f64..1.5, prop::collection::vec(0_u32..3, 0..6)), 0..20),
    ) {
        let piece = |(is_known, step_px, occluders): &(bool, f64, Vec<u32>)| Sampled {
            step_px: *step_px,
            is_known: *is_known,
            occluders: occluders.clone(),
        };
        let before: Vec<Sampled> = pieces.iter().map(piece).collect();
        let chain: Vec<u32> = (0..before.len() as u32).collect();
        let mut after = before.clone();
        settle_chain(&chain, &mut after);
        let mut hidden: Vec<bool> = before.iter().flat_map(|p| &p.occluders).map(|count| *count > 0).collect();
        let lengths: Vec<f64> = before.iter().flat_map(|p| vec![p.step_px; p.occluders.len()]).collect();
        settle_runs(&mut hidden, &lengths, SETTLE_PX);
        let mut hidden = hidden.into_iter();
        for (before, after) in before.iter().zip(&after) {
            for (count, found) in before.occluders.iter().zip(&after.occluders) {
                let is_hidden = hidden.next() == Some(true);
                if before.is_known {
                    prop_assert_eq!(count, found);
                } else {
                    prop_assert_eq!(*found, if is_hidden { (*count).max(1) } else { 0 });
                }
            }
        }
    }
}
