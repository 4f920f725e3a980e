//! `cargo xtask constants`: the constants of shaders are those of their twins in Rust.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Result, bail};

use crate::source::files_of;

/// Constants of a shader whose names start alike, and where their twins stand.
struct Twins {
    /// Below `shaders/`.
    shader: &'static str,
    /// What their names start with; the longest prefix that fits decides.
    prefix: &'static str,
    /// Below `crates/`.
    source: &'static str,
    /// What stands in place of the prefix in Rust; `Name::` for a constant of an `impl Name`.
    scope: &'static str,
}

const fn twins(
    shader: &'static str,
    prefix: &'static str,
    source: &'static str,
    scope: &'static str,
) -> Twins {
    Twins {
        shader,
        prefix,
        source,
        scope,
    }
}

/// Where the shares stand by which samples of a line are weighed.
const FILTER: &str = "npr-vector/src/sampled/filter.rs";

/// Where the twins of all constants stand.
#[rustfmt::skip]
const TWINS: &[Twins] = &[
    twins("backdrop/blend_biases.wgsl", "", "npr-style/src/backdrop/stretch.rs", ""),
    twins("backdrop/bound_tiles.wgsl", "", "npr-style/src/backdrop/stretch.rs", ""),
    twins("backdrop/flag_tiles.wgsl", "", "npr-style/src/backdrop/rims.rs", ""),
    twins("backdrop/vote_bias.wgsl", "", "npr-style/src/backdrop/stretch.rs", ""),
    twins("backdrop/smooth_rims.wgsl", "", "npr-style/src/backdrop/spread.rs", ""),
    twins("backdrop/smooth_rims.wgsl", "UNLIKE", "npr-style/src/backdrop/spread.rs", "UNLIKE_COLORS"),
    twins("lib/adapt.wgsl", "", "npr-style/src/backdrop/adapt.rs", ""),
    twins("lib/backdrop.wgsl", "RULE_", "npr-style/src/backdrop/rule.rs", "Rule::"),
    twins("lib/backdrop.wgsl", "RULES_", "npr-style/src/backdrop/rule.rs", "Rules::"),
    twins("lib/backdrop.wgsl", "RIM_", "npr-style/src/backdrop/rims.rs", "Rim::"),
    twins("lib/backdrop.wgsl", "BORDER_", "npr-style/src/backdrop/rims.rs", ""),
    twins("lib/color.wgsl", "", "npr-style/src/luminance.rs", ""),
    twins("lib/compose.wgsl", "COMPOSE_", "npr-style/src/compose.rs", "Compose::"),
    twins("lib/edge_flags.wgsl", "EDGE_", "npr-core/src/edge_flags.rs", "EdgeFlags::"),
    twins("lib/geometry.wgsl", "", "npr-core/src/geometry.rs", ""),
    twins("lib/geometry.wgsl", "CHART_", "npr-core/src/geometry.rs", "ChartCorners::"),
    twins("lib/geometry.wgsl", "PART_", "npr-core/src/geometry.rs", "Part::"),
    twins("lib/geometry.wgsl", "LINE_", "npr-core/src/geometry.rs", "Part::LINE_"),
    twins("lib/geometry.wgsl", "HULL_BIT", "npr-core/src/raster.rs", "HULL_BIT"),
    twins("lib/geometry.wgsl", "ID_MASK", "npr-core/src/raster.rs", "ID_MASK"),
    twins("lib/gloss_bound.wgsl", "", "npr-style/src/gloss.rs", ""),
    twins("lib/ink_step.wgsl", "NO_HATCH", "npr-style/src/ink_step.rs", "NO_HATCH"),
    twins("lib/ink_step.wgsl", "NO_STEP", "npr-style/src/ramp.rs", "Level::UNUSED"),
    twins("lib/ink_tone.wgsl", "", "npr-style/src/inking.rs", ""),
    twins("lib/tone_range.wgsl", "", "npr-style/src/corners.rs", ""),
    twins("lib/triangle_constants.wgsl", "KNOWN_", "npr-style/src/triangle_constants.rs", "TriangleConstants::"),
    twins("lib/shaped_gloss.wgsl", "", "npr-style/src/gloss.rs", ""),
    twins("lib/gloss.wgsl", "", "npr-style/src/gloss.rs", ""),
    twins("lib/inking.wgsl", "", "npr-style/src/inking.rs", ""),
    twins("lib/grain.wgsl", "", "npr-core/src/grain.rs", ""),
    twins("lib/brush.wgsl", "", "npr-vector/src/brush.rs", ""),
    twins("lib/ink_point.wgsl", "INK_", "npr-vector/src/ink_point.rs", "InkPoint::"),
    twins("lib/paper.wgsl", "", "npr-style/src/inking.rs", ""),
    twins("lib/inking.wgsl", "STEPS", "npr-style/src/hatch/drawing.rs", "STEPS"),
    twins("lib/inking.wgsl", "BLEND_LIFT", "npr-style/src/hatch/tone.rs", "BLEND_LIFT"),
    twins("lib/inking.wgsl", "RIDGE", "npr-style/src/hatch/tone.rs", "RIDGE"),
    twins("lib/grazing.wgsl", "", "npr-style/src/tone.rs", ""),
    twins("lib/lighting.wgsl", "LIGHT_", "npr-style/src/lighting.rs", "LightSource::"),
    twins("lib/lighting.wgsl", "SKY_", "npr-style/src/lighting.rs", "LightSource::"),
    twins("lib/line_color.wgsl", "", "npr-style/src/line_color.rs", ""),
    twins("lib/line_kind.wgsl", "KIND_", "npr-core/src/line_kind.rs", "KindSet::"),
    twins("lib/line_kind.wgsl", "KINDS", "npr-core/src/line_kind.rs", "KindSet::BITS"),
    twins("lib/line_kind.wgsl", "KINDS_", "npr-core/src/line_kind.rs", "KindSet::"),
    twins("lib/line_kind.wgsl", "", "npr-core/src/line_kind.rs", ""),
    twins("lib/list.wgsl", "", "npr-vector/src/rank/splitter.rs", ""),
    twins("lib/looped.wgsl", "", "npr-vector/src/pixel_strokes/planar.rs", ""),
    twins("lib/outline.wgsl", "", "npr-core/src/outline.rs", ""),
    twins("lib/outline.wgsl", "DETECT_", "npr-core/src/outline.rs", "Outline::"),
    twins("lib/outline.wgsl", "DETECT_OBJECT", "npr-core/src/outline.rs", "Outline::OBJECT_ID"),
    twins("lib/outline.wgsl", "DETECT_MATERIAL", "npr-core/src/outline.rs", "Outline::MATERIAL_ID"),
    twins("lib/outline.wgsl", "OUTLINE_", "npr-core/src/outline.rs", "Outline::"),
    twins("lib/paint.wgsl", "", "npr-style/src/paint.rs", ""),
    twins("lib/scenery.wgsl", "", "npr-style/src/backdrop/rims.rs", ""),
    twins("lib/shadow.wgsl", "", "npr-style/src/shadow.rs", ""),
    twins("lib/sky.wgsl", "", "npr-style/src/sky.rs", ""),
    twins("lib/smoke.wgsl", "SMOKE_", "npr-style/src/smoke/look.rs", "SmokeLook::"),
    twins("lib/smoke_line.wgsl", "", "npr-style/src/smoke/line.rs", ""),
    twins("lib/smoke_pen.wgsl", "", "npr-style/src/smoke/pen.rs", ""),
    twins("lib/stamp.wgsl", "", "npr-vector/src/screen/residual.rs", ""),
    twins("lib/stretch.wgsl", "UNLIKE_WALLS", "npr-style/src/backdrop/gather.rs", "UNLIKE"),
    twins("lib/grid.wgsl", "WG", "npr-gpu/src/pass.rs", "WORKGROUP_SIZE"),
    twins("lib/ink.wgsl", "", "npr-vector/src/pixel_strokes/side.rs", ""),
    twins("lib/ink.wgsl", "BITS_", "npr-vector/src/pixel_strokes/fragment.rs", "BITS_"),
    twins("lib/texture.wgsl", "", "npr-core/src/texture.rs", ""),
    twins("lib/tone_row.wgsl", "", "npr-style/src/tone_row.rs", ""),
    twins("lib/toon.wgsl", "", "npr-style/src/toon.rs", ""),
    twins("lib/ink_level.wgsl", "", "npr-style/src/cut_tone.rs", ""),
    twins("lib/tone_word.wgsl", "CUT_", "npr-style/src/cut_tone.rs", ""),
    twins("lib/tone_word.wgsl", "TONE_TILE", "npr-style/src/even_tones.rs", "TILE"),
    twins("lib/tone_word.wgsl", "", "npr-style/src/even_tones.rs", ""),
    twins("shade/even_tones.wgsl", "", "npr-style/src/even_tones.rs", ""),
    twins("lib/smoke_cover.wgsl", "SMOKE_LAYER_", "npr-style/src/smoke/resolve.rs", ""),
    twins("line/color_mask.wgsl", "", "npr-style/src/line_color.rs", ""),
    twins("line/detect.wgsl", "", "npr-vector/src/screen/detect.rs", ""),
    twins("line/draw_ribbons.wgsl", "", "npr-vector/src/screen/ribbon.rs", ""),
    twins("line/claim_pixels.wgsl", "", "npr-vector/src/screen/residual.rs", ""),
    twins("line/find_residual.wgsl", "", "npr-vector/src/screen/residual.rs", ""),
    twins("mesh/pose_vertices.wgsl", "", "npr-mesh/src/pose.rs", ""),
    twins("shade/find_depths.wgsl", "", "npr-style/src/picture_depth.rs", ""),
    twins("shade/compose_frame.wgsl", "", "npr-style/src/tone.rs", ""),
    twins("smoke/project_spheres.wgsl", "", "npr-core/src/smoke.rs", ""),
    twins("smoke/resolve_picture.wgsl", "SMOKE_", "npr-style/src/smoke/resolve.rs", ""),
    twins("lib/spine.wgsl", "LINE_", "npr-vector/src/sampled.rs", "SampledLine::"),
    twins("stroke/see_samples.wgsl", "", "npr-vector/src/sampled/see.rs", ""),
    twins("stroke/weigh_samples.wgsl", "", FILTER, ""),
    twins("stroke/ink_samples.wgsl", "", "npr-vector/src/sampled/ink.rs", ""),
    twins("vector/draw_nearest.wgsl", "", "npr-vector/src/pixel_strokes/fragment.rs", ""),
    twins("vector/project_edges.wgsl", "", "npr-vector/src/pixel_strokes/segment.rs", ""),
    twins("vector/scan_add.wgsl", "", "npr-vector/src/rank/scan.rs", ""),
    twins("vector/scan_blocks.wgsl", "", "npr-vector/src/rank/scan.rs", ""),
    twins("vector/size_work.wgsl", "", "npr-vector/src/rank/work.rs", ""),
    twins("vector/size_work.wgsl", "BLOCK", "npr-vector/src/rank/scan.rs", "BLOCK"),
    twins("vector/size_work.wgsl", "BLOCKS_IN_ROW", "npr-vector/src/rank/work.rs", "BLOCKS_IN_ROW"),
    twins("vector/size_work.wgsl", "RUN", "npr-vector/src/rank/scan.rs", "RUN"),
    twins("stroke/weigh_samples.wgsl", "CLEARLY_VISIBLE", FILTER, "CLEAR_SHARES[0]"),
    twins("stroke/weigh_samples.wgsl", "CLEARLY_HIDDEN", FILTER, "CLEAR_SHARES[1]"),
];

