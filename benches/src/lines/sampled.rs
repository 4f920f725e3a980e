//! Lines as the passes of a frame see them with sampled sights, for measuring beside the reference.

use glam::Vec3;
use npr_core::camera::Camera;
use npr_core::crease::{CreaseFrom, Creases};
use npr_core::geometry::{Part, PosedVertex, Triangle};
use npr_core::line_kind::KindSet;
use npr_core::raster::{Fill, Sides, fill_triangles};
use npr_core::surface::apply_point;
use npr_core::window::{View, Window};
use npr_drawing::ink::BrushLay;
use npr_drawing::sampled::{Sampling, sample_strokes};
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_render::LineModel;
use npr_vector::ink_point::InkPoint;
use npr_vector::mesh_lines::contour::EdgeContours;
use npr_vector::mesh_lines::draw::{
    LineSettings, LineSource, Prepared, StrokeLook, eye_of, spines,
};
use npr_vector::project::Projector;
use npr_vector::sampled::{PartWidth, Scenery, inked, see_samples, visible_samples};
use npr_vector::stroke::{Drawing, Stroke, StrokePoint};

use super::candidates::Wanted;

/// Samples that there is room for: as many as a frame of 1920x1080 has.
const ROOM: usize = 1 << 17;

/// Even strokes without a taper, of which none is too short.
const EVEN: PartWidth = PartWidth {
    along: [[1.0; 4]; 8],
    taper_px: [0.0; 2],
    taper_share: 0.0,
    tip: 1.0,
    short_px: 0.0,
    speck_px: 0.0,
    at_all_ends: 0,
    radius: 1,
};

/// The strokes that sampled sights show in a picture of `size` pixels, on surfaces that are seen from both sides.
///
/// # Panics
///
/// When memory runs out, or the model has more lines than there is room for.
pub fn sampled_drawing(
    model: &LineModel,
    camera: &Camera,
    size: [u32; 2],
    wanted: &Wanted,
) -> Drawing {
    // Find the lines, seen or not.
    let shape = model.shape();
    let projector = Projector::new(camera, size, model.bounds());
    let settings = LineSettings {
        size,
        kinds: wanted.kinds.iter().copied().collect::<KindSet>().bits(),
        method: LineSource::Edges,
        smooth: false,
        hidden: false,
        split: None,
        memory_limit: u64::MAX,
    };
    let creases = Creases::over(wanted.crease as f32, CreaseFrom::Faces);
    let prepared = Prepared::new(shape, creases, false);
    let contours = EdgeContours::new(shape, &eye_of(shape, &projector));
    let look = StrokeLook {
        width_at: &|_| 1.0,
        paint_at: None,
        is_lit: false,
        follows_bends: false,
    };
    let found = spines(shape, &prepared, &projector, &settings, &contours, &look);
    let open = Drawing {
        size,
        strokes: found.expect("no limit is set").strokes,
        ..Drawing::default()
    };

    // Look at their samples on a picture of the surfaces.
    let view = camera.view(size, model.bounds());
    let picture = Picture::new(shape, &view, size);
    let sampling = Sampling {
        view: &view,
        lay_of: &|_| BrushLay::PEN,
        width_of: &|_| 0,
    };
    let sampled = sample_strokes(&open, &sampling, ROOM).expect("room for all lines");
    let on = Scenery {
        view: &view,
        window: &picture.window,
        ids: &picture.ids,
        posed: &picture.posed,
        triangles: &picture.triangles,
    };
    let mut gaps = vec![0.0; sampled.samples.len()];
    see_samples(&on, &sampled.samples, &mut gaps);
    let visible = visible_samples(&[EVEN], &sampled.lines, &sampled.samples, &gaps);
    let seen = (&sampled.samples[..], &gaps[..]);
    let points = inked((&view, &[EVEN]), &sampled.lines, seen, &visible);

    // Make strokes of the points that hang together.
    let strokes = points
        .chunk_by(|a, _| a.goes_on())
        .filter(|row| row.len() > 1)
        .map(stroke_of);
    Drawing {
        size,
        strokes: strokes.collect(),
        ..Drawing::default()
    }
}

