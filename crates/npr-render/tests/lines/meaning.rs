//! What drawings show: kinds, widths, colours, rules, marks.

use crate::scenes::{SIZE, add, camera_at, drawing_from, even_style, model_of, scene_of};
use npr_mesh::Mesh;
use npr_mesh::testing::{cube, icosphere, mapped, mirrored, plane};
use npr_render::{Drawing, Kind, KindSet, LineModel, LineModelOptions, LineOptions, Model};
use npr_scene::{AlphaMode, Scene};
use npr_stylesheet::Style;

const EYE: [f32; 3] = [3.0, 2.5, 6.0];

/// Total length of the strokes of a kind, in pixels.
fn length_of(drawing: &Drawing, kind: Kind) -> f64 {
    let strokes = drawing.strokes.iter().filter(|stroke| stroke.kind == kind);
    strokes.map(|stroke| stroke.length()).sum()
}

#[test]
fn a_cube_shows_its_outline_and_the_three_edges_inside() {
    let drawing = drawing_from(&scene_of(&cube()), EYE);
    assert!(length_of(&drawing, Kind::Contour) > 2.0 * length_of(&drawing, Kind::Crease) * 0.8);
    assert!(length_of(&drawing, Kind::Crease) > 50.0);
    assert_eq!(length_of(&drawing, Kind::Boundary), 0.0);
    assert!(drawing.strokes.iter().all(|stroke| stroke.is_visible()));
}

#[test]
fn only_the_kinds_asked_for_are_drawn() {
    let model = model_of(&scene_of(&cube()));
    for kind in [Kind::Contour, Kind::Crease, Kind::Boundary] {
        let options = LineOptions {
            kinds: [kind].into_iter().collect(),
            ..LineOptions::new(SIZE)
        };
        let drawing = model
            .draw(&camera_at(EYE), &Style::default(), &options)
            .expect("drawn");
        assert!(drawing.strokes.iter().all(|stroke| stroke.kind == kind));
        assert_eq!(drawing.strokes.is_empty(), kind == Kind::Boundary);
    }
}

#[test]
fn without_contours_what_lies_on_the_surface_keeps_its_outline() {
    // Of a cube every edge is a crease, of a ball none is one.
    let drawn = |mesh: &Mesh| {
        let mut style = Style::default();
        style.line.kinds.contour = false;
        let options = LineOptions::of_style(&style, SIZE);
        let model = model_of(&scene_of(mesh));
        model
            .draw(&camera_at(EYE), &style, &options)
            .expect("drawn")
    };
    let whole = drawing_from(&scene_of(&cube()), EYE);
    let [with, without] = [&whole, &drawn(&cube())].map(|drawing| {
        drawing
            .strokes
            .iter()
            .map(|stroke| stroke.length())
            .sum::<f64>()
    });
    assert!(
        (with - without).abs() < 0.02 * with,
        "{with} and {without} px"
    );
    assert!(drawn(&icosphere(3)).strokes.is_empty());
}

#[test]
fn hidden_lines_come_when_asked_for_with_what_hides_them() {
    let mut scene = scene_of(&cube());
    let wall = mapped(&plane(1, 1), |[x, y, _]| {
        [8.0 * x - 4.0, 8.0 * y - 4.0, 2.0]
    });
    add(&mut scene, "wall", &wall);
    let model = model_of(&scene);
    let drawn = |hidden| {
        let options = LineOptions {
            hidden,
            ..LineOptions::new(SIZE)
        };
        model
            .draw(&camera_at([0.0, 0.0, 9.0]), &Style::default(), &options)
            .expect("drawn")
    };
    assert!(
        drawn(false)
            .strokes
            .iter()
            .all(|stroke| stroke.is_visible())
    );
    let drawing = drawn(true);
    let hidden = drawing.strokes.iter().filter(|stroke| !stroke.is_visible());
    let length: f64 = hidden.clone().map(|stroke| stroke.length()).sum();
    assert!(length > 100.0, "{length} px");
    assert!(hidden.clone().all(|stroke| stroke.occluders <= 3));
}

#[test]
fn the_framing_is_that_of_pictures() {
    let mut scene = scene_of(&icosphere(1));
    let moved = mapped(&cube(), |[x, y, z]| [x * 3.0 + 2.0, y, z - 5.0]);
    add(&mut scene, "far", &moved);
    let (lines, picture) = (model_of(&scene), Model::new(&scene).expect("small"));
    assert_eq!(lines.framing(1.6, 0.5), picture.framing(1.6, 0.5));
    assert_eq!(lines.bounds(), picture.bounds());
    assert_eq!(lines.triangle_count(), picture.triangle_count());
}