/// Constants without a constant in Rust, and what they stand for.
const ALONE: [(&str, &str, &str); 3] = [
    (
        "lib/sampling.wgsl",
        "WRAP_CLAMP",
        "`Wrap::Clamp as u32`, an enum",
    ),
    (
        "lib/sampling.wgsl",
        "WRAP_MIRROR",
        "`Wrap::Mirror as u32`, an enum",
    ),
    (
        "shade/even_tones.wgsl",
        "UNCOUNTED",
        "`None` of `ToneMap::counted`",
    ),
];

/// Values that are this much apart, as a share, are one value: shaders hold numbers of 32 bits.
const TOLERANCE: f64 = 1e-7;

/// The constants of a file, by name; in Rust those of an `impl Name` as `Name::CONSTANT`.
type Constants = BTreeMap<String, String>;

/// Fails with every constant of a shader in the project at `root` that differs from its twin, or has none.
pub fn check(root: &Path) -> Result<()> {
    // Read every shader, and all that shaders take from libraries.
    let shaders: Vec<(String, Constants)> = files_of(&root.join("shaders"), "wgsl")?
        .iter()
        .map(|file| (slashed(&file.path), constants_of(&file.text, &["const "])))
        .collect();
    let libraries = shaders
        .iter()
        .filter(|(shader, _)| shader.starts_with("lib/"));
    let shared: Constants = libraries
        .flat_map(|(_, constants)| constants.clone())
        .collect();
    let sources = sources_of_twins(root)?;

    // Compare each constant with its twin.
    let mut faults = Vec::new();
    for (shader, own) in &shaders {
        // Its own constants go before those of libraries.
        let mut known = shared.clone();
        known.extend(own.clone());
        let compared = own.keys().filter(|name| !is_alone(shader, name));
        faults.extend(compared.filter_map(|name| fault(shader, name, &known, &sources)));
    }
    if !faults.is_empty() {
        bail!("constants of shaders differ:\n  {}", faults.join("\n  "));
    }
    let count: usize = shaders.iter().map(|(_, own)| own.len()).sum();
    println!("constants: {count} of shaders are those of Rust");
    Ok(())
}

