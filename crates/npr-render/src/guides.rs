//! What strokes on surfaces run along, part by part.

use crate::model::Model;
use glam::Vec3;
use npr_core::camera::Camera;
use npr_core::color::linear_from_byte;
use npr_core::geometry::Vertex;
use npr_core::math;
use npr_mesh::direction_field::{Guide, PartGuide};
use npr_style::lighting::LightSource;
use npr_stylesheet::{Follow, Ink, Mapping, StrokeSpace};

/// Length up to which the direction of a vertex colour counts as none: that of middle grey after rounding to bytes.
const SAYS_NOTHING: f32 = 0.05;

/// Length up to which a unit vector to the light, projected on the picture, gives strokes no direction.
const STRAIGHT_ON: f32 = 1e-3;

/// What decides how strokes run on a part.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Source {
    /// The way its surface bends, across or along limbs.
    HalfEdgeMesh { across: bool },
    /// The style, in the world.
    World([f32; 3]),
    /// The style, in the space of the object.
    Object([f32; 3]),
    /// The file, by a vertex attribute.
    Attribute,
    /// The file, by vertex colours.
    VertexColor,
    /// The limbs of a figure, and the way its surface bends where no limb moves it.
    Limbs,
    /// The strongest light.
    Light,
}

/// What the strokes of one part run along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StrokeGuide {
    source: Source,
    /// Angle in radians between the strokes and that direction.
    pub angle: f32,
    /// Whether the style asks for an attribute or vertex colours that the part lacks.
    pub is_unsaid: bool,
}

impl StrokeGuide {
    /// What a part's ink asks for; `has` says whether its vertices have directions, colours, and limbs.
    fn of(ink: &Ink, has: [bool; 3]) -> Self {
        let across = ink.follow != Follow::Along;
        let source = match (ink.direction, ink.follow) {
            (Some(direction), _) if ink.direction_space == StrokeSpace::Object => {
                Source::Object(direction)
            }
            (Some(direction), _) => Source::World(direction),
            (None, Follow::Light) => Source::Light,
            (None, Follow::Attribute) if has[0] => Source::Attribute,
            (None, Follow::VertexColor) if has[1] => Source::VertexColor,
            (None, Follow::Limbs) if has[2] => Source::Limbs,
            (None, _) => Source::HalfEdgeMesh { across },
        };
        let asks = matches!(ink.follow, Follow::Attribute | Follow::VertexColor);
        Self {
            source,
            angle: ink.hatch.angle_deg.to_radians(),
            is_unsaid: asks && matches!(source, Source::HalfEdgeMesh { .. }),
        }
    }

    /// Whether strokes turn with the light.
    pub fn follows_light(&self) -> bool {
        self.source == Source::Light
    }

    /// The guide as stroke charts take it.
    fn of_chart(&self) -> PartGuide {
        PartGuide {
            guide: match self.source {
                Source::HalfEdgeMesh { across } => Guide::Curvature { across },
                Source::World(direction) => Guide::Along(direction),
                Source::Limbs => Guide::PaintedOrAcross,
                _ => Guide::Painted,
            },
            angle: self.angle,
        }
    }
}

/// What the strokes of every part run along.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Guides {
    pub of_parts: Vec<StrokeGuide>,
}

impl Guides {
    /// What the inks of a model's parts ask for.
    pub fn new(model: &Model, inks: &[Ink]) -> Self {
        let asks = |ink: &Ink| {
            let of_vertices = matches!(
                ink.follow,
                Follow::Attribute | Follow::VertexColor | Follow::Limbs
            );
            of_vertices && ink.mapping != Mapping::Screen
        };
        let mut has = vec![[false; 3]; inks.len()];
        if inks.iter().any(asks) {
            for (i, vertex) in model.vertices.iter().enumerate() {
                // Vertices without triangles may have no part.
                if let Some([attribute, color, limb]) = has.get_mut(vertex.part as usize) {
                    *attribute |= painted(model, i) != Vec3::ZERO;
                    *color |= color_direction(vertex) != Vec3::ZERO;
                    *limb |= model.limbs.direction_at(i) != Vec3::ZERO;
                }
            }
        }
        let guides = inks.iter().zip(has);
        Self {
            of_parts: guides.map(|(ink, has)| StrokeGuide::of(ink, has)).collect(),
        }
    }

