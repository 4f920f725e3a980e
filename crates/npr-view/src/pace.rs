//! How large drafts are, so that they follow the hand.

/// Seconds that a draft should take: twenty a second, with the frames of the window in between.
const WANTED_S: f32 = 1.0 / 30.0;

/// Smallest share of the sides of the picture.
const LEAST: f32 = 0.125;

/// The share of the picture's sides that drafts have, adapted to how long they take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pace {
    share: f32,
    /// Seconds that drafts take whatever their size.
    fixed_s: f32,
    /// The share of the area of the last draft, and its seconds.
    last: Option<[f32; 2]>,
}

impl Default for Pace {
    fn default() -> Self {
        Self {
            share: 0.5,
            fixed_s: 0.0,
            last: None,
        }
    }
}

impl Pace {
    /// The size of a draft of a picture.
    pub fn size(&self, full: [u32; 2]) -> [u32; 2] {
        full.map(|side| ((side as f32 * self.share).round() as u32).clamp(1, side.max(1)))
    }

    /// Learns from a draft that took `seconds`: some of it goes with the area, the rest is always there. Half of what
    /// is missing is made up at once. Where the rest alone takes too long, smaller drafts would be no faster, only
    /// coarser: the area may have half of the time then.
    pub fn learn(&mut self, seconds: f32) {
        // Part the time by two drafts of different sizes.
        let area = self.share * self.share;
        if let Some([area_before, seconds_before]) = self.last {
            let more = area - area_before;
            if more.abs() > 0.1 * area {
                let of_area = (seconds - seconds_before) / more * area;
                self.fixed_s = (seconds - of_area).clamp(0.0, 0.98 * seconds);
            }
        }
        self.last = Some([area, seconds]);

        // Give the area the time that is left.
        let room_s = (WANTED_S - self.fixed_s).max(0.5 * WANTED_S);
        let of_area_s = (seconds - self.fixed_s).max(1e-3);
        let wanted = (room_s / of_area_s).sqrt();
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
    #[test]
    fn drafts_that_are_slow_at_any_size_do_not_shrink_to_nothing() {
        let mut pace = Pace::default();
        for _ in 0..40 {
            let [width, height] = pace.size([1000, 1000]);
            pace.learn(0.2 + 0.1 * (width * height) as f32 / 1e6);
        }
        assert!(pace.size([1000, 1000])[0] > 300, "{pace:?}");
    }
}
