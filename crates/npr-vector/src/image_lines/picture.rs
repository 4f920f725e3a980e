//! Which surface every pixel of a view shows.

use crate::mesh_lines::zero_set::CornerNormals;
use crate::pixel_strokes::segment::PixelView;
use crate::pixel_strokes::surface::fill;
use crate::screen::gbuffer::{Surfaces, resolve};
use npr_core::crease::Creases;
use npr_core::geometry::{GPixel, NONE, Part, PosedVertex, Triangle};
use npr_core::raster::triangle_of;
use npr_core::surface::{apply_point, dot};
use npr_core::window::{View, Window};
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// A view of a shape, and which lines are looked for in its picture.
#[derive(Clone, Copy)]
pub struct ImageScene<'a> {
    /// The surfaces; both sides of all faces hide what is behind them.
    pub shape: &'a HalfEdgeMesh,
    /// Normals at the corners of its faces: no crease lies where they are smooth.
    pub normals: &'a CornerNormals,
    /// Camera and picture.
    pub view: &'a View,
    /// For every surface whether it has lines; surfaces beyond the list have some.
    pub is_drawn: &'a [bool],
    /// Kinds of line that are looked for, bits of [`KindSet`](npr_core::line_kind::KindSet).
    pub kinds: u32,
    /// Which folds are creases.
    pub creases: Creases,
    /// Depth jump, as a share of the picture's height at that depth, from which surfaces are separated by a line.
    pub depth_threshold: f32,
}

impl ImageScene<'_> {
    fn size(&self) -> [u32; 2] {
        self.view.frame_px.map(|side| side as u32)
    }

    pub(super) fn window(&self) -> Window {
        let px = self.view.frame_px;
        Window::over(px, [0.0; 2], px, self.size())
    }

    /// The surfaces as parts, which detection reads.
    pub(super) fn parts(&self) -> Vec<Part> {
        let surfaces = self.shape.surfaces.iter().enumerate();
        let part = surfaces.map(|(index, surface)| Part {
            object: surface.object,
            material: surface.material,
            flags: match self.is_drawn.get(index) {
                Some(false) => 0,
                _ => Part::LINES,
            },
            ..Part::default()
        });
        part.collect()
    }
}

/// A view of a shape, pixel by pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfacePicture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The face that each pixel shows, or [`NONE`].
    pub faces: Vec<u32>,
    /// Reversed depth of each pixel, 0 where nothing is seen.
    pub depths: Vec<f32>,
    /// Depth and normal there; the part is the surface's number.
    pub pixels: Vec<GPixel>,
    /// The object there, or [`NONE`].
    pub objects: Vec<u32>,
}

impl SurfacePicture {
    /// Draws the faces of a view. O(faces + pixels), in parallel; the same for any number of threads.
    pub fn new(scene: &ImageScene<'_>) -> Self {
        let shape = scene.shape;
        let (ids, depths) = fill(&PixelView::new(scene.view), &shape.faces, |vertex| {
            shape.positions[vertex as usize]
        });
        let faces: Vec<u32> = ids.par_iter().map(|id| triangle_of(*id)).collect();
        let pixels = resolved(scene, &faces);
        let object_of = |pixel: &GPixel| {
            let surface = shape.surfaces.get(pixel.part as usize);
            surface.map_or(NONE, |surface| surface.object)
        };
        Self {
            size: scene.size(),
            objects: pixels.par_iter().map(object_of).collect(),
            pixels,
            faces,
            depths: depths.into_iter().map(f32::from_bits).collect(),
        }
    }

    /// Whether no occluder (reversed depths, if given) lies before a pixel.
    pub fn is_clear(&self, occluder_depths: Option<&[f32]>, pixel: usize) -> bool {
        occluder_depths.is_none_or(|occluder_depths| occluder_depths[pixel] <= self.depths[pixel])
    }
}

/// Depth, normal and surface under every pixel, from the faces that are seen.
fn resolved(scene: &ImageScene<'_>, faces: &[u32]) -> Vec<GPixel> {
    // List the faces that are seen.
    let mut seen: Vec<u32> = faces.iter().copied().filter(|face| *face != NONE).collect();
    seen.par_sort_unstable();
    seen.dedup();

    // Pose their corners as a frame does.
    let shape = scene.shape;
    let corner = |face: u32, k: usize| {
        let world = shape.positions[shape.faces[face as usize][k] as usize];
        let eye = scene.view.eye_world;
        let away = [0, 1, 2].map(|i| world[i] - eye[i]);
        PosedVertex {
            clip: apply_point(&scene.view.clip_from_world, world),
            world,
            depth: dot(away, scene.view.forward_world),
            normal: scene.normals.normal(3 * face + k as u32),
            half_width: 0.5,
        }
    };
    let posed: Vec<PosedVertex> = seen
        .par_iter()
        .flat_map_iter(|face| [0, 1, 2].map(|k| corner(*face, k)))
        .collect();
    let triangles: Vec<Triangle> = (0..)
        .zip(&seen)
        .map(|(slot, face): (u32, &u32)| Triangle {
            corners: [0, 1, 2].map(|k| 3 * slot + k),
            part: shape.face_surfaces[*face as usize],
        })
        .collect();

    // Number faces as the list has them.
    let ids: Vec<u32> = faces
        .par_iter()
        .map(|face| seen.binary_search(face).map_or(0, |slot| slot as u32 + 1))
        .collect();

    // Resolve depth, normal and surface under every pixel.
    let mut pixels = vec![GPixel::EMPTY; faces.len()];
    if pixels.is_empty() {
        return pixels;
    }
    let on = Surfaces {
        view: scene.view,
        window: &scene.window(),
        posed: &posed,
        triangles: &triangles,
        parts: &scene.parts(),
    };
    resolve(&on, &ids, &mut pixels);
    pixels
}
