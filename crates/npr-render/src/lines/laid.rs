//! Textures that a line model keeps for lines and fills.

use super::assembly::Assembly;
use super::model::LineModel;
use super::texture_map::TextureMap;
use npr_scene::Scene;

impl LineModel {
    /// Finds where textures lie, where that is kept for colours of lines or `fills` ask for their mean light.
    pub(super) fn lay_textures(
        &mut self,
        scene: &Scene,
        assembly: &Assembly,
        (is_kept, fills): (bool, bool),
    ) {
        if !is_kept && !fills {
            return;
        }
        let mut map = TextureMap::new(scene, assembly, &self.shape);
        self.notices.extend(map.notice.take());
        if fills {
            self.fill_lights = map.mean_lights(&self.shape);
        }
        self.map = is_kept.then_some(map);
    }
}
