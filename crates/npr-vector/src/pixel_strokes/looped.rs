//! Sides in the order of their loops, freed of specks, smoothed, each with a tangent: the twins of
//! `vector.gather_sides`, `vector.drop_specks`, `vector.smooth_loops` and `vector.fit_tangents`.
//!
//! Loops lie one after the other in one list. Every side knows where its loop starts and how long it is, so windows
//! along a loop wrap around it by themselves, as often as it takes where a loop is shorter than the window.

use super::planar::{LEAST_SQUARE, Planar};
use super::side::Side;
use crate::rank::place::Standing;
use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;
use npr_core::published_path::PublishedPath;
use rayon::prelude::*;

/// The loop of a side in the list of all loops.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Spot {
    /// Where its loop starts.
    pub start: u32,
    /// Sides of the loop, at least 1.
    pub length: u32,
}
gpu_layout!(Spot { start, length });

impl Spot {
    /// The side after another, around the loop.
    pub fn after(&self, element: u32) -> u32 {
        let next = element + 1;
        if next >= self.start + self.length {
            self.start
        } else {
            next
        }
    }

    /// The side before another, around the loop.
    pub fn before(&self, element: u32) -> u32 {
        if element <= self.start {
            self.start + self.length - 1
        } else {
            element - 1
        }
    }

    /// The side `radius` places before another, around the loop as often as needed.
    pub fn back(&self, element: u32, radius: u32) -> u32 {
        let from_start = element - self.start + self.length - radius % self.length;
        self.start + from_start % self.length
    }
}

/// The input of [`gather_sides`].
#[derive(Debug, Clone, Copy)]
pub struct Ordered<'a> {
    /// Width of the picture.
    pub width: u32,
    /// All sides, loop after loop.
    pub order: &'a [u32],
    /// Where every side is in its loop.
    pub standings: &'a [Standing],
    /// All sides, in the order of pixels.
    pub sides: &'a [Side],
}

/// The output of [`gather_sides`].
#[derive(Debug)]
pub struct Gathered<'a> {
    /// The loop of each side.
    pub spots: &'a mut [Spot],
    /// Its middle, in pixels.
    pub places: &'a mut [Planar],
    /// Unit vector along the contour that inked its pixel, in the direction of its edge.
    pub directions: &'a mut [Planar],
    /// Its share of the area of its loop: a number of 32 bits that wraps.
    pub areas: &'a mut [u32],
}

/// Puts the place, direction and area of every side in the order of loops.
pub fn gather_sides(on: &Ordered<'_>, into: Gathered<'_>) {
    let outputs = into.spots.par_iter_mut().zip(into.places);
    let outputs = outputs.zip(into.directions).zip(into.areas);
    let elements = on.order.par_iter().with_min_len(512).zip(outputs);
    elements
        .enumerate()
        .for_each(|(element, (number, (((spot, place), direction), area)))| {
            let standing = on.standings[*number as usize];
            spot.start = element as u32 - standing.rank;
            spot.length = standing.length;
            let side = on.sides[*number as usize];
            let (pixel, way) = (side.code / 4, side.code % 4);
            let (x, y) = (pixel % on.width, pixel / on.width);
            place.x = x as f32 + MIDDLE[way as usize][0];
            place.y = y as f32 + MIDDLE[way as usize][1];
            // Sums of the heights of lower sides less those of upper ones.
            *area = match way {
                0 => y.wrapping_neg(),
                2 => y + 1,
                _ => 0,
            };
            *direction = side.extent.unit();
        });
}

/// Middle of each side of a pixel, from its top left corner.
const MIDDLE: [[f32; 2]; 4] = [[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]];

/// Which loops are too small to keep.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SpeckRule {
    /// Area in pixels under which a loop is a speck.
    pub area: f32,
    /// Area in pixels under which a thin loop is a speck.
    pub thin_area: f32,
    /// Most area for each of its sides with which a loop is thin.
    pub thinness: f32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: u32,
}
gpu_layout!(SpeckRule {
    area,
    thin_area,
    thinness,
    unused
});

