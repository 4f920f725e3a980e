//! Vertices posed and projected: the twin of `mesh.pose_vertices`.

use crate::curvature::tightest;
use npr_core::geometry::{Influence, Part, PosedVertex, Vertex};
use npr_core::math;
use npr_core::outline::{Outline, width_factor, width_of_curvature};
use npr_core::surface::{apply_point, dot, unit_or_z};
use npr_core::window::View;
use rayon::prelude::*;

/// A column-major 4x4 matrix.
pub type Matrix = [[f32; 4]; 4];

/// Keeps the projected curvature finite where the radial curvature vanishes, in units of 1 / bounding radius squared.
const RADIAL_FLOOR: f32 = 0.01;

/// Share of the frame's height at which a radius of curvature counts as 1 before the gain.
const CURVATURE_SCALE: f32 = 0.1;

/// Width of a line as a share of the radius that it turns with, at most: wider, it would fill what it goes round.
///
/// Fingers, rivets and far things draw tight bends, which are not to be drawn with the widest pen; nor is the noise
/// of a scan.
const BEND_SHARE: f32 = 0.2;

/// Width of a line as a share of the tightest radius of the surface, at most: ribs and folds as close as lines are
/// wide would close to black.
const GIRTH_SHARE: f32 = 0.5;

/// What vertices are posed with.
#[derive(Debug, Clone, Copy)]
pub struct Pose<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// Settings that widths follow.
    pub outline: &'a Outline,
    /// Which matrices move each vertex.
    pub influences: &'a [Influence],
    /// The matrices, world from rest space.
    pub palette: &'a [Matrix],
    /// Parts, for their width factors.
    pub parts: &'a [Part],
}

/// Poses, projects and sizes every vertex [Okuya et al. 2016, section 4.1].
///
/// Deformation is linear blend skinning; a rigid vertex hangs on one matrix. O(vertices), parallel.
pub fn pose(with: &Pose<'_>, vertices: &[Vertex], posed: &mut [PosedVertex]) {
    let inputs = vertices.par_iter().zip(with.influences);
    posed
        .par_iter_mut()
        .zip(inputs)
        .with_min_len(1024)
        .for_each(|(out, (vertex, influence))| {
            *out = pose_vertex(with, vertex, influence);
        });
}

/// Poses, projects and sizes one vertex.
pub fn pose_vertex(with: &Pose<'_>, vertex: &Vertex, influence: &Influence) -> PosedVertex {
    let (view, outline) = (with.view, with.outline);
    let m = blended_matrix(with.palette, influence);
    let [x, y, z, _] = apply_point(&m, vertex.position);
    let world = [x, y, z];
    let normal = apply_normal(&m, vertex.normal);
    let direction = unit_or_z(apply_direction(&m, math::unpack_unit(vertex.direction)));
    let from_eye: [f32; 3] = std::array::from_fn(|i| world[i] - view.eye_world[i]);
    let depth = dot(from_eye, view.forward_world);

    // Turn the width factor into pixels.
    let (s, widest) = width_at(with, vertex, normal, direction, world, depth);
    let part = &with.parts[vertex.part as usize];
    let mut base = outline.base_width * part.width_factor;
    let is_in_world = part.flags & Part::WORLD_LINE != 0;
    if is_in_world || outline.flags & Outline::WORLD_WIDTH != 0 {
        base /= view.pixel_before_eye(depth);
    }
    let width = base * width_factor(outline.min_factor, outline.max_factor, s);
    let width = width.min(widest.max(base * outline.min_factor));
    PosedVertex {
        clip: apply_point(&view.clip_from_world, world),
        world,
        depth,
        normal,
        half_width: 0.5 * width,
    }
}

/// Widest line, in pixels, round a bend of the curvature `bend_px` on a surface whose tightest is `tightest_px`, both
/// in 1 / pixel.
pub fn widest_round(bend_px: f32, tightest_px: f32) -> f32 {
    let round_bend = BEND_SHARE / bend_px.abs().max(1e-6);
    round_bend.min(GIRTH_SHARE / tightest_px.abs().max(1e-6))
}

