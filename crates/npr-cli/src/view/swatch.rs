//! Samples of a brush and of hatching: small scenes that are drawn in place of the one that is shown.

use crate::source::Loaded;
use npr_core::math;
use npr_scene::{Material, Mesh, Node, Part, Scene};
use npr_view::{Order, Pose, Swatch, Viewpoint};
use std::f32::consts::PI;

/// How wide the picture is in the scene; the sheet of a brush is wider.
const WIDE: f32 = 2.0;

/// Vertical field of view of the camera, in degrees; it looks without perspective.
const FOV_DEG: f32 = 10.0;

/// Columns of the sheet that a stroke lies on.
const COLUMNS: u32 = 97;

/// Half the way from the start of a stroke to its end.
const REACH: f32 = 0.82;

/// How far a stroke sways to either side.
const SWAY: f32 = 0.055;

/// Sides of the cylinder that hatching lies on, over the half that is seen.
const SIDES: u32 = 64;

/// Half the height of the cylinder.
const TALL: f32 = 1.0;

/// What a sample of a brush changes about a style: strokes are what brushes draw.
const OF_BRUSH: [&str; 2] = ["line.method=strokes", "line.guides=[]"];

/// What a sample of hatching changes about a style: one light, from the right.
const OF_HATCH: [&str; 7] = [
    "light.direction=[1, 0, 0]",
    "light.space=world",
    "light.intensity=1",
    "light.color=#ffffff",
    "light.shadow=false",
    "light.file=false",
    "light.extra=[]",
];

/// What both leave out: all lines but marked ones, what is said of parts, and what goes over the picture.
const OF_BOTH: [&str; 8] = [
    "line.kinds.contour=false",
    "line.kinds.boundary=false",
    "line.kinds.crease=false",
    "line.kinds.material=false",
    "line.kinds.intersection=false",
    "rule=[]",
    "id_map=[]",
    "lettering=[]",
];

/// The scene of a sample, and its order: seen from the front, as wide as the picture.
pub fn of(swatch: Swatch, order: &Order) -> (Loaded, Order) {
    // Look at it so that it fills the width.
    let [width, height] = order.size.map(|side| side as f32);
    let tall = WIDE * height / width;
    let distance = tall / (2.0 * math::tan(0.5 * FOV_DEG.to_radians()));
    let viewpoint = Viewpoint {
        eye: [0.0, 0.0, distance],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        fov_deg: FOV_DEG,
        is_parallel: true,
    };

    // Draw nothing of the style but what the sample is of.
    let own: &[&str] = match swatch {
        Swatch::Brush => &OF_BRUSH,
        Swatch::Hatch => &OF_HATCH,
    };
    let mut overrides = order.overrides.clone();
    overrides.extend(own.iter().chain(&OF_BOTH).map(|text| (*text).to_owned()));
    let order = Order {
        overrides,
        viewpoint: Some(viewpoint),
        pose: Pose::default(),
        layer: None,
        ..order.clone()
    };
    let part = match swatch {
        Swatch::Brush => sheet(),
        Swatch::Hatch => cylinder(),
    };
    let loaded = Loaded {
        scene: scene_of(part),
        format: None,
        volume: None,
        inputs: Vec::new(),
    };
    (loaded, order)
}

/// A scene of one white part.
fn scene_of(part: Part) -> Scene {
    let mesh = Mesh {
        parts: vec![Part {
            material: Some(0),
            ..part
        }],
        ..Mesh::default()
    };
    Scene {
        nodes: vec![Node {
            mesh: Some(0),
            ..Node::default()
        }],
        meshes: vec![mesh],
        materials: vec![Material::default()],
        ..Scene::default()
    }
}

/// A flat sheet with a line on it that sways once.
fn sheet() -> Part {
    // Lay three rows, the middle one along the line.
    let mut part = Part::default();
    let mut marks = Vec::new();
    for column in 0..COLUMNS {
        let share = column as f32 / (COLUMNS - 1) as f32;
        let x = (share - 0.5) * 2.0 * WIDE;
        let y = SWAY * math::sin(PI * x / REACH);
        for (row, y) in [-WIDE, y, WIDE].into_iter().enumerate() {
            part.positions.push([x, y, 0.0]);
            marks.push(row == 1 && x.abs() <= REACH);
        }
    }
    part.marks = Some(marks);
    part.triangles = between(COLUMNS, 3);
    part
}

/// The front half of a cylinder that stands upright, as wide as the picture.
fn cylinder() -> Part {
    let mut part = Part::default();
    let mut normals = Vec::new();
    for side in 0..=SIDES {
        let angle = PI * (1.0 - side as f32 / SIDES as f32);
        let around = [math::cos(angle), math::sin(angle)];
        for y in [-TALL, 0.0, TALL] {
            let [x, z] = around.map(|place| 0.5 * WIDE * place);
            part.positions.push([x, y, z]);
            normals.push([around[0], 0.0, around[1]]);
        }
    }
    part.normals = Some(normals);
    part.triangles = between(SIDES + 1, 3);
    part
}

/// Triangles between columns of vertices from left to right, each from its lowest to its highest; they face the eye.
fn between(columns: u32, rows: u32) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for column in 0..columns - 1 {
        for row in 0..rows - 1 {
            let here = column * rows + row;
            let [right, above] = [here + rows, here + 1];
            triangles.push([here, right, right + 1]);
            triangles.push([here, right + 1, above]);
        }
    }
    triangles
}
