//! How many strokes of a pen a picture takes: the picture is drawn, and strokes are read off the paper.
//!
//! Edges of a fine mesh zigzag about the line that one sees, in and out of sight, and lie side by side nearer than any pen
//! can tell apart; counted along the mesh, that is hundreds of runs where a draughtsman draws two. So lines are
//! drawn with a pen of 3 pixels ([`super::pen`]), thinned to their middle, and followed from end to end. Lines nearer than the pen
//! count once. A pen goes round any corner, so a square is one stroke; where lines meet, it goes on in the straightest one,
//! if that turns by less than 45 degrees. No constant here comes from what drawings scored.

use std::collections::BTreeMap;

use glam::DVec2;

use super::chains::{Chain, Joints};
use super::ink::{Curve, sample};
use super::pen::{PEN_PX, Paper};

/// Shorter strokes are specks, shorter spurs and bridges artefacts of thinning, in pixels: under three widths of the pen.
const SHORTEST_PX: f64 = 8.0;

/// Distance along a line over which its direction at a meeting is taken, in pixels. It starts a pen's width away, for
/// thinning bends lines within that.
const DIRECTION_PX: f64 = 4.0 * PEN_PX;

/// Where a line ends and no other begins.
const FREE: u32 = u32::MAX;

/// A stroke of the pen.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnStroke {
    /// It runs on from its end to its start.
    pub closed: bool,
    /// Half a pixel apart, in pixels.
    pub points: Vec<[f64; 2]>,
    /// In pixels; up to 8 % long, for it goes from pixel to pixel.
    pub length: f64,
}

/// The strokes that a picture of `curves` takes; size in pixels.
///
/// O(pixels of the picture + length of the curves times the pen's width), and the square of the spurs of one picture.
pub fn drawn_strokes(curves: &[Curve], size: [u32; 2]) -> Vec<DrawnStroke> {
    let mut paper = Paper::new(size);
    sample(curves)
        .iter()
        .for_each(|point| paper.touch(point.at));
    paper.fill_specks();
    paper.thin();
    let mut net = Net::read(&paper);
    net.cut_spurs();
    net.contract_bridges();
    net.strokes()
}

/// A line between two meetings.
#[derive(Debug, Clone, PartialEq)]
struct Arc {
    points: Vec<[f64; 2]>,
    length: f64,
    /// The meetings at its first and last point.
    ends: [u32; 2],
    closed: bool,
}

impl Arc {
    fn new(points: Vec<[f64; 2]>, ends: [u32; 2], closed: bool) -> Self {
        let path = Curve {
            kind: npr_vector::stroke::Kind::Contour,
            closed,
            points,
        };
        Self {
            length: path.length(),
            points: path.points,
            ends,
            closed,
        }
    }

    fn turned(mut self) -> Self {
        self.points.reverse();
        self.ends.reverse();
        self
    }

    /// Unit vector away from one end.
    fn direction(&self, at_tail: bool) -> DVec2 {
        let count = self.points.len();
        let walk = |i: usize| DVec2::from(self.points[if at_tail { i } else { count - 1 - i }]);
        let at = |px: f64| {
            let mut passed = 0.0;
            let step = |i: &usize| {
                passed += walk(*i).distance(walk(i - 1));
                passed >= px
            };
            walk((1..count).find(step).unwrap_or(count - 1))
        };
        // A line too short to leave the blot of the meeting is taken whole.
        let from = if self.length > 2.0 * PEN_PX {
            at(PEN_PX)
        } else {
            walk(0)
        };
        (at(DIRECTION_PX) - from).normalize_or_zero()
    }
}

/// All lines on the paper.
#[derive(Debug, Clone, Default, PartialEq)]
struct Net {
    arcs: Vec<Arc>,
}

