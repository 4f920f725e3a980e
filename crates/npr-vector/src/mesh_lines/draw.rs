//! From a shape and a camera to strokes.
//!
//! [`Prepared`] holds what does not depend on the camera; [`strokes`] does the rest for one view: it gathers the pieces
//! of all lines, finds their visible parts, joins those that continue each other, and smooths.

mod calm;
mod even_paint;
mod find_error;
mod masses;
mod paint;
mod prepared;
mod spines;
mod stretches;
mod view;
mod view_runs;

pub use crate::mesh_lines::line_settings::{LineSettings, LineSource};
pub(crate) use calm::calmed;
pub use find_error::FindError;
pub(crate) use paint::strokes_of;
pub use paint::{PaintAt, PointPaint, StrokeLook};
pub use prepared::{FindCrossings, Prepared};
pub use spines::spines;
pub use view_runs::ViewRuns;

use crate::mesh_lines::contour::{EdgeContours, Eye};
use crate::mesh_lines::joints::JointsInView;
use crate::mesh_lines::puff::SmokeLines;
use crate::mesh_lines::run_assembly::runs;
use crate::mesh_lines::suppressed_edges::{edges_beside, suppressed_edges};
use crate::mesh_lines::visibility::{FaceImages, Seen};
use crate::project::Projector;
use crate::stroke::Stroke;
use npr_core::interrupt::Interrupt;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;
use view::{Toll, View};

/// The lines of a view.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ViewStrokes {
    /// The strokes; visible ones first where hidden ones are asked for, then by chain.
    pub strokes: Vec<Stroke>,
    /// Pieces of line that were left out because the paper under them was black already.
    pub left_out: usize,
}

/// Most surfaces in front of a hidden line that are counted.
const HIDDEN_COUNT_LIMIT: u32 = 255;

/// The lines of a view as strokes; visible ones first where hidden ones are asked for, then by chain.
///
/// `width_at` gives the whole line width in pixels at a vertex of the shape. O(faces + lines log lines); most of
/// the time goes into one sight for every span of every line. The memory limit of the settings does not count.
///
/// # Panics
///
/// Never: memory is not limited.
pub fn strokes(
    shape: &HalfEdgeMesh,
    prepared: &Prepared,
    projector: &Projector,
    settings: &LineSettings,
    width_at: &(dyn Fn(u32) -> f32 + Sync),
) -> Vec<Stroke> {
    // Find contours as seen from the eye.
    let contours = EdgeContours::new(shape, &eye_of(shape, projector));
    let look = StrokeLook {
        width_at,
        paint_at: None,
        is_lit: false,
        follows_bends: false,
    };

    // Draw without a limit of memory.
    let settings = LineSettings {
        memory_limit: u64::MAX,
        ..settings.clone()
    };
    let found = strokes_with(
        shape,
        prepared,
        projector,
        &settings,
        &contours,
        &look,
        (None, None),
    );
    found.expect("no limit is set").strokes
}

/// As [`strokes`], with smoke, and with contours along edges that the caller found for [`eye_of`] the view.
///
/// Dense smoke hides lines of the shape and counts as one surface; its own outline comes after them. Where lines lie
/// so close that the paper is black, further ones are left out: those over it whose edges have the greater hashes
/// ([`hash_key`](crate::rank::hash_key)), whatever the number of threads.
///
/// `held` has the joints of the frame before, if there is one, and those of this frame afterwards: ends of lines that
/// were joined stay so beyond the limits, and those left apart stay so within, by a margin. Smoke does not hold.
///
/// # Errors
///
/// [`FindError::Memory`] where what is found would take more than the settings' limit.
pub fn strokes_with(
    shape: &HalfEdgeMesh,
    prepared: &Prepared,
    projector: &Projector,
    settings: &LineSettings,
    contours: &EdgeContours,
    look: &StrokeLook<'_>,
    (smoke, held): (Option<&SmokeLines<'_>>, Option<JointsInView<'_>>),
) -> Result<ViewStrokes, FindError> {
    let found = runs_with(
        shape,
        prepared,
        projector,
        settings,
        contours,
        (smoke, held),
        &Interrupt::NEVER,
    )?;
    Ok(found.strokes(shape, projector, look))
}

