//! The number of workgroups for passes over a list whose length only the device knows.
//!
//! Room for a list is made before it is known how long it gets. A device that reads the length itself can start as
//! many workgroups as the list needs instead of as many as fit its room: an indirect dispatch takes its size from a
//! buffer, and [`size_work`] fills that buffer once for all passes that follow the same length.
//!
//! Passes work on whole blocks of sums, and on one at least. Over a list of n elements they do, to the bit, what they
//! would do if the room ended with the last of these blocks; elements after it keep their values.

use super::rounds_for;
use super::scan::{BLOCK, RUN};
use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;

/// Most workgroups along one dimension, by WebGPU's limits.
pub const MAX_GROUPS: u32 = 65535;

/// Most blocks in a row of workgroups: passes over their elements take [`RUN`] workgroups for each.
pub const BLOCKS_IN_ROW: u32 = 8191;
const _: () = assert!(BLOCKS_IN_ROW == MAX_GROUPS / RUN as u32);

/// What a device reads when a pass starts: the size of a dispatch, or of a draw.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Arguments {
    /// Workgroups along x; vertices of a draw.
    pub x: u32,
    /// Rows of workgroups; instances of a draw.
    pub y: u32,
    /// Workgroups along z, which is 1; the first vertex of a draw, which is 0.
    pub z: u32,
    /// The first instance of a draw, which is 0.
    pub w: u32,
}
gpu_layout!(Arguments { x, y, z, w });

impl Arguments {
    /// A dispatch of workgroups in rows.
    pub fn of_groups([x, y]: [u32; 2]) -> Self {
        Self { x, y, z: 1, w: 0 }
    }

    /// A draw of one instance.
    pub fn of_vertices(count: u32) -> Self {
        Self {
            x: count,
            y: 1,
            z: 0,
            w: 0,
        }
    }
}

/// Which arguments a list needs, in this order: for elements, for levels of sums, for rounds of ranking, for a draw.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct WorkRule {
    /// Number of elements that there is room for.
    pub room: u32,
    /// Number of dispatches that sum up the elements, the sums of their blocks, the sums of these, and so on.
    pub level_count: u32,
    /// Number of dispatches over the elements in rounds of pointer jumping; rounds that are not needed are empty.
    pub round_count: u32,
    /// Number of vertices drawn for an element; with 0 there is no draw.
    pub vertices: u32,
}
gpu_layout!(WorkRule {
    room,
    level_count,
    round_count,
    vertices,
});

impl WorkRule {
    /// The rule for a room, with a level for every step of [`exclusive_scan`](super::scan::exclusive_scan).
    pub fn of_room(room: usize) -> Self {
        let (mut level_count, mut count) = (1, room);
        while count > BLOCK {
            count = count.div_ceil(BLOCK);
            level_count += 1;
        }
        Self {
            room: u32::try_from(room).unwrap_or(u32::MAX),
            level_count,
            ..Self::default()
        }
    }

    /// Number of [`Arguments`] that the rule asks for.
    pub fn argument_count(&self) -> usize {
        (1 + self.level_count + self.round_count + u32::from(self.vertices > 0)) as usize
    }
}

/// Workgroups in x and y that sum up a number of elements, at least one: rows of equal width, so few are left over.
///
/// ```
/// use npr_vector::rank::work::{BLOCKS_IN_ROW, sum_groups};
/// assert_eq!(sum_groups(0), [1, 1]);
/// assert_eq!(sum_groups(513), [2, 1]);
/// assert_eq!(sum_groups(BLOCKS_IN_ROW * 512 + 1), [4096, 2]);
/// ```
pub fn sum_groups(element_count: u32) -> [u32; 2] {
    let blocks = element_count.div_ceil(BLOCK as u32).max(1);
    let rows = blocks.div_ceil(BLOCKS_IN_ROW);
    [blocks.div_ceil(rows), rows]
}

/// Workgroups in x and y for a number of elements, one invocation for each: those of the blocks that hold them.
pub fn element_groups(element_count: u32) -> [u32; 2] {
    let [x, y] = sum_groups(element_count);
    [x * RUN as u32, y]
}

