//! The JSON text as typed data, checked for version and required extensions.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::Root;
use npr_core::decoding::guard;
use serde_json::Value;
use serde_json::error::Category;

use super::error::GltfError;
use crate::error::SceneError;
use crate::limits::{self, Limits};

/// The node of a channel that names none.
pub(crate) const NO_NODE: u32 = u32::MAX;

/// Extensions that a file may require; what they change is either read or harmless to ignore.
const SUPPORTED: [&str; 12] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "VRM",
    "VRMC_materials_mtoon",
    "VRMC_node_constraint",
    "VRMC_springBone",
    "VRMC_vrm",
    "VRMC_vrm_animation",
];

/// Whether the extension `name` is read, or harmless to ignore.
pub(crate) fn is_supported(name: &str) -> bool {
    SUPPORTED.contains(&name)
}

/// The document in `json`.
pub(crate) fn parse(json: &[u8], limits: &Limits) -> Result<Root, SceneError> {
    limits::check(
        "size of the JSON text in bytes",
        json.len() as u64,
        limits.json_bytes,
        "--max-json",
    )?;
    let objects = json.iter().filter(|&&byte| byte == b'{').count() as u64;
    limits::check(
        "number of JSON objects",
        objects,
        limits.json_objects,
        "--max-json-objects",
    )?;
    let root = parse_types(trim(json))?;
    check_version(&root)?;
    check_extensions(&root)?;
    Ok(root)
}

/// The document in `json`, which [`parse`] found broken, without its animations; none where that mends nothing.
pub(crate) fn parse_without_animations(json: &[u8]) -> Option<Root> {
    let parsed = guard(|| {
        let mut document: Value = serde_json::from_slice(trim(json)).ok()?;
        document.as_object_mut()?.remove("animations")?;
        serde_json::from_value(with_scene_nodes(document)).ok()
    });
    let root = parsed.ok().flatten()?;
    check_version(&root).ok()?;
    check_extensions(&root).ok()?;
    Some(root)
}

/// `json` without a byte order mark and without the padding of a chunk.
fn trim(json: &[u8]) -> &[u8] {
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    json.trim_ascii_end().strip_suffix(b"\0").unwrap_or(json)
}

fn parse_types(json: &[u8]) -> Result<Root, GltfError> {
    let parsed = guard(|| {
        serde_json::from_slice(json).or_else(|fault| {
            // An empty scene may leave out its list of nodes, and a channel its node, which the types insist on.
            let Ok(document) = serde_json::from_slice(json) else {
                return Err(json_fault(&fault));
            };
            if let Some(version) = first_version(&document) {
                return Err(GltfError::Version { version });
            }
            let document = with_target_nodes(with_scene_nodes(document));
            serde_json::from_value(document).map_err(|_| json_fault(&fault))
        })
    });
    parsed.unwrap_or(Err(GltfError::Unreadable))
}

/// The version of a document of glTF 1.x, whose lists are tables by name, so that the types never come to read it.
fn first_version(document: &Value) -> Option<String> {
    let stated = document.get("asset").and_then(|asset| asset.get("version"));
    let version = match stated {
        Some(Value::String(version)) => version.clone(),
        Some(Value::Number(version)) => version.to_string(),
        _ => "1.0".to_owned(),
    };
    let lists = ["nodes", "meshes", "accessors", "buffers"];
    let has_tables = lists
        .iter()
        .any(|list| document.get(list).is_some_and(Value::is_object));
    let is_old = matches!(version.split('.').next(), Some("0" | "1"));
    (is_old && (stated.is_some() || has_tables)).then_some(version)
}

fn with_scene_nodes(mut document: Value) -> Value {
    let scenes = document.get_mut("scenes").and_then(Value::as_array_mut);
    for scene in scenes
        .into_iter()
        .flatten()
        .filter_map(Value::as_object_mut)
    {
        scene
            .entry("nodes")
            .or_insert_with(|| Value::Array(Vec::new()));
    }
    document
}