/// A path as it stands in the table, on every system.
fn slashed(path: &Path) -> String {
    path.to_string_lossy().replace('\\', "/")
}

/// What every Rust source that holds twins knows: its own constants, and those that belong to types of any other.
///
/// Sources that are not there are left out; whoever asks for a twin in one is told that it cannot be read.
fn sources_of_twins(root: &Path) -> Result<BTreeMap<&'static str, Constants>> {
    // Read every source that the table names.
    let mut sources = BTreeMap::new();
    for twins in TWINS {
        let path = root.join("crates").join(twins.source);
        if path.exists() && !sources.contains_key(twins.source) {
            let text = std::fs::read_to_string(&path)?;
            sources.insert(twins.source, rust_constants(&text));
        }
    }

    // Let all of them know the constants of types, which may stand anywhere.
    let own = sources.values().flatten();
    let of_types = own.filter(|(name, _)| name.contains("::"));
    let of_types: Constants = of_types
        .map(|(name, text)| (name.clone(), text.clone()))
        .collect();
    for constants in sources.values_mut() {
        for (name, text) in &of_types {
            constants
                .entry(name.clone())
                .or_insert_with(|| text.clone());
        }
    }
    Ok(sources)
}

fn is_alone(shader: &str, name: &str) -> bool {
    ALONE
        .iter()
        .any(|(file, constant, _)| (*file, *constant) == (shader, name))
}

