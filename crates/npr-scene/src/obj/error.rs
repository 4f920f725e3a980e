//! What can be wrong with an OBJ file.

use super::Element;

/// What is wrong with an OBJ file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ObjError {
    /// A vertex, normal or texture coordinate lacks numbers.
    #[error("line {line}: {what} needs {wanted} numbers")]
    Numbers {
        /// Line, counted from 1.
        line: usize,
        /// What the line defines.
        what: &'static str,
        /// How many numbers it needs.
        wanted: usize,
    },
    /// A corner of a face or a polyline is no index.
    #[error(
        "line {line}: {element} has the corner '{}', which is no index",
        crate::shown::shown(corner)
    )]
    Corner {
        /// Line, counted from 1.
        line: usize,
        /// What it belongs to.
        element: Element,
        /// The corner as read.
        corner: String,
    },
    /// A face or a polyline has too few corners.
    #[error("line {line}: {element} has only {corner_count} corners")]
    FewCorners {
        /// Line, counted from 1.
        line: usize,
        /// What has them.
        element: Element,
        /// How many corners it has.
        corner_count: usize,
    },
    /// A face or a polyline names something that was not defined before it.
    #[error(
        "line {line}: {element} uses {what} {index}, but only {count} are defined so far, counted from 1"
    )]
    Missing {
        /// Line, counted from 1.
        line: usize,
        /// What names it.
        element: Element,
        /// What it names: a vertex, a normal or a texture coordinate.
        what: &'static str,
        /// The index as read.
        index: i64,
        /// How many are defined before the line.
        count: usize,
    },
}
