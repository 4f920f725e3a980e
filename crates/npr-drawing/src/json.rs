//! Line data as JSON: every stroke with its points, depth, width and place in the world.
//!
//! One stroke per line of text. Pixels are written to a thousandth, depth, texture coordinate and world with seven
//! digits. Flat colour is not part of it, and colours of lines only of strokes that change theirs: `colors`, four
//! bytes a point, sRGB and alpha. Strokes that are parts of a line which goes on behind something have a key `part`:
//! the id of the `line`, how many pixels of it lie before the first point (`from`) and before the last (`to`), and its
//! whole `length`, with what is hidden between its parts.

use npr_core::decoding::guard;
use npr_core::number::{push_fixed, push_significant};
use npr_vector::stroke::{Drawing, Kind, LinePart, Stroke, StrokePoint, StrokeSurface};
use serde::Deserialize;
use std::collections::BTreeMap;

mod kind;

/// Most points that [`read_json`] takes.
pub const POINT_LIMIT: usize = 20_000_000;

/// The strokes of a drawing as JSON, version 1.
///
/// Numbers are always finite: points without a finite place are left out, and so are strokes of which less than two
/// points stay; other values become 0. The extra key `occluders` counts the surfaces in front of a hidden stroke.
pub fn write_json(drawing: &Drawing) -> Vec<u8> {
    let [width, height] = drawing.size;
    let mut text = format!("{{\"version\":1,\"size\":[{width},{height}],\"strokes\":[");
    let none = StrokeSurface::default();
    let mut first = true;
    for stroke in &drawing.strokes {
        let surface = drawing
            .surfaces
            .get(stroke.surface as usize)
            .unwrap_or(&none);

        // Write a stroke, or leave out one without a line.
        let start = text.len();
        text.push_str(if first { "\n" } else { ",\n" });
        if push_stroke(&mut text, stroke, surface) {
            first = false;
        } else {
            text.truncate(start);
        }
    }
    text.push_str("\n]}\n");
    text.into_bytes()
}

/// Writes a stroke; returns false if too little of it is finite.
fn push_stroke(text: &mut String, stroke: &Stroke, surface: &StrokeSurface) -> bool {
    // Leave out points that are not finite.
    let points: Vec<&StrokePoint> = stroke
        .points
        .iter()
        .filter(|p| p.position.iter().all(|v| v.is_finite()))
        .collect();
    if points.len() < 2 {
        return false;
    }

    // Write what the stroke is.
    let visibility = if stroke.is_visible() {
        "visible"
    } else {
        "hidden"
    };
    let Stroke {
        id,
        closed,
        occluders,
        ..
    } = stroke;
    let kind = stroke.kind.name();
    let [object, material] = [&surface.object, &surface.material].map(|name| quoted(name));
    *text += &format!(
        "{{\"id\":{id},\"kind\":\"{kind}\",\"visibility\":\"{visibility}\",\"occluders\":{occluders},\
         \"object\":{object},\"material\":{material},\"closed\":{closed},"
    );

    // Write which part of its line it is.
    if let Some(part) = stroke.part.filter(LinePart::is_sound) {
        let [start, end] = part.ends_px;
        *text += &format!("\"part\":{{\"line\":{},\"from\":", part.line);
        push_fixed(text, start, 3);
        text.push_str(",\"to\":");
        push_fixed(text, end, 3);
        text.push_str(",\"length\":");
        push_fixed(text, part.length_px, 3);
        text.push_str("},");
    }

    // Write its points in the picture, then in the world.
    text.push_str("\"points\":[");
    push_list(text, &points, |text, p| {
        push_fixed(text, p.position[0], 3);
        text.push(',');
        push_fixed(text, p.position[1], 3);
        text.push(',');
        push_significant(text, p.depth);
        text.push(',');
        push_fixed(text, if p.width.is_finite() { p.width } else { 0.0 }, 3);
        text.push(',');
        push_fixed(text, if p.u.is_finite() { p.u } else { 0.0 }, 3);
    });
    text.push_str("],\"world\":[");
    push_list(text, &points, |text, p| {
        for (i, v) in p.world.iter().enumerate() {
            if i > 0 {
                text.push(',');
            }
            push_significant(text, f64::from(*v));
        }
    });

    // Write colours where there are any.
    if points.iter().any(|p| p.color.is_some()) {
        text.push_str("],\"colors\":[");
        push_list(text, &points, |text, p| {
            let [r, g, b, a] = p.color.unwrap_or(surface.line_color);
            *text += &format!("{r},{g},{b},{a}");
        });
    }
    text.push_str("]}");
    true
}

