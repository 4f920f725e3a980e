//! Drawn strokes cut where the line becomes another one: strokes of a drawing have one kind and lie on one object.
//!
//! The pen of [`super::drawn`] follows ink, and ink has no kind. A drawing's strokes are sorted into groups per kind
//! and object, so that a contour that goes on as a crease is two strokes there, however well it is drawn. Here a
//! stroke of the pen is cut where it must be for that, and no more often: what is within the pen's width on paper is
//! its ink, a layer that leaves for less than the shortest stroke has not left, and of all ways to go from layer to
//! layer the one with the fewest pieces is taken.

use std::ops::Range;

use npr_vector::stroke::Kind;

use super::chains::Run;
use super::drawn::DrawnStroke;
use super::ink::{Bins, Curve, distance, sample};
use super::net::SHORTEST_PX;
use super::pen::PEN_PX;

/// What strokes are grouped by. Of two that share a place the lesser counts, so contours come before features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Layer {
    /// What the line is.
    pub kind: Kind,
    /// Number of the object that it lies on.
    pub object: u32,
}

/// The ink of a picture, each point of it in its layer.
pub(crate) struct LayeredInk {
    bins: Bins,
    /// Of every point.
    layers: Vec<Layer>,
}

impl LayeredInk {
    /// Ink of runs, given as curves too, in a picture of `size` pixels.
    pub(crate) fn new(runs: &[Run], curves: &[Curve], size: [u32; 2]) -> Self {
        let is_near =
            |at: [f64; 2]| (0..2).all(|i| (-PEN_PX..=f64::from(size[i]) + PEN_PX).contains(&at[i]));
        let mut ink = sample(curves);
        ink.retain(|point| is_near(point.at));
        let layers = ink.iter().map(|point| runs[point.curve as usize].layer);
        Self {
            layers: layers.collect(),
            bins: Bins::new(ink.iter().map(|point| point.at).collect(), PEN_PX),
        }
    }

