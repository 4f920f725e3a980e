//! Small pictures that must stay as they are, one issue each, exact on the processor.
//!
//! `cargo xtask snapshots bless <filter>` renews those whose name contains the filter, and names what it changes.

use npr_mesh::testing::{icosphere, torus};
use npr_render::Frame;
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{
    Agreement, Object, asset, crossing_boxes, draw, lines, read_png, scene_of, write_png,
};
use std::path::{Path, PathBuf};

/// Pixels across and down.
const SIZE: [u32; 2] = [160, 100];

/// Largest file, in bytes.
const LARGEST_BYTES: u64 = 16_000;

/// Draws a scene in a style with settings, unless blessing something else, and compares.
fn check(name: &str, scene: &Scene, style: Style, settings: &[&str]) {
    let mut style = style;
    for setting in settings {
        style.set(setting).unwrap();
    }
    compare(name, &draw(scene, &style, SIZE));
}

/// Compares a picture with its reference, or makes it the reference where `NPR_BLESS` asks for that.
fn compare(name: &str, drawn: &Frame) {
    let path = reference(name);
    let known = read_png(&path).filter(|known| known.size == drawn.size);
    let difference = known.map(|known| Agreement::between(&known, drawn, 0));
    let same = difference.is_some_and(|difference| difference.within == 1.0);
    let wanted = std::env::var("NPR_BLESS")
        .ok()
        .filter(|filter| name.contains(filter.as_str()));
    if wanted.is_some() && !same {
        write_png(&path, drawn).unwrap();
        println!(
            "blessed {name}{}",
            difference.map_or_else(|| ", which is new".to_owned(), |d| format!(": {d}"))
        );
        return;
    }
    let difference =
        difference.unwrap_or_else(|| panic!("there is no snapshot {name} of this size"));
    if !same {
        let beside = std::env::temp_dir().join(format!("{name}.png"));
        write_png(&beside, drawn).unwrap();
        panic!(
            "{name} changed: {difference}; drawn now: {}",
            beside.display()
        );
    }
    assert!(
        path.metadata().unwrap().len() < LARGEST_BYTES,
        "{name} is too large a file"
    );
}

fn reference(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("snapshots")
        .join(format!("{name}.png"))
}

fn preset(name: &str) -> Style {
    Style::preset(name).unwrap()
}

fn ring() -> Scene {
    scene_of(&[Object::new("Ring", torus(48, 24, 0.7, 0.3)).colored([0.8, 0.25, 0.1])])
}

#[test]
fn toon_ring() {
    check("toon_ring", &ring(), preset("toon"), &[]);
}

#[test]
fn ink_ring() {
    check("ink_ring", &ring(), preset("ink"), &["line.width.base=12"]);
}

#[test]
fn technical_crossing() {
    check(
        "technical_crossing",
        &crossing_boxes(),
        preset("technical"),
        &["line.width.base=10"],
    );
}

#[test]
fn crossing_without_intersections() {
    check(
        "crossing_without_intersections",
        &crossing_boxes(),
        lines("shape"),
        &["line.kinds.intersection=false"],
    );
}

#[test]
fn soft_tones() {
    check(
        "soft_tones",
        &ring(),
        preset("toon"),
        &["shade.softness=0.2", "line.method=none"],
    );
}

#[test]
fn okuya_ball_shows_its_edges_at_a_coarse_mask() {
    let ball = scene_of(&[Object::new("Ball", icosphere(3))]);
    check(
        "okuya_ball_coarse_mask",
        &ball,
        lines("okuya"),
        &["detect.scale=4"],
    );
}

#[test]
fn shape_ball_stays_clean_at_a_coarse_mask() {
    let ball = scene_of(&[Object::new("Ball", icosphere(3))]);
    check(
        "shape_ball_coarse_mask",
        &ball,
        lines("shape"),
        &["detect.scale=4"],
    );
}

#[test]
fn hull_teapot() {
    check(
        "hull_teapot",
        &asset("teapot_box_plane.glb"),
        preset("hull"),
        &[],
    );
}

#[test]
fn filter_teapot() {
    check(
        "filter_teapot",
        &asset("teapot_box_plane.glb"),
        preset("filter"),
        &["detect.plane_depth=true"],
    );
}

#[test]
fn toon_teapot() {
    check(
        "toon_teapot",
        &asset("teapot_box_plane.glb"),
        preset("toon"),
        &["line.width.base=8"],
    );
}

#[test]
fn surface_angle_ring() {
    check(
        "surface_angle_ring",
        &ring(),
        lines("angle"),
        &["line.angle_threshold_deg=25"],
    );
}

#[test]
fn transparent_background() {
    check(
        "transparent_background",
        &ring(),
        preset("toon"),
        &["background=transparent"],
    );
}

#[test]
fn toon_still_life() {
    check(
        "toon_still_life",
        &asset("still_life.glb"),
        preset("toon"),
        &["line.width.base=6"],
    );
}
