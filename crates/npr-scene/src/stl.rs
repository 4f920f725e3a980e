//! STL files, binary and text [3D Systems 1988]. Triangles keep their own corners; normals are left to
//! flat shading, since those in files are often wrong.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

pub(crate) mod binary;
pub(crate) mod error;

pub use error::StlError;

use crate::error::SceneError;
use crate::loading::Loading;
use crate::material::Material;
use crate::mesh::{Mesh, Part};
use crate::polygon;
use crate::scene::Scene;
use crate::words::{numbered_lines, triple, words};
use binary::{HEADER_BYTES, TRIANGLE_BYTES, is_binary, stated_count};

/// Reads an STL file. Binary files may open with "solid" as well, so their length decides first.
pub(crate) fn read(bytes: &[u8], loading: &mut Loading) -> Result<Scene, SceneError> {
    let is_text = !is_binary(bytes) && bytes.trim_ascii_start().starts_with(b"solid");
    let corners = if is_text {
        read_text(bytes, loading)?
    } else {
        read_binary(bytes, loading)?
    };
    Ok(soup(corners))
}

fn read_binary(bytes: &[u8], loading: &mut Loading) -> Result<Vec<[f32; 3]>, SceneError> {
    let stated = stated_count(bytes).ok_or(StlError::NoHeader { bytes: bytes.len() })?;
    let (triangles, _) = bytes
        .get(HEADER_BYTES..)
        .unwrap_or_default()
        .as_chunks::<TRIANGLE_BYTES>();
    let Some(triangles) = triangles.get(..stated as usize) else {
        return Err(StlError::Truncated {
            stated,
            held: triangles.len(),
        }
        .into());
    };
    loading.allowance.take_triangles(triangles.len())?;
    loading
        .allowance
        .take::<[[f32; 3]; 3]>("vertex data", triangles.len())?;
    Ok(triangles.iter().flat_map(binary_corners).collect())
}

fn binary_corners(triangle: &[u8; TRIANGLE_BYTES]) -> [[f32; 3]; 3] {
    let (numbers, _) = triangle.as_chunks::<4>();
    let number = |index: usize| {
        numbers
            .get(index)
            .copied()
            .map_or(f32::NAN, f32::from_le_bytes)
    };
    [
        [number(3), number(4), number(5)],
        [number(6), number(7), number(8)],
        [number(9), number(10), number(11)],
    ]
}

fn read_text(bytes: &[u8], loading: &mut Loading) -> Result<Vec<[f32; 3]>, SceneError> {
    // Cut every facet into triangles as it ends.
    let mut corners = Vec::new();
    let mut facet = Vec::new();
    let mut last_line = 0;
    for (line, text) in numbered_lines(bytes) {
        last_line = line;
        let fail = |fault| StlError::Line { line, fault };
        let mut words = words(text);
        match words.next() {
            Some(b"vertex") => {
                facet.push(triple(&mut words).ok_or(fail("a vertex needs three numbers"))?)
            }
            Some(b"endloop") if facet.len() < 3 => {
                return Err(fail("a facet has fewer than three corners").into());
            }
            Some(b"endloop") => {
                loading
                    .allowance
                    .take_triangles(facet.len().saturating_sub(2))?;
                corners.extend(polygon::fan(&facet).flatten());
                facet.clear();
            }
            _ => {}
        }
    }

    // Refuse a file that ends within a facet.
    if !facet.is_empty() {
        return Err(StlError::Line {
            line: last_line,
            fault: "the file ends inside a facet",
        }
        .into());
    }
    Ok(corners)
}

fn soup(positions: Vec<[f32; 3]>) -> Scene {
    // Give every triangle its own corners.
    if positions.is_empty() {
        return Scene::default();
    }
    let corners: Vec<u32> = (0u32..).take(positions.len()).collect();
    let triangles = corners.as_chunks::<3>().0.to_vec();
    let part = Part {
        positions,
        triangles,
        material: Some(0),
        ..Part::default()
    };

    // Show both sides of every triangle.
    let material = Material {
        double_sided: true,
        ..Material::default()
    };
    Scene::of_meshes(
        vec![Mesh {
            name: String::new(),
            parts: vec![part],
        }],
        vec![material],
    )
}
