//! Drawings inside the frames of a host program: whose pixels show, what is kept between frames, and what is refused.

use glam::camera::rh::{proj::directx, view::look_at_mat4};
use glam::{Mat4, Vec3};
use npr_core::camera::{Camera, Projection};
use npr_gpu::device::testing::{Canvas, open_host};
use npr_gpu::device::wgpu::{self, CompareFunction, TextureFormat};
use npr_gpu::device::{DepthTarget, Device, TargetFormat};
use npr_gpu::engine::EngineError;
use npr_render::{
    EmbeddedRenderer, HostView, Model, RenderError, Renderer, RendererOptions, Smoke, Sphere,
};
use npr_scene::{Mesh, Node, Part, Scene};
use npr_stylesheet::{Background, Style};

#[path = "../../examples/embed_wgpu.rs"]
#[allow(dead_code, reason = "the program itself is run by `cargo xtask ci`")]
mod embed_wgpu;

use embed_wgpu::draw_boxes;

const SIZE: [u32; 2] = [160, 120];
const PILLAR: [Vec3; 2] = [Vec3::new(0.2, -2.0, 1.2), Vec3::new(0.6, 2.0, 1.5)];
const WALL: [Vec3; 2] = [Vec3::new(-3.0, -0.3, -2.0), Vec3::new(0.0, 3.0, -1.8)];

/// What the targets of the tests are made of.
fn format(color: TextureFormat, samples: u32, compare: CompareFunction) -> TargetFormat {
    let format = TextureFormat::Depth32Float;
    let depth = Some(DepthTarget { format, compare });
    TargetFormat {
        color,
        depth,
        samples,
    }
}

/// Bytes, and depths that grow away from the eye.
fn plain() -> TargetFormat {
    format(TextureFormat::Rgba8Unorm, 1, CompareFunction::LessEqual)
}

/// A cube of side 2 about the origin, moved to `at`.
fn scene(at: [f32; 3]) -> Scene {
    let cube = npr_mesh::testing::cube();
    let [low, high] = [f32::min, f32::max].map(|pick| {
        let all = cube.positions().iter().flatten().copied();
        all.reduce(pick).unwrap_or_default()
    });
    let place = |v: f32| (v - low) / (high - low) * 2.0 - 1.0;
    let part = Part {
        positions: cube.positions().iter().map(|p| p.map(place)).collect(),
        triangles: cube.triangles().to_vec(),
        ..Part::default()
    };
    let mesh = Mesh {
        parts: vec![part],
        ..Mesh::default()
    };
    let node = Node {
        mesh: Some(0),
        world_from_node: Mat4::from_translation(at.into()).to_cols_array_2d(),
        ..Node::default()
    };
    Scene {
        meshes: vec![mesh],
        nodes: vec![node],
        ..Scene::default()
    }
}

fn model(at: [f32; 3]) -> Model {
    Model::new(&scene(at)).expect("a model")
}

fn style(name: &str) -> Style {
    Style {
        background: Background::Transparent,
        ..Style::preset(name).expect("a preset")
    }
}

fn camera() -> Camera {
    Camera {
        eye: [2.0, 2.5, 6.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.6 },
    }
}

fn matrix(camera: &Camera) -> Mat4 {
    let Projection::Perspective { fov_y } = camera.projection else {
        panic!("a perspective");
    };
    let projection = directx::perspective(fov_y, 4.0 / 3.0, 0.1, 100.0);
    let [eye, target, up] = [camera.eye, camera.target, camera.up].map(Vec3::from);
    projection * look_at_mat4(eye, target, up)
}

/// A program with a device of exactly the least limits of WebGPU, and a canvas.
struct Host {
    device: wgpu::Device,
    queue: wgpu::Queue,
    guest: Device,
    canvas: Canvas,
    format: TargetFormat,
    /// Turns the depths of `matrix` into those of the host.
    turned: Mat4,
}

impl Host {
    fn open(format: TargetFormat) -> Option<Self> {
        let (adapter, device, queue) = open_host(&wgpu::Limits::default())?;
        let guest = Device::from_wgpu(&adapter, device.clone(), queue.clone()).expect("a guest");
        Some(Self {
            canvas: Canvas::new(&device, SIZE, format),
            device,
            queue,
            guest,
            format,
            turned: Mat4::IDENTITY,
        })
    }

