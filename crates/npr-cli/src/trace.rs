//! `npr trace`: turns bitmaps into curves.

use crate::arguments::{TraceArguments, TracedForm, TracedFormat};
use crate::ending::has_ending;
use crate::fault::{Exit, Fault};
use crate::idle;
use crate::input::{read_file, read_standard};
use crate::job::output_path;
use crate::message::{self, quoted};
use crate::output::Output;
use crate::picture;
use crate::progress::Progress;
use crate::source::Source;
use npr_drawing::centreline::write_centrelines;
use npr_drawing::fill::mesh::FlatMesh;
use npr_scene::Limits;
use npr_trace::centreline::centrelines;
use npr_trace::{Bitmap, IndexPicture, trace as trace_bitmap, trace_colors_to_file, trace_to_file};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Traces the bitmaps that the user named, one after the other.
pub fn trace(args: &TraceArguments) -> Result<(), Fault> {
    let jobs = resolve(args)?;
    let limits = args.limits.limits();
    message::warn_all(args.quiet, idle::of_trace(args));
    let mut progress = Progress::new(args.quiet);
    for job in &jobs {
        draw(job, args, &limits, &mut progress)?;
    }
    progress.finish();
    Ok(())
}

/// One bitmap to trace. Everything that can be checked without reading it is already checked.
struct TraceJob {
    source: Source,
    output: Output,
    format: TracedFormat,
}

fn draw(
    job: &TraceJob,
    args: &TraceArguments,
    limits: &Limits,
    progress: &mut Progress,
) -> Result<(), Fault> {
    let picture = load(job, args, limits, progress)?;
    let options = args.method.options();
    // Curves are written as they come, so that few of them are in memory.
    let bytes = match (picture, job.format.form()) {
        (Traced::Ink(bitmap), TracedForm::Curves(format)) if !args.form.centreline => {
            return progress.step("trace", || {
                let output = &job.output;
                output.write_with(|sink| trace_to_file(bitmap, &options, format, sink))
            });
        }
        (Traced::Colors(picture), TracedForm::Curves(format)) => {
            return progress.step("trace", || {
                let output = &job.output;
                output.write_with(|sink| trace_colors_to_file(&picture, &options, format, sink))
            });
        }
        (Traced::Colors(_), TracedForm::Mesh(_)) => return Err(colors_are_no_mesh()),
        (Traced::Ink(bitmap), form) => progress.step("trace", || found(&bitmap, args, form))?,
    };
    progress.step("write", || job.output.write(&bytes))
}

/// The decoded picture to trace: ink, or few colours.
enum Traced {
    Ink(Bitmap),
    Colors(IndexPicture),
}

impl Traced {
    fn ink(mut bitmap: Bitmap, args: &TraceArguments) -> Self {
        if args.method.invert {
            bitmap.invert();
        }
        Self::Ink(bitmap)
    }
}

/// Reads the picture to trace. A binary PBM file is read without holding its bytes.
fn load(
    job: &TraceJob,
    args: &TraceArguments,
    limits: &Limits,
    progress: &mut Progress,
) -> Result<Traced, Fault> {
    // Read the packed rows of a binary PBM file as they are.
    let name = match &job.source {
        Source::Standard => "standard input".to_owned(),
        Source::File(path) => quoted(path),
    };
    let broken = |fault: Fault| fault.while_doing(format_args!("cannot read {name}"));
    let rows = progress.step("load", || match &job.source {
        Source::File(path) if args.form.colors.is_none() => {
            picture::read_packed(path, limits).map_err(&broken)
        }
        _ => Ok(None),
    })?;
    if let Some(bitmap) = rows {
        return Ok(Traced::ink(bitmap, args));
    }

    // Read and decode anything else.
    let bytes = progress.step("load", || match &job.source {
        Source::Standard => read_standard(limits.file_bytes),
        Source::File(path) => read_file(path, limits.file_bytes),
    })?;
    progress.step("decode", || {
        let picture = decoded(&bytes, args, limits).map_err(broken);
        drop(bytes);
        picture
    })
}

fn decoded(bytes: &[u8], args: &TraceArguments, limits: &Limits) -> Result<Traced, Fault> {
    if let Some(most) = args.form.colors {
        return Ok(Traced::Colors(picture::decode_colors(bytes, limits, most)?));
    }
    let bitmap = picture::decode_bitmap(bytes, limits, args.method.blacklevel)?;
    Ok(Traced::ink(bitmap, args))
}

