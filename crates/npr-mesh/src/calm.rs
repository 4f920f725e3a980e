//! Normals calmed for shading: tones cut with them have clean edges, also on scans.

use glam::Vec3;
use npr_core::math;
use rayon::prelude::*;

/// Steps in which normals spread, at most as far a step as the rings around a vertex.
const STEPS: usize = 32;

/// Cosine of the angle from which two normals beside each other do not mix: 40 degrees, that of hard edges.
const APART_COS: f32 = 0.766;

/// How far normals mix, at most, in radii of the bend of the surface: further, limbs and noses would lose their form.
const BEND_SHARE: f32 = 0.25;

/// Most that the corner of a triangle weighs, as a cotangent: that of a needle, 0.06 degrees.
const WIDEST_COT: f32 = 1e3;

/// A surface with its normals.
#[derive(Debug, Clone, Copy)]
pub struct Shaded<'a> {
    /// Positions of the vertices.
    pub positions: &'a [[f32; 3]],
    /// Unit normals of the vertices.
    pub normals: &'a [[f32; 3]],
    /// Size of the larger principal curvature at each vertex, without the grain of a scan, in 1 / units of positions.
    pub bends: &'a [f32],
    /// Number of the object of each vertex: normals of two objects do not mix.
    pub objects: &'a [u32],
    /// Corners of the triangles.
    pub triangles: &'a [[u32; 3]],
}

impl Shaded<'_> {
    /// The normals, calmed: averaged as far as `reach`, in units of positions; as they are for a reach of 0.
    ///
    /// They spread over the surface as heat does, for as long as heat takes to reach so far, by the cotangents of
    /// triangles [Desbrun et al. 1999], so that uneven triangles do not pull them aside. Less far where the surface
    /// bends more tightly, the less the more two normals differ, and never over hard edges, where vertices of one place
    /// have several normals. Vertices of one place, object and normal are one. Unit length; where normals cancel they
    /// stay as they are. O(triangles log triangles), parallel; the same result for any number of threads.
    pub fn calm_normals(&self, reach: f32) -> Vec<[f32; 3]> {
        if reach.is_nan() || reach <= 0.0 {
            return self.normals.to_vec();
        }

        // Join vertices, and find how their triangles weigh on them.
        let (node_of, firsts) = self.nodes();
        let ring = Ring::new(self, &node_of, firsts.len());
        let times: Vec<f32> = firsts
            .iter()
            .map(|vertex| {
                let bend = self.bends[*vertex as usize].max(f32::MIN_POSITIVE);
                let reach = reach.min(BEND_SHARE / bend);
                0.5 * reach * reach / STEPS as f32
            })
            .collect();

        // Let the normals spread.
        let mut normals: Vec<Vec3> = firsts
            .iter()
            .map(|vertex| Vec3::from(self.normals[*vertex as usize]))
            .collect();
        for _ in 0..STEPS {
            normals = (0..normals.len())
                .into_par_iter()
                .with_min_len(1024)
                .map(|node| ring.spread(&normals, &times, node))
                .collect();
        }
        node_of
            .iter()
            .map(|node| normals[*node as usize].to_array())
            .collect()
    }

    /// The node of every vertex, and the first vertex of each node.
    fn nodes(&self) -> (Vec<u32>, Vec<u32>) {
        let key = |vertex: &u32| {
            let v = *vertex as usize;
            let bits = |x: [f32; 3]| x.map(|x| (x + 0.0).to_bits());
            (
                bits(self.positions[v]),
                math::pack_unit(self.normals[v]),
                self.objects[v],
            )
        };
        let mut order: Vec<u32> = (0..self.positions.len() as u32).collect();
        order.par_sort_by_cached_key(key);
        let mut node_of = vec![0; order.len()];
        let mut firsts = Vec::new();
        for same in order.chunk_by(|a, b| key(a) == key(b)) {
            for vertex in same {
                node_of[*vertex as usize] = firsts.len() as u32;
            }
            firsts.push(same[0]);
        }
        (node_of, firsts)
    }
}

/// The neighbours of every node with the weights of the edges between them.
struct Ring {
    /// Where the neighbours of each node begin; one more than there are nodes.
    starts: Vec<u32>,
    neighbours: Vec<(u32, f32)>,
    /// Area of the surface around every node.
    areas: Vec<f32>,
}

