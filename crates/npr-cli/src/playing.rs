//! The clip that plays in a film.

use crate::arguments::DrawingArguments;
use crate::fault::Fault;
use crate::look::Look;
use crate::pose;
use crate::viewpoint::Staged;
use npr_core::camera::Camera;
use npr_core::camera::bounds_of;
use npr_render::Smoke;
use npr_scene::{Clip, Limits, Scene};
use std::path::Path;

/// Fewest and most moments of a clip that a camera is placed by.
const LOOKS: [usize; 2] = [8, 32];

/// Most points that are looked at for that, in all moments.
const LOOKED_AT: usize = 2_000_000;

/// A scene of which a clip plays.
#[derive(Debug, Clone)]
pub struct Playing {
    /// The scene as it was loaded, at rest.
    scene: Scene,
    clip: Clip,
    fps: f32,
}

impl Playing {
    /// The clip of `scene` that plays at `fps` frames a second: the one that the user asked for, else the first. None
    /// where there is none, and where `--time` holds the pose still.
    pub fn of(args: &DrawingArguments, scene: &Scene, fps: f32) -> Result<Option<Self>, Fault> {
        if args.pose.time.is_some() {
            return Ok(None);
        }
        let asked = pose::clip_of(&args.pose, scene)?;
        Ok(asked.or(scene.clips.first()).map(|clip| Self {
            scene: scene.clone(),
            clip: clip.clone(),
            fps,
        }))
    }

    /// How long the clip is, in seconds.
    pub fn duration_s(&self) -> f32 {
        self.clip.duration_s()
    }

    /// The scene as it stands in a frame, with id maps of the look, and what there is to warn of.
    pub fn scene_at(
        &self,
        frame: u32,
        look: &Look,
        (limits, external): (&Limits, Option<&Path>),
    ) -> Result<(Scene, Option<String>), Fault> {
        let (mut scene, warning) = self.posed(self.time_of(frame));
        look.apply_id_maps(&mut scene, limits, external)?;
        Ok((scene, warning))
    }

    /// The scene as it stands in a frame, before any id maps.
    pub fn loaded_at(&self, frame: u32) -> (Scene, Option<String>) {
        self.posed(self.time_of(frame))
    }

    /// The time of a frame, in seconds.
    fn time_of(&self, frame: u32) -> f32 {
        (f64::from(frame) / f64::from(self.fps)) as f32
    }

    fn posed(&self, time_s: f32) -> (Scene, Option<String>) {
        let mut scene = self.scene.clone();
        let warning = pose::stand(&mut scene, &self.clip, time_s);
        (scene, warning)
    }

    /// What is seen of the scene in the whole clip, with the smoke in it: a camera that is placed by it stands still,
    /// whichever frames are drawn.
    pub fn stage(&self, smoke: Option<&Smoke>) -> Stage {
        let vertices = self.scene.vertex_count().max(1);
        let looks = (LOOKED_AT / vertices).clamp(LOOKS[0], LOOKS[1]);
        let mut points = Vec::new();
        for look in 0..looks {
            let share = look as f32 / (looks - 1) as f32;
            let (scene, _) = self.posed(share * self.duration_s());
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
        let smoke = smoke.map(|smoke| npr_core::camera::box_corners(smoke.bounds()));
        points.extend(smoke.into_iter().flatten());
        Stage { points }
    }
}

/// All places of a film where something is seen.
pub struct Stage {
    points: Vec<[f32; 3]>,
}

impl Stage {
    /// The stage with the cameras of the file, as a scene that a camera is chosen for.
    pub fn with_cameras<'a>(&'a self, cameras: &'a [(String, Camera)]) -> Staged<'a> {
        let bounds = bounds_of(self.points.iter().copied().map(Into::into));
        Staged {
            cameras,
            points: &self.points,
            bounds,
        }
    }
}
