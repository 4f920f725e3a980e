//! `cargo xtask licences`: everything that is linked may be linked by everybody.

use std::path::Path;

use anyhow::{Result, bail};
use serde::Deserialize;
use spdx::{Expression, ParseMode};

use crate::packages::{cargo, output};

/// Licences that ask for no more than a notice.
const ALLOWED: [&str; 11] = [
    "0BSD",
    "Apache-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Zlib",
];

/// Licences of fonts, which let any program hold the font and ask for a notice then, and the packages that hold some.
/// Only a changed font would have to be given away under the same licence and another name.
const FONTS: ([&str; 2], [&str; 1]) = (["OFL-1.1", "Ubuntu-font-1.0"], ["epaint_default_fonts"]);

/// The part of a package in `cargo metadata` that is read.
#[derive(Deserialize)]
struct Licensed {
    name: String,
    /// An SPDX expression.
    license: Option<String>,
}

/// Fails with every package of the lock file whose licence is not one of those that ask for no more than a notice.
pub fn check(root: &Path) -> Result<()> {
    /// The packages of `cargo metadata`.
    #[derive(Deserialize)]
    struct Metadata {
        packages: Vec<Licensed>,
    }
    let text = output(cargo(root).args(["metadata", "--format-version", "1", "--all-features"]))?;
    let packages = serde_json::from_str::<Metadata>(&text)?.packages;
    let faults: Vec<String> = packages.iter().filter_map(fault).collect();
    if !faults.is_empty() {
        bail!(
            "licences that ask for more than a notice:\n  {}",
            faults.join("\n  ")
        );
    }
    println!(
        "licences: {} packages ask for no more than a notice",
        packages.len()
    );
    Ok(())
}

/// What is wrong with a package's licence.
fn fault(package: &Licensed) -> Option<String> {
    let licence = package.license.as_deref().unwrap_or("none");
    let is_allowed = Expression::parse_mode(licence, ParseMode::LAX).is_ok_and(|expression| {
        expression.evaluate(|asked| {
            let name = asked.license.id().map(|id| id.name);
            let (fonts, holders) = FONTS;
            let is_font = |name: &str| fonts.contains(&name) && holders.contains(&&*package.name);
            name.is_some_and(|name| ALLOWED.contains(&name) || is_font(name))
        })
    });
    (!is_allowed).then(|| format!("{}: {licence}", package.name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_of_several_licences_is_enough_and_each_of_all_must_be_allowed() {
        let is_fault = |licence: Option<&str>| {
            let license = licence.map(str::to_owned);
            let name = "a".to_owned();
            fault(&Licensed { name, license }).is_some()
        };
        assert!(!is_fault(Some("MIT OR GPL-3.0-only")));
        assert!(!is_fault(Some("MIT/Apache-2.0")));
        assert!(!is_fault(Some("(MIT OR Apache-2.0) AND Unicode-3.0")));
        assert!(is_fault(Some("MIT AND GPL-3.0-only")));
        assert!(is_fault(Some("who knows")));
        assert!(is_fault(None));
    }

    #[test]
    fn licences_of_fonts_are_for_the_packages_that_hold_them() {
        let is_fault = |name: &str, licence: &str| {
            let (name, license) = (name.to_owned(), Some(licence.to_owned()));
            fault(&Licensed { name, license }).is_some()
        };
        assert!(!is_fault("epaint_default_fonts", "MIT AND OFL-1.1"));
        assert!(is_fault("epaint_default_fonts", "MIT AND GPL-3.0-only"));
        assert!(is_fault("a", "MIT AND OFL-1.1"));
    }
}
