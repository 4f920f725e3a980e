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
        let missing = self.missing_first();
        let missing = missing.or_else(|| self.missing_swatch());
        let missing = missing.or_else(|| self.missing_preset());
        if let Some(order) = missing {
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
        let is_last = self.aside.as_ref() == Some(order);
        let free = self.aside.take().filter(|_| !is_last);
        match drawn {
            Ok(picture) => {
                let texture = canvas::texture(ui.ctx(), &picture);
                let is_taken = self.take_swatch(order, Some(texture.clone()))
                    || self.take_first(order, &texture);
                if !is_taken {
                    self.take_preset(order, Some(texture));
                }
                self.aside = free;
            }
            Err(_) if self.take_swatch(order, None) || self.take_preset(order, None) => {
                self.aside = free;
            }
            Err(text) => {
                // It is asked for no more, until something else is drawn.
                self.aside = free.or_else(|| is_last.then(|| order.clone()));
                self.tell_fault(format!("no picture of before: {text}"));
            }
        }
        ui.ctx().request_repaint();
    }
}
