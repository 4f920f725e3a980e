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

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var<uniform> compose: Compose;
@group(0) @binding(3) var<uniform> lights: Lights;
@group(0) @binding(4) var ids: texture_2d<u32>;
@group(0) @binding(5) var beam_ids: texture_2d<u32>;
@group(0) @binding(6) var ribbons: texture_2d<f32>;
@group(0) @binding(7) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(8) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(9) var<storage, read> triangles: array<TriangleConstants>;
@group(0) @binding(10) var<storage, read> parts: array<Part>;
@group(0) @binding(11) var<storage, read> texels: array<u32>;
@group(0) @binding(12) var charts: texture_2d<u32>;
@group(0) @binding(13) var<storage, read> list: array<u32>;
@group(0) @binding(14) var<storage, read_write> frame: array<u32>;
@group(0) @binding(15) var shadows: texture_2d_array<u32>;
@group(0) @binding(16) var smoke_colors: texture_2d<f32>;
@group(0) @binding(17) var smoke_depths: texture_2d<u32>;
@group(0) @binding(18) var smoke_shadows: texture_depth_2d_array;
@group(0) @binding(19) var<uniform> rules: Rules;
@group(0) @binding(20) var fronts: texture_2d<f32>;
@group(0) @binding(21) var backs: texture_2d<f32>;
@group(0) @binding(22) var evened: texture_2d<u32>;

//# use lib/texture
//# use lib/samples
//# use lib/four
//# use lib/surface_color
//# use lib/base_color
//# use lib/surface_light
//# use lib/even_tones
//# use lib/hull
//# use lib/surface_line
//# use lib/grazing
//# use lib/toon
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

