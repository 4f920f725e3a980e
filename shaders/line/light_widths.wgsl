// line.light_widths: scales half widths of lines by the light that falls on the vertices; nothing else changes.
//
// Twin    npr_style::line_color::light_widths
//
//# use lib/grid
//# use lib/geometry
//# use lib/surface

@group(0) @binding(0) var<uniform> lights: Lights;
@group(0) @binding(1) var<storage, read> parts: array<Part>;
@group(0) @binding(2) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(3) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(4) var<storage, read_write> lit: array<PosedVertex>;

//# use lib/lighting

// One invocation per vertex.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&lit) { return; }

    var vertex = posed[element];
    let part = vertices[element].part;
    if (parts[part].line_flags & LINE_WIDTH) != 0u {
        let x = coordinate_at(vertex.world, vertex.normal, 0u).x;
        let ends = parts[part].line_width;
        vertex.half_width *= ends.x + (ends.y - ends.x) * x;
    }
    lit[element] = vertex;
}
