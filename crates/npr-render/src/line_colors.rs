//! What styles say about the colour of lines, in parts and in the texture store.

use crate::error::RenderError;
use crate::options::Picture;
use crate::part_info::PartInfo;
use npr_core::color::pack_rgba8;
use npr_core::geometry::{NONE, Part};
use npr_core::texture::{TextureStore, Wrap};
use npr_style::line_color::HUES;
use npr_stylesheet::{HueStop, LineColorSource, Look, OutlineMethod, Style, hue_row};
use std::collections::BTreeMap;

/// Rows and pictures that are in a texture store already, each once.
#[derive(Debug, Default)]
struct Kept<'a> {
    rows: BTreeMap<Vec<u8>, u32>,
    pictures: BTreeMap<&'a str, u32>,
}

/// Gives parts the colours of their lines by the style, with rows and pictures in the texture store.
///
/// `infos` are those of the first parts, `radius` is that of all of them together; `pictures` holds those of the
/// style by name.
pub(crate) fn add_line_colors(
    infos: &[PartInfo],
    style: &Style,
    pictures: &BTreeMap<String, Picture>,
    radius: f32,
    parts: &mut [Part],
    textures: &mut TextureStore,
) -> Result<(), RenderError> {
    let looks: Vec<Look<'_>> = infos.iter().map(|info| info.look(style)).collect();
    // A mask drawn as it is has the style's colour of lines, but for parts of which more is decided.
    let is_filtered = matches!(
        style.line.method,
        OutlineMethod::Filter | OutlineMethod::FilterHull
    );
    let mut kept = Kept::default();
    for (part, look) in parts.iter_mut().zip(&looks) {
        let paint = &look.line_paint;
        paint.give_to(part, style.line.opacity, radius);
        let has_own =
            paint.source == LineColorSource::Constant && look.line_color != style.line.color;
        if is_filtered && has_own {
            give_to_kinds(part);
        }
        part.line_depth_row = kept.row(&paint.depth.ramp, textures);
        part.line_light_row = kept.row(&paint.light.ramp, textures);
        part.line_texture = NONE;
        if part.line_flags & Part::LINE_TEXTURE != 0 {
            part.line_texture = kept.picture(&paint.image, pictures, textures)?;
        }
    }
    Ok(())
}

/// Gives a part's line colour to every line kind that has none of its own.
fn give_to_kinds(part: &mut Part) {
    for (i, kind) in part.line_kinds.iter_mut().enumerate() {
        if part.line_flags & 1 << i == 0 {
            *kind = pack_rgba8(part.line_color);
            part.line_flags |= 1 << i;
        }
    }
}

impl<'a> Kept<'a> {
    /// Where the row of some stops starts; [`NONE`] where there are none.
    fn row(&mut self, stops: &[HueStop], textures: &mut TextureStore) -> u32 {
        if stops.is_empty() {
            return NONE;
        }
        let row = hue_row(stops);
        if let Some(start) = self.rows.get(&row) {
            return *start;
        }
        let start = textures.add([HUES as u32, 1], &row, [Wrap::Clamp; 2]);
        let start = start.unwrap_or(NONE);
        self.rows.insert(row, start);
        start
    }

    /// Where a picture starts; [`NONE`] where the store has no room.
    fn picture(
        &mut self,
        name: &'a str,
        pictures: &BTreeMap<String, Picture>,
        textures: &mut TextureStore,
    ) -> Result<u32, RenderError> {
        if let Some(start) = self.pictures.get(name) {
            return Ok(*start);
        }
        let picture = pictures
            .get(name)
            .ok_or_else(|| RenderError::MissingPicture {
                key: "line.paint.image".to_owned(),
                name: name.to_owned(),
            })?;
        let start = textures.add(picture.size, &picture.rgba, [Wrap::Repeat; 2]);
        let start = start.unwrap_or(NONE);
        self.pictures.insert(name, start);
        Ok(start)
    }
}

/// Whether any part has line flags: colours or widths beyond one plain value.
pub(crate) fn is_any_painted(parts: &[Part]) -> bool {
    parts.iter().any(|part| part.line_flags != 0)
}

/// Whether light changes the width of any line.
pub(crate) fn is_any_width_lit(parts: &[Part]) -> bool {
    let is_lit = |part: &Part| part.line_flags & Part::LINE_WIDTH != 0;
    parts.iter().any(is_lit)
}
