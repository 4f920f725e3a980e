// Finds the element of a scan that a place belongs to. Twin: npr_vector::pixel_strokes::fragment::holder_of. The shader
// declares `starts`.

// The last of the first `count` starts, in ascending order, that is not above a value.
fn holder_of(value: u32, count: u32) -> u32 {
    var low = 0u;
    var high = min(count, arrayLength(&starts));
    while low + 1u < high {
        let middle = low + (high - low) / 2u;
        if starts[middle] <= value { low = middle; } else { high = middle; }
    }
    return low;
}
