// shade.know_triangles: what is the same all over each triangle, found once a frame so that its pixels need not.
//
// Source  Suzuki 2004, sections 3.2 and 3.3, for ramp and ink
// Twin    npr_style::compose::know_triangles
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface
//# use lib/window
//# use lib/color
//# use lib/compose
//# use lib/triangle_constants

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> compose: Compose;
@group(0) @binding(2) var<uniform> lights: Lights;
@group(0) @binding(3) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(4) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(5) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(6) var<storage, read> parts: array<Part>;
@group(0) @binding(7) var<storage, read> texels: array<u32>;
@group(0) @binding(8) var<storage, read_write> known: array<TriangleConstants>;

//# use lib/surface_color
//# use lib/surface_light
//# use lib/tone_range
//# use lib/ink_tone
//# use lib/gloss_bound

// Light of a triangle, if it is the same all over.
struct Even {
    is_so: bool,
    light: vec3<f32>,
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
    if (flags & (PART_ANGLE | PART_TOON)) != 0u { return even; }
    if (flags & PART_UNLIT) != 0u {
        even.light = vec3<f32>(1.0);
        even.is_so = lights.shadow_side == 0u || (flags & (PART_INK | PART_HATCH | PART_HIGHLIGHTS)) == 0u;
        return even;
    }
    if !only_distant() || lights.shadow_side != 0u { return even; }
    let range = range_towards(corners, lights.sources[0].direction);
    if !one_step(part, range) { return even; }
    even.light = light_of(part, corners.world[0], corners.normals[0] * corners.side, 0u, Openness(1.0, 1.0));
    even.is_so = true;
    return even;
}

// Ink that is the same all over a triangle, if no shadow falls on it; else -1.
fn ink_all_over(part: u32, corners: Corners) -> f32 {
    if lights.shadow_side != 0u && (parts[part].flags & (PART_INK | PART_HATCH)) != 0u { return -1.0; }
    return even_ink(part, corners, 0u);
}

fn is_white(vertex: u32) -> bool {
    return (vertices[vertex].color | 0xff000000u) == 0xffffffffu;
}

// The constants of a triangle; empty if only its back is seen and that is not drawn.
fn constants_of(triangle: Triangle) -> TriangleConstants {
    var constants: TriangleConstants;
    constants.corners = triangle.corners;
    constants.part = triangle.part;
    let part = triangle.part;
    let corners = corners_of(triangle);
    if corners.side < 0.0 && (parts[part].flags & PART_DOUBLE_SIDED) == 0u { return constants; }

    // Find light and ink where they are the same all over.
    let even = even_light(part, corners);
    let ink = ink_all_over(part, corners);
    let at = triangle.corners;
    let is_tinted = !(is_white(at.x) && is_white(at.y) && is_white(at.z));
    let is_plain = (parts[part].flags & PART_PLAIN) != 0u || (parts[part].texture == NONE && !is_tinted);
    let is_matt = !may_shine(part, corners);

    // Note them, and multiply colour and light where both are known.
    constants.bits = learned(KNOWN_PLAIN, is_plain) | learned(KNOWN_EVEN, even.is_so) | learned(KNOWN_MATT, is_matt)
        | learned(KNOWN_BARE, ink == 0.0) | learned(KNOWN_SOLID, ink == 1.0);
    let light = select(vec3<f32>(1.0), even.light, even.is_so);
    constants.color = light;
    if is_plain { constants.color = strengthened(parts[part].base_color.rgb) * light; }

    // Lay the ink over them if nothing else is left to find.
    if ink >= 0.0 && is_plain && even.is_so && is_matt {
        constants.color = inked(part, constants.color, ink);
        constants.bits |= KNOWN_WHOLE | encoded(vec4<f32>(constants.color, 1.0)) << KNOWN_BYTES;
    }
    return constants;
}

// One invocation per triangle.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&known) { return; }
    known[element] = constants_of(triangles[element]);
}
