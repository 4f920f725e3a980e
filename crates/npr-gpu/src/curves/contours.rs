//! Passes that find the contours of a shape.

use super::ranking::{RankedLists, Scheme, add_ranking};
use super::sums::{Compacted, add_compact};
use super::work::{IndirectArguments, ListWork, add_work};
use crate::changes::write_changes;
use crate::engine::{EngineError, Session};
use crate::graph::{Graph, ResourceId};
use crate::passes::vector;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_vector::mesh_lines::contour::steps::{HalfEdge, Viewer, half_edges, judges};
use npr_vector::mesh_lines::graph::CurveNode;
use npr_vector::rank::Link;

/// The resources that [`add_contours`] adds to a graph.
#[derive(Debug, Clone, Copy)]
pub struct Contours {
    /// [`Viewer`]; written for every view.
    pub viewer: ResourceId,
    /// Coordinates of the vertices; written whenever they move.
    pub positions: ResourceId,
    /// [`HalfEdge`]s; written once.
    pub half_edges: ResourceId,
    /// The vertices of every face, three each; written once.
    pub corners: ResourceId,
    /// The face that decides about each face; written once.
    pub judges: ResourceId,
    /// Whether each face is turned to the eye.
    pub front: ResourceId,
    /// [`CurveNode`]s.
    pub nodes: ResourceId,
    /// Number of nodes found, even if they have no room: one element.
    pub node_count: ResourceId,
    /// The sizes of passes over the nodes.
    pub work: ListWork,
    /// The ranked nodes, where that was asked for.
    pub lists: Option<RankedLists>,
}

/// Appends passes that find the contours of a shape and link them, with room for `capacity` nodes; with a scheme they
/// also rank the nodes.
///
/// Passes over faces and half-edges work on all of them, those over nodes on as many as are found.
///
/// If more are found than have room, the nodes are of no use, and the host runs a graph with more room. Takes 12 bytes
/// for each half-edge besides the shape itself, and 28 for each node.
pub fn add_contours(
    graph: &mut Graph,
    vertex_count: usize,
    face_count: usize,
    capacity: usize,
    scheme: Option<Scheme>,
) -> Contours {
    // Tell which faces look at the eye.
    let viewer = graph.uniform::<Viewer>("viewer");
    let positions = graph.buffer::<f32>("positions", 3 * vertex_count);
    let corners = graph.buffer::<u32>("corners", 3 * face_count);
    let half_edges = graph.buffer::<HalfEdge>("half-edges", 3 * face_count);
    let judges = graph.buffer::<u32>("judges", face_count);
    let front = graph.buffer::<u32>("front faces", face_count);
    graph.compute(
        &vector::FACE_EYE,
        &[viewer, positions, corners, judges, front],
    );

    // Mark half-edges between a face that does and one that does not.
    let flags = graph.buffer::<u32>("contour flags", 3 * face_count);
    graph.compute(&vector::MARK_CONTOURS, &[front, half_edges, flags]);
    let Compacted { list, count, slots } = add_compact(graph, flags, capacity, &ListWork::WHOLE);

    // Link the contour's nodes along the surface, as many as there are.
    let indirect = scheme.map_or(IndirectArguments::default(), |scheme| {
        scheme.indirect(capacity)
    });
    let work = add_work(graph, count, capacity, indirect);
    let nodes = graph.buffer::<CurveNode>("contour nodes", capacity);
    graph.compute_sized(
        &vector::LINK_CONTOURS,
        &[
            viewer, count, list, slots, flags, half_edges, positions, nodes,
        ],
        work.elements(),
    );

    // Put them in rows.
    let lists = scheme.map(|scheme| {
        let links = graph.buffer::<Link>("links", capacity);
        let bound = [count, nodes, links];
        graph.compute_sized(&vector::LIST_NODES, &bound, work.elements());
        add_ranking(graph, links, &work, scheme)
    });
    Contours {
        viewer,
        positions,
        corners,
        half_edges,
        judges,
        front,
        nodes,
        node_count: count,
        work,
        lists,
    }
}

/// Hands over which positions and judges a pose changes.
pub(super) fn write_moved(
    session: &mut dyn Session,
    [positions_id, judges_id]: [ResourceId; 2],
    before: &HalfEdgeMesh,
    shape: &HalfEdgeMesh,
) -> Result<(), EngineError> {
    write_changes(session, positions_id, &before.positions, &shape.positions)?;
    if shape.degenerate_faces != before.degenerate_faces {
        let [old, new] = [before, shape].map(judges);
        write_changes(session, judges_id, &old, &new)?;
    }
    Ok(())
}

impl Contours {
    /// Hands the shape, which stays from view to view, to the engine.
    ///
    /// # Errors
    ///
    /// Those of the engine.
    pub fn write_shape(
        &self,
        session: &mut dyn Session,
        shape: &HalfEdgeMesh,
    ) -> Result<(), EngineError> {
        session.write(self.positions, bytemuck::cast_slice(&shape.positions))?;
        session.write(self.corners, bytemuck::cast_slice(&shape.faces))?;
        session.write(self.half_edges, bytemuck::cast_slice(&half_edges(shape)))?;
        session.write(self.judges, &judges(shape))
    }

    /// Hands a shape over that differs from the one `before` by its pose alone.
    ///
    /// # Errors
    ///
    /// As [`Self::write_shape`].
    pub fn write_pose(
        &self,
        session: &mut dyn Session,
        before: &HalfEdgeMesh,
        shape: &HalfEdgeMesh,
    ) -> Result<(), EngineError> {
        write_moved(session, [self.positions, self.judges], before, shape)?;
        if shape.twins != before.twins {
            let [old, new] = [before, shape].map(half_edges);
            write_changes(session, self.half_edges, &old, &new)?;
        }
        Ok(())
    }
}
