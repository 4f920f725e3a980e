//! Tones of hard ramps without slivers: no piece of a tone is drawn that is narrower than the style asks for. Ink that
//! light alone decides is a tone too.
//!
//! 1. [`find_tones`] finds the tones of the samples of every pixel.
//! 2. [`flag_tones`] flags the tiles that hold more than one tone of a part.
//! 3. [`even_tones`] takes the median of the tones over a disc, the pixels of other parts left out. A median drops
//!    strips that cover less than half of the disc, and keeps straight edges where they are. Where other parts cover
//!    some of the disc, it moves away from them, since a strip along a border covers twice as much of what is left.
//!    Where the median differs from the tone of the first sample, the tone is *changed*. Its edge is blended over one
//!    pixel by how far the share of the disc lies from a half: blur and cut, as [Merriman, Bence & Osher 1992] move
//!    curves.
//!
//!    Hatches that are cut out ([`cut_tone`](crate::cut_tone)) go the same way.
//! 4. The last pass looks at the medians of a pixel and of its neighbours. Where all are the same, the pixel has that
//!    tone, whatever its samples say. Where they differ and none is changed, an edge of the light goes through, and the
//!    samples show it as they do without all this. Where one is changed, the blended edge is shown.

use crate::compose::Layers;
use crate::ink_step::{Evened, ink_step, ramp_steps};
use crate::ramp::Level;
use crate::tone::surface_at;
use crate::triangle_constants::TriangleConstants;
use npr_core::geometry::Part;
use npr_core::raster::HULL_BIT;
use rayon::prelude::*;
use std::ops::Range;

/// Bits of the tone of each of the four samples in a word of the tone map; the number of the part plus one lies above
/// them.
pub const TONE_BITS: u32 = 3;

/// Bits of all of them.
const ALL_TONE_BITS: u32 = 4 * TONE_BITS;

/// What a tone is multiplied by for four samples that have it.
const FOUR_TONES: u32 = 585;

/// The tones of a ramp.
pub const TONES: u32 = 8;

/// Pixels of each side of a tile that is looked at as a whole.
pub const TILE: u32 = 8;

/// Parts of a step between two tones in a word of the evened map.
pub const STEP_PARTS: u32 = 256;

/// Bits of the steps in a word of the evened map.
pub const STEP_BITS: u32 = 11;

/// The bit of a changed tone above them; the number of the part plus one, as far as it has room, lies above that.
pub const CHANGED: u32 = 1 << STEP_BITS;

/// Share of the radius of a disc that a strip through its middle is wide when it covers half of it.
const STRIP_OF_RADIUS: f32 = 0.81;

/// Pixels over which the share of a disc on one side of a line goes from none to all if it went on as at its middle, in
/// radii: half of pi.
const EDGE_OF_RADIUS: f32 = 1.57;

/// How far a disc moves away from other parts, in distances of its middle from the centroid of its pixels that show its
/// own part. With this share a strip along a straight border is gone below 0.95 of the width at which others are, and
/// whole above 1.19 of it.
const SHIFT_OF_CENTROID: f32 = 1.6;

/// Farthest that it moves along each axis, in radii: about as far as at a straight border.
const SHIFT_OF_RADIUS: f32 = 0.7;

/// Pixels below which a disc stays where it is.
const LEAST_SHIFT_PX: f32 = 0.05;

/// Largest radius of the disc of an evened tone, in pixels: its cost grows with its area.
pub const REACH_PX_MAX: f32 = 8.0;

/// Largest radius of a disc all of whose pixels are counted, in pixels.
const DENSE_REACH_PX: f32 = 12.0;

/// Radius in pixels of the disc whose median drops strips narrower than `least_px`. 0 if nothing can be that narrow.
pub fn reach_px(least_px: f32) -> f32 {
    if least_px < 0.5 {
        return 0.0;
    }
    radius_of(least_px).min(REACH_PX_MAX)
}

/// Radius of a disc whose median drops strips that are narrower than this, in the same unit.
pub(crate) fn radius_of(least: f32) -> f32 {
    least / STRIP_OF_RADIUS
}

