// Numbers that look random. Twins: npr_core::math::mix_bits, npr_core::random.

// A permutation of the 32-bit numbers that looks random.
fn mix_bits(number: u32) -> u32 {
    var x = number;
    x = (x ^ (x >> 16u)) * 0x7feb352du;
    x = (x ^ (x >> 15u)) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

// A hash as a number of 0..1, 1 left out.
fn unit_of(hash: u32) -> f32 {
    return f32(hash >> 8u) / 16777216.0;
}