/// How many of the planned rounds of pointer jumping are run where `count` elements jump.
///
/// More than [`rounds_for`] of them change nothing. Two buffers alternate, so the number of rounds run is odd or even
/// as the planned number is: otherwise the result would be in the other buffer.
pub fn rounds_run(round_count: u32, count: u32) -> u32 {
    let needed = rounds_for(count as usize).max(1);
    let run = needed + (needed ^ round_count) % 2;
    run.min(round_count)
}

/// Makes the arguments of all passes that follow a list's length, `extent[0]`: the twin of `vector.size_work`.
///
/// Lengths beyond the room count as the room. O(arguments).
pub fn size_work(rule: &WorkRule, extent: &[u32], arguments: &mut [Arguments]) {
    let count = extent[0].min(rule.room);
    let (last_level, last_round) = (rule.level_count, rule.level_count + rule.round_count);
    for (index, into) in (0..).zip(arguments) {
        *into = if index == 0 {
            Arguments::of_groups(element_groups(count))
        } else if index <= last_level {
            Arguments::of_groups(groups_of_level(count, index - 1))
        } else if index <= last_round {
            let is_run = index - last_level - 1 < rounds_run(rule.round_count, count);
            let [x, y] = element_groups(count);
            Arguments::of_groups([if is_run { x } else { 0 }, y])
        } else {
            Arguments::of_vertices(count.wrapping_mul(rule.vertices))
        };
    }
}

/// Workgroups that sum up a level: the elements, the sums of their blocks, and so on.
fn groups_of_level(count: u32, level: u32) -> [u32; 2] {
    let mut groups = sum_groups(count);
    for _ in 0..level {
        groups = sum_groups(groups[0] * groups[1]);
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_rule_has_a_level_for_every_step_of_a_scan() {
        for (room, levels) in [
            (0, 1),
            (1, 1),
            (512, 1),
            (513, 2),
            (1 << 18, 2),
            ((1 << 18) + 1, 3),
            (1 << 28, 4),
        ] {
            assert_eq!(WorkRule::of_room(room).level_count, levels, "{room}");
        }
    }

    #[test]
    fn arguments_come_level_by_level_then_round_by_round_then_the_draw() {
        let rule = WorkRule {
            round_count: 5,
            vertices: 3,
            ..WorkRule::of_room(5000)
        };
        let made = |count: u32| {
            let mut arguments = vec![Arguments::default(); rule.argument_count()];
            size_work(&rule, &[count], &mut arguments);
            arguments
        };
        let groups = |x| Arguments::of_groups([x, 1]);
        let vertices = Arguments::of_vertices;
        let (one, none) = (groups(1), groups(0));
        let eight = groups(8);
        assert_eq!(
            made(0),
            [eight, one, one, eight, none, none, none, none, vertices(0)]
        );
        // Two elements settle in a round, four in two, and an odd number of rounds is run.
        assert_eq!(made(2)[3..8], [eight, none, none, none, none]);
        assert_eq!(made(4)[3..8], [eight, eight, eight, none, none]);
        let (level, full) = (groups(10), groups(80));
        assert_eq!(
            made(5000),
            [
                full,
                level,
                one,
                full,
                full,
                full,
                full,
                full,
                vertices(15000)
            ]
        );
        assert_eq!(made(u32::MAX), made(5000));
    }

    proptest! {
        #[test]
        fn workgroups_hold_all_elements_and_hardly_more(count in any::<u32>()) {
            let [x, y] = sum_groups(count).map(u64::from);
            let wanted = u64::from(count).div_ceil(512).max(1);
            prop_assert!(x * y >= wanted && x * y < wanted + y);
            // Passes over elements and sums of them work on the same elements.
            let [across, down] = element_groups(count).map(u64::from);
            prop_assert!(across.max(down) <= u64::from(MAX_GROUPS));
            prop_assert_eq!(across * down * 64, x * y * 512);
        }

        #[test]
        fn rounds_stop_in_the_buffer_in_which_all_would(planned in 0u32..33, count in any::<u32>()) {
            let run = rounds_run(planned, count);
            prop_assert!(run <= planned && (planned - run).is_multiple_of(2));
            prop_assert!(run == planned || run >= rounds_for(count as usize).max(1));
        }
    }
}
