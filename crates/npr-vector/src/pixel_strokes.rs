//! Strokes from pixels: the image-space path of [Jiang et al. 2022], as published.
//!
//! Contour edges are drawn into a picture one pixel wide, the sides of its pixels are linked to closed loops as
//! Potrace does [Selinger 2003], loops are put in rows, and what of them runs along a contour becomes strokes. Read
//! the files in this order:
//!
//! 1. [`edge`]: which edges are drawn, and which way round;
//! 2. [`segment`]: cut to the view and projected; [`fragment`]: drawn by two parallel passes, tested softly against
//!    the depths of surfaces ([`surface`]), then the nearest wins;
//! 3. [`side`]: sides of pixels and what follows each; ranking is [`crate::rank`]'s, with Morton codes for keys;
//! 4. [`looped`]: specks dropped, loops smoothed, tangents fitted;
//! 5. [`strip`]: what runs against its contour is culled, the rest cut to strips;
//! 6. [`stroke`]: strips become runs with depth, kind and identity.
//!
//! Each step is a plain function over slices and the twin of a pass. [`trace`] and [`Traced::runs`] put them together.
//!
//! The method is kept as it is, weaknesses too, so that results can be held against the literature: lines are lost
//! where they pass within a pixel of each other, ends waver by some pixels where two curves meet, small loops vanish,
//! and corners get round. Faults of the publication's prototype are not kept; what says "Differs" names them. Lines
//! of [`crate::mesh_lines::draw`] have none of these.

pub mod edge;
pub mod fragment;
pub mod looped;
pub mod planar;
pub mod segment;
pub mod side;
pub mod strip;
pub mod stroke;
pub mod surface;
#[cfg(test)]
mod tests;

use crate::mesh_lines::contour::steps::Viewer;
use crate::mesh_lines::contour::{Eye, facing};
use crate::rank::place::Standing;
use crate::rank::scan::{compact, exclusive_scan};
use crate::rank::{RankError, Ranked, walk, wyllie};
use edge::{Facing, drawn_edges, mark_edges};
use fragment::{BITS_A_WORD, Fragment, draw_nearest, emit_fragments, test_fragments};
use npr_core::crease::Creases;
pub use npr_core::published_path::PublishedPath;
use npr_core::window::View;
use npr_mesh::half_edge::HalfEdgeMesh;
use segment::{Drawn, PixelView, Segment, project_edges};
use side::{Ink, InkPicture, PIXELS_A_WORD, Side, link_sides, mark_sides};
pub use surface::scene_depths;

/// Bytes for each pixel of a picture that [`trace`] takes: what shows, how deep, and the sides.
pub const BYTES_PER_PIXEL: u64 = 32;

/// Fragments that are made at once.
const BATCH: u32 = 1 << 20;

/// The input of [`trace`].
#[derive(Debug, Clone, Copy)]
pub struct PixelScene<'a> {
    /// The surface.
    pub shape: &'a HalfEdgeMesh,
    /// The camera and the picture.
    pub view: &'a View,
    /// The eye, as decisions about facing read it.
    pub eye: &'a Eye,
    /// Bits of [`npr_core::line_kind::KindSet::BITS`] that are drawn; intersections are no mesh edges and have
    /// no lines here.
    pub kinds: u32,
    /// Which edges are creases.
    pub creases: Creases,
    /// For every surface of the shape whether it has lines; empty where all have.
    pub is_drawn: &'a [bool],
}

impl PixelScene<'_> {
    /// The view as passes read it.
    pub fn pixel_view(&self, path: &PublishedPath) -> PixelView {
        let path = path.within_limits();
        PixelView {
            fine: path.oversampling as f32,
            wanted: self.kinds,
            tolerance: path.depth_tolerance * radius_of(self.shape),
            least_visible: path.least_visible,
            is_convex_only: u32::from(path.convex_only),
            ..PixelView::new(self.view)
        }
    }
}

/// Half the diagonal of the box around a shape.
fn radius_of(shape: &HalfEdgeMesh) -> f32 {
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

/// The sides of the pixels of a picture of lines, in rows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Traced {
    /// Width and height of the picture.
    pub size: [u32; 2],
    /// The view that it was drawn for.
    pub view: PixelView,
    /// All edges drawn, as they lie on the fine grid.
    pub segments: Vec<Segment>,
    /// The sides of all pixels that show a segment.
    pub sides: Vec<Side>,
    /// The numbers of all sides, loop after loop.
    pub order: Vec<u32>,
    /// The place of every side in its loop.
    pub standings: Vec<Standing>,
}

