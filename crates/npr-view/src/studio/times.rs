//! The section that tells how long pictures take.

use egui::{CollapsingHeader, RichText, Ui};

use super::Studio;

/// What searches find the section by.
const WORDS: &str = "times seconds passes frames how long";

impl Studio {
    /// Shows how long pictures take, folded in unless it is searched for.
    pub(super) fn show_times(&mut self, ui: &mut Ui) {
        if !self.panel.finds(&[WORDS]) {
            return;
        }
        let title = RichText::new("Times").strong().size(15.0);
        let is_open = (!self.panel.search.is_empty()).then_some(true);
        CollapsingHeader::new(title)
            .open(is_open)
            .show(ui, |ui| self.times.show(ui));
    }
}
