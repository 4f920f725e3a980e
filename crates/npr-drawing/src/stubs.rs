//! Stubs: short parts of lines from an end in the open, where no other line meets it, to the next line.
//!
//! A crease that barely reaches its angle shows on a few edges here and there, and the contour of a rough surface in
//! shreds. A draughtsman draws such a fold as a whole or not at all.

use crate::arc::Measured;
use crate::ends::{Meeting, Place, is_cut_off, meetings_at};
use npr_vector::stroke::Stroke;
use rayon::prelude::*;

/// How far from a line others meet it, in halves of its width.
const REACH: f64 = 1.0;

/// How far from a thin line they do, in pixels: ends that smoothing moves apart are within it, as at the corners that
/// lines are joined around.
const MEETS_PX: f64 = 4.5;

/// What meets a stroke within this way of its end, in pixels, holds the end.
const HELD_PX: f64 = 3.0;

/// What is left of a stroke that was cut goes, too, if it is shorter, in pixels: it would be a dash between two lines.
const LEAST_LEFT_PX: f64 = 9.0;

/// Widest gap between the ink of two lines that nobody sees, in pixels.
const UNSEEN_GAP_PX: f64 = 0.5;

/// Distance of the places of a stroke at which it is looked for others, in pixels.
const STEP_PX: f64 = 1.0;

/// Share of the least length below which a ring goes: a pen fills it, so it is a dot.
const RING_SHARE: f64 = 0.5;

/// Most rounds in which what met stubs alone is a stub too.
const ROUNDS_MOST: usize = 16;

/// Removes stubs from the visible open strokes that are shorter than the pixels that `least_px` gives for them, in a
/// picture of `size` pixels, and rings that are shorter than half of them. Strokes of 0 pixels stay.
///
/// A stub is the part of a line from an open end, which meets nothing, to the first other line that meets it, or all of
/// it where none does, if it is below those pixels. A line meets places within half its width, and within 4.5 pixels;
/// the border of the picture holds ends as lines do, and so does the paper around the drawing: no end is open beyond
/// which no line lies to one side of the picture, so outlines stay. Two strokes whose ends meet and that meet nothing
/// else there are one line, so a long fold in short strokes stays. A stroke below 9 pixels is only met by lines whose
/// ink touches its own, or it would stay as a dash between them. Stubs go in rounds, 16 at most: what met them alone
/// may be one then. O(points + pixels of short strokes + meetings), on all threads, with the same result for any
/// number of them.
pub fn remove_stubs(
    strokes: &mut Vec<Stroke>,
    size: [u32; 2],
    least_px: impl Fn(&Stroke) -> f64 + Sync,
) {
    // Remove rings that are dots.
    let is_dot = |stroke: &Stroke| {
        stroke.closed && stroke.is_visible() && stroke.length() < RING_SHARE * least_px(stroke)
    };
    strokes.retain(|stroke| !is_dot(stroke));

    // Choose what may go.
    let lengths: Vec<f64> = strokes.par_iter().map(Stroke::length).collect();
    let short = strokes.par_iter().zip(&lengths).map(|(stroke, length)| {
        let least_px = least_px(stroke);
        let may_go = *length < least_px && stroke.is_visible() && !stroke.closed;
        Short::new(may_go.then(|| Measured::new(stroke)).flatten()?, least_px)
    });
    let mut net = Net {
        lines: short.collect(),
    };
    if net.lines.iter().all(Option::is_none) {
        return;
    }
    net.find_meetings(strokes, size);

    // Let stubs go, until there are none.
    for _ in 0..ROUNDS_MOST {
        let stubs = net.stubs();
        if stubs.is_empty() {
            break;
        }
        net.cut(&stubs);
    }

    // Keep what is left of every stroke.
    let mut lines = net.lines.into_iter();
    strokes.retain_mut(|stroke| match lines.next().flatten() {
        Some(line) if line.is_gone() => false,
        Some(line) if line.is_cut() => {
            let [from, to] = line.range;
            let cut_px = [from, line.course.length() - to];
            stroke.part = stroke.part.map(|part| part.shortened(cut_px));
            stroke.points = line.course.part(from, to);
            true
        }
        _ => true,
    });
}

/// A short stroke, and what meets it.
struct Short {
    course: Measured,
    /// Length below which a part is a stub, in pixels.
    least_px: f64,
    /// What is left of it: pixels from its start. Nothing is left where they are equal.
    range: [f64; 2],
    /// Pixels from its start, and the stroke that meets it there, as long as that stays; ascending. Where the border of
    /// the picture or the paper around the drawing does, the stroke itself.
    met: Vec<(f64, usize)>,
}

