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
    /// One line for lists.
    pub title: &'static str,
    /// The text of the style file, with a comment on every value.
    pub text: &'static str,
}

const PRESETS: &[Preset] = &[
    Preset {
        name: "toon",
        version: 4,
        title: "Three flat tones of the material's colour under dark brown lines",
        text: include_str!("../presets/toon.toml"),
    },
    Preset {
        name: "ink",
        version: 4,
        title: "Black swelling lines and solid shadows on warm white paper",
        text: include_str!("../presets/ink.toml"),
    },
    Preset {
        name: "g-pen",
        version: 4,
        title: "Nib lines that swell and run out to points, on white paper",
        text: include_str!("../presets/g-pen.toml"),
    },
    Preset {
        name: "technical",
        version: 4,
        title: "Thin even lines on plain white parts, with every crease",
        text: include_str!("../presets/technical.toml"),
    },
    Preset {
        name: "comic-silver",
        version: 3,
        title: "Flat colours, hatching that swells into solid ink, thick swelling outlines",
        text: include_str!("../presets/comic-silver.toml"),
    },
    Preset {
        name: "comic-modern",
        version: 5,
        title: "Soft gradients, thin even lines, small blacks and fine hatching",
        text: include_str!("../presets/comic-modern.toml"),
    },
    Preset {
        name: "comic-light",
        version: 3,
        title: "comic-silver, and materials named Beam* glow: lasers, flashes, explosions, trails",
        text: include_str!("../presets/comic-light.toml"),
    },
    Preset {
        name: "simple-comic",
        version: 4,
        title: "Cel colours, solid black shade, thick even outlines",
        text: include_str!("../presets/simple-comic.toml"),
    },
    Preset {
        name: "crosshatch",
        version: 3,
        title: "Pen strokes round the form, crossed in the dark, on white paper",
        text: include_str!("../presets/crosshatch.toml"),
    },
    Preset {
        name: "stipple",
        version: 3,
        title: "Dots set by hand, dense in the dark, with fine outlines",
        text: include_str!("../presets/stipple.toml"),
    },
    Preset {
        name: "pencil",
        version: 4,
        title: "Graphite on rough paper: shaky strokes, grey lines",
        text: include_str!("../presets/pencil.toml"),
    },
    Preset {
        name: "screentone",
        version: 3,
        title: "Manga page: dots in rows on the picture, solid blacks, clean lines",
        text: include_str!("../presets/screentone.toml"),
    },
    Preset {
        name: "inked",
        version: 3,
        title: "Flat colours under black brush strokes that swell and part where they end",
        text: include_str!("../presets/inked.toml"),
    },
    Preset {
        name: "manga",
        version: 3,
        title: "Nib lines that run out to points, over screen tone",
        text: include_str!("../presets/manga.toml"),
    },
    Preset {
        name: "brush",
        version: 3,
        title: "Broad strokes of a dry brush on rice paper",
        text: include_str!("../presets/brush.toml"),
    },
    Preset {
        name: "ink-wash",
        version: 3,
        title: "A dry brush over soft grey washes on rice paper",
        text: include_str!("../presets/ink-wash.toml"),
    },
    Preset {
        name: "sketch",
        version: 2,
        title: "Lines looked for again and again with a pencil, run on beyond corners",
        text: include_str!("../presets/sketch.toml"),
    },
    Preset {
        name: "pencil-outline",
        version: 3,
        title: "Flat cel colours under outlines scrawled with a soft pencil",
        text: include_str!("../presets/pencil-outline.toml"),
    },
    Preset {
        name: "charcoal",
        version: 2,
        title: "Broad crumbling lines and rubbed greys on laid paper",
        text: include_str!("../presets/charcoal.toml"),
    },
    Preset {
        name: "chalkboard",
        version: 3,
        title: "White chalk lines on a dark green board",
        text: include_str!("../presets/chalkboard.toml"),
    },
    Preset {
        name: "blueprint",
        version: 2,
        title: "White lines on Prussian blue that run on beyond corners",
        text: include_str!("../presets/blueprint.toml"),
    },
    Preset {
        name: "cel-2",
        version: 3,
        title: "Two flat tones under thin lines, as painted on a cel",
        text: include_str!("../presets/cel-2.toml"),
    },
    Preset {
        name: "cel-3",
        version: 3,
        title: "Two flat tones and a crisp highlight under thin lines",
        text: include_str!("../presets/cel-3.toml"),
    },
    Preset {
        name: "coloured-lines",
        version: 4,
        title: "Flat tones under lines in a deep shade of each surface's own colour",
        text: include_str!("../presets/coloured-lines.toml"),
    },
    Preset {
        name: "atmosphere",
        version: 4,
        title: "Flat tones under dark lines that pale and cool with distance",
        text: include_str!("../presets/atmosphere.toml"),
    },
    Preset {
        name: "lit-lines",
        version: 4,
        title: "Lines thin and warm where lit, heavy and cool in the shade, \
                bright where light from behind catches them",
        text: include_str!("../presets/lit-lines.toml"),
    },
    Preset {
        name: "night",
        version: 3,
        title: "Dark cel paint whose lines lift from dark backgrounds, just enough to read",
        text: include_str!("../presets/night.toml"),
    },
    Preset {
        name: "plain",
        version: 1,
        title: "Materials in soft light, without lines or ink",
        text: include_str!("../presets/plain.toml"),
    },
    Preset {
        name: "smoke-cel-2",
        version: 3,
        title: "Smoke in two tones under a dark line, as painted on a cel",
        text: include_str!("../presets/smoke-cel-2.toml"),
    },
    Preset {
        name: "smoke-cel-3",
        version: 3,
        title: "Smoke in three tones under a dark line",
        text: include_str!("../presets/smoke-cel-3.toml"),
    },
    Preset {
        name: "smoke-ink",
        version: 4,
        title: "Smoke in brush lines and solid blacks on white",
        text: include_str!("../presets/smoke-ink.toml"),
    },
    Preset {
        name: "smoke-comic",
        version: 3,
        title: "Smoke in pen strokes that swell into solid ink, as in comics",
        text: include_str!("../presets/smoke-comic.toml"),
    },
    Preset {
        name: "cloud",
        version: 3,
        title: "Bright clouds in four soft tones without lines",
        text: include_str!("../presets/cloud.toml"),
    },
    Preset {
        name: "explosion",
        version: 3,
        title: "Fire and smoke by heat: white heart, yellow, orange, soot",
        text: include_str!("../presets/explosion.toml"),
    },
    Preset {
        name: "okuya",
        version: 1,
        title: "Comparison: lines found on images and drawn on every edge, as published",
        text: include_str!("../presets/okuya.toml"),
    },
    Preset {
        name: "filter",
        version: 1,
        title: "Comparison: an image filter alone, one width everywhere",
        text: include_str!("../presets/filter.toml"),
    },
    Preset {
        name: "hull",
        version: 1,
        title: "Comparison: a back-face hull swelling with curvature, silhouettes only",
        text: include_str!("../presets/hull.toml"),
    },
    Preset {
        name: "filter-hull",
        version: 1,
        title: "Comparison: the union of image filter and hull",
        text: include_str!("../presets/filter-hull.toml"),
    },
];

