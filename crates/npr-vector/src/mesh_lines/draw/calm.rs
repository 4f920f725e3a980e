//! Joins, cuts and smooths runs before they become strokes.

use crate::mesh_lines::bridge::bridge_gaps;
use crate::mesh_lines::corner::split;
use crate::mesh_lines::duplicates::{leave_out_short_fragments, suppress};
use crate::mesh_lines::line_settings::LineSettings;
use crate::mesh_lines::merge::{FACING_PX, TOUCHING_PX, merge_ends};
use crate::mesh_lines::overshoot::cut_overshoot;
use crate::mesh_lines::relabel_intersections::relabel_intersections;
use crate::mesh_lines::run::Run;
use crate::mesh_lines::smooth::smooth;
use crate::project::Lens;

/// Runs of a view joined, cut at corners and smoothed, as far as the settings ask for it.
pub(crate) fn calmed(mut found: Vec<Run>, settings: &LineSettings, lens: Lens) -> Vec<Run> {
    if settings.smooth {
        found = merge_ends(relabel_intersections(found), TOUCHING_PX);
    }
    if let Some(least_turn) = settings.split {
        found = split(found, least_turn);
    }
    if settings.smooth {
        smooth(&mut found, lens);
        found = merge_ends(cut_overshoot(suppress(found)), FACING_PX);
        found = bridge_gaps(found);
        smooth(&mut found, lens);
        found = leave_out_short_fragments(found);
    }
    found
}
