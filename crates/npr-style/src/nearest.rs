//! The valid word that a mistyped one was meant to be.

/// Longest word that is compared; nobody mistypes more.
const COMPARED_MAX: usize = 64;

/// The candidate with the fewest typing slips from `word`, if at most a third of its letters differ.
///
/// Slips are those of Damerau: a letter more, less, wrong, or two swapped. Among equals the first wins.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl Iterator<Item = &'a str>,
) -> Option<&'a str> {
    if word.len() > COMPARED_MAX {
        return None;
    }
    let allowed = (word.chars().count() / 3).max(1);
    candidates
        .map(|candidate| (strsim::osa_distance(word, candidate), candidate))
        .filter(|(slips, _)| *slips <= allowed)
        .min_by_key(|(slips, _)| *slips)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_forgiven_and_other_words_are_not() {
        let keys = ["width", "kinds", "color"];
        assert_eq!(nearest("widht", keys.into_iter()), Some("width"));
        assert_eq!(nearest("colour", keys.into_iter()), Some("color"));
        assert_eq!(nearest("banana", keys.into_iter()), None);
    }
}
