//! Tells which runs are parts of one line that goes on behind something.

use crate::mesh_lines::run::{Run, distance};
use crate::stroke::LinePart;
use std::collections::BTreeMap;

/// A way behind something from an end of a run to an end of another.
#[derive(Debug, Clone, Copy)]
struct Way {
    number: u64,
    /// Ends `2 r` and `2 r + 1` are the first and the last point of run `r`.
    ends: [usize; 2],
    length_px: f64,
}

/// Gives runs that go on as each other behind something their parts of one line, and makes them run one way: that of
/// the run with the least id, which the line is called by.
///
/// A ring of parts begins behind the longest way that is hidden. O(n log n).
pub fn tell_parts(runs: &mut [Run]) {
    let ways = ways_of(runs);
    let mates = without_rings(runs.len(), ways);
    let is_start = |end: usize| mates[end].is_none() && mates[end ^ 1].is_some();
    let starts: Vec<usize> = (0..mates.len()).filter(|end| is_start(*end)).collect();
    for start in starts {
        // The last end of a line is a start of it, too.
        if runs[start / 2].part.is_none() {
            tell_line(runs, &members(start, &mates));
        }
    }
}

/// The ways whose both ends are there, of two runs.
fn ways_of(runs: &[Run]) -> Vec<Way> {
    // Find the ends that have the same number.
    let mut ends: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for (index, run) in runs.iter().enumerate().filter(|(_, run)| !run.closed) {
        for (end, beyond) in (2 * index..).zip(run.beyond) {
            if let Some(beyond) = beyond {
                ends.entry(beyond.number).or_default().push(end);
            }
        }
    }

    // Measure what lies between two of them; ends that were cut lie farther apart than they did.
    let place = |end: usize| {
        let points = &runs[end / 2].points;
        points[if end.is_multiple_of(2) {
            0
        } else {
            points.len() - 1
        }]
        .place
    };
    let ways = ends.into_iter().filter_map(|(number, ends)| {
        let [a, b] = ends.try_into().ok()?;
        let beyond = runs[a / 2].beyond[a % 2]?;
        (a / 2 != b / 2).then(|| Way {
            number,
            ends: [a, b],
            length_px: beyond.length_px.max(distance(place(a), place(b))),
        })
    });
    ways.collect()
}

/// For each end the other end of its way and how long that is; of ways that close a ring the longest is left out.
fn without_rings(run_count: usize, mut ways: Vec<Way>) -> Vec<Option<(usize, f64)>> {
    ways.sort_by(|a, b| {
        let by_length = a.length_px.total_cmp(&b.length_px);
        by_length.then(a.number.cmp(&b.number))
    });
    let mut groups: Vec<usize> = (0..run_count).collect();
    let mut mates = vec![None; 2 * run_count];
    for way in ways {
        let [a, b] = way.ends;
        let [group_a, group_b] = [a, b].map(|end| group_of(&mut groups, end / 2));
        if group_a != group_b {
            groups[group_a] = group_b;
            mates[a] = Some((b, way.length_px));
            mates[b] = Some((a, way.length_px));
        }
    }
    mates
}

/// The group of a run; the way to it is halved.
fn group_of(groups: &mut [usize], mut run: usize) -> usize {
    while groups[run] != run {
        groups[run] = groups[groups[run]];
        run = groups[run];
    }
    run
}

/// The ends at which a pen that starts at one comes to the runs of a line, and how long it was hidden before each.
fn members(start: usize, mates: &[Option<(usize, f64)>]) -> Vec<(usize, f64)> {
    let mut found = vec![(start, 0.0)];
    while let Some((next, hidden_px)) = mates[found[found.len() - 1].0 ^ 1] {
        found.push((next, hidden_px));
    }
    found
}

/// Gives the members of a line their parts of it.
fn tell_line(runs: &mut [Run], members: &[(usize, f64)]) {
    // Measure the line as the pen came along it.
    let mut way = 0.0;
    let mut parts: Vec<(usize, [f64; 2])> = Vec::new();
    for (end, hidden_px) in members {
        let from = way + hidden_px;
        way = from + runs[end / 2].length();
        parts.push((*end, [from, way]));
    }

    // Let it run the way of the member with the least id.
    let leader = members
        .iter()
        .map(|(end, _)| (runs[end / 2].id, *end))
        .min();
    let (line, leading_end) = leader.unwrap_or_default();
    let is_against = !leading_end.is_multiple_of(2);
    for (end, ends_px) in parts {
        let run = &mut runs[end / 2];
        if end.is_multiple_of(2) == is_against {
            run.reverse();
        }
        let part = LinePart {
            line,
            ends_px,
            length_px: way,
        };
        run.part = Some(match is_against {
            true => part.of_reversed_line().reversed(),
            false => part,
        });
    }
}

#[cfg(test)]
mod tests;
