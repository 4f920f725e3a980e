// The colour of a line, combined from what was decided at its place. Twin: npr_core::line_color. The shader declares
// `parts: array<Part>`.

//# use lib/color
//# use lib/outline

// The decided tint of lines at a pixel of the mask.
struct LineTint {
    own: u32,
    tint_layer: u32,
    part: u32,
}

// The same tint with values 0..1, sRGB encoded.
struct Tint {
    is_known: bool,
    own: vec4<f32>,
    tint_layer: vec4<f32>,
}

// The bit of the first kind of an edge.
fn kind_of_edge(kinds: u32) -> u32 {
    let known = kinds & KINDS_EDGES;
    return select(known & (~known + 1u), KIND_CONTOUR, known == 0u);
}

fn kind_of_mask(found: u32) -> u32 {
    if (found & DETECT_PIECE) != 0u { return KIND_INTERSECTION; }
    if (found & (DETECT_DEPTH | DETECT_OBJECT)) != 0u { return KIND_CONTOUR; }
    if (found & DETECT_MATERIAL) != 0u { return KIND_MATERIAL; }
    return KIND_CREASE;
}

// Colour of a part's lines of the kind with the bit `kind`, sRGB with straight alpha, under a tint.
fn line_color(part: u32, kind: u32, tint: Tint) -> vec4<f32> {
    var color = parts[part].line_color;
    let flags = parts[part].line_flags;
    if flags == 0u { return color; }
    let has_own = (flags & kind & LINE_KINDS) != 0u;
    if has_own { color = unpack_rgba8(parts[part].line_kinds[firstTrailingBit(kind)]); }
    if !tint.is_known { return color; }
    if !has_own && (flags & LINE_SOURCES) != 0u { color = vec4<f32>(tint.own.rgb, color.a); }
    return vec4<f32>(layered(color.rgb, tint.tint_layer), color.a * tint.own.a);
}

// A colour under a tint layer, both sRGB encoded; mixed in linear light.
fn layered(color: vec3<f32>, tint_layer: vec4<f32>) -> vec3<f32> {
    if tint_layer.a <= 0.0 { return color; }
    let under = linear_rgb(color);
    return srgb_of(under + (linear_rgb(tint_layer.rgb) - under) * tint_layer.a);
}
