//! How far the smoke reaches round every voxel: the growing box of [Hoshino 2004, 3.1], for all voxels at once.

use glam::Vec3;
use rayon::prelude::*;

use crate::Volume;
use crate::lattice::{Lattice, rows};

/// Distance from every voxel to the nearest *thin* voxel, in voxels along the longest axis (L-infinity).
///
/// A voxel is thin when its density is `threshold` or less, and *dense* otherwise. All that lies outside the grid is
/// thin. The distance of a thin voxel is 0, that of a dense voxel with a thin neighbour, across a corner too, is 1.
/// It is exactly the half side at which a box round the voxel's centre first takes in a thin voxel's centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Distances {
    /// Voxels along z, x, y: the order in which the last sweep leaves them.
    swept: Lattice,
    steps: Vec<u16>,
}

impl Distances {
    /// Measures a volume: O(voxels), three sweeps along the axes [Meijster et al. 2000], in parallel; 2 bytes a voxel,
    /// twice that while it runs.
    ///
    /// A `threshold` that is NaN makes every voxel thin.
    pub fn new(volume: &Volume, threshold: f32) -> Self {
        let lattice = volume.lattice();
        let [width, height, depth] = lattice.size;
        let swept = Lattice::new(depth, width, height);
        if volume.is_empty() {
            return Self {
                swept,
                steps: Vec::new(),
            };
        }
        let flat = sweep_planes(volume.density(), threshold, lattice);
        let mut steps = vec![0u16; lattice.len()];
        rows(&mut steps, depth * width, |(y, plane)| {
            // Read along x: steps along z are pages apart.
            for z in 0..depth {
                let row = &flat[width * (y + height * z)..][..width];
                for (x, near) in row.iter().enumerate() {
                    plane[z + depth * x] = *near;
                }
            }
            let mut sweep = Sweep::new(depth);
            for column in plane.chunks_mut(depth) {
                sweep.run(column);
            }
        });
        Self { swept, steps }
    }

    /// Voxels along x, y and z.
    pub fn size(&self) -> [u32; 3] {
        let [depth, width, height] = self.swept.size;
        [width as u32, height as u32, depth as u32]
    }

    /// The distance at a voxel; 0 outside the grid.
    pub fn at(&self, [x, y, z]: [u32; 3]) -> u16 {
        let [width, height, depth] = self.size();
        if x >= width || y >= height || z >= depth {
            return 0;
        }
        self.steps[self.swept.index([z as usize, x as usize, y as usize])]
    }

    /// The distance at a place of index space, blended between voxel centres, in constant time.
    ///
    /// It changes without jumps as a place moves, and lies within 0.6 of the half side of a box that grows
    /// round the place itself. 0 outside the voxels' cubes.
    pub fn near(&self, index: Vec3) -> f32 {
        let turned = Vec3::new(index.z, index.x, index.y);
        if self.steps.is_empty() || !self.swept.holds(turned) {
            return 0.0;
        }
        let cell = self.swept.cell(turned);
        cell.blend(|at| f32::from(self.steps[at]))
    }

    /// Half the side of the box round a place of index space that grows until it takes in the centre of a thin voxel
    /// [Hoshino 2004, 3.1], in voxels. 0 outside the voxels' cubes.
    ///
    /// Exact. The nearest voxel's distance tells in which shell of voxels round that voxel the first thin one lies,
    /// so no other is looked at: O(d^2) for a half side d.
    pub fn half_side(&self, index: Vec3) -> f32 {
        let turned = Vec3::new(index.z, index.x, index.y);
        let Some(home) = self.swept.nearest(turned) else {
            return 0.0;
        };
        let home = home.map(|side| side as i64);
        let reach = self.steps_at(home);
        let mut half_side = f32::MAX;
        for (a, b) in (-reach..=reach).flat_map(|a| (-reach..=reach).map(move |b| (a, b))) {
            let is_face = a.abs() == reach || b.abs() == reach;
            let mut c = -reach;
            while c <= reach {
                let voxel = [home[0] + a, home[1] + b, home[2] + c];
                let steps = self.steps_at(voxel);
                if steps == 0 {
                    let away = Vec3::from_array(voxel.map(|side| side as f32)) - turned;
                    half_side = half_side.min(away.abs().max_element());
                }
                // Go on by as much as is certainly dense, or to the other face.
                c += if is_face { steps.max(1) } else { 2 * reach };
            }
        }
        half_side
    }

