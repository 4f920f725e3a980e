//! The line through the middles of a tube's cross-sections.
//!
//! Ways along edges from one end of a tube to the other cut it into sections [Lazarus & Verroust 1999]: places as far
//! from the end. Each has to be one piece, or the tube forks. Its middle is a point of the line.

use super::piece::{LEAST_RATIO, Piece, finished};
use crate::card_lines::CardPoint;
use glam::DVec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Sections of a tube.
const SECTIONS: u32 = 24;

/// Sections nearer to an end than this many of their widths lie on its cap.
const CAP_WIDTHS: f64 = 0.75;

/// Greatest thickness of a flat section, as a share of its width: such a blade is as wide as it is turned.
const FLAT: f64 = 0.5;

/// The piece with its vertices numbered from 0.
struct Net<'a> {
    piece: &'a Piece<'a>,
    vertices: Vec<u32>,
    faces: Vec<[u32; 3]>,
    /// Neighbours of every vertex, with their distances.
    beside: Vec<Vec<(u32, f64)>>,
}

/// The line through a piece that is a tube, open or closed at its ends; `None` where it forks or is thick.
pub(super) fn line(piece: &Piece<'_>) -> Option<Vec<CardPoint>> {
    // Find the ends: what is farthest from anything, and what is farthest from there.
    let net = Net::new(piece);
    let start = farthest(&net.ways_from(0));
    let ways = net.ways_from(start);
    let end = farthest(&ways);
    let length = ways[end as usize];
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }

    // Cut it; on caps, sections may be in pieces, and say nothing of its width.
    let way_of = |section: u32| length * f64::from(section) / f64::from(SECTIONS);
    let sections: Vec<Option<CardPoint>> = (1..SECTIONS)
        .map(|section| net.section(&ways, way_of(section)))
        .collect();
    let whole = sections.iter().flatten();
    let widest = whole.map(|point| point.width).fold(0.0, f64::max);
    let mut points = Vec::new();
    for (section, point) in (1..).zip(sections) {
        let way = way_of(section);
        let width = point.map_or(widest, |point| point.width);
        if way.min(length - way) < CAP_WIDTHS * width {
            continue;
        }
        let point = point.filter(|point| LEAST_RATIO * point.width <= length)?;
        points.push(point);
    }
    if points.len() < 2 {
        return None;
    }

    // Draw it out to both ends.
    let tip_of = |[next, last]: [CardPoint; 2], end: u32| {
        let way = (last.place - next.place).normalize_or_zero();
        let vertex = net.vertices[end as usize];
        let beyond = (piece.point(vertex) - last.place).dot(way).max(0.0);
        let step = last.place.distance(next.place);
        let thinner = (last.width - next.width) / step.max(f64::MIN_POSITIVE);
        let width = (last.width + thinner.min(0.0) * beyond).max(0.0);
        CardPoint {
            place: last.place + way * beyond,
            across: last.across.normalize_or_zero() * width,
            width,
            vertex,
            ..last
        }
    };
    let last = points.len() - 1;
    let ends = [
        tip_of([points[1], points[0]], start),
        tip_of([points[last - 1], points[last]], end),
    ];
    points.insert(0, ends[0]);
    points.push(ends[1]);
    finished(points)
}

/// The vertex that is farthest, of equal ones the first.
fn farthest(ways: &[f64]) -> u32 {
    let farther = |best: usize, i: usize| if ways[i] > ways[best] { i } else { best };
    (1..ways.len()).fold(0, farther) as u32
}

