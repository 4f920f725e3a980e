//! Parts cut along their triangles.

use crate::{Morph, Part, Unmorphed};
use std::collections::BTreeMap;

impl Part {
    /// The part cut into one for every number that its triangles have, in ascending order of numbers.
    ///
    /// Each piece keeps its triangles and the vertices that they use in the order that they had; vertices where
    /// pieces meet are stored in each of them, equal in all they hold, so that welding joins the pieces again. Line
    /// segments stay with the first piece. A part whose triangles have one number, or that has none, stays as it is.
    ///
    /// O(n log k) for `n` vertices and triangles and `k` numbers.
    ///
    /// # Panics
    ///
    /// When there are not as many numbers as triangles.
    pub fn split(self, numbers: &[u32]) -> Vec<(u32, Self)> {
        assert_eq!(numbers.len(), self.triangles.len(), "a number for each");
        let mut triangles: BTreeMap<u32, Vec<[u32; 3]>> = BTreeMap::new();
        for (number, corners) in numbers.iter().zip(&self.triangles) {
            triangles.entry(*number).or_default().push(*corners);
        }
        if triangles.len() < 2 {
            let number = triangles.keys().next().copied().unwrap_or(0);
            return vec![(number, self)];
        }
        let mut places = vec![u32::MAX; self.positions.len()];
        let mut segments = self.segments.clone();
        let pieces = triangles.into_iter().map(|(number, triangles)| {
            let segments = std::mem::take(&mut segments);
            (number, self.piece(triangles, segments, &mut places))
        });
        pieces.collect()
    }

    /// Some of the triangles and segments with the vertices they use. `places` is room for a number per vertex.
    fn piece(
        &self,
        mut triangles: Vec<[u32; 3]>,
        mut segments: Vec<[u32; 2]>,
        places: &mut [u32],
    ) -> Self {
        // Find the vertices that are used, and number them anew.
        let used = triangles.iter().flatten().chain(segments.iter().flatten());
        let mut kept: Vec<u32> = used.copied().collect();
        kept.sort_unstable();
        kept.dedup();
        for (place, vertex) in (0..).zip(&kept) {
            places[*vertex as usize] = place;
        }
        let ends = segments.iter_mut().flatten();
        for corner in triangles.iter_mut().flatten().chain(ends) {
            *corner = places[*corner as usize];
        }

        // Take over what is known of these vertices.
        let morph = |morph: &Morph| Morph {
            applied_weight: morph.applied_weight,
            rest_weight: morph.rest_weight,
            positions: gathered(&morph.positions, &kept),
            normals: gathered(&morph.normals, &kept),
        };
        Self {
            positions: kept.iter().map(|v| self.positions[*v as usize]).collect(),
            normals: gathered(&self.normals, &kept),
            uvs: gathered(&self.uvs, &kept),
            colors: gathered(&self.colors, &kept),
            joints: gathered(&self.joints, &kept),
            weights: gathered(&self.weights, &kept),
            marks: gathered(&self.marks, &kept),
            directions: gathered(&self.directions, &kept),
            triangles,
            segments,
            material: self.material,
            morphs: self.morphs.iter().map(morph).collect(),
            unmorphed: self.unmorphed.as_deref().map(|whole| {
                let positions = kept.iter().map(|v| whole.positions[*v as usize]);
                Box::new(Unmorphed {
                    positions: positions.collect(),
                    normals: gathered(&whole.normals, &kept),
                })
            }),
            ids: self.ids.clone(),
        }
    }
}

