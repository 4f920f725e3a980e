//! The table `line.potrace` of a style: the constants of pixel strokes.

use npr_core::published_constants;
use npr_core::published_path::PublishedPath;

use crate::overlay::style_table;

macro_rules! potrace_table {
    ($($(#[$attribute:meta])+ $key:ident: $type:ty = $published:expr;)+) => {
        style_table! {
            #[doc = "The constants of method `potrace` and of `npr lines --method potrace` [Jiang et al. 2022]. Sides \
                     are those of\npixels; defaults are those of [`PublishedPath`]."]
            pub struct Potrace {
                $($(#[$attribute])+ pub $key: $type = $published,)+
            }
        }

        impl Potrace {
            /// The constants as the algorithm reads them.
            pub fn path(&self) -> PublishedPath {
                PublishedPath { $($key: self.$key,)+ ..PublishedPath::default() }
            }
        }
    };
}

published_constants!(potrace_table);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_of_styles_are_those_of_the_path() {
        assert_eq!(Potrace::default().path(), PublishedPath::default());
    }
}
