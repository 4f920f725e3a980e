//! Faces by the thousand that cut, cover or touch each other: what is found of their lines is bounded, and in memory.

use npr_core::camera::{Camera, Projection};
use npr_core::interrupt::{Interrupt, Interrupted};
use npr_core::line_kind::KindSet;
use npr_mesh::Mesh;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::{coplanar_soup, crossing_soup, fan, needles, shape_of};
use npr_vector::mesh_lines::contour::EdgeContours;
use npr_vector::mesh_lines::draw::{
    FindError, LineSettings, LineSource, Prepared, StrokeLook, ViewStrokes, eye_of, runs_with,
};
use npr_vector::project::Projector;
use proptest::prelude::*;
use std::thread;
use std::time::Duration;

const SIZE: [u32; 2] = [400, 300];

/// Bytes that are enough for every crowd of these tests, and less than a thousandth of what all their crossings
/// would take.
const ENOUGH: u64 = 64 << 20;

fn drawn(shape: &HalfEdgeMesh, hidden: bool, memory_limit: u64) -> Result<ViewStrokes, FindError> {
    drawn_until(shape, (hidden, memory_limit), &Interrupt::NEVER)
}

fn drawn_until(
    shape: &HalfEdgeMesh,
    (hidden, memory_limit): (bool, u64),
    interrupt: &Interrupt,
) -> Result<ViewStrokes, FindError> {
    let settings = LineSettings {
        size: SIZE,
        kinds: KindSet::BITS & !KindSet::INTERSECTION,
        method: LineSource::Edges,
        smooth: false,
        hidden,
        split: None,
        memory_limit,
    };
    let camera = Camera {
        eye: [2.0, 3.0, 4.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.7 },
    };
    let prepared = Prepared::new(shape, 0.77, false);
    let projector = Projector::new(&camera, SIZE, ([-1.0; 3], [1.0; 3]));
    let contours = EdgeContours::new(shape, &eye_of(shape, &projector));
    let look = StrokeLook {
        width_at: &|_| 2.0,
        paint_at: None,
        is_lit: false,
        follows_bends: false,
    };
    let found = runs_with(
        shape,
        &prepared,
        &projector,
        &settings,
        &contours,
        (None, None),
        interrupt,
    )?;
    Ok(found.strokes(shape, &projector, &look))
}

fn crowds() -> [(&'static str, Mesh); 4] {
    [
        ("needles", needles(3000)),
        ("crossing", crossing_soup(3000, 1)),
        ("coplanar", coplanar_soup(3000, 1)),
        ("fan", fan(3000)),
    ]
}

/// No crowd needs more memory than a few thousand lines do, and none is drawn blacker than black: 3 pixels of line a
/// square pixel, and one round.
#[test]
fn crowds_are_drawn_in_bounds() {
    for (name, mesh) in crowds() {
        let shape = shape_of(&mesh);
        for hidden in [false, true] {
            let found = drawn(&shape, hidden, ENOUGH).expect(name);
            assert!(!found.strokes.is_empty(), "{name}");
            let length: f64 = found.strokes.iter().map(|stroke| stroke.length()).sum();
            let paper = f64::from(SIZE[0]) * f64::from(SIZE[1]) * 1.04 * 1.04;
            // A round is 256 lines, none longer than the picture's diagonal.
            assert!(length < 3.0 * paper + 256.0 * 520.0, "{name}: {length}");
            let points: usize = found.strokes.iter().map(|stroke| stroke.points.len()).sum();
            assert!(
                (points as f64) < length + 4.0 * found.strokes.len() as f64,
                "{name}: {points}"
            );
        }
    }
}

/// Lines over black paper are left out and counted; of lines that hide each other none is.
#[test]
fn only_black_paper_takes_no_more_lines() {
    let left_out = |mesh: &Mesh| {
        let found = drawn(&shape_of(mesh), false, u64::MAX);
        found.expect("no limit is set").left_out
    };
    assert!(left_out(&coplanar_soup(3000, 1)) > 0);
    assert_eq!(left_out(&crossing_soup(3000, 1)), 0);
}

#[test]
fn a_crowd_beyond_the_memory_limit_is_refused() {
    let shape = shape_of(&crossing_soup(3000, 1));
    let error = drawn(&shape, false, 100_000).expect_err("too little");
    let FindError::Memory(error) = error else {
        panic!("{error}");
    };
    assert!(error.needed_bytes > error.left_bytes);
}

#[test]
fn crowds_are_the_same_for_any_number_of_threads() {
    let shape = shape_of(&coplanar_soup(1500, 7));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().expect("threads");
        pool.install(|| drawn(&shape, true, u64::MAX))
    };
    assert_eq!(with(1), with(3));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, ..ProptestConfig::default() })]

    /// Whenever the flag is raised, all lines are found or none.
    #[test]
    fn a_crowd_is_found_as_a_whole_or_not_at_all(crowd in 0_usize..4, wait_us in 0_u64..60_000) {
        let (name, mesh) = &crowds()[crowd];
        let (shape, interrupt) = (shape_of(mesh), Interrupt::new());
        let found = thread::scope(|scope| {
            scope.spawn(|| {
                thread::sleep(Duration::from_micros(wait_us));
                interrupt.raise();
            });
            drawn_until(&shape, (false, ENOUGH), &interrupt)
        });
        match found {
            Ok(found) => prop_assert_eq!(found, drawn(&shape, false, ENOUGH).expect(name)),
            Err(error) => prop_assert_eq!(error, FindError::Interrupted(Interrupted)),
        }
        let never = drawn_until(&shape, (false, ENOUGH), &interrupt);
        prop_assert_eq!(never, Err(FindError::Interrupted(Interrupted)));
    }
}