impl Net {
    /// Follows thinned lines from meeting to meeting.
    fn read(paper: &Paper) -> Self {
        let mut reader = Reader::new(paper);
        let meetings: Vec<(usize, u32)> = reader.meetings.iter().map(|(p, m)| (*p, *m)).collect();
        for (pixel, _) in meetings {
            for near in paper.black_around(pixel).collect::<Vec<_>>() {
                reader.follow(&[pixel, near]);
            }
        }
        let black = paper.black_pixels();
        let is_end = |pixel: &&usize| paper.black_around(**pixel).count() <= 1;
        for pixel in black.iter().filter(is_end).chain(&black) {
            reader.follow(&[*pixel]);
        }
        Self { arcs: reader.arcs }
    }

    /// Which ends of which arcs meet, by meeting: number of the arc, and whether its tail is there.
    fn meetings(&self) -> BTreeMap<u32, Vec<(u32, bool)>> {
        let mut found: BTreeMap<u32, Vec<(u32, bool)>> = BTreeMap::new();
        for (number, arc) in (0..).zip(&self.arcs) {
            for (end, at_tail) in arc.ends.into_iter().zip([true, false]) {
                if end != FREE {
                    found.entry(end).or_default().push((number, at_tail));
                }
            }
        }
        found
    }

    /// Takes away lines that leave a meeting and stop soon, the shortest first; what is left of two goes on as one.
    fn cut_spurs(&mut self) {
        let is_spur = |arc: &Arc| {
            arc.length < SHORTEST_PX && arc.ends.contains(&FREE) && arc.ends != [FREE; 2]
        };
        loop {
            let spurs = self.arcs.iter().enumerate().filter(|(_, arc)| is_spur(arc));
            let Some((shortest, _)) = spurs.min_by(|a, b| a.1.length.total_cmp(&b.1.length)) else {
                return;
            };
            let ends = self.arcs.swap_remove(shortest).ends;
            self.go_on(if ends[0] == FREE { ends[1] } else { ends[0] });
        }
    }

    /// Where only two ends are left of a meeting, there is none.
    fn go_on(&mut self, meeting: u32) {
        let ends = self.meetings().remove(&meeting).unwrap_or_default();
        let ends: Vec<(usize, bool)> = ends
            .into_iter()
            .map(|(arc, at)| (arc as usize, at))
            .collect();
        match ends[..] {
            [(a, _), (b, _)] if a == b => {
                let arc = self.arcs.swap_remove(a);
                self.arcs.push(Arc::new(arc.points, [FREE; 2], true));
            }
            [(a, a_at_tail), (b, b_at_tail)] => {
                // The later one first: what takes its place is neither of the two.
                let second = self.arcs.swap_remove(b);
                let first = self.arcs.swap_remove(a);
                let first = if a_at_tail { first.turned() } else { first };
                let second = if b_at_tail { second } else { second.turned() };
                let points = first.points.into_iter().chain(second.points).collect();
                self.arcs
                    .push(Arc::new(points, [first.ends[0], second.ends[1]], false));
            }
            [(a, at_tail)] => self.arcs[a].ends[usize::from(!at_tail)] = FREE,
            _ => {}
        }
    }

    /// Makes one meeting of those that a short bridge joins: crossing lines run together for a moment.
    fn contract_bridges(&mut self) {
        let is_bridge = |arc: &Arc| arc.length < SHORTEST_PX && !arc.ends.contains(&FREE);
        while let Some(bridge) = self.arcs.iter().position(is_bridge) {
            let [kept, lost] = self.arcs.swap_remove(bridge).ends;
            for end in self.arcs.iter_mut().flat_map(|arc| &mut arc.ends) {
                *end = if *end == lost { kept } else { *end };
            }
            self.go_on(kept);
        }
    }

