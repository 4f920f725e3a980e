//! How a surface bends at its vertices, calmed for drawing.

use super::{Curvature, curvature, tightest};
use crate::edges::Edge;
use crate::smoothing::{smooth_curvature, vertex_areas};
use crate::weld::Weld;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use npr_core::camera::bounds_of;
use npr_core::math;
use npr_core::surface::unit_or_z;

/// Rounds of averaging that calm curvature on scanned meshes.
const CURVATURE_ROUNDS: u32 = 2;

/// How far normals are averaged before bends are measured, as a share of the mesh's radius: the grain of a scan is
/// finer, what a line swells with is not. Meshes of longer edges stay as they are.
const CALM_SHARE: f32 = 0.04;

/// Most rounds of averaging normals: on the finest meshes they reach less far, but cost no more.
const CALM_ROUNDS_MAX: u32 = 16;

/// How the surface bends at a welded vertex.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Bend {
    /// Principal curvatures, in 1 / units of the world; positive is convex.
    pub curvatures: [f32; 2],
    /// Direction of the first, packed by [`math::pack_unit`].
    pub direction: u32,
    /// Size of the larger curvature of the surface as it is, with its grain: what a line has to fit round.
    pub tightest: f32,
}

impl Bend {
    /// Whether all of its curvatures are numbers.
    pub fn is_finite(&self) -> bool {
        let [max, min] = self.curvatures;
        [max, min, self.tightest].iter().all(|v| v.is_finite())
    }
}

/// A welded mesh whose bends are measured.
#[derive(Debug, Clone, Copy)]
pub struct WeldedMesh<'a> {
    /// Positions of the stored vertices.
    pub positions: &'a [[f32; 3]],
    /// Corners of triangles, stored vertices.
    pub triangles: &'a [[u32; 3]],
    /// Which stored vertices are one.
    pub weld: &'a Weld,
    /// Its unique edges; their ends alone count.
    pub edges: &'a [Edge],
    /// How much longer things are in the world than in the positions.
    pub scale: f32,
}

impl WeldedMesh<'_> {
    /// The bend of every welded vertex; `normals` holds one smooth normal for each.
    ///
    /// O(n), parallel; the greatest part of preparing a model.
    pub fn bends(&self, normals: &[[f32; 3]]) -> Vec<Bend> {
        let surface = Surface {
            mesh: self,
            areas: vertex_areas(self.positions, self.triangles, self.weld),
        };
        surface.calm_bends(normals)
    }
}

/// A mesh with the areas by which averages are weighted.
struct Surface<'a> {
    mesh: &'a WeldedMesh<'a>,
    /// Area around every welded vertex.
    areas: Vec<f32>,
}