/// Draws the lines of a view into a picture and ranks the sides of its pixels. `scene` is [`scene_depths`], or nearer
/// where something else hides lines.
///
/// O(edges + fragments + pixels + sides log sides). A picture without pixels gives an empty result.
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

    // Draw the lines, pixel by pixel, before the scene.
    let (segments, counts) = segments_of(on, &view);
    let Drawing {
        owners,
        nearest,
        ink,
    } = draw(&view, scene, &segments, &counts);

    // Link and rank the sides of the ink.
    let picture = InkPicture {
        ink: Ink {
            size: view.size,
            pixels: &owners,
        },
        nearest: &nearest,
        segments: &segments,
    };
    let (sides, ranked) = ranked_sides(&picture, &ink, path.round_limit())?;
    Ok(Traced {
        size: view.size,
        view,
        standings: standings_of(&ranked),
        order: ranked.order,
        segments,
        sides,
    })
}

/// The edges drawn as segments, each with its number of fragments.
fn segments_of(on: &PixelScene<'_>, view: &PixelView) -> (Vec<Segment>, Vec<u32>) {
    // Mark the edges that are lines in this view.
    let edges = drawn_edges(on.shape, on.creases, on.is_drawn);
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

    // List them, and project them to segments.
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

/// A picture of lines.
struct Drawing {
    /// The number of every pixel's segment, plus one.
    owners: Vec<u32>,
    /// Its reversed depth, as bits.
    nearest: Vec<u32>,
    /// A bit for each pixel, set where it shows a line.
    ink: Vec<u32>,
}

/// Draws segments before a scene. Fragments are made, tested and drawn for a batch of segments at a time.
fn draw(view: &PixelView, scene: &[f32], segments: &[Segment], counts: &[u32]) -> Drawing {
    let mut picture = Drawing {
        owners: vec![0; scene.len()],
        nearest: vec![0; scene.len()],
        ink: vec![0; scene.len().div_ceil(BITS_A_WORD)],
    };
    let mut first = 0;
    while first < segments.len() {
        // Take as many segments as a batch of fragments holds.
        let mut last = first;
        let mut count = 0;
        while last < segments.len() && (count == 0 || count + counts[last] <= BATCH) {
            count += counts[last];
            last += 1;
        }

        // Make their fragments, and test them against the scene.
        let (starts, total) = exclusive_scan(&counts[first..last]);
        let mut fragments = vec![Fragment::default(); total as usize];
        emit_fragments(
            view,
            &[total],
            &[(last - first) as u32],
            &starts,
            &segments[first..last],
            &mut fragments,
        );
        let mut shown = vec![0; fragments.len()];
        test_fragments(view, [scene, &[]], &fragments, &mut shown, &mut picture.ink);

        // Keep the nearest fragment of every pixel.
        for fragment in &mut fragments {
            fragment.segment += first as u32;
        }
        draw_nearest(
            &fragments,
            &shown,
            &mut picture.owners,
            &mut picture.nearest,
        );
        first = last;
    }
    picture
}

/// The sides of a picture of ink, and their ranked loops.
///
/// `ink` holds the picture's ink as bits ([`Ink::bits`]). Each loop starts at its side with the greatest Morton code,
/// loops come by that side. `rounds` bounds pointer jumping; without it the links are walked, which gives the same.
///
/// # Errors
///
/// [`RankError::Unsettled`] where the rounds are too few.
pub fn ranked_sides(
    picture: &InkPicture<'_>,
    ink: &[u32],
    rounds: Option<u32>,
) -> Result<(Vec<Side>, Ranked), RankError> {
    // Mark and link the sides.
    let word_count = picture.ink.pixels.len().div_ceil(PIXELS_A_WORD);
    let (mut masks, mut counts) = (vec![0; word_count], vec![0; word_count]);
    mark_sides(picture.ink.size, ink, &mut masks, &mut counts);
    let (starts, total) = exclusive_scan(&counts);
    let mut sides = vec![Side::default(); total as usize];
    let mut links = vec![Default::default(); total as usize];
    link_sides(&[total], picture, &masks, &starts, &mut sides, &mut links);

    // Rank their loops.
    let (next, keys): (Vec<u32>, Vec<u32>) = links.iter().map(|link| (link.next, link.key)).unzip();
    let ranked = match rounds {
        Some(_) => wyllie(&next, &keys, rounds)?,
        None => walk(&next, &keys)?,
    };
    Ok((sides, ranked))
}

/// The place of every node in its chain.
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
