//! Grass and hair drawn by a line for each blade and lock.

use crate::scenes::{SIZE, add, camera_at, even_style, model_of};
use npr_mesh::testing::cylinder;
use npr_render::{Drawing, Kind, LineModel, LineModelOptions, LineOptions, LineSource, Subject};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_vector::mesh_lines::bvh::FaceTree;
use npr_vector::project::Projector;
use npr_vector::stroke::Stroke;

const EYE: [f32; 3] = [0.0, 0.4, 6.0];

const ROWS: u32 = 7;

/// Blades of the tuft, and those of them that the wall hides.
const BLADES: u32 = 12;
const HIDDEN: u32 = 3;

/// Where a blade has its root, to the right.
fn root_of(blade: u32) -> f32 {
    0.2 * blade as f32 - 1.1
}

/// A blade 1.2 high and 0.08 wide at its root, that bows away from the eye and twists.
fn blade(number: u32) -> npr_mesh::Mesh {
    let positions = (0..ROWS).flat_map(|row| {
        let t = row as f32 / (ROWS - 1) as f32;
        let half = 0.04 * (1.0 - t);
        let turn = 0.8 * t;
        let [c, s] = [npr_core::math::cos(turn), npr_core::math::sin(turn)];
        [-half, half].map(|side| {
            [
                root_of(number) + side * c,
                1.2 * t - 0.5,
                side * s - 0.4 * t * t,
            ]
        })
    });
    let triangles = (1..ROWS).flat_map(|row| {
        let [a, b, c, d] = [2 * row - 2, 2 * row - 1, 2 * row, 2 * row + 1];
        [[a, b, c], [c, b, d]]
    });
    npr_mesh::Mesh::new(positions.collect(), triangles.collect()).expect("sound")
}

/// A tuft of twelve blades, one object, and a wall before the last three.
fn tuft() -> Scene {
    let mut scene = Scene::default();
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for number in 0..BLADES {
        let blade = blade(number);
        let first = positions.len() as u32;
        positions.extend_from_slice(blade.positions());
        triangles.extend(
            blade
                .triangles()
                .iter()
                .map(|corners| corners.map(|v| v + first)),
        );
    }
    let grass = npr_mesh::Mesh::new(positions, triangles).expect("sound");
    add(&mut scene, "grass", &grass);
    let wall = [
        [0.58, -1.0, 0.5],
        [2.0, -1.0, 0.5],
        [2.0, 1.2, 0.5],
        [0.58, 1.2, 0.5],
    ];
    let wall = npr_mesh::Mesh::new(wall.to_vec(), vec![[0, 1, 2], [0, 2, 3]]).expect("sound");
    add(&mut scene, "wall", &wall);
    scene.materials[0].double_sided = true;
    scene
}

/// Even lines of two pixels, with grass drawn by its centres.
fn centres() -> Style {
    let rule = "[[rule]]\nmatch.material = 'grass'\nline.cards = 'centre'\n";
    let text = Style::from_toml(rule, &|_| Err(String::new())).expect("a rule");
    Style {
        rule: text.rule,
        ..even_style("2px")
    }
}

fn draw(scene: &Scene, style: &Style, eye: [f32; 3], options: &LineOptions) -> Drawing {
    let model = LineModel::for_style(scene, style, &LineModelOptions::default(), None);
    let model = model.expect("small");
    assert_eq!(model.parts().len(), model.shape().surfaces.len());
    model.draw(&camera_at(eye), style, options).expect("drawn")
}

fn grass(drawing: &Drawing) -> Vec<&Stroke> {
    let is_grass = |stroke: &&Stroke| drawing.surfaces[stroke.surface as usize].material == "grass";
    drawing.strokes.iter().filter(is_grass).collect()
}

