//! The table of keys that have no effect: which, when and why. Its reasons are printed for users.

use super::case::{Case, LineForm};
use crate::OutlineMethod::{
    Angle, Edges, Filter, FilterHull, Hull, Okuya, Potrace, Rim, Shape, Strokes,
};
use crate::Pattern;
use crate::{
    BackgroundMethod, BrushMapping, CardLines, CreaseFrom, Edge, Follow, HighlightModel,
    LineColorSource, LineStart, Mapping, Measure, ShadeMode, SmokeLines, SmokeMethod,
    SmokeParticles, Tone, WidthSource,
};
use npr_core::geometry::Part;
use npr_core::line_source::LineSource;

/// Keys that have no effect under a condition.
pub(super) struct Entry {
    /// The keys, without the prefix `rule.N.` for keys of rules. A table or list covers all keys within it. A `*` at
    /// the end covers all keys that begin with what stands before.
    pub keys: &'static [&'static str],
    /// The condition under which they have no effect.
    pub is_idle: fn(&Case<'_>) -> bool,
    /// The reason, as the notice states it.
    pub why: Why,
}

/// The reason why a key has no effect.
pub(super) enum Why {
    /// This text.
    Told(&'static str),
    /// The line methods of the frame do not use it; the text names them.
    Methods,
}

const fn entry(
    keys: &'static [&'static str],
    is_idle: fn(&Case<'_>) -> bool,
    why: &'static str,
) -> Entry {
    Entry {
        keys,
        is_idle,
        why: Why::Told(why),
    }
}

/// Keys that only some line methods of frames use.
const fn of_methods(keys: &'static [&'static str], is_idle: fn(&Case<'_>) -> bool) -> Entry {
    Entry {
        keys,
        is_idle,
        why: Why::Methods,
    }
}

const OFF: BackgroundMethod = BackgroundMethod::Off;
const PUBLISHED: BackgroundMethod = BackgroundMethod::Published;
const CONTRAST: BackgroundMethod = BackgroundMethod::Contrast;

/// The flags of `line.paint` that depend on light.
const LIT: u32 = Part::LINE_LIGHT | Part::LINE_OPACITY | Part::LINE_WIDTH;

/// All entries. The first one that covers a key and whose condition holds gives the reason.
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
    // Only some line methods of frames use these keys.
    of_methods(
        &[
            "line.color",
            "line.opacity",
            "line.paint",
            "line.background",
            "line.on",
            "subject",
        ],
        |c| {
            !c.is_drawn_by(&[
                Shape, Okuya, Filter, Hull, FilterHull, Edges, Rim, Angle, Strokes, Potrace,
            ])
        },
    ),
    of_methods(&["line.opacity"], |c| {
        !c.is_drawn_by(&[
            Shape, Okuya, Filter, FilterHull, Edges, Rim, Strokes, Potrace,
        ])
    }),
    of_methods(
        &[
            "line.paint.depth",
            "line.paint.image",
            "line.paint.kinds",
            "line.paint.light",
            "line.paint.tint",
        ],
        |c| {
            !c.is_drawn_by(&[
                Shape, Okuya, Filter, Hull, FilterHull, Edges, Angle, Strokes, Potrace,
            ])
        },
    ),
    of_methods(&["line.paint.kinds.boundary"], |c| {
        !c.is_drawn_by(&[Shape, Edges, Strokes, Potrace])
    }),
    of_methods(&["line.paint.kinds.crease"], |c| {
        !c.is_drawn_by(&[Shape, Filter, FilterHull, Strokes, Potrace])
    }),
    of_methods(&["line.paint.kinds.material"], |c| {
        !c.is_drawn_by(&[Shape, Filter, FilterHull, Strokes])
    }),
    of_methods(&["line.background.scope"], |c| {
        // Rims lie between subjects, whose colours mix there.
        let between = c.is_of_rule && c.is_drawn_by(&[Rim]);
        let is_used = c.is_drawn_by(&[
            Shape, Okuya, Filter, Hull, FilterHull, Edges, Angle, Strokes, Potrace,
        ]);
        !is_used && !between
    }),
    of_methods(&["line.paint.kinds.intersection"], |c| {
        !c.is_drawn_by(&[Shape, Filter, FilterHull, Strokes])
    }),
    of_methods(&["line.crease_angle_deg", "line.crease_from"], |c| {
        !c.is_drawn_by(&[Shape, Okuya, Filter, FilterHull, Strokes, Potrace])
    }),
    of_methods(
        &[
            "line.crease_slack_deg",
            "line.crease_hard_deg",
            "line.crease_round",
        ],
        |c| !c.is_drawn_by(&[Strokes]),
    ),
    entry(
        &["line.crease_hard_deg"],
        |c| c.style.line.crease_from == CreaseFrom::Faces,
        "line.crease_from is faces, which need no other angle",
    ),
    entry(
        &[
            "line.crease_slack_deg",
            "line.crease_hard_deg",
            "line.crease_round",
        ],
        |c| c.is_found_by(LineSource::Potrace) || c.is_found_by(LineSource::Image),
        "methods of pixels find creases by the angle alone",
    ),
    of_methods(
        &["line.split_angle_deg", "line.crease_least", "line.least"],
        |c| !c.is_drawn_by(&[Strokes, Potrace]),
    ),
    entry(
        &["line.split_angle_deg"],
        |c| c.is_frame() && !c.is_drawn_by(&[Strokes]) && !c.shows_cuts(),
        "lines of method potrace show where they are cut only with line.hand, line.dash, line.width.short or with \
         tapers at all ends",
    ),
    of_methods(&["line.angle_threshold_deg", "line.angle_softness"], |c| {
        !c.is_drawn_by(&[Angle])
    }),
    of_methods(&["line.kinds.intersection"], |c| {
        !c.is_drawn_by(&[Shape, Filter, FilterHull, Strokes])
    }),
    of_methods(&["line.kinds"], |c| {
        !c.is_drawn_by(&[Shape, Strokes, Potrace])
    }),
    of_methods(&["line.potrace"], |c| !c.is_drawn_by(&[Potrace])),
    of_methods(
        &["line.width.base", "line.width_factor", "line.scale"],
        |c| {
            !c.is_drawn_by(&[
                Shape, Okuya, Hull, FilterHull, Edges, Angle, Strokes, Potrace,
            ])
        },
    ),
    of_methods(
        &[
            "line.width.source",
            "line.width.min",
            "line.width.max",
            "line.width.gain",
            "line.width.channel",
            "line.width.texture",
            "line.width.control_points",
        ],
        |c| !c.is_drawn_by(&[Shape, Okuya, Hull, FilterHull, Edges, Strokes, Potrace]),
    ),
    of_methods(
        &[
            "line.width.short",
            "line.width.room",
            "line.width.taper",
            "line.width.pressure",
            "line.width.depth",
            "line.hand",
            "line.dash",
            "line.longest",
            "line.guides",
        ],
        |c| !c.is_drawn_by(&[Strokes, Potrace]),
    ),
    entry(
        &["line.guides"],
        |c| c.is_frame() && !c.shows_lifts(),
        "without line.width.taper, line.width.short, line.hand and line.dash nothing shows where a pen is lifted",
    ),
    of_methods(&["line.brush"], |c| !c.is_drawn_by(&[Strokes, Potrace])),
    of_methods(&["line.cards"], |c| !c.is_drawn_by(&[Strokes, Potrace])),
    entry(
        &["line.cards"],
        |c| c.traces_pixels() && !c.any(|look| look.line_cards == CardLines::Centre),
        "lines that are found on pixels go around all of a tuft's blades",
    ),
    of_methods(&["line.visibility"], |c| !c.is_drawn_by(&[Strokes])),
    of_methods(&["detect.scale"], |c| {
        !c.is_drawn_by(&[Shape, Okuya, Filter, FilterHull, Edges])
    }),
    of_methods(
        &[
            "detect.depth",
            "detect.normal",
            "detect.object",
            "detect.material",
            "detect.plane_depth",
            "detect.rescale_thresholds",
        ],
        |c| !c.is_drawn_by(&[Shape, Okuya, Filter, FilterHull]),
    ),
    entry(
        &["detect.rescale_thresholds"],
        |c| c.style.detect.scale == 1.0,
        "detect.scale is 1",
    ),
    // These keys of lines depend on another key.
    entry(
        &["line.width.gain"],
        |c| !c.width_is_of(&[WidthSource::Curvature, WidthSource::ProjectedCurvature]),
        "line.width.source is not a curvature",
    ),
    entry(
        &[
            "line.width.taper.share",
            "line.width.taper.tip",
            "line.width.taper.ends",
        ],
        |c| !c.any(|look| look.line_width.taper.is_on()),
        "line.width.taper.start and end are 0",
    ),
    entry(
        &[
            "line.width.depth.space",
            "line.width.depth.near",
            "line.width.depth.far",
        ],
        |c| c.style.line.width.depth.curve.is_empty(),
        "line.width.depth.curve is empty",
    ),
    entry(
        &["line.brush.tip"],
        |c| !c.any(|look| look.line_brush.image.is_empty()),
        "line.brush.image is in its place",
    ),
    entry(
        &[
            "line.brush.mapping",
            "line.brush.stretch",
            "line.brush.dry",
            "line.brush.grain",
            "line.brush.soft",
            "line.brush.stamp",
        ],
        |c| !c.any(|look| !look.line_brush.is_pen()),
        "line.brush.tip is pen, which has one even ink",
    ),
    entry(
        &["line.brush.stamp"],
        |c| !c.any(|look| look.line_brush.mapping == BrushMapping::Stamps),
        "line.brush.mapping is not stamps",
    ),
    entry(
        &["line.brush.stretch"],
        |c| !c.any(|look| look.line_brush.mapping == BrushMapping::Length),
        "line.brush.mapping is not length",
    ),
    entry(
        &["paper"],
        |c| !c.minds_paper(),
        "neither strokes nor hatching mind its grain",
    ),
    entry(
        &["line.hand.wave"],
        |c| !c.any(|look| look.line_hand.wobble.value > 0.0),
        "line.hand.wobble is 0",
    ),
    entry(
        &["line.hand.spread"],
        |c| !c.any(|look| look.line_hand.copies > 1),
        "line.hand.copies is 1",
    ),
    entry(
        &["line.dash.fit"],
        |c| !c.any(|look| look.line_dash.is_on()),
        "line.dash.pattern has no gaps",
    ),
    entry(
        &["line.width.channel"],
        |c| !c.width_is_of(&[WidthSource::VertexColor]),
        "line.width.source is not vertex-color",
    ),
    entry(
        &["line.width.texture"],
        |c| !c.width_is_of(&[WidthSource::Texture]),
        "line.width.source is not texture",
    ),
    entry(
        &["line.width.control_points"],
        |c| !c.width_is_of(&[WidthSource::ControlPoints]),
        "line.width.source is not control-points",
    ),
    entry(
        &["line.width.min"],
        |c| c.width_is_of(&[WidthSource::Constant]),
        "line.width.source is constant, so max alone counts",
    ),
    entry(
        &["line.paint.factor"],
        |c| !c.any(|look| look.line_paint.source != LineColorSource::Constant),
        "line.paint.source is constant",
    ),
    entry(
        &["line.paint.image"],
        |c| !c.any(|look| look.line_paint.source == LineColorSource::Texture),
        "line.paint.source is not texture",
    ),
    entry(
        &[
            "line.paint.depth.space",
            "line.paint.depth.near",
            "line.paint.depth.far",
        ],
        |c| !c.any(|look| !look.line_paint.depth.ramp.is_empty()),
        "line.paint.depth.ramp is empty",
    ),
    entry(
        &["line.background.hold", "line.background.fade"],
        |_| true,
        "they are about what changes from frame to frame",
    ),
    entry(
        &["line.background.intensity", "line.background.likeness"],
        |c| !c.contrasts_by(&[PUBLISHED]),
        "line.background.method is not published",
    ),
    entry(
        &[
            "line.background.measure",
            "line.background.lightness",
            "line.background.ratio",
            "line.background.start",
            "line.background.factor",
            "line.background.smooth",
        ],
        |c| !c.contrasts_by(&[CONTRAST]),
        "line.background.method is not contrast",
    ),
    entry(
        &[
            "line.background.direction",
            "line.background.scope",
            "line.background.subjects",
            "subject",
        ],
        |c| !c.contrasts_by(&[PUBLISHED, CONTRAST]),
        "line.background.method is off",
    ),
    entry(
        &["line.background.lightness"],
        |c| !c.any(|look| look.line_background.measure == Measure::Lightness),
        "line.background.measure is wcag",
    ),
    entry(
        &["line.background.ratio"],
        |c| !c.any(|look| look.line_background.measure == Measure::Wcag),
        "line.background.measure is lightness",
    ),
    entry(
        &["line.background.factor"],
        |c| !c.any(|look| look.line_background.start == LineStart::Rim),
        "line.background.start is line",
    ),
    // These keys of tones depend on another key.
    entry(
        &["shade.paper"],
        |c| c.style.shade.mode != ShadeMode::Paper,
        "shade.mode is not paper",
    ),
    entry(
        &["shade.ramp", "shade.ramp_image", "shade.softness"],
        |c| c.style.shade.mode == ShadeMode::Flat,
        "shade.mode is flat",
    ),
    entry(
        &["shade.ramp"],
        |c| !c.any(|look| look.ramp_image.is_empty()),
        "shade.ramp_image is in its place",
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
        &["motion.follow", "motion.smear", "motion.ghosts"],
        |c| !c.on.scene.clips,
        "the scene has no clips",
    ),
    entry(
        &["motion.smear"],
        |c| c.traces_pixels(),
        "lines that are found on pixels do not lag behind",
    ),
    entry(
        &["motion.shutter"],
        |c| !c.on.scene.clips || c.style.moments_s().is_empty(),
        "nothing follows motion: motion.follow, smear and ghosts are 0, or the scene has no clips",
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
