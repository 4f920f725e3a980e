// vector.emit_fragments: places every fragment of every segment.
//
// A fragment finds its segment by searching the scan of their counts.
//
// Source  Jiang et al. 2022, line rasterisation, second pass
// Twin    npr_vector::pixel_strokes::fragment::emit_fragments
//
//# use lib/grid
//# use lib/pixel

@group(0) @binding(0) var<uniform> view: PixelView;
@group(0) @binding(1) var<storage, read> extent: array<u32>;
@group(0) @binding(2) var<storage, read> segment_count: array<u32>;
@group(0) @binding(3) var<storage, read> starts: array<u32>;
@group(0) @binding(4) var<storage, read> segments: array<Segment>;
@group(0) @binding(5) var<storage, read_write> fragments: array<Fragment>;

//# use lib/holder

fn pixel_along(place: f32, r: f32, size: u32) -> u32 {
    let step = floor(max(place, 0.0)) + 0.5;
    return min(u32(floor(rounded(view, step * r))), size - 1u);
}

// One invocation per fragment.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&fragments) { return; }

    fragments[element].pixel = NONE;
    if element >= extent[0] { return; }
    let number = holder_of(element, segment_count[0]);
    let segment = segments[number];
    let step = element - starts[number];
    let extent_px = vec2<f32>(
        rounded(view, segment.end.x - segment.start.x),
        rounded(view, segment.end.y - segment.start.y),
    );
    let is_x_major = abs(extent_px.x) >= abs(extent_px.y);
    let start = select(segment.start.y, segment.start.x, is_x_major);
    let length = select(extent_px.y, extent_px.x, is_x_major);
    let sign = select(1.0, -1.0, length < 0.0);
    let center = floor(start) + sign * f32(step) + 0.5;
    // A segment without length is its first point.
    var share = 0.0;
    if length != 0.0 {
        share = clamp(rounded(view, rounded(view, center - start) * reciprocal(view, length)), 0.0, 1.0);
    }
    let x = rounded(view, segment.start.x + rounded(view, extent_px.x * share));
    let y = rounded(view, segment.start.y + rounded(view, extent_px.y * share));
    let r = reciprocal(view, view.fine);
    let column = pixel_along(select(x, center, is_x_major), r, view.size.x);
    let row = pixel_along(select(center, y, is_x_major), r, view.size.y);
    let depth = rounded(view, rounded(view, segment.end_z - segment.start_z) * share);
    fragments[element].pixel = row * view.size.x + column;
    fragments[element].z = rounded(view, segment.start_z + depth);
    fragments[element].segment = number;
}
