// Pixels of one colour where tones are evened. Twin: npr_style::even_tones.
// The shader declares `window`, `known`, `parts` and `evened`.

//# use lib/even_tones

// Number of the part that a sample shows, plus one, if its tones are evened; else 0.
fn evened_part_of(id: u32) -> u32 {
    if id == 0u { return 0u; }
    let part = known[id - 1u].part;
    return select(0u, part + 1u, is_evened(part));
}

// Whether a sample shows a part, or nothing.
fn is_of_part(id: u32, part: u32) -> bool {
    if id == 0u { return true; }
    return known[id - 1u].part == part;
}

// Whether a pixel whose samples show triangles of one known colour shows it when tones are evened: it shows a single
// part, and the tones of that in and around the pixel are alike and as they were found.
fn is_settled(pixel: vec2<u32>, seen: vec4<u32>) -> bool {
    let first = max(evened_part_of(seen.x), evened_part_of(seen.y));
    let own = max(first, max(evened_part_of(seen.z), evened_part_of(seen.w)));
    if own == 0u { return true; }
    let part = own - 1u;
    let around = evened_around(pixel, part);
    return around.least == around.most && around.is_own && !around.is_changed
        && is_of_part(seen.x, part) && is_of_part(seen.y, part) && is_of_part(seen.z, part) && is_of_part(seen.w, part);
}
