//! The same creases in frames and in drawings.

use crate::scenes::{SIZE, add, camera_at, even_style};
use npr_core::crease::CreaseFrom;
use npr_core::math;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{cylinder, unindexed};
use npr_render::{
    Kind, LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource, Model, Renderer,
    RendererOptions,
};
use npr_scene::{Mesh, Node, Part, Scene};
use npr_stylesheet::Style;

/// A pillar of eight sides that a file shades as round: smooth around, broken at its rims.
fn pillar(has_normals: bool) -> Scene {
    let mesh = unindexed(&cylinder(8, 1));
    let flat = npr_mesh::testing::flat_normals(mesh.positions(), mesh.triangles()).into_flattened();
    let normal = |([x, y, _], flat): (&[f32; 3], [f32; 3])| {
        let length = x.hypot(*y);
        if flat[2].abs() > 0.5 {
            flat
        } else {
            [x / length, y / length, 0.0]
        }
    };
    let normals = mesh.positions().iter().zip(flat).map(normal).collect();
    Scene {
        meshes: vec![Mesh {
            parts: vec![Part {
                positions: mesh.positions().to_vec(),
                triangles: mesh.triangles().to_vec(),
                normals: has_normals.then_some(normals),
                ..Part::default()
            }],
            ..Mesh::default()
        }],
        nodes: vec![Node {
            name: "pillar".to_owned(),
            mesh: Some(0),
            ..Node::default()
        }],
        ..Scene::default()
    }
}

/// Length of creases that a drawing shows inside the outline.
fn drawn(scene: &Scene, style: &Style, method: LineSource) -> f64 {
    let model = LineModel::new(scene, &LineModelOptions::default()).expect("small");
    let options = LineOptions {
        method,
        ..LineOptions::of_style(style, SIZE)
    };
    let drawing = model
        .draw(&camera_at([6.0, 0.4, 0.0]), style, &options)
        .expect("drawn");
    let creases = drawing
        .strokes
        .iter()
        .filter(|stroke| stroke.kind == Kind::Crease);
    creases.map(|stroke| stroke.length()).sum()
}

/// Ink of a frame in the middle of the pillar, away from its rims and its outline.
fn ink_inside(scene: &Scene, style: &Style) -> usize {
    let model = Model::new(scene).expect("small");
    let lines = LineModel::for_style(scene, style, &LineModelOptions::default(), None);
    let lines = lines.expect("small");
    let options = RendererOptions::new(SIZE);
    let of_model = (&model, LineRenderer::new(&Processor, &lines));
    let mut renderer =
        Renderer::with_lines(&Processor, of_model, style, &options).expect("prepared");
    let frame = renderer.draw(&camera_at([6.0, 0.4, 0.0])).expect("drawn");
    let [width, height] = SIZE.map(|side| side as usize);
    let middle = (0..width * height)
        .filter(|i| (i % width).abs_diff(width / 2) < 24 && (i / width).abs_diff(height / 2) < 20);
    middle.filter(|i| frame.rgba[4 * i] < 100).count()
}

fn style(method: &str, from: &str) -> Style {
    let mut style = even_style("2px");
    for assignment in [
        format!("line.method={method}"),
        format!("line.crease_from={from}"),
        "line.color=\"#000000\"".to_owned(),
        "shade.mode=paper".to_owned(),
        "shade.paper=\"#ffffff\"".to_owned(),
        "shade.ramp=[{ at = 0.0, light = 1.0 }]".to_owned(),
    ] {
        style.set(&assignment).expect(&assignment);
    }
    style
}

#[test]
fn smooth_shading_has_no_folds_by_any_method() {
    let pillar = pillar(true);
    for method in [
        LineSource::Edges,
        LineSource::Surface,
        LineSource::Potrace,
        LineSource::Image,
    ] {
        let by_normals = drawn(&pillar, &style("shape", "normals"), method);
        let by_faces = drawn(&pillar, &style("shape", "faces"), method);
        assert!(
            by_faces > by_normals + 60.0,
            "{method:?}: {by_faces} and {by_normals} px"
        );
    }
    for method in ["shape", "strokes", "potrace", "filter"] {
        assert_eq!(
            ink_inside(&pillar, &style(method, "normals")),
            0,
            "{method}"
        );
        assert!(
            ink_inside(&pillar, &style(method, "faces")) > 20,
            "{method}"
        );
    }
}

