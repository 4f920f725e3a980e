//! Layers for compositing: the picture without lines, and what is read of a frame to make a [`LayerPixel`] of every
//! pixel.

use super::line_features::LineFeatures;
use super::stroke_places;
use crate::error::RenderError;
use crate::frame::Frame;
use crate::frame_graph::{FrameGraph, Grids, Layers, pixel_count, write};
use crate::layer_pixel::{LayerPixel, line_between};
use crate::model::Model;
use crate::stage::StagePixel;
use crate::tiles::Tiles;
use npr_core::budget::Budget;
use npr_core::geometry::{NONE, PosedVertex};
use npr_core::outline::MASK_KINDS;
use npr_core::raster::triangle_of;
use npr_core::surface::{blend, blend3, faces_eye, unit_or_z, weights_at};
use npr_core::window::{View, Window};
use npr_gpu::engine::{EngineError, Readings, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_style::compose::Compose;
use npr_stylesheet::{OutlineMethod, Style};
use rayon::prelude::*;

/// Bytes of a pixel on the host: its layers, as much again for whoever writes them, and what it shows of strokes.
const PIXEL_BYTES: usize = 2 * size_of::<LayerPixel>() + stroke_places::PIXEL_BYTES;

/// Bytes of a pixel of stages on the host, and as much again for whoever shows them.
const STAGE_BYTES: usize = 2 * size_of::<StagePixel>();

/// The passes that draw the picture without lines, and what is read to make layers.
#[derive(Debug, Clone)]
pub(crate) struct CompositingPasses {
    /// Settings of the picture without lines.
    compose: ResourceId,
    /// The picture without lines.
    bare: ResourceId,
    /// Triangle numbers of colour samples, without hulls.
    ids: ResourceId,
    /// Lines with their coverage, where a method has any.
    ribbons: Option<ResourceId>,
    /// The mask with its size, where it is a stage that is asked for.
    mask: Option<(ResourceId, [u32; 2])>,
    /// Vertices in the view.
    posed: ResourceId,
    /// Colour samples per pixel along each axis.
    samples: u32,
}

/// What the user should know of the layers of a style and a scene.
pub(crate) fn notices(style: &Style, features: LineFeatures, has_surfaces: bool) -> Vec<String> {
    let of_rules = style.rule.iter().filter_map(|rule| rule.line.method);
    let mut methods = of_rules.chain([style.line.method]);
    let has_angle = methods.any(|method| method == OutlineMethod::Angle);
    let has_others = features.mask || features.hull || features.rim;
    let all = [
        (
            has_angle && has_surfaces,
            "lines of method angle are part of the surfaces: the layer of lines has none of them",
        ),
        (
            has_others,
            "line ids number strokes: lines of other methods than strokes and potrace have none, and no depth",
        ),
        (
            !has_surfaces,
            "the scene has no surfaces: the layers of depth, normals and object ids are empty",
        ),
    ];
    let told = all.into_iter().filter(|(applies, _)| *applies);
    told.map(|(_, notice)| notice.to_owned()).collect()
}

impl CompositingPasses {
    /// Adds the passes that draw the picture without lines, from the same layers and sides of lines as the frame. A
    /// `mask` is read too.
    pub fn plan(
        frame: &mut FrameGraph,
        grids: &Grids,
        features: LineFeatures,
        (layers, mask): (&Layers, Option<ResourceId>),
        sides: [ResourceId; 2],
    ) -> Self {
        let [ids, _] = frame.ids_without_hulls(grids, features.hull);
        let compose = frame.graph.uniform::<Compose>("compose without lines");
        let bare = frame
            .graph
            .buffer::<u32>("without lines", grids.output_pixels());
        frame.compose_frame(compose, ids, layers, sides, bare);
        let has_ribbons = features.layers & Compose::RIBBONS != 0;
        Self {
            compose,
            bare,
            ids,
            ribbons: has_ribbons.then_some(layers.ribbons),
            mask: mask.map(|mask| (mask, grids.mask)),
            posed: frame.posed,
            samples: grids.samples,
        }
    }

    /// Takes memory from `budget` for the layers of a frame of this size, and its stages where it `has_stages`, and for
    /// what is read of a tile.
    pub fn take_memory(
        &self,
        (budget, graph): (&mut Budget, &Graph),
        (size, has_stages): ([u32; 2], bool),
    ) -> Result<(), RenderError> {
        let stages = if has_stages { STAGE_BYTES } else { 0 };
        let bytes = PIXEL_BYTES + stages;
        budget.take("the layers of the picture", pixel_count(size), bytes)?;
        let read = self.reads(true);
        let words = read.iter().map(|id| graph.resource(*id).word_count()).sum();
        Ok(budget.take("what layers are made of", words, 4)?)
    }

    /// Hands over how the picture without lines is composed, where `compose` is that of the frame.
    pub fn upload_view(
        &self,
        session: &mut dyn Session,
        compose: &Compose,
    ) -> Result<(), EngineError> {
        let bare = Compose {
            flags: compose.flags & !(Compose::RIBBONS | Compose::OVERLAY),
            ..*compose
        };
        write(session, self.compose, &[bare])
    }

    /// What is read of a tile beside its picture; vertices are the same in all tiles.
    pub fn reads(&self, is_first: bool) -> Vec<ResourceId> {
        let posed = is_first.then_some(self.posed);
        let pictures = [self.bare, self.ids].into_iter();
        let mask = self.mask.map(|(mask, _)| mask);
        let pictures = pictures.chain(self.ribbons).chain(mask);
        pictures.chain(posed).collect()
    }

    /// Takes the vertices of a model out of what was read of the first tile.
    pub fn take_posed(&self, model: &Model, read: &mut Readings) -> Vec<PosedVertex> {
        read.take_first(self.posed, model.vertices.len())
    }

    /// Gives the pixels of a frame their layers, in the kept part of the tile whose picture is `shown` and whose other
    /// pictures were read. O(pixels), parallel over rows.
    pub fn paste(
        &self,
        seen: Seen<'_>,
        (shown, read): (&[u32], &mut Readings),
        (tiles, origin): (&Tiles, [u32; 2]),
        frame: &mut Frame,
    ) {
        // Lay the pictures that were read over the tile.
        let size = tiles.size();
        let (corner, extent) = (tiles.corner_px(origin), size.map(|side| side as f32));
        let over = |grid| Window::over(seen.view.frame_px, corner, extent, grid);
        let tile = Tile {
            seen,
            samples: self.samples,
            window: over(size.map(|side| side * self.samples)),
            shown,
            bare: read.take(self.bare),
            ids: read.take(self.ids),
            ribbons: self.ribbons.map(|ribbons| read.take(ribbons)),
            mask: self.mask.map(|(mask, size)| (read.take(mask), size)),
            size,
        };

        // Make layers of them row by row.
        let width = frame.size[0] as usize;
        let columns = tiles.kept[0].min(frame.size[0] - origin[0]) as usize;
        let rows = tiles.kept[1].min(frame.size[1] - origin[1]) as usize;
        let place =
            |row: usize, column: usize| [column as u32, row as u32].map(|at| at + tiles.margin);
        let start = origin[1] as usize * width;
        let below = frame.layers[start..].par_chunks_mut(width).take(rows);
        if frame.stages.is_empty() {
            below.enumerate().for_each(|(row, pixels)| {
                let pixels = &mut pixels[origin[0] as usize..][..columns];
                for (column, pixel) in pixels.iter_mut().enumerate() {
                    (*pixel, _) = tile.pixel(place(row, column));
                }
            });
            return;
        }

        // Note the stages beside them.
        let both = below.zip(frame.stages[start..].par_chunks_mut(width).take(rows));
        both.enumerate().for_each(|(row, (layers, stages))| {
            let layers = layers[origin[0] as usize..][..columns].iter_mut();
            let stages = &mut stages[origin[0] as usize..][..columns];
            for (column, (layer, stage)) in layers.zip(stages).enumerate() {
                (*layer, *stage) = tile.pixel(place(row, column));
            }
        });
    }
}

/// A model as a camera sees it.
#[derive(Clone, Copy)]
pub(crate) struct Seen<'a> {
    pub model: &'a Model,
    pub view: &'a View,
    /// Vertices in the view.
    pub posed: &'a [PosedVertex],
}