    /// Joins lines through meetings; specks are left out.
    fn strokes(&self) -> Vec<DrawnStroke> {
        let mut joints = Joints::new(self.arcs.len());
        for ends in self.meetings().into_values() {
            let direction =
                |(arc, at_tail): &(u32, bool)| self.arcs[*arc as usize].direction(*at_tail);
            let directions: Vec<DVec2> = ends.iter().map(direction).collect();
            joints.join_straightest(&ends, |a, b| -directions[a].dot(directions[b]));
        }
        let strokes = joints.chains().into_iter().map(|chain| self.stroke(&chain));
        strokes
            .filter(|stroke| stroke.length >= SHORTEST_PX)
            .collect()
    }

    fn stroke(&self, chain: &Chain) -> DrawnStroke {
        let arcs = || {
            chain
                .links
                .iter()
                .map(|(number, backwards)| (&self.arcs[*number as usize], *backwards))
        };
        let points = arcs().flat_map(|(arc, backwards)| {
            let count = arc.points.len();
            (0..count).map(move |i| arc.points[if backwards { count - 1 - i } else { i }])
        });
        // A line that nothing meets is a chain of itself, whose ends the joints do not know.
        let alone = matches!(chain.links[..], [(number, _)] if self.arcs[number as usize].ends == [FREE; 2]);
        DrawnStroke {
            closed: if alone {
                arcs().any(|(arc, _)| arc.closed)
            } else {
                chain.closed
            },
            points: points.collect(),
            length: arcs().map(|(arc, _)| arc.length).sum(),
        }
    }
}

/// Follows thinned lines.
struct Reader<'a> {
    paper: &'a Paper,
    /// The meeting that a pixel of three or more neighbours is part of.
    meetings: BTreeMap<usize, u32>,
    /// Pixels of lines that have been followed.
    followed: Vec<bool>,
    arcs: Vec<Arc>,
}

impl<'a> Reader<'a> {
    fn new(paper: &'a Paper) -> Self {
        let crowded = |pixel: &usize| paper.black_around(*pixel).count() > 2;
        let black = paper.black_pixels();
        let mut meetings: BTreeMap<usize, u32> = BTreeMap::new();
        for (number, start) in (0..).zip(black.iter().copied().filter(crowded)) {
            // Pixels that touch are one meeting.
            let mut open = vec![start];
            while let Some(pixel) = open.pop() {
                if crowded(&pixel) && !meetings.contains_key(&pixel) {
                    meetings.insert(pixel, number);
                    open.extend(paper.black_around(pixel));
                }
            }
        }
        Self {
            paper,
            meetings,
            followed: vec![false; black.last().map_or(0, |last| last + 1)],
            arcs: Vec::new(),
        }
    }

