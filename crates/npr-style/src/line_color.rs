//! Where the colour of a line comes from: the twins of `lib/line_color`, `line.color_mask` and `line.light_widths`.
//!
//! A line's colour has two halves. *Its own*: that of its kind, of the surface under it, or the constant `line.color`.
//! And the *tint layer* over that: light, the light from behind, depth, tint, in this order. Own colours depend on the
//! kind, tint layers on the place alone, so both are decided once at a place and combined by whoever draws there
//! ([`npr_core::line_color::line_color`]). Colours mix in linear light; rows of stops were mixed in OKLab before
//! (`npr_stylesheet::hue_row`).
//!
//! Frames decide the tint layer at the pixels of the mask that lines run through, hulls and grazing surfaces at their
//! own pixel, drawings as curves at every point of a stroke. All of them use [`LineScene`].

use npr_core::color::{linear_rgba, srgb_from_linear, unpack_rgba8};
use npr_core::geometry::{NONE, Part, PosedVertex, Triangle, Vertex};
use npr_core::line_color::{LineTint, Tint, line_color};
use npr_core::line_kind::Kind;
use npr_core::outline::MASK_KINDS;
use npr_core::raster::ID_MASK;
use npr_core::surface::{blend2, dot, weights_at};
use npr_core::texture::{self, HEADER_WORDS};
use npr_core::window::{View, Window};
use rayon::prelude::*;

use crate::backdrop::Rules;
use crate::compose::{Compose, Layers};
use crate::corners::Corners;
use crate::gloss::{back_light, in_world};
use crate::lighting::Lights;
use crate::surface_color::footprint;

pub use crate::surface_color::strengthened;

/// Colours of a row, from one end to the other.
pub const HUES: usize = 256;

/// Width over which the surface's texture is averaged under a line, in pixels of the mask: less makes lines speckled.
pub const LINE_BLUR_PX: f32 = 2.0;

/// What all lines of a view share.
#[derive(Debug, Clone, Copy)]
pub struct LineScene<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The lights of the scene; shadows play no part.
    pub lights: &'a Lights,
    /// The camera's axes in the world: to the right, up, and towards the eye.
    pub axes_world: [[f32; 3]; 3],
    /// Middle of the model.
    pub center_world: [f32; 3],
    /// The texture store.
    pub texels: &'a [u32],
}

/// The part of a line's colour that depends on its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decided {
    /// The tint layer over the line's own colour, linear light, straight alpha.
    pub tint_layer: [f32; 4],
    /// Factor on the line's opacity, 0..1.
    pub opacity: f32,
}

impl Decided {
    /// The tint as lines look it up, over a surface's colour `own` in linear light.
    pub fn tint(&self, own: [f32; 3]) -> Tint {
        let [r, g, b] = own.map(srgb_from_linear);
        let [tint_layer_r, tint_layer_g, tint_layer_b, tint_layer_a] = self.tint_layer;
        let tint_layer = [tint_layer_r, tint_layer_g, tint_layer_b].map(srgb_from_linear);
        Tint {
            own: [r, g, b, self.opacity],
            tint_layer: [tint_layer[0], tint_layer[1], tint_layer[2], tint_layer_a],
        }
    }
}

/// A straight-alpha colour laid over another one, both in linear light.
fn laid(top: [f32; 4], below: [f32; 4]) -> [f32; 4] {
    if top[3] <= 0.0 {
        return below;
    }
    let left = below[3] * (1.0 - top[3]);
    let alpha = top[3] + left;
    let mix = |i: usize| (top[i] * top[3] + below[i] * left) / alpha;
    [mix(0), mix(1), mix(2), alpha]
}

