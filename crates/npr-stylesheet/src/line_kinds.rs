//! The kinds of line in a style: which are drawn, and which have a colour of their own.

use npr_core::line_kind::{COLORED_KINDS, Kind, KindSet};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Color;
use crate::overlay::Over;

/// Declares both tables from one entry for each kind: the text of its key in [`Kinds`], then that in [`KindColors`].
macro_rules! kind_tables {
    ($($(#[doc = $doc:literal])+ $key:ident: $kind:ident, $of:literal;)+) => {
        /// The kinds of line.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
        #[serde(default, deny_unknown_fields)]
        pub struct Kinds {
            $($(#[doc = $doc])+ pub $key: bool,)+
        }

        impl Default for Kinds {
            fn default() -> Self {
                Self { $($key: true,)+ }
            }
        }

        impl Kinds {
            /// Whether a kind is drawn. A style does not choose marked lines, so for them this is false.
            fn has(&self, kind: Kind) -> bool {
                match kind {
                    $(Kind::$kind => self.$key,)+
                    Kind::Marked => false,
                }
            }
        }

        /// Colours for single kinds of line; what is absent has the colour of all.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
        #[serde(default, deny_unknown_fields)]
        pub struct KindColors {
            $(
                #[doc = $of]
                #[serde(skip_serializing_if = "Option::is_none")]
                pub $key: Option<Color>,
            )+
        }

        impl KindColors {
            /// The colour of a kind; `None` for a kind without a colour of its own.
            pub fn of(&self, kind: Kind) -> Option<Color> {
                match kind {
                    $(Kind::$kind => self.$key,)+
                    Kind::Marked => None,
                }
            }
        }

        impl Over<Self> for KindColors {
            fn over(&self, below: Self) -> Self {
                Self { $($key: self.$key.or(below.$key),)+ }
            }
        }
    };
}

kind_tables! {
    /// Where a surface turns away from the eye; default true. Off is the setting for still films: contours slide over
    /// surfaces, all other kinds lie on them. Edges of other kinds stay where they are on the outline.
    contour: Contour, "Of contours.";
    /// Where a surface ends: edges with one face; default true.
    boundary: Boundary, "Of boundaries.";
    /// Where a surface folds by more than `crease_angle_deg`; default true.
    crease: Crease, "Of creases.";
    /// Where one material meets another; default true.
    material: Material, "Of lines between materials.";
    /// Where surfaces cut through each other; default true. Off hides sloppy modelling.
    intersection: Intersection, "Of lines where surfaces cut through each other.";
}

impl Kinds {
    /// The kinds that are drawn.
    pub fn set(&self) -> KindSet {
        let kinds = Kind::ALL.into_iter();
        kinds.filter(|kind| self.has(*kind)).collect()
    }
}

impl KindColors {
    /// The kinds that have a colour of their own.
    pub(crate) fn set(&self) -> KindSet {
        let kinds = Kind::ALL.into_iter();
        kinds.filter(|kind| self.of(*kind).is_some()).collect()
    }

    /// The colours in the order of [`Part::line_kinds`](npr_core::geometry::Part::line_kinds).
    pub(crate) fn in_order(&self) -> [Option<Color>; COLORED_KINDS] {
        Kind::COLORED.map(|kind| self.of(kind))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_the_names_of_kinds() {
        let table = toml::Table::try_from(Kinds::default()).unwrap();
        let names = Kind::COLORED.map(Kind::name);
        assert!(names.iter().all(|name| table.contains_key(*name)));
        assert_eq!(table.len(), names.len());
    }
}
