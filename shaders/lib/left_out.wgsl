// Pixels that a picture without lines leaves out. The shader declares `compose` and `fronts`.

//# use lib/compose
//# use lib/backdrop

// Whether a picture without lines leaves a pixel out: nothing needs the colours of its tile.
fn is_left_out(pixel: vec2<u32>) -> bool {
    return (compose.flags & COMPOSE_BARE) != 0u && textureLoad(fronts, pixel / BORDER_TILE, 0).a == 0.0;
}
