use super::*;
use crate::mesh_lines::bridge::bridge_gaps;
use crate::mesh_lines::merge::{FACING_PX, merge_ends, merge_held};
use crate::mesh_lines::run::testing::{run_along, straight};
use crate::surface_location::SurfaceLocation;
use npr_core::camera::{Camera, Projection};
use npr_mesh::testing::Random;
use proptest::prelude::*;

/// The view of a camera before places of the picture 640 pixels wide, a pixel for a unit of the world.
fn view(right: f32, is_behind: bool) -> Projector {
    let camera = Camera {
        eye: [-right, 0.0, if is_behind { -100.0 } else { 100.0 }],
        target: [-right, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: 480.0 },
    };
    Projector::new(&camera, [640, 480], ([-2e3; 3], [4e3; 3]))
}

/// The same runs, on no shape, where the view that stands at 0 shows them.
fn in_the_open(mut runs: Vec<Run>) -> Vec<Run> {
    for point in runs.iter_mut().flat_map(|run| &mut run.points) {
        point.location = SurfaceLocation::NOWHERE;
        point.world = DVec3::new(point.place[0] - 320.0, 240.0 - point.place[1], 0.0);
    }
    runs
}

/// Nothing is known but ends.
fn nothing(_: &[Tip; 2]) -> DrawnBetween {
    DrawnBetween::Nothing
}

/// The runs of a frame joined where they face each other.
fn faced(held: &mut HeldJoints, runs: Vec<Run>, projector: &Projector) -> Vec<Run> {
    let shape = HalfEdgeMesh::default();
    let mut joints = held.in_view(&shape, projector, &nothing);
    let step = Some((JoiningStep::Facing, &mut joints));
    merge_held(in_the_open(runs), FACING_PX, step)
}

/// What may part two lines, of stills and of films.
#[derive(Debug, Clone, Copy)]
enum Between {
    /// A gap in pixels.
    Gap,
    /// A turn at a corner.
    Turn,
    /// A difference in depth, as a share.
    Depth,
}

impl Between {
    /// Two lines with so much between them; the greatest number keeps them apart by far.
    fn runs(self, much: f64) -> Vec<Run> {
        let first = run_along(1, &[[100.0, 100.0], [150.0, 100.0], [200.0, 100.0]]);
        let mut second = match self {
            Self::Gap => straight(2, [200.0 + 20.0 * much, 100.0], 0.0, 80.0),
            Self::Turn => straight(2, [201.0, 100.0], 2.6 * much, 80.0),
            Self::Depth => straight(2, [201.0, 100.0], 0.0, 80.0),
        };
        if let Self::Depth = self {
            second
                .points
                .iter_mut()
                .for_each(|p| p.depth = 1.0 + 0.1 * much);
        }
        vec![first, second]
    }

    /// Up to how much is joined of what was apart, of what is new, and of what was joined.
    fn limits(self) -> [f64; 3] {
        match self {
            Self::Gap => [0.67 * 8.0, 8.0, 12.0].map(|v| v / 20.0),
            Self::Turn => [-0.35_f64, -0.5, -0.65].map(|cos| cos.acos() / 2.6),
            Self::Depth => [0.015, 0.03, 0.06].map(|v| v / 0.1),
        }
    }
}

fn between() -> impl Strategy<Value = Between> {
    prop::sample::select(vec![Between::Gap, Between::Turn, Between::Depth])
}

proptest! {
    /// Whether two lines are joined hangs on whether they were, and on a limit that has a margin both ways.
    #[test]
    fn joints_change_where_a_limit_is_passed_by_a_margin(
        between in between(), steps in prop::collection::vec(0.0..1.0_f64, 1..12),
    ) {
        let (view, mut held, limits) = (view(0.0, false), HeldJoints::default(), between.limits());
        let mut was = None;
        // Ends that move by more than they may in a frame are others.
        let mut at: f64 = 0.5;
        for step in steps {
            at += (step - at).clamp(-0.3, 0.3);
            prop_assume!(limits.iter().all(|limit| (limit - at).abs() > 1e-3));
            let limit = match was {
                Some(false) => limits[0],
                None => limits[1],
                Some(true) => limits[2],
            };
            let is_joined = faced(&mut held, between.runs(at), &view).len() == 1;
            prop_assert_eq!(is_joined, at < limit, "{:?} at {} of {:?}", between, at, limits);
            was = Some(is_joined);
        }
    }

    /// The first frame is a still, and of what stands still nothing changes, however many ends meet in one place.
    #[test]
    fn what_stands_still_is_joined_as_in_stills(
        lines in prop::collection::vec(
            (prop::array::uniform2(0.0_f64..50.0), 0_u32..12, 3.0_f64..40.0, 0_u32..3), 0..20,
        ),
    ) {
        let made = |(id, (from, turn, length, deep)): (u64, &([f64; 2], u32, f64, u32))| {
            let from = from.map(|v| 100.0 + v.round());
            let mut run = straight(id, from, std::f64::consts::FRAC_PI_6 * f64::from(*turn), *length);
            run.points.iter_mut().for_each(|p| p.depth = 1.0 + 0.01 * f64::from(*deep));
            run
        };
        let runs: Vec<Run> = (1..).zip(&lines).map(made).collect();
        let (view, shape, mut held) = (view(0.0, false), HalfEdgeMesh::default(), HeldJoints::default());
        let still = bridge_gaps(merge_ends(in_the_open(runs.clone()), FACING_PX), None);
        for _ in 0..3 {
            let faced = faced(&mut held, runs.clone(), &view);
            let bridged = bridge_gaps(faced, Some(&mut held.in_view(&shape, &view, &nothing)));
            prop_assert_eq!(&bridged, &still);
        }
    }

    /// Joints hold however lines are numbered, named and turned, and wherever the camera goes.
    #[test]
    fn joints_are_found_by_their_places(seed: u64, right in -60.0..60.0_f32, gap in 8.5..11.5_f64) {
        let mut held = HeldJoints::default();
        let lines = |gap: f64, y: f64| vec![
            straight(1, [100.0, y], 0.0, 60.0),
            straight(2, [160.0 + gap, y], 0.0, 60.0),
        ];
        let first = [lines(5.0, 100.0), lines(gap, 200.0)].concat();
        prop_assert_eq!(faced(&mut held, first, &view(0.0, false)).len(), 3);

        // Shuffle what follows.
        let mut random = Random::new(seed);
        let mut next = [lines(gap, 100.0), lines(gap, 200.0)].concat();
        random.shuffle(&mut next);
        for (id, run) in (50..).zip(&mut next) {
            run.id = id;
            if random.below(2) == 0 {
                run.reverse();
            }
        }
        let mut next = in_the_open(next);
        for point in next.iter_mut().flat_map(|run| &mut run.points) {
            point.place[0] += f64::from(right);
        }
        let (shape, view) = (HalfEdgeMesh::default(), view(right, false));
        let mut joints = held.in_view(&shape, &view, &nothing);
        let joined = merge_held(next, FACING_PX, Some((JoiningStep::Facing, &mut joints)));
        let longest = joined.iter().max_by(|a, b| a.length().total_cmp(&b.length())).expect("lines");
        prop_assert_eq!(joined.len(), 3);
        prop_assert_eq!(longest.points[0].place[1], 100.0);
    }
}

