//! A scene prepared for drawing.

use crate::bending::{Bending, Lists, Moved, surfaces_of};
use crate::cutoffs::Cutoffs;
use crate::error::{RenderError, check_count};
use crate::file_light::{self, FileLight};
use crate::instance::Instance;
use crate::kept::Cache;
use crate::limbs::Limbs;
use crate::part_info::PartInfo;
use crate::part_toon::PartToon;
use crate::placement::{self, Bounds, around};
use crate::smoke::Smoke;
use crate::textures::{Textures, base_color_texture};
use glam::{Mat4, Vec3};
use npr_core::camera::Camera;
use npr_core::crease::CreaseFrom;
use npr_core::geometry::{Edge, Influence, NONE, Triangle, Vertex};
use npr_core::texture::TextureStore;
use npr_mesh::pose::Matrix;
use npr_scene::{Node, Scene};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex};

/// What was added to the normals of a model last, with the share of the radius that it was for, as bits. Copies of the
/// model in other poses have it too.
pub(crate) type LastCalming = Arc<Mutex<Option<(u32, Arc<Vec<Vec3>>)>>>;

/// A scene prepared for drawing: one list of vertices, triangles and edges, whatever the camera and the style.
#[derive(Debug, Clone)]
pub struct Model {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) influences: Vec<Influence>,
    /// Directions of strokes at the vertices, in the space of their positions; may end early, zeros follow.
    pub(crate) painted: Vec<[f32; 3]>,
    /// Directions of strokes on limbs at the vertices, and how much of a face each is; may end early, zeros follow.
    pub(crate) limbs: Limbs,
    pub(crate) palette: Vec<Matrix>,
    pub(crate) triangles: Vec<Triangle>,
    /// Edges with the folds of their faces; [`Model::edges_by`] gives those that a style measures.
    edges: Vec<Edge>,
    /// The folds of the file's normals at every edge.
    normals_cos: Vec<f32>,
    /// Coordinates of the vertices as the file has them, once time has moved them.
    pub(crate) still_uvs: Option<Vec<[f32; 2]>>,
    /// The vertices as they were prepared, once morphs have moved them.
    unmorphed: Option<Vec<Vertex>>,
    /// How much longer things of each object are in the world than in its mesh, as it was prepared.
    scales: BTreeMap<u32, f32>,
    /// The meshes that a pose may bend.
    bending: Vec<Bending>,
    pub(crate) parts: Vec<PartInfo>,
    pub(crate) textures: TextureStore,
    pub(crate) lights: Vec<FileLight>,
    /// Ends of the file's lines in the world: only curves draw these lines, but all frames take them in.
    line_points: Vec<Vec3>,
    bounds: Bounds,
    /// Radius of the sphere around the bounds as they were at first.
    radius: f32,
    cameras: Vec<(String, Camera)>,
    notices: Vec<String>,
    /// Where what is costly to prepare is kept.
    pub(crate) cache: Cache,
    pub(crate) calmed: LastCalming,
}

impl Model {
    /// Prepares a scene: joins its nodes, welds each by position, and finds edges, normals and curvature.
    ///
    /// Alpha that blends is cut out at one half, but for glass: what is neither clear nor opaque nearly everywhere is
    /// drawn as a whole where it covers half or more, and otherwise not at all. A mesh without normals is shaded
    /// smoothly, with hard edges over 40 degrees. O(n log n) in the number of triangles; instances are prepared once
    /// each.
    ///
    /// # Errors
    ///
    /// [`RenderError::TooMany`] where vertices, triangles or edges cannot be numbered.
    pub fn new(scene: &Scene) -> Result<Self, RenderError> {
        Self::cached(scene, None)
    }

