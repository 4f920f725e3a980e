//! Moments of clips and motions, and figures that look: the window shows what the command draws.

use super::*;
use npr_scene::Eyes;
use npr_scene::testing::{Vrm, avatar, gesture, puppet, wing};
use npr_scene::{Limits, Posture};
use npr_view::{Cast, Face, LookAt};

/// A pose by clip and time.
fn at(clip: &str, time_s: f32) -> Pose {
    Pose {
        clip: Some(clip.to_owned()),
        time_s: Some(time_s),
        ..Pose::default()
    }
}

impl Shop {
    fn cast(&mut self) -> Cast {
        self.wait(|news| match news {
            News::Scene(_, cast) => Some(*cast),
            News::Fault(text) => panic!("{text}"),
            _ => None,
        })
    }

    /// The picture of a pose, which must be the one that the command draws.
    fn checked(
        &mut self,
        style: (&str, &[&str]),
        pose: &Pose,
        viewpoint: Option<Viewpoint>,
    ) -> Vec<u8> {
        let order = Order {
            style: style.0.to_owned(),
            pose: pose.clone(),
            size: [64, 48],
            ..order(style.1, viewpoint)
        };
        let picture = self.picture(&order);
        let png = encoder::png(order.size, &picture.rgba, false).expect("a file");
        let words = self.desk.words(&order);
        assert!(self.drawn(&words) == png, "{}", words.join(" "));
        png
    }
}

#[test]
fn moments_of_a_clip_are_those_of_the_command() {
    let mut shop = Shop::of(&[("wing.glb", &wing())], "--backend cpu --seed 3");
    let names = |cast: Cast| -> Vec<(String, f32)> {
        let clips = cast.clips.into_iter();
        clips.map(|clip| (clip.name, clip.seconds)).collect()
    };
    let clips = names(shop.cast());
    assert_eq!(
        (clips[0].0.as_str(), clips[1].0.as_str()),
        ("Beat", "Stretch")
    );
    assert!(clips.iter().all(|(_, seconds)| *seconds > 0.0));

    // Go to and fro, in a style of frames and in one of strokes, with motion lines too.
    let followed = ["motion.follow=6", "motion.ghosts=2"];
    for style in [("toon", &[][..]), ("ink", &[]), ("ink", &followed)] {
        let mut seen = Vec::new();
        for pose in [
            Pose::default(),
            at("Beat", 0.25),
            at("Stretch", 0.7),
            at("Beat", 1.0),
            at("Beat", 0.25),
            Pose::default(),
        ] {
            let viewpoint = Some(aside(false)).filter(|_| pose.clip.is_some());
            let png = shop.checked(style, &pose, viewpoint);
            seen.push(png);
        }
        assert!(seen[0] == seen[5] && seen[1] == seen[4] && seen[1] != seen[3]);
        shop.checked(style, &at("Beat", 0.5), None);
    }
}

#[test]
fn a_figure_swings_looks_and_shows_expressions_as_the_command_has_it() {
    for vrm in [Vrm::Zero, Vrm::One] {
        let files = [
            ("one.vrm", puppet(vrm, Eyes::Bones)),
            ("wave.vrma", gesture()),
        ];
        let files = files.each_ref().map(|(name, bytes)| (*name, &bytes[..]));
        let mut shop = Shop::of(&files, "--backend cpu --motion @/wave.vrma");
        let cast = shop.cast();
        let motion = shop.path("wave.vrma").to_string_lossy().into_owned();
        assert_eq!(cast.motion.as_ref(), Some(&motion));
        let clip = cast.clips[0].name.clone();
        let moved = |time_s| Pose {
            motion: Some(motion.clone()),
            ..at(&clip, time_s)
        };
        let looking = |time_s, look_at| Pose {
            face: Face {
                look_at: Some(look_at),
                ..Face::default()
            },
            ..moved(time_s)
        };
        let near = Viewpoint {
            eye: [0.4, 1.6, 0.9],
            target: [0.0, 1.4, 0.0],
            ..aside(false)
        };
        let far = Viewpoint {
            eye: [-0.7, 1.1, 0.9],
            ..near
        };
        for (pose, viewpoint) in [
            (moved(0.9), near),
            (moved(0.3), near),
            (looking(0.3, LookAt::Camera), near),
            (looking(0.3, LookAt::Camera), far),
            (looking(0.6, LookAt::Place([1.0, 2.0, 3.0])), far),
            (moved(0.9), near),
        ] {
            shop.checked(("ink", &[]), &pose, Some(viewpoint));
        }
        shop.checked(("ink", &[]), &looking(0.5, LookAt::Camera), None);
    }
}

