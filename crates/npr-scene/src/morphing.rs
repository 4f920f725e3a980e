//! Parts that take other weights of their morphs.

use crate::mesh::{Part, is_sound};
use crate::morph::{Morph, Morphed};
use crate::soundness::straighten_normals;
use std::collections::BTreeMap;

impl Part {
    /// The weights that the file gives its morphs, at rest.
    pub fn rest_weights(&self) -> Vec<f32> {
        self.morphs.iter().map(|morph| morph.rest_weight).collect()
    }

    /// Whether the morphs have these weights; missing ones are 0.
    pub(crate) fn has_weights(&self, weights: &[f32]) -> bool {
        let mut morphs = self.morphs.iter().enumerate();
        morphs.all(|(index, morph)| morph.applied_weight == sound_weight(weights, index))
    }

    /// The vertices under other weights; missing ones are 0, and so is what is no finite number.
    ///
    /// Where the file has normals and a morph has none, they turn as the surface turns from where it rests. None where
    /// the part has no morphs, or a triangle or line would lie out of range. O(vertices x morphs).
    pub(crate) fn morphed(&self, weights: &[f32]) -> Option<Morphed> {
        // Add the morphs.
        let unmorphed = self.unmorphed.as_deref()?;
        let mut vertices = unmorphed.morphed(&self.morphs, |index, _| sound_weight(weights, index));

        // Refuse what lies out of range, unless nothing is drawn of it.
        let corners = self.triangles.iter().flatten();
        let mut used = corners.chain(self.segments.iter().flatten());
        if !used.all(|vertex| is_sound(&vertices.positions[*vertex as usize])) {
            return None;
        }
        let unsound = vertices
            .positions
            .iter_mut()
            .filter(|position| !is_sound(position));
        unsound.for_each(|position| *position = [0.0; 3]);

        // Let normals follow.
        let lacks = |(index, morph): (usize, &Morph)| {
            let is_moved = sound_weight(weights, index) != morph.rest_weight;
            is_moved && morph.positions.is_some() && morph.normals.is_none()
        };
        if let Some(normals) = &mut vertices.normals {
            if self.morphs.iter().enumerate().any(lacks) {
                let rest = unmorphed.morphed(&self.morphs, |_, morph| morph.rest_weight);
                turn_normals(
                    normals,
                    [&rest.positions, &vertices.positions],
                    &self.triangles,
                );
            }
            if !normals.iter().all(is_sound) {
                return None;
            }
            straighten_normals(normals, &vertices.positions, &self.triangles);
        }
        Some(vertices)
    }

    /// Takes over vertices under some weights, and gives those before.
    pub(crate) fn swap_morphed(&mut self, vertices: &mut Morphed, weights: &[f32]) {
        std::mem::swap(&mut self.positions, &mut vertices.positions);
        std::mem::swap(&mut self.normals, &mut vertices.normals);
        for (index, morph) in self.morphs.iter_mut().enumerate() {
            morph.applied_weight = sound_weight(weights, index);
        }
    }
}

/// A weight of a list; 0 where there is none, or none that is finite.
fn sound_weight(weights: &[f32], index: usize) -> f32 {
    let weight = weights.get(index).copied();
    weight.filter(|weight| weight.is_finite()).unwrap_or(0.0)
}

/// Turns every normal as the surface at its vertex turns from the first positions to the second.
///
/// Vertices at one place with one normal turn as one, so that seams of textures stay smooth, and edges that the file
/// draws hard stay hard. O(n log n).
fn turn_normals(normals: &mut [[f32; 3]], places: [&[[f32; 3]]; 2], triangles: &[[u32; 3]]) {
    // Number the vertices that turn as one.
    let mut numbers = BTreeMap::new();
    let key = |vertex: usize| (places[0][vertex], normals[vertex]);
    let bits = |(place, normal): ([f32; 3], [f32; 3])| {
        [place, normal].map(|v| v.map(|x| (x + 0.0).to_bits()))
    };
    let groups: Vec<usize> = (0..normals.len())
        .map(|vertex| {
            let next = numbers.len();
            *numbers.entry(bits(key(vertex))).or_insert(next)
        })
        .collect();

    // Sum up the faces around each, by their areas, before and after.
    let [before, after] = places.map(|places| {
        let mut sums = vec![[0.0f32; 3]; numbers.len()];
        for triangle in triangles {
            let area = face_area(triangle.map(|vertex| places[vertex as usize]));
            for vertex in triangle {
                let sum = &mut sums[groups[*vertex as usize]];
                *sum = std::array::from_fn(|axis| sum[axis] + area[axis]);
            }
        }
        sums
    });

    // Turn each by the smallest turn from one sum to the other.
    for (normal, group) in normals.iter_mut().zip(&groups) {
        if let (Some(from), Some(to)) = (unit(before[*group]), unit(after[*group])) {
            *normal = turned(*normal, from, to);
        }
    }
}

/// Twice the area of a face, as a vector along its normal.
fn face_area([a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    let minus = |p: [f32; 3]| -> [f32; 3] { std::array::from_fn(|axis| p[axis] - a[axis]) };
    cross(minus(b), minus(c))
}

fn unit(v: [f32; 3]) -> Option<[f32; 3]> {
    let length = dot(v, v).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|x| x / length))
}

/// `v` turned by the smallest turn that carries the unit vector `from` to `to`; half a turn has no smallest and leaves
/// it turned over.
fn turned(v: [f32; 3], from: [f32; 3], to: [f32; 3]) -> [f32; 3] {
    let cos = dot(from, to);
    if cos < -0.999_999 {
        return v.map(|x| -x);
    }
    let axis = cross(from, to);
    let (across, along) = (cross(axis, v), dot(axis, v) / (1.0 + cos));
    std::array::from_fn(|i| v[i] * cos + across[i] + axis[i] * along)
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
