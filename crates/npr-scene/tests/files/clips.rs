//! Animations of glTF files: what is sound is played, what is broken is told of, and the file is drawn in any case.

use npr_scene::testing::glb;
use npr_scene::{Format, Limits, MemoryResources, Pose, Property, Scene, SceneError, load_bytes};

fn load_within(bytes: &[u8], limits: &Limits) -> Result<Scene, SceneError> {
    let resources = MemoryResources::default();
    let scene = load_bytes("test", bytes, Some(Format::Glb), &resources, limits)?;
    scene.sanity_check();
    Ok(scene)
}

/// A triangle on a leg of two nodes, with two morphs and one animation.
struct Leg<'a> {
    nodes: &'a str,
    times: &'a [f32],
    values: &'a [f32],
    /// Type of the values, such as `VEC3`.
    width: &'a str,
    samplers: &'a str,
    channels: &'a str,
    /// Behind the accessors.
    accessors: &'a str,
    bin: &'a [u8],
    extra: &'a str,
}

impl Default for Leg<'_> {
    fn default() -> Self {
        Self {
            nodes: r#"{"children":[1]},{"mesh":0,"translation":[1,0,0]}"#,
            times: &[0.5, 1.0],
            values: &[0.0, 0.0, 0.0, 2.0, 4.0, 6.0],
            width: "VEC3",
            samplers: r#"{"input":1,"output":2}"#,
            channels: r#"{"sampler":0,"target":{"node":1,"path":"translation"}}"#,
            accessors: "",
            bin: &[],
            extra: "",
        }
    }
}

const WEIGHTS: &str = r#"{"sampler":0,"target":{"node":1,"path":"weights"}}"#;

impl Leg<'_> {
    fn glb(&self) -> Vec<u8> {
        let positions = [0f32, 0., 0., 1., 0., 0., 0., 1., 0.];
        let numbers = positions.iter().chain(self.times).chain(self.values);
        let mut bin: Vec<u8> = numbers.flat_map(|number| number.to_le_bytes()).collect();
        let (times, values) = (self.times.len(), self.values.len());
        let start = bin.len();
        bin.extend(self.bin);
        let width = match self.width {
            "SCALAR" => 1,
            "VEC3" => 3,
            _ => 4,
        };
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},
            "targets":[{{"POSITION":0}},{{"POSITION":0}}]}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},
            {{"bufferView":0,"byteOffset":36,"componentType":5126,"count":{times},"type":"SCALAR"}},
            {{"bufferView":0,"byteOffset":{},"componentType":5126,"count":{},"type":"{}"}}{}],
            "bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{start},"byteLength":{}}}],
            "buffers":[{{"byteLength":{}}}],
            "animations":[{{"name":"step","samplers":[{}],"channels":[{}]}}]{}}}"#,
            self.nodes,
            36 + 4 * times,
            values / width,
            self.width,
            self.accessors,
            bin.len(),
            self.bin.len(),
            bin.len(),
            self.samplers,
            self.channels,
            self.extra,
        );
        glb(&json, &bin)
    }

    fn load(&self) -> Scene {
        let scene = load_within(&self.glb(), &Limits::default()).expect("a file that can be drawn");
        assert_eq!(scene.triangle_count(), 1);
        scene
    }

    /// Asserts that the animation has no channel left, and that this is all that is said.
    #[track_caller]
    fn assert_broken(&self, fault: &str) {
        let mut scene = self.load();
        let said: Vec<&str> = scene
            .notices
            .iter()
            .map(|notice| notice.text.as_str())
            .collect();
        assert_eq!(said, [format!("animation 0 is broken: {fault}")]);
        assert_eq!((scene.clips.len(), scene.clips[0].channels.len()), (1, 0));

        // It rests at all times.
        let (pose, rest) = (scene.pose_at(&scene.clips[0], 0.7), scene.clone());
        assert_eq!(pose, Pose::default());
        scene.set_pose(&pose).expect("the rest pose");
        assert_eq!(scene, rest);
    }
}

/// Where the triangle's first corner stands at a time of the clip.
fn corner_at(scene: &Scene, time_s: f32) -> [f32; 3] {
    let mut posed = scene.clone();
    posed
        .set_pose(&scene.pose_at(&scene.clips[0], time_s))
        .expect("in range");
    posed.sanity_check();
    let (node, part) = posed.drawn_parts().next().expect("a triangle");
    posed.positions_world(node, part)[0]
}

#[test]
fn a_clip_moves_its_node_and_clamps_at_both_ends() {
    let scene = Leg::default().load();
    let clip = &scene.clips[0];
    assert_eq!((clip.name.as_str(), clip.duration_s()), ("step", 1.0));
    assert_eq!(scene.notices, []);
    assert_eq!(corner_at(&scene, 0.0), [0.0; 3]);
    assert_eq!(corner_at(&scene, 0.75), [1.0, 2.0, 3.0]);
    assert_eq!(corner_at(&scene, 99.0), [2.0, 4.0, 6.0]);
}

