//! Turns ranked loops into runs of lines.

use super::looped::{
    Filter, Gathered, Ordered, SpeckRule, Spot, drop_specks, fit_tangents, gather_sides,
    smooth_loops,
};
use super::planar::Planar;
use super::segment::Segment;
use super::strip::{CullRule, StripSpot, Strips, cull_sides, drop_short, strips, vote_sides};
use super::{PublishedPath, Traced};
use crate::mesh_lines::corner::split;
use crate::mesh_lines::draw::{StrokeLook, strokes_of};
use crate::mesh_lines::run::{Run, RunPoint, base_id, number};
use crate::project::Projector;
use crate::rank::hash_key;
use crate::rank::scan::exclusive_scan;
use crate::stroke::{Kind, Stroke};
use crate::surface_location::{SurfaceLocation, share_along};
use npr_core::edge_flags::EdgeFlags;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use std::collections::BTreeMap;

/// Loops on their way to strokes: smoothed, culled and cut.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Loops {
    /// The loop of each side, in the order of loops.
    pub spots: Vec<Spot>,
    /// Its smoothed place, in pixels.
    pub places: Vec<Planar>,
    /// Unit tangent of its loop.
    pub tangents: Vec<Planar>,
    /// Mean unit direction of the contours around it.
    pub directions: Vec<Planar>,
    /// 1 if the side is part of a stroke, else 0.
    pub kept: Vec<u32>,
    /// The strips that become strokes.
    pub strips: Strips,
}

impl Loops {
    /// Filters and cuts what was traced. O(sides * radius).
    pub fn new(traced: &Traced, path: &PublishedPath) -> Self {
        let path = &path.within_limits();
        let count = traced.order.len();
        let mut loops = Self {
            spots: vec![Spot::default(); count],
            places: vec![Planar::default(); count],
            tangents: vec![Planar::default(); count],
            directions: vec![Planar::default(); count],
            kept: vec![0; count],
            strips: Strips::default(),
        };

        // Gather the sides in their order around the ink.
        let mut areas = vec![0; count];
        let on = Ordered {
            width: traced.size[0],
            order: &traced.order,
            standings: &traced.standings,
            sides: &traced.sides,
        };
        let into = Gathered {
            spots: &mut loops.spots,
            places: &mut loops.places,
            directions: &mut loops.directions,
            areas: &mut areas,
        };
        gather_sides(&on, into);

        // Drop specks, then smooth and cut what is left.
        let (sums, _) = exclusive_scan(&areas);
        drop_specks(
            &SpeckRule::of(path),
            &loops.spots,
            &areas,
            &sums,
            &mut loops.kept,
        );
        loops.smooth(path);
        loops.cut(path);
        loops
    }

    /// Smooths places, fits tangents and smooths them, and averages directions.
    fn smooth(&mut self, path: &PublishedPath) {
        let spots = &self.spots;
        let smoothed = |(filter, weights): &(Filter, Vec<f32>), from: &[Planar]| {
            let mut to = vec![Planar::default(); from.len()];
            smooth_loops(filter, weights, spots, from, &mut to);
            to
        };

        // Smooth the stairs of the pixels.
        let of_places = Filter::of_places(path);
        let raw = self.places.clone();
        for _ in 0..path.smooth_passes {
            self.places = smoothed(&of_places, &self.places);
        }

        // Fit tangents to that; strokes go through the smoothed places or the raw ones.
        let (fit, tent) = Filter::of_fit(path);
        fit_tangents(&fit, &tent, spots, &self.places, &mut self.tangents);
        if !path.smooth_places {
            self.places = raw;
        }

        // Smooth tangents and directions.
        let of_tangents = Filter::of_tangents(path);
        for _ in 0..path.tangent_passes {
            self.tangents = smoothed(&of_tangents, &self.tangents);
        }
        self.directions = smoothed(&Filter::of_directions(path), &self.directions);
    }

    /// Culls sides and cuts the others into strips; short strips are dropped, then all is cut anew.
    fn cut(&mut self, path: &PublishedPath) {
        let rule = CullRule::of(path);
        let mut culled = vec![0; self.kept.len()];
        cull_sides(
            &rule,
            &self.tangents,
            &self.directions,
            &self.kept,
            &mut culled,
        );
        vote_sides(&rule, &self.spots, &culled, &mut self.kept);
        let found = strips(&self.spots, &self.kept);
        drop_short(&rule, &found.spots, &found.lengths, &mut self.kept);
        self.strips = strips(&self.spots, &self.kept);
    }

    /// The sides of every strip, and whether it is a whole loop; strips by the place of their first side.
    pub fn strips(&self) -> impl Iterator<Item = (Vec<u32>, bool)> + '_ {
        let sides = (0..).zip(&self.strips.spots);
        let starts = sides.filter(|(side, spot): &(u32, &StripSpot)| spot.start == *side);
        starts.map(|(start, _)| {
            let spot = self.spots[start as usize];
            let length = self.strips.lengths[start as usize];
            let after = |at: &u32| Some(spot.after(*at));
            let sides = std::iter::successors(Some(start), after).take(length as usize);
            let is_whole = length == spot.length;
            let is_cut = self.kept[spot.before(start) as usize] == 0;
            (sides.collect(), is_whole && !is_cut)
        })
    }
}

