//! The presets: styles that come with the program.

use crate::error::StyleError;
use crate::nearest::nearest;

/// Name of the preset for pictures without a chosen style.
pub const DEFAULT_PRESET: &str = "toon";

/// A built-in style with a stable name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preset {
    /// Name by which it is asked for, alone or followed by `@version`.
    pub name: &'static str,
    /// Version of the look; raised whenever its pictures change.
    pub version: u32,
    /// The text of the style file, with a comment on every value.
    pub text: &'static str,
}

impl Preset {
    /// One line for lists: the title in its text.
    pub fn title(&self) -> &'static str {
        let named = self
            .text
            .lines()
            .find_map(|line| line.strip_prefix("title = \""));
        named
            .and_then(|rest| rest.strip_suffix('"'))
            .unwrap_or_default()
    }
}

/// A list of presets: name, version and file of each.
macro_rules! presets {
    ($($name:literal $version:literal $file:literal),* $(,)?) => {
        &[$(Preset {
            name: $name,
            version: $version,
            text: include_str!($file),
        }),*]
    };
}

/// The newest version of every preset, in the order of lists.
const PRESETS: &[Preset] = presets![
    "toon" 5 "../presets/toon.toml",
    "ink" 9 "../presets/ink.toml",
    "g-pen" 6 "../presets/g-pen.toml",
    "technical" 6 "../presets/technical.toml",
    "comic-silver" 5 "../presets/comic-silver.toml",
    "comic-modern" 7 "../presets/comic-modern.toml",
    "comic-light" 5 "../presets/comic-light.toml",
    "simple-comic" 6 "../presets/simple-comic.toml",
    "crosshatch" 5 "../presets/crosshatch.toml",
    "stipple" 5 "../presets/stipple.toml",
    "pencil" 7 "../presets/pencil.toml",
    "screentone" 5 "../presets/screentone.toml",
    "inked" 4 "../presets/inked.toml",
    "manga" 5 "../presets/manga.toml",
    "speed" 1 "../presets/speed.toml",
    "brush" 6 "../presets/brush.toml",
    "ink-wash" 6 "../presets/ink-wash.toml",
    "sketch" 4 "../presets/sketch.toml",
    "pencil-outline" 5 "../presets/pencil-outline.toml",
    "charcoal" 4 "../presets/charcoal.toml",
    "chalkboard" 6 "../presets/chalkboard.toml",
    "blueprint" 4 "../presets/blueprint.toml",
    "cel-2" 4 "../presets/cel-2.toml",
    "cel-3" 4 "../presets/cel-3.toml",
    "coloured-lines" 5 "../presets/coloured-lines.toml",
    "atmosphere" 5 "../presets/atmosphere.toml",
    "lit-lines" 5 "../presets/lit-lines.toml",
    "night" 4 "../presets/night.toml",
    "plain" 2 "../presets/plain.toml",
    "mtoon" 1 "../presets/mtoon.toml",
    "smoke-cel-2" 4 "../presets/smoke-cel-2.toml",
    "smoke-cel-3" 4 "../presets/smoke-cel-3.toml",
    "smoke-ink" 6 "../presets/smoke-ink.toml",
    "smoke-comic" 5 "../presets/smoke-comic.toml",
    "cloud" 4 "../presets/cloud.toml",
    "explosion" 4 "../presets/explosion.toml",
    "okuya" 1 "../presets/okuya.toml",
    "filter" 1 "../presets/filter.toml",
    "hull" 1 "../presets/hull.toml",
    "filter-hull" 1 "../presets/filter-hull.toml",
];

