//! Files of postures: bones by their names in VRM, each with how it is turned.
//!
//! ```json
//! {"pose": {"hips": {"position": [0, -0.05, 0]}, "leftUpperArm": {"rotation": [0, 0, 0.6, 0.8]}}}
//! ```
//!
//! It is what `VRMHumanoid.getNormalizedPose` of three-vrm gives for an avatar of VRM 1.0, with or without `pose`
//! around it.

use crate::bone::Bone;
use crate::limits::{self, LimitError, Limits};
use crate::mesh::POSITION_LIMIT;
use npr_core::decoding::guard;
use serde_json::Value;
use std::collections::BTreeMap;

/// How a figure stands, by the names of its bones; those that it does not name stay as they are.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Posture {
    /// How far bones are turned from rest, as quaternions `x y z w` of any length along the axes of the world.
    pub turns: BTreeMap<Bone, [f32; 4]>,
    /// How far the hips are moved from rest, in units of the scene.
    pub hips: Option<[f32; 3]>,
}

/// How many times as many bytes the JSON of a scene may have.
const SHARE_OF_JSON: u64 = 64;

/// Why a file is no posture.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PostureError {
    /// It is not JSON.
    #[error("line {line}, column {column}: this is not JSON")]
    Json {
        /// Where reading stopped, counted from 1.
        line: usize,
        /// Likewise.
        column: usize,
    },
    /// It is too large.
    #[error(transparent)]
    Limit(#[from] LimitError),
    /// It holds something else.
    #[error(
        "it holds no bones: {{\"pose\": {{\"hips\": {{\"rotation\": [x, y, z, w]}}}}}} is expected"
    )]
    NoBones,
}

/// What of a posture could not be used.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum PostureFault {
    /// A name that no bone has.
    UnknownBone(String),
    /// A rotation that is no list of four finite numbers, or has no length.
    BadRotation(Bone),
    /// A position that is no list of three finite numbers.
    BadPosition(Bone),
    /// A position of another bone than the hips, which alone may move.
    MovedBone(Bone),
}

impl Posture {
    /// The posture in a file, with what of it cannot be used. O(bytes); files may have a 64th of the bytes that
    /// `limits` allow the JSON of a scene.
    ///
    /// # Errors
    ///
    /// [`PostureError`] where the file holds no object of objects, or is too large.
    pub fn read(bytes: &[u8], limits: &Limits) -> Result<(Self, Vec<PostureFault>), PostureError> {
        // Find the bones.
        let (size, most) = (bytes.len() as u64, limits.json_bytes / SHARE_OF_JSON);
        limits::check("size of a pose in bytes", size, most, "--max-json")?;
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let parsed = guard(|| serde_json::from_slice::<Value>(bytes));
        let document = parsed.map_err(|_| PostureError::NoBones)?;
        let document = document.map_err(|fault| PostureError::Json {
            line: fault.line(),
            column: fault.column(),
        })?;
        let bones = document.get("pose").unwrap_or(&document);
        let bones = bones.as_object().ok_or(PostureError::NoBones)?;
        if !bones.values().all(Value::is_object) {
            return Err(PostureError::NoBones);
        }

        // Read each, noting what is wrong with it.
        let (mut posture, mut faults) = (Self::default(), Vec::new());
        for (name, said) in bones {
            let Some(bone) = Bone::named(name) else {
                faults.push(PostureFault::UnknownBone(name.clone()));
                continue;
            };
            if let Some(rotation) = present(said, "rotation") {
                match numbers::<4>(rotation).filter(|q| q.iter().any(|v| *v != 0.0)) {
                    Some(turn) => drop(posture.turns.insert(bone, turn)),
                    None => faults.push(PostureFault::BadRotation(bone)),
                }
            }
            if let Some(position) = present(said, "position") {
                match numbers::<3>(position) {
                    Some(way) if bone == Bone::HIPS => posture.hips = Some(way),
                    Some(way) if way == [0.0; 3] => {}
                    Some(_) => faults.push(PostureFault::MovedBone(bone)),
                    None => faults.push(PostureFault::BadPosition(bone)),
                }
            }
        }
        Ok((posture, faults))
    }
}

/// A value that is there and not null.
fn present<'a>(said: &'a Value, key: &str) -> Option<&'a Value> {
    said.get(key).filter(|value| !value.is_null())
}

/// A list of so many numbers, all finite and in range.
pub(crate) fn numbers<const N: usize>(value: &Value) -> Option<[f32; N]> {
    let list: Vec<f32> = value
        .as_array()?
        .iter()
        .map(|value| value.as_f64().map(|value| value as f32))
        .collect::<Option<_>>()?;
    let list = <[f32; N]>::try_from(list).ok()?;
    list.iter()
        .all(|v| v.abs() <= POSITION_LIMIT)
        .then_some(list)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bones_are_read_and_what_is_wrong_is_told() {
        let text = br#"{"pose":{"hips":{"position":[0,-0.1,0],"rotation":null},"head":{"rotation":[0,0,0,2]},
            "neck":{"rotation":[0,0,0,0]},"jaw":{"rotation":[0,0,1]},"spine":{"position":[1,0,0]},
            "chest":{"position":[0,0,0]},"leftHand":{"position":"here"},"Head":{}}}"#;
        let (posture, mut faults) = Posture::read(text, &Limits::default()).expect("a posture");
        assert_eq!(posture.hips, Some([0.0, -0.1, 0.0]));
        let [head, neck, jaw, spine, hand] = ["head", "neck", "jaw", "spine", "leftHand"]
            .map(|name| Bone::named(name).expect("a bone"));
        assert_eq!(posture.turns, [(head, [0.0, 0.0, 0.0, 2.0])].into());
        let mut told = vec![
            PostureFault::UnknownBone("Head".to_owned()),
            PostureFault::BadRotation(jaw),
            PostureFault::BadPosition(hand),
            PostureFault::BadRotation(neck),
            PostureFault::MovedBone(spine),
        ];
        for list in [&mut faults, &mut told] {
            list.sort_by_key(|fault| format!("{fault:?}"));
        }
        assert_eq!(faults, told);
    }

    #[test]
    fn the_object_around_the_bones_may_be_left_out() {
        let bare = br#"{"hips":{"position":[0,1,0]}}"#;
        let (posture, faults) = Posture::read(bare, &Limits::default()).expect("a posture");
        assert_eq!((posture.hips, faults), (Some([0.0, 1.0, 0.0]), vec![]));
    }

    #[test]
    fn other_files_are_refused() {
        for text in ["[]", "3", "{\"pose\":3}", "{\"pose\":{\"hips\":[0,0,0,1]}}"] {
            let fault = Posture::read(text.as_bytes(), &Limits::default()).expect_err("no posture");
            assert_eq!(fault, PostureError::NoBones, "{text}");
        }
        let deep = "{\"pose\":".repeat(100_000);
        for text in ["", "{", "{\"pose\":}", &deep] {
            let fault = Posture::read(text.as_bytes(), &Limits::default()).expect_err("no JSON");
            assert!(matches!(fault, PostureError::Json { .. }));
        }
        let large = " ".repeat((1 << 20) + 1);
        let fault = Posture::read(large.as_bytes(), &Limits::default()).expect_err("too large");
        assert!(fault.to_string().contains("--max-json"), "{fault}");
    }
}