/// Width factor 0..1 of a vertex, and the widest line that there is room for, in pixels.
fn width_at(
    with: &Pose<'_>,
    vertex: &Vertex,
    normal: [f32; 3],
    direction: [f32; 3],
    world: [f32; 3],
    depth: f32,
) -> (f32, f32) {
    if with.outline.flags & Outline::PROJECTED_CURVATURE == 0 {
        return (vertex.width, widest_round(0.0, 0.0));
    }
    let eye = with.view.to_eye(world);
    let curvature = projected_curvature(vertex.curvatures, normal, direction, eye);
    let curvature = curvature / with.outline.radius_world;
    let tightest = vertex.width / with.outline.radius_world;
    let height = with.view.height_at(depth);
    let s = width_of_curvature(curvature * height * CURVATURE_SCALE, with.outline.gain);
    let pixel = with.view.pixel_at(depth);
    (s, widest_round(curvature * pixel, tightest * pixel))
}

/// Curvature of the outline that a surface would have at a point, seen along `eye`.
///
/// The Gaussian curvature over the radial curvature [Koenderink 1984]; `direction` is that of the first curvature.
/// Kept finite where the radial curvature vanishes; seen straight on, the larger principal curvature.
pub fn projected_curvature(
    curvatures: [f32; 2],
    normal: [f32; 3],
    direction: [f32; 3],
    eye: [f32; 3],
) -> f32 {
    // Look along the surface; seen straight on, there is no way along it.
    let toward = dot(eye, normal);
    let along: [f32; 3] = std::array::from_fn(|i| eye[i] - normal[i] * toward);
    let square = dot(along, along);
    let [first, second] = curvatures;
    if square < 1e-12 {
        return tightest(curvatures);
    }

    // Turn the curvatures to that way.
    let cosine = dot(along, direction) / square.sqrt();
    let c2 = (cosine * cosine).clamp(0.0, 1.0);
    let s2 = 1.0 - c2;
    let radial = first * c2 + second * s2;
    let across = first * s2 + second * c2;
    let twist2 = (first - second) * (first - second) * s2 * c2;

    // Divide the Gaussian by the radial curvature.
    across - twist2 * radial / (radial * radial + RADIAL_FLOOR)
}

/// The blended matrix of an influence.
pub(crate) fn blended_matrix(palette: &[Matrix], influence: &Influence) -> Matrix {
    let mut m = [[0.0; 4]; 4];
    for k in 0..4 {
        let joint = &palette[influence.joints[k] as usize];
        let weight = influence.weights[k];
        for (column, joint_column) in m.iter_mut().zip(joint) {
            for (value, joint_value) in column.iter_mut().zip(joint_column) {
                *value += joint_value * weight;
            }
        }
    }
    m
}

fn apply_direction(m: &Matrix, v: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|i| m[0][i] * v[0] + m[1][i] * v[1] + m[2][i] * v[2])
}