#[test]
fn each_visible_blade_is_one_stroke_from_its_root_to_its_tip() {
    for method in [LineSource::Edges, LineSource::Surface, LineSource::Image] {
        let options = LineOptions {
            method,
            ..LineOptions::new(SIZE)
        };
        let drawing = draw(&tuft(), &centres(), EYE, &options);
        let mut found = grass(&drawing);
        found.sort_by(|a, b| a.points[0].position[0].total_cmp(&b.points[0].position[0]));
        assert_eq!(found.len() as u32, BLADES - HIDDEN, "{method:?}");
        for (number, stroke) in (0..).zip(found) {
            assert_eq!(stroke.kind, Kind::Marked);
            assert!(!stroke.closed && stroke.is_visible());
            let [root, tip] = [stroke.points[0], stroke.points[stroke.points.len() - 1]];
            let expected = [[root_of(number), -0.5, 0.0], [root_of(number), 0.7, -0.4]];
            for (end, expected) in [root, tip].iter().zip(expected) {
                let off = glam::Vec3::from(end.world).distance(glam::Vec3::from(expected));
                assert!(
                    off < 0.02,
                    "{method:?}: {:?} and not {expected:?}",
                    end.world
                );
            }
        }
        // The wall has its own lines.
        assert!(drawing.strokes.len() as u32 > BLADES - HIDDEN);
    }
    // Nobody asked: as many lines as ever.
    let drawing = draw(&tuft(), &even_style("2px"), EYE, &LineOptions::new(SIZE));
    let plain =
        model_of(&tuft()).draw(&camera_at(EYE), &even_style("2px"), &LineOptions::new(SIZE));
    assert_eq!(drawing, plain.expect("drawn"));
    assert!(
        grass(&drawing)
            .iter()
            .all(|stroke| stroke.kind != Kind::Marked)
    );
}

#[test]
fn a_picture_of_lines_has_the_blades_too() {
    let options = LineOptions {
        method: LineSource::Potrace,
        ..LineOptions::new([1280, 800])
    };
    let drawing = draw(&tuft(), &centres(), EYE, &options);
    let found = grass(&drawing);
    assert!(found.iter().all(|stroke| stroke.kind == Kind::Marked));
    let length: f64 = found.iter().map(|stroke| stroke.length()).sum();
    let exact = draw(&tuft(), &centres(), EYE, &LineOptions::new([1280, 800]));
    let expected: f64 = grass(&exact).iter().map(|stroke| stroke.length()).sum();
    assert!(
        (0.7..1.1).contains(&(length / expected)),
        "{length} of {expected}"
    );
}

#[test]
fn strokes_are_as_wide_as_their_blades_look_and_never_thinner_than_the_pen() {
    let options = LineOptions::new([1280, 800]);
    let model = LineModel::for_style(&tuft(), &centres(), &LineModelOptions::default(), None);
    let model = model.expect("small");
    let camera = camera_at(EYE);
    let projector = Projector::new(&camera, options.size, model.bounds());
    let drawing = model.draw(&camera, &centres(), &options).expect("drawn");
    for stroke in grass(&drawing) {
        for point in &stroke.points {
            let t = f64::from(point.world[1] + 0.5) / 1.2;
            let turn = npr_core::math::cos(0.8 * t as f32);
            let seen = 0.08 * (1.0 - t) * f64::from(turn) * projector.pixels_per_unit(point.depth);
            let expected = seen.max(2.0);
            assert!(
                (point.width - expected).abs() < 0.15 * expected + 0.3,
                "{} at {t}",
                point.width
            );
        }
    }
    // A rule makes them finer, the thinnest too.
    let mut fine = centres();
    fine.rule[0].line.width_factor = Some(0.5);
    let finer = model.draw(&camera, &fine, &options).expect("drawn");
    for (wide, thin) in grass(&drawing).iter().zip(grass(&finer)) {
        assert!((wide.points[0].width - 2.0 * thin.points[0].width).abs() < 1e-9);
    }
}

/// From the side, edge-on and from behind: what hides a blade's line is never the blade.
#[test]
fn no_blade_and_no_lock_hides_its_own_line() {
    let mut scene = Scene::default();
    add(&mut scene, "grass", &blade(6));
    scene.materials[0].double_sided = true;
    let mut hair = Scene::default();
    let lock = npr_mesh::testing::mapped(&cylinder(6, 12), |[x, y, z]| {
        let width = 0.05 * (1.1 + z);
        [width * x + 0.2 * z * z, -0.6 * z, width * y]
    });
    add(&mut hair, "grass", &lock);
    for scene in [scene, hair] {
        for step in 0..16 {
            let angle = 0.4 * step as f32;
            let eye =
                [npr_core::math::sin(angle), 0.3, npr_core::math::cos(angle)].map(|v| 5.0 * v);
            let drawing = draw(&scene, &centres(), eye, &LineOptions::new(SIZE));
            let lengths: Vec<f64> = drawing.strokes.iter().map(Stroke::length).collect();
            assert!(
                lengths.len() == 1 && lengths[0] > 50.0,
                "{step}: {lengths:?}"
            );
        }
    }
}

