//! Undo and redo.

use crate::pose::{Face, Pose};
use crate::sheet::Sheet;

/// Most steps that can be undone.
const STEPS_MAX: usize = 200;

/// The styles, faces, turned bones and smoke before and after the present ones.
#[derive(Debug, Default)]
pub(crate) struct History {
    past: Vec<Step>,
    future: Vec<Step>,
    /// The key that the last change was made to, while it may still be one with the next.
    open: Option<String>,
}

/// What a step puts in place of the present one.
#[derive(Debug)]
enum Step {
    Style(Box<Sheet>),
    Face(Face),
    Turns(Vec<(String, [f32; 3])>),
    Volumes(Vec<String>),
}

impl Step {
    /// Puts it in place, and keeps what was there.
    fn swap(&mut self, sheet: &mut Sheet, pose: &mut Pose) {
        match self {
            Self::Style(other) => std::mem::swap(&mut **other, sheet),
            Self::Face(other) => std::mem::swap(other, &mut pose.face),
            Self::Turns(other) => std::mem::swap(other, &mut pose.turns),
            Self::Volumes(other) => std::mem::swap(other, &mut pose.volumes),
        }
    }
}

impl History {
    /// Notes the style before a change of a key. Changes of one key belong together until [`History::close`].
    pub fn note(&mut self, before: &Sheet, key: &str) {
        self.add(key, || Step::Style(Box::new(before.clone())));
    }

    /// Notes the face before a change of something in it, as [`History::note`] does.
    pub fn note_face(&mut self, before: &Face, what: &str) {
        let key = format!("face of the figure: {what}");
        self.add(&key, || Step::Face(before.clone()));
    }

    /// Notes how bones are turned before a change of one, as [`History::note`] does.
    pub fn note_turns(&mut self, before: &Pose, bone: &str) {
        let key = format!("bone of the figure: {bone}");
        self.add(&key, || Step::Turns(before.turns.clone()));
    }

    /// Notes what smoke is in the scene before it changes.
    pub fn note_volumes(&mut self, before: &Pose) {
        self.add("smoke in the scene", || {
            Step::Volumes(before.volumes.clone())
        });
    }

    /// Forgets faces, turned bones and smoke: another scene is shown.
    pub fn forget_figure(&mut self) {
        self.close();
        for steps in [&mut self.past, &mut self.future] {
            steps.retain(|step| matches!(step, Step::Style(_)));
        }
    }

    fn add(&mut self, key: &str, step: impl FnOnce() -> Step) {
        self.future.clear();
        if self.open.as_deref() == Some(key) {
            return;
        }
        self.open = Some(key.to_owned());
        self.past.push(step());
        if self.past.len() > STEPS_MAX {
            self.past.remove(0);
        }
    }

    /// Ends a change: the next one of the same key is a step of its own.
    pub fn close(&mut self) {
        self.open = None;
    }

    /// Whether a step can be undone, and whether one can be done again.
    pub fn can(&self) -> (bool, bool) {
        (!self.past.is_empty(), !self.future.is_empty())
    }

    /// Puts what was there before the last change in place of the present style, face, bones or smoke.
    pub fn undo(&mut self, sheet: &mut Sheet, pose: &mut Pose) {
        self.close();
        if let Some(mut step) = self.past.pop() {
            step.swap(sheet, pose);
            self.future.push(step);
        }
    }

    /// Takes the last undoing back.
    pub fn redo(&mut self, sheet: &mut Sheet, pose: &mut Pose) {
        self.close();
        if let Some(mut step) = self.future.pop() {
            step.swap(sheet, pose);
            self.past.push(step);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_stylesheet::Stated;
    use proptest::prelude::*;
    use toml::Value;

    const KEYS: [&str; 3] = ["line.opacity", "shade.saturation", "line.width.gain"];

    const FACES: [&str; 2] = ["happy", "blink"];

    const BONES: [&str; 2] = ["head", "spine"];

    proptest! {
        /// Every change of another key is a step; as many steps back lead to the first style, and forth to the last.
        #[test]
        fn as_many_steps_back_as_forth_lead_where_they_began(
            changes in prop::collection::vec((0usize..7, 0u32..5, any::<bool>()), 0..20),
        ) {
            let mut sheet = Sheet::new("toon", Stated::preset("toon").expect("a preset"), &[]).expect("a sheet");
            let (mut pose, mut history) = (Pose::default(), History::default());
            let first = (sheet.clone(), pose.clone());
            for (key, fifths, closes) in changes {
                let before = (sheet.clone(), pose.clone());
                let (face, bone) = (key.wrapping_sub(3), key.wrapping_sub(5));
                match KEYS.get(key) {
                    Some(key) => sheet.set(key, &Value::Float(f64::from(fifths) / 5.0)).expect("fits"),
                    None => {
                        let share = (fifths < 4).then_some(fifths as f32 / 5.0);
                        match FACES.get(face) {
                            Some(name) => pose.face.set_share(name, share),
                            None => pose.set_turn(BONES[bone], share.map(|share| [share; 3])),
                        }
                    }
                }
                if sheet != before.0 {
                    history.note(&before.0, KEYS[key]);
                }
                if pose.face != before.1.face {
                    history.note_face(&before.1.face, FACES[face]);
                }
                if pose.turns != before.1.turns {
                    history.note_turns(&before.1, BONES[bone]);
                }
                if closes {
                    history.close();
                }
            }
            let last = (sheet.clone(), pose.clone());
            while history.can().0 {
                history.undo(&mut sheet, &mut pose);
            }
            prop_assert_eq!((&sheet, &pose), (&first.0, &first.1));
            while history.can().1 {
                history.redo(&mut sheet, &mut pose);
            }
            prop_assert_eq!((&sheet, &pose), (&last.0, &last.1));
        }
    }
}
