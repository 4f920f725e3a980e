//! Devices that a host program opened, and frames laid into its targets.

use crate::sample_passes::DOUBLE;
use crate::shared;
use npr_gpu::device::testing::Canvas;
use npr_gpu::device::{Device, Inlay, TargetFormat, wgpu};
use npr_gpu::engine::{Engine, EngineError, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Pass;
use npr_shaders::Shader;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A graph that doubles 100 numbers.
fn doubling() -> (Graph, [ResourceId; 2]) {
    let mut graph = Graph::new();
    let numbers = graph.buffer::<u32>("numbers", 100);
    let doubled = graph.buffer::<u32>("doubled", 100);
    graph.compute(&DOUBLE, &[numbers, doubled]);
    (graph, [numbers, doubled])
}

/// The least limits of WebGPU: the column "default" of the table of limits in its specification.
fn least() -> wgpu::Limits {
    wgpu::Limits::default()
}

#[test]
fn the_limits_that_are_asked_for_are_those_of_webgpu() {
    let least = least();
    let sizes = [
        (least.max_texture_dimension_1d, 8192),
        (least.max_texture_dimension_2d, 8192),
        (least.max_texture_dimension_3d, 2048),
        (least.max_texture_array_layers, 256),
        (least.max_bind_groups, 4),
        (least.max_bindings_per_bind_group, 1000),
        (least.max_dynamic_uniform_buffers_per_pipeline_layout, 8),
        (least.max_dynamic_storage_buffers_per_pipeline_layout, 4),
        (least.max_sampled_textures_per_shader_stage, 16),
        (least.max_samplers_per_shader_stage, 16),
        (least.max_storage_buffers_per_shader_stage, 8),
        (least.max_storage_textures_per_shader_stage, 4),
        (least.max_uniform_buffers_per_shader_stage, 12),
        (least.min_uniform_buffer_offset_alignment, 256),
        (least.min_storage_buffer_offset_alignment, 256),
        (least.max_vertex_buffers, 8),
        (least.max_vertex_attributes, 16),
        (least.max_vertex_buffer_array_stride, 2048),
        (least.max_color_attachments, 8),
        (least.max_color_attachment_bytes_per_sample, 32),
        (least.max_compute_workgroup_storage_size, 16384),
        (least.max_compute_invocations_per_workgroup, 256),
        (least.max_compute_workgroup_size_x, 256),
        (least.max_compute_workgroup_size_y, 256),
        (least.max_compute_workgroup_size_z, 64),
        (least.max_compute_workgroups_per_dimension, 65535),
    ];
    assert!(sizes.iter().all(|(has, least)| has == least), "{sizes:?}");
    assert_eq!(least.max_uniform_buffer_binding_size, 64 << 10);
    assert_eq!(least.max_storage_buffer_binding_size, 128 << 20);
    assert_eq!(least.max_buffer_size, 256 << 20);
}

#[test]
fn a_device_with_less_than_the_least_limits_is_refused_by_name() {
    let few = wgpu::Limits {
        max_sampled_textures_per_shader_stage: 15,
        ..least()
    };
    let Some((adapter, device, queue)) = shared::open_host(&few) else {
        return;
    };
    let refused = Device::from_wgpu(&adapter, device, queue).map(drop);
    let error = refused.expect_err("a texture is missing").to_string();
    let lacks = "lacks max_sampled_textures_per_shader_stage of 16, it has 15";
    assert!(error.contains(lacks), "{error}");
    assert!(error.starts_with("no graphics device: "), "{error}");
}

#[test]
fn the_least_limits_compile_every_pass() {
    let Some((adapter, device, queue)) = shared::open_host(&least()) else {
        return;
    };
    assert_eq!(device.limits(), least(), "not one more");
    let device = Device::from_wgpu(&adapter, device, queue).unwrap();
    let look = crate::scene::Look::Ours;
    crate::frame::Frame::run_on(&device, look, [30, 20], [30, 20]);
}

#[test]
fn a_session_records_into_the_encoder_of_a_host() {
    let Some((adapter, device, queue)) = shared::open_host(&least()) else {
        return;
    };
    let guest = Device::from_wgpu(&adapter, device.clone(), queue.clone()).unwrap();
    let (graph, [numbers, doubled]) = doubling();
    let mut session = guest.session(graph).unwrap();
    session.write(numbers, &[3, 4]).unwrap();

    // One submission holds it, the host's, with what it records twice.
    let mut encoder = device.create_command_encoder(&Default::default());
    session.record(&mut encoder).unwrap();
    session.record(&mut encoder).unwrap();
    assert_eq!(guest.traffic(), Default::default(), "nothing is submitted");
    queue.submit([encoder.finish()]);
    assert_eq!(session.read(doubled).unwrap()[..2], [6, 9]);
}

#[test]
fn the_handlers_of_a_host_stay_its_own() {
    let Some((adapter, device, queue)) = shared::open_host(&least()) else {
        return;
    };
    let [errors, losses] = [(); 2].map(|()| Arc::new(AtomicUsize::new(0)));
    let (on_error, on_loss) = (errors.clone(), losses.clone());
    device.on_uncaptured_error(Arc::new(move |_: wgpu::Error| {
        on_error.fetch_add(1, Ordering::SeqCst);
    }));
    device.set_device_lost_callback(move |_, _| {
        on_loss.fetch_add(1, Ordering::SeqCst);
    });
    let guest = Device::from_wgpu(&adapter, device.clone(), queue.clone()).unwrap();

    // An error of the guest is told to it alone.
    const BROKEN: Pass = Pass {
        name: "test.broken",
        shader: Shader {
            path: "test",
            text: "fn main() { nonsense",
        },
        ..DOUBLE
    };
    let (mut graph, [numbers, doubled]) = doubling();
    graph.compute(&BROKEN, &[numbers, doubled]);
    let refused = guest.session(graph).map(drop).unwrap_err();
    assert!(matches!(refused, EngineError::Failed { ref place, .. } if place == "test.broken"));
    assert_eq!(errors.load(Ordering::SeqCst), 0);

    // An error of the host is told to it alone.
    let too_large = wgpu::BufferDescriptor {
        label: None,
        size: 2 * least().max_buffer_size,
        usage: wgpu::BufferUsages::STORAGE,
        mapped_at_creation: false,
    };
    drop(device.create_buffer(&too_large));
    assert_eq!(errors.load(Ordering::SeqCst), 1);
    let (graph, [_, doubled]) = doubling();
    let mut session = guest.session(graph).unwrap();
    session.run().unwrap();

    // Both find out about a loss.
    device.destroy();
    let mut encoder = device.create_command_encoder(&Default::default());
    for lost in [
        session.record(&mut encoder),
        session.write(doubled, &[1]),
        session.run().map(drop),
        session.read(doubled).map(drop),
        guest.prepare(doubling().0).map(drop),
    ] {
        assert!(matches!(lost, Err(EngineError::Lost { .. })), "{lost:?}");
    }
    let _ = device.poll(wgpu::PollType::Poll);
    assert_eq!(losses.load(Ordering::SeqCst), 1);
    assert_eq!(errors.load(Ordering::SeqCst), 1);
    let again = Device::from_wgpu(&adapter, device, queue).map(drop);
    assert!(matches!(again, Err(EngineError::Lost { .. })), "{again:?}");
}

#[test]
fn a_target_that_cannot_be_drawn_into_is_refused() {
    let Some((adapter, device, queue)) = shared::open_host(&least()) else {
        return;
    };
    let guest = Device::from_wgpu(&adapter, device, queue).unwrap();
    let mut graph = Graph::new();
    let frame = graph.buffer::<u32>("frame", 4);
    let depths = graph.buffer::<f32>("depths", 4);
    let session = guest.session(graph).unwrap();
    let format = TargetFormat {
        color: wgpu::TextureFormat::Rgba8Uint,
        depth: None,
        samples: 1,
    };
    let refused = Inlay::new(&guest, &session, [frame, depths], format).map(drop);
    assert!(
        matches!(refused, Err(EngineError::Failed { ref place, .. }) if place == "host.lay_frame"),
        "{refused:?}"
    );
}

/// Four pixels in a row laid into a target of five by two, over `under`; what it holds then.
fn laid(format: wgpu::TextureFormat, texels: [u32; 4], under: wgpu::Color) -> Option<Vec<u8>> {
    let (adapter, device, queue) = shared::open_host(&least())?;
    let guest = Device::from_wgpu(&adapter, device.clone(), queue.clone()).unwrap();
    let mut graph = Graph::new();
    let frame = graph.constants("frame", &texels);
    let depths = graph.buffer::<f32>("depths", 4);
    let session = guest.session(graph).unwrap();
    let of_target = TargetFormat {
        color: format,
        depth: None,
        samples: 1,
    };
    let inlay = Inlay::new(&guest, &session, [frame, depths], of_target).unwrap();
    inlay.aim(&guest, [4, 1], [[0.0; 4]; 4], of_target).unwrap();

    // Clear the target, and lay the frame into it.
    let canvas = Canvas::new(&device, [5, 2], of_target);
    let mut encoder = device.create_command_encoder(&Default::default());
    drop(canvas.begin(&mut encoder, Some(under)));
    inlay.record(&mut encoder, canvas.target());
    Some(canvas.submit_and_read(&device, &queue, encoder).unwrap())
}

#[test]
fn a_target_of_bytes_gets_the_bytes_of_the_frame() {
    let texels = [0xff01_80fe, 0x0033_3333, 0x8000_00ff, 0xffff_ffff];
    let under = wgpu::Color {
        r: 0.0,
        g: 1.0,
        b: 0.0,
        a: 1.0,
    };
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let Some(held) = laid(format, texels, under) else {
        return;
    };
    let pixel = |i: usize| &held[4 * i..4 * i + 4];
    assert_eq!(pixel(0), [0xfe, 0x80, 0x01, 0xff]);
    assert_eq!(pixel(1), [0, 255, 0, 255], "nothing is drawn");
    assert_eq!(pixel(2), [128, 127, 0, 255], "half over half");
    assert_eq!(pixel(3), [255; 4]);
    for beyond in 4..10 {
        assert_eq!(pixel(beyond), [0, 255, 0, 255], "beyond the frame");
    }
}

#[test]
fn a_target_of_light_gets_the_same_bytes_and_is_blended_in_light() {
    let texels = [0xff01_80fe, 0xff37_c209, 0x8000_0000, 0xff00_0000];
    let format = wgpu::TextureFormat::Rgba8UnormSrgb;
    let Some(held) = laid(format, texels, wgpu::Color::WHITE) else {
        return;
    };
    let pixel = |i: usize| &held[4 * i..4 * i + 4];
    assert_eq!(pixel(0), [0xfe, 0x80, 0x01, 0xff]);
    assert_eq!(pixel(1), [0x09, 0xc2, 0x37, 0xff]);
    assert_eq!(pixel(2), [187, 187, 187, 255], "half of the light");
    assert_eq!(pixel(3), [0, 0, 0, 255]);
}
