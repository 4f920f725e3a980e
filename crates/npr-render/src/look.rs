//! A style applied to a model: the numbers that passes read.

use crate::brushes::Brushes;
use crate::calm::{calmed, calming};
use crate::error::RenderError;
use crate::hatching::{FrameScale, Inked, add_ink};
use crate::line_colors::add_line_colors;
use crate::manners::StrokeManners;
use crate::model::Model;
use crate::options::RendererOptions;
use crate::part_info::PartInfo;
use crate::pictures::{Pictures, add_tone_rows};
use crate::sky::SkyMaps;
use crate::toon::{LineMeasure, add_toons, has_toon_widths_alone, outline_share};
use glam::Vec3;
use npr_core::camera::Camera;
use npr_core::color::{pack_rgba8, srgb_from_linear};
use npr_core::crease::{CreaseFrom, Creases};
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::{NONE, Part, Vertex};
use npr_core::line_kind::KindSet;
use npr_core::math;
use npr_core::outline::{Outline, width_of_curvature};
use npr_core::texture::{self, TextureStore, Wrap};
use npr_core::window::View;
use npr_gpu::changes::Changes;
use npr_mesh::curvature::tightest;
use npr_style::compose::Compose;
use npr_style::cut_tone::cut_reach_px;
use npr_style::even_tones::{has_steps, reach_px};
use npr_style::ramp::Level;
use npr_stylesheet::{
    Background, Edge, Highlight, HighlightModel, Look, OutlineMethod, ShadeMode, Style, Unit,
    Width, WidthSource,
};
use std::sync::Arc;

/// Everything a style decides before the camera is known.
#[derive(Debug)]
pub(crate) struct StyledModel {
    pub vertices: Vec<Vertex>,
    /// What calms the normals of the vertices; empty where the style leaves them as they are.
    pub calming: Arc<Vec<Vec3>>,
    pub parts: Vec<Part>,
    /// Number of the part that stands for smoke, behind all others, where a pen or a picture finishes smoke.
    pub smoke_part: Option<u32>,
    /// Stroke charts, and what was done in another way than asked.
    pub inked: Inked,
    pub textures: TextureStore,
    /// Header of the background picture, or [`NONE`].
    pub background_texture: u32,
    /// What hides the sky, where the style asks for it.
    pub sky: Option<SkyMaps>,
    /// What strokes are drawn with.
    pub brushes: Brushes,
    /// How strokes are drawn.
    pub manners: StrokeManners,
}

