//! What a style draws with the pen on a model: ink of every part, hatch tiles, stroke charts.

use crate::model::{Model, PartInfo};
use glam::Vec3;
use npr_core::geometry::{ChartCorners, NONE, Part};
use npr_core::math;
use npr_core::texture::TextureStore;
use npr_mesh::direction_field::{Guide, PartGuide};
use npr_mesh::stroke_chart::{ChartInput, ChartSettings, stroke_chart};
use npr_style::hatch::{self, Hatch, Pattern};
use npr_style::{Follow, Ink, Mapping, Style};

/// Texels along the side of a hatch tile: 64 strokes.
const TILE_SIDE: u32 = 512;

/// Hatch tiles to one unit of UV coordinates. Of the levels of a tile the finest has strokes 1/256 apart, the coarsest 1/4.
const TILES_PER_UV: f32 = 4.0;

/// Size of a hatch tile on a surface, as a part of the object's radius. Framed as a whole, an object shows a middle level: the
/// camera may come five times nearer, and go twelve times farther, before strokes change their size.
const TILE_RADII: f32 = 0.25;

/// Most tiles of a small object to one of the largest.
const TILE_FACTOR_MAX: f32 = 256.0;

/// What ink and hatching need beside the parts.
#[derive(Debug, Default)]
pub(crate) struct Inked {
    /// Stroke charts, a triangle each; empty where no part is hatched along its surface.
    pub charts: Vec<ChartCorners>,
    /// What was done in another way than the style asks, for the user.
    pub notices: Vec<String>,
}

/// Gives `parts` their ink and adds the tiles they need to `textures`.
pub(crate) fn add_ink(
    model: &Model,
    style: &Style,
    frame: &FrameScale,
    parts: &mut [Part],
    textures: &mut TextureStore,
) -> Inked {
    let mut tiles = Tiles {
        textures,
        made: Vec::new(),
    };
    let mut guides = Vec::with_capacity(model.parts.len());
    let factors = tile_factors(model);
    for (part, info) in parts.iter_mut().zip(&model.parts) {
        let look = style.resolve_for(&info.material_name, &info.object_name);
        let ink = look.ink;
        if look.beam.is_none() {
            set_ink(part, info, &ink, frame, &mut tiles);
            if part.flags & Part::ON_SURFACE != 0 {
                part.tile_scale = factors[info.object as usize];
            }
        }
        guides.push(guide_of(&ink));
    }
    let charted = parts.iter().any(|part| part.flags & Part::ON_SURFACE != 0);
    let unmapped = model.parts.iter().zip(parts.iter()).find(|(info, part)| {
        part.flags & Part::ON_SURFACE != 0 && !info.has_uvs && wants_uvs(style, info)
    });
    Inked {
        charts: if charted {
            charts(model, guides, style)
        } else {
            Vec::new()
        },
        notices: unmapped
            .map(|(info, _)| {
                format!(
                    "hatching follows the surface of '{}' and others: they have no UV coordinates",
                    info.object_name
                )
            })
            .into_iter()
            .collect(),
    }
}

/// Whether a style asks for hatching by UV coordinates on a part.
fn wants_uvs(style: &Style, info: &PartInfo) -> bool {
    let look = style.resolve_for(&info.material_name, &info.object_name);
    look.ink.mapping == Mapping::Uv
}

/// How lengths of a style become pixels of a frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrameScale {
    pub height_px: u32,
    pub dpi: f32,
    /// Frame pixels per world unit, about.
    pub world_px: f32,
}

/// The tiles that a texture store holds already, by what made them.
struct Tiles<'a> {
    textures: &'a mut TextureStore,
    made: Vec<(Hatch, u32)>,
}

impl Tiles<'_> {
    /// Where the header of the tile starts that a hatch is drawn with.
    fn start_of(&mut self, hatch: &Hatch) -> u32 {
        let key = hatch.of_tile();
        if let Some((_, start)) = self.made.iter().find(|(made, _)| *made == key) {
            return *start;
        }
        let start = hatch::levels(&key, TILE_SIDE)
            .ok()
            .and_then(|tile| {
                let pack = |level: &Vec<[u8; 4]>| {
                    level
                        .iter()
                        .map(|texel| u32::from_le_bytes(*texel))
                        .collect()
                };
                let levels: Vec<Vec<u32>> = tile.levels.iter().map(pack).collect();
                self.textures
                    .add_tile(tile.side, tile.spacing_texels, &levels)
            })
            .unwrap_or(NONE);
        self.made.push((key, start));
        start
    }
}

