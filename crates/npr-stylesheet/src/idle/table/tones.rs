//! Keys of tones without effect without another key.

use super::super::case::LineForm;
use super::entry::{Entry, entry};
use crate::{Edge, Follow, HighlightModel, Look, Mapping, Pattern, ShadeMode, Tone};
use npr_core::geometry::Part;

/// Whether ink may be the only step between tones.
fn ends_in_ink(look: &Look<'_>) -> bool {
    let is_even = look.ramp_image.is_empty() && look.ramp.len() == 1;
    is_even && matches!(look.ink.tone, Tone::Ink | Tone::Auto)
}

/// Keys of tones.
pub(super) const ENTRIES: &[Entry] = &[
    // These keys of tones depend on another key.
    entry(
        &["shade.paper"],
        |c| c.style.shade.mode != ShadeMode::Paper,
        "shade.mode is not paper",
    ),
    entry(
        &[
            "shade.ramp",
            "shade.ramp_image",
            "shade.softness",
            "shade.least",
        ],
        |c| c.style.shade.mode == ShadeMode::Flat,
        "shade.mode is flat",
    ),
    entry(
        &["shade.ramp"],
        |c| !c.any(|look| look.ramp_image.is_empty()),
        "shade.ramp_image is in its place",
    ),
    entry(
        &["shade.least"],
        |c| c.style.shade.softness > 0.0 && !c.any(ends_in_ink),
        "shade.softness is above 0",
    ),
    entry(
        &["shade.least"],
        |c| !c.any(|look| ends_in_ink(look) || look.ramp_image.is_empty() && look.ramp.len() > 1),
        "no part has steps of shade.ramp or ink",
    ),
    entry(
        &[
            "ink.color",
            "ink.dark_at",
            "ink.light_at",
            "ink.threshold",
            "ink.paint",
            "ink.faces",
            "ink.mapping",
            "ink.follow",
            "ink.direction",
            "ink.direction_space",
            "ink.hatch",
        ],
        |c| !c.any(|look| look.ink.tone != Tone::Off),
        "ink.tone is none",
    ),
    entry(
        &[
            "ink.faces",
            "ink.mapping",
            "ink.follow",
            "ink.direction",
            "ink.direction_space",
            "ink.hatch",
        ],
        |c| !c.hatches(),
        "ink.tone is ink, which has no strokes",
    ),
    entry(
        &["ink.faces"],
        |c| !c.on.scene.faces,
        "no figure of the scene has a face",
    ),
    entry(
        &["ink.direction", "ink.direction_space"],
        |c| !c.any(|look| look.ink.mapping == Mapping::Surface),
        "ink.mapping is not surface",
    ),
    entry(
        &["ink.direction_space"],
        |c| !c.any(|look| look.ink.direction.is_some()),
        "there is no ink.direction",
    ),
    entry(
        &["ink.follow"],
        |c| {
            !c.any(|look| {
                look.ink.mapping == Mapping::Surface && look.ink.direction.is_none()
                    || look.ink.mapping == Mapping::Screen && look.ink.follow == Follow::Light
            })
        },
        "ink.mapping or ink.direction leaves it nothing to say",
    ),
    entry(
        &["ink.hatch.cross_at"],
        |c| !c.any(|look| look.ink.hatch.pattern == Pattern::Cross),
        "ink.hatch.pattern is not cross",
    ),
    entry(
        &["smoke.ink.hatch.cross_at"],
        |c| c.style.smoke.ink.hatch.pattern != Pattern::Cross,
        "smoke.ink.hatch.pattern is not cross",
    ),
    entry(
        &[
            "ink.hatch.length",
            "ink.hatch.wobble",
            "ink.hatch.taper",
            "ink.hatch.variation",
            "ink.hatch.gain",
            "ink.hatch.seed",
        ],
        |c| !c.any(|look| look.ink.hatch.image.is_empty()),
        "ink.hatch.image is in its place",
    ),
    entry(
        &[
            "highlight.back.from",
            "highlight.back.to",
            "highlight.back.color",
            "highlight.back.direction",
        ],
        |c| !c.any(|look| look.highlight.back.on) && c.paint_flags() & Part::LINE_RIM == 0,
        "highlight.back.on is false",
    ),
    entry(
        &["highlight.back.from", "highlight.back.to"],
        |c| !c.any(|look| look.highlight.back.on),
        "highlight.back.on is false",
    ),
    entry(
        &[
            "highlight.streak.angle_deg",
            "highlight.streak.offset",
            "highlight.streak.width",
            "highlight.streak.facing",
        ],
        |c| !c.any(|look| look.highlight.streak.on),
        "highlight.streak.on is false",
    ),
    entry(
        &["highlight.color"],
        |c| !c.any(|look| look.highlight.edge != Edge::Off || look.highlight.streak.on),
        "highlight.edge is none",
    ),
    entry(
        &[
            "highlight.model",
            "highlight.exponent",
            "highlight.threshold",
            "highlight.gradient",
            "highlight.shift",
            "highlight.turn_deg",
            "highlight.stretch",
            "highlight.split",
            "highlight.square",
        ],
        |c| !c.any(|look| look.highlight.edge != Edge::Off),
        "highlight.edge is none",
    ),
    entry(
        &["highlight.gradient"],
        |c| !c.any(|look| look.highlight.edge == Edge::Soft),
        "highlight.edge is not soft",
    ),
    entry(
        &[
            "highlight.shift",
            "highlight.turn_deg",
            "highlight.stretch",
            "highlight.split",
            "highlight.square",
        ],
        |c| c.style.highlight.model == HighlightModel::Phong,
        "highlight.model is phong",
    ),
    entry(
        &["highlight.turn_deg"],
        |c| {
            let highlight = &c.style.highlight;
            highlight.stretch == 0.0 && highlight.square == 0.0 && highlight.split == [0.0; 2]
        },
        "no highlight is stretched, split or square",
    ),
    entry(
        &["light.shadow_at"],
        |c| !c.style.light.shadow && !c.style.light.extra.iter().any(|light| light.shadow),
        "no light throws shadows",
    ),
    entry(
        &[
            "motion.follow",
            "motion.smear",
            "motion.swell",
            "motion.ghosts",
        ],
        |c| !c.on.scene.clips,
        "the scene has no clips",
    ),
    entry(
        &["motion.smear"],
        |c| c.traces_pixels(),
        "lines that are found on pixels do not lag behind",
    ),
    entry(
        &["motion.swell"],
        |c| c.traces_pixels(),
        "lines that are found on pixels have no width by motion",
    ),
    entry(
        &["motion.shutter"],
        |c| !c.on.scene.clips || c.style.moments_s().is_empty(),
        "nothing follows motion: motion.follow, smear, swell and ghosts are 0, or the scene has no clips",
    ),
    entry(
        &["motion.least"],
        |c| !c.follows_motion(),
        "motion.follow is 0, or the scene has no clips",
    ),
    entry(
        &["motion.ghost_gap"],
        |c| !c.on.scene.clips || c.style.motion.ghosts == 0,
        "motion.ghosts is 0, or the scene has no clips",
    ),
    entry(
        &["motion.color"],
        |c| c.is_written_as(LineForm::Data),
        "the file holds colours only of lines that change theirs",
    ),
    entry(
        &["motion.color"],
        |c| {
            let has_lines = c.on.scene.clips && c.style.has_motion_lines();
            !has_lines && (!c.is_frame() || c.style.trails().is_empty())
        },
        "nothing has speed lines: motion.follow and ghosts are 0, or the scene has no clips",
    ),
    entry(
        &[
            "motion.spacing",
            "motion.weight",
            "motion.variation",
            "motion.seed",
        ],
        |c| !c.follows_motion() && (!c.is_frame() || c.style.trails().is_empty()),
        "nothing has speed lines: motion.follow is 0, or the scene has no clips, and no rule gives a motion.trail",
    ),
    entry(
        &["blend.with"],
        |c| !c.style.blend.shows(),
        "blend.amount is 1",
    ),
];
