//! The lights of a frame: those of the style, those of the file, and what they see of what throws shadows.

use crate::beam_light::beam_lights;
use crate::look;
use crate::model::Model;
use crate::placement::{Bounds, radius_of};
use crate::renderer::Picture;
use crate::sky;
use glam::{Mat4, Vec3};
use npr_core::camera::{Camera, box_corners};
use npr_core::light_view::{Matrix, distant_view, spot_view};
use npr_core::math;
use npr_core::window::View;
use npr_scene::{LightKind, Scene};
use npr_style::lighting::{LIGHTS_MAX, LightSource, Lights};
use npr_style::shadow::{SHADOW_SIDE, SHADOWS_MAX};
use npr_stylesheet::{ExtraLight, LightShape, LightSpace, Style};
use std::collections::BTreeMap;

/// How much nearer to a light something must be to shade a place, in radii of the model.
const BIAS_RADII: f32 = 2e-4;

/// What is nearer to a spot throws no shadow, in radii of the model.
const SPOT_NEAR_RADII: f32 = 1e-3;

/// Least distance of a light from the middle of a scene that its strength is reckoned with, in radii: one among the
/// things it lights is no stronger for standing right in the middle.
const NEAREST_RADII: f32 = 0.25;

/// A light of the file as the ramp takes it.
pub(crate) type FileLight = LightSource;

/// The lights that nodes of a scene carry, the strongest with intensity 1.
///
/// Files state lux for directional lights and candela for the others. They become comparable as the light that
/// arrives at the middle of the scene: lux as they are, candela over the square of the distance from there, of at
/// least a quarter of the scene's radius. All are then divided by the strongest. What a colour exceeds white by, or
/// lacks, counts to the strength. Black lights are left out. O(nodes).
pub(crate) fn of_scene(scene: &Scene, bounds: Bounds) -> Vec<FileLight> {
    let (min, max) = bounds;
    let middle = (Vec3::from(min) + Vec3::from(max)) * 0.5;
    let nearest = radius_of(bounds) * NEAREST_RADII;
    let mut found: Vec<(f64, LightSource)> = Vec::new();
    for node in &scene.nodes {
        let Some(light) = node.light.and_then(|i| scene.lights.get(i as usize)) else {
            continue;
        };
        let m = Mat4::from_cols_array_2d(&node.world_from_node);
        let position = m.w_axis.truncate();
        let back = m.z_axis.truncate().normalize_or(Vec3::Z);
        let distance = f64::from(position.distance(middle).max(nearest));
        let (kind, direction, cone, square) = match light.kind {
            LightKind::Directional => (LightSource::DISTANT, back, [0.0; 2], 1.0),
            LightKind::Point => (LightSource::POINT, back, [0.0; 2], distance * distance),
            LightKind::Spot { inner, outer } => {
                let cone = [math::cos(outer), math::cos(inner)];
                (LightSource::SPOT, -back, cone, distance * distance)
            }
        };
        let [r, g, b] = light.color;
        let brightest = r.max(g).max(b);
        let strength = f64::from(light.intensity) * f64::from(brightest) / square;
        if strength > 0.0 && position.is_finite() {
            let source = LightSource {
                position: position.to_array(),
                kind,
                direction: direction.to_array(),
                color: light.color.map(|c| c / brightest),
                range: light.range.unwrap_or(0.0),
                cone,
                ..LightSource::default()
            };
            found.push((strength, source));
        }
    }
    let strongest = found
        .iter()
        .map(|(strength, _)| *strength)
        .fold(0.0, f64::max);
    let relative = |(strength, source)| LightSource {
        intensity: (strength / strongest) as f32,
        ..source
    };
    found.into_iter().map(relative).collect()
}

/// A light of a style, before the camera is known.
#[derive(Debug, Clone, Copy)]
struct Chosen {
    source: LightSource,
    shadow: bool,
    /// Its direction is fixed to the camera.
    on_camera: bool,
}

/// The lights that a style asks for on a model, at most [`LIGHTS_MAX`].
#[derive(Debug, Clone)]
pub(crate) struct ChosenLights {
    lights: Vec<Chosen>,
    /// How many were left out.
    dropped: usize,
    /// The picture of the sky, summed up.
    dome: Option<[[f32; 4]; 9]>,
}

