//! The job of `npr lines`: its arguments, resolved and checked.

use crate::arguments::{
    HiddenLines, LineArguments, LineFormat, LinesArguments, LookArguments, PaintedName, PathForm,
    Switch,
};
use crate::ending::has_ending;
use crate::fault::{Exit, Fault};
use crate::job::{check_size, output_path, renderer_options};
use crate::look::Look;
use crate::message::quoted;
use crate::output::Output;
use crate::source::{Source, has_volume_name};
use crate::target::Target;
use crate::volume::{self, VolumeSource};
use npr_core::crease::CreaseFrom;
use npr_core::geometry::Part;
use npr_drawing::artwork::{ArtworkOptions, Hidden, Page, Paths, arrange};
use npr_render::{Drawing, Kind, KindSet, Lettering, LineOptions, PaintedLines, RendererOptions};
use npr_scene::Limits;
use npr_stylesheet::{Background, Facts, LineForm, LineOutput, Occasion, Style};
use std::path::{Path, PathBuf};

const MM_PER_INCH: f64 = 25.4;

/// One line drawing. Everything that can be checked without reading the scene is already checked.
pub struct LineJob<'a> {
    /// The arguments, for everything that needs no resolving.
    pub args: &'a LinesArguments,
    /// The source of the scene.
    pub source: Source,
    /// The limits for loading.
    pub limits: Limits,
    /// The destination of the drawing, or of the frames of a film.
    pub target: Target,
    /// The format of their files.
    pub format: LineFormat,
    /// The resolved style.
    pub look: Look,
    /// The options that choose the lines and how they are found.
    pub options: LineOptions,
    /// The options of the file: paths, hidden lines, background and page.
    pub artwork: ArtworkOptions,
    /// Words over the lines, set in their fonts.
    pub lettering: Lettering,
    /// The options that draw the background, where the style adapts lines to it.
    pub backdrop: Option<RendererOptions>,
    /// The folder that keeps prepared data between runs; `None` for no cache.
    pub cache: Option<PathBuf>,
}

impl<'a> LineJob<'a> {
    /// Resolves the arguments. Reads the style and its fonts, but not the scene.
    pub fn resolve(args: &'a LinesArguments) -> Result<Self, Fault> {
        let source = Source::of(args.scene.as_deref().unwrap_or(Path::new("-")));
        let ending = args.format.map_or("svg", LineFormat::ending);
        let path = output_path(args.output.as_deref(), &source, ending)?;
        let format = format_of(args.format, &path)?;
        Self::drawn_into(args, source, Target::One(Output::of(&path)?), format)
    }

    /// The job of drawings in a format that go to a target.
    pub fn drawn_into(
        args: &'a LinesArguments,
        source: Source,
        target: Target,
        format: LineFormat,
    ) -> Result<Self, Fault> {
        check_size(args.drawing.size)?;
        check_page(args, format)?;
        check_hidden(&args.lines)?;
        let external = args.drawing.allow_external.as_deref();
        let look = Look::resolve(&args.look(), external)?.with_smoke(&args.drawing.volumes);
        let fonts = look.fonts(&args.drawing.limits.limits(), external)?;
        let contrast = look.style.contrasts_with_background();
        let backdrop = contrast.then(|| renderer_options(&args.drawing, &look));
        Ok(Self {
            lettering: Lettering::new(&look.style, &fonts)?,
            source,
            limits: Limits {
                // Id maps are placed as the textures of a part, which are known only where images are decoded.
                decode_images: contrast
                    || args.lines.painted.is_some()
                    || fills_by_textures(args, &look.style)
                    || !look.style.id_map.is_empty()
                    || look.style.line_paint_flags() & Part::LINE_SURFACE != 0,
                ..args.drawing.limits.limits()
            },
            target,
            format,
            options: options(args, &look.style),
            artwork: artwork(args, &look.style),
            look,
            backdrop: backdrop.transpose()?,
            cache: args.cache.folder()?,
            args,
        })
    }
}

