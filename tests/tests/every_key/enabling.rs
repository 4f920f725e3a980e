//! What keys need beside them, what texts they take, and those that change no drawing by their nature.
//!
//! A key that works only with another one gets a line in `ENABLING`: a pattern for keys (all within count; `*` at the
//! end takes all that begin so), the overrides that switch on what it needs, and why. All lines whose pattern fits are
//! laid over the base style, in order. Patterns are of keys as the style has them; a rule's keys are meant too.

use crate::outputs::Output;
use npr_stylesheet::Stated;

/// Keys that change no drawing, with the reason.
pub const EXCEPTIONS: &[(&str, &str)] = &[
    ("title", "it is for lists"),
    ("version", "it is for lists"),
    ("extends", "it is empty once a style has been read"),
    (
        "id_map.0.ids.0.name",
        "rules name it, and a rule for another name is refused",
    ),
    (
        "lettering.0.font",
        "the only font of tests is in both files",
    ),
    (
        "line.potrace.convex_only",
        "it is about specks, of which the scene has none",
    ),
    (
        "line.potrace.thin_speck_area",
        "it is about specks, of which the scene has none",
    ),
    (
        "line.potrace.thinness",
        "it is about specks, of which the scene has none",
    ),
    (
        "shade.ramp.0.at",
        "the first step begins at 0 whatever it says",
    ),
    (
        "beam.ramp.0.at",
        "the first stop begins at 0 whatever it says",
    ),
    (
        "smoke.ramp.0.at",
        "the first step begins at 0 whatever it says",
    ),
    (
        "smoke.shadow_px",
        "five spheres in a small picture throw the same shadows from maps of any size",
    ),
    (
        "smoke.particles",
        "spheres are given here; `smoke` tests what makes them",
    ),
    (
        "smoke.puffs",
        "spheres are given here; `smoke` tests what makes them",
    ),
];

/// Keys that change no drawing of some kinds here: a part of their names, and the reason.
pub const PLACES: &[(&str, &str, &str)] = &[
    (
        "line.background.direction",
        "by angle",
        "its lines lie before their own surface, never like what is behind",
    ),
    (
        "line.background.intensity",
        "by angle",
        "its lines lie before their own surface, never like what is behind",
    ),
    (
        "line.background.likeness",
        "by angle",
        "its lines lie before their own surface, never like what is behind",
    ),
    (
        "rule.0.line.paint.kinds.intersection",
        "by filter",
        "where the ball cuts the box the mask finds a contour first",
    ),
    (
        "line.width.taper.ends",
        "otrace",
        "its strokes break off before they meet",
    ),
    (
        "line.guides.0",
        "otrace",
        "in so small a picture no pixel of its lines is near enough to a vertex",
    ),
    (
        "detect.rescale_thresholds",
        "by shape",
        "edges lie inside the mask with either threshold",
    ),
];

/// Words that change no drawing here, with the reason.
pub const WORDS: &[(&str, &str, &str)] = &[
    (
        "ink.follow",
        "attribute",
        "no mesh of the scene has painted directions",
    ),
    (
        "smoke.ink.tone",
        "auto",
        "it decides as what stands in its place does",
    ),
];

/// What every base style has.
const BASE: &[&str] = &[
    "background='#e8e0d0'",
    "line.width.base='2px'",
    "rule=[{ match = { object = 'B*' }, line = { color = '#903010' } }, { match = { object = 'Glow' }, beam = {} }]",
];

