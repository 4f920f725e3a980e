use super::*;
use crate::stroke::{Kind, LinePart, StrokePoint};
use crate::surface_location::SurfaceLocation;
use npr_core::camera::{Camera, Projection};
use npr_core::geometry::NONE;
use npr_mesh::Mesh;
use npr_mesh::testing::{Random, shape_of};
use proptest::prelude::*;

const SIZE: [u32; 2] = [640, 480];

/// A sheet before the eye: a pixel of the picture is a unit of the world. It is moved to the right by some pixels.
fn sheet(right: f32) -> HalfEdgeMesh {
    let corners = [[-2e3, -2e3, 0.0], [4e3, -2e3, 0.0], [-2e3, 4e3, 0.0]];
    let moved = corners.map(|[x, y, z]: [f32; 3]| [x + right, y, z]);
    let mesh = Mesh::new(moved.to_vec(), vec![[0, 1, 2]]);
    shape_of(&mesh.expect("a triangle"))
}

/// The same sheet, wider by a factor, with its middle where it was.
fn stretched(factor: f32) -> HalfEdgeMesh {
    let corners = [[-2e3, -2e3, 0.0], [4e3, -2e3, 0.0], [-2e3, 4e3, 0.0]];
    let wide = corners.map(|[x, y, z]: [f32; 3]| [x * factor, y, z]);
    let mesh = Mesh::new(wide.to_vec(), vec![[0, 1, 2]]);
    shape_of(&mesh.expect("a triangle"))
}

/// The view of a camera that stands to the left by some pixels, so that the sheet shows to the right.
fn view(right: f32) -> Projector {
    let at = |z: f32| [-right, 0.0, z];
    let camera = Camera {
        eye: at(100.0),
        target: at(0.0),
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel {
            height: SIZE[1] as f32,
        },
    };
    Projector::new(&camera, SIZE, ([-2e3, -2e3, 0.0], [4e3, 4e3, 0.0]))
}

/// A stroke through places of the picture, which shows the sheet moved to the right by some pixels.
fn stroke(id: u64, places: &[[f64; 2]], closed: bool, right: f32) -> Stroke {
    let point = |place: &[f64; 2]| StrokePoint {
        position: [place[0] + f64::from(right), place[1]],
        depth: 100.0,
        width: 2.0,
        world: [(place[0] - 320.0) as f32, (240.0 - place[1]) as f32, 0.0],
        location: SurfaceLocation {
            edge: NONE,
            face: 0,
        },
        ..StrokePoint::default()
    };
    let mut points: Vec<StrokePoint> = places.iter().map(point).collect();
    measure(&mut points);
    Stroke {
        id,
        kind: Kind::Contour,
        occluders: 0,
        surface: 0,
        closed,
        part: None,
        points,
    }
}

/// Holds strokes whose ends may grow.
fn hold_growing(
    state: &mut HeldStrokes,
    strokes: &mut Vec<Stroke>,
    shape: &HalfEdgeMesh,
    view: &Projector,
) {
    let before = state.in_view(shape, view);
    state.hold_to(before, strokes, (shape, view), Ends::Grow);
}

fn line(id: u64, from: f64, to: f64, y: f64) -> Stroke {
    stroke(id, &[[from, y], [to, y]], false, 0.0)
}

fn ring(first: u32) -> Stroke {
    let place = |i: u32| {
        let turn = f64::from((i + first) % 60) * std::f64::consts::TAU / 60.0;
        let [sin, cos] = [npr_core::math::sin_f64(turn), npr_core::math::cos_f64(turn)];
        [320.0 + 80.0 * cos, 240.0 + 80.0 * sin]
    };
    stroke(7, &(0..60).map(place).collect::<Vec<_>>(), true, 0.0)
}

/// The strokes of frames that show the sheet where it stands, each held to the one before.
fn held(frames: impl IntoIterator<Item = Vec<Stroke>>) -> Vec<Vec<Stroke>> {
    let (shape, view) = (sheet(0.0), view(0.0));
    let mut state = HeldStrokes::default();
    let hold = |mut strokes: Vec<Stroke>| {
        state.hold(&mut strokes, &shape, &view);
        strokes
    };
    frames.into_iter().map(hold).collect()
}

