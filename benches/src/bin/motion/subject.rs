//! A model that is drawn frame by frame.

use std::path::Path;
use std::sync::Arc;

use glam::{DVec3, Vec3};
use npr_benches::lines::viewpoint::{Viewpoint, wide};
use npr_benches::motion::causes::Stages;
use npr_benches::motion::film::Film;
use npr_benches::motion::traced::{Sample, Traced};
use npr_benches::solid::bumpy_ball;
use npr_core::camera::Camera;
use npr_render::{HeldLines, LineModel, LineModelOptions, LineOptions};
use npr_scene::{Clip, LoadOptions, Pose, Scene, load};
use npr_stylesheet::Style;
use npr_vector::mesh_lines::bvh::{FaceTree, Sight};
use npr_vector::project::Projector;

use crate::Outcome;

/// Frame of all sequences.
pub const SIZE: [u32; 2] = [1920, 1080];

/// The style of all sequences.
pub const PRESET: &str = "toon";

/// Models of the shared folder, and the clips that they play.
const MODELS: [(&str, Option<&str>); 7] = [
    ("stanford_bunny.glb", None),
    ("suzanne.glb", None),
    ("nefertiti_70k.glb", None),
    ("flight_helmet.glb", None),
    ("godette_vrm1.vrm", None),
    ("robot_animated.glb", Some("Robot_Walking")),
    ("fox.glb", Some("Run")),
];

/// Triangles of the bumpy ball.
const BALL_TRIANGLES: usize = 20_000;

/// How far in front of a point something has to lie to hide it, in pixels: points of smoothed strokes lie on chords of
/// the surface.
const TOUCH_PX: f64 = 0.5;

/// A model ready to be drawn.
pub struct Subject {
    /// Name of its file without the extension.
    pub name: String,
    /// The clip that it plays.
    pub clip: Option<Clip>,
    scene: Scene,
    lines: LineModel,
    /// The style that is drawn, and the same that leaves out no stubs.
    styles: [Style; 2],
    /// Middle and radius of a sphere around the model at rest.
    sphere: (Vec3, f32),
}

/// A frame.
pub struct Shot {
    /// The camera.
    pub view: Viewpoint,
    /// The strokes.
    pub stages: Stages,
    /// Positions of the vertices.
    pub positions: Arc<Vec<[f32; 3]>>,
    shape: Arc<npr_mesh::half_edge::HalfEdgeMesh>,
    tree: Arc<FaceTree>,
    projector: Projector,
}

impl Shot {
    /// Whether the point of a sample is seen, by an exact sight.
    pub fn sees(&self, sample: &Sample) -> bool {
        let depth = self.projector.depth(sample.world);
        let sight = Sight {
            eye: self.projector.sight_start(sample.world).to_array(),
            point: sample.world.to_array(),
            touch: TOUCH_PX / self.projector.pixels_per_unit(depth),
        };
        self.tree.occluders(&self.shape, &sight, &[], 1) == 0
    }

    /// The faces of the surface.
    pub fn faces(&self) -> Vec<[u32; 3]> {
        self.shape.faces.clone()
    }

    /// Its vertices.
    pub fn points(&self) -> Vec<DVec3> {
        self.positions.iter().copied().map(wide).collect()
    }
}

/// The files of all subjects that are there, and `None` for the bumpy ball.
pub fn names() -> impl Iterator<Item = Option<(&'static str, Option<&'static str>)>> {
    MODELS.into_iter().map(Some).chain([None])
}

impl Subject {
    /// Loads a model and the clip of a name, or makes the bumpy ball.
    ///
    /// # Errors
    ///
    /// Whatever loading and preparing say.
    pub fn new(file: Option<(&Path, Option<&str>)>) -> Outcome<Self> {
        // Load the model.
        let (name, scene) = match file {
            Some((path, _)) => {
                let name = path.file_stem().unwrap_or_default().to_string_lossy();
                (name.into_owned(), load(path, &LoadOptions::default())?)
            }
            None => ("bumpy_ball".to_owned(), bumpy_ball(BALL_TRIANGLES)),
        };
        let wanted = file.and_then(|(_, clip)| clip);
        let clip = wanted.map(|wanted| {
            let found = scene.clips.iter().find(|clip| clip.name == wanted);
            found
                .cloned()
                .ok_or_else(|| format!("{name} has no clip {wanted}"))
        });

        // Settle how it is drawn.
        let mut style = Style::preset(PRESET)?;
        style.set("line.method=strokes")?;
        let mut with_stubs = style.clone();
        with_stubs.set("line.least=0")?;
        with_stubs.set("line.crease_least=0")?;
        let lines = LineModel::for_style(&scene, &style, &LineModelOptions::default(), None)?;
        Ok(Self {
            sphere: sphere_of(&lines),
            clip: clip.transpose()?,
            styles: [style, with_stubs],
            name,
            scene,
            lines,
        })
    }

