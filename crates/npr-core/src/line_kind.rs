//! The kinds of line: what a line is on the shape.
//!
//! Every list of kinds follows from this one: styles, drawings, edges, nodes of curves and shaders. A kind has a name
//! for files, a sentence for people, and a bit for sets of kinds. Styles choose and colour the kinds before
//! [`Kind::Marked`], which is the last.

/// Declares [`Kind`] from one line a kind: what it is, its name, and its bit.
macro_rules! kinds {
    ($(#[doc = $meaning:literal] $kind:ident = $name:literal, $bit:ident;)+) => {
        /// What a line is on the shape.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u32)]
        pub enum Kind {
            $(#[doc = $meaning] $kind = KindSet::$bit.trailing_zeros(),)+
        }

        impl Kind {
            /// All kinds, in the order in which they are layered, which is that of their bits.
            pub const ALL: [Kind; [$($name),+].len()] = [$(Kind::$kind),+];

            /// The names of all kinds, in the order of [`Kind::ALL`].
            pub const NAMES: [&str; Kind::ALL.len()] = [$($name),+];

            /// What it is, in one sentence.
            pub fn meaning(self) -> &'static str {
                match self {
                    $(Kind::$kind => $meaning.trim_ascii(),)+
                }
            }
        }
    };
}

kinds! {
    /// The surface turns away from the eye.
    Contour = "contour", CONTOUR;
    /// The surface ends.
    Boundary = "boundary", BOUNDARY;
    /// The surface bends sharply.
    Crease = "crease", CREASE;
    /// The material changes.
    Material = "material", MATERIAL;
    /// Two surfaces cut through each other.
    Intersection = "intersection", INTERSECTION;
    /// The file or the user asks for a line here.
    Marked = "marked", MARKED;
}

/// Number of kinds whose lines may have a colour of their own: all before [`Kind::Marked`].
pub const COLORED_KINDS: usize = 5;

/// Bits that hold the number of a kind, or one of the two numbers after the last.
pub const KIND_NUMBER_BITS: u32 = (Kind::ALL.len() + 1).ilog2() + 1;

const _: () = assert!(
    COLORED_KINDS == Kind::Marked as usize && COLORED_KINDS + 1 == Kind::ALL.len(),
    "marked lines are of the last kind, and styles colour all others"
);

impl Kind {
    /// The kinds that styles choose and colour.
    pub const COLORED: [Kind; COLORED_KINDS] = {
        let mut colored = [Kind::Contour; COLORED_KINDS];
        colored.copy_from_slice(Kind::ALL.split_at(COLORED_KINDS).0);
        colored
    };

    /// Its name in files and on the command line.
    pub const fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    /// The kind of a name; none where no kind is called so.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Its bit in a [`KindSet`].
    pub const fn bit(self) -> u32 {
        1 << self as u32
    }

    /// The first kind of a set of bits; none where the set holds no kind.
    pub fn first_of(bits: u32) -> Option<Self> {
        let first = (bits & KindSet::BITS).trailing_zeros();
        Self::ALL.get(first as usize).copied()
    }
}

/// A set of kinds of line.
///
/// ```
/// use npr_core::line_kind::{Kind, KindSet};
///
/// let outlines: KindSet = [Kind::Contour, Kind::Boundary].into_iter().collect();
/// assert!(outlines.has(Kind::Contour) && !outlines.has(Kind::Crease));
/// assert_eq!(KindSet::ALL.kinds().count(), Kind::ALL.len());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct KindSet(u32);

impl KindSet {
    /// The bit of [`Kind::Contour`]; shaders read these bits.
    pub const CONTOUR: u32 = 1;
    /// The bit of [`Kind::Boundary`].
    pub const BOUNDARY: u32 = 2;
    /// The bit of [`Kind::Crease`].
    pub const CREASE: u32 = 4;
    /// The bit of [`Kind::Material`].
    pub const MATERIAL: u32 = 8;
    /// The bit of [`Kind::Intersection`].
    pub const INTERSECTION: u32 = 16;
    /// The bit of [`Kind::Marked`].
    pub const MARKED: u32 = 32;
    /// The bits of all kinds.
    pub const BITS: u32 = 2 * Self::MARKED - 1;
    /// The bits of the kinds that styles may colour.
    pub const COLORED: u32 = Self::MARKED - 1;
    /// The bits of kinds that lines of a frame are found as along edges of meshes.
    pub const EDGES: u32 = Self::CONTOUR | Self::BOUNDARY | Self::CREASE | Self::MATERIAL;
    /// The first bit of what shares a word with kinds: those below are kept for kinds.
    pub const END: u32 = 1 << 16;

    /// Every kind.
    pub const ALL: Self = Self(Self::BITS);

    /// Whether a kind is in the set.
    pub const fn has(self, kind: Kind) -> bool {
        self.0 & kind.bit() != 0
    }

    /// Its kinds, in the order of [`Kind::ALL`].
    pub fn kinds(self) -> impl Iterator<Item = Kind> {
        Kind::ALL.into_iter().filter(move |kind| self.has(*kind))
    }

    /// Its bits, of [`KindSet::BITS`].
    pub const fn bits(self) -> u32 {
        self.0
    }
}

impl FromIterator<Kind> for KindSet {
    fn from_iter<T: IntoIterator<Item = Kind>>(kinds: T) -> Self {
        let bits = kinds.into_iter().map(Kind::bit);
        Self(bits.fold(0, |set, bit| set | bit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_names_and_numbers_run_in_one_order() {
        for (number, kind) in Kind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, number);
            assert_eq!(kind.bit(), 1 << number);
            assert_eq!(Kind::named(kind.name()), Some(kind));
            assert_eq!(Kind::first_of(kind.bit() | KindSet::MARKED), Some(kind));
        }
        assert_eq!(Kind::ALL.into_iter().collect::<KindSet>(), KindSet::ALL);
        assert_eq!(Kind::first_of(!KindSet::BITS), None);
        assert_eq!(Kind::named("none"), None);
    }
}
