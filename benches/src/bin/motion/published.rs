//! Figures of other programs and of an emulation of the published path.

use npr_benches::table::Table;

/// Mesh, method, drift in pixels, share of ends lost, share of samples that pop.
///
/// Turning by 0.5 degrees a frame, contours alone, at 1920x1080. The emulation of [Jiang et al. 2022] follows pixels;
/// Line Art and Freestyle are those of Blender 5.0.1.
const FIGURES: [(&str, &str, f64, f64, f64); 13] = [
    ("bunny of 4968", "emulation", 2.94, 0.068, 0.133),
    ("bunny of 4968", "Line Art", 0.12, 0.047, 0.199),
    ("bunny of 4968", "Freestyle", 0.07, 0.071, 0.207),
    ("cow of 5804", "emulation", 2.91, 0.069, 0.142),
    ("cow of 5804", "Line Art", 0.04, 0.025, 0.143),
    ("cow of 5804", "Freestyle", 0.02, 0.022, 0.073),
    ("teapot of 6320", "emulation", 2.67, 0.021, 0.060),
    ("teapot of 6320", "Line Art", 0.13, 0.040, 0.143),
    ("teapot of 6320", "Freestyle", 0.07, 0.019, 0.046),
    ("fandisk of 12946", "emulation", 2.72, 0.039, 0.029),
    ("fandisk of 12946", "Line Art", 1.46, 0.073, 0.031),
    ("rocker arm of 20088", "emulation", 3.87, 0.159, 0.243),
    ("rocker arm of 20088", "Line Art", 0.09, 0.017, 0.255),
];

/// Prints them.
pub fn table() {
    println!("## Other programs\n");
    println!(
        "Figures of an earlier pilot, S1 over 40 frames (Freestyle 12), contours alone and other meshes, so no race: \
         the emulation of [Jiang et al. 2022] follows pixels, Line Art and Freestyle are those of Blender 5.0.1. \
         Pops are those of the arc length, before any transfer from frame to frame; a vote of the frame before brought \
         those of the emulation to 0 to 3.5 %.\n"
    );
    let mut table = Table::new([
        "mesh, triangles",
        "method",
        "drift, px",
        "lost, %",
        "pop, %",
    ]);
    for (mesh, method, drift, lost, pop) in FIGURES {
        let cells = [
            method.to_owned(),
            format!("{drift:.2}"),
            format!("{:.1}", 100.0 * lost),
            format!("{:.1}", 100.0 * pop),
        ];
        table.add(mesh, cells);
    }
    println!("{table}");
}
