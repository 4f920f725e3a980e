// Unit vectors in 32 bits. Twin: npr_core::math::{pack_unit, unpack_unit}.

fn snorm16(v: f32) -> u32 {
    return bitcast<u32>(i32(floor(v * 32767.0 + 0.5)));
}

fn from_snorm16(bits: u32) -> f32 {
    return f32(bitcast<i32>(bits) >> 16u) / 32767.0;
}

fn fold(xy: vec2<f32>) -> vec2<f32> {
    let folded = vec2<f32>(1.0 - abs(xy.y), 1.0 - abs(xy.x));
    return select(folded, -folded, xy < vec2<f32>(0.0));
}

fn pack_unit(v: vec3<f32>) -> u32 {
    let sum = abs(v.x) + abs(v.y) + abs(v.z);
    if !(sum > 0.0 && sum < 3.0e38) { return 0u; }
    var xy = vec2<f32>(v.x / sum, v.y / sum);
    if v.z < 0.0 { xy = fold(xy); }
    return (snorm16(xy.x) & 0xffffu) | (snorm16(xy.y) << 16u);
}

fn unpack_unit(packed: u32) -> vec3<f32> {
    var xy = vec2<f32>(from_snorm16(packed << 16u), from_snorm16(packed));
    let z = 1.0 - abs(xy.x) - abs(xy.y);
    if z < 0.0 { xy = fold(xy); }
    let length = sqrt(xy.x * xy.x + xy.y * xy.y + z * z);
    return vec3<f32>(xy.x / length, xy.y / length, z / length);
}