/// The entries of a list that belong to some vertices.
fn gathered<T: Copy>(list: &Option<Vec<T>>, kept: &[u32]) -> Option<Vec<T>> {
    let list = list.as_ref()?;
    Some(kept.iter().map(|v| list[*v as usize]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A part in which every list of a vertex holds the vertex's number.
    fn part(count: u32, triangles: Vec<[u32; 3]>) -> Part {
        let numbers = || (0..count).map(|v| v as f32);
        let morph = Morph {
            applied_weight: 0.5,
            positions: Some(numbers().map(|v| [v, 1.0, 0.0]).collect()),
            ..Morph::default()
        };
        Part {
            positions: numbers().map(|v| [v, 0.0, 0.0]).collect(),
            normals: Some(numbers().map(|v| [0.0, v, 0.0]).collect()),
            uvs: Some(numbers().map(|v| [v, -v]).collect()),
            colors: Some(numbers().map(|v| [v, 0.0, 0.0, 1.0]).collect()),
            joints: Some((0..count).map(|v| [v as u16; 4]).collect()),
            weights: Some(numbers().map(|v| [v, 0.0, 0.0, 0.0]).collect()),
            marks: Some((0..count).map(|v| v % 2 == 0).collect()),
            directions: Some(numbers().map(|v| [0.0, 0.0, v]).collect()),
            segments: Vec::new(),
            triangles,
            material: Some(3),
            morphs: vec![morph],
            unmorphed: Some(Box::new(Unmorphed {
                positions: numbers().map(|v| [v, 2.0, 0.0]).collect(),
                normals: Some(numbers().map(|v| [0.0, v, 2.0]).collect()),
            })),
            ids: Vec::new(),
        }
    }

    /// The number that a vertex of such a part holds, if all its lists agree.
    fn number_of(part: &Part, vertex: u32) -> Option<f32> {
        let v = vertex as usize;
        let number = part.positions[v][0];
        let same = [
            part.normals.as_ref()?[v][1],
            part.uvs.as_ref()?[v][0],
            part.colors.as_ref()?[v][0],
            f32::from(part.joints.as_ref()?[v][2]),
            part.weights.as_ref()?[v][0],
            part.directions.as_ref()?[v][2],
            part.morphs[0].positions.as_ref()?[v][0],
            part.unmorphed.as_ref()?.positions[v][0],
            part.unmorphed.as_ref()?.normals.as_ref()?[v][1],
        ];
        let is_even = part.marks.as_ref()?[v];
        let all = same.iter().all(|other| *other == number) && is_even == (number % 2.0 == 0.0);
        all.then_some(number)
    }

    proptest! {
        #[test]
        fn every_triangle_lies_in_the_piece_of_its_number(
            faces in prop::collection::vec((prop::array::uniform3(0u32..20), 0u32..4), 0..40),
        ) {
            let (triangles, numbers): (Vec<_>, Vec<_>) = faces.iter().copied().unzip();
            let pieces = part(20, triangles).split(&numbers);
            prop_assert!(pieces.is_sorted_by_key(|(number, _)| *number));
            let mut found = 0;
            for (number, piece) in &pieces {
                piece.sanity_check();
                prop_assert_eq!((piece.material, piece.morphs[0].applied_weight), (Some(3), 0.5));
                let wanted = faces.iter().filter(|(_, other)| other == number);
                let wanted: Vec<_> = wanted.map(|(face, _)| face.map(|v| Some(v as f32))).collect();
                let corners = piece.triangles.iter().map(|face| face.map(|v| number_of(piece, v)));
                prop_assert_eq!(corners.collect::<Vec<_>>(), wanted);
                found += piece.triangles.len();
                // Nothing is stored that no triangle uses, unless nothing was cut.
                let used = piece.triangles.iter().flatten().collect::<std::collections::BTreeSet<_>>();
                prop_assert!(pieces.len() == 1 || used.len() == piece.positions.len());
            }
            prop_assert_eq!(found, faces.len());
        }

        #[test]
        fn lines_stay_with_the_first_piece(
            faces in prop::collection::vec((prop::array::uniform3(0u32..20), 0u32..4), 0..20),
            segments in prop::collection::vec(prop::array::uniform2(0u32..20), 0..20),
        ) {
            let (triangles, numbers): (Vec<_>, Vec<_>) = faces.into_iter().unzip();
            let whole = Part { segments: segments.clone(), ..part(20, triangles) };
            let pieces = whole.split(&numbers);
            for (index, (_, piece)) in pieces.iter().enumerate() {
                piece.sanity_check();
                let ends = piece.segments.iter().map(|ends| ends.map(|v| number_of(piece, v)));
                let wanted = segments.iter().map(|ends| ends.map(|v| Some(v as f32)));
                let wanted = wanted.filter(|_| index == 0);
                prop_assert_eq!(ends.collect::<Vec<_>>(), wanted.collect::<Vec<_>>());
            }
        }
    }
}
