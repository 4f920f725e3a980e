//! Reads a style and lays it over its parents.

use npr_core::decoding::guard;
use toml::{Table, Value};

use crate::error::{StyleError, brief};
use crate::former;
use crate::{Style, check, place, preset};

/// Longest style text that is read, in bytes.
pub const TEXT_BYTES_MAX: usize = 1 << 20;

/// Most parents that a style may have, parents of parents included.
pub const PARENTS_MAX: usize = 64;

/// Most dots in a line. Every dot nests a key one level deeper, and the TOML parser recurses over levels.
const DOTS_MAX: usize = 1000;

/// Lists that are appended to those of a parent instead of replacing them.
const ADDED_UP: [&str; 2] = ["rule", "id_map"];

/// The tables that say how lines are drawn.
const STROKES: [&str; 2] = ["line", "paper"];

/// A function that finds the text of a parent by its name.
type Load<'a> = &'a dyn Fn(&str) -> Result<String, String>;

/// A style file that was read.
pub(crate) struct Read {
    /// The style, merged over its parents.
    pub style: Style,
    /// The keys that stand in the file or its parents, without those of presets.
    pub stated: Table,
    /// Keys that it or its parents give under former names.
    pub former: Vec<String>,
}

/// Reads the style of `text` and merges it over its parents; see [`Style::from_toml`].
pub(crate) fn read(text: &str, load: Load<'_>) -> Result<Read, StyleError> {
    let mut stack = Stack {
        load,
        open: Vec::new(),
        loaded: 0,
        former: Vec::new(),
    };
    let flat = stack.flatten(text)?;
    let style =
        from_table(flat.all).map_err(|error| error.placed(|key| place::of_key(text, key)))?;
    Ok(Read {
        style,
        stated: flat.stated,
        former: stack.former,
    })
}

/// The table of a style with the strokes of a preset in place of its own.
///
/// # Errors
///
/// [`StyleError::UnknownPreset`] and the like; [`StyleError::Load`] for the name of a file.
pub(crate) fn with_strokes(mut look: Table, preset: &str) -> Result<Table, StyleError> {
    let mut stack = Stack {
        load: &|_| Err("an override takes the strokes of presets alone".to_owned()),
        open: Vec::new(),
        loaded: 0,
        former: Vec::new(),
    };
    take_strokes(&mut look, stack.parent(preset)?.all);
    Ok(look)
}

/// The style that a checked table describes.
pub(crate) fn from_table(table: Table) -> Result<Style, StyleError> {
    let style: Style = table
        .try_into()
        .map_err(|error: toml::de::Error| StyleError::Syntax {
            place: None,
            message: error.message().to_owned(),
        })?;
    style.sanity_check()?;
    Ok(style)
}

/// The parents being read, outermost first.
struct Stack<'a> {
    load: Load<'a>,
    open: Vec<String>,
    loaded: usize,
    /// Keys that any of the files gives under former names.
    former: Vec<String>,
}

/// A style merged over its parents, as TOML tables.
#[derive(Default)]
struct Flat {
    /// All keys.
    all: Table,
    /// Keys that are in no preset. List entries of presets are empty tables here, so that other entries keep their
    /// numbers.
    stated: Table,
}

impl Flat {
    /// Merges `upper` over this style.
    fn merge(&mut self, upper: Self) {
        merge(&mut self.all, upper.all);
        merge(&mut self.stated, upper.stated);
    }

    /// Takes the strokes of another style in place of its own.
    fn take_strokes(&mut self, of: Self) {
        take_strokes(&mut self.all, of.all);
        take_strokes(&mut self.stated, of.stated);
    }

    /// The style as that of a preset, whose keys do not count as stated.
    fn of_preset(mut self) -> Self {
        let stated = std::mem::take(&mut self.stated).into_iter();
        let added_up = stated.filter_map(|(key, value)| match value {
            Value::Array(entries) if ADDED_UP.contains(&key.as_str()) => {
                let nothing = vec![Value::Table(Table::new()); entries.len()];
                Some((key, Value::Array(nothing)))
            }
            _ => None,
        });
        self.stated = added_up.collect();
        self
    }
}

