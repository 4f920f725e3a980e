//! How the work is cut into passes.

use super::fixture::{front_camera, with};
use npr_gpu::pass::Work;
use npr_gpu::passes::{line, mesh, raster};
use npr_gpu::processor::Processor;
use npr_render::{Model, Renderer, RendererOptions};
use npr_scene::{Format, Limits, MemoryResources};
use npr_tests::{Ink, Wanted, asset, draw_from, lines, models_camera};

#[test]
fn one_pose_pass_feeds_both_draws() {
    let model = Model::new(&asset("cube_plane.glb")).unwrap();
    let size = [64, 36];
    let style = with(lines("okuya"), &["detect.scale=2"]);
    let mut renderer =
        Renderer::new(&Processor, &model, &style, &RendererOptions::new(size)).unwrap();
    let frame = renderer.draw(&models_camera(&model, size)).unwrap();
    let runs = |name| frame.times.iter().filter(|pass| pass.name == name).count();
    assert_eq!(runs(mesh::POSE_VERTICES.name), 1);
    assert_eq!(runs(raster::DRAW_IDS.name), 2, "colour and mask");
    assert_eq!(runs(line::DRAW_RIBBONS.name), 1);
    assert_eq!(
        mesh::POSE_VERTICES.work,
        Work::PerElement { of: "vertices" }
    );
    for draw in [raster::DRAW_IDS, line::DRAW_RIBBONS] {
        assert!(
            draw.slots.iter().any(|slot| slot.name == "posed"),
            "{}",
            draw.name
        );
    }
}

#[test]
fn detection_takes_one_thread_per_mask_pixel() {
    assert_eq!(line::DETECT.work, Work::PerElement { of: "mask" });
    assert_eq!(
        line::RESOLVE_GBUFFER.work,
        Work::PerElement { of: "gbuffer" }
    );
}

#[test]
fn skinned_shapes_are_outlined_as_posed() {
    let bytes = npr_scene::testing::skinned_glb();
    let resources = MemoryResources::default();
    let scene = npr_scene::load_bytes(
        "bent.glb",
        &bytes,
        Some(Format::Glb),
        &resources,
        &Limits::default(),
    )
    .unwrap();
    let (node, part) = scene.drawn_parts().next().unwrap();
    let posed = scene.positions_world(node, part);
    assert_ne!(posed, part.positions, "the skin moves the triangle");
    let camera = npr_core::camera::Camera {
        projection: npr_core::camera::Projection::Parallel { height: 5.0 },
        ..front_camera()
    };
    let drawing = draw_from(&scene, &lines("shape"), &camera, [200, 200]);
    let edges = [[0, 1], [1, 2], [2, 0]].map(|ends: [usize; 2]| ends.map(|i| posed[i]));
    let wanted = Wanted::seen(&drawing.view, &edges);
    let ink = Ink::of(&drawing.frame);
    assert_eq!(ink.share_of(&wanted, 1.0), 1.0);
    assert!(ink.farthest_from(&wanted) < 2.5);
}
