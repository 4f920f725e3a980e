// vector.gather_sides: puts the place, direction and area of every side in the order of loops.
//
// Twin    npr_vector::pixel_strokes::looped::gather_sides
//
//# use lib/grid
//# use lib/list
//# use lib/ink
//# use lib/pixel

@group(0) @binding(0) var<uniform> view: PixelView;
@group(0) @binding(1) var<storage, read> order: array<u32>;
@group(0) @binding(2) var<storage, read> standings: array<Standing>;
@group(0) @binding(3) var<storage, read> sides: array<Side>;
@group(0) @binding(4) var<storage, read_write> spots: array<Spot>;
@group(0) @binding(5) var<storage, read_write> places: array<Planar>;
@group(0) @binding(6) var<storage, read_write> directions: array<Planar>;
@group(0) @binding(7) var<storage, read_write> areas: array<u32>;

// One invocation per side.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&order) { return; }

    let number = order[element];
    let standing = standings[number];
    spots[element].start = element - standing.rank;
    spots[element].length = standing.length;
    let side = sides[number];
    let way = side.code & 3u;
    let at = pixel_of(side.code / 4u, view.size);
    let middle = vec2<f32>(select(0.5, select(0.0, 1.0, way == 1u), (way & 1u) != 0u),
        select(0.5, select(0.0, 1.0, way == 2u), (way & 1u) == 0u));
    places[element].x = f32(at.x) + middle.x;
    places[element].y = f32(at.y) + middle.y;
    // The area is the sum of the heights of lower sides minus that of upper ones.
    areas[element] = select(select(0u, at.y + 1u, way == 2u), ~at.y + 1u, way == 0u);
    directions[element] = unit_of(side.extent);
}
