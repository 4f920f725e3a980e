//! Small passes whose result is obvious.

use npr_gpu::pass::{Agreement, Format, Pass, Work, layered, read, texture, uniform, write};
use npr_shaders::Shader;

const fn shader(text: &'static str) -> Shader {
    Shader { path: "test", text }
}

/// `doubled[i] = 2 * numbers[i] + i`.
pub const DOUBLE: Pass = Pass {
    name: "test.double",
    shader: shader(
        "const WG: u32 = 64u;
        @group(0) @binding(0) var<storage, read> numbers: array<u32>;
        @group(0) @binding(1) var<storage, read_write> doubled: array<u32>;
        @compute @workgroup_size(WG)
        fn main(
            @builtin(workgroup_id) wid: vec3<u32>,
            @builtin(num_workgroups) nwg: vec3<u32>,
            @builtin(local_invocation_id) lid: vec3<u32>,
        ) {
            let element = (wid.y * nwg.x + wid.x) * WG + lid.x;
            if element >= arrayLength(&numbers) { return; }
            doubled[element] = 2u * numbers[element] + element;
        }",
    ),
    slots: &[read::<u32>("numbers"), write::<u32>("doubled")],
    work: Work::PerElement { of: "numbers" },
    agreement: Agreement::Exact,
    twin: |bindings| {
        let numbers: &[u32] = bindings.read(0);
        let doubled: &mut [u32] = bindings.write(1);
        for (element, (to, from)) in doubled.iter_mut().zip(numbers).enumerate() {
            *to = from.wrapping_mul(2).wrapping_add(element as u32);
        }
    },
};

/// Fills the whole picture with the largest of `numbers`: of all full-screen triangles, the nearest wins.
pub const DRAW_LARGEST: Pass = Pass {
    name: "test.draw_largest",
    shader: shader(
        "@group(0) @binding(0) var<storage, read> numbers: array<u32>;
        struct Varying {
            @builtin(position) position: vec4<f32>,
            @location(0) @interpolate(flat, either) number: u32,
        }
        @vertex
        fn vertex(@builtin(vertex_index) index: u32) -> Varying {
            var passed: Varying;
            passed.number = numbers[index / 3u];
            let x = f32((index % 3u) & 1u) * 4.0 - 1.0;
            let y = f32((index % 3u) >> 1u) * 4.0 - 1.0;
            passed.position = vec4<f32>(x, y, f32(passed.number) / 256.0, 1.0);
            return passed;
        }
        @fragment
        fn fragment(passed: Varying) -> @location(0) u32 { return passed.number; }",
    ),
    slots: &[read::<u32>("numbers")],
    work: Work::Draw {
        of: "numbers",
        vertices: 3,
        targets: &[Format::U32, Format::Depth],
        fills: false,
    },
    agreement: Agreement::Exact,
    twin: |bindings| {
        let largest = bindings
            .read::<u32>(0)
            .iter()
            .copied()
            .max()
            .unwrap_or_default();
        let nearest = (largest as f32 / 256.0).to_bits();
        let (texels, depths) = (bindings.image_mut(1).texels, bindings.image_mut(2).texels);
        for (texel, depth) in texels.iter_mut().zip(depths) {
            if nearest > *depth {
                (*texel, *depth) = (largest, nearest);
            }
        }
    },
};

/// Lays depths, as bits, over a picture of the given width: what tests put into an image that nothing but draws may
/// write.
pub const LAY_DEPTHS: Pass = Pass {
    name: "test.lay_depths",
    shader: shader(
        "@group(0) @binding(0) var<storage, read> width: array<u32>;
        @group(0) @binding(1) var<storage, read> depths: array<u32>;
        @vertex
        fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
            return vec4<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.5, 1.0);
        }
        @fragment
        fn fragment(@builtin(position) position: vec4<f32>) -> @builtin(frag_depth) f32 {
            let pixel = vec2<u32>(position.xy);
            return bitcast<f32>(depths[pixel.y * width[0] + pixel.x]);
        }",
    ),
    slots: &[read::<u32>("width"), read::<u32>("depths")],
    work: Work::Draw {
        of: "width",
        vertices: 3,
        targets: &[Format::Depth],
        fills: true,
    },
    agreement: Agreement::Exact,
    twin: |bindings| {
        let depths = bindings.read(1);
        bindings.image_mut(2).texels.copy_from_slice(depths);
    },
};

