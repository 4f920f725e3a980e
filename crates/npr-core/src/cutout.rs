//! Holes in cut-out parts: leaves, hair and decals drawn by the alpha of their texture.

use crate::geometry::{NONE, Part, PosedVertex, Triangle, Vertex};
use crate::surface;
use crate::texture;

/// What a hole is decided from.
#[derive(Debug, Clone, Copy)]
pub struct Cutout<'a> {
    /// Posed vertices.
    pub posed: &'a [PosedVertex],
    /// Stored vertices.
    pub vertices: &'a [Vertex],
    /// Triangles.
    pub triangles: &'a [Triangle],
    /// Parts.
    pub parts: &'a [Part],
    /// The texture store.
    pub texels: &'a [u32],
}

impl Cutout<'_> {
    /// Whether a triangle of a cut-out part is transparent at a point of the picture, in normalised device coordinates.
    pub fn is_hole(&self, triangle: u32, ndc: [f32; 2]) -> bool {
        let Triangle { corners, part } = self.triangles[triangle as usize];
        if self.parts[part as usize].flags & Part::CUTOUT == 0 {
            return false;
        }
        let clip = corners.map(|v| self.posed[v as usize].clip);
        self.is_hole_at(triangle, surface::weights_at(clip, ndc))
    }

    /// Whether it is transparent where its corners have these weights; needs no posed vertices.
    pub fn is_hole_at(&self, triangle: u32, weights: [f32; 3]) -> bool {
        let triangle = self.triangles[triangle as usize];
        let part = &self.parts[triangle.part as usize];
        if part.flags & Part::CUTOUT == 0 {
            return false;
        }
        let corners = triangle.corners.map(|v| v as usize);
        let mut alpha = part.base_color[3];
        alpha *= surface::blend(
            weights,
            corners.map(|v| (self.vertices[v].color >> 24) as f32),
        ) / 255.0;
        if part.texture != NONE {
            let uv = surface::blend2(weights, corners.map(|v| self.vertices[v].uv));
            alpha *= texture::sample(self.texels, part.texture, uv, 0.0)[3];
        }
        alpha < part.alpha_cutoff
    }
}
