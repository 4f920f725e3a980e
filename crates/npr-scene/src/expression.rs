//! Expressions of avatars: what they bind, and how they act on each other [VRM 1.0, expressions].

use std::collections::BTreeMap;

/// The expressions that VRM names, in 1.0 and in 0.x, which has no `surprised` of its own.
pub(crate) const PRESETS: [[&str; 2]; 18] = [
    ["happy", "joy"],
    ["angry", "angry"],
    ["sad", "sorrow"],
    ["relaxed", "fun"],
    ["surprised", "surprised"],
    ["aa", "a"],
    ["ih", "i"],
    ["ou", "u"],
    ["ee", "e"],
    ["oh", "o"],
    ["blink", "blink"],
    ["blinkLeft", "blink_l"],
    ["blinkRight", "blink_r"],
    ["lookUp", "lookup"],
    ["lookDown", "lookdown"],
    ["lookLeft", "lookleft"],
    ["lookRight", "lookright"],
    ["neutral", "neutral"],
];

/// Share of a binary expression above which it shows.
const BINARY_FROM: f32 = 0.5;

/// A face that an avatar makes, or whatever else one number lets it do.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Expression {
    /// Its name; one that VRM has a name for is called as VRM 1.0 does.
    pub name: String,
    /// What the file calls it, which in VRM 0.x may be something else.
    pub file_name: String,
    /// Whether it shows whole, from a share above one half, or not at all.
    pub is_binary: bool,
    /// What it does to expressions that blink.
    pub of_blinks: Override,
    /// What it does to expressions that look.
    pub of_looks: Override,
    /// What it does to expressions of the mouth.
    pub of_mouths: Override,
    /// Morphs that it moves.
    pub morphs: Vec<MorphBind>,
    /// Base colours that it changes.
    pub colors: Vec<ColorBind>,
    /// Textures that it shifts.
    pub textures: Vec<TextureBind>,
}

/// What an expression does to others of a kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Override {
    /// Nothing.
    #[default]
    None,
    /// They do not show as long as it does.
    Block,
    /// They show the less, the more it does.
    Blend,
}

/// A morph of a node's mesh that an expression moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MorphBind {
    /// The node.
    pub node: u32,
    /// The morph, by its place in the list of the mesh.
    pub morph: u32,
    /// Its weight where the expression shows whole.
    pub weight: f32,
}

/// A base colour that an expression changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorBind {
    /// The material.
    pub material: u32,
    /// The colour where the expression shows whole, linear with straight alpha.
    pub color: [f32; 4],
}

/// Coordinates of a texture that an expression changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureBind {
    /// The material.
    pub material: u32,
    /// The factors where the expression shows whole.
    pub scale: [f32; 2],
    /// The offset there, in widths and heights of the image.
    pub offset: [f32; 2],
}

/// Expressions of one kind, which others may override.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Blink,
    Look,
    Mouth,
}

impl Kind {
    /// The kind that an expression is of by its name; most are of none.
    fn of(name: &str) -> Option<Self> {
        match name {
            "blink" | "blinkLeft" | "blinkRight" => Some(Self::Blink),
            "lookUp" | "lookDown" | "lookLeft" | "lookRight" => Some(Self::Look),
            "aa" | "ih" | "ou" | "ee" | "oh" => Some(Self::Mouth),
            _ => None,
        }
    }
}

impl Expression {
    /// How much it shows at a share, before others override it.
    fn shown(&self, share: f32) -> f32 {
        let share = if share.is_nan() { 0.0 } else { share };
        match self.is_binary {
            true if share > BINARY_FROM => 1.0,
            true => 0.0,
            false => share.clamp(0.0, 1.0),
        }
    }

    /// How much it takes from others of a kind, where it shows so much.
    fn taken(&self, kind: Kind, shown: f32) -> f32 {
        let does = match kind {
            Kind::Blink => self.of_blinks,
            Kind::Look => self.of_looks,
            Kind::Mouth => self.of_mouths,
        };
        match does {
            Override::None => 0.0,
            Override::Block if shown > 0.0 => 1.0,
            Override::Block => 0.0,
            Override::Blend => shown,
        }
    }
}

/// What others leave of expressions that look, 0 to 1, where expressions have shares.
pub(crate) fn left_of_looks(expressions: &[Expression], shares: &BTreeMap<u32, f32>) -> f32 {
    left(expressions, &alone(expressions, shares), Kind::Look)
}

/// How much expressions would show if none overrode another.
fn alone(expressions: &[Expression], shares: &BTreeMap<u32, f32>) -> Vec<f32> {
    let share = |number: u32| shares.get(&number).copied().unwrap_or(0.0);
    let all = (0u32..).zip(expressions);
    all.map(|(number, expression)| expression.shown(share(number)))
        .collect()
}

/// What expressions that would show so much alone leave of a kind.
fn left(expressions: &[Expression], alone: &[f32], kind: Kind) -> f32 {
    let all = expressions.iter().zip(alone);
    let taken = all.map(|(expression, shown)| expression.taken(kind, *shown));
    (1.0 - taken.sum::<f32>()).max(0.0)
}

/// How much each of some expressions shows, 0 to 1, where they have shares, by number; the others have 0.
///
/// What overrides a kind takes from all of it, from itself too where it is of that kind, and adds up. A binary one
/// that others override at all does not show. So does three-vrm.
pub(crate) fn shown(expressions: &[Expression], shares: &BTreeMap<u32, f32>) -> Vec<f32> {
    // Take from each what others override.
    let alone = alone(expressions, shares);
    let left = |kind| left(expressions, &alone, kind);
    let [blinks, looks, mouths] = [Kind::Blink, Kind::Look, Kind::Mouth].map(left);
    let of = |(expression, alone): (&Expression, &f32)| {
        let left = match Kind::of(&expression.name) {
            Some(Kind::Blink) => blinks,
            Some(Kind::Look) => looks,
            Some(Kind::Mouth) => mouths,
            None => 1.0,
        };
        match (expression.is_binary, alone * left) {
            (true, shown) if shown < 1.0 => 0.0,
            (_, shown) => shown,
        }
    };
    expressions.iter().zip(&alone).map(of).collect()
}

/// The expression of a name, by number: its own, or else that of VRM 0.x, in any letter case.
pub(crate) fn find(expressions: &[Expression], asked: &str) -> Option<u32> {
    let position = |is_it: &dyn Fn(&Expression) -> bool| {
        let found = expressions.iter().position(is_it);
        found.map(|number| number as u32)
    };
    let low = asked.to_lowercase();
    let old = PRESETS.iter().find(|[_, old]| *old == low);
    position(&|expression| expression.name == asked)
        .or_else(|| position(&|expression| expression.name.to_lowercase() == low))
        .or_else(|| position(&|expression| expression.file_name.to_lowercase() == low))
        .or_else(|| position(&|expression| old.is_some_and(|[new, _]| expression.name == *new)))
}

#[cfg(test)]
mod tests;