/// Whether regions of colour are drawn that textures have a part in.
pub fn fills_by_textures(args: &LinesArguments, style: &Style) -> bool {
    args.lines.fill && style.fills_with_textures()
}

impl LineJob<'_> {
    /// Whether the file holds the strokes of brushes as stamps.
    pub fn lays_brushes(&self) -> bool {
        self.artwork.paths == Paths::Stamps && self.format != LineFormat::Json
    }

    /// The occasion that decides which keys of the style have an effect.
    pub fn occasion(&self, scene: Facts) -> Occasion {
        let source = self.options.method;
        let form = match (self.format, self.artwork.paths) {
            (LineFormat::Json, _) => LineForm::Data,
            (_, Paths::Centreline) => LineForm::Centrelines,
            (_, Paths::Stamps) => LineForm::Stamps,
            (_, Paths::Outline) => LineForm::Ink,
        };
        let fill = self.options.fill;
        Occasion {
            output: npr_stylesheet::Output::Lines(LineOutput { source, form, fill }),
            scene,
        }
    }
}

impl LinesArguments {
    /// The built-in source of smoke that the argument `scene` names; `None` where there is a file of that name.
    pub fn built_in(&self) -> Option<VolumeSource> {
        let name = self.scene.as_deref().filter(|name| !name.exists())?;
        let source = VolumeSource::of(name);
        matches!(source, VolumeSource::BuiltIn(_)).then_some(source)
    }

    /// Whether the scene is smoke and nothing else, as far as its name tells.
    fn is_smoke(&self) -> bool {
        self.scene.as_deref().is_some_and(has_volume_name) || self.built_in().is_some()
    }

    /// The arguments about the style. Smoke alone gets a preset for smoke where the user names no style.
    pub fn look(&self) -> LookArguments {
        let look = &self.drawing.look;
        match self.built_in() {
            Some(source) => look.or_style(volume::usual_style(&source)),
            None if self.is_smoke() => look.or_style(volume::USUAL_STYLE),
            None => look.clone(),
        }
    }
}

impl LineFormat {
    /// The extension of its files, without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Json => "json",
            Self::Pdf => "pdf",
            Self::Png => "png",
        }
    }
}

/// The format that the user gave, or else that of the path's extension; SVG on standard output.
fn format_of(asked: Option<LineFormat>, path: &Path) -> Result<LineFormat, Fault> {
    // Take the format asked for; standard output has no name to tell one.
    if let Some(format) = asked {
        return Ok(format);
    }
    if path.as_os_str() == "-" {
        return Ok(LineFormat::Svg);
    }

    // Take the format of the name's ending.
    let formats = [
        LineFormat::Svg,
        LineFormat::Json,
        LineFormat::Pdf,
        LineFormat::Png,
    ];
    let of_name = |format: &LineFormat| has_ending(path, format.ending());
    formats.into_iter().find(of_name).ok_or_else(|| {
        let message = format!(
            "cannot write {}: lines are written as .svg, .json, .pdf or .png",
            quoted(path)
        );
        Fault::new(Exit::Usage, message)
    })
}

/// Refuses `--page` for formats without pages.
fn check_page(args: &LinesArguments, format: LineFormat) -> Result<(), Fault> {
    let has_page = matches!(format, LineFormat::Svg | LineFormat::Pdf);
    if args.sheet.page.is_none() || has_page {
        return Ok(());
    }
    let message = format!(
        "--page: only .svg and .pdf have pages, not .{}",
        format.ending()
    );
    Err(Fault::new(Exit::Usage, message))
}

/// Refuses `--hidden` for methods that find no hidden lines.
fn check_hidden(args: &LineArguments) -> Result<(), Fault> {
    if !args.method.is_of_pixels() || args.hidden == HiddenLines::None {
        return Ok(());
    }
    let message = format!(
        "--hidden: --method {} finds lines in a picture, which shows no hidden ones: \
         use --method edges or surface",
        args.method.name()
    );
    Err(Fault::new(Exit::Usage, message))
}

