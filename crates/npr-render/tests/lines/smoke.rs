//! Smoke as curves: its outline among the lines of a scene, and against the outline of pictures.
//!
//! Set `NPR_SMOKE_PICTURES` to a folder to look at them.

use npr_core::camera::{Camera, Projection};
use npr_core::math::{cos, mix_bits, sin};
use npr_drawing::artwork::ArtworkOptions;
use npr_gpu::processor::Processor;
use npr_render::{
    Drawing, LineModel, LineModelOptions, LineOptions, Model, Renderer, RendererOptions, Smoke,
    Sphere,
};
use npr_scene::{Mesh, Node, Part, Scene};
use npr_stylesheet::Style;

const SIZE: [u32; 2] = [320, 320];

fn share(i: u32, k: u32) -> f32 {
    (mix_bits(mix_bits(i) ^ k.wrapping_mul(0x9e37_79b9)) >> 8) as f32 / (1 << 24) as f32
}

/// A cloud that rises and spreads.
fn plume(count: u32) -> Smoke {
    let puff = |i: u32| {
        let height = share(i, 1);
        let (angle, out) = (
            share(i, 2) * std::f32::consts::TAU,
            share(i, 3).sqrt() * (0.15 + 0.6 * height),
        );
        let radius = (0.08 + 0.24 * height) * (0.5 + 0.8 * share(i, 4));
        Sphere::new([cos(angle) * out, height * 3.0, sin(angle) * out], radius)
    };
    Smoke {
        spheres: (0..count).map(puff).collect(),
        space: Some(([-1.2, -0.3, -1.2], [1.2, 3.6, 1.2])),
    }
}

fn camera() -> Camera {
    Camera {
        eye: [0.0, 1.65, 8.0],
        target: [0.0, 1.65, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.5 },
    }
}

fn style(text: &str) -> Style {
    Style::from_toml(text, &|name| Err(format!("no {name}"))).unwrap()
}

