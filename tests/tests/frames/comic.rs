//! Hatching keeps its size on screen: near and far balls under the same pen [Suzuki 2004, figure 3.14].

use npr_core::camera::{Camera, Projection};
use npr_core::math::{cos, sin};
use npr_gpu::processor::Processor;
use npr_render::{Frame, Model};
use npr_scene::{Node, Part, Scene};
use npr_stylesheet::Style;
use npr_tests::draw_on;
use std::f32::consts::{PI, TAU};

/// How much farther than the near ball the far ones are.
const RATIOS: [f32; 9] = [1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 11.0, 16.0];

const SIZE: [u32; 2] = [1600, 800];

/// Distance of the near ball, whose radius is 1.
const NEAR: f32 = 8.0;

/// Half the height of the picture at distance 1: the near ball fills 4/5 of the left half.
const TAN_HALF: f32 = 1.0 / (NEAR * 0.8);

/// The part of a ball's radius, seen from its middle, that is measured.
const MIDDLE: f32 = 0.6;

/// How much period and width may differ from those of the near ball.
const TOLERANCE: f32 = 0.15;

/// Where a ball stands in the picture.
#[derive(Debug, Clone, Copy)]
struct Ball {
    center: [f32; 3],
    /// Turn about its upright axis, in radians, so that no two show the same strokes.
    turn: f32,
}

impl Ball {
    /// A ball at `distance`, whose middle shows at `at`, in half heights of the picture from its middle.
    fn seen_at([x, y]: [f32; 2], distance: f32, turn: f32) -> Self {
        let reach = TAN_HALF * distance;
        Self {
            center: [x * reach, y * reach, -distance],
            turn,
        }
    }

    /// Middle and radius in the picture, in pixels.
    fn disc(&self) -> ([f32; 2], f32) {
        let [x, y, z] = self.center;
        let scale = SIZE[1] as f32 * 0.5 / (TAN_HALF * -z);
        let middle = SIZE.map(|side| side as f32 * 0.5);
        ([middle[0] + x * scale, middle[1] - y * scale], scale)
    }

    /// The ball with UV coordinates, all of it lit from the side alike: every normal looks at the eye.
    fn part(&self) -> Part {
        const COLUMNS: u32 = 96;
        const ROWS: u32 = 48;
        let mut part = Part::default();
        let mut uvs = Vec::new();
        for row in 0..=ROWS {
            for column in 0..=COLUMNS {
                let [u, v] = [column as f32 / COLUMNS as f32, row as f32 / ROWS as f32];
                let (around, down) = (u * TAU + self.turn, v * PI);
                let unit = [sin(down) * cos(around), cos(down), -sin(down) * sin(around)];
                part.positions
                    .push(std::array::from_fn(|i| self.center[i] + unit[i]));
                uvs.push([u, v]);
            }
        }
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let a = row * (COLUMNS + 1) + column;
                let b = a + COLUMNS + 1;
                part.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
            }
        }
        part.normals = Some(vec![[0.0, 0.0, 1.0]; part.positions.len()]);
        part.uvs = Some(uvs);
        part
    }
}

/// A ball near by, then as many far ones as find room beside it, sixteen at most.
fn balls(ratio: f32) -> Vec<Ball> {
    let side = (ratio as u32).clamp(1, 4);
    let near = Ball::seen_at([-1.0, 0.0], NEAR, 0.4);
    let far = (0..side * side).map(|i| {
        let at = |k: u32| (2.0 * k as f32 + 1.0) / side as f32;
        let place = [at(i % side), at(i / side) - 1.0];
        Ball::seen_at(place, NEAR * ratio, 1.1 + i as f32)
    });
    std::iter::once(near).chain(far).collect()
}

fn scene_of_balls(balls: &[Ball]) -> Scene {
    let meshes = balls.iter().map(|ball| npr_scene::Mesh {
        name: "ball".to_owned(),
        parts: vec![ball.part()],
    });
    Scene {
        nodes: (0..balls.len() as u32)
            .map(|mesh| Node {
                name: format!("ball {mesh}"),
                mesh: Some(mesh),
                ..Node::default()
            })
            .collect(),
        meshes: meshes.collect(),
        ..Scene::default()
    }
}