    fn drawing(&self, model: Model, style: &Style) -> Result<EmbeddedRenderer, RenderError> {
        let options = RendererOptions::new(SIZE);
        EmbeddedRenderer::new(&self.guest, model, style, &options, self.format)
    }

    /// Pixels of a frame with boxes of the host, and a drawing over them where there is one.
    fn frame(
        &self,
        boxes: &[[Vec3; 2]],
        drawing: Option<&mut EmbeddedRenderer>,
        camera: &Camera,
    ) -> Vec<[u8; 4]> {
        let clip_from_world = self.turned * matrix(camera);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        draw_boxes(
            &self.device,
            &mut encoder,
            &self.canvas,
            &clip_from_world,
            boxes,
        );
        if let Some(drawing) = drawing {
            let seen = HostView {
                camera: *camera,
                clip_from_world: clip_from_world.to_cols_array_2d(),
            };
            let target = self.canvas.target();
            drawing
                .record(&mut encoder, &seen, target)
                .expect("recorded");
        }
        let read = self
            .canvas
            .submit_and_read(&self.device, &self.queue, encoder);
        read.expect("read").as_chunks().0.to_vec()
    }

    /// The picture that a renderer makes on the same device.
    fn picture(&self, model: &Model, style: &Style, camera: &Camera) -> Vec<[u8; 4]> {
        let options = RendererOptions::new(SIZE);
        let renderer = Renderer::new(&self.guest, model, style, &options);
        let frame = renderer.and_then(|mut renderer| renderer.draw(camera));
        frame.expect("drawn").rgba.as_chunks().0.to_vec()
    }
}

/// How far along its ray the eye sees a box at a pixel; infinitely far where it does not.
fn seen_at(pixel: usize, [low, high]: [Vec3; 2]) -> f32 {
    let camera = camera();
    let [right, up, back] = camera.axes().map(Vec3::from);
    let [x, y] = [pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]].map(|v| v as f32 + 0.5);
    let half = npr_core::math::tan_f64(0.3) as f32;
    let across = (x / SIZE[0] as f32 * 2.0 - 1.0) * half * 4.0 / 3.0;
    let ray = right * across + up * (1.0 - y / SIZE[1] as f32 * 2.0) * half - back;
    let [a, b] = [low, high].map(|corner| (corner - Vec3::from(camera.eye)) / ray);
    let (enters, leaves) = (a.min(b).max_element(), a.max(b).min_element());
    match enters < leaves {
        true => enters,
        false => f32::INFINITY,
    }
}

/// Whether all pixels within two of one are alike in `what`.
fn is_clear_of_edges(pixel: usize, what: impl Fn(usize) -> bool) -> bool {
    let [x, y] = [pixel as i32 % SIZE[0] as i32, pixel as i32 / SIZE[0] as i32];
    let around = (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| [x + dx, y + dy]));
    let inside =
        around.filter(|[x, y]| *x >= 0 && *y >= 0 && *x < SIZE[0] as i32 && *y < SIZE[1] as i32);
    let mut alike = inside.map(|[x, y]| what((y * SIZE[0] as i32 + x) as usize));
    let first = alike.next();
    alike.all(|next| Some(next) == first)
}

/// Every pixel is that of the host or of the drawing, whichever a ray meets first.
fn check_pixels(host: &Host, name: &str) {
    let (model, style) = (model([0.0; 3]), style(name));
    let boxes = [PILLAR, WALL];
    let picture = host.picture(&model, &style, &camera());
    let bare = host.frame(&boxes, None, &camera());
    let mut drawing = host.drawing(model, &style).expect("a drawing");
    let both = host.frame(&boxes, Some(&mut drawing), &camera());
    let of_host = |i: usize| {
        boxes
            .map(|corners| seen_at(i, corners))
            .into_iter()
            .fold(f32::INFINITY, f32::min)
    };
    let cube = [Vec3::NEG_ONE, Vec3::ONE];
    let (mut hidden, mut hides, mut alone) = (0, 0, 0);
    for (i, pixel) in both.iter().enumerate() {
        // Nothing is drawn, and the host's picture stays.
        if picture[i][3] == 0 {
            assert_eq!(*pixel, bare[i], "{name}: nothing is drawn at pixel {i}");
            continue;
        }
        let is_before = |i: usize| of_host(i) < seen_at(i, cube);
        if picture[i][3] < 255 || !is_clear_of_edges(i, is_before) {
            continue;
        }
        let (expected, count) = match is_before(i) {
            true => (bare[i], &mut hidden),
            false if of_host(i).is_finite() => (picture[i], &mut hides),
            false => (picture[i], &mut alone),
        };
        *count += 1;
        assert_eq!(*pixel, expected, "{name}: pixel {i}");
    }
    let counts = [hidden, hides, alone];
    assert!(
        counts.iter().all(|count| *count > 100),
        "{name}: {counts:?}"
    );
}

