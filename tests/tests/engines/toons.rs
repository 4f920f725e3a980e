//! Toon materials with everything that they may have, on both engines.

use npr_core::camera::{Camera, Projection};
use npr_gpu::processor::Processor;
use npr_mesh::testing::torus;
use npr_render::{Model, RendererOptions};
use npr_scene::{OutlineWidth, Scene, TextureTransform, Toon, ToonOutline};
use npr_stylesheet::Style;
use npr_tests::{
    Agreement, Object, device, draw_with, models, placed, scene_of, stripes, toon_ball,
};
use std::path::PathBuf;

/// A ball whose material has every picture, and a ring round it with a world-wide outline.
fn scene() -> Scene {
    let turned = |rotation: f32| {
        stripes(TextureTransform {
            rotation,
            offset: [0.1, 0.2],
            scale: [1.5, 0.7],
        })
    };
    let mut scene = toon_ball(Toon {
        shade_color: [0.5, 0.4, 0.8],
        shade_texture: Some(turned(0.4)),
        shading_shift: -0.1,
        shading_shift_texture: Some(turned(0.9)),
        shading_shift_scale: 0.4,
        shading_toony: 0.7,
        gi_equalization: 0.3,
        matcap_color: [0.2, 0.3, 0.1],
        matcap_texture: Some(turned(1.3)),
        rim_color: [0.2, 0.4, 0.3],
        rim_texture: Some(turned(2.0)),
        rim_power: 2.0,
        rim_lift: 0.1,
        rim_lighting_mix: 0.5,
        emissive: [0.1, 0.05, 0.0],
        emissive_texture: Some(turned(2.6)),
        outline: ToonOutline {
            width: Some(OutlineWidth::Screen(0.02)),
            texture: Some(turned(3.0)),
            color: [0.6, 0.2, 0.3],
            lighting_mix: 0.7,
        },
        ..Toon::default()
    });
    scene.materials[0].base_color_texture = Some(turned(0.2));
    let mut ring = Object::new(
        "Ring",
        placed(&torus(40, 16, 1.4, 0.15), [1.0; 3], [0.0; 3]),
    );
    ring.material.toon = Some(Box::new(Toon {
        shade_color: [0.3, 0.1, 0.2],
        outline: ToonOutline {
            width: Some(OutlineWidth::World(0.03)),
            ..ToonOutline::default()
        },
        ..Toon::default()
    }));
    let mut rings = scene_of(&[ring]);
    rings.nodes[0].mesh = Some(1);
    rings.meshes[0].parts[0].material = Some(1);
    scene.nodes.append(&mut rings.nodes);
    scene.meshes.append(&mut rings.meshes);
    scene.materials.append(&mut rings.materials);
    scene
}

fn camera() -> Camera {
    Camera {
        eye: [2.0, 1.5, 5.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.6 },
    }
}

#[test]
fn both_engines_draw_toons_alike() {
    let Some(device) = device() else { return };
    let model = Model::new(&scene()).unwrap();
    let skies = "light.extra=[{ kind = 'sky', intensity = 0.3, color = '#a0c0ff' }, { kind = 'spot', position = \
                 [1.0, 3.0, 4.0], direction = [0.2, 0.5, 0.8], intensity = 0.5 }]";
    for settings in [
        &[][..],
        &[skies, "light.shadow=true"],
        &["antialias.samples=1", "shade.saturation=0.6"],
        &[
            "ink.tone=hatch",
            "highlight.edge=soft",
            "highlight.back.on=true",
        ],
    ] {
        let mut style = Style::preset("mtoon").unwrap();
        settings
            .iter()
            .for_each(|setting| style.set(setting).unwrap());
        let options = RendererOptions::new([320, 240]);
        let draw = |engine| draw_with(engine, &model, &style, &camera(), &options);
        let agreement = Agreement::between(&draw(&Processor), &draw(device), 2);
        println!("{settings:?} {agreement}");
        assert!(agreement.holds(), "{settings:?}: {agreement}");
    }
}

#[test]
fn both_engines_draw_avatars_alike() {
    let Some(device) = device() else { return };
    let is_avatar = |path: &PathBuf| path.to_string_lossy().contains("godette");
    for path in models().into_iter().filter(is_avatar) {
        let name = path.display();
        let scene = npr_scene::load(&path, &npr_scene::LoadOptions::default());
        let model = Model::new(&scene.unwrap()).unwrap();
        let camera = model.framing(0.75, 0.5);
        let style = Style::preset("mtoon").unwrap();
        let options = RendererOptions::new([360, 480]);
        let draw = |engine| draw_with(engine, &model, &style, &camera, &options);
        let agreement = Agreement::between(&draw(&Processor), &draw(device), 2);
        println!("{name} {agreement}");
        assert!(agreement.holds(), "{name}: {agreement}");
    }
}
