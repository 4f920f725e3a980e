//! Samples of a brush and of hatching, which are drawn while the panel shows them.

use egui::TextureHandle;
use npr_stylesheet::Tone;
use toml::Value;

use super::Studio;
use crate::host::{Order, Swatch};
use crate::panel::{SAMPLE_WIDTH, sampled};
use crate::pose::Pose;

/// Most pixels of the picture's height that lengths are taken from: that of a sample is the same.
const HEIGHT_MAX: u32 = 2160;

/// How much larger strokes are in a sample than in the picture.
const ENLARGED: f32 = 2.0;

/// The largest `line.scale`.
const SCALE_MAX: f32 = 20.0;

impl Studio {
    /// The values that a sample shows, and the order that it is drawn by.
    fn swatch_of(&self, swatch: Swatch) -> (Vec<Option<Value>>, Order) {
        let values = sampled(swatch).map(|key| self.sheet.value(key).cloned());
        let mut order = self.order();
        order.overrides.extend(self.shown_by(swatch));
        let width = (SAMPLE_WIDTH * self.swatches.scale).round().max(1.0) as u32;
        let order = Order {
            change: 0,
            viewpoint: None,
            pose: Pose::default(),
            layer: None,
            swatch: Some(swatch),
            size: [width, order.size[1].clamp(1, HEIGHT_MAX)],
            ..order
        };
        (values.to_vec(), order)
    }

    /// What a sample changes about the style so that it shows what it is of: strokes are larger, and hatching is there.
    fn shown_by(&self, swatch: Swatch) -> Option<String> {
        let style = self.sheet.style();
        let tone = match (swatch, style.ink.tone) {
            (Swatch::Brush, _) => {
                let scale = (style.line.scale * ENLARGED).min(SCALE_MAX);
                return Some(format!("line.scale={scale}"));
            }
            (_, Tone::Off) => "hatch",
            (_, Tone::Ink) => "ink+hatch",
            (_, Tone::Hatch | Tone::InkHatch | Tone::Auto) => return None,
        };
        Some(format!("ink.tone={tone}"))
    }

    /// The first sample that is in sight and shows other values than those of the style.
    pub(super) fn missing_swatch(&self) -> Option<Order> {
        let mut seen = self.swatches.in_sight.iter();
        seen.find_map(|swatch| {
            let (values, order) = self.swatch_of(*swatch);
            let is_shown = self.swatches.shows(*swatch, &values, order.size);
            (!is_shown).then_some(order)
        })
    }

    /// Takes a sample that was drawn, or that there is none, if that is what an order asked for; gives whether it is.
    pub(super) fn take_swatch(&mut self, order: &Order, texture: Option<TextureHandle>) -> bool {
        let Some(swatch) = order.swatch else {
            return false;
        };
        let (values, wanted) = self.swatch_of(swatch);
        if wanted == *order {
            self.swatches.put(swatch, values, order.size, texture);
        }
        true
    }
}