/// Lets channels without a node move [`NO_NODE`].
fn with_target_nodes(mut document: Value) -> Value {
    let animations = document.get_mut("animations").and_then(Value::as_array_mut);
    let lists = animations
        .into_iter()
        .flatten()
        .filter_map(|animation| animation.get_mut("channels").and_then(Value::as_array_mut));
    let targets = lists
        .flatten()
        .filter_map(|channel| channel.get_mut("target").and_then(Value::as_object_mut));
    targets.for_each(|target| {
        target.entry("node").or_insert_with(|| Value::from(NO_NODE));
    });
    document
}

/// The fault in words of the file: the parser's own words name types of the program.
fn json_fault(fault: &serde_json::Error) -> GltfError {
    let fault_words = match fault.classify() {
        Category::Eof => "the text ends too early",
        Category::Data => "a value is missing or of the wrong kind",
        Category::Syntax if fault.to_string().starts_with("recursion") => {
            "nested more than 128 deep"
        }
        Category::Syntax | Category::Io => "this is not JSON",
    };
    GltfError::Json {
        line: fault.line(),
        column: fault.column(),
        fault: fault_words,
    }
}

fn check_version(root: &Root) -> Result<(), GltfError> {
    let is_2 = |version: &str| version.split('.').next() == Some("2");
    let needs_later = root
        .asset
        .min_version
        .as_ref()
        .is_some_and(|version| version != "2.0");
    if is_2(&root.asset.version) && !needs_later {
        return Ok(());
    }
    let version = root.asset.min_version.as_ref().filter(|_| needs_later);
    Err(GltfError::Version {
        version: version.unwrap_or(&root.asset.version).clone(),
    })
}

fn check_extensions(root: &Root) -> Result<(), GltfError> {
    let unknown = root
        .extensions_required
        .iter()
        .find(|name| !is_supported(name));
    match unknown {
        Some(extension) => Err(GltfError::RequiredExtension {
            extension: extension.clone(),
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault_of(json: &str) -> String {
        parse(json.as_bytes(), &Limits::default())
            .expect_err("a broken document")
            .to_string()
    }

    #[test]
    fn faults_name_line_and_column_but_no_types() {
        let kind = fault_of("{\"asset\":{\"version\":\"2.0\"},\n\"scene\":\"x\"}");
        assert_eq!(
            kind,
            "JSON, line 2, column 11: a value is missing or of the wrong kind"
        );
        assert_eq!(
            fault_of("{"),
            "JSON, line 1, column 1: the text ends too early"
        );
        assert_eq!(fault_of("{]"), "JSON, line 1, column 2: this is not JSON");
    }

    #[test]
    fn deep_nesting_is_refused_not_followed() {
        let deep = format!("{{\"asset\":{}", "[".repeat(100_000));
        assert!(fault_of(&deep).contains("JSON"), "{}", fault_of(&deep));
    }

    #[test]
    fn other_versions_and_unknown_required_extensions_are_refused() {
        assert!(fault_of("{\"asset\":{\"version\":\"1.0\"}}").contains("version '1.0'"));
        assert!(
            fault_of("{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.1\"}}").contains("'2.1'")
        );
        let draco = "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}";
        assert!(fault_of(draco).contains("'KHR_draco_mesh_compression' is required"));
    }

    #[test]
    fn an_empty_scene_may_leave_out_its_nodes() {
        let json = b"{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"name\":\"Scene\"}]}";
        let root = parse(json, &Limits::default()).expect("a valid document");
        assert!(
            root.scenes
                .first()
                .is_some_and(|scene| scene.nodes.is_empty())
        );
    }

    #[test]
    fn many_objects_are_a_limit() {
        let limits = Limits {
            json_objects: 3,
            ..Limits::default()
        };
        let fault = parse(
            b"{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{},{}]}",
            &limits,
        );
        assert!(fault.expect_err("four objects").is_limit());
    }
}