/// Pixels between those that a disc of a radius counts.
fn stride_px(reach_px: f32) -> u32 {
    ((reach_px / DENSE_REACH_PX).ceil() as u32).max(1)
}

/// Pixels to each side that tones are looked at, by the radius of the disc.
pub fn far_px(reach_px: f32) -> u32 {
    (reach_px * (1.0 + SHIFT_OF_RADIUS) + 0.5).ceil() as u32
}

/// Whether tones of a part can be evened: it has steps between tones or at the end of its ink, and they are hard.
pub fn has_steps(part: &Part) -> bool {
    let others = Part::UNLIT | Part::TONE_ROW | Part::TOON;
    let is_even = part.ramp[1][3] >= Level::UNUSED;
    let has_room = part.ramp[TONES as usize - 1][3] >= Level::UNUSED;
    let has_ink = has_room && ink_step(part) < Level::UNUSED;
    part.flags & others == 0 && (is_even || part.softness == 0.0) && (!is_even || has_ink)
}

/// Whether the tones of a part are evened.
fn is_evened(part: &Part) -> bool {
    part.tone_reach_px > 0.0 && part.flags & Part::CUT == 0
}

/// Steps that the light passes at coordinate `x`: those of the ramp, and the end of the ink.
fn steps_passed(part: &Part, x: f32) -> u32 {
    (ramp_steps(part, x) + u32::from(ink_step(part) <= x)).min(TONES - 1)
}

/// Tiles of each side of a picture.
pub fn tiles_of(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| side.div_ceil(TILE))
}

/// Finds the tones of every pixel, as a word of the tone map: the part of its first sample plus one, then for every
/// sample the number of steps that the light has passed: those of its ramp, and the end of its ink. Samples that show
/// the triangle of the first, or another part, have its tone. 0 where nothing is to be evened.
///
/// O(pixels), parallel over rows.
pub fn find_tones(layers: &Layers<'_>, tones: &mut [u32]) {
    each_texel(layers.window.size[0], tones, |x, y| layers.tone_word(x, y));
}

/// Fills a picture row by row, in parallel.
fn each_texel(width: u32, texels: &mut [u32], texel: impl Fn(u32, u32) -> u32 + Sync) {
    let rows = texels.par_chunks_mut(width.max(1) as usize).enumerate();
    rows.for_each(|(y, row)| {
        for (x, into) in (0u32..).zip(row) {
            *into = texel(x, y as u32);
        }
    });
}

/// Tones of the pixels of a picture.
#[derive(Debug, Clone, Copy)]
pub struct ToneMap<'a> {
    /// Size of the picture.
    pub size: [u32; 2],
    /// Parts.
    pub parts: &'a [Part],
    /// Words of [`find_tones`].
    pub words: &'a [u32],
}

/// Finds the tiles of [`TILE`] pixels in which tones may change: 1 for each where a part shows two tones within reach,
/// or more than two words of the tone map lie there; else 0.
///
/// O(pixels), parallel over rows of tiles.
pub fn flag_tones(map: &ToneMap<'_>, flags: &mut [u32]) {
    let [across, _] = tiles_of(map.size);
    each_texel(across, flags, |x, y| {
        u32::from(map.has_steps_around([x, y]) || map.is_cut_around([x, y]))
    });
}

/// Evens the tones: for every pixel of the tone map the part plus one, [`CHANGED`], and the steps that the median has
/// passed, in [`STEP_PARTS`], a step at the edge of a tone in part.
///
/// O(pixels), and O(pixels of flagged tiles · reach²), parallel over rows.
pub fn even_tones(map: &ToneMap<'_>, flags: &[u32], evened: &mut [u32]) {
    let [across, _] = tiles_of(map.size);
    each_texel(map.size[0], evened, |x, y| {
        let is_flagged = flags[(y / TILE * across + x / TILE) as usize] != 0;
        map.evened([x, y], is_flagged)
    });
}

/// The part in a word of the evened map.
fn tag_of(part: u32) -> u32 {
    (part + 1) << (STEP_BITS + 1)
}