/// What is wrong with a constant of a shader that knows the constants `known`.
fn fault(
    shader: &str,
    name: &str,
    known: &Constants,
    sources: &BTreeMap<&str, Constants>,
) -> Option<String> {
    // Find where the twin should stand; the longest prefix decides.
    let fits = |twins: &&Twins| twins.shader == shader && name.starts_with(twins.prefix);
    let Some(twins) = TWINS
        .iter()
        .filter(fits)
        .max_by_key(|twins| twins.prefix.len())
    else {
        return Some(format!(
            "{shader}: {name} has no twin; name it in xtask/src/constants.rs"
        ));
    };

    // Compare both values.
    let (source, twin) = (
        twins.source,
        format!("{}{}", twins.scope, &name[twins.prefix.len()..]),
    );
    let theirs = sources
        .get(source)
        .and_then(|rust| value_of(&twin, rust, ""));
    match [value_of(name, known, ""), theirs] {
        [Some(ours), Some(theirs)] if are_equal(&ours, &theirs) => None,
        [Some(ours), Some(theirs)] => Some(format!(
            "{shader}: {name} is {ours:?}, but {twin} of {source} is {theirs:?}"
        )),
        [None, _] => Some(format!("{shader}: the value of {name} cannot be read")),
        [_, None] => Some(format!(
            "{shader}: {name} should be {twin} of {source}, which cannot be read"
        )),
    }
}

