//! Fewer triangles of the same shape: what a scan of high resolution is brought to before it stands beside small meshes.
//!
//! Edges are collapsed in the order of the squared distances that this adds [Garland and Heckbert 1997].

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

use glam::{DMat3, DVec3};

use super::analytic::Triangles;
use super::soup::Soup;

/// How much more a border counts than the surface: an open mesh keeps its outline.
const BORDER_WEIGHT: f64 = 100.0;

/// Determinant, as a share of the cube of the trace, under which no place is the best one.
const SINGULAR: f64 = 1e-9;

/// Least cosine between the normals of a face before and after a collapse.
const LEAST_COS: f64 = 0.2;

/// How far a step of smoothing moves vertices towards the middle of their neighbours, then away again [Taubin 1995].
const SMOOTHING: [f64; 2] = [0.5, -0.53];

/// The same shape with the noise of a scan taken out: vertices move towards the middle of their neighbours and back, `rounds` times.
///
/// Borders stay. Without, decimation keeps each bump that is as high as the triangles are long, and each makes contours of its own.
/// O(rounds * n).
pub fn smoothed(soup: &Soup, rounds: usize) -> Soup {
    let edges = soup.edges();
    let mut is_free = vec![true; soup.positions.len()];
    for edge in edges.iter().filter(|edge| edge.sides.len() != 2) {
        for end in edge.ends {
            is_free[end as usize] = false;
        }
    }
    let mut smooth = soup.clone();
    for share in (0..rounds).flat_map(|_| SMOOTHING) {
        let mut sums = vec![(DVec3::ZERO, 0.0); smooth.positions.len()];
        for edge in &edges {
            let [a, b] = edge.ends.map(|end| end as usize);
            for (own, other) in [(a, b), (b, a)] {
                sums[own].0 += smooth.positions[other];
                sums[own].1 += 1.0;
            }
        }
        let moved = smooth.positions.iter_mut().zip(sums).zip(&is_free);
        for ((position, (sum, count)), _) in moved.filter(|((_, sum), free)| **free && sum.1 > 0.0)
        {
            *position = position.lerp(sum / count, share);
        }
    }
    smooth
}

/// Sum of squared distances from planes, as a form: `p A p - 2 b p + c`.
#[derive(Debug, Clone, Copy, Default)]
struct Quadric {
    a: DMat3,
    b: DVec3,
    c: f64,
}

impl Quadric {
    fn of_plane(normal: DVec3, point: DVec3, weight: f64) -> Self {
        let offset = normal.dot(point);
        let column = |v: f64| normal * v * weight;
        Self {
            a: DMat3::from_cols(column(normal.x), column(normal.y), column(normal.z)),
            b: normal * offset * weight,
            c: offset * offset * weight,
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            a: self.a + other.a,
            b: self.b + other.b,
            c: self.c + other.c,
        }
    }

    fn at(&self, p: DVec3) -> f64 {
        p.dot(self.a * p) - 2.0 * self.b.dot(p) + self.c
    }

    /// Where the sum is least, as far as there is such a place.
    fn least(&self) -> Option<DVec3> {
        let trace = self.a.x_axis.x + self.a.y_axis.y + self.a.z_axis.z;
        let determinant = self.a.determinant();
        (determinant > SINGULAR * trace.powi(3)).then(|| self.a.inverse() * self.b)
    }
}

/// An edge that may be collapsed.
struct Collapse {
    cost: f64,
    ends: [u32; 2],
    /// Ages of its ends when the cost was found: older ones are out of date.
    ages: [u32; 2],
    place: DVec3,
}

impl Ord for Collapse {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_cost = other.cost.total_cmp(&self.cost);
        by_cost.then_with(|| other.ends.cmp(&self.ends))
    }
}