/// The part in a word of the evened map, or of the tone map.
pub(crate) fn part_in(word: u32) -> u32 {
    (word >> ALL_TONE_BITS) - 1
}

/// The tone that a word of the evened map has most of, in steps.
fn median_of(word: u32) -> u32 {
    ((word & (CHANGED - 1)) + STEP_PARTS / 2) / STEP_PARTS
}

impl ToneMap<'_> {
    /// Whether tones within reach of a tile may change.
    fn has_steps_around(&self, tile: [u32; 2]) -> bool {
        // Find how far the parts of the tile reach.
        let start = tile.map(|at| at * TILE);
        let end: [u32; 2] = std::array::from_fn(|i| (start[i] + TILE).min(self.size[i]));
        let mut own = (start[1]..end[1]).flat_map(|y| self.row(y, start[0]..end[0]));
        let Some(first) = own.find(|word| **word != 0) else {
            return false;
        };
        let far = far_px(self.part_of(*first).tone_reach_px);
        let low = start.map(|at| at.saturating_sub(far));
        let high: [u32; 2] = std::array::from_fn(|i| (end[i] + far).min(self.size[i]));

        // Look for a third word, or a second of one part.
        let mut known = [*first, 0];
        for y in low[1]..high[1] {
            for word in self.row(y, low[0]..high[0]) {
                if *word == 0 || known.contains(word) {
                    continue;
                }
                if known[1] != 0 || *word >> ALL_TONE_BITS == *first >> ALL_TONE_BITS {
                    return true;
                }
                known[1] = *word;
            }
        }
        false
    }

    pub(crate) fn row(&self, y: u32, columns: Range<u32>) -> &[u32] {
        let at = |x: u32| (y * self.size[0] + x) as usize;
        &self.words[at(columns.start)..at(columns.end)]
    }

    pub(crate) fn part_of(&self, word: u32) -> &Part {
        &self.parts[part_in(word) as usize]
    }

    /// Word of the evened map of a pixel.
    fn evened(&self, [x, y]: [u32; 2], is_flagged: bool) -> u32 {
        // Keep the tone where all around are alike.
        let word = self.words[(y * self.size[0] + x) as usize];
        if word == 0 {
            return 0;
        }
        let tag = tag_of(part_in(word));
        let tone = word & (TONES - 1);
        let reach_px = self.part_of(word).tone_reach_px;
        if let Some(steps) = self.beside_cut_tone(word) {
            return tag | steps;
        }
        if !is_flagged {
            return tag | (tone * STEP_PARTS);
        }

        // Weigh the tones of the part around it, away from other parts.
        let mut disc = self.disc([x, y], [0.0; 2], word);
        let most = SHIFT_OF_RADIUS * reach_px;
        let along = |moment: f32| (moment * (SHIFT_OF_CENTROID / disc.sum)).clamp(-most, most);
        let shift = disc.moment.map(along);
        if shift.iter().any(|along| along.abs() > LEAST_SHIFT_PX) {
            disc = self.disc([x, y], shift, word);
        }

        // Sum the steps that most of them have passed, the last one in part.
        let per_px = EDGE_OF_RADIUS * reach_px;
        let mut passed = 0.0;
        let mut above = 0.0;
        for weight in disc.weights[1..].iter().rev() {
            above += weight;
            passed += ((above / disc.sum - 0.5) * per_px + 0.5).clamp(0.0, 1.0);
        }
        let steps = (passed * STEP_PARTS as f32 + 0.5) as u32;
        let changed = if median_of(steps) == tone { 0 } else { CHANGED };
        tag | changed | steps
    }

    /// Tones that a word counts over a disc, whose middle is moved from a pixel by `shift` pixels.
    fn disc(&self, [x, y]: [u32; 2], shift: [f32; 2], word: u32) -> Disc {
        let reach_px = self.part_of(word).tone_reach_px;
        let stride = stride_px(reach_px);
        let far = (reach_px + 0.5 + shift[0].abs().max(shift[1].abs())).ceil() as u32;
        let most = (reach_px + 0.5) * (reach_px + 0.5);
        let steps = far.div_ceil(stride);
        let from = |at: u32| at - steps.min(at / stride) * stride;
        let to = |at: u32, side: u32| (at + steps * stride + 1).min(side);
        let columns = from(x)..to(x, self.size[0]);
        let mut disc = Disc::default();
        for v in (from(y)..to(y, self.size[1])).step_by(stride as usize) {
            let down = v as f32 - y as f32 - shift[1];
            let row = columns.clone().zip(self.row(v, columns.clone()));
            for (u, other) in row.step_by(stride as usize) {
                let right = u as f32 - x as f32 - shift[0];
                let square = right * right + down * down;
                if square > most {
                    continue;
                }
                if let Some(tones) = self.counted(*other, word) {
                    let weight = (reach_px + 0.5 - square.sqrt()).min(1.0);
                    disc.add(tones, weight);
                    disc.sum += weight;
                    disc.moment[0] += weight * right;
                    disc.moment[1] += weight * down;
                }
            }
        }
        disc
    }

    /// The word with the tones of a pixel in a disc around another: those of the same part, or of the sheet of a hatch
    /// that is cut out. `None` where the disc does not count them.
    fn counted(&self, other: u32, word: u32) -> Option<u32> {
        if self.is_cut(word) {
            return self.on_sheet(other).map(|tone| tone * FOUR_TONES);
        }
        (other >> ALL_TONE_BITS == word >> ALL_TONE_BITS).then_some(other)
    }
}

