// Words of the tone map and of the evened map. Twin: npr_style::even_tones.

// Bits of the tone of each of the four samples in a word of the tone map; the number of the part plus one lies above
// them.
const TONE_BITS: u32 = 3u;

// Bits of all of them.
const ALL_TONE_BITS: u32 = 12u;

// What a tone is multiplied by for four samples that have it.
const FOUR_TONES: u32 = 585u;

// What a hatch is to the knife, in the place of a tone.
const CUT_TONE: u32 = 0u;
const CUT_PAPER: u32 = 1u;
const CUT_BLACK: u32 = 2u;

// The tones of a ramp.
const TONES: u32 = 8u;

// Pixels of each side of a tile that is looked at as a whole.
const TONE_TILE: u32 = 8u;

// Parts of a step between two tones in a word of the evened map.
const STEP_PARTS: u32 = 256u;

// Bits of the steps in a word of the evened map.
const STEP_BITS: u32 = 11u;

// The bit of a changed tone above them; the number of the part plus one, as far as it has room, lies above that.
const CHANGED: u32 = 2048u;

// How far a disc moves away from other parts, in distances of its middle from the centroid of its pixels that show its
// own part.
const SHIFT_OF_CENTROID: f32 = 1.6;

// Farthest that it moves along each axis, in radii.
const SHIFT_OF_RADIUS: f32 = 0.7;

// Largest radius of a disc all of whose pixels are counted, in pixels.
const DENSE_REACH_PX: f32 = 12.0;

// Pixels between those that a disc of a radius counts.
fn stride_px(reach_px: f32) -> u32 {
    return max(u32(ceil(reach_px / DENSE_REACH_PX)), 1u);
}

// Pixels to each side that tones are looked at, by the radius of the disc.
fn far_px(reach_px: f32) -> u32 {
    return u32(ceil(reach_px * (1.0 + SHIFT_OF_RADIUS) + 0.5));
}

// The part in a word of the evened map.
fn tag_of(part: u32) -> u32 {
    return (part + 1u) << (STEP_BITS + 1u);
}

// The tone that a word of the evened map has most of, in steps.
fn median_of(word: u32) -> u32 {
    return ((word & (CHANGED - 1u)) + STEP_PARTS / 2u) / STEP_PARTS;
}

// The part in a word of the evened map, or of the tone map.
fn part_in(word: u32) -> u32 {
    return (word >> ALL_TONE_BITS) - 1u;
}

// Whether the hatch of a part is cut out.
fn is_cut(part: u32) -> bool {
    return (parts[part].flags & PART_CUT) != 0u;
}
