//! Undo and redo.

use crate::pose::Face;
use crate::sheet::Sheet;

/// Most steps that can be undone.
const STEPS_MAX: usize = 200;

/// The styles and faces before and after the present ones.
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
}

impl Step {
    /// Puts it in place, and keeps what was there.
    fn swap(&mut self, sheet: &mut Sheet, face: &mut Face) {
        match self {
            Self::Style(other) => std::mem::swap(&mut **other, sheet),
            Self::Face(other) => std::mem::swap(other, face),
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

    /// Forgets the faces: another scene is shown.
    pub fn forget_faces(&mut self) {
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

    /// Puts the style or the face before the last change in place of the present one.
    pub fn undo(&mut self, sheet: &mut Sheet, face: &mut Face) {
        self.close();
        if let Some(mut step) = self.past.pop() {
            step.swap(sheet, face);
            self.future.push(step);
        }
    }

    /// Takes the last undoing back.
    pub fn redo(&mut self, sheet: &mut Sheet, face: &mut Face) {
        self.close();
        if let Some(mut step) = self.future.pop() {
            step.swap(sheet, face);
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

    proptest! {
        /// Every change of another key is a step; as many steps back lead to the first style, and forth to the last.
        #[test]
        fn as_many_steps_back_as_forth_lead_where_they_began(
            changes in prop::collection::vec((0usize..5, 0u32..5, any::<bool>()), 0..20),
        ) {
            let mut sheet = Sheet::new("toon", Stated::preset("toon").expect("a preset"), &[]).expect("a sheet");
            let (mut face, mut history) = (Face::default(), History::default());
            let first = (sheet.clone(), face.clone());
            for (key, fifths, closes) in changes {
                let before = (sheet.clone(), face.clone());
                match KEYS.get(key) {
                    Some(key) => sheet.set(key, &Value::Float(f64::from(fifths) / 5.0)).expect("fits"),
                    None => {
                        let share = (fifths < 4).then_some(fifths as f32 / 5.0);
                        face.set_share(FACES[key - KEYS.len()], share);
                    }
                }
                if sheet != before.0 {
                    history.note(&before.0, KEYS[key]);
                }
                if face != before.1 {
                    history.note_face(&before.1, FACES[key - KEYS.len()]);
                }
                if closes {
                    history.close();
                }
            }
            let last = (sheet.clone(), face.clone());
            while history.can().0 {
                history.undo(&mut sheet, &mut face);
            }
            prop_assert_eq!((&sheet, &face), (&first.0, &first.1));
            while history.can().1 {
                history.redo(&mut sheet, &mut face);
            }
            prop_assert_eq!((&sheet, &face), (&last.0, &last.1));
        }
    }
}
