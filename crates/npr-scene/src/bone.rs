//! Bones of humanoids, by the names that VRM gives them.

use std::fmt;

/// Every bone by its name in VRM 1.0, and by its name in skeletons of Mixamo, without prefix; empty where it has none
/// there. A bone follows the one that it hangs on.
const BONES: [[&str; 2]; 55] = [
    ["hips", "Hips"],
    ["spine", "Spine"],
    ["chest", "Spine1"],
    ["upperChest", "Spine2"],
    ["neck", "Neck"],
    ["head", "Head"],
    ["leftEye", "LeftEye"],
    ["rightEye", "RightEye"],
    ["jaw", ""],
    ["leftUpperLeg", "LeftUpLeg"],
    ["leftLowerLeg", "LeftLeg"],
    ["leftFoot", "LeftFoot"],
    ["leftToes", "LeftToeBase"],
    ["rightUpperLeg", "RightUpLeg"],
    ["rightLowerLeg", "RightLeg"],
    ["rightFoot", "RightFoot"],
    ["rightToes", "RightToeBase"],
    ["leftShoulder", "LeftShoulder"],
    ["leftUpperArm", "LeftArm"],
    ["leftLowerArm", "LeftForeArm"],
    ["leftHand", "LeftHand"],
    ["rightShoulder", "RightShoulder"],
    ["rightUpperArm", "RightArm"],
    ["rightLowerArm", "RightForeArm"],
    ["rightHand", "RightHand"],
    ["leftThumbMetacarpal", "LeftHandThumb1"],
    ["leftThumbProximal", "LeftHandThumb2"],
    ["leftThumbDistal", "LeftHandThumb3"],
    ["leftIndexProximal", "LeftHandIndex1"],
    ["leftIndexIntermediate", "LeftHandIndex2"],
    ["leftIndexDistal", "LeftHandIndex3"],
    ["leftMiddleProximal", "LeftHandMiddle1"],
    ["leftMiddleIntermediate", "LeftHandMiddle2"],
    ["leftMiddleDistal", "LeftHandMiddle3"],
    ["leftRingProximal", "LeftHandRing1"],
    ["leftRingIntermediate", "LeftHandRing2"],
    ["leftRingDistal", "LeftHandRing3"],
    ["leftLittleProximal", "LeftHandPinky1"],
    ["leftLittleIntermediate", "LeftHandPinky2"],
    ["leftLittleDistal", "LeftHandPinky3"],
    ["rightThumbMetacarpal", "RightHandThumb1"],
    ["rightThumbProximal", "RightHandThumb2"],
    ["rightThumbDistal", "RightHandThumb3"],
    ["rightIndexProximal", "RightHandIndex1"],
    ["rightIndexIntermediate", "RightHandIndex2"],
    ["rightIndexDistal", "RightHandIndex3"],
    ["rightMiddleProximal", "RightHandMiddle1"],
    ["rightMiddleIntermediate", "RightHandMiddle2"],
    ["rightMiddleDistal", "RightHandMiddle3"],
    ["rightRingProximal", "RightHandRing1"],
    ["rightRingIntermediate", "RightHandRing2"],
    ["rightRingDistal", "RightHandRing3"],
    ["rightLittleProximal", "RightHandPinky1"],
    ["rightLittleIntermediate", "RightHandPinky2"],
    ["rightLittleDistal", "RightHandPinky3"],
];

/// The bones that VRM asks every avatar for.
const REQUIRED: [&str; 15] = [
    "hips",
    "spine",
    "head",
    "leftUpperLeg",
    "leftLowerLeg",
    "leftFoot",
    "rightUpperLeg",
    "rightLowerLeg",
    "rightFoot",
    "leftUpperArm",
    "leftLowerArm",
    "leftHand",
    "rightUpperArm",
    "rightLowerArm",
    "rightHand",
];

/// What the bones of the thumb are called in VRM 0.x, and now.
const THUMBS: [[&str; 2]; 4] = [
    ["leftThumbProximal", "leftThumbMetacarpal"],
    ["leftThumbIntermediate", "leftThumbProximal"],
    ["rightThumbProximal", "rightThumbMetacarpal"],
    ["rightThumbIntermediate", "rightThumbProximal"],
];

