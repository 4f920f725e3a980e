//! What a shape's lines need in every view.

use crate::mesh_lines::bvh::FaceTree;
use crate::mesh_lines::feature::features_by;
use crate::mesh_lines::graph::CurveGraph;
use crate::mesh_lines::intersect::Crossings;
use crate::mesh_lines::polyline::{polylines, touch};
use crate::mesh_lines::rounded::rounding_normals;
use crate::mesh_lines::zero_set::CornerNormals;
use npr_core::budget::{Budget, OverBudget};
use npr_core::crease::Creases;
use npr_core::edge_flags::EdgeFlags;
use npr_mesh::half_edge::HalfEdgeMesh;
use std::sync::OnceLock;
use std::sync::atomic::AtomicBool;

/// Faces around a vertex beyond which nobody walks around it.
pub(super) const WIDEST_FAN: u8 = 64;

/// What a shape's lines need in every view, prepared once.
#[derive(Debug)]
pub struct Prepared {
    /// The faces, for sights.
    pub tree: FaceTree,
    /// Boundaries, creases, material borders and marked edges, linked.
    pub features: CurveGraph,
    /// Where surfaces cut through each other.
    pub crossings: Crossings,
    /// Lines of the file itself, linked.
    pub polylines: CurveGraph,
    /// How near to a face polylines may lie without being hidden by it.
    pub(super) touch: f64,
    /// Edges that can hide something in every view: boundaries, and edges of more than two faces.
    pub(super) rims: Vec<u32>,
    /// For every object, whether it has a boundary, so that backs of faces may be seen.
    is_open: Vec<bool>,
    /// Which edges are creases.
    creases: Creases,
    /// Whether `crossings` are known; else every view looks for those of its own lines.
    pub(super) has_crossings: bool,
    /// Edges of which a view found that they go through no face and touch none with their ends.
    pub(super) whole: Vec<AtomicBool>,
    /// Number of faces around each vertex, up to a limit.
    pub(super) fans: Vec<u8>,
    /// Smooth normals, once they are asked for.
    normals: OnceLock<CornerNormals>,
}

/// Finds where faces of a shape cut through each other, with its faces in a tree.
pub type FindCrossings<'a> = dyn Fn(&FaceTree) -> Result<Crossings, OverBudget> + 'a;

impl Prepared {
    /// Prepares a shape with the creases asked for.
    ///
    /// Intersections cost more than the rest together, and are needed only as lines: without them, a view finds for
    /// itself where its lines go through faces.
    ///
    /// # Panics
    ///
    /// Never: memory is not limited. [`Prepared::with_crossings`] leaves limits to whoever finds intersections.
    pub fn new(shape: &HalfEdgeMesh, creases: impl Into<Creases>, with_crossings: bool) -> Self {
        let find: &FindCrossings<'_> = &|tree| {
            let mut budget = Budget::new(u64::MAX);
            crate::mesh_lines::intersect::crossings(shape, tree, &mut budget)
        };
        let find = with_crossings.then_some(find);
        Self::with_crossings(shape, creases.into(), find).expect("no limit is set")
    }

    /// As [`Prepared::new`], with intersections that `find` gives: within a limit of memory, or from a file that kept
    /// those of this shape.
    ///
    /// # Errors
    ///
    /// Those of `find`.
    pub fn with_crossings(
        shape: &HalfEdgeMesh,
        creases: Creases,
        find: Option<&FindCrossings<'_>>,
    ) -> Result<Self, OverBudget> {
        // Sort faces for sights, link features, and find intersections where they are wanted.
        let (tree, (features, normals, fans)) = rayon::join(
            || FaceTree::new(shape),
            || {
                let normals = rounding_normals(shape, creases);
                let features = features_by(shape, creases, normals.as_ref());
                (features, normals, fans(shape))
            },
        );
        let crossings = match find {
            Some(find) => find(&tree)?,
            None => Crossings::default(),
        };

        // Note edges that can hide something from every eye, and which objects show their backs.
        let odd = EdgeFlags::BOUNDARY | EdgeFlags::NON_MANIFOLD;
        let rims: Vec<u32> = (0..shape.edge_count() as u32)
            .filter(|edge| shape.edge_traits[*edge as usize].intersects(odd))
            .collect();
        let mut is_open = Vec::new();
        for edge in &rims {
            let object = object_of(shape, shape.sides(*edge)[0] / 3) as usize;
            is_open.resize(is_open.len().max(object + 1), false);
            is_open[object] = true;
        }
        Ok(Self {
            tree,
            features,
            crossings,
            polylines: polylines(shape),
            touch: touch(shape),
            rims,
            is_open,
            creases,
            has_crossings: find.is_some(),
            whole: (0..shape.edge_count())
                .map(|_| AtomicBool::new(false))
                .collect(),
            fans,
            normals: normals.map_or_else(OnceLock::new, OnceLock::from),
        })
    }

    /// Smooth normals at the corners of the shape's faces, made when first asked for.
    pub fn corner_normals(&self, shape: &HalfEdgeMesh) -> &CornerNormals {
        self.normals
            .get_or_init(|| CornerNormals::new(shape, self.creases))
    }

    pub(super) fn may_show_backs(&self, shape: &HalfEdgeMesh, face: u32) -> bool {
        let object = object_of(shape, face) as usize;
        self.is_open.get(object).copied().unwrap_or(false)
    }
}

fn object_of(shape: &HalfEdgeMesh, face: u32) -> u32 {
    shape.surfaces[shape.face_surfaces[face as usize] as usize].object
}

/// The number of faces around each vertex, up to [`WIDEST_FAN`] and one. O(faces).
fn fans(shape: &HalfEdgeMesh) -> Vec<u8> {
    let mut fans = vec![0_u8; shape.positions.len()];
    for vertex in shape.faces.as_flattened() {
        let fan = &mut fans[*vertex as usize];
        *fan = (*fan + 1).min(WIDEST_FAN + 1);
    }
    fans
}
