//! A bumpy ball of an exact number of triangles.

use glam::{Mat4, Vec3};
use npr_core::math::{cos, sin};
use npr_mesh::testing::{mapped, uv_sphere};
use npr_scene::{Mesh, Node, Part, Scene};

/// Height of the bumps, as a share of the radius: enough for contours before the ball itself.
const BUMP_HEIGHT: f32 = 0.12;

/// A closed ball with bumps, of exactly `triangle_count` triangles, without normals or textures.
///
/// A ball of meridians and parallels comes near the number; faces spread over it are cut into three to reach it.
///
/// # Panics
///
/// When `triangle_count` is odd, which no closed surface has, or below 32.
pub fn bumpy_ball(triangle_count: usize) -> Scene {
    assert!(
        triangle_count.is_multiple_of(2) && triangle_count >= 32,
        "a closed ball has an even number of triangles, here at least 32"
    );
    let bands = (triangle_count as f64 / 4.0).sqrt() as usize;
    let meridians = triangle_count / (2 * bands);
    let ball = mapped(&uv_sphere(meridians as u32, bands as u32 + 1), bumped);
    let mut part = Part {
        positions: ball.positions().to_vec(),
        triangles: ball.triangles().to_vec(),
        ..Part::default()
    };
    cut_faces(&mut part, (triangle_count - 2 * bands * meridians) / 2);
    scene_of(part)
}

/// `count` bumpy balls in a row, each an object of its own, that seen from z cover as much together whatever their
/// number; the row is as wide as a single ball of radius sqrt(`count`) would need, about the origin.
///
/// # Panics
///
/// As [`bumpy_ball`].
pub fn row_of_balls(count: usize, triangle_count: usize) -> Scene {
    let mut scene = bumpy_ball(triangle_count);
    let radius = 1.0 / (count as f32).sqrt();
    let node = scene.nodes[0].clone();
    let places = (0..count).map(|i| 2.3 * radius * (i as f32 - 0.5 * (count as f32 - 1.0)));
    let placed = |(i, x): (usize, f32)| {
        let place =
            Mat4::from_translation(Vec3::new(x, 0.0, 0.0)) * Mat4::from_scale(Vec3::splat(radius));
        Node {
            name: format!("ball {i}"),
            local: place.to_cols_array_2d(),
            world_from_node: place.to_cols_array_2d(),
            ..node.clone()
        }
    };
    scene.nodes = places.enumerate().map(placed).collect();
    scene
}

/// The same row as a single object: what it shows is the same, and what it costs besides its pixels and triangles is
/// that of one.
///
/// # Panics
///
/// As [`bumpy_ball`].
pub fn row_as_one(count: usize, triangle_count: usize) -> Scene {
    let row = row_of_balls(count, triangle_count);
    let mut all = Part::default();
    for node in &row.nodes {
        let place = Mat4::from_cols_array_2d(&node.local);
        let ball = &row.meshes[0].parts[0];
        let first = all.positions.len() as u32;
        let placed = |position: &[f32; 3]| place.transform_point3(Vec3::from(*position)).to_array();
        all.positions.extend(ball.positions.iter().map(placed));
        let moved = |triangle: &[u32; 3]| triangle.map(|corner| first + corner);
        all.triangles.extend(ball.triangles.iter().map(moved));
    }
    scene_of(all)
}

/// A point of the unit ball pushed out or in, with its pole turned from z to y.
fn bumped([x, y, z]: [f32; 3]) -> [f32; 3] {
    let radius = 1.0 + BUMP_HEIGHT * sin(5.0 * x) * cos(4.0 * y) * sin(6.0 * z + 1.0);
    [x * radius, z * radius, -y * radius]
}

/// Cuts `count` faces into three around their middle, spread evenly over the list.
fn cut_faces(part: &mut Part, count: usize) {
    let step = part.triangles.len() / count.max(1);
    for cut in 0..count {
        let [a, b, c] = part.triangles[cut * step];
        let corners = [a, b, c].map(|corner| part.positions[corner as usize]);
        let middle = part.positions.len() as u32;
        part.positions.push(std::array::from_fn(|axis| {
            (corners[0][axis] + corners[1][axis] + corners[2][axis]) / 3.0
        }));
        part.triangles[cut * step] = [a, b, middle];
        part.triangles.extend([[b, c, middle], [c, a, middle]]);
    }
}

/// A scene of one node that holds one part.
fn scene_of(part: Part) -> Scene {
    let mesh = Mesh {
        name: "ball".to_owned(),
        parts: vec![part],
    };
    let node = Node {
        name: "ball".to_owned(),
        mesh: Some(0),
        ..Node::default()
    };
    Scene {
        nodes: vec![node],
        meshes: vec![mesh],
        ..Scene::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Those of [Okuya 2016, tables 1 and 2], in which frames are timed.
    #[test]
    fn the_published_numbers_of_triangles_are_met() {
        for count in [960, 9566, 33200, 66400] {
            let scene = bumpy_ball(count);
            assert_eq!(scene.triangle_count(), count);
            assert_eq!(scene.vertex_count(), count / 2 + 2, "closed");
        }
    }

    proptest! {
        #[test]
        fn the_number_of_triangles_is_the_one_asked_for(half in 16usize..4000) {
            let scene = bumpy_ball(2 * half);
            prop_assert_eq!(scene.triangle_count(), 2 * half);
            // Every edge of a closed surface has two faces: E = 3 F / 2, and V - E + F = 2.
            prop_assert_eq!(scene.vertex_count(), half + 2);
        }

        #[test]
        fn rows_of_balls_do_not_overlap(count in 2usize..12) {
            let scene = row_of_balls(count, 64);
            prop_assert_eq!(scene.nodes.len(), count);
            let radius = 1.0 / (count as f32).sqrt() * (1.0 + BUMP_HEIGHT);
            let one = row_as_one(count, 64);
            prop_assert_eq!((one.nodes.len(), one.triangle_count()), (1, 64 * count));
            let (low, high) = (scene.nodes[0].local[3][0], scene.nodes[count - 1].local[3][0]);
            let ends = one.meshes[0].parts[0].positions.iter().map(|p| p[0]);
            let (least, most) = ends.fold((f32::MAX, f32::MIN), |(a, b), x| (a.min(x), b.max(x)));
            prop_assert!(least < low && low - least < radius && most > high && most - high < radius);
            for pair in scene.nodes.windows(2) {
                let apart = pair[1].local[3][0] - pair[0].local[3][0];
                prop_assert!(apart > 2.0 * radius && pair[0].local[0][0] == pair[1].local[1][1]);
            }
        }
    }
}