/// Versions that are no longer the newest, by name.
const OLDER: &[Preset] = presets![
    "atmosphere" 1 "../presets/older/atmosphere-1.toml",
    "atmosphere" 2 "../presets/older/atmosphere-2.toml",
    "atmosphere" 3 "../presets/older/atmosphere-3.toml",
    "atmosphere" 4 "../presets/older/atmosphere-4.toml",
    "blueprint" 1 "../presets/older/blueprint-1.toml",
    "blueprint" 2 "../presets/older/blueprint-2.toml",
    "blueprint" 3 "../presets/older/blueprint-3.toml",
    "brush" 1 "../presets/older/brush-1.toml",
    "brush" 2 "../presets/older/brush-2.toml",
    "brush" 3 "../presets/older/brush-3.toml",
    "brush" 4 "../presets/older/brush-4.toml",
    "brush" 5 "../presets/older/brush-5.toml",
    "cel-2" 1 "../presets/older/cel-2-1.toml",
    "cel-2" 2 "../presets/older/cel-2-2.toml",
    "cel-2" 3 "../presets/older/cel-2-3.toml",
    "cel-3" 1 "../presets/older/cel-3-1.toml",
    "cel-3" 2 "../presets/older/cel-3-2.toml",
    "cel-3" 3 "../presets/older/cel-3-3.toml",
    "chalkboard" 1 "../presets/older/chalkboard-1.toml",
    "chalkboard" 2 "../presets/older/chalkboard-2.toml",
    "chalkboard" 3 "../presets/older/chalkboard-3.toml",
    "chalkboard" 4 "../presets/older/chalkboard-4.toml",
    "chalkboard" 5 "../presets/older/chalkboard-5.toml",
    "charcoal" 1 "../presets/older/charcoal-1.toml",
    "charcoal" 2 "../presets/older/charcoal-2.toml",
    "charcoal" 3 "../presets/older/charcoal-3.toml",
    "cloud" 1 "../presets/older/cloud-1.toml",
    "cloud" 2 "../presets/older/cloud-2.toml",
    "cloud" 3 "../presets/older/cloud-3.toml",
    "coloured-lines" 1 "../presets/older/coloured-lines-1.toml",
    "coloured-lines" 2 "../presets/older/coloured-lines-2.toml",
    "coloured-lines" 3 "../presets/older/coloured-lines-3.toml",
    "coloured-lines" 4 "../presets/older/coloured-lines-4.toml",
    "comic-light" 1 "../presets/older/comic-light-1.toml",
    "comic-light" 2 "../presets/older/comic-light-2.toml",
    "comic-light" 3 "../presets/older/comic-light-3.toml",
    "comic-light" 4 "../presets/older/comic-light-4.toml",
    "comic-modern" 1 "../presets/older/comic-modern-1.toml",
    "comic-modern" 2 "../presets/older/comic-modern-2.toml",
    "comic-modern" 3 "../presets/older/comic-modern-3.toml",
    "comic-modern" 4 "../presets/older/comic-modern-4.toml",
    "comic-modern" 5 "../presets/older/comic-modern-5.toml",
    "comic-modern" 6 "../presets/older/comic-modern-6.toml",
    "comic-silver" 1 "../presets/older/comic-silver-1.toml",
    "comic-silver" 2 "../presets/older/comic-silver-2.toml",
    "comic-silver" 3 "../presets/older/comic-silver-3.toml",
    "comic-silver" 4 "../presets/older/comic-silver-4.toml",
    "crosshatch" 1 "../presets/older/crosshatch-1.toml",
    "crosshatch" 2 "../presets/older/crosshatch-2.toml",
    "crosshatch" 3 "../presets/older/crosshatch-3.toml",
    "crosshatch" 4 "../presets/older/crosshatch-4.toml",
    "explosion" 1 "../presets/older/explosion-1.toml",
    "explosion" 2 "../presets/older/explosion-2.toml",
    "explosion" 3 "../presets/older/explosion-3.toml",
    "g-pen" 1 "../presets/older/g-pen-1.toml",
    "g-pen" 2 "../presets/older/g-pen-2.toml",
    "g-pen" 3 "../presets/older/g-pen-3.toml",
    "g-pen" 4 "../presets/older/g-pen-4.toml",
    "g-pen" 5 "../presets/older/g-pen-5.toml",
    "ink" 1 "../presets/older/ink-1.toml",
    "ink" 2 "../presets/older/ink-2.toml",
    "ink" 3 "../presets/older/ink-3.toml",
    "ink" 4 "../presets/older/ink-4.toml",
    "ink" 5 "../presets/older/ink-5.toml",
    "ink" 6 "../presets/older/ink-6.toml",
    "ink" 7 "../presets/older/ink-7.toml",
    "ink" 8 "../presets/older/ink-8.toml",
    "ink-wash" 1 "../presets/older/ink-wash-1.toml",
    "ink-wash" 2 "../presets/older/ink-wash-2.toml",
    "ink-wash" 3 "../presets/older/ink-wash-3.toml",
    "ink-wash" 4 "../presets/older/ink-wash-4.toml",
    "ink-wash" 5 "../presets/older/ink-wash-5.toml",
    "inked" 1 "../presets/older/inked-1.toml",
    "inked" 2 "../presets/older/inked-2.toml",
    "inked" 3 "../presets/older/inked-3.toml",
    "lit-lines" 1 "../presets/older/lit-lines-1.toml",
    "lit-lines" 2 "../presets/older/lit-lines-2.toml",
    "lit-lines" 3 "../presets/older/lit-lines-3.toml",
    "lit-lines" 4 "../presets/older/lit-lines-4.toml",
    "manga" 1 "../presets/older/manga-1.toml",
    "manga" 2 "../presets/older/manga-2.toml",
    "manga" 3 "../presets/older/manga-3.toml",
    "manga" 4 "../presets/older/manga-4.toml",
    "night" 1 "../presets/older/night-1.toml",
    "night" 2 "../presets/older/night-2.toml",
    "night" 3 "../presets/older/night-3.toml",
    "pencil" 1 "../presets/older/pencil-1.toml",
    "pencil" 2 "../presets/older/pencil-2.toml",
    "pencil" 3 "../presets/older/pencil-3.toml",
    "pencil" 4 "../presets/older/pencil-4.toml",
    "pencil" 5 "../presets/older/pencil-5.toml",
    "pencil" 6 "../presets/older/pencil-6.toml",
    "pencil-outline" 1 "../presets/older/pencil-outline-1.toml",
    "pencil-outline" 2 "../presets/older/pencil-outline-2.toml",
    "pencil-outline" 3 "../presets/older/pencil-outline-3.toml",
    "pencil-outline" 4 "../presets/older/pencil-outline-4.toml",
    "plain" 1 "../presets/older/plain-1.toml",
    "screentone" 1 "../presets/older/screentone-1.toml",
    "screentone" 2 "../presets/older/screentone-2.toml",
    "screentone" 3 "../presets/older/screentone-3.toml",
    "screentone" 4 "../presets/older/screentone-4.toml",
    "simple-comic" 1 "../presets/older/simple-comic-1.toml",
    "simple-comic" 2 "../presets/older/simple-comic-2.toml",
    "simple-comic" 3 "../presets/older/simple-comic-3.toml",
    "simple-comic" 4 "../presets/older/simple-comic-4.toml",
    "simple-comic" 5 "../presets/older/simple-comic-5.toml",
    "sketch" 1 "../presets/older/sketch-1.toml",
    "sketch" 2 "../presets/older/sketch-2.toml",
    "sketch" 3 "../presets/older/sketch-3.toml",
    "smoke-cel-2" 1 "../presets/older/smoke-cel-2-1.toml",
    "smoke-cel-2" 2 "../presets/older/smoke-cel-2-2.toml",
    "smoke-cel-2" 3 "../presets/older/smoke-cel-2-3.toml",
    "smoke-cel-3" 1 "../presets/older/smoke-cel-3-1.toml",
    "smoke-cel-3" 2 "../presets/older/smoke-cel-3-2.toml",
    "smoke-cel-3" 3 "../presets/older/smoke-cel-3-3.toml",
    "smoke-comic" 1 "../presets/older/smoke-comic-1.toml",
    "smoke-comic" 2 "../presets/older/smoke-comic-2.toml",
    "smoke-comic" 3 "../presets/older/smoke-comic-3.toml",
    "smoke-comic" 4 "../presets/older/smoke-comic-4.toml",
    "smoke-ink" 1 "../presets/older/smoke-ink-1.toml",
    "smoke-ink" 2 "../presets/older/smoke-ink-2.toml",
    "smoke-ink" 3 "../presets/older/smoke-ink-3.toml",
    "smoke-ink" 4 "../presets/older/smoke-ink-4.toml",
    "smoke-ink" 5 "../presets/older/smoke-ink-5.toml",
    "stipple" 1 "../presets/older/stipple-1.toml",
    "stipple" 2 "../presets/older/stipple-2.toml",
    "stipple" 3 "../presets/older/stipple-3.toml",
    "stipple" 4 "../presets/older/stipple-4.toml",
    "technical" 1 "../presets/older/technical-1.toml",
    "technical" 2 "../presets/older/technical-2.toml",
    "technical" 3 "../presets/older/technical-3.toml",
    "technical" 4 "../presets/older/technical-4.toml",
    "technical" 5 "../presets/older/technical-5.toml",
    "toon" 1 "../presets/older/toon-1.toml",
    "toon" 2 "../presets/older/toon-2.toml",
    "toon" 3 "../presets/older/toon-3.toml",
    "toon" 4 "../presets/older/toon-4.toml",
];

