//! Strokes on a sheet that lies flat before the eye: a pixel of the picture is a unit of the world.

use npr_core::camera::{Camera, Projection};
use npr_vector::project::Lens;
use npr_vector::stroke::{Kind, Stroke, StrokePoint};

use super::traced::Traced;
use crate::lines::viewpoint::Viewpoint;

/// The picture.
pub const SIZE: [u32; 2] = [640, 480];

/// The view of the sheet, moved to the right by some pixels.
pub fn sheet_moved(right: f64) -> Viewpoint {
    let at = |z: f32| [-right as f32, 0.0, z];
    let camera = Camera {
        eye: at(100.0),
        target: at(0.0),
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel {
            height: SIZE[1] as f32,
        },
    };
    Viewpoint::new(&camera, SIZE)
}

/// An open or closed stroke through places of the sheet.
pub fn stroke(places: impl IntoIterator<Item = [f64; 2]>, closed: bool) -> Stroke {
    let mut u = 0.0;
    let mut last: Option<[f64; 2]> = None;
    let point = |position: [f64; 2]| {
        u += last.map_or(0.0, |last| super::near::distance(last, position));
        last = Some(position);
        StrokePoint {
            position,
            depth: 100.0,
            width: 2.0,
            u,
            world: [
                (position[0] - f64::from(SIZE[0]) / 2.0) as f32,
                (f64::from(SIZE[1]) / 2.0 - position[1]) as f32,
                0.0,
            ],
            ..StrokePoint::default()
        }
    };
    Stroke {
        id: 0,
        kind: Kind::Contour,
        occluders: 0,
        surface: 0,
        closed,
        part: None,
        points: places.into_iter().map(point).collect(),
    }
}

/// A straight stroke.
pub fn line(from: [f64; 2], to: [f64; 2]) -> Stroke {
    stroke([from, to], false)
}

/// A circle that starts to the right of its middle.
pub fn ring(middle: [f64; 2], radius: f64) -> Stroke {
    ring_from(middle, radius, 0)
}

/// A circle of 180 points that starts at one of them.
pub fn ring_from(middle: [f64; 2], radius: f64, first: u32) -> Stroke {
    let place = |i: u32| {
        let turn = f64::from((i + first) % 180) * std::f64::consts::TAU / 180.0;
        [
            middle[0] + radius * libm::cos(turn),
            middle[1] + radius * libm::sin(turn),
        ]
    };
    stroke((0..180).map(place), true)
}

/// The strokes of a frame.
pub fn traced(strokes: &[Stroke]) -> Traced {
    Traced::new(strokes, SIZE, Lens::Parallel)
}
