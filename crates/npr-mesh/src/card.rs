//! Cards: long thin pieces that stand for a blade of grass or a lock of hair, and the lines through their middles.
//!
//! Artists model hair and grass as strips of faces, flat or bent, or as thin closed blades and tapered tubes. A
//! draughtsman draws each of them as one line. A card is a piece of connected faces that is [`LEAST_RATIO`] times as
//! long as wide: an open strip, whose line runs between its two long sides (`strip`), or a tube, whose line runs
//! through the middles of its cross-sections (`tube`). Pieces that fork, rings, pieces with holes and thick pieces
//! are none.

mod piece;
mod strip;
mod tube;

use crate::card_lines::CardLines;
pub use crate::card_lines::CardPoint;
use crate::half_edge::{HalfEdgeMesh, Surface};
use crate::union_find::UnionFind;
use npr_core::geometry::NONE;
pub use piece::LEAST_RATIO;
use piece::{Piece, area_within, length_of};

/// Share of a card's line, from either end, whose widths tell which end is the root.
const END_SHARE: f64 = 1.0 / 3.0;

/// Factor by which one end must be wider than the other to be the root for it.
const CLEARLY_WIDER: f64 = 1.05;

/// Turn, in radians, from one point of a line to the next above which there are more between them: 5 degrees.
const ROUND_STEP: f64 = 0.0873;

/// Most steps between two points.
const MOST_STEPS: f64 = 8.0;

/// A long thin piece of a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Card {
    /// Its faces, ascending.
    pub faces: Vec<u32>,
    /// Its centre line from the root to the tip, at least two points. The root is the wider end; where both are about
    /// as wide, the lower one.
    pub points: Vec<CardPoint>,
}

/// The cards among the faces for which `is_wanted` is true, in the order of their first faces.
///
/// Both windings may be mixed; faces without area do no harm. O(n log n) over wanted faces.
pub fn cards(shape: &HalfEdgeMesh, is_wanted: impl Fn(u32) -> bool) -> Vec<Card> {
    // Join faces across edges.
    let is_wanted: Vec<bool> = (0..shape.faces.len() as u32).map(is_wanted).collect();
    let mut sets = UnionFind::new(shape.faces.len());
    for edge in 0..shape.edge_count() as u32 {
        let faces = shape.sides(edge).iter().map(|side| side / 3);
        let mut faces = faces.filter(|face| is_wanted[*face as usize]);
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

impl Piece<'_> {
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
}

/// The line with points between its own, where it turns: a curve through these and in their directions, as a hand draws
/// it, and no chain of straight rows. Hermite's cubics.
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
    // Of a way across and the one back either will do.
    let forth = if from.across.dot(to.across) < 0.0 {
        -1.0
    } else {
        1.0
    };
    let across = from.across.lerp(to.across * forth, t);
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
