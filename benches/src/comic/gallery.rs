//! Sheets of every preset on a few models, for people to look at.

use std::error::Error;
use std::path::Path;

use npr_core::camera::DEFAULT_FOV_DEG;
use npr_gpu::processor::Processor;
use npr_render::{RendererOptions, Subject};
use npr_scene::{LoadOptions, Scene, load};
use npr_stylesheet::{Style, presets};

use crate::lines::subjects::shared_models;
use crate::sheet::Sheet;

/// What is drawn, in this order: textures, a character, a machine, plain surfaces, a figure, a scan.
pub const MODELS: [&str; 6] = [
    "flight_helmet.glb",
    "godette_vrm1.vrm",
    "robot_animated.glb",
    "shader_ball.glb",
    "human_body.glb",
    "nefertiti_70k.glb",
];

/// Side of a picture on a sheet, in pixels.
const SIDE: u32 = 800;

/// Pictures beside each other.
const COLUMNS: usize = 3;

/// Writes a sheet a preset into `folder`, of all presets or of those named.
///
/// Says on standard error which models are missing; without any, writes nothing.
///
/// # Errors
///
/// Where a model cannot be read or a sheet cannot be written.
pub fn write(folder: &Path, names: &[String]) -> Result<(), Box<dyn Error>> {
    // Read the models that are there.
    let mut scenes = Vec::new();
    for path in MODELS.map(|name| shared_models().join(name)) {
        if path.is_file() {
            scenes.push(load(&path, &LoadOptions::default())?);
        } else {
            eprintln!("left out: there is no {}", path.display());
        }
    }
    if scenes.is_empty() {
        return Ok(());
    }

    // Write a sheet for every preset that is asked for.
    std::fs::create_dir_all(folder)?;
    for preset in presets() {
        if names.is_empty() || names.iter().any(|name| name == preset.name) {
            let path = folder.join(format!("{}.png", preset.name));
            write_sheet(&path, &scenes, &Style::preset(preset.name)?)?;
            println!("{}", path.display());
        }
    }
    Ok(())
}

/// Draws every scene in a style and writes them beside each other.
fn write_sheet(path: &Path, scenes: &[Scene], style: &Style) -> Result<(), Box<dyn Error>> {
    let mut sheet = Sheet::new(scenes.len().min(COLUMNS), [SIDE; 2]);
    for scene in scenes {
        let subject = Subject::new(scene, style)?;
        let options = RendererOptions::new([SIDE; 2]);
        let camera = subject.model.framing(1.0, DEFAULT_FOV_DEG.to_radians());
        let mut renderer = subject.renderer(&Processor, style, &options)?;
        sheet.add(&renderer.draw(&camera)?);
    }
    sheet.write(path)
}
