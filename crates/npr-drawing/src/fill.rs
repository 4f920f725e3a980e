//! Flat colour between the lines: the areas that visible lines enclose become closed regions.
//!
//! Lines are snapped to a fine grid and made into a planar graph, which is triangulated; triangles with no line
//! between them form an area, and most of an area's surface decides its colour. Neighbouring regions share their
//! points exactly, so no background shows between them.

mod error;
mod map;
pub mod mesh;
mod snap;
#[cfg(test)]
mod tests;

pub use error::{FillError, LONGEST_SIDE};

use map::Map;
use npr_vector::stroke::Region;
use rayon::prelude::*;
use snap::{Point, snapped};
use std::collections::BTreeMap;

/// Grid points per pixel: lines move by at most a few times 1/256 of a pixel.
const FINENESS: f64 = 256.0;

/// Areas of the picture between lines, each with the surface that most of it shows.
///
/// `segments` are pieces of visible lines in pixels, in any order and of any direction; parts outside the picture and
/// numbers that are not finite are left out. `surface_at` tells which surface a place in the picture shows, `None`
/// being background, which becomes no region. Places are not on lines and at least one lies in every
/// triangle between them.
///
/// A line that ends in nothing encloses nothing. Where two areas meet through a gap in a line, their colours meet
/// there too, near the line that is missing. Areas side by side with the same surface become one region; a line that
/// runs inside it leaves no trace.
///
/// Rings run clockwise as seen in the picture around what they enclose, holes the other way, and may touch themselves
/// in single points. Regions come in the order of their topmost points. The same for any number of threads.
///
/// About 20 us for each segment when lines are short. Pictures beyond [`LONGEST_SIDE`], and millions of
/// crossings, are refused.
pub fn regions(
    size: [u32; 2],
    segments: &[[[f64; 2]; 2]],
    surface_at: &(dyn Fn([f64; 2]) -> Option<u32> + Sync),
) -> Result<Vec<Region>, FillError> {
    let side = size[0].max(size[1]);
    if side > LONGEST_SIDE {
        return Err(FillError::TooLarge { side });
    }
    if size.contains(&0) {
        return Ok(Vec::new());
    }
    let inside = segments.iter().filter_map(|ends| clipped(size, *ends));
    let all = inside.map(|ends| ends.map(on_grid)).chain(border(size));
    let map = Map::new(&snapped(all.collect())?)?;
    let labels = labels(&map, surface_at);
    Ok(outlines(&map, &labels))
}

fn on_grid(place: [f64; 2]) -> Point {
    place.map(|v| (v * FINENESS).round() as i64)
}

/// The four sides of the picture.
fn border([width, height]: [u32; 2]) -> [[Point; 2]; 4] {
    let [right, bottom] = [width, height].map(|v| i64::from(v) * FINENESS as i64);
    let corners = [[0, 0], [right, 0], [right, bottom], [0, bottom]];
    std::array::from_fn(|i| [corners[i], corners[(i + 1) % 4]])
}

/// The part of a segment inside the picture [Liang & Barsky 1984].
fn clipped(size: [u32; 2], [a, b]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    if ![a, b].as_flattened().iter().all(|v| v.is_finite()) {
        return None;
    }
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (along, high) = (b[axis] - a[axis], f64::from(size[axis]));
        // Without a length along this axis the segment is inside all the way, or not at all.
        if along == 0.0 {
            if !(0.0..=high).contains(&a[axis]) {
                return None;
            }
            continue;
        }
        let [enter, leave] = [0.0, high].map(|bound| (bound - a[axis]) / along);
        from = from.max(enter.min(leave));
        to = to.min(enter.max(leave));
    }
    let at = |t: f64| -> [f64; 2] {
        std::array::from_fn(|i| (a[i] + (b[i] - a[i]) * t).clamp(0.0, f64::from(size[i])))
    };
    let ends = [
        if from == 0.0 { a } else { at(from) },
        if to == 1.0 { b } else { at(to) },
    ];
    (from <= to && ends.as_flattened().iter().all(|v| v.is_finite())).then_some(ends)
}

/// Share of an area that must show one surface for all of it to count as that surface; with less, lines have let two
/// areas run together.
const WHOLE_SHARE: f64 = 0.97;

