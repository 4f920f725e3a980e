//! Every edge that may bear a line in a view, whether anything hides it or not.

use glam::DVec3;
use npr_vector::stroke::Kind;

use super::soup::{Soup, SoupEdge};
use super::viewpoint::Viewpoint;

/// What the reference looks for.
#[derive(Debug, Clone, PartialEq)]
pub struct Wanted {
    /// Kinds of lines; intersections and marks are not known here.
    pub kinds: Vec<Kind>,
    /// Angle between the normals of two faces over which their edge is a crease, in radians.
    pub crease: f64,
}

impl Default for Wanted {
    /// Contours, boundaries, and creases over the 45.57 degrees that comparisons between programs are made at.
    fn default() -> Self {
        Self {
            kinds: vec![Kind::Contour, Kind::Boundary, Kind::Crease],
            crease: 45.57f64.to_radians(),
        }
    }
}

/// An edge that may bear a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// Tail and head: a contour has its front face on the left, seen from outside.
    pub ends: [u32; 2],
    /// The half-edge of the front face, where the edge is part of a contour loop.
    pub half_edge: Option<u32>,
    /// What it is.
    pub kind: Kind,
    /// The object that it lies on.
    pub object: u32,
    /// Where it is seen it must be drawn; otherwise it may be.
    ///
    /// Open to choice are contours that lie in a valley and creases seen from behind, which only surfaces that are
    /// open or wound at random show, and edges of three or more faces of which two go on flat.
    pub due: bool,
    /// A point of the surface beside it.
    pub beside: DVec3,
}

/// A view of a soup, with all that its edges are judged by.
pub struct Seen<'a> {
    soup: &'a Soup,
    normals: Vec<DVec3>,
    view: &'a Viewpoint,
    wanted: &'a Wanted,
}

impl<'a> Seen<'a> {
    /// Looks at a soup whose edges are `edges`.
    pub fn new(
        soup: &'a Soup,
        edges: &[SoupEdge],
        view: &'a Viewpoint,
        wanted: &'a Wanted,
    ) -> Self {
        Self {
            soup,
            normals: soup.normals(edges),
            view,
            wanted,
        }
    }

    /// Whether the eye is on the outside of a half-edge's face.
    pub fn is_front(&self, half_edge: u32) -> bool {
        let face = half_edge as usize / 3;
        let corner = self.soup.positions[self.soup.faces[face][0] as usize];
        self.normals[face].dot(self.view.toward_eye(corner)) >= 0.0
    }

    /// The line that an edge may bear.
    pub fn candidate(&self, edge: &SoupEdge) -> Option<Candidate> {
        let found = match edge.sides[..] {
            [side] => Some(self.line(Kind::Boundary, edge, side, true)),
            [a, b] => self.between(edge, [a, b]),
            _ => self.among_many(edge),
        };
        found.filter(|line| self.wanted.kinds.contains(&line.kind))
    }

    fn line(&self, kind: Kind, edge: &SoupEdge, side: u32, due: bool) -> Candidate {
        let points = edge.ends.map(|end| self.soup.positions[end as usize]);
        let beside = |side: u32| self.soup.opposite(side);
        // Of all faces, the corner furthest from the line shows best where the surface is.
        let far = |side: &u32| self.distance_in_picture(points, beside(*side));
        let best = edge.sides.iter().max_by(|a, b| far(a).total_cmp(&far(b)));
        Candidate {
            ends: self.soup.ends_of(side),
            half_edge: None,
            kind,
            object: self.soup.objects[side as usize / 3],
            due,
            beside: beside(*best.unwrap_or(&side)),
        }
    }

