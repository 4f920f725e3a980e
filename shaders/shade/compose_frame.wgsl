// shade.compose_frame: surfaces shaded by their ramps, ink and lines over them, background behind.
//
// Several samples per pixel say which triangles it shows; each triangle is shaded once,
// at the middle of its samples, or at each of them where its tone has edges.
// Light is summed linearly and encoded at the end.
//
// Source  Suzuki 2004, sections 3.2 and 3.3, for ramp, ink and hatching; Porter & Duff 1984 for the layers
// Twin    npr_style::compose::compose
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface
//# use lib/window
//# use lib/color
//# use lib/compose
//# use lib/triangle_constants
//# use lib/backdrop

override WG: u32 = 64u;

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<uniform> compose: Compose;
@group(0) @binding(3) var<uniform> lights: Lights;
@group(0) @binding(4) var ids: texture_2d<u32>;
@group(0) @binding(5) var beam_ids: texture_2d<u32>;
@group(0) @binding(6) var ribbons: texture_2d<f32>;
@group(0) @binding(7) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(8) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(9) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(10) var<storage, read> parts: array<Part>;
@group(0) @binding(11) var<storage, read> texels: array<u32>;
@group(0) @binding(12) var<storage, read> charts: array<ChartCorners>;
@group(0) @binding(13) var<storage, read> known: array<TriangleConstants>;
@group(0) @binding(14) var<storage, read_write> frame: array<u32>;
@group(0) @binding(15) var shadow_0: texture_2d<u32>;
@group(0) @binding(16) var shadow_1: texture_2d<u32>;
@group(0) @binding(17) var shadow_2: texture_2d<u32>;
@group(0) @binding(18) var shadow_3: texture_2d<u32>;
@group(0) @binding(19) var smoke_colors: texture_2d<f32>;
@group(0) @binding(20) var smoke_depths: texture_2d<u32>;
@group(0) @binding(21) var smoke_shadow_0: texture_depth_2d;
@group(0) @binding(22) var smoke_shadow_1: texture_depth_2d;
@group(0) @binding(23) var smoke_shadow_2: texture_depth_2d;
@group(0) @binding(24) var smoke_shadow_3: texture_depth_2d;
@group(0) @binding(25) var<uniform> rules: Rules;
@group(0) @binding(26) var fronts: texture_2d<f32>;
@group(0) @binding(27) var backs: texture_2d<f32>;

//# use lib/texture
//# use lib/samples
//# use lib/four
//# use lib/surface_color
//# use lib/surface_light
//# use lib/hull
//# use lib/surface_line
//# use lib/grazing
//# use lib/ink_tone
//# use lib/inking
//# use lib/gloss
//# use lib/sky
//# use lib/shadow
//# use lib/smoke_layer
//# use lib/beam
//# use lib/contrast
//# use lib/ribbon_layer
//# use lib/overlay_layer

// Width of a tone step from which on it is so gentle that one place of a pixel stands for all.
const GENTLE: f32 = 0.25;

// Whether light changes so gently over a part that one place of a pixel stands for all.
fn is_gentle(part: u32) -> bool {
    return lights.shadow_side == 0u
        && (parts[part].flags & (PART_ANGLE | PART_TONE_ROW)) == 0u
        && (parts[part].softness >= GENTLE || parts[part].ramp[1].a > 1.5);
}

// Light of the samples in `members` on a triangle, and the share of it that a line covers.
struct Drawn {
    light: vec3<f32>,
    lined: f32,
}

// The middle of the samples in `members` of a pixel.
fn middle_of(members: u32, frame_px: vec2<f32>) -> vec2<f32> {
    let share = f32(countOneBits(members));
    var center = frame_px;
    for (var i = 0u; i < sample_count(); i++) {
        if (members & (1u << i)) != 0u { center += sample_offset(i) / share; }
    }
    return center;
}

// Light of the samples in `members`, which show a triangle or its hull.
fn shade(id: u32, members: u32, frame_px: vec2<f32>) -> vec3<f32> {
    let triangle = triangles[(id & ID_MASK) - 1u];
    let corners = corners_of(triangle);
    let is_hull = is_of_hull(id);
    var drawn: Drawn;
    drawn.lined = 1.0;
    var center = frame_px;
    while !is_hull {
        center = middle_of(members, frame_px);
        drawn = shade_surface(id, members, frame_px, center, corners);
        break;
    }
    while drawn.lined != 0.0 {
        let line = contrasted(line_light(triangle, corners, center, vec2<f32>(1.0), is_hull), frame_px);
        return drawn.light + (line - drawn.light) * drawn.lined;
    }
    return drawn.light;
}

