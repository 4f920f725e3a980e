// Ink in a picture and the sides of its pixels. Twin: npr_vector::pixel_strokes::side.

//# use lib/grid
//# use lib/looped

// Pixels whose sides share a word of masks: four bits each, those of the first lowest.
const PIXELS_A_WORD: u32 = 8u;

// Pixels whose ink shares a word: a bit each, that of the first lowest.
const BITS_A_WORD: u32 = 32u;

struct Side {
    code: u32,
    segment: u32,
    nearest: u32,
    extent: Planar,
}

// Steps in the four directions: right, down, left, up.
fn ahead_of(direction: u32) -> vec2<i32> {
    switch direction & 3u {
        case 0u: { return vec2<i32>(1, 0); }
        case 1u: { return vec2<i32>(0, 1); }
        case 2u: { return vec2<i32>(-1, 0); }
        default: { return vec2<i32>(0, -1); }
    }
}

// The step from a pixel out over one of its sides: a quarter turn to the left of the side's direction.
fn outward(direction: u32) -> vec2<i32> {
    return ahead_of(direction + 3u);
}

// Whether a pixel has ink; pixels beyond the picture have none.
fn ink_at(ink: texture_2d<u32>, at: vec2<i32>) -> bool {
    let size = vec2<i32>(textureDimensions(ink));
    if any(at < vec2<i32>(0)) || any(at >= size) { return false; }
    return textureLoad(ink, at, 0).r != 0u;
}
