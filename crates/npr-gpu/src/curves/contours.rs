//! Passes that find the contours of a shape.

use super::CurvesError;
use super::ranking::{RankedLists, Scheme, add_ranking, read_rows};
use super::sums::{Compacted, add_compact};
use crate::engine::{Engine, EngineError, Session};
use crate::graph::{Graph, ResourceId};
use crate::passes::vector;
use npr_core::shape::Shape;
use npr_vector::contour::Eye;
use npr_vector::contour::steps::{HalfEdge, Viewer, half_edges, judges};
use npr_vector::graph::{CurveGraph, CurveNode};
use npr_vector::rank::{Link, Ranked};

/// Half-edges for which [`contours_on`] makes room at first; few shapes have longer contours.
const FIRST_CAPACITY: usize = 4096;

/// What [`add_contours`] puts into a graph.
#[derive(Debug, Clone, Copy)]
pub struct Contours {
    /// [`Viewer`]; written for every view.
    pub viewer: ResourceId,
    /// Coordinates of the vertices; written whenever they move.
    pub positions: ResourceId,
    /// [`HalfEdge`]s; written once.
    pub half_edges: ResourceId,
    /// The face that decides about each face; written once.
    pub judges: ResourceId,
    /// Whether each face is turned to the eye.
    pub front: ResourceId,
    /// [`CurveNode`]s.
    pub nodes: ResourceId,
    /// Number of nodes that there are, also where they have no room: one element.
    pub node_count: ResourceId,
}

/// Appends passes that find the contours of a shape and link them, with room for `capacity` nodes.
///
/// Where there are more the nodes are of no use; the host runs a graph with more room. Takes 12 bytes for each half-edge besides
/// the shape itself, and 28 for each node.
pub fn add_contours(
    graph: &mut Graph,
    vertex_count: usize,
    face_count: usize,
    capacity: usize,
) -> Contours {
    let viewer = graph.uniform::<Viewer>("viewer");
    let positions = graph.buffer::<f32>("positions", 3 * vertex_count);
    let half_edges = graph.buffer::<HalfEdge>("half-edges", 3 * face_count);
    let judges = graph.buffer::<u32>("judges", face_count);
    let front = graph.buffer::<u32>("front faces", face_count);
    graph.compute(
        &vector::FACE_EYE,
        &[viewer, positions, half_edges, judges, front],
    );
    let flags = graph.buffer::<u32>("contour flags", 3 * face_count);
    graph.compute(&vector::MARK_CONTOURS, &[front, half_edges, flags]);
    let Compacted { list, count, slots } = add_compact(graph, flags, capacity);
    let nodes = graph.buffer::<CurveNode>("contour nodes", capacity);
    graph.compute(
        &vector::LINK_CONTOURS,
        &[
            viewer, count, list, slots, flags, half_edges, positions, nodes,
        ],
    );
    Contours {
        viewer,
        positions,
        half_edges,
        judges,
        front,
        nodes,
        node_count: count,
    }
}

/// The contour loops of a view, found on an engine; the same as [`npr_vector::contour::contours`], bit for bit.
///
/// # Errors
///
/// [`CurvesError::Engine`] where the engine fails.
pub fn contours_on(
    engine: &dyn Engine,
    shape: &Shape,
    eye: &Eye,
) -> Result<CurveGraph, CurvesError> {
    let (mut session, found, _) = run_contours(engine, shape, eye, None)?;
    read_nodes(session.as_mut(), &found)
}

/// The contour loops of a view and their nodes in rows, without a stop between the two; the same as
/// [`npr_vector::rank::rank_curves`] of [`npr_vector::contour::contours`].
///
/// # Errors
///
/// [`CurvesError::Engine`] where the engine fails, [`CurvesError::Rank`] where the rounds of the scheme are too few.
pub fn ranked_contours_on(
    engine: &dyn Engine,
    shape: &Shape,
    eye: &Eye,
    scheme: Scheme,
) -> Result<(CurveGraph, Ranked), CurvesError> {
    let (mut session, found, lists) = run_contours(engine, shape, eye, Some(scheme))?;
    let graph = read_nodes(session.as_mut(), &found)?;
    let ranked = match lists {
        Some(lists) => read_rows(session.as_mut(), &lists, graph.nodes.len())?,
        None => Ranked::default(),
    };
    Ok((graph, ranked))
}

/// A session whose contours all have room, run once.
type ContourRun = (Box<dyn Session>, Contours, Option<RankedLists>);

fn run_contours(
    engine: &dyn Engine,
    shape: &Shape,
    eye: &Eye,
    scheme: Option<Scheme>,
) -> Result<ContourRun, CurvesError> {
    let mut capacity = FIRST_CAPACITY.min(3 * shape.faces.len());
    loop {
        let mut graph = Graph::new();
        let sizes = [shape.positions.len(), shape.faces.len()];
        let found = add_contours(&mut graph, sizes[0], sizes[1], capacity);
        let lists = scheme.map(|scheme| {
            let links = graph.buffer::<Link>("links", capacity);
            graph.compute(&vector::LIST_NODES, &[found.node_count, found.nodes, links]);
            add_ranking(&mut graph, links, scheme)
        });
        let mut session = engine.prepare(graph)?;
        write_shape(session.as_mut(), &found, shape, eye)?;
        if let Some(lists) = &lists {
            session.write(lists.node_count, &[capacity as u32])?;
            session.write(lists.rounds, &[lists.round_count])?;
        }
        session.run()?;
        let count = session.read(found.node_count)?[0] as usize;
        if count <= capacity {
            return Ok((session, found, lists));
        }
        // Counting went on past the room, so this happens once.
        capacity = count;
    }
}

fn write_shape(
    session: &mut dyn Session,
    into: &Contours,
    shape: &Shape,
    eye: &Eye,
) -> Result<(), EngineError> {
    let viewer = [Viewer::from(eye)];
    session.write(into.viewer, bytemuck::cast_slice(&viewer))?;
    session.write(into.positions, bytemuck::cast_slice(&shape.positions))?;
    session.write(into.half_edges, bytemuck::cast_slice(&half_edges(shape)))?;
    session.write(into.judges, &judges(shape))
}

fn read_nodes(session: &mut dyn Session, found: &Contours) -> Result<CurveGraph, CurvesError> {
    let count = session.read(found.node_count)?[0] as usize;
    let mut words = session.read(found.nodes)?;
    words.truncate(count * size_of::<CurveNode>() / 4);
    let nodes = bytemuck::cast_slice(&words).to_vec();
    Ok(CurveGraph { nodes })
}
