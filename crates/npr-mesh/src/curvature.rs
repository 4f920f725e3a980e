//! How strongly, and in which direction, the surface bends at each vertex.
//!
//! Each face fits a second fundamental form to the turn of the normals along its edges; every vertex
//! averages those of its faces [Rusinkiewicz 2004, 3]. Normals are the only input besides the shape, so
//! the cost is one pass over the faces, and boundaries and irregular vertices need no special case.

use glam::DVec3;
use rayon::prelude::*;

use crate::triangle::Triangle;
use crate::vertex_fans::VertexFans;
use crate::weld::Weld;

pub mod bend;

/// Principal curvatures at a point, in one over the unit of the positions.
///
/// Positive where the surface falls away from its normal: a sphere of radius r with outward normals has
/// `max = min = 1 / r`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Curvature {
    /// The larger principal curvature, with its sign.
    pub max: f32,
    /// The smaller principal curvature, with its sign.
    pub min: f32,
    /// Unit tangent along which the surface bends by `max`; that of `min` is perpendicular to it.
    ///
    /// Its sign means nothing, nor does its direction where both curvatures agree.
    pub direction: [f32; 3],
}

impl Curvature {
    /// The mean of both principal curvatures.
    pub fn mean(&self) -> f32 {
        0.5 * (self.max + self.min)
    }

    /// The product of both principal curvatures, in one over square units.
    pub fn gaussian(&self) -> f32 {
        self.max * self.min
    }
}

/// Size of the larger of two principal curvatures.
#[inline]
pub fn tightest([max, min]: [f32; 2]) -> f32 {
    max.abs().max(min.abs())
}

/// Principal curvatures of every welded vertex.
///
/// `normals` holds one unit normal per welded vertex, such as
/// [`smooth_normals`](crate::smooth_normals); its side decides the sign, whatever the winding of faces.
/// Faces without area have no say; a vertex with no other is flat. Every value is finite.
///
/// O(n), in parallel. Exact on spheres with exact normals; with estimated ones the error falls as the
/// square of the edge length on regular meshes, and stays near 3 % at irregular vertices. At creases the
/// result grows as edges shrink, as the true curvature is infinite there.
///
/// Differs: faces with an obtuse angle give each corner a half or a quarter of their area, as in
/// [Meyer et al. 2003, 3.3], where the paper weights by the exact part nearest to the corner.
pub fn curvature(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    weld: &Weld,
    normals: &[[f32; 3]],
) -> Vec<Curvature> {
    let fans = VertexFans::new(triangles, weld);
    let normal = |welded: u32| DVec3::from_array(normals[welded as usize].map(f64::from));

    // Fit a form to every face.
    let faces: Vec<Option<FaceBend>> = triangles
        .par_iter()
        .map(|&triangle| {
            FaceBend::fit(
                &Triangle::new(positions, triangle),
                weld.corners(triangle).map(normal),
            )
        })
        .collect();

    // Average the forms around every vertex, laid into its tangent plane.
    (0..fans.count() as u32)
        .into_par_iter()
        .map(|welded| {
            let frame = Frame::around(normal(welded));
            let around = fans.around(welded).iter();
            let bends = around.filter_map(|&corner| {
                let face = faces[corner as usize / 3].as_ref()?;
                Some((
                    face.corner_areas[corner as usize % 3],
                    face.form.seen_from(&face.frame, &frame),
                ))
            });
            Form::average(bends).principal(&frame)
        })
        .collect()
}

/// Two perpendicular unit tangents and their normal.
#[derive(Debug, Clone, Copy)]
struct Frame {
    u: DVec3,
    v: DVec3,
    normal: DVec3,
}

impl Frame {
    fn around(normal: DVec3) -> Self {
        let (u, v) = normal.any_orthonormal_pair();
        Self { u, v, normal }
    }

    /// The frame after the shortest turn that takes its normal to `normal`.
    fn turned_to(&self, normal: DVec3) -> Self {
        let between = self.normal + normal;
        let cos = self.normal.dot(normal);
        // Opposite normals have no shortest turn; the tangents already lie in the right plane.
        let turn = |tangent: DVec3| match 1.0 + cos {
            scale if scale > 1e-12 => tangent - between * (normal.dot(tangent) / scale),
            _ => tangent,
        };
        Self {
            u: turn(self.u),
            v: turn(self.v),
            normal,
        }
    }
}

