//! Scenes of toon materials.

use crate::{Object, scene_of};
use npr_mesh::testing::icosphere;
use npr_scene::{Image, Scene, TextureTransform, TextureUse, Toon, Wrap};

/// A ball of radius 1 in a toon material, orange in the light, whose coordinates run from left to right and down over
/// its front. Image 0 has four stripes, from the left: red, green, blue and white.
pub fn toon_ball(toon: Toon) -> Scene {
    let mut ball = Object::new("Ball", icosphere(5)).colored([0.8, 0.4, 0.2]);
    ball.material.toon = Some(Box::new(toon));
    let mut scene = scene_of(&[ball]);
    let part = &mut scene.meshes[0].parts[0];
    let uv = |p: &[f32; 3]| [0.5 + 0.5 * p[0], 0.5 - 0.5 * p[1]];
    part.uvs = Some(part.positions.iter().map(uv).collect());
    scene.images = vec![Image {
        name: "stripes".to_owned(),
        width: 16,
        height: 1,
        rgba: [
            [255, 0, 0, 255],
            [0, 255, 0, 255],
            [0, 0, 255, 255],
            [255, 255, 255, 255],
        ]
        .map(|color: [u8; 4]| color.repeat(4))
        .concat(),
    }];
    scene
}

/// Image 0 as it lies by a transform.
pub fn stripes(transform: TextureTransform) -> TextureUse {
    TextureUse {
        image: 0,
        uv_set: 0,
        wrap: [Wrap::Clamp; 2],
        transform,
    }
}
