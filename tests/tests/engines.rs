//! The same pictures from both engines.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use npr_gpu::processor::Processor;
use npr_render::Model;
use npr_style::Style;
use npr_tests::{Agreement, device, draw_on, models, models_camera, samples};
use std::path::Path;

/// Draws a file in presets on both engines and answers with how far they agree.
fn agreements(path: &Path, presets: &[&str], size: [u32; 2]) -> Vec<(String, Agreement)> {
    let Some(device) = device() else {
        return Vec::new();
    };
    let scene = npr_scene::load(path, &npr_scene::LoadOptions::default()).unwrap();
    let model = Model::new(&scene).unwrap();
    let camera = models_camera(&model, size);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let of_preset = |preset: &&str| {
        let style = Style::preset(preset).unwrap();
        let one = draw_on(&Processor, &model, &style, &camera, size);
        let two = draw_on(device, &model, &style, &camera, size);
        if let Ok(folder) = std::env::var("NPR_DUMP") {
            npr_tests::write_png(Path::new(&format!("{folder}/{name}.{preset}.cpu.png")), &one).unwrap();
            npr_tests::write_png(Path::new(&format!("{folder}/{name}.{preset}.gpu.png")), &two).unwrap();
        }
        (format!("{name} {preset}"), Agreement::between(&one, &two, 2))
    };
    presets.iter().map(of_preset).collect()
}

#[test]
fn models_look_alike_on_both_engines() {
    let mut failed = Vec::new();
    for path in samples().into_iter().chain(models()) {
        let start = std::time::Instant::now();
        for (what, agreement) in agreements(&path, &["toon", "ink"], [480, 270]) {
            println!("{what:45} {agreement} {:?}", start.elapsed());
            if !agreement.holds() { failed.push(what); }
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}
