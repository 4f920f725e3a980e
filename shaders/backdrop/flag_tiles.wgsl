// backdrop.flag_tiles: white for every tile near a border between two subjects.
//
// All later backdrop passes work only there.
//
// Twin    npr_style::backdrop::flag_tiles
//
//# use lib/geometry
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> output_window: Window;
@group(0) @binding(2) var<uniform> rules: Rules;
@group(0) @binding(3) var ids: texture_2d<u32>;
@group(0) @binding(4) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(5) var<storage, read> part_subjects: array<PartSubject>;

//# use lib/scenery

// Tiles around a border's tile that it marks too.
const TILE_RIM: u32 = 2u;

fn is_busy(tile: vec2<u32>) -> bool {
    let samples = rules.samples;
    let start = tile * BORDER_TILE;
    let low = (max(start, vec2<u32>(TILE_RIM)) - TILE_RIM) * samples;
    let high = min(start + BORDER_TILE + TILE_RIM, output_window.size) * samples;
    let first = textureLoad(ids, low, 0).x;
    let subject = subject_of(first);
    var last = first;
    for (var y = low.y; y < high.y; y++) {
        for (var x = low.x; x < high.x; x++) {
            let id = textureLoad(ids, vec2<u32>(x, y), 0).x;
            if id != last {
                if subject_of(id) != subject { return true; }
                last = id;
            }
        }
    }
    return false;
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return vec4<f32>(corner, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    if rules.within != 0u || is_busy(vec2<u32>(at.xy)) { return vec4<f32>(1.0); }
    return vec4<f32>(0.0);
}
