//! Parts whose lines are drawn as curves, in frames.

use npr_core::camera::Camera;
use npr_drawing::artwork::ArtworkOptions;
use npr_drawing::drawing::rasterise;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::testing::icosphere;
use npr_render::{
    Frame, LineModel, LineModelOptions, LineOptions, LineRenderer, Model, RenderError, Renderer,
    RendererOptions, Subject,
};
use npr_scene::Scene;
use npr_stylesheet::{Length, Style, TaperEnds, Unit};
use npr_tests::comic::{SIZE, front};
use npr_tests::{Ink, Object, device, lines, placed, scene_of};

fn scene() -> Scene {
    scene_of(&[
        Object::new("Left", placed(&icosphere(4), [0.6; 3], [-0.7, 0.0, 0.0])),
        Object::new("Right", placed(&icosphere(4), [0.6; 3], [0.4, 0.0, -1.0])),
    ])
}

/// The processor, and the device where there is one.
fn engines() -> impl Iterator<Item = &'static dyn Engine> {
    let processor: &dyn Engine = &Processor;
    let device = device().map(|device| device as &dyn Engine);
    [processor].into_iter().chain(device)
}

fn drawn(style: &Style, with_lines: bool) -> Frame {
    let scene = scene();
    let model = Model::new(&scene).unwrap();
    let lines = LineModel::for_style(&scene, style, &LineModelOptions::default(), None).unwrap();
    let options = RendererOptions::new(SIZE);
    let of_model = (&model, LineRenderer::new(&Processor, &lines));
    let mut renderer = match with_lines {
        true => Renderer::with_lines(&Processor, of_model, style, &options).unwrap(),
        false => Renderer::new(&Processor, &model, style, &options).unwrap(),
    };
    renderer.draw(&front()).unwrap()
}

/// Number of inked pixels where only the left ball is, and elsewhere.
fn sides(frame: &Frame) -> [usize; 2] {
    let ink = Ink::of(frame);
    let (left, right): (Vec<[f32; 2]>, Vec<[f32; 2]>) =
        ink.centers().partition(|center| center[0] < 135.0);
    [left.len(), right.len()]
}

#[test]
fn curves_ink_what_shapes_ink() {
    let [as_shape, as_curves] =
        ["shape", "strokes"].map(|method| Ink::of(&drawn(&lines(method), true)));
    assert!(as_curves.count() > 500);
    let strayed = as_curves.without(&as_shape.grown(2)).count();
    let missing = as_shape.without(&as_curves.grown(2)).count();
    assert!(
        strayed + missing < as_shape.count() / 50,
        "{strayed} {missing}"
    );
}

#[test]
fn a_rule_chooses_curves_for_a_part() {
    let mut style = lines("none");
    let rule = "[[rule]]\nmatch.object = 'Right'\nline.method = 'strokes'";
    style.rule = Style::from_toml(rule, &|_| Err(String::new()))
        .unwrap()
        .rule;
    let frame = drawn(&style, true);
    let [left, right] = sides(&frame);
    assert!(left == 0 && right > 200, "{left} {right}");
    // The right ball's outline begins at 141, behind the left ball that ends at 150.
    let ink = Ink::of(&frame);
    assert!(
        (138..149).all(|x| !ink.at(x, 120)),
        "hidden lines are not drawn"
    );
    style.rule[0].line.method = None;
    style.line.method = npr_stylesheet::OutlineMethod::Strokes;
    let [left, right] = sides(&drawn(&style, true));
    assert!(left > 200 && right > 200, "{left} {right}");
}

#[test]
fn without_a_line_model_shapes_are_drawn_in_their_place() {
    let [strokes, shape] = ["strokes", "shape"].map(|method| drawn(&lines(method), false));
    assert!(strokes.rgba == shape.rgba && Ink::of(&shape).count() > 500);
    let told = ["lines of method strokes are drawn by method shape, for want of a line model"];
    assert_eq!(strokes.notices, told);
    assert!(shape.notices.is_empty());
}

