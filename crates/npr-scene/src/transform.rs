//! Where a node stands beside its parent, in the three parts that clips replace.

use crate::matrix::{self, Matrix};

/// A place beside a parent: scaled, then turned, then moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// The move, in units of the parent.
    pub translation: [f32; 3],
    /// The turn, as a quaternion `x y z w`; its length means nothing, and one without length turns nothing.
    pub rotation: [f32; 4],
    /// The factor along each axis.
    pub scale: [f32; 3],
}

impl Default for Transform {
    fn default() -> Self {
        Self {
            translation: [0.0; 3],
            rotation: [0.0, 0.0, 0.0, 1.0],
            scale: [1.0; 3],
        }
    }
}

impl Transform {
    /// Parent space from node space, column-major.
    pub fn matrix(&self) -> Matrix {
        matrix::from_parts(self.translation, self.rotation, self.scale)
    }

    /// The same place seen after half a turn of its parent about the y axis.
    pub(crate) fn half_turned_y(self) -> Self {
        Self {
            translation: half_turned_move(self.translation),
            rotation: half_turned_rotation(self.rotation),
            scale: self.scale,
        }
    }
}

/// A move after half a turn about the y axis.
pub(crate) fn half_turned_move([x, y, z]: [f32; 3]) -> [f32; 3] {
    [-x, y, -z]
}

/// A quaternion, or a tangent of one, with half a turn about the y axis after it.
pub(crate) fn half_turned_rotation([x, y, z, w]: [f32; 4]) -> [f32; 4] {
    [z, w, -x, -y]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::HALF_TURN_Y;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn half_a_turn_is_that_of_the_matrix(
            translation in prop::array::uniform3(-9f32..9.0), rotation in prop::array::uniform4(-1f32..1.0),
            scale in prop::array::uniform3(0.1f32..9.0),
        ) {
            prop_assume!(rotation.iter().map(|v| v * v).sum::<f32>() > 0.01);
            let place = Transform { translation, rotation, scale };
            let wanted = matrix::multiply(&HALF_TURN_Y, &place.matrix());
            let turned = place.half_turned_y().matrix();
            for (a, b) in turned.iter().flatten().zip(wanted.iter().flatten()) {
                prop_assert!((a - b).abs() < 1e-4, "{turned:?} and {wanted:?}");
            }
        }
    }
}
