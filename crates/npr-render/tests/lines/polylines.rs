//! Lines that files have as geometry.

use crate::scenes::{SIZE, camera_at, drawing_from, even_style, model_of};
use npr_gpu::processor::Processor;
use npr_render::{
    Drawing, Kind, KindSet, LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource,
    Model, RenderError, Renderer, RendererOptions,
};
use npr_scene::testing::lines_glb;
use npr_scene::{Limits, MemoryResources, Scene, load_bytes};
use npr_stylesheet::Style;
use npr_vector::stroke::Stroke;

const EYE: [f32; 3] = [0.4, 1.0, 6.0];

fn load(bytes: &[u8]) -> Scene {
    let resources = MemoryResources::default();
    load_bytes("test", bytes, None, &resources, &Limits::default()).expect("a sound file")
}

/// A wall across the middle, a loop on it, a strip that goes through it, and three lines that meet before it.
fn drawing_board() -> Scene {
    let positions = [
        [-1.0, -1.0, 0.0],
        [1.0, -1.0, 0.0],
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
        // The loop.
        [-0.5, -0.5, 0.0],
        [0.1, -0.5, 0.0],
        [0.1, 0.3, 0.0],
        [-0.5, 0.3, 0.0],
        // The strip.
        [0.5, 0.0, 1.0],
        [0.5, 0.1, 0.2],
        [0.5, 0.2, -0.8],
        [0.5, 2.0, -0.8],
        // The three.
        [-0.2, 1.4, 0.3],
        [-0.8, 1.4, 0.3],
        [0.0, 1.9, 0.3],
        [0.0, 1.1, 0.3],
    ];
    let wall = [[0, 1, 2], [0, 2, 3]];
    let lines: [(u32, &[u32]); 3] = [
        (2, &[4, 5, 6, 7]),
        (3, &[8, 9, 10, 11]),
        (1, &[12, 13, 12, 14, 12, 15]),
    ];
    load(&lines_glb(&positions, &wall, &lines))
}

fn marked(drawing: &Drawing) -> Vec<&Stroke> {
    let strokes = drawing.strokes.iter();
    strokes
        .filter(|stroke| stroke.kind == Kind::Marked)
        .collect()
}

fn with(method: LineSource) -> LineOptions {
    LineOptions {
        method,
        ..LineOptions::new(SIZE)
    }
}

#[test]
fn lines_are_linked_seen_and_hidden_among_surfaces() {
    let drawing = drawing_from(&drawing_board(), EYE);
    let found = marked(&drawing);
    let closed: Vec<_> = found.iter().filter(|stroke| stroke.closed).collect();
    // The loop lies exactly on the wall.
    assert_eq!(closed.len(), 1);
    assert_eq!(closed[0].points.len(), 4);
    // The strip shows before the wall and above it; the three end where they meet.
    let open: Vec<[[f32; 3]; 2]> = found
        .iter()
        .filter(|stroke| !stroke.closed)
        .map(|stroke| {
            [
                stroke.points[0].world,
                stroke.points[stroke.points.len() - 1].world,
            ]
        })
        .collect();
    assert_eq!(open.len(), 5, "{open:?}");
    let meets = |ends: &&[[f32; 3]; 2]| ends.contains(&[-0.2, 1.4, 0.3]);
    assert_eq!(open.iter().filter(meets).count(), 3);
    let strip: Vec<_> = open
        .iter()
        .filter(|ends| ends.iter().all(|end| end[0] == 0.5))
        .collect();
    let lowest = strip
        .iter()
        .flat_map(|ends| ends.map(|end| end[2]))
        .fold(f32::MAX, f32::min);
    assert_eq!((strip.len(), lowest), (2, -0.8));
    let at_wall = strip.iter().flat_map(|ends| ends.iter());
    assert!(
        at_wall.clone().any(|end| end[2].abs() < 1e-3),
        "it ends in the wall"
    );
}

#[test]
fn hidden_parts_come_when_asked_for() {
    let options = LineOptions {
        hidden: true,
        smooth: false,
        ..LineOptions::new(SIZE)
    };
    let model = model_of(&drawing_board());
    let drawing = model
        .draw(&camera_at(EYE), &Style::default(), &options)
        .expect("drawn");
    let hidden = marked(&drawing)
        .into_iter()
        .filter(|stroke| !stroke.is_visible());
    assert_eq!(
        hidden.map(|stroke| stroke.occluders).collect::<Vec<_>>(),
        [1]
    );
}

