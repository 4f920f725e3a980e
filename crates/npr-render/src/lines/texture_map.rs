//! Where the textures of a scene lie on its welded shape, for lines that take their colour from there.

use super::assembly::{Assembly, place_key};
use crate::instance::placed_uv;
use crate::model::base_color_texture;
use crate::textures::Textures;
use npr_core::geometry::NONE;
use npr_core::shape::Shape;
use npr_core::texture::TextureStore;
use npr_scene::Scene;

/// The textures of a scene, and texture coordinates at the corners of a shape's faces.
#[derive(Debug, Default)]
pub(super) struct TextureMap {
    /// All textures.
    pub textures: TextureStore,
    /// Where the texture of each surface starts in the store, or [`NONE`].
    pub starts: Vec<u32>,
    /// Coordinates at the corners of each face; none where the face was not found among those of the file.
    corners: Vec<Option<[[f32; 2]; 3]>>,
    /// What was done so that all textures fit, for the user.
    pub notice: Option<String>,
}

/// A triangle of the file: its surface and the sorted places of its corners.
type FaceKey = (u32, [[u32; 3]; 3]);

impl TextureMap {
    /// Finds the faces of `shape` again among the triangles that it was made from. O(n log n).
    pub fn new(scene: &Scene, assembly: &Assembly, shape: &Shape) -> Self {
        let mut textures = Textures::new(scene);
        let mut map = Self {
            starts: vec![NONE; assembly.parts.len()],
            ..Self::default()
        };
        let mut known: Vec<(FaceKey, [[u32; 3]; 3], [[f32; 2]; 3])> = Vec::new();
        let meshes = scene.nodes.iter().filter_map(|node| {
            let mesh = node.mesh?;
            scene.meshes.get(mesh as usize)
        });
        for (mesh, placed) in meshes.zip(&assembly.meshes) {
            let mut uvs: Vec<[f32; 2]> = Vec::new();
            let mut starts = Vec::new();
            for part in &mesh.parts {
                let material = part.material.and_then(|m| scene.materials.get(m as usize));
                let start = base_color_texture(scene, part, &mut textures);
                starts.resize(starts.len() + part.positions.len(), start);
                match &part.uvs {
                    Some(own) => uvs.extend(own.iter().map(|uv| placed_uv(*uv, material))),
                    None => uvs.resize(uvs.len() + part.positions.len(), [0.0; 2]),
                }
            }
            for (corners, surface, world) in placed.drawn() {
                let places = world.map(place_key);
                let at = corners.map(|corner| uvs.get(corner as usize).copied());
                let [Some(a), Some(b), Some(c)] = at else {
                    continue;
                };
                known.push((key_of(surface, places), places, [a, b, c]));
                if let Some(of_surface) = map.starts.get_mut(surface as usize)
                    && let Some(start) = starts.get(corners[0] as usize)
                {
                    *of_surface = *start;
                }
            }
        }
        known.sort_by_key(|(key, _, _)| *key);
        map.corners = (shape.faces.iter().zip(&shape.face_surfaces))
            .map(|(face, surface)| {
                let places = face.map(|v| place_key(shape.positions[v as usize]));
                let key = key_of(*surface, places);
                let found = known.binary_search_by_key(&key, |(key, _, _)| *key).ok()?;
                let (_, stored, uvs) = &known[found];
                let uv_at = |place: &[u32; 3]| {
                    let corner = stored.iter().position(|other| other == place);
                    uvs[corner.unwrap_or(0)]
                };
                Some([0, 1, 2].map(|i| uv_at(&places[i])))
            })
            .collect();
        map.textures = textures.store;
        map.notice = textures.notice;
        map
    }

    /// Texture coordinates at the corners of a face.
    pub fn corners(&self, face: u32) -> Option<[[f32; 2]; 3]> {
        self.corners.get(face as usize).copied().flatten()
    }
}

fn key_of(surface: u32, mut places: [[u32; 3]; 3]) -> FaceKey {
    places.sort_unstable();
    (surface, places)
}
