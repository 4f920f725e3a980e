//! A cloth that lies on a table and falls over its front edge.

use glam::{Vec2, Vec3};
use npr_core::math;

use super::shape::{Paint, Shape};
use super::sheet::{Weave, sheet};

/// How a cloth lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drape {
    /// Size of the cloth in centimetres.
    pub size: Vec2,
    /// Where its middle lies, as (x, z) on the table top.
    pub middle: Vec2,
    /// Turn about the vertical in radians.
    pub turn: f32,
    /// The z of the table's front edge, over which the cloth falls.
    pub edge: f32,
}

/// How tightly the cloth bends around the edge, in centimetres.
const BEND: f32 = 1.2;

/// A cloth with two stripes along its hem, hanging in folds below the edge of the table.
pub fn cloth(drape: Drape, linen: Paint, stripe: Paint) -> Shape {
    let weave = Weave {
        rows: 49,
        columns: 49,
        thickness: 0.25,
    };
    let hem = |uv: Vec2| {
        let inset = uv.min(Vec2::ONE - uv).min_element() * 48.0;
        (2.0..4.0).contains(&inset) || (5.0..6.0).contains(&inset)
    };
    sheet(weave, linen, |uv| fallen(flat(drape, uv), drape.edge)).repaint(stripe, hem)
}

/// The place of a thread on the table, (x, z), as if the table went on forever.
fn flat(drape: Drape, uv: Vec2) -> Vec2 {
    let turn = Vec2::new(math::cos(drape.turn), math::sin(drape.turn));
    drape.middle + turn.rotate((uv - 0.5) * drape.size)
}

/// Bends a place (x, z) around the edge and lets what lies beyond hang in folds that open downwards.
fn fallen(place: Vec2, edge: f32) -> Vec3 {
    let beyond = (place.y - edge).max(0.0);
    let quarter = BEND * std::f32::consts::FRAC_PI_2;
    let angle = beyond.min(quarter) / BEND;
    let drop = (beyond - quarter).max(0.0);
    let fold = fold_depth(place.x) * math::smoothstep(0.0, 6.0, drop);
    let rest = 0.3 + 0.12 * math::sin(0.31 * place.x + 0.4) * math::sin(0.23 * place.y);
    let height = rest - BEND * (1.0 - math::cos(angle)) - drop;
    Vec3::new(
        place.x,
        height,
        place.y.min(edge) + BEND * math::sin(angle) + fold,
    )
}

/// How far the fold at `x` stands out from the table, 0..2.8 cm: two waves whose crests drift apart.
fn fold_depth(x: f32) -> f32 {
    1.4 + 1.1 * math::sin(0.72 * x + 0.2) + 0.3 * math::sin(1.57 * x)
}

#[cfg(test)]
mod tests {
    use super::super::shape::{open_edge_count, volume};
    use super::*;

    #[test]
    fn a_cloth_is_closed_and_hangs_below_the_table() {
        let drape = Drape {
            size: Vec2::splat(30.0),
            middle: Vec2::ZERO,
            turn: 0.7,
            edge: 10.0,
        };
        let shape = cloth(drape, Paint(0), Paint(1));
        assert_eq!(open_edge_count(&shape), 0);
        assert!(volume(&shape) > 150.0, "{}", volume(&shape));
        let lowest = shape
            .vertices
            .iter()
            .map(|v| v.position.y)
            .fold(0.0, f32::min);
        assert!(lowest < -8.0, "a corner hangs down to {lowest}");
    }
}
