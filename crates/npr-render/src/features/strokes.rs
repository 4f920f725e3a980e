//! Strokes as the lines of a frame: those of parts whose method is `strokes` or `potrace`, found before the frame is
//! drawn and inked by a pass of it.

use crate::brushes::Brushes;
use crate::error::RenderError;
use crate::frame::Frame;
use crate::frame_graph::{FrameGraph, write};
use crate::lines::{LineOptions, LineRenderer, Pointed, Spot};
use crate::manners::StrokeManners;
use crate::options::RendererOptions;
use crate::stage::LineStage;
use npr_core::budget::Budget;
use npr_core::camera::Camera;
use npr_core::line_source::LineSource;
use npr_core::window::View;
use npr_drawing::ink::ink_points;
use npr_drawing::sampled::{Sampling, most_strokes, sample_strokes};
use npr_gpu::curves::sampling::{SampledFrame, add_sampling};
use npr_gpu::engine::{EngineError, PassTime, Session};
use npr_gpu::graph::{Graph, ResourceId, WorkSize};
use npr_gpu::pass::Work;
use npr_gpu::passes::stroke::DRAW_STROKES;
use npr_stylesheet::{LineVisibility, Style};
use npr_vector::brush::Brush;
use npr_vector::ink_point::InkPoint;
use npr_vector::rank::work::Arguments;
use npr_vector::sampled::{PartWidth, PartWidths, SampledLine, SpineSample};
use npr_vector::stroke::{Drawing, Stroke};

/// Points that there is room for at first; frames with more of them make more room.
const FIRST_ROOM: usize = 4096;

/// Pixels of a frame for each sample of its lines: of a frame full of lines one in thirty pixels lies on one.
const PIXELS_PER_SAMPLE: usize = 16;

/// Least number of samples that there is room for.
const LEAST_SAMPLES: usize = 1 << 14;

/// Strokes that a camera sees, or may see.
#[derive(Debug, Default)]
pub(crate) struct FoundStrokes {
    /// What is seen of strokes, by exact sights.
    pub seen: Vec<Drawing>,
    /// Strokes whose passes find out what is seen of them.
    pub open: Option<Drawing>,
}

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

/// Number of samples that a frame has room for where its style asks for sampled sights and nothing needs exact ones;
/// 0 where all sights are exact. What needs them is told.
pub(crate) fn sample_room(
    (style, brushes, manners): (&Style, &Brushes, &StrokeManners),
    options: &RendererOptions,
    is_tiled: bool,
    notices: &mut Vec<String>,
) -> usize {
    if style.line.visibility != LineVisibility::Sampled || !style.has_curves() {
        return 0;
    }
    let reasons = [
        (manners.has_dashes(), "dashes"),
        (manners.moves_ends(), "overshoot"),
        (brushes.has_stamps(), "stamps"),
        (
            !style.curve_sources().eq([LineSource::Edges]),
            "method potrace",
        ),
        (manners.all.len() > PartWidths::MOST, "many manners"),
        (style.has_tufts(), "tufts"),
        (!style.line.guides.is_empty(), "guides"),
        (style.motion.smear > 0.0, "motion.smear"),
        (style.motion.swell != 0.0, "motion.swell"),
        (options.layers, "layers"),
        (is_tiled, "tiles"),
    ];
    let needs: Vec<&str> = reasons
        .iter()
        .filter(|(is_met, _)| *is_met)
        .map(|(_, what)| *what)
        .collect();
    if !needs.is_empty() {
        let what = needs.join(", ");
        notices.push(format!(
            "line.visibility is exact in this frame, because of {what}"
        ));
        return 0;
    }
    let pixels = options.size[0] as usize * options.size[1] as usize;
    (pixels / PIXELS_PER_SAMPLE)
        .max(LEAST_SAMPLES)
        .next_multiple_of(4)
}

