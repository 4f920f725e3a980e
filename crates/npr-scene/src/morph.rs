//! Morphs: offsets that weights scale and add.

/// One morph target: offsets that a weight scales and adds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Morph {
    /// The weight worked into the part's positions and normals.
    pub applied_weight: f32,
    /// The weight that the file gives it, at rest.
    pub rest_weight: f32,
    /// Offset of each position.
    pub positions: Option<Vec<[f32; 3]>>,
    /// Offset of each normal.
    pub normals: Option<Vec<[f32; 3]>>,
}

/// The vertices of a part before any morph, as the file has them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Unmorphed {
    /// Positions, finite or not.
    pub positions: Vec<[f32; 3]>,
    /// Normals, of any length.
    pub normals: Option<Vec<[f32; 3]>>,
}

/// The vertices of a part under some weights.
#[derive(Debug)]
pub(crate) struct Morphed {
    pub positions: Vec<[f32; 3]>,
    pub normals: Option<Vec<[f32; 3]>>,
}

impl Unmorphed {
    /// The vertices with every morph added by the weight that `weight_of` gives it.
    pub(crate) fn morphed(
        &self,
        morphs: &[Morph],
        weight_of: impl Fn(usize, &Morph) -> f32,
    ) -> Morphed {
        let mut vertices = Morphed {
            positions: self.positions.clone(),
            normals: self.normals.clone(),
        };
        for (index, morph) in morphs.iter().enumerate() {
            let weight = weight_of(index, morph);
            if weight == 0.0 {
                continue;
            }
            add_scaled(&mut vertices.positions, morph.positions.as_deref(), weight);
            if let Some(normals) = &mut vertices.normals {
                add_scaled(normals, morph.normals.as_deref(), weight);
            }
        }
        vertices
    }
}

fn add_scaled(list: &mut [[f32; 3]], offsets: Option<&[[f32; 3]]>, weight: f32) {
    for (value, offset) in list
        .iter_mut()
        .flatten()
        .zip(offsets.into_iter().flatten().flatten())
    {
        *value += offset * weight;
    }
}
