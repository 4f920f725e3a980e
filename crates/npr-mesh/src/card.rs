//! Cards: long thin pieces that stand for a blade of grass or a lock of hair, and the lines through their middles.
//!
//! Artists model hair and grass as strips of faces, flat or bent, or as thin closed blades and tapered tubes. A
//! draughtsman draws each of them as one line. A card is a piece of connected faces that is [`LEAST_RATIO`] times as
//! long as wide: an open strip, whose line runs between its two long sides ([`strip`]), or a tube, whose line runs
//! through the middles of its cross-sections ([`tube`]). Pieces that fork, rings, pieces with holes and thick pieces
//! are none.

mod strip;
mod tube;

use crate::card_lines::CardLines;
pub use crate::card_lines::CardPoint;
use crate::half_edge::{HalfEdgeMesh, Surface};
use crate::union_find::UnionFind;
use glam::DVec3;
use npr_core::geometry::NONE;

/// Least length of a card, in its greatest widths. A leaf is about three times as long as wide, a blade of grass ten
/// to fifty times.
pub const LEAST_RATIO: f64 = 4.0;

/// Share of a card's line, from either end, whose widths tell which end is the root.
const END_SHARE: f64 = 1.0 / 3.0;

/// Factor by which one end must be wider than the other to be the root for it.
const CLEARLY_WIDER: f64 = 1.05;

/// Turn, in radians, from one point of a line to the next above which there are more between them: 5 degrees.
const ROUND_STEP: f64 = 0.0873;

/// Most steps between two points.
const MOST_STEPS: f64 = 8.0;

/// Least distance of points that follow each other on a line, as a share of their mean distance.
const LEAST_STEP: f64 = 1e-3;

/// A long thin piece of a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Card {
    /// Its faces, ascending.
    pub faces: Vec<u32>,
    /// Its centre line from the root to the tip, at least two points. The root is the wider end; where both are about
    /// as wide, the lower one.
    pub points: Vec<CardPoint>,
}

/// Faces that hang together by their edges, and how.
struct Piece<'a> {
    shape: &'a HalfEdgeMesh,
    faces: &'a [u32],
    /// Loops of vertices around its openings; none where an edge or a corner has more neighbours than a plain surface.
    loops: Vec<Vec<u32>>,
    /// Vertices and faces less edges: 1 for what can be laid flat, 2 for a ball.
    euler: i64,
}

/// The cards among the faces for which `is_wanted` is true, in the order of their first faces.
///
/// Both windings may be mixed; faces without area do no harm. O(n log n) over wanted faces.
pub fn cards(shape: &HalfEdgeMesh, is_wanted: impl Fn(u32) -> bool) -> Vec<Card> {
    // Join faces across edges.
    let is_wanted: Vec<bool> = (0..shape.faces.len() as u32).map(is_wanted).collect();
    let mut sets = UnionFind::new(shape.faces.len());
    for edge in 0..shape.edge_count() as u32 {
        let mut faces = shape.sides(edge).iter().map(|side| side / 3);
        let mut faces = faces.by_ref().filter(|face| is_wanted[*face as usize]);
        if let Some(first) = faces.next() {
            faces.for_each(|face| sets.unite(first, face));
        }
    }

    // Gather the faces of every piece.
    let names: Vec<u32> = (0..shape.faces.len() as u32)
        .map(|face| match is_wanted[face as usize] {
            true => sets.find(face),
            false => NONE,
        })
        .collect();
    let mut order: Vec<u32> = (0..names.len() as u32)
        .filter(|face| is_wanted[*face as usize])
        .collect();
    order.sort_by_key(|face| names[*face as usize]);

    // Find the line of each.
    let pieces = order.chunk_by(|a, b| names[*a as usize] == names[*b as usize]);
    pieces
        .filter_map(|faces| {
            let piece = Piece::new(shape, faces, &names)?;
            Some(Card {
                faces: faces.to_vec(),
                points: piece.line()?,
            })
        })
        .collect()
}