/// A square that faces +z from x 0 to the right, at a depth.
fn wall(z: f32) -> Scene {
    let mut scene = Scene::default();
    let corner = |x: f32, y: f32| [x, y, z];
    let part = Part {
        positions: vec![
            corner(0.0, 0.5),
            corner(1.2, 0.5),
            corner(1.2, 2.8),
            corner(0.0, 2.8),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Part::default()
    };
    scene.meshes.push(Mesh {
        name: String::new(),
        parts: vec![part],
    });
    scene.nodes.push(Node {
        mesh: Some(0),
        ..Node::default()
    });
    scene
}

fn options() -> LineOptions {
    LineOptions::new(SIZE)
}

fn draw(scene: &Scene, smoke: &Smoke, style: &Style, options: &LineOptions) -> Drawing {
    let mut model = LineModel::new(scene, &LineModelOptions::default()).unwrap();
    model.set_smoke(Some(smoke.clone()));
    model.draw(&camera(), style, options).unwrap()
}

fn ball() -> Smoke {
    Smoke::new(vec![Sphere::new([0.0, 1.65, 0.0], 0.5)])
}

fn keep(name: &str, drawing: &Drawing) {
    if let Ok(folder) = std::env::var("NPR_SMOKE_PICTURES") {
        let artwork = ArtworkOptions {
            background: Some([255; 4]),
            ..ArtworkOptions::default()
        };
        let rgba = npr_drawing::drawing::rasterise(drawing, &artwork);
        let [width, height] = drawing.size;
        let image = image::RgbaImage::from_raw(width, height, rgba).unwrap();
        image.save(format!("{folder}/lines_{name}.png")).unwrap();
    }
}

#[test]
fn a_puff_is_a_circle_that_swells_away_from_the_light() {
    let style = style("smoke.light = [-1, 0, 0]\nsmoke.line = { width = '4px', swell = 0.5 }");
    let drawing = draw(&Scene::default(), &ball(), &style, &options());
    assert_eq!(drawing.strokes.len(), 1);
    let stroke = &drawing.strokes[0];
    assert!(stroke.closed && stroke.is_visible());
    assert_eq!(drawing.surfaces[stroke.surface as usize].object, "smoke");
    // Sights touch the sphere where the sine of their angle is radius over distance.
    let radius_px = (0.5f64 / 8.0).asin().tan() * 160.0 / 0.25f64.tan();
    for point in &stroke.points {
        let [x, y] = point.position.map(|v| v - 160.0);
        assert!(
            ((x * x + y * y).sqrt() - radius_px).abs() < 0.1,
            "{:?}",
            point.position
        );
        let wanted = 4.0 * (1.0 + 0.5 * x / radius_px);
        assert!(
            (point.width - wanted).abs() < 0.05,
            "{} at {x}, not {wanted}",
            point.width
        );
    }
    let ids: Vec<u64> = drawing.strokes.iter().map(|stroke| stroke.id).collect();
    assert!(ids.iter().all(|id| *id > 1 << 48 && *id < 1 << 53));
}

#[test]
fn scene_and_smoke_hide_each_other() {
    let plain = style("");
    let among = |z: f32| draw(&wall(z), &ball(), &plain, &options());
    let is_smoke =
        |drawing: &Drawing, surface: u32| drawing.surfaces[surface as usize].object == "smoke";
    let points = |drawing: &Drawing, smoke: bool| -> Vec<[f64; 2]> {
        let strokes = drawing
            .strokes
            .iter()
            .filter(|s| is_smoke(drawing, s.surface) == smoke);
        strokes
            .flat_map(|stroke| stroke.points.iter().map(|p| p.position))
            .collect()
    };
    // The wall's left border is the middle of the picture.
    let before = among(1.0);
    assert!(points(&before, true).iter().all(|[x, _]| *x < 160.5));
    assert!(
        points(&before, false)
            .iter()
            .any(|[x, y]| (x - 160.0).abs() < 0.5 && (y - 160.0).abs() < 20.0)
    );
    let behind = among(-1.0);
    assert!(points(&behind, true).iter().any(|[x, _]| *x > 190.0));
    assert!(
        !points(&behind, false)
            .iter()
            .any(|[x, y]| (x - 160.0).abs() < 5.0 && (y - 160.0).abs() < 30.0)
    );
    // Through the middle: the sphere bulges out before the wall, whose border ends in it.
    let through = among(0.0);
    assert!(
        !points(&through, false)
            .iter()
            .any(|[x, y]| (x - 160.0).abs() < 5.0 && (y - 160.0).abs() < 30.0)
    );
    let hidden = LineOptions {
        hidden: true,
        ..options()
    };
    let reported = draw(&wall(-1.0), &ball(), &plain, &hidden);
    assert!(
        reported
            .strokes
            .iter()
            .any(|stroke| stroke.occluders == 1 && !is_smoke(&reported, stroke.surface))
    );
    let haze = draw(
        &wall(-1.0),
        &ball(),
        &style("smoke.opacity = 0.3"),
        &options(),
    );
    assert!(
        points(&haze, false)
            .iter()
            .any(|[x, y]| (x - 160.0).abs() < 5.0 && (y - 160.0).abs() < 30.0)
    );
}

/// The outline of pictures is ink of the same rims: what one draws, the other does.
#[test]
fn curves_lie_where_pictures_have_their_ink() {
    let text = "background = 'white'\nsmoke.ramp = [{ at = 0.0, color = 'white' }]\n\
                smoke.line = { color = 'black', width = '3px', inner = 1.0, swell = 0.0 }";
    let (style, smoke) = (style(text), plume(160));
    let drawing = draw(&Scene::default(), &smoke, &style, &options());
    keep("plume", &drawing);
    let renderer_options = RendererOptions {
        smoke: Some(smoke),
        ..RendererOptions::new(SIZE)
    };
    let empty = Model::new(&Scene::default()).unwrap();
    let mut renderer = Renderer::new(&Processor, &empty, &style, &renderer_options).unwrap();
    let frame = renderer.draw(&camera()).unwrap();
    let [width, height] = SIZE.map(|side| side as usize);
    let ink: Vec<bool> = frame
        .rgba
        .chunks_exact(4)
        .map(|pixel| pixel[0] < 110)
        .collect();
    let places: Vec<[f64; 2]> = drawing
        .strokes
        .iter()
        .flat_map(|s| s.points.iter().filter(|p| p.width > 1.0))
        .map(|p| p.position)
        .collect();
    let mut lined = vec![false; ink.len()];
    let reach = |place: &[f64; 2], around: i64, visit: &mut dyn FnMut(usize)| {
        let [x, y] = place.map(|v| v.floor() as i64);
        for (dx, dy) in (-around..=around).flat_map(|dx| (-around..=around).map(move |dy| (dx, dy)))
        {
            let (x, y) = (x + dx, y + dy);
            if (0..width as i64).contains(&x) && (0..height as i64).contains(&y) {
                visit(y as usize * width + x as usize);
            }
        }
    };
    let mut missed = 0;
    for place in &places {
        let mut is_inked = false;
        reach(place, 2, &mut |i| is_inked |= ink[i]);
        missed += usize::from(!is_inked);
        reach(place, 4, &mut |i| lined[i] = true);
    }
    let bare = ink
        .iter()
        .zip(&lined)
        .filter(|(ink, lined)| **ink && !**lined)
        .count();
    let inked = ink.iter().filter(|ink| **ink).count();
    println!(
        "{missed} of {} points without ink, {bare} of {inked} pixels without line",
        places.len()
    );
    assert!(places.len() > 500 && inked > 1000);
    assert!(
        missed * 50 < places.len(),
        "{missed} of {} points have no ink",
        places.len()
    );
    assert!(bare * 25 < inked, "{bare} of {inked} pixels have no line");
}

#[test]
fn fills_are_the_smoke_and_what_it_leaves_of_the_scene() {
    let filled = LineOptions {
        fill: true,
        ..options()
    };
    let drawing = draw(&wall(-0.2), &plume(60), &style(""), &filled);
    keep("filled", &drawing);
    let of = |object: &str| -> f64 {
        let regions = drawing
            .regions
            .iter()
            .filter(|r| drawing.surfaces[r.surface as usize].object == object);
        let area = |ring: &Vec<[f64; 2]>| {
            let next = ring.iter().cycle().skip(1);
            ring.iter()
                .zip(next)
                .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
                .sum::<f64>()
                * 0.5
        };
        regions
            .flat_map(|region| region.rings.iter().map(area))
            .sum()
    };
    assert!(
        of("smoke") > 5000.0 && of("") > 1000.0,
        "{} and {}",
        of("smoke"),
        of("")
    );
}

/// No line is drawn where smoke goes through a surface, but colours end there: on a circle.
#[test]
fn fills_end_where_smoke_goes_through_a_surface() {
    let filled = LineOptions {
        fill: true,
        ..options()
    };
    let white = style("smoke.ramp = [{ at = 0, color = 'white' }]");
    let drawing = draw(&wall(0.1), &ball(), &white, &filled);
    let smoke = drawing
        .regions
        .iter()
        .filter(|region| drawing.surfaces[region.surface as usize].object == "smoke");
    let points: Vec<[f64; 2]> = smoke.flat_map(|region| region.rings.concat()).collect();
    let before_wall: Vec<f64> = points
        .iter()
        .map(|place| place.map(|v| v - 160.0))
        .filter(|[x, _]| *x > 1.5)
        .map(|[x, y]| (x * x + y * y).sqrt())
        .collect();
    let radius_px = (0.25f64 - 0.01).sqrt() / 7.9 * 160.0 / 0.25f64.tan();
    let outermost = before_wall.iter().copied().fold(0.0, f64::max);
    assert!(before_wall.len() > 50, "{} points", before_wall.len());
    assert!(
        (outermost - radius_px).abs() < 0.7,
        "{outermost}, not {radius_px}"
    );
    let on_circle = before_wall
        .iter()
        .filter(|r| (**r - radius_px).abs() < 0.5)
        .count();
    assert!(
        on_circle * 10 > before_wall.len() * 9,
        "{on_circle} of {}",
        before_wall.len()
    );
}

#[test]
fn hostile_smoke_draws_something_or_nothing() {
    let odd = [f32::NAN, f32::INFINITY, -1.0, 0.0, 1e-30, 1e30, 8.0];
    let spheres = odd
        .iter()
        .flat_map(|a| odd.iter().map(|b| Sphere::new([*a, 1.0, *b], *b)));
    for hidden in [false, true] {
        let wanted = LineOptions {
            hidden,
            fill: true,
            ..options()
        };
        let drawing = draw(
            &wall(0.0),
            &Smoke::new(spheres.clone().collect()),
            &style(""),
            &wanted,
        );
        let finite = |point: &npr_vector::stroke::StrokePoint| {
            point.position.iter().all(|v| v.is_finite()) && point.width.is_finite()
        };
        assert!(
            drawing
                .strokes
                .iter()
                .all(|stroke| stroke.points.iter().all(finite))
        );
    }
    assert!(
        draw(&Scene::default(), &Smoke::default(), &style(""), &options())
            .strokes
            .is_empty()
    );
}
