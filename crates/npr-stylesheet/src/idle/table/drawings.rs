//! Keys without effect in scenes that lack what they are about, and in drawings of lines.

use super::super::case::LineForm;
use super::entry::{Entry, LIT, OFF, entry};
use crate::ShadeMode;
use npr_core::geometry::Part;
use npr_core::line_source::LineSource;

/// Keys of scenes and drawings.
pub(super) const ENTRIES: &[Entry] = &[
    // The scene lacks what the key is about.
    entry(&["smoke"], |c| !c.on.scene.smoke, "the scene has no smoke"),
    entry(
        &[
            "line",
            "detect",
            "shade",
            "ink",
            "highlight",
            "motion",
            "id_map",
            "match",
            "subject",
            "beam",
            "blend",
            "smoke.casts",
            "use_scene_hints",
        ],
        |c| !c.on.scene.surfaces,
        "the scene is smoke alone",
    ),
    entry(
        &["light.file"],
        |c| !c.on.scene.lights,
        "the scene has no lights of its own",
    ),
    entry(
        &["use_scene_hints"],
        |c| !c.on.scene.toons,
        "the scene has no toon materials",
    ),
    entry(
        &["shade.use_textures"],
        |c| !c.on.scene.textures,
        "the scene has no textures",
    ),
    entry(
        &["shade.use_vertex_colors", "line.width.channel"],
        |c| !c.on.scene.vertex_colors,
        "the scene has no vertex colours",
    ),
    // Drawings of lines have nothing but lines.
    entry(
        &["line.method"],
        |c| !c.is_frame(),
        "--method says how its lines are found",
    ),
    entry(
        &["line.visibility"],
        |c| !c.is_frame(),
        "drawings of lines have exact sights",
    ),
    entry(
        &["line.brush"],
        |c| !c.is_frame() && !c.is_written_as(LineForm::Stamps),
        "drawings of lines have even ink, but for --svg stamps",
    ),
    entry(
        &["paper"],
        |c| !c.is_frame() && !c.is_written_as(LineForm::Stamps),
        "drawings of lines have no grain, but for --svg stamps",
    ),
    entry(
        &["motion.trail"],
        |c| !c.is_frame(),
        "speed lines along a vector are of pictures; those of motion.follow are of lines, too",
    ),
    entry(&["blend"], |c| !c.is_frame(), "blends are of pictures"),
    entry(
        &["shade.mode", "shade.paper", "shade.color"],
        |c| {
            c.lines().is_some_and(|lines| !lines.fill)
                && !c.has_tones()
                && c.paint_flags() & Part::LINE_SURFACE == 0
        },
        "it draws lines, and fills no surfaces",
    ),
    entry(
        &[
            "shade.use_textures",
            "shade.use_vertex_colors",
            "shade.saturation",
        ],
        |c| {
            let seen = Part::LINE_SURFACE | Part::LINE_VERTEX | Part::LINE_TEXTURE;
            !c.has_tones() && c.paint_flags() & seen == 0
        },
        "it draws lines, and fills no surfaces",
    ),
    entry(
        &[
            "shade.ramp",
            "shade.ramp_image",
            "shade.softness",
            "shade.calm",
            "shade.least",
            "ink",
            "antialias",
            "use_scene_hints",
        ],
        |c| !c.has_tones(),
        "it draws no tones and no hatching",
    ),
    entry(
        &["highlight.back.direction", "highlight.back.color"],
        |c| !c.has_tones() && c.paint_flags() & Part::LINE_RIM == 0,
        "it draws no highlights",
    ),
    entry(
        &["highlight"],
        |c| !c.has_tones() && !matches!(c.key, "highlight.back.direction" | "highlight.back.color"),
        "it draws no highlights",
    ),
    entry(
        &["beam"],
        |c| !c.has_tones(),
        "beams are light, which has no lines",
    ),
    entry(
        &["light.shadow"],
        |c| !c.has_tones() || !c.on.scene.surfaces,
        "nothing is drawn that shadows fall on",
    ),
    entry(
        &["light.shadow_at"],
        |c| !c.has_tones() && !c.fills_smoke(),
        "it draws no shadows",
    ),
    entry(
        &["smoke.light"],
        |c| !c.draws_smoke(),
        "--method image draws no lines of smoke",
    ),
    entry(
        &["light.color", "light.extra"],
        |c| c.is_color_of_light() && (!c.has_tones() || !c.on.scene.surfaces),
        "lines and smoke look at how much light there is, and not at its colour",
    ),
    entry(
        &["light.extra"],
        |c| !c.has_tones() && !c.fills_smoke() && c.paint_flags() & LIT == 0,
        "its lines do not look at light",
    ),
    entry(
        &["light"],
        |c| !c.has_tones() && !c.draws_smoke() && c.paint_flags() & LIT == 0,
        "its lines do not look at light",
    ),
    entry(
        &["background"],
        |c| {
            let holds_lines =
                [LineForm::Centrelines, LineForm::Data].map(|form| c.is_written_as(form));
            holds_lines.contains(&true) && !c.has_tones()
        },
        "the file holds lines alone",
    ),
    entry(
        &["lettering"],
        |c| c.is_written_as(LineForm::Data),
        "the file holds lines alone",
    ),
    entry(
        &["lettering"],
        |c| c.is_written_as(LineForm::Centrelines) && c.is_paint_of_words(),
        "a pen goes round words in one colour",
    ),
    entry(
        &["lettering"],
        |c| c.key.ends_with(".hidden") && (!c.is_frame() || !c.on.scene.surfaces),
        "nothing stands before its words",
    ),
    entry(
        &["shade.mode"],
        |c| {
            let is_flat = matches!(c.style.shade.mode, ShadeMode::Flat | ShadeMode::Ramp);
            !c.has_tones() && is_flat && c.paint_flags() & Part::LINE_SURFACE == 0
        },
        "it fills surfaces evenly",
    ),
    entry(
        &["line.color", "line.opacity", "smoke.line.color"],
        |c| c.is_written_as(LineForm::Data) && c.paint_flags() == 0 && c.contrasts_by(&[OFF]),
        "the file holds colours only of lines that change theirs",
    ),
    entry(
        &[
            "detect.depth.threshold",
            "detect.scale",
            "detect.rescale_thresholds",
        ],
        |c| !c.is_frame() && !c.is_found_by(LineSource::Image),
        "--method image alone looks for lines in pictures of surfaces",
    ),
    entry(
        &[
            "detect.depth.on",
            "detect.normal",
            "detect.object",
            "detect.material",
            "detect.plane_depth",
        ],
        |c| !c.is_frame(),
        "they are about the mask of pictures",
    ),
    entry(
        &["line.potrace"],
        |c| !c.is_frame() && !c.is_found_by(LineSource::Potrace),
        "--method potrace alone uses it",
    ),
    entry(
        &["line.angle_threshold_deg", "line.angle_softness"],
        |c| !c.is_frame(),
        "it is about method angle of pictures",
    ),
    entry(
        &["smoke.line"],
        |c| c.is_found_by(LineSource::Image),
        "--method image draws no lines of smoke",
    ),
    entry(
        &["line.kinds.boundary", "line.paint.kinds.boundary"],
        |c| c.is_found_by(LineSource::Image),
        "in pictures of surfaces boundaries are contours",
    ),
    entry(
        &[
            "line.kinds.intersection",
            "line.paint.kinds.intersection",
            "line.paint.kinds.material",
        ],
        |c| c.is_found_by(LineSource::Potrace),
        "--method potrace draws edges of meshes",
    ),
];
