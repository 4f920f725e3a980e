//! A shape whose lines are drawn into pictures by an engine, from view to view.

use super::CurvesError;
use super::pixels::{
    Hiding, PixelContours, PixelRoom, PixelStrips, add_pixel_contours, add_strips,
};
use super::ranking::{Scheme, ranked};
use crate::engine::{Engine, PassTime, Readings, Session};
use crate::graph::Graph;
use npr_core::crease::Creases;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_vector::pixel_strokes::edge::{DrawnEdge, drawn_edges};
use npr_vector::pixel_strokes::segment::PixelView;
use npr_vector::pixel_strokes::strip::Strips;
use npr_vector::pixel_strokes::stroke::Loops;
use npr_vector::pixel_strokes::{
    PixelScene, PublishedPath, Traced, scene_depths, standings_of, trace,
};
use std::borrow::Cow;

/// What hides the lines of a view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hiders<'a> {
    /// The shape's surfaces, whose depths the engine draws.
    Surfaces,
    /// The shape's surfaces, and occluders before them: reversed depths of all pixels, 0 where there are none.
    Veiled(&'a [f32]),
    /// Only the surfaces at these reversed depths.
    Given(&'a [f32]),
}

impl<'a> Hiders<'a> {
    fn kind(self) -> Hiding {
        match self {
            Self::Surfaces => Hiding::Surfaces,
            Self::Veiled(_) => Hiding::Veiled,
            Self::Given(_) => Hiding::Given,
        }
    }

    /// The depths that the host hands to the engine.
    fn given(self) -> &'a [f32] {
        match self {
            Self::Surfaces => &[],
            Self::Veiled(depths) | Self::Given(depths) => depths,
        }
    }

    /// All depths, found on the processor.
    fn depths(self, on: &PixelScene<'_>) -> Vec<f32> {
        match self {
            Self::Given(depths) => depths.to_vec(),
            Self::Surfaces => scene_depths(on.shape, on.view),
            Self::Veiled(occluder_depths) => {
                let mut depths = scene_depths(on.shape, on.view);
                for (depth, occluder_depths) in depths.iter_mut().zip(occluder_depths) {
                    *depth = depth.max(*occluder_depths);
                }
                depths
            }
        }
    }
}

/// A shape in an engine's memory, for drawing any number of views by the published path, from surfaces to strips,
/// without a stop.
///
/// What does not change is handed over once, a view with every drawing. The shape is handed over again for more room,
/// the next power of two, where a view has more edges, fragments or sides than any before, and for another size of the
/// picture or other filters.
pub struct ResidentPixels<'a> {
    engine: &'a dyn Engine,
    shape: Cow<'a, HalfEdgeMesh>,
    room: PixelRoom,
    made: Option<Made>,
    times: Vec<PassTime>,
}

/// The settings that a graph is made for.
#[derive(Debug, Clone, PartialEq)]
struct Plan {
    size: [u32; 2],
    hiding: Hiding,
    path: PublishedPath,
    room: PixelRoom,
    creases: Creases,
    is_drawn: Vec<bool>,
}

/// A graph in an engine's memory.
struct Made {
    plan: Plan,
    session: Box<dyn Session>,
    contours: PixelContours,
    strips: PixelStrips,
    /// The edges that the plan draws, as they were handed over.
    edges: Vec<DrawnEdge>,
}

impl<'a> ResidentPixels<'a> {
    /// Takes a shape; nothing is handed over before the first view.
    pub fn new(engine: &'a dyn Engine, shape: &'a HalfEdgeMesh) -> Self {
        Self {
            engine,
            shape: Cow::Borrowed(shape),
            room: PixelRoom::FIRST,
            made: None,
            times: Vec::new(),
        }
    }

    /// Takes over a pose of the shape: the same one, with its vertices elsewhere. Positions, judges and edges are
    /// handed over where they differ.
    ///
    /// # Errors
    ///
    /// [`CurvesError::Engine`] where the engine fails.
    pub fn set_pose(&mut self, shape: &HalfEdgeMesh) -> Result<(), CurvesError> {
        match &mut self.made {
            Some(made) if shape.edge_count() == self.shape.edge_count() => {
                made.write_pose(&self.shape, shape)?;
            }
            // Wedges that pair anew have other edges: all is made again.
            _ => self.made = None,
        }
        self.shape.to_mut().clone_from(shape);
        Ok(())
    }

    /// The picture of a view's lines with its ranked sides, and their loops cut into strips.
    ///
    /// The shape is the resident one, whatever the scene holds. Given the same depths, [`Traced`] is that of [`trace`],
    /// bit for bit; [`Loops`] are those of [`Loops::new`] within rounding.
    ///
    /// # Errors
    ///
    /// [`CurvesError::Rank`] where the rounds of the path are too few, [`CurvesError::Engine`] where the engine fails
    /// or has no room.
    pub fn draw(
        &mut self,
        on: &PixelScene<'_>,
        path: &PublishedPath,
        hiders: Hiders<'_>,
    ) -> Result<(Traced, Loops), CurvesError> {
        self.draw_while(on, path, hiders, &|| ())
    }