/// `sums[i] = texel i of the picture + step`, over an image of numbers and one of bytes.
pub const ADD_TEXELS: Pass = Pass {
    name: "test.add_texels",
    shader: shader(
        "const WG: u32 = 64u;
        @group(0) @binding(0) var<uniform> step: vec4<u32>;
        @group(0) @binding(1) var numbers: texture_2d<u32>;
        @group(0) @binding(2) var bytes: texture_2d<f32>;
        @group(0) @binding(3) var<storage, read_write> sums: array<u32>;
        @compute @workgroup_size(WG)
        fn main(@builtin(global_invocation_id) gid: vec3<u32>) {
            if gid.x >= arrayLength(&sums) { return; }
            let width = textureDimensions(numbers).x;
            let pixel = vec2<u32>(gid.x % width, gid.x / width);
            let byte = u32(textureLoad(bytes, pixel, 0).r * 255.0 + 0.5);
            sums[gid.x] = textureLoad(numbers, pixel, 0).r + byte + step.x;
        }",
    ),
    slots: &[
        uniform::<[u32; 4]>("step"),
        texture("numbers", Format::U32),
        texture("bytes", Format::Rgba8),
        write::<u32>("sums"),
    ],
    work: Work::PerElement { of: "sums" },
    agreement: Agreement::Exact,
    twin: |bindings| {
        let step: [u32; 4] = bindings.one(0);
        let (numbers, bytes) = (bindings.image(1).texels, bindings.image(2).texels);
        let sums: &mut [u32] = bindings.write(3);
        for (i, sum) in sums.iter_mut().enumerate() {
            *sum = numbers[i] + (bytes[i] & 0xff) + step[0];
        }
    },
};

/// `sums[i]`: every layer's texel `i`, times the number of the layer from 1 on; depths count in 1/256.
pub const ADD_LAYERS: Pass = Pass {
    name: "test.add_layers",
    shader: shader(
        "const WG: u32 = 64u;
        @group(0) @binding(0) var numbers: texture_2d_array<u32>;
        @group(0) @binding(1) var depths: texture_depth_2d_array;
        @group(0) @binding(2) var<storage, read_write> sums: array<u32>;
        @compute @workgroup_size(WG)
        fn main(@builtin(global_invocation_id) gid: vec3<u32>) {
            if gid.x >= arrayLength(&sums) { return; }
            let width = textureDimensions(numbers).x;
            let pixel = vec2<u32>(gid.x % width, gid.x / width);
            var sum = 0u;
            for (var i = 0u; i < textureNumLayers(numbers); i++) {
                sum += (i + 1u) * textureLoad(numbers, pixel, i, 0).r;
            }
            for (var i = 0u; i < textureNumLayers(depths); i++) {
                sum += (i + 1u) * u32(textureLoad(depths, pixel, i, 0) * 256.0);
            }
            sums[gid.x] = sum;
        }",
    ),
    slots: &[
        layered("numbers", Format::U32),
        layered("depths", Format::Depth),
        write::<u32>("sums"),
    ],
    work: Work::PerElement { of: "sums" },
    agreement: Agreement::Exact,
    twin: |bindings| {
        let [numbers, depths]: [[&[u32]; 4]; 2] = [bindings.layers(0), bindings.layers(1)];
        let sums: &mut [u32] = bindings.write(2);
        for (i, sum) in sums.iter_mut().enumerate() {
            let number = |texel: &u32| *texel;
            let depth = |texel: &u32| (f32::from_bits(*texel) * 256.0) as u32;
            let added = |layers: [&[u32]; 4], value: &dyn Fn(&u32) -> u32| -> u32 {
                let texels = layers.iter().map(|layer| layer.get(i).map_or(0, value));
                (1..).zip(texels).map(|(times, value)| times * value).sum()
            };
            *sum = added(numbers, &number) + added(depths, &depth);
        }
    },
};
