//! The warnings about options that have no effect, each with the reason.

use crate::arguments::{
    AnimateArguments, HiddenLines, LineFormat, LinesArguments, PathForm, SmokeArguments, Switch,
    TraceArguments, VolumeArguments, VolumeUp,
};
use crate::line_job::LineJob;
use crate::volume::{DEFAULT_FPS, DEFAULT_STEP, Order, VolumeSource};
use npr_render::LineSource;
use npr_stylesheet::{Facts, SmokeParticles, Style};
use npr_trace::TraceOptions;

/// An option, and a condition under which it has no effect.
struct Entry<T> {
    /// The option as it is typed, such as `--seed`.
    option: &'static str,
    /// Whether the user gave the option; where it has a default, whether the value differs from it.
    is_said: fn(&T) -> bool,
    /// Whether the option has no effect.
    is_idle: fn(&T) -> bool,
    /// The reason, as the warning states it.
    why: &'static str,
}

const fn entry<T>(
    option: &'static str,
    is_said: fn(&T) -> bool,
    is_idle: fn(&T) -> bool,
    why: &'static str,
) -> Entry<T> {
    Entry {
        option,
        is_said,
        is_idle,
        why,
    }
}

/// The warnings about options that have no effect, at most one for each option.
fn reported<T>(entries: &[Entry<T>], case: &T) -> Vec<String> {
    let idle = entries
        .iter()
        .filter(|entry| (entry.is_said)(case) && (entry.is_idle)(case));
    let mut reported: Vec<&str> = Vec::new();
    let first = idle.filter(|entry| {
        let is_new = !reported.contains(&entry.option);
        reported.push(entry.option);
        is_new
    });
    first
        .map(|entry| format!("{} is ignored: {}", entry.option, entry.why))
        .collect()
}

/// The facts that decide which volume options have an effect.
struct Volumes<'a> {
    args: &'a VolumeArguments,
    /// The kind of spheres that stand for smoke.
    particles: SmokeParticles,
    /// Whether there is any smoke.
    is_any: bool,
    /// Whether any smoke comes from a file.
    is_of_file: bool,
}

/// The entry of an option that needs smoke.
const fn of_smoke_alone<'a>(
    option: &'static str,
    is_said: fn(&Volumes<'a>) -> bool,
) -> Entry<Volumes<'a>> {
    entry(option, is_said, |c| !c.is_any, "the scene has no smoke")
}

/// The entry of an option that needs smoke from a file.
const fn of_files_alone<'a>(
    option: &'static str,
    is_said: fn(&Volumes<'a>) -> bool,
) -> Entry<Volumes<'a>> {
    let why = "no smoke comes from a volume file";
    entry(option, is_said, |c| !c.is_of_file, why)
}

/// The conditions under which volume options have no effect.
fn volume_entries<'a>() -> Vec<Entry<Volumes<'a>>> {
    vec![
        of_smoke_alone("--spheres", |c| c.args.spheres.is_some()),
        of_smoke_alone("--threshold", |c| c.args.threshold.is_some()),
        of_smoke_alone("--detail", |c| c.args.detail.is_some()),
        entry(
            "--seed",
            |c| c.args.seed != 0,
            |c| !c.is_any,
            "it is about smoke, of which the scene has none",
        ),
        of_smoke_alone("--particles", |c| c.args.particles.is_some()),
        of_smoke_alone("--emitter", |c| c.args.emitter.is_some()),
        entry(
            "--emitter",
            |c| c.args.emitter.is_some(),
            |c| c.particles == SmokeParticles::Cover,
            "smoke.particles is cover",
        ),
        entry(
            "--detail",
            |c| c.args.detail.is_some(),
            |c| c.particles == SmokeParticles::Published,
            "smoke.particles is published",
        ),
        of_files_alone("--density", |c| c.args.density.is_some()),
        of_files_alone("--velocity", |c| !c.args.velocity.is_empty()),
        of_files_alone("--heat", |c| c.args.heat.is_some()),
        of_files_alone("--volume-up", |c| c.args.volume_up != VolumeUp::default()),
    ]
}

