// vector.size_work: turns the length of a list into the indirect arguments of all passes that work on it.
//
// Lengths beyond the room count as the room. Workgroups past 65535 come in rows. Rounds of ranking that would change
// nothing get no workgroups.
//
// Source  Jiang et al. 2022, indirect dispatches
// Twin    npr_vector::rank::work::size_work
//
//# use lib/grid
//# use lib/list

const RUN: u32 = 8u;
const BLOCK: u32 = 512u;
const BLOCKS_IN_ROW: u32 = 8191u;

struct Arguments {
    x: u32,
    y: u32,
    z: u32,
    w: u32,
}

struct WorkRule {
    room: u32,
    level_count: u32,
    round_count: u32,
    vertices: u32,
}

@group(0) @binding(0) var<uniform> rule: WorkRule;
@group(0) @binding(1) var<storage, read> extent: array<u32>;
@group(0) @binding(2) var<storage, read_write> arguments: array<Arguments>;

// Workgroups in x and y that sum up a number of elements, at least one, in rows of equal width.
fn sum_groups(element_count: u32) -> vec2<u32> {
    let whole = element_count / BLOCK;
    let blocks = max(whole + select(0u, 1u, element_count % BLOCK != 0u), 1u);
    let rows = (blocks + BLOCKS_IN_ROW - 1u) / BLOCKS_IN_ROW;
    return vec2<u32>((blocks + rows - 1u) / rows, rows);
}

// Workgroups for a number of elements: those of the blocks that hold them.
fn element_groups(element_count: u32) -> vec2<u32> {
    return sum_groups(element_count) * vec2<u32>(RUN, 1u);
}

// Workgroups that sum up a level: the elements, the sums of their blocks, and so on.
fn groups_of_level(count: u32, level: u32) -> vec2<u32> {
    var groups = sum_groups(count);
    for (var above = 0u; above < level; above++) { groups = sum_groups(groups.x * groups.y); }
    return groups;
}

// How many of the planned rounds are run; odd or even as planned, so that the result is in the same buffer.
fn rounds_run(round_count: u32, count: u32) -> u32 {
    let needed = max(rounds_for(count), 1u);
    let run = needed + ((needed ^ round_count) & 1u);
    return min(run, round_count);
}

// One invocation per pass.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&arguments) { return; }

    let count = min(extent[0], rule.room);
    let last_level = rule.level_count;
    let last_round = last_level + rule.round_count;
    var sized: Arguments;
    sized.z = 1u;
    sized.w = 0u;
    if element == 0u {
        let groups = element_groups(count);
        sized.x = groups.x;
        sized.y = groups.y;
    } else if element <= last_level {
        let groups = groups_of_level(count, element - 1u);
        sized.x = groups.x;
        sized.y = groups.y;
    } else if element <= last_round {
        let is_run = element - last_level - 1u < rounds_run(rule.round_count, count);
        let groups = element_groups(count);
        sized.x = select(0u, groups.x, is_run);
        sized.y = groups.y;
    } else {
        sized.x = count * rule.vertices;
        sized.y = 1u;
        sized.z = 0u;
    }
    arguments[element] = sized;
}
