//! What a style draws with the pen on a model: ink of every part, hatch tiles, stroke charts.

use crate::error::RenderError;
use crate::guides::{Guides, turn_to_light};
use crate::kept::{Cache, input_of};
use crate::model::Model;
use crate::part_info::PartInfo;
use crate::pictures::Pictures;
use glam::{Vec2, Vec3};
use npr_core::camera::Camera;
use npr_core::color::linear_from_byte;
use npr_core::geometry::{ChartCorners, NONE, Part, Triangle};
use npr_core::math;
use npr_core::texture::TextureStore;
use npr_mesh::stroke_chart::{ChartInput, ChartSettings, stroke_chart};
use npr_style::hatch;
use npr_style::lighting::LightSource;
use npr_style::paint::paint_white;
use npr_stylesheet::{Hatch, Pattern};
use npr_stylesheet::{Ink, Mapping, Style};

/// Texels along the side of a hatch tile: 128 strokes, and six octaves down to two.
const TILE_SIDE: u32 = 1024;

/// Size of a hatch tile on an object that is the whole scene, as a share of its radius. Framed as a whole it shows
/// strokes 8 pixels apart three octaves above the finest level: the camera may come eight times nearer, and go eight
/// times farther, before strokes change their size. Larger tiles do not fit around thin limbs.
pub(crate) const TILE_RADII: f32 = 0.3;

/// Exponent by which tiles shrink with the radius of a scene's objects: less than 1, as small objects are mostly seen
/// from as far away as large ones.
const SHRINKING: f32 = 0.75;

/// Most halvings of the tile from the size that suits the model to that of its smallest objects.
const HALVINGS_MAX: u32 = 5;

/// Narrowest spacing of strokes, in pixels: closer ones would show as grey.
const SPACING_PX_MIN: f32 = 2.0;

/// Texels between strokes on the finest level of a tile.
const SCREEN_SPACING_TEXELS: f32 = 8.0;

/// What ink and hatching need beside the parts.
#[derive(Debug, Default)]
pub(crate) struct Inked {
    /// Stroke charts, a triangle each; empty where no part is hatched along its surface.
    pub charts: Vec<ChartCorners>,
    /// How distorted strokes are around each vertex, 0..1; empty without charts. Charts that follow the light have
    /// none.
    pub chart_distortions: Vec<f32>,
    /// How much of its shade the pen keeps on faces, 0..1, for every part of the model.
    faces: Vec<f32>,
    /// What was done in another way than the style asks, for the user.
    pub notices: Vec<String>,
    /// What strokes run along.
    guides: Guides,
    /// The light that charts were made for, where any strokes follow one.
    lit_by: Option<LightSource>,
}

/// Gives ink to `parts`, and to the part that stands for `smoke`; adds the tiles they need to `textures`.
///
/// Charts of strokes that follow the light stay empty until [`Inked::follow_light`].
pub(crate) fn add_ink(
    model: &Model,
    style: &Style,
    pictures: &Pictures<'_>,
    frame: &FrameScale,
    parts: &mut [Part],
    smoke: Option<&mut Part>,
    textures: &mut TextureStore,
) -> Result<Inked, RenderError> {
    // Ink and paint every part but beams, and make the tiles that are asked for.
    let mut tiles = Tiles {
        pictures,
        textures,
        made: Vec::new(),
    };
    let mut inks = Vec::with_capacity(model.parts.len());
    let tinted = tinted_parts(model, style);
    for ((part, info), tinted) in parts.iter_mut().zip(&model.parts).zip(tinted) {
        let look = info.look(style);
        if look.beam.is_none() {
            set_ink(part, info, &look.ink, frame, &mut tiles)?;
            set_paint(part, look.ink.paint, tinted);
        }
        inks.push(look.ink);
    }

    // Ink the part that stands for smoke, with strokes on the picture.
    if let Some(part) = smoke {
        let ink = style.smoke.ink.on_picture();
        let tones = ink.tone.ink_and_hatch(0.0, 1.0);
        set_pen(part, &ink, tones, ink.mapping, frame, &mut tiles)?;
    }

    // Lay strokes along surfaces, and report what is hatched in another way than asked.
    let guides = Guides::new(model, &inks);
    let mut inked = Inked {
        notices: notices_of(model, &inks, &guides, parts),
        guides,
        faces: inks.iter().map(|ink| ink.faces).collect(),
        ..Inked::default()
    };
    inked.fit_to_surfaces(model, style, parts);
    Ok(inked)
}

