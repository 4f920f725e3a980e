//! What a style draws with the pen on a model: ink of every part, hatch tiles, stroke charts.

use crate::model::{Model, PartInfo};
use glam::{Vec2, Vec3};
use npr_core::color::linear_from_srgb;
use npr_core::geometry::{ChartCorners, NONE, Part, Triangle};
use npr_core::math;
use npr_core::texture::TextureStore;
use npr_mesh::direction_field::{Guide, PartGuide};
use npr_mesh::stroke_chart::{ChartInput, ChartSettings, stroke_chart};
use npr_style::hatch::{self, Hatch, Pattern};
use npr_style::paint::paint_white;
use npr_style::{Follow, Ink, Mapping, Style};

/// Texels along the side of a hatch tile: 128 strokes, and six octaves down to two.
const TILE_SIDE: u32 = 1024;

/// Size of a hatch tile on an object that is all of its scene, as a part of its radius. Framed as a whole it shows strokes 8
/// pixels apart three octaves above the finest level: the camera may come eight times nearer, and go eight times farther,
/// before strokes change their size. Larger tiles do not fit around thin limbs.
const TILE_RADII: f32 = 0.3;

/// How fast tiles shrink with the objects of a scene, as an exponent of their radius: less than 1, as small objects are mostly
/// seen from as far as large ones.
const SHRINKING: f32 = 0.75;

/// Most halvings of the tile from the size that suits the model to that of its smallest objects.
const HALVINGS_MAX: u32 = 5;

/// Narrowest spacing that strokes are drawn with, in pixels: nearer ones are grey.
const SPACING_PX_MIN: f32 = 2.0;

/// Texels between strokes on the finest level of a tile.
const SCREEN_SPACING_TEXELS: f32 = 8.0;

/// What ink and hatching need beside the parts.
#[derive(Debug, Default)]
pub(crate) struct Inked {
    /// Stroke charts, a triangle each; empty where no part is hatched along its surface.
    pub charts: Vec<ChartCorners>,
    /// How badly strokes lie around each vertex, 0..1; empty where charts are.
    pub knots: Vec<f32>,
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
    let mut unmapped = None;
    let tinted = tinted_parts(model, style);
    for ((part, info), tinted) in parts.iter_mut().zip(&model.parts).zip(tinted) {
        let look = style.resolve_for(&info.material_name, &info.object_name);
        let ink = look.ink;
        if look.beam.is_none() {
            set_ink(part, info, &ink, frame, &mut tiles);
            set_paint(part, ink.paint, tinted);
        }
        if ink.mapping == Mapping::Uv && part.flags & Part::ON_SURFACE != 0 {
            unmapped = unmapped.or(Some(info));
        }
        guides.push(guide_of(&ink));
    }
    let Charted { charts, errors } = fit_to_surfaces(model, guides, style, parts);
    let told = |info: &PartInfo| {
        format!(
            "hatching follows the surface of '{}' and others: they have no UV coordinates",
            info.object_name
        )
    };
    Inked {
        knots: knots_of(model, &errors),
        charts,
        notices: unmapped.map(told).into_iter().collect(),
    }
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
        Mapping::Surface | Mapping::Uv => 1.0,
        // The finest level of a tile as it is, or the first that is coarse enough for small spacings.
        Mapping::Screen => 1.0 / (TILE_SIDE as f32 * spacing_px / SCREEN_SPACING_TEXELS),
    };
}

/// Whether any vertex of each part has a colour that the style reads.
fn tinted_parts(model: &Model, style: &Style) -> Vec<bool> {
    let mut tinted = vec![false; model.parts.len()];
    if style.shade.use_vertex_colors {
        for vertex in &model.vertices {
            tinted[vertex.part as usize] |= vertex.color | 0xff00_0000 != u32::MAX;
        }
    }
    tinted
}

