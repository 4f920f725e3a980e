//! A shape that stays in an engine's memory from view to view.

use super::CurvesError;
use super::contours::{Contours, add_contours};
use super::ranking::{Scheme, ranked};
use crate::engine::{Engine, EngineError, PassTime, Readings, Session};
use crate::graph::Graph;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_vector::mesh_lines::contour::steps::Viewer;
use npr_vector::mesh_lines::contour::{EdgeContours, Eye, usual_room};
use npr_vector::mesh_lines::graph::{CurveGraph, CurveNode};
use npr_vector::rank::Ranked;
use std::borrow::Cow;

/// A shape in an engine's memory, for contours of any number of views.
///
/// Positions, half-edges and judges are handed over once; a view hands over its eye and takes the contours back.
/// There is [usual room](usual_room) for contours at first; a view with more makes room for the next power of two,
/// and only then is the shape handed over again. Takes 12 bytes for each vertex and about 95 for each face on the
/// engine, and 32 for each node that there is room for.
pub struct ResidentShape<'a> {
    engine: &'a dyn Engine,
    shape: Cow<'a, HalfEdgeMesh>,
    scheme: Option<Scheme>,
    room: Room,
    node_count: usize,
    times: Vec<PassTime>,
}

/// The memory for a number of nodes, with the shape in it.
struct Room {
    session: Box<dyn Session>,
    contours: Contours,
    capacity: usize,
}

impl<'a> ResidentShape<'a> {
    /// Hands a shape over, for its contours.
    ///
    /// # Errors
    ///
    /// [`EngineError::OutOfMemory`] for shapes beyond what a device can bind, 2.7 million faces; others where the
    /// engine fails.
    pub fn new(engine: &'a dyn Engine, shape: &'a HalfEdgeMesh) -> Result<Self, EngineError> {
        Self::of_scheme(engine, shape, None)
    }

    /// As [`ResidentShape::new`], for contours with ranked nodes, without a stop between the two.
    ///
    /// # Errors
    ///
    /// As [`ResidentShape::new`].
    pub fn with_ranking(
        engine: &'a dyn Engine,
        shape: &'a HalfEdgeMesh,
        scheme: Scheme,
    ) -> Result<Self, EngineError> {
        Self::of_scheme(engine, shape, Some(scheme))
    }

    fn of_scheme(
        engine: &'a dyn Engine,
        shape: &'a HalfEdgeMesh,
        scheme: Option<Scheme>,
    ) -> Result<Self, EngineError> {
        let capacity = usual_room(shape.faces.len());
        Ok(Self {
            engine,
            shape: Cow::Borrowed(shape),
            scheme,
            room: Room::new(engine, shape, scheme, capacity)?,
            node_count: 0,
            times: Vec::new(),
        })
    }

    /// Takes over a pose of the shape: the same one, with its vertices elsewhere. Positions, half-edges and judges
    /// are handed over where they differ.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the engine fails.
    pub fn set_pose(&mut self, shape: &HalfEdgeMesh) -> Result<(), EngineError> {
        let Room {
            session, contours, ..
        } = &mut self.room;
        contours.write_pose(session.as_mut(), &self.shape, shape)?;
        self.shape.to_mut().clone_from(shape);
        Ok(())
    }

    /// Which faces are turned to an eye, and the contours, bit for bit as [`EdgeContours::new`] gives them.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the engine fails.
    pub fn contours(&mut self, eye: &Eye) -> Result<EdgeContours, EngineError> {
        self.contours_while(eye, &|| ())
    }

    /// As [`ResidentShape::contours`]; the processor does something else, once, while a device finds them.
    ///
    /// # Errors
    ///
    /// As [`ResidentShape::contours`].
    pub fn contours_while(
        &mut self,
        eye: &Eye,
        meanwhile: &dyn Fn(),
    ) -> Result<EdgeContours, EngineError> {
        self.node_count = 0;
        let mut read = self.run(eye, meanwhile)?;
        let count = read.take_count(self.room.contours.node_count);
        if count > self.room.capacity {
            // Counting went on past the room, so once is enough.
            let capacity = count.next_power_of_two();
            self.room = Room::new(self.engine, &self.shape, self.scheme, capacity)?;
            read = self.run(eye, &|| ())?;
        }
        self.node_count = count;
        let front = read.take(self.room.contours.front);
        Ok(EdgeContours {
            front: front.iter().map(|front| u8::from(*front != 0)).collect(),
            graph: CurveGraph {
                nodes: read.take_first::<CurveNode>(self.room.contours.nodes, count),
            },
        })
    }

    /// The ranked nodes of the last contours, as [`npr_vector::rank::rank_curves`] gives them; nothing for a shape that
    /// was not made [with ranking](ResidentShape::with_ranking).
    ///
    /// # Errors
    ///
    /// [`CurvesError::Engine`] where the engine fails, [`CurvesError::Rank`] where the rounds of the scheme are too
    /// few.
    pub fn rows(&mut self) -> Result<Ranked, CurvesError> {
        let Some(lists) = &self.room.contours.lists else {
            return Ok(Ranked::default());
        };
        let mut read = self.room.session.read_all(&lists.results())?;
        ranked(&mut read, lists, self.node_count)
    }

    /// How long each pass of the last view took.
    pub fn times(&self) -> &[PassTime] {
        &self.times
    }

    /// Runs all passes for an eye; reads the number of nodes, which may be more than there is room for, the nodes, and
    /// which faces are turned to the eye.
    fn run(&mut self, eye: &Eye, meanwhile: &dyn Fn()) -> Result<Readings, EngineError> {
        let Room {
            session, contours, ..
        } = &mut self.room;
        session.write(contours.viewer, bytemuck::cast_slice(&[Viewer::from(eye)]))?;
        let results = [contours.node_count, contours.nodes, contours.front];
        session.submit(&results)?;
        meanwhile();
        let (times, read) = session.collect()?;
        self.times = times;
        Ok(read)
    }
}

impl Room {
    fn new(
        engine: &dyn Engine,
        shape: &HalfEdgeMesh,
        scheme: Option<Scheme>,
        capacity: usize,
    ) -> Result<Self, EngineError> {
        let mut graph = Graph::new();
        let sizes = [shape.positions.len(), shape.faces.len()];
        let contours = add_contours(&mut graph, sizes[0], sizes[1], capacity, scheme);
        let mut room = Self {
            session: engine.prepare(graph)?,
            contours,
            capacity,
        };
        room.contours.write_shape(room.session.as_mut(), shape)?;
        Ok(room)
    }
}