    /// The same with what is costly to prepare kept in a folder between runs, where there is one: how surfaces bend,
    /// and how strokes of hatching lie on them.
    ///
    /// Files are named after the content that they were made from, `KEY.nprcache`; a changed scene gets others. What
    /// cannot be read, is damaged or comes from another version is made anew; what cannot be written is not kept.
    /// Files appear whole or not at all, and none is ever removed: the folder may be emptied at any time. No picture
    /// depends on it.
    ///
    /// # Errors
    ///
    /// As [`Model::new`]; none for the sake of the folder.
    pub fn cached(scene: &Scene, folder: Option<&Path>) -> Result<Self, RenderError> {
        let mut model = Self {
            cache: Cache::of(folder),
            calmed: LastCalming::default(),
            vertices: Vec::new(),
            influences: Vec::new(),
            painted: Vec::new(),
            limbs: Limbs::default(),
            palette: Vec::new(),
            triangles: Vec::new(),
            edges: Vec::new(),
            normals_cos: Vec::new(),
            still_uvs: None,
            unmorphed: None,
            scales: BTreeMap::new(),
            bending: Vec::new(),
            parts: Vec::new(),
            textures: TextureStore::new(),
            lights: Vec::new(),
            line_points: line_points(scene),
            bounds: ([0.0; 3], [0.0; 3]),
            radius: 0.0,
            cameras: placement::cameras_of(scene),
            notices: scene.notices.iter().map(ToString::to_string).collect(),
        };

        // Add the meshes of all nodes.
        let mut textures = Textures::new(scene);
        let cutoffs = Cutoffs::of(scene);
        for (object, node) in scene.nodes.iter().enumerate() {
            if let Some(mesh) = mesh_of(scene, node) {
                model.add_node(scene, object as u32, node, mesh, &mut textures, &cutoffs)?;
            }
        }

        // Settle what depends on all of them: textures, bounds, lights, and curvature in radii.
        model.notices.extend(textures.notice.take());
        model.textures = textures.store;
        model.bounds = npr_core::camera::bounds_of(model.posed_points());
        model.radius = placement::radius_of(model.bounds);
        model.lights = file_light::of_scene(scene, model.bounds);
        model.relate_curvatures();
        Ok(model)
    }

    /// Expresses curvatures in 1 / bounding radius, so that a larger copy of a scene has the same lines.
    fn relate_curvatures(&mut self) {
        let radius = self.radius();
        for vertex in &mut self.vertices {
            vertex.curvatures = vertex.curvatures.map(|curvature| curvature * radius);
            vertex.width *= radius;
        }
    }

    fn add_node(
        &mut self,
        scene: &Scene,
        object: u32,
        node: &Node,
        mesh: &npr_scene::Mesh,
        textures: &mut Textures,
        cutoffs: &Cutoffs,
    ) -> Result<(), RenderError> {
        // Prepare the mesh at its node, and check that everything can be numbered.
        let first_joint = self.palette.len() as u32;
        self.palette.extend(placement::matrices_of(scene, node));
        let determinant = placement::determinant_of(&self.palette[first_joint as usize]);
        let scale = npr_core::math::powf(determinant.abs(), 1.0 / 3.0).max(1e-12);
        let mirrored = determinant < 0.0;
        self.scales.insert(object, scale);
        let parts = surfaces_of(mesh);
        let instance = Instance::new(&self.cache, scene, (node, &parts), scale, mirrored);
        let base = [
            self.vertices.len() as u32,
            self.triangles.len() as u32,
            self.parts.len() as u32,
        ];
        check_count("vertices", self.vertices.len(), instance.vertices.len())?;
        check_count("triangles", self.triangles.len(), instance.triangles.len())?;
        check_count("edges", self.edges.len(), instance.edges.len())?;

        // Note where it begins, where it bends.
        let first = [self.vertices.len(), self.triangles.len(), self.edges.len()];
        self.bending.extend(instance.kept.map(|kept| Bending {
            node: object,
            first,
            kept,
            mirrored,
        }));

        // Append vertices, triangles and edges, numbered as in the whole model.
        let surface = (&instance.vertices[..], &instance.influences[..]);
        let limbs = Limbs::of(scene, object, node, surface);
        self.limbs.append(base[0] as usize, limbs);
        let joint_count = self.palette.len() as u32 - first_joint;
        self.influences
            .extend(instance.influences.iter().map(|influence| {
                Influence {
                    joints: influence
                        .joints
                        .map(|joint| joint.min(joint_count - 1) + first_joint),
                    ..*influence
                }
            }));
        if !instance.painted.is_empty() {
            self.painted.resize(base[0] as usize, [0.0; 3]);
            self.painted.extend(&instance.painted);
        }
        self.vertices
            .extend(instance.vertices.iter().map(|v| Vertex {
                part: v.part + base[2],
                ..*v
            }));
        self.triangles
            .extend(instance.triangles.iter().map(|triangle| Triangle {
                corners: triangle.corners.map(|corner| corner + base[0]),
                part: triangle.part + base[2],
            }));
        self.edges.extend(instance.edges.iter().map(|edge| {
            Edge {
                ends: edge.ends.map(|end| end + base[0]),
                faces: edge
                    .faces
                    .map(|face| if face == NONE { NONE } else { face + base[1] }),
                ..*edge
            }
        }));
        self.normals_cos.extend(&instance.normals_cos);

        // Append its parts, one for each piece.
        let infos: Vec<PartInfo> = parts
            .iter()
            .map(|part| {
                let info = PartInfo::new(scene, object, &node.name, part.material, cutoffs);
                let texture = base_color_texture(scene, part, textures);
                let toon = PartToon::new(scene, part, textures);
                PartInfo {
                    texture,
                    toon: toon.map(Box::new),
                    has_uvs: part.uvs.is_some(),
                    ids: part.ids.clone(),
                    ..info
                }
            })
            .collect();
        self.parts
            .extend(instance.pieces.iter().map(|piece| PartInfo {
                component: piece.component,
                ..infos[piece.part as usize].clone()
            }));
        Ok(())
    }

