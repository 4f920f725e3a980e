//! What colours lines have, by the definition.

use npr_core::color::{linear_rgba, srgb_from_linear, unpack_rgba8};
use npr_core::geometry::{NONE, Part};
use npr_core::line_kind::Kind;
use npr_core::math;
use npr_core::surface::unit_or_z;
use npr_core::texture::{TextureStore, Wrap};
use npr_core::window::View;
use npr_style::gloss::back_light;
use npr_style::lighting::Lights;
use npr_style::line_color::{HUES, LineScene};
use npr_stylesheet::{HueStop, LinePaint, Style, hue_row};
use proptest::prelude::*;

fn view() -> View {
    View {
        eye_world: [0.0, 0.0, 5.0],
        forward_world: [0.0, 0.0, -1.0],
        perspective: 1.0,
        ..View::default()
    }
}

/// A part of a model of radius 1 in a paint, with its rows.
fn painted(text: &str) -> (Part, TextureStore) {
    let style = Style::from_toml(&format!("line.paint = {text}"), &|_| Err(String::new()))
        .expect("a paint");
    let paint: &LinePaint = &style.line.paint;
    let mut store = TextureStore::new();
    let mut row = |stops: &[HueStop]| {
        let size = [HUES as u32, 1];
        store
            .add(size, &hue_row(stops), [Wrap::Clamp; 2])
            .expect("room")
    };
    let mut part = Part {
        base_color: [0.8, 0.4, 0.2, 1.0],
        line_color: [0.2, 0.1, 0.05, 1.0],
        back_color: [0.2, 0.4, 1.0, 1.0],
        back: [0.6, 0.8, 0.0, 0.0],
        back_direction: [0.0, 0.0, -1.0],
        line_depth_row: row(&paint.depth.ramp),
        line_light_row: row(&paint.light.ramp),
        line_texture: NONE,
        ..Part::default()
    };
    paint.give_to(&mut part, 1.0, 1.0);
    (part, store)
}

fn scene<'a>(view: &'a View, lights: &'a Lights, store: &'a TextureStore) -> LineScene<'a> {
    LineScene {
        view,
        lights,
        axes_world: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        center_world: [0.0; 3],
        texels: store.words(),
    }
}

/// The colour by the definition, a step after the other, each mixed into the last; `place` is one in the world and
/// its normal.
fn one_after_the_other(
    scene: &LineScene<'_>,
    (part, kind): (&Part, Kind),
    own: [f32; 3],
    place: [[f32; 3]; 2],
) -> [f32; 4] {
    let [world, normal] = place;
    let of_kind = part.line_flags & kind.bit() != 0;
    let start = if of_kind {
        unpack_rgba8(part.line_kinds[kind as usize])
    } else {
        part.line_color
    };
    let mut color = linear_rgba(start);
    if !of_kind && part.line_flags & Part::LINE_SOURCES != 0 {
        color = [own[0], own[1], own[2], color[3]];
    }
    let mut lay = |top: [f32; 4]| {
        for i in 0..3 {
            color[i] += (top[i] - color[i]) * top[3];
        }
    };
    let x = scene.lights.coordinate_at(world, normal, 0).0;
    if part.line_flags & Part::LINE_LIGHT != 0 {
        lay(scene.hue(part.line_light_row, x));
    }
    if part.line_flags & Part::LINE_RIM != 0 {
        let rim = back_light(normal, part.back_direction, part.back[0], part.back[1]);
        let [r, g, b, a] = part.back_color;
        lay([r, g, b, a * rim * part.line_rim]);
    }
    if part.line_flags & Part::LINE_DEPTH != 0 {
        let depth = 5.0 - world[2];
        let from = if part.line_flags & Part::LINE_FROM_MIDDLE != 0 {
            5.0
        } else {
            0.0
        };
        let share = ((depth - from - part.line_depth[0]) * part.line_depth[1]).clamp(0.0, 1.0);
        lay(scene.hue(part.line_depth_row, share));
    }
    lay(linear_rgba(unpack_rgba8(part.line_tint)));
    let opacity = part.line_opacity[0] + (part.line_opacity[1] - part.line_opacity[0]) * x;
    [
        srgb_from_linear(color[0]),
        srgb_from_linear(color[1]),
        srgb_from_linear(color[2]),
        color[3] * opacity,
    ]
}

const EVERYTHING: &str = "{ source = 'surface', kinds = { crease = '#aabbcc80' }, tint = '#80ff0040', \
     depth = { near = 0.2, far = 0.9, ramp = [{ at = 0.1, color = '#fff0' }, { at = 1, color = '#cceeffc0' }] }, \
     light = { rim = 0.7, opacity = [1, 0.4], \
     ramp = [{ at = 0, color = '#0008' }, { at = 1, color = '#ffa040c0' }] } }";

