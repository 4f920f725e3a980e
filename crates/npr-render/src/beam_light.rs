//! The light that beams and flashes give off.

use crate::model::Model;
use glam::Vec3;
use npr_style::lighting::LightSource;
use npr_stylesheet::Style;
use std::collections::BTreeMap;

/// Share of a beam's light that each of its pieces gives where there are several: between two of them both shine.
const PIECE_SHARE: f32 = 0.5;

/// Most lights along a single beam.
const PIECES_MAX: usize = 4;

/// Point lights in the beams that give light, objects in order: in the middle of a flash, along a laser.
///
/// All triangles of one object in one material are one beam. It is cut across its longest side into pieces about as
/// long as wide, at most [`PIECES_MAX`]; each shines from the mean of its triangles' middles, weighted by area, as far
/// as its radius times the style's reach. O(triangles).
pub(crate) fn beam_lights(style: &Style, model: &Model) -> Vec<LightSource> {
    let mut lights = Vec::new();
    for (part, triangles) in triangles_of_beams(style, model) {
        let info = &model.parts[part];
        let look = info.look(style);
        let Some(beam) = look.beam else { continue };

        // Cut the beam into pieces, each a point light.
        let pieces = pieces_of(&triangles);
        let share = if pieces.len() > 1 { PIECE_SHARE } else { 1.0 };
        let light = |piece: Piece| LightSource {
            position: piece.middle().to_array(),
            kind: LightSource::POINT,
            intensity: beam.light * share,
            color: beam.light_color(),
            range: piece.radius() * beam.light_reach,
            ..LightSource::default()
        };

        // Leave out pieces without an area.
        let lit = pieces.into_iter().filter(Piece::is_lit);
        lights.extend(lit.map(light));
    }
    lights
}

/// Triangles, as corners in the world, of every beam that gives light; the key is the first part of the beam.
fn triangles_of_beams(style: &Style, model: &Model) -> BTreeMap<usize, Vec<[Vec3; 3]>> {
    let gives_light = |part: usize| {
        let info = &model.parts[part];
        let look = info.look(style);
        look.beam.is_some_and(|beam| beam.light > 0.0)
    };

    // Join parts of one object in one material into a beam, named by its first part.
    let mut first_parts: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    let mut beam_of_part = vec![None; model.parts.len()];
    for (part, info) in model
        .parts
        .iter()
        .enumerate()
        .filter(|(i, _)| gives_light(*i))
    {
        let first = first_parts
            .entry((info.object, info.material))
            .or_insert(part);
        beam_of_part[part] = Some(*first);
    }
    let mut triangles: BTreeMap<usize, Vec<[Vec3; 3]>> = BTreeMap::new();
    if first_parts.is_empty() {
        return triangles;
    }

    // Collect the posed triangles of every beam.
    let point = |v: u32| {
        let v = v as usize;
        model.posed_point(&model.vertices[v], &model.influences[v])
    };
    for triangle in &model.triangles {
        if let Some(beam) = beam_of_part[triangle.part as usize] {
            triangles
                .entry(beam)
                .or_default()
                .push(triangle.corners.map(point));
        }
    }
    triangles
}

/// A piece of a beam: its bounding box, and the sums for its middle.
#[derive(Debug, Clone, Copy)]
struct Piece {
    low: Vec3,
    high: Vec3,
    /// Middles of triangles, times their area.
    sum: Vec3,
    area: f32,
}

impl Piece {
    const NOTHING: Self = Self {
        low: Vec3::INFINITY,
        high: Vec3::NEG_INFINITY,
        sum: Vec3::ZERO,
        area: 0.0,
    };

    fn add(&mut self, corners: &[Vec3; 3]) {
        for corner in corners {
            self.low = self.low.min(*corner);
            self.high = self.high.max(*corner);
        }
        let [a, b, c] = *corners;
        let area = (b - a).cross(c - a).length();
        self.sum += (a + b + c) / 3.0 * area;
        self.area += area;
    }

    /// Mean of the triangles' middles, weighted by area.
    fn mean(&self) -> Vec3 {
        self.sum / self.area
    }

    /// Where the piece shines from: the mean, kept within the box, as rounding far from the origin may move it out.
    fn middle(&self) -> Vec3 {
        self.mean().clamp(self.low, self.high)
    }

    /// Half the diagonal of its box.
    fn radius(&self) -> f32 {
        (self.high - self.low).length() * 0.5
    }

    /// Whether the piece has an area, an extent and a finite place.
    fn is_lit(&self) -> bool {
        self.mean().is_finite() && self.radius().is_finite() && self.radius() > 0.0
    }
}

