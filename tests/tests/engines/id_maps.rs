//! Rules by id maps: every method of outline, every sort of rule, borders, slips.

mod figure;
mod fixture;
mod regions;
mod slips;

use fixture::{SIZE, cut, frames, front, halves, inked, scene, style, with_map};
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{cube, icosphere, mapped};
use npr_render::{
    Kind, LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource, Model,
    RendererOptions, Smoke, Sphere,
};
use npr_tests::{Ink, device, placed};

/// Methods that a frame's lines may have, but for `rim`, which takes its colours from the surface.
const METHODS: [&str; 9] = [
    "shape",
    "okuya",
    "edges",
    "filter",
    "hull",
    "filter+hull",
    "angle",
    "strokes",
    "potrace",
];

/// Lines of the left region are red.
const RED_LEFT: &str = "[[rule]]\nmatch.id = 'left'\nline.color = '#ff0000'";

#[test]
fn every_method_of_outline_follows_ids() {
    let rules = format!("{RED_LEFT}\n[[rule]]\nmatch.id = 'right'\nline.width_factor = 0.5");
    let mut failed = Vec::new();
    // The published path draws all lines into one picture: a stroke looks as most of it does.
    for method in METHODS.into_iter().filter(|method| *method != "potrace") {
        let style = with_map(method, "", &rules);
        let scene = cut(scene("Ball", icosphere(4)), &style, &halves());
        for frame in frames(&scene, &style, &RendererOptions::new(SIZE), &front()) {
            let [red, black] = inked(&frame);
            // Half an outline each: 190 pixels long, 3 wide on the left and thinner on the right. Triangles across
            // the middle, and their lines, belong to one side.
            let is_even = ["angle", "filter"].contains(&method);
            let holds = red[0] > 200 && red[1] < 40 && black[1] > 100 && black[0] < 40;
            if !holds || (!is_even && red[0] * 2 < black[1] * 3) {
                failed.push(format!("{method}: red {red:?}, black {black:?}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn methods_and_lines_themselves_are_chosen_by_id() {
    for (rule, wanted) in [
        ("line.on = false", [true, false]),
        ("line.method = 'none'", [true, false]),
        ("line.method = 'hull'", [true, true]),
        ("line.method = 'strokes'", [true, true]),
    ] {
        let style = with_map("shape", "", &format!("[[rule]]\nmatch.id = '#00f'\n{rule}"));
        let scene = cut(scene("Ball", icosphere(4)), &style, &halves());
        for frame in frames(&scene, &style, &RendererOptions::new(SIZE), &front()) {
            let [_, black] = inked(&frame);
            assert_eq!(black.map(|count| count > 150), wanted, "{rule}: {black:?}");
        }
    }
}

#[test]
fn tones_and_hatching_follow_ids() {
    let rules = "[[rule]]\nmatch.id = 'left'\nshade.color = '#ff0000'\n\
        [[rule]]\nmatch.id = 'right'\nink.tone = 'hatch'\nink.dark_at = 0\nink.light_at = 1";
    let mut style = with_map("none", "", rules);
    style.shade.mode = npr_stylesheet::ShadeMode::Ramp;
    let scene = cut(scene("Ball", icosphere(4)), &style, &halves());
    for frame in frames(&scene, &style, &RendererOptions::new(SIZE), &front()) {
        let [red, black] = inked(&frame);
        assert!(red[0] > 3000 && red[1] < 300, "red {red:?}");
        assert!(black[1] > 300 && black[0] < 100, "black {black:?}");
    }
}

#[test]
fn backgrounds_are_minded_by_id() {
    let rules = "[[rule]]\nmatch.id = 'left'\nline.background.method = 'contrast'";
    for method in ["shape", "filter", "hull", "rim"] {
        let mut style = with_map(method, "", rules);
        style.set("background=#000000").unwrap();
        style.set("shade.paper=#404040").unwrap();
        let scene = cut(scene("Ball", icosphere(4)), &style, &halves());
        for frame in frames(&scene, &style, &RendererOptions::new(SIZE), &front()) {
            // The outline crosses the middle row at 60 and 180: lighter there on the left, black before black on the
            // right.
            let at = |x: u32| frame.rgba[((90 * SIZE[0] + x) * 4) as usize];
            let line = |columns: std::ops::Range<u32>| columns.map(at).collect::<Vec<_>>();
            let (left, right) = (line(54..66), line(174..186));
            // Neither the background's 0 nor the surface's 64, and more than the frayed edge of a line.
            let lifted = |row: &[u8]| row.iter().filter(|v| (36..62).contains(*v)).count();
            let sum = |row: &[u8]| row.iter().map(|v| u32::from(*v)).sum::<u32>();
            let holds = lifted(&left) >= 1 && lifted(&right) <= 1 && sum(&left) > sum(&right) + 30;
            assert!(holds, "{method}: {left:?} {right:?}");
        }
    }
}

#[test]
fn ids_count_beside_smoke() {
    let style = with_map("shape", "", RED_LEFT);
    let scene = cut(scene("Ball", icosphere(4)), &style, &halves());
    // Before the upper left of the ball.
    let options = RendererOptions {
        smoke: Some(Smoke {
            spheres: vec![Sphere::new([-0.7, 0.7, 1.5], 0.4)],
            space: None,
        }),
        ..RendererOptions::new(SIZE)
    };
    for frame in frames(&scene, &style, &options, &front()) {
        let [red, black] = inked(&frame);
        assert!((100..500).contains(&red[0]) && red[1] < 40, "{red:?}");
        assert!(black[1] > 200, "{black:?}");
    }
}

/// Cut up where no rule cares, a ball and a box have the lines they had, a crease through the middle of the box's
/// face included.
#[test]
fn regions_alone_move_no_line() {
    // A roof: its ridge, blunter than a crease, is where ids meet.
    let roof = mapped(&cube(), |[x, y, z]| [x, y * (1.0 + 0.2 * x), z]);
    let folded = mapped(&npr_mesh::testing::plane(2, 8), |[x, y, _]| {
        [x * 2.0 - 1.0, y * 2.0 - 1.0, -0.25 * (x * 2.0 - 1.0).abs()]
    });
    let meshes = [
        ("Ball", icosphere(3)),
        ("Roof", placed(&roof, [0.5; 3], [0.1, 0.0, 0.0])),
        ("Fold", folded),
    ];
    let mut failed = Vec::new();
    for (name, mesh) in meshes {
        for method in METHODS {
            let style = with_map(method, "", "");
            let whole = scene(name, mesh.clone());
            let pieces = cut(whole.clone(), &style, &halves());
            assert!(pieces.meshes[0].parts.len() > 1, "{name}");
            let options = RendererOptions::new(SIZE);
            let [whole, pieces] =
                [whole, pieces].map(|scene| frames(&scene, &style, &options, &front()).remove(0));
            let pixels = |frame: &npr_render::Frame| frame.rgba.as_chunks::<4>().0.to_vec();
            let (a, b) = (pixels(&whole), pixels(&pieces));
            let differ = a
                .iter()
                .zip(&b)
                .filter(|(a, b)| a[0].abs_diff(b[0]) > 2)
                .count();
            // Curves end where surfaces do, so that one that went round in a ring is smoothed a little otherwise.
            let [a, b] = [Ink::of(&whole), Ink::of(&pieces)];
            let strayed = a.without(&b.grown(1)).count() + b.without(&a.grown(1)).count();
            let is_curve = ["strokes", "potrace"].contains(&method);
            if if is_curve { strayed > 4 } else { differ > 0 } {
                failed.push(format!(
                    "{name}, {method}: {differ} pixels, {strayed} strayed"
                ));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

#[test]
fn pieces_are_welded_again() {
    let style = with_map("shape", "", "");
    let whole = scene("Ball", icosphere(4));
    let pieces = cut(whole.clone(), &style, &halves());
    let [a, b] = [&whole, &pieces].map(|scene| Model::new(scene).unwrap());
    assert_eq!(a.triangle_count(), b.triangle_count());
    assert_eq!(a.edge_count(), b.edge_count());
    let drawn = |scene| {
        let model = LineModel::new(scene, &LineModelOptions::default()).unwrap();
        let options = LineOptions::new(SIZE);
        model.draw(&front(), &style, &options).unwrap()
    };
    let [whole, pieces] = [&whole, &pieces].map(drawn);
    assert!(
        pieces
            .strokes
            .iter()
            .all(|stroke| stroke.kind == Kind::Contour)
    );
    let length = |drawing: &npr_render::Drawing| {
        let of_stroke = |stroke: &npr_vector::stroke::Stroke| {
            let closed = stroke.closed.then(|| stroke.points[0]);
            let points: Vec<_> = stroke.points.iter().copied().chain(closed).collect();
            let step = |ends: &[npr_vector::stroke::StrokePoint]| {
                let [a, b] = [ends[0].position, ends[1].position];
                (b[0] - a[0]).hypot(b[1] - a[1])
            };
            points.windows(2).map(step).sum::<f64>()
        };
        drawing.strokes.iter().map(of_stroke).sum::<f64>()
    };
    assert!((length(&whole) / length(&pieces) - 1.0).abs() < 0.01);
}

#[test]
fn lines_run_between_regions_where_a_map_wants_them() {
    for (border, wanted) in [("", false), ("border = true", true)] {
        let mut style = with_map("shape", border, "");
        style.set("line.kinds.material=true").unwrap();
        let scene = cut(scene("Ball", icosphere(4)), &style, &halves());
        let near_middle = |frame: &npr_render::Frame| {
            let ink = frame.rgba.as_chunks::<4>().0.iter().enumerate();
            let ink = ink.filter(|(_, pixel)| pixel[0] < 80);
            let columns = ink.filter(|(i, _)| (110..130).contains(&(*i as u32 % SIZE[0])));
            columns
                .filter(|(i, _)| (60..120).contains(&(*i as u32 / SIZE[0])))
                .count()
        };
        for frame in frames(&scene, &style, &RendererOptions::new(SIZE), &front()) {
            assert_eq!(near_middle(&frame) > 100, wanted, "{}", near_middle(&frame));
            assert!(wanted || near_middle(&frame) == 0);
        }
        let model = LineModel::new(&scene, &LineModelOptions::default()).unwrap();
        let drawing = model
            .draw(&front(), &style, &LineOptions::new(SIZE))
            .unwrap();
        let borders = drawing.strokes.iter().filter(|s| s.kind == Kind::Material);
        assert_eq!(borders.count() > 0, wanted);
    }
}

#[test]
fn strokes_follow_ids() {
    let style = with_map("shape", "", &format!("{RED_LEFT}\nline.width_factor = 2"));
    let scene = cut(scene("Ball", icosphere(4)), &style, &halves());
    let model = LineModel::for_style(&scene, &style, &LineModelOptions::default(), None).unwrap();
    let engines: Vec<&dyn Engine> = [&Processor as &dyn Engine]
        .into_iter()
        .chain(device().map(|device| device as &dyn Engine))
        .collect();
    for method in [LineSource::Edges, LineSource::Surface] {
        let options = LineOptions {
            method,
            ..LineOptions::new(SIZE)
        };
        for engine in &engines {
            let drawing = LineRenderer::new(*engine, &model)
                .draw(&front(), &style, &options)
                .unwrap();
            let mut seen = [0, 0];
            for stroke in &drawing.strokes {
                let is_red = drawing.surfaces[stroke.surface as usize].line_color[0] == 255;
                for point in &stroke.points {
                    let x = point.position[0];
                    seen[usize::from(is_red)] += 1;
                    assert!(if is_red { x < 132.0 } else { x > 108.0 }, "{method:?} {x}");
                }
            }
            assert!(seen.iter().all(|count| *count > 10), "{method:?}: {seen:?}");
        }
    }
}

/// What shows through another look keeps the colours that rules give its regions.
#[test]
fn blends_know_ids() {
    let mut style = with_map(
        "none",
        "",
        "[[rule]]\nmatch.id = 'left'\nshade.color = '#ff0000'",
    );
    style.set("blend.amount=0").unwrap();
    let scene = cut(scene("Ball", icosphere(4)), &style, &halves());
    for frame in frames(&scene, &style, &RendererOptions::new(SIZE), &front()) {
        let at = |x: u32| &frame.rgba[((90 * SIZE[0] + x) * 4) as usize..][..3];
        let (left, right) = (at(90), at(150));
        assert!(left[0] > 100 && left[1] < 60, "{left:?}");
        assert!(right[0].abs_diff(right[1]) < 10, "{right:?}");
    }
}

#[test]
fn a_style_without_maps_forgets_ids() {
    let scene = scene("Ball", icosphere(2));
    let cut_up = cut(scene, &with_map("shape", "", ""), &halves());
    assert!(
        cut_up.meshes[0]
            .parts
            .iter()
            .all(|part| part.ids.len() == 2)
    );
    let plain = cut(cut_up, &style(""), &halves());
    assert!(plain.meshes[0].parts.iter().all(|part| part.ids.is_empty()));
}
