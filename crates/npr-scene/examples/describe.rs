//! Says what is in each file named on the command line, and what is ignored.
//!
//! `cargo run --example describe -- hero.glb house.obj`

use std::path::Path;

use npr_scene::{LoadOptions, Scene, load};

fn main() {
    for name in std::env::args().skip(1) {
        match load(Path::new(&name), &LoadOptions::default()) {
            Ok(scene) => describe(&name, &scene),
            Err(fault) => println!("{name}: {fault}"),
        }
    }
}

fn describe(name: &str, scene: &Scene) {
    println!(
        "{name}: {} bytes, {} nodes",
        scene.file_bytes,
        scene.nodes.len()
    );
    println!(
        "  {} triangles, {} vertices",
        scene.triangle_count(),
        scene.vertex_count()
    );
    if let Some((low, high)) = scene.bounds_world() {
        println!("  from {low:?} to {high:?}");
    }
    for material in &scene.materials {
        println!("  material '{}' {:?}", material.name, material.base_color);
    }
    for image in &scene.images {
        println!(
            "  image '{}' {} x {} px",
            image.name, image.width, image.height
        );
    }
    for notice in &scene.notices {
        println!("  {notice}");
    }
}
