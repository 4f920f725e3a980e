//! The project's own commands: `cargo xtask COMMAND`.
//!
//! Builds in seconds, because nothing here links the renderer: what needs it is left to cargo.

mod alone;
mod assets;
mod ci;
mod circles;
mod constants;
mod coverage;
mod decoders;
mod examples;
mod file;
mod floors;
mod gallery;
mod harness;
mod licences;
mod measure;
mod names;
mod packages;
mod passes;
mod programs;
mod snapshots;
mod source;
#[cfg(test)]
mod spelling;
mod suite;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Result;

/// What `cargo xtask` answers when it is asked for nothing it knows.
const USAGE: &str = "\
usage: cargo xtask COMMAND

  test [ARGS]       run every test of the workspace; ARGS go to cargo test
  test --quick      run the unit tests of crates that differ from the last commit, or of every crate where none does
  properties        run half of the property tests with a seed drawn from the commit
  ci                run what must pass before a change is handed in
  assets [--check]  write the sample models, or only compare them
  floors            check that imports go down and stay light
  circles           check that modules import each other in one direction
  constants         check that constants of shaders are those of Rust
  coverage          check docs/coverage.toml and print counts
  devices           check that tests come by devices in one way
  decoders          check that decoders of others are called behind one door
  examples          run the examples that draw; NPR_REQUIRE_GPU=1 runs those that need a device
  measure lines [ARGS]
                    measure line drawings, in release, and keep the tables; ARGS go to the
                    measuring program: --models DIR, --peers DIR, --only NAME, --quick
  measure sights [ARGS]
                    measure sampled sights against exact ones, in release, and keep the tables
  measure comic     measure comic pictures, in release, and keep the tables
  measure smoke     measure cartoon smoke, in release, and keep the tables
  measure outline-colour
                    measure outlines before backgrounds, in release, and keep the tables
  measure dashes [ARGS]
                    count dashes in pictures of lines, in release, and keep the tables of the usual style;
                    ARGS: --preset NAME, --set KEY=VALUE
  measure motion [ARGS]
                    measure how still lines lie while cameras and figures move, and what measure ink does, in release,
                    and keep the tables; ARGS: --models DIR, --only NAME, --quick, --pictures DIR
  measure ink [ARGS]
                    measure how much ink of hatching and brushes changes without cause while cameras and figures move,
                    in release, and keep the tables; ARGS as above
  measure device [ARGS]
                    count what a frame asks of a graphics device, in release, predict its time on cards, and keep the
                    tables of the usual frame; ARGS: --model FILE, --ball TRIANGLES, --preset NAME, --size WxH
  measure viewers   measure how much files of lines differ from frames in resvg, Chromium and Inkscape, and keep the
                    tables
  measure view      measure how fast the picture of the window follows the hand, in release, and keep the table
  measure mtoon     measure how far figures in the preset mtoon are from those of three-vrm, and keep the table
                    and pictures
  measure trace     measure tracings beside potrace, vtracer and OpenCV, in release, and keep the tables
  gallery [PRESETS] draw every preset, or those named, on the shared models into target/gallery
  licences          check that everything that is linked may be linked by everybody
  names             check that no file names a machine, no line is too wide, and every crate has a README
  passes            write docs/passes.md, the list of passes, from their declarations
  snapshots bless FILTER
                    make what is drawn now the reference, for names that hold FILTER";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let Some(outcome) = dispatch(&root(), &words) else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the command that `words` spell, or returns nothing where they spell none.
fn dispatch(root: &Path, words: &[&str]) -> Option<Result<()>> {
    Some(match words {
        ["test", "--quick"] => suite::quick(root),
        ["test", rest @ ..] => suite::run(root, rest),
        ["properties"] => suite::again(root),
        ["ci"] => ci::run(root),
        ["assets"] => assets::write(&root.join("assets")),
        ["assets", "--check"] => assets::check(&root.join("assets")),
        ["floors"] => floors::check(root),
        ["circles"] => circles::check(root),
        ["constants"] => constants::check(root),
        ["coverage"] => coverage::check(root),
        ["devices"] => harness::check_devices(root),
        ["decoders"] => decoders::check(root),
        ["examples"] => examples::run(root),
        ["measure", "lines", rest @ ..] => measure::lines(root, rest),
        ["measure", "sights", rest @ ..] => measure::sights(root, rest),
        ["measure", "comic"] => measure::comic(root),
        ["measure", "smoke"] => measure::smoke(root),
        ["measure", "outline-colour"] => measure::outline_color(root),
        ["measure", "dashes", rest @ ..] => measure::dashes(root, rest),
        ["measure", "motion", rest @ ..] => measure::motion(root, rest),
        ["measure", "ink", rest @ ..] => measure::ink(root, rest),
        ["measure", "device", rest @ ..] => measure::device(root, rest),
        ["measure", "viewers"] => measure::viewers(root),
        ["measure", "view"] => measure::view(root),
        ["measure", "mtoon"] => measure::mtoon(root),
        ["measure", "trace"] => measure::trace(root),
        ["gallery", presets @ ..] => gallery::draw(root, presets),
        ["passes"] => passes::write(root),
        ["licences"] => licences::check(root),
        ["names"] => names::check(root),
        ["snapshots", "bless", filter] => snapshots::bless(root, filter),
        _ => return None,
    })
}

/// The root of the workspace.
fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_path_buf()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_words_are_bad_usage() {
        assert!(dispatch(&root(), &[]).is_none());
        assert!(dispatch(&root(), &["floor"]).is_none());
        assert!(dispatch(&root(), &["floors", "now"]).is_none());
    }
}
