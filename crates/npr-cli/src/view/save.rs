//! What is taken away from a studio, as files.

use super::order::{film_arguments, order_arguments, turned};
use crate::animate;
use crate::arguments::{LineArguments, LineFormat, LinesArguments, SheetArguments, ViewArguments};
use crate::fault::{Exit, Fault};
use crate::input::read_file;
use crate::lines;
use crate::look::Look;
use crate::output::{Output, folder_of};
use crate::progress::Progress;
use crate::render;
use crate::style_source::StyleSource;
use npr_scene::{Bone, Posture};
use npr_view::{Film, Order, Pose, Sheet, Take};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Most numbers that are tried for a name that is still free.
const NAMES_MAX: u32 = 10_000;

/// Writes a style as a file named after the scene, and gives its path. One that extends a file lies beside it, so that
/// its parent is found; any other in a folder.
pub fn style(folder: &Path, scene: &Path, sheet: &Sheet) -> Result<PathBuf, Fault> {
    let source = StyleSource::of(Some(sheet.name()));
    let folder = source.file().map_or(folder, folder_of);
    let path = free_path(folder, scene, ".toml")?;
    let text = match source.file().and_then(Path::file_name) {
        Some(name) => sheet.file_over(&name.to_string_lossy()),
        None => sheet.file(),
    };
    Output::of(&path)?.write(text.as_bytes())?;
    Ok(path)
}

/// Writes the bones of a pose into a file named after the scene, as `--pose` reads them, and gives its path: those of
/// the file that it names, and those that it turns besides.
pub fn pose(
    folder: &Path,
    scene: &Path,
    args: &ViewArguments,
    pose: &Pose,
) -> Result<PathBuf, Fault> {
    // Find the bones.
    let mut posture = Posture::default();
    if let Some(file) = &pose.bones {
        let limits = args.drawing.limits.limits();
        let bytes = read_file(Path::new(file), limits.file_bytes)?;
        let read = Posture::read(&bytes, &limits);
        let (read, _) = read.map_err(|fault| Fault::new(Exit::Input, fault))?;
        posture = read;
    }
    posture.turns.extend(turned(pose).turns);

    // Write them with every digit: a file draws the same bytes.
    let mut bones = Map::new();
    for bone in Bone::all() {
        let mut said = Map::new();
        let hips = posture.hips.filter(|_| bone == Bone::HIPS);
        let numbers = |list: &[f32]| list.iter().copied().map(f64::from).collect::<Value>();
        said.extend(hips.map(|way| ("position".to_owned(), numbers(&way))));
        let turn = posture.turns.get(&bone);
        said.extend(turn.map(|turn| ("rotation".to_owned(), numbers(turn))));
        if !said.is_empty() {
            bones.insert(bone.name().to_owned(), said.into());
        }
    }
    let path = free_path(folder, scene, ".pose.json")?;
    let text = format!("{:#}\n", json!({ "pose": bones }));
    Output::of(&path)?.write(text.as_bytes())?;
    Ok(path)
}

/// Draws the picture of an order into a file in a folder, as the command does, and gives its path.
pub fn picture(
    args: &ViewArguments,
    (folder, scene): (&Path, &Path),
    (take, order): (Take, &Order),
) -> Result<PathBuf, Fault> {
    let format = match take {
        Take::Svg => Some(LineFormat::Svg),
        Take::Json => Some(LineFormat::Json),
        Take::Style | Take::Png => None,
    };
    let ending = format.map_or("png", LineFormat::ending);
    let path = free_path(folder, scene, &format!(".{ending}"))?;
    let mut args = order_arguments(args, scene, order);
    args.output = Some(path.clone());
    let Some(format) = format else {
        render::render(&args)?;
        return Ok(path);
    };

    // Lines of a style that fills surfaces are drawn alone, and data are lines alone.
    let look = Look::resolve(&args.drawing.look, args.drawing.allow_external.as_deref())?;
    if format == LineFormat::Svg && look.paper_of_lines().is_some() {
        lines::lines_of_picture(&args)?;
        return Ok(path);
    }
    lines::lines(&LinesArguments {
        scene: args.scene.clone(),
        output: args.output.clone(),
        format: Some(format),
        lines: LineArguments::default(),
        sheet: SheetArguments::default(),
        drawing: args.drawing.clone(),
        cache: args.cache.clone(),
    })?;
    Ok(path)
}

/// Draws a film into files in a folder, as `npr animate` does, and gives their path.
pub fn film(
    args: &ViewArguments,
    (folder, scene): (&Path, &Path),
    (film, order): (&Film, &Order),
    progress: &mut Progress,
) -> Result<PathBuf, Fault> {
    let path = free_path(folder, scene, film.form.ending())?;
    let args = film_arguments(args, scene, (film, order), &path);
    animate::draw(&args, progress)?;
    Ok(path)
}

/// A path in a folder that is still free, named after a scene; of numbered files the first is.
fn free_path(folder: &Path, scene: &Path, ending: &str) -> Result<PathBuf, Fault> {
    let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
    let named = (0..NAMES_MAX).map(|number| match number {
        0 => format!("{stem}{ending}"),
        _ => format!("{stem}-{number}{ending}"),
    });
    let mut paths = named.map(|name| match folder == Path::new(".") {
        true => PathBuf::from(name),
        false => folder.join(name),
    });
    paths
        .find(|path| {
            let first = path.to_string_lossy().replace("####", "0000");
            !Path::new(&first).exists()
        })
        .ok_or_else(|| Fault::new(Exit::Failed, format!("no name is free for {stem}{ending}")))
}
