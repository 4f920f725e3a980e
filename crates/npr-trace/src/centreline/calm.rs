//! Places along a line made smooth, as far as its pixels allow.

use glam::DVec2;

/// Numbers of places on either side that are tried, the first in any case.
const REACHES: [usize; 11] = [2, 3, 4, 6, 8, 11, 16, 22, 32, 45, 64];

/// How much more than others the end of a line counts that ends on another stroke.
const PIN: f64 = 25.0;

/// How a line is made smooth.
#[derive(Debug, Clone, Copy)]
pub struct Calm {
    /// How far places may move to the side, in pixels.
    pub tolerance: f64,
    /// Most places on either side that a place is the mean of.
    pub most: usize,
    /// The last place runs on to the first.
    pub closed: bool,
    /// The ends stay.
    pub pinned: [bool; 2],
}

/// A smooth place and the direction there, for every place of a line.
///
/// Each is that of the parabola through the places around it, by weighted least squares; around it means: as far as
/// all lie beside the parabola by no more than the tolerance. So a straight or gently bent line, whose pixels are
/// stairs of one pixel many pixels long, becomes straight or gently bent, and a tight turn stays.
///
/// Local regression with windows by fit, as [Cleveland 1979] with windows chosen as in [Goldenshluger and Nemirovski
/// 1997]. O(places) times `most`.
pub fn calm(places: &[DVec2], how: &Calm) -> Vec<[DVec2; 2]> {
    let line = Line::of(places, how);
    let mut reaches: Vec<usize> = (0..places.len()).map(|i| line.reach(i)).collect();
    // Windows grow by one from place to place, so that no place jumps.
    let count = reaches.len();
    let rounds = if how.closed { 2 } else { 1 };
    for i in 1..rounds * count {
        reaches[i % count] = reaches[i % count].min(reaches[(i - 1) % count] + 1);
    }
    for i in (1..rounds * count).rev() {
        reaches[(i - 1) % count] = reaches[(i - 1) % count].min(reaches[i % count] + 1);
    }
    (0..count)
        .map(|i| {
            let parabola = line.parabola(i, reaches[i], 1.0);
            let [place, slope, _] = parabola.terms;
            [place, slope.try_normalize().unwrap_or(DVec2::X)]
        })
        .collect()
}

/// Places with those around a seam once more on both sides.
struct Line {
    places: Vec<DVec2>,
    /// Length up to each place.
    lengths: Vec<f64>,
    weights: Vec<f64>,
    /// Places before the first one.
    pad: usize,
    how: Calm,
}

/// Coefficients of a curve over length, in units of the window, from its middle on.
struct Parabola {
    terms: [DVec2; 3],
    unit: f64,
}

impl Line {
    fn of(places: &[DVec2], how: &Calm) -> Self {
        // Repeat a closed line's places before its start and after its end.
        let count = places.len();
        let pad = if how.closed {
            how.most.min(count.saturating_sub(1) / 2)
        } else {
            0
        };
        let around = (0..count + 2 * pad).map(|k| places[(k + count - pad) % count]);
        let places: Vec<DVec2> = around.collect();

        // Measure along the line.
        let mut lengths = vec![0.0];
        for pair in places.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
        }

