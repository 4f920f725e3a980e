//! The key `extends` of a style: the styles that it starts from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a style starts from: one name or a list of names.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(from = "Written", into = "Written")]
pub struct Parents(pub Vec<String>);

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
enum Written {
    One(String),
    Many(Vec<String>),
}

impl Parents {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl From<Written> for Parents {
    fn from(written: Written) -> Self {
        match written {
            Written::One(name) => Self(vec![name]),
            Written::Many(names) => Self(names),
        }
    }
}

impl From<Parents> for Written {
    fn from(parents: Parents) -> Self {
        Self::Many(parents.0)
    }
}
