//! Painted triangles, before their normals are known.

use glam::{Mat3, Vec2, Vec3};

/// Which material of a scene a triangle is painted with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Paint(pub usize);

/// A corner that several triangles share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Place in centimetres, y up.
    pub position: Vec3,
    /// Texture coordinate; u goes around and v along.
    pub uv: Vec2,
}

/// Three vertices, counter-clockwise from outside, and their material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// Indices into [`Shape::vertices`].
    pub corners: [u32; 3],
    /// The material.
    pub paint: Paint,
}

/// Painted triangles without normals. Vertices at equal places count as joined.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Shape {
    /// The corners.
    pub vertices: Vec<Vertex>,
    /// The faces.
    pub triangles: Vec<Triangle>,
}

impl Shape {
    /// A surface over `rows` x `columns` points, all of one paint.
    ///
    /// The outside is where rows x columns points by the right-hand rule. Triangles with two corners
    /// at one place, as at a pole, are left out.
    pub fn grid(
        rows: u32,
        columns: u32,
        paint: Paint,
        vertex: impl Fn(u32, u32) -> Vertex,
    ) -> Self {
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let vertices = places.map(|(row, column)| vertex(row, column)).collect();
        let mut shape = Self {
            vertices,
            triangles: Vec::new(),
        };
        for row in 1..rows {
            for column in 1..columns {
                let d = row * columns + column;
                let [a, b, c] = [d - columns - 1, d - columns, d - 1];
                shape.face([a, c, d], paint);
                shape.face([a, d, b], paint);
            }
        }
        shape
    }

    /// Adds a triangle unless two of its corners lie at one place.
    pub fn face(&mut self, corners: [u32; 3], paint: Paint) {
        let [a, b, c] = corners.map(|corner| self.vertices[corner as usize].position);
        if a != b && b != c && c != a {
            self.triangles.push(Triangle { corners, paint });
        }
    }

    /// This shape together with another.
    pub fn join(mut self, other: Self) -> Self {
        let base = self.vertices.len() as u32;
        self.vertices.extend(other.vertices);
        self.triangles
            .extend(other.triangles.into_iter().map(|triangle| Triangle {
                corners: triangle.corners.map(|corner| corner + base),
                ..triangle
            }));
        self
    }

    /// The shape with every place sent through `map`.
    pub fn warp(mut self, map: impl Fn(Vec3) -> Vec3) -> Self {
        for vertex in &mut self.vertices {
            vertex.position = map(vertex.position);
        }
        self
    }

    /// The shape turned about the origin, then moved; both in centimetres.
    pub fn placed(self, turn: Mat3, to: Vec3) -> Self {
        self.warp(|p| turn * p + to)
    }

    /// The shape with new paint on the triangles whose mean texture coordinate passes `test`.
    pub fn repaint(mut self, paint: Paint, test: impl Fn(Vec2) -> bool) -> Self {
        for triangle in &mut self.triangles {
            let [a, b, c] = triangle
                .corners
                .map(|corner| self.vertices[corner as usize].uv);
            if test((a + b + c) / 3.0) {
                triangle.paint = paint;
            }
        }
        self
    }

    /// The three places of a triangle.
    pub fn corners(&self, triangle: &Triangle) -> [Vec3; 3] {
        triangle
            .corners
            .map(|corner| self.vertices[corner as usize].position)
    }
}

/// The bits of a place, equal for equal places; zero has one sign here.
pub fn place_key(place: Vec3) -> [u32; 3] {
    place.to_array().map(|v| (v + 0.0).to_bits())
}

/// Counts of directed edges that lack their opposite: 0 for a closed surface.
#[cfg(test)]
pub fn open_edge_count(shape: &Shape) -> usize {
    let mut balance = std::collections::BTreeMap::new();
    for triangle in &shape.triangles {
        let keys = shape.corners(triangle).map(place_key);
        for i in 0..3 {
            let (from, to) = (keys[i], keys[(i + 1) % 3]);
            let step = if from < to { 1 } else { -1 };
            *balance.entry((from.min(to), from.max(to))).or_insert(0i32) += step;
        }
    }
    balance.values().filter(|&&sum| sum != 0).count()
}

/// The volume inside a closed surface, negative where it is inside out.
#[cfg(test)]
pub fn volume(shape: &Shape) -> f32 {
    let signed = |[a, b, c]: [Vec3; 3]| a.dot(b.cross(c)) / 6.0;
    shape
        .triangles
        .iter()
        .map(|triangle| signed(shape.corners(triangle)))
        .sum()
}
