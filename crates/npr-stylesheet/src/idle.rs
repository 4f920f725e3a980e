//! The notices about keys of a style that have no effect, each with the reason.

mod case;
mod table;

pub use case::{Facts, LineForm, LineOutput, Occasion, Output};

use crate::Stated;
use crate::former::notice;
use crate::key::lies_in;
use case::Case;
use table::{Why, entries};

/// Longest notice, in characters. With the command's own prefix it fits on one line of standard error.
const NOTICE_LENGTH: usize = 270;

impl Stated {
    /// The notices about stated keys: those given under former names, and those that have no effect on an occasion. A
    /// key without effect is named once, together with others that have the same reason.
    ///
    /// ```
    /// use npr_stylesheet::{Facts, Occasion, Output, Stated};
    ///
    /// let mut stated = Stated::default();
    /// stated.set_all(&["line.method=hull", "detect.scale=2"])?;
    /// let occasion = Occasion { output: Output::Frame, scene: Facts::ALL };
    /// let told = stated.notices(&occasion);
    /// assert_eq!(told, ["'detect.scale' is ignored: lines of method hull do not use it"]);
    /// # Ok::<(), npr_stylesheet::StyleError>(())
    /// ```
    pub fn notices(&self, occasion: &Occasion) -> Vec<String> {
        // Group the keys that cannot act by the reason.
        let mut groups: Vec<(String, Vec<&str>)> = Vec::new();
        for key in self.keys() {
            let Some(why) = self.idle_reason(key, occasion) else {
                continue;
            };
            match groups.iter_mut().find(|(reason, _)| *reason == why) {
                Some((_, keys)) => keys.push(key),
                None => groups.push((why, vec![key])),
            }
        }

        // Write a sentence for each former name, then for each group.
        let by = match occasion.output {
            Output::Frame => "",
            Output::Lines(_) => " by npr lines",
        };
        let former = self.former().iter().map(|former| notice(former));
        let idle = groups.iter();
        former
            .chain(idle.flat_map(|(why, keys)| sentences(keys, by, why)))
            .collect()
    }

    /// The reason why a key of the style has no effect on an occasion; `None` where it has an effect.
    pub fn idle_reason(&self, key: &str, occasion: &Occasion) -> Option<String> {
        let case = Case::new(self.style(), key, occasion);
        let entry = entries().find(|entry| {
            let is_meant = entry.keys.iter().any(|pattern| covers(pattern, case.key));
            is_meant && (entry.is_idle)(&case)
        })?;
        Some(match entry.why {
            Why::Told(why) => why.to_owned(),
            Why::Methods => case.methods_reason(),
        })
    }
}

/// Whether a pattern covers a key. It covers the key of its name and all keys within that table or list; where it ends
/// in `*`, it covers all keys that begin with what stands before.
fn covers(pattern: &str, key: &str) -> bool {
    match pattern.strip_suffix('*') {
        Some(beginning) => key.starts_with(beginning),
        None => lies_in(key, pattern),
    }
}

/// The notices that name all keys with one reason, as few as their greatest length allows.
fn sentences(keys: &[&str], by: &str, why: &str) -> Vec<String> {
    let mut reported = Vec::new();
    let mut rest = keys;
    while !rest.is_empty() {
        let fits =
            |count: &usize| sentence(&rest[..*count], by, why).chars().count() <= NOTICE_LENGTH;
        let count = (1..=rest.len()).take_while(fits).last().unwrap_or(1);
        reported.push(sentence(&rest[..count], by, why));
        rest = &rest[count..];
    }
    reported
}

fn sentence(keys: &[&str], by: &str, why: &str) -> String {
    let quoted: Vec<String> = keys.iter().map(|key| format!("'{key}'")).collect();
    match quoted.as_slice() {
        [all @ .., last] if !all.is_empty() => {
            format!("{} and {last} are ignored{by}: {why}", all.join(", "))
        }
        _ => format!("{} is ignored{by}: {why}", quoted.concat()),
    }
}

#[cfg(test)]
mod tests;
