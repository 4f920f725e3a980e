//! The outlines of a view in a grid over the picture, and where they cross a piece.

use super::{Changes, Cut, MARGIN, Piece, PieceImage, Seen};
use npr_core::budget::{Budget, OverBudget};
use rayon::prelude::*;

/// Outlines that a thread sorts at once.
const CHUNK: usize = 512;

/// Distance in pixels within which an outline passes through an end of a piece.
pub(super) const NEAR_PX: f64 = 1e-3;

/// Sine of the angle below which images are too nearly parallel to tell on which side of one the other goes on.
const LEAST_SINE: f64 = 1e-7;

/// Number of outlines in the cells that a piece's image passes, above which the piece is crowded.
///
/// A crowded piece is tested face by face: testing every crossing with an outline would take the square of their
/// number. Lines of usual models pass some dozens of outlines, the longest some hundreds.
pub const CROWD: usize = 512;

/// A piece of line at which something can begin or end hiding others; no more of it than crossings need, as views go
/// through all of them at random, and each fills one line of the cache.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub struct Outline {
    /// Where it lies.
    pub image: PieceImage,
    /// The mesh edge that it lies on.
    pub edge: u32,
    /// The vertices of the edge.
    pub ends: [u32; 2],
}

/// The outlines of a view that can hide something, in a grid over the picture.
#[derive(Debug)]
pub struct OutlineGrid {
    outlines: Vec<Outline>,
    cell_px: f64,
    origin: [f64; 2],
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

/// An outline in a cell of the picture.
#[derive(Debug, Clone, Copy, Default)]
struct Entry {
    /// A box around its image.
    bounds: Bounds,
    outline: u32,
}

/// A box of the picture around the image of a piece, wider by a little more than [`NEAR_PX`].
#[derive(Debug, Clone, Copy, Default)]
struct Bounds {
    low: [f32; 2],
    high: [f32; 2],
}

impl Bounds {
    fn of(image: &PieceImage) -> Self {
        let [a, b] = image.place.map(|place| place.map(|v| v as f32));
        // Single precision is coarser than that in large pictures.
        let pad = |v: f32| 2.0 * NEAR_PX as f32 + v.abs() * f32::EPSILON;
        let [x, y] = [0, 1].map(|i| [a[i].min(b[i]), a[i].max(b[i])]);
        let [low, high] = [0, 1].map(|i| [x[i], y[i]]);
        Self {
            low: low.map(|v| v - pad(v)),
            high: high.map(|v| v + pad(v)),
        }
    }

    fn meets(&self, other: &Self) -> bool {
        let overlaps = |i: usize| self.low[i] <= other.high[i] && other.low[i] <= self.high[i];
        overlaps(0) & overlaps(1)
    }
}

impl OutlineGrid {
    /// Sorts outlines into cells; O(outlines + cells they touch).
    ///
    /// # Errors
    ///
    /// [`OverBudget`] where there is no memory for them.
    pub fn new(
        size: [u32; 2],
        outlines: Vec<Outline>,
        budget: &mut Budget,
    ) -> Result<Self, OverBudget> {
        let margin = MARGIN * f64::from(size[0].max(size[1])) + 1.0;
        let [width, height] = size.map(|side| f64::from(side) + 2.0 * margin);
        let total: f64 = outlines.iter().map(|outline| outline.image.length()).sum();
        // About one entry per outline and cell, whether outlines are many and short or few and long.
        let wanted = (width * height / (outlines.len() as f64 + 1.0)).sqrt();
        let cell_px = wanted
            .max(total / (outlines.len() as f64 + 1.0) * 0.5)
            .clamp(2.0, 256.0);
        let mut grid = Self {
            outlines,
            cell_px,
            origin: [-margin; 2],
            columns: (width / cell_px).ceil() as usize,
            rows: (height / cell_px).ceil() as usize,
            starts: Vec::new(),
            entries: Vec::new(),
        };
        grid.fill(budget)?;
        Ok(grid)
    }

