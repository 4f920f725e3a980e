//! From a shape and a camera to strokes.
//!
//! [`Prepared`] holds what does not depend on the camera; [`strokes`] does the rest for one view: it gathers the
//! pieces of all lines, finds what is seen of them, joins what goes on, and smooths.

use crate::bvh::FaceTree;
use crate::contour::{Eye, contours, facing};
use crate::doubles::suppress;
use crate::feature::{features, kind_in_view};
use crate::graph::{CurveGraph, CurveNode};
use crate::intersect::Crossings;
use crate::merge::{FACING_PX, TOUCHING_PX, merge_ends};
use crate::project::Projector;
use crate::run::{Line, Run, runs};
use crate::smooth::smooth;
use crate::stroke::{Kind, Stroke, StrokePoint};
use crate::visibility::{Circumstances, OutlineGrid, Piece, Seen, Span};
use glam::DVec3;
use npr_core::geometry::NONE;
use npr_core::shape::Shape;
use rayon::prelude::*;

/// How contours are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Along mesh edges, exact for the polygons.
    #[default]
    Edges,
    /// Where interpolated normals turn away, smooth.
    Surface,
}

/// Which lines are wanted, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSettings {
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Bits of [`CurveNode::KINDS`].
    pub kinds: u32,
    /// How contours are found.
    pub method: Method,
    /// Smooths strokes, joins their ends, and leaves out what is too short to read.
    pub smooth: bool,
    /// Gives hidden lines too, with the number of surfaces in front.
    pub hidden: bool,
}

/// Up to how many surfaces in front of a hidden line are counted.
const HIDDEN_COUNT_LIMIT: u32 = 255;

/// What can be known of a shape's lines before there is a camera.
#[derive(Debug)]
pub struct Prepared {
    /// The faces, for sights.
    pub tree: FaceTree,
    /// Boundaries, creases, material borders and marked edges, linked.
    pub features: CurveGraph,
    /// Where surfaces cut through each other.
    pub crossings: Crossings,
    /// Edges that can hide something in every view: borders, and edges of more than two faces.
    rims: Vec<u32>,
    /// For every object, whether it has a border, so that backs of faces may be seen.
    is_open: Vec<bool>,
}

impl Prepared {
    /// Prepares a shape whose edges are creases where the cosine between normals is under `crease_cos`.
    pub fn new(shape: &Shape, crease_cos: f32, with_crossings: bool) -> Self {
        let (tree, features) = rayon::join(|| FaceTree::new(shape), || features(shape, crease_cos));
        let crossings = if with_crossings {
            crate::intersect::crossings(shape, &tree)
        } else {
            Crossings::default()
        };
        let odd = Shape::BORDER | Shape::NON_MANIFOLD;
        let rims: Vec<u32> = (0..shape.edge_count() as u32)
            .filter(|edge| shape.edge_traits[*edge as usize] & odd != 0)
            .collect();
        let mut is_open = Vec::new();
        for edge in &rims {
            let object = object_of(shape, shape.sides(*edge)[0] / 3) as usize;
            is_open.resize(is_open.len().max(object + 1), false);
            is_open[object] = true;
        }
        Self {
            tree,
            features,
            crossings,
            rims,
            is_open,
        }
    }

    fn may_show_backs(&self, shape: &Shape, face: u32) -> bool {
        let object = object_of(shape, face) as usize;
        self.is_open.get(object).copied().unwrap_or(false)
    }
}

fn object_of(shape: &Shape, face: u32) -> u32 {
    shape.surfaces[shape.face_surfaces[face as usize] as usize].object
}

