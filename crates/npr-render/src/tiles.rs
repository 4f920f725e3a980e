//! Large frames in pieces.
//!
//! A frame that no device could hold at once is drawn tile by tile. Lines reach over tile borders, so each tile is
//! drawn with a margin that is cut off again; with a mask of full resolution, a picture in tiles is the same as one
//! drawn whole, up to a pixel in ten thousand where a corner rounds differently. Coarser masks start anew in every
//! tile.

use npr_style::backdrop::TILE;

/// Most pixels of a tile with its margin: 16 bytes for each, as rims and smoke have, fit the 128 MiB that every device
/// binds. A frame of 3840x2160 is one.
pub(crate) const TILE_PIXELS: u32 = 1 << 23;

/// The same where lines are found on a mask, whose G-buffer must fit.
pub(crate) const MASK_TILE_PIXELS: u32 = 4_000_000;

/// Side of the largest square tile, which fits whatever the mask's scale.
const SQUARE_SIDE: u32 = 1984;

/// Fewest pixels along a side that a tile keeps, so that margins do not become all the work.
const KEPT_SIDE: u32 = 64;

/// Longest side of a tile with its margin: four samples per pixel must fit a picture of 8192.
const TILE_SIDE: u32 = 4096;

/// How a frame is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Tiles {
    /// The whole frame.
    pub frame: [u32; 2],
    /// Pixels of each tile that are kept.
    pub kept: [u32; 2],
    /// Pixels drawn around them on every side; none where one tile is the frame.
    pub margin: u32,
}

impl Tiles {
    /// Cuts a frame into as few tiles of about `most_pixels` as fit, each with `margin` pixels around.
    pub fn new(frame: [u32; 2], margin: u32, most_pixels: u32) -> Self {
        let most_pixels = most_pixels.min(TILE_PIXELS);
        let fits =
            |w: u64, h: u64| w * h <= u64::from(most_pixels) && w.max(h) <= u64::from(TILE_SIDE);
        if fits(u64::from(frame[0]), u64::from(frame[1])) {
            return Self {
                frame,
                kept: frame,
                margin: 0,
            };
        }
        // The tiles by which lines decide to turn darker or brighter lie on one grid over the whole frame.
        let margin = margin.min(600).next_multiple_of(TILE);
        let least = 2 * margin + KEPT_SIDE;
        let side = most_pixels.isqrt().clamp(least, SQUARE_SIDE) - 2 * margin;
        // Tiles of equal size: a narrow last one would cost as much as a full one.
        let kept = frame.map(|length| {
            length
                .div_ceil(length.div_ceil(side))
                .next_multiple_of(TILE)
        });
        Self {
            frame,
            kept,
            margin,
        }
    }

    /// Size of every tile with its margin.
    pub fn size(&self) -> [u32; 2] {
        self.kept.map(|kept| kept + 2 * self.margin)
    }

    /// How many tiles there are in a row, and how many rows.
    fn columns_and_rows(&self) -> [u32; 2] {
        [0, 1].map(|axis| self.frame[axis].div_ceil(self.kept[axis]))
    }

    /// How many tiles there are.
    pub fn count(&self) -> u32 {
        let [columns, rows] = self.columns_and_rows();
        columns * rows
    }

    /// Where the kept part of a tile starts, counted from 0, row by row.
    pub fn origin(&self, number: u32) -> [u32; 2] {
        let [columns, _] = self.columns_and_rows();
        [
            number % columns * self.kept[0],
            number / columns * self.kept[1],
        ]
    }

    /// Where the kept part of each tile starts, row by row.
    pub fn origins(&self) -> impl Iterator<Item = [u32; 2]> + use<> {
        let tiles = *self;
        (0..self.count()).map(move |number| tiles.origin(number))
    }

    /// How many tiles are done once that at `origin` is, and how many there are.
    pub fn progress(&self, origin: [u32; 2]) -> [usize; 2] {
        let [columns, _] = self.columns_and_rows();
        let before = origin[1] / self.kept[1] * columns + origin[0] / self.kept[0];
        [before + 1, self.count()].map(|count| count as usize)
    }

    /// Frame position of the top left corner of the tile whose kept part starts at `origin`.
    pub fn corner_px(&self, origin: [u32; 2]) -> [f32; 2] {
        origin.map(|at| at as f32 - self.margin as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn tiles_cover_the_frame_once(
            w in 1u32..20_000, h in 1u32..20_000, margin in 0u32..700, most in 0u32..10_000_000,
        ) {
            let tiles = Tiles::new([w, h], margin, most);
            let size = tiles.size();
            let pixels = u64::from(size[0]) * u64::from(size[1]);
            prop_assert!(pixels <= u64::from(TILE_PIXELS) && size[0].max(size[1]) <= TILE_SIDE);
            let covered: u64 = tiles.origins().map(|[x, y]| {
                u64::from(tiles.kept[0].min(w - x)) * u64::from(tiles.kept[1].min(h - y))
            }).sum();
            prop_assert_eq!(covered, u64::from(w) * u64::from(h));
            let count = tiles.origins().count();
            for (index, origin) in tiles.origins().enumerate() {
                prop_assert_eq!(tiles.progress(origin), [index + 1, count]);
            }
        }
    }
}
