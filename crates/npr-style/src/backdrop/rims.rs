//! Where subjects end in a picture, and what lies on both sides: the twins of `backdrop.flag_tiles` and
//! `backdrop.find_rims`.

use super::rule::{Rule, Rules};
use bytemuck::{Pod, Zeroable};
use npr_core::color::{pack_rgba8, unpack_rgba8};
use npr_core::geometry::{Part, Triangle};
use npr_core::gpu_layout;
use npr_core::raster::{HULL_BIT, ID_MASK};
use npr_core::window::Window;
use rayon::prelude::*;

/// Side of the square tiles in which borders are looked for, in output pixels.
pub const TILE: u32 = 4;

/// Tiles around a border's tile that it marks too: a rim's neighbours may lie in the next tile, and theirs one farther.
const TILE_RIM: u32 = 2;

/// The subject that a part belongs to, and the rule by which its lines adapt to the background.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct PartSubject {
    /// Number of its subject, from 1; 0 where it belongs to the background.
    pub subject: u32,
    /// Number of its rule in [`Rules`]; 0 where its lines keep their colour.
    pub rule: u32,
}
gpu_layout!(PartSubject { subject, rule });

/// An output pixel at the border of a subject, with the colours of both sides.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Rim {
    /// Mean colour of the subject, sRGB bytes; the highest byte is the weight of the rule here.
    pub rim: u32,
    /// Mean colour of what lies behind, sRGB bytes; the highest byte is the number of the rule.
    pub behind: u32,
    /// The subject, with the bits [`Rim::OUTSIDE`] and [`Rim::WITHIN`]; 0 where there is no border.
    pub subject: u32,
    /// The part of the subject that ends here.
    pub part: u32,
}
gpu_layout!(Rim {
    rim,
    behind,
    subject,
    part
});

impl Rim {
    /// Bit: the pixel itself does not lie on the subject.
    pub const OUTSIDE: u32 = 1 << 31;
    /// Bit: the line lies within the subject, not at its border.
    pub const WITHIN: u32 = 1 << 30;
    /// Mask of the bits that tell subjects apart, and borders from lines within.
    pub const WHOSE: u32 = !Self::OUTSIDE;
}

/// A frame in which borders are looked for.
#[derive(Debug, Clone, Copy)]
pub struct Scenery<'a> {
    /// The pixel grid of the output.
    pub window: &'a Window,
    /// The rules.
    pub rules: &'a Rules,
    /// Triangle numbers without hulls, [`Rules::samples`] times the output's size each way.
    pub ids: &'a [u32],
    /// Triangles.
    pub triangles: &'a [Triangle],
    /// A part subject for every part.
    pub part_subjects: &'a [PartSubject],
}

/// The subject and part that one pixel shows, where all of its samples agree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Shown {
    subject: u32,
    part: u32,
}

/// Subject of a mixed pixel, whose samples show several.
const MIXED: u32 = u32::MAX;

/// White for every tile near a border between two subjects, as wide as [`tiles_across`]; 0 for all others.
///
/// O(samples), parallel over rows of tiles.
pub fn flag_tiles(scenery: &Scenery<'_>, busy: &mut [u32]) {
    let across = tiles_across(scenery.window.size) as usize;
    busy.par_chunks_mut(across)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, tile) in row.iter_mut().enumerate() {
                let is_busy = scenery.rules.within != 0 || scenery.is_busy([x as u32, y as u32]);
                *tile = if is_busy { u32::MAX } else { 0 };
            }
        });
}

/// Tiles in a row over an output of this size.
pub fn tiles_across(size: [u32; 2]) -> u32 {
    size[0].div_ceil(TILE)
}