impl ChosenLights {
    /// First the main light or those of the file, then the style's own and those of its beams. Of too many the
    /// strongest stay, in that order. `pictures` holds that of the sky, if the style names one.
    pub fn new(style: &Style, model: &Model, pictures: &BTreeMap<String, Picture>) -> Self {
        let light = &style.light;
        let mut lights = Vec::new();
        if light.file && !model.lights.is_empty() {
            lights.extend(model.lights.iter().map(|source| Chosen {
                source: *source,
                shadow: light.shadow,
                on_camera: false,
            }));
        } else {
            lights.push(Chosen {
                source: LightSource {
                    kind: LightSource::DISTANT,
                    direction: light.unit_direction(),
                    intensity: light.intensity,
                    color: rgb(light.color),
                    ..LightSource::default()
                },
                shadow: light.shadow,
                on_camera: light.space == LightSpace::Camera,
            });
        }
        let dome = sky::dome(style, pictures);
        let extra = |light| extra(light, dome.is_some());
        lights.extend(light.extra.iter().map(extra));
        lights.extend(
            beam_lights(style, model)
                .into_iter()
                .map(Chosen::unshadowed),
        );
        lights.retain(|light| light.source.intensity > 0.0);
        let mut order: Vec<usize> = (0..lights.len()).collect();
        order.sort_by(|a, b| {
            let strength = |i: &usize| lights[*i].source.intensity;
            strength(b).total_cmp(&strength(a)).then(a.cmp(b))
        });
        order.truncate(LIGHTS_MAX);
        order.sort_unstable();
        Self {
            dropped: lights.len() - order.len(),
            lights: order.iter().map(|i| lights[*i]).collect(),
            dome,
        }
    }

    /// The lights of a style's smoke, and whether they are these: its own, or these with shadows where none throws any.
    pub fn of_smoke(&self, style: &Style, model: &Model) -> (Self, bool) {
        if let Some(direction) = style.smoke.light {
            let mut own = style.clone();
            (own.light.direction, own.light.shadow) = (direction, style.smoke.shadow);
            (own.light.file, own.light.extra) = (false, Vec::new());
            return (Self::new(&own, model, &BTreeMap::new()), false);
        }
        let mut lights = self.clone();
        // Points alone throw no shadows on surfaces, so smoke has shadows of its own beside them.
        let are_same = self.shadow_count() > 0;
        for light in &mut lights.lights {
            light.shadow = light.shadow || (style.smoke.shadow && !are_same);
        }
        (lights, are_same)
    }

    /// How many of them throw shadows.
    pub fn shadow_count(&self) -> usize {
        let casting = self.lights.iter().filter(|light| light.casts()).count();
        casting.min(SHADOWS_MAX)
    }

    /// How many of them throw shadows of smoke on smoke: those that throw any, then points.
    pub fn smoke_shadow_count(&self) -> usize {
        let casting = self.lights.iter().filter(|light| light.casts_on_smoke());
        casting.count().min(SHADOWS_MAX)
    }

    /// Says that there are more lights than the 16 that a frame takes; `None` where there are not.
    pub fn notice(&self) -> Option<String> {
        let dropped = self.dropped;
        (dropped > 0).then(|| {
            format!("only the {LIGHTS_MAX} strongest lights shine, {dropped} are left out")
        })
    }

    /// The lights of a frame as a camera sees it.
    ///
    /// `bounds` is the box of all that throws shadows. With the box of a frame's smoke they are the lights of that:
    /// points throw shadows there too, in pictures that come after those of the others, so that these keep their
    /// numbers.
    pub fn of_frame(
        &self,
        style: &Style,
        bounds: Bounds,
        smoke: Option<Bounds>,
        camera: &Camera,
        view: &View,
    ) -> Lights {
        let mut lights = Lights {
            count: self.lights.len() as u32,
            shadow_at: style.light.shadow_at,
            bias_world: radius_of(bounds) * BIAS_RADII,
            dome: self.dome.unwrap_or_default(),
            ..Lights::default()
        };
        for (source, light) in lights.sources.iter_mut().zip(&self.lights) {
            *source = light.source;
            if light.on_camera {
                source.direction = look::in_world(camera, source.direction);
            }
        }
        let sources = lights.sources.iter_mut().zip(&self.lights);
        let (first, others): (Vec<_>, Vec<_>) = sources.partition(|(_, light)| light.casts());
        let mut shadow_count = 0;
        for (source, light) in first.into_iter().chain(others) {
            let matrix = match smoke {
                _ if shadow_count == SHADOWS_MAX => break,
                _ if light.casts() => light_view(source, bounds, camera, view),
                Some(smoke) if light.casts_on_smoke() => point_view(source.position, smoke),
                _ => continue,
            };
            lights.shadows[shadow_count] = matrix;
            shadow_count += 1;
            source.shadow = shadow_count as u32;
        }
        if shadow_count > 0 {
            lights.shadow_side = SHADOW_SIDE;
        }
        lights
    }
}

