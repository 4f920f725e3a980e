//! Turns, as quaternions `x y z w`.

use crate::matrix::Matrix;

/// A turn; of unit length unless said otherwise.
pub(crate) type Quaternion = [f32; 4];

/// The turn that turns nothing.
pub(crate) const NO_TURN: Quaternion = [0.0, 0.0, 0.0, 1.0];

/// A quaternion made unit length; one of no or infinite length turns nothing.
pub(crate) fn unit(q: Quaternion) -> Quaternion {
    let length = q.iter().map(|v| v * v).sum::<f32>().sqrt();
    if length.is_finite() && length > 0.0 {
        q.map(|v| v / length)
    } else {
        NO_TURN
    }
}

/// The product `a b`: `b` turns first. Of any lengths, which are multiplied.
pub(crate) fn multiply(a: Quaternion, b: Quaternion) -> Quaternion {
    let ([ax, ay, az, aw], [bx, by, bz, bw]) = (a, b);
    [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
}

/// The turn back.
pub(crate) fn inverse([x, y, z, w]: Quaternion) -> Quaternion {
    [-x, -y, -z, w]
}

/// The turn of a matrix whose axes stand upright on each other, whatever their lengths; a mirrored one counts as if its
/// x axis pointed the other way [Shepperd 1978].
pub(crate) fn of_matrix(m: &Matrix) -> Quaternion {
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
    unit(match largest {
        0 => [s, sxy, szx, yz],
        1 => [sxy, s, syz, zx],
        2 => [szx, syz, s, xy],
        _ => [yz, zx, xy, s],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::{self, from_parts};
    use proptest::prelude::*;

    fn turn() -> impl Strategy<Value = Quaternion> {
        prop::array::uniform4(-1f32..1.0).prop_map(unit)
    }

    fn is_near(a: &Matrix, b: &Matrix) -> bool {
        let pairs = a.iter().flatten().zip(b.iter().flatten());
        pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-5)
    }

    proptest! {
        #[test]
        fn products_and_inverses_are_those_of_matrices(a in turn(), b in turn()) {
            let of = |q| from_parts([0.0; 3], q, [1.0; 3]);
            prop_assert!(is_near(&of(multiply(a, b)), &matrix::multiply(&of(a), &of(b))));
            prop_assert!(is_near(&of(multiply(a, inverse(a))), &matrix::IDENTITY));
        }

        #[test]
        fn a_matrix_has_the_turn_that_it_was_made_of(q in turn(), scale in prop::array::uniform3(0.1f32..9.0)) {
            let found = of_matrix(&from_parts([1.0, 2.0, 3.0], q, scale));
            let same = q.iter().zip(found).map(|(a, b)| a * b).sum::<f32>();
            prop_assert!(same.abs() > 0.999_99, "{q:?} and {found:?}");
            let mirrored = from_parts([0.0; 3], q, [-scale[0], scale[1], scale[2]]);
            let found = of_matrix(&mirrored);
            let same = q.iter().zip(found).map(|(a, b)| a * b).sum::<f32>();
            prop_assert!(same.abs() > 0.999_99, "{q:?} and {found:?}");
        }
    }
}
