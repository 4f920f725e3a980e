//! Where materials have holes.

use crate::instance::placed_uv;
use crate::spots::middles;
use crate::textures::packed_wrap;
use npr_core::texture::texel_at;
use npr_scene::{AlphaMode, Image, Material, Part, Scene};

/// The alpha under which what blends is a hole.
const HALF: f32 = 0.5;

/// More than any alpha: all of a part is a hole.
const ALL: f32 = 2.0;

/// About how many spots of a material's parts its texture is looked at in.
const SPOTS: usize = 4096;

/// Rows of small triangles that a triangle is looked at in, at most.
const ROWS_MAX: u32 = 32;

/// Alpha from which, and up to which, a spot is neither clear nor opaque.
const BETWEEN: [f32; 2] = [0.05, 0.95];

/// For every material the alpha under which a pixel of it is a hole; none where alpha is ignored.
///
/// A surface is drawn or it is not: nothing shows through half. So a texture that is clear here and opaque there, as
/// leaves on a card are, is cut out at one half. Glass, whose alpha lies between nearly everywhere, would be cut along
/// the grain of its texture: it is drawn as a whole, or, where less than half of it covers, not at all.
pub(crate) struct Cutoffs(Vec<Option<f32>>);

impl Cutoffs {
    /// Looks at up to about 4096 spots of every material that blends.
    pub fn of(scene: &Scene) -> Self {
        let cutoff = |(index, material): (u32, &Material)| match material.alpha {
            AlphaMode::Opaque => None,
            AlphaMode::Mask(cutoff) => Some(cutoff),
            AlphaMode::Blend => match covered_by_glass(scene, index, material) {
                Some(share) => (share < HALF).then_some(ALL),
                None => Some(HALF),
            },
        };
        Self((0..).zip(&scene.materials).map(cutoff).collect())
    }

    /// That of a material, or of none.
    pub fn at(&self, material: Option<u32>) -> Option<f32> {
        let index = material? as usize;
        *self.0.get(index)?
    }
}

/// How much of what lies behind a material it covers on average, where it is glass: where at most half of what is not
/// clear of it is opaque.
fn covered_by_glass(scene: &Scene, index: u32, material: &Material) -> Option<f32> {
    let texture = material.base_color_texture.as_ref()?;
    let image = scene.images.get(texture.image as usize)?;
    let wrap = texture.wrap.map(packed_wrap);
    let parts = scene.meshes.iter().flat_map(|mesh| &mesh.parts);
    let parts: Vec<&Part> = parts.filter(|part| part.material == Some(index)).collect();

    // Look at as many spots of each triangle as there may be in all, in few triangles where there are many.
    let triangles = parts.iter().map(|part| part.triangles.len()).sum::<usize>();
    let rows = (SPOTS / triangles.max(1)).isqrt() as u32;
    let step = triangles.div_ceil(SPOTS).max(1);
    let corners = parts.iter().flat_map(|part| uvs_of(part)).step_by(step);
    let (mut sum, mut all, mut clear, mut between) = (0.0, 0, 0, 0);
    for uvs in corners {
        let placed = uvs.map(|uv| placed_uv(uv, Some(material)));
        for uv in middles(placed, rows.clamp(1, ROWS_MAX)) {
            let alpha = alpha_at(image, texel_at(uv, [image.width, image.height], wrap));
            sum += alpha;
            all += 1;
            clear += u32::from(alpha < BETWEEN[0]);
            between += u32::from((BETWEEN[0]..BETWEEN[1]).contains(&alpha));
        }
    }
    let is_glass = 2 * between > all - clear;
    is_glass.then(|| material.base_color[3] * sum / all as f32)
}

/// The texture coordinates of every triangle's corners.
fn uvs_of(part: &Part) -> impl Iterator<Item = [[f32; 2]; 3]> {
    let uvs = part.uvs.as_deref().unwrap_or_default();
    let at = |corner: u32| uvs.get(corner as usize).copied().unwrap_or_default();
    let triangles = part.triangles.iter().filter(|_| !uvs.is_empty());
    triangles.map(move |corners| corners.map(at))
}

