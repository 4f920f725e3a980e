// Shadows of smoke on surfaces. Twin: npr_style::smoke::smoke_layer.
// The shader declares `compose`, `lights` and `smoke_shadow_0` to `smoke_shadow_3`.

//# use lib/depth_map

fn smoke_texel(map: u32, at: vec2<u32>) -> f32 {
    switch map {
        case 0u: { return textureLoad(smoke_shadow_0, at, 0); }
        case 1u: { return textureLoad(smoke_shadow_1, at, 0); }
        case 2u: { return textureLoad(smoke_shadow_2, at, 0); }
        default: { return textureLoad(smoke_shadow_3, at, 0); }
    }
}

// Whether smoke lies between a place and the light of a shadow image.
fn is_behind_smoke(map: u32, world: vec3<f32>) -> bool {
    let side = compose.smoke_shadow_side;
    if side == 0u { return false; }
    let texels = texels_around(lights.shadows[map], side, world);
    if !texels.is_seen { return false; }
    let low = texels.low;
    return are_nearer(texels, vec4<f32>(
        smoke_texel(map, low),
        smoke_texel(map, low + vec2<u32>(1u, 0u)),
        smoke_texel(map, low + vec2<u32>(0u, 1u)),
        smoke_texel(map, low + vec2<u32>(1u, 1u)),
    ));
}