impl Seen<'_> {
    /// What a place of the frame shows of a triangle.
    fn surface(&self, triangle: u32, frame_px: [f32; 2]) -> LayerPixel {
        let triangle = &self.model.triangles[triangle as usize];
        let corners = triangle.corners.map(|v| &self.posed[v as usize]);
        let clip = corners.map(|v| v.clip);
        let weights = weights_at(clip, self.view.ndc_at(frame_px));
        let side = if faces_eye(clip) { 1.0 } else { -1.0 };
        let normal = unit_or_z(blend3(weights, corners.map(|v| v.normal)));
        LayerPixel {
            depth: blend(weights, corners.map(|v| v.depth)),
            normal: normal.map(|n| n * side),
            object: self.model.parts[triangle.part as usize].object + 1,
            ..LayerPixel::EMPTY
        }
    }
}

/// A tile as the passes left it, in words of its pictures.
struct Tile<'a> {
    seen: Seen<'a>,
    samples: u32,
    /// The grid of colour samples.
    window: Window,
    /// Size of the output in pixels.
    size: [u32; 2],
    shown: &'a [u32],
    bare: Vec<u32>,
    ids: Vec<u32>,
    ribbons: Option<Vec<u32>>,
    /// The mask with its size.
    mask: Option<(Vec<u32>, [u32; 2])>,
}

