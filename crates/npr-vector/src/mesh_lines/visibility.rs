//! Exact visibility: where lines of a view disappear and how many surfaces are in front.
//!
//! Along a line, what hides it changes only where its image crosses the image of an outline in front of it,
//! and where it goes through a face [Appel 1967]. So a piece is cut there, and one sight from the eye to the
//! middle of each span decides for all of it.

mod covering;
mod ink;
mod occluders;
mod outline_grid;
mod piece;
#[cfg(test)]
mod tests;

pub use covering::FaceImages;
pub(crate) use covering::Tried;
pub(crate) use ink::Ink;
pub use occluders::Occluders;
use outline_grid::NEAR_PX;
pub use outline_grid::{Outline, OutlineGrid};
pub(crate) use piece::MARGIN;
pub use piece::{Piece, PieceImage};

use crate::mesh_lines::bvh::{FaceTree, NEAR_SHARE, Sight};
use crate::project::Projector;
use glam::DVec3;
use npr_mesh::half_edge::HalfEdgeMesh;

/// Length in pixels under which a span is not examined by itself.
const LEAST_SPAN_PX: f64 = 1e-4;

/// Spans of crowded pieces shorter than this, in pixels, are left out: nobody sees them, and there may be as many as
/// faces.
const LEAST_CROWDED_PX: f64 = 1.0 / 64.0;

/// Pixels of a crowded piece for every face before it that is counted; behind more faces the piece is only visible or
/// hidden.
const PX_PER_COUNTED: f64 = 2.0;

/// What decides the visibility of one piece besides its geometry.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Circumstances {
    /// Faces that the piece lies in, which never hide it.
    pub own_faces: Vec<u32>,
    /// Places where it goes through a face, along the uncut piece in the world, 0..1.
    pub piercings: Vec<f64>,
    /// How near to a face the piece may lie without being hidden by it; 0 for lines of faces themselves.
    pub touch: f64,
}

/// A part of a piece with one visibility; shares of its image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Where it starts.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Number of surfaces in front.
    pub occluders: u32,
}

/// By how many surfaces there are more in front after a place than before it, where that is known.
pub(crate) type Change = Option<i16>;

/// A place of a piece where what hides it may change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cut {
    /// Share of the piece's image.
    pub(crate) at: f64,
    pub(crate) change: Change,
    /// The outline that is crossed, if any.
    outline: Option<u32>,
}

/// Where what hides a piece may change.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Changes {
    /// Places inside, ascending.
    pub(crate) cuts: Vec<Cut>,
    /// For each end, whether it is a vertex and nothing but the faces around that passes there.
    pub(crate) is_plain: [bool; 2],
}

/// Memory that passes from piece to piece: it changes the time taken and nothing else.
#[derive(Debug, Default)]
pub struct Memory {
    /// The last face that hid something, which is tried first.
    pub(crate) last: Option<u32>,
    tried: Tried,
}

/// What decides visibility in a view: shape, camera, outlines and smoke.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    /// The surface.
    pub shape: &'a HalfEdgeMesh,
    /// Its faces.
    pub tree: &'a FaceTree,
    /// The camera.
    pub projector: &'a Projector,
    /// The outlines of the view.
    pub outlines: &'a OutlineGrid,
    /// Where the faces lie in the picture; made when the first crowded piece asks.
    pub images: &'a FaceImages,
    /// What hides lines besides the faces, where there is any: smoke.
    pub extra: Option<&'a dyn Occluders>,
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Up to how many surfaces in front are counted; 1 only tells visible from hidden.
    pub count_limit: u32,
}

