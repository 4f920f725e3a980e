use super::super::{eye_of, view::Toll};
use super::*;
use crate::mesh_lines::bvh::Sight;
use crate::mesh_lines::contour::EdgeContours;
use crate::mesh_lines::draw::Prepared;
use crate::mesh_lines::line_settings::{LineSettings, LineSource};
use crate::mesh_lines::visibility::{FaceImages, Piece};
use crate::project::Projector;
use glam::Vec3;
use npr_core::camera::{Camera, Projection, bounds_of};
use npr_core::line_kind::KindSet;
use npr_core::math;
use npr_mesh::testing::{
    crossing_soup, fan, icosphere, mapped, moebius_strip, random_soup, random_winding, shape_of,
    torus, uv_sphere,
};
use proptest::prelude::*;

const SIZE: [u32; 2] = [400, 300];

/// A shape of one of the sorts that surfaces come in: smooth, bumpy, open, of crossing faces, and broken.
fn shape(sort: usize, seed: u64) -> HalfEdgeMesh {
    let bumps = |mesh, height: f32| {
        mapped(mesh, |[x, y, z]| {
            let bump = 1.0
                + height
                    * math::sin(9.0 * x + seed as f32)
                    * math::sin(8.0 * y)
                    * math::sin(7.0 * z);
            [x * bump, y * bump, z * bump]
        })
    };
    let mesh = match sort {
        0 => torus(24, 12, 0.7, 0.3),
        1 => bumps(&icosphere(3), 0.2),
        2 => bumps(&uv_sphere(24, 16), 0.4),
        3 => mapped(&moebius_strip(30), |p| p.map(|v| 0.6 * v)),
        4 => mapped(&fan(7), |p| p.map(|v| 0.6 * v)),
        5 => random_winding(&torus(12, 8, 0.7, 0.3), seed),
        // Edges that meet within others are left to chance.
        6 => mapped(&random_soup(30, seed), |[x, y, z]| {
            let aside = 0.1 * math::sin(2.3 * x + 3.1 * y + 4.7 * z + 0.3);
            [x + aside, y - 0.7 * aside, z + 0.4 * aside]
        }),
        _ => crossing_soup(20, seed),
    };
    shape_of(&mesh)
}

fn settings(hidden: bool) -> LineSettings {
    LineSettings {
        size: SIZE,
        kinds: KindSet::BITS,
        method: LineSource::Edges,
        smooth: false,
        hidden,
        split: None,
        memory_limit: u64::MAX,
    }
}

/// How many surfaces sights find in front of a part of a piece; none where there are others a little aside, or a little
/// nearer or farther.
fn plainly_in_front(
    (view, seen): (&View<'_>, &Seen<'_>),
    (node, other): (&CurveNode, &CurveNode),
    piece: &Piece,
    [from, to]: [f64; 2],
) -> Option<u32> {
    let own = view.surroundings(node, other).own_faces;
    let count = |share: f64, reach: f64| {
        let point = piece.world_at(seen.projector, from + (to - from) * share);
        let eye = seen.projector.sight_start(point);
        let sight = Sight {
            eye: eye.to_array(),
            point: (eye + (point - eye) * reach).to_array(),
            touch: 0.0,
        };
        seen.tree
            .occluders(seen.shape, &sight, &own, seen.count_limit)
    };
    let counts =
        [0.3, 0.5, 0.7].map(|share| [1.0 - 1e-5, 1.0, 1.0 + 1e-5].map(|reach| count(share, reach)));
    let first = counts[0][0];
    counts
        .as_flattened()
        .iter()
        .all(|count| *count == first)
        .then_some(first)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// What is counted along lines is what a sight to each part of them finds.
    #[test]
    fn counts_are_what_sights_find(
        sort in 0_usize..8, seed in 0_u64..1000, eye in prop::array::uniform3(-4.0_f32..4.0), is_parallel: bool,
        hidden: bool, has_crossings: bool, crease in 0.1_f32..1.5,
    ) {
        // A view of all lines.
        // No line lies exactly behind an edge: there, a sight may find the one face or the other.
        let eye = Vec3::from(eye) + Vec3::new(0.0137, 0.0071, 0.0193);
        let (distance, eye) = (eye.length(), eye.to_array());
        prop_assume!(distance > 2.0);
        // In parallel view nothing may lie before the near plane.
        let eye = if is_parallel { eye.map(|v| v * 6.0 / distance) } else { eye };
        let shape = shape(sort, seed);
        let projection = match is_parallel {
            true => Projection::Parallel { height: 3.0 },
            false => Projection::Perspective { fov_y: 0.7 },
        };
        let camera = Camera { eye, target: [0.0; 3], up: [0.1, 1.0, 0.3], projection };
        let points = shape.positions.iter().copied().map(Vec3::from);
        let projector = Projector::new(&camera, SIZE, bounds_of(points));
        let prepared = Prepared::new(&shape, crease, has_crossings);
        let settings = settings(hidden);
        let contours = EdgeContours::new(&shape, &eye_of(&shape, &projector));
        let view = View {
            shape: &shape, prepared: &prepared, projector: &projector, settings: &settings, front: &contours.front,
            covered: Vec::new(),
        };
        let mut toll = Toll::new(&settings);
        let outlines = view.outlines(&contours.graph, &mut toll.budget).expect("no limit is set");
        let images = FaceImages::default();
        let seen = Seen {
            shape: &shape, tree: &prepared.tree, projector: &projector, outlines: &outlines, images: &images,
            size: SIZE, extra: None, count_limit: if hidden { 255 } else { 1 },
        };

        for graph in [&contours.graph, &prepared.features, &prepared.crossings.graph] {
            let lines = view.lines(graph, &seen, settings.kinds, &mut toll).expect("no limit is set");
            for (node, line) in graph.nodes.iter().zip(lines) {
                let Some(line) = line else { continue };
                let other = &graph.nodes[node.next as usize];
                for span in line.spans.iter().filter(|span| (span.to - span.from) * line.piece.length() > 0.05) {
                    let ends = [span.from, span.to];
                    if let Some(found) = plainly_in_front((&view, &seen), (node, other), &line.piece, ends) {
                        prop_assert_eq!(span.occluders, found, "at {:?} of {:?}", ends, line.piece);
                    }
                }
            }
        }
    }
}

/// A line over a closed surface takes few sights: most of its parts are known from others.
#[test]
fn changes_at_vertices_of_closed_surfaces_are_known() {
    let shape = shape(1, 0);
    let camera = Camera {
        eye: [0.3, 0.4, 4.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.7 },
    };
    let projector = Projector::new(&camera, SIZE, ([-1.5; 3], [1.5; 3]));
    let prepared = Prepared::new(&shape, 0.5, false);
    let settings = settings(false);
    let contours = EdgeContours::new(&shape, &eye_of(&shape, &projector));
    let view = View {
        shape: &shape,
        prepared: &prepared,
        projector: &projector,
        settings: &settings,
        front: &contours.front,
        covered: Vec::new(),
    };
    let nodes = &contours.graph.nodes;
    let known = nodes
        .iter()
        .filter(|node| view.change_at(&nodes[node.prev as usize], node).is_some());
    assert!(nodes.len() > 40);
    assert_eq!(known.count(), nodes.len());
}