/// Finds the strokes that a camera sees of the parts whose method asks for them, and tells how; without a line model
/// there is a notice instead. Where `leaves_open`, passes will find out what is seen.
pub(crate) fn find(
    lines: Option<&mut LineRenderer<'_>>,
    camera: &Camera,
    (style, options): (&Style, &RendererOptions),
    leaves_open: bool,
) -> Result<(FoundStrokes, StrokeReport), RenderError> {
    let (mut found, mut report) = (FoundStrokes::default(), StrokeReport::default());
    if !style.has_curves() {
        return Ok((found, report));
    }
    let Some(lines) = lines else {
        let notice = "lines of method potrace are left out: no line model was given";
        report.notices.push(notice.to_owned());
        return Ok((found, report));
    };
    let of_style = line_options(style, options);
    for method in style.curve_sources() {
        let of_method = (&LineOptions { method, ..of_style }, leaves_open);
        let beside = (&options.pictures, &options.interrupt);
        let drawing = lines.draw_curves(camera, style, of_method, beside)?;
        report.times.extend_from_slice(lines.times());
        report.notices.extend_from_slice(&drawing.notices);
        let drawing = drawing.scaled(options.stroke_scale());
        match leaves_open {
            true => found.open = Some(drawing),
            false => found.seen.push(drawing),
        }
    }
    Ok((found, report))
}

fn line_options(style: &Style, options: &RendererOptions) -> LineOptions {
    LineOptions {
        dpi: options.stroke_dpi(),
        ..LineOptions::of_style(style, options.stroke_size())
    }
}

/// What strokes of a frame are at a spot, and what surface. What is seen of them is found exactly, whatever the style.
pub(crate) fn point_at(
    lines: &mut LineRenderer<'_>,
    camera: &Camera,
    (style, options): (&Style, &RendererOptions),
    spot: Spot,
) -> Result<Pointed, RenderError> {
    // Ask every method, in the pixels of its strokes.
    let by = options.stroke_scale();
    let spot = Spot {
        place: spot.place.map(|at| at / by),
        reach_px: spot.reach_px / by,
    };
    let of_style = line_options(style, options);
    let mut pointed = Pointed::default();
    for method in style.curve_sources() {
        let of_method = LineOptions { method, ..of_style };
        let found = lines.point_at_curves(camera, style, &of_method, &options.pictures, spot)?;
        pointed.part = pointed.part.or(found.part);
        let best = pointed.line.as_ref().map(|line| line.away_px);
        if found
            .line
            .as_ref()
            .is_some_and(|line| best.is_none_or(|best| line.away_px < best))
        {
            pointed.line = found.line;
        }
    }

    // Tell it in pixels of the frame.
    if let Some(line) = &mut pointed.line {
        let points = line.points.iter_mut();
        points.for_each(|point| *point = point.map(|at| at * by));
        line.width_px *= by;
        line.away_px *= by;
    }
    Ok(pointed)
}

/// The strokes of every method at a stage, in pixels of the frame.
pub(crate) fn at_stage(
    lines: &mut LineRenderer<'_>,
    camera: &Camera,
    (style, options): (&Style, &RendererOptions),
    stage: LineStage,
) -> Result<Vec<Drawing>, RenderError> {
    let mut drawings = Vec::new();
    for method in style.curve_sources() {
        let of_method = LineOptions {
            method,
            hidden: stage == LineStage::Found,
            smooth: stage == LineStage::Joined,
            ..line_options(style, options)
        };
        let drawing = lines.found_curves(camera, style, &of_method, &options.pictures)?;
        drawings.push(drawing.scaled(options.stroke_scale()));
    }
    Ok(drawings)
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

/// The passes that ink strokes, and what the host fills for them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StrokePasses {
    brushes: ResourceId,
    input: Input,
}

/// What strokes are handed over as.
#[derive(Debug, Clone, Copy)]
enum Input {
    /// Points of what is seen, and how many vertices are drawn.
    Points {
        points: ResourceId,
        size: ResourceId,
    },
    /// Samples of all lines, of which passes make points.
    Samples {
        samples: ResourceId,
        lines: ResourceId,
        widths: ResourceId,
    },
}

impl StrokePasses {
    /// Adds the passes that ink strokes with `brush_count` brushes into a picture and its keys, which are cleared
    /// before where `clears`; for more than no samples those that find out what is seen of so many.
    pub fn plan(
        frame: &mut FrameGraph,
        targets: [ResourceId; 2],
        (brush_count, sample_room): (usize, usize),
        clears: bool,
    ) -> Self {
        let brushes = frame.graph.buffer::<Brush>("brushes", brush_count.max(1));
        let (input, points, size) = match sample_room {
            0 => Self::plan_points(frame),
            _ => Self::plan_samples(frame, sample_room),
        };
        let bound = [frame.output_window, points, brushes, frame.texels];
        frame
            .graph
            .draw_sized(&DRAW_STROKES, (&bound, &targets), clears, size);
        Self { brushes, input }
    }