    placement::accessors!();

    /// Radius of the sphere around the scene as it was prepared, in the world; at least a tiny number. A pose leaves it
    /// as it is, so that what a style measures in radii does not pulse with the pose.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// Moves the model into the pose of a scene: the one that it was made of, with other places of nodes and joints,
    /// and other weights of morphs ([`Scene::set_pose`]).
    ///
    /// Vertices, triangles, edges and parts keep their numbers, and nothing is welded anew. Bounds, lights and cameras
    /// follow; so do the folds of meshes with skins or morphs, which decide about creases, and the positions and
    /// normals of meshes with morphs. Curvature, with the widths that hang on it, and radius stay those of the pose
    /// that the model was made in; hard edges of meshes without normals too. No node may be turned inside out that was
    /// not so before. O(vertices + edges of meshes that bend).
    ///
    /// The same pose gives the same model, bit for bit, whatever pose it had before.
    ///
    /// # Errors
    ///
    /// [`RenderError::OtherScene`] for a scene with another number of matrices; the model then stays as it is.
    pub fn set_pose(&mut self, scene: &Scene) -> Result<(), RenderError> {
        self.pose(scene).map(drop)
    }

    /// As [`Self::set_pose`]; returns what changed besides matrices.
    pub(crate) fn pose(&mut self, scene: &Scene) -> Result<Moved, RenderError> {
        // Take over the matrices.
        let drawn = scene
            .nodes
            .iter()
            .filter(|node| mesh_of(scene, node).is_some());
        let palette: Vec<Matrix> = drawn
            .flat_map(|node| placement::matrices_of(scene, node))
            .collect();
        if palette.len() != self.palette.len() {
            return Err(RenderError::OtherScene {
                have: palette.len(),
                want: self.palette.len(),
            });
        }
        self.palette = palette;

        // Let meshes that bend follow.
        if self.unmorphed.is_none() && self.bending.iter().any(|bending| bending.has_morphs(scene))
        {
            self.unmorphed = Some(self.vertices.clone());
        }
        let mut lists = Lists {
            vertices: &mut self.vertices,
            triangles: &self.triangles,
            edges: &mut self.edges,
            normals_cos: &mut self.normals_cos,
        };
        let mut moved = Moved::default();
        for bending in &self.bending {
            let Moved { vertices, edges } = bending.follow(scene, &mut lists);
            moved.vertices |= vertices;
            moved.edges |= edges;
        }

        // Settle what depends on all of them.
        self.line_points = line_points(scene);
        self.bounds = npr_core::camera::bounds_of(self.posed_points());
        self.lights = file_light::of_scene(scene, self.bounds);
        self.cameras = placement::cameras_of(scene);
        Ok(moved)
    }

    /// The vertices as they were prepared, before any pose.
    pub(crate) fn unmorphed(&self) -> &[Vertex] {
        self.unmorphed.as_ref().unwrap_or(&self.vertices)
    }

    /// How much longer things of an object are in the world than in its mesh, as it was prepared.
    pub(crate) fn scale_of(&self, object: u32) -> f32 {
        self.scales.get(&object).copied().unwrap_or(1.0)
    }

    /// The names of objects with surfaces, by their numbers, which count from 1.
    pub fn object_names(&self) -> BTreeMap<u32, &str> {
        let parts = self.parts.iter();
        parts
            .map(|part| (part.object + 1, part.object_name.as_str()))
            .collect()
    }

