//! A scene's meshes where they stand, ready to become one shape.

use crate::cutoffs::Cutoffs;
use crate::instance::packed_color;
use crate::joined::Joined;
use crate::part_info::PartInfo;
use crate::placement;
use npr_mesh::half_edge::Surface;
use npr_mesh::shape::PlacedMesh;
use npr_scene::{Mesh, Node, Part, Scene};
use npr_stylesheet::Style;
use std::collections::BTreeMap;

/// One node's mesh in the world.
#[derive(Debug)]
pub(crate) struct Placed {
    rest: Vec<[f32; 3]>,
    /// The file's normals; zero where a part has none, empty where all have none.
    normals: Vec<[f32; 3]>,
    world: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Triangles of beams: no surface, but part of what a picture frames.
    glowing: Vec<[u32; 3]>,
    surfaces: Vec<u32>,
    marks: Vec<[u32; 2]>,
    /// Segments of the file's own lines, and the surface that each belongs to.
    polylines: Vec<[u32; 2]>,
    polyline_surfaces: Vec<u32>,
    mirrored: bool,
    /// Vertex colours, sRGB bytes; empty where the mesh has none.
    colors: Vec<u32>,
}

/// Everything of a scene that lines are drawn of.
#[derive(Debug, Default)]
pub(crate) struct Assembly {
    /// Meshes in node order.
    pub meshes: Vec<Placed>,
    /// One for every object in every material and id, in the order in which faces name them.
    pub parts: Vec<PartInfo>,
    /// For every part, whether the file asks for a line around its material.
    pub marked: Vec<bool>,
}

/// How lines treat a part of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    /// The surface of this number.
    Surface(u32),
    /// A beam of light: neither has nor hides lines.
    Beam,
    /// Nothing that pictures show.
    Unseen,
}

impl Assembly {
    /// Gathers what a scene draws. Parts so transparent that pictures do not show them are left out, and so is what a
    /// style makes beams of.
    pub fn new(scene: &Scene, style: Option<&Style>) -> Self {
        let mut assembly = Self::default();
        let cutoffs = Cutoffs::of(scene);
        for (object, node) in scene.nodes.iter().enumerate() {
            if let Some(mesh) = node.mesh.and_then(|mesh| scene.meshes.get(mesh as usize)) {
                assembly.add_node(scene, style, object as u32, node, mesh, &cutoffs);
            }
        }
        assembly
    }

    fn add_node(
        &mut self,
        scene: &Scene,
        style: Option<&Style>,
        object: u32,
        node: &Node,
        mesh: &Mesh,
        cutoffs: &Cutoffs,
    ) {
        // Join the parts of the mesh, and decide how lines treat each.
        let joined = Joined::new(&mesh.parts.iter().collect::<Vec<_>>());
        let roles = self.add_surfaces(scene, style, object, node, mesh, cutoffs);

        // Sort triangles and segments by that.
        let placed = || joined.triangles.iter().zip(&joined.parts);
        let drawn: Vec<([u32; 3], u32)> = placed()
            .filter_map(|(corners, part)| match roles[*part as usize] {
                Role::Surface(surface) => Some((*corners, surface)),
                Role::Beam | Role::Unseen => None,
            })
            .collect();
        let glowing = placed().filter(|(_, part)| roles[**part as usize] == Role::Beam);
        let glowing = glowing.map(|(corners, _)| *corners).collect();
        let segments = joined.segments.iter().zip(&joined.segment_parts);
        let (polylines, polyline_surfaces) = segments
            .filter_map(|(ends, part)| match roles[*part as usize] {
                Role::Surface(surface) => Some((*ends, surface)),
                Role::Beam | Role::Unseen => None,
            })
            .unzip();

        // Place the mesh in the world.
        let marked = marked_vertices(&mesh.parts);
        let triangles: Vec<[u32; 3]> = drawn.iter().map(|(corners, _)| *corners).collect();
        let world = mesh
            .parts
            .iter()
            .flat_map(|part| scene.positions_world(node, part));
        let first_matrix = &placement::matrices_of(scene, node)[0];
        self.meshes.push(Placed {
            world: world.collect(),
            rest: joined.positions,
            normals: joined.normals,
            surfaces: drawn.iter().map(|(_, surface)| *surface).collect(),
            marks: marked_edges(&triangles, &marked),
            polylines,
            polyline_surfaces,
            mirrored: placement::determinant_of(first_matrix) < 0.0,
            colors: vertex_colors(&mesh.parts),
            triangles,
            glowing,
        });
    }

    /// Adds a surface for every material and id of a mesh, and says what each part is.
    fn add_surfaces(
        &mut self,
        scene: &Scene,
        style: Option<&Style>,
        object: u32,
        node: &Node,
        mesh: &Mesh,
        cutoffs: &Cutoffs,
    ) -> Vec<Role> {
        let mut roles: BTreeMap<(Option<u32>, &[String]), Role> = BTreeMap::new();
        let parts = mesh.parts.iter().map(|part| {
            *roles.entry((part.material, &part.ids)).or_insert_with(|| {
                // Leave out what pictures do not show, and beams.
                let info = PartInfo {
                    ids: part.ids.clone(),
                    ..PartInfo::new(scene, object, &node.name, part.material, cutoffs)
                };
                if info.is_invisible() {
                    return Role::Unseen;
                }
                if style.is_some_and(|style| info.is_beam(style)) {
                    return Role::Beam;
                }

                // Number the surface, and note whether its material asks for lines.
                let material = part.material.and_then(|m| scene.materials.get(m as usize));
                self.marked.push(material.is_some_and(|m| m.marked));
                self.parts.push(info);
                Role::Surface(self.parts.len() as u32 - 1)
            })
        });
        parts.collect()
    }

