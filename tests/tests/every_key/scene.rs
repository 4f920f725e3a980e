//! A small scene that has something for every key, and what draws it.

use crate::outputs::Output;
use npr_core::camera::{Camera, Projection};
use npr_drawing::artwork::{ArtworkOptions, Paths, StrokeBrushes};
use npr_drawing::json::write_json;
use npr_drawing::lettering::testing::block_font;
use npr_drawing::svg::write_svg;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{icosphere, plane};
use npr_render::{
    Font, Lettering, LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource, Model,
    Movement, Picture, Renderer, RendererOptions, Smoke, Sphere, apply_id_maps,
};
use npr_scene::{
    Image, Light, LightKind, Material, Node, OutlineWidth, Scene, Skin, TextureTransform,
    TextureUse, Toon, ToonOutline, Transform, Wrap,
};
use npr_stylesheet::{Background, LineForm, Stated, Style};
use npr_tests::{Object, boxed, placed, scene_of};
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Arc, Mutex};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [96, 72];

/// A scene, and all that styles name.
pub struct Studio {
    scene: Scene,
    model: Model,
    empty: Model,
    pictures: BTreeMap<String, Picture>,
    fonts: BTreeMap<String, Font>,
    /// What [`Studio::drawn`] gave, by output and style: keys share their base styles.
    known: Mutex<BTreeMap<u64, Drawn>>,
}

/// A drawing as a number, and what is said of it.
type Drawn = (u64, Vec<String>);

impl Studio {
    pub fn new() -> Self {
        let scene = scene();
        let names = ["a.png", "b.png", "ids.png"];
        let font = || Font::new(block_font()).unwrap();
        Self {
            model: Model::new(&scene).unwrap(),
            empty: Model::new(&Scene::default()).unwrap(),
            scene,
            pictures: names.map(|name| (name.to_owned(), picture(name))).into(),
            fonts: ["a.ttf", "b.ttf"]
                .map(|name| (name.to_owned(), font()))
                .into(),
            known: Mutex::default(),
        }
    }

    /// The drawing in a style as a number, and what is said of it; a value that cannot be drawn with is told as an
    /// error.
    pub fn drawn(&self, output: Output, stated: &Stated) -> Drawn {
        let style = stated.style();
        let asked = number_of(&format!("{output:?} {style:?}"));
        if let Some(drawn) = self.known.lock().unwrap().get(&asked) {
            return drawn.clone();
        }
        let (bytes, notices) = match output {
            Output::Frame(_) | Output::Smoke => self.frame(style, output == Output::Smoke),
            Output::Lines { method, form, fill } => self.lines(style, method, form, fill),
        };
        let drawn = (number_of(&bytes), notices);
        let mut known = self.known.lock().unwrap();
        known.insert(asked, drawn.clone());
        drawn
    }

    fn frame(&self, style: &Style, is_smoke_alone: bool) -> (Vec<u8>, Vec<String>) {
        let cut = (!style.id_map.is_empty()).then(|| self.cut(style));
        let cut_model = cut.as_ref().map(|scene| Model::new(scene).unwrap());
        let model = match is_smoke_alone {
            true => &self.empty,
            false => cut_model.as_ref().unwrap_or(&self.model),
        };
        let options = self.options(style);
        let lines = style
            .has_curves()
            .then(|| self.line_model(cut.as_ref().unwrap_or(&self.scene), style));
        let mut renderer = match lines.as_ref().filter(|_| !is_smoke_alone) {
            Some(lines) => {
                let of_model = (model, LineRenderer::new(&Processor, lines));
                Renderer::with_lines(&Processor, of_model, style, &options).unwrap()
            }
            None => Renderer::new(&Processor, model, style, &options).unwrap(),
        };
        if !is_smoke_alone {
            renderer.set_movement(movement(cut.as_ref().unwrap_or(&self.scene), style));
        }
        match renderer.draw(&camera()) {
            Ok(frame) => (frame.rgba, frame.notices),
            Err(error) => (error.to_string().into_bytes(), Vec::new()),
        }
    }

