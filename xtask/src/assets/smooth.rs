//! Normals for painted shapes: smooth across shallow edges, split at creases.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};
use npr_core::math;

use super::shape::{Paint, Shape, Triangle, place_key};

/// Angle between face normals, in radians, from which an edge is crisp: 40 degrees.
///
/// The command draws creases from the same angle, so that lines lie where the shading breaks.
pub const CREASE: f32 = 0.698;

/// Vertices ready to be written, and the faces of each paint.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SmoothMesh {
    /// Places in centimetres.
    pub positions: Vec<Vec3>,
    /// Unit normals.
    pub normals: Vec<Vec3>,
    /// Texture coordinates.
    pub uvs: Vec<Vec2>,
    /// Triangles by paint, in the order of the shape.
    pub faces: BTreeMap<Paint, Vec<[u32; 3]>>,
}

/// A face at a corner: its unit normal, and the corner's angle as the weight.
type Spoke = (Vec3, f32);

/// Gives every corner the mean normal of those faces around it that bend away less than [`CREASE`].
///
/// Faces weigh by their angle at the corner. O(n d) for n triangles with d faces around a corner.
pub fn smoothed(shape: &Shape) -> SmoothMesh {
    let spokes = spokes_by_place(shape);
    let mut mesh = SmoothMesh::default();
    let mut known = BTreeMap::new();
    for triangle in &shape.triangles {
        let face = face_normal(shape.corners(triangle));
        let corners = triangle.corners.map(|corner| {
            let vertex = shape.vertices[corner as usize];
            let normal = corner_normal(&spokes[&place_key(vertex.position)], face);
            let key = (corner, normal.to_array().map(f32::to_bits));
            *known
                .entry(key)
                .or_insert_with(|| mesh.push(vertex.position, normal, vertex.uv))
        });
        mesh.faces.entry(triangle.paint).or_default().push(corners);
    }
    mesh
}

impl SmoothMesh {
    /// Adds a vertex and returns its index.
    fn push(&mut self, position: Vec3, normal: Vec3, uv: Vec2) -> u32 {
        self.positions.push(position);
        self.normals.push(normal);
        self.uvs.push(uv);
        self.positions.len() as u32 - 1
    }
}

/// The faces around each place of a shape.
fn spokes_by_place(shape: &Shape) -> BTreeMap<[u32; 3], Vec<Spoke>> {
    let mut spokes: BTreeMap<_, Vec<Spoke>> = BTreeMap::new();
    for triangle in &shape.triangles {
        let corners = shape.corners(triangle);
        let normal = face_normal(corners);
        for (corner, angle) in corners.into_iter().zip(corner_angles(shape, triangle)) {
            spokes
                .entry(place_key(corner))
                .or_default()
                .push((normal, angle));
        }
    }
    spokes
}

/// The weighted mean of the normals within [`CREASE`] of `face`, rounded so that equal ones merge.
fn corner_normal(spokes: &[Spoke], face: Vec3) -> Vec3 {
    let limit = math::cos(CREASE);
    let near = spokes.iter().filter(|(normal, _)| normal.dot(face) > limit);
    let sum: Vec3 = near.map(|&(normal, angle)| normal * angle).sum();
    let unit = sum.normalize_or(face);
    (unit * 32768.0).round() / 32768.0 + Vec3::ZERO
}

/// The unit normal of a counter-clockwise triangle.
fn face_normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// The three inner angles of a triangle in radians.
fn corner_angles(shape: &Shape, triangle: &Triangle) -> [f32; 3] {
    let p = shape.corners(triangle);
    [0, 1, 2].map(|i| {
        let to = |j: usize| (p[j % 3] - p[i]).normalize_or_zero();
        math::acos(to(i + 1).dot(to(i + 2)).clamp(-1.0, 1.0))
    })
}

#[cfg(test)]
mod tests {
    use super::super::prism::cuboid;
    use super::super::turned::ball;
    use super::*;

    #[test]
    fn a_ball_has_radial_normals() {
        let mesh = smoothed(&ball(3.0, 64, Paint(0)));
        for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
            assert!(
                position.normalize().dot(*normal) > 0.999,
                "{position} has {normal}"
            );
        }
    }

    #[test]
    fn a_cube_keeps_flat_faces() {
        let mesh = smoothed(&cuboid(1.0, 1.0, 1.0, Paint(0)));
        assert_eq!(mesh.positions.len(), 24);
        assert!(
            mesh.normals
                .iter()
                .all(|normal| normal.abs().max_element() == 1.0)
        );
    }
}