impl SpeckRule {
    /// The rule of a path.
    pub fn of(path: &PublishedPath) -> Self {
        Self {
            area: path.speck_area,
            thin_area: path.thin_speck_area,
            thinness: path.thinness,
            unused: 0,
        }
    }
}

/// Marks the sides of all loops that are no specks with 1, others with 0.
///
/// `sums` is the scan of `areas`, so the area of a loop is a difference of two sums.
///
/// As published, a line one pixel wide has the area of its pixels: contours shorter than the rule's area disappear.
pub fn drop_specks(
    rule: &SpeckRule,
    spots: &[Spot],
    areas: &[u32],
    sums: &[u32],
    kept: &mut [u32],
) {
    let outputs = kept.par_iter_mut().with_min_len(1024).zip(spots);
    outputs.for_each(|(kept, spot)| {
        let last = (spot.start + spot.length - 1) as usize;
        let end = sums[last].wrapping_add(areas[last]);
        let area = end.wrapping_sub(sums[spot.start as usize]) as i32;
        let size = area.unsigned_abs() as f32;
        let is_thin = size <= rule.thinness * spot.length as f32;
        let is_speck = size < rule.area || size < rule.thin_area && is_thin;
        *kept = u32::from(!is_speck);
    });
}

/// How [`smooth_loops`] averages.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Filter {
    /// Number of sides on either side.
    pub radius: u32,
    /// 1 if means are brought to length 1, else 0.
    pub unit: u32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: [u32; 2],
}
gpu_layout!(Filter {
    radius,
    unit,
    unused
});

impl Filter {
    fn new(radius: u32, is_unit: bool) -> Self {
        Self {
            radius,
            unit: u32::from(is_unit),
            ..Self::default()
        }
    }

    /// How a path smooths places, and the weights.
    pub fn of_places(path: &PublishedPath) -> (Self, Vec<f32>) {
        let radius = path.smooth_radius;
        let weights = gaussian(radius, path.smooth_sigma);
        (Self::new(radius, false), weights)
    }

    /// The window that a path fits tangents to, and the weights.
    pub fn of_fit(path: &PublishedPath) -> (Self, Vec<f32>) {
        (Self::new(path.fit_radius, false), tent(path.fit_radius))
    }

    /// How a path smooths tangents, and the weights.
    pub fn of_tangents(path: &PublishedPath) -> (Self, Vec<f32>) {
        let radius = path.tangent_radius;
        let weights = gaussian(radius, path.tangent_sigma);
        (Self::new(radius, true), weights)
    }

    /// How a path averages the directions of contours, and the weights.
    pub fn of_directions(path: &PublishedPath) -> (Self, Vec<f32>) {
        let radius = path.direction_radius;
        let weights = gaussian(radius, path.direction_sigma);
        (Self::new(radius, true), weights)
    }
}

/// Weights of a Gaussian of `sigma` sides from 0 to `radius`, which add up to 1 over both sides.
pub fn gaussian(radius: u32, sigma: f32) -> Vec<f32> {
    let spread = sigma.max(1e-3);
    let raw: Vec<f32> = (0..=radius)
        .map(|step| {
            let at = step as f32 / spread;
            npr_core::math::exp(-0.5 * at * at)
        })
        .collect();
    let sum = raw
        .iter()
        .skip(1)
        .fold(1.0, |sum, weight| sum + 2.0 * weight);
    raw.iter().map(|weight| weight / sum).collect()
}

