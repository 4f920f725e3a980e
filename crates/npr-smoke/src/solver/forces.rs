//! What pushes the air: warmth, weight, and curls that the grid would swallow.

use glam::Vec3;

use super::SmokeSettings;
use super::flow::{Field, Flow};

/// Hot smoke rises and dense smoke sinks [Fedkiw et al. 2001, eq. 5].
///
/// `gain` turns an acceleration in box lengths per second squared into a change in cells per second.
pub(super) fn lift(
    flow: &mut Flow,
    density: &Field,
    temperature: &Field,
    settings: &SmokeSettings,
    gain: f32,
) {
    // Weigh each cell: heat lifts it, smoke pulls it down.
    let top = flow.cells.size[2];
    let push = |cell: [usize; 3]| {
        settings.buoyancy * temperature.value(cell) - settings.weight * density.value(cell)
    };

    // Push every face between two cells by their mean; the floor stays closed.
    let upward = &mut flow.faces[2];
    let before = upward.values.clone();
    let lattice = upward.lattice;
    lattice.fill(&mut upward.values, |face @ [x, y, z]| {
        let here = before[lattice.index(face)];
        if z == 0 {
            return here;
        }
        let below = push([x, y, z - 1]);
        let above = if z < top { push(face) } else { below };
        here + 0.5 * (below + above) * gain
    });
}

/// Pushes curls towards their own centres [Fedkiw et al. 2001, eq. 11], `strength` in cells.
pub(super) fn confine(flow: &mut Flow, strength: f32, seconds: f32) {
    if strength <= 0.0 {
        return;
    }

    // Find how the air turns in every cell.
    let cells = flow.cells;
    let centres = cells.map_costly(|cell| flow.at_centre(cell));
    let curls = cells.map_costly(|cell| {
        let [dx, dy, dz] = [0, 1, 2].map(|axis| slope(&centres, cells.size, cell, axis));
        Vec3::new(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x)
    });

    // Push the air round the places where it turns most.
    let lengths: Vec<Vec3> = curls
        .iter()
        .map(|curl| Vec3::splat(curl.length()))
        .collect();
    let pushes = cells.map_costly(|cell| {
        let towards = [0, 1, 2].map(|axis| slope(&lengths, cells.size, cell, axis).x);
        let towards = Vec3::from_array(towards).normalize_or_zero();
        towards.cross(curls[cells.index(cell)]) * (strength * seconds)
    });

    // Spread the push over the faces of the cells.
    for (axis, field) in flow.faces.iter_mut().enumerate() {
        let lattice = field.lattice;
        let before = field.values.clone();
        lattice.fill(&mut field.values, |face| {
            let here = before[lattice.index(face)];
            if face[axis] == 0 || face[axis] == cells.size[axis] {
                return here;
            }
            let mut below = face;
            below[axis] -= 1;
            let push = pushes[cells.index(face)] + pushes[cells.index(below)];
            here + 0.5 * push[axis]
        });
    }
}

/// Takes a share of all motion away, `drag` per second.
pub(super) fn brake(flow: &mut Flow, drag: f32, seconds: f32) {
    if drag <= 0.0 {
        return;
    }
    let left = npr_core::math::exp(-drag * seconds);
    flow.faces.iter_mut().for_each(|field| field.scale(left));
}

/// Central difference along an axis, one-sided at the border.
fn slope(values: &[Vec3], size: [usize; 3], cell: [usize; 3], axis: usize) -> Vec3 {
    let lattice = crate::lattice::Lattice { size };
    let (mut low, mut high) = (cell, cell);
    low[axis] = cell[axis].saturating_sub(1);
    high[axis] = (cell[axis] + 1).min(size[axis] - 1);
    let run = (high[axis] - low[axis]) as f32;
    (values[lattice.index(high)] - values[lattice.index(low)]) / run
}
