use super::*;
use crate::testing::{Vrm, avatar};
use crate::{Format, Limits, MemoryResources, Pose, load_bytes};

fn loaded(vrm: Vrm) -> Scene {
    let (bytes, resources) = (avatar(vrm), MemoryResources::default());
    let scene = load_bytes(
        "avatar",
        &bytes,
        Some(Format::Glb),
        &resources,
        &Limits::default(),
    );
    let scene = scene.expect("a sound file");
    scene.sanity_check();
    scene
}

/// The weights of the face under shares by name.
fn face(scene: &Scene, shares: &[(&str, f32)]) -> Vec<f32> {
    let figure = scene.figure.as_ref().expect("an avatar");
    let number = |name| figure.expression(name).expect("an expression");
    let pose = Pose {
        shares: shares
            .iter()
            .map(|(name, share)| (number(name), *share))
            .collect(),
        ..Pose::default()
    };
    let mut posed = scene.clone();
    posed.set_pose(&pose).expect("in range");
    let mesh = posed.nodes[2].mesh.expect("a face") as usize;
    let morphs = &posed.meshes[mesh].parts[0].morphs;
    morphs.iter().map(|morph| morph.applied_weight).collect()
}

#[test]
fn both_versions_make_the_same_faces() {
    let [old, new] = [Vrm::Zero, Vrm::One].map(loaded);
    for scene in [&old, &new] {
        assert_eq!(face(scene, &[("happy", 1.0)]), [0.5, 0.0]);
        assert_eq!(face(scene, &[("joy", 0.5), ("aa", 0.0)]), [0.25, 0.0]);
        assert_eq!(face(scene, &[("BLINK", 0.4)]), [0.0, 0.0]);
        assert_eq!(face(scene, &[("blink", 0.6), ("a", 0.5)]), [0.5, 1.0]);
        assert_eq!(face(scene, &[("wink", 1.0)]), [0.0, 0.7]);
    }
    // Overrides came with VRM 1.0.
    let both = [("happy", 0.5), ("blink", 1.0), ("aa", 1.0)];
    assert_eq!(face(&old, &both), [1.25, 1.0]);
    assert_eq!(face(&new, &both), [0.75, 0.0]);
}

#[test]
fn expressions_alone_decide_on_what_they_bind() {
    let mut scene = loaded(Vrm::One);
    let bound = Pose {
        weights: BTreeMap::from([(2, vec![0.9, 0.8])]),
        ..Pose::default()
    };
    let weights = |shares: BTreeMap<u32, f32>| scene.expressed(&shares, &bound.weights)[&2].clone();
    let happy = scene
        .figure
        .as_ref()
        .and_then(|figure| figure.expression("happy"))
        .expect("it");
    assert_eq!(weights(BTreeMap::new()), [0.9, 0.8]);
    assert_eq!(weights([(happy, 1.0)].into()), [0.5, 0.0]);
    assert_eq!(weights([(happy, 0.0)].into()), [0.0, 0.0]);

    // What none binds stays.
    let figure = scene.figure.as_mut().expect("an avatar");
    let binds = figure.expressions.iter_mut().flat_map(|e| &mut e.morphs);
    binds.for_each(|bind| bind.morph = 0);
    let weights = scene.expressed(&[(happy, 1.0)].into(), &bound.weights)[&2].clone();
    assert_eq!(weights, [0.5, 0.8]);
}

#[test]
fn colours_and_textures_go_part_of_the_way() {
    for vrm in [Vrm::Zero, Vrm::One] {
        let mut scene = loaded(vrm);
        let happy = scene
            .figure
            .as_ref()
            .and_then(|figure| figure.expression("happy"))
            .expect("it");
        scene.paint_expressions(&BTreeMap::new());
        assert_eq!(scene.materials[0].base_color, [0.2, 0.6, 0.5, 1.0]);
        scene.paint_expressions(&[(happy, 0.5)].into());
        let wanted = [0.6, 0.3, 0.25, 1.0];
        let apart = wanted
            .iter()
            .zip(scene.materials[0].base_color)
            .map(|(a, b)| (a - b).abs());
        assert!(
            apart.fold(0.0, f32::max) < 1e-6,
            "{:?}",
            scene.materials[0].base_color
        );
    }
}
