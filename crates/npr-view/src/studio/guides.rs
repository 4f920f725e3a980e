//! Guide points: places on the model where the pen is lifted, added and taken away by clicks.

use egui::{Color32, Pos2, Rect, Stroke, Ui};
use toml::Value;

use super::Studio;
use crate::panel::Edit;
use crate::why::ToldPart;

/// The key that holds them.
const KEY: &str = "line.guides";

/// Most of them that a style has.
const GUIDES_MAX: usize = 64;

/// How far from a dot a click may be that means it, in points.
const REACH: f32 = 8.0;

impl Studio {
    /// The guide points of the style.
    fn guides(&self) -> &[[f32; 3]] {
        &self.sheet.style().line.guides
    }

    /// Where a guide point lies in the window, where the picture covers `place`.
    fn guide_at(&self, guide: [f32; 3], place: Rect) -> Option<Pos2> {
        let shown = self.shown.as_ref().map(|(picture, _)| picture.viewpoint);
        let viewpoint = self.viewpoint.or(shown)?;
        let [x, y] = viewpoint.share_of(guide, self.size)?;
        Some(place.min + egui::vec2(x, y) * place.size())
    }

    /// Takes the guide point under the pointer away, if there is one.
    pub(super) fn remove_guide(&mut self, pointer: Pos2, place: Rect, ui: &Ui) -> bool {
        let away = |guide: &[f32; 3]| {
            let at = self.guide_at(*guide, place);
            at.map_or(f32::INFINITY, |at| at.distance(pointer))
        };
        let nearest = (0..self.guides().len())
            .map(|i| (i, away(&self.guides()[i])))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((i, _)) = nearest.filter(|(_, away)| *away <= REACH) else {
            return false;
        };
        let mut guides = self.guides().to_vec();
        guides.remove(i);
        self.set_guides(&guides, ui);
        true
    }

    /// Adds a guide point on a part.
    pub(super) fn add_guide(&mut self, part: Option<&ToldPart>, ui: &Ui) {
        let Some(part) = part else {
            return self.tell_fault("a guide point lies on the model: there is none here");
        };
        let mut guides = self.guides().to_vec();
        if guides.len() >= GUIDES_MAX {
            return self.tell_fault(format!("a style has {GUIDES_MAX} guide points at most"));
        }
        guides.push(part.at_rest);
        self.set_guides(&guides, ui);
    }

    fn set_guides(&mut self, guides: &[[f32; 3]], ui: &Ui) {
        let number = |place: &f32| Value::Float(f64::from(*place));
        let point = |guide: &[f32; 3]| Value::Array(guide.iter().map(number).collect());
        let all = Value::Array(guides.iter().map(point).collect());
        self.history.close();
        self.edit(&Edit::Set(KEY.to_owned(), all), ui);
        self.history.close();
    }

    /// Shows the guide points as dots over the picture that covers `place`.
    pub(super) fn show_guides(&self, ui: &Ui, place: Rect) {
        let painter = ui.painter().with_clip_rect(place);
        let edge = Stroke::new(1.5, Color32::WHITE);
        for guide in self.guides() {
            if let Some(at) = self.guide_at(*guide, place) {
                painter.circle(at, 4.5, Color32::from_rgb(0xff, 0x90, 0x00), edge);
            }
        }
    }
}