    fn lines(
        &self,
        style: &Style,
        method: LineSource,
        form: LineForm,
        fill: bool,
    ) -> (Vec<u8>, Vec<String>) {
        let cut = (!style.id_map.is_empty()).then(|| self.cut(style));
        let scene = cut.as_ref().unwrap_or(&self.scene);
        let mut model = self.line_model(scene, style);
        model.set_smoke(Some(smoke()));
        model.set_pictures(self.pictures.clone());
        let options = LineOptions {
            method,
            fill,
            ..LineOptions::of_style(style, SIZE)
        };
        let renderer_options = self.options(style);
        let behind = style
            .contrasts_with_background()
            .then(|| Model::new(scene).unwrap());
        let mut renderer = LineRenderer::new(&Processor, &model);
        if let Some(behind) = &behind {
            renderer = renderer.with_backdrop(behind, &renderer_options);
        }
        renderer.set_movement(movement(scene, style));
        let drawing = match renderer.draw(&camera(), style, &options) {
            Ok(drawing) => drawing,
            Err(error) => return (error.to_string().into_bytes(), Vec::new()),
        };
        if form == LineForm::Data {
            return (write_json(&drawing), Vec::new());
        }
        let view = camera().view(SIZE, model.bounds());
        let words = Lettering::new(style, &self.fonts).unwrap();
        let paths = match form {
            LineForm::Centrelines => Paths::Centreline,
            LineForm::Stamps => Paths::Stamps,
            LineForm::Ink | LineForm::Data => Paths::Outline,
        };
        let brushes = match paths {
            Paths::Stamps => model.brushes(style, &options).unwrap(),
            Paths::Outline | Paths::Centreline => StrokeBrushes::default(),
        };
        let artwork = ArtworkOptions {
            paths,
            background: match style.background {
                Background::Color(color) if paths != Paths::Centreline => {
                    Some([color.r, color.g, color.b, color.a])
                }
                _ => None,
            },
            lettering: words.placed(&view, options.dpi),
            brushes,
            ..ArtworkOptions::default()
        };
        (write_svg(&drawing, &artwork), style.line_paint_notices())
    }

    fn options(&self, style: &Style) -> RendererOptions {
        let named = |name: &str| self.pictures.get(name).cloned();
        let background = match &style.background {
            Background::Image(name) => named(name),
            _ => None,
        };
        RendererOptions {
            background_image: background,
            pictures: self.pictures.clone(),
            fonts: self.fonts.clone(),
            smoke: Some(smoke()),
            ..RendererOptions::new(SIZE)
        }
    }

    fn line_model(&self, scene: &Scene, style: &Style) -> LineModel {
        LineModel::for_style(scene, style, &LineModelOptions::default(), None).unwrap()
    }

    /// The scene cut up by a style's id maps.
    fn cut(&self, style: &Style) -> Scene {
        let mut scene = self.scene.clone();
        apply_id_maps(&mut scene, style, &self.pictures).unwrap();
        scene
    }
}

fn number_of(thing: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    thing.hash(&mut hasher);
    hasher.finish()
}

/// Where everything of the scene was before: the box comes from the left and from above.
fn movement(scene: &Scene, style: &Style) -> Option<Arc<Movement>> {
    let mut scene = scene.clone();
    let rest = scene.nodes[1].world_from_node;
    Movement::of_style(&mut scene, (style, u64::MAX), |scene, seconds| {
        let place = &mut scene.nodes[1].world_from_node[3];
        place[0] = rest[3][0] - 4.0 * seconds;
        place[1] = rest[3][1] + 3.0 * seconds;
    })
    .unwrap()
}

fn camera() -> Camera {
    Camera {
        eye: [3.2, 2.4, 5.6],
        target: [0.1, 0.1, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.6 },
    }
}