fn are_equal(a: &[f64], b: &[f64]) -> bool {
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= TOLERANCE * a.abs().max(b.abs());
    a.len() == b.len() && a.iter().zip(b).all(close)
}

/// Constants of a Rust file, up to its tests.
fn rust_constants(text: &str) -> Constants {
    let end = text
        .find("\n#[cfg(test)]\nmod tests {")
        .unwrap_or(text.len());
    let declared = [
        "const ",
        "pub const ",
        "pub(crate) const ",
        "pub(super) const ",
    ];
    constants_of(&text[..end], &declared)
}

/// The texts of all constants that are declared by one of the given words, by name.
fn constants_of(text: &str, words: &[&str]) -> Constants {
    let mut found = Constants::new();
    let mut scope = String::new();
    let mut lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    while let Some(line) = lines.next() {
        // Blocks of an implementation begin and end in the first column.
        if let Some(name) = line.strip_prefix("impl ") {
            let name = name.split([' ', '<', '{']).next().unwrap_or("");
            scope = format!("{name}::");
        } else if line == "}" {
            scope.clear();
        }
        let declared = line.trim();
        let Some(rest) = words.iter().find_map(|word| declared.strip_prefix(word)) else {
            continue;
        };
        // A declaration goes on until its semicolon; those within brackets are lengths of arrays.
        let mut whole = rest.to_owned();
        while !whole.trim_end().ends_with(';') {
            let Some(next) = lines.next() else { break };
            whole += next;
        }
        if let Some((head, value)) = whole.split_once('=') {
            let name = head.split([':', ' ']).next().unwrap_or("");
            let value = value.trim().trim_end_matches(';').to_owned();
            found.insert(format!("{scope}{name}"), value);
        }
    }
    found
}

/// The value of a constant, a number each of what it holds; `NAME[1]` is the second of them.
fn value_of(name: &str, constants: &Constants, scope: &str) -> Option<Vec<f64>> {
    if let Some((list, index)) = name.strip_suffix(']').and_then(|name| name.split_once('[')) {
        let values = value_of(list, constants, scope)?;
        return Some(vec![*values.get(index.parse::<usize>().ok()?)?]);
    }
    let own = name.replacen("Self::", scope, 1);
    let name = if constants.contains_key(&own) {
        own
    } else {
        format!("{scope}{name}")
    };
    let text = constants.get(&name)?;
    let scope = name.rfind("::").map_or("", |end| &name[..end + 2]);
    Reader::new(text, constants, scope).values()
}

/// Reads expressions of numbers, names, `! | & << >> + - * /`, brackets and lists.
struct Reader<'a> {
    words: Vec<String>,
    at: usize,
    constants: &'a Constants,
    scope: &'a str,
}

/// Operators of two values, those that bind loosest first.
const OPERATORS: [&[&str]; 5] = [&["|"], &["&"], &["<<", ">>"], &["+", "-"], &["*", "/"]];