impl StyledModel {
    /// Strokes are found on `stroked`, the parts of a line model of the scene; on none without one.
    pub fn new(
        model: &Model,
        style: &Style,
        options: &RendererOptions,
        stroked: &[PartInfo],
    ) -> Result<Self, RenderError> {
        // Store the background picture behind the model's textures.
        let pictures = Pictures::new(style, &options.pictures)?;
        let mut textures = model.textures.clone();
        let background = options
            .background_image
            .as_ref()
            .filter(|_| matches!(style.background, Background::Image(_)));
        let background_texture = background
            .and_then(|image| textures.add(image.size, &image.rgba, [Wrap::Clamp; 2]))
            .unwrap_or(NONE);

        // Resolve the style for every part, with its tones and colours of lines.
        let mut parts: Vec<Part> = model.parts.iter().map(|info| part(info, style)).collect();
        let world_px = options.size[1] as f32 * 0.5 / model.radius();
        let frame = FrameScale {
            height_px: options.size[1],
            dpi: options.dpi,
            spots_per_px: spots_per_px(style, [options.size[1] as f32, options.dpi, world_px]),
            world_px,
        };
        add_tone_rows(model, style, &pictures, &mut parts, &mut textures)?;
        let height = options.size[1];
        let measure = LineMeasure {
            height_px: height as f32,
            base_width: outline(style, model.radius(), height, options.dpi, 0).base_width,
        };
        add_toons(model, style, measure, &mut parts, &mut textures);
        add_line_colors(
            &model.parts,
            style,
            &options.pictures,
            model.radius(),
            &mut parts,
            &mut textures,
        )?;

        // Add the part that stands for smoke, and the ink of all parts.
        let mut smoke = match options.smoke.is_some() && style.smoke.is_finished_late() {
            true => Some(pictures.smoke_part(&style.smoke, &mut textures)?),
            false => None,
        };
        let mut inked = add_ink(
            model,
            style,
            &pictures,
            &frame,
            &mut parts,
            smoke.as_mut(),
            &mut textures,
        )?;
        inked.notices.extend(style.line_paint_notices());
        let has_strokes = |look: &Look<'_>| look.line_method.source().is_some();
        let laid = (frame.spots_per_px, has_strokes as fn(&Look<'_>) -> bool);
        let brushes = Brushes::new(stroked, style, &pictures, laid, &mut textures)?;
        if parts.is_empty() {
            parts.push(Part::default());
        }

        // Draw what hides the sky.
        let sky = SkyMaps::new(model, style, &parts, &mut textures);
        if sky.is_none() && style.light.hidden_sky().is_some() && !model.triangles.is_empty() {
            let notice = "nothing hides the sky: the textures leave no room for its shadows";
            inked.notices.push(notice.to_owned());
        }

        // Put the part that stands for smoke behind all others.
        let smoke_part = smoke.is_some().then_some(parts.len() as u32);
        parts.extend(smoke);
        let calming = match style.shade.calm > 0.0 {
            true => calming(model, style.shade.calm),
            false => Arc::default(),
        };
        let pens = inked.pens(model, &mut parts);
        let notice = options.surfaces.apply(&mut parts, &mut textures);
        inked.notices.extend(notice);

        // Even the tones that are left.
        let least_px = style
            .shade
            .least
            .to_px(height as f32, options.dpi, world_px);
        let surfaces = parts.len() - usize::from(smoke_part.is_some());
        for part in parts[..surfaces].iter_mut().filter(|part| has_steps(part)) {
            part.tone_reach_px = reach_px(least_px);
        }

        // Cut out the hatch of others.
        for part in &mut parts[..surfaces] {
            if part.tone_reach_px != 0.0 {
                part.flags &= !Part::CUT;
            } else if part.flags & Part::CUT != 0 {
                part.tone_reach_px = cut_reach_px(part);
            }
        }
        Ok(Self {
            vertices: styled_vertices(model, style, options, (&pens, &calming)),
            calming,
            parts,
            smoke_part,
            inked,
            textures,
            background_texture,
            sky,
            brushes,
            manners: StrokeManners::new(stroked, style),
        })
    }

    /// Takes over where the vertices of a model are, and their normals; widths, colours and charts stay. Returns which
    /// vertices that changed.
    pub fn follow(&mut self, model: &Model) -> Changes {
        let mut changes = Changes::default();
        for (i, (vertex, moved)) in self.vertices.iter_mut().zip(&model.vertices).enumerate() {
            let calming = self.calming.get(i).copied().unwrap_or_default();
            let followed = Vertex {
                normal: calmed(moved.normal, calming),
                width: vertex.width,
                color: vertex.color,
                pen: vertex.pen,
                ..*moved
            };
            if bytemuck::bytes_of(&followed) != bytemuck::bytes_of(vertex) {
                changes.add(i);
                *vertex = followed;
            }
        }
        changes
    }
}

/// A part as the style's rules for its names make it.
pub(crate) fn part(info: &PartInfo, style: &Style) -> Part {
    let look = info.look(style);

    // Choose the colours of the surface and of its lines.
    let shade = &style.shade;
    let paper = shade.mode == ShadeMode::Paper;
    let own_color = look.shade_color.map(|color| color.linear());
    let base_color = own_color.unwrap_or(if paper {
        shade.paper.linear()
    } else {
        info.base_color
    });
    let bit = |bit: u32, when: bool| if when { bit } else { 0 };
    let unlit = shade.mode == ShadeMode::Flat || (info.unlit && !paper);
    let mut line_color = look.line_color.srgb();
    line_color[3] *= style.line.opacity;

    // Fill the part in, as a beam where the style makes it one.
    let mut part = Part {
        base_color: [
            base_color[0],
            base_color[1],
            base_color[2],
            info.base_color[3],
        ],
        line_color,
        object: info.object,
        material: info.material,
        component: info.component,
        texture: if shade.use_textures && own_color.is_none() {
            info.texture
        } else {
            NONE
        },
        flags: bit(Part::DOUBLE_SIDED, info.double_sided)
            | bit(Part::CUTOUT, info.alpha_cutoff.is_some())
            | bit(outline_flags(look.line_method), look.line_on)
            | bit(Part::FOLDS, creases(style).from == CreaseFrom::Faces)
            | bit(Part::UNLIT, unlit)
            | bit(Part::PLAIN, paper)
            | highlight_flags(&look.highlight),
        width_factor: look.width_factor,
        facing_threshold: math::sin(look.angle_threshold_deg.to_radians()),
        alpha_cutoff: info.alpha_cutoff.unwrap_or(0.0),
        softness: shade.softness,
        paint_color: pack_linear(own_color.unwrap_or(info.base_color)),
        ramp: ramp(&look),
        ..highlighted(&look.highlight)
    };
    if let Some(beam) = &look.beam {
        beam.apply_to(&mut part);
    }
    part
}

/// A colour in linear light as sRGB bytes.
fn pack_linear([r, g, b, a]: [f32; 4]) -> u32 {
    let [r, g, b] = [r, g, b].map(srgb_from_linear);
    pack_rgba8([r, g, b, a])
}

/// A part with highlights and nothing else.
fn highlighted(highlight: &Highlight) -> Part {
    let turn = highlight.turn_deg.to_radians();
    let [split_u, split_v] = highlight.split;
    let back = Vec3::from(highlight.back.direction).normalize_or(Vec3::NEG_Z);
    let streak = highlight.streak.angle_deg.to_radians();
    Part {
        highlight_color: highlight.color.linear(),
        back_color: highlight.back.color.linear(),
        highlight: [
            highlight.exponent,
            highlight.threshold,
            highlight.gradient,
            highlight.streak.offset,
        ],
        highlight_shape: [
            highlight.shift[0],
            highlight.shift[1],
            highlight.stretch,
            highlight.square,
        ],
        highlight_turn: [math::cos(turn), math::sin(turn), split_u, split_v],
        back: [
            highlight.back.from,
            highlight.back.to,
            highlight.streak.width,
            highlight.streak.facing,
        ],
        back_direction: back.to_array(),
        streak_across: [-math::sin(streak), math::cos(streak)],
        ..Part::default()
    }
}

/// The bits of a part whose outline is drawn by a method.
fn outline_flags(method: OutlineMethod) -> u32 {
    match method {
        OutlineMethod::Off | OutlineMethod::Strokes | OutlineMethod::Potrace => 0,
        OutlineMethod::Hull => Part::HULL,
        OutlineMethod::FilterHull => Part::LINES | Part::HULL,
        OutlineMethod::Angle => Part::ANGLE,
        _ => Part::LINES,
    }
}

/// The bits of a part that has these highlights.
fn highlight_flags(highlight: &Highlight) -> u32 {
    let bit = |bit: u32, when: bool| if when { bit } else { 0 };
    bit(Part::CRISP, highlight.edge == Edge::Crisp)
        | bit(Part::SOFT, highlight.edge == Edge::Soft)
        | bit(Part::PHONG, highlight.model == HighlightModel::Phong)
        | bit(Part::BACK_LIGHT, highlight.back.on)
        | bit(Part::STREAK, highlight.streak.on)
}

/// The tones of a look, as rows of light and start.
fn ramp(look: &Look<'_>) -> [[f32; 4]; 8] {
    let mut rows = [[1.0, 1.0, 1.0, Level::UNUSED]; 8];
    for (row, stop) in rows.iter_mut().zip(look.ramp) {
        let level = stop.level();
        *row = [level.light[0], level.light[1], level.light[2], level.at];
    }
    rows
}

/// Vertices with the width that the style's source gives them, their colour where the style shows it, and what the pen
/// does there.
fn styled_vertices(
    model: &Model,
    style: &Style,
    options: &RendererOptions,
    (pens, calming): (&[u32], &[Vec3]),
) -> Vec<Vertex> {
    let width = VertexWidth::new(model, style, options);
    let shows_colors = style.shade.use_vertex_colors;
    (0..model.vertices.len())
        .map(|i| {
            let vertex = &model.vertices[i];
            let color = if shows_colors {
                vertex.color
            } else {
                vertex.color | 0x00ff_ffff
            };
            Vertex {
                width: width.at(i),
                color,
                pen: pens.get(i).copied().unwrap_or_default(),
                normal: calmed(vertex.normal, calming.get(i).copied().unwrap_or_default()),
                ..*vertex
            }
        })
        .collect()
}

/// Where the width factor of a vertex comes from.
struct VertexWidth<'a> {
    model: &'a Model,
    style: &'a Style,
    /// The width picture, with where it starts.
    image: Option<(TextureStore, u32)>,
}

impl<'a> VertexWidth<'a> {
    fn new(model: &'a Model, style: &'a Style, options: &RendererOptions) -> Self {
        let named = style.line.width.picture();
        let given = named.and_then(|name| options.pictures.get(name));
        let image = given.and_then(|image| {
            let mut store = TextureStore::new();
            let start = store.add(image.size, &image.rgba, [Wrap::Repeat; 2])?;
            Some((store, start))
        });
        Self {
            model,
            style,
            image,
        }
    }

