//! Turns, as quaternions `x y z w`.

use npr_core::math;

/// A turn; of unit length unless said otherwise.
pub(crate) type Quaternion = [f32; 4];

/// The turn that turns nothing.
pub(crate) const NO_TURN: Quaternion = [0.0, 0.0, 0.0, 1.0];

/// Cosine of the angle between two turns from which the way between them is as good as straight.
const STRAIGHT_COS: f32 = 0.9995;

/// One more than the cosine of the angle between two directions up to which they are opposite.
const OPPOSITE: f32 = 1e-6;

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

/// The turn that lies at a share, 0 to 1, of the shorter arc between two turns of any lengths [Shoemake 1985].
pub(crate) fn on_arc(from: Quaternion, to: Quaternion, share: f32) -> Quaternion {
    let [a, b] = shares_on_arc(&from, &to, share);
    unit(std::array::from_fn(|i| from[i] * a + to[i] * b))
}

/// What of two turns makes the one that lies at a share of the shorter arc between them [Shoemake 1985].
///
/// Turns that nearly agree are blended in a straight line, which differs from the arc by less than 1e-8 there.
pub(crate) fn shares_on_arc(from: &[f32], to: &[f32], share: f32) -> [f32; 2] {
    // Take both as if they were of unit length.
    let lengths = [from, to].map(|q| q.iter().map(|v| v * v).sum::<f32>().sqrt());
    let [one, other] = lengths.map(|length| if length > 0.0 { 1.0 / length } else { 0.0 });
    let cos = from.iter().zip(to).map(|(a, b)| a * b).sum::<f32>() * one * other;

    // Turn the second one over where that is nearer.
    let (cos, other) = if cos < 0.0 {
        (-cos, -other)
    } else {
        (cos, other)
    };
    if cos > STRAIGHT_COS {
        return [(1.0 - share) * one, share * other];
    }
    let angle = math::acos(cos);
    let sin = math::sin(angle);
    let [a, b] = [1.0 - share, share].map(|part| math::sin(part * angle) / sin);
    [a * one, b * other]
}

/// A vector after a turn.
pub(crate) fn turned(q: Quaternion, [x, y, z]: [f32; 3]) -> [f32; 3] {
    let [x, y, z, _] = multiply(multiply(q, [x, y, z, 0.0]), inverse(q));
    [x, y, z]
}

/// The smallest turn that brings the direction of one vector to that of another; half a turn about some axis across
/// where they are opposite, and none where one of them has no length.
pub(crate) fn between(from: [f32; 3], to: [f32; 3]) -> Quaternion {
    let length = |v: [f32; 3]| v.iter().map(|v| v * v).sum::<f32>().sqrt();
    let lengths = [length(from), length(to)];
    if lengths.iter().any(|v| !v.is_finite() || *v <= 0.0) {
        return NO_TURN;
    }
    let [ax, ay, az] = from.map(|v| v / lengths[0]);
    let [bx, by, bz] = to.map(|v| v / lengths[1]);
    let more = 1.0 + ax * bx + ay * by + az * bz;
    if more > OPPOSITE {
        let cross = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        return unit([cross[0], cross[1], cross[2], more]);
    }
    match ax.abs() > az.abs() {
        true => unit([-ay, ax, 0.0, 0.0]),
        false => unit([0.0, -az, ay, 0.0]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn apart(a: [f32; 3], b: [f32; 3]) -> f32 {
        a.iter()
            .zip(b)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f32::max)
    }

    proptest! {
        #[test]
        fn the_turn_between_directions_brings_one_to_the_other(
            from in prop::array::uniform3(-1f32..1.0), to in prop::array::uniform3(-1f32..1.0), factor in 0.1f32..9.0,
        ) {
            let length = |v: [f32; 3]| v.iter().map(|v| v * v).sum::<f32>().sqrt();
            prop_assume!(length(from) > 0.1 && length(to) > 0.1);
            let wanted = to.map(|v| v / length(to) * length(from));
            let q = between(from.map(|v| v * factor), to);
            prop_assert!(apart(turned(q, from), wanted) < 1e-4);
            let back = between(from, from.map(|v| -v * factor));
            prop_assert!(apart(turned(back, from), from.map(|v| -v)) < 1e-4);
            prop_assert!(apart(turned(between(from, from), from), from) < 1e-6);
        }

        #[test]
        fn arcs_begin_and_end_at_their_turns(
            from in prop::array::uniform4(-1f32..1.0).prop_map(unit),
            to in prop::array::uniform4(-1f32..1.0).prop_map(unit),
        ) {
            let same = |a: Quaternion, b: Quaternion| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>().abs();
            prop_assert!(same(on_arc(from, to, 0.0), from) > 0.999_99);
            prop_assert!(same(on_arc(from, to, 1.0), to) > 0.999_99);
            let half = on_arc(from, to, 0.5);
            prop_assert!((same(half, from) - same(half, to)).abs() < 1e-4);
        }
    }

    #[test]
    fn what_has_no_direction_turns_nothing() {
        assert_eq!(between([0.0; 3], [1.0, 0.0, 0.0]), NO_TURN);
        assert_eq!(between([1.0, 0.0, 0.0], [f32::NAN; 3]), NO_TURN);
        assert_eq!(between([f32::MAX; 3], [1.0, 0.0, 0.0]), NO_TURN);
    }
}
