//! What the lines of a film's frames take over from the frame before.

use npr_core::line_source::LineSource;
use npr_drawing::stubs::remove_stubs;
use npr_vector::hold::HeldStrokes;
use npr_vector::mesh_lines::HeldJoints;
use npr_vector::stroke::Stroke;
use std::collections::{BTreeMap, BTreeSet};

/// Share of the least length below which a line goes that was drawn in the frame before: it shrinks to a dash of 9
/// pixels first, where the least length is 24.
const GOES_SHARE: f64 = 0.375;

/// The strokes of the frame drawn last, for [`LineModel::draw_held`](super::LineModel::draw_held); of every way to find
/// lines its own, as a frame may have several.
#[derive(Debug, Clone, Default)]
pub struct HeldLines {
    of_methods: Vec<(LineSource, HeldLinesOfMethod)>,
}

/// Those that one method found.
#[derive(Debug, Clone, Default)]
pub(super) struct HeldLinesOfMethod {
    pub joints: HeldJoints,
    pub strokes: HeldStrokes,
    pub drawn: DrawnBefore,
}

impl HeldLines {
    /// Those that a method found.
    pub(super) fn of(&mut self, method: LineSource) -> &mut HeldLinesOfMethod {
        let known = self
            .of_methods
            .iter()
            .position(|(other, _)| *other == method);
        let index = known.unwrap_or_else(|| {
            self.of_methods.push((method, HeldLinesOfMethod::default()));
            self.of_methods.len() - 1
        });
        &mut self.of_methods[index].1
    }
}

/// Which strokes of the frame before were drawn, and no stubs.
#[derive(Debug, Clone, Default)]
pub(super) struct DrawnBefore {
    /// Ids of those that were drawn whole. Where a stub was cut off, it is one still.
    whole: BTreeSet<u64>,
}

impl DrawnBefore {
    /// Removes stubs as [`remove_stubs`] does, but lets lines that were drawn shrink before they go: what is about as
    /// long as the least length does not come and go all the time.
    pub fn remove_stubs(
        &mut self,
        strokes: &mut Vec<Stroke>,
        size: [u32; 2],
        least_px: impl Fn(&Stroke) -> f64 + Sync,
    ) {
        let lengths = |strokes: &[Stroke]| -> BTreeMap<u64, f64> {
            let all = strokes.iter().filter(|stroke| stroke.is_visible());
            all.map(|stroke| (stroke.id, stroke.length())).collect()
        };
        let found = lengths(strokes);
        remove_stubs(strokes, size, |stroke| {
            let share = if self.whole.contains(&stroke.id) {
                GOES_SHARE
            } else {
                1.0
            };
            least_px(stroke) * share
        });
        let drawn = lengths(strokes).into_iter();
        let whole = drawn.filter(|(id, length)| found.get(id) == Some(length));
        self.whole = whole.map(|(id, _)| id).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_vector::stroke::{Kind, StrokePoint};

    fn stroke(id: u64, places: &[[f64; 2]], closed: bool) -> Stroke {
        let point = |position: &[f64; 2]| StrokePoint {
            position: *position,
            width: 1.0,
            ..StrokePoint::default()
        };
        Stroke {
            id,
            kind: Kind::Crease,
            occluders: 0,
            surface: 0,
            closed,
            part: None,
            points: places.iter().map(point).collect(),
        }
    }

    /// Whether a line in the open is drawn in frames where it is so long; lines of 20 pixels are no stubs.
    fn drawn(lengths: &[f64], mut before: Option<DrawnBefore>) -> Vec<bool> {
        let around = [[10.0, 10.0], [190.0, 10.0], [190.0, 190.0], [10.0, 190.0]];
        let frames = lengths.iter().map(|length| {
            let line = stroke(7, &[[80.0, 100.0], [80.0 + length, 100.0]], false);
            let mut strokes = vec![stroke(1, &around, true), line];
            match &mut before {
                Some(before) => before.remove_stubs(&mut strokes, [200; 2], |_| 20.0),
                None => remove_stubs(&mut strokes, [200; 2], |_| 20.0),
            }
            strokes.iter().any(|stroke| stroke.id == 7)
        });
        frames.collect()
    }

    #[test]
    fn what_is_about_as_long_as_a_stub_stays_as_it_is() {
        let lengths = [21.0, 19.0, 22.0, 16.0, 9.0, 7.0, 9.0, 19.0, 22.0, 18.0];
        let alone = [
            true, false, true, false, false, false, false, false, true, false,
        ];
        let held = [
            true, true, true, true, true, false, false, false, true, true,
        ];
        assert_eq!(drawn(&lengths, None), alone);
        assert_eq!(drawn(&lengths, Some(DrawnBefore::default())), held);
    }
}