/// Replaces every vector by the weighted mean of those around it, along its loop.
///
/// `weights` run from the side itself to `radius`. A Gaussian shrinks loops and rounds corners, as published.
/// O(sides * radius).
pub fn smooth_loops(
    filter: &Filter,
    weights: &[f32],
    spots: &[Spot],
    vectors_in: &[Planar],
    vectors_out: &mut [Planar],
) {
    let outputs = vectors_out.par_iter_mut().with_min_len(256).enumerate();
    outputs.for_each(|(element, vector)| {
        let spot = spots[element];

        // Sum up a window around the loop.
        let mut at = spot.back(element as u32, filter.radius);
        let mut mean = Planar::default();
        for step in 0..2 * filter.radius + 1 {
            let weight = weights[step.abs_diff(filter.radius) as usize];
            let there = vectors_in[at as usize];
            mean.x += weight * there.x;
            mean.y += weight * there.y;
            at = spot.after(at);
        }

        // Directions become as long as 1 again.
        *vector = if filter.unit != 0 { mean.unit() } else { mean };
    });
}

/// Weights that fall linearly from 1 at the side itself to 0 one beyond `radius`.
pub fn tent(radius: u32) -> Vec<f32> {
    let reach = radius as f32 + 1.0;
    (0..=radius).map(|step| 1.0 - step as f32 / reach).collect()
}

/// Sums of the normal equations of a parabola.
#[derive(Debug, Clone, Copy, Default)]
struct Normal {
    ss: f32,
    sq: f32,
    qq: f32,
    sx: f32,
    sy: f32,
    qx: f32,
    qy: f32,
}

impl Normal {
    /// Adds a place at arc length `s` from the side itself and at offset `away` from it.
    fn add(&mut self, weight: f32, s: f32, away: Planar) {
        let q = 0.5 * s * s;
        self.ss += weight * s * s;
        self.sq += weight * s * q;
        self.qq += weight * q * q;
        self.sx += weight * s * away.x;
        self.sy += weight * s * away.y;
        self.qx += weight * q * away.x;
        self.qy += weight * q * away.y;
    }

    /// The derivative by arc length at the side itself.
    fn slope(&self) -> Planar {
        let whole = self.ss * self.qq;
        let determinant = whole - self.sq * self.sq;
        // With next to no places a straight line is all that fits.
        let (a, b, d) = if determinant > 1e-4 * whole {
            (self.qq, self.sq, determinant)
        } else {
            (1.0, 0.0, self.ss.max(LEAST_SQUARE))
        };
        Planar {
            x: (a * self.sx - b * self.qx) / d,
            y: (a * self.sy - b * self.qy) / d,
        }
    }
}

/// Unit tangents of loops: at every side a parabola through it, over arc length, is fitted to `radius` sides both
/// ways by weighted least squares. Zero where all places are one.
///
/// `weights` run from the side itself to `radius`, the filter's, and must not grow. O(sides * radius).
///
/// Differs: the publication's prototype adds distances from the side itself instead of those between neighbours, so
/// its parameter grows as a square, and weighs the farthest places most; its tangents are saved by symmetry alone.
pub fn fit_tangents(
    filter: &Filter,
    weights: &[f32],
    spots: &[Spot],
    places: &[Planar],
    tangents: &mut [Planar],
) {
    let outputs = tangents.par_iter_mut().with_min_len(256).enumerate();
    outputs.for_each(|(element, tangent)| {
        let spot = spots[element];
        let here = places[element];
        let mut normal = Normal::default();

        // Walk both ways along the loop.
        for sign in [1.0_f32, -1.0] {
            let mut at = element as u32;
            let mut last = here;
            let mut s = 0.0;
            for step in 1..=filter.radius {
                at = if sign > 0.0 {
                    spot.after(at)
                } else {
                    spot.before(at)
                };

                // Fit a line to places by their distance along it.
                let there = places[at as usize];
                let (dx, dy) = (there.x - last.x, there.y - last.y);
                s += (dx * dx + dy * dy).sqrt();
                last = there;
                let away = Planar {
                    x: there.x - here.x,
                    y: there.y - here.y,
                };
                normal.add(weights[step as usize], sign * s, away);
            }
        }
        *tangent = normal.slope().unit();
    });
}
