//! Keys of lines without effect for some methods, or without another key.

use super::entry::{CONTRAST, Entry, PUBLISHED, entry, of_methods};
use crate::OutlineMethod::{
    Angle, Edges, Filter, FilterHull, Hull, Okuya, Potrace, Rim, Shape, Strokes,
};
use crate::{
    BrushMapping, CardLines, CreaseFrom, LineColorSource, LineStart, Measure, WidthSource,
};
use npr_core::line_source::LineSource;

/// Keys of lines.
pub(super) const ENTRIES: &[Entry] = &[
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
];