/// Tones of a part over a disc.
#[derive(Debug, Clone, Copy, Default)]
struct Disc {
    /// Weight of every tone.
    weights: [f32; TONES as usize],
    /// Sum of them.
    sum: f32,
    /// Sum of weights times distances from the middle, in pixels.
    moment: [f32; 2],
}

impl Layers<'_> {
    /// Word of the tone map of a pixel.
    fn tone_word(&self, x: u32, y: u32) -> u32 {
        // Take parts whose tones are evened.
        let ids = self.samples_of(x, y);
        let id = ids[0];
        if id == 0 || id & HULL_BIT != 0 {
            return 0;
        }
        let number = self.known[(id - 1) as usize].part;
        let part = &self.parts[number as usize];
        if part.tone_reach_px == 0.0 {
            return 0;
        }

        // Look at the middle of the pixel what a hatch that is cut out is there.
        let pixel = self.window.frame_at(x, y);
        if part.flags & Part::CUT != 0 {
            let tone = self.cut_tone_at(id, pixel);
            return ((number + 1) << ALL_TONE_BITS) | (tone * FOUR_TONES);
        }

        // Count the steps at every sample that shows another triangle of the part.
        let first = self.steps_at(id, 0, pixel);
        let mut word = ((number + 1) << ALL_TONE_BITS) | (first * FOUR_TONES);
        for (sample, other) in (0u32..).zip(ids.iter()).skip(1) {
            let is_bare = *other == 0 || *other & HULL_BIT != 0 || *other == id;
            if !is_bare && self.known[(other - 1) as usize].part == number {
                word ^= (first ^ self.steps_at(*other, sample, pixel)) << (sample * TONE_BITS);
            }
        }
        word
    }

    /// Steps that the light of triangle `id` has passed at a sample of the pixel whose middle is at `px`.
    fn steps_at(&self, id: u32, sample: u32, [px, py]: [f32; 2]) -> u32 {
        let triangle = &self.triangles[(id - 1) as usize];
        let corners = self.corners_of(triangle);
        let offset = self.sample_offset(sample);
        let at = [px + offset[0], py + offset[1]];
        let (weights, world, normal) = surface_at(self.view, &corners, at);
        let dark = self.shadowed(id, &corners, weights);
        let open = self.openness(&corners, at).at([0.0; 2]);
        let (x, _) = self.lights.coordinate_under(world, normal, dark, open);
        steps_passed(&self.parts[triangle.part as usize], x)
    }

    /// The colour that a triangle has all over, if its tones are not evened.
    pub(crate) fn whole_color(&self, known: &TriangleConstants) -> Option<[f32; 3]> {
        let is_evened = is_evened(&self.parts[known.part as usize]);
        known.whole().filter(|_| !is_evened)
    }

    /// Whether a pixel whose samples show triangles of one known colour shows it when tones are evened: it shows a
    /// single part, and the tones of that in and around the pixel are alike and as they were found.
    pub(crate) fn is_settled(&self, x: u32, y: u32, seen: &[u32]) -> bool {
        let seen = seen.iter().filter(|id| **id != 0);
        let parts = seen.map(|id| self.known[(id - 1) as usize].part);
        let evened = |part: &u32| is_evened(&self.parts[*part as usize]);
        let Some(own) = parts.clone().find(evened) else {
            return true;
        };
        let around = self.evened_around([x, y], own);
        around.is_alike()
            && around.own.is_some()
            && !around.is_changed
            && parts.clone().all(|part| part == own)
    }

    /// Tone of part `number` at a pixel where it is evened; `None` where samples show it.
    pub(crate) fn evened_tone(&self, number: u32, frame_px: [f32; 2]) -> Option<Evened> {
        // Take the tone that all around have, or the edge that was blended.
        let part = &self.parts[number as usize];
        if !is_evened(part) {
            return None;
        }
        let around = self.evened_around(self.window.pixel_at(frame_px), number);
        let steps = if around.is_alike() {
            around.least * STEP_PARTS
        } else if around.is_changed {
            around.own.unwrap_or(around.sum / around.count.max(1))
        } else {
            return None;
        };

        // Take the step at the end of the ink out of them.
        let end = ink_step(part);
        let passed = steps as f32 / STEP_PARTS as f32;
        let bare = match end < Level::UNUSED {
            true => (passed - ramp_steps(part, end) as f32).clamp(0.0, 1.0),
            false => 0.0,
        };
        let ink = (end < Level::UNUSED).then_some(1.0 - bare);

        // Blend the tones before and behind the step.
        let whole = ((passed - bare) as u32).min(TONES - 2);
        let share = passed - bare - whole as f32;
        let [from, to] = [whole, whole + 1].map(|tone| part.ramp[tone as usize]);
        let light = std::array::from_fn(|i| from[i] + (to[i] - from[i]) * share);
        Some(Evened { light, ink })
    }

    /// The evened map in and around a pixel, as far as it shows a part.
    fn evened_around(&self, [x, y]: [u32; 2], part: u32) -> Around {
        let [width, height] = self.window.size;
        let tag = tag_of(part);
        let mut around = Around {
            least: TONES,
            ..Around::default()
        };
        for v in y.saturating_sub(1)..(y + 2).min(height) {
            for u in x.saturating_sub(1)..(x + 2).min(width) {
                let word = self.evened[(v * width + u) as usize];
                if word & !(2 * CHANGED - 1) != tag {
                    continue;
                }
                let steps = word & (CHANGED - 1);
                around.least = around.least.min(median_of(word));
                around.most = around.most.max(median_of(word));
                around.is_changed |= word & CHANGED != 0;
                around.sum += steps;
                around.count += 1;
                if [u, v] == [x, y] {
                    around.own = Some(steps);
                }
            }
        }
        around
    }
}

