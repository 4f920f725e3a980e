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
@group(0) @binding(13) var<storage, read> overlay: array<u32>;
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
//# use lib/tone_row
//# use lib/lighting
//# use lib/surface_color
//# use lib/hull
//# use lib/surface_line
//# use lib/grazing
//# use lib/inking
//# use lib/gloss
//# use lib/sky
//# use lib/shadow
//# use lib/smoke_layer
//# use lib/beam
//# use lib/contrast
//# use lib/ribbon_layer
//# use lib/overlay_layer

// How far the tone of a flat triangle may lie beyond the tones of its corners, in ramp coordinate: rounding.
const TONE_ROOM: f32 = 0.002;
// Width of a tone step from which on it is so gentle that one place of a pixel stands for all.
const GENTLE: f32 = 0.25;

// Light of a group of samples, if one place stands for all of them.
struct Even {
    is_so: bool,
    light: vec3<f32>,
}

// Light of a ramp at coordinate `x`: each step takes over where its coordinate begins.
fn ramp_light(part: u32, x: f32) -> vec3<f32> {
    if has_tone_row(part) { return row_light(parts[part].tone_row, x); }
    let half = parts[part].softness * 0.5;
    var light = parts[part].ramp[0].rgb;
    for (var i = 1u; i < 8u; i++) {
        let stop = parts[part].ramp[i];
        if stop.a > 1.5 { break; }
        light += (stop.rgb - light) * smooth_step(stop.a - half, stop.a + half, x);
    }
    return light;
}

// Lowest and highest ramp coordinate on a triangle; only if the normal alone decides.
fn coordinate_range(corners: Corners) -> vec2<f32> {
    let towards = lights.sources[0].direction;
    let a = ramp_coordinate(dot(corners.normals[0], towards) * corners.side);
    let b = ramp_coordinate(dot(corners.normals[1], towards) * corners.side);
    let c = ramp_coordinate(dot(corners.normals[2], towards) * corners.side);
    // A blend of normals that is scaled to unit length bulges beyond them by at most their difference.
    let apart = min(
        dot(corners.normals[0], corners.normals[1]),
        min(dot(corners.normals[1], corners.normals[2]), dot(corners.normals[2], corners.normals[0])),
    );
    let room = TONE_ROOM + 0.5 * (1.0 - apart);
    return vec2<f32>(min(a, min(b, c)) - room, max(a, max(b, c)) + room);
}

// Whether a part's ramp has one tone for all coordinates in `range`.
fn one_step(part: u32, range: vec2<f32>) -> bool {
    if has_tone_row(part) { return row_is_even(parts[part].tone_row, range); }
    let reach = parts[part].softness * 0.5;
    for (var i = 1u; i < 8u; i++) {
        let at = parts[part].ramp[i].a;
        if at > range.x - reach && at <= range.y + reach { return false; }
    }
    return true;
}

// Light of a triangle that is lit in one tone all over, whatever its ink and its highlights.
fn even_light(part: u32, corners: Corners) -> Even {
    var even: Even;
    let flags = parts[part].flags;
    if (flags & PART_ANGLE) != 0u { return even; }
    if (flags & PART_UNLIT) != 0u {
        even.light = vec3<f32>(1.0);
        even.is_so = lights.shadow_side == 0u || (flags & (PART_INK | PART_HATCH | PART_HIGHLIGHTS)) == 0u;
        return even;
    }
    if !only_distant() || lights.shadow_side != 0u { return even; }
    let range = coordinate_range(corners);
    if !one_step(part, range) { return even; }
    even.light = light_of(part, corners.world[0], corners.normals[0] * corners.side, 0u, Openness(1.0, 1.0));
    even.is_so = true;
    return even;
}

// Whether light changes so gently over a part that one place of a pixel stands for all.
fn is_gentle(part: u32) -> bool {
    return lights.shadow_side == 0u
        && (parts[part].flags & (PART_ANGLE | PART_TONE_ROW)) == 0u
        && (parts[part].softness >= GENTLE || parts[part].ramp[1].a > 1.5);
}

// Light on a surface at `world` with the normal `normal`, in the shadow of the lights in `dark`, that sees `open` of
// the sky.
fn light_of(part: u32, world: vec3<f32>, normal: vec3<f32>, dark: u32, open: Openness) -> vec3<f32> {
    if (parts[part].flags & PART_UNLIT) != 0u { return vec3<f32>(1.0); }
    let lit = coordinate_under(world, normal, dark, open);
    return ramp_light(part, lit.x) * lit.color;
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
    let triangle = triangles[id - 1u];
    let part = triangle.part;
    let color = strengthened(base_color(triangle, corners, center));
    var even = even_light(part, corners);
    var open: SkyPoint;
    if !even.is_so { open = openness(corners, center); }
    if !even.is_so && is_gentle(part) {
        let weights = weights_at(corners.clip, ndc_at(view, center));
        even.light = light_of(part, world_of(corners, weights), normal_of(corners, weights), 0u, open_at(open, vec2<f32>(0.0)));
        even.is_so = true;
    }
    let shines = has_highlights(part);
    let by_sample = !even.is_so || (shines && !shines_gently(part));
    // If one place stands for all samples, only the first of them is shaded.
    let counted = select(members & (~members + 1u), members, by_sample);
    let share = 1.0 / f32(countOneBits(counted));
    var gloss = vec3<f32>(0.0);
    var light = select(vec3<f32>(0.0), even.light, even.is_so);
    var lined = 0.0;
    var darks = vec4<u32>(0u);
    var left = select(0u, counted, !even.is_so || shines);
    while left != 0u {
        let i = firstTrailingBit(left);
        left &= left - 1u;
        let at = select(center, frame_px + sample_offset(i), by_sample);
        let weights = weights_at(corners.clip, ndc_at(view, at));
        let world = world_of(corners, weights);
        let normal = normal_of(corners, weights);
        var dark = 0u;
        if !even.is_so {
            dark = shadowed(id, corners, weights);
            light += light_of(part, world, normal, dark, open_at(open, at - center)) * share;
            lined += grazing(triangle, corners, at) * share;
        }
        gloss += highlights_at(part, world, normal, dark) * share;
        darks[i] = dark;
    }
    let ink = mean_ink(id, part, corners, center, counted, darks);
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
        sum += vec4<f32>(shade(id, bits_of(members), frame_px), 1.0) * share;
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
