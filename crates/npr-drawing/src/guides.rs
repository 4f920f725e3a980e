//! Points that somebody set to say where a pen is lifted: strokes end there, and thin out.

use crate::arc::Measured;
use crate::lengths::id_of;
use npr_vector::stroke::{Stroke, StrokePoint};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Pixels from an end within which a stroke is not cut: the end itself is where the pen is lifted.
const AT_END_PX: f64 = 8.0;

/// Largest difference in depth between a point and its line, as a share of its depth.
const DEPTH_SHARE: f64 = 0.05;

/// Number of the part that the first point cuts off, beyond all numbers of parts of long strokes.
const FIRST_PART: u32 = 2048;

/// Where a pen is lifted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guide {
    /// Place in the picture, in pixels from its top left corner, y down.
    pub place: [f64; 2],
    /// Distance from the eye along the view axis, in scene units.
    pub depth: f64,
}

/// Cuts at each guide the visible stroke that passes nearest, if that is within `reach_px` and about as deep, and gives
/// the ends at which pens are lifted: by the id of a stroke, whether it is so at its start and at its end.
///
/// Where the nearest place lies within 8 pixels of an end of an open stroke, that end is one of them, and nothing is
/// cut. A ring becomes an open stroke from the guide to itself. The first part keeps the id of its stroke. Guides count
/// in their order. O(guides x points), on all threads, with the same result for any number of them.
pub fn cut_at_guides(
    strokes: &mut Vec<Stroke>,
    guides: &[Guide],
    reach_px: f64,
    is_cut: impl Fn(&Stroke) -> bool + Sync,
) -> BTreeMap<u64, [bool; 2]> {
    let mut lifted: BTreeMap<u64, [bool; 2]> = BTreeMap::new();
    for (guide, number) in guides.iter().zip(FIRST_PART..) {
        // Find the nearest stroke.
        let all = strokes.par_iter().enumerate();
        let near = all.filter(|(_, stroke)| stroke.is_visible() && is_cut(stroke));
        let near = near.filter_map(|(index, stroke)| {
            let (away, way) = nearest(stroke, guide).filter(|(away, _)| *away <= reach_px)?;
            Some((away, index, way))
        });
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let Some((_, index, way)) = nearest else {
            continue;
        };
        let stroke = &strokes[index];
        let Some(line) = Measured::new(stroke) else {
            continue;
        };

        // Cut it there, unless it ends there.
        let before = lifted.get(&stroke.id).copied().unwrap_or_default();
        let length = line.length();
        let part = |id: u64, from: f64, to: f64| Stroke {
            id,
            closed: false,
            part: None,
            points: line.part(from, to),
            ..*stroke
        };
        if stroke.closed {
            let ring = part(stroke.id, way, way + length);
            lifted.insert(stroke.id, [true; 2]);
            strokes[index] = ring;
        } else if way.min(length - way) < AT_END_PX {
            let is_start = way < length - way;
            lifted.insert(stroke.id, [before[0] || is_start, before[1] || !is_start]);
        } else {
            let rest = part(id_of(stroke.id, number), way, length);
            let first = part(stroke.id, 0.0, way);
            lifted.insert(first.id, [before[0], true]);
            lifted.insert(rest.id, [true, before[1]]);
            strokes[index] = first;
            strokes.insert(index + 1, rest);
        }
    }
    lifted
}

