//! What expressions do to a scene: weights of morphs, base colours and places of textures.

use crate::expression::{Expression, shown};
use crate::scene::Scene;
use std::collections::BTreeMap;

impl Scene {
    /// The expressions of the scene's figure; none where it has none.
    pub(crate) fn expressions(&self) -> &[Expression] {
        let figure = self.figure.as_ref();
        figure.map_or(&[], |figure| figure.expressions.as_slice())
    }

    /// The weights of the morphs of nodes under shares of expressions: every morph that an expression binds has what
    /// the expressions give it, added up; of the others, those of `weights` and, where it has none, those at rest.
    pub(crate) fn expressed(
        &self,
        shares: &BTreeMap<u32, f32>,
        weights: &BTreeMap<u32, Vec<f32>>,
    ) -> BTreeMap<u32, Vec<f32>> {
        let mut expressed = weights.clone();
        let expressions = self.expressions();
        if shares.is_empty() || expressions.is_empty() {
            return expressed;
        }

        // Clear what is bound.
        let binds = || expressions.iter().flat_map(|expression| &expression.morphs);
        for bind in binds() {
            let list = expressed
                .entry(bind.node)
                .or_insert_with(|| self.rest_weights_of(bind.node));
            let morph = bind.morph as usize;
            if list.len() <= morph {
                list.resize(morph + 1, 0.0);
            }
            list[morph] = 0.0;
        }

        // Add up what shows.
        for (expression, shown) in expressions.iter().zip(shown(expressions, shares)) {
            for bind in &expression.morphs {
                if let Some(list) = expressed.get_mut(&bind.node) {
                    list[bind.morph as usize] += bind.weight * shown;
                }
            }
        }
        expressed
    }

    /// The weights of a node's morphs at rest.
    fn rest_weights_of(&self, node: u32) -> Vec<f32> {
        let node = self.nodes.get(node as usize);
        let mesh = node.and_then(|node| self.meshes.get(node.mesh? as usize));
        let parts = mesh.map_or(&[][..], |mesh| &mesh.parts);
        parts
            .first()
            .map_or_else(Vec::new, |part| part.rest_weights())
    }

    /// Gives materials the base colours and the places of textures that expressions with these shares give them, by
    /// number, added up on what the file says. For a scene as it was loaded, before anything is prepared of it:
    /// [`Self::set_pose`](Scene::set_pose) leaves materials alone.
    pub fn paint_expressions(&mut self, shares: &BTreeMap<u32, f32>) {
        let Some(figure) = &self.figure else { return };
        let rest = self.materials.clone();
        for (expression, shown) in figure
            .expressions
            .iter()
            .zip(shown(&figure.expressions, shares))
        {
            for bind in &expression.colors {
                let material = bind.material as usize;
                let (color, rest) = (&mut self.materials[material].base_color, &rest[material]);
                for (i, value) in color.iter_mut().enumerate() {
                    *value += (bind.color[i] - rest.base_color[i]) * shown;
                }
            }
            for bind in &expression.textures {
                let material = bind.material as usize;
                let texture = self.materials[material].base_color_texture.as_mut();
                let rest = rest[material].base_color_texture.as_ref();
                let (Some(texture), Some(rest)) = (texture, rest) else {
                    continue;
                };
                let (now, rest) = (&mut texture.transform, &rest.transform);
                for i in 0..2 {
                    now.scale[i] += (bind.scale[i] - rest.scale[i]) * shown;
                    now.offset[i] += (bind.offset[i] - rest.offset[i]) * shown;
                }
            }
        }
        for color in self.materials.iter_mut().map(|m| &mut m.base_color) {
            *color = color.map(|value| value.clamp(0.0, 1.0));
        }
    }
}

#[cfg(test)]
mod tests;
