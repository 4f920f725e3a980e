//! Normals at the corners of faces, smooth up to creases.

use glam::DVec3;
use npr_core::crease::Creases;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::math;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering};

/// A normal for every corner of every face, shared by the corners that meet smoothly at a vertex.
///
/// Corner `3 f + i` carries the number of the half-edge that leaves it. Corners around a vertex that are joined by
/// edges that are no creases form a *fan* and share one normal; an edge is split where its two
/// faces belong to different fans at either end.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CornerNormals {
    /// The fan of every corner.
    fan_of: Vec<u32>,
    /// Unit normal of every fan; zero where all faces of a fan are without area.
    normals: Vec<[f32; 3]>,
    /// The vertex that a fan lies at.
    vertices: Vec<u32>,
    /// The lower half-edge of every pair of twins that lie in different fans at either end, ascending.
    split: Vec<u32>,
}

impl CornerNormals {
    /// Angle-weighted means of face normals [Thürmer & Wüthrich 1998] within each fan.
    ///
    /// Fans end at borders, at edges without a twin, and at creases; a cosine that is no number splits every edge.
    /// Faces without area have no weight.
    ///
    /// O(faces), parallel: once per shape and crease angle.
    pub fn new(shape: &HalfEdgeMesh, creases: impl Into<Creases>) -> Self {
        // Weigh faces by their angles, and part the fans around vertices at creases.
        let faces: Vec<Face> = shape
            .faces
            .par_iter()
            .map(|corners| Face::new(corners.map(|v| shape.point(v))))
            .collect();
        let fans = VertexFans::new(shape, &faces, creases.into());

        // Sum up each fan, and note which corner belongs to it.
        let heads = fans.heads();
        let fan_of: Vec<AtomicU32> = fans.across.iter().map(|_| AtomicU32::new(NONE)).collect();
        let normals = heads
            .par_iter()
            .enumerate()
            .map(|(fan, head)| {
                fans.gather(&faces, *head, |corner| {
                    fan_of[corner as usize].store(fan as u32, Ordering::Relaxed);
                })
            })
            .collect();
        let fan_of: Vec<u32> = fan_of.into_iter().map(AtomicU32::into_inner).collect();
        Self {
            split: split_edges(shape, &fans.across, &fan_of),
            vertices: heads
                .par_iter()
                .map(|corner| vertex_of(shape, *corner))
                .collect(),
            normals,
            fan_of,
        }
    }

    /// The fan that a corner belongs to.
    pub fn fan(&self, corner: u32) -> u32 {
        self.fan_of[corner as usize]
    }

    /// Unit normal at a corner, or zero where no face around it has an area.
    pub fn normal(&self, corner: u32) -> [f32; 3] {
        self.normals[self.fan(corner) as usize]
    }

    /// The lower half-edges of all edges whose sides do not share their normals, ascending; borders are not among them.
    pub fn split_edges(&self) -> &[u32] {
        &self.split
    }

    /// Value of n.v, not divided by any length, for every fan; above 0 the surface faces the eye.
    ///
    /// `eye` is homogeneous: a point with `w = 1`, or the direction towards a parallel camera with `w = 0`.
    pub fn facing_values(&self, shape: &HalfEdgeMesh, eye: [f64; 4]) -> Vec<f64> {
        self.normals
            .par_iter()
            .zip(&self.vertices)
            .with_min_len(4096)
            .map(|(normal, vertex)| {
                let normal = DVec3::from_array(normal.map(f64::from));
                normal.dot(towards(eye, shape.point(*vertex)))
            })
            .collect()
    }

    /// Whether two twins share their fans at both ends, so that normals are continuous across the edge.
    pub fn joins(&self, half_edge: u32, twin: u32) -> bool {
        joins(&self.fan_of, half_edge, twin)
    }
}

/// From a point towards a homogeneous eye; its length is the distance for `w = 1`.
pub(super) fn towards(eye: [f64; 4], point: DVec3) -> DVec3 {
    DVec3::new(eye[0], eye[1], eye[2]) - eye[3] * point
}

/// The half-edge before this one in the same face.
pub(super) fn preceding(half_edge: u32) -> u32 {
    if half_edge.is_multiple_of(3) {
        half_edge + 2
    } else {
        half_edge - 1
    }
}

fn vertex_of(shape: &HalfEdgeMesh, corner: u32) -> u32 {
    shape.faces.as_flattened()[corner as usize]
}

