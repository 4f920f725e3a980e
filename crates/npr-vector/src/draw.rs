//! From a shape and a camera to strokes.
//!
//! [`Prepared`] holds what does not depend on the camera; [`strokes`] does the rest for one view: it gathers the
//! pieces of all lines, finds what is seen of them, joins what goes on, and smooths.

use crate::adopt::adopt_intersections;
use crate::bvh::FaceTree;
use crate::contour::{EdgeContours, Eye};
use crate::corner::split;
use crate::covered::{covered_edges, edges_beside};
use crate::doubles::{leave_out_crumbs, suppress};
use crate::feature::{features, kind_in_view};
use crate::graph::{CurveGraph, CurveNode};
use crate::intersect::Crossings;
use crate::merge::{FACING_PX, TOUCHING_PX, merge_ends};
use crate::project::Projector;
use crate::puff::SmokeLines;
use crate::rank::hash_key;
use crate::run::{Line, Run, RunPoint, distance, runs};
use crate::smooth::{between, smooth};
use crate::spurs::cut_spurs;
use crate::stroke::{Kind, Stroke, StrokePoint};
use crate::visibility::{Circumstances, FaceImages, Ink, Memory, OutlineGrid, Piece, Seen, Span};
use crate::wire::{touch, wires};
use crate::zero_set::{CornerNormals, PolygonOutline, SeenContour, zero_set};
use npr_core::budget::{Budget, OverBudget};
use npr_core::crease::Creases;
use npr_core::geometry::NONE;
use npr_core::shape::Shape;
use rayon::prelude::*;
use std::sync::OnceLock;

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
    /// Turn, in radians, from which strokes are cut at a corner; none never.
    pub split: Option<f32>,
    /// Most bytes that what is found of a view may take.
    pub memory_limit: u64,
}

/// The lines of a view.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ViewStrokes {
    /// The strokes; visible ones first where hidden ones are asked for, then by chain.
    pub strokes: Vec<Stroke>,
    /// Pieces of line that were left out because the paper under them was black already.
    pub left_out: usize,
}

/// What a point of a stroke is drawn with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointPaint {
    /// Colour, sRGB bytes and alpha; none for that of its surface.
    pub color: Option<[u8; 4]>,
    /// Factor on its width.
    pub width: f64,
}

/// What is drawn at a point of a stroke of a kind on a surface.
pub type PaintAt<'a> = &'a (dyn Fn(Kind, u32, &RunPoint) -> PointPaint + Sync);

/// How strokes look along themselves.
#[derive(Clone, Copy)]
pub struct StrokeLook<'a> {
    /// Whole line width in pixels at a vertex of the shape.
    pub width_at: &'a (dyn Fn(u32) -> f32 + Sync),
    /// Colours and factors on widths, where they change from place to place. Long pieces get more points then.
    pub paint_at: Option<PaintAt<'a>>,
}

impl StrokeLook<'_> {
    /// Colour and whole width in pixels at a point of a run.
    pub(crate) fn paint(&self, shape: &Shape, run: &Run, point: &RunPoint) -> PointPaint {
        let (vertices, shares) = point.seat.place(shape, point.world);
        let width: f64 = (0..3)
            .filter(|i| shares[*i] > 0.0)
            .map(|i| f64::from((self.width_at)(vertices[i])) * shares[i])
            .sum();
        let width = width * run.weight;
        let paint = self
            .paint_at
            .map_or(PLAIN, |paint_at| paint_at(run.kind, run.surface, point));
        PointPaint {
            width: width * paint.width,
            ..paint
        }
    }
}

/// Pieces longer than this, in pixels, are broken up where colours change from place to place.
const PAINT_STEP_PX: f64 = 6.0;

/// How far smooth contours may leave the polygons' outline, in pixels.
pub(crate) const OUTLINE_TOLERANCE_PX: f64 = 2.0;

/// Up to how many surfaces in front of a hidden line are counted.
const HIDDEN_COUNT_LIMIT: u32 = 255;

/// Crowded pieces looked at between two looks at the ink on the paper.
const ROUND: usize = 256;

