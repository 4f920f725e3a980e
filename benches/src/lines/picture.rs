//! A view's reference, its drawn runs and a drawing beside one another, as SVG, to look at what the figures say.

use std::fmt::Write;

use npr_vector::stroke::Drawing;

use super::doubles::double_places;
use super::ink::{Curve, sample};
use super::reference::Reference;

/// Colours of strokes, in turns: neighbours in a list differ.
const COLOURS: [&str; 8] = [
    "#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf", "#8c564b", "#e377c2",
];

/// Three panels side by side: runs of the reference, drawn runs, and the strokes of a drawing, each line in a colour
/// of its own, its ends as dots. Ink that lies double is marked in the third.
pub fn picture(reference: &Reference, drawing: &Drawing) -> String {
    let [width, height] = drawing.size;

    // Gather the lines of every panel.
    let strokes = Curve::of_drawing(drawing);
    let runs = reference.runs.iter().map(|run| (&run.points, run.closed));
    let drawn = reference.drawn.iter().map(|run| (&run.points, run.closed));
    let own = strokes.iter().map(|curve| (&curve.points, curve.closed));

    // Draw the panels beside each other.
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {height}\"><rect width=\"100%\" height=\"100%\" \
         fill=\"white\"/>\n",
        3 * width
    );
    for (panel, lines) in [panel(runs), panel(drawn), panel(own) + &marks(&strokes)]
        .iter()
        .enumerate()
    {
        let _ = writeln!(
            text,
            "<g transform=\"translate({} 0)\">{lines}</g>",
            panel as u32 * width
        );
    }
    text + "</svg>\n"
}

/// Lines with a dot at each end.
fn panel<'a>(lines: impl Iterator<Item = (&'a Vec<[f64; 2]>, bool)>) -> String {
    let mut text = String::new();
    for (number, (points, closed)) in lines.enumerate() {
        // Draw the line in a colour of its own.
        let color = COLOURS[number % COLOURS.len()];
        let path: Vec<String> = points
            .iter()
            .map(|[x, y]| format!("{x:.2} {y:.2}"))
            .collect();
        let close = if closed { " Z" } else { "" };
        let _ = writeln!(
            text,
            "<path d=\"M{}{close}\" fill=\"none\" stroke=\"{color}\"/>",
            path.join(" L")
        );

        // Mark the ends of an open line.
        for [x, y] in points
            .first()
            .into_iter()
            .chain(points.last())
            .filter(|_| !closed)
        {
            let _ = writeln!(
                text,
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"1.5\" fill=\"{color}\"/>"
            );
        }
    }
    text
}

/// Rings around ink that lies double.
fn marks(strokes: &[Curve]) -> String {
    let ink = sample(strokes);
    let places = double_places(&ink, strokes);
    let ring = |[x, y]: [f64; 2]| {
        format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3\" fill=\"red\" fill-opacity=\"0.2\"/>\n")
    };
    places.map(ring).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::analytic::Solid;
    use crate::lines::subjects::benchmark_camera;

    #[test]
    fn a_ball_is_a_closed_line_in_each_panel_that_shows_it() {
        let reference = Solid::Ball.reference(&benchmark_camera(), [96, 54]);
        let drawing = Drawing {
            size: [96, 54],
            ..Drawing::default()
        };
        let text = picture(&reference, &drawing);
        assert_eq!(
            (
                text.matches(" Z\"").count(),
                text.matches("<circle").count()
            ),
            (2, 0)
        );
        assert!(text.contains("viewBox=\"0 0 288 54\""));
    }
}