    /// The distance at a voxel in the order of the sweeps; 0 outside the grid.
    fn steps_at(&self, voxel: [i64; 3]) -> i64 {
        let inside = |axis: usize| {
            usize::try_from(voxel[axis])
                .ok()
                .filter(|at| *at < self.swept.size[axis])
        };
        match (inside(0), inside(1), inside(2)) {
            (Some(a), Some(b), Some(c)) => i64::from(self.steps[self.swept.index([a, b, c])]),
            _ => 0,
        }
    }

    /// Whether the voxel that a place of index space lies in is dense.
    pub fn is_dense(&self, index: Vec3) -> bool {
        let turned = Vec3::new(index.z, index.x, index.y);
        let voxel = self.swept.nearest(turned);
        voxel.is_some_and(|voxel| self.steps[self.swept.index(voxel)] > 0)
    }

    /// Number of dense voxels.
    pub fn dense_count(&self) -> usize {
        self.steps.par_iter().filter(|&&steps| steps > 0).count()
    }

    /// Every dense voxel with its distance, in a fixed order.
    pub(crate) fn dense(&self) -> impl ParallelIterator<Item = ([u32; 3], u16)> + '_ {
        let voxel = |(at, steps): (usize, &u16)| {
            let [z, x, y] = self.swept.point(at).map(|side| side as u32);
            ([x, y, z], *steps)
        };
        let numbered = self.steps.par_iter().enumerate();
        numbered.filter(|(_, steps)| **steps > 0).map(voxel)
    }

    /// Finds a fault in the distances: neighbours that differ by more than 1, or a border that is not next to the
    /// outside.
    #[cfg(test)]
    pub(crate) fn sanity_check(&self) -> Result<(), String> {
        let [width, height, depth] = self.size();
        for (x, y, z) in (0..width)
            .flat_map(|x| (0..height).flat_map(move |y| (0..depth).map(move |z| (x, y, z))))
        {
            let here = self.at([x, y, z]);
            for next in [[x + 1, y, z], [x, y + 1, z], [x, y, z + 1]] {
                if here.abs_diff(self.at(next)) > 1 {
                    return Err(format!("a jump from {:?} to {next:?}", [x, y, z]));
                }
            }
            if [x, y, z].contains(&0) && here > 1 {
                return Err(format!("{here} at the border voxel {:?}", [x, y, z]));
            }
        }
        Ok(())
    }
}

/// Distances within each plane of equal z, as if all other planes were dense.
fn sweep_planes(density: &[f32], threshold: f32, lattice: Lattice) -> Vec<u16> {
    let [width, height, _] = lattice.size;
    let mut flat = vec![0u16; density.len()];
    rows(&mut flat, width * height, |(z, plane)| {
        // Measure along x within each row.
        let density = &density[z * width * height..][..width * height];
        for (row, density) in plane.chunks_mut(width).zip(density.chunks(width)) {
            sweep_row(density, threshold, row);
        }

        // Grow the boxes along y, column by column.
        let mut sweep = Sweep::new(height);
        let mut column = vec![0u16; height];
        for x in 0..width {
            for (y, near) in column.iter_mut().enumerate() {
                *near = plane[x + y * width];
            }
            sweep.run(&mut column);
            for (y, near) in column.iter().enumerate() {
                plane[x + y * width] = *near;
            }
        }
    });
    flat
}

/// Distances along one row, once from each end.
fn sweep_row(density: &[f32], threshold: f32, row: &mut [u16]) {
    let mut since = 0;
    for (near, &density) in row.iter_mut().zip(density) {
        since = if density > threshold { since + 1 } else { 0 };
        *near = since;
    }
    let mut since = 0;
    for near in row.iter_mut().rev() {
        since = (since + 1).min(*near);
        *near = since;
    }
}

/// The lower envelope of `max(|u - i|, near(i))` over all `i` of a line, in linear time [Meijster et al. 2000,
/// chessboard].
struct Sweep {
    near: Vec<u16>,
    /// Voxels whose curve is lowest somewhere, each with the place from which on it is.
    lowest: Vec<(i32, i32)>,
}

