//! What VRM 0.x, VRM 1.0 and VRM animations say of bones and expressions; what is broken is left out with a notice.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::collections::{BTreeMap, BTreeSet};

use ::gltf::json::{Index, Root};
use serde_json::Value;

use super::look_at;
use super::tree::Tree;
use super::vrm::extension;
use crate::bone::Bone;
use crate::error::SceneError;
use crate::expression::{ColorBind, Expression, MorphBind, Override, PRESETS, TextureBind};
use crate::figure::Figure;
use crate::loading::Loading;
use crate::node::Node;
use crate::posture::numbers;
use crate::shown::shown;

/// Weight of a bind of VRM 0.x that moves its morph whole.
const WHOLE_IN_0: f32 = 100.0;

/// Reads the figure of a file; none where it is no VRM.
///
/// # Errors
///
/// More bones and binds than the memory limit. Whatever is broken has a notice.
pub(crate) fn read(
    root: &Root,
    tree: &Tree,
    nodes: &[Node],
    loading: &mut Loading,
) -> Result<Option<Figure>, SceneError> {
    let mut reader = Reader {
        root,
        tree,
        nodes,
        figure: Figure::default(),
        owners: BTreeMap::new(),
        loading,
    };
    if let Some(vrm) = extension(root, "VRMC_vrm") {
        reader.bones_of_1(vrm, "VRM 1.0");
        reader.note_missing_bones(vrm);
        reader.expressions_of_1(vrm)?;
        reader.figure.look_at = look_at::of_1(vrm, reader.loading)?;
    } else if let Some(vrm) = extension(root, "VRM") {
        reader.bones_of_0(vrm);
        reader.expressions_of_0(vrm)?;
        reader.figure.look_at = look_at::of_0(vrm, reader.loading)?;
    } else if let Some(motion) = extension(root, "VRMC_vrm_animation") {
        reader.bones_of_1(motion, "a VRM animation");
        reader.shares(motion)?;
        reader.figure.has_looks = motion.pointer("/lookAt/node").is_some();
    } else {
        return Ok(None);
    }
    Ok(Some(reader.figure))
}

struct Reader<'a, 'b> {
    root: &'a Root,
    tree: &'a Tree,
    nodes: &'a [Node],
    figure: Figure,
    /// The bone that each node is, by the node's number in the file.
    owners: BTreeMap<u64, Bone>,
    loading: &'a mut Loading<'b>,
}

impl Reader<'_, '_> {
    fn note(&mut self, text: impl Into<String>) {
        self.loading.notices.add(text);
    }

    /// Bones as a table by name, which `kind` requires.
    fn bones_of_1(&mut self, vrm: &Value, kind: &str) {
        let bones = vrm.pointer("/humanoid/humanBones");
        let Some(bones) = bones.and_then(Value::as_object) else {
            self.note(format!("the avatar has no humanoid, which {kind} requires"));
            return;
        };
        for (name, said) in bones {
            self.bone(name, Bone::named(name), said.get("node"));
        }
    }

    /// Bones as a list, in which a name may come twice, and node -1 is none.
    fn bones_of_0(&mut self, vrm: &Value) {
        let bones = vrm.pointer("/humanoid/humanBones");
        let Some(bones) = bones.and_then(Value::as_array) else {
            self.note("the avatar has no humanoid, which VRM 0.x requires");
            return;
        };
        for said in bones {
            let name = said.get("bone").and_then(Value::as_str).unwrap_or_default();
            let node = said.get("node");
            if node.and_then(Value::as_i64) != Some(-1) {
                self.bone(name, Bone::named_in_0(name), node);
            }
        }
        self.note_missing_bones(vrm);
    }

