//! Looks blended with another one, on the processor.

use npr_gpu::engine::{Engine, EngineError, Session};
use npr_gpu::graph::Graph;
use npr_gpu::processor::Processor;
use npr_mesh::testing::icosphere;
use npr_render::{Frame, Model, Picture, RenderError, Renderer, RendererOptions};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::comic::{SIZE, front, pixel};
use npr_tests::{Object, draw_with, scene_of};

fn ball() -> Scene {
    scene_of(&[Object::new("Ball", icosphere(4)).colored([0.8, 0.3, 0.1])])
}

fn drawn(settings: &[&str], options: &RendererOptions) -> Frame {
    let mut style = Style::preset("comic-silver").unwrap();
    for setting in settings {
        style.set(setting).unwrap();
    }
    let model = Model::new(&ball()).unwrap();
    draw_with(&Processor, &model, &style, &front(), options)
}

fn mask(size: [u32; 2], bytes: &[u8]) -> RendererOptions {
    let rgba = bytes.iter().flat_map(|byte| [*byte; 4]).collect();
    RendererOptions {
        pictures: [("m.png".to_owned(), Picture { size, rgba })].into(),
        ..RendererOptions::new(SIZE)
    }
}

#[test]
fn a_blend_runs_from_one_look_to_the_other() {
    let plain_options = RendererOptions::new(SIZE);
    let comic = drawn(&[], &plain_options);
    let plain = drawn(&["blend.amount=0"], &plain_options);
    let half = drawn(&["blend.amount=0.5"], &plain_options);
    assert_ne!(comic.rgba, plain.rgba);
    for (i, mixed) in half.rgba.iter().enumerate() {
        let (low, high) = (
            comic.rgba[i].min(plain.rgba[i]),
            comic.rgba[i].max(plain.rgba[i]),
        );
        assert!(
            (low..=high).contains(mixed),
            "byte {i}: {mixed} of {low}..{high}"
        );
    }
    // Half of black over white is 188 in sRGB: light is mixed, not bytes.
    let lines = [
        "blend.amount=0.5",
        "shade.mode=paper",
        "blend.with=technical",
    ];
    let black = [
        &lines[..],
        &["ink.tone=ink", "ink.dark_at=1", "ink.light_at=1"],
    ]
    .concat();
    let [r, g, b] = pixel(&drawn(&black, &plain_options), 160, 120);
    assert!(r > 150 && r.abs_diff(g) < 20 && b > 120, "{r} {g} {b}");
}

#[test]
fn nothing_left_of_a_look_is_the_other_look_alone() {
    let mut style = Style::preset("comic-silver").unwrap();
    style.set("blend.amount=0").unwrap();
    let model = Model::new(&ball()).unwrap();
    let options = RendererOptions::new(SIZE);
    let blended = draw_with(&Processor, &model, &style, &front(), &options);
    let other = style.blended_with().unwrap();
    let alone = draw_with(&Processor, &model, &other, &front(), &options);
    assert_eq!(blended.rgba, alone.rgba);
}

#[test]
fn a_mask_says_where() {
    let options = mask([2, 1], &[255, 0]);
    let masked = drawn(&["blend.mask=m.png"], &options);
    let comic = drawn(&[], &options);
    let plain = drawn(&["blend.amount=0"], &options);
    for y in (0..SIZE[1]).step_by(7) {
        assert_eq!(pixel(&masked, 30, y), pixel(&comic, 30, y));
        assert_eq!(pixel(&masked, 290, y), pixel(&plain, 290, y));
    }
    assert_ne!(pixel(&comic, 80, 120), pixel(&plain, 80, 120));
}

#[test]
fn masks_that_are_missing_or_empty_are_named() {
    let mut style = Style::preset("toon").unwrap();
    style.set("blend.mask=m.png").unwrap();
    let model = Model::new(&ball()).unwrap();
    let reported = |options: &RendererOptions| {
        let refused = Renderer::new(&Processor, &model, &style, options);
        refused.err().unwrap().to_string()
    };
    let missing = "blend.mask: the picture 'm.png' was not given";
    assert_eq!(reported(&RendererOptions::new(SIZE)), missing);
    let empty = "blend.mask: the picture has no pixels, or not as many as its size says";
    assert_eq!(reported(&mask([0, 0], &[])), empty);
    assert_eq!(reported(&mask([2, 2], &[0])), empty);
}

#[test]
fn both_looks_share_one_limit_of_memory() {
    let mut style = Style::preset("toon").unwrap();
    let model = Model::new(&ball()).unwrap();
    let fits = |style: &Style, memory_limit: u64| {
        let options = RendererOptions {
            memory_limit,
            ..RendererOptions::new(SIZE)
        };
        Renderer::new(&Processor, &model, style, &options).is_ok()
    };
    let least = (0..40)
        .map(|bits| 1u64 << bits)
        .find(|limit| fits(&style, *limit));
    style.set("blend.amount=0.5").unwrap();
    style.set("blend.with=toon").unwrap();
    let least_of_both = (0..40)
        .map(|bits| 1u64 << bits)
        .find(|limit| fits(&style, *limit));
    assert!(least_of_both > least, "{least:?} {least_of_both:?}");
}

/// An engine that nobody may ask for anything.
struct Untouched;

impl Engine for Untouched {
    fn describe(&self) -> String {
        unreachable!("nobody asks")
    }

    fn prepare(&self, _: Graph) -> Result<Box<dyn Session>, EngineError> {
        unreachable!("a frame that does not fit is refused before the engine is asked")
    }
}

#[test]
fn a_second_look_that_does_not_fit_is_refused_before_the_engine_is_asked() {
    let mut style = Style::preset("toon").unwrap();
    style.set("blend.amount=0.5").unwrap();
    style.set("blend.with=toon").unwrap();
    let model = Model::new(&ball()).unwrap();
    let limited = |memory_limit| RendererOptions {
        memory_limit,
        ..RendererOptions::new(SIZE)
    };
    // Find the least memory with which both looks fit: what lacks one byte of it has room for the first.
    let fits = |limit| Renderer::new(&Processor, &model, &style, &limited(limit)).is_ok();
    let (mut too_little, mut enough) = (0, 1u64 << 40);
    while enough - too_little > 1 {
        let middle = too_little.midpoint(enough);
        match fits(middle) {
            true => enough = middle,
            false => too_little = middle,
        }
    }
    let refused = Renderer::new(&Untouched, &model, &style, &limited(too_little));
    assert!(matches!(refused.err(), Some(RenderError::Memory(_))));
}

#[test]
fn a_missing_mask_is_named_before_the_engine_is_asked() {
    let mut style = Style::preset("toon").unwrap();
    style.set("blend.mask=m.png").unwrap();
    let model = Model::new(&ball()).unwrap();
    let refused = Renderer::new(&Untouched, &model, &style, &RendererOptions::new(SIZE));
    let missing = "blend.mask: the picture 'm.png' was not given";
    assert_eq!(refused.err().unwrap().to_string(), missing);
}
