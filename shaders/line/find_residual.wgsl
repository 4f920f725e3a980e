// line.find_residual: makes stamps of mask pixels that no ribbon inked.
//
// Lines where shapes meet or interpenetrate run along no mesh edge. They are drawn as discs on the border between the
// pixels that differ, with the line width of the surface there.
//
// Source  A11 and A40: contact lines without the stubs of tessellation edges
// Twin    npr_vector::screen::residual::find
//
//# use lib/grid
//# use lib/geometry
//# use lib/window
//# use lib/outline
//# use lib/stamp

@group(0) @binding(0) var<uniform> window: Window;
@group(0) @binding(1) var<uniform> mask_window: Window;
@group(0) @binding(2) var<storage, read> parts: array<Part>;
@group(0) @binding(3) var<storage, read> gbuffer: array<GPixel>;
@group(0) @binding(4) var<storage, read> mask: array<u32>;
@group(0) @binding(5) var<storage, read> owners: array<u32>;
@group(0) @binding(6) var ribbons: texture_2d<f32>;
@group(0) @binding(7) var<storage, read_write> stamps: array<Stamp>;
@group(0) @binding(8) var<storage, read_write> found: array<atomic<u32>>;

// Half side of the box in which ink is counted, in mask pixels.
const LINE_BOX_PX: f32 = 2.0;
// Least number of inked pixels in that box for a line; fewer are crumbs of an edge that crosses here.
const LINE_INK_COUNT: u32 = 5u;

// Share of a line's own coverage from which a pixel counts as inked by it; less is the frayed end of a ribbon.
const LINE_INK_SHARE: f32 = 0.7;
// Least factor on that share, for the thinnest lines.
const THIN_INK_SHARE: f32 = 0.4;

// Half side of the box, in mask pixels, in which a line within one surface must continue.
const RUN_BOX_PX: u32 = 5u;
// Least number of owned pixels in that box for a line; fewer are the tip of a corner, or the grain of a scan.
const RUN_COUNT: u32 = 8u;
// The criteria that separate a surface from others, not from itself.
const BETWEEN: u32 = DETECT_OBJECT | DETECT_MATERIAL | DETECT_PIECE;

// What one connected surface in one material has in common, whatever ids it has.
fn skin_of(part: u32) -> vec3<u32> {
    return vec3<u32>(parts[part].object, parts[part].material, parts[part].component);
}

// Whether a surface is separated from itself along a line through a mask pixel, not only at a few pixels.
fn runs_on(at: vec2<u32>, pixel: GPixel) -> bool {
    let size = mask_window.size;
    let skin = skin_of(pixel.part);
    let low = max(at, vec2<u32>(RUN_BOX_PX)) - RUN_BOX_PX;
    let high = min(at + RUN_BOX_PX, size - 1u);
    var count = 0u;
    var y = low.y;
    loop {
        var x = low.x;
        loop {
            let element = y * size.x + x;
            // A pixel where the surface ends at another one does not separate it from itself.
            if (mask[element] & (MASK_OWNER | BETWEEN)) != MASK_OWNER { continue; }
            let other = gbuffer[element];
            if other.part == NONE { continue; }
            if all(skin_of(other.part) == skin) { count += 1u; }
            continuing {
                x += 1u;
                break if x > high.x;
            }
        }
        continuing {
            y += 1u;
            break if y > high.y;
        }
    }
    return count >= RUN_COUNT;
}

// Ink found in a box of the output: texels looked at, texels with any ink, and the sum of their coverage in steps of
// 1 / 255.
struct Ink {
    texels: u32,
    inked: u32,
    alpha: u32,
}

// Whether a ribbon runs through a point of the frame: enough ink under it, and enough around it for a line.
fn is_inked_at(px: vec2<f32>, half_width: f32) -> bool {
    let under = ink_within(px, 0.5);
    // A line through a box fills as much of it as its width does of the box's side.
    let side = sqrt(f32(under.texels));
    let filled = min(2.0 * half_width / side, 1.0);
    let full = 255.0 * f32(under.texels) * filled;
    // Borders of a coarse mask's pixels lie off the line, which then meets only a part of the box.
    let grid_step = mask_window.frame_step;
    // A thin line may pass beside the middle of the box; a gap in a thick one must not.
    let share = LINE_INK_SHARE * max(filled, THIN_INK_SHARE) / max(grid_step.x * grid_step.y, 1.0);
    let is_covered = f32(under.alpha) >= share * full && under.alpha > 0u;
    return is_covered && ink_within(px, LINE_BOX_PX).inked >= LINE_INK_COUNT;
}

// Ink of the output within `reach` mask pixels of a point of the frame, along both axes.
fn ink_within(px: vec2<f32>, reach: f32) -> Ink {
    let low = pixel_at(window, px - reach * mask_window.frame_step);
    let high = pixel_at(window, px + reach * mask_window.frame_step);
    var ink: Ink;
    var y = low.y;
    loop {
        var x = low.x;
        loop {
            let alpha = u32(textureLoad(ribbons, vec2<u32>(x, y), 0).a * 255.0 + 0.5);
            ink.texels += 1u;
            ink.alpha += alpha;
            if alpha > 0u { ink.inked += 1u; }
            continuing {
                x += 1u;
                break if x > high.x;
            }
        }
        continuing {
            y += 1u;
            break if y > high.y;
        }
    }
    return ink;
}

// From the pixel's centre to the line, in pixels: half the sum of the sides it runs along.
fn toward_line(marks: u32) -> vec2<f32> {
    var sum = vec2<f32>(0.0);
    if (marks & MASK_SIDE) != 0u { sum.x -= 0.5; }
    if (marks & (MASK_SIDE << 1u)) != 0u { sum.x += 0.5; }
    if (marks & (MASK_SIDE << 2u)) != 0u { sum.y -= 0.5; }
    if (marks & (MASK_SIDE << 3u)) != 0u { sum.y += 0.5; }
    return sum;
}

// The stamp of a mask pixel that owns a line; nothing where a ribbon runs.
fn stamp_of(element: u32, marks: u32) -> Stamp {
    var stamp: Stamp;
    let pixel = gbuffer[element];
    if pixel.part == NONE || (parts[pixel.part].flags & PART_LINES) == 0u { return stamp; }
    let at = pixel_of(element, mask_window.size);
    if (marks & BETWEEN) == 0u && !runs_on(at, pixel) { return stamp; }
    let center = frame_at(mask_window, at) + toward_line(marks) * mask_window.frame_step;
    if is_inked_at(center, pixel.half_width) { return stamp; }
    stamp.center = center;
    stamp.half_width = pixel.half_width;
    stamp.part = pixel.part;
    return stamp;
}

// One invocation per mask pixel that owns a line.
@compute @workgroup_size(WG)
fn main(
    @builtin(workgroup_id) wid: vec3<u32>,
    @builtin(num_workgroups) nwg: vec3<u32>,
    @builtin(local_invocation_id) lid: vec3<u32>,
) {
    let listed = element_index(wid, nwg, lid, WG);
    if listed >= min(owners[0], arrayLength(&owners) - 1u) { return; }

    let element = owners[listed + 1u];
    let stamp = stamp_of(element, mask[element]);
    stamps[element] = stamp;
    if stamp.half_width > 0.0 {
        atomicStore(&found[atomicAdd(&found[0], 1u) + 1u], element);
    }
}
