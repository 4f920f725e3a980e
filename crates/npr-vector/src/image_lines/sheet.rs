//! Whether neighbouring pixels show one sheet of a surface.

use glam::DVec2;
use npr_core::geometry::NONE;
use npr_core::surface::apply_point;
use npr_core::window::View;
use npr_mesh::half_edge::HalfEdgeMesh;

/// Most faces between two pixels that are walked over.
const MOST_FACES: usize = 256;

/// Whether two pixels show parts of one sheet: from the face of one to that of the other, faces lie side by side along
/// the way between the pixels' middles, and none is turned away. `None` if that cannot be told.
///
/// Depths could tell only where a surface is not seen at a grazing angle. O(faces between the pixels), up to a limit.
pub fn are_one_sheet(
    shape: &HalfEdgeMesh,
    view: &View,
    middles: [DVec2; 2],
    faces: [u32; 2],
) -> Option<bool> {
    let [mut face, last] = faces;
    let mut corners = projected(shape, view, face)?;
    let side = turn(corners[0], corners[1], corners[2]).signum();
    let mut along = 0.0;
    let mut entry = NONE;
    for _ in 0..MOST_FACES {
        if face == last {
            return Some(true);
        }
        // The side of the face by which the way leaves it.
        let leaving = (0..3).filter(|k| 3 * face + k != entry).filter_map(|k| {
            let [a, b] = [corners[k as usize], corners[(k as usize + 1) % 3]];
            Some((crossing(middles, [a, b])?, 3 * face + k))
        });
        let (at, half_edge) = leaving.max_by(|a, b| a.0.total_cmp(&b.0))?;
        // Where the way ends within a face, it is the last or one beside it, by rounding; or the last one lies before
        // it.
        if at < along || at > 1.0 + 1e-6 {
            let mut twins = (0..3).map(|k| shape.twins[(3 * face + k) as usize]);
            return Some(twins.any(|twin| twin != NONE && twin / 3 == last));
        }
        entry = shape.twins[half_edge as usize];
        if entry == NONE {
            return Some(false);
        }
        (face, along) = (entry / 3, at);
        corners = projected(shape, view, face)?;
        if turn(corners[0], corners[1], corners[2]) * side <= 0.0 {
            return Some(false);
        }
    }
    None
}

/// Places of a face's corners in the picture, in pixels; `None` if one is not before the eye.
fn projected(shape: &HalfEdgeMesh, view: &View, face: u32) -> Option<[DVec2; 3]> {
    let mut places = [DVec2::ZERO; 3];
    for (place, vertex) in places.iter_mut().zip(shape.faces[face as usize]) {
        let [x, y, _, w] =
            apply_point(&view.clip_from_world, shape.positions[vertex as usize]).map(f64::from);
        if w <= 0.0 {
            return None;
        }
        let [width, height] = view.frame_px.map(f64::from);
        *place = DVec2::new((0.5 + 0.5 * x / w) * width, (0.5 - 0.5 * y / w) * height);
    }
    Some(places)
}

/// Where a way from one place to another crosses the line between two corners, as a share of the way; `None` if it
/// passes beside it.
fn crossing([from, to]: [DVec2; 2], [a, b]: [DVec2; 2]) -> Option<f64> {
    let [before, after] = [a, b].map(|corner| turn(from, to, corner));
    if (before > 0.0) == (after > 0.0) {
        return None;
    }
    let place = a.lerp(b, before / (before - after));
    let way = to - from;
    Some((place - from).dot(way) / way.length_squared())
}

/// Twice the signed area of a triangle.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::camera::{Camera, Projection};
    use npr_mesh::testing::{shape_of, torus, uv_sphere};

    const SIZE: [u32; 2] = [90, 60];

    fn view_from(eye: [f32; 3]) -> View {
        let camera = Camera {
            eye,
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 0.6 },
        };
        camera.view(SIZE, ([-2.0; 3], [2.0; 3]))
    }

    /// The nearest face under a place, its depth, and the cosine between its normal and the way to the eye, by trying
    /// all of them.
    fn seen(shape: &HalfEdgeMesh, view: &View, place: DVec2) -> Option<(f64, u32, f64)> {
        let hits = (0..shape.faces.len() as u32).filter_map(|face| {
            let [a, b, c] = projected(shape, view, face)?;
            let shares = [turn(b, c, place), turn(c, a, place), turn(a, b, place)];
            let is_inside =
                shares.iter().all(|share| *share > 0.0) || shares.iter().all(|share| *share < 0.0);
            let points = shape.faces[face as usize].map(|vertex| shape.point(vertex));
            let eye = glam::Vec3::from(view.eye_world).as_dvec3();
            let normal = (points[1] - points[0])
                .cross(points[2] - points[0])
                .normalize();
            let away = points[0] - eye;
            is_inside.then(|| (away.length(), face, -normal.dot(away.normalize())))
        });
        hits.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The middles of neighbouring pixels, and what each shows.
    type Neighbours = ([DVec2; 2], [(f64, u32, f64); 2]);

    /// All neighbouring pixels of a row or column that both show the shape.
    fn pairs(shape: &HalfEdgeMesh, view: &View) -> Vec<Neighbours> {
        let middle = |x: u32, y: u32| DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let [width, height] = SIZE;
        let pixels = (0..height - 1).flat_map(|y| (0..width - 1).map(move |x| (x, y)));
        let neighbours = pixels.flat_map(|(x, y)| {
            [
                [middle(x, y), middle(x + 1, y)],
                [middle(x, y), middle(x, y + 1)],
            ]
        });
        neighbours
            .filter_map(|middles| {
                let [a, b] = middles.map(|place| seen(shape, view, place));
                Some((middles, [a?, b?]))
            })
            .collect()
    }

    #[test]
    fn a_ball_is_one_sheet_up_to_its_rim() {
        let (ball, view) = (shape_of(&uv_sphere(64, 32)), view_from([0.3, 0.5, 4.0]));
        let pairs = pairs(&ball, &view);
        assert!(pairs.len() > 1000);
        for (middles, seen) in pairs {
            let found = are_one_sheet(&ball, &view, middles, seen.map(|seen| seen.1));
            assert_eq!(found, Some(true), "{middles:?}");
        }
    }

    /// Seen from beside, the near side of the ring hides part of the far one.
    #[test]
    fn the_two_sides_of_a_ring_are_two_sheets() {
        let (ring, view) = (
            shape_of(&torus(96, 32, 1.0, 0.3)),
            view_from([3.6, 0.6, 1.0]),
        );
        let [mut one, mut two] = [0, 0];
        for (middles, seen) in pairs(&ring, &view) {
            let found = are_one_sheet(&ring, &view, middles, seen.map(|seen| seen.1));
            let gap = (seen[0].0 - seen[1].0).abs();
            if gap > 0.5 {
                two += 1;
                assert_ne!(found, Some(true), "{middles:?}");
            } else if gap < 0.1 && seen.iter().all(|seen| seen.2.abs() > 0.3) {
                one += 1;
                assert_eq!(found, Some(true), "{middles:?}");
            }
        }
        assert!(one > 500 && two > 10, "{one} {two}");
    }
}
