//! What the lines of a film's frames take over from the frame before.

use npr_core::line_source::LineSource;
use npr_vector::hold::HeldStrokes;

/// The strokes of the frame drawn last, for [`LineModel::draw_held`](super::LineModel::draw_held); of every way to find
/// lines its own, as a frame may have several.
#[derive(Debug, Clone, Default)]
pub struct HeldLines {
    of_methods: Vec<(LineSource, HeldStrokes)>,
}

impl HeldLines {
    /// Those that a method found.
    pub(super) fn of(&mut self, method: LineSource) -> &mut HeldStrokes {
        let known = self
            .of_methods
            .iter()
            .position(|(other, _)| *other == method);
        let index = known.unwrap_or_else(|| {
            self.of_methods.push((method, HeldStrokes::default()));
            self.of_methods.len() - 1
        });
        &mut self.of_methods[index].1
    }
}
