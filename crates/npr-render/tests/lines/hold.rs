//! Strokes that hold still from frame to frame.

use crate::scenes::{SIZE, camera_at, scene_of};
use npr_core::camera::{Camera, Projection, bounds_of};
use npr_core::math::{cos_f64, sin_f64};
use npr_mesh::Mesh;
use npr_mesh::testing::{cube, icosphere, mapped};
use npr_render::{Drawing, HeldLines, LineModel, LineModelOptions, LineOptions, LineSource};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_vector::project::Projector;
use npr_vector::stroke::{Stroke, StrokePoint};
use std::collections::BTreeSet;

/// A ball with bumps, whose outlines run into each other and end everywhere.
fn bumpy_ball() -> Scene {
    let bump = |[x, y, z]: [f32; 3]| {
        let [a, b, c] = [x, y, z].map(f64::from);
        let height = sin_f64(9.0 * a + 1.0) * sin_f64(8.0 * b) * sin_f64(7.0 * c + 2.0);
        [x, y, z].map(|v| v * (1.6 + 0.25 * height as f32))
    };
    scene_of(&mapped(&icosphere(5), bump))
}

fn camera(frame: u32) -> Camera {
    let turn = 0.4 + 0.5_f64.to_radians() * f64::from(frame);
    let [x, z] = [sin_f64(turn), cos_f64(turn)].map(|v| 7.0 * v as f32);
    camera_at([x, 2.0, z])
}

fn model(scene: &Scene) -> LineModel {
    LineModel::for_style(scene, &Style::default(), &LineModelOptions::default(), None)
        .expect("a small scene")
}

/// The frames of a turn, each held to the one before or not.
fn turn(model: &LineModel, style: &Style, options: &LineOptions, is_held: bool) -> Vec<Drawing> {
    let mut held = HeldLines::default();
    let frames = (0..24).map(|frame| match is_held {
        true => model.draw_held(&camera(frame), style, options, &mut held),
        false => model.draw(&camera(frame), style, options),
    });
    frames.collect::<Result<_, _>>().expect("drawn")
}

/// Of the points of all frames that lie where the surface carries one of the frame before: the shares whose texture
/// jumps, and whose strokes have other ids.
fn changes(model: &LineModel, frames: &[Drawing]) -> [f64; 2] {
    let bounds = bounds_of(model.shape().positions.iter().copied().map(Into::into));
    let (mut all, mut changed) = (0, [0; 2]);
    for (pair, frame) in frames.windows(2).zip(1..) {
        let projector = Projector::new(&camera(frame), SIZE, bounds);
        let points = |drawing: &Drawing| -> Vec<(u64, f64, [f64; 2])> {
            let strokes = drawing.strokes.iter().filter(|stroke| !stroke.closed);
            let places = strokes.flat_map(|stroke| {
                stroke.points.iter().map(|point| {
                    let world = glam::DVec3::from(point.world.map(f64::from));
                    (stroke.id, point.u, projector.project(world))
                })
            });
            places.collect()
        };
        let [before, after] = [0, 1].map(|i| points(&pair[i]));
        for (id, u, [x, y]) in after {
            let away = |other: &&(u64, f64, [f64; 2])| (other.2[0] - x).hypot(other.2[1] - y);
            let nearest = before.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
            let Some(was) = nearest.filter(|was| away(was) < 2.0) else {
                continue;
            };
            all += 1;
            changed[0] += usize::from((u - was.1).abs() > 8.0);
            changed[1] += usize::from(id != was.0);
        }
    }
    assert!(all > 1000, "{all}");
    changed.map(|count| f64::from(count as u32) / f64::from(all))
}

#[test]
fn textures_and_ids_hold_while_the_camera_turns() {
    let model = model(&bumpy_ball());
    for method in [
        LineSource::Edges,
        LineSource::Surface,
        LineSource::Image,
        LineSource::Potrace,
    ] {
        let options = LineOptions {
            method,
            ..LineOptions::new(SIZE)
        };
        let [raw, held] = [false, true]
            .map(|is_held| changes(&model, &turn(&model, &Style::default(), &options, is_held)));
        assert!(
            raw[0] > 0.02 && held[0] < 0.4 * raw[0],
            "{method:?}: {held:?} of {raw:?}"
        );
        assert!(held[1] < 0.6 * raw[1], "{method:?}: {held:?} of {raw:?}");
    }
}

