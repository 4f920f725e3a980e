//! Tones of pictures, as the eye takes them.

/// Brightness of an sRGB pixel over white, by the shares of its bytes that television uses.
pub fn brightness(pixel: &[u8]) -> f32 {
    let [r, g, b, a] = [pixel[0], pixel[1], pixel[2], pixel[3]].map(|byte| f32::from(byte) / 255.0);
    (0.2126 * r + 0.7152 * g + 0.0722 * b) * a + 1.0 - a
}

/// Tones with those around them, weighed 1, 2, 1 along both axes; beyond the picture its border goes on.
pub fn softened([width, height]: [u32; 2], tones: impl Iterator<Item = f32>) -> Vec<f32> {
    let (width, height) = (width as usize, height as usize);
    let tones: Vec<f32> = tones.collect();
    let mean = |before: f32, here: f32, after: f32| 0.25 * (before + after) + 0.5 * here;
    let along = |row: &[f32], x: usize| {
        mean(
            row[x.saturating_sub(1)],
            row[x],
            row[(x + 1).min(width - 1)],
        )
    };

    // Average along rows.
    let rows = tones.chunks(width.max(1));
    let rows: Vec<f32> = rows
        .flat_map(|row| (0..row.len()).map(move |x| along(row, x)))
        .collect();

    // Average along columns.
    let at = |x: usize, y: usize| rows[y * width + x];
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    places
        .map(|(x, y)| {
            mean(
                at(x, y.saturating_sub(1)),
                at(x, y),
                at(x, (y + 1).min(height - 1)),
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_softened_spot_keeps_its_ink_and_a_plane_stays() {
        let spot = softened([5, 4], (0..20).map(|i| f32::from(u8::from(i == 7))));
        assert_eq!((spot[7], spot[6], spot[1]), (0.25, 0.125, 0.0625));
        assert_eq!(softened([3, 2], [0.5; 6].into_iter()), [0.5; 6]);
    }

    #[test]
    fn white_shows_through_what_is_clear() {
        assert_eq!(brightness(&[0, 0, 0, 0]), 1.0);
        assert_eq!(brightness(&[0, 0, 0, 255]), 0.0);
    }
}