    /// How far from a line a point is in the picture; only ever compared.
    fn distance_in_picture(&self, [a, b]: [DVec3; 2], point: DVec3) -> f64 {
        let [a, b, p] = [a, b, point].map(|p| self.view.project(p));
        ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])).abs()
    }

    /// The line between two faces.
    fn between(&self, edge: &SoupEdge, sides: [u32; 2]) -> Option<Candidate> {
        // Take an edge where facing changes for a contour, on the face turned to the eye.
        let alike = self.soup.wound_alike(sides);
        let front = sides.map(|side| self.is_front(side));
        if (front[0] == front[1]) != alike {
            let [face, other] = if front[0] {
                sides
            } else {
                [sides[1], sides[0]]
            };
            let mut line = self.line(Kind::Contour, edge, face, true);
            if alike {
                line.half_edge = Some(face);
                line.due = self.is_ridge(face, other);
            }
            return Some(line);
        }

        // Take others for creases, or for lines between materials.
        let seen_outside = front[0] || front[1];
        let [a, b] = sides.map(|side| side as usize / 3);
        if self.turns(sides) {
            return Some(self.line(Kind::Crease, edge, sides[0], seen_outside));
        }
        let changes = self.soup.materials[a] != self.soup.materials[b];
        changes.then(|| self.line(Kind::Material, edge, sides[0], seen_outside))
    }

    /// Whether the other face falls away behind the plane of the first.
    fn is_ridge(&self, side: u32, other: u32) -> bool {
        let on_edge = self.soup.positions[self.soup.ends_of(side)[0] as usize];
        let beyond = self.soup.opposite(other) - on_edge;
        self.normals[side as usize / 3].dot(beyond) < 0.0
    }

    /// Whether the angle between two faces makes a crease.
    fn turns(&self, sides: [u32; 2]) -> bool {
        let [a, b] = sides.map(|side| self.normals[side as usize / 3]);
        let cosine = a.dot(b);
        let cosine = if self.soup.wound_alike(sides) {
            cosine
        } else {
            -cosine
        };
        cosine < libm::cos(self.wanted.crease)
    }

    /// The line where three or more faces meet: a contour where all lie on one side in the picture, else a crease.
    fn among_many(&self, edge: &SoupEdge) -> Option<Candidate> {
        let sides = &edge.sides;
        let rightwards =
            |side: &u32| (self.soup.ends_of(*side) == edge.ends) == self.is_front(*side);
        if sides
            .iter()
            .all(|side| rightwards(side) == rightwards(&sides[0]))
        {
            return Some(self.line(Kind::Contour, edge, sides[0], true));
        }
        let pairs = sides
            .iter()
            .enumerate()
            .flat_map(|(i, a)| sides[i + 1..].iter().map(move |b| [*a, *b]));
        let due = pairs.into_iter().all(|pair| self.turns(pair));
        Some(self.line(Kind::Crease, edge, sides[0], due))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::camera::{Camera, Projection};
    use npr_mesh::testing::cube;

    fn kinds(soup: &Soup, eye: [f32; 3]) -> Vec<Kind> {
        let camera = Camera {
            eye,
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 0.7 },
        };
        let (edges, wanted) = (soup.edges(), Wanted::default());
        let view = Viewpoint::new(&camera, [200, 200]);
        let seen = Seen::new(soup, &edges, &view, &wanted);
        edges
            .iter()
            .filter_map(|edge| seen.candidate(edge))
            .map(|line| line.kind)
            .collect()
    }

    fn count(kinds: &[Kind], kind: Kind) -> usize {
        kinds.iter().filter(|found| **found == kind).count()
    }

    #[test]
    fn a_cube_from_a_corner_has_six_contours_and_six_creases() {
        let mesh = cube();
        let soup = Soup::of_mesh(mesh.positions(), mesh.triangles());
        let found = kinds(&soup, [3.0, 4.0, 5.0]);
        assert_eq!(
            (count(&found, Kind::Contour), count(&found, Kind::Crease)),
            (6, 6)
        );
    }

    #[test]
    fn faces_wound_at_random_have_the_same_lines() {
        let mesh = cube();
        let mut triangles = mesh.triangles().to_vec();
        triangles.iter_mut().step_by(3).for_each(|t| t.reverse());
        let soup = Soup::of_mesh(mesh.positions(), &triangles);
        let found = kinds(&soup, [3.0, 4.0, 5.0]);
        assert_eq!(
            (count(&found, Kind::Contour), count(&found, Kind::Crease)),
            (6, 6)
        );
    }

    #[test]
    fn three_fins_on_a_line_are_a_crease_and_on_one_side_a_contour() {
        let fins = [
            [0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 0.5, 0.0],
            [-1.0, 0.5, 0.0],
            [0.3, 0.5, -1.0],
        ];
        let soup = Soup::of_mesh(&fins, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]);
        assert_eq!(count(&kinds(&soup, [0.1, 0.5, 4.0]), Kind::Crease), 1);
        assert_eq!(count(&kinds(&soup, [-4.0, 0.5, -4.0]), Kind::Contour), 0);
        let fan = [
            [0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 0.5, 0.0],
            [1.0, 0.5, 0.6],
            [1.0, 0.5, -0.6],
        ];
        let soup = Soup::of_mesh(&fan, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]);
        assert_eq!(count(&kinds(&soup, [0.1, 0.5, 4.0]), Kind::Contour), 1);
    }
}
