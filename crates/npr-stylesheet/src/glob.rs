//! Name patterns with `*`, `?` and `|`.

/// Whether `name` matches `pattern`, letter for letter.
///
/// `*` stands for any run of characters, also none, and `?` for exactly one. `|` parts patterns of which one has to
/// match. There is no escape: `?` matches a `|` in a name. Time is O(name * pattern) at worst and linear for patterns
/// with one `*`; no recursion.
pub fn matches(pattern: &str, name: &str) -> bool {
    pattern.split('|').any(|pattern| matches_one(pattern, name))
}

/// Whether `name` matches a pattern without `|`.
fn matches_one(pattern: &str, name: &str) -> bool {
    let (mut pattern, mut name) = (pattern.chars(), name.chars());
    let mut retry: Option<(std::str::Chars<'_>, std::str::Chars<'_>)> = None;
    loop {
        let at_star = pattern.clone();
        match (pattern.next(), name.clone().next()) {
            (None, None) => return true,
            (Some('*'), _) => {
                // Let the star take nothing first; after a mismatch it takes one character more.
                retry = Some((at_star, name.clone()));
                continue;
            }
            (Some(wanted), Some(found)) if wanted == '?' || wanted == found => {
                name.next();
                continue;
            }
            _ => {}
        }
        let Some((star, mut rest)) = retry.take() else {
            return false;
        };
        if rest.next().is_none() {
            return false;
        }
        (pattern, name) = (star, rest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn stars_and_question_marks() {
        for (pattern, name) in [
            ("*", ""),
            ("Skin*", "Skin_arm"),
            ("*_L", "Hand_L"),
            ("h?r", "här"),
            ("a*b*c", "aXbYbc"),
            ("**", "x"),
            ("*Face*|face*", "face_01"),
            ("*Face*|face*", "F00_Face"),
            ("|x", ""),
        ] {
            assert!(matches(pattern, name), "{pattern} against {name}");
        }
        for (pattern, name) in [
            ("", "x"),
            ("skin*", "Skin"),
            ("?", ""),
            ("a*b", "ab1"),
            ("a?", "a"),
            ("*Face*|face*", "Surface"),
            ("a|b", "a|b"),
        ] {
            assert!(!matches(pattern, name), "{pattern} against {name}");
        }
    }

    /// The definition, by recursion.
    fn oracle(pattern: &[char], name: &[char]) -> bool {
        match (pattern.split_first(), name.split_first()) {
            (None, _) => name.is_empty(),
            (Some(('*', rest)), _) => (0..=name.len()).any(|taken| oracle(rest, &name[taken..])),
            (Some((wanted, rest)), Some((found, after))) => {
                (*wanted == '?' || wanted == found) && oracle(rest, after)
            }
            (Some(_), None) => false,
        }
    }

    proptest! {
        #[test]
        fn agrees_with_the_definition(pattern in "[ab*?|]{0,8}", name in "[ab|]{0,10}") {
            let chars = |text: &str| text.chars().collect::<Vec<_>>();
            let expected = pattern.split('|').any(|pattern| oracle(&chars(pattern), &chars(&name)));
            prop_assert_eq!(matches(&pattern, &name), expected);
        }

        #[test]
        fn every_name_matches_itself_and_a_star(name in "[^*?|]{0,20}") {
            prop_assert!(matches(&name, &name));
            prop_assert!(matches("*", &name));
        }
    }
}
