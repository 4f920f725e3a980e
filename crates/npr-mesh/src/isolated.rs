//! Puts aside points without neighbours, which are most of a mesh.

use glam::DVec3;
use rayon::prelude::*;

use crate::buckets::Buckets;

/// Points of one cell up to which every pair is compared; the members of fuller cells count as close.
const COMPARED: usize = 16;

/// Ascending numbers of all points within `reach` of another, and perhaps of some that are not.
///
/// Points lie in a box with its lowest corner at 0 and the given diagonal. The cells of a grid hold a few
/// points of a surface each; a point within reach of a neighbouring cell is entered there too, so that
/// two close points share a cell. O(n).
pub(crate) fn not_alone(points: &[DVec3], diagonal: f64, reach: f64) -> Vec<u32> {
    let side = (diagonal / (points.len() as f64).sqrt()).max(4.0 * reach);
    // Rounding must not keep close points apart.
    let margin = 1.001 * reach / side + 1e-6;
    let entries = entries(points, side, margin);
    let bits = entries.len().next_power_of_two().trailing_zeros().max(1);
    let bucket_of: Vec<u32> = entries
        .par_iter()
        .map(|e| (e.0 >> (64 - bits)) as u32)
        .collect();
    let buckets = Buckets::new(1 << bits, &bucket_of, |entry| entries[entry as usize].1);
    let found = buckets.gather(|run| {
        let mut found = Vec::new();
        run.for_each(|_, members| close_among(points, members, reach, &mut found));
        found
    });
    let mut found = found.concat();
    found.par_sort_unstable();
    found.dedup();
    found
}

/// Appends the members of a cell that have another within reach.
fn close_among(points: &[DVec3], members: &[u32], reach: f64, found: &mut Vec<u32>) {
    if members.len() > COMPARED {
        return found.extend(members);
    }
    for (i, &a) in members.iter().enumerate() {
        for &b in members[..i].iter().filter(|&&b| b != a) {
            let apart = points[a as usize].distance_squared(points[b as usize]);
            if apart <= reach * reach {
                found.extend([a, b]);
            }
        }
    }
}

/// Hash of a cell and the number of a point, for each cell that each point touches.
fn entries(points: &[DVec3], side: f64, margin: f64) -> Vec<(u64, u32)> {
    let cell = |place: DVec3| hash(place.floor().to_array().map(|v| v as i64));
    let mut entries: Vec<(u64, u32)> = (0..points.len() as u32)
        .into_par_iter()
        .map(|number| (cell(points[number as usize] / side), number))
        .collect();
    let ghosts: Vec<(u64, u32)> = (0..points.len() as u32)
        .into_par_iter()
        .flat_map_iter(|number| {
            let place = points[number as usize] / side;
            neighbours(place, margin).map(move |cell| (cell, number))
        })
        .collect();
    entries.extend(ghosts);
    entries
}

/// Hashes of the cells beside a point's own that it nearly touches, at most seven.
fn neighbours(place: DVec3, margin: f64) -> impl Iterator<Item = u64> {
    let cell = place.floor();
    let inside = (place - cell).to_array();
    let aside = inside.map(|v| i64::from(v > 1.0 - margin) - i64::from(v < margin));
    let cell = cell.to_array().map(|v| v as i64);
    let subsets = if aside == [0; 3] { 1..1 } else { 1..8 };
    subsets.filter_map(move |subset: usize| {
        let moves = |axis: usize| subset >> axis & 1 == 1;
        let touched = (0..3).all(|axis| !moves(axis) || aside[axis] != 0);
        let place = |axis: usize| cell[axis] + if moves(axis) { aside[axis] } else { 0 };
        touched.then(|| hash([0, 1, 2].map(place)))
    })
}

/// Spreads cells evenly, the highest bits best.
fn hash([x, y, z]: [i64; 3]) -> u64 {
    let round = |mixed: u64, v: i64| {
        let mixed = (mixed ^ v as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^ mixed >> 32
    };
    let mixed = round(round(round(0, x), y), z);
    mixed.wrapping_mul(0xbf58_476d_1ce4_e5b9)
}
