//! Strokes as the lines of a frame: those of parts whose method is `strokes` or `potrace`, found before the frame is
//! drawn and inked by a pass of it.

use crate::brushes::Brushes;
use crate::error::RenderError;
use crate::frame::Frame;
use crate::frame_graph::{FrameGraph, write};
use crate::lines::{LineOptions, LineRenderer};
use crate::options::RendererOptions;
use npr_core::budget::Budget;
use npr_core::camera::Camera;
use npr_core::window::View;
use npr_drawing::ink::ink_points;
use npr_gpu::engine::{EngineError, PassTime, Session};
use npr_gpu::graph::{Graph, ResourceId, WorkSize};
use npr_gpu::pass::Work;
use npr_gpu::passes::stroke::DRAW_STROKES;
use npr_stylesheet::Style;
use npr_vector::brush::Brush;
use npr_vector::ink_point::InkPoint;
use npr_vector::rank::work::Arguments;
use npr_vector::stroke::{Drawing, Stroke};

/// Points that there is room for at first; frames with more of them make more room.
const FIRST_ROOM: usize = 4096;

/// How strokes were found.
#[derive(Debug, Default)]
pub(crate) struct StrokeReport {
    times: Vec<PassTime>,
    notices: Vec<String>,
}

impl StrokeReport {
    /// Tells with a frame how long it took to find them, and what the user should know of it.
    pub fn tell(&self, frame: &mut Frame) {
        frame.times.extend_from_slice(&self.times);
        frame.notices.extend_from_slice(&self.notices);
    }
}

/// Finds the strokes that a camera sees of the parts whose method asks for them, and tells how; without a line model
/// there is a notice instead.
pub(crate) fn find(
    lines: Option<&mut LineRenderer<'_>>,
    camera: &Camera,
    (style, options): (&Style, &RendererOptions),
) -> Result<(Vec<Drawing>, StrokeReport), RenderError> {
    let (mut drawings, mut report) = (Vec::new(), StrokeReport::default());
    if !style.has_curves() {
        return Ok((drawings, report));
    }
    let Some(lines) = lines else {
        let notice = "lines of method potrace are left out: no line model was given";
        report.notices.push(notice.to_owned());
        return Ok((drawings, report));
    };
    let of_style = LineOptions {
        dpi: options.dpi,
        ..LineOptions::of_style(style, options.size)
    };
    for method in style.curve_sources() {
        let of_method = LineOptions { method, ..of_style };
        let drawing = lines.draw_curves(camera, style, &of_method, &options.pictures)?;
        report.times.extend_from_slice(lines.times());
        report.notices.extend_from_slice(&drawing.notices);
        drawings.push(drawing);
    }
    Ok((drawings, report))
}

/// The points of the strokes that a camera sees, in their order, with brushes that lie on them by the base width.
pub(crate) fn points_of(
    drawings: &[Drawing],
    view: &View,
    (brushes, base_px): (&Brushes, f32),
) -> Vec<InkPoint> {
    let nearness = |depth: f64| view.nearness(depth as f32);
    let lay_of = |stroke: &Stroke| brushes.lay_of(stroke, base_px);
    let points = |drawing| ink_points(drawing, &nearness, &lay_of);
    drawings.iter().flat_map(points).collect()
}

/// The pass that inks strokes, and what the host fills for it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StrokePasses {
    points: ResourceId,
    brushes: ResourceId,
    /// How many vertices are drawn.
    size: ResourceId,
}

impl StrokePasses {
    /// Adds the pass that inks strokes with `brush_count` brushes into a picture and its keys, which are cleared before
    /// where `clears`.
    pub fn plan(
        frame: &mut FrameGraph,
        targets: [ResourceId; 2],
        brush_count: usize,
        clears: bool,
    ) -> Self {
        let graph = &mut frame.graph;
        let points = graph.buffer::<InkPoint>("stroke points", FIRST_ROOM);
        let brushes = graph.buffer::<Brush>("brushes", brush_count.max(1));
        let size = graph.buffer::<Arguments>("size of strokes", 1);
        let drawn = WorkSize {
            arguments: size,
            index: 0,
        };
        let bound = [frame.output_window, points, brushes, frame.texels];
        graph.draw_sized(&DRAW_STROKES, (&bound, &targets), clears, Some(drawn));
        Self {
            points,
            brushes,
            size,
        }
    }

    /// Hands over the brushes.
    pub fn upload(&self, session: &mut dyn Session, brushes: &Brushes) -> Result<(), EngineError> {
        match brushes.all.is_empty() {
            true => write(session, self.brushes, &[Brush::default()]),
            false => write(session, self.brushes, &brushes.all),
        }
    }

    /// Hands over the strokes that a camera sees, with brushes that lie on them by the base width.
    ///
    /// Where there is less room than they take, the graph and its session get more, up to `graph_limit` bytes in all.
    pub fn upload_view(
        &self,
        session: &mut dyn Session,
        graph: &mut Graph,
        (view, drawings): (&View, &[Drawing]),
        brushes: (&Brushes, f32),
        graph_limit: u64,
    ) -> Result<(), RenderError> {
        let points = points_of(drawings, view, brushes);

        // Make room for more than there are: the next view may have a few more.
        let room = graph.element_count(self.points);
        if points.len() > room {
            let count = points.len() + points.len() / 2;
            let mut budget = Budget::new(graph_limit);
            budget.take("the plan of the frame", graph.planned_bytes() as usize, 1)?;
            budget.take(
                "the strokes of the frame",
                count - room,
                size_of::<InkPoint>(),
            )?;
            session.grow(self.points, count)?;
            graph.grow(self.points, count);
        }

        // Write them, and how many there are.
        let Work::Draw { vertices, .. } = DRAW_STROKES.work else {
            unreachable!("strokes are drawn");
        };
        write(session, self.points, &points)?;
        let count = Arguments::of_vertices(points.len() as u32 * vertices);
        Ok(write(session, self.size, &[count])?)
    }
}
