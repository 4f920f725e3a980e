//! A frame and a line drawing of another pose: by a model that takes it, and by one that is made of the posed scene.
//!
//! Draws the shared models beside the checkout, and nothing where there are none.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_render::{
    LineModel, LineModelOptions, LineOptions, LineRenderer, RendererOptions, Subject,
};
use npr_scene::{LoadOptions, Scene, load};
use npr_stylesheet::Style;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

const SIZE: [u32; 2] = [320, 180];

/// A model and the clip of it that is played.
const MODELS: [(&str, usize); 3] = [("robot_animated", 6), ("fox", 1), ("morph_stress_test", 2)];

/// Eight poses of a clip, in turn.
fn poses(rest: &Scene, clip: usize) -> Vec<Scene> {
    let clip = &rest.clips[clip];
    let pose = |k: u8| {
        let mut scene = rest.clone();
        let time = clip.duration_s() * f32::from(k) / 8.0;
        scene.set_pose(&rest.pose_at(clip, time)).expect("in range");
        scene
    };
    (0..8).map(pose).collect()
}

/// Draws the poses in turn, each iteration the next.
fn bench(
    c: &mut Criterion,
    (what, model): (&str, &str),
    poses: &[Scene],
    mut draw: impl FnMut(&Scene),
) {
    let mut group = c.benchmark_group(what);
    group
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(3));
    let mut next = poses.iter().cycle();
    group.bench_function(BenchmarkId::from_parameter(model), |b| {
        b.iter(|| draw(next.next().expect("a pose")))
    });
}

fn frames(c: &mut Criterion, name: &str, (rest, poses): (&Scene, &[Scene]), camera: &Camera) {
    let style = Style::default();
    let options = RendererOptions::new(SIZE);
    let subject = Subject::new(rest, &style).expect("a subject");
    let mut renderer = subject
        .renderer(&Processor, &style, &options)
        .expect("a renderer");
    bench(c, ("set_pose", name), poses, |scene| {
        renderer.set_pose(scene).expect("posed");
    });
    bench(c, ("frame, set_pose", name), poses, |scene| {
        renderer.set_pose(scene).expect("posed");
        black_box(renderer.draw(camera).expect("a frame"));
    });
    bench(c, ("frame, made anew", name), poses, |scene| {
        let subject = Subject::new(scene, &style).expect("a subject");
        let mut renderer = subject
            .renderer(&Processor, &style, &options)
            .expect("a renderer");
        black_box(renderer.draw(camera).expect("a frame"));
    });
}

fn lines(c: &mut Criterion, name: &str, (rest, poses): (&Scene, &[Scene]), camera: &Camera) {
    let style = Style::default();
    let options = LineOptions::of_style(&style, SIZE);
    let made = |scene: &Scene| LineModel::new(scene, &LineModelOptions::default()).expect("lines");
    let model = made(rest);
    let mut renderer = LineRenderer::new(&Processor, &model);
    bench(c, ("lines, set_pose", name), poses, |scene| {
        renderer.set_pose(scene).expect("posed");
        black_box(renderer.draw(camera, &style, &options).expect("lines"));
    });
    bench(c, ("lines, made anew", name), poses, |scene| {
        let drawing = made(scene).draw(camera, &style, &options);
        black_box(drawing.expect("lines"));
    });
}

fn poses_of_models(c: &mut Criterion) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets/models");
    for (name, clip) in MODELS {
        let Ok(rest) = load(&folder.join(format!("{name}.glb")), &LoadOptions::default()) else {
            eprintln!("skipped: {name} is not beside this checkout");
            continue;
        };
        let poses = poses(&rest, clip);
        let style = Style::default();
        let camera = Subject::new(&rest, &style)
            .expect("a subject")
            .model
            .framing(16.0 / 9.0, 0.7);
        frames(c, name, (&rest, &poses), &camera);
        lines(c, name, (&rest, &poses), &camera);
    }
}

criterion_group!(benches, poses_of_models);
criterion_main!(benches);
