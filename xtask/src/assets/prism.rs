//! Outlines given a height: boxes, boards, page blocks.

use glam::{Vec2, Vec3};

use super::pen::{Path, rounded_rectangle};
use super::shape::{Paint, Shape, Vertex};

/// The solid over a closed counter-clockwise `outline` in (x, -z), from height `floor` to `top`.
///
/// Crisp at both rims. The outline must be seen whole from its mean point, where the lids meet.
pub fn prism(outline: &Path, floor: f32, top: f32, paint: Paint) -> Shape {
    loft(outline, &[(1.0, floor), (1.0, top)], paint)
}

/// The solid through scaled copies of a closed counter-clockwise `outline`, each (scale, height).
pub fn loft(outline: &Path, levels: &[(f32, f32)], paint: Paint) -> Shape {
    let count = outline.points.len();
    let middle = outline.points.iter().sum::<Vec2>() / count as f32;
    let ends = [levels[0].1, levels[levels.len() - 1].1];
    let rows: Vec<(f32, f32)> = std::iter::once((0.0, ends[0]))
        .chain(levels.iter().copied())
        .chain([(0.0, ends[1])])
        .collect();
    let last_row = (rows.len() - 1) as f32;
    // Columns run clockwise seen from above, because that is how angles grow from x to z.
    Shape::grid(rows.len() as u32, count as u32 + 1, paint, |row, column| {
        let (scale, height) = rows[row as usize];
        let corner = outline.points[(count - column as usize % count) % count];
        let place = middle + (corner - middle) * scale;
        Vertex {
            position: Vec3::new(place.x, height, -place.y + 0.0),
            uv: Vec2::new(column as f32 / count as f32, row as f32 / last_row),
        }
    })
}

/// A crisp box of the given size, standing on y = 0 about the y axis: twelve triangles.
pub fn cuboid(width: f32, height: f32, depth: f32, paint: Paint) -> Shape {
    let half = Vec3::new(width / 2.0, height / 2.0, depth / 2.0);
    let sides = [
        Vec3::X,
        Vec3::NEG_X,
        Vec3::Y,
        Vec3::NEG_Y,
        Vec3::Z,
        Vec3::NEG_Z,
    ];
    sides.iter().fold(Shape::default(), |shape, &outwards| {
        // Any axis across the face will do for `right`; the cross product fixes the winding.
        let right = if outwards.x == 0.0 { Vec3::X } else { Vec3::Y };
        let up = outwards.cross(right);
        shape.join(Shape::grid(2, 2, paint, |row, column| {
            let uv = Vec2::new(row as f32, column as f32);
            let [across, along] = [uv.x * 2.0 - 1.0, uv.y * 2.0 - 1.0];
            let corner = outwards + right * across + up * along;
            Vertex {
                position: corner * half + Vec3::Y * half.y,
                uv,
            }
        }))
    })
}

/// A slab with round corners seen from above and crisp rims, standing on y = 0.
pub fn slab(width: f32, height: f32, depth: f32, corner: f32, paint: Paint) -> Shape {
    prism(
        &rounded_rectangle(width, depth, corner, 8),
        0.0,
        height,
        paint,
    )
}

#[cfg(test)]
mod tests {
    use super::super::shape::{open_edge_count, volume};
    use super::*;

    #[test]
    fn a_cuboid_is_closed_and_holds_what_it_should() {
        let shape = cuboid(2.0, 3.0, 4.0, Paint(0));
        assert_eq!(open_edge_count(&shape), 0);
        assert!(
            (volume(&shape) - 24.0).abs() < 1e-4,
            "volume {}",
            volume(&shape)
        );
        assert_eq!(shape.triangles.len(), 12);
    }

    #[test]
    fn a_slab_is_closed_and_outside_out() {
        let shape = slab(10.0, 2.0, 4.0, 1.0, Paint(0));
        assert_eq!(open_edge_count(&shape), 0);
        assert!(
            (volume(&shape) - 78.28).abs() < 0.1,
            "volume {}",
            volume(&shape)
        );
    }
}
