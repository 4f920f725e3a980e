//! A small scene in which every pass has something to do: a torus and a ball that run into each other.

use npr_core::camera::{Camera, Projection};
use npr_core::geometry::{ChartCorners, Edge, Influence, NONE, Part, Triangle, Vertex};
use npr_core::light_view::{distant_view, spot_view};
use npr_core::line_kind::KindSet;
use npr_core::math;
use npr_core::outline::Outline;
use npr_core::smoke::Sphere;
use npr_core::texture::{TextureStore, Wrap};
use npr_core::window::View;
use npr_mesh::testing::{Random, mapped, torus, uv_sphere};
use npr_mesh::{EdgeFlags, NO_FACE, smooth_normals, unique_edges, weld};
use npr_style::backdrop::{Criteria, PartSubject, Rule, Rules};
use npr_style::brush::{BrushImage, Tip};
use npr_style::compose::Compose;
use npr_style::lighting::{LightSource, Lights};
use npr_style::line_color::HUES;
use npr_style::smoke::{SmokeLook, pen};
use npr_style::tone_row::{row_words, tone_row};
use npr_style::toon::{Toon, ToonMap};
use npr_stylesheet::{HueStop, hue_row};
use npr_vector::brush::Brush;
use npr_vector::ink_point::InkPoint;
use npr_vector::sampled::{PartWidth, SampledLine, SpineSample};

/// Width and height of the frame that windows are laid over.
pub const FRAME_PX: [u32; 2] = [160, 90];

/// How the scene is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// In perspective, with what the project added to the publications.
    Ours,
    /// In parallel view, with all options the other way round.
    Published,
}

/// The stored side of a scene.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    pub vertices: Vec<Vertex>,
    pub influences: Vec<Influence>,
    pub palette: Vec<[[f32; 4]; 4]>,
    pub parts: Vec<Part>,
    pub triangles: Vec<Triangle>,
    pub edges: Vec<Edge>,
    pub charts: Vec<ChartCorners>,
    pub texels: Vec<u32>,
    /// A pen, and brushes whose images lie in the texels.
    pub brushes: Vec<Brush>,
}

