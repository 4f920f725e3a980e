//! Grass and hair: pieces that a draughtsman draws by one line each.

use glam::{Mat3, Vec2, Vec3};
use npr_core::math;

use super::pen::Path;
use super::prism::slab;
use super::scene::{Scene, View};
use super::shape::{Paint, Shape, Vertex};
use super::tube::{stations, tube};
use super::turned::ball;

/// The object of open strips.
pub const GRASS: &str = "Grass";

/// Turn from one blade or lock to the next: the golden angle, by which none lies over another.
const TURN: f32 = 2.399_963;

/// Rows of points of a blade.
const BLADE_ROWS: u32 = 9;

/// A tuft of grass beside a stone, and a puppet's head with hair; the blades are open strips, the locks closed tubes.
pub fn tuft() -> Scene {
    let view = View {
        eye: Vec3::new(4.0, 17.0, 62.0),
        target: Vec3::new(0.5, 8.5, 0.0),
        fov: 26.0f32.to_radians(),
        aspect: 16.0 / 9.0,
    };
    let mut scene = Scene::new(view, Vec3::new(0.5, -0.9, -0.75));
    let ground = scene.material("Ground", 0xd9c9a3);
    let grass = scene.double_sided_material(GRASS, 0x7fa650);
    let stone = scene.material("Stone", 0xa9a59c);
    let skin = scene.material("Skin", 0xeac7a4);
    let hair = scene.material("Hair", 0x6b4a34);

    scene.stand(
        "Ground",
        slab(120.0, 2.0, 60.0, 1.0, ground),
        [0.0, -2.0, -8.0],
        0.0,
    );
    scene.stand(GRASS, blades(grass), [-12.0, 0.0, 0.0], 0.0);
    let lump = ball(5.0, 26, stone).warp(|p| Vec3::new(p.x * 1.3, p.y * 0.7 + 2.0, p.z));
    scene.stand("Stone", lump, [-3.5, 0.0, 4.0], 0.0);
    scene.stand("Head", head(skin), [13.0, 0.0, 0.0], 0.0);
    scene.stand("Hair", locks(hair), [13.0, 9.5, 0.0], 0.0);
    scene
}

/// Twelve blades from one root, that bow outwards and turn about themselves.
fn blades(paint: Paint) -> Shape {
    let blade = |number: u32| {
        let share = (number as f32 + 0.5) / 12.0;
        let (height, lean) = (17.0 - 7.0 * share, 1.5 + 9.0 * share);
        let twist = 0.5 * math::sin(number as f32 * 1.7);
        let strip = Shape::grid(BLADE_ROWS, 2, paint, |row, column| {
            let t = row as f32 / (BLADE_ROWS - 1) as f32;
            let (side, half) = (2.0 * column as f32 - 1.0, 0.45 * (1.0 - 0.96 * t * t));
            let turned = twist * t;
            let across = Vec3::new(math::cos(turned), 0.0, math::sin(turned)) * (side * half);
            let bow = Vec3::new(0.0, height * t * (1.0 - 0.25 * share * t), lean * t * t);
            Vertex {
                position: bow + across,
                uv: Vec2::new(column as f32, t),
            }
        });
        let angle = TURN * number as f32;
        let root = Vec3::new(math::sin(angle), 0.0, math::cos(angle)) * (1.6 * share.sqrt());
        strip.placed(Mat3::from_rotation_y(angle), root - Vec3::Y * 0.4)
    };
    (0..12).fold(Shape::default(), |tuft, number| tuft.join(blade(number)))
}

/// A ball on a neck.
fn head(paint: Paint) -> Shape {
    let neck = ball(2.2, 20, paint).warp(|p| Vec3::new(p.x, p.y * 1.6 + 2.6, p.z));
    ball(5.0, 32, paint).warp(|p| p + Vec3::Y * 9.5).join(neck)
}

/// Tapered locks over a ball of radius 5, from its crown outwards and down.
fn locks(paint: Paint) -> Shape {
    let lock = |number: u32| {
        let longer = 0.5 + 0.5 * math::sin(number as f32 * 2.3);
        let path = Path::start(0.2, 5.2).curve(
            [[3.4, 6.2], [6.4, 3.6], [6.6 + longer, -0.5 - 2.5 * longer]],
            14,
        );
        let strand = stations(&path, |t| [0.35 * (1.02 - t), 0.55 * (1.02 - t)]);
        let turn = Mat3::from_rotation_y(TURN * number as f32);
        tube(&strand, 6, paint).placed(turn, Vec3::ZERO)
    };
    (0..14).fold(Shape::default(), |hair, number| hair.join(lock(number)))
}
