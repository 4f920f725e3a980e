//! Borders between pixels that show different things.

use super::ink::LineInk;
use super::picture::{ImageScene, SurfacePicture};
use super::sheet::are_one_sheet;
use crate::screen::detect::{Detection, Detector};
use glam::DVec2;
use npr_core::geometry::NONE;
use npr_core::line_color::kind_of_border;
use npr_core::line_kind::KindSet;
use npr_core::math;
use npr_core::outline::{MASK_OWNER, Outline};
use npr_core::surface::dot;
use rayon::prelude::*;

/// All bits of detection that tell which kind of line was found.
const DETECTS: u32 = Outline::DEPTH
    | Outline::NORMAL
    | Outline::OBJECT_ID
    | Outline::MATERIAL_ID
    | Outline::PLANE_DEPTH
    | Outline::PIECE;

/// The side that two pixels share, and the line that runs along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Border {
    /// Twice the number of its pixel, and 0 for the pixel's left side, 1 for its upper side.
    pub side: u32,
    /// The pixel of the two whose surface the line lies on: of a contour the one in front.
    pub owner: u32,
    /// The kind of the line, a bit of [`KindSet::BITS`].
    pub kind: u32,
}

/// The borders of a picture that are lines, in the order of their sides.
///
/// They are the edges of a graph on the corners of pixels: a line goes through corners with two of them, and lines
/// meet at those with three or four.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Borders {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Ascending sides.
    pub all: Vec<Border>,
}

impl Borders {
    /// The borders of the wanted kinds, unless something in `occluder_depths` (reversed depths, if given) lies before
    /// them. O(pixels), in parallel over rows.
    ///
    /// Regions of one or two pixels are noise: they join the neighbour that they share most sides with.
    pub(super) fn of(
        picture: &SurfacePicture,
        scene: &ImageScene<'_>,
        occluder_depths: Option<&[f32]>,
    ) -> Self {
        // Say what separates two pixels.
        let outline = Outline {
            crease_cos: scene.creases.cos,
            normal_cos: scene.creases.cos,
            depth_threshold: scene.depth_threshold,
            kinds: KindSet::EDGES,
            detects: DETECTS,
            ..Outline::default()
        };
        let with = Detection {
            view: scene.view,
            window: &scene.window(),
            outline: &outline,
            parts: &scene.parts(),
        };
        let finder = Finder {
            detector: Detector::new(&with),
            picture,
            scene,
            occluder_depths,
        };

        // Look at the left and the upper side of every pixel.
        let [width, height] = picture.size;
        let rows = (0..height).into_par_iter().map(|y| {
            let pixels = y * width..(y + 1) * width;
            let sides = pixels.flat_map(|pixel| [(pixel, 0), (pixel, 1)]);
            let found = sides.filter_map(|(pixel, side)| finder.border(pixel, side));
            found.collect::<Vec<_>>()
        });
        let rows: Vec<Vec<Border>> = rows.collect();

        // Take specks out while borders of all kinds close them in; then keep the kinds asked for.
        let mut borders = Self {
            size: picture.size,
            all: rows.concat(),
        };
        borders.despeckle(picture);
        borders.all.retain(|border| border.kind & scene.kinds != 0);
        borders
    }

    /// The border along a side of a pixel.
    pub(super) fn at(&self, side: u32) -> Option<usize> {
        self.all
            .binary_search_by_key(&side, |border| border.side)
            .ok()
    }

    /// The pixels on both sides of all borders, as ink of the pixels that own them.
    pub fn ink(&self) -> LineInk {
        let mut ink = LineInk::new(self.size);
        for border in &self.all {
            let pixels = self.beside(border.side);
            // A pixel that owns a line is its own.
            for pixel in pixels.filter(|pixel| *pixel != border.owner) {
                if ink.owners[pixel as usize] == NONE {
                    ink.owners[pixel as usize] = border.owner;
                }
            }
            ink.add(border.owner, border.kind, 0);
        }
        ink
    }

    /// The pixels on both sides of a side.
    fn beside(&self, side: u32) -> impl Iterator<Item = u32> + use<> {
        let [pixel, step] = [side / 2, if side & 1 == 0 { 1 } else { self.size[0] }];
        [pixel - step, pixel].into_iter()
    }

