//! Undo and redo.

use crate::sheet::Sheet;

/// Most steps that can be undone.
const STEPS_MAX: usize = 200;

/// The styles before and after the present one.
#[derive(Debug, Default)]
pub(crate) struct History {
    past: Vec<Sheet>,
    future: Vec<Sheet>,
    /// The key that the last change was made to, while it may still be one with the next.
    open: Option<String>,
}

impl History {
    /// Notes the style before a change of a key. Changes of one key belong together until [`History::close`].
    pub fn note(&mut self, before: &Sheet, key: &str) {
        self.future.clear();
        if self.open.as_deref() == Some(key) {
            return;
        }
        self.open = Some(key.to_owned());
        self.past.push(before.clone());
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

    /// Puts the style before the last change in place of the present one.
    pub fn undo(&mut self, now: &mut Sheet) {
        self.close();
        if let Some(before) = self.past.pop() {
            self.future.push(std::mem::replace(now, before));
        }
    }

    /// Takes the last undoing back.
    pub fn redo(&mut self, now: &mut Sheet) {
        self.close();
        if let Some(after) = self.future.pop() {
            self.past.push(std::mem::replace(now, after));
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

    proptest! {
        /// Every change of another key is a step; as many steps back lead to the first style, and forth to the last.
        #[test]
        fn as_many_steps_back_as_forth_lead_where_they_began(
            changes in prop::collection::vec((0usize..3, 0u32..5, any::<bool>()), 0..20),
        ) {
            let mut sheet = Sheet::new("toon", Stated::preset("toon").expect("a preset"), &[]).expect("a sheet");
            let (first, mut history) = (sheet.clone(), History::default());
            for (key, fifths, closes) in changes {
                let before = sheet.clone();
                sheet.set(KEYS[key], &Value::Float(f64::from(fifths) / 5.0)).expect("fits");
                if sheet != before {
                    history.note(&before, KEYS[key]);
                }
                if closes {
                    history.close();
                }
            }
            let last = sheet.clone();
            while history.can().0 {
                history.undo(&mut sheet);
            }
            prop_assert_eq!(&sheet, &first);
            while history.can().1 {
                history.redo(&mut sheet);
            }
            prop_assert_eq!(&sheet, &last);
        }
    }
}
