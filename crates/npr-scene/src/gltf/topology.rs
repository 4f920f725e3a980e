//! Triangles from triangle lists, strips and fans, and segments from line lists, strips and loops [glTF 2.0, section
//! 3.7.2.1].
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::mesh::{Mode, Primitive};
use ::gltf::json::validation::Checked;

/// Whether `primitive` consists of triangles.
pub(crate) fn is_surface(primitive: &Primitive) -> bool {
    matches!(
        primitive.mode,
        Checked::Valid(Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)
    )
}

/// Whether `primitive` consists of lines.
pub(crate) fn is_of_lines(primitive: &Primitive) -> bool {
    matches!(
        primitive.mode,
        Checked::Valid(Mode::Lines | Mode::LineStrip | Mode::LineLoop)
    )
}

/// How many line segments `end_count` ends make.
pub(crate) fn segment_count(primitive: &Primitive, end_count: usize) -> usize {
    match primitive.mode {
        Checked::Valid(Mode::Lines) => end_count / 2,
        Checked::Valid(Mode::LineLoop) if end_count > 2 => end_count,
        _ => end_count.saturating_sub(1),
    }
}

/// Whether `end_count` ends leave one over.
pub(crate) fn has_odd_end(primitive: &Primitive, end_count: usize) -> bool {
    match primitive.mode {
        Checked::Valid(Mode::Lines) => !end_count.is_multiple_of(2),
        _ => end_count == 1,
    }
}

/// The line segments of `primitive`; an end that completes none is dropped, and a loop through two vertices is one
/// segment.
pub(crate) fn segments(primitive: &Primitive, ends: &[[u32; 1]]) -> Vec<[u32; 2]> {
    let ends = ends.as_flattened();
    match primitive.mode {
        Checked::Valid(Mode::Lines) => ends.as_chunks::<2>().0.to_vec(),
        Checked::Valid(Mode::LineLoop) if ends.len() > 2 => {
            let back = ends.first().copied().zip(ends.last().copied());
            let back = back.map(|(first, last)| [last, first]);
            ends.array_windows::<2>().copied().chain(back).collect()
        }
        _ => ends.array_windows::<2>().copied().collect(),
    }
}

/// How many triangles `corner_count` corners make.
pub(crate) fn triangle_count(primitive: &Primitive, corner_count: usize) -> usize {
    match primitive.mode {
        Checked::Valid(Mode::Triangles) => corner_count / 3,
        _ => corner_count.saturating_sub(2),
    }
}

/// The triangles of `primitive`, all winding the same way; corners that complete none are dropped.
pub(crate) fn triangles(primitive: &Primitive, corners: &[[u32; 1]]) -> Vec<[u32; 3]> {
    let corners = corners.as_flattened();
    match primitive.mode {
        Checked::Valid(Mode::TriangleStrip) => strip(corners),
        Checked::Valid(Mode::TriangleFan) => fan(corners),
        _ => corners.as_chunks::<3>().0.to_vec(),
    }
}

/// Every second triangle of a strip winds the other way, so two of its corners swap.
fn strip(corners: &[u32]) -> Vec<[u32; 3]> {
    let flips = [false, true].into_iter().cycle();
    let triangles = corners.array_windows::<3>().zip(flips);
    triangles
        .map(|(&[a, b, c], flip)| if flip { [b, a, c] } else { [a, b, c] })
        .collect()
}

fn fan(corners: &[u32]) -> Vec<[u32; 3]> {
    let Some((&hub, rim)) = corners.split_first() else {
        return Vec::new();
    };
    rim.array_windows::<2>()
        .map(|&[b, c]| [hub, b, c])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_keeps_its_winding() {
        assert_eq!(strip(&[0, 1, 2, 3, 4]), [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
        assert!(strip(&[0, 1]).is_empty());
    }

    #[test]
    fn lines_are_pairs_chains_or_rings() {
        let lines = |mode, ends: &[u32]| {
            let json = format!(r#"{{"attributes": {{}}, "mode": {mode}}}"#);
            let primitive: Primitive =
                ::gltf::json::deserialize::from_str(&json).expect("a primitive");
            assert!(is_of_lines(&primitive) && !is_surface(&primitive));
            let ends: Vec<[u32; 1]> = ends.iter().map(|end| [*end]).collect();
            let found = segments(&primitive, &ends);
            assert_eq!(found.len(), segment_count(&primitive, ends.len()));
            found
        };
        assert_eq!(lines(1, &[4, 5, 5, 6, 7]), [[4, 5], [5, 6]]);
        assert_eq!(lines(2, &[4, 5, 6]), [[4, 5], [5, 6], [6, 4]]);
        assert_eq!(lines(2, &[4, 5]), [[4, 5]]);
        assert_eq!(lines(3, &[4, 5, 6]), [[4, 5], [5, 6]]);
        for mode in [1, 2, 3] {
            assert!(lines(mode, &[]).is_empty() && lines(mode, &[4]).is_empty());
        }
    }

    #[test]
    fn a_fan_turns_about_its_first_corner() {
        assert_eq!(fan(&[7, 1, 2, 3]), [[7, 1, 2], [7, 2, 3]]);
        assert!(fan(&[]).is_empty());
    }
}
