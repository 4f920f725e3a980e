//! Depths of the surfaces that hide lines: [`draw_surfaces`] is the twin of `vector.draw_surfaces`.

use super::segment::PixelView;
use npr_core::geometry::{Part, Triangle};
use npr_core::raster::{Fill, Sides, fill_triangles};
use npr_core::surface::apply_point;
use npr_core::window::{View, Window};
use npr_mesh::half_edge::HalfEdgeMesh;

/// Reversed depth of the surface at every pixel, 0 where there is none: what lines are tested against.
///
/// Both sides of all faces hide. O(faces + pixels), in parallel.
pub fn scene_depths(shape: &HalfEdgeMesh, view: &View) -> Vec<f32> {
    let (_, depths) = fill(&PixelView::new(view), &shape.faces, |vertex| {
        shape.positions[vertex as usize]
    });
    depths.into_iter().map(f32::from_bits).collect()
}

/// The same depths as bits, for faces given as three corners each.
pub fn draw_surfaces(view: &PixelView, positions: &[f32], corners: &[u32], depths: &mut [u32]) {
    let (faces, _) = corners.as_chunks::<3>();
    let (_, found) = fill(view, faces, |vertex| {
        std::array::from_fn(|i| positions[3 * vertex as usize + i])
    });
    depths.copy_from_slice(&found);
}

/// The number plus one of the face that shows at every pixel, 0 where there is none, and its reversed depth as bits.
pub(crate) fn fill(
    view: &PixelView,
    faces: &[[u32; 3]],
    position: impl Fn(u32) -> [f32; 3] + Sync,
) -> (Vec<u32>, Vec<u32>) {
    let frame_px = view.size.map(|side| side as f32);
    let count = view.size[0] as usize * view.size[1] as usize;

    // Take all faces, seen from both sides.
    let triangles: Vec<Triangle> = faces
        .iter()
        .map(|corners| Triangle {
            corners: *corners,
            part: 0,
        })
        .collect();
    let fill = Fill {
        window: &Window::over(frame_px, [0.0; 2], frame_px, view.size),
        triangles: &triangles,
        parts: &[Part::default()],
        sides: Sides::Both,
        id_bits: 0,
        clip_of: |vertex: u32| apply_point(&view.clip_from_world, position(vertex)),
        keep: |_, _, _| true,
    };

    // Fill the pixels with the nearest.
    let (mut ids, mut depths) = (vec![0; count], vec![0; count]);
    fill_triangles(&fill, &mut ids, &mut depths);
    (ids, depths)
}
