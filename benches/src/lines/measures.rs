//! The measures: recall, precision, double lines, fragmentation, offset.
//!
//! Ink is what a drawing shows, sampled a pixel apart; the reference is what it must show. Every share is weighted by
//! length.

use npr_vector::stroke::{Drawing, Kind};

use super::doubles::double_share;
use super::ink::{Bins, Curve, InkPoint, distance, sample};
use super::net::SHORTEST_PX;
use super::reference::{Piece, Reference};

/// Distances up to which ink and reference count as being in one place, in pixels.
pub const TOLERANCES_PX: [f64; 3] = [1.0, 2.0, 3.0];

/// Index into [`TOLERANCES_PX`] of the one that comparisons between programs use, and that faults are listed at.
pub const LISTED: usize = 1;

/// How far the nearest ink or reference is looked for.
const REACH_PX: f64 = 4.0;

/// Strokes shorter than this count as short.
const SHORT_PX: f64 = 9.0;

/// Faults nearer than this are one.
const CLUSTER_PX: f64 = 4.0;

/// A place where ink is missing, or where there should be none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fault {
    /// Middle of it, in pixels.
    pub at: [f64; 2],
    /// Length of line, in pixels.
    pub length: f64,
    /// What the line is, mostly.
    pub kind: Kind,
}

/// All measures of one drawing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Measures {
    /// Length of all that must be drawn, in pixels.
    pub due_px: f64,
    /// Length of all that is drawn, in pixels.
    pub ink_px: f64,
    /// Share of what must be drawn that has ink, for each of [`TOLERANCES_PX`]; 1 where nothing must.
    pub recall: [f64; 3],
    /// Share of ink that may be there, for each of [`TOLERANCES_PX`]; 1 where there is none.
    pub precision: [f64; 3],
    /// Missing lines, longest first.
    pub missing: Vec<Fault>,
    /// Ink that should not be there, longest first.
    pub spurious: Vec<Fault>,
    /// Share of ink beside other ink of the same direction.
    pub doubles: f64,
    /// The same of the reference: lines that truly run side by side.
    pub own_doubles: f64,
    /// How strokes divide the lines.
    pub strokes: Pieces,
    /// The visible runs that there are to draw.
    pub runs: Pieces,
    /// The same joined across short gaps, without the shortest.
    pub joined: Pieces,
    /// The strokes of a pen that a picture of them takes.
    pub drawn: Pieces,
    /// Mean distance of contour ink from its line, outward positive, in pixels: smoothing that shrinks shows as less
    /// than 0.
    pub bias_px: f64,
}

/// What strokes are counted against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// [`Measures::runs`].
    Runs,
    /// [`Measures::joined`].
    Joined,
    /// [`Measures::drawn`].
    Drawn,
}

impl Against {
    /// One of what strokes are counted against, in words.
    pub fn word(self) -> &'static str {
        match self {
            Self::Runs => "run",
            Self::Joined => "joined run",
            Self::Drawn => "drawn run",
        }
    }
}

/// How lines are divided.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Pieces {
    /// How many.
    pub count: usize,
    /// How many that are no specks: of 8 pixels and more, as a pen's strokes have to be.
    pub long: usize,
    /// Mean length weighted by length, in pixels: the length of the stroke that a random spot of ink lies on.
    pub mean_px: f64,
    /// Share of pieces under 9 pixels.
    pub short: f64,
}

impl Measures {
    /// Strokes for each run that there is to draw; 1 where there is none of either.
    ///
    /// Against the strokes of a pen, which are no specks, only strokes that are none count either.
    pub fn fragmentation(&self, against: Against) -> f64 {
        let counts = match against {
            Against::Runs => (self.strokes.count, self.runs.count),
            Against::Joined => (self.strokes.count, self.joined.count),
            Against::Drawn => (self.strokes.long, self.drawn.long),
        };
        match counts {
            (0, 0) => 1.0,
            (strokes, runs) => strokes as f64 / runs as f64,
        }
    }

