//! Draws a file in the frame of a wgpu program: `cargo run --example embed_wgpu -- model.glb out.png`.
//!
//! The program has a floor and a pillar; the drawing stands on one, partly behind the other. A canvas stands for the
//! window of the program.

use glam::camera::rh::{proj::directx::perspective, view::look_at_mat4};
use glam::{Mat4, Vec3};
use npr_gpu::device::testing::Canvas;
use npr_gpu::device::wgpu::{self, TextureFormat, util::DeviceExt};
use npr_gpu::device::{DepthTarget, Device, TargetFormat};
use npr_render::{EmbeddedRenderer, HostView, Model, RendererOptions};
use npr_stylesheet::Style;

const DEPTH: DepthTarget = DepthTarget {
    format: TextureFormat::Depth32Float,
    compare: wgpu::CompareFunction::LessEqual,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = arguments.as_slice() else {
        return Err("usage: embed_wgpu MODEL OUT.png".into());
    };

    // The program opens its device and its window.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))?;
    let (color, depth) = (TextureFormat::Rgba8UnormSrgb, Some(DEPTH));
    let format = TargetFormat {
        color,
        depth,
        samples: 1,
    };
    let [width, height] = [960, 540];
    let canvas = Canvas::new(&device, [width, height], format);

    // The drawing is made once, on the same device.
    let model = Model::new(&npr_scene::load(input.as_ref(), &Default::default())?)?;
    let (low, high) = model.bounds();
    let (low, size) = (Vec3::from(low), Vec3::from(high) - Vec3::from(low));
    let camera = model.framing(16.0 / 9.0, 0.6);
    let guest = Device::from_wgpu(&adapter, device.clone(), queue.clone())?;
    let (style, options) = (
        Style::preset("toon")?,
        RendererOptions::new([width, height]),
    );
    let mut drawing = EmbeddedRenderer::new(&guest, model, &style, &options, format)?;

    // In every frame, the program draws its things by its matrix, then the drawing over them.
    let [eye, at, up] = [camera.eye, camera.target, camera.up].map(Vec3::from);
    let matrix = perspective(0.6, 16.0 / 9.0, 0.1, 1000.0) * look_at_mat4(eye, at, up);
    let from = |x, y, z| low + size * Vec3::new(x, y, z);
    let floor = [from(-1.0, -0.05, -1.0), from(2.0, 0.0, 2.0)];
    let pillar = [from(0.6, 0.0, 0.9), from(0.7, 1.0, 1.1)];
    let mut encoder = device.create_command_encoder(&Default::default());
    draw_boxes(&device, &mut encoder, &canvas, &matrix, &[floor, pillar]);
    let seen = HostView {
        camera,
        clip_from_world: matrix.to_cols_array_2d(),
    };
    drawing.record(&mut encoder, &seen, canvas.target())?;
    let rgba = canvas.submit_and_read(&device, &queue, encoder)?;
    image::save_buffer(output, &rgba, width, height, image::ColorType::Rgba8)?;
    Ok(())
}

const SHADER: &str = "
struct Corner { @builtin(position) clip: vec4f, @location(0) tone: f32 }
@vertex fn vertex(@location(0) clip: vec4f, @location(1) tone: f32) -> Corner { return Corner(clip, tone); }
@fragment fn fragment(corner: Corner) -> @location(0) vec4f { return vec4f(corner.tone * vec3f(0.9, 0.7, 0.5), 1.0); }";

/// Draws boxes, given by their lowest and highest corners: six faces of two triangles, each face in a tone of its own.
pub fn draw_boxes(
    device: &wgpu::Device,
    encoder: &mut wgpu::CommandEncoder,
    canvas: &Canvas,
    clip_from_world: &Mat4,
    boxes: &[[Vec3; 2]],
) {
    let corners = (0..36 * boxes.len()).map(|i| {
        let (face, turn, [low, high]) = (i / 6 % 6, i % 6, boxes[i / 36]);
        let mut at = Vec3::ZERO;
        at[face / 2] = (face % 2) as f32;
        at[(face / 2 + 1) % 3] = (0x32 >> turn & 1) as f32;
        at[(face / 2 + 2) % 3] = (0x2c >> turn & 1) as f32;
        let [x, y, z, w] = (clip_from_world * (low + (high - low) * at).extend(1.0)).to_array();
        [x, y, z, w, 0.4 + 0.1 * face as f32]
    });
    let corners: Vec<[f32; 5]> = corners.collect();
    let vertices = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&corners),
        usage: wgpu::BufferUsages::VERTEX,
    });
    let layout = wgpu::VertexBufferLayout {
        array_stride: 20,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32],
    };
    let pipeline = canvas.pipeline(device, SHADER, layout);
    let mut pass = canvas.begin(encoder, Some(wgpu::Color::WHITE));
    pass.set_pipeline(&pipeline);
    pass.set_vertex_buffer(0, vertices.slice(..));
    pass.draw(0..corners.len() as u32, 0..1);
}
