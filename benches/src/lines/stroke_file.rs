//! Line data of any program, from a file.

use std::error::Error;
use std::path::Path;

use npr_vector::stroke::{Drawing, Kind, Stroke, StrokePoint};
use serde::Deserialize;

/// A `.json` file of lines; only what the measures need is read.
#[derive(Debug, Deserialize)]
struct StrokeFile {
    size: [u32; 2],
    strokes: Vec<FileStroke>,
}

/// A stroke of the file.
#[derive(Debug, Deserialize)]
struct FileStroke {
    kind: String,
    #[serde(default)]
    visibility: Option<String>,
    #[serde(default)]
    closed: bool,
    /// The first two numbers of a point are x and y.
    points: Vec<Vec<f64>>,
}

/// The drawing in a file of lines.
///
/// # Errors
///
/// Whatever reading says; a kind that is not known; a point of fewer than two numbers.
pub fn read(path: &Path) -> Result<Drawing, Box<dyn Error>> {
    parse(&std::fs::read(path)?)
}

/// The drawing in the bytes of a file of lines.
fn parse(bytes: &[u8]) -> Result<Drawing, Box<dyn Error>> {
    let file: StrokeFile = serde_json::from_slice(bytes)?;
    let strokes = file.strokes.iter().map(stroke).collect::<Result<_, _>>()?;
    Ok(Drawing {
        size: file.size,
        strokes,
        ..Drawing::default()
    })
}

fn stroke(stroke: &FileStroke) -> Result<Stroke, String> {
    let kind = Kind::ALL
        .into_iter()
        .find(|kind| kind.name() == stroke.kind);
    let point = |numbers: &Vec<f64>| match numbers[..] {
        [x, y, ..] => Ok(StrokePoint {
            position: [x, y],
            ..StrokePoint::default()
        }),
        _ => Err("a point has fewer than two numbers".to_owned()),
    };
    Ok(Stroke {
        id: 0,
        kind: kind.ok_or_else(|| format!("there is no kind of line called '{}'", stroke.kind))?,
        occluders: u32::from(stroke.visibility.as_deref() == Some("hidden")),
        surface: 0,
        closed: stroke.closed,
        part: None,
        points: stroke.points.iter().map(point).collect::<Result<_, _>>()?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_come_back() {
        let text = br#"{ "version": 1, "size": [40, 30], "strokes": [
            { "id": 17, "kind": "contour", "visibility": "hidden", "object": "Body", "closed": true,
              "points": [[1, 2, 3, 4, 5], [6, 7, 8, 9, 10]], "world": [[0, 0, 0], [1, 1, 1]] },
            { "kind": "crease", "points": [[1.5, 2.5], [3, 4]] } ] }"#;
        let drawing = parse(text).unwrap();
        assert_eq!((drawing.size, drawing.strokes.len()), ([40, 30], 2));
        assert!(!drawing.strokes[0].is_visible() && drawing.strokes[0].closed);
        assert_eq!(drawing.strokes[1].points[0].position, [1.5, 2.5]);
    }

    #[test]
    fn faults_are_named() {
        let text = |kind: &str, point: &str| {
            format!(
                r#"{{ "size": [4, 3], "strokes": [ {{ "kind": "{kind}", "points": [{point}] }} ] }}"#
            )
        };
        let fault = |text: String| parse(text.as_bytes()).unwrap_err().to_string();
        assert!(fault(text("scribble", "[1, 2]")).contains("scribble"));
        assert!(fault(text("crease", "[1]")).contains("fewer than two"));
    }
}
