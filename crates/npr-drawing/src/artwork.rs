//! A drawing as shapes in layers, ready for any kind of file: the common ground of SVG, PDF and PNG.
//!
//! Flat colour lies at the bottom, hidden lines above it, visible ones on top; lines are layered by kind, and within
//! a layer grouped by object. Everything is cut to the picture, so that no file holds anything far outside.

use crate::clip::{clip_ring, clip_stroke};
use crate::color_runs;
use crate::fit::{FitOptions, fit};
use crate::lettering::Lettered;
use crate::outline::outline;
use crate::page::Placing;
use crate::plot;
use crate::stamped::{self, Stamp, Stamped};
use kurbo::BezPath;
use npr_vector::stroke::{Drawing, Kind, Region, Stroke, StrokePoint, StrokeSurface};
use rayon::prelude::*;

pub use crate::mark::{Mark, Paint};
pub use crate::page::Page;
pub use crate::stamped::{STAMPS_LIMIT, StampImage, StrokeBrushes, stamp_count};

/// How lines behind surfaces are drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Hidden {
    /// They are left out.
    #[default]
    None,
    /// They go into layers of their own, half transparent.
    Layer,
    /// They are dashed, half transparent, in layers of their own.
    Dashed,
}

/// The shapes that lines become.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Paths {
    /// A stroked path where its width is even, else the filled outline of its ink.
    #[default]
    Outline,
    /// A stroked path with its mean width, in an order and direction for pen plotters.
    Centreline,
    /// As `Outline`, but visible strokes with a brush are its image, set down again and again.
    Stamps,
}

/// How a drawing is put into a file.
#[derive(Debug, Clone, PartialEq)]
pub struct ArtworkOptions {
    /// The shapes that lines become.
    pub paths: Paths,
    /// How lines behind surfaces are drawn.
    pub hidden: Hidden,
    /// Colour of the ground, sRGB and alpha; without one nothing lies under the lines.
    pub background: Option<[u8; 4]>,
    /// A sheet to fit the picture on; without, the file has the picture's size in pixels.
    pub page: Option<Page>,
    /// How far curves may be from the lines, in pixels of the picture: 0.02 to 1, default 0.03.
    ///
    /// Outlines of ink are held to half of it, because their two sides show every error twice. With the default a line
    /// of 3 pixels differs from that of a frame in less than 1 % of its ink; with 0.25, in 2 to 4 %, in files half as
    /// large.
    pub tolerance_px: f64,
    /// Words over the lines; they go into a layer of their own, on top.
    ///
    /// For centrelines, a pen goes around the letters; bands and insides stay empty.
    pub lettering: Vec<Lettered>,
    /// The brushes of the strokes, for [`Paths::Stamps`]; none by default, so that all draw with a pen.
    pub brushes: StrokeBrushes,
}

impl Default for ArtworkOptions {
    fn default() -> Self {
        Self {
            paths: Paths::Outline,
            hidden: Hidden::None,
            background: None,
            page: None,
            tolerance_px: 0.03,
            lettering: Vec::new(),
            brushes: StrokeBrushes::default(),
        }
    }
}

/// The marks of one object in a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Number of the object.
    pub object: u32,
    /// Name of the object; any text.
    pub label: String,
    /// The shapes, from the lowest to the topmost.
    pub marks: Vec<Mark>,
}

/// Marks of one sort.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// A name of lower-case letters and hyphens, unique in the artwork.
    pub name: String,
    /// Groups of marks, never empty.
    pub groups: Vec<Group>,
}

/// Shapes in layers, from the lowest to the topmost.
#[derive(Debug, Clone, PartialEq)]
pub struct Artwork {
    /// Width and height, in pixels, or in millimetres of a page.
    pub size: [f64; 2],
    /// Whether the unit is the millimetre.
    pub is_page: bool,
    /// Units per pixel of the drawing.
    pub scale: f64,
    /// Colour of the ground.
    pub background: Option<[u8; 4]>,
    /// Layers that hold something.
    pub layers: Vec<Layer>,
    /// The images that marks of [`Paint::Image`] show.
    pub images: Vec<StampImage>,
}

/// Length of a dash and of the gap behind it, in widths of a line; round ends take one of the gap.
pub(crate) const DASH: [f64; 2] = [4.0, 3.5];

/// Width of the line around regions, in pixels: less shows cracks between neighbours on some renderers.
pub(crate) const REGION_SEAM_PX: f64 = 0.6;

/// Share by which the widths of an even line may differ.
const EVEN: f64 = 0.01;

/// Least width of a drawn line in pixels: thinner lines are drawn with it, so that files show them.
const HAIRLINE_PX: f64 = 0.05;

