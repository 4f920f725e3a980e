//! The table `antialias` of a style: how edges are smoothed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How edges are smoothed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Antialias {
    /// Samples a pixel, 1 or 4; default 4. 1 is fast and jagged, for pixel art and comparisons.
    #[schemars(extend("enum" = [1, 4]))]
    pub samples: u8,
}

impl Default for Antialias {
    fn default() -> Self {
        Self { samples: 4 }
    }
}