/// The strongest light of a frame, the first of several; light from above where it is dark.
pub(crate) fn strongest(lights: &Lights) -> LightSource {
    let sources = &lights.sources[..lights.count as usize];
    let above = Lights::distant([0.0, 1.0, 0.0]).sources[0];
    let mut sources = sources.iter().copied();
    let first = sources.next().unwrap_or(above);
    sources.fold(first, |most, light| {
        if light.intensity > most.intensity {
            light
        } else {
            most
        }
    })
}

/// A light of the style; `has_dome` says whether the picture of the sky is there.
fn extra(light: &ExtraLight, has_dome: bool) -> Chosen {
    let towards = light.unit_direction();
    let (kind, direction) = match light.kind {
        LightShape::Distant => (LightSource::DISTANT, towards),
        LightShape::Point => (LightSource::POINT, towards),
        LightShape::Spot => (LightSource::SPOT, towards.map(|v| -v)),
        LightShape::Sky => (LightSource::SKY, towards),
    };
    let bit = |bit: u32, when: bool| if when { bit } else { 0 };
    let is_sky = light.kind == LightShape::Sky;
    let ground = rgb(light.ground);
    let strength = ground.iter().fold(0.0f32, |most, part| most.max(*part));
    let cone = [light.outer_deg, light.inner_deg].map(|deg| math::cos(deg.to_radians()));
    Chosen {
        source: LightSource {
            position: light.position,
            kind,
            direction,
            intensity: light.intensity,
            color: rgb(light.color),
            range: light.range,
            cone,
            sky: bit(LightSource::HIDDEN, is_sky && light.shadow)
                | bit(
                    LightSource::PICTURE,
                    is_sky && has_dome && !light.image.is_empty(),
                ),
            ground: ground.map(|part| part / strength.max(1e-6)),
            ground_strength: strength,
            ..LightSource::default()
        },
        shadow: light.shadow,
        on_camera: false,
    }
}

fn rgb(color: npr_stylesheet::Color) -> [f32; 3] {
    let [r, g, b, _] = color.linear();
    [r, g, b]
}

impl Chosen {
    /// A light of the scene without shadows.
    fn unshadowed(source: LightSource) -> Self {
        Self {
            source,
            shadow: false,
            on_camera: false,
        }
    }

    /// Whether it throws shadows: points and skies do not.
    fn casts(&self) -> bool {
        self.shadow && matches!(self.source.kind, LightSource::DISTANT | LightSource::SPOT)
    }

    /// Whether it throws shadows of smoke on smoke: skies do not.
    fn casts_on_smoke(&self) -> bool {
        self.shadow && self.source.kind != LightSource::SKY
    }
}

/// What a point sees of a box: all of it from outside, from inside up to 87 degrees from the direction to its middle.
fn point_view(position: [f32; 3], bounds: Bounds) -> Matrix {
    let radius = radius_of(bounds);
    let middle = (Vec3::from(bounds.0) + Vec3::from(bounds.1)) * 0.5;
    let towards = middle - Vec3::from(position);
    let sine = (radius / towards.length().max(radius)).min(1.0);
    let cosine = (1.0 - sine * sine).sqrt();
    let axis = towards.normalize_or(Vec3::NEG_Y).to_array();
    spot_view(position, axis, cosine, radius * SPOT_NEAR_RADII)
}

/// What a light sees: a spot its cone, a distant light what throws shadows into the picture.
fn light_view(source: &LightSource, bounds: Bounds, camera: &Camera, view: &View) -> Matrix {
    if source.kind == LightSource::SPOT {
        let near = radius_of(bounds) * SPOT_NEAR_RADII;
        return spot_view(source.position, source.direction, source.cone[0], near);
    }
    let casters = box_corners(bounds);
    distant_view(source.direction, &casters, &seen(&casters, camera, view))
}

