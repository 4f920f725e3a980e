//! STL files, binary and text [3D Systems 1988]. Triangles keep their own corners; normals are left to
//! flat shading, since those in files are often wrong.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use crate::error::SceneError;
use crate::load::Loading;
use crate::material::Material;
use crate::mesh::{Mesh, Part};
use crate::polygon;
use crate::scene::Scene;
use crate::words::{numbered_lines, triple, words};

/// Bytes before the first triangle of a binary file: a comment and a count.
const HEADER_BYTES: usize = 84;

/// Bytes of a triangle: normal, three corners, two bytes of attributes.
const TRIANGLE_BYTES: usize = 50;

/// What is wrong with an STL file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StlError {
    /// The file is too short for a header.
    #[error("the file has {bytes} bytes, but the header alone takes {HEADER_BYTES}")]
    NoHeader {
        /// Size of the file.
        bytes: usize,
    },
    /// The file ends before its last triangle.
    #[error("the header announces {stated} triangles, but the file holds only {held}")]
    Truncated {
        /// How many triangles the header announces.
        stated: u32,
        /// How many whole triangles follow.
        held: usize,
    },
    /// A line of a text file makes no sense.
    #[error("line {line}: {fault}")]
    Line {
        /// Line, counted from 1.
        line: usize,
        /// What is wrong there.
        fault: &'static str,
    },
}

/// Whether `bytes` are as long as a binary header says.
pub(crate) fn is_binary(bytes: &[u8]) -> bool {
    let length = stated_count(bytes).and_then(|count| (count as usize).checked_mul(TRIANGLE_BYTES));
    length.and_then(|length| length.checked_add(HEADER_BYTES)) == Some(bytes.len())
}

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

fn stated_count(bytes: &[u8]) -> Option<u32> {
    bytes
        .get(80..)?
        .first_chunk()
        .copied()
        .map(u32::from_le_bytes)
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