/// What is hatched in another way than asked, each once with the first part of its kind.
fn notices_of(model: &Model, inks: &[Ink], guides: &Guides, parts: &[Part]) -> Vec<String> {
    // Look at parts hatched along their surfaces alone.
    let on_surface = |i: &usize| parts[*i].flags & Part::ON_SURFACE != 0;
    let surfaces: Vec<usize> = (0..inks.len()).filter(on_surface).collect();

    // Report each oddity once, with the first part that has it.
    let first = |is_odd: &dyn Fn(usize) -> bool, reported: &str| {
        let found = surfaces.iter().find(|i| is_odd(**i))?;
        let name = &model.parts[*found].object_name;
        Some(format!(
            "hatching follows the surface of '{name}' and others: {reported}"
        ))
    };
    [
        first(
            &|i| inks[i].mapping == Mapping::Uv,
            "they have no UV coordinates",
        ),
        first(
            &|i| guides.of_parts[i].is_unsaid,
            "their vertices say no directions",
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// How lengths of a style become pixels of a frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrameScale {
    pub height_px: u32,
    pub dpi: f32,
    /// Hills of the paper per pixel.
    pub spots_per_px: f32,
    /// Frame pixels per world unit, about.
    pub world_px: f32,
}

/// The tiles that a texture store holds already, by what made them.
struct Tiles<'a> {
    pictures: &'a Pictures<'a>,
    textures: &'a mut TextureStore,
    /// Tiles by their hatch, and whether a picture is laid over its own half turn.
    made: Vec<((Hatch, bool), u32)>,
}

impl Tiles<'_> {
    /// Where the header of a hatch's tile starts in the store. `on_surface` lays a picture over its own half turn, as
    /// charts are glued with turns.
    fn start_of(&mut self, hatch: &Hatch, on_surface: bool) -> Result<u32, RenderError> {
        // Use a tile that was made before.
        let key = (hatch.of_tile(), on_surface && !hatch.image.is_empty());
        if let Some((_, start)) = self.made.iter().find(|(made, _)| *made == key) {
            return Ok(*start);
        }

        // Else draw it, or read it from its picture, and store its levels.
        let tile = if hatch.image.is_empty() {
            hatch::levels(&key.0, TILE_SIDE).ok()
        } else {
            Some(self.pictures.hatch_tile(&hatch.image, TILE_SIDE, key.1)?)
        };
        let start = tile
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
        Ok(start)
    }
}

fn set_ink(
    part: &mut Part,
    info: &PartInfo,
    ink: &Ink,
    frame: &FrameScale,
    tiles: &mut Tiles<'_>,
) -> Result<(), RenderError> {
    let tones = ink.tone.ink_and_hatch(info.metallic, info.roughness);
    let mapping = match ink.mapping {
        Mapping::Uv if !info.has_uvs => Mapping::Surface,
        other => other,
    };
    set_pen(part, ink, tones, mapping, frame, tiles)
}

/// Sets the ink of a part, and its hatching, with strokes fixed to what `mapping` says.
fn set_pen(
    part: &mut Part,
    ink: &Ink,
    [inked, hatched]: [bool; 2],
    mapping: Mapping,
    frame: &FrameScale,
    tiles: &mut Tiles<'_>,
) -> Result<(), RenderError> {
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
        return Ok(());
    }
    part.hatch = tiles.start_of(hatch, mapping == Mapping::Surface)?;
    if part.hatch == NONE {
        return Ok(());
    }
    let dotted = matches!(hatch.pattern, Pattern::Stipple | Pattern::Dots);
    let isotropic = dotted || !hatch.image.is_empty();
    // Points set one by one may stand alone.
    let is_cut = hatch.pattern != Pattern::Stipple || !hatch.image.is_empty();
    part.flags |= Part::HATCH
        | bit(Part::CUT, is_cut)
        | bit(Part::ON_SCREEN, mapping == Mapping::Screen)
        | bit(Part::ON_SURFACE, mapping == Mapping::Surface)
        | bit(Part::ISOTROPIC, isotropic)
        | bit(Part::TWO_LAYERS, hatch.pattern.layer_count() > 1);
    part.spacing_px = spacing_px;
    part.hatch_gain = hatch.gain;
    (part.hatch_grain, part.spots_per_px) = (hatch.grain, frame.spots_per_px);
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
    Ok(())
}

/// Whether any vertex of each part has a colour that the style reads.
fn tinted_parts(model: &Model, style: &Style) -> Vec<bool> {
    let mut tinted = vec![false; model.parts.len()];
    if style.shade.use_vertex_colors {
        for vertex in &model.vertices {
            // A scene without triangles has no parts, whatever its vertices say.
            if let Some(tinted) = tinted.get_mut(vertex.part as usize) {
                *tinted |= !vertex.is_white();
            }
        }
    }
    tinted
}