// Whether light changes so gently over a part that one place of a pixel stands for all. The flags come last: with them
// ahead of the ramp, lavapipe of Mesa 22.3 crashes on frames with toons.
fn is_gentle(part: u32) -> bool {
    return lights.shadow_side == 0u
        && (parts[part].softness >= GENTLE || parts[part].ramp[1].a > 1.5)
        && (parts[part].flags & (PART_ANGLE | PART_TONE_ROW | PART_TOON)) == 0u;
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
fn shade(id: u32, constants: TriangleConstants, members: u32, frame_px: vec2<f32>) -> vec3<f32> {
    let triangle = triangle_of(constants);
    let corners = corners_of(triangle);
    let is_hull = is_of_hull(id);
    var drawn: Drawn;
    drawn.lined = 1.0;
    var center = frame_px;
    if !is_hull { center = middle_of(members, frame_px); }
    let is_toon_hull = is_hull && has_toon_line(triangle.part);
    // Light hulls of toons by the same code as surfaces: twice it takes too long to compile.
    let is_lit_hull = is_toon_hull && is_toon_line_lit(triangle.part);
    if !is_hull || is_lit_hull {
        drawn = shade_surface(id, triangle, constants, members, frame_px, center, corners, is_lit_hull);
    }
    if drawn.lined != 0.0 {
        var own = vec3<f32>(0.0);
        if is_toon_hull {
            own = toon_outline(triangle.part, drawn.light);
        } else {
            own = line_light(triangle, corners, center, vec2<f32>(1.0), is_hull);
        }
        let line = contrasted(own, frame_px);
        drawn.light += (line - drawn.light) * drawn.lined;
    }
    return drawn.light;
}

// Light of a triangle, or of a toon's hull; `center` is the middle of its samples.
fn shade_surface(
    id: u32,
    triangle: Triangle,
    constants: TriangleConstants,
    members: u32,
    frame_px: vec2<f32>,
    center: vec2<f32>,
    corners: Corners,
    is_hull: bool,
) -> Drawn {
    // Take what is known of the triangle, and find the colour of the surface where it is not.
    let part = triangle.part;
    var even_tone: Evened;
    if !is_hull { even_tone = evened_tone(part, frame_px); }
    let is_plain = (constants.bits & KNOWN_PLAIN) != 0u && !even_tone.is_so;
    let is_even = (constants.bits & KNOWN_EVEN) != 0u && !is_hull && !even_tone.is_so;
    let is_toon = is_toon(part) || is_hull;
    var color = constants.color;
    var paint: ToonPaint;
    if is_toon {
        color = vec3<f32>(1.0);
        paint = toon_paint(triangle, corners, center, is_hull);
    } else if !is_plain {
        color = strengthened(base_color(triangle, corners, center));
    }

    // Light it at its middle where one place stands for all samples, else at its samples, and find highlights and
    // shadows there.
    var light = select(constants.color, vec3<f32>(1.0), is_plain);
    var open: SkyPoint;
    if !is_even && !is_hull { open = openness(corners, center); }
    let first = members & (~members + 1u);
    let is_quiet = even_tone.is_so && lights.shadow_side == 0u && (parts[part].flags & PART_ANGLE) == 0u;
    let is_gentle = is_gentle(part) || is_quiet;
    let shines = has_highlights(part) && (constants.bits & KNOWN_MATT) == 0u;
    let by_sample = !is_hull && (!(is_even || is_gentle) || (shines && !shines_gently(part)));
    let counted = select(first, members, by_sample);
    let share = 1.0 / f32(countOneBits(counted));
    var gloss = vec3<f32>(0.0);
    var toon = vec3<f32>(0.0);
    var lined = 0.0;
    var darks = vec4<u32>(0u);
    var places = vec4<f32>(0.0);
    var tints: RampLight;
    var left = counted;
    loop {
        let i = firstTrailingBit(left);
        let at = select(center, frame_px + sample_offset(i), by_sample);
        let weights = toon_weights(corners, at, is_hull);
        let world = world_of(corners, weights);
        // Hulls show the backs of faces, but their outline is at the front.
        let normal = normal_of(corners, weights) * select(1.0, corners.side, is_hull);
        var dark = 0u;
        if !is_even {
            if !is_gentle && !is_hull { dark = shadowed(id, corners, weights); }
            var open_here = Openness(1.0, 1.0);
            if !is_hull { open_here = open_at(open, at - center); }
            if is_toon { toon += toon_light(part, paint, world, normal, dark, open_here) * share; }
            let lit = coordinate_under(world, normal, dark, open_here);
            places = with_sample(places, i, lit.x);
            tints.red = with_sample(tints.red, i, lit.color.r);
            tints.green = with_sample(tints.green, i, lit.color.g);
            tints.blue = with_sample(tints.blue, i, lit.color.b);
            lined += grazing(triangle, corners, at) * share;
        }
        if shines { gloss += highlights_at(part, world, normal, dark) * share; }
        darks = with_number(darks, i, dark);
        continuing {
            left &= left - 1u;
            break if left == 0u;
        }
    }

    // Light that changes gently is that of the middle, whatever place the highlights are found at.
    if is_gentle && shines && by_sample {
        let weights = weights_at(corners.clip, ndc_at(view, center));
        let lit = coordinate_under(world_of(corners, weights), normal_of(corners, weights), 0u, open_at(open, vec2<f32>(0.0)));
        places = vec4<f32>(lit.x);
        tints = RampLight(vec4<f32>(lit.color.r), vec4<f32>(lit.color.g), vec4<f32>(lit.color.b));
    }

    // Look all tones up on the ramp at once.
    if !is_even {
        let lit = select(counted, first, is_gentle);
        let lit_share = 1.0 / f32(countOneBits(lit));
        let samples = samples_in(lit);
        var ramp = ramp_lights(part, places);
        if even_tone.is_so { ramp = same_ramp_light(even_tone.light); }
        light.r = sum_over(ramp.red * tints.red * lit_share, samples);
        light.g = sum_over(ramp.green * tints.green * lit_share, samples);
        light.b = sum_over(ramp.blue * tints.blue * lit_share, samples);
        if (parts[part].flags & PART_UNLIT) != 0u { light = vec3<f32>(1.0); }
    }
    if is_toon { light = toon; }
    if is_hull { return Drawn(light, 1.0); }

    // Lay ink over it, once for samples in the same shadows.
    let known = select(known_ink(constants), even_tone.ink, even_tone.is_so && even_tone.ink >= 0.0);
    let ink = mean_ink(id, corners, known, center, counted, darks);
    return Drawn(inked(part, color * light, ink) + gloss, lined);
}

// The surfaces of a pixel without the shares that smoke hides, premultiplied.
fn surfaces(pixel: vec2<u32>, smoke_layer: SmokeLayer, frame_px: vec2<f32>) -> vec4<f32> {
    let seen = ids_at(pixel);
    let bare = vec4<f32>(1.0) - smoke_layer.hidden;
    var sum = vec4<f32>(0.0);
    // Every triangle once, from the first of its samples on.
    var left = bits_of(seen != vec4<u32>(0u));
    if left == 0u { return sum; }
    loop {
        let id = number_of(seen, firstTrailingBit(left));
        let members = seen == vec4<u32>(id);
        left &= ~bits_of(members);
        let share = sum_over(bare, members) / f32(sample_count());
        // Shade it where its colour is not known whole.
        let constants = triangles[(id & ID_MASK) - 1u];
        var light = constants.color;
        if (constants.bits & KNOWN_WHOLE) == 0u || is_of_hull(id) || is_evened(constants.part) {
            light = shade(id, constants, bits_of(members), frame_px);
        }
        if share != 0.0 { sum += vec4<f32>(light, 1.0) * share; }
        continuing { break if left == 0u; }
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

// A layer laid over another, both with straight alpha.
fn over_straight(top: vec4<f32>, below: vec4<f32>) -> vec4<f32> {
    let left = below.a * (1.0 - top.a);
    let alpha = top.a + left;
    return vec4<f32>((top.rgb * top.a + below.rgb * left) / max(alpha, 1e-6), alpha);
}

// What a pixel shows as sRGB bytes with straight alpha: surfaces, smoke over them, the background behind, beams, lines.
fn composed(pixel: vec2<u32>, element: u32) -> u32 {
    let frame_px = frame_at(window, pixel);
    let smoke_layer = smoke_layer_of(pixel, frame_px);
    var surface = surfaces(pixel, smoke_layer, frame_px);
    surface += vec4<f32>(smoke_layer.color.rgb, 1.0) * smoke_layer_shown(smoke_layer);
    var color = surface;
    if surface.a < 1.0 { color += background(frame_px) * (1.0 - surface.a); }
    let beams = add_beams(pixel, smoke_layer, frame_px, color);
    color = beams.color;
    let in_srgb = (compose.flags & COMPOSE_LINES_IN_SRGB) != 0u;
    var shown: vec4<f32>;
    if in_srgb { shown = vec4<f32>(srgb_of(color.rgb / max(color.a, 1e-6)), color.a); }
    var texel = ribbon_texel(pixel);
    for (var layer = 0u; layer < 2u; layer++) {
        if layer == 1u { texel = overlay_texel(element); }
        if (texel >> 24u) != 0u {
            let line = linear_texel(texel);
            let faded = line_fade(smoke_layer, pixel, frame_px);
            let alpha = line.a * (1.0 - beams.covered) * (1.0 - faded);
            let light = contrasted(line.rgb, frame_px);
            if in_srgb {
                shown = over_straight(vec4<f32>(srgb_of(light), alpha), shown);
            } else {
                color = over(vec4<f32>(light, alpha), color);
            }
        }
    }
    if in_srgb { return pack_rgba8(shown); }
    return encoded(color);
}

// One invocation per listed pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let listed = element_index(wid, nwg, lid, WG);
    if listed >= min(list[0], arrayLength(&list) - 1u) { return; }

    let element = list[listed + 1u];
    frame[element] = composed(pixel_of(element, window.size), element);
}