#[test]
fn each_id_is_there_once_and_lines_of_pictures_are_those_of_stills() {
    let model = model(&bumpy_ball());
    for method in [LineSource::Surface, LineSource::Image] {
        let options = LineOptions {
            method,
            hidden: method == LineSource::Surface,
            ..LineOptions::new(SIZE)
        };
        // Short lines shrink before they go, those of pictures too.
        let mut style = Style::default();
        if method == LineSource::Image {
            let keys = ["line.least=0px", "line.crease_least=0px"];
            keys.iter()
                .for_each(|key| style.set(key).expect("a length"));
        }
        let [stills, held] = [false, true].map(|is_held| turn(&model, &style, &options, is_held));
        assert_eq!(held[0], stills[0], "the first frame is a still");
        for (held, still) in held.iter().zip(&stills) {
            let ids: BTreeSet<u64> = held.strokes.iter().map(|stroke| stroke.id).collect();
            assert_eq!(ids.len(), held.strokes.len());
            if method == LineSource::Image {
                let lengths = |drawing: &Drawing| {
                    let strokes = drawing.strokes.iter();
                    let mut all: Vec<f64> = strokes.map(|stroke| stroke.length()).collect();
                    all.sort_by(f64::total_cmp);
                    all
                };
                let [a, b] = [held, still].map(lengths);
                assert!(a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6));
            } else {
                // Joints of lines on meshes hold, so other gaps are closed: of 12 pixels at most, and of 30 between
                // contours. From the middle of one it is half of that to the lines of a still.
                assert!(farthest(held, still) <= 15.0 && farthest(still, held) <= 15.0);
            }
        }
    }
}

/// How far the points of one drawing's lines lie from those of another at most, in pixels.
fn farthest(from: &Drawing, to: &Drawing) -> f64 {
    let points = |drawing: &Drawing| -> Vec<[f64; 2]> {
        let points = drawing.strokes.iter().flat_map(|stroke| &stroke.points);
        points.map(|point| point.position).collect()
    };
    let [from, to] = [from, to].map(points);
    let away = |[x, y]: [f64; 2]| {
        let all = to.iter().map(|other| (other[0] - x).hypot(other[1] - y));
        all.fold(f64::MAX, f64::min)
    };
    from.into_iter().map(away).fold(0.0, f64::max)
}

/// How many ends of the strokes of all frames have none near them in the next one, as a share.
fn lost_ends(model: &LineModel, frames: &[Drawing]) -> f64 {
    let bounds = bounds_of(model.shape().positions.iter().copied().map(Into::into));
    let (mut all, mut lost) = (0, 0);
    for (pair, frame) in frames.windows(2).zip(1..) {
        let projector = Projector::new(&camera(frame), SIZE, bounds);
        let ends = |drawing: &Drawing| -> Vec<[f64; 2]> {
            let open = drawing.strokes.iter().filter(|stroke| !stroke.closed);
            let ends = open.flat_map(|stroke| [stroke.points.first(), stroke.points.last()]);
            let worlds = ends.flatten().map(|point| point.world.map(f64::from));
            worlds
                .map(|world| projector.project(world.into()))
                .collect()
        };
        let [before, after] = [0, 1].map(|i| ends(&pair[i]));
        for [x, y] in before {
            let is_near = |other: &[f64; 2]| (other[0] - x).hypot(other[1] - y) <= 8.0;
            all += 1;
            lost += usize::from(!after.iter().any(is_near));
        }
    }
    assert!(all > 100, "{all}");
    f64::from(lost as u32) / f64::from(all)
}

