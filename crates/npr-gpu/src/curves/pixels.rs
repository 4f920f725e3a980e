//! Passes that draw lines into a picture, link and rank the sides of its pixels, and cut them into strips.

use super::CurvesError;
use super::contours::write_moved;
use super::ranking::{RankedLists, Scheme, add_ranking};
use super::sums::{Compacted, Scan, add_compact, add_scan};
use super::work::{IndirectArguments, ListWork, add_work};
use crate::changes::write_changes;
use crate::engine::{Readings, Session};
use crate::graph::{Graph, ResourceId, area};
use crate::pass::Format;
use crate::passes::{pixels, vector};
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_vector::mesh_lines::contour::steps::{Viewer, judges};
use npr_vector::pixel_strokes::edge::DrawnEdge;
use npr_vector::pixel_strokes::fragment::{BITS_A_WORD, Fragment};
use npr_vector::pixel_strokes::looped::{Filter, SpeckRule, Spot};
use npr_vector::pixel_strokes::planar::Planar;
use npr_vector::pixel_strokes::segment::{PixelView, Segment};
use npr_vector::pixel_strokes::side::{PIXELS_A_WORD, Side};
use npr_vector::pixel_strokes::strip::{CullRule, StripSpot};
use npr_vector::pixel_strokes::{PixelScene, PublishedPath};
use npr_vector::rank::Link;

/// Number of elements of each kind that there is room for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelRoom {
    /// Edges drawn.
    pub segments: usize,
    /// Their fragments.
    pub fragments: usize,
    /// Sides of pixels.
    pub sides: usize,
}

impl PixelRoom {
    /// Enough for most views.
    pub const FIRST: Self = Self {
        segments: 4096,
        fragments: 1 << 16,
        sides: 1 << 15,
    };

    /// Whether there is room for `needed`.
    pub(super) fn holds(self, needed: Self) -> bool {
        let pairs = [
            (self.segments, needed.segments),
            (self.fragments, needed.fragments),
            (self.sides, needed.sides),
        ];
        pairs.iter().all(|(room, needed)| needed <= room)
    }

    /// The next powers of two that hold both.
    pub(super) fn grown(self, needed: Self) -> Self {
        let grow = |room: usize, needed: usize| room.max(needed.next_power_of_two());
        Self {
            segments: grow(self.segments, needed.segments),
            fragments: grow(self.fragments, needed.fragments),
            sides: grow(self.sides, needed.sides),
        }
    }
}

/// Where the depths that hide lines come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hiding {
    /// The shape's surfaces, drawn by the engine.
    Surfaces,
    /// The shape's surfaces, and occluder depths that the host hands over.
    Veiled,
    /// Only the depths that the host hands over.
    Given,
}

/// The resources that [`add_pixel_contours`] adds to a graph.
#[derive(Debug, Clone, Copy)]
pub struct PixelContours {
    /// [`Viewer`]; written for every view.
    pub viewer: ResourceId,
    /// [`PixelView`]; written for every view.
    pub view: ResourceId,
    /// Coordinates of the vertices; written whenever they move.
    pub positions: ResourceId,
    /// The vertices of every face, three each; written once.
    pub corners: ResourceId,
    /// The face that decides about each face; written once.
    pub judges: ResourceId,
    /// [`DrawnEdge`]s; written once.
    pub edges: ResourceId,
    /// Reversed depths, as bits, of the occluders at every pixel; written for every view, unless only surfaces hide
    /// lines.
    pub occluder_depths: ResourceId,
    /// [`Segment`]s.
    pub segments: ResourceId,
    /// Number of edges drawn, even if they have no room: one element.
    pub segment_count: ResourceId,
    /// Number of fragments of the segments that have room: one element.
    pub fragment_count: ResourceId,
    /// [`Side`]s.
    pub sides: ResourceId,
    /// Number of sides: one element.
    pub side_count: ResourceId,
    /// The sizes of passes over the sides.
    pub side_work: ListWork,
    /// The ranked loops of the sides.
    pub lists: RankedLists,
}

