//! What the reader of any format is given.

use crate::limits::Allowance;
use crate::notice::Notices;
use crate::resources::Resources;

/// What a reader needs besides the bytes.
pub(crate) struct Loading<'a> {
    /// Files that the scene refers to.
    pub(crate) resources: &'a dyn Resources,
    /// What may still be taken of the limits.
    pub(crate) allowance: Allowance,
    /// What was ignored or mended so far.
    pub(crate) notices: Notices,
}