impl Scenery<'_> {
    fn is_busy(&self, tile: [u32; 2]) -> bool {
        // Take the samples of the tile and of its surroundings.
        let samples = self.rules.samples;
        let low = tile.map(|at| (at * TILE).saturating_sub(TILE_RIM) * samples);
        let high: [u32; 2] = std::array::from_fn(|i| {
            ((tile[i] + 1) * TILE + TILE_RIM).min(self.window.size[i]) * samples
        });
        let width = self.window.size[0] * samples;

        // Look for a sample of another subject; rows of one triangle need no look at each.
        let first = self.ids[(low[1] * width + low[0]) as usize];
        let subject = self.part_subject_of(first).subject;
        let mut last = first;
        for y in low[1]..high[1] {
            let row = &self.ids[(y * width + low[0]) as usize..(y * width + high[0]) as usize];
            if are_all(row, last) {
                continue;
            }
            for id in row.iter().copied() {
                if id != last {
                    if self.part_subject_of(id).subject != subject {
                        return true;
                    }
                    last = id;
                }
            }
        }
        false
    }

    /// The part of a triangle number other than 0.
    fn part_of(&self, id: u32) -> u32 {
        self.triangles[((id & ID_MASK) - 1) as usize].part
    }

    fn part_subject_of(&self, id: u32) -> PartSubject {
        if id == 0 {
            return PartSubject::default();
        }
        self.part_subjects[self.part_of(id) as usize]
    }

    /// Whether all samples of the pixels from `low` to `high`, both included, show the same number.
    fn is_one(&self, low: [u32; 2], high: [u32; 2]) -> bool {
        let samples = self.rules.samples;
        let width = self.window.size[0] * samples;
        let first = self.first_id(low[0], low[1]);
        (low[1] * samples..(high[1] + 1) * samples).all(|y| {
            let row = y * width;
            let columns = row + low[0] * samples..row + (high[0] + 1) * samples;
            are_all(
                &self.ids[columns.start as usize..columns.end as usize],
                first,
            )
        })
    }

    /// The number in the first sample of a pixel.
    fn first_id(&self, x: u32, y: u32) -> u32 {
        let samples = self.rules.samples;
        self.ids[(y * samples * self.window.size[0] * samples + x * samples) as usize]
    }

    /// Subject and part that a pixel shows; the subject is [`MIXED`] where its samples disagree.
    fn shown(&self, x: u32, y: u32) -> Shown {
        let samples = self.rules.samples;
        let width = self.window.size[0] * samples;
        let first = self.first_id(x, y);
        let mut shown = Shown {
            subject: self.part_subject_of(first).subject,
            part: if first == 0 { 0 } else { self.part_of(first) },
        };
        for i in 1..samples * samples {
            let at = (y * samples + i / samples) * width + x * samples + i % samples;
            let id = self.ids[at as usize];
            if id != first && self.part_subject_of(id).subject != shown.subject {
                shown.subject = MIXED;
            }
        }
        shown
    }
}

/// Whether all numbers equal `one`, without a branch for each.
fn are_all(ids: &[u32], one: u32) -> bool {
    ids.iter().fold(0, |bits, id| bits | (id ^ one)) == 0
}

/// The pictures on which rims are found.
#[derive(Debug, Clone, Copy)]
pub struct Search<'a> {
    /// The frame.
    pub scenery: Scenery<'a>,
    /// Reversed depths of the same samples.
    pub depths: &'a [u32],
    /// Tiles near borders, from [`flag_tiles`].
    pub busy: &'a [u32],
    /// The picture without lines, sRGB bytes with straight alpha; only tiles in `busy` hold it.
    pub bare: &'a [u32],
    /// Parts.
    pub parts: &'a [Part],
    /// Triangle numbers with hulls.
    pub drawn_ids: &'a [u32],
    /// Ribbons; only read if lines within subjects adapt to the background.
    pub ribbons: &'a [u32],
    /// Overlay; only read in the same case.
    pub overlay: &'a [u32],
}

/// Sums of the colours of some pixels; alpha counts them.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    color: [f32; 4],
    count: f32,
}

impl Sum {
    fn add(&mut self, texel: u32) {
        let [r, g, b, a] = unpack_rgba8(texel);
        let sum = self.color;
        self.color = [sum[0] + r * a, sum[1] + g * a, sum[2] + b * a, sum[3] + a];
        self.count += 1.0;
    }

    /// The mean colour and the mean alpha.
    fn mean(&self) -> [f32; 4] {
        let weight = self.color[3].max(1e-6);
        [
            self.color[0] / weight,
            self.color[1] / weight,
            self.color[2] / weight,
            self.color[3] / self.count.max(1.0),
        ]
    }
}