/// Width of the line that pens draw around letters, in pixels.
const PEN_PX: f64 = 1.0;

/// Most characters of a name.
pub(crate) const NAME_LENGTH: usize = 200;

/// A name for files: cut, and without control characters, characters that XML forbids, and those that turn the
/// direction of text.
pub(crate) fn plain_name(name: &str) -> String {
    let turns = |c: char| {
        let is_mark = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}');
        is_mark || matches!(c, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let is_no_character = |c: char| matches!(c as u32 & 0xffff, 0xfffe | 0xffff);
    name.chars()
        .filter(|c| !(c.is_control() || turns(*c) || is_no_character(*c)))
        .take(NAME_LENGTH)
        .collect()
}

/// A surface for strokes whose own is missing.
static NO_SURFACE: StrokeSurface = StrokeSurface {
    object: String::new(),
    object_number: u32::MAX,
    material: String::new(),
    line_color: [0, 0, 0, 255],
    fill_color: [255, 255, 255, 255],
};

/// Shapes of a drawing in layers.
///
/// Strokes are worked on in parallel; the result does not depend on the number of threads. O(n log n) in points.
///
/// Of a drawing with more than [`STAMPS_LIMIT`] stamps all strokes are outlines: ask [`stamp_count`] before.
pub fn arrange(drawing: &Drawing, options: &ArtworkOptions) -> Artwork {
    let placing = Placing::of(drawing.size, options.page);
    let mut maker = Maker {
        drawing,
        options,
        placing: &placing,
        stamped: Stamped::default(),
    };
    if options.paths == Paths::Stamps {
        let own_color = |stroke: &Stroke| maker.surface(stroke.surface).line_color;
        maker.stamped = stamped::stamp(drawing, &options.brushes, &own_color);
    }

    // Lay flat colour at the bottom, hidden lines over it, visible ones over those, and words on top.
    let mut layers = vec![maker.fills()];
    let hidden = match options.hidden {
        Hidden::None => &[false][..],
        Hidden::Layer | Hidden::Dashed => &[true, false],
    };
    for hidden in hidden {
        layers.extend(Kind::ALL.iter().map(|kind| maker.lines(*kind, *hidden)));
    }
    layers.push(maker.lettering());
    layers.retain(|layer| !layer.groups.is_empty());

    // Measure in the unit of the page.
    Artwork {
        size: placing.size,
        is_page: options.page.is_some(),
        scale: placing.scale,
        background: options.background,
        layers,
        images: maker.stamped.images,
    }
}

/// Makes the layers of one drawing.
struct Maker<'a> {
    drawing: &'a Drawing,
    options: &'a ArtworkOptions,
    placing: &'a Placing,
    /// The stamps of strokes with a brush.
    stamped: Stamped,
}

/// Points along a stroke, and whether the last continues to the first.
type Way<'a> = (&'a [StrokePoint], bool);