/// How far a guide lies from the nearest place of a stroke that is about as deep, and the way from its start to there,
/// in pixels.
fn nearest(stroke: &Stroke, guide: &Guide) -> Option<(f64, f64)> {
    let count = stroke.points.len();
    let pieces = if stroke.closed {
        count
    } else {
        count.saturating_sub(1)
    };
    let mut best: Option<(f64, f64)> = None;
    let mut along = 0.0;
    for index in 0..pieces {
        let ends: [&StrokePoint; 2] = [&stroke.points[index], &stroke.points[(index + 1) % count]];
        let [from, to] = ends.map(|point| point.position);
        let step = [to[0] - from[0], to[1] - from[1]];
        let length = step[0].hypot(step[1]);
        if !length.is_finite() {
            return None;
        }
        let off = [guide.place[0] - from[0], guide.place[1] - from[1]];
        let share = match length > 0.0 {
            true => ((off[0] * step[0] + off[1] * step[1]) / (length * length)).clamp(0.0, 1.0),
            false => 0.0,
        };
        let away = (off[0] - share * step[0]).hypot(off[1] - share * step[1]);
        let depth = ends[0].depth + share * (ends[1].depth - ends[0].depth);
        let is_as_deep = (depth - guide.depth).abs() <= DEPTH_SHARE * guide.depth.abs();
        if is_as_deep && best.is_none_or(|(least, _)| away < least) {
            best = Some((away, along + share * length));
        }
        along += length;
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_strokes::{hostile_places, ring_of, stroke_of, strokes};
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    fn guide(place: [f64; 2], stroke: &Stroke) -> Guide {
        Guide {
            place,
            depth: stroke.points[0].depth,
        }
    }

    fn ends(stroke: &Stroke) -> [f64; 2] {
        [stroke.points[0], stroke.points[stroke.points.len() - 1]].map(|point| point.position[0])
    }

    #[test]
    fn a_line_is_cut_beside_the_guide_and_lifted_there() {
        let line = stroke_of(&[[0.0, 10.0], [30.0, 10.0], [100.0, 10.0]]);
        let mut found = vec![line.clone()];
        let lifted = cut_at_guides(&mut found, &[guide([40.0, 13.0], &line)], 5.0, |_| true);
        assert_eq!(
            found.iter().map(ends).collect::<Vec<_>>(),
            [[0.0, 40.0], [40.0, 100.0]]
        );
        let at = |index: usize| lifted.get(&found[index].id).copied();
        assert_eq!([at(0), at(1)], [Some([false, true]), Some([true, false])]);
    }

    #[test]
    fn guides_out_of_reach_deeper_or_at_ends_cut_nothing() {
        let line = stroke_of(&[[0.0, 10.0], [100.0, 10.0]]);
        let deep = Guide {
            place: [40.0, 10.0],
            depth: 2.0 * line.points[0].depth + 1.0,
        };
        for far in [guide([40.0, 20.0], &line), deep] {
            let mut found = vec![line.clone()];
            assert!(cut_at_guides(&mut found, &[far], 5.0, |_| true).is_empty());
            assert_eq!(found, std::slice::from_ref(&line));
        }
        let mut found = vec![line.clone()];
        let lifted = cut_at_guides(&mut found, &[guide([97.0, 10.0], &line)], 5.0, |_| true);
        assert_eq!(found, std::slice::from_ref(&line));
        assert_eq!(lifted.get(&line.id), Some(&[false, true]));
    }

    #[test]
    fn a_ring_opens_at_the_guide() {
        let ring = ring_of(&[
            [100.0, 100.0],
            [180.0, 100.0],
            [180.0, 160.0],
            [100.0, 160.0],
        ]);
        let place = [150.0, 100.0];
        let mut found = vec![ring.clone()];
        let lifted = cut_at_guides(&mut found, &[guide(place, &ring)], 5.0, |_| true);
        let [first, last] = [
            found[0].points[0],
            found[0].points[found[0].points.len() - 1],
        ];
        assert!(!found[0].closed && (found[0].length() - ring.length()).abs() < 1e-6);
        assert!(
            [first, last]
                .iter()
                .all(|point| (point.position[0] - place[0]).abs() < 1e-6)
        );
        assert_eq!(lifted.get(&ring.id), Some(&[true; 2]));
    }

    proptest! {
        /// Whatever is cut, no ink is lost and no id is given twice.
        #[test]
        fn parts_make_up_their_lines(
            mut before in strokes(),
            odd in hostile_places(),
            at in prop::collection::vec([-50.0_f64..500.0, -50.0..500.0], 0..6),
        ) {
            before.push(stroke_of(&odd));
            let at = at.iter().chain(&odd);
            let guides: Vec<Guide> = at.map(|place| Guide { place: *place, depth: 5.0 }).collect();
            let mut after = before.clone();
            cut_at_guides(&mut after, &guides, 60.0, |_| true);
            let length = |all: &[Stroke]| all.iter().map(Stroke::length).filter(|l| *l < 1e6).sum::<f64>();
            prop_assert!((length(&before) - length(&after)).abs() <= 1e-6 * (1.0 + length(&before)));
            let ids: BTreeSet<u64> = after.iter().map(|stroke| stroke.id).collect();
            prop_assert_eq!(ids.len(), after.len());
        }
    }
}
