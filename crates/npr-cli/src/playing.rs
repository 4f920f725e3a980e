//! The clip that plays in a film.

use crate::arguments::{LookedAt, PoseArguments};
use crate::fault::Fault;
use crate::pose::{self, Stance};
use crate::viewpoint::Staged;
use npr_core::camera::{Camera, bounds_of, box_corners};
use npr_render::{Movement, RenderError, Smoke};
use npr_scene::{Clip, Limits, Scene};
use npr_stylesheet::Style;
use std::sync::Arc;

/// Fewest and most moments of a clip that a camera is placed by.
const LOOKS: [usize; 2] = [8, 32];

/// Most points that are looked at for that, in all moments.
const LOOKED_AT: usize = 2_000_000;

/// The clip that plays in a film, or a figure that looks at a camera that moves.
#[derive(Debug, Clone)]
pub struct Playing {
    stance: Stance,
    /// How long the clip is; none where the pose is held, and only follows the camera.
    duration_s: Option<f32>,
    /// When it is held.
    held_s: f32,
    fps: f32,
}

impl Playing {
    /// The clip of `scene` that plays at `fps` frames a second: the one that the user asked for, else the first. Where
    /// there is none, or `--time` holds the pose still, nothing plays but what looks at the camera.
    pub fn of(
        args: &PoseArguments,
        scene: &Scene,
        fps: f32,
        limits: &Limits,
    ) -> Result<Option<Self>, Fault> {
        let asked = pose::clip_of(args, scene)?;
        let clip = match args.time {
            Some(_) => asked,
            None => asked.or(scene.clips.first()),
        };
        let playing = clip.filter(|_| args.time.is_none());
        if playing.is_none() && args.look_at != Some(LookedAt::Camera) {
            return Ok(None);
        }
        let stance = Stance::of(args, scene, clip, limits)?;
        let moves = playing.is_some() || stance.follows_camera();
        Ok(moves.then_some(Self {
            stance,
            duration_s: playing.map(Clip::duration_s),
            held_s: args.time.unwrap_or(0.0),
            fps,
        }))
    }

    /// How long the clip is, in seconds; none where the pose is held.
    pub fn duration_s(&self) -> Option<f32> {
        self.duration_s
    }

    /// What there is to warn of, whatever the frame.
    pub fn warnings(&self) -> &[String] {
        &self.stance.warnings
    }

    /// Poses the scene as it stands in a frame, seen by the camera that `camera` gives for it, and gives that camera
    /// and what there is to warn of.
    pub fn pose(
        &self,
        scene: &mut Scene,
        frame: u32,
        camera: impl FnOnce(&Scene) -> Result<Camera, Fault>,
    ) -> Result<(Camera, Option<String>), Fault> {
        let time_s = self.time_s(frame);
        let warning = self.stance.stand(scene, time_s, None);
        let camera = camera(scene)?;
        if self.stance.follows_camera() {
            let _ = self.stance.stand(scene, time_s, Some(&camera));
        }
        Ok((camera, warning))
    }

    /// Where everything in the scene was before a frame, as far as a style follows motion. The scene stands as in that
    /// frame, before and after, seen by a camera.
    pub fn movement(
        &self,
        scene: &mut Scene,
        (frame, camera): (u32, &Camera),
        style: &Style,
    ) -> Result<Option<Arc<Movement>>, RenderError> {
        let moment = (self.time_s(frame), Some(camera));
        self.stance.movement(scene, moment, style)
    }

    /// The time of the clip in a frame, in seconds.
    fn time_s(&self, frame: u32) -> f32 {
        match self.duration_s {
            Some(_) => (f64::from(frame) / f64::from(self.fps)) as f32,
            None => self.held_s,
        }
    }

    /// What is seen of the scene in the whole clip, with the smoke in it: a camera that is placed by it stands still,
    /// whichever frames are drawn. None where the pose is held.
    pub fn stage(&self, scene: &Scene, smoke: Option<&Smoke>) -> Option<Stage> {
        let duration_s = self.duration_s?;
        let mut scene = scene.clone();
        let vertices = scene.vertex_count().max(1);
        let looks = (LOOKED_AT / vertices).clamp(LOOKS[0], LOOKS[1]);
        let mut points = Vec::new();
        for look in 0..looks {
            let share = look as f32 / (looks - 1) as f32;
            let _ = self.stance.stand(&mut scene, share * duration_s, None);
            for (node, part) in scene.drawn_parts() {
                let placed = scene.positions_world(node, part);
                let mut used = vec![false; placed.len()];
                let corners = part.triangles.iter().flatten();
                for vertex in corners.chain(part.segments.iter().flatten()) {
                    used[*vertex as usize] = true;
                }
                let seen = placed.into_iter().zip(used).filter(|(_, used)| *used);
                points.extend(seen.map(|(point, _)| point));
            }
        }
        let smoke = smoke.map(|smoke| box_corners(smoke.bounds()));
        points.extend(smoke.into_iter().flatten());
        let bounds = bounds_of(points.iter().copied().map(Into::into));
        Some(Stage { points, bounds })
    }
}

/// All places of a film where something is seen.
pub struct Stage {
    points: Vec<[f32; 3]>,
    /// The box around them.
    bounds: ([f32; 3], [f32; 3]),
}

impl Stage {
    /// The stage with the cameras of the file, as a scene that a camera is chosen for.
    pub fn with_cameras<'a>(&'a self, cameras: &'a [(String, Camera)]) -> Staged<'a> {
        Staged {
            cameras,
            points: &self.points,
            bounds: self.bounds,
        }
    }
}
