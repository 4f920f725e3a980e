//! Films that are taken away from a studio.

use crate::pose::Pose;
use crate::value::number_text;

/// A film of what plays, or of a camera that turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    /// How it is written.
    pub form: FilmForm,
    /// Frames a second.
    pub fps: f32,
    /// Whether the clip plays; else the scene stands as it is shown.
    pub plays: bool,
    /// Whether the camera turns once around its target.
    pub turns: bool,
}

/// How a film is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilmForm {
    /// One `.apng`, without loss.
    Apng,
    /// One `.gif` of 256 colours.
    Gif,
    /// A numbered `.png` for every frame.
    Frames,
}

impl FilmForm {
    /// What follows the name of the scene in the names of its files; `####` is the number of a frame.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Apng => ".apng",
            Self::Gif => ".gif",
            Self::Frames => "_####.png",
        }
    }
}

impl Film {
    /// The pose that the scene has in the film, of the one that is shown.
    pub fn pose(&self, shown: &Pose) -> Pose {
        let mut pose = shown.clone();
        if self.plays {
            pose.time_s = None;
        }
        pose
    }

    /// The film as options of `npr animate`, without where it goes.
    pub fn options(&self) -> Vec<String> {
        let mut words = vec![format!("--fps={}", number_text(f64::from(self.fps)))];
        if self.turns {
            words.push("--turntable".to_owned());
        }
        words
    }
}

/// The film that the user has in mind, and the one that is drawn.
#[derive(Debug, Default)]
pub(crate) struct Filming {
    /// Whether the scene stands still though something could play.
    pub is_held: bool,
    /// Whether the camera turns.
    pub turns: bool,
    /// How many frames are drawn, and of how many, while a film is drawn.
    pub done: Option<[usize; 2]>,
}
