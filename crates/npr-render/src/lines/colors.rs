//! Colours along strokes: each point of a stroke is coloured as frames colour the pixels of their mask.

use super::texture_map::TextureMap;
use crate::error::RenderError;
use crate::file_light::FileLight;
use crate::light::ChosenLights;
use crate::line_colors::add_line_colors;
use crate::look;
use crate::options::Picture;
use crate::part_info::PartInfo;
use crate::pictures::Pictures;
use crate::placement::Bounds;
use glam::{Vec2, Vec3};
use npr_core::camera::Camera;
use npr_core::color::{linear_rgba, srgb_from_linear, unpack_rgba8};
use npr_core::geometry::{NONE, Part};
use npr_core::surface::unit_or_z;
use npr_core::texture::{self, TextureStore, Wrap};
use npr_core::window::View;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_style::lighting::Lights;
use npr_style::line_color::{LINE_BLUR_PX, LineScene, strengthened};
use npr_stylesheet::Style;
use npr_vector::mesh_lines::draw::PointPaint;
use npr_vector::mesh_lines::run::RunPoint;
use npr_vector::mesh_lines::zero_set::CornerNormals;
use npr_vector::stroke::Kind;
use std::collections::BTreeMap;

/// What the colours of strokes are computed from.
#[derive(Clone, Copy)]
pub(super) struct ColorInput<'a> {
    pub shape: &'a HalfEdgeMesh,
    pub infos: &'a [PartInfo],
    /// Colour of every vertex of the shape; empty where the scene has none.
    pub vertex_colors: &'a [u32],
    /// Where textures lie, if the style looks at any.
    pub map: Option<&'a TextureMap>,
    pub lights: &'a [FileLight],
    pub pictures: &'a BTreeMap<String, Picture>,
    pub bounds: Bounds,
    pub style: &'a Style,
}

/// The colours of strokes in one view.
pub(super) struct StrokeColors<'a> {
    input: ColorInput<'a>,
    normals: &'a CornerNormals,
    /// A byte per face: 1 where the face is turned to the eye.
    front: &'a [u8],
    view: View,
    lights: Lights,
    parts: Vec<Part>,
    textures: TextureStore,
    /// Where the picture of widths starts among the textures, or [`NONE`].
    width_texture: u32,
    axes_world: [[f32; 3]; 3],
    center_world: [f32; 3],
}

/// Whether a style gives lines more than one colour and width a surface, beside what hangs on vertices.
pub(super) fn is_painted(style: &Style) -> bool {
    style.line_paint_flags() != 0 || style.line.width.picture().is_some()
}

/// Whether they look at texture coordinates.
pub(super) fn needs_map(style: &Style) -> bool {
    let by_texture = Part::LINE_SURFACE | Part::LINE_TEXTURE;
    style.line_paint_flags() & by_texture != 0 || style.line.width.picture().is_some()
}

/// Whether they hang on the light.
pub(super) fn is_lit(style: &Style) -> bool {
    let by_light = Part::LINE_LIGHT | Part::LINE_OPACITY | Part::LINE_RIM | Part::LINE_WIDTH;
    style.line_paint_flags() & by_light != 0
}

impl<'a> StrokeColors<'a> {
    /// Prepares the colours for a view of `size` pixels; `normals` and `front` are those of the shape.
    pub fn new(
        input: ColorInput<'a>,
        normals: &'a CornerNormals,
        front: &'a [u8],
        camera: &Camera,
        size: [u32; 2],
    ) -> Result<Self, RenderError> {
        let ColorInput {
            style,
            infos,
            bounds,
            ..
        } = input;

        // Settle the view and its lights.
        let view = camera.view(size, bounds);
        let lights = ChosenLights::new(style, input.lights, Vec::new(), input.pictures);
        let lights = lights.of_frame(style, bounds, None, camera, &view);

        // Resolve the style for every part, with the texture that the style shows on it.
        let mut textures = input
            .map
            .map_or_else(TextureStore::new, |map| map.textures.clone());
        let mut parts: Vec<Part> = infos.iter().map(|info| look::part(info, style)).collect();
        if let Some(map) = input.map
            && style.shade.use_textures
        {
            for (part, (info, start)) in parts.iter_mut().zip(infos.iter().zip(&map.starts)) {
                let look = info.look(style);
                part.texture = if look.shade_color.is_none() {
                    *start
                } else {
                    NONE
                };
            }
        }

        // Give the parts the colours of their lines.
        let (low, high) = (Vec3::from(bounds.0), Vec3::from(bounds.1));
        let radius = 0.5 * (high - low).length();
        add_line_colors(
            infos,
            style,
            input.pictures,
            radius,
            &mut parts,
            &mut textures,
        )?;
        let width_texture = width_texture(style, input.pictures, &mut textures)?;
        Ok(Self {
            input,
            normals,
            front,
            view,
            lights,
            parts,
            textures,
            width_texture,
            axes_world: camera.axes(),
            center_world: ((low + high) * 0.5).to_array(),
        })
    }

