// Rows of tones in the texture store. Twin: npr_style::tone_row. The shader declares `texels` and `parts`.

const ROW_LENGTH: u32 = 1024u;

fn row_place(x: f32) -> u32 {
    return min(u32(max(x, 0.0) * f32(ROW_LENGTH)), ROW_LENGTH - 1u);
}

fn row_light(row: u32, x: f32) -> vec3<f32> {
    let at = row + 4u * row_place(x);
    return bitcast<vec3<f32>>(vec3<u32>(texels[at], texels[at + 1u], texels[at + 2u]));
}

// Whether a row has one tone over all of `range`.
fn row_is_even(row: u32, range: vec2<f32>) -> bool {
    return texels[row + 4u * row_place(range.x) + 3u] >= row_place(range.y);
}

// Whether the tones of a part are a row.
fn has_tone_row(part: u32) -> bool {
    return (parts[part].flags & PART_TONE_ROW) != 0u;
}
