//! The lines that a view must show, found slowly: every piece of every edge is tested by a ray of its own.
//!
//! Nothing here is shared with the code that draws: adjacency, tree, camera and chaining are its own, in double
//! precision. A piece is at most half a pixel long; it is visible where no triangle but the edge's own cuts its line of
//! sight. Intersections are not part of it.

use glam::DVec3;
use npr_vector::stroke::Kind;
use rayon::prelude::*;

use super::candidates::{Candidate, Seen, Wanted};
use super::chains::{Run, chain, joined, runs};
use super::drawn::{DrawnStroke, drawn_strokes};
use super::occluders::Occluders;
use super::soup::Soup;
use super::viewpoint::Viewpoint;

/// Longest piece, in pixels.
const STEP_PX: f64 = 0.5;

/// Most pieces of one edge: frames are no wider.
const MOST_PIECES: f64 = 1e5;

/// Share of a line of sight from which on a surface does not hide the point at its end: rounding.
const EXACT: f64 = 1.0 - 1e-9;

/// Share of a line of sight from which on a surface touches the point at its end, so that it may be drawn or not.
const TOUCHING: f64 = 1.0 - 1e-5;

/// Whether a piece is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sight {
    /// Nothing lies before it.
    Visible,
    /// It may be drawn or not: see [`Candidate::due`]; or a surface touches it from before.
    Either,
    /// Something lies before it, or it is out of the frame.
    Hidden,
}

/// A short piece of a candidate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Its middle, in pixels.
    pub at: [f64; 2],
    /// Where it starts and ends, in pixels.
    pub ends: [[f64; 2]; 2],
    /// In pixels.
    pub length: f64,
    /// Whether it is seen.
    pub sight: Sight,
}

/// A piece of line that must, or may, be drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Its middle, in pixels.
    pub at: [f64; 2],
    /// In pixels.
    pub length: f64,
    /// What it is.
    pub kind: Kind,
    /// It must be drawn, not only may.
    pub due: bool,
    /// Unit vector in the picture, across the line and away from the surface beside it; zero where there is no saying.
    pub outward: [f64; 2],
}

/// The lines that a view must show.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Reference {
    /// All pieces that must or may be drawn.
    pub pieces: Vec<Piece>,
    /// The same as connected lines, each as long as it can be.
    pub runs: Vec<Run>,
    /// Runs joined where a line is lost for a moment only, without those that stay short: see [`joined`].
    pub joined: Vec<Run>,
    /// The strokes of a pen that a picture of the runs takes: see [`drawn_strokes`].
    pub drawn: Vec<DrawnStroke>,
    /// Length of what is hidden within the frame, in pixels.
    pub hidden_px: f64,
}

impl Reference {
    /// The visible lines of a soup. Costs a ray for every half pixel of every candidate, hidden ones too.
    pub fn new(soup: &Soup, view: &Viewpoint, wanted: &Wanted) -> Self {
        // Find the edges that may be lines in this view.
        let edges = soup.edges();
        let seen = Seen::new(soup, &edges, view, wanted);
        let lines: Vec<Candidate> = edges
            .par_iter()
            .filter_map(|edge| seen.candidate(edge))
            .collect();

        // Look whether each is seen, piece by piece.
        let sight = Sighting::new(soup, view);
        let samples: Vec<Vec<Sample>> = lines.par_iter().map(|line| sight.samples(line)).collect();
        let pieces = lines
            .iter()
            .zip(&samples)
            .flat_map(|(line, samples)| sight.pieces(line, samples));

        // Join the seen pieces to runs, and the runs to strokes of a pen.
        let by_chain = runs(&chain(soup, &edges, &seen, &lines), &lines, &samples);
        let hidden = samples.iter().flatten();
        let hidden = hidden.filter(|sample| sample.sight == Sight::Hidden);
        let mut reference = Self {
            hidden_px: hidden.map(|sample| sample.length).sum(),
            pieces: pieces.collect(),
            joined: by_chain.iter().flat_map(|runs| joined(runs)).collect(),
            runs: by_chain.into_iter().flatten().collect(),
            drawn: Vec::new(),
        };
        reference.draw(view);
        reference
    }

    /// Draws the runs with a pen.
    pub(super) fn draw(&mut self, view: &Viewpoint) {
        self.drawn = drawn_strokes(&self.runs, view.size().map(|side| side as u32));
    }

    /// Length of all that must be drawn, in pixels.
    pub fn due_px(&self) -> f64 {
        self.pieces
            .iter()
            .filter(|piece| piece.due)
            .map(|piece| piece.length)
            .sum()
    }
}

/// Looks along rays.
struct Sighting<'a> {
    soup: &'a Soup,
    view: &'a Viewpoint,
    occluders: Occluders<'a>,
    /// Longer than the scene is.
    reach: f64,
}

impl<'a> Sighting<'a> {
    fn new(soup: &'a Soup, view: &'a Viewpoint) -> Self {
        let (middle, radius) = soup.ball();
        Self {
            soup,
            view,
            occluders: Occluders::new(&soup.positions, &soup.faces),
            reach: 4.0 * (radius + middle.distance(view.eye())),
        }
    }

    fn ends(&self, line: &Candidate) -> [DVec3; 2] {
        line.ends.map(|end| self.soup.positions[end as usize])
    }

