//! Scenes as binary glTF 2.0 with one buffer.

use anyhow::Result;
use glam::{Mat3, Quat, Vec2, Vec3};
use serde_json::{Map, Value, json};

use super::scene::{Material, Object, Scene, looking_along};
use super::smooth::{SmoothMesh, smoothed};

/// Metres per centimetre: files are in metres, models here in centimetres.
const METRES: f32 = 0.01;

/// glTF's code for 32-bit floats.
const FLOAT: u32 = 5126;
/// glTF's code for 16-bit unsigned integers.
const UNSIGNED_SHORT: u32 = 5123;
/// glTF's code for 32-bit unsigned integers.
const UNSIGNED_INT: u32 = 5125;
/// glTF's code for a buffer view of vertex attributes.
const ARRAY_BUFFER: u32 = 34962;
/// glTF's code for a buffer view of indices.
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The bytes of a `.glb` file with `scene` in it.
///
/// Nodes come in the order of the objects, then "Camera" and "Sun". Equal scenes give equal bytes.
pub fn glb(scene: &Scene) -> Result<Vec<u8>> {
    let mut body = Body::default();
    let meshes: Vec<Value> = scene
        .objects
        .iter()
        .map(|object| mesh(&mut body, object))
        .collect();
    let document = document(scene, &body, meshes);
    Ok(container(serde_json::to_vec(&document)?, body.bytes))
}

/// The binary chunk while it grows, and what the JSON says about it.
#[derive(Default)]
struct Body {
    /// The chunk.
    bytes: Vec<u8>,
    /// Ranges of the chunk.
    views: Vec<Value>,
    /// Typed arrays.
    accessors: Vec<Value>,
}

impl Body {
    /// Appends bytes as a view of their own, padded to four, and returns its index.
    fn view(&mut self, bytes: impl Iterator<Item = u8>, target: u32) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let length = self.bytes.len() - start;
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(json!({
            "buffer": 0, "byteOffset": start, "byteLength": length, "target": target,
        }));
        self.views.len() - 1
    }

    /// Adds an accessor and returns its index.
    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Appends places with their bounds, which glTF demands.
    fn positions(&mut self, positions: &[Vec3]) -> usize {
        let low = positions.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = positions
            .iter()
            .copied()
            .fold(Vec3::NEG_INFINITY, Vec3::max);
        let view = self.view(
            positions.iter().flat_map(|p| float_bytes(p.to_array())),
            ARRAY_BUFFER,
        );
        self.accessor(json!({
            "bufferView": view, "componentType": FLOAT, "count": positions.len(), "type": "VEC3",
            "min": numbers(low.to_array()), "max": numbers(high.to_array()),
        }))
    }

    /// Appends unit normals.
    fn normals(&mut self, normals: &[Vec3]) -> usize {
        let view = self.view(
            normals.iter().flat_map(|n| float_bytes(n.to_array())),
            ARRAY_BUFFER,
        );
        self.accessor(json!({
            "bufferView": view, "componentType": FLOAT, "count": normals.len(), "type": "VEC3",
        }))
    }

    /// Appends texture coordinates.
    fn uvs(&mut self, uvs: &[Vec2]) -> usize {
        let view = self.view(
            uvs.iter().flat_map(|uv| float_bytes(uv.to_array())),
            ARRAY_BUFFER,
        );
        self.accessor(json!({
            "bufferView": view, "componentType": FLOAT, "count": uvs.len(), "type": "VEC2",
        }))
    }

    /// Appends triangles, as 16-bit indices where `vertex_count` allows.
    fn indices(&mut self, faces: &[[u32; 3]], vertex_count: usize) -> usize {
        let short = vertex_count < usize::from(u16::MAX);
        let width = if short { 2 } else { 4 };
        let flat = faces.as_flattened().iter();
        let bytes = flat.flat_map(|index| index.to_le_bytes().into_iter().take(width));
        let view = self.view(bytes, ELEMENT_ARRAY_BUFFER);
        self.accessor(json!({
            "bufferView": view, "count": faces.len() * 3, "type": "SCALAR",
            "componentType": if short { UNSIGNED_SHORT } else { UNSIGNED_INT },
        }))
    }
}

/// Appends an object's triangles and returns its glTF mesh: a primitive for each paint.
fn mesh(body: &mut Body, object: &Object) -> Value {
    let SmoothMesh {
        positions,
        normals,
        uvs,
        faces,
    } = smoothed(&object.shape);

    // Store what all primitives share.
    let metres: Vec<Vec3> = positions.iter().map(|&p| p * METRES).collect();
    let attributes = json!({
        "POSITION": body.positions(&metres),
        "NORMAL": body.normals(&normals.iter().map(|n| n.normalize()).collect::<Vec<_>>()),
        "TEXCOORD_0": body.uvs(&uvs),
    });

    // Store the triangles of every paint.
    let primitives: Vec<Value> = faces
        .iter()
        .map(|(paint, triangles)| {
            let indices = body.indices(triangles, metres.len());
            json!({ "attributes": attributes, "indices": indices, "material": paint.0 })
        })
        .collect();
    json!({ "name": object.name, "primitives": primitives })
}

/// The JSON chunk.
fn document(scene: &Scene, body: &Body, meshes: Vec<Value>) -> Value {
    let nodes = nodes(scene);
    let roots: Vec<usize> = (0..nodes.len()).collect();
    json!({
        "asset": { "version": "2.0", "generator": "xtask assets", "copyright": "CC0-1.0" },
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [sun()] } },
        "scene": 0,
        "scenes": [{ "nodes": roots }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials(scene),
        "cameras": [camera(scene)],
        "accessors": body.accessors,
        "bufferViews": body.views,
        "buffers": [{ "byteLength": body.bytes.len() }],
    })
}