    /// The layers that have ink within the pen's width of a place, ascending.
    fn layers_at(&self, place: [f64; 2]) -> Vec<Layer> {
        let near = self.bins.near(place, PEN_PX);
        let mut found: Vec<Layer> = near.map(|(point, _)| self.layers[point]).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The layers in which a line leaves its first point: of those with ink there, the ones that stay longest, to 8
    /// pixels.
    pub(crate) fn layers_from(&self, points: &[[f64; 2]]) -> Vec<Layer> {
        let layers: Vec<Vec<Layer>> = points.iter().map(|at| self.layers_at(*at)).collect();
        longest_from_start(&stations(points), stretches(&stations(points), &layers))
    }

    /// The fewest pieces of one layer each that a stroke is made of, in order along it.
    pub(crate) fn cut(&self, stroke: DrawnStroke) -> Vec<DrawnStroke> {
        let layers: Vec<Vec<Layer>> = stroke.points.iter().map(|at| self.layers_at(*at)).collect();
        pieces(stroke, &layers)
    }
}

/// Part of a stroke along which a layer has ink, by points.
#[derive(Debug, Clone, PartialEq)]
struct Stretch {
    layer: Layer,
    range: Range<usize>,
}

fn pieces(stroke: DrawnStroke, layers: &[Vec<Layer>]) -> Vec<DrawnStroke> {
    if !stroke.closed {
        return cut_open(stroke, layers);
    }
    let held = stretches(&stations(&stroke.points), layers);
    if held.is_empty() || held.iter().any(|s| s.range == (0..layers.len())) {
        return vec![stroke];
    }
    // A closed stroke of several layers starts where one of them does.
    let opened = held.iter().map(|stretch| {
        let from = stretch.range.start;
        let mut turned = DrawnStroke {
            closed: false,
            ..stroke.clone()
        };
        turned.points.rotate_left(from);
        cut_open(turned, &[&layers[from..], &layers[..from]].concat())
    });
    let fewest = opened.min_by_key(Vec::len).unwrap_or_default();
    // One piece from a place to itself has only been opened.
    if fewest.len() == 1 {
        vec![stroke]
    } else {
        fewest
    }
}

fn cut_open(stroke: DrawnStroke, layers: &[Vec<Layer>]) -> Vec<DrawnStroke> {
    // Cover the stroke by as few stretches of one layer as can.
    let stations = stations(&stroke.points);
    let cover = fewest(&stations, &stretches(&stations, layers));
    let changes = cover
        .windows(2)
        .filter(|pair| pair[0].layer != pair[1].layer);
    let cuts: Vec<usize> = changes.map(|pair| cut(&pair[0], &pair[1])).collect();
    if cuts.is_empty() {
        return vec![stroke];
    }

    // Cut it where the layer changes.
    let starts = std::iter::once(0).chain(cuts.iter().copied());
    let ends = cuts.iter().map(|cut| cut + 1).chain([stroke.points.len()]);
    starts
        .zip(ends)
        .map(|(from, to)| DrawnStroke {
            closed: false,
            points: stroke.points[from..to].to_vec(),
            length: stations[to - 1] - stations[from],
        })
        .collect()
}

/// The point where one stretch gives way to the next: where both have ink, the lesser layer keeps it.
fn cut(one: &Stretch, next: &Stretch) -> usize {
    if one.layer < next.layer {
        one.range.end - 1
    } else {
        next.range.start
    }
}

/// Distance of every point from the start of a stroke, in pixels.
fn stations(points: &[[f64; 2]]) -> Vec<f64> {
    let mut at = 0.0;
    let steps = points.windows(2).map(|pair| {
        at += distance(pair[0], pair[1]);
        at
    });
    points
        .first()
        .map(|_| 0.0)
        .into_iter()
        .chain(steps)
        .collect()
}

/// Where each layer has ink for 8 pixels or more; it may be gone for less than that in between.
fn stretches(stations: &[f64], layers: &[Vec<Layer>]) -> Vec<Stretch> {
    let mut all: Vec<Layer> = layers.iter().flatten().copied().collect();
    all.sort_unstable();
    all.dedup();

    // Join points of a layer over short gaps.
    let of_layer = |layer: Layer| {
        let mut found: Vec<Stretch> = Vec::new();
        for point in (0..layers.len()).filter(|point| layers[*point].contains(&layer)) {
            match found.last_mut() {
                Some(last) if stations[point] - stations[last.range.end - 1] < SHORTEST_PX => {
                    last.range.end = point + 1;
                }
                _ => found.push(Stretch {
                    layer,
                    range: point..point + 1,
                }),
            }
        }
        found
    };

    // Drop stretches that are too short to be a line.
    let is_held = |s: &Stretch| stations[s.range.end - 1] - stations[s.range.start] >= SHORTEST_PX;
    all.into_iter().flat_map(of_layer).filter(is_held).collect()
}

/// The layers of the stretches that begin within 8 pixels of the start and end within 8 of the furthest such end.
fn longest_from_start(stations: &[f64], mut stretches: Vec<Stretch>) -> Vec<Layer> {
    let end = |s: &Stretch| stations[s.range.end - 1];
    stretches.retain(|s| stations[s.range.start] < SHORTEST_PX);
    let furthest = stretches.iter().map(end).fold(0.0, f64::max);
    stretches.retain(|s| end(s) > furthest - SHORTEST_PX);
    stretches.into_iter().map(|s| s.layer).collect()
}

/// The fewest stretches that leave no 8 pixels of a stroke over, in order along it; none where nothing is held.
///
/// From where the last one ends, the one that reaches furthest of those that begin less than 8 pixels on.
fn fewest(stations: &[f64], stretches: &[Stretch]) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    let mut reached = 0;
    loop {
        let follows = |s: &&Stretch| {
            s.range.end > reached + 1
                && (s.range.start <= reached
                    || stations[s.range.start] - stations[reached] < SHORTEST_PX)
        };
        // Of several as long, the lesser layer.
        let by_reach =
            |a: &&Stretch, b: &&Stretch| a.range.end.cmp(&b.range.end).then(b.layer.cmp(&a.layer));
        match stretches.iter().filter(follows).max_by(by_reach) {
            Some(next) => found.push(next.clone()),
            // Nothing has ink here: on to where something has.
            None => match stretches
                .iter()
                .filter(|s| s.range.start > reached)
                .min_by_key(|s| s.range.start)
            {
                Some(next) => {
                    reached = next.range.start;
                    continue;
                }
                None => return found,
            },
        }
        reached = found.last().map_or(reached, |last| last.range.end - 1);
        if stations[stations.len() - 1] - stations[reached] < SHORTEST_PX {
            return found;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::drawn::drawn_strokes;
    use proptest::prelude::*;

    const SIZE: [u32; 2] = [240, 240];

    const CONTOUR: Layer = Layer {
        kind: Kind::Contour,
        object: 0,
    };
    const CREASE: Layer = Layer {
        kind: Kind::Crease,
        object: 0,
    };
    const ELSEWHERE: Layer = Layer {
        kind: Kind::Contour,
        object: 1,
    };

    /// Places around the middle.
    type Line = (Layer, bool, Vec<[f64; 2]>);

    fn level(layer: Layer, from: f64, to: f64, y: f64) -> Line {
        (layer, false, vec![[from, y], [to, y]])
    }

    fn upright(layer: Layer, from: f64, to: f64) -> Line {
        (layer, false, vec![[0.0, from], [0.0, to]])
    }

    /// A part of a circle around the middle, from share to share.
    fn arc(layer: Layer, from: f64, to: f64) -> Line {
        let at = |i: i32| {
            let angle = std::f64::consts::TAU * (from + (to - from) * f64::from(i) / 100.0);
            [70.0 * libm::cos(angle), 70.0 * libm::sin(angle)]
        };
        (layer, to - from == 1.0, (0..=100).map(at).collect())
    }

    /// Pictures, and how many strokes each takes.
    fn pictures() -> Vec<(&'static str, Vec<Line>, usize)> {
        let changing = |step: f64| {
            let dash = move |i: i32| {
                let layer = if i % 2 == 0 { CONTOUR } else { CREASE };
                let from = f64::from(i) * step - 60.0;
                level(layer, from, from + step, 0.0)
            };
            (0..(120.0 / step) as i32).map(dash).collect()
        };
        let whole = |layer, y| level(layer, -80.0, 80.0, y);
        let half = |layer, to| level(layer, 0.0, to, 0.0);
        vec![
            ("one kind", vec![whole(CONTOUR, 0.0)], 1),
            (
                "half and half",
                vec![half(CONTOUR, -80.0), half(CREASE, 80.0)],
                2,
            ),
            (
                "on to another object",
                vec![half(CONTOUR, -80.0), half(ELSEWHERE, 80.0)],
                2,
            ),
            ("a change every 3 pixels", changing(3.0), 1),
            ("a change every 20 pixels", changing(20.0), 6),
            (
                "a crease beside a contour",
                vec![whole(CONTOUR, 0.0), whole(CREASE, 2.0)],
                1,
            ),
            (
                "another kind for 5 pixels",
                vec![
                    half(CONTOUR, -80.0),
                    half(CREASE, 5.0),
                    level(CONTOUR, 5.0, 80.0, 0.0),
                ],
                1,
            ),
            (
                "a contour and a crease with a stretch of both",
                vec![
                    level(CONTOUR, -80.0, 30.0, 0.0),
                    level(CREASE, -30.0, 80.0, 1.0),
                ],
                2,
            ),
            (
                "a crease that a contour joins for a while",
                vec![whole(CREASE, 0.0), level(CONTOUR, -30.0, 30.0, 1.0)],
                1,
            ),
            (
                "a crossing",
                vec![whole(CONTOUR, 0.0), upright(CREASE, -80.0, 80.0)],
                2,
            ),
            (
                "a T",
                vec![whole(CONTOUR, 0.0), upright(CREASE, 0.0, 80.0)],
                2,
            ),
            (
                "a contour around a corner that a crease goes on from",
                vec![
                    half(CONTOUR, -80.0),
                    half(CREASE, 80.0),
                    upright(CONTOUR, 0.0, 80.0),
                ],
                2,
            ),
            (
                "a corner of contours that a crease joins",
                vec![
                    half(CONTOUR, -80.0),
                    upright(CREASE, -80.0, 0.0),
                    level(CONTOUR, 0.0, 80.0, 0.0),
                ],
                2,
            ),
            (
                "three edges of a box that meet in a corner",
                vec![
                    half(CREASE, -80.0),
                    (CREASE, false, vec![[0.0, 0.0], [40.0, 69.3]]),
                    (CREASE, false, vec![[0.0, 0.0], [40.0, -69.3]]),
                ],
                3,
            ),
            (
                "a contour that another object's leaves slowly, and comes back to",
                vec![
                    whole(CONTOUR, 0.0),
                    (
                        ELSEWHERE,
                        false,
                        vec![[-60.0, 0.0], [0.0, 12.0], [60.0, 0.0]],
                    ),
                ],
                2,
            ),
            ("a circle", vec![arc(CREASE, 0.0, 1.0)], 1),
            (
                "a circle in halves",
                vec![arc(CREASE, 0.0, 0.5), arc(CONTOUR, 0.5, 1.0)],
                2,
            ),
            (
                "a circle of two that both go on under each other",
                vec![arc(CREASE, 0.1, 0.9), arc(CONTOUR, 0.8, 1.2)],
                2,
            ),
            (
                "a circle of four quarters",
                vec![
                    arc(CREASE, 0.0, 0.25),
                    arc(CONTOUR, 0.25, 0.5),
                    arc(CREASE, 0.5, 0.75),
                    arc(ELSEWHERE, 0.75, 1.0),
                ],
                4,
            ),
        ]
    }

    fn placed(picture: &[Line], angle: f64, offset: [f64; 2]) -> Vec<Run> {
        let [cos, sin] = [libm::cos(angle), libm::sin(angle)];
        let place = |[x, y]: &[f64; 2]| {
            [
                120.0 + offset[0] + cos * x - sin * y,
                120.0 + offset[1] + sin * x + cos * y,
            ]
        };
        let run = |(layer, closed, points): &Line| Run {
            layer: *layer,
            closed: *closed,
            points: points.iter().map(place).collect(),
            length: 0.0,
        };
        picture.iter().map(run).collect()
    }

    fn layer_of(number: u8) -> Layer {
        [CONTOUR, CREASE, ELSEWHERE][usize::from(number) % 3]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn pictures_take_as_many_strokes_however_they_are_turned(
            angle in 0.0..7.0f64, x in -1.0..1.0f64, y in -1.0..1.0f64, which in 0..pictures().len(),
        ) {
            let (name, picture, expected) = &pictures()[which];
            let found = drawn_strokes(&placed(picture, angle, [x, y]), SIZE);
            prop_assert_eq!(found.len(), *expected, "{}", name);
        }

        /// Of all choices of stretches that leave no 8 pixels over, none is smaller.
        #[test]
        fn no_choice_of_stretches_is_smaller(
            tiles in prop::collection::vec((8..30usize, 0..25usize, 0..25usize, 0..3u8), 1..9),
        ) {
            let count: usize = tiles.iter().map(|tile| tile.0).sum();
            let stations: Vec<f64> = (0..count).map(|i| i as f64).collect();
            let mut from = 0;
            let all: Vec<Stretch> = tiles.iter().map(|(length, before, after, layer)| {
                let range = from.max(*before) - before..(from + length + after).min(count);
                from += length;
                Stretch { layer: layer_of(*layer), range }
            }).collect();
            let leaves_little = |chosen: &[&Stretch]| {
                let is_bare = |point: &usize| chosen.iter().all(|s| !s.range.contains(point));
                // 7 points without any lie 8 pixels apart, from the last one with to the next; at the ends 8 do.
                let bare: Vec<bool> = (0..count).map(|point| is_bare(&point)).collect();
                bare.chunk_by(|a, b| a == b).filter(|part| part[0]).all(|part| part.len() < 7)
                    || (bare.len() < 8)
            };
            let smallest = (0..1u32 << all.len())
                .map(|bits| {
                    let chosen = all.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1);
                    chosen.map(|(_, s)| s).collect::<Vec<_>>()
                })
                .filter(|chosen| !chosen.is_empty() && leaves_little(chosen))
                .map(|chosen| chosen.len())
                .min();
            let found = fewest(&stations, &all);
            prop_assert!(Some(found.len()) <= smallest, "{} of {:?}", found.len(), smallest);
            let covered = |point: usize| found.iter().any(|s| s.range.start < point + 8 && point < s.range.end + 8);
            prop_assert!((0..count).all(covered));
        }

        /// Pieces are the stroke, cut; they follow one another by a shared point, and layers change from one to the
        /// next.
        #[test]
        fn pieces_put_together_are_the_stroke(
            layers in prop::collection::vec((1..20usize, prop::collection::vec(0..3u8, 0..3)), 1..12), closed: bool,
        ) {
            let layers: Vec<Vec<Layer>> = layers
                .iter()
                .flat_map(|(count, numbers)| vec![numbers.iter().map(|n| layer_of(*n)).collect::<Vec<_>>(); *count])
                .collect();
            let points: Vec<[f64; 2]> = (0..layers.len()).map(|i| [i as f64, 0.0]).collect();
            let stroke = DrawnStroke { closed, length: points.len() as f64, points: points.clone() };
            let found = pieces(stroke.clone(), &layers);
            if found.len() == 1 {
                prop_assert_eq!(&found[0], &stroke);
            } else {
                prop_assert!(found.windows(2).all(|pair| pair[0].points.last() == pair[1].points.first()));
                let mut whole: Vec<[f64; 2]> = found.iter().flat_map(|piece| piece.points.clone()).collect();
                whole.dedup();
                let start = points.iter().position(|p| *p == whole[0]).unwrap_or(0);
                let mut expected = points.clone();
                expected.rotate_left(start);
                prop_assert_eq!(whole, expected);
                prop_assert!(closed || start == 0);
            }
            let mut kinds: Vec<Layer> = layers.concat();
            kinds.sort_unstable();
            kinds.dedup();
            prop_assert!(kinds.len() > 1 || found.len() == 1);
        }

        #[test]
        fn any_numbers_may_be_drawn(
            lines in prop::collection::vec(
                (0..3u8, any::<bool>(), prop::collection::vec(any::<[f64; 2]>(), 0..5)), 0..5,
            ),
            size in prop::array::uniform2(0..40u32),
        ) {
            let run = |(number, closed, points): &(u8, bool, Vec<[f64; 2]>)| Run {
                layer: layer_of(*number),
                closed: *closed,
                points: points.iter().map(|p| p.map(|v| v % 1e3)).collect(),
                length: 0.0,
            };
            let runs: Vec<Run> = lines.iter().map(run).collect();
            prop_assert!(drawn_strokes(&runs, size).len() < 80);
        }
    }
}