#[test]
fn joints_hold_while_the_camera_turns() {
    let model = model(&bumpy_ball());
    for method in [LineSource::Edges, LineSource::Surface] {
        let options = LineOptions {
            method,
            ..LineOptions::new(SIZE)
        };
        let [raw, held] = [false, true]
            .map(|is_held| lost_ends(&model, &turn(&model, &Style::default(), &options, is_held)));
        assert!(held < 0.8 * raw, "{method:?}: {held} of {raw}");
    }
}

#[test]
fn held_frames_are_the_same_on_any_number_of_threads() {
    let model = model(&bumpy_ball());
    let frames = |count| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        pool.expect("threads")
            .install(|| turn(&model, &Style::default(), &LineOptions::new(SIZE), true))
    };
    assert_eq!(frames(1), frames(3));
}

/// A beam from x = -2 to 2 behind two posts, as seen from farther and farther to the right: the posts pass before it,
/// and its right end comes out from behind the second.
fn passing_posts(style: &Style) -> Vec<Drawing> {
    let corners: [[[f32; 3]; 2]; 3] = [
        [[-2.0, -0.2, -0.2], [2.0, 0.2, 0.2]],
        [[-0.6, -2.0, 2.9], [-0.2, 2.0, 3.0]],
        [[0.9, -2.0, 2.9], [1.23, 2.0, 3.0]],
    ];
    let boxes = corners.map(|corners| {
        let at = |p: [f32; 3]| std::array::from_fn(|i| corners[usize::from(p[i] > 0.0)][i]);
        mapped(&cube(), at)
    });
    let positions = boxes.iter().flat_map(|mesh| mesh.positions().to_vec());
    let triangles = boxes.iter().zip(0_u32..).flat_map(|(mesh, number)| {
        let triangles = mesh.triangles().to_vec().into_iter();
        triangles.map(move |corners| corners.map(|corner| corner + 8 * number))
    });
    let mesh = Mesh::new(positions.collect(), triangles.collect()).expect("boxes");
    let model = LineModel::for_style(&scene_of(&mesh), style, &LineModelOptions::default(), None)
        .expect("a small scene");
    let options = LineOptions::new([640, 240]);
    let mut held = HeldLines::default();
    let frames = (0..30).map(|frame| {
        let x = -0.6 + 0.04 * frame as f32;
        let camera = Camera {
            eye: [x, 3.0, 9.0],
            target: [x, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 0.4 },
        };
        model.draw_held(&camera, style, &options, &mut held)
    });
    frames.collect::<Result<_, _>>().expect("drawn")
}

/// The part behind a post that nobody saw before, and what a post parts, go on as the line does.
#[test]
fn a_line_goes_on_behind_what_passes_before_it() {
    let frames = passing_posts(&Style::default());
    let edge_of = |drawing: &Drawing| -> Vec<Stroke> {
        // The upper edge in front.
        let is_on = |point: &StrokePoint| {
            let [_, y, z] = point.world;
            (y - 0.2).abs() < 0.02 && (z - 0.2).abs() < 0.02
        };
        let strokes = drawing.strokes.iter();
        let on = strokes.filter(|stroke| stroke.points.iter().all(is_on));
        on.filter(|stroke| stroke.length() > 20.0)
            .cloned()
            .collect()
    };
    let counts: Vec<usize> = frames.iter().map(|frame| edge_of(frame).len()).collect();
    assert_eq!((counts[0], counts[29]), (2, 3), "{counts:?}");

    // Its texture lies on the beam wherever it is seen, and it is called by one name.
    let first = &edge_of(&frames[0])[0];
    let [from, to] = [0, first.points.len() - 1].map(|i| &first.points[i]);
    let per_unit = (to.u - from.u) / f64::from(to.world[0] - from.world[0]);
    for stroke in frames.iter().flat_map(edge_of) {
        assert_eq!(stroke.line(), first.line());
        for point in &stroke.points {
            let expected = from.u + per_unit * f64::from(point.world[0] - from.world[0]);
            assert!(
                (point.u - expected).abs() < 2.5,
                "{} but {expected}",
                point.u
            );
        }
    }
}