fn push_list(text: &mut String, points: &[&StrokePoint], push: impl Fn(&mut String, &StrokePoint)) {
    for (i, point) in points.iter().enumerate() {
        text.push_str(if i == 0 { "[" } else { ",[" });
        push(text, point);
        text.push(']');
    }
}

/// Text between quotes, escaped.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Why line data was rejected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum JsonError {
    /// It is no JSON, or not of this form.
    #[error("{reason}")]
    Form {
        /// What is wrong, with line and column.
        reason: String,
    },
    /// A later version of the format.
    #[error("version {found} of line data, but only version 1 is known")]
    Version {
        /// As read.
        found: u32,
    },
    /// More points than can be taken.
    #[error("{count} points, but at most {POINT_LIMIT} are taken")]
    Points {
        /// Number of points up to the stroke that went too far.
        count: usize,
    },
    /// A stroke that is not valid.
    #[error("stroke {stroke}: {reason}")]
    Stroke {
        /// Its place in the list, from 0.
        stroke: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: u32,
    size: [u32; 2],
    strokes: Vec<FileStroke>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileStroke {
    id: u64,
    #[serde(deserialize_with = "kind::read")]
    kind: Kind,
    visibility: Visibility,
    #[serde(default)]
    occluders: Option<u32>,
    object: String,
    material: String,
    closed: bool,
    #[serde(default)]
    part: Option<FilePart>,
    points: Vec<[f64; 5]>,
    world: Vec<[f32; 3]>,
    #[serde(default)]
    colors: Option<Vec<[u8; 4]>>,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(deny_unknown_fields)]
struct FilePart {
    line: u64,
    from: f64,
    to: f64,
    length: f64,
}

impl From<FilePart> for LinePart {
    fn from(part: FilePart) -> Self {
        Self {
            line: part.line,
            ends_px: [part.from, part.to],
            length_px: part.length,
        }
    }
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Visibility {
    Visible,
    Hidden,
}

/// The drawing that line data describes.
///
/// Objects are told apart by name, and lines are black: numbers of objects and colours are not part of the data.
///
/// # Errors
///
/// Where the text is no line data of version 1, holds unknown keys or values out of range, or more than
/// [`POINT_LIMIT`] points.
pub fn read_json(bytes: &[u8]) -> Result<Drawing, JsonError> {
    // Read the form.
    let broken = |reason: &dyn std::fmt::Display| JsonError::Form {
        reason: reason.to_string(),
    };
    let parsed = guard(|| serde_json::from_slice(bytes)).map_err(|stopped| broken(&stopped))?;
    let file: File = parsed.map_err(|error: serde_json::Error| broken(&error))?;
    if file.version != 1 {
        return Err(JsonError::Version {
            found: file.version,
        });
    }

    // Read strokes one by one, and check each.
    let mut drawing = Drawing {
        size: file.size,
        ..Drawing::default()
    };
    let mut names = Names::default();
    let mut count = 0;
    for (index, stroke) in file.strokes.into_iter().enumerate() {
        count += stroke.points.len();
        if count > POINT_LIMIT {
            return Err(JsonError::Points { count });
        }
        check(&stroke).map_err(|reason| JsonError::Stroke {
            stroke: index,
            reason,
        })?;
        drawing.strokes.push(stroke_of(stroke, &mut names));
    }
    drawing.surfaces = names.surfaces;
    Ok(drawing)
}

/// What is wrong with a stroke, if anything.
fn check(stroke: &FileStroke) -> Result<(), &'static str> {
    // Compare what the stroke says of itself.
    let finite = stroke.points.iter().flatten().all(|v| v.is_finite())
        && stroke.world.iter().flatten().all(|v| v.is_finite());
    let hidden = stroke.occluders.is_none_or(|count| count > 0);
    let agrees = match stroke.visibility {
        Visibility::Visible => stroke.occluders.unwrap_or(0) == 0,
        Visibility::Hidden => hidden,
    };
    let colors = stroke.colors.as_ref();
    let colors_fit = colors.is_none_or(|colors| colors.len() == stroke.points.len());

    // Name the first that is wrong.
    if stroke.points.len() < 2 {
        Err("fewer than two points")
    } else if stroke.points.len() != stroke.world.len() {
        Err("as many places in the world as points are needed")
    } else if !colors_fit {
        Err("as many colours as points are needed")
    } else if !finite {
        Err("a number is out of range")
    } else if stroke
        .part
        .is_some_and(|part| !LinePart::from(part).is_sound())
    {
        Err("a part lies outside of its line")
    } else if !agrees {
        Err("visibility and occluders disagree")
    } else {
        Ok(())
    }
}

/// Surfaces by the names of object and material.
#[derive(Default)]
struct Names {
    surfaces: Vec<StrokeSurface>,
    known: BTreeMap<(String, String), u32>,
    objects: BTreeMap<String, u32>,
}

impl Names {
    fn surface(&mut self, object: String, material: String) -> u32 {
        let number = self.objects.len() as u32;
        let number = *self.objects.entry(object.clone()).or_insert(number);
        let index = self.surfaces.len() as u32;
        let found = *self
            .known
            .entry((object.clone(), material.clone()))
            .or_insert(index);
        if found == index {
            self.surfaces.push(StrokeSurface {
                object,
                object_number: number,
                material,
                line_color: [0, 0, 0, 255],
                fill_color: [255; 4],
            });
        }
        found
    }
}

fn stroke_of(stroke: FileStroke, names: &mut Names) -> Stroke {
    // Give every point its place, its width, and a colour where the stroke has any.
    let points = stroke.points.iter().zip(&stroke.world).enumerate();
    let color_of = |i: usize| stroke.colors.as_ref()?.get(i).copied();
    Stroke {
        id: stroke.id,
        kind: stroke.kind,
        occluders: stroke
            .occluders
            .unwrap_or(u32::from(stroke.visibility == Visibility::Hidden)),
        surface: names.surface(stroke.object, stroke.material),
        closed: stroke.closed,
        part: stroke.part.map(LinePart::from),
        points: points
            .map(|(i, ([x, y, depth, width, u], world))| StrokePoint {
                position: [*x, *y],
                depth: *depth,
                width: *width,
                u: *u,
                world: *world,
                color: color_of(i),
                ..StrokePoint::default()
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn drawing() -> impl Strategy<Value = Drawing> {
        let point = (
            [-1e4..1e4f64, -1e4..1e4f64],
            (0.0..1e6f64, 0.0..99.0f64, -1e5..1e5f64),
            prop::array::uniform3(-1e5..1e5f32),
            any::<[u8; 4]>(),
        );
        let points = prop::collection::vec(point, 2..9);
        let stroke = (
            any::<u64>(),
            0usize..6,
            0u32..3,
            any::<bool>(),
            points,
            (0u32..2, any::<bool>()),
        );
        let surface = (".*", ".*");
        let surfaces = prop::collection::vec(surface, 2);
        (prop::collection::vec(stroke, 0..5), surfaces).prop_map(|(strokes, surfaces)| Drawing {
            size: [640, 480],
            surfaces: surfaces
                .into_iter()
                .map(|(object, material)| StrokeSurface {
                    object,
                    material,
                    ..StrokeSurface::default()
                })
                .collect(),
            strokes: strokes
                .into_iter()
                .map(
                    |(id, kind, occluders, closed, points, (surface, colored))| Stroke {
                        id,
                        kind: Kind::ALL[kind],
                        occluders,
                        surface,
                        closed,
                        part: colored.then_some(LinePart {
                            line: !id,
                            ends_px: [60.125, f64::from(surface)],
                            length_px: 80.25,
                        }),
                        points: points
                            .into_iter()
                            .map(|(position, (depth, width, u), world, color)| StrokePoint {
                                position,
                                depth,
                                width,
                                u,
                                world,
                                color: colored.then_some(color),
                                ..StrokePoint::default()
                            })
                            .collect(),
                    },
                )
                .collect(),
            ..Drawing::default()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn what_is_written_reads_back(drawing in drawing()) {
            let bytes = write_json(&drawing);
            let back = read_json(&bytes).expect("own output");
            prop_assert_eq!(back.strokes.len(), drawing.strokes.len());
            for (a, b) in drawing.strokes.iter().zip(&back.strokes) {
                prop_assert_eq!((a.id, a.kind, a.occluders, a.closed), (b.id, b.kind, b.occluders, b.closed));
                prop_assert_eq!(a.part, b.part);
                let [named, also] = [(&drawing, a), (&back, b)].map(|(d, s)| {
                    let surface = &d.surfaces[s.surface as usize];
                    (&surface.object, &surface.material)
                });
                prop_assert_eq!(named, also);
                for (p, q) in a.points.iter().zip(&b.points) {
                    prop_assert!((0..2).all(|i| (p.position[i] - q.position[i]).abs() <= 0.000501));
                    prop_assert!((p.depth - q.depth).abs() <= 1e-6 * p.depth);
                    prop_assert!((0..3).all(|i| (p.world[i] - q.world[i]).abs() <= 1e-6 * p.world[i].abs()));
                }
            }
            // Writing what was read gives the same bytes.
            prop_assert_eq!(write_json(&back), bytes);
        }
    }

    #[test]
    fn nothing_that_is_no_number_is_written() {
        let point = |x: f64, v: f64| StrokePoint {
            position: [x, 1.0],
            depth: v,
            width: v,
            u: v,
            world: [v as f32; 3],
            ..StrokePoint::default()
        };
        let stroke = |points: Vec<StrokePoint>| Stroke {
            id: 1,
            kind: Kind::Crease,
            occluders: 0,
            surface: 99,
            closed: false,
            part: None,
            points,
        };
        let drawing = Drawing {
            strokes: vec![
                stroke(vec![point(f64::NAN, 0.0), point(1.0, 0.0)]),
                stroke(vec![
                    point(1.0, f64::NAN),
                    point(f64::INFINITY, 1.0),
                    point(2.0, f64::INFINITY),
                ]),
            ],
            ..Drawing::default()
        };
        let back = read_json(&write_json(&drawing)).expect("own output");
        assert_eq!(back.strokes.len(), 1);
        assert_eq!(back.strokes[0].points.len(), 2);
    }

    #[test]
    fn foreign_files_are_refused_with_a_reason() {
        let wrong = |text: &str| read_json(text.as_bytes()).expect_err("refused").to_string();
        assert!(wrong("{").contains("line 1"));
        assert!(wrong(r#"{"version":2,"size":[1,1],"strokes":[]}"#).starts_with("version 2"));
        assert!(wrong(r#"{"version":1,"size":[1,1],"strokes":[],"more":1}"#).contains("more"));
        let short = r#"{"version":1,"size":[1,1],"strokes":[{"id":1,"kind":"crease","visibility":"visible",
            "object":"","material":"","closed":false,"points":[[1,2,3,4,5]],"world":[[1,2,3]]}]}"#;
        assert_eq!(wrong(short), "stroke 0: fewer than two points");
        let part =
            r#""closed":false,"part":{"line":1,"from":0,"to":9,"length":8},"points":[[1,2,3,4,5],"#;
        let outside = short.replace(r#""closed":false,"points":["#, part);
        let outside = outside.replace(r#""world":["#, r#""world":[[1,2,3],"#);
        assert_eq!(wrong(&outside), "stroke 0: a part lies outside of its line");
    }
}