/// The nodes: objects, camera, light.
fn nodes(scene: &Scene) -> Vec<Value> {
    let mut nodes: Vec<Value> = scene
        .objects
        .iter()
        .enumerate()
        .map(|(mesh, object)| node(object.name, "mesh", json!(mesh), object.turn, object.place))
        .collect();
    let view = scene.view;
    let turn = looking_along(view.target - view.eye);
    nodes.push(node("Camera", "camera", json!(0), turn, view.eye));
    let light = json!({ "KHR_lights_punctual": { "light": 0 } });
    nodes.push(node(
        "Sun",
        "extensions",
        light,
        looking_along(scene.sunlight),
        Vec3::ZERO,
    ));
    nodes
}

/// A node that holds one thing under `key`; a turn or place of nothing is left out.
fn node(name: &str, key: &str, holds: Value, turn: Mat3, place: Vec3) -> Value {
    let mut node = Map::new();
    node.insert("name".into(), json!(name));
    node.insert(key.into(), holds);
    if turn != Mat3::IDENTITY {
        node.insert(
            "rotation".into(),
            numbers(Quat::from_mat3(&turn).to_array()),
        );
    }
    if place != Vec3::ZERO {
        node.insert("translation".into(), numbers((place * METRES).to_array()));
    }
    Value::Object(node)
}

/// The directional light of every sample.
fn sun() -> Value {
    json!({ "type": "directional", "name": "Sun", "intensity": 3.0 })
}

/// The scene's camera; it sees from five centimetres to fifty metres.
fn camera(scene: &Scene) -> Value {
    let [aspect, fov] = [scene.view.aspect, scene.view.fov].map(number);
    json!({
        "type": "perspective", "name": "Camera",
        "perspective": { "aspectRatio": aspect, "yfov": fov, "znear": 0.05, "zfar": 50.0 },
    })
}

/// The materials: rough, without metal.
fn materials(scene: &Scene) -> Vec<Value> {
    let material = |material: &Material| {
        let [r, g, b] = material.color;
        let mut written = json!({
            "name": material.name,
            "pbrMetallicRoughness": {
                "baseColorFactor": numbers([r, g, b, 1.0]),
                "metallicFactor": 0.0, "roughnessFactor": 0.9,
            },
        });
        if material.double_sided {
            written["doubleSided"] = json!(true);
        }
        written
    };
    scene.materials.iter().map(material).collect()
}

/// Header, JSON chunk padded with spaces, binary chunk padded with zeros.
fn container(mut json: Vec<u8>, binary: Vec<u8>) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + json.len() + 8 + binary.len();
    let mut file = Vec::with_capacity(total);
    file.extend(b"glTF");
    file.extend(2u32.to_le_bytes());
    file.extend((total as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

/// The bytes of floats; negative zero is written as zero.
fn float_bytes<const N: usize>(values: [f32; N]) -> impl Iterator<Item = u8> {
    values.into_iter().flat_map(|v| (v + 0.0).to_le_bytes())
}

/// Floats as the shortest decimals that read back the same.
fn numbers<const N: usize>(values: [f32; N]) -> Value {
    Value::Array(values.into_iter().map(number).collect())
}

/// A float as the shortest decimal that reads back the same.
fn number(value: f32) -> Value {
    json!((value + 0.0).to_string().parse::<f64>().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::super::prism::cuboid;
    use super::super::scene::View;
    use super::*;

    /// A scene with one cube of one metre.
    fn cube() -> Scene {
        let view = View {
            eye: Vec3::Z,
            target: Vec3::ZERO,
            fov: 0.7,
            aspect: 1.5,
        };
        let mut scene = Scene::new(view, Vec3::NEG_Y);
        let paint = scene.material("Paint", 0xff8000);
        scene.stand(
            "Cube",
            cuboid(100.0, 100.0, 100.0, paint),
            [0.0, 50.0, 0.0],
            0.0,
        );
        scene
    }

    /// The JSON chunk of a file and the length of its binary chunk.
    fn chunks(file: &[u8]) -> (Value, usize) {
        let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(&file[..4], b"glTF");
        assert_eq!(word(8), file.len());
        let json_end = 20 + word(12);
        assert_eq!(json_end + 8 + word(json_end), file.len());
        (
            serde_json::from_slice(&file[20..json_end]).unwrap(),
            word(json_end),
        )
    }

    #[test]
    fn a_cube_is_written_in_metres() {
        let (json, _) = chunks(&glb(&cube()).unwrap());
        let [position, indices] = [&json["accessors"][0], &json["accessors"][3]];
        assert_eq!(position["count"], 24);
        assert_eq!(position["max"], json!([0.5, 1.0, 0.5]));
        assert_eq!(indices["count"], 36);
        assert_eq!(json["nodes"][0]["translation"], json!([0.0, 0.5, 0.0]));
    }

    #[test]
    fn views_fill_the_binary_chunk() {
        let (json, length) = chunks(&glb(&cube()).unwrap());
        let views = json["bufferViews"].as_array().unwrap();
        let total: u64 = views
            .iter()
            .map(|view| view["byteLength"].as_u64().unwrap())
            .sum();
        assert_eq!(total as usize, length);
        assert_eq!(json["buffers"][0]["byteLength"], length);
    }

    #[test]
    fn decimals_are_short() {
        assert_eq!(numbers([0.1, -0.0, 1.0]).to_string(), "[0.1,0.0,1.0]");
    }
}