/// What can be known of a shape's lines before there is a camera.
#[derive(Debug)]
pub struct Prepared {
    /// The faces, for sights.
    pub tree: FaceTree,
    /// Boundaries, creases, material borders and marked edges, linked.
    pub features: CurveGraph,
    /// Where surfaces cut through each other.
    pub crossings: Crossings,
    /// Lines that are geometry themselves, linked.
    pub wires: CurveGraph,
    /// How near to a face they may lie without being hidden by it.
    touch: f64,
    /// Edges that can hide something in every view: borders, and edges of more than two faces.
    rims: Vec<u32>,
    /// For every object, whether it has a border, so that backs of faces may be seen.
    is_open: Vec<bool>,
    /// Which edges are creases.
    creases: Creases,
    /// Whether `crossings` are known; else every view looks for those of its own lines.
    has_crossings: bool,
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
    pub fn new(shape: &Shape, creases: impl Into<Creases>, with_crossings: bool) -> Self {
        let find: &FindCrossings<'_> = &|tree| {
            let mut budget = Budget::new(u64::MAX);
            crate::intersect::crossings(shape, tree, &mut budget)
        };
        let find = with_crossings.then_some(find);
        Self::with_crossings(shape, creases.into(), find).expect("no limit is set")
    }

    /// The same with intersections from elsewhere: within a limit of memory, or from a file that kept those of this
    /// shape.
    ///
    /// # Errors
    ///
    /// Those of `find`.
    pub fn with_crossings(
        shape: &Shape,
        creases: Creases,
        find: Option<&FindCrossings<'_>>,
    ) -> Result<Self, OverBudget> {
        let (tree, features) = rayon::join(|| FaceTree::new(shape), || features(shape, creases));
        let crossings = match find {
            Some(find) => find(&tree)?,
            None => Crossings::default(),
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
        Ok(Self {
            tree,
            features,
            crossings,
            wires: wires(shape),
            touch: touch(shape),
            rims,
            is_open,
            creases,
            has_crossings: find.is_some(),
            normals: OnceLock::new(),
        })
    }

    /// Smooth normals at the corners of the shape's faces, made when first asked for.
    pub fn corner_normals(&self, shape: &Shape) -> &CornerNormals {
        self.normals
            .get_or_init(|| CornerNormals::new(shape, self.creases))
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
/// the time goes into one sight for every span of every line. The memory limit of the settings does not count.
///
/// # Panics
///
/// Never: memory is not limited.
pub fn strokes(
    shape: &Shape,
    prepared: &Prepared,
    projector: &Projector,
    settings: &LineSettings,
    width_at: &(dyn Fn(u32) -> f32 + Sync),
) -> Vec<Stroke> {
    let contours = EdgeContours::new(shape, &eye_of(shape, projector));
    let smoke = None;
    let look = StrokeLook {
        width_at,
        paint_at: None,
    };
    let settings = LineSettings {
        memory_limit: u64::MAX,
        ..settings.clone()
    };
    let found = strokes_with(
        shape, prepared, projector, &settings, &contours, &look, smoke,
    );
    found.expect("no limit is set").strokes
}

/// The same, with the contours along edges found by the caller for [`eye_of`] the view, and among smoke.
///
/// Dense smoke hides lines of the shape and counts as one surface; its own outline comes after them. Where lines lie
/// so close that the paper is black, further ones are left out: those over it whose edges have the greater hashes
/// ([`hash_key`]), whatever the number of threads.
///
/// # Errors
///
/// [`OverBudget`] where what is found would take more than the settings' limit.
pub fn strokes_with(
    shape: &Shape,
    prepared: &Prepared,
    projector: &Projector,
    settings: &LineSettings,
    contours: &EdgeContours,
    look: &StrokeLook<'_>,
    smoke: Option<&SmokeLines<'_>>,
) -> Result<ViewStrokes, OverBudget> {
    let EdgeContours {
        front,
        graph: edge_contours,
    } = contours;
    let view = View {
        shape,
        prepared,
        projector,
        settings,
        front,
        covered: Vec::new(),
    };
    let mut toll = Toll::new(settings);
    let outlines = view.outlines(edge_contours, &mut toll.budget)?;
    let images = FaceImages::default();
    let seen = Seen {
        shape,
        tree: &prepared.tree,
        projector,
        outlines: &outlines,
        images: &images,
        size: settings.size,
        puffs: smoke
            .filter(|smoke| smoke.is_dense)
            .map(|smoke| smoke.puffs),
        count_limit: if settings.hidden {
            HIDDEN_COUNT_LIMIT
        } else {
            1
        },
    };
    let wanted = settings.kinds | CurveNode::MARKED;
    let contour_lines = view.lines(edge_contours, &seen, wanted, &mut toll)?;
    let smooth_contours = view.smooth_contours(edge_contours, &contour_lines);
    let contour_runs = match &smooth_contours {
        Some((graph, lines)) => runs(shape, projector, graph, lines),
        None => runs(shape, projector, edge_contours, &contour_lines),
    };
    let covered = smooth_contours.as_ref().map(|(graph, lines)| {
        let mut covered = covered_edges(graph, lines);
        covered.extend(edges_beside(lines, view.contour_features()));
        covered.sort_unstable();
        covered
    });
    let view = View {
        covered: covered.unwrap_or_default(),
        ..view
    };
    let others = [
        &prepared.features,
        &prepared.wires,
        &prepared.crossings.graph,
    ];
    let mut found = contour_runs;
    for graph in others {
        let lines = view.lines(graph, &seen, wanted, &mut toll)?;
        found.extend(runs(shape, projector, graph, &lines));
    }
    let mut strokes = strokes_of_runs(found, shape, settings, look);
    if let Some(smoke) = smoke {
        let seen = Seen {
            puffs: None,
            ..seen
        };
        strokes.extend(smoke.strokes(&seen, settings));
    }
    strokes.sort_by_key(|stroke| stroke.occluders > 0);
    Ok(ViewStrokes {
        strokes,
        left_out: toll.left_out,
    })
}

/// The runs of a view as strokes, calmed and painted.
fn strokes_of_runs(
    mut found: Vec<Run>,
    shape: &Shape,
    settings: &LineSettings,
    look: &StrokeLook<'_>,
) -> Vec<Stroke> {
    found.retain(|run| settings.hidden || run.occluders == 0);
    let mut found = calmed(found, settings);
    if look.paint_at.is_some() {
        found = broken_up(found);
    }
    strokes_of(found, &|run: &Run, point: &RunPoint| {
        look.paint(shape, run, point)
    })
}

/// What a view has used up.
struct Toll {
    budget: Budget,
    ink: Ink,
    left_out: usize,
    /// Whether boxes of faces have been paid for.
    has_images: bool,
}

impl Toll {
    fn new(settings: &LineSettings) -> Self {
        Self {
            budget: Budget::new(settings.memory_limit),
            ink: Ink::new(settings.size),
            left_out: 0,
            has_images: false,
        }
    }
}

/// Nothing changes.
const PLAIN: PointPaint = PointPaint {
    color: None,
    width: 1.0,
};

/// Runs with no piece longer than [`PAINT_STEP_PX`].
fn broken_up(runs: Vec<Run>) -> Vec<Run> {
    let broken = |run: Run| {
        let back = run.points.first().copied().filter(|_| run.closed);
        let next = run.points.iter().skip(1).copied().chain(back);
        let mut points = Vec::with_capacity(run.points.len());
        for (from, to) in run.points.iter().zip(next) {
            points.push(*from);
            let count = (distance(from.place, to.place) / PAINT_STEP_PX).ceil();
            let steps = 1..count.clamp(1.0, 1e4) as u32;
            points.extend(steps.map(|i| between(from, &to, f64::from(i) / count)));
        }
        if !run.closed {
            points.extend(run.points.last());
        }
        Run { points, ..run }
    };
    runs.into_par_iter().with_min_len(16).map(broken).collect()
}

/// Runs joined, cut at corners and smoothed, as far as the settings ask for it.
pub(crate) fn calmed(mut found: Vec<Run>, settings: &LineSettings) -> Vec<Run> {
    if settings.smooth {
        found = merge_ends(adopt_intersections(found), TOUCHING_PX);
    }
    if let Some(least_turn) = settings.split {
        found = split(found, least_turn);
    }
    if settings.smooth {
        smooth(&mut found);
        found = merge_ends(cut_spurs(suppress(found)), FACING_PX);
        smooth(&mut found);
        found = leave_out_crumbs(found);
    }
    found
}

/// The eye of a view, as decisions about facing read it. O(vertices), in parallel.
pub fn eye_of(shape: &Shape, projector: &Projector) -> Eye {
    Eye::new(projector.eye(), extent_of(shape, projector))
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
    /// Edges that smooth contours run along or beside, ascending; they need no other line.
    covered: Vec<u32>,
}

impl View<'_> {
    /// Everything that can begin or end hiding something: contours, borders, and edges of more than two faces.
    fn outlines(
        &self,
        contours: &CurveGraph,
        budget: &mut Budget,
    ) -> Result<OutlineGrid, OverBudget> {
        let lists = [&contours.nodes, &self.prepared.features.nodes].map(Vec::len);
        let most = lists[0] + lists[1] + self.prepared.rims.len();
        budget.take("outlines", most, size_of::<Piece>())?;
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
        let pieces = loops.chain(odd).chain(rims).collect();
        OutlineGrid::new(self.settings.size, pieces, budget)
    }

    /// Feature edges that are contours of the polygons in this view.
    fn contour_features(&self) -> impl Iterator<Item = (u32, Piece)> {
        let edges = self.prepared.features.nodes.iter().map(|node| node.edge);
        edges.filter_map(|edge| {
            let sides = self.shape.sides(edge);
            let fronts = sides
                .iter()
                .filter(|side| self.front[**side as usize / 3] != 0);
            let is_contour = sides.len() == 2 && fronts.count() == 1;
            Some((edge, is_contour.then(|| self.edge_piece(edge)).flatten()?))
        })
    }

    fn edge_piece(&self, edge: u32) -> Option<Piece> {
        let [a, b] = self.shape.ends(edge).map(|v| self.shape.point(v));
        Piece::new(self.projector, self.settings.size, a, b)
    }

    /// The kinds of the piece after a node in this view.
    fn kinds_of(&self, node: &CurveNode) -> u32 {
        let feature = CurveNode::KINDS & !(CurveNode::CONTOUR | CurveNode::INTERSECTION);
        let in_loop = node.flags & (CurveNode::CONTOUR | CurveNode::SEAM | CurveNode::INTERSECTION);
        if in_loop != 0 || self.shape.wire_of(node.edge).is_some() {
            return node.flags & CurveNode::KINDS;
        }
        let flags = node.flags & feature;
        // Smooth contours follow only some of the edges that turn away.
        let has_line = match self.settings.method {
            Method::Edges => self.settings.kinds & CurveNode::CONTOUR != 0,
            Method::Surface => self.covered.binary_search(&node.edge).is_ok(),
        };
        let flags = kind_in_view(self.shape, self.front, node.edge, flags, has_line);
        let sides = self.shape.sides(node.edge);
        let backs = sides.iter().all(|side| self.front[*side as usize / 3] == 0);
        let unseen = !self.settings.hidden && !self.prepared.may_show_backs(self.shape, node.face);
        if backs && sides.len() == 2 && unseen {
            return flags & CurveNode::CONTOUR;
        }
        flags
    }

    /// What is drawn of every node of a graph, and what is seen of it.
    fn lines(
        &self,
        graph: &CurveGraph,
        seen: &Seen<'_>,
        wanted: u32,
        toll: &mut Toll,
    ) -> Result<Vec<Option<Line>>, OverBudget> {
        let count = graph.nodes.len();
        toll.budget
            .take("lines of a view", count, size_of::<Option<Line>>())?;
        let mut lines: Vec<Option<Line>> = graph
            .nodes
            .par_iter()
            .with_min_len(64)
            .map_init(Memory::default, |memory, node| {
                self.line(graph, node, seen, wanted, memory)
            })
            .collect();
        let spans = lines.iter().flatten().map(|line| line.spans.len()).sum();
        toll.budget
            .take("parts of lines", spans, size_of::<Span>())?;
        self.add_crowded(graph, seen, &mut lines, toll)?;
        Ok(lines)
    }

    /// Finds what is seen of crowded lines, those with the least hashes of their edges first, until the paper under
    /// the others is black.
    fn add_crowded(
        &self,
        graph: &CurveGraph,
        seen: &Seen<'_>,
        lines: &mut [Option<Line>],
        toll: &mut Toll,
    ) -> Result<(), OverBudget> {
        let is_crowded = |line: &Option<Line>| line.as_ref().is_some_and(|l| l.spans.is_empty());
        let mut crowded: Vec<usize> = (0..lines.len())
            .filter(|index| is_crowded(&lines[*index]))
            .collect();
        if crowded.is_empty() {
            return Ok(());
        }
        if !toll.has_images {
            let (count, bytes) = (self.shape.faces.len(), FaceImages::BYTES_PER_FACE);
            toll.budget.take("boxes of faces", count, bytes)?;
            toll.has_images = true;
            seen.prepare();
        }
        crowded.sort_unstable_by_key(|index| (hash_key(graph.nodes[*index].edge), *index));
        for round in crowded.chunks(ROUND) {
            // What is left out hangs on the rounds before alone, so on no thread.
            let found: Vec<Option<Vec<Span>>> = round
                .par_iter()
                .map_init(Memory::default, |memory, index| {
                    let piece = lines[*index].as_ref().map(|line| &line.piece)?;
                    let node = &graph.nodes[*index];
                    let other = graph.nodes.get(node.next as usize)?;
                    let black = toll.ink.black_parts(piece);
                    let is_free = black != [[0.0, 1.0]];
                    let of_piece = || self.circumstances(node, other, true);
                    is_free.then(|| seen.crowded_spans(piece, &of_piece(), &black, memory))
                })
                .collect();
            for (index, spans) in round.iter().zip(found) {
                let (Some(line), Some(spans)) = (&mut lines[*index], spans) else {
                    lines[*index] = None;
                    toll.left_out += 1;
                    continue;
                };
                toll.budget
                    .take("parts of lines", spans.len(), size_of::<Span>())?;
                toll.ink.draw(&line.piece, &spans, self.settings.hidden);
                line.spans = spans;
            }
        }
        Ok(())
    }

    /// What is drawn of a node; of a crowded one without what is seen of it.
    fn line(
        &self,
        graph: &CurveGraph,
        node: &CurveNode,
        seen: &Seen<'_>,
        wanted: u32,
        memory: &mut Memory,
    ) -> Option<Line> {
        let kinds = self.kinds_of(node) & wanted;
        let kind = first_kind(kinds)?;
        let concave = node.flags & CurveNode::CONCAVE != 0;
        if concave && !self.prepared.may_show_backs(self.shape, node.face) {
            return None;
        }
        let (piece, other) = self.piece_after(graph, node)?;
        let spans: Vec<Span> = match seen.outlines.is_crowded(&piece) {
            true => Vec::new(),
            false => seen.spans(&piece, &self.circumstances(node, other, false), memory),
        };
        let surface = match self.shape.wire_of(node.edge) {
            Some(wire) => self.shape.wire_surfaces[wire],
            None => self.shape.face_surfaces[node.face as usize],
        };
        Some(Line {
            kind,
            surface,
            piece,
            spans,
        })
    }

    /// The piece after a node, with the node it runs to; none where the line ends or nothing is in the frame.
    fn piece_after<'g>(
        &self,
        graph: &'g CurveGraph,
        node: &CurveNode,
    ) -> Option<(Piece, &'g CurveNode)> {
        // The end of an open line names no node.
        let other = graph.nodes.get(node.next as usize)?;
        let [a, b] = [node, other].map(|node| self.shape.point_on(node.edge, node.t));
        let piece = Piece::new(self.projector, self.settings.size, a, b)?;
        Some((piece, other))
    }

    /// Where the piece along the edge of a node goes through faces, from its start.
    fn piercings(&self, node: &CurveNode) -> Vec<f64> {
        let up = node.t < 0.5;
        if self.prepared.has_crossings && self.shape.wire_of(node.edge).is_none() {
            let known = self.prepared.crossings.of_edge(node.edge).iter();
            return known
                .map(|p| f64::from(if up { p.t } else { 1.0 - p.t }))
                .collect();
        }
        let [low, high] = self.shape.ends(node.edge);
        let ends = if up { [low, high] } else { [high, low] };
        self.prepared.tree.piercings(self.shape, ends)
    }

    /// The smooth contours of the view with what is seen of them, where they are asked for.
    fn smooth_contours(
        &self,
        contours: &CurveGraph,
        lines: &[Option<Line>],
    ) -> Option<(CurveGraph, Vec<Option<Line>>)> {
        if self.settings.method == Method::Edges {
            return None;
        }
        let prepared = self.prepared;
        let normals = prepared.corner_normals(self.shape);
        let convex = contours.nodes.iter().zip(lines).filter_map(|(node, line)| {
            let line = line.as_ref()?;
            (node.flags & CurveNode::CONCAVE == 0).then_some((node, line))
        });
        let seen: Vec<SeenContour> = convex
            .flat_map(|(node, line)| {
                SeenContour::of_piece(self.projector, node, &line.piece, &line.spans)
            })
            .collect();
        let outline = PolygonOutline::new(
            (self.shape, normals),
            (self.projector, self.settings.size),
            self.front,
            &seen,
            OUTLINE_TOLERANCE_PX,
        );
        let graph = zero_set(
            self.shape,
            normals,
            self.projector.eye(),
            &outline.flat_faces(),
        );
        let pieces: Vec<Option<Piece>> = graph
            .nodes
            .iter()
            .map(|node| {
                // Its own surface hides a concave piece.
                let shows = node.flags & CurveNode::CONCAVE == 0;
                let piece = shows.then(|| self.piece_after(&graph, node)).flatten()?;
                Some(piece.0)
            })
            .collect();
        let spans = outline.spans(&graph, &pieces);
        let line = |(node, (piece, spans)): (&CurveNode, (&Option<Piece>, Vec<Span>))| {
            let piece = (*piece)?;
            let surface = self.shape.face_surfaces[node.face as usize];
            (!spans.is_empty()).then_some(Line {
                kind: Kind::Contour,
                surface,
                piece,
                spans,
            })
        };
        let lines = graph
            .nodes
            .iter()
            .zip(pieces.iter().zip(spans))
            .map(line)
            .collect();
        Some((graph, lines))
    }

    /// Faces that a piece lies in, and where it goes through others, which a crowded piece need not know.
    fn circumstances(
        &self,
        node: &CurveNode,
        other: &CurveNode,
        is_crowded: bool,
    ) -> Circumstances {
        let mut own_faces: Vec<u32> = self
            .shape
            .sides(node.edge)
            .iter()
            .map(|side| side / 3)
            .collect();
        if node.is_along_edge() {
            let is_wire = self.shape.wire_of(node.edge).is_some();
            return Circumstances {
                piercings: if is_crowded {
                    Vec::new()
                } else {
                    self.piercings(node)
                },
                own_faces,
                touch: if is_wire { self.prepared.touch } else { 0.0 },
            };
        }
        own_faces.extend(self.shape.sides(other.edge).iter().map(|side| side / 3));
        own_faces.push(node.face);
        for end in [node, other] {
            let pierced = self.prepared.crossings.at(end.edge, end.t).iter();
            own_faces.extend(pierced.map(|p| p.face));
        }
        Circumstances {
            own_faces,
            ..Circumstances::default()
        }
    }
}

