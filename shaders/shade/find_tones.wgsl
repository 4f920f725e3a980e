// shade.find_tones: the tone of every pixel whose part has hard steps between tones, at the first of its samples.
//
// Source  Suzuki 2004, section 3.2, for the ramp
// Twin    npr_style::even_tones::find_tones
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface
//# use lib/window
//# use lib/color
//# use lib/compose
//# use lib/triangle_constants

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<uniform> compose: Compose;
@group(0) @binding(3) var<uniform> lights: Lights;
@group(0) @binding(4) var ids: texture_2d<u32>;
@group(0) @binding(5) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(6) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(7) var<storage, read> triangles: array<TriangleConstants>;
@group(0) @binding(8) var<storage, read> parts: array<Part>;
@group(0) @binding(9) var<storage, read> texels: array<u32>;
@group(0) @binding(10) var shadows: texture_2d_array<u32>;
@group(0) @binding(11) var smoke_shadows: texture_depth_2d_array;
@group(0) @binding(12) var<storage, read_write> tone_map: array<u32>;

//# use lib/texture
//# use lib/samples
//# use lib/four
//# use lib/surface_color
//# use lib/surface_light
//# use lib/hull
//# use lib/sky
//# use lib/shadow
//# use lib/tone_word
//# use lib/ink_step
//# use lib/ink_level

// Steps that the light of a triangle has passed at a sample of the pixel whose middle is at `px`.
fn steps_at(id: u32, constants: TriangleConstants, sample: u32, px: vec2<f32>) -> u32 {
    let corners = corners_of(triangle_of(constants));
    let at = px + sample_offset(sample);
    let weights = weights_at(corners.clip, ndc_at(view, at));
    let dark = shadowed(id, corners, weights);
    let open = open_at(openness(corners, at), vec2<f32>(0.0));
    let lit = coordinate_under(world_of(corners, weights), normal_of(corners, weights), dark, open);
    let part = constants.part;
    return min(ramp_steps(part, lit.x) + select(0u, 1u, ink_step(part) <= lit.x), TONES - 1u);
}

// Word of the tone map of a pixel; 0 where nothing is to be evened.
fn tone_word(pixel: vec2<u32>) -> u32 {
    // Take parts whose tones are evened.
    let seen = ids_at(pixel);
    let id = seen.x;
    if id == 0u || is_of_hull(id) { return 0u; }
    let part = triangles[id - 1u].part;
    if parts[part].tone_reach_px == 0.0 { return 0u; }

    // Look at the middle of the pixel what a hatch that is cut out is there.
    let px = frame_at(window, pixel);
    if is_cut(part) { return ((part + 1u) << ALL_TONE_BITS) | (cut_tone_at(id, triangles[id - 1u], px) * FOUR_TONES); }

    // Count the steps at every sample that shows another triangle of the part.
    var first = 0u;
    var word = 0u;
    for (var sample = 0u; sample < sample_count(); sample++) {
        let other = number_of(seen, sample);
        if other == 0u || is_of_hull(other) || (sample > 0u && other == id) { continue; }
        let constants = triangles[other - 1u];
        if constants.part != part { continue; }
        let steps = steps_at(other, constants, sample, px);
        if sample == 0u {
            first = steps;
            word = ((part + 1u) << ALL_TONE_BITS) | (first * FOUR_TONES);
        }
        word ^= (first ^ steps) << (sample * TONE_BITS);
    }
    return word;
}

// One invocation per output pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&tone_map) { return; }
    tone_map[element] = tone_word(pixel_of(element, window.size));
}
