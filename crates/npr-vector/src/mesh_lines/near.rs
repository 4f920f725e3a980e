//! Square cells over the plane, for finding near places.

use foldhash::fast::FixedState;
use npr_core::geometry::NONE;
use std::collections::HashMap;

/// Things by the square cell that they lie in.
#[derive(Debug)]
pub(crate) struct Cells<T> {
    side: f64,
    /// The first and the last thing of every cell that holds any.
    ends: HashMap<[i64; 2], [u32; 2], FixedState>,
    /// All things, each with the next one of its cell.
    things: Vec<(T, u32)>,
}

impl<T> Cells<T> {
    /// Empty cells of a width.
    pub fn new(side: f64) -> Self {
        Self {
            side,
            ends: HashMap::default(),
            things: Vec::new(),
        }
    }

    /// The same, with room for a number of things.
    pub fn with_room(side: f64, count: usize) -> Self {
        Self {
            ends: HashMap::with_capacity_and_hasher(count, FixedState::default()),
            things: Vec::with_capacity(count),
            ..Self::new(side)
        }
    }

    /// Adds a thing at a place, behind those of its cell.
    pub fn add(&mut self, place: [f64; 2], thing: T) {
        let index = self.things.len() as u32;
        self.things.push((thing, NONE));
        let ends = self
            .ends
            .entry(cell_of(place, self.side))
            .or_insert([index; 2]);
        if ends[1] != index {
            self.things[ends[1] as usize].1 = index;
            ends[1] = index;
        }
    }

    /// The things of some cells, cell by cell, those of one in the order in which they came.
    pub fn of(&self, cells: impl Iterator<Item = [i64; 2]>) -> impl Iterator<Item = &T> {
        let firsts = cells.filter_map(|cell| self.ends.get(&cell).map(|ends| ends[0]));
        firsts.flat_map(|first| {
            let at = |index: u32| self.things.get(index as usize);
            std::iter::successors(at(first), move |(_, next)| at(*next)).map(|(thing, _)| thing)
        })
    }
}

/// The square cell that a place lies in, of cells `side` wide over the whole plane.
pub(crate) fn cell_of(place: [f64; 2], side: f64) -> [i64; 2] {
    place.map(|v| (v / side).floor() as i64)
}

/// A cell and the eight around it, column by column: they hold all places within a cell's side.
pub(crate) fn cells_around([x, y]: [i64; 2]) -> impl Iterator<Item = [i64; 2]> {
    let steps = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [dx, dy]));
    steps.map(move |[dx, dy]| [x.saturating_add(dx), y.saturating_add(dy)])
}

/// The cells, column by column, that hold all places within `reach` of a place.
pub(crate) fn cells_within(
    place: [f64; 2],
    reach: f64,
    side: f64,
) -> impl Iterator<Item = [i64; 2]> {
    let [low, high] = [-reach, reach].map(|by| cell_of(place.map(|v| v + by), side));
    (low[0]..=high[0]).flat_map(move |x| (low[1]..=high[1]).map(move |y| [x, y]))
}
