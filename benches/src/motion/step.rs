//! What a frame's places become in the next one.

use glam::DVec3;

use super::skin::Skin;
use crate::lines::viewpoint::Viewpoint;

/// The way from a frame to the next: the camera, and the surface where it bends.
#[derive(Debug, Clone, Copy)]
pub struct Step<'a> {
    /// The camera of the frame before.
    pub from: Viewpoint,
    /// The camera of the frame after.
    pub to: Viewpoint,
    /// Both poses of the surface; none where it stands still.
    pub skin: Option<&'a Skin>,
}

impl Step<'_> {
    /// Where a point of the surface goes in the world.
    pub fn carried(&self, world: DVec3) -> DVec3 {
        match self.skin {
            Some(skin) => skin.carried(world),
            None => world,
        }
    }

    /// Where a place of the frame before shows in the next, and its point in the world.
    ///
    /// A stroke may be drawn beside its line, smoothed as it is, so a place moves by as much as its point does: where
    /// nothing moves all of it stays, to the bit.
    pub fn moved(&self, place: [f64; 2], world: DVec3) -> ([f64; 2], DVec3) {
        let carried = self.carried(world);
        if carried == world && self.from == self.to {
            return (place, world);
        }
        let (before, after) = (self.from.project(world), self.to.project(carried));
        ([0, 1].map(|i| place[i] + after[i] - before[i]), carried)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::testing::sheet_moved;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn places_go_with_the_picture(
            right in -30.0..30.0f64, x in 0.0..600.0f64, y in 0.0..400.0f64, off in -3.0..3.0f64,
        ) {
            let right = f64::from(right as f32);
            let step = Step { from: sheet_moved(0.0), to: sheet_moved(right), skin: None };
            let world = DVec3::new(x - 320.0, 240.0 - y, 0.0);
            let ([there, row], _): ([f64; 2], DVec3) = step.moved([x + off, y], world);
            prop_assert!((there - x - off - right).abs() < 1e-4 && (row - y).abs() < 1e-4);
        }
    }
}