/// The texture coordinate of a stroke at the place with this x, of one along a row.
fn u_at(stroke: &Stroke, x: f64) -> f64 {
    let is_around = |pair: &&[StrokePoint]| {
        let [a, b] = [pair[0].position[0], pair[1].position[0]];
        a.min(b) <= x && x <= a.max(b)
    };
    let pair = stroke
        .points
        .windows(2)
        .find(is_around)
        .expect("on the stroke");
    let share = (x - pair[0].position[0]) / (pair[1].position[0] - pair[0].position[0]);
    pair[0].u + share * (pair[1].u - pair[0].u)
}

#[test]
fn a_stroke_that_got_a_new_start_keeps_its_texture_way_and_id() {
    let [_, after] = held([
        vec![line(1, 100.0, 300.0, 50.0)],
        vec![line(9, 340.0, 60.0, 50.0)],
    ])
    .try_into()
    .expect("two frames");
    assert_eq!(after.len(), 1);
    assert_eq!(after[0].id, 1);
    assert_eq!(after[0].points[0].position, [60.0, 50.0]);
    assert_eq!(
        [60.0, 100.0, 250.0].map(|x| u_at(&after[0], x)),
        [-40.0, 0.0, 150.0]
    );
}

#[test]
fn the_first_frame_and_what_is_new_stay_as_they_are() {
    let first = vec![
        line(4, 10.0, 90.0, 20.0),
        ring(0),
        line(2, 10.0, 90.0, 30.0),
    ];
    let new = line(5, 10.0, 90.0, 300.0);
    let second = [first.clone(), vec![new.clone()]].concat();
    let frames = held([first.clone(), second.clone()]);
    assert_eq!(frames, [first, second]);
}

#[test]
fn strokes_that_are_joined_keep_both_textures() {
    let apart = vec![line(1, 100.0, 200.0, 50.0), line(2, 203.0, 263.0, 50.0)];
    let frames = held([apart.clone(), vec![line(1, 100.0, 263.0, 50.0)], apart]);
    let joined = &frames[1][0];
    assert_eq!((frames[1].len(), joined.id), (1, 1));
    for (x, want) in [(100.0, 0.0), (190.0, 90.0), (215.0, 12.5), (262.0, 59.5)] {
        assert!(
            (u_at(joined, x) - want).abs() < 0.1,
            "{x}: {}",
            u_at(joined, x)
        );
    }

    // In between it changes over within 12 pixels; apart again, both have what they had, but for half a pixel by which
    // the lesser one came nearer.
    let changes = |x: &i32| {
        let [from, to] = [0, 1].map(|by| u_at(joined, f64::from(x + by)));
        (to - from - 1.0).abs() > 1e-6
    };
    let changing: Vec<i32> = (100..262).filter(changes).collect();
    assert!(
        changing.len() <= 14 && changing.iter().all(|x| (190..213).contains(x)),
        "{changing:?}"
    );
    let parted = &frames[2];
    assert_eq!(parted.len(), 2);
    assert_eq!(parted[0].id, 1);
    assert!((u_at(&parted[0], 150.0) - 50.0).abs() < 0.1);
    assert!(
        (u_at(&parted[1], 250.0) - 47.5).abs() < 0.1,
        "{}",
        u_at(&parted[1], 250.0)
    );
}

#[test]
fn an_id_goes_to_the_larger_part_alone() {
    let whole = vec![line(1, 100.0, 300.0, 50.0)];
    let parts = vec![line(1, 100.0, 140.0, 50.0), line(8, 150.0, 300.0, 50.0)];
    let frames = held([whole, parts.clone(), parts]);
    for parted in &frames[1..] {
        let ids: Vec<u64> = parted.iter().map(|stroke| stroke.id).collect();
        let at = |x: f64| {
            parted
                .iter()
                .find(|stroke| stroke.points[0].position[0] == x)
        };
        assert_eq!(at(150.0).map(|stroke| stroke.id), Some(1));
        assert!(ids.len() == 2 && ids[0] != ids[1], "{ids:?}");
    }
}

#[test]
fn a_ring_starts_where_it_started() {
    let frames = held([vec![ring(0)], vec![ring(20)], vec![ring(45)]]);
    for frame in &frames[1..] {
        assert_eq!(frame, &frames[0]);
    }
}