/// A second fundamental form: the symmetric matrix with rows `uu, uv` and `uv, vv` in some frame.
#[derive(Debug, Clone, Copy, Default)]
struct Form {
    uu: f64,
    uv: f64,
    vv: f64,
}

impl Form {
    /// The form for which `turn = form * step` fits best, where steps are a triangle's edges.
    ///
    /// Solves the normal equations of the six equations in three unknowns by cofactors. `twice_area`
    /// replaces differences of large products, so that degenerate faces do not cancel out.
    fn fit(steps: [[f64; 2]; 3], turns: [[f64; 2]; 3], twice_area: f64) -> Self {
        let sum = |term: fn([f64; 2], [f64; 2]) -> f64| -> f64 {
            steps
                .iter()
                .zip(&turns)
                .map(|(&step, &turn)| term(step, turn))
                .sum()
        };
        let (w_uu, w_uv, w_vv) = (
            sum(|s, _| s[0] * s[0]),
            sum(|s, _| s[0] * s[1]),
            sum(|s, _| s[1] * s[1]),
        );
        let [m_uu, m_uv, m_vv] = [
            sum(|s, t| t[0] * s[0]),
            sum(|s, t| t[0] * s[1] + t[1] * s[0]),
            sum(|s, t| t[1] * s[1]),
        ];
        // The determinant of the steps' Gram matrix: every pair of edges spans twice the area.
        let gram = 3.0 * twice_area * twice_area;
        let scale = 1.0 / ((w_uu + w_vv) * gram);
        Self {
            uu: scale * ((gram + w_vv * w_vv) * m_uu - w_uv * w_vv * m_uv + w_uv * w_uv * m_vv),
            uv: scale * (-w_uv * w_vv * m_uu + w_uu * w_vv * m_uv - w_uu * w_uv * m_vv),
            vv: scale * (w_uv * w_uv * m_uu - w_uu * w_uv * m_uv + (gram + w_uu * w_uu) * m_vv),
        }
    }

    /// The form in the tangents of `to`, once `from` has been turned into its plane.
    fn seen_from(&self, from: &Frame, to: &Frame) -> Self {
        let from = from.turned_to(to.normal);
        let parts = |tangent: DVec3| [tangent.dot(from.u), tangent.dot(from.v)];
        let (u, v) = (parts(to.u), parts(to.v));
        let between = |a: [f64; 2], b: [f64; 2]| {
            self.uu * a[0] * b[0] + self.uv * (a[0] * b[1] + a[1] * b[0]) + self.vv * a[1] * b[1]
        };
        Self {
            uu: between(u, u),
            uv: between(u, v),
            vv: between(v, v),
        }
    }

    /// The mean of forms in one frame by their weights; flat where the weights are zero.
    fn average(weighted: impl Iterator<Item = (f64, Self)>) -> Self {
        let (mut total, mut sum) = (0.0, Self::default());
        for (weight, form) in weighted {
            total += weight;
            sum.uu += weight * form.uu;
            sum.uv += weight * form.uv;
            sum.vv += weight * form.vv;
        }
        if total == 0.0 {
            return Self::default();
        }
        Self {
            uu: sum.uu / total,
            uv: sum.uv / total,
            vv: sum.vv / total,
        }
    }

    /// Eigenvalues, and the eigenvector of the larger.
    fn principal(&self, frame: &Frame) -> Curvature {
        let (middle, half) = ((self.uu + self.vv) / 2.0, (self.uu - self.vv) / 2.0);
        let radius = (half * half + self.uv * self.uv).sqrt();
        // Of the two rows that give the eigenvector, the longer one does not cancel.
        let [u, v] = if half >= 0.0 {
            [half + radius, self.uv]
        } else {
            [self.uv, radius - half]
        };
        let direction = (frame.u * u + frame.v * v)
            .try_normalize()
            .unwrap_or(frame.u);
        Curvature {
            max: finite(middle + radius),
            min: finite(middle - radius),
            direction: direction.as_vec3().to_array(),
        }
    }
}

/// The nearest finite `f32`; curvature of the tiniest meshes exceeds it.
fn finite(value: f64) -> f32 {
    value.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}

/// How one face bends, and how much of it belongs to each corner.
struct FaceBend {
    frame: Frame,
    form: Form,
    corner_areas: [f64; 3],
}

