// Brushes: what of a stroke takes ink. Twin: npr_vector::brush. The shader declares `points`, `brushes` and `texels`.

//# use lib/grain
//# use lib/ink_point

// Square pixels by which a place may be nearer to the next piece and still be drawn by this one.
const NEARER: f32 = 1e-3;
const THINNEST_PX: f32 = 1e-3;

struct BrushFoot {
    along: f32,
    beside: f32,
    square_distance: f32,
}

// Where a place lies beside the piece from `a` to `b`.
fn foot_on(a: vec2<f32>, b: vec2<f32>, p: vec2<f32>) -> BrushFoot {
    let ab = b - a;
    let ap = p - a;
    let square_length = max(ab.x * ab.x + ab.y * ab.y, 1e-12);
    var foot: BrushFoot;
    foot.along = (ap.x * ab.x + ap.y * ab.y) / square_length;
    foot.beside = (ap.y * ab.x - ap.x * ab.y) / sqrt(square_length);
    let off = ap - ab * clamp(foot.along, 0.0, 1.0);
    foot.square_distance = off.x * off.x + off.y * off.y;
    return foot;
}

// Share of ink, 0 to 1, that the brush leaves in a pixel that the piece from a point to the next one covers; 0 where
// the piece before or behind lies nearer.
fn brush_ink(element: u32, px: vec2<f32>) -> f32 {
    let a = points[element];
    let b = points[element + 1u];
    let brush = brushes[min(a.flags >> INK_BRUSH_SHIFT, arrayLength(&brushes) - 1u)];
    if brush.texels_across == 0u { return 1.0; }

    // Leave the pixel to a neighbour that lies nearer.
    let foot = foot_on(a.px, b.px, px);
    let is_led = element > 0u && (points[max(element, 1u) - 1u].flags & INK_JOINED) != 0u;
    let is_followed = (b.flags & INK_JOINED) != 0u && element + 2u < arrayLength(&points);
    if is_led {
        let before = foot_on(points[element - 1u].px, a.px, px);
        if before.square_distance < foot.square_distance - NEARER { return 0.0; }
    }
    if is_followed {
        let behind = foot_on(b.px, points[element + 2u].px, px);
        if behind.square_distance < foot.square_distance - NEARER { return 0.0; }
    }

    // Find the place in the brush's image: beyond free ends it goes on straight. Stamps end at their sides.
    let is_stamp = (a.flags & INK_STAMP) != 0u;
    if is_stamp && (foot.along != clamp(foot.along, 0.0, 1.0)) { return 0.0; }
    let t = clamp(foot.along, 0.0, 1.0);
    var along = foot.along;
    if is_led { along = max(along, 0.0); }
    if is_followed { along = min(along, 1.0); }
    let is_beyond = t != foot.along;
    let goes_straight = is_beyond && along != t;
    let half_width = max(a.half_width + (b.half_width - a.half_width) * t, THINNEST_PX);
    let around = select(1.0, -1.0, foot.beside < 0.0) * sqrt(foot.square_distance);
    let beside = select(foot.beside, around, is_beyond && !goes_straight);
    let is_mirrored = (a.flags & INK_MIRRORED) != 0u;
    let u = a.u + (b.u - a.u) * along;

    // Look it up as finely as pixels lie.
    let ab = b.px - a.px;
    let length = max(sqrt(ab.x * ab.x + ab.y * ab.y), THINNEST_PX);
    let across_px = f32(brush.texels_across) / (2.0 * half_width);
    let along_px = f32(brush.texels_along) * abs(b.u - a.u) / length;
    let texels_per_px = max(across_px, along_px);
    let place = vec2<f32>(u, brush_across(beside / half_width, is_mirrored));
    var texel = brush_texel(brush, place, texels_per_px);

    // A round stamp falls off all around.
    if (a.flags & INK_ROUND) != 0u {
        let off = px - (a.px + b.px) * 0.5;
        let far = sqrt(off.x * off.x + off.y * off.y) / half_width;
        if far >= 1.0 { return 0.0; }
        let rim = vec2<f32>(u, brush_across(far, is_mirrored));
        texel.y = min(texel.y, brush_texel(brush, rim, texels_per_px).y);
    }

    // Lift the brush beyond a free end, which is round.
    var pressure = a.pressure + (b.pressure - a.pressure) * t;
    if goes_straight {
        let beyond = (along - t) * length / half_width;
        pressure *= max(1.0 - beyond * beyond, 0.0);
        let rim = vec2<f32>(u, brush_across(around / half_width, is_mirrored));
        texel.y = min(texel.y, brush_texel(brush, rim, texels_per_px).y);
    }

    // Let the nap touch the paper.
    let reach = (pressure - brush.dry * (1.0 - texel.x)) / brush.soft + 0.5;
    let deepest = brush.grain / brush.soft;
    if reach <= 0.0 { return 0.0; }
    if reach - deepest >= 1.0 { return texel.y; }
    let valley = 1.0 - paper_height(px, brush.spots_per_px);
    return texel.y * clamp(reach - deepest * valley, 0.0, 1.0);
}

// Place across the image, 0 to 1, at a share of the half width to either side.
fn brush_across(share: f32, is_mirrored: bool) -> f32 {
    let v = clamp(share, -1.0, 1.0) * 0.5 + 0.5;
    return select(v, 1.0 - v, is_mirrored);
}

// Height of the nap and share of ink at a place of the image, where a pixel is `texels_per_px` wide.
fn brush_texel(brush: Brush, uv: vec2<f32>, texels_per_px: f32) -> vec2<f32> {
    let most = f32(brush.levels - 1u);
    let level = clamp(log2(max(texels_per_px, 1.0)), 0.0, most);
    let fine = min(u32(level), brush.levels - 1u);
    let near = brush_level(brush, fine, uv);
    if level == f32(fine) { return near; }
    let far = brush_level(brush, min(fine + 1u, brush.levels - 1u), uv);
    return near + (far - near) * (level - f32(fine));
}

// The same in one of its levels, between texels.
fn brush_level(brush: Brush, level: u32, uv: vec2<f32>) -> vec2<f32> {
    let all = brush.texels_along * brush.texels_across;
    let first = brush.start + (all - (all >> (2u * level))) / 3u * 4u;
    let size = vec2<u32>(brush.texels_along, brush.texels_across) >> vec2<u32>(level);
    let x = fract(uv.x) * f32(size.x) - 0.5;
    let y = clamp(uv.y * f32(size.y) - 0.5, 0.0, f32(size.y - 1u));
    let column = floor(x);
    let row = floor(y);
    let left = u32(column + f32(size.x)) % size.x;
    let right = (left + 1u) % size.x;
    let upper = first + u32(row) * size.x;
    let lower = first + min(u32(row) + 1u, size.y - 1u) * size.x;
    let top = mix_texels(texels[upper + left], texels[upper + right], x - column);
    let bottom = mix_texels(texels[lower + left], texels[lower + right], x - column);
    return top + (bottom - top) * (y - row);
}

fn mix_texels(a: u32, b: u32, share: f32) -> vec2<f32> {
    let first = vec2<f32>(f32(a & 255u), f32((a >> 8u) & 255u)) / 255.0;
    let second = vec2<f32>(f32(b & 255u), f32((b >> 8u) & 255u)) / 255.0;
    return first + (second - first) * share;
}
