//! Clips: movements of nodes over time, and what they give at a moment.
//!
//! A [`Clip`] is a glTF animation: channels, each of which replaces one [`Property`] of one node by a curve through
//! keys [glTF 2.0, section 3.11 and appendix C]. Before its first key and after its last a curve stands still.

use crate::quaternion::shares_on_arc;
use crate::transform::Transform;
use std::sync::Arc;

/// A movement of the nodes of a scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Clip {
    /// Name as in the file; empty where it has none.
    pub name: String,
    /// What moves; no two channels have both node and property in common.
    pub channels: Vec<Channel>,
}

/// One property of one node over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// The node that moves; of [`Property::Share`] the expression of the scene's figure.
    pub node: u32,
    /// What of it moves.
    pub property: Property,
    /// How the curve runs between its keys.
    pub interpolation: Interpolation,
    /// Times of the keys in seconds: at least one, none negative, each later than the one before.
    pub times: Arc<[f32]>,
    /// The values of each key, as many as [`Self::width`] says; of a cubic spline the tangent before it, its value and
    /// the tangent behind it, in units per second.
    pub values: Arc<[f32]>,
}

/// What a channel replaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Property {
    /// The move beside the parent: three numbers.
    Translation,
    /// The turn, a quaternion `x y z w`.
    Rotation,
    /// The factor along each axis: three numbers.
    Scale,
    /// The weights of the mesh's morphs, one each.
    Weights,
    /// The share of an expression, one number.
    Share,
}

/// How a curve runs from key to key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// A value holds until the next key.
    Step,
    /// Straight; rotations turn at an even speed along the shorter arc.
    Linear,
    /// A cubic Hermite spline through the keys with their tangents.
    CubicSpline,
}

impl Interpolation {
    /// How many values a key has.
    pub fn knots(self) -> usize {
        match self {
            Self::Step | Self::Linear => 1,
            Self::CubicSpline => 3,
        }
    }
}

impl Clip {
    /// When its last key is, in seconds; 0 without any.
    pub fn duration_s(&self) -> f32 {
        let ends = self
            .channels
            .iter()
            .filter_map(|channel| channel.times.last());
        ends.fold(0.0, |latest, end| end.max(latest))
    }
}

impl Channel {
    /// How many numbers a value has.
    pub fn width(&self) -> usize {
        let per_number = self.times.len() * self.interpolation.knots();
        self.values.len().checked_div(per_number).unwrap_or(0)
    }

    /// The value at a time in seconds; a rotation is of unit length. O(log keys).
    ///
    /// Before the first key it is that key's, and after the last one that one's; a time that is no number counts as
    /// before the first.
    pub fn value_at(&self, time_s: f32) -> Vec<f32> {
        // Find the keys around the time.
        let after = self.times.partition_point(|time| *time <= time_s);
        let before = after.saturating_sub(1);
        let is_between = after > 0 && after < self.times.len();
        let mut value = match self.interpolation {
            _ if !is_between => self.key(before).to_vec(),
            Interpolation::Step => self.key(before).to_vec(),
            Interpolation::Linear => {
                let (share, _) = self.share_and_span(before, time_s);
                self.straight(self.key(before), self.key(after), share)
            }
            Interpolation::CubicSpline => {
                let (share, span_s) = self.share_and_span(before, time_s);
                self.spline(before, share, span_s)
            }
        };

        // Make a rotation unit length.
        if self.property == Property::Rotation {
            make_unit(&mut value);
        }
        value
    }

    /// Puts the value at a time into the property of a transform; weights and shares have none.
    pub(crate) fn apply(&self, time_s: f32, transform: &mut Transform) {
        let value = self.value_at(time_s);
        match self.property {
            Property::Translation => put(&mut transform.translation, &value),
            Property::Rotation => put(&mut transform.rotation, &value),
            Property::Scale => put(&mut transform.scale, &value),
            Property::Weights | Property::Share => {}
        }
    }

    /// The value of a key.
    fn key(&self, key: usize) -> &[f32] {
        self.knot(key, self.interpolation.knots() / 2)
    }

    /// One of the values of a key: of a cubic spline the tangent before it, its value, or the tangent behind it.
    fn knot(&self, key: usize, knot: usize) -> &[f32] {
        let width = self.width();
        let start = (key * self.interpolation.knots() + knot) * width;
        self.values.get(start..start + width).unwrap_or_default()
    }

    /// How far a time lies from a key to the next, 0 to 1, and how long that way is in seconds.
    fn share_and_span(&self, key: usize, time_s: f32) -> (f32, f32) {
        let [from, to] = [self.times[key], self.times[key + 1]].map(f64::from);
        let span = to - from;
        (((f64::from(time_s) - from) / span) as f32, span as f32)
    }

    fn straight(&self, from: &[f32], to: &[f32], share: f32) -> Vec<f32> {
        let [a, b] = match self.property {
            Property::Rotation => shares_on_arc(from, to, share),
            _ => [1.0 - share, share],
        };
        from.iter()
            .zip(to)
            .map(|(from, to)| from * a + to * b)
            .collect()
    }

    /// The Hermite spline from a key to the next [glTF 2.0, appendix C].
    fn spline(&self, key: usize, t: f32, span_s: f32) -> Vec<f32> {
        let (t2, t3) = (t * t, t * t * t);
        let shares = [
            2.0 * t3 - 3.0 * t2 + 1.0,
            span_s * (t3 - 2.0 * t2 + t),
            3.0 * t2 - 2.0 * t3,
            span_s * (t3 - t2),
        ];
        let knots = [
            self.knot(key, 1),
            self.knot(key, 2),
            self.knot(key + 1, 1),
            self.knot(key + 1, 0),
        ];
        let sum = |number| (0..4).map(|i| shares[i] * knots[i][number]).sum();
        (0..self.width()).map(sum).collect()
    }

    /// Asserts what the type promises.
    ///
    /// # Panics
    ///
    /// When times do not ascend from 0 or later, or the values are not as many as the keys need, or not finite.
    pub fn sanity_check(&self) {
        assert!(
            self.times.first().is_some_and(|first| *first >= 0.0),
            "a first key"
        );
        assert!(self.times.is_sorted_by(|a, b| a < b), "times ascend");
        assert!(
            self.times
                .iter()
                .chain(self.values.iter())
                .all(|v| v.is_finite()),
            "finite keys"
        );
        let wanted = self.times.len() * self.interpolation.knots() * self.width();
        assert_eq!(self.values.len(), wanted, "values for each key");
        match self.property {
            Property::Translation | Property::Scale => assert_eq!(self.width(), 3),
            Property::Rotation => assert_eq!(self.width(), 4),
            Property::Weights => assert!(self.width() > 0, "weights"),
            Property::Share => assert_eq!(self.width(), 1),
        }
    }
}

fn put<const N: usize>(numbers: &mut [f32; N], value: &[f32]) {
    if let Ok(value) = <[f32; N]>::try_from(value) {
        *numbers = value;
    }
}

/// Makes a vector unit length; one without length, or of infinite length, becomes the turn that turns nothing.
fn make_unit(value: &mut [f32]) {
    let length = value.iter().map(|v| v * v).sum::<f32>().sqrt();
    if length.is_finite() && length > 0.0 {
        value.iter_mut().for_each(|v| *v /= length);
    } else {
        value.fill(0.0);
        value.last_mut().into_iter().for_each(|w| *w = 1.0);
    }
}

#[cfg(test)]
mod tests;