impl Scene {
    /// Both shapes, a part each.
    pub fn new() -> Self {
        let mut store = TextureStore::new();
        let mut random = Random::new(7);
        let sky = store.add_words(&sky_words(&mut random)).unwrap();
        assert_eq!(sky, SKY_START);
        let rgba: Vec<u8> = (0..16 * 8 * 4).map(|_| random.below(256) as u8).collect();
        let texture = store
            .add([16, 8], &rgba, [Wrap::Repeat, Wrap::Mirror])
            .unwrap();
        let hatch = store.add_tile(64, 8.0, &hatch_levels()).unwrap();
        let row = tone_row([5, 1], &rgba[..20], 0.1).unwrap();
        let tone_row = store.add_words(row_words(&row)).unwrap();
        let hues = [0, 1].map(|i| {
            let stops = [(0.1, "#fff0"), (0.5, "#20c0ff80"), (1.0, "#ffd0a0e0")];
            let stops = stops.map(|(at, color)| HueStop {
                at: if i == 0 { at } else { 1.0 - at },
                color: color.parse().unwrap(),
            });
            let mut stops = stops.to_vec();
            stops.sort_by(|a, b| a.at.total_cmp(&b.at));
            let size = [HUES as u32, 1];
            store.add(size, &hue_row(&stops), [Wrap::Clamp; 2]).unwrap()
        });
        let brushes = brushes(&mut store);
        let mut scene = Self {
            texels: store.words().to_vec(),
            brushes,
            palette: palette(),
            ..Self::default()
        };
        let flags = Part::LINES
            | Part::HULL
            | Part::INK
            | Part::HATCH
            | Part::ON_SURFACE
            | Part::TWO_LAYERS
            | Part::SOFT
            | Part::BACK_LIGHT;
        let hatched = Part {
            hatch,
            line_flags: Part::LINE_SURFACE
                | Part::LINE_DEPTH
                | Part::LINE_FROM_MIDDLE
                | Part::LINE_LIGHT
                | Part::LINE_RIM
                | Part::LINE_TINT
                | Part::LINE_WIDTH
                | 4,
            line_depth_row: hues[0],
            line_light_row: hues[1],
            line_depth: [-1.7, 0.3],
            // Grey all over, so that strokes show everywhere.
            dark_at: 0.0,
            light_at: 1.5,
            ..part(1, flags, NONE)
        };
        // As many triangles as fill a row of charts, and more.
        scene.add(&torus(40, 14, 1.0, 0.4), hatched, &mut random);
        let flags = Part::LINES
            | Part::HULL
            | Part::ANGLE
            | Part::CUTOUT
            | Part::DOUBLE_SIDED
            | Part::HATCH
            | Part::ISOTROPIC
            | Part::CUT
            | Part::CRISP
            | Part::STREAK
            | Part::TONE_ROW;
        let hatched = Part {
            hatch,
            tone_row,
            line_flags: Part::LINE_TEXTURE | Part::LINE_OPACITY | Part::LINE_DEPTH | 2,
            line_texture: texture,
            line_depth_row: hues[1],
            line_depth: [2.0, 0.25],
            tone_reach_px: 3.5,
            ..part(2, flags, texture)
        };
        scene.add(&uv_sphere(16, 10), hatched, &mut random);
        let beam = Part {
            beam_alpha: [0.3, 0.8, 0.5, 0.0],
            ..part(3, Part::BEAM, NONE)
        };
        scene.add(&torus(16, 8, 0.9, 0.25), beam, &mut random);
        // A ring beside the others whose toon material has every picture.
        let words: Vec<u32> = bytemuck::cast_slice(&[toon(texture)]).to_vec();
        let toon = Part {
            toon: scene.texels.len() as u32,
            ..part(
                4,
                Part::TOON | Part::TOON_LINE | Part::HULL | Part::WORLD_LINE,
                texture,
            )
        };
        scene.texels.extend(words);
        let ring = mapped(&torus(14, 9, 0.35, 0.15), |[x, y, z]| {
            [x - 0.8, y - 0.9, z + 0.9]
        });
        scene.add(&ring, toon, &mut random);
        // Lay the tiles of strokes across the scene, each triangle a little off its place.
        let chart = |triangle: &Triangle| {
            let off = [random.unit() * 0.1, random.unit() * 0.1];
            let [a, b, c] = triangle.corners.map(|corner| {
                let [x, y, z] = scene.vertices[corner as usize].position;
                [x + 0.3 * z + off[0], y - 0.3 * z + off[1]]
            });
            ChartCorners { a, b, c }
        };
        scene.charts = scene.triangles.iter().map(chart).collect();
        scene
    }

    fn add(&mut self, mesh: &npr_mesh::Mesh, part: Part, random: &mut Random) {
        let (first_vertex, first_face) = (self.vertices.len() as u32, self.triangles.len() as u32);
        let (positions, corners, number) =
            (mesh.positions(), mesh.triangles(), self.parts.len() as u32);
        let welded = weld(positions, 0.0);
        let normals = welded.spread(&smooth_normals(positions, corners, &welded));
        for (position, normal) in positions.iter().zip(normals) {
            self.vertices
                .push(vertex(*position, normal, number, random));
            self.influences.push(influence(random));
        }
        let numbered = |corners: &[u32; 3]| Triangle {
            corners: corners.map(|v| v + first_vertex),
            part: number,
        };
        self.triangles.extend(corners.iter().map(numbered));
        for edge in unique_edges(positions, corners, &welded, &[]) {
            self.edges.push(Edge {
                ends: edge.ends.map(|v| v + first_vertex),
                faces: edge.faces.map(|face| {
                    if face == NO_FACE {
                        NONE
                    } else {
                        face + first_face
                    }
                }),
                dihedral_cos: edge.dihedral_cos,
                traits: edge.flags.among(EdgeFlags::MATERIAL),
            });
        }
        self.parts.push(part);
    }
}

fn vertex(position: [f32; 3], normal: [f32; 3], part: u32, random: &mut Random) -> Vertex {
    Vertex {
        position,
        color: random.bits() as u32 | 0x8080_8080,
        normal,
        direction: math::pack_unit([normal[1], -normal[0], 0.1]),
        uv: [random.unit() * 3.0 - 1.0, random.unit() * 3.0 - 1.0],
        curvatures: [random.unit() * 4.0 - 1.0, random.unit() * 2.0 - 1.0],
        weld_normal: math::pack_unit(normal),
        width: random.unit(),
        part,
        pen: math::pack_shares([random.unit(), random.unit()]),
    }
}

