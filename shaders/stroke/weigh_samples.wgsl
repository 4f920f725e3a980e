// stroke.weigh_samples: whether each sample is visible by most of the samples around it, and whether that is clear.
//
// Source  Cole & Finkelstein 2010, filtering along the line
// Twin    npr_vector::sampled::weigh_samples
//
//# use lib/grid
//# use lib/spine

@group(0) @binding(0) var<uniform> widths: PartWidths;
@group(0) @binding(1) var<storage, read> samples: array<SpineSample>;
@group(0) @binding(2) var<storage, read> lines: array<SampledLine>;
@group(0) @binding(3) var<storage, read> gaps: array<f32>;
@group(0) @binding(4) var<storage, read_write> verdicts: array<u32>;
@group(0) @binding(5) var<storage, read_write> clear: array<u32>;

const CLEARLY_VISIBLE: f32 = 0.6;
const CLEARLY_HIDDEN: f32 = 0.4;
const EVEN_SHARE: f32 = 0.5;

// One invocation per sample.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&samples) { return; }

    let line = lines[samples[element].line];
    let radius = widths.all[line.bits >> LINE_WIDTH_SHIFT].radius;
    let first = element - min(radius, element - line.first);
    let last = element + min(radius, line.first + line.count - 1u - element);
    var sum = 0.0;
    for (var near = first; near <= last; near++) {
        sum += select(1.0, 0.0, gaps[near] > 0.0);
    }
    let count = f32(last - first + 1u);
    let is_clear = sum >= CLEARLY_VISIBLE * count || sum < CLEARLY_HIDDEN * count;
    verdicts[element] = select(0u, 1u, sum >= EVEN_SHARE * count);
    clear[element] = select(0u, 1u, is_clear || element == line.first);
}