    /// Number of triangles that are drawn.
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.triangles.len()).sum()
    }

    /// Number of segments of lines that are geometry themselves.
    pub fn polyline_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.polylines.len()).sum()
    }

    /// Number of stored vertices.
    pub fn vertex_count(&self) -> usize {
        self.meshes.iter().map(Placed::vertex_count).sum()
    }

    /// The surfaces that faces belong to, as shapes list them.
    pub fn surfaces(&self) -> Vec<Surface> {
        let surfaces = self.parts.iter().map(|info| Surface {
            object: info.object,
            material: info.material,
            object_name: info.object_name.clone(),
            material_name: info.material_name.clone(),
            base_color: info.base_color,
            double_sided: info.double_sided,
            is_lineless: false,
            is_mass: false,
        });
        surfaces.collect()
    }

    /// Positions in the world of all vertices that triangles and polylines use.
    pub fn used_points(&self) -> Vec<[f32; 3]> {
        self.meshes.iter().flat_map(Placed::used_points).collect()
    }

    /// Colour at each position that has one, sorted by position; of several, the first stored.
    pub fn colors(&self) -> Vec<([u32; 3], u32)> {
        let colored = self.meshes.iter().filter(|mesh| !mesh.colors.is_empty());
        let mut colors: Vec<([u32; 3], u32)> = colored
            .flat_map(|mesh| mesh.world.iter().zip(&mesh.colors))
            .map(|(position, color)| (place_key(*position), *color))
            .collect();
        colors.sort_by_key(|(place, _)| *place);
        colors.dedup_by_key(|(place, _)| *place);
        colors
    }
}

impl Placed {
    /// The mesh as shapes take it.
    pub fn view(&self) -> PlacedMesh<'_> {
        PlacedMesh {
            rest: &self.rest,
            world: &self.world,
            normals: &self.normals,
            triangles: &self.triangles,
            surfaces: &self.surfaces,
            marks: &self.marks,
            polylines: &self.polylines,
            polyline_surfaces: &self.polyline_surfaces,
            mirrored: self.mirrored,
        }
    }

    /// Every triangle: its corners as stored vertices, its surface, and where its corners stand in the world.
    pub fn drawn(&self) -> impl Iterator<Item = ([u32; 3], u32, [[f32; 3]; 3])> {
        let triangles = self.triangles.iter().zip(&self.surfaces);
        triangles.map(|(corners, surface)| {
            let world = corners.map(|corner| self.world[corner as usize]);
            (*corners, *surface, world)
        })
    }

    /// Number of stored vertices.
    pub fn vertex_count(&self) -> usize {
        self.world.len()
    }

    fn used_points(&self) -> impl Iterator<Item = [f32; 3]> + '_ {
        self.used()
            .into_iter()
            .map(|vertex| self.world[vertex as usize])
    }

    /// The stored vertices that triangles and polylines use, in ascending order.
    pub fn used(&self) -> Vec<u32> {
        let mut used = vec![false; self.world.len()];
        let corners = self.triangles.iter().chain(&self.glowing).flatten();
        for corner in corners.chain(self.polylines.iter().flatten()) {
            used[*corner as usize] = true;
        }
        let vertices = (0u32..).zip(used);
        vertices
            .filter(|(_, used)| *used)
            .map(|(vertex, _)| vertex)
            .collect()
    }
}

/// A position as a key of equality.
pub(crate) fn place_key(position: [f32; 3]) -> [u32; 3] {
    // -0 equals 0, and adding 0 makes it so.
    position.map(|v| (v + 0.0).to_bits())
}

/// Whether the file marks each vertex of joined parts; empty where it marks none.
fn marked_vertices(parts: &[Part]) -> Vec<bool> {
    if parts.iter().all(|part| part.marks.is_none()) {
        return Vec::new();
    }
    let marks = parts.iter().flat_map(|part| match &part.marks {
        Some(marks) => marks.clone(),
        None => vec![false; part.positions.len()],
    });
    marks.collect()
}

/// The edges of triangles between two marked vertices.
fn marked_edges(triangles: &[[u32; 3]], marked: &[bool]) -> Vec<[u32; 2]> {
    if marked.is_empty() {
        return Vec::new();
    }
    let edges = triangles
        .iter()
        .flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    edges
        .filter(|ends| ends.iter().all(|end| marked[*end as usize]))
        .collect()
}

fn vertex_colors(parts: &[Part]) -> Vec<u32> {
    if parts.iter().all(|part| part.colors.is_none()) {
        return Vec::new();
    }
    let colors = parts.iter().flat_map(|part| match &part.colors {
        Some(colors) => colors.iter().map(|color| packed_color(*color)).collect(),
        None => vec![u32::MAX; part.positions.len()],
    });
    colors.collect()
}