/// Draws cards by their centre lines from now on: these become polylines of the shape, and the faces of cards lose the
/// lines of their own.
///
/// The faces go to new surfaces without lines, behind those that there are: the result names, for each, the surface
/// that it is like. The polylines stay on the old one. A shape takes cards once.
///
/// # Panics
///
/// If the shape has lines of cards already.
pub fn draw_by_centre(shape: &mut HalfEdgeMesh, cards: &[Card]) -> Vec<u32> {
    assert!(shape.cards.is_empty(), "a shape takes cards once");
    let firsts = (shape.positions.len(), shape.polylines.len());

    // Add the lines, on the surface of each card's first face.
    for card in cards {
        let surface = shape.face_surfaces[card.faces[0] as usize];
        let first = shape.positions.len() as u32;
        let places = card
            .points
            .iter()
            .map(|point| point.place.as_vec3().to_array());
        shape.positions.extend(places);
        let last = shape.positions.len() as u32 - 1;
        shape
            .polylines
            .extend((first..last).map(|vertex| [vertex, vertex + 1]));
        shape
            .polyline_surfaces
            .resize(shape.polylines.len(), surface);
    }
    let of_cards = cards
        .iter()
        .map(|card| (card.faces.as_slice(), card.points.as_slice()));
    shape.cards = CardLines::new(firsts, of_cards);

    // Move their faces to surfaces without lines.
    let mut moved = vec![NONE; shape.surfaces.len()];
    let mut copied = Vec::new();
    for face in cards.iter().flat_map(|card| &card.faces) {
        let surface = &mut shape.face_surfaces[*face as usize];
        let new = &mut moved[*surface as usize];
        if *new == NONE {
            *new = shape.surfaces.len() as u32;
            copied.push(*surface);
            shape.surfaces.push(Surface {
                is_lineless: true,
                ..shape.surfaces[*surface as usize].clone()
            });
        }
        *surface = *new;
    }
    copied
}

impl<'a> Piece<'a> {
    /// A piece whose faces `names` names alike; `None` where more than two of its faces meet in an edge.
    fn new(shape: &'a HalfEdgeMesh, faces: &'a [u32], names: &[u32]) -> Option<Self> {
        // Tell its border from the edges inside.
        let name = names[faces[0] as usize];
        let mut border: Vec<[u32; 2]> = Vec::new();
        for half_edge in faces.iter().flat_map(|face| 3 * face..3 * face + 3) {
            let sides = shape.sides(shape.edge_of[half_edge as usize]);
            match sides
                .iter()
                .filter(|side| names[**side as usize / 3] == name)
                .count()
            {
                1 => border.push(shape.ends_of_half_edge(half_edge)),
                2 => {}
                _ => return None,
            }
        }

        // Count what it is made of.
        let mut vertices: Vec<u32> = faces
            .iter()
            .flat_map(|face| shape.faces[*face as usize])
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let edge_count = (3 * faces.len() + border.len()) / 2;
        let euler = vertices.len() as i64 - edge_count as i64 + faces.len() as i64;
        Some(Self {
            shape,
            faces,
            loops: loops_of(&border)?,
            euler,
        })
    }

    /// The centre line of the piece from its root to its tip, where it is long and thin.
    fn line(&self) -> Option<Vec<CardPoint>> {
        let found = match (self.loops.as_slice(), self.euler) {
            ([border], 1) => strip::line(self, border).or_else(|| tube::line(self)),
            ([], 2) | ([_, _], 0) => tube::line(self),
            _ => None,
        };
        let mut points = found?;
        if !is_from_root(&points) {
            points.reverse();
            for point in &mut points {
                point.along = -point.along;
            }
        }
        Some(rounded(&points))
    }

    fn point(&self, vertex: u32) -> DVec3 {
        self.shape.point(vertex)
    }

    /// Area of its faces.
    fn area(&self) -> f64 {
        let area = |face: &u32| {
            let [a, b, c] = self.shape.faces[*face as usize].map(|vertex| self.point(vertex));
            0.5 * (b - a).cross(c - a).length()
        };
        self.faces.iter().map(area).sum()
    }
}

/// The loops that undirected edges of a border make; `None` where they meet in other numbers than two.
fn loops_of(border: &[[u32; 2]]) -> Option<Vec<Vec<u32>>> {
    // Sort the ends of edges by vertex: two follow each other for every vertex.
    let mut ends: Vec<(u32, usize)> = border
        .iter()
        .enumerate()
        .flat_map(|(edge, ends)| ends.map(|vertex| (vertex, edge)))
        .collect();
    ends.sort_unstable();
    let is_plain = |pair: &[(u32, usize)]| pair.len() == 2;
    if !ends.chunk_by(|a, b| a.0 == b.0).all(is_plain) {
        return None;
    }

    // Walk from edge to edge.
    let mut is_used = vec![false; border.len()];
    let mut loops = Vec::new();
    for first in 0..border.len() {
        let (mut edge, mut vertex) = (first, border[first][0]);
        let mut found = Vec::new();
        while !is_used[edge] {
            is_used[edge] = true;
            found.push(vertex);
            let [a, b] = border[edge];
            vertex = if a == vertex { b } else { a };
            let at = ends.partition_point(|end| end.0 < vertex);
            edge = ends[at..at + 2]
                .iter()
                .map(|end| end.1)
                .find(|next| *next != edge)?;
        }
        if !found.is_empty() {
            loops.push(found);
        }
    }
    Some(loops)
}

