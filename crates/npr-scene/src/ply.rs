//! PLY files, text and binary of either byte order [Turk 1994].
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

pub(crate) mod body;
pub(crate) mod error;
pub(crate) mod header;

pub use error::PlyError;

use npr_core::color::linear_from_srgb;

use crate::error::SceneError;
use crate::loading::Loading;
use crate::material::Material;
use crate::mesh::{Mesh, Part};
use crate::polygon;
use crate::scene::Scene;
use body::Body;
use header::{Element, Header, Kind};

/// Reads a PLY file.
pub(crate) fn read(bytes: &[u8], loading: &mut Loading) -> Result<Scene, SceneError> {
    // Read vertices, faces and edges in the order of the header.
    let (header, rest) = Header::parse(bytes)?;
    let mut body = Body::new(header.encoding, rest);
    let mut part = Part {
        material: Some(0),
        ..Part::default()
    };
    let mut faces = Faces::default();
    let mut edges = Vec::new();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut body, &mut part)?,
            "face" => faces.read(element, &mut body)?,
            "edge" => read_edges(element, &mut body, &mut edges)?,
            _ => body.rows(element, |_| {})?,
        }
    }

    // Say what is not drawn.
    if header
        .elements
        .iter()
        .any(|element| element.name == "tristrips")
    {
        loading
            .notices
            .add("triangle strips of PLY files are not drawn");
    }

    // Cut faces into triangles and join edges, within the limits.
    loading.allowance.take_triangles(faces.triangle_count())?;
    part.triangles = faces.triangles(part.positions.len())?;
    loading.allowance.take_segments(edges.len())?;
    part.segments = segments(&edges, part.positions.len())?;
    Ok(scene(part, loading))
}

