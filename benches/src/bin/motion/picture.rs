//! Parts of frames beside one another, to look at what causes say.

use std::fmt::Write;

use npr_benches::motion::traced::Traced;

/// Half the side of what is shown, in pixels of the frame.
const HALF_PX: f64 = 90.0;

/// Pixels of the picture for one of the frame.
const ZOOM: f64 = 4.0;

/// Colours of strokes, in turns.
const COLOURS: [&str; 6] = [
    "#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#8c564b",
];

/// The strokes around a place in several frames, each stroke in a colour of its own with a dot at its start and a ring
/// at its end.
pub fn panels(frames: &[&Traced], place: [f64; 2], number: usize) -> String {
    let side = 2.0 * HALF_PX;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {side}\"><rect \
         width=\"100%\" height=\"100%\" fill=\"white\"/><!-- frame {number} at {place:.0?} -->\n",
        ZOOM * side * frames.len() as f64,
        ZOOM * side,
        side * frames.len() as f64
    );
    for (panel, traced) in frames.iter().enumerate() {
        // Cut the frame around the place.
        let left = panel as f64 * side;
        let _ = writeln!(
            text,
            "<svg x=\"{left}\" width=\"{side}\" height=\"{side}\" viewBox=\"{} {} {side} {side}\"><rect x=\"{0}\" \
             y=\"{1}\" width=\"100%\" height=\"100%\" fill=\"none\" stroke=\"#ccc\"/>",
            place[0] - HALF_PX,
            place[1] - HALF_PX
        );

        // Draw the strokes that come into it.
        for (stroke, line) in traced.strokes.iter().enumerate() {
            let samples = &traced.samples[line.samples[0]..line.samples[1]];
            let is_near = samples
                .iter()
                .any(|sample| (0..2).all(|i| (sample.place[i] - place[i]).abs() < HALF_PX));
            if !is_near {
                continue;
            }
            let path: Vec<String> = samples
                .iter()
                .map(|sample| format!("{:.1} {:.1}", sample.place[0], sample.place[1]))
                .collect();
            let color = COLOURS[stroke % COLOURS.len()];
            let close = if line.closed { " Z" } else { "" };
            let _ = writeln!(
                text,
                "<path d=\"M{}{close}\" fill=\"none\" stroke=\"{color}\"/>",
                path.join(" L")
            );

            // Mark where they start and end.
            let ends = [(samples.first(), color), (samples.last(), "none")];
            for (sample, fill) in ends {
                let [x, y] = sample.map_or([0.0; 2], |sample| sample.place);
                let _ = writeln!(
                    text,
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2\" fill=\"{fill}\" stroke=\"{color}\" \
                     stroke-width=\"0.7\"/>"
                );
            }
        }
        text += "</svg>\n";
    }
    text + "</svg>\n"
}
