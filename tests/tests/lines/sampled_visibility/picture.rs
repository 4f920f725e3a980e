//! The G-buffer of a shape.

use npr_core::camera::Camera;
use npr_core::geometry::{GPixel, Part, PosedVertex, Triangle};
use npr_core::raster::{Fill, Sides, fill_triangles};
use npr_core::window::{View, Window};
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_vector::screen::gbuffer::{Surfaces, resolve};

/// The surface seen at every pixel; parts are the shape's surfaces, seen from both sides.
pub fn gbuffer(shape: &HalfEdgeMesh, camera: &Camera, view: &View, window: &Window) -> Vec<GPixel> {
    let surfaces = shape.surfaces.iter().map(|surface| Part {
        object: surface.object,
        material: surface.material,
        flags: Part::DOUBLE_SIDED,
        ..Part::default()
    });
    let faces = shape.faces.iter().zip(&shape.face_surfaces);
    let triangles: Vec<Triangle> = faces
        .map(|(corners, part)| Triangle {
            corners: *corners,
            part: *part,
        })
        .collect();
    let posed: Vec<PosedVertex> = (shape.positions.iter())
        .map(|position| pose(*position, camera, view))
        .collect();
    let on = Surfaces {
        view,
        window,
        posed: &posed,
        triangles: &triangles,
        parts: &surfaces.collect::<Vec<_>>(),
    };
    let mut gbuffer = vec![GPixel::EMPTY; (window.size[0] * window.size[1]) as usize];
    resolve(&on, &ids(&on), &mut gbuffer);
    gbuffer
}

/// The number of the nearest triangle at every pixel.
fn ids(on: &Surfaces<'_>) -> Vec<u32> {
    let pixels = (on.window.size[0] * on.window.size[1]) as usize;
    let (mut ids, mut depths) = (vec![0; pixels], vec![0; pixels]);
    let fill = Fill {
        window: on.window,
        triangles: on.triangles,
        parts: on.parts,
        sides: Sides::AsParts,
        id_bits: 0,
        clip_of: |vertex: u32| on.posed[vertex as usize].clip,
        keep: |_, _, _| true,
    };
    fill_triangles(&fill, &mut ids, &mut depths);
    ids
}

fn pose(world: [f32; 3], camera: &Camera, view: &View) -> PosedVertex {
    let m = view.clip_from_world;
    let row = |i: usize| m[0][i] * world[0] + m[1][i] * world[1] + m[2][i] * world[2] + m[3][i];
    let ahead = |i: usize| (world[i] - camera.eye[i]) * view.forward_world[i];
    PosedVertex {
        clip: std::array::from_fn(row),
        world,
        depth: ahead(0) + ahead(1) + ahead(2),
        normal: [0.0, 0.0, 1.0],
        half_width: 0.0,
    }
}