    /// Follows a line on from its first pixels; nothing where it has been followed before, or lies within a meeting.
    fn follow(&mut self, start: &[usize]) {
        let mut path = start.to_vec();
        let mut here = path[path.len() - 1];
        if self.followed[here] || self.meetings.contains_key(&here) {
            return;
        }
        let from = self.meetings.get(&path[0]).copied();
        let to = loop {
            self.followed[here] = true;
            let before = path.len().checked_sub(2).map(|i| path[i]);
            let fresh = |near: &usize| Some(*near) != before && !self.followed[*near];
            // Lines step to a side rather than to a corner, so that they cut none.
            let Some(next) = self.paper.black_around(here).find(fresh) else {
                break None;
            };
            path.push(next);
            if let Some(meeting) = self.meetings.get(&next) {
                break Some(*meeting);
            }
            here = next;
        };
        let round = path.len() > 2 && self.paper.black_around(path[0]).any(|near| near == here);
        let closed = from.is_none() && to.is_none() && round;
        let points = path.iter().map(|pixel| self.paper.place(*pixel)).collect();
        let ends = [from, to].map(|meeting| meeting.unwrap_or(FREE));
        self.arcs.push(Arc::new(points, ends, closed));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::analytic::Solid;
    use crate::lines::subjects::benchmark_camera;
    use npr_core::camera::Camera;
    use npr_vector::stroke::Kind;
    use proptest::prelude::*;

    const SIZE: [u32; 2] = [240, 240];

    /// Places around the middle, each line with whether it is closed.
    type Picture = Vec<(Vec<[f64; 2]>, bool)>;

    fn line(from: [f64; 2], to: [f64; 2]) -> (Vec<[f64; 2]>, bool) {
        (vec![from, to], false)
    }

    fn around(count: u32, place: impl Fn(f64) -> [f64; 2]) -> (Vec<[f64; 2]>, bool) {
        let angle = |i| std::f64::consts::TAU * f64::from(i) / f64::from(count);
        ((0..count).map(|i| place(angle(i))).collect(), true)
    }

    fn circle(radius: f64) -> (Vec<[f64; 2]>, bool) {
        around(200, |a| [radius * libm::cos(a), radius * libm::sin(a)])
    }

    /// A line of 160 pixels that goes up and down by a pixel every two.
    fn zigzag() -> (Vec<[f64; 2]>, bool) {
        let tooth = |i: i32| [f64::from(2 * i), f64::from(2 * (i & 1) - 1)];
        ((-40..=40).map(tooth).collect(), false)
    }

    /// Pictures, and how many strokes each takes.
    fn pictures() -> Vec<(&'static str, Picture, usize)> {
        let specks = [[-50.0, 3.0], [0.0, 40.0], [30.0, -20.0]];
        let dashes = |gap: f64| {
            (0..4).map(move |i| {
                line(
                    [f64::from(i) * 30.0 - 60.0, 0.0],
                    [f64::from(i) * 30.0 - 30.0 - gap, 0.0],
                )
            })
        };
        vec![
            ("nothing", vec![], 0),
            ("a line", vec![line([-80.0, 0.0], [80.0, 0.0])], 1),
            ("a circle", vec![circle(70.0)], 1),
            ("a small circle", vec![circle(7.0)], 1),
            ("two circles", vec![circle(70.0), circle(55.0)], 2),
            (
                "a square: pens go round corners",
                vec![around(4, |a| [80.0 * libm::cos(a), 80.0 * libm::sin(a)])],
                1,
            ),
            (
                "crossing lines",
                vec![
                    line([-80.0, 0.0], [80.0, 0.0]),
                    line([0.0, -80.0], [0.0, 80.0]),
                ],
                2,
            ),
            (
                "lines that cross at 50 degrees",
                vec![
                    line([-80.0, 0.0], [80.0, 0.0]),
                    line([-51.4, -61.3], [51.4, 61.3]),
                ],
                2,
            ),
            (
                "a T",
                vec![
                    line([-80.0, 0.0], [80.0, 0.0]),
                    line([0.0, 0.0], [0.0, 80.0]),
                ],
                2,
            ),
            (
                "a Y: no two of three go on",
                vec![
                    line([0.0, 0.0], [0.0, 80.0]),
                    line([0.0, 0.0], [69.3, -40.0]),
                    line([0.0, 0.0], [-69.3, -40.0]),
                ],
                3,
            ),
            ("a zigzag of a pixel", vec![zigzag()], 1),
            (
                "lines ten pixels apart",
                vec![
                    line([-80.0, 0.0], [80.0, 0.0]),
                    line([-80.0, 10.0], [80.0, 10.0]),
                ],
                2,
            ),
            (
                "lines two pixels apart",
                vec![
                    line([-80.0, 0.0], [80.0, 0.0]),
                    line([-80.0, 2.0], [80.0, 2.0]),
                ],
                1,
            ),
            (
                "a line with a branch of four pixels",
                vec![
                    line([-80.0, 0.0], [80.0, 0.0]),
                    line([3.0, 0.0], [3.0, 4.0]),
                ],
                1,
            ),
            (
                "specks",
                specks.map(|at| line(at, [at[0] + 4.0, at[1]])).to_vec(),
                0,
            ),
            ("dashes with gaps of two pixels", dashes(2.0).collect(), 1),
            ("dashes with gaps of ten pixels", dashes(10.0).collect(), 4),
            (
                "a line drawn in ten pieces",
                (0..10)
                    .map(|i| {
                        line(
                            [f64::from(16 * i) - 80.0, 0.0],
                            [f64::from(16 * i) - 64.0, 0.0],
                        )
                    })
                    .collect(),
                1,
            ),
        ]
    }

    fn placed(picture: &Picture, angle: f64, offset: [f64; 2]) -> Vec<Curve> {
        let [cos, sin] = [libm::cos(angle), libm::sin(angle)];
        let place = |[x, y]: &[f64; 2]| {
            [
                120.0 + offset[0] + cos * x - sin * y,
                120.0 + offset[1] + sin * x + cos * y,
            ]
        };
        let curve = |(points, closed): &(Vec<[f64; 2]>, bool)| Curve {
            kind: Kind::Contour,
            closed: *closed,
            points: points.iter().map(place).collect(),
        };
        picture.iter().map(curve).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn pictures_take_as_many_strokes_however_they_are_turned(angle in 0.0..7.0f64, x in -1.0..1.0f64, y in -1.0..1.0f64, which in 0..18usize) {
            let (name, picture, expected) = &pictures()[which];
            let found = drawn_strokes(&placed(picture, angle, [x, y]), SIZE);
            prop_assert_eq!(found.len(), *expected, "{}", name);
        }

        #[test]
        fn strokes_lie_on_the_lines_and_show_all_that_is_long(points in prop::collection::vec((5.0..235.0f64, 5.0..235.0f64), 0..12), closed: bool) {
            let points = points.into_iter().map(|(x, y)| [x, y]).collect();
            let curves = [Curve { kind: Kind::Crease, closed, points }];
            let ink: Vec<[f64; 2]> = sample(&curves).iter().map(|point| point.at).collect();
            let strokes = drawn_strokes(&curves, SIZE);
            let near = |place: &[f64; 2], px: f64| ink.iter().any(|at| super::super::ink::distance(*at, *place) < px);
            for stroke in &strokes {
                prop_assert!(stroke.length >= SHORTEST_PX);
                prop_assert!(stroke.points.iter().all(|place| near(place, PEN_PX)));
            }
            prop_assert!(!strokes.is_empty() || ink.len() < 20);
        }

        #[test]
        fn any_numbers_may_be_drawn(points in prop::collection::vec(any::<[f64; 2]>(), 0..9), closed: bool, size in prop::array::uniform2(0..40u32)) {
            let curves = [Curve { kind: Kind::Crease, closed, points: points.into_iter().map(|p| p.map(|v| v % 1e5)).collect() }];
            prop_assert!(drawn_strokes(&curves, size).len() < 40);
        }
    }

    #[test]
    fn open_and_closed_strokes_are_told_apart() {
        let both = placed(
            &vec![circle(70.0), line([-20.0, 0.0], [20.0, 0.0])],
            0.3,
            [0.0; 2],
        );
        let mut found = drawn_strokes(&both, SIZE);
        found.sort_by(|a, b| a.length.total_cmp(&b.length));
        assert_eq!(
            found.iter().map(|s| s.closed).collect::<Vec<_>>(),
            [false, true]
        );
        assert!((found[1].length / (std::f64::consts::TAU * 70.0) - 1.0).abs() < 0.09);
        assert!((found[0].length - 40.0).abs() < 5.0);
    }

    #[test]
    fn the_outline_of_a_ring_is_two_strokes() {
        let camera = Camera {
            eye: benchmark_camera().eye.map(|v| 1.7 * v),
            ..benchmark_camera()
        };
        let size = [960, 540];
        let exact = Solid::Ring { tube: 0.4 }.reference(&camera, size);
        let curves: Vec<Curve> = exact.runs.iter().map(Curve::of_run).collect();
        assert_eq!((curves.len(), drawn_strokes(&curves, size).len()), (2, 2));
    }
}
