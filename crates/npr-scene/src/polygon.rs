//! Triangles of polygons.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

/// Cuts a polygon into triangles that all share its first corner.
///
/// Right for convex polygons, which is what OBJ and PLY files hold by custom; a concave one keeps its
/// outline only where its first corner sees all others.
pub(crate) fn fan<T: Copy>(corners: &[T]) -> impl Iterator<Item = [T; 3]> {
    let (hub, rim) = corners
        .split_first()
        .map_or((None, corners), |(hub, rim)| (Some(*hub), rim));
    hub.into_iter()
        .flat_map(|hub| rim.array_windows().map(move |&[b, c]| [hub, b, c]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polygon_of_n_corners_makes_n_minus_2_triangles() {
        assert_eq!(
            fan(&[4, 5, 6, 7]).collect::<Vec<_>>(),
            [[4, 5, 6], [4, 6, 7]]
        );
        assert_eq!(fan(&[4, 5]).count(), 0);
        assert_eq!(fan::<u32>(&[]).count(), 0);
    }
}
