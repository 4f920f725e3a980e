//! Keys of smoke without effect without another key, or for the methods for comparison.

use super::entry::{Entry, entry};
use crate::{SmokeLines, SmokeMethod, SmokeParticles, Tone};

/// Keys of smoke.
pub(super) const ENTRIES: &[Entry] = &[
    // These keys of smoke depend on another key, or the methods for comparison do not use them.
    entry(
        &[
            "smoke.sigma",
            "smoke.layers",
            "smoke.layer_depth",
            "smoke.layer_blend",
            "smoke.shadow",
            "smoke.shadow_px",
            "smoke.casts",
            "smoke.softness",
            "smoke.wrap",
            "smoke.ambient",
            "smoke.heat",
            "smoke.ink",
            "smoke.ramp",
            "smoke.ramp_image",
        ],
        |c| c.lines().is_some_and(|lines| !lines.fill),
        "it draws the outlines of smoke, and fills none",
    ),
    entry(
        &[
            "smoke.casts",
            "smoke.ink",
            "smoke.ramp_image",
            "smoke.shadow_px",
            "smoke.softness",
        ],
        |c| !c.is_frame(),
        "it fills smoke in even tones",
    ),
    entry(
        &["smoke.wrap", "smoke.ambient", "smoke.shadow", "smoke.light"],
        |c| c.is_frame() && c.style.smoke.method == SmokeMethod::Billboards,
        "smoke.method is billboards, which light does not reach",
    ),
    entry(
        &[
            "smoke.sigma",
            "smoke.layers",
            "smoke.layer_depth",
            "smoke.layer_blend",
        ],
        |c| {
            c.is_frame()
                && c.style.smoke.method == SmokeMethod::Billboards
                && c.style.smoke.heat == 0.0
        },
        "smoke.method is billboards, which have one tone without smoke.heat",
    ),
    entry(
        &[
            "smoke.puffs.detail",
            "smoke.puffs.scale",
            "smoke.puffs.ease",
            "smoke.puffs.placement",
        ],
        |c| c.style.smoke.particles == SmokeParticles::Published,
        "smoke.particles is published",
    ),
    entry(
        &["smoke.puffs.still"],
        |c| c.style.smoke.particles == SmokeParticles::Cover,
        "smoke.particles is cover",
    ),
    entry(
        &[
            "smoke.line.width",
            "smoke.line.inner",
            "smoke.line.jump",
            "smoke.line.swell",
        ],
        |c| c.is_frame() && c.style.smoke.method == SmokeMethod::Billboards,
        "billboards have the published line",
    ),
    entry(
        &[
            "smoke.line.color",
            "smoke.line.width",
            "smoke.line.inner",
            "smoke.line.jump",
            "smoke.line.swell",
            "smoke.line.weight",
        ],
        |c| c.style.smoke.line.method == SmokeLines::Off,
        "smoke.line.method is off",
    ),
    entry(
        &[
            "smoke.line.width",
            "smoke.line.inner",
            "smoke.line.jump",
            "smoke.line.swell",
        ],
        |c| c.is_frame() && c.style.smoke.line.method == SmokeLines::Published,
        "smoke.line.method is published",
    ),
    entry(
        &["smoke.line.method"],
        |c| !c.is_frame() && c.style.smoke.line.method != SmokeLines::Off,
        "lines of smoke are always drawn by npr lines, and never the published ones",
    ),
    entry(
        &["smoke.line.weight"],
        |c| {
            !c.is_frame()
                || c.style.smoke.line.method == SmokeLines::Drawn
                    && c.style.smoke.method != SmokeMethod::Billboards
        },
        "smoke.line.method is drawn",
    ),
    entry(
        &["smoke.shadow_px"],
        |c| !c.style.smoke.shadow && !c.style.smoke.casts,
        "smoke throws no shadows",
    ),
    entry(
        &["smoke.ramp"],
        |c| !c.style.smoke.ramp_image.is_empty(),
        "smoke.ramp_image is in its place",
    ),
    entry(
        &[
            "smoke.ink.color",
            "smoke.ink.dark_at",
            "smoke.ink.light_at",
            "smoke.ink.threshold",
            "smoke.ink.hatch",
        ],
        |c| c.style.smoke.ink.tone == Tone::Off,
        "smoke.ink.tone is none",
    ),
    entry(
        &["smoke.ink.hatch"],
        |c| c.style.smoke.ink.tone == Tone::Ink,
        "smoke.ink.tone is ink, which has no strokes",
    ),
];
