// Numbering of invocations and pixels.

// Invocations of a workgroup.
const WG: u32 = 64u;

// The element of an invocation. Counts past 65535 workgroups are dispatched in rows.
fn element_index(wid: vec3<u32>, nwg: vec3<u32>, lid: vec3<u32>, wg: u32) -> u32 {
    return (wid.y * nwg.x + wid.x) * wg + lid.x;
}

// The pixel of an element of a row-major grid.
fn pixel_of(element: u32, size: vec2<u32>) -> vec2<u32> {
    return vec2<u32>(element % size.x, element / size.x);
}
