//! Films that are taken away: what is in them, and how far they are.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Checkbox, PopupCloseBehavior, Ui};

use super::Studio;
use crate::film::{Film, FilmForm};
use crate::host::Order;

/// The forms of films, with their names.
const FORMS: [(FilmForm, &str); 3] = [
    (FilmForm::Apng, "APNG"),
    (FilmForm::Gif, "GIF"),
    (FilmForm::Frames, "PNG frames"),
];

impl Studio {
    /// The film of what is shown, in a form; none where nothing moves in it.
    pub fn film(&self, form: FilmForm) -> Option<Film> {
        // A scene with clips that rests has no film in which it does: without a clip the first one plays.
        let can_hold = self.pose.clip.is_some() || self.timeline.cast.clips.is_empty();
        let film = Film {
            form,
            fps: self.timeline.fps(),
            plays: self.timeline.has_time() && !(self.filming.is_held && can_hold),
            turns: self.filming.turns,
        };
        (film.plays || film.turns).then_some(film)
    }

    /// The order of a film of what is shown.
    fn film_order(&self, film: &Film) -> Order {
        let order = self.order();
        Order {
            pose: film.pose(&order.pose),
            layer: None,
            ..order
        }
    }

    /// Shows what films can be taken away.
    pub(super) fn show_films(&mut self, ui: &mut Ui) {
        let stays = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
        MenuButton::new("Film").config(stays).ui(ui, |ui| {
            // Choose what moves.
            let mut plays = self.timeline.has_time() && !self.filming.is_held;
            let can_play = self.timeline.has_time();
            let is_playing = Checkbox::new(&mut plays, "what plays");
            if ui.add_enabled(can_play, is_playing).changed() {
                self.filming.is_held = !plays;
            }
            ui.checkbox(&mut self.filming.turns, "the camera turns once");
            ui.separator();

            // Take it away.
            let film = self.film(FilmForm::Apng);
            let is_free = film.is_some() && self.filming.done.is_none();
            for (form, name) in FORMS {
                let button = ui.add_enabled(is_free, egui::Button::new(name));
                let button = button.on_hover_text("a film, drawn as npr animate draws it");
                if button.clicked()
                    && let Some(film) = film
                {
                    self.start_film(Film { form, ..film });
                    ui.close();
                }
            }
            let copy = ui.add_enabled(film.is_some(), egui::Button::new("Copy film command"));
            if copy.clicked()
                && let Some(film) = film
            {
                let order = self.film_order(&film);
                if let Some(order) = self.told_order(order) {
                    ui.ctx().copy_text(self.host.film_command(&film, &order));
                    let text = "the command line of this film is in the clipboard";
                    self.told = Some((text.to_owned(), false));
                }
                ui.close();
            }
        });
    }

    fn start_film(&mut self, film: Film) {
        let order = self.film_order(&film);
        self.timeline.pause();
        self.filming.done = Some([0, 0]);
        self.host.film(&film, &order);
    }

    /// Shows how far a film is, and a way to end it.
    pub(super) fn show_filming(&mut self, ui: &mut Ui) {
        let Some([done, of]) = self.filming.done else {
            return;
        };
        match of {
            0 => ui.label("a film is being prepared"),
            _ => ui.label(format!("frame {done} of {of} of the film is drawn")),
        };
        if ui.button("Cancel").clicked() {
            self.host.cancel();
        }
        ui.separator();
    }
}