#[test]
fn every_method_draws_them_in_the_width_of_the_style_whatever_kinds_are_asked_for() {
    let model = model_of(&drawing_board());
    let mut lengths = Vec::new();
    for method in [
        LineSource::Edges,
        LineSource::Surface,
        LineSource::Image,
        LineSource::Potrace,
    ] {
        let options = LineOptions {
            kinds: KindSet::from_iter([Kind::Marked]),
            ..with(method)
        };
        let drawing = model
            .draw(&camera_at(EYE), &even_style("3px"), &options)
            .expect("drawn");
        assert_eq!(marked(&drawing).len(), drawing.strokes.len());
        let points = || drawing.strokes.iter().flat_map(|stroke| &stroke.points);
        assert!(
            points().all(|point| (point.width - 3.0).abs() < 1e-4),
            "{method:?}"
        );
        let length: f64 = drawing.strokes.iter().map(Stroke::length).sum();
        lengths.push(length);
    }
    // The published path goes around pixels, and loses what is short.
    let published = lengths.pop().unwrap_or_default();
    assert!(
        lengths.iter().all(|length| *length == lengths[0]),
        "{lengths:?}"
    );
    let share = published / lengths[0];
    assert!((0.5..1.1).contains(&share), "{published} of {}", lengths[0]);
}

#[test]
fn a_rule_chooses_their_look_and_whether_they_are_drawn() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\no card\nf 1 2 3\no string\nusemtl red\nv 0 0 1\nv 1 0 1\nv 0 1 1\nl 4 5 6\n";
    let model = model_of(&load(text.as_bytes()));
    let mut style = even_style("2px");
    let mut set = |rule: &str| {
        let text = format!("[[rule]]\nmatch = {{ material = \"red\" }}\n{rule}\n");
        style.rule = Style::from_toml(&text, &|_| Err(String::new()))
            .expect("a rule")
            .rule;
        let drawing = model
            .draw(&camera_at(EYE), &style, &LineOptions::new(SIZE))
            .expect("drawn");
        let found: Vec<(f64, [u8; 4])> = marked(&drawing)
            .iter()
            .map(|stroke| {
                let surface = &drawing.surfaces[stroke.surface as usize];
                assert_eq!(
                    (surface.object.as_str(), surface.material.as_str()),
                    ("string", "red")
                );
                (stroke.points[0].width, surface.line_color)
            })
            .collect();
        found
    };
    let found = set("line = { width_factor = 2.0, color = \"#ff0000\" }");
    assert_eq!(found, [(4.0, [255, 0, 0, 255])]);
    assert_eq!(set("line = { on = false }"), []);
}

#[test]
fn colors_follow_vertices_and_light_as_on_surfaces() {
    let text = "v -1 0 0 1 0 0\nv 1 0 0 0 0 1\nl 1 2\n";
    let scene = load(text.as_bytes());
    let mut style = even_style("2px");
    style
        .set("line.paint.source=vertex-color")
        .expect("a source");
    style.set("line.paint.factor=1").expect("a factor");
    let model = model_of(&scene);
    let options = LineOptions {
        smooth: false,
        ..LineOptions::new(SIZE)
    };
    let drawing = model
        .draw(&camera_at(EYE), &style, &options)
        .expect("drawn");
    let colors: Vec<[u8; 4]> = drawing.strokes[0]
        .points
        .iter()
        .filter_map(|p| p.color)
        .collect();
    assert!(colors.len() > 10, "{} points", colors.len());
    let (first, last) = (colors[0], colors[colors.len() - 1]);
    assert!(
        first[0] > 200 && first[2] < 50 && last[0] < 50 && last[2] > 200,
        "{first:?} {last:?}"
    );
}