    /// The final colour of a line at a point of a run, and the factor on its width: the one place where strokes are
    /// coloured.
    pub fn paint_at(&self, kind: Kind, surface: u32, point: &RunPoint) -> PointPaint {
        let Some(part) = self.parts.get(surface as usize) else {
            return PointPaint {
                color: None,
                width: 1.0,
            };
        };

        // Evaluate colour and width there, as frames do at a pixel.
        let scene = LineScene {
            view: &self.view,
            lights: &self.lights,
            axes_world: self.axes_world,
            center_world: self.center_world,
            texels: self.textures.words(),
        };
        let world = point.world.as_vec3().to_array();
        let normal = self.normal_at(kind, surface, point);
        let width = scene.width_at(part, world, normal) * self.width_factor(surface, point);
        let own = self.own_at(part, surface, point);
        let color = scene.color_at(part, kind, own, world, normal);
        PointPaint {
            color: Some(color.map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)),
            width: f64::from(width),
        }
    }

    /// What the picture of widths multiplies the greatest width by at a point; 1 without one, and on lines that have no
    /// surface.
    fn width_factor(&self, surface: u32, point: &RunPoint) -> f32 {
        let width = &self.input.style.line.width;
        let texel = match self.width_texture {
            NONE => None,
            start => self.texel_at(start, surface, point),
        };
        texel.map_or(1.0, |[r, g, b]| {
            let share = srgb_from_linear((r + g + b) / 3.0);
            (width.min + (width.max - width.min) * share) / width.max.max(1e-6)
        })
    }

    /// Where a point lies in the faces that it is coloured by: the face that its line crosses, or those beside its
    /// edge.
    fn spots(&self, surface: u32, point: &RunPoint) -> impl Iterator<Item = Spot> {
        let shape = self.input.shape;
        let (vertices, shares) = point.location.place(shape, point.world);
        let shares = shares.map(|share| share as f32);

        // Take the face that the line crosses.
        let crossed = point.location.crossed_face().map(|face| Spot {
            corners: [0, 1, 2].map(|corner| 3 * face + corner),
            shares,
        });

        // Else take the faces beside the edge, each with the shares of its own half-edge.
        let sides = match crossed {
            Some(_) => &[],
            None => shape.sides(point.location.edge),
        };
        let beside = self.sides(surface, sides).map(move |side| {
            let [tail, _] = shape.ends_of_half_edge(side);
            let [low, high] = [shares[0], shares[1]];
            let runs_up = tail == vertices[0];
            Spot {
                corners: [side, HalfEdgeMesh::following(side), NONE],
                shares: if runs_up {
                    [low, high, 0.0]
                } else {
                    [high, low, 0.0]
                },
            }
        });
        crossed.into_iter().chain(beside)
    }

    /// Of half-edges those of a surface whose faces are seen; where there are none, those of the surface; else all.
    fn sides<'s>(&'s self, surface: u32, sides: &'s [u32]) -> impl Iterator<Item = u32> + 's {
        let shape = self.input.shape;
        let is_own = move |side: &u32| shape.face_surfaces[*side as usize / 3] == surface;
        let is_front = |side: &u32| self.front.get(*side as usize / 3) == Some(&1);
        let any_own = sides.iter().any(is_own);
        let any_front = sides.iter().any(|side| is_own(side) && is_front(side));
        sides
            .iter()
            .copied()
            .filter(move |side| (!any_own || is_own(side)) && (!any_front || is_front(side)))
    }

    /// Unit normal of the surface at a point, of both faces where both are seen; towards the eye where only its back
    /// is.
    fn normal_at(&self, kind: Kind, surface: u32, point: &RunPoint) -> [f32; 3] {
        let mut sum = [0.0; 3];
        for spot in self.spots(surface, point) {
            let normal = spot.mean(|corner| self.normals.normal(corner));
            // A contour ends what is seen from outside, though a smooth one may cross faces that are turned away.
            let is_back = self.front.get(spot.face() as usize) == Some(&0);
            let way = if is_back && kind != Kind::Contour {
                -1.0
            } else {
                1.0
            };
            sum = std::array::from_fn(|i| sum[i] + way * normal[i]);
        }
        // A line without a surface is lit as one that faces the eye.
        if self.input.shape.polyline_of(point.location.edge).is_some() {
            sum = self.view.to_eye(point.world.as_vec3().to_array());
        }
        unit_or_z(sum)
    }

    /// Colour of the surface for its lines, in linear light; black where the part does not ask for it.
    fn own_at(&self, part: &Part, surface: u32, point: &RunPoint) -> [f32; 3] {
        let flags = part.line_flags;
        if flags & Part::LINE_SOURCES == 0 {
            return [0.0; 3];
        }
        let color = if flags & Part::LINE_VERTEX != 0 {
            self.vertex_color_at(surface, point)
        } else if flags & Part::LINE_TEXTURE != 0 {
            self.texel_at(part.line_texture, surface, point)
                .unwrap_or(WHITE)
        } else {
            let [r, g, b, _] = part.base_color;
            let mut color = [r, g, b];
            if part.flags & Part::PLAIN == 0 {
                let (tint, texel) = (
                    self.vertex_color_at(surface, point),
                    self.texel_at(part.texture, surface, point).unwrap_or(WHITE),
                );
                color = std::array::from_fn(|i| color[i] * tint[i] * texel[i]);
            }
            strengthened(color, self.input.style.shade.saturation)
        };
        color.map(|light| light * part.line_factor)
    }

    /// Vertex colour at a point, linear light; white where pictures show none.
    fn vertex_color_at(&self, surface: u32, point: &RunPoint) -> [f32; 3] {
        let (shape, colors) = (self.input.shape, self.input.vertex_colors);
        if !self.input.style.shade.use_vertex_colors || colors.is_empty() {
            return WHITE;
        }
        let of_vertex = |vertex: u32| {
            let packed = colors.get(vertex as usize).copied().unwrap_or(u32::MAX);
            let [r, g, b, _] = linear_rgba(unpack_rgba8(packed));
            [r, g, b]
        };
        if shape.polyline_of(point.location.edge).is_some() {
            let ([low, high, _], [_, share, _]) = point.location.place(shape, point.world);
            let [low, high] = [low, high].map(|vertex| Vec3::from(of_vertex(vertex)));
            return low.lerp(high, share as f32).to_array();
        }
        let color_at = |corner: u32| of_vertex(shape.ends_of_half_edge(corner)[0]);
        let spot = self.spots(surface, point).next();
        spot.map_or(WHITE, |spot| spot.mean(color_at))
    }

    /// Linear light of a texture at a point; `None` without one, and without texture coordinates.
    fn texel_at(&self, start: u32, surface: u32, point: &RunPoint) -> Option<[f32; 3]> {
        let map = self.input.map.filter(|_| start != NONE)?;
        let spot = self.spots(surface, point).next()?;
        let face = spot.face();
        let uvs = map.corners(face)?;
        let [u, v, _] = spot.mean(|corner| {
            let [u, v] = uvs[corner as usize % 3];
            [u, v, 0.0]
        });
        // As much of the texture as frames average under a line.
        let shape = self.input.shape;
        let corners = shape.faces[face as usize].map(|vertex| shape.point(vertex).as_vec3());
        let around =
            |length: &dyn Fn(usize, usize) -> f32| length(0, 1) + length(1, 2) + length(2, 0);
        let uvs = uvs.map(Vec2::from);
        let run = around(&|a, b| uvs[b].distance(uvs[a]));
        let length = around(&|a, b| corners[b].distance(corners[a]));
        let pixel = self.view.pixel_at(point.depth as f32) * LINE_BLUR_PX;
        let blur = run / length.max(1e-30) * pixel;
        let [r, g, b, _] = texture::sample(self.textures.words(), start, [u, v], blur);
        Some([r, g, b])
    }
}