    /// Share of what must be drawn that has no ink, and ink where there should be none as a share of what is hidden,
    /// for one of [`TOLERANCES_PX`].
    pub fn faults(&self, reference: &Reference, tolerance: usize) -> [f64; 2] {
        let false_px = (1.0 - self.precision[tolerance]) * self.ink_px;
        let shown = match reference.hidden_px > 0.0 {
            true => false_px / reference.hidden_px,
            false => 0.0,
        };
        [1.0 - self.recall[tolerance], shown]
    }

    /// Double lines beyond the reference's own.
    pub fn extra_doubles(&self) -> f64 {
        self.doubles - self.own_doubles
    }
}

/// Measures a drawing against the lines that it must show.
pub fn measure(drawing: &Drawing, reference: &Reference) -> Measures {
    // Sample the ink inside the frame.
    let frame = drawing.size.map(f64::from);
    let curves = Curve::of_drawing(drawing);
    let ink: Vec<InkPoint> = sample(&curves)
        .into_iter()
        .filter(|point| (0..2).all(|i| (0.0..=frame[i]).contains(&point.at[i])))
        .collect();

    // Compare it with what is due.
    let runs: Vec<Curve> = reference.runs.iter().map(Curve::of_run).collect();
    let found = Found::new(&ink, &curves, reference);
    Measures {
        due_px: reference.due_px(),
        ink_px: ink.iter().map(|point| point.length).sum(),
        recall: TOLERANCES_PX.map(|tolerance| found.recall(tolerance)),
        precision: TOLERANCES_PX.map(|tolerance| found.precision(tolerance)),
        missing: clusters(&found.missing(TOLERANCES_PX[LISTED])),
        spurious: clusters(&found.spurious(TOLERANCES_PX[LISTED])),
        doubles: double_share(&ink, &curves),
        own_doubles: double_share(&sample(&runs), &runs),
        strokes: pieces(curves.iter().map(Curve::length)),
        runs: pieces(reference.runs.iter().map(|run| run.length)),
        joined: pieces(reference.joined.iter().map(|run| run.length)),
        drawn: pieces(reference.drawn.iter().map(|stroke| stroke.length)),
        bias_px: found.bias(),
    }
}

/// Ink and reference with the distance of each to the other.
struct Found<'a> {
    ink: &'a [InkPoint],
    curves: &'a [Curve],
    pieces: &'a [Piece],
    /// Distance from each piece to the nearest ink; infinite beyond [`REACH_PX`].
    to_ink: Vec<f64>,
    /// The nearest piece of each point of ink, and its distance.
    to_piece: Vec<Option<(usize, f64)>>,
}

impl<'a> Found<'a> {
    fn new(ink: &'a [InkPoint], curves: &'a [Curve], reference: &'a Reference) -> Self {
        let pieces = &reference.pieces;
        let ink_bins = Bins::new(ink.iter().map(|point| point.at).collect(), REACH_PX);
        let piece_bins = Bins::new(pieces.iter().map(|piece| piece.at).collect(), REACH_PX);
        let to_ink = pieces.iter().map(|piece| {
            let nearest = ink_bins.nearest(piece.at, REACH_PX);
            nearest.map_or(f64::INFINITY, |(_, distance)| distance)
        });
        let to_piece = ink
            .iter()
            .map(|point| piece_bins.nearest(point.at, REACH_PX));
        Self {
            ink,
            curves,
            pieces,
            to_ink: to_ink.collect(),
            to_piece: to_piece.collect(),
        }
    }

    /// Pieces that must be drawn, each with the distance of the nearest ink.
    fn due(&self) -> impl Iterator<Item = (&Piece, f64)> {
        let all = self.pieces.iter().zip(self.to_ink.iter().copied());
        all.filter(|(piece, _)| piece.due)
    }

    fn recall(&self, tolerance: f64) -> f64 {
        share(
            self.due()
                .map(|(piece, distance)| (piece.length, distance < tolerance)),
        )
    }

