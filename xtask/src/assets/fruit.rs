//! Apples, pears, oranges, lemons and grapes, with stems and leaves.

use glam::{Mat3, Vec2, Vec3, Vec3Swizzles};
use npr_core::math;

use super::pen::Path;
use super::shape::{Paint, Shape};
use super::sheet::{Weave, sheet};
use super::tube::{stations, tube};
use super::turned::{ball, turned};

/// Columns around a fruit.
const SEGMENTS: u32 = 36;

/// Grapes in a bunch.
const BERRY_COUNT: u32 = 22;

/// What a fruit is painted with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FruitPaint {
    /// The skin.
    pub skin: Paint,
    /// The stem.
    pub stem: Paint,
    /// The leaf.
    pub leaf: Paint,
}

/// An apple, 8 cm across, with five soft lobes towards the flower end, a stem and a leaf.
pub fn apple(paint: FruitPaint) -> Shape {
    let profile = Path::start(0.0, 0.9)
        .curve([[0.7, 0.7], [0.8, 0.0], [1.7, 0.0]], 6)
        .curve([[3.2, 0.0], [4.2, 2.3], [4.2, 4.3]], 11)
        .curve([[4.2, 6.6], [2.9, 7.7], [1.7, 7.5]], 11)
        .curve([[0.9, 7.35], [0.5, 6.6], [0.0, 6.3]], 7);
    let flesh = turned(&profile, SEGMENTS, paint.skin).warp(lobes);
    let leaf = leaf(4.6, paint.leaf).placed(
        Mat3::from_rotation_y(0.6) * Mat3::from_rotation_z(0.35),
        Vec3::new(0.3, 8.0, 0.0),
    );
    flesh.join(stem(6.1, paint.stem)).join(leaf)
}

/// A pear, 11 cm high, its neck leaning a little along +x.
pub fn pear(paint: FruitPaint) -> Shape {
    let profile = Path::start(0.0, 0.5)
        .curve([[0.6, 0.4], [0.8, 0.0], [1.5, 0.0]], 5)
        .curve([[3.4, 0.0], [4.3, 1.9], [4.1, 4.1]], 12)
        .curve([[3.9, 6.4], [2.2, 6.9], [1.85, 9.0]], 14)
        .curve([[1.6, 10.5], [0.9, 10.9], [0.0, 10.6]], 8);
    let upright = turned(&profile, SEGMENTS, paint.skin).join(stem(10.2, paint.stem));
    upright.warp(|p| p + Vec3::X * (0.011 * p.y * p.y))
}

/// An orange about its centre, 7.6 cm across, flattened, with a dimple at the stem.
pub fn orange(paint: FruitPaint) -> Shape {
    let flesh = ball(3.8, SEGMENTS, paint.skin).warp(|p| {
        let dimple = 0.45 * math::smoothstep(3.0, 3.8, p.y);
        Vec3::new(p.x, 0.93 * p.y - dimple, p.z)
    });
    let button = Path::start(0.0, 2.9)
        .line(0.42, 2.95)
        .line(0.3, 3.2)
        .line(0.0, 3.25);
    flesh.join(turned(&button, 12, paint.stem))
}

/// A lemon about its centre, 9 cm long along x.
pub fn lemon(skin: Paint) -> Shape {
    let profile = Path::start(0.0, -4.5)
        .curve([[0.8, -4.5], [0.7, -3.9], [1.2, -3.5]], 6)
        .curve([[2.5, -2.6], [3.1, -1.4], [3.1, 0.0]], 10)
        .curve([[3.1, 1.4], [2.5, 2.7], [1.1, 3.4]], 10)
        .curve([[0.7, 3.65], [0.6, 4.1], [0.0, 4.1]], 6);
    turned(&profile, SEGMENTS, skin).placed(
        Mat3::from_rotation_z(-std::f32::consts::FRAC_PI_2),
        Vec3::ZERO,
    )
}

/// A bunch of grapes that hangs from the origin down along -y and leans out along +z.
pub fn grapes(paint: FruitPaint) -> Shape {
    let berries =
        (0..BERRY_COUNT).map(|i| ball(1.05, 16, paint.skin).placed(Mat3::IDENTITY, berry(i)));
    let stalk = Path::start(0.0, -2.0).curve([[0.0, 0.0], [0.3, 1.2], [1.4, 1.7]], 8);
    berries.fold(
        tube(&stations(&stalk, |_| [0.16, 0.16]), 8, paint.stem),
        Shape::join,
    )
}

/// The place of a berry: on a spiral of golden angles that narrows downwards.
fn berry(index: u32) -> Vec3 {
    let fall = (index as f32 + 0.5) / BERRY_COUNT as f32;
    let angle = 2.399_963 * index as f32;
    let reach = 2.5 * (1.0 - fall) * math::smoothstep(-0.25, 0.2, fall) + 0.35;
    Vec3::new(
        reach * math::cos(angle),
        -0.3 - 6.6 * fall,
        reach * math::sin(angle) + 4.4 * fall,
    )
}

/// A bent stem that grows from height `root`.
fn stem(root: f32, bark: Paint) -> Shape {
    let path = Path::start(0.0, root).curve(
        [[0.0, root + 1.2], [0.15, root + 1.9], [0.7, root + 2.7]],
        8,
    );
    tube(
        &stations(&path, |along| [math::mix(0.16, 0.26, along); 2]),
        10,
        bark,
    )
}

/// A pointed leaf of a length in centimetres along +x, folded along its middle and drooping.
fn leaf(length: f32, green: Paint) -> Shape {
    let weave = Weave {
        rows: 15,
        columns: 7,
        thickness: 0.07,
    };
    sheet(weave, green, |uv: Vec2| {
        let along = uv.y;
        let half = 0.26 * length * leaf_width(along);
        let across = 2.0 * uv.x - 1.0;
        let droop = 0.5 * along * (1.0 - 1.6 * along) * length * 0.6;
        Vec3::new(
            length * along,
            droop + 0.35 * half * across.abs(),
            -half * across,
        )
    })
}

/// Width of a leaf, 0..1, at a fraction of its length; widest before the middle, nothing at both ends.
fn leaf_width(along: f32) -> f32 {
    let bent = math::powf(along.clamp(0.0, 1.0), 0.8);
    math::sin(std::f32::consts::PI * bent).max(0.0)
}

/// Pulls a place of the apple in and out five times around, most at the flower end.
fn lobes(p: Vec3) -> Vec3 {
    let angle = math::atan2(p.z, p.x);
    let low = 1.0 - math::smoothstep(0.0, 6.5, p.y);
    let swell = 1.0 + 0.05 * low * math::cos(5.0 * angle);
    let foot = 0.25 * low * low * (1.0 - math::cos(5.0 * angle));
    Vec3::new(
        p.x * swell,
        p.y + foot * math::smoothstep(0.6, 2.4, p.xz().length()),
        p.z * swell,
    )
}

#[cfg(test)]
mod tests {
    use super::super::shape::{open_edge_count, volume};
    use super::*;

    #[test]
    fn fruit_is_watertight_and_outside_out() {
        let p = Paint(0);
        let paint = FruitPaint {
            skin: p,
            stem: p,
            leaf: p,
        };
        for shape in [
            apple(paint),
            pear(paint),
            orange(paint),
            lemon(p),
            grapes(paint),
        ] {
            assert_eq!(open_edge_count(&shape), 0);
            assert!(volume(&shape) > 50.0, "{}", volume(&shape));
        }
        assert!(volume(&leaf(4.0, p)) > 0.0);
    }
}
