//! What a scene contains, to tell which keys of a style cannot act.

use npr_scene::{Bone, Part, Scene};
use npr_stylesheet::Facts;

/// Lists which of the things that keys of styles refer to a scene contains; `smoke` says whether it has smoke.
pub fn facts_of(scene: &Scene, smoke: bool) -> Facts {
    let parts = || scene.meshes.iter().flat_map(|mesh| &mesh.parts);
    let is_drawn = |part: &Part| !part.triangles.is_empty() || !part.segments.is_empty();
    let mut materials = scene.materials.iter();
    Facts {
        surfaces: parts().any(is_drawn),
        smoke,
        textures: materials.any(|material| material.base_color_texture.is_some()),
        vertex_colors: parts().any(|part| part.colors.is_some()),
        lights: !scene.lights.is_empty(),
        faces: !scene.skins.is_empty() && scene.bones().contains_key(&Bone::HEAD),
        toons: scene
            .materials
            .iter()
            .any(|material| material.toon.is_some()),
        clips: !scene.clips.is_empty(),
    }
}
