//! Orders of a studio as arguments of `npr render`.

use crate::arguments::{
    AnimateArguments, CameraArguments, ExpressionShare, FilmArguments, LineArguments, LookedAt,
    Point, PoseArguments, RenderArguments, SheetArguments, Size, Switch, ViewArguments,
};
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
    let drawing = &mut args.drawing;
    drawing.look.style = Some(order.style.clone());
    drawing.look.overrides.clone_from(&order.overrides);
    drawing.look.background = None;
    drawing.look.dump_style = false;
    let [width, height] = order.size;
    drawing.size = Size { width, height };
    drawing.pose = pose_arguments(&order.pose);
    drawing.quiet = true;
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
        face: face_of(args),
    }
}
