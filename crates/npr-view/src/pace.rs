//! How large drafts are, so that they follow the hand.

/// Seconds that a draft should take: fifteen a second.
const WANTED_S: f32 = 1.0 / 15.0;

/// Smallest share of the sides of the picture.
const LEAST: f32 = 0.125;

/// The share of the picture's sides that drafts have, adapted to how long they take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pace {
    share: f32,
}

impl Default for Pace {
    fn default() -> Self {
        Self { share: 0.5 }
    }
}

impl Pace {
    /// The size of a draft of a picture.
    pub fn size(&self, full: [u32; 2]) -> [u32; 2] {
        full.map(|side| ((side as f32 * self.share).round() as u32).clamp(1, side.max(1)))
    }

    /// Learns from a draft that took `seconds`. Time goes with the area; half of what is missing is made up at once.
    pub fn learn(&mut self, seconds: f32) {
        let wanted = (WANTED_S / seconds.max(1e-3)).sqrt();
        let is_well = (0.85..1.3).contains(&wanted);
        if !is_well {
            self.share = (self.share * wanted.sqrt()).clamp(LEAST, 1.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drafts_shrink_until_they_are_fast_enough_and_grow_back() {
        let after = |seconds_full: f32| {
            let mut pace = Pace::default();
            for _ in 0..40 {
                let [width, height] = pace.size([1000, 1000]);
                pace.learn(seconds_full * (width * height) as f32 / 1e6);
            }
            pace.size([1000, 1000])[0]
        };
        assert_eq!(after(0.01), 1000);
        assert!((350..700).contains(&after(0.25)), "{}", after(0.25));
        assert_eq!(after(1000.0), 125);
        assert_eq!(Pace::default().size([1, 1]), [1, 1]);
        assert_eq!(Pace::default().size([0, 0]), [1, 1]);
    }
}
