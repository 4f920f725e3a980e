//! The style of a picture, resolved from preset or file and overrides, with the pictures and fonts it names.

use crate::arguments::{LookArguments, VolumeArguments};
use crate::fault::{Exit, Fault};
use crate::input::read_file;
use crate::message::quoted;
use crate::output::folder_of;
use crate::picture;
use crate::style_source::StyleSource;
use npr_render::{Font, Picture};
use npr_scene::{FolderResources, Limits, Resources, Scene};
use npr_stylesheet::{
    Background, Color, Occasion, OutlineMethod, Rule, ShadeMode, Stated, Stop, Style, Tone, Unit,
    WidthSource, WidthWarning, width_rule,
};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The style of a picture, with the paths of the files that it names.
#[derive(Debug, Clone, PartialEq)]
pub struct Look {
    /// The style with all overrides applied.
    pub style: Style,
    /// The style without `--background`, and which of its keys the user stated.
    stated: Stated,
    background: Option<PictureFile>,
    /// Fonts of its lettering, each name once, with the key that names it first.
    fonts: Vec<NamedFile>,
    /// Pictures that its tones are made from.
    pictures: Vec<NamedFile>,
    /// Pictures of its id maps.
    id_maps: Vec<NamedFile>,
    /// The style file and its parents.
    style_files: Vec<PathBuf>,
}

/// A file that a style names.
#[derive(Debug, Clone, PartialEq, Eq)]
enum PictureFile {
    /// A path from the command line: any file, relative to the current folder.
    Typed(PathBuf),
    /// A name from a style file: confined to that file's folder.
    Beside { folder: PathBuf, name: String },
}

/// A font or picture that a style names by a key.
#[derive(Debug, Clone, PartialEq, Eq)]
struct NamedFile {
    /// The name in the style.
    name: String,
    /// The key that names it first.
    key: String,
    file: PictureFile,
}

impl Look {
    /// The style that the user asked for.
    ///
    /// The preset or file comes first, then `--set` in order, then `--background`; later ones win. Reads the style
    /// file with its parents, but no pictures and fonts.
    pub fn resolve(args: &LookArguments, external: Option<&Path>) -> Result<Self, Fault> {
        // Read the style, and apply the user's overrides.
        let source = StyleSource::of(args.style.as_deref());
        let (mut stated, style_files) = source.load_with_files(external)?;
        let written = stated.style().clone();
        stated
            .set_all(&args.overrides)
            .map_err(|error| Fault::new(Exit::Usage, format!("--set: {error}")))?;
        let mut style = stated.style().clone();
        if let Some(background) = &args.background {
            style.background = background.clone();
        }

        // Locate the files that it names: beside the style file, or from the current folder.
        let file = |now: Option<&str>, before: Option<&str>| {
            now.map(|name| PictureFile::of(name, source.file().filter(|_| now == before)))
        };
        Ok(Self {
            background: file(background_name(&style), background_name(&written)),
            fonts: font_files(&style, &written, source.file()),
            pictures: picture_files(&style, &written, source.file(), Style::named_pictures),
            id_maps: picture_files(&style, &written, source.file(), Style::id_map_pictures),
            style_files,
            stated,
            style,
        })
    }

    /// The look with the arguments about smoke applied.
    pub fn with_smoke(mut self, args: &VolumeArguments) -> Self {
        self.style.smoke = args.over(&self.style.smoke);
        self
    }

    /// The picture behind the scene, where there is one.
    pub fn background_picture(
        &self,
        limits: &Limits,
        external: Option<&Path>,
    ) -> Result<Option<Picture>, Fault> {
        self.background
            .as_ref()
            .map(|file| file.load(limits, external))
            .transpose()
    }

    /// The fonts of the style's words, by the names that it gives them.
    pub fn fonts(
        &self,
        limits: &Limits,
        external: Option<&Path>,
    ) -> Result<BTreeMap<String, Font>, Fault> {
        load_named(&self.fonts, |file| file.load_font(limits, external))
    }

    /// The pictures that its tones are made from, by the names that it gives them.
    pub fn pictures(
        &self,
        limits: &Limits,
        external: Option<&Path>,
    ) -> Result<BTreeMap<String, Picture>, Fault> {
        load_named(&self.pictures, |file| file.load(limits, external))
    }

    /// Reads the pictures of the style's id maps, and cuts the parts of a scene up by them.
    pub fn apply_id_maps(
        &self,
        scene: &mut Scene,
        limits: &Limits,
        external: Option<&Path>,
    ) -> Result<(), Fault> {
        let pictures = load_named(&self.id_maps, |file| file.load(limits, external))?;
        Ok(npr_render::apply_id_maps(scene, &self.style, &pictures)?)
    }

    /// The notices about stated keys that have no effect on an occasion.
    pub fn notices(&self, occasion: &Occasion) -> Vec<String> {
        self.stated.notices(occasion)
    }

