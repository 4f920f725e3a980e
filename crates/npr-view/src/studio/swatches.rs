//! Samples of a brush and of hatching, which are drawn while the panel shows them.

use egui::TextureHandle;
use npr_stylesheet::Tone;
use toml::Value;

use super::Studio;
use crate::host::{Order, Swatch};
use crate::panel::{SAMPLE_WIDTH, SAMPLES, Sample};
use crate::pose::Pose;
use crate::value::text_of;

/// Most pixels of the picture's height that lengths are taken from: that of a sample is the same.
const HEIGHT_MAX: u32 = 2160;

/// How much larger strokes are in a sample than in the picture.
const ENLARGED: f32 = 2.0;

/// The largest `line.scale`.
const SCALE_MAX: f32 = 20.0;

/// The table of hatching that lies on smoke and no surface.
const OF_SMOKE: &str = "smoke.ink.hatch";

impl Studio {
    /// The values that a sample shows, and the order that it is drawn by.
    fn sample_of(&self, sample: &Sample) -> (Vec<Option<Value>>, Order) {
        let values = sample.values.map(|key| self.sheet.value(key).cloned());
        let mut order = self.order();
        order.overrides.extend(self.shown_by(sample));
        let width = (SAMPLE_WIDTH * self.swatches.scale).round().max(1.0) as u32;
        let order = Order {
            change: 0,
            viewpoint: None,
            pose: Pose::default(),
            layer: None,
            swatch: Some(sample.swatch),
            size: [width, order.size[1].clamp(1, HEIGHT_MAX)],
            ..order
        };
        (values.to_vec(), order)
    }

    /// What a sample changes about the style so that it shows what it is of: strokes are larger, hatching is there, and
    /// that of smoke lies on paper.
    fn shown_by(&self, sample: &Sample) -> Vec<String> {
        let style = self.sheet.style();
        if sample.swatch == Swatch::Brush {
            let scale = (style.line.scale * ENLARGED).min(SCALE_MAX);
            return vec![format!("line.scale={scale}")];
        }
        let (mut changes, mut tone) = (Vec::new(), style.ink.tone);
        if sample.table == OF_SMOKE {
            let ink = style.smoke.ink.on_picture();
            tone = ink.tone;
            let ink = Value::try_from(ink);
            changes.extend(ink.map(|ink| format!("ink={}", text_of(&ink))));
            changes.push("shade.mode=paper".to_owned());
        }
        changes.extend(match tone {
            Tone::Off => Some("ink.tone=hatch".to_owned()),
            Tone::Ink => Some("ink.tone=ink+hatch".to_owned()),
            Tone::Hatch | Tone::InkHatch | Tone::Auto => None,
        });
        changes
    }

    /// The first sample that is in sight and shows other values than those of the style.
    pub(super) fn missing_swatch(&self) -> Option<Order> {
        let is_seen = |sample: &&Sample| self.swatches.in_sight.contains(&sample.table);
        let mut seen = SAMPLES.iter().filter(is_seen);
        seen.find_map(|sample| {
            let (values, order) = self.sample_of(sample);
            let is_shown = self.swatches.shows(sample.table, &values, order.size);
            (!is_shown).then_some(order)
        })
    }

    /// Takes a sample that was drawn, or that there is none, if that is what an order asked for; gives whether it is.
    pub(super) fn take_swatch(&mut self, order: &Order, texture: Option<TextureHandle>) -> bool {
        if order.swatch.is_none() {
            return false;
        }
        for sample in &SAMPLES {
            let (values, wanted) = self.sample_of(sample);
            if wanted == *order {
                self.swatches
                    .put(sample.table, values, order.size, texture.clone());
            }
        }
        true
    }
}
