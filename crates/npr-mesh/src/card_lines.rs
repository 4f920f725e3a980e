//! The centre lines that a shape's cards are drawn by.

use glam::DVec3;
use std::ops::Range;

/// A point of a card's centre line.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CardPoint {
    /// Place in the world.
    pub place: DVec3,
    /// Direction of the line, of length 1, from the root to the tip.
    pub along: DVec3,
    /// From one side of the card to the other, at right angles to `along`; its length is `width`. Zero where the card
    /// is as wide from all sides.
    pub across: DVec3,
    /// Width of the card in units of the world.
    pub width: f64,
    /// A vertex of the card close by, whose colour the line has here.
    pub vertex: u32,
}

/// The centre lines of a shape's cards: the last of its vertices and of its polylines, and the faces that each stands
/// for.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CardLines {
    first_vertex: usize,
    first_polyline: usize,
    /// The points of all lines, one for each vertex.
    points: Vec<CardPoint>,
    /// For each point, whether a line ends there.
    is_end: Vec<bool>,
    /// The card of each polyline.
    card_of: Vec<u32>,
    /// The faces of all cards, and where those of each start, with the end of the last.
    faces: Vec<u32>,
    face_starts: Vec<u32>,
}

impl CardLines {
    /// Lines whose vertices and polylines have these numbers, from `first_vertex` and `first_polyline` on; each is a
    /// list of faces, and the points from root to tip.
    pub(crate) fn new<'a>(
        (first_vertex, first_polyline): (usize, usize),
        cards: impl Iterator<Item = (&'a [u32], &'a [CardPoint])>,
    ) -> Self {
        let mut lines = Self {
            first_vertex,
            first_polyline,
            face_starts: vec![0],
            ..Self::default()
        };
        for (card, (faces, points)) in (0..).zip(cards) {
            let last = points.len() - 1;
            lines.points.extend(points);
            lines.is_end.extend((0..=last).map(|i| i == 0 || i == last));
            lines.card_of.extend(std::iter::repeat_n(card, last));
            lines.faces.extend(faces);
            lines.face_starts.push(lines.faces.len() as u32);
        }
        lines
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Numbers of all their vertices.
    pub fn vertices(&self) -> Range<usize> {
        self.first_vertex..self.first_vertex + self.points.len()
    }

    /// Numbers of all their polylines.
    pub fn polylines(&self) -> Range<usize> {
        self.first_polyline..self.first_polyline + self.card_of.len()
    }

    /// The points, one for each vertex.
    pub fn points(&self) -> &[CardPoint] {
        &self.points
    }

    /// The point that a vertex is; none for other vertices.
    #[inline]
    pub fn point(&self, vertex: u32) -> Option<&CardPoint> {
        self.points
            .get((vertex as usize).checked_sub(self.first_vertex)?)
    }

    /// Whether a vertex is the root or the tip of a card's line.
    #[inline]
    pub fn is_end(&self, vertex: u32) -> bool {
        let at = (vertex as usize).checked_sub(self.first_vertex);
        at.and_then(|at| self.is_end.get(at))
            .is_some_and(|is_end| *is_end)
    }

    /// The faces of the card that a polyline stands for; none for other polylines.
    #[inline]
    pub fn faces(&self, polyline: usize) -> &[u32] {
        let at = polyline.checked_sub(self.first_polyline);
        let Some(card) = at.and_then(|at| self.card_of.get(at)) else {
            return &[];
        };
        let [from, to] = [card, &(card + 1)].map(|card| self.face_starts[*card as usize] as usize);
        &self.faces[from..to]
    }
}
