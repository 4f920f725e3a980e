//! What a hand makes of lines, in frames and in files of the same drawing.

use npr_drawing::artwork::ArtworkOptions;
use npr_drawing::drawing::rasterise;
use npr_drawing::svg::{SvgOptions, write_svg};
use npr_gpu::processor::Processor;
use npr_mesh::testing::icosphere;
use npr_render::{
    Frame, LineModel, LineModelOptions, LineOptions, RenderError, RendererOptions, Subject,
};
use npr_stylesheet::Style;
use npr_tests::comic::front;
use npr_tests::{Ink, Object, boxed, lines, placed, scene_of};
use npr_vector::stroke::Drawing;

const SIZE: [u32; 2] = [640, 480];

/// A frame of a ball, the shapes that a file of the same drawing holds as pixels, and the drawing.
fn drawn(settings: &[&str]) -> ([Frame; 2], Drawing) {
    let scene = scene_of(&[Object::new(
        "Ball",
        placed(&icosphere(5), [0.8; 3], [0.0; 3]),
    )]);
    let style = style(settings);
    let subject = Subject::new(&scene, &style).unwrap();
    let options = RendererOptions::new(SIZE);
    let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
    let frame = renderer.draw(&front()).unwrap();
    let lines = subject.lines.as_ref().unwrap();
    let of_style = LineOptions::of_style(&style, SIZE);
    let drawing = lines.draw(&front(), &style, &of_style).unwrap();
    let artwork = ArtworkOptions {
        background: Some([255; 4]),
        ..ArtworkOptions::default()
    };
    let file = Frame {
        rgba: rasterise(&drawing, &artwork),
        ..frame.clone()
    };
    ([frame, file], drawing)
}

fn style(settings: &[&str]) -> Style {
    let mut style = lines("strokes");
    style.set("line.width.base=4px").unwrap();
    for setting in settings {
        style.set(setting).unwrap();
    }
    style
}

/// Pixels that one has and the other has not, as a share of all that is inked.
fn difference(one: &Ink, other: &Ink) -> f64 {
    let apart = one.without(&other.grown(1)).count() + other.without(&one.grown(1)).count();
    apart as f64 / one.count() as f64
}

/// The outline of a ball is one ring, so it has as many dashes as go round it, each an island of ink.
#[test]
fn frames_and_files_show_the_same_dashes() {
    let (_, whole) = drawn(&[]);
    assert_eq!(whole.strokes.len(), 1);
    let length = whole.strokes[0].length();
    let ([frame, file], drawing) = drawn(&["line.dash.pattern=['14px', '10px']"]);
    let wanted = (length / 24.0).round() as usize;
    let inks = [&frame, &file].map(Ink::of_strokes);
    for ink in &inks {
        assert_eq!(ink.components().len(), wanted);
        // Round ends make a dash as long as its width more, half of it on either side.
        let share = ink.count() as f64 / (length * 4.0);
        let round = 4.0 * std::f64::consts::PI / 4.0;
        assert!((share - (14.0 + round) / 24.0).abs() < 0.04, "{share}");
    }
    assert_eq!(difference(&inks[0], &inks[1]), 0.0);
    let svg = String::from_utf8(write_svg(&drawing, &SvgOptions::default())).unwrap();
    assert_eq!(svg.matches("<path data-id=").count(), wanted);
}

#[test]
fn frames_and_files_sway_alike() {
    let plain = Ink::of_strokes(&drawn(&[]).0[0]);
    let swayed = |wobble: &str| {
        let of_style = [
            &format!("line.hand.wobble={wobble}") as &str,
            "line.hand.wave=60px",
        ];
        drawn(&of_style).0.map(|frame| Ink::of_strokes(&frame))
    };
    let [frame, file] = swayed("8px");
    assert!(difference(&frame, &file) < 0.001);
    // It leaves its place by up to eight pixels and no more, and is one line still.
    assert_eq!(frame.components().len(), 1);
    assert_eq!(frame.without(&plain.grown(8)).count(), 0);
    assert!(frame.without(&plain.grown(3)).count() > 100);
    assert_eq!(swayed("8px")[0], frame, "it holds still");
    assert!(difference(&swayed("4px")[0], &frame) > 0.1);
}

#[test]
fn copies_lie_beside_the_line_in_frames_and_files() {
    let plain = Ink::of_strokes(&drawn(&[]).0[0]);
    let of_style = ["line.hand.copies=4", "line.hand.spread=9px"];
    let ([frame, file], drawing) = drawn(&of_style);
    assert_eq!(drawing.strokes.len(), 4);
    let [frame, file] = [&frame, &file].map(Ink::of_strokes);
    assert!(difference(&frame, &file) < 0.001);
    assert_eq!(
        plain.without(&frame).count(),
        0,
        "the line itself is there too"
    );
    assert_eq!(frame.without(&plain.grown(10)).count(), 0);
    assert!(frame.count() > 2 * plain.count());
}