    /// Ink that counts: intersections are not in the reference, so theirs counts only where a line is.
    fn judged(&self, tolerance: f64) -> impl Iterator<Item = (&InkPoint, bool)> {
        self.ink
            .iter()
            .zip(&self.to_piece)
            .filter_map(move |(point, nearest)| {
                let right = nearest.is_some_and(|(_, distance)| distance < tolerance);
                let known = self.kind(point) != Kind::Intersection;
                (right || known).then_some((point, right))
            })
    }

    fn kind(&self, point: &InkPoint) -> Kind {
        self.curves[point.curve as usize].kind
    }

    fn precision(&self, tolerance: f64) -> f64 {
        share(
            self.judged(tolerance)
                .map(|(point, right)| (point.length, right)),
        )
    }

    fn missing(&self, tolerance: f64) -> Vec<Fault> {
        let lost = self.due().filter(|(_, distance)| *distance >= tolerance);
        lost.map(|(piece, _)| Fault {
            at: piece.at,
            length: piece.length,
            kind: piece.kind,
        })
        .collect()
    }

    fn spurious(&self, tolerance: f64) -> Vec<Fault> {
        let wrong = self.judged(tolerance).filter(|(_, right)| !right);
        wrong
            .map(|(point, _)| Fault {
                at: point.at,
                length: point.length,
                kind: self.kind(point),
            })
            .collect()
    }

    /// Mean offset of contour ink to its line, outward positive.
    fn bias(&self) -> f64 {
        let (mut sum, mut weight) = (0.0, 0.0);
        for (point, nearest) in self.ink.iter().zip(&self.to_piece) {
            let Some((piece, _)) = nearest else { continue };
            let piece = &self.pieces[*piece];
            if piece.kind != Kind::Contour || self.kind(point) != Kind::Contour {
                continue;
            }
            let offset: f64 = (0..2)
                .map(|i| (point.at[i] - piece.at[i]) * piece.outward[i])
                .sum();
            sum += offset * point.length;
            weight += point.length;
        }
        if weight > 0.0 { sum / weight } else { 0.0 }
    }
}

/// The part of all length that is right; 1 of none.
fn share(lengths: impl Iterator<Item = (f64, bool)>) -> f64 {
    let (mut right, mut all) = (0.0, 0.0);
    for (length, is_right) in lengths {
        all += length;
        right += if is_right { length } else { 0.0 };
    }
    if all > 0.0 { right / all } else { 1.0 }
}

fn pieces(lengths: impl Iterator<Item = f64>) -> Pieces {
    let lengths: Vec<f64> = lengths.collect();
    let sum: f64 = lengths.iter().sum();
    let squares: f64 = lengths.iter().map(|length| length * length).sum();
    let short = lengths.iter().filter(|length| **length < SHORT_PX).count();
    let is_long = |length: &&f64| **length >= SHORTEST_PX;
    Pieces {
        count: lengths.len(),
        long: lengths.iter().filter(is_long).count(),
        mean_px: if sum > 0.0 { squares / sum } else { 0.0 },
        short: short as f64 / lengths.len().max(1) as f64,
    }
}

/// Gathers faults that lie near each other, longest first.
fn clusters(faults: &[Fault]) -> Vec<Fault> {
    let bins = Bins::new(faults.iter().map(|fault| fault.at).collect(), CLUSTER_PX);
    let mut seen = vec![false; faults.len()];
    let mut found = Vec::new();
    for first in 0..faults.len() {
        // Grow a cluster from every fault that is in none.
        let mut open = vec![first];
        let mut members = Vec::new();
        while let Some(fault) = open.pop() {
            if !std::mem::replace(&mut seen[fault], true) {
                members.push(faults[fault]);
                open.extend(
                    bins.near(faults[fault].at, CLUSTER_PX)
                        .map(|(near, _)| near),
                );
            }
        }
        found.extend(merged(&members));
    }

    // List the longest first.
    found.sort_by(|a, b| b.length.total_cmp(&a.length));
    found
}

