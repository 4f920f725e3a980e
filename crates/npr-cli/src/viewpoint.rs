//! Chooses the camera of a picture.

use crate::arguments::{CameraArguments, Size};
use crate::fault::{Exit, Fault};
use crate::message;
use npr_core::camera::{Camera, DEFAULT_FOV_DEG, Projection, THREE_QUARTERS};
use npr_core::standard_view::StandardView;
use npr_render::{LineModel, Model, Smoke};
use std::borrow::Cow;

/// Most cameras that a message lists.
const LISTED_CAMERAS: usize = 5;

/// A scene that a camera can be chosen for.
pub trait Viewed {
    /// Cameras of the file with their names.
    fn cameras(&self) -> &[(String, Camera)];
    /// Lowest and highest corner of the bounding box, in world space.
    fn bounds(&self) -> ([f32; 3], [f32; 3]);
    /// A view of all of it, for a frame of width / height `aspect` and a vertical field of view in radians.
    fn framing(&self, aspect: f32, fov_y: f32) -> Camera;
    /// The same of all that it sweeps where the camera turns about an axis, given by a point on it and its direction.
    fn framing_around(&self, axis: [[f32; 3]; 2], view: (f32, f32)) -> Camera;
    /// Places where something is seen, for views from other sides.
    fn places(&self) -> Vec<[f32; 3]>;
}

impl Viewed for LineModel {
    fn cameras(&self) -> &[(String, Camera)] {
        self.cameras()
    }

    fn bounds(&self) -> ([f32; 3], [f32; 3]) {
        self.bounds()
    }

    fn framing(&self, aspect: f32, fov_y: f32) -> Camera {
        self.framing(aspect, fov_y)
    }

    fn framing_around(&self, axis: [[f32; 3]; 2], view: (f32, f32)) -> Camera {
        self.framing_around(axis, view)
    }

    fn places(&self) -> Vec<[f32; 3]> {
        self.places().collect()
    }
}

/// A model together with smoke.
pub struct Seen<'a> {
    /// The model.
    pub model: Cow<'a, Model>,
    /// The smoke, perhaps none.
    pub smoke: Cow<'a, Smoke>,
}

impl Viewed for Seen<'_> {
    fn cameras(&self) -> &[(String, Camera)] {
        self.model.cameras()
    }

    fn bounds(&self) -> ([f32; 3], [f32; 3]) {
        self.model.bounds_with(&self.smoke)
    }

    fn framing(&self, aspect: f32, fov_y: f32) -> Camera {
        self.model.framing_with(&self.smoke, aspect, fov_y)
    }

    fn framing_around(&self, axis: [[f32; 3]; 2], view: (f32, f32)) -> Camera {
        self.model.framing_around(&self.smoke, axis, view)
    }

    fn places(&self) -> Vec<[f32; 3]> {
        self.model.places_with(&self.smoke).collect()
    }
}

/// A scene in all poses of a film.
pub struct Staged<'a> {
    /// Cameras of the file with their names.
    pub cameras: &'a [(String, Camera)],
    /// Places where something is seen, and the box around them.
    pub points: &'a [[f32; 3]],
    /// Lowest and highest corner.
    pub bounds: ([f32; 3], [f32; 3]),
}

impl Viewed for Staged<'_> {
    fn cameras(&self) -> &[(String, Camera)] {
        self.cameras
    }

    fn bounds(&self) -> ([f32; 3], [f32; 3]) {
        self.bounds
    }

    fn framing(&self, aspect: f32, fov_y: f32) -> Camera {
        Camera::framing_points(self.points.iter().copied(), aspect, fov_y)
    }

    fn framing_around(&self, [pivot, axis]: [[f32; 3]; 2], (aspect, fov_y): (f32, f32)) -> Camera {
        let points = self.points.iter().copied().map(Into::into);
        let swept = npr_core::camera::swept(points, pivot, axis);
        Camera::framing_points(swept.into_iter(), aspect, fov_y)
    }

    fn places(&self) -> Vec<[f32; 3]> {
        self.points.to_vec()
    }
}

/// A camera that turns about an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// The camera before it turns.
    camera: Camera,
    /// A point on the axis.
    pivot: [f32; 3],
    /// Its direction.
    axis: [f32; 3],
}

impl Orbit {
    /// A camera that stands still.
    pub fn still(camera: Camera) -> Self {
        Self {
            camera,
            pivot: camera.target,
            axis: camera.up,
        }
    }

    /// The camera after it has turned by `angle` radians, counter-clockwise as seen from above.
    pub fn at(&self, angle: f32) -> Camera {
        self.camera.turned(self.pivot, self.axis, angle)
    }
}

