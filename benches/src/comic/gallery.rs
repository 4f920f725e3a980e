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

/// What is drawn, in this order: textures, a character, plain surfaces, a scan, a machine, a scene of many parts.
pub const MODELS: [&str; 6] = [
    "flight_helmet.glb",
    "godette_vrm1.vrm",
    "kenney_alien.glb",
    "nefertiti_70k.glb",
    "ingenuity_helicopter.glb",
    "bridge_garden_scene.glb",
];

/// Size of a picture on a sheet, in pixels.
const SIZE: [u32; 2] = [1920, 1080];

/// Pictures beside each other.
const COLUMNS: usize = 2;

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
    let aspect = SIZE[0] as f32 / SIZE[1] as f32;
    let mut sheet = Sheet::new(scenes.len().min(COLUMNS), SIZE);
    for scene in scenes {
        let subject = Subject::new(scene, style)?;
        let options = RendererOptions::new(SIZE);
        let camera = subject.model.framing(aspect, DEFAULT_FOV_DEG.to_radians());
        let mut renderer = subject.renderer(&Processor, style, &options)?;
        sheet.add(&renderer.draw(&camera)?);
    }
    sheet.write(path)
}
