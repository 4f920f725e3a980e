//! Spots of a triangle in which a picture on it is looked at.

/// The middles of the `rows * rows` equal triangles that one is cut into by lines along its sides.
pub(crate) fn middles([a, b, c]: [[f32; 2]; 3], rows: u32) -> impl Iterator<Item = [f32; 2]> {
    let thirds = (rows * 3) as f32;
    let middle = move |along: u32, up: u32| {
        let (s, t) = (along as f32 / thirds, up as f32 / thirds);
        std::array::from_fn(|i| a[i] + (b[i] - a[i]) * s + (c[i] - a[i]) * t)
    };
    (0..rows).flat_map(move |up| {
        let upright = (0..rows - up).map(move |along| middle(3 * along + 1, 3 * up + 1));
        let turned = (0..rows - up - 1).map(move |along| middle(3 * along + 2, 3 * up + 2));
        upright.chain(turned)
    })
}
