// Hulls among the triangles of a picture.

// Whether a number is that of a triangle's hull.
fn is_of_hull(id: u32) -> bool {
    return (id & HULL_BIT) != 0u;
}