    /// The four sides of a pixel, each with the pixel beyond: left, right, above, below. Sides beyond the picture
    /// have no number.
    fn sides_of(&self, pixel: u32) -> [Option<(u32, u32)>; 4] {
        let [width, height] = self.size;
        let [x, y] = [pixel % width, pixel / width];
        [
            (x > 0).then(|| (2 * pixel, pixel - 1)),
            (x + 1 < width).then(|| (2 * pixel + 2, pixel + 1)),
            (y > 0).then(|| (2 * pixel + 1, pixel - width)),
            (y + 1 < height).then(|| (2 * (pixel + width) + 1, pixel + width)),
        ]
    }

    /// Removes specks: a region of one or two pixels loses its borders with the surface that it shares most sides with,
    /// with its own surface first of all.
    fn despeckle(&mut self, picture: &SurfacePicture) {
        let mut dropped = vec![false; self.all.len()];
        for index in 0..self.all.len() {
            for pixel in self.beside(self.all[index].side) {
                let Some(speck) = self.speck(pixel) else {
                    continue;
                };
                let surface = |pixel: u32| picture.pixels[pixel as usize].part;
                let walls: Vec<(usize, u32)> = speck
                    .iter()
                    .flat_map(|pixel| self.sides_of(*pixel).into_iter().flatten())
                    .filter_map(|(side, beyond)| Some((self.at(side)?, surface(beyond))))
                    .collect();
                // A speck that was joined already stays so.
                if walls.iter().any(|(wall, _)| dropped[*wall]) {
                    continue;
                }
                let own = surface(speck[0]);
                let shared = |wanted: u32| {
                    let count = walls.iter().filter(|(_, beyond)| *beyond == wanted).count();
                    (wanted == own, count, u32::MAX - wanted)
                };
                let most = walls
                    .iter()
                    .map(|(_, beyond)| *beyond)
                    .max_by_key(|beyond| shared(*beyond));
                for (wall, beyond) in &walls {
                    dropped[*wall] |= Some(*beyond) == most;
                }
            }
        }
        let mut dropped = dropped.into_iter();
        self.all.retain(|_| dropped.next() == Some(false));
    }

    /// The region of one or two pixels around a pixel, if borders or the picture's edge enclose it.
    fn speck(&self, pixel: u32) -> Option<Vec<u32>> {
        let open = |pixel: u32| {
            let sides = self.sides_of(pixel).into_iter().flatten();
            sides
                .filter(|(side, _)| self.at(*side).is_none())
                .map(|(_, beyond)| beyond)
                .collect::<Vec<u32>>()
        };
        match open(pixel)[..] {
            [] => Some(vec![pixel]),
            [other] if open(other)[..] == [pixel] => Some(vec![pixel.min(other), pixel.max(other)]),
            _ => None,
        }
    }
}

impl SurfacePicture {
    /// The borders between pixels that are lines of the wanted kinds, unless something in `occluder_depths` (reversed
    /// depths, if given) lies before them.
    pub fn borders(&self, scene: &ImageScene<'_>, occluder_depths: Option<&[f32]>) -> Borders {
        Borders::of(self, scene, occluder_depths)
    }
}

/// The input of finding borders.
struct Finder<'a> {
    detector: Detector<'a>,
    picture: &'a SurfacePicture,
    scene: &'a ImageScene<'a>,
    occluder_depths: Option<&'a [f32]>,
}