/// The line options of the style, with the arguments in place of its own values.
fn options(args: &LinesArguments, style: &Style) -> LineOptions {
    let of_style =
        LineOptions::of_style(style, [args.drawing.size.width, args.drawing.size.height]);
    let LineArguments {
        kinds,
        crease,
        crease_from,
        split,
        method,
        hidden,
        smooth,
        fill,
        ..
    } = &args.lines;
    let named = kinds.as_ref().map(|names| {
        let named = names.iter().copied();
        named.chain([Kind::Marked]).collect::<KindSet>()
    });
    LineOptions {
        kinds: named.unwrap_or(of_style.kinds),
        crease: crease.map_or(of_style.crease, f32::to_radians),
        crease_slack: crease.map_or(of_style.crease_slack, |_| 0.0),
        crease_hard: crease.map_or(of_style.crease_hard, |_| std::f32::consts::PI),
        crease_round: crease.map_or(of_style.crease_round, |_| 0.0),
        crease_from: crease_from.map_or(of_style.crease_from, CreaseFrom::from),
        split: split.map_or(of_style.split, LineOptions::split_at),
        method: *method,
        painted: args.lines.painted.map(|painted| match painted {
            PaintedName::Dark => PaintedLines::Dark,
            PaintedName::Light => PaintedLines::Light,
            PaintedName::Both => PaintedLines::Both,
        }),
        smooth: *smooth == Switch::On,
        hidden: *hidden != HiddenLines::None,
        // Smoke needs more than its outline, except on a pen plotter.
        fill: *fill || args.is_smoke() && args.sheet.svg != PathForm::Centreline,
        dpi: args
            .sheet
            .page
            .map_or(of_style.dpi, |page| dpi_on(page, of_style.size)),
        ..of_style
    }
}

/// Pixels per inch of a picture of `size` pixels on a page.
fn dpi_on(page: Page, size: [u32; 2]) -> f32 {
    let nothing = Drawing {
        size,
        ..Drawing::default()
    };
    let options = ArtworkOptions {
        page: Some(page),
        ..ArtworkOptions::default()
    };
    (MM_PER_INCH / arrange(&nothing, &options).scale) as f32
}

/// The options of the file.
fn artwork(args: &LinesArguments, style: &Style) -> ArtworkOptions {
    let paths = match args.sheet.svg {
        PathForm::Outline => Paths::Outline,
        PathForm::Centreline => Paths::Centreline,
        PathForm::Stamps => Paths::Stamps,
    };
    ArtworkOptions {
        paths,
        hidden: match args.lines.hidden {
            HiddenLines::None => Hidden::None,
            HiddenLines::Layer => Hidden::Layer,
            HiddenLines::Dashed => Hidden::Dashed,
        },
        background: match style.background {
            // A pen plotter would draw the outline of the background.
            _ if paths == Paths::Centreline => None,
            Background::Color(color) => Some([color.r, color.g, color.b, color.a]),
            Background::Transparent | Background::Image(_) => None,
        },
        page: args.sheet.page,
        ..ArtworkOptions::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_tells_the_format_unless_the_user_does() {
        let of = |asked, name: &str| format_of(asked, Path::new(name));
        assert_eq!(of(None, "a/b.SVG"), Ok(LineFormat::Svg));
        assert_eq!(of(None, "b.json"), Ok(LineFormat::Json));
        assert_eq!(of(None, "-"), Ok(LineFormat::Svg));
        assert_eq!(of(Some(LineFormat::Pdf), "-"), Ok(LineFormat::Pdf));
        assert_eq!(of(Some(LineFormat::Png), "b.svg"), Ok(LineFormat::Png));
        let fault = of(None, "b.eps").expect_err("not written");
        assert_eq!(fault.exit, Exit::Usage);
    }
}