/// Strokes alone in a tone that inks half the paper.
fn style(mapping: &str) -> Style {
    let mut style = Style::preset("crosshatch").unwrap();
    let settings = [
        &format!("ink.mapping={mapping}"),
        "ink.hatch.pattern=parallel",
        "ink.hatch.spacing=6px",
        "ink.hatch.angle_deg=0",
        "ink.dark_at=0",
        "ink.light_at=1",
        "ink.color=#000000",
        "shade.paper=#ffffff",
        "background=#ffffff",
        "light.direction=[1.0, 0.0, 0.0]",
        "line.method=none",
    ];
    for setting in settings {
        style.set(setting).unwrap();
    }
    style
}

/// Mean distance and width of strokes, in pixels.
#[derive(Debug, Clone, Copy)]
struct Strokes {
    period: f32,
    width: f32,
}

/// Strokes in the middles of some balls, whatever their direction.
///
/// Lines cross a curve 2 / pi times for every length of it in the unit of area [Cauchy-Crofton], here lines along rows,
/// columns and both diagonals; a stroke has two sides.
fn strokes_in(frame: &Frame, balls: &[Ball]) -> Strokes {
    const STEPS: [([i32; 2], f32); 4] = [
        ([1, 0], 1.0),
        ([0, 1], 1.0),
        ([1, 1], std::f32::consts::SQRT_2),
        ([1, -1], std::f32::consts::SQRT_2),
    ];
    let inked = |x: i32, y: i32| frame.rgba[((y * SIZE[0] as i32 + x) * 4) as usize] < 188;
    let (mut pixels, mut ink, mut crossings) = (0.0, 0.0, 0.0);
    for ball in balls {
        let (middle, radius) = ball.disc();
        let reach = radius * MIDDLE;
        let range = |i: usize| (middle[i] - reach).ceil() as i32..(middle[i] + reach) as i32;
        for (x, y) in range(1).flat_map(|y| range(0).map(move |x| (x, y))) {
            let off = [x as f32 + 0.5 - middle[0], y as f32 + 0.5 - middle[1]];
            if off[0] * off[0] + off[1] * off[1] > reach * reach {
                continue;
            }
            pixels += 1.0;
            ink += f32::from(u8::from(inked(x, y)));
            for ([dx, dy], length) in STEPS {
                let crosses = inked(x, y) != inked(x + dx, y + dy);
                crossings += f32::from(u8::from(crosses)) / length;
            }
        }
    }
    let sides = crossings / STEPS.len() as f32 * PI / 2.0 / pixels;
    Strokes {
        period: 2.0 / sides,
        width: ink / pixels * 2.0 / sides,
    }
}

fn compare(mapping: &str) {
    let style = style(mapping);
    let mut failures = Vec::new();
    for ratio in RATIOS {
        let balls = balls(ratio);
        let model = Model::new(&scene_of_balls(&balls)).unwrap();
        let camera = Camera {
            eye: [0.0; 3],
            target: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective {
                fov_y: 2.0 * npr_core::math::atan(TAN_HALF),
            },
        };
        let frame = draw_on(&Processor, &model, &style, &camera, SIZE);
        let [near, far] = [&balls[..1], &balls[1..]].map(|some| strokes_in(&frame, some));
        let [period, width] = [far.period / near.period, far.width / near.width];
        println!("{mapping}, {ratio} times as far: {near:.2?}, {far:.2?}: {period:.3}, {width:.3}");
        if (period - 1.0).abs().max((width - 1.0).abs()) > TOLERANCE {
            failures.push((ratio, period, width));
        }
    }
    assert!(failures.is_empty(), "{mapping}: {failures:?}");
}

#[test]
fn strokes_on_the_surface_keep_their_size() {
    compare("surface");
}

#[test]
fn strokes_by_uv_coordinates_keep_their_size() {
    compare("uv");
}

#[test]
fn strokes_on_the_picture_keep_their_size() {
    compare("screen");
}