/// Lets the paint of a part darken its shade, where the part is inked or hatched and its paint is not all as light as
/// paper.
fn set_paint(part: &mut Part, strength: f32, tinted: bool) {
    let [r, g, b, _] = part.paint_color.to_le_bytes().map(linear_from_byte);
    let varies = tinted || part.texture != NONE;
    let pen = part.flags & (Part::INK | Part::HATCH) != 0;
    if pen && strength > 0.0 && (varies || paint_white([r, g, b], strength) < 1.0) {
        let byte = (strength.min(1.0) * 255.0).round() as u32;
        part.paint_color = part.paint_color & 0xff_ffff | byte << 24;
        part.flags |= Part::PAINTED;
    }
}

/// Errors of a chart at which its strokes begin to look distorted, and at which they fully are.
const DISTORTION_ERRORS: [f32; 2] = [0.35, 0.75];

/// How distorted strokes are around each vertex, 0..1, from the mean error of the triangles there; empty where `errors`
/// is.
fn chart_distortions_of(model: &Model, errors: &[f32]) -> Vec<f32> {
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
    let [from, to] = DISTORTION_ERRORS;
    let chart_distortion =
        |[sum, count]: [f32; 2]| ((sum / count.max(1.0) - from) / (to - from)).clamp(0.0, 1.0);
    sums.into_iter().map(chart_distortion).collect()
}

fn on_surface(part: &Part) -> bool {
    part.flags & Part::ON_SURFACE != 0
}

impl Inked {
    /// Fits tiles to the size of what they lie on: the scale of parts hatched by UV coordinates, and the charts of all
    /// others but those that follow the light.
    fn fit_to_surfaces(&mut self, model: &Model, style: &Style, parts: &mut [Part]) {
        let on_uvs = |part: &Part| {
            part.flags & (Part::HATCH | Part::ON_SURFACE | Part::ON_SCREEN) == Part::HATCH
        };
        if !parts.iter().any(|part| on_surface(part) || on_uvs(part)) {
            return;
        }
        let surfaces = Surfaces::of(model);
        for (i, part) in parts.iter_mut().enumerate() {
            if on_uvs(part) {
                part.tile_scale =
                    whole_scale(1.0 / (surfaces.uv_density[i] * surfaces.tile_world(i)));
            }
        }
        if parts.iter().any(on_surface) {
            self.charts = vec![ChartCorners::default(); model.triangles.len()];
            let errors = self.add_charts(model, style, &surfaces, parts, None);
            self.chart_distortions = chart_distortions_of(model, &errors);
        }
    }

    /// What the pen does at every vertex, packed as `Vertex::pen`; sets [`Part::SPARED`] in the parts with faces of
    /// which it leaves out some of the shade. Empty where it does the same everywhere.
    pub fn pens(&self, model: &Model, parts: &mut [Part]) -> Vec<u32> {
        // Find out what it leaves out.
        let mut spared = vec![0.0; model.limbs.faces.len()];
        for (i, (spared, vertex)) in spared.iter_mut().zip(&model.vertices).enumerate() {
            // Vertices without triangles may have no part.
            let part = vertex.part as usize;
            let Some(faces) = self.faces.get(part) else {
                continue;
            };
            *spared = model.limbs.face_at(i) * (1.0 - faces);
            if *spared > 0.0 && parts[part].flags & Part::HATCH != 0 {
                parts[part].flags |= Part::SPARED;
            }
        }

        // Pack it with how distorted charts are.
        let known = self.chart_distortions.len().max(spared.len());
        let share = |shares: &[f32], i: usize| shares.get(i).copied().unwrap_or_default();
        let pen = |i| math::pack_shares([share(&self.chart_distortions, i), share(&spared, i)]);
        (0..known).map(pen).collect()
    }