impl PartialOrd for Collapse {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Collapse {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Collapse {}

/// A mesh while edges are taken out of it.
struct Collapser {
    positions: Vec<DVec3>,
    faces: Vec<Option<[u32; 3]>>,
    /// Faces around every vertex.
    around: Vec<BTreeSet<u32>>,
    quadrics: Vec<Quadric>,
    ages: Vec<u32>,
    is_border: Vec<bool>,
    queue: BinaryHeap<Collapse>,
}

/// About `face_count` triangles of the shape of a soup; all of it where it has no more.
///
/// Which pieces hang together stays as it is. O(n log n).
pub fn decimated(soup: &Soup, face_count: usize) -> Triangles {
    let mut mesh = Collapser::new(soup);
    let mut left = soup.faces.len();
    while left > face_count {
        let Some(collapse) = mesh.queue.pop() else {
            break;
        };
        left -= mesh.collapse(&collapse);
    }
    mesh.finish()
}

impl Collapser {
    fn new(soup: &Soup) -> Self {
        let count = soup.positions.len();
        let mut mesh = Self {
            positions: soup.positions.clone(),
            faces: soup.faces.iter().copied().map(Some).collect(),
            around: vec![BTreeSet::new(); count],
            quadrics: vec![Quadric::default(); count],
            ages: vec![0; count],
            is_border: vec![false; count],
            queue: BinaryHeap::new(),
        };
        for (face, corners) in (0..).zip(&soup.faces) {
            let [a, b, c] = soup.corners(face as usize);
            let normal = (b - a).cross(c - a);
            let plane = Quadric::of_plane(normal.normalize_or_zero(), a, normal.length());
            for corner in corners {
                mesh.add(*corner, plane);
                mesh.around[*corner as usize].insert(face);
            }
        }
        let edges = soup.edges();
        for edge in edges.iter().filter(|edge| edge.sides.len() != 2) {
            mesh.add_border(soup, edge.ends, edge.sides[0]);
        }
        for edge in &edges {
            mesh.offer(edge.ends);
        }
        mesh
    }

    fn add(&mut self, vertex: u32, plane: Quadric) {
        let own = &mut self.quadrics[vertex as usize];
        *own = own.plus(plane);
    }

    /// A plane through a border, square to its face.
    fn add_border(&mut self, soup: &Soup, ends: [u32; 2], side: u32) {
        let [a, b] = ends.map(|end| self.positions[end as usize]);
        let inside = soup.opposite(side) - a;
        let along = b - a;
        let across = inside - along * (inside.dot(along) / along.length_squared().max(1e-300));
        let weight = BORDER_WEIGHT * along.length_squared();
        for end in ends {
            let plane = Quadric::of_plane(across.normalize_or_zero(), a, weight);
            self.add(end, plane);
            self.is_border[end as usize] = true;
        }
    }

    /// Puts an edge into the queue.
    fn offer(&mut self, ends: [u32; 2]) {
        let [a, b] = ends.map(|end| end as usize);
        // A bridge between two borders would become a point where both meet.
        if self.is_border[a] && self.is_border[b] && self.shared(ends).len() > 1 {
            return;
        }
        let sum = self.quadrics[a].plus(self.quadrics[b]);
        let [from, to] = [self.positions[a], self.positions[b]];
        let middle = (from + to) / 2.0;
        let near = |place: &DVec3| place.distance(middle) <= from.distance(to);
        let best = sum.least().filter(near);
        let places = best.into_iter().chain([middle, from, to]);
        let cheapest = places.min_by(|p, q| sum.at(*p).total_cmp(&sum.at(*q)));
        self.queue.push(Collapse {
            cost: sum.at(cheapest.unwrap_or(middle)).max(0.0),
            ends,
            ages: [self.ages[a], self.ages[b]],
            place: cheapest.unwrap_or(middle),
        });
    }

    /// Faces at both ends of an edge.
    fn shared(&self, [a, b]: [u32; 2]) -> Vec<u32> {
        let (a, b) = (&self.around[a as usize], &self.around[b as usize]);
        a.intersection(b).copied().collect()
    }

    fn neighbours(&self, vertex: u32) -> BTreeSet<u32> {
        let faces = self.around[vertex as usize].iter();
        let corners = faces.filter_map(|face| self.faces[*face as usize]);
        corners.flatten().filter(|other| *other != vertex).collect()
    }

    /// Takes an edge out, unless the surface would fold or join itself; gives the number of faces that went.
    fn collapse(&mut self, collapse: &Collapse) -> usize {
        let [keep, gone] = collapse.ends;
        let is_old = [0, 1].map(|i| collapse.ages[i] != self.ages[collapse.ends[i] as usize]);
        if is_old.contains(&true) {
            return 0;
        }
        let dying = self.shared(collapse.ends);
        let common = self.neighbours(keep);
        let common = common.intersection(&self.neighbours(gone)).count();
        if common != dying.len() || self.folds(collapse, &dying) {
            return 0;
        }
        for face in &dying {
            for corner in self.faces[*face as usize].take().into_iter().flatten() {
                self.around[corner as usize].remove(face);
            }
        }
        for face in std::mem::take(&mut self.around[gone as usize]) {
            if let Some(corners) = &mut self.faces[face as usize] {
                *corners = corners.map(|v| if v == gone { keep } else { v });
            }
            self.around[keep as usize].insert(face);
        }
        self.positions[keep as usize] = collapse.place;
        self.is_border[keep as usize] |= self.is_border[gone as usize];
        self.add(keep, self.quadrics[gone as usize]);
        self.ages[keep as usize] += 1;
        self.ages[gone as usize] += 1;
        for other in self.neighbours(keep) {
            self.offer([keep.min(other), keep.max(other)]);
        }
        dying.len()
    }