impl LineScene<'_> {
    /// Decides the tint of a part's lines at a place in the world whose surface faces along the unit vector `normal`.
    /// O(lights).
    pub fn decide(&self, part: &Part, world: [f32; 3], normal: [f32; 3]) -> Decided {
        // Lay the colour of the light over the line, and find its opacity.
        let flags = part.line_flags;
        let mut tint_layer = [0.0; 4];
        let mut opacity = 1.0;
        if flags & (Part::LINE_LIGHT | Part::LINE_OPACITY) != 0 {
            let x = self.lights.coordinate_at(world, normal, 0).0;
            if flags & Part::LINE_LIGHT != 0 {
                tint_layer = laid(self.hue(part.line_light_row, x), tint_layer);
            }
            let [dark, lit] = part.line_opacity;
            opacity = dark + (lit - dark) * x;
        }

        // Lay the light from behind over it.
        if flags & Part::LINE_RIM != 0 {
            let [r, g, b, strength] = part.back_color;
            let [from, to, _, _] = part.back;
            let behind = in_world(&self.axes_world, part.back_direction);
            let rim = back_light(normal, behind, from, to) * strength * part.line_rim;
            tint_layer = laid([r, g, b, rim.clamp(0.0, 1.0)], tint_layer);
        }

        // Lay the colour of the depth over it, then the tint.
        if flags & Part::LINE_DEPTH != 0 {
            tint_layer = laid(
                self.hue(part.line_depth_row, self.depth_share(part, world)),
                tint_layer,
            );
        }
        if flags & Part::LINE_TINT != 0 {
            tint_layer = laid(linear_rgba(unpack_rgba8(part.line_tint)), tint_layer);
        }
        Decided {
            tint_layer,
            opacity,
        }
    }

    /// How far along a part's row over depth a place lies, 0..1.
    fn depth_share(&self, part: &Part, world: [f32; 3]) -> f32 {
        let from = if part.line_flags & Part::LINE_FROM_MIDDLE != 0 {
            self.center_world
        } else {
            self.view.eye_world
        };
        let offset: [f32; 3] = std::array::from_fn(|i| world[i] - from[i]);
        let depth = dot(offset, self.view.forward_world);
        ((depth - part.line_depth[0]) * part.line_depth[1]).clamp(0.0, 1.0)
    }

    /// The colour of a row at a share of its length, linear light, straight alpha.
    pub fn hue(&self, row: u32, share: f32) -> [f32; 4] {
        let place = share.clamp(0.0, 1.0) * (HUES - 1) as f32;
        let below = (place as u32).min(HUES as u32 - 2);
        let first = (row + HEADER_WORDS + below) as usize;
        let [low, high] =
            [0, 1].map(|i| texture::linear_texel(self.texels, self.texels[first + i]));
        std::array::from_fn(|i| low[i] + (high[i] - low[i]) * (place - below as f32))
    }

    /// Factor on the width of a part's lines at a place in the world.
    pub fn width_at(&self, part: &Part, world: [f32; 3], normal: [f32; 3]) -> f32 {
        if part.line_flags & Part::LINE_WIDTH == 0 {
            return 1.0;
        }
        let x = self.lights.coordinate_at(world, normal, 0).0;
        let [dark, lit] = part.line_width;
        dark + (lit - dark) * x
    }

    /// Colour of a line at a place, sRGB with straight alpha: own colour and tint in one call, for drawings as curves.
    ///
    /// `own` returns the colour of the surface there times the part's factor, in linear light; it is only called if the
    /// part asks for it.
    pub fn color_at(
        &self,
        part: &Part,
        kind: Kind,
        own: [f32; 3],
        world: [f32; 3],
        normal: [f32; 3],
    ) -> [f32; 4] {
        if part.line_flags & Part::LINE_PLACED == 0 {
            return line_color(part, kind, None);
        }
        let tint = self.decide(part, world, normal).tint(own);
        line_color(part, kind, Some(tint))
    }
}

/// The inputs from which the colours of lines are decided, pixel by pixel of a mask.
#[derive(Debug, Clone, Copy)]
pub struct Deciding<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The pixel grid of the mask.
    pub window: &'a Window,
    /// Settings.
    pub compose: &'a Compose,
    /// What surfaces are lit by.
    pub lights: &'a Lights,
    /// Triangle numbers on the mask's grid.
    pub ids: &'a [u32],
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
    /// The mask.
    pub mask: &'a [u32],
}

