//! Bowl, cup, saucer and bottle.

use glam::Vec3;
use npr_core::math;

use super::pen::Path;
use super::shape::{Paint, Shape};
use super::sheet::{Weave, sheet};
use super::tube::{stations, tube};
use super::turned::turned;

/// A fruit bowl, 21 cm across and 8 cm high.
pub fn bowl(glaze: Paint) -> Shape {
    let profile = Path::start(0.0, 0.6)
        .line(3.4, 0.6)
        .line(3.6, 0.0)
        .line(4.3, 0.0)
        .curve([[4.35, 0.5], [4.0, 0.7], [4.1, 1.1]], 4)
        .curve([[7.4, 1.6], [10.1, 4.0], [10.6, 7.6]], 14)
        .curve([[10.66, 8.0], [10.3, 8.05], [10.15, 7.7]], 5)
        .curve([[9.4, 4.2], [6.2, 2.0], [0.0, 1.9]], 11);
    turned(&profile, 60, glaze)
}

/// A cup filled with tea, 9 cm across; its handle points along -x.
pub fn cup(glaze: Paint, tea: Paint) -> Shape {
    let wall = Path::start(0.0, 0.4)
        .line(1.9, 0.4)
        .line(2.0, 0.0)
        .line(2.5, 0.0)
        .curve([[2.55, 0.3], [2.3, 0.4], [2.4, 0.65]], 3)
        .curve([[4.1, 1.0], [4.3, 3.0], [4.8, 6.3]], 12)
        .curve([[4.83, 6.55], [4.6, 6.55], [4.53, 6.3]], 4)
        .curve([[4.05, 3.2], [3.4, 1.3], [0.0, 1.2]], 9);
    let drink = Path::start(0.0, 4.9)
        .line(4.25, 4.9)
        .line(4.38, 5.3)
        .line(0.0, 5.3);
    let ear = Path::start(-4.2, 5.2)
        .curve([[-6.0, 6.5], [-8.1, 5.4], [-7.1, 3.6]], 12)
        .curve([[-6.5, 2.5], [-5.2, 2.0], [-3.6, 1.9]], 10);
    turned(&wall, 46, glaze)
        .join(turned(&drink, 46, tea))
        .join(tube(&stations(&ear, |_| [0.3, 0.42]), 14, glaze))
}

/// A saucer, 16 cm across, with a ring in a second colour.
pub fn saucer(glaze: Paint, ring: Paint) -> Shape {
    let profile = Path::start(0.0, 0.4)
        .line(3.2, 0.4)
        .line(3.3, 0.0)
        .line(3.9, 0.0)
        .curve([[4.8, 0.6], [6.4, 0.7], [8.0, 1.7]], 10)
        .curve([[8.2, 1.9], [8.05, 2.0], [7.8, 1.9]], 4)
        .line(7.2, 1.55)
        .curve([[6.0, 1.05], [4.9, 0.75], [3.3, 0.7]], 8)
        .line(0.0, 0.7);
    let along = profile.fractions();
    let (inner, outer) = (1.0 - along[19], 1.0 - along[18]);
    turned(&profile, 60, glaze).repaint(ring, |uv| (inner..outer).contains(&uv.y))
}

/// The colours of a bottle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BottlePaint {
    /// The glass.
    pub glass: Paint,
    /// The cork.
    pub cork: Paint,
    /// The label.
    pub label: Paint,
    /// The frame and bar printed on the label.
    pub print: Paint,
}

/// A corked bottle, 25 cm high, its label towards +z.
pub fn bottle(paint: BottlePaint) -> Shape {
    let glass = Path::start(0.0, 1.6)
        .curve([[1.4, 1.6], [2.4, 1.0], [2.8, 0.0]], 6)
        .curve([[3.5, 0.0], [4.0, 0.3], [4.0, 1.2]], 6)
        .line(4.0, 12.5)
        .curve([[4.0, 16.6], [1.7, 15.8], [1.5, 19.8]], 18)
        .line(1.45, 22.0)
        .line(1.8, 22.1)
        .curve([[1.95, 22.3], [1.95, 23.1], [1.75, 23.3]], 5)
        .line(1.2, 23.4)
        .line(0.0, 23.2);
    let cork = Path::start(0.0, 22.8)
        .line(1.15, 22.8)
        .line(1.3, 25.0)
        .line(0.0, 25.05);
    turned(&glass, 48, paint.glass)
        .join(turned(&cork, 32, paint.cork))
        .join(label(paint))
}

/// A paper label around the front of a bottle of radius 4 cm.
fn label(paint: BottlePaint) -> Shape {
    let weave = Weave {
        rows: 21,
        columns: 19,
        thickness: 0.08,
    };
    let framed = |v: f32| (0.05..0.1).contains(&v) || (0.9..0.95).contains(&v);
    sheet(weave, paint.label, |uv| {
        let angle = 2.1 * (uv.x - 0.5);
        let (x, z) = (4.06 * math::sin(angle), 4.06 * math::cos(angle));
        Vec3::new(x, 11.2 - 7.4 * uv.y, z)
    })
    .repaint(paint.print, |uv| framed(uv.y) || (0.4..0.6).contains(&uv.y))
}

#[cfg(test)]
mod tests {
    use super::super::shape::open_edge_count;
    use super::*;

    #[test]
    fn crockery_is_watertight() {
        let p = Paint(0);
        let paint = BottlePaint {
            glass: p,
            cork: p,
            label: p,
            print: p,
        };
        for shape in [bowl(p), cup(p, p), saucer(p, p), bottle(paint)] {
            assert_eq!(open_edge_count(&shape), 0);
        }
    }
}
