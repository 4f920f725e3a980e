//! Runs: connected parts of lines, each of one kind, surface and visibility.

use crate::stroke::{Kind, LinePart};
use crate::surface_location::SurfaceLocation;
use glam::DVec3;
use npr_core::line_kind::KIND_NUMBER_BITS;

/// Runs shorter than this are left out, in pixels. Parts cut at corners are not: the line that they are of goes on.
pub const SPECK_PX: f64 = 3.0;

/// A point of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunPoint {
    /// Place in the picture, in pixels.
    pub place: [f64; 2],
    /// Distance from the eye along the view axis.
    pub depth: f64,
    /// Place in the world.
    pub world: DVec3,
    /// The mesh edge it lies on or near: its identity, not where it is.
    pub edge: u32,
    /// Where on that edge, from its lower vertex.
    pub t: f32,
    /// The edge or face that the line lies on from here to the next point.
    pub location: SurfaceLocation,
    /// Whether the line moves to another edge or face between here and the next point, where two lines were joined
    /// across a gap or where places on two edges follow each other. Points in between lie on neither in the world, so
    /// the first half of the way takes the place of this point there, and the second half that of the next.
    pub leaps: bool,
}

/// A connected part of a line with one kind, surface and visibility.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Stays with the run from frame to frame.
    pub id: u64,
    /// What it is drawn as.
    pub kind: Kind,
    /// Surface that it lies on.
    pub surface: u32,
    /// Object that it lies on.
    pub object: u32,
    /// Least number of surfaces in front of it.
    pub occluders: u32,
    /// The last point runs on to the first.
    pub closed: bool,
    /// Whether its first and its last point lie where it was cut at a corner: nothing is joined there.
    pub cut: [bool; 2],
    /// Where its line goes on behind something from its first and from its last point.
    pub beyond: [Option<Beyond>; 2],
    /// Which part of its line it is, where that goes on behind something; told last, when runs are joined and smoothed.
    pub part: Option<LinePart>,
    /// Factor on its width.
    pub weight: f64,
    /// The points, at least two.
    pub points: Vec<RunPoint>,
}

/// What lies behind something between two seen parts of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beyond {
    /// Its number in the view: the end of another run that has the same is the other end of it.
    pub number: u64,
    /// Its length in the picture, in pixels.
    pub length_px: f64,
}

impl Run {
    /// The same run without points.
    pub(crate) fn clone_empty(&self) -> Self {
        Self {
            points: Vec::new(),
            ..*self
        }
    }

    /// Whether both may be parts of one line: of one kind, object and surface, and both seen or both hidden.
    pub(crate) fn may_join(&self, other: &Self) -> bool {
        self.kind == other.kind && self.surface == other.surface && self.is_beside(other)
    }

    /// Whether both are of one object, and both seen or both hidden.
    pub(crate) fn is_beside(&self, other: &Self) -> bool {
        self.object == other.object && (self.occluders > 0) == (other.occluders > 0)
    }

    /// The same line, travelled the other way.
    pub(crate) fn reverse(&mut self) {
        // What lay after a point now lies before it; what comes after a leap stays on what it lay on.
        let after: Vec<(SurfaceLocation, bool)> =
            self.points.iter().map(|p| (p.location, p.leaps)).collect();
        self.points.reverse();
        self.cut.reverse();
        self.beyond.reverse();
        self.part = self.part.map(LinePart::reversed);
        let count = self.points.len();
        for (i, point) in self.points.iter_mut().enumerate() {
            let (location, leaps) = after[(2 * count - 2 - i) % count];
            let is_end = !self.closed && i + 1 == count;
            point.leaps = leaps && !is_end;
            if !leaps && !is_end {
                point.location = location;
            }
        }
    }

    /// The edge or face that the line lies on at point `index`; the end of an open line takes that of the last piece.
    pub(crate) fn location_at(&self, index: usize) -> SurfaceLocation {
        location_at(&self.points, self.closed, index)
    }

    /// Length in the picture, in pixels.
    pub fn length(&self) -> f64 {
        let open: f64 = self
            .points
            .windows(2)
            .map(|p| distance(p[0].place, p[1].place))
            .sum();
        let (first, last) = (&self.points[0], &self.points[self.points.len() - 1]);
        if self.closed {
            open + distance(last.place, first.place)
        } else {
            open
        }
    }
}

/// Distance of two places, in pixels.
pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt()
}