/// Decides the tint of lines at every pixel of the mask on or beside a line; all others, and those of parts without
/// tints, stay empty: the twin of `line.color_mask`.
///
/// O(mask pixels + lights * line pixels), parallel over rows.
pub fn decide(on: &Deciding<'_>, tints: &mut [LineTint]) {
    let layers = on.layers();
    let width = on.window.size[0] as usize;
    tints
        .par_chunks_mut(width)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, tint) in row.iter_mut().enumerate() {
                *tint = on
                    .tint_at(&layers, x as u32, y as u32)
                    .unwrap_or(LineTint::NONE);
            }
        });
}

impl<'a> Deciding<'a> {
    /// The inputs as layers of a picture, by which the colours of surfaces are found.
    fn layers(&self) -> Layers<'a> {
        Layers {
            ids: self.ids,
            posed: self.posed,
            vertices: self.vertices,
            triangles: self.triangles,
            parts: self.parts,
            texels: self.texels,
            ..Layers::empty(
                self.view,
                self.window,
                self.compose,
                self.lights,
                &Rules::NONE,
            )
        }
    }

    fn tint_at(&self, layers: &Layers<'_>, x: u32, y: u32) -> Option<LineTint> {
        // Leave out pixels without lines, without a surface, and of parts that ask for nothing.
        if !self.is_near_line([x, y]) {
            return None;
        }
        let id = self.ids[(y * self.window.size[0] + x) as usize] & ID_MASK;
        if id == 0 {
            return None;
        }
        let triangle = &self.triangles[(id - 1) as usize];
        let part = &self.parts[triangle.part as usize];
        if part.line_flags == 0 {
            return None;
        }

        // Decide the colour of lines on the surface there.
        let corners = layers.corners_of(triangle);
        let place = LinePoint {
            px: self.window.frame_at(x, y),
            step_px: self.window.frame_step.map(|step| step * LINE_BLUR_PX),
            is_hull: false,
        };
        Some(
            layers
                .line_tint(triangle, part, &corners, &place)
                .packed(triangle.part),
        )
    }

    /// Whether any of the 3x3 pixels around one is set in the mask.
    fn is_near_line(&self, [x, y]: [u32; 2]) -> bool {
        let [width, height] = self.window.size;
        (y.saturating_sub(1)..=(y + 1).min(height - 1)).any(|y| {
            let left = (y * width + x.saturating_sub(1)) as usize;
            let right = (y * width + (x + 1).min(width - 1)) as usize;
            self.mask[left..=right]
                .iter()
                .any(|found| found & MASK_KINDS != 0)
        })
    }
}

/// Position of a line in the frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinePoint {
    /// Frame pixels.
    pub px: [f32; 2],
    /// Size of its footprint along both axes, in frame pixels.
    pub step_px: [f32; 2],
    /// Whether the line lies on a hull beside its triangle; then the nearest point of the triangle counts.
    pub is_hull: bool,
}

impl LinePoint {
    /// Weights of the triangle's corners at the position, moved by `dx` and `dy` steps.
    pub(crate) fn weights(&self, view: &View, corners: &Corners<'_>, dx: f32, dy: f32) -> [f32; 3] {
        let px = [
            self.px[0] + dx * self.step_px[0],
            self.px[1] + dy * self.step_px[1],
        ];
        let weights = weights_at(corners.clip, view.ndc_at(px));
        if !self.is_hull {
            return weights;
        }
        // Beside a face seen edge-on, weights are far too large or NaN.
        let held = weights.map(|weight| if weight > 0.0 { weight.min(1e3) } else { 0.0 });
        let sum = held[0] + held[1] + held[2];
        if sum <= 0.0 {
            return [1.0, 0.0, 0.0];
        }
        held.map(|weight| weight / sum)
    }
}

