//! Pictures with layers: OpenEXR files, read back by the crate that others read them with.

use crate::workplace::Workplace;
use exr::image::FlatSamples;
use exr::meta::attribute::AttributeValue;
use exr::prelude::{ReadChannels, ReadLayers, Text, read};
use npr_core::color::{SrgbEncoder, premultiplied_light};
use std::collections::BTreeMap;
use std::io::Cursor;

/// Two triangles in objects of their own, one beside the other.
const PAIR: &[u8] = b"o Left\nv -2 0 0\nv -0.5 0 0\nv -2 2 0\nf 1 2 3\n\
    o Right\nv 0.5 0 0\nv 2 0 0\nv 2 2 0\nf 4 5 6\n";

const SIZE: [usize; 2] = [48, 32];

/// A file of layers: its channels by name, and the names of objects.
struct Layers {
    channels: BTreeMap<String, FlatSamples>,
    objects: BTreeMap<String, String>,
}

impl Layers {
    fn read(bytes: &[u8]) -> Self {
        let image = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels();
        let image = image.first_valid_layer().all_attributes().non_parallel();
        let image = image
            .from_buffered(Cursor::new(bytes))
            .expect("a sound file");
        let layer = image.layer_data;
        assert_eq!([layer.size.0, layer.size.1], SIZE);
        let objects = &layer.attributes.other[&Text::from("objects")];
        let AttributeValue::Text(objects) = objects else {
            panic!("{objects:?}");
        };
        let channels = layer.channel_data.list.into_iter();
        Self {
            channels: channels
                .map(|channel| (channel.name.to_string(), channel.sample_data))
                .collect(),
            objects: serde_json::from_slice(objects.as_slice()).expect("JSON"),
        }
    }

    fn channel(&self, name: &str) -> Vec<f32> {
        self.channels[name].values_as_f32().collect()
    }

    fn colors(&self, names: [&str; 4]) -> Vec<[f32; 4]> {
        let channels = names.map(|name| self.channel(name));
        let pixels = 0..channels[0].len();
        pixels
            .map(|at| [0, 1, 2, 3].map(|i| channels[i][at]))
            .collect()
    }

    fn beauty(&self) -> Vec<[f32; 4]> {
        self.colors(["R", "G", "B", "A"])
    }

    fn lines(&self) -> Vec<[f32; 4]> {
        self.colors(["line.R", "line.G", "line.B", "line.A"])
    }
}

fn place() -> Workplace {
    let place = Workplace::new();
    place.put("pair.obj", PAIR);
    place
}

/// The layers of the pair with more arguments, and its picture without them, as premultiplied light.
fn drawn(place: &Workplace, more: &[&str]) -> (Layers, Vec<[f32; 4]>) {
    for name in ["pair.exr", "pair.png"] {
        let outcome = place.render("pair.obj", &[&["-o", name][..], more].concat());
        outcome.assert_silent_success();
    }
    let png = image::load_from_memory(&place.get("pair.png")).expect("a picture");
    let light = |pixel: &image::Rgba<u8>| premultiplied_light(pixel.0);
    let png = png.into_rgba8().pixels().map(light).collect();
    (Layers::read(&place.get("pair.exr")), png)
}

/// Whether two colours are the same sRGB bytes with the same alpha, within 1.
fn is_alike(a: &[f32; 4], b: &[f32; 4]) -> bool {
    let encoder = SrgbEncoder::new();
    let apart = |i: usize| encoder.byte(a[i]).abs_diff(encoder.byte(b[i])) <= 1;
    (0..3).all(apart) && (a[3] - b[3]).abs() < 1.0 / 255.0
}

#[test]
fn a_file_of_layers_holds_the_picture_and_what_it_is_made_of() {
    let place = place();
    let (layers, png) = drawn(&place, &[]);
    let names: Vec<&str> = layers.channels.keys().map(String::as_str).collect();
    let wanted = [
        "A",
        "B",
        "G",
        "R",
        "depth.Z",
        "id.line",
        "id.object",
        "line.A",
        "line.B",
        "line.G",
        "line.R",
        "line_depth.Z",
        "normal.X",
        "normal.Y",
        "normal.Z",
        "uv.U",
        "uv.V",
    ];
    assert_eq!(names, wanted);
    for (name, samples) in &layers.channels {
        let is_half = matches!(samples, FlatSamples::F16(_));
        let is_color = name.len() == 1 || name.starts_with("line.");
        assert_eq!(is_half, is_color, "{name}");
    }
    assert!(
        layers
            .beauty()
            .iter()
            .zip(&png)
            .all(|(a, b)| is_alike(a, b))
    );

    // Surfaces have depth, normal and object together, and nothing else has any.
    let normals = ["normal.X", "normal.Y", "normal.Z"].map(|name| layers.channel(name));
    let (depths, objects) = (layers.channel("depth.Z"), layers.channel("id.object"));
    for at in 0..depths.len() {
        let normal = [0, 1, 2].map(|i| normals[i][at]);
        match objects[at] == 0.0 {
            true => assert_eq!((depths[at], normal), (1e10, [0.0; 3])),
            false => {
                assert!((1.0..100.0).contains(&depths[at]));
                // Both triangles lie across the z axis.
                assert!(normal[2] > 0.999, "{normal:?}");
            }
        }
    }

    // Lines have ids and depths where they have ink.
    let (lines, ids) = (layers.lines(), layers.channel("id.line"));
    let depths = layers.channel("line_depth.Z");
    let is_far = |depth: &f32| *depth == 1e10;
    assert!(
        ids.iter()
            .zip(&depths)
            .all(|(id, depth)| (*id == 0.0) == is_far(depth))
    );
    assert!(
        depths
            .iter()
            .all(|depth| is_far(depth) || (1.0..100.0).contains(depth))
    );
    assert!(
        lines
            .iter()
            .zip(&ids)
            .all(|(line, id)| (line[3] > 0.0) == (*id > 0.0))
    );
    assert!(ids.iter().filter(|id| **id > 0.0).count() > 20);
}