/// One fault for several: it lies at the member nearest to their mean.
fn merged(members: &[Fault]) -> Option<Fault> {
    // Find the member in the middle.
    let length: f64 = members.iter().map(|fault| fault.length).sum();
    let mean = [0, 1].map(|i| members.iter().map(|f| f.at[i]).sum::<f64>() / members.len() as f64);
    let to_mean = |fault: &&Fault| distance(fault.at, mean);
    let middle = members
        .iter()
        .min_by(|a, b| to_mean(a).total_cmp(&to_mean(b)))?;

    // Give it the kind of most of the length.
    let of_kind = |kind: Kind| {
        members
            .iter()
            .filter(|f| f.kind == kind)
            .map(|f| f.length)
            .sum::<f64>()
    };
    let kind = Kind::ALL
        .into_iter()
        .max_by(|a, b| of_kind(*a).total_cmp(&of_kind(*b)))?;
    Some(Fault {
        at: middle.at,
        length,
        kind,
    })
}

#[cfg(test)]
mod tests {
    use super::super::drawn::DrawnStroke;
    use super::*;
    use npr_vector::stroke::{Stroke, StrokePoint};

    const FRAME: [u32; 2] = [400, 300];

    fn stroke(points: &[[f64; 2]], kind: Kind) -> Stroke {
        let point = |position: &[f64; 2]| StrokePoint {
            position: *position,
            ..StrokePoint::default()
        };
        Stroke {
            id: 0,
            kind,
            occluders: 0,
            surface: 0,
            closed: false,
            part: None,
            points: points.iter().map(point).collect(),
        }
    }

    fn drawing(strokes: Vec<Stroke>) -> Drawing {
        Drawing {
            size: FRAME,
            strokes,
            ..Drawing::default()
        }
    }

    /// A horizontal contour from 50 to 350 with the surface below it.
    fn line() -> Reference {
        let at = |i: usize| [50.25 + 0.5 * i as f64, 100.0];
        let piece = |i: usize| Piece {
            at: at(i),
            length: 0.5,
            kind: Kind::Contour,
            due: true,
            outward: [0.0, -1.0],
        };
        let run = super::super::chains::Run {
            layer: super::super::layers::Layer {
                kind: Kind::Contour,
                object: 0,
            },
            closed: false,
            points: (0..600).map(at).collect(),
            length: 300.0,
        };
        Reference {
            pieces: (0..600).map(piece).collect(),
            runs: vec![run.clone()],
            joined: vec![run],
            hidden_px: 0.0,
            drawn: Vec::new(),
        }
    }

    fn near(found: f64, expected: f64) -> bool {
        (found - expected).abs() < 0.01
    }

    #[test]
    fn the_reference_itself_is_perfect() {
        let ink = drawing(vec![stroke(
            &[[50.0, 100.0], [350.0, 100.0]],
            Kind::Contour,
        )]);
        let found = measure(&ink, &line());
        assert_eq!((found.recall, found.precision), ([1.0; 3], [1.0; 3]));
        assert!(found.missing.is_empty() && found.spurious.is_empty());
        assert_eq!(
            (found.fragmentation(Against::Runs), found.doubles),
            (1.0, 0.0)
        );
        assert!(near(found.strokes.mean_px, 300.0) && near(found.bias_px, 0.0));
    }

    #[test]
    fn five_pixels_off_nothing_is_right() {
        let ink = drawing(vec![stroke(
            &[[50.0, 105.0], [350.0, 105.0]],
            Kind::Contour,
        )]);
        let found = measure(&ink, &line());
        assert_eq!((found.recall, found.precision), ([0.0; 3], [0.0; 3]));
        assert_eq!((found.missing.len(), found.spurious.len()), (1, 1));
        assert!(
            near(found.missing[0].length, 300.0) && (found.missing[0].at[0] - 200.0).abs() < 1.0
        );
    }

    #[test]
    fn tolerances_and_bias_follow_the_offset() {
        let ink = drawing(vec![stroke(
            &[[50.0, 101.5], [350.0, 101.5]],
            Kind::Contour,
        )]);
        let found = measure(&ink, &line());
        assert_eq!(
            (found.recall, found.precision),
            ([0.0, 1.0, 1.0], [0.0, 1.0, 1.0])
        );
        assert!(near(found.bias_px, -1.5));
    }

