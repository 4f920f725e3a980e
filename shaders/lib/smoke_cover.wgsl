// Which samples of a pixel smoke covers. Twin: npr_style::smoke::resolve. The shader declares `compose` and
// `smoke_depths`.

//# use lib/compose

const SMOKE_LAYER_MASK: u32 = 15u;

// Whether smoke covers any sample of a pixel.
fn has_smoke(pixel: vec2<u32>) -> bool {
    return (compose.flags & COMPOSE_SMOKE) != 0u && (textureLoad(smoke_depths, pixel, 0).x & SMOKE_LAYER_MASK) != 0u;
}
