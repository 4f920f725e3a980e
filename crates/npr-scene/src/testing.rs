//! Small valid files and scenes made in memory, for tests, fuzzing and benches.

mod figures;
mod puppets;

pub use figures::{BODY_BONES, Vrm, avatar, gesture, humanoid, node_of};
pub use puppets::puppet;

use crate::matrix;
use crate::{
    Camera, Channel, Clip, Interpolation, Light, LightKind, Mesh, Morph, Node, Part, Projection,
    Property, Scene, Skin, Transform, Unmorphed,
};

/// A binary glTF file of `json` and, unless it is empty, `bin`.
pub fn glb(json: &str, bin: &[u8]) -> Vec<u8> {
    let mut chunks = glb_chunk(0x4E4F_534A, &padded(json.as_bytes(), b' '));
    if !bin.is_empty() {
        chunks.extend(glb_chunk(0x004E_4942, &padded(bin, 0)));
    }
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((12 + chunks.len() as u32).to_le_bytes());
    file.extend(chunks);
    file
}

/// A PNG file of pixels, row by row from the top.
///
/// # Panics
///
/// Where the pixels do not fill the size.
pub fn picture(size: [u32; 2], pixels: &[[u8; 4]]) -> Vec<u8> {
    let mut file = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut file);
    let color = image::ExtendedColorType::Rgba8;
    image::ImageEncoder::write_image(encoder, pixels.as_flattened(), size[0], size[1], color)
        .expect("pixels that fill the picture");
    file
}

/// One chunk of a binary glTF file: length, kind, bytes.
pub fn glb_chunk(kind: u32, bytes: &[u8]) -> Vec<u8> {
    let mut chunk = (bytes.len() as u32).to_le_bytes().to_vec();
    chunk.extend(kind.to_le_bytes());
    chunk.extend(bytes);
    chunk
}

fn padded(bytes: &[u8], filler: u8) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes.resize(bytes.len().next_multiple_of(4), filler);
    bytes
}