/// The camera that the user asked for, turning about the up axis through its target; without one, the scene is framed
/// so that it stays in the picture all around. A camera of the file has no target: it turns about the middle of the
/// scene, whose up is +y.
pub fn orbit(args: &CameraArguments, model: &dyn Viewed, size: Size) -> Result<Orbit, Fault> {
    let middle = middle(model.bounds());
    let pivot = args.target.map_or(middle, |target| target.0);
    let axis = args.up.map_or([0.0, 1.0, 0.0], |up| up.0);
    let camera = match &args.camera {
        Some(name) => camera_of_file(name, model.cameras())?,
        None => placed_camera(
            args,
            framing_around(args, model, [pivot, axis], size),
            middle,
        )?,
    };
    Ok(Orbit {
        camera,
        pivot,
        axis,
    })
}

/// Width / height of the frame, and the vertical field of view in radians.
fn shape(args: &CameraArguments, size: Size) -> (f32, f32) {
    (size.width as f32 / size.height as f32, fov_of(args))
}

/// The vertical field of view in radians.
fn fov_of(args: &CameraArguments) -> f32 {
    args.fov.unwrap_or(DEFAULT_FOV_DEG).to_radians()
}

/// The camera that the user asked for, or one that frames the whole model from three quarters above.
pub fn camera(args: &CameraArguments, model: &dyn Viewed, size: Size) -> Result<Camera, Fault> {
    match &args.camera {
        Some(name) => camera_of_file(name, model.cameras()),
        None => placed_camera(args, framing(args, model, size), middle(model.bounds())),
    }
}

/// A view of the whole model, from the side and in the projection that the user asked for.
fn framing(args: &CameraArguments, model: &dyn Viewed, size: Size) -> Camera {
    let (aspect, fov_y) = shape(args, size);
    match (args.view, args.ortho) {
        (None, false) => model.framing(aspect, fov_y),
        _ => from_side(args, model.places(), (aspect, fov_y)),
    }
}

/// The same of all that the model sweeps where the camera turns about an axis.
fn framing_around(
    args: &CameraArguments,
    model: &dyn Viewed,
    axis: [[f32; 3]; 2],
    size: Size,
) -> Camera {
    let view = shape(args, size);
    if args.view.is_none() && !args.ortho {
        return model.framing_around(axis, view);
    }
    let places = model.places().into_iter().map(Into::into);
    let places: Vec<_> = places.collect();
    let swept = npr_core::camera::swept(places.into_iter(), axis[0], axis[1]);
    from_side(args, swept, view)
}

/// A view of places from a side other than the usual one, or in parallel.
fn from_side(args: &CameraArguments, places: Vec<[f32; 3]>, (aspect, fov_y): (f32, f32)) -> Camera {
    let sides = args.view.map_or(THREE_QUARTERS, StandardView::sides);
    let places = places.into_iter();
    match args.ortho {
        true => Camera::framing_parallel(places, sides, aspect, fov_y),
        false => Camera::framing_points_from(places, sides, aspect, fov_y),
    }
}

/// A camera by name, or else by its number from 0.
fn camera_of_file(asked: &str, cameras: &[(String, Camera)]) -> Result<Camera, Fault> {
    let named = cameras.iter().find(|(name, _)| name == asked);
    let numbered = || cameras.get(asked.parse::<usize>().ok()?);
    named
        .or_else(numbered)
        .map(|(_, camera)| *camera)
        .ok_or_else(|| unknown_camera(asked, cameras))
}

/// The fault for a camera name or number that `cameras` do not have.
pub fn unknown_camera(asked: &str, cameras: &[(String, Camera)]) -> Fault {
    let listed: Vec<String> = cameras
        .iter()
        .take(LISTED_CAMERAS)
        .map(|(name, _)| format!("'{}'", message::name(name)))
        .collect();
    let there_are = match cameras.len() {
        0 => "it has none".to_owned(),
        1..=LISTED_CAMERAS => format!("it has {}", listed.join(", ")),
        count => format!("it has {count}, such as {}", listed.join(", ")),
    };
    let asked = message::name(asked);
    Fault::new(
        Exit::Usage,
        format!("the scene has no camera '{asked}'; {there_are}"),
    )
}

/// The camera `framing` with the arguments in place of its own values. An eye without a target looks at `middle`.
fn placed_camera(
    args: &CameraArguments,
    framing: Camera,
    middle: [f32; 3],
) -> Result<Camera, Fault> {
    // Replace the values that the user gave.
    let target = if args.eye.is_some() {
        middle
    } else {
        framing.target
    };
    let camera = Camera {
        eye: args.eye.map_or(framing.eye, |eye| eye.0),
        target: args.target.map_or(target, |target| target.0),
        up: args.up.map_or(framing.up, |up| up.0),
        projection: match args.ortho {
            true => Projection::Perspective {
                fov_y: fov_of(args),
            },
            false => framing.projection,
        },
    };

    // Refuse to look from a point at itself.
    if camera.eye == camera.target {
        let [x, y, z] = camera.eye;
        let message = format!("eye and target are the same point {x},{y},{z}");
        return Err(Fault::new(Exit::Usage, message));
    }
    Ok(match args.ortho {
        true => camera.in_parallel(),
        false => camera,
    })
}

