//! What files of tracings are written from: paths that are drawn when their turn comes, so that few are held as text.

use super::nest::NONE;
use super::pen::{Pen, TextPen};
use super::{Bitmap, Found, Outliner, TraceFormat, TraceOptions, Tracing, found};
use rayon::prelude::*;
use std::borrow::Borrow;
use std::io;

/// Steps of loops that are drawn while others are still looked for; of more, the text would take too much memory.
pub(super) const EARLY_STEPS: usize = 1 << 21;

/// Steps of loops drawn later, on all threads, before they are written.
const WINDOW_STEPS: usize = 1 << 18;

/// Most loops of a window.
const WINDOW_LOOPS: usize = 1 << 16;

/// Loops that a thread takes at once.
const PIECE_LOOPS: usize = 64;

/// What is known of a path besides its curve.
pub(super) struct PathHead {
    pub is_ink: bool,
    pub area: u64,
    pub parent: Option<u32>,
}

/// Paths in order, each after those around it.
pub(super) trait Paths: Sync {
    fn count(&self) -> usize;

    fn head(&self, number: usize) -> PathHead;

    /// How long it takes to draw one, in steps.
    fn work(&self, number: usize) -> usize;

    fn draw(&self, number: usize, outliner: &mut Outliner, pen: &mut TextPen);

    /// The text of one that is there already.
    fn drawn(&self, _number: usize) -> Option<&str> {
        None
    }
}

impl Paths for Tracing {
    fn count(&self) -> usize {
        self.paths.len()
    }

    fn head(&self, number: usize) -> PathHead {
        let path = &self.paths[number];
        PathHead {
            is_ink: path.is_ink,
            area: path.area,
            parent: path.parent,
        }
    }

    fn work(&self, number: usize) -> usize {
        self.paths[number].segments.len()
    }

    fn draw(&self, number: usize, _: &mut Outliner, pen: &mut TextPen) {
        let segments = &self.paths[number].segments;
        let Some(last) = segments.last() else {
            return;
        };
        pen.begin(last.end());
        segments.iter().for_each(|segment| pen.draw(*segment));
        pen.end();
    }
}

/// The paths of a bitmap, some of them drawn.
pub(super) struct Outlines {
    found: Found,
    /// Text of the first loops, by the number of the first of each batch.
    early: Vec<(usize, Texts)>,
}

impl Outlines {
    /// Finds the paths of a bitmap, and draws the first of them, of so many steps.
    pub fn of(
        bitmap: impl Borrow<Bitmap> + Send,
        options: &TraceOptions,
        format: TraceFormat,
        early_steps: usize,
    ) -> Self {
        let height = f64::from(bitmap.borrow().height());
        let (found, early) = found(bitmap, options, early_steps, |outliner, batch| {
            let mut texts = Texts::new(TextPen::new(format, height), batch.len());
            // About as much as most take, so that it need not grow.
            texts.pen.reserve(batch.step_count());
            for pixels in batch.iter() {
                outliner.outline(&pixels, &mut texts.pen);
                texts.end();
            }
            texts.finished()
        });
        Self { found, early }
    }

    /// Steps of all paths.
    pub fn step_count(&self) -> usize {
        self.found.loops.step_count()
    }
}

impl Paths for Outlines {
    fn count(&self) -> usize {
        self.found.loops.len()
    }

    fn head(&self, number: usize) -> PathHead {
        let pixels = self.found.loops.get(number);
        let parent = self.found.parents.get(number).copied();
        PathHead {
            is_ink: pixels.is_some_and(|pixels| pixels.is_ink),
            area: pixels.map_or(0, |pixels| pixels.area),
            parent: parent.filter(|parent| *parent != NONE),
        }
    }

    fn work(&self, number: usize) -> usize {
        self.found
            .loops
            .get(number)
            .map_or(0, |pixels| pixels.steps.len())
    }

    fn draw(&self, number: usize, outliner: &mut Outliner, pen: &mut TextPen) {
        if let Some(pixels) = self.found.loops.get(number) {
            outliner.outline(&pixels, pen);
        }
    }

    fn drawn(&self, number: usize) -> Option<&str> {
        let after = self.early.partition_point(|(first, _)| *first <= number);
        let (first, texts) = self.early.get(after.checked_sub(1)?)?;
        texts.get(number - first)
    }
}

/// Texts of consecutive curves.
pub(super) struct Texts {
    pen: TextPen,
    /// Where each ends.
    ends: Vec<usize>,
}

impl Texts {
    fn new(pen: TextPen, count: usize) -> Self {
        let ends = Vec::with_capacity(count);
        Self { pen, ends }
    }

    fn end(&mut self) {
        self.ends.push(self.pen.text().len());
    }

    /// Without spare room.
    fn finished(mut self) -> Self {
        self.pen.shrink();
        self.ends.shrink_to_fit();
        self
    }

    fn get(&self, index: usize) -> Option<&str> {
        let end = *self.ends.get(index)?;
        let start = index.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.pen.text().get(start..end)
    }
}

/// Gives the text of every path of an order, one after the other; what is not drawn yet is drawn on all threads,
/// window by window.
pub(super) fn for_each_text(
    paths: &impl Paths,
    pen: impl Fn() -> TextPen + Sync,
    options: &TraceOptions,
    order: impl Iterator<Item = usize>,
    mut write: impl FnMut(usize, &str) -> io::Result<()>,
) -> io::Result<()> {
    let mut order = order.peekable();
    let mut window = Vec::new();
    let mut late = Vec::new();
    while order.peek().is_some() {
        window.clear();
        late.clear();
        let mut steps = 0;
        while steps < WINDOW_STEPS && window.len() < WINDOW_LOOPS {
            let Some(number) = order.next() else {
                break;
            };
            window.push(number);
            if paths.drawn(number).is_none() {
                late.push(number);
                steps += paths.work(number);
            }
        }
        let pieces = late.par_chunks(PIECE_LOOPS).map_init(
            || Outliner::new(options),
            |outliner, numbers| {
                let mut texts = Texts::new(pen(), numbers.len());
                for number in numbers {
                    paths.draw(*number, outliner, &mut texts.pen);
                    texts.end();
                }
                texts
            },
        );
        // Without work the other threads need not wake up.
        let pieces: Vec<Texts> = if late.is_empty() {
            Vec::new()
        } else {
            pieces.collect()
        };
        let mut drawn_late = pieces
            .iter()
            .flat_map(|texts| (0..texts.ends.len()).filter_map(|index| texts.get(index)));
        for number in &window {
            let text = paths.drawn(*number).or_else(|| drawn_late.next());
            write(*number, text.unwrap_or_default())?;
        }
    }
    Ok(())
}

/// Every outline of ink by its number, each followed by its holes.
pub(super) fn shapes(paths: &impl Paths) -> Vec<u32> {
    let count = paths.count();
    let shape_of = |number: usize| {
        let head = paths.head(number);
        let around = head.parent.map(|parent| parent as usize);
        if head.is_ink { Some(number) } else { around }
    };
    // Sort by shape, counting.
    let mut places = vec![0u32; count + 1];
    for shape in (0..count).filter_map(shape_of) {
        places[shape + 1] += 1;
    }
    for index in 0..count {
        places[index + 1] += places[index];
    }
    let total = places.last().copied().unwrap_or(0);
    let mut order = vec![0; total as usize];
    for number in 0..count {
        if let Some(shape) = shape_of(number) {
            order[places[shape] as usize] = number as u32;
            places[shape] += 1;
        }
    }
    order
}
