//! Lists of elements as passes hand them on: the number of elements, then the elements, in any order.

use rayon::prelude::*;

/// Writes rows of elements one after the other into a list, as far as there is room.
pub fn fill(list: &mut [u32], rows: &[Vec<u32>]) {
    let Some((count, elements)) = list.split_first_mut() else {
        return;
    };
    *count = 0;
    for (into, element) in elements.iter_mut().zip(rows.iter().flatten()) {
        *into = *element;
        *count += 1;
    }
}

/// The elements of a list in ascending order, whoever made it.
#[derive(Debug, Clone)]
pub struct Listed {
    elements: Vec<u32>,
}

impl Listed {
    /// The elements of a list; O(n) where it is in order, else O(n log n).
    pub fn of(list: &[u32]) -> Self {
        let mut elements = match list.split_first() {
            Some((count, all)) => all[..all.len().min(*count as usize)].to_vec(),
            None => Vec::new(),
        };
        if !elements.is_sorted() {
            elements.par_sort_unstable();
        }
        Self { elements }
    }

    /// All of them.
    pub fn all(&self) -> &[u32] {
        &self.elements
    }

    /// Row `y` of a grid of this width: the columns of its elements, with the elements.
    pub fn row(&self, y: usize, width: usize) -> impl Iterator<Item = (usize, u32)> + '_ {
        let start = (y * width) as u32;
        let first = self.elements.partition_point(|element| *element < start);
        let here = self.elements[first..].iter();
        here.map(move |element| ((element - start) as usize, *element))
            .take_while(move |(x, _)| *x < width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_list_keeps_its_elements_row_by_row(
            rows in prop::collection::vec(prop::collection::btree_set(0u32..9, 0..9), 0..6),
            spare in 0usize..4, is_turned in any::<bool>(),
        ) {
            let in_grid = |(y, row): (u32, &std::collections::BTreeSet<u32>)| row.iter().map(|x| y * 9 + x).collect();
            let rows: Vec<Vec<u32>> = (0..).zip(&rows).map(in_grid).collect();
            let all = rows.concat();
            let mut list = vec![7; 1 + all.len() + spare];
            fill(&mut list, &rows);
            prop_assert_eq!(list[0] as usize, all.len());
            if is_turned {
                list[1..=all.len()].reverse();
            }
            let listed = Listed::of(&list);
            prop_assert_eq!(listed.all(), &all[..]);
            for (y, row) in rows.iter().enumerate() {
                let found: Vec<_> = listed.row(y, 9).collect();
                let wanted: Vec<_> = row.iter().map(|i| (*i as usize - y * 9, *i)).collect();
                prop_assert_eq!(found, wanted);
            }
        }

        #[test]
        fn a_list_takes_what_there_is_room_for(count in 0u32..9, room in 0usize..12) {
            let mut list = vec![0; room];
            fill(&mut list, &[(0..count).collect()]);
            let held = (count as usize).min(room.saturating_sub(1));
            prop_assert_eq!(Listed::of(&list).all().len(), held);
        }
    }
}