/// What Mixamo puts before the names of bones; a number may follow, then a colon or an underscore.
const MIXAMO: &str = "mixamorig";

/// A bone of a humanoid [VRM 1.0, humanoid].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Bone(u8);

impl Bone {
    /// The hips, which all other bones hang on.
    pub const HIPS: Self = Self(0);

    /// The head, which moves the face.
    pub const HEAD: Self = Self(5);

    /// The left eye.
    pub const LEFT_EYE: Self = Self(6);

    /// The right eye.
    pub const RIGHT_EYE: Self = Self(7);

    /// All bones, each behind the one that it hangs on.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..BONES.len() as u8).map(Self)
    }

    /// The bone that VRM 1.0 calls so.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|bone| bone.name() == name)
    }

    /// The bone that VRM 0.x calls so; thumbs have other names there.
    pub(crate) fn named_in_0(name: &str) -> Option<Self> {
        let thumb = THUMBS.iter().find(|[old, _]| *old == name);
        Self::named(thumb.map_or(name, |[_, new]| new))
    }

    /// The bone that a node is, by its name: that of VRM 1.0 in any letter case, or that of a skeleton of Mixamo, with
    /// or without its prefix.
    pub(crate) fn of_node(name: &str) -> Option<Self> {
        let prefixed = name
            .get(..MIXAMO.len())
            .filter(|start| start.eq_ignore_ascii_case(MIXAMO));
        let bare = prefixed.and_then(|prefix| name.get(prefix.len()..));
        let bare = bare.map(|bare| {
            bare.trim_start_matches(|c: char| c.is_ascii_digit())
                .trim_start_matches([':', '_'])
        });
        let bare = bare.unwrap_or(name);
        let is_called = |bone: &Self| {
            let names = BONES[usize::from(bone.0)];
            !bare.is_empty() && names.iter().any(|name| name.eq_ignore_ascii_case(bare))
        };
        Self::all().find(is_called)
    }

    /// Its name in VRM 1.0.
    pub fn name(self) -> &'static str {
        BONES[usize::from(self.0)][0]
    }

    /// Whether VRM asks every avatar for it.
    pub fn is_required(self) -> bool {
        REQUIRED.contains(&self.name())
    }
}

impl fmt::Display for Bone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bone_has_a_name_of_its_own() {
        for bone in Bone::all() {
            assert_eq!(Bone::named(bone.name()), Some(bone));
            assert_eq!(Bone::of_node(bone.name()), Some(bone));
        }
        assert_eq!(Bone::all().filter(|bone| bone.is_required()).count(), 15);
        assert_eq!([Bone::HIPS, Bone::HEAD].map(Bone::name), ["hips", "head"]);
        let eyes = [Bone::LEFT_EYE, Bone::RIGHT_EYE].map(Bone::name);
        assert_eq!(eyes, ["leftEye", "rightEye"]);
        assert_eq!(Bone::named("Hips"), None);
    }

    #[test]
    fn nodes_are_named_as_vrm_and_mixamo_do() {
        let name = |node| Bone::of_node(node).map(Bone::name);
        assert_eq!(name("mixamorig:LeftForeArm"), Some("leftLowerArm"));
        assert_eq!(name("mixamorigSpine1"), Some("chest"));
        assert_eq!(name("mixamorig12:HIPS"), Some("hips"));
        assert_eq!(name("LeftUpLeg"), Some("leftUpperLeg"));
        assert_eq!(name("leftupperleg"), Some("leftUpperLeg"));
        for other in [
            "",
            "mixamorig:",
            "mixamorig",
            "mixamori\u{7f}:Hips",
            "hip",
            "ärm",
        ] {
            assert_eq!(name(other), None, "{other}");
        }
    }

    #[test]
    fn thumbs_moved_on_by_one_since_vrm_0() {
        let name = |old| Bone::named_in_0(old).map(Bone::name);
        assert_eq!(name("leftThumbProximal"), Some("leftThumbMetacarpal"));
        assert_eq!(name("rightThumbIntermediate"), Some("rightThumbProximal"));
        assert_eq!(name("rightThumbDistal"), Some("rightThumbDistal"));
        assert_eq!(name("chest"), Some("chest"));
    }
}
