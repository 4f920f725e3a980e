//! One node's mesh, ready to be joined with the others: welded, with edges, normals and curvature.

use crate::bend;
use crate::joined::Joined;
use crate::kept::Cache;
use npr_core::geometry::{self, Influence, Triangle, Vertex};
use npr_core::math;
use npr_mesh::Weld;
use npr_mesh::crease::{FoldInput, Folds};
use npr_mesh::curvature::bend::WeldedMesh;
use npr_scene::{Material, Node, Part, Scene, TextureTransform};
use std::collections::BTreeMap;

/// The angle between faces from which a mesh without normals is shaded with a hard edge: that of creases, unless a
/// style says otherwise.
pub(crate) const HARD_EDGE: f32 = npr_stylesheet::CREASE_ANGLE_DEG / 180.0 * std::f32::consts::PI;

/// A node's mesh, numbered from zero.
#[derive(Debug, Default)]
pub(crate) struct Instance {
    pub vertices: Vec<Vertex>,
    pub influences: Vec<Influence>,
    /// Directions of strokes at the vertices; empty where the file has none.
    pub painted: Vec<[f32; 3]>,
    /// Triangles with the number of their piece instead of the model's part.
    pub triangles: Vec<Triangle>,
    /// Edges with the folds of their faces in the world.
    pub edges: Vec<geometry::Edge>,
    /// The folds of the file's normals at every edge, as [`Folds::normals`].
    pub normals_cos: Vec<f32>,
    /// What a pose needs of the mesh; none where it only carries the mesh along.
    pub kept: Option<Kept>,
    /// One for each connected component in each part of the mesh.
    pub pieces: Vec<Piece>,
}

/// The triangles of one part of the mesh in one connected component.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Piece {
    /// Number of the mesh's part.
    pub part: u32,
    /// Number of the component.
    pub component: u32,
}

/// What is kept of the preparation of a mesh.
#[derive(Debug, Clone)]
pub(crate) struct Kept {
    pub weld: Weld,
    pub edges: Vec<npr_mesh::Edge>,
}

impl Instance {
    /// Prepares the parts of a mesh at a node. `scale` is how much longer things are in the world than in the mesh,
    /// and `mirrored` whether the node turns shapes inside out.
    pub fn new(
        cache: &Cache,
        scene: &Scene,
        (node, parts): (&Node, &[&Part]),
        scale: f32,
        mirrored: bool,
    ) -> Self {
        // Weld the parts, and find edges, components, normals and folds.
        let mut joined = Joined::new(parts);
        let weld = npr_mesh::weld(&joined.positions, 0.0);
        let edges = npr_mesh::unique_edges(
            &joined.positions,
            &joined.triangles,
            &weld,
            &joined.materials,
        );
        let (components, _) = npr_mesh::components(&joined.triangles, &weld);
        let smooth = npr_mesh::smooth_normals(&joined.positions, &joined.triangles, &weld);
        let folds = folds(scene, (node, parts), &joined, &weld, &edges);

        // Store vertices, with curvature, and edges.
        let mut instance = Self {
            vertices: stored_vertices(scene, parts, &joined),
            influences: parts.iter().copied().flat_map(influences).collect(),
            painted: painted(parts),
            edges: edges.iter().zip(&folds.faces).map(shared_edge).collect(),
            normals_cos: folds.normals,
            ..Self::default()
        };
        instance.add_curvature(cache, &joined, (&weld, &edges), &smooth, scale);

        // Shade with hard edges where the file has no normals.
        if !joined.has_normals {
            let corners = npr_mesh::crease_normals(
                &joined.positions,
                &joined.triangles,
                &weld,
                &edges,
                HARD_EDGE,
            );
            instance.split_by_normals(&mut joined, &corners);
        }

        // Keep what a pose needs.
        if bends(scene, node, parts) {
            instance.kept = Some(Kept { weld, edges });
        }

        // Number the pieces, and turn triangles over where the node mirrors them.
        let pieces = instance.number_pieces(&joined, &components);
        instance.triangles = joined
            .triangles
            .iter()
            .zip(pieces)
            .map(|([a, b, c], piece)| {
                let corners = if mirrored { [*a, *c, *b] } else { [*a, *b, *c] };
                Triangle {
                    corners,
                    part: piece,
                }
            })
            .collect();

        // Give every vertex the piece of its triangles.
        for triangle in &instance.triangles {
            for corner in triangle.corners {
                instance.vertices[corner as usize].part = triangle.part;
            }
        }
        instance
    }

