//! Primitives: one part of a mesh each.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::mesh::{MorphTarget, Primitive, Semantic};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Accessor, Index};

use super::accessor::Accessors;
use super::error::{GltfError, Item};
use super::material;
use super::topology;
use crate::error::SceneError;
use crate::loading::Loading;
use crate::mesh::Part;
use crate::morph::{Morph, Unmorphed};

/// The attribute that marks vertices for lines, without the underscore before the names of such attributes.
const MARKS: &str = "NPR_LINE";

/// The attribute that says how pen strokes run, named likewise.
const DIRECTIONS: &str = "DIRECTION";

/// Where a primitive stands in its file.
#[derive(Clone, Copy)]
pub(crate) struct PrimitiveLocation {
    pub(crate) mesh: usize,
    pub(crate) part: usize,
}

/// Everything at hand while one primitive is read.
struct Reader<'a, 'l, 'r> {
    accessors: &'a Accessors<'a>,
    primitive: &'a Primitive,
    user: Item,
    vertex_count: usize,
    loading: &'l mut Loading<'r>,
}

/// The part that `primitive` describes, morphed by `weights`; none where it has neither triangles nor lines to draw.
///
/// # Errors
///
/// A list that cannot be read, that has another length than the positions, or a triangle or line that names a
/// missing vertex.
pub(crate) fn read(
    accessors: &Accessors,
    primitive: &Primitive,
    place: PrimitiveLocation,
    weights: &[f32],
    loading: &mut Loading,
) -> Result<Option<Part>, SceneError> {
    // Leave out a part without positions.
    let user = Item::new("mesh", place.mesh);
    let Some(index) = attribute(primitive, Semantic::Positions) else {
        loading.notices.add(format!(
            "{user} has a part without positions, which is not drawn"
        ));
        return Ok(None);
    };

    // Leave out points, and modes that nobody knows.
    if !topology::is_surface(primitive) && !topology::is_of_lines(primitive) {
        loading.notices.add(match primitive.mode {
            Checked::Valid(_) => "points are not drawn, only triangles and lines are".to_owned(),
            Checked::Invalid => {
                format!("{user} has a part of a mode that glTF does not know, which is not drawn")
            }
        });
        return Ok(None);
    }

    // Read triangles, lines and what is known of their vertices.
    let vertex_count = accessors.count(index, user)?;
    Reader {
        accessors,
        primitive,
        user,
        vertex_count,
        loading,
    }
    .part(place, weights)
    .map(Some)
}