/// As [`strokes_with`], before the lines have widths and colours: nearly all of the time goes into this, and the look
/// of a drawing has no part in it. The flag is asked for every line.
///
/// # Errors
///
/// As [`strokes_with`], and [`FindError::Interrupted`] where the flag is raised.
pub fn runs_with(
    shape: &HalfEdgeMesh,
    prepared: &Prepared,
    projector: &Projector,
    settings: &LineSettings,
    contours: &EdgeContours,
    (smoke, held): (Option<&SmokeLines<'_>>, Option<JointsInView<'_>>),
    interrupt: &Interrupt,
) -> Result<ViewRuns, FindError> {
    let EdgeContours {
        front,
        graph: edge_contours,
    } = contours;

    // Gather the outlines that can hide something.
    let view = View {
        shape,
        prepared,
        projector,
        settings,
        front,
        covered: Vec::new(),
    };
    let mut toll = Toll::new(settings);
    toll.interrupt = interrupt.clone();
    let outlines = view.outlines(edge_contours, &mut toll.budget)?;
    let images = FaceImages::default();
    let seen = Seen {
        shape,
        tree: &prepared.tree,
        projector,
        outlines: &outlines,
        images: &images,
        size: settings.size,
        extra: smoke
            .filter(|smoke| smoke.is_dense)
            .map(|smoke| smoke.puffs as _),
        count_limit: if settings.hidden {
            HIDDEN_COUNT_LIMIT
        } else {
            1
        },
    };

    // Find what is seen of the contours.
    let wanted = settings.kinds | KindSet::MARKED;
    let contour_lines = view.lines(edge_contours, &seen, wanted, &mut toll)?;

    // Put smooth contours in their place where the settings ask for them.
    let smooth_contours = view.smooth_contours(edge_contours, &contour_lines);
    let contour_runs = match &smooth_contours {
        Some((graph, lines)) => runs(shape, projector, (graph, 0), (lines, settings.hidden)),
        None => runs(
            shape,
            projector,
            (edge_contours, 0),
            (&contour_lines, settings.hidden),
        ),
    };

    // Suppress the mesh edges that smooth contours show already.
    let covered = smooth_contours.as_ref().map(|(graph, lines)| {
        let mut covered = suppressed_edges(graph, lines);
        covered.extend(edges_beside(lines, view.contour_features()));
        covered.sort_unstable();
        covered
    });
    let view = View {
        covered: covered.unwrap_or_default(),
        ..view
    };

    // Add features, polylines and intersections.
    let others = [
        &prepared.features,
        &prepared.polylines,
        &prepared.crossings.graph,
    ];
    let mut found = contour_runs;
    for (graph, number) in others.into_iter().zip(1..) {
        let lines = view.lines(graph, &seen, wanted, &mut toll)?;
        let hidden = settings.hidden;
        found.extend(runs(shape, projector, (graph, number), (&lines, hidden)));
    }

    // Join and smooth them, and add the outline of smoke.
    interrupt.check()?;
    let runs = calmed(found, settings, projector.lens(), held);
    let of_smoke = smoke.map(|smoke| {
        let seen = Seen {
            extra: None,
            ..seen
        };
        smoke.strokes(&seen, settings)
    });
    Ok(ViewRuns {
        runs,
        of_smoke: of_smoke.unwrap_or_default(),
        left_out: toll.left_out,
    })
}

/// The eye of a view, as decisions about facing read it. O(vertices), in parallel.
pub fn eye_of(shape: &HalfEdgeMesh, projector: &Projector) -> Eye {
    Eye::new(projector.eye(), extent_of(shape, projector))
}

/// Largest coordinate of the shape and the eye.
fn extent_of(shape: &HalfEdgeMesh, projector: &Projector) -> f32 {
    let [x, y, z, w] = projector.eye();
    let eye = if w == 0.0 {
        0.0
    } else {
        x.abs().max(y.abs()).max(z.abs()) as f32
    };
    // Several numbers side by side, as processors have it.
    let largest = |chunk: &[[f32; 3]]| {
        let (lanes, rest) = chunk.as_flattened().as_chunks::<16>();
        let mut extent = [0.0_f32; 16];
        for lane in lanes {
            extent = std::array::from_fn(|i| {
                if lane[i].abs() > extent[i] {
                    lane[i].abs()
                } else {
                    extent[i]
                }
            });
        }
        extent
            .iter()
            .chain(rest)
            .fold(0.0_f32, |extent, v| extent.max(v.abs()))
    };
    let chunks = shape.positions.par_chunks(1 << 16);
    let shape = chunks.map(largest).reduce(|| 0.0, f32::max);
    shape.max(eye)
}
