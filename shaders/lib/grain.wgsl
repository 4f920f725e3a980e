// The grain of paper. Twin: npr_core::grain.

//# use lib/random

const SEED: u32 = 0x67726169u;
const COARSE: f32 = 0.65;
const SPREAD: f32 = 1.6;

// Height of the paper at a place of the picture, 0 in a valley to 1 on a hill.
fn paper_height(px: vec2<f32>, spots_per_px: f32) -> f32 {
    let coarse = hills(px * spots_per_px, 0u);
    let fine = hills(px * spots_per_px * 2.0, 1u);
    let height = coarse * COARSE + fine * (1.0 - COARSE);
    return clamp((height - 0.5) * SPREAD + 0.5, 0.0, 1.0);
}

// Smooth heights of 0..1, one at every whole place.
fn hills(place: vec2<f32>, octave: u32) -> f32 {
    let cell = floor(place);
    let off = place - cell;
    let share = off * off * (3.0 - 2.0 * off);
    let first = bitcast<vec2<u32>>(vec2<i32>(cell));
    let top = hills_in_row(first, octave, share.x);
    let bottom = hills_in_row(first + vec2<u32>(0u, 1u), octave, share.x);
    return top + (bottom - top) * share.y;
}

fn hills_in_row(cell: vec2<u32>, octave: u32, share: f32) -> f32 {
    let line = mix_bits(mix_bits(SEED + octave) + cell.y);
    let left = unit_of(mix_bits(line + cell.x));
    return left + (unit_of(mix_bits(line + cell.x + 1u)) - left) * share;
}