/// A ball and a box that cut through each other on a floor of two materials, a beam, a sheet with a fold, a blade of
/// grass, and a step with a rounded edge.
fn scene() -> Scene {
    let mut scene = scene_of(&[
        Object::new("Ball", placed(&icosphere(2), [0.8; 3], [-0.7, 0.2, 0.0]))
            .colored([0.8, 0.5, 0.3]),
        Object::new("Box", boxed([-0.4, -0.6, -0.5], [0.9, 0.5, 0.6])),
        Object::new("Floor", floor(-1.5))
            .colored([0.5, 0.7, 0.4])
            .double_sided(),
        Object::new("Trim", floor(0.5))
            .colored([0.3, 0.3, 0.7])
            .double_sided(),
        Object::new("Glow", boxed([0.9, -0.4, 0.6], [1.1, 1.2, 0.8])),
        Object::new("Roof", roof()).double_sided(),
        Object::new("Blade", blade()).double_sided(),
        Object::new("Step", step()).double_sided(),
    ]);
    // One object of two materials, whose border is a line.
    let trim = scene.meshes[3].parts.remove(0);
    scene.meshes[2].parts.push(trim);
    // The ball is shaded smoothly.
    let ball = &mut scene.meshes[0].parts[0];
    let away = |p: &[f32; 3]| glam::Vec3::from(*p) - glam::Vec3::new(-0.7, 0.2, 0.0);
    let normals = ball
        .positions
        .iter()
        .map(|p| away(p).normalize().to_array());
    ball.normals = Some(normals.collect());
    // So is the step.
    let step = &mut scene.meshes[7].parts[0];
    let weld = npr_mesh::weld(&step.positions, 0.0);
    let smooth = npr_mesh::smooth_normals(&step.positions, &step.triangles, &weld);
    step.normals = Some(weld.spread(&smooth));
    for part in scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.parts) {
        let places = || part.positions.iter();
        part.uvs = Some(
            places()
                .map(|p| [p[0] * 0.5 + p[2] * 0.3 + 0.5, p[1] * 0.5 + 0.4])
                .collect(),
        );
        part.colors = Some(
            places()
                .map(|p| {
                    [0.5 + p[0] * 0.3, 0.5 + p[1] * 0.3, 0.6, 1.0].map(|c: f32| c.clamp(0.0, 1.0))
                })
                .collect(),
        );
    }
    let drawing = picture("a.png");
    scene.images = vec![Image {
        name: "paint".to_owned(),
        width: drawing.size[0],
        height: drawing.size[1],
        rgba: drawing.rgba,
    }];
    scene.materials[1].base_color_texture = Some(TextureUse {
        image: 0,
        uv_set: 0,
        wrap: [Wrap::Repeat; 2],
        transform: TextureTransform::default(),
    });
    scene.materials[0].toon = Some(Box::new(Toon {
        shade_color: [0.2, 0.1, 0.4],
        outline: ToonOutline {
            width: Some(OutlineWidth::Screen(0.02)),
            ..ToonOutline::default()
        },
        ..Toon::default()
    }));
    scene.lights = vec![Light {
        name: "Sun".to_owned(),
        kind: LightKind::Directional,
        color: [1.0, 0.8, 0.6],
        intensity: 3.0,
        range: None,
    }];
    scene.nodes.push(Node {
        name: "Sun".to_owned(),
        light: Some(0),
        ..Node::default()
    });
    scene.materials.push(Material::default());

    // The ball is the head of a figure, and above its middle the trunk: what is dark shows strokes.
    let joint = |name: &str| Node {
        name: name.to_owned(),
        rest: Some(Transform::default()),
        ..Node::default()
    };
    let first = scene.nodes.len() as u32;
    scene.nodes.extend([joint("hips"), joint("head")]);
    let still = scene.nodes[first as usize].world_from_node;
    let raised = |height: f32| {
        let mut matrix = still;
        matrix[3][1] = height;
        matrix
    };
    scene.nodes[first as usize + 1].world_from_node = raised(1.0);
    scene.skins.push(Skin {
        name: String::new(),
        joints: vec![first, first + 1],
        inverse_bind: vec![still, raised(-1.0)],
    });
    scene.nodes[0].skin = Some(0);
    let ball = &mut scene.meshes[0].parts[0];
    let joint_at = |p: &[f32; 3]| [u16::from(p[1] < 0.2), 0, 0, 0];
    ball.joints = Some(ball.positions.iter().map(joint_at).collect());
    ball.weights = Some(vec![[1.0, 0.0, 0.0, 0.0]; ball.positions.len()]);
    scene
}