/// The right ball's outline ends at that of the left one, twice; no other line ends.
#[test]
fn lines_taper_at_free_ends_or_at_all() {
    let px = |value: f32| Length {
        value,
        unit: Unit::Px,
    };
    let tapered = |length: f32, ends: TaperEnds| {
        let mut style = lines("strokes");
        style.line.width.base = px(8.0);
        let taper = &mut style.line.width.taper;
        (taper.start, taper.end, taper.ends) = (px(length), px(length), ends);
        drawn(&style, true)
    };
    let plain = tapered(0.0, TaperEnds::All);
    assert!(tapered(30.0, TaperEnds::Free).rgba == plain.rgba);
    let all = tapered(30.0, TaperEnds::All);
    // Ink goes, and only where the outlines cross: right of the left ball's middle, above and below.
    let [before, after] = [&plain, &all].map(Ink::of_strokes);
    let lost: Vec<[f32; 2]> = before.without(&after.grown(1)).centers().collect();
    assert!(lost.len() > 8 && after.without(&before.grown(1)).count() == 0);
    let is_near_end = |[x, y]: &[f32; 2]| {
        let [dx, dy] = [x - 144.0, y - 120.0];
        dx.abs() < 36.0 && (10.0..70.0).contains(&dy.abs())
    };
    assert!(lost.iter().all(is_near_end), "{lost:?}");
}

/// A frame of strokes has as much ink as their lengths times their widths, down to hair lines, and has it where a file
/// of the same drawing has it.
#[test]
fn frames_show_what_files_hold() {
    let mut style = lines("strokes");
    let scene = scene();
    let subject = Subject::new(&scene, &style).unwrap();
    let lines = subject.lines.as_ref().unwrap();
    for width in ["0.5px", "1px", "3px", "8px"] {
        style.set(&format!("line.width.base={width}")).unwrap();
        let options = RendererOptions::new(LARGE);
        let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
        let frame = renderer.draw(&front()).unwrap();
        let of_style = LineOptions::of_style(&style, LARGE);
        let drawing = lines.draw(&front(), &style, &of_style).unwrap();
        let ink = |rgba: &[u8]| -> Vec<f64> {
            let pixels = rgba.chunks(4);
            pixels
                .map(|pixel| 1.0 - f64::from(pixel[1]) / 255.0)
                .collect()
        };
        let drawn = ink(&frame.rgba);
        let total: f64 = drawn.iter().sum();
        let strokes = drawing.strokes.iter().filter(|stroke| stroke.is_visible());
        let wanted: f64 = strokes
            .map(|stroke| stroke.length() * stroke.points[0].width)
            .sum();
        assert!(
            (total - wanted).abs() < 0.01 * wanted,
            "{width}: {total} for {wanted}"
        );

        // Files may run a quarter of a pixel beside their curves; hair lines of the rasteriser are too thin.
        if wanted > 5_000.0 {
            let artwork = ArtworkOptions {
                background: Some([255; 4]),
                ..ArtworkOptions::default()
            };
            let file = ink(&rasterise(&drawing, &artwork));
            let apart: f64 = drawn.iter().zip(&file).map(|(a, b)| (a - b).abs()).sum();
            assert!(0.5 * apart < 0.05 * wanted, "{width}: {apart} of {wanted}");
            assert!(
                (total - file.iter().sum::<f64>()).abs() < 0.01 * wanted,
                "{width}"
            );
        }
    }
}

/// A frame in which thousands of edges lie apart.
const LARGE: [u32; 2] = [1280, 960];

/// A style in which every edge is a line.
fn every_edge() -> Style {
    let mut style = lines("strokes");
    for setting in ["line.crease_from=faces", "line.crease_angle_deg=0.1"] {
        style.set(setting).unwrap();
    }
    style
}

#[test]
fn there_is_room_for_any_number_of_strokes() {
    let (scene, style) = (scene(), every_edge());
    let subject = Subject::new(&scene, &style).unwrap();
    let options = RendererOptions::new(LARGE);
    let away = Camera {
        target: [0.0, 0.0, 90.0],
        ..front()
    };
    for engine in engines() {
        let renderer = || subject.renderer(engine, &style, &options).unwrap();
        let fresh = renderer().draw(&front()).unwrap();
        assert!(
            Ink::of(&fresh).count() > 50_000,
            "{}",
            Ink::of(&fresh).count()
        );

        // Few strokes, then more than there was room for, then few again.
        let mut kept = renderer();
        let first = kept.draw(&away).unwrap();
        assert!(kept.draw(&front()).unwrap().rgba == fresh.rgba);
        assert!(kept.draw(&away).unwrap().rgba == first.rgba);
    }
}

