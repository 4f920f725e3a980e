//! Smoke of the built-in simulation, as the command draws it.

use npr_gpu::engine::Engine;
use npr_render::{Following, Frame, Model, Renderer, RendererOptions, Smoke};
use npr_scene::Scene;
use npr_smoke::{Puffs, SmokeSettings, Source, Volume};
use npr_stylesheet::Style;

use npr_core::camera::{Camera, Projection};
use npr_core::math::{cos, sin};

/// A film of smoke on a small grid.
#[derive(Debug, Clone)]
pub struct SmokeFilm {
    /// How it was made.
    pub settings: SmokeSettings,
    /// Its frames, the first at 0.
    pub volumes: Vec<Volume>,
}

impl SmokeFilm {
    /// The first frames of a source, on a grid of so many cells: 15 x 15 x 20 in the publication.
    pub fn new(source: Source, size: [u32; 3], frames: usize) -> Self {
        let settings = SmokeSettings {
            size,
            ..SmokeSettings::of(source)
        };
        let mut smoke = npr_smoke::Smoke::new(settings).expect("a small grid");
        let frame = |_| {
            smoke.step();
            smoke.volume()
        };
        Self {
            settings,
            volumes: (0..frames).map(frame).collect(),
        }
    }

    /// The spheres of every frame in a style, followed from the first frame on, in the space of all.
    pub fn puffs(&self, style: &Style) -> Vec<Smoke> {
        let following = Following {
            birthplace: self.settings.birthplace(),
            ..Following::default()
        };
        let mut puffs = Puffs::new(&self.volumes[0], following.settings(&style.smoke));
        let mut frames = vec![Smoke::of_puffs(&puffs)];
        for volume in &self.volumes[1..] {
            puffs.step(volume);
            frames.push(Smoke::of_puffs(&puffs));
        }
        let all = frames.iter().cloned().reduce(Smoke::with);
        let space = all.map(|all| all.extent());
        frames.iter_mut().for_each(|smoke| smoke.space = space);
        frames
    }

    /// The spheres of the last frame in a style.
    pub fn last(&self, style: &Style) -> Smoke {
        self.puffs(style).pop().expect("a film has frames")
    }
}

/// Draws smoke alone on an engine.
pub fn draw_smoke(
    engine: &dyn Engine,
    smoke: &Smoke,
    style: &Style,
    camera: &Camera,
    size: [u32; 2],
) -> Frame {
    let options = RendererOptions {
        smoke: Some(smoke.clone()),
        ..RendererOptions::new(size)
    };
    let model = Model::new(&Scene::default()).expect("nothing");
    let mut renderer = Renderer::new(engine, &model, style, &options).expect("a stage");
    renderer.draw(camera).expect("a picture")
}

/// A camera that looks at the box of the built-in smoke from the front, without perspective, level with `middle`;
/// `height` is what it sees, in units.
pub fn front_camera(middle: f32, height: f32) -> Camera {
    Camera {
        eye: [0.0, middle, 4.0],
        target: [0.0, middle, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height },
    }
}

/// A camera that looks at the box of the built-in smoke from an angle round the upright axis, in degrees.
pub fn orbit_camera(degrees: f32) -> Camera {
    let angle = degrees.to_radians();
    Camera {
        eye: [2.4 * sin(angle), 0.7, 2.4 * cos(angle)],
        target: [0.0, 0.5, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.6 },
    }
}