/// Finds a rim for every pixel whose 3 x 3 neighbourhood holds the border of a subject; all others get an empty one.
///
/// The subject nearest to the eye owns the border. Only pixels whose samples all agree count for a side, so colours are
/// never blends of both: what lies behind a mixed pixel is the mean of its neighbours behind the subject, and without
/// any it has no rim. In the published method, a pixel outside of the subject is compared by its own colour. O(pixels
/// of busy tiles), parallel over rows of tiles.
pub fn find_rims(search: &Search<'_>, rims: &mut [Rim]) {
    let width = search.scenery.window.size[0] as usize;
    let across = tiles_across(search.scenery.window.size) as usize;
    rims.par_chunks_mut(width * TILE as usize)
        .zip(search.busy.par_chunks(across))
        .enumerate()
        .for_each(|(row, (band, busy))| {
            band.fill(Rim::default());
            for (column, _) in busy.iter().enumerate().filter(|(_, busy)| **busy != 0) {
                search.find_in_tile([column as u32, row as u32], band);
            }
        });
}

/// The subjects and parts that the pixels in and around a tile show.
struct Near {
    /// The first of these pixels.
    low: [u32; 2],
    shown: [[Shown; (TILE + 2) as usize]; (TILE + 2) as usize],
}

impl Near {
    fn at(&self, x: u32, y: u32) -> Shown {
        self.shown[(y - self.low[1]) as usize][(x - self.low[0]) as usize]
    }
}

impl Search<'_> {
    /// Finds the rims of one tile; `band` holds the rows of its row of tiles.
    fn find_in_tile(&self, tile: [u32; 2], band: &mut [Rim]) {
        let scenery = &self.scenery;
        let size = scenery.window.size;
        let first = tile.map(|at| at * TILE);
        let end: [u32; 2] = std::array::from_fn(|i| (first[i] + TILE).min(size[i]));
        let low = first.map(|at| at.saturating_sub(1));
        let high: [u32; 2] = std::array::from_fn(|i| end[i].min(size[i] - 1));
        // Where all is one triangle there is no border.
        if scenery.rules.within == 0 && scenery.is_one(low, high) {
            return;
        }
        let mut near = Near {
            low,
            shown: Default::default(),
        };
        for y in low[1]..=high[1] {
            for x in low[0]..=high[0] {
                near.shown[(y - low[1]) as usize][(x - low[0]) as usize] = scenery.shown(x, y);
            }
        }
        for y in first[1]..end[1] {
            for x in first[0]..end[0] {
                band[((y - first[1]) * size[0] + x) as usize] = self.rim_at(&near, x, y);
            }
        }
    }

    fn rim_at(&self, near: &Near, x: u32, y: u32) -> Rim {
        // Leave out pixels around which nothing changes.
        let scenery = &self.scenery;
        let size = scenery.window.size;
        let (low, high) = around(size, x, y);
        let here = near.at(x, y).subject;
        let pixels =
            || (low[1]..=high[1]).flat_map(move |y| (low[0]..=high[0]).map(move |x| (x, y)));
        if scenery.rules.within == 0 && pixels().all(|(x, y)| near.at(x, y).subject == here) {
            return Rim::default();
        }

        // Give the border to the subject nearest to the eye.
        let owner = self.owner(near, pixels());
        if owner == 0 {
            return Rim::default();
        }

        // Sum the colours on both sides; mixed pixels count for neither.
        let (mut rim, mut behind) = (Sum::default(), Sum::default());
        let (mut part, mut rule, mut ruled_count) = (0, 0, 0.0);
        for (x, y) in pixels() {
            let shown = near.at(x, y);
            let texel = self.bare[(y * size[0] + x) as usize];
            if shown.subject == owner {
                if rim.count == 0.0 {
                    part = shown.part;
                }
                rim.add(texel);
                let own = scenery.part_subjects[shown.part as usize].rule;
                if own != 0 {
                    ruled_count += 1.0;
                    rule = own;
                }
            } else if shown.subject != MIXED {
                behind.add(texel);
            }
        }

        // For the published method, take what lies behind from this pixel alone.
        let outside = if here == owner { 0 } else { Rim::OUTSIDE };
        let is_behind = outside != 0 && here != MIXED;
        if scenery.rules.rules[rule as usize].method == Rule::BY_LIKENESS && is_behind {
            behind = Sum::default();
            behind.add(self.bare[(y * size[0] + x) as usize]);
        }

        // Look for a line within the subject where nothing lies behind.
        if behind.count == 0.0 {
            return self.inner_rim(x, y, &rim, [owner, part]);
        }
        let share = ruled_count / rim.count;
        packed(&rim, &behind, share, rule, [owner | outside, part])
    }

    /// The subject nearest to the eye among some pixels; 0 where there is none.
    fn owner(&self, near: &Near, pixels: impl Iterator<Item = (u32, u32)>) -> u32 {
        let samples = self.scenery.rules.samples;
        let width = self.scenery.window.size[0] * samples;
        let (mut owner, mut nearest) = (0, -1.0);
        for (x, y) in pixels {
            let subject = near.at(x, y).subject;
            if subject == 0 || subject == MIXED {
                continue;
            }
            let depth = f32::from_bits(self.depths[(y * samples * width + x * samples) as usize]);
            if depth > nearest {
                (owner, nearest) = (subject, depth);
            }
        }
        owner
    }

    /// The rim of a line within a subject, if such lines adapt to the background: both sides are the surface under the
    /// line.
    fn inner_rim(&self, x: u32, y: u32, sum: &Sum, [owner, part]: [u32; 2]) -> Rim {
        let rule = self.scenery.part_subjects[part as usize].rule;
        let rules = self.scenery.rules;
        let is_left_out = rule != 0 && rules.rules[rule as usize].within == 0;
        if rules.within == 0 || is_left_out || !self.is_inked(x, y, part) {
            return Rim::default();
        }
        let share = if rule == 0 { 0.0 } else { 1.0 };
        packed(sum, sum, share, rule, [owner | Rim::WITHIN, part])
    }

    /// Whether some line may cover a pixel.
    fn is_inked(&self, x: u32, y: u32, part: u32) -> bool {
        let element = (y * self.scenery.window.size[0] + x) as usize;
        let layers = self.scenery.rules.within;
        if layers & Rules::RIBBONS != 0 && self.ribbons[element] >> 24 != 0 {
            return true;
        }
        if layers & Rules::OVERLAY != 0 && self.overlay[element] >> 24 != 0 {
            return true;
        }
        if self.parts[part as usize].flags & Part::ANGLE != 0 {
            return true;
        }
        let samples = self.scenery.rules.samples;
        let width = self.scenery.window.size[0] * samples;
        (0..samples * samples).any(|i| {
            let at = (y * samples + i / samples) * width + x * samples + i % samples;
            self.drawn_ids[at as usize] & HULL_BIT != 0
        })
    }
}