fn scene(part: Part, loading: &mut Loading) -> Scene {
    // Draw nothing where there are only points.
    if part.triangles.is_empty() && part.segments.is_empty() {
        if !part.positions.is_empty() {
            loading
                .notices
                .add("points are not drawn, only faces and edges are");
        }
        return Scene::default();
    }

    // Show both sides of every face.
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

/// Where in a row the numbers of an attribute stand, and what to divide them by.
struct Columns<const N: usize>([(usize, f64); N]);

impl<const N: usize> Columns<N> {
    /// The columns of `element` with these names, if all are there.
    fn find(element: &Element, names: [&str; N]) -> Option<Self> {
        let column = |name: &str| {
            let index = element
                .properties
                .iter()
                .position(|property| property.name == name)?;
            match element.properties.get(index)?.kind {
                Kind::Single(number) => Some((index, number.most())),
                Kind::List { .. } => None,
            }
        };
        let columns: Option<Vec<_>> = names.into_iter().map(column).collect();
        columns?.try_into().ok().map(Self)
    }

    fn values(&self, row: &[f64]) -> [f32; N] {
        self.0
            .map(|(index, _)| row.get(index).map_or(f32::NAN, |&value| value as f32))
    }

    /// As [`Self::values`], with integers scaled to 0..1.
    fn fractions(&self, row: &[f64]) -> [f32; N] {
        self.0.map(|(index, most)| {
            row.get(index)
                .map_or(f32::NAN, |&value| (value / most) as f32)
        })
    }
}

/// Texture coordinates go by several names.
const UV_NAMES: [[&str; 2]; 4] = [
    ["s", "t"],
    ["u", "v"],
    ["texture_u", "texture_v"],
    ["texture_s", "texture_t"],
];

fn read_vertices(element: &Element, body: &mut Body, part: &mut Part) -> Result<(), PlyError> {
    // Find which columns hold what is drawn.
    let positions = Columns::find(element, ["x", "y", "z"]).ok_or(PlyError::NoPositions)?;
    let normals = Columns::find(element, ["nx", "ny", "nz"]);
    let uvs = UV_NAMES
        .iter()
        .find_map(|&names| Columns::find(element, names));
    let colors = Columns::find(element, ["red", "green", "blue"]);
    let alphas = Columns::find(element, ["alpha"]);

    // Open a list for each that is there.
    part.normals = normals.is_some().then(Vec::new);
    part.uvs = uvs.is_some().then(Vec::new);
    part.colors = colors.is_some().then(Vec::new);

    // Fill the lists vertex by vertex.
    body.rows(element, |row| {
        part.positions.push(positions.values(row.singles));
        push(&mut part.normals, &normals, |columns| {
            columns.values(row.singles)
        });
        push(&mut part.uvs, &uvs, |columns| {
            let [u, v] = columns.values(row.singles);
            [u, 1.0 - v]
        });
        push(&mut part.colors, &colors, |columns| {
            let [r, g, b] = columns.fractions(row.singles).map(linear_from_srgb);
            let alpha = alphas
                .as_ref()
                .map_or(1.0, |columns| columns.fractions(row.singles)[0]);
            [r, g, b, alpha]
        });
    })
}

fn push<const N: usize, const M: usize>(
    list: &mut Option<Vec<[f32; M]>>,
    columns: &Option<Columns<N>>,
    value: impl Fn(&Columns<N>) -> [f32; M],
) {
    if let (Some(list), Some(columns)) = (list, columns) {
        list.push(value(columns));
    }
}

/// The numbers of both ends of every edge, as read.
fn read_edges(
    element: &Element,
    body: &mut Body,
    edges: &mut Vec<[f64; 2]>,
) -> Result<(), PlyError> {
    let column = |name| element.properties.iter().position(|p| p.name == name);
    let columns = ["vertex1", "vertex2"].map(column);
    body.rows(element, |row| {
        if let [Some(a), Some(b)] = columns.map(|c| c.and_then(|c| row.singles.get(c))) {
            edges.push([*a, *b]);
        }
    })
}

/// Edges as line segments.
fn segments(edges: &[[f64; 2]], vertex_count: usize) -> Result<Vec<[u32; 2]>, PlyError> {
    let is_missing = |vertex: &&f64| !(0.0..vertex_count as f64).contains(*vertex);
    let segment = |(edge, ends): (usize, &[f64; 2])| match ends.iter().find(is_missing) {
        Some(vertex) => Err(PlyError::MissingEnd {
            edge,
            vertex: *vertex as i64,
            vertex_count,
        }),
        None => Ok(ends.map(|vertex| vertex as u32)),
    };
    edges.iter().enumerate().map(segment).collect()
}

/// Faces as lists of vertices, one after another.
#[derive(Default)]
struct Faces {
    corners: Vec<i64>,
    /// Where each face ends in `corners`.
    ends: Vec<usize>,
}

impl Faces {
    fn read(&mut self, element: &Element, body: &mut Body) -> Result<(), PlyError> {
        let is_corners = |name: &str| name == "vertex_indices" || name == "vertex_index";
        let column = element
            .properties
            .iter()
            .position(|property| is_corners(&property.name));
        body.rows(element, |row| {
            if let Some(list) = column.and_then(|column| row.lists.get(column)) {
                self.corners
                    .extend(list.iter().map(|&vertex| vertex as i64));
                self.ends.push(self.corners.len());
            }
        })
    }

    fn iter(&self) -> impl Iterator<Item = &[i64]> {
        let starts = [0].into_iter().chain(self.ends.iter().copied());
        starts
            .zip(&self.ends)
            .map(|(start, &end)| self.corners.get(start..end).unwrap_or_default())
    }

    fn triangle_count(&self) -> usize {
        self.iter()
            .map(|face| face.len().saturating_sub(2))
            .fold(0, usize::saturating_add)
    }

    fn triangles(&self, vertex_count: usize) -> Result<Vec<[u32; 3]>, PlyError> {
        let mut triangles = Vec::with_capacity(self.triangle_count());
        let is_missing =
            |vertex: &i64| usize::try_from(*vertex).map_or(true, |vertex| vertex >= vertex_count);
        for (face, corners) in self.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|vertex| is_missing(vertex)) {
                return Err(PlyError::MissingVertex {
                    face,
                    vertex,
                    vertex_count,
                });
            }
            triangles
                .extend(polygon::fan(corners).map(|triangle| triangle.map(|vertex| vertex as u32)));
        }
        Ok(triangles)
    }
}