#[test]
fn even_lines_have_the_width_of_the_style_and_parts_their_factor() {
    let mut scene = scene_of(&cube());
    add(
        &mut scene,
        "bold",
        &mapped(&cube(), |[x, y, z]| [x + 2.5, y, z]),
    );
    let mut style = even_style("2px");
    let rule = "[[rule]]\nmatch = { object = \"bold\" }\nline = { width_factor = 3.0, color = \"#ff0000\" }\n";
    style.rule = Style::from_toml(rule, &|_| Err(String::new()))
        .expect("a valid rule")
        .rule;
    let drawing = model_of(&scene)
        .draw(
            &camera_at(EYE),
            &style,
            &LineOptions {
                smooth: false,
                ..LineOptions::new(SIZE)
            },
        )
        .expect("drawn");
    for stroke in &drawing.strokes {
        let surface = &drawing.surfaces[stroke.surface as usize];
        let (width, red) = if surface.object == "bold" {
            (6.0, 255)
        } else {
            (2.0, 0x2b)
        };
        assert!(
            stroke
                .points
                .iter()
                .all(|point| (point.width - width).abs() < 1e-4)
        );
        assert_eq!(surface.line_color[0], red);
    }
}

#[test]
fn a_part_without_lines_still_hides_what_is_behind_it() {
    let mut scene = scene_of(&mapped(&icosphere(2), |p| p.map(|v| v * 0.5)));
    let wall = mapped(&plane(1, 1), |[x, y, _]| {
        [8.0 * x - 4.0, 8.0 * y - 4.0, 2.0]
    });
    add(&mut scene, "wall", &wall);
    let mut style = even_style("2px");
    let rule = "[[rule]]\nmatch = { object = \"wall\" }\nline = { on = false }\n";
    style.rule = Style::from_toml(rule, &|_| Err(String::new()))
        .expect("a rule")
        .rule;
    let drawing = model_of(&scene)
        .draw(&camera_at([0.0, 0.0, 6.0]), &style, &LineOptions::new(SIZE))
        .expect("drawn");
    assert!(drawing.strokes.is_empty(), "{:?}", drawing.strokes.len());
}

#[test]
fn what_is_too_transparent_for_pictures_has_no_lines() {
    let mut scene = scene_of(&cube());
    scene.materials[0].alpha = AlphaMode::Blend;
    scene.materials[0].base_color[3] = 0.2;
    assert!(drawing_from(&scene, EYE).strokes.is_empty());
    scene.materials[0].base_color[3] = 0.7;
    assert!(!drawing_from(&scene, EYE).strokes.is_empty());
}

#[test]
fn widths_follow_world_units_with_distance() {
    let model = model_of(&scene_of(&cube()));
    let width_from = |distance: f32| {
        let mut options = LineOptions::new(SIZE);
        options.smooth = false;
        let drawing = model
            .draw(
                &camera_at([0.0, 0.0, distance]),
                &even_style("0.1world"),
                &options,
            )
            .expect("drawn");
        let points = drawing.strokes.iter().flat_map(|stroke| &stroke.points);
        let nearest = points
            .min_by(|a, b| a.depth.total_cmp(&b.depth))
            .expect("lines");
        (nearest.width, nearest.depth)
    };
    let (near, near_depth) = width_from(5.0);
    let (far, far_depth) = width_from(10.0);
    assert!(
        (near * near_depth / (far * far_depth) - 1.0).abs() < 1e-3,
        "{near} {far}"
    );
}

#[test]
fn vertex_colors_swell_lines() {
    let mut scene = scene_of(&cube());
    let part = &mut scene.meshes[0].parts[0];
    part.colors = Some(
        part.positions
            .iter()
            .map(|p| [p[1] * 0.5 + 0.5, 0.0, 0.0, 1.0])
            .collect(),
    );
    let mut style = even_style("4px");
    for assignment in ["line.width.source=vertex-color", "line.width.min=0.25"] {
        style.set(assignment).expect("a valid key");
    }
    let drawing = model_of(&scene)
        .draw(
            &camera_at(EYE),
            &style,
            &LineOptions {
                smooth: false,
                ..LineOptions::new(SIZE)
            },
        )
        .expect("drawn");
    for point in drawing.strokes.iter().flat_map(|stroke| &stroke.points) {
        let share = f64::from(point.world[1]) * 0.5 + 0.5;
        // Along an edge from black to red the width runs evenly.
        assert!(
            (point.width - (1.0 + 3.0 * share)).abs() < 1e-3,
            "{point:?}"
        );
    }
}

