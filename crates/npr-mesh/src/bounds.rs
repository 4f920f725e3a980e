//! How much space a mesh takes.

use glam::DVec3;

/// Radius of the sphere about the middle of the bounding box that holds every position.
///
/// In the unit of the positions; 0 for no positions. At most √3 times the smallest sphere's.
pub fn bounding_radius(positions: &[[f32; 3]]) -> f32 {
    let (low, high) = bounding_box(positions);
    let middle = (low + high) / 2.0;
    let farthest = positions
        .iter()
        .map(|position| DVec3::from_array(position.map(f64::from)).distance_squared(middle))
        .fold(0.0, f64::max);
    farthest.sqrt() as f32
}

/// Lowest and highest corner of the axis-aligned box around `positions`; zeros for none.
pub(crate) fn bounding_box(positions: &[[f32; 3]]) -> (DVec3, DVec3) {
    let mut points = positions
        .iter()
        .map(|position| DVec3::from_array(position.map(f64::from)));
    let Some(first) = points.next() else {
        return (DVec3::ZERO, DVec3::ZERO);
    };
    points.fold((first, first), |(low, high), point| {
        (low.min(point), high.max(point))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radius_of_simple_shapes() {
        assert_eq!(bounding_radius(&[]), 0.0);
        assert_eq!(bounding_radius(&[[7.0, 7.0, 7.0]]), 0.0);
        assert_eq!(bounding_radius(&[[1.0, 0.0, 0.0], [5.0, 0.0, 0.0]]), 2.0);
    }

    #[test]
    fn the_largest_floats_do_not_overflow() {
        assert_eq!(
            bounding_radius(&[[f32::MAX, 0.0, 0.0], [f32::MIN, 0.0, 0.0]]),
            f32::MAX
        );
    }
}