/// Appends passes from a shape to the ranked sides of its contours' pixels, for a picture of `size` pixels.
///
/// Takes 10 bytes a pixel, 4 more with occluder depths and 8 with these alone, 12 a fragment, and about 200 a side.
/// Where counts exceed the room, the content is of no use, and the host runs a graph with more room. Passes over edges
/// drawn, fragments and sides work on as many as are found.
pub fn add_pixel_contours(
    graph: &mut Graph,
    shape: &HalfEdgeMesh,
    (size, hiding): ([u32; 2], Hiding),
    room: PixelRoom,
    scheme: Scheme,
) -> PixelContours {
    // Tell which faces look at the eye.
    let viewer = graph.uniform::<Viewer>("viewer");
    let view = graph.uniform::<PixelView>("pixel view");
    let positions = graph.buffer::<f32>("positions", 3 * shape.positions.len());
    let corners = graph.buffer::<u32>("corners", 3 * shape.faces.len());
    let judges = graph.buffer::<u32>("judges", shape.faces.len());
    let front = graph.buffer::<u32>("front faces", shape.faces.len());
    graph.compute(
        &vector::FACE_EYE,
        &[viewer, positions, corners, judges, front],
    );

    // Choose the edges that are drawn.
    let edge_count = shape.edge_count() + shape.polylines.len();
    let edges = graph.buffer::<DrawnEdge>("edges", edge_count);
    let flags = graph.buffer::<u32>("edge flags", edge_count);
    let marks = graph.buffer::<u32>("edge marks", edge_count);
    graph.compute(
        &pixels::MARK_EDGES,
        &[viewer, view, positions, front, edges, flags, marks],
    );

    // Project them, and count the pixels that each crosses.
    let Compacted { list, count, .. } = add_compact(graph, flags, room.segments, &ListWork::WHOLE);
    let drawn = add_work(graph, count, room.segments, IndirectArguments::default());
    let segments = graph.buffer::<Segment>("segments", room.segments);
    let counts = graph.buffer::<u32>("fragments of segments", room.segments);
    graph.compute_sized(
        &pixels::PROJECT_EDGES,
        &[view, count, list, marks, edges, positions, segments, counts],
        drawn.elements(),
    );
    let starts = add_scan(graph, counts, &drawn);

    // Draw the surfaces that may hide them.
    let surfaces = graph.image("surfaces", Format::Depth, size);
    let nearest = match hiding {
        Hiding::Given => graph.image("nearest", Format::Depth, size),
        Hiding::Surfaces | Hiding::Veiled => {
            let bound = [view, positions, corners];
            graph.draw(&pixels::DRAW_SURFACES, &bound, &[surfaces], true);
            // Once fragments are tested, their own depths may take the place of those of surfaces.
            surfaces
        }
    };
    let is_occluded = hiding != Hiding::Surfaces;
    let occluder_depths = graph.image(
        "occluder_depths",
        Format::U32,
        if is_occluded { size } else { [1; 2] },
    );

    // Draw what is seen of them, and trace the sides of their pixels.
    let picture = add_picture(
        graph,
        (view, [surfaces, occluder_depths, nearest]),
        (count, starts, segments),
        (size, room.fragments),
    );
    let (sides, side_count, links, side_work) =
        add_sides(graph, (picture, view, segments), size, (room.sides, scheme));
    PixelContours {
        viewer,
        view,
        positions,
        corners,
        judges,
        edges,
        occluder_depths,
        segments,
        segment_count: count,
        fragment_count: starts.total,
        sides,
        side_count,
        side_work,
        lists: add_ranking(graph, links, &side_work, scheme),
    }
}

/// A picture of lines.
#[derive(Debug, Clone, Copy)]
struct LinePicture {
    /// A bit for each pixel, set where it shows a line.
    ink: ResourceId,
    /// The number of its segment, plus one.
    owners: ResourceId,
    /// Its reversed depth.
    nearest: ResourceId,
}

