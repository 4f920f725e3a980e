// shade.fill_frame: fills the pixels that show one known colour and nothing over it, and lists the others.
//
// Few pixels are left: those with lines, smoke or beams, with edges of tones, or with more than one colour.
//
// Source  Suzuki 2004, section 3.2
// Twin    npr_style::compose::fill
//
//# use lib/grid
//# use lib/geometry
//# use lib/window
//# use lib/color
//# use lib/compose
//# use lib/triangle_constants

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> compose: Compose;
@group(0) @binding(2) var ids: texture_2d<u32>;
@group(0) @binding(3) var beam_ids: texture_2d<u32>;
@group(0) @binding(4) var ribbons: texture_2d<f32>;
@group(0) @binding(5) var smoke_depths: texture_2d<u32>;
@group(0) @binding(6) var fronts: texture_2d<f32>;
@group(0) @binding(7) var<storage, read> known: array<TriangleConstants>;
@group(0) @binding(8) var<storage, read_write> frame: array<u32>;
@group(0) @binding(9) var<storage, read_write> list: array<atomic<u32>>;
@group(0) @binding(10) var<storage, read> parts: array<Part>;
@group(0) @binding(11) var evened: texture_2d<u32>;

//# use lib/samples
//# use lib/ribbon_layer
//# use lib/overlay_layer
//# use lib/smoke_cover
//# use lib/beam_ids
//# use lib/hull
//# use lib/left_out
//# use lib/settled_tone

// One colour as an sRGB texel, if it is known.
struct Known {
    is_so: bool,
    texel: u32,
}

// The colour that triangle `id` has all over, the background for 0.
fn known_texel(id: u32) -> Known {
    if id == 0u { return Known(compose.background_texture == NONE, compose.background_texel); }
    if is_of_hull(id) { return Known(false, 0u); }
    let bits = known[id - 1u].bits;
    return Known((bits & KNOWN_WHOLE) != 0u, (bits >> KNOWN_BYTES) | 0xff000000u);
}

// The colour of a pixel whose samples all show the same one.
fn filled(pixel: vec2<u32>, element: u32) -> Known {
    let seen = ids_at(pixel);
    let first = known_texel(seen.x);
    let lined = (ribbon_texel(pixel) | overlay_texel(element)) >> 24u;
    if !first.is_so || lined != 0u || has_smoke(pixel) || has_beams(pixel) { return Known(false, 0u); }
    if !is_settled(pixel, seen) { return Known(false, 0u); }
    if compose.samples == 1u || all(seen == vec4<u32>(seen.x)) { return first; }
    let b = known_texel(seen.y);
    let c = known_texel(seen.z);
    let d = known_texel(seen.w);
    let are_known = b.is_so && c.is_so && d.is_so;
    return Known(are_known && all(vec3<u32>(b.texel, c.texel, d.texel) == vec3<u32>(first.texel)), first.texel);
}

// One invocation per output pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&frame) { return; }

    let pixel = pixel_of(element, window.size);
    if is_left_out(pixel) {
        frame[element] = 0u;
        return;
    }
    let shown = filled(pixel, element);
    if shown.is_so {
        frame[element] = shown.texel;
    } else {
        atomicStore(&list[atomicAdd(&list[0], 1u) + 1u], element);
    }
}
