//! Triangles from triangle lists, strips and fans [glTF 2.0, section 3.7.2.1].
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
    fn a_fan_turns_about_its_first_corner() {
        assert_eq!(fan(&[7, 1, 2, 3]), [[7, 1, 2], [7, 2, 3]]);
        assert!(fan(&[]).is_empty());
    }
}
