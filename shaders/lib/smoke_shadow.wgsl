// Shadows of smoke on surfaces. Twin: npr_style::smoke::smoke_layer.
// The shader declares `compose`, `lights` and `smoke_shadows`.

//# use lib/depth_map

// Whether smoke lies between a place and the light of a shadow image.
fn is_behind_smoke(map: u32, world: vec3<f32>) -> bool {
    let side = compose.smoke_shadow_side;
    if side == 0u { return false; }
    let texels = texels_around(lights.shadows[map], side, world);
    if !texels.is_seen { return false; }
    let low = texels.low;
    return are_nearer(texels, vec4<f32>(
        textureLoad(smoke_shadows, low, map, 0),
        textureLoad(smoke_shadows, low + vec2<u32>(1u, 0u), map, 0),
        textureLoad(smoke_shadows, low + vec2<u32>(0u, 1u), map, 0),
        textureLoad(smoke_shadows, low + vec2<u32>(1u, 1u), map, 0),
    ));
}
