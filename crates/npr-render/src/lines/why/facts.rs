//! What is told of a line, a sentence each.

use super::{Fact, PointedPart, WidthStep};
use crate::error::RenderError;
use crate::lines::model::LineModel;
use crate::lines::options::LineOptions;
use crate::look;
use npr_core::crease::CreaseFrom;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::Part;
use npr_core::line_kind::Kind;
use npr_core::math;
use npr_core::outline::Outline;
use npr_stylesheet::{BackgroundMethod, Color, Decided, PartNames, Style};
use npr_vector::project::Projector;
use npr_vector::stroke::{Stroke, StrokePoint};

/// Share of a width under which a step has not changed it: widths are written with three digits.
const SAME: f64 = 0.005;

/// A line at a point of it, with what it was drawn by.
pub(super) struct Facts<'a> {
    pub model: &'a LineModel,
    pub projector: &'a Projector,
    pub style: &'a Style,
    pub options: &'a LineOptions,
    pub stroke: &'a Stroke,
    pub point: &'a StrokePoint,
    /// Colour of the line there, sRGB bytes and alpha.
    pub color: [u8; 4],
    /// Width in pixels after each step.
    pub widths: Vec<(WidthStep, f64)>,
}

impl Facts<'_> {
    /// All of them, in the order in which they are read.
    pub fn all(&self, part: &PointedPart) -> Result<Vec<Fact>, RenderError> {
        let mut facts = vec![
            self.kind(),
            plain("Origin", self.origin()),
            plain("Part", name_of(part)),
            plain("Visibility", self.visibility()?),
        ];
        facts.extend(self.stays_as());
        facts.extend(self.width());
        facts.extend(self.colors());
        Ok(facts)
    }

    fn kind(&self) -> Fact {
        let kind = self.stroke.kind;
        let meaning = kind.meaning().trim_end_matches('.').to_lowercase();
        Fact {
            name: "Kind".to_owned(),
            text: format!("{}: {meaning}", kind.name()),
            key: (kind != Kind::Marked).then(|| format!("line.kinds.{}", kind.name())),
        }
    }

    /// The names of the part, as rules match them.
    fn names(&self) -> PartNames<'_> {
        let info = self.model.parts.get(self.stroke.surface as usize);
        info.map_or_else(PartNames::default, |info| info.names())
    }

    /// The edge that it runs along; `None` where it lies across a face or on no shape.
    fn edge(&self) -> Option<u32> {
        let location = self.point.location;
        let is_edge = !location.is_nowhere() && location.crossed_face().is_none();
        is_edge.then_some(location.edge)
    }

    fn decided(&self, key: &str) -> Decided {
        self.style.decided(self.names(), key)
    }

    /// What made the line: the edge or face that it runs along or across, and why that is a line.
    fn origin(&self) -> String {
        let (shape, location) = (&self.model.shape, self.point.location);
        if location.is_nowhere() {
            return "found on the pixels of a picture, on no edge of the shape".to_owned();
        }
        if let Some(face) = location.crossed_face() {
            return match self.stroke.kind {
                Kind::Intersection => format!("another surface cuts through face {face}"),
                Kind::Contour => format!("the surface turns away from the eye within face {face}"),
                _ => format!("a line across face {face}"),
            };
        }

        // Say what is special about the edge.
        let edge = location.edge;
        let ends = shape.ends(edge);
        if shape.polyline_of(edge).is_some() {
            return match shape.cards.point(ends[0]) {
                Some(_) => "the middle of a card, as line.cards asks".to_owned(),
                None => "a line of the file itself".to_owned(),
            };
        }
        let sides = shape.sides(edge).len();
        let why = match self.stroke.kind {
            Kind::Contour if sides == 1 => "its one face is seen from the side".to_owned(),
            Kind::Contour => "one face is turned to the eye, the other away".to_owned(),
            Kind::Boundary => "it has one face, where the surface ends".to_owned(),
            Kind::Crease => self.fold(edge).unwrap_or_else(|| {
                "narrow rounding between flat sides, as line.crease_round asks".to_owned()
            }),
            Kind::Material => "its faces are of two materials".to_owned(),
            Kind::Intersection => "another surface cuts through it".to_owned(),
            Kind::Marked if shape.edge_traits[edge as usize].contains(EdgeFlags::MARKED) => {
                "the file asks for a line here".to_owned()
            }
            Kind::Marked => "painted, or left by motion".to_owned(),
        };
        format!(
            "edge {edge}, between vertices {} and {}: {why}",
            ends[0], ends[1]
        )
    }

    /// Why an edge is a crease; `None` where its own fold is no reason.
    fn fold(&self, edge: u32) -> Option<String> {
        // Compare its angles as those do who find creases.
        let (shape, line) = (&self.model.shape, &self.style.line);
        let creases = self.options.creases(self.model.radius());
        let [folds, faces] = [
            shape.fold_cos(edge, creases.from),
            shape.dihedral_cos[edge as usize],
        ];
        let degrees = |cos: f32| math::acos(cos.clamp(-1.0, 1.0)).to_degrees();
        let of = match creases.from {
            CreaseFrom::Normals => "its normals turn",
            CreaseFrom::Faces => "its faces turn",
        };
        if shape.edge_traits[edge as usize].contains(EdgeFlags::NON_MANIFOLD) {
            return Some("three or more faces meet in it".to_owned());
        }
        if folds < creases.cos {
            let least = self.options.crease.to_degrees();
            return Some(format!(
                "{of} by {:.0}°, and line.crease_angle_deg is {least:.0}",
                degrees(folds)
            ));
        }
        if creases.from == CreaseFrom::Normals && faces < creases.hard_cos {
            return Some(format!(
                "its faces turn by {:.0}°, and line.crease_hard_deg is {:.0}",
                degrees(faces),
                line.crease_hard_deg
            ));
        }
        (folds < creases.weak_cos).then(|| {
            format!(
                "a crease goes on along it: {of} by {:.0}°, and line.crease_slack_deg allows {:.0} less than an angle",
                degrees(folds),
                line.crease_slack_deg
            )
        })
    }

    /// The other kinds that its edge has: as those the line stays where its own kind is not drawn.
    fn stays_as(&self) -> Option<Fact> {
        // Gather the kinds of the edge.
        let shape = &self.model.shape;
        let edge = self
            .edge()
            .filter(|edge| shape.polyline_of(*edge).is_none())?;
        let traits = shape.edge_traits[edge as usize];
        let is_of = |kind: Kind| match kind {
            Kind::Crease => self.fold(edge).is_some(),
            _ => EdgeFlags(kind.bit()).is_in(traits.0),
        };
        let others = self.options.kinds.kinds();
        let others = others.filter(|kind| *kind != self.stroke.kind && is_of(*kind));
        let names: Vec<&str> = others.map(Kind::name).collect();
        (!names.is_empty()).then(|| {
            let text = format!(
                "its edge is of kind {} too, and stays as that",
                names.join(", ")
            );
            plain("Beside", text)
        })
    }

    fn visibility(&self) -> Result<String, RenderError> {
        if self.stroke.is_visible() {
            return Ok("seen: nothing lies in front of it".to_owned());
        }

        // Name the surface that is nearest to the eye there.
        let prepared = self.model.prepared(self.options)?;
        let shape = &self.model.shape;
        let place = self.point.position;
        let face = prepared.tree.face_at(shape, self.projector, place);
        let before = face.map(|(face, _)| {
            let surface = shape.face_surfaces[face as usize] as usize;
            self.model.parts[surface].object_name.clone()
        });
        let count = self.stroke.occluders;
        let surfaces = if count == 1 { "surface" } else { "surfaces" };
        Ok(match before {
            Some(object) => format!("hidden by {count} {surfaces}, first by '{object}'"),
            None => format!("hidden by {count} {surfaces}"),
        })
    }

    /// Its width, and every factor of it that is not 1.
    fn width(&self) -> Vec<Fact> {
        // Say how wide it is, and how wide it would be at factor 1.
        let mut facts = vec![plain("Width", format!("{} px", short(self.point.width)))];
        let base = self.decided("line.width.base");
        let mut before = self.base_px();
        let of_card = self.is_of_card();
        facts.push(match of_card {
            true => plain("", "as wide as its card looks".to_owned()),
            false => fact("", format!("{} px: the base width", short(before)), base),
        });
        if of_card {
            before = self.widths.first().map_or(before, |(_, width)| *width);
        }

        // Say what each step multiplied it by.
        for (step, width) in &self.widths {
            let factor = width / before.max(1e-9);
            if (factor - 1.0).abs() > SAME {
                let (text, key) = self.step(*step);
                facts.push(Fact {
                    name: String::new(),
                    text: format!("× {}: {text}", short(factor)),
                    key: Some(key),
                });
            }
            before = *width;
        }
        let last = self.point.width / before.max(1e-9);
        if (last - 1.0).abs() > SAME {
            let text = format!("× {}: the hand that draws it, and dashes", short(last));
            facts.push(fact("", text, self.decided("line.hand")));
        }
        facts
    }

    fn is_of_card(&self) -> bool {
        let shape = &self.model.shape;
        let of_card = |edge| shape.cards.point(shape.ends(edge)[0]).is_some();
        self.edge().is_some_and(of_card)
    }

    /// Width in pixels of a line at factor 1.
    fn base_px(&self) -> f64 {
        let size = self.options.size;
        let radius = self.model.radius();
        let outline = look::outline(self.style, radius, size[1], self.options.dpi, 0);
        let base = f64::from(outline.base_width);
        match outline.flags & Outline::WORLD_WIDTH {
            0 => base,
            _ => base * self.projector.pixels_per_unit(self.point.depth),
        }
    }

    /// What a step is, and the key that decides it.
    fn step(&self, step: WidthStep) -> (String, String) {
        let source = self.decided("line.width.source");
        let is_lit = self.style.line_paint_flags() & Part::LINE_WIDTH != 0;
        let (text, key) = match step {
            WidthStep::Source if is_lit => (
                format!(
                    "by {}, between line.width.min and max, and light",
                    source.value
                ),
                source.key,
            ),
            WidthStep::Source => (
                format!("by {}, between line.width.min and max", source.value),
                source.key,
            ),
            WidthStep::Part => (
                "the part's own factor".to_owned(),
                self.decided("line.width_factor").key,
            ),
            WidthStep::Motion => ("how fast it moves".to_owned(), "motion.swell".to_owned()),
            WidthStep::Pressure => {
                let along = self.decided("line.width.pressure");
                let over_depth = !self.style.line.width.depth.curve.is_empty();
                match over_depth && along.value.is_empty() {
                    true => ("over depth".to_owned(), "line.width.depth.curve".to_owned()),
                    false => ("pressure along the stroke".to_owned(), along.key),
                }
            }
            WidthStep::Room => (
                "room for the line beside it".to_owned(),
                "line.width.room".to_owned(),
            ),
            WidthStep::Taper => (
                "it thins out towards its end".to_owned(),
                self.decided("line.width.taper").key,
            ),
        };
        (text, key)
    }

    /// Its colour, and every key that has a part in it.
    fn colors(&self) -> Vec<Fact> {
        // Name what gives the colour itself.
        let [r, g, b, a] = self.color;
        let text = Color { r, g, b, a }.to_string();
        let Some(info) = self.model.parts.get(self.stroke.surface as usize) else {
            return vec![plain("Colour", text)];
        };
        let look = info.look(self.style);
        let flags = look.line_paint.flags();
        let kind = self.stroke.kind;
        let source = match (
            flags & Part::LINE_KINDS & kind.bit() != 0,
            flags & Part::LINE_SOURCES,
        ) {
            (true, _) => format!("line.paint.kinds.{}", kind.name()),
            (false, 0) => "line.color".to_owned(),
            (false, _) => "line.paint.source".to_owned(),
        };
        let decided = self.decided(&source);
        let mut facts = vec![fact(
            "Colour",
            format!("{text}, from {}", decided.value),
            decided,
        )];

        // Name what is laid over it.
        let is_faint = self.style.line.opacity < 1.0;
        let minds = look.line_background.method != BackgroundMethod::Off;
        for (acts, key, text) in [
            (
                flags & Part::LINE_LIGHT != 0,
                "line.paint.light.ramp",
                "light lies over it",
            ),
            (
                flags & Part::LINE_OPACITY != 0,
                "line.paint.light.opacity",
                "light makes it fainter",
            ),
            (
                flags & Part::LINE_RIM != 0,
                "line.paint.light.rim",
                "the light behind colours it",
            ),
            (
                flags & Part::LINE_DEPTH != 0,
                "line.paint.depth.ramp",
                "depth lies over it",
            ),
            (
                flags & Part::LINE_TINT != 0,
                "line.paint.tint",
                "a tint lies over it",
            ),
            (is_faint, "line.opacity", "the ink covers in part"),
            (
                minds,
                "line.background.method",
                "it minds what lies behind it",
            ),
        ] {
            if acts {
                facts.push(fact("", text.to_owned(), self.decided(key)));
            }
        }
        facts
    }
}

/// A fact that no key decides.
fn plain(name: &str, text: String) -> Fact {
    Fact {
        name: name.to_owned(),
        text,
        key: None,
    }
}

fn fact(name: &str, text: String, decided: Decided) -> Fact {
    Fact {
        key: Some(decided.key),
        ..plain(name, text)
    }
}

/// The names of a part in one line.
fn name_of(part: &PointedPart) -> String {
    match part.material.as_str() {
        "" => format!("object '{}'", part.object),
        material => format!("object '{}', material '{material}'", part.object),
    }
}

/// A number with three digits at most.
fn short(number: f64) -> String {
    match number.abs() {
        n if n >= 100.0 => format!("{number:.0}"),
        n if n >= 10.0 => format!("{number:.1}"),
        _ => format!("{number:.2}"),
    }
}
