//! Lengths, areas and angles of one triangle.

use glam::DVec3;

/// A position as `f64`, in which differences and products of finite `f32` neither overflow nor vanish.
pub(crate) fn point(positions: &[[f32; 3]], vertex: u32) -> DVec3 {
    DVec3::from_array(positions[vertex as usize].map(f64::from))
}

/// One triangle; its edge `i` lies opposite its corner `i` and runs counter-clockwise.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Triangle {
    pub(crate) corners: [DVec3; 3],
}

impl Triangle {
    pub(crate) fn new(positions: &[[f32; 3]], indices: [u32; 3]) -> Self {
        Self {
            corners: indices.map(|vertex| point(positions, vertex)),
        }
    }

    pub(crate) fn edge(&self, opposite: usize) -> DVec3 {
        self.corners[(opposite + 2) % 3] - self.corners[(opposite + 1) % 3]
    }

    /// Twice the area, along the normal of counter-clockwise winding.
    pub(crate) fn cross(&self) -> DVec3 {
        self.edge(2).cross(-self.edge(1))
    }

    /// The unit normal; none for a triangle without area.
    pub(crate) fn normal(&self) -> Option<DVec3> {
        self.cross().try_normalize()
    }

    /// The interior angle at a corner in radians; 0 where an edge beside it has no length.
    pub(crate) fn angle(&self, corner: usize) -> f64 {
        let (ahead, behind) = (self.edge((corner + 2) % 3), -self.edge((corner + 1) % 3));
        let scale = ahead.length() * behind.length();
        if scale == 0.0 {
            return 0.0;
        }
        let (sin, cos) = (
            ahead.cross(behind).length() / scale,
            ahead.dot(behind) / scale,
        );
        f64::from(npr_core::math::atan2(sin as f32, cos as f32))
    }

    /// The area that belongs to each corner; the three add up to the triangle's.
    ///
    /// Voronoi areas, or half and two quarters where one angle is obtuse [Meyer et al. 2003, 3.3].
    pub(crate) fn corner_areas(&self) -> [f64; 3] {
        let area = self.cross().length() / 2.0;
        if area == 0.0 {
            return [0.0; 3];
        }
        let dots = [0, 1, 2].map(|i| -self.edge((i + 1) % 3).dot(self.edge((i + 2) % 3)));
        if let Some(obtuse) = dots.iter().position(|&dot| dot < 0.0) {
            return [0, 1, 2].map(|i| area * if i == obtuse { 0.5 } else { 0.25 });
        }
        // The cotangent at a corner is its dot product over twice the area.
        let shares = [0, 1, 2].map(|i| self.edge(i).length_squared() * dots[i] / (16.0 * area));
        [0, 1, 2].map(|i| shares[(i + 1) % 3] + shares[(i + 2) % 3])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn triangle_strategy() -> impl Strategy<Value = Triangle> {
        prop::array::uniform3(prop::array::uniform3(-1.0f64..1.0)).prop_map(|corners| Triangle {
            corners: corners.map(DVec3::from_array),
        })
    }

    proptest! {
        #[test]
        fn corner_areas_add_up(triangle in triangle_strategy()) {
            let areas = triangle.corner_areas();
            let whole = triangle.cross().length() / 2.0;
            prop_assert!((areas.iter().sum::<f64>() - whole).abs() < 1e-9);
            prop_assert!(areas.iter().all(|&area| area >= 0.0));
        }

        #[test]
        fn angles_add_up_to_half_a_turn(triangle in triangle_strategy()) {
            let sum: f64 = [0, 1, 2].map(|corner| triangle.angle(corner)).iter().sum();
            prop_assert!((sum - std::f64::consts::PI).abs() < 1e-5, "{sum}");
        }
    }

    #[test]
    fn extreme_sizes_keep_their_normal() {
        for size in [1e-44f32, 1.0, 3e38] {
            let positions = [[0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0]];
            let triangle = Triangle::new(&positions, [0, 1, 2]);
            let normal = triangle.normal().unwrap();
            assert!(normal.distance(DVec3::Z) < 1e-15, "size {size}: {normal}");
        }
    }
}
