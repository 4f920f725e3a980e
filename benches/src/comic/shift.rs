//! How far ink lies from where the surface carried it.

/// Side of the squares that are aligned, in pixels.
const SQUARE: usize = 24;

/// Farthest shift looked for, in pixels: less than half the distance of strokes, beyond which neighbours change places.
const REACH: i32 = 3;

/// What the square of a shift costs beside the mean squared difference: along a stroke nothing else tells shifts apart.
const SHIFT_PRICE: f64 = 1e-3;

/// How far the ink of a picture lies from the ink `carried` to it, in pixels, for every square in which each pixel has
/// carried ink, and strokes enough to tell.
///
/// `size` is width and height; both lists hold shares of ink, row by row. O(pixels), times 49 shifts.
pub fn shifts(size: [usize; 2], ink: &[f64], carried: &[Option<f64>]) -> Vec<f64> {
    let margin = REACH as usize + 2;
    let starts = |side: usize| (margin..side.saturating_sub(SQUARE + margin)).step_by(SQUARE);
    let corners = starts(size[1]).flat_map(|y| starts(size[0]).map(move |x| [x, y]));
    corners
        .filter_map(|corner| shift_of(corner, size[0], ink, carried))
        .collect()
}

/// Length of the shift that brings the carried ink of a square closest to the picture's.
fn shift_of(
    [left, top]: [usize; 2],
    width: usize,
    ink: &[f64],
    carried: &[Option<f64>],
) -> Option<f64> {
    // Take the squares that show surface alone, and strokes.
    let places = (top..top + SQUARE).flat_map(|y| (left..left + SQUARE).map(move |x| [x, y]));
    let square: Vec<([usize; 2], f64)> = places
        .map(|[x, y]| Some(([x, y], carried[y * width + x]?)))
        .collect::<Option<_>>()?;
    let share = square.iter().map(|(_, ink)| ink).sum::<f64>() / square.len() as f64;
    if !(0.1..0.9).contains(&share) {
        return None;
    }

    // Try whole pixels only: ink looked up between pixels is softer, and soft ink matches carried ink better anywhere.
    let cost = |[dx, dy]: [i32; 2]| {
        let differences = square.iter().map(|([x, y], carried)| {
            let (column, row) = (*x as i32 + dx, *y as i32 + dy);
            let there = ink[row as usize * width + column as usize];
            (there - carried) * (there - carried)
        });
        let price = SHIFT_PRICE * f64::from(dx * dx + dy * dy);
        differences.sum::<f64>() / square.len() as f64 + price
    };
    if cost([0, 0]) == 0.0 {
        return Some(0.0);
    }
    let offsets = (-REACH..=REACH).flat_map(|y| (-REACH..=REACH).map(move |x| [x, y]));
    let [x, y] = offsets.min_by(|a, b| cost(*a).total_cmp(&cost(*b)))?;

    // Go on between them by a parabola along each axis.
    let [dx, dy] = [[1, 0], [0, 1]].map(|[i, j]| {
        let [low, middle, high] = [-1, 0, 1].map(|k| cost([x + i * k, y + j * k]));
        vertex_of(low, middle, high)
    });
    Some((f64::from(x) + dx).hypot(f64::from(y) + dy))
}

/// Where a parabola through values at -1, 0 and 1, the least at 0, is lowest, -1/2..1/2.
fn vertex_of(low: f64, middle: f64, high: f64) -> f64 {
    let bend = low - 2.0 * middle + high;
    if bend > 0.0 {
        ((low - high) / (2.0 * bend)).clamp(-0.5, 0.5)
    } else {
        0.0
    }
}