impl Finder<'_> {
    /// The border along the left side of a pixel (0) or its upper one (1).
    fn border(&self, pixel: u32, side: u32) -> Option<Border> {
        let width = self.picture.size[0];
        let other = match side {
            0 if pixel.is_multiple_of(width) => return None,
            0 => pixel - 1,
            _ => pixel.checked_sub(width)?,
        };
        let [first, second] = [other, pixel].map(|at| &self.picture.pixels[at as usize]);
        let mut kinds = self.detector.kinds(first, second, 2 * side + 1);
        let is_one_part = kinds & (Outline::OBJECT_ID | Outline::MATERIAL_ID | Outline::PIECE) == 0;
        if kinds & Outline::DEPTH != 0
            && is_one_part
            && self.are_one_sheet([other, pixel]) == Some(true)
        {
            // At the rim of a round surface depth jumps between its own pixels.
            kinds &= !Outline::DEPTH;
        }
        if kinds == 0 {
            return None;
        }
        let marks = self.detector.marks(first, second, kinds, 2 * side + 1);
        let [is_first, is_second] = marks.map(|mark| mark & MASK_OWNER != 0);
        let kind = if is_first || is_second {
            kind_of_border(marks[usize::from(!is_first)]).bit()
        } else if marks == [Outline::NORMAL; 2] {
            self.hidden_kind(pixel, other)?
        } else {
            return None;
        };
        let is_nearer = is_first || (!is_second && first.depth < second.depth);
        let owner = match kind {
            KindSet::CONTOUR if is_nearer => other,
            KindSet::CONTOUR => pixel,
            _ => self.owner_between([other, pixel]),
        };
        self.is_drawn(owner)
            .then(|| self.seen(pixel, side, owner, kind))
            .flatten()
    }

    fn is_drawn(&self, pixel: u32) -> bool {
        let surface = self.picture.pixels[pixel as usize].part;
        self.scene.is_drawn.get(surface as usize) != Some(&false)
    }

    /// Which of two pixels owns the line where surfaces meet. Neither is in front, and rounding would decide between
    /// depths, so the order of surfaces decides, among those with lines; at a crease, the pixel that is turned to the
    /// eye more.
    fn owner_between(&self, pixels: [u32; 2]) -> u32 {
        let order = |pixel: u32| {
            let surface = &self.picture.pixels[pixel as usize];
            let normal = math::unpack_unit(surface.normal);
            let facing = dot(normal, self.scene.view.forward_world).abs();
            (!self.is_drawn(pixel), surface.part, -facing)
        };
        let [a, b] = pixels.map(order);
        let is_first = (a.0, a.1)
            .cmp(&(b.0, b.1))
            .then(a.2.total_cmp(&b.2))
            .is_le();
        pixels[usize::from(!is_first)]
    }

    fn seen(&self, pixel: u32, side: u32, owner: u32, kind: u32) -> Option<Border> {
        self.picture
            .is_clear(self.occluder_depths, owner as usize)
            .then_some(Border {
                side: 2 * pixel + side,
                owner,
                kind,
            })
    }

    /// Whether two pixels show one sheet of a surface; `None` if that cannot be told.
    fn are_one_sheet(&self, pixels: [u32; 2]) -> Option<bool> {
        let width = self.picture.size[0];
        let middles = pixels.map(|pixel| {
            let place = [pixel % width, pixel / width];
            DVec2::from(place.map(|at| f64::from(at) + 0.5))
        });
        let faces = pixels.map(|pixel| self.picture.faces[pixel as usize]);
        let are_seen = faces.iter().all(|face| *face != NONE);
        let (shape, view) = (self.scene.shape, self.scene.view);
        are_seen
            .then(|| are_one_sheet(shape, view, middles, faces))
            .flatten()
    }

    /// The kind of line between two pixels of a surface seen at a grazing angle, where depths and normals cannot tell.
    fn hidden_kind(&self, pixel: u32, other: u32) -> Option<u32> {
        if self.share_crease(pixel, other) {
            return Some(KindSet::CREASE);
        }
        let is_cut = self.are_one_sheet([other, pixel]) == Some(false);
        is_cut.then_some(KindSet::CONTOUR)
    }

    /// Whether two pixels show faces on both sides of an edge that is a crease.
    fn share_crease(&self, pixel: u32, other: u32) -> bool {
        let shape = self.scene.shape;
        let [a, b] = [pixel, other].map(|at| self.picture.faces[at as usize]);
        if a == NONE || b == NONE {
            return false;
        }
        let edges = (3 * a..3 * a + 3).map(|half_edge| shape.edge_of[half_edge as usize]);
        edges.into_iter().any(|edge| {
            let creases = self.scene.creases;
            let is_sharp = shape.fold_cos(edge, creases.from) < creases.cos;
            is_sharp && shape.sides(edge).iter().any(|side| side / 3 == b)
        })
    }
}