    /// Whether a sequence shows anything of this model.
    pub fn plays(&self, film: Film) -> bool {
        film != Film::Clip || self.clip.is_some()
    }

    /// Number of frames of a sequence.
    pub fn frame_count(&self, film: Film) -> usize {
        let duration_s = self.clip.as_ref().map_or(0.0, Clip::duration_s);
        film.frame_count(duration_s)
    }

    /// Draws a frame of a sequence; what does not bend is taken over from the frame before. With `held` the strokes
    /// hold to those of that frame.
    ///
    /// # Errors
    ///
    /// Whatever posing and drawing say.
    pub fn shot(
        &mut self,
        (film, frame): (Film, usize),
        before: Option<&Shot>,
        held: Option<&mut HeldLines>,
    ) -> Outcome<Shot> {
        // Pose the model; other sequences show it at rest.
        if let Some(clip) = self
            .clip
            .as_ref()
            .filter(|_| film == Film::Clip || before.is_none())
        {
            let pose = match film {
                Film::Clip => self.scene.pose_at(clip, Film::time_s(frame)),
                _ => Pose::default(),
            };
            self.scene.set_pose(&pose)?;
            self.lines.set_pose(&self.scene)?;
        }
        let (shape, tree, positions) = match before.filter(|_| film != Film::Clip) {
            Some(shot) => (
                shot.shape.clone(),
                shot.tree.clone(),
                shot.positions.clone(),
            ),
            None => {
                let shape = self.lines.shape().clone();
                let positions = shape.positions.clone();
                let tree = FaceTree::new(&shape);
                (Arc::new(shape), Arc::new(tree), Arc::new(positions))
            }
        };

        // Draw its lines.
        let camera = film.camera(frame, self.sphere, SIZE[1]);
        let bounds = npr_core::camera::bounds_of(positions.iter().copied().map(Vec3::from));
        let projector = Projector::new(&camera, SIZE, bounds);
        let [style, with_stubs] = &self.styles;
        let stages = Stages {
            raw: self.drawn(&camera, style, false, &projector, None)?,
            with_stubs: self.drawn(&camera, with_stubs, true, &projector, None)?,
            drawn: self.drawn(&camera, style, true, &projector, held)?,
        };
        Ok(Shot {
            view: Viewpoint::new(&camera, SIZE),
            stages,
            positions,
            shape,
            tree,
            projector,
        })
    }

    fn drawn(
        &self,
        camera: &Camera,
        style: &Style,
        smooth: bool,
        projector: &Projector,
        held: Option<&mut HeldLines>,
    ) -> Outcome<Traced> {
        let options = LineOptions {
            smooth,
            ..LineOptions::of_style(style, SIZE)
        };
        let drawing = match held {
            Some(held) => self.lines.draw_held(camera, style, &options, held)?,
            None => self.lines.draw(camera, style, &options)?,
        };
        Ok(Traced::new(&drawing.strokes, SIZE, projector.lens()))
    }
}

/// The middle of the box around the faces of a model, and the distance to the farthest of their corners.
fn sphere_of(lines: &LineModel) -> (Vec3, f32) {
    let shape = lines.shape();
    let corners = shape.faces.iter().flatten();
    let points = || {
        corners
            .clone()
            .map(|v| Vec3::from(shape.positions[*v as usize]))
    };
    let (low, high) = npr_core::camera::bounds_of(points());
    let middle = (Vec3::from(low) + Vec3::from(high)) / 2.0;
    let radius = points()
        .map(|point| point.distance(middle))
        .fold(0.0, f32::max);
    (middle, radius)
}
