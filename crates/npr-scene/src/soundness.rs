//! The last step of every load: no number that is not finite leaves it.

use crate::error::SceneError;
use crate::mesh::{Mesh, POSITION_LIMIT, Part, is_sound};
use crate::notice::Notices;
use crate::reach;
use crate::scene::Scene;
use crate::shown::shown;

/// A direction for normals that have none.
const ANY_NORMAL: [f32; 3] = [0.0, 0.0, 1.0];

/// Drops what is not finite, and says so.
///
/// # Errors
///
/// [`SceneError::NothingFinite`] or [`SceneError::NoFiniteLine`] where nothing is left of the triangles and lines
/// that the file has.
pub(crate) fn mend(scene: &mut Scene, notices: &mut Notices) -> Result<(), SceneError> {
    let (triangle_count, segment_count) = (scene.triangle_count(), scene.segment_count());
    for mesh in &mut scene.meshes {
        mend_mesh(mesh, notices);
    }
    let is_empty = scene.triangle_count() == 0 && scene.segment_count() == 0;
    if is_empty && triangle_count > 0 {
        return Err(SceneError::NothingFinite { triangle_count });
    }
    if is_empty && segment_count > 0 {
        return Err(SceneError::NoFiniteLine { segment_count });
    }
    reach::bound(scene, notices);
    Ok(())
}

fn mend_mesh(Mesh { name, parts }: &mut Mesh, notices: &mut Notices) {
    for part in parts {
        // Drop triangles and lines that would be drawn out of range.
        let (triangle_count, segment_count) = drop_unsound_geometry(part);
        for (dropped_count, what) in [
            (triangle_count, "triangles"),
            (segment_count, "line segments"),
        ] {
            if dropped_count > 0 {
                notices.add(format!(
                    "mesh '{}': {dropped_count} {what} with positions that are not finite or out of range are left out",
                    shown(name),
                ));
            }
        }

        // Drop whole lists that hold a number out of range.
        part.morphs.iter_mut().for_each(|morph| {
            drop_unsound(&mut morph.positions, "morph offsets", name, notices);
            drop_unsound(&mut morph.normals, "morph offsets", name, notices);
        });
        drop_unsound(&mut part.normals, "normals", name, notices);
        if let Some(unmorphed) = &mut part.unmorphed {
            drop_unsound(&mut unmorphed.normals, "normals", name, notices);
            if part.normals.is_none() || unmorphed.normals.is_none() {
                (part.normals, unmorphed.normals) = (None, None);
            }
        }
        drop_unsound(&mut part.uvs, "texture coordinates", name, notices);
        drop_unsound(&mut part.colors, "vertex colours", name, notices);
        drop_unsound(&mut part.weights, "joint weights", name, notices);
        drop_unsound(&mut part.directions, "stroke directions", name, notices);

        // Bring what is left into its range.
        if let Some(normals) = &mut part.normals {
            straighten_normals(normals, &part.positions, &part.triangles);
        }
        part.colors
            .iter_mut()
            .flatten()
            .flatten()
            .for_each(|v| *v = v.clamp(0.0, 1.0));
        part.weights
            .iter_mut()
            .flatten()
            .for_each(normalise_weights);
    }
}

/// Removes triangles and line segments that use an unsound position, and zeroes such positions. Returns how many of
/// each.
fn drop_unsound_geometry(part: &mut Part) -> (usize, usize) {
    // Keep a part whose positions are all sound.
    if part.positions.iter().all(is_sound) {
        return (0, 0);
    }

    // Drop what uses an unsound position, then zero it.
    let sound: Vec<bool> = part.positions.iter().map(is_sound).collect();
    let before = (part.triangles.len(), part.segments.len());
    part.triangles
        .retain(|triangle| triangle.iter().all(|&vertex| sound[vertex as usize]));
    part.segments
        .retain(|ends| ends.iter().all(|&vertex| sound[vertex as usize]));
    for (position, sound) in part.positions.iter_mut().zip(sound) {
        if !sound {
            *position = [0.0; 3];
        }
    }
    (
        before.0 - part.triangles.len(),
        before.1 - part.segments.len(),
    )
}

fn drop_unsound<const N: usize>(
    list: &mut Option<Vec<[f32; N]>>,
    what: &str,
    name: &str,
    notices: &mut Notices,
) {
    let is_sound = |row: &[f32; N]| row.iter().all(|v| v.abs() <= POSITION_LIMIT);
    if list.as_ref().is_some_and(|rows| !rows.iter().all(is_sound)) {
        *list = None;
        notices.add(format!(
            "mesh '{}': {what} are not finite and are left out",
            shown(name)
        ));
    }
}

/// Makes normals unit length; a zero normal becomes that of a face that uses it.
pub(crate) fn straighten_normals(
    normals: &mut [[f32; 3]],
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
) {
    let mut has_zero = false;
    for normal in normals.iter_mut() {
        let length_squared = dot(*normal, *normal);
        if (length_squared - 1.0).abs() > 1e-4 {
            *normal = unit(*normal).unwrap_or_default();
            has_zero |= *normal == [0.0; 3];
        }
    }
    if has_zero {
        fill_zero_normals(normals, positions, triangles);
    }
}