/// Makes, tests and draws fragments; their depths are drawn into `nearest`.
fn add_picture(
    graph: &mut Graph,
    (view, [surfaces, occluder_depths, nearest]): (ResourceId, [ResourceId; 3]),
    (segment_count, starts, segments): (ResourceId, Scan, ResourceId),
    (size, room): ([u32; 2], usize),
) -> LinePicture {
    // Cut the projected edges into fragments, one for each pixel crossed.
    let Scan { prefixes, total } = starts;
    let indirect = IndirectArguments {
        vertices: pixels::DRAW_NEAREST.vertices(),
        ..IndirectArguments::default()
    };
    let work = add_work(graph, total, room, indirect);
    let fragments = graph.buffer::<Fragment>("fragments", room);
    let bound = [view, total, segment_count, prefixes, segments, fragments];
    graph.compute_sized(&pixels::EMIT_FRAGMENTS, &bound, work.elements());

    // Test which of them are seen.
    let shown = graph.buffer::<u32>("fragments shown", room);
    let ink = graph.buffer::<u32>("ink", area(size).div_ceil(BITS_A_WORD));
    let bound = [view, surfaces, occluder_depths, fragments, shown, ink];
    graph.compute_sized(&pixels::TEST_FRAGMENTS, &bound, work.elements());

    // Draw the nearest one into every pixel.
    let owners = graph.image("owners", Format::U32, size);
    graph.draw_sized(
        &pixels::DRAW_NEAREST,
        (&[view, fragments, shown], &[owners, nearest]),
        true,
        work.draw(),
    );
    LinePicture {
        ink,
        owners,
        nearest,
    }
}

/// Marks, counts and links the sides of the picture's pixels; gives these and the sizes of passes over them.
fn add_sides(
    graph: &mut Graph,
    (picture, view, segments): (LinePicture, ResourceId, ResourceId),
    size: [u32; 2],
    (room, scheme): (usize, Scheme),
) -> (ResourceId, ResourceId, ResourceId, ListWork) {
    // Count them.
    let word_count = area(size).div_ceil(PIXELS_A_WORD);
    let masks = graph.buffer::<u32>("side masks", word_count);
    let counts = graph.buffer::<u32>("sides of words", word_count);
    graph.compute(&pixels::MARK_SIDES, &[view, picture.ink, masks, counts]);
    let starts = add_scan(graph, counts, &ListWork::WHOLE);
    let work = add_work(graph, starts.total, room, scheme.indirect(room));

    // Link them.
    let sides = graph.buffer::<Side>("sides", room);
    let links = graph.buffer::<Link>("links", room);
    let bound = [
        starts.total,
        picture.owners,
        picture.nearest,
        segments,
        masks,
        starts.prefixes,
        sides,
        links,
    ];
    graph.compute_sized(&pixels::LINK_SIDES, &bound, work.elements());
    (sides, starts.total, links, work)
}

/// The resources that [`add_strips`] adds to a graph.
#[derive(Debug, Clone, Copy)]
pub struct PixelStrips {
    /// [`SpeckRule`]; written by [`PixelStrips::write`], like all below it up to `means`.
    pub speck_rule: ResourceId,
    /// [`CullRule`].
    pub cull_rule: ResourceId,
    /// [`Filter`]s and weights of places, tangents, directions and of the fit.
    pub means: [[ResourceId; 2]; 4],
    /// [`Spot`]s, in the order of loops.
    pub spots: ResourceId,
    /// Smoothed places.
    pub places: ResourceId,
    /// Unit tangents.
    pub tangents: ResourceId,
    /// Mean directions of the contours around.
    pub directions: ResourceId,
    /// Whether each side is part of a stroke.
    pub kept: ResourceId,
    /// [`StripSpot`]s.
    pub strips: ResourceId,
    /// Number of sides of each strip, at its first side.
    pub lengths: ResourceId,
}

impl PixelStrips {
    /// What a run finds, to be read.
    pub(super) fn results(&self) -> [ResourceId; 7] {
        [
            self.spots,
            self.places,
            self.tangents,
            self.directions,
            self.kept,
            self.strips,
            self.lengths,
        ]
    }
}