#[test]
fn what_is_gone_for_a_moment_comes_back_as_it_was() {
    let beside = || line(3, 100.0, 300.0, 90.0);
    let gone = |count| {
        let mut frames = vec![vec![beside(), line(1, 100.0, 300.0, 50.0)]];
        frames.extend(vec![vec![beside()]; count]);
        frames.push(vec![beside(), line(6, 320.0, 80.0, 50.0)]);
        held(frames).pop().expect("a frame")
    };
    let back = gone(usize::from(FRAMES_MOST));
    assert_eq!((back[1].id, back[1].points[0].u), (1, -20.0));
    let new = gone(usize::from(FRAMES_MOST) + 1);
    assert_eq!((new[1].id, new[1].points[0].u), (6, 0.0));
}

#[test]
fn lines_of_other_kinds_at_one_place_keep_their_own() {
    let crease = |id, from, to| Stroke {
        kind: Kind::Crease,
        ..line(id, from, to, 50.5)
    };
    let [_, after] = held([
        vec![line(1, 100.0, 300.0, 50.0), crease(2, 60.0, 300.0)],
        vec![crease(3, 80.0, 300.0), line(4, 110.0, 300.0, 50.0)],
    ])
    .try_into()
    .expect("two frames");
    let of = |kind| after.iter().find(|stroke| stroke.kind == kind);
    let of = |kind| of(kind).map(|stroke| (stroke.id, stroke.points[0].u));
    assert_eq!(of(Kind::Contour), Some((1, 10.0)));
    assert_eq!(of(Kind::Crease), Some((2, 20.0)));
}

/// Two tips of level lines that face each other, at so many pixels from the left border.
fn facing([from, to]: [f64; 2]) -> [Tip; 2] {
    [(from, 1.0), (to, -1.0)].map(|(x, out)| Tip {
        place: [x, 100.0],
        back_place: [x - 6.0 * out, 100.0],
        out: [out, 0.0],
        kind: Kind::Contour,
        is_hidden: false,
    })
}

#[test]
fn lines_that_met_at_their_ends_were_two() {
    let (shape, view, mut state) = (sheet(0.0), view(0.0), HeldStrokes::default());
    let mut strokes = vec![line(1, 100.0, 200.0, 100.0), line(2, 200.5, 300.0, 100.0)];
    state.hold(&mut strokes, &shape, &view);
    let known = state.in_view(&shape, &view);
    assert_eq!(known.between(&facing([200.0, 200.5])), DrawnBetween::End);
    assert_eq!(known.between(&facing([201.0, 199.0])), DrawnBetween::End);
    assert_eq!(known.between(&facing([150.0, 150.5])), DrawnBetween::Line);
}

proptest! {
    /// What was between two tips is read off the parts of a level line that were drawn.
    #[test]
    fn between_tips_a_line_went_on_or_ended(
        lengths in prop::collection::vec((20.0..90.0_f64, 0.5..30.0_f64), 1..5), at in 60.0..400.0_f64,
        gap in 0.0..12.0_f64,
    ) {
        // Draw the parts.
        let mut parts: Vec<[f64; 2]> = Vec::new();
        for (length, before) in lengths {
            let from = parts.last().map_or(50.0, |part| part[1]) + before;
            parts.push([from, from + length]);
        }
        let mut strokes: Vec<Stroke> = (1..).zip(&parts).map(|(id, [from, to])| line(id, *from, *to, 100.0)).collect();
        let (shape, view, mut state) = (sheet(0.0), view(0.0), HeldStrokes::default());
        state.hold(&mut strokes, &shape, &view);

        // Look at which of them lie under the tips, and end near the gap; where that is plain.
        let [back_a, back_b] = [at - 6.0, at + gap + 6.0];
        let under = |x: f64| parts.iter().filter(move |[from, to]| *from < x && x < *to);
        let is_plain = parts.iter().flatten().all(|end| (end - back_a).abs() > 5.1 && (end - back_b).abs() > 5.1);
        let left = under(back_a).map(|[_, to]| to - back_a).chain(under(back_b).map(|[from, _]| back_b - from));
        let left: Vec<f64> = left.map(|left| left - (6.0 + gap + 4.0)).collect();
        prop_assume!(is_plain && left.iter().all(|left| left.abs() > 4.0));
        let oracle = match () {
            () if under(back_a).any(|[_, to]| *to > back_b) => DrawnBetween::Line,
            () if left.iter().any(|left| *left < 0.0) => DrawnBetween::End,
            () => DrawnBetween::Nothing,
        };
        prop_assert_eq!(state.in_view(&shape, &view).between(&facing([at, at + gap])), oracle);
    }

    /// Ends never leap, unless by far: they go where they should by steps, and shrink at once.
    #[test]
    fn ends_grow_by_steps(
        targets in prop::collection::vec((0.0..20.0_f64, 1_usize..8), 1..6), at_start: bool, turned: bool,
    ) {
        let (shape, view, mut state) = (sheet(0.0), view(0.0), HeldStrokes::default());
        let mut drawn: Option<f64> = None;
        for (target, frames) in targets {
            for _ in 0..frames {
                let [from, to] = if at_start { [200.0 - target, 300.0] } else { [100.0, 200.0 + target] };
                let mut ends = [from, to];
                if turned {
                    ends.reverse();
                }
                let mut strokes = vec![line(1, ends[0], ends[1], 50.0)];
                hold_growing(&mut state, &mut strokes, &shape, &view);
                prop_assert_eq!(strokes.len(), 1);
                let places = || strokes[0].points.iter().map(|point| point.position[0]);
                let [least, most] = [places().fold(f64::MAX, f64::min), places().fold(0.0, f64::max)];
                let [moving, still] = match at_start {
                    true => [200.0 - least, most - 300.0],
                    false => [most - 200.0, least - 100.0],
                };
                let was = drawn.unwrap_or(target);
                prop_assert!(still.abs() < 1e-9);
                prop_assert!(moving <= target + 1e-9 && moving - was <= 8.0 + 1e-9, "{was} to {moving} of {target}");
                prop_assert!(moving >= target.min(was + 3.0) - 1e-9, "{was} to {moving} of {target}");
                drawn = Some(moving);
            }
        }
    }
}

