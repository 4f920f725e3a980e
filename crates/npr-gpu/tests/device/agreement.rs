//! Whether a device's result is as close to the twin's as the pass declares.

use npr_gpu::pass::{Agreement, Element, Format, Pass};

/// Largest difference of a channel that counts as equal in pictures.
const CHANNEL_TOLERANCE: u32 = 2;

/// The same for depths, which are floats 0..1.
const DEPTH_TOLERANCE: f32 = 2.0 / 255.0;

/// What a list of words means.
#[derive(Debug, Clone, Copy)]
pub enum Meaning {
    /// Elements of a buffer.
    Elements(Element),
    /// Texels of an image.
    Texels(Format),
}

/// How the device's words differ from the twin's by more than the pass allows; `None` where they agree.
pub fn disagreement(pass: &Pass, meaning: Meaning, twin: &[u32], device: &[u32]) -> Option<String> {
    if twin.len() != device.len() {
        return Some(format!("{} words instead of {}", device.len(), twin.len()));
    }
    let pairs = || twin.iter().copied().zip(device.iter().copied());
    match (pass.agreement, meaning) {
        (Agreement::Exact, _) => first_difference(meaning, pairs(), |a, b| a == b),
        (Agreement::Relative(bound), _) => {
            first_difference(meaning, pairs(), |a, b| is_near(a, b, bound))
        }
        (Agreement::Texels(share), _) => {
            let different = pairs()
                .filter(|(a, b)| !is_same_texel(meaning, *a, *b))
                .count();
            let allowed = (share * twin.len() as f32) as usize;
            let first = first_difference(meaning, pairs(), |a, b| is_same_texel(meaning, a, b));
            first
                .filter(|_| different > allowed)
                .map(|at| format!("{different} of {} texels, first {at}", twin.len()))
        }
    }
}

fn first_difference(
    meaning: Meaning,
    mut pairs: impl Iterator<Item = (u32, u32)>,
    agree: impl Fn(u32, u32) -> bool,
) -> Option<String> {
    let mut at = None;
    pairs
        .by_ref()
        .enumerate()
        .find(|(i, (a, b))| !agree(*a, *b) && at.replace((*i, *a, *b)).is_none());
    let (word, twin, device) = at?;
    let more = pairs.filter(|(a, b)| !agree(*a, *b)).count();
    let (twin_float, device_float) = (f32::from_bits(twin), f32::from_bits(device));
    let place = place_of(meaning, word);
    Some(format!(
        "{place}: {twin:#x} ({twin_float}) became {device:#x} ({device_float}); {more} more"
    ))
}

/// The element and field of a word.
fn place_of(meaning: Meaning, word: usize) -> String {
    let Meaning::Elements(element) = meaning else {
        return format!("texel {word}");
    };
    let (index, offset) = (word * 4 / element.size, word * 4 % element.size);
    let field = element
        .fields
        .iter()
        .rev()
        .find(|field| field.offset <= offset);
    format!(
        "element {index} .{} + {offset}",
        field.map_or("", |field| field.name)
    )
}

/// Equal, or floats within a bound relative to the larger magnitude, at least 1.
///
/// Small integers look like subnormal floats, and "none" like no number: those must be equal.
fn is_near(a: u32, b: u32, bound: f32) -> bool {
    let (x, y) = (f32::from_bits(a), f32::from_bits(b));
    let is_float = |v: f32| v == 0.0 || v.is_normal();
    a == b || (is_float(x) && is_float(y) && (x - y).abs() <= bound * x.abs().max(y.abs()).max(1.0))
}

fn is_same_texel(meaning: Meaning, a: u32, b: u32) -> bool {
    match meaning {
        Meaning::Texels(Format::U32) => a == b,
        Meaning::Texels(Format::Depth) => {
            (f32::from_bits(a) - f32::from_bits(b)).abs() <= DEPTH_TOLERANCE
        }
        Meaning::Texels(Format::Rgba8) | Meaning::Elements(_) => a
            .to_le_bytes()
            .iter()
            .zip(b.to_le_bytes())
            .all(|(a, b)| u32::from(a.abs_diff(b)) <= CHANNEL_TOLERANCE),
    }
}
