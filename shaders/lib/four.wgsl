// Values of the four samples of a pixel, as vectors. What a variable indexes lies in memory, which is slow: none of
// these is.

// The bits of a set of samples.
fn bits_of(samples: vec4<bool>) -> u32 {
    let bits = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), samples);
    return bits.x | bits.y | bits.z | bits.w;
}

// The samples of a set of bits.
fn samples_in(bits: u32) -> vec4<bool> {
    return (vec4<u32>(bits) & vec4<u32>(1u, 2u, 4u, 8u)) != vec4<u32>(0u);
}

// The number of sample `i`.
fn number_of(values: vec4<u32>, i: u32) -> u32 {
    let row = select(values.xy, values.zw, i >= 2u);
    return select(row.x, row.y, (i & 1u) != 0u);
}

// The sum over the samples in a set, in their order.
fn sum_over(values: vec4<f32>, samples: vec4<bool>) -> f32 {
    let held = select(vec4<f32>(0.0), values, samples);
    return ((held.x + held.y) + held.z) + held.w;
}

// The values with that of sample `i` set.
fn with_sample(values: vec4<f32>, i: u32, value: f32) -> vec4<f32> {
    return select(values, vec4<f32>(value), vec4<u32>(0u, 1u, 2u, 3u) == vec4<u32>(i));
}

// The same for whole numbers.
fn with_number(values: vec4<u32>, i: u32, value: u32) -> vec4<u32> {
    return select(values, vec4<u32>(value), vec4<u32>(0u, 1u, 2u, 3u) == vec4<u32>(i));
}

// The value of sample `i`.
fn value_at(values: vec4<f32>, i: u32) -> f32 {
    let row = select(values.xy, values.zw, i >= 2u);
    return select(row.x, row.y, (i & 1u) != 0u);
}
