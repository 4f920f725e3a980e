// Pictures without hulls.

fn is_of_hull(id: u32) -> bool {
    return false;
}