fn joins(fan_of: &[u32], half_edge: u32, twin: u32) -> bool {
    let fan = |corner: u32| fan_of[corner as usize];
    fan(half_edge) == fan(HalfEdgeMesh::following(twin))
        && fan(HalfEdgeMesh::following(half_edge)) == fan(twin)
}

/// Lower half-edges of twins that do not share their fans; where normals pass smoothly across, twins always do.
fn split_edges(shape: &HalfEdgeMesh, across: &[u32], fan_of: &[u32]) -> Vec<u32> {
    (0..across.len() as u32)
        .into_par_iter()
        .filter(|half_edge| {
            let twin = shape.twins[*half_edge as usize];
            across[*half_edge as usize] == NONE
                && twin != NONE
                && *half_edge < twin
                && !joins(fan_of, *half_edge, twin)
        })
        .collect()
}

/// Unit normal and corner angles of a face; all zero where it has no area.
#[derive(Debug, Clone, Copy, Default)]
struct Face {
    normal: [f32; 3],
    angles: [f32; 3],
}

impl Face {
    fn new([a, b, c]: [DVec3; 3]) -> Self {
        // Leave out faces without area.
        let sides = [b - a, c - b, a - c];
        let cross = sides[0].cross(sides[1]);
        let twice_area = cross.length();
        if !(twice_area > 0.0 && twice_area.is_finite()) {
            return Self::default();
        }

        // Take two angles; the third completes them to half a turn.
        let angle = |i: usize| {
            let dot = -sides[i].dot(sides[(i + 2) % 3]);
            let scale = twice_area.max(dot.abs());
            math::atan2((twice_area / scale) as f32, (dot / scale) as f32)
        };
        let [first, second] = [angle(0), angle(1)];
        Self {
            normal: (cross / twice_area).as_vec3().to_array(),
            angles: [
                first,
                second,
                (std::f32::consts::PI - first - second).max(0.0),
            ],
        }
    }
}

/// Corners linked around their vertices.
struct VertexFans {
    /// The twin of every half-edge across which normals are smooth, or [`NONE`].
    across: Vec<u32>,
}

impl VertexFans {
    fn new(shape: &HalfEdgeMesh, faces: &[Face], creases: Creases) -> Self {
        let smooth = |half_edge: u32, twin: u32| {
            let edge = shape.edge_of[half_edge as usize];
            let cos = if !shape.edge_traits[edge as usize].contains(EdgeFlags::NON_MANIFOLD) {
                shape.fold_cos(edge, creases.from)
            } else {
                let [a, b] = [half_edge, twin].map(|h| faces[h as usize / 3].normal);
                a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
            };
            cos >= creases.cos
        };
        let across = |(half_edge, twin): (usize, &u32)| match *twin {
            NONE => NONE,
            twin if smooth(half_edge as u32, twin) => twin,
            _ => NONE,
        };
        Self {
            across: shape.twins.par_iter().enumerate().map(across).collect(),
        }
    }

    /// The next corner around the same vertex, or [`NONE`] where the fan ends.
    fn next(&self, corner: u32) -> u32 {
        self.across[preceding(corner) as usize]
    }

    /// The first corner of every fan: where it begins, or the lowest of a closed one.
    fn heads(&self) -> Vec<u32> {
        let is_head = |corner: &u32| {
            let mut at = *corner;
            loop {
                if self.across[*corner as usize] == NONE {
                    return true;
                }
                at = self.next(at);
                if at == *corner {
                    return true;
                }
                if at == NONE || at < *corner {
                    return false;
                }
            }
        };
        (0..self.across.len() as u32)
            .into_par_iter()
            .filter(is_head)
            .collect()
    }

    /// The mean normal of a fan; `visit` sees all its corners.
    fn gather(&self, faces: &[Face], head: u32, visit: impl Fn(u32)) -> [f32; 3] {
        let mut sum = DVec3::ZERO;
        let mut corner = head;
        loop {
            visit(corner);
            let face = &faces[corner as usize / 3];
            let normal = DVec3::from_array(face.normal.map(f64::from));
            sum += normal * f64::from(face.angles[corner as usize % 3]);
            corner = self.next(corner);
            if corner == NONE || corner == head {
                break;
            }
        }
        sum.normalize_or_zero().as_vec3().to_array()
    }
}
