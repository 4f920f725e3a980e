//! The views in which the published path's emulation was measured.

use npr_benches::lines::candidates::Wanted;
use npr_benches::lines::measures::measure;
use npr_benches::lines::reference::Reference;
use npr_benches::lines::subjects::{LineSubject, SIZE, pilot_cameras, shared_models};
use npr_benches::lines::viewpoint::Viewpoint;
use npr_benches::table::Table;
use npr_render::{LineModel, LineModelOptions};
use npr_vector::stroke::Kind;

use crate::Outcome;
use crate::arguments::Arguments;
use crate::way::ways;

/// Models like those of the pilot.
const MODELS: [&str; 5] = [
    "stanford_bunny.glb",
    "utah_teapot.glb",
    "spot_textured.glb",
    "fox.glb",
    "suzanne.glb",
];

/// Contours and boundaries of the method in the pilot's views: means over views.
pub fn pilot(arguments: &Arguments) -> Outcome<()> {
    let wanted = Wanted {
        kinds: vec![Kind::Contour, Kind::Boundary],
        ..Wanted::default()
    };
    let ways = ways();
    let chosen = ways.iter().filter(|way| arguments.takes_way(way.name));
    let chosen: Vec<_> = chosen.collect();
    let mut table = Table::new([
        "model and way",
        "recall at 3 px",
        "least",
        "precision at 3 px",
        "least",
        "doubles",
        "strokes",
    ]);
    let folder = arguments.models.clone().unwrap_or_else(shared_models);
    for name in MODELS {
        if arguments
            .only
            .as_ref()
            .is_some_and(|part| !name.contains(part.as_str()))
        {
            continue;
        }
        let subject = LineSubject::load(&folder.join(name), false)?;
        let model = LineModel::new(&subject.scene, &LineModelOptions::default())?;
        let cameras = pilot_cameras(&subject);
        let mut found = vec![Vec::new(); chosen.len()];
        for camera in &cameras {
            let view = Viewpoint::new(camera, SIZE);
            let reference = Reference::new(&subject.soup, &view, &wanted);
            for (way, found) in chosen.iter().zip(&mut found) {
                let drawing = way.draw_kinds(&model, camera, &wanted)?;
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
            ];
            table.add(format!("{}, {}", subject.name, way.name), cells);
        }
    }
    println!(
        "## Views of the pilot\n\nContours and boundaries alone, from 3 radii, 15 degrees up, in steps of 45 degrees around; 45 degrees of view.\n\n{table}"
    );
    Ok(())
}