#[test]
fn a_motion_that_is_dropped_is_played_by_the_figure() {
    let files = [
        ("one.vrm", avatar(Vrm::One)),
        ("wave.vrma", gesture()),
        ("wave.glb", gesture()),
        ("wing.glb", wing()),
    ];
    let files = files.each_ref().map(|(name, bytes)| (*name, &bytes[..]));
    let mut shop = Shop::of(&files, "--backend cpu");
    let cast = shop.cast();
    assert!(cast.clips.is_empty() && cast.expressions.contains(&"happy".to_owned()));
    let rest = shop.checked(("ink", &[]), &Pose::default(), None);
    for name in ["wave.vrma", "wave.glb"] {
        let file = shop.path(name).to_string_lossy().into_owned();
        shop.desk.open(&file);
        let cast = shop.cast();
        assert_eq!(cast.motion.as_ref(), Some(&file));
        let pose = Pose {
            motion: Some(file),
            ..at(&cast.clips[0].name, 0.5)
        };
        assert!(shop.checked(("ink", &[]), &pose, None) != rest);
        assert!(shop.desk.words(&order(&[], None))[2].ends_with("one.vrm"));
    }

    // What no figure can play is another scene.
    let wing = shop.path("wing.glb").to_string_lossy().into_owned();
    shop.desk.open(&wing);
    assert_eq!(shop.cast().motion, None);
    assert!(shop.desk.words(&order(&[], None))[2].ends_with("wing.glb"));
    let motion = shop.path("wave.vrma").to_string_lossy().into_owned();
    shop.desk.open(&motion);
    assert!(shop.fault().contains("wave.vrma"));
}

#[test]
fn a_window_starts_at_the_moment_that_is_asked_for() {
    let shop = Shop::of(
        &[("wing.glb", &wing())],
        "--backend cpu --clip 1 --time 0.5",
    );
    let asked = pose_of(&shop.desk.said.args.drawing.pose);
    assert_eq!(asked, at("1", 0.5));
    let order = Order {
        pose: asked,
        ..order(&[], None)
    };
    let words = shop.desk.words(&order)[3..].join(" ");
    assert_eq!(
        words,
        "--style ink --size 120x90 --clip=1 --time=0.5 --backend=cpu"
    );
}

#[test]
fn expressions_are_shown_as_the_command_has_them() {
    let mut shop = Shop::of(&[("one.vrm", &avatar(Vrm::One))], "--backend cpu");
    let cast = shop.cast();
    let smiling = |shares: &[(&str, f32)]| {
        let mut face = Face::default();
        for (name, share) in shares {
            face.set_share(name, Some(*share));
        }
        Pose {
            face,
            ..Pose::default()
        }
    };
    let near = Viewpoint {
        eye: [0.2, 1.5, 1.2],
        target: [0.0, 1.4, 0.0],
        ..aside(false)
    };
    let style = ("toon", &[][..]);
    let rest = shop.checked(style, &Pose::default(), Some(near));
    let mut is_seen = false;
    for name in &cast.expressions {
        for share in [1.0, 0.4] {
            let shown = shop.checked(style, &smiling(&[(name, share)]), Some(near));
            is_seen |= shown != rest;
        }
    }
    assert!(is_seen, "{cast:?}");
    let both = smiling(&[("happy", 0.5), ("blink", 0.0), ("happy", 0.25)]);
    shop.checked(style, &both, Some(near));
    assert!(shop.checked(style, &Pose::default(), Some(near)) == rest);
}

#[test]
fn joints_that_are_turned_are_drawn_by_the_command_with_the_file_that_is_saved() {
    // A head that a file turns, and an arm that is turned in the window.
    let nod = br#"{"pose":{"head":{"rotation":[0.2,0,0,1]},"leftUpperArm":{"rotation":[0,0.3,0,1]},
        "hips":{"position":[0.1,0,0]}}}"#;
    let files: [(&str, &[u8]); 2] = [("one.vrm", &avatar(Vrm::One)), ("nod.json", nod)];
    let mut shop = Shop::of(&files, "--backend cpu");
    let cast = shop.cast();
    assert!(cast.bones.contains(&"leftUpperArm".to_owned()));
    let mut pose = Pose {
        bones: Some(shop.path("nod.json").to_string_lossy().into_owned()),
        ..Pose::default()
    };
    let nodding = shop.checked(("ink", &[]), &pose, None);
    let arm = [12.3, -7.0, 61.7];
    pose.set_turn("leftUpperArm", Some(arm));
    let turned = Order {
        pose: pose.clone(),
        size: [64, 48],
        ..order(&[], None)
    };
    let picture = shop.picture(&turned);
    let png = encoder::png(turned.size, &picture.rgba, false).expect("a file");
    assert!(png != nodding);

    // The file that is saved has all of it, and draws the same in the window and by the command.
    let saved = shop.desk.save_pose(&pose).expect("a file");
    assert!(saved.ends_with("one.pose.json"), "{saved}");
    let in_file = Pose {
        bones: Some(saved.clone()),
        ..Pose::default()
    };
    assert!(shop.checked(("ink", &[]), &in_file, None) == png);
    let bytes = std::fs::read(&saved).expect("a file");
    let (posture, faults) = Posture::read(&bytes, &Limits::default()).expect("a pose");
    assert_eq!((posture.hips, faults), (Some([0.1, 0.0, 0.0]), vec![]));
    assert_eq!(posture.turns.len(), 2);
    let again = shop.desk.save_pose(&pose).expect("a file");
    assert!(again.ends_with("one-1.pose.json"), "{again}");
}
