//! The characters, what they stand before, and how each method draws them.

use std::error::Error;

use npr_core::camera::{Camera, DEFAULT_FOV_DEG};
use npr_gpu::engine::Engine;
use npr_render::{Frame, Model, Renderer, RendererOptions};
use npr_scene::{LoadOptions, load};
use npr_stylesheet::Style;

use super::judge::{self, Pictures, Place};
use super::scenery::Scenery;
use crate::lines::subjects::shared_models;

/// What is drawn: a model, and what lies behind it.
pub const FRAMES: [(&str, Scenery); 12] = [
    ("godette_vrm1.vrm", Scenery::Dark),
    ("godette_vrm1.vrm", Scenery::Light),
    ("godette_vrm1.vrm", Scenery::TwoColors),
    ("godette_vrm1.vrm", Scenery::Textured),
    ("godette_vrm1.vrm", Scenery::Photograph),
    ("flight_helmet.glb", Scenery::Dark),
    ("flight_helmet.glb", Scenery::TwoColors),
    ("flight_helmet.glb", Scenery::Photograph),
    ("robot_animated.glb", Scenery::Light),
    ("robot_animated.glb", Scenery::Textured),
    ("kenney_alien.glb", Scenery::Dark),
    ("kenney_alien.glb", Scenery::Photograph),
];

/// A way to colour lines.
#[derive(Debug, Clone, Copy)]
pub struct Method {
    /// Its name in tables.
    pub name: &'static str,
    /// What it sets beside the preset `toon`.
    pub settings: &'static [&'static str],
}

/// The methods that are held against each other: the two of one colour [Tsuji 2014, section 3.1], the published one,
/// ours.
pub const METHODS: [Method; 4] = [
    Method {
        name: "black",
        settings: &["line.color=black"],
    },
    Method {
        name: "red",
        settings: &["line.color=red"],
    },
    Method {
        name: "published",
        settings: &[
            "line.method=rim",
            "line.color=black",
            "line.background.method=published",
        ],
    },
    Method {
        name: "ours",
        settings: &[
            "line.paint.source=surface",
            "line.paint.factor=0.6",
            "line.background.method=contrast",
            "line.background.start=rim",
            "line.background.factor=1",
        ],
    },
];

/// A model before a scenery, drawn by one method at any moment.
pub struct Show<'a> {
    bare: Renderer<'a>,
    drawn: Renderer<'a>,
    alone: Renderer<'a>,
    lined: Renderer<'a>,
}

impl<'a> Show<'a> {
    /// Prepares all pictures of a moment, `size` pixels each.
    ///
    /// # Errors
    ///
    /// Where the style or the engine fails.
    pub fn new(
        engine: &'a dyn Engine,
        model: &'a Model,
        scenery: Scenery,
        method: &Method,
        size: [u32; 2],
    ) -> Result<Self, Box<dyn Error>> {
        // Prepare a renderer for a background, with lines or without.
        let renderer = |background: &str, line: &str| -> Result<Renderer<'a>, Box<dyn Error>> {
            let mut style = Style::preset("toon")?;
            for setting in method.settings.iter().chain([&background, &line]) {
                if !setting.is_empty() {
                    style.set(setting)?;
                }
            }
            let options = RendererOptions {
                background_image: Some(scenery.picture(size)),
                ..RendererOptions::new(size)
            };
            Ok(Renderer::new(engine, model, &style, &options)?)
        };

        // Draw the character and the background apart, each with lines and without.
        let (behind, none) = ("background=scenery.png", "background=transparent");
        let (lines, no_lines) = ("", "line.method=none");
        Ok(Self {
            bare: renderer(behind, no_lines)?,
            drawn: renderer(behind, lines)?,
            alone: renderer(none, no_lines)?,
            lined: renderer(none, lines)?,
        })
    }

    /// The finished picture.
    ///
    /// # Errors
    ///
    /// Where the engine fails.
    pub fn picture(&mut self, camera: &Camera) -> Result<Frame, Box<dyn Error>> {
        Ok(self.drawn.draw(camera)?)
    }

    /// The places of the outline.
    ///
    /// # Errors
    ///
    /// Where the engine fails.
    pub fn places(&mut self, camera: &Camera) -> Result<Vec<Place>, Box<dyn Error>> {
        let [bare, drawn] = [self.bare.draw(camera)?, self.drawn.draw(camera)?];
        let [alone, lined] = [self.alone.draw(camera)?, self.lined.draw(camera)?];
        Ok(judge::places(&Pictures {
            bare: &bare,
            drawn: &drawn,
            alone: &alone,
            lined: &lined,
        }))
    }
}

/// A model of the shared folder, seen from the front; `None`, said on standard error, where it is not there.
///
/// # Errors
///
/// Where it cannot be read.
pub fn subject(name: &str) -> Result<Option<(Model, Camera)>, Box<dyn Error>> {
    let path = shared_models().join(name);
    if !path.is_file() {
        eprintln!("left out: there is no {}", path.display());
        return Ok(None);
    }
    let model = Model::new(&load(&path, &LoadOptions::default())?)?;
    let camera = model.framing(1.0, DEFAULT_FOV_DEG.to_radians());
    Ok(Some((model, camera)))
}
