//! Strokes: visible or hidden runs of lines, ready to be drawn or written.

pub use npr_core::line_kind::Kind;

use crate::surface_location::SurfaceLocation;

/// One point of a stroke.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct StrokePoint {
    /// Place in the picture, in pixels from its top left corner, y down.
    pub position: [f64; 2],
    /// Distance from the eye along the view axis, in scene units.
    pub depth: f64,
    /// Whole width of the line here, in pixels.
    pub width: f64,
    /// Texture coordinate along the stroke, in pixels.
    pub u: f64,
    /// Place in the world.
    pub world: [f32; 3],
    /// What of the shape it lies on: the edge or face that its line has here, before any smoothing.
    pub location: SurfaceLocation,
    /// Colour of the line here, sRGB bytes and alpha, where it is more than that of its surface.
    pub color: Option<[u8; 4]>,
}

/// A run of one line with one kind, one object and one visibility.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Stays with the stroke from frame to frame: it hangs on a mesh edge, not on a place in a list.
    pub id: u64,
    /// What the line is on the shape.
    pub kind: Kind,
    /// Number of surfaces in front of it; 0 where it is visible.
    pub occluders: u32,
    /// Index into [`Drawing::surfaces`].
    pub surface: u32,
    /// The last point runs on to the first, which is not repeated.
    pub closed: bool,
    /// Which part of its line it is, where the line goes on behind something; `None` where the stroke is all of it.
    pub part: Option<LinePart>,
    /// At least two, or three of a closed stroke; neighbours differ.
    pub points: Vec<StrokePoint>,
}

/// The part of a line that a stroke is, where something hides what lies between its parts.
///
/// The line is one stroke of a pen: its parts share the chance that textures, sways and stamps are made of, textures
/// run on behind what hides the line, and the pen is pressed as along the whole of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePart {
    /// Identity of the line: that of one of its strokes.
    pub line: u64,
    /// Pixels from the start of the line to the first point of the stroke and to its last one, along the line and
    /// behind what hides it. The second is less than the first where the stroke runs against the line.
    pub ends_px: [f64; 2],
    /// Length of the whole line in the picture, from its first seen point to its last, in pixels.
    pub length_px: f64,
}

impl LinePart {
    /// Whether it lies on its line, and all of it is finite.
    pub fn is_sound(&self) -> bool {
        let is_on = |px: f64| (0.0..=self.length_px).contains(&px);
        self.length_px.is_finite() && self.length_px > 0.0 && self.ends_px.map(is_on) == [true; 2]
    }

    /// The same of the stroke travelled the other way.
    pub(crate) fn reversed(self) -> Self {
        let [start, end] = self.ends_px;
        Self {
            ends_px: [end, start],
            ..self
        }
    }

    /// The same of a line that runs the other way.
    pub(crate) fn of_reversed_line(self) -> Self {
        Self {
            ends_px: self.ends_px.map(|px| self.length_px - px),
            ..self
        }
    }

    /// Whether the stroke runs against the line.
    pub(crate) fn is_against(&self) -> bool {
        self.ends_px[1] < self.ends_px[0]
    }

    /// The same of a stroke that has lost some pixels at its start and at its end.
    pub fn shortened(self, by_px: [f64; 2]) -> Self {
        let [start, end] = self.ends_px;
        let along = if self.is_against() { -1.0 } else { 1.0 };
        Self {
            ends_px: [start + along * by_px[0], end - along * by_px[1]],
            ..self
        }
    }

    /// The same line, of which the stroke is a part that is drawn as if it were all of it.
    pub fn alone(self, length_px: f64) -> Self {
        Self {
            ends_px: [0.0, length_px],
            length_px,
            ..self
        }
    }

    /// Share of the line that lies before the place at a share of the stroke, 0..1.
    pub fn share_at(&self, share: f64) -> f64 {
        let [start, end] = self.ends_px;
        (start + (end - start) * share) / self.length_px
    }
}

impl Stroke {
    /// Identity of the line that it is, or is a part of.
    pub fn line(&self) -> u64 {
        self.part.map_or(self.id, |part| part.line)
    }

    /// Whether nothing lies in front of it.
    pub fn is_visible(&self) -> bool {
        self.occluders == 0
    }

    /// Length in the picture, in pixels.
    pub fn length(&self) -> f64 {
        length_of(&self.points, self.closed)
    }
}

/// Length in the picture, in pixels, of a way through points, and back to the first where it is closed.
pub fn length_of(points: &[StrokePoint], closed: bool) -> f64 {
    let open: f64 = points
        .windows(2)
        .map(|pair| distance(&pair[0], &pair[1]))
        .sum();
    match (closed, points.first(), points.last()) {
        (true, Some(first), Some(last)) => open + distance(last, first),
        _ => open,
    }
}

fn distance(a: &StrokePoint, b: &StrokePoint) -> f64 {
    let [dx, dy] = [0, 1].map(|i| b.position[i] - a.position[i]);
    (dx * dx + dy * dy).sqrt()
}

/// The object and material that a stroke lies on, and how its lines look.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StrokeSurface {
    /// Name of the object; any text.
    pub object: String,
    /// Number of the object: names may repeat.
    pub object_number: u32,
    /// Name of the material; any text.
    pub material: String,
    /// Colour of its lines, sRGB bytes and alpha.
    pub line_color: [u8; 4],
    /// Colour of its fill, sRGB bytes and alpha.
    pub fill_color: [u8; 4],
}

/// A closed region of flat colour.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Region {
    /// Index into [`Drawing::surfaces`].
    pub surface: u32,
    /// Outer ring first, then holes; each is closed without repeating its first point. Pixels.
    pub rings: Vec<Vec<[f64; 2]>>,
}

/// A picture as lines.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Drawing {
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// What strokes and regions lie on.
    pub surfaces: Vec<StrokeSurface>,
    /// All strokes; visible and hidden ones.
    pub strokes: Vec<Stroke>,
    /// Flat colour under the lines; empty unless asked for.
    pub regions: Vec<Region>,
    /// What of the lines is left out, a sentence each, for the user; files do not hold it.
    pub notices: Vec<String>,
}

impl Drawing {
    /// The same drawing as that of a picture `by` times as large, in its pixels.
    pub fn scaled(mut self, by: f64) -> Self {
        self.size = self.size.map(|side| (f64::from(side) * by).round() as u32);
        for stroke in &mut self.strokes {
            stroke.part = stroke.part.map(|part| LinePart {
                ends_px: part.ends_px.map(|px| px * by),
                length_px: part.length_px * by,
                ..part
            });
        }
        for point in self
            .strokes
            .iter_mut()
            .flat_map(|stroke| &mut stroke.points)
        {
            point.position = point.position.map(|at| at * by);
            point.width *= by;
            point.u *= by;
        }
        let rings = self.regions.iter_mut().flat_map(|region| &mut region.rings);
        for place in rings.flatten() {
            *place = place.map(|at| at * by);
        }
        self
    }
}