fn fill_zero_normals(normals: &mut [[f32; 3]], positions: &[[f32; 3]], triangles: &[[u32; 3]]) {
    for triangle in triangles {
        let corners = triangle.map(|vertex| positions[vertex as usize]);
        for vertex in triangle.map(|vertex| vertex as usize) {
            if normals[vertex] == [0.0; 3] {
                normals[vertex] = face_normal(corners).unwrap_or_default();
            }
        }
    }
    normals
        .iter_mut()
        .filter(|normal| **normal == [0.0; 3])
        .for_each(|normal| *normal = ANY_NORMAL);
}

fn face_normal([a, b, c]: [[f32; 3]; 3]) -> Option<[f32; 3]> {
    let [x, y, z] = unit(minus(b, a))?;
    let [u, v, w] = unit(minus(c, a))?;
    unit([y * w - z * v, z * u - x * w, x * v - y * u])
}

fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `v` at unit length, scaled first so that neither huge nor tiny vectors lose their direction.
fn unit(v: [f32; 3]) -> Option<[f32; 3]> {
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    if largest < f32::MIN_POSITIVE {
        return None;
    }
    let v = v.map(|x| x / largest);
    let length = dot(v, v).sqrt();
    Some(v.map(|x| x / length))
}

/// Makes the four weights sum to one; without any, the first joint gets all.
fn normalise_weights(weights: &mut [f32; 4]) {
    let positive = weights.map(|weight| weight.max(0.0));
    let sum: f32 = positive.iter().sum();
    *weights = if sum > 0.0 {
        positive.map(|weight| weight / sum)
    } else {
        [1.0, 0.0, 0.0, 0.0]
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mended(part: Part) -> (Part, Vec<String>) {
        let mut mesh = Mesh {
            name: "m".to_owned(),
            parts: vec![part],
        };
        let mut notices = Notices::default();
        mend_mesh(&mut mesh, &mut notices);
        mesh.parts[0].sanity_check();
        let texts = notices
            .into_list()
            .into_iter()
            .map(|notice| notice.text)
            .collect();
        (mesh.parts.remove(0), texts)
    }

    fn triangle() -> Part {
        Part {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [f32::NAN; 3]],
            triangles: vec![[0, 1, 2], [0, 1, 3]],
            ..Part::default()
        }
    }

    #[test]
    fn triangles_with_bad_positions_go_and_the_others_stay() {
        let (part, texts) = mended(triangle());
        assert_eq!(part.triangles, [[0, 1, 2]]);
        assert_eq!(texts.len(), 1);
    }

    /// What mending says of a scene of one part.
    fn fault_of(part: Part) -> Result<(), SceneError> {
        let mesh = Mesh {
            name: String::new(),
            parts: vec![part],
        };
        let mut scene = Scene {
            meshes: vec![mesh],
            ..Scene::default()
        };
        mend(&mut scene, &mut Notices::default())
    }

    #[test]
    fn a_scene_of_bad_positions_only_is_refused() {
        let part = Part {
            triangles: vec![[0, 1, 3]],
            ..triangle()
        };
        let result = fault_of(part.clone());
        assert_eq!(result, Err(SceneError::NothingFinite { triangle_count: 1 }));
        let lines = Part {
            triangles: Vec::new(),
            segments: vec![[0, 3], [3, 1]],
            ..part.clone()
        };
        let result = fault_of(lines);
        assert_eq!(result, Err(SceneError::NoFiniteLine { segment_count: 2 }));
        // What is left of either is drawn.
        let both = Part {
            segments: vec![[0, 1]],
            ..part
        };
        assert_eq!(fault_of(both), Ok(()));
    }

    #[test]
    fn lines_with_bad_positions_go_and_the_others_stay() {
        let (part, texts) = mended(Part {
            segments: vec![[0, 1], [1, 3], [3, 3], [2, 0]],
            ..triangle()
        });
        assert_eq!(part.segments, [[0, 1], [2, 0]]);
        assert!(texts[1].contains("2 line segments"), "{texts:?}");
    }

    #[test]
    fn zero_normals_take_that_of_their_face() {
        let normals = Some(vec![[0.0, 0.0, 2.0], [0.0; 3], [1.0, 0.0, 0.0], [0.0; 3]]);
        let (part, _) = mended(Part {
            normals,
            ..triangle()
        });
        let expected = [
            [0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0],
        ];
        assert_eq!(part.normals.as_deref(), Some(&expected[..]));
    }

    #[test]
    fn weights_end_up_summing_to_one() {
        let weights = Some(vec![
            [0.5, 0.5, 0.5, 0.5],
            [0.0; 4],
            [-1.0, 0.25, 0.0, 0.0],
            [1.0, 0.0, 0.0, 0.0],
        ]);
        let (part, _) = mended(Part {
            weights,
            ..triangle()
        });
        let expected = [
            [0.25; 4],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0, 0.0],
        ];
        assert_eq!(part.weights.as_deref(), Some(&expected[..]));
    }

    #[test]
    fn attributes_with_bad_numbers_are_left_out() {
        let uvs = Some(vec![[f32::INFINITY, 0.0]; 4]);
        let (part, texts) = mended(Part { uvs, ..triangle() });
        assert_eq!(part.uvs, None);
        assert!(
            texts
                .iter()
                .any(|text| text.contains("texture coordinates")),
            "{texts:?}"
        );
    }
}
