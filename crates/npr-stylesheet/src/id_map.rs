//! Id maps: pictures that tell the regions of a surface apart, so that rules can name them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

use crate::error::StyleError;
use crate::{Color, glob};

/// Most id maps of a style.
pub const ID_MAPS_MAX: usize = 64;

/// Most colours that one id map names.
pub const IDS_MAX: usize = 256;

/// A colour of an id map, with a name for rules.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NamedId {
    /// The name, such as `hair`; several colours may share one.
    pub name: String,
    /// The colour of its region, opaque: these three bytes and no others.
    pub color: Color,
}

/// A picture that is laid on a surface as its base colour texture is, each region in a flat colour of its own.
///
/// Every triangle belongs to the region that covers most of it. Colours with a name here, and those that rules name
/// by `#rrggbb`, are ids; all others, and what is less than half opaque, are none. Where several maps lie on one
/// part, the last counts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct IdMap {
    /// The picture, PNG or JPEG, found as other pictures are; channels of 16 bits are rounded to 8.
    pub image: String,
    /// Pattern for the names of the objects that it lies on; default `*`, any.
    #[serde(default = "any")]
    pub object: String,
    /// Pattern for the names of the materials that it lies on; default `*`, any.
    #[serde(default = "any")]
    pub material: String,
    /// Its colours with names, up to 256. Where two cover as much of a triangle, the earlier has it.
    #[serde(default)]
    #[schemars(length(max = 256))]
    pub ids: Vec<NamedId>,
    /// Whether lines of kind material run between its regions, as between materials; default no: regions are told
    /// apart by rules alone.
    #[serde(default)]
    pub border: bool,
}

fn any() -> String {
    "*".to_owned()
}

/// The colour of a rule's pattern such as `#ff8000`; `None` for a pattern of names.
pub(crate) fn color_of(pattern: &str) -> Option<Color> {
    pattern.starts_with('#').then(|| pattern.parse().ok())?
}

/// Whether a rule's pattern matches a part. `names` are those of the region that the part belongs to; empty where it
/// belongs to none.
///
/// `*` matches all parts, `?*` those with an id, and an empty pattern those without.
pub(crate) fn matches(pattern: &str, names: &[String]) -> bool {
    let color = color_of(pattern).map(|color| color.to_string());
    let pattern = color.as_deref().unwrap_or(pattern);
    if names.is_empty() {
        return glob::matches(pattern, "");
    }
    names.iter().any(|name| glob::matches(pattern, name))
}

impl IdMap {
    /// Whether the patterns of the map match a part. Where several maps match, the last one counts.
    pub fn lies_on(&self, material: &str, object: &str) -> bool {
        glob::matches(&self.material, material) && glob::matches(&self.object, object)
    }