impl Surface<'_> {
    /// Bends of the surface calmed, each with the tightest of the surface as it is.
    fn calm_bends(&self, normals: &[[f32; 3]]) -> Vec<Bend> {
        let as_it_is = self.bends(normals);
        let rounds = self.calm_rounds();
        if rounds == 0 {
            return as_it_is;
        }
        let calm = self.bends(&self.calm_normals(normals, rounds));
        let both = calm.into_iter().zip(as_it_is);
        both.map(|(calm, Bend { tightest, .. })| Bend { tightest, ..calm })
            .collect()
    }

    /// Bends of the surface as if these were its normals.
    fn bends(&self, normals: &[[f32; 3]]) -> Vec<Bend> {
        let curvature = curvature(
            self.mesh.positions,
            self.mesh.triangles,
            self.mesh.weld,
            normals,
        );
        let calm = |of: fn(&Curvature) -> f32| {
            let values: Vec<f32> = curvature.iter().map(|c| of(c) / self.mesh.scale).collect();
            self.averaged(&values, CURVATURE_ROUNDS)
        };
        let pairs = calm(|c| c.max).into_iter().zip(calm(|c| c.min));
        let bends = curvature.iter().zip(pairs);
        bends
            .map(|(c, (max, min))| Bend {
                curvatures: [max, min],
                direction: math::pack_unit(c.direction),
                tightest: tightest([max, min]),
            })
            .collect()
    }

    /// Normals averaged with those around them.
    ///
    /// Bends of calm normals are what is left of curvature without its grain: averaged itself, curvature keeps it, as
    /// the larger of two is never below what the grain adds.
    fn calm_normals(&self, normals: &[[f32; 3]], rounds: u32) -> Vec<[f32; 3]> {
        let axes = [0, 1, 2].map(|axis| {
            let along: Vec<f32> = normals.iter().map(|normal| normal[axis]).collect();
            self.averaged(&along, rounds)
        });
        (0..normals.len())
            .map(|i| unit_or_z(axes.each_ref().map(|along| along[i])))
            .collect()
    }

    /// Rounds in which normals reach [`CALM_SHARE`] of the radius.
    fn calm_rounds(&self) -> u32 {
        let (low, high) = bounds_of(self.mesh.positions.iter().map(|p| Vec3::from(*p)));
        let reach = CALM_SHARE * (Vec3::from(high) - Vec3::from(low)).length() * 0.5;
        let area: f64 = self.areas.iter().map(|area| f64::from(*area)).sum();
        let rounds = f64::from(reach) * f64::from(reach) * self.areas.len() as f64 / area;
        // Without area there is no number of rounds, or no end to it.
        if rounds.is_finite() {
            (rounds as u32).min(CALM_ROUNDS_MAX)
        } else {
            0
        }
    }

    fn averaged(&self, values: &[f32], rounds: u32) -> Vec<f32> {
        smooth_curvature(values, self.mesh.edges, self.mesh.weld, &self.areas, rounds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::icosphere;
    use npr_core::random::{hash, unit};
    use proptest::prelude::*;

    /// Bends of a ball of radius 1 whose vertices lie off it by up to `grain`.
    fn bends_of_ball(level: u32, grain: f32, seed: u32) -> Vec<Bend> {
        let ball = icosphere(level);
        let moved = |(i, p): (usize, &[f32; 3])| {
            let off = 1.0 + grain * (2.0 * unit(hash(seed, 0, i as u32)) - 1.0);
            p.map(|x| x * off)
        };
        let positions: Vec<[f32; 3]> = ball.positions().iter().enumerate().map(moved).collect();
        let weld = crate::weld(&positions, 0.0);
        let edges = crate::unique_edges(&positions, ball.triangles(), &weld, &[]);
        let normals = crate::smooth_normals(&positions, ball.triangles(), &weld);
        let mesh = WeldedMesh {
            positions: &positions,
            triangles: ball.triangles(),
            weld: &weld,
            edges: &edges,
            scale: 1.0,
        };
        mesh.bends(&normals)
    }

    /// Mean distance of curvatures from those of the ball.
    fn error(of: impl Fn(&Bend) -> f32, bends: &[Bend]) -> f32 {
        bends.iter().map(|bend| (of(bend) - 1.0).abs()).sum::<f32>() / bends.len() as f32
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(8))]
        #[test]
        fn the_grain_of_a_scan_does_not_bend_its_lines(seed: u32) {
            let bends = bends_of_ball(6, 0.002, seed);
            let calm = error(|bend| bend.curvatures[0], &bends);
            let grainy = error(|bend| bend.tightest, &bends);
            prop_assert!(calm < 0.2 && calm < 0.4 * grainy, "{} of {}", calm, grainy);
        }
    }

    #[test]
    fn a_coarse_ball_bends_as_it_is() {
        for bend in bends_of_ball(3, 0.0, 0) {
            let [max, min] = bend.curvatures;
            assert_eq!(bend.tightest, max.abs().max(min.abs()));
            assert!((max - 1.0).abs() < 0.05 && (min - 1.0).abs() < 0.05);
        }
    }

    #[test]
    fn a_mesh_without_area_bends_nowhere() {
        let positions = [[0.0; 3]; 3];
        let weld = crate::weld(&positions, 0.0);
        let normals = vec![[0.0, 0.0, 1.0]; weld.count()];
        let mesh = WeldedMesh {
            positions: &positions,
            triangles: &[[0, 1, 2]],
            weld: &weld,
            edges: &[],
            scale: 1.0,
        };
        let bends = mesh.bends(&normals);
        assert!(
            bends
                .iter()
                .all(|bend| bend.curvatures == [0.0; 2] && bend.tightest == 0.0)
        );
    }
}