#[test]
fn each_pixel_shows_what_is_in_front() {
    let Some(host) = Host::open(plain()) else {
        return;
    };
    for name in ["toon", "ink", "okuya", "hull", "filter"] {
        check_pixels(&host, name);
    }
}

#[test]
fn light_comes_out_as_the_same_bytes() {
    let of_light = format(TextureFormat::Rgba8UnormSrgb, 1, CompareFunction::LessEqual);
    let Some(host) = Host::open(of_light) else {
        return;
    };
    check_pixels(&host, "toon");
}

#[test]
fn samples_of_a_pixel_get_the_same() {
    let sampled = format(TextureFormat::Rgba8Unorm, 4, CompareFunction::LessEqual);
    let Some(host) = Host::open(sampled) else {
        return;
    };
    check_pixels(&host, "toon");
}

#[test]
fn depths_may_be_reversed() {
    let reversed = format(TextureFormat::Rgba8Unorm, 1, CompareFunction::GreaterEqual);
    let Some(mut host) = Host::open(reversed) else {
        return;
    };
    host.turned = turned();
    check_pixels(&host, "toon");
}

/// Depths 0..1 the other way round.
fn turned() -> Mat4 {
    Mat4::from_cols_array_2d(&[
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0, 1.0],
    ])
}

#[test]
fn the_least_limits_hold_shadows_smoke_textures_and_ink_together() {
    let Some(host) = Host::open(plain()) else {
        return;
    };
    let mut rich = style("crosshatch");
    rich.set("light.shadow=true").expect("a key");
    let options = RendererOptions {
        smoke: Some(Smoke {
            spheres: vec![
                Sphere::new([0.9; 3], 0.5),
                Sphere::new([-0.8, 1.2, 0.4], 0.4),
            ],
            space: None,
        }),
        ..RendererOptions::new(SIZE)
    };
    let [model, again] = [0, 1].map(|_| model([0.0; 3]));
    let mut renderer = Renderer::new(&host.guest, &model, &rich, &options).expect("a stage");
    let picture = renderer.draw(&camera()).expect("drawn").rgba;
    let drawing = EmbeddedRenderer::new(&host.guest, again, &rich, &options, host.format);
    let both = host.frame(&[WALL], Some(&mut drawing.expect("a drawing")), &camera());
    let pairs = both.iter().zip(picture.as_chunks().0);
    let shown = pairs.filter(|(pixel, of_picture)| of_picture[3] == 255 && *pixel == *of_picture);
    assert!(shown.count() > 1000);
}

#[test]
fn changes_between_frames_are_those_of_a_drawing_made_anew() {
    let Some(host) = Host::open(plain()) else {
        return;
    };
    let fresh = |at, name| {
        let mut drawing = host.drawing(model(at), &style(name)).expect("a drawing");
        host.frame(&[WALL], Some(&mut drawing), &camera())
    };
    let mut drawing = host
        .drawing(model([0.0; 3]), &style("toon"))
        .expect("a drawing");
    let first = host.frame(&[WALL], Some(&mut drawing), &camera());
    assert!(first == fresh([0.0; 3], "toon"));

    // Another camera and back, another pose and back, other styles and back.
    let near = Camera {
        eye: [1.0, 1.0, 5.0],
        ..camera()
    };
    assert!(host.frame(&[WALL], Some(&mut drawing), &near) != first);
    let (moved, back) = (scene([0.5, 0.25, 0.0]), scene([0.0; 3]));
    drawing.set_pose(&moved).expect("posed");
    let posed = host.frame(&[WALL], Some(&mut drawing), &camera());
    assert!(posed != first && posed == fresh([0.5, 0.25, 0.0], "toon"));
    drawing.set_pose(&back).expect("posed");
    for name in ["crosshatch", "hull", "toon"] {
        drawing.set_style(&style(name)).expect("styled");
        let styled = host.frame(&[WALL], Some(&mut drawing), &camera());
        assert!(styled == fresh([0.0; 3], name), "{name}");
    }
    drawing
        .set_model(model([-0.5, 0.0, 0.0]))
        .expect("modelled");
    let other = host.frame(&[WALL], Some(&mut drawing), &camera());
    assert!(other == fresh([-0.5, 0.0, 0.0], "toon"));

    // Nothing of it submitted or waited for anything by itself.
    assert_eq!(host.guest.traffic(), Default::default());
}

