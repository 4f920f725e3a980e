//! A surface in two poses, which carries points from the one to the other.

use std::collections::HashMap;

use glam::DVec3;

/// Faces of the first pose that a cell of the grid holds on average, over the cells that hold any.
const FACES_PER_CELL: f64 = 4.0;

/// Rings of cells that are searched for a face before a point counts as far from all.
const RINGS_MOST: i64 = 64;

/// A surface in the pose of a frame and in that of the next.
#[derive(Debug, Clone)]
pub struct Skin {
    faces: Vec<[u32; 3]>,
    /// Vertices in the first pose and in the second.
    poses: [Vec<DVec3>; 2],
    side: f64,
    cells: HashMap<[i64; 3], Vec<u32>>,
}

impl Skin {
    /// Sorts the faces of the first pose into cells. O(faces).
    pub fn new(faces: Vec<[u32; 3]>, poses: [Vec<DVec3>; 2]) -> Self {
        // Choose cells about as large as faces.
        let corners = |face: &[u32; 3]| face.map(|v| poses[0][v as usize]);
        let area: f64 = faces
            .iter()
            .map(corners)
            .map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0)
            .sum();
        let side = (area * FACES_PER_CELL / faces.len().max(1) as f64).sqrt();
        let side = if side > 0.0 { side } else { 1.0 };

        // Put every face into all cells that its box meets.
        let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        for (number, face) in faces.iter().enumerate() {
            let [a, b, c] = corners(face);
            let [low, high] = [a.min(b).min(c), a.max(b).max(c)].map(|p| cell_of(p, side));
            for x in low[0]..=high[0] {
                for y in low[1]..=high[1] {
                    for z in low[2]..=high[2] {
                        cells.entry([x, y, z]).or_default().push(number as u32);
                    }
                }
            }
        }
        Self {
            faces,
            poses,
            side,
            cells,
        }
    }

    /// Where a point goes: as far as its nearest place on the first pose, which keeps its shares of the corners of a
    /// face. A point far from all faces stays.
    pub fn carried(&self, point: DVec3) -> DVec3 {
        let Some((face, shares)) = self.nearest(point) else {
            return point;
        };
        let at =
            |pose: &[DVec3]| mixed(self.faces[face as usize].map(|v| pose[v as usize]), shares);
        let [before, after] = [0, 1].map(|i| at(&self.poses[i]));
        point + (after - before)
    }

    /// The nearest face of the first pose, and the shares of its corners at its nearest point.
    fn nearest(&self, point: DVec3) -> Option<(u32, [f64; 3])> {
        let middle = cell_of(point, self.side);
        let mut best: Option<(f64, u32, [f64; 3])> = None;
        for ring in 0..=RINGS_MOST {
            // Cells of this ring lie at least so far away.
            let least = (ring - 1).max(0) as f64 * self.side;
            if best.is_some_and(|(away, ..)| away <= least) {
                break;
            }
            for cell in shell(middle, ring) {
                for face in self.cells.get(&cell).into_iter().flatten() {
                    let corners = self.faces[*face as usize].map(|v| self.poses[0][v as usize]);
                    let shares = nearest_shares(point, corners);
                    let away = mixed(corners, shares).distance(point);
                    if best.is_none_or(|(least, other, _)| (away, *face) < (least, other)) {
                        best = Some((away, *face, shares));
                    }
                }
            }
        }
        best.map(|(_, face, shares)| (face, shares))
    }
}

/// The point that has these shares of the corners of a triangle.
fn mixed([a, b, c]: [DVec3; 3], shares: [f64; 3]) -> DVec3 {
    a * shares[0] + b * shares[1] + c * shares[2]
}

fn cell_of(point: DVec3, side: f64) -> [i64; 3] {
    (point / side).to_array().map(|v| v.floor() as i64)
}

