//! How wide lines are at the vertices of a shape.

use crate::bend::bends;
use crate::kept::Cache;
use crate::look;
use glam::DVec3;
use npr_core::geometry::{Influence, NONE, Part, Vertex};
use npr_core::outline::{Outline, width_of_curvature};
use npr_core::window::View;
use npr_mesh::card::CardPoint;
use npr_mesh::curvature::bend::{Bend, WeldedMesh};
use npr_mesh::curvature::tightest;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::pose::{Matrix, Pose, pose_vertex};
use npr_mesh::{Edge, EdgeFlags, Weld};
use npr_stylesheet::{Style, WidthSource};
use npr_vector::project::Projector;

const IDENTITY: Matrix = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

/// Width factor of lines without a surface, where widths follow how it bends: the middle of the range, as where
/// curvature times gain is 1.
const BARE_SHARE: f32 = 0.5;

/// How a shape bends, for widths that follow it.
#[derive(Debug, Clone)]
pub(crate) struct ShapeBends {
    bends: Vec<Bend>,
    normals: Vec<[f32; 3]>,
    /// For every vertex, whether no face has it: only lines of the file end there.
    is_bare: Vec<bool>,
}

impl ShapeBends {
    /// Measures a shape; its curvatures are kept in 1 / `radius`, the bounding radius. O(n), parallel.
    pub fn new(cache: &Cache, shape: &HalfEdgeMesh, radius: f32) -> Self {
        // Take every vertex for itself, as the shape is welded already.
        let vertices: Vec<u32> = (0..shape.positions.len() as u32).collect();
        let weld = Weld {
            of_vertex: vertices.clone(),
            first: vertices,
        };
        let edges: Vec<Edge> = (0..shape.edge_count() as u32)
            .map(|edge| edge_between(shape.ends(edge)))
            .collect();

        // Measure the bends, and express them in radii.
        let normals = npr_mesh::smooth_normals(&shape.positions, &shape.faces, &weld);
        let mesh = WeldedMesh {
            positions: &shape.positions,
            triangles: &shape.faces,
            weld: &weld,
            edges: &edges,
            scale: 1.0,
        };
        let mut bends = bends(cache, &mesh, &normals);
        for bend in &mut bends {
            bend.curvatures = bend.curvatures.map(|curvature| curvature * radius);
            bend.tightest *= radius;
        }

        // Note the vertices that no face has.
        let mut is_bare = vec![true; shape.positions.len()];
        for corner in shape.faces.iter().flatten() {
            is_bare[*corner as usize] = false;
        }
        Self {
            bends,
            normals,
            is_bare,
        }
    }
}

/// An edge with nothing but its ends, all that smoothing reads.
fn edge_between(ends: [u32; 2]) -> Edge {
    Edge {
        ends,
        faces: [NONE; 2],
        dihedral_cos: 1.0,
        flags: EdgeFlags::NONE,
    }
}

/// What widths are measured on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WidthInput<'a> {
    pub shape: &'a HalfEdgeMesh,
    /// How the shape bends, where the style's source asks for it.
    pub bends: Option<&'a ShapeBends>,
    /// Colour of every vertex, where the model has any.
    pub colors: &'a [u32],
    pub style: &'a Style,
    pub projector: &'a Projector,
}

/// Whether a style's widths follow how the surface bends.
pub(crate) fn follow_bends(style: &Style) -> bool {
    matches!(
        style.line.width.source,
        WidthSource::Curvature | WidthSource::ProjectedCurvature
    )
}

/// Line widths of one view, as [`npr_mesh::pose`] gives them to vertices of pictures.
#[derive(Debug)]
pub(crate) struct Widths<'a> {
    input: WidthInput<'a>,
    view: &'a View,
    outline: Outline,
    /// The same for lines without a surface.
    bare_outline: Outline,
    /// A part that leaves widths alone.
    plain: [Part; 1],
}

impl<'a> Widths<'a> {
    pub fn new(input: WidthInput<'a>, view: &'a View, outline: Outline) -> Self {
        let plain = Part {
            width_factor: 1.0,
            ..Part::default()
        };
        Self {
            input,
            view,
            outline,
            bare_outline: Outline {
                flags: outline.flags & !Outline::PROJECTED_CURVATURE,
                ..outline
            },
            plain: [plain],
        }
    }

    /// Whole width of lines at a vertex, in pixels, before the factor of the surface.
    pub fn at(&self, vertex: u32) -> f32 {
        let width = match self.input.shape.cards.point(vertex) {
            Some(point) => self.of_card(point),
            None => self.of_surface(vertex),
        };
        if width.is_finite() { width } else { 0.0 }
    }

    /// As wide as a card looks, and never thinner than the thinnest line of the style.
    fn of_card(&self, point: &CardPoint) -> f32 {
        let projector = self.input.projector;
        let px = projector.pixels_per_unit(projector.depth(point.place).max(projector.near()));
        let factor = match self.input.style.line.width.source {
            WidthSource::Constant | WidthSource::Texture => self.outline.max_factor,
            _ => self.outline.min_factor,
        };
        let least = f64::from(self.outline.base_width * factor);
        let least_px = match self.outline.flags & Outline::WORLD_WIDTH {
            0 => least,
            _ => least * px,
        };

        // What of it lies along the way from the eye is not seen, nor what lies along the line.
        let way = point.place - projector.sight_start(point.place);
        let aside = way.cross(point.along).normalize_or_zero();
        let seen = match point.across == DVec3::ZERO || aside == DVec3::ZERO {
            true => point.width,
            false => point.across.dot(aside).abs(),
        };
        (seen * px).max(least_px) as f32
    }

    fn of_surface(&self, vertex: u32) -> f32 {
        // Store the vertex as pictures have it.
        let i = vertex as usize;
        let is_bare = self.input.bends.is_some_and(|measured| measured.is_bare[i]);
        let mut stored = Vertex {
            position: self.input.shape.positions[i],
            width: if is_bare { BARE_SHARE } else { self.share(i) },
            ..Vertex::default()
        };
        if let Some(measured) = self.input.bends {
            stored.curvatures = measured.bends[i].curvatures;
            stored.direction = measured.bends[i].direction;
            stored.normal = measured.normals[i];
        }

        // Pose it in this view, and read its width.
        let with = Pose {
            view: self.view,
            outline: if is_bare {
                &self.bare_outline
            } else {
                &self.outline
            },
            influences: &[],
            palette: &[IDENTITY],
            parts: &self.plain,
        };
        let rigid = Influence {
            joints: [0; 4],
            weights: [1.0, 0.0, 0.0, 0.0],
        };
        2.0 * pose_vertex(&with, &stored, &rigid).half_width
    }

    /// The width factor 0..1 that the style's source gives a vertex, 1 where the source is missing; for projected
    /// curvature the greatest curvature there.
    fn share(&self, i: usize) -> f32 {
        let width = &self.input.style.line.width;
        match width.source {
            WidthSource::Curvature => self.input.bends.map_or(1.0, |measured| {
                width_of_curvature(tightest(measured.bends[i].curvatures), width.gain)
            }),
            WidthSource::VertexColor => self.input.colors.get(i).map_or(1.0, |color| {
                f32::from(color.to_le_bytes()[width.channel.index()]) / 255.0
            }),
            WidthSource::ControlPoints => look::share_at(width, self.input.shape.positions[i]),
            WidthSource::ProjectedCurvature => self
                .input
                .bends
                .map_or(0.0, |measured| measured.bends[i].tightest),
            WidthSource::Constant | WidthSource::Texture => 1.0,
        }
    }
}