        // Hold the ends that are pinned.
        let mut weights = vec![1.0; places.len()];
        let last = places.len().saturating_sub(1);
        for (at, is_pinned) in [0, last].into_iter().zip(how.pinned) {
            if is_pinned && !how.closed {
                weights[at] = PIN;
            }
        }
        Self {
            places,
            lengths,
            weights,
            pad,
            how: *how,
        }
    }

    /// The first and last place around one.
    fn window(&self, at: usize, reach: usize) -> [usize; 2] {
        let reach = if self.how.closed {
            reach.min(self.pad)
        } else {
            reach
        };
        let middle = at + self.pad;
        [
            middle.saturating_sub(reach),
            (middle + reach).min(self.places.len() - 1),
        ]
    }

    /// How many places around one lie beside one parabola.
    fn reach(&self, at: usize) -> usize {
        let (mut best, mut misses) = (REACHES[0], 0);
        for reach in REACHES
            .into_iter()
            .take_while(|reach| *reach <= self.how.most)
        {
            if self.fits(at, reach) {
                (best, misses) = (reach, 0);
            } else {
                misses += 1;
            }
            // A single step of a stair may stick out of a short window and not of a longer one.
            if misses == 2 {
                break;
            }
        }
        best
    }

    fn fits(&self, at: usize, reach: usize) -> bool {
        // All places count alike, or the parabola would be free to leave the outermost.
        let parabola = self.parabola(at, reach, 0.0);
        let [first, last] = self.window(at, reach);
        (first..=last).all(|k| {
            let length = self.lengths[k] - self.lengths[at + self.pad];
            parabola.distance(self.places[k], length) <= self.how.tolerance
        })
    }

    /// The parabola of the places around one, which count less the further away they are: at the window's end by the
    /// share `fade`.
    fn parabola(&self, at: usize, reach: usize, fade: f64) -> Parabola {
        let [first, last] = self.window(at, reach);
        let middle = self.lengths[at + self.pad];
        let far = (self.lengths[last] - middle).max(middle - self.lengths[first]);
        let unit = (far + 0.5).max(0.5);
        let samples = (first..=last).map(|k| {
            let t = (self.lengths[k] - middle) / unit;
            (t, self.places[k], self.weights[k] * (1.0 - fade * t * t))
        });
        let terms = parabola(self.places[at + self.pad], samples);
        Parabola { terms, unit }
    }
}

impl Parabola {
    /// How far a place lies beside the curve at a length from its middle.
    fn distance(&self, place: DVec2, length: f64) -> f64 {
        beside(&self.terms, length / self.unit, place)
    }
}

/// Coefficients of the parabola nearest to places, each with its parameter and weight; sums are taken from a place on.
pub fn parabola(from: DVec2, samples: impl Iterator<Item = (f64, DVec2, f64)>) -> [DVec2; 3] {
    let mut moments = [0.0; 5];
    let mut sums = [DVec2::ZERO; 3];
    for (t, place, weight) in samples {
        let mut power = weight;
        for (i, moment) in moments.iter_mut().enumerate() {
            *moment += power;
            if let Some(sum) = sums.get_mut(i) {
                *sum += (place - from) * power;
            }
            power *= t;
        }
    }
    let mut terms = solve(&moments, &sums);
    terms[0] += from;
    terms
}

/// How far a place lies beside a parabola at a parameter.
pub fn beside([a, b, c]: &[DVec2; 3], t: f64, place: DVec2) -> f64 {
    let out = place - (*a + (*b + *c * t) * t);
    let along = *b + *c * (2.0 * t);
    match along.try_normalize() {
        Some(along) => out.perp_dot(along).abs(),
        None => out.length(),
    }
}

/// The least squares' solution; of a line where places do not determine a parabola, and of a point where they do not
/// a line.
fn solve(m: &[f64; 5], sums: &[DVec2; 3]) -> [DVec2; 3] {
    // Fit a parabola where the places allow.
    let [m0, m1, m2, m3, m4] = *m;
    let [s0, s1, s2] = *sums;
    let minors = [m2 * m4 - m3 * m3, m1 * m4 - m2 * m3, m1 * m3 - m2 * m2];
    let det = m0 * minors[0] - m1 * minors[1] + m2 * minors[2];
    if det > 1e-6 * m0 * m0 * m0 {
        let [a, b, c] = minors.map(|minor| minor / det);
        let d = (m0 * m4 - m2 * m2) / det;
        let e = (m0 * m3 - m1 * m2) / det;
        let f = (m0 * m2 - m1 * m1) / det;
        return [
            s0 * a - s1 * b + s2 * c,
            s1 * d - s0 * b - s2 * e,
            s0 * c - s1 * e + s2 * f,
        ];
    }

    // Else fit a straight line.
    let det = m0 * m2 - m1 * m1;
    if det > 1e-6 * m0 * m0 {
        return [
            (s0 * m2 - s1 * m1) / det,
            (s1 * m0 - s0 * m1) / det,
            DVec2::ZERO,
        ];
    }

    // Else take the mean.
    [s0 / m0.max(f64::MIN_POSITIVE), DVec2::ZERO, DVec2::ZERO]
}
