//! Models in several views, and strokes from files, against the reference.

use std::path::{Path, PathBuf};

use npr_benches::lines::candidates::Wanted;
use npr_benches::lines::measures::measure;
use npr_benches::lines::picture::picture;
use npr_benches::lines::reference::Reference;
use npr_benches::lines::report::{Row, section};
use npr_benches::lines::stroke_file;
use npr_benches::lines::subjects::{
    LineSubject, MODELS, PEER_MESHES, SIZE, benchmark_camera, shared_models,
};
use npr_benches::lines::viewpoint::Viewpoint;
use npr_core::camera::{Camera, Projection};
use npr_render::{LineModel, LineModelOptions};

use crate::Outcome;
use crate::arguments::Arguments;
use crate::way::ways;

/// What strokes are counted against, and why.
const COUNTING: &str = "\
Strokes as they are found on the mesh are counted against runs, the reference's lines along mesh edges from where one \
appears to where it is lost. Smoothed strokes are counted against drawn runs, the strokes that a pen of 3 px needs \
for a picture of the same lines: along the edges of fine meshes a line that everyone sees as one comes and goes \
within a pixel, hundreds of runs of which smoothing leaves out all but one. Loops of `surface` run through the middle \
of what edges zigzag about, so that there too fewer strokes than runs are lines less broken: what is below the bar \
says how many strokes a drawn run there are, where less than one would be a line missed. As strokes are grouped by \
kind and object, so are drawn runs; what is shorter than 8 px is a speck and counts on neither side.
";

/// Triangles over which a model is not quick.
const QUICK_TRIANGLES: usize = 20_000;

/// Measures strokes from a file.
pub fn judge(arguments: &Arguments, strokes: &Path, model: &Path) -> Outcome<()> {
    let drawing = stroke_file::read(strokes)?;
    let subject = LineSubject::load(model, true)?;
    let usual = benchmark_camera();
    let mut camera = Camera {
        eye: arguments.eye.unwrap_or(usual.eye),
        target: arguments.target.unwrap_or(usual.target),
        ..usual
    };
    if let Some(degrees) = arguments.fov {
        camera.projection = Projection::Perspective {
            fov_y: degrees.to_radians(),
        };
    }
    let mut wanted = Wanted::default();
    if let Some(degrees) = arguments.crease {
        wanted.crease = degrees.to_radians();
    }
    let view = Viewpoint::new(&camera, drawing.size);
    let reference = Reference::new(&subject.soup, &view, &wanted);
    let row = Row {
        model: subject.name,
        view: 1,
        measures: measure(&drawing, &reference),
    };
    let bar = ways()[0].bar;
    print!("{}", section("Strokes of a file", &bar, &[row]));
    Ok(())
}

/// Files to measure, each with whether it lies in the unit ball.
pub fn files(arguments: &Arguments) -> Vec<(PathBuf, bool)> {
    let models = arguments.models.clone().unwrap_or_else(shared_models);
    let shared = MODELS.iter().map(|name| (models.join(name), false));
    let peers = arguments.peers.iter().flat_map(|folder| {
        PEER_MESHES
            .iter()
            .map(move |name| (folder.join(name), true))
    });
    let wanted = |path: &Path| {
        arguments
            .only
            .as_ref()
            .is_none_or(|part| path.to_string_lossy().contains(part.as_str()))
    };
    let (there, missing): (Vec<_>, Vec<_>) = peers
        .chain(shared)
        .filter(|(path, _)| wanted(path))
        .partition(|(path, _)| path.is_file());
    for (path, _) in missing {
        eprintln!("left out: there is no {}", path.display());
    }
    there
}

#[expect(
    clippy::disallowed_methods,
    reason = "to look at once; half of one shows that it is half"
)]
pub fn write_picture(path: &Path, svg: &str) -> Outcome<()> {
    Ok(std::fs::write(path, svg)?)
}

/// Every model in every view and every way.
pub fn agreement(arguments: &Arguments) -> Outcome<()> {
    let ways: Vec<_> = ways()
        .into_iter()
        .filter(|way| arguments.takes_way(way.name))
        .collect();
    let mut rows: Vec<Vec<Row>> = ways.iter().map(|_| Vec::new()).collect();
    for (path, unit) in files(arguments) {
        let subject = LineSubject::load(&path, unit)?;
        if arguments.quick && subject.soup.faces.len() > QUICK_TRIANGLES {
            continue;
        }
        eprintln!("measuring {}", subject.name);
        let model = LineModel::new(&subject.scene, &LineModelOptions::default())?;
        let views = if arguments.quick {
            1
        } else {
            subject.cameras.len()
        };
        for (number, camera) in subject.cameras[..views].iter().enumerate() {
            let view = Viewpoint::new(camera, SIZE);
            let reference = Reference::new(&subject.soup, &view, &Wanted::default());
            for (way, rows) in ways.iter().zip(&mut rows) {
                let drawing = way.draw(&model, camera)?;
                if let Some(folder) = &arguments.pictures {
                    let name = format!("{}_{}_{}.svg", subject.name, number + 1, way.file_word());
                    write_picture(&folder.join(name), &picture(&reference, &drawing))?;
                }
                rows.push(Row {
                    model: subject.name.clone(),
                    view: number + 1,
                    measures: measure(&drawing, &reference),
                });
            }
        }
    }
    println!("{COUNTING}");
    for (way, rows) in ways.iter().zip(&rows) {
        println!("{}", section(way.name, &way.bar, rows));
    }
    Ok(())
}