#[test]
fn marks_of_the_file_become_lines_whatever_is_asked_for() {
    let flat = mapped(&plane(4, 4), |[x, y, _]| {
        [x * 4.0 - 2.0, y * 4.0 - 2.0, 0.0]
    });
    let mut scene = scene_of(&flat);
    let part = &mut scene.meshes[0].parts[0];
    part.marks = Some(part.positions.iter().map(|p| p[0].abs() < 0.1).collect());
    let drawing = marked_lines(&scene);
    let xs = drawing.strokes.iter().flat_map(|stroke| &stroke.points);
    assert!(xs.clone().count() >= 2);
    assert!(xs.clone().all(|point| point.world[0].abs() < 1e-5));
}

#[test]
fn a_marked_material_has_lines_where_it_meets_others() {
    let flat = mapped(&plane(2, 1), |[x, y, _]| {
        [x * 4.0 - 2.0, y * 4.0 - 2.0, 0.0]
    });
    let mut scene = scene_of(&flat);
    let mut other = scene.meshes[0].parts[0].clone();
    let left = |part: &npr_scene::Part, [a, b, c]: &[u32; 3]| {
        [a, b, c]
            .iter()
            .map(|v| part.positions[**v as usize][0])
            .sum::<f32>()
            < 0.0
    };
    let whole = other.clone();
    scene.meshes[0].parts[0]
        .triangles
        .retain(|t| left(&whole, t));
    other.triangles.retain(|t| !left(&whole, t));
    other.material = Some(1);
    scene.meshes[0].parts.push(other);
    scene.materials.push(npr_scene::Material::default());
    assert!(marked_lines(&scene).strokes.is_empty());
    scene.materials[1].marked = true;
    let drawing = marked_lines(&scene);
    assert_eq!(drawing.strokes.len(), 1);
    assert_eq!(drawing.strokes[0].kind, Kind::Marked);
}

/// What is drawn of a scene in the xy plane when nothing but marks is asked for.
fn marked_lines(scene: &Scene) -> Drawing {
    let options = LineOptions {
        kinds: KindSet::default(),
        ..LineOptions::new(SIZE)
    };
    model_of(scene)
        .draw(&camera_at([0.0, 0.0, 8.0]), &even_style("2px"), &options)
        .expect("drawn")
}

#[test]
fn a_mirrored_node_draws_like_a_mirrored_mesh() {
    let wedge = mapped(&cube(), |[x, y, z]| [x, y + 0.3 * x, z]);
    let by_mesh = drawing_from(&scene_of(&mirrored(&wedge)), EYE);
    let mut scene = scene_of(&wedge);
    scene.nodes[0].world_from_node[0][0] = -1.0;
    let by_node = drawing_from(&scene, EYE);
    for kind in Kind::ALL {
        let lengths = [&by_mesh, &by_node].map(|drawing| length_of(drawing, kind));
        assert!(
            (lengths[0] - lengths[1]).abs() < 1e-3,
            "{kind:?}: {lengths:?}"
        );
    }
}

#[test]
fn ids_stay_with_lines_when_the_camera_moves_a_little() {
    let scene = scene_of(&cube());
    let ids = |eye| {
        let drawing = drawing_from(&scene, eye);
        let mut ids: Vec<u64> = drawing.strokes.iter().map(|stroke| stroke.id).collect();
        ids.sort_unstable();
        ids
    };
    assert_eq!(ids(EYE), ids([3.01, 2.5, 6.0]));
}

#[test]
fn beams_have_no_lines_and_hide_none() {
    let mut scene = scene_of(&cube());
    let screen = mapped(&plane(4, 4), |[x, y, _]| {
        [8.0 * x - 4.0, 8.0 * y - 4.0, 2.0]
    });
    let bare = model_of(&scene);
    add(&mut scene, "Beam", &screen);
    // Widths that follow bends are measured against the size of the whole model.
    let rule = "line.width.source = 'constant'\n[[rule]]\nmatch.material = 'Beam'\n[rule.beam]\n";
    let style = Style::from_toml(rule, &|_| Err(String::new())).expect("a style");
    let model = LineModel::for_style(&scene, &style, &LineModelOptions::default(), None);
    let model = model.expect("a small scene");
    let options = LineOptions::new(SIZE);
    let camera = camera_at([1.0, 2.0, 9.0]);
    let of = |model: &LineModel| {
        model
            .draw(&camera, &style, &options)
            .expect("drawn")
            .strokes
    };
    assert_eq!(of(&model), of(&bare), "the cube through the light");
    assert_eq!(model.parts().len(), 1);
    assert!(model.radius() > bare.radius(), "the beam is in the picture");

    // A model made without the style draws none of the beam's own lines.
    let whole = model_of(&scene);
    let beam = whole
        .parts()
        .iter()
        .position(|part| part.material_name == "Beam");
    let beam = beam.expect("a surface") as u32;
    assert!(of(&whole).iter().all(|stroke| stroke.surface != beam));
}
