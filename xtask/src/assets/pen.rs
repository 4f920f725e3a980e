//! Planar paths drawn by lines and cubic curves, kept as polylines.

use glam::Vec2;
use npr_core::math;

/// A path in a plane, in centimetres, drawn move by move.
///
/// Profiles of turned shapes, centre lines of tubes and outlines of extrusions are all drawn this way.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// The points in drawing order; a closed outline does not repeat its first point.
    pub points: Vec<Vec2>,
}

impl Path {
    /// A path that so far is only its first point.
    pub fn start(x: f32, y: f32) -> Self {
        Self {
            points: vec![Vec2::new(x, y)],
        }
    }

    /// Adds a straight stretch to (`x`, `y`).
    pub fn line(mut self, x: f32, y: f32) -> Self {
        self.points.push(Vec2::new(x, y));
        self
    }

    /// Adds a cubic Bezier curve with two control points and an end, as `steps` chords.
    pub fn curve(mut self, controls: [[f32; 2]; 3], steps: u32) -> Self {
        let start = self.end();
        let [c1, c2, end] = controls.map(Vec2::from);
        for step in 1..=steps {
            let t = step as f32 / steps as f32;
            let s = 1.0 - t;
            let inner = c1 * (3.0 * s * s * t) + c2 * (3.0 * s * t * t);
            self.points
                .push(start * (s * s * s) + inner + end * (t * t * t));
        }
        self
    }

    /// Adds a circular arc about `centre` from the pen's place, turning by `angle` radians.
    pub fn arc(mut self, centre: [f32; 2], angle: f32, steps: u32) -> Self {
        let centre = Vec2::from(centre);
        let spoke = self.end() - centre;
        for step in 1..=steps {
            let turn = angle * step as f32 / steps as f32;
            let rotation = Vec2::new(math::cos(turn), math::sin(turn));
            self.points.push(centre + rotation.rotate(spoke));
        }
        self
    }

    /// The outline without its last point, which a closing move put onto the first.
    pub fn closed(mut self) -> Self {
        self.points.pop();
        self
    }

    /// The direction of travel at each point, of length 1.
    pub fn tangents(&self) -> Vec<Vec2> {
        let last = self.points.len() - 1;
        (0..=last)
            .map(|i| self.points[(i + 1).min(last)] - self.points[i.saturating_sub(1)])
            .map(Vec2::normalize_or_zero)
            .collect()
    }

    /// How far along the path each point lies, from 0 to 1.
    pub fn fractions(&self) -> Vec<f32> {
        let mut length = 0.0;
        let mut lengths = vec![0.0];
        for pair in self.points.windows(2) {
            length += pair[0].distance(pair[1]);
            lengths.push(length);
        }
        lengths
            .iter()
            .map(|l| l / length.max(f32::MIN_POSITIVE))
            .collect()
    }

    /// The pen's place.
    fn end(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }
}

/// A closed rectangle about the origin with round corners, counter-clockwise.
pub fn rounded_rectangle(width: f32, height: f32, radius: f32, steps: u32) -> Path {
    let (x, y) = (width / 2.0 - radius, height / 2.0 - radius);
    let quarter = std::f32::consts::FRAC_PI_2;
    Path::start(x + radius, -y)
        .line(x + radius, y)
        .arc([x, y], quarter, steps)
        .line(-x, y + radius)
        .arc([-x, y], quarter, steps)
        .line(-x - radius, -y)
        .arc([-x, -y], quarter, steps)
        .line(x, -y - radius)
        .arc([x, -y], quarter, steps)
        .closed()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_ends_where_it_was_told_to() {
        let path = Path::start(1.0, 0.0).curve([[1.0, 1.0], [0.0, 2.0], [-3.0, 2.0]], 7);
        assert_eq!(path.points.len(), 8);
        assert_eq!(path.points[7], Vec2::new(-3.0, 2.0));
        assert_eq!(path.fractions()[7], 1.0);
    }

    #[test]
    fn round_corners_stay_inside_their_rectangle() {
        let path = rounded_rectangle(10.0, 4.0, 1.0, 6);
        assert!(
            path.points
                .iter()
                .all(|p| p.x.abs() <= 5.0001 && p.y.abs() <= 2.0001)
        );
        let area: f32 = (0..path.points.len())
            .map(|i| path.points[i].perp_dot(path.points[(i + 1) % path.points.len()]) / 2.0)
            .sum();
        assert!(
            (area - 39.14).abs() < 0.05,
            "counter-clockwise, corners cut: {area}"
        );
    }
}
