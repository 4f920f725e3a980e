//! Shapes whose outlines are known in closed form.

use glam::{DVec2, DVec3};
use libm::{acos, atan2, cos, sin};
use npr_core::camera::Camera;
use npr_vector::stroke::Kind;

use super::chains::{cut, joined};
use super::layers::Layer;
use super::reference::{Piece, Reference, Sample, Sight};
use super::viewpoint::{Viewpoint, wide};

/// Longest piece of an outline, in pixels.
const STEP_PX: f64 = 0.5;

/// A shape whose outline is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solid {
    /// A ball of radius 1 around the origin.
    Ball,
    /// A ring around the z axis: circles of radius `tube` around a circle of radius 1.
    Ring {
        /// Under 1.
        tube: f64,
    },
}

/// Vertices and triangles.
pub type Triangles = (Vec<[f32; 3]>, Vec<[u32; 3]>);

impl Solid {
    /// The visible outline in perspective, from an eye outside of the shape.
    pub fn reference(self, camera: &Camera, size: [u32; 2]) -> Reference {
        let (view, eye) = (Viewpoint::new(camera, size), wide(camera.eye));
        let mut reference = Reference::default();
        for branch in self.branches().iter().copied() {
            // Count pieces so that the longest is as long as it may be.
            let outline = |count: u32| -> Vec<Place> {
                let angle = |i| std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(count);
                (0..count)
                    .map(|i| self.outline(eye, angle(i), branch))
                    .collect()
            };
            let coarse = lengths(&outline(1024), &view);
            let longest = coarse.iter().copied().fold(0.0, f64::max);
            let places = outline(1024 * (longest / STEP_PX).ceil().max(1.0) as u32);
            let pieces = lengths(&places, &view);
            let at: Vec<[f64; 2]> = places.iter().map(|p| view.project(p.point)).collect();
            let samples = (0..places.len()).map(|i| {
                let (place, at, next) = (&places[i], at[i], at[(i + 1) % at.len()]);
                let in_frame = (0..2).all(|i| (0.0..=view.size()[i]).contains(&at[i]));
                let sight = if in_frame {
                    self.sight(eye, place.point)
                } else {
                    Sight::Hidden
                };
                Sample {
                    at,
                    ends: [at, next],
                    length: pieces[i],
                    sight,
                }
            });
            let samples: Vec<Sample> = samples.collect();
            let seen = places
                .iter()
                .zip(&samples)
                .filter(|(_, s)| s.sight == Sight::Visible);
            reference
                .pieces
                .extend(seen.map(|(place, sample)| piece(place, sample, &view)));
            let layer = Layer {
                kind: Kind::Contour,
                object: 0,
            };
            let runs = cut(layer, true, samples);
            reference.joined.extend(joined(&runs));
            reference.runs.extend(runs);
        }
        reference.draw(&view);
        reference
    }

    /// Closed curves that the outline is made of.
    fn branches(self) -> &'static [f64] {
        match self {
            Self::Ball => &[1.0],
            Self::Ring { .. } => &[1.0, -1.0],
        }
    }

    /// A point where the surface is seen edge on.
    fn outline(self, eye: DVec3, angle: f64, branch: f64) -> Place {
        match self {
            Self::Ball => {
                let away = eye.length();
                let (axis, across) = (eye / away, (eye / away).any_orthonormal_pair());
                let radius = (1.0 - 1.0 / (away * away)).sqrt();
                let turned = across.0 * cos(angle) + across.1 * sin(angle);
                let point = axis / away + turned * radius;
                Place {
                    point,
                    normal: point,
                }
            }
            Self::Ring { tube } => {
                // With A the part of the eye in the plane of this circle: (A - 1) cos v + z sin v = tube.
                let out = DVec3::new(cos(angle), sin(angle), 0.0);
                let reach = eye.dot(out) - 1.0;
                let half = acos((tube / reach.hypot(eye.z)).min(1.0));
                let v = atan2(eye.z, reach) + branch * half;
                let normal = out * cos(v) + DVec3::Z * sin(v);
                Place {
                    point: out + normal * tube,
                    normal,
                }
            }
        }
    }

    /// Whether anything of the shape lies before a point of its outline.
    ///
    /// The ring is a polynomial of fourth degree along a line of sight, which has a double root where it touches:
    /// what is left when that is divided out has degree two.
    fn sight(self, eye: DVec3, point: DVec3) -> Sight {
        let Self::Ring { tube } = self else {
            return Sight::Visible;
        };
        let d = point - eye;
        let (flat_eye, flat) = (eye.truncate(), d.truncate());
        let (a, b) = (d.length_squared(), 2.0 * eye.dot(d));
        let k = eye.length_squared() + 1.0 - tube * tube;
        let (fourth, third) = (a * a, 2.0 * a * b);
        let second = b * b + 2.0 * a * k - 4.0 * flat.length_squared();
        let [q2, q1] = [fourth, third + 2.0 * fourth];
        let q0 = second + 2.0 * q1 - q2;
        debug_assert!((k * k - 4.0 * flat_eye.length_squared() - q0).abs() < 1e-6 * (1.0 + k * k));
        let root = (q1 * q1 - 4.0 * q2 * q0).max(0.0).sqrt();
        let crosses = q1 * q1 > 4.0 * q2 * q0;
        let before = |t: f64| t > 0.0 && t < 1.0;
        let hides =
            crosses && (before((-q1 - root) / (2.0 * q2)) || before((-q1 + root) / (2.0 * q2)));
        if hides { Sight::Hidden } else { Sight::Visible }
    }

    /// A mesh of the shape, of about `triangle_count` triangles in even rows.
    pub fn mesh(self, triangle_count: u32) -> Triangles {
        match self {
            Self::Ball => {
                let bands = libm::sqrt(f64::from(triangle_count) / 4.0).max(2.0) as u32;
                let ball = npr_mesh::testing::uv_sphere((2 * bands).max(3), bands);
                (ball.positions().to_vec(), ball.triangles().to_vec())
            }
            Self::Ring { tube } => {
                let around = libm::sqrt(f64::from(triangle_count) / 4.0).max(3.0) as u32;
                tube_mesh(2 * around, around, |u, v| {
                    let reach = 1.0 + tube * cos(v);
                    DVec3::new(reach * cos(u), reach * sin(u), tube * sin(v))
                })
            }
        }
    }
}

