//! Strokes of frames whose sights are sampled on the frame's own pixels, `line.visibility = "sampled"`.

use npr_core::camera::Camera;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{
    Frame, LineModel, LineModelOptions, LineRenderer, Model, Renderer, RendererOptions,
};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{Ink, asset, device, lines, models_camera};

const SIZE: [u32; 2] = [480, 320];

/// Lines alone, with settings.
fn style(visibility: &str, settings: &[&str]) -> Style {
    let mut style = lines("strokes");
    let visibility = format!("line.visibility='{visibility}'");
    for setting in settings.iter().copied().chain([&visibility[..]]) {
        style.set(setting).unwrap();
    }
    style
}

/// A frame, and how many passes find and ink its lines.
fn drawn_on(
    engine: &dyn Engine,
    (scene, camera): (&Scene, Option<&Camera>),
    style: &Style,
    options: &RendererOptions,
) -> (Frame, usize) {
    let model = Model::new(scene).unwrap();
    let lines = LineModel::for_style(scene, style, &LineModelOptions::default(), None).unwrap();
    let of_model = (&model, LineRenderer::new(&Processor, &lines));
    let mut renderer = Renderer::with_lines(engine, of_model, style, options).unwrap();
    let own = models_camera(&model, options.size);
    let frame = renderer.draw(camera.unwrap_or(&own)).unwrap();
    let costs = renderer.pass_costs().unwrap();
    let of_lines = costs.iter().filter(|cost| {
        let name = cost.name;
        name.starts_with("stroke.") || name.starts_with("vector.")
    });
    (frame, of_lines.count())
}

fn drawn(scene: &Scene, style: &Style) -> Frame {
    drawn_on(
        &Processor,
        (scene, None),
        style,
        &RendererOptions::new(SIZE),
    )
    .0
}

#[test]
fn samples_show_what_exact_sights_show() {
    for name in ["still_life.glb", "teapot_box_plane.glb", "two_balls.glb"] {
        let scene = asset(name);
        let [exact, sampled] =
            ["exact", "sampled"].map(|visibility| Ink::of(&drawn(&scene, &style(visibility, &[]))));
        let lost = exact.without(&sampled.grown(2)).count();
        let shown = sampled.without(&exact.grown(2)).count();
        let bound = exact.count() / 100;
        assert!(exact.count() > 1500, "{name}: {}", exact.count());
        assert!(
            lost <= bound && shown <= bound,
            "{name}: {lost} lost, {shown} shown of {}",
            exact.count()
        );
    }
}

/// What hides a line is found on the frame: where the surfaces turn their lines off they still hide those behind.
#[test]
fn strokes_are_hidden_by_what_the_frame_shows() {
    let scene = asset("two_balls.glb");
    let whole = drawn(&scene, &style("sampled", &[]));
    let all = Ink::of(&whole).count();
    let tapered = style(
        "sampled",
        &[
            "line.width.taper.start='60px'",
            "line.width.taper.ends='all'",
        ],
    );
    let thin = drawn(&scene, &tapered);
    assert!(
        whole.rgba != thin.rgba,
        "parts taper where they begin and end"
    );
    assert!(Ink::of(&thin).count() < all);
}

#[test]
fn both_engines_draw_the_same_in_few_passes() {
    let scene = asset("still_life.glb");
    let looks = [
        &[][..],
        &[
            "line.width.taper.end='40px'",
            "line.brush.tip='charcoal'",
            "line.width.base='6px'",
        ],
        &[
            "line.hand.wobble='3px'",
            "line.hand.copies=2",
            "line.width.pressure=[{at=0,factor=0.3},{at=1,factor=1}]",
        ],
    ];
    for settings in looks {
        let style = style("sampled", settings);
        let options = RendererOptions::new(SIZE);
        let (frame, passes) = drawn_on(&Processor, (&scene, None), &style, &options);
        assert!((5..=25).contains(&passes), "{passes} passes");
        let Some(device) = device() else {
            continue;
        };
        let (other, passes) = drawn_on(device, (&scene, None), &style, &options);
        assert!((5..=25).contains(&passes), "{passes} passes");
        let differs = |(a, b): &(&u8, &u8)| a.abs_diff(**b) > 2;
        let count = frame.rgba.iter().zip(&other.rgba).filter(differs).count();
        assert!(
            count * 500 < frame.rgba.len(),
            "{settings:?}: {count} bytes differ"
        );
    }
}

/// What needs exact sights has them, with a notice.
#[test]
fn what_needs_exact_sights_has_them() {
    let scene = asset("two_balls.glb");
    let needs = [
        (&["line.dash.pattern=['9px','5px']"][..], "dashes"),
        (&["line.hand.overshoot='8px'"], "overshoot"),
        (
            &["line.brush.tip='charcoal'", "line.brush.mapping='stamps'"],
            "stamps",
        ),
    ];
    for (settings, what) in needs {
        let [exact, sampled] =
            ["exact", "sampled"].map(|visibility| drawn(&scene, &style(visibility, settings)));
        assert!(exact.rgba == sampled.rgba, "{what}");
        let told = format!("line.visibility is exact in this frame, because of {what}");
        let is_told = |frame: &Frame| frame.notices.contains(&told);
        assert!(
            is_told(&sampled) && !is_told(&exact),
            "{:?}",
            sampled.notices
        );
    }
    let in_tiles = RendererOptions {
        tile_pixels: 128 * 128,
        ..RendererOptions::new(SIZE)
    };
    let (frame, _) = drawn_on(
        &Processor,
        (&scene, None),
        &style("sampled", &[]),
        &in_tiles,
    );
    let told = "line.visibility is exact in this frame, because of tiles";
    assert!(
        frame.notices.iter().any(|notice| notice == told),
        "{:?}",
        frame.notices
    );
}

/// A frame without triangles, and one whose lines lie outside, are drawn.
#[test]
fn nothing_to_see_is_no_trouble() {
    let style = style("sampled", &[]);
    let scene = asset("two_balls.glb");
    let model = Model::new(&scene).unwrap();
    let camera = models_camera(&model, SIZE);
    let away = Camera {
        target: [0, 1, 2].map(|i| 2.0 * camera.eye[i] - camera.target[i]),
        ..camera
    };
    let options = RendererOptions::new(SIZE);
    let (frame, _) = drawn_on(&Processor, (&scene, Some(&away)), &style, &options);
    assert_eq!(Ink::of(&frame).count(), 0);
    assert_eq!(Ink::of(&drawn(&Scene::default(), &style)).count(), 0);
}
