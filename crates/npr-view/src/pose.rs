//! How a scene stands in a picture, and what there is of it to choose from.

use crate::value::number_text;

/// How a scene stands, as options of a command line say it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pose {
    /// The clip that plays, as `--clip` names it; none where the scene rests.
    pub clip: Option<String>,
    /// The time that is drawn, in seconds.
    pub time_s: Option<f32>,
    /// The file whose clips a figure plays.
    pub motion: Option<String>,
    /// The file of bones that are turned.
    pub bones: Option<String>,
    /// How far bones of a figure are turned from rest, by their names, each once: angles about the axes x, y and z of
    /// the world, in degrees, about x first. They count where `clip` or `bones` turn the same bone. No option says
    /// them: they are saved as a file of bones.
    pub turns: Vec<(String, [f32; 3])>,
    /// What the face of a figure does besides.
    pub face: Face,
    /// Files of smoke that stand in the scene besides, as `--volume` names them.
    pub volumes: Vec<String>,
}

/// What the face of a figure does.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Face {
    /// How much expressions show, 0 to 1, each name once.
    pub expressions: Vec<(String, f32)>,
    /// What the figure looks at; none where its eyes stay as they are.
    pub look_at: Option<LookAt>,
}

impl Face {
    /// How much an expression shows; none where nobody says it.
    pub fn share(&self, name: &str) -> Option<f32> {
        said(&self.expressions, name)
    }

    /// Lets an expression show so much; with none, as much as clip and file say.
    pub fn set_share(&mut self, name: &str, share: Option<f32>) {
        say(&mut self.expressions, name, share);
    }
}

/// What a list says of a name; none where it does not name it.
fn said<T: Copy>(list: &[(String, T)], name: &str) -> Option<T> {
    let mut all = list.iter();
    all.find_map(|(other, value)| (other == name).then_some(*value))
}

/// Lets a list say a value of a name; with none, it names it no more.
fn say<T>(list: &mut Vec<(String, T)>, name: &str, value: Option<T>) {
    let place = list.iter().position(|(other, _)| other == name);
    match (place, value) {
        (Some(place), Some(value)) => list[place].1 = value,
        (Some(place), None) => drop(list.remove(place)),
        (None, value) => list.extend(value.map(|value| (name.to_owned(), value))),
    }
}

/// What a figure looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LookAt {
    /// The eye of the camera.
    Camera,
    /// A point of the world.
    Place([f32; 3]),
}

impl Pose {
    /// How far a bone is turned, as in [`Pose::turns`]; none where nobody says it.
    pub fn turn(&self, bone: &str) -> Option<[f32; 3]> {
        said(&self.turns, bone)
    }

    /// Turns a bone so far; with none, as far as clip and file say.
    pub fn set_turn(&mut self, bone: &str, angles: Option<[f32; 3]>) {
        say(&mut self.turns, bone, angles);
    }

    /// The pose without what it does not show: a motion of which nothing plays.
    pub(crate) fn said(&self) -> Self {
        Self {
            motion: self.motion.clone().filter(|_| self.clip.is_some()),
            ..self.clone()
        }
    }

    /// The pose as options of a command line, which say nothing of [`Pose::turns`].
    pub fn options(&self) -> Vec<String> {
        let mut words = Vec::new();
        let named = [
            ("motion", &self.motion),
            ("pose", &self.bones),
            ("clip", &self.clip),
        ];
        for (option, name) in named {
            words.extend(name.iter().map(|name| format!("--{option}={name}")));
        }
        words.extend(self.time_s.map(|time_s| format!("--time={time_s}")));
        for (name, share) in &self.face.expressions {
            let share = number_text(f64::from(*share));
            words.push(format!("--expression={name}={share}"));
        }
        let volumes = self.volumes.iter();
        words.extend(volumes.map(|name| format!("--volume={name}")));
        words.extend(self.face.look_at.map(|look_at| match look_at {
            LookAt::Camera => "--look-at=camera".to_owned(),
            LookAt::Place([x, y, z]) => format!("--look-at={x},{y},{z}"),
        }));
        words
    }
}

/// What of a scene can move.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cast {
    /// Its clips, or those of the motion that its figure plays.
    pub clips: Vec<Clip>,
    /// Whether pictures on its surfaces move in time, besides clips.
    pub flows: bool,
    /// Names of the expressions of its figure.
    pub expressions: Vec<String>,
    /// Names of the bones of its figure, each behind the one that it hangs on.
    pub bones: Vec<String>,
    /// Whether its figure can look somewhere.
    pub can_look: bool,
    /// The file of the motion, where one is played.
    pub motion: Option<String>,
    /// Whether it has lights of its own.
    pub has_lights: bool,
    /// Whether pictures are seen by a camera of the file, which clips may move.
    pub has_own_camera: bool,
}

/// A clip of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Clip {
    /// What `--clip` calls it: its name, or its number where the name does not tell it from others.
    pub name: String,
    /// How long it is, in seconds.
    pub seconds: f32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_is_said_by_options() {
        assert_eq!(Pose::default().options(), [""; 0]);
        let pose = Pose {
            clip: Some("-Walk 2".to_owned()),
            time_s: Some(-0.1),
            motion: Some("a b.vrma".to_owned()),
            bones: Some("bow.json".to_owned()),
            turns: Vec::new(),
            face: Face {
                expressions: vec![("happy".to_owned(), 0.3)],
                look_at: Some(LookAt::Place([0.0, -1.5, 2.0])),
            },
            volumes: vec!["a b.vdb".to_owned()],
        };
        assert_eq!(
            pose.options(),
            [
                "--motion=a b.vrma",
                "--pose=bow.json",
                "--clip=-Walk 2",
                "--time=-0.1",
                "--expression=happy=0.3",
                "--volume=a b.vdb",
                "--look-at=0,-1.5,2",
            ]
        );
    }
}
