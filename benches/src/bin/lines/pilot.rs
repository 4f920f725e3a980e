//! The views in which the published path's emulation was measured.

use npr_benches::lines::candidates::Wanted;
use npr_benches::lines::measures::measure;
use npr_benches::lines::picture::picture;
use npr_benches::lines::reference::Reference;
use npr_benches::lines::subjects::{LineSubject, SIZE, pilot_cameras, shared_models};
use npr_benches::lines::viewpoint::Viewpoint;
use npr_benches::table::Table;
use npr_render::{LineModel, LineModelOptions, LineSource};
use npr_vector::pixel_strokes::PublishedPath;
use npr_vector::stroke::Kind;

use crate::Outcome;
use crate::agreement::write_picture;
use crate::arguments::Arguments;
use crate::way::{Way, ways};
use std::path::PathBuf;

/// Models like those of the pilot.
const MODELS: [&str; 5] = [
    "stanford_bunny.glb",
    "utah_teapot.glb",
    "spot_textured.glb",
    "fox.glb",
    "suzanne.glb",
];

/// The files to measure.
fn subjects(arguments: &Arguments) -> Vec<PathBuf> {
    if let Some(file) = &arguments.model {
        return vec![file.clone()];
    }
    let folder = arguments.models.clone().unwrap_or_else(shared_models);
    let is_wanted = |name: &&str| {
        arguments
            .only
            .as_ref()
            .is_none_or(|part| name.contains(part))
    };
    let wanted = MODELS.into_iter().filter(is_wanted);
    wanted.map(|name| folder.join(name)).collect()
}

/// The published path with nothing taken for a speck, so that what despeckling costs shows.
fn without_specks(way: &Way) -> Way {
    Way {
        name: "the same without despeckling",
        potrace: PublishedPath {
            speck_area: 0.0,
            thin_speck_area: 0.0,
            ..PublishedPath::default()
        },
        ..*way
    }
}

/// Contours and boundaries of the method in the pilot's views: means over views.
pub fn pilot(arguments: &Arguments) -> Outcome<()> {
    // Choose the ways; the published one also without its specks.
    let wanted = Wanted {
        kinds: vec![Kind::Contour, Kind::Boundary],
        ..Wanted::default()
    };
    let ways = ways();
    let chosen = ways.iter().filter(|way| arguments.takes_way(way.name));
    let chosen: Vec<Way> = chosen
        .flat_map(|way| {
            let is_published = way.method == LineSource::Potrace;
            [Some(*way), is_published.then(|| without_specks(way))]
        })
        .flatten()
        .collect();
    let mut table = Table::new([
        "model and way",
        "recall at 3 px",
        "least",
        "precision at 3 px",
        "least",
        "doubles",
        "strokes",
        "contour px",
    ]);
    for path in subjects(arguments) {
        // Draw every view in every way, and measure it against the reference.
        let subject = LineSubject::load(&path, false)?;
        let model = LineModel::new(&subject.scene, &LineModelOptions::default())?;
        let cameras = pilot_cameras(&subject);
        let mut found = vec![Vec::new(); chosen.len()];
        for (number, camera) in cameras.iter().enumerate() {
            let view = Viewpoint::new(camera, SIZE);
            let reference = Reference::new(&subject.soup, &view, &wanted);

            // Sum up every way over the views.
            for (way, found) in chosen.iter().zip(&mut found) {
                let drawing = way.draw_kinds(&model, camera, &wanted)?;
                if let Some(folder) = &arguments.pictures {
                    let file = format!("{}_{number}_{}.svg", subject.name, way.file_word());
                    std::fs::create_dir_all(folder)?;
                    write_picture(&folder.join(file), &picture(&reference, &drawing))?;
                }
                found.push(measure(&drawing, &reference));
            }
        }
        for (way, found) in chosen.iter().zip(&found) {
            let mean = |of: &dyn Fn(usize) -> f64| {
                (0..found.len()).map(of).sum::<f64>() / found.len() as f64
            };
            let least =
                |of: &dyn Fn(usize) -> f64| (0..found.len()).map(of).fold(f64::INFINITY, f64::min);
            let recall = |i: usize| found[i].recall[2];
            let precision = |i: usize| found[i].precision[2];
            let cells = [
                format!("{:.4}", mean(&recall)),
                format!("{:.4}", least(&recall)),
                format!("{:.4}", mean(&precision)),
                format!("{:.4}", least(&precision)),
                format!("{:+.4}", mean(&|i| found[i].extra_doubles())),
                format!("{:.1}", mean(&|i| found[i].strokes.count as f64)),
                format!("{:.0}", mean(&|i| found[i].due_px)),
            ];
            table.add(format!("{}, {}", subject.name, way.name), cells);
        }
    }
    println!(
        "## Views of the pilot\n\nContours and boundaries alone, from 3 radii, 15 degrees up, in steps of 45 degrees \
         around; 45 degrees of view.\n\n{table}"
    );
    Ok(())
}