#[test]
fn lines_take_the_colours_of_their_cards() {
    let mut scene = tuft();
    let part = &mut scene.meshes[0].parts[0];
    let green = |p: &[f32; 3]| [0.0, if p[1] > 0.0 { 1.0 } else { 0.2 }, 0.0, 1.0];
    part.colors = Some(part.positions.iter().map(green).collect());
    let mut style = centres();
    style
        .set("line.paint.source=vertex-color")
        .expect("a source");
    style.set("line.paint.factor=1").expect("a factor");
    let drawing = draw(&scene, &style, EYE, &LineOptions::new(SIZE));
    for stroke in grass(&drawing) {
        let colors: Vec<[u8; 4]> = stroke
            .points
            .iter()
            .filter_map(|point| point.color)
            .collect();
        let (root, tip) = (colors[0], colors[colors.len() - 1]);
        assert!(root[1] < tip[1] && root[0] == 0, "{root:?} {tip:?}");
    }
}

#[test]
fn it_is_told_where_there_are_no_cards() {
    let mut scene = Scene::default();
    add(&mut scene, "grass", &npr_mesh::testing::cube());
    let subject = Subject::new(&scene, &centres()).expect("small");
    let notices = subject.lines.expect("lines").notices().join("; ");
    assert!(notices.contains("line.cards is centre"), "{notices}");
}

/// A tuft is drawn where its image ends: beside every line that it has, the mass shows on one side alone.
#[test]
fn a_tuft_has_its_outline_alone() {
    // From the side the blades stand before each other.
    let eye = [-6.0, 0.4, 0.4];
    let scene = tuft();
    let style = |cards: &str| {
        let rule = format!("[[rule]]\nmatch.material = 'grass'\nline.cards = '{cards}'\n");
        let text = Style::from_toml(&rule, &|_| Err(String::new())).expect("a rule");
        Style {
            rule: text.rule,
            ..even_style("2px")
        }
    };
    for method in [LineSource::Edges, LineSource::Surface] {
        let options = LineOptions {
            method,
            smooth: false,
            ..LineOptions::new(SIZE)
        };
        let [blades, mass] =
            ["outline", "tuft"].map(|cards| draw(&scene, &style(cards), eye, &options));
        let length = |drawing: &Drawing| -> f64 {
            let all = grass(drawing).into_iter();
            all.map(Stroke::length).sum()
        };
        assert!(length(&mass) > 40.0, "{method:?}: {} px", length(&mass));
        assert!(length(&mass) < 0.8 * length(&blades), "{method:?}");

        // Where it has lines it has those that blades have by themselves.
        let model =
            LineModel::for_style(&scene, &style("tuft"), &LineModelOptions::default(), None)
                .expect("small");
        let shape = model.shape();
        let tree = FaceTree::new(shape);
        let projector = Projector::new(&camera_at(eye), SIZE, model.bounds());
        let shows = |place: [f64; 2]| {
            let found = tree.face_at(shape, &projector, place);
            found.is_some_and(|(face, _)| {
                let surface = shape.face_surfaces[face as usize] as usize;
                shape.surfaces[surface].material_name == "grass"
            })
        };
        for stroke in grass(&mass) {
            for pair in stroke.points.windows(2) {
                let [from, to] = [pair[0].position, pair[1].position];
                let along = [0, 1].map(|i| to[i] - from[i]);
                let length = along[0].hypot(along[1]);
                if length < 2.0 {
                    continue;
                }
                let middle = [0, 1].map(|i| 0.5 * (from[i] + to[i]));
                let beside = |px: f64| {
                    let across = [-along[1] / length, along[0] / length];
                    shows([0, 1].map(|i| middle[i] + px * across[i]))
                };
                let sides = [1.0, -1.0].map(|side| [1.5, 3.0].iter().any(|px| beside(side * px)));
                assert!(
                    sides != [true; 2],
                    "{method:?}: a line within the tuft at {middle:?}"
                );
            }
        }
    }
}
