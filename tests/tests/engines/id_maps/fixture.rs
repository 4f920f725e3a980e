//! Scenes with id maps, and pictures of them on both engines.

use npr_core::camera::{Camera, Projection};
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::Mesh;
use npr_render::{
    Frame, LineModel, LineModelOptions, LineRenderer, Model, Picture, Renderer, RendererOptions,
    apply_id_maps,
};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{Agreement, Object, device, lines, scene_of};
use std::collections::BTreeMap;

/// Size of all frames here; the middle column is 120, and a unit of the world 60 pixels.
pub const SIZE: [u32; 2] = [240, 180];

/// Named colours of all maps here.
pub const IDS: &str =
    "ids = [{ name = 'left', color = '#ff0000' }, { name = 'right', color = '#0000ff' }]\n";

pub const RED: [u8; 4] = [255, 0, 0, 255];
pub const BLUE: [u8; 4] = [0, 0, 255, 255];

/// Looks along -z at the origin.
pub fn front() -> Camera {
    Camera {
        eye: [0.0, 0.0, 5.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: 3.0 },
    }
}

/// A map `side` pixels square by a colour for each pixel, with its name in the style, `ids.png`.
pub fn painted(side: u32, color: impl Fn(u32, u32) -> [u8; 4]) -> BTreeMap<String, Picture> {
    let texel = |i: u32| color(i % side, i / side);
    let picture = Picture {
        size: [side; 2],
        rgba: (0..side * side).flat_map(texel).collect(),
    };
    BTreeMap::from([("ids.png".to_owned(), picture)])
}

/// Red on the left, blue on the right.
pub fn halves() -> BTreeMap<String, Picture> {
    painted(64, |x, _| if x < 32 { RED } else { BLUE })
}

/// One object, with the map laid on it from the front: -1..1 across is 0..1 of the map.
pub fn scene(name: &str, mesh: Mesh) -> Scene {
    let mut scene = scene_of(&[Object::new(name, mesh)]);
    for part in scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.parts) {
        let laid = |[x, y, _]: &[f32; 3]| [x * 0.5 + 0.5, 0.5 - y * 0.5];
        part.uvs = Some(part.positions.iter().map(laid).collect());
    }
    scene
}

/// A style by its text.
pub fn style(text: &str) -> Style {
    Style::from_toml(text, &|_| Err(String::new())).unwrap()
}

/// Black lines on white paper by a method, with a map, more of its keys, and rules.
pub fn with_map(method: &str, keys: &str, rules: &str) -> Style {
    let map = format!("[[id_map]]\nimage = 'ids.png'\n{IDS}{keys}\n{rules}");
    let reported = style(&map);
    Style {
        id_map: reported.id_map,
        rule: reported.rule,
        ..lines(method)
    }
}

/// The scene cut up by the maps of a style.
pub fn cut(mut scene: Scene, style: &Style, pictures: &BTreeMap<String, Picture>) -> Scene {
    apply_id_maps(&mut scene, style, pictures).unwrap();
    scene
}

/// The frames of all engines there are, the processor's first, which have to agree.
pub fn frames(
    scene: &Scene,
    style: &Style,
    options: &RendererOptions,
    camera: &Camera,
) -> Vec<Frame> {
    let model = Model::new(scene).unwrap();
    let lines = style
        .has_curves()
        .then(|| LineModel::for_style(scene, style, &LineModelOptions::default(), None).unwrap());
    let draw = |engine: &dyn Engine| {
        let mut renderer = match &lines {
            Some(lines) => {
                let of_model = (&model, LineRenderer::new(engine, lines));
                Renderer::with_lines(engine, of_model, style, options).unwrap()
            }
            None => Renderer::new(engine, &model, style, options).unwrap(),
        };
        renderer.draw(camera).unwrap()
    };
    let mut frames = vec![draw(&Processor)];
    frames.extend(device().map(|device| draw(device)));
    if let [plain, found] = &frames[..] {
        let agreement = Agreement::between(plain, found, 2);
        assert!(agreement.holds(), "{:?}: {agreement}", style.line.method);
    }
    frames
}

/// Inked pixels left and right of the middle, by colour: red, then black.
pub fn inked(frame: &Frame) -> [[usize; 2]; 2] {
    let mut counts = [[0; 2]; 2];
    for (i, pixel) in frame.rgba.as_chunks::<4>().0.iter().enumerate() {
        let right = usize::from(i as u32 % SIZE[0] >= SIZE[0] / 2);
        match pixel {
            [180..=255, 0..80, 0..80, _] => counts[0][right] += 1,
            [0..80, 0..80, 0..80, _] => counts[1][right] += 1,
            _ => {}
        }
    }
    counts
}
