//! The list `lettering` of a style: words over the picture, such as sound effects and captions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::StyleError;
use crate::{Color, Length, Unit};

/// Most entries of `lettering` in a style.
pub const LETTERING_MAX: usize = 64;

/// A band around letters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LetteringOutline {
    /// Colour of the band; default black.
    pub color: Color,
    /// How far it reaches beyond what it surrounds; default 8. 4 a thin rim, 16 a poster.
    pub width: Length,
}

impl Default for LetteringOutline {
    fn default() -> Self {
        Self {
            color: Color::BLACK,
            width: Length::ref_px(8.0),
        }
    }
}

/// Words drawn over the finished picture, in the frame or at a place of the scene.
///
/// Lengths are pixels of the frame unless in `world` units, which need an anchor.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lettering {
    /// The words, up to 400 characters; line breaks part lines, which are centred.
    pub text: String,
    /// A font file (`.ttf`, `.otf`, `.ttc`), found as pictures are: beside the style file, or from the current folder
    /// where the command line names it.
    pub font: String,
    /// Height of a capital letter; default 15 % of the frame. In `world` units it shrinks with the anchor's distance.
    #[serde(default = "default_size")]
    pub size: Length,
    /// Where the middle of the words lies, as parts of the frame's width and height from the upper left, -1..2; default
    /// the middle, a fifth below the top. Not used with an anchor.
    #[serde(default = "default_at")]
    #[schemars(inner(range(min = -1.0, max = 2.0)))]
    pub at: [f32; 2],
    /// A place in the scene that the middle of the words lies on; default none. Behind the eye they are left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub anchor: Option<[f32; 3]>,
    /// Whether surfaces that stand before the anchor hide the words; default false, they lie over everything. Takes an
    /// anchor. Smoke and beams hide no words, and in line drawings nothing does.
    #[serde(default)]
    pub hidden: bool,
    /// Part of half a turn that lines bend by, -1..1; default 0. 0.3 an arch, -0.3 a bowl. Short words bend less.
    #[serde(default)]
    #[schemars(range(min = -1.0, max = 1.0))]
    pub bend: f32,
    /// How far letters lean to the right per height, -1..1; default 0. 0.2 an italic, -0.2 a word that brakes.
    #[serde(default)]
    #[schemars(range(min = -1.0, max = 1.0))]
    pub slant: f32,
    /// Turn of the whole in degrees, counter-clockwise, -180..180; default 0. 10 suits most sounds.
    #[serde(default)]
    #[schemars(range(min = -180.0, max = 180.0))]
    pub rotate_deg: f32,
    /// How much letters grow from the first to the last, -0.8..0.8; default 0. 0.4 comes nearer, -0.4 dies away.
    #[serde(default)]
    #[schemars(range(min = -0.8, max = 0.8))]
    pub spread: f32,
    /// Space added between letters, in heights of a capital, -0.5..2; default 0. Wide outlines want 0.1.
    #[serde(default)]
    #[schemars(range(min = -0.5, max = 2.0))]
    pub spacing: f32,
    /// From line to line, in heights of a capital, 0.5..5; default 1.3. More where letters of two lines would meet,
    /// unless below 1.
    #[serde(default = "default_line_step")]
    #[schemars(range(min = 0.5, max = 5.0))]
    pub line_step: f32,
    /// Colour of the letters; default yellow.
    #[serde(default = "default_color")]
    pub color: Color,
    /// The band around the letters; default black and 8 wide. Width 0 for none.
    #[serde(default)]
    pub outline: LetteringOutline,
    /// A second band around the first; default none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub second_outline: Option<LetteringOutline>,
}

fn default_size() -> Length {
    Length {
        value: 15.0,
        unit: Unit::FrameHeight,
    }
}

fn default_at() -> [f32; 2] {
    [0.5, 0.2]
}

fn default_line_step() -> f32 {
    1.3
}

fn default_color() -> Color {
    Color::rgb(0xff, 0xd4, 0x1f)
}

impl Lettering {
    /// Words in a font, with defaults for everything else.
    pub fn new(text: &str, font: &str) -> Self {
        Self {
            text: text.to_owned(),
            font: font.to_owned(),
            size: default_size(),
            at: default_at(),
            anchor: None,
            hidden: false,
            bend: 0.0,
            slant: 0.0,
            rotate_deg: 0.0,
            spread: 0.0,
            spacing: 0.0,
            line_step: default_line_step(),
            color: default_color(),
            outline: LetteringOutline::default(),
            second_outline: None,
        }
    }