impl Ring {
    fn new(surface: &Shaded<'_>, node_of: &[u32], count: usize) -> Self {
        // Weigh the edges of every triangle by the angle across from them.
        let mut areas = vec![0.0; count];
        let mut edges: Vec<(u32, u32, f32)> = Vec::with_capacity(6 * surface.triangles.len());
        for corners in surface.triangles {
            let points = corners.map(|v| Vec3::from(surface.positions[v as usize]));
            let nodes = corners.map(|v| node_of[v as usize]);
            let twice = (points[1] - points[0])
                .cross(points[2] - points[0])
                .length();
            for i in 0..3 {
                areas[nodes[i] as usize] += twice / 6.0;
                let [j, k] = [(i + 1) % 3, (i + 2) % 3];
                let along = (points[i] - points[k]).dot(points[j] - points[k]);
                let cot = (along / twice.max(f32::MIN_POSITIVE)).clamp(-WIDEST_COT, WIDEST_COT);
                if nodes[i] != nodes[j] {
                    edges.push((nodes[i], nodes[j], 0.5 * cot));
                    edges.push((nodes[j], nodes[i], 0.5 * cot));
                }
            }
        }

        // Sum the weights of both sides of an edge; what is left below zero would spread backwards.
        edges.par_sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
        let mut starts = vec![0; count + 1];
        let mut neighbours = Vec::new();
        for same in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let weight = same.iter().map(|(.., cot)| cot).sum::<f32>().max(0.0);
            neighbours.push((same[0].1, weight));
            starts[same[0].0 as usize + 1] += 1;
        }
        for node in 0..count {
            starts[node + 1] += starts[node];
        }
        Self {
            starts,
            neighbours,
            areas,
        }
    }

    /// The normal of a node after one step.
    fn spread(&self, normals: &[Vec3], times: &[f32], node: usize) -> Vec3 {
        let normal = normals[node];
        let [from, to] = [node, node + 1].map(|i| self.starts[i] as usize);
        let mut flow = Vec3::ZERO;
        let mut weights = 0.0;
        for (other, cot) in &self.neighbours[from..to] {
            let other = *other as usize;
            let alike = (normal.dot(normals[other]) - APART_COS) / (1.0 - APART_COS);
            let weight = cot * alike.clamp(0.0, 1.0) * times[node].min(times[other]);
            flow += (normals[other] - normal) * weight;
            weights += weight;
        }
        if weights <= 0.0 {
            return normal;
        }
        let rate = (1.0 / self.areas[node].max(f32::MIN_POSITIVE)).min(0.9 / weights);
        (normal + flow * rate).try_normalize().unwrap_or(normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::testing::{Random, icosphere, random_soup, torus};
    use crate::{smooth_normals, weld};
    use proptest::prelude::*;

    fn normals_of(mesh: &Mesh) -> Vec<[f32; 3]> {
        let weld = weld(mesh.positions(), 0.0);
        weld.spread(&smooth_normals(mesh.positions(), mesh.triangles(), &weld))
    }

    fn calmed(mesh: &Mesh, normals: &[[f32; 3]], bend: f32, reach: f32) -> Vec<[f32; 3]> {
        let count = normals.len();
        Shaded {
            positions: mesh.positions(),
            normals,
            bends: &vec![bend; count],
            objects: &vec![0; count],
            triangles: mesh.triangles(),
        }
        .calm_normals(reach)
    }

    fn widest(a: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
        let chords = a
            .iter()
            .zip(b)
            .map(|(a, b)| Vec3::from(*a).distance(Vec3::from(*b)));
        chords.fold(0.0, f32::max)
    }

    /// Unit normals turned aside by up to `amount`, each by its own seed.
    fn shaken(normals: &[[f32; 3]], seed: u64, amount: f32) -> Vec<[f32; 3]> {
        let mut random = Random::new(seed);
        let mut next = || (2.0 * random.unit() - 1.0) * amount;
        normals
            .iter()
            .map(|n| {
                (Vec3::from(*n) + Vec3::new(next(), next(), next()))
                    .normalize()
                    .to_array()
            })
            .collect()
    }

    proptest! {
        #[test]
        fn grain_goes_and_the_form_stays(seed: u64) {
            let ball = icosphere(5);
            let normals = normals_of(&ball);
            let shaken = shaken(&normals, seed, 0.1);
            let calm = calmed(&ball, &shaken, 1.0, 0.2);
            let error = |of: &[[f32; 3]]| {
                let squares = of.iter().zip(&normals);
                let sum: f32 = squares
                    .map(|(a, b)| Vec3::from(*a).distance_squared(Vec3::from(*b)))
                    .sum();
                (sum / normals.len() as f32).sqrt()
            };
            prop_assert!(error(&calm) < 0.25 * error(&shaken), "{} of {}", error(&calm), error(&shaken));
        }

        #[test]
        fn uneven_triangles_pull_no_normal_aside(seed: u64) {
            // Normals of a plane that turn evenly along it are averages of those around them.
            let (mesh, turn) = (uneven_plane(seed), 0.3);
            let normals: Vec<[f32; 3]> = mesh
                .positions()
                .iter()
                .map(|[x, _, _]| [math::sin(turn * x), 0.0, math::cos(turn * x)])
                .collect();
            let calm = calmed(&mesh, &normals, 0.0, 0.1);
            let inner = |p: &[f32; 3]| p[0].abs() < 0.5 && p[1].abs() < 0.4;
            let mut worst = 0.0_f32;
            for (i, _) in mesh.positions().iter().enumerate().filter(|(_, p)| inner(p)) {
                let error = widest(&[calm[i]], &[normals[i]]);
                worst = worst.max(error);
            }
            prop_assert!(worst < 1e-3, "{worst}");
        }

        #[test]
        fn normals_stay_unit_and_finite(seed: u64, reach in 0.0f32..10.0, bend in 0.0f32..100.0) {
            let soup = random_soup(30, seed);
            let normals = shaken(&vec![[0.0, 0.0, 1.0]; soup.positions().len()], seed, 1.0);
            for normal in calmed(&soup, &normals, bend, reach) {
                let length = Vec3::from(normal).length();
                prop_assert!((length - 1.0).abs() < 1e-3, "{normal:?}");
            }
        }

        #[test]
        fn the_order_of_triangles_plays_no_part(seed: u64) {
            let ring = torus(24, 12, 1.0, 0.4);
            let normals = shaken(&normals_of(&ring), seed, 0.1);
            let mut turned = ring.triangles().to_vec();
            turned.reverse();
            let turned = Mesh::new(ring.positions().to_vec(), turned).expect("a mesh");
            let [a, b] = [&ring, &turned].map(|mesh| calmed(mesh, &normals, 1.0, 0.2));
            prop_assert!(widest(&a, &b) < 1e-5);
        }
    }

    /// A plane about the origin, of triangles of uneven sizes without obtuse angles to speak of.
    fn uneven_plane(seed: u64) -> Mesh {
        const SIDE: u32 = 41;
        let mut random = Random::new(seed);
        let mut next = || random.unit() - 0.5;
        let step = 2.0 / (SIDE - 1) as f32;
        let positions = (0..SIDE * SIDE)
            .map(|i| {
                let (column, row) = ((i % SIDE) as f32, (i / SIDE) as f32);
                let aside = 0.5 * (row % 2.0);
                let x = -1.0 + step * (column + aside + 0.4 * next());
                [x, step * (0.866 * (row - 20.0) + 0.4 * next()), 0.0]
            })
            .collect();
        let triangles = (0..(SIDE - 1) * (SIDE - 1))
            .flat_map(|i| {
                let row = i / (SIDE - 1);
                let a = row * SIDE + i % (SIDE - 1);
                let [b, c, d] = [a + 1, a + SIDE, a + SIDE + 1];
                match row % 2 {
                    0 => [[a, b, c], [b, d, c]],
                    _ => [[a, d, c], [a, b, d]],
                }
            })
            .collect();
        Mesh::new(positions, triangles).expect("a mesh")
    }

    #[test]
    fn tubes_keep_their_form_however_far_normals_reach() {
        let tube = torus(96, 24, 4.0, 0.1);
        let normals = normals_of(&tube);
        let kept = widest(&calmed(&tube, &normals, 10.0, 0.5), &normals);
        let lost = widest(&calmed(&tube, &normals, 0.0, 0.5), &normals);
        assert!(kept < 0.05 && lost > 2.0 * kept, "{kept} {lost}");
    }

    #[test]
    fn hard_edges_stay_hard_and_no_reach_changes_nothing() {
        // Two squares that meet at a right angle, with normals of their own.
        let positions = vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 1.0, 1.0],
            [0.0, 0.0, 1.0],
        ];
        let triangles = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        let mesh = Mesh::new(positions, triangles).expect("a mesh");
        let normals = [[[0.0, 0.0, 1.0]; 4], [[1.0, 0.0, 0.0]; 4]].concat();
        assert_eq!(calmed(&mesh, &normals, 0.0, 2.0), normals);

        let ball = icosphere(3);
        let shaken = shaken(&normals_of(&ball), 7, 0.2);
        assert_eq!(calmed(&ball, &shaken, 1.0, 0.0), shaken);
        assert_eq!(calmed(&ball, &shaken, 1.0, f32::NAN), shaken);
    }
}
