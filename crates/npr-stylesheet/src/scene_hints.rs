//! The key `use_scene_hints` of a style: how far materials of the scene say how they are drawn.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::{Table, Value};

/// What of a toon material is used in place of what the style says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SceneHint {
    /// Its colours in light and shade, the border between them, rims and matcaps, in place of mode and ramp.
    Shade,
    /// Width and colour of its outline, in place of those of lines of method `hull`.
    Outline,
}

/// Which hints of the scene are used: all, none, or those of a list.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum SceneHints {
    /// All or none.
    All(bool),
    /// These.
    Only(#[schemars(length(max = 2))] Vec<SceneHint>),
}

impl Default for SceneHints {
    fn default() -> Self {
        Self::All(false)
    }
}

impl SceneHints {
    /// Whether a hint is used.
    pub fn uses(&self, hint: SceneHint) -> bool {
        match self {
            Self::All(all) => *all,
            Self::Only(hints) => hints.contains(&hint),
        }
    }

    /// Whether any hint is used.
    pub fn is_on(&self) -> bool {
        self.uses(SceneHint::Shade) || self.uses(SceneHint::Outline)
    }
}

/// Keys that hints take the place of: overrides of these, and of keys within them, turn the hint off.
const HINTED: [(&str, SceneHint); 8] = [
    ("shade.mode", SceneHint::Shade),
    ("shade.paper", SceneHint::Shade),
    ("shade.ramp", SceneHint::Shade),
    ("shade.ramp_image", SceneHint::Shade),
    ("shade.softness", SceneHint::Shade),
    ("line.color", SceneHint::Outline),
    ("line.paint", SceneHint::Outline),
    ("line.width", SceneHint::Outline),
];

/// Turns off the hint in the table of a style that would hide an override of the key at `path`.
pub(crate) fn yield_to(table: &mut Table, path: &[&str]) {
    let key = path.join(".");
    let hidden = HINTED
        .iter()
        .find(|(hinted, _)| crate::key::lies_in(&key, hinted));
    let Some((_, hint)) = hidden else { return };
    let hints = table.get("use_scene_hints").cloned();
    let hints: SceneHints = hints.and_then(|v| v.try_into().ok()).unwrap_or_default();
    if !hints.uses(*hint) {
        return;
    }
    let mut left = vec![SceneHint::Shade, SceneHint::Outline];
    left.retain(|other| other != hint && hints.uses(*other));
    let left = match left.is_empty() {
        true => SceneHints::All(false),
        false => SceneHints::Only(left),
    };
    if let Ok(left) = Value::try_from(left) {
        table.insert("use_scene_hints".to_owned(), left);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Style;

    fn hinted() -> Style {
        let mut style = Style::default();
        style.set("use_scene_hints=true").expect("a legal value");
        style
    }

    #[test]
    fn an_override_shows_whatever_the_scene_says() {
        let mut style = hinted();
        style.set("shade.saturation=0.5").expect("a legal value");
        assert_eq!(style.use_scene_hints, SceneHints::All(true));
        style
            .set("shade.ramp=[{ at = 0.0, light = 0.5 }]")
            .expect("a legal value");
        let only = SceneHints::Only(vec![SceneHint::Outline]);
        assert_eq!(style.use_scene_hints, only);
        style.set("line.width.base=5px").expect("a legal value");
        assert_eq!(style.use_scene_hints, SceneHints::All(false));
        style.set("use_scene_hints=['shade']").expect("a list");
        assert!(style.use_scene_hints.uses(SceneHint::Shade));
        assert!(!style.use_scene_hints.uses(SceneHint::Outline));
    }

    #[test]
    fn other_names_are_refused() {
        let fault = hinted().set("use_scene_hints=['shades']");
        let fault = fault.expect_err("no hint").to_string();
        assert!(fault.contains("must be one of shade, outline"), "{fault}");
        let fault = hinted().set("use_scene_hints=3").expect_err("no hint");
        let fault = fault.to_string();
        assert!(fault.contains("true or false or a list"), "{fault}");
    }
}