/// The warnings about volume options that have no effect. `own` is the scene itself, where it is a volume.
pub fn of_volumes(order: &Order<'_>, own: Option<&VolumeSource>) -> Vec<String> {
    let args = order.args;
    let named: Vec<VolumeSource> = args
        .volumes
        .iter()
        .map(|volume| VolumeSource::of(&volume.name))
        .collect();
    let mut all = named.iter().chain(own);
    let is_of_file = all
        .clone()
        .any(|source| !matches!(source, VolumeSource::BuiltIn(_)));
    let case = Volumes {
        args,
        particles: order.style.particles,
        is_any: all.next().is_some(),
        is_of_file,
    };
    reported(&volume_entries(), &case)
}

/// The facts that decide which options of `npr lines` have an effect.
struct Lines<'a> {
    args: &'a LinesArguments,
    format: LineFormat,
    facts: Facts,
    /// Whether brushes draw any strokes.
    has_brushes: bool,
}

impl Lines<'_> {
    fn is_plotted(&self) -> bool {
        self.args.sheet.svg == PathForm::Centreline
    }
}

/// The conditions under which options of `npr lines` have no effect.
fn line_entries<'a>() -> Vec<Entry<Lines<'a>>> {
    vec![
        entry(
            "--painted",
            |c| c.args.lines.painted.is_some(),
            |c| !c.facts.textures,
            "the scene has no textures",
        ),
        entry(
            "--svg",
            |c| c.args.sheet.svg != PathForm::Outline,
            |c| c.format == LineFormat::Json,
            "the file holds points, and no paths",
        ),
        entry(
            "--svg",
            |c| c.args.sheet.svg == PathForm::Stamps,
            |c| !c.has_brushes,
            "a pen draws all strokes, as line.brush says",
        ),
        entry(
            "--fill",
            |c| c.args.lines.fill,
            |c| c.format == LineFormat::Json,
            "the file holds lines alone",
        ),
        entry(
            "--background",
            |c| c.args.drawing.look.background.is_some(),
            |c| c.format == LineFormat::Json || c.is_plotted(),
            "the file holds lines alone",
        ),
        entry(
            "--hidden",
            |c| c.args.lines.hidden == HiddenLines::Dashed,
            |c| c.format == LineFormat::Json,
            "the file tells how many surfaces hide a line, and has no dashes",
        ),
        entry(
            "--smooth",
            |c| c.args.lines.smooth == Switch::Off,
            |c| c.args.lines.method == LineSource::Image,
            "--method image follows pixels, which are smoothed in any case",
        ),
    ]
}

/// The warnings about options of `npr lines` that have no effect, where `has_brushes` is whether brushes draw any
/// strokes.
pub fn of_lines(job: &LineJob<'_>, facts: Facts, has_brushes: bool) -> Vec<String> {
    let case = Lines {
        args: job.args,
        format: job.format,
        facts,
        has_brushes,
    };
    reported(&line_entries(), &case)
}

/// The facts that decide which options of `npr animate` have an effect.
struct Animate<'a> {
    args: &'a AnimateArguments,
    /// Whether frames are line drawings.
    draws_lines: bool,
    /// Whether they are pictures with strokes.
    has_strokes: bool,
    /// Whether a clip plays, or the film is one file, which says how fast it does.
    is_timed: bool,
}

/// The entry of an option about line drawings.
const fn of_line_films<'a>(
    option: &'static str,
    is_said: fn(&Animate<'a>) -> bool,
) -> Entry<Animate<'a>> {
    let why = "frames are pictures: --lines draws the lines alone";
    entry(option, is_said, |c| !c.draws_lines, why)
}