/// The lines of a view as strokes; visible ones first where hidden ones are asked for, then by chain.
///
/// `width_at` gives the whole line width in pixels at a vertex of the shape. O(faces + lines log lines); most of
/// the time goes into one sight for every span of every line.
pub fn strokes(
    shape: &Shape,
    prepared: &Prepared,
    projector: &Projector,
    settings: &LineSettings,
    width_at: &(dyn Fn(u32) -> f32 + Sync),
) -> Vec<Stroke> {
    let extent = extent_of(shape, projector);
    let eye = Eye::new(projector.eye(), extent);
    let front = facing(shape, &eye);
    let view = View {
        shape,
        prepared,
        projector,
        settings,
        front: &front,
    };
    let edge_contours = contours(shape, &front, &eye);
    let outlines = OutlineGrid::new(settings.size, view.outlines(&edge_contours));
    let seen = Seen {
        shape,
        tree: &prepared.tree,
        projector,
        outlines: &outlines,
        count_limit: if settings.hidden {
            HIDDEN_COUNT_LIMIT
        } else {
            1
        },
    };
    let graphs = [
        &edge_contours,
        &prepared.features,
        &prepared.crossings.graph,
    ];
    let mut found: Vec<Run> = graphs
        .iter()
        .flat_map(|graph| runs(shape, projector, graph, &view.lines(graph, &seen)))
        .filter(|run| settings.hidden || run.occluders == 0)
        .collect();
    if settings.smooth {
        found = merge_ends(found, TOUCHING_PX);
        smooth(&mut found);
        found = merge_ends(suppress(found), FACING_PX);
        smooth(&mut found);
    }
    into_strokes(shape, found, width_at)
}

/// Largest coordinate of the shape and the eye.
fn extent_of(shape: &Shape, projector: &Projector) -> f32 {
    let [x, y, z, w] = projector.eye();
    let eye = if w == 0.0 {
        0.0
    } else {
        x.abs().max(y.abs()).max(z.abs()) as f32
    };
    let largest =
        |extent: f32, p: &[f32; 3]| extent.max(p[0].abs()).max(p[1].abs()).max(p[2].abs());
    let shape = shape
        .positions
        .par_chunks(1 << 16)
        .map(|chunk| chunk.iter().fold(0.0, largest))
        .reduce(|| 0.0, f32::max);
    shape.max(eye)
}

/// One view of a shape.
struct View<'a> {
    shape: &'a Shape,
    prepared: &'a Prepared,
    projector: &'a Projector,
    settings: &'a LineSettings,
    front: &'a [u8],
}

