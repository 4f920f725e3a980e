//! Thin closed sheets: cloth, leaves, labels.

use glam::{Vec2, Vec3};

use super::shape::{Paint, Shape, Vertex};

/// How finely a sheet is cut, and how thick it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weave {
    /// Points along v.
    pub rows: u32,
    /// Points along u.
    pub columns: u32,
    /// Distance between the two faces in centimetres.
    pub thickness: f32,
}

/// A closed sheet whose upper face is `surface` over u and v in 0..1.
///
/// The upper face looks where d/dv x d/du points; the lower face lies one thickness behind it.
pub fn sheet(weave: Weave, paint: Paint, surface: impl Fn(Vec2) -> Vec3) -> Shape {
    let Weave {
        rows,
        columns,
        thickness,
    } = weave;

    // Place the upper face, and the lower one a thickness behind it.
    let uv = |row: u32, column: u32| {
        Vec2::new(
            column as f32 / (columns - 1) as f32,
            row as f32 / (rows - 1) as f32,
        )
    };
    let upper = |row, column| Vertex {
        position: surface(uv(row, column)),
        uv: uv(row, column),
    };
    let lower = |row, column| {
        let uv = uv(row, column);
        Vertex {
            position: surface(uv) - normal(&surface, uv) * thickness,
            uv,
        }
    };

    // Close the rim with a hem.
    let rim = rim_places(rows, columns);
    let hem = Shape::grid(2, rim.len() as u32, paint, |row, place| {
        let (r, c) = rim[place as usize];
        if row == 0 { lower(r, c) } else { upper(r, c) }
    });

    // Join the faces; the lower one is mirrored, so that it looks out.
    Shape::grid(rows, columns, paint, upper)
        .join(Shape::grid(rows, columns, paint, |row, column| {
            lower(row, columns - 1 - column)
        }))
        .join(hem)
}

/// The unit normal of `surface` by differences of one part in a thousand.
fn normal(surface: &impl Fn(Vec2) -> Vec3, uv: Vec2) -> Vec3 {
    let step = 1e-3;
    let along = |d: Vec2| surface(uv + d) - surface(uv - d);
    along(Vec2::Y * step)
        .cross(along(Vec2::X * step))
        .normalize_or_zero()
}

/// The border of a grid as (row, column), back to its first place, such that the hem faces outwards.
fn rim_places(rows: u32, columns: u32) -> Vec<(u32, u32)> {
    let (bottom, right) = (rows - 1, columns - 1);
    let top = (0..right).map(|c| (0, c));
    let far = (0..bottom).map(|r| (r, right));
    let back = (1..=right).rev().map(|c| (bottom, c));
    let near = (1..=bottom).rev().map(|r| (r, 0));
    top.chain(far)
        .chain(back)
        .chain(near)
        .chain([(0, 0)])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::shape::{open_edge_count, volume};
    use super::*;

    #[test]
    fn a_flat_sheet_is_a_closed_slab() {
        let weave = Weave {
            rows: 5,
            columns: 7,
            thickness: 0.5,
        };
        let shape = sheet(weave, Paint(0), |uv| Vec3::new(4.0 * uv.x, 0.0, 3.0 * uv.y));
        assert_eq!(open_edge_count(&shape), 0);
        assert!(
            (volume(&shape) - 6.0).abs() < 1e-3,
            "volume {}",
            volume(&shape)
        );
    }
}
