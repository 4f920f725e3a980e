//! What the command line says.

use std::path::PathBuf;

use crate::Outcome;

/// How the program is called.
pub const USAGE: &str = "\
usage: lines [--models DIR] [--peers DIR] [--only NAME] [--method NAME] [--quick] [--pictures DIR]
       lines --pilot [--models DIR] [--only NAME | --model SCENE] [--method NAME] [--pictures DIR]
       lines --sights [--models DIR] [--peers DIR] [--only NAME]
       lines --strokes FILE.json --model SCENE [--eye X,Y,Z --target X,Y,Z --fov DEG] [--crease DEG]

  --models DIR    folder of the shared models
  --peers DIR     folder of the meshes that other programs drew, as OBJ
  --only NAME     only models whose name holds NAME
  --method NAME   only ways whose name holds NAME
  --pilot         the views that the published path's emulation was measured in
  --sights        what sampled sights lose and wrongly show
  --quick         one view, small models, few runs
  --pictures DIR  writes an SVG of every view and way: the reference's runs, drawn runs, our strokes with doubles marked
  --strokes FILE  judges the lines that any program wrote instead of drawing";

/// What the user asked for.
#[derive(Debug, Clone, Default)]
pub struct Arguments {
    /// Folder of the shared models.
    pub models: Option<PathBuf>,
    /// Folder of the meshes that other programs drew.
    pub peers: Option<PathBuf>,
    /// Part of the names to measure.
    pub only: Option<String>,
    /// Part of the names of ways to measure.
    pub method: Option<String>,
    /// The views of the published path's emulation.
    pub pilot: bool,
    /// What sampled sights lose and wrongly show.
    pub sights: bool,
    /// One view, small models, few runs.
    pub quick: bool,
    /// Folder for pictures of every view and way.
    pub pictures: Option<PathBuf>,
    /// Lines to judge instead of drawing.
    pub strokes: Option<PathBuf>,
    /// The scene that they show.
    pub model: Option<PathBuf>,
    /// Where it is seen from.
    pub eye: Option<[f32; 3]>,
    /// A point on the view axis.
    pub target: Option<[f32; 3]>,
    /// Vertical field of view in degrees.
    pub fov: Option<f32>,
    /// Angle of creases in degrees.
    pub crease: Option<f64>,
}

impl Arguments {
    /// Whether a way of drawing is asked for.
    pub fn takes_way(&self, name: &str) -> bool {
        let part = self.method.as_ref();
        part.is_none_or(|part| name.contains(part.as_str()))
    }
}

/// Reads the words after the program's name.
pub fn parse(mut words: impl Iterator<Item = String>) -> Outcome<Arguments> {
    let mut arguments = Arguments::default();
    while let Some(word) = words.next() {
        if word == "--pilot" {
            arguments.pilot = true;
            continue;
        }
        if word == "--sights" {
            arguments.sights = true;
            continue;
        }
        if word == "--quick" {
            arguments.quick = true;
            continue;
        }
        let value = words.next().ok_or(USAGE)?;
        match word.as_str() {
            "--models" => arguments.models = Some(value.into()),
            "--peers" => arguments.peers = Some(value.into()),
            "--only" => arguments.only = Some(value),
            "--method" => arguments.method = Some(value),
            "--pictures" => arguments.pictures = Some(value.into()),
            "--strokes" => arguments.strokes = Some(value.into()),
            "--model" => arguments.model = Some(value.into()),
            "--eye" => arguments.eye = Some(vector(&value)?),
            "--target" => arguments.target = Some(vector(&value)?),
            "--fov" => arguments.fov = Some(value.parse()?),
            "--crease" => arguments.crease = Some(value.parse()?),
            _ => return Err(USAGE.into()),
        }
    }
    Ok(arguments)
}

/// Three numbers with commas between.
fn vector(text: &str) -> Outcome<[f32; 3]> {
    let numbers = text
        .split(',')
        .map(str::parse)
        .collect::<Result<Vec<f32>, _>>()?;
    <[f32; 3]>::try_from(numbers).map_err(|_| USAGE.into())
}
