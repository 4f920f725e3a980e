//! Edges cut to the view and laid on the fine grid: the twin of `vector.project_edges`.
//!
//! Every operation here gives the same bits on every engine: sums and products are rounded one by one, and what a
//! division would leave to the device is taken from [`reciprocal`]. So lines cover the same pixels everywhere.

use super::edge::DrawnEdge;
use bytemuck::{Pod, Zeroable};
use npr_core::edge_flags::EdgeFlags;
use npr_core::gpu_layout;
use npr_core::surface::apply_point;
use npr_core::window::View;
use rayon::prelude::*;

/// A view as these passes read it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct PixelView {
    /// [`View::clip_from_world`].
    pub clip_from_world: [[f32; 4]; 4],
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Steps of the fine grid to a pixel.
    pub fine: f32,
    /// Bits of the kinds that are drawn.
    pub wanted: u32,
    /// 1 in perspective, 0 in parallel view.
    pub perspective: f32,
    /// Factor from reversed to view depth: `depth_scale / z` in perspective, else `depth_scale * z + depth_offset`.
    pub depth_scale: f32,
    /// See `depth_scale`.
    pub depth_offset: f32,
    /// How far behind a surface a fragment still shows, in scene units.
    pub tolerance: f32,
    /// Fewest of nine pixels that have to show a fragment.
    pub least_visible: u32,
    /// 1 if contours in valleys are left out, else 0.
    pub is_convex_only: u32,
    /// 0, which a shader compiler cannot know: with it shaders keep sums and products apart.
    pub zero: u32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: u32,
}
gpu_layout!(PixelView {
    clip_from_world,
    size,
    fine,
    wanted,
    perspective,
    depth_scale,
    depth_offset,
    tolerance,
    least_visible,
    is_convex_only,
    zero,
    unused
});

impl PixelView {
    /// A view with its projection; the settings of lines are left at zero.
    pub fn new(view: &View) -> Self {
        let [scale, offset] = depth_of_z(view);
        Self {
            clip_from_world: view.clip_from_world,
            size: view.frame_px.map(|side| side as u32),
            perspective: view.perspective,
            depth_scale: scale,
            depth_offset: offset,
            fine: 1.0,
            ..Self::default()
        }
    }

    /// View depth of a reversed depth.
    pub fn depth_of(&self, z: f32) -> f32 {
        if self.perspective > 0.5 {
            self.depth_scale * reciprocal(z)
        } else {
            self.depth_scale * z + self.depth_offset
        }
    }
}

impl PixelView {
    /// Reversed depth of a view depth: the inverse of [`PixelView::depth_of`], except for rounding.
    pub fn z_of(&self, depth: f32) -> f32 {
        if self.perspective > 0.5 {
            self.depth_scale / depth
        } else {
            (depth - self.depth_offset) / self.depth_scale
        }
    }
}

/// Factor and offset from reversed to view depth.
fn depth_of_z(view: &View) -> [f32; 2] {
    if view.perspective > 0.5 {
        return [view.near, 0.0];
    }
    // Along the view axis reversed depth falls evenly; the rows of the matrix say how fast and from where.
    let row: [f32; 4] = std::array::from_fn(|column| view.clip_from_world[column][2]);
    let dot = |v: [f32; 3]| row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
    let per_unit = dot(view.forward_world);
    if per_unit == 0.0 {
        return [0.0, view.near];
    }
    let at_eye = dot(view.eye_world) + row[3];
    [1.0 / per_unit, -at_eye / per_unit]
}

/// The greatest of the floats about `1 / b` whose product with `b` rounds to at most 1; the same bits wherever
/// division is good to four units in the last place, as WebGPU promises.
///
/// Within a unit in the last place of `1 / b` for sizes between 1e-30 and 1e30; beyond, as for the nearer of these. 0
/// counts as positive.
pub fn reciprocal(b: f32) -> f32 {
    let size = b.abs().clamp(1e-30, 1e30);
    let mut bits = (1.0 / size).to_bits() - 4;
    for _ in 0..8 {
        let next = f32::from_bits(bits + 1);
        if next * size <= 1.0 {
            bits += 1;
        }
    }
    let found = f32::from_bits(bits);
    if b < 0.0 { -found } else { found }
}

/// An edge as it lies on the fine grid.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Segment {
    /// Where it starts, in steps of the fine grid from the picture's top left corner.
    pub start: [f32; 2],
    /// Where it ends.
    pub end: [f32; 2],
    /// Reversed depth at its start; linear over the picture.
    pub start_z: f32,
    /// Reversed depth at its end.
    pub end_z: f32,
    /// The mesh edge.
    pub edge: u32,
    /// Bit of its kind, and [`EdgeFlags::REVERSED`].
    pub mark: u32,
}
gpu_layout!(Segment {
    start,
    end,
    start_z,
    end_z,
    edge,
    mark
});

