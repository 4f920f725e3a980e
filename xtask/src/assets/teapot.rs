//! A teapot of our own: turned body and lid, swept spout and handle.

use glam::Vec2;
use npr_core::math;

use super::pen::Path;
use super::shape::{Paint, Shape};
use super::tube::{Station, stations, tube};
use super::turned::turned;

/// Columns around body and lid.
const SEGMENTS: u32 = 48;

/// A teapot about 14 cm high standing on y = 0; the spout points along +x.
///
/// Four closed parts that sink into each other a little, as clay parts do where they are joined.
pub fn teapot(glaze: Paint) -> Shape {
    turned(&body(), SEGMENTS, glaze)
        .join(turned(&lid(), SEGMENTS, glaze))
        .join(tube(&spout(), 24, glaze))
        .join(tube(&handle(), 18, glaze))
}

/// Half the outline of the body, foot to rim.
fn body() -> Path {
    Path::start(0.0, 0.4)
        .line(3.5, 0.4)
        .line(3.7, 0.0)
        .line(4.3, 0.0)
        .curve([[4.4, 0.3], [4.15, 0.4], [4.2, 0.7]], 3)
        .curve([[6.2, 1.2], [7.7, 3.0], [7.7, 5.1]], 12)
        .curve([[7.7, 7.3], [6.4, 9.0], [4.9, 9.6]], 12)
        .curve([[4.6, 9.72], [4.5, 9.95], [4.65, 10.15]], 3)
        .curve([[4.75, 10.35], [4.5, 10.45], [4.3, 10.35]], 4)
        .line(0.0, 9.9)
}

/// Half the outline of the lid, seat to knob.
fn lid() -> Path {
    Path::start(0.0, 10.1)
        .line(4.2, 10.1)
        .curve([[4.35, 10.3], [4.3, 10.6], [4.05, 10.7]], 4)
        .curve([[3.1, 11.25], [1.5, 11.4], [0.85, 11.8]], 10)
        .curve([[0.55, 12.0], [0.55, 12.25], [0.85, 12.4]], 5)
        .curve([[1.7, 12.75], [1.35, 13.9], [0.0, 13.9]], 12)
}

/// Cross-sections of the spout: wide where it leaves the body, and hollow at the tip.
fn spout() -> Vec<Station> {
    // Taper the spout along its path, with a lip at the end.
    let path = Path::start(5.6, 3.5).curve([[10.6, 3.4], [8.9, 8.3], [12.6, 10.3]], 22);
    let outside = stations(&path, |along| {
        let taper = math::smoothstep(-0.1, 0.8, along);
        let lip = 0.14 * math::smoothstep(0.88, 1.0, along);
        [
            math::mix(2.5, 0.78, taper) + lip,
            math::mix(1.75, 0.7, taper) + lip,
        ]
    });

    // Hollow its tip.
    let tip = outside[outside.len() - 1];
    let hollow = |depth: f32, radius: f32| Station {
        centre: tip.centre - tip.tangent * depth,
        radii: Vec2::splat(radius),
        ..tip
    };
    outside
        .into_iter()
        .chain([hollow(0.0, 0.62), hollow(1.6, 0.5)])
        .collect()
}

/// Cross-sections of the handle: an ear, thicker where it meets the body.
fn handle() -> Vec<Station> {
    let path = Path::start(-5.4, 8.2)
        .curve([[-8.4, 10.7], [-13.3, 10.4], [-12.9, 6.9]], 16)
        .curve([[-12.6, 4.4], [-9.6, 3.3], [-6.4, 2.7]], 14);
    stations(&path, |along| {
        let root = (2.0 * along - 1.0).abs();
        let thick = 0.25 * math::smoothstep(0.6, 1.0, root);
        [0.58 + thick, 0.82 + thick]
    })
}

#[cfg(test)]
mod tests {
    use super::super::shape::{open_edge_count, volume};
    use super::*;

    #[test]
    fn the_teapot_is_watertight_and_of_moderate_size() {
        let shape = teapot(Paint(0));
        assert_eq!(open_edge_count(&shape), 0);
        assert!(
            volume(&shape) > 1000.0,
            "about a litre and a bit: {}",
            volume(&shape)
        );
        assert!(
            (6_000..=9_000).contains(&shape.triangles.len()),
            "{}",
            shape.triangles.len()
        );
    }
}