// Light of a triangle; `center` is the middle of its samples.
fn shade_surface(id: u32, members: u32, frame_px: vec2<f32>, center: vec2<f32>, corners: Corners) -> Drawn {
    // Take what is known of the triangle, and find the colour of the surface where it is not.
    let triangle = triangles[id - 1u];
    let part = triangle.part;
    let constants = known[id - 1u];
    let is_plain = (constants.bits & KNOWN_PLAIN) != 0u;
    var is_even = (constants.bits & KNOWN_EVEN) != 0u;
    var color = constants.color;
    while !is_plain {
        color = strengthened(base_color(triangle, corners, center));
        break;
    }

    // Light it at its middle where one place stands for all samples.
    var light = select(vec3<f32>(0.0), select(constants.color, vec3<f32>(1.0), is_plain), is_even);
    var open: SkyPoint;
    if !is_even { open = openness(corners, center); }
    if !is_even && is_gentle(part) {
        let weights = weights_at(corners.clip, ndc_at(view, center));
        light = light_of(part, world_of(corners, weights), normal_of(corners, weights), 0u, open_at(open, vec2<f32>(0.0)));
        is_even = true;
    }

    // Else light it at its samples, and find highlights and shadows there.
    let shines = has_highlights(part) && (constants.bits & KNOWN_MATT) == 0u;
    let by_sample = !is_even || (shines && !shines_gently(part));
    let counted = select(members & (~members + 1u), members, by_sample);
    let share = 1.0 / f32(countOneBits(counted));
    var gloss = vec3<f32>(0.0);
    var lined = 0.0;
    var darks = vec4<u32>(0u);
    var left = select(0u, counted, !is_even || shines);
    while left != 0u {
        let i = firstTrailingBit(left);
        left &= left - 1u;
        let at = select(center, frame_px + sample_offset(i), by_sample);
        let weights = weights_at(corners.clip, ndc_at(view, at));
        let world = world_of(corners, weights);
        let normal = normal_of(corners, weights);
        var dark = 0u;
        if !is_even {
            dark = shadowed(id, corners, weights);
            light += light_of(part, world, normal, dark, open_at(open, at - center)) * share;
            lined += grazing(triangle, corners, at) * share;
        }
        if shines { gloss += highlights_at(part, world, normal, dark) * share; }
        darks[i] = dark;
    }

    // Lay ink over it, once for samples in the same shadows.
    let ink = mean_ink(id, corners, known_ink(constants), center, counted, darks);
    return Drawn(inked(part, color * light, ink) + gloss, lined);
}

// The surfaces of a pixel without the shares that smoke hides, premultiplied.
fn surfaces(pixel: vec2<u32>, smoke_layer: SmokeLayer, frame_px: vec2<f32>) -> vec4<f32> {
    let seen = ids_at(pixel);
    let bare = vec4<f32>(1.0) - smoke_layer.hidden;
    var sum = vec4<f32>(0.0);
    // Every triangle once, from the first of its samples on.
    var left = bits_of(seen != vec4<u32>(0u));
    while left != 0u {
        let id = of_sample(seen, firstTrailingBit(left));
        let members = seen == vec4<u32>(id);
        left &= ~bits_of(members);
        let share = sum_over(bare, members) / f32(sample_count());
        if share == 0.0 { continue; }
        // Shade it where its colour is not known whole: devices without branches skip loops alone.
        let constants = known[(id & ID_MASK) - 1u];
        var light = constants.color;
        while (constants.bits & KNOWN_WHOLE) == 0u || is_of_hull(id) {
            light = shade(id, bits_of(members), frame_px);
            break;
        }
        sum += vec4<f32>(light, 1.0) * share;
    }
    return sum;
}

// What lies behind everything, premultiplied.
fn background(frame_px: vec2<f32>) -> vec4<f32> {
    var color = compose.background;
    if compose.background_texture != NONE {
        let at = compose.background_texture;
        let size = vec2<f32>(f32(texels[at]), f32(texels[at + 1u]));
        // Cover the frame with the picture, centred and cut at two sides.
        let zoom = max(view.frame_px.x / size.x, view.frame_px.y / size.y);
        let uv = (frame_px - 0.5 * view.frame_px) / (size * zoom) + 0.5;
        color = sample_texture(at, uv, 1.0 / (max(size.x, size.y) * zoom));
    }
    return vec4<f32>(color.rgb * color.a, color.a);
}

// A straight-alpha layer laid over a premultiplied one.
fn over(top: vec4<f32>, below: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(top.rgb * top.a, top.a) + below * (1.0 - top.a);
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
    let frame_px = frame_at(window, pixel);
    let smoke_layer = smoke_layer_of(pixel, frame_px);
    var surface = surfaces(pixel, smoke_layer, frame_px);
    surface += vec4<f32>(smoke_layer.color.rgb, 1.0) * smoke_layer_shown(smoke_layer);
    var color = surface;
    if surface.a < 1.0 { color += background(frame_px) * (1.0 - surface.a); }
    let beams = add_beams(pixel, smoke_layer, frame_px, color);
    color = beams.color;
    for (var layer = 0u; layer < 2u; layer++) {
        var line = ribbon_at(pixel);
        if layer == 1u { line = overlay_at(element); }
        while line.a != 0.0 {
            let faded = line_fade(smoke_layer, pixel, frame_px);
            let alpha = line.a * (1.0 - beams.covered) * (1.0 - faded);
            color = over(vec4<f32>(contrasted(line.rgb, frame_px), alpha), color);
            break;
        }
    }
    let straight = color.rgb / max(color.a, 1e-6);
    frame[element] = pack_rgba8(vec4<f32>(
        srgb_from_linear(straight.r),
        srgb_from_linear(straight.g),
        srgb_from_linear(straight.b),
        color.a,
    ));
}
