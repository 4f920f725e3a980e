//! The job of `npr render`: its arguments, resolved and checked.

use crate::arguments::{DrawingArguments, LookArguments, RenderArguments, Size};
use crate::debug_layer::DebugLayer;
use crate::ending::has_ending;
use crate::fault::{Exit, Fault};
use crate::look::Look;
use crate::message::quoted;
use crate::output::Output;
use crate::source::{Source, has_volume_name};
use crate::target::Target;
use crate::volume::USUAL_STYLE;
use npr_render::{RendererOptions, SurfaceStage};
use std::path::{Path, PathBuf};

/// Longest side of a picture, in pixels.
const SIDE_LIMIT: u32 = 32_768;

/// The formats of pictures that `npr render` writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureFormat {
    /// Colours alone.
    Png,
    /// OpenEXR, with layers for compositing.
    Exr,
}

/// One picture to draw. Everything that can be checked without reading the scene is already checked.
pub struct Job<'a> {
    /// The arguments, for everything that needs no resolving.
    pub args: &'a RenderArguments,
    /// The source of the scene.
    pub source: Source,
    /// The destination of the picture, or of the frames of a film.
    pub target: Target,
    /// The format of their files.
    pub format: PictureFormat,
    /// The resolved style.
    pub look: Look,
    /// The options of the renderer.
    pub options: RendererOptions,
    /// The folder that keeps prepared data between runs; `None` for no cache.
    pub cache: Option<PathBuf>,
}

impl<'a> Job<'a> {
    /// Resolves the arguments. Reads the style with its pictures and fonts, but not the scene.
    pub fn resolve(args: &'a RenderArguments) -> Result<Self, Fault> {
        let source = Source::of(args.scene.as_deref().unwrap_or(Path::new("-")));
        let path = output_path(args.output.as_deref(), &source, "png")?;
        let format = format_of(&path)?;
        if args.debug_layer.is_some() && format != PictureFormat::Png {
            let message = "--debug-layer shows one layer as a picture: write it as .png";
            return Err(Fault::new(Exit::Usage, message));
        }
        Self::drawn_into(args, source, Target::One(Output::of(&path)?), format)
    }

    /// The job of pictures in a format that go to a target.
    pub fn drawn_into(
        args: &'a RenderArguments,
        source: Source,
        target: Target,
        format: PictureFormat,
    ) -> Result<Self, Fault> {
        let external = args.drawing.allow_external.as_deref();
        let look = Look::resolve(&args.look(), external)?.with_smoke(&args.drawing.volumes);
        let small = renderer_options(&args.drawing, &look)?;
        let [width, height] = small.size.map(|side| side.saturating_mul(args.enlarge));
        check_size(Size { width, height })?;
        let options = RendererOptions {
            layers: format == PictureFormat::Exr || args.debug_layer.is_some(),
            stages: args.debug_layer.is_some(),
            surfaces: args
                .debug_layer
                .map_or_else(SurfaceStage::default, DebugLayer::surfaces),
            size: [width, height],
            enlarged: args.enlarge,
            ..small
        };
        Ok(Self {
            args,
            source,
            target,
            format,
            look,
            options,
            cache: args.cache.folder()?,
        })
    }
}

impl RenderArguments {
    /// The arguments about the style. A volume alone gets a preset for smoke where the user names no style.
    pub fn look(&self) -> LookArguments {
        match &self.scene {
            Some(scene) if has_volume_name(scene) => self.drawing.look.or_style(USUAL_STYLE),
            _ => self.drawing.look.clone(),
        }
    }
}

/// The options of the renderer. Reads the pictures and fonts of the look, and refuses sizes beyond the limit.
pub fn renderer_options(args: &DrawingArguments, look: &Look) -> Result<RendererOptions, Fault> {
    check_size(args.size)?;
    let (limits, external) = (args.limits.limits(), args.allow_external.as_deref());
    Ok(RendererOptions {
        background_image: look.background_picture(&limits, external)?,
        pictures: look.pictures(&limits, external)?,
        fonts: look.fonts(&limits, external)?,
        memory_limit: limits.memory_bytes,
        ..RendererOptions::new([args.size.width, args.size.height])
    })
}

/// Refuses sizes with a side longer than the limit.
pub fn check_size(size: Size) -> Result<(), Fault> {
    let side = size.width.max(size.height);
    if side <= SIDE_LIMIT {
        return Ok(());
    }
    let message = format!(
        "picture side {side} exceeds the limit of {SIDE_LIMIT} pixels, and no option lifts that"
    );
    Err(Fault::new(Exit::Limit, message))
}

/// The format of the picture that is written to `path`; `-` takes a .png.
fn format_of(path: &Path) -> Result<PictureFormat, Fault> {
    if path.as_os_str() == "-" || has_ending(path, "png") {
        return Ok(PictureFormat::Png);
    }
    if has_ending(path, "exr") {
        return Ok(PictureFormat::Exr);
    }
    let message = format!(
        "cannot write {}: pictures are written as .png, or as .exr with layers, lines as .svg too",
        quoted(path)
    );
    Err(Fault::new(Exit::Usage, message))
}

/// Refuses file names that do not end in .png; `-` is allowed.
pub fn check_ending(path: &Path) -> Result<(), Fault> {
    if path.as_os_str() == "-" || has_ending(path, "png") {
        return Ok(());
    }
    let message = format!(
        "cannot write {}: pictures are written as .png only, lines as .svg too",
        quoted(path)
    );
    Err(Fault::new(Exit::Usage, message))
}

/// The path that the user gave, or else the scene's name with `_####.png`, in the current folder.
pub fn film_path(asked: Option<&Path>, source: &Source) -> Result<PathBuf, Fault> {
    match (asked, source) {
        (None, Source::File(scene)) => {
            let name = scene.file_stem().unwrap_or_default().to_string_lossy();
            Ok(PathBuf::from(format!("{name}_####.png")))
        }
        _ => output_path(asked, source, "png"),
    }
}

/// The path that the user gave, or else the scene's name with the extension `ending`, in the current folder.
pub fn output_path(asked: Option<&Path>, source: &Source, ending: &str) -> Result<PathBuf, Fault> {
    match (asked, source) {
        (Some(path), _) => Ok(path.to_owned()),
        (None, Source::File(scene)) => {
            let mut name = scene.file_stem().unwrap_or(scene.as_os_str()).to_owned();
            name.push(".");
            name.push(ending);
            Ok(PathBuf::from(name))
        }
        (None, Source::Standard) => {
            let message =
                "a scene from standard input has no name: say with -o where the picture goes";
            Err(Fault::new(Exit::Usage, message))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_named_after_its_scene() {
        let of = |path: &str| output_path(None, &Source::of(Path::new(path)), "png");
        assert_eq!(of("a/b.c/hero.v2.glb"), Ok(PathBuf::from("hero.v2.png")));
        assert_eq!(of("-").map_err(|fault| fault.exit), Err(Exit::Usage));
        assert_eq!(
            output_path(Some(Path::new("x.png")), &Source::Standard, "png"),
            Ok(PathBuf::from("x.png"))
        );
    }

    #[test]
    fn a_side_beyond_the_limit_names_limit_and_value() {
        let fault = check_size(Size {
            width: 8,
            height: 40_000,
        })
        .expect_err("too high");
        assert_eq!(fault.exit, Exit::Limit);
        assert!(
            fault.message.contains("40000") && fault.message.contains("32768"),
            "{}",
            fault.message
        );
    }
}