#[test]
fn what_grows_by_far_comes_at_once_and_what_is_new_too() {
    let (shape, view, mut state) = (sheet(0.0), view(0.0), HeldStrokes::default());
    let mut drawn = |strokes: Vec<Stroke>| -> Vec<f64> {
        let mut strokes = strokes;
        hold_growing(&mut state, &mut strokes, &shape, &view);
        strokes.iter().map(Stroke::length).collect()
    };
    drawn(vec![line(1, 100.0, 200.0, 50.0)]);
    assert_eq!(drawn(vec![line(1, 100.0, 240.0, 50.0)]), [140.0]);
    let new = vec![line(1, 100.0, 240.0, 50.0), line(2, 100.0, 120.0, 90.0)];
    assert_eq!(drawn(new), [140.0, 20.0]);
}

#[test]
fn an_end_that_meets_another_line_comes_at_once() {
    let length = |x: f64| {
        let (shape, view, mut state) = (sheet(0.0), view(0.0), HeldStrokes::default());
        let across = || stroke(2, &[[x, 20.0], [x, 90.0]], false, 0.0);
        hold_growing(
            &mut state,
            &mut vec![line(1, 100.0, 200.0, 50.0), across()],
            &shape,
            &view,
        );
        let mut strokes = vec![line(1, 100.0, 215.0, 50.0), across()];
        hold_growing(&mut state, &mut strokes, &shape, &view);
        strokes[0].length()
    };
    assert_eq!(length(216.0), 115.0);
    assert!(length(230.0) <= 108.0);
}

#[test]
fn between_two_ends_a_line_went_on_or_ended() {
    let (shape, mut state) = (sheet(0.0), HeldStrokes::default());
    let mut strokes = vec![line(1, 100.0, 300.0, 50.0), ring(0)];
    state.hold(&mut strokes, &shape, &view(0.0));
    let known = state.in_view(&shape, &view(30.0));
    let tip = |x: f64, y: f64, out: [f64; 2]| Tip {
        place: [x + 30.0, y],
        back_place: [x + 30.0 - 6.0 * out[0], y - 6.0 * out[1]],
        out,
        kind: Kind::Contour,
        is_hidden: false,
    };
    let between = |[from, to]: [f64; 2], y| {
        known.between(&[tip(from, y, [1.0, 0.0]), tip(to, y, [-1.0, 0.0])])
    };
    assert_eq!(between([180.0, 190.0], 51.0), DrawnBetween::Line);
    assert_eq!(between([297.0, 304.0], 51.0), DrawnBetween::End);
    assert_eq!(between([180.0, 190.0], 60.0), DrawnBetween::Nothing);

    // Around a ring, past its start; not for ends that point across it, or of another kind.
    let over = |out: f64, kind| {
        let ends = [(230.0, out), (250.0, -out)].map(|(y, out)| Tip {
            kind,
            ..tip(399.4, y, [1.0 - out.abs(), out])
        });
        known.between(&ends)
    };
    assert_eq!(over(1.0, Kind::Contour), DrawnBetween::Line);
    assert_eq!(over(0.0, Kind::Contour), DrawnBetween::Nothing);
    assert_eq!(over(1.0, Kind::Crease), DrawnBetween::Nothing);
}

