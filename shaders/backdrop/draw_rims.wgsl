// backdrop.draw_rims: the outline of method `rim`, one pixel wide and outside of the shape.
//
// Source  Tsuji 2014, section 2.3
// Twin    npr_style::backdrop::draw_rims
//
//# use lib/grid
//# use lib/geometry

@group(0) @binding(0) var<storage, read> parts: array<Part>;
@group(0) @binding(1) var<storage, read> rims: array<Rim>;
@group(0) @binding(2) var<storage, read_write> overlay: array<u32>;

//# use lib/backdrop

fn rim_texel(rim: Rim) -> u32 {
    if (rim.subject & RIM_OUTSIDE) == 0u { return 0u; }
    if (parts[rim.part].flags & PART_LINES) == 0u { return 0u; }
    return pack_rgba8(parts[rim.part].line_color);
}

// One invocation per output pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&overlay) { return; }
    overlay[element] = rim_texel(rims[element]);
}
