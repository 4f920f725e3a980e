//! Notices: what was ignored or mended while loading.

use std::collections::BTreeSet;
use std::fmt;

/// More notices than this are counted, not kept, so that a broken file cannot flood its reader.
const NOTICE_LIMIT: usize = 64;

/// One short sentence about something that was ignored or mended, and why.
///
/// Lower case and without a full stop, ready to follow `npr: warning: `.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Notice {
    /// The sentence.
    pub text: String,
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// Notices in the order in which they first came up, each once.
#[derive(Debug, Default)]
pub(crate) struct Notices {
    seen: BTreeSet<String>,
    kept: Vec<Notice>,
    has_more: bool,
}

impl Notices {
    /// Notes `text` unless it was noted before.
    pub(crate) fn add(&mut self, text: impl Into<String>) {
        let text = text.into();
        if self.seen.contains(&text) {
            return;
        }
        if self.kept.len() >= NOTICE_LIMIT {
            self.has_more = true;
            return;
        }
        self.seen.insert(text.clone());
        self.kept.push(Notice { text });
    }

    /// Whether a notice holds `text`; of a full list nobody asks.
    pub(crate) fn tell_of(&self, text: &str) -> bool {
        let is_open = self.kept.len() < NOTICE_LIMIT;
        is_open && self.kept.iter().any(|notice| notice.text.contains(text))
    }

    /// The notices, with a last one that says so if some were left out.
    pub(crate) fn into_list(mut self) -> Vec<Notice> {
        if self.has_more {
            self.kept.push(Notice {
                text: "more was ignored or mended than is listed here".to_owned(),
            });
        }
        self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repeated_notice_is_kept_once_and_order_is_that_of_arrival() {
        let mut notices = Notices::default();
        for text in ["b", "a", "b"] {
            notices.add(text);
        }
        let texts: Vec<_> = notices
            .into_list()
            .into_iter()
            .map(|notice| notice.text)
            .collect();
        assert_eq!(texts, ["b", "a"]);
    }

    #[test]
    fn a_flood_ends_in_one_closing_notice() {
        let mut notices = Notices::default();
        (0..10_000).for_each(|i| notices.add(format!("fault {i}")));
        let list = notices.into_list();
        assert_eq!(list.len(), NOTICE_LIMIT + 1);
    }
}
