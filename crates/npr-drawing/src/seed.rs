//! Chance that is the same in every run: numbers made from the id of a stroke.

use npr_core::math::mix_bits;

/// What the chance of one copy of a stroke is drawn from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Seed(u32);

impl Seed {
    /// That of copy number `copy` of the stroke `id`.
    pub fn new(id: u64, copy: u32) -> Self {
        let [low, high] = [id as u32, (id >> 32) as u32];
        Self(mix_bits(low ^ mix_bits(high ^ mix_bits(copy))))
    }

    /// Chance number `number`, 0..1 without 1; numbers have nothing to do with each other.
    pub fn share(self, number: u32) -> f64 {
        f64::from(mix_bits(self.0 ^ mix_bits(number))) / 4_294_967_296.0
    }

    /// Chance number `number` between two values.
    pub fn between(self, number: u32, from: f64, to: f64) -> f64 {
        from + (to - from) * self.share(number)
    }

    /// A vector of length 1, of which every direction is as likely.
    pub fn direction(self, number: u32) -> [f64; 2] {
        let angle = self.between(number, 0.0, 2.0 * std::f64::consts::PI);
        [
            npr_core::math::cos_f64(angle),
            npr_core::math::sin_f64(angle),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of many strokes the shares fill 0..1 evenly, whichever number, copy or half of the id tells them apart.
    #[test]
    fn chance_is_even_and_of_all_that_it_is_made_of() {
        let of: [fn(u32) -> f64; 4] = [
            |i| Seed::new(i.into(), 0).share(0),
            |i| Seed::new(u64::from(i) << 32, 0).share(0),
            |i| Seed::new(7, i).share(0),
            |i| Seed::new(7, 0).share(i),
        ];
        for share in of {
            let mut tenths = [0; 10];
            (0..10_000).for_each(|i| tenths[(share(i) * 10.0) as usize] += 1);
            // A count strays from 1000 by 30, once in three.
            assert!(
                tenths.iter().all(|count| (850..1150).contains(count)),
                "{tenths:?}"
            );
        }
    }
}
