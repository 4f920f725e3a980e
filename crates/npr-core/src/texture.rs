//! Textures packed into one array of words, read by the same code on both engines.
//!
//! The store starts with a table of 256 floats (linear light of every sRGB byte). Each texture is a header of
//! [`HEADER_WORDS`] words followed by its MIP levels, each a row-major array of sRGB bytes with straight alpha.

use crate::color;
use std::sync::Arc;

/// Words before a texture's first texel: width, height, levels, horizontal wrap, vertical wrap, unused.
pub const HEADER_WORDS: u32 = 6;

/// What a texture shows beside its edges.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wrap {
    /// Repeats.
    #[default]
    Repeat,
    /// Keeps the colour of the edge.
    Clamp,
    /// Repeats, every other time mirrored.
    Mirror,
}

/// All textures of a scene, packed. A clone shares the words until one of the two adds to them.
#[derive(Debug, Clone)]
pub struct TextureStore {
    words: Arc<Vec<u32>>,
}

impl Default for TextureStore {
    fn default() -> Self {
        Self::new()
    }
}

impl TextureStore {
    /// A store without textures.
    pub fn new() -> Self {
        let table = (0..=255).map(|byte| color::linear_from_byte(byte).to_bits());
        Self {
            words: Arc::new(table.collect()),
        }
    }

    /// The packed words, as passes read them.
    pub fn words(&self) -> &[u32] {
        &self.words
    }

    /// The same, for readers that keep them.
    pub fn shared_words(&self) -> &Arc<Vec<u32>> {
        &self.words
    }

    /// Words that can be added to.
    fn own_words(&mut self) -> &mut Vec<u32> {
        Arc::make_mut(&mut self.words)
    }

    /// Adds a texture of `size` pixels, sRGB bytes with straight alpha, row by row from the top, and all its MIP
    /// levels.
    ///
    /// Gives where its header starts; an empty image, or one whose pixels do not match its size, gives `None`.
    pub fn add(&mut self, size: [u32; 2], rgba: &[u8], wrap: [Wrap; 2]) -> Option<u32> {
        // Refuse pixels that do not fill the size.
        let count = (size[0] as usize).checked_mul(size[1] as usize)?;
        if count == 0 || rgba.len() != count.checked_mul(4)? {
            return None;
        }

        // Write the header.
        let start = u32::try_from(self.words.len()).ok()?;
        let levels = 32 - size[0].max(size[1]).leading_zeros();
        self.own_words()
            .extend([size[0], size[1], levels, wrap[0] as u32, wrap[1] as u32, 0]);

        // Write the levels, each half as large as the one before.
        let mut level: Vec<u32> = rgba
            .chunks_exact(4)
            .map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]))
            .collect();
        let mut level_size = size;
        for _ in 1..levels {
            let (next, next_size) = self.halve(&level, level_size);
            self.own_words().extend(&level);
            (level, level_size) = (next, next_size);
        }
        self.own_words().extend(&level);
        Some(start)
    }

    /// Adds a square tile that repeats, with levels made by the caller: each half as wide as the one before, from
    /// `side`, a power of two. Texels are taken as they are; `spacing_texels` lies in the header where textures have
    /// their wrap.
    ///
    /// Gives where its header starts; `None` where a level has the wrong size.
    pub fn add_tile(&mut self, side: u32, spacing_texels: f32, levels: &[Vec<u32>]) -> Option<u32> {
        let fits = |(l, level): (usize, &Vec<u32>)| {
            let side = side.checked_shr(l as u32).unwrap_or(0) as usize;
            side > 0 && level.len() == side * side
        };
        if !side.is_power_of_two() || levels.is_empty() || !levels.iter().enumerate().all(fits) {
            return None;
        }
        let start = u32::try_from(self.words.len()).ok()?;
        self.own_words().extend([
            side,
            side,
            levels.len() as u32,
            spacing_texels.to_bits(),
            0,
            0,
        ]);
        for level in levels {
            self.own_words().extend(level);
        }
        Some(start)
    }

    /// Adds words that only their reader understands, and gives where they start.
    pub fn add_words(&mut self, words: &[u32]) -> Option<u32> {
        let start = u32::try_from(self.words.len()).ok()?;
        self.own_words().extend(words);
        Some(start)
    }

    /// The next smaller level: every pixel averages four, in linear light weighted by alpha.
    fn halve(&self, texels: &[u32], size: [u32; 2]) -> (Vec<u32>, [u32; 2]) {
        let next = [(size[0] / 2).max(1), (size[1] / 2).max(1)];
        let mut out = Vec::with_capacity((next[0] * next[1]) as usize);
        for y in 0..next[1] {
            for x in 0..next[0] {
                // Sum four pixels in linear light, weighted by alpha.
                let mut sum = [0.0f32; 4];
                for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    let (px, py) = ((2 * x + dx).min(size[0] - 1), (2 * y + dy).min(size[1] - 1));
                    let [r, g, b, a] =
                        linear_texel(&self.words, texels[(py * size[0] + px) as usize]);
                    sum = [sum[0] + r * a, sum[1] + g * a, sum[2] + b * a, sum[3] + a];
                }

                // Encode their mean.
                let weight = 1.0 / sum[3].max(1e-6);
                let encode = |v: f32| color::srgb_from_linear(v * weight);
                out.push(color::pack_rgba8([
                    encode(sum[0]),
                    encode(sum[1]),
                    encode(sum[2]),
                    sum[3] * 0.25,
                ]));
            }
        }
        (out, next)
    }
}

