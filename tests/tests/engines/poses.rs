//! Renderers that go from pose to pose, on both engines: their pictures are those of renderers made for each pose.

use npr_core::camera::Camera;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{Frame, RendererOptions, Subject};
use npr_scene::testing::limb;
use npr_scene::{LoadOptions, Pose, Scene, load};
use npr_stylesheet::Style;
use npr_tests::{Agreement, device, models};

const SIZE: [u32; 2] = [160, 120];

/// A clip of a scene at a time; none is the rest pose.
type Moment = Option<(usize, f32)>;

fn posed(rest: &Scene, moment: Moment) -> Scene {
    let mut scene = rest.clone();
    let pose = moment.map_or_else(Pose::default, |(clip, time)| {
        rest.pose_at(&rest.clips[clip], time)
    });
    scene.set_pose(&pose).unwrap();
    scene
}

fn style(preset: &str, keys: &[&str]) -> Style {
    let mut style = Style::preset(preset).unwrap();
    keys.iter().for_each(|key| style.set(key).unwrap());
    style
}

/// Asserts on an engine that a renderer that goes through the moments draws the bytes of one made for each.
fn assert_goes_on(
    what: &str,
    engine: &dyn Engine,
    (rest, style): (&Scene, &Style),
    moments: &[Moment],
) -> Vec<Frame> {
    let subject = Subject::new(rest, style).unwrap();
    let camera = subject.model.framing(4.0 / 3.0, 0.9);
    let options = RendererOptions::new(SIZE);
    let mut renderer = subject.renderer(engine, style, &options).unwrap();
    let at_rest = renderer.draw(&camera).unwrap();
    let mut frames = Vec::new();
    for moment in moments {
        let scene = posed(rest, *moment);
        renderer.set_pose(&scene).unwrap();
        let frame = renderer.draw(&camera).unwrap();

        // Make one for the pose: a subject that was put into it before there was a renderer, or after where charts of
        // strokes are laid on the surface at rest.
        let is_hatched = style.ink.tone != Style::default().ink.tone;
        let mut fresh = Subject::new(rest, style).unwrap();
        if !is_hatched {
            fresh.set_pose(&scene).unwrap();
        }
        let mut made = fresh.renderer(engine, style, &options).unwrap();
        if is_hatched {
            made.set_pose(&scene).unwrap();
        }
        let wanted = made.draw(&camera).unwrap();
        assert!(frame.rgba == wanted.rgba, "{what} at {moment:?}");
        assert_eq!(
            frame.rgba == at_rest.rgba,
            moment.is_none(),
            "{what} at {moment:?}"
        );
        frames.push(frame);
    }
    frames
}

/// The same on both engines, whose pictures agree.
fn assert_goes_on_everywhere(what: &str, rest: &Scene, style: &Style, moments: &[Moment]) {
    let ours = assert_goes_on(what, &Processor, (rest, style), moments);
    let Some(device) = device() else { return };
    let theirs = assert_goes_on(what, device, (rest, style), moments);
    for ((ours, theirs), moment) in ours.iter().zip(&theirs).zip(moments) {
        let agreement = Agreement::between(ours, theirs, 2);
        assert!(
            agreement.within >= 0.995,
            "{what} at {moment:?}: {agreement}"
        );
    }
}

const LIMB: [Moment; 5] = [
    Some((0, 0.4)),
    Some((1, 0.8)),
    None,
    Some((0, 1.0)),
    Some((1, 1.0)),
];

#[test]
fn a_limb_goes_from_pose_to_pose_in_any_style() {
    for has_normals in [false, true] {
        let rest = limb(has_normals);
        for (preset, keys) in [
            ("toon", &[][..]),
            ("toon", &["light.file=true", "light.shadow=true"]),
            ("ink", &["line.method=strokes"]),
            // Lines that passes find by the folds that are handed to them.
            ("toon", &["line.method=shape", "line.crease_from=faces"]),
            ("hull", &[]),
            ("crosshatch", &["shade.use_vertex_colors=true"]),
        ] {
            let what = format!("limb, normals {has_normals}, {preset} {keys:?}");
            assert_goes_on_everywhere(&what, &rest, &style(preset, keys), &LIMB);
        }
    }
}

#[test]
fn shared_models_go_from_pose_to_pose() {
    let cases: [(&str, [Moment; 3]); 3] = [
        ("fox.glb", [Some((1, 0.2)), Some((2, 0.9)), None]),
        ("robot_animated.glb", [Some((0, 1.0)), Some((6, 0.4)), None]),
        (
            "animated_morph_cube.glb",
            [Some((0, 1.0)), Some((0, 3.0)), None],
        ),
    ];
    for path in models() {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if let Some((_, moments)) = cases.iter().find(|(known, _)| *known == name) {
            let rest = load(&path, &LoadOptions::default()).unwrap();
            assert_goes_on_everywhere(&name, &rest, &style("toon", &[]), moments);
        }
    }
}

