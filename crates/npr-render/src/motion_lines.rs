//! Lines that draw motion, as strokes: the same for frames and for drawings of lines.
//!
//! Speed lines follow what really moves, and after-images show where it was. Both lie behind all that moves.

mod after_images;
mod seen;
mod sort;
mod trails;

use crate::movement::Movement;
use npr_core::camera::Camera;
use npr_stylesheet::Style;
use npr_vector::stroke::{Drawing, Kind, Stroke, StrokeSurface};
pub(crate) use seen::Seen;
use sort::MotionStrokes;

/// A bit that all ids of these strokes have.
const ID_BIT: u64 = 1 << 52;

/// The lines that draw the motion of a scene, as a camera sees them in a picture of `size` pixels at `dpi` pixels per
/// inch.
///
/// Strokes of kind [`Kind::Marked`], on surfaces of objects "speed lines" and "after-images". O(vertices x moments +
/// triangles x (1 + after-images)), and grids of fixed size.
pub(crate) fn find_motion_lines(
    movement: &Movement,
    (camera, style): (&Camera, &Style),
    (size, dpi): ([u32; 2], f32),
) -> Drawing {
    // Leave out what does not move.
    let mut drawing = Drawing {
        size,
        ..Drawing::default()
    };
    let is_moving = movement.is_moving();
    if !style.has_motion_lines() || !is_moving.contains(&true) {
        return drawing;
    }

    // Find the lines of both sorts: after-images lie below.
    let view = camera.view(size, movement.bounds());
    let seen = Seen::new((movement, &is_moving), style, &view, size);
    let mut found = after_images::find(&seen, movement, style, (size, dpi));
    found.extend(trails::find(&seen, movement, style, (size, dpi)));

    // Give them surfaces.
    let color = style.motion.color;
    let color = [color.r, color.g, color.b, color.a];
    let objects = movement.parts().iter().map(|info| info.object + 1);
    let object_number = objects.max().unwrap_or(0);
    for (surface, sort) in (0..).zip(found) {
        let MotionStrokes { names, strokes } = sort;
        let strokes = strokes.into_iter().map(|(id, points)| Stroke {
            id: ID_BIT | id,
            kind: Kind::Marked,
            occluders: 0,
            surface,
            closed: false,
            part: None,
            points,
        });
        drawing.strokes.extend(strokes);
        let [object, material] = names;
        drawing.surfaces.push(StrokeSurface {
            object,
            object_number,
            material,
            line_color: color,
            fill_color: color,
        });
    }
    drawing
}

/// Lays the strokes and surfaces of a drawing over another one of the same size.
pub(crate) fn lay_over(drawing: &mut Drawing, mut lines: Drawing) {
    let first = drawing.surfaces.len() as u32;
    for stroke in &mut lines.strokes {
        stroke.surface += first;
    }
    drawing.surfaces.append(&mut lines.surfaces);
    drawing.strokes.append(&mut lines.strokes);
}
