//! The few 4 x 4 matrices a scene file needs, column-major as in glTF.

use crate::quaternion::{self, Quaternion};

/// A 4 x 4 matrix as four columns.
pub type Matrix = [[f32; 4]; 4];

/// The matrix that changes nothing.
pub const IDENTITY: Matrix = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

/// Half a turn about the y axis.
pub(crate) const HALF_TURN_Y: Matrix = [
    [-1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, -1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

/// Largest magnitude of a matrix element, so that products with positions stay finite.
const ELEMENT_LIMIT: f32 = 1e18;

/// The product `a * b`: `b` is applied first. Sums run in column order on every platform.
pub(crate) fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    b.map(|column| apply(a, column))
}

fn apply(m: &Matrix, [x, y, z, w]: [f32; 4]) -> [f32; 4] {
    let [mx, my, mz, mw] = m;
    std::array::from_fn(|row| mx[row] * x + my[row] * y + mz[row] * z + mw[row] * w)
}

/// The point `p` carried by `m`, whose last row is taken as 0 0 0 1.
pub(crate) fn transform_point(m: &Matrix, [x, y, z]: [f32; 3]) -> [f32; 3] {
    let [px, py, pz, _] = apply(m, [x, y, z, 1.0]);
    [px, py, pz]
}

/// The matrix that scales, then turns by the quaternion `x y z w`, then moves.
///
/// The quaternion is made unit length first; one of no or infinite length turns nothing.
pub(crate) fn from_parts(translation: [f32; 3], rotation: [f32; 4], scale: [f32; 3]) -> Matrix {
    // Turn the quaternion into three axes, each scaled.
    let [x, y, z, w] = quaternion::unit(rotation);
    let [sx, sy, sz] = scale;
    let [tx, ty, tz] = translation;
    let column = |v: [f32; 3], s: f32| [v[0] * s, v[1] * s, v[2] * s, 0.0];
    [
        column(
            [
                1.0 - 2.0 * (y * y + z * z),
                2.0 * (x * y + z * w),
                2.0 * (x * z - y * w),
            ],
            sx,
        ),
        column(
            [
                2.0 * (x * y - z * w),
                1.0 - 2.0 * (x * x + z * z),
                2.0 * (y * z + x * w),
            ],
            sy,
        ),
        column(
            [
                2.0 * (x * z + y * w),
                2.0 * (y * z - x * w),
                1.0 - 2.0 * (x * x + y * y),
            ],
            sz,
        ),
        [tx, ty, tz, 1.0],
    ]
}

/// The turn of a matrix whose axes stand upright on each other, whatever their lengths; a mirrored one counts as if its
/// x axis pointed the other way [Shepperd 1978].
pub(crate) fn turn_of(m: &Matrix) -> Quaternion {
    // Take the axes as unit vectors of a right-handed system.
    let axis = |column: usize| -> [f32; 3] {
        let [x, y, z, _] = m[column];
        let length = (x * x + y * y + z * z).sqrt();
        [x, y, z].map(|v| if length > 0.0 { v / length } else { 0.0 })
    };
    let [mut a, b, c] = [axis(0), axis(1), axis(2)];
    let along = a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    if along < 0.0 {
        a = a.map(|v| -v);
    }

    // Begin with the largest of the four numbers, so that none of the others is divided by a small one.
    let squares = [
        1.0 + a[0] - b[1] - c[2],
        1.0 - a[0] + b[1] - c[2],
        1.0 - a[0] - b[1] + c[2],
        1.0 + a[0] + b[1] + c[2],
    ];
    let largest = (0..4).fold(
        3,
        |best, i| if squares[i] > squares[best] { i } else { best },
    );
    let (s, [yz, zx, xy]) = (squares[largest], [b[2] - c[1], c[0] - a[2], a[1] - b[0]]);
    let [syz, szx, sxy] = [b[2] + c[1], c[0] + a[2], a[1] + b[0]];
    quaternion::unit(match largest {
        0 => [s, sxy, szx, yz],
        1 => [sxy, s, syz, zx],
        2 => [szx, syz, s, xy],
        _ => [yz, zx, xy, s],
    })
}

/// The matrix that undoes `m`, whose last row is taken as 0 0 0 1; none where it flattens space, or nearly. In double
/// precision, since motions carry places through it.
pub(crate) fn inverse(m: &Matrix) -> Option<[[f64; 3]; 4]> {
    let [a, b, c, d] = m.map(|[x, y, z, _]| [x, y, z].map(f64::from));
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    let volume = dot(a, rows[0]);
    if !volume.is_finite() || volume.abs() < 1e-30 {
        return None;
    }
    let rows = rows.map(|row| row.map(|v| v / volume));
    let column = |i: usize| [rows[0][i], rows[1][i], rows[2][i]];
    let back = rows.map(|row| -dot(row, d));
    Some([column(0), column(1), column(2), back])
}

/// Whether every element is finite and small enough for products to stay finite.
pub(crate) fn is_sound(m: &Matrix) -> bool {
    m.iter().flatten().all(|v| v.abs() <= ELEMENT_LIMIT)
}

/// Bound on the coordinates of `m * p` over those of `p`, where the latter count as at least 1.
pub(crate) fn gain(m: &Matrix) -> f32 {
    let row = |row: usize| m.iter().map(|column| column[row].abs()).sum::<f32>();
    row(0).max(row(1)).max(row(2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn turn() -> impl Strategy<Value = Quaternion> {
        prop::array::uniform4(-1f32..1.0).prop_map(quaternion::unit)
    }

    fn is_near(a: &Matrix, b: &Matrix) -> bool {
        let pairs = a.iter().flatten().zip(b.iter().flatten());
        pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-5)
    }

    proptest! {
        #[test]
        fn products_and_inverses_are_those_of_matrices(a in turn(), b in turn()) {
            let of = |q| from_parts([0.0; 3], q, [1.0; 3]);
            prop_assert!(is_near(&of(quaternion::multiply(a, b)), &multiply(&of(a), &of(b))));
            prop_assert!(is_near(&of(quaternion::multiply(a, quaternion::inverse(a))), &IDENTITY));
        }

        #[test]
        fn a_matrix_has_the_turn_that_it_was_made_of(q in turn(), scale in prop::array::uniform3(0.1f32..9.0)) {
            let found = turn_of(&from_parts([1.0, 2.0, 3.0], q, scale));
            let same = q.iter().zip(found).map(|(a, b)| a * b).sum::<f32>();
            prop_assert!(same.abs() > 0.999_99, "{q:?} and {found:?}");
            let mirrored = from_parts([0.0; 3], q, [-scale[0], scale[1], scale[2]]);
            let found = turn_of(&mirrored);
            let same = q.iter().zip(found).map(|(a, b)| a * b).sum::<f32>();
            prop_assert!(same.abs() > 0.999_99, "{q:?} and {found:?}");
        }
    }

    #[test]
    fn a_quarter_turn_about_y_carries_x_to_minus_z() {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let m = from_parts([1.0, 2.0, 3.0], [0.0, half, 0.0, half], [2.0; 3]);
        let p = transform_point(&m, [1.0, 0.0, 0.0]);
        assert!(
            (p[0] - 1.0).abs() < 1e-6 && p[1] == 2.0 && (p[2] - 1.0).abs() < 1e-6,
            "{p:?}"
        );
    }

    #[test]
    fn an_inverse_carries_points_back() {
        let m = from_parts([1.0, -2.0, 3.0], [0.1, 0.7, -0.3, 0.4], [2.0, 0.5, 3.0]);
        let [x, y, z] = transform_point(&m, [4.0, 5.0, -6.0]).map(f64::from);
        let [a, b, c, d] = inverse(&m).expect("a sound matrix");
        let back: [f64; 3] = std::array::from_fn(|i| a[i] * x + b[i] * y + c[i] * z + d[i]);
        let wanted = [4.0, 5.0, -6.0];
        assert!(
            back.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-4),
            "{back:?}"
        );
        assert_eq!(
            inverse(&from_parts([0.0; 3], [0.0; 4], [1.0, 0.0, 1.0])),
            None
        );
    }

    #[test]
    fn two_half_turns_are_none() {
        assert_eq!(multiply(&HALF_TURN_Y, &HALF_TURN_Y), IDENTITY);
    }

    #[test]
    fn the_right_factor_acts_first() {
        let moved = from_parts([1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], [1.0; 3]);
        let scaled = from_parts([0.0; 3], [0.0, 0.0, 0.0, 1.0], [3.0; 3]);
        assert_eq!(
            transform_point(&multiply(&moved, &scaled), [1.0, 1.0, 0.0]),
            [4.0, 3.0, 0.0]
        );
    }

    #[test]
    fn a_quaternion_without_length_turns_nothing() {
        assert_eq!(from_parts([0.0; 3], [0.0; 4], [1.0; 3]), IDENTITY);
        assert!(!is_sound(&from_parts([f32::NAN; 3], [0.0; 4], [1.0; 3])));
    }
}
