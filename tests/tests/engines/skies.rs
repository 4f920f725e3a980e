//! Light from the sky: its two colours, what hides it, its picture, on both engines.

use npr_core::camera::{Camera, Projection};
use npr_gpu::processor::Processor;
use npr_mesh::testing::icosphere;
use npr_render::{Frame, Model, Picture, RendererOptions};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::comic::{front, pixel};
use npr_tests::{Agreement, Object, boxed, device, draw_with, scene_of};

const SIZE: [u32; 2] = [320, 240];

/// White paper whose light is the ramp coordinate's smooth step, under a sky alone.
fn sky(keys: &str) -> Style {
    let text = format!(
        "background = '#000000'\n[shade]\nmode = 'paper'\nsoftness = 0.5\n\
         ramp = [{{ at = 0.0, light = 0.0 }}, {{ at = 0.25, light = 0.5 }}, {{ at = 0.75, light = 1.0 }}]\n\
         [line]\nmethod = 'none'\n[light]\nintensity = 0.0\n[[light.extra]]\nkind = 'sky'\nintensity = 1.0\n{keys}\n"
    );
    Style::from_toml(&text, &|_| Err(String::new())).unwrap()
}

/// Light of the ramp of [`sky`] at a coordinate.
fn ramp(x: f32) -> f32 {
    let step = |from: f32, to: f32| {
        let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    0.5 * step(0.0, 0.5) + 0.5 * step(0.5, 1.0)
}

/// The coordinate whose light a pixel shows.
fn coordinate(pixel: [u8; 3]) -> f32 {
    let light = npr_core::color::linear_from_byte(pixel[1]);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..30 {
        let middle = (low + high) * 0.5;
        if ramp(middle) < light {
            low = middle
        } else {
            high = middle
        }
    }
    low
}

fn drawn(scene: &Scene, style: &Style, camera: &Camera, pictures: &[(&str, Picture)]) -> Frame {
    let model = Model::new(scene).unwrap();
    let given = pictures
        .iter()
        .map(|(name, picture)| ((*name).to_owned(), picture.clone()));
    let options = RendererOptions {
        pictures: given.collect(),
        ..RendererOptions::new(SIZE)
    };
    let frame = draw_with(&Processor, &model, style, camera, &options);
    if let Some(device) = device() {
        let other = draw_with(device, &model, style, camera, &options);
        let agreement = Agreement::between(&frame, &other, 2);
        println!("{agreement}");
        assert!(agreement.holds(), "{agreement}");
    }
    frame
}

fn ball() -> Scene {
    scene_of(&[Object::new("Ball", icosphere(5))])
}

#[test]
fn a_sky_shines_in_one_color_from_above_and_another_from_below() {
    let frame = drawn(
        &ball(),
        &sky("color = '#c0d8ff'\nground = '#804000'"),
        &front(),
        &[],
    );
    // The ball's radius is 96 pixels.
    let [top, middle, bottom] = [30, 120, 210].map(|y| pixel(&frame, 160, y));
    assert!(top[2] > top[0] + 20, "blue above: {top:?}");
    assert!(
        bottom[0] > bottom[2] + 60 && bottom[0] > 60,
        "brown below: {bottom:?}"
    );
    assert!(
        top[1] > middle[1] && middle[1] > bottom[1],
        "{top:?} {middle:?} {bottom:?}"
    );
    let dark = drawn(&ball(), &sky("ground = '#000000'"), &front(), &[]);
    assert!(
        pixel(&dark, 160, 214)[0] < 20,
        "a black ground gives nothing"
    );
}

/// From above, so that x of the picture is x of the scene.
fn from_above() -> Camera {
    Camera {
        eye: [0.0, 9.0, 0.0],
        target: [0.0; 3],
        up: [0.0, 0.0, -1.0],
        projection: Projection::Parallel { height: 3.0 },
    }
}

#[test]
fn a_wall_hides_the_sky_by_the_angle_that_it_fills() {
    // A floor, and a wall as high as 1 over its left half that goes on far beyond the picture.
    let scene = scene_of(&[
        Object::new("Floor", boxed([-3.0, -0.1, -5.0], [3.0, 0.0, 5.0])),
        Object::new("Wall", boxed([-1.2, 0.0, -5.0], [-1.0, 1.0, 5.0])),
    ]);
    let of = |keys: &str| drawn(&scene, &sky(keys), &from_above(), &[]);
    let [open, hidden] = [of(""), of("shadow = true")];
    let mut before = 0.0;
    for x in [90, 110, 140, 180, 230] {
        // 80 pixels are a unit; the wall stands from 64 to 80.
        let apart = (x as f32 + 0.5 - 80.0) / 80.0;
        let wanted = 0.5 * (1.0 + apart / apart.hypot(1.0));
        let got = coordinate(pixel(&hidden, x, 120));
        println!("{apart}: {got} for {wanted}");
        assert!((got - wanted).abs() < 0.06, "{apart}: {got} for {wanted}");
        assert!(got > before, "lighter away from the wall");
        assert!(
            coordinate(pixel(&open, x, 120)) > 0.97,
            "without shadows nothing hides it"
        );
        before = got;
    }
}

#[test]
fn a_room_darkens_inwards_and_an_open_ball_does_not() {
    let room = |roof: f32| {
        let parts = [
            boxed([-2.0, -0.1, -2.0], [2.0, 0.0, 2.0]),
            boxed([-2.0, roof, -2.0], [2.0, roof + 0.1, 1.0]),
            boxed([-2.0, 0.0, -2.0], [2.0, roof, -1.9]),
            boxed([-2.0, 0.0, -2.0], [-1.9, roof, 1.0]),
            boxed([1.9, 0.0, -2.0], [2.0, roof, 1.0]),
        ];
        scene_of(&parts.map(|part| Object::new("Room", part)))
    };
    let camera = Camera {
        eye: [0.0, 2.0, 6.0],
        target: [0.0, 0.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.6 },
        ..front()
    };
    let style = sky("shadow = true");
    let frame = drawn(&room(1.2), &style, &camera, &[]);
    let view = camera.view(SIZE, ([-2.0, -0.1, -2.0], [2.0, 1.3, 2.0]));
    let floor = [1.7, 0.9, 0.0, -1.2].map(|z: f32| {
        let clip = npr_core::surface::apply_point(&view.clip_from_world, [0.0, 0.0, z]);
        let x = (clip[0] / clip[3] + 1.0) * 0.5 * SIZE[0] as f32;
        let y = (1.0 - clip[1] / clip[3]) * 0.5 * SIZE[1] as f32;
        coordinate(pixel(&frame, x as u32, y as u32))
    });
    println!("{floor:?}");
    assert!(floor.windows(2).all(|pair| pair[1] < pair[0]), "{floor:?}");
    assert!(floor[0] > 0.7 && floor[3] < 0.25, "{floor:?}");
    let [hidden, open] = [style, sky("")].map(|style| drawn(&ball(), &style, &front(), &[]));
    let agreement = Agreement::between(&hidden, &open, 3);
    assert!(
        agreement.within > 0.99,
        "nothing hides the sky of a lone ball: {agreement}"
    );
}

/// A picture of the sky, 16 by 8, of one colour on its left and another on its right.
fn two_halves(left: [u8; 4], right: [u8; 4]) -> Picture {
    let row = [[left; 8].concat(), [right; 8].concat()].concat();
    Picture {
        size: [16, 8],
        rgba: row.repeat(8),
    }
}

#[test]
fn a_picture_of_the_sky_lights_what_faces_it() {
    let style = sky("image = 'sky.png'");
    let red_left = two_halves([255, 0, 0, 255], [0, 0, 255, 255]);
    let frame = drawn(&ball(), &style, &front(), &[("sky.png", red_left)]);
    // The camera looks along -z: what faces left sees the left half of the picture.
    let [left, right] = [75, 245].map(|x| pixel(&frame, x, 120));
    assert!(left[0] > left[2] + 60, "red on the left: {left:?}");
    assert!(right[2] > right[0] + 30, "blue on the right: {right:?}");
    let grey = two_halves([188, 188, 188, 255], [188, 188, 188, 255]);
    let even = drawn(&ball(), &style, &front(), &[("sky.png", grey)]);
    for (x, y) in [(160, 120), (90, 120), (160, 40), (200, 190)] {
        let x_of = coordinate(pixel(&even, x, y));
        assert!(
            (x_of - 0.5).abs() < 0.06,
            "half the light from everywhere: {x_of}"
        );
    }
}

#[test]
fn ink_and_stepped_tones_see_the_same_sky() {
    let scene = scene_of(&[
        Object::new("Floor", boxed([-3.0, -0.1, -5.0], [3.0, 0.0, 5.0])),
        Object::new("Wall", boxed([-1.2, 0.0, -5.0], [-1.0, 1.0, 5.0])),
    ]);
    // Where the coordinate is 0.8 the wall is 0.75 away: ink ends there, and so does a tone.
    let ends = |keys: &[&str]| {
        let mut style = sky("shadow = true");
        for key in keys {
            style.set(key).unwrap();
        }
        let frame = drawn(&scene, &style, &from_above(), &[]);
        (84..300).find(|x| pixel(&frame, *x, 120)[0] > 128).unwrap()
    };
    let ink = ends(&[
        "shade.ramp=[{ at = 0.0, light = 1.0 }]",
        "ink.tone=ink",
        "ink.dark_at=0.8",
        "ink.light_at=0.8",
    ]);
    let tone = ends(&[
        "shade.softness=0",
        "shade.ramp=[{ at = 0.0, light = 0.0 }, { at = 0.8, light = 1.0 }]",
    ]);
    // Places are lifted by a texel and a half, and the wall is that much lower for them.
    let radius = 1.03 * f32::hypot(f32::hypot(3.0, 0.55), 5.0);
    let wanted = 80.0 + 80.0 * 0.75 * (1.0 - 1.5 * 2.0 * radius / 96.0);
    for end in [ink, tone] {
        assert!(
            (end as f32 - wanted).abs() <= 4.0,
            "{ink} and {tone} for {wanted}"
        );
    }
    assert!(ink.abs_diff(tone) <= 1, "{ink} {tone}");
}
