//! What the passes of a frame must be able to do.

/// A set of abilities: a shader is linked for those that a frame needs, and for nothing else.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Features(u32);

macro_rules! features {
    ($($(#[$doc:meta])* $name:ident = $bit:literal;)+) => {
        impl Features {
            $($(#[$doc])* pub const $name: Self = Self(1 << $bit);)+

            /// Every single feature with its name.
            pub const NAMED: &[(&str, Self)] = &[$((stringify!($name), Self::$name)),+];

            /// All features: what a shader linked for them draws is right for every frame.
            pub const ALL: Self = Self($(Self::$name.0)|+);
        }
    };
}

features! {
    /// Parts have holes.
    CUTOUTS = 0;
    /// Surfaces, lines or the background show pictures.
    TEXTURES = 1;
    /// Ramps are rows of tones.
    TONE_ROWS = 2;
    /// Tones depend on more than the direction of one light as strong as 1.
    LIGHTS = 3;
    /// Lights throw shadows.
    SHADOWS = 4;
    /// Surfaces hide a part of the sky.
    SKY = 5;
    /// Surfaces are inked or hatched.
    INK = 6;
    /// Paint lies under the ink.
    PAINT = 7;
    /// Surfaces have highlights.
    GLOSS = 8;
    /// Hulls show as outlines.
    HULLS = 9;
    /// Surfaces seen at a grazing angle are dark.
    ANGLES = 10;
    /// Ribbons lie over the surfaces.
    RIBBONS = 11;
    /// Stamps, or the mask itself, lie over the surfaces.
    OVERLAY = 12;
    /// Beams lie over the surfaces.
    BEAMS = 13;
    /// Lines follow what lies behind them.
    BACKDROP = 14;
    /// Smoke lies over the surfaces.
    SMOKE = 15;
    /// Smoke is inked after it was drawn.
    SMOKE_PEN = 16;
    /// Smoke throws shadows on surfaces.
    SMOKE_SHADOWS = 17;
    /// The colour of lines depends on their place.
    TINTS = 18;
    /// Strokes cross in two layers.
    SECOND_LAYER = 19;
    /// Highlights have a shape of their own.
    SHAPED_GLOSS = 20;
    /// Light falls on rims from behind.
    BACK_LIGHT = 21;
    /// Streaks lie over surfaces.
    STREAKS = 22;
    /// Colours of surfaces differ from point to point.
    COLORS = 23;
    /// Strokes are drawn with brushes that leave ink out.
    BRUSHES = 24;
    /// Hatching shows the grain of the paper.
    GRAIN = 25;
    /// Surfaces are lit as toon materials say.
    TOON = 26;
    /// Tones are evened where they would be slivers.
    EVEN_TONES = 27;
}

impl Features {
    /// No feature.
    pub const NONE: Self = Self(0);

    /// What is in one set or in the other.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What is in both sets.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// What is in this set and not in the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// This set where `is_needed`, else none.
    #[must_use]
    pub const fn when(self, is_needed: bool) -> Self {
        if is_needed { self } else { Self::NONE }
    }

    /// Whether what serves these features is needed for others: it serves one of them, or every frame.
    pub const fn serve(self, features: Self) -> bool {
        self.0 == 0 || self.meets(features)
    }

    /// Whether the sets share a feature.
    pub const fn meets(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_have_a_bit_each() {
        let mut all = Features::NONE;
        for (name, feature) in Features::NAMED {
            assert_eq!(feature.0.count_ones(), 1, "{name}");
            assert!(!all.meets(*feature), "{name} shares its bit");
            all = all.or(*feature);
        }
        assert_eq!(all, Features::ALL);
    }
}
