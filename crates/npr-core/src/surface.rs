//! The surface point under a pixel, found again from the triangle's number.
//!
//! Rasterisers only store which triangle a pixel shows [Burns & Hunt 2013]; everything else is recomputed from
//! the three corners with the same few operations on both engines, so that pictures agree. Corners behind
//! the eye need no clipping [Olano & Greer 1997].

/// Perspective-correct weights of a triangle's corners at a point of the picture.
///
/// `clip` are the corners in clip space, `ndc` the point in normalised device coordinates. The weights sum
/// to 1 and may be negative where the point lies beside the triangle. A triangle seen edge-on gives its first corner.
#[inline]
pub fn weights_at(clip: [[f32; 4]; 3], ndc: [f32; 2]) -> [f32; 3] {
    // Moving the origin to the point first keeps full precision for small triangles.
    let a = offset_from(clip[0], ndc);
    let b = offset_from(clip[1], ndc);
    let c = offset_from(clip[2], ndc);
    summing_to_1([cross(b, c), cross(c, a), cross(a, b)])
}

/// Weights as of [`weights_at`] at a point of the picture, `step[0]` to its right and `step[1]` below, in normalised
/// device coordinates; a step down is negative.
///
/// Weights before they are made to sum to 1 are linear in the picture, so that three places cost little more than one.
#[inline]
pub fn weights_around(clip: [[f32; 4]; 3], ndc: [f32; 2], step: [f32; 2]) -> [[f32; 3]; 3] {
    let a = offset_from(clip[0], ndc);
    let b = offset_from(clip[1], ndc);
    let c = offset_from(clip[2], ndc);
    let here = [cross(b, c), cross(c, a), cross(a, b)];
    // Over a step of 1, a corner moves by -w against the point.
    let run = |p: [f32; 2], p_w: f32, q: [f32; 2], q_w: f32| {
        [
            step[0] * (p[1] * q_w - q[1] * p_w),
            step[1] * (q[0] * p_w - p[0] * q_w),
        ]
    };
    let [a_w, b_w, c_w] = [clip[0][3], clip[1][3], clip[2][3]];
    let runs = [
        run(b, b_w, c, c_w),
        run(c, c_w, a, a_w),
        run(a, a_w, b, b_w),
    ];
    [
        summing_to_1(here),
        summing_to_1(std::array::from_fn(|i| here[i] + runs[i][0])),
        summing_to_1(std::array::from_fn(|i| here[i] + runs[i][1])),
    ]
}

/// Weights scaled to sum to 1; the first alone where they cannot.
#[inline]
fn summing_to_1(weights: [f32; 3]) -> [f32; 3] {
    let sum = weights[0] + weights[1] + weights[2];
    if sum == 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let scale = 1.0 / sum;
    [weights[0] * scale, weights[1] * scale, weights[2] * scale]
}

/// Whether a triangle turns its front to the eye: its corners run counter-clockwise in the picture.
///
/// The sign of the determinant of the corners' homogeneous coordinates, so corners behind the eye need no clipping.
#[inline]
pub fn faces_eye(clip: [[f32; 4]; 3]) -> bool {
    let [a, b, c] = clip;
    let minor_a = b[1] * c[3] - b[3] * c[1];
    let minor_b = b[3] * c[0] - b[0] * c[3];
    let minor_c = b[0] * c[1] - b[1] * c[0];
    a[0] * minor_a + a[1] * minor_b + a[3] * minor_c > 0.0
}

/// A point carried by a column-major matrix, homogeneous.
#[inline]
pub fn apply_point(m: &[[f32; 4]; 4], p: [f32; 3]) -> [f32; 4] {
    std::array::from_fn(|i| m[0][i] * p[0] + m[1][i] * p[1] + m[2][i] * p[2] + m[3][i])
}

/// Weighted sum of three scalars.
#[inline]
pub fn blend(weights: [f32; 3], values: [f32; 3]) -> f32 {
    values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2]
}

/// Weighted sum of three points of a plane.
#[inline]
pub fn blend2(weights: [f32; 3], values: [[f32; 2]; 3]) -> [f32; 2] {
    std::array::from_fn(|i| blend(weights, [values[0][i], values[1][i], values[2][i]]))
}

