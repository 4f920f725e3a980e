//! The scene of a painter, in the pose that an order asks for.

use crate::arguments::PoseArguments;
use crate::fault::Fault;
use crate::pose::Posed;
use crate::render::Prepared;
use crate::viewpoint::Seen;
use npr_core::camera::Camera;
use npr_render::{RenderError, Renderer};
use npr_scene::{Limits, Scene};
use npr_stylesheet::Style;

/// A scene that takes one pose after another.
pub struct Actor {
    scene: Scene,
    posed: Posed,
    limits: Limits,
    /// What it was posed for last, with the style.
    asked: Option<(PoseArguments, Style)>,
    /// Counts up with every pose.
    version: u64,
}

/// The pose that a renderer was handed last.
#[derive(Debug, Default)]
pub struct Handed {
    /// Which one; 0 for the scene at rest, as it was prepared.
    version: u64,
    /// Seconds after which pictures on surfaces are drawn.
    seconds: f32,
}

impl Actor {
    /// The scene as it was prepared, at rest.
    pub fn new(scene: Scene, limits: Limits) -> Self {
        Self {
            scene,
            posed: Posed::default(),
            limits,
            asked: None,
            version: 0,
        }
    }

    /// What there is to warn of in the pose.
    pub fn warnings(&self) -> &[String] {
        &self.posed.warnings
    }

    /// Takes the pose of some arguments, in a style that may follow motion. Of another time of the same clip, springs
    /// go on from where they are.
    pub fn stand(&mut self, args: &PoseArguments, style: &Style) -> Result<(), Fault> {
        // A figure that looked at a camera does so no more.
        let asked = self.asked.take();
        let is_same = |(before, of_style): &(PoseArguments, Style)| {
            before == args && of_style == style && !self.posed.follows_camera()
        };
        if asked.as_ref().is_some_and(is_same) {
            self.asked = asked;
            return Ok(());
        }
        let at_this_time = |before: PoseArguments| PoseArguments {
            time: args.time,
            ..before
        };
        let plays = args.clip.is_some();
        let moves_on = plays && asked.is_some_and(|(before, _)| at_this_time(before) == *args);
        self.version += 1;
        match moves_on {
            true => {
                let time_s = args.time.unwrap_or(0.0);
                self.posed.move_to(&mut self.scene, time_s, style)?;
            }
            false => self.posed = Posed::of(args, &mut self.scene, style, &self.limits)?,
        }
        self.asked = Some((args.clone(), style.clone()));
        Ok(())
    }

    /// What a camera is placed by, of a scene that was prepared.
    pub fn seen<'a>(&self, prepared: &'a Prepared) -> Result<Seen<'a>, RenderError> {
        let mut seen = prepared.seen()?;
        if self.posed.is_posed {
            seen.model.to_mut().set_pose(&self.scene)?;
        }
        Ok(seen)
    }

    /// Looks at a camera, where it is to.
    pub fn face(&mut self, camera: &Camera, style: &Style) -> Result<(), RenderError> {
        if self.posed.face(&mut self.scene, camera, style)? {
            self.version += 1;
        }
        Ok(())
    }

    /// Hands the pose to a renderer, with pictures on surfaces as they are after some seconds.
    pub fn hand_to(
        &self,
        renderer: &mut Renderer<'_>,
        handed: &mut Handed,
        seconds: f32,
    ) -> Result<(), RenderError> {
        if handed.version != self.version {
            if handed.version > 0 || self.posed.is_posed {
                renderer.set_pose(&self.scene)?;
            }
            renderer.set_movement(self.posed.movement.clone());
            handed.version = self.version;
        }
        if handed.seconds != seconds {
            renderer.flow_textures(seconds)?;
            handed.seconds = seconds;
        }
        Ok(())
    }
}
