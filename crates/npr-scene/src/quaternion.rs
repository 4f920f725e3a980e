//! Turns, as quaternions `x y z w`.

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
