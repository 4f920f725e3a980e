//! What lines need in every view, once they ask for it.

use super::model::LineModel;
use super::options::LineOptions;
use crate::error::RenderError;
use npr_vector::mesh_lines::draw::Prepared;
use std::cell::OnceCell;
use std::sync::Arc;

/// What a drawing needs of its model in every view, prepared when it is first asked for: lines that are traced from a
/// picture need none of it.
pub(super) struct PreparedOnDemand<'a> {
    model: &'a LineModel,
    options: &'a LineOptions,
    made: OnceCell<Arc<Prepared>>,
}

impl<'a> PreparedOnDemand<'a> {
    pub fn new(model: &'a LineModel, options: &'a LineOptions) -> Self {
        Self {
            model,
            options,
            made: OnceCell::new(),
        }
    }

    /// What is prepared, from here on.
    pub fn get(&self) -> Result<&Arc<Prepared>, RenderError> {
        if let Some(made) = self.made.get() {
            return Ok(made);
        }
        let made = self.model.prepared(self.options)?;
        Ok(self.made.get_or_init(|| made))
    }

    /// What was prepared so far.
    pub fn so_far(&self) -> Option<&Prepared> {
        self.made.get().map(Arc::as_ref)
    }
}