/// Normals go by the cofactors, which stay finite where the matrix is singular.
pub(crate) fn apply_normal(m: &Matrix, n: [f32; 3]) -> [f32; 3] {
    let column = |i: usize| [m[i][0], m[i][1], m[i][2]];
    let yz = cross(column(1), column(2));
    let zx = cross(column(2), column(0));
    let xy = cross(column(0), column(1));
    let turned: [f32; 3] = std::array::from_fn(|i| yz[i] * n[0] + zx[i] * n[1] + xy[i] * n[2]);
    let mirrored = dot(column(0), yz) < 0.0;
    unit_or_z(if mirrored { turned.map(|v| -v) } else { turned })
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const IDENTITY: Matrix = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];

    fn unit(v: [f32; 3]) -> [f32; 3] {
        unit_or_z(v)
    }

    proptest! {
        #[test]
        fn a_sphere_shows_its_own_curvature_from_everywhere(
            k in 0.1f32..10.0, x in -1f32..1.0, y in -1f32..1.0, z in -1f32..1.0,
        ) {
            let eye = unit([x, y, z + 1e-3]);
            let got = projected_curvature([k, k], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], eye);
            prop_assert!((got - k).abs() < 1e-3 * k, "{got} for {k}");
        }

        #[test]
        fn a_cylinder_seen_from_the_side_has_a_straight_outline(k in 0.5f32..5.0, slant in -0.9f32..0.9) {
            // The outline of a cylinder is a straight ruling from every view that is not along its axis.
            let eye = unit([1.0, slant, 0.0]);
            let got = projected_curvature([k, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], eye);
            prop_assert!(got.abs() < 0.05 * k, "{got} for {k}");
        }

        #[test]
        fn normals_stay_perpendicular_under_any_matrix(
            m in prop::array::uniform9(-2f32..2.0), n in prop::array::uniform3(-1f32..1.0),
            t in prop::array::uniform3(-1f32..1.0),
        ) {
            let column = |i: usize| [m[i], m[i + 1], m[i + 2], 0.0];
            let matrix = [column(0), column(3), column(6), [0.0, 0.0, 0.0, 1.0]];
            let determinant = dot([m[0], m[1], m[2]], cross([m[3], m[4], m[5]], [m[6], m[7], m[8]]));
            prop_assume!(determinant.abs() > 0.1 && dot(n, n) > 0.1);
            let n = unit(n);
            let tangent: [f32; 3] = std::array::from_fn(|i| t[i] - n[i] * dot(t, n));
            let moved = apply_direction(&matrix, tangent);
            prop_assert!(dot(apply_normal(&matrix, n), moved).abs() < 1e-3);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn lines_never_fill_what_they_go_round(
            radius in 0.01f32..2.0, base in 0.5f32..20.0, least in 0.05f32..1.0, gain in 0.1f32..10.0,
        ) {
            let view = View { view_height: 1.0, frame_px: [1000.0; 2], ..View::default() };
            let outline = Outline {
                base_width: base, min_factor: least, max_factor: 2.0, gain, radius_world: 1.0,
                flags: Outline::PROJECTED_CURVATURE, ..Outline::default()
            };
            let parts = [Part { width_factor: 1.0, ..Part::default() }];
            let influences = [Influence { joints: [0; 4], weights: [1.0, 0.0, 0.0, 0.0] }];
            let palette = [IDENTITY];
            let with = Pose {
                view: &view, outline: &outline, influences: &influences, palette: &palette, parts: &parts,
            };
            let ball = Vertex { curvatures: [1.0 / radius; 2], normal: [0.0, 0.0, 1.0], ..Vertex::default() };
            let width = 2.0 * pose_vertex(&with, &ball, &influences[0]).half_width;
            // A ball of this radius is 1000 radius pixels wide to either side.
            let room = BEND_SHARE * 1000.0 * radius;
            prop_assert!(width <= room.max(base * least) * 1.001);
            prop_assert!(width >= base * least * 0.999);
            prop_assert!(room < 2.0 * base || width > base * least);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn ribs_stay_apart_from_their_lines(bend in -1f32..1.0, radius_px in 0.1f32..100.0) {
            // A line on either side of a rib takes half of it, whatever bend they follow.
            let widest = widest_round(bend, 1.0 / radius_px);
            prop_assert!(2.0 * widest <= radius_px * 1.001);
            prop_assert!(widest <= widest_round(bend, 0.0) && widest > 0.0);
        }
    }

    #[test]
    fn a_mirror_keeps_normals_outside() {
        let mut mirror = IDENTITY;
        mirror[0][0] = -1.0;
        assert_eq!(apply_normal(&mirror, [1.0, 0.0, 0.0]), [-1.0, 0.0, 0.0]);
        assert_eq!(apply_normal(&mirror, [0.0, 1.0, 0.0]), [0.0, 1.0, 0.0]);
    }

    #[test]
    fn half_of_two_joints_moves_half_way() {
        let mut moved = IDENTITY;
        moved[3] = [0.0, 4.0, 0.0, 1.0];
        let influence = Influence {
            joints: [0, 1, 0, 0],
            weights: [0.5, 0.5, 0.0, 0.0],
        };
        let m = blended_matrix(&[IDENTITY, moved], &influence);
        assert_eq!(apply_point(&m, [1.0, 0.0, 0.0]), [1.0, 2.0, 0.0, 1.0]);
    }
}