    /// Width factor 0..1 of vertex `i`, 1 where the source is missing; for projected curvature the tightest there is.
    fn at(&self, i: usize) -> f32 {
        let (vertex, width) = (&self.model.vertices[i], &self.style.line.width);
        let hinted = outline_share(self.model, self.style, i);
        match width.source {
            WidthSource::Constant => hinted.unwrap_or(1.0),
            WidthSource::ProjectedCurvature => vertex.width,
            _ if hinted.is_some() => hinted.unwrap_or(1.0),
            WidthSource::Curvature => width_of_curvature(tightest(vertex.curvatures), width.gain),
            WidthSource::VertexColor => {
                f32::from(vertex.color.to_le_bytes()[width.channel.index()]) / 255.0
            }
            WidthSource::Texture => self.image.as_ref().map_or(1.0, |(store, start)| {
                let linear = texture::sample(store.words(), *start, vertex.uv, 0.0);
                srgb_from_linear((linear[0] + linear[1] + linear[2]) / 3.0)
            }),
            WidthSource::ControlPoints => {
                let position = self.model.posed_point(vertex, &self.model.influences[i]);
                share_at(width, position.to_array())
            }
        }
    }
}

/// The share of 0..1 that the control points of a width give at a place in the world.
pub(crate) fn share_at(width: &Width, position: [f32; 3]) -> f32 {
    (width.factor_at(position) - width.min) / (width.max - width.min).max(1e-6)
}

/// The largest half width that any line may have, in frame pixels.
pub(crate) fn largest_half_width(style: &Style, parts: &[Part], base_px: f32) -> f32 {
    let factor = parts
        .iter()
        .map(|part| match part.line_flags & Part::LINE_WIDTH {
            0 => part.width_factor,
            _ => part.width_factor * part.line_width[0].max(part.line_width[1]),
        })
        .fold(1.0, f32::max);
    base_px * style.line.width.max * factor * 0.5
}

/// Fewest hills of the paper to a pixel, and most: finer ones would be grey.
const SPOTS_PER_PX: [f32; 2] = [1e-3, 1.0];

/// Hills of a style's paper per pixel, where lengths are resolved by the height, dots per inch, and pixels of a unit.
pub(crate) fn spots_per_px(style: &Style, [height, dpi, world]: [f32; 3]) -> f32 {
    let [fewest, most] = SPOTS_PER_PX;
    (1.0 / style.paper.size.to_px(height, dpi, world))
        .max(fewest)
        .min(most)
}

/// Thinnest base width in frame pixels of lengths that follow the frame: thinner ones would fade in small pictures.
const THINNEST_PX: f32 = 1.0;

/// Line width at factor 1, in frame pixels, where a world unit is `world_px` pixels.
pub(crate) fn base_px(style: &Style, height_px: u32, dpi: f32, world_px: f32) -> f32 {
    let base = style.line.scaled(style.line.width.base);
    let px = base.to_px(height_px as f32, dpi, world_px);
    let follows_frame = matches!(base.unit, Unit::RefPx | Unit::FrameHeight);
    if follows_frame && base.value > 0.0 {
        px.max(THINNEST_PX)
    } else {
        px
    }
}

/// The outline settings of a style.
pub(crate) fn outline(
    style: &Style,
    radius_world: f32,
    height_px: u32,
    dpi: f32,
    reach_px: u32,
) -> Outline {
    let (line, detect) = (&style.line, &style.detect);
    let bit = |bit: u32, when: bool| if when { bit } else { 0 };
    let in_world = line.width.base.unit == Unit::World && !has_toon_widths_alone(style);
    let published = line.method == OutlineMethod::Okuya;
    let own_width = if in_world {
        line.scaled(line.width.base).value
    } else {
        base_px(style, height_px, dpi, 0.0)
    };
    Outline {
        base_width: match has_toon_widths_alone(style) {
            true => 1.0,
            false => own_width,
        },
        min_factor: line.width.min,
        max_factor: line.width.max,
        gain: line.width.gain,
        radius_world,
        crease_cos: creases(style).cos,
        depth_threshold: detect.depth_threshold(),
        normal_cos: math::cos(normal_threshold_deg(style).to_radians()),
        kinds: match line.method {
            OutlineMethod::Okuya => EdgeFlags::FACING.0,
            OutlineMethod::Edges => KindSet::CONTOUR | KindSet::BOUNDARY,
            _ => line.kinds.set().bits() & KindSet::EDGES,
        },
        detects: bit(Outline::DEPTH, detect.depth.on)
            | bit(Outline::NORMAL, detect.normal.on)
            | bit(Outline::OBJECT_ID, detect.object.on)
            | bit(Outline::MATERIAL_ID, detect.material.on)
            | bit(Outline::PLANE_DEPTH, detect.plane_depth)
            | bit(Outline::PIECE, line.kinds.intersection && !published),
        flags: bit(Outline::WORLD_WIDTH, in_world)
            | bit(
                Outline::PROJECTED_CURVATURE,
                line.width.source == WidthSource::ProjectedCurvature,
            )
            | bit(Outline::PUBLISHED, published)
            | bit(Outline::UNMASKED, line.method == OutlineMethod::Edges),
        reach_px,
    }
}

/// Which edges are creases, for frames and drawings alike.
pub(crate) fn creases(style: &Style) -> Creases {
    let from = match style.line.crease_from {
        npr_stylesheet::CreaseFrom::Normals => CreaseFrom::Normals,
        npr_stylesheet::CreaseFrom::Faces => CreaseFrom::Faces,
    };
    Creases::over(style.line.crease_angle_deg.to_radians(), from)
}

/// Share of the crease angle from which a mask marks pixels where edges decide what is a crease: pixels beside a crease
/// see less of its turn than the edge itself.
const MASK_SHARE: f32 = 0.875;

/// Angle between normals of neighbouring pixels that makes a line, in degrees: the style's own, else that of creases.
/// Where edges decide what is a crease, the mask looks for a little less, so that it loses none.
fn normal_threshold_deg(style: &Style) -> f32 {
    let crease = style.line.crease_angle_deg;
    let of_creases = match style.line.method {
        OutlineMethod::Shape => MASK_SHARE * crease,
        _ => crease,
    };
    style.detect.normal.threshold_deg.unwrap_or(of_creases)
}

/// The settings of the last pass.
pub(crate) fn compose(
    style: &Style,
    camera: &Camera,
    model: &Model,
    background_texture: u32,
) -> Compose {
    let mut line_color = style.line.color.srgb();
    line_color[3] *= style.line.opacity;
    let [right_world, up_world, near_world] = camera.axes();
    let (min, max) = model.bounds();
    let background = match style.background {
        Background::Color(color) => color.linear(),
        Background::Transparent => [0.0; 4],
        Background::Image(_) => [1.0; 4],
    };
    Compose {
        line_color,
        background_texture,
        flags: 0,
        saturation: style.shade.saturation,
        samples: if style.antialias.samples > 1 { 2 } else { 1 },
        right_world,
        up_world,
        near_world,
        radius: model.radius(),
        angle_softness: style.line.angle_softness,
        center_world: ((Vec3::from(min) + Vec3::from(max)) * 0.5).to_array(),
        ..Compose::before(background)
    }
}

/// Frame pixels per world unit at the depth of the part of the model nearest to the eye.
pub(crate) fn nearest_world_px(view: &View, camera: &Camera, model: &Model) -> f32 {
    let (min, max) = model.bounds();
    let center = (Vec3::from(min) + Vec3::from(max)) * 0.5;
    let distance = (center - Vec3::from(camera.eye)).dot(Vec3::from(view.forward_world));
    1.0 / view.pixel_before_eye(distance - model.radius())
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_scene::testing::limb;

    /// A morph moves a limb, places or normals of all its vertices, and the flag beside it stays.
    #[test]
    fn a_pose_changes_the_vertices_that_morphs_move_alone() {
        let rest = limb(true);
        let mut model = Model::new(&rest).expect("a model");
        let options = RendererOptions::new([64, 64]);
        let styled = StyledModel::new(&model, &Style::default(), &options, &[]);
        let mut styled = styled.expect("a style");
        let before = styled.vertices.clone();

        let mut scene = rest.clone();
        let pose = rest.pose_at(&rest.clips[1], 1.0);
        scene.set_pose(&pose).expect("in range");
        assert!(model.pose(&scene).expect("the same scene").vertices);
        let changes = styled.follow(&model);
        let handed: Vec<usize> = changes.ranges().iter().cloned().flatten().collect();
        let of_limb = before.len() - 4;
        assert_eq!(handed, (0..of_limb).collect::<Vec<_>>());
        let is_changed = |i: usize| before[i].position != styled.vertices[i].position;
        assert!((0..of_limb).any(is_changed) && !(of_limb..before.len()).any(is_changed));

        // Once more there is nothing to hand over.
        assert!(styled.follow(&model).ranges().is_empty());
    }
}