#[test]
fn normalised_integers_and_sparse_keys_are_read() {
    // Two quaternions in signed bytes: none, and half a turn about y.
    let bytes: [i8; 8] = [0, 0, 0, 127, 0, -127, 0, 0];
    let bytes = bytes.map(|byte| byte as u8);
    let scene = Leg {
        accessors: r#",{"bufferView":1,"componentType":5120,"normalized":true,"count":2,"type":"VEC4"}"#,
        bin: &bytes,
        samplers: r#"{"input":1,"output":3,"interpolation":"STEP"}"#,
        channels: r#"{"sampler":0,"target":{"node":1,"path":"rotation"}}"#,
        ..Leg::default()
    }
    .load();
    assert_eq!(
        &*scene.clips[0].channels[0].values,
        [0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0]
    );

    // Of three moves only the last is not nought.
    let mut bin = 2u32.to_le_bytes().to_vec();
    bin.extend(
        [7f32, 8.0, 9.0]
            .iter()
            .flat_map(|number| number.to_le_bytes()),
    );
    let scene = Leg {
        times: &[0.0, 1.0, 2.0],
        accessors: r#",{"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,
            "indices":{"bufferView":1,"componentType":5125},
            "values":{"bufferView":1,"byteOffset":4}}}"#,
        bin: &bin,
        samplers: r#"{"input":1,"output":3}"#,
        ..Leg::default()
    }
    .load();
    assert_eq!(corner_at(&scene, 1.5), [3.5, 4.0, 4.5]);
}

#[test]
fn weights_are_one_for_each_morph() {
    let leg = Leg {
        values: &[0.0, 1.0, 0.5, 0.0],
        width: "SCALAR",
        channels: WEIGHTS,
        ..Leg::default()
    };
    let scene = leg.load();
    assert_eq!(scene.clips[0].channels[0].property, Property::Weights);
    assert_eq!(scene.clips[0].channels[0].width(), 2);
    let pose = scene.pose_at(&scene.clips[0], 0.75);
    assert_eq!(pose.weights[&1], [0.25, 0.5]);
    let mut posed = scene.clone();
    posed.set_pose(&pose).expect("in range");
    let part = &posed.meshes[0].parts[0];
    assert_eq!(part.positions[1], [1.75, 0.0, 0.0]);

    // Two nodes with one mesh bend it each by itself where a clip bends one of them.
    let shared = Leg {
        nodes: r#"{"children":[1,2]},{"mesh":0,"translation":[1,0,0]},{"mesh":0}"#,
        ..leg
    };
    let scene = load_within(&shared.glb(), &Limits::default()).expect("two triangles");
    assert_eq!(
        (scene.meshes.len(), scene.nodes[1].mesh, scene.nodes[2].mesh),
        (2, Some(0), Some(1))
    );
}

#[test]
fn broken_keys_are_left_out_by_name() {
    let nan = f32::NAN;
    let cases: [(&[f32], &str); 6] = [
        (&[nan, 1.0], "sampler 0 has times that are not finite"),
        (
            &[0.0, f32::INFINITY],
            "sampler 0 has times that are not finite",
        ),
        (&[1.0, 0.5], "sampler 0 has times that do not ascend"),
        (&[1.0, 1.0], "sampler 0 has times that do not ascend"),
        (&[-0.5, 1.0], "sampler 0 has times below 0"),
        (
            &[0.0, 0.5, 1.0],
            "channel 0 has 2 values where 3 are needed",
        ),
    ];
    for (times, fault) in cases {
        Leg {
            times,
            ..Leg::default()
        }
        .assert_broken(fault);
    }
    Leg {
        values: &[0.0, nan, 0.0, 1.0, 2.0, 3.0],
        ..Leg::default()
    }
    .assert_broken("sampler 0 has values that are not finite");
    Leg {
        times: &[],
        values: &[],
        ..Leg::default()
    }
    .assert_broken("sampler 0 has no keys");
    Leg {
        samplers: r#"{"input":1,"output":2,"interpolation":"CUBICSPLINE"}"#,
        ..Leg::default()
    }
    .assert_broken("channel 0 has 2 values where 6 are needed");
}

#[test]
fn broken_targets_are_left_out_by_name() {
    let cases = [
        (
            r#"{"sampler":0,"target":{"path":"scale"}}"#,
            "channel 0 moves no node",
        ),
        (
            r#"{"sampler":0,"target":{"node":9,"path":"scale"}}"#,
            "channel 0 moves node 9, but there are only 2",
        ),
        (
            r#"{"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{}}}}"#,
            "channel 0 moves no node",
        ),
    ];
    for (channels, fault) in cases {
        Leg {
            channels,
            ..Leg::default()
        }
        .assert_broken(fault);
    }
    Leg {
        nodes: r#"{"children":[1]},{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,1,0,0,1]}"#,
        ..Leg::default()
    }
    .assert_broken("channel 0 moves node 1, which has a matrix");
    let weights = Leg {
        values: &[0.0, 1.0, 0.5],
        width: "SCALAR",
        channels: WEIGHTS,
        ..Leg::default()
    };
    weights.assert_broken("channel 0 has 3 values where 4 are needed");
    Leg {
        channels: r#"{"sampler":0,"target":{"node":0,"path":"weights"}}"#,
        ..weights
    }
    .assert_broken("channel 0 moves weights of node 0, which has no morphs");
}