impl Short {
    fn new(course: Measured, least_px: f64) -> Option<Self> {
        let range = [0.0, course.length()];
        (least_px > 0.0).then_some(Self {
            course,
            least_px,
            range,
            met: Vec::new(),
        })
    }

    fn is_gone(&self) -> bool {
        self.range[0] >= self.range[1]
    }

    fn is_cut(&self) -> bool {
        self.range != [0.0, self.course.length()]
    }

    /// What holds an end, each once.
    fn holders(&self, side: usize) -> Vec<usize> {
        let near = |(way, _): &&(f64, usize)| (way - self.range[side]).abs() <= HELD_PX;
        let mut holders: Vec<usize> = self
            .met
            .iter()
            .filter(near)
            .map(|(_, with)| *with)
            .collect();
        holders.sort_unstable();
        holders.dedup();
        holders
    }

    /// The first place from an end where something meets it that holds neither end.
    fn first_met(&self, side: usize) -> Option<f64> {
        let [from, to] = [self.range[0] + HELD_PX, self.range[1] - HELD_PX];
        let mut inside = self
            .met
            .iter()
            .map(|(way, _)| *way)
            .filter(|way| *way > from && *way < to);
        match side {
            0 => inside.next(),
            _ => inside.next_back(),
        }
    }
}

/// How far the visible lines of a picture reach, in every row and every column of pixels.
struct Reaches {
    /// Of every row the least and the greatest x, then of every column the least and the greatest y.
    of: [Vec<[f64; 2]>; 2],
}

impl Reaches {
    fn new(strokes: &[Stroke], size: [u32; 2]) -> Self {
        let none = |count: u32| vec![[f64::INFINITY, f64::NEG_INFINITY]; count as usize];
        let mut of = [none(size[1]), none(size[0])];
        for stroke in strokes.iter().filter(|stroke| stroke.is_visible()) {
            let steps = Measured::new(stroke).map(|course| course.in_steps(STEP_PX));
            for [x, y] in steps.into_iter().flatten().map(|(_, point)| point.position) {
                for (all, [across, along]) in of.iter_mut().zip([[y, x], [x, y]]) {
                    if across >= 0.0
                        && let Some([least, most]) = all.get_mut(across as usize)
                    {
                        *least = least.min(along);
                        *most = most.max(along);
                    }
                }
            }
        }
        Self { of }
    }

    /// Whether no line lies beyond a place, straight to one of the four sides.
    fn is_outermost(&self, [x, y]: [f64; 2]) -> bool {
        let ways = self.of.iter().zip([[y, x], [x, y]]);
        let mut ways = ways.filter(|(_, [across, _])| *across >= 0.0);
        ways.any(|(all, [across, along])| {
            let reach = all.get(across as usize);
            reach.is_some_and(|[least, most]| along <= least + STEP_PX || along >= most - STEP_PX)
        })
    }
}

/// A part that goes: of a stroke, from one of its ends up to a way from its start.
type Cut = (usize, usize, f64);

/// Short strokes; `None` for others.
struct Net {
    lines: Vec<Option<Short>>,
}

