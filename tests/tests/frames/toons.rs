//! Toon materials of the scene, on the processor: a ball lit from the right whose middle lies at 160, 120 and whose
//! radius is 96 pixels.

use npr_core::color::srgb_from_linear;
use npr_render::Frame;
use npr_scene::{OutlineWidth, Scene, TextureTransform, Toon, ToonOutline};
use npr_stylesheet::Style;
use npr_tests::comic::{SIZE, front, pixel};
use npr_tests::{draw_from, stripes, toon_ball};

/// The colour of the ball in the light, and in the shade of [`plain`].
const LIT: [f32; 3] = [0.8, 0.4, 0.2];
const SHADE: [f32; 3] = [0.1, 0.2, 0.6];

fn plain() -> Toon {
    Toon {
        shade_color: SHADE,
        shading_toony: 1.0,
        ..Toon::default()
    }
}

fn styled(preset: &str, settings: &[&str]) -> Style {
    let mut style = Style::preset(preset).unwrap();
    let base = [
        "light.direction=[1,0,0]",
        "light.space=camera",
        "background=#000000",
    ];
    for setting in base.iter().chain(settings) {
        style.set(setting).unwrap();
    }
    style
}

fn drawn(scene: &Scene, settings: &[&str]) -> Frame {
    draw_from(scene, &styled("mtoon", settings), &front(), SIZE).frame
}

/// Asserts that a pixel on the middle row, `x` from the middle, shows a linear colour.
#[track_caller]
fn assert_shows(frame: &Frame, x: i32, color: [f32; 3]) {
    let wanted = color.map(|c| (srgb_from_linear(c.min(1.0)) * 255.0).round() as i32);
    let got = pixel(frame, (160 + x) as u32, 120).map(i32::from);
    let near = (0..3).all(|i| (got[i] - wanted[i]).abs() <= 3);
    assert!(near, "{x} from the middle: {got:?}, not {wanted:?}");
}

fn mixed(share: f32) -> [f32; 3] {
    std::array::from_fn(|i| SHADE[i] + (LIT[i] - SHADE[i]) * share)
}

#[test]
fn light_and_shade_meet_where_the_material_says() {
    let frame = drawn(&toon_ball(plain()), &[]);
    for (x, color) in [(-60, SHADE), (-4, SHADE), (4, LIT), (60, LIT)] {
        assert_shows(&frame, x, color);
    }

    // A shift of one half moves the border to a cosine of minus one half.
    let shifted = Toon {
        shading_shift: 0.5,
        ..plain()
    };
    let frame = drawn(&toon_ball(shifted), &[]);
    for (x, color) in [(-56, SHADE), (-40, LIT)] {
        assert_shows(&frame, x, color);
    }

    // A soft border is a straight line over the cosine.
    let soft = Toon {
        shading_toony: 0.5,
        ..plain()
    };
    let frame = drawn(&toon_ball(soft), &[]);
    for (x, share) in [(-48, 0.0), (-24, 0.25), (0, 0.5), (24, 0.75), (48, 1.0)] {
        assert_shows(&frame, x, mixed(share));
    }
}

#[test]
fn rims_and_light_of_their_own_are_added() {
    let toon = Toon {
        rim_color: [0.0, 0.2, 0.4],
        rim_power: 2.0,
        rim_lift: 0.1,
        rim_lighting_mix: 0.0,
        emissive: [0.05, 0.0, 0.0],
        ..plain()
    };
    let frame = drawn(&toon_ball(toon), &[]);
    for x in [-72, -30, 30, 72] {
        let facing = (1.0 - (x as f32 / 96.0).powi(2)).sqrt();
        let rim = (1.1 - facing).powi(2);
        let below = if x < 0 { SHADE } else { LIT };
        let color = [below[0] + 0.05, below[1] + 0.2 * rim, below[2] + 0.4 * rim];
        assert_shows(&frame, x, color);
    }
}