/// Linear colour with straight alpha at `uv` of the texture whose header starts at `start`.
///
/// `footprint_uv` is the length that one pixel of the picture covers in texture space; it picks the two MIP levels
/// that are blended. Filtering is bilinear within a level.
pub fn sample(words: &[u32], start: u32, uv: [f32; 2], footprint_uv: f32) -> [f32; 4] {
    let at = start as usize;
    let size = [words[at], words[at + 1]];
    let levels = words[at + 2];
    let span = footprint_uv * size[0].max(size[1]) as f32;
    let lod = crate::math::log2(span.max(1.0)).clamp(0.0, (levels - 1) as f32);
    let fine = lod as u32;
    let coarse = (fine + 1).min(levels - 1);
    let t = lod - fine as f32;
    let near = sample_level(words, start, fine, uv);
    if t == 0.0 {
        return near;
    }
    let far = sample_level(words, start, coarse, uv);
    std::array::from_fn(|i| near[i] + (far[i] - near[i]) * t)
}

/// Bilinear sample of one MIP level.
fn sample_level(words: &[u32], start: u32, level: u32, uv: [f32; 2]) -> [f32; 4] {
    let at = start as usize;
    let mut size = [words[at], words[at + 1]];
    let wrap = [words[at + 3], words[at + 4]];
    let mut first = start + HEADER_WORDS;
    for _ in 0..level {
        first += size[0] * size[1];
        size = [(size[0] / 2).max(1), (size[1] / 2).max(1)];
    }
    let x = texel_pair(uv[0], size[0], wrap[0]);
    let y = texel_pair(uv[1], size[1], wrap[1]);
    let texel = |px: u32, py: u32| linear_texel(words, words[(first + py * size[0] + px) as usize]);
    let (a, b) = (texel(x.0, y.0), texel(x.1, y.0));
    let (c, d) = (texel(x.0, y.1), texel(x.1, y.1));
    std::array::from_fn(|i| {
        let top = a[i] + (b[i] - a[i]) * x.2;
        let bottom = c[i] + (d[i] - c[i]) * x.2;
        top + (bottom - top) * y.2
    })
}

/// The two texels around a coordinate along one axis, and the share of the second.
fn texel_pair(coordinate: f32, size: u32, wrap: u32) -> (u32, u32, f32) {
    let scaled = coordinate * size as f32 - 0.5;
    // Past 2^22 a float has no fraction left to filter with, and casts must not overflow.
    let scaled = if scaled.abs() < 4_194_304.0 {
        scaled
    } else {
        0.0
    };
    let floor = scaled.floor();
    let index = floor as i32;
    (
        wrapped(index, size, wrap),
        wrapped(index + 1, size, wrap),
        scaled - floor,
    )
}