impl Seen<'_> {
    /// The spans of a piece, which cover it in order; neighbours differ. Crowded pieces ([`OutlineGrid::is_crowded`])
    /// behind more than one face for two pixels are not counted exactly: hidden parts have one surface in front.
    ///
    /// A thread lends its `memory` to one piece after the other.
    pub fn spans(
        &self,
        piece: &Piece,
        circumstances: &Circumstances,
        memory: &mut Memory,
    ) -> Vec<Span> {
        if self.outlines.is_crowded(piece) {
            return self.crowded_spans(piece, circumstances, &[], memory);
        }
        self.spans_between_outlines(piece, circumstances, memory)
    }

    /// The spans of a piece, from every outline that it crosses, however many there are.
    pub(crate) fn spans_between_outlines(
        &self,
        piece: &Piece,
        circumstances: &Circumstances,
        memory: &mut Memory,
    ) -> Vec<Span> {
        let cuts = self.changes(piece, &circumstances.piercings, None).cuts;
        let mut spans: Vec<Span> = Vec::with_capacity(1);
        let mut from = 0.0;
        for to in cuts.iter().map(|cut| cut.at).chain([1.0]) {
            let occluders = self.occluders(piece, [from, to], circumstances, &mut memory.last);
            push(&mut spans, [from, to], occluders);
            from = to;
        }
        spans
    }

    /// Makes on all threads what [`Seen::crowded_spans`] will need; no other thread may be asking for it.
    pub(crate) fn prepare(&self) {
        self.images.prepare(self);
    }

    /// The spans of a piece, from the parts of it that each face hides; the parts in `left_out`, ascending, have none.
    /// About O(log n) for each face that hides a part no other does.
    pub(crate) fn crowded_spans(
        &self,
        piece: &Piece,
        circumstances: &Circumstances,
        left_out: &[[f64; 2]],
        memory: &mut Memory,
    ) -> Vec<Span> {
        // Count the faces in front where they are few.
        let images = self.images;
        let most = (piece.length() / PX_PER_COUNTED) as usize;
        if self.count_limit > 1 && left_out.is_empty() && self.extra.is_none() {
            let parts = images.parts_by_face(self, piece, circumstances, most);
            if let Some(parts) = parts {
                return joined(counted(&parts, self.count_limit), piece);
            }
        }

        // Else tell visible from hidden, and look for smoke before what no face hides.
        let mut ends = vec![0.0];
        let hidden = images.hidden_parts(self, piece, circumstances, left_out, &mut memory.tried);
        ends.extend(hidden.as_flattened());
        ends.push(1.0);
        let mut spans: Vec<Span> = Vec::with_capacity(ends.len());
        for (pair, occluders) in ends.windows(2).zip([0, 1].into_iter().cycle()) {
            if occluders == 0 {
                self.push_occluded(piece, [pair[0], pair[1]], &mut spans);
            } else {
                push(&mut spans, [pair[0], pair[1]], 1);
            }
        }
        without(&joined(spans, piece), left_out)
    }

    /// Adds the spans of a part that no face hides; smoke may hide it.
    fn push_occluded(&self, piece: &Piece, [from, to]: [f64; 2], spans: &mut Vec<Span>) {
        let mut cuts = vec![from];
        if let Some(extra) = self.extra {
            cuts.extend(
                extra
                    .cuts(piece)
                    .into_iter()
                    .filter(|cut| from < *cut && *cut < to),
            );
        }
        cuts.push(to);
        cuts.sort_by(f64::total_cmp);
        for pair in cuts.windows(2) {
            let middle = piece.world_at(self.projector, (pair[0] + pair[1]) * 0.5);
            let is_occluded = self.extra.is_some_and(|extra| extra.hide(middle));
            push(spans, [pair[0], pair[1]], u32::from(is_occluded));
        }
    }

    /// Where what hides a piece may change, which runs along an edge between two vertices or along none.
    pub(crate) fn changes(
        &self,
        piece: &Piece,
        piercings: &[f64],
        ends: Option<[u32; 2]>,
    ) -> Changes {
        // Note which of its ends are vertices that touch no other face.
        let [from, to] = piece.range;
        let touched = |end: f64| piercings.iter().any(|t| (t - end).abs() < NEAR_SHARE);
        let is_vertex = ends.is_some() && self.extra.is_none();
        let mut changes = Changes {
            cuts: Vec::new(),
            is_plain: [
                is_vertex && from == 0.0 && !touched(0.0),
                is_vertex && to == 1.0 && !touched(1.0),
            ],
        };

        // Cross outlines, faces and smoke.
        self.outlines.add_crossings(self, piece, ends, &mut changes);
        let cuts = &mut changes.cuts;
        let unknown = |at: f64| Cut {
            at,
            change: None,
            outline: None,
        };
        let inside = piercings.iter().filter(|t| (from..to).contains(*t));
        cuts.extend(inside.map(|t| {
            let share = (t - from) / (to - from);
            unknown(self.projector.image_share(share, piece.depth))
        }));
        if let Some(extra) = self.extra {
            cuts.extend(extra.cuts(piece).into_iter().map(unknown));
        }

        // Sort the places, without those too near to the one before or to an end: what changes there is not known.
        cuts.sort_unstable_by(|a, b| a.at.total_cmp(&b.at).then(a.outline.cmp(&b.outline)));
        let least = LEAST_SPAN_PX / piece.length().max(LEAST_SPAN_PX);
        let mut count = 0_usize;
        for index in 0..cuts.len() {
            let cut = cuts[index];
            let last = count.checked_sub(1).map(|last| cuts[last]);
            let is_same = |last: Cut| last.at == cut.at && last.outline == cut.outline;
            if cut.at >= 1.0 - least {
                changes.is_plain[1] = false;
            } else if cut.at - last.map_or(0.0, |last| last.at) > least {
                cuts[count] = cut;
                count += 1;
            } else if let Some(last) = last {
                cuts[count - 1].change = last.change.filter(|_| is_same(last));
            } else {
                changes.is_plain[0] = false;
            }
        }
        cuts.truncate(count);
        changes
    }

    /// By how many surfaces there are more in front of a piece once it has crossed an outline: the faces beside the
    /// outline that lie where it goes on, less those where it came from. Unknown where one is seen edge-on.
    fn change_across(&self, piece: &Piece, outline: &Outline) -> Change {
        let [from, to] = outline.image.place;
        let across = [to[0] - from[0], to[1] - from[1]];
        let side =
            |place: [f64; 2]| across[0] * (place[1] - from[1]) - across[1] * (place[0] - from[0]);
        let on = side(piece.place[1]) - side(piece.place[0]);
        let mut change = 0_i16;
        for half_edge in self.shape.sides(outline.edge) {
            let corner = self.shape.point(self.shape.opposite(*half_edge));
            if self.projector.depth(corner) <= self.projector.near() {
                return None;
            }
            let corner = side(self.projector.project(corner));
            if corner.abs() < NEAR_PX * NEAR_PX {
                return None;
            }
            change += if (corner > 0.0) == (on > 0.0) { 1 } else { -1 };
        }
        Some(change)
    }

    /// Number of surfaces in front of the middle of a part of a piece.
    pub(crate) fn occluders(
        &self,
        piece: &Piece,
        [from, to]: [f64; 2],
        circumstances: &Circumstances,
        last: &mut Option<u32>,
    ) -> u32 {
        let point = piece.world_at(self.projector, (from + to) * 0.5);
        let sight = self.sight(point, circumstances);
        let own = &circumstances.own_faces;
        let in_smoke = u32::from(self.extra.is_some_and(|extra| extra.hide(point)));

        // Where visible or hidden is all that matters, one hider is enough.
        if self.count_limit == 1 {
            if in_smoke == 1 {
                return 1;
            }
            let hider = self.tree.hider(self.shape, &sight, own, *last);
            *last = hider.or(*last);
            return u32::from(hider.is_some());
        }

        // Else count what the sight goes through.
        let faces = self
            .tree
            .occluders(self.shape, &sight, own, self.count_limit);
        (faces + in_smoke).min(self.count_limit)
    }

    /// The way from the eye to a point of a piece.
    fn sight(&self, point: DVec3, circumstances: &Circumstances) -> Sight {
        Sight {
            eye: self.projector.sight_start(point).to_array(),
            point: point.to_array(),
            touch: circumstances.touch,
        }
    }
}

