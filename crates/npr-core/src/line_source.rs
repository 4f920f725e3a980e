//! How the curves of a line drawing are found.

/// Declares [`LineSource`] from one entry each: what it is, in one sentence, and its name.
macro_rules! sources {
    ($(#[doc = $meaning:literal] $(#[$attribute:meta])? $source:ident = $name:literal;)+) => {
        /// How the lines of a drawing are found.
        ///
        /// Those of pictures are visible ones alone. `Potrace` has none of intersections; `Image` has boundaries as
        /// contours.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
        pub enum LineSource {
            $(#[doc = $meaning] $(#[$attribute])? $source,)+
        }

        impl LineSource {
            /// All of them.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$source),+];

            /// Its name on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$source => $name,)+
                }
            }

            /// What it is, in one sentence.
            pub const fn meaning(self) -> &'static str {
                match self {
                    $(Self::$source => $meaning.trim_ascii(),)+
                }
            }
        }
    };
}

sources! {
    /// Across faces, where smooth normals turn away from the eye.
    Surface = "surface";
    /// Along mesh edges, exact for the polygons.
    #[default]
    Edges = "edges";
    /// From a picture of all lines, pixel by pixel, as published in 2022: for comparison.
    Potrace = "potrace";
    /// From a picture of the surfaces: all lines where neighbouring pixels differ, each followed once along its middle.
    Image = "image";
}

impl LineSource {
    /// Whether all lines come from a picture of the view.
    pub const fn is_of_pixels(self) -> bool {
        matches!(self, Self::Potrace | Self::Image)
    }
}
