//! Whether a device's result is as close to the twin's as the pass declares.

use npr_gpu::pass::{Agreement, Element, Format, Pass};

/// Largest difference of a channel that counts as equal in pictures.
const CHANNEL_TOLERANCE: u32 = 2;

/// The same for depths, which are floats 0..1.
const DEPTH_TOLERANCE: f32 = 2.0 / 255.0;

/// Fields of elements that hold several numbers a word: these are rounded, so that a device may be one step off.
const PACKED: [(&str, &str, Packing); 2] = [
    ("GPixel", "normal", Packing::Unit),
    ("TileRims", "rim", Packing::Bytes),
];

/// How a word holds several numbers.
#[derive(Debug, Clone, Copy)]
enum Packing {
    /// Two signed numbers of 16 bits, see `npr_core::math::pack_unit`.
    Unit,
    /// Four bytes.
    Bytes,
}

/// What a list of words means.
#[derive(Debug, Clone, Copy)]
pub enum Meaning {
    /// Elements of a buffer.
    Elements(Element),
    /// A list: the number of its elements, then they, in any order.
    List,
    /// Texels of an image.
    Texels(Format),
}

/// How the device's words differ from the twin's by more than the pass allows; `None` where they agree.
pub fn disagreement(pass: &Pass, meaning: Meaning, twin: &[u32], device: &[u32]) -> Option<String> {
    if twin.len() != device.len() {
        return Some(format!("{} words instead of {}", device.len(), twin.len()));
    }
    if matches!(meaning, Meaning::List) {
        return list_difference(twin, device);
    }
    let pairs = || twin.iter().copied().zip(device.iter().copied());
    match (pass.agreement, meaning) {
        (Agreement::Exact, _) => first_difference(meaning, pairs(), |_, a, b| a == b),
        (Agreement::Relative(bound), _) => first_difference(meaning, pairs(), |word, a, b| {
            is_same_field(meaning, word, [a, b], bound)
        }),
        (Agreement::NearlyAll { share, bound }, _) => {
            let agree = |word, a, b| is_same_field(meaning, word, [a, b], bound);
            let words = pairs().enumerate();
            let different = words.filter(|(word, (a, b))| !agree(*word, *a, *b)).count();
            let allowed = (share * twin.len() as f32) as usize;
            let first = first_difference(meaning, pairs(), agree);
            first
                .filter(|_| different > allowed)
                .map(|at| format!("{different} of {} words, first {at}", twin.len()))
        }
        (Agreement::Texels(share), _) => {
            let different = pairs()
                .filter(|(a, b)| !is_same_texel(meaning, *a, *b))
                .count();
            let allowed = (share * twin.len() as f32) as usize;
            let first = first_difference(meaning, pairs(), |_, a, b| is_same_texel(meaning, a, b));
            first
                .filter(|_| different > allowed)
                .map(|at| format!("{different} of {} texels, first {at}", twin.len()))
        }
    }
}

/// How two lists differ that hold their elements in any order.
fn list_difference(twin: &[u32], device: &[u32]) -> Option<String> {
    let sorted = |list: &[u32]| {
        let count = list.first().map_or(0, |count| *count as usize);
        let mut elements = list[1.min(list.len())..][..count].to_vec();
        elements.sort_unstable();
        elements
    };
    let (twin, device) = (sorted(twin), sorted(device));
    (twin != device).then(|| format!("a list of {} became one of {}", twin.len(), device.len()))
}

fn first_difference(
    meaning: Meaning,
    pairs: impl Iterator<Item = (u32, u32)>,
    agree: impl Fn(usize, u32, u32) -> bool,
) -> Option<String> {
    let mut apart = pairs
        .enumerate()
        .filter(|(word, (a, b))| !agree(*word, *a, *b));
    let (word, (twin, device)) = apart.next()?;
    let more = apart.count();
    let (twin_float, device_float) = (f32::from_bits(twin), f32::from_bits(device));
    let place = place_of(meaning, word);
    Some(format!(
        "{place}: {twin:#x} ({twin_float}) became {device:#x} ({device_float}); {more} more"
    ))
}

/// Equal as far as a pass promises that leaves a relative bound: floats are near, steps of packed numbers at most one
/// apart.
fn is_same_field(meaning: Meaning, word: usize, [a, b]: [u32; 2], bound: f32) -> bool {
    match packing_of(meaning, word) {
        Some(Packing::Unit) => halves(a)
            .iter()
            .zip(halves(b))
            .all(|(a, b)| a.abs_diff(b) <= 1),
        Some(Packing::Bytes) => bytes_are_near(a, b, 1),
        None => is_near(a, b, bound),
    }
}