impl<'a> Reader<'a> {
    fn new(text: &str, constants: &'a Constants, scope: &'a str) -> Self {
        Self {
            words: words_of(text),
            at: 0,
            constants,
            scope,
        }
    }

    /// The whole text: a list or one value.
    fn values(mut self) -> Option<Vec<f64>> {
        // A list in either language: `[1.0, 2.0]`, `vec2<f32>(1.0, 2.0)`.
        let start = self
            .words
            .iter()
            .position(|word| word == "[" || word == "(");
        let first = self.words.first()?;
        let is_list = first == "[" || first.starts_with("vec");
        self.at = start.filter(|_| is_list).map_or(0, |start| start + 1);
        let mut values = vec![self.operation(0)?];
        while is_list && self.take(",") {
            values.push(self.operation(0)?);
        }
        let is_closed = !is_list || self.take("]") || self.take(")");
        (is_closed && self.at == self.words.len()).then_some(values)
    }

    fn take(&mut self, word: &str) -> bool {
        let is_next = self.words.get(self.at).is_some_and(|next| next == word);
        self.at += usize::from(is_next);
        is_next
    }

    fn operation(&mut self, level: usize) -> Option<f64> {
        let Some(operators) = OPERATORS.get(level) else {
            return self.single();
        };

        // Read operators of one strength from left to right.
        let mut value = self.operation(level + 1)?;
        while let Some(operator) = operators.iter().find(|operator| self.take(operator)) {
            let other = self.operation(level + 1)?;
            let [a, b] = [value, other].map(|value| value as u64);
            value = match *operator {
                "|" => (a | b) as f64,
                "&" => (a & b) as f64,
                "<<" => a.checked_shl(b as u32)? as f64,
                ">>" => a.checked_shr(b as u32)? as f64,
                "+" => value + other,
                "-" => value - other,
                "*" => value * other,
                _ => value / other,
            };
        }
        Some(value)
    }

    fn single(&mut self) -> Option<f64> {
        if self.take("(") {
            let value = self.operation(0)?;
            return self.take(")").then_some(value);
        }
        if self.take("-") {
            return Some(-self.single()?);
        }
        if self.take("!") {
            return Some(f64::from(!(self.single()? as u32)));
        }
        let word = self.words.get(self.at)?.clone();
        self.at += 1;
        // A set of flags is its bits.
        if word == "Self" && self.take("(") {
            let value = self.operation(0)?;
            return self.take(")").then_some(value);
        }
        if word == "u32::MAX" {
            return Some(f64::from(u32::MAX));
        }
        if word.starts_with(|first: char| first.is_ascii_digit()) {
            return number(&word);
        }
        // Constants of a type name it or, in itself, `Self`.
        let word = word.strip_prefix("crate::").unwrap_or(&word);
        match value_of(word, self.constants, self.scope)?[..] {
            [value] => Some(value),
            _ => None,
        }
    }
}

/// A number of either language.
fn number(word: &str) -> Option<f64> {
    let word = word.replace('_', "");
    if let Some(digits) = word.strip_prefix("0x") {
        return Some(u64::from_str_radix(digits.trim_end_matches('u'), 16).ok()? as f64);
    }
    let suffixes = ["u32", "i32", "f32", "f64", "u64", "usize", "u", "i", "f"];
    let bare = suffixes.iter().find_map(|suffix| word.strip_suffix(suffix));
    bare.unwrap_or(&word).parse().ok()
}

/// Numbers, names with their paths, operators and brackets.
fn words_of(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut may_go_on = false;
    for mark in text.chars() {
        let is_word = mark.is_alphanumeric() || "_.:".contains(mark);
        let last = words.last_mut().filter(|_| may_go_on);
        match last {
            // The sign of an exponent belongs to its number.
            Some(word) if is_word || (mark == '-' && is_exponent(word)) => word.push(mark),
            Some(word) if "<>".contains(mark) && *word == mark.to_string() => word.push(mark),
            _ if !mark.is_whitespace() => words.push(mark.to_string()),
            _ => {}
        }
        may_go_on = is_word || "<>".contains(mark) || mark == '-';
        // Whatever stands behind an operator is a word of its own.
        if mark == '-' && words.last().is_some_and(|word| word == "-") {
            may_go_on = false;
        }
    }
    words
}

