//! Closed curves of arcs and corners, and which of the two a polygon's corner becomes [Selinger 2003, 2.3.2].

use glam::DVec2;

/// A part of a closed curve, from the end of the part before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Segment {
    /// Two straight pieces that meet at a corner.
    Corner {
        /// Where they meet.
        corner: DVec2,
        /// The end of the second piece.
        end: DVec2,
    },
    /// A cubic Bezier arc.
    Arc {
        /// First control point.
        from: DVec2,
        /// Second control point.
        to: DVec2,
        /// Its end.
        end: DVec2,
    },
}

impl Segment {
    /// Where it ends and the next one starts.
    pub fn end(&self) -> DVec2 {
        match self {
            Self::Corner { end, .. } | Self::Arc { end, .. } => *end,
        }
    }
}

/// What becomes of a corner of the polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// The polygon's corner. Pixels, y down.
    pub corner: DVec2,
    /// How far the arc's control points lie towards the corner, from 0.55 to 1. None where the corner stays a corner.
    pub alpha: Option<f64>,
}

/// The least share that control points lie towards a corner [Selinger 2003, 2.3.2].
const ALPHA_LEAST: f64 = 0.55;

/// Tells corners from arcs: a corner is where `alpha` would be `alpha_max` or more.
///
/// At a corner `a`, with the middles `b` and `c` of the polygon's sides around it, an arc from `b` to `c` shall touch
/// the square of one pixel around `a`; its control points lie the share `alpha` of the way from `b` and `c` to `a`.
/// The sharper the corner and the longer its sides, the greater alpha, up to 4/3. So 0 makes polygons, and more than
/// 4/3 leaves no corner.
pub fn bends(corners: &[DVec2], alpha_max: f64) -> Vec<Bend> {
    (0..corners.len())
        .map(|index| bend_at(corners, index, alpha_max))
        .collect()
}

/// The bend at one corner.
pub(super) fn bend_at(corners: &[DVec2], index: usize, alpha_max: f64) -> Bend {
    let count = corners.len();
    let corner = corners[index];
    let before = corners[if index == 0 { count - 1 } else { index - 1 }];
    let after = corners[if index + 1 == count { 0 } else { index + 1 }];
    let alpha = alpha_at(before, corner, after);
    Bend {
        corner,
        alpha: (alpha < alpha_max).then(|| alpha.clamp(ALPHA_LEAST, 1.0)),
    }
}

/// The share that control points would lie towards a corner for the arc to touch the unit square around it.
fn alpha_at(before: DVec2, corner: DVec2, after: DVec2) -> f64 {
    // The arc's middle is parallel to the chord, and so to the line through the neighbours.
    let chord = after - before;
    let area = chord.perp_dot(corner - before).abs();
    if area == 0.0 {
        // Straight on nothing need be touched; straight back no arc can be.
        let goes_on = (corner - before).dot(after - corner) > 0.0;
        return if goes_on { 0.0 } else { 4.0 / 3.0 };
    }
    // Twice the square's reach across the chord, as a share of the neighbours' distance from the corner.
    let gamma = 1.0 - (chord.x.abs() + chord.y.abs()) / area;
    gamma.max(0.0) * (4.0 / 3.0)
}

/// The curve through the middles of a polygon's sides, one segment for every corner, the first from the last side's
/// middle.
pub fn curve(bends: &[Bend]) -> Vec<Segment> {
    let mut segments = Vec::with_capacity(bends.len());
    draw_curve(
        bends.len(),
        |index| bends[index],
        |segment| segments.push(segment),
    );
    segments
}

/// [`curve`], of bends by their numbers, segment by segment.
pub(super) fn draw_curve(
    count: usize,
    bend: impl Fn(usize) -> Bend,
    mut draw: impl FnMut(Segment),
) {
    let Some(last) = count.checked_sub(1) else {
        return;
    };
    let mut here = bend(0);
    let mut start = bend(last).corner.midpoint(here.corner);
    for index in 0..count {
        let after = bend(if index == last { 0 } else { index + 1 });
        let end = here.corner.midpoint(after.corner);
        draw(segment(start, &here, end));
        (start, here) = (end, after);
    }
}

/// The segment of one bend between the middles of the sides around it.
pub(super) fn segment(start: DVec2, bend: &Bend, end: DVec2) -> Segment {
    let corner = bend.corner;
    match bend.alpha {
        None => Segment::Corner { corner, end },
        Some(alpha) => Segment::Arc {
            from: start.lerp(corner, alpha),
            to: end.lerp(corner, alpha),
            end,
        },
    }
}
