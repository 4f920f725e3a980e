// Sides in the order of their loops. Twins: npr_vector::pixel_strokes::looped, strip.

//# use lib/geometry

struct Spot {
    start: u32,
    length: u32,
}

struct Planar {
    x: f32,
    y: f32,
}

struct Filter {
    radius: u32,
    unit: u32,
    unused: vec2<u32>,
}

struct CullRule {
    least_cos: f32,
    vote_radius: u32,
    vote_margin: u32,
    short: u32,
}

struct StripSpot {
    start: u32,
    rank: u32,
}

const LEAST_SQUARE: f32 = 1e-12;

// The side after another, around the loop.
fn after(spot: Spot, element: u32) -> u32 {
    let next = element + 1u;
    return select(next, spot.start, next >= spot.start + spot.length);
}

// The side before another, around the loop.
fn before(spot: Spot, element: u32) -> u32 {
    return select(element - 1u, spot.start + spot.length - 1u, element <= spot.start);
}

// The side a radius before another, around the loop as often as it takes.
fn back(spot: Spot, element: u32, radius: u32) -> u32 {
    let from_start = element - spot.start + spot.length - radius % spot.length;
    return spot.start + from_start % spot.length;
}

// The vector of length 1; zero for a vector without direction.
fn unit_of(v: Planar) -> Planar {
    let square = v.x * v.x + v.y * v.y;
    var unit: Planar;
    if square > LEAST_SQUARE {
        let r = 1.0 / sqrt(square);
        unit.x = v.x * r;
        unit.y = v.y * r;
    }
    return unit;
}