    /// The piece of every triangle: its part of the mesh and its connected component together.
    fn number_pieces(&mut self, joined: &Joined, components: &[u32]) -> Vec<u32> {
        let mut numbers = BTreeMap::new();
        let of_triangle = joined
            .parts
            .iter()
            .zip(components)
            .map(|(part, component)| {
                let piece = Piece {
                    part: *part,
                    component: *component,
                };
                *numbers.entry(piece).or_insert_with(|| {
                    self.pieces.push(piece);
                    self.pieces.len() as u32 - 1
                })
            });
        of_triangle.collect()
    }

    /// Stores principal curvatures, their direction and the welded normal with every vertex.
    fn add_curvature(
        &mut self,
        cache: &Cache,
        joined: &Joined,
        (weld, edges): (&Weld, &[npr_mesh::Edge]),
        smooth: &[[f32; 3]],
        scale: f32,
    ) {
        // Measure the bend at every welded vertex.
        let mesh = WeldedMesh {
            positions: &joined.positions,
            triangles: &joined.triangles,
            weld,
            edges,
            scale,
        };
        let bends = bend::bends(cache, &mesh, smooth);

        // Store it with the vertices that are welded there.
        for (vertex, welded) in self.vertices.iter_mut().zip(&weld.of_vertex) {
            let bend = bends[*welded as usize];
            vertex.curvatures = bend.curvatures;
            vertex.direction = bend.direction;
            vertex.width = bend.tightest;
            vertex.weld_normal = math::pack_unit(smooth[*welded as usize]);
        }
    }

    /// Gives every corner its own normal, by doubling vertices where corners disagree.
    fn split_by_normals(&mut self, joined: &mut Joined, corners: &[[[f32; 3]; 3]]) {
        let mut first_use = vec![true; self.vertices.len()];
        let mut copies: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        for (triangle, normals) in joined.triangles.iter_mut().zip(corners) {
            for (corner, normal) in triangle.iter_mut().zip(normals) {
                // Give the stored vertex the normal of its first corner.
                let stored = *corner as usize;
                if std::mem::take(&mut first_use[stored]) {
                    self.vertices[stored].normal = *normal;
                    copies.insert((*corner, math::pack_unit(*normal)), *corner);
                    continue;
                }

                // Give later corners a copy of it for each further normal.
                *corner = *copies
                    .entry((*corner, math::pack_unit(*normal)))
                    .or_insert_with(|| {
                        self.vertices.push(Vertex {
                            normal: *normal,
                            ..self.vertices[stored]
                        });
                        self.influences.push(self.influences[stored]);
                        if let Some(direction) = self.painted.get(stored).copied() {
                            self.painted.push(direction);
                        }
                        self.vertices.len() as u32 - 1
                    });
            }
        }
    }
}

/// Whether a pose may bend the mesh of a node, and not only carry it along.
fn bends(scene: &Scene, node: &Node, parts: &[&Part]) -> bool {
    let skin = node.skin.and_then(|skin| scene.skins.get(skin as usize));
    let is_skinned = skin.is_some_and(|skin| skin.joints.len() > 1);
    is_skinned || parts.iter().any(|part| part.unmorphed.is_some())
}