fn set_ink(part: &mut Part, info: &PartInfo, ink: &Ink, frame: &FrameScale, tiles: &mut Tiles<'_>) {
    let [inked, hatched] = ink.tone.ink_and_hatch(info.metallic, info.roughness);
    let mapping = match ink.mapping {
        Mapping::Uv if !info.has_uvs => Mapping::Surface,
        other => other,
    };
    let hatch = &ink.hatch;
    let spacing_px = hatch
        .spacing
        .to_px(frame.height_px as f32, frame.dpi, frame.world_px)
        .max(SPACING_PX_MIN);
    part.ink_color = ink.color.linear();
    (part.dark_at, part.light_at, part.threshold) = (ink.dark_at, ink.light_at, ink.threshold);
    let bit = |bit: u32, when: bool| if when { bit } else { 0 };
    part.flags |= bit(Part::INK, inked);
    if !hatched {
        return;
    }
    part.hatch = tiles.start_of(hatch);
    if part.hatch == NONE {
        return;
    }
    let isotropic = matches!(hatch.pattern, Pattern::Stipple | Pattern::Dots);
    part.flags |= Part::HATCH
        | bit(Part::ON_SCREEN, mapping == Mapping::Screen)
        | bit(Part::ON_SURFACE, mapping == Mapping::Surface)
        | bit(Part::ISOTROPIC, isotropic)
        | bit(Part::TWO_LAYERS, hatch.pattern.layer_count() > 1);
    part.spacing_px = spacing_px;
    part.hatch_gain = hatch.gain;
    part.second_from = hatch::second_layer_start(hatch.cross_at);
    // On the surface the chart is turned: its seams allow no other angle than whole half turns.
    let angle = match mapping {
        Mapping::Surface => 0.0,
        _ => hatch.angle_deg.to_radians(),
    };
    part.turn = [math::cos(angle), math::sin(angle)];
    part.tile_scale = match mapping {
        Mapping::Surface => 1.0,
        Mapping::Uv => TILES_PER_UV,
        // The finest level of a tile as it is, or the first that is coarse enough for small spacings.
        Mapping::Screen => 1.0 / (TILE_SIDE as f32 * spacing_px / SCREEN_SPACING_TEXELS),
    };
}

/// Narrowest spacing that strokes are drawn with, in pixels: nearer ones are grey.
const SPACING_PX_MIN: f32 = 2.0;

/// Texels between strokes on the finest level of a tile.
const SCREEN_SPACING_TEXELS: f32 = 8.0;

/// How many tiles of each object make one of the model's chart.
///
/// Whole numbers: charts agree between triangles up to whole tiles, and so do their multiples.
fn tile_factors(model: &Model) -> Vec<f32> {
    let count = model
        .parts
        .iter()
        .map(|part| part.object as usize + 1)
        .max();
    let mut bounds = vec![[Vec3::INFINITY, Vec3::NEG_INFINITY]; count.unwrap_or(0)];
    for (vertex, influence) in model.vertices.iter().zip(&model.influences) {
        let point = model.posed_point(vertex, influence);
        let Some(part) = model.parts.get(vertex.part as usize) else {
            continue;
        };
        let object = part.object as usize;
        let [low, high] = &mut bounds[object];
        (*low, *high) = (low.min(point), high.max(point));
    }
    let factor = |[low, high]: &[Vec3; 2]| {
        let radius = ((*high - *low) * 0.5).length();
        let factor = (model.radius() / radius).round();
        // An object without vertices has no radius.
        if factor >= 1.0 {
            factor.min(TILE_FACTOR_MAX)
        } else {
            1.0
        }
    };
    bounds.iter().map(factor).collect()
}

/// What the strokes of a part run along on its surface.
fn guide_of(ink: &Ink) -> PartGuide {
    PartGuide {
        guide: ink.direction.map_or(
            Guide::Curvature {
                across: ink.follow == Follow::Around,
            },
            Guide::Along,
        ),
        angle: ink.hatch.angle_deg.to_radians(),
    }
}

/// The stroke chart of a model as it stands.
fn charts(model: &Model, guides: Vec<PartGuide>, style: &Style) -> Vec<ChartCorners> {
    let points = model.vertices.iter().zip(&model.influences);
    let positions: Vec<[f32; 3]> = points
        .map(|(vertex, influence)| model.posed_point(vertex, influence).to_array())
        .collect();
    let input = ChartInput {
        positions: &positions,
        triangles: &model.triangles,
    };
    let settings = ChartSettings {
        tile_world: model.radius() * TILE_RADII,
        crease_cos: math::cos(style.line.crease_angle_deg.to_radians()),
        guides,
        ..ChartSettings::default()
    };
    let chart = stroke_chart(&input, &settings);
    let corners = chart.corners.into_iter();
    corners.map(|[a, b, c]| ChartCorners { a, b, c }).collect()
}
