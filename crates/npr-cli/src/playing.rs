//! The clip that plays in a film.

use crate::arguments::PoseArguments;
use crate::fault::Fault;
use crate::pose::{self, Stance};
use crate::viewpoint::Staged;
use npr_core::camera::{Camera, bounds_of, box_corners};
use npr_render::{Movement, RenderError, Smoke};
use npr_scene::{Limits, Scene};
use npr_stylesheet::Style;
use std::sync::Arc;

/// Fewest and most moments of a clip that a camera is placed by.
const LOOKS: [usize; 2] = [8, 32];

/// Most points that are looked at for that, in all moments.
const LOOKED_AT: usize = 2_000_000;

/// The clip that plays in a film.
#[derive(Debug, Clone)]
pub struct Playing {
    stance: Stance,
    duration_s: f32,
    fps: f32,
}

impl Playing {
    /// The clip of `scene` that plays at `fps` frames a second: the one that the user asked for, else the first. None
    /// where there is none, and where `--time` holds the pose still.
    pub fn of(
        args: &PoseArguments,
        scene: &Scene,
        fps: f32,
        limits: &Limits,
    ) -> Result<Option<Self>, Fault> {
        if args.time.is_some() {
            return Ok(None);
        }
        let asked = pose::clip_of(args, scene)?;
        let Some(clip) = asked.or(scene.clips.first()) else {
            return Ok(None);
        };
        Ok(Some(Self {
            stance: Stance::of(args, scene, Some(clip), limits)?,
            duration_s: clip.duration_s(),
            fps,
        }))
    }

    /// How long the clip is, in seconds.
    pub fn duration_s(&self) -> f32 {
        self.duration_s
    }

    /// What there is to warn of, whatever the frame.
    pub fn warnings(&self) -> &[String] {
        &self.stance.warnings
    }

    /// Poses the scene as it stands in a frame, and gives what there is to warn of.
    pub fn pose(&self, scene: &mut Scene, frame: u32) -> Option<String> {
        self.stance.stand(scene, self.time_s(frame))
    }

    /// Where everything in the scene was before a frame, as far as a style follows motion. The scene stands as in that
    /// frame, before and after.
    pub fn movement(
        &self,
        scene: &mut Scene,
        frame: u32,
        style: &Style,
    ) -> Result<Option<Arc<Movement>>, RenderError> {
        self.stance.movement(scene, self.time_s(frame), style)
    }

    /// The time of the clip in a frame, in seconds.
    fn time_s(&self, frame: u32) -> f32 {
        (f64::from(frame) / f64::from(self.fps)) as f32
    }

    /// What is seen of the scene in the whole clip, with the smoke in it: a camera that is placed by it stands still,
    /// whichever frames are drawn.
    pub fn stage(&self, scene: &Scene, smoke: Option<&Smoke>) -> Stage {
        let mut scene = scene.clone();
        let vertices = scene.vertex_count().max(1);
        let looks = (LOOKED_AT / vertices).clamp(LOOKS[0], LOOKS[1]);
        let mut points = Vec::new();
        for look in 0..looks {
            let share = look as f32 / (looks - 1) as f32;
            let _ = self.stance.stand(&mut scene, share * self.duration_s);
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
        Stage { points, bounds }
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