impl Sweep {
    /// Room for lines of `count` voxels.
    fn new(count: usize) -> Self {
        Self {
            near: vec![0; count],
            lowest: Vec::with_capacity(count),
        }
    }

    /// Replaces what is known of each voxel of a line by its distance, the outside at both ends counted as thin.
    fn run(&mut self, line: &mut [u16]) {
        if line.iter().all(|&near| near == 0) {
            return;
        }
        self.near.copy_from_slice(line);
        self.find_lowest();
        let count = line.len() as i32;
        for (u, distance) in (0..count).zip(line.iter_mut()).rev() {
            let Some(&(i, start)) = self.lowest.last() else {
                return;
            };
            let to_outside = (u + 1).min(count - u);
            *distance = self.height(u, i).min(to_outside) as u16;
            if u == start {
                self.lowest.pop();
            }
        }
    }

    /// Goes along the line and keeps the curves that are lowest somewhere.
    fn find_lowest(&mut self) {
        self.lowest.clear();
        self.lowest.push((0, 0));
        let count = self.near.len() as i32;
        for u in 1..count {
            // Drop curves that the new one undercuts where they start.
            while let Some(&(i, start)) = self.lowest.last()
                && self.height(start, i) > self.height(start, u)
            {
                self.lowest.pop();
            }
            let start = match self.lowest.last() {
                None => 0,
                Some(&(i, _)) => 1 + crossing(i, u, self.near(i), self.near(u)),
            };
            if start < count {
                self.lowest.push((u, start));
            }
        }
    }

    fn near(&self, i: i32) -> i32 {
        i32::from(self.near[i as usize])
    }

    /// The curve of `i` at `u`.
    fn height(&self, u: i32, i: i32) -> i32 {
        (u - i).abs().max(self.near(i))
    }
}