impl Traced {
    /// The strokes of the picture with the widths and colours of `look`; runs are cut at corners that turn by at least
    /// `split` radians. O(sides * radius).
    pub fn strokes(
        &self,
        shape: &HalfEdgeMesh,
        projector: &Projector,
        loops: &Loops,
        split_at: Option<f32>,
        look: &StrokeLook<'_>,
    ) -> Vec<Stroke> {
        let mut runs = self.runs(shape, projector, loops);
        if let Some(least_turn) = split_at {
            runs = split(runs, least_turn);
        }
        strokes_of(runs, &|run, point| look.paint(shape, run, point))
    }

    /// The strokes that the loops make, as runs of a shape.
    ///
    /// Kind and surface are those of most of its sides, since the path draws all into one picture; the identity comes
    /// from the mesh edge with the least hash. O(sides).
    pub fn runs(&self, shape: &HalfEdgeMesh, projector: &Projector, loops: &Loops) -> Vec<Run> {
        let maker = Maker {
            traced: self,
            shape,
            projector,
            loops,
        };
        let mut runs: Vec<Run> = loops
            .strips()
            .filter_map(|(sides, closed)| maker.run(&sides, closed))
            .collect();
        number(&mut runs);
        runs
    }
}

/// Makes runs from strips.
struct Maker<'a> {
    traced: &'a Traced,
    shape: &'a HalfEdgeMesh,
    projector: &'a Projector,
    loops: &'a Loops,
}

impl Maker<'_> {
    fn run(&self, sides: &[u32], closed: bool) -> Option<Run> {
        // Put the sides on the surface, and count what they show.
        let mut points: Vec<RunPoint> = Vec::with_capacity(sides.len());
        let mut kinds: BTreeMap<u32, usize> = BTreeMap::new();
        let mut surfaces: BTreeMap<u32, usize> = BTreeMap::new();
        for side in sides {
            let Some((segment, point)) = self.point(*side) else {
                continue;
            };
            *kinds.entry(segment.mark & KindSet::BITS).or_default() += 1;
            *surfaces.entry(self.surface_of(segment)).or_default() += 1;
            if points.last().is_none_or(|last| last.place != point.place) {
                points.push(point);
            }
        }

        // Let most of them say what the stroke is.
        let kind = Kind::first_of(most_common(&kinds)?)?;
        let surface = most_common(&surfaces)?;

        // Hang its identity on the mesh edge with the least hash.
        let anchor = |point: &RunPoint| (hash_key(point.edge), point.edge);
        let (_, edge) = points.iter().map(anchor).min()?;
        let is_enough = points.len() >= if closed { 3 } else { 2 };
        is_enough.then(|| Run {
            id: base_id(edge, kind),
            kind,
            surface,
            object: self.shape.surfaces[surface as usize].object,
            occluders: 0,
            closed,
            cut: [false; 2],
            beyond: [None; 2],
            part: None,
            weight: 1.0,
            points,
        })
    }

    /// The surface of the face whose winding gave a segment its direction.
    fn surface_of(&self, segment: &Segment) -> u32 {
        if let Some(polyline) = self.shape.polyline_of(segment.edge) {
            return self.shape.polyline_surfaces[polyline];
        }
        let sides = self.shape.sides(segment.edge);
        let is_reversed = EdgeFlags::REVERSED.is_in(segment.mark);
        let side = sides[usize::from(is_reversed && sides.len() > 1)];
        self.shape.face_surfaces[side as usize / 3]
    }

    /// The point of a run at a side, and the segment that it belongs to.
    fn point(&self, element: u32) -> Option<(&Segment, RunPoint)> {
        // Find the segment that inked the pixel.
        let traced = self.traced;
        let side = traced.sides[traced.order[element as usize] as usize];
        let segment = traced.segments.get(side.segment as usize)?;

        // Put the smoothed place at its depth.
        let place = self.loops.places[element as usize];
        let place = [f64::from(place.x), f64::from(place.y)];
        let depth = f64::from(traced.view.depth_of(f32::from_bits(side.nearest)));
        let world = self.projector.unproject(place, depth);
        let is_sound = world.is_finite() && place.iter().all(|v| v.is_finite());
        is_sound.then(|| {
            let ends = self.shape.ends(segment.edge).map(|v| self.shape.point(v));
            let point = RunPoint {
                place,
                depth,
                world,
                edge: segment.edge,
                t: share_along(ends, world) as f32,
                location: SurfaceLocation::along(segment.edge),
                leaps: false,
            };
            (segment, point)
        })
    }
}

/// The key with the greatest count; of several, the least.
fn most_common(counts: &BTreeMap<u32, usize>) -> Option<u32> {
    let by_count = counts
        .iter()
        .max_by_key(|(key, count)| (**count, std::cmp::Reverse(**key)));
    by_count.map(|(key, _)| *key)
}
