//! What is in a scene, as data that can be told in words or as JSON.

use crate::message::{name, plain};
use crate::source::Loaded;
use npr_scene::{AlphaMode, Format, LightKind, Projection, Scene};
use serde::Serialize;
use std::fmt::Write;

/// Most entries of one kind that the text lists; JSON has them all.
const LISTED: usize = 20;

/// What is in a scene, what of it is drawn and what is ignored.
#[derive(Debug, Clone, Serialize)]
pub struct Inventory {
    /// The file as the user named it.
    file: String,
    format: &'static str,
    bytes: u64,
    name: String,
    generator: Option<String>,
    node_count: usize,
    mesh_count: usize,
    /// As stored: an instanced mesh counts once.
    triangle_count: usize,
    vertex_count: usize,
    /// Counted for every instance.
    drawn_triangle_count: usize,
    /// In the world, in the pose of the file; none where nothing is drawn.
    bounds: Option<Bounds>,
    drawn: Vec<Drawn>,
    materials: Vec<Material>,
    images: Vec<Image>,
    cameras: Vec<Named>,
    lights: Vec<Named>,
    skins: Vec<Skin>,
    extensions: Vec<String>,
    /// What was ignored or mended, and why.
    ignored: Vec<String>,
}

#[derive(Debug, Clone, Serialize)]
struct Bounds {
    min: [f32; 3],
    max: [f32; 3],
}

/// One surface in one material.
#[derive(Debug, Clone, Serialize)]
struct Drawn {
    object: String,
    material: Option<String>,
    triangle_count: usize,
}

#[derive(Debug, Clone, Serialize)]
struct Material {
    name: String,
    /// Linear light, straight alpha.
    base_color: [f32; 4],
    /// Number of its image.
    image: Option<u32>,
    alpha: &'static str,
    double_sided: bool,
    unlit: bool,
}

#[derive(Debug, Clone, Serialize)]
struct Image {
    name: String,
    width: u32,
    height: u32,
}

#[derive(Debug, Clone, Serialize)]
struct Named {
    name: String,
    kind: &'static str,
}

#[derive(Debug, Clone, Serialize)]
struct Skin {
    name: String,
    joint_count: usize,
}

impl Inventory {
    /// The inventory of a scene from the file that the user named `file`.
    pub fn new(file: &str, loaded: Loaded) -> Self {
        let scene = loaded.scene;
        Self {
            file: file.to_owned(),
            format: format_name(loaded.format, &scene),
            bytes: scene.file_bytes,
            node_count: scene.nodes.len(),
            mesh_count: scene.meshes.len(),
            triangle_count: scene.triangle_count(),
            vertex_count: scene.vertex_count(),
            drawn_triangle_count: scene
                .drawn_parts()
                .map(|(_, part)| part.triangles.len())
                .sum(),
            bounds: scene.bounds_world().map(|(min, max)| Bounds { min, max }),
            drawn: drawn(&scene),
            materials: scene.materials.iter().map(material).collect(),
            images: scene.images.iter().map(image).collect(),
            cameras: cameras(&scene),
            lights: lights(&scene),
            skins: scene.skins.iter().map(skin).collect(),
            ignored: scene.notices.iter().map(ToString::to_string).collect(),
            name: scene.name,
            generator: scene.generator,
            extensions: scene.extensions_used,
        }
    }

    /// The inventory as lines for people; names are escaped where they could upset a terminal.
    pub fn text(&self) -> String {
        let mut text = format!(
            "{}: {}, {} bytes\n",
            plain(&self.file),
            self.format,
            self.bytes
        );
        let generator = self
            .generator
            .as_ref()
            .map(|generator| vec![name(generator)]);
        list(&mut text, "generator", generator.unwrap_or_default());
        let _ = writeln!(
            text,
            "contains {} nodes, {} meshes, {} triangles, {} vertices",
            self.node_count, self.mesh_count, self.triangle_count, self.vertex_count
        );
        if let Some(Bounds { min, max }) = &self.bounds {
            let decimals = decimals_for(*min, *max);
            let _ = writeln!(
                text,
                "bounds {} to {}",
                point(*min, decimals),
                point(*max, decimals)
            );
        }
        let _ = writeln!(text, "draws {} triangles", self.drawn_triangle_count);
        list(&mut text, "surface", self.drawn.iter().map(Drawn::text));
        list(
            &mut text,
            "material",
            self.materials.iter().map(Material::text),
        );
        list(&mut text, "image", self.images.iter().map(Image::text));
        list(&mut text, "camera", self.cameras.iter().map(Named::text));
        list(&mut text, "light", self.lights.iter().map(Named::text));
        list(&mut text, "skin", self.skins.iter().map(Skin::text));
        list(
            &mut text,
            "extension",
            self.extensions.iter().map(|extension| name(extension)),
        );
        list(
            &mut text,
            "note:",
            self.ignored.iter().map(|notice| plain(notice)),
        );
        text
    }
}

/// A line per entry, the first few of them.
fn list(text: &mut String, what: &str, entries: impl IntoIterator<Item = String>) {
    let mut entries = entries.into_iter();
    for entry in entries.by_ref().take(LISTED) {
        let _ = writeln!(text, "  {what} {entry}");
    }
    let more = entries.count();
    if more > 0 {
        let _ = writeln!(text, "  {what} and {more} more");
    }
}