#[test]
fn pictures_lie_by_their_own_transforms() {
    // The shade is striped from left to right: red to the left quarter, green beside it.
    let toon = Toon {
        shade_color: [1.0; 3],
        shade_texture: Some(stripes(TextureTransform::default())),
        ..plain()
    };
    let striped = drawn(&toon_ball(toon.clone()), &[]);
    assert_shows(&striped, -80, [1.0, 0.0, 0.0]);
    assert_shows(&striped, -24, [0.0, 1.0, 0.0]);
    assert_shows(&striped, 24, LIT);

    // Moved by half, the same places show blue and white.
    let moved = TextureTransform {
        offset: [0.5, 0.0],
        ..TextureTransform::default()
    };
    let toon = Toon {
        shade_texture: Some(stripes(moved)),
        ..toon
    };
    let mut scene = toon_ball(toon);
    let frame = drawn(&scene, &[]);
    assert_shows(&frame, -80, [0.0, 0.0, 1.0]);
    assert_shows(&frame, -24, [1.0; 3]);

    // What the base colour lies by plays no part: its picture is white here.
    let squeezed = TextureTransform {
        scale: [0.25, 1.0],
        offset: [0.75, 0.0],
        rotation: 0.0,
    };
    scene.materials[0].base_color_texture = Some(stripes(squeezed));
    scene.images[0].rgba[..48].fill(255);
    scene.materials[0].toon.as_mut().unwrap().shade_texture = Some(stripes(moved));
    let frame = drawn(&scene, &[]);
    assert_shows(&frame, -80, [1.0; 3]);
    assert_shows(&frame, 24, LIT);

    // A matcap is looked up by the normal: green left of the middle, blue right of it.
    let toon = Toon {
        shade_color: [0.0; 3],
        matcap_texture: Some(stripes(TextureTransform::default())),
        rim_lighting_mix: 0.0,
        ..plain()
    };
    let mut scene = toon_ball(toon);
    scene.materials[0].base_color = [0.0, 0.0, 0.0, 1.0];
    let frame = drawn(&scene, &[]);
    assert_shows(&frame, -24, [0.0, 1.0, 0.0]);
    assert_shows(&frame, 24, [0.0, 0.0, 1.0]);
}

fn outlined(width: Option<OutlineWidth>) -> Toon {
    Toon {
        outline: ToonOutline {
            width,
            color: [0.2, 0.5, 0.1],
            lighting_mix: 0.0,
            ..ToonOutline::default()
        },
        ..plain()
    }
}

#[test]
fn outlines_have_the_width_and_the_color_of_their_material() {
    let black = [0.0; 3];
    let color = [0.2, 0.5, 0.1];
    // A twentieth of the height are 12 pixels, a tenth of a unit 9.6.
    for (width, last) in [
        (Some(OutlineWidth::Screen(0.05)), 12),
        (Some(OutlineWidth::World(0.1)), 10),
        (None, 0),
    ] {
        let frame = drawn(&toon_ball(outlined(width)), &[]);
        if last > 0 {
            assert_shows(&frame, 96 + last - 3, color);
            assert_shows(&frame, -96 - last + 3, color);
        }
        assert_shows(&frame, 96 + last + 2, black);
        assert_shows(&frame, -96 - last - 2, black);
    }

    // Its colour is multiplied by what the surface shows, as far as the material says.
    let mut toon = outlined(Some(OutlineWidth::Screen(0.05)));
    toon.outline.lighting_mix = 0.5;
    let frame = drawn(&toon_ball(toon.clone()), &[]);
    let mix = |below: [f32; 3]| std::array::from_fn(|i| color[i] * (0.5 + 0.5 * below[i]));
    assert_shows(&frame, 102, mix(LIT));
    assert_shows(&frame, -102, mix(SHADE));

    // A picture takes it away: the left is red and has no green, the right is white.
    toon.outline.texture = Some(stripes(TextureTransform::default()));
    toon.outline.lighting_mix = 0.0;
    let frame = drawn(&toon_ball(toon), &[]);
    assert_shows(&frame, -100, black);
    assert_shows(&frame, 102, color);
}

/// Styles that do not ask for hints draw as if there were none; overrides go before hints.
#[test]
fn hints_are_used_where_a_style_says_so() {
    let toon = outlined(Some(OutlineWidth::Screen(0.05)));
    let scene = toon_ball(toon);
    let mut without = scene.clone();
    without.materials[0].toon = None;
    let of = |scene: &Scene, preset: &str, settings: &[&str]| {
        let style = styled(preset, settings);
        draw_from(scene, &style, &front(), SIZE).frame.rgba
    };
    for preset in ["toon", "hull"] {
        let bare = of(&without, preset, &[]);
        assert!(of(&scene, preset, &[]) == bare, "{preset}");
        let hinted = of(&scene, preset, &["use_scene_hints=true"]);
        assert!(hinted != bare, "{preset}");
    }
    let ramp = "shade.ramp=[{ at = 0.0, light = 0.5 }]";
    let overridden = of(&scene, "mtoon", &[ramp, "line.method=none"]);
    let bare = of(&without, "mtoon", &[ramp, "line.method=none"]);
    assert!(overridden == bare, "an override goes before the scene");
    let half = drawn(&scene, &["use_scene_hints=['outline']"]);
    assert_shows(&half, -60, [0.0; 3]);
    assert_shows(&half, 100, [0.2, 0.5, 0.1]);
}
