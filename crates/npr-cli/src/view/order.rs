//! Orders of a studio as arguments of `npr render`.

use crate::arguments::{
    AnimateArguments, CameraArguments, ExpressionShare, FilmArguments, LineArguments, LookedAt,
    PlacedVolume, Point, PoseArguments, RenderArguments, SheetArguments, Size, Switch,
    ViewArguments, VolumeArguments,
};
use crate::debug_layer::DebugLayer;
use npr_core::math::{cos_f64, sin_f64};
use npr_scene::{Bone, Posture};
use npr_view::{Face, Film, LookAt, Order, Pose};
use std::path::{Path, PathBuf};

/// The arguments of `npr render` that draw the same.
pub fn render_arguments(args: &ViewArguments, scene: &Path) -> RenderArguments {
    RenderArguments {
        scene: Some(scene.to_owned()),
        output: None,
        enlarge: 1,
        debug_layer: None,
        drawing: args.drawing.clone(),
        cache: args.cache.clone(),
    }
}

/// The arguments of `npr render` that draw an order.
pub fn order_arguments(args: &ViewArguments, scene: &Path, order: &Order) -> RenderArguments {
    let mut args = render_arguments(args, scene);
    args.debug_layer = layer_of(order);
    let drawing = &mut args.drawing;
    drawing.look.style = Some(order.style.clone());
    drawing.look.overrides.clone_from(&order.overrides);
    drawing.look.background = None;
    drawing.look.dump_style = false;
    let [width, height] = order.size;
    drawing.size = Size { width, height };
    drawing.pose = pose_arguments(&order.pose);
    let volumes = order.pose.volumes.iter().map(|text| placed(text));
    drawing.volumes.volumes.splice(..0, volumes);
    drawing.quiet = true;
    if order.swatch.is_some() {
        drawing.volumes = VolumeArguments::default();
    }
    drawing.timings = None;
    if let Some(point) = &order.viewpoint {
        drawing.camera = CameraArguments {
            eye: Some(Point(point.eye)),
            target: Some(Point(point.target)),
            up: Some(Point(point.up)),
            fov: Some(point.fov_deg),
            ortho: point.is_parallel,
            ..CameraArguments::default()
        };
    }
    args
}

/// The layer that an order shows in place of the picture.
pub fn layer_of(order: &Order) -> Option<DebugLayer> {
    DebugLayer::named(order.layer.as_deref()?)
}

/// The arguments of `npr animate` that draw a film into files of a name.
pub fn film_arguments(
    args: &ViewArguments,
    scene: &Path,
    (film, order): (&Film, &Order),
    output: &Path,
) -> AnimateArguments {
    let picture = order_arguments(args, scene, order);
    AnimateArguments {
        scene: picture.scene,
        output: Some(output.to_owned()),
        film: FilmArguments {
            frames: None,
            length: None,
            fps: film.fps,
            turntable: film.turns,
            orbit: None,
            hold: Switch::default(),
            resume: false,
        },
        lines_only: false,
        lines: LineArguments::default(),
        sheet: SheetArguments::default(),
        drawing: picture.drawing,
        cache: picture.cache,
    }
}

/// The bones that a pose turns by hand: about x first, then y, then z.
pub fn turned(pose: &Pose) -> Posture {
    let turns = pose.turns.iter().filter_map(|(name, angles)| {
        let half = angles.map(|angle| f64::from(angle).to_radians() * 0.5);
        let [(sx, cx), (sy, cy), (sz, cz)] = half.map(|half| (sin_f64(half), cos_f64(half)));
        let turn = [
            sx * cy * cz - cx * sy * sz,
            cx * sy * cz + sx * cy * sz,
            cx * cy * sz - sx * sy * cz,
            cx * cy * cz + sx * sy * sz,
        ];
        Some((Bone::named(name)?, turn.map(|value| value as f32)))
    });
    Posture {
        turns: turns.collect(),
        hips: None,
    }
}

/// A volume of a studio as the option reads it.
fn placed(text: &str) -> PlacedVolume {
    text.parse().unwrap_or_else(|_| PlacedVolume {
        name: PathBuf::from(text),
        place: None,
    })
}

/// The pose of a studio as arguments.
fn pose_arguments(pose: &Pose) -> PoseArguments {
    let expression = |(name, share): &(String, f32)| ExpressionShare {
        name: name.clone(),
        share: *share,
    };
    PoseArguments {
        clip: pose.clip.clone(),
        time: pose.time_s,
        motion: pose.motion.as_ref().map(PathBuf::from),
        pose: pose.bones.as_ref().map(PathBuf::from),
        turned: turned(pose),
        expressions: pose.face.expressions.iter().map(expression).collect(),
        look_at: pose.face.look_at.map(|look_at| match look_at {
            LookAt::Camera => LookedAt::Camera,
            LookAt::Place(place) => LookedAt::Place(Point(place)),
        }),
    }
}

fn face_of(args: &PoseArguments) -> Face {
    let mut face = Face {
        expressions: Vec::new(),
        look_at: args.look_at.map(|look_at| match look_at {
            LookedAt::Camera => LookAt::Camera,
            LookedAt::Place(place) => LookAt::Place(place.0),
        }),
    };
    for asked in &args.expressions {
        face.set_share(&asked.name, Some(asked.share));
    }
    face
}

/// The pose of a studio that arguments ask for at first.
pub fn pose_of(args: &PoseArguments) -> Pose {
    let text = |path: &PathBuf| path.to_string_lossy().into_owned();
    // A motion without a clip plays its first.
    let first = args.motion.as_ref().map(|_| "0".to_owned());
    Pose {
        clip: args.clip.clone().or(first),
        time_s: args.time,
        motion: args.motion.as_ref().map(text),
        bones: args.pose.as_ref().map(text),
        turns: Vec::new(),
        face: face_of(args),
        volumes: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vector that a quaternion turns.
    fn carried([x, y, z, w]: [f32; 4], v: [f32; 3]) -> [f32; 3] {
        let cross = |a: [f32; 3], b: [f32; 3]| {
            [
                a[1] * b[2] - a[2] * b[1],
                a[2] * b[0] - a[0] * b[2],
                a[0] * b[1] - a[1] * b[0],
            ]
        };
        let once = cross([x, y, z], v);
        let twice = cross([x, y, z], once);
        [0, 1, 2].map(|i| v[i] + 2.0 * (w * once[i] + twice[i]))
    }

    #[test]
    fn angles_turn_about_x_first_then_y_then_z() {
        let cases = [
            ([90.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ([0.0, 90.0, 0.0], [0.0, 1.0, 0.0]),
            ([0.0, 0.0, 90.0], [-1.0, 0.0, 0.0]),
            ([90.0, 90.0, 0.0], [1.0, 0.0, 0.0]),
            ([90.0, 90.0, 90.0], [0.0, 1.0, 0.0]),
            ([90.0, 0.0, 90.0], [0.0, 0.0, 1.0]),
        ];
        for (angles, wanted) in cases {
            let mut pose = Pose::default();
            pose.set_turn("head", Some(angles));
            pose.set_turn("tail", Some(angles));
            let posture = turned(&pose);
            assert_eq!(posture.turns.len(), 1);
            let up = carried(
                posture.turns[&Bone::named("head").expect("a bone")],
                [0.0, 1.0, 0.0],
            );
            let near = up
                .iter()
                .zip(wanted)
                .all(|(a, b): (&f32, f32)| (a - b).abs() < 1e-6);
            assert!(near, "{angles:?}: {up:?}, not {wanted:?}");
        }
    }
}
