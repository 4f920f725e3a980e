// line.resolve_gbuffer: depth, normal and part of the surface at every pixel.
//
// Source  Saito & Takahashi 1990; Okuya et al. 2016, sections 3.2 and 4.2
// Twin    npr_vector::screen::gbuffer::resolve
//
//# use lib/grid
//# use lib/geometry
//# use lib/unit
//# use lib/surface
//# use lib/window

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<uniform> window: Window;
@group(0) @binding(2) var ids: texture_2d<u32>;
@group(0) @binding(3) var<storage, read> posed: array<PosedVertex>;
@group(0) @binding(4) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(5) var<storage, read> parts: array<Part>;
@group(0) @binding(6) var<storage, read_write> gbuffer: array<GPixel>;

fn empty_pixel() -> GPixel {
    var pixel: GPixel;
    pixel.depth = FAR_DEPTH;
    pixel.part = NONE;
    return pixel;
}

// Change of the plane coordinate over one pixel to the right and down. Weights change linearly over the picture
// before they are divided by their sum; of the two sums that make the coordinate, one is constant.
fn plane_step(clip: array<vec4<f32>, 3>, depths: vec3<f32>, ndc: vec2<f32>) -> vec2<f32> {
    let a = offset_from(clip[0], ndc);
    let b = offset_from(clip[1], ndc);
    let c = offset_from(clip[2], ndc);
    let weights = vec3<f32>(cross2(b, c), cross2(c, a), cross2(a, b));
    let wa = clip[0].w;
    let wb = clip[1].w;
    let wc = clip[2].w;
    let per_x = vec3<f32>(b.y * wc - c.y * wb, c.y * wa - a.y * wc, a.y * wb - b.y * wa);
    let per_y = vec3<f32>(wb * c.x - wc * b.x, wc * a.x - wa * c.x, wa * b.x - wb * a.x);
    var top = vec2<f32>(per_x.x + per_x.y + per_x.z, per_y.x + per_y.y + per_y.z);
    var bottom = weights.x * depths.x + weights.y * depths.y + weights.z * depths.z;
    if view.perspective < 0.5 {
        top = vec2<f32>(
            per_x.x * depths.x + per_x.y * depths.y + per_x.z * depths.z,
            per_y.x * depths.x + per_y.y * depths.y + per_y.z * depths.z,
        );
        bottom = weights.x + weights.y + weights.z;
    }
    if bottom == 0.0 { return vec2<f32>(0.0); }
    let ndc_per_pixel = vec2<f32>(2.0, -2.0) * window.frame_step / view.frame_px;
    return vec2<f32>(top.x / bottom * ndc_per_pixel.x, top.y / bottom * ndc_per_pixel.y);
}

// The pixel of a triangle at a point of the frame.
fn pixel_of_triangle(triangle: Triangle, frame_px: vec2<f32>) -> GPixel {
    let a = posed[triangle.corners.x];
    let b = posed[triangle.corners.y];
    let c = posed[triangle.corners.z];
    let clip = array<vec4<f32>, 3>(a.clip, b.clip, c.clip);
    let weights = weights_at(clip, ndc_at(view, frame_px));

    var pixel: GPixel;
    pixel.plane_step = plane_step(clip, vec3<f32>(a.depth, b.depth, c.depth), ndc_at(view, frame_px));
    pixel.depth = blend(weights, a.depth, b.depth, c.depth);
    pixel.half_width = blend(weights, a.half_width, b.half_width, c.half_width);
    let smooth_normal = blend3(weights, a.normal, b.normal, c.normal);
    let folds = (parts[triangle.part].flags & PART_FOLDS) != 0u;
    let normal = select(smooth_normal, face_normal(a.world, b.world, c.world), folds);
    pixel.normal = pack_unit(select(-normal, normal, faces_eye(clip)));
    pixel.part = triangle.part;
    return pixel;
}

// One invocation per pixel.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let element = element_index(wid, nwg, lid, WG);
    if element >= arrayLength(&gbuffer) { return; }

    let pixel = pixel_of(element, window.size);
    let id = textureLoad(ids, pixel, 0).x & ID_MASK;
    if id == 0u {
        gbuffer[element] = empty_pixel();
        return;
    }
    gbuffer[element] = pixel_of_triangle(triangles[id - 1u], frame_at(window, pixel));
}