/// Lets the paint of a part darken its shade, where there is a pen and the paint is not all as light as paper.
fn set_paint(part: &mut Part, strength: f32, tinted: bool) {
    let [r, g, b] = [0, 8, 16].map(|shift| {
        let byte = part.paint_color >> shift & 255;
        linear_from_srgb(byte as f32 / 255.0)
    });
    let varies = tinted || part.texture != NONE;
    let pen = part.flags & (Part::INK | Part::HATCH) != 0;
    if pen && strength > 0.0 && (varies || paint_white([r, g, b], strength) < 1.0) {
        part.paint = strength;
        part.flags |= Part::PAINTED;
    }
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

/// Error of a chart from which strokes begin to look knotted, and from which they are.
const KNOT_ERRORS: [f32; 2] = [0.35, 0.75];

/// How badly strokes lie around each vertex, 0..1: by the mean error of the triangles there, which may be empty for none.
fn knots_of(model: &Model, errors: &[f32]) -> Vec<f32> {
    let mut sums = vec![
        [0.0f32; 2];
        if errors.is_empty() {
            0
        } else {
            model.vertices.len()
        }
    ];
    for (triangle, error) in model.triangles.iter().zip(errors) {
        for corner in triangle.corners {
            let [sum, count] = &mut sums[corner as usize];
            (*sum, *count) = (*sum + error, *count + 1.0);
        }
    }
    let [from, to] = KNOT_ERRORS;
    let knot =
        |[sum, count]: [f32; 2]| ((sum / count.max(1.0) - from) / (to - from)).clamp(0.0, 1.0);
    sums.into_iter().map(knot).collect()
}

/// Charts of a model's triangles, and how much each errs; both empty where no part is hatched along its surface.
#[derive(Default)]
struct Charted {
    charts: Vec<ChartCorners>,
    errors: Vec<f32>,
}

/// Fits tiles to the size of what they lie on: the scale of parts hatched by UV coordinates, and the charts of all others.
fn fit_to_surfaces(
    model: &Model,
    guides: Vec<PartGuide>,
    style: &Style,
    parts: &mut [Part],
) -> Charted {
    let on_surface = |part: &Part| part.flags & Part::ON_SURFACE != 0;
    let on_uvs = |part: &Part| {
        part.flags & (Part::HATCH | Part::ON_SURFACE | Part::ON_SCREEN) == Part::HATCH
    };
    if !parts.iter().any(|part| on_surface(part) || on_uvs(part)) {
        return Charted::default();
    }
    let surfaces = Surfaces::of(model);
    for (i, part) in parts.iter_mut().enumerate() {
        if on_uvs(part) {
            part.tile_scale = whole_scale(1.0 / (surfaces.uv_density[i] * surfaces.tile_world(i)));
        }
    }
    if !parts.iter().any(on_surface) {
        return Charted::default();
    }
    let mut settings = ChartSettings {
        crease_cos: math::cos(style.line.crease_angle_deg.to_radians()),
        guides,
        ..ChartSettings::default()
    };
    let mut charted = Charted {
        charts: vec![ChartCorners::default(); model.triangles.len()],
        errors: vec![0.0; model.triangles.len()],
    };
    for halvings in 0..=HALVINGS_MAX {
        let member = |part: u32| {
            on_surface(&parts[part as usize]) && surfaces.halvings[part as usize] == halvings
        };
        settings.tile_world = surfaces.tile_at(halvings);
        add_charts(model, &surfaces.positions, &settings, member, &mut charted);
    }
    charted
}

/// Adds the stroke charts of the parts that are members.
fn add_charts(
    model: &Model,
    positions: &[[f32; 3]],
    settings: &ChartSettings,
    member: impl Fn(u32) -> bool,
    charted: &mut Charted,
) {
    let numbered = model.triangles.iter().enumerate();
    let (numbers, triangles): (Vec<usize>, Vec<Triangle>) = numbered
        .filter(|(_, triangle)| member(triangle.part))
        .unzip();
    if triangles.is_empty() {
        return;
    }
    let input = ChartInput {
        positions,
        triangles: &triangles,
    };
    let chart = stroke_chart(&input, settings);
    for ((number, [a, b, c]), error) in numbers.into_iter().zip(chart.corners).zip(chart.errors) {
        charted.charts[number] = ChartCorners { a, b, c };
        charted.errors[number] = error;
    }
}

/// A number of tiles to one unit of UV coordinates, or of units to one tile: coordinates that wrap around at 1 show no seam.
fn whole_scale(scale: f32) -> f32 {
    let whole = |x: f32| x.clamp(1.0, 4096.0).round();
    if scale.is_nan() {
        // A part without area.
        1.0
    } else if scale >= 1.0 {
        whole(scale)
    } else {
        1.0 / whole(1.0 / scale)
    }
}

/// How large the surfaces of a model are.
struct Surfaces {
    /// Vertices as they stand in the world.
    positions: Vec<[f32; 3]>,
    model_radius: f32,
    /// For every part, how often the tile that suits the model is halved to suit the part's object.
    halvings: Vec<u32>,
    /// For every part, units of UV coordinates to one of the world: the root of the ratio of areas.
    uv_density: Vec<f32>,
}

impl Surfaces {
    fn of(model: &Model) -> Self {
        let points = model.vertices.iter().zip(&model.influences);
        let positions: Vec<[f32; 3]> = points
            .map(|(vertex, influence)| model.posed_point(vertex, influence).to_array())
            .collect();
        let radius_of = object_radii(model, &positions);
        let halvings = model.parts.iter().map(|info| {
            let smaller = math::log2(model.radius() / radius_of[info.object as usize]);
            ((SHRINKING * smaller).round().max(0.0) as u32).min(HALVINGS_MAX)
        });
        Self {
            halvings: halvings.collect(),
            uv_density: uv_densities(model, &positions),
            model_radius: model.radius(),
            positions,
        }
    }

    /// Size of a tile that is halved so often, in units of the world.
    fn tile_at(&self, halvings: u32) -> f32 {
        self.model_radius * TILE_RADII / (1u32 << halvings) as f32
    }

    /// Size of a tile on a part, in units of the world.
    fn tile_world(&self, part: usize) -> f32 {
        self.tile_at(self.halvings[part])
    }
}

/// Half the diagonal of the box around each object, by its number; 0 where it has no triangles.
fn object_radii(model: &Model, positions: &[[f32; 3]]) -> Vec<f32> {
    let count = model.parts.iter().map(|info| info.object + 1).max();
    let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let mut boxes = vec![nothing; count.unwrap_or(0) as usize];
    for triangle in &model.triangles {
        let (low, high) = &mut boxes[model.parts[triangle.part as usize].object as usize];
        for corner in triangle.corners {
            let point = Vec3::from(positions[corner as usize]);
            (*low, *high) = (low.min(point), high.max(point));
        }
    }
    let radius = |(low, high): &(Vec3, Vec3)| ((*high - *low) * 0.5).max(Vec3::ZERO).length();
    boxes.iter().map(radius).collect()
}

/// Units of UV coordinates to one of the world, in the mean over every part.
fn uv_densities(model: &Model, positions: &[[f32; 3]]) -> Vec<f32> {
    let mut areas = vec![[0.0f64; 2]; model.parts.len()];
    for triangle in &model.triangles {
        let [a, b, c] = triangle.corners.map(|v| Vec3::from(positions[v as usize]));
        let [r, s, t] = triangle
            .corners
            .map(|v| Vec2::from(model.vertices[v as usize].uv));
        let [in_uvs, in_world] = &mut areas[triangle.part as usize];
        *in_uvs += f64::from((s - r).perp_dot(t - r).abs());
        *in_world += f64::from((b - a).cross(c - a).length());
    }
    let density = |[in_uvs, in_world]: [f64; 2]| (in_uvs / in_world).sqrt() as f32;
    areas.into_iter().map(density).collect()
}

#[cfg(test)]
mod tests {
    use super::whole_scale;

    #[test]
    fn scales_are_whole_either_way() {
        assert_eq!(
            [3.4, 0.3, 1.0, 0.9].map(whole_scale),
            [3.0, 1.0 / 3.0, 1.0, 1.0]
        );
        assert_eq!(whole_scale(f32::NAN), 1.0);
        assert_eq!(whole_scale(f32::INFINITY), 4096.0);
        assert_eq!(whole_scale(0.0), 1.0 / 4096.0);
    }
}