/// Centre lines or triangles found in a bitmap, as the bytes of a file.
fn found(bitmap: &Bitmap, args: &TraceArguments, form: TracedForm) -> Result<Vec<u8>, Fault> {
    let options = args.method.options();
    match form {
        TracedForm::Curves(format) => {
            let options = args.form.centreline_options(&options);
            Ok(write_centrelines(&centrelines(bitmap, &options), format))
        }
        TracedForm::Mesh(format) => {
            let mesh = FlatMesh::of_tracing(&trace_bitmap(bitmap, &options));
            let mesh = mesh.map_err(|error| Fault::new(Exit::Limit, error))?;
            Ok(mesh.write(format))
        }
    }
}

/// Resolves the arguments into one job for each bitmap.
fn resolve(args: &TraceArguments) -> Result<Vec<TraceJob>, Fault> {
    // Refuse to read standard input twice.
    let sources: Vec<Source> = args.bitmaps.iter().map(|path| Source::of(path)).collect();
    if sources
        .iter()
        .filter(|source| **source == Source::Standard)
        .count()
        > 1
    {
        let message = "standard input can be read only once";
        return Err(Fault::new(Exit::Usage, message));
    }
    let inputs: Vec<PathBuf> = args.bitmaps.clone();
    let mut taken = BTreeSet::new();
    let mut jobs = Vec::new();
    for source in sources {
        // Refuse meshes of centre lines, and of layers in colour.
        let path = path_for(args, &source)?;
        let format = format_of(args.format, &path)?;
        if args.form.centreline && matches!(format.form(), TracedForm::Mesh(_)) {
            let message = "centre lines have no inside to fill: .obj and .glb hold filled shapes";
            return Err(Fault::new(Exit::Usage, message));
        }
        if args.form.colors.is_some() && matches!(format.form(), TracedForm::Mesh(_)) {
            return Err(colors_are_no_mesh());
        }

        // Refuse to write over an input, or twice to one file.
        let output = Output::of(&path)?;
        output.refuse_any_of(&inputs)?;
        if !taken.insert(path.clone()) {
            let message = format!("two bitmaps would be written to {}", quoted(&path));
            return Err(Fault::new(Exit::Usage, message));
        }
        jobs.push(TraceJob {
            source,
            output,
            format,
        });
    }
    Ok(jobs)
}

fn colors_are_no_mesh() -> Fault {
    let message = "layers in colour are written to .svg, .pdf, .json or .geojson: \
                   triangles in .obj and .glb have no colours";
    Fault::new(Exit::Usage, message)
}

/// The output path for one bitmap.
fn path_for(args: &TraceArguments, source: &Source) -> Result<PathBuf, Fault> {
    // Write several bitmaps into a folder.
    let asked = args.output.as_deref();
    let folder = match asked {
        Some(path) if path.is_dir() => Some(path),
        Some(path) if args.bitmaps.len() > 1 => {
            let message = format!(
                "there is no folder {}: several bitmaps are written into one",
                quoted(path)
            );
            return Err(Fault::new(Exit::Usage, message));
        }
        _ => None,
    };

    // Name the file after its bitmap, unless the user names it.
    let ending = TracedFormat::ENDINGS
        .into_iter()
        .find(|(format, _)| Some(*format) == args.format)
        .map_or("svg", |(_, ending)| ending);
    match folder {
        Some(folder) => Ok(folder.join(output_path(None, source, ending)?)),
        None => output_path(asked, source, ending),
    }
}

/// The format that the user gave, or else that of the path's extension; SVG on standard output.
fn format_of(asked: Option<TracedFormat>, path: &Path) -> Result<TracedFormat, Fault> {
    if let Some(format) = asked {
        return Ok(format);
    }
    if path.as_os_str() == "-" {
        return Ok(TracedFormat::Svg);
    }
    let mut endings = TracedFormat::ENDINGS.into_iter();
    let found = endings.find(|(_, ending)| has_ending(path, ending));
    found.map(|(format, _)| format).ok_or_else(|| {
        let message = format!(
            "cannot write {}: bitmaps are traced to .svg, .pdf, .json, .geojson, .obj or .glb",
            quoted(path)
        );
        Fault::new(Exit::Usage, message)
    })
}
