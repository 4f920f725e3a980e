//! Strokes as stamps: the image of a brush set down again and again.

use crate::color_runs::point_between;
use crate::seed::Seed;
use npr_core::math::{cos_f64, sin_f64};
use npr_vector::ink_point::InkPoint;
use npr_vector::mesh_lines::run::distance;
use npr_vector::stroke::StrokePoint;

/// Least distance between stamps, in pixels.
const LEAST_SPACING_PX: f64 = 0.25;

/// Most stamps of one part of a stroke: beyond them they lie farther apart.
const STAMPS_MAX: f64 = 1e5;

/// Most pixels of texture on a pixel of a stroke that stamps are set on: more of it is a seam between two textures.
const SQUEEZED_MOST: f64 = 4.0;

/// How stamps lie along strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stamps {
    /// Distance between their middles, in pixels along the stroke.
    pub spacing_px: f64,
    /// Side of a stamp, as a multiple of the stroke's width there.
    pub size: f64,
    /// How often a stamp is as long as wide.
    pub length: f64,
    /// Greatest share by which chance makes one larger or smaller, 0..1.
    pub jitter: f64,
    /// Angle of all stamps, in radians, against the stroke where `rakes` is true, else against the picture.
    pub angle: f64,
    /// Greatest angle, in radians, by which chance turns one to either side.
    pub turn: f64,
    /// Whether they turn with the stroke.
    pub rakes: bool,
    /// Greatest distance from the stroke by chance, in widths of it.
    pub scatter: f64,
    /// What of the image lies on a stamp: where it starts, by chance anywhere if `None`, and its share of the image.
    pub part: (Option<f64>, f64),
    /// Whether stamps are round.
    pub is_round: bool,
}

impl Stamps {
    /// How far from its place on the stroke the ink of a stamp may lie, in widths of the stroke there.
    pub fn reach(&self) -> f64 {
        self.scatter + 0.5 * self.size * (1.0 + self.jitter) * (1.0 + self.length)
    }

    /// The stamps of a part of a stroke, two points each; `inked` gives what a point of the stroke has beside its
    /// place.
    ///
    /// They lie at multiples of the spacing in `u`, so those of one stroke hold still while its start moves, and none
    /// lies in a seam between two textures. Chance hangs on the stroke's id and the number of the stamp.
    pub(crate) fn along(
        &self,
        points: &[StrokePoint],
        is_closed: bool,
        id: u64,
        inked: &dyn Fn(&StrokePoint) -> InkPoint,
    ) -> Vec<InkPoint> {
        // Know where the texture of each piece begins and ends; where it is squeezed together, there is none.
        let Some(first) = points.first() else {
            return Vec::new();
        };
        let back = Some(first).filter(|_| is_closed);
        let ends: Vec<&StrokePoint> = points.iter().chain(back).collect();
        let start = if first.u.abs() < 1e9 { 0.0 } else { first.u };
        let pieces = ends.windows(2).enumerate().filter_map(|(index, pair)| {
            let (a, b) = (pair[0], pair[1]);
            let piece = distance(a.position, b.position);
            let is_back = index + 1 == points.len();
            let [from, to] = [a.u, if is_back { a.u + piece } else { b.u }].map(|u| u - start);
            let is_even = (to - from).abs() <= SQUEEZED_MOST * piece && piece.is_finite();
            is_even.then_some((a, b, piece, [from, to]))
        });
        let length: f64 = pieces
            .clone()
            .map(|(.., [from, to])| (to - from).abs())
            .sum();
        let spacing = self.spacing_over(length);

        // Set one at every multiple, whichever way it runs.
        let mut stamps = Vec::new();
        for (a, b, piece, [from, to]) in pieces {
            let forward = [0, 1].map(|i| (b.position[i] - a.position[i]) / piece);
            let (mut number, step) = match to >= from {
                true => ((from / spacing).ceil(), 1.0),
                false => ((from / spacing).floor(), -1.0),
            };
            while (to - number * spacing) * step > 0.0 {
                let share = ((number * spacing - from) / (to - from)).clamp(0.0, 1.0);
                let point = inked(&point_between(a, b, share));
                stamps.extend(self.stamp(point, forward, Seed::new(id, number as i64 as u32)));
                number += step;
            }
        }
        stamps
    }

