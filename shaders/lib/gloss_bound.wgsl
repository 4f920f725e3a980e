// Whether highlights may show on a triangle. Twin: npr_style::gloss. The shader declares `view`, `compose`, `lights`
// and `parts`.

//# use lib/gloss
//# use lib/lighting
//# use lib/tone_range

// Margin for rounding between the cosine of blended unit vectors and its bound.
const SPOT_ROOM: f32 = 1e-4;

// How much longer than 1 the mean of unit vectors can become when it is scaled to unit length.
fn swell(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> f32 {
    let closest = min(min(min(dot(a, b), dot(b, c)), dot(c, a)), 1.0);
    return 1.0 / sqrt(max(closest, 0.0));
}

// Upper bound of N . H for one light, where N and the direction to the eye are blends of those at three corners, scaled
// to unit length.
fn highest_cosine(normals: array<vec3<f32>, 3>, eyes: array<vec3<f32>, 3>, swells: vec2<f32>, light: vec3<f32>) -> f32 {
    let sums = array<vec3<f32>, 3>(light + eyes[0], light + eyes[1], light + eyes[2]);
    var most = 0.0;
    for (var i = 0u; i < 3u; i++) {
        most = max(most, max(dot(normals[i], sums[0]), max(dot(normals[i], sums[1]), dot(normals[i], sums[2]))));
    }
    let nearest = min(dot(light, eyes[0]), min(dot(light, eyes[1]), dot(light, eyes[2])));
    let least = min(nearest, nearest * swells.y);
    // N . (L + E) over |L + E|; E is longer than the mean of the corners' directions by up to its swell.
    let above = swells.x * (swells.y * most + swells.y - 1.0);
    return above / sqrt(max(2.0 + 2.0 * least, 0.0));
}

// Whether (N . H)^n may exceed the part's threshold somewhere on a triangle.
fn spot_may_show(part: u32, corners: Corners) -> bool {
    if (parts[part].flags & PART_PHONG) != 0u || has_shape(part) { return true; }
    let n = corners.normals;
    let normals = array<vec3<f32>, 3>(n[0] * corners.side, n[1] * corners.side, n[2] * corners.side);
    let w = corners.world;
    let eyes = array<vec3<f32>, 3>(to_eye(view, w[0]), to_eye(view, w[1]), to_eye(view, w[2]));
    let swells = vec2<f32>(swell(normals[0], normals[1], normals[2]), swell(eyes[0], eyes[1], eyes[2]));
    for (var i = 0u; i < lights.count; i++) {
        if lights.sources[i].kind == LIGHT_SKY { continue; }
        if !is_far(lights.sources[i]) { return true; }
        let highest = highest_cosine(normals, eyes, swells, lights.sources[i].direction);
        // The comparison is negated so that NaN counts as a highlight that shows.
        let term = positive_power(highest + SPOT_ROOM, parts[part].highlight.x);
        if !(term <= parts[part].highlight.y) { return true; }
    }
    return false;
}

// Whether a part's highlights may show somewhere on a triangle. Only `false` is certain: shapes, streaks, Phong's term
// and near lights always give `true`.
fn may_shine(part: u32, corners: Corners) -> bool {
    let flags = parts[part].flags;
    if (flags & PART_STREAK) != 0u { return true; }
    if (flags & PART_BACK_LIGHT) != 0u {
        let behind = in_world(compose, parts[part].back_direction);
        if range_towards(corners, behind).y >= parts[part].back.x { return true; }
    }
    return (flags & (PART_CRISP | PART_SOFT)) != 0u && spot_may_show(part, corners);
}