/// Scalar product.
#[inline]
pub fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Weighted sum of three vectors.
#[inline]
pub fn blend3(weights: [f32; 3], values: [[f32; 3]; 3]) -> [f32; 3] {
    std::array::from_fn(|i| blend(weights, [values[0][i], values[1][i], values[2][i]]))
}

/// A unit vector in the direction of `v`; +z where `v` has no direction.
#[inline]
pub fn unit_or_z(v: [f32; 3]) -> [f32; 3] {
    let square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    if square < 1e-30 {
        return [0.0, 0.0, 1.0];
    }
    let length = square.sqrt();
    [v[0] / length, v[1] / length, v[2] / length]
}

/// The unit normal of a face from its corners in the world; its sign follows their order.
pub fn face_normal([a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    let [p, q] = [b, c].map(|corner| unit_or_z([0, 1, 2].map(|i| corner[i] - a[i])));
    unit_or_z([
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ])
}

/// A corner relative to a point of the picture, scaled by the corner's w; linear in the point.
#[inline]
pub fn offset_from(clip: [f32; 4], ndc: [f32; 2]) -> [f32; 2] {
    [clip[0] - ndc[0] * clip[3], clip[1] - ndc[1] * clip[3]]
}

/// Area of the parallelogram between two vectors of a plane.
#[inline]
pub fn cross(a: [f32; 2], b: [f32; 2]) -> f32 {
    a[0] * b[1] - a[1] * b[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn corner() -> impl Strategy<Value = [f32; 4]> {
        ((-2f32..2.0), (-2f32..2.0), (0.2f32..9.0)).prop_map(|(x, y, w)| [x * w, y * w, 0.1, w])
    }

    proptest! {
        #[test]
        fn a_point_of_the_triangle_is_found_again(
            a in corner(), b in corner(), c in corner(), u in 0.02f32..0.96, v in 0.02f32..0.96,
        ) {
            let (u, v) = if u + v > 0.98 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let want = [1.0 - u - v, u, v];
            let point: Vec<f32> = (0..4).map(|i| blend(want, [a[i], b[i], c[i]])).collect();
            let (pa, pb, pc) = ([a[0] / a[3], a[1] / a[3]], [b[0] / b[3], b[1] / b[3]], [c[0] / c[3], c[1] / c[3]]);
            let area = (pb[0] - pa[0]) * (pc[1] - pa[1]) - (pb[1] - pa[1]) * (pc[0] - pa[0]);
            prop_assume!(area.abs() > 0.05);
            let got = weights_at([a, b, c], [point[0] / point[3], point[1] / point[3]]);
            for i in 0..3 {
                prop_assert!((got[i] - want[i]).abs() < 5e-3, "{got:?} for {want:?}");
            }
        }

        #[test]
        fn weights_around_a_point_are_those_at_each_place(
            a in corner(), b in corner(), c in corner(), x in -1f32..1.0, y in -1f32..1.0, right in 1e-4f32..0.01,
            down in -0.01f32..-1e-4,
        ) {
            let clip = [a, b, c];
            let places = [[x, y], [x + right, y], [x, y + down]];
            let area = |p: [f32; 4], q: [f32; 4]| cross([p[0] / p[3], p[1] / p[3]], [q[0] / q[3], q[1] / q[3]]);
            prop_assume!((area(a, b) + area(b, c) + area(c, a)).abs() > 0.05);
            let around = weights_around(clip, [x, y], [right, down]);
            for (got, place) in around.iter().zip(places) {
                let want = weights_at(clip, place);
                let size = want.iter().fold(1.0, |most: f32, w| most.max(w.abs()));
                // Where the weights' sum passes 0, far outside, both are anything.
                prop_assume!(size < 100.0);
                prop_assert!((0..3).all(|i| (got[i] - want[i]).abs() < 2e-3 * size), "{got:?} for {want:?}");
            }
        }

        #[test]
        fn turning_the_triangle_over_flips_its_facing(a in corner(), b in corner(), c in corner()) {
            let area = faces_eye([a, b, c]);
            prop_assume!(area || faces_eye([a, c, b]));
            prop_assert_ne!(area, faces_eye([a, c, b]));
        }
    }

    #[test]
    fn an_edge_on_triangle_gives_a_corner() {
        assert_eq!(
            weights_at([[0.0, 0.0, 0.0, 1.0]; 3], [0.0, 0.0]),
            [1.0, 0.0, 0.0]
        );
    }
}