    /// As [`ResidentPixels::draw`]; the processor does something else, once, while a device draws.
    ///
    /// # Errors
    ///
    /// As [`ResidentPixels::draw`].
    pub fn draw_while(
        &mut self,
        on: &PixelScene<'_>,
        path: &PublishedPath,
        hiders: Hiders<'_>,
        meanwhile: &dyn Fn(),
    ) -> Result<(Traced, Loops), CurvesError> {
        // Trace an empty picture without the engine.
        let Self {
            engine,
            shape,
            room,
            made: last,
            times: told,
        } = self;
        told.clear();
        let on = &PixelScene { shape, ..*on };
        let view = on.pixel_view(path);
        let pixel_count = view.size[0] as usize * view.size[1] as usize;
        if pixel_count == 0 || shape.faces.is_empty() {
            let traced = trace(on, path, &hiders.depths(on))?;
            let loops = Loops::new(&traced, path);
            return Ok((traced, loops));
        }

        // Run the graph, with more room each time that it did not suffice.
        let mut meanwhile = Some(meanwhile);
        loop {
            let plan = Plan::new(on, path, hiders.kind(), *room);
            let made = Made::for_plan(last, *engine, shape, plan)?;
            let (session, contours) = (made.session.as_mut(), &made.contours);
            contours.write_view(session, on, path, hiders.given())?;
            made.strips.write(session, path)?;
            let results = [&contours.results()[..], &made.strips.results()].concat();
            session.submit(&results)?;
            if let Some(work) = meanwhile.take() {
                work();
            }
            let (times, mut read) = session.collect()?;
            let needed = contours.needed(&mut read);
            if made.plan.room.holds(needed) {
                let found = made.found(view, needed, &mut read);
                *told = times;
                return found;
            }
            *room = room.grown(needed);
        }
    }

    /// How long each pass of the last view took.
    pub fn times(&self) -> &[PassTime] {
        &self.times
    }
}

impl Plan {
    /// What a view needs.
    fn new(on: &PixelScene<'_>, path: &PublishedPath, hiding: Hiding, room: PixelRoom) -> Self {
        Self {
            size: on.pixel_view(path).size,
            hiding,
            path: *path,
            room,
            creases: on.creases,
            is_drawn: on.is_drawn.to_vec(),
        }
    }
}

impl Made {
    /// The graph for a view; the last one where that needs the same.
    fn for_plan<'m>(
        last: &'m mut Option<Self>,
        engine: &dyn Engine,
        shape: &HalfEdgeMesh,
        plan: Plan,
    ) -> Result<&'m mut Self, CurvesError> {
        let made = match last.take().filter(|made| made.plan == plan) {
            Some(made) => made,
            None => Self::new(engine, shape, plan)?,
        };
        Ok(last.insert(made))
    }

    fn new(engine: &dyn Engine, shape: &HalfEdgeMesh, plan: Plan) -> Result<Self, CurvesError> {
        let mut graph = Graph::new();
        let scheme = Scheme::Wyllie {
            rounds: plan.path.round_limit(),
        };
        let picture = (plan.size, plan.hiding);
        let contours = add_pixel_contours(&mut graph, shape, picture, plan.room, scheme);
        let strips = add_strips(&mut graph, &contours, &plan.path);

        // Hand the shape over.
        let edges = drawn_edges(shape, plan.creases, &plan.is_drawn);
        let mut session = engine.prepare(graph)?;
        contours.write_shape(session.as_mut(), shape, &edges)?;
        Ok(Self {
            session,
            plan,
            contours,
            strips,
            edges,
        })
    }

    /// Hands over what a pose changes of the shape.
    fn write_pose(
        &mut self,
        before: &HalfEdgeMesh,
        shape: &HalfEdgeMesh,
    ) -> Result<(), CurvesError> {
        let edges = drawn_edges(shape, self.plan.creases, &self.plan.is_drawn);
        let session = self.session.as_mut();
        self.contours
            .write_pose(session, (before, &self.edges), (shape, &edges))?;
        self.edges = edges;
        Ok(())
    }

    /// What a run found, as it was read.
    fn found(
        &self,
        view: PixelView,
        count: PixelRoom,
        read: &mut Readings,
    ) -> Result<(Traced, Loops), CurvesError> {
        // Take the segments and the sides of their pixels in rows.
        let (from, strips) = (&self.contours, &self.strips);
        let ranked = ranked(read, &from.lists, count.sides)?;
        let traced = Traced {
            size: view.size,
            view,
            segments: read.take_first(from.segments, count.segments),
            sides: read.take_first(from.sides, count.sides),
            standings: standings_of(&ranked),
            order: ranked.order,
        };

        // Take the loops and their strips.
        let loops = Loops {
            spots: read.take_first(strips.spots, count.sides),
            places: read.take_first(strips.places, count.sides),
            tangents: read.take_first(strips.tangents, count.sides),
            directions: read.take_first(strips.directions, count.sides),
            kept: read.take_first(strips.kept, count.sides),
            strips: Strips {
                spots: read.take_first(strips.strips, count.sides),
                lengths: read.take_first(strips.lengths, count.sides),
            },
        };
        Ok((traced, loops))
    }
}

/// Draws the lines of a view into a picture on an engine, bit for bit as [`trace`] does.
///
/// Every call hands the shape over, and again with more room where counts exceed it; [`ResidentPixels`] keeps it.
///
/// # Errors
///
/// [`CurvesError::Rank`] where the rounds of the path are too few, [`CurvesError::Engine`] where the engine fails.
pub fn trace_on(
    engine: &dyn Engine,
    on: &PixelScene<'_>,
    path: &PublishedPath,
    depths: &[f32],
) -> Result<Traced, CurvesError> {
    let pixel_count: usize = on
        .pixel_view(path)
        .size
        .iter()
        .map(|side| *side as usize)
        .product();
    if depths.len() != pixel_count {
        return Ok(trace(on, path, depths)?);
    }
    let (traced, _) =
        ResidentPixels::new(engine, on.shape).draw(on, path, Hiders::Given(depths))?;
    Ok(traced)
}