impl Stack<'_> {
    /// The table of `text` merged over its parents and strokes, `extends` and `strokes` removed.
    fn flatten(&mut self, text: &str) -> Result<Flat, StyleError> {
        let mut all = parse(text)?;
        self.former.extend(former::rename(&mut all));
        check::check(&all).map_err(|error| error.placed(|key| place::of_key(text, key)))?;
        let mut merged = Flat::default();
        for parent in names(all.remove("extends")) {
            merged.merge(self.parent(&parent)?);
        }
        if let Some(Value::String(name)) = all.remove("strokes")
            && !name.is_empty()
        {
            merged.take_strokes(self.parent(&name)?);
        }
        let stated = all.clone();
        merged.merge(Flat { all, stated });
        Ok(merged)
    }

    /// The table of a parent by name. Title and version describe the parent alone and stay behind.
    fn parent(&mut self, name: &str) -> Result<Flat, StyleError> {
        // Refuse parents that extend each other, and too many of them.
        if self.open.iter().any(|open| open == name) {
            return Err(StyleError::Cycle {
                parent: name.to_owned(),
            });
        }
        self.loaded += 1;
        if self.loaded > PARENTS_MAX {
            return Err(StyleError::TooManyParents { limit: PARENTS_MAX });
        }

        // Read the parent over its own parents.
        let text = self.text(name)?;
        self.open.push(name.to_owned());
        let flat = self
            .flatten(&text)
            .map_err(|source| in_parent(name, source));
        self.open.pop();

        // Remove keys that describe the parent alone. Keys of presets do not count as stated.
        let mut flat = flat?;
        if preset::is_name(name) {
            flat = flat.of_preset();
        }
        for key in ["title", "version"] {
            flat.all.remove(key);
            flat.stated.remove(key);
        }
        Ok(flat)
    }

    fn text(&self, name: &str) -> Result<String, StyleError> {
        if preset::is_name(name) {
            return Ok(preset::find(name)?.text.to_owned());
        }
        (self.load)(name).map_err(|reason| StyleError::Load {
            parent: name.to_owned(),
            reason,
        })
    }
}

/// Names the parent at fault, once: a fault in a parent's parent keeps the inner name.
fn in_parent(name: &str, source: StyleError) -> StyleError {
    match source {
        StyleError::InParent { .. }
        | StyleError::Cycle { .. }
        | StyleError::TooManyParents { .. } => source,
        _ => StyleError::InParent {
            parent: name.to_owned(),
            source: Box::new(source),
        },
    }
}

/// The TOML table of a text that is neither too long nor too deep.
fn parse(text: &str) -> Result<Table, StyleError> {
    // Refuse texts that are too long or too deep to be read safely.
    if text.len() > TEXT_BYTES_MAX {
        return Err(StyleError::TooLarge {
            bytes: text.len(),
            limit_bytes: TEXT_BYTES_MAX,
        });
    }
    if let Some(line) = text
        .lines()
        .position(|line| line.matches('.').count() > DOTS_MAX)
    {
        let place = Some(crate::SourceLocation {
            line: line + 1,
            column: 1,
        });
        return Err(StyleError::Syntax {
            place,
            message: format!("more than {DOTS_MAX} dots in a line"),
        });
    }

    // Parse the text, and report where it is not TOML.
    let parsed = guard(|| text.parse::<Table>()).map_err(|stopped| StyleError::Syntax {
        place: None,
        message: stopped.to_string(),
    })?;
    parsed.map_err(|error| StyleError::Syntax {
        place: error.span().map(|span| place::of_byte(text, span.start)),
        message: brief(error.message()),
    })
}

fn names(extends: Option<Value>) -> Vec<String> {
    match extends {
        Some(Value::String(name)) => vec![name],
        Some(Value::Array(names)) => names
            .into_iter()
            .filter_map(|name| name.as_str().map(str::to_owned))
            .collect(),
        _ => Vec::new(),
    }
}

/// Puts the strokes of another style into that of a look: the tables about lines, and what rules say about lines.
fn take_strokes(look: &mut Table, mut of: Table) {
    for key in STROKES {
        look.remove(key);
        let own = of.remove(key);
        look.extend(own.map(|table| (key.to_owned(), table)));
    }
    if let Some(Value::Array(rules)) = of.remove("rule") {
        let about_lines = rules.into_iter().map(|rule| match rule {
            Value::Table(mut rule) => {
                rule.retain(|key, _| ["match", "line"].contains(&key));
                Value::Table(rule)
            }
            other => other,
        });
        let rules = Value::Array(about_lines.collect());
        merge(look, Table::from_iter([("rule".to_owned(), rules)]));
    }
}

/// Merges `upper` over `lower`: tables merge key by key, the lists `rule` and `id_map` are appended, any other value
/// replaces the lower one.
pub(crate) fn merge(lower: &mut Table, upper: Table) {
    for (key, value) in upper {
        match (lower.get_mut(&key), value) {
            (Some(Value::Table(below)), Value::Table(above)) => merge(below, above),
            (Some(Value::Array(below)), Value::Array(above))
                if ADDED_UP.contains(&key.as_str()) =>
            {
                below.extend(above)
            }
            (_, value) => {
                lower.insert(key, value);
            }
        }
    }
}