    /// Number of triangles, counted for every instance.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Whether there is nothing to see, whatever the style.
    pub(crate) fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.line_points.is_empty()
    }

    /// Whether the file has lines as geometry, which only line methods `strokes` and `potrace` draw.
    pub fn has_lines(&self) -> bool {
        !self.line_points.is_empty()
    }

    /// Number of unique edges.
    pub fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// The edges, with folds measured between the file's normals or between faces.
    pub(crate) fn edges_by(&self, from: CreaseFrom) -> Cow<'_, [Edge]> {
        match from {
            CreaseFrom::Faces => Cow::Borrowed(&self.edges),
            CreaseFrom::Normals => {
                let edges = self.edges.iter().zip(&self.normals_cos);
                let folded = edges.map(|(edge, cos)| Edge {
                    dihedral_cos: *cos,
                    ..*edge
                });
                Cow::Owned(folded.collect())
            }
        }
    }

    /// A view of the whole model from three quarters above, for a frame of width / height `aspect`; `fov_y` is in
    /// radians.
    pub fn framing(&self, aspect: f32, fov_y: f32) -> Camera {
        Camera::framing_points(
            self.posed_points().map(|point| point.to_array()),
            aspect,
            fov_y,
        )
    }

    /// The same view of the model together with smoke.
    pub fn framing_with(&self, smoke: &Smoke, aspect: f32, fov_y: f32) -> Camera {
        Camera::framing_points(self.places_with(smoke), aspect, fov_y)
    }

    /// Places all over the model together with smoke, for framing it; those of vertices are exact.
    pub fn places_with(&self, smoke: &Smoke) -> impl Iterator<Item = [f32; 3]> {
        let points = self.posed_points().chain(smoke.reach());
        points.map(|point| point.to_array())
    }

    /// A view from three quarters above that the model together with smoke stays within while the camera turns about
    /// an axis through `pivot`. `fov_y` is in radians. O(vertices).
    pub fn framing_around(
        &self,
        smoke: &Smoke,
        [pivot, axis]: [[f32; 3]; 2],
        (aspect, fov_y): (f32, f32),
    ) -> Camera {
        let points: Vec<Vec3> = self.posed_points().chain(smoke.reach()).collect();
        let swept = npr_core::camera::swept(points.iter().copied(), pivot, axis);
        Camera::framing_points(swept.into_iter(), aspect, fov_y)
    }

    /// The box around the model and smoke; that of one alone where the other has nothing to draw.
    pub fn bounds_with(&self, smoke: &Smoke) -> Bounds {
        if smoke.reach().next().is_none() {
            return self.bounds;
        }
        if self.is_empty() {
            return smoke.extent();
        }
        around(self.bounds, smoke.extent())
    }

    /// Positions in the world of all vertices that triangles and lines use.
    fn posed_points(&self) -> impl Iterator<Item = Vec3> + '_ {
        let mut used = vec![false; self.vertices.len()];
        for corner in self.triangles.iter().flat_map(|triangle| triangle.corners) {
            used[corner as usize] = true;
        }
        let posed = self
            .vertices
            .iter()
            .zip(&self.influences)
            .zip(used)
            .filter(|(_, used)| *used);
        posed
            .map(|((vertex, influence), _)| self.posed_point(vertex, influence))
            .chain(self.line_points.iter().copied())
    }

    /// Where a vertex lies in the world.
    pub(crate) fn posed_point(&self, vertex: &Vertex, influence: &Influence) -> Vec3 {
        let position = Vec3::from(vertex.position);
        self.moved(influence, |m| m.transform_point3(position))
    }

    /// A direction at a vertex with this influence, turned into the world; its length means nothing.
    pub(crate) fn posed_direction(&self, direction: Vec3, influence: &Influence) -> Vec3 {
        self.moved(influence, |m| m.transform_vector3(direction))
    }

    /// Applies `by` to the matrices of an influence, and blends what it gives by their weights.
    fn moved(&self, influence: &Influence, by: impl Fn(&Mat4) -> Vec3) -> Vec3 {
        let moved = |k: usize| {
            let m = Mat4::from_cols_array_2d(&self.palette[influence.joints[k] as usize]);
            by(&m) * influence.weights[k]
        };
        moved(0) + moved(1) + moved(2) + moved(3)
    }
}

/// The mesh of a node.
fn mesh_of<'a>(scene: &'a Scene, node: &Node) -> Option<&'a npr_scene::Mesh> {
    scene.meshes.get(node.mesh? as usize)
}

/// Where the lines of a scene end in the world, each vertex of a part once.
fn line_points(scene: &Scene) -> Vec<Vec3> {
    let drawn = scene.drawn_parts();
    let lined = drawn.filter(|(_, part)| !part.segments.is_empty());
    let points = lined.flat_map(|(node, part)| {
        let mut used = vec![false; part.positions.len()];
        for end in part.segments.iter().flatten() {
            used[*end as usize] = true;
        }
        let world = scene.positions_world(node, part).into_iter().zip(used);
        world
            .filter(|(_, used)| *used)
            .map(|(point, _)| Vec3::from(point))
    });
    points.collect()
}
