//! The pictures that a style's tones are made from.

use crate::error::RenderError;
use crate::model::Model;
use crate::options::Picture;
use npr_core::geometry::{NONE, Part};
use npr_core::surface::dot;
use npr_core::texture::{TextureStore, linear_texel};
use npr_style::compose::LUMA;
use npr_style::hatch::{self, HatchTile};
use npr_style::tone_row::{row_words, tone_row};
use npr_stylesheet::{SmokeStyle, Style};
use std::collections::BTreeMap;

/// The pictures given for a style, all that it names.
pub(crate) struct Pictures<'a> {
    given: &'a BTreeMap<String, Picture>,
    named: Vec<(String, &'a str)>,
}

impl<'a> Pictures<'a> {
    /// Checks that every picture that a style names was given.
    pub fn new(
        style: &'a Style,
        given: &'a BTreeMap<String, Picture>,
    ) -> Result<Self, RenderError> {
        let named = style.named_pictures();
        match named.iter().find(|(_, name)| !given.contains_key(*name)) {
            Some((key, name)) => Err(RenderError::MissingPicture {
                key: key.clone(),
                name: (*name).to_owned(),
            }),
            None => Ok(Self { given, named }),
        }
    }

    /// A picture of the style.
    pub fn of(&self, name: &str) -> Result<&Picture, RenderError> {
        let missing = || RenderError::MissingPicture {
            key: self.key_of(name),
            name: name.to_owned(),
        };
        self.given.get(name).ok_or_else(missing)
    }

    /// A picture of the style as a hatch tile with `side` texels a side, laid over its own half turn if wanted.
    pub fn hatch_tile(
        &self,
        name: &str,
        side: u32,
        turned: bool,
    ) -> Result<HatchTile, RenderError> {
        let picture = self.of(name)?;
        let luminance = luminance_of(picture);
        let hatch_picture = hatch::Picture {
            width: picture.size[0] as usize,
            height: picture.size[1] as usize,
            luminance: &luminance,
            turned,
        };
        hatch::from_image(side, &hatch_picture).map_err(|source| RenderError::Hatch {
            key: self.key_of(name),
            source,
        })
    }

    /// The part that stands for smoke: it holds its tones, from a picture where the style names one.
    pub fn smoke_part(
        &self,
        smoke: &SmokeStyle,
        textures: &mut TextureStore,
    ) -> Result<Part, RenderError> {
        let mut part = Part {
            texture: NONE,
            hatch: NONE,
            softness: smoke.softness,
            ramp: smoke.levels(),
            ..Part::default()
        };

        // Read the tones from a picture, where the style names one.
        let name = &smoke.ramp_image;
        if !name.is_empty()
            && let Some(start) = self.tone_row(name, smoke.softness, textures)?
        {
            part.tone_row = start;
            part.flags |= Part::TONE_ROW;
        }
        Ok(part)
    }

    /// Where the row of tones of a picture starts in the texture store; `None` where that has no room.
    fn tone_row(
        &self,
        name: &str,
        softness: f32,
        textures: &mut TextureStore,
    ) -> Result<Option<u32>, RenderError> {
        let picture = self.of(name)?;
        let row = tone_row(picture.size, &picture.rgba, softness);
        let row = row.map_err(|source| RenderError::Ramp {
            key: self.key_of(name),
            source,
        })?;
        Ok(textures.add_words(row_words(&row)))
    }

    /// The first key that names a picture.
    pub fn key_of(&self, name: &str) -> String {
        let mut named = self.named.iter();
        let found = named.find(|(_, other)| *other == name);
        found.map_or_else(String::new, |(key, _)| key.clone())
    }
}

/// Luminance 0..1 of every pixel over white paper, in linear light.
fn luminance_of(picture: &Picture) -> Vec<f32> {
    let store = TextureStore::new();
    let luminance = |pixel: &[u8; 4]| {
        let [r, g, b, a] = linear_texel(store.words(), u32::from_le_bytes(*pixel));
        1.0 + (dot([r, g, b], LUMA) - 1.0) * a
    };
    picture.rgba.as_chunks().0.iter().map(luminance).collect()
}

/// Gives the parts whose tones come from pictures their rows, each made once.
pub(crate) fn add_tone_rows(
    model: &Model,
    style: &Style,
    pictures: &Pictures<'_>,
    parts: &mut [Part],
    textures: &mut TextureStore,
) -> Result<(), RenderError> {
    let mut made: BTreeMap<&str, Option<u32>> = BTreeMap::new();
    for (part, info) in parts.iter_mut().zip(&model.parts) {
        let look = info.look(style);
        if look.ramp_image.is_empty() || look.beam.is_some() {
            continue;
        }

        // Make the row of each picture once.
        let start = match made.get(look.ramp_image) {
            Some(start) => *start,
            None => pictures.tone_row(look.ramp_image, style.shade.softness, textures)?,
        };
        made.insert(look.ramp_image, start);

        // Let the part read it.
        if let Some(start) = start {
            part.tone_row = start;
            part.flags |= Part::TONE_ROW;
        }
    }
    Ok(())
}
