// vector.test_fragments: whether each fragment shows, by the depths of the pixels around it, and which pixels have ink.
//
// Source  Jiang et al. 2022, soft visibility test
// Twin    npr_vector::pixel_strokes::fragment::test_fragments
//
//# use lib/grid
//# use lib/ink
//# use lib/pixel

@group(0) @binding(0) var<uniform> view: PixelView;
@group(0) @binding(1) var surfaces: texture_depth_2d;
@group(0) @binding(2) var occluder_depths: texture_2d<u32>;
@group(0) @binding(3) var<storage, read> fragments: array<Fragment>;
@group(0) @binding(4) var<storage, read_write> shown: array<u32>;
// A bit for each pixel, set where a fragment shows.
@group(0) @binding(5) var<storage, read_write> ink: array<atomic<u32>>;

// Reversed depth of the surface that hides lines at a pixel; occluder depths of another size than the picture count as
// none.
fn hidden_behind(at: vec2<u32>) -> f32 {
    let z = textureLoad(surfaces, at, 0);
    if any(textureDimensions(occluder_depths) != textureDimensions(surfaces)) { return z; }
    return max(z, bitcast<f32>(textureLoad(occluder_depths, at, 0).x));
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

    shown[element] = 0u;
    let fragment = fragments[element];
    if fragment.pixel == NONE { return; }
    let at = pixel_of(fragment.pixel, view.size);
    let depth = depth_of(view, fragment.z);
    var count = 0u;
    for (var y = max(at.y, 1u) - 1u; y < min(at.y + 2u, view.size.y); y++) {
        for (var x = max(at.x, 1u) - 1u; x < min(at.x + 2u, view.size.x); x++) {
            let z = hidden_behind(vec2<u32>(x, y));
            let is_free = z <= 0.0 || depth <= rounded(view, depth_of(view, z) + view.tolerance);
            count += select(0u, 1u, is_free);
        }
    }
    if count < view.least_visible { return; }
    shown[element] = 1u;
    atomicOr(&ink[fragment.pixel / BITS_A_WORD], 1u << (fragment.pixel % BITS_A_WORD));
}