/// The edge or face that a line lies on at a point; at an open end, unless the last piece leaps, that of the last
/// piece.
pub(crate) fn location_at(points: &[RunPoint], closed: bool, index: usize) -> SurfaceLocation {
    let is_end = !closed && index + 1 == points.len();
    let before = &points[index - usize::from(is_end && index > 0)];
    if before.leaps {
        points[index].location
    } else {
        before.location
    }
}

/// Identity of the first run of a kind that hangs on an edge; the runs on one edge are told apart by eight bits below
/// it.
pub(crate) fn base_id(edge: u32, kind: Kind) -> u64 {
    u64::from(edge) << KIND_NUMBER_BITS | kind as u64
}

/// Tells apart runs that hang on the same edge, in the order in which they lie along it.
pub(crate) fn number(runs: &mut [Run]) {
    let mut order: Vec<usize> = (0..runs.len()).collect();
    order.sort_by(|a, b| {
        let along = |i: usize| (runs[i].id, runs[i].occluders > 0);
        along(*a).cmp(&along(*b)).then(a.cmp(b))
    });
    let mut last = None;
    let mut ordinal = 0;
    for index in order {
        let id = runs[index].id;
        ordinal = if last == Some(id) { ordinal + 1 } else { 0 };
        last = Some(id);
        runs[index].id = id << 8 | ordinal;
    }
}

/// Runs for tests of what follows.
#[cfg(test)]
pub(crate) mod testing {
    use super::*;

    /// An open contour through places of the picture, all at depth 1.
    pub fn run_along(id: u64, places: &[[f64; 2]]) -> Run {
        let point = |place: &[f64; 2]| RunPoint {
            place: *place,
            depth: 1.0,
            world: DVec3::new(place[0], place[1], 0.0),
            edge: 0,
            t: 0.0,
            location: SurfaceLocation::along(0),
            leaps: false,
        };
        Run {
            id,
            kind: Kind::Contour,
            surface: 0,
            object: 0,
            occluders: 0,
            closed: false,
            cut: [false; 2],
            beyond: [None; 2],
            part: None,
            weight: 1.0,
            points: places.iter().map(point).collect(),
        }
    }
    /// A closed contour around a circle about (200, 200).
    pub fn ring(id: u64, radius: f64, count: usize) -> Run {
        let step = std::f64::consts::TAU / count as f64;
        let place = |i: usize| {
            let a = i as f64 * step;
            [200.0 + radius * a.cos(), 200.0 + radius * a.sin()]
        };
        let places: Vec<[f64; 2]> = (0..count).map(place).collect();
        Run {
            closed: true,
            ..run_along(id, &places)
        }
    }

    /// An open contour from a place in a direction, with points 1.5 px apart.
    pub fn straight(id: u64, from: [f64; 2], angle: f64, length: f64) -> Run {
        let count = (length / 1.5).ceil().max(1.0);
        let place = |i: u32| {
            let at = length * f64::from(i) / count;
            [from[0] + at * angle.cos(), from[1] + at * angle.sin()]
        };
        run_along(id, &(0..=count as u32).map(place).collect::<Vec<_>>())
    }
}

#[cfg(test)]
mod tests {
    use super::testing::{ring, run_along};
    use super::*;

    /// For every piece its two ends, the lesser first, with what it lies on.
    fn located(run: &Run) -> Vec<([u64; 2], SurfaceLocation)> {
        let count = run.points.len();
        let pieces = if run.closed { count } else { count - 1 };
        let mut found: Vec<([u64; 2], SurfaceLocation)> = (0..pieces)
            .map(|i| {
                let mut ends = [i, (i + 1) % count].map(|k| run.points[k].place[0].to_bits());
                ends.sort_unstable();
                (ends, run.location_at(i))
            })
            .collect();
        found.sort_unstable_by_key(|(ends, _)| *ends);
        found
    }

    #[test]
    fn pieces_keep_their_locations_when_a_run_is_turned_round() {
        let open = run_along(0, &[0.0, 3.0, 7.0, 8.0, 11.0].map(|x| [x, 0.0]));
        for mut run in [open, ring(0, 30.0, 7)] {
            for (edge, point) in (0..).zip(&mut run.points) {
                point.location = SurfaceLocation::along(edge);
            }
            let before = located(&run);
            run.reverse();
            assert_eq!(located(&run), before);
            let last = run.points.len() - 1;
            if !run.closed {
                assert_eq!(run.location_at(last), run.location_at(last - 1));
            }
            run.reverse();
            assert_eq!(located(&run), before);
        }
    }
}