    fn plan_points(frame: &mut FrameGraph) -> (Input, ResourceId, Option<WorkSize>) {
        let graph = &mut frame.graph;
        let points = graph.buffer::<InkPoint>("stroke points", FIRST_ROOM);
        let size = graph.buffer::<Arguments>("size of strokes", 1);
        let drawn = WorkSize {
            arguments: size,
            index: 0,
        };
        (Input::Points { points, size }, points, Some(drawn))
    }

    fn plan_samples(frame: &mut FrameGraph, room: usize) -> (Input, ResourceId, Option<WorkSize>) {
        let graph = &mut frame.graph;
        let samples = graph.buffer::<SpineSample>("samples of lines", room);
        let lines = graph.buffer::<SampledLine>("sampled lines", most_strokes(room) + 1);
        let widths = graph.uniform::<PartWidths>("widths of parts");
        let on = SampledFrame {
            view: frame.view,
            window: frame.color_window,
            ids: frame.ids,
            posed: frame.posed,
            triangles: frame.triangles,
            samples,
            lines,
            widths,
        };
        let points = add_sampling(&mut frame.graph, &on);
        let input = Input::Samples {
            samples,
            lines,
            widths,
        };
        (input, points, None)
    }

    /// Hands over the brushes.
    pub fn upload(&self, session: &mut dyn Session, brushes: &Brushes) -> Result<(), EngineError> {
        match brushes.all.is_empty() {
            true => write(session, self.brushes, &[Brush::default()]),
            false => write(session, self.brushes, &brushes.all),
        }
    }

    /// Hands over the strokes that a camera sees, or may see, with brushes that lie on them by the base width.
    ///
    /// Where there is less room than points take, the graph and its session get more, up to `graph_limit` bytes in all;
    /// samples lie farther apart where lines are many.
    pub fn upload_view(
        &self,
        session: &mut dyn Session,
        graph: &mut Graph,
        (view, found, part_widths): (&View, &FoundStrokes, &[PartWidth]),
        (brushes, manners, base_px): (&Brushes, &StrokeManners, f32),
        graph_limit: u64,
    ) -> Result<(), RenderError> {
        match self.input {
            Input::Points { points, size } => {
                let inked = points_of(&found.seen, view, (brushes, base_px));
                make_room(session, graph, (points, inked.len()), graph_limit)?;

                // Write them, and how many there are.
                let Work::Draw { vertices, .. } = DRAW_STROKES.work else {
                    unreachable!("strokes are drawn");
                };
                write(session, points, &inked)?;
                let count = Arguments::of_vertices(inked.len() as u32 * vertices);
                Ok(write(session, size, &[count])?)
            }
            Input::Samples {
                samples,
                lines,
                widths,
            } => {
                let nothing = Drawing::default();
                let drawing = found.open.as_ref().unwrap_or(&nothing);
                let sampling = Sampling {
                    view,
                    lay_of: &|stroke: &Stroke| brushes.lay_of(stroke, base_px),
                    width_of: &|stroke: &Stroke| manners.number_of(stroke),
                };
                let room = graph.element_count(samples);
                let Some(sampled) = sample_strokes(drawing, &sampling, room) else {
                    return Err(RenderError::TooMany {
                        what: "sampled lines",
                        limit: most_strokes(room) as u64,
                    });
                };
                write(session, samples, &sampled.samples)?;
                write(session, lines, &sampled.lines)?;
                Ok(write(session, widths, &[PartWidths::of(part_widths)])?)
            }
        }
    }
}

/// Makes room for points, and for more than there are: the next view may have a few more.
fn make_room(
    session: &mut dyn Session,
    graph: &mut Graph,
    (points, needed): (ResourceId, usize),
    graph_limit: u64,
) -> Result<(), RenderError> {
    let room = graph.element_count(points);
    if needed > room {
        let count = needed + needed / 2;
        let mut budget = Budget::new(graph_limit);
        budget.take("the plan of the frame", graph.planned_bytes() as usize, 1)?;
        budget.take(
            "the strokes of the frame",
            count - room,
            size_of::<InkPoint>(),
        )?;
        session.grow(points, count)?;
        graph.grow(points, count);
    }
    Ok(())
}