impl<'a> Net<'a> {
    fn new(piece: &'a Piece<'a>) -> Self {
        let corners = |face: &u32| piece.shape.faces[*face as usize];
        let mut vertices: Vec<u32> = piece.faces.iter().flat_map(corners).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |vertex: u32| vertices.partition_point(|other| *other < vertex) as u32;
        let faces: Vec<[u32; 3]> = piece
            .faces
            .iter()
            .map(|face| corners(face).map(number))
            .collect();
        let mut beside = vec![Vec::new(); vertices.len()];
        for [a, b, c] in &faces {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let [here, there] = [from, to].map(|v| piece.point(vertices[*v as usize]));
                let length = here.distance(there);
                beside[*from as usize].push((*to, length));
                beside[*to as usize].push((*from, length));
            }
        }
        Self {
            piece,
            vertices,
            faces,
            beside,
        }
    }

    fn point(&self, vertex: u32) -> DVec3 {
        self.piece.point(self.vertices[vertex as usize])
    }

    /// Lengths of the shortest ways along edges from a vertex to all, by Dijkstra's method.
    fn ways_from(&self, start: u32) -> Vec<f64> {
        let mut ways = vec![f64::INFINITY; self.vertices.len()];
        ways[start as usize] = 0.0;
        // Lengths are positive, so their bits are in their order.
        let mut open = BinaryHeap::from([(Reverse(0_u64), start)]);
        while let Some((Reverse(bits), vertex)) = open.pop() {
            let way = f64::from_bits(bits);
            if way > ways[vertex as usize] {
                continue;
            }
            for (next, length) in &self.beside[vertex as usize] {
                let longer = way + length;
                if longer < ways[*next as usize] {
                    ways[*next as usize] = longer;
                    open.push((Reverse(longer.to_bits()), *next));
                }
            }
        }
        ways
    }

    /// The middle of the places that lie as far as `way`; `None` where they are not in one piece.
    fn section(&self, ways: &[f64], way: f64) -> Option<CardPoint> {
        // Cut every face that it goes through from edge to edge.
        let is_beyond = |vertex: u32| ways[vertex as usize] > way;
        let mut cuts: Vec<[[u32; 2]; 2]> = Vec::new();
        for corners in &self.faces {
            let edges = [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]]);
            let mut cut = edges
                .into_iter()
                .filter(|[a, b]| is_beyond(*a) != is_beyond(*b))
                .map(|[a, b]| [a.min(b), a.max(b)]);
            if let (Some(from), Some(to)) = (cut.next(), cut.next()) {
                cuts.push([from, to]);
            }
        }
        if !is_one_piece(&cuts) {
            return None;
        }

        // Its middle is that of its length.
        let place = |[a, b]: [u32; 2]| {
            let [near, far] = [a, b].map(|v| ways[v as usize]);
            let share = (way - near) / (far - near);
            self.point(a).lerp(self.point(b), share)
        };
        let sides: Vec<[DVec3; 2]> = cuts.iter().map(|cut| cut.map(place)).collect();
        let around: f64 = sides.iter().map(|[a, b]| a.distance(*b)).sum();
        let moment: DVec3 = sides
            .iter()
            .map(|[a, b]| 0.5 * (*a + *b) * a.distance(*b))
            .sum();
        let middle = if around > 0.0 {
            moment / around
        } else {
            sides.first()?[0]
        };

        // It is as wide as far as it reaches; a flat one only across.
        let reach = sides.as_flattened().iter().map(|place| *place - middle);
        let farthest = reach.clone().fold(DVec3::ZERO, |far, arm| {
            if arm.length_squared() > far.length_squared() {
                arm
            } else {
                far
            }
        });
        let way_across = farthest.normalize_or_zero();
        let thickness = reach
            .map(|arm| (arm - way_across * arm.dot(way_across)).length())
            .fold(0.0, f64::max);
        let is_flat = thickness < FLAT * farthest.length();
        Some(CardPoint {
            place: middle,
            across: if is_flat { 2.0 * farthest } else { DVec3::ZERO },
            width: farthest.length()
                + if is_flat {
                    farthest.length()
                } else {
                    thickness
                },
            vertex: self.vertices[cuts.first()?[0][0] as usize],
            ..CardPoint::default()
        })
    }
}

/// Whether cuts hang together, by the edges that they end on.
fn is_one_piece(cuts: &[[[u32; 2]; 2]]) -> bool {
    let mut edges: Vec<[u32; 2]> = cuts.as_flattened().to_vec();
    edges.sort_unstable();
    edges.dedup();
    let number = |edge: [u32; 2]| edges.partition_point(|other| *other < edge) as u32;
    let mut sets = crate::union_find::UnionFind::new(edges.len());
    for [from, to] in cuts {
        sets.unite(number(*from), number(*to));
    }
    (0..edges.len() as u32).all(|edge| sets.find(edge) == 0)
}