fn kind() -> impl Strategy<Value = Kind> {
    prop::sample::select(&Kind::COLORED[..])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn the_tint_layer_is_its_layers_in_order(
        own in prop::array::uniform3(0f32..1.0),
        world in prop::array::uniform3(-1f32..1.0),
        normal in prop::array::uniform3(-1f32..1.0),
        towards in prop::array::uniform3(-1f32..1.0),
        kind in kind(),
    ) {
        let (part, store) = painted(EVERYTHING);
        let (view, lights) = (view(), Lights::distant(unit_or_z(towards)));
        let scene = scene(&view, &lights, &store);
        let normal = unit_or_z(normal);
        let got = scene.color_at(&part, kind, own, world, normal);
        let want = one_after_the_other(&scene, (&part, kind), own, [world, normal]);
        for i in 0..4 {
            prop_assert!((got[i] - want[i]).abs() < 2e-3, "{got:?} for {want:?}");
        }
    }

    #[test]
    fn a_constant_is_the_lines_own_color_to_the_bit(
        world in prop::array::uniform3(-1e6f32..1e6), normal in prop::array::uniform3(-1f32..1.0), kind in kind(),
    ) {
        let (part, store) = painted("{}");
        let (view, lights) = (view(), Lights::distant([0.0, 1.0, 0.0]));
        let color = scene(&view, &lights, &store).color_at(&part, kind, [0.5; 3], world, unit_or_z(normal));
        prop_assert_eq!(color, [0.2, 0.1, 0.05, 1.0]);
    }

    /// A thousandth of the model's size further back, or of a turn, no channel jumps.
    #[test]
    fn color_is_continuous_over_depth_and_light(z in -1f32..1.0, angle in 0f32..6.2) {
        let (part, store) = painted(EVERYTHING);
        let (view, lights) = (view(), Lights::distant([0.6, 0.0, 0.8]));
        let scene = scene(&view, &lights, &store);
        let at = |z: f32, angle: f32| {
            let normal = [math::sin(angle), 0.0, math::sin(angle + 1.570_796_4)];
            scene.color_at(&part, Kind::Contour, [0.2; 3], [0.0, 0.0, z], normal)
        };
        let (here, back, turned) = (at(z, angle), at(z - 0.001, angle), at(z, angle + 0.001));
        for i in 0..4 {
            prop_assert!((here[i] - back[i]).abs() < 0.02 && (here[i] - turned[i]).abs() < 0.03);
        }
    }

    /// Numbers that are none, and far too large, still give a colour.
    #[test]
    fn any_place_has_a_color(
        world in prop::array::uniform3(any::<f32>()), normal in prop::array::uniform3(any::<f32>()),
    ) {
        let (part, store) = painted(EVERYTHING);
        let (view, lights) = (view(), Lights::distant([0.0, 1.0, 0.0]));
        let scene = scene(&view, &lights, &store);
        scene.color_at(&part, Kind::Contour, [f32::NAN; 3], world, normal);
        scene.width_at(&part, world, normal);
    }
}

#[test]
fn depth_counts_from_the_models_nearest_place() {
    let (part, store) =
        painted("{ depth.ramp = [{ at = 0, color = '#fff0' }, { at = 1, color = '#fff' }] }");
    let (view, lights) = (view(), Lights::distant([0.0, 1.0, 0.0]));
    let scene = scene(&view, &lights, &store);
    let at = |z: f32| {
        scene.color_at(
            &part,
            Kind::Contour,
            [0.0; 3],
            [0.0, 0.0, z],
            [0.0, 0.0, 1.0],
        )
    };
    assert_eq!(
        at(1.0),
        [0.2, 0.1, 0.05, 1.0],
        "a sphere of radius 1 begins here"
    );
    assert!(at(-1.0)[0] > 0.999);
    assert_eq!(at(-1.0), at(-9.0), "it stays");
    assert!(at(0.0)[0] > at(0.5)[0]);
}

#[test]
fn light_thins_and_rims_shine() {
    let (part, store) = painted("{ light = { width = [1.2, 0.4], rim = 1 } }");
    let (view, lights) = (view(), Lights::distant([0.0, 1.0, 0.0]));
    let scene = scene(&view, &lights, &store);
    let width = |normal| scene.width_at(&part, [0.0; 3], normal);
    assert!((width([0.0, 1.0, 0.0]) - 0.4).abs() < 1e-6);
    assert!((width([0.0, -1.0, 0.0]) - 1.2).abs() < 1e-6);
    let color = |normal| scene.color_at(&part, Kind::Contour, [0.0; 3], [0.0; 3], normal);
    let behind = color([0.0, 0.0, -1.0]);
    assert!((behind[2] - 1.0).abs() < 1e-5, "the light behind is blue");
    assert_eq!(color([0.0, 0.0, 1.0]), [0.2, 0.1, 0.05, 1.0]);
}