fn alpha_at(image: &Image, [x, y]: [u32; 2]) -> f32 {
    let at = (y as usize * image.width as usize + x as usize) * 4 + 3;
    image
        .rgba
        .get(at)
        .map_or(1.0, |alpha| f32::from(*alpha) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_mesh::testing::Random;
    use npr_scene::{Mesh, TextureTransform, TextureUse, Wrap};

    /// Pixels along a side of the texture.
    const SIDE: u32 = 64;

    /// Two triangles that show the left half of a texture, in a material of base alpha `alpha` that blends.
    fn pane(alpha: f32, alpha_of: impl FnMut(u32, u32) -> u8) -> Scene {
        let mut alpha_of = alpha_of;
        let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
        let image = Image {
            name: String::new(),
            width: SIDE,
            height: SIDE,
            rgba: places
                .flat_map(|(x, y)| [200, 200, 200, alpha_of(x, y)])
                .collect(),
        };
        let material = Material {
            base_color: [1.0, 1.0, 1.0, alpha],
            base_color_texture: Some(TextureUse {
                image: 0,
                uv_set: 0,
                wrap: [Wrap::Clamp; 2],
                transform: TextureTransform::default(),
            }),
            alpha: AlphaMode::Blend,
            ..Material::default()
        };
        let part = Part {
            positions: vec![[0.0; 3]; 4],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            uvs: Some(vec![[0.0, 0.0], [0.5, 0.0], [0.5, 1.0], [0.0, 1.0]]),
            material: Some(0),
            ..Part::default()
        };
        Scene {
            meshes: vec![Mesh {
                parts: vec![part],
                ..Mesh::default()
            }],
            materials: vec![material],
            images: vec![image],
            ..Scene::default()
        }
    }

    fn cutoff(scene: &Scene) -> Option<f32> {
        Cutoffs::of(scene).at(Some(0))
    }

    #[test]
    fn leaves_on_a_card_are_cut_out_and_glass_is_there_or_not() {
        let mut random = Random::new(3);
        let leaf = |x: u32, y: u32| {
            if (x / 5 + y / 7).is_multiple_of(3) {
                255
            } else {
                0
            }
        };
        assert_eq!(cutoff(&pane(1.0, leaf)), Some(0.5));
        let mut grain = |least: usize, most: usize| least + random.below(most - least);
        let thin: Vec<u8> = (0..SIDE * SIDE).map(|_| grain(30, 180) as u8).collect();
        let thick: Vec<u8> = (0..SIDE * SIDE).map(|_| grain(100, 230) as u8).collect();
        let at = |x: u32, y: u32| (y * SIDE + x) as usize;
        assert_eq!(cutoff(&pane(1.0, |x, y| thin[at(x, y)])), Some(ALL));
        assert_eq!(cutoff(&pane(1.0, |x, y| thick[at(x, y)])), None);
        assert_eq!(cutoff(&pane(0.5, |x, y| thick[at(x, y)])), Some(ALL));
    }

    #[test]
    fn what_other_parts_show_of_a_texture_does_not_count() {
        // The right half, which the part does not show, is glass.
        let half = |x: u32, y: u32| match (x < SIDE / 2, y % 8 < 4) {
            (true, true) => 255,
            (true, false) => 0,
            (false, _) => 90,
        };
        assert_eq!(cutoff(&pane(1.0, half)), Some(0.5));
    }

    #[test]
    fn soft_edges_of_leaves_make_no_glass_of_them() {
        let disc = |x: u32, y: u32| {
            let (x, y) = (x as f32 - 16.0, y as f32 - 32.0);
            ((14.0 - (x * x + y * y).sqrt()) * 60.0).clamp(0.0, 255.0) as u8
        };
        assert_eq!(cutoff(&pane(1.0, disc)), Some(0.5));
    }

    #[test]
    fn without_coordinates_or_an_image_the_rule_of_leaves_holds() {
        let mut bare = pane(1.0, |_, _| 90);
        bare.meshes[0].parts[0].uvs = None;
        assert_eq!(cutoff(&bare), Some(0.5));
        let mut lost = pane(1.0, |_, _| 90);
        lost.images.clear();
        assert_eq!(cutoff(&lost), Some(0.5));
        lost.materials[0].alpha = AlphaMode::Opaque;
        assert_eq!(cutoff(&lost), None);
        assert_eq!(Cutoffs::of(&lost).at(None), None);
        assert_eq!(Cutoffs::of(&lost).at(Some(7)), None);
    }

    #[test]
    fn many_triangles_are_looked_at_in_few_spots() {
        let mut dense = pane(1.0, |_, _| 90);
        let part = &mut dense.meshes[0].parts[0];
        part.triangles = part.triangles.repeat(20_000);
        assert_eq!(cutoff(&dense), Some(ALL));
    }
}