impl Reader<'_, '_, '_> {
    fn part(mut self, place: PrimitiveLocation, weights: &[f32]) -> Result<Part, SceneError> {
        // Read every list that drawings use.
        let uv_set = material::uv_set(self.accessors.root, self.primitive);
        let (joints, weights_of_joints) = self.joints()?;
        let mut part = Part {
            positions: self.list(Semantic::Positions)?.unwrap_or_default(),
            normals: self.list(Semantic::Normals)?,
            uvs: self.list(Semantic::TexCoords(uv_set))?,
            colors: self.colors()?,
            joints,
            weights: weights_of_joints,
            marks: self.marks()?,
            directions: self.list(Semantic::Extras(DIRECTIONS.to_owned()))?,
            triangles: self.triangles(place)?,
            segments: self.segments(place)?,
            material: self.material()?,
            morphs: self.morphs(weights)?,
            unmorphed: None,
            ids: Vec::new(),
        };

        // Bend the vertices by the morphs that the file applies.
        self.apply_morphs(&mut part)?;
        Ok(part)
    }

    /// Bends a part that has morphs, and keeps what it was.
    fn apply_morphs(&mut self, part: &mut Part) -> Result<(), SceneError> {
        if part.morphs.is_empty() {
            return Ok(());
        }
        let lists = if part.normals.is_some() { 2 } else { 1 };
        let count = self.vertex_count.saturating_mul(lists);
        self.loading
            .allowance
            .take::<[f32; 3]>("vertex data", count)?;
        let unmorphed = Unmorphed {
            positions: std::mem::take(&mut part.positions),
            normals: part.normals.take(),
        };
        let vertices = unmorphed.morphed(&part.morphs, |_, morph| morph.rest_weight);
        (part.positions, part.normals) = (vertices.positions, vertices.normals);
        part.unmorphed = Some(Box::new(unmorphed));
        Ok(())
    }

    fn list<const N: usize>(
        &mut self,
        semantic: Semantic,
    ) -> Result<Option<Vec<[f32; N]>>, SceneError> {
        attribute(self.primitive, semantic)
            .map(|index| self.floats(index))
            .transpose()
    }

    fn floats<const N: usize>(&mut self, index: usize) -> Result<Vec<[f32; N]>, SceneError> {
        self.check_count(index)?;
        self.accessors
            .floats(index, self.user, &mut self.loading.allowance)
    }

    fn check_count(&self, accessor: usize) -> Result<(), GltfError> {
        let count = self.accessors.count(accessor, self.user)?;
        if count == self.vertex_count {
            return Ok(());
        }
        Err(GltfError::Count {
            user: self.user,
            accessor,
            count,
            wanted: self.vertex_count,
        })
    }

    /// Vertex colours, which come with or without alpha.
    fn colors(&mut self) -> Result<Option<Vec<[f32; 4]>>, SceneError> {
        let Some(index) = attribute(self.primitive, Semantic::Colors(0)) else {
            return Ok(None);
        };
        if self.accessors.width(index, self.user)? == 4 {
            return self.floats(index).map(Some);
        }
        let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
        Ok(Some(self.floats(index)?.into_iter().map(opaque).collect()))
    }

    /// Which vertices the user marked for lines.
    fn marks(&mut self) -> Result<Option<Vec<bool>>, SceneError> {
        let values: Option<Vec<[f32; 1]>> = self.list(Semantic::Extras(MARKS.to_owned()))?;
        Ok(values.map(|values| values.iter().map(|[value]| *value > 0.5).collect()))
    }

    #[allow(
        clippy::type_complexity,
        reason = "two lists of the part as they are stored"
    )]
    fn joints(&mut self) -> Result<(Option<Vec<[u16; 4]>>, Option<Vec<[f32; 4]>>), SceneError> {
        let joints = attribute(self.primitive, Semantic::Joints(0));
        let weights = attribute(self.primitive, Semantic::Weights(0));
        let (Some(joints), Some(weights)) = (joints, weights) else {
            return Ok((None, None));
        };
        if attribute(self.primitive, Semantic::Joints(1)).is_some() {
            self.loading
                .notices
                .add("a vertex follows at most 4 joints, further ones are ignored");
        }
        self.check_count(joints)?;
        let wide = self
            .accessors
            .integers::<4>(joints, self.user, &mut self.loading.allowance)?;
        let weights: Vec<[f32; 4]> = self.floats(weights)?;
        Ok((Some(narrow_joints(&wide)), Some(weights)))
    }

    fn triangles(&mut self, place: PrimitiveLocation) -> Result<Vec<[u32; 3]>, SceneError> {
        if !topology::is_surface(self.primitive) {
            return Ok(Vec::new());
        }

        // Plan the triangles before any is made.
        let corner_count = self.index_count()?;
        let triangle_count = topology::triangle_count(self.primitive, corner_count);
        self.loading.allowance.take_triangles(triangle_count)?;

        // Make triangles of the corners, and refuse a vertex that is missing.
        let corners = self.indices(corner_count)?;
        let triangles = topology::triangles(self.primitive, &corners);
        let PrimitiveLocation { mesh, part } = place;
        match self.missing_vertex(&triangles) {
            Some((triangle, vertex)) => Err(GltfError::MissingVertex {
                mesh,
                part,
                triangle,
                vertex,
                vertex_count: self.vertex_count,
            }
            .into()),
            None => Ok(triangles),
        }
    }

    fn segments(&mut self, place: PrimitiveLocation) -> Result<Vec<[u32; 2]>, SceneError> {
        if !topology::is_of_lines(self.primitive) {
            return Ok(Vec::new());
        }

        // Plan the lines before any is made.
        let end_count = self.index_count()?;
        let segment_count = topology::segment_count(self.primitive, end_count);
        self.loading.allowance.take_segments(segment_count)?;

        // Make lines of the ends, and say where one end is left over.
        let ends = self.indices(end_count)?;
        let segments = topology::segments(self.primitive, &ends);
        if topology::has_odd_end(self.primitive, end_count) {
            let user = self.user;
            self.loading.notices.add(format!(
                "{user} has a line with one end, which is not drawn"
            ));
        }

        // Refuse a vertex that is missing.
        let PrimitiveLocation { mesh, part } = place;
        match self.missing_vertex(&segments) {
            Some((segment, vertex)) => Err(GltfError::MissingEnd {
                mesh,
                part,
                segment,
                vertex,
                vertex_count: self.vertex_count,
            }
            .into()),
            None => Ok(segments),
        }
    }

    /// How many vertices the primitive names, one after another.
    fn index_count(&self) -> Result<usize, GltfError> {
        match self.primitive.indices {
            Some(index) => self.accessors.count(index.value(), self.user),
            None => Ok(self.vertex_count),
        }
    }

    /// The vertices that the primitive names: all in their order where it has no indices.
    fn indices(&mut self, count: usize) -> Result<Vec<[u32; 1]>, SceneError> {
        match self.primitive.indices {
            Some(index) => {
                let allowance = &mut self.loading.allowance;
                self.accessors.integers(index.value(), self.user, allowance)
            }
            None => Ok((0u32..).take(count).map(|index| [index]).collect()),
        }
    }

    /// The first triangle or segment that names a vertex which does not exist, with that vertex.
    fn missing_vertex<const N: usize>(&self, list: &[[u32; N]]) -> Option<(usize, u32)> {
        let is_missing = |vertex: &u32| *vertex as usize >= self.vertex_count;
        let mut found = list.iter().enumerate().filter_map(|(index, corners)| {
            let vertex = corners.iter().copied().find(is_missing)?;
            Some((index, vertex))
        });
        found.next()
    }

    fn material(&self) -> Result<Option<u32>, GltfError> {
        let Some(index) = self.primitive.material.as_ref().map(Index::value) else {
            return Ok(None);
        };
        let count = self.accessors.root.materials.len();
        if index < count {
            return Ok(Some(index as u32));
        }
        Err(GltfError::Missing {
            user: self.user,
            item: Item::new("material", index),
            count,
        })
    }

    fn morphs(&mut self, weights: &[f32]) -> Result<Vec<Morph>, SceneError> {
        let targets = self.primitive.targets.iter().flatten();
        let weights = weights.iter().copied().chain(std::iter::repeat(0.0));
        targets
            .zip(weights)
            .map(|(target, weight)| self.morph(target, weight))
            .collect()
    }

    fn morph(&mut self, target: &MorphTarget, weight: f32) -> Result<Morph, SceneError> {
        let mut offsets = |index: &Option<Index<Accessor>>| {
            index.map(|index| self.floats(index.value())).transpose()
        };
        let (positions, normals) = (offsets(&target.positions)?, offsets(&target.normals)?);
        let weight = if weight.is_finite() { weight } else { 0.0 };
        Ok(Morph {
            applied_weight: weight,
            rest_weight: weight,
            positions,
            normals,
        })
    }
}

fn attribute(primitive: &Primitive, semantic: Semantic) -> Option<usize> {
    primitive
        .attributes
        .get(&Checked::Valid(semantic))
        .map(Index::value)
}

/// Joint indices in 16 bits, as the file has them.
fn narrow_joints(wide: &[[u32; 4]]) -> Vec<[u16; 4]> {
    let narrow = |joint| u16::try_from(joint).unwrap_or(u16::MAX);
    wide.iter().map(|joints| joints.map(narrow)).collect()
}