/// The vertices of all parts, without curvature.
fn stored_vertices(scene: &Scene, parts: &[&Part], joined: &Joined) -> Vec<Vertex> {
    let mut vertices = Vec::with_capacity(joined.positions.len());
    for part in parts {
        let material = part.material.and_then(|m| scene.materials.get(m as usize));
        for i in 0..part.positions.len() {
            let normal = stored_normal(joined, vertices.len());
            vertices.push(Vertex {
                position: part.positions[i],
                normal,
                color: part
                    .colors
                    .as_ref()
                    .map_or(u32::MAX, |colors| packed_color(colors[i])),
                uv: part
                    .uvs
                    .as_ref()
                    .map_or([0.0; 2], |uvs| placed_uv(uvs[i], material)),
                ..Vertex::default()
            });
        }
    }
    vertices
}

/// The file's normal of a stored vertex, as a unit vector; z where some part has none.
pub(crate) fn stored_normal(joined: &Joined, vertex: usize) -> [f32; 3] {
    let normal = match joined.has_normals {
        true => joined.normals[vertex],
        false => [0.0, 0.0, 1.0],
    };
    npr_core::surface::unit_or_z(normal)
}

/// A linear vertex colour as sRGB bytes.
pub(crate) fn packed_color([r, g, b, a]: [f32; 4]) -> u32 {
    let encode = npr_core::color::srgb_from_linear;
    npr_core::color::pack_rgba8([encode(r), encode(g), encode(b), a])
}

/// A texture coordinate after the material's transform [KHR_texture_transform].
pub(crate) fn placed_uv(uv: [f32; 2], material: Option<&Material>) -> [f32; 2] {
    let Some(texture) = material.and_then(|material| material.base_color_texture.as_ref()) else {
        return uv;
    };
    let TextureTransform {
        offset,
        rotation,
        scale,
    } = texture.transform;
    let (sin, cos) = (math::sin(rotation), math::cos(rotation));
    let (u, v) = (uv[0] * scale[0], uv[1] * scale[1]);
    [cos * u + sin * v + offset[0], cos * v - sin * u + offset[1]]
}

/// Influences of a part's vertices, with joints numbered as in the skin; rigid parts use joint 0.
fn influences(part: &Part) -> Vec<Influence> {
    let rigid = Influence {
        joints: [0; 4],
        weights: [1.0, 0.0, 0.0, 0.0],
    };
    match (&part.joints, &part.weights) {
        (Some(joints), Some(weights)) => joints
            .iter()
            .zip(weights)
            .map(|(joints, weights)| Influence {
                joints: joints.map(u32::from),
                weights: *weights,
            })
            .collect(),
        _ => vec![rigid; part.positions.len()],
    }
}

/// Directions of strokes at the vertices of all parts; empty where none has any.
fn painted(parts: &[&Part]) -> Vec<[f32; 3]> {
    if parts.iter().all(|part| part.directions.is_none()) {
        return Vec::new();
    }
    let of_part = |part: &&Part| match &part.directions {
        Some(directions) => directions.clone(),
        None => vec![[0.0; 3]; part.positions.len()],
    };
    parts.iter().flat_map(of_part).collect()
}

/// The folds of a mesh's edges, measured where its node places it in the world.
pub(crate) fn folds(
    scene: &Scene,
    (node, parts): (&Node, &[&Part]),
    joined: &Joined,
    weld: &Weld,
    edges: &[npr_mesh::Edge],
) -> Folds {
    let world = parts
        .iter()
        .flat_map(|part| scene.positions_world(node, part));
    let input = FoldInput {
        world: &world.collect::<Vec<_>>(),
        triangles: &joined.triangles,
        weld,
        normals: &joined.normals,
    };
    input.folds(edges)
}

/// An edge in the layout that passes read.
fn shared_edge((edge, dihedral_cos): (&npr_mesh::Edge, &f32)) -> geometry::Edge {
    geometry::Edge {
        ends: edge.ends,
        faces: edge.faces,
        dihedral_cos: *dihedral_cos,
        traits: edge.flags,
    }
}
