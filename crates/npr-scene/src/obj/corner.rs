//! Corners of faces and polylines: which position, texture coordinate and normal meet there.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::collections::HashMap;

use super::{Element, ObjError};
use crate::limits::LimitError;
use crate::loading::Loading;
use crate::mesh::Part;
use crate::words::words;

/// An index that a corner leaves out.
const NONE: u32 = u32::MAX;

/// Indices from 0 into the tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Corner {
    position: u32,
    uv: u32,
    normal: u32,
}

/// What the file has defined so far.
#[derive(Debug, Default)]
pub(crate) struct Tables {
    pub(crate) positions: Vec<[f32; 3]>,
    pub(crate) uvs: Vec<[f32; 2]>,
    pub(crate) normals: Vec<[f32; 3]>,
    /// Linear colours; empty, or one per position.
    colors: Vec<[f32; 3]>,
}

impl Tables {
    /// Notes the colour of the last position. Positions without one are white beside those with.
    pub(crate) fn push_color(&mut self, color: Option<[f32; 3]>) {
        if color.is_some() || !self.colors.is_empty() {
            self.colors.resize(self.positions.len(), [1.0; 3]);
        }
        if let (Some(color), Some(last)) = (color, self.colors.last_mut()) {
            *last = color;
        }
    }

    /// The corners that `rest`, the line of an element after its keyword, names.
    pub(crate) fn corners(
        &self,
        line: usize,
        element: Element,
        rest: &[u8],
    ) -> Result<Vec<Corner>, ObjError> {
        let corners: Vec<Corner> = words(rest)
            .map(|word| self.corner(line, element, word))
            .collect::<Result<_, _>>()?;
        if corners.len() < element.least() {
            return Err(ObjError::FewCorners {
                line,
                element,
                corner_count: corners.len(),
            });
        }
        Ok(corners)
    }

    fn corner(&self, line: usize, element: Element, word: &[u8]) -> Result<Corner, ObjError> {
        // Resolve each field of the corner against what is defined so far.
        let mut fields = word.split(|&byte| byte == b'/');
        let mut index = |what, count| {
            let field = fields.next().unwrap_or_default();
            if field.is_empty() {
                return Ok(NONE);
            }
            let bad = || ObjError::Corner {
                line,
                element,
                corner: String::from_utf8_lossy(word).into_owned(),
            };
            let index: i64 = str::from_utf8(field)
                .ok()
                .and_then(|text| text.parse().ok())
                .ok_or_else(bad)?;
            resolve(index, count).ok_or(ObjError::Missing {
                line,
                element,
                what,
                index,
                count,
            })
        };

        // Demand a position; the other fields may be left out.
        let position = index("vertex", self.positions.len())?;
        let uv = index("texture coordinate", self.uvs.len())?;
        let normal = index("normal", self.normals.len())?;
        if position == NONE {
            let corner = String::from_utf8_lossy(word).into_owned();
            return Err(ObjError::Corner {
                line,
                element,
                corner,
            });
        }
        Ok(Corner {
            position,
            uv,
            normal,
        })
    }

    /// The part of these triangles and segments, with one vertex for each distinct corner, in order of first use.
    pub(crate) fn part(
        &self,
        material: Option<u32>,
        triangles: &[[Corner; 3]],
        segments: &[[Corner; 2]],
        loading: &mut Loading,
    ) -> Result<Part, LimitError> {
        // Number the distinct corners.
        let mut numbers = Numbers::default();
        let triangles = numbers.of_all(triangles);
        let segments = numbers.of_all(segments);
        let vertices = numbers.vertices;
        loading
            .allowance
            .take::<[f32; 12]>("vertex data", vertices.len())?;

        // Keep lists that say something of the vertices.
        let has_uvs = vertices.iter().any(|corner| corner.uv != NONE);
        let has_normals = vertices.iter().all(|corner| corner.normal != NONE);
        let colors = !self.colors.is_empty();
        Ok(Part {
            positions: gather(&vertices, &self.positions, |corner| corner.position),
            normals: has_normals.then(|| gather(&vertices, &self.normals, |corner| corner.normal)),
            uvs: has_uvs.then(|| gather(&vertices, &self.uvs, |corner| corner.uv)),
            colors: colors
                .then(|| opaque(gather(&vertices, &self.colors, |corner| corner.position))),
            triangles,
            segments,
            material,
            ..Part::default()
        })
    }
}

/// Index from 0 of what the file calls `index`: counted from 1, or backwards from the last.
fn resolve(index: i64, count: usize) -> Option<u32> {
    let count = i64::try_from(count).ok()?;
    let from_zero = if index > 0 {
        index.checked_sub(1)?
    } else {
        count.checked_add(index)?
    };
    (index != 0 && (0..count).contains(&from_zero)).then_some(from_zero as u32)
}

/// Numbers distinct corners in order of first use.
#[derive(Default)]
struct Numbers {
    vertices: Vec<Corner>,
    /// Only looked up, never walked, so its order cannot reach the result.
    known: HashMap<Corner, u32>,
}

impl Numbers {
    fn of_all<const N: usize>(&mut self, list: &[[Corner; N]]) -> Vec<[u32; N]> {
        self.known.reserve(list.len());
        let mut number = |corner: Corner| {
            *self.known.entry(corner).or_insert_with(|| {
                self.vertices.push(corner);
                (self.vertices.len() as u32).saturating_sub(1)
            })
        };
        list.iter()
            .map(|corners| corners.map(&mut number))
            .collect()
    }
}

fn gather<const N: usize>(
    vertices: &[Corner],
    table: &[[f32; N]],
    index: impl Fn(&Corner) -> u32,
) -> Vec<[f32; N]> {
    let row = |corner| {
        table
            .get(index(corner) as usize)
            .copied()
            .unwrap_or([0.0; N])
    };
    vertices.iter().map(row).collect()
}

fn opaque(colors: Vec<[f32; 3]>) -> Vec<[f32; 4]> {
    colors.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_count_from_one_or_backwards() {
        assert_eq!(resolve(1, 4), Some(0));
        assert_eq!(resolve(-1, 4), Some(3));
        assert_eq!(resolve(-4, 4), Some(0));
        for index in [0, 5, -5, i64::MAX, i64::MIN] {
            assert_eq!(resolve(index, 4), None, "{index}");
        }
    }
}
