//! The lights that a file brings.

use crate::placement::{Bounds, radius_of};
use glam::{Mat4, Vec3};
use npr_core::math;
use npr_scene::{LightKind, Scene};
use npr_style::lighting::LightSource;

/// Least distance of a light from the middle of a scene, in radii, that its strength is computed with: a light among
/// the things it lights is no stronger for standing right in the middle.
const NEAREST_RADII: f32 = 0.25;

/// A light of the file as the ramp takes it.
pub(crate) type FileLight = LightSource;

/// The lights that nodes of a scene carry, the strongest with intensity 1.
///
/// Files state lux for directional lights and candela for the others. They become comparable as the light that arrives
/// at the middle of the scene: lux as they are, candela over the square of the distance from there, of at least a
/// quarter of the scene's radius. All are then divided by the strongest. A light's colour is divided by its largest
/// channel, which counts to the strength. Black lights are left out. O(nodes).
pub(crate) fn of_scene(scene: &Scene, bounds: Bounds) -> Vec<FileLight> {
    let (min, max) = bounds;
    let middle = (Vec3::from(min) + Vec3::from(max)) * 0.5;
    let nearest = radius_of(bounds) * NEAREST_RADII;
    let mut found: Vec<(f64, LightSource)> = Vec::new();
    for node in &scene.nodes {
        let Some(light) = node.light.and_then(|i| scene.lights.get(i as usize)) else {
            continue;
        };

        // Place the light, and measure how far from the middle it stands.
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

        // Rate it by what arrives at the middle, and keep it unless it is black.
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

    // Divide all strengths by the greatest.
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
}
