// mesh.pose_vertices: poses and projects every vertex, and gives it its line width.
//
// Transforming once here serves the G-buffer, the ribbons and the shading alike
// (A23); deformation belongs here too (A24), as linear blend skinning.
//
// Source  Okuya et al. 2016, section 4.1
// Twin    npr_mesh::pose::pose
//
//# use lib/grid
//# use lib/geometry
//# use lib/unit
//# use lib/surface
//# use lib/window
//# use lib/outline

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> outline: Outline;
@group(0) @binding(2) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(3) var<storage, read> influences: array<Influence>;
@group(0) @binding(4) var<storage, read> palette: array<mat4x4<f32>>;
@group(0) @binding(5) var<storage, read> parts: array<Part>;
@group(0) @binding(6) var<storage, read_write> posed: array<PosedVertex>;

//# use lib/pose

// Curvature of the outline that the surface would have here, in the picture:
// K / radial curvature [Koenderink 1984], kept finite where the radial curvature vanishes.
fn projected_curvature(vertex: Vertex, normal: vec3<f32>, direction: vec3<f32>, eye: vec3<f32>) -> f32 {
    let along = eye - normal * dot(eye, normal);
    let square = dot(along, along);
    if square < 1e-12 { return max(abs(vertex.curvatures.x), abs(vertex.curvatures.y)); }
    let cosine = dot(along, direction) / sqrt(square);
    let c2 = clamp(cosine * cosine, 0.0, 1.0);
    let s2 = 1.0 - c2;
    let first = vertex.curvatures.x;
    let second = vertex.curvatures.y;
    let radial = first * c2 + second * s2;
    let across = first * s2 + second * c2;
    let twist2 = (first - second) * (first - second) * s2 * c2;
    return across - twist2 * radial / (radial * radial + 0.01);
}

// Greatest width of a line as a share of its radius of curvature: a wider one would fill the inside of the bend.
const BEND_SHARE: f32 = 0.2;

// Greatest width of a line as a share of the tightest radius of the surface.
const GIRTH_SHARE: f32 = 0.5;

// Widest line, in pixels, round a bend on a surface of these curvatures, in 1 / pixel.
fn widest_round(bend_px: f32, tightest_px: f32) -> f32 {
    let round_bend = BEND_SHARE / max(abs(bend_px), 1e-6);
    return min(round_bend, GIRTH_SHARE / max(abs(tightest_px), 1e-6));
}

// Width factor 0..1 of a vertex, and the widest line that has room there, in pixels.
fn width_at(vertex: Vertex, normal: vec3<f32>, direction: vec3<f32>, world: vec3<f32>, depth: f32) -> vec2<f32> {
    if (outline.flags & OUTLINE_PROJECTED_CURVATURE) == 0u { return vec2<f32>(vertex.width, widest_round(0.0, 0.0)); }
    let eye = to_eye(view, world);
    let curvature = projected_curvature(vertex, normal, direction, eye) / outline.radius_world;
    let tightest = vertex.width / outline.radius_world;
    let height = height_at(view, depth);
    let s = width_of_curvature(curvature * height * 0.1, outline.gain);
    let pixel = world_per_pixel(view, depth);
    return vec2<f32>(s, widest_round(curvature * pixel, tightest * pixel));
}

// One invocation per vertex.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&vertices) { return; }

    let vertex = vertices[element];
    let m = blended_matrix(influences[element]);
    let world = apply_point(m, vertex.position).xyz;
    let normal = apply_normal(m, vertex.normal);
    let direction = unit_or_z(apply_direction(m, unpack_unit(vertex.direction)));
    let depth = dot(world - view.eye_world, view.forward_world);

    // Turn the width factor into pixels.
    let s = width_at(vertex, normal, direction, world, depth);
    var base = outline.base_width * parts[vertex.part].width_factor;
    let is_in_world = (parts[vertex.part].flags & PART_WORLD_LINE) != 0u;
    if is_in_world || (outline.flags & OUTLINE_WORLD_WIDTH) != 0u {
        base /= max(world_per_pixel(view, max(depth, view.near)), 1e-20);
    }
    var width = base * width_factor(outline.min_factor, outline.max_factor, s.x);
    width = min(width, max(s.y, base * outline.min_factor));

    var vertex_out: PosedVertex;
    vertex_out.clip = apply_point(view.clip_from_world, world);
    vertex_out.world = world;
    vertex_out.depth = depth;
    vertex_out.normal = normal;
    vertex_out.half_width = 0.5 * width;
    posed[element] = vertex_out;
}
