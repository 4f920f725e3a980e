//! Why a file or a grid was not read.

use crate::shown::shown;
use crate::voxel::ValueType;

/// Why a file or a grid was not read.
///
/// Messages are one line without the file's own name, which the caller puts before them.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The first bytes are not those of an OpenVDB file.
    #[error("this is no OpenVDB file")]
    NotVdb,
    /// The format's version is unknown.
    #[error("format version {version} is not read, only 220 to 224")]
    Version {
        /// As the file states it.
        version: u32,
    },
    /// The file ends early, or states a length beyond its end.
    #[error("{what} goes on beyond byte {end}, where the data ends")]
    Truncated {
        /// What was being read.
        what: &'static str,
        /// Where the bytes that may hold it end.
        end: usize,
    },
    /// Something in the file makes no sense.
    #[error("{what} at byte {at}: {fault}")]
    Broken {
        /// What was being read.
        what: &'static str,
        /// Where it begins in the file.
        at: usize,
        /// What is wrong with it.
        fault: &'static str,
    },
    /// More memory is needed than [`Limits`](crate::Limits) allow.
    #[error("memory for {what} comes to {bytes} bytes, which exceeds the limit of {limit}")]
    Memory {
        /// What would not fit any more.
        what: &'static str,
        /// Bytes planned, that included; `u64::MAX` where the size itself overflows.
        bytes: u64,
        /// The limit in bytes.
        limit: u64,
    },
    /// The system refused memory that the limits allow.
    #[error("the system has no {bytes} bytes for {what}")]
    OutOfMemory {
        /// What it was for.
        what: &'static str,
        /// How much was asked for.
        bytes: u64,
    },
    /// A grid holds values, or has a tree, of a type that is not read.
    #[error(
        "grid '{}' has type {}, which is not read",
        shown(grid),
        shown(type_name)
    )]
    GridType {
        /// Name of the grid.
        grid: String,
        /// Type of its tree as the file names it.
        type_name: String,
    },
    /// A grid lies in space in a way that is not read.
    #[error(
        "grid '{}' has transform {}, which is not read",
        shown(grid),
        shown(map)
    )]
    Map {
        /// Name of the grid.
        grid: String,
        /// Type of its transform as the file names it.
        map: String,
    },
    /// No grid has this name.
    #[error("there is no grid '{}', only {}", shown(name), list(names))]
    NoGrid {
        /// The name asked for.
        name: String,
        /// The names there are.
        names: Vec<String>,
    },
    /// A grid holds vectors where numbers were asked for, or the other way round.
    #[error("grid '{}' holds {holds}, not {}", shown(grid), if *vectors_wanted { "vectors" } else { "numbers" })]
    Kind {
        /// Name of the grid.
        grid: String,
        /// What it holds.
        holds: ValueType,
        /// Whether vectors were asked for.
        vectors_wanted: bool,
    },
    /// A grid shares the tree of a grid that is not there, or that shares one itself.
    #[error(
        "grid '{}' shares the tree of '{}', which has none",
        shown(grid),
        shown(parent)
    )]
    Instance {
        /// Name of the grid.
        grid: String,
        /// Name of the grid that should have the tree.
        parent: String,
    },
    /// A `.npy` file makes no sense, or holds what is not read.
    #[error("{0}")]
    Npy(#[from] crate::npy::NpyFault),
}

/// The first few of `names` for a message.
fn list(names: &[String]) -> String {
    const NAMES: usize = 8;
    let quoted: Vec<_> = names
        .iter()
        .take(NAMES)
        .map(|name| format!("'{}'", shown(name)))
        .collect();
    match names.len() {
        0 => "an empty file".to_owned(),
        1..=NAMES => quoted.join(", "),
        count => format!("{} and {} more", quoted.join(", "), count - NAMES),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_stay_short_and_on_one_line() {
        let fault = Fault::GridType {
            grid: "a\nb'".repeat(100),
            type_name: "\u{202e}points".to_owned(),
        };
        let text = fault.to_string();
        assert!(text.len() < 200 && !text.contains('\n'), "{text}");
        assert!(!text.contains('\u{202e}'), "{text}");
    }

    #[test]
    fn a_missing_name_lists_what_is_there() {
        let names = |count: usize| (0..count).map(|i| format!("g{i}")).collect::<Vec<_>>();
        let fault = |names| Fault::NoGrid {
            name: "heat".to_owned(),
            names,
        };
        assert_eq!(
            fault(names(2)).to_string(),
            "there is no grid 'heat', only 'g0', 'g1'"
        );
        assert!(fault(names(30)).to_string().ends_with("'g7' and 22 more"));
        assert_eq!(
            fault(names(0)).to_string(),
            "there is no grid 'heat', only an empty file"
        );
    }
}
