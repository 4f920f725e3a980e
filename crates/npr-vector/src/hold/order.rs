//! In which order strokes are drawn: that of the frame before.

use super::remembered::Line;
use crate::stroke::Stroke;
use std::collections::BTreeMap;

/// Sorts strokes as those with their identities lay in the frame before, visible ones first; new ones come behind those
/// that they came behind.
pub(super) fn keep(strokes: &mut Vec<Stroke>, lines: &[Line]) {
    let ranks: BTreeMap<u64, u32> = lines.iter().map(|line| (line.id, line.rank)).collect();
    let mut last = None;
    let all = std::mem::take(strokes).into_iter().enumerate();
    let mut ordered: Vec<_> = all
        .map(|(index, stroke)| {
            let rank = ranks.get(&stroke.id).copied();
            last = rank.or(last);
            ((stroke.occluders > 0, last, rank.is_none(), index), stroke)
        })
        .collect();
    ordered.sort_by_key(|(key, _)| *key);
    strokes.extend(ordered.into_iter().map(|(_, stroke)| stroke));
}