/// The cells whose greatest distance from `middle` along an axis is `ring`.
fn shell(middle: [i64; 3], ring: i64) -> impl Iterator<Item = [i64; 3]> {
    let range = -ring..=ring;
    let planes = range.clone().flat_map(move |x| {
        let range = -ring..=ring;
        range.clone().map(move |y| (x, y))
    });
    planes.flat_map(move |(x, y)| {
        let is_rim = x.abs() == ring || y.abs() == ring;
        let step = match is_rim || ring == 0 {
            true => 1,
            false => 2 * ring,
        };
        let depths = (-ring..=ring).step_by(step as usize);
        depths.map(move |z| [middle[0] + x, middle[1] + y, middle[2] + z])
    })
}

/// Shares of the corners at the point of a triangle that is nearest to a point.
fn nearest_shares(point: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    // Drop the point on the plane.
    let (along_b, along_c, to) = (b - a, c - a, point - a);
    let normal = along_b.cross(along_c);
    let area = normal.length_squared();
    if area > 0.0 {
        let of_b = to.cross(along_c).dot(normal) / area;
        let of_c = along_b.cross(to).dot(normal) / area;
        if of_b >= 0.0 && of_c >= 0.0 && of_b + of_c <= 1.0 {
            return [1.0 - of_b - of_c, of_b, of_c];
        }
    }

    // Outside of it the nearest point lies on a side.
    let sides = [[0, 1, 2], [1, 2, 0], [2, 0, 1]].map(|[from, to, other]| {
        let corners = [a, b, c];
        let way = corners[to] - corners[from];
        let length = way.length_squared();
        let share = match length > 0.0 {
            true => ((point - corners[from]).dot(way) / length).clamp(0.0, 1.0),
            false => 0.0,
        };
        let mut shares = [0.0; 3];
        (shares[from], shares[to], shares[other]) = (1.0 - share, share, 0.0);
        ((corners[from] + way * share).distance(point), shares)
    });
    let nearest = sides.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map_or([1.0, 0.0, 0.0], |(_, shares)| shares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_mesh::testing::icosphere;
    use proptest::prelude::*;

    fn ball() -> (Vec<[u32; 3]>, Vec<DVec3>) {
        let mesh = icosphere(3);
        let positions = mesh.positions().iter().copied();
        let positions = positions.map(crate::lines::viewpoint::wide).collect();
        (mesh.triangles().to_vec(), positions)
    }

    proptest! {
        #[test]
        fn points_of_faces_keep_their_shares(
            face in 0usize..1280, x in 0.0..1.0f64, y in 0.0..1.0f64, up in -5.0..5.0f64,
        ) {
            let (faces, rest) = ball();
            let bent: Vec<DVec3> = rest.iter().map(|p| DVec3::new(2.0 * p.x, p.y + up, p.z + p.x)).collect();
            let (x, y) = if x + y > 1.0 { (1.0 - x, 1.0 - y) } else { (x, y) };
            let at = |places: &[DVec3]| {
                let [a, b, c] = faces[face].map(|v| places[v as usize]);
                a + (b - a) * x + (c - a) * y
            };
            let skin = Skin::new(faces.clone(), [rest.clone(), bent.clone()]);
            prop_assert!(skin.carried(at(&rest)).distance(at(&bent)) < 1e-9);
        }

        #[test]
        fn the_nearest_face_is_that_of_a_search_through_all(x in -2.0..2.0f64, y in -2.0..2.0f64, z in -2.0..2.0f64) {
            let (faces, rest) = ball();
            let point = DVec3::new(x, y, z);
            let corners = |face: &[u32; 3]| face.map(|v| rest[v as usize]);
            let away = |face: &[u32; 3], shares| mixed(corners(face), shares).distance(point);
            let nearest = |face| away(face, nearest_shares(point, corners(face)));
            let least = faces.iter().map(nearest).fold(f64::INFINITY, f64::min);
            let skin = Skin::new(faces.clone(), [rest.clone(), rest.clone()]);
            let (face, shares) = skin.nearest(point).expect("a ball has faces");
            prop_assert_eq!(away(&faces[face as usize], shares), least);
            prop_assert_eq!(skin.carried(point), point);
        }
    }
}
