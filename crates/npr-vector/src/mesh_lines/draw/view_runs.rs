//! The lines of a view before they have widths and colours.

use super::ViewStrokes;
use super::paint::{StrokeLook, painted};
use crate::mesh_lines::run::Run;
use crate::project::Projector;
use crate::stroke::Stroke;
use npr_mesh::half_edge::HalfEdgeMesh;

/// The lines that a view shows, before they have widths and colours: [`runs_with`](super::runs_with) finds them.
#[derive(Debug, Clone, Default)]
pub struct ViewRuns {
    /// Parts of lines, joined, cut and smoothed.
    pub(super) runs: Vec<Run>,
    /// The outline of smoke, which has its widths.
    pub(super) of_smoke: Vec<Stroke>,
    /// Pieces of line that were left out because the paper under them was black already.
    pub(super) left_out: usize,
}

impl ViewRuns {
    /// The strokes of the view that the lines were found in; the outline of smoke comes last, then, where there are
    /// any, hidden lines. O(points), in parallel.
    pub fn strokes(
        self,
        shape: &HalfEdgeMesh,
        projector: &Projector,
        look: &StrokeLook<'_>,
    ) -> ViewStrokes {
        let mut strokes = painted(self.runs, shape, look, projector.lens());
        strokes.extend(self.of_smoke);
        strokes.sort_by_key(|stroke| stroke.occluders > 0);
        ViewStrokes {
            strokes,
            left_out: self.left_out,
        }
    }
}
