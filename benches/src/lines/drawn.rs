//! How many strokes of a pen a picture takes: the picture is drawn, and strokes are read off the paper.
//!
//! Edges of a fine mesh zigzag about the line that one sees, in and out of sight, and lie side by side nearer than
//! any pen can tell apart; counted along the mesh, that is hundreds of runs where a draughtsman draws two. So lines
//! are drawn with a pen of 3 pixels ([`super::pen`]), thinned to their middle, and followed from end to end. Lines
//! nearer than the pen count once. A pen goes round any corner, so a square is one stroke; where lines meet, it goes
//! on in the straightest one, if that turns by less than 45 degrees. Strokes are cut where the line becomes one of
//! another kind or object ([`super::layers`]), and lines of one kind find each other first. No constant here comes
//! from what drawings scored.

use super::chains::Run;
use super::ink::Curve;
use super::layers::LayeredInk;
use super::net::Net;
use super::pen::Paper;

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

/// The strokes that a picture of `runs` takes; size in pixels.
///
/// O(pixels of the picture + length of the runs times the pen's width), and the square of the spurs of one picture.
pub fn drawn_strokes(runs: &[Run], size: [u32; 2]) -> Vec<DrawnStroke> {
    let curves: Vec<Curve> = runs.iter().map(Curve::of_run).collect();
    let mut paper = Paper::new(size);
    curves
        .iter()
        .flat_map(Curve::segments)
        .for_each(|segment| paper.draw(segment));
    paper.fill_specks();
    paper.thin();
    let mut net = Net::read(&paper);
    net.cut_spurs();
    net.contract_bridges();
    let ink = LayeredInk::new(runs, &curves, size);
    let whole = net.strokes(&|points| ink.layers_from(points));
    whole
        .into_iter()
        .flat_map(|stroke| ink.cut(stroke))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::analytic::Solid;
    use crate::lines::ink::sample;
    use crate::lines::layers::Layer;
    use crate::lines::net::SHORTEST_PX;
    use crate::lines::pen::PEN_PX;
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

    fn run(kind: Kind, closed: bool, points: Vec<[f64; 2]>) -> Run {
        Run {
            layer: Layer { kind, object: 0 },
            closed,
            points,
            length: 0.0,
        }
    }

    fn placed(picture: &Picture, angle: f64, offset: [f64; 2]) -> Vec<Run> {
        let [cos, sin] = [libm::cos(angle), libm::sin(angle)];
        let place = |[x, y]: &[f64; 2]| {
            [
                120.0 + offset[0] + cos * x - sin * y,
                120.0 + offset[1] + sin * x + cos * y,
            ]
        };
        let placed = |(points, closed): &(Vec<[f64; 2]>, bool)| {
            run(Kind::Contour, *closed, points.iter().map(place).collect())
        };
        picture.iter().map(placed).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn pictures_take_as_many_strokes_however_they_are_turned(
            angle in 0.0..7.0f64, x in -1.0..1.0f64, y in -1.0..1.0f64, which in 0..18usize,
        ) {
            let (name, picture, expected) = &pictures()[which];
            let found = drawn_strokes(&placed(picture, angle, [x, y]), SIZE);
            prop_assert_eq!(found.len(), *expected, "{}", name);
        }

        #[test]
        fn strokes_lie_on_the_lines_and_show_all_that_is_long(
            points in prop::collection::vec((5.0..235.0f64, 5.0..235.0f64), 0..12), closed: bool,
        ) {
            let points = points.into_iter().map(|(x, y)| [x, y]).collect();
            let runs = [run(Kind::Crease, closed, points)];
            let ink: Vec<[f64; 2]> = sample(&[Curve::of_run(&runs[0])]).iter().map(|point| point.at).collect();
            let strokes = drawn_strokes(&runs, SIZE);
            let near = |place: &[f64; 2], px: f64| ink.iter().any(|at| super::super::ink::distance(*at, *place) < px);
            for stroke in &strokes {
                prop_assert!(stroke.length >= SHORTEST_PX);
                prop_assert!(stroke.points.iter().all(|place| near(place, PEN_PX)));
            }
            prop_assert!(!strokes.is_empty() || ink.len() < 20);
        }

        #[test]
        fn any_numbers_may_be_drawn(
            points in prop::collection::vec(any::<[f64; 2]>(), 0..9), closed: bool,
            size in prop::array::uniform2(0..40u32),
        ) {
            let points = points.into_iter().map(|p| p.map(|v| v % 1e5)).collect();
            prop_assert!(drawn_strokes(&[run(Kind::Crease, closed, points)], size).len() < 40);
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
        assert_eq!(
            (exact.runs.len(), drawn_strokes(&exact.runs, size).len()),
            (2, 2)
        );
    }
}