    fn fill(&mut self, budget: &mut Budget) -> Result<(), OverBudget> {
        // Pay for them.
        let chunks = || self.outlines.par_chunks(CHUNK).enumerate();
        let visit = |chunk: &[Outline], visit: &mut dyn FnMut(usize, usize)| {
            for (index, outline) in chunk.iter().enumerate() {
                self.cells_of(&outline.image, |cell| visit(index, cell));
            }
        };
        let count_of = |(_, chunk): (usize, &[Outline])| {
            let mut count = 0;
            visit(chunk, &mut |_, _| count += 1);
            count
        };
        let count: usize = chunks().map(count_of).sum();
        let bytes = size_of::<Entry>() + size_of::<[u32; 2]>();
        budget.take("outlines in the picture", count, bytes)?;

        // Find the cells of every outline.
        let found: Vec<Vec<[u32; 2]>> = chunks()
            .map(|(number, chunk)| {
                let mut found = Vec::with_capacity(2 * chunk.len());
                let first = number * CHUNK;
                visit(chunk, &mut |index, cell| {
                    found.push([cell as u32, (first + index) as u32])
                });
                found
            })
            .collect();

        // List them, cell after cell.
        let mut starts = vec![0_u32; self.columns * self.rows + 1];
        for [cell, _] in found.iter().flatten() {
            starts[*cell as usize + 1] += 1;
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut entries = vec![Entry::default(); count];
        let mut cursor = starts.clone();
        for [cell, outline] in found.iter().flatten() {
            let next = &mut cursor[*cell as usize];
            entries[*next as usize] = Entry {
                bounds: Bounds::of(&self.outlines[*outline as usize].image),
                outline: *outline,
            };
            *next += 1;
        }
        (self.starts, self.entries) = (starts, entries);
        Ok(())
    }

    /// Whether the cells that a piece's image passes hold more than [`CROWD`] outlines. O(cells).
    pub fn is_crowded(&self, piece: &Piece) -> bool {
        self.count_along(piece) > CROWD
    }

    /// Number of outlines in the cells that a piece's image passes; those in several cells count in each. O(cells).
    pub(crate) fn count_along(&self, piece: &Piece) -> usize {
        let mut count = 0_usize;
        self.cells_of(&piece.image(), |cell| {
            count += (self.starts[cell + 1] - self.starts[cell]) as usize;
        });
        count
    }

    /// Visits the cells that an image passes, row by row.
    fn cells_of(&self, image: &PieceImage, mut visit: impl FnMut(usize)) {
        let [a, b] = image
            .place
            .map(|p| [0, 1].map(|i| (p[i] - self.origin[i]) / self.cell_px));
        let (top, bottom) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let index = |v: f64, count: usize| (v.max(0.0) as usize).min(count - 1);
        // What passes an end closely shares a cell with it, and a rounding error must not lose one.
        let pad = NEAR_PX / self.cell_px;
        let (first, last) = (
            index(top[1] - pad, self.rows),
            index(bottom[1] + pad, self.rows),
        );
        let slope = (bottom[0] - top[0]) / (bottom[1] - top[1]).max(1e-300);
        for row in first..=last {
            let at = |y: f64| top[0] + slope * (y.clamp(top[1], bottom[1]) - top[1]);
            let (p, q) = if first == last {
                (top[0], bottom[0])
            } else {
                (at(row as f64), at(row as f64 + 1.0))
            };
            let from = index(p.min(q) - pad, self.columns);
            let to = index(p.max(q) + pad, self.columns);
            for column in from..=to {
                visit(row * self.columns + column);
            }
        }
    }

    /// Adds where an outline in front of a piece crosses its image, and notes where one passes through an end of it.
    ///
    /// Outlines from the vertices of the piece do not count: they meet it there alone.
    pub(super) fn add_crossings(
        &self,
        seen: &Seen<'_>,
        piece: &Piece,
        ends: Option<[u32; 2]>,
        changes: &mut Changes,
    ) {
        let image = piece.image();
        let bounds = Bounds::of(&image);
        let reach = NEAR_PX / piece.length().max(NEAR_PX);
        let is_own = |outline: &Outline| {
            ends.is_some_and(|ends| outline.ends.iter().any(|end| ends.contains(end)))
        };
        self.cells_of(&image, |cell| {
            let [from, to] = [cell, cell + 1].map(|c| self.starts[c] as usize);
            for entry in &self.entries[from..to] {
                // Find where the outline crosses the piece or passes an end.
                if !entry.bounds.meets(&bounds) {
                    continue;
                }
                let outline = &self.outlines[entry.outline as usize];
                if is_own(outline) {
                    continue;
                }
                let Some(([own, other], area)) = crossing(&image, &outline.image, reach) else {
                    continue;
                };
                let cuts = own > 1e-9 && own < 1.0 - 1e-9 && (-1e-9..=1.0 + 1e-9).contains(&other);
                let is_near = [own.abs() < reach, (1.0 - own).abs() < reach];
                let length = outline.image.length().max(NEAR_PX);
                let reach = NEAR_PX / length;
                if !(-reach..=1.0 + reach).contains(&other) {
                    continue;
                }

                // Leave out what lies behind the piece.
                let behind = image.coordinate_at(seen.projector, own);
                let front = outline.image.coordinate_at(seen.projector, other);
                let touch = behind.abs() * 1e-6;
                if front > behind + touch {
                    continue;
                }
                changes.is_plain[0] &= !is_near[0];
                changes.is_plain[1] &= !is_near[1];
                if cuts {
                    let is_clear = front < behind - touch
                        && (reach..=1.0 - reach).contains(&other)
                        && area.abs() > LEAST_SINE * piece.length() * length;
                    let change = is_clear
                        .then(|| seen.change_across(piece, outline))
                        .flatten();
                    changes.cuts.push(Cut {
                        at: own,
                        change,
                        outline: Some(entry.outline),
                    });
                }
            }
        });
    }
}

/// Where the lines through two images cross, as shares of both, with the area of the parallelogram between them; none
/// where they are parallel, or cross farther than `reach` beyond the ends of the first.
fn crossing(image: &PieceImage, other: &PieceImage, reach: f64) -> Option<([f64; 2], f64)> {
    let ([a, b], [c, d]) = (image.place, other.place);
    let along = [b[0] - a[0], b[1] - a[1]];
    let across = [d[0] - c[0], d[1] - c[1]];
    let between = [c[0] - a[0], c[1] - a[1]];
    let area = along[0] * across[1] - along[1] * across[0];
    let own = (between[0] * across[1] - between[1] * across[0]) / area;
    if area == 0.0 || own <= -reach || own >= 1.0 + reach {
        return None;
    }
    let theirs = (between[0] * along[1] - between[1] * along[0]) / area;
    Some(([own, theirs], area))
}
