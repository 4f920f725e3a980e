//! Lines of which parts are hidden: what the parts of one have in common.

use super::identity::{Claimant, settled};
use super::remembered::Line;
use super::votes::Tally;
use super::way::{measure, reverse};
use crate::stroke::{LinePart, Stroke};
use std::collections::BTreeMap;

/// Lets the parts of a line run as it ran, gives parts that nobody saw before the texture of those beside them, and
/// calls lines as they were called.
///
/// Strokes have been turned as they were, and their textures shifted. O(strokes log strokes + points).
pub(super) fn settle(strokes: &mut [Stroke], tallies: &[Tally], lines: &[Line]) {
    // Gather the parts of each line.
    let mut members: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for (index, stroke) in strokes.iter().enumerate() {
        if let Some(part) = stroke.part {
            members.entry(part.line).or_default().push(index);
        }
    }

    // Let them run one way, and their textures go on.
    for of_line in members.values() {
        turn(strokes, tallies, of_line);
        carry_textures(strokes, tallies, of_line);
    }

    // Call them.
    let claimants = members.iter().map(|(own, of_line)| {
        let mut counts: BTreeMap<u64, usize> = BTreeMap::new();
        for member in of_line {
            for (id, count) in tallies[*member].counts(|line| lines[line].whole_id) {
                *counts.entry(id).or_default() += count;
            }
        }
        Claimant { own: *own, counts }
    });
    let ids = settled(&claimants.collect::<Vec<_>>());
    for (of_line, line) in members.values().zip(ids) {
        for member in of_line {
            let part = strokes[*member].part;
            strokes[*member].part = part.map(|part| LinePart { line, ..part });
        }
    }
}

/// Turns a line as most samples of its parts ran, and those parts with it that nobody saw before.
fn turn(strokes: &mut [Stroke], tallies: &[Tally], members: &[usize]) {
    let is_against = |stroke: &Stroke| stroke.part.is_some_and(|part| part.is_against());
    let against = members.iter().map(|member| {
        let count = tallies[*member].vote_count as i64;
        if is_against(&strokes[*member]) {
            count
        } else {
            -count
        }
    });
    if against.sum::<i64>() > 0 {
        for member in members {
            let part = strokes[*member].part;
            strokes[*member].part = part.map(LinePart::of_reversed_line);
        }
    }
    for member in members {
        if tallies[*member].vote_count == 0 && is_against(&strokes[*member]) {
            reverse(&mut strokes[*member]);
        }
    }
}

/// Lets the texture of parts that nobody saw before go on behind what hides the line, from the nearest part that has
/// one; of two as near, from the one before it.
fn carry_textures(strokes: &mut [Stroke], tallies: &[Tally], members: &[usize]) {
    let known: Vec<Facing> = members
        .iter()
        .filter(|member| tallies[**member].vote_count > 0)
        .flat_map(|member| [true, false].map(|is_late| Facing::new(&strokes[*member], is_late)))
        .flatten()
        .collect();
    for member in members {
        let stroke = &mut strokes[*member];
        let Some(part) = stroke.part.filter(|_| tallies[*member].vote_count == 0) else {
            continue;
        };
        let [start, end] = part.ends_px;
        let away = |facing: &Facing| match facing.is_late {
            true => start - facing.at_px,
            false => facing.at_px - end,
        };
        let facing_it = known.iter().filter(|facing| away(facing) >= 0.0);
        let nearest = facing_it.min_by(|a, b| {
            let by_way = away(a).total_cmp(&away(b));
            by_way.then(b.is_late.cmp(&a.is_late))
        });
        if let Some(facing) = nearest {
            measure(&mut stroke.points);
            for point in &mut stroke.points {
                point.u = facing.u + facing.slope * (start + point.u - facing.at_px);
            }
        }
    }
}

/// The texture of a part at one of its ends.
struct Facing {
    /// Whether it is the end that comes later on the line.
    is_late: bool,
    /// Where on the line it lies, in pixels.
    at_px: f64,
    u: f64,
    /// 1 where the texture runs as the line does, else -1.
    slope: f64,
}

impl Facing {
    fn new(stroke: &Stroke, is_late: bool) -> Option<Self> {
        let part = stroke.part?;
        let is_last = is_late != part.is_against();
        let [point, inner] = match (is_last, &stroke.points[..]) {
            (true, [.., inner, last]) => [last, inner],
            (false, [first, inner, ..]) => [first, inner],
            _ => return None,
        };
        let is_growing = point.u >= inner.u;
        Some(Self {
            is_late,
            at_px: part.ends_px[usize::from(is_last)],
            u: point.u,
            slope: if is_growing == is_late { 1.0 } else { -1.0 },
        })
    }
}
