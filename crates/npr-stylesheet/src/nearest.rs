//! Finds the valid word that is most like a mistyped one.

/// Longest word that is compared, in bytes.
const COMPARED_MAX: usize = 64;

/// Fewest bytes that the beginning of a candidate must have to stand for it.
const BEGINNING_MIN: usize = 3;

/// The candidate with the fewest typing slips from `word`, if at most a third of its letters differ.
///
/// Slips are those of Damerau: an added, missing or wrong letter, or two swapped ones. Where no candidate is near,
/// their beginnings up to a `-` or `_` are compared: `comc` finds `comic-silver`. Among equals the first wins.
pub(crate) fn nearest<'a>(
    word: &str,
    candidates: impl Iterator<Item = &'a str>,
) -> Option<&'a str> {
    if word.len() > COMPARED_MAX {
        return None;
    }
    let candidates: Vec<&str> = candidates.collect();
    let whole = candidates.iter().map(|candidate| (*candidate, *candidate));
    let beginnings = candidates.iter().flat_map(|candidate| {
        let ends = candidate.match_indices(['-', '_']).map(|(end, _)| end);
        let ends = ends.filter(|end| *end >= BEGINNING_MIN);
        ends.map(move |end| (&candidate[..end], *candidate))
    });
    nearest_of(word, whole).or_else(|| nearest_of(word, beginnings))
}

/// The candidate whose name has the fewest slips from `word`; `named` holds pairs of name and candidate.
fn nearest_of<'a>(word: &str, named: impl Iterator<Item = (&'a str, &'a str)>) -> Option<&'a str> {
    let allowed = (word.chars().count() / 3).max(1);
    named
        .map(|(name, meant)| (strsim::osa_distance(word, name), meant))
        .filter(|(slips, _)| *slips <= allowed)
        .min_by_key(|(slips, _)| *slips)
        .map(|(_, meant)| meant)
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

    #[test]
    fn a_beginning_stands_for_the_whole_where_nothing_whole_is_near() {
        let presets = ["ink", "comic-silver", "comic-modern", "cel-2", "comet"];
        let of = |word: &str| nearest(word, presets.into_iter());
        assert_eq!(of("comc"), Some("comic-silver"));
        assert_eq!(of("comik-modern"), Some("comic-modern"));
        assert_eq!(of("comte"), Some("comet"));
        assert_eq!(of("cle"), Some("cel-2"));
        assert_eq!(of("banana"), None);
    }
}
