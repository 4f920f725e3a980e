//! Strokes put together again that were cut where visibility changes, so that sampling knows nothing of the cuts.

use npr_render::{Drawing, Kind};
use npr_vector::mesh_lines::sample::Spine;
use npr_vector::stroke::Stroke;
use std::collections::BTreeMap;

/// Strokes of one kind and surface, each from where the one before ends.
#[derive(Debug)]
pub struct Chain<'a> {
    strokes: Vec<&'a Stroke>,
}

/// What strokes of a chain have in common at its joints.
type Joint = (u32, Kind, [i64; 2]);

fn joint(stroke: &Stroke, place: [f64; 2]) -> Joint {
    let place = place.map(|v| (v * 64.0).round() as i64);
    (stroke.surface, stroke.kind, place)
}

/// All strokes of a drawing in chains.
pub fn chains(drawing: &Drawing) -> Vec<Chain<'_>> {
    let (closed, open): (Vec<&Stroke>, Vec<&Stroke>) =
        drawing.strokes.iter().partition(|stroke| stroke.closed);
    let rows = closed.into_iter().map(|stroke| vec![stroke]);
    rows.chain(joined(&open))
        .map(|strokes| Chain { strokes })
        .collect()
}

fn joined<'a>(open: &[&'a Stroke]) -> Vec<Vec<&'a Stroke>> {
    let starts: BTreeMap<Joint, usize> = (open.iter().enumerate())
        .map(|(index, stroke)| (joint(stroke, stroke.points[0].position), index))
        .collect();
    let follower = |index: usize| {
        let last = open[index].points.last()?;
        starts.get(&joint(open[index], last.position)).copied()
    };
    let mut follows = vec![false; open.len()];
    for index in (0..open.len()).filter_map(follower) {
        follows[index] = true;
    }
    let (mut used, mut rows) = (vec![false; open.len()], Vec::new());
    let firsts = (0..open.len()).filter(|index| !follows[*index]);
    // What is left after the chains with a start goes round.
    for first in firsts.chain(0..open.len()) {
        let (mut row, mut next) = (Vec::new(), Some(first));
        while let Some(index) = next.filter(|index| !used[*index]) {
            used[index] = true;
            row.push(open[index]);
            next = follower(index);
        }
        if !row.is_empty() {
            rows.push(row);
        }
    }
    rows
}

impl Chain<'_> {
    /// The chain as it is sampled.
    pub fn spine(&self) -> Spine {
        let points = self.strokes.iter().flat_map(|stroke| {
            let back = stroke.closed.then(|| &stroke.points[0]);
            stroke.points.iter().chain(back)
        });
        Spine {
            points: points
                .map(|point| {
                    let [x, y] = point.position;
                    [x, y, point.depth].map(|v| v as f32)
                })
                .collect(),
            // Contours run with their own surface on the left.
            outer_side: f32::from(u8::from(self.strokes[0].kind == Kind::Contour)),
            part: self.strokes[0].surface,
        }
    }

    /// Whether each of a number of samples at equal distances is visible.
    pub fn visible_at(&self, count: usize) -> Vec<bool> {
        let lengths: Vec<f64> = self.strokes.iter().map(|stroke| stroke.length()).collect();
        let step = lengths.iter().sum::<f64>() / count as f64;
        let (mut stroke, mut passed) = (0, 0.0);
        let visible = (0..count).map(|sample| {
            let place = (sample as f64 + 0.5) * step;
            while stroke + 1 < lengths.len() && place >= passed + lengths[stroke] {
                passed += lengths[stroke];
                stroke += 1;
            }
            self.strokes[stroke].is_visible()
        });
        visible.collect()
    }
}