/// Spans with the number of parts that lie over each place, up to a limit.
fn counted(parts: &[[f64; 2]], limit: u32) -> Vec<Span> {
    let starts = parts.iter().map(|part| (part[0], 1));
    let mut steps: Vec<(f64, i32)> = starts
        .chain(parts.iter().map(|part| (part[1], -1)))
        .collect();
    // Where one part ends and another starts, there is nothing between them.
    steps.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    let (mut spans, mut from, mut count) = (Vec::new(), 0.0, 0_i32);
    for (at, step) in steps.into_iter().chain([(1.0, 0)]) {
        let at = at.clamp(0.0, 1.0);
        if from < at {
            push(&mut spans, [from, at], count.unsigned_abs().min(limit));
            from = at;
        }
        count += step;
    }
    spans
}

/// The share of a crowded piece's image below which a span of it is too short to see.
fn least_crowded(piece: &Piece) -> f64 {
    LEAST_CROWDED_PX / piece.length().max(2.0 * LEAST_CROWDED_PX)
}

/// Merges spans of a crowded piece that are too short to see into the one before, at the start into the one after.
fn joined(spans: Vec<Span>, piece: &Piece) -> Vec<Span> {
    let least = least_crowded(piece);
    let is_seen = |span: &Span| span.to - span.from >= least;
    let first = spans.iter().find(|span| is_seen(span)).or(spans.first());
    let Some(mut occluders) = first.map(|span| span.occluders) else {
        return spans;
    };
    let mut kept: Vec<Span> = Vec::with_capacity(spans.len());
    for span in &spans {
        if is_seen(span) {
            occluders = span.occluders;
        }
        push(&mut kept, [span.from, span.to], occluders);
    }
    kept
}

/// The spans without some parts; both ascend and do not overlap among themselves.
fn without(spans: &[Span], parts: &[[f64; 2]]) -> Vec<Span> {
    let mut left = Vec::with_capacity(spans.len());
    for span in spans {
        // Find the parts that lie in the span.
        let first = parts.partition_point(|part| part[1] <= span.from);
        let inside = parts[first..].iter().take_while(|part| part[0] < span.to);

        // Keep what lies between them.
        let mut from = span.from;
        for part in inside {
            if from < part[0] {
                left.push(Span {
                    from,
                    to: part[0],
                    ..*span
                });
            }
            from = part[1];
        }
        if from < span.to {
            left.push(Span { from, ..*span });
        }
    }
    left
}

/// Appends a span, or extends the last one if both are alike; does nothing if the span has no length.
pub(crate) fn push(spans: &mut Vec<Span>, [from, to]: [f64; 2], occluders: u32) {
    match spans.last_mut() {
        Some(span) if span.occluders == occluders => span.to = to,
        _ if from < to => spans.push(Span {
            from,
            to,
            occluders,
        }),
        _ => {}
    }
}