impl Net {
    /// Finds where other strokes and the border meet the short ones.
    fn find_meetings(&mut self, strokes: &[Stroke], size: [u32; 2]) {
        // Look around them in steps.
        let steps = |line: &Short| line.course.in_steps(STEP_PX);
        let places: Vec<Vec<(f64, [f64; 2])>> = self
            .lines
            .par_iter()
            .map(|line| {
                let steps = line.as_ref().map(steps).unwrap_or_default();
                steps
                    .into_iter()
                    .map(|(way, point)| (way, point.position))
                    .collect()
            })
            .collect();
        let all = (0..).zip(&places).flat_map(|(stroke, places)| {
            (0..)
                .zip(places)
                .map(move |(number, (way, position))| Place {
                    stroke,
                    number,
                    way: *way,
                    position: *position,
                })
        });
        let half_width = |stroke: &Stroke| {
            let widths = stroke.points.iter().map(|point| point.width);
            0.5 * widths.fold(0.0, f64::max)
        };
        let half_widths: Vec<f64> = strokes.par_iter().map(half_width).collect();
        let is_dash = |stroke: usize| {
            let line = self.lines[stroke].as_ref();
            line.is_some_and(|line| line.course.length() < LEAST_LEFT_PX)
        };
        let touches = |found: &Meeting| {
            let ink = half_widths[found.stroke] + half_widths[found.with];
            found.distance <= ink + UNSEEN_GAP_PX
        };
        let is_met = |found: &Meeting| {
            found.with != found.stroke && (!is_dash(found.stroke) || touches(found))
        };
        let met = meetings_at(all, strokes, (REACH, MEETS_PX)).filter(is_met);
        let mut met: Vec<Meeting> = met.collect();
        let order = |found: &Meeting| (found.stroke, found.with, found.place);
        met.par_sort_unstable_by(|a, b| {
            order(a)
                .cmp(&order(b))
                .then(a.distance.total_cmp(&b.distance))
        });

        // Keep the nearest place of every row of places.
        let goes_on = |a: &Meeting, b: &Meeting| {
            (a.stroke, a.with) == (b.stroke, b.with) && b.place - a.place <= 1
        };
        for row in met.chunk_by(goes_on) {
            let nearest = row.iter().min_by(|a, b| a.distance.total_cmp(&b.distance));
            if let Some((found, line)) =
                nearest.and_then(|f| Some((f, self.lines[f.stroke].as_mut()?)))
            {
                line.met
                    .push((places[found.stroke][found.place].0, found.with));
            }
        }

        // Add the border and the paper around the drawing, and sort them.
        let reaches = Reaches::new(strokes, size);
        for (number, line) in self.lines.iter_mut().enumerate() {
            let (Some(line), places) = (line, &places[number]) else {
                continue;
            };
            let ends = [places.first(), places.last()].into_iter().flatten();
            let held = ends.filter(|(_, position)| {
                is_cut_off(*position, size) || reaches.is_outermost(*position)
            });
            line.met.extend(held.map(|(way, _)| (*way, number)));
            line.met
                .sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            line.met.dedup();
        }
    }

    /// All parts that are stubs, as things stand.
    fn stubs(&self) -> Vec<Cut> {
        let ends = (0..self.lines.len()).flat_map(|stroke| [(stroke, 0), (stroke, 1)]);
        ends.filter_map(|(stroke, side)| {
            let line = self.lines[stroke].as_ref().filter(|line| !line.is_gone())?;
            line.holders(side)
                .is_empty()
                .then(|| self.stub_from(stroke, side))
                .flatten()
        })
        .flatten()
        .collect()
    }

    /// The parts of the stub that begins with an open end, if there is one.
    fn stub_from(&self, stroke: usize, side: usize) -> Option<Vec<Cut>> {
        let least_px = self.lines[stroke].as_ref()?.least_px;
        let (mut stroke, mut side) = (stroke, side);
        let (mut cuts, mut length) = (Vec::new(), 0.0);
        loop {
            // Go on to the next line, or to the end of this one.
            let line = self.lines[stroke].as_ref()?;
            let (from, first) = (line.range[side], line.first_met(side));
            let to = first.unwrap_or(line.range[1 - side]);
            cuts.push((stroke, side, to));
            length += (to - from).abs();
            if length >= least_px {
                return None;
            }

            // Go on along the stroke that alone goes on there.
            match self.beyond(stroke, 1 - side).filter(|_| first.is_none()) {
                Some(next) => (stroke, side) = next,
                None => return Some(cuts),
            }
        }
    }

    /// The end of another short stroke that alone goes on where a stroke ends.
    fn beyond(&self, stroke: usize, side: usize) -> Option<(usize, usize)> {
        let [other] = self.lines[stroke].as_ref()?.holders(side)[..] else {
            return None;
        };
        let line = self.lines[other].as_ref()?;
        let side = (0..2).find(|side| line.holders(*side) == [stroke])?;
        (other != stroke).then_some((other, side))
    }

    /// Takes parts away, and what is left of a stroke where it is too short to be seen.
    fn cut(&mut self, cuts: &[Cut]) {
        for (stroke, side, to) in cuts {
            if let Some(line) = &mut self.lines[*stroke] {
                line.range[*side] = match side {
                    0 => line.range[0].max(*to),
                    _ => line.range[1].min(*to),
                };
                if line.range[1] - line.range[0] < LEAST_LEFT_PX {
                    line.range[1] = line.range[0];
                }
            }
        }
        let gone: Vec<bool> = self
            .lines
            .iter()
            .map(|line| line.as_ref().is_some_and(Short::is_gone))
            .collect();
        for line in self.lines.iter_mut().flatten() {
            line.met.retain(|(_, with)| !gone[*with]);
        }
    }
}

#[cfg(test)]
mod tests;