    #[test]
    fn half_a_line_is_half_found() {
        let ink = drawing(vec![stroke(
            &[[50.0, 100.0], [200.0, 100.0]],
            Kind::Contour,
        )]);
        let found = measure(&ink, &line());
        assert!(near(found.recall[1], 0.5) && found.precision[1] == 1.0);
        assert!(
            (found.missing[0].at[0] - 275.0).abs() < 3.0 && found.missing[0].kind == Kind::Contour
        );
    }

    #[test]
    fn nothing_drawn_is_all_missing_and_nothing_wrong() {
        let found = measure(&drawing(vec![]), &line());
        assert_eq!((found.recall, found.precision), ([0.0; 3], [1.0; 3]));
        let found = measure(&drawing(vec![]), &Reference::default());
        assert_eq!(
            (found.recall, found.fragmentation(Against::Runs)),
            ([1.0; 3], 1.0)
        );
    }

    #[test]
    fn a_line_drawn_twice_is_double_and_in_two_pieces() {
        let rows = [100.0, 101.0].map(|y| stroke(&[[50.0, y], [350.0, y]], Kind::Contour));
        let found = measure(&drawing(rows.to_vec()), &line());
        assert!(near(found.extra_doubles(), 1.0) && found.fragmentation(Against::Runs) == 2.0);
    }

    #[test]
    fn specks_count_on_neither_side_against_a_pen() {
        let speck = |x: f64| stroke(&[[x, 120.0], [x + 7.0, 120.0]], Kind::Contour);
        let whole = stroke(&[[50.0, 100.0], [350.0, 100.0]], Kind::Contour);
        let drawn = |length: f64| DrawnStroke {
            closed: false,
            points: Vec::new(),
            length,
        };
        let reference = Reference {
            drawn: vec![drawn(300.0), drawn(7.0)],
            ..line()
        };
        let found = measure(&drawing(vec![whole, speck(60.0), speck(90.0)]), &reference);
        assert_eq!(
            (found.strokes.count, found.strokes.long, found.drawn.long),
            (3, 1, 1)
        );
        assert_eq!(found.fragmentation(Against::Drawn), 1.0);
        assert_eq!(found.fragmentation(Against::Runs), 3.0);
        assert!(near(found.strokes.short, 2.0 / 3.0));
    }

    #[test]
    fn crossing_lines_and_a_bend_are_no_doubles() {
        let strokes = vec![
            stroke(&[[50.0, 100.0], [350.0, 100.0]], Kind::Contour),
            stroke(
                &[[200.0, 50.0], [200.0, 150.0], [240.0, 50.0]],
                Kind::Crease,
            ),
        ];
        let found = measure(&drawing(strokes), &line());
        assert!(found.doubles < 0.05, "{}", found.doubles);
    }

    #[test]
    fn ink_of_intersections_counts_only_where_a_line_is() {
        let strokes = vec![
            stroke(&[[50.0, 100.0], [350.0, 100.0]], Kind::Intersection),
            stroke(&[[50.0, 200.0], [350.0, 200.0]], Kind::Intersection),
        ];
        let found = measure(&drawing(strokes), &line());
        assert_eq!((found.recall[1], found.precision[1]), (1.0, 1.0));
    }

    #[test]
    fn hidden_strokes_and_ink_out_of_the_frame_are_not_seen() {
        let mut hidden = stroke(&[[50.0, 100.0], [350.0, 100.0]], Kind::Contour);
        hidden.occluders = 1;
        let outside = stroke(&[[-50.0, 20.0], [-9.0, 20.0]], Kind::Contour);
        let found = measure(&drawing(vec![hidden, outside]), &line());
        assert_eq!((found.recall[2], found.ink_px), (0.0, 0.0));
    }

    #[test]
    fn broken_numbers_do_no_harm() {
        let ink = drawing(vec![stroke(
            &[[f64::NAN, 1.0], [f64::INFINITY, 2.0], [1e300, 0.0]],
            Kind::Crease,
        )]);
        assert_eq!(measure(&ink, &line()).recall, [0.0; 3]);
    }
}
