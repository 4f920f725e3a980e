//! Scenes put together from generated meshes.

use npr_mesh::Mesh;
use npr_mesh::testing::{cube, mapped, plane};
use npr_scene::{Material, Node, Part, Scene};

/// A mesh with a name and a material.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Name of its node.
    pub name: String,
    /// What it draws.
    pub mesh: Mesh,
    /// Its material.
    pub material: Material,
    /// Vertex colours, linear light, one per vertex of the mesh.
    pub colors: Option<Vec<[f32; 4]>>,
}

impl Object {
    /// A white, single-sided object.
    pub fn new(name: &str, mesh: Mesh) -> Self {
        Self {
            name: name.to_owned(),
            mesh,
            material: Material {
                name: name.to_owned(),
                ..Material::default()
            },
            colors: None,
        }
    }

    /// The same, seen from both sides.
    pub fn double_sided(mut self) -> Self {
        self.material.double_sided = true;
        self
    }

    /// The same in another colour, linear light.
    pub fn colored(mut self, [r, g, b]: [f32; 3]) -> Self {
        self.material.base_color = [r, g, b, 1.0];
        self
    }

    /// The same with a red share 0..1 for every vertex, as widths are painted.
    pub fn painted(mut self, reds: &[f32]) -> Self {
        self.colors = Some(reds.iter().map(|red| [*red, 0.0, 0.0, 1.0]).collect());
        self
    }

    fn part(&self, material: u32) -> Part {
        Part {
            positions: self.mesh.positions().to_vec(),
            triangles: self.mesh.triangles().to_vec(),
            colors: self.colors.clone(),
            material: Some(material),
            ..Part::default()
        }
    }
}

/// A scene of objects, each with a node, a mesh and a material of its own.
pub fn scene_of(objects: &[Object]) -> Scene {
    let node = |(mesh, object): (u32, &Object)| Node {
        name: object.name.clone(),
        mesh: Some(mesh),
        ..Node::default()
    };
    let mesh = |(material, object): (u32, &Object)| npr_scene::Mesh {
        name: object.name.clone(),
        parts: vec![object.part(material)],
    };
    Scene {
        nodes: (0..).zip(objects).map(node).collect(),
        meshes: (0..).zip(objects).map(mesh).collect(),
        materials: objects
            .iter()
            .map(|object| object.material.clone())
            .collect(),
        ..Scene::default()
    }
}

/// A mesh scaled, then moved.
pub fn placed(mesh: &Mesh, scale: [f32; 3], offset: [f32; 3]) -> Mesh {
    mapped(mesh, |p| {
        std::array::from_fn(|i| p[i] * scale[i] + offset[i])
    })
}

/// The box between two corners.
pub fn boxed(low: [f32; 3], high: [f32; 3]) -> Mesh {
    let half = std::array::from_fn(|i| (high[i] - low[i]) * 0.5);
    let middle = std::array::from_fn(|i| (high[i] + low[i]) * 0.5);
    placed(&cube(), half, middle)
}

/// Two boxes of one object that cut through each other, one along x and one along y, and a wall behind them.
///
/// The upright box reaches from (-0.2, -1, -0.2) to (0.4, 1, 0.4), the other from (-1, -0.3, -0.3) to (1, 0.3, 0.3).
pub fn crossing_boxes() -> Scene {
    let wall = placed(&plane(1, 1), [4.0, 4.0, 1.0], [-2.0, -2.0, -1.0]);
    let mut scene = scene_of(&[
        Object::new("Boxes", boxed([-1.0, -0.3, -0.3], [1.0, 0.3, 0.3])).colored([0.2, 0.5, 0.8]),
        Object::new("Wall", wall).double_sided(),
    ]);
    let upright = Object::new("Boxes", boxed([-0.2, -1.0, -0.2], [0.4, 1.0, 0.4]));
    scene.meshes[0].parts.push(upright.part(0));
    scene
}
