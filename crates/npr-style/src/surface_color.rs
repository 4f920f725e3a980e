//! The colour of surfaces without light: the material's, its vertices' and its texture's.

use crate::compose::Layers;
use crate::corners::Corners;
use crate::luminance::LUMA;
use npr_core::geometry::{NONE, Part, Triangle, Vertex};
use npr_core::surface::{blend2, blend3, dot, weights_at};
use npr_core::texture;

/// A colour in linear light with its saturation scaled: grey at 0, unchanged at 1.
#[inline]
pub fn strengthened(color: [f32; 3], saturation: f32) -> [f32; 3] {
    if saturation == 1.0 {
        return color;
    }
    let luma = dot(color, LUMA);
    color.map(|v| (luma + (v - luma) * saturation).max(0.0))
}

impl Layers<'_> {
    /// A colour with the saturation of the style.
    #[inline]
    pub(crate) fn strengthened(&self, color: [f32; 3]) -> [f32; 3] {
        strengthened(color, self.compose.saturation)
    }

    /// Surface colour without light.
    #[inline]
    pub(crate) fn plain_color(
        &self,
        triangle: &Triangle,
        part: &Part,
        corners: &Corners<'_>,
        frame_px: [f32; 2],
    ) -> [f32; 3] {
        // Take the material as it is where nothing else colours it.
        let vertices = triangle.corners.map(|v| &self.vertices[v as usize]);
        let [r, g, b, _] = part.base_color;
        if part.flags & Part::PLAIN != 0 {
            return [r, g, b];
        }

        // Tint it by the colours of the vertices.
        let weights = weights_at(corners.clip, self.view.ndc_at(frame_px));
        let tint = self.tint(weights, vertices);
        let color = [r * tint[0], g * tint[1], b * tint[2]];
        if part.texture == NONE {
            return color;
        }

        // Multiply it by the texture, averaged over the pixel.
        let uvs = vertices.map(|v| v.uv);
        let uv_near = |dx: f32, dy: f32| {
            blend2(
                weights_at(
                    corners.clip,
                    self.view.ndc_at([frame_px[0] + dx, frame_px[1] + dy]),
                ),
                uvs,
            )
        };
        let (uv, right, down) = (blend2(weights, uvs), uv_near(1.0, 0.0), uv_near(0.0, 1.0));
        let covered = footprint([uv, right, down]);
        let texel = texture::sample(self.texels, part.texture, uv, covered);
        std::array::from_fn(|i| color[i] * texel[i])
    }

    /// Vertex colours of a triangle where its corners have these weights, linear light.
    #[inline]
    pub(crate) fn tint(&self, weights: [f32; 3], vertices: [&Vertex; 3]) -> [f32; 3] {
        let color_of = |vertex: &Vertex| {
            let [r, g, b, _] = self.linear_texel(vertex.color);
            [r, g, b]
        };
        blend3(weights, vertices.map(color_of))
    }
}

/// Size of a pixel in coordinates of a texture, given those at the pixel, to its right and below.
#[inline]
pub(crate) fn footprint([uv, right, down]: [[f32; 2]; 3]) -> f32 {
    let square = |there: [f32; 2]| (there[0] - uv[0]).powi(2) + (there[1] - uv[1]).powi(2);
    square(right).max(square(down)).sqrt()
}