#[test]
fn a_posed_model_is_the_one_that_is_made_of_the_posed_scene() {
    let style = style("toon", &[]);
    let draw = |subject: &Subject, camera: &Camera| {
        let options = RendererOptions::new(SIZE);
        let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
        renderer.draw(camera).unwrap()
    };
    for has_normals in [false, true] {
        let rest = limb(has_normals);
        for moment in [Some((0, 0.6)), Some((0, 1.0)), Some((1, 0.4))] {
            let scene = posed(&rest, moment);
            let fresh = Subject::new(&scene, &style).unwrap();
            let mut moved = Subject::new(&rest, &style).unwrap();
            moved.set_pose(&scene).unwrap();
            let camera = fresh.model.framing(4.0 / 3.0, 0.9);
            assert_eq!(moved.model.bounds(), fresh.model.bounds());
            assert_eq!(moved.model.cameras(), fresh.model.cameras());

            // Curvature and radius are those of rest, so lines are a shade wider or narrower; all else is the same.
            let [moved, fresh] = [&moved, &fresh].map(|subject| draw(subject, &camera));
            let agreement = Agreement::between(&moved, &fresh, 8);
            assert!(
                agreement.within >= 0.999,
                "normals {has_normals} at {moment:?}: {agreement}"
            );
        }
    }
}

#[test]
fn widths_follow_the_curvature_of_the_posed_surface() {
    // Draw wide lines that follow bends, and nothing else.
    let keys = [
        "line.width.source=curvature",
        "line.width.base=9",
        "line.width.min=0.1",
        "line.width.max=2.0",
        "line.width.gain=0.02",
        "line.width.room=0",
    ];
    let style = style("technical", &keys);

    // Put markers far out of sight, so that lengths in radii are the same in any pose.
    let mut rest = limb(true);
    let camera = Subject::new(&rest, &style).unwrap();
    let camera = camera.model.framing(4.0 / 3.0, 0.9);
    for part in rest.meshes.iter_mut().flat_map(|mesh| &mut mesh.parts) {
        if part.joints.is_none() {
            let first = part.positions.len() as u32;
            for side in [-40.0, 40.0] {
                part.positions
                    .extend([[0.0, side, 0.0], [1.0, side, 0.0], [0.0, side, 1.0]]);
            }
            part.triangles
                .extend([0, 3].map(|at| [0, 1, 2].map(|corner| first + at + corner)));
        }
    }
    let scene = posed(&rest, Some((1, 1.0)));

    // A limb that comes to bulge has the lines of one that is made so, to the rounding of its normals.
    let options = RendererOptions::new(SIZE);
    let fresh = Subject::new(&scene, &style).unwrap();
    let subject = Subject::new(&rest, &style).unwrap();
    for engine in [
        Some(&Processor as &dyn Engine),
        device().map(|device| device as _),
    ] {
        let Some(engine) = engine else { continue };
        let mut film = subject.renderer(engine, &style, &options).unwrap();
        film.set_pose(&posed(&rest, Some((1, 0.0)))).unwrap();
        let straight = film.draw(&camera).unwrap();
        film.set_pose(&scene).unwrap();
        let bulging = film.draw(&camera).unwrap();
        let mut made = fresh.renderer(engine, &style, &options).unwrap();
        let made = made.draw(&camera).unwrap();
        let agreement = Agreement::between(&bulging, &made, 2);
        assert!(agreement.within >= 1.0, "{agreement}");
        assert!(Agreement::between(&straight, &made, 2).within < 0.98);
    }
}

#[test]
fn a_film_copies_the_model_and_leaves_that_of_the_caller_alone() {
    let (rest, style) = (limb(true), style("toon", &[]));
    let subject = Subject::new(&rest, &style).unwrap();
    let options = RendererOptions::new(SIZE);
    let camera = subject.model.framing(4.0 / 3.0, 0.9);
    let draw = || {
        let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
        renderer.draw(&camera).unwrap().rgba
    };
    let before = draw();
    let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
    renderer.set_pose(&posed(&rest, Some((0, 1.0)))).unwrap();
    assert!(renderer.draw(&camera).unwrap().rgba != before);
    assert!(draw() == before);

    // A scene of other nodes is refused, and the pose stays.
    let stays = renderer.draw(&camera).unwrap().rgba;
    renderer.set_pose(&Scene::default()).unwrap_err();
    assert!(renderer.draw(&camera).unwrap().rgba == stays);
}
