//! Strokes from pixels: the image-space path of [Jiang et al. 2022], as published.
//!
//! Contour edges are drawn into a picture one pixel wide, the sides of its pixels are linked to closed loops as Potrace does
//! [Selinger 2003], loops are put in rows, and what of them runs along a contour becomes strokes. Read the files in this order:
//!
//! 1. [`edge`]: which edges are drawn, and which way round;
//! 2. [`segment`]: cut to the view and projected; [`fragment`]: drawn by two parallel passes, tested softly against the depths of
//!    surfaces, then the nearest wins;
//! 3. [`side`]: sides of pixels and what follows each; ranking is [`crate::rank`]'s, with Morton codes for keys;
//! 4. [`looped`]: specks dropped, loops smoothed, tangents fitted;
//! 5. [`strip`]: what runs against its contour is culled, the rest cut to strips;
//! 6. [`stroke`]: strips become runs with depth, kind and identity.
//!
//! Each step is a plain function over slices and the twin of a pass. [`trace`] and [`Traced::runs`] put them together.
//!
//! The method is kept as it is, weaknesses too, so that results can be held against the literature: lines are lost where they
//! pass within a pixel of each other, ends waver by some pixels where two curves meet, small loops vanish, and corners get
//! round. Faults of the publication's prototype are not kept; what says "Differs" names them. Lines of [`crate::draw`] have none of these.

pub mod edge;
pub mod fragment;
pub mod looped;
pub mod segment;
pub mod side;
pub mod strip;
pub mod stroke;
#[cfg(test)]
mod tests;

use crate::contour::steps::Viewer;
use crate::contour::{Eye, facing};
use crate::rank::place::Standing;
use crate::rank::scan::{compact, exclusive_scan};
use crate::rank::{RankError, Ranked, walk, wyllie};
use edge::{Facing, drawn_edges, mark_edges};
use fragment::{Fragment, draw_nearest, emit_fragments, test_fragments};
use npr_core::geometry::{Part, Triangle};
use npr_core::raster::{Fill, Sides, fill_triangles};
use npr_core::shape::Shape;
use npr_core::window::{View, Window};
use segment::{Drawn, PixelView, Segment, project_edges};
use side::{Ink, link_sides, mark_sides};

/// Every constant of the published path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PublishedPath {
    /// Leaves out contours in valleys, which their own surface hides; default true, as published.
    pub is_convex_only: bool,
    /// Steps of the grid that lines are drawn on to a pixel, 1..8; default 2.
    pub oversampling: u32,
    /// How far behind a surface a line still shows, as a share of the scene's radius; default 0.02.
    ///
    /// Larger lets hidden lines through thin parts, smaller breaks lines on steep slopes. The publication's is absolute.
    pub depth_tolerance: f32,
    /// Of a pixel and the eight around it, how many have to show a line; default 2.
    pub least_visible: u32,
    /// Rounds of pointer jumping for each of loop breaking and ranking, of which the published 16 rank loops up to 65,536 sides; default
    /// as many as it takes.
    pub rounds: Option<u32>,
    /// A loop of less area is a speck and dropped, in pixels; default 32.
    pub speck_area: f32,
    /// A thin loop of less area is a speck too; default 64.
    pub thin_speck_area: f32,
    /// Area for each side up to which a loop is thin, in pixels; default 1.
    pub thinness: f32,
    /// Smooths places along loops; default true. Without, strokes run through the middles of sides.
    pub smooth_places: bool,
    /// Reach of the filter that smooths places and tangents, in sides, up to 64; default 16.
    pub smooth_radius: u32,
    /// Standard deviation of its Gaussian, in sides; default 5.
    pub smooth_sigma: f32,
    /// How often places and then tangents are smoothed, up to 16; default 2.
    pub smooth_passes: u32,
    /// Sides on each side that a tangent is fitted to, up to 64; default 12.
    pub fit_radius: u32,
    /// Reach of the mean of directions of contours, in sides, up to 64; default 16.
    pub direction_radius: u32,
    /// Standard deviation of that mean, in sides; default 6.5.
    pub direction_sigma: f32,
    /// Cosine between loop and contour over which a side is kept, 0..1; default 0.1.
    pub least_cos: f32,
    /// Sides on each side that vote on whether one is kept, up to 64; default 7.
    pub vote_radius: u32,
    /// By how many votes it has to win; default 2.
    pub vote_margin: u32,
    /// Strokes of at most as many sides are dropped; default 8.
    pub short: u32,
}

impl Default for PublishedPath {
    fn default() -> Self {
        Self {
            is_convex_only: true,
            oversampling: 2,
            depth_tolerance: 0.02,
            least_visible: 2,
            rounds: None,
            speck_area: 32.0,
            thin_speck_area: 64.0,
            thinness: 1.0,
            smooth_places: true,
            smooth_radius: 16,
            smooth_sigma: 5.0,
            smooth_passes: 2,
            fit_radius: 12,
            direction_radius: 16,
            direction_sigma: 6.5,
            least_cos: 0.1,
            vote_radius: 7,
            vote_margin: 2,
            short: 8,
        }
    }
}