/// A beam cut across its longest side into pieces about as long as wide.
fn pieces_of(triangles: &[[Vec3; 3]]) -> Vec<Piece> {
    let mut whole = Piece::NOTHING;
    triangles.iter().for_each(|corners| whole.add(corners));
    let sides = whole.high - whole.low;
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| sides[*b].total_cmp(&sides[*a]));
    let [long, wide, _] = order;
    // A flat beam has no width to tell; NaN casts to 0.
    let count = ((sides[long] / sides[wide]).round() as usize).clamp(1, PIECES_MAX);
    let mut pieces = vec![Piece::NOTHING; count];
    for corners in triangles {
        let middle = (corners[0] + corners[1] + corners[2])[long] / 3.0;
        let share = (middle - whole.low[long]) / sides[long];
        let piece = ((share * count as f32) as usize).min(count - 1);
        pieces[piece].add(corners);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_scene::{Material, Mesh, Node, Part, Scene};
    use proptest::prelude::*;

    /// A box of triangles between two corners, fine along x.
    fn boxed(low: [f32; 3], high: [f32; 3]) -> Part {
        const STEPS: u32 = 16;
        let mut part = Part {
            material: Some(0),
            ..Part::default()
        };
        for step in 0..=STEPS {
            let x = low[0] + (high[0] - low[0]) * step as f32 / STEPS as f32;
            for [y, z] in [
                [low[1], low[2]],
                [high[1], low[2]],
                [high[1], high[2]],
                [low[1], high[2]],
            ] {
                part.positions.push([x, y, z]);
            }
        }
        for (step, side) in (0..STEPS).flat_map(|step| (0..4).map(move |side| (step, side))) {
            let [a, b] = [4 * step + side, 4 * step + (side + 1) % 4];
            part.triangles.extend([[a, b, b + 4], [a, b + 4, a + 4]]);
        }
        part
    }

    fn scene_of(part: Part) -> Scene {
        Scene {
            nodes: vec![Node {
                mesh: Some(0),
                ..Node::default()
            }],
            meshes: vec![Mesh {
                parts: vec![part],
                ..Mesh::default()
            }],
            materials: vec![Material {
                name: "Beam".to_owned(),
                ..Material::default()
            }],
            ..Scene::default()
        }
    }

    fn lights_of(part: Part, beam: &str) -> Vec<LightSource> {
        let rule = format!("[[rule]]\nmatch.material = 'Beam'\nbeam = {{ {beam} }}");
        let style = Style::from_toml(&rule, &|_| Err(String::new())).unwrap();
        beam_lights(&style, &Model::new(&scene_of(part)).unwrap())
    }

    #[test]
    fn a_flash_shines_from_its_middle_and_a_laser_along_its_length() {
        let flash = lights_of(boxed([1.0; 3], [3.0; 3]), "light = 0.5, light_reach = 2.0");
        assert_eq!(flash.len(), 1);
        assert!(Vec3::from(flash[0].position).distance(Vec3::splat(2.0)) < 1e-4);
        assert_eq!(flash[0].intensity, 0.5);
        assert!((flash[0].range - 2.0 * 3.0f32.sqrt()).abs() < 1e-4);
        let laser = lights_of(boxed([0.0, -0.1, -0.1], [8.0, 0.1, 0.1]), "light = 0.5");
        let places: Vec<f32> = laser.iter().map(|light| light.position[0]).collect();
        assert_eq!(places.len(), 4);
        assert!(laser.iter().all(|light| light.intensity == 0.25));
        for (place, wanted) in places.iter().zip([1.0, 3.0, 5.0, 7.0]) {
            assert!((place - wanted).abs() < 0.05, "{places:?}");
        }
    }

    #[test]
    fn far_from_the_origin_a_light_stays_in_its_beam() {
        let corners = [
            [-6.3321285, 1e18, 0.0],
            [-7.155366, 1e18, 0.0],
            [0.0, 1e18, -0.09734713],
        ];
        let pieces = pieces_of(&[corners.map(Vec3::from)]);
        let lit: Vec<&Piece> = pieces.iter().filter(|piece| piece.is_lit()).collect();
        let [piece] = lit[..] else { panic!("{lit:?}") };
        let middle = piece.middle();
        assert!(middle.cmpge(piece.low).all() && middle.cmple(piece.high).all());
    }

    #[test]
    fn beams_give_no_light_unless_asked() {
        assert!(lights_of(boxed([0.0; 3], [1.0; 3]), "softness = 0.2").is_empty());
        assert!(lights_of(Part::default(), "light = 1.0").is_empty());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn any_triangles_have_sound_lights_inside_their_box(
            values in prop::collection::vec(
                prop::array::uniform3(prop_oneof![-9f32..9.0, Just(0.0), Just(1e18), Just(f32::NAN)]), 3..30,
            ),
        ) {
            let corners = values.chunks_exact(3).map(|c| [c[0], c[1], c[2]].map(Vec3::from));
            let triangles: Vec<[Vec3; 3]> = corners.collect();
            let pieces = pieces_of(&triangles);
            prop_assert!((1..=PIECES_MAX).contains(&pieces.len()));
            for piece in pieces.iter().filter(|piece| piece.is_lit()) {
                let room = Vec3::splat(1e-3 * piece.radius());
                let middle = piece.middle();
                prop_assert!(middle.cmpge(piece.low - room).all() && middle.cmple(piece.high + room).all());
            }
        }
    }
}
