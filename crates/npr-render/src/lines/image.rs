//! Lines from a picture of the surfaces, and lines painted in textures.

use super::options::LineOptions;
use super::paint::Paint;
use super::pixels::occluder_depths_of;
use super::texture_map::TextureMap;
use super::view::LineView;
use crate::error::RenderError;
use glam::{DVec3, Vec2};
use npr_core::budget::Budget;
use npr_core::color::srgb_from_linear;
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_core::line_source::LineSource;
use npr_core::surface::dot;
use npr_core::texture;
use npr_core::window::View;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_style::compose::LUMA;
use npr_vector::image_lines::{
    BYTES_PER_PIXEL, ImageScene, SurfacePicture, painted_lines, strokes_from,
};
use npr_vector::mesh_lines::draw::{LineSettings, Prepared, StrokeLook};
use npr_vector::project::Projector;
use npr_vector::stroke::Stroke;
use npr_vector::surface_location::SurfaceLocation;
use rayon::prelude::*;

/// Settings of what is drawn on the mesh beside lines of a picture: marked lines, which no picture of surfaces shows.
pub(super) fn beside_image(settings: &LineSettings) -> LineSettings {
    LineSettings {
        kinds: 0,
        hidden: false,
        ..settings.clone()
    }
}

/// The strokes of a view by [`LineSource::Image`], and painted ones, as far as each is asked for. Dense smoke
/// hides them.
pub(super) fn strokes(
    view: &LineView<'_>,
    prepared: &Prepared,
    options: &LineOptions,
    (settings, paint, look): (&LineSettings, &Paint, &StrokeLook<'_>),
) -> Result<Vec<Stroke>, RenderError> {
    // Draw a picture of the surfaces.
    let [width, height] = options.size.map(|side| side as usize);
    let mut budget = Budget::new(view.memory_limit);
    budget.take("a picture of surfaces", width * height, BYTES_PER_PIXEL)?;
    let of_frame = view.camera.view(options.size, view.bounds);
    let scene = ImageScene {
        shape: view.shape,
        normals: prepared.corner_normals(view.shape),
        view: &of_frame,
        is_drawn: &paint.lined_surfaces(),
        kinds: settings.kinds,
        creases: options.creases_of_pixels(),
        depth_threshold: options.depth_threshold,
    };
    let picture = SurfacePicture::new(&scene);
    let occluder_depths = view
        .smoke
        .and_then(|smoke| occluder_depths_of(&of_frame, smoke));
    let on = (&scene, view.projector, &picture);

    // Follow the borders between surfaces.
    let seen = (view.shape, view.projector.lens());
    let mut strokes = Vec::new();
    if options.method == LineSource::Image {
        let runs = picture.borders(&scene, occluder_depths.as_deref()).runs(on);
        strokes = strokes_from(runs, seen, settings, look);
    }

    // Follow the lines that are painted in textures.
    if let (Some(map), Some(wanted)) = (view.map, options.painted) {
        let all = ImageScene {
            kinds: KindSet::BITS,
            ..scene
        };
        let lines = picture.borders(&all, None).ink();
        let lightness = lightness(view.shape, map, (&of_frame, view.projector), &picture);
        for rule in wanted.rules() {
            let mut ink = painted_lines(&scene, &picture, &lightness, &lines, &rule);
            ink.retain(|pixel| picture.is_clear(occluder_depths.as_deref(), pixel));
            strokes.extend(strokes_from(ink.runs(on)?, seen, settings, look));
        }
    }
    Ok(strokes)
}

/// Lightness of the textures at every pixel of a view, sRGB-encoded, 0..1; not a number where there is none.
fn lightness(
    shape: &HalfEdgeMesh,
    map: &TextureMap,
    (view, projector): (&View, &Projector),
    picture: &SurfacePicture,
) -> Vec<f32> {
    let width = picture.size[0] as usize;
    let pixels = picture.faces.par_iter().zip(&picture.pixels).enumerate();
    let at = |(pixel, (face, surface)): (usize, (&u32, &npr_core::geometry::GPixel))| {
        let start = map.starts.get(surface.part as usize).copied();
        let Some(start) = start.filter(|start| *face != NONE && *start != NONE) else {
            return f32::NAN;
        };
        let place = [pixel % width, pixel / width].map(|v| v as f64 + 0.5);
        let world = projector.unproject(place, f64::from(surface.depth));
        let Some((uv, per_unit)) = coordinates(shape, map, *face, world) else {
            return f32::NAN;
        };
        let footprint = per_unit * view.pixel_at(surface.depth);
        let [r, g, b, alpha] = texture::sample(map.textures.words(), start, uv, footprint);
        // What is clear shows paper.
        let light = dot(LUMA, [r, g, b]);
        srgb_from_linear((light * alpha + 1.0 - alpha).clamp(0.0, 1.0))
    };
    pixels.map(at).collect()
}

/// Texture coordinates at a place of a face, and how much they change over a unit of the world.
fn coordinates(
    shape: &HalfEdgeMesh,
    map: &TextureMap,
    face: u32,
    world: DVec3,
) -> Option<([f32; 2], f32)> {
    let uvs = map.corners(face)?.map(Vec2::from);
    let edge = shape.edge_of[3 * face as usize];
    let (_, shares) = SurfaceLocation { edge, face }.place(shape, world);
    let uv = (0..3).fold(Vec2::ZERO, |sum, i| sum + uvs[i] * shares[i] as f32);
    let corners = shape.faces[face as usize].map(|vertex| shape.point(vertex).as_vec3());
    let around = |length: &dyn Fn(usize, usize) -> f32| length(0, 1) + length(1, 2) + length(2, 0);
    let run = around(&|a, b| uvs[b].distance(uvs[a]));
    let length = around(&|a, b| corners[b].distance(corners[a]));
    let per_unit = run / length.max(1e-30);
    (uv.is_finite() && per_unit.is_finite()).then_some((uv.to_array(), per_unit))
}