/// A file of lines alone, framed and drawn.
#[test]
fn lines_without_surfaces_draw_and_frame_as_pictures_do() {
    let text: String = (0..60)
        .map(|i| {
            let angle = f64::from(i) * 0.3;
            let (x, y) = (
                npr_core::math::cos_f64(angle),
                npr_core::math::sin_f64(angle),
            );
            format!("v {x} {y} {}\n", 0.05 * f64::from(i))
        })
        .collect();
    let list: String = (1..=60).map(|i| format!(" {i}")).collect();
    let scene = load(format!("{text}l{list}\n").as_bytes());
    let (lines, picture) = (model_of(&scene), Model::new(&scene).expect("small"));
    assert_eq!(lines.framing(1.6, 0.5), picture.framing(1.6, 0.5));
    assert_eq!(lines.bounds(), picture.bounds());
    let camera = lines.framing(1.6, 0.5);
    for method in [
        LineSource::Edges,
        LineSource::Surface,
        LineSource::Image,
        LineSource::Potrace,
    ] {
        let drawing = lines
            .draw(&camera, &even_style("2px"), &with(method))
            .expect("drawn");
        let length: f64 = drawing.strokes.iter().map(Stroke::length).sum();
        assert!(length > 500.0, "{method:?}: {length} px");
        if method == LineSource::Edges {
            assert_eq!(drawing.strokes.len(), 1);
        }
    }
}

#[test]
fn frames_draw_them_as_curves_and_tell_where_they_cannot() {
    let scene = drawing_board();
    let model = Model::new(&scene).expect("small");
    let lines = model_of(&scene);
    // Of the lines' own: what a frame of the wall alone does not ink.
    let mut bare = scene.clone();
    bare.meshes[0]
        .parts
        .iter_mut()
        .for_each(|part| part.segments.clear());
    let bare_lines = model_of(&bare);
    for (method, is_drawn) in [
        ("strokes", true),
        ("potrace", true),
        ("shape", false),
        ("hull", false),
    ] {
        let mut style = even_style("3px");
        style
            .set(&format!("line.method={method}"))
            .expect("a method");
        let drawn = |lines| {
            let of_model = (&model, LineRenderer::new(&Processor, lines));
            let options = RendererOptions::new(SIZE);
            let mut renderer =
                Renderer::with_lines(&Processor, of_model, &style, &options).expect("small");
            renderer.draw(&camera_at(EYE)).expect("drawn")
        };
        let (with, without) = (drawn(&lines), drawn(&bare_lines));
        let pairs = with.rgba.chunks(4).zip(without.rgba.chunks(4));
        let inked = pairs.filter(|(a, b)| a != b).count();
        assert_eq!(inked > 300, is_drawn, "{method}: {inked} pixels");
        let reported = with
            .notices
            .iter()
            .any(|notice| notice.contains("only line.method strokes"));
        assert_eq!(reported, !is_drawn, "{method}: {:?}", with.notices);
    }
}

/// Normals of surfaces do not depend on whether lines lie beside them.
#[test]
fn lines_change_nothing_about_surfaces() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
    let with_line = format!("{text}v 0 0 1\nl 4 1 2\n");
    let renderer = |text: &str| {
        let scene = load(text.as_bytes());
        let model = Model::new(&scene).expect("small");
        let mut style = Style::default();
        style.set("line.method=none").expect("a method");
        let mut renderer =
            Renderer::new(&Processor, &model, &style, &RendererOptions::new(SIZE)).expect("small");
        let frame = renderer.draw(&camera_at(EYE)).expect("drawn");
        frame.rgba
    };
    assert!(renderer(text) == renderer(&with_line));
}

#[test]
fn kept_surfaces_keep_their_lines() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = drawing_board();
    let options = LineModelOptions::default();
    let made = LineModel::cached(&scene, &options, folder.path()).expect("small");
    let kept = LineModel::cached(&scene, &options, folder.path()).expect("small");
    assert_eq!(made.shape(), kept.shape());
    assert_eq!(made.shape().polylines.len(), 10);
    let mut other = scene.clone();
    other.meshes[0].parts[1].segments.pop();
    let other = LineModel::cached(&other, &options, folder.path()).expect("small");
    assert_eq!(other.shape().polylines.len(), 9);
}

#[test]
fn memory_for_lines_is_asked_for() {
    let text = "v 0 0 0\nv 1 0 0\n".to_owned() + &"l 1 2\n".repeat(20_000);
    let scene = load(text.as_bytes());
    let options = LineModelOptions {
        memory_limit: 1 << 20,
        ..LineModelOptions::default()
    };
    let fault = LineModel::new(&scene, &options).expect_err("no room");
    assert!(matches!(fault, RenderError::Memory(_)), "{fault}");
    // One line, stored twenty thousand times.
    assert_eq!(model_of(&scene).shape().polylines.len(), 1);
}
