//! Damaged files never panic, and what still loads is sound.

use npr_scene::testing::{
    Sheet, Vrm, avatar, gesture, lines_glb, puppet, skinned_glb, skinned_lines_glb, sparse_glb,
    wing,
};
use npr_scene::{
    Bone, Eyes, Format, Limits, MemoryResources, Pose, Posture, Scene, Swinging, load_bytes,
};
use proptest::prelude::*;

/// What happens to a few bytes of a file.
#[derive(Debug, Clone)]
enum Damage {
    Set(usize, u8),
    Flip(usize, u8),
    Cut(usize),
    Repeat(usize, usize),
}

fn damage() -> impl Strategy<Value = Damage> {
    prop_oneof![
        4 => (any::<usize>(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        4 => (any::<usize>(), 0u8..8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        2 => (any::<usize>(), b'0'..=b'9').prop_map(|(at, digit)| Damage::Set(at, digit)),
        1 => any::<usize>().prop_map(Damage::Cut),
        1 => (any::<usize>(), 1usize..40).prop_map(|(at, count)| Damage::Repeat(at, count)),
    ]
}

fn apply(file: &mut Vec<u8>, damage: &Damage) {
    if file.is_empty() {
        return;
    }
    let length = file.len();
    match *damage {
        Damage::Set(at, byte) => file[at % length] = byte,
        Damage::Flip(at, bit) => file[at % length] ^= 1 << bit,
        Damage::Cut(at) => file.truncate(at % length),
        Damage::Repeat(at, count) => {
            let start = at % length;
            let piece = file[start..length.min(start + count)].to_vec();
            file.splice(start..start, piece);
        }
    }
}

/// Lines of every mode beside a triangle.
fn drawing() -> Vec<u8> {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let lines: [(u32, &[u32]); 3] = [(1, &[0, 1, 2, 3]), (2, &[0, 1, 2]), (3, &[3, 2, 1])];
    lines_glb(&positions, &[[0, 1, 2]], &lines)
}

fn survives(mut file: Vec<u8>, format: Format, damages: &[Damage]) {
    damages.iter().for_each(|damage| apply(&mut file, damage));
    let limits = Limits {
        memory_bytes: 64 << 20,
        ..Limits::default()
    };
    if let Ok(mut scene) = load_bytes(
        "mutant",
        &file,
        Some(format),
        &MemoryResources::default(),
        &limits,
    ) {
        scene.sanity_check();
        scene.bounds_world();

        // Whatever its clips do, it stands soundly, and rests as it did.
        let rest = scene.clone();
        for clip in rest.clips.iter().chain(&played_by_itself(&rest, &limits)) {
            for time in [f32::NAN, 0.0, 0.7, clip.duration_s(), f32::INFINITY] {
                let pose = scene.pose_at(clip, time);
                let before = scene.nodes.clone();
                match scene.set_pose(&pose) {
                    Ok(()) => scene.sanity_check(),
                    Err(_) => assert!(scene.nodes == before),
                }
            }
        }
        if scene.set_pose(&acted(&rest)).is_ok() {
            scene.sanity_check();
        }
        let acted = acted(&rest);
        let swings = Swinging::default().at(&rest, 0.1, |_| acted.clone());
        let swung = Pose {
            swings,
            look_at: Some([1.0, 2.0, 3.0]),
            ..acted
        };
        if scene.set_pose(&swung).is_ok() {
            scene.sanity_check();
        }
        scene.set_pose(&Pose::default()).expect("the rest pose");
        assert!(scene.nodes == rest.nodes && scene.bounds_world() == rest.bounds_world());
    }
}

/// The clips of a scene as it plays them as a motion.
fn played_by_itself(scene: &Scene, limits: &Limits) -> Vec<npr_scene::Clip> {
    let mut played = scene.clone();
    let motions = scene.clips_of(scene, limits);
    played.clips = motions.map_or_else(|_| Vec::new(), |motions| motions.clips);
    played.sanity_check();
    played.clips
}

/// A scene with all its bones bent, and half of every expression.
fn acted(scene: &Scene) -> Pose {
    let figure = scene.figure.iter().flat_map(|figure| &figure.expressions);
    let mut pose = Pose {
        shares: (0u32..)
            .zip(figure)
            .map(|(number, _)| (number, 0.5))
            .collect(),
        ..Pose::default()
    };
    let posture = Posture {
        turns: Bone::all()
            .map(|bone| (bone, [0.1, 0.2, 0.3, 0.9]))
            .collect(),
        hips: Some([1.0, 2.0, 3.0]),
    };
    scene.bend(&mut pose, &posture);
    let mut painted = scene.clone();
    painted.paint_expressions(&pose.shares);
    painted.sanity_check();
    pose
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: ProptestConfig::default().cases.max(1000),
        ..ProptestConfig::default()
    })]

    #[test]
    fn binary_gltf(damages in prop::collection::vec(damage(), 1..5)) {
        survives(Sheet::new(3).glb(), Format::Glb, &damages);
        survives(skinned_glb(), Format::Glb, &damages);
        survives(wing(), Format::Glb, &damages);
        survives(sparse_glb(), Format::Glb, &damages);
        survives(skinned_lines_glb(), Format::Glb, &damages);
        survives(drawing(), Format::Glb, &damages);
        survives(avatar(Vrm::Zero), Format::Glb, &damages);
        survives(avatar(Vrm::One), Format::Glb, &damages);
        survives(gesture(), Format::Glb, &damages);
        survives(puppet(Vrm::Zero, Eyes::Expressions), Format::Glb, &damages);
        survives(puppet(Vrm::One, Eyes::Bones), Format::Glb, &damages);
    }

    #[test]
    fn obj(damages in prop::collection::vec(damage(), 1..5)) {
        survives(Sheet::new(3).obj(), Format::Obj, &damages);
        survives([Sheet::new(1).obj(), b"l 1 2 3\nl -1/1 -2".to_vec()].concat(), Format::Obj, &damages);
    }

    #[test]
    fn stl(damages in prop::collection::vec(damage(), 1..5)) {
        survives(Sheet::new(3).stl(), Format::Stl, &damages);
        survives(Sheet::new(3).stl_text(), Format::Stl, &damages);
    }

    #[test]
    fn ply(damages in prop::collection::vec(damage(), 1..5)) {
        survives(Sheet::new(3).ply(), Format::Ply, &damages);
        survives(Sheet::new(3).ply_big_endian(), Format::Ply, &damages);
        survives(Sheet::new(3).ply_text(), Format::Ply, &damages);
    }

    #[test]
    fn any_bytes_of_any_format(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        for format in [Format::Glb, Format::Gltf, Format::Obj, Format::Stl, Format::Ply] {
            survives(bytes.clone(), format, &[]);
        }
    }
}