/// The corners of what a camera sees of a box, nearest to farthest depth.
fn seen(corners: &[[f32; 3]], camera: &Camera, view: &View) -> Vec<[f32; 3]> {
    let eye = Vec3::from(view.eye_world);
    let forward = Vec3::from(view.forward_world);
    let [right, up, _] = camera.axes().map(Vec3::from);
    let depths = corners
        .iter()
        .map(|corner| (Vec3::from(*corner) - eye).dot(forward));
    let (low, high) = depths.fold((f32::MAX, f32::MIN), |(low, high), depth| {
        (low.min(depth), high.max(depth))
    });
    let aspect = view.frame_px[0] / view.frame_px[1];
    let mut points = Vec::new();
    for depth in [low.max(view.near.min(high)), high] {
        let half = view.height_at(depth) * 0.5;
        for [x, y] in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
            let point = eye + forward * depth + right * (x * half * aspect) + up * (y * half);
            points.push(point.to_array());
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_scene::{Light, Node};

    fn scene_of(lights: &[(LightKind, f32, [f32; 3])]) -> Scene {
        let mut scene = Scene::default();
        for (i, (kind, intensity, place)) in lights.iter().enumerate() {
            scene.lights.push(Light {
                name: String::new(),
                kind: *kind,
                color: [1.0, 0.5, 0.0],
                intensity: *intensity,
                range: None,
            });
            let mut node = Node {
                light: Some(i as u32),
                ..Node::default()
            };
            node.world_from_node[3] = [place[0], place[1], place[2], 1.0];
            scene.nodes.push(node);
        }
        scene
    }

    fn intensities(scene: &Scene) -> Vec<f32> {
        let lights = of_scene(scene, ([-1.0; 3], [1.0; 3]));
        lights.iter().map(|light| light.intensity).collect()
    }

    #[test]
    fn lux_and_candela_meet_in_the_middle_of_the_scene() {
        let spot = LightKind::Spot {
            inner: 0.2,
            outer: 0.4,
        };
        let scene = scene_of(&[
            (LightKind::Directional, 4.0, [0.0; 3]),
            (LightKind::Point, 8.0, [0.0, 2.0, 0.0]),
            (spot, 9.0, [3.0, 0.0, 0.0]),
            (LightKind::Point, 0.0, [0.0; 3]),
        ]);
        assert_eq!(intensities(&scene), [1.0, 0.5, 0.25]);
        let lights = of_scene(&scene, ([-1.0; 3], [1.0; 3]));
        assert_eq!(lights[0].direction, [0.0, 0.0, 1.0], "towards the light");
        assert_eq!(lights[2].direction, [0.0, 0.0, -1.0], "along the axis");
        assert_eq!(lights[0].color, [1.0, 0.5, 0.0]);
    }

    #[test]
    fn hostile_strengths_stay_finite() {
        let scene = scene_of(&[
            (LightKind::Point, f32::MAX, [0.0; 3]),
            (LightKind::Directional, 1e-38, [0.0; 3]),
        ]);
        let all = intensities(&scene);
        assert!(all.iter().all(|i| (0.0..=1.0).contains(i)), "{all:?}");
    }

    fn style(text: &str) -> Style {
        Style::from_toml(text, &|_| Err(String::new())).unwrap()
    }

    #[test]
    fn lights_of_the_file_shine_where_the_style_says_so() {
        let scene = scene_of(&[(LightKind::Point, 8.0, [0.0, 2.0, 0.0])]);
        let model = Model::new(&scene).unwrap();
        let bare = Model::new(&Scene::default()).unwrap();
        let kinds = |text, model| {
            let chosen = ChosenLights::new(&style(text), model, &BTreeMap::new());
            chosen
                .lights
                .iter()
                .map(|light| light.source.kind)
                .collect::<Vec<_>>()
        };
        assert_eq!(kinds("", &model), [LightSource::DISTANT]);
        assert_eq!(kinds("light.file = true", &model), [LightSource::POINT]);
        assert_eq!(kinds("light.file = true", &bare), [LightSource::DISTANT]);
        let sky = "light.intensity = 0\n[[light.extra]]\nkind = 'sky'";
        assert_eq!(kinds(sky, &model), [LightSource::SKY]);
    }

    #[test]
    fn of_too_many_lights_the_strongest_shine() {
        let many: Vec<_> = (0..500)
            .map(|i| (LightKind::Directional, 1.0 + (i % 100) as f32, [0.0; 3]))
            .collect();
        let model = Model::new(&scene_of(&many)).unwrap();
        let style = style("light.file = true\nlight.shadow = true");
        let chosen = ChosenLights::new(&style, &model, &BTreeMap::new());
        assert_eq!((chosen.lights.len(), chosen.dropped), (LIGHTS_MAX, 484));
        assert!(
            chosen
                .lights
                .iter()
                .all(|light| light.source.intensity >= 0.97)
        );
        assert_eq!(chosen.shadow_count(), SHADOWS_MAX);
        let reported = chosen.notice().unwrap();
        assert_eq!(
            reported,
            "only the 16 strongest lights shine, 484 are left out"
        );
        let plain = ChosenLights::new(&Style::default(), &model, &BTreeMap::new());
        assert_eq!(plain.notice(), None);
    }
}
