//! Exact visibility: where lines of a view disappear and how many surfaces are in front.
//!
//! Along a line, what hides it changes only where its image crosses the image of an outline in front of it,
//! and where it goes through a face [Appel 1967]. So a piece is cut there, and one sight from the eye to the
//! middle of each span decides for all of it.

mod covering;
mod ink;
mod occluders;
mod piece;
#[cfg(test)]
mod tests;

pub use covering::FaceImages;
pub(crate) use covering::Tried;
pub(crate) use ink::Ink;
pub use occluders::Occluders;
pub(crate) use piece::MARGIN;
pub use piece::Piece;

use crate::mesh_lines::bvh::{FaceTree, Sight};
use crate::project::Projector;
use glam::DVec3;
use npr_core::budget::{Budget, OverBudget};
use npr_mesh::half_edge::HalfEdgeMesh;

/// Length in pixels under which a span is not examined by itself.
const LEAST_SPAN_PX: f64 = 1e-4;

/// Number of outlines in the cells that a piece's image passes, above which the piece is crowded.
///
/// A crowded piece is tested face by face: testing every crossing with an outline would take the square of their
/// number. Lines of usual models pass some dozens of outlines, the longest some hundreds.
pub const CROWD: usize = 512;

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

/// The outlines of a view that can hide something, in a grid over the picture.
#[derive(Debug)]
pub struct OutlineGrid {
    outlines: Vec<Piece>,
    cell_px: f64,
    origin: [f64; 2],
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl OutlineGrid {
    /// Sorts outlines into cells; O(outlines + cells they touch).
    ///
    /// # Errors
    ///
    /// [`OverBudget`] where there is no memory for them.
    pub fn new(
        size: [u32; 2],
        outlines: Vec<Piece>,
        budget: &mut Budget,
    ) -> Result<Self, OverBudget> {
        let margin = MARGIN * f64::from(size[0].max(size[1])) + 1.0;
        let [width, height] = size.map(|side| f64::from(side) + 2.0 * margin);
        let total: f64 = outlines.iter().map(Piece::length).sum();
        // About one entry per outline and cell, whether outlines are many and short or few and long.
        let wanted = (width * height / (outlines.len() as f64 + 1.0)).sqrt();
        let cell_px = wanted
            .max(total / (outlines.len() as f64 + 1.0) * 0.5)
            .clamp(2.0, 256.0);
        let mut grid = Self {
            outlines,
            cell_px,
            origin: [-margin; 2],
            columns: (width / cell_px).ceil() as usize,
            rows: (height / cell_px).ceil() as usize,
            starts: Vec::new(),
            entries: Vec::new(),
        };
        grid.fill(budget)?;
        Ok(grid)
    }

    fn fill(&mut self, budget: &mut Budget) -> Result<(), OverBudget> {
        // Count the outlines of every cell.
        let mut counts = vec![0_u32; self.columns * self.rows + 1];
        for outline in &self.outlines {
            self.cells_of(outline, |cell| counts[cell + 1] += 1);
        }
        for cell in 1..counts.len() {
            counts[cell] += counts[cell - 1];
        }
        let count = counts[counts.len() - 1] as usize;
        budget.take("outlines in the picture", count, size_of::<u32>())?;

        // List them, cell after cell.
        let mut entries = vec![0; count];
        let mut cursor = counts.clone();
        for (index, outline) in self.outlines.iter().enumerate() {
            self.cells_of(outline, |cell| {
                entries[cursor[cell] as usize] = index as u32;
                cursor[cell] += 1;
            });
        }
        self.starts = counts;
        self.entries = entries;
        Ok(())
    }

    /// Whether the cells that a piece's image passes hold more than [`CROWD`] outlines. O(cells).
    pub fn is_crowded(&self, piece: &Piece) -> bool {
        self.count_along(piece) > CROWD
    }

    /// Number of outlines in the cells that a piece's image passes; those in several cells count in each. O(cells).
    pub(crate) fn count_along(&self, piece: &Piece) -> usize {
        let mut count = 0;
        self.cells_of(piece, |cell| {
            count += (self.starts[cell + 1] - self.starts[cell]) as usize;
        });
        count
    }

    /// Visits the cells that a piece's image passes, row by row.
    fn cells_of(&self, piece: &Piece, mut visit: impl FnMut(usize)) {
        let [a, b] = piece
            .place
            .map(|p| [0, 1].map(|i| (p[i] - self.origin[i]) / self.cell_px));
        let (top, bottom) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let index = |v: f64, count: usize| (v.max(0.0) as usize).min(count - 1);
        let (first, last) = (index(top[1], self.rows), index(bottom[1], self.rows));
        let slope = (bottom[0] - top[0]) / (bottom[1] - top[1]).max(1e-300);
        for row in first..=last {
            let at = |y: f64| top[0] + slope * (y.clamp(top[1], bottom[1]) - top[1]);
            let (p, q) = if first == last {
                (top[0], bottom[0])
            } else {
                (at(row as f64), at(row as f64 + 1.0))
            };
            // A rounding error must not lose a cell.
            let from = index(p.min(q) - 1e-9, self.columns);
            let to = index(p.max(q) + 1e-9, self.columns);
            for column in from..=to {
                visit(row * self.columns + column);
            }
        }
    }

    /// Shares of a piece's image at which an outline in front of it is crossed, ascending.
    pub fn cuts(&self, projector: &Projector, piece: &Piece) -> Vec<f64> {
        // Find where the piece crosses outlines in the cells that it passes, and keep those in front.
        let mut cuts = Vec::new();
        self.cells_of(piece, |cell| {
            let [from, to] = [cell, cell + 1].map(|c| self.starts[c] as usize);
            for entry in &self.entries[from..to] {
                let outline = &self.outlines[*entry as usize];
                if let Some((own, other)) = crossing(piece, outline) {
                    let (behind, front) = (
                        piece.coordinate_at(projector, own),
                        outline.coordinate_at(projector, other),
                    );
                    if front <= behind + behind.abs() * 1e-6 {
                        cuts.push(own);
                    }
                }
            }
        });

        // Sort the places, each once.
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        cuts
    }
}

/// Where two images cross: the shares of both; none where they do not or are parallel.
fn crossing(piece: &Piece, other: &Piece) -> Option<(f64, f64)> {
    let ([a, b], [c, d]) = (piece.place, other.place);
    let apart = |i: usize| a[i].max(b[i]) < c[i].min(d[i]) || c[i].max(d[i]) < a[i].min(b[i]);
    if apart(0) || apart(1) {
        return None;
    }
    let along = [b[0] - a[0], b[1] - a[1]];
    let across = [d[0] - c[0], d[1] - c[1]];
    let between = [c[0] - a[0], c[1] - a[1]];
    let area = along[0] * across[1] - along[1] * across[0];
    if area == 0.0 {
        return None;
    }
    let own = (between[0] * across[1] - between[1] * across[0]) / area;
    let theirs = (between[0] * along[1] - between[1] * along[0]) / area;
    // Pieces that go on into one another meet at their ends, which is no crossing.
    let inside = own > 1e-9 && own < 1.0 - 1e-9;
    (inside && (-1e-9..=1.0 + 1e-9).contains(&theirs)).then_some((own, theirs))
}

/// Memory that passes from piece to piece: it changes the time taken and nothing else.
#[derive(Debug, Default)]
pub struct Memory {
    /// The last face that hid something, which is tried first.
    last: Option<u32>,
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
        let cuts = self.cuts(piece, &circumstances.piercings);
        let mut spans: Vec<Span> = Vec::with_capacity(1);
        for pair in cuts.windows(2) {
            let middle = (pair[0] + pair[1]) * 0.5;
            let occluders = self.occluders(piece, middle, circumstances, &mut memory.last);
            push(&mut spans, [pair[0], pair[1]], occluders);
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

    /// All shares where visibility may change, with both ends.
    fn cuts(&self, piece: &Piece, piercings: &[f64]) -> Vec<f64> {
        let mut cuts = self.outlines.cuts(self.projector, piece);
        let [from, to] = piece.range;
        let inside = piercings.iter().filter(|t| (from..to).contains(*t));
        cuts.extend(inside.map(|t| {
            self.projector
                .image_share((t - from) / (to - from), piece.depth)
        }));
        cuts.extend(self.extra.iter().flat_map(|extra| extra.cuts(piece)));
        cuts.sort_by(f64::total_cmp);
        let least = LEAST_SPAN_PX / piece.length().max(LEAST_SPAN_PX);
        let mut kept = vec![0.0];
        for cut in cuts {
            if cut - kept[kept.len() - 1] > least && cut < 1.0 - least {
                kept.push(cut);
            }
        }
        kept.push(1.0);
        kept
    }

    fn occluders(
        &self,
        piece: &Piece,
        share: f64,
        circumstances: &Circumstances,
        last: &mut Option<u32>,
    ) -> u32 {
        let point = piece.world_at(self.projector, share);
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
fn push(spans: &mut Vec<Span>, [from, to]: [f64; 2], occluders: u32) {
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
