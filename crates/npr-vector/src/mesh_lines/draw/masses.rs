//! Lines within masses, such as a tuft of grass, of which only the outline is drawn.

use super::view::View;
use crate::mesh_lines::line::Line;
use crate::mesh_lines::visibility::Span;
use rayon::prelude::*;

/// Distances, in pixels, at which it is looked beside a line for the mass. The first finds blades as thin as a line; a
/// gap that is narrower than the last, which is a pen's width, is closed to the eye.
const BESIDE_PX: [f64; 3] = [0.75, 1.5, 3.0];

/// Leaves out the parts of lines of masses on both sides of which the same mass shows, and those that are hidden.
///
/// Surfaces of one material are one mass where [`is_mass`](npr_mesh::half_edge::Surface::is_mass) is true of them. O(1)
/// for shapes without one; else up to 6 sights for each visible part.
pub(super) fn leave_out_within(view: &View<'_>, lines: &mut [Option<Line>]) {
    let surfaces = &view.shape.surfaces;
    if !surfaces.iter().any(|surface| surface.is_mass) {
        return;
    }
    lines
        .par_iter_mut()
        .with_min_len(16)
        .flatten()
        .for_each(|line| {
            if surfaces[line.surface as usize].is_mass {
                let mut spans = std::mem::take(&mut line.spans);
                spans.retain(|span| span.occluders == 0 && ends_mass(view, line, span));
                line.spans = spans;
            }
        });
}

/// Whether the mass of a line shows on one side of a part of it at most.
fn ends_mass(view: &View<'_>, line: &Line, span: &Span) -> bool {
    // Stand in the middle of the part, and look across it.
    let [from, to] = line.piece.place;
    let along = [0, 1].map(|i| to[i] - from[i]);
    let length = along[0].hypot(along[1]);
    if length <= 0.0 {
        return true;
    }
    let share = 0.5 * (span.from + span.to);
    let middle = [0, 1].map(|i| from[i] + share * along[i]);
    let across = [-along[1] / length, along[0] / length];

    // Look for the mass on both sides.
    let surfaces = &view.shape.surfaces;
    let own = surfaces[line.surface as usize].material;
    let shows_at = |px: f64| {
        let place = [0, 1].map(|i| middle[i] + px * across[i]);
        let found = view
            .prepared
            .tree
            .face_at(view.shape, view.projector, place);
        found.is_some_and(|(face, _)| {
            let surface = &surfaces[view.shape.face_surfaces[face as usize] as usize];
            surface.is_mass && surface.material == own
        })
    };
    let shows = |side: f64| BESIDE_PX.iter().any(|px| shows_at(side * px));
    !(shows(1.0) && shows(-1.0))
}