/// Widest window along a loop, in sides on each side.
const RADIUS_LIMIT: u32 = 64;

/// Most rounds of smoothing.
const PASS_LIMIT: u32 = 16;

impl PublishedPath {
    /// The same with every value within its limits.
    pub fn within_limits(&self) -> Self {
        let radius = |radius: u32| radius.min(RADIUS_LIMIT);
        Self {
            oversampling: self.oversampling.clamp(1, 8),
            least_visible: self.least_visible.min(9),
            smooth_passes: self.smooth_passes.min(PASS_LIMIT),
            smooth_radius: radius(self.smooth_radius),
            fit_radius: radius(self.fit_radius),
            direction_radius: radius(self.direction_radius),
            vote_radius: radius(self.vote_radius),
            vote_margin: self.vote_margin.min(2 * RADIUS_LIMIT + 1),
            ..*self
        }
    }
}

/// Bytes for each pixel of a picture that [`trace`] takes: what shows, how deep, and the sides.
pub const BYTES_PER_PIXEL: u64 = 32;

/// Fragments that are made at once.
const BATCH: u32 = 1 << 20;

/// What is drawn.
#[derive(Debug, Clone, Copy)]
pub struct PixelScene<'a> {
    /// The surface.
    pub shape: &'a Shape,
    /// The camera and the picture.
    pub view: &'a View,
    /// The eye, as decisions about facing read it.
    pub eye: &'a Eye,
    /// Bits of [`crate::graph::CurveNode::KINDS`] that are drawn; intersections are no mesh edges and have no lines here.
    pub kinds: u32,
    /// From which cosine between normals on an edge is no crease.
    pub crease_cos: f32,
    /// For every surface of the shape whether it has lines; empty where all have.
    pub is_drawn: &'a [bool],
}

impl PixelScene<'_> {
    /// What passes read of the view.
    pub fn pixel_view(&self, path: &PublishedPath) -> PixelView {
        let path = path.within_limits();
        PixelView {
            fine: path.oversampling as f32,
            wanted: self.kinds,
            tolerance: path.depth_tolerance * radius_of(self.shape),
            least_visible: path.least_visible,
            is_convex_only: u32::from(path.is_convex_only),
            ..PixelView::new(self.view)
        }
    }
}

/// Half the diagonal of the box around a shape.
fn radius_of(shape: &Shape) -> f32 {
    let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
    for position in &shape.positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(position[axis]);
            high[axis] = high[axis].max(position[axis]);
        }
    }
    let square = (0..3).map(|axis| (high[axis] - low[axis]).max(0.0));
    0.5 * square.map(|side| side * side).sum::<f32>().sqrt()
}

/// Reversed depth of the surface at every pixel, 0 where there is none: what lines are tested against.
///
/// Both sides of all faces hide. O(faces + pixels), in parallel.
pub fn scene_depths(shape: &Shape, view: &View) -> Vec<f32> {
    let size = view.frame_px.map(|side| side as u32);
    let count = size[0] as usize * size[1] as usize;
    let triangles: Vec<Triangle> = shape
        .faces
        .iter()
        .map(|corners| Triangle {
            corners: *corners,
            part: 0,
        })
        .collect();
    let m = &view.clip_from_world;
    let fill = Fill {
        window: &Window::over(view.frame_px, [0.0; 2], view.frame_px, size),
        triangles: &triangles,
        parts: &[Part::default()],
        sides: Sides::Both,
        id_bits: 0,
        clip_of: |vertex: u32| {
            let [x, y, z] = shape.positions[vertex as usize];
            std::array::from_fn(|i| m[0][i] * x + m[1][i] * y + m[2][i] * z + m[3][i])
        },
        keep: |_, _, _| true,
    };
    let (mut ids, mut depths) = (vec![0; count], vec![0; count]);
    fill_triangles(&fill, &mut ids, &mut depths);
    depths.into_iter().map(f32::from_bits).collect()
}

/// A picture of lines with the sides of its pixels in rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Traced {
    /// Width and height of the picture.
    pub size: [u32; 2],
    /// The view that it was drawn for.
    pub view: PixelView,
    /// All edges drawn, as they lie on the fine grid.
    pub segments: Vec<Segment>,
    /// Number of the segment that every pixel shows plus one; 0 where it shows none.
    pub owners: Vec<u32>,
    /// Reversed depth of that fragment, as bits.
    pub nearest: Vec<u32>,
    /// Four times the pixel plus the direction of every side.
    pub sides: Vec<u32>,
    /// All sides, loop after loop.
    pub order: Vec<u32>,
    /// Where every side is in its loop.
    pub standings: Vec<Standing>,
}