/// Older versions of presets. A style that names such a version keeps its look.
const OLDER: &[Preset] = &[
    Preset {
        name: "atmosphere",
        version: 1,
        title: "Flat tones under dark lines that pale and cool with distance",
        text: include_str!("../presets/older/atmosphere-1.toml"),
    },
    Preset {
        name: "atmosphere",
        version: 2,
        title: "Flat tones under dark lines that pale and cool with distance",
        text: include_str!("../presets/older/atmosphere-2.toml"),
    },
    Preset {
        name: "atmosphere",
        version: 3,
        title: "Flat tones under dark lines that pale and cool with distance",
        text: include_str!("../presets/older/atmosphere-3.toml"),
    },
    Preset {
        name: "blueprint",
        version: 1,
        title: "White lines on Prussian blue that run on beyond corners",
        text: include_str!("../presets/older/blueprint-1.toml"),
    },
    Preset {
        name: "brush",
        version: 1,
        title: "Broad strokes of a dry brush on rice paper",
        text: include_str!("../presets/older/brush-1.toml"),
    },
    Preset {
        name: "brush",
        version: 2,
        title: "Broad strokes of a dry brush on rice paper",
        text: include_str!("../presets/older/brush-2.toml"),
    },
    Preset {
        name: "cel-2",
        version: 1,
        title: "Two flat tones under thin lines, as painted on a cel",
        text: include_str!("../presets/older/cel-2-1.toml"),
    },
    Preset {
        name: "cel-2",
        version: 2,
        title: "Two flat tones under thin lines, as painted on a cel",
        text: include_str!("../presets/older/cel-2-2.toml"),
    },
    Preset {
        name: "cel-3",
        version: 1,
        title: "Two flat tones and a crisp highlight under thin lines",
        text: include_str!("../presets/older/cel-3-1.toml"),
    },
    Preset {
        name: "cel-3",
        version: 2,
        title: "Two flat tones and a crisp highlight under thin lines",
        text: include_str!("../presets/older/cel-3-2.toml"),
    },
    Preset {
        name: "chalkboard",
        version: 1,
        title: "White chalk lines on a dark green board",
        text: include_str!("../presets/older/chalkboard-1.toml"),
    },
    Preset {
        name: "chalkboard",
        version: 2,
        title: "White chalk lines on a dark green board",
        text: include_str!("../presets/older/chalkboard-2.toml"),
    },
    Preset {
        name: "charcoal",
        version: 1,
        title: "Broad crumbling lines and rubbed greys on laid paper",
        text: include_str!("../presets/older/charcoal-1.toml"),
    },
    Preset {
        name: "cloud",
        version: 1,
        title: "Bright clouds in four soft tones without lines",
        text: include_str!("../presets/older/cloud-1.toml"),
    },
    Preset {
        name: "cloud",
        version: 2,
        title: "Bright clouds in four soft tones without lines",
        text: include_str!("../presets/older/cloud-2.toml"),
    },
    Preset {
        name: "coloured-lines",
        version: 1,
        title: "Flat tones under lines in a deep shade of each surface's own colour",
        text: include_str!("../presets/older/coloured-lines-1.toml"),
    },
    Preset {
        name: "coloured-lines",
        version: 2,
        title: "Flat tones under lines in a deep shade of each surface's own colour",
        text: include_str!("../presets/older/coloured-lines-2.toml"),
    },
    Preset {
        name: "coloured-lines",
        version: 3,
        title: "Flat tones under lines in a deep shade of each surface's own colour",
        text: include_str!("../presets/older/coloured-lines-3.toml"),
    },
    Preset {
        name: "comic-light",
        version: 1,
        title: "comic-silver, and materials named Beam* glow: lasers, flashes, explosions, trails",
        text: include_str!("../presets/older/comic-light-1.toml"),
    },
    Preset {
        name: "comic-light",
        version: 2,
        title: "comic-silver, and materials named Beam* glow: lasers, flashes, explosions, trails",
        text: include_str!("../presets/older/comic-light-2.toml"),
    },
    Preset {
        name: "comic-modern",
        version: 1,
        title: "Soft gradients, thin lines, small blacks and fine hatching",
        text: include_str!("../presets/older/comic-modern-1.toml"),
    },
    Preset {
        name: "comic-modern",
        version: 2,
        title: "Soft gradients, thin even lines, small blacks and fine hatching",
        text: include_str!("../presets/older/comic-modern-2.toml"),
    },
    Preset {
        name: "comic-modern",
        version: 3,
        title: "Soft gradients, thin even lines, small blacks and fine hatching",
        text: include_str!("../presets/older/comic-modern-3.toml"),
    },
    Preset {
        name: "comic-modern",
        version: 4,
        title: "Soft gradients, thin even lines, small blacks and fine hatching",
        text: include_str!("../presets/older/comic-modern-4.toml"),
    },
    Preset {
        name: "comic-silver",
        version: 1,
        title: "Flat colours, hatching that swells into solid ink, thick swelling outlines",
        text: include_str!("../presets/older/comic-silver-1.toml"),
    },
    Preset {
        name: "comic-silver",
        version: 2,
        title: "Flat colours, hatching that swells into solid ink, thick swelling outlines",
        text: include_str!("../presets/older/comic-silver-2.toml"),
    },
    Preset {
        name: "crosshatch",
        version: 1,
        title: "Pen strokes round the form, crossed in the dark, on white paper",
        text: include_str!("../presets/older/crosshatch-1.toml"),
    },
    Preset {
        name: "crosshatch",
        version: 2,
        title: "Pen strokes round the form, crossed in the dark, on white paper",
        text: include_str!("../presets/older/crosshatch-2.toml"),
    },
    Preset {
        name: "explosion",
        version: 1,
        title: "Fire and smoke by heat: white heart, yellow, orange, soot",
        text: include_str!("../presets/older/explosion-1.toml"),
    },
    Preset {
        name: "explosion",
        version: 2,
        title: "Fire and smoke by heat: white heart, yellow, orange, soot",
        text: include_str!("../presets/older/explosion-2.toml"),
    },
    Preset {
        name: "g-pen",
        version: 1,
        title: "Nib lines that swell and run out to points, on white paper",
        text: include_str!("../presets/older/g-pen-1.toml"),
    },
    Preset {
        name: "g-pen",
        version: 2,
        title: "Nib lines that swell and run out to points, on white paper",
        text: include_str!("../presets/older/g-pen-2.toml"),
    },
    Preset {
        name: "g-pen",
        version: 3,
        title: "Nib lines that swell and run out to points, on white paper",
        text: include_str!("../presets/older/g-pen-3.toml"),
    },
    Preset {
        name: "ink",
        version: 1,
        title: "Black swelling lines and solid shadows on warm white paper",
        text: include_str!("../presets/older/ink-1.toml"),
    },
    Preset {
        name: "ink",
        version: 2,
        title: "Black swelling lines and solid shadows on warm white paper",
        text: include_str!("../presets/older/ink-2.toml"),
    },
    Preset {
        name: "ink",
        version: 3,
        title: "Black swelling lines and solid shadows on warm white paper",
        text: include_str!("../presets/older/ink-3.toml"),
    },
    Preset {
        name: "ink-wash",
        version: 1,
        title: "A dry brush over soft grey washes on rice paper",
        text: include_str!("../presets/older/ink-wash-1.toml"),
    },
    Preset {
        name: "ink-wash",
        version: 2,
        title: "A dry brush over soft grey washes on rice paper",
        text: include_str!("../presets/older/ink-wash-2.toml"),
    },
    Preset {
        name: "inked",
        version: 1,
        title: "Flat colours under black brush strokes that swell and part where they end",
        text: include_str!("../presets/older/inked-1.toml"),
    },
    Preset {
        name: "inked",
        version: 2,
        title: "Flat colours under black brush strokes that swell and part where they end",
        text: include_str!("../presets/older/inked-2.toml"),
    },
    Preset {
        name: "lit-lines",
        version: 1,
        title: "Lines thin and warm where lit, heavy and cool in the shade, bright where light from \
                behind catches them",
        text: include_str!("../presets/older/lit-lines-1.toml"),
    },
    Preset {
        name: "lit-lines",
        version: 2,
        title: "Lines thin and warm where lit, heavy and cool in the shade, \
                bright where light from behind catches them",
        text: include_str!("../presets/older/lit-lines-2.toml"),
    },
    Preset {
        name: "lit-lines",
        version: 3,
        title: "Lines thin and warm where lit, heavy and cool in the shade, \
                bright where light from behind catches them",
        text: include_str!("../presets/older/lit-lines-3.toml"),
    },
    Preset {
        name: "manga",
        version: 1,
        title: "Nib lines that run out to points, over screen tone",
        text: include_str!("../presets/older/manga-1.toml"),
    },
    Preset {
        name: "manga",
        version: 2,
        title: "Nib lines that run out to points, over screen tone",
        text: include_str!("../presets/older/manga-2.toml"),
    },
    Preset {
        name: "night",
        version: 1,
        title: "Dark cel paint whose lines lift from dark backgrounds, just enough to read",
        text: include_str!("../presets/older/night-1.toml"),
    },
    Preset {
        name: "night",
        version: 2,
        title: "Dark cel paint whose lines lift from dark backgrounds, just enough to read",
        text: include_str!("../presets/older/night-2.toml"),
    },
    Preset {
        name: "pencil",
        version: 1,
        title: "Graphite on rough paper: shaky strokes, grey lines",
        text: include_str!("../presets/older/pencil-1.toml"),
    },
    Preset {
        name: "pencil",
        version: 2,
        title: "Graphite on rough paper: shaky strokes, grey lines",
        text: include_str!("../presets/older/pencil-2.toml"),
    },
    Preset {
        name: "pencil",
        version: 3,
        title: "Graphite on rough paper: shaky strokes, grey lines",
        text: include_str!("../presets/older/pencil-3.toml"),
    },
    Preset {
        name: "pencil-outline",
        version: 1,
        title: "Flat cel colours under outlines scrawled with a soft pencil",
        text: include_str!("../presets/older/pencil-outline-1.toml"),
    },
    Preset {
        name: "pencil-outline",
        version: 2,
        title: "Flat cel colours under outlines scrawled with a soft pencil",
        text: include_str!("../presets/older/pencil-outline-2.toml"),
    },
    Preset {
        name: "screentone",
        version: 1,
        title: "Manga page: dots in rows on the picture, solid blacks, clean lines",
        text: include_str!("../presets/older/screentone-1.toml"),
    },
    Preset {
        name: "screentone",
        version: 2,
        title: "Manga page: dots in rows on the picture, solid blacks, clean lines",
        text: include_str!("../presets/older/screentone-2.toml"),
    },
    Preset {
        name: "simple-comic",
        version: 1,
        title: "Cel colours, solid black shade, thick even outlines",
        text: include_str!("../presets/older/simple-comic-1.toml"),
    },
    Preset {
        name: "simple-comic",
        version: 2,
        title: "Cel colours, solid black shade, thick even outlines",
        text: include_str!("../presets/older/simple-comic-2.toml"),
    },
    Preset {
        name: "simple-comic",
        version: 3,
        title: "Cel colours, solid black shade, thick even outlines",
        text: include_str!("../presets/older/simple-comic-3.toml"),
    },
    Preset {
        name: "sketch",
        version: 1,
        title: "Lines looked for again and again with a pencil, run on beyond corners",
        text: include_str!("../presets/older/sketch-1.toml"),
    },
    Preset {
        name: "smoke-cel-2",
        version: 1,
        title: "Smoke in two tones under a dark line, as painted on a cel",
        text: include_str!("../presets/older/smoke-cel-2-1.toml"),
    },
    Preset {
        name: "smoke-cel-2",
        version: 2,
        title: "Smoke in two tones under a dark line, as painted on a cel",
        text: include_str!("../presets/older/smoke-cel-2-2.toml"),
    },
    Preset {
        name: "smoke-cel-3",
        version: 1,
        title: "Smoke in three tones under a dark line",
        text: include_str!("../presets/older/smoke-cel-3-1.toml"),
    },
    Preset {
        name: "smoke-cel-3",
        version: 2,
        title: "Smoke in three tones under a dark line",
        text: include_str!("../presets/older/smoke-cel-3-2.toml"),
    },
    Preset {
        name: "smoke-comic",
        version: 1,
        title: "Smoke in pen strokes that swell into solid ink, as in comics",
        text: include_str!("../presets/older/smoke-comic-1.toml"),
    },
    Preset {
        name: "smoke-comic",
        version: 2,
        title: "Smoke in pen strokes that swell into solid ink, as in comics",
        text: include_str!("../presets/older/smoke-comic-2.toml"),
    },
    Preset {
        name: "smoke-ink",
        version: 1,
        title: "Smoke in brush lines and solid blacks on white",
        text: include_str!("../presets/older/smoke-ink-1.toml"),
    },
    Preset {
        name: "smoke-ink",
        version: 2,
        title: "Smoke in brush lines and solid blacks on white",
        text: include_str!("../presets/older/smoke-ink-2.toml"),
    },
    Preset {
        name: "smoke-ink",
        version: 3,
        title: "Smoke in brush lines and solid blacks on white",
        text: include_str!("../presets/older/smoke-ink-3.toml"),
    },
    Preset {
        name: "stipple",
        version: 1,
        title: "Dots set by hand, dense in the dark, with fine outlines",
        text: include_str!("../presets/older/stipple-1.toml"),
    },
    Preset {
        name: "stipple",
        version: 2,
        title: "Dots set by hand, dense in the dark, with fine outlines",
        text: include_str!("../presets/older/stipple-2.toml"),
    },
    Preset {
        name: "technical",
        version: 1,
        title: "Thin even lines on plain white parts, with every crease",
        text: include_str!("../presets/older/technical-1.toml"),
    },
    Preset {
        name: "technical",
        version: 2,
        title: "Thin even lines on plain white parts, with every crease",
        text: include_str!("../presets/older/technical-2.toml"),
    },
    Preset {
        name: "technical",
        version: 3,
        title: "Thin even lines on plain white parts, with every crease",
        text: include_str!("../presets/older/technical-3.toml"),
    },
    Preset {
        name: "toon",
        version: 1,
        title: "Three flat tones of the material's colour under dark brown lines",
        text: include_str!("../presets/older/toon-1.toml"),
    },
    Preset {
        name: "toon",
        version: 2,
        title: "Three flat tones of the material's colour under dark brown lines",
        text: include_str!("../presets/older/toon-2.toml"),
    },
    Preset {
        name: "toon",
        version: 3,
        title: "Three flat tones of the material's colour under dark brown lines",
        text: include_str!("../presets/older/toon-3.toml"),
    },
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
                    (version, found.title)
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

    /// Versions that are older, and leave out short lines as the newest do.
    const WITHOUT_STUBS: [(&str, u32); 16] = [
        ("atmosphere", 3),
        ("brush", 2),
        ("chalkboard", 2),
        ("coloured-lines", 3),
        ("comic-modern", 4),
        ("g-pen", 3),
        ("ink", 3),
        ("ink-wash", 2),
        ("inked", 2),
        ("lit-lines", 3),
        ("manga", 2),
        ("pencil-outline", 2),
        ("simple-comic", 3),
        ("smoke-ink", 3),
        ("technical", 3),
        ("toon", 3),
    ];

    #[test]
    fn versions_from_before_stubs_draw_all_short_lines() {
        let leaves_out = |older: &&Preset| WITHOUT_STUBS.contains(&(older.name, older.version));
        for older in OLDER.iter().filter(|older| !leaves_out(older)) {
            let name = format!("{}@{}", older.name, older.version);
            let line = Style::preset(&name).expect("a preset").line;
            let lengths = [line.crease_least, line.least].map(|length| length.value);
            assert_eq!((line.crease_slack_deg, lengths), (0.0, [0.0; 2]), "{name}");
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