#[test]
fn objects_have_the_names_that_info_tells() {
    let place = place();
    let (layers, _) = drawn(&place, &[]);
    let info = place.npr(&["info", "pair.obj", "--json"]);
    let info: serde_json::Value = serde_json::from_str(info.text()).expect("JSON");
    let told = info["drawn"].as_array().expect("a list");
    let mut told: Vec<&str> = told
        .iter()
        .filter_map(|part| part["object"].as_str())
        .collect();
    told.sort();
    let mut names: Vec<&str> = layers.objects.values().map(String::as_str).collect();
    names.sort();
    assert_eq!(names, told);
    assert_eq!(names, ["Left", "Right"]);

    // From three quarters, the left one is seen in the left half of the picture.
    let of = |name: &str| {
        let found = layers.objects.iter().find(|(_, other)| *other == name);
        found
            .expect("its number")
            .0
            .parse::<f32>()
            .expect("a number")
    };
    let objects = layers.channel("id.object");
    let columns = |name: &str| -> Vec<usize> {
        let number = of(name);
        let places = (0..objects.len()).filter(|at| objects[*at] == number);
        places.map(|at| at % SIZE[0]).collect()
    };
    let (left, right) = (columns("Left"), columns("Right"));
    assert!(left.len() > 20 && right.len() > 20);
    assert!(left.iter().max() < right.iter().min());
}

#[test]
fn a_transparent_picture_is_premultiplied() {
    let place = place();
    let (layers, png) = drawn(&place, &["--background", "transparent"]);
    let beauty = layers.beauty();
    assert!(beauty.iter().zip(&png).all(|(a, b)| is_alike(a, b)));
    assert!(beauty.contains(&[0.0; 4]));
    assert!(beauty.iter().any(|pixel| pixel[3] > 0.1 && pixel[3] < 0.9));
}

/// What a compositing program does: lines over the picture without them.
#[test]
fn lines_over_the_picture_without_lines_are_the_picture() {
    let place = place();
    let (layers, png) = drawn(
        &place,
        &[
            "--set",
            "line.color=#204080",
            "--set",
            "line.width.base=4px",
        ],
    );
    let (_, bare) = drawn(&place, &["--set", "line.method=none"]);
    for ((line, below), want) in layers.lines().iter().zip(&bare).zip(&png) {
        let over = [0, 1, 2, 3].map(|i| line[i] + below[i] * (1.0 - line[3]));
        assert!(is_alike(&over, want), "{over:?} for {want:?}");
    }
    assert!(layers.lines().iter().any(|line| line[3] > 0.9));
}

#[test]
fn layers_are_the_same_bytes_with_any_number_of_threads() {
    let place = place();
    let file = |threads: &str| {
        let arguments = [
            "render",
            "pair.obj",
            "--size",
            "200x150",
            "-o",
            "pair.exr",
            "--backend",
            "cpu",
        ];
        let mut command = place.command(&arguments);
        let done = command.env("RAYON_NUM_THREADS", threads).status();
        assert!(done.expect("the command starts").success());
        place.get("pair.exr")
    };
    let one = file("1");
    assert!(one.starts_with(b"\x76\x2f\x31\x01"));
    assert!(one == file("4"));
}

#[test]
fn a_device_writes_layers_too() {
    let place = Workplace::with_scene();
    place.assert_done_or_no_device(&["render", "scene.obj", "--size", "48x32", "-o", "out.exr"]);
}

#[test]
fn layers_beyond_the_memory_limit_exit_with_5() {
    let place = place();
    let layers = |limit| {
        let arguments = [
            "render",
            "pair.obj",
            "--size",
            "400x300",
            "-o",
            "pair.exr",
            "--memory-limit",
            limit,
            "--backend",
            "cpu",
        ];
        place.npr(&arguments)
    };
    layers("16M").assert_fault(5, "--memory-limit");
    assert_eq!(place.names(), ["pair.obj"]);
    layers("64M").assert_silent_success();
}

#[test]
fn what_layers_lack_is_a_warning() {
    let place = place();
    let outcome = place.render(
        "pair.obj",
        &["-o", "pair.exr", "--set", "line.method=angle"],
    );
    assert_eq!(outcome.code, Some(0));
    assert_eq!(
        outcome.stderr.matches("lines of method angle").count(),
        1,
        "{}",
        outcome.stderr
    );
    let outcome = place.render(
        "pair.obj",
        &["-o", "pair.png", "--set", "line.method=angle"],
    );
    assert!(!outcome.stderr.contains("layer"), "{}", outcome.stderr);
}

#[test]
fn other_formats_and_other_commands_have_no_layers() {
    let place = Workplace::with_scene();
    let refused: [(&[&str], &str); 3] = [
        (
            &["render", "scene.obj", "-o", "out.tif"],
            "'out.tif': pictures are written as .png, or as .exr with layers",
        ),
        (
            &["smoke", "puff", "-o", "out.exr"],
            "pictures are written as .png only",
        ),
        (&["lines", "scene.obj", "-o", "out.exr"], "out.exr"),
    ];
    place.assert_refused(&refused);
    // Standard output has a picture alone.
    let outcome = place.render("scene.obj", &["-o", "-"]);
    assert!(outcome.stdout.starts_with(b"\x89PNG"));
}
