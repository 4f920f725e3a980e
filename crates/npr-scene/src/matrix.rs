//! The few 4 x 4 matrices a scene file needs, column-major as in glTF.

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
    let [x, y, z, w] = unit_quaternion(rotation);
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

fn unit_quaternion(q: [f32; 4]) -> [f32; 4] {
    let length = q.iter().map(|v| v * v).sum::<f32>().sqrt();
    if length.is_finite() && length > 0.0 {
        q.map(|v| v / length)
    } else {
        [0.0, 0.0, 0.0, 1.0]
    }
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
