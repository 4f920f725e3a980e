//! Files of lines, as other programs draw them, held against frames of the same strokes.

use crate::brushes_in_frames::scene;
use npr_drawing::artwork::{ArtworkOptions, Paths};
use npr_drawing::svg::write_svg;
use npr_gpu::processor::Processor;
use npr_render::{LineOptions, RendererOptions, Subject};
use npr_stylesheet::Style;
use npr_tests::comic::front;
use resvg::{tiny_skia, usvg};

const SIZE: [u32; 2] = [640, 480];

/// How many times as large files are drawn before they are averaged down: the rasteriser beside ours places edges in
/// steps of a quarter of its pixels, which alone is 2 % of the ink of a line of 3 pixels.
const FINER: u32 = 6;

/// Lines 3 pixels wide on white, with settings over it.
fn lines(settings: &[&str]) -> Style {
    let mut style = npr_tests::lines("strokes");
    let white = ["background=#ffffff", "shade.paper=#ffffff"];
    for setting in white.iter().chain(settings) {
        style.set(setting).unwrap();
    }
    style
}

/// How dark every pixel is, 0..1, by the mean of its channels.
fn darkness(rgba: &[u8]) -> Vec<f64> {
    let sum = |pixel: &[u8]| -> f64 { pixel[..3].iter().map(|value| f64::from(*value)).sum() };
    let pixels = rgba.chunks(4);
    pixels.map(|pixel| 1.0 - sum(pixel) / 765.0).collect()
}

/// A frame of a style, and the SVG file of the same strokes as resvg draws it.
fn drawn(style: &Style, paths: Paths) -> [Vec<f64>; 2] {
    // Draw the frame, and its strokes.
    let scene = scene();
    let subject = Subject::new(&scene, style).unwrap();
    let options = RendererOptions::new(SIZE);
    let mut renderer = subject.renderer(&Processor, style, &options).unwrap();
    let frame = renderer.draw(&front()).unwrap();
    let model = subject.lines.as_ref().unwrap();
    let of_style = LineOptions::of_style(style, SIZE);
    let drawing = model.draw(&front(), style, &of_style).unwrap();

    // Write them, and let the other program draw the file.
    let artwork = ArtworkOptions {
        paths,
        background: Some([255; 4]),
        brushes: model.brushes(style, &of_style).unwrap(),
        ..ArtworkOptions::default()
    };
    let svg = String::from_utf8(write_svg(&drawing, &artwork)).unwrap();
    let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).unwrap();
    let finer = SIZE.map(|side| side * FINER);
    let mut pixels = tiny_skia::Pixmap::new(finer[0], finer[1]).unwrap();
    let larger = tiny_skia::Transform::from_scale(FINER as f32, FINER as f32);
    resvg::render(&tree, larger, &mut pixels.as_mut());

    // Average it down.
    let fine = darkness(pixels.data());
    let mut file = vec![0.0; (SIZE[0] * SIZE[1]) as usize];
    for (slot, dark) in fine.iter().enumerate() {
        let [x, y] = [slot % finer[0] as usize, slot / finer[0] as usize];
        let [x, y] = [x, y].map(|at| at / FINER as usize);
        file[y * SIZE[0] as usize + x] += dark / f64::from(FINER * FINER);
    }
    [darkness(&frame.rgba), file]
}

/// Width, colour, tapers, dashes and copies are those of frames, pixel by pixel. What is left are places where strokes
/// touch: frames show the one that covers more of a pixel, files both.
#[test]
fn files_differ_from_frames_in_at_most_a_hundredth_of_the_ink() {
    let looks: [(&str, &[&str]); 6] = [
        ("even", &[]),
        (
            "swelling",
            &[
                "line.width.source=projected-curvature",
                "line.width.min=0.4",
                "line.width.max=1.6",
            ],
        ),
        (
            "tapered",
            &[
                "line.split_angle_deg=60",
                "line.width.taper.ends=all",
                "line.width.taper.start=20px",
                "line.width.taper.end=60px",
            ],
        ),
        (
            "coloured",
            &[
                "line.paint.light.ramp=[{ at = 0.0, color = '#102080' }, { at = 1.0, color = '#f03010' }]",
            ],
        ),
        ("dashed", &["line.dash.pattern=['24px', '9px']"]),
        (
            "copied",
            &[
                "line.hand.copies=2",
                "line.hand.wobble=2px",
                "line.hand.spread=14px",
            ],
        ),
    ];
    for (name, settings) in looks {
        let style = lines(settings);
        let [frame, file] = drawn(&style, Paths::Outline);
        let total: f64 = frame.iter().sum();
        let apart: f64 = frame.iter().zip(&file).map(|(a, b)| (a - b).abs()).sum();
        assert!(total > 1000.0, "{name}: {total}");
        assert!(apart <= 0.01 * total, "{name}: {}", apart / total);
    }
}

/// Stamps are where frames have them, of as much ink. Chance puts gaps elsewhere, strokes that cross add up, and the
/// paper's grain is its mean: a twentieth of the ink.
#[test]
fn stamped_files_have_the_ink_of_frames() {
    let looks = [
        ("charcoal", "length"),
        ("charcoal", "stamps"),
        ("dry-brush", "once"),
        ("airbrush", "stamps"),
        ("pencil", "length"),
    ];
    for (tip, mapping) in looks {
        let style = lines(&[
            "line.width.base=9px",
            "line.width.taper.end=60px",
            "line.color=#204060",
            &format!("line.brush.tip={tip}"),
            &format!("line.brush.mapping={mapping}"),
        ]);
        let [frame, file] = drawn(&style, Paths::Stamps);
        let [frame_ink, file_ink] = [&frame, &file].map(|ink| ink.iter().sum::<f64>());
        let [_, pen] = drawn(&style, Paths::Outline);
        assert!(
            (file_ink / frame_ink - 1.0).abs() < 0.05,
            "{tip} {mapping}: {file_ink} {frame_ink}"
        );
        let strayed = pen.iter().zip(&file);
        let strayed = strayed.filter(|(pen, brush)| **pen == 0.0 && **brush > 0.3);
        assert_eq!(
            strayed.count(),
            0,
            "{tip} {mapping}: ink where a pen has none"
        );
    }
}