impl Drawn {
    fn text(&self) -> String {
        let material = self
            .material
            .as_deref()
            .map(|material| format!(" in '{}'", name(material)));
        let (object, material) = (name(&self.object), material.unwrap_or_default());
        format!("'{object}'{material}, {} triangles", self.triangle_count)
    }
}

impl Material {
    fn text(&self) -> String {
        let [r, g, b, a] = self.base_color;
        let mut text = format!("'{}' colour {r:.3},{g:.3},{b:.3},{a:.3}", name(&self.name));
        if let Some(image) = self.image {
            let _ = write!(text, ", image {image}");
        }
        let marks = [
            (self.alpha != "opaque", self.alpha),
            (self.double_sided, "double-sided"),
            (self.unlit, "unlit"),
        ];
        for (_, mark) in marks.iter().filter(|(holds, _)| *holds) {
            let _ = write!(text, ", {mark}");
        }
        text
    }
}

impl Image {
    fn text(&self) -> String {
        format!("'{}' {}x{}", name(&self.name), self.width, self.height)
    }
}

impl Named {
    fn text(&self) -> String {
        format!("'{}' {}", name(&self.name), self.kind)
    }
}

impl Skin {
    fn text(&self) -> String {
        format!("'{}' {} joints", name(&self.name), self.joint_count)
    }
}

fn point([x, y, z]: [f32; 3], decimals: usize) -> String {
    format!("{x:.decimals$},{y:.decimals$},{z:.decimals$}")
}

/// Decimal places that show a box to about five digits of its longest side.
fn decimals_for(min: [f32; 3], max: [f32; 3]) -> usize {
    let longest = (0..3).map(|axis| max[axis] - min[axis]).fold(0.0, f32::max);
    (0..12)
        .find(|places| longest * 10f32.powi(*places) >= 1e4)
        .unwrap_or(4) as usize
}

fn format_name(format: Option<Format>, scene: &Scene) -> &'static str {
    let uses = |extension: &str| scene.extensions_used.iter().any(|used| used == extension);
    match format {
        Some(Format::Glb | Format::Gltf) if uses("VRMC_vrm") => "VRM 1.0",
        Some(Format::Glb | Format::Gltf) if uses("VRM") => "VRM 0.x",
        Some(Format::Glb) => "binary glTF",
        Some(Format::Gltf) => "glTF",
        Some(Format::Obj) => "OBJ",
        Some(Format::Stl) => "STL",
        Some(Format::Ply) => "PLY",
        None => "unknown",
    }
}

fn drawn(scene: &Scene) -> Vec<Drawn> {
    let material = |index: u32| {
        scene
            .materials
            .get(index as usize)
            .map(|material| material.name.clone())
    };
    let surface = |(node, part): (&npr_scene::Node, &npr_scene::Part)| Drawn {
        object: node.name.clone(),
        material: part.material.and_then(material),
        triangle_count: part.triangles.len(),
    };
    scene.drawn_parts().map(surface).collect()
}

fn material(material: &npr_scene::Material) -> Material {
    Material {
        name: material.name.clone(),
        base_color: material.base_color,
        image: material
            .base_color_texture
            .as_ref()
            .map(|texture| texture.image),
        alpha: match material.alpha {
            AlphaMode::Opaque => "opaque",
            AlphaMode::Mask(_) => "mask",
            AlphaMode::Blend => "blend",
        },
        double_sided: material.double_sided,
        unlit: material.unlit,
    }
}

fn image(image: &npr_scene::Image) -> Image {
    Image {
        name: image.name.clone(),
        width: image.width,
        height: image.height,
    }
}

/// Cameras by the names that `--camera` takes: a node's own, or else the camera's.
fn cameras(scene: &Scene) -> Vec<Named> {
    let placed = scene
        .nodes
        .iter()
        .filter_map(|node| Some((node, scene.cameras.get(node.camera? as usize)?)));
    let named = placed.map(|(node, camera)| Named {
        name: if node.name.is_empty() {
            camera.name.clone()
        } else {
            node.name.clone()
        },
        kind: match camera.projection {
            Projection::Perspective { .. } => "perspective",
            Projection::Orthographic { .. } => "orthographic",
        },
    });
    named.collect()
}

fn lights(scene: &Scene) -> Vec<Named> {
    let named = scene.lights.iter().map(|light| Named {
        name: light.name.clone(),
        kind: match light.kind {
            LightKind::Directional => "directional",
            LightKind::Point => "point",
            LightKind::Spot { .. } => "spot",
        },
    });
    named.collect()
}

fn skin(skin: &npr_scene::Skin) -> Skin {
    Skin {
        name: skin.name.clone(),
        joint_count: skin.joints.len(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_is_shown_to_five_digits() {
        let shown = |side: f32| point([side; 3], decimals_for([0.0; 3], [side; 3]));
        assert_eq!(shown(1.234_567), "1.2346,1.2346,1.2346");
        assert_eq!(shown(12_345.6), "12346,12346,12346");
        assert_eq!(shown(0.0), "0.0000,0.0000,0.0000");
    }

    #[test]
    fn long_lists_are_cut() {
        let mut text = String::new();
        list(&mut text, "skin", (0..LISTED + 7).map(|i| i.to_string()));
        assert_eq!(text.lines().count(), LISTED + 1);
        assert!(text.ends_with("skin and 7 more\n"), "{text}");
    }
}