    /// Whether a face that stays would turn over.
    fn folds(&self, collapse: &Collapse, dying: &[u32]) -> bool {
        let faces = collapse.ends.iter().flat_map(|v| &self.around[*v as usize]);
        let mut staying = faces.filter(|face| !dying.contains(face));
        staying.any(|face| {
            let Some(corners) = self.faces[*face as usize] else {
                return false;
            };
            let before = corners.map(|v| self.positions[v as usize]);
            let after = corners.map(|v| match collapse.ends.contains(&v) {
                true => collapse.place,
                false => self.positions[v as usize],
            });
            let [before, after] =
                [before, after].map(|[a, b, c]| (b - a).cross(c - a).normalize_or_zero());
            before.dot(after) < LEAST_COS
        })
    }

    /// What is left, with vertices that are used alone.
    fn finish(&self) -> Triangles {
        let faces: Vec<[u32; 3]> = self.faces.iter().flatten().copied().collect();
        let used: BTreeSet<u32> = faces.iter().flatten().copied().collect();
        let mut number = vec![0; self.positions.len()];
        for (new, old) in (0..).zip(&used) {
            number[*old as usize] = new;
        }
        let place = |v: &u32| self.positions[*v as usize].as_vec3().to_array();
        (
            used.iter().map(place).collect(),
            faces
                .iter()
                .map(|corners| corners.map(|v| number[v as usize]))
                .collect(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_mesh::testing::{torus, uv_sphere};

    fn soup_of((positions, triangles): &Triangles) -> Soup {
        Soup::of_mesh(positions, triangles)
    }

    fn volume(soup: &Soup) -> f64 {
        let corners = (0..soup.faces.len()).map(|face| soup.corners(face));
        corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    #[test]
    fn closed_shapes_stay_closed_and_keep_their_volume() {
        for (mesh, holes) in [(uv_sphere(96, 48), 0), (torus(120, 60, 1.0, 0.4), 1)] {
            let whole = Soup::of_mesh(mesh.positions(), mesh.triangles());
            let few = soup_of(&decimated(&whole, 1000));
            assert!((990..=1000).contains(&few.faces.len()));
            let edges = few.edges();
            assert!(edges.iter().all(|edge| edge.sides.len() == 2));
            let euler = few.positions.len() as i64 - edges.len() as i64 + few.faces.len() as i64;
            assert_eq!(euler, 2 - 2 * holes);
            assert!((volume(&few) / volume(&whole) - 1.0).abs() < 0.01);
        }
    }

    #[test]
    fn a_flat_sheet_keeps_its_border() {
        let side = 20u32;
        let at = |x: u32, y: u32| [x as f32, y as f32, 0.0];
        let positions = (0..=side).flat_map(|y| (0..=side).map(move |x| at(x, y)));
        let positions: Vec<[f32; 3]> = positions.collect();
        let mut triangles = Vec::new();
        for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
            let corner = y * (side + 1) + x;
            let above = corner + side + 1;
            triangles.push([corner, corner + 1, above]);
            triangles.push([corner + 1, above + 1, above]);
        }
        let few = soup_of(&decimated(&Soup::of_mesh(&positions, &triangles), 100));
        assert!(few.faces.len() <= 100);
        let area = |face| {
            let [a, b, c] = few.corners(face);
            (b - a).cross(c - a).length() / 2.0
        };
        let sum: f64 = (0..few.faces.len()).map(area).sum();
        assert!((sum - f64::from(side * side)).abs() < 0.5, "{sum}");
    }

    #[test]
    fn noise_goes_and_the_shape_stays() {
        let mesh = uv_sphere(96, 48);
        let mut noisy = Soup::of_mesh(mesh.positions(), mesh.triangles());
        let whole = volume(&noisy);
        for (number, position) in (0..).zip(&mut noisy.positions) {
            let bits = npr_core::math::mix_bits(number) % 1000;
            *position *= 1.0 + 0.02 * (f64::from(bits) / 500.0 - 1.0);
        }
        let roughness = |soup: &Soup| {
            let heights = soup.positions.iter().map(|p| (p.length() - 1.0).abs());
            heights.sum::<f64>() / soup.positions.len() as f64
        };
        let calm = smoothed(&noisy, 20);
        assert!(roughness(&calm) < 0.4 * roughness(&noisy));
        assert!((volume(&calm) / whole - 1.0).abs() < 0.02);
    }

    #[test]
    fn what_is_small_enough_stays_as_it_is() {
        let mesh = uv_sphere(8, 4);
        let whole = Soup::of_mesh(mesh.positions(), mesh.triangles());
        assert_eq!(soup_of(&decimated(&whole, 1000)), whole);
    }
}
