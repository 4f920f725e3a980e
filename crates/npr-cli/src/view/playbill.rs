//! What of a scene can move, and which files are motions for it.

use crate::arguments::ExpressionShare;
use crate::ending::has_ending;
use crate::fault::Fault;
use crate::pose;
use crate::render::has_moving_pictures;
use crate::source::{Loaded, Source};
use npr_scene::{Figure, Limits, Material, Scene};
use npr_view::{Cast, Clip};
use std::path::Path;

/// What of a scene can move, which may play a motion.
pub fn cast_of(scene: &Scene, motion: Option<&Path>, has_own_camera: bool) -> Cast {
    let clips = scene.clips.iter().enumerate();
    let clips = clips.map(|(number, clip)| {
        // The first of a name is found by it.
        let first = scene.clips.iter().position(|other| other.name == clip.name);
        let is_told = first == Some(number) && !clip.name.is_empty();
        Clip {
            name: match is_told {
                true => clip.name.clone(),
                false => number.to_string(),
            },
            seconds: clip.duration_s(),
        }
    });
    let faces = scene.figure.iter().flat_map(|figure| &figure.expressions);
    Cast {
        clips: clips.collect(),
        flows: has_moving_pictures(scene),
        expressions: faces.map(|face| face.name.clone()).collect(),
        bones: scene
            .bones()
            .keys()
            .map(|bone| bone.name().to_owned())
            .collect(),
        can_look: scene.figure.as_ref().is_some_and(Figure::can_look),
        motion: motion.map(|path| path.to_string_lossy().into_owned()),
        has_lights: !scene.lights.is_empty(),
        has_own_camera,
    }
}

/// The materials of a scene as it was loaded, in the colours of expressions.
pub fn painted(expressions: &[ExpressionShare], scene: &Scene) -> Result<Vec<Material>, Fault> {
    let mut painted = Scene {
        materials: scene.materials.clone(),
        figure: scene.figure.clone(),
        ..Scene::default()
    };
    pose::paint(expressions, &mut painted)?;
    Ok(painted.materials)
}

/// Whether a file is opened as a motion for the figure of a scene: a VRM animation always, a glTF file where the figure
/// can play its clips.
pub fn is_motion(path: &Path, loaded: Option<&Loaded>, limits: &Limits) -> bool {
    if has_ending(path, "vrma") {
        return loaded.is_some();
    }
    let figure = loaded.filter(|loaded| loaded.scene.figure.is_some());
    let Some(figure) = figure.filter(|_| has_ending(path, "glb") || has_ending(path, "gltf"))
    else {
        return false;
    };
    let limits = Limits {
        decode_images: false,
        ..*limits
    };
    let motion = Source::of(path).load(&limits, None);
    let played = motion.map(|motion| figure.scene.clips_of(&motion.scene, &limits));
    matches!(played, Ok(Ok(played)) if !played.clips.is_empty())
}
