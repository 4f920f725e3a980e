//! One number for a drawing: equal drawings have equal numbers.

use npr_vector::stroke::Drawing;

/// Start and factor of the digest.
const FNV: [u64; 2] = [0xcbf2_9ce4_8422_2325, 0x0000_0100_0000_01b3];

/// Digest of every bit of every stroke in order [FNV-1a].
pub fn digest(drawing: &Drawing) -> u64 {
    // List the numbers of every stroke and of its points.
    let strokes = drawing.strokes.iter().flat_map(|stroke| {
        let head = [
            stroke.id,
            stroke.kind as u64,
            u64::from(stroke.occluders),
            u64::from(stroke.surface),
            u64::from(stroke.closed),
            stroke.points.len() as u64,
        ];
        let points = stroke.points.iter().flat_map(|point| {
            let [x, y] = point.position;
            let world = point.world.map(f64::from);
            let numbers = [
                x,
                y,
                point.depth,
                point.width,
                point.u,
                world[0],
                world[1],
                world[2],
            ];
            numbers.map(f64::to_bits)
        });
        head.into_iter().chain(points)
    });

    // Hash their bytes in order.
    let size = drawing.size.map(u64::from);
    let words = size.into_iter().chain(strokes);
    let bytes = words.flat_map(u64::to_le_bytes);
    bytes.fold(FNV[0], |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(FNV[1])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_vector::stroke::{Kind, Stroke, StrokePoint};

    #[test]
    fn a_changed_bit_changes_the_number() {
        let stroke = Stroke {
            id: 7,
            kind: Kind::Crease,
            occluders: 0,
            surface: 0,
            closed: false,
            part: None,
            points: vec![StrokePoint::default(); 2],
        };
        let mut drawing = Drawing {
            size: [4, 3],
            strokes: vec![stroke],
            ..Drawing::default()
        };
        let before = digest(&drawing);
        assert_eq!(digest(&drawing.clone()), before);
        drawing.strokes[0].points[1].position[0] = f64::MIN_POSITIVE;
        assert_ne!(digest(&drawing), before);
    }
}