#[test]
fn after_a_cut_nothing_is_taken_over() {
    let (shape, mut state) = (sheet(0.0), HeldStrokes::default());
    let mut first = vec![line(1, 100.0, 300.0, 50.0)];
    state.hold(&mut first, &shape, &view(0.0));

    // Elsewhere in the picture.
    let all = || {
        vec![
            line(5, 300.0, 90.0, 50.0),
            stroke(6, &[[0.0, 200.0], [600.0, 400.0], [0.0, 470.0]], false, 0.0),
        ]
    };
    let mut next = all();
    state.clone().hold(&mut next, &shape, &view(0.0));
    assert_eq!(next, all());

    // The other way round.
    let from_behind = Camera {
        eye: [0.0, 0.0, -100.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel {
            height: SIZE[1] as f32,
        },
    };
    let behind = Projector::new(&from_behind, SIZE, ([-2e3; 3], [4e3; 3]));
    let mirrored = |x: f64| 640.0 - x;
    let mut next = vec![line(5, mirrored(300.0), mirrored(90.0), 50.0)];
    state.hold(&mut next, &shape, &behind);
    assert_eq!((next[0].id, next[0].points[0].u), (5, 0.0));
}

/// Strokes far enough apart that none can be taken for another, each through some places of its row.
fn rows() -> impl Strategy<Value = Vec<Stroke>> {
    let row = prop::collection::vec([10.0..40.0_f64, -6.0..6.0], 3..12);
    prop::collection::vec((row, any::<bool>()), 1..12).prop_map(|rows| {
        let strokes = rows.into_iter().zip(0..).map(|((steps, closed), number)| {
            let mut x = 40.0;
            let mut places: Vec<[f64; 2]> = steps
                .iter()
                .map(|[step, aside]| {
                    x += step;
                    [x, 30.0 + 36.0 * f64::from(number) + aside]
                })
                .collect();
            if closed {
                places.push([x - 5.0, 30.0 + 36.0 * f64::from(number) + 14.0]);
            }
            stroke(u64::from(number as u32) + 1, &places, closed, 0.0)
        });
        strokes.collect()
    })
}

proptest! {
    /// Strokes that are the same but for their order, way, start and ids become those that they were, and move with
    /// the surface and with the camera.
    #[test]
    fn strokes_become_those_that_they_were(
        before in rows(), seed: u64, right in -40.0..40.0_f32, by_camera: bool,
    ) {
        let (shape, mut state) = (sheet(0.0), HeldStrokes::default());
        let mut first = before.clone();
        state.hold(&mut first, &shape, &view(0.0));
        prop_assert_eq!(&first, &before);

        // Shuffle them, and move the sheet.
        let mut random = Random::new(seed);
        let mut next = before.clone();
        random.shuffle(&mut next);
        for stroke in &mut next {
            stroke.id += 1000 + random.below(1 << 20) as u64 * 16;
            for point in &mut stroke.points {
                point.position[0] += f64::from(right);
                point.world[0] += if by_camera { 0.0 } else { right };
            }
            if random.below(2) == 0 {
                reverse(stroke);
            }
            if stroke.closed {
                let start = random.below(stroke.points.len());
                stroke.points.rotate_left(start);
                measure(&mut stroke.points);
            }
        }
        match by_camera {
            true => state.hold(&mut next, &shape, &view(right)),
            false => state.hold(&mut next, &sheet(right), &view(0.0)),
        }
        prop_assert_eq!(next.len(), before.len());
        for (after, before) in next.iter().zip(&before) {
            prop_assert_eq!((after.id, after.closed), (before.id, before.closed));
            prop_assert_eq!(after.points.len(), before.points.len());
            for (a, b) in after.points.iter().zip(&before.points) {
                prop_assert!((a.position[0] - b.position[0] - f64::from(right)).abs() < 1e-3);
                prop_assert!((a.u - b.u).abs() < 0.05, "{} {}", a.u, b.u);
            }
        }
    }

    /// Where a line is joined to one that ran against it, the lesser one keeps the texture that it had, whichever way
    /// that runs, for as long as both are one.
    #[test]
    fn a_texture_that_runs_against_its_stroke_stays(
        long in 80.0..250.0_f64, share in 0.3..0.9_f64, gap in 1.0..5.0_f64, frames in 2..6_usize, pan in -2.0..2.0_f32,
    ) {
        let (from, to) = (100.0 + long + gap, 100.0 + long + gap + share * long);
        let shape = sheet(0.0);
        let mut state = HeldStrokes::default();
        for frame in 0..=frames {
            // Both face each other, then they are one; the camera moves to the side.
            let right = pan * frame as f32;
            let shown = |id, from, to| stroke(id, &[[from, 50.0], [to, 50.0]], false, right);
            let mut strokes = match frame {
                0 => vec![shown(1, 100.0, 100.0 + long), shown(2, to, from)],
                _ => vec![shown(1, 100.0, to)],
            };
            state.hold(&mut strokes, &shape, &view(right));
            for x in [from + 9.0, (from + to) / 2.0, to - 3.0] {
                let u = u_at(strokes.last().expect("a stroke"), x + f64::from(right));
                prop_assert!((u - (to - x)).abs() < 0.3, "frame {frame} at {x}: {u} for {}", to - x);
            }
            let u = u_at(&strokes[0], 100.0 + long / 2.0 + f64::from(right));
            prop_assert!((u - long / 2.0).abs() < 0.3, "frame {frame}: {u}");
        }
    }

    /// Where the surface stretches or shrinks within a frame, no texture jumps: at most by 8 pixels, as far as lies
    /// between the ends of a part and its middle.
    #[test]
    fn textures_stay_on_surfaces_that_stretch(
        from in -200.0..0.0_f64, long in 60.0..300.0_f64, factor in 0.7..2.0_f64,
    ) {
        let shown = |factor: f64| {
            let ends = [from, from + long].map(|x| [320.0 + x * factor, 50.0]);
            stroke(1, &ends, false, 0.0)
        };
        let mut state = HeldStrokes::default();
        state.hold(&mut vec![shown(1.0)], &sheet(0.0), &view(0.0));
        let mut strokes = vec![shown(factor)];
        state.hold(&mut strokes, &stretched(factor as f32), &view(0.0));
        for at in 0..=20 {
            let x = long * f64::from(at) / 20.0;
            let place = (320.0 + (from + x) * factor).clamp(
                320.0 + from * factor + 1e-6,
                320.0 + (from + long) * factor - 1e-6,
            );
            let u = u_at(&strokes[0], place);
            prop_assert!((u - x).abs() <= 8.0, "{x} px of {long}: {u}");
        }
    }

    /// A line of 9 pixels and more that is joined to another, at whichever end, keeps its texture.
    #[test]
    fn short_lines_that_are_joined_keep_their_texture(short in 9.0..30.0_f64, long in 60.0..300.0_f64, before: bool) {
        let (a, b) = match before {
            true => (short, long),
            false => (long, short),
        };
        let middle = 100.0 + a;
        let parted = vec![line(1, 100.0, middle, 50.0), line(2, middle + 1.0, middle + 1.0 + b, 50.0)];
        let frames = held([parted, vec![line(3, 100.0, middle + 1.0 + b, 50.0)]]);
        let (x, want) = match before {
            true => (102.0, 2.0),
            false => (middle + b - 1.0, b - 2.0),
        };
        let u = u_at(&frames[1][0], x);
        // It comes nearer by half a pixel.
        prop_assert!((u - want).abs() <= 0.6, "{u} for {want}");
    }

    /// Of what nothing happens to nothing changes, to the bit, whatever was joined and parted before.
    #[test]
    fn what_stands_still_stays_to_the_bit(cuts in prop::collection::vec(60.0..560.0_f64, 0..6), again: bool) {
        let parted = |cuts: &[f64]| -> Vec<Stroke> {
            let mut at: Vec<f64> = [&[20.0, 620.0], cuts].concat();
            at.sort_by(f64::total_cmp);
            let parts = at.windows(2).zip(1..).filter(|(pair, _)| pair[1] - pair[0] > 4.0);
            parts.map(|(pair, id)| line(id, pair[0], pair[1] - 1.0, 50.0)).collect()
        };
        let (shape, view) = (sheet(0.0), view(0.0));
        let mut state = HeldStrokes::default();
        if again {
            state.hold(&mut parted(&[]), &shape, &view);
        }
        let mut frames = (0..3).map(|_| {
            let mut strokes = [parted(&cuts), vec![ring(3)]].concat();
            state.hold(&mut strokes, &shape, &view);
            strokes
        });
        let first = frames.next();
        prop_assert_eq!(&frames.next(), &first);
        prop_assert_eq!(&frames.next(), &first);
    }
}

/// The part of a line from one x to another along the row y = 100, on which the line runs from 60 to 560 or back.
fn part_of_row(id: u64, [from, to]: [f64; 2], is_back: bool) -> Stroke {
    let ends = [from, to].map(|x| if is_back { 560.0 - x } else { x - 60.0 });
    let mut part = line(id, from, to, 100.0);
    part.part = Some(LinePart {
        line: 40,
        ends_px: ends,
        length_px: 500.0,
    });
    if is_back {
        part.points.reverse();
        part.part = part.part.map(LinePart::reversed);
    }
    measure(&mut part.points);
    for point in &mut part.points {
        point.u += part.part.map_or(0.0, |part| part.ends_px[0]);
    }
    part
}

proptest! {
    /// A line before which something passes stays one line: its parts keep its name and its texture, and so does it
    /// when it is whole again.
    #[test]
    fn what_is_parted_for_a_while_stays_one_line(
        gap in [70.0..300.0_f64, 20.0..200.0],
        is_back in prop::array::uniform2(any::<bool>()),
        from_u in -300.0..300.0_f64,
        frames in 1_usize..9,
    ) {
        let [left, right] = [gap[0], gap[0] + gap[1]];
        let mut whole = line(7, 60.0, 560.0, 100.0);
        whole.points.iter_mut().for_each(|point| point.u += from_u);
        let parted = |number: usize| {
            let back = is_back[number % 2];
            vec![part_of_row(40, [60.0, left], back), part_of_row(41, [right, 560.0], back)]
        };
        let last = line(50, 60.0, 560.0, 100.0);
        let frames = std::iter::once(vec![whole]).chain((0..frames).map(parted)).chain([vec![last]]);
        for strokes in held(frames) {
            prop_assert!(strokes.iter().all(|stroke| stroke.line() == 7), "{:?}", strokes);
            let ids: std::collections::BTreeSet<u64> = strokes.iter().map(|stroke| stroke.id).collect();
            prop_assert_eq!(ids.len(), strokes.len());
            for stroke in &strokes {
                prop_assert!(stroke.part.is_none_or(|part| !part.is_against()));
                for point in &stroke.points {
                    let expected = point.position[0] - 60.0 + from_u;
                    prop_assert!((point.u - expected).abs() < 0.1, "{} but {}", point.u, expected);
                }
            }
        }
    }

    /// A part that nobody saw before goes on from the part beside it, whichever way this runs.
    #[test]
    fn a_part_that_comes_into_sight_goes_on(
        is_back in prop::array::uniform2(any::<bool>()),
        is_first: bool,
        from_u in -300.0..300.0_f64,
    ) {
        let [shown, new] = match is_first {
            true => [[60.0, 200.0], [300.0, 560.0]],
            false => [[300.0, 560.0], [60.0, 200.0]],
        };
        let mut before = part_of_row(40, shown, is_back[0]);
        before.part = None;
        let first_u = before.points[0].u;
        before.points.iter_mut().for_each(|point| point.u += from_u - first_u);
        let u_of = |x: f64| {
            let start = if is_back[0] { shown[1] } else { shown[0] };
            from_u + if is_back[0] { start - x } else { x - start }
        };
        let after = vec![part_of_row(40, shown, is_back[1]), part_of_row(41, new, is_back[1])];
        let strokes = held([vec![before], after]).pop().expect("a frame");
        prop_assert_eq!(strokes.len(), 2);
        for stroke in &strokes {
            prop_assert_eq!(stroke.line(), 40);
            for point in &stroke.points {
                let expected = u_of(point.position[0]);
                prop_assert!((point.u - expected).abs() < 0.1, "{} but {}", point.u, expected);
            }
        }
    }
}
