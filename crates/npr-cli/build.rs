//! Links the command so that it starts fast: as long as a start takes, small bitmaps are traced
//! (benches/results/trace.md).

use std::env::var;
use std::path::PathBuf;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let target = |what: &str| var(format!("CARGO_CFG_TARGET_{what}")).unwrap_or_default();
    if target("OS") != "linux" || target("ENV") != "gnu" || target("ARCH") != "x86_64" {
        return;
    }
    // At a fixed address nothing needs to be relocated at every start.
    println!("cargo::rustc-link-arg-bins=-no-pie");
    // The library that unwinds asks the processor what it is as it is loaded, which takes long in virtual machines. A
    // part of the command, it does not.
    if let Some(folder) = unwinder_folder() {
        println!("cargo::rustc-link-search=native={}", folder.display());
        println!("cargo::rustc-link-lib=static:-bundle=gcc_eh");
    }
}

/// Where the C compiler of this machine has the unwinder as a static library; none where it has none, or builds for
/// another machine.
fn unwinder_folder() -> Option<PathBuf> {
    if var("HOST").ok()? != var("TARGET").ok()? {
        return None;
    }
    let mut compiler = Command::new("cc");
    compiler.arg("-print-file-name=libgcc_eh.a");
    let output = compiler.output().ok()?;
    let path = PathBuf::from(String::from_utf8(output.stdout).ok()?.trim());
    // Without it, the compiler gives the bare name.
    path.parent()
        .filter(|_| path.is_absolute() && path.is_file())
        .map(PathBuf::from)
}
