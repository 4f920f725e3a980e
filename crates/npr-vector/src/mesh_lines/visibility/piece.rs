//! A straight piece of line in space and in the picture.

use crate::mesh_lines::bvh::cut_range;
use crate::project::Projector;
use glam::DVec3;

/// Distance outside the frame up to which lines are followed, as a share of its larger side.
pub(crate) const MARGIN: f64 = 0.02;

/// A straight piece of line in space and in the picture, cut to the frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Ends in the world.
    pub world: [DVec3; 2],
    /// Ends in the picture, in pixels.
    pub place: [[f64; 2]; 2],
    /// Depths of the ends.
    pub depth: [f64; 2],
    /// The part of the uncut piece that is left, along it in the world.
    pub range: [f64; 2],
}

/// A piece in the picture alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PieceImage {
    /// Ends in the picture, in pixels.
    pub place: [[f64; 2]; 2],
    /// Depths of the ends.
    pub depth: [f64; 2],
}

impl Piece {
    /// The part of a line from `a` to `b` in front of the near plane and within the frame and a margin; `None` if
    /// nothing is left.
    pub fn new(projector: &Projector, size: [u32; 2], a: DVec3, b: DVec3) -> Option<Self> {
        // Cut off what lies before the near plane.
        let near = projector.near();
        let uncut = [projector.depth(a), projector.depth(b)];
        let mut range = [0.0, 1.0];
        if projector.is_perspective() && !cut_range(&mut range, uncut.map(|depth| depth - near)) {
            return None;
        }

        // Cut the image to the frame and its margin.
        let front = range.map(|t| a.lerp(b, t));
        let depth = front.map(|p| projector.depth(p));
        let place = front.map(|p| projector.project(p));
        let mut shown = [0.0, 1.0];
        let margin = MARGIN * f64::from(size[0].max(size[1]));
        for axis in 0..2 {
            let (low, high) = (-margin, f64::from(size[axis]) + margin);
            let [p, q] = place.map(|place| place[axis]);
            if !cut_range(&mut shown, [p - low, q - low])
                || !cut_range(&mut shown, [high - p, high - q])
            {
                return None;
            }
        }

        // Turn shares of the image back into shares of the line, unless it lies in the frame whole.
        let is_whole = range == [0.0, 1.0] && shown == [0.0, 1.0];
        let piece = if is_whole {
            Self {
                world: [a, b],
                place,
                depth,
                range,
            }
        } else {
            let [from, to] = range;
            let range = shown.map(|s| from + (to - from) * projector.world_share(s, depth));
            let world = range.map(|t| a.lerp(b, t));
            Self {
                world,
                place: world.map(|p| projector.project(p)),
                depth: world.map(|p| projector.depth(p)),
                range,
            }
        };
        piece
            .place
            .iter()
            .flatten()
            .all(|v| v.is_finite())
            .then_some(piece)
    }

    /// The piece in the picture.
    pub fn image(&self) -> PieceImage {
        let Self { place, depth, .. } = *self;
        PieceImage { place, depth }
    }

    /// Length in the picture, in pixels.
    pub fn length(&self) -> f64 {
        self.image().length()
    }

    /// Place in the picture at a share of the image.
    pub fn place_at(&self, share: f64) -> [f64; 2] {
        std::array::from_fn(|i| self.place[0][i] + (self.place[1][i] - self.place[0][i]) * share)
    }

    /// Point in the world at a share of the image.
    pub fn world_at(&self, projector: &Projector, share: f64) -> DVec3 {
        self.world[0].lerp(self.world[1], projector.world_share(share, self.depth))
    }
}

impl PieceImage {
    /// Length in pixels.
    pub fn length(&self) -> f64 {
        let [a, b] = self.place;
        ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt()
    }

    /// 1 / depth in perspective, depth in parallel view, at a share of the image: linear along it.
    pub(super) fn coordinate_at(&self, projector: &Projector, share: f64) -> f64 {
        let [a, b] = self.depth.map(|z| {
            if projector.is_perspective() {
                -1.0 / z
            } else {
                z
            }
        });
        a + (b - a) * share
    }
}