/// How the field is packed that a word of an element belongs to.
fn packing_of(meaning: Meaning, word: usize) -> Option<Packing> {
    let Meaning::Elements(element) = meaning else {
        return None;
    };
    let field = field_of(&element, word)?;
    let is_it = |(name, packed, _): &&(&str, &str, _)| (*name, *packed) == (element.name, field);
    PACKED.iter().find(is_it).map(|(_, _, packing)| *packing)
}

fn halves(word: u32) -> [i16; 2] {
    [word as i16, (word >> 16) as i16]
}

/// Whether no byte is more than so much off.
fn bytes_are_near(a: u32, b: u32, most: u32) -> bool {
    let mut pairs = a.to_le_bytes().into_iter().zip(b.to_le_bytes());
    pairs.all(|(a, b)| u32::from(a.abs_diff(b)) <= most)
}

/// The field that a word of a list of elements belongs to; none in scalars.
fn field_of(element: &Element, word: usize) -> Option<&'static str> {
    let offset = word * 4 % element.size;
    let mut before = element.fields.iter().rev();
    let field = before.find(|field| field.offset <= offset)?;
    Some(field.name)
}

/// The element and field of a word.
fn place_of(meaning: Meaning, word: usize) -> String {
    let Meaning::Elements(element) = meaning else {
        return format!("texel {word}");
    };
    let (index, offset) = (word * 4 / element.size, word * 4 % element.size);
    let field = field_of(&element, word).unwrap_or_default();
    format!("element {index} .{field} + {offset}")
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
        Meaning::List => a == b,
        // Numbers must be equal; depths whose low bits say which samples are covered, in those bits alone.
        Meaning::Texels(Format::U32) => a == b || (a & 15 == b & 15 && is_near(a, b, 1e-4)),
        Meaning::Texels(Format::Depth) => {
            (f32::from_bits(a) - f32::from_bits(b)).abs() <= DEPTH_TOLERANCE
        }
        Meaning::Texels(Format::Rgba8) | Meaning::Elements(_) => {
            bytes_are_near(a, b, CHANNEL_TOLERANCE)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample_passes::DOUBLE;
    use npr_core::geometry::Stamp;

    fn differ(agreement: Agreement, meaning: Meaning, twin: &[u32], device: &[u32]) -> bool {
        disagreement(
            &Pass {
                agreement,
                ..DOUBLE
            },
            meaning,
            twin,
            device,
        )
        .is_some()
    }

    #[test]
    fn integers_must_be_equal_and_floats_near() {
        let (bound, stamps) = (
            Agreement::Relative(1e-3),
            Meaning::Elements(Element::of::<Stamp>()),
        );
        let stamp = |x: f32, part: u32| [x.to_bits(), 0, 0, part];
        assert!(!differ(bound, stamps, &stamp(100.0, 3), &stamp(100.05, 3)));
        assert!(differ(bound, stamps, &stamp(100.0, 3), &stamp(100.5, 3)));
        assert!(differ(bound, stamps, &stamp(100.0, 3), &stamp(100.0, 4)));
        assert!(differ(
            bound,
            stamps,
            &stamp(100.0, u32::MAX),
            &stamp(100.0, 0)
        ));
        assert!(differ(bound, stamps, &stamp(f32::NAN, 0), &stamp(1.0, 0)));
    }

    #[test]
    fn packed_numbers_may_be_a_step_off() {
        let pixels = Meaning::Elements(Element::of::<npr_core::geometry::GPixel>());
        let pixel = |normal: u32, part: u32| [0, 0, 0, 0, normal, part];
        let (bound, seen) = (Agreement::Relative(1e-3), pixel(0xfdcb_d94f, 7));
        assert!(!differ(bound, pixels, &seen, &pixel(0xfdcc_d94e, 7)));
        assert!(differ(bound, pixels, &seen, &pixel(0xfdcd_d94f, 7)));
        assert!(differ(bound, pixels, &seen, &pixel(0xfdcb_d94f, 8)));
    }

    #[test]
    fn pictures_may_differ_in_a_share_of_texels() {
        let (share, bytes) = (Agreement::Texels(0.25), Meaning::Texels(Format::Rgba8));
        assert!(!differ(share, bytes, &[0x10; 4], &[0x12; 4]));
        assert!(!differ(share, bytes, &[0x10; 4], &[0x10, 0x10, 0x10, 0x80]));
        assert!(differ(share, bytes, &[0x10; 4], &[0x10, 0x10, 0x13, 0x80]));
    }

    #[test]
    fn one_wrong_bit_is_named() {
        let words = Meaning::Elements(Element::of::<u32>());
        let found = disagreement(&DOUBLE, words, &[1, 2, 3], &[1, 2, 7]).unwrap();
        assert!(found.starts_with("element 2 "), "{found}");
    }
}