    /// The files that this look is made from.
    pub fn inputs(&self) -> impl Iterator<Item = PathBuf> {
        let background = self.background.iter().map(PictureFile::path);
        let named = self.fonts.iter().chain(&self.pictures).chain(&self.id_maps);
        let named = named.map(|named| named.file.path());
        let styles = self.style_files.iter().cloned();
        background.chain(named).chain(styles)
    }

    /// Whether the background may leave the picture transparent.
    pub fn is_transparent(&self) -> bool {
        match self.style.background {
            Background::Transparent => true,
            Background::Color(color) => color.a < 255,
            Background::Image(_) => false,
        }
    }

    /// The colour of the paper, where the style shows nothing but lines on it; `None` where surfaces have tones or
    /// colours.
    pub fn paper_of_lines(&self) -> Option<Color> {
        let (style, shade) = (&self.style, &self.style.shade);
        let is_plain = |stop: &Stop| stop.light == 1.0 && stop.tint.is_none();
        let is_blank = |rule: &Rule| {
            let ramp = rule.shade.ramp.as_deref().unwrap_or_default();
            let is_inked = rule.ink.tone.is_some_and(|tone| tone != Tone::Off);
            let glows = rule.beam.is_some() || rule.highlight.may_show();
            let is_plain = ramp.iter().all(is_plain) && rule.shade.ramp_image.is_none();
            rule.shade.color.is_none() && is_plain && !is_inked && !glows
        };
        let lines_only = shade.mode == ShadeMode::Paper
            && shade.ramp.iter().all(is_plain)
            && shade.ramp_image.is_empty()
            && style.ink.tone == Tone::Off
            && !style.highlight.shows()
            && style.rule.iter().all(is_blank);
        lines_only.then_some(shade.paper)
    }

    /// The warning about lines that are thinner than those of their mask, in a frame `height` pixels high.
    ///
    /// There is no warning for a mask as fine as the frame, since there is no finer one, nor for widths in world units,
    /// which depend on the camera.
    pub fn width_warning(&self, height: u32) -> Option<WidthWarning> {
        let (line, scale) = (&self.style.line, self.style.detect.scale);
        let masked = matches!(line.method, OutlineMethod::Shape | OutlineMethod::Okuya);
        if !masked || scale <= 1.0 || line.width.base.unit == Unit::World {
            return None;
        }
        let factor = match line.width.source {
            WidthSource::Constant => line.width.max,
            _ => line.width.min,
        };
        width_rule(
            scale,
            line.scaled(line.width.base).to_px(height as f32, DPI, 0.0) * factor,
        )
    }
}

/// Pixels per inch of a picture on a screen, as [`npr_render::RendererOptions`] has them.
const DPI: f32 = 96.0;

fn background_name(style: &Style) -> Option<&str> {
    match &style.background {
        Background::Image(name) => Some(name),
        _ => None,
    }
}

/// The fonts that a style names. Names that the style file has itself are looked for beside it.
fn font_files(style: &Style, written: &Style, style_file: Option<&Path>) -> Vec<NamedFile> {
    let mut fonts: Vec<NamedFile> = Vec::new();
    for (index, words) in style.lettering.iter().enumerate() {
        let name = words.font.clone();
        if fonts.iter().any(|font| font.name == name) {
            continue;
        }
        let is_written = written.lettering.iter().any(|words| words.font == name);
        fonts.push(NamedFile {
            file: PictureFile::of(&name, style_file.filter(|_| is_written)),
            key: format!("lettering.{index}.font"),
            name,
        });
    }
    fonts
}

/// The picture files that `listed` finds in a style. Names that the style file has itself are looked for beside it.
fn picture_files(
    style: &Style,
    written: &Style,
    style_file: Option<&Path>,
    listed: impl Fn(&Style) -> Vec<(String, &str)>,
) -> Vec<NamedFile> {
    let written = listed(written);
    let file = |(key, name): (String, &str)| {
        let is_written = written.iter().any(|(_, other)| *other == name);
        NamedFile {
            file: PictureFile::of(name, style_file.filter(|_| is_written)),
            name: name.to_owned(),
            key,
        }
    };
    listed(style).into_iter().map(file).collect()
}

/// The loaded contents of `files`, by name. An error message starts with the key that names the file.
fn load_named<T>(
    files: &[NamedFile],
    load: impl Fn(&PictureFile) -> Result<T, Fault>,
) -> Result<BTreeMap<String, T>, Fault> {
    let load = |named: &NamedFile| {
        let loaded = load(&named.file);
        let loaded = loaded.map_err(|fault| fault.while_doing(&named.key))?;
        Ok((named.name.clone(), loaded))
    };
    files.iter().map(load).collect()
}

impl PictureFile {
    fn of(name: &str, style_file: Option<&Path>) -> Self {
        match style_file {
            None => Self::Typed(PathBuf::from(name)),
            Some(file) => Self::Beside {
                folder: folder_of(file).to_owned(),
                name: name.to_owned(),
            },
        }
    }

