//! Strokes that take their colour from where they lie.

use crate::scenes::{SIZE, camera_at, scene_of};
use npr_drawing::artwork::ArtworkOptions;
use npr_drawing::drawing::rasterise;
use npr_drawing::json::{read_json, write_json};
use npr_mesh::testing::{cube, icosphere};
use npr_render::{Drawing, Kind, LineModel, LineModelOptions, LineOptions, LineSource};
use npr_scene::Scene;
use npr_style::line_color::HUES;
use npr_stylesheet::{Style, hue_row};

const EYE: [f32; 3] = [3.0, 2.5, 6.0];

fn style(text: &str) -> Style {
    Style::from_toml(text, &|_| Err(String::new())).expect("a style")
}

fn drawn(scene: &Scene, text: &str) -> Drawing {
    let style = style(text);
    let model = LineModel::for_style(scene, &style, &LineModelOptions::default(), None);
    let options = LineOptions::new(SIZE);
    let drawing = model
        .expect("small")
        .draw(&camera_at(EYE), &style, &options);
    drawing.expect("drawn")
}

/// A ball, lit from above, whose lines are black in the dark and white in the light.
const LIT: &str = "light = { direction = [0, 1, 0], space = 'world' }\n\
     line.paint.light.ramp = [{ at = 0, color = '#000' }, { at = 1, color = '#fff' }]";

fn colors(drawing: &Drawing) -> Vec<[u8; 4]> {
    let points = drawing.strokes.iter().flat_map(|stroke| &stroke.points);
    points.filter_map(|point| point.color).collect()
}

#[test]
fn a_constant_colors_no_point() {
    let plain = drawn(&scene_of(&cube()), "");
    assert!(colors(&plain).is_empty());
    let named = drawn(&scene_of(&cube()), "line.paint.source = 'constant'");
    assert_eq!(plain, named);
}

#[test]
fn kinds_have_their_colors() {
    let drawing = drawn(
        &scene_of(&cube()),
        "line.color = '#102030'\nline.paint.kinds.crease = '#ff8000'",
    );
    for stroke in &drawing.strokes {
        let wanted = match stroke.kind {
            Kind::Crease => [0xff, 0x80, 0, 255],
            _ => [0x10, 0x20, 0x30, 255],
        };
        assert!(
            stroke
                .points
                .iter()
                .all(|point| point.color == Some(wanted))
        );
    }
}

#[test]
fn depth_pales_lines_step_by_step() {
    let drawing = drawn(
        &scene_of(&cube()),
        "line.color = '#000'\nline.paint.depth.ramp = [{ at = 0, color = '#fff0' }, { at = 1, color = '#fff' }]",
    );
    let mut seen: Vec<(f64, u8)> = drawing
        .strokes
        .iter()
        .flat_map(|stroke| &stroke.points)
        .map(|point| (point.depth, point.color.expect("coloured")[0]))
        .collect();
    seen.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(
        seen.windows(2)
            .all(|pair| pair[0].1 <= pair[1].1.saturating_add(1))
    );
    assert!(seen[seen.len() - 1].1 > seen[0].1 + 60);
    let pieces = drawing
        .strokes
        .iter()
        .flat_map(|stroke| stroke.points.windows(2));
    let jump = pieces.map(|p| {
        let [a, b] = [0, 1].map(|i| p[i].color.expect("coloured")[0]);
        a.abs_diff(b)
    });
    assert!(
        jump.max().expect("pieces") < 16,
        "long pieces have points enough"
    );
}

#[test]
fn light_thins_lines() {
    let plain = drawn(&scene_of(&icosphere(3)), "line.width.source = 'constant'");
    let lit = drawn(
        &scene_of(&icosphere(3)),
        "line.width.source = 'constant'\nlight = { direction = [0, 1, 0], space = 'world' }\n\
         line.paint.light.width = [1, 0.2]",
    );
    let widths = |drawing: &Drawing, up: bool| {
        let points = drawing.strokes.iter().flat_map(|stroke| &stroke.points);
        let of_side =
            points.filter(|point| (point.world[1] > 0.6) == up && point.world[1].abs() > 0.6);
        of_side.map(|point| point.width).fold(0.0, f64::max)
    };
    assert!(widths(&lit, true) < 0.45 * widths(&plain, true));
    assert!(widths(&lit, false) > 0.7 * widths(&plain, false));
}

#[test]
fn colored_strokes_leave_no_gap_in_pictures() {
    let text = "line.color = '#000'\nline.paint.depth.ramp = [{ at = 0, color = '#f00' }, { at = 1, color = '#00f' }]";
    let [plain, colored] = ["line.color = '#000'", text].map(|text| {
        let drawing = drawn(&scene_of(&icosphere(2)), text);
        rasterise(&drawing, &ArtworkOptions::default())
    });
    let holes = plain
        .chunks(4)
        .zip(colored.chunks(4))
        .filter(|(a, b)| a[3] == 255 && b[3] < 200);
    assert_eq!(holes.count(), 0);
}

#[test]
fn line_data_keeps_the_colors() {
    let drawing = drawn(
        &scene_of(&cube()),
        "line.paint.depth.ramp = [{ at = 0, color = '#f00' }, { at = 1, color = '#00f' }]",
    );
    let back = read_json(&write_json(&drawing)).expect("own output");
    assert_eq!(colors(&back), colors(&drawing));
    assert!(
        !write_json(&drawn(&scene_of(&cube()), ""))
            .windows(8)
            .any(|text| text == b"\"colors\"")
    );
}

/// On a ball every point has the light of its own place, by every method: no facet shows, and none of another place.
#[test]
fn points_have_the_light_of_their_own_place() {
    let style = style(LIT);
    let row = hue_row(&style.line.paint.light.ramp);
    for level in [1, 2, 3] {
        let scene = scene_of(&icosphere(level));
        let model = LineModel::for_style(&scene, &style, &LineModelOptions::default(), None);
        let model = model.expect("small");
        for method in [LineSource::Edges, LineSource::Surface] {
            let options = LineOptions {
                method,
                ..LineOptions::new(SIZE)
            };
            let drawing = model.draw(&camera_at(EYE), &style, &options);
            let drawing = drawing.expect("drawn");
            let mut farthest = 0;
            for point in drawing.strokes.iter().flat_map(|stroke| &stroke.points) {
                // The normal of a ball is the place itself, and light is counted from -1 to 1.
                let [x, y, z] = point.world;
                let up = y / (x * x + y * y + z * z).sqrt();
                let place = (0.5 + 0.5 * up) * (HUES - 1) as f32;
                let wanted = row[4 * place.round() as usize];
                let color = point.color.expect("coloured");
                farthest = farthest.max(color[0].abs_diff(wanted));
            }
            assert!(
                !drawing.strokes.is_empty() && farthest < 12,
                "{level} {method:?}: {farthest}"
            );
        }
    }
}