/// The sides of a box run on over its corners.
#[test]
fn lines_leave_the_shape() {
    let scene = scene_of(&[Object::new(
        "Box",
        boxed([-0.8, -0.6, -0.1], [0.8, 0.6, 0.1]),
    )]);
    let inked = |setting: &str| {
        let style = style(&["line.split_angle_deg=60", setting]);
        let subject = Subject::new(&scene, &style).unwrap();
        let options = RendererOptions::new(SIZE);
        let mut renderer = subject.renderer(&Processor, &style, &options).unwrap();
        Ink::of_strokes(&renderer.draw(&front()).unwrap())
    };
    let plain = inked("line.hand.overshoot=0");
    let beyond = inked("line.hand.overshoot=40px");
    let gained = beyond.without(&plain);
    // Two ends at each of four corners, where they touch; each end 20 to 40 pixels long and 4 wide.
    assert_eq!(gained.components().len(), 4);
    assert!((8 * 15 * 4..8 * 40 * 4).contains(&gained.count()));
    assert_eq!(plain.without(&beyond).count(), 0);
    let short = inked("line.hand.undershoot=40px");
    assert_eq!(short.without(&plain).count(), 0);
    let lost = plain.without(&short).count();
    assert!((8 * 15 * 4..8 * 40 * 4).contains(&lost), "{lost}");
    assert_eq!(short.components().len(), 4, "four sides without corners");
}

/// The ring around a ball opens where a guide lies and thins out towards it, in frames and files, and goes on being cut
/// there where the surface is carried elsewhere.
#[test]
fn guides_lift_the_pen_where_they_lie_on_the_surface() {
    let tapers = ["line.width.taper.start=60px", "line.width.taper.end=60px"];
    let (_, whole) = drawn(&tapers);
    let top = "line.guides=[[0, 0.8, 0]]";
    let ([frame, file], cut) = drawn(&[tapers[0], tapers[1], top]);
    let [ring, open] = [&whole.strokes[0], &cut.strokes[0]];
    assert!(ring.closed && !open.closed && cut.strokes.len() == 1);
    assert!((ring.length() - open.length()).abs() < 1.0);
    let highest = ring
        .points
        .iter()
        .map(|point| point.position[1])
        .fold(f64::MAX, f64::min);
    for point in [open.points[0], open.points[open.points.len() - 1]] {
        let [x, y] = point.position;
        assert!((x - 320.0).abs() < 15.0 && y - highest < 2.0, "{x}, {y}");
        assert_eq!(point.width, 0.0);
    }
    let inks = [&frame, &file].map(Ink::of_strokes);
    assert!(difference(&inks[0], &inks[1]) < 0.001);
    assert!(inks[0].thickness([320.0, highest as f32 + 1.0]) < 2.0);

    // Turn the ball so that its top lies to the right.
    let mut scene = scene_of(&[Object::new(
        "Ball",
        placed(&icosphere(5), [0.8; 3], [0.0; 3]),
    )]);
    let style = style(&[tapers[0], tapers[1], top]);
    let mut lines = LineModel::new(&scene, &LineModelOptions::default()).unwrap();
    let turned = |[x, y, z]: [f32; 3]| [y, -x, z];
    for part in scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.parts) {
        part.positions
            .iter_mut()
            .for_each(|place| *place = turned(*place));
    }
    lines.set_pose(&scene).unwrap();
    let of_style = LineOptions::of_style(&style, SIZE);
    let drawing = lines.draw(&front(), &style, &of_style).unwrap();
    let [x, y] = drawing.strokes[0].points[0].position;
    assert!((y - 240.0).abs() < 15.0 && x > 320.0, "{x}, {y}");
}

#[test]
fn more_points_than_a_drawing_has_room_for_are_refused() {
    let scene = scene_of(&[Object::new("Ball", icosphere(5))]);
    let mut style = style(&["line.hand.wobble=1px", "line.hand.wave=4px"]);
    for setting in [
        "line.hand.copies=8",
        "line.crease_from=faces",
        "line.crease_angle_deg=0",
        "line.split_angle_deg=10",
    ] {
        style.set(setting).unwrap();
    }
    let subject = Subject::new(&scene, &style).unwrap();
    let of_size = |side: u32| {
        let options = LineOptions::of_style(&style, [side, side]);
        let lines = subject.lines.as_ref().unwrap();
        lines.draw(&front(), &style, &options).map(|_| ())
    };
    assert!(of_size(100).is_ok());
    assert!(matches!(
        of_size(32_000),
        Err(RenderError::TooMany {
            what: "points of strokes",
            ..
        })
    ));
}