/// A closed tube of `along` times `around` quads; the place at two angles is given.
pub fn tube_mesh(along: u32, around: u32, place: impl Fn(f64, f64) -> DVec3) -> Triangles {
    let angle = |i: u32, count: u32| std::f64::consts::TAU * f64::from(i) / f64::from(count);
    let number = |i: u32, j: u32| (i % along) * around + j % around;
    let cells = || (0..along).flat_map(|i| (0..around).map(move |j| (i, j)));
    let positions = cells().map(|(i, j)| {
        place(angle(i, along), angle(j, around))
            .as_vec3()
            .to_array()
    });
    let triangles = cells().flat_map(|(i, j)| {
        let [a, b, c, d] =
            [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| number(i, j));
        [[a, b, c], [a, c, d]]
    });
    (positions.collect(), triangles.collect())
}

/// A point of an outline, and which way the surface faces there.
#[derive(Debug, Clone, Copy)]
struct Place {
    point: DVec3,
    normal: DVec3,
}

fn piece(place: &Place, sample: &Sample, view: &Viewpoint) -> Piece {
    let out = view.project(place.point + place.normal * 1e-6);
    let outward = (DVec2::from(out) - DVec2::from(sample.at)).normalize_or_zero();
    Piece {
        at: sample.at,
        length: sample.length,
        kind: Kind::Contour,
        due: true,
        outward: outward.to_array(),
    }
}

/// The length in the picture that each place of a closed curve stands for.
fn lengths(places: &[Place], view: &Viewpoint) -> Vec<f64> {
    let at: Vec<DVec2> = places
        .iter()
        .map(|place| view.project(place.point).into())
        .collect();
    let count = at.len();
    let step = |i: usize| at[i].distance(at[(i + 1) % count]);
    (0..count)
        .map(|i| (step(i) + step((i + count - 1) % count)) / 2.0)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::candidates::Wanted;
    use crate::lines::soup::Soup;
    use npr_core::camera::Projection;

    const SIZE: [u32; 2] = [640, 480];

    fn camera(eye: [f32; 3]) -> Camera {
        Camera {
            eye,
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 0.6 },
        }
    }

    /// Share of the pieces of `a` within `px` of `b`.
    fn covered(a: &Reference, b: &Reference, px: f64) -> f64 {
        let bins = super::super::ink::Bins::new(b.pieces.iter().map(|p| p.at).collect(), px);
        let near = a.pieces.iter().filter(|p| bins.nearest(p.at, px).is_some());
        near.map(|p| p.length).sum::<f64>() / a.pieces.iter().map(|p| p.length).sum::<f64>()
    }

    #[test]
    fn fine_meshes_have_the_outline_of_their_shape() {
        let solids = [Solid::Ball, Solid::Ring { tube: 0.4 }];
        for (solid, eye) in solids
            .into_iter()
            .flat_map(|s| [(s, [1.0, 2.0, 3.5]), (s, [3.6, 0.3, 0.8])])
        {
            let exact = solid.reference(&camera(eye), SIZE);
            let (positions, triangles) = solid.mesh(80_000);
            let soup = Soup::of_mesh(&positions, &triangles);
            let view = Viewpoint::new(&camera(eye), SIZE);
            let found = Reference::new(&soup, &view, &Wanted::default());
            assert!(covered(&exact, &found, 1.0) > 0.99, "{solid:?} {eye:?}");
            assert!(covered(&found, &exact, 1.0) > 0.98, "{solid:?} {eye:?}");
        }
    }

    #[test]
    fn a_ring_from_above_shows_two_circles_and_from_the_side_fewer_whole_ones() {
        let ring = Solid::Ring { tube: 0.3 };
        let above = ring.reference(&camera([0.0, 0.1, 5.0]), SIZE);
        assert!(above.runs.len() == 2 && above.runs.iter().all(|run| run.closed));
        let side = ring.reference(&camera([5.0, 0.0, 1.0]), SIZE);
        assert!(side.runs.iter().any(|run| !run.closed), "a part is hidden");
        assert!(above.pieces.iter().all(|p| p.length <= STEP_PX * 1.01));
    }
}
