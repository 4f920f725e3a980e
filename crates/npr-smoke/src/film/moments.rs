//! Which moments of a film are followed, and which of them are drawn.

/// Moments in frames, in equal steps of a frame at most: so smoke is followed alike, however many of them are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    start: f64,
    /// Frames from one moment to the next.
    pub step: f64,
    /// One moment in so many is drawn.
    every: usize,
    /// How many come before the first that is drawn, so that smoke is followed from its beginning.
    unseen: usize,
    /// How many are drawn.
    pub seen: usize,
}

impl Moments {
    /// From frame `first` to `last` and no further, drawn every `step` frames; `begin` is the frame that smoke may be
    /// followed from.
    pub fn new(first: u32, last: u32, step: f64, begin: u32) -> Self {
        // Room for steps such as a tenth, which no float is.
        let steps = |frames: u32, step: f64| (f64::from(frames) / step + 1e-9).floor();
        let every = step.ceil().max(1.0);
        let fine = step / every;
        let unseen = steps(first.saturating_sub(begin), fine);
        Self {
            start: f64::from(first) - unseen * fine,
            step: fine,
            every: every as usize,
            unseen: unseen as usize,
            seen: (steps(last.saturating_sub(first), step) as usize).saturating_add(1),
        }
    }

    /// How many moments there are, drawn or not.
    pub fn count(&self) -> usize {
        let after = (self.seen - 1).saturating_mul(self.every);
        self.unseen.saturating_add(after).saturating_add(1)
    }

    /// A moment by its number, in frames.
    pub fn at(&self, number: usize) -> f64 {
        self.start + number as f64 * self.step
    }

    /// Whether a moment is drawn.
    pub fn is_seen(&self, number: usize) -> bool {
        number >= self.unseen && (number - self.unseen).is_multiple_of(self.every)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(moments: Moments) -> Vec<f64> {
        let numbers = (0..moments.count()).filter(|number| moments.is_seen(*number));
        let seen: Vec<f64> = numbers.map(|number| moments.at(number)).collect();
        assert_eq!(seen.len(), moments.seen);
        seen
    }

    #[test]
    fn drawn_moments_end_with_the_last_frame() {
        assert_eq!(seen(Moments::new(3, 5, 1.0, 1)), [3.0, 4.0, 5.0]);
        assert_eq!(seen(Moments::new(3, 4, 0.5, 1)), [3.0, 3.5, 4.0]);
        assert_eq!(seen(Moments::new(3, 8, 2.0, 1)), [3.0, 5.0, 7.0]);
        assert_eq!(seen(Moments::new(1, 4, 1.5, 1)), [1.0, 2.5, 4.0]);
        assert_eq!(seen(Moments::new(7, 7, 9.0, 1)), [7.0]);
        assert_eq!(Moments::new(1, 96, 0.1, 1).seen, 951);
    }

    #[test]
    fn smoke_is_followed_from_its_beginning_in_steps_of_a_frame_at_most() {
        assert_eq!(Moments::new(3, 4, 0.5, 1).at(0), 1.0);
        assert_eq!(Moments::new(4, 9, 5.0, 1).at(0), 1.0);
        assert_eq!(Moments::new(4, 9, 5.0, 1).step, 1.0);
        assert_eq!(Moments::new(0, 9, 1.0, 1).at(0), 0.0);
    }
}
