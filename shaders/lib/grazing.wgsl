// Lines where surfaces are seen at a grazing angle. Twin: npr_style::compose::layers.
// The shader declares `view`, `compose`, `posed` and `parts`.

// Widest line of the surface-angle method, in line widths: a surface that turns more slowly counts as flat.
const ANGLE_WIDTHS: f32 = 6.0;

// The one-dimensional texture of the surface-angle method over N . E.
fn angle_ramp(facing: f32, threshold: f32, softness: f32) -> f32 {
    let half = 0.5 * softness * threshold;
    return 1.0 - smooth_step(threshold - half, threshold + half, abs(facing));
}

// 1 within `widest_px` of the contour of a surface, else 0, at a place where N . E is `facing` and changes by `change`
// per pixel.
fn not_flat(facing: f32, change: f32, widest_px: f32) -> f32 {
    let distance = max(facing, 0.0) * 0.5 / max(change, 1e-9);
    return clamp(widest_px - distance + 0.5, 0.0, 1.0);
}

// How dark the surface-angle method's line is at a place of a surface, 0..1.
fn grazing(triangle: Triangle, corners: Corners, px: vec2<f32>) -> f32 {
    let part = triangle.part;
    if (parts[part].flags & PART_ANGLE) == 0u || (compose.flags & COMPOSE_BARE) != 0u { return 0.0; }
    let around = weights_around(corners.clip, ndc_at(view, px), pixel_ndc(view));
    // Keep the eye of the place: so only the normal turns, and on flat faces nothing does.
    let eye = to_eye(view, world_of(corners, around[0]));
    let here = dot(normal_of(corners, around[0]), eye);
    let right = dot(normal_of(corners, around[1]), eye);
    let down = dot(normal_of(corners, around[2]), eye);
    let change = length(vec2<f32>(right - here, down - here));
    let at = triangle.corners;
    let half_width = blend(around[0], posed[at.x].half_width, posed[at.y].half_width, posed[at.z].half_width);
    let widest_px = ANGLE_WIDTHS * 2.0 * half_width;
    return angle_ramp(here, parts[part].facing_threshold, compose.angle_softness) * not_flat(here, change, widest_px);
}
