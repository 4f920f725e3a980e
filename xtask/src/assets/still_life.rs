//! Tea for one: the still life of the front page.

use glam::{Mat3, Vec2, Vec3};

use super::book::{BookPaint, book};
use super::cloth::{Drape, cloth};
use super::crockery::{BottlePaint, bottle, bowl, cup, saucer};
use super::fruit::{FruitPaint, apple, grapes, lemon, orange, pear};
use super::prism::{cuboid, slab};
use super::scene::{Scene, View};
use super::teapot::teapot;

/// The z of the table's front edge, in centimetres.
const TABLE_EDGE: f32 = 22.0;

/// A table with a teapot, a cup, fruit, books and a bottle, in 16:9.
pub fn still_life() -> Scene {
    let view = View {
        eye: Vec3::new(5.0, 32.0, 98.0),
        target: Vec3::new(-0.5, 5.8, 0.0),
        fov: 25.0_f32.to_radians(),
        aspect: 16.0 / 9.0,
    };
    let mut scene = Scene::new(view, Vec3::new(0.6, -0.85, -0.65));
    lay_table(&mut scene);
    serve_tea(&mut scene);
    serve_fruit(&mut scene);
    stack_books(&mut scene);
    scene
}

/// Wall, table and cloth.
fn lay_table(scene: &mut Scene) {
    // Mix the paints.
    let wall = scene.material("Wall", 0xc6d6d0);
    let wood = scene.material("Wood", 0xb9824f);
    let linen = scene.material("Linen", 0xf5efe0);
    let stripe = scene.material("Stripe", 0xc2503f);

    // Stand wall and table behind each other.
    scene.stand(
        "Wall",
        cuboid(260.0, 160.0, 2.0, wall),
        [0.0, -80.0, -46.0],
        0.0,
    );
    let top = slab(104.0, 3.6, 56.0, 3.0, wood);
    scene.stand("Table", top, [0.0, -3.6, TABLE_EDGE - 28.0], 0.0);

    // Lay the cloth over the table's edge.
    let drape = Drape {
        size: Vec2::new(32.0, 32.0),
        middle: Vec2::new(-7.5, 6.0),
        turn: 0.72,
        edge: TABLE_EDGE,
    };
    scene.stand("Cloth", cloth(drape, linen, stripe), [0.0; 3], 0.0);
}

/// Teapot, cup and saucer.
fn serve_tea(scene: &mut Scene) {
    let glaze = scene.material("Glaze", 0x3f8f93);
    let china = scene.material("China", 0xf7f3ea);
    let tea = scene.material("Tea", 0xa4551f);
    scene.stand("Teapot", teapot(glaze), [-2.5, 0.3, 0.5], -156.0);
    scene.stand("Saucer", saucer(china, glaze), [-18.5, 0.3, 10.5], 0.0);
    scene.stand("Cup", cup(china, tea), [-18.5, 1.0, 10.5], 28.0);
}

/// Fruit in the bowl and beside it.
fn serve_fruit(scene: &mut Scene) {
    let stem = scene.material("Stem", 0x6b4a2e);
    let leaf = scene.material("Leaf", 0x5d8a3c);
    let skin = scene.material("PearSkin", 0xc7b544);
    let yellow = scene.material("LemonSkin", 0xf0cf45);
    let pear_paint = FruitPaint { skin, stem, leaf };
    fill_bowl(scene, pear_paint);
    scene.stand("Pear", pear(pear_paint), [11.5, 0.0, 11.0], 0.0);
    scene.stand("Lemon", lemon(yellow), [20.5, 3.1, 14.0], 28.0);
}

/// The bowl with two apples, an orange, a pear, and grapes over its rim.
fn fill_bowl(scene: &mut Scene, pear_paint: FruitPaint) {
    let stoneware = scene.material("Stoneware", 0x49688c);
    scene.stand("Bowl", bowl(stoneware), [23.0, 0.0, -3.0], 0.0);
    let mut paint = |name, srgb| FruitPaint {
        skin: scene.material(name, srgb),
        ..pear_paint
    };
    let red = paint("AppleSkin", 0xc93c36);
    let tangy = paint("OrangeSkin", 0xe88a2d);
    let purple = paint("GrapeSkin", 0x6d4a7d);
    let turned_away = tilt(10.0, 16.0) * Mat3::from_rotation_y(2.2);
    scene.add("Apple", apple(red), [16.9, 5.3, -3.2], turned_away);
    let towards_us = tilt(24.0, 16.0);
    scene.add("AppleInFront", apple(red), [22.6, 5.6, 0.4], towards_us);
    let stem_up = tilt(35.0, -25.0);
    scene.add("Orange", orange(tangy), [28.4, 8.6, -4.6], stem_up);
    let leaning = tilt(-4.0, -8.0);
    scene.add("PearInBowl", pear(pear_paint), [23.2, 4.6, -8.6], leaning);
    scene.add("Grapes", grapes(purple), [28.2, 11.0, 4.2], tilt(0.0, 8.0));
}

/// Two books, a bottle beside them.
fn stack_books(scene: &mut Scene) {
    // Bind two books.
    let pages = scene.material("Pages", 0xefe4c8);
    let bands = scene.material("Gilding", 0xd9b25a);
    let mut bound = |name, srgb| BookPaint {
        cover: scene.material(name, srgb),
        pages,
        bands,
    };
    let wine = bound("WineCover", 0x8f3a3d);
    let moss = bound("MossCover", 0x5f7348);

    // Lay one on the other, turned a little.
    scene.stand(
        "BookBelow",
        book(Vec3::new(16.0, 3.4, 22.0), wine),
        [-28.5, 0.0, -9.0],
        66.0,
    );
    scene.stand(
        "BookAbove",
        book(Vec3::new(13.5, 2.6, 19.0), moss),
        [-28.0, 3.4, -9.5],
        80.0,
    );

    // Stand the bottle beside them.
    let paint = BottlePaint {
        glass: scene.material("Glass", 0x3f6b52),
        cork: scene.material("Cork", 0xc79b68),
        label: scene.material("Label", 0xf1e8d2),
        print: wine.cover,
    };
    scene.stand("Bottle", bottle(paint), [-13.0, 0.0, -15.0], 14.0);
}

/// A turn about x, then about z, in degrees.
fn tilt(x: f32, z: f32) -> Mat3 {
    Mat3::from_rotation_z(z.to_radians()) * Mat3::from_rotation_x(x.to_radians())
}