impl Maker<'_> {
    fn surface(&self, index: u32) -> &StrokeSurface {
        self.drawing
            .surfaces
            .get(index as usize)
            .unwrap_or(&NO_SURFACE)
    }

    /// The layer of flat colour, in the order of the drawing.
    fn fills(&self) -> Layer {
        let marks: Vec<(u32, Mark)> = self
            .drawing
            .regions
            .iter()
            .filter_map(|region| Some((region.surface, self.region(region)?)))
            .collect();
        Layer {
            name: "fills".into(),
            groups: self.group(marks, false),
        }
    }

    fn region(&self, region: &Region) -> Option<Mark> {
        let mut path = BezPath::new();

        // Cut every ring to the picture.
        for ring in &region.rings {
            let ring = clip_ring(ring, self.drawing.size.map(f64::from));
            for (i, [x, y]) in ring.iter().enumerate() {
                if i == 0 {
                    path.move_to((*x, *y));
                } else {
                    path.line_to((*x, *y));
                }
            }
            if !ring.is_empty() {
                path.close_path();
            }
        }

        // Paint what is left in the surface's colour.
        (!path.is_empty()).then(|| Mark {
            stroke: None,
            path: self.placing.affine() * path,
            paint: Paint::Region,
            color: self.surface(region.surface).fill_color,
        })
    }

    /// The layer of lines of one kind, visible or hidden, grouped by object.
    fn lines(&self, kind: Kind, hidden: bool) -> Layer {
        // Take the strokes of one kind, seen or hidden.
        let all = self.drawing.strokes.iter().enumerate();
        let strokes: Vec<(usize, &Stroke)> = all
            .filter(|(_, stroke)| stroke.kind == kind && stroke.is_visible() != hidden)
            .collect();

        // Draw them with ink, or lead a pen along them.
        let marks: Vec<(u32, Mark)> = match self.options.paths {
            Paths::Outline | Paths::Stamps => strokes
                .par_iter()
                .flat_map_iter(|(number, stroke)| match self.stamped.of(*number) {
                    Some(stamps) => self.stamps(stroke, stamps),
                    None => self.inked(stroke, hidden),
                })
                .collect(),
            Paths::Centreline => {
                let strokes: Vec<&Stroke> = strokes.iter().map(|(_, stroke)| *stroke).collect();
                self.plotted(&strokes, hidden)
            }
        };

        // Name the layer, and group it by object.
        let name = kind.name();
        Layer {
            name: if hidden {
                format!("hidden-{name}")
            } else {
                name.into()
            },
            groups: self.group(marks, true),
        }
    }

    /// Marks of one stroke as stamps.
    fn stamps(&self, stroke: &Stroke, stamps: &[Stamp]) -> Vec<(u32, Mark)> {
        let mark = |stamp: &Stamp| {
            let mut path = BezPath::with_capacity(5);
            let [first, rest @ ..] = stamp.corners;
            path.move_to((first[0], first[1]));
            rest.iter().for_each(|[x, y]| path.line_to((*x, *y)));
            path.close_path();
            let mark = Mark {
                stroke: Some(stroke.id),
                path: self.placing.affine() * path,
                paint: Paint::Image(stamp.image),
                color: stamp.color,
            };
            (stroke.surface, mark)
        };
        stamps.iter().map(mark).collect()
    }

    /// Marks of one stroke as ink.
    fn inked(&self, stroke: &Stroke, hidden: bool) -> Vec<(u32, Mark)> {
        let pad = 0.5 * widest(&stroke.points) + 1.0;
        let dashed = hidden && self.options.hidden == Hidden::Dashed;
        let parts = clip_stroke(stroke, self.drawing.size.map(f64::from), pad);
        let own = self.surface(stroke.surface).line_color;
        parts
            .iter()
            .flat_map(|(points, closed)| {
                if dashed || points.iter().all(|point| point.color.is_none()) {
                    return Vec::from_iter(self.ink(stroke, (points, *closed), hidden));
                }
                let pieces = color_runs::pieces(points, *closed, own);
                let marks = pieces.iter();
                marks
                    .filter_map(|piece| self.piece(stroke, piece, hidden))
                    .collect()
            })
            .map(|mark| (stroke.surface, mark))
            .collect()
    }

    /// How far the sides of ink may be from their place.
    fn side_tolerance(&self) -> f64 {
        0.5 * self.options.tolerance_px
    }

    /// The mark of a stroke, or of a part in one colour: a line where its width is even, else the outline of its ink.
    fn ink(&self, stroke: &Stroke, way: Way<'_>, hidden: bool) -> Option<Mark> {
        let (points, closed) = way;
        let dashed = hidden && self.options.hidden == Hidden::Dashed;
        let is_even = widest(points) * (1.0 - EVEN) <= narrowest(points);
        if dashed || is_even {
            return self.line(stroke, way, hidden);
        }
        let tolerance = self.side_tolerance();
        let path = outline(points, closed, tolerance);
        self.mark(stroke, path, Paint::Ink, hidden, color_runs::mean(points))
    }

    /// The mark of a piece of a stroke that changes colour.
    fn piece(&self, stroke: &Stroke, piece: &color_runs::Piece, hidden: bool) -> Option<Mark> {
        let translucent = hidden || piece.color[3] < 255;
        if translucent && piece.goes_on != [false; 2] {
            let path = piece.outline(self.side_tolerance(), true);
            return self.mark(stroke, path, Paint::Ink, hidden, Some(piece.color));
        }
        let mark = self.ink(stroke, (&piece.points, piece.closed), hidden)?;
        let color = self.shown(piece.color, hidden);
        Some(Mark { color, ..mark })
    }

    /// Marks of strokes of a layer as pen lines, in a good order object by object.
    fn plotted(&self, strokes: &[&Stroke], hidden: bool) -> Vec<(u32, Mark)> {
        // Cut strokes to the picture.
        let parts: Vec<(&Stroke, Vec<StrokePoint>, bool)> = strokes
            .iter()
            .flat_map(|stroke| {
                clip_stroke(stroke, self.drawing.size.map(f64::from), 0.0)
                    .into_iter()
                    .map(|(points, closed)| (*stroke, points, closed))
            })
            .collect();

        // Order them so that the pen travels little between them, object by object.
        let routes: Vec<plot::Route> = parts
            .iter()
            .map(|(_, points, closed)| plot::Route {
                points: points.iter().map(|p| p.position).collect(),
                closed: *closed,
            })
            .collect();
        let objects: Vec<u32> = parts
            .iter()
            .map(|(stroke, ..)| self.surface(stroke.surface).object_number)
            .collect();

        // Draw them in that order and direction.
        plot::order_in_groups(&routes, &objects)
            .par_iter()
            .filter_map(|visit| {
                let (stroke, points, closed) = &parts[visit.route];
                let points = visit.walk(points);
                let line = self.line(stroke, (&points, *closed), hidden)?;
                Some((stroke.surface, line))
            })
            .collect()
    }

    /// A stroke as a line of its mean width.
    fn line(&self, stroke: &Stroke, way: Way<'_>, hidden: bool) -> Option<Mark> {
        let (points, closed) = way;
        let positions: Vec<[f64; 2]> = points.iter().map(|p| p.position).collect();
        let options = FitOptions {
            tolerance: self.options.tolerance_px,
            ..FitOptions::default()
        };
        let path = fit(&positions, closed, &options);
        let sum: f64 = points.iter().map(width_of).sum();
        let width = (sum / points.len() as f64).max(HAIRLINE_PX) * self.placing.scale;
        let paint = if hidden && self.options.hidden == Hidden::Dashed {
            Paint::Dashes(width)
        } else {
            Paint::Line(width)
        };
        self.mark(stroke, path, paint, hidden, color_runs::mean(points))
    }

    /// The colour that a line shows: half transparent if it is hidden.
    fn shown(&self, [r, g, b, a]: [u8; 4], hidden: bool) -> [u8; 4] {
        [r, g, b, if hidden { a / 2 } else { a }]
    }

    /// A mark of a stroke, in the colour of its surface unless it has one of its own.
    fn mark(
        &self,
        stroke: &Stroke,
        path: BezPath,
        paint: Paint,
        hidden: bool,
        color: Option<[u8; 4]>,
    ) -> Option<Mark> {
        let own = self.surface(stroke.surface).line_color;
        let color = self.shown(color.unwrap_or(own), hidden);
        (!path.is_empty()).then(|| Mark {
            stroke: Some(stroke.id),
            path: self.placing.affine() * path,
            paint,
            color,
        })
    }

    /// The layer of words, each a group.
    fn lettering(&self) -> Layer {
        let words = self.options.lettering.iter().enumerate();
        let groups = words.map(|(number, words)| Group {
            object: number as u32,
            label: words.text.clone(),
            marks: self.lettered(&words.marks),
        });
        Layer {
            name: "lettering".into(),
            groups: groups.filter(|group| !group.marks.is_empty()).collect(),
        }
    }

    /// Marks of words in the artwork's unit; around the letters only, for pens.
    fn lettered(&self, marks: &[Mark]) -> Vec<Mark> {
        let scale = self.placing.scale;
        let drawn = match (self.options.paths, marks) {
            (Paths::Centreline, [.., rim, _] | [rim]) => vec![Mark {
                paint: Paint::Line(PEN_PX),
                ..rim.clone()
            }],
            _ => marks.to_vec(),
        };
        let placed = drawn.into_iter().map(|mark| Mark {
            path: self.placing.affine() * mark.path,
            paint: match mark.paint {
                Paint::Line(width) => Paint::Line(width * scale),
                paint => paint,
            },
            ..mark
        });
        placed.collect()
    }

    /// Groups marks by object: all of an object together, or only those next to each other.
    fn group(&self, marks: Vec<(u32, Mark)>, all: bool) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        let mut known = std::collections::BTreeMap::new();
        for (surface, mark) in marks {
            let surface = self.surface(surface);
            let object = surface.object_number;

            // Find the group of the same object, anywhere or only right below.
            let place = if all {
                known.get(&object).copied()
            } else {
                groups
                    .len()
                    .checked_sub(1)
                    .filter(|i| groups[*i].object == object)
            };

            // Add the mark to it, or open a new one.
            match place {
                Some(i) => groups[i].marks.push(mark),
                None => {
                    known.insert(object, groups.len());
                    groups.push(Group {
                        object,
                        label: surface.object.clone(),
                        marks: vec![mark],
                    });
                }
            }
        }
        groups
    }
}

fn width_of(point: &StrokePoint) -> f64 {
    if point.width.is_finite() {
        point.width.clamp(0.0, 1e5)
    } else {
        0.0
    }
}

fn widest(points: &[StrokePoint]) -> f64 {
    points.iter().map(width_of).fold(0.0, f64::max)
}

fn narrowest(points: &[StrokePoint]) -> f64 {
    points.iter().map(width_of).fold(f64::INFINITY, f64::min)
}
