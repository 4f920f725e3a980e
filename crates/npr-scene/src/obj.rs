//! Wavefront OBJ files: polygons, groups, and the base colours of their material libraries.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

pub(crate) mod corner;
pub(crate) mod element;
pub(crate) mod encoding;
pub(crate) mod error;
pub(crate) mod group;
pub(crate) mod library;

pub use element::Element;
pub use error::ObjError;

use std::borrow::Cow;

use npr_core::color::linear_from_srgb;

use crate::error::SceneError;
use crate::loading::Loading;
use crate::mesh::Mesh;
use crate::scene::Scene;
use crate::words::{number, numbered_lines, triple, words};
use corner::Tables;
use group::Groups;
use library::Library;

/// Reads an OBJ file.
pub(crate) fn read(bytes: &[u8], loading: &mut Loading) -> Result<Scene, SceneError> {
    let text = encoding::utf8(bytes, loading)?;
    let text = join_continued_lines(&text);
    let mut reader = Reader::default();
    for (line, text) in numbered_lines(&text) {
        reader.statement(line, text, loading)?;
    }
    reader.scene(loading)
}

/// Joins lines that end in a backslash with the next one.
fn join_continued_lines(bytes: &[u8]) -> Cow<'_, [u8]> {
    let is_continued = |line: &[u8]| line.trim_ascii_end().ends_with(b"\\");
    if !bytes.contains(&b'\\') || !bytes.split(|&byte| byte == b'\n').any(is_continued) {
        return Cow::Borrowed(bytes);
    }
    let mut joined = Vec::with_capacity(bytes.len());
    for line in bytes.split(|&byte| byte == b'\n') {
        match line.trim_ascii_end().strip_suffix(b"\\") {
            Some(start) => joined.extend(start.iter().chain(b" ")),
            None => joined.extend(line.iter().chain(b"\n")),
        }
    }
    Cow::Owned(joined)
}

#[derive(Default)]
struct Reader {
    tables: Tables,
    groups: Groups,
    library: Library,
    face_count: usize,
    polyline_count: usize,
}

impl Reader {
    fn statement(
        &mut self,
        line: usize,
        text: &[u8],
        loading: &mut Loading,
    ) -> Result<(), SceneError> {
        // Cut off a comment and split the keyword from the rest.
        let text = text
            .split(|&byte| byte == b'#')
            .next()
            .unwrap_or_default()
            .trim_ascii();
        let (word, rest) = text
            .split_at_checked(keyword_length(text))
            .unwrap_or_default();

        // Obey the statement, and say what of it is not drawn.
        match word {
            b"v" => self.vertex(line, rest)?,
            b"vn" => self.tables.normals.push(numbers(line, "a normal", rest)?),
            b"vt" => self.texture_coordinate(line, rest)?,
            b"f" => self.face(line, rest, loading)?,
            b"o" | b"g" => self.groups.open(&name(rest), loading)?,
            b"usemtl" => self
                .groups
                .set_material(self.library.index(rest.trim_ascii())),
            b"mtllib" => self.library.load(rest.trim_ascii(), loading),
            b"l" => self.polyline(line, rest, loading)?,
            b"p" => loading
                .notices
                .add("points are not drawn, only faces and lines are"),
            b"curv" | b"curv2" | b"surf" => loading
                .notices
                .add("curves and curved surfaces are not drawn, only faces are"),
            _ => {}
        }
        Ok(())
    }

    /// A position, perhaps with a colour; a fourth number alone is a weight and is ignored.
    fn vertex(&mut self, line: usize, rest: &[u8]) -> Result<(), ObjError> {
        self.tables.positions.push(numbers(line, "a vertex", rest)?);
        let color = triple(&mut words(rest).skip(3)).map(|color| color.map(linear_from_srgb));
        self.tables.push_color(color);
        Ok(())
    }

    /// OBJ measures v from the lower edge of the image, glTF from the upper.
    fn texture_coordinate(&mut self, line: usize, rest: &[u8]) -> Result<(), ObjError> {
        let mut words = words(rest);
        let u = words.next().and_then(number);
        let v = words.next().map_or(Some(0.0), number);
        let (Some(u), Some(v)) = (u, v) else {
            return Err(ObjError::Numbers {
                line,
                what: "a texture coordinate",
                wanted: 2,
            });
        };
        self.tables.uvs.push([u, 1.0 - v]);
        Ok(())
    }

    fn face(&mut self, line: usize, rest: &[u8], loading: &mut Loading) -> Result<(), SceneError> {
        self.face_count = self.face_count.saturating_add(1);
        let element = Element::Face(self.face_count);
        let corners = self.tables.corners(line, element, rest)?;
        Ok(self.groups.add_face(&corners, loading)?)
    }

    fn polyline(
        &mut self,
        line: usize,
        rest: &[u8],
        loading: &mut Loading,
    ) -> Result<(), SceneError> {
        self.polyline_count = self.polyline_count.saturating_add(1);
        let element = Element::Polyline(self.polyline_count);
        let corners = self.tables.corners(line, element, rest)?;
        Ok(self.groups.add_polyline(&corners, loading)?)
    }

    fn scene(self, loading: &mut Loading) -> Result<Scene, SceneError> {
        let mut meshes = Vec::new();
        for group in self.groups.into_list() {
            let mut parts = Vec::new();
            for (material, triangles) in &group.parts {
                parts.push(self.tables.part(*material, triangles, &[], loading)?);
            }
            // Lines have no normals; in parts of their own they take none from faces.
            for (material, segments) in &group.lines {
                parts.push(self.tables.part(*material, &[], segments, loading)?);
            }
            meshes.push(Mesh {
                name: group.name,
                parts,
            });
        }
        let (materials, images) = self.library.finish(loading)?;
        let mut scene = Scene::of_meshes(meshes, materials);
        scene.images = images;
        Ok(scene)
    }
}

fn keyword_length(text: &[u8]) -> usize {
    text.iter()
        .position(u8::is_ascii_whitespace)
        .unwrap_or(text.len())
}

fn numbers(line: usize, what: &'static str, rest: &[u8]) -> Result<[f32; 3], ObjError> {
    triple(&mut words(rest)).ok_or(ObjError::Numbers {
        line,
        what,
        wanted: 3,
    })
}

fn name(rest: &[u8]) -> String {
    String::from_utf8_lossy(rest.trim_ascii()).into_owned()
}
