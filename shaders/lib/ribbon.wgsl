// Lines with width. Twin: npr_vector::screen::sweep.

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

// Share of a pixel on the inner side of a straight edge; its centre lies `inside` within it, along the normal.
fn half_plane_coverage(inside: f32, normal: vec2<f32>) -> f32 {
    let sides = abs(normal);
    let long = max(sides.x, sides.y);
    let short = min(sides.x, sides.y);
    let foot = 0.5 * (long + short);
    let top = 0.5 * (long - short);
    let depth = abs(inside);
    var beyond = 0.5 - depth / long;
    if depth >= foot {
        beyond = 0.0;
    } else if depth > top {
        beyond = (foot - depth) * (foot - depth) / (2.0 * long * short);
    }
    return select(beyond, 1.0 - beyond, inside > 0.0);
}

// Share of a pixel covered by a straight strip whose middle lies at a distance from its centre along a normal.
fn strip_coverage(distance: f32, half_width: f32, normal: vec2<f32>) -> f32 {
    let far = half_plane_coverage(half_width + distance, normal);
    let near = half_plane_coverage(half_width - distance, normal);
    return clamp(far + near - 1.0, 0.0, 1.0);
}

// Coverage of a pixel by all discs along the spine, whose radius grows evenly from one end to the other, and where the
// disc lies that covers it.
fn ribbon_swept(ribbon: Ribbon, p: vec2<f32>) -> RibbonPoint {
    let ab = ribbon.b - ribbon.a;
    let ap = p - ribbon.a;
    let length = sqrt(ab.x * ab.x + ab.y * ab.y);
    let shrink = ribbon.half_a - ribbon.half_b;

    // The disc that reaches farthest towards a point lies back from its foot, towards the thick end.
    var point: RibbonPoint;
    point.t = select(1.0, 0.0, shrink >= 0.0);
    if length > abs(shrink) && length > 1e-6 {
        let along = (ap.x * ab.x + ap.y * ab.y) / length;
        let beside = abs(ap.y * ab.x - ap.x * ab.y) / length;
        let lean = shrink / sqrt(length * length - shrink * shrink);
        point.t = clamp((along - beside * lean) / length, 0.0, 1.0);
    }
    let off = ap - ab * point.t;
    let distance = sqrt(off.x * off.x + off.y * off.y);
    var normal = vec2<f32>(1.0, 0.0);
    if length > 1e-6 { normal = vec2<f32>(-ab.y, ab.x) / length; }
    if distance > 1e-3 { normal = off / distance; }
    point.coverage = strip_coverage(distance, ribbon.half_a - shrink * point.t, normal);
    return point;
}

// The key that decides between lines at a pixel: more coverage first, then nearness.
fn line_key(coverage: f32, nearness: f32) -> f32 {
    return (floor(coverage * 255.0 + 0.5) + min(nearness, 0.999)) / 256.0;
}