impl View<'_> {
    /// Everything that can begin or end hiding something: contours, borders, and edges of more than two faces.
    fn outlines(&self, contours: &CurveGraph) -> Vec<Piece> {
        let loops = contours
            .nodes
            .par_iter()
            .with_min_len(1024)
            .filter(|node| node.flags & CurveNode::CONTOUR != 0)
            .filter_map(|node| self.edge_piece(node.edge));
        let odd = self
            .prepared
            .features
            .nodes
            .par_iter()
            .with_min_len(1024)
            .filter(|node| node.next != NONE && self.kinds_of(node) & CurveNode::CONTOUR != 0)
            .filter_map(|node| self.edge_piece(node.edge));
        let rims = self
            .prepared
            .rims
            .par_iter()
            .with_min_len(1024)
            .filter_map(|edge| self.edge_piece(*edge));
        loops.chain(odd).chain(rims).collect()
    }

    fn edge_piece(&self, edge: u32) -> Option<Piece> {
        let [a, b] = self
            .shape
            .ends(edge)
            .map(|v| DVec3::from(self.shape.positions[v as usize].map(f64::from)));
        Piece::new(self.projector, self.settings.size, a, b)
    }

    /// The kinds of the piece after a node in this view.
    fn kinds_of(&self, node: &CurveNode) -> u32 {
        let feature = CurveNode::KINDS & !(CurveNode::CONTOUR | CurveNode::INTERSECTION);
        let in_loop = node.flags & (CurveNode::CONTOUR | CurveNode::SEAM | CurveNode::INTERSECTION);
        if in_loop != 0 {
            return node.flags & CurveNode::KINDS;
        }
        let flags = kind_in_view(self.shape, self.front, node.edge, node.flags & feature);
        let sides = self.shape.sides(node.edge);
        let backs = sides.iter().all(|side| self.front[*side as usize / 3] == 0);
        if backs && sides.len() == 2 && !self.prepared.may_show_backs(self.shape, node.face) {
            return flags & CurveNode::CONTOUR;
        }
        flags
    }

    /// What is drawn of every node of a graph, and what is seen of it.
    fn lines(&self, graph: &CurveGraph, seen: &Seen<'_>) -> Vec<Option<Line>> {
        graph
            .nodes
            .par_iter()
            .with_min_len(64)
            .map(|node| self.line(graph, node, seen))
            .collect()
    }

    fn line(&self, graph: &CurveGraph, node: &CurveNode, seen: &Seen<'_>) -> Option<Line> {
        if node.next == NONE {
            return None;
        }
        let kinds = self.kinds_of(node) & (self.settings.kinds | CurveNode::MARKED);
        let kind = first_kind(kinds)?;
        let concave = node.flags & CurveNode::CONCAVE != 0;
        if concave && !self.prepared.may_show_backs(self.shape, node.face) {
            return None;
        }
        let other = &graph.nodes[node.next as usize];
        let [a, b] = [node, other].map(|node| self.point_of(node));
        let piece = Piece::new(self.projector, self.settings.size, a, b)?;
        let spans: Vec<Span> = seen.spans(&piece, &self.circumstances(node, other));
        Some(Line {
            kind,
            surface: self.shape.face_surfaces[node.face as usize],
            piece,
            spans,
        })
    }

    fn point_of(&self, node: &CurveNode) -> DVec3 {
        let [a, b] = self
            .shape
            .ends(node.edge)
            .map(|v| DVec3::from(self.shape.positions[v as usize].map(f64::from)));
        a.lerp(b, f64::from(node.t))
    }

    /// Faces that a piece lies in, and where it goes through others.
    fn circumstances(&self, node: &CurveNode, other: &CurveNode) -> Circumstances {
        let mut own_faces: Vec<u32> = self
            .shape
            .sides(node.edge)
            .iter()
            .map(|side| side / 3)
            .collect();
        if node.is_along_edge() {
            let piercings = self.prepared.crossings.of_edge(node.edge);
            let up = node.t < 0.5;
            let places = piercings
                .iter()
                .map(|p| f64::from(if up { p.t } else { 1.0 - p.t }));
            return Circumstances {
                own_faces,
                piercings: places.collect(),
            };
        }
        own_faces.extend(self.shape.sides(other.edge).iter().map(|side| side / 3));
        own_faces.push(node.face);
        for end in [node, other] {
            let pierced = self.prepared.crossings.of_edge(end.edge).iter();
            own_faces.extend(pierced.filter(|p| p.t == end.t).map(|p| p.face));
        }
        Circumstances {
            own_faces,
            piercings: Vec::new(),
        }
    }
}

/// The kind that a piece of several kinds is drawn as.
fn first_kind(kinds: u32) -> Option<Kind> {
    let bits = [
        CurveNode::CONTOUR,
        CurveNode::BOUNDARY,
        CurveNode::CREASE,
        CurveNode::MATERIAL,
        CurveNode::INTERSECTION,
        CurveNode::MARKED,
    ];
    bits.iter()
        .position(|bit| kinds & bit != 0)
        .map(|index| Kind::ALL[index])
}

fn into_strokes(
    shape: &Shape,
    runs: Vec<Run>,
    width_at: &(dyn Fn(u32) -> f32 + Sync),
) -> Vec<Stroke> {
    let mut strokes: Vec<Stroke> = runs
        .into_par_iter()
        .with_min_len(16)
        .map(|run| into_stroke(shape, run, width_at))
        .collect();
    strokes.sort_by_key(|stroke| stroke.occluders > 0);
    strokes
}

fn into_stroke(shape: &Shape, run: Run, width_at: &(dyn Fn(u32) -> f32 + Sync)) -> Stroke {
    let mut u = 0.0;
    let mut last: Option<[f64; 2]> = None;
    let points = run.points.iter().map(|point| {
        if let Some([x, y]) = last {
            u += ((point.place[0] - x).powi(2) + (point.place[1] - y).powi(2)).sqrt();
        }
        last = Some(point.place);
        let [a, b] = shape.ends(point.edge).map(|v| f64::from(width_at(v)));
        StrokePoint {
            position: point.place,
            depth: point.depth,
            width: (a + (b - a) * f64::from(point.t)) * run.weight,
            u,
            world: point.world.as_vec3().to_array(),
        }
    });
    Stroke {
        id: run.id,
        kind: run.kind,
        occluders: run.occluders,
        surface: run.surface,
        closed: run.closed,
        points: points.collect(),
    }
}