#[test]
fn without_normals_every_fold_over_the_angle_is_drawn() {
    let pillar = pillar(false);
    for from in ["normals", "faces"] {
        assert!(
            drawn(&pillar, &style("shape", from), LineSource::Edges) > 60.0,
            "{from}"
        );
        for method in ["shape", "strokes"] {
            assert!(
                ink_inside(&pillar, &style(method, from)) > 20,
                "{method} {from}"
            );
        }
    }
    assert_eq!(LineOptions::new(SIZE).crease_from, CreaseFrom::Normals);
}

/// A ridge of three pieces along x, seen from above, whose sides hang down by angles in degrees at its four stations:
/// a piece folds by the sum of its two.
fn ridge(angles_deg: [f32; 4]) -> Scene {
    let stations = angles_deg.iter().zip([-4.5, -1.5, 1.5, 4.5]);
    let rows = stations.flat_map(|(angle, x)| {
        let angle = angle.to_radians();
        let down = -math::sin(angle) / math::cos(angle);
        [[x, -1.0, down], [x, 0.0, 0.0], [x, 1.0, down]]
    });
    let corners = (0..3).flat_map(|piece| [3 * piece, 3 * piece + 1]);
    let triangles = corners.flat_map(|corner| {
        [
            [corner, corner + 3, corner + 1],
            [corner + 1, corner + 3, corner + 4],
        ]
    });
    let mesh = npr_mesh::Mesh::new(rows.collect(), triangles.collect()).expect("sound");
    let mut scene = Scene::default();
    add(&mut scene, "ridge", &mesh);
    scene
}

const ABOVE: [f32; 3] = [0.0, 0.0, 12.0];

/// A white picture of creases and of the border around them.
fn creases_alone(settings: &[&str]) -> Style {
    let mut style = style("strokes", "normals");
    let kinds = ["contour", "material", "intersection"];
    let off = kinds.map(|kind| format!("line.kinds.{kind}=false"));
    let all = off
        .iter()
        .map(String::as_str)
        .chain(settings.iter().copied());
    all.chain(["background=#ffffff"])
        .for_each(|setting| style.set(setting).expect(setting));
    style
}

/// The lengths of the creases that a drawing shows, and the pixels of ink of a frame away from the border.
fn shown(scene: &Scene, settings: &[&str]) -> (Vec<f64>, usize) {
    let style = creases_alone(settings);
    let options = LineOptions::of_style(&style, SIZE);
    let lines = LineModel::new(scene, &LineModelOptions::default()).expect("small");
    let drawing = lines
        .draw(&camera_at(ABOVE), &style, &options)
        .expect("drawn");
    let model = Model::new(scene).expect("small");
    let of_model = (&model, LineRenderer::new(&Processor, &lines));
    let options = RendererOptions::new(SIZE);
    let mut renderer =
        Renderer::with_lines(&Processor, of_model, &style, &options).expect("prepared");
    let frame = renderer.draw(&camera_at(ABOVE)).expect("drawn");
    let pixels = frame.rgba.chunks_exact(4).enumerate();
    let [width, height] = SIZE.map(|side| side as usize);
    let ink = pixels.filter(|(i, pixel)| {
        let [x, y] = [i % width, i / width];
        pixel[0] < 100 && x.abs_diff(width / 2) < 95 && y.abs_diff(height / 2) < 12
    });
    let creases = drawing
        .strokes
        .iter()
        .filter(|stroke| stroke.kind == Kind::Crease);
    (creases.map(|stroke| stroke.length()).collect(), ink.count())
}

