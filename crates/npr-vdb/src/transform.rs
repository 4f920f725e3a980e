//! From indices of voxels to places in the world.

use crate::cursor::Cursor;
use crate::fault::Fault;

/// From indices of voxels to places in the world: `world = x_axis * i + y_axis * j + z_axis * k + origin`.
///
/// Whole indices are the centres of voxels. Always finite and invertible. Units are the file's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// What one step of each index moves, x first.
    axes: [[f64; 3]; 3],
    /// Where voxel (0, 0, 0) has its centre.
    origin: [f64; 3],
}

impl Transform {
    /// Indices are places.
    pub const IDENTITY: Self = Self {
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        origin: [0.0; 3],
    };

    /// A transform, unless it is not finite or flattens space.
    pub fn new(axes: [[f64; 3]; 3], origin: [f64; 3]) -> Option<Self> {
        let is_finite = axes
            .iter()
            .flatten()
            .chain(&origin)
            .all(|part| part.is_finite());
        let volume = determinant(axes);
        (is_finite && volume.is_normal()).then_some(Self { axes, origin })
    }

    /// The axes and then the origin: columns of an affine matrix world-from-index.
    pub fn columns(&self) -> [[f64; 3]; 4] {
        let [x, y, z] = self.axes;
        [x, y, z, self.origin]
    }

    /// The place in the world of a place in index space.
    pub fn point(&self, index: [f64; 3]) -> [f64; 3] {
        let [i, j, k] = index;
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = self.axes;
        let [ox, oy, oz] = self.origin;
        [
            xx * i + yx * j + zx * k + ox,
            xy * i + yy * j + zy * k + oy,
            xz * i + yz * j + zz * k + oz,
        ]
    }

    /// Lengths of a voxel's sides in the world.
    pub fn voxel_size(&self) -> [f64; 3] {
        self.axes.map(|[x, y, z]| (x * x + y * y + z * z).sqrt())
    }

    /// Reads a transform; the name of its type where it is not linear or not known.
    pub(crate) fn read(cursor: &mut Cursor) -> Result<Result<Self, String>, Fault> {
        const WHAT: &str = "a transform";
        let at = cursor.at();
        let map = cursor.text(WHAT)?;
        let mut vectors = |count| vectors(cursor, count);
        // Behind the vectors that matter stand others that follow from them.
        let transform = match map.as_str() {
            "ScaleMap" | "UniformScaleMap" => scaled(vectors(5)?.first(), None),
            "TranslationMap" => scaled(Some(&[1.0; 3]), vectors(1)?.first()),
            "ScaleTranslateMap" | "UniformScaleTranslateMap" => {
                let vectors = vectors(6)?;
                scaled(vectors.get(1), vectors.first())
            }
            "AffineMap" | "UnitaryMap" => affine(cursor)?,
            _ => return Ok(Err(map)),
        };
        let broken = Fault::Broken {
            what: WHAT,
            at,
            fault: "it is not finite, or cannot be inverted",
        };
        transform.map(Ok).ok_or(broken)
    }
}

fn scaled(scale: Option<&[f64; 3]>, origin: Option<&[f64; 3]>) -> Option<Transform> {
    let &[x, y, z] = scale?;
    let axes = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    Transform::new(axes, origin.copied().unwrap_or_default())
}

/// Files multiply rows with matrices, so the rows are the axes and the last one the origin.
fn affine(cursor: &mut Cursor) -> Result<Option<Transform>, Fault> {
    let mut rows = [[0.0; 4]; 4];
    for number in rows.as_flattened_mut() {
        *number = cursor.array("a matrix").map(f64::from_le_bytes)?;
    }
    let [x, y, z, origin] = rows.map(|[x, y, z, _]| [x, y, z]);
    let is_affine = rows.map(|[_, _, _, w]| w) == [0.0, 0.0, 0.0, 1.0];
    Ok(Transform::new([x, y, z], origin).filter(|_| is_affine))
}

fn vectors(cursor: &mut Cursor, count: usize) -> Result<Vec<[f64; 3]>, Fault> {
    let mut vectors = vec![[0.0; 3]; count];
    for number in vectors.as_flattened_mut() {
        *number = cursor.array("a transform").map(f64::from_le_bytes)?;
    }
    Ok(vectors)
}

fn determinant([[a, b, c], [d, e, f], [g, h, i]]: [[f64; 3]; 3]) -> f64 {
    a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(map: &str, numbers: &[f64]) -> Result<Result<Transform, String>, Fault> {
        let mut bytes = (map.len() as u32).to_le_bytes().to_vec();
        bytes.extend(map.bytes());
        bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        Transform::read(&mut Cursor::new(&bytes))
    }

    #[test]
    fn an_affine_map_moves_points_by_its_rows() {
        let rows = [
            0.0, 2.0, 0.0, 0.0, //
            -3.0, 0.0, 0.0, 0.0, //
            0.0, 0.0, 4.0, 0.0, //
            5.0, 6.0, 7.0, 1.0,
        ];
        let transform = read("AffineMap", &rows).unwrap().unwrap();
        assert_eq!(transform.point([1.0, 1.0, 1.0]), [2.0, 8.0, 11.0]);
        assert_eq!(transform.voxel_size(), [2.0, 3.0, 4.0]);
        assert_eq!(transform.columns()[3], [5.0, 6.0, 7.0]);
    }

    #[test]
    fn a_translation_comes_before_the_scale() {
        let numbers: Vec<f64> = (1..=18).map(f64::from).collect();
        let transform = read("ScaleTranslateMap", &numbers).unwrap().unwrap();
        assert_eq!(transform.point([1.0, 0.0, 0.0]), [5.0, 2.0, 3.0]);
    }

    #[test]
    fn what_is_not_linear_is_named() {
        let frustum = read("NonlinearFrustumMap", &[]);
        assert_eq!(frustum, Ok(Err("NonlinearFrustumMap".to_owned())));
    }

    #[test]
    fn flat_projective_and_endless_maps_are_refused() {
        assert!(read("ScaleMap", &[0.0; 15]).is_err());
        assert!(read("TranslationMap", &[f64::NAN, 0.0, 0.0]).is_err());
        assert!(read("UniformScaleMap", &[f64::INFINITY; 15]).is_err());
        let mut rows = [0.0; 16];
        for diagonal in 0..4 {
            rows[diagonal * 5] = 1.0;
        }
        assert_eq!(read("AffineMap", &rows), Ok(Ok(Transform::IDENTITY)));
        rows[3] = 0.5;
        assert!(read("AffineMap", &rows).is_err());
        assert!(read("ScaleMap", &[1.0; 14]).is_err());
    }
}