fn influence(random: &mut Random) -> Influence {
    let share = random.unit() * 0.25;
    Influence {
        joints: [0, 1, 2, 0],
        weights: [1.0 - share, share * 0.5, share * 0.5, 0.0],
    }
}

/// Three matrices that hardly differ, so that blends stay close to the shapes.
fn palette() -> Vec<[[f32; 4]; 4]> {
    let moved = |x: f32, scale: f32| {
        [
            [scale, 0.1, 0.0, 0.0],
            [-0.1, scale, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [x, 0.05, -0.1, 1.0],
        ]
    };
    vec![moved(0.0, 1.0), moved(0.3, 0.9), moved(-0.2, 1.1)]
}

fn part(object: u32, flags: u32, texture: u32) -> Part {
    let mut ramp = [[1.0, 1.0, 1.0, 2.0]; 8];
    ramp[0] = [0.1, 0.1, 0.3, 0.0];
    ramp[1] = [0.5, 0.4, 0.4, 0.4];
    ramp[2] = [1.0, 0.9, 0.8, 0.7];
    Part {
        base_color: [0.9, 0.6, 0.4, 0.95],
        line_color: [0.1, 0.05, 0.2, 0.9],
        object,
        material: object + 10,
        texture,
        flags,
        width_factor: 1.2,
        facing_threshold: 0.25,
        alpha_cutoff: 0.2,
        softness: 0.05,
        ink_color: [0.0, 0.0, 0.1, 0.9],
        dark_at: 0.2,
        light_at: 0.7,
        threshold: 0.5,
        paint_color: 0x668c_60c0,
        spacing_px: 3.0,
        hatch_gain: 1.2,
        hatch_grain: 0.7,
        spots_per_px: 0.4,
        tone_reach_px: 2.5 * (object % 2) as f32,
        second_from: 0.4,
        tile_scale: 0.5,
        turn: [0.8, 0.6],
        highlight_color: [1.0, 0.9, 0.8, 0.8],
        back_color: [0.4, 0.5, 0.9, 0.7],
        highlight: [12.0, 0.3, 1.5, 0.1],
        highlight_shape: [0.1, -0.1, 0.3, 0.4],
        highlight_turn: [0.8, 0.6, 0.1, 0.05],
        back: [0.4, 0.7, 0.2, 0.3],
        back_direction: [0.28, 0.48 + 0.1 * object as f32, -0.8],
        streak_across: [0.8, 0.6],
        line_kinds: std::array::from_fn(|kind| {
            [0xff00_80ff, 0xc0ff_2010, 0x80a0_b0c0, !0, 0xff10_2030][kind % 5]
        }),
        line_factor: 0.4,
        line_opacity: [1.0, 0.3],
        line_width: [1.3, 0.4],
        line_tint: 0x3080_20c0,
        line_rim: 0.8,
        ramp,
        ..Part::default()
    }
}

/// A toon material whose pictures all are `texture`, each lying in another way.
fn toon(texture: u32) -> Toon {
    let map = |i: f32| ToonMap {
        texture,
        lay: [0.9 - 0.1 * i, 0.2, 0.1 * i, -0.2, 0.8 + 0.1 * i, 0.3],
    };
    Toon {
        shade_color: [0.4, 0.3, 0.6],
        toony: 0.6,
        rim_color: [0.3, 0.5, 0.4],
        rim_power: 2.5,
        matcap_color: [0.2, 0.3, 0.1],
        rim_lift: 0.1,
        emissive: [0.05, 0.0, 0.1],
        rim_mix: 0.7,
        outline_color: [0.6, 0.2, 0.3],
        outline_mix: 0.8,
        shift: -0.1,
        shift_scale: 0.3,
        gi_equalization: 0.4,
        base_map: map(5.0),
        shade_map: map(0.0),
        shift_map: map(1.0),
        rim_map: map(2.0),
        emissive_map: map(3.0),
        matcap_map: map(4.0),
    }
}

/// A hatch tile of 64 texels a side: waves across u, another for each drawing.
fn hatch_levels() -> Vec<Vec<u32>> {
    let level = |l: u32| {
        let side = 64 >> l;
        let wave =
            move |x: u32, period: u32| 1 + (x % period).min(period - x % period) * 252 * 2 / period;
        let texel = move |i: u32| {
            let x = i % side + i / side / 8;
            u32::from_le_bytes([8, 8, 16, 16].map(|period| wave(x, period) as u8))
        };
        (0..side * side).map(texel).collect()
    };
    (0..3).map(level).collect()
}

/// The camera and the frame of a look.
pub fn view(look: Look) -> View {
    let projection = match look {
        Look::Ours => Projection::Perspective { fov_y: 0.7 },
        Look::Published => Projection::Parallel { height: 3.2 },
    };
    let camera = Camera {
        eye: [2.1, 1.7, 3.4],
        target: [0.1, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        projection,
    };
    camera.view(FRAME_PX, ([-1.7; 3], [1.7; 3]))
}

/// Settings of lines of a look.
pub fn outline(look: Look) -> Outline {
    let all_buffers = Outline::DEPTH | Outline::NORMAL | Outline::OBJECT_ID | Outline::MATERIAL_ID;
    let (base_width, kinds, detects, flags) = match look {
        Look::Ours => (
            3.0,
            KindSet::EDGES,
            all_buffers | Outline::PLANE_DEPTH,
            Outline::PROJECTED_CURVATURE,
        ),
        Look::Published => (
            0.05,
            EdgeFlags::FACING.0,
            all_buffers,
            Outline::PUBLISHED | Outline::WORLD_WIDTH,
        ),
    };
    Outline {
        base_width,
        min_factor: 0.4,
        max_factor: 1.6,
        gain: 1.5,
        radius_world: 1.7,
        crease_cos: 0.8,
        depth_threshold: 0.03,
        normal_cos: 0.6,
        kinds,
        detects,
        flags,
        reach_px: 4,
    }
}

/// Settings of the last pass of a look; the texture lies behind everything in one of them.
pub fn compose(look: Look, scene: &Scene) -> Compose {
    let smoke = Compose::SMOKE | Compose::SMOKE_PEN;
    let (samples, flags, background_texture) = match look {
        Look::Ours => (
            2,
            Compose::RIBBONS | Compose::OVERLAY | Compose::BEAMS | Compose::BACKDROP | smoke,
            NONE,
        ),
        Look::Published => (
            1,
            Compose::OVERLAY | Compose::LINES_IN_SRGB | Compose::BACKDROP | Compose::SMOKE,
            scene.parts[1].texture,
        ),
    };
    Compose {
        samples,
        smoke_shadow_side: SHADOW_SIDE,
        smoke_part: hatched_part(scene),
        smoke_line: [0.1, 0.0, 0.05, 1.0],
        smoke_anchor_px: [31.0, 17.0],
        smoke_tiles: 0.004,
        right_world: [0.8, 0.0, -0.6],
        up_world: [0.0, 1.0, 0.0],
        near_world: [0.6, 0.0, 0.8],
        radius: 1.7,
        center_world: [0.1, 0.0, 0.0],
        line_color: [0.3, 0.0, 0.0, 0.7],
        background_texture,
        flags,
        saturation: 1.2,
        ..Compose::before([0.2, 0.3, 0.5, 0.5])
    }
}

/// The same for the picture without lines.
pub fn bare_compose(look: Look, scene: &Scene) -> Compose {
    let drawn = compose(look, scene);
    let lines = Compose::RIBBONS | Compose::OVERLAY | Compose::BACKDROP;
    Compose {
        flags: drawn.flags & !lines | Compose::BARE,
        ..drawn
    }
}

/// By which rules lines mind the background in a look.
pub fn rules(look: Look) -> Rules {
    let mut rules = Rules {
        samples: if look == Look::Ours { 2 } else { 1 },
        smooth_px: 5.0,
        whole_px: 2.0,
        reach_px: 4,
        bias_px: 20.0,
        hold: 1.0,
        fade: 0.1,
        within: match look {
            Look::Ours => Rules::ALWAYS | Rules::RIBBONS | Rules::OVERLAY,
            Look::Published => 0,
        },
        ..Rules::default()
    };
    let criteria = Criteria {
        rgb: Some(0.8),
        saturation: Some(0.9),
        hue_deg: Some(170.0),
        ..Criteria::default()
    };
    rules.rules[1] = Rule {
        within: u32::from(look == Look::Ours),
        ..Rule::CONTRAST
    };
    rules.rules[2] = match look {
        Look::Ours => Rule {
            measure: Rule::WCAG,
            goal: 3.0,
            direction: Rule::BRIGHTER,
            ..Rule::CONTRAST
        },
        Look::Published => criteria.rule(1.7, Rule::AUTO),
    };
    rules
}

/// A subject for either surface; the beam is of none, and neither is the ring beside them.
pub fn part_subjects() -> [PartSubject; 4] {
    [(1, 1), (2, 2), (0, 0), (0, 0)].map(|(subject, rule)| PartSubject { subject, rule })
}

/// The first part that strokes are drawn on.
fn hatched_part(scene: &Scene) -> u32 {
    let is_hatched = |part: &Part| part.flags & Part::HATCH != 0;
    scene.parts.iter().position(is_hatched).unwrap_or(0) as u32
}

/// Texels of a shadow image along a side.
pub const SHADOW_SIDE: u32 = 128;

/// Shadow images; one of them is drawn.
pub const SHADOWS: u32 = 2;

/// The shadow image of the light that throws shadows in a look.
pub fn shadow_of(look: Look) -> u32 {
    match look {
        Look::Ours => 1,
        Look::Published => 0,
    }
}

/// Where the pictures of what hides the sky start: behind the table of the texture store.
const SKY_START: u32 = 256;

/// Texels of each of them along a side.
const SKY_SIDE: u32 = 8;

/// Four pictures of what hides the sky, of which one is of the lower half, of anything.
fn sky_words(random: &mut Random) -> Vec<u32> {
    let outwards = [
        [0.0, 1.0, 0.0],
        [0.6, 0.8, 0.0],
        [0.0, 0.28, 0.96],
        [0.6, -0.8, 0.0],
    ];
    let mut words = Vec::new();
    for [x, y, z] in outwards {
        let (right, up) = ([y, -x, 0.0], [-x * z, -y * z, x * x + y * y]);
        for (row, last) in [(right, 0), (up, 0), ([x, y, z], u32::from(y < 0.0))] {
            words.extend(row.map(f32::to_bits));
            words.push(last);
        }
    }
    let texels = 4 * SKY_SIDE * SKY_SIDE / 2;
    words.extend((0..texels).map(|_| random.bits() as u32));
    words
}

/// The lights of a look: one that throws shadows, or one of every kind with shadows of the spot.
pub fn lights(look: Look) -> Lights {
    let towards = [0.48, 0.6, 0.64];
    let shadow = shadow_of(look);
    let mut lights = Lights::distant(towards);
    (lights.shadow_side, lights.shadow_at) = (SHADOW_SIDE, 0.15);
    lights.bias_world = 1e-3;
    if look == Look::Ours {
        let corners = [[-1.7; 3], [1.7; 3], [-1.7, 1.7, -1.7], [1.7, -1.7, 1.7]];
        lights.shadows[shadow as usize] = distant_view(towards, &corners, &corners);
        lights.sources[0].shadow = shadow + 1;
    } else {
        lights.count = 5;
        lights.sources[3] = LightSource {
            kind: LightSource::SKY,
            intensity: 0.2,
            sky: LightSource::HIDDEN,
            ground: [1.0, 0.7, 0.4],
            ground_strength: 0.5,
            ..lights.sources[0]
        };
        lights.sources[4] = LightSource {
            sky: LightSource::HIDDEN | LightSource::PICTURE,
            ..lights.sources[3]
        };
        let pixels: Vec<[f32; 3]> = (0..8).map(|i| [0.1 * i as f32, 0.5, 0.8]).collect();
        lights.dome = npr_style::sky::dome_of([4, 2], &pixels);
        (lights.sky_center, lights.sky_radius) = ([0.0; 3], 2.0);
        (lights.sky_maps, lights.sky_views, lights.sky_side) = (SKY_START, 4, SKY_SIDE);
        for (i, kind) in [(1, LightSource::POINT), (2, LightSource::SPOT)] {
            lights.sources[i] = LightSource {
                position: [-1.5, 1.0, 1.5],
                kind,
                direction: [0.6, -0.48, -0.64],
                intensity: 0.6,
                color: [1.0, 0.8, 0.6],
                range: 5.0,
                cone: [0.7, 0.9],
                ..LightSource::default()
            };
        }
        let spot = &mut lights.sources[2];
        spot.shadow = shadow + 1;
        lights.shadows[shadow as usize] =
            spot_view(spot.position, spot.direction, spot.cone[0], 0.05);
    }
    lights
}

/// Puffs around, before and behind the shapes, and some that nobody sees.
pub fn spheres() -> Vec<Sphere> {
    let mut random = Random::new(11);
    let mut spheres: Vec<Sphere> = (0..150)
        .map(|_| {
            let center = [0; 3].map(|_| random.unit() * 3.2 - 1.6);
            Sphere {
                heat: random.unit(),
                ..Sphere::new(center, 0.08 + random.unit() * 0.3)
            }
        })
        .collect();
    spheres[3].radius = 0.0;
    spheres[4].center[1] = f32::NAN;
    spheres[5].center = [2.1, 1.7, 3.6];
    spheres
}

/// Strokes of many widths, bends and colours, thick ones and hairlines, some off the frame and one without a length.
pub fn strokes() -> Vec<InkPoint> {
    let mut random = Random::new(12);
    let mut points = Vec::new();
    for stroke in 0..40 {
        let thick = if stroke % 4 == 0 { 7.0 } else { 1.5 };
        let count = 2 + stroke % 9;
        // Half of them with a pen, and the other half with a brush each, on either side, some as parts of rings.
        let number = if stroke % 2 == 0 {
            0
        } else {
            1 + stroke as u32 / 2 % 3
        };
        let mirrored = if stroke % 3 == 0 {
            InkPoint::MIRRORED
        } else {
            0
        };
        let drawn = InkPoint::GOES_ON | if stroke % 5 == 0 { 0 } else { InkPoint::JOINED };
        let stamp = [0, InkPoint::STAMP, InkPoint::STAMP | InkPoint::ROUND][stroke % 7 % 3];
        let brush = number << InkPoint::BRUSH_SHIFT | mirrored | stamp;
        let mut px = FRAME_PX.map(|side| (1.2 * random.unit() - 0.1) * side as f32);
        for i in 0..count {
            points.push(InkPoint {
                px,
                half_width: thick * random.unit(),
                nearness: random.unit(),
                color: [0, 8, 16, 24].map(|bit| (random.unit() * 255.0) as u32 | 64 << bit)[i % 4],
                flags: if i + 1 < count { drawn } else { 0 } | brush,
                u: 0.13 * i as f32 - 0.2,
                pressure: random.unit(),
            });
            px = px.map(|at| at + 18.0 * (random.unit() - 0.5));
        }
    }
    points[1].px = points[0].px;
    points
}

/// Straight lines across the frame at all depths of the scene, some as rings and some brushed; the last one fills the
/// list up.
pub fn sampled_lines() -> (Vec<SampledLine>, Vec<SpineSample>) {
    let mut random = Random::new(31);
    let (mut lines, mut samples) = (Vec::new(), Vec::new());
    for number in 0..60 {
        let is_filling = number == 59;
        let count = 2 * (1 + number * 7 % 50);
        let from = FRAME_PX.map(|side| (1.2 * random.unit() - 0.1) * side as f32);
        let along = [random.unit() - 0.5, random.unit() - 0.5];
        let (depth, deeper) = (3.0 + 9.0 * random.unit(), 0.02 * random.unit());
        lines.push(SampledLine {
            first: samples.len() as u32,
            count,
            step_px: 0.9,
            ink_flags: (number % 4) << InkPoint::BRUSH_SHIFT,
            u_start: random.unit(),
            u_per_px: 0.05,
            full_half_width: 3.0,
            bits: (number * 5 % 16) | ((number % 2) << SampledLine::WIDTH_SHIFT),
        });
        samples.extend((0..count).map(|i| {
            let spine_px = [0, 1].map(|axis| from[axis] + i as f32 * along[axis]);
            SpineSample {
                spine_px,
                depth: depth + deeper * i as f32,
                line: number,
                px: spine_px.map(|at| at + 0.3),
                half_width: if is_filling {
                    0.0
                } else {
                    0.2 + 3.0 * random.unit()
                },
                color: 0xff00_0000 | number,
            }
        }));
    }
    (lines, samples)
}

/// Tapers, short lines and pressure, of which all take part in [`sampled_lines`].
const PRESSED: PartWidth = PartWidth {
    along: [[0.5, 1.0, 0.75, 1.0]; 8],
    taper_px: [12.0, 30.0],
    taper_share: 0.4,
    tip: 0.1,
    short_px: 20.0,
    speck_px: 4.0,
    at_all_ends: 0,
    radius: 1,
};

/// The widths that [`sampled_lines`] name in turns.
pub const PART_WIDTHS: [PartWidth; 2] = [
    PRESSED,
    PartWidth {
        along: [[0.25, 0.5, 1.0, 1.0]; 8],
        taper_px: [20.0, 5.0],
        at_all_ends: 1,
        ..PRESSED
    },
];

/// A pen, a dry brush, an airbrush and a brush that is a picture of odd sides.
fn brushes(store: &mut TextureStore) -> Vec<Brush> {
    let picture: Vec<u8> = (0..37 * 5 * 4).map(|i| (i * i % 251) as u8).collect();
    let images = [
        Tip::DryBrush.image(),
        Tip::Airbrush.image(),
        BrushImage::from_picture([37, 5], &picture).ok(),
    ];
    let numbers = [[1.3, 0.4, 0.1], [0.0, 0.0, 1.0], [0.6, 0.8, 0.5]];
    let mut brushes = vec![Brush::default()];
    for (image, [dry, grain, soft]) in images.into_iter().flatten().zip(numbers) {
        let [texels_along, texels_across] = image.size();
        brushes.push(Brush {
            start: store.add_words(&image.words()).unwrap(),
            texels_along,
            texels_across,
            levels: image.levels(),
            dry,
            grain,
            soft,
            spots_per_px: 0.4,
        });
    }
    brushes
}

/// Settings of smoke of a look: smoothed on grids with drawn lines, or in windows with published ones.
pub fn smoke_look(look: Look, size: [u32; 2]) -> SmokeLook {
    let is_ours = look == Look::Ours;
    let mut ramp = [[1.0, 1.0, 1.0, 2.0]; 8];
    ramp[0] = [0.2, 0.2, 0.4, 0.0];
    ramp[1] = [0.6, 0.5, 0.4, 0.3];
    ramp[2] = [0.9, 0.9, 0.8, 0.6];
    let mut settings = SmokeLook {
        layers: 4,
        flags: if is_ours { 0 } else { SmokeLook::PUBLISHED },
        range_start: 2.6,
        range_size: 0.8,
        range_blend: if is_ours { 0.5 } else { 0.0 },
        softness: 0.02,
        heat: 0.3,
        wrap: if is_ours { 0.5 } else { 0.0 },
        line_px: 2.5,
        line_inner: 0.5,
        line_from: 0.3,
        line_weight: 20.0,
        depth_start: 2.6,
        depth_size: 3.2,
        swell: 0.3,
        alpha: 0.9,
        line_color: [0.1, 0.05, 0.0, 0.9],
        towards_light: [-0.5, 0.7, -0.5],
        ambient: 0.1,
        samples: if is_ours { 2 } else { 1 },
        shadow_side: SHADOW_SIDE,
        surface_maps: SHADOWS,
        surface_side: SHADOW_SIDE,
        ramp,
        ..SmokeLook::default()
    };
    if is_ours {
        // The last pass finishes what tells of tones.
        (settings.ramp, settings.softness) = (pen::TONES, 0.5);
        let [r, g, b] = pen::OUTLINE;
        settings.line_color = [r, g, b, 0.9];
    }
    settings.smooth(size, if is_ours { 7.0 } else { 1.2 });
    settings
}