impl Layers<'_> {
    /// The inputs that all lines of this view share.
    pub(crate) fn line_scene(&self) -> LineScene<'_> {
        LineScene {
            view: self.view,
            lights: self.lights,
            axes_world: self.compose.axes(),
            center_world: self.compose.center_world,
            texels: self.texels,
        }
    }

    /// The tint of lines on a triangle at a place.
    pub(crate) fn line_tint(
        &self,
        triangle: &Triangle,
        part: &Part,
        corners: &Corners<'_>,
        place: &LinePoint,
    ) -> Tint {
        let weights = place.weights(self.view, corners, 0.0, 0.0);
        // Hulls show the backs of faces, but their outline is at the front.
        let side = if place.is_hull { corners.side } else { 1.0 };
        let normal = corners.normal(weights).map(|v| v * side);
        let decided = self
            .line_scene()
            .decide(part, corners.world(weights), normal);
        decided.tint(self.line_own(triangle, part, corners, place))
    }

    /// Colour of the surface for its lines, linear light; black if the part does not ask for it.
    fn line_own(
        &self,
        triangle: &Triangle,
        part: &Part,
        corners: &Corners<'_>,
        place: &LinePoint,
    ) -> [f32; 3] {
        // Choose the picture that the colour comes from, if any.
        if part.line_flags & Part::LINE_SOURCES == 0 {
            return [0.0; 3];
        }
        let weights = place.weights(self.view, corners, 0.0, 0.0);
        let vertices = triangle.corners.map(|v| &self.vertices[v as usize]);
        let shows_surface = part.line_flags & Part::LINE_SURFACE != 0;
        let is_plain = part.flags & Part::PLAIN != 0;
        let start = if part.line_flags & Part::LINE_TEXTURE != 0 {
            part.line_texture
        } else if shows_surface && !is_plain {
            part.texture
        } else {
            NONE
        };

        // Look it up, as wide as the line is.
        let mut color = [1.0; 3];
        if start != NONE {
            let around = [
                weights,
                place.weights(self.view, corners, 1.0, 0.0),
                place.weights(self.view, corners, 0.0, 1.0),
            ];
            let uvs = around.map(|weights| blend2(weights, vertices.map(|v| v.uv)));
            let [r, g, b, _] = texture::sample(self.texels, start, uvs[0], footprint(uvs));
            color = [r, g, b];
        }

        // Tint it by the colours of the vertices and by the material.
        if part.line_flags & Part::LINE_TEXTURE == 0 && !(shows_surface && is_plain) {
            let tint = self.tint(weights, vertices);
            color = std::array::from_fn(|i| color[i] * tint[i]);
        }
        if shows_surface {
            let base = part.base_color;
            let color_here = std::array::from_fn(|i| color[i] * base[i]);
            color = self.strengthened(color_here);
        }
        color.map(|light| light * part.line_factor)
    }

    /// Linear light of a line that a hull or a grazing surface shows at a place.
    pub(crate) fn line_light(
        &self,
        triangle: &Triangle,
        part: &Part,
        corners: &Corners<'_>,
        place: &LinePoint,
    ) -> [f32; 3] {
        let color = if part.line_flags & Part::LINE_PLACED == 0 {
            line_color(part, Kind::Contour, None)
        } else {
            let tint = self.line_tint(triangle, part, corners, place);
            line_color(part, Kind::Contour, Some(tint))
        };
        let [r, g, b, _] = self.linear_of(color);
        [r, g, b]
    }
}

/// Scales half widths by the light that falls on the vertices, and leaves all else: the twin of `line.light_widths`.
///
/// `lit` gets every vertex of `posed`. O(vertices * lights), parallel.
pub fn light_widths(
    scene: &LineScene<'_>,
    parts: &[Part],
    vertices: &[Vertex],
    posed: &[PosedVertex],
    lit: &mut [PosedVertex],
) {
    let places = posed.par_iter().zip(vertices).zip(lit).with_min_len(1024);
    places.for_each(|((posed, vertex), lit)| {
        let factor = scene.width_at(&parts[vertex.part as usize], posed.world, posed.normal);
        *lit = PosedVertex {
            half_width: posed.half_width * factor,
            ..*posed
        };
    });
}