#[test]
fn of_two_channels_on_one_target_the_first_is_played() {
    let channel = r#"{"sampler":0,"target":{"node":1,"path":"translation"}}"#;
    let scale = r#"{"sampler":0,"target":{"node":1,"path":"scale"}}"#;
    let channels = [channel, scale, channel].join(",");
    let scene = Leg {
        channels: &channels,
        ..Leg::default()
    }
    .load();
    assert_eq!(scene.clips[0].channels.len(), 2);
    assert_eq!(
        scene.notices[0].text,
        "animation 0 is broken: channel 2 moves what channel 0 moves"
    );
}

#[test]
fn animations_that_cannot_be_read_at_all_leave_the_file_at_rest() {
    for samplers in [r#"{"input":1}"#, r#"{"input":"x","output":2}"#, "7"] {
        let scene = Leg {
            samplers,
            ..Leg::default()
        }
        .load();
        assert_eq!(scene.clips, []);
        let told = "the animations of the file cannot be read, and nothing moves";
        assert_eq!(scene.notices[0].text, told);
    }
}

#[test]
fn channels_that_share_keys_share_memory_and_keys_are_counted() {
    let keys = 100_000usize;
    let times: Vec<f32> = (0..keys).map(|key| key as f32).collect();
    let values = vec![0.5; 3 * keys];
    let samplers = vec![r#"{"input":1,"output":2}"#; 500].join(",");
    let channels: Vec<String> = (0..500)
        .map(|index| {
            format!(
                r#"{{"sampler":{index},"target":{{"node":{},"path":"translation"}}}}"#,
                index + 1
            )
        })
        .collect();
    let nodes: Vec<String> = (0..500).map(|_| r#"{"mesh":0}"#.to_owned()).collect();
    let children: Vec<String> = (1..=500).map(|child| child.to_string()).collect();
    let nodes = format!(
        r#"{{"children":[{}]}},{}"#,
        children.join(","),
        nodes.join(",")
    );
    let file = Leg {
        nodes: &nodes,
        times: &times,
        values: &values,
        samplers: &samplers,
        channels: &channels.join(","),
        ..Leg::default()
    }
    .glb();

    // Two lists of keys take 1.6 MB, however many channels use them.
    let limits = |memory_bytes| Limits {
        memory_bytes,
        ..Limits::default()
    };
    let scene = load_within(&file, &limits(2 << 20)).expect("enough memory");
    assert_eq!(scene.clips[0].channels.len(), 500);
    let fault = load_within(&file, &limits(1 << 20)).expect_err("too little memory");
    assert!(
        fault.is_limit() && fault.to_string().contains("--memory-limit"),
        "{fault}"
    );
}

#[test]
fn a_skin_of_10000_joints_is_posed() {
    let count = 10_000u32;
    let bones: Vec<String> = (1..=count).map(|_| "{}".to_owned()).collect();
    let children: Vec<String> = (1..=count).map(|child| child.to_string()).collect();
    let nodes = format!(
        r#"{{"children":[{}],"mesh":0,"skin":0}},{}"#,
        children.join(","),
        bones.join(",")
    );
    let extra = format!(r#","skins":[{{"joints":[{}]}}]"#, children.join(","));
    let channel = format!(r#"{{"sampler":0,"target":{{"node":{count},"path":"translation"}}}}"#);
    let scene = Leg {
        nodes: &nodes,
        channels: &channel,
        extra: &extra,
        ..Leg::default()
    }
    .load();
    // The triangle names no joints, and rests; the last joint moves.
    let mut posed = scene.clone();
    posed
        .set_pose(&scene.pose_at(&scene.clips[0], 2.0))
        .expect("in range");
    assert_eq!(
        posed.nodes[count as usize].world_from_node[3],
        [2.0, 4.0, 6.0, 1.0]
    );
    assert_eq!(corner_at(&scene, 2.0), [0.0; 3]);
}

#[test]
fn a_clip_that_carries_its_mesh_out_of_range_is_refused_when_it_is_played() {
    let mut scene = Leg {
        values: &[0.0, 0.0, 0.0, 1e30, 0.0, 0.0],
        ..Leg::default()
    }
    .load();
    let rest = scene.clone();
    let far = scene.pose_at(&scene.clips[0], 2.0);
    scene.set_pose(&far).expect_err("out of range");
    assert_eq!(scene, rest);
}
