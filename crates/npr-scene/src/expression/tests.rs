use super::*;
use crate::testing::{Vrm, avatar};
use crate::{Format, Limits, MemoryResources, Pose, load_bytes};
use proptest::prelude::*;

fn expression(name: &str) -> Expression {
    Expression {
        name: name.to_owned(),
        file_name: name.to_owned(),
        ..Expression::default()
    }
}

/// How much expressions show at shares.
fn shown_at(expressions: &[Expression], shares: &[f32]) -> Vec<f32> {
    shown(expressions, &(0u32..).zip(shares.iter().copied()).collect())
}

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
fn overrides_block_blend_and_add_up() {
    let blocking = Expression {
        of_blinks: Override::Block,
        of_mouths: Override::Blend,
        ..expression("happy")
    };
    let blending = Expression {
        of_mouths: Override::Blend,
        of_looks: Override::Block,
        ..expression("sad")
    };
    let all = [
        blocking,
        blending,
        expression("blinkLeft"),
        expression("aa"),
        expression("lookUp"),
        expression("own"),
    ];
    let at = |shares| shown_at(&all, shares);
    assert_eq!(
        at(&[0.0, 0.0, 1.0, 1.0, 1.0, 1.0]),
        [0.0, 0.0, 1.0, 1.0, 1.0, 1.0]
    );
    assert_eq!(
        at(&[0.25, 0.0, 1.0, 1.0, 1.0, 1.0]),
        [0.25, 0.0, 0.0, 0.75, 1.0, 1.0]
    );
    assert_eq!(
        at(&[0.25, 0.25, 1.0, 0.5, 1.0, 1.0]),
        [0.25, 0.25, 0.0, 0.25, 0.0, 1.0]
    );
    assert_eq!(
        at(&[0.75, 0.75, 1.0, 1.0, 0.5, 1.0]),
        [0.75, 0.75, 0.0, 0.0, 0.0, 1.0]
    );
}

#[test]
fn a_binary_expression_shows_whole_or_not() {
    let binary = |name: &str| Expression {
        is_binary: true,
        ..expression(name)
    };
    let mouthy = Expression {
        of_mouths: Override::Blend,
        ..binary("happy")
    };
    let all = [mouthy, binary("aa"), expression("oh")];
    assert_eq!(shown_at(&all, &[0.5, 0.51, 0.4]), [0.0, 1.0, 0.4]);
    assert_eq!(shown_at(&all, &[0.6, 0.9, 1.0]), [1.0, 0.0, 0.0]);
    let half = Expression {
        of_mouths: Override::Blend,
        ..expression("sad")
    };
    assert_eq!(shown_at(&[half, binary("aa")], &[0.1, 1.0]), [0.1, 0.0]);
}

proptest! {
    #[test]
    fn without_overrides_everything_shows_at_its_share(shares in prop::collection::vec(-1f32..2.0, 5)) {
        let all = ["blink", "aa", "lookUp", "own", "happy"].map(expression);
        let wanted: Vec<f32> = shares.iter().map(|share| share.clamp(0.0, 1.0)).collect();
        prop_assert_eq!(shown_at(&all, &shares), wanted);
        prop_assert_eq!(shown_at(&all[..2], &[f32::NAN]), [0.0, 0.0]);
    }
}

#[test]
fn names_count_in_any_letter_case_and_as_vrm_0_had_them() {
    let own = Expression {
        file_name: "Grin".to_owned(),
        ..expression("happy")
    };
    let all = [
        own,
        expression("Joy"),
        expression("blinkLeft"),
        expression("Ärger"),
        expression("JOY"),
    ];
    let found = |name| find(&all, name);
    assert_eq!(
        [found("happy"), found("HAPPY"), found("grin")],
        [Some(0); 3]
    );
    assert_eq!(
        [found("Joy"), found("joy"), found("JOY")],
        [Some(1), Some(1), Some(4)]
    );
    assert_eq!(
        [found("Blink_L"), found("blinkleft"), found("äRGER")],
        [Some(2), Some(2), Some(3)]
    );
    assert_eq!([found("blink"), found(""), found("fun")], [None; 3]);
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