impl Segment {
    /// Difference of the ends, in steps of the fine grid.
    pub fn extent(&self) -> [f32; 2] {
        [0, 1].map(|axis| self.end[axis] - self.start[axis])
    }

    /// Number of fragments: a step along the longer axis each, and at least one.
    pub fn fragment_count(&self) -> u32 {
        let [x, y] = self.extent().map(f32::abs);
        (x.max(y) + LEAST_EXTENT).ceil() as u32
    }
}

/// Added to the length of a segment, so that a point has a fragment too. Source: the publication's prototype.
const LEAST_EXTENT: f32 = 1e-4;

/// The input of [`project_edges`].
#[derive(Debug, Clone, Copy)]
pub struct Drawn<'a> {
    /// The view.
    pub view: &'a PixelView,
    /// The first is the number of edges drawn.
    pub extent: &'a [u32],
    /// Edges drawn, ascending.
    pub list: &'a [u32],
    /// Kind and direction of every edge.
    pub marks: &'a [u32],
    /// All edges.
    pub edges: &'a [DrawnEdge],
    /// Coordinates of all vertices.
    pub positions: &'a [f32],
}

/// Cuts each edge drawn to the view's six planes, projects it, and counts its fragments.
///
/// Edges outside have no fragments. Both new ends are computed from the edge's own ends, so an edge cut at both keeps
/// its line. Counts after the first `extent[0]` are 0.
///
/// Differs: the publication keeps 16-bit ends, a thirtieth of a pixel apart; here they are floats.
pub fn project_edges(on: &Drawn<'_>, segments: &mut [Segment], counts: &mut [u32]) {
    let outputs = segments.par_iter_mut().zip(counts).enumerate();
    outputs.for_each(|(element, (segment, count))| {
        *count = 0;
        if element < (on.extent[0] as usize).min(on.list.len())
            && let Some(found) = on.segment_of(on.list[element])
        {
            *segment = found;
            *count = found.fragment_count();
        }
    });
}

impl Drawn<'_> {
    fn segment_of(&self, number: u32) -> Option<Segment> {
        // Direct the edge so that its surface lies on one side.
        let edge = self.edges[number as usize];
        let mark = self.marks[number as usize];
        let is_reversed = EdgeFlags::REVERSED.is_in(mark);
        let ends = if is_reversed {
            [edge.head, edge.tail]
        } else {
            [edge.tail, edge.head]
        };

        // Cut it to the view, and find its ends in the picture.
        let [a, b] = ends.map(|vertex| self.clip(vertex));
        let [enter, leave] = kept(a, b)?;
        let from = self.place(between(a, b, enter));
        let to = self.place(between(a, b, leave));
        Some(Segment {
            start: [from[0], from[1]],
            end: [to[0], to[1]],
            start_z: from[2],
            end_z: to[2],
            edge: number,
            mark,
        })
    }

    /// Clip position of a vertex.
    fn clip(&self, vertex: u32) -> [f32; 4] {
        let position = std::array::from_fn(|i| self.positions[3 * vertex as usize + i]);
        apply_point(&self.view.clip_from_world, position)
    }

    /// Place on the fine grid and reversed depth of a clip position.
    fn place(&self, clip: [f32; 4]) -> [f32; 3] {
        let r = reciprocal(clip[3]);
        let [half_width, half_height] = self
            .view
            .size
            .map(|side| side as f32 * 0.5 * self.view.fine);
        let [x, y] = [clip[0] * r, clip[1] * r];
        [
            (x * half_width + half_width).clamp(0.0, 2.0 * half_width),
            (half_height - y * half_height).clamp(0.0, 2.0 * half_height),
            (clip[2] * r).clamp(0.0, 1.0),
        ]
    }
}

/// Distances of a clip position from the planes of the view, positive inside: left, right, bottom, top, near, far.
fn distances([x, y, z, w]: [f32; 4]) -> [f32; 6] {
    [w + x, w - x, w + y, w - y, w - z, z]
}

/// The part of an edge in the view, as two shares [Liang and Barsky 1984]; `None` if nothing is.
fn kept(a: [f32; 4], b: [f32; 4]) -> Option<[f32; 2]> {
    let (from, to) = (distances(a), distances(b));
    let (mut enter, mut leave) = (0.0_f32, 1.0_f32);
    for plane in 0..6 {
        let (start, end) = (from[plane], to[plane]);
        let is_inside = [start >= 0.0, end >= 0.0];
        let share = start * reciprocal(start - end);
        match is_inside {
            [true, true] => {}
            [false, true] => enter = enter.max(share),
            [true, false] => leave = leave.min(share),
            // What is no number lies nowhere.
            [false, false] => return None,
        }
    }
    (enter <= leave).then_some([enter, leave])
}

fn between(a: [f32; 4], b: [f32; 4], share: f32) -> [f32; 4] {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share)
}