/// Length of a line.
fn length_of(points: &[CardPoint]) -> f64 {
    let steps = points.windows(2);
    steps
        .map(|pair| pair[0].place.distance(pair[1].place))
        .sum()
}

/// Leaves out points that hardly differ from those before them, and gives all their directions; `None` for a line
/// without a length, or one that is not long for its width.
fn finished(mut points: Vec<CardPoint>) -> Option<Vec<CardPoint>> {
    // Keep both ends.
    let least = LEAST_STEP * length_of(&points) / points.len() as f64;
    let last = points.pop()?;
    let mut kept: Vec<CardPoint> = Vec::with_capacity(points.len() + 1);
    for point in points {
        let is_new = |before: &CardPoint| before.place.distance(point.place) > least;
        if kept.last().is_none_or(is_new) && point.place.distance(last.place) > least {
            kept.push(point);
        }
    }
    kept.push(last);
    if kept.len() < 2 {
        return None;
    }

    // Directions go from the point before to the one after; what lies along them is no width.
    let places: Vec<DVec3> = kept.iter().map(|point| point.place).collect();
    for (index, point) in kept.iter_mut().enumerate() {
        let after = places[(index + 1).min(places.len() - 1)];
        point.along = (after - places[index.saturating_sub(1)]).normalize_or_zero();
        if point.across != DVec3::ZERO {
            point.across -= point.along * point.across.dot(point.along);
            point.width = point.across.length();
        }
    }
    let widest = kept.iter().map(|point| point.width).fold(0.0, f64::max);
    let length = length_of(&kept);
    (length.is_finite() && length > 0.0 && length >= LEAST_RATIO * widest).then_some(kept)
}

/// The line with points between its own, where it turns: a curve through these and in their directions, as a hand draws
/// it, and not a chain of straight rows: Hermite's cubics.
fn rounded(points: &[CardPoint]) -> Vec<CardPoint> {
    let mut found = vec![points[0]];
    for pair in points.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        // Of small angles the chord is the angle.
        let turn = from.along.distance(to.along);
        let count = (turn / ROUND_STEP).ceil().clamp(1.0, MOST_STEPS) as u32;
        let shares = (1..count).map(|step| f64::from(step) / f64::from(count));
        found.extend(shares.map(|share| between(&from, &to, share)));
        found.push(to);
    }
    found
}

/// A point on the curve between two.
fn between(from: &CardPoint, to: &CardPoint, t: f64) -> CardPoint {
    let chord = from.place.distance(to.place);
    let [start, end] = [from.along * chord, to.along * chord];
    let s = 1.0 - t;
    let place = from.place * (s * s * (1.0 + 2.0 * t))
        + start * (s * s * t)
        + to.place * (t * t * (1.0 + 2.0 * s))
        - end * (t * t * s);
    let along = (to.place - from.place) * (6.0 * s * t)
        + start * (s * (s - 2.0 * t))
        + end * (t * (t - 2.0 * s));
    let along = along.normalize_or(from.along);
    let width = from.width + t * (to.width - from.width);
    let across = from.across.lerp(to.across, t);
    let across = (across - along * across.dot(along)).normalize_or_zero() * width;
    CardPoint {
        place,
        along,
        across,
        width,
        vertex: if t < 0.5 { from.vertex } else { to.vertex },
    }
}

/// Whether a line starts at its card's root: the wider end, or of two that are about as wide the lower.
fn is_from_root(points: &[CardPoint]) -> bool {
    let length = length_of(points);
    let first = area_within(points, [0.0, END_SHARE * length]);
    let last = area_within(points, [(1.0 - END_SHARE) * length, length]);
    if first > CLEARLY_WIDER * last || last > CLEARLY_WIDER * first {
        return first > last;
    }
    points[0].place.y <= points[points.len() - 1].place.y
}

/// Area that a line covers between two ways along it.
fn area_within(points: &[CardPoint], [from, to]: [f64; 2]) -> f64 {
    let mut way = 0.0;
    let areas = points.windows(2).map(|pair| {
        let step = pair[0].place.distance(pair[1].place);
        let [low, high] = [from, to].map(|end| ((end - way) / step).clamp(0.0, 1.0));
        way += step;
        let at = |share: f64| pair[0].width + share * (pair[1].width - pair[0].width);
        (high - low) * step * at(0.5 * (low + high))
    });
    areas.sum()
}
