// Lines with width. Twin: npr_vector::screen::ribbon.

// Share of a pixel covered by a straight line of half width `half_width` at `distance` from its centre.
fn line_coverage(distance: f32, half_width: f32) -> f32 {
    let covered = min(half_width, distance + 0.5) - max(-half_width, distance - 0.5);
    return clamp(covered, 0.0, 1.0);
}

struct Ribbon {
    a: vec2<f32>,
    b: vec2<f32>,
    half_a: f32,
    half_b: f32,
}

struct RibbonPoint {
    coverage: f32,
    t: f32,
}

// Coverage of a pixel by a ribbon, and the nearest point of its spine, 0 at `a`, 1 at `b`.
// Round ends overlap the next ribbon's, so that thick bends have no notches; square ones stop at the end points.
fn ribbon_at(ribbon: Ribbon, p: vec2<f32>, square: bool) -> RibbonPoint {
    let ab = ribbon.b - ribbon.a;
    let ap = p - ribbon.a;
    let square_length = ab.x * ab.x + ab.y * ab.y;
    var along = 0.0;
    if square_length > 1e-12 { along = (ap.x * ab.x + ap.y * ab.y) / square_length; }
    var point: RibbonPoint;
    point.t = clamp(along, 0.0, 1.0);
    let off = ap - ab * point.t;
    let distance = sqrt(off.x * off.x + off.y * off.y);
    let half_width = ribbon.half_a + (ribbon.half_b - ribbon.half_a) * point.t;
    point.coverage = line_coverage(distance, half_width);
    if square && point.t != along { point.coverage = 0.0; }
    return point;
}

// The key that decides between lines at a pixel: more coverage first, then nearness.
fn line_key(coverage: f32, nearness: f32) -> f32 {
    return (floor(coverage * 255.0 + 0.5) + min(nearness, 0.999)) / 256.0;
}
