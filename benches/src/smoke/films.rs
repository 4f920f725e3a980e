//! How calm whole pictures of smoke are beside those of billboards [Selle 2004], with true motion taken out, on smoke
//! of the built-in simulation: a short run of what `cargo xtask measure smoke` prints.

use crate::smoke::calm::{Change, Shown};
use crate::smoke::subject::{camera, drawn, plume, space_of};
use npr_gpu::processor::Processor;
use npr_render::{Following, Model, Renderer, RendererOptions};
use npr_scene::Scene;
use npr_smoke::{Puffs, Smoke, Volume};
use npr_stylesheet::Style;

const SIZE: [u32; 2] = [384, 384];

fn look(method: &str) -> Style {
    let mut style = Style::preset("smoke-cel-2").unwrap();
    for setting in [
        "light.space=world",
        "smoke.puffs.count=300",
        &format!("smoke.method={method}"),
    ] {
        style.set(setting).unwrap();
    }
    style
}

/// The plume after some frames, and the spheres that followed it.
fn followed(frames: u32, style: &Style) -> (Smoke, Puffs) {
    let mut smoke = Smoke::new(plume([24, 24, 48])).unwrap();
    smoke.step();
    let mut puffs = Puffs::new(&smoke.volume(), Following::default().settings(&style.smoke));
    for _ in 1..frames {
        smoke.step();
        puffs.step(&smoke.volume());
    }
    (smoke, puffs)
}

/// What changes without cause over so many steps; each step gives the smoke, its spheres, and how far the camera has
/// turned.
fn changes(
    style: &Style,
    steps: u32,
    mut step: impl FnMut(u32) -> (Volume, Puffs, f32),
) -> [f64; 2] {
    let model = Model::new(&Scene::default()).unwrap();
    let options = RendererOptions {
        smoke: Some(npr_render::Smoke::new(vec![
            npr_render::Sphere::default();
            300
        ])),
        ..RendererOptions::new(SIZE)
    };
    let mut renderer = Renderer::new(&Processor, &model, style, &options).unwrap();
    let mut shown = |number: u32| {
        let (volume, puffs, degrees) = step(number);
        let camera = camera(space_of(&volume), SIZE, degrees);
        renderer
            .set_smoke(&drawn(&puffs.spheres(), &volume))
            .unwrap();
        Shown::new(&renderer.draw(&camera).unwrap(), &camera, &puffs.spheres())
    };
    let frames: Vec<Shown> = (0..=steps).map(&mut shown).collect();
    let pairs = frames.windows(2).map(|pair| pair[1].change_since(&pair[0]));
    let sum = pairs.fold(Change::default(), Change::and);
    assert!(sum.compared > 4000 * steps as usize, "{sum:?}");
    sum.shares()
}

#[test]
fn a_camera_round_still_smoke_changes_a_third_of_what_billboards_do() {
    let of = |method: &str| {
        let style = look(method);
        let (smoke, puffs) = followed(48, &style);
        let volume = smoke.volume();
        changes(&style, 8, |step| {
            (volume.clone(), puffs.clone(), step as f32)
        })
    };
    let ([ours, _], [boards, _]) = (of("spheres"), of("billboards"));
    println!("differ without cause: {ours:.4}, billboards {boards:.4}");
    assert!(
        ours * 3.0 < boards,
        "{ours} against the billboards' {boards}"
    );
}

#[test]
fn rising_smoke_changes_half_of_what_billboards_do() {
    let of = |method: &str| {
        let style = look(method);
        let (mut smoke, mut puffs) = followed(24, &style);
        changes(&style, 12, |_| {
            smoke.step();
            puffs.step(&smoke.volume());
            (smoke.volume(), puffs.clone(), 0.0)
        })
    };
    let ([ours, jumps], [boards, board_jumps]) = (of("spheres"), of("billboards"));
    println!(
        "differ without cause: {ours:.4}, billboards {boards:.4}; jump: {jumps:.4}, billboards {board_jumps:.4}"
    );
    assert!(
        ours * 2.0 < boards,
        "{ours} against the billboards' {boards}"
    );
    assert!(
        jumps * 1.5 < board_jumps,
        "{jumps} jump against the billboards' {board_jumps}"
    );
}