/// Appends passes that filter ranked loops and cut them into strips.
pub fn add_strips(graph: &mut Graph, on: &PixelContours, path: &PublishedPath) -> PixelStrips {
    // Gather the sides of pixels in the order of their loops.
    let path = path.within_limits();
    let all = on.side_work.elements();
    let count = graph.element_count(on.sides);
    let rows = on.lists.rows;
    let spots = graph.buffer::<Spot>("spots", count);
    let [mut places, mut directions] =
        ["places", "directions"].map(|name| graph.buffer::<Planar>(name, count));
    let areas = graph.buffer::<u32>("areas", count);
    let bound = [
        on.view,
        rows.order,
        rows.standings,
        on.sides,
        spots,
        places,
        directions,
        areas,
    ];
    graph.compute_sized(&pixels::GATHER_SIDES, &bound, all);

    // Drop loops that are specks.
    let sums = add_scan(graph, areas, &on.side_work).prefixes;
    let speck_rule = graph.uniform::<SpeckRule>("speck rule");
    let whole = graph.buffer::<u32>("loops kept", count);
    let bound = [speck_rule, spots, areas, sums, whole];
    graph.compute_sized(&pixels::DROP_SPECKS, &bound, all);

    // Weigh the neighbours that means are taken over.
    let radii = [
        path.smooth_radius,
        path.tangent_radius,
        path.direction_radius,
        path.fit_radius,
    ];
    let means = radii.map(|radius| {
        let filter = graph.uniform::<Filter>("means");
        let weights = graph.buffer::<f32>("weights", radius as usize + 1);
        [filter, weights]
    });
    let [of_places, of_tangents, of_directions, of_fit] = means;
    let smoothed = |graph: &mut Graph, [filter, weights]: [ResourceId; 2], from| {
        let to = graph.buffer::<Planar>("smoothed", count);
        let bound = [filter, weights, spots, from, to];
        graph.compute_sized(&pixels::SMOOTH_LOOPS, &bound, all);
        to
    };

    // Smooth the stairs of pixels away, then find tangents.
    let raw = places;
    for _ in 0..path.smooth_passes {
        places = smoothed(graph, of_places, places);
    }
    let mut tangents = graph.buffer::<Planar>("tangents", count);
    let [fit, tent] = of_fit;
    let bound = [fit, tent, spots, places, tangents];
    graph.compute_sized(&pixels::FIT_TANGENTS, &bound, all);
    for _ in 0..path.tangent_passes {
        tangents = smoothed(graph, of_tangents, tangents);
    }
    directions = smoothed(graph, of_directions, directions);

    // Keep the sides along which a loop runs as the contour does, by a vote of those around.
    let cull_rule = graph.uniform::<CullRule>("cull rule");
    let [culled, voted, kept] =
        ["culled", "voted", "kept"].map(|name| graph.buffer::<u32>(name, count));
    let bound = [cull_rule, tangents, directions, whole, culled];
    graph.compute_sized(&pixels::CULL_SIDES, &bound, all);
    let bound = [cull_rule, spots, culled, voted];
    graph.compute_sized(&pixels::VOTE_SIDES, &bound, all);

    // Cut loops where sides are culled, and drop strips that are too short.
    let [strips, lengths] = add_segments(graph, spots, voted, &on.side_work);
    let bound = [cull_rule, strips, lengths, kept];
    graph.compute_sized(&pixels::DROP_SHORT, &bound, all);
    let [strips, lengths] = add_segments(graph, spots, kept, &on.side_work);
    PixelStrips {
        speck_rule,
        cull_rule,
        means,
        spots,
        places: if path.smooth_places { places } else { raw },
        tangents,
        directions,
        kept,
        strips,
        lengths,
    }
}

/// Cuts strips of kept sides, and measures them.
fn add_segments(
    graph: &mut Graph,
    spots: ResourceId,
    kept: ResourceId,
    work: &ListWork,
) -> [ResourceId; 2] {
    let all = work.elements();
    let count = graph.element_count(spots);
    let flags = graph.buffer::<u32>("first sides", count);
    graph.compute_sized(&pixels::START_STRIPS, &[spots, kept, flags], all);
    let Compacted { list, slots, .. } = add_compact(graph, flags, count, work);
    let strips = graph.buffer::<StripSpot>("strips", count);
    let bound = [spots, kept, flags, slots, list, strips];
    graph.compute_sized(&pixels::RANK_STRIPS, &bound, all);
    let lengths = graph.buffer::<u32>("lengths of strips", count);
    let bound = [spots, kept, strips, lengths];
    graph.compute_sized(&pixels::MEASURE_STRIPS, &bound, all);
    [strips, lengths]
}