impl FaceBend {
    /// Fits the change of the corners' normals; none for a face without area.
    fn fit(triangle: &Triangle, normals: [DVec3; 3]) -> Option<Self> {
        // Let the plane of the face look where its corners' normals do.
        let wound = triangle.normal()?;
        let facing: DVec3 = normals.iter().sum();
        let normal = if wound.dot(facing) < 0.0 {
            -wound
        } else {
            wound
        };
        let u = triangle.edge(0).try_normalize()?;
        let frame = Frame {
            u,
            v: normal.cross(u),
            normal,
        };

        // Fit the form that turns the normals along the edges.
        let in_plane = |vector: DVec3| [vector.dot(frame.u), vector.dot(frame.v)];
        let steps = [0, 1, 2].map(|i| in_plane(triangle.edge(i)));
        let turns = [0, 1, 2].map(|i| in_plane(normals[(i + 2) % 3] - normals[(i + 1) % 3]));
        let form = Form::fit(steps, turns, triangle.cross().length());
        let sound = form.uu.is_finite() && form.uv.is_finite() && form.vv.is_finite();
        sound.then(|| Self {
            frame,
            form,
            corner_areas: triangle.corner_areas(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::normals::smooth_normals;
    use crate::testing::{
        cylinder, icosphere, mapped, mirrored, plane, random_soup, random_winding, torus,
        unindexed, with_doubles,
    };
    use crate::weld::weld;
    use glam::{Quat, Vec3};
    use proptest::prelude::*;

    fn curvature_of(mesh: &Mesh) -> Vec<Curvature> {
        let weld = weld(mesh.positions(), 0.0);
        let normals = smooth_normals(mesh.positions(), mesh.triangles(), &weld);
        curvature(mesh.positions(), mesh.triangles(), &weld, &normals)
    }

    /// The largest difference from what `expected` gives for a vertex's position, over all it gives.
    fn worst_error(mesh: &Mesh, expected: impl Fn(Vec3) -> Option<[f32; 2]>) -> f32 {
        let found = curvature_of(mesh);
        let errors = mesh
            .positions()
            .iter()
            .zip(found)
            .filter_map(|(&position, found)| {
                let [max, min] = expected(Vec3::from_array(position))?;
                Some((found.max - max).abs().max((found.min - min).abs()))
            });
        errors.fold(0.0, f32::max)
    }

    fn torus_error(steps: u32) -> f32 {
        worst_error(&torus(2 * steps, steps, 1.0, 0.4), |p| {
            let from_axis = p.truncate().length();
            let cos_tube = (from_axis - 1.0) / 0.4;
            Some([1.0 / 0.4, cos_tube / from_axis])
        })
    }

    #[test]
    fn both_curvatures_count_with_their_signs_and_the_larger_by_its_size() {
        let saddle = Curvature {
            max: 1.0,
            min: -3.0,
            ..Curvature::default()
        };
        assert_eq!((saddle.mean(), saddle.gaussian()), (-1.0, -3.0));
        assert_eq!(tightest([1.0, -3.0]), 3.0);
        assert_eq!(tightest([2.0, -1.0]), 2.0);
    }

    #[test]
    fn a_plane_is_flat() {
        assert_eq!(worst_error(&plane(6, 4), |_| Some([0.0, 0.0])), 0.0);
    }

    #[test]
    fn a_sphere_bends_by_one_over_its_radius() {
        // Estimated normals are off by a share of the turn across an edge at the twelve vertices with
        // five neighbours, however fine the mesh.
        for radius in [0.01, 1.0, 250.0] {
            let sphere = mapped(&icosphere(4), |p| p.map(|v| v * radius));
            let error = worst_error(&sphere, |_| Some([1.0 / radius; 2]));
            assert!(error * radius < 0.04, "radius {radius}: {error}");
        }
    }

    #[test]
    fn a_sphere_with_its_own_normals_is_exact() {
        let sphere = icosphere(4);
        let weld = weld(sphere.positions(), 0.0);
        let found = curvature(
            sphere.positions(),
            sphere.triangles(),
            &weld,
            sphere.positions(),
        );
        let error = found
            .iter()
            .map(|k| (k.max - 1.0).abs().max((k.min - 1.0).abs()))
            .fold(0.0, f32::max);
        assert!(error < 1e-5, "{error}");
    }

    #[test]
    fn a_cylinder_bends_around_its_axis_only() {
        let mesh = cylinder(96, 48);
        let inside = |p: Vec3| p.z.abs() < 0.9;
        let error = worst_error(&mesh, |p| inside(p).then_some([1.0, 0.0]));
        assert!(error < 0.01, "{error}");
        for (&position, found) in mesh.positions().iter().zip(curvature_of(&mesh)) {
            let around = Vec3::Z.cross(Vec3::from_array(position));
            let cos = Vec3::from_array(found.direction).dot(around).abs();
            assert!(!inside(Vec3::from_array(position)) || cos > 0.999);
        }
    }

    #[test]
    fn a_torus_agrees_with_its_closed_form_and_converges() {
        let [coarse, middle, fine] = [16, 32, 64].map(torus_error);
        assert!(fine < 0.01, "{fine}");
        assert!(
            middle < coarse / 3.0 && fine < middle / 3.0,
            "{coarse} {middle} {fine}"
        );
    }

    #[test]
    fn an_inside_out_sphere_bends_the_other_way() {
        let inside_out = mapped(&icosphere(3), |p| p.map(|v| -v));
        assert!(worst_error(&inside_out, |_| Some([-1.0; 2])) < 0.05);
    }

    #[test]
    fn winding_does_not_matter_once_normals_are_given() {
        let sphere = icosphere(3);
        let turned = random_winding(&sphere, 5);
        let weld = weld(sphere.positions(), 0.0);
        let of = |mesh: &Mesh| {
            curvature(
                mesh.positions(),
                mesh.triangles(),
                &weld,
                sphere.positions(),
            )
        };
        for (a, b) in of(&sphere).iter().zip(of(&turned)) {
            assert!((a.max - b.max).abs() < 1e-5 && (a.min - b.min).abs() < 1e-5);
        }
    }

    #[test]
    fn slivers_and_extreme_sizes_stay_finite() {
        for size in [1e-44f32, 1e-20, 1e20, 1e38] {
            let mesh = mapped(&icosphere(1), |p| p.map(|v| v * size));
            assert!(
                curvature_of(&mesh)
                    .iter()
                    .all(|k| k.max.is_finite() && k.min.is_finite())
            );
        }
    }

    proptest! {
        #[test]
        fn anything_gives_finite_values_in_order(seed: u64, faces in 0usize..40) {
            let mesh = with_doubles(&unindexed(&random_soup(faces, seed)), seed);
            for found in curvature_of(&mesh) {
                prop_assert!(found.max.is_finite() && found.min.is_finite() && found.min <= found.max);
                prop_assert!((Vec3::from_array(found.direction).length() - 1.0).abs() < 1e-5);
            }
        }

        #[test]
        fn doubling_the_size_halves_the_curvature(power in -8i32..8) {
            let mesh = torus(20, 12, 1.0, 0.3);
            let size = 2.0_f32.powi(power);
            for (a, b) in curvature_of(&mesh).iter().zip(curvature_of(&mapped(&mesh, |p| p.map(|v| v * size)))) {
                prop_assert_eq!((a.max / size, a.min / size, a.direction), (b.max, b.min, b.direction));
            }
        }

        #[test]
        fn turning_the_mesh_turns_the_directions(x in -1.0f32..1.0, y in -1.0f32..1.0, angle in 0.0f32..6.0) {
            let mesh = torus(20, 12, 1.0, 0.3);
            let turn = Quat::from_axis_angle(Vec3::new(x, y, 1.0).normalize(), angle);
            let turned = mapped(&mesh, |p| (turn * Vec3::from_array(p)).to_array());
            for (a, b) in curvature_of(&mesh).iter().zip(curvature_of(&turned)) {
                prop_assert!((a.max - b.max).abs() < 1e-4 && (a.min - b.min).abs() < 1e-4);
                let cos = (turn * Vec3::from_array(a.direction)).dot(Vec3::from_array(b.direction)).abs();
                prop_assert!(cos > 0.999);
            }
        }

        #[test]
        fn a_mirror_image_bends_alike(major in 6u32..20, minor in 5u32..12) {
            let mesh = torus(major, minor, 1.0, 0.3);
            for (a, b) in curvature_of(&mesh).iter().zip(curvature_of(&mirrored(&mesh))) {
                prop_assert!((a.max - b.max).abs() < 1e-4 && (a.min - b.min).abs() < 1e-4);
            }
        }
    }
}
