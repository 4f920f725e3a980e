//! The lights of a frame: those of the style, those of the file, and the views of those that throw shadows.

use crate::file_light::FileLight;
use crate::options::Picture;
use crate::placement::in_world;
use crate::placement::{Bounds, radius_of};
use crate::sky;
use glam::Vec3;
use npr_core::camera::{Camera, box_corners};
use npr_core::light_view::{Matrix, distant_view, spot_view};
use npr_core::math;
use npr_core::window::View;
use npr_style::lighting::{LIGHTS_MAX, LightSource, Lights};
use npr_style::shadow::{SHADOW_SIDE, SHADOWS_MAX};
use npr_stylesheet::{ExtraLight, LightShape, LightSpace, Style};
use std::collections::BTreeMap;

/// How much nearer to a light something must be to shade a place, in radii of the model.
const BIAS_RADII: f32 = 2e-4;

/// Distance from a spot, in radii of the model, below which things throw no shadow.
const SPOT_NEAR_RADII: f32 = 1e-3;

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
    /// Those of the style's beams, for smoke with a light of its own.
    of_beams: Vec<LightSource>,
}

impl ChosenLights {
    /// First the main light or those of the file, then the style's own and those of its beams. Of too many the
    /// strongest stay, in that order. `pictures` holds that of the sky, if the style names one.
    pub fn new(
        style: &Style,
        of_file: &[FileLight],
        of_beams: Vec<LightSource>,
        pictures: &BTreeMap<String, Picture>,
    ) -> Self {
        let light = &style.light;

        // Start with the file's lights, or with the main light.
        let mut lights = Vec::new();
        if light.file && !of_file.is_empty() {
            lights.extend(of_file.iter().map(|source| Chosen {
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

        // Add the style's own lights and those of its beams.
        let dome = sky::dome(style, pictures);
        let extra = |light| extra(light, dome.is_some());
        lights.extend(light.extra.iter().map(extra));
        lights.extend(of_beams.iter().copied().map(Chosen::unshadowed));
        lights.retain(|light| light.source.intensity > 0.0);

        // Keep the strongest, in the order in which they were added.
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
            of_beams,
        }
    }

    /// The lights of a style's smoke, its own one or these, and whether they are these and throw shadows. Where none of
    /// these does, they throw shadows on smoke alone.
    pub fn of_smoke(&self, style: &Style) -> (Self, bool) {
        if let Some(direction) = style.smoke.light {
            let mut own = style.clone();
            (own.light.direction, own.light.shadow) = (direction, style.smoke.shadow);
            (own.light.file, own.light.extra) = (false, Vec::new());
            let of_beams = self.of_beams.clone();
            return (Self::new(&own, &[], of_beams, &BTreeMap::new()), false);
        }
        let mut lights = self.clone();
        // Points alone throw no shadows on surfaces, so smoke has shadows of its own beside them.
        let are_same = self.shadow_count() > 0;
        for light in &mut lights.lights {
            light.shadow = light.shadow || (style.smoke.shadow && !are_same);
        }
        (lights, are_same)
    }

    /// Whether they are one sun as strong as 1 that throws no shadow: tones follow from its direction alone.
    pub fn is_one_sun(&self) -> bool {
        let [light] = &self.lights[..] else {
            return false;
        };
        light.source.kind == LightSource::DISTANT && light.source.intensity == 1.0 && !light.shadow
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
    /// `bounds` is the box of all that throws shadows. With `smoke`, the box of a frame's smoke, they light smoke:
    /// points throw shadows too, in pictures after those of the other lights, which so keep their numbers.
    pub fn of_frame(
        &self,
        style: &Style,
        bounds: Bounds,
        smoke: Option<Bounds>,
        camera: &Camera,
        view: &View,
    ) -> Lights {
        // Place the lights, and turn those fixed to the camera into the world.
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
                source.direction = in_world(camera, source.direction);
            }
        }

        // Give a view to every light that throws shadows, and to those that throw them on smoke alone.
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

/// The view of a point on a box: all of it from outside, from inside up to 87 degrees from the direction to its middle.
fn point_view(position: [f32; 3], bounds: Bounds) -> Matrix {
    let radius = radius_of(bounds);
    let middle = (Vec3::from(bounds.0) + Vec3::from(bounds.1)) * 0.5;
    let towards = middle - Vec3::from(position);
    let sine = (radius / towards.length().max(radius)).min(1.0);
    let cosine = (1.0 - sine * sine).sqrt();
    let axis = towards.normalize_or(Vec3::NEG_Y).to_array();
    spot_view(position, axis, cosine, radius * SPOT_NEAR_RADII)
}

/// The view of a light: the cone of a spot, or all that throws shadows into the picture of a distant light.
fn light_view(source: &LightSource, bounds: Bounds, camera: &Camera, view: &View) -> Matrix {
    if source.kind == LightSource::SPOT {
        let near = radius_of(bounds) * SPOT_NEAR_RADII;
        return spot_view(source.position, source.direction, source.cone[0], near);
    }
    let casters = box_corners(bounds);
    distant_view(source.direction, &casters, &seen(&casters, camera, view))
}

/// The corners of the part of space that a camera sees between the least and the greatest depth of a box.
fn seen(corners: &[[f32; 3]], camera: &Camera, view: &View) -> Vec<[f32; 3]> {
    let eye = Vec3::from(view.eye_world);
    let forward = Vec3::from(view.forward_world);
    let [right, up, _] = camera.axes().map(Vec3::from);

    // Find the least and the greatest depth of the box.
    let depths = corners
        .iter()
        .map(|corner| (Vec3::from(*corner) - eye).dot(forward));
    let (low, high) = depths.fold((f32::MAX, f32::MIN), |(low, high), depth| {
        (low.min(depth), high.max(depth))
    });

    // Take the corners of the frame at both.
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

    /// A light of a file, of intensity 0..1.
    fn light(kind: u32, intensity: f32) -> FileLight {
        LightSource {
            kind,
            intensity,
            ..LightSource::default()
        }
    }

    fn style(text: &str) -> Style {
        Style::from_toml(text, &|_| Err(String::new())).unwrap()
    }

    #[test]
    fn lights_of_the_file_shine_where_the_style_says_so() {
        let lamp = [light(LightSource::POINT, 1.0)];
        let kinds = |text, of_file: &[FileLight]| {
            let chosen = ChosenLights::new(&style(text), of_file, Vec::new(), &BTreeMap::new());
            chosen
                .lights
                .iter()
                .map(|light| light.source.kind)
                .collect::<Vec<_>>()
        };
        assert_eq!(kinds("", &lamp), [LightSource::DISTANT]);
        assert_eq!(kinds("light.file = true", &lamp), [LightSource::POINT]);
        assert_eq!(kinds("light.file = true", &[]), [LightSource::DISTANT]);
        let sky = "light.intensity = 0\n[[light.extra]]\nkind = 'sky'";
        assert_eq!(kinds(sky, &lamp), [LightSource::SKY]);
    }

    #[test]
    fn of_too_many_lights_the_strongest_shine() {
        let many: Vec<FileLight> = (0..500)
            .map(|i| light(LightSource::DISTANT, (1.0 + (i % 100) as f32) / 100.0))
            .collect();
        let style = style("light.file = true\nlight.shadow = true");
        let chosen = ChosenLights::new(&style, &many, Vec::new(), &BTreeMap::new());
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
        let plain = ChosenLights::new(&Style::default(), &many, Vec::new(), &BTreeMap::new());
        assert_eq!(plain.notice(), None);
    }
}
