//! What tests need beside the checkout, and which of them do without: shared assets, graphics devices, cases by
//! chance.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::{Result, bail};

use crate::packages::members;
use crate::source::{Function, SourceFile, rust_files, starts};

/// The folder beside the checkout, as helpers of tests name it.
const BESIDE: &str = "shared/assets";

/// The project's own samples, likewise.
const OWN: &str = "join(\"assets\")";

/// How tests may not come by a device: only `npr_gpu::device::testing` opens one and knows whether one is required.
const DEVICE: [&str; 2] = ["Device::open(", "hardware::open("];
const REQUIREMENT: &str = "NPR_REQUIRE_GPU";

/// Fails with every test that opens a device by itself.
pub fn check_devices(root: &Path) -> Result<()> {
    let mut faults = Vec::new();
    for package in members(root)?
        .iter()
        .filter(|package| package.name != "xtask")
    {
        for file in rust_files(package.folder())? {
            let fault = |name| format!("{}: {}, {name}", package.name, file.path.display());
            faults.extend(own_devices(&file).into_iter().map(fault));
        }
    }
    if !faults.is_empty() {
        bail!(
            "tests open devices outside of npr_gpu::device::testing:\n  {}",
            faults.join("\n  ")
        );
    }
    println!("devices: every test asks one function for them");
    Ok(())
}

/// The functions of a file's tests that open a device, or ask for themselves whether one is required.
fn own_devices(file: &SourceFile) -> Vec<String> {
    // Cut out the tests of the file.
    let is_of_tests = file.path.starts_with("tests") || file.path.ends_with("tests.rs");
    let tests = match is_of_tests {
        true => Some(file.text.as_str()),
        false => file
            .text
            .split_once("#[cfg(test)]\nmod tests")
            .map(|(_, tests)| tests),
    };
    let tests = SourceFile {
        path: file.path.clone(),
        text: tests.unwrap_or_default().to_owned(),
    };

    // Name the functions that open a device themselves.
    let opens = |f: &Function| {
        f.text.contains(REQUIREMENT)
            || DEVICE
                .iter()
                .any(|call| starts(&f.code, call).next().is_some())
    };
    tests
        .functions()
        .into_iter()
        .filter(opens)
        .map(|f| f.name)
        .collect()
}

/// Names of the tests among a package's files that do nothing without the assets beside the checkout.
///
/// A function leans on them where it names their folder or calls one of its package that does, and on the project's
/// own samples likewise; whoever has those does something without the others.
pub fn tests_on_shared_assets(files: &[SourceFile]) -> BTreeSet<String> {
    let functions: Vec<(usize, Function)> = (0..files.len())
        .flat_map(|file| files[file].functions().into_iter().map(move |f| (file, f)))
        .collect();
    let shared = leaning(&functions, BESIDE);
    let own = leaning(&functions, OWN);
    let needs = |index: &usize| functions[*index].1.is_test && !own.contains(index);
    let needing = shared.iter().filter(|index| needs(index));
    needing
        .map(|index| functions[*index].1.name.clone())
        .collect()
}

/// The functions that hold a text in quotes, and those that call them.
fn leaning(functions: &[(usize, Function)], text: &str) -> BTreeSet<usize> {
    let holds = |index: &usize| functions[*index].1.text.contains(text);
    let mut found: BTreeSet<usize> = (0..functions.len()).filter(holds).collect();
    loop {
        let calls = |index: &usize| {
            let mut helpers = found.iter().filter(|helper| !functions[**helper].1.is_test);
            helpers.any(|helper| helper != index && reaches(functions, *index, *helper))
        };
        let more: Vec<usize> = (0..functions.len())
            .filter(|index| !found.contains(index))
            .filter(calls)
            .collect();
        if more.is_empty() {
            return found;
        }
        found.extend(more);
    }
}

/// Whether one function calls another by name, which another file's function may have too: the nearest one is meant.
fn reaches(functions: &[(usize, Function)], caller: usize, helper: usize) -> bool {
    let ((from, caller), (to, helper)) = (&functions[caller], &functions[helper]);
    let call = format!("{}(", helper.name);
    let is_called =
        starts(&caller.code, &call).any(|at| !caller.code[..at].ends_with('.') && at > 0);
    let has_its_own = || {
        let mut others = functions.iter();
        others.any(|(file, f)| file == from && f.name == helper.name)
    };
    is_called && (from == to || !has_its_own())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::file;

    #[test]
    fn what_leans_on_shared_assets_alone_is_found_through_its_helpers() {
        let helpers = "fn models() { x(\"../shared/assets/models\") }\nfn asset() { root().join(\"assets\") }\n\
                       fn both() { models(); asset() }\n";
        let tests = "fn figure() { models() }\n#[test]\nfn far() { figure() }\n#[test]\nfn near() { asset() }\n\
                     #[test]\nfn either() { both() }\n#[test]\nfn none() { x.models() }\n";
        let other = "fn models() {}\n#[test]\nfn of_its_own() { models() }\n";
        let files = [
            file("src/files.rs", helpers),
            file("tests/a.rs", tests),
            file("tests/b.rs", other),
        ];
        let found: Vec<String> = tests_on_shared_assets(&files).into_iter().collect();
        assert_eq!(found, ["far"]);
    }

    #[test]
    fn a_device_opened_by_a_test_itself_is_found() {
        let text = "fn open() { Device::open(Any) }";
        assert!(own_devices(&file("src/device.rs", text)).is_empty());
        assert_eq!(own_devices(&file("tests/device/shared.rs", text)), ["open"]);
        let inside = format!("fn a() {{}}\n#[cfg(test)]\nmod tests {{\n{text}\n}}\n");
        assert_eq!(own_devices(&file("src/engine.rs", &inside)), ["open"]);
        let asks = format!("fn is_required() {{ var(\"{REQUIREMENT}\") }}");
        assert_eq!(own_devices(&file("tests/a.rs", &asks)), ["is_required"]);
    }
}