/// A binary glTF file of two triangles, a body and a wing on it, with two clips of two seconds: `Beat` turns the wing
/// about x from a quarter turn back to where it rests, `Stretch` makes it three times as long, smoothly.
pub fn wing() -> Vec<u8> {
    let positions = [0f32, 0., 0., 1., 0., 0., 0., 1., 0.];
    let times = [0f32, 2.];
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let turns = [half, 0., 0., half, 0., 0., 0., 1.];
    let flat = [0f32; 3];
    let stretches = [flat, [1., 2., 1.], flat, flat, [1., 3., 1.], flat];
    let numbers = positions.iter().chain(&times).chain(&turns);
    let numbers = numbers.chain(stretches.as_flattened());
    let bin: Vec<u8> = numbers.flat_map(|number| number.to_le_bytes()).collect();
    let json = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
        "nodes":[{"name":"body","mesh":0,"children":[1]},{"name":"wing","mesh":0,"translation":[0,1,0]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
        {"bufferView":0,"byteOffset":36,"componentType":5126,"count":2,"type":"SCALAR"},
        {"bufferView":0,"byteOffset":44,"componentType":5126,"count":2,"type":"VEC4"},
        {"bufferView":0,"byteOffset":76,"componentType":5126,"count":6,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":148}],"buffers":[{"byteLength":148}],
        "animations":[{"name":"Beat","samplers":[{"input":1,"output":2}],
        "channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}}]},
        {"name":"Stretch","samplers":[{"input":1,"output":3,"interpolation":"CUBICSPLINE"}],
        "channels":[{"sampler":0,"target":{"node":1,"path":"scale"}}]}]}"#;
    glb(json, &bin)
}

/// How many vertices go round the limb of [`limb`], and how many rings it has.
const LIMB: [u32; 2] = [8, 9];

/// A round limb that bends at a knee and bulges there, with a flag, a camera and a lamp below the knee.
///
/// Clip `Bend` turns the knee about x by 100 degrees in a second and moves the hip, `Bulge` sets the weight of the
/// morph from 0 to 1. The limb has normals, or the morph alone has none and neither has the limb.
pub fn limb(has_normals: bool) -> Scene {
    // Roll up the limb.
    let [around, rings] = LIMB;
    let places: Vec<[f32; 2]> = (0..around * rings)
        .map(|i| {
            [
                (i % around) as f32 / around as f32,
                (i / around) as f32 / 4.0,
            ]
        })
        .collect();
    let out = |turn: f32| {
        let angle = turn * std::f32::consts::TAU;
        [npr_core::math::cos(angle), npr_core::math::sin(angle)]
    };
    let at = |[turn, height]: [f32; 2], radius: f32| {
        let [x, z] = out(turn);
        [x * radius, height, z * radius]
    };
    let bulge = |height: f32| 0.5 * (1.0 - (height - 1.0).abs()).max(0.0);
    let positions: Vec<[f32; 3]> = places.iter().map(|place| at(*place, 0.3)).collect();
    let level = |place: &[f32; 2]| at([place[0], 0.0], 1.0);
    let normals: Option<Vec<[f32; 3]>> = has_normals.then(|| places.iter().map(level).collect());
    let quad = |i: u32| {
        let [here, beside] = [i, i / around * around + (i + 1) % around];
        let [above, across] = [here + around, beside + around];
        [[here, above, beside], [beside, above, across]]
    };

    // Hang it on two joints, and let it bulge.
    let share = |height: f32| (height - 0.5).clamp(0.0, 1.0);
    let weights = places.iter().map(|[_, height]| {
        let knee = share(*height);
        [1.0 - knee, knee, 0.0, 0.0]
    });
    let morph = Morph {
        positions: Some(
            places
                .iter()
                .map(|place| at([place[0], 0.0], bulge(place[1])))
                .collect(),
        ),
        ..Morph::default()
    };
    let limb = Part {
        positions: positions.clone(),
        normals: normals.clone(),
        joints: Some(vec![[0, 1, 0, 0]; places.len()]),
        weights: Some(weights.collect()),
        triangles: (0..around * (rings - 1)).flat_map(quad).collect(),
        morphs: vec![morph],
        unmorphed: Some(Box::new(Unmorphed { positions, normals })),
        ..Part::default()
    };
    let flag = Part {
        positions: vec![[0.0; 3], [0.8, 0.0, 0.0], [0.8, 0.5, 0.0], [0.0, 0.5, 0.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Part::default()
    };

    // Place everything.
    let node = |name: &str, parent: Option<u32>, children: &[u32], translation: [f32; 3]| {
        let rest = Transform {
            translation,
            ..Transform::default()
        };
        Node {
            name: name.to_owned(),
            parent,
            children: children.to_vec(),
            rest: Some(rest),
            local: rest.matrix(),
            ..Node::default()
        }
    };
    let mut nodes = vec![
        node("limb", None, &[], [0.0; 3]),
        node("hip", None, &[2], [0.0; 3]),
        node("knee", Some(1), &[3, 4, 5], [0.0, 1.0, 0.0]),
        node("flag", Some(2), &[], [0.0, 1.0, 0.0]),
        node("eye", Some(2), &[], [0.0, 0.0, 4.0]),
        node("lamp", Some(2), &[], [0.0, 2.0, 0.0]),
    ];
    for index in 0..nodes.len() {
        let parent = nodes[index]
            .parent
            .map(|parent| nodes[parent as usize].world_from_node);
        let local = nodes[index].local;
        nodes[index].world_from_node =
            parent.map_or(local, |world| matrix::multiply(&world, &local));
    }
    (nodes[0].mesh, nodes[0].skin) = (Some(0), Some(0));
    (nodes[3].mesh, nodes[4].camera, nodes[5].light) = (Some(1), Some(0), Some(0));
    let down =
        |height: f32| matrix::from_parts([0.0, -height, 0.0], [0.0, 0.0, 0.0, 1.0], [1.0; 3]);
    let channel = |node, property, values: &[f32]| Channel {
        node,
        property,
        interpolation: Interpolation::Linear,
        times: [0.0, 1.0].into(),
        values: values.into(),
    };
    let [sin, cos] = [
        npr_core::math::sin(0.872_664_6),
        npr_core::math::cos(0.872_664_6),
    ];
    let clip = |name: &str, channels: Vec<Channel>| Clip {
        name: name.to_owned(),
        channels,
    };
    let scene = Scene {
        nodes,
        meshes: [limb, flag]
            .map(|part| Mesh {
                name: String::new(),
                parts: vec![part],
            })
            .to_vec(),
        skins: vec![Skin {
            name: String::new(),
            joints: vec![1, 2],
            inverse_bind: vec![down(0.0), down(1.0)],
        }],
        cameras: vec![Camera {
            name: "eye".to_owned(),
            projection: Projection::Perspective {
                yfov: 0.7,
                znear: 0.1,
                zfar: None,
                aspect: None,
            },
        }],
        lights: vec![Light {
            name: "lamp".to_owned(),
            kind: LightKind::Point,
            color: [1.0; 3],
            intensity: 10.0,
            range: None,
        }],
        clips: vec![
            clip(
                "Bend",
                vec![
                    channel(
                        2,
                        Property::Rotation,
                        &[0.0, 0.0, 0.0, 1.0, sin, 0.0, 0.0, cos],
                    ),
                    channel(1, Property::Translation, &[0.0, 0.0, 0.0, 0.3, 0.1, 0.2]),
                ],
            ),
            clip("Bulge", vec![channel(0, Property::Weights, &[0.0, 1.0])]),
        ],
        ..Scene::default()
    };
    scene.sanity_check();
    scene
}

/// A wavy sheet in the xz plane, as raw lists that every format can be written from.
pub struct Sheet {
    /// Positions, row by row.
    pub positions: Vec<[f32; 3]>,
    /// Triangles, two per cell.
    pub triangles: Vec<[u32; 3]>,
}

impl Sheet {
    /// A sheet of `side` x `side` cells: `2 * side * side` triangles.
    pub fn new(side: u32) -> Self {
        let corner = |i: u32| (i % (side + 1), i / (side + 1));
        let height = |x: u32, z: u32| ((x * 7 + z * 13) % 11) as f32 * 0.01;
        let position = |(x, z): (u32, u32)| [x as f32, height(x, z), z as f32];
        let positions = (0..(side + 1) * (side + 1))
            .map(|i| position(corner(i)))
            .collect();
        let triangles = (0..side * side)
            .flat_map(|cell| cell_triangles(cell % side, cell / side, side))
            .collect();
        Self {
            positions,
            triangles,
        }
    }

    /// The sheet as a binary glTF file.
    pub fn glb(&self) -> Vec<u8> {
        let mut bin = bytes_of(&self.positions, f32::to_le_bytes);
        let position_bytes = bin.len();
        bin.extend(bytes_of(&self.triangles, u32::to_le_bytes));
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
            "nodes":[{{"name":"sheet","mesh":0,"translation":[0,1,0]}}],
            "meshes":[{{"name":"sheet","primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},
              {{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],
            "bufferViews":[{{"buffer":0,"byteLength":{position_bytes}}},
              {{"buffer":0,"byteOffset":{position_bytes},"byteLength":{}}}],
            "buffers":[{{"byteLength":{}}}]}}"#,
            self.positions.len(),
            self.triangles.len() * 3,
            bin.len() - position_bytes,
            bin.len(),
        );
        glb(&json, &bin)
    }

    /// The sheet as an OBJ file.
    pub fn obj(&self) -> Vec<u8> {
        let vertices = self
            .positions
            .iter()
            .map(|[x, y, z]| format!("v {x} {y} {z}\n"));
        let faces = self
            .triangles
            .iter()
            .map(|t| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1));
        vertices.chain(faces).collect::<String>().into_bytes()
    }

    /// The sheet as a binary STL file.
    pub fn stl(&self) -> Vec<u8> {
        let mut file = vec![0; 80];
        file.extend((self.triangles.len() as u32).to_le_bytes());
        for triangle in &self.triangles {
            let corners = triangle.map(|vertex| self.positions[vertex as usize]);
            file.extend([0; 12]);
            file.extend(bytes_of(&corners, f32::to_le_bytes));
            file.extend([0; 2]);
        }
        file
    }

    /// The sheet as a text STL file.
    pub fn stl_text(&self) -> Vec<u8> {
        let vertex = |[x, y, z]: [f32; 3]| format!("vertex {x} {y} {z}\n");
        let facet = |triangle: &[u32; 3]| {
            let corners: String = triangle
                .iter()
                .map(|&i| vertex(self.positions[i as usize]))
                .collect();
            format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
        };
        let facets: String = self.triangles.iter().map(facet).collect();
        format!("solid sheet\n{facets}endsolid sheet\n").into_bytes()
    }

    /// The sheet as a PLY file of little-endian numbers.
    pub fn ply(&self) -> Vec<u8> {
        let mut file = self.ply_header("binary_little_endian");
        file.extend(bytes_of(&self.positions, f32::to_le_bytes));
        for triangle in &self.triangles {
            file.push(3);
            file.extend(bytes_of(&[*triangle], u32::to_le_bytes));
        }
        file
    }

    /// The sheet as a PLY file of big-endian numbers.
    pub fn ply_big_endian(&self) -> Vec<u8> {
        let mut file = self.ply_header("binary_big_endian");
        file.extend(bytes_of(&self.positions, f32::to_be_bytes));
        for triangle in &self.triangles {
            file.push(3);
            file.extend(bytes_of(&[*triangle], u32::to_be_bytes));
        }
        file
    }

    /// The sheet as a PLY file of text.
    pub fn ply_text(&self) -> Vec<u8> {
        let vertices = self
            .positions
            .iter()
            .map(|[x, y, z]| format!("{x} {y} {z}\n"));
        let faces = self
            .triangles
            .iter()
            .map(|[a, b, c]| format!("3 {a} {b} {c}\n"));
        let mut file = self.ply_header("ascii");
        file.extend(vertices.chain(faces).collect::<String>().into_bytes());
        file
    }

    fn ply_header(&self, format: &str) -> Vec<u8> {
        let (vertices, faces) = (self.positions.len(), self.triangles.len());
        format!(
            "ply\nformat {format} 1.0\nelement vertex {vertices}\n\
             property float x\nproperty float y\nproperty float z\n\
             element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
        )
        .into_bytes()
    }
}

fn cell_triangles(x: u32, z: u32, side: u32) -> [[u32; 3]; 2] {
    let a = z * (side + 1) + x;
    let (b, c) = (a + 1, a + side + 1);
    [[a, c, b], [b, c, c + 1]]
}

fn bytes_of<T: Copy, const N: usize>(rows: &[[T; N]], bytes: impl Fn(T) -> [u8; 4]) -> Vec<u8> {
    rows.iter()
        .flatten()
        .flat_map(|&value| bytes(value))
        .collect()
}

/// A binary glTF file of one mesh at the node `drawing`: triangles, if there are any, and behind them a primitive for
/// each list of vertices in `lines`, with its mode (1 lines, 2 loop, 3 strip).
pub fn lines_glb(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    lines: &[(u32, &[u32])],
) -> Vec<u8> {
    let surface = (4, triangles.as_flattened());
    let surface = Some(&surface).filter(|_| !triangles.is_empty());
    let mut bin = bytes_of(positions, f32::to_le_bytes);
    let mut views = format!(r#"{{"buffer":0,"byteLength":{}}}"#, bin.len());
    let mut accessors = format!(
        r#"{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}}"#,
        positions.len()
    );
    let mut primitives = Vec::new();
    for (number, (mode, indices)) in (1..).zip(surface.into_iter().chain(lines)) {
        let (start, length, count) = (bin.len(), 4 * indices.len(), indices.len());
        bin.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
        views += &format!(r#",{{"buffer":0,"byteOffset":{start},"byteLength":{length}}}"#);
        accessors += &format!(
            r#",{{"bufferView":{number},"componentType":5125,"count":{count},"type":"SCALAR"}}"#
        );
        primitives.push(format!(
            r#"{{"attributes":{{"POSITION":0}},"indices":{number},"mode":{mode}}}"#
        ));
    }
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"name":"drawing","mesh":0}}],"meshes":[{{"primitives":[{}]}}],
        "accessors":[{accessors}],"bufferViews":[{views}],"buffers":[{{"byteLength":{}}}]}}"#,
        primitives.join(","),
        bin.len(),
    );
    glb(&json, &bin)
}

/// A triangle bent by two joints, with a morph target, as a binary glTF file.
pub fn skinned_glb() -> Vec<u8> {
    bent_glb(4)
}

/// The same with a line through its corners instead of the triangle.
pub fn skinned_lines_glb() -> Vec<u8> {
    bent_glb(3)
}

fn bent_glb(mode: u32) -> Vec<u8> {
    let mut bin = bytes_of(&TRIANGLE, f32::to_le_bytes);
    bin.extend([0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]);
    bin.extend(bytes_of(&[[0.5f32, 1.5, 0.0, 0.0]; 3], f32::to_le_bytes));
    bin.extend(bytes_of(&[[0.0f32, 0.0, 2.0]; 3], f32::to_le_bytes));
    let json = r#"{"asset":{"version":"2.0"},"scenes":[{"name":"bent","nodes":[0,1]}],
        "nodes":[{"name":"body","mesh":0,"skin":0},{"name":"hip","children":[2]},{"name":"knee","translation":[0,1,0]}],
        "skins":[{"joints":[1,2]}],
        "meshes":[{"weights":[0.5],"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},
          "mode":MODE,"targets":[{"POSITION":3}]}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
          {"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},
          {"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"},
          {"bufferView":3,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},
          {"buffer":0,"byteOffset":48,"byteLength":48},{"buffer":0,"byteOffset":96,"byteLength":36}],
        "buffers":[{"byteLength":132}]}"#;
    glb(&json.replace("MODE", &mode.to_string()), &bin)
}

/// A triangle whose second vertex a sparse accessor replaces by (9, 9, 9), as a binary glTF file.
pub fn sparse_glb() -> Vec<u8> {
    let mut bin = bytes_of(&TRIANGLE, f32::to_le_bytes);
    bin.extend([1, 0, 0, 0]);
    bin.extend(bytes_of(&[[9.0f32; 3]], f32::to_le_bytes));
    let json = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,
          "indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}}}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":2},
          {"buffer":0,"byteOffset":40,"byteLength":12}],
        "buffers":[{"byteLength":52}]}"#;
    glb(json, &bin)
}

const TRIANGLE: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
