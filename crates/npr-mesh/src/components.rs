//! Connected components: the separate pieces that a mesh is put together from.

use crate::union_find::UnionFind;
use crate::weld::Weld;

/// The component of every triangle, numbered from 0 in the order of their first triangles, and how many there are.
///
/// Triangles that share a welded vertex belong together. Pieces that merely cut through each other do not, which is
/// how lines of intersection are told from smooth skin. Nearly O(n).
pub fn components(triangles: &[[u32; 3]], weld: &Weld) -> (Vec<u32>, u32) {
    // Join the corners of every triangle.
    let mut sets = UnionFind::new(weld.count());
    for triangle in triangles {
        let [a, b, c] = weld.corners(*triangle);
        sets.unite(a, b);
        sets.unite(a, c);
    }

    // Number the pieces in the order of their first triangles.
    let mut number_of_root = vec![u32::MAX; weld.count()];
    let mut count = 0;
    let of_triangle = triangles
        .iter()
        .map(|triangle| {
            let number = &mut number_of_root[sets.find(weld.corners(*triangle)[0]) as usize];
            if *number == u32::MAX {
                *number = count;
                count += 1;
            }
            *number
        })
        .collect();
    (of_triangle, count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::weld;
    use proptest::prelude::*;

    /// Spreads numbers along shared vertices until nothing changes.
    fn components_by_flooding(triangles: &[[u32; 3]]) -> Vec<u32> {
        let mut number: Vec<u32> = (0..triangles.len() as u32).collect();
        loop {
            let before = number.clone();
            for (i, a) in triangles.iter().enumerate() {
                for (j, b) in triangles.iter().enumerate() {
                    if a.iter().any(|v| b.contains(v)) {
                        let low = number[i].min(number[j]);
                        (number[i], number[j]) = (low, low);
                    }
                }
            }
            if number == before {
                return number;
            }
        }
    }

    proptest! {
        #[test]
        fn agrees_with_flooding(triangles in prop::collection::vec(prop::array::uniform3(0u32..24), 0..20)) {
            let positions: Vec<[f32; 3]> = (0..24).map(|i| [i as f32, 0.0, 0.0]).collect();
            let (numbers, count) = components(&triangles, &weld(&positions, 0.0));
            let flooded = components_by_flooding(&triangles);
            for i in 0..triangles.len() {
                for j in 0..triangles.len() {
                    prop_assert_eq!(numbers[i] == numbers[j], flooded[i] == flooded[j]);
                }
            }
            prop_assert_eq!(numbers.iter().max().map_or(0, |m| m + 1), count);
        }
    }
}
