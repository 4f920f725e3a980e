//! Hulls of cut-out parts, glass, and words that the scene hides, on both engines.

use npr_drawing::lettering::testing::block_font;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::testing::Random;
use npr_render::{Font, Frame, Model, RendererOptions};
use npr_scene::{AlphaMode, Image, Scene, TextureTransform, TextureUse, Wrap};
use npr_stylesheet::{Lettering, Style};
use npr_tests::comic::{SIZE, front, pixel, wall};
use npr_tests::{Object, boxed, device, draw_with, placed, scene_of};

/// Draws a scene on the processor and on a device, where there is one.
fn on_engines(scene: &Scene, style: &Style, options: &RendererOptions) -> Vec<Frame> {
    let model = Model::new(scene).unwrap();
    let engines = [
        Some(&Processor as &dyn Engine),
        device().map(|device| device as &dyn Engine),
    ];
    let engines = engines.into_iter().flatten();
    engines
        .map(|engine| draw_with(engine, &model, style, &front(), options))
        .collect()
}

/// A flat box, opaque on its left and clear on its right: a lens in half a frame.
fn half_clear() -> Scene {
    let mut lens = Object::new("Lens", boxed([-0.8, -0.8, -0.1], [0.8, 0.8, 0.1]));
    let alpha = |p: &[f32; 3]| if p[0] < 0.0 { 1.0 } else { 0.0 };
    let alphas: Vec<f32> = lens.mesh.positions().iter().map(alpha).collect();
    lens.colors = Some(alphas.iter().map(|a| [1.0, 1.0, 1.0, *a]).collect());
    lens.material.alpha = AlphaMode::Mask(0.5);
    // Hulls of what lies farthest are cut by the far plane of a parallel view: something lies behind the opaque half.
    let behind = boxed([-0.5, -0.1, -1.0], [-0.4, 0.1, -0.9]);
    scene_of(&[lens, Object::new("Behind", behind)])
}

#[test]
fn a_hull_is_cut_out_as_its_part_is() {
    let mut style = npr_tests::lines("hull");
    style.set("background=#0000ff").unwrap();
    style.set("line.width.base=6px").unwrap();
    let options = RendererOptions::new(SIZE);
    for frame in on_engines(&half_clear(), &style, &options) {
        let of = |x: std::ops::Range<u32>, color: [u8; 3]| {
            let places = x.flat_map(|x| (60..180).map(move |y| (x, y)));
            places
                .filter(|(x, y)| pixel(&frame, *x, *y) == color)
                .count()
        };
        // The box reaches 77 pixels to either side of the middle, and its alpha falls to a half there.
        assert_eq!(
            of(185..230, [0, 0, 255]),
            45 * 120,
            "through the clear half"
        );
        assert_eq!(of(90..140, [255; 3]), 50 * 120, "the opaque half");
        // Corners of a box are pushed along its diagonals: 6 pixels become three and a half.
        let outline = of(70..84, [0; 3]);
        assert!(
            outline >= 2 * 120,
            "the outline of the opaque half: {outline}"
        );
    }
}

/// A grainy pane before a box: its alpha lies around `alpha` everywhere.
fn behind_glass(alpha: u8, with_pane: bool) -> Scene {
    let mut pane = Object::new("Pane", wall(0.9, 0.5));
    pane.material.alpha = AlphaMode::Blend;
    pane.material.base_color_texture = Some(TextureUse {
        image: 0,
        uv_set: 0,
        wrap: [Wrap::Clamp; 2],
        transform: TextureTransform::default(),
    });
    let behind = Object::new("Box", boxed([-0.6, -0.4, -1.0], [0.5, 0.6, -0.5]));
    // Posts make the scene as large without the pane.
    let posts = [-1.1, 1.0].map(|x| boxed([x, -1.0, -1.0], [x + 0.1, 1.0, 0.6]));
    let posts = posts.map(|mesh| Object::new("Post", mesh));
    let objects = posts.into_iter().chain([behind]);
    let objects: Vec<Object> = objects.chain(with_pane.then_some(pane)).collect();
    let mut scene = scene_of(&objects);
    let mut random = Random::new(11);
    let texel = |_: usize| [90, 140, 60, alpha - 60 + random.below(120) as u8];
    scene.images.push(Image {
        name: String::new(),
        width: 64,
        height: 64,
        rgba: (0..64 * 64).flat_map(texel).collect(),
    });
    if let Some(mesh) = scene.meshes.get_mut(3) {
        let part = &mut mesh.parts[0];
        let uv = |p: &[f32; 3]| [p[0], p[1]].map(|x| x / 1.8 + 0.5);
        part.uvs = Some(part.positions.iter().map(uv).collect());
    }
    scene
}

#[test]
fn glass_is_drawn_as_a_whole_or_not_at_all() {
    let style = Style::preset("toon").unwrap();
    let options = RendererOptions::new(SIZE);
    let bare = on_engines(&behind_glass(100, false), &style, &options);
    let thin = on_engines(&behind_glass(100, true), &style, &options);
    for (bare, thin) in bare.iter().zip(&thin) {
        assert!(
            bare.rgba == thin.rgba,
            "a pane that covers little is not drawn"
        );
    }
    let mut solid = behind_glass(170, true);
    let thick = on_engines(&solid, &style, &options);
    solid.materials[3].alpha = AlphaMode::Opaque;
    let solid = on_engines(&solid, &style, &options);
    for ((thick, solid), bare) in thick.iter().zip(&solid).zip(&bare) {
        assert!(thick.rgba == solid.rgba, "one that covers much is solid");
        assert!(thick.rgba != bare.rgba, "and it is seen");
    }
}

#[test]
fn words_stand_behind_what_hides_them() {
    let board = placed(&wall(1.0, 0.0), [0.5, 1.0, 1.0], [0.5, 0.0, 1.0]);
    let scene = scene_of(&[Object::new("Board", board)]);
    let words = |hidden| Lettering {
        at: [0.5, 0.5],
        anchor: Some([0.0; 3]),
        hidden,
        ..Lettering::new("HHH", "a.ttf")
    };
    let options = RendererOptions {
        fonts: [("a.ttf".to_owned(), Font::new(block_font()).unwrap())].into(),
        ..RendererOptions::new(SIZE)
    };
    let drawn = |hidden| {
        let mut style = npr_tests::comic::style(&[]);
        style.lettering = vec![words(hidden)];
        on_engines(&scene, &style, &options)
    };
    // Yellow letters left of the middle, and right of it, where the board stands.
    let letters = |frame: &Frame| {
        let places = (0..SIZE[0]).flat_map(|x| (0..SIZE[1]).map(move |y| (x, y)));
        let yellow = places.filter(|(x, y)| pixel(frame, *x, *y) == [0xff, 0xd4, 0x1f]);
        yellow.fold([0, 0], |[left, right], (x, _)| match x < SIZE[0] / 2 {
            true => [left + 1, right],
            false => [left, right + 1],
        })
    };
    for (over, behind) in drawn(false).iter().zip(drawn(true)) {
        let ([left, right], hidden) = (letters(over), letters(&behind));
        assert!(left > 200 && right > 200, "{left} {right}");
        assert_eq!(hidden, [left, 0]);
    }
}