impl Disc {
    /// Adds the tones of a pixel.
    fn add(&mut self, word: u32, weight: f32) {
        let first = word & (TONES - 1);
        if word & ((1 << ALL_TONE_BITS) - 1) == first * FOUR_TONES {
            self.weights[first as usize] += weight;
            return;
        }
        for sample in 0..4 {
            let tone = (word >> (sample * TONE_BITS)) & (TONES - 1);
            self.weights[tone as usize] += weight * 0.25;
        }
    }
}

/// Evened tones of a part in and around a pixel.
#[derive(Debug, Clone, Copy, Default)]
struct Around {
    /// The darkest and the brightest tone that a pixel has most of.
    least: u32,
    most: u32,
    /// Whether one of them is changed.
    is_changed: bool,
    /// Steps of the pixel itself, if it shows the part.
    own: Option<u32>,
    /// The sum of all steps, and the number of pixels.
    sum: u32,
    count: u32,
}

impl Around {
    /// Whether the part is there and has one tone.
    fn is_alike(&self) -> bool {
        self.least == self.most
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backdrop::Rules;
    use crate::compose::Compose;
    use crate::hatch::tone_value;
    use crate::inking::shade_level;
    use crate::lighting::Lights;
    use npr_core::math;
    use npr_core::window::{View, Window};
    use proptest::prelude::*;

    const SIDE: u32 = 40;

    /// A part of three tones, 0, 1 and 2, whose strips under `least_px` are dropped.
    fn part(least_px: f32) -> Part {
        let mut ramp = [[0.0, 0.0, 0.0, Level::UNUSED]; 8];
        for (i, stop) in ramp[..3].iter_mut().enumerate() {
            *stop = [i as f32, i as f32, i as f32, 0.3 * i as f32];
        }
        Part {
            ramp,
            tone_reach_px: reach_px(least_px),
            ..Part::default()
        }
    }

    fn word(part: u32, tone: u32) -> u32 {
        ((part + 1) << ALL_TONE_BITS) | (tone * FOUR_TONES)
    }

    /// A picture of words of the tone map.
    struct Toned {
        parts: Vec<Part>,
        evened: Vec<u32>,
    }

    impl Toned {
        /// The picture whose pixels have these words; `flags_all` looks around every pixel.
        fn new(parts: Vec<Part>, flags_all: bool, word_at: impl Fn(u32, u32) -> u32) -> Self {
            let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
            let words: Vec<u32> = places.map(|(x, y)| word_at(x, y)).collect();
            let map = ToneMap {
                size: [SIDE; 2],
                parts: &parts,
                words: &words,
            };
            let mut flags = vec![0; tiles_of([SIDE; 2]).iter().product::<u32>() as usize];
            flag_tones(&map, &mut flags);
            if flags_all {
                flags.fill(1);
            }
            let mut evened = vec![0; words.len()];
            even_tones(&map, &flags, &mut evened);
            Self { parts, evened }
        }

        /// The tone of part 0 in the evened map.
        fn tone(&self, x: u32, y: u32) -> f32 {
            (self.evened[(y * SIDE + x) as usize] & (CHANGED - 1)) as f32 / STEP_PARTS as f32
        }

        fn is_changed(&self, x: u32, y: u32) -> bool {
            self.evened[(y * SIDE + x) as usize] & CHANGED != 0
        }

        /// The light of part 0 that a pixel shows; none where samples decide.
        fn shown(&self, x: u32, y: u32) -> Option<f32> {
            self.evened(x, y).map(|tone| tone.light[0])
        }

        /// The tone of part 0 that a pixel shows; none where samples decide.
        fn evened(&self, x: u32, y: u32) -> Option<Evened> {
            let size = [SIDE as f32; 2];
            let window = Window::over(size, [0.0; 2], size, [SIDE; 2]);
            let (view, lights, rules) = (View::default(), Lights::default(), Rules::default());
            let compose = Compose::default();
            let layers = Layers {
                parts: &self.parts,
                evened: &self.evened,
                ..Layers::empty(&view, &window, &compose, &lights, &rules)
            };
            layers.evened_tone(0, [x as f32 + 0.5, y as f32 + 0.5])
        }
    }

    fn pixels(range: Range<u32>) -> impl Iterator<Item = (u32, u32)> {
        let columns = range.clone();
        range.flat_map(move |y| columns.clone().map(move |x| (x, y)))
    }

    /// Where the samples of a pixel are that the tone map is found at, in a picture of `samples`.
    fn sample_of(samples: u32, x: u32, y: u32) -> [f32; 2] {
        let offset = if samples == 1 { 0.0 } else { -0.25 };
        [x as f32 + 0.5 + offset, y as f32 + 0.5 + offset]
    }

    proptest! {
        /// A straight edge, however it lies, changes no pixel: its samples show it.
        #[test]
        fn straight_edges_are_left_to_the_samples(
            angle in 0f32..6.3, shift in -8f32..8.0, least in 2f32..6.0, samples in 1u32..3,
        ) {
            let normal = [math::cos(angle), math::sin(angle)];
            let middle = SIDE as f32 / 2.0;
            let ahead = |[x, y]: [f32; 2]| (x - middle) * normal[0] + (y - middle) * normal[1] - shift;
            let tone = |x, y| u32::from(ahead(sample_of(samples, x, y)) > 0.0);
            let toned = Toned::new(vec![part(least)], false, |x, y| word(0, tone(x, y)));
            for (x, y) in pixels(12..28) {
                let away = ahead(sample_of(samples, x, y));
                prop_assert!(!toned.is_changed(x, y) || away.abs() < 0.3, "{x} {y} is changed");
                match toned.shown(x, y) {
                    Some(shown) if away.abs() > 1.5 => prop_assert_eq!(shown, tone(x, y) as f32),
                    None => prop_assert!(away.abs() < 2.5, "{x} {y} is left to samples"),
                    Some(_) => {}
                }
            }
        }

        /// Narrow strips are gone, wide ones are whole, whichever of two tones they have.
        #[test]
        fn strips_show_if_they_are_wide_enough(
            angle in 0f32..6.3, shift in -6f32..6.0, least in 2f32..5.0, is_dark: bool,
        ) {
            let normal = [math::cos(angle), math::sin(angle)];
            let middle = SIDE as f32 / 2.0;
            let away = |[x, y]: [f32; 2]| ((x - middle) * normal[0] + (y - middle) * normal[1] - shift).abs();
            for (width, is_left) in [(least - 1.2, false), (least + 1.2, true)] {
                let is_strip = |at| away(at) < width / 2.0;
                let tone = |x, y| u32::from(is_strip(sample_of(1, x, y)) != is_dark);
                let toned = Toned::new(vec![part(least)], false, |x, y| word(0, tone(x, y)));
                let ground = f32::from(u8::from(is_dark));
                for (x, y) in pixels(12..28) {
                    let strip = (toned.tone(x, y) - ground).abs();
                    let on_spine = away(sample_of(1, x, y)) < 0.3;
                    if is_left {
                        prop_assert!(!on_spine || strip > 0.5, "{width} of {least}: {x} {y} lost {strip}");
                    } else {
                        prop_assert!(strip < 0.5, "{width} of {least}: {x} {y} kept {strip}");
                    }
                }
            }
        }

        /// So they are along the border of their part: what lies behind it makes no room for slivers.
        #[test]
        fn strips_along_borders_show_if_they_are_wide_enough(
            angle in 0f32..6.3, shift in -6f32..6.0, least in 2f32..5.0, is_dark: bool,
        ) {
            let normal = [math::cos(angle), math::sin(angle)];
            let middle = SIDE as f32 / 2.0;
            let inside = |x, y| {
                let [x, y] = sample_of(1, x, y);
                (x - middle) * normal[0] + (y - middle) * normal[1] - shift
            };
            for (width, is_left) in [(least - 1.2, false), (least + 1.2, true)] {
                let tone = |x, y| u32::from((inside(x, y) < width) != is_dark);
                let part_of = |x, y| u32::from(inside(x, y) < 0.0);
                let parts = vec![part(least), part(least)];
                let toned = Toned::new(parts, false, |x, y| word(part_of(x, y), tone(x, y)));
                let ground = f32::from(u8::from(is_dark));
                for (x, y) in pixels(12..28).filter(|(x, y)| part_of(*x, *y) == 0) {
                    let strip = (toned.tone(x, y) - ground).abs();
                    if !is_left {
                        prop_assert!(strip < 0.5, "{width} of {least}: {x} {y} kept {strip}");
                    } else if (inside(x, y) - width / 2.0).abs() < 0.3 {
                        prop_assert!(strip > 0.5, "{width} of {least}: {x} {y} lost {strip}");
                    }
                }
            }
        }

        /// Where all around have passed the same steps, light and ink are those that the ramp and the ink have there.
        #[test]
        fn steps_are_those_of_the_ramp_and_of_the_ink(
            x in 0f32..1.0, dark_at in 0f32..0.9, gray in -0.2f32..0.4, threshold in 0.2f32..0.8,
        ) {
            let inked = Part {
                flags: Part::INK,
                dark_at,
                light_at: dark_at + gray,
                threshold,
                ..part(2.0)
            };
            let steps = steps_passed(&inked, x);
            let toned = Toned::new(vec![inked], true, |_, _| word(0, steps));
            let shown = toned.evened(20, 20).expect("one tone");
            let is_dark = tone_value(0.5, shade_level(x, dark_at, inked.light_at)) < threshold;
            prop_assert_eq!(shown.ink, Some(f32::from(u8::from(is_dark))));
            let passed = inked.ramp[1..].iter().filter(|stop| stop[3] <= x).count();
            prop_assert_eq!(shown.light[0], inked.ramp[passed][0]);
        }

        /// A part of ink and paper keeps no sliver of either.
        #[test]
        fn slivers_of_ink_and_of_paper_are_gone(angle in 0f32..6.3, least in 2f32..5.0, is_ink: bool) {
            let mut inked = part(least);
            inked.ramp[1..].fill([0.0, 0.0, 0.0, Level::UNUSED]);
            (inked.flags, inked.dark_at, inked.light_at, inked.threshold) = (Part::INK, 0.4, 0.4, 0.5);
            prop_assert!(has_steps(&inked));
            let normal = [math::cos(angle), math::sin(angle)];
            let middle = SIDE as f32 / 2.0;
            let is_strip = |[x, y]: [f32; 2]| {
                ((x - middle) * normal[0] + (y - middle) * normal[1]).abs() < least / 2.0 - 0.6
            };
            let toned = Toned::new(vec![inked], false, |x, y| {
                word(0, u32::from(is_strip(sample_of(1, x, y)) != is_ink))
            });
            for (x, y) in pixels(12..28) {
                let ink = toned.evened(x, y).and_then(|tone| tone.ink).expect("ink is evened");
                prop_assert!((ink < 0.5) == is_ink, "{x} {y}: {ink}");
            }
        }

        /// What a pixel has is a tone of its part, hangs on no other part, and is found with and without flags alike.
        #[test]
        fn tones_of_other_parts_do_not_matter(
            words in prop::collection::vec((0u32..3, 0u32..3), 25), other in 0u32..3,
        ) {
            let cell = |x: u32, y: u32| words[((y / 8) * 5 + x / 8) as usize];
            let of = |other_tone: Option<u32>, flags_all| {
                let parts = vec![part(2.5), part(2.5)];
                Toned::new(parts, flags_all, |x, y| match cell(x, y) {
                    (0, _) => 0,
                    (1, tone) => word(0, tone),
                    (_, tone) => word(1, other_tone.unwrap_or(tone)),
                })
            };
            let (first, second, walked) = (of(None, false), of(Some(other), false), of(None, true));
            for (x, y) in pixels(0..SIDE).filter(|(x, y)| cell(*x, *y).0 == 1) {
                let tone = first.tone(x, y);
                prop_assert!((0.0..=2.0).contains(&tone));
                prop_assert_eq!(tone, second.tone(x, y));
                prop_assert_eq!(tone, walked.tone(x, y));
                let mut near = pixels(0..SIDE).filter(|(u, v)| u.abs_diff(x) <= 5 && v.abs_diff(y) <= 5);
                let own = cell(x, y).1;
                if near.all(|(u, v)| cell(u, v).0 != 1 || cell(u, v).1 == own) {
                    prop_assert_eq!(tone, own as f32);
                    prop_assert_eq!(first.shown(x, y), Some(own as f32));
                }
            }
        }
    }

    #[test]
    fn parts_without_hard_steps_keep_their_tones() {
        let steps = part(2.0);
        assert!(has_steps(&steps));
        let soft = Part {
            softness: 0.1,
            ..steps
        };
        let flat = Part {
            flags: Part::UNLIT,
            ..steps
        };
        let mut even = steps;
        even.ramp[1][3] = Level::UNUSED;
        for other in [soft, flat, even] {
            assert!(!has_steps(&other));
        }
        assert_eq!(reach_px(0.0), 0.0);
        assert_eq!(reach_px(1e9), REACH_PX_MAX);
    }
}