impl PixelStrips {
    /// Hands the constants of a path to the engine.
    ///
    /// # Errors
    ///
    /// [`CurvesError::Engine`] where the engine fails.
    pub fn write(
        &self,
        session: &mut dyn Session,
        path: &PublishedPath,
    ) -> Result<(), CurvesError> {
        // Hand over what is dropped and what is culled.
        let path = &path.within_limits();
        session.write(
            self.speck_rule,
            bytemuck::cast_slice(&[SpeckRule::of(path)]),
        )?;
        session.write(self.cull_rule, bytemuck::cast_slice(&[CullRule::of(path)]))?;

        // Hand over the weights of each mean.
        let means = [
            Filter::of_places(path),
            Filter::of_tangents(path),
            Filter::of_directions(path),
            Filter::of_fit(path),
        ];
        for ([filter_id, weights_id], (filter, weights)) in self.means.iter().zip(means) {
            session.write(*filter_id, bytemuck::cast_slice(&[filter]))?;
            session.write(*weights_id, bytemuck::cast_slice(&weights))?;
        }
        Ok(())
    }
}

impl PixelContours {
    /// Hands the shape, which stays from view to view, to the engine.
    ///
    /// # Errors
    ///
    /// [`CurvesError::Engine`] where the engine fails.
    pub fn write_shape(
        &self,
        session: &mut dyn Session,
        shape: &HalfEdgeMesh,
        edges: &[DrawnEdge],
    ) -> Result<(), CurvesError> {
        session.write(self.positions, bytemuck::cast_slice(&shape.positions))?;
        session.write(self.corners, bytemuck::cast_slice(&shape.faces))?;
        session.write(self.judges, &judges(shape))?;
        session.write(self.edges, bytemuck::cast_slice(edges))?;
        Ok(())
    }

    /// Hands a shape over that differs from the one `before` by its pose alone, each with its edges.
    ///
    /// # Errors
    ///
    /// As [`Self::write_shape`].
    pub fn write_pose(
        &self,
        session: &mut dyn Session,
        (before, old_edges): (&HalfEdgeMesh, &[DrawnEdge]),
        (shape, edges): (&HalfEdgeMesh, &[DrawnEdge]),
    ) -> Result<(), CurvesError> {
        write_moved(session, [self.positions, self.judges], before, shape)?;
        write_changes(session, self.edges, old_edges, edges)?;
        Ok(())
    }

    /// Hands a view to the engine, and the depths of occluders that the engine does not draw; where `occluder_depths`
    /// is empty there are none.
    ///
    /// # Errors
    ///
    /// [`CurvesError::Engine`] where the engine fails.
    pub fn write_view(
        &self,
        session: &mut dyn Session,
        on: &PixelScene<'_>,
        path: &PublishedPath,
        occluder_depths: &[f32],
    ) -> Result<(), CurvesError> {
        let view = on.pixel_view(path);
        session.write(self.viewer, bytemuck::cast_slice(&[Viewer::from(on.eye)]))?;
        session.write(self.view, bytemuck::cast_slice(&[view]))?;
        session.write(self.occluder_depths, bytemuck::cast_slice(occluder_depths))?;
        Ok(())
    }

    /// What a run finds, to be read.
    pub(super) fn results(&self) -> Vec<ResourceId> {
        let counts = [self.segment_count, self.fragment_count, self.side_count];
        let found = [self.segments, self.sides];
        [&counts[..], &found, &self.lists.results()].concat()
    }

    /// The counts that a run found.
    pub(super) fn needed(&self, read: &mut Readings) -> PixelRoom {
        PixelRoom {
            segments: read.take_count(self.segment_count),
            fragments: read.take_count(self.fragment_count),
            sides: read.take_count(self.side_count),
        }
    }
}
