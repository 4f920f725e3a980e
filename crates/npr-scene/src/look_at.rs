//! How figures look somewhere [VRM 1.0, lookAt].

/// How a figure looks somewhere.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LookAt {
    /// What moves.
    pub eyes: Eyes,
    /// The point that it looks from, in the space of the bone of its head.
    pub offset: [f32; 3],
    /// How far an eye turns towards the nose.
    pub inner: RangeMap,
    /// How far an eye turns away from the nose, and what expressions do to either side.
    pub outer: RangeMap,
    /// How far it looks down.
    pub down: RangeMap,
    /// How far it looks up.
    pub up: RangeMap,
}

/// What moves where a figure looks somewhere.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Eyes {
    /// The bones `leftEye` and `rightEye`; ranges give degrees.
    #[default]
    Bones,
    /// The expressions `lookUp`, `lookDown`, `lookLeft` and `lookRight`; ranges give shares.
    Expressions,
}

/// What an angle of the look becomes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RangeMap {
    /// The angle from which it does not grow any more, in degrees, above 0.
    pub most_deg: f32,
    /// What it is there: degrees or a share.
    pub output: f32,
    /// How it grows up to there, both from 0 to 1, where it does not grow evenly: keys in rising order, each its time,
    /// its value, and the slopes before and behind it [Unity, AnimationCurve].
    pub curve: Vec<[f32; 4]>,
}

impl RangeMap {
    /// What becomes of an angle of no sign, in degrees; 0 of none.
    ///
    /// Differs: VRM 0.x does not take away where its curve begins, so a look just left of straight ahead could lie far
    /// from one just right of it.
    pub fn at(&self, angle_deg: f32) -> f32 {
        let share = angle_deg.min(self.most_deg) / self.most_deg;
        (self.grown(share) - self.grown(0.0)) * self.output
    }

    /// The curve at a time: a cubic Hermite spline between keys, constant beyond them.
    fn grown(&self, time: f32) -> f32 {
        let after = self.curve.partition_point(|key| key[0] <= time);
        let (before, after) = match (after.checked_sub(1), self.curve.get(after)) {
            (None, None) => return time,
            (None, Some(first)) => return first[1],
            (Some(before), None) => return self.curve[before][1],
            (Some(before), Some(after)) => (self.curve[before], after),
        };
        let span = after[0] - before[0];
        let t = (time - before[0]) / span;
        let (t2, t3) = (t * t, t * t * t);
        (2.0 * t3 - 3.0 * t2 + 1.0) * before[1]
            + (t3 - 2.0 * t2 + t) * span * before[3]
            + (3.0 * t2 - 2.0 * t3) * after[1]
            + (t3 - t2) * span * after[2]
    }
}
