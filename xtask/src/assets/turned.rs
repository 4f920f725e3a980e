//! Surfaces of revolution, as from a potter's wheel.

use glam::{Vec2, Vec3};
use npr_core::math;

use super::pen::Path;
use super::shape::{Paint, Shape, Vertex};

/// The surface that `profile`, as (radius, height), sweeps about the y axis in `segments` steps.
///
/// Drawn upwards the profile has its outside to the right. The last column lies exactly on the first,
/// so a profile that starts and ends on the axis gives a closed surface.
pub fn turned(profile: &Path, segments: u32, paint: Paint) -> Shape {
    let along = profile.fractions();
    Shape::grid(
        profile.points.len() as u32,
        segments + 1,
        paint,
        |row, column| {
            let point = profile.points[row as usize];
            let angle = std::f32::consts::TAU * (column % segments) as f32 / segments as f32;
            let (x, z) = (point.x * math::cos(angle), point.x * math::sin(angle));
            Vertex {
                position: Vec3::new(x + 0.0, point.y, z + 0.0),
                uv: Vec2::new(column as f32 / segments as f32, 1.0 - along[row as usize]),
            }
        },
    )
}

/// A ball of radius `radius` about the origin, with `segments` columns and half as many rows.
pub fn ball(radius: f32, segments: u32, paint: Paint) -> Shape {
    let mut profile = Path::start(0.0, -radius).arc([0.0; 2], std::f32::consts::PI, segments / 2);
    if let Some(pole) = profile.points.last_mut() {
        pole.x = 0.0;
    }
    turned(&profile, segments, paint)
}

#[cfg(test)]
mod tests {
    use super::super::shape::{open_edge_count, volume};
    use super::*;

    #[test]
    fn a_ball_is_closed_and_outside_out() {
        let shape = ball(2.0, 48, Paint(0));
        assert_eq!(open_edge_count(&shape), 0);
        let round = 4.0 / 3.0 * std::f32::consts::PI * 8.0;
        assert!(
            (volume(&shape) / round - 1.0).abs() < 0.01,
            "volume {}",
            volume(&shape)
        );
    }
}
