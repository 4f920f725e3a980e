//! Sampled sights against the reference.

use npr_benches::lines::candidates::Wanted;
use npr_benches::lines::measures::{Measures, TOLERANCES_PX, measure};
use npr_benches::lines::reference::Reference;
use npr_benches::lines::sampled::sampled_drawing;
use npr_benches::lines::subjects::{LineSubject, SIZE};
use npr_benches::lines::viewpoint::Viewpoint;
use npr_benches::machine;
use npr_benches::table::Table;
use npr_render::{LineModel, LineModelOptions};

use crate::Outcome;
use crate::agreement::files;
use crate::arguments::Arguments;

/// The tolerance by which lines are lost or shown: that of 2 pixels.
const TOLERANCE: usize = 1;

/// What is lost and wrongly shown of every model in every view.
pub fn sights(arguments: &Arguments) -> Outcome<()> {
    // Say what was measured, and where.
    println!("# Sampled sights\n");
    println!("- machine: {}", machine::description());
    println!("- code: {}", machine::code());
    println!(
        "- frame {}x{}, a sample a pixel, one sample of colour a pixel",
        SIZE[0], SIZE[1]
    );
    println!(
        "- reference: every half pixel of every contour, boundary and crease, seen by a ray of its own in double \
         precision"
    );
    println!(
        "- lost: share of what must be drawn that has no ink within {} px; shown: ink farther than that from \
         everything that may be drawn, as a share of what is hidden\n",
        TOLERANCES_PX[TOLERANCE]
    );

    // Measure every view.
    let mut table = Table::new([
        "model",
        "seen, px",
        "hidden, px",
        "lost",
        "shown",
        "recall at 1 px",
        "precision at 1 px",
    ]);
    let mut worst: [(f64, String); 2] = Default::default();
    for (path, unit) in files(arguments) {
        let subject = LineSubject::load(&path, unit)?;
        eprintln!("measuring {}", subject.name);
        let model = LineModel::new(&subject.scene, &LineModelOptions::default())?;
        for (number, camera) in subject.cameras.iter().enumerate() {
            let view = Viewpoint::new(camera, SIZE);
            let reference = Reference::new(&subject.soup, &view, &Wanted::default());
            let drawing = sampled_drawing(&model, camera, SIZE, &Wanted::default());
            let found: Measures = measure(&drawing, &reference);
            let faults = found.faults(&reference, TOLERANCE);
            let name = format!("{} {}", subject.name, number + 1);
            for (worst, share) in worst.iter_mut().zip(faults) {
                if share > worst.0 {
                    *worst = (share, name.clone());
                }
            }
            table.add(
                name,
                [
                    format!("{:.0}", found.due_px),
                    format!("{:.0}", reference.hidden_px),
                    format!("{:.4}", faults[0]),
                    format!("{:.4}", faults[1]),
                    format!("{:.4}", found.recall[0]),
                    format!("{:.4}", found.precision[0]),
                ],
            );
        }
    }
    println!("{table}");
    let [lost, shown] = worst;
    println!(
        "At worst {:.4} are lost ({}), and {:.4} shown ({}).",
        lost.0, lost.1, shown.0, shown.1
    );
    Ok(())
}
