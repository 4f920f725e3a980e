//! Colours of lines and fills, by the style's rules.

use super::smoke::SmokeView;
use crate::error::RenderError;
use crate::look;
use crate::part_info::PartInfo;
use npr_core::color::srgb_from_linear;
use npr_drawing::fill;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_stylesheet::{Look, Style};
use npr_vector::mesh_lines::bvh::FaceTree;
use npr_vector::project::Projector;
use npr_vector::stroke::{Region, Stroke, StrokeSurface};

/// How every surface is painted.
#[derive(Debug)]
pub(crate) struct Paint {
    surfaces: Vec<SurfacePaint>,
}

#[derive(Debug, Clone, Copy)]
struct SurfacePaint {
    has_lines: bool,
    width_factor: f64,
    line_color: [u8; 4],
    fill_color: [u8; 4],
}

impl Paint {
    /// Resolves the style for every part; only parts for whose look `has_lines` is true have lines, and no surfaces of
    /// cards, for which others stand.
    pub fn new(
        (parts, surfaces): (&[PartInfo], &[Surface]),
        style: &Style,
        has_lines: impl Fn(&Look<'_>) -> bool,
    ) -> Self {
        let paint = |(info, surface): (&PartInfo, &Surface)| {
            let part = look::part(info, style);
            let look = info.look(style);
            let [r, g, b] = [0, 1, 2].map(|i| srgb_from_linear(part.base_color[i]));
            SurfacePaint {
                has_lines: !surface.is_lineless
                    && look.line_on
                    && look.beam.is_none()
                    && has_lines(&look),
                width_factor: f64::from(part.width_factor),
                line_color: bytes_of(part.line_color),
                fill_color: bytes_of([r, g, b, 1.0]),
            }
        };
        Self {
            surfaces: parts.iter().zip(surfaces).map(paint).collect(),
        }
    }

    /// The same with fills multiplied by the light of their textures, as far as a style shows textures.
    pub fn filled(mut self, lights: &[[f32; 3]], parts: &[PartInfo], style: &Style) -> Self {
        if !style.fills_with_textures() {
            return self;
        }
        for ((paint, light), info) in self.surfaces.iter_mut().zip(lights).zip(parts) {
            if info.look(style).shade_color.is_none() {
                let [r, g, b] = [0, 1, 2].map(|k| srgb_from_linear(info.base_color[k] * light[k]));
                paint.fill_color = bytes_of([r, g, b, 1.0]);
            }
        }
        self
    }

    /// For every surface whether it has lines.
    pub fn lined_surfaces(&self) -> Vec<bool> {
        self.surfaces.iter().map(|paint| paint.has_lines).collect()
    }

    /// Scales widths by the factors of surfaces, and removes the strokes of those that have no lines. Strokes of no
    /// part, which are those of smoke, stay as they are.
    pub fn apply(&self, strokes: &mut Vec<Stroke>) {
        let of = |stroke: &Stroke| self.surfaces.get(stroke.surface as usize);
        strokes.retain(|stroke| of(stroke).is_none_or(|paint| paint.has_lines));
        for stroke in strokes {
            let factor = of(stroke).map_or(1.0, |paint| paint.width_factor);
            for point in &mut stroke.points {
                point.width *= factor;
            }
        }
    }

    /// Colour of the lines of a surface; black for smoke, which is none of the parts.
    pub fn line_color(&self, surface: u32) -> [u8; 4] {
        let of = self.surfaces.get(surface as usize);
        of.map_or([0, 0, 0, 255], |paint| paint.line_color)
    }

    /// The surfaces as drawings list them.
    pub fn into_surfaces(self, parts: &[PartInfo]) -> Vec<StrokeSurface> {
        let painted = parts.iter().zip(self.surfaces);
        painted
            .map(|(info, paint)| StrokeSurface {
                object: info.object_name.clone(),
                object_number: info.object,
                material: info.material_name.clone(),
                line_color: paint.line_color,
                fill_color: paint.fill_color,
            })
            .collect()
    }
}

/// Values of 0..1 as bytes.
fn bytes_of(color: [f32; 4]) -> [u8; 4] {
    color.map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
}

/// The regions of visible surfaces and of smoke between lines, each in one piece as far as no line divides it.
pub(super) fn regions(
    shape: &HalfEdgeMesh,
    tree: &FaceTree,
    projector: &Projector,
    size: [u32; 2],
    strokes: &[Stroke],
    smoke: Option<&SmokeView<'_>>,
) -> Result<Vec<Region>, RenderError> {
    // Tell which surface a place of the picture shows, smoke where it lies before the others.
    let face_at = |place: [f64; 2]| {
        let (face, depth) = tree.face_at(shape, projector, place)?;
        Some((shape.face_surfaces[face as usize], depth))
    };
    let surface_at = |place: [f64; 2]| {
        let face = face_at(place);
        let depth = face.map_or(f64::INFINITY, |(_, depth)| depth);
        let occluder_depths = smoke.and_then(|smoke| smoke.surface_before(place, depth));
        occluder_depths.or(face.map(|(surface, _)| surface))
    };

    // Close regions between lines, edges of tones and seams of smoke.
    let mut segments = segments_of(strokes);
    if let Some(smoke) = smoke {
        let depth_at = |place: [f64; 2]| Some(face_at(place)?.1);
        segments.extend(smoke.tone_edges());
        segments.extend(smoke.seams(size, &depth_at));
    }
    Ok(fill::regions(size, &segments, &surface_at)?)
}

/// The pieces of all visible strokes.
fn segments_of(strokes: &[Stroke]) -> Vec<[[f64; 2]; 2]> {
    let visible = strokes.iter().filter(|stroke| stroke.is_visible());
    visible
        .flat_map(|stroke| {
            let points = &stroke.points;
            let joint = points.last().zip(points.first()).filter(|_| stroke.closed);
            let pairs = points.windows(2).map(|pair| (&pair[0], &pair[1]));
            pairs.chain(joint).map(|(a, b)| [a.position, b.position])
        })
        .collect()
}