/// The first and the last pixel of the 3 x 3 around one, within the picture; both included.
fn around(size: [u32; 2], x: u32, y: u32) -> ([u32; 2], [u32; 2]) {
    (
        [x.saturating_sub(1), y.saturating_sub(1)],
        [(x + 1).min(size[0] - 1), (y + 1).min(size[1] - 1)],
    )
}

/// A rim of these two sides; its rule weighs as much as `behind` is opaque.
fn packed(rim: &Sum, behind: &Sum, share: f32, rule: u32, [subject, part]: [u32; 2]) -> Rim {
    let (front, back) = (rim.mean(), behind.mean());
    Rim {
        rim: pack_rgba8([front[0], front[1], front[2], share * back[3]]),
        behind: pack_rgba8([back[0], back[1], back[2], 0.0]) | rule << 24,
        subject,
        part,
    }
}

/// Draws the lines of method `rim`: every pixel just outside of a subject gets the colour of the part that ends there.
///
/// Texels are sRGB bytes with coverage in alpha: the twin of `backdrop.draw_rims`. O(pixels).
pub fn draw_rims(parts: &[Part], rims: &[Rim], overlay: &mut [u32]) {
    overlay
        .par_iter_mut()
        .zip(rims)
        .for_each(|(texel, rim)| *texel = rim_texel(parts, rim));
}

fn rim_texel(parts: &[Part], rim: &Rim) -> u32 {
    if rim.subject & Rim::OUTSIDE == 0 {
        return 0;
    }
    let part = &parts[rim.part as usize];
    if part.flags & Part::LINES == 0 {
        return 0;
    }
    pack_rgba8(part.line_color)
}