/// Keys, what is beside them, and why.
const ENABLING: &[(&str, &[&str], &str)] = &[
    (
        "match",
        &[
            "rule.0.line.color='#c02010'",
            "rule.0.line.width_factor=2.0",
            "rule.0.shade.color='#20c040'",
        ],
        "a rule has to say something",
    ),
    (
        "match.id",
        &[
            "id_map=[{ image = 'ids.png', ids = [{ name = 'red', color = '#f00' }, { name = 'green', color = \
             '#0f0' }] }]",
        ],
        "ids come from maps",
    ),
    (
        "id_map",
        &[
            "id_map=[{ image = 'ids.png', object = 'B*', material = 'B*', border = true, ids = [{ name = 'red', \
             color = '#f00' }] }]",
            "rule.0={ match = { id = 'red' }, line = { color = '#c02010' }, shade = { color = '#20c040' } }",
        ],
        "rules name ids",
    ),
    (
        "ink",
        &["ink.tone='hatch'"],
        "tone none has nothing to draw",
    ),
    (
        "ink.hatch.cross_at",
        &["ink.hatch.pattern='cross'"],
        "it is about the second layer",
    ),
    (
        "line.width.short",
        &[
            "rule=[{ match = { object = 'Box' }, line = { on = false } }]",
            "line.kinds.intersection=false",
        ],
        "other lines meet that of the ball",
    ),
    (
        "line.width.room",
        &["line.width.base='12px'"],
        "lines need a neighbour",
    ),
    (
        "line.width.pressure",
        &["line.width.pressure=[{ at = 0.1, factor = 0.6 }, { at = 0.9, factor = 1.4 }]"],
        "a curve needs stops",
    ),
    (
        "rule.0.line.width.pressure",
        &["rule.0.line.width.pressure=[{ at = 0.1, factor = 0.6 }, { at = 0.9, factor = 1.4 }]"],
        "a curve needs stops",
    ),
    (
        "line.width.depth",
        &["line.width.depth.curve=[{ at = 0.1, factor = 0.6 }, { at = 0.9, factor = 1.4 }]"],
        "a curve needs stops",
    ),
    (
        "line.brush",
        &["line.brush.tip='chalk'", "line.width.base='5px'"],
        "a pen has one even ink",
    ),
    (
        "line.brush.image",
        &["line.brush.image='b.png'"],
        "the picture differs from another one",
    ),
    (
        "line.brush.stamp",
        &[
            "line.brush.mapping='stamps'",
            "line.brush.tip='dry-brush'",
            "line.brush.stamp.turn_deg=20.0",
            "line.brush.stamp.spacing=0.6",
            "line.width.base='8px'",
        ],
        "other mappings have no stamps",
    ),
    (
        "line.brush.dry",
        &["line.brush.dry=0.9"],
        "the tip's own may be what is tried",
    ),
    (
        "line.brush.grain",
        &["line.brush.grain=1.6"],
        "the tip's own may be what is tried",
    ),
    (
        "line.brush.soft",
        &["line.brush.soft=0.4"],
        "the tip's own may be what is tried",
    ),
    (
        "paper",
        &["line.brush.tip='chalk'", "line.width.base='5px'"],
        "a pen does not mind the paper",
    ),
    (
        "line.guides",
        &[
            "line.guides=[[0, 0, 0]]",
            "line.width.taper.start='12px'",
            "line.width.taper.end='12px'",
        ],
        "one has to be there, and tapers show it",
    ),
    (
        "line.width.taper",
        &[
            "line.width.taper.start='12px'",
            "line.width.taper.end='12px'",
        ],
        "tapers without length are none",
    ),
    (
        "line.width.taper.start",
        &["line.width.taper.ends='all'"],
        "lines of the scene end on each other",
    ),
    (
        "line.width.taper.end",
        &["line.width.taper.ends='all'"],
        "lines of the scene end on each other",
    ),
    (
        "line.width.taper.share",
        &["line.width.taper.ends='all'"],
        "lines of the scene end on each other",
    ),
    (
        "line.width.taper.tip",
        &["line.width.taper.ends='all'"],
        "lines of the scene end on each other",
    ),
    (
        "line.hand.wave",
        &["line.hand.wobble='4px'"],
        "lines that do not sway have no waves",
    ),
    (
        "line.hand.spread",
        &["line.hand.copies=2"],
        "the line itself is not spread",
    ),
    (
        "line.dash",
        &["line.dash.pattern=['6px', '5px']"],
        "lines are whole by default",
    ),
    (
        "detect.depth",
        &[
            "detect.normal.on=false",
            "detect.object.on=false",
            "detect.material.on=false",
        ],
        "other tests find the same lines",
    ),
    (
        "detect.object",
        &[
            "detect.depth.on=false",
            "detect.normal.on=false",
            "detect.material.on=false",
        ],
        "other tests find the same lines",
    ),
    (
        "detect.material",
        &[
            "detect.depth.on=false",
            "detect.normal.on=false",
            "detect.object.on=false",
        ],
        "other tests find the same lines",
    ),
    (
        "detect.rescale_thresholds",
        &["detect.scale=3.0"],
        "masks of the drawing's own size need none",
    ),
    (
        "line.crease_least",
        &["line.crease_slack_deg=0.0", "line.least='0px'"],
        "the ridge is one line from side to side, and long for a small picture",
    ),
    (
        "line.least",
        &["line.crease_slack_deg=0.0", "line.crease_least='0px'"],
        "the same",
    ),
    (
        "line.crease_from",
        &["line.crease_angle_deg=6.0"],
        "the ball folds by less than creases do",
    ),
    (
        "ink.hatch.taper",
        &["ink.hatch.length=2.0"],
        "long strokes have few ends",
    ),
    (
        "smoke.ink.hatch.taper",
        &["smoke.ink.hatch.length=2.0"],
        "long strokes have few ends",
    ),
    (
        "rule.0.beam.ramp",
        &[
            "rule.0.match.object='Glow'",
            "rule.0.beam.ramp=[{ at = 0.0, color = '#20f080' }, { at = 0.7, color = '#20f080a0' }]",
        ],
        "there are no stops by default",
    ),
    (
        "rule.0.shade.ramp",
        &["rule.0.shade.ramp=[{ at = 0.0, light = 0.3 }, { at = 0.5, light = 0.9 }]"],
        "rules have no stops by default",
    ),
    (
        "ink.direction_space",
        &["ink.direction=[0.2, 1.0, 0.3]"],
        "it is about a direction",
    ),
    (
        "highlight",
        &[
            "highlight.edge='soft'",
            "highlight.back.on=true",
            "highlight.streak.on=true",
        ],
        "no highlight is on by default",
    ),
    (
        "highlight.turn_deg",
        &["highlight.stretch=0.7"],
        "a round spot looks the same however it turns",
    ),
    (
        "shade.paper",
        &["shade.mode='paper'"],
        "paper is of that mode",
    ),
    (
        "light.shadow_at",
        &["light.shadow=true"],
        "no light throws shadows by default",
    ),
    (
        "light.extra",
        &[
            "light.extra=[{ kind = 'spot', position = [1.0, 3.0, 2.0], direction = [0.2, 0.9, 0.4], range = 9.0 }]",
        ],
        "there is no more light by default",
    ),
    (
        "light.extra.0.ground",
        &["light.extra=[{ kind = 'sky' }]"],
        "skies have a ground",
    ),
    (
        "light.extra.0.image",
        &["light.extra=[{ kind = 'sky' }]"],
        "skies are pictures",
    ),
    (
        "motion",
        &["rule.0.motion.trail=[-0.9, 0.3, 0.0]"],
        "no part moves by default",
    ),
    (
        "motion",
        &["motion.follow=8", "motion.variation=0.3"],
        "no line follows what moves by default",
    ),
    (
        "motion.ghost_gap",
        &["motion.ghosts=2"],
        "there are no after-images by default",
    ),
    (
        "blend",
        &["blend.amount=0.5"],
        "all of the look is drawn by default",
    ),
    (
        "beam",
        &["rule.0.beam.light=0.6"],
        "a beam lights nothing by default",
    ),
    (
        "lettering",
        &[
            "lettering=[{ text = 'HO', font = 'a.ttf', size = '12px', second_outline = { width = '2px' } }]",
        ],
        "there are no words by default",
    ),
    (
        "lettering.0.hidden",
        &["lettering.0.anchor=[0.2, 0.2, -0.3]"],
        "words of the frame are hidden by nothing",
    ),
    (
        "lettering.0.spread",
        &["lettering.0.text='HIO'"],
        "letters grow from the first to the last",
    ),
    (
        "lettering.0.line_step",
        &["lettering.0.text=\"H\\nO\""],
        "one line has no next one",
    ),
    (
        "line.width.gain",
        &["line.width.source='curvature'"],
        "gain is of curvature",
    ),
    (
        "line.width.channel",
        &["line.width.source='vertex-color'"],
        "channels are of vertex colours",
    ),
    (
        "line.width.texture",
        &["line.width.texture='a.png'", "line.width.source='texture'"],
        "the source reads it",
    ),
    (
        "line.width.source",
        &[
            "line.width.texture='a.png'",
            "line.width.control_points=[{ position = [0.0, 0.0, 0.0], radius = 2.0, factor = 1.4 }]",
        ],
        "two sources need a companion",
    ),
    (
        "line.width.control_points",
        &[
            "line.width.control_points=[{ position = [0.2, 0.0, 0.3], radius = 1.4, factor = 1.2 }]",
            "line.width.source='control-points'",
        ],
        "the source reads them",
    ),
    (
        "line.paint.source",
        &["line.paint.image='a.png'"],
        "one source needs a picture",
    ),
    (
        "line.paint.factor",
        &["line.paint.source='surface'"],
        "a constant colour is not multiplied",
    ),
    (
        "line.paint.image",
        &["line.paint.image='b.png'", "line.paint.source='texture'"],
        "the source reads it",
    ),
    (
        "line.paint.depth",
        &["line.paint.depth.ramp=[{ at = 0.2, color = '#f00' }, { at = 0.8, color = '#00f8' }]"],
        "without stops depth changes nothing",
    ),
    (
        "line.paint.light.ramp",
        &["line.paint.light.ramp=[{ at = 0.2, color = '#f00' }, { at = 0.8, color = '#00f8' }]"],
        "there are no stops by default",
    ),
    (
        "rule.0.line.paint.depth.ramp",
        &[
            "rule.0.line.paint.depth.ramp=[{ at = 0.2, color = '#f00' }, { at = 0.8, color = '#00f8' }]",
        ],
        "rules have no stops by default",
    ),
    (
        "rule.0.line.paint.light.ramp",
        &[
            "rule.0.line.paint.light.ramp=[{ at = 0.2, color = '#f00' }, { at = 0.8, color = '#00f8' }]",
        ],
        "rules have no stops by default",
    ),
    (
        "line.paint.kinds.boundary",
        &["rule.0.match.object='*'"],
        "the floor alone has borders",
    ),
    (
        "line.paint.kinds.material",
        &["rule.0.match.object='*'"],
        "the floor alone has two materials",
    ),
    (
        "line.background",
        &["background='#201c18'", "line.background.method='contrast'"],
        "lines mind nothing by default",
    ),
    (
        "line.background.ratio",
        &["line.background.measure='wcag'"],
        "it is about that measure",
    ),
    (
        "line.background.factor",
        &["line.background.start='rim'"],
        "it is about that start",
    ),
    (
        "line.background.intensity",
        &["line.background.method='published'"],
        "it is about that method",
    ),
    (
        "line.background.likeness",
        &["line.background.method='published'"],
        "it is about that method",
    ),
    (
        "subject",
        &["line.background.method='contrast'"],
        "lines mind nothing by default",
    ),
    (
        "smoke.ink",
        &["smoke.ink.tone='ink+hatch'"],
        "tone none has nothing to draw",
    ),
    (
        "smoke.ink.hatch.cross_at",
        &["smoke.ink.hatch.pattern='cross'"],
        "it is about the second layer",
    ),
    (
        "smoke.line.weight",
        &["smoke.line.method='published'"],
        "it is about that line",
    ),
    (
        "smoke.casts",
        &["light.shadow=true"],
        "shadows are of lights that throw them",
    ),
    (
        "smoke.softness",
        &["smoke.softness=0.2"],
        "soft steps differ where they are seen",
    ),
];