/// Last place at which the curve of `i` is not above that of `u`, for `i < u`.
fn crossing(i: i32, u: i32, near_i: i32, near_u: i32) -> i32 {
    if near_i <= near_u {
        (i + near_u).max((i + u) / 2)
    } else {
        (u - near_i).min((i + u) / 2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::in_pool;
    use glam::DAffine3;
    use proptest::prelude::*;

    /// The box of the paper: it grows round a voxel until it takes in one that is thin.
    fn growing_box(volume: &Volume, threshold: f32, voxel: [u32; 3]) -> u16 {
        let size = volume.size().map(|side| side as i32);
        let centre = voxel.map(|at| at as i32);
        let is_thin = |at: [i32; 3]| {
            let outside = (0..3).any(|axis| at[axis] < 0 || at[axis] >= size[axis]);
            outside || {
                let index = at[0] + size[0] * (at[1] + size[1] * at[2]);
                volume.density()[index as usize] <= threshold
            }
        };
        for d in 0.. {
            let side = |axis: usize| centre[axis] - d..=centre[axis] + d;
            let mut inside =
                side(0).flat_map(|x| side(1).flat_map(move |y| side(2).map(move |z| [x, y, z])));
            if inside.any(is_thin) {
                return d as u16;
            }
        }
        unreachable!("a box leaves every grid")
    }

    /// Half the side of the box round any place: how far the nearest of all thin voxels lies, along the axis on which
    /// it is farthest.
    fn half_side(volume: &Volume, threshold: f32, place: Vec3) -> f32 {
        let size = volume.size();
        let range = |axis: usize| -1..=size[axis] as i32;
        let voxels =
            range(0).flat_map(|x| range(1).flat_map(move |y| range(2).map(move |z| [x, y, z])));
        let is_thin = |at: &[i32; 3]| {
            let is_outside = at
                .iter()
                .zip(size)
                .any(|(&at, side)| at < 0 || at >= side as i32);
            is_outside || volume.density_at(Vec3::from_array(at.map(|v| v as f32))) <= threshold
        };
        let away = |at: [i32; 3]| {
            (Vec3::from_array(at.map(|v| v as f32)) - place)
                .abs()
                .max_element()
        };
        voxels.filter(is_thin).map(away).fold(f32::MAX, f32::min)
    }

    fn volume(size: [u32; 3], density: Vec<f32>) -> Volume {
        Volume::new(size, density, DAffine3::IDENTITY).unwrap()
    }

    /// Volumes of up to 7 voxels a side, mostly dense, so that boxes grow.
    fn volumes() -> impl Strategy<Value = Volume> {
        // Whole numbers of ten-thousandths: proptest 1.12 panics on some draws from ranges of floats.
        let between = |range: std::ops::Range<u16>| range.prop_map(|i| f32::from(i) * 1e-4);
        let voxel =
            prop_oneof![6 => between(2000..20_000), 1 => between(0..2000), 1 => Just(0.1f32)];
        (1u32..8, 1u32..8, 1u32..8).prop_flat_map(move |(x, y, z)| {
            prop::collection::vec(voxel.clone(), (x * y * z) as usize)
                .prop_map(move |density| volume([x, y, z], density))
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn distances_are_the_growing_boxes_of_the_paper(volume in volumes()) {
            let distances = Distances::new(&volume, 0.1);
            prop_assert_eq!(distances.sanity_check(), Ok(()));
            for at in 0..volume.density().len() {
                let voxel = volume.lattice().point(at).map(|side| side as u32);
                prop_assert_eq!(distances.at(voxel), growing_box(&volume, 0.1, voxel), "at {:?}", voxel);
            }
        }

        #[test]
        fn blended_distances_stay_near_the_box_round_the_place(
            volume in volumes(), place in prop::array::uniform3(0.0f32..1.0),
        ) {
            let size = volume.size();
            let place = Vec3::from_array(std::array::from_fn(|i| place[i] * (size[i] - 1) as f32));
            let half_side = half_side(&volume, 0.1, place);
            let near = Distances::new(&volume, 0.1).near(place);
            prop_assert!((near - half_side).abs() <= 0.6, "{} for {}", near, half_side);
        }

        /// Anywhere in the voxels' cubes, dense or thin.
        #[test]
        fn the_box_round_any_place_is_that_of_the_paper(
            volume in volumes(), place in prop::array::uniform3(0.0f32..1.0),
            threshold in prop_oneof![Just(0.1f32), 0.0f32..2.0],
        ) {
            let size = volume.size();
            let place = Vec3::from_array(std::array::from_fn(|i| place[i] * size[i] as f32 - 0.5));
            let found = Distances::new(&volume, threshold).half_side(place);
            prop_assert_eq!(found, half_side(&volume, threshold, place));
        }
    }

    #[test]
    fn a_lone_voxel_has_distance_one_and_a_full_grid_reaches_its_border() {
        let lone = volume([1, 1, 1], vec![1.0]);
        assert_eq!(Distances::new(&lone, 0.5).at([0, 0, 0]), 1);
        let full = Distances::new(&volume([5, 5, 9], vec![1.0; 225]), 0.5);
        assert_eq!(full.at([2, 2, 4]), 3);
        assert_eq!(full.at([2, 2, 9]), 0);
        assert_eq!(full.dense_count(), 225);
    }

    #[test]
    fn nothing_is_dense_in_nothing_and_above_no_number() {
        let empty = Distances::new(&volume([3, 0, 2], vec![]), 0.0);
        assert_eq!((empty.dense_count(), empty.near(Vec3::ZERO)), (0, 0.0));
        assert!(!empty.is_dense(Vec3::ZERO));
        let full = volume([2, 2, 2], vec![1.0; 8]);
        for threshold in [f32::NAN, f32::INFINITY, 1.0] {
            assert_eq!(Distances::new(&full, threshold).dense_count(), 0);
        }
        let distances = Distances::new(&full, f32::NEG_INFINITY);
        assert_eq!(distances.dense_count(), 8);
        assert_eq!(distances.near(Vec3::splat(f32::NAN)), 0.0);
        assert_eq!(distances.half_side(Vec3::splat(f32::NAN)), 0.0);
        assert_eq!(empty.half_side(Vec3::ZERO), 0.0);
        assert_eq!(distances.half_side(Vec3::splat(9.0)), 0.0);
    }

    #[test]
    fn the_result_does_not_depend_on_the_threads() {
        let density = (0..64 * 50 * 40).map(|i| (i * 7919 % 31) as f32);
        let volume = volume([64, 50, 40], density.collect());
        let of = |threads| in_pool(threads, || Distances::new(&volume, 1.5));
        assert_eq!(of(1), of(8));
    }
}