/// The surface of every triangle: that of its area, or its own where an area shows several.
///
/// Specks in an area are noise along its lines. But where an outline has a gap, two areas are one, and the majority
/// would paint the smaller away: there colours meet between triangles, close to where the line should be.
fn labels(map: &Map, surface_at: &(dyn Fn([f64; 2]) -> Option<u32> + Sync)) -> Vec<Option<u32>> {
    // Ask every triangle which surface it shows.
    let seen: Vec<Option<u32>> = map
        .triangles
        .par_iter()
        .map(|corners| {
            let points = corners.map(|p| map.points[p as usize]);
            let sum = |i: usize| points.iter().map(|p| p[i]).sum::<i64>();
            surface_at([0, 1].map(|i| sum(i) as f64 / (3.0 * FINENESS)))
        })
        .collect();

    // Let each area vote by size.
    let areas = map.areas();
    let mut votes: BTreeMap<(u32, Option<u32>), i64> = BTreeMap::new();
    for (triangle, (area, label)) in areas.iter().zip(&seen).enumerate() {
        *votes.entry((*area, *label)).or_default() += map.area(triangle);
    }
    let mut winners: Vec<(i64, Option<u32>)> = vec![(0, None); areas.len()];
    let mut sizes = vec![0_i64; areas.len()];
    for ((area, label), size) in votes {
        let winner = &mut winners[area as usize];
        sizes[area as usize] += size;
        if size > winner.0 {
            *winner = (size, label);
        }
    }

    // Give whole areas to the winner; where lines have gaps, each triangle shows its own.
    let label_of = |(triangle, area): (usize, &u32)| {
        let (size, label) = winners[*area as usize];
        let is_whole = size as f64 >= WHOLE_SHARE * sizes[*area as usize] as f64;
        if is_whole { label } else { seen[triangle] }
    };
    areas.iter().enumerate().map(label_of).collect()
}

/// Connected triangles with the same surface, as rings.
fn outlines(map: &Map, labels: &[Option<u32>]) -> Vec<Region> {
    // Group connected triangles of one surface; background is no region.
    let groups = map.groups(labels);
    let mut surfaces: BTreeMap<u32, u32> = BTreeMap::new();
    for (group, label) in groups.iter().zip(labels) {
        if let Some(surface) = label {
            surfaces.insert(*group, *surface);
        }
    }

    // Start each ring at its top.
    let mut rings: BTreeMap<u32, Vec<Vec<Point>>> = BTreeMap::new();
    for (group, ring) in map.rings(&groups) {
        if surfaces.contains_key(&group) {
            let points = ring.iter().map(|p| map.points[*p as usize]);
            let ring = from_top(points.collect());
            rings.entry(group).or_default().push(ring);
        }
    }

    // Put outlines before holes, and regions in reading order.
    let mut regions: Vec<(u32, Vec<Vec<Point>>)> = rings.into_iter().collect();
    for (_, rings) in &mut regions {
        rings.sort_unstable_by_key(|ring| (area(ring) <= 0, top(ring)));
    }
    regions.sort_by_key(|(_, rings)| rings.first().map(|ring| top(ring)));

    // Turn grid points back into pixels.
    let on_picture = |ring: Vec<Point>| ring.into_iter().map(|p| p.map(|v| v as f64 / FINENESS));
    let regions = regions.into_iter().map(|(group, rings)| Region {
        surface: surfaces[&group],
        rings: rings
            .into_iter()
            .map(|ring| on_picture(ring).collect())
            .collect(),
    });
    regions.collect()
}

/// Order of points from the top of the picture down.
fn reading_order(point: &Point) -> Point {
    [point[1], point[0]]
}

fn top(ring: &[Point]) -> Option<Point> {
    ring.iter().map(reading_order).min()
}

/// The ring started at its topmost point.
fn from_top(mut ring: Vec<Point>) -> Vec<Point> {
    let first = (0..ring.len()).min_by_key(|i| reading_order(&ring[*i]));
    ring.rotate_left(first.unwrap_or(0));
    ring
}

/// Twice the signed area, positive where the ring runs clockwise as seen in the picture.
fn area(ring: &[Point]) -> i64 {
    let last = ring.last().copied().unwrap_or_default();
    let before = std::iter::once(&last).chain(ring);
    let doubled = before.zip(ring).map(|(a, b)| a[0] * b[1] - a[1] * b[0]);
    doubled.sum()
}
