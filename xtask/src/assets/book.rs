//! Hardback books.

use glam::{Mat3, Vec3};

use super::pen::Path;
use super::prism::{cuboid, prism};
use super::shape::{Paint, Shape};

/// What a book is painted with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BookPaint {
    /// Boards and spine.
    pub cover: Paint,
    /// The page block.
    pub pages: Paint,
    /// The bands on the spine.
    pub bands: Paint,
}

/// A closed book lying on y = 0 about the y axis, its spine towards -x.
///
/// `size` is the width across the boards, the thickness and the height of the spine, in centimetres.
/// Round back, hollow fore edge, crisp boards that stand over the pages.
pub fn book(size: Vec3, paint: BookPaint) -> Shape {
    let Vec3 {
        x: width,
        y: thickness,
        z: length,
    } = size;

    // Cut the boards, and the bands of the back.
    let board = |floor: f32| {
        let middle = Vec3::new(width / 2.0 + 0.4, floor, 0.0);
        cuboid(width - 0.8, 0.3, length, paint.cover).placed(Mat3::IDENTITY, middle)
    };
    let band = |z: f32| lengthwise(&back(thickness, 0.06, 0.4), z - 0.4, z + 0.4, paint.bands);

    // Bind the pages between them.
    let half = length / 2.0;
    lengthwise(&back(thickness, 0.0, 0.9), -half, half, paint.cover)
        .join(lengthwise(
            &page_block(width, thickness),
            0.4 - half,
            half - 0.4,
            paint.pages,
        ))
        .join(board(0.05))
        .join(board(thickness - 0.35))
        .join(band(-0.32 * length))
        .join(band(0.32 * length))
        .placed(Mat3::IDENTITY, Vec3::NEG_X * (width / 2.0))
}

/// The rounded back seen from the foot of the book, grown by `margin`, as far as `reach` onto the boards.
fn back(thickness: f32, margin: f32, reach: f32) -> Path {
    let (floor, top) = (-margin, thickness + margin);
    let bulge = -0.9 - margin;
    Path::start(0.3, floor)
        .line(reach, floor)
        .line(reach, top)
        .line(0.3, top)
        .curve(
            [
                [bulge, thickness * 0.85],
                [bulge, thickness * 0.15],
                [0.3, floor],
            ],
            12,
        )
        .closed()
}

/// The pages seen from the foot of the book.
fn page_block(width: f32, thickness: f32) -> Path {
    let (floor, top, edge) = (0.3, thickness - 0.3, width - 0.5);
    let hollow = edge - 0.55;
    Path::start(0.3, floor)
        .line(edge, floor)
        .curve([[hollow, floor + 0.3], [hollow, top - 0.3], [edge, top]], 8)
        .line(0.3, top)
}

/// An outline in (x, y) extended along z.
fn lengthwise(outline: &Path, from: f32, to: f32, paint: Paint) -> Shape {
    prism(outline, from, to, paint).placed(
        Mat3::from_rotation_x(std::f32::consts::FRAC_PI_2),
        Vec3::ZERO,
    )
}

#[cfg(test)]
mod tests {
    use super::super::shape::{open_edge_count, volume};
    use super::*;

    #[test]
    fn a_book_is_made_of_closed_parts() {
        let paint = BookPaint {
            cover: Paint(0),
            pages: Paint(1),
            bands: Paint(2),
        };
        let shape = book(Vec3::new(15.0, 3.0, 21.0), paint);
        assert_eq!(open_edge_count(&shape), 0);
        assert!(
            volume(&shape) > 0.8 * 15.0 * 3.0 * 21.0,
            "{}",
            volume(&shape)
        );
    }
}
