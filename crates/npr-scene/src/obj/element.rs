//! Faces and polylines, which corners belong to.

/// What corners belong to, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// A face, from a line `f`.
    Face(usize),
    /// A line through points, from a line `l`.
    Polyline(usize),
}

impl Element {
    /// How many corners it has at least.
    pub(super) fn least(self) -> usize {
        match self {
            Self::Face(_) => 3,
            Self::Polyline(_) => 2,
        }
    }
}

impl std::fmt::Display for Element {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Face(number) => write!(f, "face {number}"),
            Self::Polyline(number) => write!(f, "polyline {number}"),
        }
    }
}
