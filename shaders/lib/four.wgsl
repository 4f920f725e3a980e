// Values of the four samples of a pixel. Locally indexed arrays are slow on graphics devices; these are vectors.

// The bits of a set of samples.
fn bits_of(samples: vec4<bool>) -> u32 {
    let bits = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), samples);
    return bits.x | bits.y | bits.z | bits.w;
}

// The samples of a set of bits.
fn samples_in(bits: u32) -> vec4<bool> {
    return (vec4<u32>(bits) & vec4<u32>(1u, 2u, 4u, 8u)) != vec4<u32>(0u);
}

// The value of sample `i`.
fn of_sample(values: vec4<u32>, i: u32) -> u32 {
    let row = select(values.xy, values.zw, i >= 2u);
    return select(row.x, row.y, (i & 1u) != 0u);
}

// The sum over the samples in a set, in their order.
fn sum_over(values: vec4<f32>, samples: vec4<bool>) -> f32 {
    let held = select(vec4<f32>(0.0), values, samples);
    return ((held.x + held.y) + held.z) + held.w;
}
