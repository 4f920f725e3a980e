//! What a model knows of each of its surfaces, before a style is applied.

use crate::cutoffs::Cutoffs;
use crate::part_toon::PartToon;
use npr_core::geometry::NONE;
use npr_scene::{Material, Scene};
use npr_stylesheet::{Look, PartNames, Style};

/// One connected surface of one object in one material and of one id, before a style is applied.
#[derive(Debug, Clone, PartialEq)]
pub struct PartInfo {
    /// Name of the node it hangs on.
    pub object_name: String,
    /// Name of its material; empty where it has none.
    pub material_name: String,
    /// Number of the object, the same for all its parts.
    pub object: u32,
    /// Number of the node at the top of the file's tree that the object hangs on; its own where it hangs on none.
    pub root: u32,
    /// Number of the material.
    pub material: u32,
    /// What styles may call its region of an id map; empty where it belongs to none.
    pub ids: Vec<String>,
    /// Number of its connected surface within the object, whatever materials and ids that has; 0 in line models,
    /// which need none.
    pub component: u32,
    /// Base colour factor, linear light, straight alpha.
    pub base_color: [f32; 4],
    /// Where its texture's header starts in the store, or [`NONE`].
    pub texture: u32,
    /// Alpha under which a pixel is a hole; `None` where alpha is ignored.
    pub alpha_cutoff: Option<f32>,
    /// Both sides are drawn.
    pub double_sided: bool,
    /// The file asks for its colour without light.
    pub unlit: bool,
    /// Its vertices have UV coordinates.
    pub has_uvs: bool,
    /// 0 a dielectric, 1 a metal.
    pub metallic: f32,
    /// 0 polished, 1 dull.
    pub roughness: f32,
    /// How the file asks for it to be drawn as a toon; `None` where it does not, and in line models.
    pub(crate) toon: Option<Box<PartToon>>,
}

impl PartInfo {
    /// An object in one of the scene's materials, without a texture.
    pub(crate) fn new(
        scene: &Scene,
        object: u32,
        object_name: &str,
        material: Option<u32>,
        cutoffs: &Cutoffs,
    ) -> Self {
        let plain = Material::default();
        let found = material
            .and_then(|index| scene.materials.get(index as usize))
            .unwrap_or(&plain);
        Self {
            object_name: object_name.to_owned(),
            material_name: found.name.clone(),
            object,
            root: Self::root_of(scene, object),
            material: material.unwrap_or(NONE - 1),
            ids: Vec::new(),
            component: 0,
            base_color: found.base_color,
            texture: NONE,
            alpha_cutoff: cutoffs.at(material),
            double_sided: found.double_sided,
            unlit: found.unlit,
            has_uvs: false,
            metallic: found.metallic,
            roughness: found.roughness,
            toon: None,
        }
    }

    /// How a style draws it.
    pub(crate) fn look<'a>(&self, style: &'a Style) -> Look<'a> {
        style.resolve(self.names())
    }

    /// The names that rules match.
    pub(crate) fn names(&self) -> PartNames<'_> {
        PartNames {
            material: &self.material_name,
            object: &self.object_name,
            ids: &self.ids,
        }
    }

    /// Whether a style makes it a beam of light.
    pub(crate) fn is_beam(&self, style: &Style) -> bool {
        self.look(style).beam.is_some()
    }

    /// Whether the base colour alone is so transparent that nothing of the part is drawn.
    pub(crate) fn is_invisible(&self) -> bool {
        self.alpha_cutoff
            .is_some_and(|cutoff| self.base_color[3] < cutoff)
    }

    /// The node without a parent that node `object` hangs on.
    pub(crate) fn root_of(scene: &Scene, object: u32) -> u32 {
        let mut root = object;
        while let Some(parent) = scene.nodes.get(root as usize).and_then(|node| node.parent) {
            // A parent stands before its children, so this ends.
            if parent >= root {
                break;
            }
            root = parent;
        }
        root
    }
}
