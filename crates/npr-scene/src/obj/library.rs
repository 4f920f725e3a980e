//! Material libraries (.mtl): base colour, its image, opacity and emission.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::collections::{BTreeMap, BTreeSet};

use npr_core::color::linear_from_srgb;

use crate::alpha::AlphaMode;
use crate::decode::{self, DecodeFault};
use crate::error::SceneError;
use crate::image::Image;
use crate::laid::{TextureTransform, TextureUse, Wrap};
use crate::loading::Loading;
use crate::material::Material;
use crate::pool::Pool;
use crate::shown::shown;
use crate::words::{number, numbered_lines, triple, words};

/// A material as a library defines it.
#[derive(Debug, Clone, Default)]
struct Definition {
    material: Material,
    image: Option<String>,
}

/// Definitions read so far, and the materials that faces use.
#[derive(Debug, Default)]
pub(crate) struct Library {
    definitions: BTreeMap<Vec<u8>, Definition>,
    read: BTreeSet<String>,
    used: Vec<Vec<u8>>,
    indices: BTreeMap<Vec<u8>, u32>,
}

impl Library {
    /// Index of the material that faces call `name`.
    pub(crate) fn index(&mut self, name: &[u8]) -> u32 {
        if let Some(&index) = self.indices.get(name) {
            return index;
        }
        let index = self.used.len() as u32;
        self.used.push(name.to_vec());
        self.indices.insert(name.to_vec(), index);
        index
    }

    /// Reads the library `name`; one that cannot be read is a notice, for shape matters more.
    pub(crate) fn load(&mut self, name: &[u8], loading: &mut Loading) {
        let name = path(name);
        if !self.read.insert(name.clone()) {
            return;
        }
        match loading
            .resources
            .read(&name, loading.allowance.limits.file_bytes)
        {
            Ok(text) => self.parse(&text, folder(&name)),
            Err(fault) => loading
                .notices
                .add(format!("materials are left out: {fault}")),
        }
    }

    fn parse(&mut self, text: &[u8], folder: &str) {
        let mut current: Option<&mut Definition> = None;
        for (_, line) in numbered_lines(text) {
            let line = line.trim_ascii();
            let mut rest = words(line);
            match (rest.next(), &mut current) {
                (Some(b"newmtl"), _) => {
                    let name = line.get(b"newmtl".len()..).unwrap_or_default().trim_ascii();
                    current = Some(
                        self.definitions
                            .entry(name.to_vec())
                            .or_insert_with(|| definition(name)),
                    );
                }
                (Some(keyword), Some(definition)) => definition.set(keyword, line, folder),
                _ => {}
            }
        }
    }

    /// The materials that faces use, with their images.
    ///
    /// # Errors
    ///
    /// Images beyond a limit.
    pub(crate) fn finish(
        mut self,
        loading: &mut Loading,
    ) -> Result<(Vec<Material>, Vec<Image>), SceneError> {
        let mut materials = Vec::new();
        let mut images: Pool<String, Image> = Pool::default();
        for name in &self.used {
            let defined = self.definitions.remove(name);
            let Definition {
                mut material,
                image,
            } = defined.unwrap_or_else(|| definition(name));
            if let Some(image) = image {
                let place = images.place(image.clone(), || decode(&image, loading))?;
                material.base_color_texture = place.map(texture_use);
            }
            materials.push(material);
        }
        // Faces before the first `usemtl` have no material, and one-sided shells are common in OBJ.
        materials
            .iter_mut()
            .for_each(|material| material.double_sided = true);
        Ok((materials, images.items))
    }
}

impl Definition {
    fn set(&mut self, keyword: &[u8], line: &[u8], folder: &str) {
        let values = line.get(keyword.len()..).unwrap_or_default().trim_ascii();
        let [r, g, b, a] = self.material.base_color;
        match keyword {
            b"Kd" => {
                let [r, g, b] = color(values).unwrap_or([r, g, b]);
                self.material.base_color = [r, g, b, a];
            }
            b"Ke" => self.material.emissive = color(values).unwrap_or_default(),
            b"d" => self.set_opacity(number(values)),
            b"Tr" => self.set_opacity(number(values).map(|transparency| 1.0 - transparency)),
            b"map_Kd" => self.image = Some(format!("{folder}{}", path(image_name(values)))),
            _ => {}
        }
    }

    fn set_opacity(&mut self, opacity: Option<f32>) {
        let Some(opacity) = opacity.filter(|opacity| opacity.is_finite()) else {
            return;
        };
        let [r, g, b, _] = self.material.base_color;
        self.material.base_color = [r, g, b, opacity.clamp(0.0, 1.0)];
        self.material.alpha = if opacity < 1.0 {
            AlphaMode::Blend
        } else {
            AlphaMode::Opaque
        };
    }
}

fn definition(name: &[u8]) -> Definition {
    let name = String::from_utf8_lossy(name).into_owned();
    Definition {
        material: Material {
            name,
            ..Material::default()
        },
        image: None,
    }
}

/// Three sRGB values as linear light.
fn color(values: &[u8]) -> Option<[f32; 3]> {
    let color = triple(&mut words(values))?;
    color
        .iter()
        .all(|v| v.is_finite())
        .then(|| color.map(|v| linear_from_srgb(v.clamp(0.0, 1.0))))
}

/// The file name of a texture line: all of it, or the last word where options come first.
fn image_name(values: &[u8]) -> &[u8] {
    if values.starts_with(b"-") {
        words(values).last().unwrap_or_default()
    } else {
        values
    }
}

/// A name as a path with forward slashes; files from other systems have the other ones.
fn path(name: &[u8]) -> String {
    String::from_utf8_lossy(name).replace('\\', "/")
}

/// The folder part of `name` with its slash, which texture names of the library start from.
fn folder(name: &str) -> &str {
    name.rfind('/')
        .and_then(|slash| name.get(..=slash))
        .unwrap_or_default()
}

fn decode(name: &str, loading: &mut Loading) -> Result<Option<Image>, SceneError> {
    if !loading.allowance.limits.decode_images {
        loading.resources.mention(name);
        return Ok(None);
    }
    let bytes = loading
        .resources
        .read(name, loading.allowance.limits.file_bytes);
    let fault = match bytes.map(|bytes| decode::decode(name, &bytes, &mut loading.allowance)) {
        Ok(Ok(image)) => return Ok(Some(image)),
        Ok(Err(DecodeFault::TooLarge(fault))) => return Err(fault.into()),
        Ok(Err(DecodeFault::Broken)) => format!("'{}' is no sound PNG or JPEG", shown(name)),
        Err(fault) => fault.to_string(),
    };
    loading
        .notices
        .add(format!("an image is left out: {fault}"));
    Ok(None)
}

fn texture_use(image: u32) -> TextureUse {
    TextureUse {
        image,
        uv_set: 0,
        wrap: [Wrap::Repeat; 2],
        transform: TextureTransform::default(),
    }
}