/// Every preset in its newest version, those for everyday use first.
pub fn presets() -> &'static [Preset] {
    PRESETS
}

/// Whether `name`, without its version, is a preset's.
pub(crate) fn is_name(name: &str) -> bool {
    let bare = name.split_once('@').map_or(name, |(bare, _)| bare);
    PRESETS.iter().any(|preset| preset.name == bare)
}

/// The preset called `name`, or `name@version`; without a version the newest.
///
/// # Errors
///
/// [`StyleError::UnknownPreset`] or [`StyleError::PresetVersion`].
pub fn find(name: &str) -> Result<&'static Preset, StyleError> {
    // Find the preset in its newest version.
    let (bare, version) = name
        .split_once('@')
        .map_or((name, None), |(bare, version)| (bare, Some(version)));
    let newest = PRESETS
        .iter()
        .find(|preset| preset.name == bare)
        .ok_or_else(|| StyleError::UnknownPreset {
            name: name.to_owned(),
            nearest: nearest(bare, PRESETS.iter().map(|preset| preset.name)).map(str::to_owned),
        })?;

    // Look for the version that is asked for, where one is.
    let Some(asked) = version else {
        return Ok(newest);
    };
    let mut versions = OLDER.iter().chain([newest]);
    let is_asked = |preset: &&Preset| preset.name == bare && asked.parse() == Ok(preset.version);
    versions
        .find(is_asked)
        .ok_or_else(|| StyleError::PresetVersion {
            name: newest.name,
            asked: asked.to_owned(),
            newest: newest.version,
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Follow, Mapping, PartNames, Tone};
    use crate::{OutlineMethod, Style, WidthSource};

    #[test]
    fn every_version_up_to_the_newest_is_there() {
        for preset in PRESETS {
            for version in 1..=preset.version {
                let name = format!("{}@{version}", preset.name);
                let found = find(&name).unwrap_or_else(|error| panic!("{name}: {error}"));
                assert_eq!((found.name, found.version), (preset.name, version));
                let style = Style::preset(&name).unwrap_or_else(|error| panic!("{name}: {error}"));
                assert_eq!(
                    (style.version, style.title.as_str()),
                    (version, found.title())
                );
            }
            assert_eq!(
                find(preset.name),
                Ok(preset),
                "without a version the newest"
            );
            for version in ["0", "99", "", "x", "1.0"] {
                let fault = find(&format!("{}@{version}", preset.name));
                assert!(
                    matches!(fault, Err(StyleError::PresetVersion { .. })),
                    "{version}"
                );
            }
        }
    }

    /// The last version from before strokes, of presets where that was not the first.
    const LAST_WITHOUT_STROKES: [(&str, u32); 11] = [
        ("blueprint", 0),
        ("brush", 0),
        ("chalkboard", 0),
        ("charcoal", 0),
        ("comic-modern", 2),
        ("g-pen", 0),
        ("ink-wash", 0),
        ("inked", 0),
        ("manga", 0),
        ("pencil-outline", 0),
        ("sketch", 0),
    ];

    /// Versions that drew strokes, with a pen where the next ones have brushes.
    const WITH_PENS: [(&str, u32); 2] = [("g-pen", 1), ("pencil", 2)];

    #[test]
    fn versions_from_before_strokes_have_none() {
        let line_of = |name: &str| Style::preset(name).expect("a preset").line;
        for older in OLDER {
            let line = line_of(&format!("{}@{}", older.name, older.version));
            let last = LAST_WITHOUT_STROKES
                .iter()
                .find(|(name, _)| *name == older.name)
                .map_or(1, |(_, version)| *version);
            let newest = line_of(older.name);
            if newest.method == OutlineMethod::Off {
                assert_eq!(line.method, OutlineMethod::Off, "{}", older.name);
                continue;
            }
            if older.version <= last {
                assert_eq!(line.method, OutlineMethod::Shape, "{}", older.name);
                assert!(line.brush.is_pen(), "{}", older.name);
            } else {
                assert_eq!(line.method, OutlineMethod::Strokes, "{}", older.name);
                let had_pen = WITH_PENS.contains(&(older.name, older.version));
                let is_pen = had_pen || newest.brush.is_pen();
                assert_eq!(line.brush.is_pen(), is_pen, "{}", older.name);
                assert!(!(had_pen && newest.brush.is_pen()), "{}", older.name);
            }
            assert_eq!(newest.method, OutlineMethod::Strokes, "{}", older.name);
        }
        for preset in PRESETS {
            assert_ne!(
                line_of(preset.name).method,
                OutlineMethod::Shape,
                "{}",
                preset.name
            );
        }
    }

    /// Whether a preset is of the version that a table names first for it, or of a later one.
    fn is_since(firsts: &[(&str, u32)], preset: &Preset) -> bool {
        let mut firsts = firsts.iter();
        firsts.any(|(name, first)| *name == preset.name && *first <= preset.version)
    }

    /// The first version of every preset that leaves out short lines, where there was one that did not.
    const FIRST_WITHOUT_STUBS: [(&str, u32); 34] = [
        ("atmosphere", 3),
        ("blueprint", 2),
        ("brush", 2),
        ("cel-2", 3),
        ("cel-3", 3),
        ("chalkboard", 2),
        ("charcoal", 2),
        ("cloud", 3),
        ("coloured-lines", 3),
        ("comic-light", 3),
        ("comic-modern", 4),
        ("comic-silver", 3),
        ("crosshatch", 3),
        ("explosion", 3),
        ("g-pen", 3),
        ("ink", 3),
        ("ink-wash", 2),
        ("inked", 2),
        ("lit-lines", 3),
        ("manga", 2),
        ("night", 3),
        ("pencil", 4),
        ("pencil-outline", 2),
        ("plain", 1),
        ("screentone", 3),
        ("simple-comic", 3),
        ("sketch", 2),
        ("smoke-cel-2", 3),
        ("smoke-cel-3", 3),
        ("smoke-comic", 3),
        ("smoke-ink", 3),
        ("stipple", 3),
        ("technical", 3),
        ("toon", 3),
    ];

    #[test]
    fn versions_from_before_stubs_draw_all_short_lines() {
        for older in OLDER
            .iter()
            .filter(|older| !is_since(&FIRST_WITHOUT_STUBS, older))
        {
            let name = format!("{}@{}", older.name, older.version);
            let line = Style::preset(&name).expect("a preset").line;
            let lengths = [line.crease_least, line.least].map(|length| length.value);
            assert_eq!((line.crease_slack_deg, lengths), (0.0, [0.0; 2]), "{name}");
        }
    }

    /// The first version of presets with calm tones and rounded edges, where a newer one came after it.
    const FIRST_CALM: [(&str, u32); 21] = [
        ("blueprint", 3),
        ("brush", 4),
        ("chalkboard", 4),
        ("charcoal", 3),
        ("comic-light", 4),
        ("comic-modern", 6),
        ("comic-silver", 4),
        ("crosshatch", 4),
        ("g-pen", 5),
        ("ink", 5),
        ("ink-wash", 4),
        ("manga", 4),
        ("pencil", 5),
        ("screentone", 4),
        ("pencil-outline", 4),
        ("simple-comic", 5),
        ("sketch", 3),
        ("smoke-comic", 4),
        ("smoke-ink", 5),
        ("stipple", 4),
        ("technical", 5),
    ];

    /// The last version of presets that left painted eyes empty.
    const LAST_WITHOUT_EYES: [(&str, u32); 6] = [
        ("brush", 4),
        ("chalkboard", 4),
        ("charcoal", 3),
        ("g-pen", 5),
        ("ink-wash", 4),
        ("sketch", 3),
    ];

    #[test]
    fn versions_from_before_calm_tones_and_rounded_edges_have_neither() {
        for older in OLDER.iter().filter(|older| !is_since(&FIRST_CALM, older)) {
            let style =
                Style::preset(&format!("{}@{}", older.name, older.version)).expect("a preset");
            let both = [style.shade.calm, style.line.crease_round];
            assert_eq!(
                style.line.crease_hard_deg, 180.0,
                "{}@{}",
                older.name, older.version
            );
            assert_eq!(both, [0.0; 2], "{}@{}", older.name, older.version);
        }
        let toon = Style::preset("toon").expect("a preset");
        assert!(toon.shade.calm > 0.0 && toon.line.crease_round > 0.0);
    }

    /// The first version of presets whose hatching follows limbs and spares faces, where a newer one came after it.
    const FIRST_ON_LIMBS: [(&str, u32); 1] = [("pencil", 6)];

    #[test]
    fn versions_from_before_limbs_and_faces_hatch_as_they_did() {
        let hatch = |name: &str| {
            let ink = Style::preset(name).expect("a preset").ink;
            let follows = ink.mapping == Mapping::Surface && ink.follow == Follow::Limbs;
            let is_drawn = !matches!(ink.tone, Tone::Off | Tone::Ink);
            is_drawn.then_some((follows, ink.faces < 1.0))
        };
        for older in OLDER {
            let name = format!("{}@{}", older.name, older.version);
            let is_on_limbs = is_since(&FIRST_ON_LIMBS, older);
            let is_as_then = |found| found == (is_on_limbs, is_on_limbs);
            assert!(hatch(&name).is_none_or(is_as_then), "{name}");
        }
        assert_eq!(hatch("comic-silver"), Some((true, true)));
    }

    #[test]
    fn dark_paint_of_faces_is_ink_from_a_version_on() {
        let inks_faces = |name: &str| {
            let style = Style::preset(name).expect("a preset");
            let names = PartNames {
                material: "F00_Face",
                object: "figure",
                ids: &[],
            };
            style.resolve(names).ink.paint > 0.0
        };
        for (name, version) in LAST_WITHOUT_EYES {
            assert!(inks_faces(name), "{name}");
            assert!(!inks_faces(&format!("{name}@{version}")), "{name}");
        }
    }

    /// A preset that extends another without a version would change with it, and keep its own version.
    #[test]
    fn presets_extend_the_newest_versions_by_their_numbers() {
        for preset in PRESETS.iter().chain(OLDER) {
            let table: toml::Table = preset.text.parse().expect("a table");
            let Some(parent) = table.get("extends").and_then(toml::Value::as_str) else {
                continue;
            };
            let (name, version) = parent.split_once('@').expect("a version");
            let is_newest = PRESETS.contains(preset);
            let newest = find(name).expect("a preset").version.to_string();
            assert!(
                !is_newest || version == newest,
                "{} extends {parent}: raise its version, too",
                preset.name
            );
        }
    }

    #[test]
    fn an_older_version_keeps_its_look() {
        let width = |name: &str| Style::preset(name).expect("a preset").line.width;
        let [old, new] = ["comic-modern@1", "comic-modern"].map(width);
        assert_eq!(
            (old.source, old.min, old.max),
            (WidthSource::ProjectedCurvature, 0.6, 1.3)
        );
        assert_eq!(
            (new.source, new.min, new.max),
            (WidthSource::Constant, 1.0, 1.0)
        );
    }
}