/// The conditions under which options of `npr animate` have no effect.
fn animate_entries<'a>() -> Vec<Entry<Animate<'a>>> {
    vec![
        entry(
            "--fps",
            |c| c.args.film.fps != DEFAULT_FPS,
            |c| !c.is_timed && (c.args.film.frames.is_some() || c.args.film.length.is_some()),
            "every file holds one frame, and no clip plays",
        ),
        entry(
            "--length",
            |c| c.args.film.length.is_some(),
            |c| c.args.film.frames.is_some() && !c.args.film.turntable,
            "--frames says what is drawn, and --orbit by how much the camera turns",
        ),
        entry(
            "--hold",
            |c| c.args.film.hold == Switch::Off,
            |c| !c.draws_lines && !c.has_strokes,
            "no lines of this style are strokes (line.method)",
        ),
        of_line_films("--kinds", |c| c.args.lines.kinds.is_some()),
        of_line_films("--crease", |c| c.args.lines.crease.is_some()),
        of_line_films("--crease-from", |c| c.args.lines.crease_from.is_some()),
        of_line_films("--split", |c| c.args.lines.split.is_some()),
        of_line_films("--method", |c| c.args.lines.method != LineSource::default()),
        of_line_films("--hidden", |c| c.args.lines.hidden != HiddenLines::None),
        of_line_films("--smooth", |c| c.args.lines.smooth == Switch::Off),
        of_line_films("--fill", |c| c.args.lines.fill),
        of_line_films("--painted", |c| c.args.lines.painted.is_some()),
        of_line_films("--weld", |c| c.args.lines.weld != 0.0),
        of_line_films("--svg", |c| c.args.sheet.svg != PathForm::Outline),
        of_line_films("--page", |c| c.args.sheet.page.is_some()),
    ]
}

/// The warnings about options of `npr animate` that have no effect; see [`Animate`].
pub fn of_animate(
    args: &AnimateArguments,
    draws_lines: bool,
    style: &Style,
    is_timed: bool,
) -> Vec<String> {
    reported(
        &animate_entries(),
        &Animate {
            args,
            draws_lines,
            has_strokes: style.has_curves(),
            is_timed,
        },
    )
}

/// The facts that decide which options of `npr smoke` have an effect; `count` is the number of pictures.
struct Smoke<'a> {
    args: &'a SmokeArguments,
    source: &'a VolumeSource,
    count: usize,
}

/// The conditions under which options of `npr smoke` have no effect.
fn smoke_entries<'a>() -> Vec<Entry<Smoke<'a>>> {
    vec![
        entry(
            "--step",
            |c| c.args.step != DEFAULT_STEP,
            |c| c.count < 2,
            "one frame is drawn",
        ),
        entry(
            "--fps",
            |c| c.args.fps != DEFAULT_FPS,
            |c| matches!(c.source, VolumeSource::File(_) | VolumeSource::Read(..)),
            "a single volume file stands still",
        ),
    ]
}

/// The warnings about options of `npr smoke` that have no effect, where it draws `count` pictures.
pub fn of_smoke(args: &SmokeArguments, source: &VolumeSource, count: usize) -> Vec<String> {
    reported(
        &smoke_entries(),
        &Smoke {
            args,
            source,
            count,
        },
    )
}

/// The entry of an option that acts on outlines of ink only, not on centre lines.
const fn of_outlines_alone(
    option: &'static str,
    is_said: fn(&TraceArguments) -> bool,
) -> Entry<TraceArguments> {
    let why = "it is about outlines, and --centreline traces the middle of lines";
    entry(option, is_said, |c| c.form.centreline, why)
}

/// Whether `--opttolerance` differs from its default.
fn is_tolerance_said(args: &TraceArguments) -> bool {
    Some(args.method.opttolerance) != TraceOptions::default().join_tolerance
}

const TRACE: &[Entry<TraceArguments>] = &[
    of_outlines_alone("--turnpolicy", |c| {
        c.method.turnpolicy != TraceOptions::default().turn_policy
    }),
    of_outlines_alone("--alphamax", |c| {
        c.method.alphamax != TraceOptions::default().alpha_max
    }),
    of_outlines_alone("--opttolerance", is_tolerance_said),
    of_outlines_alone("--longcurve", |c| c.method.longcurve),
    entry(
        "--opttolerance",
        is_tolerance_said,
        |c| c.method.longcurve,
        "--longcurve joins no curves",
    ),
];

/// The warnings about options of `npr trace` that have no effect.
pub fn of_trace(args: &TraceArguments) -> Vec<String> {
    reported(TRACE, args)
}
