//! Textures: which image a material uses, and how.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::borrow::Cow;

use ::gltf::json::image::Image as JsonImage;
use ::gltf::json::texture::{Info, Sampler, Texture, WrappingMode};
use ::gltf::json::validation::Checked;

use super::accessor::Accessors;
use super::error::{GltfError, Item};
use crate::decode::{self, DecodeFault};
use crate::error::SceneError;
use crate::image::Image;
use crate::laid::{TextureTransform, TextureUse, Wrap};
use crate::loading::Loading;
use crate::pool::Pool;
use crate::shown::shown;
use crate::uri;

/// What tells whether two images are the same.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Source<'a> {
    View(usize),
    Uri(&'a str),
}

/// Images decoded so far, each source once.
pub(crate) struct Textures<'a> {
    accessors: &'a Accessors<'a>,
    images: Pool<Source<'a>, Image>,
}

impl<'a> Textures<'a> {
    pub(crate) fn new(accessors: &'a Accessors<'a>) -> Self {
        Self {
            accessors,
            images: Pool::default(),
        }
    }

    /// The texture that `info` of material `material` describes; none where its image is broken.
    ///
    /// # Errors
    ///
    /// A texture or image that does not exist, or images beyond a limit.
    pub(crate) fn read(
        &mut self,
        info: &Info,
        material: u32,
        loading: &mut Loading,
    ) -> Result<Option<TextureUse>, SceneError> {
        // Find the texture and how it repeats.
        let index = info.index.value();
        let user = Item::new("material", material as usize);
        let item = Item::new("texture", index);
        let root = self.accessors.root;
        let missing = GltfError::Missing {
            user,
            item,
            count: root.textures.len(),
        };
        let texture = root.textures.get(index).ok_or(missing)?;
        let sampler = texture
            .sampler
            .and_then(|sampler| root.samplers.get(sampler.value()));

        // Join its image with how the material lays it on the surface.
        let image = self.image(texture, item, loading)?;
        Ok(image.map(|image| TextureUse {
            image,
            uv_set: info_uv_set(info),
            wrap: wrap(sampler),
            transform: transform(info, loading),
        }))
    }

    fn image(
        &mut self,
        texture: &Texture,
        user: Item,
        loading: &mut Loading,
    ) -> Result<Option<u32>, SceneError> {
        let index = texture.source.value();
        let count = self.accessors.root.images.len();
        // The types mark a texture without a source by the highest index.
        if index == u32::MAX as usize {
            loading
                .notices
                .add(format!("{user} has no PNG or JPEG image and is left out"));
            return Ok(None);
        }
        let item = Item::new("image", index);
        let image = self
            .accessors
            .root
            .images
            .get(index)
            .ok_or(GltfError::Missing { user, item, count })?;
        let Some(source) = source(image) else {
            loading.notices.add(format!(
                "{item} has neither a buffer view nor a URI and is left out"
            ));
            return Ok(None);
        };
        let accessors = self.accessors;
        let name = image.name.as_deref().unwrap_or_default();
        self.images
            .place(source, || decode(accessors, &source, name, item, loading))
    }

    /// The images decoded so far.
    pub(crate) fn into_images(self) -> Vec<Image> {
        self.images.items
    }
}

/// Which set of texture coordinates `info` uses; its transform may name another one.
pub(crate) fn info_uv_set(info: &Info) -> u32 {
    let transform = info
        .extensions
        .as_ref()
        .and_then(|extensions| extensions.texture_transform.as_ref());
    transform
        .and_then(|transform| transform.tex_coord)
        .unwrap_or(info.tex_coord)
}

fn decode(
    accessors: &Accessors,
    source: &Source,
    name: &str,
    item: Item,
    loading: &mut Loading,
) -> Result<Option<Image>, SceneError> {
    // Mention the file where images are not wanted.
    if !loading.allowance.limits.decode_images {
        if let Source::Uri(uri) = source {
            uri::mention(uri, loading.resources);
        }
        return Ok(None);
    }

    // Decode the image; one that is broken is left out, one beyond a limit ends the load.
    let bytes = bytes(accessors, source, item, loading);
    let fault = match bytes.map(|bytes| decode::decode(name, &bytes, &mut loading.allowance)) {
        Ok(Ok(image)) => return Ok(Some(image)),
        Ok(Err(DecodeFault::TooLarge(fault))) => return Err(fault.into()),
        Ok(Err(DecodeFault::Broken)) => format!("'{}' is no sound PNG or JPEG", shown(name)),
        Err(fault) if fault.is_limit() => return Err(fault),
        Err(fault) => fault.to_string(),
    };
    loading.notices.add(format!("{item} is left out: {fault}"));
    Ok(None)
}

fn bytes<'a>(
    accessors: &Accessors<'a>,
    source: &Source,
    item: Item,
    loading: &Loading,
) -> Result<Cow<'a, [u8]>, SceneError> {
    match *source {
        Source::View(view) => Ok(Cow::Borrowed(accessors.buffers.view(
            accessors.root,
            view,
            item,
        )?)),
        Source::Uri(uri) => {
            let limit_bytes = loading.allowance.limits.file_bytes;
            Ok(Cow::Owned(uri::read(uri, loading.resources, limit_bytes)?))
        }
    }
}

fn source(image: &JsonImage) -> Option<Source<'_>> {
    let view = image.buffer_view.map(|view| Source::View(view.value()));
    view.or(image.uri.as_deref().map(Source::Uri))
}

fn wrap(sampler: Option<&Sampler>) -> [Wrap; 2] {
    let Some(sampler) = sampler else {
        return [Wrap::Repeat; 2];
    };
    [sampler.wrap_s, sampler.wrap_t].map(|mode| match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    })
}

fn transform(info: &Info, loading: &mut Loading) -> TextureTransform {
    // Read how the texture is moved, turned and scaled.
    let extension = info
        .extensions
        .as_ref()
        .and_then(|extensions| extensions.texture_transform.as_ref());
    let Some(extension) = extension else {
        return TextureTransform::default();
    };
    let transform = TextureTransform {
        offset: extension.offset.0,
        rotation: extension.rotation.0,
        scale: extension.scale.0,
    };

    // Leave out a transform that is not finite.
    let numbers = transform
        .offset
        .into_iter()
        .chain(transform.scale)
        .chain([transform.rotation]);
    if numbers.into_iter().all(f32::is_finite) {
        return transform;
    }
    loading
        .notices
        .add("a texture transform is not finite and is left out");
    TextureTransform::default()
}