    /// The guides that charts take.
    pub fn of_charts(&self) -> Vec<PartGuide> {
        self.of_parts.iter().map(StrokeGuide::of_chart).collect()
    }

    /// A direction in the world at every vertex whose part needs one, zero at others; none at all where no part does.
    /// `positions` are those of the vertices in the world.
    pub fn directions(
        &self,
        model: &Model,
        positions: &[[f32; 3]],
        light: &LightSource,
    ) -> Vec<[f32; 3]> {
        // Leave the list empty where no part needs directions at its vertices.
        let is_painted = |guide: &StrokeGuide| {
            matches!(
                guide.of_chart().guide,
                Guide::Painted | Guide::PaintedOrAcross
            )
        };
        if !self.of_parts.iter().any(is_painted) {
            return Vec::new();
        }

        // Ask the source of every vertex's part, and turn its direction into the world.
        let vertices = model.vertices.iter().zip(&model.influences).enumerate();
        let direction = |(i, (vertex, influence)): (usize, (&Vertex, _))| {
            let guide = self.of_parts.get(vertex.part as usize);
            let own = match guide.map(|guide| guide.source) {
                None | Some(Source::HalfEdgeMesh { .. } | Source::World(_)) => Vec3::ZERO,
                Some(Source::Light) => return light.towards(positions[i]),
                Some(Source::Object(direction)) => Vec3::from(direction),
                Some(Source::Attribute) => painted(model, i),
                Some(Source::Limbs) => model.limbs.direction_at(i),
                Some(Source::VertexColor) => color_direction(vertex),
            };
            model.posed_direction(own, influence).to_array()
        };
        vertices.map(direction).collect()
    }
}

/// The direction that the file has for a vertex; zero where it has none.
fn painted(model: &Model, vertex: usize) -> Vec3 {
    model
        .painted
        .get(vertex)
        .copied()
        .unwrap_or_default()
        .into()
}

/// The direction that a vertex colour stands for; zero where it stands for none.
fn color_direction(vertex: &Vertex) -> Vec3 {
    let [r, g, b, _] = vertex.color.to_le_bytes();
    if [r, g, b] == [255; 3] {
        return Vec3::ZERO;
    }
    let part = |byte: u8| linear_from_byte(byte) * 2.0 - 1.0;
    let direction = Vec3::from([r, g, b].map(part));
    if direction.length() < SAYS_NOTHING {
        Vec3::ZERO
    } else {
        direction
    }
}

/// Cosine and sine of the turn after which strokes on the picture run at `angle` radians to the direction of a light.
///
/// The direction of a light with a place is taken at `middle`. Strokes run upright, turned by `angle`, where a light
/// stands right before or behind the picture.
pub(crate) fn turn_to_light(
    light: &LightSource,
    camera: &Camera,
    middle: [f32; 3],
    angle: f32,
) -> [f32; 2] {
    let [right, up, _] = camera.axes().map(Vec3::from);
    let towards = Vec3::from(light.towards(middle));
    let on_picture = glam::vec2(towards.dot(right), -towards.dot(up));
    let along = if on_picture.length() > STRAIGHT_ON {
        on_picture.normalize()
    } else {
        glam::Vec2::Y
    };
    // Strokes of a tile turned by (c, s) run along (-s, c).
    let (sin, cos) = (math::sin(angle), math::cos(angle));
    [along.y * cos + along.x * sin, along.y * sin - along.x * cos]
}
