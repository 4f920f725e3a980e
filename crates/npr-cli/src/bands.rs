//! Large pictures, written band by band as they are drawn.

use crate::encoder;
use crate::fault::Fault;
use crate::output::Output;
use npr_core::camera::Camera;
use npr_render::{Frame, RenderError, Renderer};
use png::ColorType;
use std::io::{self, BufWriter, Write};

/// The result of one attempt to draw and write a picture.
enum Try {
    /// The picture is written. The frame holds its times and notices, but no pixels.
    Written(Frame),
    /// The picture was drawn without alpha, but has pixels that are not opaque.
    SeesThrough,
    /// The file could not be written.
    Failed(Fault),
}

/// Draws a picture of `size` pixels into its file, and holds at most one band of its pixels in memory.
///
/// Without `keep_alpha` the picture is first drawn without alpha, and drawn again with it where a pixel turns out not
/// to be opaque. The inner result is that of writing the file.
///
/// # Errors
///
/// [`RenderError`] where drawing fails. No file is left then, and another engine may try.
pub fn draw_into(
    output: &Output,
    renderer: &mut Renderer<'_>,
    camera: &Camera,
    size: [u32; 2],
    keep_alpha: bool,
) -> Result<Result<Frame, Fault>, RenderError> {
    let mut color = match keep_alpha {
        true => ColorType::Rgba,
        false => ColorType::Rgb,
    };
    loop {
        match try_with(output, renderer, camera, size, color)? {
            Try::Written(reported) => return Ok(Ok(reported)),
            Try::Failed(fault) => return Ok(Err(fault)),
            Try::SeesThrough => color = ColorType::Rgba,
        }
    }
}

fn try_with(
    output: &Output,
    renderer: &mut Renderer<'_>,
    camera: &Camera,
    size: [u32; 2],
    color: ColorType,
) -> Result<Try, RenderError> {
    let mut drawn = None;
    let mut sees_through = false;
    let written = whole(output, |sink| {
        encoder::encode(size, color, sink, |write| {
            let mut kept = Ok(());
            let bands = renderer.draw_bands(camera, &mut |band| {
                let is_opaque = || band.rgba.chunks_exact(4).all(|pixel| pixel[3] == 255);
                sees_through = color == ColorType::Rgb && !is_opaque();
                if !sees_through {
                    kept = write(&band.rgba);
                }
                !sees_through && kept.is_ok()
            });
            // Fail for a picture that is not whole, so that no file of it stays.
            let is_whole = bands.is_ok() && !sees_through;
            drawn = Some(bands);
            match is_whole {
                true => kept,
                false => Err(io::Error::other("the picture is not whole")),
            }
        })
    });
    Ok(match (drawn.transpose()?, written) {
        (Some(reported), Ok(())) => Try::Written(reported),
        (Some(_), Err(_)) if sees_through => Try::SeesThrough,
        (_, Err(fault)) => Try::Failed(fault),
        // A closed pipe ends the writing in good order.
        (None, Ok(())) => Try::Written(Frame::default()),
    })
}

/// Writes the bytes of `fill`, but nothing at all where `fill` fails. For standard output they are collected first,
/// because bytes that were sent cannot be taken back.
fn whole(
    output: &Output,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Fault> {
    if *output == Output::Standard {
        let mut bytes = Vec::new();
        fill(&mut bytes)?;
        return output.write(&bytes);
    }
    output.write_with(|sink| {
        let mut sink = BufWriter::new(sink);
        fill(&mut sink)?;
        sink.flush()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_gpu::processor::Processor;
    use npr_render::{Model, RendererOptions};
    use npr_scene::testing::Sheet;
    use npr_scene::{Limits, MemoryResources, load_bytes};
    use npr_stylesheet::Style;
    use std::cell::RefCell;

    const SIZE: [u32; 2] = [300, 260];

    fn model() -> Model {
        let resources = MemoryResources::default();
        let file = Sheet::new(4).glb();
        let scene = load_bytes("sheet", &file, None, &resources, &Limits::default());
        Model::new(&scene.expect("a sound file")).expect("a model")
    }

    fn style(background: &str) -> Style {
        let mut style = Style::default();
        style
            .set(&format!("background={background}"))
            .expect("a colour");
        style
    }

    #[test]
    fn a_picture_in_bands_has_the_bytes_of_a_whole_one() {
        let model = model();
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out.png");
        let output = Output::of(&path).expect("a place");
        let camera = Camera::framing([0.0; 3], [4.0, 0.1, 4.0]);
        let options = RendererOptions {
            tile_pixels: 20_000,
            in_bands: true,
            ..RendererOptions::new(SIZE)
        };
        // An opaque picture, a transparent one, and a transparent one that is first drawn without alpha.
        for (background, keep_alpha) in [
            ("white", false),
            ("transparent", true),
            ("transparent", false),
        ] {
            let reported = RefCell::new(Vec::new());
            let tell = |done, of| reported.borrow_mut().push([done, of]);
            let renderer = Renderer::new(&Processor, &model, &style(background), &options);
            let mut renderer = renderer.expect("a stage").with_progress(&tell);
            assert!(renderer.draws_bands());
            let written = draw_into(&output, &mut renderer, &camera, SIZE, keep_alpha);
            let frame = written.expect("drawn").expect("written");
            assert!(frame.rgba.is_empty() && !frame.times.is_empty());
            let tiles = reported.borrow().clone();
            let count = tiles[0][1];
            let once: Vec<[usize; 2]> = (1..=count).map(|done| [done, count]).collect();
            assert!(count > 4 && tiles.ends_with(&once), "{tiles:?}");

            let whole = renderer.draw(&camera).expect("drawn");
            let wanted = encoder::png(SIZE, &whole.rgba, keep_alpha).expect("encoded");
            let bytes = std::fs::read(&path).expect("a file");
            assert!(bytes == wanted, "{background}, {keep_alpha}");
        }
        let names = std::fs::read_dir(folder.path()).expect("a folder").count();
        assert_eq!(names, 1, "nothing stays beside the picture");
    }

    #[test]
    fn what_goes_over_the_whole_frame_needs_it_whole() {
        let model = model();
        let options = RendererOptions {
            tile_pixels: 20_000,
            ..RendererOptions::new(SIZE)
        };
        let cases: [(&[&str], bool); 3] = [
            (&["line.method=shape"], true),
            (&["line.method=strokes"], true),
            (&["blend.with=toon", "blend.amount=0.5"], false),
        ];
        for (keys, in_bands) in cases {
            let mut style = style("white");
            keys.iter().for_each(|key| style.set(key).expect("a key"));
            let renderer = Renderer::new(&Processor, &model, &style, &options).expect("a stage");
            assert_eq!(renderer.draws_bands(), in_bands, "{keys:?}");
        }
    }
}