/// Draws the lines of a view into a picture and puts the sides of its pixels in rows; `scene` is [`scene_depths`], or
/// nearer where something else hides lines.
///
/// O(edges + fragments + pixels + sides log sides). Of a picture without pixels nothing comes.
///
/// # Errors
///
/// [`RankError::Unsettled`] where the rounds of the path are too few.
pub fn trace(
    on: &PixelScene<'_>,
    path: &PublishedPath,
    scene: &[f32],
) -> Result<Traced, RankError> {
    let view = on.pixel_view(path);
    let count = view.size[0] as usize * view.size[1] as usize;
    if count == 0 || scene.len() != count {
        return Ok(Traced::default());
    }
    let (segments, counts) = segments_of(on, &view);
    let (owners, nearest) = draw(&view, scene, &segments, &counts);
    let ink = Ink {
        size: view.size,
        pixels: &owners,
    };
    let (sides, ranked) = ranked_sides(&ink, path.rounds)?;
    Ok(Traced {
        size: view.size,
        view,
        standings: standings_of(&ranked),
        order: ranked.order,
        segments,
        owners,
        nearest,
        sides,
    })
}

/// The edges drawn as segments, each with its number of fragments.
fn segments_of(on: &PixelScene<'_>, view: &PixelView) -> (Vec<Segment>, Vec<u32>) {
    let edges = drawn_edges(on.shape, on.crease_cos, on.is_drawn);
    let front: Vec<u32> = facing(on.shape, on.eye)
        .iter()
        .map(|f| u32::from(*f))
        .collect();
    let positions = on.shape.positions.as_flattened();
    let on_edges = Facing {
        viewer: &Viewer::from(on.eye),
        wanted: on.kinds,
        is_convex_only: view.is_convex_only != 0,
        positions,
        front: &front,
    };
    let (mut flags, mut marks) = (vec![0; edges.len()], vec![0; edges.len()]);
    mark_edges(&on_edges, &edges, &mut flags, &mut marks);
    let (slots, count) = exclusive_scan(&flags);
    let mut list = vec![0; count as usize];
    compact(&flags, &slots, &mut list);
    let mut segments = vec![Segment::default(); list.len()];
    let mut counts = vec![0; list.len()];
    let drawn = Drawn {
        view,
        extent: &[count],
        list: &list,
        marks: &marks,
        edges: &edges,
        positions,
    };
    project_edges(&drawn, &mut segments, &mut counts);
    (segments, counts)
}

/// Owners of all pixels and their reversed depths: fragments are made, tested and drawn some segments at a time.
fn draw(
    view: &PixelView,
    scene: &[f32],
    segments: &[Segment],
    counts: &[u32],
) -> (Vec<u32>, Vec<u32>) {
    let (mut owners, mut nearest) = (vec![0; scene.len()], vec![0; scene.len()]);
    let mut first = 0;
    while first < segments.len() {
        let mut last = first;
        let mut count = 0;
        while last < segments.len() && (count == 0 || count + counts[last] <= BATCH) {
            count += counts[last];
            last += 1;
        }
        let (starts, total) = exclusive_scan(&counts[first..last]);
        let mut fragments = vec![Fragment::default(); total as usize];
        emit_fragments(
            view,
            &[total],
            &starts,
            &segments[first..last],
            &mut fragments,
        );
        let mut shown = vec![0; fragments.len()];
        test_fragments(view, scene, &fragments, &mut shown);
        for fragment in &mut fragments {
            fragment.segment += first as u32;
        }
        draw_nearest(&fragments, &shown, &mut owners, &mut nearest);
        first = last;
    }
    (owners, nearest)
}

/// The sides of an image of ink, as four times pixel plus direction, and their loops in rows.
///
/// Each loop starts at its side with the greatest Morton code, loops come by that side. `rounds` bounds pointer jumping; without
/// it the links are walked, which gives the same.
///
/// # Errors
///
/// [`RankError::Unsettled`] where the rounds are too few.
pub fn ranked_sides(ink: &Ink<'_>, rounds: Option<u32>) -> Result<(Vec<u32>, Ranked), RankError> {
    let (mut masks, mut counts) = (vec![0; ink.pixels.len()], vec![0; ink.pixels.len()]);
    mark_sides(ink, &mut masks, &mut counts);
    let (starts, total) = exclusive_scan(&counts);
    let mut sides = vec![0; total as usize];
    let mut links = vec![Default::default(); total as usize];
    link_sides(&[total], ink, &masks, &starts, &mut sides, &mut links);
    let (next, keys): (Vec<u32>, Vec<u32>) = links.iter().map(|link| (link.next, link.key)).unzip();
    let ranked = match rounds {
        Some(_) => wyllie(&next, &keys, rounds)?,
        None => walk(&next, &keys)?,
    };
    Ok((sides, ranked))
}

/// Where every node is in its chain.
pub fn standings_of(ranked: &Ranked) -> Vec<Standing> {
    let fields = ranked.head.iter().zip(&ranked.rank).zip(&ranked.length);
    fields
        .map(|((head, rank), length)| Standing {
            head: *head,
            rank: *rank,
            length: *length,
        })
        .collect()
}