/// The kind that a piece of several kinds is drawn as.
fn first_kind(kinds: u32) -> Option<Kind> {
    Kind::ALL.into_iter().find(|kind| kinds & kind.bit() != 0)
}

/// Runs as strokes, in their order; `paint_at` gives colour and whole width in pixels at a point of a run.
pub(crate) fn strokes_of(
    runs: Vec<Run>,
    paint_at: &(dyn Fn(&Run, &RunPoint) -> PointPaint + Sync),
) -> Vec<Stroke> {
    let runs = runs.into_par_iter().with_min_len(16);
    runs.map(|run| stroke_of(&run, paint_at)).collect()
}

fn stroke_of(run: &Run, paint_at: &(dyn Fn(&Run, &RunPoint) -> PointPaint + Sync)) -> Stroke {
    let mut u = 0.0;
    let mut last = run.points.first().map(|point| point.place);
    let points = run.points.iter().enumerate().map(|(index, point)| {
        u += last.map_or(0.0, |last| distance(last, point.place));
        last = Some(point.place);
        let seat = run.seat_at(index);
        let paint = paint_at(run, &RunPoint { seat, ..*point });
        StrokePoint {
            position: point.place,
            depth: point.depth,
            width: paint.width,
            u,
            world: point.world.as_vec3().to_array(),
            color: paint.color,
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
