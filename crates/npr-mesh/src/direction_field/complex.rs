//! Complex numbers, as far as smooth fields need them.

/// A complex number; of length 1 it is an angle.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Complex {
    pub(crate) re: f32,
    pub(crate) im: f32,
}

impl Complex {
    pub(crate) const ONE: Self = Self { re: 1.0, im: 0.0 };

    /// The unit number that stands for a number of full turns.
    pub(crate) fn of_turns(turns: f32) -> Self {
        let angle = std::f32::consts::TAU * (turns - turns.round());
        Self {
            re: npr_core::math::cos(angle),
            im: npr_core::math::sin(angle),
        }
    }

    /// Its angle in full turns, -0.5..=0.5.
    pub(crate) fn turns(self) -> f32 {
        npr_core::math::atan2(self.im, self.re) / std::f32::consts::TAU
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        Self {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }

    pub(crate) fn times(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }

    pub(crate) fn scaled(self, factor: f32) -> Self {
        Self {
            re: self.re * factor,
            im: self.im * factor,
        }
    }

    pub(crate) fn conjugate_if(self, flips: bool) -> Self {
        Self {
            re: self.re,
            im: if flips { -self.im } else { self.im },
        }
    }

    pub(crate) fn length(self) -> f32 {
        (self.re * self.re + self.im * self.im).sqrt()
    }

    /// The number of length 1 at the same angle; none where it is too short to have one.
    pub(crate) fn unit(self) -> Option<Self> {
        let length = self.length();
        (length > 1e-12 && length.is_finite()).then(|| self.scaled(1.0 / length))
    }

    /// The unit number at half the angle of this unit number, with a real part that is not negative.
    pub(crate) fn half_angle(self) -> Self {
        // Of both roots, the longer one does not cancel; the other follows from it.
        let long = ((1.0 + self.re.abs()).max(0.0) / 2.0).sqrt();
        let short = self.im.abs() / (2.0 * long);
        let [re, im] = if self.re < 0.0 {
            [short, long]
        } else {
            [long, short]
        };
        Self {
            re,
            im: if self.im < 0.0 { -im } else { im },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn turns_come_back(turns in -40.0f32..40.0) {
            let error = Complex::of_turns(turns).turns() - turns;
            prop_assert!((error - error.round()).abs() < 1e-5);
        }

        #[test]
        fn half_an_angle_twice_is_the_angle(turns in -0.5f32..0.5) {
            let whole = Complex::of_turns(turns);
            let half = whole.half_angle();
            let twice = half.times(half);
            prop_assert!((twice.re - whole.re).abs() < 1e-6 && (twice.im - whole.im).abs() < 1e-6);
        }
    }

    #[test]
    fn nothing_has_no_angle() {
        assert_eq!(Complex::default().unit(), None);
        assert_eq!(
            Complex {
                re: f32::NAN,
                im: 0.0
            }
            .unit(),
            None
        );
    }
}