    /// Turns the strokes that follow the light to where it shines from: charts of surfaces, and strokes on the picture.
    /// Returns whether parts, and whether charts, have changed.
    pub fn follow_light(
        &mut self,
        model: &Model,
        style: &Style,
        light: &LightSource,
        camera: &Camera,
        parts: &mut [Part],
    ) -> [bool; 2] {
        // List the parts whose strokes follow the light.
        let guides = self.guides.of_parts.iter();
        let lit: Vec<usize> = guides
            .enumerate()
            .filter_map(|(i, guide)| guide.follows_light().then_some(i))
            .collect();

        // Turn strokes that are fixed to the picture.
        let (min, max) = model.bounds();
        let middle = std::array::from_fn(|i| (min[i] + max[i]) * 0.5);
        let mut turned = false;
        for &i in &lit {
            if parts[i].flags & Part::ON_SCREEN != 0 {
                let angle = self.guides.of_parts[i].angle;
                parts[i].turn = turn_to_light(light, camera, middle, angle);
                turned = true;
            }
        }

        // Make the charts of surfaces anew, where the light is another than before.
        let on_surfaces = lit.iter().any(|&i| on_surface(&parts[i]));
        if !on_surfaces || self.lit_by == Some(*light) {
            return [turned, false];
        }
        self.lit_by = Some(*light);
        let surfaces = Surfaces::of(model);
        self.add_charts(model, style, &surfaces, parts, Some(light));
        [turned, true]
    }

    /// Makes the charts of the parts whose strokes follow `light`, or without it those of all others; gives the error
    /// of every triangle's chart.
    fn add_charts(
        &mut self,
        model: &Model,
        style: &Style,
        surfaces: &Surfaces,
        parts: &[Part],
        light: Option<&LightSource>,
    ) -> Vec<f32> {
        // Settle what strokes run along.
        let mut settings = ChartSettings {
            crease_cos: math::cos(style.line.crease_angle_deg.to_radians()),
            guides: self.guides.of_charts(),
            ..ChartSettings::default()
        };
        let mut errors = vec![0.0; model.triangles.len()];
        let lit_by = light.copied().unwrap_or_default();
        let directions = self.guides.directions(model, &surfaces.positions, &lit_by);

        // Chart the parts of each tile size together.
        for halvings in 0..=HALVINGS_MAX {
            let member = |part: u32| {
                let part = part as usize;
                let follows = self.guides.of_parts[part].follows_light();
                let is_meant = on_surface(&parts[part]) && follows == light.is_some();
                is_meant && surfaces.halvings[part] == halvings
            };
            settings.tile_world = surfaces.tile_at(halvings);
            let input = ChartInput {
                positions: &surfaces.positions,
                triangles: &model.triangles,
                directions: &directions,
            };
            let out = (&mut self.charts[..], &mut errors[..]);
            chart_some(&model.cache, &input, &settings, member, out);
        }
        errors
    }
}

/// Makes the stroke charts of the parts of a surface that are members.
fn chart_some(
    cache: &Cache,
    surface: &ChartInput<'_>,
    settings: &ChartSettings,
    member: impl Fn(u32) -> bool,
    (charts, errors): (&mut [ChartCorners], &mut [f32]),
) {
    // Pick the triangles of the members.
    let numbered = surface.triangles.iter().enumerate();
    let (numbers, triangles): (Vec<usize>, Vec<Triangle>) = numbered
        .filter(|(_, triangle)| member(triangle.part))
        .unzip();
    if triangles.is_empty() {
        return;
    }

    // Chart them, and write each result to its own triangle.
    let input = ChartInput {
        triangles: &triangles,
        ..*surface
    };
    for (number, row) in numbers.into_iter().zip(chart_rows(cache, &input, settings)) {
        let [a, b, c, d, e, f, error] = row;
        charts[number] = ChartCorners {
            a: [a, b],
            b: [c, d],
            c: [e, f],
        };
        errors[number] = error;
    }
}

/// The chart coordinates of each triangle's corners, and their error, a row each; kept where there is a folder.
fn chart_rows(cache: &Cache, input: &ChartInput<'_>, settings: &ChartSettings) -> Vec<[f32; 7]> {
    let name = || {
        let mut hash = input_of("charts");
        hash.positions(input.positions);
        hash.bytes(bytemuck::cast_slice(input.triangles));
        hash.positions(input.directions);
        hash.bytes(format!("{settings:?}").as_bytes());
        hash
    };
    let is_sound = |rows: &[[f32; 7]]| {
        rows.len() == input.triangles.len() && rows.as_flattened().iter().all(|v| v.is_finite())
    };
    cache.rows(name, is_sound, || {
        let chart = stroke_chart(input, settings);
        let rows = chart.corners.into_iter().zip(chart.errors);
        rows.map(|([[a, b], [c, d], [e, f]], error)| [a, b, c, d, e, f, error])
            .collect()
    })
}

/// The nearest scale with a whole number of tiles per unit of UV coordinates, or of units per tile: coordinates that
/// wrap around at 1 then show no seam.
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

    /// Size of a tile after so many halvings, in units of the world.
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