/// Tiles and bands have the strokes of the whole frame, across their borders.
#[test]
fn tiles_and_bands_have_the_strokes_of_the_whole() {
    let (scene, style) = (scene(), lines("strokes"));
    let subject = Subject::new(&scene, &style).unwrap();
    for engine in engines() {
        let renderer = |tile_pixels: u32| {
            let options = RendererOptions {
                tile_pixels,
                ..RendererOptions::new(SIZE)
            };
            subject.renderer(engine, &style, &options).unwrap()
        };
        let whole = renderer(1 << 20).draw(&front()).unwrap();
        let mut tiled = renderer(9_000);
        assert!(tiled.draw(&front()).unwrap().rgba == whole.rgba);
        let (mut rows, mut count) = (Vec::new(), 0);
        let mut take = |band: &Frame| {
            rows.extend_from_slice(&band.rgba);
            count += 1;
            true
        };
        tiled.draw_bands(&front(), &mut take).unwrap();
        assert!(rows == whole.rgba && count > 2, "{count} bands");
    }
}

#[test]
fn strokes_beyond_the_memory_limit_are_refused() {
    let (scene, style) = (scene(), every_edge());
    let subject = Subject::new(&scene, &style).unwrap();
    let limited = |memory_limit: u64| {
        let options = RendererOptions {
            memory_limit,
            ..RendererOptions::new(LARGE)
        };
        subject.renderer(&Processor, &style, &options)
    };
    // Find the least limit that the frame fits into as long as it has few strokes.
    let (mut low, mut high) = (0, 1 << 30);
    while low + 1 < high {
        let middle = (low + high) / 2;
        match limited(middle) {
            Ok(_) => high = middle,
            Err(_) => low = middle,
        }
    }
    let mut renderer = limited(high).unwrap();
    let refused = renderer.draw(&front());
    assert!(
        matches!(refused, Err(RenderError::Memory(_))),
        "{:?}",
        refused.map(|_| ())
    );
}

/// A scene too large for strokes within the memory that they may take is drawn by `shape` as a whole, which is told.
#[test]
fn a_scene_too_large_for_strokes_is_drawn_by_shapes() {
    let (scene, style) = (scene(), lines("strokes"));
    let options = |memory_limit| LineModelOptions {
        memory_limit,
        ..LineModelOptions::default()
    };
    assert!(
        Subject::lines(&scene, &style, &options(1 << 30), None)
            .unwrap()
            .is_some()
    );
    let lines_of_scene = Subject::lines(&scene, &style, &options(1 << 10), None).unwrap();
    assert!(lines_of_scene.is_none());
    let subject = Subject {
        model: Model::new(&scene).unwrap(),
        lines: lines_of_scene,
    };
    let frame = |style: &Style| {
        let options = RendererOptions::new(SIZE);
        let mut renderer = subject.renderer(&Processor, style, &options).unwrap();
        renderer.draw(&front()).unwrap()
    };
    let (instead, shape) = (frame(&style), frame(&lines("shape")));
    assert!(instead.rgba == shape.rgba && Ink::of(&instead).count() > 500);
    let told = "lines of method strokes are drawn by method shape, for want of a line model";
    assert_eq!(instead.notices, [told]);
    assert!(shape.notices.is_empty());
}

/// Strokes from pixels are drawn over surfaces as curves are, and cover about as much.
#[test]
fn strokes_from_pixels_are_drawn_as_curves_are() {
    let [curves, potrace] = ["strokes", "potrace"].map(|method| drawn(&lines(method), true));
    let [of_curves, of_pixels] = [&curves, &potrace].map(|frame| Ink::of(frame).count());
    assert!(
        of_pixels > of_curves / 2 && of_pixels < 2 * of_curves,
        "{of_pixels} {of_curves}"
    );
    let mut style = lines("potrace");
    style.line.potrace.speck_area = 1e6;
    assert_eq!(
        Ink::of(&drawn(&style, true)).count(),
        0,
        "its constants are those of the style"
    );
    let reported = ["lines of method potrace are left out: no line model was given"];
    assert_eq!(drawn(&lines("potrace"), false).notices, reported);
}
