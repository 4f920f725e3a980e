// stroke.ink_samples: points of ink of the visible parts of lines, one for every two samples.
//
// Widths follow the part: thinner at free ends and where it is short, pressed along it.
//
// Twin    npr_vector::sampled::ink_samples
//
//# use lib/grid
//# use lib/geometry
//# use lib/window
//# use lib/spine
//# use lib/ink_point

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> widths: PartWidths;
@group(0) @binding(2) var<storage, read> lines: array<SampledLine>;
@group(0) @binding(3) var<storage, read> samples: array<SpineSample>;
@group(0) @binding(4) var<storage, read> gaps: array<f32>;
@group(0) @binding(5) var<storage, read> visible: array<u32>;
@group(0) @binding(6) var<storage, read> part_slots: array<u32>;
@group(0) @binding(7) var<storage, read> part_firsts: array<u32>;
@group(0) @binding(8) var<storage, read_write> points: array<InkPoint>;

const JUNCTION: f32 = 6.0;
const BEYOND: u32 = 3u;

// The first sample of the part that holds a sample, and the one after its last.
fn part_of(sample: u32) -> vec2<u32> {
    // As many parts start before the sample; it may itself start one.
    let before = part_slots[sample];
    let starts = before < arrayLength(&part_firsts) && part_firsts[before] == sample;
    let part = select(before - 1u, before, starts);
    let first = part_firsts[part];
    let line = lines[samples[sample].line];
    var end = line.first + line.count;
    // Behind the last part there is none.
    let next = part + 1u;
    if next < arrayLength(&part_firsts) && part_firsts[next] > first { end = min(end, part_firsts[next]); }
    return vec2<u32>(first, end);
}

// The sample that a point stands for; NONE where both of its samples are hidden.
fn chosen(index: u32) -> u32 {
    let first = 2u * index;
    let second = first + 1u;
    if second >= arrayLength(&samples) { return NONE; }
    let seen = vec2<bool>(visible[first] != 0u, visible[second] != 0u);
    if all(seen) {
        // A part that ends here ends with its last sample; one that also begins here is a speck.
        let part = part_of(second);
        return select(first, second, part.y == second + 1u && part.x < first);
    }
    if seen.x { return first; }
    return select(NONE, second, seen.y);
}

fn greatest_gap(first: u32, end: u32) -> f32 {
    var most = 0.0;
    for (var sample = first; sample < end; sample++) { most = max(most, gaps[sample]); }
    return most;
}

// Whether no other line meets the start and the end of a part.
fn free_ends(line: SampledLine, part: vec2<u32>) -> vec2<bool> {
    let line_end = line.first + line.count;
    var free = vec2<bool>((line.bits & LINE_START_FREE) != 0u, (line.bits & LINE_END_FREE) != 0u);
    if part.x != line.first {
        free.x = greatest_gap(part.x - min(BEYOND, part.x - line.first), part.x) < JUNCTION;
    }
    if part.y != line_end { free.y = greatest_gap(part.y, min(part.y + BEYOND, line_end)) < JUNCTION; }
    return free;
}

// Factor on the width at a share of a part's length from its start, by even steps.
fn pressed(of_line: u32, share: f32) -> f32 {
    let place = clamp(share, 0.0, 1.0) * 31.0;
    let stop = min(u32(place), 30u);
    let low = widths.all[of_line].along[stop / 4u][stop % 4u];
    let high = widths.all[of_line].along[(stop + 1u) / 4u][(stop + 1u) % 4u];
    return low + (high - low) * (place - f32(stop));
}

// Share of the width at a distance from an end over which a part thins out.
fn tapered(tip: f32, from_end: f32, reach: f32) -> f32 {
    let share = clamp(from_end / reach, 0.0, 1.0);
    return tip + (1.0 - tip) * share * (2.0 - share);
}

fn factor_at(line: SampledLine, part: vec2<u32>, along: f32, length: f32, is_whole: bool) -> f32 {
    // Thin out what is short and meets no other line.
    let is_ring = is_whole && (line.bits & LINE_CLOSED) != 0u;
    let free = free_ends(line, part);
    let of_line = line.bits >> LINE_WIDTH_SHIFT;
    let short_px = widths.all[of_line].short_px;
    var factor = 1.0;
    if (is_ring || all(free)) && length < short_px { factor = max(2.0 * length / short_px - 1.0, 0.0); }
    if is_ring { return factor; }

    // Thin out free ends, and press along the part.
    let most = min(widths.all[of_line].taper_share, 0.5) * length;
    let reach = min(widths.all[of_line].taper_px, vec2<f32>(most));
    let everywhere = widths.all[of_line].at_all_ends != 0u;
    let tip = widths.all[of_line].tip;
    var taper = 1.0;
    if reach.x > 0.0 && (free.x || everywhere) { taper = min(taper, tapered(tip, along, reach.x)); }
    if reach.y > 0.0 && (free.y || everywhere) { taper = min(taper, tapered(tip, length - along, reach.y)); }
    return factor * taper * pressed(of_line, along / max(length, 1e-6));
}

// One invocation per point.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&points) { return; }
    var point: InkPoint;
    points[element] = point;

    // Choose the sample, and see whether the stroke goes on to the next point.
    let own = chosen(element);
    if own == NONE { return; }
    let part = part_of(own);
    let next = chosen(element + 1u);
    var goes_on = false;
    if next != NONE { goes_on = all(part_of(next) == part); }

    // Leave out specks, and what has no width.
    let sample = samples[own];
    let line = lines[sample.line];
    let length = f32(part.y - 1u - part.x) * line.step_px;
    let is_whole = all(part == vec2<u32>(line.first, line.first + line.count));
    let along = f32(own - part.x) * line.step_px;
    let half_width = sample.half_width * factor_at(line, part, along, length, is_whole);
    let speck_px = widths.all[line.bits >> LINE_WIDTH_SHIFT].speck_px;
    if (length < speck_px && !is_whole) || half_width <= 0.0 { return; }

    // Lay the image of the brush on it.
    let from_start = f32(own - line.first) * line.step_px;
    let once = (line.bits & LINE_ONCE) != 0u;
    point.px = sample.px;
    point.half_width = half_width;
    point.nearness = nearness_of(view, sample.depth);
    point.color = sample.color;
    point.flags = line.ink_flags | select(0u, INK_GOES_ON | INK_JOINED, goes_on);
    point.u = select(line.u_start + from_start * line.u_per_px, along / max(length, 1e-6), once);
    point.pressure = sqrt(clamp(half_width / max(line.full_half_width, 1e-6), 0.0, 1.0));
    points[element] = point;
}