    /// Takes a bone, or says what is wrong with it.
    fn bone(&mut self, name: &str, bone: Option<Bone>, node: Option<&Value>) {
        // Find its node.
        let count = self.root.nodes.len();
        let number = node.and_then(Value::as_u64);
        let name = shown(name);
        let Some(number) = number.filter(|number| *number < count as u64) else {
            self.note(format!(
                "bone '{name}' of the avatar names no node of the {count} in the file"
            ));
            return;
        };

        // Judge both.
        let Some(bone) = bone else {
            self.note(format!(
                "bone '{name}' of the avatar is none that VRM knows"
            ));
            return;
        };
        let place = usize::try_from(number).ok();
        let place = place.and_then(|number| self.tree.place(number));
        let rest = place.and_then(|place| self.nodes.get(place as usize)?.rest);
        let fault = match (place, rest, self.owners.get(&number)) {
            _ if self.figure.bones.contains_key(&bone) => {
                "is named twice; the first one counts".to_owned()
            }
            (None, ..) => format!("is node {number}, which is not part of the scene"),
            (_, None, _) => format!("is node {number}, which has a matrix and is not posed"),
            (_, _, Some(other)) => format!("is node {number}, which is bone '{other}' already"),
            (Some(place), Some(_), None) => {
                self.owners.insert(number, bone);
                self.figure.bones.insert(bone, place);
                return;
            }
        };
        self.note(format!("bone '{name}' of the avatar {fault}"));
    }

    /// Says which of the bones that VRM requires are not there, in a humanoid that is.
    fn note_missing_bones(&mut self, vrm: &Value) {
        let missing = |bone: &Bone| bone.is_required() && !self.figure.bones.contains_key(bone);
        let missing: Vec<&str> = Bone::all().filter(missing).map(Bone::name).collect();
        if missing.is_empty() || vrm.pointer("/humanoid/humanBones").is_none() {
            return;
        }
        let list = missing.join(", ");
        self.note(format!("the avatar lacks bones that VRM requires: {list}"));
    }

    /// Expressions of VRM 1.0: those that it names, then others.
    fn expressions_of_1(&mut self, vrm: &Value) -> Result<(), SceneError> {
        let is_preset = |name: &str| PRESETS.iter().any(|[new, _]| *new == name);
        for (kind, wants_preset) in [("preset", true), ("custom", false)] {
            let list = vrm.pointer(&format!("/expressions/{kind}"));
            for (name, said) in list.and_then(Value::as_object).into_iter().flatten() {
                if is_preset(name) == wants_preset {
                    self.expression_of_1(name, said)?;
                    continue;
                }
                let fault = match wants_preset {
                    true => "is none that VRM 1.0 knows",
                    false => "has a name of VRM's own",
                };
                self.note(format!(
                    "{kind} expression '{}' of the avatar {fault}",
                    shown(name)
                ));
            }
        }
        Ok(())
    }

    fn expression_of_1(&mut self, name: &str, said: &Value) -> Result<(), SceneError> {
        // Read what it is.
        let overrides = |key: &str| match said.get(key).and_then(Value::as_str) {
            Some("block") => Override::Block,
            Some("blend") => Override::Blend,
            _ => Override::None,
        };
        let mut expression = Expression {
            name: name.to_owned(),
            file_name: name.to_owned(),
            is_binary: is_true(said.get("isBinary")),
            of_blinks: overrides("overrideBlink"),
            of_looks: overrides("overrideLookAt"),
            of_mouths: overrides("overrideMouth"),
            ..Expression::default()
        };
        self.loading
            .allowance
            .take::<Expression>("expressions", 1)?;
        self.loading.allowance.take::<u8>("names", name.len())?;

        // Read what it binds.
        for bind in list(said, "morphTargetBinds") {
            let (node, morph) = (number(bind, "node"), number(bind, "index"));
            let place = node.and_then(|node| self.morphed(node, morph?));
            self.bind_morph(&mut expression, &[place], bind.get("weight"), 1.0)?;
        }
        for bind in list(said, "materialColorBinds") {
            let material = number(bind, "material");
            let material = material.filter(|index| *index < self.root.materials.len());
            let kind = bind.get("type").and_then(Value::as_str);
            let materials: Vec<usize> = material.into_iter().collect();
            self.bind_color(&mut expression, &materials, kind == Some("color"), bind)?;
        }
        for bind in list(said, "textureTransformBinds") {
            let material = number(bind, "material");
            let material = material.filter(|index| *index < self.root.materials.len());
            let part = |key, default| bind.get(key).map_or(Some(default), numbers::<2>);
            match (material, part("scale", [1.0; 2]), part("offset", [0.0; 2])) {
                (Some(material), Some(scale), Some(offset)) => {
                    self.bind_texture(&mut expression, &[material], scale, offset)?;
                }
                _ => self.note_bind(
                    &expression,
                    "a texture that does not exist, or by no numbers",
                ),
            }
        }
        self.figure.expressions.push(expression);
        Ok(())
    }

