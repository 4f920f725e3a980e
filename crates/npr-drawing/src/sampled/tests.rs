use super::*;
use npr_core::camera::{Camera, Projection};
use npr_vector::ink_point::InkPoint;
use npr_vector::stroke::{Kind, StrokeSurface};
use proptest::prelude::*;

const SIZE: [u32; 2] = [200, 160];

fn view() -> View {
    let camera = Camera {
        eye: [0.0, 0.0, 5.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.7 },
    };
    camera.view(SIZE, ([-2.0; 3], [2.0; 3]))
}

fn seen(view: &View, world: [f32; 3]) -> ([f64; 2], f64) {
    let sampling = Sampling {
        view,
        lay_of: &|_| BrushLay::PEN,
        width_of: &|_| 0,
    };
    let point = StrokePoint {
        world,
        ..StrokePoint::default()
    };
    let (px, coordinate) = sampling.end(&point);
    (px, 1.0 / coordinate)
}

/// A stroke through points of the world, drawn beside where it is seen, half as wide as it is deep.
fn stroke(view: &View, world: &[[f32; 3]], closed: bool) -> Stroke {
    let mut u = 0.0;
    let mut last = None;
    let points = world.iter().map(|world| {
        let ([x, y], depth) = seen(view, *world);
        let position = [x + 0.5, y];
        u += last
            .replace(position)
            .map_or(0.0, |last| distance(last, position));
        StrokePoint {
            position,
            depth,
            width: 0.5 * depth,
            u,
            world: *world,
            ..StrokePoint::default()
        }
    });
    Stroke {
        id: 7,
        kind: Kind::Contour,
        occluders: 0,
        surface: 0,
        closed,
        part: None,
        points: points.collect(),
    }
}

fn drawing(strokes: Vec<Stroke>) -> Drawing {
    Drawing {
        size: SIZE,
        surfaces: vec![StrokeSurface {
            line_color: [1, 2, 3, 255],
            ..StrokeSurface::default()
        }],
        strokes,
        ..Drawing::default()
    }
}

fn sampled(drawing: &Drawing, room: usize) -> Option<SampledStrokes> {
    let view = view();
    let sampling = Sampling {
        view: &view,
        lay_of: &|_| BrushLay {
            brush: 3,
            images: Images::ByLength(20.0),
        },
        width_of: &|stroke| stroke.id as u32 % 7,
    };
    sample_strokes(drawing, &sampling, room)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// Samples lie on their strokes at equal steps of at most a pixel, or of as much as the room asks for, from the
    /// first place to the last; their spines are seen where the world has them.
    #[test]
    fn samples_go_along_their_strokes(
        lines in prop::collection::vec(prop::collection::vec(prop::array::uniform3(-1.0f32..1.0), 2..6), 0..5),
        closed: bool, extra in 0usize..2000,
    ) {
        let view = view();
        let drawing = drawing(lines.iter().map(|line| stroke(&view, line, closed)).collect());
        let room = (2 + 6 * lines.len() + extra).next_multiple_of(2);
        let SampledStrokes { lines: found, samples } = sampled(&drawing, room).expect("few lines");
        prop_assert_eq!(samples.len(), room);
        prop_assert_eq!(found.len(), drawing.strokes.len() + 1);

        // Lines follow each other and fill the list.
        let mut next = 0;
        for line in &found {
            prop_assert!(line.first == next && line.count >= 2 && line.first % 2 == 0 && line.count % 2 == 0);
            next += line.count;
        }
        prop_assert_eq!(next as usize, room);
        let filling = &samples[found[found.len() - 1].first as usize..];
        prop_assert!(filling.iter().all(|sample| sample.half_width == 0.0 && sample.line + 1 == found.len() as u32));

        // Steps are of a pixel where there is room for it.
        let total: f64 = drawing.strokes.iter().map(Stroke::length).sum();
        let is_roomy = (room as f64) > total + 5.0 * found.len() as f64;
        for ((number, stroke), line) in (0..).zip(&drawing.strokes).zip(&found) {
            let own = &samples[line.first as usize..(line.first + line.count) as usize];
            prop_assert!(own.iter().all(|sample| sample.line == number && sample.color == 0xff03_0201));
            prop_assert!(!is_roomy || line.step_px <= 1.0);
            prop_assert_eq!(u64::from(line.bits >> SampledLine::WIDTH_SHIFT), stroke.id % 7);
            let ends = [own[0].px, own[own.len() - 1].px];
            let last = if closed { 0 } else { stroke.points.len() - 1 };
            for (end, point) in ends.iter().zip([0, last]) {
                let position = stroke.points[point].position;
                prop_assert!((0..2).all(|i| (f64::from(end[i]) - position[i]).abs() < 0.01));
            }
            for pair in own.windows(2) {
                let [a, b] = [pair[0].px, pair[1].px].map(|px| px.map(f64::from));
                prop_assert!(distance(a, b) <= f64::from(line.step_px) + 0.01);
            }

            // A spine lies half a pixel beside its stroke, and its width says how deep it is, as far as the picture of
            // a straight line goes.
            for sample in own {
                prop_assert!((sample.px[0] - sample.spine_px[0] - 0.5).abs() < 0.01);
                prop_assert!((sample.px[1] - sample.spine_px[1]).abs() < 0.01);
                prop_assert!((4.0 * sample.half_width / sample.depth - 1.0).abs() < 0.2);
            }
        }
    }
}

#[test]
fn more_strokes_than_there_is_room_for_are_refused() {
    let view = view();
    let line = stroke(&view, &[[0.0; 3], [0.1, 0.0, 0.0]], false);
    let all = drawing(vec![line; 100]);
    assert_eq!(most_strokes(602), 100);
    assert!(sampled(&all, 602).is_some());
    assert!(sampled(&all, 600).is_none());
}

#[test]
fn lines_know_their_ends_and_their_brush() {
    let view = view();
    let long = stroke(&view, &[[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]], false);
    let meets_it = stroke(&view, &[[0.0, 0.0, 0.0], [0.0, 0.7, 0.0]], false);
    let ring = stroke(
        &view,
        &[[-0.9, -0.9, 0.0], [-0.7, -0.9, 0.0], [-0.8, -0.7, 0.0]],
        true,
    );
    let found = sampled(&drawing(vec![long, meets_it, ring]), 4096).expect("few lines");
    let bits: Vec<u32> = found.lines.iter().map(|line| line.bits).collect();
    let (start, end) = (SampledLine::START_FREE, SampledLine::END_FREE);
    assert_eq!(bits, [start | end, end, SampledLine::CLOSED, 0]);
    let line = &found.lines[0];
    assert_eq!(line.ink_flags >> InkPoint::BRUSH_SHIFT, 3);
    assert!((line.u_per_px - 1.0 / 20.0).abs() < 1e-4 && (0.0..1.0).contains(&line.u_start));
}

#[test]
fn odd_strokes_have_samples_too() {
    let view = view();
    let mut odd = stroke(&view, &[[0.0; 3], [0.1, 0.0, 0.0]], false);
    odd.points[1].position = [f64::NAN, 1e300];
    odd.points[1].width = f64::NAN;
    odd.points[1].world = [f32::INFINITY; 3];
    let mut none = odd.clone();
    none.points.clear();
    let mut one = odd.clone();
    one.points.truncate(1);
    let found = sampled(&drawing(vec![odd, none, one]), 64).expect("few lines");
    assert_eq!(
        found
            .lines
            .iter()
            .map(|line| line.count)
            .collect::<Vec<_>>(),
        [2, 2, 2, 58]
    );
}