/// Whether a number ends in the mark of its exponent.
fn is_exponent(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_digit())
        && !word.starts_with("0x")
        && word.ends_with('e')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constants(text: &str) -> Constants {
        rust_constants(text)
    }

    #[test]
    fn expressions_have_the_values_that_compilers_give_them() {
        let all = constants(
            "impl Part {\n    pub const A: u32 = 1 << 4;\n    const B: u32 = Self::A | 3;\n}\n",
        );
        for (text, value) in [
            ("14u", 14.0),
            ("1e-3", 1e-3),
            ("0x7fff_ffffu", 2_147_483_647.0),
            ("1.0 / 65536.0", 1.0 / 65536.0),
            ("2 * (3 + 4) - 1", 13.0),
            ("-0.5", -0.5),
            ("u32::MAX", 4_294_967_295.0),
            ("!(1 << 31)", 2_147_483_647.0),
            ("Part::A | 3", 19.0),
            ("Part::B & 6", 2.0),
            ("Self(Part::A)", 16.0),
        ] {
            let read = Reader::new(text, &all, "").values();
            assert_eq!(read, Some(vec![value]), "{text}");
        }
        let list = Some(vec![0.25, -1.0, 7.0]);
        assert_eq!(
            Reader::new("vec3<f32>(0.25, -1.0, 7.0)", &all, "").values(),
            list
        );
        assert_eq!(Reader::new("[0.25, -1.0, 7.0]", &all, "").values(), list);
        for text in ["", "UNKNOWN", "1 +", "(1", "[1, 2", "f(1)", "1 2"] {
            assert_eq!(Reader::new(text, &all, "").values(), None, "{text}");
        }
    }

    #[test]
    fn declarations_are_read_whole() {
        let text = "/// Doc.\npub(crate) const LONG: u32 =\n    1 // one\n    | 2;\n\
                    const PAIR: [f32; 2] = [0.6, 0.4];\n\
                    #[cfg(test)]\nmod tests {\n    const LATE: u32 = 1;\n}\n";
        let all = constants(text);
        assert_eq!(value_of("LONG", &all, ""), Some(vec![3.0]));
        assert_eq!(value_of("PAIR[1]", &all, ""), Some(vec![0.4]));
        assert_eq!(value_of("PAIR[2]", &all, ""), None);
        assert!(!all.contains_key("LATE"));
    }

    #[test]
    fn what_differs_or_has_no_twin_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        let write = |path: &str, text: &str| {
            let path = root.join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            crate::file::write_whole(&path, text.as_bytes()).unwrap();
        };
        let message = || {
            check(root)
                .err()
                .map(|error| error.to_string())
                .unwrap_or_default()
        };
        write(
            "crates/npr-style/src/gloss.rs",
            "const SQUARE_PULL: f32 = 0.25;\n",
        );
        write("shaders/lib/gloss.wgsl", "const SQUARE_PULL: f32 = 0.25;\n");
        assert_eq!(message(), "");
        write("shaders/lib/gloss.wgsl", "const SQUARE_PULL: f32 = 0.26;\n");
        assert!(
            message().contains("SQUARE_PULL is [0.26], but"),
            "{}",
            message()
        );
        write("shaders/lib/gloss.wgsl", "const LONELY: f32 = 0.25;\n");
        assert!(message().contains("LONELY should be"), "{}", message());
        write("shaders/lib/new.wgsl", "const NEW: f32 = 0.25;\n");
        assert!(message().contains("NEW has no twin"), "{}", message());
    }
}
