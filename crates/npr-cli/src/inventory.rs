//! The contents of a scene, as data that can be printed in words or as JSON.

mod toon;
mod volume;
mod words;

pub use volume::VolumeInventory;

use crate::source::Loaded;
use npr_scene::{AlphaMode, Format, LightKind, Override, Projection, Scene};
use serde::Serialize;
use toon::Toon;

/// The contents of a scene: what it holds, what is drawn and what is ignored.
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
    /// Triangles as stored: an instanced mesh counts once.
    triangle_count: usize,
    /// Segments of polylines, also as stored.
    line_segment_count: usize,
    vertex_count: usize,
    /// Triangles of all instances.
    drawn_triangle_count: usize,
    drawn_line_segment_count: usize,
    /// Bounding box in world space, at rest; `None` where nothing is drawn.
    bounds: Option<Bounds>,
    drawn: Vec<Drawn>,
    materials: Vec<Material>,
    images: Vec<Image>,
    cameras: Vec<Named>,
    lights: Vec<Named>,
    skins: Vec<Skin>,
    clips: Vec<Clip>,
    /// Bones of a VRM, or of a motion for VRMs, in the order of VRM.
    bones: Vec<Bone>,
    /// Expressions of a VRM.
    expressions: Vec<Expression>,
    /// Names of the expressions that a motion for VRMs moves.
    moved_expressions: Vec<String>,
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
    line_segment_count: usize,
}

#[derive(Debug, Clone, Serialize)]
struct Material {
    name: String,
    /// Linear light, straight alpha.
    base_color: [f32; 4],
    /// Index of its image.
    image: Option<u32>,
    alpha: &'static str,
    double_sided: bool,
    unlit: bool,
    /// How the file asks for it to be drawn as a toon; `null` where it does not.
    toon: Option<Toon>,
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

/// A clip, under the name that `--clip` takes; its place in the list is its number.
#[derive(Debug, Clone, Serialize)]
struct Clip {
    name: String,
    duration_s: f32,
    channel_count: usize,
}

/// A bone under the name that `--pose` takes.
#[derive(Debug, Clone, Serialize)]
struct Bone {
    name: &'static str,
    /// Name of its node.
    node: String,
}

/// An expression under the name that `--expression` takes.
#[derive(Debug, Clone, Serialize)]
struct Expression {
    name: String,
    /// What the file calls it.
    file_name: String,
    binary: bool,
    morphs: Vec<MorphBind>,
    /// Materials whose base colours it changes.
    colors: Vec<String>,
    /// Materials whose textures it shifts.
    textures: Vec<String>,
    overrides: Overrides,
}

/// What an expression does to others of a kind: `none`, `block` or `blend`.
#[derive(Debug, Clone, Serialize)]
struct Overrides {
    blinks: &'static str,
    looks: &'static str,
    mouths: &'static str,
}

/// A morph that an expression moves.
#[derive(Debug, Clone, Serialize)]
struct MorphBind {
    /// Name of the node that draws it.
    node: String,
    morph: u32,
    weight: f32,
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
            line_segment_count: scene.segment_count(),
            vertex_count: scene.vertex_count(),
            drawn_triangle_count: scene
                .drawn_parts()
                .map(|(_, part)| part.triangles.len())
                .sum(),
            drawn_line_segment_count: scene
                .drawn_parts()
                .map(|(_, part)| part.segments.len())
                .sum(),
            bounds: scene.bounds_world().map(|(min, max)| Bounds { min, max }),
            drawn: drawn(&scene),
            materials: scene.materials.iter().map(material).collect(),
            images: scene.images.iter().map(image).collect(),
            cameras: cameras(&scene),
            lights: lights(&scene),
            skins: scene.skins.iter().map(skin).collect(),
            clips: scene.clips.iter().map(clip).collect(),
            bones: bones(&scene),
            expressions: expressions(&scene),
            moved_expressions: moved_expressions(&scene),
            ignored: ignored(&scene),
            name: scene.name,
            generator: scene.generator,
            extensions: scene.extensions_used,
        }
    }
}

fn format_name(format: Option<Format>, scene: &Scene) -> &'static str {
    let uses = |extension: &str| scene.extensions_used.iter().any(|used| used == extension);
    match format {
        Some(Format::Glb | Format::Gltf) if uses("VRMC_vrm") => "VRM 1.0",
        Some(Format::Glb | Format::Gltf) if uses("VRM") => "VRM 0.x",
        Some(Format::Glb | Format::Gltf) if uses("VRMC_vrm_animation") => "VRM animation",
        Some(Format::Glb) => "binary glTF",
        Some(Format::Gltf) => "glTF",
        Some(Format::Obj) => "OBJ",
        Some(Format::Stl) => "STL",
        Some(Format::Ply) => "PLY",
        None => "unknown",
    }
}

/// Notices about what loading ignored, and about what drawing will ignore.
fn ignored(scene: &Scene) -> Vec<String> {
    let mut notices: Vec<String> = scene.notices.iter().map(ToString::to_string).collect();
    if !scene.lights.is_empty() {
        notices
            .push("lights of the file shine only in styles that say light.file = true".to_owned());
    }
    notices
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
        line_segment_count: part.segments.len(),
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
        toon: material.toon.as_deref().map(Toon::of),
    }
}

fn image(image: &npr_scene::Image) -> Image {
    Image {
        name: image.name.clone(),
        width: image.width,
        height: image.height,
    }
}

/// Cameras under the names that `--camera` takes: the name of the node, or of the camera where the node has none.
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

fn clip(clip: &npr_scene::Clip) -> Clip {
    Clip {
        name: clip.name.clone(),
        duration_s: clip.duration_s(),
        channel_count: clip.channels.len(),
    }
}

fn node_name(scene: &Scene, node: u32) -> String {
    let node = scene.nodes.get(node as usize);
    node.map(|node| node.name.clone()).unwrap_or_default()
}

fn bones(scene: &Scene) -> Vec<Bone> {
    let bones = scene.figure.iter().flat_map(|figure| &figure.bones);
    let bone = |(bone, node): (&npr_scene::Bone, &u32)| Bone {
        name: bone.name(),
        node: node_name(scene, *node),
    };
    bones.map(bone).collect()
}

fn moved_expressions(scene: &Scene) -> Vec<String> {
    let figure = scene.figure.iter();
    let shares = figure.flat_map(|figure| &figure.share_nodes);
    shares.map(|(name, _)| name.clone()).collect()
}

fn expressions(scene: &Scene) -> Vec<Expression> {
    let overriding = |does| match does {
        Override::None => "none",
        Override::Block => "block",
        Override::Blend => "blend",
    };
    let material = |index: u32| {
        let material = scene.materials.get(index as usize);
        material
            .map(|material| material.name.clone())
            .unwrap_or_default()
    };
    let faces = scene.figure.iter().flat_map(|figure| &figure.expressions);
    let expression = |face: &npr_scene::Expression| Expression {
        name: face.name.clone(),
        file_name: face.file_name.clone(),
        binary: face.is_binary,
        morphs: face
            .morphs
            .iter()
            .map(|bind| MorphBind {
                node: node_name(scene, bind.node),
                morph: bind.morph,
                weight: bind.weight,
            })
            .collect(),
        colors: face
            .colors
            .iter()
            .map(|bind| material(bind.material))
            .collect(),
        textures: face
            .textures
            .iter()
            .map(|bind| material(bind.material))
            .collect(),
        overrides: Overrides {
            blinks: overriding(face.of_blinks),
            looks: overriding(face.of_looks),
            mouths: overriding(face.of_mouths),
        },
    };
    faces.map(expression).collect()
}