#[test]
fn another_size_is_drawn_in_the_upper_left_corner() {
    let Some(host) = Host::open(plain()) else {
        return;
    };
    let mut drawing = host
        .drawing(model([0.0; 3]), &style("toon"))
        .expect("a drawing");
    drawing.set_size([80, 60]).expect("sized");
    let bare = host.frame(&[WALL], None, &camera());
    let both = host.frame(&[WALL], Some(&mut drawing), &camera());
    let changed = (0..both.len()).filter(|i| both[*i] != bare[*i]);
    let changed: Vec<[usize; 2]> = changed.map(|i| [i % 160, i / 160]).collect();
    assert!(changed.len() > 500);
    assert!(changed.iter().all(|[x, y]| *x < 80 && *y < 60));
}

#[test]
fn what_needs_the_processor_is_refused_in_a_sentence() {
    let Some(host) = Host::open(plain()) else {
        return;
    };
    let mut traced = style("toon");
    traced.set("line.method=potrace").expect("a key");
    let refused = host.drawing(model([0.0; 3]), &traced).map(drop);
    let error = refused.expect_err("it cannot be recorded").to_string();
    assert!(error.starts_with("line.method 'potrace'"), "{error}");
    assert!(error.ends_with("cannot be drawn inside the frame of another program"));
    let options = RendererOptions::new([3000, 2000]);
    let large = EmbeddedRenderer::new(
        &host.guest,
        model([0.0; 3]),
        &style("toon"),
        &options,
        host.format,
    );
    let error = large.map(drop).expect_err("it takes tiles").to_string();
    assert!(error.starts_with("a frame of 3000x2000 pixels"), "{error}");
}

#[test]
fn views_and_poses_that_do_not_belong_are_refused() {
    let Some(host) = Host::open(plain()) else {
        return;
    };
    let mut drawing = host
        .drawing(model([0.0; 3]), &style("toon"))
        .expect("a drawing");
    let mut encoder = host.device.create_command_encoder(&Default::default());
    let aside = Mat4::from_translation(Vec3::X * 0.1) * matrix(&camera());
    let seen = HostView {
        camera: camera(),
        clip_from_world: aside.to_cols_array_2d(),
    };
    let refused = drawing.record(&mut encoder, &seen, host.canvas.target());
    assert!(
        matches!(refused, Err(RenderError::OtherView { px }) if px > 1.0),
        "{refused:?}"
    );
    let refused = drawing.set_pose(&Scene::default());
    assert_eq!(refused, Err(RenderError::OtherScene { have: 0, want: 1 }));
}

#[test]
fn a_loss_between_frames_is_told_and_nothing_is_recorded() {
    let Some(host) = Host::open(plain()) else {
        return;
    };
    let mut drawing = host
        .drawing(model([0.0; 3]), &style("toon"))
        .expect("a drawing");
    host.device.destroy();
    let mut encoder = host.device.create_command_encoder(&Default::default());
    let seen = HostView {
        camera: camera(),
        clip_from_world: matrix(&camera()).to_cols_array_2d(),
    };
    let lost = |error: RenderError| matches!(error, RenderError::Engine(EngineError::Lost { .. }));
    let recorded = drawing.record(&mut encoder, &seen, host.canvas.target());
    assert!(recorded.is_err_and(lost));
    assert!(drawing.set_style(&style("hull")).is_err_and(lost));
    assert!(
        host.drawing(model([0.0; 3]), &style("toon"))
            .is_err_and(lost)
    );
}