    fn path(&self) -> PathBuf {
        match self {
            Self::Typed(path) => path.clone(),
            Self::Beside { folder, name } => folder.join(name),
        }
    }

    fn load(&self, limits: &Limits, external: Option<&Path>) -> Result<Picture, Fault> {
        let bytes = self.read(limits, external)?;
        picture::decode(&bytes, limits).map_err(|fault| self.cannot_read(fault))
    }

    fn load_font(&self, limits: &Limits, external: Option<&Path>) -> Result<Font, Fault> {
        let bytes = self.read(limits, external)?;
        Font::new(bytes).map_err(|error| self.cannot_read(Fault::new(Exit::Input, error)))
    }

    fn read(&self, limits: &Limits, external: Option<&Path>) -> Result<Vec<u8>, Fault> {
        match self {
            Self::Typed(path) => read_file(path, limits.file_bytes),
            Self::Beside { folder, name } => {
                Ok(FolderResources::new(folder, external)?.read(name, limits.file_bytes)?)
            }
        }
    }

    fn cannot_read(&self, fault: Fault) -> Fault {
        fault.while_doing(format_args!("cannot read {}", quoted(&self.path())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_drawing::lettering::testing::block_font;

    fn look(overrides: &[&str]) -> Look {
        let overrides = overrides.iter().map(ToString::to_string).collect();
        let args = LookArguments {
            overrides,
            ..LookArguments::default()
        };
        Look::resolve(&args, None).expect("a valid style")
    }

    #[test]
    fn a_coarse_mask_under_thin_lines_is_warned_of() {
        assert_eq!(look(&[]).width_warning(1080), None);
        let coarse = look(&[
            "line.method=shape",
            "detect.scale=6",
            "line.width.base=6px",
            "line.width.min=0.5",
        ]);
        let warning = coarse
            .width_warning(1080)
            .expect("12 px of mask under 3 px of line");
        assert_eq!((warning.mask_line_px, warning.width_px), (12.0, 3.0));
    }

    #[test]
    fn pictures_named_by_the_user_are_found_from_the_current_folder() {
        let sky = look(&["background=skies/dawn.png"]);
        assert_eq!(
            sky.background,
            Some(PictureFile::Typed(PathBuf::from("skies/dawn.png")))
        );
        assert_eq!(
            sky.inputs().collect::<Vec<_>>(),
            [PathBuf::from("skies/dawn.png")]
        );
    }

    #[test]
    fn a_font_is_read_once_and_its_faults_name_key_and_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let words = |font: &str| format!("[[lettering]]\ntext = \"HI\"\nfont = \"{font}\"\n");
        let of = |style: &str| {
            let path = folder.path().join("my.toml");
            write_whole(&path, style.as_bytes());
            let args = LookArguments {
                style: Some(path.to_string_lossy().into_owned()),
                ..LookArguments::default()
            };
            Look::resolve(&args, None)
                .expect("a style")
                .fonts(&Limits::default(), None)
        };
        write_whole(&folder.path().join("a.ttf"), &block_font());
        let fonts = of(&(words("a.ttf") + &words("a.ttf"))).expect("fonts");
        assert_eq!(fonts.keys().collect::<Vec<_>>(), ["a.ttf"]);

        let fault = of(&(words("a.ttf") + &words("my.toml"))).expect_err("a style is no font");
        assert_eq!(fault.exit, Exit::Input);
        assert!(
            fault.message.starts_with("lettering.1.font: cannot read '"),
            "{}",
            fault.message
        );
        assert!(
            fault
                .message
                .ends_with("is not a TrueType, OpenType or Type 1 font"),
            "{}",
            fault.message
        );
        let fault = of(&words("../b.ttf")).expect_err("outside of the folder");
        assert!(
            fault.message.starts_with("lettering.0.font: "),
            "{}",
            fault.message
        );
    }

    /// Writes a file as the command itself does.
    fn write_whole(path: &Path, bytes: &[u8]) {
        let output = crate::output::Output::of(path).expect("a place");
        output.write(bytes).expect("room");
    }

    #[test]
    fn white_paper_without_tones_is_lines_only() {
        assert_eq!(look(&[]).paper_of_lines(), None);
        assert_eq!(look(&["shade.mode=paper"]).paper_of_lines(), None);
        let plain = look(&["shade.mode=paper", "shade.ramp=[{at=0, light=1}]"]);
        assert_eq!(plain.paper_of_lines(), Some(Color::WHITE));
        for more in [
            "ink.tone=hatch",
            "highlight.edge=crisp",
            "highlight.back.on=true",
        ] {
            let inked = look(&["shade.mode=paper", "shade.ramp=[{at=0, light=1}]", more]);
            assert_eq!(inked.paper_of_lines(), None, "{more}");
        }
    }

    #[test]
    fn only_a_see_through_background_keeps_alpha() {
        assert!(look(&["background=transparent"]).is_transparent());
        assert!(look(&["background=#fff8"]).is_transparent());
        assert!(!look(&["background=navy"]).is_transparent());
    }
}
