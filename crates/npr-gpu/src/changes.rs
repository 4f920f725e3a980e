//! What of a list changed, so that an engine is handed that alone.

use std::ops::Range;

use bytemuck::NoUninit;

use crate::engine::{EngineError, Session};
use crate::graph::ResourceId;

/// Elements between two changes up to which both are handed over as one: a write costs more than so many elements.
const GAP: usize = 32;

/// Ranges of a list that changed.
///
/// A scene has one list of vertices, in which those of a mesh lie together: where one mesh of many moves, its vertices
/// are handed over and no others. One buffer of all meshes, handed over whole, was too slow in [Jiang et al. 2022].
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Changes {
    /// Ascending, and more than [`GAP`] apart.
    ranges: Vec<Range<usize>>,
}

impl Changes {
    /// Where two lists of one length differ, byte by byte. O(elements).
    ///
    /// # Panics
    ///
    /// Where their lengths differ.
    fn between<T: NoUninit>(before: &[T], after: &[T]) -> Self {
        assert_eq!(before.len(), after.len(), "a pose has the elements it had");
        let mut changes = Self::default();
        for (number, (old, new)) in before.iter().zip(after).enumerate() {
            if bytemuck::bytes_of(old) != bytemuck::bytes_of(new) {
                changes.add(number);
            }
        }
        changes
    }

    /// Adds an element, which lies behind all that were added before.
    pub fn add(&mut self, number: usize) {
        match self.ranges.last_mut() {
            Some(last) if number <= last.end + GAP => last.end = number + 1,
            _ => self.ranges.push(number..number + 1),
        }
    }

    /// The ranges of elements, ascending.
    pub fn ranges(&self) -> &[Range<usize>] {
        &self.ranges
    }

    /// Hands the ranges of a list over to a buffer that holds the rest of it.
    ///
    /// # Errors
    ///
    /// Those of the session.
    pub fn write<T: NoUninit>(
        &self,
        session: &mut dyn Session,
        id: ResourceId,
        elements: &[T],
    ) -> Result<(), EngineError> {
        let words = size_of::<T>() / size_of::<u32>();
        for range in &self.ranges {
            let part = bytemuck::cast_slice(&elements[range.clone()]);
            session.write_at(id, range.start * words, part)?;
        }
        Ok(())
    }
}

/// Hands over to a buffer that holds `before` where `after` differs. O(elements).
///
/// # Errors
///
/// Those of the session.
///
/// # Panics
///
/// Where the lengths of both differ.
pub fn write_changes<T: NoUninit>(
    session: &mut dyn Session,
    id: ResourceId,
    before: &[T],
    after: &[T],
) -> Result<(), EngineError> {
    Changes::between(before, after).write(session, id, after)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Engine;
    use crate::graph::Graph;
    use crate::processor::Processor;
    use proptest::prelude::*;

    proptest! {
        /// A buffer that is handed the changes of a list holds the list.
        #[test]
        fn changes_make_the_list(before in prop::collection::vec(0u32..3, 3..600), seed: u64, share in 0u64..100) {
            let is_changed = |i: usize| (seed ^ (i as u64 / 7)).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 57 < share;
            let rows: Vec<[u32; 3]> = before.as_chunks::<3>().0.to_vec();
            let moved = |(i, row): (usize, &[u32; 3])| if is_changed(i) { [row[0] + 1, row[1], row[2]] } else { *row };
            let after: Vec<[u32; 3]> = rows.iter().enumerate().map(moved).collect();

            let mut graph = Graph::default();
            let list = graph.buffer::<u32>("list", 3 * rows.len());
            let mut session = Processor.prepare(graph).unwrap();
            session.write(list, bytemuck::cast_slice(&rows)).unwrap();
            let changes = Changes::between(&rows, &after);
            changes.write(session.as_mut(), list, &after).unwrap();
            let words: Vec<u32> = after.concat();
            prop_assert_eq!(session.read(list).unwrap(), words);

            // No element beyond a gap from a change is handed over.
            for i in changes.ranges().iter().cloned().flatten() {
                prop_assert!((i.saturating_sub(GAP)..(i + GAP + 1).min(rows.len())).any(is_changed));
            }
            prop_assert_eq!(changes.ranges().is_empty(), (0..rows.len()).all(|i| !is_changed(i)));
        }
    }
}