impl Tile<'_> {
    /// The layers of a pixel, and what it is on the way to the picture but for its stroke.
    fn pixel(&self, [x, y]: [u32; 2]) -> (LayerPixel, StagePixel) {
        let at = (y * self.size[0] + x) as usize;
        let ribbon = self.ribbons.as_ref().map_or(0, |ribbons| ribbons[at]);
        let coverage = (ribbon >> 24) as f32 / 255.0;
        let [shown, bare] = [self.shown[at], self.bare[at]].map(u32::to_le_bytes);
        let (nearest, triangle) = self.nearest_surface([x, y]);
        let layers = LayerPixel {
            line: line_between(shown, bare, coverage),
            ..nearest
        };
        let parts = &self.seen.model.parts;
        let material_of = |number: u32| {
            let part = self.seen.model.triangles[number as usize].part;
            parts[part as usize].material + 1
        };
        let stages = StagePixel {
            surface: bare,
            triangle: triangle.map_or(0, |number| number + 1),
            material: triangle.map_or(0, material_of),
            mask: self.mask_at([x, y]),
            kind: None,
        };
        (layers, stages)
    }

    /// What the mask says at the middle of a pixel.
    fn mask_at(&self, pixel: [u32; 2]) -> u32 {
        let Some((mask, size)) = &self.mask else {
            return 0;
        };
        let [x, y] = [0, 1].map(|k| (2 * pixel[k] + 1) * size[k] / (2 * self.size[k]));
        mask[(y * size[0] + x) as usize] & MASK_KINDS
    }

    /// The nearest surface at the samples of a pixel: each triangle is asked once, in the middle of its samples, where
    /// it is shaded too. The first of equally near ones, with its number.
    fn nearest_surface(&self, [x, y]: [u32; 2]) -> (LayerPixel, Option<u32>) {
        let samples: [(u32, [f32; 2]); 4] = std::array::from_fn(|i| {
            // A single sample counts four times.
            let [right, below] = [i & 1, i >> 1].map(|step| step as u32 % self.samples);
            let [x, y] = [x * self.samples + right, y * self.samples + below];
            let at = (y * self.window.size[0] + x) as usize;
            (self.ids[at], self.window.frame_at(x, y))
        });
        let mut nearest = (LayerPixel::EMPTY, None);
        for (i, (id, _)) in samples.iter().enumerate() {
            let is_new = samples[..i].iter().all(|(other, _)| other != id);
            let triangle = triangle_of(*id);
            if triangle == NONE || !is_new {
                continue;
            }
            let members = samples.iter().filter(|(other, _)| other == id);
            let (count, sum) = members.fold((0.0, [0.0; 2]), |(count, sum), (_, px)| {
                (count + 1.0, [sum[0] + px[0], sum[1] + px[1]])
            });
            let surface = self.seen.surface(triangle, sum.map(|px| px / count));
            if surface.depth < nearest.0.depth {
                nearest = (surface, Some(triangle));
            }
        }
        nearest
    }
}
