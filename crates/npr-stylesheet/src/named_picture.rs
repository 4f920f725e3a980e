//! The pictures that a style names for its tones, lines, widths and blends.

use crate::{LightShape, Style};

/// Keys that name pictures, within a style or a rule.
const RAMP: &str = "shade.ramp_image";
const HATCH: &str = "ink.hatch.image";
const LINE_PAINT: &str = "line.paint.image";
const LINE_BRUSH: &str = "line.brush.image";
const LINE_WIDTH: &str = "line.width.texture";
const BLEND_MASK: &str = "blend.mask";
const SMOKE_RAMP: &str = "smoke.ramp_image";
const SMOKE_HATCH: &str = "smoke.ink.hatch.image";

impl Style {
    /// The pictures for tones, lines, widths and blends, as pairs of key and picture name. Each name is listed once,
    /// with the first key that has it.
    ///
    /// The caller loads them: no files are opened here. That of the background is not among them.
    pub fn named_pictures(&self) -> Vec<(String, &str)> {
        // List the pictures that the style itself names.
        let mut named = vec![
            (RAMP.to_owned(), self.shade.ramp_image.as_str()),
            (HATCH.to_owned(), self.ink.hatch.image.as_str()),
            (LINE_PAINT.to_owned(), self.line.paint.image.as_str()),
            (LINE_BRUSH.to_owned(), self.line.brush.image.as_str()),
            (
                LINE_WIDTH.to_owned(),
                self.line.width.picture().unwrap_or_default(),
            ),
            (BLEND_MASK.to_owned(), self.blend.mask.as_str()),
            (SMOKE_RAMP.to_owned(), self.smoke.ramp_image.as_str()),
            (SMOKE_HATCH.to_owned(), self.smoke.ink.hatch.image.as_str()),
        ];
        for (i, light) in self.light.extra.iter().enumerate() {
            if light.kind == LightShape::Sky {
                named.push((format!("light.extra.{i}.image"), light.image.as_str()));
            }
        }

        // List those that rules name.
        for (i, rule) in self.rule.iter().enumerate() {
            let of_rule = [
                (RAMP, &rule.shade.ramp_image),
                (HATCH, &rule.ink.hatch.image),
                (LINE_PAINT, &rule.line.paint.image),
                (LINE_BRUSH, &rule.line.brush.image),
            ];
            for (key, name) in of_rule {
                named.extend(
                    name.iter()
                        .map(|name| (format!("rule.{i}.{key}"), name.as_str())),
                );
            }
        }

        // Keep the first entry of each name.
        let mut seen = vec![""];
        named.retain(|(_, name)| {
            let is_new = !seen.contains(name);
            seen.push(name);
            is_new
        });
        named
    }
}

#[cfg(test)]
mod tests {
    use crate::Style;

    #[test]
    fn each_picture_is_named_once_by_its_first_key() {
        let text = "shade.ramp_image = 'a.png'\n[[rule]]\nshade.ramp_image = 'b.png'\n\
                    [[rule]]\nshade.ramp_image = ''\n[[rule]]\nshade.ramp_image = 'a.png'";
        let style = Style::from_toml(text, &|_| Err(String::new())).unwrap();
        let named = style.named_pictures();
        let wanted = [
            ("shade.ramp_image", "a.png"),
            ("rule.0.shade.ramp_image", "b.png"),
        ];
        assert_eq!(named, wanted.map(|(key, name)| (key.to_owned(), name)));
        assert!(Style::default().named_pictures().is_empty());
    }

    #[test]
    fn a_rule_hatches_with_a_pattern_or_a_picture() {
        let text = "ink.hatch.image = 'a.png'\n[[rule]]\nmatch.object = 'B'\nink.hatch.image = 'b.png'\n\
                    [[rule]]\nmatch.object = 'C'\nink.hatch.pattern = 'dots'";
        let style = Style::from_toml(text, &|_| Err(String::new())).unwrap();
        let of = |object| style.resolve_for("", object).ink.hatch.image;
        assert_eq!([of("A"), of("B"), of("C")], ["a.png", "b.png", ""]);
        let keys = style.named_pictures().into_iter().map(|(key, _)| key);
        assert_eq!(
            keys.collect::<Vec<_>>(),
            ["ink.hatch.image", "rule.0.ink.hatch.image"]
        );
    }

    #[test]
    fn a_rule_takes_stops_or_a_picture() {
        let text = "shade.ramp_image = 'a.png'\n[[rule]]\nmatch.object = 'B'\nshade.ramp_image = 'b.png'\n\
                    [[rule]]\nmatch.object = 'C'\nshade.ramp = [{ at = 0, light = 1 }]";
        let style = Style::from_toml(text, &|_| Err(String::new())).unwrap();
        let of = |object| style.resolve_for("", object).ramp_image;
        assert_eq!([of("A"), of("B"), of("C")], ["a.png", "b.png", ""]);
    }
}