    /// Expressions of VRM 0.x, under the names of 1.0.
    fn expressions_of_0(&mut self, vrm: &Value) -> Result<(), SceneError> {
        // Find the nodes of each mesh.
        let mut of_mesh: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (index, node) in self.root.nodes.iter().enumerate() {
            if let Some(mesh) = node.mesh.as_ref().map(Index::value) {
                of_mesh.entry(mesh).or_default().push(index);
            }
        }

        // Read each that has a name of its own.
        let mut names = BTreeSet::new();
        let groups = vrm.pointer("/blendShapeMaster/blendShapeGroups");
        for said in groups.and_then(Value::as_array).into_iter().flatten() {
            let text = |key| said.get(key).and_then(Value::as_str);
            let preset = text("presetName").unwrap_or_default().to_lowercase();
            let preset = PRESETS.iter().find(|[_, old]| *old == preset);
            let file_name = text("name").unwrap_or_default();
            let name = preset.map_or(file_name, |[new, _]| new);
            if name.is_empty() {
                self.note("an expression of the avatar has no name");
            } else if names.insert(name.to_owned()) {
                self.expression_of_0(name, file_name, said, &of_mesh)?;
            } else {
                let name = shown(name);
                self.note(format!(
                    "expression '{name}' of the avatar is there twice; the first one counts"
                ));
            }
        }
        Ok(())
    }

    fn expression_of_0(
        &mut self,
        name: &str,
        file_name: &str,
        said: &Value,
        of_mesh: &BTreeMap<usize, Vec<usize>>,
    ) -> Result<(), SceneError> {
        // Read what it is.
        let mut expression = Expression {
            name: name.to_owned(),
            file_name: file_name.to_owned(),
            is_binary: is_true(said.get("isBinary")),
            ..Expression::default()
        };
        self.loading
            .allowance
            .take::<Expression>("expressions", 1)?;
        let bytes = name.len().saturating_add(file_name.len());
        self.loading.allowance.take::<u8>("names", bytes)?;

        // Read what it binds, at every node of the mesh.
        for bind in list(said, "binds") {
            let (mesh, morph) = (number(bind, "mesh"), number(bind, "index"));
            let nodes = mesh
                .and_then(|mesh| of_mesh.get(&mesh))
                .map_or(&[][..], Vec::as_slice);
            self.loading
                .allowance
                .take::<MorphBind>("expressions", nodes.len())?;
            let places = nodes.iter().map(|node| self.morphed(*node, morph?));
            let places: Vec<_> = match nodes {
                [] => vec![None],
                _ => places.collect(),
            };
            self.bind_morph(&mut expression, &places, bind.get("weight"), WHOLE_IN_0)?;
        }
        for bind in list(said, "materialValues") {
            let name = bind.get("materialName").and_then(Value::as_str);
            let all = self.root.materials.iter().enumerate();
            let called =
                all.filter(|(_, material)| name.is_some() && material.name.as_deref() == name);
            let materials: Vec<usize> = called.map(|(index, _)| index).collect();
            let property = bind.get("propertyName").and_then(Value::as_str);
            if property != Some("_MainTex_ST") {
                self.bind_color(
                    &mut expression,
                    &materials,
                    property == Some("_Color"),
                    bind,
                )?;
                continue;
            }
            match bind.get("targetValue").and_then(numbers::<4>) {
                // Images of VRM 0.x stand on their lower edge.
                Some([u, v, x, y]) if !materials.is_empty() => {
                    self.bind_texture(&mut expression, &materials, [u, v], [x, 1.0 - y - v])?;
                }
                _ => self.note_bind(
                    &expression,
                    "a texture that does not exist, or by no numbers",
                ),
            }
        }
        self.figure.expressions.push(expression);
        Ok(())
    }

    /// The node and the morph that a bind names, where all of the node's mesh has that morph.
    fn morphed(&self, node: usize, morph: usize) -> Option<[u32; 2]> {
        let mesh = self.root.nodes.get(node)?.mesh.as_ref().map(Index::value)?;
        let primitives = &self.root.meshes.get(mesh)?.primitives;
        let has = |count: usize| morph < count;
        let mut counts = primitives
            .iter()
            .map(|part| part.targets.iter().flatten().count());
        let is_there = !primitives.is_empty() && counts.all(has);
        let place = self.tree.place(node).filter(|_| is_there)?;
        Some([place, u32::try_from(morph).ok()?])
    }

