// The tints of lines on a mask. Twin: npr_core::line_color::LineTints. The shader declares `mask_window`, `parts` and
// `tints: array<LineTint>`.

//# use lib/geometry
//# use lib/window
//# use lib/line_tint

// Whether there are no tints.
fn has_no_tints() -> bool {
    return arrayLength(&tints) < mask_window.size.x * mask_window.size.y;
}

// The tint of a part's lines at a point of the frame: the mean over the 3x3 mask pixels around it, weighted by a tent.
fn tint_at(px: vec2<f32>, part: u32) -> Tint {
    var tint: Tint;
    if has_no_tints() { return tint; }
    let center = pixel_at(mask_window, px);
    let low = max(center, vec2<u32>(1u)) - 1u;
    let high = min(center + 1u, mask_window.size - 1u);
    // Index 0 sums the pixels of the part, index 1 all of them.
    var weight = vec2<f32>(0.0);
    var own = array<vec4<f32>, 2>();
    var tint_layer = array<vec4<f32>, 2>();
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            let found = tints[y * mask_window.size.x + x];
            if found.part == NONE { continue; }
            let off = abs((px - frame_at(mask_window, vec2<u32>(x, y))) / mask_window.frame_step);
            let share = max(1.5 - off.x, 0.0) * max(1.5 - off.y, 0.0);
            let found_own = unpack_rgba8(found.own) * share;
            let found_layer = unpack_rgba8(found.tint_layer);
            let weighed = vec4<f32>(found_layer.rgb, 1.0) * (found_layer.a * share);
            weight.y += share;
            own[1] += found_own;
            tint_layer[1] += weighed;
            if found.part == part {
                weight.x += share;
                own[0] += found_own;
                tint_layer[0] += weighed;
            }
        }
    }
    if weight.y <= 0.0 { return tint; }
    let is_own = weight.x > 0.0;
    let sum = select(weight.y, weight.x, is_own);
    let tint_layer_sum = select(tint_layer[1], tint_layer[0], is_own);
    tint.is_known = true;
    tint.own = select(own[1], own[0], is_own) / sum;
    tint.tint_layer = vec4<f32>(tint_layer_sum.rgb / max(tint_layer_sum.a, 1e-6), tint_layer_sum.a / sum);
    return tint;
}

// Colour of a part's lines of a kind at a point of the frame, sRGB with straight alpha.
fn line_color_at(part: u32, kind: u32, px: vec2<f32>) -> vec4<f32> {
    var tint: Tint;
    if (parts[part].line_flags & LINE_PLACED) != 0u { tint = tint_at(px, part); }
    return line_color(part, kind, tint);
}