/// Values of keys that take texts.
const TEXTS: &[(&str, &[&str])] = &[
    ("match.material", &["'Box'", "'Ball'"]),
    ("match.object", &["'Ball'", "'Nothing'"]),
    ("match.id", &["'red'", "'green'", "''"]),
    ("subject", &["'background'", "'other'"]),
    ("id_map.0.image", &["'b.png'"]),
    ("id_map.0.object", &["'Floor'", "'Nothing'"]),
    ("id_map.0.material", &["'Floor'", "'Nothing'"]),
    ("id_map.0.ids.0.name", &["'blue'"]),
    ("lettering.0.text", &["'IOH'"]),
    ("lettering.0.font", &["'b.ttf'"]),
    ("blend.with", &["'ink'", "'comic-silver'"]),
    ("strokes", &["'sketch'", "'brush'"]),
];

/// The values of a key that takes a text; pictures where nothing else is said.
pub fn texts(path: &str) -> Vec<String> {
    let own = TEXTS.iter().find(|(pattern, _)| is_meant(pattern, path));
    let values = own.map_or(&["'a.png'", "'b.png'"][..], |(_, values)| values);
    values.iter().map(ToString::to_string).collect()
}

/// Whether a pattern means a key.
pub fn is_meant(pattern: &str, path: &str) -> bool {
    let key = match pattern.starts_with("rule.") {
        true => path,
        false => path.strip_prefix("rule.0.").unwrap_or(path),
    };
    match pattern.strip_suffix('*') {
        Some(beginning) => key.starts_with(beginning),
        None => key
            .strip_prefix(pattern)
            .is_some_and(|rest| rest.is_empty() || rest.starts_with('.')),
    }
}

/// The style that a key is tried on in an output.
pub fn base_of(path: &str, output: Output) -> Stated {
    let method = match output {
        Output::Frame(method) => method,
        _ => "shape",
    };
    let mut stated = Stated::default();
    let enabling = ENABLING
        .iter()
        .filter(|(pattern, _, _)| is_meant(pattern, path));
    let settings = BASE
        .iter()
        .chain(enabling.flat_map(|(_, settings, _)| settings.iter()));
    let mut settings: Vec<String> = settings.map(ToString::to_string).collect();
    settings.push(format!("line.method='{method}'"));
    // One by one: some fill lists that later ones look into.
    for setting in settings {
        stated
            .set_all(&[&setting])
            .unwrap_or_else(|error| panic!("{path}: {setting}: {error}"));
    }
    stated
}