/// A texel index brought into range.
fn wrapped(index: i32, size: u32, wrap: u32) -> u32 {
    let n = size as i32;
    if wrap == Wrap::Clamp as u32 {
        return index.clamp(0, n - 1) as u32;
    }
    let period = if wrap == Wrap::Mirror as u32 {
        2 * n
    } else {
        n
    };
    let within = ((index % period) + period) % period;
    (if within < n {
        within
    } else {
        period - 1 - within
    }) as u32
}

/// The texel that a coordinate of an image of `size` pixels lies in, without filtering.
pub fn texel_at(uv: [f32; 2], size: [u32; 2], wrap: [Wrap; 2]) -> [u32; 2] {
    std::array::from_fn(|axis| {
        let scaled = uv[axis] * size[axis] as f32;
        // As for filtering: casts must not overflow.
        let scaled = if scaled.abs() < 4_194_304.0 {
            scaled
        } else {
            0.0
        };
        wrapped(scaled.floor() as i32, size[axis], wrap[axis] as u32)
    })
}

/// Linear light of a packed texel, by the table at the start of the store.
#[inline]
pub fn linear_texel(words: &[u32], texel: u32) -> [f32; 4] {
    let [r, g, b, a] = texel.to_le_bytes();
    let decode = |byte: u8| f32::from_bits(words[usize::from(byte)]);
    [decode(r), decode(g), decode(b), f32::from(a) / 255.0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn checker(n: u32) -> Vec<u8> {
        (0..n * n)
            .flat_map(|i| {
                if (i % n + i / n).is_multiple_of(2) {
                    [255; 4]
                } else {
                    [0, 0, 0, 255]
                }
            })
            .collect()
    }

    #[test]
    fn a_texel_centre_gives_the_texel() {
        let mut store = TextureStore::new();
        let start = store.add([4, 4], &checker(4), [Wrap::Repeat; 2]).unwrap();
        assert_eq!(sample(store.words(), start, [0.125, 0.125], 0.0), [1.0; 4]);
        assert_eq!(
            sample(store.words(), start, [0.375, 0.125], 0.0),
            [0.0, 0.0, 0.0, 1.0]
        );
    }

    #[test]
    fn clones_share_their_words_until_one_grows() {
        let mut store = TextureStore::new();
        store.add([4, 4], &checker(4), [Wrap::Repeat; 2]);
        let mut other = store.clone();
        assert!(Arc::ptr_eq(store.shared_words(), other.shared_words()));
        let before = store.words().to_vec();
        let start = other.add_words(&[5, 6]).unwrap() as usize;
        assert_eq!(store.words(), before);
        assert_eq!(other.words()[..start], before);
        assert_eq!(other.words()[start..], [5, 6]);
    }

    #[test]
    fn far_away_a_checker_becomes_grey() {
        let mut store = TextureStore::new();
        let start = store
            .add([64, 64], &checker(64), [Wrap::Repeat; 2])
            .unwrap();
        let far = sample(store.words(), start, [0.3, 0.7], 1.0);
        assert!((far[0] - 0.5).abs() < 0.01, "{far:?}");
    }

    #[test]
    fn images_that_do_not_match_their_size_are_refused() {
        let mut store = TextureStore::new();
        assert_eq!(store.add([2, 2], &[0; 15], [Wrap::Clamp; 2]), None);
        assert_eq!(store.add([0, 2], &[], [Wrap::Clamp; 2]), None);
    }

    proptest! {
        #[test]
        fn samples_stay_within_the_texture(
            u: f32, v: f32, footprint in 0f32..4.0, mode in 0u32..3, w in 1u32..9, h in 1u32..9,
        ) {
            let wrap = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror][mode as usize];
            let mut store = TextureStore::new();
            let rgba: Vec<u8> = (0..w * h * 4).map(|i| (100 + (i * 37) % 80) as u8).collect();
            let start = store.add([w, h], &rgba, [wrap; 2]).unwrap();
            let low = color::linear_from_srgb(99.0 / 255.0);
            let high = color::linear_from_srgb(181.0 / 255.0);
            let got = sample(store.words(), start, [u, v], footprint);
            prop_assert!(got[..3].iter().all(|c| (low..high).contains(c)), "{got:?}");
        }
    }
}
