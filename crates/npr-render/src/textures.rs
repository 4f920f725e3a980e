//! Images of a scene in one texture store.

use npr_core::geometry::NONE;
use npr_core::texture::{TextureStore, Wrap};
use npr_scene::{Image, Part, Scene, TextureUse};
use std::collections::BTreeMap;

/// Most words of a store: it must fit the 128 MiB that every device binds.
pub(crate) const STORE_WORDS: usize = 32 << 20;

/// Images packed so far, each once for every way in which it wraps.
#[derive(Debug, Default)]
pub(crate) struct Textures {
    pub store: TextureStore,
    starts: BTreeMap<(u32, [u8; 2]), Option<u32>>,
    /// How often every image is halved, so that all of them fit.
    halvings: u32,
    /// What was done to fit, for the user.
    pub notice: Option<String>,
}

impl Textures {
    /// An empty store for the images of a scene.
    pub fn new(scene: &Scene) -> Self {
        let texels: usize = scene
            .images
            .iter()
            .map(|image| image.width as usize * image.height as usize)
            .sum();
        // MIP levels add a third; each halving leaves a quarter.
        let mut halvings = 0;
        while (texels >> (2 * halvings)) / 3 * 4 > STORE_WORDS / 2 {
            halvings += 1;
        }
        let notice = (halvings > 0).then(|| {
            format!(
                "textures are reduced to 1/{} of their side to fit",
                1 << halvings
            )
        });
        Self {
            halvings,
            notice,
            ..Self::default()
        }
    }

    /// Where the header of a material's texture starts; `None` where the image has no pixels.
    pub fn start_of(&mut self, scene: &Scene, texture: &TextureUse) -> Option<u32> {
        let key = (texture.image, texture.wrap.map(|wrap| wrap as u8));
        if let Some(start) = self.starts.get(&key) {
            return *start;
        }
        let start = scene.images.get(texture.image as usize).and_then(|image| {
            let (size, rgba) = halved(image, self.halvings);
            self.store.add(size, &rgba, texture.wrap.map(packed_wrap))
        });
        self.starts.insert(key, start);
        start
    }
}

/// A file's way of wrapping as texture stores have it.
pub(crate) fn packed_wrap(wrap: npr_scene::Wrap) -> Wrap {
    match wrap {
        npr_scene::Wrap::Repeat => Wrap::Repeat,
        npr_scene::Wrap::Mirror => Wrap::Mirror,
        npr_scene::Wrap::Clamp => Wrap::Clamp,
    }
}

/// An image halved some times, by averaging squares of four pixels.
fn halved(image: &Image, times: u32) -> ([u32; 2], Vec<u8>) {
    let mut size = [image.width, image.height];
    let mut rgba = image.rgba.clone();
    for _ in 0..times {
        let next = size.map(|side| (side / 2).max(1));
        rgba = (0..next[1])
            .flat_map(|y| (0..next[0]).map(move |x| [x, y]))
            .flat_map(|at| average_of_four(&rgba, size, at))
            .collect();
        size = next;
    }
    (size, rgba)
}

fn average_of_four(rgba: &[u8], size: [u32; 2], at: [u32; 2]) -> [u8; 4] {
    let texel = |dx: u32, dy: u32| {
        let (x, y) = (
            (2 * at[0] + dx).min(size[0] - 1),
            (2 * at[1] + dy).min(size[1] - 1),
        );
        (y * size[0] + x) as usize * 4
    };
    let corners = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
    std::array::from_fn(|i| {
        let sum: u32 = corners.iter().map(|start| u32::from(rgba[start + i])).sum();
        ((sum + 2) / 4) as u8
    })
}

/// Where the texture of a part starts in the store, or [`NONE`].
pub(crate) fn base_color_texture(scene: &Scene, part: &Part, textures: &mut Textures) -> u32 {
    let material = part.material.and_then(|m| scene.materials.get(m as usize));
    let texture = material.and_then(|material| material.base_color_texture.as_ref());
    texture
        .filter(|_| part.uvs.is_some())
        .and_then(|texture| textures.start_of(scene, texture))
        .unwrap_or(NONE)
}