/// A sheet over the others whose ridge is a crease in the middle, and too soft for one up to either side.
fn roof() -> npr_mesh::Mesh {
    let stations = [-1.5, -0.6, -0.3, 0.0, 0.3, 0.6, 1.5];
    let stations = [0.0, 0.28, 0.28, 0.28, 0.28, 0.28, 0.0_f32]
        .into_iter()
        .zip(stations);
    let rows = stations.flat_map(|(drop, x)| [[x, 1.25, -drop], [x, 1.65, 0.0], [x, 2.05, -drop]]);
    let corners = (0..6).flat_map(|piece| [3 * piece, 3 * piece + 1]);
    let triangles = corners.flat_map(|corner| {
        [
            [corner, corner + 3, corner + 1],
            [corner + 1, corner + 3, corner + 4],
        ]
    });
    npr_mesh::Mesh::new(rows.collect(), triangles.collect()).unwrap()
}

/// A step before the box: its upper edge is rounded, and it meets the floor at a right angle.
fn step() -> npr_mesh::Mesh {
    let side = [
        [0.0, 0.3],
        [0.25, 0.3],
        [0.257, 0.299],
        [0.264, 0.293],
        [0.265, 0.285],
        [0.265, 0.0],
        [0.5, 0.0],
    ];
    let rows = [-0.2, 0.2, 0.6]
        .into_iter()
        .flat_map(|x| side.map(|[z, y]| [x, y - 0.75, z + 1.0]));
    let count = side.len() as u32;
    let corners = (0..2).flat_map(|row| (0..count - 1).map(move |i| row * count + i));
    let triangles = corners.flat_map(|a| {
        let [b, c, d] = [a + 1, a + count, a + count + 1];
        [[a, b, c], [b, d, c]]
    });
    npr_mesh::Mesh::new(rows.collect(), triangles.collect()).unwrap()
}

/// A blade of grass on the floor before the ball.
fn blade() -> npr_mesh::Mesh {
    let rows = (0..6).flat_map(|row| {
        let t = row as f32 / 5.0;
        [-0.06, 0.06].map(|side| {
            [
                side * (1.0 - 0.8 * t) - 1.0,
                0.7 * t - 0.8,
                1.1 + 0.2 * t * t,
            ]
        })
    });
    let corners = (0..5).map(|row| 2 * row);
    let triangles = corners.flat_map(|corner| {
        [
            [corner, corner + 1, corner + 2],
            [corner + 2, corner + 1, corner + 3],
        ]
    });
    npr_mesh::Mesh::new(rows.collect(), triangles.collect()).unwrap()
}

/// A strip of floor from an x on.
fn floor(left: f32) -> npr_mesh::Mesh {
    let strip = npr_mesh::testing::mapped(&plane(2, 2), |[x, y, _]| [x, 0.0, y]);
    placed(&strip, [2.0, 1.0, 3.0], [left, -0.8, -1.5])
}

fn smoke() -> Smoke {
    let puffs = [
        ([0.9, 0.9, -0.4], 0.35, 0.9),
        ([1.2, 0.7, -0.2], 0.3, 0.5),
        ([0.7, 1.2, -0.6], 0.25, 0.2),
        ([1.1, 1.1, -0.7], 0.3, 0.0),
        ([0.5, 0.9, -0.1], 0.2, 0.7),
    ];
    let sphere = |(center, radius, heat)| Sphere {
        heat,
        ..Sphere::new(center, radius)
    };
    Smoke::new(puffs.into_iter().map(sphere).collect())
}

/// A picture of 16x16 pixels that tells all others apart.
fn picture(name: &str) -> Picture {
    let of = |x: u32, y: u32| -> [u8; 3] {
        match name {
            "ids.png" if x < 8 => [255, 0, 0],
            "ids.png" => [0, 255, 0],
            "a.png" => [(x * 16) as u8, (y * 15) as u8, 90],
            _ => [200 - (y * 9) as u8, 240 - (x * 13) as u8, (x * y) as u8],
        }
    };
    let pixels = (0..16 * 16).map(|i| of(i % 16, i / 16));
    Picture {
        size: [16, 16],
        rgba: pixels.flat_map(|[r, g, b]| [r, g, b, 255]).collect(),
    }
}
