// vector.fit_tangents: unit tangents of loops, by weighted least squares of a parabola over arc length.
//
// Source  Jiang et al. 2022, tangent fit
// Twin    npr_vector::pixel_strokes::looped::fit_tangents
//
//# use lib/grid
//# use lib/looped

@group(0) @binding(0) var<uniform> means: Filter;
@group(0) @binding(1) var<storage, read> weights: array<f32>;
@group(0) @binding(2) var<storage, read> spots: array<Spot>;
@group(0) @binding(3) var<storage, read> places: array<Planar>;
@group(0) @binding(4) var<storage, read_write> tangents: array<Planar>;

// Sums of the normal equations of a parabola.
struct Normal {
    ss: f32,
    sq: f32,
    qq: f32,
    s_away: vec2<f32>,
    q_away: vec2<f32>,
}

// The derivative by arc length at the side itself.
fn slope(normal: Normal) -> Planar {
    let whole = normal.ss * normal.qq;
    let determinant = whole - normal.sq * normal.sq;
    var a = 1.0;
    var b = 0.0;
    var d = max(normal.ss, LEAST_SQUARE);
    // If the places hardly differ, only a straight line can be fitted.
    if determinant > 1e-4 * whole {
        a = normal.qq;
        b = normal.sq;
        d = determinant;
    }
    let found = (a * normal.s_away - b * normal.q_away) / d;
    var slope: Planar;
    slope.x = found.x;
    slope.y = found.y;
    return slope;
}

// One invocation per side.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&spots) { return; }

    let spot = spots[element];
    let here = vec2<f32>(places[element].x, places[element].y);
    var normal: Normal;
    for (var way = 0u; way < 2u; way++) {
        let sign = select(1.0, -1.0, way == 1u);
        var at = element;
        var last = here;
        var s = 0.0;
        for (var step = 1u; step <= means.radius; step++) {
            at = select(after(spot, at), before(spot, at), way == 1u);
            let there = vec2<f32>(places[at].x, places[at].y);
            let d = there - last;
            s += sqrt(d.x * d.x + d.y * d.y);
            last = there;
            let away = there - here;
            let weight = weights[step];
            let along = sign * s;
            let q = 0.5 * along * along;
            normal.ss += weight * along * along;
            normal.sq += weight * along * q;
            normal.qq += weight * q * q;
            normal.s_away += weight * along * away;
            normal.q_away += weight * q * away;
        }
    }
    tangents[element] = unit_of(slope(normal));
}