    /// The bands from the letters outwards.
    pub fn bands(&self) -> impl Iterator<Item = &LetteringOutline> {
        [&self.outline].into_iter().chain(&self.second_outline)
    }

    /// Refuses an empty font name. Refuses lengths in world units, and `hidden`, without an anchor.
    pub(crate) fn check(&self, index: usize) -> Result<(), StyleError> {
        // Refuse words without a font.
        let unfit = |key: &str, reason: &str| {
            Err(StyleError::unfit(
                format!("lettering.{index}.{key}"),
                reason,
            ))
        };
        if self.font.is_empty() {
            return unfit("font", "names no file");
        }

        // Refuse lengths in world units, and `hidden`, for words without an anchor.
        let needs_place = |length: Length| length.unit == Unit::World && self.anchor.is_none();
        let reason = "is in world units, but the words have no anchor";
        let second = self.second_outline.as_ref();
        if needs_place(self.size) {
            return unfit("size", reason);
        }
        if needs_place(self.outline.width) {
            return unfit("outline.width", reason);
        }
        if second.is_some_and(|band| needs_place(band.width)) {
            return unfit("second_outline.width", reason);
        }
        if self.hidden && self.anchor.is_none() {
            return unfit("hidden", "takes an anchor, which the words lack");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Style;

    fn read(text: &str) -> Result<Style, StyleError> {
        Style::from_toml(text, &|parent| Err(format!("no '{parent}'")))
    }

    #[test]
    fn text_and_font_are_enough() {
        let style = read("[[lettering]]\ntext = \"POW!\"\nfont = \"a.ttf\"").expect("a style");
        assert_eq!(style.lettering, [Lettering::new("POW!", "a.ttf")]);
        assert_eq!(style.lettering[0].bands().count(), 1);
    }

    #[test]
    fn what_is_written_is_read_again() {
        let file = "[[lettering]]\ntext = \"BOOM\\nCRASH\"\nfont = \"a.otf\"\nsize = \"0.4world\"\nanchor = [1, 2, 3]\n\
                    bend = 0.3\noutline = { color = \"red\", width = \"1%h\" }\nsecond_outline = { width = 20 }";
        let style = read(file).expect("a style");
        let written = style.to_toml().expect("TOML");
        assert_eq!(read(&written), Ok(style));
    }

    #[test]
    fn slips_are_told_with_their_place() {
        let reported = |text: &str| read(text).expect_err("a slip").to_string();
        let words = "[[lettering]]\ntext = \"A\"\nfont = \"a.ttf\"\n";
        assert_eq!(
            reported("[[lettering]]\ntext = \"A\""),
            "lettering.0 at line 1, column 1 lacks 'font'"
        );
        assert_eq!(
            reported(&format!("{words}bent = 0.3")),
            "unknown key 'lettering.0.bent' at line 4, column 1; did you mean 'lettering.0.bend'?"
        );
        assert_eq!(
            reported(&format!("{words}bend = 2")),
            "lettering.0.bend at line 4, column 1 is 2, but must lie in -1..1"
        );
        assert_eq!(
            reported(&format!("{words}anchor = [0, nan, 0]")),
            "lettering.0.anchor.1 at line 4, column 14 is NaN, but must lie in -1e9..1e9"
        );
        assert_eq!(
            reported("[line.width]\nmin = 10\nmax = 1.3"),
            "line.width.min at line 2, column 1 is 10, but must lie in 0..1.3"
        );
        assert_eq!(
            reported("[ink.hatch]\nseed = -1"),
            "ink.hatch.seed at line 2, column 1 is -1, but must lie in 0..4294967295"
        );
        assert_eq!(
            reported(&format!("{words}size = \"1world\"")),
            "lettering.0.size at line 4, column 1 is in world units, but the words have no anchor"
        );
        assert_eq!(
            reported(&format!("{words}hidden = true")),
            "lettering.0.hidden at line 4, column 1 takes an anchor, which the words lack"
        );
        let many = words.repeat(LETTERING_MAX + 1);
        assert!(
            reported(&many).contains("has 65 entries, but must have 0 to 64"),
            "{}",
            reported(&many)
        );
    }
}
