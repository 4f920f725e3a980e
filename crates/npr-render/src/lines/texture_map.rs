//! Where the textures of a scene lie on its welded shape, for lines that take their colour from there.

use super::assembly::{Assembly, place_key};
use crate::instance::placed_uv;
use crate::textures::Textures;
use crate::textures::base_color_texture;
use glam::{Vec2, Vec3};
use npr_core::geometry::NONE;
use npr_core::texture::{self, TextureStore};
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_scene::{Mesh, Scene};

/// The textures of a scene, and texture coordinates at the corners of a shape's faces.
#[derive(Debug, Clone, Default)]
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

/// The key of a triangle of the file: its surface and the sorted places of its corners.
type FaceKey = (u32, [[u32; 3]; 3]);

/// A triangle of the file.
#[derive(Debug)]
struct StoredFace {
    key: FaceKey,
    /// Where its corners stand, in its own order.
    places: [[u32; 3]; 3],
    uvs: [[f32; 2]; 3],
}

impl TextureMap {
    /// Finds the faces of `shape` again among the triangles that it was made from. O(n log n).
    pub fn new(scene: &Scene, assembly: &Assembly, shape: &HalfEdgeMesh) -> Self {
        // List the triangles of the file, with their texture coordinates.
        let mut textures = Textures::new(scene);
        let mut starts = vec![NONE; assembly.parts.len()];
        let mut known: Vec<StoredFace> = Vec::new();
        let meshes = scene.nodes.iter().filter_map(|node| {
            let mesh = node.mesh?;
            scene.meshes.get(mesh as usize)
        });
        for (mesh, placed) in meshes.zip(&assembly.meshes) {
            let (uvs, of_vertices) = coordinates_of(scene, mesh, &mut textures);
            for (corners, surface, world) in placed.drawn() {
                let uv_at = |corner: u32| uvs.get(corner as usize).copied().unwrap_or_default();
                let places = world.map(place_key);
                known.push(StoredFace {
                    key: key_of(surface, places),
                    places,
                    uvs: corners.map(uv_at),
                });
                let start = of_vertices.get(corners[0] as usize);
                if let (Some(of_surface), Some(start)) = (starts.get_mut(surface as usize), start) {
                    *of_surface = *start;
                }
            }
        }

        // Find every face of the shape among them.
        known.sort_by_key(|face| face.key);
        let faces = shape.faces.iter().zip(&shape.face_surfaces);
        Self {
            corners: faces
                .map(|(face, surface)| {
                    let places = face.map(|v| place_key(shape.positions[v as usize]));
                    corners_in(&known, *surface, places)
                })
                .collect(),
            starts,
            textures: textures.store,
            notice: textures.notice,
        }
    }

    /// The mean light of the texture on each surface, by the area of its faces; white where it has none. O(faces).
    pub fn mean_lights(&self, shape: &HalfEdgeMesh) -> Vec<[f32; 3]> {
        // Add up the middles of faces.
        let mut sums = vec![[0.0_f64; 4]; self.starts.len()];
        for (face, corners) in shape.faces.iter().enumerate() {
            let surface = shape.face_surfaces[face] as usize;
            let start = self.starts.get(surface).copied().unwrap_or(NONE);
            let Some(uvs) = self.corners(face as u32).filter(|_| start != NONE) else {
                continue;
            };
            let [a, b, c] = corners.map(|v| Vec3::from(shape.positions[v as usize]));
            let area = f64::from((b - a).cross(c - a).length());
            let [a, b, c] = uvs.map(Vec2::from);
            let footprint = (b - a).perp_dot(c - a).abs().sqrt();
            let middle = ((a + b + c) / 3.0).to_array();
            let light = texture::sample(self.textures.words(), start, middle, footprint);
            for k in 0..3 {
                sums[surface][k] += f64::from(light[k]) * area;
            }
            sums[surface][3] += area;
        }

        // Divide by their area.
        let mean = |[r, g, b, area]: [f64; 4]| match area > 0.0 {
            true => [r, g, b].map(|sum| (sum / area) as f32),
            false => [1.0; 3],
        };
        sums.into_iter().map(mean).collect()
    }

    /// Texture coordinates at the corners of a face.
    pub fn corners(&self, face: u32) -> Option<[[f32; 2]; 3]> {
        self.corners.get(face as usize).copied().flatten()
    }
}

/// Texture coordinates of a mesh's vertices, part after part, and where the texture of each vertex starts.
fn coordinates_of(
    scene: &Scene,
    mesh: &Mesh,
    textures: &mut Textures,
) -> (Vec<[f32; 2]>, Vec<u32>) {
    let mut uvs: Vec<[f32; 2]> = Vec::new();
    let mut starts = Vec::new();
    for part in &mesh.parts {
        let material = part.material.and_then(|m| scene.materials.get(m as usize));
        let count = uvs.len() + part.positions.len();
        starts.resize(count, base_color_texture(scene, part, textures));
        let own = part.uvs.iter().flatten();
        uvs.extend(own.map(|uv| placed_uv(*uv, material)));
        uvs.resize(count, [0.0; 2]);
    }
    (uvs, starts)
}

/// Texture coordinates at corners that stand at these places, in their order.
fn corners_in(known: &[StoredFace], surface: u32, places: [[u32; 3]; 3]) -> Option<[[f32; 2]; 3]> {
    let key = key_of(surface, places);
    let found = known.binary_search_by_key(&key, |face| face.key).ok()?;
    let face = &known[found];
    Some(places.map(|place| {
        let corner = face.places.iter().position(|other| *other == place);
        face.uvs[corner.unwrap_or(0)]
    }))
}

fn key_of(surface: u32, mut places: [[u32; 3]; 3]) -> FaceKey {
    places.sort_unstable();
    (surface, places)
}
