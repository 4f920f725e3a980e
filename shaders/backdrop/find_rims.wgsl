// backdrop.find_rims: the colours of both sides of every border between subjects.
//
// The subject nearest to the eye owns the border. Only pixels whose samples all agree count for a side, so colours are
// never blends of both: what lies behind a mixed pixel is the mean of its neighbours behind the subject.
//
// Source  Tsuji 2014, sections 2.2 to 2.4
// Twin    npr_style::backdrop::find_rims
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> rules: Rules;
@group(0) @binding(2) var ids: texture_2d<u32>;
@group(0) @binding(3) var depths: texture_depth_2d;
@group(0) @binding(4) var drawn_ids: texture_2d<u32>;
@group(0) @binding(5) var busy: texture_2d<f32>;
@group(0) @binding(6) var ribbons: texture_2d<f32>;
@group(0) @binding(7) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(8) var<storage, read> parts: array<Part>;
@group(0) @binding(9) var<storage, read> part_subjects: array<PartSubject>;
@group(0) @binding(10) var<storage, read> bare: array<u32>;
@group(0) @binding(11) var<storage, read> overlay: array<u32>;
@group(0) @binding(12) var<storage, read_write> rims: array<Rim>;

//# use lib/scenery

// Sums of the colours of some pixels; alpha counts them.
struct Sum {
    color: vec4<f32>,
    count: f32,
}

fn added(sum: Sum, texel: u32) -> Sum {
    let color = unpack4x8unorm(texel);
    var more = sum;
    more.color += vec4<f32>(color.rgb * color.a, color.a);
    more.count += 1.0;
    return more;
}

// The mean colour and the mean alpha.
fn mean_of(sum: Sum) -> vec4<f32> {
    return vec4<f32>(sum.color.rgb / max(sum.color.a, 1e-6), sum.color.a / max(sum.count, 1.0));
}

// The subject nearest to the eye among some pixels; 0 where there is none.
fn owner_of(low: vec2<u32>, high: vec2<u32>) -> u32 {
    var owner = 0u;
    var nearest = -1.0;
    for (var row = low.y; row <= high.y; row++) {
        for (var column = low.x; column <= high.x; column++) {
            let shown = shown_at(column, row);
            if shown.subject == 0u || shown.subject == MIXED { continue; }
            let depth = textureLoad(depths, vec2<u32>(column, row) * rules.samples, 0);
            if depth > nearest {
                owner = shown.subject;
                nearest = depth;
            }
        }
    }
    return owner;
}

// Whether some line may cover a pixel.
fn is_inked(x: u32, y: u32, part: u32) -> bool {
    let layers = rules.within;
    if (layers & RULES_RIBBONS) != 0u && textureLoad(ribbons, vec2<u32>(x, y), 0).a > 0.0 { return true; }
    if (layers & RULES_OVERLAY) != 0u && (overlay[y * window.size.x + x] >> 24u) != 0u { return true; }
    if (parts[part].flags & PART_ANGLE) != 0u { return true; }
    let samples = rules.samples;
    for (var i = 0u; i < samples * samples; i++) {
        let at = vec2<u32>(x * samples + i % samples, y * samples + i / samples);
        if (textureLoad(drawn_ids, at, 0).x & HULL_BIT) != 0u { return true; }
    }
    return false;
}

// A rim of these two sides; its rule weighs as much as `behind` is opaque.
fn packed(rim: Sum, behind: Sum, share: f32, rule: u32, subject: u32, part: u32) -> Rim {
    let front = mean_of(rim);
    let back = mean_of(behind);
    var made: Rim;
    made.rim = pack_rgba8(vec4<f32>(front.rgb, share * back.a));
    made.behind = pack_rgba8(vec4<f32>(back.rgb, 0.0)) | (rule << 24u);
    made.subject = subject;
    made.part = part;
    return made;
}

// The rim of a line within a subject, if such lines adapt to the background: both sides are the surface under the line.
// Lines of parts without a rule have a rim that counts for nothing, and so keep their colour beside others.
fn inner_rim(x: u32, y: u32, sum: Sum, owner: u32, part: u32) -> Rim {
    var none: Rim;
    let rule = part_subjects[part].rule;
    let is_left_out = rule != 0u && rules.rules[rule].within == 0u;
    if rules.within == 0u || is_left_out || !is_inked(x, y, part) { return none; }
    let share = select(1.0, 0.0, rule == 0u);
    return packed(sum, sum, share, rule, owner | RIM_WITHIN, part);
}

fn rim_at(x: u32, y: u32) -> Rim {
    var none: Rim;
    if textureLoad(busy, vec2<u32>(x, y) / BORDER_TILE, 0).a == 0.0 { return none; }
    let low = max(vec2<u32>(x, y), vec2<u32>(1u)) - 1u;
    let high = min(vec2<u32>(x, y) + 1u, window.size - 1u);
    let owner = owner_of(low, high);
    if owner == 0u { return none; }
    var rim: Sum;
    var behind: Sum;
    var part = 0u;
    var rule = 0u;
    var contrasting = 0.0;
    for (var row = low.y; row <= high.y; row++) {
        for (var column = low.x; column <= high.x; column++) {
            let shown = shown_at(column, row);
            let texel = bare[row * window.size.x + column];
            if shown.subject == owner {
                if rim.count == 0.0 { part = shown.part; }
                rim = added(rim, texel);
                let own = part_subjects[shown.part].rule;
                if own != 0u {
                    contrasting += 1.0;
                    rule = own;
                }
            } else if shown.subject != MIXED {
                behind = added(behind, texel);
            }
        }
    }
    let here = shown_at(x, y).subject;
    let outside = select(RIM_OUTSIDE, 0u, here == owner);
    let is_behind = outside != 0u && here != MIXED;
    if rules.rules[rule].method == RULE_BY_LIKENESS && is_behind {
        var nothing: Sum;
        behind = added(nothing, bare[y * window.size.x + x]);
    }
    if behind.count == 0.0 { return inner_rim(x, y, rim, owner, part); }
    let share = contrasting / rim.count;
    return packed(rim, behind, share, rule, owner | outside, part);
}

// One invocation per output pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&rims) { return; }
    let pixel = pixel_of(element, window.size);
    rims[element] = rim_at(pixel.x, pixel.y);
}