/// Puts the picture that a style's widths come from among textures; gives where it starts, or [`NONE`] without one.
fn width_texture(
    style: &Style,
    pictures: &BTreeMap<String, Picture>,
    textures: &mut TextureStore,
) -> Result<u32, RenderError> {
    let Some(name) = style.line.width.picture() else {
        return Ok(NONE);
    };
    let picture = Pictures::new(style, pictures)?;
    let picture = picture.of(name)?;
    let added = textures.add(picture.size, &picture.rgba, [Wrap::Repeat; 2]);
    Ok(added.unwrap_or(NONE))
}

/// The colour of what has none of its own.
const WHITE: [f32; 3] = [1.0; 3];

/// Where a point lies in a face.
#[derive(Debug, Clone, Copy)]
struct Spot {
    /// Half-edges that start at corners of the face; [`NONE`] for one that does not count.
    corners: [u32; 3],
    /// How much each corner counts, 1 together.
    shares: [f32; 3],
}

impl Spot {
    fn face(&self) -> u32 {
        self.corners[0] / 3
    }

    /// The mean of what lies at the corners.
    fn mean(&self, at: impl Fn(u32) -> [f32; 3]) -> [f32; 3] {
        let mut sum = [0.0; 3];
        for (corner, share) in self.corners.into_iter().zip(self.shares) {
            if share > 0.0 {
                let value = at(corner);
                sum = std::array::from_fn(|i| sum[i] + share * value[i]);
            }
        }
        sum
    }
}