    /// Adds binds of morphs at `places`, which are none where they do not exist; a weight of `whole` moves all of it.
    fn bind_morph(
        &mut self,
        expression: &mut Expression,
        places: &[Option<[u32; 2]>],
        weight: Option<&Value>,
        whole: f32,
    ) -> Result<(), SceneError> {
        let weight = weight.map_or(Some(whole), |weight| weight.as_f64().map(|w| w as f32));
        let Some(weight) = weight
            .map(|weight| weight / whole)
            .filter(|w| w.is_finite())
        else {
            self.note_bind(expression, "a morph target by a weight that is no number");
            return Ok(());
        };
        self.loading
            .allowance
            .take::<MorphBind>("expressions", places.len())?;
        for place in places {
            match *place {
                Some([node, morph]) => expression.morphs.push(MorphBind {
                    node,
                    morph,
                    weight,
                }),
                None => self.note_bind(expression, "a morph target that does not exist"),
            }
        }
        Ok(())
    }

    /// Adds binds of base colours; other colours have a notice.
    fn bind_color(
        &mut self,
        expression: &mut Expression,
        materials: &[usize],
        is_base: bool,
        bind: &Value,
    ) -> Result<(), SceneError> {
        // Read the colour.
        if !is_base {
            self.note("expressions change only base colours of the avatar, and no other ones");
            return Ok(());
        }
        let target = bind.get("targetValue");
        let color = target.and_then(numbers::<4>).or_else(|| {
            let [r, g, b] = target.and_then(numbers::<3>)?;
            Some([r, g, b, 1.0])
        });
        let Some(color) = color.filter(|_| !materials.is_empty()) else {
            self.note_bind(
                expression,
                "a material that does not exist, or by no colour",
            );
            return Ok(());
        };

        // Bind it.
        self.loading
            .allowance
            .take::<ColorBind>("expressions", materials.len())?;
        let materials = materials
            .iter()
            .filter_map(|index| u32::try_from(*index).ok());
        let binds = materials.map(|material| ColorBind { material, color });
        expression.colors.extend(binds);
        Ok(())
    }

    fn bind_texture(
        &mut self,
        expression: &mut Expression,
        materials: &[usize],
        scale: [f32; 2],
        offset: [f32; 2],
    ) -> Result<(), SceneError> {
        self.loading
            .allowance
            .take::<TextureBind>("expressions", materials.len())?;
        let materials = materials
            .iter()
            .filter_map(|index| u32::try_from(*index).ok());
        let binds = materials.map(|material| TextureBind {
            material,
            scale,
            offset,
        });
        expression.textures.extend(binds);
        Ok(())
    }

    fn note_bind(&mut self, expression: &Expression, what: &str) {
        let name = match expression.file_name.as_str() {
            "" => &expression.name,
            name => name,
        };
        self.note(format!(
            "expression '{}' of the avatar binds {what}",
            shown(name)
        ));
    }

    /// The nodes of a motion that give expressions their shares.
    fn shares(&mut self, motion: &Value) -> Result<(), SceneError> {
        for kind in ["preset", "custom"] {
            let list = motion.pointer(&format!("/expressions/{kind}"));
            for (name, said) in list.and_then(Value::as_object).into_iter().flatten() {
                let node = number(said, "node").and_then(|node| self.tree.place(node));
                match node {
                    Some(node) => {
                        self.loading
                            .allowance
                            .take::<(String, u32)>("expressions", 1)?;
                        self.loading.allowance.take::<u8>("names", name.len())?;
                        self.figure.share_nodes.push((name.clone(), node));
                    }
                    None => self.note(format!(
                        "expression '{}' of the motion names no node of the scene",
                        shown(name)
                    )),
                }
            }
        }
        Ok(())
    }
}

fn list<'a>(said: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> {
    said.get(key)
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
}

fn number(said: &Value, key: &str) -> Option<usize> {
    usize::try_from(said.get(key)?.as_u64()?).ok()
}

fn is_true(said: Option<&Value>) -> bool {
    said.and_then(Value::as_bool).unwrap_or(false)
}