fn stroke_of(points: &[InkPoint]) -> Stroke {
    let points = points.iter().map(|point| StrokePoint {
        position: point.px.map(f64::from),
        ..StrokePoint::default()
    });
    Stroke {
        id: 0,
        kind: npr_vector::stroke::Kind::Contour,
        occluders: 0,
        surface: 0,
        closed: false,
        part: None,
        points: points.collect(),
    }
}

/// Which face each pixel of a picture shows.
struct Picture {
    window: Window,
    ids: Vec<u32>,
    posed: Vec<PosedVertex>,
    triangles: Vec<Triangle>,
}

impl Picture {
    fn new(shape: &HalfEdgeMesh, view: &View, size: [u32; 2]) -> Self {
        let window = Window::over(view.frame_px, [0.0; 2], view.frame_px, size);
        let triangle = |corners: &[u32; 3]| Triangle {
            corners: *corners,
            part: 0,
        };
        let triangles: Vec<Triangle> = shape.faces.iter().map(triangle).collect();
        let ahead = |world: &[f32; 3]| {
            (Vec3::from(*world) - Vec3::from(view.eye_world)).dot(Vec3::from(view.forward_world))
        };
        let pose = |world: &[f32; 3]| PosedVertex {
            clip: apply_point(&view.clip_from_world, *world),
            world: *world,
            depth: ahead(world),
            normal: [0.0, 0.0, 1.0],
            half_width: 0.0,
        };
        let posed: Vec<PosedVertex> = shape.positions.iter().map(pose).collect();
        let mut ids = vec![0; size[0] as usize * size[1] as usize];
        let mut depths = ids.clone();
        let parts = [Part {
            flags: Part::DOUBLE_SIDED,
            ..Part::default()
        }];
        let fill = Fill {
            window: &window,
            triangles: &triangles,
            parts: &parts,
            sides: Sides::AsParts,
            id_bits: 0,
            clip_of: |vertex: u32| posed[vertex as usize].clip,
            keep: |_, _, _| true,
        };
        fill_triangles(&fill, &mut ids, &mut depths);
        Self {
            window,
            ids,
            posed,
            triangles,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::measures::measure;
    use crate::lines::reference::Reference;
    use crate::lines::subjects::LineSubject;
    use crate::lines::viewpoint::Viewpoint;
    use npr_render::LineModelOptions;
    use std::path::Path;

    /// What is seen by samples is what rays see: at most a hundredth of what must be drawn is lost, and of what is
    /// hidden shown.
    #[test]
    fn samples_see_what_rays_see() {
        let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets");
        let mut whole = [0.0; 2];
        for name in [
            "still_life.glb",
            "two_balls.glb",
            "teapot_box_plane.glb",
            "cube_plane.glb",
        ] {
            let subject = LineSubject::load(&assets.join(name), false).expect("a model");
            let model =
                LineModel::new(&subject.scene, &LineModelOptions::default()).expect("lines");
            for camera in &subject.cameras {
                let size = [960, 540];
                let view = Viewpoint::new(camera, size);
                let reference = Reference::new(&subject.soup, &view, &Wanted::default());
                let drawing = sampled_drawing(&model, camera, size, &Wanted::default());
                let found = measure(&drawing, &reference);
                let [lost, shown] = found.faults(&reference, 1);
                whole = [whole[0] + found.due_px, whole[1] + reference.hidden_px];
                assert!(
                    lost <= 0.01 && shown <= 0.01,
                    "{name}: {lost} lost, {shown} shown"
                );
            }
        }
        assert!(whole[0] > 1e4 && whole[1] > 1e3, "{whole:?} px of lines");
    }
}