/// The middle of a box.
fn middle((min, max): ([f32; 3], [f32; 3])) -> [f32; 3] {
    std::array::from_fn(|axis| (min[axis] + max[axis]) * 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arguments::Point;

    /// A view with an eye of its own, of a box whose middle is (1, 1, 1).
    fn seen_from(eye: [f32; 3]) -> Result<Camera, Fault> {
        let args = CameraArguments {
            eye: Some(Point(eye)),
            ..CameraArguments::default()
        };
        placed_camera(
            &args,
            Camera::framing([0.0; 3], [2.0; 3]),
            middle(([0.0; 3], [2.0; 3])),
        )
    }

    #[test]
    fn an_eye_alone_looks_at_the_middle() {
        let camera = seen_from([9.0, 0.0, 0.0]).expect("a view");
        assert_eq!((camera.eye, camera.target), ([9.0, 0.0, 0.0], [1.0; 3]));
    }

    #[test]
    fn an_eye_at_its_target_sees_nothing() {
        assert_eq!(
            seen_from([1.0; 3]).map_err(|fault| fault.exit),
            Err(Exit::Usage)
        );
    }

    #[test]
    fn nothing_said_keeps_the_framing_view() {
        let framing = Camera::framing([0.0; 3], [2.0; 3]);
        assert_eq!(
            placed_camera(&CameraArguments::default(), framing, [7.0; 3]),
            Ok(framing)
        );
    }

    /// A box of corners that differ in every direction.
    fn boxed() -> Staged<'static> {
        const POINTS: [[f32; 3]; 2] = [[0.0; 3], [2.0, 4.0, 6.0]];
        Staged {
            cameras: &[],
            points: &POINTS,
            bounds: (POINTS[0], POINTS[1]),
        }
    }

    #[test]
    fn a_side_is_looked_at_from_its_middle_and_parallel_where_asked() {
        let size = Size {
            width: 100,
            height: 100,
        };
        let seen = |view, ortho| {
            let args = CameraArguments {
                view,
                ortho,
                ..CameraArguments::default()
            };
            camera(&args, &boxed(), size).expect("a view")
        };
        let front = seen(Some(StandardView::Front), true);
        assert_eq!(front.target, [1.0, 2.0, 3.0]);
        assert_eq!((front.eye[0], front.eye[1]), (1.0, 2.0));
        let Projection::Parallel { height } = front.projection else {
            panic!("perspective");
        };
        assert!((4.0..5.0).contains(&height), "{height}");
        let top = seen(Some(StandardView::Top), false);
        assert!(top.eye[1] > 4.0 && top.up == [0.0, 0.0, -1.0], "{top:?}");
        assert!(matches!(top.projection, Projection::Perspective { .. }));
        let parallel = |camera: Camera| matches!(camera.projection, Projection::Parallel { .. });
        assert!(parallel(seen(None, true)) && !parallel(seen(None, false)));
    }

    #[test]
    fn a_parallel_view_is_said_again_by_eye_and_target() {
        let size = Size {
            width: 160,
            height: 90,
        };
        let ortho = CameraArguments {
            view: Some(StandardView::Iso),
            ortho: true,
            fov: Some(30.0),
            ..CameraArguments::default()
        };
        let first = camera(&ortho, &boxed(), size).expect("a view");
        let again = CameraArguments {
            view: None,
            eye: Some(Point(first.eye)),
            target: Some(Point(first.target)),
            up: Some(Point(first.up)),
            ..ortho
        };
        assert_eq!(camera(&again, &boxed(), size), Ok(first));
    }

    #[test]
    fn names_come_before_numbers_and_faults_list_what_there_is() {
        let camera = |x: f32| Camera {
            eye: [x, 0.0, 0.0],
            ..Camera::framing([0.0; 3], [2.0; 3])
        };
        let cameras = [
            ("1".to_owned(), camera(5.0)),
            ("Side".to_owned(), camera(6.0)),
        ];
        let eye = |name: &str| camera_of_file(name, &cameras).map(|camera| camera.eye[0]);
        assert_eq!(eye("1"), Ok(5.0));
        assert_eq!(eye("0"), Ok(5.0));
        assert_eq!(eye("Side"), Ok(6.0));
        let fault = eye("Top").expect_err("no such camera");
        assert_eq!(
            fault.message,
            "the scene has no camera 'Top'; it has '1', 'Side'"
        );
    }
}
