//! What lights see: clip space from the world for pictures of what throws shadows.

use glam::Vec3;

/// A column-major 4x4 matrix.
pub type Matrix = [[f32; 4]; 4];

/// Widest view of a spot, as the cosine of the angle to its axis.
const WIDEST_COS: f32 = 0.05;

/// Clip space of a distant light that comes from `towards`, a unit vector: the rectangle in which the box of all that
/// throws shadows and the box of all that is seen overlap. Depth is reversed, 1 at the caster nearest to the light.
///
/// Both are given by points that enclose them. Where they do not overlap, all casters are shown.
pub fn distant_view(towards: [f32; 3], casters: &[[f32; 3]], seen: &[[f32; 3]]) -> Matrix {
    let back = Vec3::from(towards);
    let (right, up) = back.any_orthonormal_pair();
    let reach = |axis: Vec3, points: &[[f32; 3]]| {
        let along = points.iter().map(|point| axis.dot(Vec3::from(*point)));
        along.fold((f32::MAX, f32::MIN), |(low, high), x| {
            (low.min(x), high.max(x))
        })
    };
    let overlap = |axis: Vec3| {
        let (all, view) = (reach(axis, casters), reach(axis, seen));
        let both = (all.0.max(view.0), all.1.min(view.1));
        if both.0 < both.1 { both } else { all }
    };
    let farthest = casters
        .iter()
        .flatten()
        .fold(0.0f32, |most, x| most.max(x.abs()));
    let row = |axis: Vec3, (low, high): (f32, f32), from: f32| {
        // A little room on both sides, so that rounding puts nothing outside: sums cancel to the last bits of what is
        // added.
        let room = ((high - low) * 0.01).max(farthest * 1e-5).max(1e-12);
        let scale = (1.0 - from) / (high - low + 2.0 * room);
        (axis * scale).extend(from - (low - room) * scale)
    };
    let rows = [
        row(right, overlap(right), -1.0),
        row(up, overlap(up), -1.0),
        row(back, reach(back, casters), 0.0),
    ];
    let column = |i: usize, w: f32| [rows[0][i], rows[1][i], rows[2][i], w];
    [
        column(0, 0.0),
        column(1, 0.0),
        column(2, 0.0),
        column(3, 1.0),
    ]
}

/// Clip space of a spot at `position` that shines along the unit vector `axis` up to an angle of cosine `outer_cos`.
///
/// Depth is reversed, 1 at the distance `near`: what is nearer throws no shadow. Cones wider than 87 degrees are cut
/// there.
pub fn spot_view(position: [f32; 3], axis: [f32; 3], outer_cos: f32, near: f32) -> Matrix {
    let (eye, forward) = (Vec3::from(position), Vec3::from(axis));
    let (right, up) = (-forward).any_orthonormal_pair();
    let cos = outer_cos.clamp(WIDEST_COS, 0.999);
    let scale = cos / (1.0 - cos * cos).sqrt();
    let row = |axis: Vec3| axis.extend(-axis.dot(eye));
    let rows = [row(right * scale), row(up * scale), row(forward)];
    std::array::from_fn(|i| {
        let z = if i == 3 { near } else { 0.0 };
        [rows[0][i], rows[1][i], z, rows[2][i]]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{apply_point, unit_or_z};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn casters_lie_within_the_view_of_a_distant_light(
            towards in prop::array::uniform3(-1f32..1.0),
            points in prop::collection::vec(prop::array::uniform3(-9f32..9.0), 1..9),
            scale in prop_oneof![Just(1e-6f32), Just(1.0), Just(1e9)],
        ) {
            let towards = unit_or_z(towards);
            let points: Vec<_> = points.iter().map(|p| p.map(|x| x * scale)).collect();
            let m = distant_view(towards, &points, &points);
            let nearness = |p: &[f32; 3]| (0..3).map(|i| p[i] * towards[i]).sum::<f32>();
            for p in &points {
                let [x, y, z, w] = apply_point(&m, *p);
                prop_assert!(w == 1.0 && x.abs() <= 1.0 && y.abs() <= 1.0 && (0.0..=1.0).contains(&z), "{x} {y} {z}");
                let [_, _, other, _] = apply_point(&m, points[0]);
                let closer = nearness(p) - nearness(&points[0]);
                prop_assert!(closer.abs() < 1e-3 * scale || (z > other) == (closer > 0.0));
            }
        }

        #[test]
        fn a_cone_fills_the_view_of_its_spot(
            axis in prop::array::uniform3(-1f32..1.0), position in prop::array::uniform3(-9f32..9.0),
            cos in 0.1f32..0.99,
        ) {
            let axis = unit_or_z(axis);
            let m = spot_view(position, axis, cos, 0.01);
            let (right, _) = Vec3::from(axis).any_orthonormal_pair();
            let rim = Vec3::from(axis) * cos + right * (1.0 - cos * cos).sqrt();
            for (distance, direction, radius) in [(0.5, Vec3::from(axis), 0.0), (3.0, rim, 1.0)] {
                let at = Vec3::from(position) + direction * distance;
                let [x, y, z, w] = apply_point(&m, at.to_array());
                prop_assert!(((x * x + y * y).sqrt() / w - radius).abs() < 1e-2);
                prop_assert!(w > 0.0 && (z / w - 0.01 / w).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn what_is_not_seen_is_not_shown() {
        let casters = [[-10.0, 0.0, -10.0], [10.0, 5.0, 10.0]];
        let seen = [[-1.0, 0.0, -1.0], [1.0, 0.0, 1.0]];
        let m = distant_view([0.0, 1.0, 0.0], &casters, &seen);
        let reach = |p| {
            let [x, y, ..] = apply_point(&m, p);
            x.abs().max(y.abs())
        };
        assert!(reach([1.0, 0.0, 1.0]) <= 1.0 && reach([2.0, 0.0, 2.0]) > 1.5);
        let apart = distant_view([0.0, 1.0, 0.0], &casters, &[[90.0, 0.0, 0.0]]);
        assert!(apply_point(&apart, [10.0, 5.0, 10.0])[0].abs() <= 1.0);
    }
}