#[test]
fn a_joint_is_remembered_while_its_ends_are_gone() {
    let view = view(0.0, false);
    let beside = || straight(7, [100.0, 300.0], 0.0, 90.0);
    let wide = || {
        let parted = [Between::Gap.runs(0.5), vec![beside()]];
        parted.concat()
    };
    let joined_after = |gone: u8| {
        let mut held = HeldJoints::default();
        faced(
            &mut held,
            [Between::Gap.runs(0.2), vec![beside()]].concat(),
            &view,
        );
        for _ in 0..gone {
            let whole = straight(1, [100.0, 100.0], 0.0, 190.0);
            faced(&mut held, vec![whole, beside()], &view);
        }
        faced(&mut held, wide(), &view).len() == 2
    };
    assert!(joined_after(0) && joined_after(FRAMES_MOST));
    assert!(!joined_after(FRAMES_MOST + 1));
}

#[test]
fn after_a_cut_nothing_is_held() {
    let mut held = HeldJoints::default();
    let runs = |much| Between::Gap.runs(much);
    faced(&mut held, runs(0.2), &view(0.0, false));
    let mut turned = held.clone();
    assert_eq!(faced(&mut held, runs(0.5), &view(0.0, false)).len(), 1);
    assert_eq!(faced(&mut turned, runs(0.5), &view(0.0, true)).len(), 2);
}

#[test]
fn new_ends_are_joined_where_a_line_went_on() {
    let (shape, view) = (HalfEdgeMesh::default(), view(0.0, false));
    let beside = || vec![straight(7, [100.0, 300.0], 0.0, 90.0)];
    for (between, most) in [
        (DrawnBetween::Line, 12.0),
        (DrawnBetween::Nothing, 8.0),
        (DrawnBetween::End, 5.3),
    ] {
        let was_between = |_: &[Tip; 2]| between;
        for (gap, is_joined) in [(most - 0.2, true), (most + 0.2, false)] {
            let mut held = HeldJoints::default();
            faced(&mut held, beside(), &view);
            let runs = [Between::Gap.runs(gap / 20.0), beside()].concat();
            let mut joints = held.in_view(&shape, &view, &was_between);
            let step = Some((JoiningStep::Facing, &mut joints));
            let joined = merge_held(in_the_open(runs), FACING_PX, step);
            assert_eq!(joined.len() == 2, is_joined, "{gap} px, {between:?}");
        }
    }
}

#[test]
fn what_was_drawn_counts_as_much_as_which_ends_were_joined() {
    let (shape, view) = (HalfEdgeMesh::default(), view(0.0, false));
    let runs = |gap: f64| {
        let beside = straight(7, [100.0, 300.0], 0.0, 90.0);
        in_the_open([Between::Gap.runs(gap / 20.0), vec![beside]].concat())
    };
    let joined = |held: &mut HeldJoints, gap: f64, between: DrawnBetween, step: JoiningStep| {
        let was_between = |_: &[Tip; 2]| between;
        let mut joints = held.in_view(&shape, &view, &was_between);
        merge_held(runs(gap), FACING_PX, Some((step, &mut joints))).len() == 2
    };
    use DrawnBetween::{End, Line, Nothing};
    for (first, step, between, most) in [
        (5.0, JoiningStep::Facing, Line, 12.0),
        (5.0, JoiningStep::Facing, End, 8.0),
        (5.0, JoiningStep::Facing, Nothing, 12.0),
        (8.5, JoiningStep::Facing, End, 0.67 * 8.0),
        (8.5, JoiningStep::Facing, Line, 8.0),
        (8.5, JoiningStep::Facing, Nothing, 0.67 * 8.0),
        (5.0, JoiningStep::Touching, End, 12.0),
        (8.5, JoiningStep::Touching, Line, 0.67 * 8.0),
    ] {
        for (gap, is_joined) in [(most - 0.2, true), (most + 0.2, false)] {
            let mut held = HeldJoints::default();
            assert_eq!(joined(&mut held, first, Nothing, step), first < 8.0);
            let found = joined(&mut held, gap, between, step);
            assert_eq!(found, is_joined, "{gap} px, {step:?}, {between:?}");
        }
    }
}
