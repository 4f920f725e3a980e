//! Draws a file in a preset: `cargo run --example draw -- model.glb out.png [preset] [key=value ..]`.

use npr_gpu::processor::Processor;
use npr_render::{Model, Renderer, RendererOptions};
use npr_stylesheet::Style;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output, more @ ..] = arguments.as_slice() else {
        return Err("usage: draw MODEL OUT.png [PRESET] [KEY=VALUE ..]".into());
    };
    let mut style = Style::preset(more.first().map_or("toon", String::as_str))?;
    for assignment in more.iter().skip(1) {
        style.set(assignment)?;
    }

    let start = Instant::now();
    let scene = npr_scene::load(input.as_ref(), &npr_scene::LoadOptions::default())?;
    let loaded = start.elapsed();
    let model = Model::new(&scene)?;
    eprintln!(
        "{} parts, {} triangles",
        model.parts().len(),
        model.triangle_count()
    );
    eprintln!(
        "loaded in {loaded:?}, prepared in {:?}",
        start.elapsed() - loaded
    );

    let size = [1920, 1080];
    let camera = match model.cameras() {
        [(_, camera), ..] => *camera,
        [] => model.framing(16.0 / 9.0, 0.7),
    };
    let mut renderer = Renderer::new(&Processor, &model, &style, &RendererOptions::new(size))?;
    renderer.draw(&camera)?;
    let frame = renderer.draw(&camera)?;
    for pass in &frame.times {
        eprintln!("{:24} {:?}", pass.name, pass.time);
    }
    image::save_buffer(
        output,
        &frame.rgba,
        size[0],
        size[1],
        image::ColorType::Rgba8,
    )?;
    Ok(())
}
