//! Pictures beside the present one, which are drawn one at a time while nothing changes.

use egui::Ui;

use super::{Studio, canvas};
use crate::host::{Order, Picture};

impl Studio {
    /// Asks for the next picture beside the present one, unless one is being drawn.
    pub(super) fn ask_aside(&mut self) {
        if self.aside.is_some() {
            return;
        }
        if let Some(order) = self.missing_first() {
            self.aside = Some(order.clone());
            self.host.draw_aside(order);
        }
    }

    /// Takes a picture beside the present one, or why there is none. One of another view than the present is dropped.
    pub(super) fn take_aside(
        &mut self,
        order: &Order,
        drawn: Result<Box<Picture>, String>,
        ui: &Ui,
    ) {
        // One that could not be drawn is asked for no more, until something else is drawn.
        let is_last = self.aside.as_ref() == Some(order);
        match drawn {
            Ok(picture) => {
                self.aside = self.aside.take().filter(|_| !is_last);
                self.take_first(order, || canvas::texture(ui.ctx(), &picture));
            }
            Err(text) => self.tell_fault(format!("no picture from before: {text}")),
        }
        ui.ctx().request_repaint();
    }
}