    /// Distance between stamps of a part of a stroke so many pixels long.
    pub(crate) fn spacing_over(&self, length: f64) -> f64 {
        let least = LEAST_SPACING_PX.max(length / STAMPS_MAX);
        if self.spacing_px > least {
            self.spacing_px
        } else {
            least
        }
    }

    /// A stamp at a point of a stroke that runs `forward`.
    fn stamp(&self, point: InkPoint, forward: [f64; 2], seed: Seed) -> [InkPoint; 2] {
        // Turn it.
        let ahead = if self.rakes { forward } else { [1.0, 0.0] };
        let angle = self.angle + seed.between(0, -self.turn, self.turn);
        let (sin, cos) = (sin_f64(angle), cos_f64(angle));
        let along = [
            ahead[0] * cos - ahead[1] * sin,
            ahead[1] * cos + ahead[0] * sin,
        ];

        // Move it off the stroke, and size it.
        let width = 2.0 * f64::from(point.half_width);
        let off = width * self.scatter * seed.between(1, -1.0, 1.0);
        let beside = [-forward[1] * off, forward[0] * off];
        let half = 0.5 * width * self.size * (1.0 + self.jitter * seed.between(2, -1.0, 1.0));
        let end = |way: f64| {
            [0, 1].map(|i| {
                (f64::from(point.px[i]) + beside[i] + along[i] * half * self.length * way) as f32
            })
        };
        let (from, share) = self.part;
        let from = from.unwrap_or_else(|| seed.share(3));
        let is_round = if self.is_round { InkPoint::ROUND } else { 0 };
        let stamp = InkPoint {
            half_width: half as f32,
            flags: point.flags | InkPoint::STAMP | is_round,
            ..point
        };
        [
            InkPoint {
                px: end(-1.0),
                flags: stamp.flags | InkPoint::GOES_ON,
                u: from as f32,
                ..stamp
            },
            InkPoint {
                px: end(1.0),
                u: (from + share) as f32,
                ..stamp
            },
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const PLAIN: Stamps = Stamps {
        spacing_px: 5.0,
        size: 1.0,
        length: 1.0,
        jitter: 0.0,
        angle: 0.0,
        turn: 0.0,
        rakes: true,
        scatter: 0.0,
        part: (Some(0.0), 1.0),
        is_round: false,
    };

    fn line(places: &[[f64; 2]], first_u: f64) -> Vec<StrokePoint> {
        let mut u = first_u;
        let mut last = None;
        let place = |position: &[f64; 2]| {
            u += last
                .replace(*position)
                .map_or(0.0, |last| distance(last, *position));
            StrokePoint {
                position: *position,
                u,
                width: 4.0,
                ..StrokePoint::default()
            }
        };
        places.iter().map(place).collect()
    }

    fn set(stamps: &Stamps, points: &[StrokePoint], is_closed: bool) -> Vec<[InkPoint; 2]> {
        let inked = |point: &StrokePoint| InkPoint {
            px: point.position.map(|at| at as f32),
            half_width: 0.5 * point.width as f32,
            ..InkPoint::default()
        };
        let all = stamps.along(points, is_closed, 7, &inked);
        all.chunks_exact(2).map(|two| [two[0], two[1]]).collect()
    }

    fn middle([a, b]: &[InkPoint; 2]) -> [f64; 2] {
        [0, 1].map(|i| 0.5 * (f64::from(a.px[i]) + f64::from(b.px[i])))
    }

    proptest! {
        /// No end of a stamp, with its half width around it, lies farther from its place.
        #[test]
        fn stamps_stay_within_their_reach(
            size in 0.1f64..5.0, length in 0.1f64..3.0, jitter in 0f64..1.0, turn in 0f64..3.0, scatter in 0f64..4.0,
            number: u32,
        ) {
            let stamps = Stamps { size, length, jitter, turn, scatter, ..PLAIN };
            let point = InkPoint { half_width: 2.0, ..InkPoint::default() };
            for end in stamps.stamp(point, [0.6, 0.8], Seed::new(7, number)) {
                let off = f64::from(end.px[0]).hypot(f64::from(end.px[1]));
                prop_assert!(off + f64::from(end.half_width) < 4.0 * stamps.reach() + 1e-3);
            }
        }
    }

    #[test]
    fn stamps_lie_at_equal_steps_around_corners() {
        let points = line(&[[0.0, 0.0], [12.0, 0.0], [12.0, 20.0]], 0.0);
        let middles: Vec<[f64; 2]> = set(&PLAIN, &points, false).iter().map(middle).collect();
        let wanted = [
            [0.0, 0.0],
            [5.0, 0.0],
            [10.0, 0.0],
            [12.0, 3.0],
            [12.0, 8.0],
            [12.0, 13.0],
            [12.0, 18.0],
        ];
        assert_eq!(middles.len(), wanted.len());
        for (middle, want) in middles.iter().zip(wanted) {
            assert!(distance(*middle, want) < 1e-5, "{middle:?} {want:?}");
        }
    }

    #[test]
    fn stamps_of_a_line_hold_still_where_its_start_moves() {
        let whole = set(&PLAIN, &line(&[[0.0, 0.0], [60.0, 0.0]], 0.0), false);
        let rest = set(&PLAIN, &line(&[[17.0, 0.0], [60.0, 0.0]], 17.0), false);
        assert_eq!(whole[4..], rest[..]);
    }

    #[test]
    fn they_rake_and_scatter_and_differ_only_where_asked() {
        let points = line(&[[0.0, 0.0], [0.0, 90.0]], 0.0);
        for [a, b] in set(&PLAIN, &points, false) {
            assert!((b.px[1] - a.px[1] - 4.0).abs() < 1e-5 && (b.px[0] - a.px[0]).abs() < 1e-5);
            assert_eq!((a.flags, b.flags, a.u, b.u), (9, 8, 0.0, 1.0));
        }
        let upright = Stamps {
            rakes: false,
            ..PLAIN
        };
        for [a, b] in set(&upright, &points, false) {
            assert!(
                (b.px[0] - a.px[0] - 4.0).abs() < 1e-5,
                "it stays as the picture is"
            );
        }
        let loose = Stamps {
            scatter: 2.0,
            jitter: 0.5,
            turn: 0.6,
            ..PLAIN
        };
        let stamps = set(&loose, &points, false);
        let offs: Vec<f64> = stamps.iter().map(|stamp| middle(stamp)[0]).collect();
        assert!(
            offs.iter().all(|off| off.abs() <= 8.0 + 1e-4)
                && offs.iter().any(|off| off.abs() > 3.0)
        );
        let sizes: Vec<f32> = stamps.iter().map(|[a, _]| a.half_width).collect();
        assert!(sizes.iter().all(|half| (1.0..=3.0).contains(half)) && sizes[0] != sizes[1]);
        assert_eq!(
            stamps,
            set(&loose, &points, false),
            "chance is the same every time"
        );
    }

    #[test]
    fn a_ring_is_stamped_all_around() {
        let square = line(&[[0.0, 0.0], [30.0, 0.0], [30.0, 30.0], [0.0, 30.0]], 0.0);
        assert_eq!(set(&PLAIN, &square, true).len(), 24);
        assert_eq!(set(&PLAIN, &square, false).len(), 18);
    }

    proptest! {
        /// Whatever lines and numbers hold, there is an end to the stamps.
        #[test]
        fn any_line_ends(
            places in prop::collection::vec([-1e5f64..1e5, -1e5f64..1e5], 0..5), spacing: f64, u: f64, closed: bool,
        ) {
            let points = line(&places, u);
            let stamps = set(&Stamps { spacing_px: spacing, ..PLAIN }, &points, closed);
            prop_assert!(stamps.len() <= 100_010);
        }
    }
}