    /// The pieces of a line from tail to head; where it leaves the frame, a hidden one stands for the rest.
    fn samples(&self, line: &Candidate) -> Vec<Sample> {
        // Clip the line to the frame.
        let [tail, head] = self.ends(line);
        let Some([from, to]) = self.view.clip(tail, head) else {
            return vec![out_of_frame()];
        };

        // Cut it into pieces of half a pixel.
        let ends = [tail.lerp(head, from), tail.lerp(head, to)];
        let depths = ends.map(|end| self.view.depth(end));
        let [a, b] = ends.map(|end| self.view.project(end));
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let count = (length / STEP_PX).ceil().clamp(1.0, MOST_PIECES);
        let place = |share: f64| [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]));

        // Look at the middle of every piece.
        let inside = (0..count as usize).map(|i| {
            let [start, middle, end] = [0.0, 0.5, 1.0].map(|part| (i as f64 + part) / count);
            let share = self.view.world_share(depths, middle);
            Sample {
                at: place(middle),
                ends: [place(start), place(end)],
                length: length / count,
                sight: self.sight(line, ends[0].lerp(ends[1], share)),
            }
        });

        // Let a hidden piece stand for what lies outside.
        let before = (from > 0.0).then(out_of_frame);
        let after = (to < 1.0).then(out_of_frame);
        before.into_iter().chain(inside).chain(after).collect()
    }

    fn sight(&self, line: &Candidate, point: DVec3) -> Sight {
        let origin = self.view.origin(point, self.reach);
        let hit = self.occluders.first_hit(origin, point, line.ends, TOUCHING);
        if hit < TOUCHING {
            Sight::Hidden
        } else if hit < EXACT || !line.due {
            Sight::Either
        } else {
            Sight::Visible
        }
    }

    fn pieces(&self, line: &Candidate, samples: &[Sample]) -> Vec<Piece> {
        let outward = self.outward(line);
        let seen = samples
            .iter()
            .filter(|sample| sample.sight != Sight::Hidden);
        seen.map(|sample| Piece {
            at: sample.at,
            length: sample.length,
            kind: line.kind,
            due: sample.sight == Sight::Visible,
            outward,
        })
        .collect()
    }

    /// Unit vector across a line in the picture, away from the surface beside it.
    fn outward(&self, line: &Candidate) -> [f64; 2] {
        let [tail, head] = self.ends(line);
        let [a, b, beside] = [tail, head, line.beside].map(|point| self.view.project(point));
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = along[0].hypot(along[1]);
        let side = along[0] * (beside[1] - a[1]) - along[1] * (beside[0] - a[0]);
        if !(length > 0.0 && side.abs() > 0.0 && side.is_finite()) {
            return [0.0; 2];
        }
        let turn = side.signum() / length;
        [along[1] * turn, -along[0] * turn]
    }
}

fn out_of_frame() -> Sample {
    Sample {
        at: [0.0; 2],
        ends: [[0.0; 2]; 2],
        length: 0.0,
        sight: Sight::Hidden,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::camera::{Camera, Projection};
    use npr_mesh::testing::{cube, uv_sphere};

    fn camera(eye: [f32; 3]) -> Camera {
        Camera {
            eye,
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 0.7 },
        }
    }

    fn reference(mesh: &npr_mesh::Mesh, eye: [f32; 3]) -> Reference {
        let soup = Soup::of_mesh(mesh.positions(), mesh.triangles());
        Reference::new(
            &soup,
            &Viewpoint::new(&camera(eye), [400, 300]),
            &Wanted::default(),
        )
    }

    #[test]
    fn a_cube_shows_nine_of_its_twelve_edges() {
        let found = reference(&cube(), [3.0, 4.0, 5.0]);
        let count = |kind| {
            found
                .runs
                .iter()
                .filter(|run| run.layer.kind == kind)
                .count()
        };
        // The six contours are one loop; of six creases three end in the near corner, three lie behind.
        assert_eq!(count(Kind::Contour), 1);
        assert!(
            found
                .runs
                .iter()
                .any(|run| run.layer.kind == Kind::Contour && run.closed)
        );
        assert_eq!(count(Kind::Crease), 3);
        assert!(found.pieces.iter().all(|piece| piece.due));
    }

    #[test]
    fn the_outline_of_a_ball_is_a_closed_circle_with_the_ball_inside() {
        let found = reference(&uv_sphere(96, 48), [0.0, 0.0, 6.0]);
        let radius = 150.0 / libm::tan(0.35) / 35f64.sqrt();
        assert_eq!(found.runs.len(), 1);
        assert!(found.runs[0].closed);
        for piece in &found.pieces {
            let from_middle = [piece.at[0] - 200.0, piece.at[1] - 150.0];
            let distance = from_middle[0].hypot(from_middle[1]);
            assert!((distance - radius).abs() < 0.02 * radius);
            let outward =
                (piece.outward[0] * from_middle[0] + piece.outward[1] * from_middle[1]) / distance;
            assert!(outward > 0.8, "{outward}");
        }
        assert!((found.due_px() / (std::f64::consts::TAU * radius) - 1.0).abs() < 0.01);
    }

    #[test]
    fn a_frame_cuts_lines_short() {
        let near = reference(&cube(), [1.5, 1.6, 1.7]);
        assert!(
            near.pieces
                .iter()
                .all(|p| (-0.01..400.01).contains(&p.at[0]) && (-0.01..300.01).contains(&p.at[1]))
        );
        assert!(near.due_px() > 0.0);
    }

    #[test]
    fn nothing_has_no_lines() {
        let soup = Soup::default();
        let found = Reference::new(
            &soup,
            &Viewpoint::new(&camera([0.0, 0.0, 3.0]), [40, 30]),
            &Wanted::default(),
        );
        assert_eq!(found, Reference::default());
    }
}
