//! Square cells over the plane, for finding near places.

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