    /// Refuses maps without a picture, names that rules cannot use, and colours with two names.
    pub(crate) fn check(&self, key: &str) -> Result<(), StyleError> {
        // Refuse a map without a picture.
        if self.image.is_empty() {
            return Err(StyleError::unfit(format!("{key}.image"), "names no file"));
        }

        // Refuse names that rules cannot use, and colours that are not opaque or have two names.
        let mut known: BTreeMap<[u8; 3], &str> = BTreeMap::new();
        for (i, id) in self.ids.iter().enumerate() {
            let unfit = |of: &str, reason: String| {
                Err(StyleError::unfit(format!("{key}.ids.{i}.{of}"), reason))
            };
            if id.name.is_empty() || id.name.starts_with('#') || id.name.contains(['*', '?']) {
                let reason = "must not be empty, start with #, or have * or ? in it";
                return unfit("name", reason.to_owned());
            }
            if id.color.a < 255 {
                return unfit("color", "must be opaque".to_owned());
            }
            if let Some(other) = known.insert([id.color.r, id.color.g, id.color.b], &id.name) {
                let other: String = other
                    .chars()
                    .take(60)
                    .flat_map(char::escape_debug)
                    .collect();
                return unfit("color", format!("is that of '{other}' too"));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Style;

    const MAP: &str = "[[id_map]]\nimage = 'ids.png'\n\
        ids = [{ name = 'hair', color = '#f00' }, { name = 'coat', color = '#00ff00' }]\n";

    fn read(text: &str) -> Result<Style, StyleError> {
        Style::from_toml(text, &|_| Err(String::new()))
    }

    fn reported(text: &str) -> String {
        read(text).unwrap_err().to_string()
    }

    #[test]
    fn rules_match_names_and_colors_of_regions() {
        let rules = "[[rule]]\nmatch.id = 'hair'\nline.width_factor = 2\n\
            [[rule]]\nmatch.id = '#0F0'\nline.width_factor = 3\n\
            [[rule]]\nmatch.id = '#0000ff'\nline.width_factor = 4\n\
            [[rule]]\nmatch.id = ''\nline.width_factor = 5";
        let style = read(&format!("{MAP}{rules}")).unwrap();
        let regions = style.id_regions(&style.id_map[0]);
        let names: Vec<_> = regions.iter().map(|region| region.names.clone()).collect();
        assert_eq!(
            names,
            [
                vec!["hair", "#ff0000"],
                vec!["coat", "#00ff00"],
                vec!["#0000ff"]
            ]
        );
        let width = |ids: &[String]| {
            let names = crate::PartNames {
                ids,
                ..crate::PartNames::default()
            };
            style.resolve(names).width_factor
        };
        let widths: Vec<f32> = regions.iter().map(|region| width(&region.names)).collect();
        assert_eq!(widths, [2.0, 3.0, 4.0]);
        assert_eq!(width(&[]), 5.0);
        assert_eq!(style.resolve_for("m", "o").width_factor, 5.0);
    }

    #[test]
    fn patterns_take_all_those_with_an_id_or_those_without() {
        let names = vec!["hair".to_owned(), "#ff0000".to_owned()];
        for pattern in ["*", "?*", "h*", "#ff0000", "#F00", "#ff*"] {
            assert!(matches(pattern, &names), "{pattern}");
        }
        for pattern in ["", "hai", "#ff0001", "#FF*"] {
            assert!(!matches(pattern, &names), "{pattern}");
        }
        assert!(matches("*", &[]) && matches("", &[]));
        assert!(!matches("?*", &[]) && !matches("hair", &[]));
    }

    #[test]
    fn what_is_written_is_read_again_and_parents_add_their_maps() {
        let style = read(&format!("{MAP}border = true\nobject = 'Hero*'")).unwrap();
        assert_eq!(read(&style.to_toml().unwrap()), Ok(style.clone()));
        assert_eq!(
            style.id_map_pictures(),
            [("id_map.0.image".to_owned(), "ids.png")]
        );
        let load = |_: &str| Ok(MAP.to_owned());
        let child =
            "extends = 'a.toml'\n[[id_map]]\nimage = 'more.png'\n[[rule]]\nmatch.id = 'hair'";
        let child = Style::from_toml(child, &load).unwrap();
        let images: Vec<_> = child.id_map.iter().map(|map| map.image.as_str()).collect();
        assert_eq!(images, ["ids.png", "more.png"]);
    }

    #[test]
    fn slips_are_told() {
        assert_eq!(
            reported(&format!("{MAP}[[rule]]\nmatch.id = 'hiar'")),
            "rule.0.match.id at line 5, column 7 is no id of an id_map; did you mean 'hair'?"
        );
        assert_eq!(
            reported("[[rule]]\nmatch.id = '#ff0000'"),
            "rule.0.match.id at line 2, column 7 names an id, but the style has no id_map"
        );
        for (slip, wanted) in [
            (
                "[[rule]]\nmatch.id = '#f00000zz'",
                "is no colour such as #ff8000",
            ),
            (
                "[[rule]]\nmatch.id = '#ff000080'",
                "is no colour such as #ff8000",
            ),
            ("[[id_map]]\nimage = ''", "names no file"),
            ("[[id_map]]\nids = []", "lacks 'image'"),
        ] {
            let reported = reported(&format!("{MAP}{slip}"));
            assert!(reported.ends_with(wanted), "{reported}");
        }
        for (id, wanted) in [
            (
                "{ name = '#a', color = 'red' }",
                "must not be empty, start with #, or have * or ? in it",
            ),
            ("{ name = 'a', color = '#ff000080' }", "must be opaque"),
            (
                "{ name = 'a', color = 'red' }, { name = 'b', color = '#f00' }",
                "is that of 'a' too",
            ),
            (
                "{ name = 'a', color = 'reddish' }",
                "is not a CSS colour such as #1e1a18 or saddlebrown",
            ),
        ] {
            let reported = reported(&format!("[[id_map]]\nimage = 'a.png'\nids = [{id}]"));
            assert!(reported.ends_with(wanted), "{reported}");
        }
    }
}