#[test]
fn a_crease_goes_on_along_a_softer_fold_between_two() {
    let ridge = ridge([25.0, 25.0, 8.0, 42.0]);
    let (apart, ink_apart) = shown(&ridge, &["line.crease_slack_deg=0"]);
    let (joined, ink_joined) = shown(&ridge, &["line.crease_slack_deg=15"]);
    assert!(
        apart.len() == 2 && joined.len() == 1,
        "{apart:?} {joined:?}"
    );
    let share = apart.iter().sum::<f64>() / joined[0];
    assert!((0.6..0.73).contains(&share), "{share}");
    let ink_share = ink_apart as f64 / ink_joined as f64;
    assert!((0.6..0.75).contains(&ink_share), "{ink_share}");
}

#[test]
fn a_short_crease_in_the_open_is_left_out() {
    // Without slack only the middle of the ridge is a crease, which ends away from the border.
    let ridge = ridge([8.0, 25.0, 25.0, 8.0]);
    let of_middle = |least: &[&str]| shown(&ridge, &[&["line.crease_slack_deg=0"], least].concat());
    let (whole, ink) = of_middle(&["line.crease_least=0", "line.least=0"]);
    let [length] = whole[..] else {
        panic!("{whole:?}");
    };
    assert!(ink as f64 > length);
    for key in ["line.crease_least", "line.least"] {
        let others = ["line.crease_least=0", "line.least=0"];
        let least = |px: f64| of_middle(&[&others[..], &[&format!("{key}='{px}px'")]].concat());
        assert_eq!(least(1.1 * length), (vec![], 0), "{key}");
        assert_eq!(least(0.9 * length), (whole.clone(), ink), "{key}");
    }
}

/// A roof of two sides that a file shades as smooth: rounded off along the middle, or folded sharply by an angle.
fn roof(profile: &[[f32; 2]]) -> Scene {
    let rows = [-6.0, -2.0, 2.0, 6.0].into_iter();
    let rows = rows.flat_map(|x| profile.iter().map(move |[y, z]| [x, *y, *z]));
    let count = profile.len() as u32;
    let corners = (0..3).flat_map(|row| (0..count - 1).map(move |i| row * count + i));
    let triangles = corners.flat_map(|a| {
        let [b, c, d] = [a + 1, a + count, a + count + 1];
        [[a, c, b], [b, c, d]]
    });
    let mesh = npr_mesh::Mesh::new(rows.collect(), triangles.collect()).expect("sound");
    let weld = npr_mesh::weld(mesh.positions(), 0.0);
    let smooth = npr_mesh::smooth_normals(mesh.positions(), mesh.triangles(), &weld);
    let mut scene = Scene::default();
    add(&mut scene, "roof", &mesh);
    scene.meshes[0].parts[0].normals = Some(weld.spread(&smooth));
    scene
}

#[test]
fn a_rounded_edge_is_a_line_unless_the_style_leaves_it_to_tones() {
    // A quarter of a turn within 0.03, where the scene's radius is some 6.
    let at = |deg: f32| {
        let angle = deg.to_radians();
        [0.02 * math::sin(angle), 0.02 * (math::cos(angle) - 1.0)]
    };
    let arc = [-45.0, -15.0, 15.0, 45.0].map(at);
    let round = roof(&[&[[-1.0, -1.0]], &arc[..], &[[1.0, -1.0]]].concat());
    let (lengths, ink) = shown(&round, &[]);
    let [length] = lengths[..] else {
        panic!("{lengths:?}");
    };
    assert!(ink as f64 > 150.0 && length > 250.0, "{ink} {length}");
    assert_eq!(shown(&round, &["line.crease_round=0"]), (vec![], 0));
}

#[test]
fn a_hard_fold_is_a_line_however_smooth_its_normals() {
    let fold = roof(&[[-1.0, -1.0], [0.0, 0.0], [1.0, -1.0]]);
    let (lengths, ink) = shown(&fold, &[]);
    assert!(lengths.len() == 1 && ink > 150, "{lengths:?} {ink}");
    let off = ["line.crease_hard_deg=91", "line.crease_hard_deg=180"];
    for off in off {
        assert_eq!(
            shown(&fold, &[off, "line.crease_round=0"]),
            (vec![], 0),
            "{off}"
        );
    }
}
