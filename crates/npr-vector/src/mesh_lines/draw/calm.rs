//! Joins, cuts and smooths runs before they become strokes.

use crate::mesh_lines::bridge::bridge_gaps;
use crate::mesh_lines::corner::split;
use crate::mesh_lines::duplicates::{leave_out_short_fragments, suppress};
use crate::mesh_lines::joints::{JoiningStep, JointsInView};
use crate::mesh_lines::line_parts::tell_parts;
use crate::mesh_lines::line_settings::LineSettings;
use crate::mesh_lines::merge::{FACING_PX, TOUCHING_PX, merge_held};
use crate::mesh_lines::overshoot::cut_overshoot;
use crate::mesh_lines::relabel_intersections::relabel_intersections;
use crate::mesh_lines::run::Run;
use crate::mesh_lines::smooth::smooth;
use crate::project::Lens;

/// Runs of a view joined, cut at corners and smoothed, as far as the settings ask for it; joints hold to those of the
/// frame before, if there is one.
pub(crate) fn calmed(
    mut found: Vec<Run>,
    settings: &LineSettings,
    lens: Lens,
    mut held: Option<JointsInView<'_>>,
) -> Vec<Run> {
    if settings.smooth {
        let held = held.as_mut().map(|held| (JoiningStep::Touching, held));
        found = merge_held(relabel_intersections(found), TOUCHING_PX, held);
    }
    if let Some(least_turn) = settings.split {
        found = split(found, least_turn);
    }
    if settings.smooth {
        smooth(&mut found, lens);
        let facing = held.as_mut().map(|held| (JoiningStep::Facing, held));
        found = merge_held(cut_overshoot(suppress(found)), FACING_PX, facing);
        // Short pieces that were joined to a line can stand out beyond the corner that they belong to.
        found = cut_overshoot(bridge_gaps(found, held.as_mut()));
        smooth(&mut found, lens);
        found = leave_out_short_fragments(found);
    }
    tell_parts(&mut found);
    found
}
